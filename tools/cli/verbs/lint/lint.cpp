// deck lint: findings with file, line and column in all formats.

#include "base/shared/shown_text.hpp"
#include "common.hpp"
#include "verbs/lint/lint_run.hpp"

namespace deck::cli::verb_lint {
namespace {

int init(const LintChoice& options) {
  const CommonOptions& common = options.common;
  const auto path = common.decks.size() > 1
                        ? config_error("--init takes one directory")
                        : write_settings_file(common.decks.empty() ? "" : common.decks.front());
  if (!path) return failed(common, path.error());
  if (!common.quiet) print_text("wrote " + terminal_text(*path) + "\n");
  return exit_clean;
}

/// For every deck, or for a deck in the current directory.
int show_config(const LintChoice& options) {
  const std::optional<bool> geometry = options.no_geometry ? std::optional(false)
                                       : options.geometry  ? std::optional(true)
                                                           : std::nullopt;
  const GivenSettings given{options.select,       options.ignore, options.baseline,
                            options.common.rules, options.gate,   geometry};
  const std::vector<std::string>& decks = options.common.decks;
  for (const std::string& deck : decks.empty() ? std::vector<std::string>{"-"} : decks) {
    const auto config = config_of(options.gate, deck);
    if (!config) return failed(options.common, config.error());
    const std::string of = deck == "-" ? "the current directory" : deck;
    print_text(terminal_text(
                   of + ": " +
                   (config->path.empty() ? "no .decklint.toml" : "settings of " + config->path)) +
               "\n" + settings_text(*config, given));
  }
  return exit_clean;
}

int run(const LintChoice& options) {
  const auto pages = team_rules(options.common);
  if (!pages) return failed(options.common, pages.error());
  const auto rules = use_rules(*pages);
  if (options.init) return init(options);
  if (options.show_config) return show_config(options);
  if (options.common.decks.empty()) return wrong_usage("lint", "DECK is missing");
  LintRun lint(options);
  const int code = lint.run();
  // After --fix only the remaining findings count, unless writing failed.
  return lint.relinted() && code <= exit_findings ? lint.after_fix() : code;
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<LintChoice>();
  LintChoice& o = *options;
  add_common(line, o.common);
  line.option("--format FORMAT", o.format,
              "What to print: human, concise (a line per finding), json, sarif, github, junit, "
              "gitlab")
      .one_of(lint_formats);
  line.flag("--statistics", o.statistics,
            "Print one line per rule: number of findings, number fixable");
  line.option("-o,--output FORMAT=FILE", o.outputs, "Also write FORMAT to FILE (repeatable)")
      .one_each();
  line.option("--select RULES", o.select,
              "Only these rules: ids, names, prefixes (DK2) or fields (DK201:Istf), "
              "comma-separated")
      .by_commas();
  line.option("--ignore RULES", o.ignore, "Not these rules").by_commas();
  add_rules(line, o.common);
  line.option("--baseline FILE", o.baseline,
              "Leave out the findings listed in FILE, of the decks listed there");
  line.option("--write-baseline FILE", o.write_baseline,
              "Write all findings to FILE as a baseline; entries of other decks stay");
  line.existing("DECK").required(false).describe(
      "Starter decks, or directories: all *_0000.rad below them; '-' is standard input. With "
      "--changed any files");
  line.flag("--changed", o.changed,
            "Take the files as changed files: lint the decks among them and every deck of the git "
            "work tree (or --root) that includes one of the others");
  line.flag("--init", o.init,
            "Write .decklint.toml with every key as a comment, into the current or the given "
            "directory, unless there is one");
  line.flag("--show-config", o.show_config,
            "Print every setting of the deck, and where it comes from");
  add_require_examined(line, o.common);
  add_gate_with_config(line, o.gate, "an error", "an error or a warning");
  line.flag("--geometry", o.geometry,
            "Check geometry and first cycle (rules DK3, DK4) of decks of any size; by default "
            "this is left out for a deck that would take long, and the report says so");
  line.flag("--no-geometry", o.no_geometry, "Do not check geometry and first cycle");
  line.flag("--fix", o.fix,
            "Apply safe fixes: they change nothing for the solver (except DK511: the values of a "
            "default block take effect). A file of several decks has to be fixed alike for all");
  line.flag("--unsafe-fixes", o.unsafe_fixes, "Apply the other fixes too");
  line.flag("--diff", o.diff,
            "Print the fixes as a patch (findings on standard error), write nothing");
  add_root_option(line, o.write);
  line.flag("--ruler", o.ruler, "Show column numbers above each card line");
  add_verbose(line, o.common, "Show every finding in full, without grouping");
  line.flag("--no-group", o.common.verbose, "The same");
  line.option("--per-rule N", o.per_rule, "Findings shown per rule; 0 shows all (default: 10)")
      .range(0, 1000000);
  return [options] {
    options->common.engine_files = options->common.unread_too = true;
    options->common.rewrites = (options->fix || options->unsafe_fixes) && !options->diff;
    options->write.in_place = options->common.rewrites;
    options->write.diff = options->diff;
    WriteFlags checked = options->write;
    if (options->changed) checked.root.clear();  // also part of --changed
    if (const std::string wrong = usage_error(checked); !wrong.empty())
      return failed(options->common, wrong);
    // Keeps all findings that are fixed or counted as fixable.
    constexpr int most_fixes_of_a_rule = 1'000'000;
    if (options->fix || options->unsafe_fixes || options->diff || options->statistics)
      options->common.limits.findings_per_rule = most_fixes_of_a_rule;
    return run(*options);
  };
}

const VerbRegistration registration{
    {"lint", 10, "Findings with file, line and column: what is wrong and how to fix it",
     R"(  deck lint car_0000.rad
  deck lint car_0000.rad --format github --fail-on warning
  deck lint car_0000.rad -o sarif=lint.sarif -o junit=lint.xml
  deck lint car_0000.rad --write-baseline lint-baseline.json
  deck lint car_0000.rad --diff | git apply
  deck lint models/ --statistics

Settings come from .decklint.toml beside or above the deck. A finding is switched off for one
block by a comment in or above it:  # decklint: ignore[DK104] reason=...)",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_lint
