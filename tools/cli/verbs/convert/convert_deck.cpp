// The conversions of a deck: every one sees the deck as the one before left it.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "edit/shared/conversion.hpp"
#include "report/shared/deck_json.hpp"
#include "verbs/convert/convert_run.hpp"

namespace deck::cli::verb_convert {
namespace {

/// A deck on its way through the conversions.
struct Conversion {
  LoadedDeck now;
  Overlay changed = {};  ///< contents that differ from the files on disk
  std::vector<LossEntry> losses = {};
  std::vector<std::string> refusals = {};
  bool together = false;  ///< with other decks: what it loses is said with what they lose
};

void print_refusals(const CommonOptions& common, const std::vector<std::string>& refusals) {
  constexpr std::size_t most = 20;
  for (std::size_t i = 0; i < std::min(most, refusals.size()); ++i)
    print_error(common, refusals[i]);
  if (refusals.size() > most)
    print_error(common, fmt::format("... and {} more", refusals.size() - most));
}

/// Pairs that do not penetrate are not counted to verify a deck.
void without_candidates(LoadedDeck& deck) {
  SceneOptions contacts = deck.scene_options();
  if (!std::exchange(contacts.candidates, false)) return;
  deck.set_scene_options(contacts);
}

/// Compares the deck after a step with the deck before it. An exit code if it is another one.
int verify(Conversion& c, LoadedDeck& again, const ConvertStep& step,
           const std::vector<LossEntry>& losses, const ConvertOptions& options,
           Progress& progress) {
  progress.step(c.now.path() + ": comparing the result of " + step.option + " with the deck");
  without_candidates(c.now);
  without_candidates(again);
  const auto difference = first_difference(c.now, again, relation_of(step.option, losses),
                                           options.steps.allow_loss ? &c.losses : nullptr);
  progress.clear();
  if (!difference) return exit_clean;
  c.refusals = {step.option + ": the result is not the same model: " + *difference};
  if (!options.check)
    print_error(options.common,
                c.now.path() + ": " + c.refusals.front() +
                    "; nothing was written. --no-verify writes it without this comparison");
  return exit_findings;
}

/// One conversion, and the deck read again as it is then. An exit code if that failed.
int apply(Conversion& c, const ConvertStep& step, const SchemaSet& schemas,
          const ConvertOptions& options, Progress& progress) {
  const CommonOptions& common = options.common;
  const LoadedDeck& context = c.now;
  progress.step(c.now.path() + ": " + step.option);
  Rewrite rewrite = step.run(context);
  if (step.engine && rewrite.refusals.empty())
    step.engine(c.now.deck(), c.now.engine_files(), rewrite);
  // With a batch the values that only changed are left out: its report holds all decks.
  if (!options.report.empty()) add_changed_values(context, step.option, rewrite);
  progress.clear();
  const std::vector<LossEntry> losses = std::move(rewrite.losses);
  c.losses.insert(c.losses.end(), losses.begin(), losses.end());
  if (!rewrite.refusals.empty()) {
    if (options.check && !rewrite.bad_request) {
      c.refusals = std::move(rewrite.refusals);
      return exit_findings;
    }
    if (!c.together || rewrite.bad_request) print_refusals(common, rewrite.refusals);
    for (const std::string& r : rewrite.refusals) c.losses.push_back(refused_entry(r));
    c.refusals = rewrite.refusals;
    print_error(common,
                c.now.path() + ": " + step.option + " was not done; nothing was written" +
                    (step.way_out.empty() || rewrite.bad_request ? "" : ". " + step.way_out));
    return rewrite.bad_request ? exit_usage : exit_findings;
  }
  if (!common.quiet && !options.check)
    for (const std::string& note : rewrite.notes)
      print_note(std::string(step.option) + ": " + note);
  auto files = apply_rewrite(c.now.deck().sources, rewrite);
  if (!files) return failed(common, files.error().message, exit_findings);
  if (files->empty()) return exit_clean;
  if (c.now.path() == "-" && !c.changed.contains("-"))  // it cannot be read twice
    c.changed["-"] = std::string(c.now.deck().sources[0].bytes());
  for (auto& [path, text] : *files) c.changed[path] = std::move(text);
  auto again = load(c.now.path(), schemas, common, Stage::interfaces, &c.changed);
  if (!again) return failed(common, again.error().message, exit_internal);
  if (again->incomplete()) {
    print_findings(*again, common);
    return failed(common,
                  c.now.path() + ": not written, a file could be read before, but not again",
                  exit_input);
  }
  const int code =
      options.verifies() ? verify(c, *again, step, losses, options, progress) : exit_clean;
  c.now = std::move(*again);
  return code;
}

/// Engine files that no conversion has to do with are written beside the deck as they are.
void tell_of_copies(Conversion& c) {
  for (const EngineFile& file : c.now.engine_files().files) {
    const std::string& path = c.now.deck().sources[file.file].path();
    if (std::any_of(c.losses.begin(), c.losses.end(),
                    [&](const LossEntry& e) { return e.file == path; }))
      continue;
    LossEntry entry;
    entry.file = path;
    entry.line = 1;
    entry.note = "Engine file: copied unchanged";
    c.losses.push_back(std::move(entry));
  }
}

/// What the deck has become goes into the set.
int add_result(ConvertRun& run, std::size_t member, Conversion& c) {
  const ConvertOptions& options = run.options;
  if (options.to == "json") return add_document(run, c.now);
  if (c.now.path() == "-" && !options.write.diff && !options.check) {
    if (c.now.deck().sources.size() == 1 && options.write.directory.empty()) {
      print_contents(c.now.deck().sources[0].bytes());
      return exit_clean;
    }
    return failed(options.common,
                  "a deck from standard input has no name to write it to; without -o a deck of one "
                  "file goes to standard output");
  }
  run.changes.propose(member, c.now.deck(), c.changed);
  return exit_clean;
}

int convert(ConvertRun& run, const std::string& name, LoadedDeck loaded, const SchemaSet& schemas) {
  const ConvertOptions& options = run.options;
  if (loaded.incomplete()) {
    run.refused = true;
    if (options.check) {
      run.check.add(name, ConversionCheck::Outcome::unreadable, {}, {},
                    "the include tree is not complete");
      return exit_input;
    }
    print_findings(loaded, options.common);
    return failed(options.common, loaded.path() + ": not written, the include tree is not complete",
                  exit_input);
  }
  const auto member = run.changes.add(loaded, name);
  if (!member) {
    run.refused = true;
    return fail(run, member.error());
  }
  Conversion c{std::move(loaded)};
  c.together = run.together;
  int code = exit_clean;
  for (const ConvertStep& step : run.steps) {
    code = apply(c, step, schemas, options, run.progress);
    if (code != exit_clean) break;
  }
  if (code == exit_clean && !options.write.directory.empty()) tell_of_copies(c);
  if (code == exit_clean && !options.check && !run.together) print_losses(c.losses, options.common);
  if (BatchFrame* frame = options.common.session->frame)
    for (const LossEntry& e : c.losses) ++frame->decks[name].losses[static_cast<int>(e.loss)];
  const bool open = std::any_of(c.losses.begin(), c.losses.end(),
                                [](const LossEntry& e) { return e.loss == Loss::undecided; });
  if (options.check || run.together)
    run.check.add(name,
                  code != exit_clean ? ConversionCheck::Outcome::refused
                  : open             ? ConversionCheck::Outcome::undecided
                                     : ConversionCheck::Outcome::written,
                  c.losses, c.refusals,
                  code != exit_clean && c.refusals.empty() ? "the result was refused" : "");
  for (LossEntry& e : c.losses) run.losses.push_back(std::move(e));
  if (code == exit_clean) code = add_result(run, *member, c);
  run.refused = run.refused || code != exit_clean;
  return code == exit_clean && open ? exit_findings : code;
}

}  // namespace

int convert_one(ConvertRun& run, const std::string& path, const SchemaSet& schemas) {
  const ConvertOptions& options = run.options;
  const bool whole = !run.steps.empty() || options.to == "json";
  auto input = load(path, schemas, options.common, whole ? Stage::interfaces : Stage::deck);
  if (input) return convert(run, path, std::move(*input), schemas);
  run.refused = true;
  if (options.check || run.together)
    run.check.add(path, ConversionCheck::Outcome::unreadable, {}, {}, input.error().message);
  if (!options.check) print_error(options.common, input.error().message);
  return input.error().code == Error::Code::config ? exit_usage : exit_input;
}

}  // namespace deck::cli::verb_convert
