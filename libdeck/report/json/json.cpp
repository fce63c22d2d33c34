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

}  // namespace deck
