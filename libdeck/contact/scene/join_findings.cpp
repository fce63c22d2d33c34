// Unreadable cells and groups with members that do not exist, joined to the findings of reading.
#include "deck/contact/join_findings.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "deck/keyword/decode.hpp"
#include "deck/keyword/schema.hpp"
#include "deck/model/selection.hpp"
#include "deck/text/rule_id.hpp"

namespace deck {

void report_unreadable_cells(const Deck& deck, Diagnostics& out) {
  constexpr std::string_view kinds[] = {
      "inter",  "default_inter", "friction", "grnod",  "surf",   "line",   "set",       "box",
      "skew",   "grshel",        "grsh3n",   "grbric", "grquad", "grtria", "grtrus",    "grbeam",
      "grspri", "grpart",        "part",     "prop",   "mat",    "subset", "transform", "unit"};
  Diagnostics found;
  for (const Block& b : deck.blocks)
    if (b.schema != nullptr && !b.schema->bulk && !b.opaque &&
        std::find(std::begin(kinds), std::end(kinds), b.schema->kind) != std::end(kinds))
      decode(deck, b, &found);
  for (const Diagnostic& d : found.all())
    if (d.severity == Severity::error) out.report(d);
}

void join_findings(Deck& deck, const Model& model, Diagnostics found) {
  report_unreadable_cells(deck, found);
  Diagnostics& all = deck.diagnostics;
  all.merge(std::move(found));
  if (model.selections == nullptr) return;
  // The scene has reported DK332 itself.
  for (const Diagnostic& d : model.selections->diagnostics().all())
    if (d.severity == Severity::error && d.rule != RuleId::DK332) all.report(d);
}

}  // namespace deck
