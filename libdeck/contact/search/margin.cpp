// Search margins of the reference solver.
#include "contact/search/margin.hpp"

#include <algorithm>
#include <vector>

#include "base/shared/parallel.hpp"

namespace deck {

double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 4>> segments) {
  if (segments.empty()) return 0.0;
  double sum = 0.0;
  for (const auto& s : segments)
    for (std::size_t k = 0; k < 4; ++k) sum += detail::edge_length(nodes, s[k], s[(k + 1) % 4]);
  return detail::margin_of(sum, 4 * segments.size());
}

// Lengths take time and are formed on all threads; their sum has an order.
double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 4>> segments, int threads) {
  threads = threads_for(segments.size(), threads);
  if (threads <= 1 || segments.empty()) return candidate_margin(nodes, segments);
  constexpr std::size_t at_once = 1024;
  using Lengths = std::vector<double>;
  double sum = 0.0;
  run_in_order<Lengths>(
      (segments.size() + at_once - 1) / at_once, threads,
      [&](std::size_t piece, Lengths& out) {
        out.clear();
        const std::size_t first = piece * at_once;
        for (const auto& s : segments.subspan(first, std::min(at_once, segments.size() - first)))
          for (std::size_t k = 0; k < 4; ++k)
            out.push_back(detail::edge_length(nodes, s[k], s[(k + 1) % 4]));
      },
      [&](std::size_t, const Lengths& lengths) {
        for (const double length : lengths) sum += length;
      });
  return detail::margin_of(sum, 4 * segments.size());
}

double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 2>> secondary,
                        std::span<const std::array<std::uint32_t, 2>> main) {
  const std::size_t count = secondary.size() + main.size();
  if (count == 0) return 0.0;
  double sum = 0.0;
  for (const auto& e : secondary) sum += detail::edge_length(nodes, e[0], e[1]);
  for (const auto& e : main) sum += detail::edge_length(nodes, e[0], e[1]);
  return detail::margin_of(sum, count);
}

}  // namespace deck
