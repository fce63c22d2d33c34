// Decks with which the reference solver stops: loads on groups that are not there, materials that
// nothing can be computed with, tied contacts without a side, decks cut short.
#include <gtest/gtest.h>

#include "lint/support.hpp"

namespace deck::test {
namespace {

using enum RuleId;

bool is_error(const Linted& run, RuleId rule) {
  const Finding* d = run.find(rule);
  return d != nullptr && d->severity == Severity::error;
}

TEST(MissingTarget, GroupOfALoadHasTheMessageOfItsKeyword) {
  const std::string good = "@/IMPVEL/9 funct_IDT=1 Dir=Y grnod_ID=2\n";
  expect_facts({{good + "@/IMPVEL/1 funct_IDT=1 Dir=X grnod_ID=77\n", DK120, 53},
                {good + "@/IMPACC/1 funct_IDT=1 Dir=X grnod_ID=77\n", DK120, 53},
                {good + "@/IMPDISP/1 Ifunct=1 DIR=X Gnod_id=77\n", DK120, 53},
                {good + "@/IMPVEL/1 funct_IDT=1 Dir=X grnod_ID=2\n", DK120, silent},
                {"@/BCS/1 Tx=1 grnod_ID=77\n", DK120, 678}});
}

TEST(MissingTarget, ImposedMotionOfNoNodesIsPassedOver) {
  for (const char* block : {"@/IMPVEL/1 funct_IDT=99 Dir=Q grnod_ID=77\n",
                            "@/IMPVEL/9 funct_IDT=1 Dir=Y grnod_ID=2\n"
                            "@/IMPVEL/1 funct_IDT=99 Dir=Q\n"}) {
    const Linted run = lint_example(block);
    EXPECT_TRUE(run.fires(DK138)) << run.list();
    EXPECT_FALSE(run.fires(DK120) || run.fires(DK135)) << run.list();
  }
}

/// Each of them would be held against all others if it were asked again whether one acts.
TEST(MissingTarget, ManyImposedMotionsOfNoNodesAreEachReported) {
  constexpr int many = 3000;
  std::string deck;
  for (int i = 1; i <= many; ++i)
    deck += "@/IMPVEL/" + std::to_string(i) + " funct_IDT=1 Dir=X grnod_ID=77\n";
  const Linted run = lint_example(deck);
  EXPECT_EQ(run.result.counts.at(DK138), std::uint64_t{many});
  EXPECT_FALSE(run.fires(DK120));
}

TEST(MissingTarget, FunctionSensorSkewAndNodeAreLookedFor) {
  for (const char* card :
       {"@/CLOAD/1 funct_IDT=9 Dir=X grnod_ID=2\n", "@/GRAV/1 funct_IDT=9 DIR=X\n",
        "@/IMPVEL/1 funct_IDT=1 Dir=X grnod_ID=2 sensor_ID=9\n",
        "@/BCS/1 Tx=1 skew_ID=9 grnod_ID=2\n", "@/RBODY/1 node_ID=99 grnd_ID=2\n",
        "@/RWALL/PLANE/1 node_ID=99 grnd_ID1=2\n", "@/RWALL/PLANE/1 grnd_ID1=77 XM1=1.0\n",
        "@/SKEW/MOV/9 N1=1 N2=2 N3=99\n", "@/INIVEL/TRA/1 Vx=1.0 grnod_ID=77\n",
        "@/ACCEL/1 Node=99\n", "@/MAT/LAW76/5 Rho_I=1.0 E=2.0 Nu=0.3 TAB_ID1=9\n",
        "/SENSOR/DIST/3\napart\n                 0.0\n         1        99\n"}) {
    const Linted bad = lint_example(card);
    EXPECT_TRUE(is_error(bad, DK120)) << card << bad.list();
  }
  for (const char* card :
       {"@/CLOAD/1 funct_IDT=1 Dir=X grnod_ID=2\n", "@/GRAV/1 funct_IDT=1 DIR=X\n",
        "@/IMPVEL/1 funct_IDT=1 Dir=X grnod_ID=2 sensor_ID=1\n",
        "@/SKEW/MOV/9 N1=1 N2=2 N3=4\n@/BCS/1 Tx=1 skew_ID=9 grnod_ID=2\n",
        "/SET/GENERAL/9\nplate\nPART               1\n@/BCS/1 Tx=1 grnod_ID=9\n",
        "@/RWALL/PLANE/1 grnd_ID1=2 XM1=1.0\n", "@/INIVEL/TRA/1 Vx=1.0 grnod_ID=2\n"})
    expect_facts({{card, DK120, silent}});
}

TEST(MissingTarget, AxesOfABoxAndPartsOfAFrictionDirectionAreLookedFor) {
  const auto box = [](int skew) {
    return "/BOX/RECTA/7\nb\n                    " + std::string(9, ' ') + std::to_string(skew) +
           "\n                 0.0                 0.0                 0.0\n"
           "                 1.0                 1.0                 1.0\n";
  };
  const auto direction = [](int part, int skew) {
    const auto cell = [](int id) { return std::string(9, ' ') + std::to_string(id); };
    return "/FRIC_ORIENT/7\no\n         0" + cell(part) +
           "\n                 1.0                 0.0                 0.0" + cell(skew) + "\n";
  };
  expect_facts({{box(5), DK120, 748},
                {box(0), DK120, silent},
                {"@/SKEW/MOV/5 N1=1 N2=2 N3=4\n" + box(5), DK120, silent},
                {direction(9, 0), DK120, 1642},
                {direction(1, 9), DK120, 184},
                {direction(1, 0), DK120, silent}});
}

TEST(MissingTarget, IdsOfSubmodelAreShifted) {
  const auto deck = [](const char* offset, const char* group) {
    return std::string("//SUBMODEL/7\nmoved\n") + offset + "\n/GRNOD/NODE/" + group +
           "\ncorner\n         1\n@/BCS/1 Tx=1 grnod_ID=5\n//ENDSUB\n";
  };
  expect_facts({{deck("", "5"), DK120, silent}, {deck("", "6"), DK120, 678}});
}

TEST(EmptyTarget, StopsALoadAndNotAnInitialVelocity) {
  const std::string nothing = "/GRNOD/NODE/7\nnothing\n\n";
  expect_facts({{nothing + "@/CLOAD/1 funct_IDT=1 Dir=X grnod_ID=7\n", DK121, 3026},
                {nothing + "@/INIVEL/TRA/1 Vx=1.0 grnod_ID=7\n", DK121, silent}});
}

TEST(Card, OfAWallOrALoadIsLegalOrHasItsMessage) {
  const std::string bcs = "/BCS/1\nfixed\n", to_two = "         0         2\n";
  expect_facts({{"@/RWALL/PLANE/1 grnd_ID1=2 XM=1.0 XM1=1.0\n", DK137, 167},
                {"@/RWALL/PLANE/1 grnd_ID1=2 ZM1=1.0\n", DK137, silent},
                {"@/RWALL/SPHER/1 grnd_ID1=2\n", DK137, silent},
                {"@/IMPVEL/1 Dir=y grnod_ID=2\n", DK135, 164},
                {"@/IMPVEL/1 Dir=XY grnod_ID=2\n", DK135, 164},
                {"@/IMPVEL/1 Dir=ZZ grnod_ID=2\n", DK135, silent},
                {"@/CLOAD/1 Dir=Q grnod_ID=2\n", DK135, 149},
                {"@/CLOAD/1 grnod_ID=2\n", DK135, 149},
                {bcs + "   112 111" + to_two, DK135, 1051},
                {bcs + "   11  111" + to_two, DK135, silent},
                {bcs + "   XYZ 111" + to_two, DK135, silent}});
}

TEST(Demand, OfABlockThatIsNotMetHasItsMessage) {
  const std::string node = "/NODE\n        21                 5.0                 5.0\n";
  const std::string body = node + "@/RBODY/1 node_ID=21 grnd_ID=2 ICoG=";
  const std::string eight = "\n/PART/9\np\n         9         1\n@/BRICK/9 brick_ID=9 N1=1 N2=2";
  expect_facts(
      {{"/TH/NODE/3\nn\n       DEF\n         1         0\n         1         0\n", DK653, 79},
       {"/GRSHEL/BOX/9\nb\n          \n", DK159, 798},
       {"/SURF/GRSHEL/9\nnothing\n        77\n", DK154, 692},
       {"/TH/INTER/3\nn\n       DEF\n         9\n/INTER/SUB/9\np\n", DK652, silent},
       {"/INTER/SUB/9\np\n        77\n", DK120, 578},
       {"/SHFRA/V4\n/SHFRA/V4\n", DK128, 546},
       {"/DAMP/3\nn\n", DK140, 171},
       {"/FUNCT/9\nn\n", DK140, 604},
       {"/IMPVEL/9\nn\n", DK140, silent},
       {"/ALE/BCS/3\ng\n   000  -1         0         2\n", DK135, 2},
       {"@/INTER/TYPE24/1 surf_ID2=1 grnd_IDs=77\n", DK170, 2087},
       {"@/INTER/TYPE2/2 grnd_IDs=0 surf_IDm=1\n", DK640, 1726},
       {"@/INTER/TYPE2/3 grnd_IDs=2 surf_IDm=1 Spotflag=20\n", DK640, 848},
       {"@/RBE2/1 node_ID=99 grnd_ID=2\n", DK120, 78},
       {body + "4\n", DK127, 274},
       {body + "3\n", DK127, silent},
       {"@/PROP/TSHELL/9 Isolid=16" + eight + " N3=3 N4=4 N5=5 N6=6 N7=7 N8=8\n", DK129, 548},
       {"@/PROP/TSHELL/9 Isolid=15" + eight + " N3=3 N4=4 N5=5 N6=6 N7=7 N8=8\n", DK129, silent}});
}

TEST(TiedInterface, SidesThatAreMissingOrEmptyAreErrors) {
  const std::string empty = "/SURF/PART/3\nnothing\n        77\n@/INTER/";
  expect_facts({{"@/INTER/TYPE2/1 grnd_IDs=2 surf_IDm=77\n", DK170, 2087},
                {"@/INTER/TYPE2/1 grnd_IDs=77 surf_IDm=1\n", DK170, 2087},
                {"@/INTER/TYPE2/1 grnd_IDs=2 surf_IDm=1\n", DK170, silent},
                {"@/INTER/TYPE2/1 grnd_IDs=2 surf_IDm=1\n", DK173, silent},
                {empty + "TYPE2/1 grnd_IDs=2 surf_IDm=3\n", DK173, 119},
                {empty + "TYPE5/1 grnd_IDs=2 surf_IDm=3\n", DK173, 119},
                {empty + "TYPE3/1 surf_ID1=3 surf_ID2=1\n", DK172, 118},
                {empty + "TYPE3/1 surf_ID1=2 surf_ID2=3\n", DK173, 119}});
}

TEST(EmptySide, IsCalledByTheNameOfItsSetAndWhatTheSetHasInstead) {
  const std::string set = "/SET/GENERAL/8\ncorners\nNODE               1         2\n@/INTER/";
  const Linted main = lint_example(set + "TYPE7/1 grnd_IDs=2 surf_IDm=8\n");
  ASSERT_NE(main.find(DK173), nullptr) << main.list();
  EXPECT_EQ(
      main.find(DK173)->message,
      "the main side of /INTER/TYPE7 1, /SET 8, is empty: the set has nodes, and no segments");
  // All nodes of the secondary surface meet the main one, which is that of the second contact.
  EXPECT_TRUE(is_error(lint_example(set + "TYPE19/1 surf_IDs=8 surf_IDm=1\n"), DK172));
}

TEST(MissingTitle, OfAGroupCostsItsFirstMembers) {
  const std::string use = "@/INTER/TYPE7/1 grnd_IDs=8\n";
  const Linted bad = lint_example("/GRNOD/NODE/8\n         1         2\n         3\n" + use);
  EXPECT_TRUE(bad.fires(DK048)) << bad.list();
  for (const std::string title : {"row 1 2", "12", "1.5 2.5", ""})
    expect_facts({{"/GRNOD/NODE/8\n" + title + "\n         3\n" + use, DK048, silent}});
}

std::string material(const char* keyword, const char* density, const char* modulus) {
  const auto cell = [](std::string text) { return text.insert(0, 20 - text.size(), ' '); };
  return "/MAT/" + std::string(keyword) + "/9\nsteel\n" + cell(density) + "\n" + cell(modulus) +
         cell("0.3") + "\n" + cell("0.3") + cell("0.2") + cell("1.0") + "\n";
}

TEST(Material, NeedsADensity) {
  for (const char* law : {"ELAST", "PLAS_JOHNS", "PLAS_TAB", "LAW01"}) {
    for (const char* density : {"0.0", "-1", "", "abc"})
      expect_facts({{material(law, density, "210.0"), DK123, 683}});
    expect_facts({{material(law, "1e-9", "210.0"), DK123, silent}});
  }
  expect_facts({{material("VOID", "0.0", ""), DK123, silent}});
}

TEST(Material, WithoutStiffnessStopsTheSolverWithTheMessageOfItsLaw) {
  const std::pair<const char*, int> laws[] = {
      {"ELAST", 683}, {"RIGID", 683}, {"PLAS_JOHNS", 276}, {"PLAS_TAB", 276}, {"LAW106", 276}};
  for (const auto& [law, number] : laws) {
    for (const char* modulus : {"0.0", "-210.0", ""})
      expect_facts({{material(law, "1e-9", modulus), DK124, number}});
    expect_facts({{material(law, "1e-9", "210.0"), DK124, silent}});
  }
  // Nobody saw the solver stop at this one; a fluid has none.
  expect_facts({{material("LAW66", "1e-9", "0.0"), DK124, fires_without_message},
                {material("HYDPLA", "1e-9", "0.0"), DK124, silent}});
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
  const std::string lines = thin + "@/INTER/TYPE11/1 line_IDs=2 Gapmin=1.0 line_IDm=";
  expect_facts({{lines + "9\n", DK125, 481}});
  EXPECT_TRUE(is_error(lint_example(lines + "9\n"), DK125));
  EXPECT_FALSE(is_error(lint_example(lines + "1\n"), DK125));
  const Linted segments = lint_example(thin + "@/INTER/TYPE7/1 surf_IDm=9 Gapmin=1.0\n");
  EXPECT_TRUE(segments.fires(DK125) && !is_error(segments, DK125)) << segments.list();
}

TEST(DeckWithoutNodes, EarlyEndCutsThemOff) {
  const std::string deck = example_deck("", SchemaSet::built_in()).main;
  for (const auto& [place, stops] : {std::pair("/NODE", true), std::pair("/FUNCT", false)}) {
    std::string cut = deck;
    const Linted run = lint_text(cut.insert(cut.find(place), "/END\n"));
    EXPECT_EQ(run.fires(DK126), stops) << run.list();
  }
}

TEST(RigidBody, NeedsMassFromElementsOrCard) {
  const std::string body =
      "/NODE\n"
      "        21                 5.0                 5.0                 9.0\n"
      "        22                 5.0                 6.0                 9.0\n"
      "/GRNOD/NODE/7\nloose\n        22\n@/RBODY/1 node_ID=21 grnd_ID=";
  const std::string own = body + "7 Ispher=1 ";
  expect_facts({{body + "7\n", DK127, 274},
                {body + "7 Mass=1.0\n", DK127, silent},
                {body + "2\n", DK127, silent},
                {own + "Jxx=1 Jyy=1 Jzz=1\n", DK127, silent},
                {own + "Jxy=1 Jyz=1 Jxz=1\n", DK127, 274},
                {own + "Jxx=1 Jyy=1 Jzz=1 Jxy=2\n", DK127, 274},
                // Without a main node it gets one.
                {"@/RBODY/1 grnd_ID=2\n", DK122, silent},
                {"@/RBODY/1 grnd_ID=2\n", DK127, silent},
                {"@/RBODY/1 Ispher=1\n", DK127, 274}});
}

TEST(TwoOfAKind, NeedDifferentIdsWhereTheSolverSaysSo) {
  for (const char* block :
       {"/SENSOR/TIME/1\nagain\n                 1.0\n", "/FUNCT/1\nagain\n                 0.0\n",
        "/TH/NODE/1\na\nDX\n         1\n/TH/NODE/1\nb\nDX\n         1\n",
        "/TH/GAUGE/1\na\nDEF\n/TH/GAUGE/1\nb\nDEF\n", "/GAUGE/1\na\n/GAUGE/1\nb\n",
        "/RWALL/PLANE/1\na\n/RWALL/SPHER/1\nb\n", "/SUBSET/1\na\n/ASSEMBLY/1\nb\n",
        "@/IMPVEL/1 Dir=X grnod_ID=2\n@/IMPVEL/1 Dir=Y grnod_ID=2\n",
        "@/SKEW/MOV/3 N1=1 N2=2 N3=4\n@/SKEW/MOV/3 N1=1 N2=2 N3=4\n"})
    expect_facts({{block, DK128, 79}});
  for (const char* block :
       {"@/BCS/1 Tx=1 grnod_ID=2\n@/BCS/1 Ty=1 grnod_ID=2\n",
        "@/IMPVEL/1 Dir=X grnod_ID=2\n@/IMPDISP/1 DIR=Y Gnod_id=2\n",
        "/TH/NODE/1\na\nDX\n         1\n/TH/GAUGE/1\nb\nDEF\n", "/SECT\na\n/SECT/x\nb\n"})
    expect_facts({{block, DK128, silent}});
}

}  // namespace
}  // namespace deck::test
