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
Record<UnitsRow> record_of(const UnitsRow*) {
  static constexpr Column<UnitsRow> columns[] = {
      column<&UnitsRow::units, &UnitSystem::mass_code>("mass"),
      column<&UnitsRow::units, &UnitSystem::length_code>("length"),
      column<&UnitsRow::units, &UnitSystem::time_code>("time")};
  return {"units", "Codes of /BEGIN.", columns, true, true};
}

struct BothUnits {
  std::optional<UnitsRow> input, working;
};
Record<BothUnits> record_of(const BothUnits*) {
  static constexpr Column<BothUnits> columns[] = {
      column<&BothUnits::input>("input", "null: /BEGIN gives none"),
      column<&BothUnits::working>("working")};
  return {"unit_systems", "Units of the deck.", columns, true, true};
}

struct IncludeRow {
  const Deck* deck = nullptr;
  const IncludeEdge* edge = nullptr;
};
Record<IncludeRow> record_of(const IncludeRow*) {
  using Row = IncludeRow;
  static constexpr Column<Row> columns[] = {
      column("path", [](const Row& r) { return r.deck->sources[r.edge->file].path(); }),
      column<&IncludeRow::edge, &IncludeEdge::written>("written", "The name as the deck has it"),
      column("from", "The line that includes it",
             [](const Row& r) { return place_of(*r.deck, r.edge->directive); })};
  return {"include", "An included file.", columns, true, true};
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
Record<DifferenceRow> record_of(const DifferenceRow*) {
  using Row = DifferenceRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::contact, &Contact::inter, &InterBase::id>("interface"),
      column<&Row::contact, &Contact::role>("role"),
      column<&Row::sides, &PairSides::edge>("edge", "Secondary edge"),
      column<&Row::sides, &PairSides::node>("node", "Secondary node"),
      column<&Row::sides, &PairSides::main_edge>("main_edge"),
      column<&Row::sides, &PairSides::segment>("segment", "Main segment"),
      column("about", "\"contact\" (nearer than the gap) or \"on_surface\"",
             [](const Row& r) { return r.d->surface ? "on_surface" : "contact"; }),
      column<&DifferenceRow::d, &DecisionDifference::exact>("exact", "What is true"),
      column("solver", "What the solver's arithmetic decides",
             [](const Row& r) { return !r.d->exact; }),
      column<&DifferenceRow::d, &DecisionDifference::gap>("gap"),
      column<&DifferenceRow::d, &DecisionDifference::solver_distance>("solver_distance"),
      column<&DifferenceRow::d, &DecisionDifference::exact_distance>("exact_distance"),
      column<&DifferenceRow::d, &DecisionDifference::action>(
          "action", "What the solver does with the pair; error-611, error-612: it stops")};
  return {"difference", "A pair on which exact arithmetic and the solver's do not agree.", columns,
          true, true};
}

std::optional<std::uint64_t> differing(const DecisionReport& r, std::uint64_t count) {
  return known(r.mode == Accuracy::robust || r.mode == Accuracy::exact, count);
}

}  // namespace

Record<EntityRow> record_of(const EntityRow*) {
  static constexpr Column<EntityRow> columns[] = {
      column<&EntityRow::d, &Diagnostic::keyword>("keyword"),
      column<&EntityRow::d, &Diagnostic::id>("id")};
  return {"entity", "", columns, true, true};
}

Record<GateFinding> record_of(const GateFinding*) {
  using Row = GateFinding;
  static constexpr Column<Row> columns[] = {
      column("rule", [](const Row& r) { return id_text(r.d->rule); }),
      column("severity", [](const Row& r) { return to_string(r.d->severity); }),
      column<&GateFinding::d, &Diagnostic::message>("message"),
      column("source", [](const Row& r) { return place_of(*r.deck, r.d->span); }),
      column("entity", [](const Row& r) { return known(!r.d->keyword.empty(), EntityRow{r.d}); })};
  return {"gate_finding", "A bound that is exceeded.", columns, false, true};
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
Record<ChangedRow> record_of(const ChangedRow*) {
  using Row = ChangedRow;
  static constexpr Column<Row> columns[] = {
      column<&ChangedRow::change>("change", "new, worse, better or solved"),
      column<&ChangedRow::interface_id>("interface"),
      column<&ChangedRow::role>("role"),
      column("node", "Secondary node",
             [](const Row& r) { return if_any(r.secondary[1] == 0, r.secondary[0]); }),
      column("edge", "Secondary edge",
             [](const Row& r) { return if_any(r.secondary[1] != 0, r.secondary); }),
      column<&ChangedRow::depth>("depth"),
      column<&ChangedRow::was>("was", "Depth in the earlier document")};
  return {"changed", "A node or edge, by its deepest pair.", columns, true, true};
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

Record<SourcePlace> record_of(const SourcePlace*) {
  static constexpr Column<SourcePlace> columns[] = {
      column<&SourcePlace::file>("file"), column<&SourcePlace::line>("line", "From 1 on"),
      column<&SourcePlace::column>("column", "From 1 on"),
      column<&SourcePlace::end_column>("end_column", "Of a cell: the first column behind it")};
  return {"place", "A place in the text of a deck.", columns, true, true};
}

std::optional<SourcePlace> place_of(const Deck& deck, const Span& span) {
  if (!span.valid()) return std::nullopt;
  const Position p = deck.sources.position(span);
  return SourcePlace{deck.sources[span.file].path(), p.line, p.column};
}

Record<DeckRow> record_of(const DeckRow*) {
  using Row = DeckRow;
  static constexpr Column<Row> columns[] = {
      column<&DeckRow::path>("path", "As given"),
      column<&DeckRow::deck, &Deck::begin, &Begin::run_name>("title"),
      column<&DeckRow::deck, &Deck::version>("version", "Input version of the main file"),
      column(
          "units",
          [](const Row& r) {
            const Begin& b = r.deck->begin;
            const bool given = b.has_input || b.has_working;
            return BothUnits{known(given, UnitsRow{&b.input}), known(given, UnitsRow{&b.working})};
          }),
      column<counts_of>("counts"),
      column("includes", [](const Row& r) {
        return rows_of(r.deck->includes, [&r](const IncludeEdge& e) {
          return IncludeRow{r.deck, &e};
        });
      })};
  return {"deck", "", columns, false, true};
}

DeckRow deck_row(const LoadedDeck& loaded) {
  return {loaded.path(), &loaded.deck(), &loaded.model(), &loaded.interfaces()};
}

Record<NotExamined> record_of(const NotExamined*) {
  using Row = NotExamined;
  static constexpr Column<Row> columns[] = {
      column<&NotExamined::keyword>("keyword"),
      column("count", [](const Row& r) { return r.ids.size(); }), column<&NotExamined::ids>("ids")};
  return {"not_examined", "", columns, true, true};
}

Record<VerdictSentence> record_of(const VerdictSentence*) {
  static constexpr Column<VerdictSentence> columns[] = {
      column<&VerdictSentence::what>("what", "What the sentence is about"),
      column<&VerdictSentence::text>("text"), column<&VerdictSentence::counts>("counts")};
  return {"sentence", "", columns, true, true};
}

Record<Verdict> record_of(const Verdict*) {
  using Row = Verdict;
  static constexpr Column<Row> columns[] = {
      column<&Verdict::level>("level", "The first that applies"),
      column<&Verdict::text>("text", "All sentences"),
      column("sentences", [](const Row& r) { return rows_of(r.sentences); }),
      column<&Verdict::counts>("counts", "Of all sentences, and those that are 0")};
  return {"verdict", "The verdict on the deck, equal in every document.", columns, false, true};
}

Record<ItemCounts> record_of(const ItemCounts*) {
  static constexpr Column<ItemCounts> columns[] = {column<&ItemCounts::nodes>("nodes"),
                                                   column<&ItemCounts::edges>("edges"),
                                                   column<&ItemCounts::pairs>("pairs")};
  return {"item_counts",
          "Distinct secondary nodes, distinct secondary edges, and pairs. They overlap: do not add "
          "them.",
          columns, true, true};
}

namespace {

struct TiedCounts {
  std::uint64_t nodes = 0, pairs = 0;
};
Record<TiedCounts> record_of(const TiedCounts*) {
  static constexpr Column<TiedCounts> columns[] = {column<&TiedCounts::nodes>("nodes"),
                                                   column<&TiedCounts::pairs>("pairs")};
  return {"tied_counts", "", columns, true, true};
}

}  // namespace

Record<ContactTotals> record_of(const ContactTotals*) {
  using Row = ContactTotals;
  static constexpr Column<Row> columns[] = {
      column<&ContactTotals::count, &ItemCounts::pairs>("pairs", "Penetrating pairs"),
      column<&ContactTotals::count, &ItemCounts::nodes>("nodes",
                                                        "Distinct secondary nodes that penetrate"),
      column<&ContactTotals::count, &ItemCounts::edges>("edges",
                                                        "Distinct secondary edges that penetrate"),
      column("tied", "Nodes and pairs that TYPE10 ties; they are counted here only",
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
  return {"totals", "", columns, true, true};
}

Record<DecisionsRow> record_of(const DecisionsRow*) {
  using Row = DecisionsRow;
  static constexpr Column<Row> columns[] = {
      column<&DecisionsRow::scene, &Scene::decisions, &DecisionReport::mode>("mode"),
      column<&DecisionsRow::scene, &Scene::decisions, &DecisionReport::pairs>("pairs",
                                                                              "Pairs decided"),
      column<&DecisionsRow::scene, &Scene::decisions, &DecisionReport::fallback>(
          "fallback", "Pairs that needed more than double"),
      column<&DecisionsRow::scene, &Scene::decisions, &DecisionReport::exact>(
          "exact", "Pairs that needed exact arithmetic"),
      column("decisions_differing", "In contact or not; null: not compared (fast, reference)",
             [](const Row& r) {
               return differing(r.scene->decisions, r.scene->decisions.contact_differs);
             }),
      column("surface_differing", "Exactly on the segment or not",
             [](const Row& r) {
               return differing(r.scene->decisions, r.scene->decisions.surface_differs);
             }),
      column("differences", "The first 1000 of both kinds", [](const Row& r) {
        return rows_of(r.scene->decisions.differences, [&r](const DecisionDifference& d) {
          return DifferenceRow{r.scene, &d};
        });
      })};
  return {"accuracy",
          "How contact decisions were made, and where the solver's arithmetic decides differently.",
          columns, false, true};
}

Record<GateRow> record_of(const GateRow*) {
  using Row = GateRow;
  static constexpr Column<Row> columns[] = {
      column<&GateRow::gate, &GateReport::passed>("passed"),
      column<&GateRow::gate, &GateReport::undecided>("undecided",
                                                     "Contacts that could not be evaluated"),
      column("findings", [](const Row& r) {
        return rows_of(r.gate->findings, [&r](const Diagnostic& d) {
          return GateFinding{r.deck, &d};
        });
      })};
  return {"gate",
          "Result of the bounds of --max-depth and its like, or of [gate] in .decklint.toml.",
          columns, false, true};
}

Record<ComparedRow> record_of(const ComparedRow*) {
  using Row = ComparedRow;
  static constexpr Column<Row> columns[] = {
      column<&ComparedRow::gate, &GateReport::earlier, &EarlierGaps::path>("with"),
      column<&ComparedRow::gate, &GateReport::earlier, &EarlierGaps::deck_path>("deck"),
      column("new", [](const Row& r) { return r.gate->comparison.count(Trend::fresh); }),
      column("worse", [](const Row& r) { return r.gate->comparison.count(Trend::worse); }),
      column("better", [](const Row& r) { return r.gate->comparison.count(Trend::better); }),
      column("same", [](const Row& r) { return r.gate->comparison.count(Trend::same); }),
      column("solved", [](const Row& r) { return r.gate->comparison.solved.size(); }),
      column("rows", [](const Row& r) {
        return Rows<ChangedRow>{[&r](const auto& add) { each_changed(r, add); }};
      })};
  return {
      "compared",
      "Against the earlier document of --compare, or of 'compare' in [gate]: nodes and edges, each "
      "by its deepest pair.",
      columns, false, true};
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

Record<ElementName> record_of(const ElementName*) {
  static constexpr Column<ElementName> columns[] = {column<&ElementName::id>("id"),
                                                    column<&ElementName::part>("part")};
  return {"element", "", columns, true, true};
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

std::string verdict_json(const Verdict& verdict) {
  std::string text;
  JsonWriter json(text);
  write_value(json, verdict);
  return text;
}

void write_gate(JsonWriter& json, const Deck& deck, const Scene& scene, const SceneView& view,
                const GateReport& gate) {
  write_value(json.key("gate"), known(gate.asked, GateRow{&deck, &gate}));
  write_value(json.key("compared"),
              known(gate.earlier != nullptr, ComparedRow{&scene, &view, &gate}));
}

}  // namespace deck
