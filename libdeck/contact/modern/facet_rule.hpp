// What a TYPE25 makes of one node and one segment, as numbers without a deck, and its decisions in
// exact arithmetic: whether the solver looks at the pair, which pair of a node counts, and whether
// it is a penetration.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/shared/vec.hpp"

namespace deck::detail::modern {

/// Directions of sides and borders are what the solver has in single precision: they are given, not
/// rounded results.
struct FacetRule {
  enum class Kind : std::uint8_t { solid, coat, sheet };
  Vec node;
  std::array<Vec, 4> corner{};  ///< triangle: last two equal
  bool triangle = false;
  Kind kind = Kind::sheet;
  int ishape = 1;
  std::array<double, 4> corner_gap{};
  double node_gap = 0, most_gap = 1e300;  ///< Igap 3
  std::array<bool, 4> free{};             ///< sides without a neighbour
  std::array<Vec, 4> beta{};              ///< direction of each side
  std::array<bool, 4> border{};           ///< corners on a border
  std::array<Vec, 4> first{}, second{};   ///< directions of the border there
  std::array<Vec, 4> both{};              ///< and the mean of these
};

/// False: there is no place, or single precision could not hold a direction.
inline bool is_finite(const FacetRule& r) {
  const auto finite = [](const Vec& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  bool all = finite(r.node) && std::isfinite(r.node_gap) && std::isfinite(r.most_gap);
  for (std::size_t k = 0; k < 4; ++k)
    all = all && finite(r.corner[k]) && finite(r.beta[k]) && finite(r.first[k]) &&
          finite(r.second[k]) && finite(r.both[k]) && std::isfinite(r.corner_gap[k]);
  return all;
}

/// The solver's grid: cells along each axis of a box.
struct SearchGrid {
  std::array<double, 3> low{}, size{}, cells{};
};
/// How far the solver looks around a segment. Each is a sum of numbers that it has.
struct LookRule {
  Vec node;
  std::array<Vec, 4> corner{};
  bool triangle = false;
  std::array<double, 3> box{};    ///< the box of the segment reaches so far: two gaps, a length
  std::array<double, 3> cells{};  ///< and in the grid
  double most_gap = 1e300;        ///< Igap 3: the distance counts with this in place of the gaps
};
/// Whether the pair is looked at. Finite numbers only.
bool is_looked_at(const LookRule& rule, const SearchGrid& grid);
/// Whether a node lies in the box of a segment that reaches so far, in sum. Finite numbers only.
bool is_in_box(const Vec& node, const std::array<Vec, 4>& corner,
               const std::array<double, 3>& reach);

/// What becomes of the pairs of a node. In general the nearest of those that are not left out
/// counts. Of equally near ones round-off chooses, and any is right: one that the solver's answer
/// may be about, then the last. With adhesion (IVIS2 -1) a pair takes the place of the one before
/// it if its squared distance is no more than what that one stores.
struct ExactChoice {
  std::uint32_t pair = 0;  ///< position in the list
  bool penetrates = false;
  double distance = 0, gap = 0;  ///< rounded once
  double depth = 0;              ///< rounded towards zero, but above 0 where it is
};
/// nullopt: all are left out. Finite numbers only.
std::optional<ExactChoice> exact_choice(std::span<const FacetRule> pairs, bool solver_penetrates,
                                        bool adhesion = false);

}  // namespace deck::detail::modern
