// Verification: conversions that keep the model pass, changes of one value are named.
#include "edit/shared/verify.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "deck/edit/convert.hpp"
#include "edit/shared/changed_values.hpp"
#include "edit/units_support.hpp"
#include "lint/support.hpp"

namespace deck::test {
namespace {

using edit_test::Whole;

/// A deck with penetrations, shells, and interfaces.
std::unique_ptr<Whole> sample(const std::string& name = "too_close_0000.rad") {
  return Whole::read((source_dir() / "samples" / name).string());
}

std::optional<std::string> difference(const Whole& before, const Whole& after,
                                      const VerifyRelation& relation = {}) {
  return first_difference(before.context(), after.context(), relation);
}

/// The sample with one text replaced.
std::unique_ptr<Whole> edited(const Whole& whole, const std::string& from, const std::string& to) {
  std::string text = whole.main_text();
  const auto at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  text.replace(at, from.size(), to);
  return Whole::read(whole.deck.sources[0].path(), {{whole.deck.sources[0].path(), text}});
}

TEST(Verification, ADeckIsTheSameAsItself) {
  const auto deck = sample("crash_box_0000.rad");
  EXPECT_EQ(difference(*deck, *deck), std::nullopt);
}

TEST(Verification, OtherUnitsAreTheSameModel) {
  for (const char* name : {"too_close_0000.rad", "crash_box_0000.rad", "hot_contact_0000.rad"}) {
    const auto deck = sample(name);
    const Rewrite rewrite = to_units(deck->context(), *parse_unit_system("Mg,m,s"), {true});
    const auto after = deck->after(rewrite);
    const auto why = difference(*deck, *after, relation_of("--units", rewrite.losses));
    EXPECT_EQ(why, std::nullopt) << name << ": " << *why;
  }
}

TEST(Verification, NewIdsAreTheSameModel) {
  const auto deck = sample();
  RenumberOptions options;
  options.rules = {*parse_renumber_rule("node+1000"), *parse_renumber_rule("inter+5")};
  const auto after = deck->after(renumber(deck->context(), options));
  VerifyRelation relation;
  EXPECT_NE(difference(*deck, *after, relation), std::nullopt) << "the interface has another id";
  relation.new_ids = true;
  EXPECT_EQ(difference(*deck, *after, relation), std::nullopt);
}

TEST(Verification, EveryNewIdIsTheSameModelAndEveryOtherValueIsNot) {
  const auto deck = sample();
  RenumberOptions options;
  options.rules = {*parse_renumber_rule("all+1000")};
  const auto after = deck->after(renumber(deck->context(), options));
  VerifyRelation relation;
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

TEST(Verification, AnExtractAndAnExpandedTYPE19AreTheSameContacts) {
  const auto deck = sample("crash_box_0000.rad");
  const std::int64_t wanted[] = {2};
  VerifyRelation extract, expanded;
  extract.extract = expanded.expanded = true;
  const auto part = deck->after(extract_contacts(deck->context(), wanted));
  EXPECT_EQ(difference(*deck, *part, extract), std::nullopt);
  const auto apart = deck->after(expand_type19(deck->context()));
  EXPECT_EQ(difference(*deck, *apart, expanded), std::nullopt);
}

TEST(Verification, OneChangedValueIsNamed) {
  const auto deck = sample();
  // A coordinate of the upper sheet: its penetration is another one.
  const std::string text = deck->main_text();
  const auto node = text.find("\n       101 ") + 1;
  const std::string row = text.substr(node, text.find('\n', node) - node);
  ASSERT_GE(row.size(), 70u) << row;
  std::string higher = row;
  higher.replace(50, 20, "               0.875");
  ASSERT_NE(row, higher);
  EXPECT_NE(difference(*deck, *edited(*deck, row, higher)), std::nullopt);
  // A density: only masses and time steps.
  const auto dense = edited(*deck, "7.8e-06", "7.9e-06");
  const auto mass = difference(*deck, *dense);
  ASSERT_NE(mass, std::nullopt);
  EXPECT_NE(mass->find("the mass of node"), std::string::npos) << *mass;
}

/// A spring between two nodes of the contact, whose contact stiffness counts there (Istf 4).
/// `ileng` 1: its values are per unit length.
std::string spring(const std::string& ileng, const std::string& function, bool in_contact = true) {
  return R"(/PROP/SPRING/77
a spring
#               MASS                                 sens_ID    Isflag     Ileng
                0.01                                       0         0         )" +
         ileng + R"(
#                 K1                  C1                  A1                  B1                  D1
                0.01                 0.0                 0.0                 0.0                 0.0
# fct_ID11        H1  fct_ID21  fct_ID31  fct_ID41                      DeltaMin            DeltaMax
)" + function +
         R"(         0         0         0         0                           0.0                 0.0
#                 F1                  E1             AScale1             Hscale1
                 0.0                 0.0                 0.0                 0.0
/FUNCT/88
curve
#                  X                   Y
                 0.0                 0.0
                 1.0                 2.0
/PART/77
spring
        77         0         0
)" + (in_contact ? "/SPRING/77\n       901       101       102\n/END" : "/END");
}

TEST(Verification, ASpringThatFollowsACurveKeepsTheStiffnessItCountsWithInContacts) {
  const auto plain = sample();
  const auto deck = edited(*plain, "/END", spring("0", "        88"));
  const Rewrite rewrite = to_units(deck->context(), *parse_unit_system("g,mm,ms"), {true});
  const auto after = deck->after(rewrite);
  const auto why = difference(*deck, *after, relation_of("--units", rewrite.losses));
  EXPECT_EQ(why, std::nullopt) << *why;
  EXPECT_TRUE(after->contains("                 1.0              2000.0\n")) << after->main_text();
  EXPECT_NE(difference(*plain, *deck), std::nullopt) << "the spring must count";
}

TEST(Verification, AStiffnessThatChangesWithTheUnitsIsNamedWithTheReasonWhereAContactCountsIt) {
  const auto plain = sample();
  for (const bool in_contact : {true, false}) {
    const auto deck = edited(*plain, "/END", spring("1", "         0", in_contact));
    const Rewrite rewrite = to_units(deck->context(), *parse_unit_system("kg,m,ms"), {true});
    const auto after = deck->after(rewrite);
    const auto why = difference(*deck, *after, relation_of("--units", rewrite.losses));
    ASSERT_EQ(why.has_value(), in_contact) << why.value_or("");
    if (!in_contact) continue;
    EXPECT_NE(why->find("springs of /PROP/SPRING/77"), why->npos) << *why;
    EXPECT_NE(why->find("K / A"), why->npos) << *why;
    EXPECT_NE(why->find("is 1e-05, expected 0.01"), why->npos) << *why;
  }
}

/// A brick below a node; the contact has a constant stiffness, or a face without area.
std::unique_ptr<Whole> on_a_brick(const std::string& stfac, bool folded) {
  std::string text = R"(#RADIOSS STARTER
/BEGIN
brick
      2022         0
                  kg                  mm                  ms
                  kg                  mm                  ms
/MAT/ELAST/1
m
               1e-06
                 200                 0.3
/PROP/SOLID/1
p
         0         0                   0         0                   0
                   0                   0                   0                   0
                   0
/PART/1
p
         1         1         0
/NODE
         1                   0                   0                   0
         2                   2                   0                   0
         3                   2                   2                   0
         4                   0                   2                   0
         5                   0                   0                   2
         6                   2                   0                   2
         7                   2                   2                   2
         8                   0                   2                   2
         9                   1                   1                 2.1
/BRICK/1
         1         1         2         3         4         5         6         7         8
/SURF/SEG/1
s
         1         5         6         7         8
)";
  if (folded) text += "         2         5         6         5         6\n";
  text += R"(/GRNOD/NODE/1
g
         9
/INTER/TYPE7/1
i
         1         1         0         0      1000                   0         0         0         0
                   0                   0                   0                             0
                   0                   0                   0                   0         1         0
)" + std::string(20 - stfac.size(), ' ') +
          stfac +
          R"(                   0                 0.3                   0                   0
       000                             0                   0                   0                   0
         0         0                   0         0         0         0                   0         0
/END
)";
  return Whole::text(text);
}

TEST(Verification, OfAConstantStiffnessOfSolidsTheFactorCounts) {
  const auto deck = on_a_brick("-3.5", false);
  const Rewrite rewrite = to_units(deck->context(), *parse_unit_system("g,mm,ms"), {true});
  const auto after = deck->after(rewrite);
  const auto why = difference(*deck, *after, relation_of("--units", rewrite.losses));
  EXPECT_EQ(why, std::nullopt) << *why;
  EXPECT_NE(difference(*deck, *on_a_brick("-3.6", false)), std::nullopt);
}

TEST(Verification, WhatTheSolverLeavesOfASegmentWithoutAreaIsTheSameInAllUnits) {
  const auto deck = on_a_brick("1", true);
  for (const char* units : {"g,mm,ms", "kg,m,s"}) {
    const Rewrite rewrite = to_units(deck->context(), *parse_unit_system(units), {true});
    const auto after = deck->after(rewrite);
    const auto why = difference(*deck, *after, relation_of("--units", rewrite.losses));
    EXPECT_EQ(why, std::nullopt) << *why;
  }
}

TEST(Verification, MassThatMovesFromOnePartToAnotherIsNamed) {
  // A spring with mass between two nodes: which part it is of changes no node.
  const auto with = [](const char* part) {
    return "/PROP/SPRING/77\na spring\n                 0.1\n                 0.0\n" +
           std::string("/PART/77\none\n        77         0         0\n") +
           "/PART/78\nother\n        77         0         0\n/SPRING/" + part +
           "\n       901       101       102\n/END";
  };
  const auto plain = sample();
  const auto one = edited(*plain, "/END", with("77")), other = edited(*plain, "/END", with("78"));
  EXPECT_EQ(difference(*one, *one), std::nullopt);
  const auto why = difference(*one, *other);
  ASSERT_NE(why, std::nullopt);
  EXPECT_NE(why->find("the mass of part 77 is 0, expected 0.1"), why->npos) << *why;
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

TEST(Verification, APairThatComesOrGoesIsADifference) {
  const auto deck = sample();
  const Rewrite whole = to_units(deck->context(), *parse_unit_system("kg,m,s"), {true});
  const auto good = deck->after(whole);
  // The upper sheet of the sample, lifted out of the gap.
  const std::string text = deck->main_text();
  const auto node = text.find("\n       101 ") + 1;
  const std::string row = text.substr(node, text.find('\n', node) - node);
  std::string lifted = row;
  lifted.replace(50, 20, "               250.0");
  const auto apart = edited(*deck, row, lifted);

  const auto compare = [&](const Whole& a, const Whole& b) {
    return difference(a, b, relation_of("--units", whole.losses));
  };
  EXPECT_EQ(compare(*deck, *good), std::nullopt);
  // A pair that exists in the result only, and one that exists in the original only.
  const auto more = compare(*apart, *deck), fewer = compare(*deck, *apart);
  ASSERT_NE(more, std::nullopt);
  EXPECT_NE(more->find("it did not before"), more->npos) << *more;
  ASSERT_NE(fewer, std::nullopt);
  EXPECT_NE(fewer->find("no longer penetrates"), fewer->npos) << *fewer;
  // A coordinate that a faulty conversion gets wrong moves its node out of the contact, or in.
  for (const Whole* original : {deck.get(), apart.get()}) {
    const std::size_t height = original->main_text().find("\n       101 ") + 1 + 50;
    const Rewrite all = to_units(original->context(), *parse_unit_system("kg,m,s"), {true});
    Rewrite faulty = all;
    std::size_t wrong = 0;
    for (TextEdit& e : faulty.edits) {
      if (e.span.offset > height + 19 || height >= e.span.offset + e.span.length) continue;
      e.text = original == deck.get() ? "               250.0" : "              0.0009";
      ++wrong;
    }
    EXPECT_EQ(wrong, 1u);
    EXPECT_EQ(compare(*original, *original->after(all)), std::nullopt);
    EXPECT_NE(compare(*original, *original->after(faulty)), std::nullopt);
  }
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
