// A run of lint over decks, for the verbs that lint: findings of every deck with its geometry and
// gate, fixes, outputs in every format.
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
  bool accept = false;  ///< write what is there into the baselines of the configuration
  WriteFlags write;
  int per_rule = -1;  ///< not given: 10, or all with -v
};

/// What --format and -o take.
inline constexpr std::initializer_list<const char*> lint_formats = {
    "human", "concise", "json", "sarif", "github", "junit", "gitlab"};

/// How much of the geometry is looked at.
enum class Geometry : std::uint8_t { none, quick, all };

/// Called with the contacts while they are there.
using SeenContacts = std::function<void(const Scene&, const SceneView&)>;

/// Lints one deck, holds it against the gate, and frees its scene. `too_large`: as in
/// GeometryOptions.
LintResult lint_loaded(LoadedDeck& loaded, const LintOptions& options, Geometry geometry,
                       const DeckGate& gate, const SeenContacts& seen,
                       std::size_t* too_large = nullptr);

/// One deck of the run, kept until everything is written.
struct LintJob {
  std::string path, error;
  std::optional<LoadedDeck> loaded;
  LintResult result;
  std::optional<Verdict> verdict;
  /// A baseline of lint that has nothing of this deck, and of which decks it has.
  std::string without_entries;
  std::vector<std::string> decks_with_entries;
  std::string lint_baseline;     ///< to accept the findings in; empty: none
  std::optional<Baseline> gaps;  ///< what is to be accepted of the contacts
  DeckGate gate;
  GateReport report;    ///< what the gate said; refers to `gate`
  std::string fail_on;  ///< error, warning or never
  int code = exit_clean;

  LintedDeck linted() const;
};
using LintJobs = std::vector<std::unique_ptr<LintJob>>;

/// All of them in a format that is no text for people.
std::string lint_text(const std::string& format, const LintJobs& jobs, const LintChoice& options,
                      const SchemaSet& schemas);

class LintRun {
 public:
  /// Prints the results on standard output, and writes the document of --json; returns the exit
  /// code of writing.
  using Print = std::function<int(const LintJobs&, const SchemaSet&)>;

  /// Without `print` the results are printed as lint prints them.
  explicit LintRun(const LintChoice& options, Print print = {})
      : options_(options),
        common_(options.common),
        changes_(options.common, options.write),
        print_(std::move(print)) {}

  int run();
  /// True if decks were rewritten, and the exit code of those that they have become.
  bool relinted() const { return relint_; }
  int after_fix() const { return after_fix_; }
  const LintJobs& jobs() const { return jobs_; }

 private:
  int usage(const std::string& message) const { return failed(common_, message); }
  int usage(const Error& error) const { return failed(common_, error); }
  int none_changed() const;
  int prepare();
  int lint_one(const std::string& path);
  Result<void> keep_rules(const std::vector<RulePage>& of_deck);
  void look(LintJob& job, const LintOptions& lint, Geometry geometry);
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
  std::set<std::string> renamed_;     ///< selectors of which it was said
  bool relint_ = false;
  int after_fix_ = exit_clean;
};

// ---- the settings of lint and of the gate: what holds for a deck and where it comes from, and a
// file to begin with

/// What the command line says.
struct GivenSettings {
  std::vector<std::string> select, ignore;
  std::string baseline, rules;
  GateOptions gate;
  std::optional<bool> geometry;  ///< --geometry, --no-geometry
};

/// Every setting, its value and its origin: an option, a line of the configuration, or the default.
std::string settings_text(const LintConfig& config, const GivenSettings& given);

/// Writes .decklint.toml into a directory that has none. Error: there is one, or it cannot be
/// written. Returns its path.
Result<std::string> write_settings_file(const std::string& directory);

}  // namespace deck::cli
