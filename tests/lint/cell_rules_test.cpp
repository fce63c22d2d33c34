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
      {"input F", "expected '(' at 'F'"},
      {"input()", "expected a name at ')'"},
      {"inputs(F)", "expected a number, a function or '(' at 'inputs(F)'"},
      {"(1", "expected ')' at ''"},
      {"1 1", "expected 'and', 'or' or the end at '1'"},
      {"deck(moon)", "expected a fact of the deck, not moon at ')'"},
      {"versions == 90", "expected a number, a function or '(' at 'versions == 90'"},
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
                                    {"fix",
                                     "{H: 1000, if: given(I) and working_units, safe: true, "
                                     "title: write {input J}, or so}"}});
  ASSERT_TRUE(rule) << rule.error().message;
  auto fields = rule->fields();
  std::sort(fields.begin(), fields.end());
  EXPECT_EQ(fields, (std::vector<std::string>{"A", "B", "C", "D", "E", "F", "G", "H", "I", "J"}));
  EXPECT_EQ(rule->fix->title, "write {input J}, or so");
  EXPECT_TRUE(rule->fix->safe);
}

TEST(CellRules, HaveAFindingForEachFieldOfAList) {
  const auto rule = CellRule::read({{"when", "input(at) > 1"},
                                    {"at", "A, B"},
                                    {"message", "{at} of {name}: {text at}"},
                                    {"fix", "{at: blank, safe: true, title: blank {at}}"}});
  ASSERT_TRUE(rule) << rule.error().message;
  EXPECT_EQ(rule->at, (std::vector<std::string>{"A", "B"}));
  EXPECT_EQ(rule->fields(), rule->at);
}

TEST(CellRules, ThatBreakTheFormAreRefused) {
  const auto refused = [](const std::string& key, const std::string& value) {
    std::map<std::string, std::string, std::less<>> keys = {
        {"when", "1"}, {"at", "C"}, {"message", "m"}};
    EXPECT_TRUE(CellRule::read(keys));
    keys[key] = value;
    return !CellRule::read(keys);
  };
  EXPECT_TRUE(refused("message", ""));
  EXPECT_TRUE(refused("fix", "{H: 1}"));
  EXPECT_TRUE(refused("fix", "{H: 1, if: given, safe: true, title: t}"));
  EXPECT_TRUE(refused("interfaces", "some"));
}

}  // namespace
}  // namespace deck::detail
