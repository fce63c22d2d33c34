// Surface-to-surface input of ties: which segments of two surfaces face each other, against the
// selection of specification section 10 over all pairs, and places where each of its limits
// decides.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include "contact/shared/tie_steps.hpp"
#include "contact/tied_sheet.hpp"

namespace deck::test {
namespace {

using detail::Corners;
using Corner4 = std::array<Vec, 4>;

/// Two surfaces of segments, each with nodes of its own, and what is left of them.
class TwoSurfaces {
 public:
  void add(int surface, const Corner4& q) {
    Corners c{};
    for (std::size_t k = 0; k < 4; ++k) {
      const bool repeated = k == 3 && q[3].x == q[2].x && q[3].y == q[2].y && q[3].z == q[2].z;
      c[k] = repeated ? c[2] : node(q[k]);
    }
    list_[surface].push_back(c);
  }
  /// A rectangle with its least corner there.
  void flat(int surface, double x, double y, double z, double width, double depth) {
    add(surface,
        {Vec{x, y, z}, Vec{x + width, y, z}, Vec{x + width, y + depth, z}, Vec{x, y + depth, z}});
  }
  void add_same_nodes(int surface, const Corners& c) { list_[surface].push_back(c); }
  const Corners& segment(int surface, std::size_t i) const { return list_[surface][i]; }
  /// Positions of the segments that are left, of the first and the second surface.
  using Left = std::array<std::vector<std::size_t>, 2>;
  Left left(double dsearch) const {
    Tie tie;
    detail::join_surfaces(x_, dsearch, list_[0], list_[1], tie);
    Left out;
    std::size_t at = 0;
    for (int surface = 0; surface < 2; ++surface)
      for (std::size_t i = 0; i < list_[surface].size() && at < tie.main.size(); ++i)
        if (tie.main[at] == list_[surface][i]) {
          out[static_cast<std::size_t>(surface)].push_back(i);
          ++at;
        }
    EXPECT_EQ(at, tie.main.size()) << "in the order of the surfaces";
    std::vector<NodeIndex> wanted, nodes;
    for (const Corners& c : tie.main)
      for (const NodeIndex n : c)
        if (std::find(wanted.begin(), wanted.end(), n) == wanted.end()) wanted.push_back(n);
    for (const TiedNode& n : tie.nodes) nodes.push_back(n.node);
    EXPECT_EQ(nodes, wanted) << "each once, in the order of first appearance";
    return out;
  }
  /// The same by section 10 of the specification, over all pairs.
  Left by_all_pairs(double dsearch) const {
    std::array<std::vector<Segment>, 2> s;
    for (int surface = 0; surface < 2; ++surface)
      for (const Corners& c : list_[surface])
        s[static_cast<std::size_t>(surface)].push_back(measured(c, dsearch));
    for (Segment& j : s[1])
      for (const Segment& i : s[0]) j.kept = j.kept && i.nodes != j.nodes;
    for (const std::size_t one : {0U, 1U})
      for (Segment& i : s[one]) choose(i, s[1 - one]);
    Left out;
    for (const std::size_t surface : {0U, 1U})
      for (std::size_t i = 0; i < s[surface].size(); ++i)
        if (s[surface][i].kept) out[surface].push_back(i);
    return out;
  }

 private:
  struct Segment {
    std::set<NodeIndex> nodes;
    std::array<double, 3> low{}, high{}, centre{};
    Vec normal;
    double m = 0;
    bool kept = true;
  };
  NodeIndex node(const Vec& p) {
    x_.x.push_back(p.x);
    x_.y.push_back(p.y);
    x_.z.push_back(p.z);
    return static_cast<NodeIndex>(x_.x.size() - 1);
  }
  std::array<double, 3> place(NodeIndex n) const { return {x_.x[n], x_.y[n], x_.z[n]}; }
  Segment measured(const Corners& c, double dsearch) const {
    Segment s;
    s.nodes = {c.begin(), c.end()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<double> v;
      for (const NodeIndex n : c) v.push_back(place(n)[axis]);
      s.centre[axis] = 0.25 * (v[0] + v[1] + v[2] + v[3]);
      s.low[axis] = *std::min_element(v.begin(), v.end());
      s.high[axis] = *std::max_element(v.begin(), v.end());
    }
    const Vec n = cross(detail::at(x_, c[2]) - detail::at(x_, c[0]),
                        detail::at(x_, c[3]) - detail::at(x_, c[1]));
    s.normal = (1 / norm(n)) * n;
    s.m = std::max(dsearch, 0.2F * std::sqrt(norm(n) / 2));
    return s;
  }
  static void choose(Segment& i, std::vector<Segment>& others) {
    if (!i.kept) return;
    Segment* found = nullptr;
    double least = i.m;
    for (Segment& j : others) {
      bool near = j.kept && std::abs(dot(i.normal, j.normal)) >= 0.5;
      for (std::size_t a = 0; a < 3; ++a) {
        const double w = 0.6F * (j.high[a] - j.low[a]);
        near = near && j.centre[a] >= i.low[a] - i.m - w && j.centre[a] <= i.high[a] + i.m + w;
        near = near && j.low[a] <= i.high[a] + i.m && j.high[a] >= i.low[a] - i.m;
      }
      if (!near) continue;
      const Vec apart{i.centre[0] - j.centre[0], i.centre[1] - j.centre[1],
                      i.centre[2] - j.centre[2]};
      const double h = std::abs(dot(apart, i.normal)), equal = 0.1F * j.m;
      if (h < least) {
        if (found != nullptr && h + equal < least) found->kept = false;
        found = &j;
        least = h;
      } else if (h > least + equal && found != nullptr) {
        j.kept = false;
      } else if (found == nullptr) {
        found = &j;
      }
    }
    i.kept = found != nullptr;
  }
  Coordinates x_;
  std::vector<Corners> list_[2];
};

using Left = TwoSurfaces::Left;

/// What is left of a square of 10 by 10 at (-40, -20, -5) and another rectangle.
Left of_square_and(double x, double y, double z, double width, double depth, double dsearch) {
  TwoSurfaces s;
  s.flat(0, -40, -20, -5, 10, 10);
  s.flat(1, -40 + x, -20 + y, -5 + z, width, depth);
  return s.left(dsearch);
}
const Left both_left{{{0}, {0}}}, none_left{};

TEST(SurfacesOfATie, FaceEachOtherWithinTheSearchDistanceOnEachSide) {
  for (const double sign : {1.0, -1.0}) {
    EXPECT_EQ(of_square_and(0, 0, sign * 3, 10, 10, 3), both_left) << "at the distance itself";
    EXPECT_EQ(of_square_and(0, 0, sign * 3.0001, 10, 10, 3), none_left);
    EXPECT_EQ(of_square_and(sign * 13, 0, 1, 10, 10, 3), both_left);
    EXPECT_EQ(of_square_and(sign * 13.0001, 0, 1, 10, 10, 3), none_left);
    EXPECT_EQ(of_square_and(0, sign * 13, 1, 10, 10, 3), both_left);
    EXPECT_EQ(of_square_and(0, sign * 13.0001, 1, 10, 10, 3), none_left);
  }
}

TEST(SurfacesOfATie, KeepTheNearestOfSegmentsAndThoseATenthOfTheReachBehindIt) {
  // Over the only segment of the first: heights in the order of the list, reach 4, a tenth 0.4.
  const std::pair<std::vector<double>, std::vector<std::size_t>> cases[] = {
      {{1, 1.3, 1.5}, {0, 1}},  // 1.5 is more than 0.4 above the nearest
      {{1.5, 1}, {1}},          // the nearer one drops the one before
      {{1.3, 1}, {0, 1}},       // but not where it is hardly nearer
      {{-1, 1.3, -1.5}, {0, 1}},
      {{3.9, 3, 2}, {2}},
      {{2, 1.7, 1.4}, {0, 1, 2}},  // each is hardly nearer than the one before
      {{2, 2, 1}, {1, 2}},         // of two equal ones the first was found
      {{1.4, 2, 1.7}, {0, 2}}};
  for (const auto& [heights, kept] : cases) {
    TwoSurfaces s;
    s.flat(0, 0, 0, 0, 10, 10);
    for (const double h : heights) s.flat(1, 0, 0, h, 10, 10);
    EXPECT_EQ(s.left(4), (Left{{{0}, kept}})) << heights[0];
    TwoSurfaces other;
    other.flat(1, 0, 0, 0, 10, 10);
    for (const double h : heights) other.flat(0, 0, 0, h, 10, 10);
    EXPECT_EQ(other.left(4), (Left{{kept, {0}}})) << heights[0];
  }
}

TEST(SurfacesOfATie, AreWhatTheSelectionOverAllPairsLeaves) {
  std::mt19937 random(3);
  std::size_t left = 0, all = 0;
  for (int scene = 0; scene < 200; ++scene) {
    std::uniform_real_distribution<double> along(0, scene % 3 == 0 ? 8 : 30), up(-2.5, 2.5),
        size(0.5, 12), tilt(-1, 1);
    const Vec middle{scene % 2 == 0 ? -70.0 : 20.0, -30, scene % 5 - 9.0};
    TwoSurfaces s;
    for (int k = 0; k < 16; ++k) {
      const Vec p = middle + Vec{along(random), along(random), up(random)};
      const double steep = scene % 4 == 0 ? 1.4 : 0.2;
      const Vec u = size(random) * Vec{1, 0, steep * tilt(random)},
                v = size(random) * Vec{0.2 * tilt(random), 1, steep * tilt(random)};
      Corner4 q{p, p + u, p + u + v, p + v};
      if (k % 5 == 0) q[3] = q[2];                             // a triangle
      if (k % 5 == 1) q = {p, p + u, p + u + 0.3 * v, p + v};  // its centre is off the middle
      if (scene % 7 == 0) q = {p, p + u + v, p + 2.0 * u, p + u - 0.2 * v};
      for (Vec& corner : q) {
        if (scene % 6 == 1) corner = {corner.z, corner.x, corner.y};
        if (scene % 8 == 7)  // at limits, and equally far
          corner = {std::round(corner.x), std::round(corner.y), std::round(corner.z)};
      }
      s.add(k % 2, q);
    }
    if (scene % 3 == 2) {  // the second surface has a segment of the first, and most of another
      const Corners &c = s.segment(0, 1), &e = s.segment(0, 2);
      s.add_same_nodes(1, {c[2], c[1], c[0], c[3]});
      s.add_same_nodes(1, {e[0], e[1], e[2], e[2]});
    }
    for (const double dsearch : {0.0, 0.7, 3.0}) {
      const Left got = s.left(dsearch);
      EXPECT_EQ(got, s.by_all_pairs(dsearch)) << scene << ' ' << dsearch;
      left += got[0].size() + got[1].size();
      all += 16;
    }
  }
  EXPECT_GT(left, all / 10);
  EXPECT_LT(left, all * 9 / 10);
}

TEST(SurfacesOfATie, TakeThePlaceOfTheGroupOfNodesWithSpotflag25To28) {
  for (const int spotflag : {5, 25, 28, 30})
    for (const int second : {2, 77}) {  // 77 is not there
      SmallDeck d = sheet({{5, 5, 1}});
      d.node(201, 0, 0, 0.5).node(202, 10, 0, 0.5).node(203, 10, 10, 0.5).node(204, 0, 10, 0.5);
      d.segments("/SURF/SEG/2", {{204, 203, 202, 201}});
      std::string card =
          fmt::sprintf("/INTER/TYPE2/1\ntie\n%10d%10d%10d%10d%10d%10d%10d%10d%20.13g", 9, 1, 1,
                       spotflag, 0, 0, 0, second, 2.0);
      if (spotflag >= 25 && spotflag <= 28) card += "\n                 1.0                0.05";
      SceneOptions options;
      options.ties = true;
      std::string text = d.add(card).text();
      text.replace(text.find("/BEGIN\nexample\n") + 15, 10, "      2025");  // from there on
      const Built b(text, options);
      ASSERT_EQ(b.scene.ties.size(), 1u);
      const Tie& tie = b.scene.ties[0];
      std::set<std::int64_t> nodes, corners;
      for (const TiedNode& n : tie.nodes) nodes.insert(b.model.node_id(n.node));
      for (const Corners& c : tie.main)
        for (const NodeIndex n : c) corners.insert(b.model.node_id(n));
      // Of the nine segments the one below, and the three that it touches within 2.
      const bool joined = spotflag >= 25 && spotflag <= 28 && second == 2;
      EXPECT_EQ(tie.main.size(), joined ? 5u : 9u) << spotflag;
      EXPECT_EQ(nodes, joined ? corners : std::set<std::int64_t>{101}) << spotflag << ' ' << second;
    }
}

}  // namespace
}  // namespace deck::test
