// Look-up in a deck: lines, headers, parameters, units, submodel offsets. Checks the form of
// keyword lines.
#include "deck/keyword.hpp"

#include <algorithm>
#include <cstring>

#include "deck/text.hpp"
#include "keyword/shared/line_check.hpp"
#include "keyword/shared/reader.hpp"
#include "keyword/shared/references.hpp"
#include "keyword/shared/solver_order.hpp"
#include "text/shared/columns.hpp"

namespace deck {

Span Line::columns(int first, int last) const {
  const auto size = static_cast<std::int64_t>(text.size());
  const std::int64_t begin = std::min<std::int64_t>(first - 1, size);
  const std::int64_t end = std::min<std::int64_t>(last, size);
  return {file, static_cast<std::uint32_t>(std::max<std::int64_t>(end - begin, 0)),
          offset + static_cast<std::uint64_t>(begin)};
}

Line LineCursor::next_physical() {
  while (piece_ < block_->body.size()) {
    const FilePiece& p = block_->body[piece_];
    if (offset_ < p.begin) offset_ = p.begin;
    if (offset_ >= p.end) {
      ++piece_;
      offset_ = 0;
      continue;
    }
    const std::string_view bytes = (*sources_)[p.file].bytes();
    const char* const start = bytes.data() + offset_;
    const void* const nl = std::memchr(start, '\n', p.end - offset_);
    const auto length = static_cast<std::size_t>(
        nl ? static_cast<std::uint64_t>(static_cast<const char*>(nl) - start) : p.end - offset_);
    const Line line{detail::trim_right({start, length}), p.file, offset_};
    offset_ += length + 1;
    return line;
  }
  return {};
}

Line LineCursor::next() {
  Line line = next_physical();
  while (line.text.starts_with('#') || line.text.starts_with('$')) line = next_physical();
  return line;
}

std::int64_t Submodel::offset_for(std::string_view kind) const {
  constexpr std::string_view element_kinds[] = {"shell",   "sh3n",   "brick",  "tetra4", "penta6",
                                                "tetra10", "bric20", "shel16", "quad",   "tria",
                                                "truss",   "beam",   "spring", "element"};
  if (kind == "node") return nodes;
  if (kind == "part") return parts;
  if (kind == "mat") return materials;
  if (kind == "prop") return properties;
  if (kind == "submodel") return submodels;
  for (const auto e : element_kinds)
    if (kind == e) return elements;
  return definitions;
}

const Parameter* Deck::find_parameter(std::string_view name, std::uint32_t file) const {
  const auto [first, last] = parameters.equal_range(name);
  for (std::uint32_t f = file; f != Span::no_file; f = parent_of(f))
    for (auto it = first; it != last; ++it)
      if (it->second.local && it->second.file == f) return &it->second;
  for (auto it = first; it != last; ++it)
    if (!it->second.local) return &it->second;
  return nullptr;
}

const UnitSystem* Deck::units_of(const Block& block) const {
  if (block.unit_id.present && block.unit_id.value != 0) {
    const auto it = units.find(block.unit_id.value + offset_of(block, "unit"));
    return it == units.end() ? nullptr : &it->second;
  }
  if (block.submodel >= 0) {
    const auto& own = submodels[static_cast<std::size_t>(block.submodel)].units;
    if (own) return &*own;
  }
  return &begin.input;
}

std::int64_t Deck::offset_of(const Block& block, std::string_view kind) const {
  return block.submodel < 0 ? 0
                            : submodels[static_cast<std::size_t>(block.submodel)].offset_for(kind);
}

bool Deck::has(std::string_view header) const {
  return std::any_of(blocks.begin(), blocks.end(),
                     [&](const Block& b) { return b.header.starts_with(header); });
}

std::uint32_t Deck::parent_of(std::uint32_t file) const {
  // Each file except the main one has exactly one include edge, in the same order.
  return file == 0 || file > includes.size() ? Span::no_file : includes[file - 1].parent;
}

namespace detail {

void sort_as_solver(const Deck& deck, std::vector<const Block*>& category) {
  // Files are numbered in the order of opening.
  const auto key = [&](const Block* b) {
    std::int64_t id = b->id.value;
    if (b->submodel >= 0 && id > 0 && b->schema != nullptr) {
      const std::string_view other = header_reference(*b);  // elements: their part
      id += deck.offset_of(*b, other.empty() ? b->schema->kind : other);
    }
    return std::pair(b->header_span.file, id);
  };
  const auto before = [&](const Block* a, const Block* b) { return key(a) < key(b); };
  if (!std::is_sorted(category.begin(), category.end(), before))
    std::stable_sort(category.begin(), category.end(), before);
}

std::vector<const Block*> in_solver_order(const Deck& deck, std::string_view category) {
  return in_solver_order(deck, [&](const Block& b) { return is_below(b.header, category); });
}

namespace {

bool all_digits(std::string_view s) {
  return !s.empty() && std::all_of(s.begin(), s.end(), is_digit);
}

/// An object without a number in its header gets number 1. Exceptions: interfaces with a written 0,
/// and parts, groups and curves: no other block can refer to them without a number.
bool keeps_zero(const Block& block) {
  static constexpr std::string_view nameless[] = {"part", "surf",   "line", "box",
                                                  "set",  "subset", "funct"};
  if (block.schema == nullptr) return false;
  const std::string_view kind = block.schema->kind;
  if (kind == "inter") return block.id.present;
  return block.schema->bulk ||
         std::find(std::begin(nameless), std::end(nameless), kind) != std::end(nameless) ||
         kind.starts_with("gr");
}

/// Length of `name` if `header` starts with it as whole header fields, else 0.
std::size_t name_length(std::string_view header, std::string_view name) {
  return is_below(header, name) ? name.size() : 0;
}

}  // namespace

void note_lint_markers(Deck& deck, std::uint32_t file, std::uint64_t end) {
  if (deck.lint_markers.size() <= file) deck.lint_markers.resize(file + std::size_t{1});
  LintMarkers& known = deck.lint_markers[file];
  const std::string_view bytes = deck.sources[file].bytes();
  end = std::min<std::uint64_t>(end, bytes.size());
  constexpr std::size_t before = lint_marker.size() - 1;
  // Decks have few colons, so these are searched first.
  static_assert(lint_marker[before] == ':');
  for (std::uint64_t at = known.searched; at < end; ++at) {
    const void* const hit = std::memchr(bytes.data() + at, ':', end - at);
    if (hit == nullptr) break;
    at = static_cast<std::uint64_t>(static_cast<const char*>(hit) - bytes.data());
    if (at >= before && bytes.substr(at - before, lint_marker.size()) == lint_marker)
      known.offsets.push_back(at - before);
  }
  known.searched = std::max(known.searched, end);
}

std::string_view without_note(std::string_view header) {
  for (std::size_t slash = 0; slash != header.npos; slash = header.find('/', slash + 1)) {
    const std::string_view field =
        trim(header.substr(slash + 1, header.find('/', slash + 1) - slash - 1));
    const std::size_t end = field.find_first_of(" \t");
    if (end != field.npos && all_digits(field.substr(0, end)))
      return header.substr(0, static_cast<std::size_t>(field.data() - header.data()) + end);
  }
  return header;
}

void parse_header(const SchemaSet& schemas, Block& block) {
  const std::string_view header = block.header;
  block.schema = schemas.match(header);
  std::size_t length = 0;
  if (block.schema != nullptr) {
    length = name_length(header, block.schema->keyword);
    for (const std::string& alias : block.schema->aliases)
      length = std::max(length, name_length(header, alias));
  }
  // Header fields after the keyword; for unknown keywords everything before the first number.
  struct HeaderPart {
    std::size_t begin, size;
  };
  std::vector<HeaderPart> parts;
  std::size_t at = length;
  bool in_keyword = length == 0;
  std::size_t keyword_end = length;
  while (at < header.size()) {
    const std::size_t begin = at + 1;
    const std::size_t end = std::min(header.find('/', begin), header.size());
    const std::string_view raw = header.substr(std::min(begin, end), end - std::min(begin, end));
    const std::string_view text = trim(raw);
    const bool number = all_digits(text) || text.starts_with('&');
    if (in_keyword && !number) {
      keyword_end = end;
    } else {
      in_keyword = false;
      const auto skip = text.empty() ? 0 : static_cast<std::size_t>(text.data() - raw.data());
      parts.push_back({begin + skip, text.size()});
    }
    at = end;
  }
  block.keyword = header.substr(0, keyword_end);
  const auto read_id = [&](const HeaderPart& part, HeaderId& id) {
    const std::string_view text = header.substr(part.begin, part.size);
    id.span = {block.header_span.file, static_cast<std::uint32_t>(part.size),
               block.header_span.offset + part.begin};
    id.present = true;
    if (text.starts_with('&')) return true;
    if (!all_digits(text)) {
      id.present = false;
      return false;
    }
    const IntegerCell number = read_integer(text);
    constexpr auto most = std::numeric_limits<std::int32_t>::max();
    id.value = number.status == NumberStatus::overflow ? most : saturated(number.value);
    return true;
  };
  const bool wants_id = block.schema == nullptr || block.schema->has_id;
  std::size_t next = 0;
  if (wants_id) {
    // The id is the first numeric header field; names may precede it. /ADMAS has a variant number
    // before: /ADMAS/type/id.
    if (block.schema != nullptr && block.schema->keyword == "/ADMAS") {
      HeaderId type;
      while (next < parts.size() && !read_id(parts[next], type)) ++next;
      ++next;
    }
    while (next < parts.size() && !read_id(parts[next], block.id)) ++next;
    ++next;
    if (!block.id.present) {
      block.id = {};
      next = parts.size();
    }
    const bool parameter =
        block.id.span.length > 0 && header[block.id.span.offset - block.header_span.offset] == '&';
    if (block.id.value == 0 && !parameter && !keeps_zero(block)) block.id.value = 1;
  }
  // Version 51 has no unit field.
  if (block.version > 51 && next < parts.size() &&
      (block.schema == nullptr || block.schema->has_unit))
    if (!read_id(parts[next], block.unit_id)) block.unit_id = {};
}

// ---- the form of a keyword line: its length and its blanks --------------------------------------

namespace {

void check_length(Deck& deck, const HeaderPlace& place) {
  if (place.end - place.slash <= header_columns) return;
  const std::uint64_t from = place.slash + header_columns;
  const std::string_view tail = deck.sources[place.file].bytes().substr(from, place.end - from);
  if (std::all_of(tail.begin(), tail.end(), is_blank)) return;
  report(deck, RuleId::DK012, make_span(place.file, from, place.end),
         "a keyword line of " + std::to_string(place.end - place.slash) + " characters; " +
             std::to_string(header_columns) + " are read",
         {.solver = "It ignores the text silently.", .fix = "shorten the line"});
}

/// A blank before the number in a header is harmless; elsewhere the solver reads another keyword.
void check_blanks(Deck& deck, const HeaderPlace& place, std::string_view header) {
  const auto shown = [&] { return std::string(header.substr(0, 60)); };
  const std::uint64_t slash = place.slash;
  if (place.begin != slash) {
    report(deck, RuleId::DK052, make_span(place.file, place.begin, slash),
           "a blank before " + shown());
    return;
  }
  if (header.size() > 1 && is_blank(header[1])) {
    // Control characters count as blanks.
    const auto end = std::find_if_not(header.begin() + 1, header.end(), is_blank);
    report(
        deck, RuleId::DK052,
        make_span(place.file, slash + 1, slash + static_cast<std::uint64_t>(end - header.begin())),
        "a blank after the first slash of " + shown(),
        {.message = 0, .solver = "It does not know the keyword and reads nothing of the block."});
    return;
  }
  std::size_t inner = 1;
  while (inner < header.size() && !(header[inner] == '/' && is_blank(header[inner - 1]))) ++inner;
  // Before an id the solver ignores it.
  if (header.find_first_not_of("0123456789/ \t", std::min(inner, header.size())) ==
      std::string_view::npos)
    return;
  std::size_t blank = inner;
  while (is_blank(header[blank - 1])) --blank;
  report(deck, RuleId::DK052, make_span(place.file, slash + blank, slash + inner),
         "a blank before a slash of " + shown(),
         {.severity = Severity::warning, .message = 0, .solver = "Not known."});
}

}  // namespace

void check_header_line(Deck& deck, const HeaderPlace& place, std::string_view header) {
  check_length(deck, place);
  check_blanks(deck, place, header);
}

}  // namespace detail
}  // namespace deck
