// CGAL as second opinion of distances and the tree; how exact numbers are rounded.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "contact/search_scenes.hpp"
#include "contact/shared/exact.hpp"
#include "contact/shared/exact_number.hpp"
#include "deck/contacts.hpp"

namespace deck {
namespace {

using scenes::Dice;

constexpr double smallest_double = std::numeric_limits<double>::denorm_min(),
                 largest_double = std::numeric_limits<double>::max();

TEST(ExactAgainstCgal, SquaredDistanceOfPointAndTriangle) {
  using Exact = CGAL::Simple_cartesian<Rational>;
  Dice dice(13);
  const auto coordinate = [&dice] {
    return Rational(Rational(dice.below(17) - 8) / Rational(1 + dice.below(5)));
  };
  for (int k = 0; k < 300; ++k) {
    std::array<Point3<Rational>, 4> p;
    for (auto& q : p) q = {coordinate(), coordinate(), coordinate()};
    const auto cgal = [](const Point3<Rational>& q) { return Exact::Point_3(q.x, q.y, q.z); };
    const Exact::Triangle_3 triangle(cgal(p[0]), cgal(p[1]), cgal(p[2]));
    if (triangle.is_degenerate()) continue;
    const Rational expected = CGAL::squared_distance(cgal(p[3]), triangle);
    const auto ours = closest_on_segment<Form::robust>(
        p[3], std::array<Point3<Rational>, 4>{p[0], p[1], p[2], p[2]}, true);
    EXPECT_TRUE(ours.distance_squared() == expected);
  }
}

TEST(ExactAgainstCgal, SquaredDistanceOfTwoEdges) {
  using Exact = CGAL::Simple_cartesian<Rational>;
  Dice dice(14);
  for (int k = 0; k < 500; ++k) {
    std::array<Point3<Rational>, 4> p;
    for (auto& q : p) q = {dice.below(7), dice.below(7), dice.below(3)};
    const auto cgal = [](const Point3<Rational>& q) { return Exact::Point_3(q.x, q.y, q.z); };
    const Exact::Segment_3 a(cgal(p[0]), cgal(p[1])), b(cgal(p[2]), cgal(p[3]));
    if (a.is_degenerate() || b.is_degenerate()) continue;
    const Rational expected = CGAL::squared_distance(a, b);
    const auto ours = closest_between_edges<Form::robust>(p[0], p[1], p[2], p[3]);
    EXPECT_TRUE(ours.distance_squared == expected);
  }
}

TEST(ExactSquareRoot, IsCorrectlyRounded) {
  Dice dice(9);
  for (int i = 0; i < 2000; ++i) {
    const double x = std::ldexp(dice.uniform(1, 4), static_cast<int>(dice.uniform(-900, 900)));
    EXPECT_EQ(rounded_square_root(Rational(x)), std::sqrt(x));
    EXPECT_EQ(rounded_square_root(CGAL::square(Rational(x))), x);
  }
  EXPECT_EQ(rounded_square_root(Rational(0)), 0.0);
}

TEST(ExactSquareRoot, OfTheMiddleOfTwoDoublesIsTheEvenOne) {
  for (const double even : {1.0, 4 * smallest_double, 0x1p-1022, 0x1.8p1000}) {
    const double above = std::nextafter(even, largest_double), below = std::nextafter(even, 0.0);
    for (const double odd : {above, below}) {
      const Rational middle = (Rational(even) + Rational(odd)) / Rational(2);
      EXPECT_EQ(rounded_square_root(CGAL::square(middle)), even);
      const Rational nearer = (middle + Rational(odd)) / Rational(2);
      EXPECT_EQ(rounded_square_root(CGAL::square(nearer)), odd);
    }
  }
}

TEST(ExactSquareRoot, BeyondAllDoublesIsZeroOrInfinite) {
  const Rational least(smallest_double), most(largest_double);
  EXPECT_EQ(rounded_square_root(CGAL::square(least) / Rational(4)), 0.0);
  EXPECT_EQ(rounded_square_root(CGAL::square(least) / Rational(3)), smallest_double);
  EXPECT_EQ(rounded_square_root(CGAL::square(most)), largest_double);
  EXPECT_EQ(rounded_square_root(CGAL::square(most) * Rational(2)),
            std::numeric_limits<double>::infinity());
}

TEST(ExactSquareRoot, HasThreeHundredDigitsWhereItIsCutOff) {
  for (const double x : {2.0, 3e-300, 7e300, smallest_double}) {
    const Rational root = long_square_root(Rational(x)), step = root * Rational(0x1p-300);
    EXPECT_TRUE(CGAL::square(root) <= Rational(x));
    EXPECT_TRUE(CGAL::square(Rational(root + step)) > Rational(x));
  }
}

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
  for (const auto& s : mesh.segments) triangles.emplace_back(point(s[0]), point(s[1]), point(s[2]));
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
