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
RECORD(LossLists, "document", "", COLUMN("kept", "", r.of(Loss::kept)),
       COLUMN("approximated", "", r.of(Loss::approximated)),
       COLUMN("dropped", "", r.of(Loss::dropped)), COLUMN("undecided", "", r.of(Loss::undecided)));

constexpr DocumentHead losses_head{"deck/losses", 1,
                                   "Written by deck convert --report: cells and blocks that the "
                                   "conversion changed in a way worth knowing.",
                                   false};

}  // namespace

RECORD(LossEntry, "entry", "", COLUMN("file", "", r.file), COLUMN("line", "", r.line),
       COLUMN("column", "First column of the text that changed; not of a whole block",
              if_any(r.column > 0, r.column)),
       COLUMN("end_column", "Last column of the text that was there",
              if_any(r.column > 0, r.end_column)),
       COLUMN("keyword", "", r.keyword), COLUMN("id", "", r.id),
       COLUMN("field", "Empty: the block as a whole", r.field), COLUMN("old", "", r.old_text),
       COLUMN("new", "", r.new_text), COLUMN("note", "", r.note));

DocumentSchema losses_schema() { return document_schema<LossLists>(losses_head); }

std::string losses_json(const std::vector<LossEntry>& losses) {
  return write_document(losses_head, LossLists{&losses}) + '\n';
}

}  // namespace deck
