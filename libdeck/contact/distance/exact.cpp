// Exact distances: the closest-point templates on GMP rationals.
#include "contact/distance/exact.hpp"

#include "contact/distance/exact_rational.hpp"

namespace deck {
namespace {

using Q = mpq_class;

Point3<Q> lift(const Point3<double>& p) { return {Q(p.x), Q(p.y), Q(p.z)}; }

std::array<Point3<Q>, 4> lift(const std::array<Point3<double>, 4>& x) {
  return {lift(x[0]), lift(x[1]), lift(x[2]), lift(x[3])};
}

Point3<double> lower(const Point3<Q>& p) { return {p.x.get_d(), p.y.get_d(), p.z.get_d()}; }

SegmentClosest<Q> exact_segment(const Point3<double>& p, const std::array<Point3<double>, 4>& x,
                                bool triangle) {
  return closest_on_segment<Form::robust>(lift(p), lift(x), triangle);
}

EdgeClosest<Q> exact_edges(const Point3<double>& s1, const Point3<double>& s2,
                           const Point3<double>& m1, const Point3<double>& m2) {
  return closest_between_edges<Form::robust>(lift(s1), lift(s2), lift(m1), lift(m2));
}

int compare(const Q& distance_squared, double limit) {
  if (limit < 0.0) return 1;
  const Q l(limit);
  return sgn(Q(distance_squared - l * l));
}

}  // namespace

mpq_class exact_distance_squared(const Point3<double>& p,
                                 const std::array<Point3<double>, 4>& corners, bool triangle) {
  return exact_segment(p, corners, triangle).distance_squared();
}
mpq_class exact_distance_squared(const Point3<double>& s1, const Point3<double>& s2,
                                 const Point3<double>& m1, const Point3<double>& m2) {
  return exact_edges(s1, s2, m1, m2).distance_squared;
}

double rounded_depth(double gap, const mpq_class& squared) {
  // g - d = (g^2 - d^2) / (g + d): nothing cancels that is not exact.
  const mpq_class g(gap), difference = g * g - squared;
  if (gap <= 0.0 || sgn(difference) <= 0) return 0.0;
  constexpr mp_bitcnt_t kBits = 256;
  const mpf_class d = sqrt(mpf_class(squared, kBits));
  const mpf_class depth = mpf_class(difference, kBits) / (mpf_class(g, kBits) + d);
  // A depth below all numbers is still one.
  return std::max(depth.get_d(), std::numeric_limits<double>::denorm_min());
}

double rounded_square_root(const mpq_class& value) {
  if (sgn(value) <= 0) return 0.0;
  // floor(sqrt(value * 4^shift)) with at least 60 significant bits, plus a sticky bit.
  const auto bits = [](const mpz_class& z) {
    return static_cast<long>(mpz_sizeinbase(z.get_mpz_t(), 2));
  };
  const long shift = 64 - (bits(value.get_num()) - bits(value.get_den())) / 2;
  mpq_class scaled = value;
  if (shift >= 0) {
    mpq_mul_2exp(scaled.get_mpq_t(), scaled.get_mpq_t(), static_cast<mp_bitcnt_t>(2 * shift));
  } else {
    mpq_div_2exp(scaled.get_mpq_t(), scaled.get_mpq_t(), static_cast<mp_bitcnt_t>(-2 * shift));
  }
  const mpz_class whole = scaled.get_num() / scaled.get_den();
  mpz_class root = sqrt(whole);
  const bool inexact = root * root != scaled;
  // Round to nearest even at 53 bits (fewer for subnormal results).
  const long exponent = bits(root) - shift;  // value < 2^exponent
  const long keep = std::min(53L, exponent + 1074);
  const long drop = bits(root) - keep;
  if (keep < 0) return 0.0;
  mpz_class high = root >> static_cast<mp_bitcnt_t>(drop);
  const mpz_class low = root - (high << static_cast<mp_bitcnt_t>(drop));
  const mpz_class half = mpz_class(1) << static_cast<mp_bitcnt_t>(drop - 1);
  const int side = cmp(low, half);
  if (side > 0 || (side == 0 && (inexact || mpz_odd_p(high.get_mpz_t()) != 0))) high += 1;
  return std::ldexp(high.get_d(), static_cast<int>(drop - shift));
}

ExactSegment exact_closest_on_segment(const Point3<double>& p,
                                      const std::array<Point3<double>, 4>& corners, bool triangle) {
  const SegmentClosest<Q> c = exact_segment(p, corners, triangle);
  ExactSegment out;
  out.distance = rounded_square_root(c.distance_squared());
  out.distance_squared = c.distance_squared().get_d();
  out.best = c.best;
  out.feature = c.feature;
  out.feature_index = c.feature_index;
  for (std::size_t k = 0; k < 4; ++k) out.weights[k] = c.weights[k].get_d();
  out.vector = lower(c.closest().vector);
  return out;
}

ExactEdges exact_closest_between_edges(const Point3<double>& s1, const Point3<double>& s2,
                                       const Point3<double>& m1, const Point3<double>& m2) {
  const EdgeClosest<Q> c = exact_edges(s1, s2, m1, m2);
  return {rounded_square_root(c.distance_squared),
          c.distance_squared.get_d(),
          c.weight_s.get_d(),
          c.weight_m.get_d(),
          c.feature_s,
          c.feature_m,
          c.parallel,
          lower(c.vector)};
}

int exact_compare_distance(const Point3<double>& p, const std::array<Point3<double>, 4>& corners,
                           bool triangle, double limit) {
  return compare(exact_segment(p, corners, triangle).distance_squared(), limit);
}

int exact_compare_distance(const Point3<double>& s1, const Point3<double>& s2,
                           const Point3<double>& m1, const Point3<double>& m2, double limit) {
  return compare(exact_edges(s1, s2, m1, m2).distance_squared, limit);
}

}  // namespace deck
