// The search margin of a long list of segments: lengths take time and are formed on all threads,
// their sum has an order. Apart from margin.cpp, which the page is compiled from as well.
#include <algorithm>
#include <vector>

#include "base/shared/parallel.hpp"
#include "contact/search/margin.hpp"
#include "contact/search/short_loops.hpp"

namespace deck {

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

}  // namespace deck
