// Edge-edge search: a tree over the secondary edges, swept by the main edges.
#include <algorithm>
#include <utility>

#include "base/shared/parallel.hpp"
#include "contact/search/box_order.hpp"
#include "contact/search/sweep.hpp"

namespace deck {
namespace {

using sweep::at;
}  // namespace

namespace sweep {

EdgeSweep::EdgeSweep(const EdgeEdgeInput& in, const SearchOptions& o, int threads, double robust)
    : input(&in), options(&o), robust_margin(robust) {
  const auto secondary_box = [&](std::uint32_t i) {
    return edge_box(in.nodes, in.secondary[i], secondary_reach(o, at(in.secondary_gap, i, 0.0)));
  };
  const auto main_box = [&](std::uint32_t i) {
    return edge_box(in.nodes, in.main[i], main_reach(o, robust, at(in.main_gap, i, 0.0)));
  };
  items = active(in.secondary.size(), in.secondary_stiffness);
  mains = active(in.main.size(), in.main_stiffness);
  drop_distant(items, secondary_box, mains, main_box, threads);
  sort_in_space(items, secondary_box, threads);
  tree = BoxTree(
      items.size(), [&](std::size_t i) { return secondary_box(items[i]); }, threads);
  put_in_order(mains, main_box, threads);
}

std::size_t EdgeSweep::bytes() const {
  return tree.bytes() + (items.size() + mains.size()) * sizeof(std::uint32_t);
}

BothForms find_both_forms(const EdgeEdgeInput& in, const SearchOptions& options,
                          double robust_margin) {
  const EdgeSweep w(in, options, effective_threads(options.threads), robust_margin);
  BothForms both;
  both.result.structure_bytes = w.bytes();
  run([&w](std::size_t begin, std::size_t end,
           Found& found) { kernels().edges(w, begin, end, found); },
      w.mains.size(), in.secondary.size(), options, both);
  return both;
}

}  // namespace sweep

SearchResult find_edge_edge_pairs(const EdgeEdgeInput& in, const SearchOptions& options) {
  return sweep::find_both_forms(in, options, sweep::one_form).result;
}

}  // namespace deck
