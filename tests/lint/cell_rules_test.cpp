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
      {"1 + 2 * 3 - 4 / 2 == 5", 1},
      {"0.5 * input(F) - 1", 2.5},
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
  const auto rule = CellRule::read({{{"when", "flag(A) == 1 and given(B)"},
                                     {"at", "C"},
                                     {"message", "{name}: {show D}, {= value(E) / 2}"},
                                     {"note", "F, G"},
                                     {"fix",
                                      "{H: 1000, if: given(I) and working_units, safe: true, "
                                      "title: write {input J}, or so}"}}});
  ASSERT_TRUE(rule) << rule.error().message;
  auto fields = rule->fields();
  std::sort(fields.begin(), fields.end());
  EXPECT_EQ(fields, (std::vector<std::string>{"A", "B", "C", "D", "E", "F", "G", "H", "I", "J"}));
  EXPECT_EQ(rule->cases[0].fix->title, "write {input J}, or so");
  EXPECT_TRUE(rule->cases[0].fix->safe);
}

TEST(CellRules, HaveAFindingForEachFieldOfAList) {
  const auto rule = CellRule::read({{{"when", "input(at) > 1"},
                                     {"at", "A, B"},
                                     {"message", "{at} of {name}: {text at}"},
                                     {"fix", "{at: blank, safe: true, title: blank {at}}"}}});
  ASSERT_TRUE(rule) << rule.error().message;
  EXPECT_EQ(rule->cases[0].at, (std::vector<std::string>{"A", "B"}));
  EXPECT_EQ(rule->fields(), rule->cases[0].at);
}

TEST(CellRules, ThatBreakTheFormAreRefused) {
  const auto refused = [](const std::string& key, const std::string& value) {
    CellKeys keys = {{"when", "1"}, {"at", "C"}, {"message", "m"}};
    EXPECT_TRUE(CellRule::read({keys}));
    keys[key] = value;
    return !CellRule::read({keys});
  };
  EXPECT_TRUE(refused("message", ""));
  EXPECT_TRUE(refused("fix", "{H: 1}"));
  EXPECT_TRUE(refused("fix", "{H: 1, if: given, safe: true, title: t}"));
  EXPECT_TRUE(refused("of", "some"));
  EXPECT_TRUE(refused("per", "block"));
  EXPECT_TRUE(refused("if", "given"));
  EXPECT_TRUE(refused("message", "{= 1 +}"));
  EXPECT_TRUE(refused("message", "{shwo C}"));
  EXPECT_TRUE(refused("fix", "{C: 1, safe: true, title: write {= 1 +}}"));
}

TEST(CellRules, HaveCasesWithTheKeysOfThePage) {
  const auto rule =
      CellRule::read({{{"when", "given(A)"}, {"at", "A"}, {"message", "{name}: {because}"}},
                      {{"if", "input(A) > 1"}, {"because", "large"}},
                      {{"at", "B"}, {"of", "with frictions"}, {"because", "small"}}});
  ASSERT_TRUE(rule) << rule.error().message;
  ASSERT_EQ(rule->cases.size(), 2u);
  EXPECT_EQ(rule->cases[0].message, "{name}: large");
  EXPECT_TRUE(rule->cases[0].when);
  EXPECT_EQ(rule->cases[1].at, std::vector<std::string>{"B"});
  EXPECT_TRUE(rule->cases[1].frictions);
}

TEST(Limits, AreOneForEachKeywordAndCell) {
  const auto limits = Limit::read(RuleId::DK641, {{"keywords", "/A, /B"},
                                                  {"at", "X, Y"},
                                                  {"beside", "U, V"},
                                                  {"if", "input(at) == 0 and input(beside) > 0"},
                                                  {"message", "warning 663"}});
  ASSERT_TRUE(limits) << limits.error().message;
  ASSERT_EQ(limits->size(), 4u);
  EXPECT_EQ(limits->back().keyword + limits->back().field, "/BY");
  EXPECT_EQ(limits->back().fields(), (std::vector<std::string>{"at", "V"}));
  EXPECT_EQ(limits->back().message.severity, Severity::warning);
  EXPECT_FALSE(Limit::read(RuleId::DK641, {{"keywords", "/A"}, {"message", "663"}}));
  EXPECT_FALSE(Limit::read(RuleId::DK641,
                           {{"keywords", "/A"}, {"message", "error 663"}, {"if", "type == 7"}}));
}

}  // namespace
}  // namespace deck::detail
