// Ties: the search finds what looking at every segment finds, nodes are lost for the reasons that
// the solver has; places on segments and the old search by hand.
#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <tuple>

#include "contact/shared/tie_steps.hpp"
#include "contact/tied_sheet.hpp"
#include "deck/contacts.hpp"

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
  int id = 1;
  const auto bumpy = [&](int i, int j) {
    return std::array{i + shift(random), j + shift(random), shift(random)};
  };
  add_grid(d, 1, cells, cells, bumpy, [&](int i, int j, const Corners4& n) {
    if ((i + j) % 3 != 0)
      d.shell(1, id, n[0], n[1], n[2], n[3]);
    else
      add_two_triangles(d, 1, id, n);
    id += 2;
  });
  std::vector<int> group;
  for (int k = 0; k < nodes; ++k) {
    group.push_back(10001 + k);
    // Some exactly over nodes: many segments are equally far there.
    const bool over = k % 5 == 0;
    const double x = cells * place(random), y = cells * place(random);
    d.node(group.back(), over ? std::round(x) : x, over ? std::round(y) : y, height(random));
  }
  return d.shell_part(1, thickness).group("/SURF/PART/1", {1}).group("/GRNOD/NODE/9", group);
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
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    EXPECT_EQ(std::tie(a.nodes[i].segment, a.nodes[i].distance, a.nodes[i].nearest),
              std::tie(b.nodes[i].segment, b.nodes[i].distance, b.nodes[i].nearest));
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomSheets, testing::Range(1U, 9U));

// ---- what becomes of nodes (specification 13) ---------------------------------------------------

TEST(Ties, WorkedExamples) {
  struct Case {
    std::array<double, 3> place;
    std::uint32_t segment;
    double s, t;
    int message;
  };
  const Case cases[] = {{{10, 5, 2}, 0, 1, 0, 0},
                        {{31, 15, 1}, 5, 1.2, 0, 1079},
                        {{34.9, 15, 0}, no_index, 0, 0, 1157},
                        {{30, 36, 1}, 8, 1, 1, 0},
                        {{36, 30, 1}, no_index, 0, 0, 1157},
                        {{30.099, 12, 0}, 5, 1.0198, -0.6, 0},
                        {{30.1, 12, 0}, 5, 1.02, -0.6, 1079},
                        {{0, 0, 9.99}, 0, -1, -1, 0},
                        {{0, 0, 10}, no_index, 0, 0, 1157},
                        {{9.999999, 10.000001, 0.25}, 3, 0.9999998, -0.9999998, 0}};
  std::vector<std::array<double, 3>> places;
  for (const Case& c : cases) places.push_back(c.place);
  const Built built(sheet(places).add(tie_card({})), with_ties());
  EXPECT_EQ(tie_of(built).search_distance, 10);
  for (std::size_t k = 0; k < std::size(cases); ++k) {
    const TiedNode& n = tie_of(built).nodes.at(k);
    EXPECT_EQ(n.segment, cases[k].segment) << k;
    EXPECT_NEAR(n.s, cases[k].s, 1e-12) << k;
    EXPECT_NEAR(n.t, cases[k].t, 1e-12) << k;
    EXPECT_EQ(n.message, cases[k].message) << k;
  }
  EXPECT_EQ(node_of(built, 102).distance, 1.4142135623730958);
  EXPECT_NEAR(node_of(built, 104).distance, 6.082762530298219, 1e-14);
}

TEST(Ties, IgnoreAndFormulationDecideWhatBecomesOfALostNode) {
  const std::array<double, 3> above{5, 5, 3}, beside{40, 15, 1};
  const std::tuple<TieCard, std::array<double, 3>, int> cases[] = {
      {{.ignore = 0, .dsearch = 2}, above, 1078},  // stops the solver
      {{.ignore = 1000, .dsearch = 2}, above, 1078},
      {{.ignore = 1, .dsearch = 2}, above, 1157},
      {{.ignore = 2, .dsearch = 2}, above, 1157},
      {{.ignore = 3}, above, 1071},
      {{.ignore = 0, .spotflag = 28, .dsearch = 30}, beside, 1158}};  // found, and too far outside
  for (const auto& [card, place, message] : cases) {
    const Built built(sheet({place}).add(tie_card(card)), with_ties());
    EXPECT_EQ(node_of(built, 101).message, message);
    EXPECT_TRUE(node_of(built, 101).lost());
    EXPECT_EQ(count_ties(tie_of(built)).dropped, message == 1158 ? 1U : 0U);
    if (message == 1071) {
      EXPECT_EQ(node_of(built, 101).search, 0.6 * 2);
    } else if (message != 1158) {
      EXPECT_EQ(node_of(built, 101).nearest_distance, 3);
    }
  }
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

TEST(Ties, SpotflagDecidesWhatIsAPenalty) {
  for (const int spotflag : {5, 25, 26, 27}) {
    const Built b(sheet({{5, 5, 1}, {5, 15, 1}, {5, 5, 900}}).add(tie_card({.spotflag = spotflag})),
                  with_ties());
    for (const int node : {101, 102, 103}) {
      EXPECT_EQ(node_of(b, node).tied, node < 103) << spotflag;
      EXPECT_EQ(node_of(b, node).penalty, node < 103 && (spotflag == 25 || spotflag == 26));
    }
  }
}

// ---- the old search (Isearch 1), by hand
// ---------------------------------------------------------

TEST(OldSearch, TakesASegmentAtTheNearestNodeAndThePlaceOnIt) {
  struct Case {
    double x, y, z;
    std::uint32_t segment;
    double s, t, distance;
  };
  const Case cases[] = {
      {5, 5, 200, 0, 0, 0, 200},  // four nodes are as near: the highest id, its first
      {7, 6, 3, 0, 0.4, 0.2, 3},  // around node (10, 10) it is in the first segment
      {12, 6, 3, 1, -0.6, 0.2, 3},
      {8, 13, 3, 3, 0.6, -0.4, 3},
      {12, 13, -2, 4, -0.6, -0.4, 2},
      {23, 28, 2, 8, -0.4, 0.6, 2},
      {31, 15, 1, 5, 1.2, 0, 1},                     // beyond the rim: as far as it is
      {30.05, 15, 1, 5, 1, 0, std::hypot(0.05, 1)},  // by little: on the rim
      {15, -0.05, 1, 1, 0, -1, std::hypot(0.05, 1)}};
  std::vector<std::array<double, 3>> nodes;
  for (const Case& c : cases) nodes.push_back({c.x, c.y, c.z});
  const Built b(sheet(nodes).add(tie_card({.isearch = 1})), with_ties());
  const Tie& tie = b.scene.ties.at(0);
  ASSERT_EQ(tie.nodes.size(), std::size(cases));
  for (std::size_t k = 0; k < tie.nodes.size(); ++k) {
    const TiedNode& n = tie.nodes[k];
    EXPECT_TRUE(n.tied);
    EXPECT_EQ(n.segment, cases[k].segment) << k;
    EXPECT_NEAR(n.s, cases[k].s, 1e-12) << k;
    EXPECT_NEAR(n.t, cases[k].t, 1e-12) << k;
    EXPECT_NEAR(n.distance, cases[k].distance, 1e-9) << k;
  }
}

TEST(OldSearch, PlacesOnATriangleAreOverTheirFoot) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 0, 10, 0);
  // The last two are beside the long side and the left one.
  const double places[][3] = {{2, 3, 4},  {6, 1, 2},       {1, 7, 3},
                              {3, 3, -5}, {5.05, 5.05, 1}, {-0.05, 4, 1}};
  std::vector<int> group;
  for (const auto& p : places) {
    group.push_back(101 + static_cast<int>(group.size()));
    d.node(group.back(), p[0], p[1], p[2]);
  }
  d.shell_part(1, 2).shell3(1, 1, 1, 2, 3).group("/SURF/PART/1", {1}).group("/GRNOD/NODE/9", group);
  const Built b(d.add(tie_card({.isearch = 1})), with_ties());
  const Tie& tie = b.scene.ties.at(0);
  ASSERT_EQ(tie.nodes.size(), 6u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(tie.nodes[k].distance, std::abs(places[k][2]), 1e-9) << k;
    EXPECT_LT(std::abs(tie.nodes[k].s), 1) << k;
  }
  // On the side: s is its end, t from the height over the base.
  EXPECT_NEAR(tie.nodes[4].s, 1, 1e-12);
  EXPECT_NEAR(tie.nodes[4].t, 0.01, 1e-12);
  EXPECT_NEAR(tie.nodes[4].distance, std::hypot(0.1, 1), 1e-9);
  EXPECT_NEAR(tie.nodes[5].s, -1, 1e-12);
  EXPECT_NEAR(tie.nodes[5].t, -0.2, 1e-12);
  EXPECT_NEAR(tie.nodes[5].distance, std::hypot(0.05, 1), 1e-9);
}

// ---- places on segments -------------------------------------------------------------------------

Coordinates with_node(double x, double y, double z) {
  Coordinates c;
  c.x = {0, 10, 10, 0, x};
  c.y = {0, 0, 10, 10, y};
  c.z = {0, 0, 0, 0, z};
  return c;
}

TEST(PlaceOnASegment, IsThatOfTheSquareAlsoBeyondItsRim) {
  const detail::Corners square{0, 1, 2, 3};
  for (const double x : {1.0, 4.0, 5.0, 8.5, -2.0, 12.0})
    for (const double y : {2.0, 5.0, 9.0, -1.0, 11.0}) {
      const detail::Projection p = detail::project(with_node(x, y, 3), 4, square, 20, false);
      EXPECT_NEAR(p.s, x / 5 - 1, 1e-12) << x << ' ' << y;
      EXPECT_NEAR(p.t, y / 5 - 1, 1e-12) << x << ' ' << y;
      const double beside_x = std::max({0.0, -x, x - 10}), beside_y = std::max({0.0, -y, y - 10});
      const double away = std::hypot(beside_x, beside_y, 3.0);
      EXPECT_NEAR(p.depth, 20 - away, 1e-9) << x << ' ' << y;
      EXPECT_NEAR(detail::distance_from(with_node(x, y, 3), 4, square), away, 1e-9);
    }
}

TEST(PlaceOnASegment, OfATriangleRunsFromItsLastCornerAndKnowsTheSideAtIt) {
  const detail::Corners triangle{0, 1, 3, 3};  // (0, 0), (10, 0), (0, 10)
  const auto at = [&](double x, double y, bool weights) {
    const detail::Projection p = detail::project(with_node(x, y, 2), 4, triangle, 5, weights);
    return std::pair(p.s, p.t);
  };
  const auto near = [](std::pair<double, double> got, double s, double t) {
    EXPECT_NEAR(got.first, s, 1e-12);
    EXPECT_NEAR(got.second, t, 1e-12);
  };
  // Shares 0.5 of the first and 0.2 of the second corner.
  near(at(2, 3, false), -0.3 / 0.7, 1 - 2 * 0.7);
  near(at(2, 3, true), 0.5, 0.2);
  near(at(6, 1, false), 0.3 / 0.9, 1 - 2 * 0.9);
  near(at(0, 10, false), 0, 1);    // the last corner
  near(at(1, 10, false), 2, 1);    // beside it
  near(at(-1, 10, false), -2, 1);  // on the other side
  near(at(0, 0, false), -1, -1);
  near(at(10, 0, false), 1, -1);
}

}  // namespace
}  // namespace deck::test
