// Boxes: geometric regions that select nodes and elements; boxes of boxes are unions.
#pragma once
#include <array>
#include <vector>

namespace deck::detail {

struct Box {
  enum class Type { none, rectangle, cylinder, sphere } type = Type::none;
  /// Rectangle: the two corners in the axes of the skew. Cylinder: base and end. Sphere: centre.
  std::array<double, 3> p{}, q{};
  std::array<double, 9> axes{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< rows: the axes of the skew
  bool global = true;                                     ///< axes are the global ones
  double diameter = 0;
  std::vector<const Box*> members;  ///< box of boxes
  std::vector<bool> subtracted;     ///< per member: listed with a negative id

  /// The boundary belongs to the box.
  bool contains(double x, double y, double z) const;
};

}  // namespace deck::detail
