// Which elements count as turned inside out, or crossed, when nodes have moved.
#include "edit/fix/nodes/ways_out.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <vector>

#include "contact/small_deck.hpp"

namespace deck::test {
namespace {

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
  for (int i = 0; i < 8; ++i)
    d.node(i + 1, i % 4 == 1 || i % 4 == 2 ? 8 : 0, i % 4 > 1 ? 8 : 0, i > 3 ? 8 : 0);
  return d.solid_part(1).brick(1, 1, {1, 2, 3, 4, 5, 6, 7, 8});
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
}  // namespace deck::test
