// Unit conversion of what depends on more than one cell: functions and their scales, values that
// count in units of another cell, and dimensions that depend on a word.
#include <gtest/gtest.h>

#include "deck/edit/convert.hpp"
#include "edit/units_support.hpp"

namespace deck {
namespace {

using edit_test::real;
using edit_test::Whole;

std::unique_ptr<Whole> deck_of(const std::string& body, const char* work = "kg,mm,ms",
                               const std::string& version = "2022") {
  const auto line = [](std::string_view units) {
    std::string text;
    for (int i = 0; i < 3; ++i) {
      const auto cut = std::min(units.find(','), units.size());
      text += std::string(20 - cut, ' ') + std::string(units.substr(0, cut));
      units.remove_prefix(std::min(cut + 1, units.size()));
    }
    return text + "\n";
  };
  return Whole::text("#RADIOSS STARTER\n/BEGIN\nrun\n" + std::string(10 - version.size(), ' ') +
                     version + "         0\n" + line("kg,mm,ms") + line(work) + body + "/END\n");
}

Rewrite convert(const Whole& w, const char* target, const UnitsOptions& options = {}) {
  auto units = parse_unit_system(target);
  EXPECT_TRUE(units.ok());
  return to_units(w.context(), *units, options);
}

std::string cell(const char* text, int width) {
  const std::string s = text;
  return std::string(static_cast<std::size_t>(width) - s.size(), ' ') + s;
}

std::string load(const char* header, const char* direction, const char* scale_y) {
  return std::string(header) + "\nload\n         5" + cell(direction, 10) +
         "         0         0         3         0\n" + cell("", 20) + cell(scale_y, 20) + "\n";
}

const char* const curve =
    "/FUNCT/5\nf\n                 0.0                 1.0\n"
    "                10.0                 2.0\n";

TEST(ToUnitsFunctions, BlankScalesOfALoadAreWrittenOutAndThePointsStay) {
  const auto w = deck_of(load("/IMPVEL/1", "X", "") + curve);
  const auto after = w->after(convert(*w, "Mg,m,s"));
  EXPECT_EQ(real(*after, "/IMPVEL/1", "Scale_x"), 0.001);
  EXPECT_EQ(real(*after, "/IMPVEL/1", "Scale_y"), 0) << "mm/ms is m/s";
  EXPECT_TRUE(after->contains(curve)) << after->main_text();
}

TEST(ToUnitsFunctions, AZeroScaleAmongOthersOfAListIsWrittenInItsOwnColumns) {
  const auto w = deck_of("/MAT/LAW36/1\nm\n" + cell("7.8E-06", 20) + "\n" + cell("210.0", 20) +
                         cell("0.3", 20) + "\n         3\n\n         5         5         5\n" +
                         cell("2.0", 20) + cell("0.0", 20) + cell("3.0", 20) + "\n" +
                         cell("1.0", 20) + cell("2.0", 20) + cell("3.0", 20) + "\n" + curve);
  const Rewrite there = convert(*w, "Mg,mm,s");
  EXPECT_TRUE(there.refusals.empty());
  const auto after = w->after(there);
  ASSERT_TRUE(after);
  EXPECT_TRUE(
      after->contains("\n" + cell("2000.0", 20) + cell("1000.0", 20) + cell("3000.0", 20) + "\n"))
      << after->main_text();
}

TEST(ToUnitsFunctions, TheDirectionDecidesTheDimensionOfTheScale) {
  for (const auto& [direction, scale] : {std::pair{"X", 0.003}, {"XX", 3.0}, {"yy", 3.0}}) {
    const auto w = deck_of(load("/IMPDISP/1", direction, "3.0") + curve);
    const auto after = w->after(convert(*w, "kg,m,ms"));
    EXPECT_EQ(real(*after, "/IMPDISP/1", "Scale_y"), scale) << direction;
  }
}

TEST(ToUnitsFunctions, ScaleOfAFunctionThatIsNotThereStaysBlank) {
  const std::string pload = "/PLOAD/1\np\n         1         0\n";
  const auto w = deck_of(pload);
  EXPECT_TRUE(w->after(convert(*w, "Mg,m,s"))->contains(pload));
}

TEST(ToUnitsFunctions, ValuesThatTheSolverTakesAsTheyAreStayWhereWorkingUnitsStay) {
  const std::string gravity = "/GRAV/1\ng\n         5         Z         0         0         3" +
                              cell("", 30) + cell("0.00981", 20) + "\n";
  const auto same = deck_of(gravity + curve);
  EXPECT_EQ(real(*same->after(convert(*same, "kg,m,s")), "/GRAV/1", "Fscale_Y"), 9.81);
  const auto other = deck_of(gravity + curve, "kg,m,s");
  EXPECT_EQ(real(*other->after(convert(*other, "Mg,mm,s")), "/GRAV/1", "Fscale_Y"), 0.00981);
}

std::string spring(const char* ascale, const char* id) {
  return "/PROP/SPRING/7\ns\n" + cell("0.1", 20) + "\n" + cell("2.0", 20) + cell("", 20) +
         cell("", 60) + "\n" + cell(id, 10) + cell("", 50) + cell("-4.0", 20) + cell("6.0", 20) +
         "\n" + cell("", 40) + cell(ascale, 20) + "\n";
}

TEST(ToUnitsFunctions, LimitsThatCountInUnitsOfAScaleChangeOnlyWithoutIt) {
  const auto plain = deck_of(spring("", "0"));
  EXPECT_EQ(real(*plain->after(convert(*plain, "kg,m,ms")), "/PROP/SPRING/7", "DeltaMax"), 0.006);
  for (const char* scale : {"", "2.0"}) {
    const auto scaled = deck_of(spring(scale, "5") + curve);
    const auto after = scaled->after(convert(*scaled, "kg,m,ms"));
    EXPECT_EQ(real(*after, "/PROP/SPRING/7", "DeltaMax"), 6.0) << scale;
    EXPECT_EQ(real(*after, "/PROP/SPRING/7", "AScale1"), *scale == '\0' ? 0.001 : 0.002);
  }
}

TEST(ToUnitsFunctions, AFactorWithoutItsFunctionOnlyDividesTheContactStiffnessAndStays) {
  const auto with = [](const char* id) {
    return deck_of("/PROP/SPRING/7\ns\n" + cell("0.1", 20) + "\n" + cell("3.0", 20) + cell("", 20) +
                   cell("2.0", 20) + "\n" + cell(id, 10) + "\n" + curve);
  };
  const auto without = with("0");
  EXPECT_EQ(real(*without->after(convert(*without, "kg,m,ms")), "/PROP/SPRING/7", "A"), 2.0);
}

/// TYPE4 with a function: K, A and B as given.
std::string following(const char* k, const char* a, const char* b, const char* f2, const char* h) {
  return "/PROP/SPRING/7\ns\n" + cell("0.1", 20) + "\n" + cell(k, 20) + cell("", 20) + cell(a, 20) +
         cell(b, 20) + "\n" + cell("5", 10) + cell(h, 10) + cell(f2, 10) + "\n" + cell("", 20) +
         cell("4.0", 20) + "\n";
}

TEST(ToUnitsFunctions, ASpringKeepsTheNumbersThatDivideItsContactStiffnessAndThePointsChange) {
  const auto w = deck_of(following("3.0", "2.0", "7.0", "6", "0") + curve +
                         "/FUNCT/6\ng\n                 0.0                 1.5\n");
  const auto after = w->after(convert(*w, "kg,m,ms"));
  EXPECT_EQ(real(*after, "/PROP/SPRING/7", "A"), 2.0);
  EXPECT_EQ(real(*after, "/PROP/SPRING/7", "B"), 7.0);
  EXPECT_EQ(real(*after, "/PROP/SPRING/7", "E1"), 4.0);
  EXPECT_EQ(real(*after, "/PROP/SPRING/7", "AScale1"), 0.001);
  EXPECT_TRUE(after->contains("                10.0               0.002\n")) << after->main_text();
  EXPECT_TRUE(after->contains("/FUNCT/6\ng\n                 0.0                 1.5\n"));
  const auto back = after->after(convert(*after, "kg,mm,ms"));
  EXPECT_TRUE(back->contains(curve)) << back->main_text();
}

TEST(ToUnitsFunctions, ASpringThatCountsInNoContactHasItsScaleConverted) {
  for (const char* h : {"0", "5"}) {  // no stiffness; the second function is no force
    const auto w = deck_of(following(*h == '0' ? "" : "3.0", "2.0", "", "0", h) + curve);
    const auto after = w->after(convert(*w, "kg,m,ms"));
    EXPECT_EQ(real(*after, "/PROP/SPRING/7", "A"), 0.002) << h;
    EXPECT_TRUE(after->contains(curve)) << after->main_text();
  }
}

TEST(ToUnitsFunctions, ScalesOnLinesThatTheBlockLeavesAwayAreAdded) {
  const std::string head = "/IMPVEL/1\nload\n         5         X         0         0         3\n";
  const auto w = deck_of(head + curve);
  EXPECT_TRUE(w->after(convert(*w, "kg,m,s"))->contains(head + cell("0.001", 20) + "\n" + curve));
  const auto spring = deck_of("/PROP/SPRING/7\ns\n" + cell("0.1", 20) + "\n" + cell("3.0", 20) +
                              "\n" + cell("5", 10) + "\n" + curve);
  const auto after = spring->after(convert(*spring, "kg,m,ms"));
  EXPECT_EQ(real(*after, "/PROP/SPRING/7", "AScale1"), 0.001);
  EXPECT_EQ(real(*after, "/PROP/SPRING/7", "A"), 0.0);
}

TEST(ToUnitsFunctions, SpringsPerUnitLengthHaveOtherDimensions) {
  const auto w = deck_of("/PROP/SPRING/7\ns\n" + cell("0.1", 20) + cell("", 50) + cell("1", 10) +
                         "\n" + cell("3.0", 20) + "\n");
  EXPECT_EQ(w->deck.diagnostics.counts().size(), 0u);
  const auto after = w->after(convert(*w, "kg,m,ms"));
  const std::int64_t per_length =
      decode(w->deck, *edit_test::block(w->deck, "/PROP/SPRING/7")).integer("Ileng");
  ASSERT_EQ(per_length, 1);
  EXPECT_EQ(real(*after, "/PROP/SPRING/7", "Mass"), 100.0);
  EXPECT_EQ(real(*after, "/PROP/SPRING/7", "K"), 0.003);
}

// ---- points -------------------------------------------------------------------------------------

/// A joint: the abscissa of its friction function is a length and has no scale.
std::string joint(const char* id) {
  return "/PROP/KJOINT2/9\nj\n         3" + cell("", 90) + "\n" + cell("1.0", 20) + "\n\n" +
         cell("1.0", 20) + cell("2.0", 20) + cell(id, 10) + "\n";
}

TEST(ToUnitsFunctions, PointsOfAnAxisWithoutScaleAreConverted) {
  const auto w = deck_of(joint("5") + curve);
  const auto after = w->after(convert(*w, "kg,m,ms"));
  EXPECT_TRUE(
      after->contains("/FUNCT/5\nf\n                 0.0                 1.0\n"
                      "                0.01                 2.0\n"))
      << after->main_text();
}

TEST(ToUnitsFunctions, PointsStayWhereWorkingUnitsStay) {
  const auto w = deck_of(joint("5") + curve, "kg,m,s");
  EXPECT_TRUE(w->after(convert(*w, "Mg,cm,s"))->contains(curve));
}

TEST(ToUnitsFunctions, PointsThatTwoUsesReadInDifferentUnitsGetACopy) {
  const auto w = deck_of(joint("5") + load("/IMPVEL/1", "X", "1.0") + curve);
  const Rewrite r = convert(*w, "kg,m,ms");
  const auto after = w->after(r);
  EXPECT_TRUE(after->contains(std::string(curve) +
                              "/FUNCT/6\nf\n                 0.0                 1.0\n"
                              "                0.01                 2.0\n"))
      << after->main_text();
  EXPECT_TRUE(after->contains(cell("0.002", 20) + cell("6", 10) + "\n/IMPVEL"))
      << after->main_text();
  EXPECT_TRUE(after->contains("/IMPVEL/1\nload\n         5")) << after->main_text();
  bool said = false;
  for (const LossEntry& e : r.losses) said |= e.old_text == "5" && e.new_text == "6";
  EXPECT_TRUE(said);
}

TEST(ToUnitsFunctions, ACopyBringsTheBlockThatMovesItsFunction) {
  const std::string move = "/MOVE_FUNCT/5\nm\n" + cell("1.0", 20) + cell("1.0", 20) +
                           cell("30.0", 20) + cell("0.0", 20) + "\n";
  const auto w = deck_of(joint("5") + load("/IMPVEL/1", "X", "1.0") + curve + move);
  const auto after = w->after(convert(*w, "kg,m,ms"));
  EXPECT_EQ(real(*after, "/MOVE_FUNCT/5", "Ashift_x"), 30.0);
  EXPECT_EQ(real(*after, "/MOVE_FUNCT/6", "Ashift_x"), 0.03);
}

TEST(ToUnitsFunctions, AFunctionThatATableMayUseStaysAndIsCopied) {
  const auto w = deck_of(joint("5") + curve + "/TABLE/1/9\nt\n         1\n         5\n");
  const auto after = w->after(convert(*w, "kg,m,ms"));
  EXPECT_TRUE(after->contains(curve)) << after->main_text();
  EXPECT_NE(edit_test::block(after->deck, "/FUNCT/10"), nullptr) << after->main_text();
}

// ---- added mass ---------------------------------------------------------------------------------

TEST(ToUnitsFunctions, AddedMassOfASurfaceIsMassPerArea) {
  const auto w = deck_of("/ADMAS/2/4\nm\n" + cell("3.0", 20) + cell("1", 10) + "\n/ADMAS/5/6\nm\n" +
                         cell("3.0", 20) + cell("1", 10) + "\n");
  const auto after = w->after(convert(*w, "kg,m,ms"));
  EXPECT_EQ(real(*after, "/ADMAS/2/4", "MASS"), 3e6);
  EXPECT_EQ(real(*after, "/ADMAS/5/6", "MASS"), 3.0);
}

// ---- what is left -------------------------------------------------------------------------------

TEST(ToUnitsFunctions, PartialLeavesABlockAsItWasWhenOneOfItsValuesIsOpen) {
  const std::string material =
      "/MAT/ELAST/1\nm\n" + cell("1e-6", 20) + "\n" + cell("200.0x", 20) + cell("0.3", 20) + "\n";
  const auto w = deck_of(material + "/SENSOR/TIME/1\ns\n" + cell("2.0", 20) + "\n");
  const Rewrite r = convert(*w, "Mg,mm,s", {.partial = true});
  const auto after = w->after(r);
  EXPECT_TRUE(after->contains(material)) << after->main_text();
  EXPECT_EQ(real(*after, "/SENSOR/TIME/1", "Tdelay"), 0.002);
  std::size_t open = 0;
  for (const LossEntry& e : r.losses)
    open += e.loss == Loss::undecided && e.keyword == "/MAT/ELAST";
  EXPECT_EQ(open, 1u);
}

}  // namespace
}  // namespace deck
