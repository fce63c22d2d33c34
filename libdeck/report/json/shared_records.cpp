// Tables of the records that several documents have.
#include "report/shared_records.hpp"

#include "deck/front/loaded_deck.hpp"
#include "report/diagnostics_common.hpp"
#include "report/gaps_names.hpp"

namespace deck {
namespace {

struct UnitsRow {
  const UnitSystem* units = nullptr;
};
const Record<UnitsRow>& record_of(const UnitsRow*) {
  using Row = UnitsRow;
  static constexpr Column<Row> columns[] = {
      column<&UnitsRow::units, &UnitSystem::mass_code>("mass"),
      column<&UnitsRow::units, &UnitSystem::length_code>("length"),
      column<&UnitsRow::units, &UnitSystem::time_code>("time")};
  static const Record<Row> record{"units", "Codes of /BEGIN.", columns, true, true};
  return record;
}

struct BothUnits {
  std::optional<UnitsRow> input, working;
};
const Record<BothUnits>& record_of(const BothUnits*) {
  using Row = BothUnits;
  static constexpr Column<Row> columns[] = {
      column<&BothUnits::input>("input", "null: /BEGIN gives none"),
      column<&BothUnits::working>("working")};
  static const Record<Row> record{"unit_systems", "Units of the deck.", columns, true, true};
  return record;
}

struct IncludeRow {
  const Deck* deck = nullptr;
  const IncludeEdge* edge = nullptr;
};
const Record<IncludeRow>& record_of(const IncludeRow*) {
  using Row = IncludeRow;
  static constexpr Column<Row> columns[] = {
      column<Row>("path", "", [](const Row& r) { return r.deck->sources[r.edge->file].path(); }),
      column<&IncludeRow::edge, &IncludeEdge::written>("written", "The name as the deck has it"),
      column<Row>("from", "The line that includes it",
                  [](const Row& r) { return place_of(*r.deck, r.edge->directive); })};
  static const Record<Row> record{"include", "An included file.", columns, true, true};
  return record;
}

Counts counts_of(const DeckRow& r) {
  Counts counts = {{"bytes", r.deck->total_bytes},
                   {"files", r.deck->sources.size()},
                   {"blocks", r.deck->blocks.size()},
                   {"submodels", r.deck->submodels.size()}};
  if (const Model* m = r.model; m != nullptr) {
    counts.emplace_back("nodes", m->nodes.size());
    counts.emplace_back("shells", m->shell4.size() + m->shell3.size());
    counts.emplace_back("solids", m->solid8.size());
    counts.emplace_back("springs_beams_trusses",
                        m->spring.size() + m->beam.size() + m->truss.size());
    counts.emplace_back("parts", m->parts.size());
  }
  if (r.interfaces != nullptr) counts.emplace_back("interfaces", r.interfaces->ordered.size());
  return counts;
}

struct DifferenceRow {
  const Scene* scene = nullptr;
  const DecisionDifference* d = nullptr;
  const Contact& contact() const { return scene->contacts[d->contact]; }
  PairSides sides() const { return {scene->model, &contact(), d->secondary, d->main}; }
};
const Record<DifferenceRow>& record_of(const DifferenceRow*) {
  using Row = DifferenceRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::contact, &Contact::inter, &InterBase::id>("interface"),
      column<&Row::contact, &Contact::role>("role"),
      column<&Row::sides, &PairSides::edge>("edge", "Secondary edge"),
      column<&Row::sides, &PairSides::node>("node", "Secondary node"),
      column<&Row::sides, &PairSides::main_edge>("main_edge"),
      column<&Row::sides, &PairSides::segment>("segment", "Main segment"),
      column<Row>("about", "\"contact\" (nearer than the gap) or \"on_surface\"",
                  [](const Row& r) { return r.d->surface ? "on_surface" : "contact"; }),
      column<&DifferenceRow::d, &DecisionDifference::exact>("exact", "What is true"),
      column<Row>("solver", "What the solver's arithmetic decides",
                  [](const Row& r) { return !r.d->exact; }),
      column<&DifferenceRow::d, &DecisionDifference::gap>("gap"),
      column<&DifferenceRow::d, &DecisionDifference::solver_distance>("solver_distance"),
      column<&DifferenceRow::d, &DecisionDifference::exact_distance>("exact_distance"),
      column<&DifferenceRow::d, &DecisionDifference::action>(
          "action", "What the solver does with the pair; error-611, error-612: it stops")};
  static const Record<Row> record{"difference",
                                  "A pair on which exact arithmetic and the solver's do not agree.",
                                  columns, true, true};
  return record;
}

std::optional<std::uint64_t> differing(const DecisionReport& r, std::uint64_t count) {
  return known(r.mode == Accuracy::robust || r.mode == Accuracy::exact, count);
}

}  // namespace

const Record<EntityRow>& record_of(const EntityRow*) {
  using Row = EntityRow;
  static constexpr Column<Row> columns[] = {column<&EntityRow::d, &Diagnostic::keyword>("keyword"),
                                            column<&EntityRow::d, &Diagnostic::id>("id")};
  static const Record<Row> record{"entity", "", columns, true, true};
  return record;
}

const Record<GateFinding>& record_of(const GateFinding*) {
  using Row = GateFinding;
  static constexpr Column<Row> columns[] = {
      column<Row>("rule", "", [](const Row& r) { return id_text(r.d->rule); }),
      column<Row>("severity", "", [](const Row& r) { return to_string(r.d->severity); }),
      column<&GateFinding::d, &Diagnostic::message>("message"),
      column<Row>("source", "", [](const Row& r) { return place_of(*r.deck, r.d->span); }),
      column<Row>("entity", "",
                  [](const Row& r) { return known(!r.d->keyword.empty(), EntityRow{r.d}); })};
  static const Record<Row> record{"gate_finding", "A bound that is exceeded.", columns, false,
                                  true};
  return record;
}

namespace {

/// A penetration that is new, worse or better than in the earlier document, or solved.
struct ChangedRow {
  std::string_view change;
  std::int64_t interface_id = 0;
  std::string_view role;
  std::array<std::int64_t, 2> secondary{};
  std::optional<double> depth, was;
};
const Record<ChangedRow>& record_of(const ChangedRow*) {
  using Row = ChangedRow;
  static constexpr Column<Row> columns[] = {
      column<&ChangedRow::change>("change", "new, worse, better or solved"),
      column<&ChangedRow::interface_id>("interface"),
      column<&ChangedRow::role>("role"),
      column<Row>("node", "Secondary node",
                  [](const Row& r) { return if_any(r.secondary[1] == 0, r.secondary[0]); }),
      column<Row>("edge", "Secondary edge",
                  [](const Row& r) { return if_any(r.secondary[1] != 0, r.secondary); }),
      column<&ChangedRow::depth>("depth"),
      column<&ChangedRow::was>("was", "Depth in the earlier document")};
  static const Record<Row> record{"changed", "A node or edge, by its deepest pair.", columns, true,
                                  true};
  return record;
}

void each_changed(const ComparedRow& r, const std::function<void(const ChangedRow&)>& add) {
  const EarlierGaps& earlier = *r.gate->earlier;
  for (const GapsComparison::Row& row : r.gate->comparison.rows) {
    if (row.trend == Trend::same) continue;
    const NamedPenetration& p = r.view->penetrations[row.penetration];
    const Contact& contact = r.scene->contacts[p.contact];
    add({to_string(row.trend), contact.inter->id, to_string(contact.role), p.secondary,
         contact.penetrations[p.row].depth,
         row.earlier == no_index ? std::nullopt
                                 : std::optional<double>(earlier.rows[row.earlier].depth)});
  }
  for (const std::uint32_t i : r.gate->comparison.solved) {
    const EarlierGaps::Row& row = earlier.rows[i];
    add({"solved", row.interface_id, row.role, row.secondary, std::nullopt, row.depth});
  }
}

}  // namespace

IfAny<std::array<std::int64_t, 2>> PairSides::edge() const {
  if (!edges()) return {};
  return {node_ids(*model, contact->secondary_edges[secondary].nodes)};
}

IfAny<std::array<std::int64_t, 2>> PairSides::main_edge() const {
  if (!edges()) return {};
  return {node_ids(*model, contact->main_edges[main].nodes)};
}

IfAny<std::int64_t> PairSides::node() const {
  if (edges()) return {};
  return {model->node_id(contact->secondary[secondary].node)};
}

IfAny<std::array<std::int64_t, 4>> PairSides::segment() const {
  if (edges()) return {};
  return {node_ids(*model, contact->main[main].nodes)};
}

const Record<Place>& record_of(const Place*) {
  using Row = Place;
  static constexpr Column<Row> columns[] = {
      column<&Place::file>("file"), column<&Place::line>("line", "From 1 on"),
      column<&Place::column>("column", "From 1 on"),
      column<&Place::end_column>("end_column", "Of a cell: the first column behind it")};
  static const Record<Row> record{"place", "A place in the text of a deck.", columns, true, true};
  return record;
}

std::optional<Place> place_of(const Deck& deck, const Span& span) {
  if (!span.valid()) return std::nullopt;
  const Position p = deck.sources.position(span);
  return Place{deck.sources[span.file].path(), p.line, p.column};
}

const Record<DeckRow>& record_of(const DeckRow*) {
  using Row = DeckRow;
  static constexpr Column<Row> columns[] = {
      column<&DeckRow::path>("path", "As given"),
      column<&DeckRow::deck, &Deck::begin, &Begin::run_name>("title"),
      column<&DeckRow::deck, &Deck::version>("version", "Input version of the main file"),
      column<Row>(
          "units", "",
          [](const Row& r) {
            const Begin& b = r.deck->begin;
            const bool given = b.has_input || b.has_working;
            return BothUnits{known(given, UnitsRow{&b.input}), known(given, UnitsRow{&b.working})};
          }),
      column<counts_of>("counts"),
      column<Row>("includes", "", [](const Row& r) {
        return rows_of(r.deck->includes, [&r](const IncludeEdge& e) {
          return IncludeRow{r.deck, &e};
        });
      })};
  static const Record<Row> record{"deck", "", columns, false, true};
  return record;
}

DeckRow deck_row(const LoadedDeck& loaded) {
  return {loaded.path(), &loaded.deck(), &loaded.model(), &loaded.interfaces()};
}

const Record<NotExamined>& record_of(const NotExamined*) {
  using Row = NotExamined;
  static constexpr Column<Row> columns[] = {
      column<&NotExamined::keyword>("keyword"),
      column<Row>("count", "", [](const Row& r) { return r.ids.size(); }),
      column<&NotExamined::ids>("ids")};
  static const Record<Row> record{"not_examined", "", columns, true, true};
  return record;
}

const Record<VerdictSentence>& record_of(const VerdictSentence*) {
  using Row = VerdictSentence;
  static constexpr Column<Row> columns[] = {
      column<&VerdictSentence::what>("what", "What the sentence is about"),
      column<&VerdictSentence::text>("text"), column<&VerdictSentence::counts>("counts")};
  static const Record<Row> record{"sentence", "", columns, true, true};
  return record;
}

const Record<Verdict>& record_of(const Verdict*) {
  using Row = Verdict;
  static constexpr Column<Row> columns[] = {
      column<&Verdict::level>("level", "The first that applies"),
      column<&Verdict::text>("text", "All sentences"),
      column<Row>("sentences", "", [](const Row& r) { return rows_of(r.sentences); }),
      column<&Verdict::counts>("counts", "Of all sentences, and those that are 0")};
  static const Record<Row> record{"verdict", "The verdict on the deck, equal in every document.",
                                  columns, false, true};
  return record;
}

const Record<ItemCounts>& record_of(const ItemCounts*) {
  using Row = ItemCounts;
  static constexpr Column<Row> columns[] = {column<&ItemCounts::nodes>("nodes"),
                                            column<&ItemCounts::edges>("edges"),
                                            column<&ItemCounts::pairs>("pairs")};
  static const Record<Row> record{
      "item_counts",
      "Distinct secondary nodes, distinct secondary edges, and pairs. They overlap: do not add "
      "them.",
      columns, true, true};
  return record;
}

namespace {

struct TiedCounts {
  std::uint64_t nodes = 0, pairs = 0;
};
const Record<TiedCounts>& record_of(const TiedCounts*) {
  using Row = TiedCounts;
  static constexpr Column<Row> columns[] = {column<&TiedCounts::nodes>("nodes"),
                                            column<&TiedCounts::pairs>("pairs")};
  static const Record<Row> record{"tied_counts", "", columns, true, true};
  return record;
}

}  // namespace

const Record<ContactTotals>& record_of(const ContactTotals*) {
  using Row = ContactTotals;
  static constexpr Column<Row> columns[] = {
      column<&ContactTotals::count, &ItemCounts::pairs>("pairs", "Penetrating pairs"),
      column<&ContactTotals::count, &ItemCounts::nodes>("nodes",
                                                        "Distinct secondary nodes that penetrate"),
      column<&ContactTotals::count, &ItemCounts::edges>("edges",
                                                        "Distinct secondary edges that penetrate"),
      column<Row>("tied", "Nodes and pairs that TYPE10 ties; they are counted here only",
                  [](const Row& r) {
                    return TiedCounts{r.tied.nodes, r.tied.pairs};
                  }),
      column<&ContactTotals::on_segment>("on_segment", "Those that lie exactly on a segment"),
      column<&ContactTotals::crossed_elements>(
          "crossed_elements",
          "Edges of secondary elements that pass through a main segment: the number of all "
          "'crossings'. An edge and the nodes of a segment count once, in the first contact that "
          "has both. null: not looked for"),
      column<&ContactTotals::solver_errors>("solver_errors",
                                            "Nodes for which the solver stops (messages 611, 612)"),
      column<&ContactTotals::acted>(
          "acted", "Pairs that Inacti or Fpenmax changes, without those that stop the solver"),
      column<&ContactTotals::max_depth>("max_depth"),
      column<&ContactTotals::max_ratio>("max_ratio", "Depth to gap")};
  static const Record<Row> record{"totals", "", columns, true, true};
  return record;
}

const Record<DecisionsRow>& record_of(const DecisionsRow*) {
  using Row = DecisionsRow;
  static constexpr Column<Row> columns[] = {
      column<&DecisionsRow::scene, &Scene::decisions, &DecisionReport::mode>("mode"),
      column<&DecisionsRow::scene, &Scene::decisions, &DecisionReport::pairs>("pairs",
                                                                              "Pairs decided"),
      column<&DecisionsRow::scene, &Scene::decisions, &DecisionReport::fallback>(
          "fallback", "Pairs that needed more than double"),
      column<&DecisionsRow::scene, &Scene::decisions, &DecisionReport::exact>(
          "exact", "Pairs that needed exact arithmetic"),
      column<Row>("decisions_differing", "In contact or not; null: not compared (fast, reference)",
                  [](const Row& r) {
                    return differing(r.scene->decisions, r.scene->decisions.contact_differs);
                  }),
      column<Row>("surface_differing", "Exactly on the segment or not",
                  [](const Row& r) {
                    return differing(r.scene->decisions, r.scene->decisions.surface_differs);
                  }),
      column<Row>("differences", "The first 1000 of both kinds", [](const Row& r) {
        return rows_of(r.scene->decisions.differences, [&r](const DecisionDifference& d) {
          return DifferenceRow{r.scene, &d};
        });
      })};
  static const Record<Row> record{
      "accuracy",
      "How contact decisions were made, and where the solver's arithmetic decides differently.",
      columns, false, true};
  return record;
}

const Record<GateRow>& record_of(const GateRow*) {
  using Row = GateRow;
  static constexpr Column<Row> columns[] = {
      column<&GateRow::gate, &GateReport::passed>("passed"),
      column<&GateRow::gate, &GateReport::undecided>("undecided",
                                                     "Contacts that could not be evaluated"),
      column<Row>("findings", "", [](const Row& r) {
        return rows_of(r.gate->findings, [&r](const Diagnostic& d) {
          return GateFinding{r.deck, &d};
        });
      })};
  static const Record<Row> record{
      "gate", "Result of the bounds of --max-depth and its like, or of [gate] in .decklint.toml.",
      columns, false, true};
  return record;
}

const Record<ComparedRow>& record_of(const ComparedRow*) {
  using Row = ComparedRow;
  static constexpr Column<Row> columns[] = {
      column<&ComparedRow::gate, &GateReport::earlier, &EarlierGaps::path>("with"),
      column<&ComparedRow::gate, &GateReport::earlier, &EarlierGaps::deck_path>("deck"),
      column<Row>("new", "", [](const Row& r) { return r.gate->comparison.count(Trend::fresh); }),
      column<Row>("worse", "", [](const Row& r) { return r.gate->comparison.count(Trend::worse); }),
      column<Row>("better", "",
                  [](const Row& r) { return r.gate->comparison.count(Trend::better); }),
      column<Row>("same", "", [](const Row& r) { return r.gate->comparison.count(Trend::same); }),
      column<Row>("solved", "", [](const Row& r) { return r.gate->comparison.solved.size(); }),
      column<Row>("rows", "", [](const Row& r) {
        return Rows<ChangedRow>{[&r](const auto& add) { each_changed(r, add); }};
      })};
  static const Record<Row> record{
      "compared",
      "Against the earlier document of --compare, or of 'compare' in [gate]: nodes and edges, each "
      "by its deepest pair.",
      columns, false, true};
  return record;
}

IfAny<std::optional<GateRow>> gate_of(const Deck& deck, const GateReport* gate) {
  if (gate == nullptr) return {};
  return {known(gate->asked, GateRow{&deck, gate})};
}

IfAny<std::optional<ComparedRow>> comparison_of(const Scene& scene, const SceneView& view,
                                                const GateReport* gate) {
  if (gate == nullptr) return {};
  return {known(gate->earlier != nullptr, ComparedRow{&scene, &view, gate})};
}

const Record<ElementName>& record_of(const ElementName*) {
  using Row = ElementName;
  static constexpr Column<Row> columns[] = {column<&ElementName::id>("id"),
                                            column<&ElementName::part>("part")};
  static const Record<Row> record{"element", "", columns, true, true};
  return record;
}

void write_json_deck(JsonWriter& json, std::string_view path, const Deck& deck, const Model* model,
                     const Interfaces* interfaces) {
  write_value(json.key("deck"), DeckRow{path, &deck, model, interfaces});
}

void write_json_coverage(JsonWriter& json, const Coverage& coverage) {
  json.field("examined", coverage.examined).key("not_examined").begin_array();
  for (const NotExamined& n : coverage.not_examined) write_value(json, n);
  json.end_array();
}

void write_verdict(JsonWriter& json, const Verdict& verdict) {
  write_value(json.key("verdict"), verdict);
}

std::string verdict_json(const Verdict& verdict) {
  std::string text;
  JsonWriter json(text);
  write_value(json, verdict);
  return text;
}

void write_totals(JsonWriter& json, const ContactTotals& totals) { write_members(json, totals); }

void write_gate(JsonWriter& json, const Deck& deck, const Scene& scene, const SceneView& view,
                const GateReport& gate) {
  write_value(json.key("gate"), known(gate.asked, GateRow{&deck, &gate}));
  write_value(json.key("compared"),
              known(gate.earlier != nullptr, ComparedRow{&scene, &view, &gate}));
}

}  // namespace deck
