// deck lint: findings with file, line and column, in every format that people and pipelines read.

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "common.hpp"
#include "deck/base/count.hpp"
#include "deck/base/escape.hpp"
#include "deck/lint/config.hpp"
#include "deck/lint/fix.hpp"
#include "deck/lint/geometry.hpp"
#include "deck/lint/lint.hpp"
#include "deck/model/selection.hpp"
#include "deck/report/diagnostics.hpp"
#include "verbs/gate.hpp"
#include "verbs/settings.hpp"
#include "writing/changes.hpp"
#include "writing/library.hpp"

namespace deck::cli::verb_lint {
namespace {

struct Options {
  CommonOptions common;
  std::string format = "human";
  std::vector<std::string> outputs;  ///< format=file
  std::vector<std::string> select, ignore;
  std::string baseline, write_baseline;
  GateOptions gate;
  bool geometry = false, no_geometry = false, fix = false, unsafe_fixes = false, diff = false,
       ruler = false;
  bool changed = false, init = false, show_config = false, statistics = false;
  WriteChoice write;
  int per_rule = -1;  ///< not given: 10, or all with -v
};

/// How much of the geometry is looked at.
enum class Geometry : std::uint8_t { none, quick, all };

/// A gate is held against the whole deck.
Geometry geometry_of(const Options& options, const LintConfig& config) {
  if (options.no_geometry) return Geometry::none;
  if (options.geometry || options.gate.given()) return Geometry::all;
  if (config.geometry) return *config.geometry ? Geometry::all : Geometry::none;
  const bool gate = config.gate.any() || !config.compare.empty() || !config.accepted.empty();
  return gate ? Geometry::all : Geometry::quick;
}

constexpr std::initializer_list<const char*> formats = {"human",  "concise", "json",  "sarif",
                                                        "github", "junit",   "gitlab"};

/// One deck of the run, kept until everything is written.
struct Job {
  std::string path, error;
  std::optional<LoadedDeck> loaded;
  LintResult result;
  std::optional<Verdict> verdict;
  /// Rule and entity of the entries of the baseline, for those that do not occur any more.
  std::map<FindingKey, std::pair<std::string, std::string>> baseline_names;
};

std::string render(std::string_view format, const std::vector<LintedDeck>& decks,
                   const Options& options, const SchemaSet& schemas, bool to_terminal) {
  if (format == "json") return lint_json(decks);
  if (format == "concise") return lint_concise(decks);
  // The git work tree that this runs in, else the current directory.
  const std::string root = library_root("here");
  if (format == "sarif") return lint_sarif(decks, schemas, root);
  if (format == "github") return lint_github(decks, root);
  if (format == "junit") return lint_junit(decks);
  if (format == "gitlab") return lint_gitlab(decks, root);
  const std::size_t width = to_terminal ? text_width() : 0;
  if (options.statistics)
    return lint_statistics(decks, to_terminal && options.common.color_on(1), width);
  HumanOptions human;
  human.color = to_terminal && options.common.color_on(1);
  human.ruler = options.ruler;
  human.group = !options.common.verbose;
  human.remarks_of_every_deck = options.common.verbose;
  human.per_rule = options.per_rule >= 0 ? options.per_rule : options.common.verbose ? 0 : 10;
  human.width = width;
  return lint_human(decks, human);
}

/// What the command line says, over what the configuration says.
Result<LintOptions> lint_options(const Options& options, const LintConfig& config, Job& job) {
  LintOptions out;
  out.select = options.select.empty() ? config.select : options.select;
  out.ignore = config.ignore;
  out.ignore.insert(out.ignore.end(), options.ignore.begin(), options.ignore.end());
  out.severity = config.severity;
  out.per_file_ignores = config.per_file_ignores;
  out.diagnostics_per_rule = options.common.limits.diagnostics_per_rule;
  for (const auto* list : {&options.select, &options.ignore})
    for (const std::string& s : *list)
      if (!known_selector(s)) return Error{Error::Code::config, unknown_selector(s)};
  const std::string baseline = options.baseline.empty() ? config.baseline : options.baseline;
  // A baseline that is about to be written replaces the old one.
  if (baseline.empty() || !options.write_baseline.empty()) return out;
  const auto text = read_config_file(baseline, most_baseline_bytes);
  if (!text) return text.error();
  options.common.session->remember_read(baseline);
  const auto parsed = parse_baseline(*text, baseline);
  if (!parsed) return parsed.error();
  const auto* entries = parsed->find(job.path);
  if (entries == nullptr) {
    std::vector<std::string> held;
    for (const auto& [deck, unused] : parsed->decks) held.push_back(deck);
    note_not_in_baseline(options.common, job.path, baseline, held);
    return out;
  }
  for (const auto& [key, entry] : *entries) {
    out.baseline.emplace(key, entry.count);
    job.baseline_names.emplace(key, std::pair(entry.rule, entry.entity));
  }
  return out;
}

LintResult lint_loaded(LoadedDeck& loaded, const LintOptions& options, Geometry geometry,
                       const DeckGate& gate, std::optional<ContactFacts>& contacts) {
  SceneOptions wanted = loaded.scene_options();
  wanted.candidates = false;
  wanted.ties = geometry != Geometry::none;
  loaded.set_scene_options(wanted);
  std::vector<ExtraCheck> extra;
  if (geometry != Geometry::none)
    extra.push_back([&](const LintContext& context, Reporter& reporter) {
      return check_geometry(
          context, reporter,
          {geometry == Geometry::quick ? std::optional(QuickLook{}) : std::nullopt, &gate.gate,
           gate.earlier ? &*gate.earlier : nullptr, [&](const Scene& scene, const SceneView& view) {
             contacts = contact_facts(scene, view);
           }});
    });
  LintResult result = run_lint(loaded, options, extra);
  loaded.drop_scene();
  return result;
}

bool passes_a_gate(const LintResult& r) {
  return std::any_of(std::begin(gate_rules), std::end(gate_rules),
                     [&](RuleId rule) { return r.counts.contains(rule); });
}

class Run {
 public:
  explicit Run(const Options& options)
      : options_(options), common_(options.common), changes_(options.common, options.write) {}

  int run() {
    if (const int code = prepare(); code != exit_clean) return code;
    int worst = exit_clean;
    const bool rewrites = options_.diff || options_.fix || options_.unsafe_fixes;
    auto decks = Result<std::vector<std::string>>(common_.decks);
    if (options_.changed) {
      decks = decks_of_files(common_.decks, options_.write.root, common_.include_paths);
      if (decks && decks->empty()) return none_changed();
    } else if (!rewrites)
      decks = decks_in_directories(common_.decks);
    if (rewrites && decks) decks = changes_.decks(*decks, deck_ending);
    if (!decks) {
      print_error(common_, decks.error().message);
      return decks.error().code == Error::Code::config ? exit_usage : exit_input;
    }
    for (const std::string& path : *decks) {
      if (BatchFrame* frame = common_.session->frame) frame->begin(path);
      const int code = lint_one(path);
      if (BatchFrame* frame = common_.session->frame) frame->end(code);
      worst = std::max(worst, code);
    }
    if (rewrites) {
      const int code = std::any_of(common_.decks.begin(), common_.decks.end(),
                                   [](const std::string& d) { return d == "-"; }) &&
                               !options_.diff
                           ? usage("--fix cannot rewrite standard input; use --diff")
                           : fixes();
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

  int none_changed() const {
    if (!common_.quiet) print_note("no deck includes any of these files; nothing to lint");
    return exit_clean;
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
    std::vector<std::string> files = {common_.json, options_.write_baseline};
    for (const std::string& o : options_.outputs) files.push_back(o.substr(o.find('=') + 1));
    if (const int bad = check_outputs(common_, files); bad != exit_clean) return bad;
    if (auto legal = check_fail_on(options_.gate); !legal) return usage(legal.error().message);
    if (options_.geometry && options_.no_geometry)
      return usage("--geometry and --no-geometry exclude each other");
    if (options_.statistics && options_.format != "human")
      return usage("--statistics cannot be combined with --format");
    if (options_.gate.given() && options_.no_geometry)
      return usage("the bounds of the gate need geometry; leave out --no-geometry");
    auto schemas = load_schemas(common_);
    if (!schemas) return usage(schemas.error().message);
    schemas_ = std::move(*schemas);
    return exit_clean;
  }

  int lint_one(const std::string& path) {
    auto job = std::make_unique<Job>();
    job->path = path;
    const auto config = config_of(options_.gate, path);
    if (!config) return usage(config.error().message);
    const Geometry geometry = geometry_of(options_, *config);
    // Without geometry nothing is held against the gate.
    auto gate =
        geometry == Geometry::none ? DeckGate{} : gate_of(options_.gate, *config, path, common_);
    if (!gate) return usage(gate.error().message);
    gate->note_baseline(common_, path);
    const auto lint = lint_options(options_, *config, *job);
    if (!lint) return usage(lint.error().message);
    auto loaded = load(path, schemas_, common_);
    int code = exit_clean;
    if (!loaded) {
      job->error = loaded.error().message;
      print_error(common_, job->error);
      code = loaded.error().code == Error::Code::config ? exit_usage : exit_input;
    } else {
      job->loaded.emplace(std::move(*loaded));
      std::optional<ContactFacts> contacts;
      job->result = lint_loaded(*job->loaded, *lint, geometry, *gate, contacts);
      const auto& skipped = job->result.not_checked;
      const bool left_out = geometry != Geometry::none &&
                            std::any_of(skipped.begin(), skipped.end(), [](const NotChecked& n) {
                              return n.what == geometry_rules;
                            });
      job->verdict = lint_verdict(linted(*job), std::move(contacts), left_out);
      const std::string given = options_.gate.level();
      const std::string fail_on = !given.empty()             ? given
                                  : !config->fail_on.empty() ? config->fail_on
                                                             : "error";
      if (exit_code_of(*job->verdict,
                       {fail_on == "warning", fail_on == "never", common_.require_examined}) != 0 ||
          passes_a_gate(job->result))
        code = exit_findings;
      code = std::max(code, examined_code(*job->loaded, common_));
      if (job->loaded->incomplete()) code = exit_input;
    }
    jobs_.push_back(std::move(job));
    return code;
  }

  /// What all decks together want fixed. A fix of a file that they share is made only if all of
  /// them want it.
  Result<std::size_t> collect_fixes(Changes& set, std::vector<FixResult>& results) {
    std::vector<FixedDeck> decks;
    std::vector<const Job*> jobs;
    for (const auto& job : jobs_)
      if (job->loaded) {
        decks.push_back({&job->loaded->deck().sources, &job->result.diagnostics});
        jobs.push_back(job.get());
      }
    const AgreedFixes agreed = agree_on_fixes(decks, options_.unsafe_fixes);
    std::size_t changed = 0;
    for (std::size_t d = 0; d < decks.size(); ++d) {
      const Deck& deck = jobs[d]->loaded->deck();
      const auto member = set.add(*jobs[d]->loaded, jobs[d]->path);
      if (!member) return member.error();
      results.push_back(apply_fixes(deck.sources, agreed.wanted[d]));
      ChangedFiles files;
      for (FixedFile& f : results.back().files) {
        const std::string& path = deck.sources[f.file].path();
        if (const auto [it, is_new] = files.try_emplace(path, f.text);
            !is_new && it->second != f.text)
          return Error{Error::Code::config,
                       path +
                           " is included more than once and would become two different files; "
                           "nothing was written"};
      }
      changed += files.size();
      set.propose(*member, deck, files);
    }
    constexpr std::size_t most = 10;
    for (std::size_t i = 0; i < std::min(most, agreed.withheld.size()) && !common_.quiet; ++i) {
      const WithheldFix& w = agreed.withheld[i];
      print_messages(fmt::format(
          "{}: note: not fixed ({}): {} includes this file too and needs it unchanged\n",
          terminal_text(jobs[w.deck]->loaded->deck().sources.where(w.diagnostic->span)),
          id_text(w.diagnostic->rule), terminal_text(jobs[w.other]->path)));
    }
    if (agreed.withheld.size() > most && !common_.quiet)
      print_note(
          fmt::format("{} more were not fixed for this reason", agreed.withheld.size() - most));
    return changed;
  }

  /// --diff prints what --fix would write; --fix writes, every file once, and lints again.
  int fixes() {
    int code = exit_clean;
    std::vector<FixResult> results;
    const auto changed = collect_fixes(changes_, results);
    if (!changed) return usage(changed.error().message);
    if (options_.diff) {
      const auto patch = changes_.diff();
      if (!patch) return usage(patch.error().message);
      print_contents(*patch);
    } else if (*changed > 0) {
      if (auto written = changes_.write(false); !written) return usage(written.error().message);
      for (std::size_t d = 0, r = 0; d < jobs_.size(); ++d) {
        if (!jobs_[d]->loaded) continue;
        const FixResult& fixed = results[r++];
        if (!common_.quiet && !fixed.files.empty())
          print_messages(fmt::format("{}: {} fixed in {}\n", terminal_text(jobs_[d]->path),
                                     fixed.applied, count(fixed.files.size(), "file", "files")));
      }
      relint_ = true;
    }
    if (relint_) {
      auto old = std::move(jobs_);
      jobs_.clear();
      for (const auto& job : old) code = std::max(code, lint_one(job->path));
      after_fix_ = code;
    }
    return exit_clean;
  }

  /// Entries of the baseline that hide nothing: they would hide the next finding of that kind.
  void report_stale() const {
    for (const auto& job : jobs_) {
      if (!job->loaded || job->result.stale.empty() || common_.quiet) continue;
      constexpr std::size_t most = 10;
      print_messages(
          fmt::format("{}: note: {} entries of the baseline no longer occur; write it again with "
                      "--write-baseline\n",
                      terminal_text(job->path), job->result.stale.size()));
      std::size_t shown = 0;
      for (const auto& [key, n] : job->result.stale) {
        if (shown++ == most) break;
        const auto& [rule, entity] = job->baseline_names.at(key);
        print_messages(fmt::format("  {} {}{}{}: {}\n", terminal_text(key.first),
                                   terminal_text(rule), entity.empty() ? "" : " ",
                                   terminal_text(entity), deck::count(n, "time", "times")));
      }
    }
  }

  std::vector<LintedDeck> linted() const {
    std::vector<LintedDeck> out;
    for (const auto& job : jobs_) out.push_back(linted(*job));
    return out;
  }
  static LintedDeck linted(const Job& job) {
    return {job.path,
            job.loaded ? &job.loaded->deck() : nullptr,
            job.loaded ? &job.result : nullptr,
            job.error,
            job.loaded ? &job.loaded->interfaces() : nullptr,
            nullptr,
            job.verdict};
  }

  int write() {
    const auto decks = linted();
    int code = exit_clean;
    const auto put = [&](const std::string& file, const std::string& text) {
      if (auto written = common_.session->write_output(file, text); !written)
        code = std::max(code, usage(written.error().message));
    };
    for (const std::string& o : options_.outputs) {
      const auto equal = o.find('=');
      put(o.substr(equal + 1),
          render(o.substr(0, equal), decks, options_, schemas_, o.substr(equal + 1) == "-"));
    }
    if (!common_.json.empty()) put(common_.json, lint_json(decks));
    if (!options_.write_baseline.empty()) {
      std::vector<BaselinedDeck> baselined;
      for (const auto& job : jobs_)
        if (job->loaded) baselined.push_back({job->path, &job->loaded->deck(), &job->result});
      put(options_.write_baseline, deck::write_baseline(baselined, options_.write_baseline));
    }
    report_stale();
    // --json - and -o FORMAT=- take standard output for themselves.
    const bool taken = common_.json == "-" || options_.diff ||
                       std::any_of(options_.outputs.begin(), options_.outputs.end(),
                                   [](const std::string& o) { return o.ends_with("=-"); });
    if (!taken && !(common_.quiet && options_.format == "human")) {
      const std::string text = render(options_.format, decks, options_, schemas_, true);
      options_.format == "human" ? print_lines(text) : print_text(text);
    } else if (options_.diff && !common_.quiet)
      print_messages(render("human", decks, options_, schemas_, false));
    return code;
  }

 public:
  /// Exit code of the decks as they are after --fix; nullopt if nothing was rewritten.
  bool relinted() const { return relint_; }
  int after_fix() const { return after_fix_; }

 private:
  const Options& options_;
  const CommonOptions& common_;
  Changes changes_;
  SchemaSet schemas_;
  std::vector<std::unique_ptr<Job>> jobs_;
  bool relint_ = false;
  int after_fix_ = exit_clean;
};

int init(const Options& options) {
  const CommonOptions& common = options.common;
  const auto path = common.decks.size() > 1
                        ? Error{Error::Code::config, "--init takes one directory"}
                        : write_settings_file(common.decks.empty() ? "" : common.decks.front());
  if (!path) {
    print_error(common, path.error().message);
    return exit_usage;
  }
  if (!common.quiet) print_text("wrote " + terminal_text(*path) + "\n");
  return exit_clean;
}

/// For every deck, or for one in the current directory.
int show_config(const Options& options) {
  const std::optional<bool> geometry = options.no_geometry ? std::optional(false)
                                       : options.geometry  ? std::optional(true)
                                                           : std::nullopt;
  const GivenSettings given{options.select, options.ignore, options.baseline, options.gate,
                            geometry};
  const std::vector<std::string>& decks = options.common.decks;
  for (const std::string& deck : decks.empty() ? std::vector<std::string>{"-"} : decks) {
    const auto config = config_of(options.gate, deck);
    if (!config) {
      print_error(options.common, config.error().message);
      return exit_usage;
    }
    const std::string of = deck == "-" ? "the current directory" : deck;
    print_text(terminal_text(
                   of + ": " +
                   (config->path.empty() ? "no .decklint.toml" : "settings of " + config->path)) +
               "\n" + settings_text(*config, given));
  }
  return exit_clean;
}

int run(const Options& options) {
  if (options.init) return init(options);
  if (options.show_config) return show_config(options);
  if (options.common.decks.empty()) return wrong_usage("lint", "DECK is missing");
  Run lint(options);
  const int code = lint.run();
  // After --fix only what is left counts, unless writing itself failed.
  return lint.relinted() && code <= exit_findings ? lint.after_fix() : code;
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  add_common(line, o.common);
  line.option("--format", o.format,
              "What to print: human, concise (one line a finding), json, sarif, github, junit, "
              "gitlab")
      .one_of(formats)
      .value("FORMAT");
  line.flag("--statistics", o.statistics,
            "Print one line a rule: how many findings, and how many of them can be fixed");
  line.option("-o,--output", o.outputs, "Also write FORMAT to FILE (repeatable)")
      .value("FORMAT=FILE")
      .one_each();
  line.option("--select", o.select, "Only these rules: ids or prefixes (DK2), comma-separated")
      .by_commas()
      .value("RULES");
  line.option("--ignore", o.ignore, "Not these rules").by_commas().value("RULES");
  line.option("--baseline", o.baseline,
              "Leave out the findings listed in FILE, of the decks listed there")
      .value("FILE");
  line.option("--write-baseline", o.write_baseline, "Write all findings to FILE as a baseline")
      .value("FILE");
  line.existing("decks").required(false).describe(
      "Starter decks, or directories: all *_0000.rad below them; '-' is standard input. With "
      "--changed any files");
  line.flag("--changed", o.changed,
            "The files are the files of a change: lint the decks among them, and all decks of the "
            "git work tree (or --root) that include one of the others");
  line.flag("--init", o.init,
            "Write .decklint.toml with every key as a comment, into the current or the given "
            "directory, unless there is one");
  line.flag("--show-config", o.show_config,
            "Print every setting of the deck, and where it comes from");
  add_require_examined(line, o.common);
  add_gate_with_config(line, o.gate, "an error", "an error or a warning");
  line.flag("--geometry", o.geometry,
            "Check geometry and first cycle (rules DK3, DK4) of decks of any size: penetrations, "
            "gaps against the mesh, segments, contact forces and time step at the start. By "
            "default this is left out for a deck that would take long, and the report says so");
  line.flag("--no-geometry", o.no_geometry, "Do not check geometry and first cycle");
  line.flag("--fix", o.fix,
            "Apply safe fixes: they change nothing for the reference solver (except DK511: the "
            "values of a default block take effect). A file that several decks share is fixed only "
            "if all of them need the same text");
  line.flag("--unsafe-fixes", o.unsafe_fixes, "Apply the other fixes too");
  line.flag("--diff", o.diff,
            "Print the fixes as a patch (findings on standard error), write nothing");
  add_dependent_options(line, o.write);
  line.flag("--ruler", o.ruler, "Show column numbers above each card line");
  add_verbose(line, o.common, "Show every finding in full, without grouping");
  line.flag("--no-group", o.common.verbose, "The same");
  line.option("--per-rule", o.per_rule, "Findings shown per rule; 0 shows all (default: 10)")
      .range(0, 1000000)
      .value("N");
  return [options] {
    options->common.engine_files = true;
    options->common.rewrites = (options->fix || options->unsafe_fixes) && !options->diff;
    options->write.in_place = options->common.rewrites;
    options->write.diff = options->diff;
    WriteChoice checked = options->write;
    if (options->changed) checked.root.clear();  // which goes with that as well
    if (const std::string wrong = usage_error(checked); !wrong.empty()) {
      print_error(options->common, wrong);
      return static_cast<int>(exit_usage);
    }
    // What is fixed, or counted as fixable, has to be kept.
    constexpr int most_fixes_of_a_rule = 1'000'000;
    if (options->fix || options->unsafe_fixes || options->diff || options->statistics)
      options->common.limits.diagnostics_per_rule = most_fixes_of_a_rule;
    return run(*options);
  };
}

const VerbRegistration registration{
    {"lint", 10, "Findings with file, line and column: what is wrong and how to fix it",
     "  deck lint car_0000.rad\n"
     "  deck lint car_0000.rad --format github --fail-on warning\n"
     "  deck lint car_0000.rad -o sarif=lint.sarif -o junit=lint.xml\n"
     "  deck lint car_0000.rad --write-baseline lint-baseline.json\n"
     "  deck lint car_0000.rad --diff | git apply\n"
     "  deck lint models/ --format concise\n"
     "  deck lint models/ --statistics\n"
     "\n"
     "Settings come from .decklint.toml beside or above the deck. A finding is switched off for "
     "one\n"
     "block by a comment in or above it:  # decklint: ignore[DK203] reason=...\n",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_lint
