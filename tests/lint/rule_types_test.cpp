// Each contact rule is asked about each interface type: it fires exactly for the types that its
// page names. The question is the rule's own bad example with another type in the header.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "lint/support.hpp"

namespace deck::test {
namespace {

constexpr std::array all_types = {7, 10, 11, 19};

bool fires(std::string_view example, const Rule& rule) {
  if (rule.stage != RuleStage::extra) return lint_example(example).fires(rule.id);
  return lint_geometry(example).fires(rule.id);
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// The example for another type; nothing if it uses a field that the type does not have.
std::optional<std::string> asked_about(std::string_view example, int type) {
  std::string text(example);
  for (const int other : all_types) {
    replace_all(text, "/INTER/TYPE" + std::to_string(other) + "/",
                "/INTER/TYPE" + std::to_string(type) + "/");
    replace_all(text, "/DEFAULT/INTER/TYPE" + std::to_string(other) + " ",
                "/DEFAULT/INTER/TYPE" + std::to_string(type) + " ");
  }
  if (type == 10) replace_all(text, " Gapmin=", " Gap=");
  if (type != 10) replace_all(text, " Gap=", " Gapmin=");
  const std::string deck = example_deck(text, SchemaSet::built_in()).main;
  if (deck.find("# unused:") != std::string::npos || deck.find("# no schema") != std::string::npos)
    return {};
  return text;
}

/// Where the example of a rule cannot be asked: another one for that type.
struct Example {
  RuleId rule;
  int type;
  std::string_view text;
};

/// A sheet that stands upright with its lower edge over the middle of the lower plate's edge.
constexpr std::string_view upright =
    "/NODE\n        21                 5.0                -5.0               HEIGHT\n"
    "        22                 5.0                 5.0               HEIGHT\n"
    "        23                 5.0                 5.0                20.0\n"
    "        24                 5.0                -5.0                20.0\n"
    "/PART/9\nupright\n         1         1         0\n/SHELL/9\n"
    "         9        21        22        23        24\n"
    "/SURF/PART/9\nupright\n         9\n/LINE/SEG/9\nedge\n         1        21        22\n";

/// A triangle with one corner on the lower plate.
constexpr std::string_view corner =
    "/NODE\n        21                 5.0                 5.0               HEIGHT\n"
    "        22                 5.0                15.0                 5.0\n"
    "        23                 8.0                15.0                 5.0\n"
    "/PART/9\ncorner\n         1         1         0\n/SH3N/9\n"
    "         9        21        22        23\n/SURF/PART/9\ncorner\n         9\n";

constexpr Example examples[] = {
    {RuleId::DK047, 11,
     "@version 110\n/INTER/TYPE11/1\nexample\n         2         1\n"
     "                                                                             0.5\n"
     "                 1.0\n\n"},
    {RuleId::DK170, 11, "@/INTER/TYPE11/1 line_IDs=2 line_IDm=55\n"},
    {RuleId::DK170, 19, "@/INTER/TYPE19/1 surf_IDs=2 surf_IDm=55\n"},
    {RuleId::DK171, 11, "/SURF/PART/9\nmore\n         1\n@/INTER/TYPE11/1 line_IDs=2 line_IDm=9\n"},
    {RuleId::DK171, 19,
     "/GRNOD/PART/9\nmore\n         1\n@/INTER/TYPE19/1 surf_IDs=2 surf_IDm=9\n"},
    {RuleId::DK181, 19, "@/INTER/TYPE19/1 surf_IDs=0 surf_IDm=0\n"},
    {RuleId::DK240, 11,
     "/INTER/TYPE11/1\nexample\n         2         1         0         1\n\n"
     "                 1.0                 0.0                 0.5\n       000\n\n"},
    {RuleId::DK241, 11, "@/INTER/TYPE11/1\n\n                 0.1                 0.0\n"},
    {RuleId::DK243, 11,
     "/INTER/TYPE11/1\nexample\n         2         1\n\n\n"
     "                 1.0                 0.2                 0.5\n"
     "       000                             6\n"},
    {RuleId::DK267, 11, "@/INTER/TYPE11/1 Istf=1 Stfac=5.0 Stmax=5.0\n"},
    {RuleId::DK276, 11, "@/INTER/TYPE11/1 Ithe=1 Kthe=1.0 AscaleK=2.0\n"},
    {RuleId::DK276, 19, "@/INTER/TYPE19/1 Ithe=1 Kthe=1.0 AscaleK=2.0\n"},
    {RuleId::DK280, 7, "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Irem_gap=2\n"},
    {RuleId::DK280, 19, "@/INTER/TYPE19/1 surf_IDs=2 surf_IDm=1 Irem_gap=2\n"},
    {RuleId::DK297, 11, "@/INTER/TYPE11/1 IBCX=1\n"},
    {RuleId::DK302, 19, "CORNER 0.00@/INTER/TYPE19/1 surf_IDs=9 Gapmin=1\n"},
    {RuleId::DK303, 19, "CORNER 0.00@/INTER/TYPE19/1 surf_IDs=9 Gapmin=1 Inacti=1\n"},
    {RuleId::DK306, 19, "UPRIGHT.001@/INTER/TYPE19/1 surf_IDs=9 Gapmin=1 Inacti=6\n"},
    {RuleId::DK322, 11,
     "/LINE/SEG/9\nbetween\n         1         1        13\n"
     "@/INTER/TYPE11/1 line_IDm=9\n"},
    {RuleId::DK403, 11, "UPRIGHT0.13@/INTER/TYPE11/1 line_IDs=9 Gapmin=1\n"},
    {RuleId::DK403, 19, "CORNER 0.02@/INTER/TYPE19/1 surf_IDs=9 Gapmin=1\n"},
    {RuleId::DK905, 7, "@/INTER/TYPE7/1 Igap=3 Irem_gap=2\n"},
    {RuleId::DK905, 19, "@/INTER/TYPE19/1 Irem_gap=2\n"},
};

std::string own_example(RuleId rule, int type) {
  for (const Example& e : examples) {
    if (e.rule != rule || e.type != type) continue;
    const bool stands = e.text.starts_with("UPRIGHT");
    if (!stands && !e.text.starts_with("CORNER ")) return std::string(e.text);
    std::string mesh(stands ? upright : corner);
    replace_all(mesh, "HEIGHT", "  " + std::string(e.text.substr(7, 4)));
    return mesh + std::string(e.text.substr(11));
  }
  return {};
}

class RuleTypes : public testing::TestWithParam<std::string> {};

std::vector<std::string> rules_with_types() {
  std::vector<std::string> ids;
  for (const Rule& r : all_rules())
    if (!r.types.empty() && !r.bad.empty()) ids.emplace_back(id_text(r.id));
  return ids;
}

TEST_P(RuleTypes, FiresForExactlyTheTypesOfItsPage) {
  const Rule& rule = *find_rule(GetParam());
  for (const int type : all_types) {
    const bool listed = std::find(rule.types.begin(), rule.types.end(), type) != rule.types.end();
    std::string example = own_example(rule.id, type);
    if (example.empty()) example = asked_about(rule.bad, type).value_or("");
    if (example.empty()) {
      EXPECT_FALSE(listed) << id_text(rule.id) << " names TYPE" << type
                           << ", but no example asks it";
      continue;
    }
    EXPECT_EQ(fires(example, rule), listed) << id_text(rule.id) << " TYPE" << type << "\n"
                                            << example;
  }
}

INSTANTIATE_TEST_SUITE_P(Rules, RuleTypes, testing::ValuesIn(rules_with_types()),
                         [](const auto& one) { return one.param; });

TEST(RuleTypesTable, EveryRuleThatNamesAnInterfaceInItsExampleHasTypes) {
  for (const Rule& r : all_rules()) {
    const bool about_options = id_number(r.id) / 100 == 2 || id_number(r.id) / 100 == 9;
    const bool about_pairs = r.id == RuleId::DK218;  // of /FRICTION
    if (about_options && !about_pairs && r.bad.find("/INTER/TYPE") != std::string_view::npos) {
      EXPECT_FALSE(r.types.empty()) << id_text(r.id);
    }
  }
}

TEST(RuleTypesTable, ThePageNamesTheTypes) {
  const std::string page = explain_rule(rule_of(RuleId::DK289), SchemaSet::built_in());
  EXPECT_NE(page.find("About TYPE11, TYPE19"), std::string::npos) << page;
}

/// A TYPE19 has its parts look at both surfaces: what is true of one side is found on the other.
TEST(RuleTypesTable, PartsOfType19AreAskedBothWays) {
  for (const RuleId id :
       {RuleId::DK301, RuleId::DK310, RuleId::DK401, RuleId::DK307, RuleId::DK318}) {
    const Rule& rule = rule_of(id);
    const auto example = asked_about(rule.bad, 19);
    ASSERT_TRUE(example) << id_text(id);
    std::string swapped = *example;
    const bool own_main = swapped.find("surf_IDm=9") != std::string::npos;
    replace_all(
        swapped, "@/INTER/TYPE19/1",
        own_main ? "@/INTER/TYPE19/1 surf_IDs=9" : "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2");
    if (own_main) replace_all(swapped, " surf_IDm=9", " surf_IDm=2");
    EXPECT_TRUE(fires(swapped, rule)) << id_text(id) << "\n" << swapped;
  }
}

}  // namespace
}  // namespace deck::test
