// Translations that free penetrations: each asks for a distance along its normal. Private to the
// stage.
#pragma once
#include <vector>

#include "base/shared/vec.hpp"

namespace deck::detail {

/// A penetration of a body that moves as a whole: it is free where the translation is `needs` long
/// along `normal` (unit), and it must never move against it.
struct WayOut {
  Vec normal;
  double needs = 0;
  bool wanted = true;  ///< it counts; else it must only get no deeper
};

struct Translation {
  Vec by;
  std::size_t frees = 0;  ///< of those that are wanted
};

/// Translations no longer than `longest` that move against no normal, those that free more first,
/// of equals the shortest; at most `most`, and none that frees nothing. Components are rounded to
/// three digits, away from zero.
std::vector<Translation> translations_for(const std::vector<WayOut>& ways, double longest,
                                          std::size_t most);

}  // namespace deck::detail
