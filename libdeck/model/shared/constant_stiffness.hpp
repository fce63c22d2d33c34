// Whether Stfac is a stiffness or a factor. Private to the library.
#pragma once
#include "deck/model.hpp"

namespace deck::detail {

inline constexpr Dimension stiffness_dimension{1, 0, -2, 0};

/// Stfac is a stiffness that the solver takes for every segment: a positive value with Istf 1, a
/// negative one with any other Istf. For edges Istf 1 is always a stiffness (spec:
/// starter_geometry 2.1). That of a tie is always a factor (tied 7.4).
inline bool constant_stiffness(const InterBase& inter) {
  if (inter.type == InterType2::traits.type) return false;
  return visit_interface(inter, [&](const auto& t) {
    std::int64_t istf = 0;
    if constexpr (requires { t.Istf; }) istf = t.Istf.value;
    const bool negative = t.Stfac.value < 0;
    return inter.type == 11 ? istf == 1 || negative : (istf == 1) != negative;
  });
}

}  // namespace deck::detail
