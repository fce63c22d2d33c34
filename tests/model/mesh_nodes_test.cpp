// What rigid bodies and ties make of the sums at nodes, and what parts add up to: against sums by
// hand (time_step.md, section 8).
#include <gtest/gtest.h>

#include <cmath>

#include "contact/small_deck.hpp"
#include "lint/support.hpp"
#include "model/mesh/mesh_parts.hpp"
#include "model/shared/mesh.hpp"

namespace deck::test {
namespace {

/// Shells of different size: nodes 1 to 4 and 11 to 14, one edge above the other; free nodes 5, 6.
SmallDeck two_shells() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 11, 6, 0).node(4, 0, 5, 0);
  d.node(11, 2, 1, 3).node(12, 6, 1, 3).node(13, 6, 4, 3.5).node(14, 2, 4, 3);
  d.node(5, 1, 2, 3).node(6, -4, 2, 7);
  d.shell_part(1, 2.0).shell(1, 1, 1, 2, 3, 4).shell_part(2, 0.5).shell(2, 2, 11, 12, 13, 14);
  d.group("/GRNOD/NODE/1", {11, 12, 14}).group("/GRNOD/NODE/2", {1, 3}).group("/SURF/PART/1", {1});
  return d;
}

struct Meshed {
  explicit Meshed(const SmallDeck& d, const MeshOptions& how = {})
      : b(d), m(make_mesh(b.model, how)) {}
  NodeIndex at(std::int64_t id) const { return b.model.find_node(id); }
  Vec place(std::int64_t id) const {
    const auto n = at(id);
    return {b.model.nodes.x[n], b.model.nodes.y[n], b.model.nodes.z[n]};
  }
  double mass(std::int64_t id) const { return m.nodes.mass[at(id)]; }
  double inertia(std::int64_t id) const { return m.nodes.inertia[at(id)]; }
  double k(std::int64_t id) const { return m.nodes.stiffness[at(id)]; }
  double turn(std::int64_t id) const { return m.nodes.rotational_stiffness[at(id)]; }
  double dt(std::int64_t id) const { return m.nodes.dt[at(id)]; }
  Built b;
  Mesh m;
};

void near(double got, double wanted, double share = 1e-12) {
  EXPECT_NEAR(got, wanted, share * std::abs(wanted));
}

/// Principal moments by Jacobi rotations, the smallest one.
double smallest_moment(std::array<std::array<double, 3>, 3> a) {
  for (int sweep = 0; sweep < 60; ++sweep)
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t q = p + 1; q < 3; ++q) {
        if (a[p][q] == 0) continue;
        const double t = 0.5 * std::atan2(2 * a[p][q], a[q][q] - a[p][p]);
        const double c = std::cos(t), s = std::sin(t);
        auto r = a;
        for (std::size_t i = 0; i < 3; ++i) {
          r[p][i] = c * a[p][i] - s * a[q][i];
          r[q][i] = s * a[p][i] + c * a[q][i];
        }
        a = r;
        for (std::size_t i = 0; i < 3; ++i) {
          r[i][p] = c * a[i][p] - s * a[i][q];
          r[i][q] = s * a[i][p] + c * a[i][q];
        }
        a = r;
      }
  return std::min({a[0][0], a[1][1], a[2][2]});
}

/// A rigid body by hand from what its nodes have without it.
struct Body {
  double mass = 0, k = 0, turn = 0, smallest = 0, mean = 0;
  Body(const Meshed& free, std::int64_t main, const std::vector<std::int64_t>& nodes, int centre,
       double added, const std::array<double, 6>& inertia) {
    const double share = centre == 4 ? 0 : 1;  // with ICoG 4 the card's mass and inertia are all
    double own = 0;
    Vec first{};
    for (const auto n : nodes) {
      own += share * free.mass(n);
      first = first + free.mass(n) * (free.place(n) - free.place(main));
    }
    const double extra = added + free.mass(main);
    mass = own + extra;
    Vec c = free.place(main);
    if (centre == 1) c = c + 1 / mass * first;
    if (centre == 2) c = c + 1 / own * first;
    std::array<std::array<double, 3>, 3> t = {{{inertia[0], inertia[3], inertia[5]},
                                               {inertia[3], inertia[1], inertia[4]},
                                               {inertia[5], inertia[4], inertia[2]}}};
    const auto point = [&](double m, const Vec& at) {
      const double d[3] = {at.x - c.x, at.y - c.y, at.z - c.z};
      const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) t[i][j] += m * ((i == j ? square : 0) - d[i] * d[j]);
    };
    double spin = free.inertia(main);
    k = free.k(main);
    turn = free.turn(main);
    for (const auto n : nodes) {
      const Vec d = free.place(n) - c;
      point(share * free.mass(n), free.place(n));
      spin += share * free.inertia(n);
      k += free.k(n);
      turn += free.turn(n) + free.k(n) * dot(d, d);
    }
    if (centre == 1) point(extra, free.place(main));
    for (std::size_t i = 0; i < 3; ++i) t[i][i] += spin;
    smallest = smallest_moment(t);
    mean = (t[0][0] + t[1][1] + t[2][2]) / 3;
  }
};

TEST(RigidBodies, HaveMassInertiaAndStiffnessOfTheirNodes) {
  const Meshed free(two_shells());
  const std::array<double, 6> inertia{3e-4, 5e-4, 7e-4, 1e-4, 0.5e-4, -0.25e-4};
  for (const int centre : {1, 2, 3, 4})
    for (const bool spherical : {false, true})
      for (const int main : {6, 2}) {
        SmallDeck d = two_shells();
        d.add("@/RBODY/1 node_ID=" + std::to_string(main) + " grnd_ID=1 Mass=4e-6 ICoG=" +
              std::to_string(centre) + (spherical ? " Ispher=1" : "") +
              " Jxx=3e-4 Jyy=5e-4 Jzz=7e-4 Jxy=1e-4 Jyz=0.5e-4 Jxz=-0.25e-4");
        const Meshed m(d);
        const Body wanted(free, main, {11, 12, 14}, centre, 4e-6, inertia);
        near(m.mass(main), wanted.mass);
        near(m.inertia(main), spherical ? wanted.mean : wanted.smallest, 1e-9);
        near(m.k(main), wanted.k);
        near(m.turn(main), wanted.turn);
        for (const int n : {11, 12, 14}) {
          EXPECT_EQ(m.k(n), 1e-20);
          EXPECT_EQ(m.turn(n), 1e-20);
          EXPECT_EQ(m.mass(n), free.mass(n));
        }
        EXPECT_EQ(m.k(13), free.k(13));
        EXPECT_EQ(m.m.nodes.lumped_mass, free.m.nodes.mass);
        near(m.dt(main),
             std::sqrt(2 * std::min(wanted.mass / wanted.k, m.inertia(main) / wanted.turn)), 1e-9);
      }
}

// ---- ties --------------------------------------------------------------------------------------

/// A tie of node 11, a corner of the second shell, to the first shell.
struct TieCase {
  explicit TieCase(int flag = 0, std::array<std::int64_t, 4> corners = {1, 2, 3, 4},
                   bool rim = false, double s = 0.25, double t = -0.5)
      : free(deck()) {
    tie.spotflag = flag;
    tie.rim = rim;
    const auto& inter = free.b.interfaces.type2.front();
    tie.block = inter.block;
    TiedNodes::Row row;
    row.node = free.at(11);
    for (std::size_t i = 0; i < 4; ++i) row.main[i] = free.at(corners[i]);
    row.s = s;
    row.t = t;
    tie.rows = {row};
  }
  static SmallDeck deck() {
    SmallDeck d = two_shells();
    return d.add("@/INTER/TYPE2/3 grnd_IDs=1 surf_IDm=1");
  }
  Mesh mesh() const {
    const std::vector<TiedNodes> ties{tie};
    MeshOptions how;
    how.ties = &ties;
    return make_mesh(free.b.model, how);
  }
  Meshed free;
  TiedNodes tie;
};

/// The deck's ties are left open without TiedNodes: what nodes have without any.
const Meshed& untied() {
  static const Meshed m(two_shells());
  return m;
}

void expect_carried(const TieCase& c, const std::array<double, 4>& stiffness,
                    const std::array<double, 4>& mass) {
  const Meshed& free = untied();
  const Mesh m = c.mesh();
  const auto& row = c.tie.rows[0];
  EXPECT_EQ(m.nodes.mass[row.node], 0);
  EXPECT_EQ(m.nodes.stiffness[row.node], 0);
  EXPECT_EQ(m.nodes.inertia[row.node], free.inertia(11)) << "it keeps its rotations";
  for (std::size_t i = 0; i < 4; ++i) {
    if (i == 3 && row.main[3] == row.main[2]) break;
    const NodeIndex n = row.main[i];
    near(m.nodes.mass[n], free.m.nodes.mass[n] + mass[i] * free.mass(11));
    near(m.nodes.stiffness[n], free.m.nodes.stiffness[n] + stiffness[i] * free.k(11));
  }
  EXPECT_TRUE(m.left_out.empty());
}

TEST(TieSums, GoToTheCornersByTheirWeights) {
  const auto weights = [](double s, double t) {
    return std::array{(1 - s) * (1 - t) / 4, (1 + s) * (1 - t) / 4, (1 + s) * (1 + t) / 4,
                      (1 - s) * (1 + t) / 4};
  };
  const auto sizes = [](std::array<double, 4> w) {
    for (double& x : w) x = std::abs(x);
    return w;
  };
  for (const int flag : {0, 5, 27})
    for (const bool rim : {false, true})
      for (const auto& [s, t] : {std::pair(0.25, -0.5), {1.25, -0.5}, {-0.5, -1.5}, {1.5, 1.75}}) {
        TieCase c;
        c.tie.spotflag = flag;
        c.tie.rim = rim;
        c.tie.rows[0].s = s;
        c.tie.rows[0].t = t;
        expect_carried(
            c, sizes(weights(s, t)),
            rim ? weights(std::clamp(s, -1., 1.), std::clamp(t, -1., 1.)) : weights(s, t));
      }
}

TEST(TieSums, OfTrianglesGoToThreeCorners) {
  const auto three = [](double a, double b, double c) { return std::array{a, b, c, 0.0}; };
  const auto sizes = [](std::array<double, 4> w) {
    for (double& x : w) x = std::abs(x);
    return w;
  };
  const auto with = [](int flag, bool rim, double s, double t) {
    return TieCase(flag, {1, 2, 3, 3}, rim, s, t);
  };
  // s and t of a quadrangle whose last corners coincide.
  const auto plain = three(0.75 * 1.5 / 4, 1.25 * 1.5 / 4, 0.5 / 2);
  expect_carried(with(0, false, 0.25, -0.5), plain, plain);
  expect_carried(with(0, true, 0.25, -0.5), plain, plain);
  // With Spotflag 27 s and t are weights.
  expect_carried(with(27, false, 0.2, 0.3), three(0.2, 0.3, 0.5), three(0.2, 0.3, 0.5));
  expect_carried(with(27, false, -0.2, 0.3), sizes(three(-0.2, 0.3, 0.9)), three(-0.2, 0.3, 0.9));
  // One negative weight: the others by their sum; two: the third has all.
  expect_carried(with(27, true, -0.2, 0.3), three(0.2, 0.3, 0.9), three(0, 0.25, 0.75));
  expect_carried(with(27, true, 0.3, -0.2), three(0.3, 0.2, 0.9), three(0.25, 0, 0.75));
  expect_carried(with(27, true, 0.9, 0.3), three(0.9, 0.3, 0.2), three(0.75, 0.25, 0));
  expect_carried(with(27, true, -0.2, -0.3), three(0.2, 0.3, 1.5), three(0, 0, 1));
  expect_carried(with(27, true, 1.5, -0.3), three(1.5, 0.3, 0.2), three(1, 0, 0));
}

TEST(TieSums, WithAnArmCarryTheMomentToo) {
  const Meshed& free = untied();
  const std::int64_t main[] = {1, 2, 3, 4};
  Vec middle{};
  for (const auto n : main) middle = middle + 0.25 * free.place(n);
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
  for (const auto n : main) {
    const Vec d = free.place(n) - middle;
    xx += d.x * d.x;
    yy += d.y * d.y;
    zz += d.z * d.z;
    xy += d.x * d.y;
    yz += d.y * d.z;
    zx += d.z * d.x;
  }
  const double X = yy + zz, Y = zz + xx, Z = xx + yy;
  const double D = X * Y * Z - X * yz * yz - Y * zx * zx - Z * xy * xy - 2 * xy * yz * zx;
  const double b1 = Z * Y - yz * yz, b2 = X * Z - zx * zx, b3 = Y * X - xy * xy,
               c3 = Z * xy + yz * zx, c1 = X * yz + zx * xy, c2 = Y * zx + xy * yz;
  const double r = std::max({b1 + c3 + c2, b2 + c1 + c3, b3 + c2 + c1}) / D;
  const Vec arm = free.place(11) - middle;
  const double spin = free.inertia(11) + free.mass(11) * dot(arm, arm);
  for (const int flag : {1, 28}) {
    const TieCase c(flag);
    const Mesh m = c.mesh();
    for (const auto id : main) {
      const NodeIndex n = free.at(id);
      near(m.nodes.stiffness[n],
           free.k(id) + free.k(11) / 4 + r * (free.turn(11) + free.k(11) * dot(arm, arm)));
      near(m.nodes.mass[n], free.mass(id) + free.mass(11) / 4 + (flag == 1 ? r * spin : 0));
      near(m.nodes.inertia[n], free.inertia(id) + spin / 4);
    }
    const NodeIndex n = free.at(11);
    EXPECT_EQ(m.nodes.mass[n], 0);
    EXPECT_EQ(m.nodes.inertia[n], 0);
    EXPECT_EQ(m.nodes.stiffness[n], 1e-20);
    EXPECT_EQ(m.nodes.rotational_stiffness[n], 1e-20);
    EXPECT_EQ(m.nodes.dt[n], no_step);
  }
}

// ---- parts -------------------------------------------------------------------------------------

TEST(PartSums, AreThoseOfTheirNodesAboutTheirCentre) {
  SmallDeck d = two_shells();
  d.shell(1, 3, 2, 3, 12, 13).add("@/ADMAS/5/1 MASS=6e-9 node_ID=13");
  const Meshed m(d);
  // Of every shell a quarter at each of its nodes.
  const std::vector<std::vector<std::int64_t>> shells{
      {1, 2, 3, 4}, {2, 3, 12, 13}, {11, 12, 13, 14}};  // by part, then id
  const auto& masses = m.m.of(ElementKind::shell4).mass;
  const auto expect = [&](const PartFigures& got, const std::vector<std::size_t>& elements) {
    double mass = 0;
    Vec first{};
    double area_spin = 0;
    for (const std::size_t e : elements)
      for (const auto n : shells[e]) {
        mass += masses[e] / 4;
        first = first + masses[e] / 4 * m.place(n);
      }
    const Vec c = 1 / mass * first;
    std::array<double, 6> t{};
    for (const std::size_t e : elements) {
      const Part& part = m.b.model.parts[m.b.model.shell4.part[e]];
      const double thickness = part.id == 1 ? 2 : 0.5;
      const double area = masses[e] / (1e-6 * thickness);
      area_spin += masses[e] * (area / 9 + thickness * thickness / 12);
      for (const auto n : shells[e]) {
        const Vec x = m.place(n) - c;
        const double q = masses[e] / 4;
        t[0] += q * (x.y * x.y + x.z * x.z);
        t[1] += q * (x.z * x.z + x.x * x.x);
        t[2] += q * (x.x * x.x + x.y * x.y);
        t[3] -= q * x.x * x.y;
        t[4] -= q * x.y * x.z;
        t[5] -= q * x.z * x.x;
      }
    }
    near(got.mass, mass);
    near(got.centre[0], c.x);
    near(got.centre[1], c.y);
    near(got.centre[2], c.z);
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(got.inertia[i], t[i] + (i < 3 ? area_spin : 0), 1e-12 * t[0]) << i;
  };
  ASSERT_EQ(masses.size(), 3u);
  expect(m.m.parts[0], {0, 1});
  expect(m.m.parts[1], {2});
  expect(m.m.total, {0, 1, 2});
  const auto& dt = m.m.of(ElementKind::shell4).dt;
  EXPECT_EQ(m.m.parts[0].dt, std::min(dt[0], dt[1]));
  EXPECT_EQ(m.m.parts[0].slowest.element, dt[0] < dt[1] ? 0u : 1u);
  EXPECT_EQ(m.m.parts[1].slowest.element, 2u);
  EXPECT_EQ(m.m.total.dt, std::min({dt[0], dt[1], dt[2]}));
  EXPECT_EQ(m.m.parts[0].not_computed, 0u);
}

// ---- elements of a mesh ------------------------------------------------------------------------

TEST(MeshElements, OfTenNodesShareTheMassOfAMiddleThatIsMissing) {
  const auto with = [](const std::vector<int>& middle) {
    SmallDeck d;
    d.node(1, 0, 0, 0).node(2, 6, 0, 0).node(3, 0, 5, 0).node(4, 0, 0, 4);
    d.node(5, 3, 0, 0).node(6, 3, 2.5, 0).node(7, 0, 2.5, 0);
    d.node(8, 0, 0, 2).node(9, 3, 0, 2).node(10, 0, 2.5, 2).solid_part(1);
    std::string card = "/TETRA10/1\n         1\n         1         2         3         4";
    for (const int n : middle) card += (n == 10 ? "        " : "         ") + std::to_string(n);
    return Meshed(d.add(card));
  };
  const Meshed whole = with({5, 6, 7, 8, 9, 10});
  const double mass = whole.m.of(ElementKind::solid8).mass.at(0), all = 4 * 3.0 / 14 + 6;
  near(mass, 1e-6 * 20, 1e-6);
  for (int n = 1; n <= 4; ++n) near(whole.mass(n), mass * 3 / 14 / all);
  for (int n = 5; n <= 10; ++n) near(whole.mass(n), mass / all);
  near(whole.m.total.mass, mass);
  const int ends[6][2] = {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}};
  for (std::size_t gone = 0; gone < 6; ++gone) {
    std::vector<int> middle{5, 6, 7, 8, 9, 10};
    middle[gone] = 0;
    const Meshed m = with(middle);
    near(m.m.of(ElementKind::solid8).dt.at(0), whole.m.of(ElementKind::solid8).dt.at(0), 1e-9);
    for (int n = 1; n <= 4; ++n) {
      const bool end = n == ends[gone][0] || n == ends[gone][1];
      near(m.mass(n), mass * (3.0 / 14 + (end ? 0.5 : 0)) / all, 1e-9);
      near(m.k(n), whole.k(n) + (end ? 0.5 * whole.k(5) : 0), 1e-6);
    }
    EXPECT_EQ(m.mass(static_cast<std::int64_t>(5 + gone)), 0);
    near(m.m.total.mass, mass);
  }
}

}  // namespace
}  // namespace deck::test
