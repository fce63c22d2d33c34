// Makes the lines of a file: every line on its own, from its text and from the values that differ
// from what the text says.
#include "edit/convert/json/file_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "edit/convert/version_cards.hpp"
#include "keyword/shared/deck_json_cells.hpp"
#include "keyword/shared/header_line.hpp"
#include "keyword/shared/reader.hpp"

namespace deck::detail {
namespace {

bool is_reference(std::string_view text) { return text.starts_with('&') || text.starts_with("-&"); }

constexpr const char* take_one_out =
    "; the text was changed by hand, and the two do not agree: make them agree, or remove one of "
    "them";

/// One file of the document.
class FileWriter {
 public:
  FileWriter(const SchemaSet& schemas, const FromJsonOptions& options,
             std::vector<LossEntry>& losses)
      : schemas_(schemas), options_(options), losses_(losses) {}

  DeckFile write(const Json& file, const Path& path) {
    only(file, {"path", "encoding", "line_end", "final_newline", "items", "external"}, path);
    DeckFile out;
    out.path = string_of(member(file, "path", path), {&path, "path"});
    check_path(out.path, {&path, "path"});
    file_ = out.path;
    latin1_ = is_latin1(file, path);
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

  std::string bytes(const Json& json, const Path& path) const {
    return bytes_of(json, latin1_, path);
  }

  void item(const Json& json, const Path& path) {
    const std::string& kind = string_of(member(json, "kind", path), {&path, "kind"});
    if (kind == "text" || kind == "include") {
      if (kind == "text")
        only(json, {"kind", "line", "lines"}, path);
      else
        only(json, {"kind", "line", "file", "lines"}, path);
      const Path lines{&path, "lines"};
      const Json& list = array_of(member(json, "lines", path), lines);
      for (std::size_t i = 0; i < list.size(); ++i)
        lines_.push_back(bytes(list[i], {&lines, {}, i}));
    } else if (kind == "block" || kind == "continued") {
      block(json, path, kind == "block");
    } else {
      fail({&path, "kind"}, "expected \"text\", \"include\", \"block\" or \"continued\"");
    }
  }

  // ---- blocks -------------------------------------------------------------------------------

  void block(const Json& json, const Path& path, bool with_header) {
    if (with_header)
      only(json,
           {"kind", "keyword", "id", "unit_id", "line", "column", "header", "header_sum", "version",
            "lines", "missing", "card", "fields", "rows", "rows_sum", "effective", "effective_sum"},
           path);
    else
      only(json,
           {"kind", "keyword", "line", "version", "lines", "card", "fields", "rows", "rows_sum"},
           path);
    Block block;
    const Path version{&path, "version"};
    if (const Json* v = optional_member(json, "version", path)) {
      const std::int64_t n = integer_of(*v, version);
      if (n < 0 || n > 99999 || !is_known_version(static_cast<int>(n)))
        fail(version, "no input version");
      block.version = static_cast<int>(n);
    }
    loss_ = {};
    loss_.file = file_;
    loss_.keyword = string_of(member(json, "keyword", path), {&path, "keyword"});
    if (const Json* id = optional_member(json, "id", path))
      loss_.id = integer_of(*id, {&path, "id"});
    if (with_header) {
      lines_.push_back(header_of(json, path));
      const std::string_view line = lines_.back();
      block.schema = schemas_.match(trim_right(without_comment(line)));
    } else {
      block.schema = schemas_.find(loss_.keyword);
    }
    const Path lines{&path, "lines"};
    if (const Json* list = optional_member(json, "lines", path))
      for (std::size_t i = 0; i < array_of(*list, lines).size(); ++i) {
        const Json& line = (*list)[i];
        const Path place{&lines, {}, i};
        lines_.push_back(line.is_string() ? bytes(line, place) : card_line(block, line, place));
      }
    if (const Json* list = optional_member(json, "rows", path))
      rows(block, *list, rows_untouched(json, *list, path), {&path, "rows"});
  }

  /// True if the texts of all rows are what they were when the document was written.
  static bool rows_untouched(const Json& json, const Json& list, const Path& path) {
    const Json* stated = optional_member(json, "rows_sum", path);
    if (stated == nullptr) return false;
    TextSum sum;
    for (const Json& row : array_of(list, {&path, "rows"}))
      if (row.is_array() && !row.empty() && row[0].is_string())
        sum.add(row[0].get_ref<const std::string&>());
    return string_of(*stated, {&path, "rows_sum"}) == sum.text();
  }

  void rows(const Block& block, const Json& list, bool text_untouched, const Path& path) {
    const CardSchema* card = block.schema ? list_card(*block.schema, block.version) : nullptr;
    if (card == nullptr) fail(path, "this keyword is no list of equal lines");
    for (std::size_t i = 0; i < array_of(list, path).size(); ++i) {
      const Json& row = list[i];
      const Path place{&path, {}, i};
      lines_.push_back(row.is_string() ? bytes(row, place)
                                       : list_row(block, *card, row, text_untouched, place));
    }
  }

  /// The keyword line: `header` if given, with another `id` if that was changed.
  std::string header_of(const Json& json, const Path& path) const {
    const Json* header = optional_member(json, "header", path);
    const Json* id = optional_member(json, "id", path);
    const Path id_path{&path, "id"};
    if (header == nullptr) {
      std::string text = bytes(member(json, "keyword", path), {&path, "keyword"});
      if (!text.starts_with('/')) fail({&path, "keyword"}, "a keyword starts with '/'");
      if (id != nullptr) text += fmt::format("/{}", integer_of(*id, id_path));
      return text;
    }
    std::string text = bytes(*header, {&path, "header"});
    if (!trim(text).starts_with('/')) fail({&path, "header"}, "a keyword line starts with '/'");
    if (id == nullptr) return text;
    Block block;
    const std::size_t slash = text.find('/');
    block.header = trim_right(without_comment(text).substr(slash));
    block.header_span = {0, static_cast<std::uint32_t>(block.header.size()), slash};
    parse_header(schemas_, block);
    const std::int64_t wanted = integer_of(*id, id_path);
    if (block.id.present && block.id.value != wanted &&
        !untouched(json, "header_sum", header->get_ref<const std::string&>(), path))
      fail(id_path,
           fmt::format("{}, but the header says {}{}", wanted, block.id.value, take_one_out));
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

  /// A field may have other columns with other flags, which are not known here: then the stated
  /// columns choose, and without them a cell that has the value.
  bool is_meant(const Cell& cell, const DecodedCard& card, const Json& value, const Json* columns,
                const Path& path) const {
    std::vector<const Cell*> others;
    for (const Cell& c : card.cells)
      if (c.field->name == cell.field->name &&
          (c.field->first != cell.field->first || c.field->last != cell.field->last))
        others.push_back(&c);
    if (others.empty()) return true;
    if (columns != nullptr && columns->is_object() && columns->contains(cell.field->name))
      return (*columns)[cell.field->name] == Json::array({cell.field->first, cell.field->last});
    if (same(cell, value, path)) return true;
    if (std::any_of(others.begin(), others.end(),
                    [&](const Cell* other) { return same(*other, value, path); }))
      return false;
    fail(path, "stands in other columns with other flags; state its \"columns\"");
  }

  std::string card_line(const Block& block, const Json& json, const Path& path) {
    const Json* text = optional_member(json, "text", path);
    std::string line = text != nullptr ? bytes(*text, {&path, "text"}) : std::string();
    const bool free_to_change =
        text == nullptr || untouched(json, "text_sum", text->get_ref<const std::string&>(), path);
    if (const Json* title = optional_member(json, "title", path)) {
      only(json, {"line", "title", "text", "text_sum"}, path);
      return title_line(std::move(line), bytes(*title, {&path, "title"}), free_to_change,
                        {&path, "title"});
    }
    only(json, {"line", "card", "text", "text_sum", "fields", "columns"}, path);
    const std::string& name = string_of(member(json, "card", path), {&path, "card"});
    const Json* fields = optional_member(json, "fields", path);
    const Json* columns = optional_member(json, "columns", path);
    const Path fields_path{&path, "fields"};
    if (fields != nullptr && !fields->is_object())
      fail(fields_path, std::string("expected an object, found ") + fields->type_name());
    const CardSchema& card = card_named(block, name, fields, fields_path);
    if (fields == nullptr) return line;
    const DecodedCard old = decoded(block, card, line);
    LineMaker maker{line, old.free_format, free_to_change};
    for (const auto& f : fields->items()) {
      const Path place{&fields_path, f.key()};
      if (card.repeat == Repeat::ids && f.key() == card.fields.back().name) {
        change_ids(card, old, array_of(f.value(), place), 0, place, maker);
        continue;
      }
      for (const Cell& cell : old.cells) {
        if (cell.field->name != f.key() || !is_meant(cell, old, f.value(), columns, place))
          continue;
        // The other blocks of the document have the columns of the old version.
        if (text != nullptr && block.schema->keyword == "/BEGIN" && cell.field->name == "Invers" &&
            !same(cell, f.value(), place))
          fail(place, "the version is not changed here; convert the deck with --version");
        change(cell, f.value(), place, maker);
      }
    }
    return maker.finish();
  }

  static std::string title_line(std::string line, const std::string& title, bool free_to_change,
                                const Path& path) {
    const std::string_view now = trim_right(trim_right(line).substr(0, title_columns));
    if (now == title) return line;
    if (!free_to_change)
      fail(path, fmt::format("'{}', but the text says '{}'{}", title, now, take_one_out));
    if (title.size() > title_columns) fail(path, "longer than 100 columns");
    const std::string_view start = trim(title);
    if (title.starts_with('#') || title.starts_with('$') || start.starts_with('/'))
      fail(path, "would be read as a comment or as a keyword");
    return title;
  }

  std::string list_row(const Block& block, const CardSchema& card, const Json& row,
                       bool text_untouched, const Path& path) {
    if (array_of(row, path).empty()) fail(path, "a row starts with its text, or null");
    std::string line = row[0].is_null() ? std::string() : bytes(row[0], {&path, {}, 0});
    if (row.size() == 1) return line;
    const DecodedCard old = decoded(block, card, line);
    LineMaker maker{line, old.free_format, text_untouched || row[0].is_null()};
    const bool ids = card.repeat == Repeat::ids;
    const std::size_t leads = ids ? card.fields.size() - 1 : old.cells.size();
    if (!ids && row.size() - 1 > leads)
      fail(path, fmt::format("{} values, but a line has {} cells", row.size() - 1, leads));
    for (std::size_t i = 0; i < std::min(leads, row.size() - 1); ++i)
      change(old.cells[i], row[i + 1], {&path, {}, i + 1}, maker);
    for (std::size_t i = row.size() - 1; i < old.cells.size(); ++i)
      if (!old.cells[i].blank())
        fail(path,
             fmt::format("the text says {} = {}, which is not among the values; write null to "
                         "blank it",
                         old.cells[i].field->name, old.cells[i].text));
    if (ids && row.size() - 1 >= leads) change_ids(card, old, row, leads + 1, path, maker);
    return maker.finish();
  }

  // ---- cells --------------------------------------------------------------------------------

  /// The line under change. In free format the cells are replaced where they stand.
  struct LineMaker {
    std::string text;
    bool free_format = false;
    bool free_to_change = true;  ///< its text is no other witness of its values
    std::vector<std::pair<Span, std::string>> replaced = {};
    std::string finish() {
      std::sort(replaced.begin(), replaced.end(),
                [](const auto& a, const auto& b) { return a.first.offset > b.first.offset; });
      for (const auto& [span, fresh] : replaced) text.replace(span.offset, span.length, fresh);
      return std::move(text);
    }
  };

  DecodedCard decoded(const Block& block, const CardSchema& card, const std::string& line) const {
    static const Deck nothing;  // lines are decoded without the deck's parameters
    return decode_line(nothing, block, card, Line{trim_right(line), 0, 0}, nullptr);
  }

  bool same(const Cell& cell, const Json& json, const Path& path) const {
    return same_value(cell, json, latin1_, path);
  }

  void change(const Cell& cell, const Json& json, const Path& path, LineMaker& line) {
    if (same(cell, json, path)) return;
    const Field& field = *cell.field;
    if (!line.free_to_change)
      fail(path, fmt::format("{}, but the text says {}{}", shown(json),
                             cell.blank() ? "nothing" : std::string(cell.text), take_one_out));
    const int width = line.free_format ? free_cell_width : field.last - field.first + 1;
    std::string fresh = format(field, json, width, path);
    if (!line.free_format) {
      const std::size_t had = line.text.size();
      if (field.type == FieldType::text && !fresh.empty())
        fresh.resize(static_cast<std::size_t>(width), ' ');
      CellWriter::put(line.text, field.first, field.last, fresh);
      // Text begins at the left of its columns: what fills them up makes no line longer.
      while (line.text.size() > had && line.text.back() == ' ') line.text.pop_back();
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
                  std::size_t first, const Path& path, LineMaker& line) {
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
    if (!line.free_to_change)
      fail(path, fmt::format("the text lists other values of {}{}", field.name, take_one_out));
    const int width = field.last - field.first + 1;
    const auto start = static_cast<std::size_t>(field.first - 1);
    if (line.free_format) fail(path, "ids of a line with commas cannot be changed; edit its text");
    if (line.text.size() > start) line.text.resize(start);
    int column = field.first;
    for (std::size_t i = first; i < row.size(); ++i, column += width) {
      if (column + width - 1 > static_cast<int>(title_columns))
        fail({&path, {}, i}, "more ids than the line has cells");
      CellWriter::put(line.text, column, column + width - 1,
                      format(field, row[i], width, {&path, {}, i}));
    }
  }

  std::string format(const Field& field, const Json& json, int width, const Path& path) {
    if (json.is_null()) return {};
    std::string text;
    if (field.type == FieldType::text) {
      text = bytes(json, path);
    } else if (json.is_string()) {
      text = bytes(json, path);
      if (!is_reference(text) || field.type == FieldType::flag)
        fail(path, "expected a number or a parameter reference (&name)");
    } else if (field.type == FieldType::real) {
      if (!json.is_number())
        fail(path, std::string("expected a number, found ") + json.type_name());
      const auto real = format_real(json.get<double>(), width);
      if (!real) fail(path, fmt::format("{} does not fit {} columns", shown(json), width));
      if (!real->exact && !options_.round)
        fail(path,
             fmt::format("the number does not fit {} columns without rounding: {} would become "
                         "{}; --round accepts that",
                         width, shown(json), real->text));
      if (!real->exact) rounded(field, json, real->text, width);
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

  void rounded(const Field& field, const Json& json, const std::string& text, int width) {
    LossEntry entry = loss_;
    entry.loss = Loss::approximated;
    entry.line = lines_.size() + 1;
    entry.field = field.name;
    entry.old_text = shown(json);
    entry.new_text = text;
    entry.note = fmt::format("rounded to {} columns", width);
    losses_.push_back(std::move(entry));
  }

  const SchemaSet& schemas_;
  const FromJsonOptions& options_;
  std::vector<LossEntry>& losses_;
  LossEntry loss_;  ///< file, keyword and id of the block that is written
  std::string file_;
  bool latin1_ = false;
  std::vector<std::string> lines_;
};

}  // namespace

std::string bytes_of(const Json& json, bool latin1, const Path& path) {
  const std::string& text = string_of(json, path);
  if (text.find('\n') != std::string::npos) fail(path, "a line cannot hold a line feed");
  if (!latin1) return text;
  auto bytes = utf8_to_latin1(text);
  if (!bytes) fail(path, "a character that Latin-1, the encoding of this file, does not have");
  return std::move(*bytes);
}

bool is_latin1(const Json& file, const Path& path) {
  const Json* encoding = optional_member(file, "encoding", path);
  if (encoding == nullptr) return false;
  const std::string& name = string_of(*encoding, {&path, "encoding"});
  if (name != "utf-8" && name != "latin-1")
    fail({&path, "encoding"}, "expected \"utf-8\" or \"latin-1\"");
  return name == "latin-1";
}

bool same_value(const Cell& cell, const Json& json, bool latin1, const Path& path) {
  switch (kind_of(cell)) {
    case CellKind::null:
      return json.is_null();
    case CellKind::integer:
      return json.is_number_integer() && integer_of(json, path) == cell.integer;
    case CellKind::real:
      return json.is_number() && json.get<double>() == cell.real;
    case CellKind::text:
      return json.is_string() && bytes_of(json, latin1, path) == cell.text;
  }
  return false;
}

DeckFile write_file(const Json& file, const Path& path, const SchemaSet& schemas,
                    const FromJsonOptions& options, std::vector<LossEntry>& losses) {
  return FileWriter(schemas, options, losses).write(file, path);
}

}  // namespace deck::detail
