// The three projections of a set: nodes, surface, lines.
#include <algorithm>
#include <tuple>

#include "model/selection_impl.hpp"

namespace deck {

using detail::Indices;
using detail::SetGroup;
using detail::SetState;

namespace {

std::size_t at(ElementKind kind) { return static_cast<std::size_t>(kind); }

Indices without(const Indices& all, const Indices& some) {
  Indices out;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(out));
  return out;
}

Indices common(const Indices& a, const Indices& b) {
  Indices out;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

}  // namespace

std::vector<Segment> Selections::Impl::group_segments(const SetGroup& group) {
  std::vector<Segment> out;
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3}) {
    const Elements& shells = model->family(kind);
    const Indices& members = group.elements[at(kind)];
    const Indices turned =
        common(members, kind == ElementKind::shell4 ? group.reversed4 : group.reversed3);
    const Carrier carrier = detail::family_name(kind).carrier;
    add_shells(shells, carrier, without(members, turned), false, out);
    add_shells(shells, carrier, turned, true, out);
  }
  detail::FaceQuery query;
  query.solids = &group.elements[at(ElementKind::solid8)];
  query.all_faces_of = &group.all_faces;
  if (!out.empty() && !query.solids->empty()) {
    cover().select(group.elements[at(ElementKind::shell4)],
                   group.elements[at(ElementKind::shell3)]);
    query.cover = &cover();
  }
  const auto faces = detail::solid_segments(model->solid8, query);
  out.insert(out.end(), faces.begin(), faces.end());
  out.insert(out.end(), group.rows.begin(), group.rows.end());
  return out;
}

std::vector<Edge> Selections::Impl::group_edges(const SetGroup& group) {
  std::vector<Edge> out = edges_of(group_segments(group), group.external);
  for (const ElementKind kind : {ElementKind::truss, ElementKind::beam, ElementKind::spring})
    add_line_elements(kind, group.elements[at(kind)], out);
  out.insert(out.end(), group.row_edges.begin(), group.row_edges.end());
  return out;
}

Indices Selections::Impl::group_nodes(const SetGroup& group) {
  Indices nodes;
  if (group.external) {
    const auto segments = group_segments(group);
    start_marks();
    for (const Segment& s : segments)
      for (const NodeIndex n : s.nodes) mark(n, nodes);
  } else {
    start_marks();
    for (std::size_t k = 0; k < SetGroup::families; ++k) {
      const Elements& family = model->family(static_cast<ElementKind>(k));
      for (const std::uint32_t e : group.elements[k]) add_element_nodes(family, e, nodes);
    }
    for (const Segment& s : group.rows)
      for (const NodeIndex n : s.nodes) mark(n, nodes);
  }
  for (const Edge& e : group.row_edges)
    for (const NodeIndex n : e.nodes) mark(n, nodes);
  for (const NodeIndex n : group.named) mark(n, nodes);
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

void Selections::Impl::merge_segments(std::vector<Segment>& segments) const {
  struct Keyed {
    // Ranks plus 1. Plain segments: ascending, a triangle starts with 0.
    std::array<std::uint32_t, 4> nodes;
    std::uint32_t carrier, element, index;
    bool operator<(const Keyed& o) const {
      if (nodes != o.nodes) return nodes < o.nodes;
      return carrier != o.carrier ? carrier < o.carrier : element < o.element;
    }
    bool same(const Keyed& o) const {
      return nodes == o.nodes && carrier == o.carrier && element == o.element;
    }
  };
  std::vector<Keyed> keyed;
  keyed.reserve(segments.size());
  for (std::uint32_t i = 0; i < segments.size(); ++i) {
    const Segment& s = segments[i];
    Keyed k{{}, static_cast<std::uint32_t>(s.carrier), s.element, i};
    for (std::size_t n = 0; n < 4; ++n) k.nodes[n] = rank(s.nodes[n]) + 1;
    if (s.carrier == Carrier::none) {
      if (s.nodes[2] == s.nodes[3]) k.nodes[3] = 0;
      std::sort(k.nodes.begin(), k.nodes.end());
    }
    keyed.push_back(k);
  }
  std::stable_sort(keyed.begin(), keyed.end());
  std::vector<Segment> out;
  out.reserve(segments.size());
  for (std::size_t i = 0; i < keyed.size(); ++i)
    if (i == 0 || !keyed[i - 1].same(keyed[i])) out.push_back(segments[keyed[i].index]);
  segments = std::move(out);
}

void Selections::Impl::merge_edges(std::vector<Edge>& edges) const {
  struct Keyed {
    std::uint64_t nodes;  // earlier node, then later node
    std::uint64_t owner;
    std::uint32_t index;
    bool operator<(const Keyed& o) const {
      return nodes != o.nodes ? nodes < o.nodes : owner < o.owner;
    }
  };
  std::vector<Keyed> keyed;
  keyed.reserve(edges.size());
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const Edge& e = edges[i];
    const std::uint64_t a = rank(e.nodes[0]), b = rank(e.nodes[1]);
    keyed.push_back({(std::min(a, b) << 32) | std::max(a, b),
                     (std::uint64_t{static_cast<std::uint8_t>(e.carrier)} << 32) | e.element, i});
  }
  std::stable_sort(keyed.begin(), keyed.end());
  std::vector<Edge> out;
  out.reserve(edges.size());
  for (std::size_t i = 0; i < keyed.size(); ++i)
    if (i == 0 || keyed[i - 1].nodes != keyed[i].nodes || keyed[i - 1].owner != keyed[i].owner)
      out.push_back(edges[keyed[i].index]);
  edges = std::move(out);
}

std::vector<NodeIndex> Selections::Impl::set_node_list(const SetState& state) {
  Indices nodes;
  for (const SetGroup& group : state.groups) {
    const Indices some = group_nodes(group);
    nodes.insert(nodes.end(), some.begin(), some.end());
  }
  detail::normalise(nodes);
  if (!state.removed.empty()) nodes = without(nodes, state.removed);
  sort_nodes(nodes);
  return nodes;
}

std::vector<Segment> Selections::Impl::set_segment_list(const SetState& state) {
  std::vector<Segment> out;
  for (const SetGroup& group : state.groups) {
    const auto some = group_segments(group);
    out.insert(out.end(), some.begin(), some.end());
  }
  merge_segments(out);
  sort_segments(out);
  return out;
}

std::vector<Edge> Selections::Impl::set_edge_list(const SetState& state) {
  std::vector<Edge> out;
  for (const SetGroup& group : state.groups) {
    const auto some = group_edges(group);
    out.insert(out.end(), some.begin(), some.end());
  }
  merge_edges(out);
  return out;
}

std::pair<std::string, Span> Selections::Impl::set_heading(std::int64_t id) const {
  const Block& block = *definition("set", id)->block;
  return {std::string(LineCursor(deck().sources, block).next().text.substr(0, 100)),
          block.header_span};
}

const SetGeneral* Selections::Impl::set(std::int64_t id) {
  if (const auto it = sets.find(id); it != sets.end()) return &it->second;
  const SetState* state = set_state(id);
  if (state == nullptr) return nullptr;
  SetGeneral s;
  s.id = id;
  std::tie(s.title, s.span) = set_heading(id);
  s.nodes = set_node_list(*state);
  s.segments = set_segment_list(*state);
  s.edges = set_edge_list(*state);
  s.parts = state->parts;
  return &sets.emplace(id, std::move(s)).first->second;
}

}  // namespace deck
