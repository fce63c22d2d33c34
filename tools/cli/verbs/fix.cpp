// deck fix: repairs initial penetrations (moves nodes or changes interface cards) and ties with
// untied nodes. Reads each result again, reports, and writes all decks together. Over 600 lines,
// because one run has the strategies, the plan of commands made from them, and all their options.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "changes.hpp"
#include "common.hpp"
#include "deck/contacts.hpp"
#include "deck/edit.hpp"
#include "deck/lint.hpp"
#include "deck/model.hpp"
#include "deck/report.hpp"
#include "deck/text.hpp"
#include "edit/shared/depenetrate.hpp"
#include "library.hpp"
#include "report/shared/fix.hpp"
#include "verbs/gap_page.hpp"

namespace deck::cli::verb_fix {
namespace {

struct Options {
  CommonOptions common;
  std::vector<std::string> strategies;  ///< in this order
  std::string html;
  WriteFlags write;
  bool ties = false;
  std::vector<std::int64_t> interfaces;
  std::size_t rows = 10;
  MoveNodesOptions move;
  std::string max_moved = "10%", max_displacement, min_gap = "50%", fpenmax, inacti, reach;
  int digits = 6;
};

constexpr std::initializer_list<const char*> all_strategies = {
    "move-nodes", "reduce-gap", "inacti", "fpenmax", "tie", "move-part"};

/// Reads "10%" or "0.1"; nullopt: other text, or outside of 0..1.
std::optional<double> share(std::string text) {
  const bool percent = text.ends_with('%');
  if (percent) text.pop_back();
  const RealCell cell = read_real(text);
  if (cell.status != NumberStatus::ok) return std::nullopt;
  const double value = percent ? cell.value / 100 : cell.value;
  if (!(value >= 0 && value <= 1)) return std::nullopt;
  return value;
}

class FixRun {
 public:
  FixRun(const Options& options, JsonOutput& json)
      : o_(options), json_(json), changes_(options.common, options.write) {}

  /// Expands directories.
  Result<std::vector<std::string>> decks() { return changes_.decks(o_.common.decks); }
  int one(LoadedDeck& loaded) {
    const bool errors = print_findings(loaded, o_.common) > 0;
    report_solver_errors(loaded);  // needed for the Starter's result
    if (loaded.incomplete())
      return failed(o_.common, loaded.path() + ": not fixed, the include tree is not complete",
                    exit_input);
    for (const auto& known :
         {check_interfaces(loaded, o_.interfaces, "--interface", Examined::contacts_and_ties),
          check_parts(loaded, o_.move.lock, "--lock"), check_parts(loaded, o_.move.move, "--only")})
      if (!known) return fail(known.error());
    if (loaded.path() == "-" && (o_.write.in_place || !o_.write.directory.empty()))
      return fail({Error::Code::config,
                   o_.write.in_place ? "standard input cannot be rewritten; use --diff"
                                     : "a deck from standard input has no name to write it to"});
    const auto member = changes_.add(loaded, loaded.path());
    if (!member) return fail(member.error());
    SceneOptions scene = loaded.scene_options();
    scene.ties = true;
    scene.candidates = false;
    loaded.set_scene_options(scene);
    const Coverage coverage =
        coverage_of(loaded.deck(), loaded.interfaces(), Examined::contacts_and_ties);
    if (coverage.nothing()) {
      report_nothing(loaded, coverage);
      if (!o_.strategies.empty()) changes_.propose(*member, loaded.deck(), {});
      return exit_findings;
    }
    if (o_.strategies.empty()) return propose(loaded, *member, coverage, errors);
    auto fixed = make(loaded, o_.strategies);
    if (!fixed) return not_made(loaded, *member, fixed.error());
    const ChangedFiles& changed = fixed->changed;
    const PenetrationFix whole =
        fixed->fixes.size() == 1 ? fixed->fixes.front() : combined(fixed->fixes);
    changes_.propose(*member, loaded.deck(), changed);
    const auto starter = starter_of(loaded, changed);
    if (!starter) return fail(starter.error());
    if (!o_.html.empty()) {
      const auto patch = changes_.diff();
      if (!patch) return fail(patch.error());
      auto page =
          fix_page(loaded, changed,
                   repair_json(whole, shell_word(loaded.path()),
                               next(loaded.path(), whole, !changed.empty()), starter->text, *patch),
                   o_.common);
      if (!page) return fail(page.error());
      page_ = std::move(*page);
    }
    const std::string written = o_.write.in_place             ? "in-place"
                                : !o_.write.directory.empty() ? o_.write.directory
                                : o_.write.diff               ? "diff"
                                                              : "no";
    if (json_.wanted()) documents_.push_back(fix_json(loaded, whole, written, fixed->fixes));
    texts_ += report(whole, fixed->fixes, changed, loaded, coverage_tail(coverage), starter->text);
    // A deck that the solver refuses is not repaired, whatever was changed.
    return whole.complete && !errors && starter->goes_on ? exit_clean : exit_findings;
  }

  /// Writes all decks and prints the results.
  int write_and_report(int code) {
    const bool writes = o_.write.diff || o_.write.in_place || !o_.write.directory.empty();
    if (code > exit_findings && writes) {
      if (o_.common.decks.size() > 1)
        print_error(o_.common, "nothing was written: the decks of a call are fixed together");
      return code;
    }
    if (o_.write.diff) {
      const auto patch = changes_.diff();
      if (!patch) return fail(patch.error());
      print_contents(*patch);
    }
    if (o_.write.in_place || !o_.write.directory.empty())
      if (auto done = changes_.write(!o_.write.in_place && o_.common.json != "-"); !done)
        return std::max(code, usage(done.error()));
    if (!page_.empty())
      if (auto done = o_.common.session->write_output(o_.html, page_); !done)
        return std::max(code, usage(done.error()));
    for (std::string& document : documents_) json_.add(std::move(document));
    if (o_.write.diff || o_.common.json == "-")
      print_messages(texts_);
    else
      print_lines(texts_);
    return code;
  }

 private:
  int usage(const Error& error) const { return failed(o_.common, error); }
  int fail(const Error& error) const { return failed(o_.common, error, reading_code(error)); }

  /// Result of the Starter for a deck.
  struct Starter {
    std::string text;
    bool stops = false;
    bool goes_on = false;  ///< it does not stop, and something was examined
  };
  Result<Starter> starter_of(const LoadedDeck& loaded, const ChangedFiles& changed) const {
    std::optional<LoadedDeck> result;
    if (!changed.empty()) {
      auto again = loaded.with({changed.begin(), changed.end()});
      if (!again) return again.error();
      if (again->incomplete() && !loaded.incomplete())
        return Error{Error::Code::io, loaded.path() + ": a file of the deck cannot be read again"};
      result.emplace(std::move(*again));
      result->set_scene_options(loaded.scene_options());
      report_solver_errors(*result);
    }
    const LoadedDeck& deck = result ? *result : loaded;
    const Verdict verdict = verdict_of(deck);
    Starter out{starter_text(verdict, deck.scene(), !changed.empty()),
                verdict.level == VerdictLevel::stops, false};
    out.goes_on = !out.stops && examined(deck);
    return out;
  }

  /// False if no contact or tie could be evaluated.
  static bool examined(const LoadedDeck& loaded) {
    const auto& contacts = loaded.scene().contacts;
    return !loaded.ties().empty() ||
           std::any_of(contacts.begin(), contacts.end(), [](const Contact& c) {
             return c.evaluated && not_clean_reason(c) == NotCleanReason::none;
           });
  }

  /// A contact that cannot be evaluated is not an input error; the deck is unchanged.
  int not_made(const LoadedDeck& loaded, std::size_t member, const Error& error) {
    if (error.code != Error::Code::limit) return fail(error);
    print_error(o_.common, error.message);
    if (json_.wanted()) documents_.push_back(fix_json(loaded, {}, "no"));
    changes_.propose(member, loaded.deck(), {});
    return exit_findings;
  }

  /// Nothing was examined: no verdict and no fix.
  void report_nothing(const LoadedDeck& loaded, const Coverage& coverage) {
    PenetrationFix nothing;
    for (const std::string& s : o_.strategies)
      nothing.strategy += (nothing.strategy.empty() ? "" : ",") + s;
    if (json_.wanted()) documents_.push_back(fix_json(loaded, nothing, "no"));
    if (!o_.common.quiet) texts_ += heading(loaded.path()) + coverage_lead(coverage) + "\n";
  }

  using Proposals = std::pair<std::vector<PenetrationFix>, std::vector<ChangedFiles>>;
  Result<Proposals> each(const LoadedDeck& loaded,
                         const std::vector<std::string>& strategies) const {
    Proposals out;
    for (const std::string& strategy : strategies) {
      auto made = make(loaded, {strategy});
      if (!made) return made.error();
      out.first.push_back(std::move(made->fixes.front()));
      out.second.push_back(std::move(made->changed));
    }
    return out;
  }

  /// Commands that follow one another until every penetration is treated or no strategy helps: the
  /// best one, tie, the best one for interfaces that are not treated, Inacti 1 for those.
  Result<FixPlan> plan(const LoadedDeck& loaded, const Proposals& proposals,
                       Starter& starter) const {
    const std::size_t most = loaded.path() == "-" ? 1 : 4;  // standard input has no second step
    FixPlan out;
    ChangedFiles all;
    Options rest = o_;
    const FixRun run(rest, json_);
    const auto take = [&](const Proposals& of, const PenetrationFix& fix) {
      const bool first = out.steps.empty();
      out.steps.push_back(
          {fix_verdict(fix),
           run.command(first ? loaded.path() : written_path(loaded.path()), fix.strategy,
                       changed_interfaces(fix), first ? "-o fixed" : "--in-place")});
      for (const auto& [file, text] : of.second[static_cast<std::size_t>(&fix - of.first.data())])
        all[file] = text;
    };
    if (const PenetrationFix* best = best_of(proposals.first)) take(proposals, *best);
    for (const PenetrationFix& fix : proposals.first)
      if (fix.strategy == "tie" && score_of(fix).solved > 0 && out.steps.size() < most)
        take(proposals, fix);
    while (true) {
      const auto here = loaded.with({all.begin(), all.end()});
      if (!here) return here.error();
      rest = o_;
      const auto state = run.each(*here, {"inacti"});
      if (!state) return state.error();
      rest.interfaces.clear();
      out.untreated = 0;
      for (const FixedInterface& i : state->first.front().interfaces) {
        out.untreated += i.before.untreated;
        if (i.before.untreated > 0) rest.interfaces.push_back(i.id);
      }
      if (out.untreated == 0 || out.steps.size() >= most) break;
      auto next = run.each(*here, {all_strategies.begin(), all_strategies.end()});
      if (!next) return next.error();
      const PenetrationFix* best = best_of(next->first);
      if (best == nullptr || score_of(*best).not_treated >= out.untreated) {
        rest.inacti = "1";
        next = run.each(*here, {"inacti"});
        if (!next) return next.error();
        best = &next->first.front();
        if (score_of(*best).solved == 0) break;
      }
      take(*next, *best);
    }
    const auto then = starter_of(loaded, all);
    if (!then) return then.error();
    starter = *then;
    out.starter = then->text;
    return out;
  }

  /// Result of each strategy, and the commands that together treat most.
  int propose(const LoadedDeck& loaded, std::size_t member, const Coverage& coverage, bool errors) {
    const auto made = each(loaded, {all_strategies.begin(), all_strategies.end()});
    if (!made) return not_made(loaded, member, made.error());
    Starter starter;
    const auto then = plan(loaded, *made, starter);
    if (!then) return not_made(loaded, member, then.error());
    const PenetrationFix now = unchanged(made->first);
    if (json_.wanted()) documents_.push_back(fix_json(loaded, now, "no", made->first, then->steps));
    if (!o_.common.quiet) {
      texts_ += heading(loaded.path()) + fix_proposals_text(made->first, text_options(loaded));
      if (const std::string tail = coverage_tail(coverage); !tail.empty())
        texts_ += "\n" + tail.substr(1) + "\n";
      if (!then->steps.empty() || then->untreated > 0 || starter.stops)
        texts_ += fix_plan_text(*then);
    }
    return now.complete && !errors && starter.goes_on ? exit_clean : exit_findings;
  }
  FixTextOptions text_options(const LoadedDeck& loaded) const {
    const bool to_stderr = o_.write.diff || o_.common.json == "-";
    return {o_.rows,          o_.common.color_on(to_stderr ? 2 : 1),
            text_width(),     shell_word(loaded.path()),
            examined(loaded), loaded.deck().begin.working};
  }
  std::string heading(const std::string& path) const {
    return o_.common.decks.size() > 1 ? terminal_text(path) + "\n" : std::string();
  }

  /// Interfaces with changed cards or ties.
  static std::vector<std::int64_t> changed_interfaces(const PenetrationFix& fix) {
    std::vector<std::int64_t> out;
    for (const FixedInterface& i : fix.interfaces)
      if (!i.changes.empty()) out.push_back(i.id);
    for (const FixedTie& tie : fix.ties)
      if (!tie.changes.empty()) out.push_back(tie.id);
    return out;
  }

  /// Command line for one strategy with the options of this call; without --interface for
  /// `interfaces`.
  std::string command(const std::string& path, std::string_view strategy,
                      const std::vector<std::int64_t>& interfaces = {},
                      std::string_view output = "-o fixed") const {
    const Options plain;
    std::string text = fmt::format("deck fix {} --strategy {}", shell_word(path), strategy);
    const auto add = [&](std::string_view option, const std::string& value,
                         const std::string& usual) {
      if (value != usual) text += fmt::format(" {} {}", option, shell_word(value));
    };
    const auto ids = [](const std::vector<std::int64_t>& list) {
      return fmt::format("{}", fmt::join(list, ","));
    };
    add("--interface", ids(o_.interfaces.empty() ? interfaces : o_.interfaces), "");
    if (o_.ties) text += " --ties";
    if (strategy == "reduce-gap") {
      add("--min-gap", o_.min_gap, plain.min_gap);
      add("--digits", std::to_string(o_.digits), std::to_string(plain.digits));
    } else if (strategy == "inacti") {
      add("--inacti", o_.inacti, "");
    } else if (strategy == "tie") {
      add("--reach", o_.reach, "");
    } else if (strategy == "fpenmax") {
      add("--fpenmax", o_.fpenmax, plain.fpenmax);
    } else {
      add("--lock", ids(o_.move.lock), "");
      add("--only", ids(o_.move.move), "");
      add("--max-displacement", o_.max_displacement, "");
      if (o_.move.lock_rigid_bodies) text += " --lock-rigid-bodies";
      if (o_.move.lock_boundary_conditions) text += " --lock-boundary-conditions";
      if (strategy == "move-nodes") {
        add("--max-moved", o_.max_moved, plain.max_moved);
        if (o_.move.secondary_only) text += " --secondary-only";
      }
      add("--clearance", fmt::format("{}", o_.move.clearance),
          fmt::format("{}", plain.move.clearance));
    }
    return text.append(" ").append(output);
  }

  /// Path of the deck once it is written.
  std::string written_path(const std::string& path) const {
    return (o_.write.directory.empty() ? "fixed" : o_.write.directory) + "/" +
           path.substr(path.find_last_of("/\\") + 1);
  }

  /// Suggested commands after this fix.
  std::vector<NextCommand> next(const std::string& path, const PenetrationFix& fix,
                                bool changes) const {
    std::vector<NextCommand> out;
    const bool written = !o_.write.directory.empty() || o_.write.in_place;
    if (changes && !written)
      out.push_back({"write the repaired deck", command(path, fix.strategy)});
    if (fix.crossings_after > 0)
      out.push_back({"list the crossed elements, which no fix separates",
                     fmt::format("deck gaps {} --crossings", shell_word(path))});
    std::vector<std::int64_t> left;
    for (const FixedInterface& i : fix.interfaces)
      if (i.after.pairs > 0) left.push_back(i.id);
    const std::string deck = o_.write.in_place || !changes ? path : written_path(path);
    if (!left.empty())
      out.push_back(
          {"say what each strategy would do about the rest",
           fmt::format("deck fix {} --interface {}", shell_word(deck), fmt::join(left, ","))});
    return out;
  }

  /// Applies strategies in order.
  Result<FixSequence> make(const LoadedDeck& loaded, const std::vector<std::string>& names) const {
    Progress progress(!o_.common.quiet);
    std::string step;
    FixOptions base;
    base.threads = o_.common.thread_count();
    base.interfaces = o_.interfaces;
    base.ties = o_.ties;
    base.progress = [&](std::string_view what, std::size_t done, std::size_t total) {
      if (step != what) progress.step(step = what);
      progress.update(done, total);
    };
    std::vector<FixStep> steps;
    for (const std::string& strategy : names)
      steps.emplace_back([&](const LoadedDeck& here) { return one_step(strategy, here, base); });
    return fix_in_order(loaded, steps);
  }
  Result<PenetrationFix> one_step(const std::string& strategy, const LoadedDeck& context,
                                  const FixOptions& base) const {
    if (strategy == "reduce-gap") {
      ReduceGapOptions options;
      static_cast<FixOptions&>(options) = base;
      options.least_share = *share(o_.min_gap);
      options.digits = o_.digits;
      return reduce_gaps(context, options);
    }
    if (strategy == "inacti") {
      InactiOptions options;
      static_cast<FixOptions&>(options) = base;
      if (!o_.inacti.empty()) options.inacti = static_cast<int>(read_integer(o_.inacti).value);
      return set_inacti(context, options);
    }
    if (strategy == "fpenmax") {
      FpenmaxOptions options;
      static_cast<FixOptions&>(options) = base;
      if (!o_.fpenmax.empty()) options.ratio = *share(o_.fpenmax);
      return set_fpenmax(context, options);
    }
    if (strategy == "tie") {
      TieOptions options;
      static_cast<FixOptions&>(options) = base;
      if (!o_.reach.empty()) options.reach = read_real(o_.reach).value;
      return tie_nodes(context, options);
    }
    MoveNodesOptions options = o_.move;
    static_cast<FixOptions&>(options) = base;
    options.most_moved = *share(o_.max_moved);
    if (!o_.max_displacement.empty())
      options.most_displacement = read_real(o_.max_displacement).value;
    return strategy == "move-part" ? move_part(context, options) : move_nodes(context, options);
  }
  std::string report(const PenetrationFix& fix, const std::vector<PenetrationFix>& steps,
                     const ChangedFiles& changed, const LoadedDeck& loaded,
                     const std::string& not_examined, const std::string& starter) const {
    if (o_.common.quiet) return {};
    const FixTextOptions text = text_options(loaded);
    std::string out = heading(loaded.path());
    if (steps.size() > 1) {
      // Each step relative to the one before, then all together.
      for (std::size_t i = 0; i < steps.size(); ++i)
        out += fmt::format("step {} of {}\n{}\n", i + 1, steps.size(), fix_text(steps[i], text));
      out += "all steps\n" + fix_verdict(fix) + "\n";
    } else {
      out += fix_text(fix, text);
    }
    if (!not_examined.empty()) out += "\n" + not_examined.substr(1) + "\n";
    if (!changed.empty()) {
      const bool written = o_.write.in_place || !o_.write.directory.empty();
      if (o_.write.directory.empty()) {  // otherwise the written files are listed
        out += "\n";
        for (const auto& [file, bytes] : changed)
          out +=
              fmt::format("{} {}\n", written ? "changed:" : "would change:", terminal_text(file));
      }
      if (!written && !o_.write.diff)
        out += "nothing was written: --diff shows the patch, --in-place or -o DIR writes it\n";
    } else if (!fix.interfaces.empty() || !fix.ties.empty()) {
      out += "\nno file changes\n";
    }
    return out + "\n" + starter + "\n";
  }
  const Options& o_;
  JsonOutput& json_;
  Changes changes_;
  std::vector<std::string> documents_;
  std::string texts_, page_;
};

/// Fixes the decks, or prints proposals.
int run(const Options& o) {
  if (const int bad = check_outputs(o.common, {o.common.json, o.html}); bad != exit_clean)
    return bad;
  JsonOutput json(o.common, "deck/fix", 1);
  FixRun fix(o, json);
  const auto decks = fix.decks();
  if (!decks) return failed(o.common, decks.error(), reading_code(decks.error()));
  CommonOptions common = o.common;
  common.decks = *decks;
  const int code = for_each_deck(common, [&](LoadedDeck& loaded) { return fix.one(loaded); });
  return json.write(fix.write_and_report(code));
}

// ---- options

/// Error in the combination of options; empty: none.
std::string wrong_usage(const Options& o) {
  for (const std::string& s : o.strategies)
    if (std::count(o.strategies.begin(), o.strategies.end(), s) > 1)
      return "--strategy names " + s + " twice";
  if (o.strategies.empty())
    for (const auto& [given, option] : {std::pair{o.write.in_place, "--in-place"},
                                        {!o.write.directory.empty(), "-o"},
                                        {o.write.diff, "--diff"},
                                        {!o.html.empty(), "--html"}})
      if (given)
        return std::string(option) +
               " needs --strategy; without these options 'deck fix DECK' says what each would do";
  if (auto page = check_html(o.common, o.html); !page) return page.error().message;
  if (std::string wrong = deck::cli::usage_error(o.write); !wrong.empty()) return wrong;
  if (!share(o.max_moved)) return "--max-moved needs a share like 10% or 0.1";
  if (!share(o.min_gap)) return "--min-gap needs a share like 50% or 0.5";
  if (!o.fpenmax.empty() && !share(o.fpenmax)) return "--fpenmax needs a share like 80% or 0.8";
  if (o.write.diff && o.common.json == "-") return "--diff and --json - both want standard output";
  const RealCell limit = read_real(o.max_displacement);
  if (!o.max_displacement.empty() && !(limit.status == NumberStatus::ok && limit.value > 0))
    return "--max-displacement needs a length above 0";
  const RealCell reach = read_real(o.reach);
  if (!o.reach.empty() && !(reach.status == NumberStatus::ok && reach.value > 0))
    return "--reach needs a length above 0";
  return {};
}

/// Options of the strategies that change interface cards.
void add_card_options(CommandLine& line, Options& o) {
  CommandLine others = line.group("reduce-gap, inacti, fpenmax, tie");
  others.option("--min-gap SHARE", o.min_gap, "reduce-gap: least share of the present gap to keep")
      .show_default();
  others.option("--digits N", o.digits, "reduce-gap: significant digits, rounded down")
      .range(1, 17)
      .show_default();
  others
      .option("--inacti N", o.inacti,
              "inacti: 0 (or 1000), 1, 2, 3, 5 or 6; TYPE24 and TYPE25: -1, 0 or 5 (default: 6 and "
              "5)")
      .one_of({-1, 0, 1, 2, 3, 5, 6, 1000});
  others.option("--fpenmax SHARE", o.fpenmax,
                "fpenmax: switch off nodes deeper than this share of the gap (default: only "
                "nodes at distance 0, at which the solver stops)");
  others.option(
      "--reach LENGTH", o.reach,
      "tie: how far from its segment a node may be, working units (default: for each TYPE2 "
      "the mean side of its segments, as far as the solver looks by itself)");
}

/// Options of the strategies that move nodes.
void add_move_options(CommandLine& line, Options& o) {
  CommandLine move = line.group("move-nodes, move-part");
  move.option("--lock PART", o.move.lock, "Nodes of these parts stay (also where shared)")
      .by_commas();
  move.option("--only PART", o.move.move, "Only nodes of these parts alone move").by_commas();
  move.flag("--lock-rigid-bodies", o.move.lock_rigid_bodies, "Nodes of /RBODY stay");
  move.flag("--lock-boundary-conditions", o.move.lock_boundary_conditions, "Nodes of /BCS stay");
  move.flag("--secondary-only", o.move.secondary_only,
            "move-nodes: nodes of main sides do not move");
  move.option("--max-moved SHARE", o.max_moved,
              "move-nodes: share of the nodes of a part that may move; a part that needs more is "
              "left alone")
      .show_default();
  move.option("--max-displacement LENGTH", o.max_displacement,
              "Farthest a node may move, working units (default of move-nodes: as far as its "
              "penetration is deep, which it never passes; of move-part: twice the deepest one)");
  move.option("--clearance SHARE", o.move.clearance, "Distance left beyond the gap, share of it")
      .range(0.0, 1.0)
      .show_default();
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  add_common(line, o.common);
  line.option(
          "--strategy STRATEGY", o.strategies,
          "Without: say what each would do. move-nodes: out of each other's gap; move-part: one "
          "whole part, with everything connected to it, the way that frees the most; reduce-gap: "
          "the "
          "largest gap without a penetration; inacti: let the solver treat them; fpenmax: switch "
          "off deep ones; tie: raise dsearch of TYPE2 to what its untied nodes need. "
          "Several with commas: each acts on the result of the one before")
      .comma_list()
      .one_of(all_strategies);
  line.option("--interface ID", o.interfaces, "Only these interface ids").by_commas();
  line.flag(
      "--ties", o.ties,
      "Treat ties (TYPE10) like other contacts: nodes that are moved out of "
      "their gap are no longer tied. By default ties are not changed; those of a TYPE2 never are");
  add_write_options(line, o.write);
  line.option("--html FILE", o.html,
              "Write a report with the deck as it is fixed, compared with before, to FILE");
  line.option("--rows", o.rows, "Rows of the lists in the report").show_default();
  add_move_options(line, o);
  add_card_options(line, o);
  return [options] {
    options->common.rewrites = options->write.in_place;
    if (const std::string wrong = wrong_usage(*options); !wrong.empty())
      return failed(options->common, wrong);
    return run(*options);
  };
}

const VerbRegistration registration{
    {"fix", 35,
     "Repair initial penetrations and ties: move nodes, reduce gaps, set Inacti, Fpenmax or "
     "dsearch",
     R"(  deck fix car_0000.rad                                  what each strategy would do
  deck fix car_0000.rad --strategy move-nodes --diff     what this one would do, as a patch
  deck fix car_0000.rad --strategy move-nodes --max-moved 100% --lock 12,13 --in-place --backup
  deck fix car_0000.rad --strategy reduce-gap --min-gap 80% -o fixed
  deck fix car_0000.rad --strategy reduce-gap,move-nodes --html fixed.html --diff
  deck fix car_0000.rad --strategy inacti --inacti 6 --interface 3 --in-place
  deck fix car_0000.rad --strategy tie --reach 5 -o fixed

Which strategy? Moving nodes cures the cause and keeps the gap; it changes the mesh a little. Moving a
part keeps the shape of both sides. Reducing the gap is right where gap and thickness disagree; the
contact then acts later. Inacti keeps the mesh, and the solver starts with a smaller gap for the pairs
that penetrate. Fpenmax takes nodes out of the interface: for a few hopeless ones. tie raises dsearch of
a TYPE2 to what nodes within --reach need; a node that another tie or a rigid body holds stays untied.

Every change is verified before it is shown: what would penetrate deeper or come loose is not written.

Exit code: 0 all treated or nothing to treat, 1 something remains, the solver stops with the
result, or nothing was examined, 2 wrong usage, 3 unreadable input.)",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_fix
