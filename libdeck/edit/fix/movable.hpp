// What strategies that move nodes work on. Private to the stage.
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
#include "edit/fix/common.hpp"
#include "edit/fix/harm.hpp"
#include "edit/fix/nodes/ways_out.hpp"
#include "edit/shared/depenetrate.hpp"

namespace deck::detail {

/// Why a node may not move.
enum class Hold : std::uint8_t {
  none,
  locked_part,
  not_selected,  ///< --only other parts
  rigid_body,
  boundary,
  not_writable,  ///< NodeCells::obstacle says why
  share,         ///< its part would need more moved nodes than may
  displacement,  ///< moved as far as it may
  crossed,       ///< belongs to a crossed element already
  would_cross,
  would_invert,
  would_shrink,
  would_penetrate,
  would_untie,
  depth,      ///< moved as far as the penetration is deep, or would have to move farther
  bystander,  ///< in no penetration: stays
};
const char* to_string(Hold hold);

/// Holds from the options. Error: an unknown part, or a card with commas.
Result<std::vector<std::uint8_t>> make_holds(const LoadedDeck& context,
                                             const MoveNodesOptions& options);

/// Why a pair was not treated, and FixRefusal::next.
struct Reason {
  std::string text, next = {};
};

inline constexpr const char* inside_solid =
    "the node is inside a solid: the way out is not the way to its surface; separate the parts "
    "first";

/// A deck with a model of its own, whose nodes move; the deck itself stays as it is.
class MovableDeck {
 protected:
  MovableDeck(const LoadedDeck& context, const MoveNodesOptions& options);
  MovableDeck(const MovableDeck&) = delete;
  MovableDeck& operator=(const MovableDeck&) = delete;
  ~MovableDeck() = default;

  /// The contacts and ties with the nodes where they are now, as the deck puts them (see
  /// fix_scene); one object for all calls.
  const Scene& evaluate();

  /// The contacts before anything moves; keeps what may not move and what must not get worse.
  /// Error: bad options, or a wanted interface that cannot be evaluated.
  Result<Scene> prepare();
  void place(NodeIndex n, const Vec& p);
  /// Prints new coordinates of a node and places it where they are when they are read. False: one
  /// does not fit its cell, or none is new.
  bool put(NodeIndex n, const Vec& to);
  void put_back(NodeIndex n);
  using ReasonOf = std::function<Reason(const Scene&, const PairAt&)>;
  /// Reads the deck again with what was printed. The fix has counts, moved nodes, and one line per
  /// secondary node or edge that still penetrates, with the reason of its deepest pair. Error: the
  /// deck cannot be read, or is worse than before.
  Result<PenetrationFix> finish(const Scene& before, const std::vector<NodeIndex>& moved,
                                const ReasonOf& reason_of);

  const LoadedDeck& context_;
  const MoveNodesOptions& options_;
  Model model_;
  Interfaces interfaces_;
  Coordinates start_, now_;
  NodeCells cells_;
  std::vector<std::uint8_t> holds_;  ///< by node: a Hold
  std::optional<FixMesh> mesh_;
  StateBefore baseline_;                     ///< penetrations and ties before
  std::vector<Crossing> crossed_;            ///< before: of edges with main segments
  std::vector<FixMesh::Crossed> crossings_;  ///< before: of the whole mesh
  std::map<PairKey, std::string> skipped_;   ///< pairs that moving cannot solve, and why
  PenetrationFix fix_;

 private:
  void report(const Scene& before, const Scene& after, const std::vector<NodeIndex>& moved,
              const ReasonOf& reason_of);

  std::map<std::pair<NodeIndex, int>, std::string> texts_;  ///< of new coordinates
  Scene scene_;
  bool outdated_ = true;  ///< nodes were placed since
};

}  // namespace deck::detail
