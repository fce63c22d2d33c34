// The report of a gate, and the document of `deck gate --json`.
#include <algorithm>

#include "report/shared/gate.hpp"
#include "report/shared/schemas.hpp"
#include "report/shared_records.hpp"

namespace deck {
namespace {

/// The arguments of gate_json().
struct GateDocument {
  const LintedDeck* linted = nullptr;
  const GateReport* gate = nullptr;
  const std::vector<const Diagnostic*>* stops = nullptr;
  bool passed = false;
};

/// The comparison in numbers.
struct Compared {
  const GateReport* gate = nullptr;
};
Record<Compared> record_of(const Compared*) {
  using Row = Compared;
  static constexpr Column<Row> columns[] = {
      column<&Row::gate, &GateReport::earlier, &EarlierGaps::path>("with"),
      column<&Row::gate, &GateReport::earlier, &EarlierGaps::deck_path>("deck"),
      column("new", [](const Row& r) { return r.gate->comparison.count(Trend::fresh); }),
      column("worse", [](const Row& r) { return r.gate->comparison.count(Trend::worse); }),
      column("better", [](const Row& r) { return r.gate->comparison.count(Trend::better); }),
      column("same", [](const Row& r) { return r.gate->comparison.count(Trend::same); }),
      column("solved", [](const Row& r) { return r.gate->comparison.solved.size(); })};
  return {"compared", "Nodes and edges, each by its deepest pair, against the earlier document.",
          columns, true};
}

struct Summary {
  const LintResult* result = nullptr;
};
Record<Summary> record_of(const Summary*) {
  static constexpr Column<Summary> columns[] = {
      column<&Summary::result, &LintResult::errors>("errors"),
      column<&Summary::result, &LintResult::warnings>("warnings"),
      column<&Summary::result, &LintResult::infos>("infos"),
      column<&Summary::result, &LintResult::baselined>("baselined", "Known from the baseline")};
  return {"summary", "Findings of lint.", columns, true};
}

Record<GateDocument> record_of(const GateDocument*) {
  using Row = GateDocument;
  static constexpr Column<Row> columns[] = {
      column("deck",
             [](const Row& r) {
               return DeckRow{r.linted->path, r.linted->deck, nullptr, nullptr};
             }),
      column("verdict",
             [](const Row& r) {
               return r.linted->verdict ? *r.linted->verdict : lint_verdict(*r.linted);
             }),
      column<&Row::passed>("passed"),
      column<&Row::gate, &GateReport::undecided>("undecided",
                                                 "Contacts that could not be evaluated"),
      column("findings", "Those that fail the gate",
             [](const Row& r) {
               return Rows<GateFinding>{[&r](const auto& add) {
                 for (const Diagnostic* d : *r.stops) add({r.linted->deck, d});
               }};
             }),
      column("compared", "null: nothing was compared",
             [](const Row& r) { return known(r.gate->earlier != nullptr, Compared{r.gate}); }),
      column("summary", [](const Row& r) { return Summary{r.linted->result}; })};
  return {"document", "", columns};
}

constexpr DocumentHead gate_head{"deck/gate", 1, "Written by deck gate --json."};

}  // namespace

std::size_t undecided_contacts(const Scene& scene) {
  return static_cast<std::size_t>(std::count_if(scene.contacts.begin(), scene.contacts.end(),
                                                [](const Contact& c) { return !c.evaluated; }));
}

GateReport gate_report(const Gate& gate, const Scene& scene, const SceneView& view,
                       const cycle::SceneOutcome* forces, const EarlierGaps* earlier,
                       const ChangedLines* changed) {
  GateReport report;
  report.asked = gate.any();
  if (earlier != nullptr) {
    report.earlier = earlier;
    report.comparison = compare_gaps(*earlier, scene, view);
  }
  if (!report.asked) return report;
  report.undecided = undecided_contacts(scene);
  report.findings = check_gate(gate, scene, view, forces, earlier, changed);
  return report;
}

DocumentSchema gate_schema() { return document_schema<GateDocument>(gate_head); }

std::string gate_json(const LintedDeck& deck, const GateReport& gate,
                      const std::vector<const Diagnostic*>& stops, bool passed) {
  return write_document(gate_head, GateDocument{&deck, &gate, &stops, passed}) + "\n";
}

}  // namespace deck
