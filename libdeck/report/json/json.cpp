// Escapes strings, prints numbers and keeps the nesting right.
#include "report/shared/json.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/shared/length_text.hpp"

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

namespace {

void write_units(JsonWriter& json, std::string_view name, bool given, const UnitSystem& units) {
  json.key(name);
  if (!given) {
    json.null();
    return;
  }
  json.begin_object(true);
  json.field("mass", units.mass_code).field("length", units.length_code);
  json.field("time", units.time_code).end_object();
}

}  // namespace

void write_json_deck(JsonWriter& json, std::string_view path, const Deck& deck, const Model* model,
                     const Interfaces* interfaces) {
  json.key("deck").begin_object();
  json.field("path", path).field("title", deck.begin.run_name).field("version", deck.version);
  json.key("units").begin_object(true);
  write_units(json, "input", deck.begin.has_input || deck.begin.has_working, deck.begin.input);
  write_units(json, "working", deck.begin.has_input || deck.begin.has_working, deck.begin.working);
  json.end_object();
  json.key("counts").begin_object(true);
  json.field("bytes", deck.total_bytes).field("files", deck.sources.size());
  json.field("blocks", deck.blocks.size()).field("submodels", deck.submodels.size());
  if (model != nullptr) {
    json.field("nodes", model->nodes.size());
    json.field("shells", model->shell4.size() + model->shell3.size());
    json.field("solids", model->solid8.size());
    json.field("springs_beams_trusses",
               model->spring.size() + model->beam.size() + model->truss.size());
    json.field("parts", model->parts.size());
  }
  if (interfaces != nullptr) json.field("interfaces", interfaces->ordered.size());
  json.end_object();
  json.key("includes").begin_array();
  for (const IncludeEdge& e : deck.includes) {
    json.begin_object(true);
    json.field("path", deck.sources[e.file].path()).field("written", e.written);
    json.key("from");
    write_json_place(json, deck, e.directive);
    json.end_object();
  }
  json.end_array();
  json.end_object();
}

void write_json_coverage(JsonWriter& json, const Coverage& coverage) {
  json.field("examined", coverage.examined).key("not_examined").begin_array();
  for (const NotExamined& n : coverage.not_examined) {
    json.begin_object(true).field("keyword", n.keyword).field("count", n.ids.size()).key("ids");
    json.begin_array(true);
    for (const std::int64_t id : n.ids) json.value(id);
    json.end_array().end_object();
  }
  json.end_array();
}

void write_json_place(JsonWriter& json, const Deck& deck, const Span& span) {
  if (!span.valid()) {
    json.null();
    return;
  }
  const Position p = deck.sources.position(span);
  json.begin_object(true);
  json.field("file", deck.sources[span.file].path());
  json.field("line", p.line).field("column", p.column).end_object();
}

}  // namespace deck
