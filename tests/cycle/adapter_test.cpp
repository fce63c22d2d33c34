// From interface cards to the kernel's cards and pairs, on decks of a few elements.
#include "deck/cycle.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "contact/published.hpp"
#include "cycle/plates.hpp"

namespace deck::cycle {
namespace {

using deck::test::Built;
using deck::test::SmallDeck;
using testing::with_stiffness;

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

std::unique_ptr<Built> scene_of(const std::string& fields, double distance = 0.5) {
  SmallDeck d = plates(distance);
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1 " + fields);
  return std::make_unique<Built>(d, with_stiffness());
}

TEST(CycleCard, BlankDampingIsTheDefaultAndBlankFrictionStaysOff) {
  const auto blank = scene_of(""), rubbing = scene_of("Fric=0.2");
  const ContactCard c = make_card(blank->scene, blank->contact());
  EXPECT_EQ(std::tuple(c.kind, c.viss, c.visf, c.fric, c.iform, c.istf, c.inacti, c.gapmin),
            std::tuple(ContactKind::node_segment, 0.05, 0.0, 0.0, 1, 0, 0, 1.0));
  const ContactCard r = make_card(rubbing->scene, rubbing->contact());
  EXPECT_EQ(std::tuple(r.fric, r.visf), std::tuple(0.2, 1.0)) << "friction brings its damping";
}

TEST(CyclePairs, HaveTheStiffnessOfTheirSidesAndTheReducedGap) {
  struct Case {
    const char* fields;
    double height;
    std::size_t pairs;
    double k0, p0;
  };
  const Case cases[] = {{"", 0.5, 4, 200 * 1, 0},  // Young's modulus times thickness
                        {"Istf=2", 0.5, 4, 0.5 * (200 * 1 + 200 * 2), 0},
                        {"Inacti=5", 0.5, 4, 200, 0.5},
                        {"Inacti=1", 0.5, 0, 0, 0},
                        {"Inacti=2", 0.5, 0, 0, 0},
                        {"", 1.5, 0, 0, 0}};
  for (const Case& c : cases) {
    const auto b = scene_of(c.fields, c.height);
    const ContactCard card = make_card(b->scene, b->contact());
    const ContactPairs p = make_pairs(b->scene, b->contact(), card, Model::reference);
    EXPECT_EQ(p.size(), c.pairs) << c.fields << c.height;
    for (std::size_t i = 0; i < p.size(); ++i) {
      EXPECT_DOUBLE_EQ(p.k0[i], c.k0) << c.fields;
      EXPECT_EQ(p.gap[i], 1.0);
      EXPECT_NEAR(p.p0[i], c.p0, 1e-7) << c.fields;
    }
    EXPECT_EQ(make_pairs(b->scene, b->contact(), card, Model::reference, 4).at, p.at);
  }
}

/// The pairs that start-up has judged against those of a search on a copy of all places.
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

TEST(CyclePairs, EdgesOfATwoSurfaceContactFollowTheEdgeRules) {
  SmallDeck d = plates(0.5);
  d.group("/SURF/PART/3", {2});
  d.add("@/INTER/TYPE19/1 surf_IDs=3 surf_IDm=2 Gapmin=4 Fric=0.1 Ifric=1 C1=1e-3");
  const Built b(d, with_stiffness());
  const Contact& contact = b.contact(1, ContactRole::edges);
  const ContactCard nodes = make_card(b.scene, b.contact()), edges = make_card(b.scene, contact);
  EXPECT_EQ(std::tuple(nodes.kind, nodes.istf, nodes.ifric, nodes.fric),
            std::tuple(ContactKind::node_segment, 0, 1, 0.1));
  EXPECT_EQ(std::tuple(edges.kind, edges.istf, edges.ifric, edges.fric),
            std::tuple(ContactKind::edge_edge, 5, 0, 0.1));
  const ContactPairs p = make_pairs(b.scene, contact, edges, Model::reference);
  ASSERT_GT(p.size(), 0u);
  for (const double k : p.k0) EXPECT_DOUBLE_EQ(k, 200.0 * 400.0 / 600.0) << "in series";
}

}  // namespace
}  // namespace deck::cycle
