// JsonWriter: JSON as text, written straight into a string. Doubles have the shortest form that
// reads back to the same number; bytes that are no UTF-8 are taken for Latin-1, so every title
// survives.
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
  /// From time to time the text may leave by the drain.
  explicit JsonWriter(std::string& out, TextDrain drain = {}) : out_(out), drain_(drain) {}
  void drain() { drain_text(drain_, out_); }

  /// `line` true: the container and all in it stand on one line.
  JsonWriter& begin_object(bool line = false) { return open('{', line); }
  JsonWriter& end_object() { return close('}'); }
  JsonWriter& begin_array(bool line = false) { return open('[', line); }
  JsonWriter& end_array() { return close(']'); }
  JsonWriter& key(std::string_view name);

  JsonWriter& value(std::string_view text);
  JsonWriter& value(const char* text) { return value(std::string_view(text)); }
  JsonWriter& value(const std::string& text) { return value(std::string_view(text)); }
  /// Always with a point or an exponent; infinite and undefined values become null.
  JsonWriter& value(double number);
  JsonWriter& value(bool b);
  template <std::integral T>
  requires(!std::same_as<T, bool>) JsonWriter& value(T number) {
    return raw(std::to_string(number));
  }
  JsonWriter& null() { return raw("null"); }
  /// Text that is JSON already.
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

/// What every document starts with: the members "schema" and "tool" ...
void write_json_head(JsonWriter& json, std::string_view schema_id, int schema_version);
/// ... and "deck": path as given, version, units, counts, includes. `model` and `interfaces` may be
/// nullptr where they were not built.
void write_json_deck(JsonWriter& json, std::string_view path, const Deck& deck, const Model* model,
                     const Interfaces* interfaces);

/// The JSON schema of a document.
struct DocumentSchema {
  std::string text;
  std::map<std::string, std::string> common;  ///< definitions that it shares with others
};
struct DocumentOfVerb {
  const char* verb;
  DocumentSchema (*schema)();
};
const std::vector<DocumentOfVerb>& documents_of_verbs();
/// What the schemas of documents refer to as common.schema.json.
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
