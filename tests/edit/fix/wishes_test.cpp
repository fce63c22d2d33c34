// Moving nodes: the sweeps over the wishes against the exact solution of the same quadratic
// program, by an active set with Eigen's dense factorisation.
#include "edit/fix/nodes/ways_out.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <random>

namespace deck::detail {
namespace {

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

}  // namespace
}  // namespace deck::detail
