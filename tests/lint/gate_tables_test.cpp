// Tables of the gate in .decklint.toml, and lines of its strings.
#include <gtest/gtest.h>

#include "lint/shared/config.hpp"
#include "lint/support.hpp"

namespace deck::test {
namespace {

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
