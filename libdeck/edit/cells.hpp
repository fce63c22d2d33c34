// Tools for rewriting a deck: find cells and set their text, add and remove lines, lay out a block
// for another input version, find words outside schemas and names of parameters.
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

/// Position of a cell.
struct CellPlace {
  const Block* block = nullptr;
  Span span;
  std::string_view field;
  Line line;
  int first = 0, last = 0;  ///< columns, unless free_format
  bool free_format = false;
  /// Columns available for a text. In free format the cells behind it need room as well.
  int room() const;
  /// Writes a text, right-aligned.
  void write(CellWriter& cells, std::string_view text) const;
};
CellPlace place_of(const Block& block, const DecodedCard& card, const Cell& cell);
Span span_in_header(const Block& block, std::string_view part);

/// Copies the text of a cell into the columns of `field`, shortened if necessary; false if it does
/// not fit.
bool copy_cell_text(const Cell& cell, const Field& field, std::string& line);

/// Sets texts of cells. A line in free format does not grow beyond the columns that are read.
class CellEdits {
 public:
  CellEdits(const SourceSet& sources, std::vector<TextEdit>& out) : sources_(sources), out_(out) {}
  /// Columns available for a text of the cell after the earlier edits.
  int room(const CellPlace& place) const;
  /// The new text ends where the old one did. False: no room.
  bool put(const CellPlace& place, const std::string& text);

 private:
  using LineKey = std::uint64_t;
  static LineKey key_of(const Line& line) { return (LineKey{line.file} << 40) ^ line.offset; }
  const SourceSet& sources_;
  std::vector<TextEdit>& out_;
  std::unordered_map<LineKey, int> grown_;  // by line: extra columns of lines in free format
};

/// Edits of whole lines; several insertions at one place keep their order.
class LineEdits {
 public:
  explicit LineEdits(const SourceSet& sources) : sources_(sources) {}
  /// Replaces the line's text; edits only the bytes that differ.
  void change(const Line& line, const std::string& text, std::vector<TextEdit>& out) const;
  /// Removes the line with its line end.
  void remove(const Line& line, std::vector<TextEdit>& out) const;
  /// Inserts a line behind the one with `anchor`, after earlier insertions there.
  void insert_after(Span anchor, const std::string& text);
  /// Appends the insertions, in file order.
  void append_to(std::vector<TextEdit>& out) const;

 private:
  const SourceSet& sources_;
  std::map<std::pair<std::uint32_t, std::uint64_t>, std::string> inserted_;
};

/// Data lines of a bulk block (nodes, elements); an item may have several.
class ItemLines {
 public:
  ItemLines(const Deck& deck, const Block& block);
  /// False at the end.
  bool next_line();
  /// Next complete item; false at the end.
  bool next();

  const std::vector<const CardSchema*>& cards() const { return cards_; }
  /// Lines of the item up to the last one read.
  const std::vector<Line>& lines() const { return lines_; }
  const Line& line() const { return lines_.back(); }
  std::size_t row() const { return lines_.size() - 1; }
  /// False: cells differ from columns; use decoded().
  bool plain(std::size_t row) const;
  DecodedCard decoded(std::size_t row) const;

 private:
  const Deck& deck_;
  const Block& block_;
  LineCursor cursor_;
  std::vector<const CardSchema*> cards_;
  std::vector<Line> lines_;
};

/// Text that reads in `width` columns, times `factor`, as `value` or as near as possible; nullopt
/// if nothing fits.
std::optional<FormattedReal> cell_text(double value, double factor, int width);

/// True for a block that ends before its title line: a line inserted there would become the title.
bool lacks_title(const DecodedBlock& block);

/// Calls found(line, begin, end) with the byte range of each word of a block outside schemas, until
/// it returns true. First overload: of one line, without the `known` columns.
using FoundWord = std::function<bool(const Line& line, std::size_t begin, std::size_t end)>;
bool find_words(const Line& line, const std::bitset<line_columns + 1>& known,
                const FoundWord& found);
void find_undescribed_words(const DecodedBlock& block, const FoundWord& found);

/// Last byte before the end of the main file; invalid if there is none.
Span end_of_main(const Deck& deck);

/// Places of parameter names (without &) in cells, headers and expressions.
using ParameterPlaces = std::map<std::string, std::vector<Span>, std::less<>>;
ParameterPlaces find_parameters(const Deck& deck);

/// Refusals for includes that could not be read: converting only part of a deck would corrupt it.
std::vector<std::string> unread_files(const Deck& deck);

/// Refusals for files that are included more than once and would get different edits.
std::vector<std::string> contradicting_copies(const SourceSet& sources,
                                              const std::vector<TextEdit>& edits);

// ---- coordinates of nodes (node_cells.cpp) -----------------------------------------------------

/// Finds the cells of nodal coordinates and prints new coordinates into them, rounded to the cell.
class NodeCells {
 public:
  explicit NodeCells(const LoadedDeck& context);
  /// Finds the lines of these nodes; repeated calls cost nothing.
  void find_lines(std::span<const NodeIndex> nodes);
  /// Reason why the coordinates of a looked-up node cannot be changed; empty if they can.
  const std::string& obstacle(NodeIndex n) const { return known_.at(n).obstacle; }
  /// Line of a looked-up node; invalid if not found.
  Span line(NodeIndex n) const {
    return known_.at(n).line.valid() ? known_.at(n).line.whole() : Span{};
  }

  /// Text for `value` in the cell of coordinate `axis`, and the number it reads as; nullopt if it
  /// does not fit.
  struct Printed {
    std::string text;
    double value = 0;
  };
  std::optional<Printed> print(NodeIndex n, int axis, double value) const;
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
    std::array<double, 3> offset{};  ///< /RANDOM noise: model minus line
    std::string obstacle;
  };
  Cells read(NodeIndex n, const Block& block, const Span& line) const;
  const LoadedDeck& context_;
  std::unordered_map<NodeIndex, Cells> known_;
  std::set<std::string> twice_;  ///< files included more than once
  std::set<NodeIndex> merged_;   ///< nodes that /CNODE merges with another
  bool noise_only_ = false;      ///< only /RANDOM separates nodes from their written coordinates
};

// ---- one value into one block (block_edit.cpp) -------------------------------------------------

/// Edits that set one value. The caller's CellWriter fills existing cells in fixed columns; every
/// other change edits lines.
struct BlockEdit {
  std::vector<TextEdit> edits;
  bool read_again = false;  ///< read the deck again before the next value
  std::string note;         ///< digits were lost
};

/// The error "file:line:column: /KEYWORD/id field: why".
Error block_error(const Deck& deck, const Block& block, Span place, std::string_view field,
                  const std::string& why);

/// Writes `value` into the cell `field`, `occurrence` cells of that name later. After an error
/// nothing is collected. Sets `absent` if the block has no such cell.
Result<BlockEdit> set_value(const Deck& deck, const Block& block, std::string_view field,
                            const CellValue& value, int occurrence, CellWriter& cells,
                            bool& absent);

/// Edits that remove a block from its header to its last data line. Error: some of its lines are in
/// an included file.
Result<std::vector<TextEdit>> erase_block(const Deck& deck, const Block& block);
/// Edits that insert blocks before /END of the main file.
std::vector<TextEdit> insert_blocks(const Deck& deck, std::string_view blocks);

// ---- layouts of a keyword (target_layout.cpp) --------------------------------------------------

/// True if a card or cell of `schema` exists in only one of the versions.
bool layout_differs(const Schema& schema, int a, int b);
/// Common name of a cell that was renamed between versions.
std::string_view canonical_name(std::string_view field);
/// Only zeros, points and signs, or nothing.
bool is_zero_text(std::string_view text);

struct NewLine {
  const CardSchema* card = nullptr;
  const DecodedCard* old = nullptr;
  int round = 0;  ///< as in DecodedCard
};

/// Cards of a block in version `target`; conditions use its old values, and fields that the new
/// version lacks count as 0.
class TargetLayout {
 public:
  TargetLayout(const Block& block, const DecodedBlock& decoded, int target)
      : block_(block), decoded_(decoded), target_(target) {}

  /// Lines in order, as far as the old block has rounds. Each old line is used once.
  std::vector<NewLine> lines() const;
  std::vector<const Field*> fields(const CardSchema& card, int round) const;
  /// Old cell of that name and round on a line other than `not_here`.
  const Cell* elsewhere(std::string_view field, int round, const DecodedCard* not_here) const;
  /// True if the number of lines of the block decides their meaning.
  bool counts_lines() const;

 private:
  using Group = std::vector<const CardSchema*>;
  bool is_present(const CardSchema& card, int round) const;
  bool is_present(const std::vector<Condition>& when, int round) const;
  bool has_field(std::string_view field) const;
  int rounds(const CardSchema& card) const;
  const DecodedCard* claim_line(const CardSchema& card, int round, std::vector<bool>& used) const;

  const Block& block_;
  const DecodedBlock& decoded_;
  int target_;
};

/// Cell of that name on a line; nullptr if missing.
const Cell* cell_of(const DecodedCard& card, std::string_view field);

}  // namespace deck::detail
