// CGAL's number types in the same formulas: intervals that know when they do not know, and lazily
// exact numbers.
#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Lazy_exact_nt.h>
#include <gmpxx.h>

#include <cmath>

#include "accuracy/tiers.hpp"
#include "contact/distance/exact_rational.hpp"

namespace deck {

template <>
struct NumberTraits<CGAL::Lazy_exact_nt<CGAL::Gmpq>> {
  static constexpr bool has_sqrt = false;
  static constexpr bool is_machine_float = false;
  static CGAL::Lazy_exact_nt<CGAL::Gmpq> parallel_guard() { return 0; }
};

namespace accuracy {
namespace {

template <class T, class F>
void run(const PairSample& s, Outcome& out, const F& take) {
  std::array<Point3<T>, 5> x;
  for (std::size_t k = 0; k < 5; ++k) x[k] = cast<T>(s.x[k]);
  if (s.edges) {
    const auto c = closest_between_edges<Form::robust>(x[0], x[1], x[2], x[3]);
    out.feature = number_of(c.feature_s, c.feature_m);
    take(c.distance_squared);
    out.weights = {CGAL::to_double(c.weight_s), CGAL::to_double(c.weight_m), 0.0, 0.0};
  } else {
    const auto c = closest_on_segment<Form::robust>(
        x[4], std::array<Point3<T>, 4>{x[0], x[1], x[2], x[3]}, s.triangle);
    out.feature = number_of(c.feature, c.feature_index);
    take(c.distance_squared());
    for (std::size_t k = 0; k < 4; ++k) out.weights[k] = CGAL::to_double(c.weights[k]);
  }
}

}  // namespace

Outcome lazy_exact(const PairSample& s, FilterCounters&) {
  using T = CGAL::Lazy_exact_nt<CGAL::Gmpq>;
  Outcome out;
  run<T>(s, out, [&](const T& squared) {
    out.value = rounded_square_root(mpq_class(squared.exact().mpq()));
    out.closer = s.gap > 0.0 && squared < T(s.gap) * T(s.gap);
  });
  return out;
}

Outcome interval(const PairSample& s, FilterCounters& counters) {
  using T = CGAL::Interval_nt<false>;
  ++counters.pairs;
  Outcome out;
  try {
    const T::Protector rounding;
    run<T>(s, out, [&](const T& squared) {
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

}  // namespace accuracy
}  // namespace deck
