// Counts and lists the decisions of a scene by how exactly they were taken.
#include "report/accuracy_decisions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "report/shared/text_table.hpp"

namespace deck {
namespace {

/// Secondary and main nodes of a difference; a node or a segment, or two edges.
struct Sides {
  std::span<const NodeIndex> secondary, main;
};
Sides sides_of(const Contact& c, const DecisionDifference& d) {
  if (c.kind == ContactKind::edge_edge)
    return {c.secondary_edges[d.secondary].nodes, c.main_edges[d.main].nodes};
  return {std::span(&c.secondary[d.secondary].node, 1), c.main[d.main].nodes};
}

std::string ids_text(const Model& model, std::span<const NodeIndex> nodes, char between) {
  std::string out;
  NodeIndex last = no_index;
  for (const NodeIndex n : nodes) {
    if (n == last) continue;  // a triangle repeats its last node
    last = n;
    if (!out.empty()) out += between;
    out += std::to_string(model.node_id(n));
  }
  return out;
}

bool counts_differences(const DecisionReport& r) {
  return r.mode == Accuracy::robust || r.mode == Accuracy::exact;
}

std::string percent(std::uint64_t part, std::uint64_t all) {
  return fmt::format("{:.2g} %", 100.0 * static_cast<double>(part) / static_cast<double>(all));
}

const char* verdict(const DecisionDifference& d) {
  if (d.surface) return d.exact ? "lies on it" : "does not lie on it";
  return d.exact ? "in contact" : "not in contact";
}

}  // namespace

std::string decisions_text(const Scene& scene, std::size_t rows, bool always, bool color,
                           std::size_t width) {
  const DecisionReport& r = scene.decisions;
  if (r.pairs == 0 || (!always && r.contact_differs == 0)) return {};
  std::string out = fmt::format("Decisions ({}): {} pairs", to_string(r.mode), r.pairs);
  if (!counts_differences(r)) return out + " in plain double.\n";
  out += fmt::format(", {} ({}) needed more than double, {} exact arithmetic.", r.fallback,
                     percent(r.fallback, r.pairs), r.exact);
  const std::uint64_t differ = r.contact_differs + r.surface_differs;
  if (differ == 0) return out + " The solver's arithmetic decides all of them alike.\n";
  out += fmt::format(
      " The solver's arithmetic decides {} otherwise: {} about contact, {} about "
      "nodes exactly on a segment.\n",
      differ, r.contact_differs, r.surface_differs);
  TextTable table({{"interface", Align::right},
                   {"node/edge"},
                   {"segment/edge"},
                   {"exactly"},
                   {"gap", Align::right},
                   {"distance", Align::right},
                   {"the solver's", Align::right},
                   {"action"}});
  const std::size_t shown = std::min(rows, r.differences.size());
  for (std::size_t k = 0; k < shown; ++k) {
    const DecisionDifference& d = r.differences[k];
    const Contact& c = scene.contacts[d.contact];
    const Sides s = sides_of(c, d);
    table.row({std::to_string(c.inter->id), ids_text(*scene.model, s.secondary, '-'),
               ids_text(*scene.model, s.main, ' '), verdict(d), fmt::format("{}", d.gap),
               fmt::format("{}", d.exact_distance),
               std::isnan(d.solver_distance) ? "no number" : fmt::format("{}", d.solver_distance),
               to_string(d.action)});
  }
  if (shown > 0) out += table.fitted(width, color, 2, 2);
  if (shown > 0 && shown < differ) out += fmt::format("  … and {} more (--json)\n", differ - shown);
  return out;
}

}  // namespace deck
