// Copies the items of a contact into arrays for the pair search.
#include "contact/shared/sides.hpp"

#include <atomic>

#include "base/shared/parallel.hpp"

namespace deck::detail {

SearchSides::SearchSides(const Contact& contact, Off off, int threads)
    : threads_(effective_threads(threads)), kind_(contact.kind), all_gaps_(contact.irem_gap == 2) {
  const auto active = [&](bool is_off, double stiffness) {
    return is_off && off == Off::left_out ? 0.0 : stiffness;
  };
  sides_[0].length = contact.secondary_length;
  sides_[1].length = contact.main_length;
  if (edge_pairs()) {
    const std::vector<ContactEdge>* lists[] = {&contact.secondary_edges, &contact.main_edges};
    for (std::size_t k = 0; k < 2; ++k)
      fill(
          sides_[k], *lists[k], edges_[k],
          [&](const ContactEdge& e) { return active(e.off, e.stiffness); },
          [](const ContactEdge& e) { return e.nodes; });
    return;
  }
  fill(
      sides_[0], contact.secondary, nodes_,
      [&](const SecondaryNode& s) { return active(s.off, s.multiplier); },
      [](const SecondaryNode& s) { return s.node; });
  fill(
      sides_[1], contact.main, segments_,
      [&](const MainSegment& m) { return active(m.off, m.stiffness); },
      [](const MainSegment& m) { return m.nodes; });
}

template <class Item, class Out, class Active, class As>
void SearchSides::fill(Side& side, const std::vector<Item>& items, std::vector<Out>& out,
                       const Active& active, const As& as) const {
  const std::size_t count = items.size();
  const auto for_each_piece = [&](const auto& f) {
    parallel_pieces(threads_for(count, threads_), count,
                    [&](std::size_t, std::size_t begin, std::size_t end) { f(begin, end); });
  };
  out.resize(count);
  std::atomic<bool> some_gap{all_gaps_};
  std::atomic<bool> some_off{false};
  for_each_piece([&](std::size_t begin, std::size_t end) {
    bool gap = false, off = false;
    for (std::size_t i = begin; i < end; ++i) {
      out[i] = as(items[i]);
      gap |= items[i].gap != 0.0;
      off |= active(items[i]) == 0.0;
    }
    if (gap) some_gap.store(true, std::memory_order_relaxed);
    if (off) some_off.store(true, std::memory_order_relaxed);
  });
  if (some_gap) {
    side.gap.resize(count);
    for_each_piece([&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) side.gap[i] = items[i].gap;
    });
  }
  // Stiffness only marks active items; usually all are.
  if (!some_off) return;
  side.stiffness.resize(count);
  for_each_piece([&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) side.stiffness[i] = active(items[i]);
  });
}

NodeSegmentInput SearchSides::nodes(const Coordinates& x) const {
  return {{x.x, x.y, x.z}, nodes_,        sides_[0].gap,    sides_[0].length,   sides_[0].stiffness,
          segments_,       sides_[1].gap, sides_[1].length, sides_[1].stiffness};
}

EdgeEdgeInput SearchSides::edges(const Coordinates& x) const {
  return {{x.x, x.y, x.z}, edges_[0],     sides_[0].gap,    sides_[0].length,   sides_[0].stiffness,
          edges_[1],       sides_[1].gap, sides_[1].length, sides_[1].stiffness};
}

SearchResult SearchSides::find(const Coordinates& x, const SearchOptions& options) const {
  return edge_pairs() ? find_edge_edge_pairs(edges(x), options)
                      : find_node_segment_pairs(nodes(x), options);
}

sweep::BothForms SearchSides::find_both_forms(const Coordinates& x, const SearchOptions& options,
                                              double robust_margin) const {
  return edge_pairs() ? sweep::find_both_forms(edges(x), options, robust_margin)
                      : sweep::find_both_forms(nodes(x), options, robust_margin);
}

void SearchSides::find_nearest(
    const Coordinates& x, double reach, std::size_t limit,
    const std::function<double(const CandidatePair&)>& reach_after) const {
  constexpr std::size_t most_items = 64 * sweep::items_at_once;
  SearchOptions options;
  options.margin = reach;
  const auto walk = [&](const auto& w, std::size_t count, const auto& kernel) {
    std::size_t items = sweep::items_at_once;  // few at first: their pairs shorten the reach
    for (std::size_t begin = 0, halved = 0; begin < count && halved < 8;) {
      std::atomic<std::int64_t> allowance{static_cast<std::int64_t>(limit)};
      sweep::Found found(&allowance);
      const std::size_t end = std::min(count, begin + items);
      kernel(w, begin, end, found);
      if (found.full()) {
        options.margin /= 2;
        ++halved;
        continue;
      }
      found.pairs.for_each([&](const CandidatePair& pair) {
        options.margin = std::min(options.margin, reach_after(pair));
      });
      begin = end;
      items = std::min(2 * items, most_items);
    }
  };
  if (edge_pairs()) {
    const EdgeEdgeInput in = edges(x);
    const sweep::EdgeSweep w(in, options, threads_);
    return walk(w, w.mains.size(), sweep::kernels().edges);
  }
  const NodeSegmentInput in = nodes(x);
  const sweep::NodeSweep w(in, options, threads_);
  walk(w, w.segments.size(), sweep::kernels().nodes);
}

double SearchSides::margin(const Coordinates& x) const {
  return candidate_margin({x.x, x.y, x.z}, segments_);
}

double SearchSides::edge_length(const Coordinates& x) const {
  const NodeArrays at{x.x, x.y, x.z};
  const auto mean = [&](const auto& items) {
    const std::size_t step = 1 + items.size() / 1024;
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < items.size(); i += step, ++count)
      sum += detail::edge_length(at, items[i][0], items[i][1]);
    return sum / count;
  };
  return edge_pairs() ? mean(edges_[1]) : mean(segments_);
}

}  // namespace deck::detail
