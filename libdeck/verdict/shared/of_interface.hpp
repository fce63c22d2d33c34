// The verdict on one interface: as if the deck had only this interface and no other errors.
#pragma once
#include "deck/verdict.hpp"

namespace deck {

struct InterfaceVerdict {
  VerdictLevel level = VerdictLevel::clean;
  double max_depth = 0, max_ratio = 0;  ///< of its contacts, as in ContactTotals
};
InterfaceVerdict verdict_of_interface(const Scene& scene, const SceneView& view,
                                      const InterBase& inter);
VerdictLevel level_of_tie(const Tie& tie);

}  // namespace deck
