// A part, and how its elements are held against the formulas of their kind.
#pragma once
#include <gtest/gtest.h>

#include <cmath>

#include "model/mesh/mesh_parts.hpp"

namespace deck::test {

using detail::ElementOutcome;
using detail::PartRow;

inline void expect_near(double got, double wanted, double share = 1e-12) {
  EXPECT_NEAR(got, wanted, share * std::abs(wanted));
}

/// An elastic part: E 210, nu 0.3, density 3 (that of reference 2), thickness 2.
inline PartRow part(int law = 1, int type = 1) {
  PartRow row;
  row.material.law = law;
  row.material.density = 3;
  row.material.reference_density = 2;
  row.material.young = 210;
  row.material.poisson = 0.3;
  row.material.shear = 80;
  row.material.shell_speed = 11;
  row.material.solid_speed = 13;
  row.material.stored_speed = 9;
  row.material.plate_modulus = 230;
  row.material.tetra_ratio = 0.5;
  row.property.type = type;
  row.property.isolid = 1;
  row.thickness = 2;
  return row;
}

/// Section 2 of time_step.md.
inline double damp(double v) { return std::sqrt(1 + v * v) - v; }

}  // namespace deck::test
