// The gate on the command line: bounds for contacts, from options and from [gate] of the
// configuration, and the earlier run to compare with.
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
  // Below zero: not given.
  double max_depth = -1, max_ratio = -1, max_dt_loss = -1;
  int max_count = -1, max_untied = -1;
  std::vector<std::string> fail_on;  ///< words: new, worse, error, warning, never
  std::string compare;               ///< an earlier `deck gaps --json`, or "git:REV"
  std::string since;                 ///< git revision: findings stand on lines changed since
  std::string baseline;              ///< accepted penetrations; of `deck gaps` alone
  std::string config;
  bool no_config = false;
  Session* session = nullptr;  ///< of the command line that they were added to
  /// Those that were read, by path.
  std::shared_ptr<std::map<std::string, Baseline>> baselines =
      std::make_shared<std::map<std::string, Baseline>>();

  bool fails_on(std::string_view word) const;
  /// error, warning or never; "" if none was given.
  std::string level() const;
  /// True if a bound or a comparison is on the command line.
  bool given() const;
};

/// Adds --max-depth, --max-ratio, --max-count, --max-untied, --max-dt-loss and --compare under a
/// heading.
void add_gate(CommandLine& line, GateOptions& options);
/// Adds --fail-on, --config and --no-config as well, for verbs that do not have them for
/// themselves. `error` and `warning` say in the help what these words stop at.
void add_gate_with_config(CommandLine& line, GateOptions& options, const std::string& error,
                          const std::string& warning);
/// Error: --fail-on has another word, or words that contradict one another.
Result<void> check_fail_on(const GateOptions& options);

/// The configuration that holds for a deck: --config, or the nearest .decklint.toml.
Result<LintConfig> config_of(const GateOptions& options, const std::string& deck_path);

/// 0 or 1: what the verdict and the options say. Gates come on top of it.
int verdict_code(const Verdict& verdict, const GateOptions& options, const CommonOptions& common,
                 bool on_warning = false, bool pairs_accepted = false);

/// What holds for one deck: the bounds, and what the deck is compared with.
struct DeckGate {
  Gate gate;
  bool baseline = false;  ///< `earlier` is what was accepted
  std::optional<GapBaseline> earlier;
  std::string since;     ///< git revision whose changes findings are shown at; empty: none
  ChangedLines changed;  ///< of find_changes()

  /// Asks git for the lines of the deck that changed. Error: it knows no such revision.
  Result<void> find_changes(const LoadedDeck& loaded);
  /// Says so where something is new because the baseline is one of other decks.
  void note_baseline(const CommonOptions& options, const std::string& deck_path,
                     const GapsComparison& found) const;
  /// Looks, and adds what it finds to the deck's findings. `forces` may be nullptr.
  GateReport look(LoadedDeck& loaded, const Scene& scene, const SceneView& view,
                  const cycle::SceneOutcome* forces, const CommonOptions& common) const;
};
/// The exit code of a gate that cannot be formed: 3 if the base could not be read, else 2.
int gate_error_code(const Error& error);
/// An absolute path, such as one of a configuration, as it is called in the git work tree.
std::string name_in_tree(const std::string& path);
/// Says that a baseline holds nothing of a deck, but of `held`, so that everything counts as new.
void note_not_in_baseline(const CommonOptions& options, const std::string& deck_path,
                          const std::string& baseline, const std::vector<std::string>& held);
/// A baseline, read once for all decks of a call.
Result<const Baseline*> baseline_at(const GateOptions& options, const std::string& path,
                                    Baseline::Kind kind);
/// A baseline whose entries of some decks are to be replaced: without any where there is no file,
/// or one of an earlier form, which is said.
Result<Baseline> baseline_to_change(const std::string& path, Baseline::Kind kind);
Result<DeckGate> gate_of(const GateOptions& options, const LintConfig& config,
                         const std::string& deck_path, const CommonOptions& common);
/// The same by the configuration of the deck, with the lines that changed; what is to be noted is.
Result<DeckGate> gate_of(const GateOptions& options, const LoadedDeck& loaded,
                         const CommonOptions& common);

}  // namespace deck::cli
