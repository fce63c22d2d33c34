// TYPE24 and TYPE25: the worked places of a shell and a cube, sides and gaps, what Inacti stores,
// edges, what is left open, and the search against looking at all pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "contact/modern/parts.hpp"
#include "contact/small_deck.hpp"

namespace deck::test {
namespace {

struct Place {
  double x, y, z;
};

/// A square shell (nodes 1-4, t = 2) or, beside it, a cube (11-18), and nodes from 101 on, each at
/// the corner of a shell of its own (t = 1.5).
SmallDeck places(const std::vector<Place>& list, bool cube = false) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  const double x[4] = {30, 40, 40, 30}, y[4] = {0, 0, 10, 10};
  for (int i = 0; i < 4; ++i) d.node(11 + i, x[i], y[i], 0).node(15 + i, x[i], y[i], 10);
  d.shell_part(1, 2).shell_part(2, 1.5).solid_part(3);
  d.shell(1, 1, 1, 2, 3, 4).brick(3, 3, {11, 12, 13, 14, 15, 16, 17, 18});
  std::vector<int> nodes;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const int n = 101 + static_cast<int>(i), far = 1000 + 3 * n;
    const auto& p = list[i];
    d.node(n, p.x, p.y, p.z);
    for (int k = 0; k < 2; ++k) d.node(far + k, p.x + 3 * k, p.y + 3, p.z + 200 + 10 * n);
    d.shell3(2, n, n, far, far + 1);
    nodes.push_back(n);
  }
  return d.group("/GRNOD/NODE/1", nodes).group("/SURF/PART/EXT/2", {cube ? 3 : 1});
}

double depth(const Built& b, std::int64_t node, std::int64_t inter = 1) {
  const PenetrationRow* row = b.row(b.contact(inter), node);
  return row == nullptr ? 0 : row->depth;
}

const std::vector<Place> over_shell = {{5, 5, 1.4},      {9.9, 5, 1.4}, {10.3, 5, 0.5},
                                       {10.3, 5, 1.3},   {5, 5, -1.4},  {10.8, 5, 0.2},
                                       {10.3, 10.4, 0.6}};

TEST(Type25, PlacesAroundASheet) {
  SmallDeck d = places(over_shell);
  d.add("@/INTER/TYPE25/1 surf_ID2=2 grnd_IDs=1 Inacti=5");
  d.add("@/INTER/TYPE25/2 surf_ID2=2 grnd_IDs=1 Inacti=5 Ishape=2");
  const Built b(d);
  const double square[] = {0.35, 0.35, 0.45, 0.3257359, 0.35, 0, 0.35};
  const double cylinder[] = {0.35, 0.0856683, 0.3571612, 0, 0.35, 0, 0.2268454};
  for (int i = 0; i < 7; ++i) {
    EXPECT_NEAR(depth(b, 101 + i, 1), square[i], 1e-7) << i;
    EXPECT_NEAR(depth(b, 101 + i, 2), cylinder[i], 1e-7) << i;
  }
  const Contact& c = b.contact();
  ASSERT_EQ(c.segment_kinds.size(), 2u);
  EXPECT_EQ(c.segment_kinds[1], SegmentKind::shell_opposite);
  EXPECT_EQ(b.ids(c.main[1].nodes), (std::array<std::int64_t, 4>{2, 1, 4, 3}));
  const PenetrationRow* below = b.row(c, 105);
  ASSERT_NE(below, nullptr);
  EXPECT_EQ(below->main, 1u) << "the mirrored segment sees what is below";
  EXPECT_DOUBLE_EQ(below->gap, 1.75);
}

TEST(Type24, PlacesAroundASheet) {
  SmallDeck d = places(over_shell);
  d.add("@/INTER/TYPE24/1 surf_ID2=2 grnd_IDs=1 Inacti=5");
  const Built b(d);
  const double expected[] = {0.35, 0.35, 0, 0, 0.35, 0, 0};
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(depth(b, 101 + i), expected[i], 1e-12) << i;
  EXPECT_DOUBLE_EQ(b.contact().largest_accepted, 0.875);
}

TEST(Modern, PlacesAroundACube) {
  SmallDeck d = places({{35, 5, 9.5}, {35, 5, 10.5}, {41, 5, 9.5}, {39.8, 5, 9.5}}, true);
  d.add("@/INTER/TYPE25/1 surf_ID2=2 grnd_IDs=1 Inacti=5");
  d.add("@/INTER/TYPE24/2 surf_ID2=2 grnd_IDs=1 Inacti=5");
  const Built b(d);
  const double of25[] = {1.25, 0, 0, 0.95}, of24[] = {1.25, 0.25, 0, 0.95};
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(depth(b, 101 + i, 1), of25[i], 1e-12) << i;
    EXPECT_NEAR(depth(b, 101 + i, 2), of24[i], 1e-12) << i;
  }
}

TEST(Modern, WhatATieHoldsIsNoInitialPenetrationWithIremI2) {
  SmallDeck d = places({{5, 5, 1.4}, {6, 5, 1.2}});
  d.group("/GRNOD/NODE/9", {101, 102});
  d.add("@/INTER/TYPE2/9 grnd_IDs=9 surf_IDm=2 Ignore=1 dsearch=1.3");  // reaches 102 alone
  d.add("@/INTER/TYPE25/1 surf_ID2=2 grnd_IDs=1 Inacti=5");
  d.add("@/INTER/TYPE25/2 surf_ID2=2 grnd_IDs=1 Inacti=5 Irem_i2=1000");
  d.add("@/INTER/TYPE24/3 surf_ID2=2 grnd_IDs=1 Inacti=5");
  for (const bool asked_for : {false, true}) {
    SceneOptions options;
    options.ties = asked_for;
    const Built b(d, options);
    using A = PenetrationAction;
    const auto action = [&](std::int64_t inter, std::int64_t node) {
      const PenetrationRow* row = b.row(b.contact(inter), node);
      return row == nullptr ? A::none : row->action;
    };
    EXPECT_EQ(action(1, 101), A::offset_stored) << "the tie does not reach it";
    EXPECT_EQ(action(1, 102), A::removed_tied);
    EXPECT_EQ(action(2, 102), A::offset_stored);
    EXPECT_EQ(action(3, 102), A::removed_tied);
    EXPECT_EQ(b.scene.ties.size(), asked_for ? 1u : 0u);
  }
}

TEST(Modern, InactiDecidesWhatIsStored) {
  SmallDeck d = places({{5, 5, 1.4}});
  int id = 0;
  for (const int type : {25, 24})
    for (const char* inacti : {"0", "5", "-1"})
      d.add("@/INTER/TYPE" + std::to_string(type) + "/" + std::to_string(++id) +
            " surf_ID2=2 grnd_IDs=1 Inacti=" + inacti);
  const Built b(d);
  using A = PenetrationAction;
  const A actions[] = {A::ignored, A::offset_stored, A::initial_force};
  const double of25[] = {0, 0.35, 0}, of24[] = {0, 0.35, 0.35};
  for (int i = 0; i < 3; ++i)
    for (const int type : {25, 24}) {
      const PenetrationRow* row = b.row(b.contact(i + (type == 25 ? 1 : 4)), 101);
      ASSERT_NE(row, nullptr);
      EXPECT_EQ(row->action, actions[i]);
      EXPECT_NEAR(row->p0, type == 25 ? of25[i] : of24[i], 1e-12) << type << " " << i;
    }
}

/// Two sheets over each other, quads cut into triangles here and there, warped at random.
SmallDeck sheets(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.6, 0.6);
  SmallDeck d;
  d.shell_part(1, 1.2).shell_part(2, 0.8);
  const int n = 6;
  for (int part = 1; part <= 2; ++part)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        d.node(1000 * part + (n + 1) * i + j, 3 * i + shift(random), 3 * j + shift(random),
               0.8 * part + shift(random));
  int id = 0;
  for (int part = 1; part <= 2; ++part)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int a = 1000 * part + (n + 1) * i + j, b = a + n + 1;
        if ((i + 2 * j) % 5 == 0)
          d.shell3(part, id + 1, a, b, b + 1).shell3(part, id + 2, a, b + 1, a + 1), id += 2;
        else
          d.shell(part, ++id, a, b, b + 1, a + 1);
      }
  return d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2}).group("/SURF/PART/3", {1, 2});
}

TEST(Type25, SearchFindsWhatAllPairsGive) {
  using namespace detail::modern;
  std::size_t found = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SmallDeck d = sheets(seed);
    d.add(seed % 2 == 0 ? "@/INTER/TYPE25/1 surf_ID1=1 surf_ID2=2 Inacti=5"
                        : "@/INTER/TYPE25/1 surf_ID1=3 Inacti=5 Ishape=2");
    const Built b(d);
    Connectivity connectivity(b.model);
    Scene scene;
    scene.coordinates = b.scene.coordinates;
    Diagnostics diagnostics;
    const SceneOptions options;
    detail::SceneContext context{b.model, connectivity, scene, diagnostics, options};
    const InterBase& inter = *b.interfaces.ordered.front();
    Sides s;
    s.set = settings_of(inter, {});
    make_sides(context, *b.model.selections, inter, s);
    set_gaps(context, s);
    set_stiffness(context, s);
    const Topology t(scene.coordinates, s, 1);
    const Found search = find_nodes25(context, s, t);
    std::size_t at = 0;
    for (std::uint32_t n = 0; n < s.nodes.size(); ++n) {
      double nearest = 0, p = 0;
      bool any = false;
      for (std::uint32_t f = 0; f < s.count(); ++f) {
        const Face face = s.face(f);
        const auto& corners = face.nodes;
        if (std::find(corners.begin(), corners.end(), s.nodes[n].node) != corners.end()) continue;
        if (!s.across(s.nodes[n].bits, face.bits)) continue;
        const double reach = s.nodes[n].gap + face.gap + s.margin;
        if (!(facet_distance_squared(scene.coordinates, face, s.nodes[n].node) < reach * reach))
          continue;
        const PairFigures pair = evaluate_pair(scene.coordinates, s, t, s.nodes[n], f);
        if (pair.excluded || pair.behind > 0) continue;
        if (any && pair.distance_squared > nearest) continue;
        any = true;
        nearest = pair.distance_squared;
        p = pair.penetration;
      }
      if (p == 0) continue;
      ASSERT_LT(at, search.penetrations.size()) << seed;
      EXPECT_EQ(search.penetrations[at].node, n) << seed;
      EXPECT_EQ(search.penetrations[at].penetration, p) << seed;
      ++at;
    }
    EXPECT_EQ(at, search.penetrations.size()) << seed;
    found += at;
  }
  EXPECT_GT(found, 300u) << "the scenes penetrate";
}

TEST(Type25, NeighboursAreMutualAndBordersFree) {
  SmallDeck d = sheets(5);
  d.add("@/INTER/TYPE25/1 surf_ID1=3");
  const Built b(d);
  using namespace detail::modern;
  Connectivity connectivity(b.model);
  Scene scene;
  scene.coordinates = b.scene.coordinates;
  Diagnostics diagnostics;
  const SceneOptions options;
  detail::SceneContext context{b.model, connectivity, scene, diagnostics, options};
  Sides s;
  s.set = settings_of(*b.interfaces.ordered.front(), {});
  make_sides(context, *b.model.selections, *b.interfaces.ordered.front(), s);
  const Topology t(scene.coordinates, s, 1);
  std::size_t free = 0;
  for (std::uint32_t i = 0; i < s.count(); ++i)
    for (std::uint32_t k = 0; k < 4; ++k) {
      if (s.nodes_of(i)[k] == s.nodes_of(i)[(k + 1) % 4]) continue;
      const Topology::Across j = t.across(i, k);
      if (j.free()) {
        ++free;
        continue;
      }
      const Topology::Across back = t.across(j.face, j.side);
      EXPECT_EQ(back.face, i);
      EXPECT_EQ(back.side, k);
    }
  EXPECT_EQ(free, 2u * 2u * 24u) << "24 sides of each sheet, front and back";
}

TEST(Type25, EdgesOfSheetsThatCross) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(5, 4, -3, 0.6).node(6, 5, -3, 0.6).node(7, 5, 3, 0.6).node(8, 4, 3, 0.6);
  d.shell_part(1, 1).shell_part(2, 1).shell(1, 1, 1, 2, 3, 4).shell(2, 2, 5, 6, 7, 8);
  d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2});
  d.add("@/INTER/TYPE25/1 surf_ID1=1 surf_ID2=2 Inacti=5 Iedge=2");
  d.add("@/INTER/TYPE25/2 surf_ID1=1 surf_ID2=2 Inacti=5");
  d.add("@/INTER/TYPE25/3 surf_ID1=1 surf_ID2=2 Inacti=5 Iedge=12");
  const Built b(d);
  const Contact& edges = b.contact(1, ContactRole::edges);
  EXPECT_EQ(edges.main_edges.size(), 8u);
  EXPECT_TRUE(edges.evaluated);
  for (const PenetrationRow& r : edges.penetrations) {
    EXPECT_DOUBLE_EQ(r.gap, 1);
    EXPECT_LE(r.depth, 0.4 + 1e-12);
  }
  EXPECT_FALSE(edges.penetrations.empty());
  for (const Contact& c : b.scene.contacts)
    EXPECT_TRUE(c.inter->id != 2 || c.role == ContactRole::primary) << "no edges without Iedge";
  EXPECT_TRUE(b.contact(3, ContactRole::edges).evaluated);
}

// A cube and a sheet whose first side comes through its top, 0.6 from the edge at x = 10, slanting.
TEST(Type25, EdgesThroughTheFacesOfSolids) {
  SmallDeck d;
  const double x[4] = {0, 10, 10, 0}, y[4] = {0, 0, 10, 10};
  for (int i = 0; i < 4; ++i) d.node(1 + i, x[i], y[i], 0).node(5 + i, x[i], y[i], 10);
  d.node(101, 9.8, 5, 8).node(102, 9, 5, 12).node(103, 9, 9, 12.5);
  d.solid_part(1).shell_part(2, 0.5).brick(1, 1, {1, 2, 3, 4, 5, 6, 7, 8});
  d.shell3(2, 2, 101, 102, 103);
  d.group("/SURF/PART/EXT/1", {1}).group("/SURF/PART/2", {2});
  d.add("@/INTER/TYPE25/1 surf_ID1=1 surf_ID2=2 Inacti=5 Iedge=11");
  d.add("@/INTER/TYPE25/2 surf_ID1=1 surf_ID2=2 Inacti=5 Iedge=1");
  d.add("@/INTER/TYPE25/3 surf_ID1=1 surf_ID2=2 Inacti=5 Iedge=11 Igap=2");
  const Built b(d);
  const Contact& edges = b.contact(1, ContactRole::edges);
  EXPECT_TRUE(edges.evaluated);
  int met = 0;
  for (const EdgeThroughSegment& e : edges.edges_through_segments) {
    const auto& nodes = edges.main_edges[e.edge].nodes;
    if (b.model.node_id(nodes[0]) != 101 || b.model.node_id(nodes[1]) != 102) continue;
    ++met;
    const auto& top = b.contact(1).main[e.main].nodes;
    const auto corner = [&](int k) {
      return b.model.node_id(top[static_cast<std::size_t>(k) % 4]);
    };
    EXPECT_EQ(std::min(corner(e.side - 1), corner(e.side)), 6);
    EXPECT_EQ(std::max(corner(e.side - 1), corner(e.side)), 7);
    EXPECT_NEAR(e.depth, 0.6 * 4 / std::sqrt(0.64 + 16), 1e-12);
  }
  EXPECT_EQ(met, 1) << "beside one side of one face";
  EXPECT_TRUE(b.contact(2, ContactRole::edges).edges_through_segments.empty());
  EXPECT_FALSE(b.contact(3, ContactRole::edges).evaluated) << "Igap 2 is left open";
}

TEST(Type25, SidesOfSolidsSheetsAndCoats) {
  SmallDeck d;
  const double x[4] = {0, 2, 2, 0}, y[4] = {0, 0, 2, 2};
  for (int i = 0; i < 4; ++i) d.node(1 + i, x[i], y[i], 0).node(5 + i, x[i], y[i], 2);
  d.solid_part(1).shell_part(2, 0.5).brick(1, 1, {1, 2, 3, 4, 5, 6, 7, 8});
  d.shell(2, 2, 5, 6, 7, 8);
  d.group("/SURF/PART/EXT/1", {1}).group("/SURF/PART/2", {2});
  d.add("@/INTER/TYPE25/1 surf_ID1=1").add("@/INTER/TYPE25/2 surf_ID1=2");
  d.add("@/INTER/TYPE24/3 surf_ID1=2");
  const Built b(d);
  const Contact& solids = b.contact(1);
  EXPECT_EQ(solids.main.size(), 6u);
  for (const SegmentKind k : solids.segment_kinds) EXPECT_EQ(k, SegmentKind::solid);
  for (const MainSegment& m : solids.main) EXPECT_EQ(m.gap, 0);
  const MainSegment* top = b.main(solids, {5, 6, 7, 8});
  ASSERT_NE(top, nullptr);
  EXPECT_NEAR(top->stiffness, 16 * (500.0 / 3) / 8, 1e-9)
      << "S^2 B / V, more than E t of the shell";
  const Contact& coat = b.contact(2);
  EXPECT_EQ(coat.segment_kinds,
            (std::vector<SegmentKind>{SegmentKind::coat, SegmentKind::coat_opposite}));
  EXPECT_DOUBLE_EQ(coat.main[0].gap, 0.25);
  EXPECT_NEAR(coat.main[1].stiffness, 200 * 0.5, 1e-9) << "the opposite has the shell's";
  EXPECT_EQ(b.contact(3).segment_kinds, (std::vector<SegmentKind>{SegmentKind::coat}));
}

// Three bricks have the nodes 5 to 8. The solver sorts the segments, and merges the two on these.
TEST(Type25, SegmentsInMoreThanTwoSolidsAreNamedAtTheirPlaceInTheSortedList) {
  SmallDeck d;
  const double x[4] = {0, 2, 2, 0}, y[4] = {0, 0, 2, 2};
  for (int i = 0; i < 4; ++i)
    for (int level = 0; level < 3; ++level) d.node(1 + 4 * level + i, x[i], y[i], 2 * level);
  d.solid_part(1);
  d.brick(1, 1, {1, 2, 3, 4, 5, 6, 7, 8}).brick(1, 2, {5, 6, 7, 8, 9, 10, 11, 12});
  d.brick(1, 3, {5, 6, 7, 8, 9, 10, 11, 12});
  d.segments("/SURF/SEG/1", {{9, 10, 11, 12}, {5, 6, 7, 8}, {1, 2, 3, 4}, {8, 7, 6, 5}});
  d.add("@/INTER/TYPE25/1 surf_ID1=1").add("@/INTER/TYPE24/2 surf_ID1=1");
  const Built b(d);
  const Contact& sorted = b.contact(1);
  ASSERT_EQ(sorted.main.size(), 3u);
  ASSERT_EQ(sorted.crowded.size(), 1u);
  auto nodes = b.ids(sorted.main[sorted.crowded[0]].nodes);
  std::sort(nodes.begin(), nodes.end());
  EXPECT_EQ(nodes, (std::array<std::int64_t, 4>{5, 6, 7, 8}));
  EXPECT_EQ(b.contact(2).crowded, (std::vector<std::uint32_t>{1, 3})) << "those of a TYPE24 stay";
}

TEST(Type25, GapZeroOnBordersTakesTheLastSideOfTrianglesForOne) {
  SmallDeck d;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) d.node(1 + 5 * i + j, i, j, 0);
  d.shell_part(1, 1);
  int id = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const int a = 1 + 5 * i + j, b = a + 5;
      if (i == 2 && j == 2)
        d.shell3(1, id + 1, a, b, b + 1).shell3(1, id + 2, a, b + 1, a + 1), id += 2;
      else
        d.shell(1, ++id, a, b, b + 1, a + 1);
    }
  d.group("/SURF/PART/1", {1}).add("@/INTER/TYPE25/1 surf_ID1=1 Igap0=1");
  const Built b(d);
  const auto gap = [&](int i, int j) { return b.secondary(b.contact(), 1 + 5 * i + j)->gap; };
  EXPECT_EQ(gap(0, 2), 0);
  EXPECT_EQ(gap(1, 1), 0.5);
  EXPECT_EQ(gap(2, 1), 0.5);
  EXPECT_EQ(gap(2, 2), 0) << "the second triangle has its last side from 2 3 to 2 2";
  EXPECT_EQ(gap(2, 3), 0);
}

}  // namespace
}  // namespace deck::test
