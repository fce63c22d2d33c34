// The JSON of `deck gaps`. All members of a pair are lengths, for edges as for nodes; what the
// solver stores of two edges, the square of the gap and what is left of it, stands in "solver".
#include "deck/report/gaps.hpp"
#include "model/shared/item_spans.hpp"
#include "report/accuracy_decisions.hpp"
#include "report/gaps_names.hpp"
#include "report/json/ties_json.hpp"
#include "report/shared/gate.hpp"
#include "report/shared/json.hpp"
#include "report/shared/verdict.hpp"
#include "verdict/shared/of_interface.hpp"

namespace deck {
namespace {

void write_vector(JsonWriter& j, const std::array<double, 3>& v) {
  j.begin_array(true);
  for (const double x : v) j.value(x);
  j.end_array();
}

/// A document under way: after every row it may leave.
struct Rows {
  JsonWriter& json;
  std::string& text;
  const TextDrain& drain;
  void end_row() const {
    json.end_object();
    drain_text(drain, text);
  }
};

void write_sides(const Rows& rows, const Model& model, const Contact& c) {
  JsonWriter& j = rows.json;
  if (c.kind == ContactKind::node_segment) {
    j.key("secondary").begin_array();
    for (const SecondaryNode& s : c.secondary) {
      j.begin_object(true).field("node", model.node_id(s.node)).field("stiffness", s.multiplier);
      j.field("gap", s.gap);
      if (c.istf >= 2) j.field("nodal_stiffness", s.nodal_stiffness);
      rows.end_row();
    }
    j.end_array().key("main").begin_array();
    for (const MainSegment& m : c.main) {
      j.begin_object(true).key("nodes");
      write_nodes(j, model, m.nodes.data(), 4);
      j.field("stiffness", m.stiffness).field("gap", m.gap);
      rows.end_row();
    }
    j.end_array();
    return;
  }
  const auto side = [&](const char* name, const std::vector<ContactEdge>& edges) {
    j.key(name).begin_array();
    for (const ContactEdge& e : edges) {
      j.begin_object(true).key("edge");
      write_nodes(j, model, e.nodes.data(), 2);
      j.field("stiffness", e.stiffness).field("gap", e.gap);
      rows.end_row();
    }
    j.end_array();
  };
  side("secondary", c.secondary_edges);
  side("main", c.main_edges);
}

/// TYPE24 and TYPE25: nodes and segments with what they are; edges of its other contact.
void write_modern_sides(const Rows& rows, const Model& model, const Contact& c,
                        const Contact* edges) {
  JsonWriter& j = rows.json;
  j.key("secondary").begin_array();
  for (const SecondaryNode& s : c.secondary) {
    j.begin_object(true).field("node", model.node_id(s.node)).field("stiffness", s.multiplier);
    j.field("gap", s.gap);
    rows.end_row();
  }
  j.end_array().key("main").begin_array();
  for (std::size_t i = 0; i < c.main.size(); ++i) {
    const MainSegment& m = c.main[i];
    j.begin_object(true).key("nodes");
    write_nodes(j, model, m.nodes.data(), 4);
    j.field("stiffness", m.stiffness).field("gap", m.gap);
    j.field("kind", to_string(c.segment_kinds[i]));
    rows.end_row();
  }
  j.end_array().key("edges").begin_array();
  for (std::size_t i = 0; edges != nullptr && i < edges->main_edges.size(); ++i) {
    const ContactEdge& e = edges->main_edges[i];
    j.begin_object(true).key("edge");
    write_nodes(j, model, e.nodes.data(), 2);
    j.field("stiffness", e.stiffness).field("gap", e.gap);
    j.field("kind", edges->edge_kinds[i] == 1   ? "solid"
                    : edges->edge_kinds[i] == 2 ? "shell"
                                                : "solid-flat");
    rows.end_row();
  }
  j.end_array();
}

/// A row of the view, and the line of its secondary node.
struct PlacedRow {
  const NamedPenetration* named = nullptr;
  Span span;
};

/// Rows of each contact in the solver's order, penetrations and ties.
std::vector<std::vector<PlacedRow>> rows_of_contacts(const Scene& scene, const SceneView& view) {
  std::vector<std::vector<PlacedRow>> out(scene.contacts.size());
  for (std::size_t c = 0; c < scene.contacts.size(); ++c)
    out[c].resize(scene.contacts[c].penetrations.size());
  for (const auto* list : {&view.penetrations, &view.ties}) {
    const std::vector<Span> spans = detail::node_spans(*scene.model, first_nodes(scene, *list));
    for (std::size_t i = 0; i < list->size(); ++i) {
      const NamedPenetration& p = (*list)[i];
      out[p.contact][p.row] = {&p, spans[i]};
    }
  }
  return out;
}

void write_penetrations(const Rows& rows, const Deck& deck, const Scene& scene,
                        const std::vector<PlacedRow>& named, const Contact& c,
                        const char* list = "penetrations") {
  const Model& model = *scene.model;
  JsonWriter& j = rows.json;
  j.key(list).begin_array();
  for (const auto& [p, span] : named) {
    const PenetrationRow& r = c.penetrations[p->row];
    const bool edges = c.kind == ContactKind::edge_edge;
    j.begin_object(true);
    NodeIndex first = no_index;
    if (edges) {
      const ContactEdge& s = c.secondary_edges[r.secondary];
      first = s.nodes[0];
      j.key("edge");
      write_nodes(j, model, s.nodes.data(), 2);
      j.key("main_edge");
      write_nodes(j, model, c.main_edges[r.main].nodes.data(), 2);
    } else {
      first = c.secondary[r.secondary].node;
      j.field("node", model.node_id(first)).key("segment");
      write_nodes(j, model, c.main[r.main].nodes.data(), 4);
    }
    j.field("penetration", r.depth).field("gap", r.gap).field("distance", r.distance);
    if (edges) {
      j.key("solver").begin_object(true);
      j.field("penetration", r.gap * r.gap - r.distance).field("gap", r.gap * r.gap).end_object();
    }
    if (is_modern(c.type)) j.field("stored", r.p0);
    j.key("normal");
    write_vector(j, r.normal);
    j.field("on_surface", r.on_surface).field("in_contact", r.in_contact);
    j.field("action", to_string(r.action));
    j.key("gap0");
    r.has_gap0 ? j.value(r.gap0) : j.null();
    j.key("p0");
    r.has_gap0 ? j.value(r.p0) : j.null();
    j.key("moved_by");
    if (r.action == PenetrationAction::node_moved)
      write_vector(j, r.moved_by);
    else
      j.null();
    j.key("at");
    write_vector(j, p->at);
    const auto element = [&](const char* name, const ElementName& e) {
      j.key(name);
      if (!e.valid())
        j.null();
      else
        j.begin_object(true).field("id", e.id).field("part", e.part).end_object();
    };
    element("secondary_element", p->secondary_element);
    element("main_element", p->main_element);
    j.key("source");
    write_json_place(j, deck, span);
    rows.end_row();
  }
  j.end_array();
}

/// Edges of a TYPE25 through its solids.
void write_edges_through(const Rows& rows, const Model& model, const Contact& c,
                         const Contact& edges) {
  JsonWriter& j = rows.json;
  j.key("edge_solid_penetrations").begin_array();
  for (const EdgeThroughSegment& e : edges.edges_through_segments) {
    j.begin_object(true).key("edge");
    write_nodes(j, model, edges.main_edges[e.edge].nodes.data(), 2);
    j.key("segment");
    write_nodes(j, model, c.main[e.main].nodes.data(), 4);
    j.field("side", e.side).field("penetration", e.depth);
    rows.end_row();
  }
  j.end_array();
}

void write_crossings(JsonWriter& j, const Scene& scene, const std::vector<Crossing>& crossings,
                     std::uint32_t contact) {
  const Model& model = *scene.model;
  const Contact& c = scene.contacts[contact];
  const auto id = [&](const ElementName& e, std::int64_t v) { e.valid() ? j.value(v) : j.null(); };
  j.key("crossings").begin_array();
  for (const Crossing& x : crossings) {
    if (x.contact != contact) continue;
    const ElementName edge = edge_element(model, x), segment = segment_element(scene, x);
    j.begin_object(true).key("edge");
    write_nodes(j, model, x.edge.data(), 2);
    j.key("segment");
    write_nodes(j, model, c.main[x.main].nodes.data(), 4);
    j.key("edge_element");
    id(edge, edge.id);
    j.key("segment_element");
    id(segment, segment.id);
    j.key("parts").begin_array(true);
    id(edge, edge.part);
    id(segment, segment.part);
    j.end_array().end_object();
  }
  j.end_array();
}

}  // namespace

void write_on_segment(JsonWriter& j, const ItemCounts& c) {
  j.key("on_segment").begin_object(true);
  j.field("nodes", c.nodes).field("edges", c.edges).field("pairs", c.pairs).end_object();
}

void write_totals(JsonWriter& j, const ContactTotals& t) {
  j.field("pairs", t.count.pairs).field("nodes", t.count.nodes).field("edges", t.count.edges);
  j.key("tied").begin_object(true).field("nodes", t.tied.nodes);
  j.field("pairs", t.tied.pairs).end_object();
  write_on_segment(j, t.on_segment);
  j.key("crossed_elements");
  t.crossed_elements ? j.value(*t.crossed_elements) : j.null();
  j.field("solver_errors", t.solver_errors).field("acted", t.acted);
  j.field("max_depth", t.max_depth).field("max_ratio", t.max_ratio);
}

std::string gaps_json(std::string_view path, const Deck& deck, const Scene& scene,
                      const SceneView& view, bool all, const std::vector<Crossing>* crossings,
                      const GateReport* gate, const TextDrain& drain) {
  std::string out;
  JsonWriter j(out);
  const Rows rows{j, out, drain};
  j.begin_object();
  write_json_head(j, "deck/gaps", gaps_version);
  write_json_deck(j, path, deck, scene.model, scene.interfaces);
  write_verdict(j, verdict_of(deck, scene, view));
  j.key("summary").begin_object(true);
  write_totals(j, view.total);
  j.end_object();
  if (gate != nullptr) write_gate(j, deck, scene, view, *gate);
  write_json_coverage(j, coverage_of(deck, *scene.interfaces, scene.examined));
  write_decisions(j, scene);
  j.key("part_pairs").begin_array();
  for (const PartPair& p : view.part_pairs) {
    j.begin_object(true).field("secondary", p.secondary).field("main", p.main);
    j.field("pairs", p.count.pairs).field("nodes", p.count.nodes).field("edges", p.count.edges);
    write_on_segment(j, p.on_segment);
    j.field("max_depth", p.max_depth).field("mean_depth", p.mean_depth);
    j.field("p95_depth", p.p95_depth).field("max_ratio", p.max_ratio).end_object();
  }
  j.end_array();
  const std::vector<std::vector<PlacedRow>> named = rows_of_contacts(scene, view);
  j.key("interfaces").begin_array();
  for (const InterBase* inter : scene.interfaces->ordered) {
    j.begin_object().field("id", inter->id).field("type", inter->type);
    j.field("title", inter->title).key("source");
    write_json_place(j, deck, inter->span);
    const InterfaceVerdict own = verdict_of_interface(scene, view, *inter);
    j.field("level", to_string(own.level)).field("max_depth", own.max_depth);
    j.field("max_ratio", own.max_ratio).key("contacts").begin_array();
    for (const ContactRole role :
         {ContactRole::primary, ContactRole::reversed, ContactRole::edges}) {
      for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
        const Contact& c = scene.contacts[i];
        if (c.inter != inter || c.role != role || c.dropped) continue;
        // The edges of a TYPE25 stand with its nodes.
        const bool modern = is_modern(c.type);
        if (modern && role == ContactRole::edges) continue;
        const Contact* const edges =
            modern && i + 1 < scene.contacts.size() && scene.contacts[i + 1].inter == inter
                ? &scene.contacts[i + 1]
                : nullptr;
        j.begin_object().field("kind", to_string(c.kind));
        // A TYPE11 of the user is the primary contact of its interface; that of a TYPE19 its edges.
        j.field("role", to_string(c.role)).field("igap", c.igap == 0 ? 1000 : c.igap);
        j.field("gapmin", c.gapmin).field("gapmax", c.gapmax).field("drad", c.drad);
        j.field("gapmin_origin", c.gapmin_origin == GapminOrigin::card ? "card" : "derived");
        j.field("gapmin_from", to_string(c.gapmin_origin));
        j.field("inacti", c.inacti).field("candidates", c.candidates);
        j.field("evaluated", c.evaluated).key("obstacle");
        if (const Obstacle o = obstacle_of(c); o == Obstacle::none)
          j.null();
        else
          j.value(to_string(o));
        j.field("removed_pairs", c.removed_pairs).field("max_gap", c.max_gap);
        j.field("shortest_main_side", c.shortest_side).key("totals").begin_object(true);
        write_totals(j, view.contacts[i]);
        j.end_object();
        if (all && modern)
          write_modern_sides(rows, *scene.model, c, edges);
        else if (all)
          write_sides(rows, *scene.model, c);
        // The pairs of a tie are listed by the solver, but penetrate nothing.
        write_penetrations(rows, deck, scene, c.ties() ? std::vector<PlacedRow>() : named[i], c);
        if (c.ties()) {
          write_penetrations(rows, deck, scene, named[i], c, "tied_pairs");
          j.key("untied_nodes").begin_array(true);
          for (const std::uint32_t s : untied_secondary(c))
            j.value(scene.model->node_id(c.secondary[s].node));
          j.end_array();
        }
        if (edges != nullptr) {
          j.field("edges_evaluated", edges->evaluated).key("edge_totals").begin_object(true);
          write_totals(j, view.contacts[i + 1]);
          j.end_object();
          write_penetrations(rows, deck, scene, named[i + 1], *edges, "edge_penetrations");
          write_edges_through(rows, *scene.model, c, *edges);
        }
        if (crossings != nullptr)
          write_crossings(j, scene, *crossings, static_cast<std::uint32_t>(i));
        j.end_object();
      }
    }
    j.end_array().end_object();
  }
  j.end_array();
  detail::write_ties(j, scene, all);
  j.end_object();
  out += '\n';
  return out;
}

}  // namespace deck
