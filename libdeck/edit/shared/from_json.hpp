// Writes the files of a deck from its JSON (report/shared/deck_json.hpp). Lines whose values were
// not changed keep their text; a changed value is printed into its columns.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "deck/edit/rewrite.hpp"
#include "deck/keyword/schema.hpp"
#include "deck/text/result.hpp"

namespace deck {

struct DeckFile {
  std::string path;  ///< relative, without ".."; the main file is the first one
  std::string text;
};

struct FromJsonOptions {
  /// A number that does not fit its columns is written with the digits that fit, and is an
  /// `approximated` loss. Without it that is an error.
  bool round = false;
};

/// Files of the deck in a document of schema "deck/deck", version 1. They are made of `path`,
/// `encoding`, `line_end` and `final_newline` of a file; per item of `header` (or `keyword` and
/// `id`), and its lines; a value that differs from an untouched `text` (its `text_sum` tells) wins,
/// and where there is no text the line is made of its values. What was written is then read back,
/// and everything that the document says must be true of it: keyword, ids and version of a block,
/// the card that a line is, the cards that are `missing`, every value, columns, the file an include
/// leads to. `deck` and `effective` may be what they were when the document was written (their sums
/// tell) or what they have become. `line`, `column` and `tool` are for readers.
///
/// Error, with line and column of the JSON text, or the path inside it and file, block, card and
/// field: no JSON, another schema, a value of the wrong type, an unknown member, field or card,
/// members that contradict each other or the deck, a value that does not fit its columns without
/// rounding, a path that leads out of the directory.
Result<std::vector<DeckFile>> deck_from_json(std::string_view json, const SchemaSet& schemas,
                                             const FromJsonOptions& options = {},
                                             std::vector<LossEntry>* losses = nullptr);

}  // namespace deck
