// Distance and contact decision of a pair in several arithmetics.
#include "distance/tiers.hpp"

#include <cmath>
#include <limits>

#include "contact/shared/dd.hpp"

namespace deck::bench {
namespace {

// One number type and formula; `textbook`: distance by subtracting the closest point.
template <class T, Form F, bool textbook = false>
Outcome evaluate(const PairSample& s, FilterCounters&) {
  std::array<Point3<T>, 5> x;
  for (std::size_t k = 0; k < 5; ++k) x[k] = cast<T>(s.x[k]);
  Outcome out;
  // Coordinates outside of the number type: no answer.
  if constexpr (std::is_same_v<T, float>) {
    for (const Point3<T>& q : x) {
      if (std::isfinite(deck::largest_component(q))) continue;
      out.value = std::numeric_limits<double>::quiet_NaN();
      return out;
    }
  }
  T distance;
  if (s.edges) {
    const auto c = closest_between_edges<F>(x[0], x[1], x[2], x[3]);
    distance = c.distance;
    if constexpr (textbook) {
      const Point3<T> a = c.weight_s * x[0] + (T(1) - c.weight_s) * x[1];
      const Point3<T> b = c.weight_m * x[2] + (T(1) - c.weight_m) * x[3];
      distance = deck::length(a - b);
    }
  } else {
    const auto c = closest_on_segment<F>(x[4], {x[0], x[1], x[2], x[3]}, s.triangle);
    distance = c.distance();
    if constexpr (textbook) {
      Point3<T> q = c.weights[0] * x[0];
      for (std::size_t k = 1; k < 4; ++k) q = q + c.weights[k] * x[k];
      distance = deck::length(x[4] - q);
    }
  }
  out.value = static_cast<double>(distance);
  out.closer = distance < T(s.gap);
  return out;
}

bool decide(const PairSample& s, FilterCounters& counters) {
  return s.edges ? is_closer_than(s.x[0], s.x[1], s.x[2], s.x[3], s.gap, &counters)
                 : is_closer_than(s.x[4], s.corners(), s.triangle, s.gap, &counters);
}

Outcome robust_decision(const PairSample& s, FilterCounters& counters) {
  return {0.0, decide(s, counters)};
}

constexpr Form by_robust = Form::robust, by_reference = Form::reference;

const Tier all_tiers[] = {
    {"float", "distance", evaluate<float, by_robust>},
    {"double", "distance", evaluate<double, by_robust, true>},
    {"double-residual", "distance", evaluate<double, by_robust>},
    {"reference", "distance", evaluate<double, by_reference>},
    {"double-double", "distance", evaluate<DoubleDouble, by_robust>},
    {"interval", "distance", interval, true},
    {"exact", "distance", exact, true},
    {"robust", "decision", robust_decision},
};

}  // namespace

std::span<const Tier> tiers() { return all_tiers; }

}  // namespace deck::bench
