// The three projections of a set: nodes, surface, lines.
#include <algorithm>

#include "model/selection_impl.hpp"

namespace deck {

using detail::Indices;
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

std::vector<Segment> Selections::Impl::surface_projection(const SetState& state) {
  std::vector<Segment> out;
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3}) {
    const Elements& shells = model->family(kind);
    const Indices& members = state.elements[at(kind)];
    const Indices turned =
        common(members, kind == ElementKind::shell4 ? state.reversed4 : state.reversed3);
    const Carrier carrier = detail::family_name(kind).carrier;
    add_shells(shells, carrier, without(members, turned), false, out);
    add_shells(shells, carrier, turned, true, out);
  }
  const Indices& solids = state.elements[at(ElementKind::solid8)];
  if (!solids.empty()) {
    detail::KeyTable hidden(out.size());
    for (const Segment& s : out) hidden.insert(detail::node_key(s.nodes.data(), 4));
    detail::FaceQuery query;
    query.solids = &solids;
    query.all_faces_of = &state.all_faces;
    query.hidden = out.empty() ? nullptr : &hidden;
    const auto faces = detail::solid_segments(model->solid8, query);
    out.insert(out.end(), faces.begin(), faces.end());
  }
  out.insert(out.end(), state.segments.begin(), state.segments.end());
  std::stable_sort(out.begin(), out.end(), [&](const Segment& a, const Segment& b) {
    return a.nodes != b.nodes ? a.nodes < b.nodes
                              : element_id(a.carrier, a.element) < element_id(b.carrier, b.element);
  });
  sort_segments(out);
  return out;
}

std::vector<NodeIndex> Selections::Impl::node_projection(const SetState& state) {
  std::vector<NodeIndex> nodes;
  if (state.external) {
    const auto segments = surface_projection(state);
    start_marks();
    for (const Segment& s : segments)
      for (const NodeIndex n : s.nodes) mark(n, nodes);
  } else {
    start_marks();
    for (std::size_t k = 0; k < SetState::families; ++k) {
      const Elements& family = model->family(static_cast<ElementKind>(k));
      for (const std::uint32_t e : state.elements[k]) add_element_nodes(family, e, nodes);
    }
    for (const Segment& s : state.segments)
      for (const NodeIndex n : s.nodes) mark(n, nodes);
  }
  for (const Edge& e : state.edges)
    for (const NodeIndex n : e.nodes) mark(n, nodes);
  for (const NodeIndex n : state.nodes) mark(n, nodes);
  std::sort(nodes.begin(), nodes.end());
  return without(nodes, state.removed);
}

const SetGeneral* Selections::Impl::set(std::int64_t id) {
  if (const auto it = sets.find(id); it != sets.end()) return &it->second;
  const SetState* state = set_state(id);
  if (state == nullptr) return nullptr;
  const Block& block = *definition("set", id)->block;
  SetGeneral s;
  s.id = id;
  s.span = block.header_span;
  s.title = decode(deck(), block).title;
  s.nodes = node_projection(*state);
  s.segments = surface_projection(*state);
  s.edges = edges_of(s.segments, state->external);
  for (const ElementKind kind : {ElementKind::truss, ElementKind::beam, ElementKind::spring})
    add_line_elements(kind, state->elements[at(kind)], s.edges);
  s.edges.insert(s.edges.end(), state->edges.begin(), state->edges.end());
  s.parts = state->parts;
  return &sets.emplace(id, std::move(s)).first->second;
}

}  // namespace deck
