// deck lint: findings with file, line and column, in every format that people and pipelines read.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include "common.hpp"
#include "deck/lint/config.hpp"
#include "deck/lint/fix.hpp"
#include "deck/lint/geometry.hpp"
#include "deck/lint/lint.hpp"
#include "deck/model/selection.hpp"
#include "deck/report/diagnostics.hpp"

namespace {

using namespace deck;
using namespace deck::cli;

struct Options {
  CommonOptions common;
  std::string format = "human";
  std::vector<std::string> outputs;  ///< format=file
  std::vector<std::string> select, ignore;
  std::string fail_on, baseline, write_baseline, config;
  bool no_config = false, geometry = false, fix = false, unsafe_fixes = false, diff = false, ruler = false;
  int per_rule = 10;
};

const std::vector<std::string> formats = {"human", "json", "sarif", "github", "junit", "gitlab"};

/// One deck of the run, kept until everything is written.
struct Job {
  std::string path, error;
  std::unique_ptr<Loaded> loaded;
  LintResult result;
};

std::string render(std::string_view format, const std::vector<LintedDeck>& decks,
                   const Options& options, const SchemaSet& schemas, bool to_terminal) {
  if (format == "json") return lint_json(decks);
  if (format == "sarif") return lint_sarif(decks, schemas);
  if (format == "github") return lint_github(decks);
  if (format == "junit") return lint_junit(decks);
  if (format == "gitlab") return lint_gitlab(decks);
  HumanOptions human;
  human.color = to_terminal && options.common.color_on(1);
  human.ruler = options.ruler;
  human.per_rule = options.per_rule;
  return lint_human(decks, human);
}

Result<std::string> read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (in) text << in.rdbuf();
  if (!in) return Error{Error::Code::config, "cannot read " + path};
  return text.str();
}

/// What the command line says, over what the configuration says.
Result<LintOptions> lint_options(const Options& options, const LintConfig& config) {
  LintOptions out;
  out.select = options.select.empty() ? config.select : options.select;
  out.ignore = config.ignore;
  out.ignore.insert(out.ignore.end(), options.ignore.begin(), options.ignore.end());
  out.severity = config.severity;
  out.per_file_ignores = config.per_file_ignores;
  for (const auto* list : {&options.select, &options.ignore})
    for (const std::string& s : *list)
      if (!known_selector(s))
        return Error{Error::Code::config, "no rule is called '" + s + "'; see 'deck rules'"};
  const std::string baseline = options.baseline.empty() ? config.baseline : options.baseline;
  // A baseline that is about to be written replaces the old one.
  if (baseline.empty() || !options.write_baseline.empty()) return out;
  const auto text = read_text(baseline);
  if (!text) return text.error();
  auto parsed = parse_baseline(*text);
  if (!parsed) return Error{Error::Code::config, baseline + ": " + parsed.error().message};
  out.baseline = std::move(*parsed);
  return out;
}

LintResult lint_loaded(Loaded& loaded, const SchemaSet& schemas, const LintOptions& options,
                       const Options& command) {
  LintInput input{loaded.deck,
                  schemas,
                  &loaded.model,
                  &loaded.interfaces,
                  loaded.model.selections.get(),
                  {&loaded.diagnostics},
                  {}};
  if (command.geometry)
    input.extra_checks.push_back([&](const LintContext& context, Reporter& reporter) {
      check_geometry(context, reporter, command.common.thread_count());
    });
  return run_lint(input, options);
}

bool at_or_above(const LintResult& r, std::string_view fail_on) {
  if (fail_on == "never") return false;
  return r.errors > 0 || (fail_on == "warning" && r.warnings > 0);
}

class Run {
 public:
  explicit Run(const Options& options) : options_(options), common_(options.common) {}

  int run() {
    if (const int code = prepare(); code != exit_clean) return code;
    int worst = exit_clean;
    std::map<std::string, std::uint64_t> baseline_left;
    for (const std::string& path : common_.decks) worst = std::max(worst, lint_one(path));
    if (options_.diff || options_.fix || options_.unsafe_fixes) {
      const int code = fixes();
      if (code != exit_clean) worst = std::max(worst, code);
    }
    if (worst >= exit_internal) return worst;
    return std::max(worst, write());
  }

 private:
  int usage(const std::string& message) {
    print_error(common_, message);
    return exit_usage;
  }

  /// Configuration, schemas, output list.
  int prepare() {
    for (const std::string& o : options_.outputs) {
      const auto equal = o.find('=');
      const std::string format = o.substr(0, equal);
      if (equal == std::string::npos || equal + 1 == o.size() ||
          std::find(formats.begin(), formats.end(), format) == formats.end())
        return usage("-o needs FORMAT=FILE, for example -o sarif=lint.sarif; got '" + o + "'");
    }
    auto schemas = load_schemas(common_);
    if (!schemas) return usage(schemas.error().message);
    schemas_ = std::move(*schemas);
    if (!options_.config.empty()) {
      const auto text = read_text(options_.config);
      if (!text) return usage(text.error().message);
      auto config = parse_lint_config(*text, options_.config);
      if (!config) return usage(config.error().message);
      explicit_config_ = std::move(*config);
    }
    return exit_clean;
  }

  Result<LintConfig> config_for(const std::string& path) const {
    if (options_.no_config) return LintConfig{};
    if (!options_.config.empty()) return explicit_config_;
    return find_lint_config(path);
  }

  int lint_one(const std::string& path) {
    auto job = std::make_unique<Job>();
    job->path = path;
    const auto config = config_for(path);
    if (!config) return usage(config.error().message);
    const auto lint = lint_options(options_, *config);
    if (!lint) return usage(lint.error().message);
    auto loaded = load(path, schemas_, common_, Stage::interfaces);
    int code = exit_clean;
    if (!loaded) {
      job->error = loaded.error().message;
      print_error(common_, job->error);
      code = exit_input;
    } else {
      job->loaded = std::move(*loaded);
      job->result = lint_loaded(*job->loaded, schemas_, *lint, options_);
      const std::string fail_on = !options_.fail_on.empty()  ? options_.fail_on
                                  : !config->fail_on.empty() ? config->fail_on
                                                             : "error";
      if (at_or_above(job->result, fail_on)) code = exit_findings;
      if (job->loaded->incomplete()) code = exit_input;
    }
    jobs_.push_back(std::move(job));
    return code;
  }

  /// --diff prints what --fix would write; --fix writes and lints again.
  int fixes() {
    int code = exit_clean;
    std::string diffs;
    for (auto& job : jobs_) {
      if (!job->loaded) continue;
      const SourceSet& sources = job->loaded->deck.sources;
      const FixResult fixed = apply_fixes(sources, job->result.diagnostics, options_.unsafe_fixes);
      if (options_.diff) {
        for (const FixedFile& f : fixed.files)
          diffs += unified_diff(sources[f.file].path(), sources[f.file].bytes(), f.text);
        continue;
      }
      if (fixed.files.empty()) continue;
      if (job->path == "-") return usage("--fix cannot rewrite standard input; use --diff");
      std::vector<OutputFile> files;
      for (const FixedFile& f : fixed.files) files.push_back({sources[f.file].path(), f.text});
      if (auto written = write_files_atomic(files); !written) return usage(written.error().message);
      if (!common_.quiet)
        std::fprintf(stderr, "%s: %zu fixed in %zu file%s\n", job->path.c_str(), fixed.applied,
                     fixed.files.size(), fixed.files.size() == 1 ? "" : "s");
      relint_ = true;
    }
    if (options_.diff) print_text(diffs);
    if (relint_) {
      auto old = std::move(jobs_);
      jobs_.clear();
      for (const auto& job : old) code = std::max(code, lint_one(job->path));
      after_fix_ = code;
    }
    return exit_clean;
  }

  std::vector<LintedDeck> linted() const {
    std::vector<LintedDeck> out;
    for (const auto& job : jobs_)
      out.push_back({job->path, job->loaded ? &job->loaded->deck : nullptr,
                     job->loaded ? &job->result : nullptr, job->error});
    return out;
  }

  int write() {
    const auto decks = linted();
    int code = exit_clean;
    const auto put = [&](const std::string& file, const std::string& text) {
      if (auto written = write_output(file, text); !written)
        code = std::max(code, usage(written.error().message));
    };
    for (const std::string& o : options_.outputs) {
      const auto equal = o.find('=');
      put(o.substr(equal + 1),
          render(o.substr(0, equal), decks, options_, schemas_, o.substr(equal + 1) == "-"));
    }
    if (!common_.json.empty()) put(common_.json, lint_json(decks));
    if (!options_.write_baseline.empty()) {
      std::vector<const LintResult*> results;
      for (const auto& job : jobs_)
        if (job->loaded) results.push_back(&job->result);
      put(options_.write_baseline, deck::write_baseline(results));
    }
    // --json - and -o FORMAT=- take standard output for themselves.
    const bool taken = common_.json == "-" || options_.diff ||
                       std::any_of(options_.outputs.begin(), options_.outputs.end(),
                                   [](const std::string& o) { return o.ends_with("=-"); });
    if (!taken && !(common_.quiet && options_.format == "human"))
      print_text(render(options_.format, decks, options_, schemas_, true));
    else if (options_.diff && !common_.quiet)
      std::fputs(render("human", decks, options_, schemas_, false).c_str(), stderr);
    return code;
  }

 public:
  /// Exit code of the decks as they are after --fix; nullopt if nothing was rewritten.
  bool relinted() const { return relint_; }
  int after_fix() const { return after_fix_; }

 private:
  const Options& options_;
  const CommonOptions& common_;
  SchemaSet schemas_;
  LintConfig explicit_config_;
  std::vector<std::unique_ptr<Job>> jobs_;
  bool relint_ = false;
  int after_fix_ = exit_clean;
};

int run(const Options& options) {
  Run lint(options);
  const int code = lint.run();
  // After --fix only what is left counts, unless writing itself failed.
  return lint.relinted() && code <= exit_findings ? lint.after_fix() : code;
}

Action setup(CLI::App& app) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  add_common(app, o.common);
  app.add_option("--format", o.format, "What to print: human, json, sarif, github, junit, gitlab")
      ->check(CLI::IsMember(formats))
      ->type_name("FORMAT");
  app.add_option("-o,--output", o.outputs, "Write FORMAT to FILE as well (repeatable)")
      ->type_name("FORMAT=FILE")
      ->allow_extra_args(false);
  app.add_option("--select", o.select, "Only these rules: ids or prefixes (DK2), comma-separated")
      ->delimiter(',')
      ->type_name("RULES")
      ->allow_extra_args(false);
  app.add_option("--ignore", o.ignore, "Not these rules")
      ->delimiter(',')
      ->type_name("RULES")
      ->allow_extra_args(false);
  app.add_option("--fail-on", o.fail_on, "Exit with 1 at or above: error (default), warning, never")
      ->check(CLI::IsMember({"error", "warning", "never"}))
      ->type_name("LEVEL");
  app.add_option("--baseline", o.baseline, "Leave out the findings listed in FILE")
      ->type_name("FILE");
  app.add_option("--write-baseline", o.write_baseline, "Write all findings to FILE as a baseline")
      ->type_name("FILE");
  app.add_option("--config", o.config, "Use FILE instead of looking for .decklint.toml")
      ->type_name("FILE");
  app.add_flag("--no-config", o.no_config, "Use no configuration file");
  app.add_flag("--geometry", o.geometry,
               "Also check geometry and first cycle (rules DK3, DK4): penetrations, gaps against the "
               "mesh, segments, contact forces and time step at the start");
  app.add_flag("--fix", o.fix,
               "Apply safe fixes: the reference solver does the same with the deck");
  app.add_flag("--unsafe-fixes", o.unsafe_fixes, "Apply the other fixes too");
  app.add_flag("--diff", o.diff,
               "Print the fixes as a patch (findings on standard error), write nothing");
  app.add_flag("--ruler", o.ruler, "Show column numbers above each card line");
  app.add_option("--per-rule", o.per_rule, "Findings shown per rule; 0 shows all")
      ->check(CLI::Range(0, 1000000))
      ->type_name("N");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"lint", 10, "Findings with file, line and column: what is wrong and how to fix it",
     "  deck lint car_0000.rad\n"
     "  deck lint car_0000.rad --format github --fail-on warning\n"
     "  deck lint car_0000.rad -o sarif=lint.sarif -o junit=lint.xml\n"
     "  deck lint car_0000.rad --write-baseline lint-baseline.json\n"
     "  deck lint car_0000.rad --diff | git apply\n"
     "\n"
     "Settings come from .decklint.toml beside or above the deck. A finding is switched off for "
     "one\n"
     "block by a comment in or above it:  # decklint: ignore[DK203] reason=...\n",
     setup}};

}  // namespace
