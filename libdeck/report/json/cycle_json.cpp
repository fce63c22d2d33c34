// The document of `deck cycle --json`.
#include "report/shared/cycle.hpp"
#include "report/shared_records.hpp"

namespace deck {
namespace {

using cycle::ContactOutcome;
using cycle::StepEvent;
using Ids2 = std::array<std::int64_t, 2>;
using Ids4 = std::array<std::int64_t, 4>;
using NodeId = std::optional<std::int64_t>;

/// 1e30 means "no limit".
std::optional<double> limit(double value) { return known(value < 1e30, value); }

NodeId id_of(const Model& model, NodeIndex n) {
  return n == no_index ? std::nullopt : NodeId(model.node_id(n));
}

const char* source_name(cycle::StepLimit::Source source) {
  static constexpr const char* names[] = {"none", "kinematic", "stiffness", "velocity"};
  return names[static_cast<std::size_t>(source)];
}
constexpr const char* sources = "none, kinematic, stiffness or velocity";
constexpr const char* reasons =
    "mid-surface reached, dtmin (time to the mid-surface), dtmin (stiffness against mass) or no "
    "element left (Idel)";

struct CycleDocument {
  const CycleInput* input;
  const cycle::SceneOutcome* outcome;
  bool all;
  Coverage coverage;
  const Model& model() const { return *input->scene->model; }
};

struct CycleContactRow {
  const CycleDocument& document;
  const ContactOutcome* o;
  const Model& model() const { return document.model(); }
};

/// A pair, node or event with its contact.
template <class T>
struct OfContact {
  const CycleContactRow& contact;
  const T* of;
  PairSides sides(std::uint32_t secondary, std::uint32_t main = 0) const {
    return {&contact.model(), contact.o->contact, secondary, main};
  }
  PairSides sides() const { return sides(of->at.secondary, of->at.main); }
  std::int64_t node() const { return contact.model().node_id(of->node); }
};
using CyclePairRow = OfContact<cycle::PairOutcome>;

LINE_RECORD(CyclePairRow, "pair", "A pair that has a penetration or a force.",
            COLUMN("edge", "", r.sides().edge()), COLUMN("main_edge", "", r.sides().main_edge()),
            COLUMN("node", "", r.sides().node()), COLUMN("segment", "", r.sides().segment()),
            COLUMN("weights", "H1..H4; edges: h_s, 1-h_s, h_m, 1-h_m", r.of->weights),
            COLUMN("force", "On the main side; the secondary side gets the opposite", r.of->force),
            COLUMN("penetration", "Effective, after Inacti", r.of->penetration),
            COLUMN("gap", "Effective, after Inacti", r.of->gap),
            COLUMN("distance", "", r.of->distance),
            COLUMN("k0", "Pair stiffness before the 1/2 of the law", r.of->k0),
            COLUMN("k_nodal", "", r.of->k_nodal));

LINE_RECORD(OfContact<cycle::Removal>, "removed", "",
            COLUMN("edge", "", r.sides(r.of->secondary).edge()),
            COLUMN("node", "", r.sides(r.of->secondary).node()),
            COLUMN("because", reasons, to_string(r.of->because)));

LINE_RECORD(OfContact<cycle::TieChange>, "tie_change", "", COLUMN("node", "", r.sides().node()),
            COLUMN("segment", "", r.sides().segment()),
            COLUMN("tied", "false: it lets go", r.of->tied));

LINE_RECORD(OfContact<cycle::NodeRelease>, "release",
            "Fixed translations of a node that IBC frees.", COLUMN("node", "", r.node()),
            COLUMN("before", "Bits 4 X + 2 Y + Z", r.of->before), COLUMN("after", "", r.of->after));

LINE_RECORD(
    OfContact<cycle::NodeCriteria>, "criteria", "What Iadm asks of a node.",
    COLUMN("node", "", r.node()), COLUMN("radius", "Smallest radius of curvature", r.of->radius),
    COLUMN("penetration", "Secondary side: the deepest over Padm times the gap", r.of->penetration),
    COLUMN("angle",
           "Secondary side: smallest cosine between the normals of a segment and of its corners "
           "over that of Angladm; below 1 the angle is exceeded",
           limit(r.of->angle)));

RECORD(
    CycleContactRow, "contact", "", COLUMN("kind", "", r.o->contact->kind),
    COLUMN("role", "", r.o->contact->role),
    COLUMN("active", "false: outside Tstart..Tstop or before its sensor", r.o->active),
    COLUMN("complete", "false: nothing was evaluated (too many pairs, values out of range)",
           r.o->complete),
    COLUMN("composition", "", r.o->composition), COLUMN("pairs_in_reach", "", r.o->pairs_in_reach),
    COLUMN("pairs_with_force", "", r.o->pairs_with_force),
    COLUMN("pairs_switched_off",
           "In reach, but without a force: off since start-up, removed, or switched off in this "
           "cycle",
           r.o->pairs_switched_off),
    LINE_OBJECT("sum", "Forces on the main side.", COLUMN("normal", "", r.o->totals.normal),
                COLUMN("tangential", "", r.o->totals.tangential),
                COLUMN("moment", "About the origin", r.o->totals.moment),
                COLUMN("sizes", "Sum of |F|", r.o->totals.total_abs)),
    LINE_OBJECT("energy", "", COLUMN("elastic", "", r.o->totals.elastic_energy),
                COLUMN("friction", "", r.o->totals.friction_energy),
                COLUMN("damping", "", r.o->totals.damping_energy),
                COLUMN("friction_heat", "", r.o->totals.friction_heat)),
    LINE_OBJECT("heat", "Given to each side in this cycle.",
                COLUMN("secondary", "", r.o->heat_secondary), COLUMN("main", "", r.o->heat_main)),
    COLUMN("dt_contact", "null: no limit", limit(r.o->step.dt)),
    COLUMN("dt_because", sources, source_name(r.o->step.source)),
    COLUMN("dt_node", "", id_of(r.model(), r.o->step_node)),
    COLUMN("largest_pair", "null: no pair has a force",
           known(r.o->largest_force > 0, CyclePairRow{r, &r.o->largest})),
    LINE_OBJECT("acceleration", "", COLUMN("max", "", r.o->largest_acceleration),
                COLUMN("node", "", id_of(r.model(), r.o->acceleration_node)),
                COLUMN("massless_nodes", "With a force", r.o->massless_nodes)),
    OBJECT("near_singular", "Hardly any gap left.", COLUMN("count", "", r.o->near_singular_count),
           COLUMN("gap_closed", "Pairs at their mid-surface", r.o->gap_closed),
           COLUMN("worst", "At most 20", rows<CyclePairRow>(r.o->near_singular, r))),
    COLUMN("pairs_tied", "", r.o->pairs_tied),
    COLUMN("removed", "What leaves the interface for good after this evaluation",
           rows<OfContact<cycle::Removal>>(r.o->removed, r)),
    COLUMN("ties", "Pairs that tie or let go in this evaluation",
           rows<OfContact<cycle::TieChange>>(r.o->ties, r)),
    COLUMN("released", "", rows<OfContact<cycle::NodeRelease>>(r.o->released, r)),
    COLUMN("criteria", "With Iadm", rows<OfContact<cycle::NodeCriteria>>(r.o->criteria, r)),
    COLUMN("notes", "What the card asks for and was left out", rows_of(r.o->notes)),
    COLUMN("cost", "With --costs or --html; null: not measured",
           measured_cost(*r.document.input, *r.o)),
    COLUMN("pairs", "With --all: every pair that has a penetration",
           if_any(r.document.all, rows<CyclePairRow>(r.o->pairs, r))));

struct EffectRow {
  const Deck& deck;
  const EffectLine* line;
};
LINE_RECORD(EffectRow, "effect", "", COLUMN("name", "", r.line->name), COLUMN("on", "", r.line->on),
            COLUMN("because", "", r.line->because),
            COLUMN("source", "The cell that decides", place_of(r.deck, r.line->span)));

struct CycleInterfaceRow {
  const CycleDocument& document;
  const InterBase* inter;
  const Deck* deck() const { return document.input->deck; }
};

void each_cycle_contact(const CycleInterfaceRow& r,
                        const std::function<void(const CycleContactRow&)>& add) {
  for (const ContactRole role : {ContactRole::primary, ContactRole::reversed, ContactRole::edges})
    for (const ContactOutcome& c : r.document.outcome->contacts)
      if (c.contact->inter == r.inter && c.contact->role == role) add({r.document, &c});
}

RECORD(CycleInterfaceRow, "interface", "", COLUMN("id", "", r.inter->id),
       COLUMN("type", "7, 10, 11, 19, 24 or 25", r.inter->type),
       COLUMN("title", "", r.inter->title),
       COLUMN("source", "", place_of(*r.deck(), r.inter->span)),
       COLUMN("effects", "",
              rows<EffectRow>(effect_lines(*r.deck(), *r.document.outcome, *r.inter), *r.deck())),
       COLUMN("contacts", "", rows_from<each_cycle_contact>(r)));

/// Evaluation without one effect, for one interface.
struct CycleSummaryRow {
  const cycle::InterfaceSummary* sums;
};
LINE_RECORD(CycleSummaryRow, "interface_sums", "", COLUMN("id", "", r.sums->id),
            COLUMN("pairs_with_force", "", r.sums->pairs_with_force),
            COLUMN("force_sum", "Of the sizes of the pair forces", r.sums->force_sum),
            COLUMN("elastic_energy", "", r.sums->elastic_energy),
            COLUMN("friction_energy", "", r.sums->friction_energy),
            COLUMN("damping_energy", "", r.sums->damping_energy),
            COLUMN("contact_dt", "", limit(r.sums->contact_dt)));

struct WithoutRow {
  const CycleInput* input;
};
RECORD(WithoutRow, "without", "The evaluation without an effect.",
       COLUMN("effect", "", r.input->without_effect),
       COLUMN("interfaces", "",
              rows<CycleSummaryRow>(cycle::summarize(*r.input->scene, *r.input->without))),
       COLUMN("largest_nodal_force", "", r.input->without->largest_nodal_force),
       COLUMN("contact_dt", "", limit(r.input->without->contact_dt)));

struct ActedRow {
  std::int64_t node;
  cycle::ActedNode of;
};
LINE_RECORD(ActedRow, "acted_node", "Of all contacts together.", COLUMN("node", "", r.node),
            COLUMN("force", "On the node", r.of.force), COLUMN("stiffness", "", r.of.stiffness),
            COLUMN("dt", "0.9 sqrt(2 m / stiffness); null: no mass or no stiffness",
                   limit(r.of.dt)));

struct LimitingRow {
  std::int64_t interface_id;
  NodeId node;
};
LINE_RECORD(LimitingRow, "limiting", "", COLUMN("interface", "", r.interface_id),
            COLUMN("node", "", r.node));

struct CycleStepRow {
  const Scene& scene;
  const std::vector<cycle::StepLine>& lines;
  const cycle::StepLine* line;
  std::size_t step() const { return static_cast<std::size_t>(line - lines.data()); }
};

struct StepContactRow {
  const CycleStepRow& step;
  const cycle::StepContact* of;
  const Contact& contact() const {
    return step.scene.contacts[static_cast<std::size_t>(of - step.line->contacts.data())];
  }
};
LINE_RECORD(StepContactRow, "step_contact", "", COLUMN("interface", "", r.contact().inter->id),
            COLUMN("role", "", r.contact().role), COLUMN("active", "", r.of->active),
            COLUMN("pairs_with_force", "", r.of->pairs_with_force),
            COLUMN("pairs_tied", "", r.of->pairs_tied),
            COLUMN("removed", "Secondary nodes or edges, so far", r.of->removed),
            COLUMN("normal", "", r.of->normal), COLUMN("tangential", "", r.of->tangential),
            COLUMN("sizes", "", r.of->force_sum), COLUMN("elastic", "", r.of->elastic_energy),
            COLUMN("friction", "", r.of->friction_energy),
            COLUMN("damping", "", r.of->damping_energy));

RECORD(CycleStepRow, "step", "", COLUMN("step", "From 0 on", r.step()),
       COLUMN("time", "", r.line->time), COLUMN("dt1", "", r.line->dt1),
       COLUMN("contacts", "", rows<StepContactRow>(r.line->contacts, r)));

struct EventRow {
  const Scene& scene;
  const StepEvent* event;
  PairSides sides = {scene.model, &scene.contacts[event->contact], event->at.secondary,
                     event->at.main};

  bool is(StepEvent::Kind kind) const { return event->kind == kind; }
  bool released() const { return is(StepEvent::Kind::released); }
  std::string_view name() const {
    if (is(StepEvent::Kind::tied)) return "tied";
    if (is(StepEvent::Kind::let_go)) return "let-go";
    return released() ? "released" : "removed";
  }
  IfAny<Ids2> edge() const { return released() ? IfAny<Ids2>{} : sides.edge(); }
  IfAny<std::int64_t> node() const {
    if (!released()) return sides.node();
    return {sides.model->node_id(event->release.node)};
  }
  IfAny<Ids4> segment() const {
    return released() || is(StepEvent::Kind::removed) ? IfAny<Ids4>{} : sides.segment();
  }
};
LINE_RECORD(EventRow, "event", "Something that stays.", COLUMN("step", "", r.event->step),
            COLUMN("time", "", r.event->time), COLUMN("interface", "", r.sides.contact->inter->id),
            COLUMN("role", "", r.sides.contact->role),
            COLUMN("event", "removed, tied, let-go or released", r.name()),
            COLUMN("edge", "", r.edge()), COLUMN("node", "", r.node()),
            COLUMN("segment", "", r.segment()),
            COLUMN("because", reasons,
                   if_any(r.is(StepEvent::Kind::removed), to_string(r.event->because))),
            COLUMN("before", "Bits 4 X + 2 Y + Z of fixed translations",
                   if_any(r.released(), r.event->release.before)),
            COLUMN("after", "", if_any(r.released(), r.event->release.after)));

struct CycleStepsRow {
  const Scene& scene;
  const cycle::StepsOutcome* of;
};
RECORD(CycleStepsRow, "steps", "", COLUMN("count", "", r.of->lines.size()),
       COLUMN("motion", "prescribed: contact forces move nothing", "prescribed"),
       COLUMN("searches", "How often the pairs of a contact were searched", r.of->searches),
       COLUMN("history", "", rows<CycleStepRow>(r.of->lines, r.scene, r.of->lines)),
       COLUMN("events", "", rows<EventRow>(r.of->events, r.scene)));

void each_interface(const CycleDocument& r,
                    const std::function<void(const CycleInterfaceRow&)>& add) {
  for (const InterBase* inter : r.input->scene->interfaces->ordered)
    for (const ContactOutcome& c : r.outcome->contacts)
      if (c.contact->inter == inter && c.contact->role == ContactRole::primary) {
        add({r, inter});
        break;
      }
}

void each_acted_node(const CycleDocument& r, const std::function<void(const ActedRow&)>& add) {
  for (const cycle::ActedNode& n : cycle::acted_nodes(*r.input->state, *r.outcome))
    add({r.model().node_id(n.node), n});
}

std::optional<LimitingRow> limiting_contact(const CycleDocument& r) {
  const cycle::SceneOutcome& o = *r.outcome;
  if (o.limiting_contact == SIZE_MAX) return std::nullopt;
  return LimitingRow{o.contacts[o.limiting_contact].contact->inter->id,
                     id_of(r.model(), o.limiting_node)};
}

std::optional<std::int64_t> structure_element(const CycleDocument& r) {
  const cycle::StructureStep& s = r.outcome->structure;
  if (s.element == no_index) return std::nullopt;
  return r.model().family(s.kind).id[s.element];
}

RECORD(CycleDocument, "document", "",
       COLUMN("deck", "",
              DeckRow{r.input->path, r.input->deck, &r.model(), r.input->scene->interfaces}),
       COLUMN("verdict", "", cycle_verdict(*r.input)),
       COLUMN("gate", "null: no bounds were given", gate_of(*r.input->deck, r.input->gate)),
       COLUMN("compared", "null: nothing was compared",
              comparison_of(*r.input->scene, *r.input->view, r.input->gate)),
       COLUMN("examined", "Interfaces of TYPE7, 10, 11, 19, 24 and 25", r.coverage.examined),
       COLUMN("not_examined", "Interfaces of other types, by keyword",
              rows_of(r.coverage.not_examined)),
       COLUMN("dt1", "Last step", r.input->options.dt1),
       COLUMN("dt12", "Mid-step interval", r.input->options.dt12),
       COLUMN("time", "", r.input->options.time),
       COLUMN("model", "", r.input->options.model == cycle::Model::robust ? "robust" : "reference"),
       COLUMN("accuracy", "", DecisionsRow{r.input->scene}),
       COLUMN("interfaces", "", rows_from<each_interface>(r)),
       COLUMN("effects", "Those that run first", rows_of(effect_sums(*r.input))),
       COLUMN("costs", "With --costs or --html; null: not measured", measured_costs(*r.input)),
       COLUMN("without", "With --without EFFECT",
              if_any(r.input->without != nullptr, WithoutRow{r.input})),
       COLUMN("nodes", "With --all: nodes that some contact pushes or stiffens",
              if_any(r.all, rows_from<each_acted_node>(r))),
       LINE_OBJECT("nodal_force", "The largest.", COLUMN("max", "", r.outcome->largest_nodal_force),
                   COLUMN("node", "", id_of(r.model(), r.outcome->force_node))),
       OBJECT("dt", "Time steps.",
              COLUMN("structure", "Estimate from the elements; null: no limit",
                     limit(r.outcome->structure.dt)),
              COLUMN("contact", "null: no limit", limit(r.outcome->contact_dt)),
              COLUMN("because", sources, source_name(r.outcome->contact_dt_source)),
              COLUMN("limiting", "The interface that limits it", limiting_contact(r)),
              COLUMN("structure_element", "", structure_element(r))),
       COLUMN("steps",
              "With --steps; the rest of the document is the last step. null: one evaluation",
              known(r.input->steps != nullptr, CycleStepsRow{*r.input->scene, r.input->steps})),
       COLUMN("not_evaluated", "What the deck says about its initial state and was left out",
              rows_of(r.input->state->not_evaluated)));

constexpr DocumentHead cycle_head{
    "deck/cycle", 1,
    "Written by deck cycle --json: one contact force evaluation at the initial state of the deck, "
    "in working units. null stands for a number that is not finite."};

}  // namespace

DocumentSchema cycle_schema() { return document_schema<CycleDocument>(cycle_head); }

std::string cycle_json(const CycleInput& input, bool all, const TextDrain& drain) {
  const Scene& scene = *input.scene;
  const Coverage coverage = coverage_of(*input.deck, *scene.interfaces, scene.examined);
  return write_document(cycle_head, CycleDocument{&input, input.outcome, all, coverage}, drain);
}

}  // namespace deck
