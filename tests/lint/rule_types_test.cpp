// Each contact rule is asked about each interface type: it fires exactly for the types that its
// page names. The question is the rule's own bad example with another type in the header.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>

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
    {RuleId::DK201, 10, "@/INTER/TYPE10/1 ITIED=7\n"},
    {RuleId::DK240, 11,
     "/INTER/TYPE11/1\nexample\n         2         1         0         1\n\n"
     "                 1.0                 0.0                 0.5\n       000\n\n"},
    {RuleId::DK241, 11, "@/INTER/TYPE11/1\n\n                 0.1                 0.0\n"},
    {RuleId::DK243, 11,
     "/INTER/TYPE11/1\nexample\n         2         1\n\n\n"
     "                 1.0                 0.2                 0.5\n"
     "       000                             6\n"},
    {RuleId::DK265, 10, "@/INTER/TYPE10/1 Inacti=6\n"},
    {RuleId::DK265, 11, "@/INTER/TYPE11/1 Igap=1 %mesh_size=0.4\n"},
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

/// A field of a rule that says the same of several: a card with "{fires|does not}" ("PAIR": of a
/// /FRICTION), and the interface types; without any it fires for every type that has the field.
struct FieldExample {
  RuleId rule;
  std::string_view field, card;
  std::vector<int> types = {};

  /// The card that fires, or the one that does not.
  std::string text(bool bad) const {
    const auto open = card.find('{'), bar = card.find('|'), close = card.find('}');
    std::string one(card.substr(0, open));
    one += bad ? card.substr(open + 1, bar - open - 1) : card.substr(bar + 1, close - bar - 1);
    one += card.substr(close + 1);
    if (one.starts_with('@')) return one + "\n";
    if (one.starts_with("PAIR"))
      return "@/FRICTION/1 Fric=0.1 grpart_ID1=0 part_ID1=1 part_ID2=2" + one.substr(4) +
             "\n@/INTER/TYPE7/1 fric_ID=1\n";
    return "@/INTER/TYPE" + std::to_string(types.empty() ? 7 : types.front()) + "/1 " + one + "\n";
  }
};

const std::vector<FieldExample>& field_examples() {
  using enum RuleId;
  static const std::vector<FieldExample> all = {
      {DK201, "Istf", "Istf={7|4}"},
      {DK201, "Igap", "Igap={9|3}"},
      {DK201, "Ibag", "Ibag={4|1000}"},
      {DK201, "Idel", "Idel={5|-2}"},
      {DK201, "Icurv", "Icurv={5|3}"},
      {DK201, "Iadm", "Iadm={3|1}"},
      {DK201, "Inacti", "Inacti={8|6}"},
      {DK201, "Irem_gap", "Irem_gap={4|2}"},
      {DK201, "Irem_i2", "Irem_i2={5|3}"},
      {DK201, "Iform", "Iform={6|2}"},
      {DK201, "ITIED", "ITIED={7|1}"},
      {DK201, "Ifric", "Ifric={6 C1=0.1 C6=0.1|1 C1=0.1}"},
      {DK201, "Ifiltr", "Fric=0.1 Ifiltr={5|1} Xfreq=0.5"},
      {DK201, "Ithe", "Ithe={3|1 Kthe=1.0}"},
      {DK201, "Ithe_form", "Ithe=1 Kthe=1.0 Ithe_form={3|1}"},
      {DK201, "Iedge", "@/DEFAULT/INTER/TYPE19 Iedge={7|1}\n@/INTER/TYPE19/1", {19}},
      {DK201, "Idir", "PAIR Idir={4|0} C1_pair=0.0 Fric_pair=0.2", {7}},
      {DK221, "Gapmin", "Gapmin={-0.5|0.5}", {7, 11, 19}},
      {DK221, "Gapmax", "Igap=2 Gapmax={-0.5|0.5}"},
      {DK221, "Stfac", "Stfac={-0.5|0.5}"},
      {DK221, "Fric", "Fric={-0.5|0.5}"},
      {DK221, "VISs", "VISs={-0.5|0.5}"},
      {DK221, "VISF", "Fric=0.2 VISF={-0.5|0.5}"},
      {DK221, "Bumult", "Bumult={-0.5|0.5}"},
      {DK221, "Fscalegap", "Igap=2 Fscalegap={-0.5|0.5}"},
      {DK221, "Fpenmax", "Fpenmax={-0.5|0.5}"},
      {DK221, "Stmin", "Istf=4 Stmin={-0.5|0.5}"},
      {DK221, "Stmax", "Istf=4 Stmax={-0.5|0.5}"},
      {DK221, "%mesh_size", "Igap=3 %mesh_size={-0.5|0.5}"},
      {DK221, "dtmin", "dtmin={-0.5|0.5}"},
      {DK221, "Tstart", "Tstart={-0.5|0.5}"},
      {DK221, "Tstop", "Tstop={-0.5|0.5}"},
      {DK221, "Kthe", "Ithe=1 Kthe={-0.5|0.5}"},
      {DK221, "Frad", "Ithe=1 Kthe=1.0 Frad={-0.5|0.5}"},
      {DK221, "Drad", "Ithe=1 Kthe=1.0 Drad={-0.5|0.5}"},
      {DK221, "NRadm", "Iadm=2 Padm=1.0 NRadm={-1|1}"},
      {DK221, "Padm", "Iadm=2 NRadm=3 Padm={-0.5|0.5}"},
      {DK221, "Angladm", "Iadm=2 NRadm=3 Padm=1.0 Angladm={-0.5|0.5}"},
      {DK221, "Gap", "Gap={-0.5|0.5}", {10}},
      {DK221, "Edge_scale_gap", "@version 2024\n@/INTER/TYPE19/1 Edge_scale_gap={-0.5|0.5}", {19}},
      {DK221, "Rthe", "@version 120\n@/INTER/TYPE7/1 Ithe=1 Rthe={-1.0|1.0}"},
      {DK221, "Fric_pair", "PAIR C1_pair=0.0 Fric_pair={-0.2|0.2}", {7}},
      {DK221,
       "Fric_dir2",
       "PAIR Idir=1 C1_pair=0.0 Fric_pair=0.2 C1_dir2=0.0 Fric_dir2={-0.2|0.2}",
       {7}},
      {DK221, "VISF_pair", "PAIR C1_pair=0.0 VISF_pair={-0.2|0.2}", {7}},
      {DK221,
       "VISF_dir2",
       "PAIR Idir=1 C1_pair=0.0 Fric_pair=0.2 C1_dir2=0.0 VISF_dir2={-0.2|0.2}",
       {7}},
      {DK265, "Gapmax", "Igap={1000|2} Gapmin=1.0 Gapmax=2.0"},
      {DK265, "Fscalegap", "Igap={1|2} Fscalegap=0.5"},
      {DK265, "%mesh_size", "Igap={1|3} %mesh_size=0.4"},
      {DK265, "Stmin", "Istf={1|4} Stmin=5.0"},
      {DK265, "Stmax", "Istf={1|4} Stmax=5.0"},
      {DK265, "node_ID2", "Icurv=1 node_ID1={1 node_ID2=2|1}"},
      {DK265, "VISF", "Fric=0.2 Iform={2|1} VISF=0.5"},
      {DK265, "Ifiltr", "Fric={0|0.2} Ifiltr=1 Xfreq=0.5"},
      {DK265, "Fheats", "{Ithe=1|Fric=0.2 Ithe=1} Kthe=1.0 Fheats=0.5"},
      {DK265, "Fheatm", "{Ithe=1|Fric=0.2 Ithe=1} Kthe=1.0 Fheatm=0.5"},
      {DK265, "Iedge", "{Iedge=1|Igap=1}", {19}},
      {DK265, "Multimp", "@version {110\n@/INTER/TYPE7/1 Multimp=12|110\n@/INTER/TYPE7/1}"},
      {DK265, "AscaleF", "Fric=0.2 {AscaleF=2.0|fct_IDF=1}"},
      {DK265, "AscaleK", "Ithe=1 Kthe=1.0 AscaleK={2.0|2.0 fct_IDK=1}"},
      {DK265, "Tint", "Ithe=1 Kthe=1.0 Ithe_form={1|0} Tint=300.0"},
      {DK265, "Drad", "Ithe=1 Kthe=1.0 {Drad=5.0|Frad=1.0e-12 Drad=5.0}"},
      {DK265, "Inacti", "{Inacti=6|Idel=1}", {10}},
      {DK265, "Irem_gap", "line_IDs={2|1} line_IDm=1 Irem_gap=2", {11}},
      {DK265, "Irem_gap", "Irem_gap={2|1}", {7}},
      {DK265, "Irem_gap", "{Irem_gap=2|surf_IDs=1 Irem_gap=2}", {19}},
  };
  return all;
}

bool fires(std::string_view example, const FieldExample& of) {
  const Linted run = lint_example(example);
  return std::any_of(run.result.findings.begin(), run.result.findings.end(),
                     [&](const Finding& d) { return d.rule == of.rule && d.field == of.field; });
}

TEST(RuleFields, FireForTheTypesThatHaveThem) {
  for (const FieldExample& e : field_examples()) {
    const std::string name = std::string(id_text(e.rule)) + ":" + std::string(e.field);
    const std::string bad = e.text(true);
    EXPECT_TRUE(fires(bad, e)) << name << "\n" << bad;
    EXPECT_FALSE(fires(e.text(false), e)) << name << "\n" << e.text(false);
    for (const int type : all_types) {
      const auto example = asked_about(bad, type);
      // One that says its types asks for these alone: its text is another card for the others.
      const bool listed = e.types.empty()
                              ? example.has_value()
                              : std::find(e.types.begin(), e.types.end(), type) != e.types.end();
      if (listed) {
        EXPECT_TRUE(example && fires(*example, e)) << name << " TYPE" << type;
      }
    }
  }
}

TEST(RuleFields, HaveAnExampleEach) {
  std::set<std::pair<RuleId, std::string>> asked, listed;
  for (const FieldExample& e : field_examples()) asked.emplace(e.rule, e.field);
  for (const Rule& r : all_rules())
    for (const RuleField& f : r.fields) listed.emplace(r.id, f.name);
  EXPECT_EQ(asked, listed);
}

TEST(RuleTypesTable, EveryRuleThatNamesAnInterfaceInItsExampleHasTypes) {
  for (const Rule& r : all_rules()) {
    const bool about_options = id_number(r.id) / 100 == 2 || id_number(r.id) / 100 == 9;
    if (about_options && r.bad.find("/INTER/TYPE") != std::string_view::npos) {
      EXPECT_FALSE(r.types.empty()) << id_text(r.id);
    }
  }
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
