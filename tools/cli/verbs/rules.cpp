// deck rules: all rules of deck lint, as a table or as JSON.

#include "common.hpp"
#include "report/shared/diagnostics.hpp"

namespace deck::cli::verb_rules {
namespace {

int run(const CommonOptions& common) {
  if (!common.json.empty())
    if (auto written = common.session->write_output(common.json, rules_json()); !written)
      return failed(common, written.error());
  if (common.wants_text()) print_lines(rules_table(common.color_on(1), text_width()));
  return exit_clean;
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<CommonOptions>();
  add_common_without_decks(line, *options);
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"rules", 80, "All rules of deck lint", "  deck rules\n  deck rules --json rules.json", setup}};

}  // namespace
}  // namespace deck::cli::verb_rules
