// Strict reader of keyword schemas: unknown keys are errors. Over 600 lines: one format, one
// function per kind of object.
#include "keyword/schema/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "deck/keyword.hpp"
#include "deck/text.hpp"
#include "text/shared/read_json.hpp"

namespace deck {

bool is_known_version(int version) {
  const auto& known = detail::known_versions();
  return std::binary_search(known.begin(), known.end(), version);
}

}  // namespace deck

namespace deck::detail {
namespace {

using Json = nlohmann::json;

/// First error with its JSON path; thrown inside of this file only.
struct Wrong {
  std::string what;
};

/// Position in the JSON text, formatted only for errors, because the built-in schemas are read at
/// every start.
struct Path {
  const Path* parent = nullptr;
  std::string_view key;
  std::size_t index = 0;

  std::string text() const {
    if (!parent) return {};
    return parent->text() + (key.empty() ? fmt::format("/{}", index) : fmt::format("/{}", key));
  }
};

template <class List>
std::string joined(const List& list) {
  std::string text;
  for (const auto& item : list) text += fmt::format("{}{}", text.empty() ? "" : ", ", item);
  return text;
}

[[noreturn]] void fail(const Path& path, const std::string& what) {
  const auto text = path.text();
  throw Wrong{fmt::format("{}: {}", text.empty() ? "/" : text, what)};
}

Path at(const Path& path, std::string_view key) { return {&path, key, 0}; }
Path at(const Path& path, std::size_t index) { return {&path, {}, index}; }

void expect_object(const Json& json, const Path& path,
                   std::initializer_list<std::string_view> keys) {
  if (!json.is_object()) fail(path, fmt::format("expected an object, found {}", json.type_name()));
  for (const auto& item : json.items())
    if (std::find(keys.begin(), keys.end(), item.key()) == keys.end())
      fail(path, fmt::format("unknown key \"{}\" (known: {})", item.key(), joined(keys)));
}

const Json& expect_array(const Json& json, const Path& path) {
  if (!json.is_array()) fail(path, fmt::format("expected a list, found {}", json.type_name()));
  return json;
}

void require(const Json& json, const Path& path, const char* key) {
  if (!json.contains(key)) fail(path, fmt::format("the key \"{}\" is missing", key));
}

/// Value of a key, converted by of(json, path), if the key exists.
template <class T, class Of>
void read(const Json& json, const Path& path, const char* key, T& out, const Of& of) {
  if (const auto it = json.find(key); it != json.end()) out = of(*it, at(path, key));
}

template <class Of>
auto list_of(const Json& json, const Path& path, const Of& of) {
  std::vector<decltype(of(json, path))> out;
  for (const auto& item : expect_array(json, path)) out.push_back(of(item, at(path, out.size())));
  return out;
}

/// Value of a key that is a list with items.
template <class Of>
auto some_of(const Json& json, const Path& path, const Of& of) {
  auto out = list_of(json, path, of);
  if (out.empty()) fail(path, "the list is empty");
  return out;
}

std::string text_of(const Json& json, const Path& path) {
  if (!json.is_string()) fail(path, fmt::format("expected text, found {}", json.type_name()));
  return json.get<std::string>();
}

std::vector<std::string> texts_of(const Json& json, const Path& path) {
  return some_of(json, path, text_of);
}

bool bool_of(const Json& json, const Path& path) {
  if (!json.is_boolean()) fail(path, "expected true or false");
  return json.get<bool>();
}

std::int64_t integer_of(const Json& json, const Path& path) {
  if (!json.is_number_integer())
    fail(path, fmt::format("expected a whole number, found {}", json.dump()));
  return json.get<std::int64_t>();
}

std::vector<std::int64_t> integers_of(const Json& json, const Path& path) {
  return some_of(json, path, integer_of);
}

int small_of(const Json& json, const Path& path) {
  const auto value = integer_of(json, path);
  if (value < -9999 || value > 9999) fail(path, fmt::format("{} is out of range", value));
  return static_cast<int>(value);
}

double number_of(const Json& json, const Path& path) {
  if (!json.is_number()) fail(path, fmt::format("expected a number, found {}", json.dump()));
  return json.get<double>();
}

int message_of(const Json& json, const Path& path) {
  const int message = small_of(json, path);
  if (message < 0) fail(path, "a message number is not negative");
  return message;
}

void read(const Json& json, const Path& path, const char* key, std::string& out) {
  read(json, path, key, out, text_of);
}

void read(const Json& json, const Path& path, const char* key, bool& out) {
  read(json, path, key, out, bool_of);
}

/// Value of one of some words. `expected`: description for the error.
template <class T>
T meaning_of(const Json& json, const Path& path, std::string_view expected,
             std::initializer_list<std::pair<std::string_view, T>> words) {
  const std::string text = text_of(json, path);
  for (const auto& [word, meaning] : words)
    if (word == text) return meaning;
  fail(path, fmt::format("\"{}\" is not {}", text, expected));
}

int version_of(const Json& json, const Path& path) {
  const int version = small_of(json, path);
  if (!is_known_version(version))
    fail(path, fmt::format("{} is not an input version ({})", version, joined(known_versions())));
  return version;
}

/// "versions": [from, until or null]; the last may be between two versions (119: below 120).
void read_versions(const Json& json, const Path& path, int& from, int& until) {
  const auto it = json.find("versions");
  if (it == json.end()) return;
  const auto here = at(path, "versions");
  if (expect_array(*it, here).size() != 2) fail(here, "expected [from, until or null]");
  from = version_of((*it)[0], at(here, std::size_t{0}));
  if (!(*it)[1].is_null()) until = small_of((*it)[1], at(here, std::size_t{1}));
  if (until < from) fail(here, "the range is empty");
}

Condition condition_of(const Json& json, const Path& path) {
  expect_object(json, path, {"field", "lines", "words", "in", "not_in", "min", "max"});
  Condition condition;
  bool lines = false;
  read(json, path, "lines", lines);
  if (lines == json.contains("field")) fail(path, "expected \"field\" or \"lines\": true");
  read(json, path, "field", condition.field);
  if (lines) condition.field = Condition::data_lines;
  read(json, path, "words", condition.words, texts_of);
  if (!condition.words.empty() && (lines || json.size() != 2))
    fail(path, "\"words\" goes with \"field\" alone");
  read(json, path, "in", condition.in, integers_of);
  read(json, path, "not_in", condition.not_in, integers_of);
  read(json, path, "min", condition.min, integer_of);
  read(json, path, "max", condition.max, integer_of);
  if (condition.words.empty() && condition.in.empty() && condition.not_in.empty() &&
      !condition.min && !condition.max)
    fail(path, "the condition tests nothing: give \"in\", \"not_in\", \"min\" or \"max\"");
  return condition;
}

std::vector<Condition> conditions_of(const Json& json, const Path& path) {
  return some_of(json, path, condition_of);
}

/// Conditions of cells: numbers only.
std::vector<Condition> number_tests_of(const Json& json, const Path& path) {
  const auto conditions = conditions_of(json, path);
  for (const Condition& condition : conditions)
    if (!condition.words.empty()) fail(path, "words are tested by cards and dimensions only");
  return conditions;
}

Dimension dimension_of(const Json& json, const Path& path) {
  const auto size = expect_array(json, path).size();
  if (size != 3 && size != 4)
    fail(path, "expected the exponents [mass, length, time] or [mass, length, time, temperature]");
  std::array<std::int8_t, 4> power{};
  for (std::size_t i = 0; i < size; ++i) {
    const auto value = integer_of(json[i], at(path, i));
    if (std::abs(value) > 20) fail(at(path, i), "exponent out of range");
    power[i] = static_cast<std::int8_t>(value);
  }
  return {power[0], power[1], power[2], power[3]};
}

using ConditionalDimension = std::pair<std::vector<Condition>, Dimension>;

/// {"when": [...], "dim": [...]}; conditions by of(json, path).
ConditionalDimension conditional_dimension(const Json& json, const Path& path,
                                           decltype(conditions_of)& of) {
  expect_object(json, path, {"when", "dim"});
  require(json, path, "when");
  require(json, path, "dim");
  return {of(json["when"], at(path, "when")), dimension_of(json["dim"], at(path, "dim"))};
}

std::vector<ConditionalDimension> dimensions_of(const Json& json, const Path& path) {
  return list_of(json, path, [](const Json& item, const Path& here) {
    return conditional_dimension(item, here, conditions_of);
  });
}

void read_columns(const Json& json, const Path& path, Field& field) {
  require(json, path, "cols");
  const auto here = at(path, "cols");
  const auto& cols = expect_array(json["cols"], here);
  if (cols.size() != 2) fail(here, "expected [first, last]");
  field.first = small_of(cols[0], at(here, std::size_t{0}));
  field.last = small_of(cols[1], at(here, std::size_t{1}));
  if (field.first < 1 || field.last < field.first || field.last > 100)
    fail(here, fmt::format("columns {}-{} do not lie in 1-100", field.first, field.last));
}

Axis axis_of(const Json& json, const Path& path) {
  expect_object(json, path, {"scale", "dim", "dim_when"});
  Axis axis;
  if (json.contains("scale") && json.size() != 1)
    fail(path, "an axis has a scale, or points with a dimension");
  read(json, path, "scale", axis.scales, [](const Json& scale, const Path& here) {
    return scale.is_string() ? std::vector{scale.get<std::string>()} : texts_of(scale, here);
  });
  read(json, path, "dim", axis.dimension, dimension_of);
  read(json, path, "dim_when", axis.dimension_when, dimensions_of);
  return axis;
}

/// The axes of the function or table of an id.
void read_axes(const Json& json, const Path& path, Field& field) {
  if (!json.contains("axes")) return;
  const auto here = at(path, "axes");
  if (field.type != FieldType::id || (field.ref != "funct" && field.ref != "table"))
    fail(here, "only ids of functions and tables have axes");
  if (!field.dimension_known) fail(path, "\"axes\" and \"dim_unknown\" exclude each other");
  field.axes = list_of(json["axes"], here, axis_of);
  if (field.axes.size() < 2) fail(here, "expected the axes, the ordinate last");
}

/// Relations of a real cell to other cells.
void read_relations(const Json& json, const Path& path, Field& field) {
  for (const char* key : {"solver_dim", "unit_for", "over"})
    if (json.contains(key) && field.type != FieldType::real)
      fail(at(path, key), "only real fields have it");
  if (const auto it = json.find("solver_dim"); it != json.end()) {
    const auto here = at(path, "solver_dim");
    if (it->is_object())
      std::tie(field.solver_when, field.solver_dimension) =
          conditional_dimension(*it, here, number_tests_of);
    else
      field.solver_dimension = dimension_of(*it, here);
  }
  read(json, path, "unit_for", field.unit_for, texts_of);
  if (const auto it = json.find("over"); it != json.end()) {
    const auto here = at(path, "over");
    expect_object(*it, here, {"field", "when"});
    require(*it, here, "field");
    read(*it, here, "field", field.over);
    read(*it, here, "when", field.over_when, number_tests_of);
  }
}

void read_dimension(const Json& json, const Path& path, Field& field) {
  read(json, path, "dim", field.dimension, dimension_of);
  bool unknown = false;
  read(json, path, "dim_unknown", unknown);
  field.dimension_known = !unknown;
  if (unknown && json.contains("dim")) fail(path, "\"dim\" and \"dim_unknown\" exclude each other");
  read(json, path, "dim_when", field.dimension_when, dimensions_of);
  const bool any = json.contains("dim") || json.contains("dim_when") || unknown;
  const bool axes = unknown && field.type == FieldType::id;  // of the function or table
  if (any && field.type != FieldType::real && !axes)
    fail(path, "only real fields have a dimension");
}

void read_range(const Json& json, const Path& path, Field& field) {
  read(json, path, "values", field.values, integers_of);
  read(json, path, "min", field.min, number_of);
  read(json, path, "max", field.max, number_of);
  read(json, path, "min_open", field.min_open);
  read(json, path, "max_open", field.max_open);
  if ((field.min_open && !field.min) || (field.max_open && !field.max))
    fail(path, "an open bound needs the bound itself");
  if (field.min && field.max && *field.min > *field.max) fail(path, "min is above max");
  const bool whole = field.type == FieldType::integer || field.type == FieldType::id ||
                     field.type == FieldType::flag;
  if (!field.values.empty() && !whole) fail(path, "only integer fields have a list of values");
  if ((field.min || field.max) && field.type == FieldType::text)
    fail(path, "a text field has no range");
}

/// Legal texts, and the solver message for others.
void read_legal(const Json& json, const Path& path, Field& field) {
  if (json.contains("words") && field.type != FieldType::text)
    fail(at(path, "words"), "only text fields have a list of words");
  read(json, path, "words", field.words, texts_of);
  if (json.contains("wrong") && field.words.empty() && field.type != FieldType::flag)
    fail(at(path, "wrong"), "only flags and texts with \"words\" can be wrong");
  read(json, path, "wrong", field.wrong, message_of);
}

/// Solver messages about the target of an id.
void read_target(const Json& json, const Path& path, Field& field) {
  for (const char* key : {"missing", "empty", "required", "acts_on"})
    if (json.contains(key) && field.type != FieldType::id)
      fail(at(path, key), "only ids have a target");
  read(json, path, "missing", field.missing, message_of);
  read(json, path, "empty", field.empty, message_of);
  read(json, path, "required", field.required, message_of);
  read(json, path, "acts_on", field.acts_on);
}

/// A complete number is its own default value; a default in words has it beside.
void read_default(const Json& json, const Path& path, Field& field) {
  read(json, path, "default", field.default_text);
  if (const RealCell number = read_real(field.default_text);
      !field.default_text.empty() && number.status == NumberStatus::ok)
    field.default_value = number.value;
  if (field.default_value && json.contains("default_value"))
    fail(at(path, "default_value"), "\"default\" is this number already, or another one");
  read(json, path, "default_value", field.default_value, number_of);
  read(json, path, "default_varies", field.default_varies, [](const Json& word, const Path& here) {
    return meaning_of<DefaultVaries>(word, here, "deck, model or fields",
                                     {{"deck", DefaultVaries::deck},
                                      {"model", DefaultVaries::model},
                                      {"fields", DefaultVaries::fields}});
  });
}

FieldType type_of(const Json& json, const Path& path) {
  return meaning_of<FieldType>(json, path, "a field type (int, real, text, flag, id)",
                               {{"int", FieldType::integer},
                                {"real", FieldType::real},
                                {"text", FieldType::text},
                                {"flag", FieldType::flag},
                                {"id", FieldType::id}});
}

Field field_of(const Json& json, const Path& path) {
  expect_object(json, path,
                {"name",     "cols",        "type",     "ref",           "versions",
                 "when",     "values",      "min",      "max",           "min_open",
                 "max_open", "missing",     "empty",    "required",      "words",
                 "wrong",    "acts_on",     "default",  "default_value", "default_varies",
                 "dim",      "dim_unknown", "dim_when", "solver_dim",    "axes",
                 "unit_for", "over",        "ignored",  "doc",           "manual",
                 "help",     "help_of"});
  Field field;
  require(json, path, "name");
  read(json, path, "name", field.name);
  if (field.name.empty()) fail(at(path, "name"), "the name is empty");
  read_columns(json, path, field);
  require(json, path, "type");
  field.type = type_of(json["type"], at(path, "type"));
  if (field.type == FieldType::flag && field.first != field.last)
    fail(at(path, "cols"), "a flag has exactly one column");
  read(json, path, "ref", field.ref);
  if ((field.type == FieldType::id) == field.ref.empty())
    fail(path, "\"ref\" is required for fields of type id and only for those");
  read_target(json, path, field);
  read_versions(json, path, field.from, field.until);
  read(json, path, "when", field.when, number_tests_of);
  read_range(json, path, field);
  read_legal(json, path, field);
  read_default(json, path, field);
  read_dimension(json, path, field);
  read_axes(json, path, field);
  read_relations(json, path, field);
  read(json, path, "ignored", field.ignored);
  read(json, path, "doc", field.doc);
  read(json, path, "manual", field.from_manual);
  read(json, path, "help", field.help, texts_of);
  read(json, path, "help_of", field.help_of);
  return field;
}

void read_repeat(const Json& json, const Path& path, CardSchema& card) {
  card.words = json.contains("repeat") && json["repeat"] == "words";
  read(json, path, "repeat", card.repeat, [](const Json& word, const Path& here) {
    return meaning_of<Repeat>(word, here, "rows, ids, words or group",
                              {{"rows", Repeat::rows},
                               {"ids", Repeat::ids},
                               {"words", Repeat::ids},
                               {"group", Repeat::group}});
  });
  if (json.contains("count") && (card.repeat == Repeat::once || card.words))
    fail(at(path, "count"), "only repeated cards can have a count");
  read(json, path, "count", card.count, [](const Json& count, const Path& here) {
    return count.is_number_integer() ? std::to_string(integer_of(count, here))
                                     : text_of(count, here);
  });
  read(json, path, "per_line", card.per_line, small_of);
  const bool counted_list = card.repeat == Repeat::ids && !card.count.empty();
  if (counted_list ? card.per_line < 1 : card.per_line != 0)
    fail(path, "\"per_line\" goes with lists that have a \"count\", and with those only");
}

CardSchema card_of(const Json& json, const Path& path) {
  expect_object(json, path,
                {"name", "doc", "versions", "when", "repeat", "count", "per_line", "optional",
                 "blank", "fields"});
  CardSchema card;
  require(json, path, "name");
  read(json, path, "name", card.name);
  read(json, path, "doc", card.doc);
  read_versions(json, path, card.from, card.until);
  read(json, path, "when", card.when, conditions_of);
  read_repeat(json, path, card);
  read(json, path, "optional", card.optional);
  bool blank = false;
  read(json, path, "blank", blank);
  if (blank && json.contains("fields")) fail(at(path, "fields"), "a blank line has no fields");
  if (blank) return card;
  require(json, path, "fields");
  const auto here = at(path, "fields");
  card.fields = list_of(json["fields"], here, field_of);
  if (card.fields.empty())
    fail(here, "the list is empty; for a line without fields write \"blank\"");
  return card;
}

std::string keyword_of(const Json& json, const Path& path) {
  const std::string keyword = text_of(json, path);
  std::string_view rest = keyword;
  if (rest.substr(0, 2) == "//") rest.remove_prefix(1);
  bool good = rest.size() > 1 && rest[0] == '/' && rest.back() != '/' &&
              rest.find("//") == std::string_view::npos;
  for (const char c : rest) good = good && c > ' ';
  if (!good) fail(path, fmt::format("\"{}\" is not a keyword like /INTER/TYPE7", keyword));
  return keyword;
}

/// Adds versions before the keyword existed: decks of these are read with the oldest layout, or
/// without lines (`unread`).
void extend_to_older_decks(Schema& schema, bool unread) {
  const auto extend = [&](int& from, int until) {
    if (unread)
      from = std::max(from, schema.from);
    else if (from <= schema.from && until >= schema.from)
      from = 0;
  };
  for (CardSchema& card : schema.cards) {
    extend(card.from, card.until);
    for (Field& field : card.fields) extend(field.from, field.until);
  }
}

/// {"unit": 659, "node": false}: the solver message, or false if the solver continues.
auto demands_of(const Json& json, const Path& path) {
  if (!json.is_object()) fail(path, "expected an object");
  decltype(Schema::demands) out;
  for (const auto& [word, stop] : json.items())
    out[word] = stop == false ? Schema::goes_on : message_of(stop, at(path, word));
  return out;
}

/// A demand named after a kind applies to the cells that refer to it.
void fill_cells(Schema& schema) {
  for (CardSchema& card : schema.cards)
    for (Field& field : card.fields)
      if (const auto stop = schema.demands.find(field.ref);
          stop != schema.demands.end() && stop->second != Schema::goes_on && !field.missing)
        field.missing = stop->second;
}

Schema schema_of(const Json& json, const Path& path, std::string_view source) {
  expect_object(json, path,
                {"$schema", "keyword", "aliases", "kind", "id", "title", "unit", "unique",
                 "demands", "bulk", "opaque_tail", "full_layout", "from", "older", "doc", "cards"});
  Schema schema;
  schema.source = source;
  require(json, path, "keyword");
  read(json, path, "keyword", schema.keyword, keyword_of);
  read(json, path, "aliases", schema.aliases,
       [](const Json& names, const Path& here) { return list_of(names, here, keyword_of); });
  read(json, path, "kind", schema.kind);
  read(json, path, "id", schema.has_id);
  read(json, path, "title", schema.has_title);
  read(json, path, "unit", schema.has_unit);
  read(json, path, "unique", schema.unique);
  read(json, path, "demands", schema.demands, demands_of);
  read(json, path, "bulk", schema.bulk);
  read(json, path, "opaque_tail", schema.opaque_tail);
  read(json, path, "full_layout", schema.full_layout);
  if (schema.full_layout && !schema.opaque_tail)
    fail(at(path, "full_layout"), "without opaque_tail a schema already describes everything");
  read(json, path, "from", schema.from, version_of);
  std::string older = "oldest layout";
  read(json, path, "older", older);
  const bool unread = older == "unread";
  if (!unread && json.contains("older")) fail(at(path, "older"), "the only value is \"unread\"");
  if (unread && schema.from == 0)
    fail(at(path, "older"), "\"from\" must say which decks are older");
  read(json, path, "doc", schema.doc);
  read(json, path, "cards", schema.cards,
       [](const Json& cards, const Path& here) { return list_of(cards, here, card_of); });
  fill_cells(schema);
  extend_to_older_decks(schema, unread);
  return schema;
}

/// JSON accepts duplicate keys (the last wins); in a schema they are errors.
class DuplicateKeys {
 public:
  bool operator()(Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) {
      open_.emplace_back();
    } else if (event == Json::parse_event_t::object_end) {
      open_.pop_back();
    } else if (event == Json::parse_event_t::key) {
      const auto key = parsed.get<std::string>();
      if (!open_.back().insert(key).second)
        throw Wrong{fmt::format("the key \"{}\" occurs twice in one object", key)};
    }
    return true;
  }

 private:
  std::vector<std::set<std::string>> open_;
};

/// The names of a "for" table and one of its rows.
struct TableRow {
  const Json* names;
  const Json* values;
};

/// Replaces "{name}" in all texts by the word of the row.
Json filled(const Json& json, const TableRow& row) {
  Json out = json;
  if (json.is_string()) {
    auto text = json.get<std::string>();
    for (std::size_t k = 0; k < row.names->size(); ++k) {
      const std::string name = "{" + (*row.names)[k].get<std::string>() + "}";
      const auto word = (*row.values)[k].get<std::string>();
      for (auto p = text.find(name); p != std::string::npos; p = text.find(name, p + word.size()))
        text.replace(p, name.size(), word);
    }
    out = text;
  } else if (json.is_structured()) {
    for (auto& item : out) item = filled(item, row);
  }
  return out;
}

Json expand_tables(const Json& json, const Path& path);

/// Adds the items of a table to its list.
void add_rows(const Json& family, const Path& path, const std::string& name, Json& list) {
  expect_object(family, path, {"for", name});
  require(family, path, name.c_str());
  const auto here = at(path, "for");
  const Json& table = expect_array(family["for"], here);
  if (table.size() < 2) fail(here, "expected a row of names and rows of words");
  for (std::size_t k = 0; k < table.size(); ++k) {
    const auto entry = at(here, k);
    texts_of(table[k], entry);
    if (table[k].size() != table[0].size())
      fail(entry, fmt::format("expected {} words, one for each name", table[0].size()));
    if (k == 0) continue;
    const Json items = filled(family[name], {&table[0], &table[k]});
    for (const Json& item : expand_tables(expect_array(items, at(path, name)), at(path, name)))
      list.push_back(item);
  }
}

/// Expands tables in lists. A table {"for": [[NAME, ...], [WORD, ...], ...], LIST: [...]} in a list
/// of that name adds its items once per row.
Json expand_tables(const Json& json, const Path& path) {
  if (!json.is_structured()) return json;
  Json out(json.type());
  if (json.is_object())
    for (const auto& item : json.items())
      out[item.key()] = expand_tables(item.value(), at(path, item.key()));
  if (!json.is_array()) return out;
  for (std::size_t n = 0; n < json.size(); ++n) {
    const auto here = at(path, n);
    if (json[n].is_object() && json[n].contains("for"))
      add_rows(json[n], here, std::string(path.key), out);
    else
      out.push_back(expand_tables(json[n], here));
  }
  return out;
}

/// Calls `read`; exceptions become an error that starts with the name of the text.
template <class Read>
auto reading(std::string_view name, const Read& read) -> Result<decltype(read())> {
  try {
    return read();
  } catch (const Wrong& wrong) {
    return Error{Error::Code::config, fmt::format("{}: {}", name, wrong.what)};
  } catch (const Json::exception& error) {
    return Error{Error::Code::config, fmt::format("{}: not valid JSON: {}", name, error.what())};
  }
}

}  // namespace

const std::vector<int>& known_versions() {
  static const std::vector<int> versions = {51,   90,   100,  110,  120,  130,  140,  2017, 2018,
                                            2019, 2020, 2021, 2022, 2023, 2024, 2025, 2026, 2612};
  return versions;
}

Result<std::vector<ReadSchema>> read_schemas(std::string_view name, std::string_view text) {
  return reading(name, [&] {
    if (is_nested_too_deep(text)) throw Wrong{"nested too deep for a schema"};
    DuplicateKeys duplicates;
    const Path root;
    const auto parsed = Json::parse(
        text, [&](int, Json::parse_event_t event, Json& json) { return duplicates(event, json); });
    const Json json = expand_tables(parsed, root);
    const auto one = [&](const Json& own, const Path& path) {
      Json schema;
      if (own.is_object() && json.contains("demands")) schema["demands"] = json["demands"];
      schema.merge_patch(own);
      try {
        ReadSchema out{schema_of(schema, path, name), schema.dump()};
        if (const auto wrong = check_schema(out.schema); !wrong.empty())
          throw Wrong{path.text() + wrong};
        return out;
      } catch (const Wrong& wrong) {
        // Paths count expanded rows, which the file does not have; the keyword helps.
        if (json == parsed || !schema.is_object()) throw;
        throw Wrong{schema.value("keyword", Json("a schema")).dump() + " at " + wrong.what};
      }
    };
    if (!json.is_object() || !json.contains("schemas")) return std::vector{one(json, root)};
    expect_object(json, root, {"$schema", "demands", "schemas"});
    return list_of(json["schemas"], at(root, "schemas"), one);
  });
}

Result<Schema> read_checked_schema(std::string_view name, std::string_view text) {
  return reading(name, [&] { return schema_of(Json::parse(text), {}, name); });
}

}  // namespace deck::detail
