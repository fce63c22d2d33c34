// JsonWriter: writes JSON to a string. Doubles have the shortest form that reads back equal; bytes
// that are not UTF-8 count as Latin-1, so every title survives.
#pragma once
#include <concepts>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/shared/shown_text.hpp"
#include "deck/keyword.hpp"
#include "deck/model.hpp"
#include "deck/report.hpp"
#include "deck/text.hpp"

namespace deck {

class JsonWriter {
 public:
  /// The drain may take the text at any time.
  explicit JsonWriter(std::string& out, TextDrain drain = {}) : out_(out), drain_(drain) {}
  void drain() { drain_text(drain_, out_); }

  /// `line`: write the container on one line.
  JsonWriter& begin_object(bool line = false) { return open('{', line); }
  JsonWriter& end_object() { return close('}'); }
  JsonWriter& begin_array(bool line = false) { return open('[', line); }
  JsonWriter& end_array() { return close(']'); }
  JsonWriter& key(std::string_view name);

  JsonWriter& value(std::string_view text);
  JsonWriter& value(const char* text) { return value(std::string_view(text)); }
  JsonWriter& value(const std::string& text) { return value(std::string_view(text)); }
  /// Always with point or exponent; null for infinite and undefined values.
  JsonWriter& value(double number);
  JsonWriter& value(bool b);
  template <std::integral T>
  requires(!std::same_as<T, bool>) JsonWriter& value(T number) {
    return raw(std::to_string(number));
  }
  JsonWriter& null() { return raw("null"); }
  /// Text that already is JSON.
  JsonWriter& raw(std::string_view json);

  /// key() and value() in one.
  template <class T>
  JsonWriter& field(std::string_view name, const T& v) {
    return key(name).value(v);
  }

 private:
  JsonWriter& open(char bracket, bool line);
  JsonWriter& close(char bracket);
  void before_value();

  struct Level {
    bool line = false;
    bool empty = true;
  };
  std::string& out_;
  TextDrain drain_;
  std::vector<Level> levels_;
  bool after_key_ = false;
};

/// Version of this library, "1.2.3".
std::string_view library_version();

/// Begin of every document: the members "schema" and "tool" ...
void write_json_head(JsonWriter& json, std::string_view schema_id, int schema_version);
/// ... and "deck": path as given, version, units, counts, includes. `model` and `interfaces` may be
/// nullptr if not built.
void write_json_deck(JsonWriter& json, std::string_view path, const Deck& deck, const Model* model,
                     const Interfaces* interfaces);

struct DocumentSchema {
  std::string text;
  std::map<std::string, std::string> common;  ///< shared definitions
};
struct DocumentOfVerb {
  const char* verb;
  DocumentSchema (*schema)();
};
const std::vector<DocumentOfVerb>& documents_of_verbs();
/// Content of common.schema.json, to which schemas of documents refer.
std::string common_schema();

DocumentSchema accuracy_schema();
DocumentSchema cycle_schema();
DocumentSchema diff_schema();
DocumentSchema explain_schema();
DocumentSchema fix_schema();
DocumentSchema gaps_schema();
DocumentSchema gate_schema();
DocumentSchema lint_schema();
DocumentSchema losses_schema();
DocumentSchema page_schema();  ///< of the JSON in a page, see html/page_data.cpp
DocumentSchema params_schema();
DocumentSchema parts_schema();
DocumentSchema rules_schema();
DocumentSchema show_schema();

}  // namespace deck
