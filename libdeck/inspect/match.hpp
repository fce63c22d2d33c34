// Counterparts of the entities of one deck in another. Private to inspection.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "inspect/families.hpp"
#include "inspect/shared/diff.hpp"

namespace deck::detail {

/// A block that a comparison looks at.
struct Item {
  const Block* block = nullptr;
  std::string space;  ///< kind, or keyword where the kind says nothing
  std::int64_t id = 0;
  std::string title;
};

struct Counterparts {
  std::vector<Item> items_a, items_b;
  std::vector<std::uint32_t> block_to_b;                   ///< by items_a; no_index: none
  std::vector<std::uint32_t> node_to_b;                    ///< by NodeIndex of the first deck
  std::array<std::vector<std::uint32_t>, 8> element_to_b;  ///< by ElementKind
  std::map<std::pair<std::string, std::int64_t>, std::int64_t> id_to_b;  ///< blocks, by space

  /// The id in the second deck of what the first calls `id`; 0: none.
  std::int64_t mapped(const DiffSide& a, const DiffSide& b, std::string_view kind,
                      std::int64_t id) const;
};

/// Pairs everything. `length`: factor from lengths of the first deck to lengths of the second.
Counterparts find_counterparts(const DiffSide& a, const DiffSide& b, MatchBy match, double length);

}  // namespace deck::detail
