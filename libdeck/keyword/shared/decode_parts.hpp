// Shared parts of decoding lines and blocks: findings of one call, and cells of other lines.
// Private to the library.
#pragma once
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/keyword.hpp"
#include "deck/text.hpp"

namespace deck::detail {

/// Findings of one decode call about one block.
class BlockFindings {
 public:
  BlockFindings(Findings* sink, const Block& block) : sink_(sink), block_(block) {}
  bool on() const { return sink_ != nullptr; }
  /// Counts a finding. True: its message is wanted; then call keep().
  bool wants(RuleId rule) { return sink_ != nullptr && sink_->wants(rule); }

  Finding* report(RuleId rule, Span span, std::string message, Overrides overrides = {}) {
    return wants(rule) ? keep(rule, span, std::move(message), std::move(overrides)) : nullptr;
  }

  Finding* keep(RuleId rule, Span span, std::string message, Overrides overrides = {}) {
    Finding d = make_finding(rule, span, std::move(message), std::move(overrides));
    d.keyword = std::string(block_.keyword);
    d.id = block_.id.value;
    return &sink_->add(std::move(d));
  }

 private:
  Findings* sink_;
  const Block& block_;
};

/// Access to cells of other lines for conditions, and the length of a list.
struct LineContext {
  const std::function<std::int64_t(std::string_view)>* value = nullptr;
  int cells = 0;  ///< of a list on this line; 0: unknown
};

/// Cells of a line in free format, with their places.
using FreeCells = std::vector<std::pair<std::string_view, Span>>;
/// Separated by commas and blanks; two commas make an empty cell.
FreeCells split_free(const Line& line);
/// True if a comma puts the line into free format. Lines of a single text cell never are.
bool is_free(const Line& line);

DecodedCard decode_in_context(const Deck& deck, const Block& block, const CardSchema& card,
                              const Line& line, Findings* findings, const LineContext& context);

/// Reports a /DEFAULT/INTER block without its blank lines (DK511). True: reported; other findings
/// about its lines would be consequences.
bool report_missing_blank_lines(const Deck& deck, const Block& block, Findings& findings);

// ---- which blank cells mean 1, and by which number a blank cell counts otherwise ---------------

/// The cell `name` that belongs to `cell`: of its line, its repetition, its position in a list, or
/// the only one of the block. nullptr: none.
const Cell* cell_beside(const DecodedBlock& d, const DecodedCard& card, const Cell& cell,
                        std::string_view name);

/// True if the block's input version has this cell (Schema::find_field searches all versions).
bool has_field(const Block& b, std::string_view name);

/// Scale of one axis of the function in `cell`, for one name of Axis::scales.
struct AxisScale {
  const Cell* cell = nullptr;
  bool absent = false;  ///< in this version, but after the last line of the block
  bool counts() const { return cell != nullptr || absent; }
};
AxisScale axis_scale(const DecodedBlock& d, const DecodedCard& card, const Cell& cell,
                     std::string_view name);

/// True if another value of the block is measured by this cell (Field::unit_for).
bool measures(const DecodedBlock& d, const DecodedCard& card, const Cell& cell);

/// Cells of a block that mean 1 in its units if they are 0 or blank.
struct ImpliedOnes {
  std::set<const Cell*> cells;   ///< including cells with a number
  std::set<std::string> absent;  ///< names of such cells on missing lines
};
ImpliedOnes implied_ones(const DecodedBlock& d);

/// The number that a blank means, unless it is a limit like 1e30 or a zero like 1e-30.
std::optional<double> ordinary_default(const Field& f);

/// The cell of that name on a line; nullptr: none.
const Cell* cell_named(const DecodedCard& card, std::string_view field);
/// The cell of that name for a line: of the line, its repetition, or the non-repeated cards.
/// Without a line: the first of the block.
const Cell* cell_beside(const DecodedBlock& block, const DecodedCard* line, std::string_view field);

}  // namespace deck::detail
