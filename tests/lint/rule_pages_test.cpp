// The pages of the rules hold: every one can be read, somebody reports it, and what is reported has
// a severity and a message of the solver that its page names.
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "lint/check.hpp"
#include "lint/support.hpp"
#include "text/shared/rule_page.hpp"
#include "where.hpp"

namespace deck::test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string page() { return text_of(test::source_dir() / "schemas/rules/DK301.md"); }

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("the page has no " + std::string(from));
  return text.replace(at, from.size(), to);
}

TEST(RulePage, EveryFileIsARule) {
  std::set<std::string> files, rules;
  for (const auto& entry : fs::directory_iterator(test::source_dir() / "schemas/rules")) {
    const auto rule =
        detail::parse_rule_page(entry.path().filename().string(), text_of(entry.path()));
    EXPECT_TRUE(rule) << rule.error().message;
    files.insert(entry.path().stem().string());
  }
  for (const Rule& r : all_rules()) rules.emplace(id_text(r.id));
  EXPECT_EQ(files, rules);
}

TEST(RulePage, ThatBreaksTheFormIsRefusedWithItsLine) {
  const std::tuple<std::string, std::string, int> breaks[] = {
      {"---\nid", "id", 1},
      {"id: DK301", "id: DK302", 2},
      {"name: initial-penetration", "name: penetration", 3},
      {"name: initial-penetration", "name: Initial-penetration", 3},
      {"name: initial-penetration", "name: initial--penetration", 3},
      {"name: initial-penetration", "name: -initial-penetration", 3},
      {"name: initial-penetration", "name: initial-penetration-", 3},
      {"name: initial-penetration", "name: ", 3},
      {"severity: warning", "severity: loud", 5},
      {"found_by: geometry", "found_by: someone", 6},
      {"message: warning", "messages: warning", 7},
      {"types: 7", "types: seven", 9},
      {"types: 7, ", "known_from: hearsay\ntypes: 7, ", 9},
      {"types: 7, ", "known_from: run of a tube; hearsay\ntypes: 7, ", 9},
      {"**Why it matters.**", "**Why.**", 12},
  };
  ASSERT_TRUE(detail::parse_rule_page("DK301.md", page()));
  for (const auto& [from, to, line] : breaks) {
    const auto rule = detail::parse_rule_page("DK301.md", replaced(page(), from, to));
    ASSERT_FALSE(rule) << to;
    EXPECT_EQ(rule.error().message.find("DK301.md:" + std::to_string(line) + ":"), 0u)
        << to << ": " << rule.error().message;
  }
}

TEST(RulePage, WithoutASectionAnExampleOrAnEndIsRefused) {
  const auto refused = [](const std::string& text) {
    return !detail::parse_rule_page("DK301.md", text);
  };
  EXPECT_TRUE(refused(""));
  EXPECT_TRUE(refused(page().substr(0, page().find("- **How to fix"))));
  EXPECT_TRUE(refused(replaced(page(), "title: \"initial penetrations\"\n", "")));
  EXPECT_TRUE(refused(replaced(page(), "name: initial-penetration\n", "")));
  EXPECT_TRUE(refused(page() + "- **More.** Text.\n"));
  const auto good = page().find("- **Stays silent on"), ignore = page().find("- **When to ignore");
  EXPECT_TRUE(refused(page().substr(0, good) + page().substr(ignore))) << "one example only";
  EXPECT_TRUE(refused(replaced(page(), "**Fires on.** ", "**Fires on.**\n```\n")))
      << "a fence that stays open";
}

TEST(RulePage, SaysWhatIsParticularAboutAField) {
  const auto with = [](const std::string& keys, const std::string& row) {
    return detail::parse_rule_page(
        "DK301.md",
        replaced(replaced(page(), "types: 7", keys + "\ntypes: 7"), "\n- **How to fix",
                 "\n| Field | Why | Solver |\n|---|---|---|\n" + row + "\n- **How to fix"));
  };
  const auto rule = with("fields: A\nwas: DK302 B, C (info)", "| A, C | It is so. | It stops. |");
  ASSERT_TRUE(rule) << rule.error().message;
  ASSERT_EQ(rule->fields.size(), 3u);
  EXPECT_EQ(rule->field("A")->was, RuleId::DK301);
  EXPECT_EQ(rule->field("B")->was, RuleId::DK302);
  EXPECT_EQ(rule->field("B")->solver, "");
  EXPECT_EQ(rule->field("C")->solver, "It stops.");
  EXPECT_EQ(rule->field("C")->note, "It is so.");
  EXPECT_EQ(rule->field("C")->severity, Severity::info);
  EXPECT_EQ(rule->field("D"), nullptr);
  EXPECT_EQ(rule->solver.find('|'), std::string::npos);
  EXPECT_FALSE(with("fields: A", "| D | It is so. | It stops. |")) << "not a field";
  EXPECT_FALSE(with("fields: A", "| A | It is so. |")) << "a cell is missing";
  EXPECT_FALSE(with("fields: A, A", "| A | It is so. | It stops. |")) << "twice";
  EXPECT_FALSE(with("was: DK301 A", "| A | It is so. | It stops. |")) << "its own id";
  EXPECT_FALSE(with("fields: A (great)", "| A | It is so. | It stops. |"));
}

TEST(RulePage, MayLeaveOutWhenToIgnore) {
  const auto rule =
      detail::parse_rule_page("DK301.md", page().substr(0, page().find("- **When to ignore")));
  ASSERT_TRUE(rule) << rule.error().message;
  EXPECT_EQ(rule->ignore, "");
}

TEST(RulePage, NamesTheSourcesOfWhatItSaysAboutTheSolver) {
  const auto rule = detail::parse_rule_page(
      "DK301.md",
      replaced(page(), "types: 7", "known_from: run of a tube; manual /INTER/TYPE7\ntypes: 7"));
  ASSERT_TRUE(rule) << rule.error().message;
  EXPECT_EQ(rule->source, "run of a tube; manual /INTER/TYPE7");
}

TEST(RulePage, IsNamedByItsNumber) {
  for (const char* id : {"DK000", "DK001"})
    EXPECT_FALSE(detail::parse_rule_page("DKabc.md",
                                         replaced(page(), "id: DK301", "id: " + std::string(id))))
        << id;
}

TEST(RulePage, HasANameThatNoOtherHas) {
  std::set<std::string> names;
  for (const Rule& r : all_rules()) {
    EXPECT_TRUE(names.insert(r.name).second) << r.name;
    EXPECT_EQ(find_rule(r.name), &r);
    EXPECT_EQ(find_rule(id_text(r.id)), &r);
  }
  EXPECT_EQ(find_rule("no-such-rule"), nullptr);
}

TEST(RulePage, LinesOfASectionAreOneTextWithABlankBetweenThem) {
  const auto rule = detail::parse_rule_page(
      "DK301.md",
      replaced(page(), "**Why it matters.** ", "**Why it matters.** one\ntwo\n\nthree "));
  ASSERT_TRUE(rule) << rule.error().message;
  EXPECT_TRUE(rule->why.starts_with("one two three ")) << rule->why;
}

TEST(RulePage, BytesThatAPageCannotShowAreEscaped) {
  const auto at = page().find("- **Fires on"), end = page().find("- **Stays silent on");
  const auto with = [&](const std::string& line) {
    return detail::parse_rule_page("DK301.md", page().substr(0, at) +
                                                   "- **Fires on.**\n```escaped\n" + line +
                                                   "\n```\n" + page().substr(end));
  };
  EXPECT_EQ(with(R"(a\rb\tc\x01\\d\)")->bad, "a\rb\tc\x01\\d");
  EXPECT_FALSE(with(R"(a\q)"));
  EXPECT_FALSE(with(R"(a\x1)"));
}

TEST(Checks, AreThereForThePagesThatACheckFinds) {
  std::set<RuleId> checked, pages;
  for (const detail::Checked& c : detail::all_checks())
    EXPECT_TRUE(checked.insert(c.id).second) << id_text(c.id) << " has two checks";
  for (const detail::BlockChecked& c : detail::all_block_checks()) checked.insert(c.id);
  for (const Rule& r : all_rules())
    if (r.stage == RuleStage::check) pages.insert(r.id);
  EXPECT_EQ(checked, pages);
}

TEST(Rules, AreAllReportedBySomeSource) {
  std::string sources;
  for (const auto& entry : fs::recursive_directory_iterator(test::source_dir() / "libdeck"))
    if ((entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp") &&
        entry.path().stem() != "attach_fixes")
      sources += text_of(entry.path());
  for (const Rule& r : all_rules()) {
    if (!r.cells.empty()) continue;  // its page is the check
    EXPECT_NE(sources.find("RuleId::" + std::string(id_text(r.id))), std::string::npos)
        << "nobody reports " << id_text(r.id);
  }
}

/// Messages in the keyword schemas: the solver's word on a reference is known per cell.
std::set<int> messages_of_cells() {
  std::set<int> out;
  for (const detail::Limit& limit : detail::all_limits()) out.insert(limit.message.number);
  for (const Schema* schema : SchemaSet::built_in().all())
    for (const CardSchema& card : schema->cards)
      for (const Field& f : card.fields)
        for (const auto& number : {f.missing, f.empty, f.required})
          if (number) out.insert(*number);
  return out;
}

/// Rules whose messages stand in the schemas.
bool is_of_cells(RuleId rule) {
  const int number = id_number(rule);
  return (number >= 120 && number <= 122) || (number >= 640 && number <= 642);
}

/// What is wrong with a finding, compared with its page.
std::string disagreement(const Finding& d) {
  const Rule& page = rule_of(d.rule);
  if (std::find(page.severities.begin(), page.severities.end(), d.severity) ==
      page.severities.end())
    return "its severity is not on the page";
  if (!d.reference) {
    const bool other_case = d.severity != page.severity();
    const bool of_cell = is_of_cells(d.rule);
    // An element that breaks off has no message; a card does.
    const bool named = page.messages.empty() || other_case || of_cell || d.rule == RuleId::DK110 ||
                       d.rule == RuleId::DK029;
    return named ? "" : "the page names a message, the finding does not";
  }
  for (const ReferenceMessage& m : page.messages)
    if (m.number == d.reference->number && m.severity == d.reference->severity) return "";
  static const std::set<int> of_cells = messages_of_cells();
  const bool of_cell = is_of_cells(d.rule);
  return of_cell && of_cells.count(d.reference->number) > 0
             ? ""
             : "message " + std::to_string(d.reference->number) + " is not on the page";
}

int expect_agreement(const Linted& run, const std::string& where) {
  for (const Finding& d : run.result.findings) {
    const std::string what = disagreement(d);
    EXPECT_TRUE(what.empty()) << id_text(d.rule) << ": " << what << "\n"
                              << d.message << "\n"
                              << where;
    EXPECT_FALSE(d.reference_behaviour.empty()) << id_text(d.rule);
    EXPECT_FALSE(d.help.empty()) << id_text(d.rule);
  }
  return static_cast<int>(run.result.findings.size());
}

TEST(Findings, OfAllExamplesAgreeWithTheirPages) {
  int found = 0;
  for (const Rule& r : all_rules())
    for (const std::string& example : {r.bad, r.good}) {
      if (example.empty()) continue;
      const ExampleDeck deck = example_deck(example, SchemaSet::built_in());
      const bool alone = deck.files.empty() && deck.limits.empty();
      found += expect_agreement(alone ? lint_geometry(example) : lint_example(example), example);
    }
  EXPECT_GT(found, 500);
}

TEST(Findings, OfAllSamplesAgreeWithTheirPages) {
  int found = 0;
  for (const auto& entry : fs::directory_iterator(test::source_dir() / "samples")) {
    if (entry.path().extension() != ".rad") continue;
    auto deck = read_deck(entry.path().string(), SchemaSet::built_in());
    ASSERT_TRUE(deck);
    found += expect_agreement(lint_geometry_of(std::move(*deck)), entry.path().string());
  }
  EXPECT_GT(found, 50);
}

}  // namespace
}  // namespace deck::test
