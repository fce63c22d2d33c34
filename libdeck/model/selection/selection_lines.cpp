// Lines: /LINE of every type, and the edges of surfaces.
#include <algorithm>

#include "model/selection/selection_impl.hpp"

namespace deck {

using detail::Definition;
using detail::IdRef;
using detail::Indices;

const LineSet* Selections::Impl::line(std::int64_t id) {
  return resolved(
      lines, "line", id, 176,
      [&](const Definition& def, const DecodedBlock& d) {
        const Block& block = *def.block;
        LineSet l{id, d.title, resolve_line(def, d), block.header_span};
        keep(l.edges, block);
        if (l.edges.empty() && all_held)
          report({RuleId::DK154, l.span,
                  std::string(block.keyword) + " " + std::to_string(id) + " has no edge",
                  std::string(block.keyword), id});
        return l;
      },
      [&](const detail::SetState& state, const Block& block) {
        detail::SegmentsOfGroup last;
        LineSet view{id, set_title(block), set_edge_list(state, block, last), block.header_span};
        keep(view.edges, block);
        return view;
      });
}

void Selections::Impl::add_line_elements(ElementKind kind, const Indices& members,
                                         std::vector<Edge>& out) const {
  const Elements& family = model->family(kind);
  const Carrier carrier = detail::family_name(kind).carrier;
  for (const std::uint32_t e : members) {
    const NodeIndex* n = family.of(e);
    // Springs with one node are attached to the ground.
    if (n[0] == no_index || n[1] == no_index || n[0] == n[1]) continue;
    out.push_back({{n[0], n[1]}, carrier, e});
  }
}

std::vector<Edge> Selections::Impl::listed_edges(const Block& block, const DecodedBlock& d) {
  std::vector<Edge> out;
  std::vector<IdRef> missing;
  for (const DecodedCard& card : d.cards) {
    Edge edge;
    std::size_t at = 0;
    bool complete = true;
    for (const Cell& cell : card.cells) {
      if (cell.field->ref != "node" || at >= 2) continue;
      const std::int64_t id = deck().shifted_id(block, "node", cell.integer);
      edge.nodes[at] = node(id);
      if (edge.nodes[at] == no_index) {
        complete = false;
        missing.push_back({id, cell.span});
      }
      ++at;
    }
    if (complete && at == 2) out.push_back(edge);
  }
  report_missing(RuleId::DK150, block, "node", missing, 78);
  return out;
}

std::vector<Edge> Selections::Impl::resolve_line(const Definition& def, const DecodedBlock& d) {
  const Block& block = *def.block;
  const std::string_view type = def.type;
  std::vector<Edge> out;
  if (type == "SEG") return listed_edges(block, d);
  const detail::IdList list = id_list(d);
  if (type == "LINE") {
    std::vector<IdRef> missing;
    for (const IdRef& ref : list.positive) {
      if (recursive("line", ref.id, block, 176)) continue;
      const LineSet* l = line(ref.id);
      if (l == nullptr)
        missing.push_back(ref);
      else if (fits(out.size() + l->edges.size(), sizeof(Edge), block))
        out.insert(out.end(), l->edges.begin(), l->edges.end());
    }
    report_missing(RuleId::DK139, block, "line", missing, 180);
    return out;
  }
  if (type == "SURF" || type == "EDGE") {
    std::vector<Segment> segments;
    for (const IdRef& ref : list.positive)
      if (const Surface* s = surface(ref.id);
          s != nullptr && fits(segments.size() + s->segments.size(), 4 * sizeof(Segment), block))
        segments.insert(segments.end(), s->segments.begin(), s->segments.end());
    return edges_of({*model, segments}, type == "EDGE");
  }
  if (is_part_type(type)) {
    std::vector<std::int8_t> tags(model->parts.size(), 0);
    for (const IdRef& ref : list.positive) {
      bool known = false;
      for (const std::uint32_t p : parts_of(type, ref.id, known)) tags[p] = 1;
    }
    const bool springs = type == "PART" || type == "PROP" || type == "SUBSET";
    for (const ElementKind kind : {ElementKind::truss, ElementKind::beam, ElementKind::spring}) {
      if (kind == ElementKind::spring && !springs) continue;
      const Elements& family = model->family(kind);
      Indices members;
      for (std::uint32_t e = 0; e < family.size(); ++e)
        if (family.part[e] != no_index && tags[family.part[e]] != 0) members.push_back(e);
      add_line_elements(kind, members, out);
    }
    return out;
  }
  if (type == "BOX" || type == "BOX2") {
    need_boxes(list, d, 799);
    for (const ElementKind kind : {ElementKind::truss, ElementKind::beam, ElementKind::spring})
      add_line_elements(kind, elements_in_boxes(block, list.positive, kind, type == "BOX2", 799),
                        out);
    return out;
  }
  for (const ElementKind kind : {ElementKind::truss, ElementKind::beam, ElementKind::spring}) {
    const detail::FamilyName& name = detail::family_name(kind);
    if (type != name.keyword) continue;
    for (const IdRef& ref : list.positive)
      if (const Indices* group = element_group(name, ref.id);
          group != nullptr && fits(out.size() + group->size(), sizeof(Edge), block))
        add_line_elements(kind, *group, out);
    return out;
  }
  report(block, RuleId::DK165,
         std::string(block.header) + " is not a combination that defines a line", {.message = 688});
  return out;
}

std::vector<Edge> Selections::Impl::edges_of(const SegmentList& segments, bool free_only) const {
  // Stable: the first segment of an edge stays first.
  std::vector<Edge> edges = detail::in_buckets<Edge>(
      [&](const auto& take) {
        segments.for_each([&](const Segment& s) {
          for (std::size_t k = 0; k < 4; ++k)
            if (const NodeIndex a = s.nodes[k], b = s.nodes[(k + 1) % 4]; a != b)
              take(Edge{{std::min(a, b), std::max(a, b)}, s.carrier, s.element});
        });
      },
      [](const Edge& e) { return e.nodes[1]; },
      [](const Edge& p, const Edge& q) { return p.nodes[0] < q.nodes[0]; });
  std::size_t kept = 0;
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    const auto [a, b] = edges[i].nodes;
    while (end < edges.size() && edges[end].nodes[0] == a && edges[end].nodes[1] == b) ++end;
    if (!free_only || end == i + 1) edges[kept++] = edges[i];
  }
  edges.resize(kept);
  return edges;
}

}  // namespace deck
