// Hard cases: pairs made to break arithmetic, by kind. choice.hpp has their measurement.
#pragma once
#include <time.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "contact/shared/closest.hpp"

namespace deck {

// One pair with its gap. Node-segment: x[0..3] corners, x[4] node. Edge-edge: x[0], x[1] secondary
// edge, x[2], x[3] main edge.
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
  const char* group = "";
};
std::span<const HardFamily> hard_families();

// Samples of one family; equal for equal seeds on every machine. Empty for unsampled families and
// unknown ids.
std::vector<PairSample> hard_cases(int family, std::size_t samples, std::uint64_t seed = 1);

// FNV-1a over the bits of numbers; NaNs have many bit patterns and count as one.
struct BitDigest {
  std::uint64_t state = 0xCBF29CE484222325u;
  void add(std::uint64_t v) {
    for (int k = 0; k < 8; ++k) state = (state ^ ((v >> (8 * k)) & 0xFF)) * 0x100000001B3u;
  }
  void add(double v) { add(v == v ? std::bit_cast<std::uint64_t>(v) : 0x7FF8000000000000u); }
  void add(float v) { add(static_cast<double>(v)); }
};

// ---- other notations of a pair, which must not change an answer ---------------------------------

inline PairSample other_order(PairSample s) {
  if (s.edges) {
    std::swap(s.x[0], s.x[1]);
  } else if (s.triangle) {
    s.x = {s.x[1], s.x[2], s.x[0], s.x[0], s.x[4]};
  } else {
    s.x = {s.x[1], s.x[2], s.x[3], s.x[0], s.x[4]};
  }
  return s;
}

inline PairSample turned_over(PairSample s) {
  if (s.edges) {
    s.x = {s.x[2], s.x[3], s.x[0], s.x[1], s.x[4]};
  } else if (s.triangle) {
    std::swap(s.x[0], s.x[1]);
  } else {
    std::swap(s.x[1], s.x[3]);
  }
  return s;
}

inline PairSample other_axes(PairSample s) {
  for (Point3<double>& p : s.x) p = {-p.z, p.x, -p.y};
  return s;
}

// False if a coordinate or the gap does not fit.
inline bool scale(PairSample& s, int power) {
  bool exact = true;
  const auto one = [&](double& v) {
    const double y = std::ldexp(v, power);
    exact &= std::isfinite(y) && std::ldexp(y, -power) == v && (y == 0.0 || std::isnormal(y));
    v = y;
  };
  for (Point3<double>& p : s.x) one(p.x), one(p.y), one(p.z);
  one(s.gap);
  return exact;
}

}  // namespace deck

namespace deck::accuracy {

// Processor time of this thread in nanoseconds.
inline double thread_nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

}  // namespace deck::accuracy
