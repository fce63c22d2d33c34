// A deck and what a conversion makes of it mean the same, and what differs is told.
#include "deck/edit/convert.hpp"
#include "edit/units_support.hpp"
#include "inspect/shared/diff.hpp"
#include "report/shared/diff.hpp"

namespace deck::edit_test {
namespace {

std::string cell(const std::string& text, std::size_t width) {
  return std::string(width - text.size(), ' ') + text;
}

std::unique_ptr<Whole> deck_of(const std::string& blocks, int version = 2022) {
  const std::string units = cell("kg", 20) + cell("mm", 20) + cell("ms", 20) + "\n";
  return Whole::text("#RADIOSS STARTER\n/BEGIN\nrun\n" + cell(std::to_string(version), 10) + "\n" +
                     units + units + blocks + "/END\n");
}

DeckDiff compared(const Whole& a, const Whole& b, double tolerance = diff_tolerance) {
  const auto side = [](const Whole& w) { return DiffSide{w.loaded}; };
  return diff_decks(side(a), side(b), MatchBy::id, tolerance);
}

std::string shown(const DeckDiff& diff) {
  std::string out = diff_verdict(diff);
  for (const Change& c : diff.changes) out += "\n" + c.keyword + " " + c.field;
  for (const std::string& note : diff.notes) out += "\n" + note;
  return out;
}

bool has_note(const DeckDiff& diff, const std::string& text) {
  return std::any_of(diff.notes.begin(), diff.notes.end(),
                     [&](const std::string& n) { return n.find(text) != n.npos; });
}

std::unique_ptr<Whole> in_units(const Whole& w, const char* system) {
  const auto units = parse_unit_system(system);
  return w.after(to_units(w.context(), *units));
}

std::string points(int id, const char* y) {
  return "/FUNCT/" + std::to_string(id) + "\nf\n" + cell("0.0", 20) + cell("0.0", 20) + "\n" +
         cell("10.0", 20) + cell(y, 20) + "\n";
}

/// TYPE4 of stiffness K whose force is f(x) (A + B ...).
std::string spring(const char* k, const char* a, const char* b = "") {
  return "/PROP/SPRING/7\ns\n" + cell("0.1", 20) + "\n" + cell(k, 20) + cell("", 20) + cell(a, 20) +
         cell(b, 20) + "\n" + cell("5", 10) + cell("", 20) + "\n" + cell("", 20) + cell("4.0", 20) +
         "\n";
}

TEST(DiffAfterUnits, PointsTimesTheirScaleAreTheSameWhereTheSpringKeepsItsCoefficient) {
  for (const char* k : {"3.0", ""}) {
    const auto w = deck_of(spring(k, "2.0", "7.0") + points(5, "2.0"));
    const auto after = in_units(*w, "kg,m,s");
    const DeckDiff diff = compared(*w, *after);
    EXPECT_TRUE(diff.equal()) << k << shown(diff) << after->main_text();
    EXPECT_FALSE(compared(*deck_of(spring(k, "2.0", "7.0") + points(5, "2.1")), *after).equal());
    EXPECT_FALSE(compared(*deck_of(spring(k, "2.1", "7.0") + points(5, "2.0")), *after).equal());
    EXPECT_FALSE(compared(*deck_of(spring(k, "2.0", "7.1") + points(5, "2.0")), *after).equal());
  }
}

TEST(DiffAfterUnits, ACoefficientThatOnlyScalesItsFunctionIsComparedByTheProduct) {
  const auto with = [](const char* k, const char* a, const char* y) {
    return deck_of(spring(k, a) + points(5, y));
  };
  EXPECT_TRUE(compared(*with("", "2.0", "1.5"), *with("", "1.0", "3.0")).equal());
  // K / A counts in contacts.
  const DeckDiff diff = compared(*with("3.0", "2.0", "1.5"), *with("3.0", "1.0", "3.0"));
  ASSERT_EQ(diff.changes.size(), 1u) << shown(diff);
  EXPECT_EQ(diff.changes[0].field, "A");
  const DeckDiff other = compared(*with("", "2.0", "1.5"), *with("", "2.0", "1.6"));
  ASSERT_EQ(other.changes.size(), 1u) << shown(other);
  EXPECT_EQ(other.changes[0].keyword, "/FUNCT");
}

TEST(DiffAfterUnits, ACopyOfAFunctionForAnotherUseIsNoChange) {
  std::string second = spring("", "2.0");
  second.replace(second.find("/7"), 2, "/8");
  const auto w = deck_of(spring("3.0", "2.0") + second + points(5, "2.0"));
  const auto after = in_units(*w, "kg,m,ms");
  ASSERT_TRUE(after->contains("/FUNCT/6")) << after->main_text();
  const DeckDiff diff = compared(*w, *after);
  EXPECT_TRUE(diff.equal()) << shown(diff);
  EXPECT_TRUE(compared(*after, *w).equal());
  // A function that nobody uses is one more.
  const auto more = deck_of(spring("3.0", "2.0") + second + points(5, "2.0") + points(9, "2.0"));
  EXPECT_FALSE(compared(*w, *more).equal());
}

TEST(DiffAfterUnits, LimitsCountTimesTheScaleOfTheirAxis) {
  const auto with = [](const char* scale, const char* limit) {
    return deck_of("/PROP/SPRING/7\ns\n" + cell("0.1", 20) + "\n" + cell("2.0", 20) + cell("", 80) +
                   "\n" + cell("5", 10) + cell("", 50) + cell(limit, 20) + cell("6.0", 20) + "\n" +
                   cell("", 40) + cell(scale, 20) + "\n" + points(5, "2.0"));
  };
  for (const char* scale : {"", "2.0"}) {
    const auto w = with(scale, "-4.0");
    const DeckDiff diff = compared(*w, *in_units(*w, "Mg,m,s"));
    EXPECT_TRUE(diff.equal()) << shown(diff);
    EXPECT_FALSE(compared(*w, *with(scale, "-5.0")).equal());
  }
}

TEST(DiffAfterUnits, ANegativeFactorIsAStiffnessUnlessTheCardSaysSo) {
  const auto with = [](const char* istf, const char* stfac) {
    return deck_of("/INTER/TYPE7/1\ni\n" + cell("1", 10) + cell("2", 10) + cell(istf, 10) +
                   "\n\n\n" + cell(stfac, 20) + cell("", 20) + cell("1.0", 20) + "\n\n\n");
  };
  const struct {
    const char *istf, *stfac;
    double after;
  } cases[] = {{"5", "-3.0", -3000}, {"5", "3.0", 3}, {"1", "3.0", 3000}, {"1", "-3.0", -3}};
  for (const auto& c : cases) {
    const auto w = with(c.istf, c.stfac);
    const auto after = in_units(*w, "Mg,m,s");
    EXPECT_EQ(real(*after, "/INTER/TYPE7/1", "Stfac"), c.after) << c.istf << c.stfac;
    const DeckDiff diff = compared(*w, *after);
    EXPECT_TRUE(diff.equal()) << c.istf << c.stfac << shown(diff);
  }
  EXPECT_FALSE(compared(*with("5", "-3.0"), *with("5", "-4.0")).equal());
}

std::string node(const char* x) {
  return "/NODE\n" + cell("1", 10) + cell(x, 20) + cell("0.0", 20) + cell("0.0", 20) + "\n" +
         cell("2", 10) + cell("100.0", 20) + cell("0.0", 20) + cell("0.0", 20) + "\n";
}

TEST(DiffAfterTolerance, CoordinatesAreMeasuredAgainstTheModel) {
  const auto w = deck_of(node("0.0"));
  const DeckDiff diff = compared(*w, *deck_of(node("1e-14")));
  EXPECT_TRUE(diff.equal()) << shown(diff);
  EXPECT_TRUE(has_note(diff, "--tolerance")) << shown(diff);
  const auto moved = deck_of(node("1e-9"));
  EXPECT_FALSE(compared(*w, *moved).equal());
  EXPECT_TRUE(compared(*w, *moved, 1e-10).equal());
  EXPECT_FALSE(compared(*w, *deck_of(node("1e-14")), 0).equal());
  EXPECT_FALSE(has_note(compared(*w, *w), "--tolerance"));
}

TEST(DiffAfterTolerance, TheNoteSaysWhichToleranceLeavesRoundOffOut) {
  const auto with = [](const char* x) {
    return deck_of("/FUNCT/5\nf\n" + cell(x, 20) + cell("1.0", 20) + "\n");
  };
  const auto a = with("-1.06981317007977"), b = with("-1.06981317009355");
  const DeckDiff diff = compared(*a, *b);
  EXPECT_FALSE(diff.equal());
  EXPECT_TRUE(has_note(diff, "with --tolerance 1e-09")) << shown(diff);
  EXPECT_TRUE(compared(*a, *b, 1e-9).equal());
}

TEST(DiffAfterVersion, CellsOnOtherLinesAreComparedByWhatTheyMean) {
  // The columns of version 110; from 120 on Dcrit, D and N have a line behind that of Ixfem.
  const auto w =
      deck_of("/FAIL/TAB/1\n" + cell("1", 10) + cell("1", 10) + cell("1", 10) + "\n" +
                  cell("1.1", 20) + cell("0.2", 20) + cell("3.0", 20) + "\n" + cell("5", 10) +
                  cell("1.0", 20) + cell("0.5", 20) + "\n" + points(5, "2.0"),
              110);
  const auto after = w->after(to_version(w->context(), 2026));
  const DeckDiff diff = compared(*w, *after);
  EXPECT_TRUE(diff.equal()) << shown(diff) << after->main_text();
  std::string other = after->main_text();
  other.replace(other.find("1.1"), 3, "1.2");
  EXPECT_FALSE(compared(*w, *Whole::text(other)).equal());
}

TEST(DiffAfterVersion, WhatTheSolverDoesNotUseIsNoDifference) {
  const auto with = [](const char* istrain) {
    return deck_of("/PROP/SHELL/1\np\n" + cell("24", 10) + "\n\n" + cell("5", 10) +
                   cell(istrain, 10) + cell("1.0", 20) + "\n");
  };
  const DeckDiff diff = compared(*with("1"), *with("0"));
  EXPECT_TRUE(diff.equal()) << shown(diff);
  EXPECT_TRUE(has_note(diff, "does not use")) << shown(diff);
}

}  // namespace
}  // namespace deck::edit_test
