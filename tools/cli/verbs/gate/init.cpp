// deck gate --init: writes settings, baselines and a workflow for a repository, and prints gate
// results for the last commits of a deck, each compared with the one before.
#include "verbs/gate/init.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "base/shared/embedded.hpp"
#include "base/shared/paths.hpp"
#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "deck/report.hpp"
#include "library.hpp"
#include "lint/shared/config.hpp"
#include "report/shared/json.hpp"
#include "report/shared/text_table.hpp"
#include "verbs/git_deck.hpp"
#include "verbs/lint/lint_run.hpp"

namespace deck::cli {

namespace writing_gate {
namespace {

namespace fs = std::filesystem;

/// A deck at a commit.
struct State {
  std::map<std::pair<RuleId, std::string>, std::size_t> errors;  ///< by rule and fingerprint
  GapBaseline gaps;
};

/// Gate result of a commit.
struct CommitRow {
  Commit commit;
  bool stopped = false, known = true;
  std::string why;
};

class Past {
 public:
  Past(const std::string& deck, const CommonOptions& common, const SchemaSet& schemas)
      : deck_(deck), common_(common), schemas_(schemas) {}

  /// Call it from the oldest commit to the newest.
  CommitRow evaluate(const Commit& commit) {
    CommitRow row;
    row.commit = commit;
    const auto unknown = [&](std::string why) {
      row.known = false;
      row.why = std::move(why);
      before_.reset();
      return row;
    };
    const auto old = git_deck(commit.name, deck_);
    if (!old) return unknown("it did not have the deck");
    auto loaded = load(old->path, schemas_, common_, Stage::interfaces, &old->files);
    if (!loaded) return unknown("it cannot be read");
    DeckGate gate;
    gate.gate.on_fresh = gate.gate.on_worse = true;
    if (before_) gate.earlier = before_->gaps;
    std::string document;
    GapsComparison compared;
    const LintResult result =
        lint_loaded(*loaded, {}, Geometry::all, gate, [&](const Scene& scene, const SceneView& v) {
          document = gaps_json(loaded->path(), loaded->deck(), scene, v, false);
          if (gate.earlier) compared = compare_gaps(*gate.earlier, scene, v);
        });
    State now;
    for (std::size_t i = 0; i < result.findings.size(); ++i)
      if (const Finding& d = result.findings[i];
          d.severity == Severity::error && !is_gate_rule(d.rule))
        ++now.errors[{d.rule, result.fingerprints[i]}];
    if (!document.empty())
      if (auto gaps = read_earlier_gaps(loaded->path(), document, loaded->path()))
        now.gaps = std::move(*gaps);
    if (before_)
      judge(result, compared, now, row);
    else
      unknown("nothing before it to compare with");
    if (loaded->incomplete()) {
      row.known = false;
      row.why = "an include is missing";
    }
    before_ = std::move(now);
    return row;
  }

 private:
  void judge(const LintResult& result, const GapsComparison& compared, const State& now,
             CommitRow& row) const {
    std::vector<std::string> words;
    if (const std::uint64_t n = compared.count(Trend::added); n > 0)
      words.push_back(fmt::format("{} new", n));
    if (const std::uint64_t n = compared.count(Trend::worse); n > 0)
      words.push_back(fmt::format("{} worse", n));
    std::size_t lost = 0;
    for (const auto& [inter, nodes] : compared.lost_ties) lost += nodes.size();
    if (lost > 0) words.push_back(fmt::format("{} not tied any more", lost));
    std::map<RuleId, std::size_t> fresh;
    for (const auto& [key, n] : now.errors) {
      const auto it = before_->errors.find(key);
      const std::size_t had = it == before_->errors.end() ? 0 : it->second;
      if (n > had) fresh[key.first] += n - had;
    }
    for (const auto& [rule, n] : fresh)
      words.push_back(std::string(id_text(rule)) + (n > 1 ? fmt::format(" {} times", n) : ""));
    row.stopped =
        !fresh.empty() || std::any_of(result.counts.begin(), result.counts.end(),
                                      [](const auto& c) { return is_gate_rule(c.first); });
    row.why = fmt::format("{}", fmt::join(words, ", "));
  }

  std::string deck_;
  const CommonOptions& common_;
  const SchemaSet& schemas_;
  std::optional<State> before_;
};

std::string table(const std::string& deck, const std::vector<CommitRow>& rows,
                  const CommonOptions& common) {
  TextTable table({{"commit"}, {"date"}, {"gate"}, {"why"}, {"subject"}});
  std::size_t stopped = 0, known = 0;
  for (const CommitRow& row : rows) {
    known += row.known;
    stopped += row.stopped;
    const TextTable::Cell verdict = !row.known    ? TextTable::Cell("-")
                                    : row.stopped ? TextTable::Cell("stopped", Tone::red)
                                                  : TextTable::Cell("passed", Tone::green);
    table.row({row.commit.name, row.commit.date, verdict, row.why, row.commit.subject});
  }
  const std::string verdict =
      known == 0 ? fmt::format("The gate cannot look back at {}:\n", terminal_text(deck))
                 : fmt::format(
                       "The gate would have stopped {} of the last {} of {}, compared with the "
                       "one before:\n",
                       stopped, count(known, "commit", "commits"), terminal_text(deck));
  return verdict + table.fitted(text_width(), common.color_on(1), 2);
}

/// Table of gate results for the last commits of a deck; empty: fewer than two commits. Error: not
/// in a git work tree.
Result<std::string> gate_history(const LoadedDeck& loaded, std::size_t commits,
                                 const CommonOptions& common) {
  const std::string root = library_root(loaded.path());
  // One more commit, to compare the oldest with.
  const auto past = commits_of(root, files_in_tree(loaded, root), commits + 1);
  if (!past) return past.error();
  if (past->size() < 2) return std::string();
  Past states(loaded.path(), common, loaded.schemas());
  std::vector<CommitRow> rows;
  Progress progress(!common.quiet);
  progress.step("commits");
  for (std::size_t i = past->size(); i-- > 0;) {
    rows.insert(rows.begin(), states.evaluate((*past)[i]));
    progress.update(past->size() - i, past->size());
  }
  if (rows.size() > commits) rows.pop_back();
  return table(loaded.path(), rows, common);
}

// ---- what is written

constexpr std::string_view config_name = ".decklint.toml", lint_name = "lint-baseline.json",
                           gaps_name = "gaps-baseline.json";

std::string config_text() {
  std::string out =
      "# The gate of the decks below this directory: 'deck gate' stops at what is not in the two\n"
      "# baselines. 'deck lint --init' elsewhere shows every key that may stand here.\n"
      "# Accepted findings of lint; 'deck gate --accept DECK' writes both baselines again:\n"
      "baseline = \"" +
      std::string(lint_name) +
      "\"\n\n[gate]\n"
      "# Accepted penetrations: new and deeper ones stop.\n"
      "baseline = \"" +
      std::string(gaps_name) + "\"\n";
  for (const ConfigKey& k : config_keys())
    if (k.table == "gate" && k.key.starts_with("max-"))
      out += fmt::format("# {}\n# {} = {}\n", k.meaning, k.key, k.example);
  return out;
}

std::string package() { return "./tools/libdeck_" + std::string(library_version()) + "_amd64.deb"; }

/// A workflow for these decks (shell words, each after a blank).
std::string filled(std::string_view workflow, const std::string& decks) {
  std::string out(workflow);
  for (const auto& [mark, text] : {std::pair{"@PACKAGE@", package()}, {"@DECKS@", decks}})
    for (auto at = out.find(mark); at != out.npos; at = out.find(mark, at + text.size()))
      out.replace(at, std::strlen(mark), text);
  return out;
}

/// Forge by files of the repository, else by its remotes.
std::string forge_of(const std::string& root) {
  std::error_code ec;
  if (fs::exists(fs::path(root) / ".gitlab-ci.yml", ec) ||
      fs::exists(fs::path(root) / ".gitlab", ec))
    return "gitlab";
  if (fs::exists(fs::path(root) / ".github", ec)) return "github";
  const auto config = read_config_file((fs::path(root) / ".git" / "config").string(), 1 << 20);
  return config && config->find("gitlab") != config->npos ? "gitlab" : "github";
}

/// The decks with their accepted findings.
struct Today {
  std::vector<LoadedDeck> decks;
  Baseline lint, gaps;
  std::uint64_t errors = 0;
  std::size_t penetrating = 0;
};

/// Reads and lints all decks. Returns exit_clean, or another code after an error message.
int lint_all(const CommonOptions& common, const SchemaSet& schemas, Today& out) {
  for (const std::string& path : common.decks) {
    auto loaded = load(path, schemas, common);
    if (!loaded || loaded->incomplete()) {
      if (loaded) print_findings(*loaded, common);
      return failed(common,
                    (loaded ? path + ": an include is missing" : loaded.error().message) +
                        "; nothing was written",
                    exit_input);
    }
    const LintResult result =
        lint_loaded(*loaded, {}, Geometry::all, {}, [&](const Scene& scene, const SceneView& view) {
          out.gaps.accept(path, scene, view);
          out.penetrating += view.deepest_per_node.size();
        });
    out.lint.accept(path, loaded->deck(), result);
    out.errors += result.errors;
    out.decks.push_back(std::move(*loaded));
  }
  return exit_clean;
}

/// A file to write.
struct NewFile {
  std::string path, text;
};

std::vector<NewFile> files_of(const Today& today, const fs::path& root, const std::string& forge,
                              const std::string& decks) {
  const bool github = forge == "github";
  return {{(root / config_name).string(), config_text()},
          {today.lint.path(), today.lint.text()},
          {today.gaps.path(), today.gaps.text()},
          {(root / (github ? ".github/workflows/deck-gate.yml" : ".gitlab/deck-gate.yml")).string(),
           filled(detail::embedded_workflows()[github ? 0 : 1].text, decks)}};
}

/// The arguments as shell words relative to the work tree. Error: a name that a workflow cannot
/// contain or a forge would evaluate.
Result<std::string> decks_in_tree(const std::vector<std::string>& given, const std::string& root) {
  std::string out;
  for (const std::string& path : given) {
    std::string inside = fs::path(absolute_path(path)).lexically_relative(root).generic_string();
    if (inside == ".") continue;
    if (terminal_text(inside) != inside || inside.find("${{") != inside.npos ||
        inside.find("$[[") != inside.npos)
      return config_error(path +
                          ": a workflow cannot hold this name; rename it, or "
                          "give the folder above it");
    if (inside.starts_with('-')) inside.insert(0, "./");
    out += " " + shell_word(inside);
  }
  return out;
}

/// Error for links that leave the work tree, and for paths that are not files.
Result<void> check_places(const std::vector<NewFile>& files, const fs::path& root, bool overwrite) {
  for (const NewFile& f : files) {
    std::error_code ec;
    const fs::file_type own = fs::symlink_status(f.path, ec).type(),
                        behind = fs::status(f.path, ec).type();
    const fs::path real =
        fs::weakly_canonical(f.path, ec).lexically_relative(fs::weakly_canonical(root, ec));
    if (real.empty() || *real.begin() == ".." ||
        (own == fs::file_type::symlink && behind == fs::file_type::not_found))
      return config_error(f.path +
                          " is a link that leads out of the work tree, or "
                          "nowhere; nothing was written");
    if (behind != fs::file_type::regular && behind != fs::file_type::not_found)
      return config_error(f.path + " is no regular file; nothing was written");
    if (!overwrite && own != fs::file_type::not_found)
      return config_error(f.path +
                          " is there already; nothing was written (--overwrite replaces it, with "
                          "all that --init writes)");
  }
  return {};
}

/// Lists decks outside of the reach of the settings at the top of the work tree.
std::string unreached_text(const std::vector<std::string>& decks, const fs::path& root) {
  std::map<std::string, std::size_t> nearer;
  for (const std::string& deck : decks)
    if (const auto config = find_lint_config(deck);
        !config || fs::path(config->path).parent_path() != root)
      ++nearer[config ? config->path : config.error().message];
  std::string out;
  for (const auto& [path, n] : nearer)
    if (!path.empty())
      out += fmt::format("This gate does not reach {}, because {} is nearer: write [gate] there.\n",
                         count(n, "deck", "decks"),
                         terminal_text(fs::path(path).lexically_relative(root).generic_string()));
  return out;
}

void print_result(const Today& today, const std::vector<NewFile>& files, const fs::path& root,
                  const std::string& decks) {
  std::string out;
  for (const NewFile& f : files)
    out +=
        "wrote " + terminal_text(fs::path(f.path).lexically_relative(root).generic_string()) + "\n";
  out += fmt::format(
      "Accepted as it is today: {} of lint, {} in {}. Commit these files; 'deck gate{}' runs the "
      "gate. The workflow needs {}.\n",
      count(today.errors, "error", "errors"),
      count(today.penetrating, "penetrating node or edge", "penetrating nodes and edges"),
      count(today.decks.size(), "deck", "decks"), terminal_text(decks),
      package() + (files.back().path.ends_with("workflows/deck-gate.yml")
                       ? ""
                       : ", and .gitlab-ci.yml has to include .gitlab/deck-gate.yml"));
  print_lines(out);
}

}  // namespace
}  // namespace writing_gate

int init_gate(const CommonOptions& given, const GateInit& init) {
  using namespace writing_gate;
  const auto fail = [&](const auto& why, int code = exit_usage) {
    return failed(given, why, code);
  };
  CommonOptions common = given;
  const auto decks = decks_in_directories(given.decks);
  if (!decks) return fail(decks.error(), exit_input);
  common.decks = *decks;
  const std::string root = library_root(common.decks.front());
  std::error_code ec;
  if (!fs::exists(fs::path(root) / ".git", ec))
    return fail(common.decks.front() + " is in no git work tree; --init writes into one");
  for (const std::string& path : common.decks)
    if (library_root(path) != root) return fail(path + " is in another git work tree than " + root);
  const std::string forge = init.forge.empty() ? forge_of(root) : init.forge;
  const auto words = decks_in_tree(given.decks, root);
  if (!words) return fail(words.error());
  const auto accepted = [&](std::string_view name, Baseline::Kind kind) -> Baseline {
    const std::string path = (fs::path(root) / name).string();
    const auto text = fs::is_regular_file(path, ec) ? read_config_file(path, most_baseline_bytes)
                                                    : config_error("");
    // Keeps entries of other decks; replaces files that are not baselines.
    auto kept = text ? Baseline::parse(*text, path, kind) : text.error();
    return kept ? std::move(*kept) : Baseline(path, kind);
  };
  Today today{
      {}, accepted(lint_name, Baseline::Kind::lint), accepted(gaps_name, Baseline::Kind::gaps)};
  // Checked before the slow lint runs.
  if (auto legal = check_places(files_of(today, root, forge, *words), root, init.overwrite); !legal)
    return fail(legal.error());
  const auto schemas = load_schemas(common);
  if (!schemas) return fail(schemas.error());
  if (const int code = lint_all(common, *schemas, today); code != exit_clean) return code;
  const std::vector<NewFile> files = files_of(today, root, forge, *words);
  std::vector<OutputFile> written_files;
  for (const NewFile& f : files) written_files.push_back({f.path, f.text});
  OutputRules rules;
  rules.overwrite = init.overwrite;
  if (auto written = common.session->write_outputs(written_files, rules); !written)
    return fail(written.error());
  if (common.quiet) return exit_clean;
  print_result(today, files, root, *words);
  print_lines(unreached_text(common.decks, root));
  std::size_t young = 0;
  for (const LoadedDeck& deck : today.decks) {
    if (init.commits == 0) break;
    const auto past = gate_history(deck, init.commits, common);
    if (!past) return fail(past.error());
    if (past->empty())
      ++young;
    else
      print_lines("\n" + *past);
  }
  if (young > 0)
    print_lines(fmt::format("\n{} fewer than two commits: nothing to look back at yet.\n",
                            count(young, "deck has", "decks have")));
  return exit_clean;
}

}  // namespace deck::cli
