// The hard cases: pairs made to break arithmetic, by kind. What they are measured for stands in
// choice.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/shared/closest.hpp"

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
  const char* group = "";
};
std::span<const HardFamily> hard_families();

// Samples of one family; the same seed gives the same samples on every machine. Empty for families
// that are not sampled, and for unknown ids.
std::vector<PairSample> hard_cases(int family, std::size_t samples, std::uint64_t seed = 1);

}  // namespace deck
