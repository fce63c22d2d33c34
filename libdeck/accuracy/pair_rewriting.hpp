// The same pair written down in another way: what may not change an answer.
#pragma once
#include <cmath>
#include <utility>

#include "accuracy/shared/accuracy.hpp"

namespace deck {

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
