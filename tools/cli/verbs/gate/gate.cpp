// deck gate: lint and gaps with the settings of the repository; --init sets a repository up.

#include <fmt/format.h>

#include <algorithm>

#include "base/shared/words.hpp"
#include "library.hpp"
#include "report/shared/text_table.hpp"
#include "verbs/gate/init.hpp"
#include "verbs/lint/lint_run.hpp"

namespace deck::cli::verb_gate {
namespace {

struct Options {
  LintChoice lint;
  GateInit init;
  bool writes = false;
  int commits = -1;  ///< -1: not given
};

/// Findings that fail the gate: exceeded bounds, and the level of --fail-on.
std::vector<const Finding*> stops_of(const LintJob& job) {
  std::vector<const Finding*> out;
  for (const Finding& d : job.result.findings)
    if (is_gate_rule(d.rule) || d.severity == Severity::error ||
        (d.severity == Severity::warning && job.fail_on == "warning"))
      out.push_back(&d);
  return out;
}

/// Only failing findings, with the counts of all.
LintResult narrowed(const LintJob& job) {
  LintResult out = job.result;
  out.findings.clear();
  out.fingerprints.clear();
  for (const Finding* d : stops_of(job)) {
    out.findings.push_back(*d);
    out.fingerprints.push_back(
        job.result.fingerprints[static_cast<std::size_t>(d - job.result.findings.data())]);
  }
  return out;
}

std::string findings_text(const LintJobs& jobs, const CommonOptions& common) {
  std::vector<LintResult> results;
  results.reserve(jobs.size());
  std::vector<LintedDeck> decks;
  for (const auto& job : jobs) {
    if (!job->loaded) continue;
    results.push_back(narrowed(*job));
    if (results.back().findings.empty()) continue;
    decks.push_back(job->linted());
    decks.back().result = &results.back();
  }
  HumanOptions human;
  human.color = common.color_on(1);
  human.quiet = true;
  human.group = !common.verbose;
  human.per_rule = common.verbose ? 0 : 10;
  human.width = text_width();
  return decks.empty() ? std::string() : lint_human(decks, human);
}

std::string table(const LintJobs& jobs, const CommonOptions& common) {
  TextTable table({{"deck"},
                   {"gate"},
                   {"errors", Align::right},
                   {"beyond a bound", Align::right},
                   {"new", Align::right},
                   {"worse", Align::right},
                   {"better", Align::right},
                   {"same", Align::right},
                   {"solved", Align::right}});
  for (const auto& job : jobs) {
    const TextTable::Cell verdict =
        !job->loaded                ? TextTable::Cell("not read", Tone::red)
        : job->report.undecided > 0 ? TextTable::Cell("undecided", Tone::red)
        : job->code != exit_clean   ? TextTable::Cell("stopped", Tone::red)
                                    : TextTable::Cell("passed", Tone::green);
    std::vector<TextTable::Cell> row = {job->path, verdict};
    if (job->loaded) {
      const auto beyond = job->report.findings.size();
      row.emplace_back(
          std::to_string(job->result.errors - std::min<std::uint64_t>(job->result.errors, beyond)));
      row.emplace_back(std::to_string(beyond));
      const GapsComparison& c = job->report.comparison;
      const bool compared = job->report.earlier != nullptr;
      for (const Trend t : {Trend::added, Trend::worse, Trend::better, Trend::same})
        row.emplace_back(compared ? std::to_string(c.count(t)) : "-");
      row.emplace_back(compared ? std::to_string(c.solved.size()) : "-");
    }
    table.row(std::move(row));
  }
  return table.fitted(text_width(), common.color_on(1));
}

std::string last_line(const LintJobs& jobs) {
  const auto stopped = static_cast<std::size_t>(std::count_if(
      jobs.begin(), jobs.end(), [](const auto& job) { return job->code != exit_clean; }));
  if (stopped == 0) return fmt::format("Gate: passed, {}.\n", count(jobs.size(), "deck", "decks"));
  return fmt::format("Gate: not passed, {} of {}.\n", stopped, count(jobs.size(), "deck", "decks"));
}

int print(const Options& o, const LintJobs& jobs, const SchemaSet& schemas) {
  if (jobs.empty()) return exit_clean;  // errors were printed
  CommonOptions common = o.lint.common;
  common.decks.clear();
  for (const auto& job : jobs) common.decks.push_back(job->path);
  int code = exit_clean;
  JsonOutput json(common, "deck/gate", 1);
  if (json.wanted()) {
    for (const auto& job : jobs)
      if (job->loaded)
        json.add(gate_json(job->linted(), job->report, stops_of(*job), job->code == exit_clean));
    code = json.write(code);
  }
  const bool taken =
      common.json == "-" || std::any_of(o.lint.outputs.begin(), o.lint.outputs.end(),
                                        [](const std::string& out) { return out.ends_with("=-"); });
  if (taken || (common.quiet && o.lint.format == "human")) return code;
  if (o.lint.format != "human") {
    print_text(lint_text(o.lint.format, jobs, o.lint, schemas));
    return code;
  }
  const std::string findings = findings_text(jobs, common);
  print_lines(findings + table(jobs, common) + last_line(jobs));
  return code;
}

/// Error: a gate without bounds accepts everything.
Result<void> check_gates(const LintChoice& lint) {
  for (const std::string& deck : lint.common.decks) {
    const auto config = config_of(lint.gate, deck);
    if (!config) return config.error();
    if (!lint.gate.is_given() && !config->gated())
      return config_error(deck +
                          ": no gate is set: run 'deck gate --init', put bounds into [gate] of " +
                          (config->path.empty() ? ".decklint.toml" : config->path) +
                          ", or give one, such as --max-depth 0.5");
  }
  return {};
}

int run(Options& o) {
  CommonOptions& common = o.lint.common;
  const auto pages = team_rules(common);
  if (!pages) return failed(common, pages.error());
  const auto rules = use_rules(*pages);
  if (std::exchange(o.lint.changed, false)) {
    auto decks = decks_of_files(common.decks, {}, common.include_paths);
    if (!decks) return failed(common, decks.error(), exit_input);
    if (decks->empty()) return none_changed(common);
    common.decks = std::move(*decks);
  }
  if (common.decks.empty()) common.decks = {"."};
  if (o.writes && o.lint.accept)
    return wrong_usage("gate", "--init accepts everything already; leave out --accept");
  if (o.writes) {
    if (o.commits >= 0) o.init.commits = static_cast<std::size_t>(o.commits);
    return init_gate(common, o.init);
  }
  if (o.commits >= 0 || !o.init.forge.empty() || o.init.overwrite)
    return wrong_usage("gate", "--commits, --forge and --overwrite go with --init");
  if (o.lint.accept && o.lint.gate.is_given())
    return wrong_usage("gate",
                       "--accept writes the baselines; it takes no bounds and nothing to "
                       "compare with");
  if (const int wrong = open_directories(common); wrong != exit_clean) return wrong;
  for (std::string& deck : common.decks)  // without a leading "." directory
    if (deck.starts_with("./")) deck.erase(0, 2);
  if (auto set = o.lint.accept ? Result<void>() : check_gates(o.lint); !set)
    return failed(common, set.error());
  LintRun lint(o.lint, [&](const LintJobs& jobs, const SchemaSet& schemas) {
    return print(o, jobs, schemas);
  });
  return lint.run();
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  LintChoice& o = options->lint;
  add_common(line, o.common);
  allow_directories(line);
  line.existing("DECK").required(false).describe(
      "Starter decks, or directories: all *_0000.rad below them (default: the current one). With "
      "--changed any files");
  line.flag("--changed", o.changed,
            "The files are those of a change: gate the decks that are or include one of them");
  line.option("--format FORMAT", o.format,
              "What to print: human, concise (a line per finding), json, sarif, github, junit, "
              "gitlab")
      .one_of(lint_formats);
  line.option("-o,--output FORMAT=FILE", o.outputs, "Also write FORMAT to FILE (repeatable)")
      .one_each();
  add_rules(line, o.common);
  add_require_examined(line, o.common);
  add_gate_with_config(line, o.gate, "an error", "an error or a warning");
  add_verbose(line, o.common, "Show every finding in full, without grouping");
  line.flag("--accept", o.accept,
            "Accept what there is: write the findings and penetrations of these decks into the "
            "baselines that .decklint.toml names, in place of what was accepted of them");
  CommandLine init = line.group("Setting a repository up");
  init.flag(
      "--init", options->writes,
      "Write .decklint.toml, the two baselines of what is accepted today and the workflow for "
      "GitHub or GitLab into the git work tree, and say what the gate would have done with "
      "the last commits of the decks");
  init.option("--forge NAME", options->init.forge,
              "github or gitlab (default: what the work tree looks like)")
      .one_of({"github", "gitlab"});
  init.option("--commits N", options->commits, "Commits that --init looks back (default: 10)")
      .range(0, 1000);
  init.flag("--overwrite", options->init.overwrite, "Replace what --init has written before");
  return [options] {
    options->lint.geometry = true;
    options->lint.common.engine_files = true;
    return run(*options);
  };
}

const VerbRegistration registration{
    {"gate", 35, "Lint and gaps against the gate of the repository, in one command",
     R"(  deck gate                          all decks below the current directory
  deck gate models/ --since origin/main --format github -o sarif=deck.sarif
  deck gate models/ --init           sets the repository up
  deck gate --accept car_0000.rad    a change of this deck is meant
  git diff --name-only main | xargs deck gate --changed   the decks of a change

Exit code 1: an error of lint, a contact beyond a bound, or one that is new or worse than in
the document of [gate] in .decklint.toml.)",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_gate
