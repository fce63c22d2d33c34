// Detects /DEFAULT/INTER blocks written without their blank lines (DK511): some values are then in
// lines or columns that the solver does not read. If the lines as written leave text outside of
// cells, all subsets of omitted blank cards are tried; a subset is kept if all text is in cells.
// Output: the lost values and the blank lines to insert. Cost: 2^b readings for b blank cards.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "keyword/shared/decode_parts.hpp"

namespace deck {
namespace {

bool is_empty_line(const Line& line) {
  return line.text.find_first_not_of("0.+-, \t") == std::string_view::npos;
}

/// An assignment of the lines of a block to cards.
struct Reading {
  DecodedBlock block;
  /// Omitted blank cards, by the line before which they belong.
  std::map<std::size_t, int> left_out;
};

class BlankLines {
 public:
  BlankLines(const Deck& deck, const Block& block) : deck_(deck), block_(block) {
    LineCursor cursor(deck.sources, block);
    for (Line line = cursor.next(); line.valid(); line = cursor.next()) lines_.push_back(line);
    for (const CardSchema& card : block.schema->cards)
      if (card.blank() && card.in_version(block.version)) blanks_.push_back(&card);
  }

  bool report(detail::BlockFindings& noted) const {
    const auto all = readings();
    if (all.empty()) return false;
    if (!noted.wants(RuleId::DK511)) return true;
    const Reading& meant = all.front();
    int lines = 0;
    for (const auto& [before, n] : meant.left_out) lines += n;
    const Line& first = lines_[meant.left_out.begin()->first];  // the line in place of a blank one
    Finding* d = noted.keep(
        RuleId::DK511, first.whole(),
        fmt::format("{} lacks {} that must be blank, so its values are lost: {}",
                    block_.schema->keyword, lines == 1 ? "a line" : fmt::format("{} lines", lines),
                    lost(meant.block)));
    const bool one_way = std::all_of(all.begin(), all.end(), [&](const Reading& other) {
      return values_of(other.block) == values_of(meant.block);
    });
    std::vector<TextEdit> edits = insertions(meant);
    if (one_way && !edits.empty()) d->fix = Fix{"insert the blank lines", true, std::move(edits)};
    return true;
  }

 private:
  using Values = std::vector<std::pair<std::string, std::int64_t>>;

  /// Readings in which every number is in a cell, if the solver's reading is not one; fewest blank
  /// lines first.
  std::vector<Reading> readings() const {
    std::vector<Reading> out;
    if (blanks_.empty() || read_without(0)) return out;
    for (unsigned left_out = (1U << blanks_.size()) - 1; left_out > 0; --left_out)
      if (auto reading = read_without(left_out)) out.push_back(std::move(*reading));
    return out;
  }

  /// The block without the blank cards in the bits of `left_out`; nullopt: some text is then
  /// outside of cells.
  std::optional<Reading> read_without(unsigned left_out) const {
    Reading reading;
    reading.block.block = &block_;
    std::size_t next = 0;
    for (const CardSchema& card : block_.schema->cards) {
      if (!card.in_version(block_.version) || !is_met(card.when, reading.block)) continue;
      if (card.blank()) {
        const auto bit = std::find(blanks_.begin(), blanks_.end(), &card) - blanks_.begin();
        if ((left_out >> bit & 1U) != 0) {
          if (next < lines_.size()) ++reading.left_out[next];
          continue;
        }
      }
      if (next == lines_.size()) continue;
      const Line& line = lines_[next++];
      if (card.blank() && !is_empty_line(line)) return std::nullopt;
      if (card.blank()) continue;
      if (!fits(card, line)) return std::nullopt;
      reading.block.cards.push_back(decode_line(deck_, block_, card, line, nullptr));
    }
    const bool all = std::all_of(lines_.begin() + static_cast<std::ptrdiff_t>(next), lines_.end(),
                                 is_empty_line);
    if (!all || (left_out != 0 && reading.left_out.empty())) return std::nullopt;
    return reading;
  }

  /// True if every number of the line is in a cell of the card.
  bool fits(const CardSchema& card, const Line& line) const {
    if (is_empty_line(line)) return true;
    Findings found;
    decode_line(deck_, block_, card, line, &found);
    return std::all_of(found.all().begin(), found.all().end(),
                       [](const Finding& d) { return d.severity == Severity::info; });
  }

  static Values values_of(const DecodedBlock& block) {
    Values out;
    for (const DecodedCard& card : block.cards)
      for (const Cell& cell : card.cells)
        if (cell.integer != 0) out.emplace_back(cell.field->name, cell.integer);
    return out;
  }

  /// "Istf = 4, Igap0 = 1; read instead: Igap = 1"
  std::string lost(const DecodedBlock& meant) const {
    const DecodedBlock read = decode(deck_, block_);
    const auto missing = [](const DecodedBlock& from, const DecodedBlock& in) {
      std::string out;
      for (const auto& [name, value] : values_of(from))
        if (in.integer(name) != value)
          out += fmt::format("{}{} = {}", out.empty() ? "" : ", ", name, value);
      return out;
    };
    const std::string instead = missing(read, meant);
    return missing(meant, read) + (instead.empty() ? "" : "; read instead: " + instead);
  }

  /// Inserts empty lines directly after the previous data line, so that comments stay with their
  /// line. Empty if a file ends within the block without a line end.
  std::vector<TextEdit> insertions(const Reading& reading) const {
    std::vector<TextEdit> out;
    for (const auto& [before, n] : reading.left_out) {
      const Span after = before == 0 ? block_.header_span : lines_[before - 1].whole();
      const std::string_view bytes = deck_.sources[after.file].bytes();
      const auto newline = bytes.find('\n', after.offset);
      if (newline == std::string_view::npos) return {};
      const bool carriage = newline > 0 && bytes[newline - 1] == '\r';
      std::string text;
      for (int i = 0; i < n; ++i) text += carriage ? "\r\n" : "\n";
      out.push_back({Span{after.file, 0, newline + 1}, std::move(text)});
    }
    return out;
  }

  const Deck& deck_;
  const Block& block_;
  std::vector<Line> lines_;
  std::vector<const CardSchema*> blanks_;
};

}  // namespace

bool detail::report_missing_blank_lines(const Deck& deck, const Block& block, Findings& findings) {
  if (block.schema == nullptr || block.schema->kind != "default_inter" || block.opaque)
    return false;
  BlockFindings noted(&findings, block);
  return BlankLines(deck, block).report(noted);
}

}  // namespace deck
