// Compares functions as those that use them read them: points times the scales on the card.
// Private to inspection.
#pragma once
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "inspect/cell_key.hpp"
#include "inspect/equal_numbers.hpp"
#include "inspect/match.hpp"

namespace deck::detail {

class FunctionUses {
 public:
  /// Looks at the uses of every pair of blocks.
  FunctionUses(const DiffSide& a, const DiffSide& b, const Counterparts& pairs, double tolerance);

  /// The cell of a block of the first deck takes part in curves, and all of them are the same in
  /// both decks.
  bool same_cell(const Block& block, const CellKey& key) const {
    return same_cells_.contains({&block, key});
  }
  /// The points of the two need no comparison of their own: every use of them was compared.
  bool same_points(std::int64_t id_a, std::int64_t id_b) const;
  /// A function of the second (first) deck without counterpart gives all its uses the curves that
  /// they have in the other deck.
  bool only_a_copy(std::int64_t id, bool of_second) const;
  /// Numbers that only the tolerance made equal.
  std::size_t within_tolerance() const { return equal_.used(); }

 private:
  struct Quantity;
  struct Named;
  struct SpringRow;
  struct Use;
  struct State {
    bool used = false;
    bool all_equal = true;
    bool points_differ = false;  ///< in a use all of whose scales are the same
  };
  using States = std::map<std::int64_t, State>;

  void compare(const Block& block_a, const Block& block_b);
  void compare_springs(const Named& a, const Named& b, std::map<CellKey, bool>& scales);
  bool same_curve(const Use& a, const Use& b);
  double in_first(const Quantity& q) const;
  static Quantity axis_of(const Named& n, const DecodedCard& card, const Cell& cell,
                          const Axis& axis, std::vector<CellKey>& scales);
  static std::vector<Use> uses_of(const Named& n);

  const DiffSide& a_;
  const DiffSide& b_;
  EqualNumbers equal_;
  bool tables_ = false;  ///< tables, which nobody reads, may use the points as they are
  States states_a_, states_b_;
  std::set<std::pair<const Block*, CellKey>> same_cells_;
};

}  // namespace deck::detail
