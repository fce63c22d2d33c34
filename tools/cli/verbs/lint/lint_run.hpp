// A lint run over decks: findings with geometry and gate, fixes, outputs in all formats.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "changes.hpp"
#include "common.hpp"
#include "deck/lint.hpp"
#include "lint/shared/fix.hpp"
#include "report/shared/findings.hpp"
#include "report/shared/gate.hpp"
#include "verbs/gate/options.hpp"

namespace deck::cli {

struct LintChoice {
  CommonOptions common;
  std::string format = "human";
  std::vector<std::string> outputs;  ///< format=file
  std::vector<std::string> select, ignore;
  std::string baseline, write_baseline;
  GateOptions gate;
  bool geometry = false, no_geometry = false, fix = false, unsafe_fixes = false, diff = false,
       ruler = false;
  bool changed = false, init = false, show_config = false, statistics = false;
  bool accept = false;  ///< write current findings into the configured baselines
  WriteFlags write;
  int per_rule = -1;  ///< -1: 10, or all with -v
};

/// Values of --format and -o.
inline constexpr std::initializer_list<const char*> lint_formats = {
    "human", "concise", "json", "sarif", "github", "junit", "gitlab"};

/// Extent of the geometry checks.
enum class Geometry : std::uint8_t { none, quick, all };

/// Called with the contacts before they are freed.
using SeenContacts = std::function<void(const Scene&, const SceneView&)>;

/// Lints one deck, evaluates the gate, and frees the scene. `too_large`: as in GeometryOptions.
LintResult lint_loaded(LoadedDeck& loaded, const LintOptions& options, Geometry geometry,
                       const DeckGate& gate, const SeenContacts& seen,
                       std::size_t* too_large = nullptr);

/// One deck of the run, kept until all output is written.
struct LintJob {
  std::string path, error;
  std::optional<LoadedDeck> loaded;
  LintResult result;
  std::optional<Verdict> verdict;
  /// Lint baseline without entries of this deck, and the decks that it has.
  std::string without_entries;
  std::vector<std::string> decks_with_entries;
  std::string lint_baseline;     ///< baseline for accepted findings; empty: none
  std::optional<Baseline> gaps;  ///< accepted penetrations
  DeckGate gate;
  GateReport report;    ///< result of the gate; refers to `gate`
  std::string fail_on;  ///< error, warning or never
  int code = exit_clean;

  LintedDeck linted() const;
};
using LintJobs = std::vector<std::unique_ptr<LintJob>>;

/// All decks in a machine-readable format.
std::string lint_text(const std::string& format, const LintJobs& jobs, const LintChoice& options,
                      const SchemaSet& schemas);

/// Says that no deck has the files of --changed.
int none_changed(const CommonOptions& common);

class LintRun {
 public:
  /// Prints the results on standard output and writes the document of --json; returns the exit
  /// code.
  using Print = std::function<int(const LintJobs&, const SchemaSet&)>;

  /// Without `print` the output of deck lint is used.
  explicit LintRun(const LintChoice& options, Print print = {})
      : options_(options),
        common_(options.common),
        changes_(options.common, options.write),
        print_(std::move(print)) {}

  int run();
  /// True if decks were rewritten; exit code of the rewritten decks.
  bool relinted() const { return relint_; }
  int after_fix() const { return after_fix_; }
  const LintJobs& jobs() const { return jobs_; }

 private:
  int usage(const std::string& message) const { return failed(common_, message); }
  int usage(const Error& error) const { return failed(common_, error); }
  int prepare();
  int lint_one(const std::string& path);
  Result<void> keep_rules(const std::vector<RulePage>& of_deck);
  void evaluate(LintJob& job, const LintOptions& lint, Geometry geometry);
  int code_of(const LintJob& job) const;
  Result<std::size_t> collect_fixes(Changes& set, std::vector<FixResult>& results);
  int fixes();
  void report_stale() const;
  int accept(int worst);
  std::vector<LintedDeck> linted() const;
  int write();
  void print(const std::vector<LintedDeck>& decks) const;

  const LintChoice& options_;
  const CommonOptions& common_;
  Changes changes_;
  Print print_;
  LoadedSchemas schemas_;
  LintJobs jobs_;
  std::map<RuleId, RulePage> rules_;  ///< of the configurations of all decks
  std::set<std::string> renamed_;     ///< selectors with a printed note
  bool relint_ = false;
  int after_fix_ = exit_clean;
};

// ---- settings of lint and gate for a deck, and their origins; a new settings file

/// Settings on the command line.
struct GivenSettings {
  std::vector<std::string> select, ignore;
  std::string baseline, rules;
  GateOptions gate;
  std::optional<bool> geometry;  ///< --geometry, --no-geometry
};

/// Every setting with value and origin: an option, a line of the configuration, or the default.
std::string settings_text(const LintConfig& config, const GivenSettings& given);

/// Writes .decklint.toml into a directory and returns its path. Error: it exists or cannot be
/// written.
Result<std::string> write_settings_file(const std::string& directory);

}  // namespace deck::cli
