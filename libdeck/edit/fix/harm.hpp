// Verification that a fix does no harm: no new or deeper penetration, and all ties stay.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deck/edit.hpp"
#include "edit/fix/nodes/ways_out.hpp"

namespace deck::detail {

/// A pair that is worse than in the scene before.
struct HarmedPair {
  PairKey pair;
  std::vector<NodeIndex> nodes;  ///< of both sides
  bool tie = false;              ///< tied now but not before, or the reverse
  double before = 0, after = 0;  ///< depths; 0: no penetration
};

/// Depths of the penetrating pairs of a scene, and its tied pairs (TYPE2 ties regardless of the
/// options). Nodes of a TYPE24 or TYPE25 penetrate one segment at most; which one is ignored.
class StateBefore {
 public:
  StateBefore() = default;
  /// With FixOptions::ties ties of the wanted interfaces count as penetrations.
  StateBefore(const Scene& scene, const FixOptions& options);
  bool contains(const PairKey& pair) const { return rows_.contains(judged(pair)); }
  std::size_t tied_pairs() const;
  std::size_t tied_nodes() const;  ///< number of secondary nodes
  /// All pairs that are worse in `now`, a scene of the same deck. Ties first.
  std::vector<HarmedPair> harm(const Scene& now) const;

 private:
  struct DepthRow {
    PairKey pair;
    double depth = 0;
    bool tie = false;
  };
  /// Key of a pair in `rows_`.
  PairKey judged(PairKey pair) const {
    if (pair.contact < by_node_.size() && by_node_[pair.contact]) pair.main = {};
    return pair;
  }
  void add(const PairKey& pair, double depth, bool tie);
  const FixOptions* options_ = nullptr;
  std::vector<bool> by_node_;  ///< by contact
  /// By judged(); contact numbers beyond the scene's are its ties. Depth of the deepest pair.
  std::map<PairKey, DepthRow> rows_;
};

/// Cancels a fix if the deck with it is worse than before, and says so in PenetrationFix::refused.
/// Counts the ties left alone.
void verify_harmless(PenetrationFix& fix, const Interfaces& interfaces, const FixOptions& options,
                     const Scene& before, const Scene& after);

/// Reason against writing the fix; nullopt if it does no harm. "interface 3, node 17: 0.2 deep, 0.1
/// before".
std::optional<std::string> harm_text(const Model& model, const Scene& scene,
                                     const std::vector<HarmedPair>& harm);

}  // namespace deck::detail
