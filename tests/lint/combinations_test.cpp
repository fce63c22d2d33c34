// Rules about values that do not go together: where each of them begins and ends, in interfaces and
// in /FRICTION.
#include <gtest/gtest.h>

#include "lint/shared/config.hpp"
#include "lint/support.hpp"

namespace deck::test {
namespace {

TEST(RenardCurve, NeedsASecondSpeedAboveTheFirst) {
  const std::string curve = "Ifric=3 C1=0.1 C2=0.2 C3=0.3 C4=0.05 C5=1.0 C6=";
  for (const auto& [speed, fires] : {std::pair{"1.0", true}, {"1.01", false}}) {
    EXPECT_EQ(lint_example("@/INTER/TYPE7/1 " + curve + speed).fires(RuleId::DK250), fires)
        << speed;
    EXPECT_EQ(lint_example("@/FRICTION/1 " + curve + speed).fires(RuleId::DK250), fires) << speed;
  }
}

TEST(RenardCurve, IsAskedForByIfricThreeAlone) {
  for (const char* other : {"0", "1", "2", "4"})
    EXPECT_FALSE(
        lint_example("@/FRICTION/1 Fric=0.2 Ifric=" + std::string(other)).fires(RuleId::DK250))
        << other;
}

TEST(FilterFactor, IsNoneWithoutAFrequency) {
  const auto fires = [](const std::string& more) {
    return lint_example("@/INTER/TYPE7/1 Fric=0.1 " + more).fires(RuleId::DK260);
  };
  EXPECT_FALSE(fires("Ifiltr=2"));
  EXPECT_FALSE(fires("Ifiltr=1"));
  EXPECT_TRUE(fires("Ifiltr=2 Xfreq=6.0")) << "2 pi / 6";
  EXPECT_FALSE(fires("Ifiltr=2 Xfreq=6.5"));
  EXPECT_TRUE(fires("Ifiltr=1 Xfreq=1.5"));
  EXPECT_FALSE(fires("Ifiltr=1 Xfreq=1.0"));
}

TEST(DefaultBlock, IsTakenByContactsThatAreNotEvaluatedToo) {
  const Linted lagrange = lint_example("@/DEFAULT/INTER/TYPE7 Irem_gap=2\n@/INTER/LAGDT/TYPE7/1");
  EXPECT_TRUE(lagrange.fires(RuleId::DK502)) << "it has no Irem_gap";
  const std::string tie = "@/DEFAULT/INTER/TYPE2 Idel=2\n/INTER/TYPE2/1\ntie\n         2         1";
  const Linted tied = lint_example(tie);
  ASSERT_TRUE(tied.fires(RuleId::DK501)) << "TYPE2 calls it Idel2";
  EXPECT_NE(tied.find(RuleId::DK501)->message.find("Idel = 2 applies to 1 interface"),
            std::string::npos);
  EXPECT_FALSE(lint_example(tie + std::string(40, ' ') + "         1").fires(RuleId::DK501));
  EXPECT_FALSE(lint_example("@/DEFAULT/INTER/TYPE24 Istf=4\n/INTER/TYPE24/1\nt\n         1")
                   .fires(RuleId::DK502))
      << "nobody knows the card";
}

TEST(DefaultBlock, OfAnIncludeHolds) {
  EXPECT_FALSE(lint_example("#include defaults.inc\n@/INTER/TYPE7/1\n@file defaults.inc\n"
                            "@/DEFAULT/INTER/TYPE7 Inacti=6")
                   .fires(RuleId::DK503));
}

TEST(TitleLength, ThatTheSolverKeepsIsAHundredCharacters) {
  for (const std::size_t n : {100u, 101u})
    EXPECT_EQ(lint_example("/INTER/TYPE10/1\n" + std::string(n, 't') + "\n         2         1\n")
                  .fires(RuleId::DK246),
              n == 101)
        << n;
}

TEST(FrictionOverTemperature, IsNamedOnlyWhereAFunctionIsGiven) {
  const std::string heat = "@/INTER/TYPE7/1 Fric=1.0 Ithe=1 Kthe=1.0 Ithe_form=1";
  EXPECT_TRUE(lint_example(heat + " fct_IDF=1").fires(RuleId::DK914));
  EXPECT_FALSE(lint_example(heat).fires(RuleId::DK914));
  EXPECT_FALSE(lint_example(heat + " fric_ID=1").fires(RuleId::DK914));
}

TEST(TieTrigger, ANegativeDtminIsNotCalledBlank) {
  for (const auto& [cell, said] :
       {std::pair{"", "dtmin is blank"}, {" dtmin=-1.0", "dtmin is not above 0"}}) {
    const auto r = lint_example("@/INTER/TYPE7/1 ITIED=1" + std::string(cell));
    ASSERT_TRUE(r.fires(RuleId::DK915)) << cell;
    EXPECT_NE(r.find(RuleId::DK915)->message.find(said), std::string::npos) << cell;
  }
}

TEST(IncrementalStiffness, OfAFrictionBlockIsThatOfIformTwo) {
  EXPECT_TRUE(lint_example("@/FRICTION/1 Fric=0.2 Iform=2").fires(RuleId::DK295));
  EXPECT_FALSE(lint_example("@/FRICTION/1 Fric=0.2 Iform=1").fires(RuleId::DK295));
  EXPECT_FALSE(lint_example("@/FRICTION/1 Fric=0.2").fires(RuleId::DK295));
}

std::string refusal(const std::string& toml) {
  const auto config = parse_lint_config(toml, "c.toml");
  return config ? "" : config.error().message;
}

TEST(GateConfig, PairsOfPartsAreMatchedByTwoPatterns) {
  const auto config = parse_lint_config(
      "[[gate.part-pair]]\nmatch = [\"bumper*\", \"12\"]\nmax-depth = 0\nmax-ratio = 0.5\n"
      "max-count = 3\n[[gate.interface]]\nmatch = \"door*\"\nmax-dt-loss = 0.25\n",
      "c.toml");
  ASSERT_TRUE(config) << config.error().message;
  ASSERT_EQ(config->gate.part_pairs.size(), 1u);
  const GateScope& pair = config->gate.part_pairs[0];
  EXPECT_EQ(pair.match, (std::vector<std::string>{"bumper*", "12"}));
  EXPECT_EQ(pair.limits.max_depth, 0.0);
  EXPECT_EQ(pair.limits.max_ratio, 0.5);
  EXPECT_EQ(pair.limits.max_count, 3u);
  ASSERT_EQ(config->gate.interfaces.size(), 1u);
  EXPECT_EQ(config->gate.interfaces[0].match, (std::vector<std::string>{"door*"}));
  EXPECT_EQ(config->gate.interfaces[0].limits.max_dt_loss, 0.25);
}

TEST(GateConfig, WrongTablesAreRefusedWithWhatBelongsThere) {
  const std::string pair = "[[gate.part-pair]]\n", inter = "[[gate.interface]]\n";
  EXPECT_NE(refusal(pair + "match = [\"a\"]\n").find("a list of two patterns"), std::string::npos);
  EXPECT_NE(refusal(pair + "max-depth = 1\n").find("a list of two patterns"), std::string::npos);
  EXPECT_NE(refusal(inter + "match = [\"a\", \"b\"]\n").find("a pattern of the id or title"),
            std::string::npos);
  EXPECT_NE(refusal(pair + "match = [\"a\", \"b\"]\nmax-dt-loss = 0.1\n").find("unknown key"),
            std::string::npos)
      << "a time step belongs to an interface";
  EXPECT_EQ(refusal(inter + "match = \"a\"\nmax-dt-loss = 0.1\n"), "");
  for (const char* bad :
       {"max-depth = -1", "max-ratio = \"1\"", "max-count = -1", "max-count = 1.5"})
    EXPECT_NE(refusal(inter + "match = \"a\"\n" + bad + "\n").find("0 or more"), std::string::npos)
        << bad;
}

TEST(Config, LinesInsideOfStringsCount) {
  std::string key = "a";
  for (int i = 0; i < 2000; ++i) key += ".a";
  EXPECT_EQ(refusal("x = '''\none\ntwo\n'''\n" + key + " = 1\n").find("c.toml:5"), 0u)
      << refusal("x = '''\none\ntwo\n'''\n" + key + " = 1\n");
}

}  // namespace
}  // namespace deck::test
