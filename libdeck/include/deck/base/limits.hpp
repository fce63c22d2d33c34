// What a hostile or broken deck may cost at most: every bound on reading it and on what is made of
// it. How many lines a report shows is a matter of the report; what recursion may cost of the stack
// is fixed where it recurses.
#pragma once
#include <cstddef>
#include <cstdint>

namespace deck {

/// An argument everywhere, with safe defaults.
struct Limits {
  std::uint64_t total_bytes = std::uint64_t{64} << 30;    ///< all files of the include tree
  std::uint64_t map_threshold = std::uint64_t{32} << 20;  ///< larger files are mapped, not read
  std::uint64_t stdin_bytes = std::uint64_t{4} << 30;     ///< standard input has no size to check
  std::uint64_t unpacked_bytes = std::uint64_t{4} << 30;  ///< text of packed files, kept in memory
  std::uint64_t unpacked_ratio = 100;  ///< more text than this times the file (and 64 MiB): no deck
  int include_depth = 100;             ///< the reference solver stops at about 10
  int files = 10000;
  std::size_t blocks = 20'000'000;
  int diagnostics_per_rule = 1000;  ///< further ones are counted, not kept
  int expression_steps = 10000;     ///< parameter expressions
  std::uint64_t selection_bytes = std::uint64_t{4}
                                  << 30;              ///< members of all groups, surfaces, sets
  std::uint64_t pair_bytes = std::uint64_t{2} << 30;  ///< the list of pairs of one contact
};

}  // namespace deck
