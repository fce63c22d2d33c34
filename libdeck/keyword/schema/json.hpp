// Reading of keyword schemas from JSON text: every key checked, errors name the file and JSON path.
// Private to the keyword stage; the public face is SchemaSet.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword/schema.hpp"

namespace deck::detail {

/// Input versions that have a layout of their own, ascending: the rows of is_known_version().
const std::vector<int>& known_versions();

/// Parses one schema file: an object with "keyword", or one with "schemas" (a list of such
/// objects). `name` goes into messages and into Schema::source. `look_for_twins`: keys that occur
/// twice in one object are refused, which takes half of the time.
Result<std::vector<Schema>> parse_schemas(std::string_view name, std::string_view text,
                                          bool look_for_twins = true);

/// Where one schema stands in the text of a file, and the headers it answers to.
struct SchemaText {
  std::string_view text;  ///< its JSON object
  std::string keyword;
  std::vector<std::string> aliases;
};

/// Cuts a schema file that parse_schemas() accepts into its schemas without parsing them, so that a
/// start of the tools costs microseconds instead of milliseconds. Nothing is checked.
std::vector<SchemaText> split_schemas(std::string_view text);

/// Checks that go across cards: overlapping columns, repeated names, conditions on fields that are
/// not yet known, misplaced repetition. Returns an empty string, or "json/path: what is wrong".
std::string check_schema(const Schema& schema);

}  // namespace deck::detail
