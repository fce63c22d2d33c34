// What becomes of findings after the rules: which are left out, softened or counted.
#include <gtest/gtest.h>

#include <sstream>

#include "lint/support.hpp"

namespace deck::test {
namespace {

/// FNV-1a of 64 bits, from its definition.
std::string hash_of(const std::string& text) {
  std::uint64_t h = 14695981039346656037U;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211U;
  char out[20];
  std::snprintf(out, sizeof out, "%016llx", static_cast<unsigned long long>(h));
  return out;
}

TEST(Fingerprints, AreOfRuleEntityAndTheWordsOfTheLine) {
  const Linted run = lint_example("@/INTER/TYPE7/3 Tstart=5 Tstop=2 Stfac=-1\n");
  std::size_t seen = 0;
  for (std::size_t i = 0; i < run.result.findings.size(); ++i) {
    const Finding& d = run.result.findings[i];
    if (d.rule != RuleId::DK252 && d.rule != RuleId::DK221) continue;
    ++seen;
    std::istringstream line(std::string(run.deck->sources[d.span.file].line_at(d.span.offset)));
    std::string words;
    for (std::string word; line >> word;) words += " " + word;
    // DK221:Stfac was a rule of its own once, and keeps its number there.
    const std::string rule = d.rule == RuleId::DK252 ? "DK252" : "DK223";
    EXPECT_EQ(run.result.fingerprints[i], hash_of(rule + "|/INTER/TYPE7|3|" + words));
    EXPECT_EQ(fingerprint(*run.deck, d), run.result.fingerprints[i]);
  }
  EXPECT_EQ(seen, 2u);
  Finding d;
  d.rule = RuleId::DK252;
  d.keyword = "/INTER/TYPE7";
  d.id = 3;
  EXPECT_EQ(fingerprint(*run.deck, d), hash_of("DK252|/INTER/TYPE7|3|")) << "without a place";
}

TEST(Floods, WeighWithTheSeverityOfTheOnesThatAreKept) {
  std::string cards;
  for (int i = 1; i <= 4; ++i)
    cards += "@/INTER/TYPE7/" + std::to_string(i) + " surf_IDm=9 Tstart=5 Tstop=2\n";
  LintOptions options;
  options.select = {"DK170", "DK252"};
  const Linted all = lint_example(cards, options);
  EXPECT_EQ(all.result.errors, 4u);
  EXPECT_EQ(all.result.warnings, 4u);
  EXPECT_TRUE(all.result.dropped.empty());
  options.findings_per_rule = 1;
  const Linted few = lint_example(cards, options);
  EXPECT_EQ(few.result.findings.size(), 2u);
  EXPECT_EQ(few.result.errors, 4u);
  EXPECT_EQ(few.result.warnings, 4u);
  EXPECT_EQ(few.result.dropped,
            (std::map<RuleId, std::uint64_t>{{RuleId::DK170, 3}, {RuleId::DK252, 3}}));
  EXPECT_EQ(few.result.counts, all.result.counts);
  options.severity = {{"DK252", Severity::info}};
  const Linted info = lint_example(cards, options);
  EXPECT_EQ(info.result.warnings, 0u);
  EXPECT_EQ(info.result.infos, 4u);
}

TEST(ZerosBehindTheLine, AreNoFinding) {
  const auto severity = [](const std::string& text) {
    const Linted run =
        lint_example("/FUNCT/9\nf\n" + std::string(19, ' ') + "1" + std::string(19, ' ') + "1" +
                     std::string(60, ' ') + text + "\n");
    const Finding* d = run.find(RuleId::DK012);
    return d == nullptr ? "none" : to_string(d->severity);
  };
  EXPECT_STREQ(severity("0.0"), "none");
  EXPECT_STREQ(severity("  -0 +0.00"), "none");
  EXPECT_STREQ(severity("0.01"), "warning");
  EXPECT_STREQ(severity("x"), "warning");
  EXPECT_STREQ(severity(""), "none");
}

TEST(Absences, AreLeftOutAndCountedWhileAFileIsMissing) {
  const std::string cards =
      "@/INTER/TYPE7/1 surf_IDm=9 grnd_IDs=8\n@/INTER/TYPE7/2 surf_IDm=9 sens_ID=7 Stfac=-1\n"
      "/GRNOD/NODE/5\nlost\n     50001\n/SURF/PART/6\nempty\n        77\n"
      "@/INTER/TYPE7/3 grnd_IDs=5 surf_IDm=6\n";
  const Linted whole = lint_example(cards), missing = lint_example(cards + "#include gone.inc\n");
  EXPECT_EQ(whole.count(RuleId::DK170), 3u) << whole.list();
  EXPECT_EQ(whole.count(RuleId::DK175), 1u);
  EXPECT_TRUE(whole.fires(RuleId::DK150) && whole.fires(RuleId::DK173)) << whole.list();
  for (const RuleId rule :
       {RuleId::DK150, RuleId::DK151, RuleId::DK170, RuleId::DK172, RuleId::DK173, RuleId::DK175})
    EXPECT_EQ(missing.count(rule), 0u) << missing.list();
  EXPECT_TRUE(missing.fires(RuleId::DK004)) << "what is missing itself is an error";
  EXPECT_EQ(missing.result.errors, 1u) << missing.list();
  EXPECT_TRUE(missing.fires(RuleId::DK221)) << "what is wrong in the files that are there";
  const auto said = [](const Linted& run, const std::string& begin) {
    for (const NotChecked& n : run.result.not_checked)
      if (n.what.starts_with(begin)) return n.what + ": " + n.why;
    return std::string();
  };
  EXPECT_EQ(said(whole, "what seems"), "");
  const std::string absent = said(missing, "what seems");
  EXPECT_NE(absent.find("DK170 (3)"), absent.npos) << absent;
  EXPECT_NE(absent.find("DK175"), absent.npos) << absent;
  EXPECT_TRUE(absent.ends_with(": it may be in a file that could not be read")) << absent;
  EXPECT_EQ(said(missing, "the files behind"),
            "the files behind '#include gone.inc': they could not be read");
}

TEST(NotChecked, ListsUnknownKeywordsWithTheirNumber) {
  const auto said = [](const std::string& cards, const std::string& part) {
    for (const NotChecked& n : lint_example(cards).result.not_checked)
      if (n.what.find(part) != n.what.npos) return n.what + ": " + n.why;
    return std::string();
  };
  EXPECT_EQ(said("/FOO/1\n/BAR/2\n/FOO/3\n", "keywords"),
            "blocks of 2 keywords: /BAR, /FOO (2): no schema describes their cards; --schemas DIR "
            "adds some");
  EXPECT_EQ(said("@/INTER/TYPE7/1\n", "keywords"), "");
  EXPECT_EQ(said("/INTER/TYPE23/4\nx\n@/INTER/TYPE7/1\n", "TYPE23"),
            "1 interface of TYPE23 (id 4): only types 2, 7, 10, 11, 19, 24 and 25 have rules");
  EXPECT_EQ(said("@/INTER/TYPE24/1 surf_ID1=1 surf_ID2=2\n@/INTER/TYPE25/2 surf_ID1=1 "
                 "surf_ID2=2\n@/INTER/TYPE7/3\n",
                 "forces"),
            "forces of 2 interfaces of TYPE24 and TYPE25: they are not computed");
  std::string many;
  for (char a = 'A'; a <= 'C'; ++a)
    for (char b = 'A'; b <= 'N'; ++b) many += std::string("/QX") + a + b + "/1\n";
  const std::string list = said(many, "keywords");
  EXPECT_TRUE(list.starts_with("blocks of 42 keywords: /QXAA, ")) << list;
  EXPECT_NE(list.find("/QXCL and 2 more: "), list.npos) << list;
}

TEST(UnusedSuppressions, NameTheirRulesUnlessNoneOfThemCanFire) {
  const auto said = [](const std::string& rules, const LintOptions& options = {}) {
    const Linted run =
        lint_example("# decklint: ignore[" + rules + "] reason=test\n@/INTER/TYPE7/1\n", options);
    const Finding* d = run.find(RuleId::DK091);
    return d == nullptr ? std::string() : d->message;
  };
  EXPECT_EQ(said("DK221, DK201:Istf"), "nothing here violates DK221, DK201:Istf");
  LintOptions off;
  off.ignore = {"DK221"};
  EXPECT_EQ(said("DK221", off), "");
  EXPECT_EQ(said("DK221,DK252", off), "nothing here violates DK221, DK252");
  LintOptions only;
  only.select = {"DK09"};
  EXPECT_EQ(said("DK252", only), "");
}

}  // namespace
}  // namespace deck::test
