// What the lists that are made from a deck may take at most; what reading it may cost is in Limits.
#pragma once
#include <cstdint>

namespace deck {

struct MemoryLimits {
  std::uint64_t selection_bytes = std::uint64_t{4}
                                  << 30;              ///< members of all groups, surfaces, sets
  std::uint64_t pair_bytes = std::uint64_t{2} << 30;  ///< the list of pairs of one contact
};

}  // namespace deck
