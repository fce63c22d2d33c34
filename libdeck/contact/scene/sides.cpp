// Copies what the pair search reads out of the items of a contact.
#include "contact/scene/sides.hpp"

#include <algorithm>

namespace deck::detail {

SearchSides::SearchSides(const Contact& contact, Off off)
    : kind_(contact.kind),
      // Removal along the mesh reads them whatever the gap rule is.
      lengths_(contact.gap_rule.rule == GapRule::sum_limited || contact.irem_gap == 2) {
  const auto active = [&](bool is_off, double stiffness) {
    return is_off && off == Off::left_out ? 0.0 : stiffness;
  };
  const auto reserve = [&](Side& side, std::size_t count) {
    for (std::vector<double>* a : {&side.gap, &side.stiffness}) a->reserve(count);
    if (lengths_) side.length.reserve(count);
  };
  if (edge_pairs()) {
    const std::vector<ContactEdge>* lists[] = {&contact.secondary_edges, &contact.main_edges};
    for (std::size_t k = 0; k < 2; ++k) {
      reserve(sides_[k], lists[k]->size());
      edges_[k].reserve(lists[k]->size());
      for (const ContactEdge& e : *lists[k]) {
        edges_[k].push_back(e.nodes);
        add(sides_[k], e.gap, e.length, active(e.off, e.stiffness));
      }
    }
  } else {
    reserve(sides_[0], contact.secondary.size());
    nodes_.reserve(contact.secondary.size());
    for (const SecondaryNode& s : contact.secondary) {
      nodes_.push_back(s.node);
      add(sides_[0], s.gap, s.length, active(s.off, s.multiplier));
    }
    reserve(sides_[1], contact.main.size());
    segments_.reserve(contact.main.size());
    for (const MainSegment& m : contact.main) {
      segments_.push_back(m.nodes);
      add(sides_[1], m.gap, m.length, active(m.off, m.stiffness));
    }
  }
  // Stiffness only says who takes part; mostly all do.
  for (Side& side : sides_)
    if (std::find(side.stiffness.begin(), side.stiffness.end(), 0.0) == side.stiffness.end())
      std::vector<double>().swap(side.stiffness);
}

void SearchSides::add(Side& side, double gap, double length, double stiffness) {
  side.gap.push_back(gap);
  if (lengths_) side.length.push_back(length);
  side.stiffness.push_back(stiffness);
}

NodeSegmentInput SearchSides::nodes(const Coordinates& x) const {
  return {{x.x, x.y, x.z}, nodes_,        sides_[0].gap,    sides_[0].length,   sides_[0].stiffness,
          segments_,       sides_[1].gap, sides_[1].length, sides_[1].stiffness};
}

EdgeEdgeInput SearchSides::edges(const Coordinates& x) const {
  return {{x.x, x.y, x.z}, edges_[0],     sides_[0].gap,    sides_[0].length,   sides_[0].stiffness,
          edges_[1],       sides_[1].gap, sides_[1].length, sides_[1].stiffness};
}

SearchResult SearchSides::find(const Coordinates& x, const SearchOptions& options,
                               SearchMemory* memory) const {
  if (memory != nullptr)
    return edge_pairs() ? memory->find(edges(x), options) : memory->find(nodes(x), options);
  return edge_pairs() ? find_edge_edge_pairs(edges(x), options)
                      : find_node_segment_pairs(nodes(x), options);
}

double SearchSides::margin(const Coordinates& x) const {
  const NodeArrays at{x.x, x.y, x.z};
  return edge_pairs() ? candidate_margin(at, edges_[0], edges_[1])
                      : candidate_margin(at, segments_);
}

}  // namespace deck::detail
