// Predicates of rules that are data: what they give, and what is wrong with them.
#include "lint/cell_rule.hpp"

#include <gtest/gtest.h>

namespace deck::detail {
namespace {

double value(std::string_view text) {
  const auto predicate = Predicate::parse(text);
  EXPECT_TRUE(predicate) << text << ": " << predicate.error().message;
  // input(F) is 7 with F, 0 without; type is 19.
  return predicate->evaluate([](const Predicate::Node& n) {
    return n.op == Predicate::Op::type ? 19.0 : n.name == "F" ? 7.0 : 0.0;
  });
}

TEST(Predicates, HaveValues) {
  const std::pair<const char*, double> rows[] = {
      {"1", 1},
      {"-2.5e1", -25},
      {"input(F)", 7},
      {"input(%G)", 0},
      {"input(F) == 7", 1},
      {"input(F) != 7 or type == 19", 1},
      {"input(F)>=8", 0},
      {"input(F) <= 7 and value(F) < 8 and flag(F) > 6", 1},
      {"not input(F)", 0},
      {"not (input(F) == 1 or input(F) == 2)", 1},
      {"1 or 0 and 0", 1},
      {"(1 or 0) and 0", 0},
      {"not 0 and 0", 0},
  };
  for (const auto& [text, expected] : rows) EXPECT_EQ(value(text), expected) << text;
}

TEST(Predicates, SayWhatIsWrong) {
  const std::pair<const char*, const char*> rows[] = {
      {"", "expected a number, a function or '(' at ''"},
      {"input(F) ==", "expected a number, a function or '(' at ''"},
      {"input F", "expected '(' at ' F'"},
      {"input()", "expected a name at ')'"},
      {"inputs(F)", "expected a number, a function or '(' at 'inputs(F)'"},
      {"(1", "expected ')' at ''"},
      {"1 1", "expected 'and', 'or' or the end at '1'"},
      {"deck(moon)", "expected a fact of the deck, not moon at ')'"},
  };
  for (const auto& [text, message] : rows) {
    const auto predicate = Predicate::parse(text);
    ASSERT_FALSE(predicate) << text;
    EXPECT_EQ(predicate.error().message, message);
  }
}

TEST(Predicates, ANestingWithoutEndIsRefused) {
  EXPECT_FALSE(Predicate::parse(std::string(100000, '(')));
  std::string nots;
  for (int i = 0; i < 100000; ++i) nots += "not ";
  EXPECT_FALSE(Predicate::parse(nots + "1"));
}

TEST(CellRules, NameAllTheirFields) {
  const auto rule = CellRule::read({{"when", "flag(A) == 1 and given(B)"},
                                    {"at", "C"},
                                    {"message", "{name}: {show D}, {input E}"},
                                    {"note", "F, G"},
                                    {"fix", "{H: 1000, safe: true, title: write 1000, or so}"}});
  ASSERT_TRUE(rule) << rule.error().message;
  auto fields = rule->fields();
  std::sort(fields.begin(), fields.end());
  EXPECT_EQ(fields, (std::vector<std::string>{"A", "B", "C", "D", "E", "F", "G", "H"}));
  EXPECT_EQ(rule->fix->title, "write 1000, or so");
  EXPECT_TRUE(rule->fix->safe);
  EXPECT_FALSE(CellRule::read({{"when", "1"}, {"at", "C"}}));
  EXPECT_FALSE(CellRule::read({{"when", "1"}, {"at", "C"}, {"message", "m"}, {"fix", "{H: 1}"}}));
}

}  // namespace
}  // namespace deck::detail
