// .decklint.toml, key by key: what is read, and what is said of what cannot be.
#include "lint/shared/config.hpp"

#include <gtest/gtest.h>

#include "lint/support.hpp"

namespace deck::test {
namespace {

/// The error of a text, without "c.toml:"; "": it is read.
std::string refused(const std::string& text) {
  const auto config = parse_lint_config(text, "c.toml");
  if (config) return "";
  EXPECT_TRUE(config.error().message.starts_with("c.toml:")) << config.error().message;
  EXPECT_EQ(config.error().code, Error::Code::config);
  return config.error().message.substr(7);
}

TEST(ConfigErrors, NameTheLineAndWhatWouldBeRight) {
  const std::pair<std::string, std::string> rows[] = {
      {"select = []\n", ""},
      {"\nselect = \"DK1\"", "2: 'select' is not a list of strings"},
      {"ignore = [\n 5]", "2: 'ignore' holds something that is not a string"},
      {"ignore = [\"DK777\"]", "1: no rule is called 'DK777'"},
      {"fail-on = 5", "1: 'fail-on' is \"error\", \"warning\" or \"never\""},
      {"fail-on = \"info\"", "1: 'fail-on' is \"error\", \"warning\" or \"never\""},
      {"baseline = 5", "1: 'baseline' is not a path"},
      {"geometry = 1", "1: 'geometry' is true or false"},
      {"severity = 1", "1: 'severity' is not a table"},
      {"[severity]\n\nDK2 = 1", "3: a severity is \"error\", \"warning\" or \"info\""},
      {"[severity]\nDK2 = \"loud\"", "2: a severity is \"error\", \"warning\" or \"info\""},
      {"[severity]\nDK777 = \"info\"", "2: no rule is called 'DK777'"},
      {"per-file-ignores = 1", "1: 'per-file-ignores' is not a table"},
      {"[per-file-ignores]\n\"*.x\" = 1", "2: '*.x' is not a list of strings"},
      {"gate = 1", "1: 'gate' is not a table"},
      {"[gate]\nmax-count = 1.5", "2: 'max-count' is a whole number, 0 or more"},
      {"[gate]\nmax-count = -1", "2: 'max-count' is a whole number, 0 or more"},
      {"[gate]\nmax-untied = \"x\"", "2: 'max-untied' is a whole number, 0 or more"},
      {"[gate]\nmax-count = 0\nmax-untied = 0\nmax-depth = 0\nmax-ratio = 0", ""},
      {"[gate]\nmax-depth = \"x\"", "2: 'max-depth' is a number, 0 or more"},
      {"[gate]\nmax-depth = -0.1", "2: 'max-depth' is a number, 0 or more"},
      {"[gate]\nmax-depth = nan", "2: 'max-depth' is a number, 0 or more"},
      {"[gate]\nmax-depth = 1.5\nmax-ratio = 1\nmax-dt-loss = 1.0", ""},
      {"[gate]\nmax-ratio = 1.01", "2: 'max-ratio' is a share from 0 to 1"},
      {"[gate]\nmax-dt-loss = 30", "2: 'max-dt-loss' is a share from 0 to 1"},
      {"[gate]\nfail-on = \"new\"", "2: 'fail-on' of the gate is a list of \"new\" and \"worse\""},
      {"[gate]\nfail-on = [\"new\", 5]",
       "2: 'fail-on' of the gate is a list of \"new\" and \"worse\""},
      {"[gate]\nfail-on = [\"old\", \"new\"]",
       "2: 'fail-on' of the gate is a list of \"new\" and \"worse\""},
      {"[gate]\nfail-on = []", ""},
      {"[gate]\ncompare = 5", "2: 'compare' is not a path"},
      {"[gate]\nbaseline = 5", "2: 'baseline' is not a path"},
      {"[gate]\nfoo = 5",
       "2: unknown key 'foo'; known: max-depth, max-ratio, max-count, max-untied, max-dt-loss, "
       "compare, fail-on, baseline, interface, part-pair"},
      {"[gate.interface]\nmatch = \"x\"", "1: expected [[gate.interface]], a list of tables"},
      {"[gate.part-pair]\nmatch = \"x\"", "1: expected [[gate.part-pair]], a list of tables"},
      {"[gate]\ninterface = [5]", "2: this is not a table with 'match' and bounds"},
      {"[[gate.interface]]\nmax-depth = 1",
       "1: 'match' is missing: a pattern of the id or title of an interface"},
      {"[[gate.interface]]\nmatch = [\"a\", \"b\"]",
       "2: 'match' is a pattern of the id or title of an interface"},
      {"[[gate.interface]]\nmatch = 5",
       "2: 'match' is a pattern of the id or title of an interface"},
      {"[[gate.interface]]\nmatch = [\"a\"]", ""},
      {"[[gate.part-pair]]\nmatch = \"a\"",
       "2: 'match' is a list of two patterns of ids or titles of parts"},
      {"[[gate.part-pair]]\nmatch = [\"a\", 5]",
       "2: 'match' is a list of two patterns of ids or titles of parts"},
      {"[[gate.part-pair]]\nmatch = [\"a\", \"b\"]\nmax-dt-loss = 0.1",
       "3: unknown key 'max-dt-loss'; known: match, max-depth, max-ratio, max-count"},
      {"[[gate.interface]]\nmatch = \"a\"\nmax-depth = -1",
       "3: 'max-depth' is a number, 0 or more"},
      {"[[gate.interface]]\nmatch = \"a\"\nfoo = 1",
       "3: unknown key 'foo'; known: match, max-depth, max-ratio, max-count, max-untied, "
       "max-dt-loss"},
      {"slect = 1",
       "1: unknown key 'slect'; known: select, ignore, fail-on, baseline, geometry, rules, "
       "severity, "
       "per-file-ignores, gate"},
      {"x = \"\n", "1: "},
      // Keys that begin with what no key can begin with.
      {"[*b*]\n", " is not TOML: "},
      {"[", "1: "},
      {"[[*]]\n", " is not TOML: "},
      {"select = []\n[\nDK104 = \"error\"\n[x]\n", " is not TOML: "},
      {"[ ,", " is not TOML: "},
      {"*=1\n", "1: "},
  };
  for (const auto& [text, wanted] : rows) {
    const std::string found = refused(text);
    if (wanted.ends_with("'DK777'") || wanted.ends_with(": "))
      EXPECT_TRUE(found.starts_with(wanted)) << text << ": " << found;
    else
      EXPECT_EQ(found, wanted) << text;
  }
}

TEST(ConfigErrors, SuggestTheRuleThatWasMeant) {
  EXPECT_EQ(unknown_selector("DK301x"), "no rule is called 'DK301x'; did you mean 'DK301'?");
  EXPECT_EQ(unknown_selector("DK201:Itsf"),
            "no rule is called 'DK201:Itsf'; did you mean 'DK201:Istf'?");
  EXPECT_EQ(unknown_selector("renard-curv"),
            "no rule is called 'renard-curv'; did you mean 'renard-curve'?");
  EXPECT_EQ(unknown_selector("unknown-flag-value:Itsf"),
            "no rule is called 'unknown-flag-value:Itsf'; did you mean 'unknown-flag-value:Istf'?");
  EXPECT_EQ(unknown_selector("nonsense"), "no rule is called 'nonsense'; see 'deck rules'");
}

TEST(ConfigKeys, OfTheGateMatchPairsOfPartsByTwoPatterns) {
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

TEST(ConfigKeys, GeometryIsNotSwitchedOffBesideAGate) {
  for (const char* gate : {"max-depth = 1", "compare = \"git:main\"", "baseline = \"b.json\""})
    EXPECT_FALSE(parse_lint_config(std::string("geometry = false\n[gate]\n") + gate, "c.toml"));
  EXPECT_TRUE(parse_lint_config("geometry = false\n[gate]\n", "c.toml"));
}

TEST(ConfigKeys, OfTheGateKnowRevisionsAndAbsolutePaths) {
  const auto of = [](const std::string& text) {
    const auto c = parse_lint_config("[gate]\n" + text, "/dir/c.toml");
    EXPECT_TRUE(c);
    return std::pair(c->compare, c->accepted);
  };
  using Paths = std::pair<std::string, std::string>;
  EXPECT_EQ(of("compare = \"git:HEAD~1\""), Paths("git:HEAD~1", ""));
  EXPECT_EQ(of("baseline = \"git:HEAD\""), Paths("", "/dir/git:HEAD"));
  EXPECT_EQ(of("compare = \"/abs/x.json\"\nbaseline = \"../y.json\""),
            Paths("/abs/x.json", "/dir/../y.json"));
  const auto fresh = parse_lint_config("[gate]\nfail-on = [\"new\"]", "c.toml");
  EXPECT_TRUE(fresh->gate.on_fresh);
  EXPECT_FALSE(fresh->gate.on_worse);
  EXPECT_TRUE(fresh->gate.any());
  EXPECT_FALSE(parse_lint_config("", "c.toml")->gate.any());
}

TEST(ConfigKeys, AreInTheTemplateAndCanBeRead) {
  // Every line that is a comment with a value becomes one.
  std::string text, line;
  const std::string all = config_template();
  for (const char ch : all) {
    line += ch;
    if (ch != '\n') continue;
    if (line.starts_with("# ") && (line.find(" = ") != line.npos || line[2] == '['))
      text += line.substr(2);
    line.clear();
  }
  const Folder folder;
  folder.write("rules/X101.md",
               "---\nid: X101\nname: a-rule\ntitle: \"t\"\nseverity: info\nwhen: 1\nat: Istf\n"
               "message: \"m\"\n---\n");
  const auto c = parse_lint_config(text, folder.path() + "/c.toml");
  ASSERT_TRUE(c) << c.error().message << "\n" << text;
  EXPECT_EQ(c->rules.size(), 1u);
  EXPECT_EQ(c->select, (std::vector<std::string>{"DK0", "DK1", "DK2"}));
  EXPECT_EQ(c->ignore, (std::vector<std::string>{"DK9"}));
  EXPECT_EQ(c->severity.at("DK9"), Severity::warning);
  EXPECT_EQ(c->gate.general.max_count, 0u);
  EXPECT_TRUE(c->gate.on_fresh && c->gate.on_worse);
  ASSERT_EQ(c->gate.interfaces.size(), 1u);
  EXPECT_EQ(c->gate.interfaces[0].limits.max_dt_loss, 0.2);
  ASSERT_EQ(c->gate.part_pairs.size(), 1u);
  for (const ConfigKey& k : config_keys()) {
    EXPECT_NE(all.find("## " + std::string(k.meaning)), all.npos) << k.key;
    EXPECT_NE(all.find("\n# " + std::string(k.key) + " = " + std::string(k.example) + "\n"),
              all.npos);
    if (!k.fallback.empty()) {
      EXPECT_NE(all.find(" (default: " + std::string(k.fallback) + ")"), all.npos) << k.key;
    }
  }
  EXPECT_NE(all.find("\n# [severity]\n"), all.npos);
  EXPECT_NE(all.find("\n# [[gate.interface]]\n"), all.npos);
  EXPECT_EQ(all.find("\n# [gate]\n"), all.rfind("\n# [gate]\n")) << "once";
}

TEST(ConfigText, QuotesEndWhereTheyEnd) {
  const std::string letter = "\xC3\xA9";
  const std::string wrong = ": a character that is not ASCII is outside of quotes";
  // What follows a string is outside of it again.
  EXPECT_EQ(refused("\"a\" = 1 # x\n" + letter), "2" + wrong);
  EXPECT_EQ(refused("'a' = 1\n\n" + letter), "3" + wrong);
  EXPECT_EQ(refused("x = \"\"\"a\nb\n\"\"\"\n" + letter), "4" + wrong);
  EXPECT_EQ(refused("x = '''a\nb\n'''" + letter), "3" + wrong);
  EXPECT_EQ(refused("x = \"a\\\"b\"\n" + letter), "2" + wrong);
  EXPECT_EQ(refused("x = 'a\\'\n" + letter), "2" + wrong) << "no escape in these";
  EXPECT_EQ(refused("x = \"a\n" + letter), "2" + wrong) << "a string without an end";
  EXPECT_EQ(refused("x = \"\"\n" + letter), "2" + wrong) << "an empty one";
  EXPECT_EQ(refused("# " + letter + "\n" + letter), "2" + wrong);
  EXPECT_EQ(refused(letter), "1" + wrong);
  // Within they are what they are.
  for (const std::string& text :
       {"\"\"\"\n" + letter + "\"\n" + letter + "\"\"\"", "\"" + letter + "\"", "'" + letter + "'",
        "'''" + letter + "''" + letter + "'''"})
    EXPECT_EQ(refused("baseline = " + text + "\n"), "");
}

TEST(ConfigText, KeysHaveAtMostSixteenParts) {
  const auto key = [](int parts) {
    std::string out = "a";
    for (int i = 1; i < parts; ++i) out += ".a";
    return out;
  };
  const std::string many = "dotted parts";
  EXPECT_EQ(refused(key(16) + " = 1").find(many), std::string::npos);
  EXPECT_NE(refused(key(17) + " = 1").find(many), std::string::npos);
  EXPECT_TRUE(refused("\n" + key(17) + " = 1").starts_with("2: "));
  // They are counted anew behind each of these.
  for (const char* between : {"\n", " = 1\n", "[", "{", ","})
    EXPECT_EQ(refused(key(10) + between + key(10)).find(many), std::string::npos) << between;
}

TEST(FindConfig, TakesTheNearestAndNoneAtAll) {
  const Folder folder;
  const auto ignored = [&](const std::string& deck) {
    const auto c = find_lint_config(deck);
    EXPECT_TRUE(c);
    return std::pair(c->ignore, c->path);
  };
  const std::string deck = folder.write("a/b/x_0000.rad", "");
  const std::string outer = folder.write("a/.decklint.toml", "ignore = [\"DK2\"]\n");
  EXPECT_EQ(ignored(deck), std::pair(std::vector<std::string>{"DK2"}, outer));
  const std::string inner = folder.write("a/b/.decklint.toml", "ignore = [\"DK3\"]\n");
  EXPECT_EQ(ignored(deck), std::pair(std::vector<std::string>{"DK3"}, inner));
  EXPECT_EQ(find_lint_config("/x_0000.rad")->path, "");
  folder.write("a/b/.decklint.toml", "ignore = 1\n");
  EXPECT_FALSE(find_lint_config(deck));
}

}  // namespace
}  // namespace deck::test
