// Step, mass and stiffness of one element against the formulas of its kind, on elements without any
// symmetry: other sides, other angles, other thickness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "model/mesh/mesh_parts.hpp"

namespace deck::test {
namespace {

using detail::ElementOutcome;
using detail::not_known;
using detail::PartRow;

void expect_near(double got, double wanted, double share = 1e-12) {
  EXPECT_NEAR(got, wanted, share * std::abs(wanted));
}

/// An elastic part: E 210, nu 0.3, density 3 (that of reference 2), thickness 2.
PartRow part(int law = 1, int type = 1) {
  PartRow row;
  row.material.law = law;
  row.material.density = 3;
  row.material.reference_density = 2;
  row.material.young = 210;
  row.material.poisson = 0.3;
  row.material.shear = 80;
  row.material.shell_speed = 11;
  row.material.solid_speed = 13;
  row.material.stored_speed = 9;
  row.material.plate_modulus = 230;
  row.material.tetra_ratio = 0.5;
  row.property.type = type;
  row.property.isolid = 1;
  row.thickness = 2;
  return row;
}

double damp(double v) { return std::sqrt(1 + v * v) - v; }

// ---- shells ------------------------------------------------------------------------------------

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

TEST(Shell4, EverySideAndDiagonalCanBeTheLength) {
  // A rectangle of sides 6 and 4: the area over the diagonal is less than the shorter side.
  const auto length = [](const std::array<Vec, 4>& x) {
    ElementOutcome o;
    detail::shell4_outcome(part(), 1, x, o);
    return o.length;
  };
  const Vec a{0, 0, 0}, b{6, 0, 0}, c{6, 4, 0}, d{0, 4, 0};
  expect_near(length({a, b, c, d}), 4);
  expect_near(length({b, c, d, a}), 4);
  // One side at a time is the shortest one.
  const std::array<Vec, 4> kite{Vec{0, 0, 0}, Vec{5, -4, 0}, Vec{10, 0, 0}, Vec{9, 2, 0}};
  const double shortest = std::sqrt(5.0);
  const double area = 0.5 * norm(cross(kite[2] - kite[0], kite[3] - kite[1])), longest = 10;
  ASSERT_LT(shortest, area / longest) << "the area over the longer diagonal is the larger one";
  expect_near(length(kite), area / longest);
  // A rhombus whose shorter diagonal, 2, is below its sides; the area over the longer one is not
  // above it.
  const std::array<Vec, 4> rhombus{Vec{-5, 0, 0}, Vec{0, -1, 0}, Vec{5, 0, 0}, Vec{0, 1, 0}};
  expect_near(length(rhombus), 2);
  expect_near(length({rhombus[1], rhombus[2], rhombus[3], rhombus[0]}), 2);
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

TEST(Shells, OfRigidPartsHaveMassOnly) {
  PartRow row = part();
  row.rigid = true;
  ElementOutcome four, three;
  detail::shell4_outcome(row, 2, warped, four);
  detail::shell3_outcome(row, 2, {warped[0], warped[1], warped[2]}, three);
  for (const ElementOutcome* o : {&four, &three}) {
    EXPECT_GT(o->mass, 0);
    EXPECT_GT(o->inertia, 0);
    EXPECT_EQ(o->dt, no_step);
    EXPECT_EQ(o->stiffness, 0);
    EXPECT_EQ(o->rotational, 0);
  }
}

// ---- solids ------------------------------------------------------------------------------------

/// A hexahedron without two equal sides.
const std::array<Vec, 8> hexa{Vec{0, 0, 0},   Vec{10, 1, 0}, Vec{11, 7, 1}, Vec{1, 6, 0},
                              Vec{0.5, 0, 4}, Vec{10, 0, 5}, Vec{12, 8, 6}, Vec{0, 6, 4.5}};

constexpr int hexa_faces[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                  {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// Slope of the eight functions' map by coordinate `k`, by a central difference: they are linear.
Vec slope(const std::array<Vec, 8>& x, std::array<double, 3> at, std::size_t k) {
  const auto place = [&](const std::array<double, 3>& r) {
    constexpr int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    Vec out{};
    for (std::size_t n = 0; n < 8; ++n)
      out = out +
            (1 + sign[n][0] * r[0]) * (1 + sign[n][1] * r[1]) * (1 + sign[n][2] * r[2]) / 8 * x[n];
    return out;
  };
  std::array<double, 3> before = at, after = at;
  before[k] -= 1;
  after[k] += 1;
  return 0.5 * (place(after) - place(before));
}
double jacobian(const std::array<Vec, 8>& x, const std::array<double, 3>& at) {
  return dot(slope(x, at, 0), cross(slope(x, at, 1), slope(x, at, 2)));
}

/// Section 4 of time_step.md.
double step_of(double length, double size, double qb = 0.05, double lambda = 0, double mu = 0,
               double c = 13) {
  const double q = (qb + lambda) * c + mu * c * size / length;
  return length / (q + std::sqrt(q * q + c * c));
}

double hexa_length(const std::array<Vec, 8>& x) {
  double largest = 0;
  for (const auto& c : hexa_faces) {
    const Vec ac = x[static_cast<std::size_t>(c[2])] - x[static_cast<std::size_t>(c[0])];
    const Vec bd = x[static_cast<std::size_t>(c[3])] - x[static_cast<std::size_t>(c[1])];
    const Vec s = ac - bd, w = ac + bd;
    largest = std::max(largest, dot(s, s) * dot(w, w) - dot(s, w) * dot(s, w));
  }
  return 4 * 8 * jacobian(x, {0, 0, 0}) / std::sqrt(largest);
}

ElementOutcome solid(const PartRow& row, const std::array<Vec, 8>& x,
                     SolidShape shape = SolidShape::brick8,
                     const std::array<Vec, 6>* middle = nullptr) {
  ElementOutcome o;
  detail::solid_outcome(row, shape, x, middle, o);
  return o;
}

TEST(Solid, OfOnePointHasItsVolumeOverItsLargestFace) {
  const double volume = 8 * jacobian(hexa, {0, 0, 0});
  for (const int isolid : {0, 1, 2, 24}) {
    PartRow row = part(1, 14);
    row.property.isolid = isolid;
    row.property.qb = 0.07;
    row.property.lambda = 0.2;
    row.property.mu = 0.3;
    const ElementOutcome o = solid(row, hexa);
    expect_near(o.length, hexa_length(hexa), 1e-11);
    expect_near(o.mass, 3 * volume);
    expect_near(o.dt, step_of(o.length, std::cbrt(volume), 0.07, 0.2, 0.3));
    expect_near(o.stiffness, 0.25 * o.mass / (o.dt * o.dt));
    EXPECT_EQ(o.why, nullptr);
    for (const double s : o.share) EXPECT_EQ(s, 0.125);
  }
  // Whichever face is the largest one.
  constexpr int turned[3][8] = {
      {0, 1, 2, 3, 4, 5, 6, 7}, {0, 4, 5, 1, 3, 7, 6, 2}, {0, 3, 7, 4, 1, 2, 6, 5}};
  for (const auto& t : turned)
    for (int flip = 0; flip < 2; ++flip) {
      std::array<Vec, 8> x;
      for (std::size_t i = 0; i < 8; ++i)
        x[i] = hexa[static_cast<std::size_t>(t[(i + (flip != 0 ? 4 : 0)) % 8])];
      if (flip != 0) std::swap(x[1], x[3]), std::swap(x[5], x[7]);
      expect_near(solid(part(1, 14), x).length, hexa_length(hexa), 1e-11);
    }
}

TEST(Solid, ThatIsAThinPlateIsATousandTimesAsLong) {
  // Four of six faces are below a hundredth of the largest one: the square of it is 1e-4.
  const auto plate = [](double t) {
    std::array<Vec, 8> x;
    for (std::size_t i = 0; i < 8; ++i)
      x[i] = {i % 4 == 1 || i % 4 == 2 ? 1.0 : 0.0, i % 4 > 1 ? 1.0 : 0.0, i > 3 ? t : 0.0};
    return solid(part(1, 14), x).length;
  };
  expect_near(plate(0.0101), 0.0101);
  expect_near(plate(0.0099), 0.0099 * 1000, 1e-9);
  // Three small faces are enough, two are not: a wedge that ends in a narrow edge.
  const auto wedge = [](double edge, double low) {
    const std::array<Vec, 8> x{Vec{0, 0, 0},   Vec{1, 0, 0},   Vec{1, 1, 0},    Vec{0, 1, 0},
                               Vec{0, 0, low}, Vec{1, 0, low}, Vec{1, 1, edge}, Vec{0, 1, edge}};
    return solid(part(1, 14), x).length;
  };
  EXPECT_GT(wedge(0.015, 0.001), 1) << "three: 0.001, and twice 0.008";
  EXPECT_LT(wedge(0.03, 0.001), 0.1) << "one: 0.001; the others are 0.0155 and more";
}

/// Isolid 14 and the like: least Jacobian of some points over the largest middle face.
double many_points_length(const std::array<Vec, 8>& x,
                          const std::array<std::vector<double>, 3>& p) {
  const auto wide = [&](std::size_t a, std::size_t b) {
    return norm(cross(8 * slope(x, {0, 0, 0}, a), 8 * slope(x, {0, 0, 0}, b)));
  };
  double least = 1e300;
  for (const double a : p[0])
    for (const double b : p[1])
      for (const double c : p[2]) least = std::min(least, jacobian(x, {a, b, c}));
  return 128 * least / std::max({wide(0, 1), wide(1, 2), wide(2, 0)});
}
const std::vector<double> two{-std::sqrt(1 / 3.0), std::sqrt(1 / 3.0)},
    three{-std::sqrt(0.6), 0, std::sqrt(0.6)};

/// Volume of a hexahedron, by the rule of two points, which is exact.
double volume_of(const std::array<Vec, 8>& x) {
  double v = 0;
  for (const double a : two)
    for (const double b : two)
      for (const double c : two) v += jacobian(x, {a, b, c});
  return v;
}

TEST(Solid, OfSeveralPointsHasTheLeastJacobianOverTheLargestMiddleFace) {
  struct Row {
    int isolid, law, inpts;
    const std::vector<double>* points;  ///< nullptr: not evaluated
  };
  const Row rows[] = {
      {12, 36, 0, &two},      {17, 36, 0, &two},    {18, 1, 0, &two},       {18, 2, 0, &two},
      {18, 42, 0, &two},      {18, 36, 0, nullptr}, {14, 36, 0, &two},      {14, 36, 222, &two},
      {14, 36, 333, &three},  {14, 1, 333, &two},   {14, 36, 444, nullptr}, {14, 1, 444, &two},
      {16, 36, 222, nullptr},
  };
  for (const Row& r : rows) {
    PartRow row = part(r.law, 14);
    row.property.isolid = r.isolid;
    row.property.inpts = r.inpts;
    row.property.mu = 0.3;
    const ElementOutcome o = solid(row, hexa);
    if (r.points == nullptr) {
      EXPECT_TRUE(std::isnan(o.dt)) << r.isolid << " " << r.law;
      EXPECT_TRUE(std::isnan(o.length));
      EXPECT_NE(o.why, nullptr);
      expect_near(o.mass, 3 * 8 * jacobian(hexa, {0, 0, 0}));
      continue;
    }
    expect_near(o.length, many_points_length(hexa, {*r.points, *r.points, *r.points}), 1e-11);
    expect_near(o.mass, 3 * volume_of(hexa), 1e-11);
    expect_near(o.dt, step_of(o.length, std::cbrt(8 * jacobian(hexa, {0, 0, 0})), 0.05, 0, 0.3));
    EXPECT_EQ(o.why, nullptr);
    EXPECT_EQ(o.share[0] == 0.125, r.isolid != 12);
  }
}

TEST(Solid, OfIsolid12SharesItsMassByTheVolumeAroundItsCorners) {
  PartRow row = part(36, 14);
  row.property.isolid = 12;
  const ElementOutcome o = solid(row, hexa);
  double all = 0;
  for (std::size_t n = 0; n < 8; ++n) {
    constexpr int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    double v = 0;
    for (const double a : two)
      for (const double b : two)
        for (const double c : two)
          v += (1 + sign[n][0] * a) * (1 + sign[n][1] * b) * (1 + sign[n][2] * c) / 8 *
               jacobian(hexa, {a, b, c});
    expect_near(o.share[n], v / volume_of(hexa), 1e-11);
    all += o.share[n];
  }
  expect_near(all, 1);
}

TEST(ThickShell, HasTheLayersOfItsPoints) {
  const std::vector<double> layers[] = {
      {},
      {0},
      two,
      three,
      {-0.861136311594053, -0.339981043584856, 0.339981043584856, 0.861136311594053},
      {-0.906179845938664, -0.538469310105683, 0, 0.538469310105683, 0.906179845938664}};
  const auto of = [](int type, int law, int isolid, int inpts, int icstr) {
    PartRow row = part(law, type);
    row.property.isolid = isolid;
    row.property.inpts = inpts;
    row.property.icstr = icstr;
    return solid(row, hexa);
  };
  for (const int type : {20, 21, 22}) {
    for (int n = 1; n <= 5; ++n) {
      const ElementOutcome o = of(type, 36, 14, 202 + 10 * n, 10);
      expect_near(o.length, many_points_length(hexa, {two, two, layers[n]}), 1e-9);
      EXPECT_EQ(o.why, nullptr);
      for (const double s : o.share) EXPECT_EQ(s, 0.125);
    }
    for (const int inpts : {262, 202, 233}) EXPECT_TRUE(std::isnan(of(type, 36, 14, inpts, 10).dt));
    EXPECT_TRUE(std::isnan(of(type, 36, 14, 232, 1).dt)) << "another direction of layers";
    expect_near(of(type, 36, 14, 222, 1).length, many_points_length(hexa, {two, two, two}), 1e-11);
    expect_near(of(type, 1, 14, 232, 10).length, many_points_length(hexa, {two, two, two}), 1e-11);
    expect_near(of(type, 36, 15, 232, 10).length, hexa_length(hexa), 1e-11);
    EXPECT_TRUE(std::isnan(of(type, 36, 12, 222, 10).dt));
    EXPECT_NE(of(type, 36, 12, 222, 10).why, nullptr);
  }
  // The rules add up to the volume of a box, whatever their number.
  std::array<Vec, 8> box;
  for (std::size_t i = 0; i < 8; ++i)
    box[i] = {i % 4 == 1 || i % 4 == 2 ? 5.0 : 0.0, i % 4 > 1 ? 3.0 : 0.0, i > 3 ? 2.0 : 0.0};
  for (int n = 1; n <= 5; ++n) {
    PartRow row = part(36, 20);
    row.property.isolid = 14;
    row.property.inpts = 202 + 10 * n;
    row.property.icstr = 10;
    expect_near(solid(row, box).mass, 3 * 30, 1e-12);
  }
}

TEST(Penta, HasItsVolumeOverItsLargestFaceWithOneThatIsTwisted) {
  // A prism of height 3 over a triangle with legs 8 and 5: the face over the hypotenuse is largest.
  const std::array<Vec, 6> p{Vec{0, 0, 0}, Vec{8, 0, 0}, Vec{0, 5, 0},
                             Vec{0, 0, 3}, Vec{8, 0, 3}, Vec{0, 5, 3}};
  const std::array<Vec, 8> slots{p[0], p[1], p[2], p[0], p[3], p[4], p[5], p[3]};
  const double volume = 0.5 * 8 * 5 * 3;
  for (const int type : {14, 20}) {
    const ElementOutcome o = solid(part(36, type), slots, SolidShape::penta6);
    expect_near(o.mass, 3 * volume);
    expect_near(o.length, volume / (3 * std::sqrt(64.0 + 25)), 1e-11);
    expect_near(o.dt, step_of(o.length, std::cbrt(volume)));
    expect_near(o.stiffness, 0.25 * o.mass / (o.dt * o.dt));
    EXPECT_EQ(o.why, nullptr);
    const double s = 1.0 / 6;
    EXPECT_EQ(o.share, (std::array<double, 8>{s, s, s, 0, s, s, s, 0}));
  }
  // A flat one: the triangles are the largest faces, each half of a parallelogram.
  std::array<Vec, 8> flat = slots;
  for (Vec& v : flat) v.z *= 0.25;
  expect_near(solid(part(36, 14), flat, SolidShape::penta6).length, 0.75, 1e-11);
}

TEST(Penta, WhoseFirstFaceGovernsIsGivenOfThickShellsOnly) {
  // The first face is the largest one: legs 8 and 1, its corners 5 and 4 exchange their local y.
  const std::array<Vec, 6> p{Vec{0, 0, 0}, Vec{8, 0, 0}, Vec{4, 1, 0},
                             Vec{0, 0, 6}, Vec{8, 0, 6}, Vec{4, 1, 6}};
  const std::array<Vec, 8> slots{p[0], p[1], p[2], p[0], p[3], p[4], p[5], p[3]};
  const ElementOutcome o = solid(part(36, 14), slots, SolidShape::penta6);
  EXPECT_TRUE(std::isnan(o.dt));
  EXPECT_TRUE(std::isnan(o.length));
  EXPECT_NE(o.why, nullptr);
  expect_near(o.mass, 3 * 24);
  const ElementOutcome thick = solid(part(36, 20), slots, SolidShape::penta6);
  // The axes of section 4 by hand: e3 is z, e1 halves the directions of T and of U turned back.
  const Vec t = 2.0 * (p[1] - p[0]), u = 2.0 * (p[2] - p[0]);
  const Vec e3 = unit(cross(t, u)), e1 = unit(norm(u) * t + norm(t) * cross(u, e3)),
            e2 = cross(e3, e1);
  const auto local = [&](const Vec& v) { return Vec{dot(v, e1), dot(v, e2), dot(v, e3)}; };
  const Vec a = local(p[0]), b = local(p[1]);
  Vec c = local(p[4]), d = local(p[3]);
  std::swap(c.y, d.y);
  expect_near(thick.length, 4 * 24.0 / (2 * norm(cross(c - a, d - b))), 1e-11);
  EXPECT_EQ(thick.why, nullptr);
}

/// Slots of a tetrahedron: n1 n1 n2 n2 n4 n3 n3 n4.
std::array<Vec, 8> tetra_slots(const std::array<Vec, 4>& c) {
  return {c[0], c[0], c[1], c[1], c[3], c[2], c[2], c[3]};
}
const std::array<Vec, 4> corners{Vec{1, 0, 0}, Vec{9, 1, 2}, Vec{2, 6, 1}, Vec{3, 2, 7}};

double tetra_volume(const std::array<Vec, 4>& c) {
  return std::abs(dot(c[1] - c[0], cross(c[2] - c[0], c[3] - c[0]))) / 6;
}
double largest_face(const std::array<Vec, 4>& c) {
  const auto area = [&](int i, int j, int k) { return norm(cross(c[j] - c[i], c[k] - c[i])) / 2; };
  return std::max({area(0, 1, 2), area(0, 1, 3), area(0, 2, 3), area(1, 2, 3)});
}

TEST(Tetra, OfFourNodesHasItsSmallestHeight) {
  const double volume = tetra_volume(corners);
  std::array<int, 4> order{0, 1, 2, 3};
  do {  // whichever face is the largest one, and inside out
    std::array<Vec, 4> c;
    for (std::size_t i = 0; i < 4; ++i) c[i] = corners[static_cast<std::size_t>(order[i])];
    PartRow row = part(36, 14);
    row.property.mu = 0.25;
    const ElementOutcome o = solid(row, tetra_slots(c), SolidShape::tetra4);
    expect_near(o.length, 3 * volume / largest_face(corners));
    expect_near(o.mass, 3 * volume);
    expect_near(o.dt, step_of(o.length, std::cbrt(volume), 0.05, 0, 0.25));
    expect_near(o.stiffness, 0.25 * o.mass / (o.dt * o.dt));
    for (const double s : o.share) EXPECT_EQ(s, 0.125);
    EXPECT_EQ(o.middle_share, 0);
  } while (std::next_permutation(order.begin(), order.end()));
}

/// The ten functions of a tetrahedron at barycentric coordinates of three corners.
std::array<double, 10> ten(double a, double b, double c) {
  const double l[4] = {a, b, c, 1 - a - b - c};
  return {l[0] * (2 * l[0] - 1), l[1] * (2 * l[1] - 1), l[2] * (2 * l[2] - 1),
          l[3] * (2 * l[3] - 1), 4 * l[0] * l[1],       4 * l[1] * l[2],
          4 * l[2] * l[0],       4 * l[0] * l[3],       4 * l[1] * l[3],
          4 * l[2] * l[3]};
}

/// Section 4, 10-node tetrahedron; slopes by central differences, the functions are quadratic.
struct Ten {
  double volume = 0, corner = 0, middle = 0;
  std::vector<double> points;
  Ten(const std::array<Vec, 4>& c, const std::array<Vec, 6>& m) {
    std::array<Vec, 10> x{c[0], c[1], c[2], c[3], m[0], m[1], m[2], m[3], m[4], m[5]};
    std::array<double, 10> u{};
    for (std::size_t p = 0; p < 4; ++p) {
      std::array<double, 4> at{0.1381966, 0.1381966, 0.1381966, 0.1381966};
      at[p] = 0.5854102;
      // The solver's four numbers do not add up to 1 exactly; slopes are taken at the numbers.
      std::array<std::array<double, 3>, 10> d{};
      std::array<Vec, 3> j{};
      for (std::size_t k = 0; k < 3; ++k) {
        std::array<double, 3> before{at[0], at[1], at[2]}, after = before;
        before[k] -= 0.5;
        after[k] += 0.5;
        const auto lo = ten(before[0], before[1], before[2]),
                   hi = ten(after[0], after[1], after[2]);
        for (std::size_t n = 0; n < 10; ++n) {
          d[n][k] = hi[n] - lo[n];
          j[k] = j[k] + d[n][k] * x[n];
        }
      }
      const double det = dot(j[0], cross(j[1], j[2])), v = std::abs(det) / 24;
      volume += v;
      points.push_back(v);
      for (std::size_t n = 0; n < 10; ++n) {
        const Vec g = (1 / det) * (d[n][0] * cross(j[1], j[2]) + d[n][1] * cross(j[2], j[0]) +
                                   d[n][2] * cross(j[0], j[1]));
        u[n] += dot(g, g) * v;
      }
    }
    corner = *std::max_element(u.begin(), u.begin() + 4);
    middle = *std::max_element(u.begin() + 4, u.end());
  }
};

std::array<Vec, 6> middles(const std::array<Vec, 4>& c, double bent) {
  const auto half = [&](std::size_t a, std::size_t b) { return 0.5 * (c[a] + c[b]); };
  std::array<Vec, 6> m{half(0, 1), half(1, 2), half(2, 0), half(0, 3), half(1, 3), half(2, 3)};
  for (std::size_t i = 0; i < 6; ++i)
    m[i] = m[i] + Vec{bent * static_cast<double>(i % 3), -bent * static_cast<double>(i % 2),
                      bent * 0.5 * static_cast<double>(i)};
  return m;
}

TEST(Tetra, OfTenNodesHasTheLengthOfItsCurvedFunctions) {
  for (const double bent : {0.0, 0.125})
    for (const int itetra10 : {0, 1}) {
      const std::array<Vec, 6> m = middles(corners, bent);
      const Ten t(corners, m);
      PartRow row = part(36, 14);
      row.property.itetra10 = itetra10;
      row.property.mu = 0.25;
      const ElementOutcome o = solid(row, tetra_slots(corners), SolidShape::tetra10, &m);
      const double length = std::sqrt(2 * t.volume / std::max(32 * t.corner, 48 * t.middle / 7));
      expect_near(o.length, length, 1e-6);
      expect_near(o.mass, 3 * t.volume, 1e-6);
      const double largest = *std::max_element(t.points.begin(), t.points.end());
      expect_near(o.dt, step_of(o.length, std::cbrt(largest), 0.05, 0, 0.25), 1e-6);
      double s = 0;
      for (const double v : t.points)
        s += 0.25 * 3 * v / std::pow(step_of(o.length, std::cbrt(v), 0.05, 0, 0.25), 2);
      expect_near(o.middle_stiffness, s, 1e-6);
      // A corner has two slots.
      expect_near(2 * o.stiffness, s * t.corner / std::max(t.corner, t.middle), 1e-6);
      const double all = 4 * 3.0 / 14 + 6;
      for (const double share : o.share) expect_near(2 * share, 3.0 / 14 / all);
      expect_near(o.middle_share, 1 / all);
    }
  expect_near(Ten(corners, middles(corners, 0)).volume, tetra_volume(corners), 1e-6);
}

TEST(Tetra, WithCondensedNodesHasTheLengthOfItsCorners) {
  const std::array<Vec, 6> m = middles(corners, 0.125);
  const Ten t(corners, m);
  const double size = std::cbrt(*std::max_element(t.points.begin(), t.points.end()));
  const auto of = [&](int itetra10) {
    PartRow row = part(36, 14);
    row.property.itetra10 = itetra10;
    row.property.mu = 0.25;
    const ElementOutcome o = solid(row, tetra_slots(corners), SolidShape::tetra10, &m);
    expect_near(o.mass, 3 * t.volume, 1e-6);
    expect_near(o.dt, step_of(o.length, size, 0.05, 0, 0.25), 1e-6);
    expect_near(o.stiffness, 0.25 * o.mass / (o.dt * o.dt));
    EXPECT_EQ(o.middle_stiffness, 0);
    expect_near(o.middle_share, 7.0 / 3);
    for (const double s : o.share) EXPECT_EQ(s, 0.125);
    return o.length;
  };
  expect_near(of(3), 3 * t.volume / largest_face(corners), 1e-6);
  // Slopes of the corners' functions: the inverse of the matrix of edges.
  const Vec a = corners[1] - corners[0], b = corners[2] - corners[0], c = corners[3] - corners[0];
  const double six = dot(a, cross(b, c));
  std::array<Vec, 4> g{Vec{}, 1 / six * cross(b, c), 1 / six * cross(c, a), 1 / six * cross(a, b)};
  g[0] = Vec{} - g[1] - g[2] - g[3];
  double p[3][3] = {};
  for (const Vec& v : g) {
    const double e[3] = {v.x, v.y, v.z};
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) p[i][k] += e[i] * e[k];
  }
  const double trace = -(p[0][0] + p[1][1] + p[2][2]);
  const double minors = p[0][0] * p[1][1] - p[0][1] * p[1][0] + p[1][1] * p[2][2] -
                        p[1][2] * p[2][1] + p[2][2] * p[0][0] - p[2][0] * p[0][2];
  const double q = 0.5 * minors - trace * trace / 3;
  expect_near(of(2), 1 / std::sqrt(2 * std::sqrt(-q / 3) - trace / 3), 1e-9);
}

TEST(Solid, StepsThatAreFixedOrFollowBlankViscosity) {
  PartRow row = part(11, 14);
  row.material.fixed_step = 1000;
  EXPECT_EQ(detail::bulk_step(row, 2, 3), 1000);
  row = part(70, 14);
  expect_near(detail::bulk_step(row, 2, 3), step_of(2, 3));
  row.property.viscosity_blank = true;
  expect_near(detail::bulk_step(row, 2, 3), 2.0 / 13);
  row.material.law = 36;
  expect_near(detail::bulk_step(row, 2, 3), step_of(2, 3));
  row.property.qb = 0.5;
  row.property.lambda = 0.25;
  row.property.mu = 0.75;
  expect_near(detail::bulk_step(row, 2, 3), step_of(2, 3, 0.5, 0.25, 0.75));
}

TEST(Solid, OfSixteenAndTwentyNodesHasMassOnly) {
  const double mass = 3 * 8 * jacobian(hexa, {0, 0, 0});
  for (const SolidShape shape : {SolidShape::brick20, SolidShape::thick16}) {
    ElementOutcome o = solid(part(36, 14), hexa, shape);
    expect_near(o.mass, mass);
    EXPECT_TRUE(std::isnan(o.dt));
    EXPECT_TRUE(std::isnan(o.stiffness));
    EXPECT_TRUE(std::isnan(o.middle_stiffness));
    EXPECT_NE(o.why, nullptr);
    const bool thick = shape == SolidShape::thick16;
    expect_near(8 * o.share[3] + (thick ? 8 : 12) * o.middle_share, 1);
    expect_near(o.share[0] / o.middle_share, thick ? 1.0 / 3 : 3.0 / 14);
    PartRow rigid = part(36, 14);
    rigid.rigid = true;
    o = solid(rigid, hexa, shape);
    EXPECT_EQ(o.dt, no_step);
    EXPECT_EQ(o.stiffness, 0);
    EXPECT_EQ(o.middle_stiffness, 0);
    EXPECT_EQ(o.why, nullptr);
  }
}

TEST(Quad, HasItsAreaOverItsLongestSide) {
  const std::array<Vec, 4> x{Vec{7, 2, 1}, Vec{0, 8, 2}, Vec{1, 9, 6}, Vec{0, 3, 4}};
  const auto flat = [&](std::size_t i) { return Vec{0, x[i].y, x[i].z}; };
  double longest = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) longest = std::max(longest, norm(flat(i) - flat(j)));
  // Triangles 1 2 3 and 1 3 4: area, and area times the radius of the middle.
  const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
    const double area = std::abs(cross(flat(b) - flat(a), flat(c) - flat(a)).x) / 2;
    return std::pair(area, area * (x[a].y + x[b].y + x[c].y) / 3);
  };
  const auto one = triangle(0, 1, 2), other = triangle(0, 2, 3);
  const double area = one.first + other.first;
  for (const bool about_axis : {false, true}) {
    PartRow row = part(36, 14);
    row.property.mu = 0.25;
    ElementOutcome o;
    detail::quad_outcome(row, x, about_axis, o);
    expect_near(o.length, area / longest);
    expect_near(o.dt, step_of(o.length, std::sqrt(area), 0.05, 0, 0.25));
    if (!about_axis) {
      EXPECT_TRUE(std::isnan(o.mass));
      EXPECT_TRUE(std::isnan(o.stiffness));
      continue;
    }
    expect_near(o.mass, 3 * (one.second + other.second));
    expect_near(o.stiffness, 0.5 * o.mass / (o.dt * o.dt));
    EXPECT_EQ(o.share, (std::array<double, 8>{0.25, 0.25, 0.25, 0.25}));
    row.rigid = true;
    ElementOutcome still;
    detail::quad_outcome(row, x, true, still);
    EXPECT_EQ(still.dt, no_step);
    EXPECT_EQ(still.stiffness, 0);
    EXPECT_EQ(still.mass, o.mass);
  }
}

// ---- trusses, beams, springs -------------------------------------------------------------------

TEST(Truss, HasItsLengthOverTheSpeedOfALine) {
  PartRow row = part(1, 2);
  row.property.area = 5;
  ElementOutcome o;
  detail::truss_outcome(row, 7, o);
  expect_near(o.mass, 3 * 5 * 7);
  expect_near(o.dt, 7 / std::sqrt(210.0 / 2));
  expect_near(o.stiffness, 210.0 * 5 / 7);
  EXPECT_EQ(o.share, (std::array<double, 8>{0.5, 0.5}));
  row.rigid = true;
  ElementOutcome still;
  detail::truss_outcome(row, 7, still);
  EXPECT_EQ(still.dt, no_step);
  EXPECT_EQ(still.stiffness, 0);
  expect_near(still.mass, 3 * 5 * 7);
}

TEST(Beam, HasTheStepOfItsSection) {
  struct Row {
    double length, iyy, izz, ixx, dm, df;
  };
  // Slender and short ones, with either inertia and either damping the larger one.
  for (const Row& r : {Row{40, 6, 2, 3, 0, 0.01}, Row{2, 6, 20, 3, 0.3, 0.01},
                       Row{3, 9, 8, 40, 0.02, 0.2}, Row{1.5, 1, 30, 90, 0.1, 0.05}}) {
    PartRow row = part(1, 3);
    row.property.area = 5;
    row.property.iyy = r.iyy;
    row.property.izz = r.izz;
    row.property.ixx = r.ixx;
    row.property.beam_membrane = r.dm;
    row.property.beam_bending = r.df;
    ElementOutcome o;
    detail::beam_outcome(row, r.length, o);
    const double large = std::max(r.iyy, r.izz), small = std::min(r.iyy, r.izz), l = r.length;
    const double a = 5 * l * l / (12 * large), s = 1.2 * 210 / 80, f = std::max(1.0, l / (a + s));
    const double d = damp(std::sqrt(2.0) * std::max(r.dm, r.df));
    expect_near(o.dt, d * l / (9 * std::sqrt(f)));
    expect_near(o.mass, 3 * 5 * l);
    const double phi = small / large * s / a, k_phi = (4 + phi) / (1 + phi), m = 3 * 5 * l / 2;
    double j = 1.2 * m * std::pow(1.2 * l, 2) / 12 + 3 * l / 2 * large;
    if (a < 1) j *= std::max(1.0, k_phi / (1 + a));
    j = std::max(j, 3 * l / 2 * r.ixx);
    expect_near(o.inertia, 2 * j);  // of both ends
    expect_near(o.stiffness, f * 5 * 210 / (l * d * d));
    expect_near(o.rotational, std::max(80 * r.ixx, k_phi * 210 * large) / (l * d * d));
    EXPECT_EQ(o.share, (std::array<double, 8>{0.5, 0.5}));
  }
}

TEST(Beam, OfType18HasNoFactorOfItsSection) {
  PartRow row = part(1, 18);
  row.property.area = 5;
  row.property.iyy = row.property.izz = 20;
  row.property.beam_bending = 0.1;
  ElementOutcome o;
  detail::beam_outcome(row, 2, o);
  const double d = damp(std::sqrt(2.0) * 0.1);
  expect_near(o.dt, d * 2 / 9);
  expect_near(o.stiffness, 5.0 * 210 / (2 * d * d));
  EXPECT_TRUE(std::isnan(o.inertia));
  EXPECT_TRUE(std::isnan(o.rotational));
  row.rigid = true;
  ElementOutcome still;
  detail::beam_outcome(row, 2, still);
  EXPECT_EQ(still.dt, no_step);
  expect_near(still.mass, 30);
  EXPECT_EQ(still.stiffness, 0);
}

/// A spring of a type with mass 5 and inertia 7, and freedoms (k, c).
PartRow spring(int type, const std::vector<std::pair<double, double>>& freedoms,
               bool per_length = false) {
  PartRow row = part(1, type);
  row.property.spring_mass = 5;
  row.property.spring_inertia = 7;
  row.property.per_length = per_length;
  for (std::size_t i = 0; i < freedoms.size(); ++i) {
    row.property.freedom[i].k = freedoms[i].first;
    row.property.freedom[i].c = freedoms[i].second;
  }
  return row;
}
double general_step(double m, double k, double c) { return m / (std::sqrt(c * c + k * m) + c); }
double nodal(double m, double k, double c) { return std::pow(std::sqrt(c * c + k * m) + c, 2) / m; }

TEST(Spring, OfOneDirectionHasTheStepOfStiffnessAndDamping) {
  for (const int type : {4, 12})
    for (const bool per_length : {false, true})
      for (const auto& [k, c] : {std::pair(11., 2.), {11., 0.}, {0., 2.}, {0., 0.}, {11., 30.}}) {
        ElementOutcome o;
        detail::spring_outcome(spring(type, {{k, c}}, per_length), 3, true, o);
        const double l = per_length ? 3 : 1, m = 5 * l, stiff = k / l,
                     damping = type == 4 ? c : c / l;
        double dt = 1e20;
        if (k > 0 && c > 0) {
          const double root = std::sqrt(damping * damping + stiff * m);
          dt = m / ((type == 12 ? 2 : 1) * root + damping);
        } else if (k > 0) {
          dt = std::sqrt(m / stiff);
        } else if (c > 0) {
          dt = m / damping;
        }
        expect_near(o.dt, std::min(dt, 0.5 * m / std::max(1e-15, damping)));
        expect_near(o.mass, m);
        expect_near(o.middle_stiffness, nodal(m, stiff, damping));
        expect_near(o.stiffness, nodal(type == 12 ? m / 2 : m, stiff, damping));
        EXPECT_EQ(o.share, type == 12 ? (std::array<double, 8>{0.25, 0.5, 0.25})
                                      : (std::array<double, 8>{0.5, 0.5}));
        EXPECT_EQ(o.why, nullptr);
      }
}

TEST(Spring, OfSeveralDirectionsHasTheSmallerStepOfMovingAndTurning) {
  using Freedoms = std::vector<std::pair<double, double>>;
  const Freedoms plain{{2, 1}, {11, .5}, {4, 3}, {20, 2}, {13, 6}, {31, 5}};
  for (const int type : {8, 13, 25})
    for (const bool per_length : {false, true})
      for (std::size_t turn = 0; turn < 3; ++turn) {
        Freedoms f = plain;  // each direction can be the stiffest one
        std::rotate(f.begin(), f.begin() + static_cast<long>(turn), f.begin() + 3);
        std::rotate(f.begin() + 3, f.begin() + 3 + static_cast<long>(turn), f.end());
        if (type == 25) f.resize(4);
        ElementOutcome o;
        detail::spring_outcome(spring(type, f, per_length), 3, false, o);
        const double l = per_length ? 3 : 1, m = 5 * l, j = 7 * l;
        double k = std::max(f[0].first, f[1].first), c = std::max(f[0].second, f[1].second);
        double kr = 0, cr = 0;
        if (type == 25) {
          kr = f[1].first * 9 + std::max(f[2].first, f[3].first);
          cr = f[1].second * 9 + std::max(f[2].second, f[3].second);
        } else {
          k = std::max(k, f[2].first);
          c = std::max(c, f[2].second);
          kr = std::max({f[3].first, f[4].first, f[5].first});
          cr = std::max({f[3].second, f[4].second, f[5].second});
          if (type == 13) {
            kr += std::max(f[1].first, f[2].first) * 9;
            cr += std::max(f[1].second, f[2].second) * 9;
          }
        }
        k /= l;
        c /= l;
        kr /= l;
        cr /= l;
        expect_near(o.dt, std::min(general_step(m, k, c), general_step(j, kr, cr)));
        expect_near(o.mass, m);
        expect_near(o.inertia, j);
        expect_near(o.stiffness, nodal(m, k, c));
        expect_near(o.rotational, nodal(type == 13 ? j : j / 2, kr, cr));
      }
}

TEST(Spring, WithoutStiffnessHasTheStepOfTheLeastOne) {
  ElementOutcome o;
  detail::spring_outcome(spring(8, {{11, 0}, {0, 0}, {0, 0}, {0, 0}}), 3, false, o);
  expect_near(o.dt, std::sqrt(5 / 11.0));
  detail::spring_outcome(spring(8, {{0, 0}, {0, 0}, {0, 0}, {0, 4}}), 3, false, o);
  expect_near(o.dt, 7 / 8.0);
  detail::spring_outcome(spring(8, {}), 3, false, o);
  expect_near(o.dt, 1 / std::sqrt(1e-15));
  PartRow light = spring(4, {{11, 2}});
  light.property.spring_mass = 0;
  detail::spring_outcome(light, 3, false, o);
  EXPECT_EQ(o.stiffness, 11);
}

TEST(Spring, OnARigidBodyIsLeftToTheEngine) {
  for (const auto& [type, step] :
       {std::pair(8, no_step), {13, no_step}, {25, no_step}, {4, 0.}, {12, 0.}, {23, no_step}}) {
    ElementOutcome on, off;
    const PartRow row = spring(type, {{11, 2}, {3, 1}, {4, 1}, {2, 1}});
    detail::spring_outcome(row, 3, true, on);
    detail::spring_outcome(row, 3, false, off);
    if (type == 23) {
      EXPECT_TRUE(std::isnan(off.dt));
      EXPECT_TRUE(std::isnan(on.mass));
      EXPECT_TRUE(std::isnan(on.stiffness));
      EXPECT_NE(on.why, nullptr);
    } else {
      EXPECT_LT(off.dt, 10);
      EXPECT_EQ(on.stiffness, off.stiffness);
    }
    EXPECT_EQ(on.dt, step == no_step ? no_step : off.dt) << type;
  }
  ElementOutcome other;
  detail::spring_outcome(spring(26, {{11, 2}}), 3, true, other);
  EXPECT_TRUE(std::isnan(other.dt));
}

TEST(Spring, WithAFunctionOfItsSpeedHasMassOnly) {
  for (std::size_t i = 0; i < 6; ++i) {
    PartRow row = spring(8, {{11, 2}, {3, 1}, {4, 1}, {2, 1}, {2, 1}, {2, 1}});
    row.property.freedom[i].known = false;
    ElementOutcome o, on;
    detail::spring_outcome(row, 3, false, o);
    EXPECT_TRUE(std::isnan(o.dt));
    EXPECT_TRUE(std::isnan(o.stiffness));
    EXPECT_TRUE(std::isnan(o.rotational));
    EXPECT_EQ(o.mass, 5);
    EXPECT_NE(o.why, nullptr);
    detail::spring_outcome(row, 3, true, on);
    EXPECT_EQ(on.dt, no_step);
  }
}

}  // namespace
}  // namespace deck::test
