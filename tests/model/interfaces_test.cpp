// Tests of effective values and where they come from.
// Over 600 lines: independent tests, a few lines for each field.
#include "deck/model/interfaces.hpp"
#include "deck/text/rule_id.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace deck {
namespace {

/// A deck of interface blocks, read and turned into effective values.
struct Read {
  explicit Read(const std::string& blocks, int version = 2022, Model m = {},
                const std::string& units = {})
      : model(std::move(m)) {
    std::string same =
        "                  Mg                  mm                   s\n"
        "                  Mg                  mm                   s\n";
    std::string number = std::to_string(version);
    std::string text = "#RADIOSS STARTER\n/BEGIN\nrun\n" + std::string(10 - number.size(), ' ') +
                       number + "         0\n" + (units.empty() ? same : units) + blocks + "/END\n";
    auto result = read_deck_text("test_0000.rad", text, SchemaSet::built_in());
    EXPECT_TRUE(result.ok());
    deck = std::move(*result);
    all = read_interfaces(deck, model, diagnostics);
  }
  bool found(RuleId rule) const { return diagnostics.counts().contains(rule); }
  Deck deck;
  Model model;
  Diagnostics diagnostics;
  Interfaces all;
};

/// Flags, gap line, stiffness line, Stfac line, release line, friction line of a TYPE7 (from 2018).
struct Type7Text {
  std::string flags = "         1         2";
  std::string gap, bounds, stfac, release, friction, more;
  std::string str() const {
    return "/INTER/TYPE7/5\ntitle\n" + flags + "\n" + gap + "\n" + bounds + "\n" + stfac + "\n" +
           release + "\n" + friction + "\n" + more;
  }
};

/// Text that ends in the given column.
std::string at(int column, const std::string& text) {
  return std::string(static_cast<std::size_t>(column) - text.size(), ' ') + text;
}
/// `line` with `text` ending in `column`.
std::string with(std::string line, int column, const std::string& text) {
  if (static_cast<int>(line.size()) < column) line.resize(static_cast<std::size_t>(column), ' ');
  line.replace(static_cast<std::size_t>(column) - text.size(), text.size(), text);
  return line;
}

Model airbag_model() {
  Model m;
  m.has_monitored_volume = true;
  return m;
}

constexpr const char* default7 =
    "/DEFAULT/INTER/TYPE7\n\n"
    "                             4                   1                   1         2\n\n"
    "                                                                                         2"
    "         1\n\n"
    "                                       6\n"
    "                                                 2\n";

// ---- flags -------------------------------------------------------------------------------------

TEST(InterfaceFlags, BlankFlagsTakeTheBuiltInDefault) {
  const Read r(Type7Text{}.str());
  const InterType7& t = r.all.type7.at(0);
  EXPECT_EQ(t.Istf.value, 1000);
  EXPECT_EQ(t.Igap.value, 1000);
  EXPECT_EQ(t.Inacti.value, 1000);
  EXPECT_EQ(t.Iform.value, 1);
  EXPECT_EQ(t.Irem_gap.value, 1);
  EXPECT_EQ(t.Irem_i2.value, 3);
  EXPECT_EQ(t.Istf.origin, Origin::built_in);
  EXPECT_FALSE(t.Istf.has_input);
}

TEST(InterfaceFlags, ImplicitRunsRemoveTiedNodes) {
  Model m;
  m.implicit = true;
  EXPECT_EQ(Read(Type7Text{}.str(), 2022, std::move(m)).all.type7.at(0).Irem_i2.value, 1);
}

TEST(InterfaceFlags, DefaultCardFillsBlankFlags) {
  const Read r(default7 + Type7Text{}.str(), 2022, airbag_model());
  const InterType7& t = r.all.type7.at(0);
  EXPECT_EQ(t.Istf.value, 4);
  EXPECT_EQ(t.Igap.value, 1);
  EXPECT_EQ(t.Ibag.value, 1);
  EXPECT_EQ(t.Idel.value, 2);
  EXPECT_EQ(t.Irem_gap.value, 2);
  EXPECT_EQ(t.Irem_i2.value, 1);
  EXPECT_EQ(t.Inacti.value, 6);
  EXPECT_EQ(t.Iform.value, 2);
  for (const auto* e : {&t.Istf, &t.Igap, &t.Ibag, &t.Idel, &t.Irem_gap, &t.Irem_i2, &t.Inacti})
    EXPECT_EQ(e->origin, Origin::default_block);
  EXPECT_EQ(r.deck.sources.text(t.Inacti.span), "         6");
}

TEST(InterfaceFlags, CardWinsOverDefaultCard) {
  Type7Text text;
  text.flags = with(text.flags, 30, "1000");
  const Read r(default7 + text.str());
  EXPECT_EQ(r.all.type7.at(0).Istf.value, 1000);
  EXPECT_EQ(r.all.type7.at(0).Istf.origin, Origin::card);
}

TEST(InterfaceFlags, ThePlaceOfTheDefaultCardIsOfNoConsequence) {
  const Read r(Type7Text{}.str() + default7);
  EXPECT_EQ(r.all.type7.at(0).Istf.value, 4);
  EXPECT_EQ(r.all.type7.at(0).Istf.origin, Origin::default_block);
}

TEST(InterfaceFlags, DefaultCardWithoutItsBlankLinesDoesNothing) {
  const Read r("/DEFAULT/INTER/TYPE7\n" + with(at(30, "4"), 50, "3") + "\n" + at(90, "2") + "\n" +
               at(40, "6") + "\n" + at(50, "2") + "\n" + Type7Text{}.str());
  const InterType7& t = r.all.type7.at(0);
  for (const auto* e : {&t.Istf, &t.Igap, &t.Inacti}) EXPECT_EQ(e->value, 1000);
  EXPECT_EQ(t.Irem_gap.value, 1);
  EXPECT_EQ(t.Iform.value, 1);
}

TEST(InterfaceFlags, TextOnTheBlankLinesCountsForNothing) {
  const Read r("/DEFAULT/INTER/TYPE7\nmy defaults\n" + at(30, "4") + "\n         1\n" +
               at(90, "2") + "\n# no line\n0\n" + at(40, "6") + "\n" + Type7Text{}.str());
  EXPECT_EQ(r.all.type7.at(0).Istf.value, 4);
  EXPECT_EQ(r.all.type7.at(0).Irem_gap.value, 2);
  EXPECT_EQ(r.all.type7.at(0).Inacti.value, 6);
  EXPECT_EQ(r.all.type7.at(0).Iform.value, 1);
}

TEST(InterfaceFlags, DefaultCardFillsFlagsThatTheVersionHasNoCellFor) {
  const Read r(default7 + std::string("/INTER/TYPE7/5\nt\n         1         2\n\n\n\n\n\n"), 110);
  EXPECT_EQ(r.all.type7.at(0).Irem_gap.value, 2);
  EXPECT_EQ(r.all.type7.at(0).Irem_i2.value, 1);
}

TEST(InterfaceFlags, NothingIsOneWhereAFlagHasNoNothing) {
  // Irem_gap and Irem_i2 at the end of the bounds, Iform behind them, all 1000.
  const std::string block = "/DEFAULT/INTER/TYPE7\n\n\n\n" + with(at(90, "1000"), 100, "1000") +
                            "\n\n\n" + at(50, "1000") + "\n";
  for (const bool card : {false, true}) {
    Type7Text text;
    if (card) {
      text.bounds = with(at(90, "1000"), 100, "1000");
      text.friction = at(50, "1000");
    }
    const Read r((card ? std::string(default7) : block) + text.str());
    const InterType7& t = r.all.type7.at(0);
    EXPECT_EQ(t.Irem_gap.value, 1);
    EXPECT_EQ(t.Irem_i2.value, 3);
    EXPECT_EQ(t.Iform.value, 1);
    EXPECT_EQ(t.Iform.origin, card ? Origin::derived : Origin::default_block);
  }
}

TEST(InterfaceFlags, SecondDefaultCardIsAnErrorAndTheFirstOneStands) {
  const Read r(std::string(default7) + "/DEFAULT/INTER/TYPE7\n\n" + at(30, "2") + "\n\n\n\n\n\n" +
               Type7Text{}.str());
  EXPECT_EQ(r.all.type7.at(0).Istf.value, 4);
  ASSERT_TRUE(r.found(RuleId::DK504));
  EXPECT_EQ(r.diagnostics.all().at(0).reference->number, 1073);
  EXPECT_EQ(r.all.defaults.size(), 1u);
}

TEST(InterfaceFlags, DefaultCardInsideASubmodelIsIgnored) {
  const Read r("//SUBMODEL/1\nsub\n\n" + std::string(default7) + "//ENDSUB\n" + Type7Text{}.str());
  EXPECT_EQ(r.all.type7.at(0).Istf.value, 1000);
  EXPECT_TRUE(r.found(RuleId::DK503));
}

TEST(InterfaceFlags, DefaultOfOneTypeLeavesOthersAlone) {
  const Read r(std::string(default7) + "/INTER/TYPE11/6\nlines\n         1\n\n\n\n\n");
  EXPECT_EQ(r.all.type11.at(0).Igap.value, 1000);
  EXPECT_EQ(r.all.type11.at(0).Istf.value, 5);
}

TEST(InterfaceFlags, NothingOnALineContactsCardBeatsTheDefaultCard) {
  const Read r("/DEFAULT/INTER/TYPE11\n\n" + at(30, "4") + "\n\n\n\n/INTER/TYPE11/6\nlines\n" +
               with("         1         2", 30, "1000") + "\n\n\n\n\n");
  EXPECT_EQ(r.all.type11.at(0).Istf.value, 5);
}

TEST(InterfaceFlags, AirbagFlagNeedsAnAirbag) {
  Type7Text text;
  text.flags = with(text.flags, 70, "1");
  const Read without(text.str());
  EXPECT_EQ(without.all.type7.at(0).Ibag.value, 1000);
  EXPECT_EQ(without.all.type7.at(0).Ibag.origin, Origin::derived);
  EXPECT_EQ(Read(text.str(), 2022, airbag_model()).all.type7.at(0).Ibag.value, 1);
}

TEST(InterfaceFlags, AdaptiveFlagNeedsAdaptiveMeshing) {
  Type7Text text;
  text.flags = with(text.flags, 100, "2");
  text.more = "\n";  // the adaptive line
  EXPECT_EQ(Read(text.str()).all.type7.at(0).Iadm.value, 0);
  Model m;
  m.has_adaptive_mesh = true;
  const Read r(text.str(), 2022, std::move(m));
  EXPECT_EQ(r.all.type7.at(0).Iadm.value, 2);
  EXPECT_EQ(r.all.type7.at(0).NRadm.value, 3);
  EXPECT_EQ(r.all.type7.at(0).Padm.value, 1.0);
}

TEST(InterfaceFlags, DeletionKnowsOneAndTwoOnly) {
  const auto idel = [](const std::string& value) {
    Type7Text text;
    text.flags = with(text.flags, 80, value);
    return Read(text.str()).all.type7.at(0).Idel.value;
  };
  EXPECT_EQ(idel("1"), 1);
  EXPECT_EQ(idel("-2"), -2);
  EXPECT_EQ(idel("3"), 1000);
  EXPECT_EQ(idel("-3"), 1000);
  EXPECT_EQ(idel("1000"), 1000);
}

// ---- gaps and stiffness ------------------------------------------------------------------------

TEST(InterfaceGap, ConstantGapIgnoresScaleAndMaximum) {
  Type7Text text;
  text.gap = with(at(20, "0.8"), 40, "3.0");
  const InterType7 t = Read(text.str()).all.type7.at(0);
  EXPECT_EQ(t.Fscalegap.value, 1.0);
  EXPECT_EQ(t.Gapmax.value, 1e30);
  EXPECT_EQ(t.Fscalegap.input, 0.8);
  EXPECT_EQ(t.Fscalegap.origin, Origin::derived);
}

TEST(InterfaceGap, ScaledGapUsesThem) {
  Type7Text text;
  text.flags = with(text.flags, 50, "2");
  text.gap = with(at(20, "0.8"), 40, "3.0");
  const InterType7 t = Read(text.str()).all.type7.at(0);
  EXPECT_EQ(t.Fscalegap.value, 0.8);
  EXPECT_EQ(t.Gapmax.value, 3.0);
  EXPECT_EQ(t.Gapmax.origin, Origin::card);
}

TEST(InterfaceGap, MeshFractionDefaultsForIgap3Only) {
  Type7Text text;
  EXPECT_EQ(Read(text.str()).all.type7.at(0).mesh_size.value, 0.0);
  text.flags = with(text.flags, 50, "3");
  EXPECT_EQ(Read(text.str()).all.type7.at(0).mesh_size.value, 0.4);
}

TEST(InterfaceGap, BlankOrNegativeGapminIsLeftToTheGeometry) {
  Type7Text text;
  EXPECT_EQ(Read(text.str()).all.type7.at(0).Gapmin.origin, Origin::geometry);
  text.stfac = at(60, "-1.0");
  const InterType7 t = Read(text.str()).all.type7.at(0);
  EXPECT_EQ(t.Gapmin.origin, Origin::geometry);
  EXPECT_EQ(t.Gapmin.value, 0.0);
  EXPECT_EQ(t.Gapmin.input, -1.0);
}

TEST(InterfaceStiffness, BoundsCountForIstf2To5Only) {
  Type7Text text;
  text.bounds = with(at(20, "5.0"), 40, "9.0");
  EXPECT_EQ(Read(text.str()).all.type7.at(0).Stmin.value, 0.0);
  EXPECT_EQ(Read(text.str()).all.type7.at(0).Stmax.value, 1e30);
  for (const char* istf : {"1", "2", "3", "4", "5", "1000"}) {
    text.flags = with(text.flags, 30, "     " + std::string(istf));
    const InterType7 t = Read(text.str()).all.type7.at(0);
    const bool count = std::string(istf) >= "2";
    EXPECT_EQ(t.Stmin.value, count ? 5.0 : 0.0) << istf;
    EXPECT_EQ(t.Stmax.value, count ? 9.0 : 1e30) << istf;
  }
}

TEST(InterfaceStiffness, SortingFactorGrowsWithTheModel) {
  const auto bumult = [](std::size_t nodes) {
    Model m;
    m.nodes.id.resize(nodes);
    return Read(Type7Text{}.str(), 2022, std::move(m)).all.type7.at(0).Bumult.value;
  };
  EXPECT_EQ(bumult(1500000), 0.2);
  EXPECT_EQ(bumult(1500001), 0.3);
  EXPECT_EQ(bumult(2500001), 0.4);
}

// ---- friction ----------------------------------------------------------------------------------

TEST(InterfaceFriction, DampingIsOneOnlyWhereThereIsFriction) {
  Type7Text text;
  EXPECT_EQ(Read(text.str()).all.type7.at(0).VISF.value, 0.0);
  text.stfac = at(40, "0.1");
  EXPECT_EQ(Read(text.str()).all.type7.at(0).VISF.value, 1.0);
  text.friction = at(50, "2");
  EXPECT_EQ(Read(text.str()).all.type7.at(0).VISF.value, 0.0);
}

TEST(InterfaceFriction, FilterNeedsAFactor) {
  Type7Text text;
  text.friction = at(20, "2");
  EXPECT_EQ(Read(text.str()).all.type7.at(0).Ifiltr.value, 0);
  EXPECT_EQ(Read(text.str()).all.type7.at(0).Ifiltr.input, 2);
  text.friction = with(at(20, "2"), 40, "0.5");
  EXPECT_EQ(Read(text.str()).all.type7.at(0).Ifiltr.value, 2);
}

TEST(InterfaceFriction, FrictionBlockReplacesTheCard) {
  Type7Text text;
  text.stfac = at(40, "0.9");
  text.friction = with(with(at(20, "1"), 40, "0.3"), 100, "7");
  const std::string friction =
      "/FRICTION/7\nlaw\n" + with(with(with(at(10, "4"), 20, "3"), 40, "0.05"), 50, "1") + "\n" +
      with(at(20, "0.4"), 40, "0.01") + "\n" + with(at(20, "0"), 40, "0.2") + "\n" +
      with(at(30, "11"), 40, "12") + "\n" + at(20, "0.7") + "\n" + at(40, "0.6") + "\n";
  const Read r(text.str() + friction);
  const InterType7& t = r.all.type7.at(0);
  EXPECT_EQ(t.Ifric.value, 4);
  EXPECT_EQ(t.Ifiltr.value, 3);
  EXPECT_EQ(t.Xfreq.value, 0.05);
  EXPECT_EQ(t.Fric.value, 0.2);
  EXPECT_EQ(t.VISF.value, 1.0);
  EXPECT_EQ(t.C1.value, 0.4);
  EXPECT_EQ(t.C2.value, 0.01);
  EXPECT_EQ(t.Fric.origin, Origin::derived);
  EXPECT_EQ(t.Fric.input, 0.9);
  const Friction* f = r.all.friction(7);
  ASSERT_NE(f, nullptr);
  ASSERT_EQ(f->pairs.size(), 1u);
  EXPECT_EQ(f->pairs[0].part_ID1, 11);
  EXPECT_EQ(f->pairs[0].part_ID2, 12);
  EXPECT_EQ(f->pairs[0].values.C[0], 0.7);
  EXPECT_EQ(f->pairs[0].values.Fric, 0.6);
  EXPECT_EQ(f->pairs[0].values.VISF, 1.0);
}

TEST(InterfaceFriction, PairsWithoutFrictionHaveNoDampingEither) {
  const Read r("/FRICTION/7\nlaw\n\n\n\n" + with(at(30, "11"), 40, "12") + "\n\n\n" +
               with(at(30, "11"), 40, "13") + "\n\n" + at(40, "0.6") + "\n");
  const Friction* f = r.all.friction(7);
  ASSERT_NE(f, nullptr);
  ASSERT_EQ(f->pairs.size(), 2u);
  EXPECT_EQ(f->values.VISF, 0.0);
  EXPECT_EQ(f->pairs[0].values.VISF, 0.0);
  EXPECT_EQ(f->pairs[1].values.VISF, 1.0);
}

TEST(InterfaceFriction, MissingFrictionBlockLeavesTheCard) {
  Type7Text text;
  text.stfac = at(40, "0.9");
  text.friction = at(100, "7");
  EXPECT_EQ(Read(text.str()).all.type7.at(0).Fric.value, 0.9);
}

TEST(InterfaceFriction, OrthotropicPairHasTwoSetsOfValues) {
  const Read r("/FRICTION/7\nlaw\n\n\n\n" + with(with(at(10, "3"), 20, "4"), 60, "1") + "\n\n" +
               at(40, "0.1") + "\n\n" + at(40, "0.2") + "\n" + at(40, "13") + "\n\n" +
               at(40, "0.3") + "\n");
  const Friction* f = r.all.friction(7);
  ASSERT_EQ(f->pairs.size(), 2u);
  EXPECT_EQ(f->pairs[0].grpart_ID1, 3);
  EXPECT_EQ(f->pairs[0].values.Fric, 0.1);
  EXPECT_EQ(f->pairs[0].second.Fric, 0.2);
  EXPECT_EQ(f->pairs[1].part_ID2, 13);
  EXPECT_EQ(f->pairs[1].values.Fric, 0.3);
}

// ---- heat --------------------------------------------------------------------------------------

TEST(InterfaceHeat, ExchangeNeedsAThermalMaterial) {
  Type7Text text;
  text.flags = with(text.flags, 40, "1");
  text.more = "\n\n";
  const InterType7 off = Read(text.str()).all.type7.at(0);
  EXPECT_EQ(off.Ithe.value, 0);
  EXPECT_EQ(off.Ithe.input, 1);
  Model m;
  m.has_thermal_material = true;
  const InterType7 on = Read(text.str(), 2022, std::move(m)).all.type7.at(0);
  EXPECT_EQ(on.Ithe.value, 1);
  EXPECT_EQ(on.Kthe.value, 1e-30);
  EXPECT_EQ(on.AscaleK.value, 1.0);
  EXPECT_EQ(on.Drad.origin, Origin::geometry);
}

TEST(InterfaceHeat, CoefficientOfAFunctionDefaultsToOne) {
  Type7Text text;
  text.flags = with(text.flags, 40, "1");
  text.more = at(30, "9") + "\n\n";
  Model m;
  m.has_thermal_material = true;
  EXPECT_EQ(Read(text.str(), 2022, std::move(m)).all.type7.at(0).Kthe.value, 1.0);
}

TEST(InterfaceHeat, OldVersionsNameTheCoefficientRthe) {
  Model m;
  m.has_thermal_material = true;
  const Read r("/INTER/TYPE7/5\nold\n" + with("         1         2", 40, "1") + "\n\n\n\n\n\n" +
                   at(20, "3.0") + "\n",
               120, std::move(m));
  EXPECT_EQ(r.all.type7.at(0).Kthe.value, 3.0);
}

// ---- ids, units, versions ----------------------------------------------------------------------

TEST(InterfaceIds, SubmodelOffsetsShiftOwnAndForeignIds) {
  Type7Text text;
  text.flags = with("         1         2", 90, "2");
  text.bounds = "\n" + with(at(10, "8"), 20, "9");
  const Read r("//SUBMODEL/1\nsub\n" + with(at(10, "100"), 20, "1000") + "\n" + text.str() +
               "//ENDSUB\n");
  const InterType7& t = r.all.type7.at(0);
  EXPECT_EQ(t.id, 105);
  EXPECT_EQ(t.grnd_IDs.value, 101);
  EXPECT_EQ(t.surf_IDm.value, 102);
  EXPECT_EQ(t.node_ID1.value, 1008);
  EXPECT_EQ(t.node_ID2.value, 1009);
}

TEST(InterfaceIds, ZeroStaysZeroInASubmodel) {
  Type7Text text;
  text.flags = at(20, "2");
  const Read r("//SUBMODEL/1\nsub\n       100\n" + text.str() + "//ENDSUB\n");
  EXPECT_EQ(r.all.type7.at(0).grnd_IDs.value, 0);
}

TEST(InterfaceUnits, ValuesAreInWorkingUnits) {
  Type7Text text;
  text.flags = with(text.flags, 50, "2");
  text.gap = with(at(20, "0.5"), 40, "0.25");
  text.stfac = with(with(at(20, "2.0"), 60, "0.5"), 80, "8.0");
  const Read r(text.str(), 2022, {},
               "                  kg                   m                   s\n"
               "                  kg                  mm                  ms\n");
  const InterType7& t = r.all.type7.at(0);
  EXPECT_EQ(t.Fscalegap.value, 0.5);
  EXPECT_DOUBLE_EQ(t.Gapmax.value, 250.0);
  EXPECT_DOUBLE_EQ(t.Gapmin.value, 500.0);
  EXPECT_DOUBLE_EQ(t.Tstart.value, 8000.0);
  EXPECT_EQ(t.Stfac.value, 2.0) << "a factor, not a stiffness";
}

TEST(InterfaceUnits, StfacIsAStiffnessForIstf1) {
  Type7Text text;
  text.flags = with(text.flags, 30, "1");
  text.stfac = at(20, "2.0");
  const Read r(text.str(), 2022, {},
               "                  kg                   m                   s\n"
               "                  kg                   m                  ms\n");
  EXPECT_DOUBLE_EQ(r.all.type7.at(0).Stfac.value, 2e-6);
}

TEST(InterfaceFields, ReleaseFlagsAreThreeDigits) {
  Type7Text text;
  EXPECT_EQ(Read(text.str()).all.type7.at(0).IBC.value, "000");
  EXPECT_FALSE(Read(text.str()).all.type7.at(0).IBC.has_input);
  text.release = "       1 1";
  const Read r(text.str());
  EXPECT_EQ(r.all.type7.at(0).IBC.value, "101");
  EXPECT_EQ(r.deck.sources.text(r.all.type7.at(0).IBC.span), "1 1");
  text.release = "       201";
  EXPECT_EQ(Read(text.str()).all.type7.at(0).IBC.value, "001") << "only the digit 1 counts";
}

TEST(InterfaceFields, MissingLinesReadAsBlank) {
  const Read r("/INTER/TYPE7/5\ntitle\n         1         2         4\n");
  EXPECT_EQ(r.all.type7.at(0).Istf.value, 4);
  EXPECT_EQ(r.all.type7.at(0).Stfac.value, 1.0);
  EXPECT_EQ(r.all.type7.at(0).Tstop.value, 1e30);
}

TEST(InterfaceFields, SmoothingOf2026IsNamedAsNotEvaluated) {
  Type7Text text;
  text.gap = at(100, "1");
  EXPECT_TRUE(Read(text.str(), 2026).found(RuleId::DK299));
  EXPECT_FALSE(Read(text.str(), 2025).found(RuleId::DK299)) << "no such cell before";
}

// ---- types 10, 11, 19 --------------------------------------------------------------------------

TEST(Type10, HasItsOwnDefaultsAndNoDefaultCard) {
  const Read r(std::string(default7) + "/INTER/TYPE10/3\ntied\n         1         2\n\n\n");
  const InterType10& t = r.all.type10.at(0);
  EXPECT_EQ(t.Stfac.value, 0.2);
  EXPECT_EQ(t.VISs.value, 0.05);
  EXPECT_EQ(t.Bumult.value, 0.2);
  EXPECT_EQ(t.Tstop.value, 1e30);
  EXPECT_EQ(t.Idel.value, 0);
  EXPECT_EQ(t.Gap.origin, Origin::geometry);
}

TEST(Type11, MainSideDefaultsToTheSecondarySide) {
  const Read r("/INTER/TYPE11/3\nedges\n         4\n\n\n\n\n");
  EXPECT_EQ(r.all.type11.at(0).line_IDm.value, 4);
  EXPECT_EQ(r.all.type11.at(0).line_IDm.origin, Origin::derived);
}

TEST(Type11, StiffnessIsInSeriesUnlessAsked) {
  const auto istf = [](const std::string& value) {
    return Read("/INTER/TYPE11/3\nedges\n" + with(at(10, "4"), 30, value) + "\n\n\n\n\n")
        .all.type11.at(0)
        .Istf.value;
  };
  EXPECT_EQ(istf("0"), 5);
  EXPECT_EQ(istf("1000"), 5);
  EXPECT_EQ(istf("2"), 2);
}

TEST(Type11, BoundsCountExceptForConstantStiffness) {
  const auto stmax = [](const std::string& istf) {
    return Read("/INTER/TYPE11/3\nedges\n" + with(at(10, "4"), 30, istf) + "\n" + at(40, "7.0") +
                "\n\n\n\n")
        .all.type11.at(0)
        .Stmax.value;
  };
  EXPECT_EQ(stmax("0"), 7.0);
  EXPECT_EQ(stmax("1"), 1e30);
}

TEST(Type11, IncrementalFormulationKeepsTheDampingOfTheCard) {
  const std::string text = "/INTER/TYPE11/3\nedges\n         4\n" + at(90, "2") + "\n" +
                           at(40, "0.3") + "\n" + at(80, "0.6") + "\n\n";
  EXPECT_EQ(Read(text).all.type11.at(0).VISF.value, 0.6);
}

TEST(Type19, OneSurfaceIsSelfContact) {
  const Read main("/INTER/TYPE19/3\nt\n" + at(20, "4") + "\n\n\n\n\n\n");
  EXPECT_EQ(main.all.type19.at(0).surf_IDs.value, 4);
  const Read secondary("/INTER/TYPE19/3\nt\n" + at(10, "4") + "\n\n\n\n\n\n");
  EXPECT_EQ(secondary.all.type19.at(0).surf_IDm.value, 4);
}

TEST(Type19, EdgeSelectionOfTheCardIsNotRead) {
  const std::string text =
      "/INTER/TYPE19/3\nt\n" + with("         1         2", 60, "1") + "\n\n\n\n\n\n";
  const Read r(text);
  EXPECT_EQ(r.all.type19.at(0).Iedge.value, 2);
  EXPECT_EQ(r.all.type19.at(0).Iedge.input, 1);
  const Read with_default("/DEFAULT/INTER/TYPE19\n\n" + at(60, "1") + "\n\n\n\n\n\n" + text);
  EXPECT_EQ(with_default.all.type19.at(0).Iedge.value, 1);
  EXPECT_EQ(with_default.all.type19.at(0).Iedge.origin, Origin::default_block);
}

TEST(Type19, Igap4RemovesNearNodes) {
  const Read r("/INTER/TYPE19/3\nt\n" + with("         1         2", 50, "4") + "\n\n\n\n\n\n");
  EXPECT_EQ(r.all.type19.at(0).Igap.value, 4);
  EXPECT_EQ(r.all.type19.at(0).Irem_gap.value, 2);
}

TEST(Interfaces, AreTakenById) {
  const Read r("/INTER/TYPE19/3\nt\n         1\n\n\n\n\n\n" + Type7Text{}.str() +
               "/INTER/TYPE10/1\nt\n         1         2\n\n\n" +
               "/INTER/LAGMUL/TYPE7/8\nt\n         1         2\n\n\n\n\n\n");
  ASSERT_EQ(r.all.ordered.size(), 3u);
  EXPECT_EQ(r.all.ordered[0]->type, 10);
  EXPECT_EQ(r.all.ordered[1]->type, 19);
  EXPECT_EQ(r.all.ordered[2]->type, 7);
  EXPECT_EQ(r.all.ordered[2]->id, 5);
  EXPECT_EQ(r.all.ordered[2]->title, "title");
}

// ---- structs and schemas say the same ----------------------------------------------------------

template <class Inter>
std::set<std::string> struct_fields() {
  std::set<std::string> names;
  const Inter inter;
  inter.for_each([&](const char* name, const auto&) { names.insert(name); });
  return names;
}

/// Names over all versions. IBCX, IBCY, IBCZ are one field, Rthe is the old name of Kthe.
std::set<std::string> schema_fields(const std::string& keyword) {
  std::set<std::string> names;
  const Schema* schema = SchemaSet::built_in().find(keyword);
  if (schema == nullptr) return names;
  for (const CardSchema& card : schema->cards)
    for (const Field& field : card.fields) {
      std::string name = field.name;
      if (name.starts_with("IBC")) name = "IBC";
      if (name == "Rthe") name = "Kthe";
      // Multimp is read by nobody; Ists is reported as not evaluated (DK299). Iedge is ignored on
      // the card, but has a value.
      if (name == "Multimp" || name == "Ists") continue;
      names.insert(name);
    }
  return names;
}

TEST(InterfaceFields, StructsAndSchemasNameTheSameFields) {
  EXPECT_EQ(struct_fields<InterType7>(), schema_fields("/INTER/TYPE7"));
  EXPECT_EQ(struct_fields<InterType10>(), schema_fields("/INTER/TYPE10"));
  EXPECT_EQ(struct_fields<InterType11>(), schema_fields("/INTER/TYPE11"));
  EXPECT_EQ(struct_fields<InterType19>(), schema_fields("/INTER/TYPE19"));
  EXPECT_EQ(struct_fields<InterType24>(), schema_fields("/INTER/TYPE24"));
  EXPECT_EQ(struct_fields<InterType25>(), schema_fields("/INTER/TYPE25"));
}

TEST(InterfaceFields, DefaultCardsNameFieldsOfTheirType) {
  for (const auto& [keyword, fields] :
       {std::pair{"/DEFAULT/INTER/TYPE7", struct_fields<InterType7>()},
        std::pair{"/DEFAULT/INTER/TYPE11", struct_fields<InterType11>()},
        std::pair{"/DEFAULT/INTER/TYPE19", struct_fields<InterType19>()},
        std::pair{"/DEFAULT/INTER/TYPE24", struct_fields<InterType24>()},
        std::pair{"/DEFAULT/INTER/TYPE25", struct_fields<InterType25>()}})
    for (const std::string& name : schema_fields(keyword))
      EXPECT_TRUE(fields.contains(name)) << keyword << " " << name;
}

static_assert(!std::is_copy_constructible_v<Interfaces> && !std::is_copy_assignable_v<Interfaces>);

/// The lines of a TYPE25 of 2023: flags, gaps, bounds, Stfac, damping.
std::string type25(const std::string& flags = "         1         2",
                   const std::string& bounds = "", const std::string& damping = "",
                   const std::string& gaps = "") {
  return "/INTER/TYPE25/5\nt\n" + flags + "\n" + gaps + "\n" + bounds + "\n\n" + damping + "\n\n";
}

TEST(Type25Values, BuiltInOnesAndThoseOfTheDefaultBlock) {
  const Read plain(type25(), 2023);
  const InterType25& t = plain.all.type25.at(0);
  for (const EffectiveInt* off : {&t.Istf, &t.Idel, &t.Iedge, &t.Igap0, &t.Inacti, &t.Ithick}) {
    EXPECT_EQ(off->value, 1000);
    EXPECT_EQ(off->origin, Origin::built_in);
  }
  for (const EffectiveInt* one : {&t.Igap, &t.Irem_i2, &t.Ishape, &t.IVIS2})
    EXPECT_EQ(one->value, 1);
  EXPECT_EQ(t.Gap_scale.value, 1.0);
  EXPECT_EQ(t.Gap_max_s.value, 1e30);
  EXPECT_EQ(t.VISs.value, 0.05);
  EXPECT_EQ(t.Edge_angle.value, 0.0) << "no angle without edges";
  const std::string block =
      "/DEFAULT/INTER/TYPE25\n\n" + at(50, "2") + "\n\n\n\n" + at(40, "-1") + "\n\n";
  const Read given(type25() + block, 2023);
  const InterType25& d = given.all.type25.at(0);
  EXPECT_EQ(d.Igap.value, 2);
  EXPECT_EQ(d.Igap.origin, Origin::default_block);
  EXPECT_EQ(d.Inacti.value, -1);
  EXPECT_EQ(d.Istf.value, 4) << "Inacti -1 makes it 4";
  EXPECT_EQ(d.Istf.origin, Origin::derived);
}

TEST(Type25Values, WhatTheSolverMakesOfOtherValues) {
  const auto inacti = [](const std::string& value) {
    return Read(type25("         1         2", "", at(40, value)), 2023)
        .all.type25.at(0)
        .Inacti.value;
  };
  EXPECT_EQ(inacti("3"), 5);
  EXPECT_EQ(inacti("-5"), 1000);
  EXPECT_EQ(inacti("-1"), -1);
  const Read three(type25(with("         1         2", 50, "3")), 2023);
  EXPECT_EQ(three.all.type25.at(0).Igap.value, 3);
  EXPECT_EQ(three.all.type25.at(0).Ishape.value, 2);
  EXPECT_EQ(three.all.type25.at(0).mesh_size.value, 0.4);
  EXPECT_EQ(level_of(1, 2), 2);
  EXPECT_EQ(level_of(1, 1), 1);
  EXPECT_EQ(level_of(0, 2), 3);
}

TEST(InterfaceTypes, AreVisitedAsTheirOwnTypeAndNothingElseIs) {
  InterType11 edges;
  edges.type = 11;
  EXPECT_TRUE(
      visit_interface(edges, []<class T>(const T&) { return std::is_same_v<T, InterType11>; }));
  InterBase unknown;
  unknown.type = 23;
  EXPECT_THROW(visit_interface(unknown, [](const auto&) {}), std::logic_error);
  EXPECT_EQ(traits_of(23), nullptr);
}

TEST(InterfaceTypes, NameFieldsOfTheirSchemas) {
  for (const InterfaceTraits* t : interface_types) {
    const Schema* const schema = SchemaSet::built_in().find(t->keyword);
    ASSERT_NE(schema, nullptr) << t->keyword;
    for (const InterfaceTraits::Side& side : {t->secondary, t->main}) {
      const Field* const field = schema->find_field(side.field);
      ASSERT_NE(field, nullptr) << t->keyword << ' ' << side.field;
      EXPECT_EQ(field->ref, side.refers_to) << t->keyword << ' ' << side.field;
    }
    EXPECT_TRUE(t->gap.empty() || schema->find_field(t->gap) != nullptr) << t->keyword;
  }
}

TEST(InterfaceTypes, OfMovedInterfacesStayInPlace) {
  Read r(Type7Text{}.str());
  const Interfaces moved = std::move(r.all);
  ASSERT_EQ(moved.ordered.size(), 1U);
  EXPECT_EQ(moved.ordered[0], &moved.type7[0]);
}

}  // namespace
}  // namespace deck
