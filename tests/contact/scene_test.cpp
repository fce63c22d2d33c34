// Interfaces as elementary contacts: TYPE19 and its parts, order, options, nodes at one place;
// pairs close along the mesh that Irem_gap leaves out; contacts without room for their pairs, or of
// which something is not evaluated here; what the mesh decides, handed back to the interfaces.
#include <gtest/gtest.h>

#include <string>

#include "contact/meshes.hpp"
#include "contact/published.hpp"
#include "contact/small_deck.hpp"
#include "deck/contacts.hpp"
#include "deck/rule_id.hpp"

namespace deck::test {
namespace {

/// A 3 x 3 plate (part 1, t = 2) and a 2 x 2 plate above it (part 2, t = 1.2).
SmallDeck two_plates() {
  SmallDeck d;
  d.shell_part(1, 2).shell_part(2, 1.2);
  add_sheet(d, 1, 1, 1, 3, 3, [](int i, int j) { return std::array{10.0 * i, 6.0 * j, 0.0}; });
  add_sheet(d, 2, 10, 101, 2, 2, [](int i, int j) {
    return std::array{4 + 7.0 * i, 3 + 7.0 * j, 0.9 + 0.05 * i};
  });
  d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2}).group("/SURF/PART/3", {1, 2});
  return d.group("/GRNOD/SURF/2", {2}).group("/LINE/SURF/1", {1}).group("/LINE/SURF/2", {2});
}

TEST(Type19, PartsOfThePublishedExample) {
  const Built b(two_plates().add("@/INTER/TYPE19/1 surf_IDs=2 surf_IDm=1"));
  ASSERT_EQ(b.scene.contacts.size(), 3u);
  using R = ContactRole;
  struct Part {
    R role;
    std::size_t secondary, main;
    double gapmin;
    std::size_t penetrations;
  };
  for (const Part& p : {Part{R::primary, 9, 9, 2, 12}, Part{R::reversed, 16, 4, 1.2, 2},
                        Part{R::edges, 12, 24, 1.6, 24}}) {
    const Contact& c = b.contact(1, p.role);
    EXPECT_EQ(c.secondary.size() + c.secondary_edges.size(), p.secondary) << to_string(p.role);
    EXPECT_EQ(c.main.size() + c.main_edges.size(), p.main) << to_string(p.role);
    EXPECT_DOUBLE_EQ(c.gapmin, p.gapmin) << to_string(p.role);
    EXPECT_EQ(c.penetrations.size(), p.penetrations) << to_string(p.role);
  }
  EXPECT_EQ(b.contact(1, R::primary).candidates, 24u);
  EXPECT_EQ(b.contact(1, R::reversed).candidates, 11u);
}

TEST(Type19, OneSurfaceGivesNoReversedPart) {
  const Built b(two_plates()
                    .add("@/INTER/TYPE19/1 surf_IDs=3 surf_IDm=3")
                    .add("@/INTER/TYPE19/2 surf_IDs=0 surf_IDm=3")
                    .add("@/INTER/TYPE19/3 surf_IDs=3 surf_IDm=0"));
  for (const int id : {1, 2, 3}) {
    EXPECT_EQ(b.contact(id, ContactRole::primary).secondary.size(), 25u) << id;
    EXPECT_EQ(b.contact(id, ContactRole::primary).main.size(), 13u) << id;
    EXPECT_EQ(b.contact(id, ContactRole::edges).main_edges.size(), 36u) << id;
  }
  for (const Contact& c : b.scene.contacts) EXPECT_NE(c.role, ContactRole::reversed);
}

TEST(Type19, FurtherPartsFollowAllInterfacesOfTheDeck) {
  const Built b(two_plates()
                    .add("@/INTER/TYPE19/5 surf_IDs=2 surf_IDm=1")
                    .add("@/INTER/TYPE7/3")
                    .add("@/INTER/TYPE19/4 surf_IDs=2 surf_IDm=1")
                    .add("@/INTER/TYPE11/1"));
  std::vector<std::pair<std::int64_t, ContactRole>> order;
  for (const Contact& c : b.scene.contacts) order.emplace_back(c.inter->id, c.role);
  using R = ContactRole;
  const std::vector<std::pair<std::int64_t, ContactRole>> expected = {
      {1, R::primary},  {3, R::primary}, {4, R::primary},  {5, R::primary},
      {4, R::reversed}, {4, R::edges},   {5, R::reversed}, {5, R::edges}};
  EXPECT_EQ(order, expected);
}

TEST(Type19, GapOptionsOfTheEdgePart) {
  const Built b(two_plates()
                    .add("@/INTER/TYPE19/1 surf_IDs=2 surf_IDm=1 Igap=2 Fscalegap=0.8 Inacti=5")
                    .add("@/INTER/TYPE19/2 surf_IDs=2 surf_IDm=1 Igap=3")
                    .add("@/INTER/TYPE19/3 surf_IDs=2 surf_IDm=1 Gapmin=1"));
  using R = ContactRole;
  const Contact& edges = b.contact(1, R::edges);
  EXPECT_EQ(edges.igap, 1) << "2 ends as 1";
  EXPECT_EQ(edges.gap_scale, 1) << "Fscalegap does not act on edges";
  EXPECT_EQ(std::tuple(edges.istf, edges.inacti), std::tuple(5, 5));
  EXPECT_EQ(b.contact(2, R::edges).igap, 3);
  const double gapmin[] = {0.8 * 2, 0.8 * 1.2, 1.6};
  for (const R r : {R::primary, R::reversed, R::edges}) {
    EXPECT_DOUBLE_EQ(b.contact(1, r).gapmin, gapmin[static_cast<int>(r)]) << to_string(r);
    EXPECT_DOUBLE_EQ(b.contact(3, r).gapmin, 1);
  }
}

TEST(Type19, WithoutEdgesThePartIsDropped) {
  const Built b(
      two_plates().group("/SURF/PART/9", {77}).add("@/INTER/TYPE19/1 surf_IDs=2 surf_IDm=9"));
  EXPECT_TRUE(b.contact(1, ContactRole::edges).dropped);
}

TEST(Type11, TakesEveryEdgeOfASurfaceOnceFreeOnesOnRequest) {
  SmallDeck d = two_plates();
  d.group("/LINE/EDGE/5", {1});
  d.add("@/INTER/TYPE11/1 line_IDs=1 line_IDm=5").add("@/INTER/TYPE11/2 line_IDs=2 line_IDm=0");
  const Built b(d);
  EXPECT_EQ(b.contact(1).secondary_edges.size(), 24u);
  EXPECT_EQ(b.contact(1).main_edges.size(), 12u);
  EXPECT_EQ(b.contact(2).secondary_edges.size(), 12u);
  EXPECT_EQ(b.contact(2).main_edges.size(), 12u) << "without a main line it meets itself";
}

TEST(Scene, OfSomeInterfacesHasTheContactsOfThese) {
  SceneOptions options;
  options.only = {7};
  const Built b(two_plates()
                    .add("@/INTER/TYPE7/3")
                    .add("@/INTER/TYPE19/7 surf_IDs=2 surf_IDm=1")
                    .add("@/INTER/TYPE19/8 surf_IDs=2 surf_IDm=1"),
                options);
  ASSERT_EQ(b.scene.contacts.size(), 3u);
  for (const Contact& c : b.scene.contacts) EXPECT_EQ(c.inter->id, 7);
}

/// Shells whose nodes all lie at one place, and their contact with themselves.
SmallDeck at_one_place(int shells) {
  SmallDeck d;
  for (int n = 1; n <= 4 * shells; ++n) d.node(n, 50, 0.1, -7);
  d.shell_part(1, 2);
  for (int e = 0; e < shells; ++e) d.shell(1, 1 + e, 4 * e + 1, 4 * e + 2, 4 * e + 3, 4 * e + 4);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/PART/2", {1}).group("/LINE/SURF/1", {1});
  return d;
}

TEST(NodesAtOnePlace, AreDecidedWithoutAnyArithmeticAndReportedOnce) {
  for (const char* card : {"@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1",
                           "@/INTER/TYPE11/1 line_IDs=1 line_IDm=1 Gapmin=1"}) {
    const Built b(at_one_place(10).add(card));
    EXPECT_GE(b.contact().penetrations.size(), 360u) << card;
    EXPECT_EQ(b.scene.decisions.fallback + b.scene.decisions.exact, 0u) << card;
    for (const PenetrationRow& r : b.contact().penetrations) EXPECT_TRUE(r.on_surface);
    EXPECT_EQ(b.findings.counts().at(RuleId::DK336), 1u) << card;
  }
}

TEST(CurvilinearRemoval, CountsOfThePublishedExample) {
  const Built b(bent_strip()
                    .add("@/INTER/TYPE7/1 Gapmin=1.2 Inacti=6")
                    .add("@/INTER/TYPE7/2 Gapmin=1.2 Inacti=6 Irem_gap=2")
                    .add("@/INTER/TYPE11/9 line_IDs=1 line_IDm=1 Gapmin=1.2 Irem_gap=2")
                    .add("@/INTER/TYPE11/10 line_IDs=1 line_IDm=1 Gapmin=1.2"));
  EXPECT_EQ(b.contact(1).candidates, 72u);
  EXPECT_EQ(b.contact(1).penetrations.size(), 52u);
  EXPECT_EQ(b.contact(2).candidates, 40u);
  EXPECT_EQ(b.contact(2).penetrations.size(), 20u);
  EXPECT_EQ(b.contact(9).penetrations.size(), 32u);
  EXPECT_EQ(b.contact(10).penetrations.size(), 180u);
}

TEST(CurvilinearRemoval, VariableGapUsesThePairGap) {
  // Pair gap 0.8 everywhere: reach 1.131 takes in one column of nodes beside each segment, while
  // the reach of a constant gap of 1.2 is 1.697.
  const Built b(bent_strip()
                    .add("@/INTER/TYPE7/1 Igap=1 Gapmin=0.1")
                    .add("@/INTER/TYPE7/2 Igap=1 Gapmin=0.1 Irem_gap=2"));
  const Contact &all = b.contact(1), &kept = b.contact(2);
  EXPECT_EQ(all.candidates, kept.candidates + kept.removed_pairs);
  EXPECT_GT(kept.removed_pairs, 0u);
  for (const PenetrationRow& r : kept.penetrations) EXPECT_NEAR(r.gap, 0.8, 1e-15);
}

TEST(CurvilinearRemoval, NoRingIsExpandedBelowTheShortestSide) {
  // sqrt(2) * 0.5 is less than the shortest side 0.78: nothing is removed.
  const Built b(bent_strip().add("@/INTER/TYPE7/1 Gapmin=0.5 Irem_gap=2"));
  EXPECT_EQ(b.contact().removed_pairs, 0u);
}

SceneOptions with_room(std::uint64_t bytes) {
  SceneOptions o;
  o.limits.pair_bytes = bytes;
  return o;
}

/// A quad of 3 by 4 and a triangle of 3, 4 and 5 with nodes over them; the surface has both.
SmallDeck quad_and_triangle(int nodes) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 3, 0, 0).node(3, 3, 4, 0).node(4, 0, 4, 0);
  d.node(5, 100, 0, 0).node(6, 103, 0, 0).node(7, 100, 4, 0);
  std::vector<int> ids;
  for (int k = 0; k < nodes; ++k) {
    ids.push_back(101 + k);
    d.node(101 + k, 1.5 + 0.001 * k, 2, 0.5);
  }
  d.shell_part(1, 1).shell(1, 1, 1, 2, 3, 4).shell3(1, 2, 5, 6, 7);
  d.segments("/SURF/SEG/1", {{1, 2, 3, 4}, {5, 6, 7, 7}}).group("/GRNOD/NODE/2", ids);
  return d.add("@/INTER/TYPE7/1 Gapmin=13");
}

TEST(RoomForPairs, IsThatOfFourCopiesOfEach) {
  const std::uint64_t least = 5 * 4 * sizeof(CandidatePair);
  const SmallDeck d = quad_and_triangle(5);
  const Built enough(d, with_room(least));
  EXPECT_TRUE(enough.contact().evaluated);
  EXPECT_EQ(enough.contact().penetrations.size(), 5u);
  EXPECT_EQ(enough.contact().candidates, 5u);
  const Built less(d, with_room(least - 1));
  EXPECT_FALSE(less.contact().evaluated);
  EXPECT_EQ(less.contact().penetrations.size(), 0u);
  EXPECT_EQ(less.contact().candidates, 0u);
}

TEST(RoomForPenetrations, OfNodesIsLookedAtAfterEachGroupOf128Candidates) {
  const SmallDeck d = quad_and_triangle(130);
  const std::uint64_t group = 128 * sizeof(PenetrationRow);
  ASSERT_GT(group, 130 * 4 * sizeof(CandidatePair)) << "the pairs themselves have room";
  EXPECT_EQ(Built(d, with_room(group)).contact().penetrations.size(), 130u);
  const Built less(d, with_room(group - 1));
  EXPECT_FALSE(less.contact().evaluated);
  EXPECT_EQ(less.contact().penetrations.size(), 0u);
  EXPECT_EQ(less.contact().candidates, 0u);
  EXPECT_TRUE(Built(quad_and_triangle(128), with_room(group - 1)).contact().evaluated);
}

TEST(RoomForPenetrations, OfEdgesIsThatOfAllOfThem) {
  const SmallDeck d = published_edges().add("@/INTER/TYPE11/1 line_IDs=2 line_IDm=1 Inacti=5");
  const Built all(d);
  const std::size_t count = all.contact().penetrations.size();
  ASSERT_GE(count, 2u);
  EXPECT_EQ(Built(d, with_room(count * sizeof(PenetrationRow))).contact().penetrations.size(),
            count);
  const Built less(d, with_room(count * sizeof(PenetrationRow) - 1));
  EXPECT_FALSE(less.contact().evaluated);
  EXPECT_EQ(less.contact().penetrations.size(), 0u);
  EXPECT_EQ(less.contact().candidates, 0u);
}

/// A square of part 1, and a square of part 2 at height `z` above it.
SmallDeck squares(double z) {
  SmallDeck d;
  for (int k = 0; k < 2; ++k) {
    const double at = k * z, from = k * 2.0, to = 10 - k * 2.0;
    d.node(10 * k + 1, from, from, at).node(10 * k + 2, to, from, at);
    d.node(10 * k + 3, to, to, at).node(10 * k + 4, from, to, at);
    d.shell_part(k + 1, 1).shell(k + 1, k + 1, 10 * k + 1, 10 * k + 2, 10 * k + 3, 10 * k + 4);
  }
  return d.group("/SURF/PART/1", {1}).group("/GRNOD/PART/2", {2});
}

/// Evaluated, and the number of findings that say why not.
std::pair<bool, std::size_t> judged(const Built& b) {
  std::size_t said = 0;
  for (const Finding& d : b.findings.all()) said += d.rule == RuleId::DK380;
  return {b.scene.contacts.at(0).evaluated, said};
}
constexpr std::pair<bool, std::size_t> yes{true, 0}, no{false, 1};

TEST(NotEvaluated, SidesOfSetsGroupsPartsAndTransformsThatAreNot) {
  const auto set = [](const std::string& clauses) { return "/SET/GENERAL/9\nset\n" + clauses; };
  const std::string part = "PART               2\n", unknown = "PART_C             2\n",
                    contact = "@/INTER/TYPE7/1 Gapmin=1 grnd_IDs=",
                    groups =
                        "/GRNOD/GRNOD/7\ng\n         9\n/SURF/SURF/8\ns\n         9\n"
                        "/GRNOD/GRNOD/6\ng\n         7\n",
                    particle =
                        "/PROP/SHELL/3\np\n\n\n                 1.0\n"
                        "/PART/3\np\n         3         1\n/SPHCEL/3\n        31\n",
                    move = "                 0.0                 0.0                -4.5\n\n";
  const std::pair<std::string, std::pair<bool, std::size_t>> cases[] = {
      {set(part) + contact + "9", yes},
      {set(part + "RBODY              5\n") + contact + "9", no},
      {set("PART_B             2\n") + contact + "9", no},
      {set(part) + groups + contact + "6", yes},
      {set(unknown) + groups + contact + "6", no},
      {set(unknown) + groups + "@/INTER/TYPE19/1 surf_IDs=8 Gapmin=1", no},
      {set(unknown) + groups + contact + "2", yes},
      {particle + "/GRNOD/PART/9\ng\n         2\n" + contact + "9", yes},
      {particle + "/GRNOD/PART/9\ng\n         3\n" + contact + "9", no},
      {"/TRANSFORM/TRA/1\nmove\n         2" + move + contact + "2", yes},
      {"/TRANSFORM/POSITION/1\nmove\n         2" + move + contact + "2", no}};
  for (const auto& [cards, wanted] : cases)
    EXPECT_EQ(judged(Built(squares(5).node(31, 5, 5, 0.5).add(cards))), wanted) << cards;
}

TEST(NotEvaluated, SmoothedSides) {
  for (const int ists : {0, 1}) {
    std::string text = squares(5).add("@/INTER/TYPE7/1 grnd_IDs=2 Gapmin=1").text();
    const auto version = text.find("      2022");
    ASSERT_NE(version, std::string::npos);
    text.replace(version, 10, "      2026");
    // The line behind title, sides and flags, with the comments above them.
    std::size_t line = text.find("/INTER/TYPE7/1");
    for (int k = 0; k < 5; ++k) line = text.find('\n', line) + 1;
    text.replace(line, text.find('\n', line) - line, fmt::sprintf("%100d", ists));
    EXPECT_EQ(judged(Built(text)), ists == 0 ? yes : no);
  }
}

TEST(Resolve, GivesABlankGapTheDefaultOfTheMeshAndLeavesThatOfTheCardAlone) {
  Built b(plate_and_nodes("@/INTER/TYPE7/1\n@/INTER/TYPE7/2 Gapmin=0.5\n@/INTER/TYPE10/3"));
  const EffectiveReal &blank = b.interfaces.type7.at(0).Gapmin,
                      &given = b.interfaces.type7.at(1).Gapmin;
  EXPECT_EQ(std::tuple(blank.origin, blank.value), std::tuple(Origin::geometry, 0.0));
  EXPECT_TRUE(waits_for_geometry(b.interfaces));
  b.loaded.mesh_values();
  EXPECT_EQ(std::tuple(blank.value, blank.before_geometry()), std::tuple(2.0, 0.0));
  EXPECT_EQ(std::tuple(given.origin, given.value, given.before_geometry()),
            std::tuple(Origin::card, 0.5, 0.5));
  EXPECT_EQ(b.interfaces.type10.at(0).Gap.value, 2);
  EXPECT_TRUE(b.interfaces.type7.at(0).resolved);
  EXPECT_FALSE(waits_for_geometry(b.interfaces));
}

TEST(Resolve, TellsThePartsOfAType19Apart) {
  Built b(plate_and_nodes("@/INTER/TYPE19/1 Edge_scale_gap=0.5"));
  b.loaded.mesh_values();
  const InterType19& inter = b.interfaces.type19.at(0);
  EXPECT_EQ(inter.Gapmin.value, geometry_value(*first_contact(b.scene, inter), "Gapmin"));
  EXPECT_EQ(first_contact(b.scene, inter)->role, ContactRole::primary);
}

TEST(Resolve, ASecondSceneOfResolvedInterfacesIsTheFirst) {
  Built b(plate_and_nodes("@/INTER/TYPE7/1 Igap=2 Fscalegap=0.7"));
  b.loaded.mesh_values();
  Findings findings;
  const Scene again = build_scene(b.model, b.interfaces, findings);
  EXPECT_EQ(again.contacts.at(0).gapmin, b.contact().gapmin);
  EXPECT_EQ(again.contacts.at(0).gapmin_origin, GapminOrigin::scaled_thickness);
}

TEST(Resolve, InterfacesOutsideTheSceneStayOpen) {
  Built b(plate_and_nodes("@/INTER/TYPE7/1\n@/INTER/TYPE7/2"));
  SceneOptions options;
  options.only = {2};
  Findings ignored;
  Interfaces interfaces = read_interfaces(b.deck, b.model, ignored);
  resolve(interfaces, build_scene(b.model, interfaces, ignored, options));
  EXPECT_FALSE(interfaces.type7.at(0).resolved);
  EXPECT_TRUE(interfaces.type7.at(1).resolved);
  EXPECT_TRUE(waits_for_geometry(interfaces));
}

}  // namespace
}  // namespace deck::test
