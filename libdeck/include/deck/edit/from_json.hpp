// Writes the files of a deck from its JSON (deck/report/deck_json.hpp). Lines whose values were not
// changed keep their text; a changed value is printed into its columns.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword/schema.hpp"
#include "deck/text/result.hpp"

namespace deck {

struct DeckFile {
  std::string path;  ///< relative, without ".."; the main file is the first one
  std::string text;
};

/// Files of the deck in a document of schema "deck/deck", version 1. What is read: `path`,
/// `encoding`, `line_end` and `final_newline` of a file; per item `header` (or `keyword` and `id`),
/// `version`, and its lines. `text` of a line may be left out: then the line is made of its values.
/// `columns`, `line`, `effective` and all other members are for readers and are ignored.
/// Error, with line and column of the JSON text or the path inside it ("/files/0/items/3"): no
/// JSON, another schema, a value of the wrong type, an unknown field or card, a value that does not
/// fit its columns without rounding, a path that leads out of the directory.
Result<std::vector<DeckFile>> deck_from_json(std::string_view json, const SchemaSet& schemas);

}  // namespace deck
