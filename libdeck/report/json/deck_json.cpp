// Writes a deck as JSON, block by block; the loss report of a conversion.
#include "report/shared/deck_json.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <unordered_map>

#include "base/shared/paths.hpp"
#include "deck/keyword.hpp"
#include "keyword/shared/card_forms.hpp"
#include "report/shared/json.hpp"
#include "report/shared_records.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;
using detail::CellKind;

// ---- where the files go ---------------------------------------------------------------------

/// Relative place of every file, so that directives find it; empty: absolute include.
std::vector<std::string> places(const Deck& deck) {
  std::vector<fs::path> place(deck.sources.size());
  std::vector<bool> known(deck.sources.size(), false);
  const fs::path main(deck.sources[0].path());
  place[0] = main == "-" ? fs::path("deck_0000.rad") : main.filename();
  known[0] = true;
  for (const IncludeEdge& e : deck.includes) {
    const fs::path written(e.written);
    if (written.is_absolute() || !known[e.parent]) continue;
    const std::string& opened = deck.sources[e.file].path();
    const fs::path beside = fs::path(deck.sources[e.parent].path()).parent_path() / written;
    const bool from_main = normal_path(beside.native()) != opened &&
                           normal_path((main.parent_path() / written).native()) == opened;
    const fs::path base = from_main ? fs::path() : place[e.parent].parent_path();
    place[e.file] = normal_path((base / written).native());
    known[e.file] = true;
  }
  // For files above the main file: move it down into directories of its own path.
  std::ptrdiff_t up = 0;
  for (const fs::path& p : place) up = std::max(up, std::count(p.begin(), p.end(), fs::path("..")));
  fs::path prefix;
  fs::path dir = parent_path(absolute_path(main.native()));
  for (std::ptrdiff_t i = 0; i < up; ++i, dir = dir.parent_path()) {
    const fs::path name = dir.has_relative_path() ? dir.filename() : fs::path("up");
    prefix = prefix.empty() ? name : name / prefix;
  }
  std::vector<std::string> out(place.size());
  for (std::size_t f = 0; f < place.size(); ++f)
    if (known[f]) out[f] = normal_path((prefix / place[f]).native());
  return out;
}

// ---- one deck -------------------------------------------------------------------------------

/// End of the line at `at`, with line feed.
std::uint64_t behind_line(std::string_view bytes, std::uint64_t at) {
  return std::min<std::uint64_t>(bytes.find('\n', at), bytes.size() - 1) + 1;
}

/// Bytes [begin, end) of a file that belong to a block; the first range starts with its header.
struct BlockRange {
  std::uint64_t begin = 0, end = 0;
  std::size_t block = 0;
  bool header = false;
};

class DeckWriter {
 public:
  explicit DeckWriter(const DeckJsonInput& in) : in_(in), deck_(*in.deck), json_(out_) {}

  Result<std::string> run() {
    places_ = places(deck_);
    std::map<std::string, std::uint32_t> first;
    std::vector<std::uint32_t> carried;
    for (std::uint32_t f = 0; f < deck_.sources.size(); ++f) {
      if (places_[f].empty()) continue;
      const auto [it, is_new] = first.emplace(places_[f], f);
      if (is_new) carried.push_back(f);
      if (!is_new && deck_.sources[it->second].bytes() != deck_.sources[f].bytes())
        return Error{Error::Code::config, "two different files would be at " + places_[f] + ": " +
                                              deck_.sources[it->second].path() + " and " +
                                              deck_.sources[f].path()};
    }
    if (in_.interfaces != nullptr)
      for (const InterBase* i : in_.interfaces->all) inter_of_.emplace(i->block, i);
    collect_stretches();
    out_.reserve(3 * deck_.total_bytes + 10000);
    json_.begin_object();
    write_json_head(json_, detail::deck_json_id, detail::deck_json_version);
    write_json_deck(json_, in_.path, deck_, in_.model, in_.interfaces);
    json_.key("files").begin_array();
    for (const std::uint32_t f : carried) write_file(f);
    for (std::uint32_t f = 0; f < deck_.sources.size(); ++f)
      if (places_[f].empty())
        json_.begin_object(true)
            .field("path", deck_.sources[f].path())
            .field("external", true)
            .end_object();
    json_.end_array().end_object();
    return std::move(out_);
  }

 private:
  void collect_stretches() {
    stretches_.resize(deck_.sources.size());
    for (std::size_t b = 0; b < deck_.blocks.size(); ++b) {
      const Block& block = deck_.blocks[b];
      const Source& source = deck_.sources[block.header_span.file];
      const std::string_view bytes = source.bytes();
      const auto begin = static_cast<std::uint64_t>(
          source.line_at(block.header_span.offset).data() - bytes.data());
      stretches_[block.header_span.file].push_back(
          {begin, behind_line(bytes, block.header_span.offset), b, true});
      for (const FilePiece& p : block.body) {
        auto& to = stretches_[p.file];
        if (!to.empty() && to.back().block == b && to.back().end == p.begin)
          to.back().end = p.end;
        else
          to.push_back({p.begin, p.end, b, false});
      }
    }
    for (auto& list : stretches_)
      std::sort(list.begin(), list.end(),
                [](const BlockRange& a, const BlockRange& b) { return a.begin < b.begin; });
  }

  /// Text of a file, converted for JSON.
  std::string shown(std::string_view bytes) const {
    return latin1_ ? detail::latin1_to_utf8(bytes) : std::string(bytes);
  }

  /// Place of a file; the path of an absolute include.
  const std::string& place_of(std::uint32_t file) const {
    return places_[file].empty() ? deck_.sources[file].path() : places_[file];
  }

  void write_file(std::uint32_t file) {
    const Source& source = deck_.sources[file];
    const std::string_view bytes = source.bytes();
    file_ = file;
    latin1_ = !detail::is_utf8(bytes);
    carriage_ = every_line_has_carriage(bytes);
    line_ = 1;
    json_.begin_object();
    json_.field("path", places_[file]);
    json_.field("encoding", latin1_ ? "latin-1" : "utf-8");
    json_.field("line_end", carriage_ ? "\r\n" : "\n");
    json_.field("final_newline", bytes.ends_with('\n'));
    json_.key("items").begin_array();
    std::uint64_t at = 0;
    for (const BlockRange& s : stretches_[file]) {
      write_text(at, s.begin);
      write_block(s);
      at = s.end;
    }
    write_text(at, bytes.size());
    json_.end_array().end_object();
  }

  static bool every_line_has_carriage(std::string_view bytes) {
    bool any = false;
    for (std::size_t nl = bytes.find('\n'); nl != std::string_view::npos;
         nl = bytes.find('\n', nl + 1)) {
      if (nl == 0 || bytes[nl - 1] != '\r') return false;
      any = true;
    }
    // A last line without line feed must not end in a carriage return.
    return any && !bytes.ends_with('\r');
  }

  /// Calls f(text, offset) for every physical line of [begin, end).
  template <class F>
  void for_each_line(std::uint64_t begin, std::uint64_t end, F&& f) {
    const std::string_view bytes = deck_.sources[file_].bytes();
    for (std::uint64_t at = begin; at < end;) {
      const std::uint64_t nl = std::min<std::uint64_t>(bytes.find('\n', at), bytes.size());
      std::string_view text = bytes.substr(at, nl - at);
      if (carriage_ && nl < bytes.size()) text.remove_suffix(1);
      f(text, at);
      ++line_;
      at = nl + 1;
    }
  }

  /// Writes lines outside blocks.
  void write_text(std::uint64_t begin, std::uint64_t end) {
    if (begin >= end) return;
    std::uint64_t from = begin;
    for (const IncludeEdge& e : deck_.includes) {
      if (e.parent != file_ || e.directive.offset < begin || e.directive.offset >= end) continue;
      write_lines("text", from, e.directive.offset, nullptr);
      from = behind_line(deck_.sources[file_].bytes(), e.directive.offset);
      write_lines("include", e.directive.offset, from, &e);
    }
    write_lines("text", from, end, nullptr);
  }

  void write_lines(std::string_view kind, std::uint64_t begin, std::uint64_t end,
                   const IncludeEdge* edge) {
    if (begin >= end) return;
    json_.begin_object().field("kind", kind).field("line", line_);
    if (edge != nullptr) json_.field("file", place_of(edge->file));
    json_.key("lines").begin_array();
    write_texts(begin, end);
    json_.end_array().end_object();
  }

  void write_texts(std::uint64_t begin, std::uint64_t end) {
    for_each_line(begin, end,
                  [&](std::string_view text, std::uint64_t) { json_.value(shown(text)); });
  }

  // ---- blocks -------------------------------------------------------------------------------

  void write_block(const BlockRange& s) {
    const Block& block = deck_.blocks[s.block];
    json_.begin_object();
    json_.field("kind", s.header ? "block" : "continued");
    json_.field("keyword",
                shown(block.schema ? std::string_view(block.schema->keyword) : block.keyword));
    if (s.header && block.id.present) json_.field("id", block.id.value);
    if (s.header && block.unit_id.present) json_.field("unit_id", block.unit_id.value);
    json_.field("line", line_);
    std::uint64_t body = s.begin;
    if (s.header) {
      json_.field("column", block.header_span.offset - s.begin + 1).key("header");
      body = behind_line(deck_.sources[file_].bytes(), s.begin);
      write_texts(s.begin, body);
    }
    json_.field("version", block.version);
    const CardSchema* list = block.schema != nullptr && !block.opaque
                                 ? detail::list_card(*block.schema, block.version)
                                 : nullptr;
    if (list != nullptr)
      write_list(block, *list, body, s.end, s.header);
    else
      write_cards(block, body, s);
    if (s.header) write_effective(block);
    json_.end_object();
  }

  static bool comment(std::string_view text) {
    return text.starts_with('#') || text.starts_with('$');
  }

  /// Writes lines of a block with few cards: each with its values by name.
  void write_cards(const Block& block, std::uint64_t begin, const BlockRange& stretch) {
    DecodedBlock decoded;
    if (block.schema != nullptr) decoded = decode(deck_, block);
    std::unordered_map<std::uint64_t, const DecodedCard*> card_at;
    for (const DecodedCard& card : decoded.cards)
      if (!card.missing() && card.line.file == file_) card_at.emplace(card.line.offset, &card);
    json_.key("lines").begin_array();
    for_each_line(begin, stretch.end, [&](std::string_view text, std::uint64_t offset) {
      const auto it = card_at.find(offset);
      if (decoded.title_line.valid() && decoded.title_line.file == file_ &&
          decoded.title_line.offset == offset)
        write_title(text, decoded.title);
      else if (it != card_at.end() && !it->second->cells.empty() && !only_text(text, *it->second))
        write_card(text, *it->second);
      else
        json_.value(shown(text));
    });
    json_.end_array();
    if (!stretch.header || block.schema == nullptr) return;
    const std::vector<const CardSchema*> missing = detail::missing_cards(deck_, block);
    if (missing.empty()) return;
    json_.key("missing").begin_array(true);
    for (const CardSchema* card : missing) json_.value(card->name);
    json_.end_array();
  }

  /// True if a line needs its text: there is text behind the cells of a counted list, or other
  /// lines decide which cells its commas separate.
  static bool only_text(std::string_view text, const DecodedCard& card) {
    if (card.free_format && card.schema->repeat == Repeat::ids &&
        card.cells.size() <= static_cast<std::size_t>(std::count(text.begin(), text.end(), ',')))
      return true;
    if (card.free_format)
      return std::any_of(card.schema->fields.begin(), card.schema->fields.end(),
                         [](const Field& f) { return !f.when.empty(); });
    if (card.schema->repeat != Repeat::ids) return false;
    const Field& ids = card.schema->fields.back();
    std::size_t end = static_cast<std::size_t>(ids.first - 1);
    for (const Cell& cell : card.cells)
      if (cell.field == &ids) end += static_cast<std::size_t>(ids.last - ids.first + 1);
    return detail::trim_right(text).size() > end;
  }

  void write_title(std::string_view text, std::string_view title) {
    json_.begin_object(true).field("line", line_).field("title", shown(title));
    json_.field("text", shown(text)).end_object();
  }

  void write_card(std::string_view text, const DecodedCard& card) {
    json_.begin_object(true).field("line", line_).field("card", card.schema->name);
    json_.field("text", shown(text));
    // A list of ids is one value.
    const bool list = card.schema->repeat == Repeat::ids;
    const Field* ids = list ? &card.schema->fields.back() : nullptr;
    json_.key("fields").begin_object();
    for (const Cell& cell : card.cells) {
      if (cell.field == ids) continue;
      json_.key(cell.field->name);
      write_value(cell);
    }
    if (list) {
      json_.key(ids->name).begin_array();
      for (const Cell& cell : card.cells)
        if (cell.field == ids) write_value(cell);
      json_.end_array();
    }
    json_.end_object();
    json_.key("columns").begin_object();
    for (const Cell& cell : card.cells) {
      const auto begin = static_cast<std::int64_t>(cell.span.offset - card.line.offset);
      if (cell.field == ids || (card.free_format && cell.span.length == 0)) continue;
      const std::int64_t first = card.free_format ? begin + 1 : cell.field->first;
      const std::int64_t last = card.free_format ? begin + cell.span.length : cell.field->last;
      json_.key(cell.field->name).begin_array().value(first).value(last).end_array();
    }
    json_.end_object().end_object();
  }

  void write_value(const Cell& cell) {
    const CellKind kind = detail::kind_of(cell);
    if (kind == CellKind::null)
      json_.null();
    else if (kind == CellKind::integer)
      json_.value(cell.integer);
    else if (kind == CellKind::real)
      json_.value(cell.real);
    else
      json_.value(shown(cell.text));
  }

  /// Writes nodes, elements, ids: rows of text and values.
  void write_list(const Block& block, const CardSchema& card, std::uint64_t begin,
                  std::uint64_t end, bool header) {
    const bool title = header && block.schema->has_title;
    const std::uint64_t rows = title ? end_of_title(begin, end) : begin;
    json_.key("lines").begin_array();
    if (title)
      for_each_line(begin, rows, [&](std::string_view text, std::uint64_t) {
        if (comment(text))
          json_.value(shown(text));
        else
          write_title(text, trimmed_title(text));
      });
    json_.end_array();
    json_.field("card", card.name);
    json_.key("fields").begin_array(true);
    for (const Field& f : card.fields)
      if (f.in_version(block.version)) json_.value(f.name);
    json_.end_array();
    json_.key("rows").begin_array();
    for_each_line(rows, end, [&](std::string_view text, std::uint64_t offset) {
      if (comment(text)) {
        json_.value(shown(text));
        return;
      }
      json_.begin_array(true).value(shown(text));
      const DecodedCard row =
          decode_line(deck_, block, card, Line{detail::trim_right(text), file_, offset}, nullptr);
      for (const Cell& cell : row.cells) write_value(cell);
      json_.end_array();
    });
    json_.end_array();
  }

  static std::string_view trimmed_title(std::string_view text) {
    return detail::trim_right(detail::trim_right(text).substr(0, 100));
  }

  /// End of the first line that is not a comment.
  std::uint64_t end_of_title(std::uint64_t begin, std::uint64_t end) const {
    const std::string_view bytes = deck_.sources[file_].bytes();
    while (begin < end && comment(bytes.substr(begin))) begin = behind_line(bytes, begin);
    return begin < end ? behind_line(bytes, begin) : end;
  }

  // ---- interfaces ---------------------------------------------------------------------------

  void write_effective(const Block& block) {
    const auto it = inter_of_.find(&block);
    if (it == inter_of_.end()) return;
    json_.key("effective").begin_object();
    visit_any_interface(*it->second, [&](const auto& t) {
      t.for_each([&](std::string_view name, const auto& e) {
        const auto value = [&](const char* key, bool is_known, const auto& v) {
          json_.key(key);
          if (is_known)
            json_.value(text_safe(v));
          else
            json_.null();
        };
        json_.key(name).begin_object(true);
        value("input", e.has_input, e.input);
        // Some values need the geometry.
        value("value", e.origin != Origin::geometry || t.resolved, e.value);
        json_.field("origin", to_string(e.origin)).key("source");
        write_source(e.span);
        json_.end_object();
      });
    });
    json_.end_object();
  }

  static std::int64_t text_safe(std::int64_t v) { return v; }
  static double text_safe(double v) { return v; }
  std::string text_safe(const std::string& v) const { return shown(v); }

  void write_source(const Span& span) {
    if (!span.valid()) {
      json_.null();
      return;
    }
    const Position p = deck_.sources.position(span);
    json_.begin_object(true).field("file", place_of(span.file));
    json_.field("line", p.line).field("column", p.column);
    json_.field("end_column", p.column + span.length).end_object();
  }

  const DeckJsonInput& in_;
  const Deck& deck_;
  std::string out_;
  JsonWriter json_;
  std::vector<std::string> places_;
  std::vector<std::vector<BlockRange>> stretches_;
  std::unordered_map<const Block*, const InterBase*> inter_of_;
  // The file being written.
  std::uint32_t file_ = 0;
  bool latin1_ = false, carriage_ = false;
  std::uint64_t line_ = 1;
};

}  // namespace

Result<std::string> deck_to_json(const DeckJsonInput& input) { return DeckWriter(input).run(); }

std::string decks_to_json(const std::vector<std::string>& documents) {
  if (documents.size() == 1) return documents.front();
  std::string out;
  JsonWriter json(out);
  json.begin_object();
  write_json_head(json, detail::deck_json_id, detail::deck_json_version);
  json.key("decks").begin_array();
  for (const std::string& document : documents) json.raw(detail::trim_right(document));
  json.end_array().end_object();
  return out;
}

// ---- the loss report -------------------------------------------------------------------------

namespace {

struct LossLists {
  const std::vector<LossEntry>* losses = nullptr;
  Rows<LossEntry> of(Loss loss) const {
    return {[this, loss](const auto& add) {
      for (const LossEntry& e : *losses)
        if (e.loss == loss) add(e);
    }};
  }
};
RECORD(LossLists, "document", "", COLUMN("kept", "", r.of(Loss::kept)),
       COLUMN("approximated", "", r.of(Loss::approximated)),
       COLUMN("dropped", "", r.of(Loss::dropped)), COLUMN("undecided", "", r.of(Loss::undecided)));

constexpr DocumentHead losses_head{"deck/losses", 1,
                                   "Written by deck convert --report: cells and blocks that the "
                                   "conversion changed in a way worth knowing.",
                                   false};

}  // namespace

RECORD(LossEntry, "entry", "", COLUMN("file", "", r.file), COLUMN("line", "", r.line),
       COLUMN("column", "First column of the text that changed; not of a whole block",
              if_any(r.column > 0, r.column)),
       COLUMN("end_column", "Last column of the text that was there",
              if_any(r.column > 0, r.end_column)),
       COLUMN("keyword", "", r.keyword), COLUMN("id", "", r.id),
       COLUMN("field", "Empty: the block as a whole", r.field), COLUMN("old", "", r.old_text),
       COLUMN("new", "", r.new_text), COLUMN("note", "", r.note));

DocumentSchema losses_schema() { return document_schema<LossLists>(losses_head); }

std::string losses_json(const std::vector<LossEntry>& losses) {
  return write_document(losses_head, LossLists{&losses}) + '\n';
}

}  // namespace deck
