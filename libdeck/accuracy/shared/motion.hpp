// One hard case in motion: a node passes a sliver in a hundred straight steps, judged as each word
// of --accuracy does.
#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "deck/contact/scene.hpp"

namespace deck {

struct HardMotion {
  std::array<Point3<double>, 3> corners{};
  Point3<double> from, to;  // of the node, at the first and the last step
  double gap = 0.0;
  double way = 0.0;  // of the node in one step
  struct Line {
    Accuracy accuracy{};
    std::vector<double> depth, force;  // by step; the elastic force of a stiffness of 1
    // Steps where the depth changes by more than the way of the node. No distance can do that, so
    // it is the formula that jumps.
    std::vector<std::size_t> jumps;
  };
  std::vector<Line> lines;  // reference, fast, robust, exact
};

HardMotion hard_motion();
// One sentence a step with a jump: who jumps, from which force to which, and the exact one. Names
// stand in elements `tag`; without one they stand alone.
std::vector<std::string> motion_sentences(const HardMotion& motion, const std::string& tag = {});

}  // namespace deck
