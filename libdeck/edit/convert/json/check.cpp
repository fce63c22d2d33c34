// Reads the written files as a deck and walks through them beside the document.
#include "edit/convert/json/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <unordered_map>

#include "base/shared/paths.hpp"
#include "deck/contact/resolve.hpp"
#include "deck/keyword/decode.hpp"
#include "deck/model/interfaces.hpp"
#include "deck/model/model.hpp"
#include "edit/convert/json/file_writer.hpp"
#include "keyword/shared/deck_json_cells.hpp"
#include "keyword/shared/reader.hpp"

namespace deck::detail {
namespace {

std::string quoted_names(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("\"{}\"", fmt::join(names, "\", \""));
}

class Checker {
 public:
  Checker(const Json& root, const std::vector<DeckFile>& files, const SchemaSet& schemas,
          bool round)
      : root_(root), schemas_(schemas), round_(round), loaded_(loaded(files)) {}

  void run() {
    collect();
    const Path files{&top_, "files"};
    for (std::size_t i = 0; i < root_["files"].size(); ++i) {
      const Path path{&files, {}, i};
      if (!is_external(root_["files"][i], path)) file(root_["files"][i], path);
    }
    head();
  }

 private:
  LoadedDeck loaded(const std::vector<DeckFile>& files) const {
    std::map<std::string, std::string> contents;
    for (const DeckFile& f : files) contents[f.path] = f.text;
    LoadOptions options;
    options.read.overlay = &contents;
    options.schemas = &schemas_;
    auto read = load(files.front().path, options);
    if (!read) fail(top_, read.error().message);
    return std::move(*read);
  }

  struct Stretch {
    std::uint64_t begin = 0, end = 0;
    std::size_t block = 0;
  };

  /// Where blocks begin, and which block every stretch of a file belongs to.
  void collect() {
    headers_.resize(deck_.sources.size());
    stretches_.resize(deck_.sources.size());
    for (std::uint32_t f = 0; f < deck_.sources.size(); ++f)
      source_of_.emplace(normal_path(deck_.sources[f].path()), f);
    for (std::size_t b = 0; b < deck_.blocks.size(); ++b) {
      const Block& block = deck_.blocks[b];
      const Source& source = deck_.sources[block.header_span.file];
      headers_[block.header_span.file].emplace(
          static_cast<std::uint64_t>(source.line_at(block.header_span.offset).data() -
                                     source.bytes().data()),
          b);
      for (const Piece& p : block.body) stretches_[p.file].push_back({p.begin, p.end, b});
    }
    for (auto& list : stretches_)
      std::sort(list.begin(), list.end(),
                [](const Stretch& a, const Stretch& b) { return a.begin < b.begin; });
  }

  // ---- files --------------------------------------------------------------------------------

  void file(const Json& json, const Path& path) {
    const auto it = source_of_.find(normal_path(json["path"].get<std::string>()));
    if (it == source_of_.end()) fail({&path, "path"}, "no #include of the deck leads to this file");
    source_ = it->second;
    latin1_ = is_latin1(json, path);
    at_ = 0;
    const Path items{&path, "items"};
    for (std::size_t i = 0; i < json["items"].size(); ++i) item(json["items"][i], {&items, {}, i});
  }

  std::string_view bytes() const { return deck_.sources[source_].bytes(); }

  /// Offset of the next line of the file.
  std::uint64_t next_line() {
    const std::uint64_t line = at_;
    at_ = std::min<std::uint64_t>(bytes().find('\n', at_), bytes().size());
    if (at_ < bytes().size()) ++at_;
    return line;
  }

  void item(const Json& json, const Path& path) {
    const std::string& kind = json["kind"].get_ref<const std::string&>();
    if (kind == "block" || kind == "continued") {
      block(json, path, kind == "block");
      return;
    }
    const std::uint64_t begin = at_;
    for (std::size_t i = 0; i < json["lines"].size(); ++i) next_line();
    if (const Json* target = optional_member(json, "file", path))
      include(string_of(*target, {&path, "file"}), begin, {&path, "file"});
  }

  void include(const std::string& target, std::uint64_t begin, const Path& path) const {
    for (const IncludeEdge& e : deck_.includes) {
      if (e.parent != source_ || e.directive.offset < begin || e.directive.offset >= at_) continue;
      const std::string& found = deck_.sources[e.file].path();
      if (normal_path(found) != normal_path(target))
        fail(path, fmt::format("\"{}\", but the line includes \"{}\"", target, found));
      return;
    }
    // What stands outside of the document need not be on this computer.
    if (!std::filesystem::path(target).is_absolute())
      fail(path, fmt::format("\"{}\", but the line does not include it", target));
  }

  // ---- blocks -------------------------------------------------------------------------------

  void block(const Json& json, const Path& path, bool header) {
    const Block* found = header ? opened_by(next_line()) : open_at(at_);
    if (found == nullptr && header)
      fail({&path, "keyword"},
           "the deck does not read this as a keyword: it stands behind its end");
    if (found != nullptr) {
      keyword(*found, json, path);
      if (header) ids(*found, json, path);
      if (const Json* version = optional_member(json, "version", path))
        if (integer_of(*version, {&path, "version"}) != found->version)
          fail({&path, "version"},
               fmt::format("{}, but by the /BEGIN above it the deck is read as version {}",
                           shown(*version), found->version));
    }
    lines(found, json, path);
    if (found == nullptr) return;
    if (header) missing(*found, json, path);
    rows(*found, json, path);
    if (header) effective(*found, json, path);
  }

  const Block* opened_by(std::uint64_t line) const {
    const auto it = headers_[source_].find(line);
    return it == headers_[source_].end() ? nullptr : &deck_.blocks[it->second];
  }

  const Block* open_at(std::uint64_t line) const {
    const auto& list = stretches_[source_];
    auto it = std::upper_bound(list.begin(), list.end(), line,
                               [](std::uint64_t l, const Stretch& s) { return l < s.begin; });
    if (it == list.begin() || line >= (--it)->end) return nullptr;
    return &deck_.blocks[it->block];
  }

  std::string name_of(const Block& block) const {
    const std::string_view name =
        block.schema != nullptr ? std::string_view(block.schema->keyword) : block.keyword;
    return latin1_ ? latin1_to_utf8(name) : std::string(name);
  }

  void keyword(const Block& block, const Json& json, const Path& path) const {
    const std::string& stated = json["keyword"].get_ref<const std::string&>();
    if (stated == name_of(block)) return;
    const bool made_of_it =
        optional_member(json, "header", path) == nullptr && json["kind"] == "block";
    if (made_of_it && block.schema == schemas_.match(stated)) return;
    fail({&path, "keyword"},
         fmt::format("\"{}\", but the keyword line reads as {}; change \"header\", or take it out",
                     stated, name_of(block)));
  }

  static void ids(const Block& block, const Json& json, const Path& path) {
    const auto same = [&](const char* name, const HeaderId& id) {
      const Json* stated = optional_member(json, name, path);
      if (stated == nullptr || (id.present && integer_of(*stated, {&path, name}) == id.value))
        return;
      fail({&path, name}, fmt::format("{}, but the keyword line says {}", shown(*stated),
                                      id.present ? std::to_string(id.value) : "nothing"));
    };
    same("id", block.id);
    same("unit_id", block.unit_id);
  }

  // ---- lines --------------------------------------------------------------------------------

  void lines(const Block* block, const Json& json, const Path& path) {
    const Json* list = optional_member(json, "lines", path);
    if (list == nullptr) return;
    const Path lines{&path, "lines"};
    for (std::size_t i = 0; i < list->size(); ++i) {
      const Path place{&lines, {}, i};
      const std::uint64_t line = next_line();
      no_header(line, place);
      if (!(*list)[i].is_object()) continue;
      if (block == nullptr) fail(place, "the deck does not read this line");
      if ((*list)[i].contains("title"))
        title(*block, line, place);
      else
        card(*block, (*list)[i], line, place);
    }
  }

  void no_header(std::uint64_t line, const Path& path) const {
    if (opened_by(line) != nullptr)
      fail(path, "the line is a keyword; write it as an item of its own");
  }

  void title(const Block& block, std::uint64_t line, const Path& path) const {
    const Path place{&path, "title"};
    if (block.schema == nullptr || !block.schema->has_title)
      fail(place, "this keyword has no title");
    const Line found = LineCursor(deck_.sources, block).next();
    if (found.file != source_ || found.offset != line)
      fail(place, "the title is the first line that is no comment; this is another one");
  }

  const DecodedBlock& decoded(const Block& block) {
    if (decoded_.block != &block) decoded_ = decode(deck_, block);
    return decoded_;
  }

  void card(const Block& block, const Json& json, std::uint64_t line, const Path& path) {
    const DecodedBlock& all = decoded(block);
    const std::string& stated = json["card"].get_ref<const std::string&>();
    const auto here = std::find_if(all.cards.begin(), all.cards.end(), [&](const DecodedCard& c) {
      return !c.missing() && c.line.file == source_ && c.line.offset == line;
    });
    if (here == all.cards.end() || here->schema->name != stated) {
      std::vector<std::string> order;
      for (const DecodedCard& c : all.cards)
        if (order.size() < 20 && (order.empty() || order.back() != c.schema->name))
          order.push_back(c.schema->name);
      fail({&path, "card"},
           fmt::format(
               "\"{}\", but by its place the line is {}; the cards of this block are, in "
               "this order: {}",
               stated,
               here == all.cards.end() ? "none of its cards" : "\"" + here->schema->name + "\"",
               quoted_names(order)));
    }
    if (const Json* stated_fields = optional_member(json, "fields", path))
      fields(*here, *stated_fields, {&path, "fields"});
    if (const Json* columns = optional_member(json, "columns", path))
      columns_of(*here, json, *columns, {&path, "columns"});
  }

  static const Cell* cell_named(const DecodedCard& card, const std::string& name) {
    for (const Cell& cell : card.cells)
      if (cell.field->name == name) return &cell;
    return nullptr;
  }

  std::string text_of(std::string_view text) const {
    return latin1_ ? latin1_to_utf8(text) : std::string(text);
  }

  void fields(const DecodedCard& card, const Json& json, const Path& path) const {
    const Field* ids = card.schema->repeat == Repeat::ids ? &card.schema->fields.back() : nullptr;
    for (const auto& f : json.items()) {
      const Path place{&path, f.key()};
      if (ids != nullptr && f.key() == ids->name) {
        list(card, *ids, f.value(), place);
        continue;
      }
      const Cell* cell = cell_named(card, f.key());
      if (cell == nullptr && f.value().is_null()) continue;
      if (cell == nullptr) fail(place, "with the flags of this block the line has no such cell");
      if (!same_value(*cell, f.value(), latin1_, place) &&
          !(round_ && rounded(card, *cell, f.value())))
        fail(place, fmt::format("{}, but the line holds {}", shown(f.value()),
                                cell->blank() ? "nothing" : text_of(cell->text)));
    }
    for (const Cell& cell : card.cells)
      if (!cell.blank() && !json.contains(cell.field->name))
        fail({&path, cell.field->name},
             fmt::format("missing, but the line holds {}; write null to blank it",
                         text_of(cell.text)));
  }

  /// True if the cell holds as much of the number as fits.
  static bool rounded(const DecodedCard& card, const Cell& cell, const Json& json) {
    if (!json.is_number() || kind_of(cell) != CellKind::real) return false;
    const int width = card.free_format ? free_cell_width : cell.field->last - cell.field->first + 1;
    const auto text = format_real(json.get<double>(), width);
    return text && read_real(text->text).value == cell.real;
  }

  void list(const DecodedCard& card, const Field& ids, const Json& json, const Path& path) const {
    std::vector<const Cell*> have;
    for (const Cell& cell : card.cells)
      if (cell.field == &ids) have.push_back(&cell);
    while (have.size() > json.size() && have.back()->blank()) have.pop_back();
    bool equal = have.size() == json.size();
    for (std::size_t i = 0; equal && i < have.size(); ++i)
      equal = same_value(*have[i], json[i], latin1_, path);
    if (!equal)
      fail(path,
           fmt::format("{} values, but the line is read with {} others", json.size(), have.size()));
  }

  void columns_of(const DecodedCard& card, const Json& json, const Json& columns,
                  const Path& path) const {
    if (!columns.is_object()) fail(path, "expected an object");
    // In free format every value that changes moves the cells behind it.
    const Json* text = optional_member(json, "text", path);
    const std::string_view now = trim_right(card.line.text);
    if (card.free_format && (text == nullptr || trim_right(bytes_of(*text, latin1_, path)) != now))
      return;
    for (const auto& c : columns.items()) {
      const Path place{&path, c.key()};
      const Cell* cell = cell_named(card, c.key());
      if (cell == nullptr) fail(place, "the line has no such cell");
      const auto begin = static_cast<std::int64_t>(cell->span.offset - card.line.offset);
      const std::int64_t first = card.free_format ? begin + 1 : cell->field->first;
      const std::int64_t last = card.free_format ? begin + cell->span.length : cell->field->last;
      if (c.value() != Json::array({first, last}))
        fail(place, fmt::format("{}, but the cell has the columns {} to {}", shown(c.value()),
                                first, last));
    }
  }

  static bool is_list(const Block& block) {
    return block.schema != nullptr && !block.opaque &&
           list_card(*block.schema, block.version) != nullptr;
  }

  /// Cards that the block ends without: the document has to say so.
  void missing(const Block& block, const Json& json, const Path& path) {
    const Path place{&path, "missing"};
    std::vector<std::string> stated, found;
    if (const Json* list = optional_member(json, "missing", path))
      for (const Json& name : array_of(*list, place)) stated.push_back(string_of(name, place));
    if (block.schema != nullptr && !is_list(block))
      for (const CardSchema* card : missing_cards(deck_, block)) found.push_back(card->name);
    if (stated == found) return;
    if (stated.empty())
      fail({&path, "lines"},
           fmt::format(
               "the cards {} are missing; add them (\"fields\" may be empty), or say so with "
               "\"missing\"",
               quoted_names(found)));
    fail(place, fmt::format("{}, but the cards that the block ends without are: {}",
                            quoted_names(stated), quoted_names(found)));
  }

  void rows(const Block& block, const Json& json, const Path& path) {
    const CardSchema* list = is_list(block) ? list_card(*block.schema, block.version) : nullptr;
    if (const Json* name = optional_member(json, "card", path))
      if (list == nullptr || string_of(*name, {&path, "card"}) != list->name)
        fail({&path, "card"}, fmt::format("{}, but the card of the rows is {}", shown(*name),
                                          list == nullptr ? "none" : "\"" + list->name + "\""));
    if (const Json* names = optional_member(json, "fields", path)) {
      std::vector<std::string> known;
      if (list != nullptr)
        for (const Field& f : list->fields)
          if (f.in_version(block.version)) known.push_back(f.name);
      if (*names != Json(known))
        fail({&path, "fields"}, "the values of a row are " + quoted_names(known));
    }
    const Path rows{&path, "rows"};
    if (const Json* all = optional_member(json, "rows", path))
      for (std::size_t i = 0; i < all->size(); ++i) no_header(next_line(), {&rows, {}, i});
  }

  // ---- what follows from the cards ------------------------------------------------------------

  const InterBase* interface_of(const Block& block) {
    for (const InterBase* i : loaded_.interfaces().all)
      if (i->block == &block) return i;
    return nullptr;
  }

  /// `effective` may be what it was when the document was written, or what it is now.
  void effective(const Block& block, const Json& json, const Path& path) {
    const Json* stated = optional_member(json, "effective", path);
    if (stated == nullptr) return;
    if (untouched_value(json, "effective", "effective_sum", path)) return;
    const Path place{&path, "effective"};
    const InterBase* inter = interface_of(block);
    if (inter == nullptr || !stated->is_object())
      fail(place, "this block is no interface with effective values; take the member out");
    visit_any_interface(*inter, [&](const auto& t) {
      std::vector<std::string> known;
      t.for_each([&](std::string_view name, const auto& e) {
        known.emplace_back(name);
        if (const Json* one = optional_member(*stated, known.back().c_str(), place))
          same_effective(e, *one, {&place, known.back()});
      });
      for (const auto& one : stated->items())
        if (std::find(known.begin(), known.end(), one.key()) == known.end())
          fail({&place, one.key()}, "the interface has no such parameter");
    });
  }

  template <class E>
  void same_effective(const E& e, const Json& json, const Path& path) const {
    const auto is = [&](const auto& value, const Json& stated) {
      using T = std::decay_t<decltype(value)>;
      if constexpr (std::is_same_v<T, std::string>)
        return stated.is_string() && stated.template get<std::string>() == text_of(value);
      else
        return stated.is_number() && stated.template get<double>() == static_cast<double>(value);
    };
    only(json, {"input", "value", "origin", "source"}, path);
    const auto refuse = [&](const char* name, const Json& stated) {
      fail(path,
           fmt::format("\"{}\" says {}, which the cards do not give: an effective value follows "
                       "from them. Change the card, or take \"effective\" out",
                       name, shown(stated)));
    };
    const Json& value = member(json, "value", path);
    if (!is(e.value, value) && !(value.is_null() && e.origin == Origin::geometry))
      refuse("value", value);
    const Json& input = member(json, "input", path);
    if (e.has_input ? !is(e.input, input) : !input.is_null()) refuse("input", input);
    const Json& origin = member(json, "origin", path);
    if (origin != Json(to_string(e.origin))) refuse("origin", origin);
  }

  static bool untouched_value(const Json& json, const char* name, const char* sum,
                              const Path& path) {
    const Json* stated = optional_member(json, sum, path);
    return stated != nullptr && string_of(*stated, {&path, sum}) == sum_of_json(json[name].dump());
  }

  /// `deck` tells readers what they have; it changes nothing.
  void head() const {
    const Json* stated = optional_member(root_, "deck", top_);
    if (stated == nullptr || untouched_value(root_, "deck", "deck_sum", top_)) return;
    const Path path{&top_, "deck"};
    only(*stated, {"path", "title", "version", "units", "counts", "includes"}, path);
    if (const Json* version = optional_member(*stated, "version", path))
      if (*version != Json(deck_.version))
        fail({&path, "version"},
             fmt::format("{}, but /BEGIN says {}; convert the deck with --version", shown(*version),
                         deck_.version));
    if (const Json* title = optional_member(*stated, "title", path)) {
      const std::string& now = deck_.begin.run_name;
      if (*title != Json(is_utf8(now) ? now : latin1_to_utf8(now)))
        fail({&path, "title"},
             shown(*title) + ", but /BEGIN says '" + now + "'; change the run name there");
    }
    // Without the sum of the deck, its path and counts cannot be compared.
    if (optional_member(root_, "deck_sum", top_) == nullptr) return;
    fail(path,
         "was changed, and only tells what the deck was: change its cards, or take the member out");
  }

  const Json& root_;
  const SchemaSet& schemas_;
  const bool round_;
  const Path top_{};
  const LoadedDeck loaded_;
  const Deck& deck_ = loaded_.deck();
  DecodedBlock decoded_;
  std::vector<std::unordered_map<std::uint64_t, std::size_t>> headers_;  ///< by start of the line
  std::vector<std::vector<Stretch>> stretches_;
  std::map<std::string, std::uint32_t> source_of_;
  // The file that is walked through.
  std::uint32_t source_ = 0;
  bool latin1_ = false;
  std::uint64_t at_ = 0;
};

}  // namespace

void check_document(const Json& root, const std::vector<DeckFile>& files, const SchemaSet& schemas,
                    bool round) {
  Checker(root, files, schemas, round).run();
}

}  // namespace deck::detail
