// The arithmetics that `deck accuracy` compares, each as one function from a pair to its answer.
// Private to the contact stage.
#pragma once

#include <time.h>

#include <array>
#include <span>
#include <vector>

#include "accuracy/shared/accuracy.hpp"
#include "contact/shared/filtered.hpp"

namespace deck::accuracy {

// What one tier says about one pair.
struct Outcome {
  double value = 0.0;  // distance, or force for a stiffness of 1; unused by decisions
  bool closer = false;
  int feature = -1;                 // number of the part of the segment or the two edges; -1: none
  std::array<double, 4> weights{};  // of the closest point; edges: [0] secondary, [1] main
};

struct Tier {
  const char* name;
  const char* what;  // "distance", "gaps": the decision alone, "force"
  Outcome (*run)(const PairSample&, FilterCounters&);
  bool slow = false;      // timed on fewer pairs
  bool is_truth = false;  // its answers are what the others are held against
};

// Processor time of this thread in nanoseconds: others on the machine do not count. WebAssembly has
// no such clock: there it is the time that passes.
inline double thread_nanoseconds() {
  timespec now{};
  if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) clock_gettime(CLOCK_MONOTONIC, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

/// A point in other numbers.
template <class T>
Point3<T> cast(const Point3<double>& p) {
  return {T(p.x), T(p.y), T(p.z)};
}

inline int number_of(Feature feature, int index) { return 8 * static_cast<int>(feature) + index; }
inline int number_of(EdgeFeature s, EdgeFeature m) {
  return 64 + 8 * static_cast<int>(s) + static_cast<int>(m);
}

// Contact by the filtered predicate.
bool decide(const PairSample& s, FilterCounters& counters);

std::span<const Tier> distance_tiers();  // and decisions
std::span<const Tier> force_tiers();

// CGAL's lazy exact numbers, and its intervals with rationals where they leave a doubt.
Outcome lazy_exact(const PairSample& s, FilterCounters& counters);
Outcome interval(const PairSample& s, FilterCounters& counters);

// Rationals throughout: exact distance rounded once, exact decision.
Outcome exact(const PairSample& s, FilterCounters& counters);
// Below this share of the gap the robust force law is linear in the distance.
constexpr double linear_below = 1e-8;
// Elastic normal force of the robust model for K0 = 1, rounded from more than 200 bits.
Outcome exact_force(const PairSample& s, FilterCounters& counters);
// The same in double, from a distance and a depth that are known.
double elastic_force(double gap, double distance, double depth);
// dF/dd at the exact distance: what an error of the distance makes of itself in the force.
double force_slope(double distance, double gap);

// True if node order, orientation, axes and scaling by powers of two change no bit of the answer.
bool is_invariant(const Tier& tier, const PairSample& s, bool values);
// True if a step of one unit in the last place of a node moves the distance by no more than the
// step and four units of its own.
bool is_continuous(const Tier& tier, const PairSample& s);

// The kernel of `deck cycle` over whole packets: its forces, and the nanoseconds per pair.
struct KernelRun {
  std::vector<Outcome> outcomes;
  double ns_per_pair = 0.0;
};
KernelRun run_kernel(std::span<const PairSample> samples, int repeats);

}  // namespace deck::accuracy
