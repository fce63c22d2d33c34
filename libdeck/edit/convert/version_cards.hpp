// Line by line: what a block's data lines become in another layout of the same keyword. Private to
// the edit stage.
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

}  // namespace deck::detail
