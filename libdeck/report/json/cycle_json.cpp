// The document of `deck cycle --json`.
#include "report/cycle_costs.hpp"
#include "report/shared/cycle.hpp"
#include "report/shared/schemas.hpp"
#include "report/shared_records.hpp"

namespace deck {
namespace {

using cycle::ContactOutcome;
using cycle::StepEvent;
using Ids2 = std::array<std::int64_t, 2>;
using Ids4 = std::array<std::int64_t, 4>;
using NodeId = std::optional<std::int64_t>;

/// 1e30 stands for "no limit".
std::optional<double> limit(const double& value) { return known(value < 1e30, value); }

NodeId id_of(const Model& model, NodeIndex n) {
  return n == no_index ? std::nullopt : NodeId(model.node_id(n));
}

const char* source_name(const cycle::StepLimit::Source& source) {
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
constexpr const char* sources = "none, kinematic, stiffness or velocity";
constexpr const char* reasons =
    "mid-surface reached, dtmin (time to the mid-surface), dtmin (stiffness against mass) or no "
    "element left (Idel)";

struct CyclePairRow {
  PairSides sides;
  const cycle::PairOutcome* pair;
};
Record<CyclePairRow> record_of(const CyclePairRow*) {
  using Pair = cycle::PairOutcome;
  static constexpr Column<CyclePairRow> columns[] = {
      column<&CyclePairRow::sides, &PairSides::edge>("edge"),
      column<&CyclePairRow::sides, &PairSides::main_edge>("main_edge"),
      column<&CyclePairRow::sides, &PairSides::node>("node"),
      column<&CyclePairRow::sides, &PairSides::segment>("segment"),
      column<&CyclePairRow::pair, &Pair::weights>("weights",
                                                  "H1..H4; edges: h_s, 1-h_s, h_m, 1-h_m"),
      column<&CyclePairRow::pair, &Pair::force>(
          "force", "On the main side; the secondary side gets the opposite"),
      column<&CyclePairRow::pair, &Pair::penetration>("penetration", "Effective, after Inacti"),
      column<&CyclePairRow::pair, &Pair::gap>("gap", "Effective, after Inacti"),
      column<&CyclePairRow::pair, &Pair::distance>("distance"),
      column<&CyclePairRow::pair, &Pair::k0>("k0", "Pair stiffness before the 1/2 of the law"),
      column<&CyclePairRow::pair, &Pair::k_nodal>("k_nodal")};
  return {"pair", "A pair that has a penetration or a force.", columns, true};
}

struct RemovedRow {
  PairSides sides;
  cycle::Removal::Because because;
};
Record<RemovedRow> record_of(const RemovedRow*) {
  using Row = RemovedRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::sides, &PairSides::edge>("edge"), column<&Row::sides, &PairSides::node>("node"),
      column("because", reasons, [](const Row& r) { return to_string(r.because); })};
  return {"removed", "", columns, true};
}

struct TieChangeRow {
  PairSides sides;
  bool tied;
};
Record<TieChangeRow> record_of(const TieChangeRow*) {
  static constexpr Column<TieChangeRow> columns[] = {
      column<&TieChangeRow::sides, &PairSides::node>("node"),
      column<&TieChangeRow::sides, &PairSides::segment>("segment"),
      column<&TieChangeRow::tied>("tied", "false: it lets go")};
  return {"tie_change", "", columns, true};
}

struct ReleaseRow {
  std::int64_t node;
  unsigned before, after;
};
Record<ReleaseRow> record_of(const ReleaseRow*) {
  static constexpr Column<ReleaseRow> columns[] = {
      column<&ReleaseRow::node>("node"),
      column<&ReleaseRow::before>("before", "Bits 4 X + 2 Y + Z"),
      column<&ReleaseRow::after>("after")};
  return {"release", "Fixed translations of a node that IBC frees.", columns, true};
}

struct CriteriaRow {
  std::int64_t node;
  double radius, penetration;
  std::optional<double> angle;
};
Record<CriteriaRow> record_of(const CriteriaRow*) {
  static constexpr Column<CriteriaRow> columns[] = {
      column<&CriteriaRow::node>("node"),
      column<&CriteriaRow::radius>("radius", "Smallest radius of curvature"),
      column<&CriteriaRow::penetration>("penetration",
                                        "Secondary side: the deepest over Padm times the gap"),
      column<&CriteriaRow::angle>(
          "angle",
          "Secondary side: smallest cosine between the normals of a segment and of its corners "
          "over that of Angladm; below 1 the angle is exceeded")};
  return {"criteria", "What Iadm asks of a node.", columns, true};
}

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
  PairSides sides(const CandidatePair& at) const {
    return {&model(), o->contact, at.secondary, at.main};
  }
  CyclePairRow row(const cycle::PairOutcome& p) const { return {sides(p.at), &p}; }
  RemovedRow row(const cycle::Removal& r) const { return {sides({r.secondary, 0}), r.because}; }
  TieChangeRow row(const cycle::TieChange& t) const { return {sides(t.at), t.tied}; }
  ReleaseRow row(const cycle::NodeRelease& r) const {
    return {model().node_id(r.node), r.before, r.after};
  }
  CriteriaRow row(const cycle::NodeCriteria& c) const {
    return {model().node_id(c.node), c.radius, c.penetration, limit(c.angle)};
  }
  template <class T>
  auto rows(const std::vector<T>& list) const {
    return rows_of(list, [this](const T& value) { return row(value); });
  }
};
Record<CycleContactRow> record_of(const CycleContactRow*) {
  using Row = CycleContactRow;
  using O = ContactOutcome;
  using Totals = cycle::Totals;
  static constexpr Column<Row> of_sum[] = {
      column<&Row::o, &O::totals, &Totals::normal>("normal"),
      column<&Row::o, &O::totals, &Totals::tangential>("tangential"),
      column<&Row::o, &O::totals, &Totals::moment>("moment", "About the origin"),
      column<&Row::o, &O::totals, &Totals::total_abs>("sizes", "Sum of |F|")};
  static constexpr Record<Row> sum{"sum", "Forces on the main side.", of_sum, true};
  static constexpr Column<Row> of_energy[] = {
      column<&Row::o, &O::totals, &Totals::elastic_energy>("elastic"),
      column<&Row::o, &O::totals, &Totals::friction_energy>("friction"),
      column<&Row::o, &O::totals, &Totals::damping_energy>("damping"),
      column<&Row::o, &O::totals, &Totals::friction_heat>("friction_heat")};
  static constexpr Record<Row> energy{"energy", "", of_energy, true};
  static constexpr Column<Row> of_heat[] = {column<&Row::o, &O::heat_secondary>("secondary"),
                                            column<&Row::o, &O::heat_main>("main")};
  static constexpr Record<Row> heat{"heat", "Given to each side in this cycle.", of_heat, true};
  static constexpr Column<Row> of_acceleration[] = {
      column<&Row::o, &O::largest_acceleration>("max"),
      column("node", [](const Row& r) { return id_of(r.model(), r.o->acceleration_node); }),
      column<&Row::o, &O::massless_nodes>("massless_nodes", "With a force")};
  static constexpr Record<Row> acceleration{"acceleration", "", of_acceleration, true};
  static constexpr Column<Row> of_singular[] = {
      column<&Row::o, &O::near_singular_count>("count"),
      column<&Row::o, &O::gap_closed>("gap_closed", "Pairs at their mid-surface"),
      column("worst", "At most 20", [](const Row& r) { return r.rows(r.o->near_singular); })};
  static constexpr Record<Row> near_singular{"near_singular", "Hardly any gap left.", of_singular};
  static constexpr Column<Row> columns[] = {
      column<&Row::o, &O::contact, &Contact::kind>("kind"),
      column<&Row::o, &O::contact, &Contact::role>("role"),
      column<&Row::o, &O::active>("active", "false: outside Tstart..Tstop or before its sensor"),
      column<&Row::o, &O::complete>(
          "complete", "false: nothing was evaluated (too many pairs, values out of range)"),
      column<&Row::o, &O::composition>("composition"),
      column<&Row::o, &O::pairs_in_reach>("pairs_in_reach"),
      column<&Row::o, &O::pairs_with_force>("pairs_with_force"),
      column<&Row::o, &O::pairs_switched_off>(
          "pairs_switched_off",
          "In reach, but without a force: off since start-up, removed, or switched off in this "
          "cycle"),
      group<sum>("sum"),
      group<energy>("energy"),
      group<heat>("heat"),
      column<&Row::o, &O::step, &cycle::StepLimit::dt, &limit>("dt_contact", "null: no limit"),
      column<&Row::o, &O::step, &cycle::StepLimit::source, &source_name>("dt_because", sources),
      column("dt_node", [](const Row& r) { return id_of(r.model(), r.o->step_node); }),
      column("largest_pair", "null: no pair has a force",
             [](const Row& r) { return known(r.o->largest_force > 0, r.row(r.o->largest)); }),
      group<acceleration>("acceleration"),
      group<near_singular>("near_singular"),
      column<&Row::o, &O::pairs_tied>("pairs_tied"),
      column("removed", "What leaves the interface for good after this evaluation",
             [](const Row& r) { return r.rows(r.o->removed); }),
      column("ties", "Pairs that tie or let go in this evaluation",
             [](const Row& r) { return r.rows(r.o->ties); }),
      column("released", [](const Row& r) { return r.rows(r.o->released); }),
      column("criteria", "With Iadm", [](const Row& r) { return r.rows(r.o->criteria); }),
      column("notes", "What the card asks for and was left out",
             [](const Row& r) { return rows_of(r.o->notes); }),
      column("cost", "With --costs or --html; null: not measured",
             [](const Row& r) { return measured_cost(*r.document.input, *r.o); }),
      column("pairs", "With --all: every pair that has a penetration",
             [](const Row& r) { return if_any(r.document.all, r.rows(r.o->pairs)); })};
  return {"contact", "", columns};
}

struct EffectRow {
  const Deck& deck;
  const EffectLine* line;
};
Record<EffectRow> record_of(const EffectRow*) {
  using Row = EffectRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::line, &EffectLine::name>("name"), column<&Row::line, &EffectLine::on>("on"),
      column<&Row::line, &EffectLine::because>("because"),
      column("source", "The cell that decides",
             [](const Row& r) { return place_of(r.deck, r.line->span); })};
  return {"effect", "", columns, true};
}

struct CycleInterfaceRow {
  const CycleDocument& document;
  const InterBase* inter;
  const Deck* deck() const { return document.input->deck; }
};

void each_contact(const CycleInterfaceRow& r,
                  const std::function<void(const CycleContactRow&)>& add) {
  for (const ContactRole role : {ContactRole::primary, ContactRole::reversed, ContactRole::edges})
    for (const ContactOutcome& c : r.document.outcome->contacts)
      if (c.contact->inter == r.inter && c.contact->role == role) add({r.document, &c});
}

Record<CycleInterfaceRow> record_of(const CycleInterfaceRow*) {
  using Row = CycleInterfaceRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::inter, &InterBase::id>("id"),
      column<&Row::inter, &InterBase::type>("type", "7, 10, 11, 19, 24 or 25"),
      column<&Row::inter, &InterBase::title>("title"),
      column("source", [](const Row& r) { return place_of(*r.deck(), r.inter->span); }),
      column("effects",
             [](const Row& r) {
               return rows_of(effect_lines(*r.deck(), *r.document.outcome, *r.inter),
                              [&r](const EffectLine& e) {
                                return EffectRow{*r.deck(), &e};
                              });
             }),
      column("contacts", [](const Row& r) {
        return Rows<CycleContactRow>{[&r](const auto& add) { each_contact(r, add); }};
      })};
  return {"interface", "", columns};
}

struct CycleSummaryRow {
  const cycle::InterfaceSummary* sums;
};
Record<CycleSummaryRow> record_of(const CycleSummaryRow*) {
  using Sums = cycle::InterfaceSummary;
  static constexpr Column<CycleSummaryRow> columns[] = {
      column<&CycleSummaryRow::sums, &Sums::id>("id"),
      column<&CycleSummaryRow::sums, &Sums::pairs_with_force>("pairs_with_force"),
      column<&CycleSummaryRow::sums, &Sums::force_sum>("force_sum",
                                                       "Of the sizes of the pair forces"),
      column<&CycleSummaryRow::sums, &Sums::elastic_energy>("elastic_energy"),
      column<&CycleSummaryRow::sums, &Sums::friction_energy>("friction_energy"),
      column<&CycleSummaryRow::sums, &Sums::damping_energy>("damping_energy"),
      column<&CycleSummaryRow::sums, &Sums::contact_dt, &limit>("contact_dt")};
  return {"interface_sums", "", columns, true};
}

struct WithoutRow {
  const CycleInput* input;
};
Record<WithoutRow> record_of(const WithoutRow*) {
  using Row = WithoutRow;
  using Outcome = cycle::SceneOutcome;
  static constexpr Column<Row> columns[] = {
      column<&Row::input, &CycleInput::without_effect>("effect"),
      column("interfaces",
             [](const Row& r) {
               return rows_of(cycle::summarize(*r.input->scene, *r.input->without),
                              [](const auto& sums) { return CycleSummaryRow{&sums}; });
             }),
      column<&Row::input, &CycleInput::without, &Outcome::largest_nodal_force>(
          "largest_nodal_force"),
      column<&Row::input, &CycleInput::without, &Outcome::contact_dt, &limit>("contact_dt")};
  return {"without", "The evaluation without an effect.", columns};
}

struct ActedRow {
  std::int64_t node;
  cycle::ActedNode of;
};
Record<ActedRow> record_of(const ActedRow*) {
  static constexpr Column<ActedRow> columns[] = {
      column<&ActedRow::node>("node"),
      column<&ActedRow::of, &cycle::ActedNode::force>("force", "On the node"),
      column<&ActedRow::of, &cycle::ActedNode::stiffness>("stiffness"),
      column<&ActedRow::of, &cycle::ActedNode::dt, &limit>(
          "dt", "0.9 sqrt(2 m / stiffness); null: no mass or no stiffness")};
  return {"acted_node", "Of all contacts together.", columns, true};
}

struct LimitingRow {
  std::int64_t interface_id;
  NodeId node;
};
Record<LimitingRow> record_of(const LimitingRow*) {
  static constexpr Column<LimitingRow> columns[] = {column<&LimitingRow::interface_id>("interface"),
                                                    column<&LimitingRow::node>("node")};
  return {"limiting", "", columns, true};
}

struct StepContactRow {
  const Contact* contact;
  const cycle::StepContact* of;
};
Record<StepContactRow> record_of(const StepContactRow*) {
  using Of = cycle::StepContact;
  static constexpr Column<StepContactRow> columns[] = {
      column<&StepContactRow::contact, &Contact::inter, &InterBase::id>("interface"),
      column<&StepContactRow::contact, &Contact::role>("role"),
      column<&StepContactRow::of, &Of::active>("active"),
      column<&StepContactRow::of, &Of::pairs_with_force>("pairs_with_force"),
      column<&StepContactRow::of, &Of::pairs_tied>("pairs_tied"),
      column<&StepContactRow::of, &Of::removed>("removed", "Secondary nodes or edges, so far"),
      column<&StepContactRow::of, &Of::normal>("normal"),
      column<&StepContactRow::of, &Of::tangential>("tangential"),
      column<&StepContactRow::of, &Of::force_sum>("sizes"),
      column<&StepContactRow::of, &Of::elastic_energy>("elastic"),
      column<&StepContactRow::of, &Of::friction_energy>("friction"),
      column<&StepContactRow::of, &Of::damping_energy>("damping")};
  return {"step_contact", "", columns, true};
}

struct CycleStepRow {
  const Scene& scene;
  std::size_t step;
  const cycle::StepLine* line;
};
Record<CycleStepRow> record_of(const CycleStepRow*) {
  using Row = CycleStepRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::step>("step", "From 0 on"), column<&Row::line, &cycle::StepLine::time>("time"),
      column<&Row::line, &cycle::StepLine::dt1>("dt1"), column("contacts", [](const Row& r) {
        return rows_of(r.line->contacts, [&r](const cycle::StepContact& c) {
          const auto i = static_cast<std::size_t>(&c - r.line->contacts.data());
          return StepContactRow{&r.scene.contacts[i], &c};
        });
      })};
  return {"step", "", columns};
}

struct EventRow {
  const StepEvent* event;
  PairSides sides;

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
Record<EventRow> record_of(const EventRow*) {
  using Row = EventRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::event, &StepEvent::step>("step"),
      column<&Row::event, &StepEvent::time>("time"),
      column<&Row::sides, &PairSides::contact, &Contact::inter, &InterBase::id>("interface"),
      column<&Row::sides, &PairSides::contact, &Contact::role>("role"),
      column<&Row::name>("event", "removed, tied, let-go or released"),
      column<&Row::edge>("edge"),
      column<&Row::node>("node"),
      column<&Row::segment>("segment"),
      column("because", reasons,
             [](const Row& r) {
               return if_any(r.is(StepEvent::Kind::removed), to_string(r.event->because));
             }),
      column("before", "Bits 4 X + 2 Y + Z of fixed translations",
             [](const Row& r) { return if_any(r.released(), r.event->release.before); }),
      column("after", [](const Row& r) { return if_any(r.released(), r.event->release.after); })};
  return {"event", "Something that stays.", columns, true};
}

struct CycleStepsRow {
  const Scene& scene;
  const cycle::StepsOutcome* of;
};
Record<CycleStepsRow> record_of(const CycleStepsRow*) {
  using Row = CycleStepsRow;
  static constexpr Column<Row> columns[] = {
      column("count", [](const Row& r) { return r.of->lines.size(); }),
      column("motion", "prescribed: contact forces move nothing",
             [](const Row&) { return "prescribed"; }),
      column<&Row::of, &cycle::StepsOutcome::searches>(
          "searches", "How often the pairs of a contact were searched"),
      column("history",
             [](const Row& r) {
               return rows_of(r.of->lines, [&r](const cycle::StepLine& line) {
                 const auto step = static_cast<std::size_t>(&line - r.of->lines.data());
                 return CycleStepRow{r.scene, step, &line};
               });
             }),
      column("events", [](const Row& r) {
        return rows_of(r.of->events, [&r](const StepEvent& e) {
          const Contact& contact = r.scene.contacts[e.contact];
          return EventRow{&e, {r.scene.model, &contact, e.at.secondary, e.at.main}};
        });
      })};
  return {"steps", "", columns};
}

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

Record<CycleDocument> record_of(const CycleDocument*) {
  using Row = CycleDocument;
  using In = CycleInput;
  using Out = cycle::SceneOutcome;
  using Options = cycle::CycleOptions;
  static constexpr Column<Row> of_force[] = {
      column<&Row::outcome, &Out::largest_nodal_force>("max"),
      column("node", [](const Row& r) { return id_of(r.model(), r.outcome->force_node); })};
  static constexpr Record<Row> nodal_force{"nodal_force", "The largest.", of_force, true};
  static constexpr Column<Row> of_dt[] = {
      column<&Row::outcome, &Out::structure, &cycle::StructureStep::dt, &limit>(
          "structure", "Estimate from the elements; null: no limit"),
      column<&Row::outcome, &Out::contact_dt, &limit>("contact", "null: no limit"),
      column<&Row::outcome, &Out::contact_dt_source, &source_name>("because", sources),
      column<&limiting_contact>("limiting", "The interface that limits it"),
      column<&structure_element>("structure_element")};
  static constexpr Record<Row> dt{"dt", "Time steps.", of_dt};
  static constexpr Column<Row> columns[] = {
      column("deck",
             [](const Row& r) {
               const Scene& scene = *r.input->scene;
               return DeckRow{r.input->path, r.input->deck, scene.model, scene.interfaces};
             }),
      column("verdict", [](const Row& r) { return cycle_verdict(*r.input); }),
      column("gate", "null: no bounds were given",
             [](const Row& r) { return gate_of(*r.input->deck, r.input->gate); }),
      column("compared", "null: nothing was compared",
             [](const Row& r) {
               return comparison_of(*r.input->scene, *r.input->view, r.input->gate);
             }),
      column<&Row::coverage, &Coverage::examined>("examined",
                                                  "Interfaces of TYPE7, 10, 11, 19, 24 and 25"),
      column("not_examined", "Interfaces of other types, by keyword",
             [](const Row& r) { return rows_of(r.coverage.not_examined); }),
      column<&Row::input, &In::options, &Options::dt1>("dt1", "Last step"),
      column<&Row::input, &In::options, &Options::dt12>("dt12", "Mid-step interval"),
      column<&Row::input, &In::options, &Options::time>("time"),
      column("model",
             [](const Row& r) {
               return r.input->options.model == cycle::Model::robust ? "robust" : "reference";
             }),
      column("accuracy", [](const Row& r) { return DecisionsRow{r.input->scene}; }),
      column("interfaces",
             [](const Row& r) {
               return Rows<CycleInterfaceRow>{[&r](const auto& add) { each_interface(r, add); }};
             }),
      column("costs", "With --costs or --html; null: not measured",
             [](const Row& r) { return measured_costs(*r.input); }),
      column("without", "With --without EFFECT",
             [](const Row& r) { return if_any(r.input->without != nullptr, WithoutRow{r.input}); }),
      column("nodes", "With --all: nodes that some contact pushes or stiffens",
             [](const Row& r) {
               return if_any(r.all,
                             Rows<ActedRow>{[&r](const auto& add) { each_acted_node(r, add); }});
             }),
      group<nodal_force>("nodal_force"),
      group<dt>("dt"),
      column(
          "steps", "With --steps; the rest of the document is the last step. null: one evaluation",
          [](const Row& r) {
            return known(r.input->steps != nullptr, CycleStepsRow{*r.input->scene, r.input->steps});
          }),
      column("not_evaluated", "What the deck says about its initial state and was left out",
             [](const Row& r) { return rows_of(r.input->state->not_evaluated); })};
  return {"document", "", columns};
}

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
