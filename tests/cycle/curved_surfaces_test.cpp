// Curved main sides against the formulas written out another way, how far they reach, the criteria
// of adaptive meshing, and the bounds between conduction and radiation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "contact/small_deck.hpp"
#include "cycle/kernel/block.hpp"
#include "cycle/shared/heat.hpp"
#include "cycle/support.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {
namespace {

using namespace testing;

// --- the bicubic surface

Vec unit(const Vec& v) { return (1 / norm(v)) * v; }

struct Point {
  Vec place, tangent, normal;
};
/// The cubic of Hermite between two points, whose slopes stand on the normals of its ends.
Point hermite(const Point& p, const Point& q, double xi) {
  const Vec way = q.place - p.place, e = unit(way), both = p.normal + q.normal;
  const double length = norm(way), u = 0.5 * (1 + xi);
  const Vec up = unit(both - dot(both, e) * e);
  const auto slope = [&](const Vec& n) { return std::clamp(-dot(n, e) / dot(n, up), -1.0, 1.0); };
  const double a = slope(p.normal), b = slope(q.normal);
  const double rise = a * (u * u * u - 2 * u * u + u) + b * (u * u * u - u * u);
  const double steep = a * (3 * u * u - 4 * u + 1) + b * (3 * u * u - 2 * u);
  Point out;
  out.place = p.place + (u * length) * e + (rise * length) * up;
  out.tangent = e + steep * up;
  const Vec blend = (1 - u) * p.normal + u * q.normal, t = unit(out.tangent);
  out.normal = blend - dot(blend, t) * t;
  return out;
}
/// Signed distance of a node from the surface at the place that the weights of its facet name.
double bicubic_distance(const Pair& pair, const std::array<double, 4>& h, Vec& normal) {
  const auto ratio = [&](std::size_t plus, std::size_t minus) { return h[plus] + h[minus]; };
  const auto share = [&](std::size_t plus, std::size_t minus, std::size_t p2, std::size_t m2) {
    return ratio(plus, minus) < 1e-4 ? (h[p2] - h[m2]) / ratio(p2, m2)
                                     : (h[plus] - h[minus]) / ratio(plus, minus);
  };
  const double low_r = share(1, 0, 2, 3), high_r = share(2, 3, 1, 0);
  const double low_s = share(3, 0, 2, 1), high_s = share(2, 1, 3, 0);
  double r = 0, s = 0;  // each is linear in the other
  for (int k = 0; k < 500; ++k) {
    r = 0.5 * ((1 - s) * low_r + (1 + s) * high_r);
    s = 0.5 * ((1 - r) * low_s + (1 + r) * high_s);
  }
  std::array<Point, 4> c;
  for (std::size_t k = 0; k < 4; ++k) c[k] = {pair.x[k + 1], {}, pair.normal[k]};
  const Point up = hermite(hermite(c[0], c[1], r), hermite(c[3], c[2], r), s);
  const Point along = hermite(hermite(c[0], c[3], s), hermite(c[1], c[2], s), r);
  normal = unit(cross(along.tangent, up.tangent));
  return dot(normal, pair.x[0] - 0.5 * (up.place + along.place));
}
/// A quad without two sides alike, and normals without two alike.
Pair uneven_pair(const Vec& node) {
  Pair p;
  p.x = {node, Vec{0, 0, 0}, Vec{10, -1, 0.5}, Vec{11, 8, 0}, Vec{-1, 9, 0.25}};
  p.normal = {Vec{-.2, -.1, 1}, Vec{.3, -.25, 1.5}, Vec{.2, .15, 2}, Vec{-.1, .35, 1.25}};
  p.k0 = 1e5;
  p.gap = 1.5;
  return p;
}

TEST(BicubicSurface, IsTheOneOfHermiteCubicsOverItsEdges) {
  ContactCard card = testing::elastic_card();
  card.icurv = 3;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> part(0.1, 0.9);
  std::size_t contacts = 0;
  for (int k = 0; k < 40; ++k) {
    const double u = part(random), v = part(random), side = k % 2 == 0 ? 0.9 : -0.7;
    Pair p = uneven_pair({});
    const Vec low = (1 - u) * p.x[1] + u * p.x[2], high = (1 - u) * p.x[4] + u * p.x[3];
    p.x[0] = (1 - v) * low + v * high + Vec{0, 0, side};
    const Outcome r = run(card, p);
    Vec normal{};
    const double d = bicubic_distance(p, r.weights(), normal);
    if (std::abs(d) >= p.gap) continue;
    ++contacts;
    EXPECT_NEAR(r.all.penetration[0], p.gap - std::abs(d), 1e-9) << k;
    EXPECT_NEAR(r.all.distance[0], std::abs(d), 1e-9) << k;
    const Vec off = r.normal() - (d < 0 ? -1.0 : 1.0) * normal;
    EXPECT_LT(norm(off), 1e-9) << k;
  }
  EXPECT_GT(contacts, 30u);
}

TEST(BicubicSurface, AtItsEdgesIsTheCubicOfTheEdge) {
  ContactCard card = testing::elastic_card();
  card.icurv = 3;
  for (std::size_t edge = 0; edge < 4; ++edge) {
    Pair p = uneven_pair({});
    p.x[2][2] = p.x[4][2] = 0;  // flat: a node over an edge has its weights on it
    const double u = 0.3;
    p.x[0] = (1 - u) * p.x[edge + 1] + u * p.x[(edge + 1) % 4 + 1] + Vec{0, 0, 0.4};
    // The solver blends the triangles in reach; the closest point is on the edge.
    const Outcome r = run(card, p, 0, 0, Model::robust);
    const std::array<double, 4> h = r.weights();
    EXPECT_LT(h[(edge + 2) % 4] + h[(edge + 3) % 4], 1e-12) << edge;
    EXPECT_NEAR(h[edge], 1 - u, 1e-12) << edge;
    Vec normal{};
    const double d = bicubic_distance(p, h, normal);
    EXPECT_NEAR(r.all.penetration[0], p.gap - std::abs(d), 1e-9) << edge;
  }
}

TEST(BicubicSurface, DoesNotNoticeWhereItsCornersBegin) {
  ContactCard card = testing::elastic_card();
  card.icurv = 3;
  const Pair first = uneven_pair({4, 3, 0.7});
  const Outcome one = run(card, first);
  for (std::size_t turn = 1; turn < 4; ++turn) {
    Pair p = first;
    for (std::size_t k = 0; k < 4; ++k) {
      p.x[k + 1] = first.x[(k + turn) % 4 + 1];
      p.normal[k] = first.normal[(k + turn) % 4];
    }
    const Outcome other = run(card, p);
    EXPECT_NEAR(other.all.penetration[0], one.all.penetration[0], 1e-9) << turn;
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(other.weights()[k], one.weights()[(k + turn) % 4], 1e-9) << turn;
  }
}

TEST(BicubicSurface, MayLeaveItsFacetByHalfAnEdgeTimesTheSlopeAtItsEnds) {
  Pair p;
  p.x = {Vec{}, Vec{0, 0, 0}, Vec{10, 0, 0}, Vec{8, 5, 0}, Vec{1, 7, 0}};
  ContactCard card = testing::elastic_card();
  card.icurv = 3;
  for (std::size_t corner = 0; corner < 4; ++corner)
    for (const Vec& tilt : {Vec{.3, 0, 0}, Vec{0, -.2, 0}, Vec{.1, .25, 0}}) {
      p.normal.fill({0, 0, 2});
      p.normal[corner] = Vec{0, 0, 2} + tilt;
      double expected = 0;
      for (const std::size_t end : {(corner + 1) % 4, (corner + 3) % 4}) {
        const Vec e = p.x[end + 1] - p.x[corner + 1];
        const double cotangent = dot(p.normal[corner], e) / norm(cross(p.normal[corner], e));
        expected = std::max(expected, 0.5 * norm(e) * std::abs(cotangent));
      }
      const testing::Packet packet({p});
      EXPECT_NEAR(detail::curvature_allowance(card, packet.view(), 0), expected, 1e-12) << corner;
      EXPECT_NEAR(detail::bicubic_allowance(packet.view(), 0), expected, 1e-12) << corner;
    }
  p.triangle = true;
  EXPECT_EQ(detail::bicubic_allowance(testing::Packet({p}).view(), 0), 0);
}

TEST(CurvedReach, IsHalfOfTheLargestExtentForSpheresAndCylinders) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t corner = 1; corner < 5; ++corner)
      for (const double far : {9.0, -7.0}) {
        Pair p;
        p.x = {Vec{}, Vec{0, 0, 0}, Vec{2, 1, 1}, Vec{2, 3, 2}, Vec{1, 2, 3}};
        p.x[corner][axis] = far;
        double low = 1e9, high = -1e9;
        for (std::size_t k = 1; k < 5; ++k) {
          low = std::min(low, p.x[k][axis]);
          high = std::max(high, p.x[k][axis]);
        }
        for (const int icurv : {1, 2}) {
          ContactCard card = testing::elastic_card();
          card.icurv = icurv;
          const testing::Packet packet({p});
          EXPECT_EQ(detail::curvature_allowance(card, packet.view(), 0), 0.5 * (high - low));
        }
      }
}

// --- pairs that a curved side is looked for

/// A flat quad with unit normal (2, -2, 1) / 3 whose extents are 6, 6 and 8, and a node at a height
/// over its middle; coordinates taken round by `turn`.
bool is_pair(double height, std::size_t turn, const ContactCard& with, double margin = 0) {
  const Vec corners[] = {{0, 0, 0}, {2, 4, 4}, {6, 6, 0}, {4, 2, -4}};
  test::SmallDeck d;
  const auto node = [&](int id, const Vec& v) {
    d.node(id, v[turn], v[(1 + turn) % 3], v[(2 + turn) % 3]);
  };
  for (int k = 0; k < 4; ++k) node(k + 1, corners[k]);
  d.node(101, 0, 0, 0);
  d.shell_part(1, 1).shell(1, 1, 1, 2, 3, 4);
  d.segments("/SURF/SEG/1", {{1, 2, 3, 4}}).group("/GRNOD/NODE/2", {101});
  d.add("@/INTER/TYPE7/1 Gapmin=1");
  test::Built b(d);
  const Vec at = Vec{3, 3, 0} + (height / 3) * Vec{2, -2, 1};
  Coordinates x = b.scene.coordinates;
  const NodeIndex n = b.model.nodes.map.find(101);
  x.x[n] = at[turn], x.y[n] = at[(1 + turn) % 3], x.z[n] = at[(2 + turn) % 3];
  ContactCard card = make_card(b.scene, b.contact());
  card.icurv = with.icurv;
  card.ithe = with.ithe;
  card.drad = with.drad;
  PairSearch where;
  where.at = &x;
  where.margin = margin;
  return make_pairs(b.scene, b.contact(), card, Model::reference, 1, where).size() == 1;
}

TEST(CurvedPairs, AreSearchedHalfTheLargestExtentBeyondTheGap) {
  ContactCard flat, curved;
  curved.icurv = 1;
  for (std::size_t turn = 0; turn < 3; ++turn)
    for (const double side : {1.0, -1.0}) {
      EXPECT_TRUE(is_pair(side * (1 - 1e-9), turn, flat));
      EXPECT_FALSE(is_pair(side * (1 + 1e-9), turn, flat));
      EXPECT_TRUE(is_pair(side * (1 + 4 - 1e-9), turn, curved)) << turn;
      EXPECT_FALSE(is_pair(side * (1 + 4 + 1e-9), turn, curved)) << turn;
    }
  ContactCard warm;
  warm.drad = 2.5;
  EXPECT_FALSE(is_pair(2.4, 0, warm)) << "Drad is nothing without Ithe";
  warm.ithe = 1;
  EXPECT_TRUE(is_pair(2.5 - 1e-9, 0, warm));
  EXPECT_FALSE(is_pair(2.5 + 1e-9, 0, warm));
  EXPECT_TRUE(is_pair(1 + 0.75 - 1e-9, 0, flat, 0.75));
  EXPECT_FALSE(is_pair(1 + 0.75 + 1e-9, 0, flat, 0.75));
}

TEST(CurvedPairs, OverASharpRidgeAreSearchedAsFarAsItsSlopeSays) {
  // At the ridge both sides fall by 20 over 1: the mean normal is upright, half an edge of
  // sqrt(401) times a slope of 20.
  const double reach = 0.5 * std::sqrt(401.0) * 20;
  for (const auto& [height, found] :
       {std::pair(1 + reach - 1e-6, true), std::pair(1 + reach + 1e-6, false)}) {
    test::SmallDeck d;
    d.node(1, -1, 0, 0).node(2, 0, 0, 20).node(3, 0, 10, 20).node(4, -1, 10, 0);
    d.node(5, 1, 0, 0).node(6, 1, 10, 0).node(101, 0, 5, 20.5);
    d.shell_part(1, 1).shell(1, 1, 1, 2, 3, 4).shell(1, 2, 2, 5, 6, 3);
    d.segments("/SURF/SEG/1", {{1, 2, 3, 4}, {2, 5, 6, 3}}).group("/GRNOD/NODE/2", {101});
    d.add("@/INTER/TYPE7/1 Gapmin=1");
    test::Built b(d);
    Coordinates x = b.scene.coordinates;
    x.z[b.model.nodes.map.find(101)] = 20 + height;
    ContactCard card = make_card(b.scene, b.contact());
    card.icurv = 3;
    PairSearch where;
    where.at = &x;
    const ContactPairs pairs = make_pairs(b.scene, b.contact(), card, Model::reference, 1, where);
    EXPECT_EQ(pairs.size(), found ? 2u : 0u) << height;
    card.icurv = 1;  // half of 20
    EXPECT_EQ(make_pairs(b.scene, b.contact(), card, Model::reference, 1, where).size(), 0u);
  }
}

// --- spheres and cylinders

TEST(CurvedSides, KeepThePenetrationOfTheFacetWhereItIsSmaller) {
  ContactCard card = testing::elastic_card();
  Pair p;
  p.x = {Vec{}, Vec{9, -1, 0}, Vec{9, 1, 0}, Vec{9, 1, 2}, Vec{9, -1, 2}};
  p.gap = 0.5;
  p.k0 = 1e5;
  card.icurv = 1;
  // Corners are sqrt(82) or sqrt(86) from the centre: the nearest gives the radius.
  p.x[0] = {8.6, 0.75, 1.75};
  const double rs = norm(p.x[0]);
  ASSERT_GT(rs - std::sqrt(82.0) + 0.5, 0.1);
  const Outcome near = run(card, p);
  EXPECT_NEAR(near.all.penetration[0], 0.1, 1e-12);
  EXPECT_LT(norm(near.normal() + (1 / rs) * p.x[0]), 1e-12);
  EXPECT_NE(near.all.status[0] & status_kept, 0);
  p.x[0] = {8.45, 0, 1};
  ASSERT_LT(norm(p.x[0]) - std::sqrt(82.0) + 0.5, 0.0);
  const Outcome gone = run(card, p);
  EXPECT_EQ(gone.all.penetration[0], 0);
  EXPECT_EQ(gone.all.status[0] & status_kept, 0);
  // A cylinder about z: radius sqrt(82) at every corner.
  card.icurv = 2;
  card.curv_node1 = {0, 0, -3};
  card.curv_node2 = {0, 0, 5};
  const auto depth = [&](double x) {
    p.x[0] = {x, 0, 1};
    return run(card, p);
  };
  const double radius = std::sqrt(82.0);
  EXPECT_EQ(depth(radius - 0.51).all.status[0] & status_kept, 0);
  EXPECT_NEAR(depth(radius - 0.49).all.penetration[0], 0.01, 1e-9);
  EXPECT_NEAR(depth(radius + 0.49).all.penetration[0], 0.01, 1e-9);
  EXPECT_NE(depth(radius + 0.49).all.status[0] & status_kept, 0);
  EXPECT_EQ(depth(radius + 0.51).all.status[0] & status_kept, 0);
  EXPECT_EQ(depth(radius + 0.51).all.penetration[0], 0);
}

// --- adaptive meshing

TEST(AdaptivityCriteria, TakeTheSharperOfBothDirections) {
  ContactCard card = testing::elastic_card();
  card.iadm = 2;
  card.nradm = 4;
  card.padm = 0.5;
  card.angladm = 60;
  Pair p;
  p.x = {Vec{4, 2, 0.6}, Vec{0, 0, 0}, Vec{10, 0, 0}, Vec{10, 6, 0}, Vec{0, 6, 0}};
  p.k0 = 1e5;
  const auto tilted = [](double x, double y) { return unit(Vec{x, y, 1}); };
  p.normal = {tilted(-.3, -.1), tilted(.2, -.15), tilted(.25, .2), tilted(-.1, .05)};
  const auto& n = p.normal;
  // Twice the length over the turn along it.
  const double along_x = 20 / std::abs(n[1][0] + n[2][0] - n[0][0] - n[3][0]);
  const double along_y = 12 / std::abs(n[2][1] + n[3][1] - n[0][1] - n[1][1]);
  const auto criteria = [&](int k) {
    return run(card, p).all.criteria[static_cast<std::size_t>(k)][0];
  };
  testing::expect_digits(criteria(0), std::min(along_x, along_y / 4));
  for (const double none : {0.0, -0.5}) {
    card.nradm = none;
    testing::expect_digits(criteria(0), std::min(along_x, along_y));
  }
  EXPECT_LT(along_x, along_y);
  card.nradm = 4;
  EXPECT_LT(along_y / 4, along_x);
  testing::expect_digits(criteria(1), 0.4 / (0.5 * 1));
  const double least = std::min({n[0][2], n[1][2], n[2][2], n[3][2]});
  testing::expect_digits(criteria(2), least / 0.5);
  card.iadm = 1;
  EXPECT_EQ(criteria(1), 0);
  EXPECT_GT(criteria(0), 0);
  card.padm = 0;
  card.iadm = 2;
  EXPECT_EQ(criteria(1), 0);
  p.x[0][2] = 1.25;
  for (int k = 0; k < 3; ++k) EXPECT_EQ(criteria(k), 0) << "beyond the gap " << k;
  p.x[0][2] = 1;
  EXPECT_EQ(criteria(0), 0) << "at the gap";
}

// --- heat

/// A node over a rectangle of 4 by 2, which looks down: its plane distance is the height.
HeatState over_rectangle(double height) {
  HeatState s;
  s.position = {Vec{1, 1, -height}, Vec{0, 0, 0}, Vec{4, 0, 0}, Vec{4, 2, 0}, Vec{0, 2, 0}};
  s.temperature = {300, 400, 500, 600, 700};
  s.weight = {0.375, 0.125, 0.125, 0.375};
  s.gap = 0.5;
  s.dt1 = 0.25;
  return s;
}

TEST(PairHeat, RadiatesFromTheGapToDradAndConductsElsewhere) {
  ContactCard card;
  card.ithe = card.ithe_form = 1;
  card.kthe = 3;
  card.frad = 1e-9;
  card.drad = 2;
  card.thermal_speed_up = 5;
  const double tm = 0.375 * 400 + 0.125 * 500 + 0.125 * 600 + 0.375 * 700, ts = 300;
  const double area = 8, tau = 0.25 * 5;
  const double radiates = area * (tm - ts) * tau * 1e-9 * (tm * tm + ts * ts) * (tm + ts);
  const double conducts = area * (tm - ts) * tau * 3;
  for (const double side : {1.0, -1.0})
    for (const auto& [height, glows] :
         {std::pair(0.25, false), std::pair(std::nextafter(0.5, 0.0), false), std::pair(0.5, true),
          std::pair(1.5, true), std::pair(2.0, true), std::pair(std::nextafter(2.0, 3.0), false)}) {
      const HeatFlow flow = pair_heat(card, over_rectangle(side * height));
      const double q = glows ? radiates : conducts;
      EXPECT_NEAR(flow.q[0], q, 1e-12 * q) << height;
      const double weights[] = {0.375, 0.125, 0.125, 0.375};
      for (std::size_t c = 0; c < 4; ++c)
        EXPECT_NEAR(flow.q[c + 1], -weights[c] * q, 1e-12 * q) << height;
      EXPECT_NEAR(flow.conductance, glows ? 0.0 : area * 3 * 5, 1e-12) << height;
    }
}

}  // namespace
}  // namespace deck::cycle
