// Line by line: what a block's data lines become in another layout of the same keyword, which lines
// it has there, and which old line and cells they come from. Private to the edit stage.
#pragma once
#include <bitset>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/edit/rewrite.hpp"
#include "deck/keyword/decode.hpp"
#include "deck/text/number.hpp"
#include "keyword/shared/line_check.hpp"
#include "text/shared/edits.hpp"

namespace deck::detail {

/// True if some card or cell of `schema` is in one of the versions only.
bool layout_differs(const Schema& schema, int a, int b);
/// One name for a cell that was renamed between versions.
std::string_view canonical_name(std::string_view field);
/// Only zeros, points and signs, or nothing.
bool is_zero_text(std::string_view text);

/// The text that gives `value` back when it is read in `width` columns and multiplied by `factor`,
/// or the closest one there is. nullopt: nothing fits.
std::optional<FormattedReal> cell_text(double value, double factor, int width);

/// True for a block that ends before its title line: a line put there would be taken for the title.
bool lacks_title(const DecodedBlock& block);

/// Calls found(line, begin, end) for every word of a block that no schema describes, by its bytes
/// in the line, until it returns true. The first: of one line, less what lies in `known` columns.
using FoundWord = std::function<bool(const Line& line, std::size_t begin, std::size_t end)>;
bool find_words(const Line& line, const std::bitset<line_columns + 1>& known,
                const FoundWord& found);
void find_undescribed_words(const DecodedBlock& block, const FoundWord& found);

/// A byte of the line behind which the end of the main file begins; invalid: there is none.
Span end_of_main(const Deck& deck);

/// Edits of whole lines, collected so that several at one place come out in order.
class LineEdits {
 public:
  explicit LineEdits(const SourceSet& sources) : sources_(sources) {}
  /// The line's text becomes `text`; only the bytes that differ are touched.
  void change(const Line& line, const std::string& text, std::vector<TextEdit>& out) const;
  /// Takes the line away with its line end.
  void remove(const Line& line, std::vector<TextEdit>& out) const;
  /// Puts a line behind the one that holds `anchor`, after those put there before.
  void insert_after(Span anchor, const std::string& text);
  /// The insertions, in file order.
  void finish(std::vector<TextEdit>& out) const;

 private:
  const SourceSet& sources_;
  std::map<std::pair<std::uint32_t, std::uint64_t>, std::string> inserted_;
};

/// A line of the new layout and the old line it comes from.
struct NewLine {
  const CardSchema* card = nullptr;
  const DecodedCard* old = nullptr;
  int round = 0;  ///< as in DecodedCard
};

/// The cards of a block in version `target`, with the conditions evaluated on its old values. A
/// field that the new version does not have counts as 0.
class TargetLayout {
 public:
  TargetLayout(const Block& block, const DecodedBlock& decoded, int target)
      : block_(block), decoded_(decoded), target_(target) {}

  /// Lines in order, as far as the old block has rounds for them. Old lines are used once.
  std::vector<NewLine> lines() const;
  /// Cells that the line has.
  std::vector<const Field*> fields(const CardSchema& card, int round) const;
  /// The old cell of that name in the same round, on another line than `not_here`.
  const Cell* elsewhere(std::string_view field, int round, const DecodedCard* not_here) const;
  /// True if the number of lines of the block decides what the lines are.
  bool counts_lines() const;

 private:
  using Group = std::vector<const CardSchema*>;
  bool holds(const CardSchema& card, int round) const;
  bool holds(const std::vector<Condition>& when, int round) const;
  std::int64_t value(std::string_view field, int round) const;
  bool has_field(std::string_view field) const;
  int rounds(const CardSchema& card) const;
  const DecodedCard* take(const CardSchema& card, int round, std::vector<bool>& used) const;

  const Block& block_;
  const DecodedBlock& decoded_;
  int target_;
};

/// Cell of that name on a line; nullptr if it has none.
const Cell* cell_of(const DecodedCard& card, std::string_view field);

}  // namespace deck::detail
