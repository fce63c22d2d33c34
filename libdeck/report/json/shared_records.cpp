// Records that several documents have.
#include "report/shared_records.hpp"

#include "deck/loaded_deck.hpp"
#include "report/shared/findings.hpp"

namespace deck {

COMMON_LINE_RECORD(UnitSystem, "units", "Codes of /BEGIN.", COLUMN("mass", "", r.mass_code),
                   COLUMN("length", "", r.length_code), COLUMN("time", "", r.time_code));

namespace {

/// Units of a deck; null without units in /BEGIN.
struct BothUnits {
  const Begin* begin = nullptr;
  std::optional<UnitSystem> known_units(const UnitSystem& units) const {
    return known(begin->has_input || begin->has_working, units);
  }
};
COMMON_LINE_RECORD(BothUnits, "unit_systems", "Units of the deck.",
                   COLUMN("input", "null: /BEGIN gives none", r.known_units(r.begin->input)),
                   COLUMN("working", "", r.known_units(r.begin->working)));

struct IncludeRow {
  const Deck* deck = nullptr;
  const IncludeEdge* edge = nullptr;
};
COMMON_LINE_RECORD(IncludeRow, "include", "An included file.",
                   COLUMN("path", "", r.deck->sources[r.edge->file].path()),
                   COLUMN("written", "The name as the deck has it", r.edge->written),
                   COLUMN("from", "The line that includes it",
                          place_of(*r.deck, r.edge->directive)));

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
COMMON_LINE_RECORD(DifferenceRow, "difference",
                   "A pair on which exact arithmetic and the solver's do not agree.",
                   COLUMN("interface", "", r.contact().inter->id),
                   COLUMN("role", "", r.contact().role),
                   COLUMN("edge", "Secondary edge", r.sides().edge()),
                   COLUMN("node", "Secondary node", r.sides().node()),
                   COLUMN("main_edge", "", r.sides().main_edge()),
                   COLUMN("segment", "Main segment", r.sides().segment()),
                   COLUMN("about", "\"contact\" (nearer than the gap) or \"on_surface\"",
                          r.d->surface ? "on_surface" : "contact"),
                   COLUMN("exact", "What is true", r.d->exact),
                   COLUMN("solver", "What the solver's arithmetic decides", !r.d->exact),
                   COLUMN("gap", "", r.d->gap), COLUMN("solver_distance", "", r.d->solver_distance),
                   COLUMN("exact_distance", "", r.d->exact_distance),
                   COLUMN("action",
                          "What the solver does with the pair; error-611, error-612: it stops",
                          r.d->action));

struct TiedCounts {
  std::uint64_t nodes = 0, pairs = 0;
};
COMMON_LINE_RECORD(TiedCounts, "tied_counts", "", COLUMN("nodes", "", r.nodes),
                   COLUMN("pairs", "", r.pairs));

std::optional<std::uint64_t> differing(const DecisionReport& r, std::uint64_t count) {
  return known(r.mode == Accuracy::robust || r.mode == Accuracy::exact, count);
}

}  // namespace

COMMON_LINE_RECORD(EntityRow, "entity", "", COLUMN("keyword", "", r.d->keyword),
                   COLUMN("id", "", r.d->id));

COMMON_LINE_RECORD(SourcePlace, "place", "A place in the text of a deck.",
                   COLUMN("file", "", r.file), COLUMN("line", "From 1 on", r.line),
                   COLUMN("column", "From 1 on", r.column),
                   COLUMN("end_column", "Of a cell: the first column behind it", r.end_column));

std::optional<SourcePlace> place_of(const Deck& deck, const Span& span) {
  if (!span.valid()) return std::nullopt;
  const Position p = deck.sources.position(span);
  return SourcePlace{deck.sources[span.file].path(), p.line, p.column};
}

COMMON_RECORD(DeckRow, "deck", "", COLUMN("path", "As given", r.path),
              COLUMN("title", "", r.deck->begin.run_name),
              COLUMN("version", "Input version of the main file", r.deck->version),
              COLUMN("units", "", BothUnits{&r.deck->begin}), COLUMN("counts", "", counts_of(r)),
              COLUMN("includes", "", rows<IncludeRow>(r.deck->includes, r.deck)));

DeckRow deck_row(const LoadedDeck& loaded) {
  return {loaded.path(), &loaded.deck(), &loaded.model(), &loaded.interfaces()};
}

COMMON_LINE_RECORD(NotExamined, "not_examined", "", COLUMN("keyword", "", r.keyword),
                   COLUMN("count", "", r.ids.size()), COLUMN("ids", "", r.ids));

COMMON_LINE_RECORD(VerdictSentence, "sentence", "",
                   COLUMN("what", "What the sentence is about", r.what), COLUMN("text", "", r.text),
                   COLUMN("counts", "", r.counts));

COMMON_RECORD(Verdict, "verdict", "The verdict on the deck, equal in every document.",
              COLUMN("level", "The first that applies", r.level),
              COLUMN("text", "All sentences", r.text),
              COLUMN("sentences", "", rows_of(r.sentences)),
              COLUMN("counts", "Of all sentences, and those that are 0", r.counts));

COMMON_LINE_RECORD(
    ItemCounts, "item_counts",
    "Distinct secondary nodes, distinct secondary edges, and pairs. They overlap: do not add them.",
    COLUMN("nodes", "", r.nodes), COLUMN("edges", "", r.edges), COLUMN("pairs", "", r.pairs));

COMMON_LINE_RECORD(
    ContactTotals, "totals", "", COLUMN("pairs", "Penetrating pairs", r.count.pairs),
    COLUMN("nodes", "Distinct secondary nodes that penetrate", r.count.nodes),
    COLUMN("edges", "Distinct secondary edges that penetrate", r.count.edges),
    COLUMN("tied", "Nodes and pairs that TYPE10 ties; they are counted here only",
           TiedCounts{r.tied.nodes, r.tied.pairs}),
    COLUMN("on_segment", "Those that lie exactly on a segment", r.on_segment),
    COLUMN("crossed_elements",
           "Edges of secondary elements that pass through a main segment: the number of all "
           "'crossings'. An edge and the nodes of a segment count once, in the first contact that "
           "has both. null: not looked for",
           r.crossed_elements),
    COLUMN("solver_errors", "Nodes for which the solver stops (messages 611, 612)",
           r.solver_errors),
    COLUMN("acted", "Pairs that Inacti or Fpenmax changes, without those that stop the solver",
           r.acted),
    COLUMN("max_depth", "", r.max_depth), COLUMN("max_ratio", "Depth to gap", r.max_ratio));

COMMON_RECORD(
    DecisionsRow, "accuracy",
    "How contact decisions were made, and where the solver's arithmetic decides differently.",
    COLUMN("mode", "", r.scene->decisions.mode),
    COLUMN("pairs", "Pairs decided", r.scene->decisions.pairs),
    COLUMN("fallback", "Pairs that needed more than double", r.scene->decisions.fallback),
    COLUMN("exact", "Pairs that needed exact arithmetic", r.scene->decisions.exact),
    COLUMN("decisions_differing", "In contact or not; null: not compared (fast, reference)",
           differing(r.scene->decisions, r.scene->decisions.contact_differs)),
    COLUMN("surface_differing", "Exactly on the segment or not",
           differing(r.scene->decisions, r.scene->decisions.surface_differs)),
    COLUMN("differences", "The first 1000 of both kinds",
           rows<DifferenceRow>(r.scene->decisions.differences, r.scene)));

COMMON_LINE_RECORD(ElementName, "element", "", COLUMN("id", "", r.id), COLUMN("part", "", r.part));

RECORD(CoverageRow, "coverage", "", coverage_columns);

void write_json_deck(JsonWriter& json, std::string_view path, const Deck& deck, const Model* model,
                     const Interfaces* interfaces) {
  write_value(json.key("deck"), DeckRow{path, &deck, model, interfaces});
}

std::string verdict_json(const Verdict& verdict) {
  std::string text;
  JsonWriter json(text);
  write_value(json, verdict);
  return text;
}

}  // namespace deck
