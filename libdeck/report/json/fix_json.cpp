// The result of `deck fix` as a JSON document.
#include "report/json/ties_json.hpp"
#include "report/shared/fix.hpp"
#include "report/shared/schemas.hpp"
#include "report/shared_records.hpp"

namespace deck {

// Records of what a fix is made of.
Record<FixCount> record_of(const FixCount*) {
  static constexpr Column<FixCount> columns[] = {
      column<&FixCount::pairs>("pairs"),
      column<&FixCount::nodes>("nodes", "Distinct secondary nodes or edges"),
      column<&FixCount::untreated>(
          "untreated", "Pairs that the solver leaves as they are, or at which it stops"),
      column<&FixCount::on_surface>("on_surface", "Pairs at distance 0"),
      column<&FixCount::deepest>("deepest")};
  return {"count", "Initial penetrations; lengths in working units.", columns, true};
}

Record<FieldChange> record_of(const FieldChange*) {
  static constexpr Column<FieldChange> columns[] = {
      column<&FieldChange::field>("field"),
      column<&FieldChange::old_text>("old_text", "As on the card; empty: blank"),
      column<&FieldChange::new_text>("new_text"),
      column<&FieldChange::old_value>("old_value", "Effective value, working units"),
      column<&FieldChange::new_value>("new_value")};
  return {"change", "", columns, true};
}

Record<NewlyTied> record_of(const NewlyTied*) {
  static constexpr Column<NewlyTied> columns[] = {column<&NewlyTied::node>("node"),
                                                  column<&NewlyTied::segment>("segment"),
                                                  column<&NewlyTied::distance>("distance")};
  return {"newly_tied", "", columns, true};
}

Record<FixedTie> record_of(const FixedTie*) {
  using Row = FixedTie;
  static constexpr Column<Row> columns[] = {
      column<&Row::id>("id"),
      column<&Row::title>("title"),
      column<&Row::reach>("reach", "How far its nodes may be, working units"),
      column<&Row::before>("before"),
      column<&Row::after>("after"),
      column("needed", "Search distance that ties them; null: none are tied",
             [](const Row& r) { return known(!r.nodes.empty(), r.needed); }),
      column<&Row::nodes>("nodes", "Newly tied"),
      column<&Row::changes>("changes")};
  return {"fixed_tie", "A TYPE2 that loses nodes.", columns};
}

Record<FixedInterface> record_of(const FixedInterface*) {
  static constexpr Column<FixedInterface> columns[] = {
      column<&FixedInterface::id>("id"),       column<&FixedInterface::type>("type"),
      column<&FixedInterface::title>("title"), column<&FixedInterface::before>("before"),
      column<&FixedInterface::after>("after"), column<&FixedInterface::changes>("changes")};
  return {"fixed_interface", "", columns};
}

Record<FixRefusal> record_of(const FixRefusal*) {
  using Row = FixRefusal;
  static constexpr Column<Row> columns[] = {
      column<&Row::interface_id>("interface"),
      column<&Row::nodes>("nodes", "Secondary node or edge; empty: the interface as a whole"),
      column<&Row::depth>("depth", "In the deck as it was read"),
      column("distance", "tie: of a node from its nearest segment, working units",
             [](const Row& r) { return known(r.distance > 0, r.distance); }),
      column<&Row::reason>("reason"),
      column("next",
             "Command that goes on from here, without --interface; DECK stands for the deck",
             [](const Row& r) { return known(!r.next.empty(), r.next); })};
  return {"not_treated", "", columns, true};
}

Record<FixScore> record_of(const FixScore*) {
  static constexpr Column<FixScore> columns[] = {
      column<&FixScore::solved>("solved"), column<&FixScore::left>("left"),
      column<&FixScore::not_treated>("not_treated"),
      column<&FixScore::treated_already>("treated_already")};
  return {"score", "Penetrations and untied nodes.", columns, true};
}

Record<MovedNode> record_of(const MovedNode*) {
  using Row = MovedNode;
  static constexpr Column<Row> columns[] = {
      column<&Row::id>("node"),
      column("part", [](const Row& r) { return known(r.part != 0, r.part); }),
      column<&Row::by>("by", "Working units"), column<&Row::distance>("distance")};
  return {"moved_node", "", columns, true};
}

Record<FixAction> record_of(const FixAction*) {
  static constexpr Column<FixAction> columns[] = {
      column<&FixAction::interface_id>("interface"),
      column<&FixAction::secondary>("secondary"),
      column<&FixAction::main>("main"),
      column<&FixAction::depth>("depth"),
      column<&FixAction::gap>("gap"),
      column<&FixAction::before>("before"),
      column<&FixAction::after>("after"),
      column<&FixAction::stops>("solver_stops"),
      column<&FixAction::gap0>("gap_left", "Where the gap is reduced, else 0")};
  return {"fix_action", "inacti, fpenmax: what the solver will do with each penetration.", columns,
          true};
}

namespace {

struct Crossings {
  std::uint64_t before = 0, after = 0;
};
Record<Crossings> record_of(const Crossings*) {
  static constexpr Column<Crossings> columns[] = {column<&Crossings::before>("before"),
                                                  column<&Crossings::after>("after")};
  return {"crossed", "Crossed elements.", columns, true};
}
Crossings crossings_of(const PenetrationFix& fix) {
  return {fix.crossings_before, fix.crossings_after};
}

struct TiedRow {
  std::uint64_t pairs = 0, nodes = 0;
};
Record<TiedRow> record_of(const TiedRow*) {
  static constexpr Column<TiedRow> columns[] = {
      column<&TiedRow::pairs>("pairs"), column<&TiedRow::nodes>("nodes", "Secondary nodes")};
  return {"tied", "", columns, true};
}

struct FixStepRow {
  const PenetrationFix* step = nullptr;
  std::vector<std::int64_t> moved() const {
    std::vector<std::int64_t> ids;
    for (const MovedNode& m : step->moved) ids.push_back(m.id);
    return ids;
  }
};
Record<FixStepRow> record_of(const FixStepRow*) {
  using Row = FixStepRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::step, &PenetrationFix::strategy>("strategy"),
      column<&Row::step, &PenetrationFix::complete>("complete"),
      column("crossings", [](const Row& r) { return crossings_of(*r.step); }),
      column<&Row::step, &PenetrationFix::interfaces>("interfaces"),
      column<&Row::step, &PenetrationFix::ties>("ties"),
      column<&Row::moved>("moved", "Node ids"),
      column("not_treated", "How many", [](const Row& r) { return r.step->refused.size(); }),
      column("score", [](const Row& r) { return score_of(*r.step); })};
  return {"step", "The result of one strategy.", columns};
}

struct FixDocument {
  const LoadedDeck& loaded;
  const PenetrationFix* fix = nullptr;
  std::string_view written;
  const std::vector<PenetrationFix>& steps;
  Coverage coverage = coverage_of(loaded.deck(), loaded.interfaces(), Examined::contacts_and_ties);

  IfAny<Rows<FixStepRow>> steps_if(bool wanted) const {
    return if_any(wanted,
                  rows_of(steps, [](const PenetrationFix& step) { return FixStepRow{&step}; }));
  }
};
Record<FixDocument> record_of(const FixDocument*) {
  using Row = FixDocument;
  static constexpr Column<Row> columns[] = {
      column("deck",
             [](const Row& r) {
               return DeckRow{r.loaded.path(), &r.loaded.deck(), nullptr, nullptr};
             }),
      column<&Row::coverage, &Coverage::examined>("examined",
                                                  "Contacts and ties that are examined"),
      column<&Row::coverage, &Coverage::not_examined>("not_examined",
                                                      "Interfaces of other types, by keyword"),
      column("verdict", "Of the deck as it was read",
             [](const Row& r) { return verdict_of(r.loaded); }),
      column("strategy",
             "Several by commas, in their order; null: none was asked for, see proposals",
             [](const Row& r) { return known(!r.fix->strategy.empty(), r.fix->strategy); }),
      column<&Row::written>("written",
                            "no, diff, in-place, or the directory the deck was written to"),
      column<&Row::fix, &PenetrationFix::complete>("complete",
                                                   "Nothing is left of what the strategy treats"),
      column<&Row::fix, &PenetrationFix::iterations>("iterations"),
      column("tied", "Ties (TYPE2, TYPE10) that stay as they are",
             [](const Row& r) {
               return TiedRow{r.fix->tied_pairs, r.fix->tied_nodes};
             }),
      column("crossings", [](const Row& r) { return crossings_of(*r.fix); }),
      column<&Row::fix, &PenetrationFix::interfaces>("interfaces"),
      column<&Row::fix, &PenetrationFix::ties>("ties", "The TYPE2 that lose nodes"),
      column("proposals", "Without a strategy: what each would do on its own",
             [](const Row& r) { return r.steps_if(r.fix->strategy.empty()); }),
      column(
          "steps", "Of several strategies what each did with what the one before left",
          [](const Row& r) { return r.steps_if(!r.fix->strategy.empty() && r.steps.size() > 1); }),
      column<&Row::fix, &PenetrationFix::moved>("moved"),
      column<&Row::fix, &PenetrationFix::actions>("actions"),
      column<&Row::fix, &PenetrationFix::refused>("not_treated")};
  return {"document", "", columns};
}

constexpr DocumentHead fix_head{"deck/fix", 1, "Written by deck fix --json."};

}  // namespace

DocumentSchema fix_schema() { return document_schema<FixDocument>(fix_head); }

std::string repair_json(const PenetrationFix& fix, std::string_view deck,
                        const std::vector<NextCommand>& next, std::string_view patch) {
  std::string out;
  JsonWriter j(out);
  j.begin_object().field("strategy", fix.strategy);
  write_value(j.key("crossings"), crossings_of(fix));
  write_value(j.key("not_treated"), fix.refused);
  j.key("groups").begin_array();
  for (const RefusedGroup& g : refused_groups({fix}, deck))
    j.begin_object(true).field("text", g.text).field("command", g.command).end_object();
  j.end_array().key("next").begin_array();
  for (const NextCommand& n : next)
    j.begin_object(true).field("does", n.does).field("command", n.command).end_object();
  j.end_array().field("patch", patch).end_object();
  return out;
}

std::string fix_json(const LoadedDeck& loaded, const PenetrationFix& fix, std::string_view written,
                     const std::vector<PenetrationFix>& steps) {
  return write_document(fix_head, FixDocument{loaded, &fix, written, steps}) + '\n';
}

}  // namespace deck
