// deck lint --fix and --diff: what the decks of a call want fixed, together.
#include <fmt/format.h>

#include <algorithm>

#include "base/shared/count.hpp"
#include "base/shared/escape.hpp"
#include "verbs/lint/lint_run.hpp"

namespace deck::cli {

/// What all decks together want fixed. A fix of a file that they share is made only if all of
/// them want it.
Result<std::size_t> LintRun::collect_fixes(Changes& set, std::vector<FixResult>& results) {
  std::vector<FixedDeck> decks;
  std::vector<const LintJob*> jobs;
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
    print_messages(
        fmt::format("{}: note: not fixed ({}): {} includes this file too and needs it unchanged\n",
                    terminal_text(jobs[w.deck]->loaded->deck().sources.where(w.diagnostic->span)),
                    finding_name(*w.diagnostic), terminal_text(jobs[w.other]->path)));
  }
  if (agreed.withheld.size() > most && !common_.quiet)
    print_note(
        fmt::format("{} more were not fixed for this reason", agreed.withheld.size() - most));
  return changed;
}

/// --diff prints what --fix would write; --fix writes, every file once, and lints again.
int LintRun::fixes() {
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

}  // namespace deck::cli
