// Findings about initial penetrations and the effect of options on them.
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "base/shared/words.hpp"
#include "contact/shared/reported.hpp"
#include "lint/checks/geometry/geometry.hpp"
#include "model/shared/item_spans.hpp"

namespace deck::detail {
namespace {

const PenetrationRow& row_of(const GeometryRun& run, std::size_t i) {
  const auto& p = run.view.penetrations.places[i];
  return run.scene.contacts[p.contact].penetrations[p.row];
}

std::string part_text(std::int64_t part) {
  return part == 0 ? std::string("no part") : fmt::format("part {}", part);
}

NodeIndex node_of(const Contact& c, const PenetrationRow& r) {
  return c.kind == ContactKind::node_segment ? c.secondary[r.secondary].node
                                             : c.secondary_edges[r.secondary].nodes[0];
}

std::string secondary_text(const NamedPenetration& p) {
  return p.secondary[1] == 0 ? fmt::format("node {}", p.secondary[0])
                             : fmt::format("edge {} {}", p.secondary[0], p.secondary[1]);
}

std::string main_text(const NamedPenetration& p) {
  if (p.main[2] == 0) return fmt::format("edge {} {}", p.main[0], p.main[1]);
  const std::string fourth = p.main[3] == p.main[2] ? "" : fmt::format(" {}", p.main[3]);
  return fmt::format("segment {} {} {}{}", p.main[0], p.main[1], p.main[2], fourth);
}

/// Ids of the nodes of one contact selected by a predicate, without duplicates.
template <class Pick>
std::vector<std::int64_t> nodes_where(const GeometryRun& run, const Contact& c, const Pick& pick) {
  std::set<std::int64_t> ids;
  for (const PenetrationRow& r : c.penetrations)
    if (pick(r)) ids.insert(run.model().node_id(node_of(c, r)));
  return {ids.begin(), ids.end()};
}

/// The solver's action on a group of pairs, in words.
const char* treatment(PenetrationAction action) {
  using Action = PenetrationAction;
  static constexpr std::pair<Action, const char*> treatments[] = {
      {Action::node_stiffness_zero, "the nodes are switched off"},
      {Action::segment_stiffness_zero, "the segments are switched off"},
      {Action::node_moved, "the nodes are moved"},
      {Action::gap_reduced, "their gaps are reduced"},
      {Action::edge_stiffness_zero, "the edges are switched off"},
      {Action::ignored, "the solver ignores them at the start"},
      {Action::offset_stored, "the solver subtracts these depths from all later ones"},
      {Action::initial_force, "they start with contact forces"},
      {Action::removed_tied, "ties hold them"}};
  for (const auto& [known, text] : treatments)
    if (known == action) return text;
  return "the solver does nothing about them: they start with contact forces";
}

/// The action on rows of one contact, from the stored actions, not from Inacti.
std::string treatment(const GeometryRun& run, const Contact& c,
                      const std::vector<std::uint32_t>& rows) {
  std::array<std::size_t, penetration_actions> by_action{};
  std::size_t stops = 0;
  for (const std::uint32_t i : rows) {
    const PenetrationAction action = row_of(run, i).action;
    stops += stops_solver(action);
    ++by_action[static_cast<std::size_t>(action)];
  }
  std::string out;
  if (stops > 0)
    out = fmt::format("{} the solver (error {})",
                      stops == 1 ? "1 pair stops" : count_text(stops, "pair") + " stop",
                      on_surface_error(c));
  for (std::size_t a = 0; a < by_action.size(); ++a) {
    const auto action = static_cast<PenetrationAction>(a);
    if (by_action[a] == 0 || stops_solver(action)) continue;
    if (by_action[a] == rows.size()) return treatment(action);
    out += fmt::format("{}{}: {}", out.empty() ? "" : ", ", count_text(by_action[a], "pair"),
                       action_words(action));
  }
  return out;
}

/// Message number of the solver's warning with the number of pairs.
int counting_warning(const GeometryRun& run, const Contact& c) {
  const int by_inacti = c.inacti == 0 ? 0 : c.inacti == 5 ? 1 : 2;
  if (c.inter->type == 24) return std::array{1184, 1186, 1185}[static_cast<std::size_t>(by_inacti)];
  const bool edges = c.kind == ContactKind::edge_edge;
  if (c.inter->type != 25) return edges ? 499 : 343;
  const bool both =
      std::any_of(run.scene.contacts.begin(), run.scene.contacts.end(), [&](const Contact& other) {
        return other.inter == c.inter && other.kind != c.kind && !other.penetrations.empty();
      });
  if (both) return 343;  // its first number is that of the edges
  const std::int64_t iedge = static_cast<const InterType25*>(c.inter)->Iedge.value;
  return edges ? 499 : iedge == 0 || iedge == 1000 ? 343 : 1166 + by_inacti;
}

/// One finding per contact and pair of parts, with the deepest places.
void check_depths(const GeometryRun& run) {
  struct PenetrationGroup {
    std::vector<std::uint32_t> rows;  // deepest first, as in the view
    std::set<std::uint32_t> distinct;
    std::vector<std::pair<std::uint32_t, std::size_t>> noted;  // row, position in `nodes`
  };
  std::map<std::tuple<std::uint32_t, std::int64_t, std::int64_t>, PenetrationGroup> groups;
  std::vector<NodeIndex> nodes;
  for (std::uint32_t i = 0; i < run.view.penetrations.size(); ++i) {
    const std::uint32_t contact = run.view.penetrations.places[i].contact;
    const auto [secondary, main] = run.view.penetrations.elements(i);
    PenetrationGroup& g = groups[{contact, secondary.part, main.part}];
    g.rows.push_back(i);
    if (!g.distinct.insert(row_of(run, i).secondary).second || g.noted.size() == 3) continue;
    g.noted.emplace_back(i, nodes.size());
    nodes.push_back(node_of(run.scene.contacts[contact], row_of(run, i)));
  }
  const std::vector<Span> spans = node_spans(run.model(), nodes);
  for (const auto& [key, group] : groups) {
    const auto& [contact, from, to] = key;
    const Contact& c = run.scene.contacts[contact];
    const NamedPenetration& worst = run.view.penetrations[group.rows.front()];
    const PenetrationRow& r = row_of(run, group.rows.front());
    const char* const item = !c.points.empty()                  ? "edge point"
                             : c.kind == ContactKind::edge_edge ? "edge"
                                                                : "node";
    Finding& d = run.report(
        RuleId::DK301, c, "Inacti",
        fmt::format("{} of {} {} within the gap of {} ({}), deepest {} of a gap of {} "
                    "between {} and {}; {}",
                    count_text(group.distinct.size(), item), part_text(from),
                    group.distinct.size() == 1 ? "lies" : "lie", part_text(to),
                    count_text(group.rows.size(), "pair"), length_text(r.depth), length_text(r.gap),
                    secondary_text(worst), main_text(worst), treatment(run, c, group.rows)),
        r.depth);
    d.reference = rule_of(RuleId::DK301).message(counting_warning(run, c));
    for (const auto& [i, k] : group.noted) {
      const NamedPenetration& p = run.view.penetrations[i];
      d.notes.emplace_back(spans[k], fmt::format("{} is {} deep", secondary_text(p),
                                                 length_text(row_of(run, i).depth)));
    }
  }
}

/// Nodes of a TYPE10 that are untied at the start.
void check_untied(const GeometryRun& run, std::uint32_t contact) {
  const Contact& c = run.scene.contacts[contact];
  const std::vector<std::uint32_t> untied = untied_secondary(c);
  if (untied.empty()) return;
  std::vector<std::int64_t> free;
  const NodeIndex first = c.secondary[untied.front()].node;
  for (const std::uint32_t s : untied) free.push_back(run.model().node_id(c.secondary[s].node));
  std::sort(free.begin(), free.end());
  Finding& d = run.report(
      RuleId::DK308, c, "Gap",
      fmt::format("{} of {} {} not tied at the start, because no segment is within the gap of "
                  "{:.6g}: {}",
                  count_text(free.size(), "node"), c.secondary.size(), are(free.size()), c.gapmin,
                  list_text(free)),
      free.size());
  d.notes.emplace_back(run.model().node_span(first), "one of the nodes");
}

void check_on_surface(const GeometryRun& run, const Contact& c) {
  if (c.kind == ContactKind::edge_edge) return;
  const auto nodes = nodes_where(run, c, [](const PenetrationRow& r) { return r.on_surface; });
  if (nodes.empty()) return;
  const int error = on_surface_error(c);
  Finding& d = run.report(
      error != 0 ? RuleId::DK302 : RuleId::DK303, c, "Inacti",
      fmt::format("{} {} exactly on a main segment: {}", count_text(nodes.size(), "node"),
                  nodes.size() == 1 ? "lies" : "lie", list_text(nodes)),
      nodes.size());
  if (error != 0) d.reference = rule_of(RuleId::DK302).message(error);
}

void check_switched_off(const GeometryRun& run, const Contact& c) {
  if (c.fpenmax == 0 || c.inacti == 1 || c.is_tied_contact()) return;
  const auto nodes = nodes_where(run, c, [](const PenetrationRow& r) {
    return r.action == PenetrationAction::node_stiffness_zero;
  });
  if (nodes.empty()) return;
  run.report(RuleId::DK304, c, "Fpenmax",
             fmt::format("Fpenmax = {:.6g} takes {} out of the contact: {}", c.fpenmax,
                         count_text(nodes.size(), "node"), list_text(nodes)),
             nodes.size());
}

void check_moved_springs(const GeometryRun& run, const Contact& c) {
  if (c.inacti != 3 || c.kind == ContactKind::edge_edge) return;
  const Elements& springs = run.model().spring;
  if (springs.size() == 0) return;
  const std::set<NodeIndex> held(springs.nodes.begin(), springs.nodes.end());
  const auto nodes = nodes_where(run, c, [&](const PenetrationRow& r) {
    return r.moved_by != std::array<double, 3>{} && held.contains(c.secondary[r.secondary].node);
  });
  if (nodes.empty()) return;
  run.report(RuleId::DK305, c, "Inacti",
             fmt::format("Inacti = 3 moves {} of springs: {}", count_text(nodes.size(), "node"),
                         list_text(nodes)),
             nodes.size());
}

void check_deep_edges(const GeometryRun& run, const Contact& c) {
  if (c.kind != ContactKind::edge_edge || (c.inacti != 5 && c.inacti != 6)) return;
  std::size_t edges = 0;
  const PenetrationRow* worst = nullptr;
  std::set<std::uint32_t> seen;
  for (const PenetrationRow& r : c.penetrations) {
    if (r.action != PenetrationAction::edge_stiffness_zero) continue;
    edges += seen.insert(r.secondary).second;
    if (worst == nullptr || r.depth > worst->depth) worst = &r;
  }
  if (worst == nullptr) return;
  const auto id = [&](NodeIndex n) { return run.model().node_id(n); };
  const auto &s = c.secondary_edges[worst->secondary].nodes, &m = c.main_edges[worst->main].nodes;
  run.report(RuleId::DK306, c, "Inacti",
             fmt::format("{} {} switched off, less than 0.5 % of the gap is left; edge {} {} is "
                         "{:.6g} from edge {} {}, gap {:.6g}",
                         count_text(edges, "secondary edge"), are(edges), id(s[0]), id(s[1]),
                         worst->distance, id(m[0]), id(m[1]), worst->gap),
             edges);
}

/// Tables in the listing at high Ipri.
void check_tables(const GeometryRun& run) {
  constexpr std::int64_t pairs_from = 5, segments_from = 10;  // Ipri
  const Cell level = printout_level(run.context);
  if (level.integer < pairs_from) return;
  const auto report = [&](const Contact& c, int message, std::string what) {
    Finding& d = run.report(RuleId::DK606, c, "", std::move(what));
    d.reference = rule_of(RuleId::DK606).message(message);
    d.notes.emplace_back(level.span, "asks for the table");
  };
  for (const Contact& c : run.scene.contacts) {
    const bool edges = c.kind == ContactKind::edge_edge;
    const auto pairs = std::count_if(c.penetrations.begin(), c.penetrations.end(),
                                     [](const PenetrationRow& r) { return !r.on_surface; });
    if (!edges && pairs > 0)
      report(c, 1164,
             fmt::format("the listing has a table of its {} (Ipri = {})",
                         count_text(static_cast<std::size_t>(pairs), "penetrating pair"),
                         level.integer));
    if (level.integer >= segments_from && c.reoriented_segments > 0)
      report(c, 3024,
             fmt::format(
                 "the listing has a table of its {} (Ipri = {})",
                 count_text(static_cast<std::size_t>(c.reoriented_segments), "turned main segment"),
                 level.integer));
  }
}

}  // namespace

void check_penetrations(const GeometryRun& run) {
  check_depths(run);
  for (std::uint32_t i = 0; i < run.scene.contacts.size(); ++i) {
    const Contact& c = run.scene.contacts[i];
    check_untied(run, i);
    check_on_surface(run, c);
    check_switched_off(run, c);
    check_moved_springs(run, c);
    check_deep_edges(run, c);
  }
  check_tables(run);
}

}  // namespace deck::detail
