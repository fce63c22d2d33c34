// Search margins of the reference solver.
#include "contact/search/margin.hpp"

namespace deck {

double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 4>> segments) {
  if (segments.empty()) return 0.0;
  double sum = 0.0;
  for (const auto& s : segments)
    for (std::size_t k = 0; k < 4; ++k) sum += detail::edge_length(nodes, s[k], s[(k + 1) % 4]);
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
