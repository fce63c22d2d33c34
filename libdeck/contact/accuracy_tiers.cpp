// Measurement of the distance in several arithmetics: time per pair, and errors against exact
// rationals.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include "contact/dd.hpp"
#include "contact/exact.hpp"
#include "deck/contact/accuracy.hpp"
#include "deck/contact/filtered.hpp"

namespace deck {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// What one tier says about one pair.
struct Outcome {
  double distance = 0.0;
  bool closer = false;
  bool has_distance = true;
  int feature = -1;                 // number of the part of the segment or the two edges; -1: none
  std::array<double, 4> weights{};  // of the closest point; edges: [0] secondary, [1] main
};

int number_of(Feature feature, int index) { return 8 * static_cast<int>(feature) + index; }
int number_of(EdgeFeature s, EdgeFeature m) {
  return 64 + 8 * static_cast<int>(s) + static_cast<int>(m);
}

template <class T>
Point3<T> cast(const Point3<double>& p) {
  return {T(p.x), T(p.y), T(p.z)};
}

// One arithmetic and form, with the coordinates as they are or seen from the first one (`local`),
// the distance from the formula itself or by subtracting the closest point (`textbook`).
template <class T, Form F, bool local = false, bool textbook = false>
Outcome evaluate(const PairSample& s, FilterCounters&) {
  std::array<Point3<T>, 5> x;
  for (std::size_t k = 0; k < 5; ++k) x[k] = cast<T>(local ? s.x[k] - s.x[0] : s.x[k]);
  Outcome out;
  // Coordinates that the number type cannot hold: the tier has no answer.
  if constexpr (std::is_same_v<T, float>) {
    for (const Point3<T>& q : x) {
      if (std::isfinite(closest_detail::largest_component(q))) continue;
      out.distance = std::numeric_limits<double>::quiet_NaN();
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
      distance = closest_detail::length(a - b);
    }
    out.feature = number_of(c.feature_s, c.feature_m);
    out.weights = {static_cast<double>(c.weight_s), static_cast<double>(c.weight_m), 0.0, 0.0};
  } else {
    const auto c = closest_on_segment<F>(x[4], {x[0], x[1], x[2], x[3]}, s.triangle);
    distance = c.distance();
    if constexpr (textbook) {
      Point3<T> q = c.weights[0] * x[0];
      for (std::size_t k = 1; k < 4; ++k) q = q + c.weights[k] * x[k];
      distance = closest_detail::length(x[4] - q);
    }
    out.feature = number_of(c.feature, c.feature_index);
    for (std::size_t k = 0; k < 4; ++k) out.weights[k] = static_cast<double>(c.weights[k]);
  }
  out.distance = static_cast<double>(distance);
  out.closer = distance < T(s.gap);
  return out;
}

bool decide(const PairSample& s, FilterCounters& counters) {
  return s.edges ? is_closer_than(s.x[0], s.x[1], s.x[2], s.x[3], s.gap, &counters)
                 : is_closer_than(s.x[4], s.corners(), s.triangle, s.gap, &counters);
}

Outcome robust_decision(const PairSample& s, FilterCounters& counters) {
  Outcome out;
  out.closer = decide(s, counters);
  out.has_distance = false;
  return out;
}

Outcome robust_distance(const PairSample& s, FilterCounters& counters) {
  Outcome out;
  if (s.edges) {
    const auto c = filtered_closest_between_edges(s.x[0], s.x[1], s.x[2], s.x[3], &counters);
    out.distance = c.distance;
    out.feature = number_of(c.feature_s, c.feature_m);
    out.weights = {c.weight_s, c.weight_m, 0.0, 0.0};
  } else {
    const auto c = filtered_closest_on_segment(s.x[4], s.corners(), s.triangle, &counters);
    out.distance = c.distance;
    out.feature = number_of(c.feature, c.feature_index);
    out.weights = c.weights;
  }
  // Rounding is monotone: the digits behind matter only where the rounded distance is the gap.
  FilterCounters again;
  out.closer = out.distance == s.gap ? decide(s, again) : out.distance < s.gap;
  return out;
}

Outcome exact(const PairSample& s, FilterCounters&) {
  Outcome out;
  if (s.edges) {
    const auto c = exact_closest_between_edges(s.x[0], s.x[1], s.x[2], s.x[3]);
    out.distance = c.distance;
    out.feature = number_of(c.feature_s, c.feature_m);
  } else {
    const auto c = exact_closest_on_segment(s.x[4], s.corners(), s.triangle);
    out.distance = c.distance;
    out.feature = number_of(c.feature, c.feature_index);
  }
  out.closer = out.distance < s.gap;
  if (out.distance == s.gap && s.gap > 0.0) {
    const int side = s.edges ? exact_compare_distance(s.x[0], s.x[1], s.x[2], s.x[3], s.gap)
                             : exact_compare_distance(s.x[4], s.corners(), s.triangle, s.gap);
    out.closer = side < 0;
  }
  return out;
}

struct Tier {
  const char* name;
  const char* what;
  Outcome (*run)(const PairSample&, FilterCounters&);
  bool slow;
};

const Tier kTiers[] = {
    {"float", "distance", evaluate<float, Form::robust>, false},
    {"float-local", "distance", evaluate<float, Form::robust, true>, false},
    {"double", "distance", evaluate<double, Form::robust, false, true>, false},
    {"double-residual", "distance", evaluate<double, Form::robust>, false},
    {"reference", "distance", evaluate<double, Form::reference>, false},
    {"double-double", "distance", evaluate<DoubleDouble, Form::robust>, false},
    {"robust", "gaps", robust_decision, false},
    {"robust", "distance", robust_distance, false},
    {"exact", "distance", exact, true},
};

double relative_error(double got, double want) {
  if (got == want) return 0.0;
  if (!std::isfinite(got) || want == 0.0) return kInfinity;
  return std::abs(got - want) / want;
}

double error_in_ulp(double got, double want) {
  if (got == want) return 0.0;
  if (!std::isfinite(got)) return kInfinity;
  return std::abs(got - want) / (std::nextafter(want, kInfinity) - want);
}

// The point a tier names, measured exactly: how far is it from the other side?
double distance_of_weights(const PairSample& s, const Outcome& o) {
  using D = DoubleDouble;
  const auto x = [&](std::size_t k) { return cast<D>(s.x[k]); };
  const D w0(o.weights[0]), w1(o.weights[1]);
  Point3<D> v;
  if (s.edges) {
    v = (x(1) - x(3)) + w0 * (x(0) - x(1)) - w1 * (x(2) - x(3));
  } else {
    for (std::size_t k = 0; k < 4; ++k) v = v + D(o.weights[k]) * (x(k) - x(4));
  }
  return closest_detail::length(v).hi();
}

// Largest difference of coordinates.
double size_of(const PairSample& s) {
  double out = 0.0;
  for (std::size_t k = 1; k < (s.edges ? 4u : 5u); ++k)
    out = std::max(out, closest_detail::largest_component(s.x[k] - s.x[0]));
  return out;
}

// Another part than the exact one, whose own point is farther than round-off of weights explains.
bool wrong_feature(const PairSample& s, const Outcome& got, const Outcome& want) {
  if (got.feature < 0 || got.feature == want.feature) return false;
  const double found = distance_of_weights(s, got);
  if (!std::isfinite(found)) return true;
  const double epsilon = std::numeric_limits<double>::epsilon();
  return found - want.distance > 4.0 * epsilon * (want.distance + 4.0 * size_of(s));
}

double relative_error_to(double size, double got, double want) {
  if (!std::isfinite(got) || !(size > 0.0)) return kInfinity;
  return std::abs(got - want) / size;
}

struct Errors {
  double relative = 0.0, ulp = 0.0, scaled = 0.0;
  std::uint64_t decisions = 0, features = 0, non_finite = 0, samples = 0;

  void add(const PairSample& s, const Outcome& got, const Outcome& want) {
    ++samples;
    decisions += got.closer != want.closer;
    if (!got.has_distance) return;
    non_finite += !std::isfinite(got.distance);
    relative = std::max(relative, relative_error(got.distance, want.distance));
    ulp = std::max(ulp, error_in_ulp(got.distance, want.distance));
    features += wrong_feature(s, got, want);
    if (got.distance != want.distance)
      scaled = std::max(scaled, relative_error_to(size_of(s), got.distance, want.distance));
  }
};

// Median over the repeats of the time per pair. The sum keeps the work from being left out.
double time_of(const Tier& tier, std::span<const PairSample> samples, int repeats) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> times;
  volatile double sink = 0.0;
  for (int r = 0; r < std::max(1, repeats); ++r) {
    FilterCounters counters;
    double sum = 0.0;
    const auto start = Clock::now();
    for (const PairSample& s : samples) {
      const Outcome o = tier.run(s, counters);
      sum += o.distance + static_cast<double>(o.closer);
    }
    const std::chrono::duration<double, std::nano> spent = Clock::now() - start;
    sink = sink + sum;
    times.push_back(spent.count() / static_cast<double>(samples.size()));
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

// Every n-th sample, so that all families are there.
std::vector<PairSample> thinned(std::span<const PairSample> samples, std::size_t limit) {
  std::vector<PairSample> out;
  const std::size_t step = samples.size() / std::max<std::size_t>(1, limit) + 1;
  for (std::size_t k = 0; k < samples.size(); k += step) out.push_back(samples[k]);
  return out;
}

void mark_dominated(std::vector<TierResult>& tiers) {
  for (TierResult& a : tiers) {
    for (const TierResult& b : tiers) {
      if (&a == &b || a.what != b.what) continue;
      const bool no_worse =
          b.ns_per_pair <= a.ns_per_pair && b.max_relative_error <= a.max_relative_error &&
          b.max_scaled_error <= a.max_scaled_error && b.decision_errors <= a.decision_errors;
      const bool better =
          b.ns_per_pair < a.ns_per_pair || b.max_relative_error < a.max_relative_error ||
          b.max_scaled_error < a.max_scaled_error || b.decision_errors < a.decision_errors;
      a.dominated |= no_worse && better;
    }
  }
}

bool has_family_rows(const Tier& tier) {
  const std::string_view name = tier.name, what = tier.what;
  return what == "distance" && (name == "reference" || name == "robust");
}

void add_family_rows(AccuracyReport& report, const Tier& tier,
                     const std::vector<Errors>& families) {
  for (const HardFamily& f : hard_families()) {
    const Errors& e = families[static_cast<std::size_t>(f.id)];
    if (e.samples == 0) continue;
    report.families.push_back({f.id, f.name, f.expected, tier.name, e.samples, e.relative, e.ulp,
                               e.decisions, e.non_finite});
  }
}

}  // namespace

AccuracyReport measure_accuracy(std::span<const PairSample> samples,
                                const AccuracyOptions& options) {
  AccuracyReport report;
  report.scene = !samples.empty() && samples[0].family > 0 ? "hard-cases" : "deck";
  if (samples.empty()) return report;
  std::vector<Outcome> truth;
  truth.reserve(samples.size());
  FilterCounters unused;
  for (const PairSample& s : samples) truth.push_back(exact(s, unused));
  const std::vector<PairSample> few = thinned(samples, options.slow_limit);
  for (const Tier& tier : kTiers) {
    Errors errors;
    std::vector<Errors> families(64);
    FilterCounters counters;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const PairSample& s = samples[k];
      const Outcome got = tier.slow ? truth[k] : tier.run(s, counters);
      errors.add(s, got, truth[k]);
      families[static_cast<std::size_t>(s.family) % 64].add(s, got, truth[k]);
    }
    TierResult row;
    row.name = tier.name;
    row.what = tier.what;
    row.samples = errors.samples;
    row.ns_per_pair = tier.slow ? time_of(tier, few, 1) : time_of(tier, samples, options.repeats);
    row.max_relative_error = errors.relative;
    row.max_ulp = errors.ulp;
    row.max_scaled_error = errors.scaled;
    row.decision_errors = errors.decisions;
    row.feature_errors = errors.features;
    row.non_finite = errors.non_finite;
    if (counters.pairs > 0) {
      const auto pairs = static_cast<double>(counters.pairs);
      row.fallback_share = static_cast<double>(counters.double_double) / pairs;
      row.exact_share = static_cast<double>(counters.exact) / pairs;
    }
    report.tiers.push_back(row);
    if (has_family_rows(tier)) add_family_rows(report, tier, families);
  }
  mark_dominated(report.tiers);
  return report;
}

}  // namespace deck
