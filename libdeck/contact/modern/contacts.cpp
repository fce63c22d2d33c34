// TYPE24 and TYPE25 as contacts of the scene: nodes against segments, and edges where the card
// wants them.
#include <algorithm>
#include <cmath>

#include "base/shared/parallel.hpp"
#include "contact/modern/parts.hpp"
#include "contact/rules/actions.hpp"
#include "contact/shared/filtered.hpp"
#include "deck/text.hpp"

namespace deck {

const char* to_string(SegmentKind kind) {
  static constexpr const char* words[] = {"solid", "shell", "shell-opposite", "coat",
                                          "coat-opposite"};
  return words[static_cast<std::size_t>(kind)];
}

}  // namespace deck

namespace deck::detail::modern {
namespace {

Contact head(const InterBase& inter, const Settings& set, ContactKind kind) {
  Contact c;
  c.inter = &inter;
  c.type = inter.type;
  c.kind = kind;
  c.role = kind == ContactKind::node_segment ? ContactRole::primary : ContactRole::edges;
  c.istf = set.istf;
  c.igap = set.igap;
  c.inacti = set.inacti;
  c.factor = set.factor;
  c.gap_scale = set.scale;
  c.mesh_fraction = set.mesh_fraction;
  c.gapmax = std::max(set.cap_s, set.cap_m);
  c.gap_rule = PairGap::from_igap(set.local() ? 3 : 1, 0);
  return c;
}

void list_sides(SceneContext& context, const Sides& s, Contact& out) {
  const int threads = effective_threads(context.options.threads);
  out.secondary.reserve(s.nodes.size());
  out.main.reserve(s.count());
  for (const SideNode& n : s.nodes) {
    SecondaryNode node;
    node.node = n.node;
    node.gap = n.gap;
    node.length = n.length;
    out.secondary.push_back(node);
  }
  out.main.resize(s.count());
  out.segment_kinds.resize(s.count());
  parallel_parts(threads, s.count(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Face f = s.face(static_cast<std::uint32_t>(i));
      MainSegment& m = out.main[i];
      m.nodes = f.nodes;
      m.carrier = f.carrier;
      m.element = f.element;
      m.stiffness = f.stiffness;
      m.gap = f.gap;
      m.thickness = 2 * f.own_gap;
      m.length = f.length;
      out.segment_kinds[i] = f.kind;
    }
  });
  out.shortest_side = s.shortest;
  out.max_gap = s.largest;
  out.reoriented_segments = s.reoriented;
  out.crowded = s.crowded;
}

/// The row of a penetration of a node or an edge.
template <class Penetration>
PenetrationRow row_of(const Settings& set, const Penetration& p, std::uint32_t secondary,
                      std::uint32_t main) {
  PenetrationRow row;
  row.secondary = secondary;
  row.main = main;
  row.depth = p.penetration;
  row.gap = p.gap;
  row.distance = p.distance;
  row.normal = {p.normal.x, p.normal.y, p.normal.z};
  act_on_modern(set.type, set.inacti, row);
  return row;
}

/// What was decided of a pair, in its row; one that is a penetration to the solver only, or not to
/// the solver, is noted. False: it is no row.
template <class Penetration>
bool settle(Accuracy accuracy, PairJudge& judge, const Penetration& p, PenetrationRow& row) {
  const bool exact = accuracy == Accuracy::exact;
  row.in_contact = p.in_contact;
  if (!(exact ? p.in_contact : p.solver_acts)) {
    row.action = PenetrationAction::none;
    row.p0 = 0;
  }
  if (p.in_contact == p.solver_acts) return true;
  DecisionDifference d;
  d.secondary = row.secondary;
  d.main = row.main;
  d.exact = p.in_contact;
  d.gap = p.gap;
  d.solver_distance = p.solver_distance;
  d.exact_distance = p.exact_distance;
  d.action = row.action;
  judge.note(d);
  return p.in_contact || !exact;
}

void list_penetrations(SceneContext& context, const Sides& s, const Found& found, Contact& out) {
  DecisionReport decisions = found.decisions;
  PairJudge judge(context.options.accuracy, decisions);
  out.penetrations.reserve(found.penetrations.size());
  std::vector<bool> held(found.penetrations.size(), false);
  if (s.set.irem_i2 == 1 && !found.penetrations.empty())
    held = held_by_ties(context, s, found.penetrations);
  for (std::size_t i = 0; i < found.penetrations.size(); ++i) {
    const NodePenetration& p = found.penetrations[i];
    PenetrationRow row = row_of(s.set, p, p.node, p.face);
    if (held[i] && s.set.inacti == 5) {
      row.action = PenetrationAction::removed_tied;
      row.p0 = 0;
    }
    if (settle(context.options.accuracy, judge, p, row)) out.penetrations.push_back(row);
  }
  out.candidates = found.candidates;
  out.removed_pairs = found.removed;
  out.largest_accepted = found.largest_accepted;
  add_decisions(decisions, context.scene.contacts.size(), context.scene.decisions);
}

constexpr const char* what_is_left = "the contact was not evaluated";

/// What is left open is said, and the contact is no clean one.
void not_evaluated(SceneContext& context, Contact& contact, const std::string& why,
                   const char* what = what_is_left, RuleId rule = RuleId::DK380) {
  contact.evaluated = false;
  const std::string keyword = "/INTER/TYPE" + std::to_string(contact.type);
  Case particular;
  if (rule == RuleId::DK380) {  // too many pairs are told by the page of their rule
    particular.severity = Severity::warning;
    particular.solver = "It evaluates them.";
    particular.fix =
        "The deck needs no change. The listing of the Starter shows what deck leaves out.";
  }
  Diagnostic d =
      finding_of(rule, contact.inter->span,
                 keyword + " " + std::to_string(contact.inter->id) + ": " + why + "; " + what,
                 std::move(particular));
  d.keyword = keyword;
  d.id = contact.inter->id;
  context.diagnostics.report(std::move(d));
}

void edges_of(SceneContext& context, const Sides& s, const Topology& topology,
              const InterBase& inter, bool evaluated) {
  const std::vector<SideEdge> edges = make_edges(context, s, topology);
  if (edges.empty()) return;
  Contact out = head(inter, s.set, ContactKind::edge_edge);
  out.evaluated = evaluated;
  out.max_gap = s.largest;
  for (const SideEdge& e : edges) {
    ContactEdge edge;
    edge.nodes = e.nodes;
    const Face& f = s.faces[s.base(e.face)];
    edge.carrier = f.carrier;
    edge.element = f.element;
    edge.stiffness = e.stiffness;
    edge.gap = e.gap;
    edge.length = e.length;
    out.secondary_edges.push_back(edge);
    out.edge_kinds.push_back(e.kind);
  }
  out.main_edges = out.secondary_edges;
  std::vector<EdgePenetration> found;
  DecisionReport decisions;
  if (evaluated && !find_edges25(context, s, topology, edges, found, decisions)) {
    not_evaluated(context, out, "too many pairs of edges", what_is_left, RuleId::DK390);
  }
  {
    PairJudge judge(context.options.accuracy, decisions);
    for (const EdgePenetration& p : found) {
      PenetrationRow row = row_of(s.set, p, p.secondary, p.main);
      row.weight_s = p.weight_s;
      row.weight_m = p.weight_m;
      if (settle(context.options.accuracy, judge, p, row)) out.penetrations.push_back(row);
    }
  }
  if (evaluated && s.set.solid_edges() != 0) {
    if (s.set.igap == 2)  // which of them are left out as near along the mesh is not established
      not_evaluated(context, out, "Igap = 2 and Iedge = " + std::to_string(s.set.iedge),
                    "edges against faces of solids were not evaluated");
    else
      out.edges_through_segments = edges_through_solids(context, s, topology, edges, decisions);
  }
  add_decisions(decisions, context.scene.contacts.size(), context.scene.decisions);
  context.scene.contacts.push_back(std::move(out));
}

/// Points that a TYPE24 adds on edges: their places are not established.
void points_on_edges(SceneContext& context, const Sides& s, const InterBase& inter) {
  Contact out = head(inter, s.set, ContactKind::edge_edge);
  not_evaluated(context, out, "Iedge = " + std::to_string(s.set.iedge),
                "the points that the solver adds on edges were not evaluated");
  context.scene.contacts.push_back(std::move(out));
}

}  // namespace

void build_contacts(SceneContext& context, Selections& selections, const InterBase& inter,
                    const std::function<bool(Contact&)>& evaluate) {
  Sides s;
  s.set = settings_of(inter, context.options.what_if);
  make_sides(context, selections, inter, s);
  set_gaps(context, s);
  set_stiffness(context, s);
  Contact out = head(inter, s.set, ContactKind::node_segment);
  list_sides(context, s, out);
  const bool ready = context.options.penetrations && evaluate(out);
  const bool ready25 = ready && inter.type == 25;
  std::optional<Topology> topology;
  if (ready25) topology.emplace(context.scene.coordinates, s);
  if (ready) {
    const Found found = topology ? find_nodes25(context, s, *topology) : find_nodes24(context, s);
    if (found.complete)
      list_penetrations(context, s, found, out);
    else
      not_evaluated(context, out, "too many pairs", what_is_left, RuleId::DK390);
  }
  context.scene.contacts.push_back(std::move(out));
  if (ready25 && s.set.iedge != 0) edges_of(context, s, *topology, inter, ready);
  if (ready && inter.type == 24 && s.set.iedge > 0) points_on_edges(context, s, inter);
}

}  // namespace deck::detail::modern
