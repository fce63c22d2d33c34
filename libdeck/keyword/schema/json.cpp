// Strict reader of keyword schemas: a mistyped key would otherwise become a column that is silently
// never read. Over 600 lines because each key of the format has its check in this one file.
#include "keyword/schema/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <set>

#include "deck/keyword/deck.hpp"
#include "deck/text/number.hpp"
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

/// Thrown inside this file only: the first thing that is wrong, with its JSON path.
struct Wrong {
  std::string what;
};

/// Where we are in the JSON text. Turned into text only when something is wrong: the built-in
/// schemas are read at every start of the tools.
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

std::string text_of(const Json& json, const Path& path) {
  if (!json.is_string()) fail(path, fmt::format("expected text, found {}", json.type_name()));
  return json.get<std::string>();
}

std::int64_t integer_of(const Json& json, const Path& path) {
  if (!json.is_number_integer())
    fail(path, fmt::format("expected a whole number, found {}", json.dump()));
  return json.get<std::int64_t>();
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

void read(const Json& json, const Path& path, const char* key, std::string& out) {
  if (const auto it = json.find(key); it != json.end()) out = text_of(*it, at(path, key));
}

void read(const Json& json, const Path& path, const char* key, bool& out) {
  const auto it = json.find(key);
  if (it == json.end()) return;
  if (!it->is_boolean()) fail(at(path, key), "expected true or false");
  out = it->get<bool>();
}

std::vector<std::int64_t> integers_of(const Json& json, const Path& path) {
  std::vector<std::int64_t> values;
  for (const auto& item : expect_array(json, path))
    values.push_back(integer_of(item, at(path, values.size())));
  if (values.empty()) fail(path, "the list is empty");
  return values;
}

void require(const Json& json, const Path& path, const char* key) {
  if (!json.contains(key)) fail(path, fmt::format("the key \"{}\" is missing", key));
}

int version_of(const Json& json, const Path& path) {
  const int version = small_of(json, path);
  if (!is_known_version(version))
    fail(path, fmt::format("{} is not an input version ({})", version, joined(known_versions())));
  return version;
}

/// "versions": [from, until or null]; the last one may lie between two versions (119 = below 120).
void read_versions(const Json& json, const Path& path, int& from, int& until) {
  const auto it = json.find("versions");
  if (it == json.end()) return;
  const auto here = at(path, "versions");
  if (expect_array(*it, here).size() != 2) fail(here, "expected [from, until or null]");
  from = version_of((*it)[0], at(here, std::size_t{0}));
  if (!(*it)[1].is_null()) until = small_of((*it)[1], at(here, std::size_t{1}));
  if (until < from) fail(here, "the range is empty");
}

/// `words`: conditions on text cells are possible here.
std::vector<Condition> conditions_of(const Json& json, const Path& path, bool words = false) {
  std::vector<Condition> conditions;
  for (const auto& item : expect_array(json, path)) {
    const auto here = at(path, conditions.size());
    expect_object(item, here, {"field", "lines", "words", "in", "not_in", "min", "max"});
    Condition condition;
    bool lines = false;
    read(item, here, "lines", lines);
    if (lines == item.contains("field")) fail(here, "expected \"field\" or \"lines\": true");
    read(item, here, "field", condition.field);
    if (lines) condition.field = Condition::data_lines;
    if (item.contains("words")) {
      const auto list = at(here, "words");
      if (!words || lines) fail(list, "words are tested by dimensions only");
      for (const auto& word : expect_array(item["words"], list))
        condition.words.push_back(text_of(word, at(list, condition.words.size())));
      if (condition.words.empty()) fail(list, "the list is empty");
      if (item.size() != 2) fail(here, "\"words\" goes with \"field\" alone");
    }
    if (item.contains("in")) condition.in = integers_of(item["in"], at(here, "in"));
    if (item.contains("not_in")) condition.not_in = integers_of(item["not_in"], at(here, "not_in"));
    if (item.contains("min")) condition.min = integer_of(item["min"], at(here, "min"));
    if (item.contains("max")) condition.max = integer_of(item["max"], at(here, "max"));
    if (condition.words.empty() && condition.in.empty() && condition.not_in.empty() &&
        !condition.min && !condition.max)
      fail(here, "the condition tests nothing: give \"in\", \"not_in\", \"min\" or \"max\"");
    conditions.push_back(std::move(condition));
  }
  if (conditions.empty()) fail(path, "the list is empty");
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

FieldType type_of(const Json& json, const Path& path) {
  const auto name = text_of(json, path);
  if (name == "int") return FieldType::integer;
  if (name == "real") return FieldType::real;
  if (name == "text") return FieldType::text;
  if (name == "flag") return FieldType::flag;
  if (name == "id") return FieldType::id;
  fail(path, fmt::format("\"{}\" is not a field type (int, real, text, flag, id)", name));
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

using DimensionWhen = std::vector<std::pair<std::vector<Condition>, Dimension>>;

void read_dimension_when(const Json& json, const Path& path, DimensionWhen& out) {
  if (!json.contains("dim_when")) return;
  const auto here = at(path, "dim_when");
  std::size_t n = 0;
  for (const auto& item : expect_array(json["dim_when"], here)) {
    const auto entry = at(here, n++);
    expect_object(item, entry, {"when", "dim"});
    require(item, entry, "when");
    require(item, entry, "dim");
    out.emplace_back(conditions_of(item["when"], at(entry, "when"), true),
                     dimension_of(item["dim"], at(entry, "dim")));
  }
}

std::vector<std::string> names_of(const Json& json, const Path& path) {
  std::vector<std::string> names;
  for (const auto& item : expect_array(json, path))
    names.push_back(text_of(item, at(path, names.size())));
  if (names.empty()) fail(path, "the list is empty");
  return names;
}

/// The axes of the function or table that an id names.
void read_axes(const Json& json, const Path& path, Field& field) {
  if (!json.contains("axes")) return;
  const auto here = at(path, "axes");
  if (field.type != FieldType::id || (field.ref != "funct" && field.ref != "table"))
    fail(here, "only ids of functions and tables have axes");
  if (!field.dimension_known) fail(path, "\"axes\" and \"dim_unknown\" exclude each other");
  for (const auto& item : expect_array(json["axes"], here)) {
    const auto entry = at(here, field.axes.size());
    expect_object(item, entry, {"scale", "dim", "dim_when"});
    Axis axis;
    if (item.contains("scale")) {
      const auto scale = at(entry, "scale");
      if (item.size() != 1) fail(entry, "an axis has a scale, or points with a dimension");
      if (item["scale"].is_string())
        axis.scales = {item["scale"].get<std::string>()};
      else
        axis.scales = names_of(item["scale"], scale);
    }
    if (item.contains("dim")) axis.dimension = dimension_of(item["dim"], at(entry, "dim"));
    read_dimension_when(item, entry, axis.dimension_when);
    field.axes.push_back(std::move(axis));
  }
  if (field.axes.size() < 2) fail(here, "expected the axes, the ordinate last");
}

/// What the value of a real cell depends on besides its own number.
void read_relations(const Json& json, const Path& path, Field& field) {
  const auto real_only = [&](const char* key) {
    if (field.type != FieldType::real) fail(at(path, key), "only real fields have it");
  };
  if (json.contains("solver_dim")) {
    real_only("solver_dim");
    const auto here = at(path, "solver_dim");
    const Json& solver = json["solver_dim"];
    if (solver.is_object()) {
      expect_object(solver, here, {"when", "dim"});
      require(solver, here, "when");
      require(solver, here, "dim");
      field.solver_when = conditions_of(solver["when"], at(here, "when"));
      field.solver_dimension = dimension_of(solver["dim"], at(here, "dim"));
    } else {
      field.solver_dimension = dimension_of(solver, here);
    }
  }
  if (json.contains("unit_for")) {
    real_only("unit_for");
    field.unit_for = names_of(json["unit_for"], at(path, "unit_for"));
  }
  if (json.contains("over")) {
    real_only("over");
    const auto here = at(path, "over");
    expect_object(json["over"], here, {"field", "when"});
    require(json["over"], here, "field");
    read(json["over"], here, "field", field.over);
    if (json["over"].contains("when"))
      field.over_when = conditions_of(json["over"]["when"], at(here, "when"));
  }
}

void read_dimension(const Json& json, const Path& path, Field& field) {
  if (json.contains("dim")) field.dimension = dimension_of(json["dim"], at(path, "dim"));
  bool unknown = false;
  read(json, path, "dim_unknown", unknown);
  field.dimension_known = !unknown;
  if (unknown && json.contains("dim")) fail(path, "\"dim\" and \"dim_unknown\" exclude each other");
  read_dimension_when(json, path, field.dimension_when);
  const bool any = json.contains("dim") || json.contains("dim_when") || unknown;
  const bool axes = unknown && field.type == FieldType::id;  // of the function or table
  if (any && field.type != FieldType::real && !axes)
    fail(path, "only real fields have a dimension");
}

void read_range(const Json& json, const Path& path, Field& field) {
  if (json.contains("values")) field.values = integers_of(json["values"], at(path, "values"));
  if (json.contains("min")) field.min = number_of(json["min"], at(path, "min"));
  if (json.contains("max")) field.max = number_of(json["max"], at(path, "max"));
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

int message_of(const Json& json, const Path& path) {
  const int message = small_of(json, path);
  if (message < 0) fail(path, "a message number is not negative");
  return message;
}

/// The texts that are legal, and the message about a cell that is not.
void read_legal(const Json& json, const Path& path, Field& field) {
  if (json.contains("words")) {
    const auto here = at(path, "words");
    if (field.type != FieldType::text) fail(here, "only text fields have a list of words");
    for (const auto& item : expect_array(json["words"], here))
      field.words.push_back(text_of(item, at(here, field.words.size())));
    if (field.words.empty()) fail(here, "the list is empty");
  }
  if (!json.contains("wrong")) return;
  if (field.words.empty() && field.type != FieldType::flag)
    fail(at(path, "wrong"), "only flags and texts with \"words\" can be wrong");
  field.wrong = message_of(json["wrong"], at(path, "wrong"));
}

/// Message numbers of the reference solver about the target of an id.
void read_target(const Json& json, const Path& path, Field& field) {
  const std::pair<const char*, std::optional<int>*> keys[] = {
      {"missing", &field.missing}, {"empty", &field.empty}, {"required", &field.required}};
  for (const auto& [key, out] : keys) {
    const auto it = json.find(key);
    if (it == json.end()) continue;
    if (field.type != FieldType::id) fail(at(path, key), "only ids have a target");
    *out = message_of(*it, at(path, key));
  }
  read(json, path, "acts_on", field.acts_on);
  if (field.acts_on && field.type != FieldType::id)
    fail(at(path, "acts_on"), "only ids have a target");
}

/// A default that is a number in full needs no other; words have theirs beside them.
void read_default(const Json& json, const Path& path, Field& field) {
  read(json, path, "default", field.default_text);
  if (const RealCell number = read_real(field.default_text);
      !field.default_text.empty() && number.status == NumberStatus::ok)
    field.default_value = number.value;
  if (json.contains("default_value")) {
    if (field.default_value)
      fail(at(path, "default_value"), "\"default\" is this number already, or another one");
    field.default_value = number_of(json["default_value"], at(path, "default_value"));
  }
  if (!json.contains("default_varies")) return;
  std::string varies;
  read(json, path, "default_varies", varies);
  if (varies != "deck" && varies != "model" && varies != "fields")
    fail(at(path, "default_varies"), fmt::format("\"{}\" is not deck, model or fields", varies));
  field.default_varies = varies == "deck"    ? DefaultVaries::deck
                         : varies == "model" ? DefaultVaries::model
                                             : DefaultVaries::fields;
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
  if (json.contains("when")) field.when = conditions_of(json["when"], at(path, "when"));
  read_range(json, path, field);
  read_legal(json, path, field);
  read_default(json, path, field);
  read_dimension(json, path, field);
  read_axes(json, path, field);
  read_relations(json, path, field);
  read(json, path, "ignored", field.ignored);
  read(json, path, "doc", field.doc);
  read(json, path, "manual", field.from_manual);
  if (json.contains("help")) {
    const auto here = at(path, "help");
    for (const auto& item : expect_array(json["help"], here))
      field.help.push_back(text_of(item, at(here, field.help.size())));
    if (field.help.empty()) fail(here, "the list is empty");
  }
  read(json, path, "help_of", field.help_of);
  return field;
}

void read_count(const Json& json, const Path& path, CardSchema& card) {
  if (const auto it = json.find("count"); it != json.end()) {
    if (card.repeat == Repeat::once || card.words)
      fail(at(path, "count"), "only repeated cards can have a count");
    card.count = it->is_number_integer() ? std::to_string(integer_of(*it, at(path, "count")))
                                         : text_of(*it, at(path, "count"));
  }
  if (const auto it = json.find("per_line"); it != json.end())
    card.per_line = small_of(*it, at(path, "per_line"));
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
  if (json.contains("when")) card.when = conditions_of(json["when"], at(path, "when"));
  std::string repeat;
  read(json, path, "repeat", repeat);
  card.words = repeat == "words";
  if (repeat == "rows") {
    card.repeat = Repeat::rows;
  } else if (repeat == "ids" || card.words) {
    card.repeat = Repeat::ids;
  } else if (repeat == "group") {
    card.repeat = Repeat::group;
  } else if (json.contains("repeat")) {
    fail(at(path, "repeat"), fmt::format("\"{}\" is not rows, ids, words or group", repeat));
  }
  read_count(json, path, card);
  read(json, path, "optional", card.optional);
  bool blank = false;
  read(json, path, "blank", blank);
  if (blank && json.contains("fields")) fail(at(path, "fields"), "a blank line has no fields");
  if (blank) return card;
  require(json, path, "fields");
  const auto here = at(path, "fields");
  for (const auto& item : expect_array(json["fields"], here))
    card.fields.push_back(field_of(item, at(here, card.fields.size())));
  if (card.fields.empty())
    fail(here, "the list is empty; for a line without fields write \"blank\"");
  return card;
}

void check_keyword(const std::string& keyword, const Path& path) {
  std::string_view rest = keyword;
  if (rest.substr(0, 2) == "//") rest.remove_prefix(1);
  bool good = rest.size() > 1 && rest[0] == '/' && rest.back() != '/' &&
              rest.find("//") == std::string_view::npos;
  for (const char c : rest) good = good && c > ' ';
  if (!good) fail(path, fmt::format("\"{}\" is not a keyword like /INTER/TYPE7", keyword));
}

/// What a deck older than the keyword is read with: the oldest layout, so what that has is there in
/// all versions before; or nothing. The one place that decides this.
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

Schema schema_of(const Json& json, const Path& path, std::string_view source) {
  expect_object(
      json, path,
      {"$schema", "keyword", "aliases", "kind", "id", "title", "unit", "unique", "unknown_unit",
       "bulk", "opaque_tail", "full_layout", "from", "older", "doc", "cards"});
  Schema schema;
  schema.source = source;
  require(json, path, "keyword");
  read(json, path, "keyword", schema.keyword);
  check_keyword(schema.keyword, at(path, "keyword"));
  if (json.contains("aliases")) {
    const auto here = at(path, "aliases");
    for (const auto& item : expect_array(json["aliases"], here)) {
      const auto entry = at(here, schema.aliases.size());
      schema.aliases.push_back(text_of(item, entry));
      check_keyword(schema.aliases.back(), entry);
    }
  }
  read(json, path, "kind", schema.kind);
  read(json, path, "id", schema.has_id);
  read(json, path, "title", schema.has_title);
  read(json, path, "unit", schema.has_unit);
  read(json, path, "unique", schema.unique);
  if (json.contains("unknown_unit"))
    schema.unknown_unit = message_of(json["unknown_unit"], at(path, "unknown_unit"));
  read(json, path, "bulk", schema.bulk);
  read(json, path, "opaque_tail", schema.opaque_tail);
  read(json, path, "full_layout", schema.full_layout);
  if (schema.full_layout && !schema.opaque_tail)
    fail(at(path, "full_layout"), "without opaque_tail a schema already describes everything");
  if (json.contains("from")) schema.from = version_of(json["from"], at(path, "from"));
  std::string older = "oldest layout";
  read(json, path, "older", older);
  const bool unread = older == "unread";
  if (!unread && json.contains("older")) fail(at(path, "older"), "the only value is \"unread\"");
  if (unread && schema.from == 0)
    fail(at(path, "older"), "\"from\" must say which decks are older");
  read(json, path, "doc", schema.doc);
  if (json.contains("cards")) {
    const auto here = at(path, "cards");
    for (const auto& item : expect_array(json["cards"], here))
      schema.cards.push_back(card_of(item, at(here, schema.cards.size())));
  }
  extend_to_older_decks(schema, unread);
  if (const auto wrong = check_schema(schema); !wrong.empty()) throw Wrong{path.text() + wrong};
  return schema;
}

/// JSON lets a key occur twice and the last one wins; in a schema that is a mistake.
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
struct Row {
  const Json* names;
  const Json* values;
};

/// `json` with each "{name}" of a text replaced by the word of the row.
Json filled(const Json& json, const Row& row) {
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

void add_schemas(const Json& list, const Path& path, std::string_view source,
                 std::vector<ReadSchema>& out);

/// A table of words, and the schemas that are read once for each of its rows:
/// {"for": [[NAME, ...], [WORD, ...], ...], "schemas": [...]}.
void add_family(const Json& family, const Path& path, std::string_view source,
                std::vector<ReadSchema>& out) {
  expect_object(family, path, {"for", "schemas"});
  require(family, path, "schemas");
  const auto here = at(path, "for");
  const Json& table = expect_array(family["for"], here);
  if (table.size() < 2) fail(here, "expected a row of names and rows of words");
  for (std::size_t k = 0; k < table.size(); ++k) {
    const auto entry = at(here, k);
    names_of(table[k], entry);
    if (table[k].size() != table[0].size())
      fail(entry, fmt::format("expected {} words, one for each name", table[0].size()));
    if (k > 0)
      add_schemas(filled(family["schemas"], {&table[0], &table[k]}), at(path, "schemas"), source,
                  out);
  }
}

void add_schemas(const Json& list, const Path& path, std::string_view source,
                 std::vector<ReadSchema>& out) {
  std::size_t n = 0;
  for (const auto& item : expect_array(list, path)) {
    const auto here = at(path, n++);
    if (item.is_object() && item.contains("for"))
      add_family(item, here, source, out);
    else
      out.push_back({schema_of(item, here, source), item.dump()});
  }
}

/// What `read` gives; what it throws as an error that begins with the name of the text.
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
                                            2019, 2020, 2021, 2022, 2023, 2024, 2025, 2026};
  return versions;
}

Result<std::vector<ReadSchema>> read_schemas(std::string_view name, std::string_view text) {
  return reading(name, [&] {
    if (is_nested_too_deep(text)) throw Wrong{"nested too deep for a schema"};
    DuplicateKeys duplicates;
    const auto json = Json::parse(text, [&](int, Json::parse_event_t event, Json& parsed) {
      return duplicates(event, parsed);
    });
    std::vector<ReadSchema> schemas;
    if (json.is_object() && json.contains("schemas")) {
      const Path root;
      expect_object(json, root, {"$schema", "schemas"});
      add_schemas(json["schemas"], at(root, "schemas"), name, schemas);
    } else {
      schemas.push_back({schema_of(json, {}, name), json.dump()});
    }
    return schemas;
  });
}

Result<Schema> read_checked_schema(std::string_view name, std::string_view text) {
  return reading(name, [&] { return schema_of(Json::parse(text), {}, name); });
}

}  // namespace deck::detail
