// What the solver makes of the card of a TYPE2, TYPE24 or TYPE25: one field of the card is changed,
// one effective value is looked at.
#include <gtest/gtest.h>

#include <functional>

#include "deck/model/interfaces.hpp"
#include "lint/shared/example.hpp"

namespace deck {
namespace {

/// Interfaces of a deck in the notation of examples.
struct Cards {
  explicit Cards(const std::string& text, const Model& model = {}) {
    auto read = read_deck_text(
        "cards_0000.rad", example_deck("@version 2026\n@bare\n" + text, SchemaSet::built_in()).main,
        SchemaSet::built_in());
    EXPECT_TRUE(read.ok());
    deck = std::move(*read);
    all = read_interfaces(deck, model, found);
  }
  Deck deck;
  Diagnostics found;
  Interfaces all;
};

Model model_with(const std::function<void(Model&)>& change) {
  Model m;
  change(m);
  return m;
}

using Int = std::pair<std::int64_t, Origin>;
using Real = std::pair<double, Origin>;
template <class T>
std::pair<T, Origin> of(const Effective<T>& e) {
  return {e.value, e.origin};
}
constexpr Origin card = Origin::card, built_in = Origin::built_in, derived = Origin::derived,
                 block = Origin::default_block;

// ---- TYPE2 -------------------------------------------------------------------------------------

InterType2 type2(const std::string& fields, const std::string& more = "", const Model& m = {}) {
  const Cards c("@/INTER/TYPE2/3 " + fields + "\n" + more, m);
  EXPECT_EQ(c.all.type2.size(), 1u);
  EXPECT_TRUE(c.all.ordered.empty());
  EXPECT_EQ(c.all.all.size(), 1u);
  return c.all.type2.at(0);
}

TEST(Type2Values, BlankOnesHaveTheSolversOwn) {
  const InterType2 t = type2("");
  EXPECT_EQ(of(t.Ignore), Int(1000, built_in));
  EXPECT_EQ(of(t.Spotflag), Int(5, built_in));
  EXPECT_EQ(of(t.Isearch), Int(2, built_in));
  EXPECT_EQ(of(t.Idel2), Int(1000, built_in));
  EXPECT_EQ(of(t.Iproj), Int(1, built_in));
  EXPECT_EQ(t.Stfac.value, 0);
  EXPECT_EQ(t.Visc.value, 0);
  EXPECT_EQ(t.Rupt.value, 0);
  EXPECT_EQ(t.Max_N_Dist.value, 0);
  const InterType2 sound = type2("", "", model_with([](Model& m) { m.has_acoustics = true; }));
  EXPECT_EQ(of(sound.Spotflag), Int(4, built_in));
}

TEST(Type2Values, ThousandIsTheSolversOwnToo) {
  const InterType2 t = type2("Spotflag=1000 Isearch=1000 Ignore=1000",
                             "@/DEFAULT/INTER/TYPE2 Spotflag=28 Isearch=1 Ignore=3");
  EXPECT_EQ(of(t.Spotflag), Int(5, derived));
  EXPECT_EQ(of(t.Isearch), Int(2, derived));
  EXPECT_EQ(of(t.Ignore), Int(1000, card));
  const InterType2 d = type2("", "@/DEFAULT/INTER/TYPE2 Spotflag=28 Isearch=1 Ignore=3");
  EXPECT_EQ(of(d.Spotflag), Int(28, block));
  EXPECT_EQ(of(d.Isearch), Int(1, block));
  EXPECT_EQ(of(d.Ignore), Int(3, block));
}

TEST(Type2Values, DeletionIsForPlainAndPenaltyTies) {
  for (const auto& [flag, idel] : {std::pair("5", 2),
                                   {"1", 2},
                                   {"25", 2},
                                   {"26", 2},
                                   {"27", 2},
                                   {"28", 2},
                                   {"2", 1000},
                                   {"4", 1000},
                                   {"20", 1000},
                                   {"22", 1000},
                                   {"24", 1000},
                                   {"29", 1000},
                                   {"30", 1000}})
    EXPECT_EQ(type2("Idel2=2 Spotflag=" + std::string(flag)).Idel2.value, idel) << flag;
}

TEST(Type2Values, PenaltyTiesHaveStiffnessAndDamping) {
  for (const char* flag : {"25", "26", "27", "28"}) {
    const InterType2 t = type2("Level=4 Spotflag=" + std::string(flag));
    EXPECT_EQ(t.Level.value, 0);
    EXPECT_EQ(t.Stfac.value, 1.0) << flag;
    EXPECT_EQ(t.Visc.value, 0.05) << flag;
    EXPECT_EQ(t.Istf.value, 2) << flag;
  }
  const InterType2 t = type2("Spotflag=28 Stfac=3 Visc=0.5 Istf=1000");
  EXPECT_EQ(of(t.Stfac), Real(3, card));
  EXPECT_EQ(of(t.Visc), Real(0.5, card));
  EXPECT_EQ(t.Istf.value, 2);
  EXPECT_EQ(type2("Spotflag=28 Istf=4").Istf.value, 4);
  EXPECT_EQ(type2("Spotflag=24").Stfac.value, 0);
  EXPECT_EQ(type2("Spotflag=29").Stfac.value, 0);
  EXPECT_EQ(type2("Spotflag=5 Level=4").Level.value, 4);
}

TEST(Type2Values, RuptureHasItsBounds) {
  for (const char* flag : {"20", "21", "22"}) {
    const InterType2 t = type2("Spotflag=" + std::string(flag));
    EXPECT_EQ(t.Rupt.value, 2) << flag;
    EXPECT_EQ(t.Max_N_Dist.value, 1e20);
    EXPECT_EQ(t.Max_T_Dist.value, 1e20);
    EXPECT_EQ(t.Alpha.value, 0);
    EXPECT_EQ(t.Fscalestress.value, 1.0);
  }
  const auto alpha = [](const char* fields) {
    return type2("Spotflag=20 Rupt=1 " + std::string(fields)).Alpha.value;
  };
  EXPECT_EQ(alpha("Ifiltr=1"), 1.0);
  EXPECT_EQ(alpha("Ifiltr=1 Alpha=0.25"), 0.25);
  EXPECT_EQ(alpha("Ifiltr=1 Alpha=1.5"), 1.0);
  EXPECT_EQ(alpha("Ifiltr=1 Alpha=-0.5"), 0.0);
  EXPECT_EQ(alpha("Ifiltr=2 Alpha=1.5"), 1.5);
  EXPECT_EQ(type2("Spotflag=20 Rupt=1 Max_N_Dist=7").Max_N_Dist.value, 7);
  EXPECT_EQ(type2("Spotflag=20 Rupt=1").Rupt.value, 1);
}

// ---- TYPE24 ------------------------------------------------------------------------------------

InterType24 type24(const std::string& fields, const std::string& more = "") {
  const Cards c("@/INTER/TYPE24/3 " + fields + "\n" + more);
  EXPECT_EQ(c.all.type24.size(), 1u);
  EXPECT_EQ(c.all.ordered.size(), 1u);
  return c.all.type24.at(0);
}

TEST(Type24Values, BlankOnesHaveTheSolversOwn) {
  const InterType24 t = type24("surf_ID1=1 surf_ID2=2");
  for (const EffectiveInt* e : {&t.Istf, &t.Idel, &t.Igap0, &t.Ipen0, &t.Inacti})
    EXPECT_EQ(of(*e), Int(1000, built_in));
  EXPECT_EQ(of(t.Irem_i2), Int(1, built_in));
  EXPECT_EQ(t.Iedge.value, 1000);
  EXPECT_EQ(type24("surf_ID1=1 surf_ID2=2 Stfac=0").Stfac.value, 1);
  EXPECT_EQ(t.Tstop.value, 1e30);
  EXPECT_EQ(t.VISs.value, 0.05);
  EXPECT_EQ(t.Gap_max_s.value, 1e30);
  EXPECT_EQ(t.Gap_max_m.value, 1e30);
  EXPECT_EQ(t.Stmax.value, 1e30);
  EXPECT_EQ(t.Edge_angle.value, 0);
  EXPECT_EQ(t.STFAC_MDT.value, 0);
  EXPECT_EQ(t.Ifiltr.value, 0);
}

TEST(Type24Values, WhatTheSolverMakesOfInactiAndIstf) {
  const auto both = [](const std::string& fields) {
    const InterType24 t = type24("surf_ID1=1 surf_ID2=2 " + fields);
    return std::pair(t.Inacti.value, t.Istf.value);
  };
  using Pair = std::pair<std::int64_t, std::int64_t>;
  EXPECT_EQ(both("Inacti=1"), Pair(5, 1000));
  EXPECT_EQ(both("Inacti=3"), Pair(5, 1000));
  EXPECT_EQ(both("Inacti=5"), Pair(5, 1000));
  EXPECT_EQ(both("Inacti=6"), Pair(5, 1000));
  EXPECT_EQ(both("Inacti=1000"), Pair(1000, 1000));
  EXPECT_EQ(both("Inacti=-1"), Pair(-1, 4));
  EXPECT_EQ(both("Inacti=-1 Istf=3"), Pair(-1, 3));
  EXPECT_EQ(both("Inacti=-2"), Pair(-2, 2));
  EXPECT_EQ(both("Inacti=-2 Istf=4"), Pair(-2, 2));
  EXPECT_EQ(both("Inacti=-3"), Pair(1000, 1000));
  EXPECT_EQ(both("Istf=9"), Pair(1000, 9));
  EXPECT_EQ(both("Istf=10"), Pair(1000, 0));
  EXPECT_EQ(both("Istf=14"), Pair(1000, 4));
  const InterType24 t = type24("surf_ID1=1 surf_ID2=2 Inacti=3 Istf=14");
  EXPECT_EQ(t.Inacti.origin, derived);
  EXPECT_EQ(t.Istf.origin, derived);
  const InterType24 d = type24("surf_ID1=1 surf_ID2=2", "@/DEFAULT/INTER/TYPE24 Inacti=3 Istf=4");
  EXPECT_EQ(of(d.Inacti), Int(5, block)) << "a value of the block stays one";
  EXPECT_EQ(of(d.Istf), Int(4, block));
}

TEST(Type24Values, EdgesNeedAFlagAndMainSegments) {
  const auto edge = [](const std::string& fields) {
    const InterType24 t = type24(fields);
    return std::pair(t.Iedge.value, t.Edge_angle.value);
  };
  using Pair = std::pair<std::int64_t, double>;
  EXPECT_EQ(edge("surf_ID1=1 surf_ID2=2 Iedge=1"), Pair(1, 135));
  EXPECT_EQ(edge("surf_ID1=1 surf_ID2=2 Iedge=2 Edge_angle=90"), Pair(2, 90));
  EXPECT_EQ(edge("surf_ID1=1 surf_ID2=2 Iedge=1000"), Pair(1000, 0));
  EXPECT_EQ(edge("surf_ID1=1 surf_ID2=2 Iedge=-1"), Pair(1000, 0));
  EXPECT_EQ(edge("surf_ID2=2 grnd_IDs=1 Iedge=1"), Pair(1000, 0)) << "nodes against a surface";
}

TEST(Type24Values, StiffnessBoundsCountForSomeIstf) {
  const auto bounds = [](const std::string& istf) {
    const InterType24 t = type24("surf_ID1=1 surf_ID2=2 Stmin=2 Stmax=7 Istf=" + istf);
    return std::pair(t.Stmin.value, t.Stmax.value);
  };
  using Pair = std::pair<double, double>;
  for (const char* istf : {"2", "3", "4", "5", "-1", "12"})
    EXPECT_EQ(bounds(istf), Pair(2, 7)) << istf;
  for (const char* istf : {"0", "1", "1000", "11"}) EXPECT_EQ(bounds(istf), Pair(0, 1e30)) << istf;
}

TEST(Type24Values, MassDependentStiffnessAndOthers) {
  const auto mdt = [](const std::string& fields) {
    const InterType24 t = type24("surf_ID1=1 surf_ID2=2 " + fields);
    return std::pair(t.IPSTIF.value, t.STFAC_MDT.value);
  };
  using Pair = std::pair<std::int64_t, double>;
  EXPECT_EQ(mdt("Istf=7"), Pair(1, 0.1));
  EXPECT_EQ(mdt("Istf=7 STFAC_MDT=0.5"), Pair(1, 0.5));
  EXPECT_EQ(mdt("IPSTIF=1"), Pair(1, 0.1));
  EXPECT_EQ(mdt("IPSTIF=1 STFAC_MDT=0.5"), Pair(1, 0.5));
  EXPECT_EQ(mdt("IPSTIF=2"), Pair(2, 0));
  const auto fit = [](const std::string& fields) {
    return type24("surf_ID1=1 surf_ID2=2 Tpressfit=3 " + fields).Tpressfit.value;
  };
  EXPECT_EQ(fit("Inacti=-1"), 3);
  EXPECT_EQ(fit("Inacti=-2"), 3);
  EXPECT_EQ(fit("Inacti=5"), 0);
  const auto filter = [](const std::string& fields) {
    return type24("surf_ID1=1 surf_ID2=2 Ifiltr=2 " + fields).Ifiltr.value;
  };
  EXPECT_EQ(filter(""), 0);
  EXPECT_EQ(filter("Xfreq=3"), 2);
  const auto idel = [](const std::string& value) {
    return type24("surf_ID1=1 surf_ID2=2 Idel=" + value).Idel.value;
  };
  for (const char* kept : {"1", "2", "-1", "-2", "1000"}) EXPECT_EQ(idel(kept), std::stoi(kept));
  for (const char* other : {"3", "-3", "5"}) EXPECT_EQ(idel(other), 1000) << other;
}

// ---- TYPE25 ------------------------------------------------------------------------------------

InterType25 type25(const std::string& fields, const Model& m = {}) {
  const Cards c("@/INTER/TYPE25/3 surf_ID1=1 surf_ID2=2 " + fields, m);
  return c.all.type25.at(0);
}

TEST(Type25Rules, OfFlagsThatMeanAnother) {
  EXPECT_EQ(type25("Igap=3 Ishape=2").Ishape.value, 2);
  EXPECT_EQ(type25("Igap=3").mesh_size.value, 0.4);
  EXPECT_EQ(type25("Igap=2").mesh_size.value, 0);
  EXPECT_EQ(type25("Igap=2").Ishape.value, 1);
  EXPECT_EQ(type25("").Stmax.value, 1e30);
  EXPECT_EQ(type25("Stmax=5").Stmax.value, 5);
  EXPECT_EQ(type25("Igap=5").THICK_S_SCALE.value, 1);
  EXPECT_EQ(type25("Igap=5").THICK_M_SCALE.value, 1);
  EXPECT_EQ(type25("").THICK_S_SCALE.value, 0);
  EXPECT_EQ(type25("IVIS2=5").VISs.value, 1);
  EXPECT_EQ(type25("IVIS2=5 VISs=0.5").VISs.value, 0.5);
  EXPECT_EQ(type25("").VISs.value, 0.05);
  const Model implicit = model_with([](Model& m) { m.implicit = true; });
  EXPECT_EQ(type25("", implicit).Inacti.value, -1);
  EXPECT_EQ(type25("", implicit).Istf.value, 4);
  EXPECT_EQ(type25("Inacti=5", implicit).Inacti.value, 5);
  EXPECT_EQ(type25("Iedge=1").Edge_angle.value, 135);
  const Model warm = model_with([](Model& m) { m.has_thermal_material = true; });
  EXPECT_EQ(type25("Ithe=1", warm).Ithe.value, 1);
  EXPECT_EQ(type25("Ithe=1", warm).AscaleK.value, 1);
  EXPECT_EQ(type25("Ithe=1").Ithe.value, 0);
  EXPECT_EQ(type25("", warm).AscaleK.value, 0);
}

}  // namespace
}  // namespace deck
