// Node groups: /GRNOD of every type. The result has no duplicates and is in internal order, except
// for types with the user's order.
#include <algorithm>

#include "model/selection/selection_impl.hpp"

namespace deck {

using detail::Definition;
using detail::IdList;
using detail::IdRef;
using detail::Indices;

void Selections::Impl::start_marks() {
  if (stamp.size() != model->nodes.size()) {
    stamp.assign(model->nodes.size(), 0);
    generation = 0;
  }
  if (++generation == 0) {  // overflow
    std::fill(stamp.begin(), stamp.end(), 0);
    generation = 1;
  }
}

void Selections::Impl::mark(NodeIndex n, std::vector<NodeIndex>& out) {
  if (n == no_index || stamp[n] == generation) return;
  stamp[n] = generation;
  out.push_back(n);
}

const NodeSet* Selections::Impl::node_group(std::int64_t id) {
  return resolved(
      node_groups, "grnod", id, 176,
      [&](const Definition& def, const DecodedBlock& d) {
        const Block& block = *def.block;
        NodeSet group{id, d.title, resolve_nodes(def, d), block.header_span};
        keep(group.nodes, block);
        if (group.nodes.empty() && all_held)
          report({RuleId::DK153, group.span,
                  std::string(block.keyword) + " " + std::to_string(id) + " has no node",
                  std::string(block.keyword), id});
        return group;
      },
      [&](const detail::SetState& state, const Block& block) {
        detail::SegmentsOfGroup last;
        NodeSet view{id, set_title(block), set_node_list(state, block, last), block.header_span};
        keep(view.nodes, block);
        return view;
      });
}

std::vector<NodeIndex> Selections::Impl::resolve_nodes(const Definition& def,
                                                       const DecodedBlock& d) {
  const Block& block = *def.block;
  const std::string_view type = def.type;
  std::vector<NodeIndex> nodes;
  if (type == "NODE" || type == "NODENS") {
    nodes = nodes_by_id(def, d);
  } else if (type == "GENE" || type == "GEN_INCR") {
    nodes = nodes_of_ranges(d);
  } else if (is_part_type(type)) {
    nodes = nodes_of_parts(block, type, d);
  } else if (type == "BOX" || type == "BOX2") {
    nodes = nodes_in_boxes(block, d);
  } else if (type == "SURF") {
    nodes = nodes_of_surfaces(block, d);
  } else if (type == "LINE") {
    nodes = nodes_of_lines(block, d);
  } else if (type == "GRNOD" || type == "GRNODNS") {
    nodes = nodes_of_groups(block, d, type == "GRNODNS");
  } else {
    for (const detail::FamilyName& name : detail::family_names())
      if (name.keyword == type) nodes = nodes_of_elements(block, d, name.kind);
  }
  const bool keeps_order = type == "NODENS" || type == "GRNODNS";
  if (!keeps_order) sort_nodes(nodes);
  return nodes;
}

std::vector<NodeIndex> Selections::Impl::nodes_by_id(const Definition& def, const DecodedBlock& d) {
  std::vector<NodeIndex> nodes;
  std::vector<IdRef> missing;
  start_marks();
  for (const IdRef& ref : id_list(d).positive) {
    const NodeIndex n = node(ref.id);
    if (n == no_index)
      missing.push_back(ref);
    else
      mark(n, nodes);
  }
  report_missing(RuleId::DK150, *def.block, "node", missing, 78);
  return nodes;
}

std::vector<NodeIndex> Selections::Impl::nodes_of_ranges(const DecodedBlock& d) {
  std::vector<NodeIndex> nodes;
  start_marks();
  for (const detail::IdRange& r : id_ranges(d, "node")) {
    if (r.last < r.first) continue;
    // Visits ids or nodes, whichever are fewer: ranges may have millions of unused ids.
    if ((r.last - r.first) / r.increment < static_cast<std::int64_t>(model->nodes.size())) {
      for (std::int64_t id = r.first; id <= r.last; id += r.increment) mark(node(id), nodes);
      continue;
    }
    for (NodeIndex n = 0; n < model->nodes.size(); ++n)
      if (r.contains(model->nodes.id[n])) mark(n, nodes);
  }
  return nodes;
}

void Selections::Impl::add_element_nodes(const Elements& family, std::uint32_t e,
                                         std::vector<NodeIndex>& out) {
  const NodeIndex* n = family.of(e);
  const int count = detail::carrying_nodes(family.kind);
  for (int i = 0; i < count; ++i) mark(n[i], out);
  if (family.extra.empty() || family.extra[e] == no_index) return;
  const NodeIndex* mid = family.extra_nodes.data() + family.extra[e];
  for (int i = 0; i < extra_node_count(family.shape[e]); ++i) mark(mid[i], out);
}

std::vector<NodeIndex> Selections::Impl::nodes_of_parts(const Block& block, std::string_view type,
                                                        const DecodedBlock& d) {
  const std::vector<std::int8_t> tags = part_tags(block, type, id_list(d));
  const bool removes = std::find(tags.begin(), tags.end(), -1) != tags.end();
  Indices named;
  for (std::uint32_t p = 0; p < tags.size(); ++p)
    if (tags[p] != 0) named.push_back(p);
  report_unread(block, named);
  // mark() for many nodes, with its state in registers.
  const auto mark_all = [&](const NodeIndex* n, const NodeIndex* end, std::vector<NodeIndex>& out) {
    std::uint8_t* const stamps = stamp.data();
    const std::uint8_t now = generation;
    for (; n != end; ++n) {
      if (*n == no_index || stamps[*n] == now) continue;
      stamps[*n] = now;
      out.push_back(*n);
    }
  };
  std::vector<NodeIndex> nodes;
  start_marks();
  // Per family: a node removed with one family can be added again by a later one.
  for (const ElementKind kind :
       {ElementKind::solid8, ElementKind::quad, ElementKind::shell4, ElementKind::shell3,
        ElementKind::tria, ElementKind::truss, ElementKind::beam, ElementKind::spring}) {
    const Elements& family = model->family(kind);
    if (family.size() == 0) continue;
    const PartElements& rows = elements_of_parts(kind);
    const bool all_slots = family.extra.empty() && detail::carrying_nodes(kind) == family.width;
    const auto add = [&](std::size_t p, std::vector<NodeIndex>& out) {
      for (const ElementRun& run : rows.row(p)) {
        if (all_slots) {
          mark_all(family.of(run.first), family.of(run.end), out);
          continue;
        }
        for (std::uint32_t e = run.first; e < run.end; ++e) add_element_nodes(family, e, out);
      }
    };
    std::size_t most = nodes.size();
    for (std::size_t p = 0; p < tags.size(); ++p)
      if (tags[p] > 0)
        for (const ElementRun& run : rows.row(p)) most += run.size() * std::size_t{8};
    nodes.reserve(std::min(most, model->nodes.size()));  // growing would copy
    for (std::size_t p = 0; p < tags.size(); ++p)
      if (tags[p] > 0) add(p, nodes);
    if (!removes) continue;
    std::vector<NodeIndex> gone;
    start_marks();
    for (std::size_t p = 0; p < tags.size(); ++p)
      if (tags[p] < 0) add(p, gone);
    std::erase_if(nodes, [&](NodeIndex n) { return stamp[n] == generation; });
    // Sets the marks of the remaining nodes again; they were overwritten or outdated.
    start_marks();
    for (const NodeIndex n : nodes) stamp[n] = generation;
  }
  return nodes;
}

std::vector<NodeIndex> Selections::Impl::nodes_in_boxes(const Block& block, const DecodedBlock& d) {
  const IdList list = id_list(d);
  std::vector<std::uint8_t> in(model->nodes.size(), 0);
  const auto apply = [&](const std::vector<IdRef>& refs, std::uint8_t value) {
    for (const IdRef& ref : refs) {
      const detail::BoxVolume* b = box(ref.id, block, 794);
      if (b == nullptr) continue;
      for (const NodeIndex n : nodes_in(*b)) in[n] = value;
    }
  };
  apply(list.positive, 1);
  apply(list.negative, 0);
  std::vector<NodeIndex> nodes;
  for (NodeIndex n = 0; n < in.size(); ++n)
    if (in[n] != 0) nodes.push_back(n);
  return nodes;
}

std::vector<NodeIndex> Selections::Impl::nodes_of_groups(const Block& block, const DecodedBlock& d,
                                                         bool keep_order) {
  const IdList list = id_list(d);
  std::vector<IdRef> missing;
  const auto collect = [&](const std::vector<IdRef>& refs) {
    // Resolves them first: groups use the marks, too.
    std::vector<const NodeSet*> groups;
    for (const IdRef& ref : refs) {
      if (recursive("grnod", ref.id, block, 176)) continue;
      const NodeSet* group = node_group(ref.id);
      if (group == nullptr)
        missing.push_back(ref);
      else
        groups.push_back(group);
    }
    return groups;
  };
  const auto added = collect(list.positive);
  const auto removed = collect(list.negative);
  report_missing(RuleId::DK151, block, "node group", missing, 174);
  std::vector<NodeIndex> nodes;
  start_marks();
  for (const NodeSet* group : added)
    for (const NodeIndex n : group->nodes) mark(n, nodes);
  if (!removed.empty()) {
    start_marks();
    for (const NodeSet* group : removed)
      for (const NodeIndex n : group->nodes) stamp[n] = generation;
    std::erase_if(nodes, [&](NodeIndex n) { return stamp[n] == generation; });
  }
  if (!keep_order) sort_nodes(nodes);
  return nodes;
}

std::vector<NodeIndex> Selections::Impl::nodes_of_surfaces(const Block& block,
                                                           const DecodedBlock& d) {
  std::vector<IdRef> missing;
  const auto all =
      named(id_list(d).positive, missing, [&](std::int64_t id) { return outline(id); });
  report_missing(RuleId::DK151, block, "surface", missing, 193);
  std::vector<NodeIndex> nodes;
  start_marks();
  for (const auto& surface : all)
    surface->segments.for_each([&](const Segment& segment) {
      for (const NodeIndex n : segment.nodes) mark(n, nodes);
    });
  return nodes;
}

std::vector<NodeIndex> Selections::Impl::nodes_of_lines(const Block& block, const DecodedBlock& d) {
  std::vector<IdRef> missing;
  const auto all = named(id_list(d).positive, missing, [&](std::int64_t id) { return line(id); });
  report_missing(RuleId::DK151, block, "line", missing, 193);
  std::vector<NodeIndex> nodes;
  start_marks();
  for (const LineSet* l : all)
    for (const Edge& edge : l->edges)
      for (const NodeIndex n : edge.nodes) mark(n, nodes);
  return nodes;
}

std::vector<NodeIndex> Selections::Impl::nodes_of_elements(const Block& block,
                                                           const DecodedBlock& d,
                                                           ElementKind kind) {
  const detail::FamilyName& name = detail::family_name(kind);
  const Elements& family = model->family(kind);
  std::vector<IdRef> missing;
  const IdList list = id_list(d);
  const auto get = [&](std::int64_t id) { return element_group(name, id); };
  const auto added = named(list.positive, missing, get);
  const auto removed = named(list.negative, missing, get);
  report_missing(RuleId::DK151, block, "element group", missing, 172);
  std::vector<NodeIndex> nodes;
  start_marks();
  for (const Indices* group : added)
    for (const std::uint32_t e : *group) add_element_nodes(family, e, nodes);
  if (!removed.empty()) {
    std::vector<NodeIndex> gone;
    start_marks();
    for (const Indices* group : removed)
      for (const std::uint32_t e : *group) add_element_nodes(family, e, gone);
    std::erase_if(nodes, [&](NodeIndex n) { return stamp[n] == generation; });
  }
  return nodes;
}

}  // namespace deck
