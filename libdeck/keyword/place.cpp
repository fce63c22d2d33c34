// Finds block, card line and cell at a position in a file.
#include "keyword/shared/place.hpp"

#include <algorithm>

#include "keyword/shared/include_scan.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace {

template <class Ranges>
auto at_or_before(const Ranges& ranges, std::uint32_t file, std::uint64_t offset) {
  auto it = std::upper_bound(
      ranges.begin(), ranges.end(), std::pair{file, offset}, [](const auto& key, const auto& r) {
        return key.first != r.file ? key.first < r.file : key.second < r.begin;
      });
  if (it == ranges.begin() || std::prev(it)->file != file) return ranges.end();
  return std::prev(it);
}

}  // namespace

BlockIndex::BlockIndex(const Deck& deck) : deck_(&deck) {
  for (std::size_t i = 0; i < deck.blocks.size(); ++i) {
    const Block& b = deck.blocks[i];
    const auto index = static_cast<std::int64_t>(i);
    const Range header{b.header_span.file, b.header_span.offset,
                       b.header_span.offset + b.header_span.length, index};
    headers_.push_back(header);
    ranges_.push_back(header);
    for (const FilePiece& p : b.body) ranges_.push_back({p.file, p.begin, p.end, index});
  }
  const auto less = [](const Range& a, const Range& b) {
    return a.file != b.file ? a.file < b.file : a.begin < b.begin;
  };
  std::sort(ranges_.begin(), ranges_.end(), less);
  std::sort(headers_.begin(), headers_.end(), less);
}

std::int64_t BlockIndex::find(std::uint32_t file, std::uint64_t offset) const {
  const auto it = at_or_before(ranges_, file, offset);
  if (it == ranges_.end()) return -1;
  // A caret may be after the last byte of a line.
  return offset <= it->end ? it->block : -1;
}

std::int64_t BlockIndex::next_header_after_comments(std::uint32_t file,
                                                    std::uint64_t offset) const {
  const auto it =
      std::upper_bound(headers_.begin(), headers_.end(), std::pair{file, offset},
                       [](const auto& key, const auto& r) {
                         return key.first != r.file ? key.first < r.file : key.second < r.begin;
                       });
  if (it == headers_.end() || it->file != file) return -1;
  const std::string_view bytes = deck_->sources[file].bytes();
  std::uint64_t at = offset;
  while (at < it->begin) {
    const auto nl = std::min(bytes.find('\n', at), bytes.size());
    const std::string_view line = bytes.substr(at, nl - at);
    // Blanks may precede the header.
    if (it->begin <= nl) break;
    if (!line.empty() && line[0] != '#' && line[0] != '$') return -1;
    if (line.empty()) return -1;
    at = nl + 1;
  }
  return it->block;
}

bool BlockIndex::before_first_header(std::uint32_t file, std::uint64_t offset) const {
  return at_or_before(headers_, file, offset) == headers_.end();
}

CellColumns columns_of(const DecodedCard& card, const Cell& cell) {
  const int first = static_cast<int>(cell.span.offset - card.line.offset) + 1;
  if (card.free_format) return {first, first + static_cast<int>(cell.span.length) - 1};
  const Field& f = *cell.field;
  const bool list =
      card.schema->repeat == Repeat::ids && &f == &card.schema->fields.back() && first >= f.first;
  // A cell beyond the end of its line is clipped to it.
  const int begin = list ? first : f.first;
  return {begin, begin + f.last - f.first};
}

const Cell* PlacedLine::cell_at(int column) const {
  if (what != What::card) return nullptr;
  for (const Cell& cell : card.cells) {
    const CellColumns at = columns_of(card, cell);
    if (column >= at.first && column <= at.last) return &cell;
  }
  return nullptr;
}

namespace {

/// The card of a line in a block of nodes or elements.
const CardSchema* bulk_card(const Deck& deck, const Block& block, const Line& wanted) {
  std::vector<const CardSchema*> cards;
  for (const CardSchema& card : block.schema->cards)
    if (card.in_version(block.version)) cards.push_back(&card);
  if (cards.size() < 2) return cards.empty() ? nullptr : cards.front();
  LineCursor cursor(deck.sources, block);
  std::size_t at = 0;
  for (Line line = cursor.next(); line.valid(); line = cursor.next()) {
    if (line.file == wanted.file && line.offset == wanted.offset) return cards[at];
    if (at == 0 && line.text.empty()) continue;
    at = at + 1 == cards.size() ? 0 : at + 1;
  }
  return nullptr;
}

/// True for the line after a block: /END, or text after an included file.
bool behind(const Source& source, const Block& block, const Line& line) {
  if (line.offset == source.bytes().size()) return false;  // may still belong to the block
  for (const FilePiece& p : block.body)
    if (p.file == line.file && p.begin <= line.offset && line.offset < p.end) return false;
  return block.header_span.file != line.file || line.offset < block.header_span.offset ||
         line.offset >= block.header_span.offset + block.header_span.length;
}

/// True for a continuation line of an #include.
bool in_directive(const Deck& deck, const Line& line) {
  for (const IncludeEdge& e : deck.includes) {
    if (e.parent != line.file || e.directive.offset > line.offset) continue;
    std::uint64_t end = e.directive.offset;
    detail::include_path(deck.sources[line.file].bytes(), end);
    if (line.offset < end) return true;
  }
  return false;
}

}  // namespace

PlacedLine line_at(const Deck& deck, const BlockIndex& index, std::uint32_t file,
                   std::uint64_t offset) {
  PlacedLine out;
  const Source& source = deck.sources[file];
  const std::string_view whole = source.line_at(offset);
  out.line = {detail::trim_right(whole), file,
              static_cast<std::uint64_t>(whole.data() - source.bytes().data())};
  const std::string_view text = out.line.text;
  if (detail::is_include(text) || in_directive(deck, out.line)) {
    out.what = PlacedLine::What::directive;
    return out;
  }
  out.block = index.find(file, out.line.offset);
  if (out.block >= 0 && behind(source, deck.blocks[static_cast<std::size_t>(out.block)], out.line))
    out.block = -1;
  if (!text.empty() && (text[0] == '#' || text[0] == '$')) {
    out.what = PlacedLine::What::comment;
    return out;
  }
  if (out.block < 0) {
    // Blanks may precede a header.
    const auto slash = text.find('/');
    if (slash == text.npos) return out;
    const std::int64_t b = index.find(file, out.line.offset + slash);
    if (b < 0 ||
        deck.blocks[static_cast<std::size_t>(b)].header_span.offset != out.line.offset + slash)
      return out;
    out.block = b;
  }
  const Block& block = deck.blocks[static_cast<std::size_t>(out.block)];
  if (block.header_span.file == file && block.header_span.offset >= out.line.offset &&
      block.header_span.offset <= out.line.offset + whole.size()) {
    out.what = PlacedLine::What::header;
    return out;
  }
  out.what = PlacedLine::What::opaque;
  if (block.schema == nullptr || block.opaque) return out;
  if (block.schema->bulk) {
    if (const CardSchema* card = bulk_card(deck, block, out.line)) {
      out.what = PlacedLine::What::card;
      out.card = decode_line(deck, block, *card, out.line, nullptr);
    }
    return out;
  }
  DecodedBlock decoded = decode(deck, block);
  const auto here = [&](const Line& line) {
    return line.valid() && line.file == file && line.offset == out.line.offset;
  };
  if (here(decoded.title_line)) out.what = PlacedLine::What::title;
  for (DecodedCard& card : decoded.cards)
    if (here(card.line)) {
      out.what = PlacedLine::What::card;
      out.card = std::move(card);
      break;
    }
  return out;
}

}  // namespace deck
