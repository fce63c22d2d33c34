// What rigid bodies, rigid elements, added masses, ties, walls and damping make of the sums at
// nodes, and what parts add up to: against sums by hand (time_step.md, section 8).
// Over 600 lines: independent tests of one sum each.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

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
    double own = 0;
    Vec first{};
    for (const auto n : nodes) {
      own += free.mass(n);
      first = first + free.mass(n) * (free.place(n) - free.place(main));
    }
    const double extra = centre == 4 ? 0 : added + free.mass(main);
    mass = own + extra;
    Vec c = free.place(main);
    if (centre == 1) c = c + 1 / mass * first;
    if (centre == 2) c = c + 1 / own * first;
    std::array<std::array<double, 3>, 3> t{};
    if (centre != 4)
      t = {{{inertia[0], inertia[3], inertia[5]},
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
      point(free.mass(n), free.place(n));
      spin += free.inertia(n);
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

TEST(RigidBodies, BlankIcogIsOne) {
  SmallDeck blank = two_shells(), one = two_shells();
  blank.add("@/RBODY/1 node_ID=6 grnd_ID=1 Mass=4e-6");
  one.add("@/RBODY/1 node_ID=6 grnd_ID=1 Mass=4e-6 ICoG=1");
  EXPECT_EQ(Meshed(blank).m.nodes.inertia, Meshed(one).m.nodes.inertia);
}

TEST(RigidBodies, BelowAnotherOneComeFirstWhateverTheirOrder) {
  // Body 1 holds node 5, the main node of body 2.
  const std::string upper = "@/RBODY/1 node_ID=6 grnd_ID=9",
                    lower = "@/RBODY/2 node_ID=5 grnd_ID=1";
  SmallDeck a = two_shells(), b = two_shells();
  for (SmallDeck* d : {&a, &b}) d->group("/GRNOD/NODE/9", {5, 3});
  a.add(upper + "\n" + lower);
  b.add(lower + "\n" + upper);
  const Meshed first(a), last(b), free(two_shells());
  near(first.mass(6), free.mass(11) + free.mass(12) + free.mass(14) + free.mass(3));
  EXPECT_EQ(first.m.nodes.mass, last.m.nodes.mass);
  EXPECT_EQ(first.m.nodes.inertia, last.m.nodes.inertia);
  EXPECT_EQ(first.m.nodes.stiffness, last.m.nodes.stiffness);
}

TEST(RigidBodies, WithoutMassAreNotGiven) {
  SmallDeck d = two_shells();
  d.group("/GRNOD/NODE/9", {5}).add("@/RBODY/1 node_ID=6 grnd_ID=9");
  const Meshed m(d);
  EXPECT_TRUE(std::isnan(m.mass(6)));
  EXPECT_TRUE(std::isnan(m.inertia(6)));
  EXPECT_TRUE(std::isnan(m.dt(6)));
  ASSERT_EQ(m.m.left_out.size(), 1u);
  EXPECT_EQ(m.m.left_out[0].what, "steps of nodes");
  EXPECT_EQ(m.m.left_out[0].count, 1u);
}

TEST(RigidElements, GiveTheMainNodeWhatTheirNodesHaveOnArms) {
  const Meshed free(two_shells());
  const auto with = [&](const char* flags) {
    SmallDeck d = two_shells();
    d.add("/RBE2/1\nr\n         6   " + std::string(flags) + "         0         1");
    return Meshed(d);
  };
  for (const auto& [flags, turns] : {std::pair("111 000", false), {"111 111", true}}) {
    const Meshed m = with(flags);
    double mass = 0, k = 1e-20, inertia = 0, turn = 1e-20;
    for (const int n : {11, 12, 14}) {
      const Vec arm = free.place(n) - free.place(6);
      mass += free.mass(n);
      k += free.k(n);
      inertia += 2 * free.mass(n) * dot(arm, arm) + (turns ? free.inertia(n) : 0);
      turn += free.k(n) * dot(arm, arm) + (turns ? free.turn(n) : 0);
      EXPECT_EQ(m.k(n), 1e-20);
      EXPECT_EQ(m.turn(n), turns ? 1e-20 : free.turn(n));
      EXPECT_EQ(m.mass(n), free.mass(n));
    }
    near(m.mass(6), mass);
    near(m.k(6), k);
    near(m.inertia(6), inertia);
    near(m.turn(6), turn);
    EXPECT_TRUE(m.m.left_out.empty());
  }
  const Meshed none = with("000 000");
  EXPECT_EQ(none.m.nodes.stiffness, free.m.nodes.stiffness);
  EXPECT_TRUE(none.m.left_out.empty());
  for (const char* flags : {"110 000", "111 110", "000 111", "100 111"}) {
    const Meshed m = with(flags);
    for (const int n : {6, 11, 12, 14}) {
      EXPECT_TRUE(std::isnan(m.k(n))) << flags;
      EXPECT_TRUE(std::isnan(m.mass(n)));
      EXPECT_TRUE(std::isnan(m.dt(n)));
    }
    EXPECT_EQ(m.k(13), free.k(13));
    ASSERT_EQ(m.m.left_out.size(), 1u);
    EXPECT_EQ(m.m.left_out[0].count, 4u);
  }
}

TEST(AddedMass, IsGivenSpreadOrNamed) {
  const Meshed free(two_shells());
  const auto with = [&](const std::string& card) {
    SmallDeck d = two_shells();
    return Meshed(d.add(card));
  };
  const auto added = [&](const Meshed& m) {
    std::vector<double> out;
    for (const int n : {11, 12, 14, 13, 1})
      out.push_back(std::round(1e9 * (m.mass(n) - free.mass(n))));
    return out;
  };
  using Row = std::vector<double>;
  EXPECT_EQ(added(with("@/ADMAS/0/1 MASS=6e-9 grnd_ID=1")), (Row{6, 6, 6, 0, 0}));
  EXPECT_EQ(added(with("@/ADMAS/1/1 MASS=6e-9 grnd_ID=1")), (Row{2, 2, 2, 0, 0}));
  EXPECT_EQ(added(with("@/ADMAS/5/1 MASS=6e-9 node_ID=13")), (Row{0, 0, 0, 6, 0}));
  EXPECT_EQ(added(with("@/ADMAS/5/1 MASS=6e-9 node_ID=99")), (Row{0, 0, 0, 0, 0}));
  for (const char* card :
       {"@/ADMAS/0/1 MASS=6e-9 grnd_ID=99", "@/ADMAS/3/1 MASS=6e-9 grpart_ID=1"}) {
    const Meshed m = with(card);
    EXPECT_EQ(added(m), (Row{0, 0, 0, 0, 0}));
    ASSERT_EQ(m.m.left_out.size(), 1u) << card;
    EXPECT_EQ(m.m.left_out[0].count, 1u);
  }
  EXPECT_TRUE(with("@/ADMAS/0/1 MASS=6e-9 grnd_ID=1").m.left_out.empty());
}

TEST(MovingWalls, WithAMassLeaveThatOfTheirNodeOpen) {
  const auto with = [&](const std::string& card) {
    SmallDeck d = two_shells();
    return Meshed(d.add("@/RWALL/PLANE/1 ZM1=9 " + card));
  };
  EXPECT_TRUE(std::isnan(with("node_ID=6 Mass=2").mass(6)));
  EXPECT_EQ(with("node_ID=6 Mass=2").m.left_out.at(0).count, 1u);
  EXPECT_EQ(with("node_ID=6").mass(6), 0);
  EXPECT_TRUE(with("node_ID=6").m.left_out.empty());
  EXPECT_TRUE(with("node_ID=99 Mass=2").m.left_out.empty());
}

TEST(Damping, RaisesStiffnessByTheSquareOfItsFactor) {
  // A third shell, so that nodes have steps of their own.
  const auto deck = [] { return two_shells().shell(1, 3, 2, 3, 12, 13); };
  const Meshed free(deck());
  const auto with = [&](const std::string& fields, const std::string& more = "") {
    SmallDeck d = deck();
    return Meshed(d.add("@/DAMP/1 grnod_id=1 " + fields + "\n" + more));
  };
  const double shortest = std::min({free.dt(11), free.dt(12), free.dt(14)});
  const auto expect = [&](const Meshed& m, double alpha, double beta) {
    for (const int n : {11, 12, 14}) {
      const double x = std::min(beta, shortest) / free.dt(n) + 0.5 * alpha * free.dt(n);
      const double f = std::sqrt(1 + x * x) - x;
      near(m.k(n), free.k(n) / (f * f));
      near(m.turn(n), free.turn(n) / (f * f));
    }
    EXPECT_EQ(m.k(13), free.k(13));
    EXPECT_TRUE(m.m.left_out.empty());
  };
  const double a = 0.5 / shortest, b = 0.25 * shortest;
  const auto text = [](double v) {
    char out[32];
    std::snprintf(out, sizeof out, "%.12g", v);
    return std::string(out);
  };
  ASSERT_NE(free.dt(11), free.dt(12));
  for (const auto& [alpha, beta] : {std::pair(a, 0.), {0., b}, {a, b}, {0., 9 * shortest}}) {
    const double ra = std::stod(text(alpha)), rb = std::stod(text(beta));
    expect(with("Alpha=" + text(alpha) + " Beta=" + text(beta)), ra, rb);
  }
  EXPECT_EQ(with("Alpha=0").m.nodes.stiffness, free.m.nodes.stiffness);
  // Nodes of a rigid body have none, and what is not known stays so.
  const Meshed body = with("Alpha=" + text(a), "@/RBODY/1 node_ID=6 grnd_ID=1");
  for (const int n : {11, 12, 14}) EXPECT_EQ(body.k(n), 1e-20);
  const Meshed open = with("Alpha=" + text(a), "@/RWALL/PLANE/1 ZM1=9 node_ID=12 Mass=2");
  for (const int n : {11, 12, 14}) EXPECT_TRUE(std::isnan(open.k(n)));
  EXPECT_EQ(open.m.left_out.size(), 2u);
  EXPECT_EQ(open.m.left_out.back().count, 3u);
}

TEST(Damping, LooksAtTheLeastStepOfTheEngineFile) {
  const Folder folder;
  const auto stiffness = [&](const std::string& engine) {
    SmallDeck d = two_shells();
    const std::string path =
        folder.write("d_0000.rad", d.add("@/DAMP/1 grnod_id=1 Alpha=1000").text());
    folder.write("d_0001.rad", "/RUN/d/1\n1.0\n" + engine);
    auto loaded = load(path);
    EXPECT_TRUE(loaded);
    return std::pair(loaded->mesh().nodes.stiffness[loaded->model().find_node(11)],
                     loaded->mesh().nodes.dt[loaded->model().find_node(11)]);
  };
  const Meshed free(two_shells());
  const auto wanted = [&](double least) {
    const double x = 500 * std::max(free.dt(11), least), f = std::sqrt(1 + x * x) - x;
    return free.k(11) / (f * f);
  };
  near(stiffness("").first, wanted(0));
  near(stiffness("/DT/NODA/CST\n0.9 0.02\n").first, wanted(0.02));
  near(stiffness("/DT/NODA/CST\n0.9 0.02\n/DT/NODA/CST/1\n0.9 0.03\n").first, wanted(0.03));
  near(stiffness("/DT/NODA/CST\n0.9\n").first, wanted(0));
  near(stiffness("/DT/BRICK/CST\n0.9 0.02\n").first, wanted(0));
  near(stiffness("/DT/NODA/CST\n0.9 0.0000001\n").first, wanted(0));
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

TEST(TieSums, OfSomeFlagsAreNoneOrNotKnown) {
  const Meshed& free = untied();
  for (const int flag : {2, 3, 4, 20, 21, 22, 26, 30}) {
    const TieCase c(flag);
    EXPECT_EQ(c.mesh().nodes.mass, free.m.nodes.mass) << flag;
    EXPECT_EQ(c.mesh().nodes.stiffness, free.m.nodes.stiffness);
  }
  for (const int flag : {6, 19, 23, 25, 29}) {
    const TieCase c(flag);
    const Mesh m = c.mesh();
    for (const auto id : {1, 2, 3, 4, 11})
      EXPECT_TRUE(std::isnan(m.nodes.mass[free.at(id)])) << flag;
    EXPECT_EQ(m.nodes.mass[free.at(12)], free.mass(12));
    ASSERT_EQ(m.left_out.size(), 1u);
    EXPECT_EQ(m.left_out[0].what, "steps of nodes");
    EXPECT_EQ(m.left_out[0].count, 5u);
  }
  const TieCase triangle(1, {1, 2, 3, 3});
  EXPECT_TRUE(std::isnan(triangle.mesh().nodes.mass[free.at(1)])) << "an arm needs four corners";
  TieCase penalty;
  penalty.tie.rows[0].penalty = true;
  const Mesh m = penalty.mesh();
  EXPECT_EQ(m.nodes.mass, free.m.nodes.mass) << "masses stay";
  for (const auto id : {1, 2, 3, 4}) {
    EXPECT_TRUE(std::isnan(m.nodes.stiffness[free.at(id)]));
    EXPECT_TRUE(std::isnan(m.nodes.rotational_stiffness[free.at(id)]));
  }
  EXPECT_EQ(m.nodes.stiffness[free.at(11)], free.k(11));
  ASSERT_EQ(m.left_out.size(), 1u);
  EXPECT_EQ(m.left_out[0].what, "stiffness of nodes");
  EXPECT_EQ(m.left_out[0].count, 4u);
}

TEST(TieSums, ThatAreNotKnownLeaveBothSidesOpen) {
  const auto open = [](const std::string& more, const std::vector<TiedNodes>* ties) {
    SmallDeck d = two_shells();
    d.add("@/INTER/TYPE2/3 grnd_IDs=1 surf_IDm=1 " + more);
    MeshOptions how;
    how.ties = ties;
    const Meshed m(d, how);
    std::vector<std::int64_t> out;
    for (const int id : {1, 2, 3, 4, 11, 12, 13, 14})
      if (std::isnan(m.dt(id))) out.push_back(id);
    EXPECT_EQ(m.m.left_out.size(), out.empty() ? 0u : 1u);
    EXPECT_EQ(m.m.left_out.empty() ? 0 : m.m.left_out[0].count, out.size());
    return out;
  };
  using Ids = std::vector<std::int64_t>;
  const std::vector<TiedNodes> none;
  EXPECT_EQ(open("", nullptr), (Ids{1, 2, 3, 4, 11, 12, 14}));
  EXPECT_EQ(open("", &none), (Ids{1, 2, 3, 4, 11, 12, 14})) << "of another interface";
  EXPECT_EQ(open("Spotflag=26", nullptr), Ids{});
  EXPECT_EQ(open("Spotflag=25", nullptr), (Ids{1, 2, 3, 4, 11, 12, 14}));
}

// ---- parts -------------------------------------------------------------------------------------

TEST(PartSums, AreThoseOfTheirNodesAboutTheirCentre) {
  SmallDeck d = two_shells();
  d.shell(1, 3, 2, 3, 12, 13).add("@/ADMAS/5/1 MASS=6e-9 node_ID=13");
  const Meshed m(d);
  // Of every shell a quarter at each of its nodes.
  const std::vector<std::vector<std::int64_t>> shells{
      {1, 2, 3, 4}, {11, 12, 13, 14}, {2, 3, 12, 13}};
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
  const bool third_last = m.b.model.shell4.id[2] == 3;
  ASSERT_TRUE(third_last);
  expect(m.m.parts[0], {0, 2});
  expect(m.m.parts[1], {1});
  expect(m.m.total, {0, 1, 2});
  const auto& dt = m.m.of(ElementKind::shell4).dt;
  EXPECT_EQ(m.m.parts[0].dt, std::min(dt[0], dt[2]));
  EXPECT_EQ(m.m.parts[0].slowest.element, dt[0] < dt[2] ? 0u : 2u);
  EXPECT_EQ(m.m.parts[1].slowest.element, 1u);
  EXPECT_EQ(m.m.total.dt, std::min({dt[0], dt[1], dt[2]}));
  EXPECT_EQ(m.m.parts[0].not_computed, 0u);
}

TEST(PartSums, CountElementsWithoutAStep) {
  SmallDeck d = two_shells();
  d.shell(1, 3, 1, 2, 3, 99).shell(9, 4, 1, 2, 3, 4).shell(9, 5, 1, 2, 3, 4);
  const Meshed m(d);
  const auto& dt = m.m.of(ElementKind::shell4).dt;
  EXPECT_EQ(std::count_if(dt.begin(), dt.end(), [](double x) { return std::isnan(x); }), 3);
  EXPECT_EQ(m.m.parts[0].not_computed, 1u);
  EXPECT_EQ(m.m.total.not_computed, 1u) << "of parts";
  std::map<std::string, std::uint64_t> reasons;
  for (const LeftOut& l : m.m.left_out) reasons[l.why] += l.count;
  EXPECT_EQ(reasons, (std::map<std::string, std::uint64_t>{{"a node is missing", 1},
                                                           {"the part is missing", 2}}));
  EXPECT_EQ(m.m.left_out[0].what, "time steps of shells with four nodes");
}

TEST(PartSums, OfUnknownMassesAreUnknown) {
  SmallDeck d = two_shells();
  d.add("/MAT/LAW51/7\nm\n").shell_part(3, 1.0, 0, 7).shell(3, 3, 1, 2, 12, 11);
  const Meshed m(d);
  EXPECT_TRUE(std::isnan(m.m.parts[2].mass));
  EXPECT_TRUE(std::isnan(m.m.parts[2].centre[0]));
  EXPECT_TRUE(std::isnan(m.m.parts[2].inertia[5]));
  near(m.m.total.mass, m.m.parts[0].mass + m.m.parts[1].mass);
}

// ---- elements of a mesh ------------------------------------------------------------------------

TEST(MeshElements, TakeTheirOwnThicknessBeforeThatOfTheProperty) {
  SmallDeck d = two_shells();
  d.shell(2, 3, 1, 2, 3, 4, 0.75);
  const Meshed m(d);
  const auto& mass = m.m.of(ElementKind::shell4).mass;
  near(mass[2], mass[0] / 2 * 0.75);
}

TEST(MeshElements, OfSixNodesGiveStiffnessToTheFirstSixSlots) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 8, 0, 0).node(3, 0, 5, 0);
  d.node(4, 0, 0, 1).node(5, 8, 0, 1).node(6, 0, 5, 1).solid_part(1);
  d.add("/PENTA6/1\n         1         1         2         3         4         5         6");
  const Meshed m(d);
  const double dt = m.m.of(ElementKind::solid8).dt.at(0),
               mass = m.m.of(ElementKind::solid8).mass[0];
  const double k = 0.25 * mass / (dt * dt);
  // Slots n1 n2 n3 n1 n4 n5 n6 n4.
  for (const auto& [node, slots] : {std::pair(1, 2.), {2, 1.}, {3, 1.}, {4, 1.}, {5, 1.}, {6, 0.}})
    EXPECT_NEAR(m.k(node), slots * k, 1e-12 * k) << node;
  for (int n = 1; n <= 6; ++n) near(m.mass(n), mass / 6);
}

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

TEST(MeshElements, ThatTheEngineFileChangesHaveNoStep) {
  const Folder folder;
  const auto steps = [&](const std::string& engine, const char* name = "d_0001.rad") {
    SmallDeck d;
    d.node(1, 0, 0, 0).node(2, 6, 0, 0).node(3, 0, 5, 0).node(4, 0, 0, 4);
    d.node(5, 3, 0, 0).node(6, 3, 2.5, 0).node(7, 0, 2.5, 0);
    d.node(8, 0, 0, 2).node(9, 3, 0, 2).node(10, 0, 2.5, 2).solid_part(1);
    d.tetra(1, 1, 1, 2, 3, 4);
    d.add(
        "/TETRA10/1\n         2\n         1         2         3         4         5         6"
        "         7         8         9        10");
    d.add("@/PROP/TYPE20/2 Isolid=15 Inpts=222\n/PART/2\np\n         2         1");
    d.node(21, 0, 0, 9).node(22, 5, 0, 9).node(23, 5, 5, 9).node(24, 0, 5, 9);
    d.node(25, 0, 0, 8).node(26, 5, 0, 8).node(27, 5, 5, 8).node(28, 0, 5, 8);
    d.brick(2, 3, {25, 26, 27, 28, 21, 22, 23, 24});
    const std::string path = folder.write("d_0000.rad", d.text());
    folder.write("d_0001.rad", "");
    folder.write(name, "/RUN/d/1\n1.0\n" + engine);
    const auto loaded = load(path);
    EXPECT_TRUE(loaded);
    const auto& f = loaded->model().solid8;
    std::string known;
    for (const std::int64_t id : {1, 2, 3})
      known += std::isnan(loaded->mesh().of(ElementKind::solid8).dt[f.map.find(id)]) ? "-" : "+";
    return known;
  };
  EXPECT_EQ(steps(""), "+++");
  EXPECT_EQ(steps("/DT1/BRICK\n"), "-++");
  EXPECT_EQ(steps("/DT1/BRICK/x\n"), "-++");
  EXPECT_EQ(steps("/DT1/BRICKS\n"), "+++");
  EXPECT_EQ(steps("/DT1TET10\n"), "+-+");
  EXPECT_EQ(steps("/DTTSH\n"), "++-");
  EXPECT_EQ(steps("/DTTSH\n/DT1/BRICK\n/DT1TET10\n"), "---");
  EXPECT_EQ(steps("/DTTSH\n", "d_0002.rad"), "+++") << "the first file alone";
}

TEST(MeshElements, OfPulleysGiveTheirMiddleNodeTwice) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 3, 0, 0).node(3, 3, 4, 0);
  d.add("@/PROP/TYPE12/1 Mass=8 K=5 Ileng=1\n/PART/1\np\n         1         0");
  d.add("/SPRING/1\n         1         1         2         3");
  const Meshed m(d);
  const double mass = 8 * 7, k = 5.0 / 7;
  near(m.m.of(ElementKind::spring).mass.at(0), mass);
  near(m.mass(1), mass / 4);
  near(m.mass(2), mass / 2);
  near(m.mass(3), mass / 4);
  near(m.k(1), k);
  near(m.k(2), k);
  near(m.m.of(ElementKind::spring).dt.at(0), std::sqrt(mass / k));
}

}  // namespace
}  // namespace deck::test
