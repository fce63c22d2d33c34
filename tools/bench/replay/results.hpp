// What the kernel makes of recorded states: every result column of the record, computed again.
#pragma once
#include <string>
#include <vector>

#include "replay/replay.hpp"
#include "replay/states.hpp"
#include "replay/table.hpp"

namespace deck::cycle::detail {

/// Result columns that belong together, compared as one vector: "F" is F_x, F_y and F_z.
struct ColumnGroup {
  std::string name;
  std::vector<std::string> columns;
  bool force = false;  ///< zero rows are measured by K0 gap
};
/// The groups of a kind that the states have in full; the first one is the kind's main result.
std::vector<ColumnGroup> column_groups(const Table& table, const std::string& kind);

/// Computes the result columns of the rows of one interface (0: all); `error` says what is missing.
ResultTable compute_results(const ContactCard& card, const Table& table, const std::string& kind,
                            const ReplayOptions& options, std::string& error);

}  // namespace deck::cycle::detail
