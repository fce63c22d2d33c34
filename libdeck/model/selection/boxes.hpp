// Boxes: geometric regions that select nodes and elements; boxes of boxes are unions.
#pragma once
#include <array>
#include <vector>

#include "base/shared/vec.hpp"

namespace deck::detail {

struct BoxVolume {
  enum class Type { none, rectangle, cylinder, sphere } type = Type::none;
  /// Rectangle: the two corners in the axes of the skew. Cylinder: base and end. Sphere: centre.
  Vec p, q;
  std::array<Vec, 3> axes{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};  ///< of the skew
  bool global = true;                                                 ///< axes are the global ones
  double diameter = 0;
  std::vector<const BoxVolume*> members;  ///< box of boxes
  std::vector<bool> subtracted;           ///< per member: listed with a negative id

  /// The boundary belongs to the box.
  bool contains(double x, double y, double z) const;
};

}  // namespace deck::detail
