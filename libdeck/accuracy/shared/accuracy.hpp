// What accuracy costs: the hard-case families, pairs taken from a deck, and the measurement of the
// distance in several arithmetics against exact rationals.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "deck/contact/closest.hpp"
#include "deck/contact/scene.hpp"

namespace deck {

// One pair with its gap. Node-segment: x[0..3] the corners, x[4] the node. Edge-edge: x[0], x[1]
// the secondary and x[2], x[3] the main edge.
struct PairSample {
  std::array<Point3<double>, 5> x{};
  bool edges = false;
  bool triangle = false;
  double gap = 0.0;
  int family = 0;  // 0: from a deck

  std::array<Point3<double>, 4> corners() const { return {x[0], x[1], x[2], x[3]}; }
};

// A family of hard cases: swept parameters, fixed seeds, one expected behaviour.
struct HardFamily {
  int id = 0;
  const char* name = "";
  const char* expected = "";
  bool sampled = true;  // false: a property of search or build, without pair samples here
};
std::span<const HardFamily> hard_families();

// Samples of one family; the same seed gives the same samples on every machine. Empty for families
// that are not sampled, and for unknown ids.
std::vector<PairSample> hard_cases(int family, std::size_t samples, std::uint64_t seed = 1);

// Pairs of a scene that its candidate search finds (within gap plus margin), with their pair gaps;
// at most `limit`, evenly taken.
std::vector<PairSample> scene_pairs(const Scene& scene, std::size_t limit, int threads = 1);

struct AccuracyOptions {
  int repeats = 5;                     // timings per tier; the median counts
  std::size_t slow_limit = 2000;       // pairs timed in exact arithmetic
  std::size_t rewritten_limit = 5000;  // pairs checked for invariance and continuity
  bool decisions_only = false;         // leave out distances and forces in all number types
  // Called with how many of all steps are done.
  std::function<void(std::uint64_t, std::uint64_t)> progress = {};
};

// One arithmetic. A decision is "distance < gap".
struct TierResult {
  std::string name;
  // "distance"; "gaps": only the decision, and of decks the whole `deck gaps`; "force": the elastic
  // normal force of the robust law.
  std::string what;
  std::uint64_t samples = 0;
  double ns_per_pair = 0.0;
  // How far the lower quartile of the timings lies from the time that counts, as a share of it; 0
  // where there was one timing.
  double spread = 0.0;
  double seconds = 0.0;  // of one run of the whole `deck gaps`; 0 elsewhere
  double max_relative_error = 0.0;
  double max_ulp = 0.0;
  // Error of the distance over the largest coordinate difference of the pair; of a force: the error
  // of the distance that would make it.
  double max_scaled_error = 0.0;
  std::uint64_t decision_errors = 0, feature_errors = 0, non_finite = 0;
  // Pairs written down in other ways (order of nodes, orientation, axes, powers of two) or one step
  // aside: whose answer changed, and whose distance jumped. Not asked of slow tiers and forces.
  std::uint64_t rewritten = 0, invariance_violations = 0, jumps = 0;
  double fallback_share = 0.0;  // pairs that needed more than double
  double exact_share = 0.0;     // pairs that needed rationals
  bool dominated = false;       // another tier is as fast, as accurate, and better in one of both
};

struct FamilyResult {
  int id = 0;
  std::string name, expected, tier;
  std::uint64_t samples = 0;
  double max_relative_error = 0.0, max_ulp = 0.0;
  std::uint64_t decision_errors = 0, non_finite = 0;
  // The wrong decision with the largest error, else the worst error; nothing if there is none.
  bool has_example = false;
  PairSample example;
  double got = 0.0, exact = 0.0;  // its distance; decisions compute none, or not always
  bool exact_closer = false;      // whether it is in contact
};

// Pairs whose robust decision ends in one stage, and what such a pair takes from its beginning.
struct StageResult {
  std::string name;  // "filter", "double-double", "exact"
  std::uint64_t pairs = 0;
  double ns_per_pair = 0.0;
};

struct AccuracyReport {
  std::string scene;  // "hard-cases" or "deck"
  std::vector<TierResult> tiers;
  std::vector<FamilyResult> families;  // of every tier that computes distances
  std::vector<FamilyResult> kinds;     // the same of the decisions, by accuracy
  std::vector<StageResult> stages;     // of the robust decision
};

// Runs every tier over the samples. Relative errors where the exact distance is 0 count as 0 or
// infinity; a result is non-finite if any input was finite and the distance is not.
AccuracyReport measure_accuracy(std::span<const PairSample> samples,
                                const AccuracyOptions& options = {});

// How long measure_gaps() repeats.
struct GapsTiming {
  int repeats = 5;
  double least = 0.0;   // seconds: short runs are repeated more often, until this much was spent
  double most = 1e300;  // seconds: after three rounds none begins once this much was spent
  std::function<void(std::uint64_t, std::uint64_t)> progress = {};  // done, of all runs
};

// Times the whole of `deck gaps` in each accuracy and adds the rows "gaps" to the report, instead
// of those that were there. `run` reads the deck and builds its scene with penetrations; only the
// contacts of its result are looked at. Times are those of the clock, the best of the repeats, per
// decided pair. The accuracies take turns, so that other work on the machine meets all of them;
// the exact one runs once.
void measure_gaps(const std::function<Scene(Accuracy)>& run, const GapsTiming& timing,
                  AccuracyReport& report);

// Marks tiers that another one of the same kind beats.
void mark_dominated(std::vector<TierResult>& tiers);

}  // namespace deck
