// Sets texts of cells, adds and removes lines, finds words and parameters for conversions.
#include "edit/cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "deck/rule_id.hpp"
#include "keyword/shared/place.hpp"
#include "text/shared/columns.hpp"

namespace deck::detail {

CellPlace place_of(const Block& block, const DecodedCard& card, const Cell& cell) {
  const CellColumns at = columns_of(card, cell);
  return {&block, cell.span, cell.field->name, card.line, at.first, at.last, card.free_format};
}

Span span_in_header(const Block& block, std::string_view part) {
  const auto offset = static_cast<std::uint64_t>(part.data() - block.header.data());
  return {block.header_span.file, static_cast<std::uint32_t>(part.size()),
          block.header_span.offset + offset};
}

bool copy_cell_text(const Cell& cell, const Field& field, std::string& line) {
  const int width = field.last - field.first + 1;
  std::string text(cell.text);
  if (static_cast<int>(text.size()) > width) {
    const auto shorter = field.type == FieldType::real && !cell.parameter
                             ? format_real(cell.real, width)
                             : std::nullopt;
    if (!shorter || !shorter->exact) return false;
    text = shorter->text;
  }
  CellWriter::put(line, field.first, field.last, text);
  return true;
}

int CellPlace::room() const {
  if (!free_format) return last - first + 1;
  return static_cast<int>(span.length) +
         std::max(0, line_columns - static_cast<int>(line.text.size()));
}

void CellPlace::write(CellWriter& cells, std::string_view text) const {
  if (free_format)
    cells.replace(span, text);
  else
    cells.set(line.whole(), first, last, text);
}

int CellEdits::room(const CellPlace& place) const {
  const auto grown = grown_.find(key_of(place.line));
  return place.room() - (grown == grown_.end() || !place.free_format ? 0 : grown->second);
}

bool CellEdits::put(const CellPlace& place, const std::string& text) {
  if (static_cast<int>(text.size()) > room(place)) return false;
  if (place.free_format) {
    grown_[key_of(place.line)] +=
        static_cast<int>(text.size()) - static_cast<int>(place.span.length);
    out_.push_back({place.span, text});
  } else {
    out_.push_back(
        CellWriter::edit_in_place(sources_, place.line.whole(), place.first, place.last, text));
  }
  return true;
}

ItemLines::ItemLines(const Deck& deck, const Block& block)
    : deck_(deck), block_(block), cursor_(deck.sources, block) {
  for (const CardSchema& card : block.schema->cards)
    if (card.in_version(block.version)) cards_.push_back(&card);
}

bool ItemLines::next_line() {
  if (cards_.empty()) return false;
  if (lines_.size() == cards_.size()) lines_.clear();
  const Line line = cursor_.next();
  if (line.valid()) lines_.push_back(line);
  return line.valid();
}

bool ItemLines::next() {
  do {
    if (!next_line()) return false;
  } while (lines_.size() < cards_.size());
  return true;
}

bool ItemLines::plain(std::size_t row) const {
  return lines_[row].text.substr(0, line_columns).find_first_of(",&") == std::string_view::npos;
}

DecodedCard ItemLines::decoded(std::size_t row) const {
  return decode_line(deck_, block_, *cards_[row], lines_[row], nullptr);
}

std::optional<FormattedReal> cell_text(double value, double factor, int width) {
  const double start = value / factor;
  std::optional<FormattedReal> best = format_real(start, width);
  if (!best) return std::nullopt;
  best->exact = read_real(best->text).value * factor == value;
  double up = start, down = start;
  for (int step = 0; step < 4 && !best->exact; ++step) {
    up = std::nextafter(up, std::numeric_limits<double>::infinity());
    down = std::nextafter(down, -std::numeric_limits<double>::infinity());
    for (const double candidate : {up, down}) {
      const auto text = format_real(candidate, width);
      if (text && read_real(text->text).value * factor == value) {
        best = text;
        best->exact = true;
        break;
      }
    }
  }
  return best;
}

bool lacks_title(const DecodedBlock& block) {
  const Schema* schema = block.block->schema;
  return schema != nullptr && schema->has_title && !block.title_line.valid();
}

Span end_of_main(const Deck& deck) {
  const std::string_view bytes = deck.sources[0].bytes();
  std::uint64_t end = bytes.size();
  if (deck.end_seen) {
    std::uint64_t from = 0;
    for (const Block& b : deck.blocks)
      if (b.header_span.file == 0) from = std::max(from, b.header_span.offset);
    for (std::uint64_t at = bytes.find('\n', from); at < bytes.size(); at = bytes.find('\n', at)) {
      ++at;
      const std::uint64_t nl = std::min<std::uint64_t>(bytes.find('\n', at), bytes.size());
      if (trim(bytes.substr(at, nl - at)) != "/END") continue;
      end = at;
      break;
    }
  }
  return end == 0 ? Span{} : Span{0, 1, end - 1};
}

void LineEdits::change(const Line& line, const std::string& text,
                       std::vector<TextEdit>& out) const {
  const std::string_view old = line.text;
  if (old == text) return;
  std::size_t same = 0;
  const std::size_t shorter = std::min(old.size(), text.size());
  while (same < shorter && old[same] == text[same]) ++same;
  std::size_t tail = 0;
  while (tail < shorter - same && old[old.size() - 1 - tail] == text[text.size() - 1 - tail])
    ++tail;
  out.push_back(
      {Span{line.file, static_cast<std::uint32_t>(old.size() - same - tail), line.offset + same},
       text.substr(same, text.size() - same - tail)});
}

void LineEdits::remove(const Line& line, std::vector<TextEdit>& out) const {
  const std::string_view bytes = sources_[line.file].bytes();
  const std::uint64_t nl = bytes.find('\n', line.offset);
  const std::uint64_t end = nl == std::string_view::npos ? bytes.size() : nl + 1;
  out.push_back({Span{line.file, static_cast<std::uint32_t>(end - line.offset), line.offset}, {}});
}

void LineEdits::insert_after(Span anchor, const std::string& text) {
  const std::string_view bytes = sources_[anchor.file].bytes();
  const std::uint64_t nl = bytes.find('\n', anchor.offset);
  const bool open_end = nl == std::string_view::npos;
  const std::uint64_t at = open_end ? bytes.size() : nl + 1;
  // Line end of the line before; without one, of the file's first line.
  const std::uint64_t sample = open_end ? bytes.find('\n') : nl;
  const bool carriage = sample != std::string_view::npos && sample > 0 && bytes[sample - 1] == '\r';
  const std::string end = carriage ? "\r\n" : "\n";
  std::string& to = inserted_[{anchor.file, at}];
  to += open_end ? end + text : text + end;
}

void LineEdits::append_to(std::vector<TextEdit>& out) const {
  for (const auto& [place, text] : inserted_)
    out.push_back({Span{place.first, 0, place.second}, text});
}

bool find_words(const Line& line, const std::bitset<line_columns + 1>& known,
                const FoundWord& found) {
  const std::string_view text = line.text.substr(0, line_columns);
  const auto hidden = [&](std::size_t i) {
    return known.test(i + 1) || static_cast<unsigned char>(text[i]) <= ' ' || text[i] == ',';
  };
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (hidden(at)) continue;
    const std::size_t begin = at;
    while (at < text.size() && !hidden(at)) ++at;
    if (found(line, begin, at)) return true;
  }
  return false;
}

void find_undescribed_words(const DecodedBlock& block, const FoundWord& found) {
  for (const DecodedCard& card : block.cards) {
    if (card.missing() || card.free_format) continue;
    std::bitset<line_columns + 1> known;
    for (const Field& f : card.schema->fields)
      if (f.in_version(block.block->version))
        for (int c = f.first; c <= std::min(f.last, line_columns); ++c)
          known.set(static_cast<std::size_t>(c));
    if (find_words(card.line, known, found)) return;
  }
  for (const Line& line : block.extra)
    if (find_words(line, {}, found)) return;
}

namespace {

void add_place(ParameterPlaces& places, std::uint32_t file, std::string_view bytes,
               std::size_t begin, std::size_t end) {
  places[std::string(bytes.substr(begin, end - begin))].push_back(
      {file, static_cast<std::uint32_t>(end - begin), begin});
}

}  // namespace

ParameterPlaces find_parameters(const Deck& deck) {
  ParameterPlaces places;
  for (std::uint32_t f = 0; f < deck.sources.size(); ++f) {
    const std::string_view bytes = deck.sources[f].bytes();
    for (std::size_t at = bytes.find('&'); at != std::string_view::npos;
         at = bytes.find('&', at + 1)) {
      const auto nl = bytes.rfind('\n', at);
      const char first = bytes[nl == std::string_view::npos ? 0 : nl + 1];
      if (first == '#' || first == '$') continue;
      std::size_t end = at + 1;
      while (end < bytes.size() && name_character(bytes[end])) ++end;
      if (end > at + 1) add_place(places, f, bytes, at + 1, end);
    }
  }
  // Expressions may omit the &.
  for (const auto& [name, p] : deck.parameters) {
    if (p.expression.empty()) continue;
    const std::string_view bytes = deck.sources[p.span.file].bytes();
    const std::size_t stop = p.span.offset + std::min<std::size_t>(p.span.length, 100);
    for (std::size_t at = p.span.offset + 10; at < stop;) {
      std::size_t end = at;
      while (end < stop && name_character(bytes[end])) ++end;
      const bool number = end > at && bytes[at] >= '0' && bytes[at] <= '9';
      const bool function = end < stop && bytes[end] == '(';
      if (end > at && !number && !function && bytes[at - 1] != '&')
        add_place(places, p.span.file, bytes, at, end);
      at = end + 1;
    }
  }
  return places;
}

std::vector<std::string> unread_files(const Deck& deck) {
  std::vector<std::string> refusals;
  for (const Finding& d : deck.findings.all())
    if (d.rule == RuleId::DK004 || d.rule == RuleId::DK005 || d.rule == RuleId::DK006)
      refusals.push_back((d.span.valid() ? deck.sources.where(d.span) : deck.sources[0].path()) +
                         ": " + d.message);
  return refusals;
}

std::vector<std::string> contradicting_copies(const SourceSet& sources,
                                              const std::vector<TextEdit>& edits) {
  std::map<std::string, std::vector<std::uint32_t>> files;
  for (std::uint32_t f = 0; f < sources.size(); ++f) files[sources[f].path()].push_back(f);
  std::map<std::uint32_t, std::map<std::pair<std::uint64_t, std::uint32_t>, std::string>> by_file;
  for (const auto& [path, copies] : files)
    if (copies.size() > 1)
      for (const std::uint32_t f : copies) by_file[f];
  std::vector<std::string> refusals;
  if (by_file.empty()) return refusals;
  for (const TextEdit& e : edits)
    if (const auto it = by_file.find(e.span.file); it != by_file.end())
      it->second[{e.span.offset, e.span.length}] = e.text;
  for (const auto& [path, copies] : files)
    for (std::size_t i = 1; i < copies.size(); ++i)
      if (by_file[copies[i]] != by_file[copies[0]]) {
        refusals.push_back(path +
                           ":1:1: included more than once and would have to become two different "
                           "files; give the second include a file of its own, or flatten the deck "
                           "first");
        break;
      }
  return refusals;
}

}  // namespace deck::detail
