// Distances and contact decisions that are never wrong: double with a rigorous error bound first,
// double-double where that leaves a doubt, exact rationals where that does too.
#pragma once

#include <array>
#include <cstdint>

#include "contact/shared/closest.hpp"

namespace deck {

// The arithmetic that gave the answer.
enum class FilterStage : std::uint8_t { double_precision, double_double, exact };

// How often which arithmetic was needed. Add up over threads by +=.
struct FilterCounters {
  std::uint64_t pairs = 0;
  std::uint64_t double_double = 0;  // pairs that went on to double-double, or beyond
  std::uint64_t exact = 0;          // pairs that needed exact rationals
  FilterCounters& operator+=(const FilterCounters& other) {
    pairs += other.pairs;
    double_double += other.double_double;
    exact += other.exact;
    return *this;
  }
};

struct FilteredSegment {
  double distance = 0.0;  // the double nearest to the exact distance
  Feature feature = Feature::face;
  int feature_index = 0;
  std::array<double, 4> weights{};  // of the four corners
  FilterStage stage = FilterStage::double_double;
};

struct FilteredEdges {
  double distance = 0.0;  // the double nearest to the exact distance
  double weight_s = 0.0, weight_m = 0.0;
  EdgeFeature feature_s = EdgeFeature::interior, feature_m = EdgeFeature::interior;
  FilterStage stage = FilterStage::double_double;
};

// Sign of (gap - distance), decided on the given doubles without any rounding: true if and only if
// the exact distance is smaller than `gap`. Finite coordinates; a gap that is NaN, zero or negative
// is never undercut. Conventions of closest_on_segment and closest_between_edges.
//
// The bounds: any point of the segment gives an upper bound of the distance; for any direction w,
// min over the vertices of w.(node - vertex) / |w| gives a lower one. Both are evaluated with
// their round-off added, so a wrong closest point costs time, never a wrong answer.
bool is_closer_than(const Point3<double>& p, const std::array<Point3<double>, 4>& corners,
                    bool triangle, double gap, FilterCounters* counters = nullptr);
bool is_closer_than(const Point3<double>& s1, const Point3<double>& s2, const Point3<double>& m1,
                    const Point3<double>& m2, double gap, FilterCounters* counters = nullptr);

// True if and only if the exact distance is 0: the node lies on the segment, the edges meet. Finite
// coordinates.
bool is_touching(const Point3<double>& p, const std::array<Point3<double>, 4>& corners,
                 bool triangle);
bool is_touching(const Point3<double>& s1, const Point3<double>& s2, const Point3<double>& m1,
                 const Point3<double>& m2);

// Penetration of a pair: depth = gap - distance, both within a relative error of 2e-12 as long as
// they are normal numbers. The depth is above 0 if and only if the pair is closer than its gap;
// otherwise both are 0.
struct FilteredDepth {
  double depth = 0.0;
  double distance = 0.0;
  FilterStage stage = FilterStage::double_precision;
};
FilteredDepth filtered_depth(const Point3<double>& p, const std::array<Point3<double>, 4>& corners,
                             bool triangle, double gap, FilterCounters* counters = nullptr);
FilteredDepth filtered_depth(const Point3<double>& s1, const Point3<double>& s2,
                             const Point3<double>& m1, const Point3<double>& m2, double gap,
                             FilterCounters* counters = nullptr);

// The correctly rounded distance. Weights and feature are those of the arithmetic that
// certified it.
FilteredSegment filtered_closest_on_segment(const Point3<double>& p,
                                            const std::array<Point3<double>, 4>& corners,
                                            bool triangle, FilterCounters* counters = nullptr);
FilteredEdges filtered_closest_between_edges(const Point3<double>& s1, const Point3<double>& s2,
                                             const Point3<double>& m1, const Point3<double>& m2,
                                             FilterCounters* counters = nullptr);

}  // namespace deck
