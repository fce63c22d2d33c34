// Crossed elements as a table for people.
#include <fmt/format.h>

#include <map>

#include "deck/report/gaps.hpp"
#include "report/gaps_names.hpp"
#include "report/shared/text_table.hpp"

namespace deck {

NodeIndex first_node(const Scene& scene, const NamedPenetration& p) {
  const Contact& c = scene.contacts[p.contact];
  const std::uint32_t s = c.penetrations[p.row].secondary;
  return c.kind == ContactKind::node_segment ? c.secondary[s].node : c.secondary_edges[s].nodes[0];
}

std::vector<NodeIndex> first_nodes(const Scene& scene, const std::vector<NamedPenetration>& list) {
  std::vector<NodeIndex> out;
  out.reserve(list.size());
  for (const NamedPenetration& p : list) out.push_back(first_node(scene, p));
  return out;
}

ElementName edge_element(const Model& model, const Crossing& x) {
  const Elements& family = model.family(x.edge_kind);
  const std::uint32_t part = family.part[x.edge_element];
  return {x.edge_kind, x.edge_element, family.id[x.edge_element],
          part == no_index ? 0 : model.parts[part].id};
}

ElementName segment_element(const Scene& scene, const Crossing& x) {
  const MainSegment& m = scene.contacts[x.contact].main[x.main];
  return carrier_name(*scene.model, m.carrier, m.element);
}

std::string crossings_text(const Scene& scene, const std::vector<Crossing>& crossings,
                           const GapsTextOptions& options) {
  if (crossings.empty()) return "\nNo edge of the secondary side passes through a main segment.\n";
  const Model& model = *scene.model;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<const Crossing*>> by_parts;
  for (const Crossing& x : crossings)
    by_parts[{edge_element(model, x).part, segment_element(scene, x).part}].push_back(&x);
  TextTable table({{"part", Align::right},
                   {"through part", Align::right},
                   {"crossings", Align::right},
                   {"interface", Align::right},
                   {"for example edge"},
                   {"of element", Align::right},
                   {"through segment"},
                   {"of element", Align::right}});
  for (const auto& [parts, list] : by_parts) {
    const Crossing& x = *list.front();
    const Contact& c = scene.contacts[x.contact];
    const auto& n = c.main[x.main].nodes;
    std::string segment;
    for (std::size_t k = 0; k < (n[2] == n[3] ? 3U : 4U); ++k)
      segment += fmt::format("{}{}", k == 0 ? "" : " ", model.node_id(n[k]));
    table.row({fmt::format("{}", parts.first), fmt::format("{}", parts.second),
               fmt::format("{}", list.size()), fmt::format("{}", c.inter->id),
               fmt::format("{} {}", model.node_id(x.edge[0]), model.node_id(x.edge[1])),
               fmt::format("{}", edge_element(model, x).id), segment,
               fmt::format("{}", segment_element(scene, x).id)});
  }
  return fmt::format("\nCrossed elements: {}\n{}", crossings.size(),
                     table.fitted(options.width, options.color, 2, 2));
}

}  // namespace deck
