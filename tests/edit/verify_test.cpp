// Verification: conversions that keep the model pass, changes of one value are named.
#include "edit/shared/conversion.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "contact/meshes.hpp"
#include "deck/edit.hpp"
#include "edit/version_support.hpp"

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

/// The sample with a spring between two nodes of the contact, whose contact stiffness counts there
/// (Istf 4).
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

}  // namespace
}  // namespace deck::test
