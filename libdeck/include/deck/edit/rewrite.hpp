// Rewrite: what one conversion wants to do to a deck — spans to replace, or a whole new text — and
// what that costs the user. Conversions only describe; applying and writing is done in one place.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/front/loaded_deck.hpp"

namespace deck {

/// What became of a value.
enum class Loss : std::uint8_t {
  kept,          ///< the same meaning in the new text
  approximated,  ///< close: fewer digits, or the nearest option there is
  dropped,       ///< the new text cannot hold it
  undecided,     ///< must be decided by hand
};

/// One line of the loss report.
struct LossEntry {
  Loss loss = Loss::kept;
  bool without_effect = false;  ///< dropped, but the solver did not use it
  std::string file;             ///< as in the deck
  std::uint64_t line = 0;
  std::uint64_t column = 0, end_column = 0;  ///< of a value that changed; 0: not told
  std::string keyword;                       ///< "/INTER/TYPE7"
  std::int64_t id = 0;
  std::string field;  ///< "Irem_gap"; empty: the block as a whole
  std::string old_text, new_text;
  std::string note;  ///< why, and what to do
};

struct Rewrite {
  std::vector<TextEdit> edits;          ///< of files of the deck; never overlapping
  std::optional<std::string> new_text;  ///< instead: the whole deck as one file without includes
  std::vector<LossEntry> losses;
  std::vector<std::string> notes;     ///< for people, one line each ("length: factor 0.001")
  std::vector<std::string> refusals;  ///< "file:line:column: why"; any: nothing may be written
  bool bad_request = false;           ///< the refusals are about the request, not about the deck
};

/// New contents by path (as the deck opened it), of changed files only.
using ChangedFiles = std::map<std::string, std::string>;

/// Applies edits. A file that the deck includes twice is changed once: equal edits through both
/// includes are one. Error: edits that overlap, or that would make of one file two: every include
/// of it has to ask for the same text.
Result<ChangedFiles> apply_edits(const SourceSet& sources, const std::vector<TextEdit>& edits);
/// The same for a whole rewrite: with new_text, that is the main file's content.
Result<ChangedFiles> apply_rewrite(const SourceSet& sources, const Rewrite& rewrite);

/// What a LossEntry says of a value.
struct LossText {
  std::string field = {}, old_text = {}, new_text = {}, note = {};
};
/// An entry about a block; an invalid `span` stands for its header.
LossEntry loss_entry(const Deck& deck, Loss loss, const Block& block, Span span,
                     LossText text = {});

/// Notes what a conversion cannot decide: an `undecided` loss if the user accepts that, a refusal
/// "file:line:column: /KEYWORD/id field: why" otherwise (the first thousand of them). An invalid
/// `place` stands for the header of the block.
void leave_undecided(Rewrite& out, const Deck& deck, const Block& block, Span place,
                     std::string field, std::string why, bool accepted);

}  // namespace deck
