// Rule of TYPE25 for two edges of sheets, as numbers without a deck. Templates run in double and in
// exact numbers.
#pragma once
#include <array>
#include <cmath>
#include <type_traits>

#include "base/shared/vec.hpp"
#include "contact/shared/closest.hpp"

namespace deck::detail::type24_25 {

/// Directions are the solver's single-precision values: exact input here.
struct RuleEdge {
  std::array<Vec, 2> end{};
  double gap = 0;
  bool recessed = false;  ///< a free edge: its ends move inward by `inward`
  double inward = 0;
  std::array<Vec, 2> border{};  ///< at each end the sum of the border directions
  Vec beta;                     ///< outward direction of the edge
  bool one_sided = false;       ///< no contact on the side of the sheet
};
struct EdgeRule {
  RuleEdge secondary, main;
  double most_gap = 1e300;  ///< Igap 3
};

/// False: a position is missing, or a direction exceeds single precision.
inline bool is_finite(const EdgeRule& r) {
  const auto all = [&](const RuleEdge& e) {
    return is_finite(e.end[0]) && is_finite(e.end[1]) && is_finite(e.border[0]) &&
           is_finite(e.border[1]) && is_finite(e.beta) && std::isfinite(e.gap) &&
           std::isfinite(e.inward);
  };
  return all(r.secondary) && all(r.main) && std::isfinite(r.most_gap);
}

/// Directions that slant more than this from the plane across an edge are beside it.
constexpr double edge_tilt = 1e-4;

/// An end of a free edge, moved along the border, at most 45 degrees off `beta`.
template <class T, class Root, class DirectionOf>
Point3<T> moved_inward(const Point3<T>& end, const T& by, const Point3<T>& beta, Point3<T> along,
                       const Root& root, const DirectionOf& direction_of) {
  T c = dot(along, beta);
  if (c < T(0)) {
    along = along - T(T(2) * c) * beta;
    c = -c;
  }
  const T size = dot(along, along);
  if (T(T(2) * c * c) < size) along = along + T(root(T(size - c * c)) - c) * beta;
  along = direction_of(along);
  const T share = dot(along, beta);
  return share == T(0) ? end : end - T(by / share) * along;
}

/// Two edges in double.
struct EdgeFigures {
  double penetration = 0, gap = 0;
  EdgeClosest<double> closest;
  bool doubtful = false;  ///< round-off may change if there is a penetration
};
/// `with_doubts`: report doubts.
EdgeFigures evaluate_edges(const EdgeRule& rule, bool with_doubts);

/// Result in exact arithmetic.
struct ExactEdgePair {
  bool penetrates = false;
  double depth = 0, gap = 0, distance = 0;  ///< rounded; depth > 0 if penetrating
};
/// Finite numbers only.
ExactEdgePair exact_edge_pair(const EdgeRule& rule);

}  // namespace deck::detail::type24_25
