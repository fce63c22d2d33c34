// The loss report: what a conversion cannot keep.
#include "report/shared/deck_json.hpp"
#include "report/shared/schemas.hpp"
#include "report/shared_records.hpp"

namespace deck {
namespace {

struct LossLists {
  const std::vector<LossEntry>* losses = nullptr;
  Rows<LossEntry> of(Loss loss) const {
    return {[this, loss](const auto& add) {
      for (const LossEntry& e : *losses)
        if (e.loss == loss) add(e);
    }};
  }
};
Record<LossLists> record_of(const LossLists*) {
  using Row = LossLists;
  static constexpr Column<Row> columns[] = {
      column("kept", [](const Row& r) { return r.of(Loss::kept); }),
      column("approximated", [](const Row& r) { return r.of(Loss::approximated); }),
      column("dropped", [](const Row& r) { return r.of(Loss::dropped); }),
      column("undecided", [](const Row& r) { return r.of(Loss::undecided); })};
  return {"document", "", columns};
}

constexpr DocumentHead losses_head{"deck/losses", 1,
                                   "Written by deck convert --report: cells and blocks that the "
                                   "conversion changed in a way worth knowing.",
                                   false};

}  // namespace

Record<LossEntry> record_of(const LossEntry*) {
  using Row = LossEntry;
  static constexpr Column<Row> columns[] = {
      column<&Row::file>("file"),
      column<&Row::line>("line"),
      column("column", "First column of the text that changed; not of a whole block",
             [](const Row& r) { return if_any(r.column > 0, r.column); }),
      column("end_column", "Last column of the text that was there",
             [](const Row& r) { return if_any(r.column > 0, r.end_column); }),
      column<&Row::keyword>("keyword"),
      column<&Row::id>("id"),
      column<&Row::field>("field", "Empty: the block as a whole"),
      column<&Row::old_text>("old"),
      column<&Row::new_text>("new"),
      column<&Row::note>("note")};
  return {"entry", "", columns};
}

DocumentSchema losses_schema() { return document_schema<LossLists>(losses_head); }

std::string losses_json(const std::vector<LossEntry>& losses) {
  return write_document(losses_head, LossLists{&losses}) + '\n';
}

}  // namespace deck
