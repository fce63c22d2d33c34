// Arithmetics of bench_distance, one function each.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "accuracy/shared/accuracy.hpp"
#include "contact/shared/filtered.hpp"
#include "deck/contacts.hpp"

namespace deck::bench {

// Answer of a tier for a pair.
struct Outcome {
  double value = 0.0;  // distance; unused by decisions
  bool closer = false;
};

struct Tier {
  const char* name;
  const char* what;  // "distance"; "decision": that alone
  Outcome (*run)(const PairSample&, FilterCounters&);
  bool slow = false;  // run on fewer pairs
};
std::span<const Tier> tiers();

// CGAL's intervals with rationals where they leave a doubt.
Outcome interval(const PairSample& s, FilterCounters& counters);
// Rationals throughout: exact distance rounded once, exact decision.
Outcome exact(const PairSample& s, FilterCounters& counters);

// Pairs of a scene that its candidate search finds (within gap plus margin), with their pair gaps;
// at most `limit`, evenly taken.
std::vector<PairSample> scene_pairs(const Scene& scene, std::size_t limit);

/// A point in other numbers.
template <class T>
Point3<T> cast(const Point3<double>& p) {
  return {T(p.x), T(p.y), T(p.z)};
}

}  // namespace deck::bench
