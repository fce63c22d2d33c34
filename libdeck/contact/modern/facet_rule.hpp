// What a TYPE25 makes of one node and one segment, as numbers without a deck, and its decisions in
// exact arithmetic: which pair of a node counts, and whether it is a penetration.
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

/// The pair that counts: the nearest of those that are not left out. Of equally near ones round-off
/// chooses, and any is right: one that the solver's answer may be about, then the last.
struct ExactChoice {
  std::uint32_t pair = 0;  ///< position in the list
  bool penetrates = false;
  double distance = 0, gap = 0;  ///< rounded once
  double depth = 0;              ///< rounded towards zero, but above 0 where it is
};
/// nullopt: all are left out. Finite numbers only.
std::optional<ExactChoice> exact_choice(std::span<const FacetRule> pairs, bool solver_penetrates);

}  // namespace deck::detail::modern
