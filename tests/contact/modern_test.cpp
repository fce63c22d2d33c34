// TYPE24 and TYPE25: the worked places of a shell and a cube, sides and gaps, edges,
// what is left open, and the search against looking at all pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "contact/meshes.hpp"
#include "contact/shared/closest.hpp"
#include "contact/type24_25/patch_rule.hpp"
#include "contact/type24_25/type24_25.hpp"

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
  d.shell_part(1, 2).shell_part(2, 1.5).solid_part(3).shell(1, 1, 1, 2, 3, 4);
  add_brick(d, 3, 3, 11, {30, 0, 0}, {10, 10, 10});
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

/// Places around the shell with the penetrations of the worked example: Ishape 1 and 2.
struct WorkedPlace {
  Place at;
  double square, cylinder;
};
const WorkedPlace worked[] = {{{5, 5, 1.4}, 0.35, 0.35},           {{9.9, 5, 1.4}, 0.35, 0.0856683},
                              {{10.3, 5, 0.5}, 0.45, 0.3571612},   {{10.3, 5, 1.3}, 0.3257359, 0},
                              {{5, 5, -1.4}, 0.35, 0.35},          {{10.8, 5, 0.2}, 0, 0},
                              {{10.3, 10.4, 0.6}, 0.35, 0.2268454}};

/// The penetration of a node with gap `gs` at (x, y, z) into a lone square sheet of 10 by 10 in
/// z = 0 with gap `gm`: specification A11 for four free sides, in closed form.
double into_lone_square(double x, double y, double z, double gs, double gm, int shape) {
  const double g = gs + gm, up = std::abs(z);
  const auto clamped = [](double v) { return std::clamp(v, 0.0, 10.0); };
  const double beside = std::hypot(x - clamped(x), y - clamped(y));
  const double raw = std::max(0.0, g - std::hypot(beside, up));
  // The side of the facet around the middle in which the foot lies, and how far it is beyond it.
  const bool by_x = std::abs(x - 5) > std::abs(y - 5);
  double over = std::abs(by_x ? x - 5 : y - 5) - 5;
  if (over >= gs || raw == 0) return 0;
  if (shape == 2) {
    over -= gs;
    if (!(over < 0 && g + over > 0)) return raw;
    // A cylinder of radius g about a line g + over inside of the foot.
    return std::max(0.0, g - std::hypot(g + over, up));
  }
  if (over > 0 && up > gm) return std::max(0.0, gs - std::hypot(beside, up - gm));
  over -= gs;
  if (g + over <= 0) return raw;
  return up < g + over ? -over : std::max(0.0, g - up);
}

TEST(Type25, PlacesAroundASheetAreThoseOfTheClosedForm) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> along(-1.2, 11.2), up(-1.9, 1.9);
  std::vector<Place> list;
  for (const WorkedPlace& w : worked) list.push_back(w.at);
  for (int k = 0; k < 400; ++k) {
    Place p{along(random), along(random), up(random)};
    // Most of them near a side.
    if (k % 4 == 1) p.x = 10 + 0.5 * up(random);
    if (k % 4 == 3) p.y = 0.5 * up(random);
    list.push_back(p);
  }
  SmallDeck d = places(list);
  d.add("@/INTER/TYPE25/1 surf_ID2=2 grnd_IDs=1 Inacti=5");
  d.add("@/INTER/TYPE25/2 surf_ID2=2 grnd_IDs=1 Inacti=5 Ishape=2");
  const Built b(d);
  SceneOptions exactly;
  exactly.accuracy = Accuracy::exact;
  const Built exact(d, exactly);
  EXPECT_GT(exact.scene.decisions.exact, 0u);
  for (const int shape : {1, 2}) {
    std::size_t found = 0;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const Place& p = list[k];
      const double wanted = into_lone_square(p.x, p.y, p.z, 0.75, 1, shape);
      EXPECT_NEAR(depth(b, 101 + static_cast<int>(k), shape), wanted, 1e-9)
          << shape << ": " << p.x << ' ' << p.y << ' ' << p.z;
      EXPECT_NEAR(depth(exact, 101 + static_cast<int>(k), shape), wanted, 1e-7) << k;
      found += wanted > 0;
      if (k >= std::size(worked)) continue;
      EXPECT_NEAR(wanted, shape == 1 ? worked[k].square : worked[k].cylinder, 1e-7) << k;
    }
    EXPECT_GT(found, 150u);
  }
  const Contact& c = b.contact();
  EXPECT_EQ(c.segment_kinds.at(1), SegmentKind::shell_opposite);
  EXPECT_EQ(b.ids(c.main.at(1).nodes), (std::array<std::int64_t, 4>{2, 1, 4, 3}));
  EXPECT_EQ(b.row(c, 105)->main, 1u) << "the mirrored segment sees what is below";
}

TEST(Type25, RandomPlacesAroundATriangleAreThoseOfTheClosedForm) {
  // With three free sides a node beyond one of them by its own gap is left out; elsewhere it is the
  // gap less the distance: the side that is farthest away corrects nothing.
  const double corner[][2] = {{0, 0}, {10, 0}, {2, 9}};
  std::mt19937 random(11);
  std::uniform_real_distribution<double> x(-1.5, 11), y(-1.5, 10), up(-1.9, 1.9);
  std::vector<Place> list;
  for (int k = 0; k < 400; ++k) list.push_back({x(random), y(random), up(random)});
  SmallDeck d = places(list);
  d.node(21, 0, 0, 0).node(22, 10, 0, 0).node(23, 2, 9, 0).shell_part(9, 2);
  d.shell3(9, 9, 21, 22, 23).group("/SURF/PART/9", {9});
  d.add("@/INTER/TYPE25/1 surf_ID2=9 grnd_IDs=1 Inacti=5");
  d.add("@/INTER/TYPE25/2 surf_ID2=9 grnd_IDs=1 Inacti=5 Ishape=2");
  const Built b(d);
  std::size_t found = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Place& p = list[k];
    double most_over = -1e30, flat = 1e30;
    for (int side = 0; side < 3; ++side) {
      const double *a = corner[side], *c = corner[(side + 1) % 3];
      const double ex = c[0] - a[0], ey = c[1] - a[1], length = std::hypot(ex, ey);
      const double px = p.x - a[0], py = p.y - a[1];
      most_over = std::max(most_over, (px * ey - py * ex) / length);
      const double u = std::clamp((px * ex + py * ey) / (length * length), 0.0, 1.0);
      flat = std::min(flat, std::hypot(px - u * ex, py - u * ey));
    }
    if (most_over <= 0) flat = 0;
    const double raw = std::max(0.0, 1.75 - std::hypot(flat, p.z));
    const double wanted = most_over >= 0.75 ? 0 : raw;
    for (const int shape : {1, 2})
      EXPECT_NEAR(depth(b, 101 + static_cast<int>(k), shape), wanted, 1e-9)
          << shape << ": " << p.x << ' ' << p.y << ' ' << p.z;
    found += wanted > 0;
  }
  EXPECT_GT(found, 100u);
}

TEST(Type25, RandomPlacesInACubeAreAsDeepAsTheNearestFaceIsFarWithinReach) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> in(-2, 12);
  std::vector<Place> list;
  for (int k = 0; k < 200; ++k) list.push_back({30 + in(random), in(random), in(random)});
  SmallDeck d = places(list, true);
  d.add("@/INTER/TYPE25/1 surf_ID2=2 grnd_IDs=1 Inacti=5");
  const Built b(d);
  std::size_t inside = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Place& p = list[k];
    const double far = std::min({p.x - 30, 40 - p.x, p.y, 10 - p.y, p.z, 10 - p.z});
    // PairConsidered for as far as the gap and a fifth of the mean side.
    const bool found = far > 0 && far < 0.75 + 2;
    EXPECT_NEAR(depth(b, 101 + static_cast<int>(k)), found ? 0.75 + far : 0, 1e-9)
        << p.x << ' ' << p.y << ' ' << p.z;
    inside += found;
  }
  EXPECT_GT(inside, 40u);
}

TEST(Type24, RandomPlacesAroundASheetAreThoseOfTheClosedForm) {
  // Specification B6 for a flat square: the gap less the height within the square, nothing beside
  // it; with Inacti up to half of the largest gaps of both sides.
  std::mt19937 random(9);
  std::uniform_real_distribution<double> along(-1, 11), up(-2, 2);
  std::vector<Place> list;
  for (int k = 0; k < 200; ++k) list.push_back({along(random), along(random), up(random)});
  SmallDeck d = places(list);
  d.add("@/INTER/TYPE24/1 surf_ID2=2 grnd_IDs=1 Inacti=5");
  d.add("@/INTER/TYPE24/2 surf_ID2=2 grnd_IDs=1 Inacti=0");
  d.add("@/INTER/TYPE24/3 surf_ID2=2 grnd_IDs=1 Inacti=5 Ipen_max=1.25");
  const Built b(d);
  const double accepted[] = {0.875, 1e30, 1.25};
  for (int id = 1; id <= 3; ++id) {
    std::size_t found = 0;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const Place& p = list[k];
      const bool within = p.x > 0 && p.x < 10 && p.y > 0 && p.y < 10;
      const double deep = std::max(0.0, 1.75 - std::abs(p.z));
      const double wanted = within && deep <= accepted[id - 1] ? deep : 0;
      EXPECT_NEAR(depth(b, 101 + static_cast<int>(k), id), wanted, 1e-9)
          << id << ": " << p.x << ' ' << p.y << ' ' << p.z;
      found += wanted > 0;
    }
    EXPECT_GT(found, 40u);
  }
}

TEST(Type24, PlacesAroundACube) {
  SmallDeck d = places({{35, 5, 9.5}, {35, 5, 10.5}, {41, 5, 9.5}, {39.8, 5, 9.5}}, true);
  const Built b(d.add("@/INTER/TYPE24/1 surf_ID2=2 grnd_IDs=1 Inacti=5"));
  const double wanted[] = {1.25, 0.25, 0, 0.95};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(depth(b, 101 + i), wanted[i], 1e-12) << i;
}

TEST(Modern, WhatATieHoldsIsNoInitialPenetrationWithIremI2) {
  SmallDeck d = places({{5, 5, 1.4}, {6, 5, 1.2}});
  d.group("/GRNOD/NODE/9", {101, 102});
  d.add("@/INTER/TYPE2/9 grnd_IDs=9 surf_IDm=2 Ignore=1 dsearch=1.3");  // reaches 102 alone
  d.add("@/INTER/TYPE25/1 surf_ID2=2 grnd_IDs=1 Inacti=5");
  d.add("@/INTER/TYPE25/2 surf_ID2=2 grnd_IDs=1 Inacti=5 Irem_i2=1000");
  d.add("@/INTER/TYPE24/3 surf_ID2=2 grnd_IDs=1 Inacti=5");
  using A = PenetrationAction;
  for (const bool asked_for : {false, true}) {
    SceneOptions options;
    options.ties = asked_for;
    const Built b(d, options);
    const auto action = [&](std::int64_t inter, std::int64_t node) {
      return b.row(b.contact(inter), node)->action;
    };
    EXPECT_EQ(action(1, 101), A::offset_stored) << "the tie does not reach it";
    EXPECT_EQ(action(1, 102), A::removed_tied);
    EXPECT_EQ(action(2, 102), A::offset_stored);
    EXPECT_EQ(action(3, 102), A::removed_tied);
    EXPECT_EQ(b.scene.ties.size(), asked_for ? 1u : 0u);
  }
}

/// A sheet of 4 by 4 squares where `has(i, j)`: node 1 + 5 i + j at (step i, step j).
template <class Has>
SmallDeck grid(double step, double thickness, const Has& has) {
  SmallDeck d;
  const auto place = [&](int j, int i) { return std::array{step * i, step * j, 0.0}; };
  add_grid(d, 1, 4, 4, place, [&](int j, int i, const Corners4& n) {
    if (has(i, j)) d.shell(1, 1 + 4 * i + j, n[0], n[3], n[2], n[1]);
  });
  return d.shell_part(1, thickness).group("/SURF/PART/1", {1});
}

/// Two sheets over each other, quads cut into triangles here and there, warped at random.
SmallDeck sheets(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.6, 0.6);
  SmallDeck d;
  d.shell_part(1, 1.2).shell_part(2, 0.8);
  int id = 1;
  for (int part = 1; part <= 2; ++part) {
    const auto place = [&](int j, int i) {
      const double z = shift(random), y = shift(random), x = shift(random);
      return std::array{3 * i + x, 3 * j + y, 0.8 * part + z};
    };
    add_grid(d, 1000 * part, 6, 6, place, [&](int j, int i, const Corners4& n) {
      if ((i + 2 * j) % 5 == 0)
        add_two_triangles(d, part, id, {n[0], n[3], n[2], n[1]});
      else
        d.shell(part, id, n[0], n[3], n[2], n[1]);
      id += 2;
    });
  }
  return d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2}).group("/SURF/PART/3", {1, 2});
}

/// Two stacks of bricks, the second's corner in the first, and a bent strip of shells through both.
SmallDeck blocks(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  SmallDeck d;
  d.solid_part(1).solid_part(2).shell_part(3, 0.4);
  for (int part = 1; part <= 2; ++part)
    add_box(d, part, 1000 * part, {2, 2, 2}, [&](int i, int j, int k) {
      return std::array{2 * i + 1.7 * (part - 1) + shift(random),
                        2 * j + 1.3 * (part - 1) + shift(random),
                        2 * k + 3.6 * (part - 1) + shift(random)};
    });
  add_sheet(d, 3, 3000, 3000, 1, 4, [&](int j, int i) {
    return std::array{3.1 + shift(random), 2.2 + j + shift(random), 1 + 1.5 * i};
  });
  d.group("/SURF/PART/EXT/1", {1}).group("/SURF/PART/EXT/2", {2, 3});
  return d.group("/SURF/PART/EXT/3", {1, 2, 3});
}

/// The two sides of the first interface of a deck, as a search gets them.
struct Laid {
  explicit Laid(const SmallDeck& d) : built(d), connectivity(built.model) {
    using namespace detail::type24_25;
    const InterBase& inter = *built.interfaces.ordered.front();
    scene.coordinates = built.scene.coordinates;
    s.set = settings_of(inter, {});
    make_sides(context, *built.model.selections, inter, s);
    set_gaps(context, s);
    set_stiffness(context, s);
    topology.emplace(scene.coordinates, s);
  }
  bool has(const detail::type24_25::Quad& nodes, NodeIndex n) const {
    return std::find(nodes.begin(), nodes.end(), n) != nodes.end();
  }
  /// The part of the first brick at a node, and whether such a brick has a node of the segment.
  std::uint32_t solid_at(NodeIndex n, const detail::type24_25::Quad& segment, bool& shares) {
    const auto around = connectivity.elements(ElementKind::solid8, n);
    shares = false;
    for (const std::uint32_t e : around)
      for (int k = 0; k < 8; ++k) shares = shares || has(segment, built.model.solid8.of(e)[k]);
    return around.empty() ? no_index : built.model.solid8.part[around.front()];
  }

  Built built;
  Connectivity connectivity;
  Scene scene;
  Findings findings;
  SceneOptions options;
  detail::SceneContext context{built.model, connectivity, scene, findings, options};
  detail::type24_25::Sides s;
  std::optional<detail::type24_25::Topology> topology;
};

/// Nodes with their penetration.
using Depths = std::vector<std::pair<std::uint32_t, double>>;
Depths depths(const detail::type24_25::NodeSearch& found) {
  Depths out;
  for (const auto& p : found.penetrations) out.emplace_back(p.node, p.penetration);
  return out;
}

// The same scenes, with two surfaces and with one.
const char* const cards[] = {" surf_ID1=1 surf_ID2=2", " surf_ID1=3"};

Depths all_pairs25(Laid& l) {
  using namespace detail::type24_25;
  const Coordinates& x = l.scene.coordinates;
  const Sides& s = l.s;
  Depths out;
  for (std::uint32_t n = 0; n < s.nodes.size(); ++n) {
    double nearest = 0, p = 0;
    bool any = false;
    const NodeIndex node = s.nodes[n].node;
    for (std::uint32_t f = 0; f < s.count(); ++f) {
      const Face face = s.face(f);
      bool shares = false;
      if (l.has(face.nodes, node) || !s.across(s.nodes[n].bits, face.bits)) continue;
      const std::uint32_t part = l.solid_at(node, face.nodes, shares);
      if (face.solid != no_index && part == l.built.model.solid8.part[face.solid]) continue;
      const double reach = s.nodes[n].gap + face.gap + s.margin;
      if (!(facet_distance_squared(x, face, node) < reach * reach)) continue;
      const PairFigures pair = evaluate_pair(x, s, *l.topology, s.nodes[n], f);
      if (face.sheet() ? pair.excluded || pair.behind > 0
                       : pair.excluded && face.kind == SegmentKind::coat)
        continue;
      if (any && pair.distance_squared > nearest) continue;
      any = true;
      nearest = pair.distance_squared;
      p = pair.penetration;
    }
    if (p != 0) out.emplace_back(n, p);
  }
  return out;
}

// Inacti 0: the solver looks no farther behind solids than before sheets.
TEST(Type25, SearchFindsWhatAllPairsGive) {
  std::size_t found = 0;
  for (unsigned seed = 1; seed <= 12; ++seed)
    for (const bool solid : {false, true}) {
      SmallDeck d = solid ? blocks(seed) : sheets(seed);
      const std::string shape = seed % 4 < 2 ? " Ishape=2" : "";
      d.add("@/INTER/TYPE25/1" + std::string(cards[seed % 2]) + (solid ? "" : " Inacti=5") + shape);
      Laid l(d);
      const Depths all = all_pairs25(l);
      EXPECT_EQ(depths(find_nodes25(l.context, l.s, *l.topology)), all) << seed << solid;
      found += all.size();
    }
  EXPECT_GT(found, 400u) << "the scenes penetrate";
}

/// Parts of nodes: of the last shell, or else of the last solid segment.
std::vector<std::uint32_t> part_tags(const Laid& l) {
  const Model& m = l.built.model;
  std::vector<std::uint32_t> out(m.nodes.size(), no_index);
  for (const Elements* family : {&m.shell4, &m.shell3})
    for (std::uint32_t e = 0; e < family->size(); ++e)
      for (int k = 0; k < family->width; ++k) out[family->of(e)[k]] = family->part[e];
  for (const auto& f : l.s.faces)
    if (f.kind == SegmentKind::solid)
      for (const NodeIndex n : f.nodes) out[n] = m.solid8.part[f.solid];
  return out;
}

/// `accepted`: the deepest penetration that counts.
Depths all_pairs24(Laid& l, double accepted) {
  using namespace detail::type24_25;
  const Coordinates& x = l.scene.coordinates;
  const Sides& s = l.s;
  const std::vector<std::uint32_t> tags = part_tags(l);
  const bool ignored = s.set.inacti == 0;
  Depths out;
  for (std::uint32_t n = 0; n < s.nodes.size(); ++n) {
    const SideNode& node = s.nodes[n];
    std::vector<PatchRule> rules;
    for (std::uint32_t f = 0; f < s.count(); ++f) {
      const Face face = s.face(f);
      if (l.has(face.nodes, node.node) || !s.across(node.bits, face.bits)) continue;
      PatchRule r;
      r.node = detail::at(x, node.node);
      Vec low = detail::at(x, face.nodes[0]), high = low;
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec c = r.corner[k] = detail::at(x, face.nodes[k]);
        low = {std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z)};
        high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
      }
      const double by = s.margin + node.gap + face.gap;
      if (r.node.x < low.x - by || r.node.x > high.x + by || r.node.y < low.y - by ||
          r.node.y > high.y + by || r.node.z < low.z - by || r.node.z > high.z + by)
        continue;
      r.solid = face.kind == SegmentKind::solid;
      r.node_gap = node.gap;
      r.segment_gap = face.gap;
      r.accepted = accepted;
      r.limit = ignored ? face.length : accepted;
      bool shares = false;
      l.solid_at(node.node, face.nodes, shares);
      r.own_solid = r.solid && shares;
      const std::uint32_t part =
          r.solid ? l.built.model.solid8.part[face.solid] : tags[face.nodes[0]];
      r.rejects_part = !ignored && part == tags[node.node];
      r.never_blocks = ignored || part == tags[node.node];
      rules.push_back(r);
    }
    const PatchChoice chosen = choose_pair(rules, !ignored, false);
    if (chosen.penetrates) out.emplace_back(n, chosen.figures.result.penetration);
  }
  return out;
}

TEST(Type24, SearchFindsWhatAllPairsGive) {
  std::size_t found = 0;
  for (unsigned seed = 1; seed <= 12; ++seed)
    for (const bool solid : {false, true}) {
      SmallDeck d = solid ? blocks(seed) : sheets(seed);
      d.add("@/INTER/TYPE24/1" + std::string(cards[seed % 2]) + (solid ? "" : " Inacti=5"));
      Laid l(d);
      const auto search = find_nodes24(l.context, l.s);
      const Depths all = all_pairs24(l, search.largest_accepted);
      EXPECT_EQ(depths(search), all) << seed << solid;
      found += all.size();
    }
  EXPECT_GT(found, 200u) << "the scenes penetrate";
}

TEST(Modern, AStrayNodeCostsFewExactDecisionsPerNode) {
  const auto at = [](int i, int j) { return std::array{i * j == 49 ? 1e6 : 10. * i, 10. * j, 0.}; };
  for (const std::string type : {"24", "25"}) {
    SmallDeck d;
    add_sheet(d.shell_part(1, 2).group("/SURF/PART/EXT/1", {1}), 1, 1, 1, 20, 20, at);
    const Built b(d.add("@/INTER/TYPE" + type + "/1 surf_ID1=1"));
    const std::uint64_t exact = b.scene.decisions.exact;
    EXPECT_TRUE(exact > 0 && exact < 20 * 441) << type << ": " << exact;
  }
}

TEST(Type25, SearchOfEdgesFindsWhatAllPairsGive) {
  using namespace detail::type24_25;
  std::size_t found = 0, through = 0;
  for (unsigned seed = 1; seed <= 12; ++seed)
    for (const bool solid : {false, true}) {
      SmallDeck d = solid ? blocks(seed) : sheets(seed);
      d.add("@/INTER/TYPE25/1" + std::string(cards[seed % 2]) + " Inacti=5 Iedge=22" +
            (seed % 4 < 2 ? " Igap0=1" : "") + (seed % 3 == 0 ? " Igap=3" : ""));
      Laid l(d);
      const Coordinates& x = l.scene.coordinates;
      const std::vector<SideEdge> edges = make_edges(l.context, l.s, *l.topology);
      std::vector<std::array<std::uint32_t, 2>> all, got;
      const auto ids = [&](const SideEdge& e) {
        return std::pair(l.built.model.node_id(e.nodes[0]), l.built.model.node_id(e.nodes[1]));
      };
      for (std::uint32_t a = 0; a < edges.size(); ++a)
        for (std::uint32_t b = 0; b < edges.size(); ++b) {
          const SideEdge &s = edges[a], &m = edges[b];
          const bool common = s.nodes[0] == m.nodes[0] || s.nodes[0] == m.nodes[1] ||
                              s.nodes[1] == m.nodes[0] || s.nodes[1] == m.nodes[1];
          if (common || m.kind < 2 || s.kind < 1 || !l.s.across(s.bits, m.bits)) continue;
          if (s.kind >= 2 && !(ids(m) > ids(s))) continue;
          if (evaluate_edges(edge_rule(x, l.s, *l.topology, s, m), false).penetration > 0)
            all.push_back({a, b});
        }
      std::vector<EdgePenetration> penetrations;
      DecisionReport decisions;
      EXPECT_TRUE(find_edges25(l.context, l.s, *l.topology, edges, penetrations, decisions));
      for (const EdgePenetration& p : penetrations) got.push_back({p.secondary, p.main});
      EXPECT_EQ(got, all) << seed << solid;
      found += all.size();

      std::vector<std::array<std::uint32_t, 3>> all_through, got_through;
      for (std::uint32_t e = 0; e < edges.size(); ++e)
        for (std::uint32_t f = 0; f < l.s.faces.size(); ++f) {
          const Face& face = l.s.faces[f];
          if (face.kind != SegmentKind::solid || face.interior || edges[e].kind < 1) continue;
          if (!l.s.across(edges[e].bits, face.bits) || l.has(face.nodes, edges[e].nodes[0]) ||
              l.has(face.nodes, edges[e].nodes[1]))
            continue;
          for (std::uint32_t k = 0; k < (face.triangle() ? 1u : 4u); ++k)
            if (evaluate_through(through_rule(x, l.s, *l.topology, edges[e], f, k)).passes)
              all_through.push_back({e, f, k + 1});
        }
      for (const EdgeThroughSegment& t :
           edges_through_solids(l.context, l.s, *l.topology, edges, decisions))
        got_through.push_back({t.edge, t.main, static_cast<std::uint32_t>(t.side)});
      EXPECT_EQ(got_through, all_through) << seed << solid;
      through += all_through.size();
    }
  EXPECT_GT(found, 200u) << "edges of sheets penetrate";
  EXPECT_GT(through, 20u) << "edges pass through solids";
}

TEST(Type25, NeighboursAreMutualAndBordersFree) {
  SmallDeck d = sheets(5);
  d.add("@/INTER/TYPE25/1 surf_ID1=3");
  const Laid l(d);
  using namespace detail::type24_25;
  const Sides& s = l.s;
  const Topology& t = *l.topology;
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

// A cube and a sheet whose first side comes through its top, 0.6 from the edge at x = 10, slanting.
TEST(Type25, EdgesThroughTheFacesOfSolids) {
  SmallDeck d;
  d.solid_part(1).shell_part(2, 0.5);
  add_brick(d, 1, 1, 1, {0, 0, 0}, {10, 10, 10});
  d.node(101, 9.8, 5, 8).node(102, 9, 5, 12).node(103, 9, 9, 12.5).shell3(2, 2, 101, 102, 103);
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
  add_brick(d, 1, 1, 1, {0, 0, 0}, {2, 2, 2});
  d.solid_part(1).shell_part(2, 0.5).shell(2, 2, 5, 6, 7, 8);
  d.group("/SURF/PART/EXT/1", {1}).group("/SURF/PART/2", {2});
  d.add("@/INTER/TYPE25/1 surf_ID1=1").add("@/INTER/TYPE25/2 surf_ID1=2");
  d.add("@/INTER/TYPE24/3 surf_ID1=2");
  const Built b(d);
  const Contact &solids = b.contact(1), &coat = b.contact(2);
  using K = SegmentKind;
  EXPECT_EQ(solids.segment_kinds, std::vector<K>(6, K::solid));
  for (const MainSegment& m : solids.main) EXPECT_EQ(m.gap, 0);
  EXPECT_NEAR(b.main(solids, {5, 6, 7, 8})->stiffness, 16 * (500.0 / 3) / 8, 1e-9)
      << "S^2 B / V, more than E t of the shell";
  EXPECT_EQ(coat.segment_kinds, (std::vector<K>{K::coat, K::coat_opposite}));
  EXPECT_DOUBLE_EQ(coat.main[0].gap, 0.25);
  EXPECT_NEAR(coat.main[1].stiffness, 200 * 0.5, 1e-9) << "the opposite has the shell's";
  EXPECT_EQ(b.contact(3).segment_kinds, (std::vector<K>{K::coat}));
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
  SmallDeck d = grid(1, 1, [](int i, int j) { return i != 2 || j != 2; });
  d.shell3(1, 21, 13, 18, 19).shell3(1, 22, 13, 19, 14);
  d.add("@/INTER/TYPE25/1 surf_ID1=1 Igap0=1");
  const Built b(d);
  const auto gap = [&](int i, int j) { return b.secondary(b.contact(), 1 + 5 * i + j)->gap; };
  for (const auto& [i, j] : {std::pair(0, 2), {2, 2}, {2, 3}})
    EXPECT_EQ(gap(i, j), 0) << "the second triangle has its last side from 2 3 to 2 2";
  for (const auto& [i, j] : {std::pair(1, 1), {2, 1}}) EXPECT_EQ(gap(i, j), 0.5);
}

/// A node of no mesh that is put where a test wants it, over the segments of a scene.
class Probe {
 public:
  static constexpr double slack = 1e-11;  ///< far above the round-off of places up to 20

  explicit Probe(Laid& l) : l_(l) {
    for (auto* axis : {&l.scene.coordinates.x, &l.scene.coordinates.y, &l.scene.coordinates.z})
      axis->push_back(0);
    node.node = static_cast<NodeIndex>(l.scene.coordinates.x.size() - 1);
  }
  void put(const Vec& p) {
    Coordinates& x = l_.scene.coordinates;
    std::tie(x.x[node.node], x.y[node.node], x.z[node.node]) = std::tie(p.x, p.y, p.z);
  }
  Vec corner(std::uint32_t face, std::size_t k) const {
    return detail::at(l_.scene.coordinates, l_.s.nodes_of(face)[k % 4]);
  }
  /// A place near a segment: over it, beside its sides and corners.
  Vec near(std::uint32_t face, std::mt19937& random) const {
    std::uniform_real_distribution<double> along(-0.25, 1.25), up(-1.6, 1.6);
    const double r = along(random), s = along(random);
    const Vec low = (1 - r) * corner(face, 0) + r * corner(face, 1);
    const Vec high = (1 - r) * corner(face, 3) + r * corner(face, 2);
    const Vec normal =
        unit(cross(corner(face, 2) - corner(face, 0), corner(face, 3) - corner(face, 1)));
    return (1 - s) * low + s * high + up(random) * normal;
  }
  detail::type24_25::PairFigures figures(std::uint32_t face, double by = -1) const {
    return evaluate_pair(l_.scene.coordinates, l_.s, *l_.topology, node, face,
                         detail::type24_25::all_facets, by);
  }
  bool left_out(std::uint32_t face, const detail::type24_25::PairFigures& p) const {
    const detail::type24_25::Face f = l_.s.face(face);
    return (f.sheet() && p.behind > 0) || (p.excluded && f.kind != SegmentKind::solid);
  }
  /// Holds what is not in doubt against exact arithmetic. True: it is in doubt.
  bool expect_exact(std::uint32_t face, bool depth_too) {
    const auto p = figures(face, slack);
    if (p.doubtful) return true;
    const std::array rules{facet_rule(l_.scene.coordinates, l_.s, *l_.topology, node, face)};
    const auto exact = detail::type24_25::exact_choice(rules, p.penetration > 0);
    EXPECT_EQ(!exact, left_out(face, p)) << face;
    if (!exact || left_out(face, p)) return false;
    EXPECT_EQ(exact->penetrates, p.penetration > 0) << face;
    if (p.other_facets) return false;
    EXPECT_NEAR(exact->distance, std::sqrt(p.distance_squared), 1e-9);
    EXPECT_NEAR(exact->gap, p.gap, 1e-9);
    if (depth_too) {
      EXPECT_NEAR(exact->depth, p.penetration, 1e-9);
    }
    return false;
  }

  detail::type24_25::SideNode node;

 private:
  Laid& l_;
};

/// Sheets and blocks, half with coats, with uneven and limited gaps, and both shapes of borders.
struct ProbedScene {
  explicit ProbedScene(unsigned seed)
      : random(seed), l(deck_of(seed)), probe(l), solid(seed % 2 == 1) {
    std::uniform_real_distribution<double> gap(0.3, 0.9);
    if (seed % 4 < 2)
      for (double& g : l.s.main_gap) g = gap(random);
    for (std::uint32_t i = 0; solid && i < l.s.faces.size(); i += 3)
      if (l.s.faces[i].kind == SegmentKind::solid) l.s.faces[i].kind = SegmentKind::coat;
  }
  static SmallDeck deck_of(unsigned seed) {
    SmallDeck d = seed % 2 == 1 ? blocks(seed) : sheets(seed);
    return d.add("@/INTER/TYPE25/1 surf_ID1=3" + std::string(seed % 3 == 0 ? "" : " Ishape=2") +
                 (seed % 5 == 0 ? " Igap=3 %mesh_size=0.3" : ""));
  }
  void next_node() {
    const double gaps[] = {0.05, 0.3, 0.6, 0};
    probe.node.gap = gaps[random() % 4];
    probe.node.length = l.s.set.local() ? 0.4 : detail::type24_25::no_limit;
  }
  std::uint32_t any_face() { return static_cast<std::uint32_t>(random() % l.s.count()); }

  std::mt19937 random;
  Laid l;
  Probe probe;
  bool solid;
};

// At random, and between two places of which one counts, or penetrates, or is over another facet:
// where that changes, to the last digit.
TEST(Type25, PairsAreThoseOfExactArithmeticOrInDoubtWhereRoundOffDecides) {
  std::size_t all = 0, plain = 0, met = 0, doubtful = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    ProbedScene scene(seed);
    for (int k = 0; k < 100; ++k) {
      scene.next_node();
      const std::uint32_t face = scene.any_face();
      const auto seen = [&](const Vec& p) {
        scene.probe.put(p);
        const auto f = scene.probe.figures(face);
        return std::tuple(scene.probe.left_out(face, f), f.penetration > 0, f.normal.x);
      };
      Vec a = scene.probe.near(face, scene.random), b = scene.probe.near(face, scene.random);
      for (const Vec& p : {a, b}) {
        scene.probe.put(p);
        plain += scene.probe.expect_exact(face, true);
        EXPECT_TRUE(scene.probe.figures(face, detail::type24_25::no_limit).doubtful);
        ++all;
      }
      const auto of_a = seen(a);
      if (seen(b) == of_a) continue;
      for (int step = 0; step < 60; ++step) {
        const Vec middle = 0.5 * (a + b);
        (seen(middle) == of_a ? a : b) = middle;
      }
      for (const Vec& p : {a, b}) {
        scene.probe.put(p);
        doubtful += scene.probe.expect_exact(face, false);
        ++met;
      }
    }
  }
  EXPECT_LT(plain, all / 100) << "places at random are in no doubt";
  EXPECT_GT(met, 1000u);
  EXPECT_GT(doubtful, met / 4);
}

// The middle of an inner square of 10, and of one at the border.
TEST(Type25, NodesOnASegmentOrExactlyAtTheGapAreInNoDoubt) {
  SmallDeck d = grid(10, 2, [](int, int) { return true; });
  d.add("@/INTER/TYPE25/1 surf_ID1=1");
  Laid l(d);
  Probe probe(l);
  const auto doubtful = [&](double x, double y, double z, double node_gap, double corner_gap) {
    l.s.main_gap.assign(l.s.main_gap.size(), corner_gap);
    probe.node.gap = node_gap;
    probe.put({x, y, z});
    for (std::uint32_t face = 0; face < l.s.faces.size(); ++face)
      if (const Vec low = probe.corner(face, 0), high = probe.corner(face, 2);
          std::min(low.x, high.x) < x && x < std::max(low.x, high.x) &&
          std::min(low.y, high.y) < y && y < std::max(low.y, high.y)) {
        const double up = probe.figures(face).behind > 0 ? 1 : 0;
        const std::uint32_t seen = up == 0 ? face : l.s.faces[face].opposite;
        return probe.figures(seen, Probe::slack).doubtful;
      }
    ADD_FAILURE() << "no segment there";
    return true;
  };
  const double eps = std::nextafter(1.75, 2) - 1.75, third = std::nextafter(0.3, 0);
  for (const double y : {11.0, 15.5, 13.0})
    for (const auto& [z, doubt] : {std::pair(0.0, false),  // on it
                                   {1e-13, true},          // hardly above it
                                   {1e-10, false},
                                   {1.75, false},  // at the gap
                                   {-1.75, false},
                                   {1.75 + eps, false},
                                   {1.75 - eps, false}})
      EXPECT_EQ(doubtful(12, y, z, 0.75, 1), doubt) << y << ' ' << z;
  // 0.1 + 0.2 is less than the double 0.30000000000000004 and more than 0.3.
  EXPECT_TRUE(doubtful(12, 13, 0.3, 0.1, 0.2));
  EXPECT_FALSE(doubtful(12, 13, third, 0.1, 0.2));
  EXPECT_FALSE(doubtful(12, 13, 0.1 + 0.2, 0.1, 0.2));
  EXPECT_TRUE(doubtful(2, 15, 1.75, 0.75, 1)) << "beside a border";
  EXPECT_FALSE(doubtful(2, 15, 1.5, 0.75, 1));
  // Uneven gaps, and those that lengths limit.
  l.s.set.igap = 3;
  EXPECT_TRUE(doubtful(12, 13, 1.75, 0.75, 1));
}

// An L of squares of 10 around (20, 20): what a node hardly beyond its inner corner makes of the
// square behind. Its overhang is along the mean of both directions there.
TEST(Type25, AnInnerCornerTakesTheMeanOfTheDirectionsOfItsBorder) {
  SmallDeck d = grid(10, 2, [](int i, int j) { return i < 2 || j < 2; });
  d.add("@/INTER/TYPE25/1 surf_ID1=1");
  Laid l(d);
  Probe probe(l);
  l.s.main_gap.assign(l.s.main_gap.size(), 1.4);
  probe.node.gap = 0.01;
  const auto figures = [&](double by, double up) {
    probe.put({20 + by, 20 + by, up});
    for (std::uint32_t face = 0; face < l.s.count(); ++face) {
      const auto p = probe.figures(face);
      const Vec middle = 0.5 * (probe.corner(face, 0) + probe.corner(face, 2));
      if (middle.x != 15 || middle.y != 15 || p.behind > 0) continue;
      probe.expect_exact(face, true);
      return p;
    }
    ADD_FAILURE() << "no segment there";
    return detail::type24_25::PairFigures{};
  };
  for (const double up : {1.2, -1.2}) {
    EXPECT_NEAR(figures(0.006, up).penetration, 0.01 - 0.006 * std::sqrt(2.0), 1e-8);
    EXPECT_EQ(figures(0.009, up).penetration, 0) << "along the mean it is 0.0127 beyond";
    EXPECT_FALSE(figures(0.009, up).excluded);
    EXPECT_TRUE(figures(0.0101, up).excluded) << "by its gap over both";
  }
}

// --- edges

std::vector<detail::type24_25::SideEdge> edges_of(Laid& l) {
  return make_edges(l.context, l.s, *l.topology);
}

TEST(Type25, EdgesOfSheetsAreListedOnceWithWhatTheirSegmentsHave) {
  using namespace detail::type24_25;
  SmallDeck d = sheets(4);
  d.add("@/INTER/TYPE25/1 surf_ID1=3 Inacti=5 Iedge=2");
  Laid l(d);
  std::mt19937 random(2);
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::uint32_t>> segments;
  for (std::uint32_t f = 0; f < l.s.faces.size(); ++f) {
    Face& face = l.s.faces[f];
    face.stiffness = face.back_stiffness = static_cast<double>(random() % 4);
    face.gap = 0.25 + 0.125 * static_cast<double>(random() % 4);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int64_t a = l.built.model.node_id(face.nodes[k]),
                         b = l.built.model.node_id(face.nodes[(k + 1) % 4]);
      if (a != b) segments[std::minmax(a, b)].push_back(f);
    }
  }
  const std::vector<SideEdge> edges = edges_of(l);
  ASSERT_EQ(edges.size(), segments.size());
  auto it = segments.begin();
  for (const SideEdge& e : edges) {
    const auto& [ids, of] = *it++;
    EXPECT_EQ(std::pair(l.built.model.node_id(e.nodes[0]), l.built.model.node_id(e.nodes[1])), ids);
    const Face &a = l.s.faces[of.front()], &b = l.s.faces[of.back()];
    EXPECT_EQ(e.free(), of.size() == 1);
    EXPECT_EQ(e.gap, std::max(a.gap, b.gap));
    const double both = a.stiffness * b.stiffness;
    EXPECT_DOUBLE_EQ(e.stiffness, both == 0 ? std::max(a.stiffness, b.stiffness)
                                            : 2 / (1 / a.stiffness + 1 / b.stiffness));
    EXPECT_EQ(e.kind, 2);
    EXPECT_EQ(e.length, no_limit);
    const Quad nodes = l.s.nodes_of(e.face);
    EXPECT_EQ(std::minmax(nodes[e.side], nodes[(e.side + 1) % 4]),
              std::minmax(e.nodes[0], e.nodes[1]));
  }
  for (const int iedge : {0, 10, 20}) {
    l.s.set.iedge = iedge;
    EXPECT_EQ(edges_of(l).size(), 0u) << "edges of solids alone";
  }
}

TEST(Type25, EdgesOfSolidsAreThoseThatTheTensOfIedgeWant) {
  using namespace detail::type24_25;
  // Two cubes in a row: 16 edges of a right angle, 4 flat ones between.
  SmallDeck d;
  const double y[4] = {0, 2, 2, 0}, z[4] = {0, 0, 2, 2};
  for (int level = 0; level < 3; ++level)
    for (int k = 0; k < 4; ++k) d.node(1 + 4 * level + k, 2 * level, y[k], z[k]);
  d.solid_part(1).brick(1, 1, {1, 2, 3, 4, 5, 6, 7, 8}).brick(1, 2, {5, 6, 7, 8, 9, 10, 11, 12});
  d.group("/SURF/PART/EXT/1", {1}).add("@/INTER/TYPE25/1 surf_ID1=1 Inacti=5 Iedge=11");
  Laid l(d);
  struct Case {
    int tens;
    double cos_edge;
    std::size_t sharp, flat;
  };
  const Case cases[] = {{0, 0.5, 0, 0},   {1, 0.5, 16, 4}, {2, 0.5, 20, 0},  {3, 0.5, 16, 0},
                        {4, 0.5, 0, 0},   {1, 0, 0, 20},  // the cosine of a right angle itself
                        {1, 1e-9, 16, 4}, {1, 1, 16, 4},   {1, 1.01, 20, 0}, {3, -0.5, 0, 0}};
  for (const Case& c : cases) {
    l.s.set.iedge = 10 * c.tens + 1;
    l.s.set.cos_edge = c.cos_edge;
    std::size_t sharp = 0, flat = 0;
    for (const SideEdge& e : edges_of(l)) ++(e.kind == 1 ? sharp : flat);
    EXPECT_EQ(sharp, c.sharp) << c.tens << ' ' << c.cos_edge;
    EXPECT_EQ(flat, c.flat) << c.tens << ' ' << c.cos_edge;
  }
}

/// A strip of 2 by 20 quads around a circle that is open by twice `half_open`.
SmallDeck open_ring(double mean_radius, double half_open, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.03 * mean_radius, 0.03 * mean_radius);
  SmallDeck d;
  d.shell_part(1, 0.9);
  const int n = 20;
  add_sheet(d, 1, 1, 1, 2, n, [&](int j, int i) {
    const double turn = half_open + (6.283185307179586 - 2 * half_open) * i / n;
    const double radius = mean_radius + shift(random);
    return std::array{radius * std::cos(turn), 1.2 * j + shift(random), radius * std::sin(turn)};
  });
  return d.group("/SURF/PART/1", {1});
}

/// Whether two edges are near along the mesh, seen from the first: straight or along edges they are
/// within `limit`, and a chain of such edges leads from one to the other.
std::vector<bool> near_along_edges(const Coordinates& x,
                                   const std::vector<detail::type24_25::SideEdge>& edges,
                                   std::size_t from, double limit) {
  const auto share = [&](std::size_t a, std::size_t b) {
    const auto &m = edges[a].nodes, &n = edges[b].nodes;
    return m[0] == n[0] || m[0] == n[1] || m[1] == n[0] || m[1] == n[1];
  };
  // Shortest ways along edges, relaxed until nothing changes.
  std::vector<double> way(x.x.size(), 1e300);
  for (const NodeIndex n : edges[from].nodes) way[n] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& e : edges)
      for (const std::size_t k : {0U, 1U}) {
        const double on = way[e.nodes[k]] + detail::distance(x, e.nodes[0], e.nodes[1]);
        if (on >= way[e.nodes[1 - k]]) continue;
        way[e.nodes[1 - k]] = on;
        changed = true;
      }
  }
  std::vector<bool> within(edges.size()), reached(edges.size()), out(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto p = [&](std::size_t edge, std::size_t k) {
      return detail::at(x, edges[edge].nodes[k]);
    };
    const double straight =
        closest_between_edges<Form::robust>(p(from, 0), p(from, 1), p(e, 0), p(e, 1)).distance;
    within[e] =
        std::min(way[edges[e].nodes[0]], way[edges[e].nodes[1]]) <= limit || straight < limit;
  }
  reached[from] = true;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t a = 0; a < edges.size(); ++a)
      for (std::size_t b = 0; reached[a] && within[a] && b < edges.size(); ++b)
        if (!reached[b] && share(a, b)) changed = reached[b] = true;
  }
  for (std::size_t e = 0; e < edges.size(); ++e)
    out[e] = reached[e] && within[e] && !share(from, e);
  return out;
}

TEST(Type25, EdgesNearAlongTheMeshAreNoPairsWithIgap2) {
  using namespace detail::type24_25;
  std::size_t left = 0, removed = 0;
  // Across the smallest ring all is near; the next ones end a little beyond.
  for (const double radius : {0.9, 1.05, 1.2, 3.0}) {
    const auto seed = static_cast<unsigned>(100 * radius);
    SmallDeck plain = open_ring(radius, 0.2 / radius, seed), near = plain;
    plain.add("@/INTER/TYPE25/1 surf_ID1=1 Inacti=5 Iedge=2 Igap=1");
    near.add("@/INTER/TYPE25/1 surf_ID1=1 Inacti=5 Iedge=2 Igap=2");
    const auto found = [&](Laid& l, const std::vector<SideEdge>& edges) {
      std::vector<EdgePenetration> penetrations;
      DecisionReport decisions;
      EXPECT_TRUE(find_edges25(l.context, l.s, *l.topology, edges, penetrations, decisions));
      std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
      for (const EdgePenetration& p : penetrations) out.emplace_back(p.secondary, p.main);
      return out;
    };
    Laid all(plain), some(near);
    const std::vector<SideEdge> edges = edges_of(some);
    ASSERT_EQ(edges_of(all).size(), edges.size());
    std::vector<std::vector<bool>> is_near;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      EXPECT_EQ(edges[e].gap, 0.45);
      // Root of 2 times the gap of one and twice that of the other.
      is_near.push_back(
          near_along_edges(some.scene.coordinates, edges, e, std::sqrt(2.0) * 3 * 0.45));
    }
    auto wanted = found(all, edges);
    removed += std::erase_if(wanted, [&](const auto& pair) {
      return is_near[pair.first][pair.second] || is_near[pair.second][pair.first];
    });
    left += wanted.size();
    EXPECT_EQ(found(some, edges), wanted) << radius;
    EXPECT_EQ(wanted.empty(), radius == 0.9);
  }
  EXPECT_GT(left, 10u) << "where the ends of the ring meet";
  EXPECT_GT(removed, 10u);
}

}  // namespace
}  // namespace deck::test
