// Decks with which the reference solver stops: loads on groups that are not there, materials that
// nothing can be computed with, tied contacts without a side, decks cut short.
#include <gtest/gtest.h>

#include "lint/support.hpp"

namespace deck::test {
namespace {

/// Message number that a finding of the rule names; 0: the rule is silent, or names none.
int message_of(const Linted& run, RuleId rule) {
  const Diagnostic* d = run.find(rule);
  return d != nullptr && d->reference ? d->reference->number : 0;
}

bool is_error(const Linted& run, RuleId rule) {
  const Diagnostic* d = run.find(rule);
  return d != nullptr && d->severity == Severity::error;
}

TEST(MissingTarget, GroupOfImposedMotionIsError53) {
  const std::string good = "@/IMPVEL/9 funct_IDT=1 Dir=Y grnod_ID=2\n";
  for (const char* keyword : {"IMPVEL", "IMPACC"}) {
    const std::string card = good + "@/" + std::string(keyword) + "/1 funct_IDT=1 Dir=X grnod_ID=";
    const Linted bad = lint_example(card + "77\n");
    EXPECT_EQ(message_of(bad, RuleId::DK120), 53) << bad.list();
    EXPECT_FALSE(lint_example(card + "2\n").fires(RuleId::DK120));
  }
  const Linted bad = lint_example(good + "@/IMPDISP/1 Ifunct=1 DIR=X Gnod_id=77\n");
  EXPECT_EQ(message_of(bad, RuleId::DK120), 53) << bad.list();
}

TEST(MissingTarget, ImposedMotionOfNoNodesIsPassedOver) {
  for (const char* block : {"@/IMPVEL/1 funct_IDT=99 Dir=Q grnod_ID=77\n",
                            "@/IMPVEL/9 funct_IDT=1 Dir=Y grnod_ID=2\n"
                            "@/IMPVEL/1 funct_IDT=99 Dir=Q\n"}) {
    const Linted run = lint_example(block);
    EXPECT_TRUE(run.fires(RuleId::DK138)) << run.list();
    EXPECT_FALSE(run.fires(RuleId::DK120)) << run.list();
    EXPECT_FALSE(run.fires(RuleId::DK135)) << run.list();
  }
}

/// Each of them would be held against all others if it were asked again whether one acts.
TEST(MissingTarget, ManyImposedMotionsOfNoNodesAreEachReported) {
  constexpr int many = 3000;
  std::string deck;
  for (int i = 1; i <= many; ++i)
    deck += "@/IMPVEL/" + std::to_string(i) + " funct_IDT=1 Dir=X grnod_ID=77\n";
  const Linted run = lint_example(deck);
  EXPECT_EQ(run.result.counts.at(RuleId::DK138), std::uint64_t{many});
  EXPECT_FALSE(run.fires(RuleId::DK120));
}

TEST(Wall, NeedsTwoPointsApart) {
  EXPECT_EQ(message_of(lint_example("@/RWALL/PLANE/1 grnd_ID1=2 XM=1.0 XM1=1.0\n"), RuleId::DK137),
            167);
  for (const char* card : {"@/RWALL/PLANE/1 grnd_ID1=2 ZM1=1.0\n", "@/RWALL/SPHER/1 grnd_ID1=2\n"})
    EXPECT_FALSE(lint_example(card).fires(RuleId::DK137)) << card;
}

TEST(Code, OfADirectionOrAFixedFreedomIsOneOfTheLegalOnes) {
  const auto message = [](const std::string& card) {
    return message_of(lint_example(card), RuleId::DK135);
  };
  for (const char* dir : {"y", "Q", "XY"}) {
    const std::string cell = " Dir=" + std::string(dir) + " grnod_ID=2\n";
    EXPECT_EQ(message("@/IMPVEL/1" + cell), 164) << dir;
    EXPECT_EQ(message("@/CLOAD/1" + cell), 149) << dir;
  }
  EXPECT_EQ(message("@/CLOAD/1 grnod_ID=2\n"), 149) << "a blank direction";
  EXPECT_EQ(message("/BCS/1\nfixed\n   112 111         0         2\n"), 1051);
  EXPECT_EQ(message("/BCS/1\nfixed\n   11  111         0         2\n"), 0);
  EXPECT_EQ(message("/BCS/1\nfixed\n   XYZ 111         0         2\n"), 0);
  EXPECT_EQ(message("@/IMPVEL/1 Dir=ZZ grnod_ID=2\n"), 0);
}

TEST(MissingTarget, GroupOfBoundaryConditionIsError678) {
  const Linted bad = lint_example("@/BCS/1 Tx=1 grnod_ID=77\n");
  EXPECT_EQ(message_of(bad, RuleId::DK120), 678) << bad.list();
  EXPECT_NE(bad.find(RuleId::DK120)->message.find("77"), std::string::npos);
}

TEST(MissingTarget, SetStandsForGroup) {
  EXPECT_FALSE(lint_example("/SET/GENERAL/9\nplate\nPART               1\n"
                            "@/BCS/1 Tx=1 grnod_ID=9\n")
                   .fires(RuleId::DK120));
}

TEST(MissingTarget, FunctionSensorSkewAndNodeAreLookedFor) {
  for (const char* card :
       {"@/CLOAD/1 funct_IDT=9 Dir=X grnod_ID=2\n", "@/GRAV/1 funct_IDT=9 DIR=X\n",
        "@/IMPVEL/1 funct_IDT=1 Dir=X grnod_ID=2 sensor_ID=9\n",
        "@/BCS/1 Tx=1 skew_ID=9 grnod_ID=2\n", "@/RBODY/1 node_ID=99 grnd_ID=2\n",
        "@/RWALL/PLANE/1 node_ID=99 grnd_ID1=2\n", "@/RWALL/PLANE/1 grnd_ID1=77 XM1=1.0\n",
        "@/SKEW/MOV/9 N1=1 N2=2 N3=99\n", "@/INIVEL/TRA/1 Vx=1.0 grnod_ID=77\n",
        "@/ACCEL/1 Node=99\n",
        "/SENSOR/DISP/3\napart\n                 0.0\n         1        99\n"}) {
    const Linted bad = lint_example(card);
    EXPECT_TRUE(is_error(bad, RuleId::DK120)) << card << bad.list();
  }
  for (const char* card :
       {"@/CLOAD/1 funct_IDT=1 Dir=X grnod_ID=2\n", "@/GRAV/1 funct_IDT=1 DIR=X\n",
        "@/IMPVEL/1 funct_IDT=1 Dir=X grnod_ID=2 sensor_ID=1\n",
        "@/SKEW/MOV/9 N1=1 N2=2 N3=4\n@/BCS/1 Tx=1 skew_ID=9 grnod_ID=2\n",
        "@/RWALL/PLANE/1 grnd_ID1=2 XM1=1.0\n", "@/INIVEL/TRA/1 Vx=1.0 grnod_ID=2\n"}) {
    const Linted good = lint_example(card);
    EXPECT_FALSE(good.fires(RuleId::DK120)) << card << good.list();
  }
}

TEST(MissingTarget, AxesOfABoxAndPartsOfAFrictionDirectionAreLookedFor) {
  const auto box = [](int skew) {
    return "/BOX/RECTA/7\nb\n                    " + std::string(9, ' ') + std::to_string(skew) +
           "\n                 0.0                 0.0                 0.0\n"
           "                 1.0                 1.0                 1.0\n";
  };
  const Linted unknown = lint_example(box(5));
  EXPECT_EQ(message_of(unknown, RuleId::DK120), 748) << unknown.list();
  EXPECT_FALSE(lint_example(box(0)).fires(RuleId::DK120));
  EXPECT_FALSE(lint_example("@/SKEW/MOV/5 N1=1 N2=2 N3=4\n" + box(5)).fires(RuleId::DK120));
  const auto direction = [](int part, int skew) {
    const auto cell = [](int id) { return std::string(9, ' ') + std::to_string(id); };
    return "/FRIC_ORIENT/7\no\n         0" + cell(part) +
           "\n                 1.0                 0.0                 0.0" + cell(skew) + "\n";
  };
  const Linted part = lint_example(direction(9, 0)), skew = lint_example(direction(1, 9));
  EXPECT_EQ(message_of(part, RuleId::DK120), 1642) << part.list();
  EXPECT_EQ(message_of(skew, RuleId::DK120), 184) << skew.list();
  EXPECT_FALSE(lint_example(direction(1, 0)).fires(RuleId::DK120));
}

TEST(MissingTarget, TableStandsForFunctionOfMaterial) {
  const std::string card = "@/MAT/LAW76/5 Rho_I=1.0 E=2.0 Nu=0.3 TAB_ID1=9\n";
  const Linted bad = lint_example(card);
  EXPECT_TRUE(is_error(bad, RuleId::DK120)) << bad.list();
  const Linted good = lint_example(card + "/TABLE/1/9\ntable\n         1\n         1\n");
  EXPECT_FALSE(good.fires(RuleId::DK120)) << good.list();
}

TEST(MissingTarget, IdsOfSubmodelAreShifted) {
  const auto deck = [](const char* offset, const char* group) {
    return std::string("//SUBMODEL/7\nmoved\n") + offset + "\n/GRNOD/NODE/" + group +
           "\ncorner\n         1\n@/BCS/1 Tx=1 grnod_ID=5\n//ENDSUB\n";
  };
  EXPECT_FALSE(lint_example(deck("", "5")).fires(RuleId::DK120));
  EXPECT_TRUE(lint_example(deck("", "6")).fires(RuleId::DK120));
  // Group 5 outside is not group 5 of the submodel with offset 100.
  const Linted outside = lint_example(
      "/GRNOD/NODE/5\ncorner\n         1\n//SUBMODEL/7\nmoved\n       100\n"
      "@/BCS/1 Tx=1 grnod_ID=5\n//ENDSUB\n");
  ASSERT_TRUE(outside.fires(RuleId::DK120)) << outside.list();
  EXPECT_NE(outside.find(RuleId::DK120)->message.find("outside the submodel"), std::string::npos);
}

TEST(EmptyTarget, ForceOnEmptyGroupIsError3026) {
  const Linted bad = lint_example(
      "/GRNOD/NODE/7\nnothing\n\n"
      "@/CLOAD/1 funct_IDT=1 Dir=X grnod_ID=7\n");
  EXPECT_EQ(message_of(bad, RuleId::DK121), 3026) << bad.list();
  // An initial velocity of nothing only warns (690).
  const Linted good = lint_example("/GRNOD/NODE/7\nnothing\n\n@/INIVEL/TRA/1 Vx=1.0 grnod_ID=7\n");
  EXPECT_FALSE(good.fires(RuleId::DK121)) << good.list();
}

TEST(RequiredTarget, SensorOfDisplacementNeedsBothNodes) {
  const Linted none = lint_example("/SENSOR/DISP/3\napart\n                0.01\n");
  EXPECT_EQ(message_of(none, RuleId::DK122), 43) << none.list();
  const Linted one = lint_example("/SENSOR/DISP/3\napart\n                0.01\n         1\n");
  EXPECT_TRUE(one.fires(RuleId::DK122)) << one.list();
}

TEST(TiedInterface, SidesThatAreMissingOrEmptyAreErrors) {
  const Linted missing = lint_example("@/INTER/TYPE2/1 grnd_IDs=2 surf_IDm=77\n");
  EXPECT_EQ(message_of(missing, RuleId::DK170), 2087) << missing.list();
  const Linted nodes = lint_example("@/INTER/TYPE2/1 grnd_IDs=77 surf_IDm=1\n");
  EXPECT_EQ(message_of(nodes, RuleId::DK170), 2087) << nodes.list();
  for (const char* type : {"TYPE2", "TYPE5"}) {
    const Linted empty = lint_example("/SURF/PART/3\nnothing\n        77\n@/INTER/" +
                                      std::string(type) + "/1 grnd_IDs=2 surf_IDm=3\n");
    EXPECT_EQ(message_of(empty, RuleId::DK173), 119) << empty.list();
    const Linted good = lint_example("@/INTER/" + std::string(type) + "/1 grnd_IDs=2 surf_IDm=1\n");
    EXPECT_FALSE(good.fires(RuleId::DK173) || good.fires(RuleId::DK170)) << good.list();
  }
}

TEST(SymmetricInterface, EmptySurfacesAreErrors118And119) {
  const std::string empty = "/SURF/PART/3\nnothing\n        77\n@/INTER/TYPE3/1 ";
  const Linted first = lint_example(empty + "surf_ID1=3 surf_ID2=1\n");
  EXPECT_EQ(message_of(first, RuleId::DK172), 118) << first.list();
  const Linted second = lint_example(empty + "surf_ID1=2 surf_ID2=3\n");
  EXPECT_EQ(message_of(second, RuleId::DK173), 119) << second.list();
}

TEST(EmptySide, IsCalledByTheNameOfItsSetAndWhatTheSetHasInstead) {
  const std::string set = "/SET/GENERAL/8\ncorners\nNODE               1         2\n@/INTER/";
  const Linted main = lint_example(set + "TYPE7/1 grnd_IDs=2 surf_IDm=8\n");
  ASSERT_NE(main.find(RuleId::DK173), nullptr) << main.list();
  EXPECT_EQ(
      main.find(RuleId::DK173)->message,
      "the main side of /INTER/TYPE7 1, /SET 8, is empty: the set has nodes, and no segments");
  // All nodes of the secondary surface meet the main one, but it is the main one of the second
  // contact.
  const Linted second = lint_example(set + "TYPE19/1 surf_IDs=8 surf_IDm=1\n");
  ASSERT_NE(second.find(RuleId::DK172), nullptr) << second.list();
  EXPECT_TRUE(is_error(second, RuleId::DK172));
  EXPECT_TRUE(second.find(RuleId::DK172)->message.ends_with("and no segments"));
}

TEST(MissingTitle, OfAGroupCostsItsFirstMembers) {
  const std::string use = "@/INTER/TYPE7/1 grnd_IDs=8\n";
  const Linted bad = lint_example("/GRNOD/NODE/8\n         1         2\n         3\n" + use);
  EXPECT_TRUE(bad.fires(RuleId::DK048)) << bad.list();
  for (const char* title : {"row 1 2", "12", "1.5 2.5", ""}) {
    const Linted good =
        lint_example("/GRNOD/NODE/8\n" + std::string(title) + "\n         3\n" + use);
    EXPECT_FALSE(good.fires(RuleId::DK048)) << title << good.list();
  }
}

TEST(UnknownKeyword, WithZerosBeforeItsNumberMeansTheNumber) {
  const Linted run = lint_example("/INTER/TYPE07/9\nexample\n         2         1\n");
  ASSERT_NE(run.find(RuleId::DK040), nullptr) << run.list();
  EXPECT_TRUE(run.find(RuleId::DK040)->message.ends_with("did you mean /INTER/TYPE7?"))
      << run.list();
}

std::string material(const char* keyword, const char* density, const char* modulus) {
  const auto cell = [](std::string text) { return text.insert(0, 20 - text.size(), ' '); };
  return "/MAT/" + std::string(keyword) + "/9\nsteel\n" + cell(density) + "\n" + cell(modulus) +
         cell("0.3") + "\n" + cell("0.3") + cell("0.2") + cell("1.0") + "\n";
}

TEST(MaterialWithoutDensity, ZeroNegativeBlankAndTextAreErrors683) {
  for (const char* law : {"ELAST", "PLAS_JOHNS", "PLAS_TAB", "LAW01"}) {
    for (const char* density : {"0.0", "-1", "", "abc"}) {
      const Linted bad = lint_example(material(law, density, "210.0"));
      EXPECT_EQ(message_of(bad, RuleId::DK123), 683) << law << " " << density << bad.list();
    }
    EXPECT_FALSE(lint_example(material(law, "1e-9", "210.0")).fires(RuleId::DK123));
  }
  EXPECT_FALSE(lint_example(material("VOID", "0.0", "")).fires(RuleId::DK123));
}

TEST(MaterialWithoutStiffness, StopsTheSolverWithTheMessageOfItsLaw) {
  const std::pair<const char*, int> laws[] = {
      {"ELAST", 683}, {"RIGID", 683}, {"PLAS_JOHNS", 276}, {"PLAS_TAB", 276}, {"LAW106", 276}};
  for (const auto& [law, number] : laws) {
    for (const char* modulus : {"0.0", "-210.0", ""}) {
      const Linted bad = lint_example(material(law, "1e-9", modulus));
      EXPECT_EQ(message_of(bad, RuleId::DK124), number) << law << " " << modulus << bad.list();
      EXPECT_TRUE(is_error(bad, RuleId::DK124)) << law;
    }
    EXPECT_FALSE(lint_example(material(law, "1e-9", "210.0")).fires(RuleId::DK124));
  }
}

TEST(MaterialWithoutStiffness, IsAWarningWhereNobodySawTheSolverStopAndNothingForAFluid) {
  const Linted other = lint_example(material("LAW66", "1e-9", "0.0"));
  ASSERT_TRUE(other.fires(RuleId::DK124)) << other.list();
  EXPECT_FALSE(is_error(other, RuleId::DK124));
  EXPECT_EQ(message_of(other, RuleId::DK124), 0);
  EXPECT_FALSE(lint_example(material("HYDPLA", "1e-9", "0.0")).fires(RuleId::DK124));
}

TEST(NegativeThickness, IsAnErrorWhereContactLooksForTheShell) {
  const std::string thin =
      "/PROP/SHELL/9\nthin\n        24\n                 0.0\n"
      "         5                          -1.0\n"
      "/PART/9\nthin\n         9         1\n"
      "/NODE\n"
      "        21                 0.0                 0.0                 6.0\n"
      "        22                10.0                 0.0                 6.0\n"
      "        23                10.0                10.0                 6.0\n"
      "        24                 0.0                10.0                 6.0\n"
      "/SHELL/9\n        21        21        22        23        24\n"
      "/SURF/PART/9\nthin\n         9\n/LINE/SURF/9\nthin\n         9\n";
  const Linted lines = lint_example(thin + "@/INTER/TYPE11/1 line_IDs=2 line_IDm=9 Gapmin=1.0\n");
  EXPECT_EQ(message_of(lines, RuleId::DK125), 481) << lines.list();
  EXPECT_TRUE(is_error(lines, RuleId::DK125));
  const Linted segments = lint_example(thin + "@/INTER/TYPE7/1 surf_IDm=9 Gapmin=1.0\n");
  ASSERT_TRUE(segments.fires(RuleId::DK125)) << segments.list();
  EXPECT_FALSE(is_error(segments, RuleId::DK125));
  const Linted other = lint_example(thin + "@/INTER/TYPE11/1 line_IDs=2 line_IDm=1 Gapmin=1.0\n");
  EXPECT_FALSE(is_error(other, RuleId::DK125)) << other.list();
}

TEST(DeckWithoutNodes, EarlyEndCutsThemOff) {
  const std::string deck = example_deck("", SchemaSet::built_in()).main;
  std::string cut = deck;
  cut.insert(cut.find("/NODE"), "/END\n");
  EXPECT_EQ(message_of(lint_text(cut), RuleId::DK126), 3) << lint_text(cut).list();
  std::string later = deck;
  later.insert(later.find("/FUNCT"), "/END\n");
  EXPECT_FALSE(lint_text(later).fires(RuleId::DK126));
}

TEST(RigidBody, NeedsMassFromElementsOrCard) {
  const std::string node =
      "/NODE\n"
      "        21                 5.0                 5.0                 9.0\n"
      "        22                 5.0                 6.0                 9.0\n"
      "/GRNOD/NODE/7\nloose\n        22\n";
  const Linted loose = lint_example(node + "@/RBODY/1 node_ID=21 grnd_ID=7\n");
  EXPECT_EQ(message_of(loose, RuleId::DK127), 274) << loose.list();
  EXPECT_FALSE(
      lint_example(node + "@/RBODY/1 node_ID=21 grnd_ID=7 Mass=1.0\n").fires(RuleId::DK127));
  EXPECT_FALSE(lint_example(node + "@/RBODY/1 node_ID=21 grnd_ID=2\n").fires(RuleId::DK127));
}

TEST(RigidBody, WithoutAMainNodeGetsOneAndStillNeedsMass) {
  const Linted good = lint_example("@/RBODY/1 grnd_ID=2\n");
  EXPECT_FALSE(good.fires(RuleId::DK122) || good.fires(RuleId::DK127)) << good.list();
  EXPECT_EQ(message_of(lint_example("@/RBODY/1 Ispher=1\n"), RuleId::DK127), 274);
}

TEST(RigidBody, WithAnInertiaOfItsOwnNeedsNoMass) {
  const std::string body =
      "/NODE\n"
      "        21                 5.0                 5.0                 9.0\n"
      "        22                 5.0                 6.0                 9.0\n"
      "/GRNOD/NODE/7\nloose\n        22\n@/RBODY/1 node_ID=21 grnd_ID=7 Ispher=1 ";
  EXPECT_FALSE(lint_example(body + "Jxx=1 Jyy=1 Jzz=1\n").fires(RuleId::DK127));
  EXPECT_TRUE(lint_example(body + "Jxy=1 Jyz=1 Jxz=1\n").fires(RuleId::DK127));
  EXPECT_TRUE(lint_example(body + "Jxx=1 Jyy=1 Jzz=1 Jxy=2\n").fires(RuleId::DK127));
}

TEST(TwoOfAKind, NeedDifferentIdsWhereTheSolverSaysSo) {
  for (const char* block :
       {"/SENSOR/TIME/1\nagain\n                 1.0\n", "/FUNCT/1\nagain\n                 0.0\n",
        "/TH/NODE/1\na\nDX\n         1\n/TH/NODE/1\nb\nDX\n         1\n",
        "/TH/GAUGE/1\na\nDEF\n/TH/GAUGE/1\nb\nDEF\n", "/GAUGE/1\na\n/GAUGE/1\nb\n",
        "/RWALL/PLANE/1\na\n/RWALL/SPHER/1\nb\n", "/SUBSET/1\na\n/ASSEMBLY/1\nb\n",
        "@/IMPVEL/1 Dir=X grnod_ID=2\n@/IMPVEL/1 Dir=Y grnod_ID=2\n",
        "@/SKEW/MOV/3 N1=1 N2=2 N3=4\n@/SKEW/MOV/3 N1=1 N2=2 N3=4\n"}) {
    const Linted bad = lint_example(block);
    EXPECT_EQ(message_of(bad, RuleId::DK128), 79) << block << bad.list();
  }
  for (const char* block :
       {"@/BCS/1 Tx=1 grnod_ID=2\n@/BCS/1 Ty=1 grnod_ID=2\n",
        "@/IMPVEL/1 Dir=X grnod_ID=2\n@/IMPDISP/1 DIR=Y Gnod_id=2\n",
        "/TH/NODE/1\na\nDX\n         1\n/TH/GAUGE/1\nb\nDEF\n", "/SECT\na\n/SECT/x\nb\n"}) {
    const Linted good = lint_example(block);
    EXPECT_FALSE(good.fires(RuleId::DK128)) << block << good.list();
  }
}

}  // namespace
}  // namespace deck::test
