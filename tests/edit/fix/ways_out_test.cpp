// Moving nodes: the sweeps over the wishes against the exact solution of the same quadratic
// program, by an active set with Eigen's dense factorisation; bounds of moves and rounded numbers
// against closed forms; elements that are turned inside out or crossed.
#include <gmock/gmock.h>
#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <vector>

#include "contact/meshes.hpp"
#include "edit/fix/fix_scene.hpp"
#include "edit/fix/nodes/ways_out.hpp"

namespace deck::detail {
namespace {

using test::Built;
using test::SmallDeck;

/// Wishes of nodes against triangles that share some of their nodes. Each wish has a secondary node
/// to itself, so that all of them can be fulfilled together.
std::vector<Wish> random_wishes(std::mt19937& random, std::size_t count) {
  std::uniform_real_distribution<double> from_0_to_1(0, 1), both_signs(-1, 1);
  std::uniform_int_distribution<NodeIndex> any_main(0, 7);
  std::vector<Wish> wishes(count);
  for (std::size_t r = 0; r < count; ++r) {
    Wish& w = wishes[r];
    const NodeIndex first = any_main(random);
    w.state.nodes = {static_cast<NodeIndex>(8 + r), first, (first + 1) % 8, (first + 3) % 8, 0, 0};
    const double b = from_0_to_1(random), c = (1 - b) * from_0_to_1(random);
    w.state.weights = {1, -b, -c, -(1 - b - c), 0, 0};
    w.state.count = 4;
    w.state.gap = 1;
    w.normal = unit({both_signs(random), both_signs(random), both_signs(random)});
    w.by = both_signs(random);
  }
  return wishes;
}

Eigen::MatrixXd matrix_of(const std::vector<Wish>& wishes, const std::vector<std::uint8_t>& held) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(wishes.size()),
                                            static_cast<Eigen::Index>(3 * held.size()));
  for (std::size_t r = 0; r < wishes.size(); ++r) {
    const Wish& w = wishes[r];
    for (std::size_t i = 0; i < static_cast<std::size_t>(w.state.count); ++i) {
      if (held[w.state.nodes[i]] != 0) continue;
      const Eigen::Vector3d part =
          w.state.weights[i] * Eigen::Vector3d(w.normal.x, w.normal.y, w.normal.z);
      a.row(static_cast<Eigen::Index>(r)).segment<3>(3 * w.state.nodes[i]) += part.transpose();
    }
  }
  return a;
}

/// The least u (sum of squares) with a u >= b: among all sets of wishes that hold exactly, the one
/// whose multipliers and whose other wishes are not negative. Tries the sets one by one.
Eigen::VectorXd least_moves(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  constexpr double rounding = 1e-9;
  for (unsigned set = 0; set < 1U << b.size(); ++set) {
    std::vector<Eigen::Index> active;
    for (Eigen::Index r = 0; r < b.size(); ++r)
      if ((set >> r & 1U) != 0) active.push_back(r);
    const Eigen::MatrixXd rows = a(active, Eigen::all);
    const Eigen::VectorXd multiplier = (rows * rows.transpose()).ldlt().solve(b(active));
    const Eigen::VectorXd u = rows.transpose() * multiplier;
    if ((multiplier.array() >= -rounding).all() && ((a * u - b).array() >= -rounding).all())
      return u;
  }
  ADD_FAILURE() << "no set of wishes solves the program";
  return Eigen::VectorXd::Zero(a.cols());
}

TEST(Wishes, TheSweepsEndAtTheLeastMovesOfTheQuadraticProgram) {
  std::mt19937 random(20);
  for (int scene = 0; scene < 300; ++scene) {
    const std::size_t count = 1 + static_cast<std::size_t>(scene) % 8;
    const std::vector<Wish> wishes = random_wishes(random, count);
    std::vector<std::uint8_t> held(8 + count, 0);
    for (std::size_t n = 0; n < 8; ++n) held[n] = random() % 4 == 0;
    Eigen::VectorXd by(static_cast<Eigen::Index>(count));
    for (std::size_t r = 0; r < count; ++r) by[static_cast<Eigen::Index>(r)] = wishes[r].by;
    const Eigen::VectorXd exact = least_moves(matrix_of(wishes, held), by);
    Eigen::VectorXd swept = Eigen::VectorXd::Zero(exact.size());
    for (const auto& [n, move] : solve_wishes(wishes, held, 200))
      swept.segment<3>(3 * n) = Eigen::Vector3d(move.x, move.y, move.z);
    // A pass in which no multiplier changes by more than 1e-5 gaps is the last one; it leaves as
    // many times that as the passes gain slowly.
    EXPECT_LT((swept - exact).cwiseAbs().maxCoeff(), 1e-4) << "scene " << scene;
  }
}

TEST(DepthBounds, PairsWithoutADirectionLetANodeMoveNowhere) {
  DepthBounds bounds;
  PairState state;
  state.nodes = {0, 1};
  state.count = 2;
  for (int i = 0; i < 3; ++i) bounds.add({}, state, {}, 5);
  const NodeMoves wanted{{0, {1, 2, 3}}};
  EXPECT_EQ(norm(bounds.allowed(wanted, 1).at(0).by), 0);
  EXPECT_EQ(bounds.pairs_of(0).size(), 3u);
  bounds.add({}, state, {0, 0, 1}, 5);
  bounds.add({}, state, {}, 5);
  EXPECT_EQ(bounds.allowed(wanted, 1).at(0).by.z, 3);
  EXPECT_EQ(bounds.allowed(wanted, 1).at(0).by.x, 0);
}

TEST(RoundedNumbers, AreTheNearestOnTheirSide) {
  const auto down = [](double bound, int digits, int width = 20) {
    const auto r = detail::round_down(bound, digits, width);
    return r ? r->value : -1;
  };
  const auto up = [](double bound, int digits, int width = 20) {
    const auto r = detail::round_up(bound, digits, width);
    return r ? r->value : -1;
  };
  EXPECT_EQ(down(1.2356, 3), 1.23);
  EXPECT_EQ(up(1.2356, 3), 1.24);
  EXPECT_EQ(down(1.2344, 3), 1.23);
  EXPECT_EQ(up(1.2344, 3), 1.24);
  EXPECT_EQ(down(1.23, 3), 1.23) << "the bound itself is allowed";
  EXPECT_EQ(up(1.23, 3), 1.23);
  EXPECT_EQ(down(1.0001, 2), 1.0);
  EXPECT_EQ(up(9.99, 2), 10.0);
  EXPECT_EQ(down(0.099999, 2), 0.099);
  EXPECT_EQ(down(0.96, 1), 0.9);
  EXPECT_EQ(up(1.5e-7, 1), 2e-7);
  EXPECT_EQ(down(1.5e9, 1), 1e9);
  EXPECT_EQ(down(0, 3), -1);
  EXPECT_EQ(down(-1, 3), -1);
  // Fewer digits where the columns hold no more.
  EXPECT_EQ(down(123.456789, 9, 5), 123.4);
  EXPECT_EQ(up(123.456789, 9, 5), 123.5);
  EXPECT_EQ(detail::round_down(1.23, 3, 20, 1.23)->value, 1.22) << "below the number";
  EXPECT_EQ(detail::round_down(1.235, 3, 20, 1.24)->value, 1.23);
  EXPECT_EQ(detail::round_down(123.456789, 9, 5)->text, "123.4");
}

/// Of directions at right angles each gives its own share; what is left is made as short as
/// allowed: along each direction the reach, and in a corner of several the root of 3 times as much.
TEST(BoundsOfMoves, OfManyNodesAtOnceAreThoseOfEach) {
  detail::DepthBounds bounds;
  detail::NodeMoves wanted;
  std::vector<std::array<double, 3>> expected;
  std::vector<bool> at_bound;
  for (NodeIndex n = 0; n < 37; ++n) {
    const std::size_t axes = 1 + n % 3;
    const double sign = n % 2 == 0 ? 1 : -1, reach = 2 + n % 3;
    const std::array<double, 3> asked{3.0 * (n % 5) - 6, 2.0 * (n % 7) - 6, 4.0 * (n % 3) - 3};
    wanted.emplace_back(n, Vec{asked[0], asked[1], asked[2]});
    std::array<double, 3> by = asked;
    double farthest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      by[k] = k < axes ? sign * std::max(0.0, sign * asked[k]) : 0;
      farthest = std::max(farthest, std::abs(by[k]));
      if (k >= axes) continue;
      detail::PairState state;
      state.nodes[0] = n;
      state.count = state.secondary_count = 1;
      bounds.add({}, state, {k == 0 ? sign : 0, k == 1 ? sign : 0, k == 2 ? sign : 0}, reach);
    }
    const double length = std::sqrt(by[0] * by[0] + by[1] * by[1] + by[2] * by[2]);
    farthest = std::max(farthest, length / (axes > 1 ? std::sqrt(3.0) : 1));
    if (farthest > reach)
      for (double& v : by) v *= reach / farthest;
    expected.push_back(by);
    at_bound.push_back(farthest >= reach);
  }
  EXPECT_GT(std::count(at_bound.begin(), at_bound.end(), true), 9);
  EXPECT_GT(std::count(at_bound.begin(), at_bound.end(), false), 9);
  for (const int threads : {1, 3}) {
    const auto places = bounds.allowed(wanted, threads);
    ASSERT_EQ(places.size(), expected.size());
    for (std::size_t n = 0; n < places.size(); ++n) {
      SCOPED_TRACE(n);
      EXPECT_NEAR(places[n].by.x, expected[n][0], 1e-12);
      EXPECT_NEAR(places[n].by.y, expected[n][1], 1e-12);
      EXPECT_NEAR(places[n].by.z, expected[n][2], 1e-12);
      EXPECT_EQ(places[n].at_bound, at_bound[n]);
    }
  }
}

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Nodes of the elements that turn when nodes are put elsewhere.
std::vector<std::int64_t> turned(const SmallDeck& small,
                                 const std::map<std::int64_t, std::array<double, 3>>& moved) {
  const Built b(small);
  const detail::FixMesh mesh(b.scene);
  Coordinates now{b.model.nodes.x, b.model.nodes.y, b.model.nodes.z};
  const Coordinates before = now;
  std::vector<NodeIndex> nodes;
  for (const auto& [id, x] : moved) {
    const NodeIndex n = b.model.find_node(id);
    nodes.push_back(n);
    now.x[n] = x[0];
    now.y[n] = x[1];
    now.z[n] = x[2];
  }
  std::vector<std::int64_t> out;
  for (const NodeIndex n : mesh.inverted(before, now, nodes)) out.push_back(b.model.node_id(n));
  std::sort(out.begin(), out.end());
  return out;
}

SmallDeck square() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 8, 0, 0).node(3, 8, 8, 0).node(4, 0, 8, 0);
  return d.shell_part(1, 1.0).shell(1, 1, 1, 2, 3, 4);
}

SmallDeck tetra() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 8, 0, 0).node(3, 0, 8, 0).node(4, 0, 0, 8);
  return d.solid_part(1).tetra(1, 1, 1, 2, 3, 4);
}

SmallDeck cube() {
  SmallDeck d;
  test::add_brick(d, 1, 1, 1, {0, 0, 0}, {8, 8, 8});
  return d.solid_part(1);
}

TEST(InvertedElements, AnElementThatNoMovedNodeTouchesIsNotLookedAt) {
  SmallDeck d = square();
  d.node(5, 20, 0, 0);
  EXPECT_THAT(turned(d, {{5, {1, 1, 0}}}), IsEmpty());
}

TEST(InvertedElements, ATetrahedronThatWasInsideOutAlreadyMayTurnBackOnlyByPassingFlat) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 8, 0, 0).node(3, 0, 8, 0).node(4, 0, 0, -8);
  d.solid_part(1).tetra(1, 1, 1, 2, 3, 4);
  EXPECT_THAT(turned(d, {{4, {0, 0, -1}}}), IsEmpty());
  EXPECT_THAT(turned(d, {{4, {0, 0, 0}}}), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(turned(d, {{4, {0, 0, 1}}}), ElementsAre(1, 2, 3, 4));
}

TEST(CrossedElements, AreFoundWhereNodesMoved) {
  SmallDeck d = square();  // and a triangle over it
  d.node(5, 4, 4, 3).node(6, 7, 4, 3).node(7, 5, 7, 3).node(8, 20, 0, 0);
  d.shell_part(2, 1.0).shell3(2, 2, 5, 6, 7);
  const Built b(d.group("/SURF/PART/1", {1})
                    .group("/GRNOD/PART/2", {2})
                    .add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=4"));
  const detail::FixMesh mesh(b.scene);
  const Coordinates apart{b.model.nodes.x, b.model.nodes.y, b.model.nodes.z};
  const std::vector<NodeIndex> five{b.model.find_node(5)}, six{b.model.find_node(6)};
  Coordinates below = apart;
  below.z[five[0]] = -1;
  EXPECT_THAT(mesh.all_crossings(apart, 1), IsEmpty());
  const auto all = mesh.all_crossings(below, 1);
  ASSERT_EQ(all.size(), 2u) << "both edges of node 5";
  EXPECT_EQ(mesh.crossings(below, five, 1), all);
  EXPECT_EQ(mesh.crossings(below, six, 1).size(), 1u);
  EXPECT_THAT(mesh.crossings(apart, five, 1), IsEmpty());
}

/// Moves each corner of an element along a straight line: up to a share of it the element keeps its
/// side, beyond it is turned.
TEST(InvertedElements, AreFoundAtEveryCorner) {
  using Place = std::array<double, 3>;
  const auto check = [](const SmallDeck& d, const std::vector<Place>& corners, double share,
                        const std::function<Place(std::size_t)>& target) {
    std::vector<std::int64_t> all;
    for (std::size_t k = 0; k < corners.size(); ++k) all.push_back(static_cast<int>(k) + 1);
    for (std::size_t k = 0; k < corners.size(); ++k)
      for (const double off : {-0.01, 0.01}) {
        SCOPED_TRACE(k);
        const Place to = target(k);
        Place now = corners[k];
        for (std::size_t a = 0; a < 3; ++a) now[a] += (share + off) * (to[a] - now[a]);
        const auto found = turned(d, {{static_cast<std::int64_t>(k) + 1, now}});
        EXPECT_EQ(found, off < 0 ? std::vector<std::int64_t>() : all);
      }
  };
  const std::vector<Place> quad{{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}};
  check(square(), quad, 0.5, [&](std::size_t k) { return quad[(k + 2) % 4]; });
  SmallDeck triangle;
  triangle.node(1, 0, 0, 0).node(2, 8, 0, 0).node(3, 2, 6, 0).shell_part(1, 1.0);
  triangle.shell3(1, 1, 1, 2, 3);
  const std::vector<Place> three{{0, 0, 0}, {8, 0, 0}, {2, 6, 0}};
  check(triangle, three, 1, [&](std::size_t k) {
    const Place &a = three[(k + 1) % 3], &b = three[(k + 2) % 3];
    return Place{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, 0};
  });
  std::vector<Place> brick;
  for (int i = 0; i < 8; ++i)
    brick.push_back({i % 4 == 1 || i % 4 == 2 ? 8.0 : 0, i % 4 > 1 ? 8.0 : 0, i > 3 ? 8.0 : 0});
  // The neighbours of a corner are in a plane that cuts off a third of the diagonal.
  const auto opposite = [&](std::size_t k) {
    return Place{8 - brick[k][0], 8 - brick[k][1], 8 - brick[k][2]};
  };
  check(cube(), brick, 1.0 / 3, opposite);
  const std::vector<Place> four{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {0, 0, 8}};
  check(tetra(), four, 1, [&](std::size_t k) {
    Place middle{8.0 / 3, 8.0 / 3, 8.0 / 3};
    for (std::size_t a = 0; a < 3; ++a) middle[a] -= four[k][a] / 3;
    return middle;
  });
}

}  // namespace
}  // namespace deck::detail
