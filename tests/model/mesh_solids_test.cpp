// Step, mass and stiffness of one solid or plane element against the formulas of its kind, on
// elements without any symmetry.
#include "model/mesh_elements.hpp"

#include <algorithm>

namespace deck::test {
namespace {

/// A hexahedron without two equal sides.
const std::array<Vec, 8> hexa{Vec{0, 0, 0},   Vec{10, 1, 0}, Vec{11, 7, 1}, Vec{1, 6, 0},
                              Vec{0.5, 0, 4}, Vec{10, 0, 5}, Vec{12, 8, 6}, Vec{0, 6, 4.5}};

constexpr int hexa_faces[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                  {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

constexpr int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                            {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

/// Slope of the eight functions' map by coordinate `k`, by a central difference: they are linear.
Vec slope(const std::array<Vec, 8>& x, std::array<double, 3> at, std::size_t k) {
  const auto place = [&](const std::array<double, 3>& r) {
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
      expect_near(o.mass, r.isolid == 16 ? 24 * jacobian(hexa, {0, 0, 0}) : 3 * volume_of(hexa));
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

TEST(Penta, NumberedInsideOutHasTheSameMassAndStep) {
  const Vec a{0, 0, 0}, b{2, 0, 0}, c{0, 1, 0}, up{0, 0, 3};
  const auto penta = [&](const Vec& low, const Vec& high) {
    return solid(part(36, 14),
                 {low + a, low + b, low + c, low + a, high + a, high + b, high + c, high + a},
                 SolidShape::penta6);
  };
  const ElementOutcome right = penta({}, up), turned = penta(up, {});
  EXPECT_GT(right.mass, 0);
  EXPECT_EQ(turned.mass, right.mass);
  EXPECT_EQ(turned.dt, right.dt);
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

}  // namespace
}  // namespace deck::test
