// Closest points of a node and a segment, and of two edges, in two forms: the reference solver's
// formulas, guard for guard, and a robust one without absolute floors.
//
// Templates on the number type: the same text runs as float, double, double-double, interval and
// exact rational. Types without a square root (NumberTraits<T>::has_sqrt == false) get squared
// distances only and compare those.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "deck/base/point3.hpp"

namespace deck {

// Which formulas are used.
enum class Form : std::uint8_t {
  reference,  // the published solver's, with its absolute floors 1e-30 and 1e-20
  robust      // exact closest point, relative guards only, residual form of the distance
};

// The part of a segment that holds its closest point. Index (0-based):
// face: sub-triangle; edge: i joins corner i and i+1; corner: i; spoke: joins the centre and
// corner i; centre: 0. A triangle has no spokes and no centre; its edges are 0, 1, 2 as well.
enum class Feature : std::uint8_t { face, edge, corner, spoke, centre };

// Closest point on one sub-triangle O, A, B (centre, corner k, corner k+1) of a segment.
template <class T>
struct SubTriangleClosest {
  T weight_o{}, weight_a{}, weight_b{};  // closest point = sum of weight * vertex
  Point3<T> vector;                      // from the closest point to the node, not normalised
  T distance_squared{};
  T distance{};  // left 0 where the number type has no square root
};

// Closest point on a segment: the four sub-triangles and the best of them.
template <class T>
struct SegmentClosest {
  std::array<SubTriangleClosest<T>, 4> sub;
  int best = 0;  // sub-triangle with the smallest distance, the first of ties
  Feature feature = Feature::face;
  int feature_index = 0;
  std::array<T, 4> weights{};  // of the four corners, sum 1; a triangle's fourth is 0
  const SubTriangleClosest<T>& closest() const { return sub[static_cast<std::size_t>(best)]; }
  const T& distance() const { return closest().distance; }
  const T& distance_squared() const { return closest().distance_squared; }
};

// Initial penetration of a node-segment pair.
template <class T>
struct Penetration {
  T value{};                // max over the sub-triangles of max(0, gap - distance); > 0: penetrated
  int sub = 0;              // first sub-triangle that has that value
  Point3<T> normal;         // unit vector from the segment to the node; zero if the node is on it
  bool on_surface = false;  // the distance is exactly 0: no direction exists
};

enum class EdgeFeature : std::uint8_t { interior, first_node, second_node };

// Closest points of two edges.
template <class T>
struct EdgeClosest {
  T weight_s{}, weight_m{};  // weight of the *first* node of the secondary and the main edge
  Point3<T> vector;          // from the main point to the secondary point, not normalised
  T distance_squared{};
  T distance{};  // left 0 where the number type has no square root
  EdgeFeature feature_s = EdgeFeature::interior, feature_m = EdgeFeature::interior;
  bool parallel = false;  // robust form: parallel and overlapping, middle of the overlap taken
};

// Closest point of node `p` on a segment with corners `x` (in order; triangle: x[3] == x[2] and
// `triangle` set). Quads are four triangles round the mean of the corners.
//
// Form::reference follows the reference solver operation by operation: it is the exact closest
// point except for sub-triangles whose area is 0 or round-off. Form::robust is the closest point in
// exact arithmetic; scaling the input by a power of two scales the answer and changes no decision.
//
//   const auto c = deck::closest_on_segment<deck::Form::reference>(p, corners, false);
//   if (c.distance() < gap) ...
template <Form F, class T>
SegmentClosest<T> closest_on_segment(const Point3<T>& p, const std::array<Point3<T>, 4>& x,
                                     bool triangle);

// Penetration of that node for pair gap `gap`. Needs a number type with a square root.
template <class T>
Penetration<T> penetration(const SegmentClosest<T>& closest, const T& gap);

// Closest points of edge s1-s2 and edge m1-m2.
//
// Form::reference: one fixed-point sweep with floors 1e-20 (a valid pair of points, not always
// the closest for nearly parallel edges). Form::robust: the closest points; parallel edges that
// overlap meet in the middle of the overlap.
template <Form F, class T>
EdgeClosest<T> closest_between_edges(const Point3<T>& s1, const Point3<T>& s2, const Point3<T>& m1,
                                     const Point3<T>& m2);

}  // namespace deck

#include "deck/contact/detail/closest_forms.hpp"
