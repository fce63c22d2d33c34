// Decks that the solver runs: no error and no warning where there is nothing to mend, and what a
// missing include explains is left out.
#include "lint/support.hpp"

namespace deck {
namespace {

using test::lint_example;
using test::lint_geometry;
using test::Linted;

TEST(MissingInclude, HidesWhatItMayExplain) {
  const std::string part =
      "/GRNOD/NODE/7\nnodes of the file\n     50001\n/SURF/PART/8\nparts of the file\n        77\n"
      "@/INTER/TYPE7/1 grnd_IDs=7 surf_IDm=8 Gapmin=1.0\n";
  const Linted whole = lint_example(part);
  EXPECT_TRUE(whole.fires(RuleId::DK150)) << whole.list();
  EXPECT_TRUE(whole.fires(RuleId::DK173)) << whole.list();
  const Linted missing = lint_example(part + "#include parts.inc\n");
  EXPECT_TRUE(missing.fires(RuleId::DK004)) << missing.list();
  for (const RuleId rule : {RuleId::DK150, RuleId::DK151, RuleId::DK172, RuleId::DK173})
    EXPECT_FALSE(missing.fires(rule)) << missing.list();
  EXPECT_EQ(missing.result.errors, 1u) << missing.list();
  bool said = false;
  for (const NotChecked& n : missing.result.not_checked)
    said = said || n.what.find("DK150") != std::string::npos;
  EXPECT_TRUE(said);
}

TEST(MissingInclude, DoesNotHideWhatIsWrongInTheFilesThatAreThere) {
  const Linted run = lint_example("@/INTER/TYPE7/1 Stfac=-1.0 Gapmin=1.0\n#include parts.inc\n");
  EXPECT_TRUE(run.fires(RuleId::DK221)) << run.list();
}

TEST(RepeatedSegments, OfSolidsThatTouchAreCuredByTheirOuterFaces) {
  const Linted run = lint_geometry(
      "/NODE\n"
      "        31                10.0                 0.0                20.0\n"
      "        32                20.0                 0.0                20.0\n"
      "        33                20.0                10.0                20.0\n"
      "        34                10.0                10.0                20.0\n"
      "        41                10.0                 0.0                30.0\n"
      "        42                20.0                 0.0                30.0\n"
      "        43                20.0                10.0                30.0\n"
      "        44                10.0                10.0                30.0\n"
      "        51                10.0                 0.0                40.0\n"
      "        52                20.0                 0.0                40.0\n"
      "        53                20.0                10.0                40.0\n"
      "        54                10.0                10.0                40.0\n"
      "/PROP/SOLID/9\nsolid\n        14\n\n\n/PART/9\ntwo bricks\n         9         1\n"
      "/BRICK/9\n"
      "       901        31        32        33        34        41        42        43        44\n"
      "       902        41        42        43        44        51        52        53        54\n"
      "/SURF/PART/ALL/9\nall faces\n         9\n"
      "@/INTER/TYPE7/1 surf_IDm=9 Gapmin=1.0\n");
  ASSERT_TRUE(run.fires(RuleId::DK326)) << run.list();
  EXPECT_NE(run.find(RuleId::DK326)->help.find("/EXT instead of /ALL"), std::string::npos)
      << run.find(RuleId::DK326)->help;
}

}  // namespace
}  // namespace deck
