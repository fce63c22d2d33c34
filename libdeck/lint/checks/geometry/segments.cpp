// Findings about main segments and edges without the intended effect, and crossed elements.
#include <algorithm>
#include <map>

#include "contact/shared/node_elements.hpp"
#include "deck/contacts.hpp"
#include "lint/checks/geometry/geometry.hpp"
#include "model/shared/buckets.hpp"

namespace deck::detail {
namespace {

std::string_view main_field(const Contact& c) { return traits_of(*c.inter).main.field; }

/// Reports a rule about some main segments at the first; `one`: text for a single segment.
Finding* about_segments(const GeometryRun& run, RuleId rule, const Contact& c,
                        const std::vector<std::uint32_t>& which, std::string_view one,
                        std::string_view many) {
  if (which.empty()) return nullptr;
  const MainSegment& m = c.main[which.front()];
  const ElementName e = carrier_name(run.model(), m.carrier, m.element);
  Finding& d = run.report(
      rule, c, main_field(c),
      fmt::format("{} of {} {}, for example {} ({})", count_text(which.size(), "segment"),
                  c.main.size(), which.size() == 1 ? one : many, nodes_text(run.model(), m),
                  element_text(e)),
      which.size());
  d.notes.emplace_back(run.model().node_span(m.nodes[0]), "first node of that segment");
  return &d;
}

bool has_material(const Model& model, const MainSegment& m) {
  const Elements* family = elements_of(model, m.carrier);
  if (family == nullptr || m.element == no_index) return true;
  const std::uint32_t part = family->part[m.element];
  return part == no_index || model.parts[part].mat_id != 0;
}

void check_stiffness(const GeometryRun& run, const Contact& c) {
  std::vector<std::uint32_t> weak, no_material;
  for (std::uint32_t i = 0; i < c.main.size(); ++i) {
    const MainSegment& m = c.main[i];
    if (m.carrier == Carrier::none) continue;
    if (!has_material(run.model(), m))
      no_material.push_back(i);
    else if (m.stiffness == 0)
      weak.push_back(i);
  }
  about_segments(run, RuleId::DK320, c, weak, "has no stiffness and is left out",
                 "have no stiffness and are left out");
  about_segments(run, RuleId::DK321, c, no_material, "belongs to an element without material",
                 "belong to elements without material");
  about_segments(run, RuleId::DK322, c, c.no_carrier, "belongs to no element",
                 "belong to no element");
  for (const bool main : {true, false}) {
    const auto& edges = main ? c.main_edges : c.secondary_edges;
    std::size_t count = 0;
    const ContactEdge* first = nullptr;
    for (const ContactEdge& e : edges) {
      if (e.carrier != Carrier::none) continue;
      ++count;
      if (first == nullptr) first = &e;
    }
    if (first == nullptr) continue;
    Finding& d = run.report(
        RuleId::DK322, c, main ? main_field(c) : traits_of(*c.inter).secondary.field,
        fmt::format("{} of {} on the {} side {} to no element, for example {} {}",
                    count_text(count, "edge"), edges.size(), main ? "main" : "secondary",
                    count == 1 ? "belongs" : "belong", run.model().node_id(first->nodes[0]),
                    run.model().node_id(first->nodes[1])),
        count);
    // For lines the solver swaps the texts of the two messages.
    if (main) d.reference = rule_of(RuleId::DK322).message(481);
  }
}

void check_shape(const GeometryRun& run, const Contact& c) {
  about_segments(run, RuleId::DK323, c, c.degenerate, "has no area or crosses itself",
                 "have no area or cross themselves");
  if (c.repaired_segments > 0)
    run.report(RuleId::DK324, c, main_field(c),
               fmt::format("{} with a node given twice, taken for triangles",
                           count_text(static_cast<std::size_t>(c.repaired_segments), "segment")),
               c.repaired_segments);
  if (c.reoriented_segments > 0)
    run.report(RuleId::DK325, c, main_field(c),
               fmt::format("{} of {} turned to face outward from their solids",
                           count_text(static_cast<std::size_t>(c.reoriented_segments), "segment"),
                           c.main.size()),
               c.reoriented_segments);
}

void check_duplicates(const GeometryRun& run, const Contact& c) {
  struct Corners {
    std::array<NodeIndex, 4> nodes;  // ascending
    std::uint32_t segment;
  };
  std::vector<Corners> all;
  all.reserve(c.main.size());
  for (std::uint32_t i = 0; i < c.main.size(); ++i) {
    all.push_back({c.main[i].nodes, i});
    std::array<NodeIndex, 4>& n = all.back().nodes;
    // A triangle repeats any of its nodes.
    if (n[2] == n[3]) n[3] = no_index;
    std::sort(n.begin(), n.end());
  }
  sort_by_bucket(
      all, [](const Corners& s) { return s.nodes[0]; },
      [](const Corners& s, const Corners& t) { return s.nodes < t.nodes; });
  std::vector<std::uint32_t> twice;
  for (std::size_t i = 1; i < all.size(); ++i)
    if (all[i].nodes == all[i - 1].nodes) twice.push_back(all[i].segment);
  std::sort(twice.begin(), twice.end());
  Finding* d =
      about_segments(run, RuleId::DK326, c, twice, "repeats another one", "repeat another one");
  const auto of_solids = [&](std::uint32_t i) { return c.main[i].carrier == Carrier::solid; };
  if (d != nullptr && std::all_of(twice.begin(), twice.end(), of_solids))
    d->help =
        "Write /EXT instead of /ALL in the surface: its solids touch, and the inner faces count "
        "twice.";
}

void check_dropped(const GeometryRun& run, const Contact& c) {
  if (!c.dropped) return;
  run.report(RuleId::DK327, c, "Iedge",
             fmt::format("one of its sides has no edges, so it has no contact between edges"));
}

void check_solids(const GeometryRun& run, const Contact& c) {
  about_segments(run, RuleId::DK329, c, c.crowded, "belongs to more than two solids",
                 "belong to more than two solids");
  about_segments(run, RuleId::DK330, c, c.inside_solids, "lies inside another solid",
                 "lie inside another solid");
  const Deck& deck = run.context.deck;
  const auto fill = std::find_if(deck.blocks.begin(), deck.blocks.end(), [](const Block& b) {
    return b.header.starts_with("/INIBRI/FILL");
  });
  if (fill == deck.blocks.end() || c.factor < 0) return;
  std::vector<std::uint32_t> solid;
  for (std::uint32_t i = 0; i < c.main.size(); ++i)
    if (c.main[i].carrier == Carrier::solid) solid.push_back(i);
  if (Finding* d = about_segments(run, RuleId::DK331, c, solid, "is on a solid", "are on solids"))
    d->notes.emplace_back(fill->header_span, "the fill fractions");
}

/// One finding per pair of parts, in the first interface with both.
void check_crossings(const GeometryRun& run) {
  struct SegmentGroup {
    const Crossing* first = nullptr;
    std::uint64_t places = 0;
  };
  const Model& model = run.model();
  const auto part_of = [&](const Crossing& x) -> std::int64_t {
    const std::uint32_t p = model.family(x.edge_kind).part[x.edge_element];
    return p == no_index ? 0 : model.parts[p].id;
  };
  std::map<std::pair<std::int64_t, std::int64_t>, SegmentGroup> groups;
  for (const Crossing& x : run.crossings) {
    const Contact& c = run.scene.contacts[x.contact];
    const MainSegment& m = c.main[x.main];
    const std::int64_t a = part_of(x), b = carrier_name(model, m.carrier, m.element).part;
    SegmentGroup& g = groups[{std::min(a, b), std::max(a, b)}];
    if (g.first == nullptr) g.first = &x;
    ++g.places;
  }
  for (const auto& [parts, g] : groups) {
    const Crossing& x = *g.first;
    const Contact& c = run.scene.contacts[x.contact];
    std::string message = fmt::format(
        "elements of part {} and part {} pass through each other in {}; edge {} {} goes "
        "through {}",
        parts.first, parts.second, count_text(g.places, "place"), model.node_id(x.edge[0]),
        model.node_id(x.edge[1]), nodes_text(model, c.main[x.main]));
    Finding& d = run.report(RuleId::DK328, c, main_field(c), std::move(message), g.places);
    d.notes.emplace_back(model.node_span(x.edge[0]), "one end of the edge");
  }
}

}  // namespace

void check_segments(const GeometryRun& run) {
  for (const Contact& c : run.scene.contacts) {
    // Shells have a segment on both sides in TYPE24 and TYPE25.
    if (!is_type24_or_25(c.type)) {
      check_stiffness(run, c);
      check_duplicates(run, c);
    }
    check_shape(run, c);
    check_dropped(run, c);
    check_solids(run, c);
  }
  check_crossings(run);
}

}  // namespace deck::detail
