// deck rules: all rules of deck lint as table or JSON; checks team rules.

#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "common.hpp"
#include "lint/shared/example.hpp"
#include "report/shared/findings.hpp"

namespace deck::cli::verb_rules {
namespace {

/// Runs the examples of the pages.
int check(const CommonOptions& common, const std::vector<RulePage>& pages) {
  std::string text;
  for (const std::string& line : broken_examples(pages)) text += terminal_text(line) + "\n";
  print_lines(text);
  if (text.empty() && common.wants_text())
    print_lines(count(pages.size(), "rule", "rules") + ", all examples do what they promise\n");
  return text.empty() ? exit_clean : exit_findings;
}

int run(const CommonOptions& common, bool tries) {
  const auto pages = team_rules(common, true);
  if (!pages) return failed(common, pages.error());
  const auto rules = use_rules(*pages);
  if (!common.json.empty())
    if (auto written = common.session->write_output(common.json, rules_json()); !written)
      return failed(common, written.error());
  if (tries) return check(common, *pages);
  if (common.wants_text()) print_lines(rules_table(common.color_on(1), text_width()));
  return exit_clean;
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<CommonOptions>();
  add_common_without_decks(line, *options);
  add_rules(line, *options);
  const Option check = line.option("--check DIR", options->rules,
                                   "Try the examples of your own rules in DIR; exit 1 if one does "
                                   "not do what it promises");
  return [options, check] { return run(*options, check.count() > 0); };
}

const VerbRegistration registration{
    {"rules", 80, "All rules of deck lint",
     "  deck rules\n  deck rules --json rules.json\n  deck rules --check rules/", setup}};

}  // namespace
}  // namespace deck::cli::verb_rules
