// What decoding of a line and decoding of a block share: the noted of one call, and what
// the cells of a line can know about other lines. Private to the library.
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

/// BlockFindings of one decode call, about one block.
class BlockFindings {
 public:
  BlockFindings(Findings* sink, const Block& block) : sink_(sink), block_(block) {}
  bool on() const { return sink_ != nullptr; }
  /// Counts one finding; true if its message is wanted. Then keep() it.
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

/// How the conditions of the cells of a line find the cells of other lines, and how long a list is.
struct LineContext {
  const std::function<std::int64_t(std::string_view)>* value = nullptr;
  int cells = 0;  ///< of a list, on this line; 0: not known
};

/// Cells of a line in free format, with their places.
using FreeCells = std::vector<std::pair<std::string_view, Span>>;
/// Commas and blanks separate, two commas make an empty cell.
FreeCells split_free(const Line& line);
/// True if a comma puts the line into free format. Lines of a single text cell never are.
bool is_free(const Line& line);

DecodedCard decode_in_context(const Deck& deck, const Block& block, const CardSchema& card,
                              const Line& line, Findings* findings, const LineContext& context);

/// Reports a /DEFAULT/INTER that was written without its lines without content (DK511). True: it
/// was, and what else could be said of its lines would be a consequence.
bool report_missing_blank_lines(const Deck& deck, const Block& block, Findings& findings);

// ---- which blank cells mean 1, and by which number a blank cell counts otherwise ---------------

/// The cell `name` that goes with `cell`: on its line, in its round, at its place of a list, or the
/// only one of the block. nullptr: the block has none.
const Cell* cell_beside(const DecodedBlock& d, const DecodedCard& card, const Cell& cell,
                        std::string_view name);

/// The input version of the block has a cell of that name (Schema::find_field looks in all).
bool has_field(const Block& b, std::string_view name);

/// What scales an axis of the function in `cell`, by one name of Axis::scales.
struct AxisScale {
  const Cell* cell = nullptr;
  bool absent = false;  ///< the version has it, the lines of the block end before it
  bool counts() const { return cell != nullptr || absent; }
};
AxisScale axis_scale(const DecodedBlock& d, const DecodedCard& card, const Cell& cell,
                     std::string_view name);

/// Something of the block is measured by this cell (Field::unit_for).
bool measures(const DecodedBlock& d, const DecodedCard& card, const Cell& cell);

/// Cells of a block that are 1 in its units where they are 0 or blank, because something is scaled
/// or measured by them.
struct ImpliedOnes {
  std::set<const Cell*> cells;   ///< also those that hold a number
  std::set<std::string> absent;  ///< names of such cells whose lines are missing
};
ImpliedOnes implied_ones(const DecodedBlock& d);

/// The number that blank means, if it is one that a model could notice: no bound like 1e30 and no
/// nothing like 1e-30.
std::optional<double> ordinary_default(const Field& f);

/// The cell of that name on a line; nullptr: it has none.
const Cell* cell_named(const DecodedCard& card, std::string_view field);
/// The cell of that name that goes with a line: on it, in its round, or where nothing repeats.
/// Without a line: the first one of the block.
const Cell* cell_beside(const DecodedBlock& block, const DecodedCard* line, std::string_view field);

}  // namespace deck::detail
