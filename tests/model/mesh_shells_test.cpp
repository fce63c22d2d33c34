// Step, mass and stiffness of one shell against the formulas of its kind, on shells without any
// symmetry: other sides, other angles, other thickness.
#include "model/mesh_elements.hpp"

#include <algorithm>
#include <numbers>

namespace deck::test {
namespace {

/// A quadrangle that is warped, with four different sides.
const std::array<Vec, 4> warped{Vec{1, 2, 3}, Vec{9, 3, 3.5}, Vec{8, 8, 2}, Vec{0, 6, 4}};

struct Plane {
  std::array<Vec, 4> p;  ///< z is 0
  double area = 0, half = 0;
};
/// Section 2 of time_step.md: local axes, and the two areas.
Plane plane_of(const std::array<Vec, 4>& x) {
  const Vec r = x[1] + x[2] - x[0] - x[3], s = x[2] + x[3] - x[0] - x[1];
  const Vec e3 = unit(cross(r, s));
  const Vec e1 = unit(r + norm(r) / norm(s) * cross(s, e3)), e2 = cross(e3, e1);
  Plane out;
  for (std::size_t i = 0; i < 4; ++i) out.p[i] = {dot(x[i] - x[0], e1), dot(x[i] - x[0], e2), 0};
  out.area = 0.5 * norm(cross(x[2] - x[0], x[3] - x[1]));
  out.half = norm(cross(r, s)) / 4;
  return out;
}

TEST(Shell4, HasTheLengthAndStiffnessOfOnePoint) {
  const Plane f = plane_of(warped);
  const auto side = [&](std::size_t a, std::size_t b) { return norm(f.p[b] - f.p[a]); };
  const double d = std::max(side(0, 2), side(1, 3));
  for (const int ishell : {0, 1, 2, 3, 4}) {
    PartRow row = part(36);
    row.property.ishell = ishell;
    row.property.membrane = 0.25;
    ElementOutcome o;
    detail::shell4_outcome(row, 2, warped, o);
    const double length = std::max(f.area / d, std::min({side(0, 1), side(1, 2), side(2, 3),
                                                         side(3, 0), side(0, 2), side(1, 3)}));
    expect_near(o.length, length);
    expect_near(o.dt, length * damp(0.25) / 11);
    expect_near(o.mass, 3 * 2 * f.area);
    expect_near(o.inertia, o.mass * (f.area / 9 + 4.0 / 12));
    expect_near(o.stiffness, d * d / 4 * 2 * 230 / (f.area * damp(0.25) * damp(0.25)));
    expect_near(o.rotational, o.stiffness * (4 + f.area) / 12);
    EXPECT_EQ(o.share, (std::array<double, 8>{0.25, 0.25, 0.25, 0.25}));
  }
}

TEST(Shell4, LengthIsTheShortestSideOrTheAreaOverTheDiagonal) {
  const auto length = [](const std::array<Vec, 4>& x) {
    ElementOutcome o;
    detail::shell4_outcome(part(), 1, x, o);
    return o.length;
  };
  const Vec a{0, 0, 0}, b{6, 0, 0}, c{6, 4, 0}, d{0, 4, 0};
  expect_near(length({a, b, c, d}), 4);
  expect_near(length({b, c, d, a}), 4);
  // A kite's area over its longer diagonal is more than its shortest side.
  const std::array<Vec, 4> kite{Vec{0, 0, 0}, Vec{5, -4, 0}, Vec{10, 0, 0}, Vec{9, 2, 0}};
  expect_near(length(kite), 0.5 * norm(cross(kite[2] - kite[0], kite[3] - kite[1])) / 10);
  // A quadrangle whose last side has no length has the sides of a triangle alone.
  expect_near(length({Vec{0, 0, 0}, Vec{10, 0, 0}, Vec{0, 5, 0}, Vec{0, 5, 0}}), 5);
}

TEST(Shell4, OfSeveralPointsHasItsOwnLength) {
  const Plane f = plane_of(warped);
  Vec middle{};
  for (const Vec& p : f.p) middle = middle + 0.25 * p;
  std::array<Vec, 4> c = f.p;
  for (Vec& p : c) p = p - middle;
  const Vec p = 0.5 * (c[0] - c[2]), q = 0.5 * (c[1] - c[3]);
  const double area = f.half;
  const double a1 = std::max(dot(p, p), dot(q, q));
  const double a2 = std::max(std::abs(cross(c[1], c[3]).z), std::abs(cross(c[0], c[2]).z)) / area;
  const double c1 = norm(q - p), c2 = norm(q + p);
  const double f1 = 1 + std::min(0.5, 0.25 * (std::max(c1, c2) / std::min(c1, c2) - 1));
  const double u =
      static_cast<double>(3.413f) * std::max(0.0, area / (c1 * c2) - static_cast<double>(0.7071f));
  const double f2 = static_cast<double>(0.78f) + static_cast<double>(0.22f) * std::pow(u, 3);
  ASSERT_GT(u, 0.1);
  ASSERT_GT(f1, 1.01);
  ASSERT_LT(f1, 1.49);
  for (const int ishell : {12, 24}) {
    PartRow row = part(36);
    row.property.ishell = ishell;
    row.property.membrane = 0.01;
    ElementOutcome o;
    detail::shell4_outcome(row, 2, warped, o);
    const double k = ishell == 12 ? 4.0 / 3 : 1.25, v = ishell == 12 ? 0.01 : 0.015;
    const double length = area / std::sqrt(2 * f1 * f2 * (k + a2) * a1);
    expect_near(o.length, length);
    expect_near(o.dt, length * damp(v) / 11);
    expect_near(o.mass, 3 * 2 * area);
    expect_near(o.inertia, o.mass * (area / 12 + 4.0 / 12));
    expect_near(o.stiffness, 0.5 * 2 * area * 230 / std::pow(length * damp(v), 2));
    expect_near(o.rotational, o.stiffness * 4 / 12);
  }
}

TEST(Shell4, NarrowAndSlantedOnesHaveBoundedFactors) {
  // f1 is at most 1.5; u is 0 where the area is less than 0.7071 of the product of middle lines.
  const auto length = [](const std::array<Vec, 4>& x, double f1, double f2) {
    PartRow row = part();
    row.property.ishell = 12;
    ElementOutcome o;
    detail::shell4_outcome(row, 1, x, o);
    const Plane f = plane_of(x);
    const Vec p = 0.5 * (f.p[0] - f.p[2]), q = 0.5 * (f.p[1] - f.p[3]);
    // Of a parallelogram the middle lies between opposite corners: a2 is 0.
    const double a1 = std::max(dot(p, p), dot(q, q));
    expect_near(o.length, f.half / std::sqrt(2 * f1 * f2 * (4.0 / 3) * a1), 1e-9);
  };
  const double u = static_cast<double>(3.413f) * (1 - static_cast<double>(0.7071f));
  const double square = static_cast<double>(0.78f) + static_cast<double>(0.22f) * u * u * u;
  length({Vec{0, 0, 0}, Vec{30, 0, 0}, Vec{30, 5, 0}, Vec{0, 5, 0}}, 1.5, square);
  length({Vec{0, 0, 0}, Vec{5, 0, 0}, Vec{10, 5, 0}, Vec{5, 5, 0}}, 1 + 0.25 * (std::sqrt(2.0) - 1),
         static_cast<double>(0.78f) +
             static_cast<double>(0.22f) *
                 std::pow(static_cast<double>(3.413f) *
                              std::max(0.0, 1 / std::sqrt(2.0) - static_cast<double>(0.7071f)),
                          3));
}

TEST(Shells, HaveTheMembraneDampingOfTheirLaw) {
  // By law: with Ishell 1, 12 and 24; of triangles with the same.
  struct Row {
    int law;
    std::array<double, 3> quad, triangle;
  };
  const Row rows[] = {
      {1, {0, 0, 0.015}, {0, 0, 0}},
      {2, {0, 0, 0.015}, {0, 0, 0}},
      {3, {0, 0, 0.015}, {0, 0, 0}},
      {22, {0, 0, 0.015}, {0, 0, 0}},
      {23, {0, 0, 0.015}, {0, 0, 0}},
      {36, {0, 0, 0.015}, {0, 0, 0.015}},
      {91, {0, 0, 0.015}, {0, 0, 0}},
      {65, {0.05, 0.05, 0.05}, {0.05, 0.05, 0.05}},
      {15, {0.05, 0.05, 0.05}, {0.05, 0.05, 0.05}},
      {27, {0.05, 0.05, 0.05}, {0.05, 0.05, 0.05}},
      {19, {0.25, 0.25, 0.015}, {0.25, 0.25, 0.25}},
      {119, {0.25, 0.25, 0.015}, {0.25, 0.25, 0.25}},
      {58, {0.075, 0.2, 0.075}, {0.075, 0.2, 0.075}},
      {158, {0.075, 0.2, 0.075}, {0.075, 0.2, 0.075}},
      {25, {0.05, 0.05, 0.1}, {0.05, 0.05, 0.1}},
      {123, {0.05, 0.05, 0.1}, {0.05, 0.05, 0.1}},
      {125, {0.05, 0.05, 0.1}, {0.05, 0.05, 0.1}},
      {127, {0.05, 0.05, 0.1}, {0.05, 0.05, 0.1}},
      {132, {0.05, 0.05, 0.1}, {0.05, 0.05, 0.1}},
      {42, {0.03, 0.04, 0.03}, {0.03, 0.04, 0.03}},
      {69, {0.03, 0.04, 0.03}, {0.03, 0.04, 0.03}},
  };
  constexpr int ishells[] = {1, 12, 24};
  const std::array<Vec, 3> corner{warped[0], warped[1], warped[2]};
  for (const Row& r : rows)
    for (std::size_t i = 0; i < 3; ++i) {
      PartRow row = part(r.law);
      row.property.ishell = ishells[i];
      ElementOutcome four, three;
      detail::shell4_outcome(row, 2, warped, four);
      detail::shell3_outcome(row, 2, corner, three);
      EXPECT_NEAR(four.dt * 11 / four.length, damp(r.quad[i]), 1e-13) << r.law << " " << i;
      EXPECT_NEAR(three.dt * 11 / three.length, damp(r.triangle[i]), 1e-13) << r.law << " " << i;
    }
}

TEST(Shells, TakeTheDampingOfTheirPropertyWhereTheLawLetsThem) {
  const auto of = [](int law, int ishell, double dm, double dn, int type = 1) {
    PartRow row = part(law, type);
    row.property.ishell = ishell;
    row.property.membrane = dm;
    row.property.numeric = dn;
    ElementOutcome o;
    detail::shell4_outcome(row, 2, warped, o);
    const double d = o.dt * 11 / o.length;
    return (1 - d * d) / (2 * d);
  };
  for (const int law : {1, 2, 3, 22, 23}) EXPECT_NEAR(of(law, 1, 0.3, 0), 0, 1e-12) << law;
  EXPECT_NEAR(of(36, 1, 0.3, 0), 0.3, 1e-12);
  EXPECT_NEAR(of(25, 1, 0.3, 0), 0.3, 1e-12);
  EXPECT_NEAR(of(91, 1, 0.3, 0), 0.3, 1e-12);
  EXPECT_NEAR(of(91, 12, 0.3, 0), 0, 1e-12);
  EXPECT_NEAR(of(91, 24, 0.3, 0), 0.015, 1e-12);
  EXPECT_NEAR(of(36, 12, 0.3, 0.4), 0.4, 1e-12) << "the larger one";
  EXPECT_NEAR(of(36, 12, 0.3, 0.2), 0.3, 1e-12);
  EXPECT_NEAR(of(1, 12, 0.3, 0.2), 0.2, 1e-12) << "dn stays";
  EXPECT_NEAR(of(1, 24, 0, 0.2), 0.2, 1e-12);
  EXPECT_NEAR(of(1, 1, 0, 0.2), 0, 1e-12) << "of one point there is none";
  EXPECT_NEAR(of(36, 24, 0, 0.001, 9), 0.015, 1e-12);
  EXPECT_NEAR(of(36, 24, 0, 0.001, 10), 0.001, 1e-12) << "property 10";
  EXPECT_NEAR(of(36, 24, 0, 0, 10), 0.015, 1e-12);
}

TEST(Shell3, HasItsSmallestHeightAndSharesByItsAngles) {
  const std::array<Vec, 3> x{Vec{1, 2, 3}, Vec{9, 4, 4}, Vec{3, 7, 1}};
  const Vec a = x[1] - x[0], b = x[2] - x[0], c = x[2] - x[1];
  const double area = norm(cross(a, b)) / 2, longest = std::max({norm(a), norm(b), norm(c)}),
               shortest = std::min({norm(a), norm(b), norm(c)});
  const auto angle = [](double near1, double near2, double far) {
    return std::acos((near1 * near1 + near2 * near2 - far * far) / (2 * near1 * near2)) /
           std::numbers::pi;
  };
  for (const int ish3n : {0, 1, 2, 30}) {
    PartRow row = part(36);
    row.property.ish3n = ish3n;
    row.property.membrane = 0.125;
    ElementOutcome o;
    detail::shell3_outcome(row, 3, x, o);
    const double dkt = ish3n == 30 ? 1 + 0.6 * 1.3 * 9 / (shortest * shortest) : 1;
    const double length = 2 * area / (longest * std::sqrt(dkt));
    expect_near(o.length, length);
    expect_near(o.dt, length * damp(0.125) / 11);
    expect_near(o.mass, 3 * 3 * area);
    expect_near(o.inertia, o.mass * (area / 4.5 + 9.0 / 12));
    expect_near(o.share[0], angle(norm(a), norm(b), norm(c)));
    expect_near(o.share[1], angle(norm(a), norm(c), norm(b)));
    expect_near(o.share[2], angle(norm(b), norm(c), norm(a)));
    const double k = ish3n == 30 ? 0 : area * 3 * 230 / std::pow(length * damp(0.125), 2);
    EXPECT_NEAR(o.stiffness, k, 1e-12 * k);
    const double r = k * (9.0 / 12 + area / 2 * 80 / 230);
    EXPECT_NEAR(o.rotational, r, 1e-12 * r);
  }
  // Each side can be the longest or the shortest one.
  for (std::size_t turn = 0; turn < 3; ++turn) {
    PartRow row = part();
    row.property.ish3n = 30;
    ElementOutcome first, o;
    detail::shell3_outcome(row, 3, x, first);
    detail::shell3_outcome(row, 3, {x[turn], x[(turn + 1) % 3], x[(turn + 2) % 3]}, o);
    expect_near(o.dt, first.dt);
  }
}

}  // namespace
}  // namespace deck::test
