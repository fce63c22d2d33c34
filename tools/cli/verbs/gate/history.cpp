// What a gate would have said of the last commits of a deck: each is read as git has it, linted,
// and held against the commit before.
#include "verbs/gate/init.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <vector>

#include "base/shared/count.hpp"
#include "base/shared/escape.hpp"
#include "deck/report/gaps.hpp"
#include "library.hpp"
#include "report/shared/text_table.hpp"
#include "verbs/git_deck.hpp"
#include "verbs/lint/lint_run.hpp"

namespace deck::cli {
namespace looking_back {
namespace {

/// A deck as a commit left it.
struct State {
  std::map<std::pair<RuleId, std::string>, std::size_t> errors;  ///< by rule and fingerprint
  EarlierGaps gaps;
};

/// What the gate says of a commit.
struct Row {
  Commit commit;
  bool stopped = false, known = true;
  std::string why;
};

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

class Past {
 public:
  Past(const std::string& deck, const CommonOptions& common, const SchemaSet& schemas)
      : deck_(deck), common_(common), schemas_(schemas) {}

  /// To be called from the oldest commit to the newest.
  Row look(const Commit& commit) {
    Row row;
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
    for (std::size_t i = 0; i < result.diagnostics.size(); ++i)
      if (const Diagnostic& d = result.diagnostics[i];
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
             Row& row) const {
    std::vector<std::string> words;
    if (const std::uint64_t n = compared.count(Trend::fresh); n > 0)
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
    row.why = joined(words);
  }

  std::string deck_;
  const CommonOptions& common_;
  const SchemaSet& schemas_;
  std::optional<State> before_;
};

std::string table(const std::string& deck, const std::vector<Row>& rows,
                  const CommonOptions& common) {
  TextTable table({{"commit"}, {"date"}, {"gate"}, {"why"}, {"subject"}});
  std::size_t stopped = 0, known = 0;
  for (const Row& row : rows) {
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

}  // namespace
}  // namespace looking_back

Result<std::string> gate_history(const LoadedDeck& loaded, std::size_t commits,
                                 const CommonOptions& common) {
  using namespace looking_back;
  const std::string root = library_root(loaded.path());
  // One more than is asked for: what the oldest is held against.
  const auto past = commits_of(root, files_in_tree(loaded, root), commits + 1);
  if (!past) return past.error();
  if (past->size() < 2) return std::string();
  Past states(loaded.path(), common, loaded.schemas());
  std::vector<Row> rows;
  Progress progress(!common.quiet);
  progress.step("commits");
  for (std::size_t i = past->size(); i-- > 0;) {
    rows.insert(rows.begin(), states.look((*past)[i]));
    progress.update(past->size() - i, past->size());
  }
  if (rows.size() > commits) rows.pop_back();
  return table(loaded.path(), rows, common);
}

}  // namespace deck::cli
