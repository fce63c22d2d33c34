// Copies the include tree into one text, with offsets and parameters of submodels applied.
#include "deck/edit.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>

#include "edit/cells.hpp"
#include "keyword/shared/include_scan.hpp"
#include "keyword/shared/reader.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace {

using detail::header_columns;
using detail::starts_with_nocase;
using detail::trim;
using detail::trim_right;

std::optional<std::string> free_name(const std::string& name, std::set<std::string>& taken) {
  const auto accept = [&](std::string candidate) -> std::optional<std::string> {
    if (!taken.insert(candidate).second) return std::nullopt;
    return candidate;
  };
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
  if (name.size() == 1) {
    for (const char c : letters)
      if (auto found = accept(std::string(1, c))) return found;
    return std::nullopt;
  }
  for (int k = 1; k < 100000; ++k) {
    const std::string suffix = std::to_string(k);
    if (suffix.size() >= name.size()) break;
    if (auto found = accept(name.substr(0, name.size() - suffix.size()) + suffix)) return found;
  }
  return std::nullopt;
}

/// Edits that keep the meaning of parameter references in a single file. `refusals` gets names
/// without a free name of their length, `notes` the new names.
std::vector<TextEdit> rename_local_parameters(const Deck& deck, std::vector<std::string>& refusals,
                                              std::vector<std::string>& notes) {
  std::vector<TextEdit> edits;
  bool any_local = false;
  for (const auto& [name, p] : deck.parameters) any_local = any_local || p.local;
  if (!any_local) return edits;
  const detail::ParameterPlaces places = detail::find_parameters(deck);
  std::set<std::string> taken;
  for (const auto& [name, p] : deck.parameters) taken.insert(name);
  for (const auto& [name, spans] : places) taken.insert(name);
  for (auto it = deck.parameters.begin(); it != deck.parameters.end();) {
    const std::string& name = it->first;
    const auto last = deck.parameters.upper_bound(name);
    // Meaning in a single file: the first local definition, else the first.
    const auto local_one =
        std::find_if(it, last, [](const auto& entry) { return entry.second.local; });
    const Parameter* merged = &(local_one != last ? local_one : it)->second;
    const auto used = places.find(name);
    bool conflict = false;
    if (used != places.end())
      for (const Span& s : used->second)
        conflict = conflict || deck.find_parameter(name, s.file) != merged;
    for (auto p = it; conflict && p != last; ++p) {
      const Parameter& local = p->second;
      if (!local.local || local.file == 0) continue;
      const auto renamed = free_name(name, taken);
      if (!renamed) {
        refusals.push_back(deck.sources.where(local.span) + ": local parameter '" + name +
                           "' means something else in another file and there is no free name of "
                           "its length; rename it");
        continue;
      }
      notes.push_back("local parameter " + name + " of " + deck.sources[local.file].path() +
                      " is now " + *renamed);
      const std::string_view cell = detail::columns(deck.sources.text(local.span), 1, 10);
      const auto shift = cell.find_first_not_of(" \t");
      edits.push_back({Span{local.span.file, static_cast<std::uint32_t>(name.size()),
                            local.span.offset + (shift == std::string_view::npos ? 0 : shift)},
                       *renamed});
      for (const Span& s : used->second)
        if (deck.find_parameter(name, s.file) == &local) edits.push_back({s, *renamed});
    }
    it = last;
  }
  return edits;
}

// ---- one text ------------------------------------------------------------------------------

class Flattener {
 public:
  Flattener(const Deck& deck, const FlattenOptions& options, std::vector<TextEdit> edits)
      : deck_(deck), options_(options), edits_(deck.sources.size()) {
    for (TextEdit& e : edits) edits_[e.span.file].push_back(std::move(e));
    for (auto& list : edits_)
      std::sort(list.begin(), list.end(),
                [](const TextEdit& a, const TextEdit& b) { return a.span.offset < b.span.offset; });
    children_.resize(deck.sources.size());
    for (const IncludeEdge& e : deck.includes) children_[e.parent].push_back(&e);
  }

  std::string run() {
    out_.reserve(deck_.total_bytes + 1024);
    emit(0);
    return std::move(out_);
  }

 private:
  std::string_view line_end(std::uint32_t file) const {
    const std::string_view bytes = deck_.sources[file].bytes();
    const auto nl = bytes.find('\n');
    return nl != std::string_view::npos && nl > 0 && bytes[nl - 1] == '\r' ? "\r\n" : "\n";
  }

  void append(std::uint32_t file, std::uint64_t begin, std::uint64_t end) {
    const std::string_view bytes = deck_.sources[file].bytes();
    const auto& list = edits_[file];
    auto e = std::lower_bound(
        list.begin(), list.end(), begin,
        [](const TextEdit& edit, std::uint64_t offset) { return edit.span.offset < offset; });
    for (; e != list.end() && e->span.offset < end; ++e) {
      out_.append(bytes.substr(begin, e->span.offset - begin)).append(e->text);
      begin = e->span.offset + e->span.length;
    }
    if (begin < end) out_.append(bytes.substr(begin, end - begin));
  }

  void close_line(std::uint32_t file) {
    if (!out_.empty() && out_.back() != '\n') out_ += line_end(file);
  }

  /// Turns lines of a directive into comments.
  void comment_out(std::uint32_t file, std::uint64_t begin, std::uint64_t end) {
    const std::string_view bytes = deck_.sources[file].bytes();
    for (std::uint64_t at = begin; at < end;) {
      const std::uint64_t next = std::min<std::uint64_t>(bytes.find('\n', at), end - 1) + 1;
      out_.append("## ").append(bytes.substr(at, next - at));
      at = next;
    }
    close_line(file);
  }

  void include(std::uint32_t file, const IncludeEdge& edge, std::uint64_t end) {
    if (options_.mark) comment_out(file, edge.directive.offset, end);
    emit(edge.file);
    close_line(edge.file);
    if (options_.mark) out_.append("## end of ").append(edge.written).append(line_end(file));
  }

  void emit(std::uint32_t file) {
    // Lines before the first keyword of an include belong to no block; lines behind the include
    // continue the block before it.
    const bool outer = closed_, outer_headed = headed_;
    headed_ = file == 0;
    closed_ = closed_ || !headed_;
    emit_lines(file);
    if (!headed_) closed_ = outer;
    headed_ = headed_ || outer_headed;
  }

  void emit_lines(std::uint32_t file) {
    const std::string_view bytes = deck_.sources[file].bytes();
    auto edge = children_[file].begin();
    std::uint64_t run = 0;
    for (std::uint64_t pos = 0; pos < bytes.size();) {
      const auto nl = std::min<std::size_t>(bytes.find('\n', pos), bytes.size());
      const std::uint64_t next = std::min<std::uint64_t>(nl + 1, bytes.size());
      if (edge != children_[file].end() && (*edge)->directive.offset == pos) {
        append(file, run, pos);
        detail::include_path(bytes, pos);
        run = pos;
        include(file, **edge++, run);
        continue;
      }
      const std::string_view line = bytes.substr(pos, nl - pos);
      const auto first = line.find_first_not_of(" \t");
      const bool header = first != std::string_view::npos && line[first] == '/';
      if (file != 0 && starts_with_nocase(line, "#enddata")) {
        append(file, run, pos);
        return;
      }
      if (header && trim_right(line.substr(first, header_columns)) == "/END") {
        append(file, run, file == 0 ? bytes.size() : pos);
        closed_ = headed_ = true;
        return;
      }
      if (header) {
        closed_ = false;
        headed_ = true;
      } else if (closed_ && !line.starts_with('#') && !line.starts_with('$')) {
        // Between the /END of an include and its first keyword no block is open; the line would
        // join the last block.
        append(file, run, pos);
        const bool directive =
            starts_with_nocase(line, "include") || starts_with_nocase(line, "enddata");
        out_ += directive ? "# " : "#";
        run = pos;
      }
      pos = next;
    }
    append(file, run, bytes.size());
  }

  const Deck& deck_;
  const FlattenOptions& options_;
  std::vector<std::vector<TextEdit>> edits_;  // by file, ascending
  std::vector<std::vector<const IncludeEdge*>> children_;
  std::string out_;
  bool closed_ = false;  // no block is open: an /END was read or an include began
  bool headed_ = false;  // the present include has had a keyword
};

/// A /BEGIN of an include that only repeats the version.
bool repeated_begin(const Deck& deck, const Block& b) {
  return (b.header == "/BEGIN" || b.header.starts_with("/BEGIN/")) && b.header_span.file != 0 &&
         b.submodel < 0 && !(b.header_span == deck.begin.span);
}

/// Comments out the lines of a block.
void disable(const Deck& deck, const Block& b, std::vector<TextEdit>& edits) {
  const Source& source = deck.sources[b.header_span.file];
  const auto header = source.line_at(b.header_span.offset).data() - source.bytes().data();
  edits.push_back({Span{b.header_span.file, 0, static_cast<std::uint64_t>(header)}, "#"});
  LineCursor cursor(deck.sources, b);
  for (Line line = cursor.next(); line.valid(); line = cursor.next())
    edits.push_back({Span{line.file, 0, line.offset}, "#"});
}

/// Content of a block as read: filled cells by name and value, then the number of unread lines.
using CellContent = std::tuple<std::string_view, bool, std::int64_t, double, std::string_view>;
std::vector<CellContent> contents_of(const DecodedBlock& d) {
  std::vector<CellContent> out;
  for (const DecodedCard& card : d.cards)
    for (const Cell& cell : card.cells) {
      if (cell.blank()) continue;
      if (cell.parameter)
        out.emplace_back(cell.field->name, true, cell.integer, cell.real, "");
      else
        out.emplace_back(cell.field->name, false, 0, 0, cell.text);
    }
  out.emplace_back("", false, d.extra.size(), 0, "");
  return out;
}

/// Compares the flat form with the deck, block by block.
class FlatComparison {
 public:
  FlatComparison(const Deck& deck, const Deck& flat) : deck_(deck), flat_(flat) {}

  /// First difference; empty if none. Blocks that change their input version and are only partly
  /// described become losses.
  std::string difference(std::vector<LossEntry>& losses) {
    std::size_t at = 0;
    for (const Block& b : deck_.blocks) {
      if (repeated_begin(deck_, b)) continue;
      if (at == flat_.blocks.size()) return where(b) + "the block would be lost";
      const Block& now = flat_.blocks[at++];
      if (now.submodel != b.submodel || now.keyword != b.keyword || now.opaque != b.opaque ||
          now.id.value != b.id.value || now.unit_id.value != b.unit_id.value)
        return where(b) + "the block would be read differently in one file";
      if (!same_lines(b, now)) return where(b) + "the block would get other lines in one file";
      if (!same_cells(b, now))
        return where(b) + "its cells follow input version " + std::to_string(b.version) +
               ", the lines around its include follow " + std::to_string(now.version) +
               " with other columns; convert one of them to the other version first";
      if (b.version != now.version) note_version(b, now.version, losses);
    }
    return at == flat_.blocks.size() ? std::string()
                                     : deck_.sources[0].path() + ":1:1: a block would be added";
  }

 private:
  std::string where(const Block& b) const {
    return deck_.sources.where(b.header_span) + ": " + std::string(b.header.substr(0, 60)) + ": ";
  }

  bool same_lines(const Block& b, const Block& now) const {
    LineCursor left(deck_.sources, b), right(flat_.sources, now);
    for (;;) {
      const Line x = left.next(), y = right.next();
      if (x.valid() != y.valid()) return false;
      if (!x.valid()) return true;
      if (x.text == y.text) continue;
      if (x.text.find('&') == std::string_view::npos && !b.header.starts_with("/PARAMETER"))
        return false;
    }
  }

  /// Only parameters and versions can change the meaning of a cell.
  bool same_cells(const Block& b, const Block& now) const {
    if (b.schema == nullptr || b.header.starts_with("/PARAMETER")) return true;
    const bool moved =
        b.version != now.version && detail::layout_differs(*b.schema, b.version, now.version);
    if (!moved && deck_.parameters.empty()) return true;
    return contents_of(decode(deck_, b)) == contents_of(decode(flat_, now));
  }

  /// Undescribed text may have other columns in another version.
  void note_version(const Block& b, int version, std::vector<LossEntry>& losses) {
    if (b.schema != nullptr && (b.schema->layout_known() || b.schema->kind == "engine")) return;
    if (!noted_.insert(b.keyword).second) return;
    losses.push_back(loss_entry(
        deck_, Loss::undecided, b, b.header_span,
        {.note = "written for input version " + std::to_string(b.version) + ", read as version " +
                 std::to_string(version) +
                 " from now on; the keyword is not described completely, so compare its columns in "
                 "both versions (this and further blocks of the keyword)"}));
  }

  const Deck& deck_;
  const Deck& flat_;
  std::set<std::string_view> noted_;
};

}  // namespace

Rewrite flatten(const LoadedDeck& context, const FlattenOptions& options) {
  const Deck& deck = context.deck();
  Rewrite rewrite;
  rewrite.refusals = detail::unread_files(deck);
  if (!rewrite.refusals.empty()) return rewrite;
  if (deck.includes.empty()) {
    rewrite.notes.push_back("the deck has no includes");
    return rewrite;
  }
  std::vector<TextEdit> edits = rename_local_parameters(deck, rewrite.refusals, rewrite.notes);
  for (const Block& b : deck.blocks) {
    if (!repeated_begin(deck, b)) continue;
    disable(deck, b, edits);
    rewrite.losses.push_back(loss_entry(deck, Loss::dropped, b, b.header_span,
                                        {.note = "a comment now: one file has one /BEGIN"}));
  }
  if (!rewrite.refusals.empty()) return rewrite;
  std::string text = Flattener(deck, options, std::move(edits)).run();
  const auto flat = read_deck_text(deck.sources[0].path(), text, context.schemas());
  const std::string difference =
      flat ? FlatComparison(deck, *flat).difference(rewrite.losses) : flat.error().message;
  if (!difference.empty()) {
    rewrite.refusals.push_back(difference);
    return rewrite;
  }
  rewrite.notes.push_back(std::to_string(deck.includes.size()) +
                          " includes replaced by their lines");
  rewrite.new_text = std::move(text);
  return rewrite;
}

}  // namespace deck
