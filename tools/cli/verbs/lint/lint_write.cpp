// Output of deck lint in all formats to files and terminal; baselines.
#include <fmt/format.h>

#include <algorithm>

#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "library.hpp"
#include "verbs/lint/lint_run.hpp"

namespace deck::cli {
namespace {

std::string lint_as(std::string_view format, const std::vector<LintedDeck>& decks,
                    const LintChoice& options, const SchemaSet& schemas, bool to_terminal) {
  if (format == "json") return lint_json(decks);
  if (format == "concise") return lint_concise(decks);
  // The git work tree of the current directory, else that directory.
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

}  // namespace

/// Reports unused entries of the baseline: each would hide a future finding.
void LintRun::report_stale() const {
  for (const auto& job : jobs_) {
    if (!job->loaded || job->result.stale.empty() || common_.quiet) continue;
    constexpr std::size_t most = 10;
    print_messages(fmt::format(
        "{}: note: {}; write it again with --write-baseline\n", terminal_text(job->path),
        count(job->result.stale.size(), "entry of the baseline no longer occurs",
              "entries of the baseline no longer occur")));
    std::size_t shown = 0;
    for (const auto& [key, n] : job->result.stale) {
      if (shown++ == most) break;
      const std::string rule = key.rule + (key.field.empty() ? "" : ":" + key.field);
      print_messages(fmt::format("  {} {}{}{}: {}\n", terminal_text(name_in_tree(key.file)),
                                 terminal_text(rule), key.entity.empty() ? "" : " ",
                                 terminal_text(key.entity), deck::count(n, "time", "times")));
    }
  }
}

std::vector<LintedDeck> LintRun::linted() const {
  std::vector<LintedDeck> out;
  for (const auto& job : jobs_) out.push_back(job->linted());
  return out;
}
std::string lint_text(const std::string& format, const LintJobs& jobs, const LintChoice& options,
                      const SchemaSet& schemas) {
  std::vector<LintedDeck> decks;
  for (const auto& job : jobs) decks.push_back(job->linted());
  return lint_as(format, decks, options, schemas, true);
}

LintedDeck LintJob::linted() const {
  return {path,   loaded ? &loaded->deck() : nullptr,       loaded ? &result : nullptr,
          error,  loaded ? &loaded->interfaces() : nullptr, nullptr,
          verdict};
}

/// `deck gate --accept`: replaces the entries of these decks in all baselines, or in none. `worst`:
/// exit code of reading and linting.
int LintRun::accept(int worst) {
  std::map<std::string, Baseline> files;
  const auto file = [&](const std::string& path, Baseline::Kind kind) -> Result<Baseline*> {
    if (const auto it = files.find(path); it != files.end()) return &it->second;
    auto read = baseline_to_change(path, kind);
    if (!read) return read.error();
    return &files.emplace(path, std::move(*read)).first->second;
  };
  std::uint64_t findings = 0;
  bool whole = worst < exit_usage;
  for (const auto& job : jobs_) {
    if (!job->loaded) continue;
    if (!job->lint_baseline.empty()) {
      const auto lint = file(job->lint_baseline, Baseline::Kind::lint);
      if (!lint) return usage(lint.error());
      (*lint)->accept(job->path, job->loaded->deck(), job->result);
      findings += job->result.findings.size();
    }
    if (!job->gaps) continue;
    const auto gaps = file(job->gaps->path(), Baseline::Kind::gaps);
    if (!gaps) return usage(gaps.error());
    (*gaps)->replace_deck(job->path, *job->gaps);
  }
  if (!whole) {
    print_error(common_, "nothing was accepted, because not every deck could be read");
    return worst;
  }
  std::vector<OutputFile> outputs;
  std::map<std::string, std::string> texts;
  std::string names;
  for (const auto& [path, baseline] : files) {
    outputs.push_back({path, texts[path] = baseline.text()});
    names += (names.empty() ? "" : ", ") + name_in_tree(path);
  }
  if (auto written = common_.session->write_outputs(outputs); !written)
    return usage(written.error());
  std::size_t undecided = 0;
  for (const auto& job : jobs_) undecided += job->report.undecided;
  if (!common_.quiet)
    print_lines(
        terminal_text(fmt::format(
            "Accepted as they are: {} ({}); wrote {}.{}", count(jobs_.size(), "deck", "decks"),
            count(findings, "finding of lint", "findings of lint"), names,
            undecided == 0 ? ""
                           : fmt::format(" {} could not be evaluated.",
                                         count(undecided, "contact", "contacts")))) +
        "\n");
  return undecided == 0 ? exit_clean : exit_findings;
}

int LintRun::write() {
  const auto decks = linted();
  int code = exit_clean;
  const auto put = [&](const std::string& file, const std::string& text) {
    if (auto written = common_.session->write_output(file, text); !written)
      code = std::max(code, usage(written.error()));
  };
  for (const std::string& o : options_.outputs) {
    const auto equal = o.find('=');
    put(o.substr(equal + 1),
        lint_as(o.substr(0, equal), decks, options_, schemas_, o.substr(equal + 1) == "-"));
  }
  if (!common_.json.empty() && !print_) put(common_.json, lint_json(decks));
  if (!options_.write_baseline.empty()) {
    auto baseline = baseline_to_change(options_.write_baseline, Baseline::Kind::lint);
    bool any = false;
    for (const auto& job : jobs_)
      if (baseline && job->loaded) {
        baseline->accept(job->path, job->loaded->deck(), job->result);
        any = true;
      }
    if (!baseline)
      code = std::max(code, usage(baseline.error()));
    else if (any)
      put(options_.write_baseline, baseline->text());
  }
  report_stale();
  if (print_) return std::max(code, print_(jobs_, schemas_));
  print(decks);
  return code;
}

void LintRun::print(const std::vector<LintedDeck>& decks) const {
  // --json - and -o FORMAT=- use standard output.
  const bool taken = common_.json == "-" || options_.diff ||
                     std::any_of(options_.outputs.begin(), options_.outputs.end(),
                                 [](const std::string& o) { return o.ends_with("=-"); });
  if (!taken && !(common_.quiet && options_.format == "human")) {
    const std::string text = lint_as(options_.format, decks, options_, schemas_, true);
    options_.format == "human" ? print_lines(text) : print_text(text);
  } else if (options_.diff && !common_.quiet)
    print_messages(lint_as("human", decks, options_, schemas_, false));
}

}  // namespace deck::cli
