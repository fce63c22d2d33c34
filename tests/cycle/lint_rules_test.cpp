// The rules about the first force evaluation: each fires on its bad example, stays silent on its
// good one and without being asked for, and names what pushes.
#include <gtest/gtest.h>

#include "lint/shared/geometry.hpp"
#include "lint/support.hpp"

namespace deck::test {
namespace {

class EveryCycleRule : public testing::TestWithParam<std::string> {
 protected:
  const Rule& rule() const { return *find_rule(GetParam()); }
};

std::vector<std::string> cycle_rules() {
  std::vector<std::string> ids;
  for (const Rule& r : all_rules())
    if (id_number(r.id) / 100 == 4) ids.emplace_back(id_text(r.id));
  return ids;
}

TEST_P(EveryCycleRule, FiresOnItsBadExampleAndNamesTheInterface) {
  const Linted run = lint_geometry(rule().bad);
  const Diagnostic* d = run.find(rule().id);
  ASSERT_NE(d, nullptr) << run.list();
  EXPECT_TRUE(d->span.valid());
  EXPECT_NE(d->message.find("/INTER/TYPE7 1"), std::string::npos) << d->message;
  EXPECT_FALSE(d->help.empty());
}

TEST_P(EveryCycleRule, StaysSilentOnItsGoodExampleWhichHasNoErrors) {
  const Linted run = lint_geometry(rule().good);
  EXPECT_FALSE(run.fires(rule().id)) << run.list();
  for (const Diagnostic& d : run.result.diagnostics)
    EXPECT_NE(d.severity, Severity::error) << id_text(d.rule) << " " << d.message;
}

TEST_P(EveryCycleRule, IsNotCheckedUnlessAskedFor) {
  EXPECT_FALSE(lint_example(rule().bad).fires(rule().id));
}

INSTANTIATE_TEST_SUITE_P(Rules, EveryCycleRule, testing::ValuesIn(cycle_rules()),
                         [](const auto& test) { return test.param; });

TEST(CycleRules, ForceNamesSumEnergyAndTheNodePushedMost) {
  const Linted run = lint_geometry("@/INTER/TYPE7/1 Gapmin=4\n");
  const Diagnostic* d = run.find(RuleId::DK401);
  ASSERT_NE(d, nullptr);
  // Four nodes over the corners: kappa = 210 / 2, gap 4, penetration 1, so 140 each.
  EXPECT_NE(d->message.find("4 pairs with a force before anything moves, 560 in all, 140 at most"),
            std::string::npos)
      << d->message;
  EXPECT_NE(d->message.find("node "), std::string::npos);
  ASSERT_FALSE(d->notes.empty());
}

TEST(CycleRules, StepNamesBothSteps) {
  const Linted run = lint_geometry("@/INTER/TYPE7/1 Gapmin=4\n");
  const Diagnostic* d = run.find(RuleId::DK402);
  ASSERT_NE(d, nullptr);
  // Contact: 105 (4/3)^2 against a quarter of 7.8e-6 100. Mesh: nine tenths of what parts shows.
  EXPECT_NE(d->message.find("time step 0.001301 from contact stiffness against nodal mass"),
            std::string::npos)
      << d->message;
  EXPECT_NE(d->message.find("the mesh allows 0.001528: 1.2 times"), std::string::npos)
      << d->message;
}

TEST(CycleRules, RoundingsAreNoForce) {
  const auto fires = [&](std::string z) {
    z.insert(0, 20 - z.size(), ' ');
    return lint_geometry("/NODE\n        21                 5.0                 5.0" + z +
                         "\n/GRNOD/NODE/3\nover\n        21\n"
                         "@/INTER/TYPE7/1 grnd_IDs=3 Gapmin=1\n")
        .fires(RuleId::DK401);
  };
  EXPECT_FALSE(fires("0.99999999"));
  EXPECT_TRUE(fires("0.999"));
}

TEST(CycleRules, FindingsDoNotDependOnThreads) {
  EXPECT_EQ(lint_geometry("@/INTER/TYPE7/1 Gapmin=4\n", {}, with_threads(1)).list(),
            lint_geometry("@/INTER/TYPE7/1 Gapmin=4\n", {}, with_threads(3)).list());
}

TEST(CycleRules, TiedContactsMayTouch) {
  const Linted run = lint_geometry("@/INTER/TYPE10/1 Gap=4\n");
  EXPECT_FALSE(run.fires(RuleId::DK401));
  EXPECT_FALSE(run.fires(RuleId::DK403));
}

TEST(CycleRules, ALaterStartIsNoForceAtTheStart) {
  EXPECT_FALSE(lint_geometry("@/INTER/TYPE7/1 Gapmin=4 Tstart=1.0\n").fires(RuleId::DK401));
}

}  // namespace
}  // namespace deck::test
