// Search margins of the reference solver.
#include "deck/contact/search.hpp"

#include <cmath>

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
  if (segments.empty()) return 0.0;
  double sum = 0.0;
  for (const auto& s : segments) {
    for (std::size_t k = 0; k < 4; ++k) sum += edge_length(nodes, s[k], s[(k + 1) % 4]);
  }
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
