// The three projections of a set: nodes, surface, lines.
#include <algorithm>

#include "model/selection/selection_impl.hpp"

namespace deck {

using detail::Indices;
using detail::SetGroup;
using detail::SetState;

namespace {

std::size_t at(ElementKind kind) { return static_cast<std::size_t>(kind); }

}  // namespace

// In the order of carriers, which speeds up the final sort.
std::vector<Segment> Selections::Impl::group_segments(const SetGroup& group) {
  std::vector<Segment> out = group.rows;
  const Indices& shells4 = group.elements[at(ElementKind::shell4)];
  const Indices& shells3 = group.elements[at(ElementKind::shell3)];
  detail::FaceQuery query;
  query.solids = &group.elements[at(ElementKind::solid8)];
  query.all_faces_of = &group.all_faces;
  query.against_all = group.against_all;
  if (!query.solids->empty()) {
    if (!shells4.empty() || !shells3.empty()) {
      cover().select(shells4, shells3);
      query.cover = &cover();
    }
    solid_faces().add_segments(query, out);
  }
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3}) {
    const Elements& shells = model->family(kind);
    const bool four = kind == ElementKind::shell4;
    const Indices& members = four ? shells4 : shells3;
    const Indices turned = detail::common(members, four ? group.reversed4 : group.reversed3);
    if (turned.empty()) {
      add_shells(shells, members, false, out);
      continue;
    }
    add_shells(shells, detail::without(members, turned), false, out);
    add_shells(shells, turned, true, out);
  }
  return out;
}

const std::vector<Segment>& Selections::Impl::group_segments(const SetGroup& group,
                                                             LastGroup& last) {
  if (last.group != &group) last = {&group, group_segments(group)};
  return last.segments;
}

std::vector<Edge> Selections::Impl::group_edges(const SetGroup& group, LastGroup& last) {
  std::vector<Edge> out = edges_of({*model, group_segments(group, last)}, group.external);
  for (const ElementKind kind : {ElementKind::truss, ElementKind::beam, ElementKind::spring})
    add_line_elements(kind, group.elements[at(kind)], out);
  out.insert(out.end(), group.row_edges.begin(), group.row_edges.end());
  return out;
}

Indices Selections::Impl::group_nodes(const SetGroup& group, LastGroup& last) {
  Indices nodes;
  if (group.external) {
    const auto& segments = group_segments(group, last);
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
  sort_nodes(nodes);
  return nodes;
}

void Selections::Impl::merge_segments(std::vector<Segment>& segments) const {
  // Plain segments are compared by sorted nodes (triangles start with 0), others as stored.
  const auto plain_key = [&](const Segment& s) {
    std::array<std::uint32_t, 4> k;
    for (std::size_t n = 0; n < 4; ++n) k[n] = s.nodes[n] + 1;
    if (s.nodes[2] == s.nodes[3]) k[3] = 0;
    std::sort(k.begin(), k.end());
    return k;
  };
  const auto before = [&](const Segment& a, const Segment& b) {
    return a.carrier == Carrier::none ? plain_key(a) < plain_key(b) : a.nodes < b.nodes;
  };
  const auto one_element = [](const Segment& a, const Segment& b) {
    return a.carrier == b.carrier && a.element == b.element;
  };
  sort_segments(segments);
  for (auto first = segments.begin(), last = first; first != segments.end(); first = last) {
    while (last != segments.end() && one_element(*first, *last)) ++last;
    constexpr std::ptrdiff_t few = 16;  // sorted in place
    if (last - first > few)
      std::stable_sort(first, last, before);
    else
      for (auto it = first + 1; it != last; ++it)
        std::rotate(std::upper_bound(first, it, *it, before), it, it + 1);
  }
  segments.erase(std::unique(segments.begin(), segments.end(),
                             [&](const Segment& a, const Segment& b) {
                               return one_element(a, b) && !before(a, b);
                             }),
                 segments.end());
}

void Selections::Impl::merge_edges(std::vector<Edge>& edges) const {
  const auto early = [&](const Edge& e) { return std::min(e.nodes[0], e.nodes[1]); };
  const auto late = [&](const Edge& e) { return std::max(e.nodes[0], e.nodes[1]); };
  detail::sort_by_bucket(edges, early, [&](const Edge& a, const Edge& b) {
    if (late(a) != late(b)) return late(a) < late(b);
    return a.carrier != b.carrier ? a.carrier < b.carrier : a.element < b.element;
  });
  edges.erase(std::unique(edges.begin(), edges.end(),
                          [&](const Edge& a, const Edge& b) {
                            return early(a) == early(b) && late(a) == late(b) &&
                                   a.carrier == b.carrier && a.element == b.element;
                          }),
              edges.end());
}

namespace {

// Minimal cost per group, which limits sets with very many groups.
constexpr std::size_t bytes_of_a_group = 256;

}  // namespace

/// Concatenates get(group) of all groups, as far as it fits.
template <class Item, class Get>
std::vector<Item> Selections::Impl::of_groups(const SetState& state, const Block& block,
                                              const Get& get) {
  std::vector<Item> out;
  if (!reserve_bytes(state.others.size(), bytes_of_a_group, block)) return out;
  state.for_each_group([&](const SetGroup& group) {
    const std::vector<Item>& some = get(group);
    if (fits(out.size() + some.size(), sizeof(Item), block))
      out.insert(out.end(), some.begin(), some.end());
  });
  return out;
}

std::vector<NodeIndex> Selections::Impl::set_node_list(const SetState& state, const Block& block,
                                                       LastGroup& last) {
  Indices nodes = of_groups<NodeIndex>(
      state, block, [&](const SetGroup& group) { return group_nodes(group, last); });
  detail::normalise(nodes);
  if (!state.removed.empty()) nodes = detail::without(nodes, state.removed);
  sort_nodes(nodes);
  return nodes;
}

std::vector<Segment> Selections::Impl::set_segment_list(const SetState& state, const Block& block,
                                                        LastGroup& last) {
  auto out = of_groups<Segment>(
      state, block, [&](const SetGroup& group) -> auto& { return group_segments(group, last); });
  merge_segments(out);
  return out;
}

std::vector<Edge> Selections::Impl::set_edge_list(const SetState& state, const Block& block,
                                                  LastGroup& last) {
  auto out = of_groups<Edge>(state, block,
                             [&](const SetGroup& group) { return group_edges(group, last); });
  merge_edges(out);
  return out;
}

std::string Selections::Impl::set_title(const Block& block) const {
  return std::string(LineCursor(deck().sources, block).next().text.substr(0, 100));
}

const SetGeneral* Selections::Impl::set(std::int64_t id) {
  if (const auto it = sets.find(id); it != sets.end()) return &it->second;
  const SetState* state = set_state(id);
  if (state == nullptr) return nullptr;
  const Block& block = *definition("set", id)->block;
  SetGeneral s;
  s.id = id;
  s.title = set_title(block);
  s.span = block.header_span;
  LastGroup last;
  s.nodes = set_node_list(*state, block, last);
  const auto view = definition("surf", id) == nullptr ? surfaces.find(id) : surfaces.end();
  s.segments =
      view != surfaces.end() ? view->second.segments : set_segment_list(*state, block, last);
  s.edges = set_edge_list(*state, block, last);
  s.parts = state->parts;
  keep(s.nodes, block);
  keep(s.segments, block);
  keep(s.edges, block);
  keep(s.parts, block);
  return &sets.emplace(id, std::move(s)).first->second;
}

}  // namespace deck
