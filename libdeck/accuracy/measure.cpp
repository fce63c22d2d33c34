// Errors of the tiers against exact rationals, and their time per pair.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>

#include "accuracy/tiers.hpp"
#include "contact/shared/dd.hpp"

namespace deck {
namespace {

using accuracy::Outcome;
using accuracy::Tier;
constexpr double infinite_error = std::numeric_limits<double>::infinity();

double relative_error(double got, double want) {
  if (got == want) return 0.0;
  if (!std::isfinite(got) || want == 0.0) return infinite_error;
  return std::abs(got - want) / want;
}

double error_in_ulp(double got, double want) {
  if (got == want) return 0.0;
  if (!std::isfinite(got)) return infinite_error;
  return std::abs(got - want) / (std::nextafter(want, infinite_error) - want);
}

// The point a tier names, measured exactly: how far is it from the other side?
double distance_of_weights(const PairSample& s, const Outcome& o) {
  using D = DoubleDouble;
  const auto x = [&](std::size_t k) { return Point3<D>{s.x[k].x, s.x[k].y, s.x[k].z}; };
  const D w0(o.weights[0]), w1(o.weights[1]);
  Point3<D> v;
  if (s.edges) {
    v = (x(1) - x(3)) + w0 * (x(0) - x(1)) - w1 * (x(2) - x(3));
  } else {
    for (std::size_t k = 0; k < 4; ++k) v = v + D(o.weights[k]) * (x(k) - x(4));
  }
  return deck::length(v).hi();
}

// Largest difference of coordinates.
double size_of(const PairSample& s) {
  double out = 0.0;
  for (std::size_t k = 1; k < (s.edges ? 4u : 5u); ++k)
    out = std::max(out, deck::largest_component(s.x[k] - s.x[0]));
  return out;
}

// Another part than the exact one, whose own point is farther than round-off of weights explains.
bool wrong_feature(const PairSample& s, const Outcome& got, const Outcome& want) {
  if (got.feature < 0 || got.feature == want.feature) return false;
  const double found = distance_of_weights(s, got);
  if (!std::isfinite(found)) return true;
  const double epsilon = std::numeric_limits<double>::epsilon();
  return found - want.value > 4.0 * epsilon * (want.value + 4.0 * size_of(s));
}

// Error of the distance over the size of the pair. A force error counts as the error of the
// distance that would make it.
double scaled_error(const PairSample& s, double got, double want, bool force, double distance) {
  if (got == want) return 0.0;
  const double size = force ? std::max(size_of(s), s.gap) : size_of(s);
  if (!std::isfinite(got) || !(size > 0.0)) return infinite_error;
  const double slope = force ? accuracy::force_slope(distance, s.gap) : 1.0;
  return std::abs(got / slope - want / slope) / size;
}

// How far off a wrong decision was: the error of its distance over the gap or the distance.
double error_of_wrong(const PairSample& s, double got, double want) {
  if (!std::isfinite(got)) return infinite_error;
  const double scale = std::max({s.gap, got, want});
  return scale > 0.0 ? std::abs(got - want) / scale : 0.0;
}

struct Errors {
  double relative = 0.0, ulp = 0.0, scaled = 0.0;
  std::uint64_t decisions = 0, features = 0, non_finite = 0, samples = 0;
  // The wrong decision with the largest error, else the worst distance.
  const PairSample* example = nullptr;
  double got = 0.0, want = 0.0;
  bool example_is_decision = false, want_closer = false;
  double example_error = 0.0;

  void add(const PairSample& s, const Outcome& o, const Outcome& truth, std::string_view what,
           double distance) {
    ++samples;
    const bool wrong = o.closer != truth.closer;
    decisions += wrong;
    const bool values = what != "gaps";
    // Near the end of the exponent range a depth has no digits left that a force could have.
    const bool small = s.gap < 0x1p-900 || (truth.value != 0.0 && !std::isnormal(truth.value));
    const bool digits = what == "distance" || !small;
    const double error = values && digits ? relative_error(o.value, truth.value) : 0.0;
    const double far = wrong ? error_of_wrong(s, o.value, truth.value) : error;
    const bool worse = example == nullptr || far > example_error;
    if (wrong ? !example_is_decision || worse : !example_is_decision && error > relative) {
      example = &s;
      example_is_decision = wrong;
      example_error = far;
      got = o.value;
      want = truth.value;
      want_closer = truth.closer;
    }
    if (!values) return;
    non_finite += !std::isfinite(o.value) && std::isfinite(truth.value);
    if (!digits) return;
    relative = std::max(relative, error);
    ulp = std::max(ulp, error_in_ulp(o.value, truth.value));
    scaled = std::max(scaled, scaled_error(s, o.value, truth.value, what == "force", distance));
    if (what == "distance") features += wrong_feature(s, o, truth);
  }
};

// Time per pair: the median of the timings, and how far below it their lower quartile lies.
struct PairTime {
  double ns = 0.0, spread = 0.0;
};

PairTime median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double middle = values[values.size() / 2];
  return {middle, middle > 0.0 ? (middle - values[values.size() / 4]) / middle : 0.0};
}

/// Nanoseconds per pair of one pass. The sum keeps the work from being left out.
double pass_time(const Tier& tier, std::span<const PairSample> samples) {
  static volatile double sink = 0.0;
  FilterCounters counters;
  double sum = 0.0;
  const double start = accuracy::thread_nanoseconds();
  for (const PairSample& s : samples) {
    const Outcome o = tier.run(s, counters);
    sum += o.value + static_cast<double>(o.closer);
  }
  const double spent = accuracy::thread_nanoseconds() - start;
  sink = sink + sum;
  return spent / static_cast<double>(samples.size());
}

/// Passes of one tier after another over the same samples, again and again: what slows the machine
/// down for a while then slows down all of them, and their ratios stay.
struct InTurn {
  const Tier* tier;
  std::span<const PairSample> samples;
  std::vector<double> ns;
};
void time_in_turn(std::vector<InTurn>& all, int repeats) {
  for (int r = 0; r < std::max(1, repeats); ++r)
    for (InTurn& t : all)
      if (r == 0 || !t.tier->slow) t.ns.push_back(pass_time(*t.tier, t.samples));
}

// Every n-th sample, so that all families are there.
std::vector<PairSample> thinned(std::span<const PairSample> samples, std::size_t limit) {
  std::vector<PairSample> out;
  const std::size_t step = samples.size() / std::max<std::size_t>(1, limit) + 1;
  for (std::size_t k = 0; k < samples.size(); k += step) out.push_back(samples[k]);
  return out;
}

void add_family_rows(std::vector<FamilyResult>& rows, const Tier& tier,
                     const std::vector<Errors>& families) {
  for (const HardFamily& f : hard_families()) {
    const Errors& e = families[static_cast<std::size_t>(f.id)];
    if (e.samples == 0) continue;
    FamilyResult row{f.id,       f.name, f.expected,  tier.name,    e.samples,
                     e.relative, e.ulp,  e.decisions, e.non_finite, e.example != nullptr,
                     {},         e.got,  e.want,      e.want_closer};
    if (e.example != nullptr) row.example = *e.example;
    rows.push_back(row);
  }
}

TierResult row_of(const Tier& tier, const Errors& e, const FilterCounters& counters) {
  TierResult row;
  row.name = tier.name;
  row.what = tier.what;
  row.samples = e.samples;
  row.max_relative_error = e.relative;
  row.max_ulp = e.ulp;
  row.max_scaled_error = e.scaled;
  row.decision_errors = e.decisions;
  row.feature_errors = e.features;
  row.non_finite = e.non_finite;
  if (counters.pairs > 0) {
    const auto pairs = static_cast<double>(counters.pairs);
    row.fallback_share = static_cast<double>(counters.double_double) / pairs;
    row.exact_share = static_cast<double>(counters.exact) / pairs;
  }
  return row;
}

// The samples with the exact answers to both questions.
struct Measurement {
  std::span<const PairSample> samples;
  const AccuracyOptions& options;
  std::vector<Outcome> distances, forces;
  std::vector<PairSample> few, rewritten;

  Measurement(std::span<const PairSample> all, const AccuracyOptions& o)
      : samples(all),
        options(o),
        few(thinned(all, o.slow_limit)),
        rewritten(thinned(all, o.rewritten_limit)) {
    FilterCounters unused;
    distances.reserve(all.size());
    for (const PairSample& s : all) distances.push_back(accuracy::exact(s, unused));
    if (o.decisions_only) return;
    forces.reserve(all.size());
    for (const PairSample& s : all) forces.push_back(accuracy::exact_force(s, unused));
  }
  void run(const Tier& tier, AccuracyReport& report) const {
    Errors errors;
    std::vector<Errors> families(64);
    FilterCounters counters;
    const std::string_view what = tier.what;
    const std::vector<Outcome>& truth = what == "force" ? forces : distances;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const PairSample& s = samples[k];
      const Outcome got = tier.is_truth ? truth[k] : tier.run(s, counters);
      errors.add(s, got, truth[k], what, distances[k].value);
      families[static_cast<std::size_t>(s.family) % 64].add(s, got, truth[k], what,
                                                            distances[k].value);
    }
    TierResult row = row_of(tier, errors, counters);
    // Asked of the exact decision too, which is one of the choices of --accuracy.
    if (what != "force" && (!tier.slow || what == "gaps")) check_invariance(tier, row);
    report.tiers.push_back(row);
    if (what == "distance") add_family_rows(report.families, tier, families);
    if (what == "gaps") add_family_rows(report.kinds, tier, families);
  }
  /// The rows of `report` are those of the tiers, in their order.
  void run_times(const std::vector<Tier>& tiers, AccuracyReport& report) const {
    std::vector<InTurn> all;
    for (const Tier& tier : tiers)
      all.push_back({&tier, tier.slow ? std::span<const PairSample>(few) : samples, {}});
    time_in_turn(all, options.repeats);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const PairTime time = median(all[k].ns);
      report.tiers[k].ns_per_pair = time.ns;
      report.tiers[k].spread = time.spread;
    }
  }
  void check_invariance(const Tier& tier, TierResult& row) const {
    const bool values = row.what == "distance";
    row.rewritten = rewritten.size();
    for (const PairSample& s : rewritten) {
      row.invariance_violations += !accuracy::is_invariant(tier, s, values);
      row.jumps += values && !accuracy::is_continuous(tier, s);
    }
  }
  /// Where the robust decision ends, and what that takes.
  void run_stages(AccuracyReport& report) const {
    const Tier tier{"robust", "gaps", [](const PairSample& s, FilterCounters& counters) {
                      return Outcome{0.0, accuracy::decide(s, counters), -1, {}};
                    }};
    std::array<std::vector<PairSample>, 3> ends;
    for (const PairSample& s : samples) {
      FilterCounters counters;
      accuracy::decide(s, counters);
      ends[counters.exact > 0 ? 2 : counters.double_double > 0 ? 1 : 0].push_back(s);
    }
    constexpr const char* names[] = {"filter", "double-double", "exact"};
    for (std::size_t k = 0; k < ends.size(); ++k) {
      std::vector<InTurn> one;
      if (!ends[k].empty()) one.push_back({&tier, ends[k], {}});
      time_in_turn(one, options.repeats);
      report.stages.push_back({names[k], ends[k].size(), one.empty() ? 0.0 : median(one[0].ns).ns});
    }
  }
  void run_kernel(AccuracyReport& report) const {
    const accuracy::KernelRun run = accuracy::run_kernel(samples, options.repeats);
    Errors errors;
    for (std::size_t k = 0; k < samples.size(); ++k)
      errors.add(samples[k], run.outcomes[k], forces[k], "force", distances[k].value);
    TierResult row = row_of({"kernel", "force", nullptr}, errors, {});
    row.ns_per_pair = run.ns_per_pair;
    report.tiers.push_back(row);
  }
};

}  // namespace

void mark_dominated(std::vector<TierResult>& tiers) {
  for (TierResult& a : tiers) {
    a.dominated = false;
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

AccuracyReport measure_accuracy(std::span<const PairSample> samples,
                                const AccuracyOptions& options) {
  AccuracyReport report;
  report.scene = !samples.empty() && samples[0].family > 0 ? "hard-cases" : "deck";
  if (samples.empty()) return report;
  std::vector<Tier> tiers;
  for (const Tier& tier : accuracy::distance_tiers())
    if (!options.decisions_only || std::string_view(tier.what) == "gaps") tiers.push_back(tier);
  if (!options.decisions_only)
    for (const Tier& tier : accuracy::force_tiers()) tiers.push_back(tier);
  // The exact answers come first, and take longer than most tiers.
  std::uint64_t done = 0;
  const auto step = [&] {
    if (options.progress) options.progress(done++, tiers.size() + 2);
  };
  step();
  const Measurement measurement(samples, options);
  for (const Tier& tier : tiers) {
    step();
    measurement.run(tier, report);
  }
  step();
  measurement.run_times(tiers, report);
  if (!options.decisions_only) {
    measurement.run_kernel(report);
    measurement.run_stages(report);
  }
  mark_dominated(report.tiers);
  return report;
}

}  // namespace deck
