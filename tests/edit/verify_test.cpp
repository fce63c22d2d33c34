// Verification: conversions that keep the model pass, changes of one value are named; every figure
// of contacts, forces, masses and steps that is another one is noticed, and what differs by no more
// than cells can hold is the same.
#include "edit/shared/conversion.hpp"

#include <gmock/gmock.h>

#include <functional>

#include "contact/meshes.hpp"
#include "contact/small_deck.hpp"
#include "deck/edit.hpp"
#include "edit/support.hpp"
#include "edit/verify/deck_comparison.hpp"

namespace deck::test {
namespace {

using edit_test::Whole;

std::unique_ptr<Whole> sample(const std::string& name = "too_close_0000.rad") {
  return Whole::read((source_dir() / "samples" / name).string());
}

std::optional<std::string> difference(const Whole& before, const Whole& after,
                                      const VerifyRelation& relation = {}) {
  return first_difference(before.context(), after.context(), relation);
}

/// What differs after a conversion of units; empty: nothing.
std::string after_units(const Whole& deck, const char* units,
                        const UnitsOptions& options = {true}) {
  const Rewrite rewrite = to_units(deck.context(), *parse_unit_system(units), options);
  return edit_test::changed_figure(deck, *deck.after(rewrite), "--units", rewrite.losses);
}

/// The sample with one text replaced.
std::unique_ptr<Whole> edited(const Whole& whole, const std::string& from, const std::string& to) {
  std::string text = whole.main_text();
  const auto at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  text.replace(at, from.size(), to);
  return Whole::read(whole.deck.sources[0].path(), {{whole.deck.sources[0].path(), text}});
}

TEST(Verification, OtherUnitsAreTheSameModel) {
  for (const char* name : {"too_close_0000.rad", "crash_box_0000.rad", "hot_contact_0000.rad"}) {
    const auto deck = sample(name);
    for (const bool keep : {false, true})
      EXPECT_EQ(after_units(*deck, "Mg,m,s", {.partial = true, .keep_working = keep}), "") << name;
  }
}

TEST(Verification, EveryNewIdIsTheSameModelAndEveryOtherValueIsNot) {
  const auto deck = sample();
  RenumberOptions options;
  options.rules = {*parse_renumber_rule("all+1000")};
  const auto after = deck->after(renumber(deck->context(), options));
  VerifyRelation relation;
  EXPECT_NE(difference(*deck, *after, relation), std::nullopt) << "the interface has another id";
  relation.new_ids = true;
  EXPECT_EQ(difference(*deck, *after, relation), std::nullopt);
  // Another Inacti is no id.
  const auto& cell = *decode(after->deck, *after->interfaces.type7.at(0).block).find("Inacti");
  std::string text = after->main_text();
  text.replace(cell.span.offset + cell.span.length - 1, 1, "6");
  const std::string& path = deck->deck.sources[0].path();
  const auto other = Whole::read(path, {{path, text}});
  ASSERT_EQ(other->interfaces.type7.at(0).Inacti.value, 6);
  EXPECT_NE(difference(*after, *other, relation), std::nullopt);
  EXPECT_EQ(difference(*deck, *other, relation).value_or(""),
            difference(*after, *other, relation).value_or("none"));
}

/// The sample with a spring between two nodes of the contact, whose stiffness counts (Istf 4).
std::unique_ptr<Whole> with_spring(const Whole& sample,
                                   const std::vector<std::pair<std::string, std::string>>& values,
                                   bool in_contact = true) {
  return edited(sample, "/END",
                card("/PROP/SPRING", 77, 2022, values) +
                    "/FUNCT/88\ncurve\n                 0.0                 0.0\n"
                    "                 1.0                 2.0\n"
                    "/PART/77\nspring\n        77         0         0\n" +
                    (in_contact ? "/SPRING/77\n       901       101       102\n/END" : "/END"));
}

TEST(Verification, ASpringThatFollowsACurveKeepsTheStiffnessItCountsWithInContacts) {
  const auto plain = sample();
  const auto deck = with_spring(*plain, {{"Mass", "0.01"}, {"K", "0.01"}, {"fct_ID11", "88"}});
  EXPECT_EQ(after_units(*deck, "g,mm,ms"), "");
  EXPECT_NE(difference(*plain, *deck), std::nullopt) << "the spring must count";
}

TEST(Verification, AStiffnessThatChangesWithTheUnitsIsNamedWithTheReasonWhereAContactCountsIt) {
  const auto plain = sample();
  for (const bool in_contact : {true, false}) {
    const auto deck =
        with_spring(*plain, {{"Mass", "0.01"}, {"Ileng", "1"}, {"K", "0.01"}}, in_contact);
    const std::string why = after_units(*deck, "kg,m,ms");
    for (const char* part : {"springs of /PROP/SPRING/77", "K / A", "is 1e-05, expected 0.01"})
      EXPECT_EQ(why.find(part) != why.npos, in_contact) << why;
    EXPECT_EQ(!why.empty(), in_contact);
  }
}

/// A brick below a node; the contact has a constant stiffness, or a face without area.
std::unique_ptr<Whole> on_a_brick(const std::string& stfac, bool folded) {
  SmallDeck d;
  add_brick(d, 1, 1, 1, {0, 0, 0}, {2, 2, 2});
  d.node(9, 1, 1, 2.1).solid_part(1);
  std::vector<std::vector<int>> faces{{5, 6, 7, 8}};
  if (folded) faces.push_back({5, 6, 5, 6});
  d.segments("/SURF/SEG/1", faces).group("/GRNOD/NODE/1", {9});
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Igap=1000 Irem_gap=1 Fric=0.3 Stfac=" + stfac);
  return Whole::text(d.text());
}

TEST(Verification, OfAConstantStiffnessOfSolidsTheFactorCounts) {
  const auto deck = on_a_brick("-3.5", false);
  EXPECT_EQ(after_units(*deck, "g,mm,ms"), "");
  EXPECT_NE(difference(*deck, *on_a_brick("-3.6", false)), std::nullopt);
}

TEST(Verification, WhatTheSolverLeavesOfASegmentWithoutAreaIsTheSameInAllUnits) {
  const auto deck = on_a_brick("1", true);
  for (const char* units : {"g,mm,ms", "kg,m,s"}) EXPECT_EQ(after_units(*deck, units), "");
}

TEST(Verification, OneValueThatAConversionOfUnitsLeftOutIsNamed) {
  const auto deck = sample();
  const Rewrite whole = to_units(deck->context(), *parse_unit_system("kg,m,s"), {true});
  const std::string text = deck->main_text();
  const std::size_t height = text.find("\n       101 ") + 1 + 50, density = text.find("7.8e-06"),
                    gap = deck->interfaces.type7.at(0).Gapmin.span.offset;
  for (const std::size_t place : {height, density, gap}) {
    Rewrite faulty = whole;
    const auto left_out = std::erase_if(faulty.edits, [&](const TextEdit& e) {
      return e.span.file == 0 && e.span.offset <= place && place < e.span.offset + e.span.length;
    });
    ASSERT_EQ(left_out, 1u) << text.substr(place, 20);
    EXPECT_NE(difference(*deck, *deck->after(faulty), relation_of("--units", faulty.losses)),
              std::nullopt)
        << text.substr(place, 20);
  }
  EXPECT_EQ(difference(*deck, *deck->after(whole), relation_of("--units", whole.losses)),
            std::nullopt);
}

TEST(Verification, WhatIsGivenUpForAnInterfaceIsAccepted) {
  const auto deck = sample();
  const InterType7& inter = deck->interfaces.type7.at(0);
  const std::string cell(deck->deck.sources.text(inter.Gapmin.span));
  std::string other = cell;
  other.replace(other.find_last_not_of(" 0"), 1, "7");
  const auto line = deck->deck.sources[0].line_at(inter.Gapmin.span.offset);
  std::string now(line);
  now.replace(now.find(cell), cell.size(), other);
  const auto after = edited(*deck, std::string(line), now);
  const auto why = difference(*deck, *after);
  ASSERT_NE(why, std::nullopt);
  EXPECT_NE(why->find("Gapmin"), std::string::npos) << *why;
  LossEntry loss;
  loss.loss = Loss::dropped;
  loss.keyword = "/INTER/TYPE7";
  loss.id = inter.id;
  EXPECT_EQ(difference(*deck, *after, relation_of("", {loss})), std::nullopt);
}

TEST(ChangedValues, EveryValueHasItsCell) {
  const auto deck = sample();
  Rewrite rewrite = to_units(deck->context(), *parse_unit_system("kg,m,s"));
  const std::size_t before = rewrite.losses.size();
  add_changed_values(deck->context(), "--units", rewrite);
  EXPECT_GE(rewrite.losses.size(), rewrite.edits.size()) << before << " before";
  bool gapmin = false;
  for (const LossEntry& e : rewrite.losses) {
    if (e.field != "Gapmin") continue;
    gapmin = true;
    EXPECT_EQ(e.keyword, "/INTER/TYPE7");
    EXPECT_EQ(e.column, 41u);
    EXPECT_EQ(e.end_column, 60u);
    EXPECT_EQ(e.note, "--units");
    EXPECT_DOUBLE_EQ(std::stod(e.new_text) * 1000, std::stod(e.old_text));
  }
  EXPECT_TRUE(gapmin);
}

TEST(ChangedValues, OfAValueWithSomeDigitsChangedAllAreTold) {
  const auto deck = Whole::text("#RADIOSS STARTER\n/BEGIN\nx\n      2022         0\n/END\n");
  Rewrite rewrite;
  const auto at = deck->main_text().find("2022");
  rewrite.edits.push_back({Span{0, 2, at + 2}, "18"});
  add_changed_values(deck->context(), "--version", rewrite);
  ASSERT_EQ(rewrite.losses.size(), 1u);
  EXPECT_EQ(rewrite.losses[0].old_text, "2022");
  EXPECT_EQ(rewrite.losses[0].new_text, "2018");
  EXPECT_EQ(rewrite.losses[0].line, 4u);
  EXPECT_EQ(rewrite.losses[0].keyword, "/BEGIN");
}

using detail::DeckComparison;
using detail::DeckStart;
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
  explicit Copy(const DeckStart& p)
      : scene(p.scene),
        state(p.state),
        cycle(p.cycle),
        beam_factors(p.beam_factors),
        parts{p.context, scene, state, cycle, p.steps, beam_factors, p.part_mass, p.extent} {}
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;
  Contact& contact(std::size_t i) { return scene.contacts.at(i); }
  Scene scene;
  cycle::State state;
  cycle::SceneOutcome cycle;
  std::vector<double> beam_factors;
  DeckStart parts;
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
  Copy was{detail::behaviour_of(b.loaded)}, now{detail::behaviour_of(b.loaded)};
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
      {[](Copy& p) { p.contact(0).nodal_stiffness.resize(2, 0.5); }, "a stiffness of "},
      {[](Copy& p) { p.contact(1).main_edges[0].gap += 0.5; }, "a gap of "},
      {[](Copy& p) { p.contact(1).main_edges[0].stiffness *= 1.001; }, "a stiffness of "},
      {[](Copy& p) { p.contact(1).secondary_edges[0].stiffness *= 1.001; }, "a stiffness of "},
      {[](Copy& p) { p.contact(0).secondary.pop_back(); }, "the secondary side of "},
      {[](Copy& p) { p.contact(0).main.clear(); }, " has 0 entries, expected 4"},
      {[](Copy& p) { std::swap(p.contact(0).secondary[0].node, p.contact(0).secondary[1].node); },
       "the penetration of interface 1 at node 8 is 1, expected 0.75"},
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

TEST(VerifiedFigures, APairMayTakeAnotherSegmentThatIsAsNear) {
  Pair p;
  PenetrationRow& row = p.now.contact(1).penetrations[0];
  row.main += 1;
  EXPECT_EQ(p.difference(), "");
  row.depth += 1e-3;
  EXPECT_THAT(p.difference(), HasSubstr("no longer penetrates"));
}

TEST(VerifiedFigures, OfNegativeStiffnessOnlyTheSignCounts) {
  Pair p;
  p.was.contact(0).main[0].stiffness = -5;
  p.now.contact(0).main[0].stiffness = -7;
  EXPECT_EQ(p.difference(), "");
  p.now.contact(0).main[0].stiffness = 5;
  EXPECT_THAT(p.difference(), HasSubstr("a stiffness of "));
}

TEST(VerifiedFigures, ARelationFollowsFromTheStep) {
  EXPECT_TRUE(relation_of("--renumber", {}).new_ids);
  EXPECT_TRUE(relation_of("--extract-contacts", {}).extract);
  EXPECT_TRUE(relation_of("--expand-type19", {}).expanded);
  EXPECT_TRUE(relation_of("--version", {}).cells);
  LossEntry dropped;
  dropped.loss = Loss::dropped;
  EXPECT_FALSE(relation_of("--version", {dropped}).cells) << "the rest of the deck differs";
}

TEST(VerifiedFigures, TheSolversOwnFormulaOfBeamsIsNamedAndAcceptedAndNothingElse) {
  SmallDeck d = two_contacts();
  d.beam_part(3, 0.01).bar("BEAM", 3, 31, 11, 12, 1);
  const Built b(d);
  Copy was(detail::behaviour_of(b.loaded)), now(detail::behaviour_of(b.loaded));
  ASSERT_GT(was.beam_factors.at(0), 1) << "length / (a + s) of a beam of 10";
  now.beam_factors[0] *= 4;
  now.parts.steps[4][0] /= 2;
  const VerifyRelation relation;
  const auto difference = [&](std::vector<LossEntry>* accepted) {
    return DeckComparison(was.parts, now.parts, relation, accepted).time_steps().value_or("");
  };
  EXPECT_THAT(difference(nullptr), HasSubstr("the time step of element 31 is "));
  EXPECT_THAT(difference(nullptr), HasSubstr("length / (a + s)"));
  std::vector<LossEntry> accepted;
  EXPECT_EQ(difference(&accepted), "");
  ASSERT_EQ(accepted.size(), 1u);
  EXPECT_EQ(accepted[0].id, 31);
  now.parts.steps[4][0] *= 1.01;
  EXPECT_THAT(difference(&accepted), HasSubstr("the time step of element 31 is "));
  EXPECT_EQ(accepted.size(), 1u);
}

}  // namespace
}  // namespace deck::test
