// Orientation of solids: the reference solver turns every solid of negative volume.
#include <algorithm>
#include <array>
#include <utility>

#include "model/bulk/bulk.hpp"

namespace deck::detail {
namespace {

using Vector = std::array<double, 3>;

/// Determinant of the Jacobian in the centre of eight slots, but for a positive factor.
double centre_jacobian(const Nodes& nodes, const NodeIndex* n) {
  constexpr int sign[3][8] = {
      {-1, 1, 1, -1, -1, 1, 1, -1}, {-1, -1, 1, 1, -1, -1, 1, 1}, {-1, -1, -1, -1, 1, 1, 1, 1}};
  Vector axis[3] = {};
  // Coordinates from the first node: far from the origin the differences keep their digits.
  for (int slot = 0; slot < 8; ++slot) {
    const Vector at{nodes.x[n[slot]] - nodes.x[n[0]], nodes.y[n[slot]] - nodes.y[n[0]],
                    nodes.z[n[slot]] - nodes.z[n[0]]};
    for (int k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c) axis[k][c] += sign[k][slot] * at[c];
  }
  const Vector& a = axis[0];
  const Vector& b = axis[1];
  const Vector& c = axis[2];
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

void turn(SolidShape shape, NodeIndex* n, NodeIndex* mid) {
  switch (shape) {
    case SolidShape::tetra10:
      // Mid-side nodes lie on 1-2, 2-3, 3-1, 1-4, 2-4, 3-4.
      std::swap(mid[0], mid[3]);
      std::swap(mid[1], mid[5]);
      [[fallthrough]];
    case SolidShape::tetra4: {
      // Slots hold 1 1 2 2 4 3 3 4.
      const NodeIndex second = n[2], fourth = n[4];
      n[2] = n[3] = fourth;
      n[4] = n[7] = second;
      break;
    }
    case SolidShape::penta6:  // stays as it is written
      break;
    case SolidShape::brick8:
    case SolidShape::brick20:
    case SolidShape::thick16:
      std::swap_ranges(n, n + 4, n + 4);
      break;
  }
}

}  // namespace

std::size_t orient_solids(Model& model) {
  Elements& solids = model.solid8;
  std::size_t turned = 0;
  for (std::size_t e = 0; e < solids.size(); ++e) {
    NodeIndex* const n = solids.nodes.data() + 8 * e;
    // In runs of the solver the faces of a penta follow its card; contacts turn them outward later.
    if (solids.shape[e] == SolidShape::penta6) continue;
    if (std::find(n, n + 8, no_index) != n + 8 || !(centre_jacobian(model.nodes, n) < 0)) continue;
    NodeIndex* const mid =
        solids.extra[e] == no_index ? nullptr : solids.extra_nodes.data() + solids.extra[e];
    turn(solids.shape[e], n, mid);
    ++turned;
  }
  return turned;
}

}  // namespace deck::detail
