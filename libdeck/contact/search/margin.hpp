// What search margins are formed of, and the margin of a long list of segments on several threads.
// Private to the library.
#pragma once
#include <cstddef>

#include "deck/contact/search.hpp"

namespace deck {

// Threads for a loop that does little for each of `count` things. A thread takes as long to start
// as some thousand of them, and to wait for it where other programs have the processors much
// longer.
inline int threads_for(std::size_t count, int threads) { return count < 32768 ? 1 : threads; }

namespace detail {

/// Length of the edge between nodes a and b; the squares of its parts may overflow.
inline double edge_length(const NodeArrays& nodes, std::uint32_t a, std::uint32_t b) {
  const auto point = [&](std::uint32_t i) {
    return Point3<double>{nodes.x[i], nodes.y[i], nodes.z[i]};
  };
  return deck::length(point(b) - point(a));
}

/// The solver's margin from the sum of the lengths of `count` edges.
inline double margin_of(double sum, std::size_t count) {
  constexpr double factor = static_cast<double>(0.2F);
  return factor * (sum / static_cast<double>(count));
}

}  // namespace detail

/// As candidate_margin without threads: the same sum, digit for digit, for any number of them.
double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 4>> segments, int threads);

}  // namespace deck
