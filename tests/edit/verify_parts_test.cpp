// Verification notices every figure of contacts, forces, masses and steps that is another one, and
// what differs by no more than cells can hold is the same: copies of a deck with one figure
// changed.
#include <gmock/gmock.h>

#include <functional>

#include "contact/small_deck.hpp"
#include "edit/verify/verify_parts.hpp"

namespace deck::test {
namespace {

using detail::DeckComparison;
using ::testing::HasSubstr;

/// Two nodes over a plate in a TYPE7, and a truss over one of its sides in a TYPE11.
SmallDeck two_contacts() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(8, 5, 6, 0.75).node(9, 5, 5, 0.5).node(11, 5, -5, 0.5).node(12, 5, 5, 0.5);
  d.shell_part(1, 2).shell(1, 21, 1, 2, 3, 4).truss_part(2, 1).bar("TRUSS", 2, 23, 11, 12);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {8, 9}).segments("/LINE/SEG/3", {{11, 12}});
  d.segments("/LINE/SEG/4", {{1, 2}})
      .add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.5 Inacti=6");
  return d.add("@/INTER/TYPE11/2 line_IDs=3 line_IDm=4 Gapmin=2.5");
}

/// What was made of a deck, to be changed.
struct Copy {
  Copy(const LoadedDeck& deck, const Behaviour::Parts& p)
      : scene(p.scene), state(p.state), cycle(p.cycle), parts{deck,    scene,       state,   cycle,
                                                              p.steps, p.part_mass, p.extent} {}
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;
  Contact& contact(std::size_t i) { return scene.contacts.at(i); }
  Scene scene;
  cycle::State state;
  cycle::SceneOutcome cycle;
  Behaviour::Parts parts;
};

/// A deck before and after.
struct Pair {
  /// The first difference in contacts, masses and steps.
  std::string difference(const VerifyRelation& relation = {}) const {
    const DeckComparison c(was.parts, now.parts, relation);
    if (const auto d = c.values()) return *d;
    if (const auto d = c.contacts()) return *d;
    if (const auto d = c.masses()) return *d;
    return c.time_steps().value_or("");
  }
  Built b{two_contacts()};
  Behaviour behaviour{b.loaded};
  Copy was{b.loaded, behaviour.parts()}, now{b.loaded, behaviour.parts()};
};

TEST(VerifiedFigures, AreEachNoticed) {
  using Change = std::function<void(Copy&)>;
  const std::pair<Change, const char*> changes[] = {
      {[](Copy& p) { p.contact(0).evaluated = false; }, "is examined in one of the decks only"},
      {[](Copy& p) { p.contact(1).dropped = true; }, "is examined in one of the decks only"},
      {[](Copy& p) { p.contact(0).gapmin *= 1.001; }, "Gapmin in force is 1.5015, expected 1.5"},
      {[](Copy& p) { p.contact(0).factor *= 2; }, "the factor of the stiffness of "},
      {[](Copy& p) { p.contact(0).main[0].gap += 0.5; }, "a gap of "},
      {[](Copy& p) { p.contact(0).main[0].stiffness *= 1.001; }, "a stiffness of "},
      {[](Copy& p) { p.contact(0).main[0].stiffness *= -1; }, "a stiffness of "},
      {[](Copy& p) { p.contact(0).secondary[1].gap += 0.5; }, "a gap of "},
      {[](Copy& p) { p.contact(0).secondary[1].nodal_stiffness += 0.5; }, "a stiffness of "},
      {[](Copy& p) { p.contact(1).main_edges[0].gap += 0.5; }, "a gap of "},
      {[](Copy& p) { p.contact(1).main_edges[0].stiffness *= 1.001; }, "a stiffness of "},
      {[](Copy& p) { p.contact(1).secondary_edges[0].stiffness *= 1.001; }, "a stiffness of "},
      {[](Copy& p) { p.contact(0).secondary.pop_back(); }, "the secondary side of "},
      {[](Copy& p) { p.contact(0).main.clear(); }, " has 0 entries, expected 4"},
      {[](Copy& p) { std::swap(p.contact(0).secondary[0].node, p.contact(0).secondary[1].node); },
       "node 9 is in the place of another one"},
      {[](Copy& p) { p.contact(0).penetrations[0].gap += 1e-3; }, "the gap of "},
      {[](Copy& p) { p.contact(0).penetrations[0].depth += 1e-3; }, "the penetration of "},
      {[](Copy& p) { p.contact(0).penetrations[1].gap0 += 1e-3; }, "the gap left of "},
      {[](Copy& p) { p.contact(0).penetrations[1].action = PenetrationAction::node_moved; },
       "is node-moved, expected gap-reduced"},
      {[](Copy& p) { p.contact(0).penetrations.erase(p.contact(0).penetrations.begin()); },
       "a pair that penetrated by 0.75 no longer penetrates"},
      {[](Copy& p) { p.contact(1).penetrations.clear(); },
       "a pair that penetrated by 2 no longer penetrates"},
      {[](Copy& p) {
         PenetrationRow more = p.contact(1).penetrations[0];
         more.main = 7;
         p.contact(1).penetrations.push_back(more);
       },
       "node 11 penetrates by 2; it did not before"},
      {[](Copy& p) { p.scene.contacts.pop_back(); }, "the deck has 1 contacts, expected 2"},
      {[](Copy& p) { p.cycle.contacts[0].totals.total_abs += 1; }, "in the first cycle is "},
      {[](Copy& p) { p.cycle.contacts[1].totals.normal[2] += 1; }, "the normal force of "},
      {[](Copy& p) { p.cycle.contacts[0].totals.tangential[1] += 1; }, "the tangential force of "},
      {[](Copy& p) { p.cycle.nodes.force[1][3] += 1; },
       "the contact force at node 4 is 1, expected 0"},
      {[](Copy& p) { p.state.mass[2] *= 1.01; }, "the mass of node 3 is "},
      {[](Copy& p) { p.state.mass.pop_back(); }, "the deck has 7 nodes, expected 8"},
      {[](Copy& p) { p.parts.part_mass[1] += 1; }, "the mass of part 2 is "},
      {[](Copy& p) { p.parts.part_mass.pop_back(); }, "the deck has 1 parts, expected 2"},
      {[](Copy& p) { p.parts.steps[0][0] *= 1.01; }, "the time step of element 21 is "},
      {[](Copy& p) { p.parts.steps[3][0] *= 1.01; }, "the time step of element 23 is "},
      {[](Copy& p) { p.parts.steps[3].clear(); },
       "the deck has 0 elements of one kind, expected 1"},
      {[](Copy& p) { p.cycle.contact_dt *= 1.01; }, "the time step of the contacts is "}};
  ASSERT_EQ(Pair().difference(), "");
  std::size_t i = 0;
  for (const auto& [change, expected] : changes) {
    Pair p;
    change(p.now);
    EXPECT_THAT(p.difference(), HasSubstr(expected)) << i;
    ++i;
  }
}

TEST(VerifiedFigures, MayDifferByWhatACellHolds) {
  // A ten-millionth, or a ten-thousandth where cells were rounded.
  for (const bool rounded : {false, true}) {
    VerifyRelation relation;
    relation.rounded = rounded;
    const double least = rounded ? 1e-4 : 1e-7;
    Pair p;
    const DeckComparison c(p.was.parts, p.now.parts, relation);
    EXPECT_EQ(c.tolerance, least);
    EXPECT_TRUE(c.same(2, 2 * (1 + 0.99 * least), 1));
    EXPECT_FALSE(c.same(2, 2 * (1 + 1.01 * least), 1));
    EXPECT_TRUE(c.same(-2, -6 * (1 + 0.99 * least), 3)) << "in other units";
    EXPECT_FALSE(c.same(2, -2, 1));
    EXPECT_TRUE(c.same(0, 0.5, 1, 0.5));
    EXPECT_FALSE(c.same(0, 0.5, 1, 0.49));
    EXPECT_TRUE(c.same(1e30, 2e29, 5)) << "both without end";
    EXPECT_FALSE(c.same(1e30, 0.9e29, 1));
    EXPECT_EQ(c.number("x", 2, 2, 1), std::nullopt);
    EXPECT_EQ(*c.number("x", 2, 3, 1), "x is 3, expected 2");
    EXPECT_EQ(*c.number("x", 2, 3, 4), "x is 3, expected 8 (2 in the units before)");
    EXPECT_EQ(c.number("x", 2, 3, 1, 1), std::nullopt);
  }
}

TEST(VerifiedFigures, APairWithinRoundingOfItsGapMayComeAndGo) {
  Pair p;
  // A tenth of a millionth of the gap, and a billionth of a thousandth of the largest coordinate.
  const double slack = 1e-7 * 2.5 + 1e-12 * p.now.parts.extent;
  ASSERT_EQ(p.now.parts.extent, 10);
  PenetrationRow more = p.now.contact(1).penetrations[0];
  more.main = 7;
  more.depth = 0.99 * slack;
  p.now.contact(1).penetrations.push_back(more);
  EXPECT_EQ(p.difference(), "");
  p.now.contact(1).penetrations.back().depth = 1.01 * slack;
  EXPECT_THAT(p.difference(), HasSubstr("it did not before"));
  p.now.contact(1).penetrations.pop_back();
  p.now.contact(1).penetrations[0].depth += 0.9 * (slack + 1e-7 * 2);
  EXPECT_EQ(p.difference(), "");
  p.now.contact(1).penetrations[0].depth += 0.2 * (slack + 1e-7 * 2);
  EXPECT_THAT(p.difference(), HasSubstr("the penetration of "));
}

TEST(VerifiedFigures, OfNegativeStiffnessOnlyTheSignCounts) {
  Pair p;
  p.was.contact(0).main[0].stiffness = -5;
  p.now.contact(0).main[0].stiffness = -7;
  EXPECT_EQ(p.difference(), "");
  p.now.contact(0).main[0].stiffness = 5;
  EXPECT_THAT(p.difference(), HasSubstr("a stiffness of "));
}

TEST(VerifiedFigures, AStiffnessThatIsNothingBesideTheOthersIsNone) {
  Pair p;
  for (Copy* c : {&p.was, &p.now}) {
    c->contact(1).main_edges.push_back(c->contact(1).main_edges[0]);
    c->contact(1).main_edges[0].stiffness = 1000;
  }
  p.was.contact(1).main_edges[1].stiffness = 0;
  p.now.contact(1).main_edges[1].stiffness = 0.99e-9;
  EXPECT_EQ(p.difference(), "");
  p.now.contact(1).main_edges[1].stiffness = 1.01e-9;
  EXPECT_THAT(p.difference(), HasSubstr("a stiffness of "));
}

TEST(VerifiedFigures, OfWhatWasGivenUpNothingIsAsked) {
  Pair p;
  p.now.contact(0).gapmin = 99;
  p.now.cycle.nodes.force[0][0] = 99;
  p.now.cycle.contact_dt = 99;
  VerifyRelation relation;
  relation.lossy = {2};
  EXPECT_THAT(p.difference(relation), HasSubstr("Gapmin"));
  relation.lossy = {1};
  EXPECT_EQ(p.difference(relation), "");
  relation.lossy = {};
  relation.lossy_defaults = true;
  EXPECT_EQ(p.difference(relation), "");
}

TEST(VerifiedFigures, ARelationFollowsFromTheLosses) {
  const auto loss = [](Loss kind, const char* keyword, std::int64_t id,
                       bool without_effect = false) {
    LossEntry e;
    e.loss = kind;
    e.keyword = keyword;
    e.id = id;
    e.without_effect = without_effect;
    return e;
  };
  VerifyRelation r = relation_of(
      {loss(Loss::kept, "/INTER/TYPE7", 1), loss(Loss::dropped, "/INTER/TYPE7", 2),
       loss(Loss::undecided, "/INTER/TYPE10", 3), loss(Loss::dropped, "/INTER/TYPE7", 4, true),
       loss(Loss::dropped, "/PROP/SHELL", 5)});
  EXPECT_EQ(r.lossy, (std::set<std::int64_t>{2, 3}));
  EXPECT_FALSE(r.rounded);
  EXPECT_FALSE(r.lossy_defaults);
  EXPECT_TRUE(relation_of({loss(Loss::approximated, "/PROP/SHELL", 5)}).rounded);
  EXPECT_TRUE(relation_of({loss(Loss::approximated, "/INTER/TYPE7", 5)}).lossy.empty());
  EXPECT_TRUE(relation_of({loss(Loss::dropped, "/DEFAULT/INTER/TYPE7", 0)}).lossy_defaults);
  EXPECT_FALSE(relation_of({loss(Loss::kept, "/DEFAULT/INTER/TYPE7", 0)}).lossy_defaults);
}

/// The first difference in the values of interfaces, from the deck of two contacts to one with
/// these cards.
std::string value_difference(const std::string& cards, const VerifyRelation& relation = {}) {
  const auto with = [](const std::string& text) {
    SmallDeck d;
    d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(9, 5, 5, 0.5);
    d.shell_part(1, 2).shell(1, 21, 1, 2, 3, 4);
    d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {9}).group("/GRNOD/NODE/3", {9});
    return d.add(text);
  };
  const Built was(
      with("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.5 Stfac=3 Inacti=3\n"
           "@/INTER/TYPE10/2 grnd_IDs=2 surf_IDm=1 Gap=0.25")),
      now(with(cards));
  const Behaviour before(was.loaded), after(now.loaded);
  return DeckComparison(before.parts(), after.parts(), relation).values().value_or("");
}

TEST(VerifiedValues, AreComparedInterfaceByInterface) {
  const std::string first = "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.5 Stfac=3 Inacti=3";
  const std::string second = "@/INTER/TYPE10/2 grnd_IDs=2 surf_IDm=1 Gap=0.25";
  EXPECT_EQ(value_difference(first + "\n" + second), "");
  EXPECT_THAT(value_difference(first), HasSubstr("the deck has 1 interfaces of "));
  EXPECT_THAT(value_difference(first), HasSubstr(", expected 2"));
  EXPECT_EQ(value_difference(first + "\n@/INTER/TYPE10/3 grnd_IDs=2 surf_IDm=1 Gap=0.25"),
            "interface 3 is a TYPE10, expected TYPE10 and id 2");
  EXPECT_EQ(value_difference(first + "\n@/INTER/TYPE7/2 grnd_IDs=2 surf_IDm=1 Gapmin=0.25"),
            "interface 2 is a TYPE7, expected TYPE10 and id 2");
  EXPECT_THAT(value_difference(
                  "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.5 Stfac=4 Inacti=3\n" + second),
              HasSubstr("interface 1 Stfac is 4, expected 3"));
  EXPECT_EQ(value_difference("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.5 Stfac=3 Inacti=6\n" +
                             second),
            "interface 1 Inacti is 6, expected 3");
  EXPECT_EQ(value_difference(first + "\n@/INTER/TYPE10/2 grnd_IDs=3 surf_IDm=1 Gap=0.25"),
            "interface 2 grnd_IDs is 3, expected 2");
}

TEST(VerifiedValues, OfAnotherKindOfDeckAreThoseOfItsRelation) {
  const std::string first = "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.5 Stfac=3 Inacti=3";
  const std::string new_ids = "\n@/INTER/TYPE10/30 grnd_IDs=3 surf_IDm=1 Gap=0.25";
  VerifyRelation renumbered;
  renumbered.new_ids = true;
  EXPECT_EQ(value_difference(first + new_ids, renumbered), "");
  EXPECT_THAT(value_difference(
                  "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.5 Stfac=3 Inacti=5" + new_ids,
                  renumbered),
              HasSubstr("interface 1 Inacti is 5"));
  VerifyRelation extract;
  extract.extract = true;
  EXPECT_EQ(value_difference("@/INTER/TYPE10/2 grnd_IDs=2 surf_IDm=1 Gap=0.25", extract), "");
  EXPECT_THAT(value_difference("@/INTER/TYPE10/2 grnd_IDs=2 surf_IDm=1 Gap=0.5", extract),
              HasSubstr("interface 2 Gap is 0.5, expected 0.25"));
  EXPECT_EQ(value_difference("@/INTER/TYPE7/2 grnd_IDs=2 surf_IDm=1 Gapmin=0.25", extract),
            "there was no interface 2");
  VerifyRelation expanded;
  expanded.expanded = true;
  EXPECT_EQ(
      value_difference("@/INTER/TYPE7/2 grnd_IDs=2 surf_IDm=1 Gapmin=0.25\n" + first, expanded),
      "");
  VerifyRelation lossy;
  lossy.lossy = {1};
  const std::string other = "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=9\n";
  EXPECT_EQ(value_difference(other + "@/INTER/TYPE10/2 grnd_IDs=2 surf_IDm=1 Gap=0.25", lossy), "");
  EXPECT_THAT(value_difference(other + "@/INTER/TYPE10/2 grnd_IDs=2 surf_IDm=1 Gap=0.5", lossy),
              HasSubstr("interface 2 Gap is 0.5"));
  lossy = {};
  lossy.lossy_defaults = true;
  EXPECT_EQ(value_difference(other + "@/INTER/TYPE10/2 grnd_IDs=2 surf_IDm=1 Gap=0.5", lossy), "");
}

}  // namespace
}  // namespace deck::test
