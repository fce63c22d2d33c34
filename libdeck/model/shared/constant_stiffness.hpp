// Decides if Stfac is a stiffness or a factor. Private to the library.
#pragma once
#include "deck/model.hpp"

namespace deck::detail {

inline constexpr Dimension stiffness_dimension{1, 0, -2, 0};

/// True if Stfac is the stiffness of every segment: positive with Istf 1, negative with other Istf.
/// Edges with Istf 1: always (spec: starter_geometry 2.1). Ties: never (tied 7.4).
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
