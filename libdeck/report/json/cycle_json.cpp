// The JSON of `deck cycle`.
#include "report/cycle_costs.hpp"
#include "report/gaps_names.hpp"
#include "report/shared/cycle.hpp"
#include "report/shared/gate.hpp"
#include "report/shared/json.hpp"
#include "report/shared/verdict.hpp"

namespace deck {
namespace {

template <std::size_t N>
void write_vector(JsonWriter& j, const std::array<double, N>& v) {
  j.begin_array(true);
  for (const double x : v) j.value(x);
  j.end_array();
}

void write_node(JsonWriter& j, const Model& model, std::string_view name, NodeIndex n) {
  j.key(name);
  n == no_index ? j.null() : j.value(model.node_id(n));
}

/// 1e30 stands for "no limit" inside; programs get null.
void write_step(JsonWriter& j, std::string_view name, double dt) {
  j.key(name);
  dt < 1e30 ? j.value(dt) : j.null();
}

void write_pair(JsonWriter& j, const Model& model, const Contact& c, const cycle::PairOutcome& p) {
  j.begin_object(true);
  if (c.kind == ContactKind::edge_edge) {
    j.key("edge");
    write_nodes(j, model, c.secondary_edges[p.at.secondary].nodes.data(), 2);
    j.key("main_edge");
    write_nodes(j, model, c.main_edges[p.at.main].nodes.data(), 2);
  } else {
    j.field("node", model.node_id(c.secondary[p.at.secondary].node)).key("segment");
    write_nodes(j, model, c.main[p.at.main].nodes.data(), 4);
  }
  j.key("weights");
  write_vector(j, p.weights);
  j.key("force");
  write_vector(j, p.force);
  j.field("penetration", p.penetration).field("gap", p.gap).field("distance", p.distance);
  j.field("k0", p.k0).field("k_nodal", p.k_nodal).end_object();
}

/// "node", or "edge" with both ends.
void write_secondary(JsonWriter& j, const Model& model, const Contact& c, std::uint32_t i) {
  if (c.kind == ContactKind::edge_edge) {
    j.key("edge");
    write_nodes(j, model, c.secondary_edges[i].nodes.data(), 2);
  } else {
    j.field("node", model.node_id(c.secondary[i].node));
  }
}

void write_tie(JsonWriter& j, const Model& model, const Contact& c, const CandidatePair& at) {
  write_secondary(j, model, c, at.secondary);
  j.key("segment");
  write_nodes(j, model, c.main[at.main].nodes.data(), 4);
}

void write_release(JsonWriter& j, const Model& model, const cycle::NodeRelease& r) {
  j.field("node", model.node_id(r.node)).field("before", static_cast<int>(r.before));
  j.field("after", static_cast<int>(r.after));
}

/// Who leaves the interface, ties, is released; and the figures of Iadm.
void write_lasting(JsonWriter& j, const Model& model, const cycle::ContactOutcome& o) {
  const Contact& c = *o.contact;
  j.field("pairs_tied", o.pairs_tied).key("removed").begin_array();
  for (const cycle::Removal& r : o.removed) {
    j.begin_object(true);
    write_secondary(j, model, c, r.secondary);
    j.field("because", to_string(r.because)).end_object();
  }
  j.end_array().key("ties").begin_array();
  for (const cycle::TieChange& t : o.ties) {
    j.begin_object(true);
    write_tie(j, model, c, t.at);
    j.field("tied", t.tied).end_object();
  }
  j.end_array().key("released").begin_array();
  for (const cycle::NodeRelease& r : o.released) {
    j.begin_object(true);
    write_release(j, model, r);
    j.end_object();
  }
  j.end_array().key("criteria").begin_array();
  for (const cycle::NodeCriteria& n : o.criteria) {
    j.begin_object(true).field("node", model.node_id(n.node)).field("radius", n.radius);
    j.field("penetration", n.penetration).key("angle");
    n.angle < 1e30 ? j.value(n.angle) : j.null();
    j.end_object();
  }
  j.end_array();
}

const char* name_of(cycle::StepEvent::Kind kind) {
  switch (kind) {
    case cycle::StepEvent::Kind::tied:
      return "tied";
    case cycle::StepEvent::Kind::let_go:
      return "let-go";
    case cycle::StepEvent::Kind::released:
      return "released";
    default:
      return "removed";
  }
}

void write_steps(JsonWriter& j, const CycleInput& input) {
  j.key("steps");
  if (input.steps == nullptr) {
    j.null();
    return;
  }
  const Model& model = *input.scene->model;
  const cycle::StepsOutcome& s = *input.steps;
  const auto contact = [&](std::size_t i) -> const Contact& { return input.scene->contacts[i]; };
  j.begin_object().field("count", s.lines.size()).field("motion", "prescribed");
  j.field("searches", s.searches).key("history").begin_array();
  for (std::size_t k = 0; k < s.lines.size(); ++k) {
    j.begin_object().field("step", k).field("time", s.lines[k].time).field("dt1", s.lines[k].dt1);
    j.key("contacts").begin_array();
    for (std::size_t i = 0; i < s.lines[k].contacts.size(); ++i) {
      const cycle::StepContact& c = s.lines[k].contacts[i];
      j.begin_object(true).field("interface", contact(i).inter->id);
      j.field("role", to_string(contact(i).role)).field("active", c.active);
      j.field("pairs_with_force", c.pairs_with_force).field("pairs_tied", c.pairs_tied);
      j.field("removed", c.removed).key("normal");
      write_vector(j, c.normal);
      j.key("tangential");
      write_vector(j, c.tangential);
      j.field("sizes", c.force_sum).field("elastic", c.elastic_energy);
      j.field("friction", c.friction_energy).field("damping", c.damping_energy).end_object();
    }
    j.end_array().end_object();
  }
  j.end_array().key("events").begin_array();
  for (const cycle::StepEvent& e : s.events) {
    const Contact& c = contact(e.contact);
    j.begin_object(true).field("step", e.step).field("time", e.time);
    j.field("interface", c.inter->id).field("role", to_string(c.role));
    j.field("event", name_of(e.kind));
    if (e.kind == cycle::StepEvent::Kind::removed) {
      write_secondary(j, model, c, e.at.secondary);
      j.field("because", to_string(e.because));
    } else if (e.kind == cycle::StepEvent::Kind::released) {
      write_release(j, model, e.release);
    } else {
      write_tie(j, model, c, e.at);
    }
    j.end_object();
  }
  j.end_array().end_object();
}

const char* source_name(cycle::StepLimit::Source source) {
  switch (source) {
    case cycle::StepLimit::Source::kinematic:
      return "kinematic";
    case cycle::StepLimit::Source::nodal:
      return "stiffness";
    case cycle::StepLimit::Source::velocity:
      return "velocity";
    default:
      return "none";
  }
}

/// Whether every pair is a row, and how rows leave.
struct PairRows {
  bool wanted = false;
  std::string& text;
  const TextDrain& drain;
};

void write_contact(JsonWriter& j, const CycleInput& input, const cycle::ContactOutcome& o,
                   const PairRows& rows) {
  const Model& model = *input.scene->model;
  const Contact& c = *o.contact;
  j.begin_object().field("kind", to_string(c.kind)).field("role", to_string(c.role));
  j.field("active", o.active).field("complete", o.complete);
  j.field("composition", o.composition).field("pairs_in_reach", o.pairs_in_reach);
  j.field("pairs_with_force", o.pairs_with_force).field("pairs_switched_off", o.pairs_switched_off);
  j.key("sum").begin_object(true).key("normal");
  write_vector(j, o.totals.normal);
  j.key("tangential");
  write_vector(j, o.totals.tangential);
  j.key("moment");
  write_vector(j, o.totals.moment);
  j.field("sizes", o.totals.total_abs).end_object();
  j.key("energy").begin_object(true).field("elastic", o.totals.elastic_energy);
  j.field("friction", o.totals.friction_energy).field("damping", o.totals.damping_energy);
  j.field("friction_heat", o.totals.friction_heat).end_object();
  j.key("heat").begin_object(true).field("secondary", o.heat_secondary);
  j.field("main", o.heat_main).end_object();
  write_step(j, "dt_contact", o.step.dt);
  j.field("dt_because", source_name(o.step.source));
  write_node(j, model, "dt_node", o.step_node);
  j.key("largest_pair");
  o.largest_force > 0 ? write_pair(j, model, c, o.largest) : static_cast<void>(j.null());
  j.key("acceleration").begin_object(true).field("max", o.largest_acceleration);
  write_node(j, model, "node", o.acceleration_node);
  j.field("massless_nodes", o.massless_nodes).end_object();
  j.key("near_singular").begin_object().field("count", o.near_singular_count);
  j.field("gap_closed", o.gap_closed).key("worst").begin_array();
  for (const cycle::PairOutcome& p : o.near_singular) write_pair(j, model, c, p);
  j.end_array().end_object();
  write_lasting(j, model, o);
  j.key("notes").begin_array();
  for (const std::string& text : o.notes) j.value(text);
  j.end_array();
  write_cost(j, input, o);
  if (rows.wanted) {
    j.key("pairs").begin_array();
    for (const cycle::PairOutcome& p : o.pairs) {
      write_pair(j, model, c, p);
      drain_text(rows.drain, rows.text);
    }
    j.end_array();
  }
  j.end_object();
}

void write_interface(JsonWriter& j, const CycleInput& input, const InterBase& inter,
                     const PairRows& rows) {
  j.begin_object().field("id", inter.id).field("type", inter.type);
  j.field("title", inter.title).key("source");
  write_json_place(j, *input.deck, inter.span);
  j.key("effects").begin_array();
  for (const EffectLine& e : effect_lines(*input.deck, *input.outcome, inter)) {
    j.begin_object(true).field("name", e.name).field("on", e.on).field("because", e.because);
    j.key("source");
    write_json_place(j, *input.deck, e.span);
    j.end_object();
  }
  j.end_array().key("contacts").begin_array();
  for (const ContactRole role : {ContactRole::primary, ContactRole::reversed, ContactRole::edges})
    for (const cycle::ContactOutcome& c : input.outcome->contacts)
      if (c.contact->inter == &inter && c.contact->role == role) write_contact(j, input, c, rows);
  j.end_array().end_object();
}

/// Nodes that any contact acts on, with what acts.
void write_acted_nodes(JsonWriter& j, const CycleInput& input) {
  j.key("nodes").begin_array();
  for (const cycle::ActedNode& n : cycle::acted_nodes(*input.state, *input.outcome)) {
    j.begin_object(true).field("node", input.scene->model->node_id(n.node)).key("force");
    write_vector(j, n.force);
    j.field("stiffness", n.stiffness);
    write_step(j, "dt", n.dt);
    j.end_object();
  }
  j.end_array();
}

/// What the interfaces do without the effect of --without; with it they stand in "interfaces".
void write_without(JsonWriter& j, const CycleInput& input) {
  const cycle::SceneOutcome& o = *input.without;
  j.key("without").begin_object().field("effect", input.without_effect);
  j.key("interfaces").begin_array();
  for (const cycle::InterfaceSummary& s : cycle::summarize(*input.scene, o)) {
    j.begin_object(true).field("id", s.id).field("pairs_with_force", s.pairs_with_force);
    j.field("force_sum", s.force_sum).field("elastic_energy", s.elastic_energy);
    j.field("friction_energy", s.friction_energy).field("damping_energy", s.damping_energy);
    write_step(j, "contact_dt", s.contact_dt);
    j.end_object();
  }
  j.end_array().field("largest_nodal_force", o.largest_nodal_force);
  write_step(j, "contact_dt", o.contact_dt);
  j.end_object();
}

}  // namespace

std::string cycle_json(const CycleInput& input, bool all, const TextDrain& drain) {
  std::string out;
  JsonWriter j(out);
  const PairRows rows{all, out, drain};
  const Model& model = *input.scene->model;
  const cycle::SceneOutcome& o = *input.outcome;
  j.begin_object();
  write_json_head(j, "deck/cycle", 1);
  write_json_deck(j, input.path, *input.deck, &model, input.scene->interfaces);
  write_verdict(j, cycle_verdict(input));
  if (input.gate != nullptr) write_gate(j, *input.deck, *input.scene, *input.view, *input.gate);
  write_json_coverage(j, coverage_of(*input.deck, *input.scene->interfaces, input.scene->examined));
  j.field("dt1", input.options.dt1).field("dt12", input.options.dt12);
  j.field("time", input.options.time);
  j.field("model", input.options.model == cycle::Model::reference ? "reference" : "robust");
  write_decisions(j, *input.scene);
  j.key("interfaces").begin_array();
  for (const InterBase* inter : input.scene->interfaces->ordered)
    for (const cycle::ContactOutcome& c : o.contacts)
      if (c.contact->inter == inter && c.contact->role == ContactRole::primary) {
        write_interface(j, input, *inter, rows);
        break;
      }
  j.end_array();
  write_costs(j, input);
  if (input.without != nullptr) write_without(j, input);
  if (all) write_acted_nodes(j, input);
  j.key("nodal_force").begin_object(true).field("max", o.largest_nodal_force);
  write_node(j, model, "node", o.force_node);
  j.end_object();
  j.key("dt").begin_object();
  write_step(j, "structure", o.structure.dt);
  write_step(j, "contact", o.contact_dt);
  j.field("because", source_name(o.contact_dt_source)).key("limiting");
  if (o.limiting_contact == SIZE_MAX) {
    j.null();
  } else {
    j.begin_object(true).field("interface", o.contacts[o.limiting_contact].contact->inter->id);
    write_node(j, model, "node", o.limiting_node);
    j.end_object();
  }
  j.key("structure_element");
  if (o.structure.element == no_index)
    j.null();
  else
    j.value(model.family(o.structure.kind).id[o.structure.element]);
  j.end_object();
  write_steps(j, input);
  j.key("not_evaluated").begin_array();
  for (const std::string& text : input.state->not_evaluated) j.value(text);
  j.end_array().end_object();
  return out;
}

}  // namespace deck
