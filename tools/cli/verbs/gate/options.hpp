// Gate options: bounds from the command line and from [gate] of the configuration, and the earlier
// run for comparison.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common.hpp"
#include "deck/contacts.hpp"
#include "deck/verdict.hpp"
#include "lint/shared/baseline.hpp"
#include "lint/shared/config.hpp"
#include "lint/shared/gate.hpp"
#include "report/shared/gate.hpp"

namespace deck::cli {

struct GateOptions {
  // Negative: not given.
  double max_depth = -1, max_ratio = -1, max_dt_loss = -1;
  int max_count = -1, max_untied = -1;
  std::vector<std::string> fail_on;  ///< words: new, worse, error, warning, never
  std::string compare;               ///< an earlier `deck gaps --json`, or "git:REV"
  std::string since;                 ///< git revision: findings are shown on lines changed since
  std::string baseline;              ///< accepted penetrations; `deck gaps` only
  std::string config;
  bool no_config = false;
  Session* session = nullptr;  ///< of the command line with these options
  /// Baselines read, by path.
  std::shared_ptr<std::map<std::string, Baseline>> baselines =
      std::make_shared<std::map<std::string, Baseline>>();
  bool fails_on(std::string_view word) const;
  /// error, warning or never; "": not given.
  std::string level() const;
  /// True if a bound or comparison was given.
  bool is_given() const;
};

/// Adds --max-depth, --max-ratio, --max-count, --max-untied, --max-dt-loss and --compare under a
/// heading.
void add_gate(CommandLine& line, GateOptions& options);
/// Also adds --fail-on, --config and --no-config. `error`, `warning`: their meaning, for the help.
void add_gate_with_config(CommandLine& line, GateOptions& options, const std::string& error,
                          const std::string& warning);
/// Error: an unknown word in --fail-on, or contradicting words.
Result<void> check_fail_on(const GateOptions& options);

/// The configuration of a deck: --config, or the nearest .decklint.toml.
Result<LintConfig> config_of(const GateOptions& options, const std::string& deck_path);

/// 0 or 1 by verdict and options, without gates.
int verdict_code(const Verdict& verdict, const GateOptions& options, const CommonOptions& common,
                 bool on_warning = false, bool pairs_accepted = false);

/// Bounds and comparison for one deck.
struct DeckGate {
  Gate gate;
  bool baseline = false;  ///< `earlier` is a baseline
  std::optional<GapBaseline> earlier;
  std::string since;     ///< git revision for changed lines; empty: none
  ChangedLines changed;  ///< set by find_changes()
  /// Gets the changed lines from git. Error: unknown revision.
  Result<void> find_changes(const LoadedDeck& loaded);
  /// Prints a note if results are new because the baseline has other decks.
  void note_baseline(const CommonOptions& options, const std::string& deck_path,
                     const GapsComparison& found) const;
  /// Evaluates the gate and adds findings to the deck. `forces` may be nullptr.
  GateReport evaluate(LoadedDeck& loaded, const Scene& scene, const SceneView& view,
                      const cycle::SceneOutcome* forces, const CommonOptions& common) const;
};
/// Exit code if the gate cannot be built: 3 for an unreadable base, else 2.
int gate_error_code(const Error& error);
/// Converts an absolute path to one in the git work tree.
std::string name_in_tree(const std::string& path);
/// Prints a note that a baseline has `held` and not this deck, so that everything is new.
void note_not_in_baseline(const CommonOptions& options, const std::string& deck_path,
                          const std::string& baseline, const std::vector<std::string>& held);
/// A baseline, read once per call.
Result<const Baseline*> baseline_at(const GateOptions& options, const std::string& path,
                                    Baseline::Kind kind);
/// A baseline to update: empty if there is no file or an earlier format (with a note).
Result<Baseline> baseline_to_change(const std::string& path, Baseline::Kind kind);
Result<DeckGate> gate_of(const GateOptions& options, const LintConfig& config,
                         const std::string& deck_path, const CommonOptions& common);
/// The gate of a deck with its configuration and changed lines; prints notes.
Result<DeckGate> gate_of(const GateOptions& options, const LoadedDeck& loaded,
                         const CommonOptions& common);

}  // namespace deck::cli
