// The JSON text is parsed as a whole; every line is then made on its own, from its text and from
// the values that differ from what the text says.
#include "deck/edit/from_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "deck/keyword/decode.hpp"
#include "edit/convert/version_cards.hpp"
#include "keyword/header_line.hpp"
#include "keyword/reader.hpp"
#include "report/json/deck_json_cells.hpp"

namespace deck {
namespace {

using Json = nlohmann::json;
using detail::CellKind;

/// Thrown inside this file only: the first thing that is wrong, with its JSON path.
struct Wrong {
  std::string what;
};

/// Where we are in the document. Turned into text only when something is wrong.
struct Path {
  const Path* parent = nullptr;
  std::string_view key;
  std::size_t index = 0;
  std::string text() const {
    if (parent == nullptr) return {};
    return parent->text() + (key.empty() ? fmt::format("/{}", index) : fmt::format("/{}", key));
  }
};

[[noreturn]] void fail(const Path& path, const std::string& what) {
  const std::string text = path.text();
  throw Wrong{(text.empty() ? "/" : text) + ": " + what};
}

const Json& member(const Json& object, const char* key, const Path& path) {
  if (!object.is_object())
    fail(path, std::string("expected an object, found ") + object.type_name());
  const auto it = object.find(key);
  if (it == object.end()) fail(path, fmt::format("\"{}\" is missing", key));
  return *it;
}

/// nullptr if there is no such member.
const Json* optional_member(const Json& object, const char* key, const Path& path) {
  if (!object.is_object())
    fail(path, std::string("expected an object, found ") + object.type_name());
  const auto it = object.find(key);
  return it == object.end() || it->is_null() ? nullptr : &*it;
}

const Json& array_of(const Json& json, const Path& path) {
  if (!json.is_array()) fail(path, std::string("expected a list, found ") + json.type_name());
  return json;
}

const std::string& string_of(const Json& json, const Path& path) {
  if (!json.is_string()) fail(path, std::string("expected a string, found ") + json.type_name());
  return json.get_ref<const std::string&>();
}

bool bool_of(const Json& json, const Path& path) {
  if (!json.is_boolean())
    fail(path, std::string("expected true or false, found ") + json.type_name());
  return json.get<bool>();
}

/// Integer of a JSON number; numbers beyond 64 bits are refused.
std::int64_t integer_of(const Json& json, const Path& path) {
  if (!json.is_number_integer())
    fail(path, std::string("expected an integer, found ") + json.type_name());
  if (json.is_number_unsigned() &&
      json.get<std::uint64_t>() >
          static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
    fail(path, "the number is too large");
  return json.get<std::int64_t>();
}

using detail::trim_right;

bool is_reference(std::string_view text) { return text.starts_with('&') || text.starts_with("-&"); }

/// One file of the document.
class FileWriter {
 public:
  FileWriter(const SchemaSet& schemas, const Deck& nothing)
      : schemas_(schemas), nothing_(nothing) {}

  DeckFile write(const Json& file, const Path& path) {
    DeckFile out;
    out.path = string_of(member(file, "path", path), {&path, "path"});
    check_path(out.path, {&path, "path"});
    if (const Json* e = optional_member(file, "encoding", path)) {
      const std::string& name = string_of(*e, {&path, "encoding"});
      if (name != "utf-8" && name != "latin-1")
        fail({&path, "encoding"}, "expected \"utf-8\" or \"latin-1\"");
      latin1_ = name == "latin-1";
    }
    std::string line_end = "\n";
    if (const Json* e = optional_member(file, "line_end", path)) {
      line_end = string_of(*e, {&path, "line_end"});
      if (line_end != "\n" && line_end != "\r\n")
        fail({&path, "line_end"}, "expected \"\\n\" or \"\\r\\n\"");
    }
    bool final_newline = true;
    if (const Json* f = optional_member(file, "final_newline", path))
      final_newline = bool_of(*f, {&path, "final_newline"});
    const Path items{&path, "items"};
    const Json& list = array_of(member(file, "items", path), items);
    for (std::size_t i = 0; i < list.size(); ++i) item(list[i], {&items, {}, i});
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      out.text += lines_[i];
      if (i + 1 < lines_.size() || final_newline) out.text += line_end;
    }
    return out;
  }

 private:
  static void check_path(const std::string& text, const Path& path) {
    const std::filesystem::path p(text);
    const bool climbs = std::find(p.begin(), p.end(), std::filesystem::path("..")) != p.end();
    if (text.empty() || !p.has_filename() || p.filename() == "." ||
        text.find('\0') != std::string::npos)
      fail(path, "expected the name of a file");
    if (p.is_absolute() || climbs)
      fail(path, "the file would not be written under the output directory");
  }

  /// Bytes that a JSON text stands for in this file.
  std::string bytes_of(const Json& json, const Path& path) const {
    const std::string& text = string_of(json, path);
    if (text.find('\n') != std::string::npos) fail(path, "a line cannot hold a line feed");
    if (!latin1_) return text;
    auto bytes = detail::utf8_to_latin1(text);
    if (!bytes) fail(path, "a character that Latin-1, the encoding of this file, does not have");
    return std::move(*bytes);
  }

  void item(const Json& json, const Path& path) {
    const std::string& kind = string_of(member(json, "kind", path), {&path, "kind"});
    if (kind == "text" || kind == "include") {
      const Path lines{&path, "lines"};
      const Json& list = array_of(member(json, "lines", path), lines);
      for (std::size_t i = 0; i < list.size(); ++i)
        lines_.push_back(bytes_of(list[i], {&lines, {}, i}));
    } else if (kind == "block" || kind == "continued") {
      block(json, path, kind == "block");
    } else {
      fail({&path, "kind"}, "expected \"text\", \"include\", \"block\" or \"continued\"");
    }
  }

  // ---- blocks -------------------------------------------------------------------------------

  void block(const Json& json, const Path& path, bool with_header) {
    Block block;
    const Path version{&path, "version"};
    if (const Json* v = optional_member(json, "version", path)) {
      const std::int64_t n = integer_of(*v, version);
      if (n < 0 || n > 99999 || !is_known_version(static_cast<int>(n)))
        fail(version, "no input version");
      block.version = static_cast<int>(n);
    }
    if (with_header) {
      lines_.push_back(header_of(json, path, block.version));
      const std::string_view line = lines_.back();
      block.schema = schemas_.match(trim_right(detail::without_comment(line, block.version)));
    } else {
      block.schema = schemas_.find(string_of(member(json, "keyword", path), {&path, "keyword"}));
    }
    const Path lines{&path, "lines"};
    if (const Json* list = optional_member(json, "lines", path))
      for (std::size_t i = 0; i < array_of(*list, lines).size(); ++i) {
        const Json& line = (*list)[i];
        const Path place{&lines, {}, i};
        lines_.push_back(line.is_string() ? bytes_of(line, place) : card_line(block, line, place));
      }
    const Path rows{&path, "rows"};
    if (const Json* list = optional_member(json, "rows", path)) {
      const CardSchema* card =
          block.schema ? detail::list_card(*block.schema, block.version) : nullptr;
      if (card == nullptr) fail(rows, "this keyword is no list of equal lines");
      for (std::size_t i = 0; i < array_of(*list, rows).size(); ++i) {
        const Json& row = (*list)[i];
        const Path place{&rows, {}, i};
        lines_.push_back(row.is_string() ? bytes_of(row, place)
                                         : list_row(block, *card, row, place));
      }
    }
  }

  /// The keyword line: `header` if given, with another `id` if that was changed.
  std::string header_of(const Json& json, const Path& path, int version) const {
    const Json* header = optional_member(json, "header", path);
    const Json* id = optional_member(json, "id", path);
    const Path id_path{&path, "id"};
    if (header == nullptr) {
      std::string text = bytes_of(member(json, "keyword", path), {&path, "keyword"});
      if (!text.starts_with('/')) fail({&path, "keyword"}, "a keyword starts with '/'");
      if (id != nullptr) text += fmt::format("/{}", integer_of(*id, id_path));
      return text;
    }
    std::string text = bytes_of(*header, {&path, "header"});
    if (!detail::trim(text).starts_with('/'))
      fail({&path, "header"}, "a keyword line starts with '/'");
    if (id == nullptr) return text;
    Block block;
    const std::size_t slash = text.find('/');
    block.header = trim_right(detail::without_comment(text, version).substr(slash));
    block.header_span = {0, static_cast<std::uint32_t>(block.header.size()), slash};
    detail::parse_header(schemas_, block);
    const std::int64_t wanted = integer_of(*id, id_path);
    if (!block.id.present) fail(id_path, "the keyword line has no id; write it there");
    if (block.id.value == wanted || text[block.id.span.offset] == '&') return text;
    return text.replace(block.id.span.offset, block.id.span.length, std::to_string(wanted));
  }

  /// Card of that name that has all these fields.
  static const CardSchema& card_named(const Block& block, const std::string& name,
                                      const Json* fields, const Path& path) {
    bool exists = false;
    std::string missing;
    if (block.schema != nullptr)
      for (const CardSchema& card : block.schema->cards) {
        if (!card.in_version(block.version) || card.name != name) continue;
        exists = true;
        missing.clear();
        if (fields != nullptr)
          for (const auto& f : fields->items())
            if (std::none_of(card.fields.begin(), card.fields.end(), [&](const Field& have) {
                  return have.name == f.key() && have.in_version(block.version);
                }))
              missing = f.key();
        if (missing.empty()) return card;
      }
    if (exists)
      fail(path,
           fmt::format("\"{}\" has no field \"{}\" in version {}", name, missing, block.version));
    fail(path, fmt::format("this keyword has no card \"{}\" in version {}", name, block.version));
  }

  std::string card_line(const Block& block, const Json& json, const Path& path) const {
    const Json* text = optional_member(json, "text", path);
    std::string line = text != nullptr ? bytes_of(*text, {&path, "text"}) : std::string();
    if (const Json* title = optional_member(json, "title", path))
      return title_line(std::move(line), bytes_of(*title, {&path, "title"}), {&path, "title"});
    const std::string& name = string_of(member(json, "card", path), {&path, "card"});
    const Json* fields = optional_member(json, "fields", path);
    const Path fields_path{&path, "fields"};
    if (fields != nullptr && !fields->is_object())
      fail(fields_path, std::string("expected an object, found ") + fields->type_name());
    const CardSchema& card = card_named(block, name, fields, fields_path);
    if (fields == nullptr) return line;
    const DecodedCard old = decoded(block, card, line);
    LineMaker maker{line, old.free_format};
    for (const auto& f : fields->items()) {
      const Path place{&fields_path, f.key()};
      if (card.repeat == Repeat::ids && f.key() == card.fields.back().name) {
        change_ids(card, old, array_of(f.value(), place), 0, place, maker);
        continue;
      }
      for (const Cell& cell : old.cells) {
        if (cell.field->name != f.key()) continue;
        // The other blocks of the document have the columns of the old version.
        if (text != nullptr && block.schema->keyword == "/BEGIN" && cell.field->name == "Invers" &&
            !same(cell, f.value(), place))
          fail(place, "the version is not changed here; convert the deck with --version");
        change(cell, f.value(), place, maker);
      }
    }
    return maker.finish();
  }

  static std::string title_line(std::string line, const std::string& title, const Path& path) {
    if (trim_right(trim_right(line).substr(0, detail::title_columns)) == title) return line;
    if (title.size() > detail::title_columns) fail(path, "longer than 100 columns");
    const std::string_view start = detail::trim(title);
    if (title.starts_with('#') || title.starts_with('$') || start.starts_with('/'))
      fail(path, "would be read as a comment or as a keyword");
    return title;
  }

  std::string list_row(const Block& block, const CardSchema& card, const Json& row,
                       const Path& path) const {
    if (array_of(row, path).empty()) fail(path, "a row starts with its text, or null");
    std::string line = row[0].is_null() ? std::string() : bytes_of(row[0], {&path, {}, 0});
    if (row.size() == 1) return line;
    const DecodedCard old = decoded(block, card, line);
    LineMaker maker{line, old.free_format};
    const bool ids = card.repeat == Repeat::ids;
    const std::size_t leads = ids ? card.fields.size() - 1 : old.cells.size();
    if (!ids && row.size() - 1 > leads)
      fail(path, fmt::format("{} values, but a line has {} cells", row.size() - 1, leads));
    for (std::size_t i = 0; i < std::min(leads, row.size() - 1); ++i)
      change(old.cells[i], row[i + 1], {&path, {}, i + 1}, maker);
    if (ids && row.size() - 1 >= leads) change_ids(card, old, row, leads + 1, path, maker);
    return maker.finish();
  }

  // ---- cells --------------------------------------------------------------------------------

  /// The line under change. In free format the cells are replaced where they stand.
  struct LineMaker {
    std::string text;
    bool free_format = false;
    std::vector<std::pair<Span, std::string>> replaced = {};
    std::string finish() {
      std::sort(replaced.begin(), replaced.end(),
                [](const auto& a, const auto& b) { return a.first.offset > b.first.offset; });
      for (const auto& [span, fresh] : replaced) text.replace(span.offset, span.length, fresh);
      return std::move(text);
    }
  };

  DecodedCard decoded(const Block& block, const CardSchema& card, const std::string& line) const {
    return decode_line(nothing_, block, card, Line{trim_right(line), 0, 0}, nullptr);
  }

  /// True if the JSON value is what the cell holds.
  bool same(const Cell& cell, const Json& json, const Path& path) const {
    switch (detail::kind_of(cell)) {
      case CellKind::null:
        return json.is_null();
      case CellKind::integer:
        return json.is_number_integer() && integer_of(json, path) == cell.integer;
      case CellKind::real:
        return json.is_number() && json.get<double>() == cell.real;
      case CellKind::text:
        return json.is_string() && bytes_of(json, path) == cell.text;
    }
    return false;
  }

  void change(const Cell& cell, const Json& json, const Path& path, LineMaker& line) const {
    if (same(cell, json, path)) return;
    const Field& field = *cell.field;
    const int width = line.free_format ? 20 : field.last - field.first + 1;
    std::string fresh = format(field, json, width, path);
    if (!line.free_format) {
      if (field.type == FieldType::text && !fresh.empty())
        fresh.resize(static_cast<std::size_t>(width), ' ');
      detail::put_cell(line.text, field.first, field.last, fresh);
      return;
    }
    if (fresh.find_first_of(", ") != std::string::npos)
      fail(path, "a cell of a line with commas cannot hold a comma or a blank");
    if (cell.span.offset + cell.span.length >= line.text.size() && cell.span.length == 0)
      fail(path, "the line with commas ends before this cell; add it to the text");
    line.replaced.emplace_back(cell.span, std::move(fresh));
  }

  /// The ids row[first...] against those of the line: the same number is changed in place, another
  /// number makes a new list.
  void change_ids(const CardSchema& card, const DecodedCard& old, const Json& row,
                  std::size_t first, const Path& path, LineMaker& line) const {
    const Field& field = card.fields.back();
    std::vector<const Cell*> have;
    for (const Cell& cell : old.cells)
      if (cell.field == &field) have.push_back(&cell);
    // A list with a count ends before the line does: its cells behind it are blank.
    while (have.size() > row.size() - first && have.back()->status == NumberStatus::blank)
      have.pop_back();
    bool equal = have.size() == row.size() - first;
    for (std::size_t i = 0; equal && i < have.size(); ++i)
      equal = same(*have[i], row[first + i], {&path, {}, first + i});
    if (equal) return;
    const int width = field.last - field.first + 1;
    const auto start = static_cast<std::size_t>(field.first - 1);
    if (line.free_format) fail(path, "ids of a line with commas cannot be changed; edit its text");
    if (line.text.size() > start) line.text.resize(start);
    int column = field.first;
    for (std::size_t i = first; i < row.size(); ++i, column += width) {
      if (column + width - 1 > static_cast<int>(detail::title_columns))
        fail({&path, {}, i}, "more ids than the line has cells");
      detail::put_cell(line.text, column, column + width - 1,
                       format(field, row[i], width, {&path, {}, i}));
    }
  }

  std::string format(const Field& field, const Json& json, int width, const Path& path) const {
    if (json.is_null()) return {};
    std::string text;
    if (field.type == FieldType::text) {
      text = bytes_of(json, path);
    } else if (json.is_string()) {
      text = bytes_of(json, path);
      if (!is_reference(text) || field.type == FieldType::flag)
        fail(path, "expected a number or a parameter reference (&name)");
    } else if (field.type == FieldType::real) {
      if (!json.is_number())
        fail(path, std::string("expected a number, found ") + json.type_name());
      const auto real = format_real(json.get<double>(), width);
      if (!real || !real->exact)
        fail(path, fmt::format("the number does not fit {} columns without rounding", width));
      text = real->text;
    } else {
      const std::int64_t n = integer_of(json, path);
      if (n > std::numeric_limits<std::int32_t>::max() ||
          n < std::numeric_limits<std::int32_t>::min())
        fail(path, "the solver holds integers in 32 bits");
      text = std::to_string(n);
    }
    if (text.size() > static_cast<std::size_t>(width))
      fail(path, fmt::format("does not fit {} columns", width));
    return text;
  }

  const SchemaSet& schemas_;
  const Deck& nothing_;  ///< lines are decoded without the deck's parameters
  bool latin1_ = false;
  std::vector<std::string> lines_;
};

std::vector<DeckFile> read_document(const Json& root, const SchemaSet& schemas) {
  const Path top;
  if (root.is_object() && root.contains("decks"))
    fail(top, "a document of several decks; give one of them");
  const Path schema{&top, "schema"};
  const Json& head = member(root, "schema", top);
  if (string_of(member(head, "id", schema), {&schema, "id"}) != detail::deck_json_id)
    fail({&schema, "id"}, fmt::format("expected \"{}\"", detail::deck_json_id));
  if (integer_of(member(head, "version", schema), {&schema, "version"}) !=
      detail::deck_json_version)
    fail({&schema, "version"}, fmt::format("expected {}", detail::deck_json_version));
  const Path files{&top, "files"};
  const Json& list = array_of(member(root, "files", top), files);
  const Deck nothing;
  std::vector<DeckFile> out;
  std::set<std::string> names;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Path path{&files, {}, i};
    const Json* external = optional_member(list[i], "external", path);
    if (external != nullptr && bool_of(*external, {&path, "external"})) continue;
    out.push_back(FileWriter(schemas, nothing).write(list[i], path));
    const std::filesystem::path name(out.back().path);
    if (!names.insert(name.lexically_normal().string()).second)
      fail({&path, "path"}, "a second file of that name");
  }
  if (out.empty()) fail(files, "no file with content");
  return out;
}

/// Line and column of a byte, 1-based.
std::string place_of(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, byte == 0 ? 0 : byte - 1);
  const auto lines = std::count(before.begin(), before.end(), '\n');
  const auto nl = before.rfind('\n');
  const std::size_t column = nl == std::string_view::npos ? before.size() : before.size() - nl - 1;
  return fmt::format("line {}, column {}", lines + 1, column + 1);
}

}  // namespace

Result<std::vector<DeckFile>> deck_from_json(std::string_view json, const SchemaSet& schemas) {
  try {
    return read_document(Json::parse(json), schemas);
  } catch (const nlohmann::json::parse_error& e) {
    return Error{Error::Code::syntax,
                 fmt::format("{}: no JSON: {}", place_of(json, e.byte), e.what())};
  } catch (const Wrong& wrong) {
    return Error{Error::Code::syntax, wrong.what};
  } catch (const nlohmann::json::exception& e) {
    return Error{Error::Code::syntax, e.what()};
  }
}

}  // namespace deck
