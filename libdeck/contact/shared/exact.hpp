// Exact distances of nodes, segments and edges by CGAL's exact numbers, about 20 microseconds per
// pair. Oracle of tests and accuracy measurements.
#pragma once

#include <array>

#include "contact/shared/closest.hpp"

namespace deck {

// Exact closest point of a node and a segment, rounded once to double.
struct ExactSegment {
  double distance = 0.0;          // nearest double of the exact distance (within half an ulp)
  double distance_squared = 0.0;  // largest double not above it
  int best = 0;                   // sub-triangle, first of exact ties
  std::array<double, 4> weights{};
  Point3<double> vector;  // from the closest point to the node
};

struct ExactEdges {
  double distance = 0.0;
  double distance_squared = 0.0;
  double weight_s = 0.0, weight_m = 0.0;
  bool parallel = false;
  Point3<double> vector;
};

// The robust form evaluated exactly. Finite coordinates only.
ExactSegment exact_closest_on_segment(const Point3<double>& p,
                                      const std::array<Point3<double>, 4>& corners, bool triangle);
ExactEdges exact_closest_between_edges(const Point3<double>& s1, const Point3<double>& s2,
                                       const Point3<double>& m1, const Point3<double>& m2);

// Sign of (exact distance - limit).
int exact_compare_distance(const Point3<double>& p, const std::array<Point3<double>, 4>& corners,
                           bool triangle, double limit);
int exact_compare_distance(const Point3<double>& s1, const Point3<double>& s2,
                           const Point3<double>& m1, const Point3<double>& m2, double limit);

namespace detail {

// True if p and q lie strictly on either side of the plane of abc and pq meets the triangle.
bool passes_through(const Point3<double>& p, const Point3<double>& q, const Point3<double>& a,
                    const Point3<double>& b, const Point3<double>& c);

}  // namespace detail

}  // namespace deck
