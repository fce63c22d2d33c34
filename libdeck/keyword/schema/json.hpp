// Reading of keyword schemas from JSON text: every key checked, errors name the file and JSON path.
// Private to the keyword stage; the public face is SchemaSet.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword.hpp"

namespace deck::detail {

/// Input versions that have a layout of their own, ascending: the rows of is_known_version().
const std::vector<int>& known_versions();

/// A schema and its JSON object, without families and blanks.
struct ReadSchema {
  Schema schema;
  std::string json;
};

/// Reads a file of schemas: an object with "keyword", or one with "schemas", a list of such
/// objects. Lists may hold tables: written_out() in json.cpp. `name` goes into messages and
/// Schema::source.
Result<std::vector<ReadSchema>> read_schemas(std::string_view name, std::string_view text);

/// One schema of a text that read_schemas() has accepted: neither keys that occur twice are looked
/// for, which takes half of the time, nor what check_schema() finds.
Result<Schema> read_checked_schema(std::string_view name, std::string_view text);

/// Checks that go across cards: overlapping columns, repeated names, conditions on fields that are
/// not yet known, misplaced repetition. Returns an empty string, or "json/path: what is wrong".
std::string check_schema(const Schema& schema);

}  // namespace deck::detail
