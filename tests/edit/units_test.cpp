// Unit conversion: the same model in other units, and back.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../contact/small_deck.hpp"
#include "deck/edit.hpp"
#include "deck/text.hpp"
#include "edit/convert/units/unit_system.hpp"
#include "edit/units_support.hpp"

namespace deck {
namespace {

using edit_test::real;
using edit_test::Whole;

UnitSystem units(const char* text) {
  auto u = parse_unit_system(text);
  EXPECT_TRUE(u.ok()) << text;
  return *u;
}

Rewrite convert(const Whole& w, const char* target, const UnitsOptions& options = {}) {
  return to_units(w.context(), units(target), options);
}

std::string deck_of(
    const std::string& body, const std::string& version = "2024",
    const std::string& work = "                  kg                  mm                  ms\n") {
  return "#RADIOSS STARTER\n/BEGIN\nrun\n" + std::string(10 - version.size(), ' ') + version +
         "         0\n                  kg                  mm                  ms\n" + work +
         body + "/END\n";
}

// ---- one number ---------------------------------------------------------------------------------

detail::UnitFactor ten_to(int power) {
  detail::UnitFactor f;
  f.power = power;
  f.value = std::pow(10.0L, power);
  return f;
}

TEST(ScaledNumber, ReadsEverySpellingOfADeck) {
  for (const char* text : {"1.5-3", "1.5e-3", "1.5D-03", "+.0015", "15.0E-4", "0.0015"}) {
    const auto s = detail::scale_text(text, 20, ten_to(3));
    ASSERT_TRUE(s) << text;
    EXPECT_EQ(read_real(s->text).value, 1.5) << text;
  }
}

TEST(ScaledNumber, KeepsEveryDigitAndReadsWell) {
  const std::pair<const char*, const char*> thousandth[] = {
      {"210.0", "0.21"},       {"210000.0", "210."},
      {"210000", "210."},      {"-.5", "-0.0005"},
      {"2.60000E+02", "0.26"}, {"1.5d4", "15."},
      {"1.00000E+30", "1e27"}, {"123456789012345678901.5", "1.234567890123456789015e17"}};
  for (const auto& [before, after] : thousandth) {
    const auto s = detail::scale_text(before, 30, ten_to(-3));
    ASSERT_TRUE(s) << before;
    EXPECT_EQ(s->text, after) << before;
    EXPECT_TRUE(s->exact) << before;
  }
  const auto narrow = detail::scale_text("123456.7", 8, ten_to(-6));
  ASSERT_TRUE(narrow);
  EXPECT_EQ(narrow->text, ".1234567");
}

TEST(ScaledNumber, RefusesWhatIsNoNumber) {
  for (const char* text : {"", "abc", "1.5x", "nan", "inf", "1e400", "&gap", "--1", "1 2"})
    EXPECT_FALSE(detail::scale_text(text, 20, ten_to(3))) << text;
}

TEST(ScaledNumber, SaysWhenDigitsAreLost) {
  const auto s = detail::scale_text("-1.234567890123456", 10, ten_to(-3));
  ASSERT_TRUE(s);
  EXPECT_LE(s->text.size(), 10u);
  EXPECT_FALSE(s->exact);
}

TEST(ScaledNumber, DecimalInchesComeBackAsWritten) {
  detail::UnitFactor inch;
  inch.value = 0.0254L;
  std::mt19937 random(5);
  for (int i = 0; i < 20000; ++i) {
    std::string text = std::to_string(static_cast<int>(random() % 2000000) - 1000000) + "." +
                       std::to_string(random() % 100000);
    const auto there = detail::scale_text(text, 20, inch);
    ASSERT_TRUE(there) << text;
    const auto back = detail::scale_text(there->text, 20, inch.inverse());
    ASSERT_TRUE(back) << text;
    EXPECT_EQ(read_real(back->text).value, read_real(text).value) << text << " " << there->text;
    EXPECT_TRUE(there->exact) << text;
  }
}

TEST(ScaledNumber, ExactMeansThereAndBack) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20000; ++i) {
    const double value =
        std::ldexp(static_cast<double>(random() >> 11) + 1, static_cast<int>(random() % 120) - 110);
    const auto text = format_real(value, 20);
    ASSERT_TRUE(text);
    const detail::UnitFactor f = ten_to(static_cast<int>(random() % 25) - 12);
    const auto there = detail::scale_text(text->text, 20, f);
    if (!there) continue;
    const auto back = detail::scale_text(there->text, 20, f.inverse());
    ASSERT_TRUE(back);
    if (there->exact) {
      EXPECT_EQ(read_real(back->text).value, read_real(text->text).value) << text->text;
    }
    EXPECT_NEAR(read_real(there->text).value / read_real(text->text).value,
                static_cast<double>(f.value), 1e-13 * static_cast<double>(f.value));
  }
}

// ---- the deck -----------------------------------------------------------------------------------

TEST(UnitSystemText, IsThreeCodesOrFactors) {
  EXPECT_EQ(units("Mg,mm,s").mass, 1000);
  EXPECT_EQ(units("0.45359237, 0.0254 ,s").length, 0.0254);
  for (const char* bad : {"", "kg", "kg,mm", "kg,mm,", "kg,kg,s", "kg,mm,ms,x", "0,mm,s", "-1,m,s"})
    EXPECT_FALSE(parse_unit_system(bad).ok()) << bad;
}

TEST(ToUnits, KeepWorkingWritesTheWorkingLineThatBlankImplied) {
  for (const std::string work : {"", "\n"}) {
    const auto w = Whole::text(
        deck_of("/NODE\n         1                12.5                 0.0                 0.0\n",
                "2024", work));
    const auto after = w->after(convert(*w, "Mg,m,s", {.partial = false, .keep_working = true}));
    EXPECT_EQ(after->deck.begin.input.length, 1);
    EXPECT_EQ(after->deck.begin.working.length, 0.001);
    EXPECT_EQ(after->model.nodes.x[0], 12.5);
    EXPECT_TRUE(after->contains("              0.0125"));
  }
}

TEST(ToUnits, OldVersionsNameTheirUnitsInHeaders) {
  const auto w = Whole::text(
      "#RADIOSS STARTER\n/BEGIN\nrun\n        90         0\n/UNIT/LENGTH/mm\n/UNIT/MASS/kg\n"
      "/UNIT/TIME/ms\n/NODE\n         1                12.5                 0.0\n/END\n");
  const auto after = w->after(convert(*w, "Mg,m,s"));
  EXPECT_TRUE(after->contains("/UNIT/LENGTH/m\n/UNIT/MASS/Mg\n/UNIT/TIME/s\n"));
  EXPECT_EQ(after->model.nodes.x[0], 0.0125);
}

TEST(ToUnits, KeywordsOfIdsFlagsAndNamesNeedNoConversion) {
  for (const char* header :
       {"/ANALY", "/DEF_SHELL", "/DEF_SOLID", "/IOFLAG", "/MEMORY", "/SPMD", "/BCS/1", "/TH/NODE/1",
        "/ATH/NODE/1", "/RBE2/1", "/SHFRA/1", "/CAA", "/UPWIND", "/RLINK/1", "/DUMMY_START", "/AMS",
        "/FUNCT_PYTHON/1", "/ALE/GRID/ZERO", "/ALE/BCS/1"}) {
    const std::string block = std::string(header) + "\nname 3.7\n                 3.7       5.5\n";
    const auto w = Whole::text(deck_of(block));
    const Rewrite r = convert(*w, "Mg,m,s");
    EXPECT_TRUE(r.refusals.empty()) << r.refusals[0];
    EXPECT_TRUE(w->after(r)->contains(block)) << header;
  }
}

TEST(ToUnits, HeatFunctionOfAContactIsReadAtTheSamePressure) {
  for (const char* card : {"Kthe=2 fct_IDK=5 AscaleK=4", "fct_IDK=5"}) {
    const auto w = Whole::text(test::SmallDeck()
                                   .add("@/INTER/TYPE7/1 Ithe=1 " + std::string(card))
                                   .add("/FUNCT/5\nf\n                 0.0                 1.0\n"
                                        "                10.0                 2.0")
                                   .text());
    const auto before = decode(w->deck, *edit_test::block(w->deck, "/INTER/TYPE7/1"));
    const auto after = w->after(convert(*w, "Mg,m,s"));
    const double kthe = before.real("Kthe"), ascale = before.real("AscaleK");
    EXPECT_EQ(edit_test::real(*after, "/INTER/TYPE7/1", "Kthe"), (kthe == 0 ? 1 : kthe) * 1e6);
    EXPECT_EQ(edit_test::real(*after, "/INTER/TYPE7/1", "AscaleK"),
              (ascale == 0 ? 1 : ascale) * 1e-6);
    EXPECT_TRUE(after->contains("                10.0                 2.0"));
  }
}

TEST(ToUnits, FilterCoefficientArrivesUnchangedInTheSolver) {
  for (const int filter : {1, 2, 3}) {
    const auto w = Whole::text(
        test::SmallDeck()
            .add("@/INTER/TYPE7/1 Ifiltr=" + std::to_string(filter) + " Xfreq=0.25 Fric=0.1")
            .text());
    const auto value = [](const Whole& deck) { return deck.interfaces.type7.at(0).Xfreq.value; };
    ASSERT_EQ(value(*w), 0.25);
    const double scale = filter == 3 ? 1000 : 1;  // 3: a frequency
    EXPECT_EQ(value(*w->after(convert(*w, "Mg,m,s"))), 0.25 * scale) << filter;
    const auto kept = w->after(convert(*w, "Mg,m,s", {.partial = false, .keep_working = true}));
    EXPECT_DOUBLE_EQ(value(*kept), 0.25) << filter;
  }
}

TEST(ToUnits, StiffnessThatTheCardDoesNotNameFollowsTheWorkingUnits) {
  // Istf = 1 from /DEFAULT, and a negative Stfac: the solver takes the number as it is.
  const auto w = Whole::text(test::SmallDeck()
                                 .add("@/DEFAULT/INTER/TYPE7 Istf=1")
                                 .add("@/INTER/TYPE7/1 Stfac=100")
                                 .add("@/INTER/TYPE7/2 Istf=4 Stfac=-3")
                                 .add("@/INTER/TYPE7/3 Istf=4 Stfac=3")
                                 .add("@/INTER/TYPE7/4")
                                 .add("@/INTER/TYPE7/5 Istf=4")
                                 .text());
  const auto after = w->after(convert(*w, "Mg,m,s"));
  EXPECT_EQ(after->interfaces.type7.at(3).Stfac.value, 1e3) << "blank is a stiffness of 1";
  EXPECT_EQ(after->interfaces.type7.at(4).Stfac.value, 1) << "blank is a factor of 1";
  EXPECT_EQ(after->interfaces.type7.at(0).Stfac.value, 1e5);
  EXPECT_EQ(after->interfaces.type7.at(1).Stfac.value, -3e3);
  EXPECT_EQ(after->interfaces.type7.at(2).Stfac.value, 3);
  const auto kept = w->after(convert(*w, "Mg,m,s", {.partial = false, .keep_working = true}));
  EXPECT_EQ(kept->interfaces.type7.at(0).Stfac.value, 100);
  EXPECT_EQ(kept->interfaces.type7.at(1).Stfac.value, -3);
}

/// A block with units of its own keeps its cells, but not what the solver takes in working units.
TEST(ToUnits, WorkingUnitsOfABlockWithItsOwnUnitsFollowToo) {
  const std::string flags = "\ni\n         1         2         ", stiffness = "\n\n\n";
  const auto w = Whole::text(
      deck_of("/UNIT/3\nm\n                  kg                   m                   s\n"
              "/INTER/TYPE7/1/3" +
              flags + "1" + stiffness +
              "\n\n\n"
              "/INTER/TYPE7/2/3" +
              flags + "4" + stiffness +
              "                -3.0\n\n\n"
              "/INTER/TYPE7/4/3" +
              flags + "4" + stiffness + "                 3.0\n\n\n"));
  const auto values = [](const Whole& deck) {
    std::vector<double> out;
    for (const InterType7& inter : deck.interfaces.type7) out.push_back(inter.Stfac.value);
    return out;
  };
  const std::vector<double> before = values(*w);
  ASSERT_DOUBLE_EQ(before.at(0), 1);
  // One kg/ms^2 is 1e6 kg/s^2 and 1e3 Mg/s^2.
  const auto after = w->after(convert(*w, "Mg,m,s"));
  EXPECT_DOUBLE_EQ(real(*after, "/INTER/TYPE7/1/3", "Stfac"), 1e6);
  EXPECT_EQ(values(*after), (std::vector{1e3, 1e3 * before.at(1), 3.0}));
  const auto kept = w->after(convert(*w, "Mg,m,s", {.partial = false, .keep_working = true}));
  EXPECT_EQ(values(*kept), before);
}

/// The solver brings these numbers to working units by a power that is not their own: without mass,
/// as a force, as a pressure. They arrive as before only if the number follows that power.
TEST(ToUnits, WhatTheSolverScalesByAnotherPowerFollowsThatPower) {
  const auto w = Whole::text(
      deck_of("/MAT/LAW4/1\nhydro\n              7.8E-6\n"
              "               210.0                 0.3\n"
              "                 0.2                 0.3                 0.5\n\n"
              "                 0.1                 1.0                 1.0              1500.0\n"
              "                0.25\n"
              "/MAT/LAW14/3\ncompso\n              1.5E-6\n"
              "                40.0                10.0                10.0\n\n"
              "                 4.0                 4.0                 4.0\n"
              "                 8.0                 8.0                 8.0\n\n"
              "/MAT/LAW44/4\ncowper\n              7.8E-6\n"
              "               210.0                 0.3\n"
              "                 0.2                 0.3                 0.5                0.75\n",
              "2022"));
  const auto kept = w->after(convert(*w, "g,cm,ms", {.partial = false, .keep_working = true}));
  const auto value = [](const Whole& deck, const char* keyword, const char* field) {
    for (const Block& b : deck.deck.blocks)
      if (b.schema != nullptr && b.header.starts_with(keyword))
        return decode(deck.deck, b).real(field);
    return -1.0;
  };
  EXPECT_DOUBLE_EQ(value(*kept, "/MAT/LAW4", "RHOCP"), 0.25 * 10);
  EXPECT_DOUBLE_EQ(value(*kept, "/MAT/LAW14", "SIGMA_T1"), 8.0 * 1000 / 10);
  EXPECT_DOUBLE_EQ(value(*kept, "/MAT/LAW44", "C_HARD"), 0.75 * 1000 * 10);
}

/// Curves of a table stand at strain rates, in the units of time; the table is not read.
TEST(ToUnits, TableWithRatesIsRefusedWhereTimeChanges) {
  const auto w =
      Whole::text(deck_of("/MAT/LAW76/1\nsamp\n              1.2E-6\n"
                          "                 2.0                 0.3\n"
                          "         0         6         0\n"
                          "                 1.0                 1.0                 1.0\n"
                          "/TABLE/1/6\ntable\n         2\n"
                          "         7                               0.0                 1.0\n"
                          "         7                             0.001                 1.0\n"
                          "/FUNCT/7\nramp\n                 0.0                 0.0\n"
                          "                 1.0                 1.0\n",
                          "2022"));
  const Rewrite r = convert(*w, "kg,mm,s");
  ASSERT_FALSE(r.refusals.empty());
  EXPECT_NE(r.refusals[0].find("TAB_ID2: an abscissa of this table"), std::string::npos)
      << r.refusals[0];
  EXPECT_TRUE(convert(*w, "g,mm,ms").refusals.empty());
}

TEST(ToUnits, CarriageReturnsTabsOfCommentsAndShortLinesStay) {
  const auto w =
      Whole::text(deck_of("/NODE\r\n# a\tcomment\r\n         1                12.5\r\n"
                          "         2 1.5      \r\n         3        \r       10.0\r\n"));
  const auto after = w->after(convert(*w, "Mg,m,s"));
  EXPECT_TRUE(after->contains("# a\tcomment\r\n         1              0.0125\r\n"))
      << after->main_text();
  EXPECT_EQ(after->model.nodes.x, (std::vector{0.0125, 0.0015, 0.01}));
  EXPECT_EQ(after->main_text().find("\r\r"), std::string::npos);
}

TEST(ToUnits, FileIncludedInTwoUnitSystemsIsRefused) {
  Whole::Files files{
      {"main_0000.rad",
       deck_of("#include part.inc\n//SUBMODEL/1\nsub\n       100\n/BEGIN\nsub\n      2024\n"
               "                  kg                   m                   s\n"
               "                  kg                   m                   s\n"
               "#include part.inc\n//ENDSUB\n")},
      {"part.inc", "/NODE\n         1                12.5                 0.0\n"}};
  const auto w = Whole::read("main_0000.rad", files);
  const Rewrite r = convert(*w, "Mg,m,s");
  ASSERT_EQ(r.refusals.size(), 1u);
  EXPECT_NE(r.refusals[0].find("part.inc"), std::string::npos);
}

TEST(ToUnits, DeckWithoutUnitsIsRefused) {
  EXPECT_FALSE(convert(*Whole::text("/NODE\n         1\n/END\n"), "Mg,m,s").refusals.empty());
  EXPECT_FALSE(
      convert(*Whole::text("/BEGIN\nr\n      2024\n\n\n/END\n"), "Mg,m,s").refusals.empty());
}

}  // namespace
}  // namespace deck
