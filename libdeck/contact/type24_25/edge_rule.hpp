// What a TYPE25 makes of two edges of sheets, as numbers without a deck. The steps are templates:
// they run in double and in exact numbers.
#pragma once
#include <array>
#include <cmath>
#include <type_traits>

#include "base/shared/vec.hpp"
#include "contact/shared/closest.hpp"

namespace deck::detail::type24_25 {

/// Directions are what the solver has in single precision: they are given, not rounded results.
struct RuleEdge {
  std::array<Vec, 2> end{};
  double gap = 0;
  bool recessed = false;        ///< a free edge: its ends move inward
  double inward = 0;            ///< by so much
  std::array<Vec, 2> border{};  ///< at each end the sum of the directions of the border
  Vec beta;                     ///< of the edge: outward
  bool one_sided = false;       ///< what lies on the sheet's side of it is no contact
};
struct EdgeRule {
  RuleEdge secondary, main;
  double most_gap = 1e300;  ///< Igap 3
};

/// False: there is no place, or single precision could not hold a direction.
inline bool is_finite(const EdgeRule& r) {
  const auto all = [&](const RuleEdge& e) {
    return is_finite(e.end[0]) && is_finite(e.end[1]) && is_finite(e.border[0]) &&
           is_finite(e.border[1]) && is_finite(e.beta) && std::isfinite(e.gap) &&
           std::isfinite(e.inward);
  };
  return all(r.secondary) && all(r.main) && std::isfinite(r.most_gap);
}

/// Slants of more than this from the plane across an edge are beside it.
constexpr double edge_tilt = 1e-4;

/// An end of a free edge, moved along the border but by no more than 45 degrees off `beta`.
/// direction_of(v): v or any multiple of it.
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
  bool doubtful = false;  ///< whether there is a penetration may be round-off
};
/// `weigh`: doubts are asked for.
EdgeFigures evaluate_edges(const EdgeRule& rule, bool weigh);

/// And in exact arithmetic.
struct ExactEdgePair {
  bool penetrates = false;
  double depth = 0, gap = 0, distance = 0;  ///< rounded; depth > 0 where there is a penetration
};
/// Finite numbers only.
ExactEdgePair exact_edge_pair(const EdgeRule& rule);

}  // namespace deck::detail::type24_25
