// Reads keyword schemas from JSON; errors have file and JSON path. Private to the stage; the public
// interface is SchemaSet.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword.hpp"

namespace deck::detail {

/// Input versions with their own layout, ascending (is_known_version()).
const std::vector<int>& known_versions();

/// A schema and its JSON object after expansion.
struct ReadSchema {
  Schema schema;
  std::string json;
};

/// Reads a file: an object with "keyword", or with a list "schemas" of these. Lists may have tables
/// (expand_tables() in json.cpp). `name` is used in messages and Schema::source.
Result<std::vector<ReadSchema>> read_schemas(std::string_view name, std::string_view text);

/// Reads a schema of a text accepted by read_schemas() before. Skips the search for duplicate keys
/// (half of the time) and check_schema().
Result<Schema> read_checked_schema(std::string_view name, std::string_view text);

/// Checks across cards: overlapping columns, repeated names, conditions on unknown fields,
/// misplaced repetition. Returns "" or "json/path: reason".
std::string check_schema(const Schema& schema);

}  // namespace deck::detail
