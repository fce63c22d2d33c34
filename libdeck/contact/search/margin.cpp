// Search margins of the reference solver.
#include "contact/search/margin.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.hpp"

namespace deck {
namespace {

Point3<double> point(const NodeArrays& nodes, std::uint32_t i) {
  return {nodes.x[i], nodes.y[i], nodes.z[i]};
}

double edge_length(const NodeArrays& nodes, std::uint32_t a, std::uint32_t b) {
  return deck::length(point(nodes, b) - point(nodes, a));  // squares may overflow
}

constexpr double kMarginFactor = static_cast<double>(0.2F);

}  // namespace

double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 4>> segments) {
  return candidate_margin(nodes, segments, 1);
}

double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 4>> segments, int threads) {
  if (segments.empty()) return 0.0;
  double sum = 0.0;
  // Lengths take time, their sum has an order.
  constexpr std::size_t at_once = 1024;
  using Lengths = std::vector<double>;
  run_in_order<Lengths>(
      (segments.size() + at_once - 1) / at_once, threads,
      [&](std::size_t piece, Lengths& out) {
        out.clear();
        const std::size_t first = piece * at_once;
        for (const auto& s : segments.subspan(first, std::min(at_once, segments.size() - first)))
          for (std::size_t k = 0; k < 4; ++k)
            out.push_back(edge_length(nodes, s[k], s[(k + 1) % 4]));
      },
      [&](std::size_t, const Lengths& lengths) {
        for (const double length : lengths) sum += length;
      });
  return kMarginFactor * (sum / (4.0 * static_cast<double>(segments.size())));
}

double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 2>> secondary,
                        std::span<const std::array<std::uint32_t, 2>> main) {
  const std::size_t count = secondary.size() + main.size();
  if (count == 0) return 0.0;
  double sum = 0.0;
  for (const auto& e : secondary) sum += edge_length(nodes, e[0], e[1]);
  for (const auto& e : main) sum += edge_length(nodes, e[0], e[1]);
  return kMarginFactor * (sum / static_cast<double>(count));
}

}  // namespace deck
