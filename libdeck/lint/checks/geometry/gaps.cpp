// Findings about gaps compared with mesh size and thickness.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/shared/words.hpp"
#include "contact/shared/node_elements.hpp"
#include "contact/shared/scene_steps.hpp"
#include "lint/checks/geometry/geometry.hpp"

namespace deck::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double side_length(const Coordinates& x, NodeIndex a, NodeIndex b) {
  const double dx = x.x[b] - x.x[a], dy = x.y[b] - x.y[a], dz = x.z[b] - x.z[a];
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

/// A side of the main surface that is short compared with its gap.
struct ShortSide {
  double length = infinity, gap = 0;
  NodeIndex a = no_index, b = no_index;
  std::size_t item = 0, count = 0;

  void test_side(const Coordinates& x, NodeIndex n1, NodeIndex n2, double g, std::size_t i,
                 bool& hit) {
    if (n1 == n2) return;
    const double l = side_length(x, n1, n2);
    if (!(l > 0) || !(g > 0.5 * l)) return;
    count += !hit;
    hit = true;
    if (!(l / g < length / gap) && gap != 0) return;
    length = l;
    gap = g;
    a = n1;
    b = n2;
    item = i;
  }
};

/// "Gapmin = 2 (card)", "the gap 2 (mean thickness ...)"
std::string gap_text(const Contact& c, double gap) {
  if (gap != c.gapmin) return "the variable gap " + length_text(gap);
  return fmt::format(
      "{} = {} ({})", gap_field(c), length_text(gap),
      c.gapmin_origin == GapminOrigin::card ? "from the card" : to_string(c.gapmin_origin));
}

void report_short_side(const GeometryRun& run, const Contact& c, const ShortSide& worst,
                       const std::string& where, const ElementName& element, std::size_t items,
                       std::string_view item) {
  if (worst.count == 0) return;
  const Model& model = run.model();
  Finding& d = run.report(
      RuleId::DK310, c, gap_field(c),
      fmt::format("{} is more than half of {} {} {}{} ({}), which is {:.6g} long; this is so at "
                  "{} of {}",
                  gap_text(c, worst.gap), where.empty() ? "edge" : "side", model.node_id(worst.a),
                  model.node_id(worst.b), where, element_text(element), worst.length,
                  count_text(worst.count, item), items),
      worst.gap / worst.length);
  if (c.igap != 0 && where.size() > 0) d.reference = rule_of(RuleId::DK310).message(477);
  d.notes.emplace_back(model.node_span(worst.a), "one end of it");
}

/// Largest gap and shortest side are at different places; the solver warns nevertheless.
void report_apart(const GeometryRun& run, const Contact& c) {
  if (c.kind != ContactKind::node_segment || c.igap == 0) return;
  if (!(c.shortest_side > 0) || !(c.max_gap > 0.5 * c.shortest_side)) return;
  Finding& d = run.report(RuleId::DK310, c, gap_field(c),
                          fmt::format("the largest gap {:.6g} is more than half of the "
                                      "shortest main side {:.6g}, but at another place",
                                      c.max_gap, c.shortest_side),
                          c.max_gap / c.shortest_side);
  d.severity = Severity::info;
  d.reference = rule_of(RuleId::DK310).message(477);
}

/// The solver compares the largest gap with the shortest side of the surface; this check compares
/// both at the same place.
void check_short_sides(const GeometryRun& run, const Contact& c) {
  if (c.igap == 3 || c.irem_gap == 2) return;
  const bool none = c.max_gap <= 0.5 * c.shortest_side;
  const Coordinates& x = run.scene.coordinates;
  const Model& model = run.model();
  double thickest = 0;
  for (const SecondaryNode& s : c.secondary) thickest = std::max(thickest, s.gap);
  ShortSide worst;
  for (std::size_t i = 0; !none && i < c.main.size(); ++i) {
    bool hit = false;
    const auto& n = c.main[i].nodes;
    const double gap = c.gap_rule(thickest, c.main[i].gap);
    for (std::size_t k = 0; k < 4; ++k) worst.test_side(x, n[k], n[(k + 1) % 4], gap, i, hit);
  }
  if (worst.count != 0) {
    const MainSegment& m = c.main[worst.item];
    report_short_side(run, c, worst, " of segment " + nodes_text(model, m),
                      carrier_name(model, m.carrier, m.element), c.main.size(), "segment");
  } else {
    report_apart(run, c);
  }
  // For edge contacts both sides count.
  for (const bool main : {true, false}) {
    const auto& edges = main ? c.main_edges : c.secondary_edges;
    const auto& others = main ? c.secondary_edges : c.main_edges;
    double other = 0;
    for (const ContactEdge& e : others) other = std::max(other, e.gap);
    ShortSide shortest;
    for (std::size_t i = 0; !none && i < edges.size(); ++i) {
      bool hit = false;
      const ContactEdge& e = edges[i];
      shortest.test_side(x, e.nodes[0], e.nodes[1], c.gap_rule(other, e.gap), i, hit);
    }
    if (shortest.count == 0) continue;
    const ContactEdge& e = edges[shortest.item];
    report_short_side(run, c, shortest, {}, carrier_name(model, e.carrier, e.element), edges.size(),
                      main ? "main edge" : "secondary edge");
  }
}

void check_upper_bound(const GeometryRun& run, const Contact& c) {
  if (c.gapmin_origin == GapminOrigin::card || c.igap < 2 || !(c.gapmin > c.gapmax)) return;
  run.report(RuleId::DK311, c, "Gapmax",
             fmt::format("the default Gapmin {:.6g} ({}) is above Gapmax = {:.6g}", c.gapmin,
                         to_string(c.gapmin_origin), c.gapmax));
}

void check_thickness(const GeometryRun& run, const Contact& c) {
  if (c.igap != 0 || c.kind == ContactKind::edge_edge || c.type != 7) return;
  if (c.gapmin_origin != GapminOrigin::card) return;
  double thickest = 0;
  for (const MainSegment& m : c.main)
    thickest = std::max(thickest, detail::contact_thickness(run.model(), m));
  if (thickest == 0 || !(c.gapmin > thickest)) return;
  run.report(RuleId::DK312, c, gap_field(c),
             fmt::format("{} is more than the thickest main shell ({:.6g})", gap_text(c, c.gapmin),
                         thickest),
             c.gapmin / thickest);
}

void check_radiation(const GeometryRun& run, const Contact& c) {
  if (!(c.drad > c.shortest_side) || !(c.shortest_side > 0)) return;
  run.report(RuleId::DK313, c, "Drad",
             fmt::format("the radiation distance {:.6g} is longer than the shortest main side "
                         "({:.6g})",
                         c.drad, c.shortest_side),
             c.drad / c.shortest_side);
}

void check_no_gap(const GeometryRun& run, const Contact& c) {
  if (c.gapmin > 0 || c.dropped) return;
  if (c.main_empty()) return;
  Finding& d = run.report(
      RuleId::DK314, c, gap_field(c),
      fmt::format("the default gap is {:.6g} ({})", c.gapmin, to_string(c.gapmin_origin)));
  if (c.igap != 0) d.reference = rule_of(RuleId::DK314).message(786);
}

void check_line_removal(const GeometryRun& run, const Contact& c) {
  if (c.kind != ContactKind::edge_edge || c.irem_gap != 2) return;
  const auto same = [](const ContactEdge& a, const ContactEdge& b) { return a.nodes == b.nodes; };
  if (std::equal(c.main_edges.begin(), c.main_edges.end(), c.secondary_edges.begin(),
                 c.secondary_edges.end(), same))
    return;
  run.report(RuleId::DK315, *c.inter, "Irem_gap",
             fmt::format("{} has Irem_gap = 2 and two different lists of edges ({} secondary, {} "
                         "main)",
                         name_of(c), c.secondary_edges.size(), c.main_edges.size()));
}

}  // namespace

void check_gaps(const GeometryRun& run) {
  for (const Contact& c : run.scene.contacts) {
    // These types have no minimum gap, and the solver compares their gaps with nothing.
    if (is_type24_or_25(c.type)) continue;
    check_short_sides(run, c);
    check_upper_bound(run, c);
    check_thickness(run, c);
    check_radiation(run, c);
    check_no_gap(run, c);
    check_line_removal(run, c);
  }
}

}  // namespace deck::detail
