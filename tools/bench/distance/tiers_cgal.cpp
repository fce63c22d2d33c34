// CGAL's number types in the same formulas: intervals that know when they do not know, and
// rationals.
#include <CGAL/Interval_nt.h>

#include <cmath>

#include "contact/shared/exact_number.hpp"
#include "distance/tiers.hpp"

namespace deck::bench {
namespace {

template <class T, class F>
void run(const PairSample& s, const F& take) {
  std::array<Point3<T>, 5> x;
  for (std::size_t k = 0; k < 5; ++k) x[k] = cast<T>(s.x[k]);
  if (s.edges) {
    const auto c = closest_between_edges<Form::robust>(x[0], x[1], x[2], x[3]);
    take(c.distance_squared);
  } else {
    const auto c = closest_on_segment<Form::robust>(
        x[4], std::array<Point3<T>, 4>{x[0], x[1], x[2], x[3]}, s.triangle);
    take(c.distance_squared());
  }
}

}  // namespace

Outcome exact(const PairSample& s, FilterCounters&) {
  Outcome out;
  run<Rational>(s, [&](const Rational& squared) {
    out.value = rounded_square_root(squared);
    out.closer = s.gap > 0.0 && squared < CGAL::square(Rational(s.gap));
  });
  return out;
}

Outcome interval(const PairSample& s, FilterCounters& counters) {
  using T = CGAL::Interval_nt<false>;
  ++counters.pairs;
  Outcome out;
  try {
    const T::Protector rounding;
    run<T>(s, [&](const T& squared) {
      const T distance = CGAL::sqrt(CGAL::max(T(0), squared));
      out.closer = s.gap > 0.0 && CGAL::make_certain(distance < T(s.gap));
      out.value = 0.5 * (distance.inf() + distance.sup());
      if (!std::isfinite(out.value)) CGAL::make_certain(CGAL::Uncertain<bool>::indeterminate());
    });
    return out;
  } catch (const CGAL::Uncertain_conversion_exception&) {
    // Not this way.
  }
  ++counters.double_double;
  ++counters.exact;
  FilterCounters unused;
  return exact(s, unused);
}

}  // namespace deck::bench
