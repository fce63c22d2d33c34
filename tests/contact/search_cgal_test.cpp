// CGAL as second opinion: the tree of another library finds the same nodes near triangles.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <cmath>

#include "contact/search_scenes.hpp"
#include "deck/contacts.hpp"

namespace deck {
namespace {

using scenes::Dice;
using scenes::Mesh;
using Kernel = CGAL::Simple_cartesian<double>;

TEST(SearchAgainstCgal, NodeHasAPairExactlyIfTheTreeFindsATriangleWithinTheGap) {
  Mesh mesh;
  Dice dice(11);
  for (const double level : {0.0, 0.45})
    scenes::add_sheet(mesh, 50, true, [&](int i, int j) {
      return std::array{i + dice.uniform(-0.2, 0.2), j + dice.uniform(-0.2, 0.2),
                        level + 2 * std::sin(0.2 * i) + dice.uniform(-0.1, 0.1)};
    });
  // Secondary nodes of their own, near the sheets: no node is left out for being a corner.
  for (int k = 0; k < 3000; ++k) {
    mesh.secondary.push_back(
        mesh.add(dice.uniform(-1, 51), dice.uniform(-1, 51), dice.uniform(-3, 3)));
  }
  SearchOptions o;
  o.gap = PairGap::constant(0.5);
  o.form = Form::robust;
  NodeSegmentInput in;
  in.nodes = mesh.nodes();
  in.secondary = mesh.secondary;
  in.segments = mesh.segments;
  const auto pairs = find_node_segment_pairs(in, o).pairs;
  std::vector<bool> touched(mesh.secondary.size(), false);
  for (const auto& pair : pairs) touched[pair.secondary] = true;

  std::vector<Kernel::Triangle_3> triangles;
  const auto point = [&mesh](std::uint32_t i) {
    return Kernel::Point_3(mesh.x[i], mesh.y[i], mesh.z[i]);
  };
  for (const auto& s : mesh.segments) {
    triangles.emplace_back(point(s[0]), point(s[1]), point(s[2]));
  }
  using Primitive =
      CGAL::AABB_triangle_primitive<Kernel, std::vector<Kernel::Triangle_3>::iterator>;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(triangles.begin(), triangles.end());
  for (std::size_t i = 0; i < mesh.secondary.size(); ++i) {
    const double d = std::sqrt(tree.squared_distance(point(mesh.secondary[i])));
    if (std::abs(d - 0.5) < 1e-12) continue;
    EXPECT_EQ(touched[i], d < 0.5) << i;
  }
}

}  // namespace
}  // namespace deck
