// CGAL as second opinion: boxes and trees from another library give the same pairs.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/box_intersection_d.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "contact/search_scenes.hpp"
#include "deck/contact/search.hpp"

namespace deck {
namespace {

using scenes::Dice;
using scenes::Mesh;
using Kernel = CGAL::Simple_cartesian<double>;

Mesh wavy_sheets(int n, bool triangles) {
  Mesh mesh;
  Dice dice(11);
  for (const double level : {0.0, 0.45}) {
    scenes::add_sheet(mesh, n, triangles, [&](int i, int j) {
      return std::array{i + dice.uniform(-0.2, 0.2), j + dice.uniform(-0.2, 0.2),
                        level + 2 * std::sin(0.2 * i) + dice.uniform(-0.1, 0.1)};
    });
  }
  mesh.all_nodes_secondary();
  mesh.edges_of_segments();
  return mesh;
}

NodeSegmentInput input(const Mesh& mesh) {
  NodeSegmentInput in;
  in.nodes = mesh.nodes();
  in.secondary = mesh.secondary;
  in.segments = mesh.segments;
  return in;
}

struct NumberedBox : CGAL::Box_intersection_d::Box_d<double, 3> {
  std::uint32_t number;
  NumberedBox(const CGAL::Bbox_3& box, std::uint32_t which)
      : CGAL::Box_intersection_d::Box_d<double, 3>(box), number(which) {}
};

template <std::size_t N>
std::vector<NumberedBox> boxes(const Mesh& mesh,
                               const std::vector<std::array<std::uint32_t, N>>& list, double by) {
  std::vector<NumberedBox> out;
  for (std::uint32_t k = 0; k < list.size(); ++k) {
    CGAL::Bbox_3 box;
    for (const std::uint32_t i : list[k]) {
      const double x = mesh.x[i], y = mesh.y[i], z = mesh.z[i];
      box += CGAL::Bbox_3(x - by, y - by, z - by, x + by, y + by, z + by);
    }
    out.emplace_back(box, k);
  }
  return out;
}

// Pairs of overlapping boxes that also pass the distance test.
template <class Input>
std::vector<CandidatePair> pairs_of_boxes(std::vector<NumberedBox> secondary,
                                          std::vector<NumberedBox> main, const Input& in,
                                          const SearchOptions& o) {
  std::vector<CandidatePair> pairs;
  CGAL::box_intersection_d(secondary.begin(), secondary.end(), main.begin(), main.end(),
                           [&](const NumberedBox& a, const NumberedBox& b) {
                             if (scenes::within(in, o, a.number, b.number)) {
                               pairs.push_back({a.number, b.number});
                             }
                           });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(SearchAgainstCgal, NodeSegmentPairsOfIntersectingBoxes) {
  for (const bool triangles : {false, true}) {
    const Mesh mesh = wavy_sheets(60, triangles);
    const NodeSegmentInput in = input(mesh);
    SearchOptions o;
    o.gap = PairGap::constant(0.6);
    std::vector<std::array<std::uint32_t, 1>> single;
    for (const std::uint32_t node : mesh.secondary) single.push_back({node});
    const auto expected =
        pairs_of_boxes(boxes(mesh, single, 0.0), boxes(mesh, mesh.segments, 0.61), in, o);
    EXPECT_GT(expected.size(), 20000U);
    EXPECT_EQ(find_node_segment_pairs(in, o).pairs, expected);
  }
}

TEST(SearchAgainstCgal, EdgeEdgePairsOfIntersectingBoxes) {
  const Mesh mesh = wavy_sheets(40, false);
  EdgeEdgeInput in;
  in.nodes = mesh.nodes();
  in.secondary = mesh.edges;
  in.main = mesh.edges;
  SearchOptions o;
  o.gap = PairGap::constant(0.6);
  const auto expected =
      pairs_of_boxes(boxes(mesh, mesh.edges, 0.0), boxes(mesh, mesh.edges, 0.61), in, o);
  EXPECT_GT(expected.size(), 10000U);
  EXPECT_EQ(find_edge_edge_pairs(in, o).pairs, expected);
}

TEST(SearchAgainstCgal, NodeHasAPairExactlyIfTheTreeFindsATriangleWithinTheGap) {
  Mesh mesh = wavy_sheets(50, true);
  // Secondary nodes of their own, near the sheets: no node is left out for being a corner.
  Dice dice(12);
  mesh.secondary.clear();
  for (int k = 0; k < 3000; ++k) {
    mesh.secondary.push_back(
        mesh.add(dice.uniform(-1, 51), dice.uniform(-1, 51), dice.uniform(-3, 3)));
  }
  SearchOptions o;
  o.gap = PairGap::constant(0.5);
  o.form = Form::robust;
  const auto pairs = find_node_segment_pairs(input(mesh), o).pairs;
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
