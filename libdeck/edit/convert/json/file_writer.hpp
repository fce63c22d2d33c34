// What makes the text of a file out of its part of a deck's JSON document. Private to the edit
// stage.
#pragma once
#include <string>
#include <vector>

#include "deck/keyword/decode.hpp"
#include "edit/convert/json/document.hpp"
#include "edit/shared/from_json.hpp"

namespace deck::detail {

/// Text of one file of the document at `path`; throws Wrong. A number that was rounded is an entry
/// of `losses`.
DeckFile write_file(const Json& file, const Path& path, const SchemaSet& schemas,
                    const FromJsonOptions& options, std::vector<LossEntry>& losses);

/// Columns for a value of a line with commas.
inline constexpr int free_cell_width = 20;
/// The bytes that a JSON text stands for in a file.
std::string bytes_of(const Json& json, bool latin1, const Path& path);
/// True if the file is written in Latin-1.
bool is_latin1(const Json& file, const Path& path);
/// True if the JSON value is what the cell holds.
bool same_value(const Cell& cell, const Json& json, bool latin1, const Path& path);

}  // namespace deck::detail
