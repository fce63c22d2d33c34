// What a fix must leave as it is, and whether it did: no pair penetrates that did not or deeper
// than before, and what is tied stays tied. Private to the stage.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deck/edit.hpp"
#include "edit/fix/nodes/ways_out.hpp"

namespace deck::detail {

/// A pair for which a scene is worse than the one before.
struct Harm {
  PairKey pair;
  std::vector<NodeIndex> nodes;  ///< of both sides
  bool tie = false;              ///< tied and was not, or was and is not any more
  double before = 0, after = 0;  ///< depths; 0: it does not penetrate
};

/// Depths of the pairs that penetrate in a scene, and the pairs that are tied; what a TYPE2 holds
/// is tied whatever the options are. Of the nodes of a TYPE24 or TYPE25, each of which penetrates
/// one segment at most, the segment does not matter.
class StateBefore {
 public:
  StateBefore() = default;
  /// With FixOptions::ties ties of the interfaces asked for count as penetrations.
  StateBefore(const Scene& scene, const FixOptions& options);
  bool contains(const PairKey& pair) const { return rows_.contains(judged(pair)); }
  std::size_t tied_pairs() const;
  std::size_t tied_nodes() const;  ///< secondary ones
  /// Everything that is worse in `now`, a scene of the same deck. Ties first.
  std::vector<Harm> harm(const Scene& now) const;

 private:
  struct Row {
    PairKey pair;
    double depth = 0;
    bool tie = false;
  };
  /// What stands for a pair in a row.
  PairKey judged(PairKey pair) const {
    if (pair.contact < by_node_.size() && by_node_[pair.contact]) pair.main = {};
    return pair;
  }
  void add(const PairKey& pair, double depth, bool tie);
  const FixOptions* options_ = nullptr;
  std::vector<bool> by_node_;  ///< by contact
  /// By judged(), with contacts beyond those of the scene: its ties. As deep as the deepest of
  /// them.
  std::map<PairKey, Row> rows_;
};

/// Takes all of a fix back if the deck read again with it is worse than before, and says so in
/// PenetrationFix::refused. Also counts the ties that it left alone.
void verify_harmless(PenetrationFix& fix, const Interfaces& interfaces, const FixOptions& options,
                     const Scene& before, const Scene& after);

/// Why the fix must not be written; nullopt: it harms nothing. "interface 3, node 17: 0.2 deep,
/// 0.1 before".
std::optional<std::string> harm_text(const Model& model, const Scene& scene,
                                     const std::vector<Harm>& harm);

}  // namespace deck::detail
