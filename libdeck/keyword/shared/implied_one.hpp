// Which blank cells of a block mean 1, and by which number a blank cell counts otherwise.
#pragma once
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "deck/keyword/decode.hpp"

namespace deck::detail {

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

}  // namespace deck::detail
