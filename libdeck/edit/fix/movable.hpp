// Base of strategies that move nodes.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "deck/contacts.hpp"
#include "edit/cells.hpp"
#include "edit/fix/fix_scene.hpp"
#include "edit/fix/harm.hpp"
#include "edit/fix/nodes/ways_out.hpp"
#include "edit/shared/depenetrate.hpp"

namespace deck::detail {

/// Reason why a node may not move.
enum class PinReason : std::uint8_t {
  none,
  locked_part,
  not_selected,  ///< --only other parts
  rigid_body,
  boundary,
  not_writable,  ///< see NodeCells::obstacle
  share,         ///< its part would exceed its share of moved nodes
  displacement,  ///< moved as far as it may
  crossed,       ///< belongs to a crossed element already
  would_cross,
  would_invert,
  would_shrink,
  would_penetrate,
  would_untie,
  depth,      ///< moved by the depth of its penetration, or needs more
  bystander,  ///< in no penetration
};
const char* to_string(PinReason reason);

/// Reasons from the options. Error: an unknown part, or a card with commas.
Result<std::vector<std::uint8_t>> find_pinned_nodes(const LoadedDeck& context,
                                                    const MoveNodesOptions& options);

/// Reason why a pair was not treated, and FixRefusal::next.
struct RefusalReason {
  std::string text, next = {};
};

inline constexpr const char* inside_solid =
    "the node is inside a solid: the way out is not the way to its surface; separate the parts "
    "first";

/// A deck with its own copy of the model, whose nodes move; the deck does not change.
class MovableDeck {
 protected:
  MovableDeck(const LoadedDeck& context, const MoveNodesOptions& options);
  MovableDeck(const MovableDeck&) = delete;
  MovableDeck& operator=(const MovableDeck&) = delete;
  ~MovableDeck() = default;

  /// Contacts and ties at the present positions, with Inacti 0 (see fix_scene). The object is
  /// reused by the next call.
  const Scene& evaluate();

  /// Contacts before any move; stores pinned nodes and the state that must not get worse. Error:
  /// bad options, or a wanted interface that cannot be evaluated.
  Result<Scene> prepare();
  void place(NodeIndex n, const Vec& p);
  /// Prints new coordinates of a node and moves it to the printed position. False: one does not fit
  /// its cell, or none is new.
  bool put(NodeIndex n, const Vec& to);
  void put_back(NodeIndex n);
  using ReasonOf = std::function<RefusalReason(const Scene&, const PairAt&)>;
  /// Reads the deck again with the printed coordinates. The result has counts, moved nodes, and per
  /// penetrating secondary item one line with the reason of its deepest pair. Error: the deck
  /// cannot be read, or is worse than before.
  Result<PenetrationFix> make_result(const Scene& before, const std::vector<NodeIndex>& moved,
                                     const ReasonOf& reason_of);

  const LoadedDeck& context_;
  const MoveNodesOptions& options_;
  Model model_;
  Interfaces interfaces_;
  Coordinates start_, now_;
  NodeCells cells_;
  std::vector<std::uint8_t> pinned_;  ///< reason by node
  std::optional<FixMesh> mesh_;
  StateBefore baseline_;                     ///< penetrations and ties before
  std::vector<Crossing> crossed_;            ///< before: edges through main segments
  std::vector<FixMesh::Crossed> crossings_;  ///< before: in the whole mesh
  std::map<PairKey, std::string> skipped_;   ///< pairs that moving cannot solve, with reasons
  PenetrationFix fix_;

 private:
  void report(const Scene& before, const Scene& after, const std::vector<NodeIndex>& moved,
              const ReasonOf& reason_of);

  std::map<std::pair<NodeIndex, int>, std::string> texts_;  ///< of new coordinates
  Scene scene_;
  bool outdated_ = true;  ///< nodes have moved since
};

}  // namespace deck::detail
