// From interface cards to the kernel's cards and pairs, on decks of a few elements.
#include "deck/cycle/adapter.hpp"

#include <gtest/gtest.h>

#include "contact/published.hpp"

namespace deck::cycle {
namespace {

using deck::test::Built;
using deck::test::SmallDeck;

/// A 10 x 10 plate of two shells in z = 0 and a single shell `distance` above it.
SmallDeck plates(double distance) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(5, 20, 0, 0).node(6, 20, 10, 0);
  d.node(11, 3, 3, distance).node(12, 7, 3, distance).node(13, 7, 7, distance);
  d.node(14, 3, 7, distance);
  d.shell_part(1, 1.0).shell_part(2, 2.0);
  d.shell(1, 1, 1, 2, 3, 4).shell(1, 2, 2, 5, 6, 3).shell(2, 3, 11, 12, 13, 14);
  d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/2", {1});
  return d;
}

SceneOptions with_stiffness() {
  SceneOptions o;
  o.nodal_stiffness = true;
  return o;
}

std::unique_ptr<Built> scene_of(const std::string& fields, double distance = 0.5) {
  SmallDeck d = plates(distance);
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1 " + fields);
  return std::make_unique<Built>(d, with_stiffness());
}

TEST(CycleCard, BlankDampingIsTheDefaultAndBlankFrictionStaysOff) {
  const auto b = scene_of("");
  const ContactCard c = make_card(b->scene, b->contact());
  EXPECT_EQ(c.kind, ContactKind::node_segment);
  EXPECT_DOUBLE_EQ(c.viss, 0.05);
  EXPECT_EQ(c.visf, 0.0);
  EXPECT_EQ(c.fric, 0.0);
  EXPECT_EQ(c.iform, 1);
  EXPECT_EQ(c.istf, 0);
  EXPECT_EQ(c.inacti, 0);
  EXPECT_EQ(c.gapmin, 1.0);
}

TEST(CycleCard, FrictionBringsItsTangentialDamping) {
  const auto b = scene_of("Fric=0.2");
  const ContactCard c = make_card(b->scene, b->contact());
  EXPECT_DOUBLE_EQ(c.fric, 0.2);
  EXPECT_EQ(c.visf, 1.0);
}

TEST(CyclePairs, MainStiffnessIsYoungTimesThickness) {
  const auto b = scene_of("");
  const ContactCard c = make_card(b->scene, b->contact());
  const ContactPairs p = make_pairs(b->scene, b->contact(), c, Model::reference);
  ASSERT_EQ(p.size(), 4u);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_DOUBLE_EQ(p.k0[i], 200.0 * 1.0);
    EXPECT_EQ(p.gap[i], 1.0);
    EXPECT_EQ(p.p0[i], 0.0);
  }
}

TEST(CyclePairs, MeanStiffnessTakesBothSides) {
  const auto b = scene_of("Istf=2");
  const ContactCard c = make_card(b->scene, b->contact());
  const ContactPairs p = make_pairs(b->scene, b->contact(), c, Model::reference);
  ASSERT_EQ(p.size(), 4u);
  // Main 200 x 1, secondary node in one shell 200 x 2.
  EXPECT_DOUBLE_EQ(p.k0[0], 300.0);
}

TEST(CyclePairs, GapReductionStartsWithThePenetration) {
  const auto b = scene_of("Inacti=5");
  const ContactCard c = make_card(b->scene, b->contact());
  const ContactPairs p = make_pairs(b->scene, b->contact(), c, Model::reference);
  ASSERT_EQ(p.size(), 4u);
  for (const double p0 : p.p0) EXPECT_NEAR(p0, 0.5, 1e-7);
}

TEST(CyclePairs, WhatStartUpSwitchedOffTakesNoPart) {
  for (const char* inacti : {"Inacti=1", "Inacti=2"}) {
    const auto b = scene_of(inacti);
    const ContactCard c = make_card(b->scene, b->contact());
    EXPECT_EQ(make_pairs(b->scene, b->contact(), c, Model::reference).size(), 0u) << inacti;
  }
}

TEST(CyclePairs, NodesBeyondTheGapAreOutOfReach) {
  const auto b = scene_of("", 1.5);
  const ContactCard c = make_card(b->scene, b->contact());
  EXPECT_EQ(make_pairs(b->scene, b->contact(), c, Model::reference).size(), 0u);
}

TEST(CyclePairs, PairsDoNotDependOnThreads) {
  const auto b = scene_of("Istf=4");
  const ContactCard c = make_card(b->scene, b->contact());
  const ContactPairs one = make_pairs(b->scene, b->contact(), c, Model::reference, 1);
  const ContactPairs four = make_pairs(b->scene, b->contact(), c, Model::reference, 4);
  EXPECT_EQ(one.at, four.at);
  EXPECT_EQ(one.k0, four.k0);
}

/// The pairs that start-up has judged against those of a search, for which a copy of all places
/// will do.
void expect_searched_pairs(const Built& b, const std::string& what) {
  const Coordinates copy = b.scene.coordinates;
  PairSearch search;
  search.at = &copy;
  for (const deck::Contact& contact : b.scene.contacts) {
    const ContactCard c = make_card(b.scene, contact);
    EXPECT_EQ(make_pairs(b.scene, contact, c, Model::reference).at,
              make_pairs(b.scene, contact, c, Model::reference, 1, search).at)
        << what << ", " << to_string(contact.role);
  }
}

TEST(CyclePairs, WhatStartUpHasJudgedIsWhatASearchFinds) {
  for (const char* card :
       {"", "Inacti=1", "Inacti=2", "Inacti=3", "Inacti=5", "Igap=2", "Fpenmax=0.3"})
    for (const double distance : {0.0, 0.5, 1.0, 1.5})
      expect_searched_pairs(*scene_of(card, distance), card + std::to_string(distance));
  for (const Accuracy accuracy :
       {Accuracy::fast, Accuracy::reference, Accuracy::robust, Accuracy::exact}) {
    SmallDeck strip = deck::test::bent_strip();
    strip.add("@/INTER/TYPE7/1 Gapmin=1.2").add("@/INTER/TYPE7/2 Gapmin=1.2 Irem_gap=2");
    SmallDeck edges = plates(0.5);
    edges.group("/SURF/PART/3", {2});
    edges.add("@/INTER/TYPE19/1 surf_IDs=3 surf_IDm=2 Gapmin=4");
    SceneOptions o = with_stiffness();
    o.accuracy = accuracy;
    expect_searched_pairs(Built(strip, o), "strip");
    expect_searched_pairs(Built(edges, o), "edges");
  }
}

// A triangle without area that the solver's formula sees 30.1 away where it is 15.9, a good one,
// and a square with a node over its last corner.
TEST(CyclePairs, OfContactsThatTheSolverMissesAreNoneOfTheSearch) {
  SmallDeck d;
  d.node(1, -2, 1, 0).node(2, -15, -11, 0).node(3, 11, 13, 0).node(101, 3, -16, 0);
  d.node(11, 1000, 0, 0).node(12, 1100, 0, 0).node(13, 1100, 100, 0).node(14, 1000, 100, 0);
  d.node(21, 2000, 0, 0).node(22, 2100, 0, 0).node(23, 2000, 100, 0);
  d.node(102, 1003, 95, 5).node(103, 2040, 40, 7).node(104, 2040, 40, 22);
  d.shell_part(1, 2).shell3(1, 1, 1, 2, 3).shell(1, 2, 11, 12, 13, 14).shell3(1, 3, 21, 22, 23);
  d.segments("/SURF/SEG/1", {{1, 2, 3, 3}, {11, 12, 13, 14}, {21, 22, 23, 23}});
  d.group("/GRNOD/NODE/2", {101, 102, 103, 104}).add("@/INTER/TYPE7/1 Gapmin=21");
  const Built b(d, with_stiffness());
  EXPECT_EQ(b.contact().penetrations.size(), 3u);
  EXPECT_EQ(b.scene.decisions.contact_differs, 1u);
  expect_searched_pairs(b, "missed");
  const ContactCard card = make_card(b.scene, b.contact());
  EXPECT_EQ(make_pairs(b.scene, b.contact(), card, Model::reference).size(), 2u);
}

TEST(CyclePairs, WhatIremGapKeepsApartMakesNoForce) {
  // A strip bent over, in contact with itself: as many pairs as start-up counts penetrations.
  SmallDeck d = deck::test::bent_strip();
  d.add("@/INTER/TYPE7/1 Gapmin=1.2").add("@/INTER/TYPE7/2 Gapmin=1.2 Irem_gap=2");
  const Built b(d, with_stiffness());
  const auto pairs = [&](std::int64_t id) {
    const auto& contact = b.contact(id);
    return make_pairs(b.scene, contact, make_card(b.scene, contact), Model::reference).size();
  };
  EXPECT_EQ(pairs(1), b.contact(1).penetrations.size());
  EXPECT_EQ(pairs(2), b.contact(2).penetrations.size());
  EXPECT_LT(pairs(2), pairs(1));
}

TEST(CycleCard, EdgesOfATwoSurfaceContactFollowTheEdgeRules) {
  SmallDeck d = plates(0.5);
  d.group("/SURF/PART/3", {2});
  d.add("@/INTER/TYPE19/1 surf_IDs=3 surf_IDm=2 Gapmin=1 Fric=0.1 Ifric=1 C1=1e-3");
  const Built b(d, with_stiffness());
  const ContactCard nodes = make_card(b.scene, b.contact());
  const ContactCard edges = make_card(b.scene, b.contact(1, ContactRole::edges));
  EXPECT_EQ(nodes.kind, ContactKind::node_segment);
  EXPECT_EQ(edges.kind, ContactKind::edge_edge);
  EXPECT_EQ(nodes.istf, 0);
  EXPECT_EQ(edges.istf, 5);
  EXPECT_EQ(nodes.ifric, 1);
  EXPECT_EQ(edges.ifric, 0);
  EXPECT_DOUBLE_EQ(edges.fric, 0.1);
}

TEST(CyclePairs, EdgeStiffnessIsInSeries) {
  SmallDeck d = plates(0.5);
  d.group("/SURF/PART/3", {2});
  d.add("@/INTER/TYPE19/1 surf_IDs=3 surf_IDm=2 Gapmin=4");
  const Built b(d, with_stiffness());
  const Contact& contact = b.contact(1, ContactRole::edges);
  const ContactCard c = make_card(b.scene, contact);
  const ContactPairs p = make_pairs(b.scene, contact, c, Model::reference);
  ASSERT_GT(p.size(), 0u);
  for (const double k : p.k0) EXPECT_DOUBLE_EQ(k, 200.0 * 400.0 / 600.0);
}

}  // namespace
}  // namespace deck::cycle
