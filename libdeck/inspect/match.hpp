// What a comparison of two decks is made of: counterparts of the entities of one deck in the other,
// names for the cells of blocks, cells of elements, equal numbers, and functions as they are used.
// Private to inspection.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "deck/keyword.hpp"
#include "deck/model.hpp"
#include "inspect/shared/diff.hpp"
#include "model/shared/families.hpp"

namespace deck::detail {

/// The keyword of a block for people, known or not.
inline std::string shown_keyword(const Block& b) {
  return b.schema != nullptr ? b.schema->keyword : std::string(b.keyword);
}

/// Keyword of a family, for people.
inline const char* keyword_of_family(ElementKind kind) {
  constexpr const char* keywords[] = {"/SHELL", "/SH3N",  "/BRICK", "/QUAD",
                                      "/TRIA",  "/TRUSS", "/BEAM",  "/SPRING"};
  return keywords[static_cast<std::size_t>(kind)];
}

/// A block that a comparison looks at.
struct DeckItem {
  const Block* block = nullptr;
  std::string space;  ///< kind, or keyword where the kind says nothing
  std::int64_t id = 0;
  std::string title;
};

struct Counterparts {
  std::vector<DeckItem> items_a, items_b;
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

/// Field, round of repeated cards, and which cell of that name in the round. Two versions that have
/// a cell on different lines give it the same key.
using CellKey = std::tuple<std::string, int, int>;

/// The key of every cell of a block.
inline std::map<const Cell*, CellKey> cell_keys(const DecodedBlock& d) {
  std::map<const Cell*, CellKey> keys;
  std::map<std::pair<std::string_view, int>, int> count;
  for (const DecodedCard& card : d.cards)
    for (const Cell& cell : card.cells) {
      const std::string& name = cell.field->name;
      keys.emplace(&cell, CellKey{name, card.round, count[{name, card.round}]++});
    }
  return keys;
}

/// A cell that is not 0: an angle, a component of a direction, a skew, a third node.
struct ElementCell {
  const Field* field = nullptr;
  double real = 0;
  std::int64_t id = 0;  ///< cells of ids and integers, with the offset of a submodel
};

/// By family and index of the element: the cells of its rows that the model does not hold.
/// Elements without such a cell have no entry.
using ElementCells = std::array<std::unordered_map<std::uint32_t, std::vector<ElementCell>>, 8>;

/// Numbers are equal within a share of the larger one, or of the size of what they belong to: for
/// coordinates and lengths the size of the model, for points of a function its largest value.
class EqualNumbers {
 public:
  explicit EqualNumbers(double tolerance) : tolerance_(tolerance) {}

  /// `rounded`: one of them was multiplied by a factor of units, which rounds in itself.
  bool operator()(double x, double y, double size, bool rounded) {
    if (x == y || (std::isnan(x) && std::isnan(y))) return true;
    const double apart = std::abs(x - y), larger = std::max(std::abs(x), std::abs(y));
    const bool by_rounding = rounded && apart <= unit_rounding * larger;
    if (by_rounding) return true;
    const bool equal = apart <= tolerance_ * std::max(larger, size);
    if (equal) ++used_;
    if (!equal && apart <= nearly * larger) ++nearly_equal_;
    return equal;
  }

  double tolerance() const { return tolerance_; }
  /// Pairs that only the tolerance made equal.
  std::size_t used() const { return used_; }
  /// Pairs that differ by less than `nearly` of their value.
  std::size_t nearly_equal() const { return nearly_equal_; }

  static constexpr double nearly = 1e-9;

 private:
  /// What the products of a few factors of units lose.
  static constexpr double unit_rounding = 1e-12;
  double tolerance_;
  std::size_t used_ = 0, nearly_equal_ = 0;
};

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
  bool tables_ = false;  ///< some /TABLE, which is not read, may use the points unscaled
  States states_a_, states_b_;
  std::set<std::pair<const Block*, CellKey>> same_cells_;
};

}  // namespace deck::detail
