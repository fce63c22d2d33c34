// `deck parts`: which elements, interfaces and rigid bodies a part has.

#include <array>
#include <map>
#include <set>

#include "report/inspected.hpp"
#include "report/shared/parts.hpp"

namespace deck::test {
namespace {

using Ids = std::vector<std::int64_t>;

/// Shells (parts 1 to 3), a brick and a tetrahedron (4), nothing (5), a truss, a beam and a spring
/// (6 to 8), a plate that nothing sees (9) and one without a material (10). Node 99 belongs to no
/// element, node 58 only orients the beam.
SmallDeck ten_parts() {
  SmallDeck d;
  const auto sheet = [&](int part, double z) {
    const int n = 10 * part;
    d.node(n + 1, 0, 0, z).node(n + 2, 10, 0, z).node(n + 3, 10, 20, z).node(n + 4, 0, 20, z);
    d.shell(part, part, n + 1, n + 2, n + 3, n + 4);
  };
  d.shell_part(1, 2).shell_part(2, 3, 0.75).shell_part(3, 1).solid_part(4).shell_part(5, 4);
  d.truss_part(6, 5).beam_part(7, 6).spring_part(8, 70).shell_part(9, 1);
  d.shell_part(10, 1, 0, 999);
  for (const int part : {1, 2, 3, 9, 10}) sheet(part, part);
  d.shell3(1, 100, 11, 12, 13);
  d.node(41, 0, 0, 40).node(42, 5, 0, 40).node(43, 5, 5, 40).node(44, 0, 5, 40);
  d.node(45, 0, 0, 45).node(46, 5, 0, 45).node(47, 5, 5, 45).node(48, 0, 5, 45).node(49, 9, 9, 49);
  d.brick(4, 101, {41, 42, 43, 44, 45, 46, 47, 48}).tetra(4, 102, 46, 47, 48, 49);
  d.node(51, 0, 0, 60).node(52, 5, 0, 60).node(53, 9, 0, 60).node(58, 0, 9, 60).node(54, 9, 5, 60);
  d.bar("TRUSS", 6, 103, 51, 52).bar("BEAM", 7, 104, 52, 53, 58).bar("SPRING", 8, 105, 53, 54);
  d.node(99, 0, 0, 99).node(98, 3, 3, 98);
  d.group("/GRNOD/PART/1", {1}).group("/GRNOD/PART/2", {2}).group("/GRNOD/PART/23", {2, 3});
  d.group("/GRNOD/PART/3", {3}).group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2});
  d.group("/SURF/PART/3", {3}).group("/SURF/PART/12", {1, 2});
  return d;
}

struct Parted {
  explicit Parted(const SmallDeck& d)
      : loaded(LoadedDeck::from(
            std::move(*read_deck_text("parts_0000.rad", d.text(), SchemaSet::built_in())))),
        view(detail::view_parts(loaded)) {}
  const detail::PartView& part(std::int64_t id) const {
    return view.parts.at(loaded.model().part_of_id.at(id));
  }
  Ids seen_by(std::int64_t interface) const {
    Ids out;
    for (const Part& p : loaded.model().parts) {
      const Ids& all = part(p.id).interfaces;
      if (std::find(all.begin(), all.end(), interface) != all.end()) out.push_back(p.id);
    }
    return out;
  }
  LoadedDeck loaded;
  detail::PartsView view;
};

TEST(PartsView, CountsElementsByKindAndNamesWhatHasNone) {
  const Parted p(ten_parts());
  using Counts = std::array<std::uint64_t, 8>;
  EXPECT_EQ(p.part(1).elements, (Counts{1, 1, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(p.part(4).elements, (Counts{0, 0, 2, 0, 0, 0, 0, 0}));
  EXPECT_EQ(p.part(5).elements, Counts{});
  EXPECT_EQ(p.part(6).elements, (Counts{0, 0, 0, 0, 0, 1, 0, 0}));
  EXPECT_EQ(p.part(7).elements, (Counts{0, 0, 0, 0, 0, 0, 1, 0}));
  EXPECT_EQ(p.part(8).elements, (Counts{0, 0, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(p.part(1).count(), 2u);
  EXPECT_EQ(p.part(1).thickness, 2.0);
  EXPECT_EQ(p.part(2).thickness, 0.75) << "of the part, before that of its property";
  EXPECT_EQ(p.part(4).thickness, 0.0);
  EXPECT_EQ(p.view.empty_parts, (Ids{5}));
  EXPECT_EQ(p.view.unseen_parts, (Ids{1, 2, 3, 4, 6, 7, 8, 9, 10}));
  EXPECT_EQ(p.view.unconnected_nodes, 2u) << "98 and 99; the beam has node 58";
}

TEST(PartsView, AnInterfaceSeesThePartsOfItsGroupsSurfacesAndLines) {
  SmallDeck d = ten_parts();
  d.segments("/SURF/SEG/60", {{21, 22, 23, 24}, {31, 32, 33, 34}});
  d.segments("/LINE/SEG/70", {{51, 52}, {11, 12}}).segments("/LINE/SEG/71", {{31, 32}});
  d.group("/GRNOD/NODE/80", {41, 42, 43, 44, 52, 53, 54, 11, 12, 13})
      .group("/GRNOD/NODE/81", {46, 47, 48, 41, 42});
  d.add("@/INTER/TYPE7/1 grnd_IDs=23 surf_IDm=1 Gapmin=1");
  d.add("@/INTER/TYPE7/2 grnd_IDs=80 surf_IDm=60 Gapmin=1");
  d.add("@/INTER/TYPE11/3 line_IDs=70 line_IDm=71 Gapmin=1");
  d.add("@/INTER/TYPE7/4 grnd_IDs=81 surf_IDm=3 Gapmin=1");
  d.add("@/INTER/TYPE2/5 grnd_IDs=2 surf_IDm=3 dsearch=9");
  d.add("@/INTER/TYPE24/6 surf_ID1=2 surf_ID2=12");
  const Parted p(d);
  EXPECT_EQ(p.seen_by(1), (Ids{1, 2, 3}));
  // A face of the brick, both nodes of the beam (not the one that orients it) and of the spring,
  // the triangle of part 1; the segments are those of the shells of parts 2 and 3.
  EXPECT_EQ(p.seen_by(2), (Ids{1, 2, 3, 4, 7, 8}));
  EXPECT_EQ(p.seen_by(3), (Ids{1, 3, 6}));
  EXPECT_EQ(p.seen_by(4), (Ids{3, 4})) << "three nodes of the tetrahedron are a face";
  EXPECT_EQ(p.seen_by(5), (Ids{2, 3}));
  EXPECT_EQ(p.seen_by(6), (Ids{1, 2}));
  EXPECT_EQ(p.part(3).interfaces, (Ids{1, 2, 3, 4, 5}));
  EXPECT_EQ(p.view.unseen_parts, (Ids{9, 10}));
}

TEST(PartsView, NodesOfAnEdgeOrOfLessThanAnElementAreNoPart) {
  SmallDeck d = ten_parts().group("/GRNOD/NODE/80", {41, 42, 11, 12, 21, 52, 58});
  const Parted p(d.add("@/INTER/TYPE7/1 grnd_IDs=80 surf_IDm=3 Gapmin=1"));
  EXPECT_EQ(p.seen_by(1), (Ids{3}));
}

/// All groups of four nodes of a brick: four that have a coordinate in common are a face.
TEST(PartsView, ABrickIsSeenByItsSixFacesOnly) {
  SmallDeck d;
  const auto corner = [](int k) {
    return std::array{k % 4 == 1 || k % 4 == 2 ? 5 : 0, k % 4 >= 2 ? 7 : 0, k < 4 ? 0 : 9};
  };
  for (int k = 0; k < 8; ++k) d.node(k + 1, corner(k)[0], corner(k)[1], corner(k)[2]);
  d.node(11, 0, 0, 20).node(12, 5, 0, 20).node(13, 5, 5, 20).node(14, 0, 5, 20);
  d.solid_part(1).brick(1, 1, {1, 2, 3, 4, 5, 6, 7, 8});
  d.shell_part(2, 1).shell(2, 2, 11, 12, 13, 14).group("/SURF/PART/1", {2});
  Ids faces;
  int id = 0;
  for (int bits = 0; bits < 256; ++bits) {
    std::vector<int> nodes;
    std::array<std::set<int>, 3> places;
    for (int k = 0; k < 8; ++k) {
      if ((bits >> k & 1) == 0) continue;
      nodes.push_back(k + 1);
      for (std::size_t a = 0; a < 3; ++a) places[a].insert(corner(k)[a]);
    }
    if (nodes.size() != 4) continue;
    ++id;
    if (places[0].size() == 1 || places[1].size() == 1 || places[2].size() == 1)
      faces.push_back(id);
    d.group(("/GRNOD/NODE/" + std::to_string(100 + id)).c_str(), nodes);
    d.add("@/INTER/TYPE7/" + std::to_string(id) + " grnd_IDs=" + std::to_string(100 + id) +
          " surf_IDm=1 Gapmin=1");
  }
  ASSERT_EQ(id, 70);
  ASSERT_EQ(faces.size(), 6u);
  EXPECT_EQ(Parted(d).part(1).interfaces, faces);
}

TEST(PartsView, MoreThanSixtyFourGroupsAreAllLookedAt) {
  SmallDeck d = ten_parts();
  for (int i = 1; i <= 130; ++i)
    d.add("@/INTER/TYPE7/" + std::to_string(i) + " grnd_IDs=" + (i % 2 == 0 ? "2" : "3") +
          " surf_IDm=1 Gapmin=1");
  const Parted p(d);
  Ids even, odd;
  for (int i = 1; i <= 130; ++i) (i % 2 == 0 ? even : odd).push_back(i);
  EXPECT_EQ(p.part(2).interfaces, even);
  EXPECT_EQ(p.part(3).interfaces, odd);
}

TEST(PartsView, NamesContactsThatLetTheSamePartsTouch) {
  SmallDeck d = ten_parts();
  d.add("@/INTER/TYPE7/1 grnd_IDs=23 surf_IDm=12 Gapmin=1");  // 2 3 on 1 2
  d.add("@/INTER/TYPE7/2 grnd_IDs=3 surf_IDm=1 Gapmin=1");    // 3 on 1: repeats 1
  d.add("@/INTER/TYPE7/3 grnd_IDs=1 surf_IDm=3 Gapmin=1");    // 1 on 3: repeats 1 and 2, turned
  d.add("@/INTER/TYPE7/4 grnd_IDs=1 surf_IDm=1 Gapmin=1");    // 1 on itself: nothing has that
  d.add("@/INTER/TYPE2/5 grnd_IDs=3 surf_IDm=1 dsearch=9");   // a tie
  d.add("@/INTER/TYPE7/6 grnd_IDs=23 surf_IDm=12 Gapmin=1");  // as 1
  const Parted p(d);
  std::vector<std::pair<Ids, Ids>> all;
  for (const detail::RepeatedContacts& c : p.view.repeated)
    all.push_back({c.interfaces, {static_cast<std::int64_t>(c.pairs), c.part, c.other}});
  // 1 and 6: 2-1 2-2 3-1 3-2; 2-2 is the same turned. They are named together beside others.
  EXPECT_EQ(all, (std::vector<std::pair<Ids, Ids>>{{{1, 6}, {4, 2, 1}},
                                                   {{1, 2, 6}, {1, 3, 1}},
                                                   {{1, 3, 6}, {1, 3, 1}},
                                                   {{2, 3}, {1, 3, 1}}}));
}

TEST(PartsView, AContactWithOneSideIsOneWithItself) {
  SmallDeck d = ten_parts();
  d.add("@/INTER/TYPE24/1 surf_ID1=12").add("@/INTER/TYPE7/2 grnd_IDs=2 surf_IDm=1 Gapmin=1");
  const Parted p(d);
  ASSERT_EQ(p.view.repeated.size(), 1u);
  EXPECT_EQ(p.view.repeated[0].pairs, 1u);
  EXPECT_EQ(p.view.repeated[0].part, 2);
  EXPECT_EQ(p.view.repeated[0].other, 1);
}

TEST(PartsView, ARigidBodyHasThePartsAllNodesOfWhichItHas) {
  SmallDeck d = ten_parts();
  // Body 7 has the truss by its main node, body 8 the solids; body 9 has all but one node of part 1
  // and the truss once more.
  d.group("/GRNOD/NODE/80", {52}).group("/GRNOD/NODE/81", {41, 42, 43, 44, 45, 46, 47, 48, 49});
  d.group("/GRNOD/NODE/82", {11, 12, 13, 51, 52});
  d.add("@/RBODY/7 node_ID=51 grnd_ID=80\n@/RBODY/8 node_ID=98 grnd_ID=81");
  const Parted p(d.add("@/RBODY/9 node_ID=99 grnd_ID=82"));
  std::map<std::int64_t, std::int64_t> bodies;
  for (const Part& part : p.loaded.model().parts)
    if (p.part(part.id).rigid_body != 0) bodies[part.id] = p.part(part.id).rigid_body;
  EXPECT_EQ(bodies, (std::map<std::int64_t, std::int64_t>{{4, 8}, {6, 7}}));
}

TEST(PartsView, MoreThanSixtyFourRigidBodiesAreAllLookedAt) {
  SmallDeck d = ten_parts();
  for (int i = 1; i <= 66; ++i) {
    d.group(("/GRNOD/NODE/" + std::to_string(200 + i)).c_str(), {i == 66 ? 51 : 98, 52});
    d.add("@/RBODY/" + std::to_string(i) + " node_ID=99 grnd_ID=" + std::to_string(200 + i));
  }
  const Parted p(d);
  EXPECT_EQ(p.part(6).rigid_body, 66);
  EXPECT_EQ(p.part(7).rigid_body, 0);
}

}  // namespace
}  // namespace deck::test
