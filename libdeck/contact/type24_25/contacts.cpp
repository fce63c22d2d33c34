// TYPE24 and TYPE25 as contacts of the scene: nodes and segments; edges if the card has them.
#include <algorithm>

#include "base/shared/parallel.hpp"
#include "contact/rules/actions.hpp"
#include "contact/shared/filtered.hpp"
#include "contact/type24_25/type24_25.hpp"
#include "deck/text.hpp"

namespace deck {

const char* to_string(SegmentKind kind) {
  static constexpr const char* words[] = {"solid", "shell", "shell-opposite", "coat",
                                          "coat-opposite"};
  return words[static_cast<std::size_t>(kind)];
}

}  // namespace deck

namespace deck::detail::type24_25 {
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
  out.secondary_length.reserve(s.nodes.size());
  out.main.reserve(s.count());
  for (const SideNode& n : s.nodes) {
    SecondaryNode node;
    node.node = n.node;
    node.gap = n.gap;
    out.secondary_length.push_back(n.length);
    out.secondary.push_back(node);
  }
  out.main.resize(s.count());
  out.main_length.resize(s.count());
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
      out.main_length[i] = f.length;
      out.segment_kinds[i] = f.kind;
    }
  });
  out.shortest_side = s.shortest;
  out.max_gap = s.largest;
  out.reoriented_segments = s.reoriented;
  out.crowded = s.crowded;
}

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
  act_on_type24_25(set.type, set.inacti, row);
  return row;
}

/// Writes the decision on a pair into its row, and what exact arithmetic says. False: no row.
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

/// Rows of the nodes or points first ... end-1 that were found; row_of_found(p): row of one.
template <class RowOf>
void list_penetrations(SceneContext& context, std::span<const NodePenetration> found,
                       DecisionReport decisions, Contact& out, const RowOf& row_of_found) {
  PairJudge judge(context.options.accuracy, decisions);
  out.penetrations.reserve(found.size());
  for (const NodePenetration& p : found) {
    PenetrationRow row = row_of_found(p);
    if (settle(context.options.accuracy, judge, p, row)) out.penetrations.push_back(row);
  }
  add_decisions(decisions, context.scene.contacts.size(), context.scene.decisions);
}

void nodes_of(SceneContext& context, const Sides& s, const NodeSearch& found, Contact& out) {
  // Points on edges follow the nodes.
  const auto& all = found.penetrations;
  const auto end = std::find_if(all.begin(), all.end(),
                                [&](const NodePenetration& p) { return p.node >= s.nodes.size(); });
  const std::span<const NodePenetration> nodes(all.begin(), end);
  std::vector<bool> held(nodes.size(), false);
  if (s.set.irem_i2 == 1 && !nodes.empty()) held = tied_penetrations(context, s, nodes);
  list_penetrations(context, nodes, found.decisions, out, [&](const NodePenetration& p) {
    PenetrationRow row = row_of(s.set, p, p.node, p.face);
    if (held[static_cast<std::size_t>(&p - nodes.data())] && s.set.inacti == 5) {
      row.action = PenetrationAction::removed_tied;
      row.p0 = 0;
    }
    return row;
  });
  out.candidates = found.candidates;
  out.removed_pairs = found.removed;
  out.largest_accepted = found.largest_accepted;
}

constexpr const char* what_is_left = "the contact was not evaluated";

/// Reports the unevaluated rest; the contact is not clean then.
void not_evaluated(SceneContext& context, Contact& contact, const std::string& why,
                   const char* what = what_is_left, RuleId rule = RuleId::DK390,
                   const char* solver = "", const char* fix = "") {
  contact.evaluated = false;
  const std::string keyword = "/INTER/TYPE" + std::to_string(contact.type);
  Overrides overrides;
  if (rule == RuleId::DK380)
    overrides = {.severity = Severity::warning, .solver = solver, .fix = fix};
  Finding d =
      make_finding(rule, contact.inter->span,
                   keyword + " " + std::to_string(contact.inter->id) + ": " + why + "; " + what,
                   std::move(overrides));
  d.keyword = keyword;
  d.id = contact.inter->id;
  context.findings.report(std::move(d));
}

/// Edges through faces of solids, as pairs of the edge and the side of the face.
void through_solids(const Sides& s, std::vector<EdgeThroughSegment> found, Contact& out) {
  for (const EdgeThroughSegment& through : found) {
    const Face& f = s.faces[through.main];
    const auto side = static_cast<std::size_t>(through.side - 1);
    ContactEdge edge;
    edge.nodes = {f.nodes[side], f.nodes[(side + 1) % 4]};
    edge.carrier = f.carrier;
    edge.element = f.element;
    EdgePenetration p;
    p.secondary = through.edge;
    p.penetration = p.distance = through.depth;
    PenetrationRow row =
        row_of(s.set, p, through.edge, static_cast<std::uint32_t>(out.main_edges.size()));
    row.weight_s = 0.5;
    out.main_edges.push_back(edge);
    out.main_length.push_back(0);
    out.penetrations.push_back(row);
  }
  out.edges_through_segments = std::move(found);
}

/// True if the solver counts a pair of edges: free edges only, or at least one free edge.
bool is_counted(const Settings& set, const SideEdge& a, const SideEdge& b) {
  if (set.shell_edges() == 1) return a.free() && b.free();
  return set.shell_edges() != 3 || a.free() || b.free();
}

void edges_of(SceneContext& context, const Sides& s, const Topology& topology,
              const InterBase& inter, bool evaluated) {
  const std::vector<SideEdge> edges = make_edges(context, s, topology);
  if (edges.empty()) return;
  Contact out = head(inter, s.set, ContactKind::edge_edge);
  out.evaluated = evaluated;
  out.max_gap = s.largest;
  for (const SideEdge& e : edges) {
    out.secondary_edges.push_back({e.nodes, e.carrier, false, e.element, e.stiffness, e.gap});
    out.secondary_length.push_back(e.length);
    out.edge_kinds.push_back(e.kind);
  }
  out.main_edges = out.secondary_edges;
  out.main_length = out.secondary_length;
  std::vector<EdgePenetration> found;
  DecisionReport decisions;
  if (evaluated && !find_edges25(context, s, topology, edges, found, decisions))
    not_evaluated(context, out, "too many pairs of edges");
  {
    PairJudge judge(context.options.accuracy, decisions);
    for (const EdgePenetration& p : found) {
      PenetrationRow row = row_of(s.set, p, p.secondary, p.main);
      row.weight_s = p.weight_s;
      row.weight_m = p.weight_m;
      if (!is_counted(s.set, edges[p.secondary], edges[p.main]))
        out.uncounted.push_back(row);
      else if (settle(context.options.accuracy, judge, p, row))
        out.penetrations.push_back(row);
    }
  }
  if (evaluated && s.set.solid_edges() != 0) {
    if (s.set.igap == 2)  // pairs removed as near along the mesh are not established
      not_evaluated(context, out, "Igap = 2 and Iedge = " + std::to_string(s.set.iedge),
                    "edges against faces of solids were not evaluated", RuleId::DK380,
                    "It evaluates them.",
                    "The deck needs no change. The listing of the Starter shows what deck leaves "
                    "out.");
    else
      through_solids(s, edges_through_solids(context, s, topology, edges, decisions), out);
  }
  add_decisions(decisions, context.scene.contacts.size(), context.scene.decisions);
  context.scene.contacts.push_back(std::move(out));
}

/// Points of a TYPE24 on edges, and the segments that they penetrate.
void points_of(SceneContext& context, const Sides& s, const Contact& nodes, const NodeSearch& got) {
  Contact out = head(*nodes.inter, s.set, ContactKind::edge_edge);
  out.max_gap = s.largest;
  for (const PointOnEdge& p : s.points) {
    ContactEdge edge;
    edge.nodes = p.edge;
    edge.carrier = p.segment.carrier;
    edge.element = p.segment.element;
    out.secondary_edges.push_back(edge);
    out.points.push_back(p.point);
  }
  const auto& all = got.penetrations;
  const auto first = std::find_if(
      all.begin(), all.end(), [&](const NodePenetration& p) { return p.node >= s.nodes.size(); });
  list_penetrations(context, {first, all.end()}, {}, out, [&](const NodePenetration& p) {
    const MainSegment& m = out.main.emplace_back(nodes.main[p.face]);
    ContactEdge& side = out.main_edges.emplace_back();
    side.nodes = {m.nodes[0], m.nodes[1]};
    side.carrier = m.carrier;
    side.element = m.element;
    side.gap = m.gap;
    const auto point = p.node - static_cast<std::uint32_t>(s.nodes.size());
    PenetrationRow row = row_of(s.set, p, point, static_cast<std::uint32_t>(out.main.size() - 1));
    out.secondary_edges[point].gap = p.gap - m.gap;
    const std::string_view place = out.points[point].place;
    row.weight_s = place == "quarter" ? 0.75 : place == "inner" ? 0.5 : 0.25;
    return row;
  });
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
  bool ready = context.options.penetrations && evaluate(out);
  if (ready && !(s.margin < no_limit)) {  // no exact number holds it
    not_evaluated(context, out, "its segments are too long to compute with", what_is_left,
                  RuleId::DK380, "It computes with them.", "Correct the coordinates.");
    ready = false;
  }
  if (ready && inter.type == 24 && s.set.iedge < 0) {
    not_evaluated(context, out, "Iedge is negative", what_is_left, RuleId::DK380,
                  "It writes beyond its tables: builds count differently, or abort.",
                  "Write 1 for points on edges, 1000 for none.");
    ready = false;
  }
  std::optional<Topology> topology;
  if (ready && inter.type == 25) topology.emplace(context.scene.coordinates, s);
  NodeSearch found;
  if (ready) {
    found = topology ? find_nodes25(context, s, *topology) : find_nodes24(context, s);
    if (found.complete)
      nodes_of(context, s, found, out);
    else
      not_evaluated(context, out, "too many pairs");
  }
  context.scene.contacts.push_back(std::move(out));
  if (topology && s.set.iedge != 0) edges_of(context, s, *topology, inter, ready);
  if (ready && !s.points.empty()) points_of(context, s, context.scene.contacts.back(), found);
}

}  // namespace deck::detail::type24_25
