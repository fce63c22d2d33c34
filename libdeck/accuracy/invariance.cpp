// The same pair written down in other ways, and one step beside itself: an answer must not notice
// the first, and hardly the second.
#include <cmath>
#include <limits>

#include "accuracy/pair_rewriting.hpp"
#include "accuracy/tiers.hpp"

namespace deck::accuracy {
namespace {

using P = Point3<double>;

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

bool is_invariant(const Tier& tier, const PairSample& s, bool values) {
  FilterCounters unused;
  const Outcome first = tier.run(s, unused);
  for (const PairSample& t : {other_order(s), turned_over(s), other_axes(s)}) {
    const Outcome o = tier.run(t, unused);
    if (o.closer != first.closer || (values && !same(o.value, first.value))) return false;
  }
  for (const int power : {-150, -1, 40, 150}) {
    PairSample t = s;
    if (!scale(t, power)) continue;
    const Outcome o = tier.run(t, unused);
    if (o.closer != first.closer) return false;
    // A distance below the normal numbers was rounded to fewer digits, down to none.
    const double expected = std::ldexp(first.value, power);
    const bool digits = std::isnormal(first.value) && std::isnormal(expected);
    if (values && digits && o.value != expected) return false;
  }
  return true;
}

bool is_continuous(const Tier& tier, const PairSample& s) {
  FilterCounters unused;
  const double before = tier.run(s, unused).value;
  PairSample t = s;
  P& p = t.x[s.edges ? 0 : 4];
  const P from = p;
  p = {std::nextafter(p.x, 1e308), std::nextafter(p.y, -1e308), std::nextafter(p.z, 1e308)};
  const double after = tier.run(t, unused).value, step = deck::length(p - from);
  const double larger = std::max(std::abs(before), std::abs(after));
  const double ulp = std::nextafter(larger, std::numeric_limits<double>::infinity()) - larger;
  return std::abs(after - before) <= 1.001 * step + 4.0 * ulp;
}

}  // namespace deck::accuracy
