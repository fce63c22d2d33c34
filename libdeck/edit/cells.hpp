// Tools for rewriting a deck: find a cell and put a text into it, add and remove lines, lay out a
// block in another input version, find words that no schema describes, find names of parameters.
// Only the edit stage includes this header.
#pragma once
#include <array>
#include <bitset>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "deck/edit.hpp"
#include "deck/keyword.hpp"
#include "deck/text.hpp"
#include "keyword/shared/line_check.hpp"
#include "text/shared/edits.hpp"

namespace deck::detail {

/// Columns in which every double fits exactly.
inline constexpr int widest_number = 24;

/// The place of a cell, with functions to write into it.
struct CellPlace {
  const Block* block = nullptr;
  Span span;
  std::string_view field;
  Line line;
  int first = 0, last = 0;  ///< columns, unless free_format
  bool free_format = false;
  /// Columns that a text may have. On a line with commas the cells behind it need room as well.
  int room() const;
  /// Puts a text there, at the right end of its columns.
  void write(CellWriter& cells, std::string_view text) const;
};
CellPlace place_of(const Block& block, const DecodedCard& card, const Cell& cell);
/// The span of a part of a block's header.
Span span_in_header(const Block& block, std::string_view part);

/// Puts the text of a cell into the columns of `field`, shortened if necessary; false: it does not
/// fit.
bool carry(const Cell& cell, const Field& field, std::string& line);

/// Puts texts into cells. A line in free format does not grow beyond the columns that are read.
class CellEdits {
 public:
  CellEdits(const SourceSet& sources, std::vector<TextEdit>& out) : sources_(sources), out_(out) {}
  /// Columns that a text of the cell may have after those put before.
  int room(const CellPlace& place) const;
  /// The new text ends where the old one did. False: there is no room for it.
  bool put(const CellPlace& place, const std::string& text);

 private:
  using LineKey = std::uint64_t;
  static LineKey key_of(const Line& line) { return (LineKey{line.file} << 40) ^ line.offset; }
  const SourceSet& sources_;
  std::vector<TextEdit>& out_;
  std::unordered_map<LineKey, int> grown_;  // columns that lines in free format have more
};

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

/// The data lines of a bulk block (nodes, elements): an item may take several.
class ItemLines {
 public:
  ItemLines(const Deck& deck, const Block& block);
  /// The next line. False: there is none.
  bool next_line();
  /// The next item that has all its lines. False: there is none.
  bool next();

  const std::vector<const CardSchema*>& cards() const { return cards_; }
  /// Lines of the item up to the last one that was read, and which of its cards that is.
  const std::vector<Line>& lines() const { return lines_; }
  const Line& line() const { return lines_.back(); }
  std::size_t row() const { return lines_.size() - 1; }
  /// False: the cells of a line are not simply its columns; decoded() has them.
  bool plain(std::size_t row) const;
  DecodedCard decoded(std::size_t row) const;

 private:
  const Deck& deck_;
  const Block& block_;
  LineCursor cursor_;
  std::vector<const CardSchema*> cards_;
  std::vector<Line> lines_;
};

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

/// The places of names of parameters (without the &): in cells, headers and expressions.
using ParameterPlaces = std::map<std::string, std::vector<Span>, std::less<>>;
ParameterPlaces find_parameters(const Deck& deck);

/// Refusals for includes that could not be read: converting only part of a deck would corrupt it.
std::vector<std::string> unread_files(const Deck& deck);

/// Refusals for files that the deck includes more than once and whose copies would get different
/// edits.
std::vector<std::string> contradicting_copies(const SourceSet& sources,
                                              const std::vector<TextEdit>& edits);

// ---- coordinates of nodes (node_cells.cpp) -----------------------------------------------------

/// Finds the cells with the coordinates of nodes, and prints new coordinates into them (printing
/// can round).
class NodeCells {
 public:
  explicit NodeCells(const LoadedDeck& context);
  /// Finds the lines of these nodes; those known already cost nothing.
  void look_up(std::span<const NodeIndex> nodes);
  /// Why the coordinates of a node that was looked up cannot be changed on its line; empty: they
  /// can.
  const std::string& obstacle(NodeIndex n) const { return known_.at(n).obstacle; }
  /// The line of a node that was looked up; invalid: it was not found.
  Span line(NodeIndex n) const {
    return known_.at(n).line.valid() ? known_.at(n).line.whole() : Span{};
  }

  /// The text for `value` in the cell of coordinate `axis`, and the number that reading this text
  /// gives. nullopt: it does not fit.
  struct Printed {
    std::string text;
    double value = 0;
  };
  std::optional<Printed> print(NodeIndex n, int axis, double value) const;
  /// Puts the text of a coordinate into its cell.
  void write(CellWriter& cells, NodeIndex n, int axis, std::string_view text) const {
    known_.at(n).places[static_cast<std::size_t>(axis)].write(cells, text);
  }
  /// Edits for new texts per node and axis.
  std::vector<TextEdit> edits(const std::map<std::pair<NodeIndex, int>, std::string>& texts) const;

 private:
  struct Cells {
    Line line;
    std::array<CellPlace, 3> places;
    double factor = 1;
    std::array<double, 3> offset{};  ///< from the line to the model: noise of /RANDOM
    std::string obstacle;
  };
  Cells read(NodeIndex n, const Block& block, const Span& line) const;
  const LoadedDeck& context_;
  std::unordered_map<NodeIndex, Cells> known_;
  std::set<std::string> twice_;  ///< files included more than once
  std::set<NodeIndex> merged_;   ///< nodes that /CNODE merges with another
  bool noise_only_ = false;      ///< only /RANDOM moves nodes away from their coordinates
};

// ---- one value into one block (block_edit.cpp) -------------------------------------------------

/// The edits that set one value. The caller's CellWriter fills an existing cell in fixed columns;
/// every other change is an edit of lines.
struct BlockEdit {
  std::vector<TextEdit> edits;
  bool read_again = false;  ///< read the deck again before the next value: cells depend on this
  std::string note;         ///< digits were lost
};

/// The error "file:line:column: /KEYWORD/id field: why".
Error block_error(const Deck& deck, const Block& block, Span place, std::string_view field,
                  const std::string& why);

/// Puts `value` into the cell called `field`, `occurrence` cells of that name later. On an error
/// nothing is collected. `absent` is set where the block as it is has no such cell.
Result<BlockEdit> set_value(const Deck& deck, const Block& block, std::string_view field,
                            const CellValue& value, int occurrence, CellWriter& cells,
                            bool& absent);

/// Edits that remove the header and the lines of a block up to its last data line. Error: some of
/// them are in an included file.
Result<std::vector<TextEdit>> erase_block(const Deck& deck, const Block& block);
/// Edits that put blocks before /END of the main file.
std::vector<TextEdit> insert_blocks(const Deck& deck, std::string_view blocks);

// ---- layouts of a keyword (target_layout.cpp) --------------------------------------------------

/// True if a card or cell of `schema` exists in only one of the versions.
bool layout_differs(const Schema& schema, int a, int b);
/// One name for a cell that was renamed between versions.
std::string_view canonical_name(std::string_view field);
/// Only zeros, points and signs, or nothing.
bool is_zero_text(std::string_view text);

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
  bool is_met(const CardSchema& card, int round) const;
  bool is_met(const std::vector<Condition>& when, int round) const;
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
