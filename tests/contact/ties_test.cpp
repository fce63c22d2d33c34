// Ties: the search finds what looking at every segment finds, and nodes are lost for the reasons
// that the solver has.
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "contact/shared/tie_parts.hpp"
#include "contact/small_deck.hpp"
#include "contact/tied_sheet.hpp"
#include "deck/contact/ties.hpp"

namespace deck::test {
namespace {

using detail::Corners;

SceneOptions with_ties(int threads = 1) {
  SceneOptions options;
  options.ties = true;
  options.threads = threads;
  return options;
}

const Tie& tie_of(const Built& built, std::int64_t id = 1) {
  for (const Tie& t : built.scene.ties)
    if (t.inter->id == id) return t;
  throw std::runtime_error("no such tie");
}

const TiedNode& node_of(const Built& built, std::int64_t node, std::int64_t id = 1) {
  for (const TiedNode& n : tie_of(built, id).nodes)
    if (built.model.node_id(n.node) == node) return n;
  throw std::runtime_error("no such node");
}

// ---- the search ---------------------------------------------------------------------------------

/// A bumpy sheet of quads and triangles, and nodes around it.
SmallDeck random_sheet(unsigned seed, int cells, int nodes, double thickness) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.35, 0.35), place(-0.2, 1.2), height(-1.5, 1.5);
  SmallDeck d;
  const int row = cells + 1;
  for (int j = 0; j < row; ++j)
    for (int i = 0; i < row; ++i)
      d.node(1 + i + row * j, i + shift(random), j + shift(random), shift(random));
  std::vector<int> group;
  for (int k = 0; k < nodes; ++k) {
    group.push_back(10001 + k);
    // Some exactly over nodes: many segments are equally far there.
    const bool over = k % 5 == 0;
    const double x = cells * place(random), y = cells * place(random);
    d.node(group.back(), over ? std::round(x) : x, over ? std::round(y) : y, height(random));
  }
  d.shell_part(1, thickness);
  int id = 0;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int n = 1 + i + row * j;
      if ((i + j) % 3 != 0) {
        d.shell(1, ++id, n, n + 1, n + row + 1, n + row);
      } else {
        d.shell3(1, ++id, n, n + 1, n + row + 1);
        d.shell3(1, ++id, n, n + row + 1, n + row);
      }
    }
  d.group("/SURF/PART/1", {1});
  d.group("/GRNOD/NODE/9", group);
  return d;
}

struct Choice {
  std::uint32_t segment = no_index;
  detail::Projection at;
  double distance = 0;
};

/// The choice of a node by looking at every segment: specification 4 and 5 without any search.
Choice look_at_all(const Built& built, const Tie& tie, NodeIndex node, double thickness) {
  const Coordinates& x = built.scene.coordinates;
  const auto apart = [&](NodeIndex a, NodeIndex b) {
    return std::hypot(x.x[a] - x.x[b], x.y[a] - x.y[b], x.z[a] - x.z[b]);
  };
  Choice best;
  for (std::uint32_t m = 0; m < tie.main.size(); ++m) {
    const Corners& c = tie.main[m];
    const double g =
        tie.search_distance != 0
            ? tie.search_distance
            : std::max(0.05 * std::min(apart(c[0], c[2]), apart(c[1], c[3])), 0.6 * thickness);
    const detail::Projection p = detail::project(x, node, c, g, tie.spotflag == 27);
    if (!(p.depth > 0) || !(std::fabs(p.s) < 1.5) || !(std::fabs(p.t) < 1.5)) continue;
    const double distance = g - p.depth;
    const auto off = [](const detail::Projection& q) {
      return std::max(std::fabs(q.s), std::fabs(q.t));
    };
    if (best.segment != no_index &&
        (distance > best.distance || (distance == best.distance && !(off(p) < off(best.at)))))
      continue;
    best = {m, p, distance};
  }
  return best;
}

class RandomSheets : public testing::TestWithParam<unsigned> {};

TEST_P(RandomSheets, TheSearchFindsWhatLookingAtEverySegmentFinds) {
  const double thickness = 0.5 + 0.3 * (GetParam() % 4);
  SmallDeck d = random_sheet(GetParam(), 9, 300, thickness);
  d.add(tie_card({.id = 1, .ignore = 1, .dsearch = 0}));
  d.add(tie_card({.id = 2, .ignore = 1, .dsearch = 0.7}));
  d.add(tie_card({.id = 3, .ignore = 3, .dsearch = 0}));
  const Built built(d, with_ties());
  ASSERT_EQ(built.scene.ties.size(), 3U);
  for (const Tie& tie : built.scene.ties) {
    std::size_t found = 0;
    for (const TiedNode& n : tie.nodes) {
      const Choice all = look_at_all(built, tie, n.node, thickness);
      ASSERT_EQ(n.segment, all.segment) << tie.inter->id << " " << built.model.node_id(n.node);
      if (all.segment == no_index) continue;
      ++found;
      EXPECT_EQ(n.s, all.at.s);
      EXPECT_EQ(n.t, all.at.t);
      EXPECT_EQ(n.distance, all.distance);
    }
    EXPECT_GT(found, 20U);
    EXPECT_LT(found, tie.nodes.size());
  }
}

TEST_P(RandomSheets, TheNearestSegmentOfALostNodeIsTheNearest) {
  SmallDeck d = random_sheet(GetParam(), 7, 150, 0.5);
  d.add(tie_card({.id = 1, .ignore = 1, .dsearch = 0.05}));
  const Built built(d, with_ties());
  std::size_t lost = 0;
  for (const TiedNode& n : tie_of(built).nodes) {
    if (n.segment != no_index) continue;
    ++lost;
    double least = 1e30;
    for (const Corners& c : tie_of(built).main)
      least = std::min(least, detail::distance_from(built.scene.coordinates, n.node, c));
    ASSERT_NE(n.nearest, no_index);
    EXPECT_EQ(n.nearest_distance, least);
  }
  EXPECT_GT(lost, 50U);
}

TEST_P(RandomSheets, ThreadsChangeNothing) {
  SmallDeck d = random_sheet(GetParam(), 9, 200, 1);
  d.add(tie_card({.id = 1, .ignore = 1}));
  const Built one(d, with_ties(1)), four(d, with_ties(4));
  const Tie &a = tie_of(one), &b = tie_of(four);
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    EXPECT_EQ(a.nodes[i].segment, b.nodes[i].segment);
    EXPECT_EQ(a.nodes[i].distance, b.nodes[i].distance);
    EXPECT_EQ(a.nodes[i].nearest, b.nodes[i].nearest);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomSheets, testing::Range(1U, 9U));

// ---- what becomes of nodes (specification 13) ---------------------------------------------------

TEST(Ties, WorkedExamples) {
  SmallDeck d = sheet({{10, 5, 2},
                       {31, 15, 1},
                       {34.9, 15, 0},
                       {30, 36, 1},
                       {36, 30, 1},
                       {30.099, 12, 0},
                       {30.1, 12, 0},
                       {0, 0, 9.99},
                       {0, 0, 10},
                       {9.999999, 10.000001, 0.25}});
  const Built built(d.add(tie_card({})), with_ties());
  EXPECT_EQ(tie_of(built).search_distance, 10);
  const auto is = [&](int node, std::uint32_t segment, double s, double t, int message) {
    const TiedNode& n = node_of(built, node);
    EXPECT_EQ(n.segment, segment) << node;
    EXPECT_NEAR(n.s, s, 1e-12) << node;
    EXPECT_NEAR(n.t, t, 1e-12) << node;
    EXPECT_EQ(n.message, message) << node;
  };
  is(101, 0, 1, 0, 0);
  is(102, 5, 1.2, 0, 1079);
  EXPECT_EQ(node_of(built, 102).distance, 1.4142135623730958);
  is(103, no_index, 0, 0, 1157);
  is(104, 8, 1, 1, 0);
  EXPECT_NEAR(node_of(built, 104).distance, 6.082762530298219, 1e-14);
  is(105, no_index, 0, 0, 1157);
  is(106, 5, 1.0198, -0.6, 0);
  is(107, 5, 1.02, -0.6, 1079);
  is(108, 0, -1, -1, 0);
  is(109, no_index, 0, 0, 1157);
  is(110, 3, 0.9999998, -0.9999998, 0);
}

TEST(Ties, IgnoreDecidesWhetherALostNodeStopsTheSolver) {
  for (const auto& [ignore, message] : {std::pair(0, 1078), {1000, 1078}, {1, 1157}, {2, 1157}}) {
    const Built built(sheet({{5, 5, 3}}).add(tie_card({.ignore = ignore, .dsearch = 2})),
                      with_ties());
    EXPECT_EQ(node_of(built, 101).message, message);
    EXPECT_TRUE(node_of(built, 101).lost());
    EXPECT_EQ(node_of(built, 101).nearest_distance, 3);
  }
  const Built pairs(sheet({{5, 5, 3}}).add(tie_card({.ignore = 3})), with_ties());
  EXPECT_EQ(node_of(pairs, 101).message, 1071);
  EXPECT_EQ(node_of(pairs, 101).search, 0.6 * 2);
}

TEST(Ties, PenaltyFormulationsDropWhatIsFarOutsideAlsoWithoutIgnore) {
  const Built built(
      sheet({{40, 15, 1}}).add(tie_card({.ignore = 0, .spotflag = 28, .dsearch = 30})),
      with_ties());
  EXPECT_EQ(node_of(built, 101).message, 1158);
  EXPECT_FALSE(node_of(built, 101).tied);
  const TieCounts counts = count_ties(tie_of(built));
  EXPECT_EQ(counts.dropped, 1U);
  EXPECT_EQ(counts.lost(), 1U);
}

TEST(Ties, TheSameTieTwiceIsKeptOnce) {
  SmallDeck d = sheet({{5, 5, 1}, {15, 5, 1}});
  d.add(tie_card({.id = 1, .spotflag = 27})).add(tie_card({.id = 2, .spotflag = 28}));
  const Built built(d, with_ties());
  EXPECT_TRUE(node_of(built, 101, 1).tied);
  EXPECT_EQ(node_of(built, 101, 2).removed_by, 1630);
  EXPECT_FALSE(node_of(built, 101, 2).lost());
  ASSERT_EQ(tie_of(built, 2).repeated.size(), 1U);
  EXPECT_EQ(tie_of(built, 2).repeated[0].count, 2U);
}

TEST(Ties, AMainNodeThatIsTiedStopsTheSolverUnlessByPenalty) {
  for (const auto& [spotflag, stops] : {std::pair(5, true), {1, true}, {27, false}, {25, false}}) {
    SmallDeck d = sheet({{5, 5, 1}, {0, 0, 1}, {10, 0, 1}, {10, 10, 1}, {0, 10, 1}});
    d.segments("/SURF/SEG/2", {{102, 103, 104, 105}});
    d.group("/GRNOD/NODE/8", {1});
    d.add(tie_card({.id = 1}));
    d.add(tie_card({.id = 2, .grnd = 8, .surf = 2, .spotflag = spotflag, .dsearch = 5}));
    const Built built(d, with_ties());
    // Node 1 is a corner in use of the first tie, and secondary in the second.
    EXPECT_EQ(!tie_of(built, 1).main_and_tied.empty(), stops) << spotflag;
  }
}

TEST(Ties, AnotherConditionMakesAPenaltyOfATie) {
  for (const char* other :
       {"/BCS/1\nb\n   100 000         0         7",
        "/RBE2/1\nr\n        16   111 111         0         7",
        "/RBODY/1\nr\n        16         0         0         0                   "
        "0         7\n\n\n"}) {
    SmallDeck d = sheet({{5, 5, 1}, {15, 5, 1}});
    d.group("/GRNOD/NODE/7", {101}).add(other).add(tie_card({.spotflag = 27}));
    const Built built(d, with_ties());
    EXPECT_TRUE(node_of(built, 101).penalty) << other;
    EXPECT_FALSE(node_of(built, 102).penalty) << other;
    EXPECT_TRUE(node_of(built, 101).tied);
  }
}

TEST(Ties, TheCornerNumberDecidesWhichShellGivesTheThickness) {
  // Shell 101-102-103-104 is 1 thick, its neighbour 8: nodes 102 and 103 belong to both.
  SmallDeck d = sheet({{0, 0, 3}, {10, 0, 3}, {10, 10, 3}, {0, 10, 3}, {20, 0, 3}, {20, 10, 3}});
  d.shell_part(2, 1).shell_part(3, 8);
  d.shell(2, 21, 101, 102, 103, 104).shell(3, 22, 102, 105, 106, 103);
  const Built built(d.add(tie_card({.ignore = 3})), with_ties());
  EXPECT_FALSE(node_of(built, 102).tied);  // corner 2 of the thin, corner 1 of the thick shell
  EXPECT_TRUE(node_of(built, 103).tied);   // corner 3 of the thin, corner 4 of the thick shell
  for (const int node : {102, 103}) {
    EXPECT_EQ(node_of(built, node).least_search, 0.6 * (1.0 + 2.0));
    EXPECT_EQ(node_of(built, node).most_search, 0.6 * (8.0 + 2.0));
  }
}

TEST(Ties, TheOldSearchTiesEveryNode) {
  const Built built(sheet({{5, 5, 200}, {500, 15, 0}}).add(tie_card({.isearch = 1})), with_ties());
  EXPECT_TRUE(node_of(built, 101).tied);
  EXPECT_TRUE(node_of(built, 102).tied);
  EXPECT_NEAR(node_of(built, 101).distance, 200, 1e-9);
}

TEST(Ties, ALoadedDeckFindsThemWhenAsked) {
  const Built built(sheet({{5, 5, 1}, {5, 5, 30}}).add(tie_card({})));
  EXPECT_TRUE(built.scene.ties.empty());  // nobody asked
  const std::vector<Tie>& ties = built.loaded.ties();
  ASSERT_EQ(ties.size(), 1U);
  EXPECT_EQ(count_ties(ties[0]).tied, 1U);
  EXPECT_EQ(count_ties(ties[0]).not_found, 1U);
}

TEST(Ties, WhatIsSaidOfThem) {
  const Built holds(sheet({{5, 5, 1}}).add(tie_card({})), with_ties());
  EXPECT_EQ(holds_text(tie_of(holds)), "1 node is tied");
  EXPECT_EQ(losses_text(tie_of(holds)), "-");
  const Built loses(sheet({{5, 5, 1}, {5, 5, 30}, {15, 5, 30}}).add(tie_card({})), with_ties());
  EXPECT_EQ(holds_text(tie_of(loses)), "2 of 3 nodes are not tied");
  EXPECT_EQ(losses_text(tie_of(loses)), "2 not found");
  const Built unknown(sheet({{5, 5, 1}}).add(tie_card({.isearch = 3})), with_ties());
  EXPECT_EQ(holds_text(tie_of(unknown)), "not evaluated: " + tie_of(unknown).not_evaluated);
}

TEST(Ties, ASearchThatTheSolverDoesNotHaveIsNotEvaluated) {
  const Built built(sheet({{5, 5, 1}}).add(tie_card({.isearch = 3})), with_ties());
  EXPECT_FALSE(tie_of(built).not_evaluated.empty());
}

}  // namespace
}  // namespace deck::test
