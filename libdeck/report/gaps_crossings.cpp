// Names of what the reports of contacts show; crossed elements, and decisions of a scene by how
// exactly they were taken, as tables for people.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "deck/report/gaps.hpp"
#include "report/terminal/words.hpp"

namespace deck {

std::string ids_text(const Model& model, std::span<const NodeIndex> nodes, char between) {
  std::string out;
  NodeIndex last = no_index;
  for (const NodeIndex n : nodes) {
    if (n == last) continue;
    last = n;
    if (!out.empty()) out += between;
    out += std::to_string(model.node_id(n));
  }
  return out;
}

PairNodes pair_nodes(const Contact& c, std::uint32_t secondary, std::uint32_t main) {
  if (c.kind == ContactKind::edge_edge)
    return {c.secondary_edges[secondary].nodes, c.main_edges[main].nodes};
  return {std::span(&c.secondary[secondary].node, 1), c.main[main].nodes};
}

NodeIndex first_node(const Scene& scene, const NamedPenetration& p) {
  const Contact& c = scene.contacts[p.contact];
  const PenetrationRow& row = c.penetrations[p.row];
  return pair_nodes(c, row.secondary, row.main).secondary[0];
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
  TextTable table({">part", ">through part", ">crossings", ">interface", "for example edge",
                   ">of element", "through segment", ">of element"});
  for (const auto& [parts, list] : by_parts) {
    const Crossing& x = *list.front();
    const Contact& c = scene.contacts[x.contact];
    table.row({std::to_string(parts.first), std::to_string(parts.second),
               std::to_string(list.size()), std::to_string(c.inter->id),
               ids_text(model, x.edge, ' '), std::to_string(edge_element(model, x).id),
               ids_text(model, c.main[x.main].nodes, ' '),
               std::to_string(segment_element(scene, x).id)});
  }
  return fmt::format("\nCrossed elements: {}\n{}", crossings.size(),
                     table.fitted(options.width, options.color, 2, 2));
}

namespace {

const char* decision(const DecisionDifference& d) {
  if (d.surface) return d.exact ? "lies on it" : "does not lie on it";
  return d.exact ? "in contact" : "not in contact";
}

}  // namespace

std::string decisions_text(const Scene& scene, std::size_t rows, bool always, bool color,
                           std::size_t width) {
  const DecisionReport& r = scene.decisions;
  if (r.pairs == 0 || (!always && r.contact_differs == 0)) return {};
  std::string out = fmt::format("Decisions ({}): {} pairs", to_string(r.mode), r.pairs);
  if (r.mode != Accuracy::robust && r.mode != Accuracy::exact) return out + " in plain double.\n";
  out +=
      fmt::format(", {} ({:.2g} %) needed more than double, {} exact arithmetic.", r.fallback,
                  100.0 * static_cast<double>(r.fallback) / static_cast<double>(r.pairs), r.exact);
  const std::uint64_t differ = r.contact_differs + r.surface_differs;
  if (differ == 0) return out + " The solver's arithmetic decides all of them alike.\n";
  out += fmt::format(
      " The solver's arithmetic decides {} otherwise: {} about contact, {} about "
      "nodes exactly on a segment.\n",
      differ, r.contact_differs, r.surface_differs);
  TextTable table({">interface", "node/edge", "segment/edge", "exactly", ">gap", ">distance",
                   ">the solver's", "action"});
  const std::size_t shown = std::min(rows, r.differences.size());
  for (std::size_t k = 0; k < shown; ++k) {
    const DecisionDifference& d = r.differences[k];
    const Contact& c = scene.contacts[d.contact];
    const PairNodes nodes = pair_nodes(c, d.secondary, d.main);
    table.row({std::to_string(c.inter->id), ids_text(*scene.model, nodes.secondary, '-'),
               ids_text(*scene.model, nodes.main, ' '), decision(d), fmt::format("{}", d.gap),
               fmt::format("{}", d.exact_distance),
               std::isnan(d.solver_distance) ? "no number" : fmt::format("{}", d.solver_distance),
               to_string(d.action)});
  }
  if (shown > 0) out += table.fitted(width, color, 2, 2);
  if (shown > 0 && shown < differ) out += fmt::format("  … and {} more (--json)\n", differ - shown);
  return out;
}

}  // namespace deck
