// Which parts hang together, so that one cannot be moved without the others. Private to the stage.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "deck/edit/fix.hpp"
#include "deck/front/loaded_deck.hpp"

namespace deck::detail {

class PartGroups {
 public:
  /// Joined are the nodes of an element, of a rigid body, rigid element or joint, of a tie of
  /// /INTER/TYPE2 with its segment, and the pairs of contacts that tie, unless FixOptions::ties
  /// treats these as penetrations.
  PartGroups(const LoadedDeck& context, const Scene& scene, const FixOptions& options);

  std::uint32_t of(NodeIndex n) const { return group_[n]; }
  /// Ascending.
  std::vector<NodeIndex> nodes_of(std::uint32_t group) const;
  /// "part 2", "parts 2, 3 and 4 (they hang together)"
  std::string name_of(std::uint32_t group) const;

 private:
  const Model& model_;
  std::vector<std::uint32_t> group_;
};

}  // namespace deck::detail
