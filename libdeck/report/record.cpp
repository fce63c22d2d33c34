// Writes JSON: escapes strings, prints numbers, keeps the nesting; writes JSON schemas of records
// and documents.
#include "report/record.hpp"

#include <fmt/format.h>

#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"

namespace deck {

std::string_view library_version() { return DECK_VERSION; }

void JsonWriter::before_value() {
  if (after_key_) {
    after_key_ = false;
    return;
  }
  if (levels_.empty()) return;
  Level& level = levels_.back();
  if (!level.empty) out_ += level.line ? ", " : ",";
  level.empty = false;
  if (!level.line) {
    out_ += '\n';
    out_.append(2 * levels_.size(), ' ');
  }
}

JsonWriter& JsonWriter::open(char bracket, bool line) {
  before_value();
  out_ += bracket;
  levels_.push_back({line || (!levels_.empty() && levels_.back().line), true});
  return *this;
}

JsonWriter& JsonWriter::close(char bracket) {
  const Level level = levels_.back();
  levels_.pop_back();
  if (!level.line && !level.empty) {
    out_ += '\n';
    out_.append(2 * levels_.size(), ' ');
  }
  out_ += bracket;
  if (levels_.empty()) out_ += '\n';
  return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
  before_value();
  append_json_string(out_, name);
  out_ += ": ";
  after_key_ = true;
  return *this;
}

JsonWriter& JsonWriter::value(std::string_view text) {
  before_value();
  append_json_string(out_, text);
  return *this;
}

JsonWriter& JsonWriter::value(double number) {
  return raw(is_unbounded(number) ? std::string("null") : shortest(number));
}

JsonWriter& JsonWriter::value(bool b) { return raw(b ? "true" : "false"); }

JsonWriter& JsonWriter::raw(std::string_view json) {
  before_value();
  out_ += json;
  return *this;
}

void write_json_head(JsonWriter& json, std::string_view schema_id, int schema_version) {
  json.key("schema").begin_object(true);
  json.field("id", schema_id).field("version", schema_version).end_object();
  json.key("tool").begin_object(true);
  json.field("name", "deck").field("version", library_version()).end_object();
}

// ---- schemas ----------------------------------------------------------------------------------

namespace {

constexpr std::size_t most_columns = 115;  ///< properties share a line that is no longer

std::string json_text(std::string_view text) {
  std::string out;
  append_json_string(out, text);
  return out;
}

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + json_text(word);
  return out;
}

std::string definitions_text(const std::map<std::string, std::string>& definitions) {
  std::string out;
  for (const auto& [name, form] : definitions)
    out += fmt::format("{}    {}: {}", out.empty() ? "" : ",\n", json_text(name), form);
  return out;
}

}  // namespace

std::string JsonForm::members() const {
  if (type.empty())
    return null ? fmt::format(R"("oneOf": [{{ "type": "null" }}, {{ {} }}])", rest) : rest;
  return fmt::format(R"("type": {}{}{})",
                     null ? fmt::format(R"(["{}", "null"])", type) : json_text(type),
                     rest.empty() ? "" : ", ", rest);
}

JsonForm SchemaDefinitions::reference(const char* name, bool common,
                                      const std::function<std::string()>& form) {
  auto& definitions = common ? common_ : own_;
  if (definitions.emplace(name, "").second) definitions[name] = form();
  return {"", fmt::format(R"("$ref": "{}#/$defs/{}")", common ? "common.schema.json" : "", name)};
}

std::string object_form(std::string_view says,
                        const std::vector<std::pair<std::string, std::string>>& members,
                        const std::vector<std::string>& required) {
  std::string out = "{ ";
  if (!says.empty()) out += fmt::format("\"description\": {}, ", json_text(says));
  out += "\"type\": \"object\", \"additionalProperties\": false,\n      ";
  if (!required.empty()) out += fmt::format("\"required\": [{}], ", joined(required));
  out += "\"properties\": {";
  std::size_t end = most_columns;  // of the present line
  for (const auto& [name, form] : members) {
    const std::string member = fmt::format("{}: {}", json_text(name), form);
    const bool first = out.ends_with('{'), fits = end + member.size() + 3 <= most_columns;
    out += (first ? "" : ",") + std::string(fits ? " " : "\n        ") + member;
    end = (fits ? end + 2 : 8) + member.size();
  }
  return out + " } }";
}

std::string described(const char* says, const JsonForm& form) {
  if (*says == 0) return fmt::format("{{ {} }}", form.members());
  return fmt::format(R"({{ "description": {}, {} }})", json_text(says), form.members());
}

JsonForm list_form(const JsonForm& items, std::size_t size) {
  std::string rest = fmt::format(R"("items": {{ {} }})", items.members());
  if (size > 0) rest += fmt::format(R"(, "minItems": {0}, "maxItems": {0})", size);
  return {"array", rest};
}

JsonForm tuple_form(const std::vector<JsonForm>& items) {
  std::string all;
  for (const JsonForm& item : items)
    all += fmt::format("{}{{ {} }}", all.empty() ? "" : ", ", item.members());
  // Without "items", whose meaning differs in older drafts.
  return {"array", fmt::format(R"("prefixItems": [{0}], "minItems": {1}, "maxItems": {1})", all,
                               items.size())};
}

JsonForm words_form(const std::vector<std::string>& words) {
  return {"", fmt::format(R"("enum": [{}])", joined(words))};
}

void Value<Counts>::write(JsonWriter& json, const Counts& counts) {
  json.begin_object(true);
  for (const auto& [name, n] : counts) json.field(name, n);
  json.end_object();
}

JsonForm Value<Counts>::form(SchemaDefinitions&) {
  return {"object", R"("additionalProperties": { "type": "integer", "minimum": 0 })"};
}

DocumentSchema document_schema(const DocumentHead& head, const SchemaDefinitions& definitions,
                               const std::string& record) {
  const std::string common = R"({ "$ref": "common.schema.json#/$defs/tool" })";
  std::string document = definitions.own().at(record);
  const auto insert = [&](std::string_view before, std::string_view text) {
    document.insert(document.find(before) + before.size(), text);
  };
  insert("\"required\": [", R"("schema", "tool", )");
  insert("\"properties\": {\n", R"(        "schema": { "$ref": "#/$defs/schema" },
        "tool": { "$ref": "common.schema.json#/$defs/tool" },
)");
  auto own = definitions.own();
  own[record] = document;
  own["schema"] = fmt::format(
      R"({{ "type": "object", "required": ["id", "version"], "additionalProperties": false, "properties": {{ "id": {{ "const": "{}" }}, "version": {{ "const": {} }} }} }})",
      head.id, head.version);
  std::string body = fmt::format("  \"$ref\": \"#/$defs/{}\",\n", record);
  if (head.several) {
    own["several"] = object_form(
        "Several decks.",
        {{"schema", R"({ "$ref": "#/$defs/schema" })"},
         {"tool", common},
         {"decks",
          fmt::format(R"({{ "type": "array", "items": {{ "$ref": "#/$defs/{}" }} }})", record)}},
        {"schema", "tool", "decks"});
    body = fmt::format(R"(  "oneOf": [{{ "$ref": "#/$defs/{}" }}, {{ "$ref": "#/$defs/several" }}],
)",
                       record);
  }
  const std::string text = fmt::format(
      R"({{
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "title": "{}, version {}",
  "description": {},
{}  "$defs": {{
{}
  }}
}}
)",
      head.title != nullptr ? head.title : fmt::format("deck {} --json", head.id + 5), head.version,
      json_text(head.says), body, definitions_text(own));
  return {text, definitions.common()};
}

std::string common_schema() {
  std::map<std::string, std::string> all;
  for (const DocumentOfVerb& document : documents_of_verbs())
    for (const auto& definition : document.schema().common) all.insert(definition);
  all["tool"] =
      object_form("", {{"name", R"({ "const": "deck" })"}, {"version", R"({ "type": "string" })"}},
                  {"name", "version"});
  return fmt::format(R"({{
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "title": "Definitions that the documents of deck share",
  "$defs": {{
{}
  }}
}}
)",
                     definitions_text(all));
}

const std::vector<DocumentOfVerb>& documents_of_verbs() {
  static const std::vector<DocumentOfVerb> documents = {
      {"accuracy", accuracy_schema}, {"cycle", cycle_schema},   {"diff", diff_schema},
      {"explain", explain_schema},   {"fix", fix_schema},       {"gaps", gaps_schema},
      {"gate", gate_schema},         {"lint", lint_schema},     {"losses", losses_schema},
      {"page", page_schema},         {"params", params_schema}, {"parts", parts_schema},
      {"rules", rules_schema},       {"show", show_schema}};
  return documents;
}

}  // namespace deck
