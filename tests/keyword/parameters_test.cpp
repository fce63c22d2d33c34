// /PARAMETER blocks: kinds, scopes, expressions and what can be wrong with them.
#include <gmock/gmock.h>

#include "keyword/reading.hpp"

namespace deck {
namespace {

using namespace testing_support;
using ::testing::HasSubstr;

std::string cell(const std::string& name) { return name + std::string(10 - name.size(), ' '); }
std::string real(const std::string& name, const std::string& value,
                 const std::string& scope = "GLOBAL") {
  return "/PARAMETER/" + scope + "/REAL/1\ntitle\n" + cell(name) + value + "\n";
}
std::string expression(const std::string& name, const std::string& text,
                       const std::string& kind = "REAL_EXPR") {
  return "/PARAMETER/GLOBAL/" + kind + "/1\ntitle\n" + cell(name) + text + "\n";
}

const Parameter& parameter(const Deck& d, const char* name) {
  const Parameter* p = d.find_parameter(name, 0);
  static const Parameter none;
  EXPECT_NE(p, nullptr) << name;
  return p ? *p : none;
}

TEST(Parameters, OfEveryKindAreRead) {
  const Deck d = read(deck_of(real("A", "                 1.5") +
                              "/PARAMETER/GLOBAL/INTEGER/2\nt\n" + cell("N") + "        42\n" +
                              "/PARAMETER/GLOBAL/TEXT/3\n" + cell("T") + "        10\nhello\n" +
                              expression("E", "2*&A + N") + expression("I", "7/2", "INT_EXPR")));
  EXPECT_EQ(parameter(d, "A").real, 1.5);
  EXPECT_EQ(parameter(d, "N").integer, 42);
  EXPECT_EQ(parameter(d, "N").real, 42);
  EXPECT_EQ(parameter(d, "T").text, "hello");
  EXPECT_EQ(parameter(d, "E").real, 45);
  EXPECT_EQ(parameter(d, "I").integer, 4);
  EXPECT_TRUE(d.findings.all().empty());
  const Deck free =
      read(deck_of("/PARAMETER/GLOBAL/REAL/1\nt, u\nA,1.5\n"
                   "/PARAMETER/GLOBAL/INTEGER/2\nt\n  N , 42\n"
                   "/PARAMETER/GLOBAL/REAL_EXPR/3\nt\nE, 2*&A + N\n"));
  EXPECT_EQ(parameter(free, "E").real, 45);
}

TEST(Parameters, ExpressionsFollowTheUsualRules) {
  const std::pair<const char*, double> cases[] = {
      {"1+2*3", 7},       {"(1+2)*3", 9},       {"2^3^2", 512},   {"2**3", 8},     {"-2^2", -4},
      {"2^-1", .5},       {"10/4/5", .5},       {"1-2-3", -4},    {"- - 3", 3},    {"+3", 3},
      {"sqrt(16)", 4},    {"abs(-2)", 2},       {"int(2.9)", 2},  {"exp(0)", 1},   {"log(1)", 0},
      {"log10(1000)", 3}, {"sin(0)+cos(0)", 1}, {"tan(0)", 0},    {"1.5e3", 1500}, {"1.5d-1", .15},
      {"2.*(3.-1.)", 4},  {" 4 ", 4},           {"((((1))))", 1}, {"2e0*3", 6}};
  for (const auto& [text, value] : cases) {
    const Deck d = read(deck_of(expression("E", text)));
    EXPECT_TRUE(parameter(d, "E").valid) << text;
    EXPECT_DOUBLE_EQ(parameter(d, "E").real, value) << text;
  }
}

TEST(Parameters, BadExpressionsSayWhatIsWrong) {
  const std::pair<const char*, const char*> cases[] = {
      {"1/0", "division by zero"}, {"1+", "expected a number"},  {"(1", "expected ')'"},
      {"1 2", "unexpected text"},  {"&B", "'B' is not defined"}, {"foo(1)", "unknown function"},
      {"log(0)", "not finite"},    {"sqrt(-1)", "not finite"},   {"1e308*10", "not finite"},
      {"()", "expected a number"}, {"*2", "expected a number"},  {"1;2", "unexpected text"}};
  for (const auto& [text, why] : cases) {
    const Deck d = read(deck_of(expression("E", text)));
    EXPECT_FALSE(parameter(d, "E").valid) << text;
    const Finding* f = first(d.findings, RuleId::DK019);
    ASSERT_NE(f, nullptr) << text;
    EXPECT_THAT(f->message, HasSubstr(why)) << text;
  }
}

TEST(Parameters, CyclesAreErrorsAndDoNotHang) {
  const Deck self = read(deck_of(expression("A", "A+1")));
  EXPECT_THAT(first(self.findings, RuleId::DK019)->message, HasSubstr("refers to itself"));
  const Deck ring =
      read(deck_of(expression("A", "B") + expression("B", "C") + expression("C", "A")));
  EXPECT_EQ(count(ring.findings, RuleId::DK019), 3u);
  EXPECT_FALSE(parameter(ring, "C").valid);
}

TEST(Parameters, LongChainsEndInAResultOrAnError) {
  std::string body;
  for (int i = 0; i < 2000; ++i)
    body += expression("P" + std::to_string(i), "P" + std::to_string(i + 1) + "+1");
  body += real("P2000", "                  1.");
  const Deck d = read(deck_of(body));
  EXPECT_TRUE(parameter(d, "P1999").valid);
  EXPECT_EQ(parameter(d, "P1990").real, 11);
  // Far from the end the depth limit speaks, and says so.
  EXPECT_FALSE(parameter(d, "P0").valid);
  EXPECT_THAT(first(d.findings, RuleId::DK019)->message, HasSubstr("too deep"));
}

class ParameterScopes : public Folder {};

TEST_F(ParameterScopes, LocalBeatsParentBeatsGlobal) {
  const std::string local = real("A", "                  2.", "LOCAL");
  file("a.inc", local + "#include b.inc\n");
  file("b.inc", "/GRNOD/NODE/1\n");
  file("c.inc", "/GRNOD/NODE/2\n");
  const Deck d = read_file(file("m_0000.rad", deck_of(real("A", "                  1.") +
                                                      "#include a.inc\n#include c.inc\n")));
  EXPECT_EQ(d.find_parameter("A", 0)->real, 1);
  EXPECT_EQ(d.find_parameter("A", 1)->real, 2);
  EXPECT_EQ(d.find_parameter("A", 2)->real, 2);  // included by the file that defines it
  EXPECT_EQ(d.find_parameter("A", 3)->real, 1);
  EXPECT_EQ(d.find_parameter("B", 3), nullptr);
}

TEST(Parameters, TheFirstOfTwoInOneScopeCounts) {
  const Deck d =
      read(deck_of(real("A", "                  1.") + real("A", "                  2.")));
  EXPECT_EQ(parameter(d, "A").real, 1);
  EXPECT_EQ(count(d.findings, RuleId::DK056), 1u);
}

TEST(Parameters, InHeadersGiveIdsAndUnits) {
  const Deck d = read(deck_of("/PARAMETER/GLOBAL/INTEGER/2\nt\n" + cell("N") + "        42\n" +
                              "/GRNOD/NODE/&N\nt\n/GRNOD/PART/&NONE\nt\n"));
  EXPECT_EQ(block(d, "/GRNOD/NODE/&N")->id.value, 42);
  EXPECT_EQ(block(d, "/GRNOD/PART/&NONE")->id.value, 0);
  EXPECT_EQ(count(d.findings, RuleId::DK018), 1u);
  const Deck huge = read(deck_of(real("A", "               1e300") + "/GRNOD/NODE/&A\nt\n"));
  EXPECT_GT(block(huge, "/GRNOD/NODE/&A")->id.value, 0);
}

TEST(Parameters, UnreadableDefinitionsAreNamed) {
  EXPECT_EQ(count(read(deck_of(real("A", "                 abc"))).findings, RuleId::DK019), 1u);
  EXPECT_EQ(count(read(deck_of(real("", "                  1."))).findings, RuleId::DK019), 1u);
  EXPECT_EQ(count(read(deck_of("/PARAMETER/GLOBAL/REAL/1\nt\n")).findings, RuleId::DK019), 1u);
}

}  // namespace
}  // namespace deck
