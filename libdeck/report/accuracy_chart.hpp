// Pieces of the chart of `deck accuracy` for the page around it. Private to the stage.
#pragma once
#include <string>

#include "accuracy/shared/motion.hpp"
#include "report/shared/accuracy.hpp"

namespace deck {

std::string accuracy_title(const AccuracyReport& report, const AccuracyContext& context);
/// One chart as SVG: x = time per pair, y = worst error (relative; of hard cases over the size of
/// the pair; of decisions alone: wrong ones), both logarithmic. A line connects the best tiers,
/// those that no other tier beats on both axes; the others are hollow. Empty: no tier is of this
/// kind.
std::string accuracy_panel(const AccuracyReport& report, const std::string& what);
/// The force of each word against the step, with a ring at every jump.
std::string motion_panel(const HardMotion& motion);

}  // namespace deck
