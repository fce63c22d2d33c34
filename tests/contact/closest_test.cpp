// Closest points of nodes, segments and edges: worked cases with known answers, and invariances.
#include "contact/shared/closest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "contact/shared/dd.hpp"
#include "contact/shared/exact.hpp"

namespace deck {
namespace {

TEST(Closest, CoordinatesWithoutBoundsGiveAnAnswerOfSomeKind) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  for (const double far : {inf, -inf, std::nan(""), 1.7e308, 1.4e154})
    for (std::size_t bad = 0; bad < 5; ++bad) {
      std::array<Point3<double>, 5> x{{{0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
      x[bad].y = far;
      const std::array<Point3<double>, 4> corners{x[1], x[2], x[3], x[4]};
      const auto robust = closest_on_segment<Form::robust>(x[0], corners, false);
      const auto reference = closest_on_segment<Form::reference>(x[0], corners, false);
      EXPECT_FALSE(robust.distance() < 0 || reference.distance() < 0);
      EXPECT_FALSE(closest_between_edges<Form::robust>(x[0], x[1], x[2], x[3]).distance < 0);
    }
}

using P = Point3<double>;
using Corners = std::array<P, 4>;

constexpr Corners flat{P{0, 0, 0}, P{10, 0, 0}, P{10, 10, 0}, P{0, 10, 0}};
constexpr Corners flat_triangle{P{0, 0, 0}, P{6, 0, 0}, P{0, 6, 0}, P{0, 6, 0}};

// One row of the worked tables: gap 1 unless said. sub 0: any of tied sub-triangles.
struct SegmentCase {
  P node;
  std::vector<double> distance;  // of the four sub-triangles, or of the best one
  double penetration;
  int sub;
  P normal;
};

template <Form F>
void expect_case(const Corners& x, bool triangle, const SegmentCase& c) {
  const auto closest = closest_on_segment<F>(c.node, x, triangle);
  const auto pene = penetration(closest, 1.0);
  if (c.distance.size() == 4) {
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(closest.sub[k].distance, c.distance[k], 5e-7) << "sub-triangle " << k + 1;
  } else {
    EXPECT_NEAR(closest.distance(), c.distance[0], 5e-7);
  }
  EXPECT_NEAR(pene.value, c.penetration, 5e-7);
  if (c.sub == 0 || c.penetration == 0.0) return;
  EXPECT_EQ(pene.sub, c.sub - 1);
  EXPECT_NEAR(pene.normal.x, c.normal.x, 5e-7);
  EXPECT_NEAR(pene.normal.y, c.normal.y, 5e-7);
  EXPECT_NEAR(pene.normal.z, c.normal.z, 5e-7);
}

void expect_both(const Corners& x, bool triangle, const SegmentCase& c) {
  expect_case<Form::reference>(x, triangle, c);
  expect_case<Form::robust>(x, triangle, c);
}

TEST(NodeAtFlatQuad, DistancesPenetrationAndNormal) {
  expect_both(flat, false, {{3, 4, 0.4}, {0.812404, 2.271563, 2.158703, 0.4}, 0.6, 4, {0, 0, 1}});
  expect_both(flat, false, {{3, 4, -0.7}, {0.994987, 2.343075, 2.233831, 0.7}, 0.3, 4, {0, 0, -1}});
  expect_both(flat, false, {{5, 5, 0.25}, {0.25, 0.25, 0.25, 0.25}, 0.75, 1, {0, 0, 1}});
  // Beside an edge and a corner, and beyond the gap.
  const double r = std::sqrt(0.5);
  expect_both(flat, false, {{10.5, 5, 0.5}, {0.707107}, 0.292893, 2, {r, 0, r}});
  expect_both(flat, false,
              {{10.6, 10.3, 0.3}, {0.734847}, 0.265153, 2, {0.816497, 0.408248, 0.408248}});
  expect_both(flat, false, {{10.9, 10.9, 0.5}, {1.367479}, 0.0, 0, {}});
}

TEST(NodeOverTriangle, ThirdNodeIsTheCentre) {
  const auto row = [](P p, double d1, double rest, double pene, P normal) {
    expect_both(flat_triangle, true, {p, {d1, rest, rest, rest}, pene, 1, normal});
  };
  row({1, 1, 0.5}, 0.5, 5.123475, 0.5, {0, 0, 1});
  row({3.5, 3.5, 0.4}, 0.812404, 4.319722, 0.187596, {0.615457, 0.615457, 0.492366});
  row({6.4, -0.3, 0.2}, 0.538516, 8.982761, 0.461484, {0.742781, -0.557086, 0.371391});
  row({2, 2, -0.3}, 0.3, 4.482187, 0.7, {0, 0, -1});
  row({0, 6.5, 0.1}, 0.509902, 0.509902, 0.490098, {0, 0.980581, 0.196116});
}

struct EdgeCase {
  P s1, s2, m1, m2;
  double weight_s, weight_m, distance;
};

template <Form F>
void expect_edges(const EdgeCase& c) {
  const auto e = closest_between_edges<F>(c.s1, c.s2, c.m1, c.m2);
  EXPECT_NEAR(e.weight_s, c.weight_s, 5e-7);
  EXPECT_NEAR(e.weight_m, c.weight_m, 5e-7);
  EXPECT_NEAR(e.distance, c.distance, 5e-7);
}

TEST(CrossingEdges, WeightsAndDistance) {
  for (const EdgeCase& c :
       {EdgeCase{{4, -3, 1.1}, {5, 12, 1.3}, {0, 0, 0}, {10, 0, 0}, 0.801013, 0.580101, 1.139899},
        EdgeCase{{4, -3, 1.1}, {5, 12, 1.3}, {0, 8, 0}, {10, 8, 0}, 0.267775, 0.526777, 1.246556},
        EdgeCase{{2, -2, 0.7}, {2.5, 9, 0.9}, {0, 0, 0}, {10, 0, 0}, 0.819399, 0.790970, 0.736242},
        EdgeCase{{41, -1, 3.05},
                 {41.2, 3, 3.1},
                 {40, 0, 3},
                 {42, 0, 3},
                 0.750195,
                 0.475020,
                 0.062495}}) {
    expect_edges<Form::reference>(c);
    expect_edges<Form::robust>(c);
  }
}

TEST(ParallelEdges, ReferenceSweepsOnceRobustTakesTheMiddleWhateverTheirDirections) {
  const P s1{0, 1, 0}, s2{4, 1, 0}, m1{1, 0, 0}, m2{9, 0, 0};
  expect_edges<Form::reference>({s1, s2, m1, m2, 0.0, 0.625, 1.0});
  // Overlap x = 1..4, middle 2.5.
  for (const EdgeCase& c :
       {EdgeCase{s1, s2, m1, m2, 0.375, 0.8125, 1}, EdgeCase{s1, s2, m2, m1, 0.375, 1 - 0.8125, 1},
        EdgeCase{s2, s1, m1, m2, 1 - 0.375, 0.8125, 1},
        EdgeCase{m1, m2, s1, s2, 0.8125, 0.375, 1}}) {
    expect_edges<Form::robust>(c);
    EXPECT_TRUE((closest_between_edges<Form::robust>(c.s1, c.s2, c.m1, c.m2).parallel));
  }
  const auto apart =
      closest_between_edges<Form::robust>(P{0, 0, 0}, P{1, 0, 0}, P{3, 0, 0}, P{2, 0, 0});
  EXPECT_EQ(apart.distance, 1.0);
  EXPECT_FALSE(apart.parallel) << "along the axis they meet at ends";
}

TEST(EdgeEnds, EndToEnd) {
  const EdgeCase c{{0, 0, 0}, {4, 0, 0}, {4.3, 0.4, 0}, {8, 3, 0}, 0.0, 1.0, 0.5};
  expect_edges<Form::reference>(c);
  expect_edges<Form::robust>(c);
  const auto e = closest_between_edges<Form::robust>(c.s1, c.s2, c.m1, c.m2);
  EXPECT_EQ(e.feature_s, EdgeFeature::second_node);
  EXPECT_EQ(e.feature_m, EdgeFeature::first_node);
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  P point(double scale = 1.0) {
    return {uniform(-scale, scale), uniform(-scale, scale), uniform(-scale, scale)};
  }
  Corners segment(bool triangle) {
    Corners x{point(), point(), point(), point()};
    if (triangle) x[3] = x[2];
    return x;
  }

 private:
  std::mt19937_64 engine_;
};

TEST(RobustSegment, AgreesWithExactArithmetic) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const bool triangle = i % 3 == 0;
    const Corners x = random.segment(triangle);
    const P p = random.point(1.5);
    const ExactSegment exact = exact_closest_on_segment(p, x, triangle);
    const auto robust = closest_on_segment<Form::robust>(p, x, triangle);
    EXPECT_NEAR(robust.distance(), exact.distance, 1e-13 * (1.0 + exact.distance));
    const auto wide = closest_on_segment<Form::robust>(
        Point3<DoubleDouble>{p.x, p.y, p.z},
        std::array<Point3<DoubleDouble>, 4>{Point3<DoubleDouble>{x[0].x, x[0].y, x[0].z},
                                            {x[1].x, x[1].y, x[1].z},
                                            {x[2].x, x[2].y, x[2].z},
                                            {x[3].x, x[3].y, x[3].z}},
        triangle);
    EXPECT_EQ(wide.distance().hi(), exact.distance);
  }
}

TEST(RobustSegment, AgreesWithReferenceOnWellShapedQuads) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    Corners x = flat;
    for (P& corner : x) corner = corner + random.point(2.0);
    const P p = random.point(8.0) + P{5, 5, 0};
    const auto a = closest_on_segment<Form::reference>(p, x, false);
    const auto b = closest_on_segment<Form::robust>(p, x, false);
    EXPECT_NEAR(a.distance(), b.distance(), 1e-13);
    const P q =
        a.weights[0] * x[0] + a.weights[1] * x[1] + a.weights[2] * x[2] + a.weights[3] * x[3];
    EXPECT_NEAR(std::sqrt(dot(p - q, p - q)), a.distance(), 1e-13);
  }
}

TEST(RobustSegment, PowerOfTwoScalingIsExact) {
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    const bool triangle = i % 2 == 0;
    const Corners x = random.segment(triangle);
    const P p = random.point(1.5);
    const auto base = closest_on_segment<Form::robust>(p, x, triangle);
    for (const int k : {-300, -150, -31, 17, 150, 300}) {
      const auto scale = [k](const P& v) {
        return P{std::ldexp(v.x, k), std::ldexp(v.y, k), std::ldexp(v.z, k)};
      };
      const auto c = closest_on_segment<Form::robust>(
          scale(p), Corners{scale(x[0]), scale(x[1]), scale(x[2]), scale(x[3])}, triangle);
      EXPECT_EQ(c.distance(), std::ldexp(base.distance(), k));
      EXPECT_EQ(c.weights, base.weights);
    }
  }
}

TEST(RobustSegment, ObtuseSubTriangleGivesTheClosestPointInBothForms) {
  const Corners x{P{0, 0, 0}, P{10, 0.5, 0}, P{-8, 0.5, 0}, P{-8, 0.5, 0}};
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const P p = random.point(3.0);
    const double exact = exact_closest_on_segment(p, x, true).distance;
    EXPECT_NEAR(closest_on_segment<Form::robust>(p, x, true).distance(), exact, 1e-13);
    EXPECT_NEAR((closest_on_segment<Form::reference>(p, x, true).distance()), exact, 1e-13);
  }
}

TEST(RobustEdges, AgreeWithExactArithmetic) {
  Random random(6);
  for (int i = 0; i < 3000; ++i) {
    P s1 = random.point(), s2 = random.point(), m1 = random.point(), m2 = random.point();
    if (i % 3 == 1) m2 = m1 + random.uniform(-1, 1) * (s2 - s1) + random.point(1e-9);
    if (i % 3 == 2) m2 = m1 + 0.5 * (s2 - s1);
    const ExactEdges exact = exact_closest_between_edges(s1, s2, m1, m2);
    const auto robust = closest_between_edges<Form::robust>(s1, s2, m1, m2);
    const auto reference = closest_between_edges<Form::reference>(s1, s2, m1, m2);
    EXPECT_NEAR(robust.distance, exact.distance, 4e-15);
    EXPECT_GE(reference.distance, exact.distance - 4e-15);
  }
}

TEST(RobustEdges, TurnToParallelWithoutAJump) {
  // Two long edges one above the other: whatever the angle, the distance stays 1.
  for (double angle = 1e-4; angle > 1e-18; angle *= 0.1) {
    const auto e = closest_between_edges<Form::robust>(P{-1, 0, 0}, P{1, 0, 0}, P{-1, -angle, 1},
                                                       P{1, angle, 1});
    EXPECT_NEAR(e.distance, 1.0, 1e-15) << angle;
  }
}

TEST(RobustEdges, PowerOfTwoScalingIsExact) {
  Random random(7);
  for (int i = 0; i < 300; ++i) {
    const P s1 = random.point(), s2 = random.point(), m1 = random.point();
    const P m2 = i % 4 == 0 ? m1 + 0.5 * (s2 - s1) : random.point();
    const auto base = closest_between_edges<Form::robust>(s1, s2, m1, m2);
    for (const int k : {-300, -150, 40, 150, 300}) {
      const auto scale = [k](const P& v) {
        return P{std::ldexp(v.x, k), std::ldexp(v.y, k), std::ldexp(v.z, k)};
      };
      const auto c =
          closest_between_edges<Form::robust>(scale(s1), scale(s2), scale(m1), scale(m2));
      EXPECT_EQ(c.distance, std::ldexp(base.distance, k));
      EXPECT_EQ(c.weight_s, base.weight_s);
      EXPECT_EQ(c.weight_m, base.weight_m);
    }
  }
}

TEST(ExactDecision, SeesOneUnitInTheLastPlace) {
  const P p{3, 4, 0.1 * 3.0};
  EXPECT_EQ(exact_compare_distance(p, flat, false, 0.3), 1);
  EXPECT_EQ(exact_compare_distance(p, flat, false, 0.1 * 3.0), 0);
  EXPECT_EQ(exact_compare_distance(p, flat, false, std::nextafter(0.1 * 3.0, 1.0)), -1);
  EXPECT_EQ(exact_compare_distance(P{0, 0, 0}, P{1, 0, 0}, P{0, 0, 3}, P{0, 1, 3}, 3.0), 0);
}

}  // namespace
}  // namespace deck
