// Tools for comparing two decks: counterparts of entities, names for cells of blocks, cells of
// elements, equality of numbers, functions by their uses.
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

/// Keyword of a block, known or not.
inline std::string shown_keyword(const Block& b) {
  return b.schema != nullptr ? b.schema->keyword : std::string(b.keyword);
}

inline const char* keyword_of_family(ElementKind kind) {
  constexpr const char* keywords[] = {"/SHELL", "/SH3N",  "/BRICK", "/QUAD",
                                      "/TRIA",  "/TRUSS", "/BEAM",  "/SPRING"};
  return keywords[static_cast<std::size_t>(kind)];
}

/// A block to be compared.
struct DeckItem {
  const Block* block = nullptr;
  std::string space;  ///< kind, or keyword if the kind is empty
  std::int64_t id = 0;
  std::string title;
};

struct Counterparts {
  std::vector<DeckItem> items_a, items_b;
  std::vector<std::uint32_t> block_to_b;                   ///< by items_a; no_index: none
  std::vector<std::uint32_t> node_to_b;                    ///< by NodeIndex of the first deck
  std::array<std::vector<std::uint32_t>, 8> element_to_b;  ///< by ElementKind
  std::map<std::pair<std::string, std::int64_t>, std::int64_t> id_to_b;  ///< blocks, by space

  /// Id in the second deck of `id` of the first; 0 if none.
  std::int64_t mapped(const DiffSide& a, const DiffSide& b, std::string_view kind,
                      std::int64_t id) const;
};

/// Matches all items. `length`: factor from lengths of the first deck to lengths of the second.
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

/// By family and index of an element: cells of its rows that the model does not store. Elements
/// without such cells have no entry.
using ElementCells = std::array<std::unordered_map<std::uint32_t, std::vector<ElementCell>>, 8>;

/// Numbers are equal within a share of the larger one, or of a scale: for coordinates and lengths
/// the size of the model, for points of a function its largest value.
class EqualNumbers {
 public:
  explicit EqualNumbers(double tolerance) : tolerance_(tolerance) {}

  /// `rounded`: one of them was multiplied by a unit factor, which is rounded itself.
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
  /// Number of pairs that are equal only within the tolerance.
  std::size_t used() const { return used_; }
  /// Number of pairs that differ by less than `nearly` of their value.
  std::size_t nearly_equal() const { return nearly_equal_; }

  static constexpr double nearly = 1e-9;

 private:
  /// Round-off of products of a few unit factors.
  static constexpr double unit_rounding = 1e-12;
  double tolerance_;
  std::size_t used_ = 0, nearly_equal_ = 0;
};

class FunctionUses {
 public:
  /// Compares the uses of every pair of blocks.
  FunctionUses(const DiffSide& a, const DiffSide& b, const Counterparts& pairs, double tolerance);

  /// True if the cell of a block of the first deck acts only on curves that are equal in both
  /// decks.
  bool same_cell(const Block& block, const CellKey& key) const {
    return same_cells_.contains({&block, key});
  }
  /// True if all uses of both functions were compared: their points need no comparison.
  bool same_points(std::int64_t id_a, std::int64_t id_b) const;
  /// True if a function without counterpart gives all its uses the curves that they have in the
  /// other deck.
  bool only_a_copy(std::int64_t id, bool of_second) const;
  /// Number of pairs that are equal only within the tolerance.
  std::size_t within_tolerance() const { return equal_.used(); }

 private:
  struct Quantity;
  struct Named;
  struct SpringRow;
  struct Use;
  struct State {
    bool used = false;
    bool all_equal = true;
    bool points_differ = false;  ///< in a use with equal scales
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
  bool tables_ = false;  ///< a /TABLE (which deck does not read) may use the points unscaled
  States states_a_, states_b_;
  std::set<std::pair<const Block*, CellKey>> same_cells_;
};

}  // namespace deck::detail
