// Unit conversion: the same model in other units, and back.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../contact/small_deck.hpp"
#include "deck/edit.hpp"
#include "deck/text.hpp"
#include "edit/convert/units/unit_system.hpp"
#include "edit/support.hpp"

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
        "/ATH/NODE/1", "/RBE2/1", "/SHFRA/V4", "/CAA", "/UPWIND", "/RLINK/1", "/DUMMY_START",
        "/AMS", "/FUNCT_PYTHON/1", "/ALE/GRID/ZERO", "/ALE/BCS/1"}) {
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
  const auto w = Whole::text(test::SmallDeck()
                                 .add("@/MAT/LAW4/11 RHOCP=0.25")
                                 .add("@/MAT/LAW14/12 SIGMA_T1=8.0")
                                 .add("@/MAT/LAW44/13 C_HARD=0.75")
                                 .text());
  const auto kept = w->after(convert(*w, "g,cm,ms", {.partial = false, .keep_working = true}));
  EXPECT_DOUBLE_EQ(real(*kept, "/MAT/LAW4/11", "RHOCP"), 0.25 * 10);
  EXPECT_DOUBLE_EQ(real(*kept, "/MAT/LAW14/12", "SIGMA_T1"), 8.0 * 1000 / 10);
  EXPECT_DOUBLE_EQ(real(*kept, "/MAT/LAW44/13", "C_HARD"), 0.75 * 1000 * 10);
}

/// Curves of a table stand at strain rates, in the units of time; the table is not read.
TEST(ToUnits, TableWithRatesIsRefusedWhereTimeChanges) {
  const auto w =
      Whole::text(test::SmallDeck()
                      .add("@/MAT/LAW76/11 TAB_ID2=6")
                      .add("/TABLE/1/6\ntable\n         2\n"
                           "         7                               0.0                 1.0\n"
                           "         7                             0.001                 1.0\n"
                           "/FUNCT/7\nramp\n                 0.0                 0.0\n"
                           "                 1.0                 1.0")
                      .text());
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

using edit_test::Whole;

std::string rich_deck() {
  test::SmallDeck d;
  for (int i = 0; i < 4; ++i) d.node(i + 1, i % 2 * 10.0, i / 2 * 10.0, 0.0);
  for (int i = 0; i < 4; ++i) d.node(i + 5, i % 2 * 9.0, i / 2 * 9.0, 1.0);
  d.shell_part(1, 1.5).shell_part(2, 2.5).solid_part(3).beam_part(4, 2.0);
  d.shell(1, 1, 1, 2, 4, 3).shell(2, 2, 5, 6, 8, 7).brick(3, 3, {1, 2, 4, 3, 5, 6, 8, 7});
  d.bar("BEAM", 4, 4, 1, 2, 3);
  d.group("/SURF/PART/1", {1}).group("/SURF/PART/EXT/3", {3}).group("/GRNOD/PART/2", {2, -1});
  d.group("/GRNOD/GENE/3", {1, 4}).group("/SUBSET/1", {2}).group("/LINE/EDGE/1", {1});
  d.add(
      "/SET/GENERAL/9\nset\nPART               1         2\nNODE_GD            1         3"
      "         1\nSEG                1         1         2         4         3\nRBODY"
      "              1\nPLANE                      1.0                 2.0                 3.0\n"
      "                     1.0                 2.0                 4.0");
  d.add("/PARAMETER/GLOBAL/REAL/1\np\ngap                        0.5");
  d.add("/PARAMETER/LOCAL/REAL_EXPR/2\np\ntwo       2*gap+&gap");
  d.add("/UNIT/5\nm\n                  kg                   m                   s");
  d.add(
      "//SUBMODEL/1\nsub\n       100\n/NODE/5\n         1                 1.0\n/GRNOD/NODE/1\ng\n"
      "         1\n//ENDSUB");
  d.add("/CNODE/0.1\n        20                 1.0                 0.0                 0.0");
  d.add("/TETRA10/3\n        30\n         1         2         3         5");
  d.add(
      "/TRANSFORM/TRA/1\nt\n         2                 0.0                 0.0                 "
      "0.1");
  d.add("@/INTER/TYPE7/1 Gapmin=&gap Igap=1 Inacti=5 Istf=1 Stfac=7 Ifric=1 C1=3");
  d.add("@/INTER/TYPE19/2 surf_IDs=9 surf_IDm=3 Igap=1");
  d.add("@/INTER/TYPE11/3 line_IDs=1 Igap=1");
  d.add("/RBODY/1\nr\n         5\n/THING/7\n  1 2 3.5 &gap\n#include a.inc\n#include a.inc");
  return d.text();
}

void convert_all(const std::string& main, const std::string& include) {
  const auto w = Whole::read("main_0000.rad", {{"main_0000.rad", main}, {"a.inc", include}});
  if (w->deck.sources.size() == 0) return;
  const auto check = [&](const Rewrite& r) {
    if (!r.refusals.empty()) return;
    const auto changed = apply_rewrite(w->deck.sources, r);
    if (!changed) return;  // contradicting edits of a file that is included twice
    Whole::Files files = w->files;
    for (const auto& [path, text] : *changed) files[path] = text;
    ReadOptions options;
    options.overlay = &files;
    EXPECT_TRUE(read_deck("main_0000.rad", SchemaSet::built_in(), options).ok());
  };
  for (const bool partial : {false, true}) {
    check(to_units(w->context(), *parse_unit_system("Mg,0.0254,s"), {.partial = partial}));
    RenumberOptions options;
    options.partial = partial;
    options.rules = {*parse_renumber_rule("all+1000")};
    check(renumber(w->context(), options));
    options.rules = {*parse_renumber_rule("node=1"), *parse_renumber_rule("element=5")};
    check(renumber(w->context(), options));
  }
  check(flatten(w->context()));
  std::vector<std::int64_t> ids;
  for (const InterBase* i : w->interfaces.ordered) ids.push_back(i->id);
  check(extract_contacts(w->context(), ids));
}

TEST(BrokenDecks, ConversionsNeverHurt) {
  const std::string good = rich_deck();
  const std::string include =
      "/PARAMETER/LOCAL/REAL/1\np\ngap                        0.7\n/NODE\n        50"
      "                &gap\n/END\n";
  convert_all(good, include);
  std::mt19937 random(51);
  for (int round = 0; round < 400; ++round) {
    std::string main = good, other = include;
    std::string& text = round % 4 == 0 ? other : main;
    for (int k = static_cast<int>(random() % 10); k >= 0; --k) {
      const std::size_t at = random() % (text.size() + 1);
      switch (random() % 6) {
        case 0:
          text.insert(at, 1, static_cast<char>(random() % 256));
          break;
        case 1:
          text.erase(at, random() % 30);
          break;
        case 2:
          text.insert(at, text.substr(random() % (text.size() + 1), random() % 80));
          break;
        case 3:
          text.insert(at, ",");
          break;
        case 4:
          text.insert(at, "\n");
          break;
        default:
          if (at < text.size()) text[at] = "0123456789-&/#.e"[random() % 16];
      }
    }
    convert_all(main, other);
  }
}

}  // namespace
}  // namespace deck
