// Records: one table of columns describes the members of a JSON object. The writer of the object
// and its JSON schema are both made from this table.
//
// A macro next to a type makes the type a record:
//
//   LINE_RECORD(Crossing, "crossing", "An edge through a segment.",
//               COLUMN("edge", "Node ids", r.edge), COLUMN("side", "1 to 4", r.side + 1));
//
// A record has a name, a description and columns. A LINE_RECORD is written on one line, a RECORD on
// several. The schema of a COMMON_RECORD is in common.schema.json, which all documents use. A
// column has a name, a description for the schema, and an expression of the row `r`. The type of
// the expression decides the form of the member:
//
//   double                       a number; null if it is not finite
//   integers, bool, texts        unchanged; the schema says that unsigned integers are 0 or more
//   enumerations                 to_string() of it: one of the first word_count<E> words
//   std::optional<T>             a T, or null
//   IfAny<T>                     a T; without a value the object lacks the member
//   std::array, std::vector      a list on one line; a vector of records is written as Rows
//   Counts                       an object of names and counts
//   std::tuple                   a list on one line; each value has its own form
//   Scalar                       a number or a text
//   Named<T>                     an object whose member names are data; each value is a T
//   a record                     an object
//   Rows<T>                      a list of records T, written one by one
//
// OBJECT or LINE_OBJECT in the place of a column is a nested object with columns of this row.
#pragma once
#include <array>
#include <concepts>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "deck/report.hpp"
#include "report/shared/json.hpp"

namespace deck {

/// The form of a value as JSON schema.
struct JsonForm {
  std::string type;   ///< "integer"; empty if `rest` says everything
  std::string rest;   ///< further members, as "minimum": 0
  bool null = false;  ///< null is allowed as well

  JsonForm or_null() const { return {type, rest, true}; }
  std::string members() const;  ///< the text between the braces
};

/// Records that the forms of a document refer to, by name: their JSON schemas.
class SchemaDefinitions {
 public:
  /// A reference to a record; `form` describes it on first use. `common`: the record is in the file
  /// shared by all documents.
  JsonForm reference(const char* name, bool common, const std::function<std::string()>& form);
  const std::map<std::string, std::string>& own() const { return own_; }
  const std::map<std::string, std::string>& common() const { return common_; }

 private:
  std::map<std::string, std::string> own_, common_;
};

template <class Row>
struct Column {
  const char* name = nullptr;
  const char* says = nullptr;  ///< description in the schema; may be empty
  bool required = true;
  void (*write)(JsonWriter&, std::string_view name, const Row&) = nullptr;
  JsonForm (*form)(SchemaDefinitions&) = nullptr;
};

template <class Row>
struct Record {
  const char* name;
  const char* says;
  std::span<const Column<Row>> columns;
  bool line = false;    ///< the object is written on one line
  bool common = false;  ///< its schema is in the file that all documents share
};

template <class T>
struct IfAny {
  std::optional<T> value;
};

template <class T>
struct Rows {
  /// Calls its argument with each row.
  std::function<void(const std::function<void(const T&)>&)> each;
  bool line = false;  ///< the list is on one line
};

/// Rows that `make` gives for the values of a list. Keeps a temporary list; any other must outlive
/// the rows.
template <class List, class Make = std::identity>
auto rows_of(List&& list, Make make = {}) {
  using T = std::remove_cvref_t<decltype(make(*list.begin()))>;
  return Rows<T>{[kept = std::tuple<List>(std::forward<List>(list)), make](const auto& add) {
    for (const auto& value : std::get<0>(kept)) add(make(value));
  }};
}

template <class T>
const T* pointer_to(const T& value) {
  return &value;
}
template <class T>
const T* pointer_to(const T* value) {
  return value;
}
/// A Row per value of a list, made of `context` and a pointer to the value.
template <class Row, class List, class... Context>
Rows<Row> rows(List&& list, Context&&... context) {
  return {[kept = std::tuple<List>(std::forward<List>(list)),
           before = std::tuple<Context...>(std::forward<Context>(context)...)](const auto& add) {
    for (const auto& value : std::get<0>(kept))
      std::apply([&](const auto&... c) { add(Row{c..., pointer_to(value)}); }, before);
  }};
}

template <class Source, class Row>
Row row_of_each(void (*)(const Source&, const std::function<void(const Row&)>&));
/// Rows that a function adds: rows_from<add_contacts>(document).
template <auto Each, class Source>
auto rows_from(const Source& source) {
  using Row = decltype(row_of_each(Each));
  return Rows<Row>{[&source](const std::function<void(const Row&)>& add) { Each(source, add); }};
}

template <class T>
struct Named {
  /// Calls its argument with each name and value.
  std::function<void(const std::function<void(std::string_view, const T&)>&)> each;
  bool line = false;  ///< the object is on one line
};

using Counts = std::vector<std::pair<std::string, std::uint64_t>>;
using Scalar = std::variant<std::int64_t, double, std::string>;

/// Number of values of an enumeration, from 0 on, that have a word.
template <class E>
inline constexpr std::size_t word_count = 0;

// ---- one form for each type -------------------------------------------------------------------

template <class T>
concept HasRecord = requires(const T* t) {
  record_of(t);
};

template <class Row>
void write_members(JsonWriter& json, const Row& row) {
  for (const Column<Row>& c : record_of(&row).columns) c.write(json, c.name, row);
}

/// The JSON schema of a record; as many columns share a line as fit 115 columns of text.
std::string object_form(std::string_view says,
                        const std::vector<std::pair<std::string, std::string>>& members,
                        const std::vector<std::string>& required);
std::string described(const char* says, const JsonForm& form);
JsonForm list_form(const JsonForm& items, std::size_t size = 0);
JsonForm tuple_form(const std::vector<JsonForm>& items);
JsonForm words_form(const std::vector<std::string>& words);

template <class Row>
JsonForm record_form(SchemaDefinitions& definitions,
                     const Record<Row>& record = record_of(static_cast<const Row*>(nullptr))) {
  return definitions.reference(record.name, record.common, [&] {
    std::vector<std::pair<std::string, std::string>> members;
    std::vector<std::string> required;
    for (const Column<Row>& c : record.columns) {
      members.emplace_back(c.name, described(c.says, c.form(definitions)));
      if (c.required) required.emplace_back(c.name);
    }
    return object_form(record.says, members, required);
  });
}

template <class T>
struct Value {
  static void write(JsonWriter& json, const T& v) {
    if constexpr (HasRecord<T>) {
      json.begin_object(record_of(&v).line);
      write_members(json, v);
      json.end_object();
    } else if constexpr (std::is_enum_v<T>) {
      json.value(to_string(v));
    } else {
      json.value(v);
    }
  }
  static JsonForm form(SchemaDefinitions& definitions) {
    if constexpr (HasRecord<T>) {
      return record_form<T>(definitions);
    } else if constexpr (std::is_enum_v<T>) {
      static_assert(word_count<T> > 0, "word_count<E> says how many words the enumeration has");
      std::vector<std::string> words;
      for (std::size_t i = 0; i < word_count<T>; ++i)
        words.emplace_back(to_string(static_cast<T>(i)));
      return words_form(words);
    } else if constexpr (std::same_as<T, bool>) {
      return {"boolean", ""};
    } else if constexpr (std::unsigned_integral<T>) {
      return {"integer", "\"minimum\": 0"};
    } else if constexpr (std::integral<T>) {
      return {"integer", ""};
    } else if constexpr (std::floating_point<T>) {
      return JsonForm{"number", ""}.or_null();
    } else {
      return {"string", ""};
    }
  }
};

template <class T>
struct Value<std::optional<T>> {
  static void write(JsonWriter& json, const std::optional<T>& v) {
    v ? Value<T>::write(json, *v) : void(json.null());
  }
  static JsonForm form(SchemaDefinitions& d) { return Value<T>::form(d).or_null(); }
};

template <class List>
void write_list(JsonWriter& json, const List& list) {
  json.begin_array(true);
  for (const auto& v : list) Value<std::remove_cvref_t<decltype(v)>>::write(json, v);
  json.end_array();
}

template <class T, std::size_t N>
struct Value<std::array<T, N>> {
  static void write(JsonWriter& json, const std::array<T, N>& v) { write_list(json, v); }
  static JsonForm form(SchemaDefinitions& d) { return list_form(Value<T>::form(d), N); }
};

template <class T>
struct Value<std::vector<T>> {
  static void write(JsonWriter& json, const std::vector<T>& v) {
    if constexpr (HasRecord<T>)
      Value<Rows<T>>::write(json, rows_of(v));
    else
      write_list(json, v);
  }
  static JsonForm form(SchemaDefinitions& d) { return list_form(Value<T>::form(d)); }
};

template <class... T>
struct Value<std::tuple<T...>> {
  static void write(JsonWriter& json, const std::tuple<T...>& row) {
    json.begin_array(true);
    std::apply([&](const T&... values) { (Value<T>::write(json, values), ...); }, row);
    json.end_array();
  }
  static JsonForm form(SchemaDefinitions& d) { return tuple_form({Value<T>::form(d)...}); }
};

template <>
struct Value<Counts> {
  static void write(JsonWriter& json, const Counts& counts);
  static JsonForm form(SchemaDefinitions& d);
};

template <>
struct Value<Scalar> {
  static void write(JsonWriter& json, const Scalar& scalar) {
    std::visit([&](const auto& v) { json.value(v); }, scalar);
  }
  static JsonForm form(SchemaDefinitions&) { return {"", R"("type": ["number", "string"])", true}; }
};

template <class T>
struct Value<Named<T>> {
  static void write(JsonWriter& json, const Named<T>& members) {
    json.begin_object(members.line);
    members.each([&](std::string_view name, const T& value) {
      json.key(name);
      Value<T>::write(json, value);
    });
    json.end_object();
  }
  static JsonForm form(SchemaDefinitions& d) {
    return {"object", "\"additionalProperties\": { " + Value<T>::form(d).members() + " }"};
  }
};

template <class T>
struct Value<Rows<T>> {
  static void write(JsonWriter& json, const Rows<T>& rows) {
    json.begin_array(rows.line);
    rows.each([&](const T& row) {
      Value<T>::write(json, row);
      json.drain();
    });
    json.end_array();
  }
  static JsonForm form(SchemaDefinitions& d) { return list_form(Value<T>::form(d)); }
};

template <class T>
struct Value<IfAny<T>> {
  static JsonForm form(SchemaDefinitions& d) { return Value<T>::form(d); }
};

template <class T>
inline constexpr bool is_if_any = false;
template <class T>
inline constexpr bool is_if_any<IfAny<T>> = true;

/// Value of a column's expression: a reference for an lvalue, else a copy.
template <class T>
constexpr T column_value(T&& value) {
  return std::forward<T>(value);
}
constexpr const char* column_value(const char* text) { return text; }

struct ColumnText {
  const char* name;
  const char* says;
};

/// A column of a row type that `Get` accepts. Both lambdas have no captures: the type is the
/// column.
template <class Text, class Get>
struct ColumnOf {
  ColumnOf() = default;
  constexpr ColumnOf(Text, Get) {}

  template <class Row>
  using T = std::remove_cvref_t<std::invoke_result_t<Get, const Row&>>;

  template <class Row>
  static constexpr std::array<Column<Row>, 1> of() {
    return {{{Text{}().name, Text{}().says, !is_if_any<T<Row>>, &write<Row>,
              [](SchemaDefinitions& d) { return Value<T<Row>>::form(d); }}}};
  }

 private:
  template <class Row>
  static void write(JsonWriter& json, std::string_view name, const Row& row) {
    const auto& value = Get{}(row);
    if constexpr (is_if_any<T<Row>>) {
      if (!value.value) return;
      json.key(name);
      Value<std::remove_cvref_t<decltype(*value.value)>>::write(json, *value.value);
    } else {
      json.key(name);
      Value<T<Row>>::write(json, value);
    }
  }
};

/// Shared columns: records include them among their own.
template <class... Columns>
struct ColumnsOf {
  ColumnsOf() = default;
  constexpr explicit ColumnsOf(Columns...) {}

  template <class Row>
  static constexpr auto of() {
    std::array<Column<Row>, (Columns::template of<Row>().size() + ...)> out{};
    std::size_t i = 0;
    const auto add = [&](const auto& columns) {
      for (const Column<Row>& c : columns) out[i++] = c;
    };
    (add(Columns::template of<Row>()), ...);
    return out;
  }
  template <class Row>
  static constexpr auto all = of<Row>();
};
template <class Row, class... Columns>
constexpr Record<Row> make_record(const char* name, const char* says, bool line, bool common,
                                  Columns...) {
  return {name, says, ColumnsOf<Columns...>::template all<Row>, line, common};
}

/// A member that is an object with other columns of the row; in schemas a record of this name.
template <bool line, class Text, class... Columns>
struct ObjectOf {
  template <class Row>
  static constexpr std::array<Column<Row>, 1> of() {
    return {{{Text{}().name, "", true,
              [](JsonWriter& json, std::string_view name, const Row& row) {
                json.key(name).begin_object(line);
                for (const Column<Row>& c : ColumnsOf<Columns...>::template all<Row>)
                  c.write(json, c.name, row);
                json.end_object();
              },
              [](SchemaDefinitions& d) {
                return record_form(
                    d, make_record<Row>(Text{}().name, Text{}().says, line, false, Columns{}...));
              }}}};
  }
};
template <bool line, class Text, class... Columns>
constexpr ObjectOf<line, Text, Columns...> object_of(Text, Columns...) {
  return {};
}

#define RECORD_AS(Row, line, common, name, says, ...)               \
  Record<Row> record_of(const Row*) {                               \
    return make_record<Row>(name, says, line, common, __VA_ARGS__); \
  }                                                                 \
  Record<Row> record_of(const Row*)
#define RECORD(Row, ...) RECORD_AS(Row, false, false, __VA_ARGS__)
#define LINE_RECORD(Row, ...) RECORD_AS(Row, true, false, __VA_ARGS__)
#define COMMON_RECORD(Row, ...) RECORD_AS(Row, false, true, __VA_ARGS__)
#define COMMON_LINE_RECORD(Row, ...) RECORD_AS(Row, true, true, __VA_ARGS__)
#define COLUMN_TEXT(name, says) [] { return ColumnText{name, says}; }
#define COLUMN(name, says, ...)                                                            \
  ColumnOf(COLUMN_TEXT(name, says), []([[maybe_unused]] const auto& r) -> decltype(auto) { \
    return column_value(__VA_ARGS__);                                                      \
  })
#define OBJECT(name, says, ...) object_of<false>(COLUMN_TEXT(name, says), __VA_ARGS__)
#define LINE_OBJECT(name, says, ...) object_of<true>(COLUMN_TEXT(name, says), __VA_ARGS__)

template <class T>
void write_value(JsonWriter& json, const T& value) {
  Value<T>::write(json, value);
}

// ---- documents --------------------------------------------------------------------------------

/// The head of a document's schema.
struct DocumentHead {
  const char* id;  ///< "deck/gaps"
  int version;
  const char* says;
  bool several = true;          ///< several decks: {schema, tool, decks: [document, ...]}
  const char* title = nullptr;  ///< nullptr: "deck VERB --json"
};

/// Schema of a document whose members, after "schema" and "tool", are a record.
DocumentSchema document_schema(const DocumentHead& head, const SchemaDefinitions& definitions,
                               const std::string& record);
template <class Row>
DocumentSchema document_schema(const DocumentHead& head) {
  SchemaDefinitions definitions;
  record_form<Row>(definitions);
  return document_schema(head, definitions, record_of(static_cast<const Row*>(nullptr)).name);
}

/// Writes a document; the second form returns its text.
template <class Row>
void write_document(JsonWriter& json, const DocumentHead& head, const Row& row) {
  json.begin_object();
  write_json_head(json, head.id, head.version);
  write_members(json, row);
  json.end_object();
}
template <class Row>
std::string write_document(const DocumentHead& head, const Row& row, const TextDrain& drain = {}) {
  std::string text;
  JsonWriter json(text, drain);
  write_document(json, head, row);
  return text;
}

}  // namespace deck
