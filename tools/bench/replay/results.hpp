// Computes the result columns of recorded states with the kernel.
#pragma once
#include <string>
#include <vector>

#include "replay/replay.hpp"
#include "replay/states.hpp"
#include "replay/table.hpp"

namespace deck::cycle::detail {

/// Columns compared as one vector: "F" is F_x, F_y and F_z.
struct ColumnGroup {
  std::string name;
  std::vector<std::string> columns;
  bool force = false;  ///< zero rows are relative to K0 gap
};
/// Complete groups of a kind in the states; the main result first.
std::vector<ColumnGroup> column_groups(const Table& table, const std::string& kind);

/// Computes the results for the rows of one interface (0: all); `error`: missing input.
ResultTable compute_results(const ContactCard& card, const Table& table, const std::string& kind,
                            const ReplayOptions& options, std::string& error);

}  // namespace deck::cycle::detail
