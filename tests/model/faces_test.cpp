// Faces of solids, against the plain definition.
#include "model/shared/faces.hpp"

#include <gtest/gtest.h>

#include <ctime>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "model/selection_deck.hpp"

namespace deck::test {
namespace {

using detail::Face;

constexpr int corners_of_face[6][4] = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                       {2, 3, 7, 6}, {1, 2, 6, 5}, {0, 4, 7, 3}};

TEST(SolidFace, DropsRepeatedNodesAndWhatIsNoFaceThen) {
  std::mt19937 random(3);
  for (int round = 0; round < 400; ++round) {
    std::array<NodeIndex, 8> slots;
    for (NodeIndex& n : slots) n = random() % 6;
    for (int f = 0; f < 6; ++f) {
      std::vector<NodeIndex> wanted;
      for (const int s : corners_of_face[f])
        if (std::find(wanted.begin(), wanted.end(), slots[static_cast<std::size_t>(s)]) ==
            wanted.end())
          wanted.push_back(slots[static_cast<std::size_t>(s)]);
      const Face face = detail::solid_face(slots.data(), f);
      EXPECT_EQ(face.corners, wanted.size() >= 3 ? static_cast<int>(wanted.size()) : 0);
      if (wanted.size() < 3) continue;
      if (wanted.size() == 3) wanted.push_back(wanted[2]);
      EXPECT_TRUE(std::equal(wanted.begin(), wanted.end(), face.nodes.begin()));
    }
  }
}

TEST(SolidFace, IsOneOfASolidWhereItHasFourOfItsNodes) {
  std::mt19937 random(5);
  int yes = 0;
  for (int round = 0; round < 3000; ++round) {
    std::array<NodeIndex, 8> slots;
    for (NodeIndex& n : slots) n = random() % 9;
    std::array<NodeIndex, 4> segment;
    if (round % 2 == 0) {  // the nodes of a face in another order
      const int f = static_cast<int>(random() % 6);
      for (std::size_t i = 0; i < 4; ++i)
        segment[i] = slots[static_cast<std::size_t>(corners_of_face[f][i])];
      std::shuffle(segment.begin(), segment.end(), random);
    } else {
      for (NodeIndex& n : segment) n = random() % 9;
    }
    const std::set<NodeIndex> wanted(segment.begin(), segment.end());
    bool has = false;
    for (const auto& face : corners_of_face) {
      std::set<NodeIndex> nodes;
      for (const int s : face) nodes.insert(slots[static_cast<std::size_t>(s)]);
      has = has || (wanted.size() == 4 && nodes == wanted);
    }
    EXPECT_EQ(detail::has_face_of(slots.data(), segment), has) << round;
    yes += has;
  }
  EXPECT_GT(yes, 300);
}

/// A block of nx by ny by nz bricks, part 4 for those of even x, else part 5; nodes from 1 on.
std::string bricks(int nx, int ny, int nz) {
  std::string out = parts() + "/NODE\n";
  const auto id = [&](int x, int y, int z) { return 1 + x + (nx + 1) * (y + (ny + 1) * z); };
  for (int z = 0; z <= nz; ++z)
    for (int y = 0; y <= ny; ++y)
      for (int x = 0; x <= nx; ++x) out += node(id(x, y, z), x, y, z);
  int element = 0;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        out += "/BRICK/" + std::to_string(4 + x % 2) + "\n" +
               cells({++element, id(x, y, z), id(x + 1, y, z), id(x + 1, y + 1, z), id(x, y + 1, z),
                      id(x, y, z + 1), id(x + 1, y, z + 1), id(x + 1, y + 1, z + 1),
                      id(x, y + 1, z + 1)});
  return out;
}

/// Faces that exactly one of the solids of some parts has, as sets of nodes.
std::multiset<std::set<NodeIndex>> single_faces(const Model& m, const std::set<std::int64_t>& of) {
  std::map<std::set<NodeIndex>, int> count;
  for (std::size_t e = 0; e < m.solid8.size(); ++e) {
    if (!of.contains(m.parts[m.solid8.part[e]].id)) continue;
    for (const auto& face : corners_of_face) {
      std::set<NodeIndex> nodes;
      for (const int s : face) nodes.insert(m.solid8.of(e)[s]);
      ++count[nodes];
    }
  }
  std::multiset<std::set<NodeIndex>> out;
  for (const auto& [nodes, n] : count)
    if (n == 1) out.insert(nodes);
  return out;
}

std::multiset<std::set<NodeIndex>> faces_of(BuiltModel& b, std::int64_t surface) {
  std::multiset<std::set<NodeIndex>> out;
  for (const Segment& s : b.selections().surface(surface)->segments)
    out.emplace(s.nodes.begin(), s.nodes.end());
  return out;
}

TEST(ExteriorFaces, AreThoseOfOneSolidAlone) {
  BuiltModel b(bricks(3, 2, 2) + "/SURF/PART/EXT/1\ns\n" + cells({4, 5}) + "/SURF/PART/EXT/2\ns\n" +
               cells({4}) + "/SURF/PART/EXT/3\ns\n" + cells({5}) + "/SURF/PART/ALL/4\ns\n" +
               cells({5}) + "/GRBRIC/PART/5\ng\n" + cells({5}) + "/SURF/GRBRIC/FREE/5\ns\n" +
               cells({5}));
  EXPECT_EQ(faces_of(b, 1), single_faces(b.model(), {4, 5}));
  EXPECT_EQ(faces_of(b, 1).size(), 2u * (3 * 2 + 3 * 2 + 2 * 2));
  EXPECT_EQ(faces_of(b, 2), single_faces(b.model(), {4}));
  EXPECT_EQ(faces_of(b, 3), single_faces(b.model(), {5}));
  EXPECT_EQ(faces_of(b, 4).size(), 6u * 4);
  // Of the middle slice, against all solids: its rim alone.
  const auto all = single_faces(b.model(), {4, 5});
  std::multiset<std::set<NodeIndex>> both;
  for (const auto& f : single_faces(b.model(), {5}))
    if (all.contains(f)) both.insert(f);
  EXPECT_EQ(faces_of(b, 5), both);
}

TEST(ExteriorFaces, OfSolidsWithoutAllNodesAreNone) {
  BuiltModel b(parts() + cube_nodes() + "/BRICK/4\n" +
               cells({1, 101, 102, 105, 104, 107, 108, 111, 999}) + "/BRICK/5\n" +
               cells({2, 102, 103, 106, 105, 108, 109, 112, 111}) + "/SURF/PART/EXT/1\ns\n" +
               cells({4, 5}));
  EXPECT_EQ(b.surface(1).size(), 6u);
}

TEST(ExteriorFaces, OfAPlateWithOppositeNodesInReverseAreFoundInTime) {
  constexpr NodeIndex length = 200000, last = 4 * length + 3;
  Elements solids;
  solids.width = 8;
  solids.id.resize(length);
  solids.shape.resize(length, SolidShape::brick8);
  for (NodeIndex a = 0; a < length; ++a)
    for (const NodeIndex flip : {0u, last})
      for (const NodeIndex n : {a, a + 1, a + length + 2, a + length + 1})
        solids.nodes.push_back(flip > 0 ? flip - n : n);
  std::vector<std::uint32_t> all(length);
  std::iota(all.begin(), all.end(), 0u);
  std::vector<Segment> out;
  const std::clock_t begin = std::clock();
  detail::SolidFaces(solids).add_segments({.solids = &all}, out);
  EXPECT_LT(std::clock() - begin, 10 * CLOCKS_PER_SEC);
  EXPECT_EQ(out.size(), 4u * length + 2);
}

}  // namespace
}  // namespace deck::test
