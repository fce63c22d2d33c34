// Bounds from options and configuration, and the earlier run for comparison.
#include "verbs/gate/options.hpp"

#include <algorithm>
#include <climits>
#include <filesystem>
#include <utility>

#include "base/shared/paths.hpp"
#include "deck/report.hpp"
#include "library.hpp"
#include "lint/shared/config.hpp"
#include "verbs/git_deck.hpp"

namespace deck::cli {
namespace {

constexpr std::uint64_t most_compared_bytes = std::uint64_t{256} << 20;

void set(std::optional<double>& bound, double given) {
  if (given >= 0) bound = given;
}

Result<GapBaseline> read_earlier(Session& session, const std::string& path,
                                 const std::string& deck_path, bool given) {
  const auto text = read_config_file(path, most_compared_bytes);
  if (!text) return text.error();
  session.remember_read(path);
  return read_earlier_gaps(given ? path : name_in_tree(path), *text, deck_path);
}

/// The deck at a git revision.
Result<GapBaseline> earlier_revision(const std::string& compare, const std::string& deck_path,
                                     const CommonOptions& common) {
  const auto text = gaps_at_revision(compare.substr(git_prefix.size()), deck_path, common);
  if (!text) return text.error();
  return read_earlier_gaps(compare, *text, deck_path);
}

}  // namespace

Result<const Baseline*> baseline_at(const GateOptions& o, const std::string& path,
                                    Baseline::Kind kind) {
  if (const auto known = o.baselines->find(path); known != o.baselines->end())
    return &known->second;
  const auto text = read_config_file(path, most_baseline_bytes);
  if (!text) return text.error();
  o.session->remember_read(path);
  auto parsed = Baseline::parse(*text, path, kind);
  if (!parsed) return parsed.error();
  return &o.baselines->emplace(path, std::move(*parsed)).first->second;
}

Result<Baseline> baseline_to_change(const std::string& path, Baseline::Kind kind) {
  std::error_code ec;
  if (path == "-" || !std::filesystem::is_regular_file(path, ec)) return Baseline(path, kind);
  const auto text = read_config_file(path, most_baseline_bytes);
  if (!text) return text.error();
  if (!Baseline::is_of_earlier_form(*text)) return Baseline::parse(*text, path, kind);
  print_note(path + " has an earlier form: only what is accepted now will be in it");
  return Baseline(path, kind);
}

std::string name_in_tree(const std::string& path) {
  namespace fs = std::filesystem;
  if (!path.starts_with('/')) return path;
  const fs::path inside = fs::path(normal_path(path)).lexically_relative(library_root(path));
  return inside.empty() || *inside.begin() == ".." ? path : inside.generic_string();
}

bool GateOptions::fails_on(std::string_view word) const {
  return std::find(fail_on.begin(), fail_on.end(), word) != fail_on.end();
}

std::string GateOptions::level() const {
  for (const char* word : {"error", "warning", "never"})
    if (fails_on(word)) return word;
  return "";
}

bool GateOptions::is_given() const {
  return max_depth >= 0 || max_ratio >= 0 || max_dt_loss >= 0 || max_count >= 0 ||
         max_untied >= 0 || !compare.empty() || !baseline.empty() || fails_on("new") ||
         fails_on("worse");
}

void add_gate(CommandLine& line, GateOptions& o) {
  o.session = &line.session();
  CommandLine gate = line.group("Gate (exit 1 beyond it; also [gate] in .decklint.toml)");
  gate.option("--max-depth X", o.max_depth, "Deepest penetration, in the deck's units")
      .number(0, 1e300);
  gate.option("--max-ratio R", o.max_ratio,
              "Largest share of the gap that is penetrated: 0.3 is 30 %")
      .number(0, 1);
  gate.option("--max-count N", o.max_count, "Penetrating nodes and edges of the deck, each once")
      .range(0, INT_MAX);
  gate.option("--max-untied N", o.max_untied,
              "Nodes of /INTER/TYPE2 in the deck that are not tied, each once")
      .range(0, INT_MAX);
  gate.option("--max-dt-loss R", o.max_dt_loss,
              "Share of the mesh's time step that a contact may take away")
      .number(0, 1);
  gate.option(
      "--compare FILE", o.compare,
      "An earlier 'deck gaps --json' FILE, or git:REV, the deck at that git revision: lists "
      "what is new, worse, better, solved; with --fail-on new,worse these exit with 1");
  gate.option(
      "--since REV", o.since,
      "A git revision: report each finding at the line that changed since (node or card), so "
      "that GitHub or GitLab shows it in the review; default: that of --compare git:REV");
}

void add_gate_with_config(CommandLine& line, GateOptions& o, const std::string& error,
                          const std::string& warning) {
  add_gate(line, o);
  line.option("--fail-on WORDS", o.fail_on,
              "When to exit with 1, by commas: error (" + error + "; default), warning (" +
                  warning + "), never, and new, worse (with --compare)")
      .comma_list();
  line.option("--config FILE", o.config,
              "Use FILE instead of looking for .decklint.toml, also for [gate]");
  line.flag("--no-config", o.no_config, "Use no configuration file");
}

Result<void> check_fail_on(const GateOptions& o) {
  std::size_t levels = 0;
  for (const std::string& word : o.fail_on) {
    const bool level = word == "error" || word == "warning" || word == "never";
    levels += level;
    if (!level && word != "new" && word != "worse")
      return config_error("--fail-on: '" + word +
                          "' is not one of new, worse, error, warning, never");
  }
  if (levels > 1) return config_error("--fail-on takes one of error, warning and never");
  return {};
}

Result<LintConfig> config_of(const GateOptions& o, const std::string& deck_path) {
  if (o.no_config) return LintConfig{};
  if (o.config.empty()) {
    auto found = find_lint_config(deck_path);
    if (found && !found->path.empty()) o.session->remember_read(found->path);
    return found;
  }
  const auto text = read_config_file(o.config, most_config_bytes);
  if (!text) return text.error();
  o.session->remember_read(o.config);
  return parse_lint_config(*text, o.config);
}

Result<DeckGate> gate_of(const GateOptions& o, const LintConfig& config,
                         const std::string& deck_path, const CommonOptions& common) {
  DeckGate out;
  out.gate = config.gate;
  set(out.gate.general.max_depth, o.max_depth);
  set(out.gate.general.max_ratio, o.max_ratio);
  set(out.gate.general.max_dt_loss, o.max_dt_loss);
  if (o.max_count >= 0) out.gate.general.max_count = static_cast<std::uint64_t>(o.max_count);
  if (o.max_untied >= 0) out.gate.general.max_untied = static_cast<std::uint64_t>(o.max_untied);
  out.gate.on_fresh |= o.fails_on("new");
  out.gate.on_worse |= o.fails_on("worse");
  // Options override both keys of the configuration.
  const bool given = !o.compare.empty() || !o.baseline.empty();
  const std::string& compare = given ? o.compare : config.compare;
  const std::string& accepted = given ? o.baseline : config.accepted;
  out.since = o.since;
  if (out.since.empty() && compare.starts_with(git_prefix))
    out.since = compare.substr(git_prefix.size());
  if (!compare.empty() && !accepted.empty())
    return config_error("a baseline and an earlier run to compare with exclude each other: " +
                        accepted + " and " + compare);
  if (!accepted.empty()) {
    const auto known = baseline_at(o, accepted, Baseline::Kind::gaps);
    if (!known) return known.error();
    auto read = (*known)->gaps_of(deck_path);
    if (!read) return read.error();
    if (!given) read->path = name_in_tree(accepted);
    out.earlier = std::move(*read);
    out.baseline = out.gate.on_fresh = out.gate.on_worse = true;
  } else if (!compare.empty()) {
    auto read = compare.starts_with(git_prefix)
                    ? earlier_revision(compare, deck_path, common)
                    : read_earlier(*o.session, compare, deck_path, given);
    if (!read) return read.error();
    out.earlier = std::move(*read);
  } else if (out.gate.on_fresh || out.gate.on_worse) {
    return config_error(
        "new and worse need an earlier run: --compare FILE, or 'compare' in [gate], with "
        "an earlier 'deck gaps --json'");
  }
  return out;
}

Result<DeckGate> gate_of(const GateOptions& o, const LoadedDeck& loaded,
                         const CommonOptions& common) {
  const auto config = config_of(o, loaded.path());
  if (!config) return config.error();
  auto gate = gate_of(o, *config, loaded.path(), common);
  if (!gate) return gate;
  if (auto known = gate->find_changes(loaded); !known) return known.error();
  return gate;
}

void note_not_in_baseline(const CommonOptions& options, const std::string& deck_path,
                          const std::string& baseline, const std::vector<std::string>& held) {
  if (options.quiet) return;
  constexpr std::size_t most = 5;
  std::string names;
  for (std::size_t i = 0; i < std::min(held.size(), most); ++i)
    names += (i == 0 ? "" : ", ") + held[i];
  if (held.size() > most) names += " and " + std::to_string(held.size() - most) + " more";
  print_messages(terminal_text(deck_path + ": note: " + name_in_tree(baseline) +
                               " has no entry for this deck" +
                               (held.empty() ? "" : ", but of " + names) +
                               ": everything counts as new") +
                 "\n");
}

void DeckGate::note_baseline(const CommonOptions& options, const std::string& deck_path,
                             const GapsComparison& found) const {
  if (baseline && earlier && earlier->deck_path.empty() &&
      found.count(Trend::added) + found.lost_ties.size() > 0)
    note_not_in_baseline(options, deck_path, earlier->path, earlier->decks);
}

Result<void> DeckGate::find_changes(const LoadedDeck& loaded) {
  if (since.empty()) return {};
  auto lines = changed_lines(since, loaded);
  if (!lines) return lines.error();
  changed = std::move(*lines);
  return {};
}

GateReport DeckGate::evaluate(LoadedDeck& loaded, const Scene& scene, const SceneView& view,
                              const cycle::SceneOutcome* forces,
                              const CommonOptions& common) const {
  GateReport report =
      gate_report(gate, scene, view, forces, earlier ? &*earlier : nullptr, &changed);
  stand_at_changes(report.findings, loaded.deck().sources, changed);
  for (const Finding& d : report.findings) loaded.report(d);
  note_baseline(common, loaded.path(), report.comparison);
  return report;
}

int gate_error_code(const Error& error) {
  return error.code == Error::Code::io ? exit_input : exit_usage;
}

int verdict_code(const Verdict& verdict, const GateOptions& options, const CommonOptions& common,
                 bool on_warning, bool pairs_accepted) {
  ExitRules rules;
  rules.on_warning = on_warning || options.fails_on("warning");
  rules.never = options.fails_on("never");
  rules.require_examined = common.require_examined;
  rules.pairs_accepted = pairs_accepted;
  return exit_code_of(verdict, rules);
}

}  // namespace deck::cli
