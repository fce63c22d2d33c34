// Unit conversion: the same model in other units, and back.
// Over 600 lines: independent tests of one conversion.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <random>
#include <set>
#include <sstream>

#include "../contact/small_deck.hpp"
#include "deck/edit/convert.hpp"
#include "deck/text/number.hpp"
#include "edit/convert/units/unit_system_decimal.hpp"
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

TEST(ScaledNumber, PowerOfTenKeepsEveryDigit) {
  const auto s = detail::scale_text("  123.4567890123456 ", 20, ten_to(-3));
  ASSERT_TRUE(s);
  EXPECT_EQ(s->text, "0.1234567890123456");
  EXPECT_TRUE(s->exact);
}

TEST(ScaledNumber, ReadsEverySpellingOfADeck) {
  for (const char* text : {"1.5-3", "1.5e-3", "1.5D-03", "+.0015", "15.0E-4", "0.0015"}) {
    const auto s = detail::scale_text(text, 20, ten_to(3));
    ASSERT_TRUE(s) << text;
    EXPECT_EQ(read_real(s->text).value, 1.5) << text;
  }
}

TEST(ScaledNumber, KeepsTheSpellingOfTheNumber) {
  const std::pair<const char*, const char*> thousandth[] = {
      {"210.0", "0.21"},     {"210000.0", "210.0"},
      {"210000.", "210."},   {"210000", "210"},
      {"-.5", "-.0005"},     {"2.60000000E+02", "2.60000000E-01"},
      {"1.5d4", "1.5d1"},    {"1.00000E+30", "1.00000E+27"},
      {"15.0E-4", "1.5E-6"}, {"3E06", "3E03"},
      {"0.5", "0.0005"}};
  for (const auto& [before, after] : thousandth) {
    const auto s = detail::scale_text(before, 20, ten_to(-3));
    ASSERT_TRUE(s) << before;
    EXPECT_EQ(s->text, after) << before;
  }
}

TEST(ScaledNumber, SpellingGivesWayToDigits) {
  const auto wide = detail::scale_text("123456.7", 8, ten_to(-6));
  ASSERT_TRUE(wide);
  EXPECT_EQ(wide->text, ".1234567");
  const auto exponent = detail::scale_text("1.0000000E9", 8, ten_to(91));
  ASSERT_TRUE(exponent);
  EXPECT_EQ(exponent->text, "1.E100");
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

TEST(ToUnits, ConvertsByTheDimensionOfEachField) {
  const auto w = Whole::text(test::SmallDeck()
                                 .node(1, 12.5, 0, 0)
                                 .shell_part(1, 1.5)
                                 .add("@/INTER/TYPE7/1 Istf=1 Stfac=100 Gapmin=2 Tstart=3 Stmin=4 "
                                      "Ifric=1 C1=5 C2=6 Fric=0.3")
                                 .text());
  const auto after = w->after(convert(*w, "Mg,m,s"));
  EXPECT_EQ(after->model.nodes.x[0], 0.0125);
  EXPECT_EQ(real(*after, "/PROP/SHELL/1", "Thick"), 0.0015);
  EXPECT_DOUBLE_EQ(real(*after, "/MAT/ELAST/1", "E"), 200 * 1e-3 / 1e-3 / 1e-6);  // kg/(mm ms2)
  EXPECT_DOUBLE_EQ(real(*after, "/MAT/ELAST/1", "Rho_I"), 1e-6 * 1e-3 / 1e-9);
  EXPECT_DOUBLE_EQ(real(*after, "/INTER/TYPE7/1", "Stfac"), 100 * 1e-3 / 1e-6);
  EXPECT_EQ(real(*after, "/INTER/TYPE7/1", "Gapmin"), 0.002);
  EXPECT_EQ(real(*after, "/INTER/TYPE7/1", "Tstart"), 0.003);
  EXPECT_EQ(real(*after, "/INTER/TYPE7/1", "Fric"), 0.3);
  EXPECT_DOUBLE_EQ(real(*after, "/INTER/TYPE7/1", "C1"), 5 / (1e-3 / 1e-3 / 1e-6));
  EXPECT_DOUBLE_EQ(real(*after, "/INTER/TYPE7/1", "C2"), 6.0 / (1e-3 / 1e-3));
  EXPECT_EQ(after->deck.begin.input.mass, 1000);
  EXPECT_EQ(after->deck.begin.working.length, 1);
}

TEST(ToUnits, StfacWithoutIstf1IsAPureFactor) {
  const auto w = Whole::text(test::SmallDeck().add("@/INTER/TYPE7/1 Istf=4 Stfac=100").text());
  const auto after = w->after(convert(*w, "Mg,m,s"));
  EXPECT_EQ(real(*after, "/INTER/TYPE7/1", "Stfac"), 100);
}

TEST(ToUnits, WorkingUnitsThatDifferStay) {
  const auto w = Whole::text(
      deck_of("/NODE\n         1                12.5                 0.0                 0.0\n",
              "2024", "                  Mg                   m                   s\n"));
  ASSERT_EQ(w->model.nodes.x[0], 0.0125);
  const auto after = w->after(convert(*w, "g,m,s"));
  EXPECT_EQ(after->model.nodes.x[0], 0.0125);
  EXPECT_EQ(after->deck.begin.input.mass, 0.001);
  EXPECT_EQ(after->deck.begin.working.mass, 1000);
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

TEST(ToUnits, BlocksWithTheirOwnUnitsKeepTheirCells) {
  const auto w = Whole::text(
      deck_of("/UNIT/7\nmetres\n                  kg                   m                   s\n"
              "/NODE/7\n         1                12.5                 0.0                 0.0\n"
              "/NODE\n         2                12.5                 0.0                 0.0\n"));
  const auto after = w->after(convert(*w, "Mg,m,s"));
  EXPECT_EQ(after->model.nodes.x[0], 12.5);
  EXPECT_EQ(after->model.nodes.x[1], 0.0125);
  EXPECT_TRUE(after->contains(
      "/NODE/7\n         1                12.5                 0.0                 0.0\n"));
}

TEST(ToUnits, SubmodelsWithTheirOwnBeginKeepTheirCells) {
  const auto w = Whole::text(deck_of(
      "//SUBMODEL/1\nsub\n\n/BEGIN\nsub\n      2024\n                  kg                   m"
      "                   s\n                  kg                   m                   s\n/NODE\n"
      "         1                12.5                 0.0                 0.0\n//ENDSUB\n/NODE\n"
      "         2                12.5                 0.0                 0.0\n"));
  ASSERT_EQ(w->model.nodes.x[0], 12500);
  const auto after = w->after(convert(*w, "Mg,m,s"));
  EXPECT_EQ(after->model.nodes.x[0], 12.5);
  EXPECT_EQ(after->model.nodes.x[1], 0.0125);
}

TEST(ToUnits, UndescribedZerosAreNoReasonToRefuse) {
  const std::string card = "/SENSOR/DISP/1\ns\n                 0.0\n         1         2\n";
  EXPECT_TRUE(convert(*Whole::text(deck_of(card + "                 0.0         0\n\n")), "Mg,m,s")
                  .refusals.empty());
  EXPECT_EQ(
      convert(*Whole::text(deck_of(card + "                 0.7\n")), "Mg,m,s").refusals.size(),
      1u);
}

/// Cells of twenty columns from column 11 on, the numbers at their left ends.
std::string clause_row(std::string clause, std::vector<std::string> cells) {
  clause.resize(10, ' ');
  for (std::string& cell : cells) {
    cell.resize(20, ' ');
    clause += cell;
  }
  return clause;
}

TEST(ToUnits, PlanesAndEllipsesOfASetAreLengthsOnTwoLines) {
  const std::string behind = std::string(17, ' ') + "9.0\n";  // no cell of the clause
  const std::string title = clause_row("PLANE", {"7.0", "8.0", "9.0"}) + "\n";
  const std::string set =
      title + "PART               1         2\n" + clause_row("PLANE", {"5.0", "6.0", "7.0"}) +
      behind + clause_row("", {"15.0", "25.0", "0.0"}) + behind +
      "NODE               3         4\n" + clause_row("ELLIPS", {"50.0", "", "70.0"}) + "\n" +
      clause_row("", {"1.5", "2.5", "3.5"}) + "\nNODE               5         6\n";
  const auto w = Whole::text(deck_of("/SET/GENERAL/9\n" + set));
  const Rewrite r = convert(*w, "Mg,m,s");
  const auto after = w->after(r);
  std::vector<std::vector<double>> numbers;
  std::istringstream in(after->main_text().substr(after->main_text().find(title)));
  for (std::string line; std::getline(in, line) && line != "/END";) {
    std::istringstream cells(line.substr(std::min<std::size_t>(10, line.size())));
    numbers.emplace_back(std::istream_iterator<double>(cells), std::istream_iterator<double>());
  }
  EXPECT_EQ(numbers, (std::vector<std::vector<double>>{{7, 8, 9},
                                                       {1, 2},
                                                       {0.005, 0.006, 0.007, 9},
                                                       {0.015, 0.025, 0, 9},
                                                       {3, 4},
                                                       {0.05, 0.07},
                                                       {0.0015, 0.0025, 0.0035},
                                                       {5, 6}}));
  EXPECT_EQ(std::count_if(r.losses.begin(), r.losses.end(),
                          [](const LossEntry& e) { return e.note == "10 values converted"; }),
            1);
  EXPECT_TRUE(std::any_of(r.notes.begin(), r.notes.end(),
                          [](const std::string& note) { return note.starts_with("length"); }));
  // A set with units of its own stays.
  const auto own = Whole::text(
      deck_of("/UNIT/5\nm\n                  kg                   m                   s\n"
              "/SET/GENERAL/9/5\n" +
              set));
  EXPECT_TRUE(own->after(convert(*own, "Mg,m,s"))->contains(set));
}

TEST(ToUnits, TheToleranceOfACnodeIsALength) {
  const std::string node =
      "\n        20                 1.5                 0.0                 0.0\n";
  const auto after = [&](const std::string& header) {
    const auto w = Whole::text(deck_of(header + node));
    return w->after(convert(*w, "Mg,m,s"))->main_text();
  };
  const auto contains = [](const std::string& text, const char* what) {
    return text.find(what) != std::string::npos;
  };
  EXPECT_TRUE(contains(after("/CNODE/2.5"), "/CNODE/0.0025\n")) << after("/CNODE/2.5");
  EXPECT_TRUE(contains(after("/CNODE/2.5"), " 0.0015 "));
  EXPECT_TRUE(contains(after("/CNODE/0"), "/CNODE/0\n"));
  EXPECT_TRUE(contains(after("/CNODE"), "/CNODE\n"));
  const Rewrite r = convert(*Whole::text(deck_of("/CNODE/x1" + node)), "Mg,m,s");
  ASSERT_FALSE(r.refusals.empty());
  EXPECT_TRUE(contains(r.refusals[0], ":7:8: ")) << r.refusals[0];
  EXPECT_TRUE(contains(r.refusals[0], "tolerance: 'x1' is not a plain number")) << r.refusals[0];
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

TEST(ToUnits, DefaultThatIsOneUnitIsWrittenOut) {
  const auto w = Whole::text(test::SmallDeck().add("@/INTER/TYPE7/1 Istf=1 Stfac=0").text());
  const auto after = w->after(convert(*w, "Mg,m,s"));
  EXPECT_DOUBLE_EQ(real(*after, "/INTER/TYPE7/1", "Stfac"), 1e-3 / 1e-6);
  // Bounds that no value reaches are no default with a unit.
  EXPECT_EQ(real(*after, "/INTER/TYPE7/1", "Tstop"), 0);
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
                                 .text());
  const auto after = w->after(convert(*w, "Mg,m,s"));
  EXPECT_EQ(after->interfaces.type7.at(0).Stfac.value, 1e5);
  EXPECT_EQ(after->interfaces.type7.at(1).Stfac.value, -3e3);
  EXPECT_EQ(after->interfaces.type7.at(2).Stfac.value, 3);
  const auto kept = w->after(convert(*w, "Mg,m,s", {.partial = false, .keep_working = true}));
  EXPECT_EQ(kept->interfaces.type7.at(0).Stfac.value, 100);
  EXPECT_EQ(kept->interfaces.type7.at(1).Stfac.value, -3);
}

/// A block with units of its own keeps its cells, but not what the solver takes in working units.
TEST(ToUnits, WorkingUnitsOfABlockWithItsOwnUnitsFollowToo) {
  std::string text =
      test::SmallDeck()
          .add("/UNIT/3\nm\n                  kg                   m                   s")
          .add("@/INTER/TYPE7/1 Istf=1 Stfac=0 Gapmin=0.5")
          .add("@/INTER/TYPE7/2 Istf=4 Stfac=-3")
          .add("@/INTER/TYPE7/4 Istf=4 Stfac=3")
          .text();
  for (const char* id : {"1", "2", "4"}) {
    const std::string header = std::string("/INTER/TYPE7/") + id + "\n";
    text.replace(text.find(header), header.size(), std::string("/INTER/TYPE7/") + id + "/3\n");
  }
  const auto w = Whole::text(text);
  ASSERT_DOUBLE_EQ(w->interfaces.type7.at(0).Gapmin.value, 500);
  const auto stiffness = [](const Whole& deck, std::size_t i) {
    return deck.interfaces.type7.at(i).Stfac.value;
  };
  const auto after = w->after(convert(*w, "Mg,m,s"));
  EXPECT_EQ(real(*after, "/INTER/TYPE7/1/3", "Gapmin"), 0.5);
  EXPECT_DOUBLE_EQ(after->interfaces.type7.at(0).Gapmin.value, 0.5);
  // One kg/ms^2 is 1e6 kg/s^2 and 1e3 Mg/s^2.
  EXPECT_DOUBLE_EQ(stiffness(*w, 0), 1);
  EXPECT_DOUBLE_EQ(real(*after, "/INTER/TYPE7/1/3", "Stfac"), 1e6);
  EXPECT_DOUBLE_EQ(stiffness(*after, 0), 1e3);
  EXPECT_DOUBLE_EQ(stiffness(*after, 1), 1e3 * stiffness(*w, 1));
  EXPECT_DOUBLE_EQ(stiffness(*after, 2), 3);
  const Rewrite kept = convert(*w, "Mg,m,s", {.partial = false, .keep_working = true});
  const auto same = w->after(kept);
  EXPECT_EQ(real(*same, "/INTER/TYPE7/1/3", "Stfac"), 0);
  for (const std::size_t i : {0u, 1u, 2u}) EXPECT_DOUBLE_EQ(stiffness(*same, i), stiffness(*w, i));
  EXPECT_EQ(std::count(kept.notes.begin(), kept.notes.end(),
                       "3 blocks have units of their own and keep their values"),
            1);
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
                          "         2 1.5      \r\n"));
  const auto after = w->after(convert(*w, "Mg,m,s"));
  EXPECT_TRUE(after->contains("# a\tcomment\r\n         1              0.0125\r\n"))
      << after->main_text();
  EXPECT_EQ(after->model.nodes.x[1], 0.0015);
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

TEST(ToUnits, IncludesAreChangedWhereTheyAre) {
  Whole::Files files{{"main_0000.rad", deck_of("#include part.inc\n")},
                     {"part.inc", "/NODE\n         1                12.5                 0.0\n"}};
  const auto w = Whole::read("main_0000.rad", files);
  const auto after = w->after(convert(*w, "Mg,m,s"));
  EXPECT_EQ(after->files.at("part.inc"),
            "/NODE\n         1              0.0125                 0.0\n");
  EXPECT_TRUE(after->contains("#include part.inc\n"));
}

TEST(ToUnits, DeckWithAnUnreadableIncludeIsRefused) {
  const auto w = Whole::text(deck_of("#include nowhere.inc\n"));
  const Rewrite r = convert(*w, "Mg,m,s", {.partial = true});
  ASSERT_EQ(r.refusals.size(), 1u);
  EXPECT_EQ(r.refusals[0].substr(0, 20), "memory_0000.rad:7:1:");
}

TEST(ToUnits, SameUnitsChangeNothing) {
  const auto w = Whole::text(test::SmallDeck().node(1, 12.5, 0, 0).text());
  EXPECT_TRUE(convert(*w, "kg,mm,ms").edits.empty());
}

TEST(ToUnits, DeckWithoutUnitsIsRefused) {
  EXPECT_FALSE(convert(*Whole::text("/NODE\n         1\n/END\n"), "Mg,m,s").refusals.empty());
  EXPECT_FALSE(
      convert(*Whole::text("/BEGIN\nr\n      2024\n\n\n/END\n"), "Mg,m,s").refusals.empty());
}

// ---- properties ---------------------------------------------------------------------------------

/// Random small models: whatever the numbers look like, there and back gives the same values.
TEST(ToUnits, ThereAndBackIsTheIdentityOnValues) {
  std::mt19937_64 random(11);
  const char* const targets[] = {"Mg,mm,s", "kg,m,s", "g,mm,ms", "kg,cm,us", "Gg,m,ks"};
  std::uniform_real_distribution<double> coordinate(-2000, 2000), small(0.01, 3);
  for (int round = 0; round < 40; ++round) {
    test::SmallDeck small_deck;
    for (int n = 1; n <= 20; ++n)
      small_deck.node(n, coordinate(random), coordinate(random), coordinate(random));
    small_deck.shell_part(1, small(random), small(random)).shell_part(2, small(random));
    small_deck.add("@/INTER/TYPE7/1 Istf=1 Stfac=" + std::to_string(small(random)) + " Gapmin=" +
                   std::to_string(small(random)) + " Ifric=2 C1=" + std::to_string(small(random)) +
                   " C6=" + std::to_string(small(random)));
    const auto number = [&] { return std::to_string(small(random)); };
    small_deck.add("@/INTER/TYPE2/2 Ignore=1 Spotflag=25 dsearch=" + number() +
                   " Stfac=" + number() + " Istf=" + std::to_string(round % 5 + 1));
    small_deck.add("@/INTER/TYPE2/3 Spotflag=20 dsearch=" + number() + " Max_N_Dist=" + number() +
                   " Fscaledist=" + number() + " Area=" + number());
    small_deck.add("@/INTER/TYPE24/4 Gap_max_s=" + number() + " Ipen_max=" + number() +
                   " Stfac=" + number());
    small_deck.add("@/INTER/TYPE25/5 Igap=5 Gap_max_m=" + number() + " Gap_scale=" + number() +
                   " Stmin=" + number() + " THICK_S=" + number() + " Tstop=" + number());
    const auto w = Whole::text(small_deck.text());
    const auto there = w->after(convert(*w, targets[round % 5]));
    const auto back = there->after(convert(*there, "kg,mm,ms"));
    EXPECT_EQ(edit_test::real_values(w->deck), edit_test::real_values(back->deck));
    EXPECT_EQ(back->deck.begin.input, w->deck.begin.input);
    EXPECT_EQ(back->deck.begin.working, w->deck.begin.working);
  }
}

/// With the working units kept the solver computes with the same numbers.
TEST(ToUnits, KeepWorkingLeavesTheSceneAsItIs) {
  const auto small = [] {
    test::SmallDeck d;
    for (int i = 0; i < 4; ++i)
      d.node(i + 1, i % 2 * 10.0, i / 2 * 10.0, 0.0).node(i + 5, i % 2 * 9.0, i / 2 * 9.0, 1.23);
    return d.shell_part(1, 1.5)
        .shell_part(2, 2.5)
        .shell(1, 1, 1, 2, 4, 3)
        .shell(2, 2, 5, 6, 8, 7)
        .group("/SURF/PART/1", {1})
        .group("/GRNOD/PART/2", {2})
        .add("@/INTER/TYPE7/1 Igap=1 Istf=4 Inacti=5")
        .text();
  }();
  const auto w = Whole::text(small);
  const auto after = w->after(convert(*w, "Mg,m,s", {.partial = false, .keep_working = true}));
  const test::Built a(w->main_text()), b(after->main_text());
  const Contact &x = a.contact(), &y = b.contact();
  ASSERT_EQ(x.main.size(), y.main.size());
  ASSERT_EQ(x.secondary.size(), y.secondary.size());
  ASSERT_GT(x.penetrations.size(), 0u);
  ASSERT_EQ(x.penetrations.size(), y.penetrations.size());
  EXPECT_NEAR(x.gapmin, y.gapmin, 1e-14 * x.gapmin);
  for (std::size_t i = 0; i < x.main.size(); ++i) {
    EXPECT_EQ(x.main[i].nodes, y.main[i].nodes);
    EXPECT_NEAR(x.main[i].stiffness, y.main[i].stiffness, 1e-14 * x.main[i].stiffness);
  }
  for (std::size_t i = 0; i < x.penetrations.size(); ++i)
    EXPECT_NEAR(x.penetrations[i].depth, y.penetrations[i].depth, 1e-13);
}

/// Decks of one feature each: all their keywords are described well enough, and the contacts are
/// the same, in the old working units and in the new ones.
TEST(ToUnits, SyntheticDecksKeepTheirContacts) {
  for (const char name : {'a', 'b', 'c', 'd', 'e', 'f', 'g'}) {
    const std::string path =
        edit_test::corpus("synthetic/syn" + std::string(1, name) + "_0000.rad");
    if (path.empty()) GTEST_SKIP() << "no real decks here";
    const auto w = Whole::read(path);
    for (const bool keep : {true, false}) {
      const auto after = w->after(convert(*w, "kg,m,s", {.partial = false, .keep_working = keep}));
      Diagnostics ignored;
      const Scene x = build_scene(w->model, w->interfaces, ignored);
      const Scene y = build_scene(after->model, after->interfaces, ignored);
      const double length = keep ? 1 : 1e-3, stiffness = keep ? 1 : 1e6;  // kg mm ms to kg m s
      ASSERT_EQ(x.contacts.size(), y.contacts.size());
      for (std::size_t i = 0; i < x.contacts.size(); ++i) {
        const Contact &a = x.contacts[i], &b = y.contacts[i];
        EXPECT_NEAR(b.gapmin, a.gapmin * length, 1e-13 * a.gapmin * length) << path;
        ASSERT_EQ(a.main.size(), b.main.size());
        ASSERT_EQ(a.secondary.size(), b.secondary.size());
        for (std::size_t k = 0; k < a.main.size(); ++k) {
          const MainSegment &p = a.main[k], &q = b.main[k];
          EXPECT_EQ(p.nodes, q.nodes);
          if (p.stiffness < 1e-20) continue;  // no area: the solver's floor has no unit
          EXPECT_NEAR(q.stiffness, p.stiffness * stiffness, 1e-12 * p.stiffness * stiffness);
          EXPECT_NEAR(q.gap, p.gap * length, 1e-13 * p.gap * length);
        }
      }
    }
  }
}

TEST(ToUnits, DummyOfFourMegabytesInWellUnderASecond) {
  const std::string path = edit_test::corpus("EuroSID_II/EuroSID_II_0000.rad");
  if (path.empty()) GTEST_SKIP() << "no real decks here";
  const auto w = Whole::read(path);
  const auto start = std::chrono::steady_clock::now();
  const Rewrite r = convert(*w, "kg,m,s", {.partial = true});
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  RecordProperty("milliseconds", static_cast<int>(seconds * 1000));
  EXPECT_LT(seconds, 5) << "0.1 s on an idle machine";
  ASSERT_TRUE(r.refusals.empty());
  const auto there = w->after(r);
  const std::string from = w->deck.begin.input.mass_code + "," + w->deck.begin.input.length_code +
                           "," + w->deck.begin.input.time_code;
  const auto back = there->after(convert(*there, from.c_str(), {.partial = true}));
  const auto a = edit_test::real_values(w->deck);
  auto b = edit_test::real_values(back->deck);
  // A function that two uses read in different units has a copy now.
  std::set<std::pair<std::string, std::int64_t>> blocks;
  for (const auto& value : a) blocks.emplace(std::get<0>(value), std::get<1>(value));
  std::erase_if(b, [&](const auto& value) {
    return !blocks.contains({std::get<0>(value), std::get<1>(value)});
  });
  ASSERT_EQ(a.size(), b.size());
  std::size_t different = 0;
  // A blank scale of a function is 1 in the units of its block; it is written out.
  for (std::size_t i = 0; i < a.size(); ++i)
    different += a[i] == b[i] || (std::get<3>(a[i]) == 0 && std::get<3>(b[i]) == 1) ? 0 : 1;
  EXPECT_EQ(different, 0u);
  std::size_t lost = 0;
  for (const LossEntry& e : r.losses) lost += e.loss == Loss::approximated ? 1 : 0;
  EXPECT_EQ(lost, 0u);
}

TEST(Units, ACarriageReturnAmidACellIsABlankOfTheCell) {
  const auto w = Whole::text(
      deck_of("/NODE\n         1        \r       10.0                 2.0                 3.0\n"));
  const auto after = w->after(convert(*w, "kg,m,ms"));
  ASSERT_EQ(after->model.nodes.size(), 1U);
  EXPECT_EQ(after->model.nodes.x[0], 0.01) << after->main_text();
  EXPECT_EQ(after->model.nodes.y[0], 0.002) << after->main_text();
}

TEST(Units, EveryCellOfAListIsConverted) {
  const auto deck = Whole::text(
      "#RADIOSS STARTER\n/BEGIN\nx\n      2022         0\n"
      "                  kg                  mm                  ms\n"
      "                  kg                  mm                  ms\n"
      "/MAT/LAW62/1\nfoam\n              5.0e-8\n"
      "                 0.3         3         0\n"
      "              1.5e-2              2.5e-3              3.5e-4\n"
      "                 2.0                -2.0                 4.0\n/END\n");
  const auto after = deck->after(to_units(deck->context(), *parse_unit_system("g,mm,ms")));
  std::vector<double> was, now;
  for (const auto& [whole, out] : {std::pair{deck.get(), &was}, std::pair{after.get(), &now}})
    for (const edit_test::RealValue& v : edit_test::real_values(whole->deck))
      if (std::get<2>(v) == "mu_i") out->push_back(std::get<3>(v));
  ASSERT_EQ(was.size(), 3u);
  ASSERT_EQ(now.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(now[i], 1000 * was[i]);
}

}  // namespace
}  // namespace deck
