// A lint run: loads and lints each deck, applies agreed fixes, writes and prints.
#include "verbs/lint/lint_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "library.hpp"
#include "lint/shared/config.hpp"
#include "lint/shared/fix.hpp"
#include "lint/shared/geometry.hpp"

namespace deck::cli {

namespace linting {
namespace {

/// A gate needs the complete geometry.
Geometry geometry_of(const LintChoice& options, const LintConfig& config) {
  if (options.no_geometry) return Geometry::none;
  if (options.geometry || options.gate.is_given()) return Geometry::all;
  if (config.geometry) return *config.geometry ? Geometry::all : Geometry::none;
  return config.gated() ? Geometry::all : Geometry::quick;
}

/// Options override the configuration.
Result<LintOptions> lint_options(const LintChoice& options, const LintConfig& config,
                                 LintJob& job) {
  LintOptions out;
  out.select = options.select.empty() ? config.select : options.select;
  out.ignore = config.ignore;
  out.ignore.insert(out.ignore.end(), options.ignore.begin(), options.ignore.end());
  out.severity = config.severity;
  out.per_file_ignores = config.per_file_ignores;
  out.findings_per_rule = options.common.limits.findings_per_rule;
  for (const auto* list : {&options.select, &options.ignore})
    for (const std::string& s : *list)
      if (!known_selector(s)) return config_error(unknown_selector(s));
  const std::string baseline = options.baseline.empty() ? config.baseline : options.baseline;
  // A baseline to be written replaces the old one.
  if (baseline.empty() || !options.write_baseline.empty() || options.accept) return out;
  const auto read = baseline_at(options.gate, baseline, Baseline::Kind::lint);
  if (!read) return read.error();
  auto entries = (*read)->findings_of(job.path);
  if (!entries) return entries.error();
  out.baseline = std::move(*entries);
  if (!(*read)->has(job.path)) {
    job.without_entries = baseline;
    job.decks_with_entries = (*read)->decks();
  }
  return out;
}

/// Also restores the order of places.
void stand_at_changes(LintResult& result, const SourceSet& sources, const ChangedLines& lines) {
  if (lines.empty()) return;
  deck::stand_at_changes(result.findings, sources, lines);
  std::vector<std::size_t> order(result.findings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t i) {
    const Finding& d = result.findings[i];
    return std::tuple(d.span.file, d.span.offset, d.rule);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  LintResult sorted;
  for (const std::size_t i : order) {
    sorted.findings.push_back(std::move(result.findings[i]));
    sorted.fingerprints.push_back(std::move(result.fingerprints[i]));
  }
  result.findings = std::move(sorted.findings);
  result.fingerprints = std::move(sorted.fingerprints);
}

/// Prints a note, once, for selectors with former rule ids.
void note_renamed(const LintOptions& options, std::set<std::string>& told) {
  std::vector<std::string> all = options.select;
  all.insert(all.end(), options.ignore.begin(), options.ignore.end());
  for (const auto& [selector, severity] : options.severity) all.push_back(selector);
  for (const auto& [pattern, selectors] : options.per_file_ignores)
    all.insert(all.end(), selectors.begin(), selectors.end());
  for (const std::string& selector : all)
    if (const std::string now = renamed_selector(selector);
        !now.empty() && told.insert(selector).second)
      print_note(now);
}

}  // namespace
}  // namespace linting

LintResult lint_loaded(LoadedDeck& loaded, const LintOptions& options, Geometry geometry,
                       const DeckGate& gate, const SeenContacts& seen, std::size_t* too_large) {
  SceneOptions wanted = loaded.scene_options();
  wanted.candidates = false;
  wanted.ties = geometry != Geometry::none;
  loaded.set_scene_options(wanted);
  std::vector<ExtraCheck> extra;
  if (geometry != Geometry::none)
    extra.push_back([&](const LintContext& context, Reporter& reporter) {
      GeometryOptions look;
      if (geometry == Geometry::quick) look.quick.emplace();
      look.gate = &gate.gate;
      look.earlier = gate.earlier ? &*gate.earlier : nullptr;
      look.changed = &gate.changed;
      look.seen = seen;
      look.too_large = too_large;
      return check_geometry(context, reporter, look);
    });
  LintOptions how = options;
  how.gated = gate.gate.any() || gate.earlier;
  LintResult result = run_lint(loaded, how, extra);
  loaded.drop_scene();
  linting::stand_at_changes(result, loaded.deck().sources, gate.changed);
  return result;
}

int LintRun::run() {
  if (const int code = prepare(); code != exit_clean) return code;
  int worst = exit_clean;
  const bool rewrites = options_.diff || options_.fix || options_.unsafe_fixes;
  auto decks = Result<std::vector<std::string>>(common_.decks);
  if (options_.changed) {
    decks = decks_of_files(common_.decks, options_.write.root, common_.include_paths);
    if (decks && decks->empty()) return none_changed(common_);
  } else if (!rewrites)
    decks = decks_in_directories(common_.decks);
  if (rewrites && decks) decks = changes_.decks(*decks);
  if (!decks) return failed(common_, decks.error(), reading_code(decks.error()));
  for (const std::string& path : *decks)
    worst = std::max(worst, common_.session->about(path, [&] { return lint_one(path); }));
  if (rewrites) {
    const int code = std::any_of(common_.decks.begin(), common_.decks.end(),
                                 [](const std::string& d) { return d == "-"; }) &&
                             !options_.diff
                         ? usage("--fix cannot rewrite standard input; use --diff")
                         : fixes();
    if (code != exit_clean) worst = std::max(worst, code);
  }
  if (worst >= exit_internal) return worst;
  std::vector<RulePage> all;
  for (const auto& [id, page] : rules_) all.push_back(page);
  const auto rules = use_rules(all);
  return options_.accept ? accept(worst) : std::max(worst, write());
}

int none_changed(const CommonOptions& common) {
  if (!common.quiet) print_note("no deck includes any of these files; nothing to lint or gate");
  return exit_clean;
}

/// Reads configuration and schemas, and checks outputs.
int LintRun::prepare() {
  for (const std::string& o : options_.outputs) {
    const auto equal = o.find('=');
    const std::string format = o.substr(0, equal);
    if (equal == std::string::npos || equal + 1 == o.size() ||
        std::find(lint_formats.begin(), lint_formats.end(), format) == lint_formats.end())
      return usage("-o needs FORMAT=FILE, for example -o sarif=lint.sarif; got '" + o + "'");
  }
  std::vector<std::string> files = {common_.json, options_.write_baseline};
  for (const std::string& o : options_.outputs) files.push_back(o.substr(o.find('=') + 1));
  if (const int bad = check_outputs(common_, files); bad != exit_clean) return bad;
  if (auto legal = check_fail_on(options_.gate); !legal) return usage(legal.error());
  if (options_.geometry && options_.no_geometry)
    return usage("--geometry and --no-geometry exclude each other");
  if (options_.statistics && options_.format != "human")
    return usage("--statistics cannot be combined with --format");
  if (options_.gate.is_given() && options_.no_geometry)
    return usage("the bounds of the gate need geometry; leave out --no-geometry");
  auto schemas = load_schemas(common_);
  if (!schemas) return usage(schemas.error());
  schemas_ = std::move(*schemas);
  return exit_clean;
}

/// Reports name rules by id, so all decks must agree on the ids.
Result<void> LintRun::keep_rules(const std::vector<RulePage>& of_deck) {
  for (const RulePage& page : of_deck) {
    const auto [kept, fresh] = rules_.try_emplace(page.rule.id, page);
    if (!fresh && kept->second.path != page.path)
      return config_error(
          page.problem("id", "expected another id: " + kept->second.path + " has it"));
  }
  return {};
}

int LintRun::lint_one(const std::string& path) {
  auto job = std::make_unique<LintJob>();
  job->path = path;
  const auto config = config_of(options_.gate, path);
  if (!config) return usage(config.error());
  const auto rules = use_rules(config->rules);
  if (auto kept = keep_rules(config->rules); !kept) return usage(kept.error());
  const Geometry geometry = linting::geometry_of(options_, *config);
  if (geometry == Geometry::none && config->gated())
    return usage("the gate of " + config->path +
                 " needs geometry; leave out --no-geometry, or add --no-config");
  if (options_.accept && config->baseline.empty() && config->accepted.empty())
    return usage(path + ": " + (config->path.empty() ? "no .decklint.toml" : config->path) +
                 " names no baseline to accept it in: run 'deck gate --init'");
  // --accept does not compare with the old baseline.
  auto gate = options_.accept ? DeckGate{} : gate_of(options_.gate, *config, path, common_);
  if (!gate) return std::max(usage(gate.error()), gate_error_code(gate.error()));
  const auto lint = linting::lint_options(options_, *config, *job);
  if (!lint) return usage(lint.error());
  if (!common_.quiet) linting::note_renamed(*lint, renamed_);
  auto loaded = load(path, schemas_, common_);
  if (!loaded) {
    job->error = loaded.error().message;
    print_error(common_, job->error);
    job->code = reading_code(loaded.error());
  } else {
    job->loaded.emplace(std::move(*loaded));
    if (auto known = gate->find_changes(*job->loaded); !known) return usage(known.error());
    job->gate = std::move(*gate);
    if (options_.accept) {
      job->lint_baseline = config->baseline;
      if (!config->accepted.empty()) job->gaps.emplace(config->accepted, Baseline::Kind::gaps);
    }
    evaluate(*job, *lint, geometry);
    const std::string given = options_.gate.level();
    job->fail_on = !given.empty() ? given : !config->fail_on.empty() ? config->fail_on : "error";
    job->code = code_of(*job);
  }
  const int code = job->code;
  jobs_.push_back(std::move(job));
  return code;
}

/// Findings, verdict and gate.
void LintRun::evaluate(LintJob& job, const LintOptions& lint, Geometry geometry) {
  std::optional<ContactFacts> contacts;
  std::size_t too_large = 0;
  job.report.asked = job.gate.gate.any();
  job.result = lint_loaded(
      *job.loaded, lint, geometry, job.gate,
      [&](const Scene& scene, const SceneView& view) {
        contacts = contact_facts(scene, view);
        if (job.gaps) job.gaps->accept(job.path, scene, view);
        job.report.undecided = undecided_contacts(scene);
        if (!job.gate.earlier) return;
        job.report.earlier = &*job.gate.earlier;
        job.report.comparison = compare_gaps(*job.gate.earlier, scene, view);
      },
      &too_large);
  if (contacts) contacts->left_out = too_large;
  for (const Finding& d : job.result.findings)
    if (is_gate_rule(d.rule)) job.report.findings.push_back(d);
  job.gate.note_baseline(common_, job.path, job.report.comparison);
  if (!job.without_entries.empty() && !job.result.findings.empty())
    note_not_in_baseline(common_, job.path, job.without_entries, job.decks_with_entries);
  const auto& skipped = job.result.not_checked;
  const bool left_out = geometry != Geometry::none &&
                        std::any_of(skipped.begin(), skipped.end(),
                                    [](const NotChecked& n) { return n.what == geometry_rules; });
  job.verdict = lint_verdict(job.linted(), std::move(contacts), left_out);
}

int LintRun::code_of(const LintJob& job) const {
  const ExitRules rules{job.fail_on == "warning", job.fail_on == "never", common_.require_examined};
  int code = exit_clean;
  // The gate fails at any level.
  if (exit_code_of(*job.verdict, rules) != 0 || (job.report.asked && !job.report.passed()))
    code = exit_findings;
  code = std::max(code, examined_code(*job.loaded, common_));
  const bool unread = job.loaded->incomplete() || job.loaded->deck().begin.version_unread;
  return unread ? static_cast<int>(exit_input) : code;
}

/// Fixes requested by all decks. A fix of a shared file is made only if all of them request it.
Result<std::size_t> LintRun::collect_fixes(Changes& set, std::vector<FixResult>& results) {
  std::vector<FixedDeck> decks;
  std::vector<const LintJob*> jobs;
  for (const auto& job : jobs_)
    if (job->loaded) {
      decks.push_back({&job->loaded->deck().sources, &job->result.findings});
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
        return config_error(path +
                            " is included more than once and would become two different files; "
                            "nothing was written");
    }
    changed += files.size();
    set.propose(*member, deck, files);
  }
  constexpr std::size_t most = 10;
  for (std::size_t i = 0; i < std::min(most, agreed.withheld.size()) && !common_.quiet; ++i) {
    const WithheldFix& w = agreed.withheld[i];
    print_messages(
        fmt::format("{}: note: not fixed ({}): {} includes this file too and needs it unchanged\n",
                    terminal_text(jobs[w.deck]->loaded->deck().sources.where(w.finding->span)),
                    finding_name(*w.finding), terminal_text(jobs[w.other]->path)));
  }
  if (agreed.withheld.size() > most && !common_.quiet)
    print_note(
        fmt::format("{} more were not fixed for this reason", agreed.withheld.size() - most));
  return changed;
}

/// --diff prints what --fix would write. --fix writes each file once and lints again.
int LintRun::fixes() {
  int code = exit_clean;
  std::vector<FixResult> results;
  const auto changed = collect_fixes(changes_, results);
  if (!changed) return usage(changed.error());
  if (options_.diff) {
    const auto patch = changes_.diff();
    if (!patch) return usage(patch.error());
    print_contents(*patch);
  } else if (*changed > 0) {
    if (auto written = changes_.write(false); !written) return usage(written.error());
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

}  // namespace deck::cli
