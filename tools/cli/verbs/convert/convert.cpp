// deck convert: writes a deck unchanged or after conversions. Writes only if all conversions of all
// decks succeeded.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "base/shared/paths.hpp"
#include "changes.hpp"
#include "deck/edit.hpp"
#include "edit/shared/conversion.hpp"
#include "library.hpp"
#include "report/shared/deck_json.hpp"
#include "text/shared/gzip.hpp"
#include "verbs/convert/convert_losses.hpp"

namespace deck::cli::verb_convert {
namespace {

namespace fs = std::filesystem;

// ---- the conversions

struct ConvertSteps {
  std::vector<std::int64_t> extract;
  bool flatten = false, expand_type19 = false, resolve_defaults = false;
  int version = 0;
  bool allow_loss = false;
  std::string units;
  bool keep_working = false, partial = false;
  std::vector<std::string> renumber;
};

struct ConvertStep {
  std::string option;  ///< as on the command line, for messages
  std::function<Rewrite(const LoadedDeck&)> run;
  std::string way_out;  ///< advice for a refusal; may be empty
  /// Converts the Engine files; may be empty.
  std::function<void(const Deck&, const EngineFiles&, Rewrite&)> engine = {};
};

void add_step_options(CommandLine& line, ConvertSteps& steps) {
  CommandLine group = line.group("Conversions, in this order");
  group
      .option("--extract-contacts ID[,ID...]", steps.extract,
              "A small deck of one file with these interfaces and everything they need")
      .comma_list();
  group.flag("--flatten", steps.flatten, "One file: every #include replaced by its content");
  group.flag("--expand-type19", steps.expand_type19,
             "Every TYPE19 as the TYPE7 and TYPE11 that the solver makes of it");
  group.flag(
      "--resolve-defaults", steps.resolve_defaults,
      "Write effective values onto the contact cards, so /DEFAULT/INTER is no longer needed");
  group.option("--version N", steps.version,
               "Input version to write: 110, 120, 130, 140, 2017 ... 2026, or 2612. Rewrites every "
               "block whose columns differ");
  group.flag("--allow-loss", steps.allow_loss,
             "With --version: drop values without a cell in the other version. With "
             "--resolve-defaults: leave values without a cell to the default card. With --units: "
             "leave keywords of Engine files unchanged whose cells are not known, and accept other "
             "time steps of beams where the solver's own formula depends on the unit of length");
  group.option("--units SYSTEM", steps.units,
               "Unit system to write, mass,length,time: kg,mm,ms or Mg,mm,s or numbers (factors "
               "to kg, m, s)");
  group.flag("--keep-working-units", steps.keep_working,
             "With --units: change the input units only; the solver computes as before");
  group
      .option("--renumber RULE", steps.renumber,
              "New ids: KIND+N and KIND-N shift them, KIND=N counts from N on; KIND is node, "
              "part, element, surf, all ... (repeatable)")
      .comma_list();
  group.flag("--partial", steps.partial,
             "With --units or --renumber: convert the known values and list blocks that no schema "
             "describes as undecided");
}

/// The requested steps in order. Error: a useless option.
Result<std::vector<ConvertStep>> make_steps(const ConvertSteps& steps) {
  std::vector<ConvertStep> all;
  if (!steps.extract.empty())
    all.push_back({"--extract-contacts",
                   [&steps](const LoadedDeck& c) { return extract_contacts(c, steps.extract); },
                   ""});
  if (steps.flatten)
    all.push_back({"--flatten", [](const LoadedDeck& c) { return flatten(c); }, ""});
  if (steps.expand_type19)
    all.push_back({"--expand-type19", [](const LoadedDeck& c) { return expand_type19(c); }, ""});
  if (steps.resolve_defaults)
    all.push_back(
        {"--resolve-defaults",
         [&steps](const LoadedDeck& c) { return resolve_defaults(c, {steps.allow_loss}); },
         "--allow-loss leaves these cells to the default card and writes the others"});
  if (steps.version != 0 && !is_target_version(steps.version))
    return config_error("--version " + std::to_string(steps.version) +
                        ": not a version that can be written; 110 to 140, 2017 to 2026 and " +
                        std::to_string(newest_version) + " are");
  if (steps.version != 0)
    all.push_back(
        {"--version",
         [&steps](const LoadedDeck& c) { return to_version(c, steps.version, {steps.allow_loss}); },
         "--allow-loss drops what the version has no cell for"});
  if (!steps.units.empty()) {
    const auto target = parse_unit_system(steps.units);
    if (!target) return config_error("--units: " + target.error().message);
    all.push_back(
        {"--units",
         [&steps, system = *target](const LoadedDeck& c) {
           return to_units(c, system, {steps.partial, steps.keep_working});
         },
         "--partial converts what is known and lists the rest",
         [&steps, system = *target](const Deck& deck, const EngineFiles& engine, Rewrite& out) {
           engine_to_units(deck, engine, system, {steps.partial, steps.keep_working},
                           steps.partial || steps.allow_loss, out);
         }});
  }
  if (!steps.renumber.empty()) {
    RenumberOptions renumbering;
    renumbering.partial = steps.partial;
    for (const std::string& text : steps.renumber) {
      auto rule = parse_renumber_rule(text);
      if (!rule) return config_error("--renumber: " + rule.error().message);
      renumbering.rules.push_back(std::move(*rule));
    }
    all.push_back({"--renumber",
                   [renumbering](const LoadedDeck& c) { return renumber(c, renumbering); },
                   "--partial renumbers what is known and lists the rest"});
  }
  if (steps.allow_loss && steps.version == 0 && !steps.resolve_defaults && steps.units.empty())
    return config_error("--allow-loss goes with --version, --units or --resolve-defaults");
  if (steps.keep_working && steps.units.empty())
    return config_error("--keep-working-units goes with --units");
  if (steps.partial && steps.units.empty() && steps.renumber.empty())
    return config_error("--partial goes with --units or --renumber");
  return all;
}

// ---- what is asked for

struct ConvertOptions {
  CommonOptions common;
  ConvertSteps steps;
  WriteFlags write;
  std::string to = "rad";
  std::string report;
  bool no_verify = false;
  bool check = false;  ///< write nothing, print what would happen
};

/// A deck in JSON; `below_root`: its relative path in the tree.
struct Document {
  std::string deck, text;
  std::filesystem::path below_root;
};

/// All decks of the call, converted in turn and written together.
struct ConvertRun {
  const ConvertOptions& options;
  const std::vector<ConvertStep> steps;
  Changes changes;
  Progress progress;
  std::vector<Document> documents = {};
  std::vector<LossEntry> losses = {};
  bool refused = false;   ///< nothing may be written
  bool together = false;  ///< several decks: losses are grouped by cause
  ConversionCheck check = {};
};

/// Prints a usage error; returns the exit code.
int fail(const ConvertRun& run, const Error& error) { return failed(run.options.common, error); }

// ---- where the decks of a call go: files, documents, a patch or standard output

/// Paths of the documents below a directory: names of the decks, or relative paths if names are
/// equal.
std::vector<fs::path> document_names(const ConvertRun& run) {
  std::vector<fs::path> names, places;
  fs::path shared;
  const auto below = [](const fs::path& place, const fs::path& directory) {
    const fs::path relative = place.lexically_relative(directory);
    return !relative.empty() && *relative.begin() != "..";
  };
  for (const auto& [deck, text, below_root] : run.documents) {
    places.push_back(absolute_path(deck == "-" ? "stdin" : without_gz(deck)));
    places.back().replace_extension(".json");
    names.push_back(places.back().filename());
    if (places.size() == 1) shared = places.back().parent_path();
    while (!below(places.back(), shared)) shared = shared.parent_path();
  }
  if (std::set<fs::path>(names.begin(), names.end()).size() == names.size()) return names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = places[i].lexically_relative(shared);
  return names;
}

int write_documents(ConvertRun& run) {
  const std::string& place = run.options.write.directory;
  std::string all;  // common directory; the files may point to it
  std::vector<OutputFile> files;
  const bool rooted = !run.documents.front().below_root.empty();
  if (place.empty() || place == "-" || (fs::path(place).extension() == ".json" && !rooted)) {
    std::vector<std::string> texts;
    for (const Document& d : run.documents) texts.push_back(d.text);
    all = decks_to_json(texts);
    if (place.empty() || place == "-") {
      print_text(all);
      return exit_clean;
    }
    files.push_back({place, all});
  } else {
    const std::vector<fs::path> names = document_names(run);
    std::map<std::string, std::string> from;  // deck by target path
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Document& d = run.documents[i];
      const std::string target = (fs::path(place) / (rooted ? d.below_root : names[i])).string();
      const auto [it, is_new] = from.emplace(target, d.deck);
      if (!is_new)
        return fail(run, {Error::Code::config, "both " + it->second + " and " + d.deck +
                                                   " would be written to " + target});
      files.push_back({target, d.text});
    }
  }
  const auto done = run.changes.write_documents(files, true);
  return done ? exit_clean : fail(run, done.error());
}

/// Writes or prints all results; nothing with --check. Returns the exit code.
int write_all(ConvertRun& run) {
  const ConvertOptions& options = run.options;
  Result<void> done;
  if (options.check) {
    done = run.changes.check();
    return done ? exit_clean : fail(run, done.error());
  }
  if (!run.documents.empty()) return write_documents(run);
  if (options.to == "json") {
    return exit_clean;
  } else if (options.write.in_place || !options.write.directory.empty()) {
    run.progress.step("writing");
    done = run.changes.write(true);
    run.progress.clear();
  } else if (options.write.diff) {
    const auto patch = run.changes.diff();
    if (!patch) return fail(run, patch.error());
    print_contents(*patch);
  }  // standard input was printed on standard output
  return done ? exit_clean : fail(run, done.error());
}

/// Keeps the deck as JSON until all decks are ready.
int add_document(ConvertRun& run, const LoadedDeck& deck) {
  resolve_geometry(deck, run.options.common);
  auto document = deck_to_json({deck.path(), &deck.deck(), &deck.model(), &deck.interfaces()});
  if (!document) return fail(run, document.error());
  Document made{deck.path(), std::move(*document), {}};
  fs::path name =
      made.deck == "-" ? "stdin.json" : fs::path(without_gz(made.deck)).stem().string() + ".json";
  if (!run.changes.root().empty())
    made.below_root = name =
        (fs::path(parent_path(absolute_path(made.deck))).lexically_relative(run.changes.root()) /
         name)
            .lexically_normal();
  if (BatchHooks* frame = run.options.common.session->frame)
    frame->decks[made.deck].target = name.string();
  run.documents.push_back(std::move(made));
  return exit_clean;
}

// ---- one deck: every conversion sees it as the one before left it

/// A deck during its conversions.
struct Conversion {
  LoadedDeck now;
  Overlay changed = {};  ///< contents that differ from disk
  std::vector<LossEntry> losses = {};
  std::vector<std::string> refusals = {};
  bool together = false;  ///< several decks: losses are reported together
};

void print_refusals(const CommonOptions& common, const std::vector<std::string>& refusals) {
  constexpr std::size_t most = 20;
  for (std::size_t i = 0; i < std::min(most, refusals.size()); ++i)
    print_error(common, refusals[i]);
  if (refusals.size() > most)
    print_error(common, fmt::format("... and {} more", refusals.size() - most));
}

/// Verification does not need candidates.
void without_candidates(LoadedDeck& deck) {
  SceneOptions contacts = deck.scene_options();
  if (!std::exchange(contacts.candidates, false)) return;
  deck.set_scene_options(contacts);
}

/// Compares the deck before and after a step. Returns an exit code if they differ.
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

/// Applies a step and reads the result. Returns an exit code on failure.
int apply(Conversion& c, const ConvertStep& step, const SchemaSet& schemas,
          const ConvertOptions& options, Progress& progress) {
  const CommonOptions& common = options.common;
  const LoadedDeck& context = c.now;
  progress.step(c.now.path() + ": " + step.option);
  Rewrite rewrite = step.run(context);
  if (step.engine && rewrite.refusals.empty())
    step.engine(c.now.deck(), c.now.engine_files(), rewrite);
  // Batch reports contain all decks, so values that only changed are left out.
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
  if (!files) return failed(common, files.error(), exit_findings);
  if (files->empty()) return exit_clean;
  if (c.now.path() == "-" && !c.changed.contains("-"))  // standard input cannot be read twice
    c.changed["-"] = std::string(c.now.deck().sources[0].bytes());
  for (auto& [path, text] : *files) c.changed[path] = std::move(text);
  auto again = load(c.now.path(), schemas, common, Stage::interfaces, &c.changed);
  if (!again) return failed(common, again.error(), exit_internal);
  if (again->incomplete()) {
    print_findings(*again, common);
    return failed(common,
                  c.now.path() + ": not written, a file could be read before, but not again",
                  exit_input);
  }
  const int code =
      options.no_verify ? exit_clean : verify(c, *again, step, losses, options, progress);
  c.now = std::move(*again);
  return code;
}

/// Engine files without changes are copied beside the deck.
void report_copies(Conversion& c) {
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

/// Adds the converted deck to the set.
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
  if (code == exit_clean && !options.write.directory.empty()) report_copies(c);
  if (code == exit_clean && !options.check && !run.together) print_losses(c.losses, options.common);
  if (BatchHooks* frame = options.common.session->frame)
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

/// Reads and converts one deck; writing follows later. Returns the exit code.
int convert_one(ConvertRun& run, const std::string& path, const SchemaSet& schemas) {
  const ConvertOptions& options = run.options;
  const bool whole = !run.steps.empty() || options.to == "json";
  auto input = load(path, schemas, options.common, whole ? Stage::interfaces : Stage::deck);
  if (input) return convert(run, path, std::move(*input), schemas);
  run.refused = true;
  if (options.check || run.together)
    run.check.add(path, ConversionCheck::Outcome::unreadable, {}, {}, input.error().message);
  if (!options.check) print_error(options.common, input.error().message);
  return reading_code(input.error());
}

// ---- all decks

/// Merges the reports of all decks; shared files are listed once.
void unite(std::vector<LossEntry>& losses) {
  std::set<std::tuple<std::string, std::uint64_t, std::string, std::int64_t, std::string,
                      std::string, std::string, std::string, Loss>>
      seen;
  std::erase_if(losses, [&](const LossEntry& e) {
    const std::string file = normal_path(e.file);
    return !seen.emplace(file, e.line, e.keyword, e.id, e.field, e.old_text, e.new_text, e.note,
                         e.loss)
                .second;
  });
}

int check(const ConvertOptions& options) {
  const auto refuse = [&](std::string_view why) { return failed(options.common, why); };
  if (const std::string wrong = usage_error(options.write); !wrong.empty()) return refuse(wrong);
  if (options.write.diff && !options.write.directory.empty())
    return refuse("-o and --diff exclude each other");
  const bool somewhere =
      !options.write.directory.empty() || options.write.in_place || options.write.diff;
  const bool only_standard_input = options.common.decks == std::vector<std::string>{"-"};
  if (options.write.in_place &&
      std::count(options.common.decks.begin(), options.common.decks.end(), std::string("-")) > 0)
    return refuse("standard input cannot be rewritten; without --in-place the deck is printed");
  if (options.check && options.to != "rad")
    return refuse("--check is about Starter decks; leave out --to");
  if (options.check && options.write.diff) return refuse("--check and --diff exclude one another");
  if (!somewhere && options.to == "rad" && !only_standard_input && !options.check)
    return refuse(
        "say where to write: -o DIR, --in-place, or --diff or --check to see first what would "
        "happen");
  if (options.to == "json" && (options.write.in_place || options.write.diff))
    return refuse("--to json writes a new file: use -o, or standard output");
  return exit_clean;
}

/// Prints the summary for several decks on standard error.
void print_summary(const ConvertRun& run) {
  print_messages(
      run.check.text(run.options.common.color_on(2), terminal_width(2),
                     run.refused ? ConversionCheck::Tense::can : ConversionCheck::Tense::was));
  print_loss_counts(run.losses);
}

int run(ConvertOptions& options) {
  if (const int bad = check(options); bad != exit_clean) return bad;
  const auto schemas = load_schemas(options.common);
  if (!schemas) return failed(options.common, schemas.error());
  auto steps = make_steps(options.steps);
  if (!steps) return failed(options.common, steps.error());
  if (const int bad = check_outputs(options.common, {options.report}); bad != exit_clean)
    return bad;
  ConvertRun work{options, std::move(*steps), Changes(options.common, options.write),
                  Progress(!options.common.quiet)};
  const auto decks = work.changes.decks(options.common.decks);
  if (!decks) return failed(options.common, decks.error(), reading_code(decks.error()));
  work.together =
      decks->size() > 1 && options.common.session->frame == nullptr && options.to == "rad";
  int worst = exit_clean;
  for (const std::string& path : *decks)
    worst = std::max(worst, options.common.session->about(
                                path, [&] { return convert_one(work, path, *schemas); }));
  unite(work.losses);
  if (BatchHooks* frame = options.common.session->frame) frame->losses = work.losses;
  if (!work.refused)
    worst = std::max(worst, write_all(work));
  else if (decks->size() > 1 && !options.check)
    print_error(options.common, "nothing was written: the decks of a call are converted together");
  // Decisions left to the user.
  if (std::any_of(work.losses.begin(), work.losses.end(),
                  [](const LossEntry& e) { return e.loss == Loss::undecided; }))
    worst = std::max<int>(worst, exit_findings);
  if (options.check && !options.common.quiet)
    print_lines(work.check.text(options.common.color_on(1), text_width()));
  else if (work.together && !options.common.quiet)
    print_summary(work);
  if (!options.report.empty())
    if (auto done = options.common.session->write_output(options.report, losses_json(work.losses));
        !done)
      worst = std::max(worst, fail(work, done.error()));
  return worst;
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<ConvertOptions>();
  add_common(line, options->common, false);
  line.option("--to FORMAT", options->to,
              "Format to write: rad (Starter deck), json (typed fields with effective values)")
      .one_of({"rad", "json"});
  line.flag("--check", options->check,
            "Write nothing; say for how many decks it would work, and what they would lose: one "
            "line a cause with the number of decks. With -o or --in-place also whether that could "
            "be written");
  line.option("--report FILE", options->report,
              "Loss report (JSON): every changed value with its place, and what was kept, "
              "approximated, dropped or undecided");
  line.flag("--no-verify", options->no_verify,
            "Write a result without reading it again and comparing it with the deck before: "
            "effective values, gaps, penetrations, actions, first forces, masses, time steps");
  add_write_options(line, options->write);
  line.existing("--output")
      .describe(
          "Directory to write to; made if missing. The include tree keeps its relative names. With "
          "--to json also FILE.json");
  add_step_options(line, options->steps);
  line.existing("DECK").describe("Starter decks, or directories: all *_0000.rad below them");
  return [options] {
    options->write.read_back = !options->no_verify;
    options->common.engine_files = options->to == "rad";
    options->common.rewrites = options->write.in_place && !options->check;
    return run(*options);
  };
}

const VerbRegistration registration{
    {"convert", 50, "Write a deck in another version, unit system, layout or format",
     R"(  deck convert car_0000.rad -o copy                      the deck and its includes
  deck convert car_0000.rad --version 2022 --diff        what another version would change
  deck convert car_0000.rad --units kg,mm,ms -o metric --report losses.json
  deck convert models/ --version 2026 --check            what a library would lose
  deck convert car_0000.rad --resolve-defaults --in-place --backup
  deck convert car_0000.rad --extract-contacts 7 -o bug  one interface and what it needs
  deck convert car_0000.rad --to json -o car.json

Conversions are done in the order of their options above, whatever their order on the
command line. A conversion that would lose a value is refused with its place (exit code 1), and
nothing is written. Exit code 1 too: something was written but must be decided by hand.
Decks of one call are converted together: a file that they share is written once; if they need
different texts for it, nothing is written (exit code 2).
With files included from above the deck's directory (#include ../common/x.inc), the deck is
written one or more directories further down.)",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_convert
