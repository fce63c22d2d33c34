// deck convert: writes a deck again — as it is, or after one or more conversions. Every conversion
// sees the deck as the one before left it; nothing is written before all of them have succeeded.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "base/shared/paths.hpp"
#include "common.hpp"
#include "deck/edit/rewrite.hpp"
#include "edit/shared/changed_values.hpp"
#include "edit/shared/from_json.hpp"
#include "edit/shared/verify.hpp"
#include "report/shared/deck_json.hpp"
#include "report/shared/losses.hpp"
#include "text/shared/gzip.hpp"
#include "verbs/convert/convert_check.hpp"
#include "verbs/convert/convert_losses.hpp"
#include "verbs/convert/convert_steps.hpp"
#include "writing/changes.hpp"
#include "writing/library.hpp"

namespace deck::cli::verb_convert {
namespace {

namespace fs = std::filesystem;

struct Options {
  CommonOptions common;
  ConvertSteps steps;
  WriteChoice write;
  std::string to = "rad", from = "rad";
  std::string report;
  bool verify = false, no_verify = false;
  bool check = false;  ///< nothing is written: what would happen
  /// In a batch it is on unless it is switched off.
  bool verifies() const { return !no_verify && (verify || common.session->frame != nullptr); }
};

/// A deck on its way through the conversions.
struct Conversion {
  LoadedDeck now;
  Overlay changed;  ///< contents that differ from the files on disk
  std::vector<LossEntry> losses;
  std::unique_ptr<Behaviour> behaviour;  ///< of `now`, if it is to be verified
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

std::unique_ptr<Behaviour> behaviour_of(LoadedDeck& loaded) {
  SceneOptions contacts = loaded.scene_options();
  contacts.candidates = false;
  loaded.set_scene_options(contacts);
  return std::make_unique<Behaviour>(loaded);
}

/// Compares the deck with what it was before a step. An exit code if it is another one.
int verify(Conversion& c, LoadedDeck& again, const ConvertStep& step,
           const std::vector<LossEntry>& losses, const CommonOptions& common, Progress& progress) {
  progress.step(c.now.path() + ": comparing the result of " + step.option + " with the deck");
  auto after = behaviour_of(again);
  VerifyRelation relation = relation_of(losses);
  relation.new_ids = step.option == "--renumber";
  relation.extract = step.option == "--extract-contacts";
  relation.expanded = step.option == "--expand-type19";
  relation.cells =
      (step.option == "--units" || step.option == "--version") &&
      std::none_of(losses.begin(), losses.end(), [](const LossEntry& e) {
        return (e.loss == Loss::dropped || e.loss == Loss::undecided) && !e.without_effect;
      });
  const auto difference = first_difference(*c.behaviour, *after, relation);
  c.behaviour = std::move(after);
  progress.clear();
  if (!difference) return exit_clean;
  print_error(common, c.now.path() + ": " + step.option +
                          ": the result is not the same model: " + *difference +
                          "; nothing was written. --no-verify writes it nevertheless");
  return exit_findings;
}

/// One conversion, and the deck read again as it is then. An exit code if that failed.
int apply(Conversion& c, const ConvertStep& step, const SchemaSet& schemas, const Options& options,
          Progress& progress) {
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
    if (options.check && !rewrite.misasked) {
      c.refusals = std::move(rewrite.refusals);
      return exit_findings;
    }
    if (!c.together || rewrite.misasked) print_refusals(common, rewrite.refusals);
    for (const std::string& r : rewrite.refusals) c.losses.push_back(refused_entry(r));
    c.refusals = rewrite.refusals;
    print_error(common, c.now.path() + ": " + step.option + " was not done; nothing was written" +
                            (step.way_out.empty() || rewrite.misasked ? "" : ". " + step.way_out));
    return rewrite.misasked ? exit_usage : exit_findings;
  }
  if (!common.quiet && !options.check)
    for (const std::string& note : rewrite.notes)
      print_note(std::string(step.option) + ": " + note);
  auto files = apply_rewrite(c.now.deck().sources, rewrite);
  if (!files) {
    print_error(common, files.error().message);
    return exit_findings;
  }
  if (files->empty()) return exit_clean;
  if (options.verifies() && !c.behaviour) c.behaviour = behaviour_of(c.now);
  if (c.now.path() == "-" && !c.changed.contains("-"))  // it cannot be read twice
    c.changed["-"] = std::string(c.now.deck().sources[0].bytes());
  for (auto& [path, text] : *files) c.changed[path] = std::move(text);
  auto again = load(c.now.path(), schemas, common, Stage::interfaces, &c.changed);
  if (!again) {
    print_error(common, again.error().message);
    return exit_internal;
  }
  if (again->incomplete()) {
    print_findings(*again, common);
    print_error(common, c.now.path() + ": not written, a file could be read before, but not again");
    return exit_input;
  }
  const int code = c.behaviour ? verify(c, *again, step, losses, common, progress) : exit_clean;
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

/// A deck in JSON; `below_root` is its place where the call mirrors a tree.
struct Document {
  std::string deck, text;
  fs::path below_root;
};

/// All decks of the call: converted one after the other, written together or not at all.
struct Run {
  const Options& options;
  const std::vector<ConvertStep> steps;
  Changes changes;
  Progress progress;
  std::vector<Document> documents = {};
  std::vector<LossEntry> losses = {};
  bool refused = false;   ///< nothing may be written
  bool together = false;  ///< several decks: what they lose is said once, by its causes
  ConversionCheck check = {};
};

// ---- where it goes ---------------------------------------------------------------------------

int fail(const Run& run, const Error& error) {
  print_error(run.options.common, error.message);
  return exit_usage;
}

/// Where the documents of the decks go below a directory: by the names of the decks, and where two
/// have one name by their places below the directory that all of them share.
std::vector<fs::path> document_names(const Run& run) {
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

int write_documents(Run& run) {
  const std::string& place = run.options.write.directory;
  std::string all;  // which the files may point to
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
    std::map<std::string, std::string> from;  // target, its deck
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

int write_all(Run& run) {
  const Options& options = run.options;
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
  }  // else standard input, which went to standard output
  return done ? exit_clean : fail(run, done.error());
}

/// The document as a deck again: it must be the deck that it was made of.
std::string document_difference(const std::string& document, const Deck& deck,
                                const SchemaSet& schemas) {
  const auto back = deck_from_json(document, schemas);
  if (!back) return back.error().message;
  std::map<std::string_view, int> texts;
  for (const DeckFile& f : *back) ++texts[f.text];
  for (std::uint32_t f = 0; f < deck.sources.size(); ++f)
    if (!texts.contains(deck.sources[f].bytes()))
      return deck.sources[f].path() + " is not the same byte for byte when read back";
  return {};
}

/// The deck in JSON, kept until all decks of the call are ready.
int add_document(Run& run, const Conversion& c, const SchemaSet& schemas) {
  resolve_geometry(c.now, run.options.common);
  auto document = deck_to_json({c.now.path(), &c.now.deck(), &c.now.model(), &c.now.interfaces()});
  if (!document) return fail(run, document.error());
  if (run.options.verifies())
    if (const std::string why = document_difference(*document, c.now.deck(), schemas); !why.empty())
      return fail(run,
                  {Error::Code::internal, c.now.path() + ": the JSON is not the deck: " + why});
  Document made{c.now.path(), std::move(*document), {}};
  fs::path name =
      made.deck == "-" ? "stdin.json" : fs::path(without_gz(made.deck)).stem().string() + ".json";
  if (!run.changes.root().empty())
    made.below_root = name =
        (fs::path(parent_path(absolute_path(made.deck))).lexically_relative(run.changes.root()) /
         name)
            .lexically_normal();
  if (BatchFrame* frame = run.options.common.session->frame)
    frame->decks[made.deck].target = name.string();
  run.documents.push_back(std::move(made));
  return exit_clean;
}

/// What the deck has become goes into the set.
int add_result(Run& run, std::size_t member, Conversion& c, const SchemaSet& schemas) {
  const Options& options = run.options;
  if (options.to == "json") return add_document(run, c, schemas);
  if (c.now.path() == "-" && options.from == "rad" && !options.write.diff && !options.check) {
    if (c.now.deck().sources.size() == 1 && options.write.directory.empty()) {
      print_contents(c.now.deck().sources[0].bytes());
      return exit_clean;
    }
    print_error(options.common,
                "a deck from standard input has no name to write it to; without -o a deck of one "
                "file goes to standard output");
    return exit_usage;
  }
  run.changes.propose(member, c.now.deck(), c.changed);
  return exit_clean;
}

int convert(Run& run, const std::string& name, LoadedDeck loaded, Overlay overlay,
            const std::vector<LossEntry>& losses, const SchemaSet& schemas) {
  const Options& options = run.options;
  if (loaded.incomplete()) {
    run.refused = true;
    if (options.check) {
      run.check.add(name, ConversionCheck::Outcome::unreadable, {}, {},
                    "the include tree is not complete");
      return exit_input;
    }
    print_findings(loaded, options.common);
    print_error(options.common, loaded.path() + ": not written, the include tree is not complete");
    return exit_input;
  }
  const auto member = run.changes.add(loaded, name);
  if (!member) {
    run.refused = true;
    return fail(run, member.error());
  }
  Conversion c{std::move(loaded), std::move(overlay), losses, nullptr};
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
  if (code == exit_clean) code = add_result(run, *member, c, schemas);
  run.refused = run.refused || code != exit_clean;
  return code == exit_clean && open ? exit_findings : code;
}

/// One report of all decks: what they share is in it once.
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

/// The deck of one command line argument, whatever it is written in.
Result<std::pair<LoadedDeck, Overlay>> open_input(const std::string& path, const Options& options,
                                                  const SchemaSet& schemas, bool whole,
                                                  std::vector<LossEntry>& losses) {
  Overlay overlay;
  std::string main = path;
  if (options.from == "json") {
    auto files = files_of_json(*options.common.session, path, schemas, options.steps, losses);
    if (!files) return files.error();
    main = files->main;
    overlay = std::move(files->contents);
  }
  auto loaded = load(main, schemas, options.common, whole ? Stage::interfaces : Stage::deck,
                     options.from == "json" ? &overlay : nullptr);
  if (!loaded) return loaded.error();
  return std::pair(std::move(*loaded), std::move(overlay));
}

/// Reads and converts one deck.
int convert_one(Run& run, const std::string& path, const SchemaSet& schemas) {
  const Options& options = run.options;
  std::vector<LossEntry> losses;
  auto input =
      open_input(path, options, schemas, !run.steps.empty() || options.to == "json", losses);
  if (input)
    return convert(run, path, std::move(input->first), std::move(input->second), losses, schemas);
  run.refused = true;
  if (options.check || run.together)
    run.check.add(path, ConversionCheck::Outcome::unreadable, {}, {}, input.error().message);
  if (!options.check) print_error(options.common, input.error().message);
  const bool wrong = input.error().code == Error::Code::config && options.from == "rad";
  return wrong ? exit_usage : exit_input;
}

int check(const Options& options) {
  const auto refuse = [&](std::string_view why) {
    print_error(options.common, why);
    return static_cast<int>(exit_usage);
  };
  const int places = (options.write.directory.empty() ? 0 : 1) + (options.write.in_place ? 1 : 0) +
                     (options.write.diff ? 1 : 0);
  if (places > 1) return refuse("-o, --in-place and --diff exclude one another");
  const bool only_standard_input = options.common.decks == std::vector<std::string>{"-"};
  if (options.write.in_place &&
      std::count(options.common.decks.begin(), options.common.decks.end(), std::string("-")) > 0)
    return refuse("standard input cannot be rewritten; without --in-place the deck is printed");
  if (options.check && (options.to != "rad" || options.from != "rad"))
    return refuse("--check is about Starter decks; leave out --to and --from");
  if (options.check && options.write.diff) return refuse("--check and --diff exclude one another");
  if (places == 0 && options.to == "rad" && !only_standard_input && !options.check)
    return refuse(
        "say where to write: -o DIR, --in-place, or --diff or --check to see first what would "
        "happen");
  if (options.to == "json" && (options.write.in_place || options.write.diff))
    return refuse("--to json writes a new file: use -o, or standard output");
  if (options.from != "rad" && (options.write.in_place || options.write.diff))
    return refuse("--from " + options.from + " needs -o DIR");
  if (options.steps.round && options.from != "json") return refuse("--round goes with --from json");
  if (options.write.overwrite && options.write.directory.empty())
    return refuse("--overwrite goes with -o");
  if (!options.write.backup_suffix.empty() && !options.write.in_place)
    return refuse("--backup goes with --in-place");
  if (const std::string wrong = usage_error(options.write); !wrong.empty()) return refuse(wrong);
  return exit_clean;
}

/// What became of several decks: beside the files or the patch, which stand on standard output.
void tell_of_all(const Run& run) {
  print_messages(
      run.check.text(run.options.common.color_on(2), terminal_width(2),
                     run.refused ? ConversionCheck::Tense::can : ConversionCheck::Tense::was));
  print_loss_counts(run.losses);
}

int run(Options& options) {
  if (const int bad = check(options); bad != exit_clean) return bad;
  const auto schemas = load_schemas(options.common);
  if (!schemas) {
    print_error(options.common, schemas.error().message);
    return exit_usage;
  }
  auto steps = make_steps(options.steps);
  if (!steps) {
    print_error(options.common, steps.error().message);
    return exit_usage;
  }
  if (const int bad = check_outputs(options.common, {options.report}); bad != exit_clean)
    return bad;
  const std::string_view ending = options.from == "json" ? document_ending : deck_ending;
  Run work{options, std::move(*steps), Changes(options.common, options.write),
           Progress(!options.common.quiet)};
  const auto decks = work.changes.decks(options.common.decks, ending);
  if (!decks) {
    print_error(options.common, decks.error().message);
    return decks.error().code == Error::Code::config ? exit_usage : exit_input;
  }
  work.together =
      decks->size() > 1 && options.common.session->frame == nullptr && options.to == "rad";
  int worst = exit_clean;
  for (const std::string& path : *decks) {
    if (BatchFrame* frame = options.common.session->frame) frame->begin(path);
    const int code = convert_one(work, path, *schemas);
    if (BatchFrame* frame = options.common.session->frame) frame->end(code);
    worst = std::max(worst, code);
  }
  unite(work.losses);
  if (BatchFrame* frame = options.common.session->frame) frame->losses = work.losses;
  if (!work.refused)
    worst = std::max(worst, write_all(work));
  else if (decks->size() > 1 && !options.check)
    print_error(options.common, "nothing was written: the decks of a call are converted together");
  // What somebody has to decide.
  if (std::any_of(work.losses.begin(), work.losses.end(),
                  [](const LossEntry& e) { return e.loss == Loss::undecided; }))
    worst = std::max<int>(worst, exit_findings);
  if (options.check && !options.common.quiet)
    print_lines(work.check.text(options.common.color_on(1), text_width()));
  else if (work.together && !options.common.quiet)
    tell_of_all(work);
  if (!options.report.empty())
    if (auto done = options.common.session->write_output(options.report, losses_json(work.losses));
        !done)
      worst = std::max(worst, fail(work, done.error()));
  return worst;
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common, false);
  line.option("--to", options->to,
              "Format to write: rad (Starter deck), json (typed fields with effective values)")
      .one_of({"rad", "json"})
      .value("FORMAT");
  line.option("--from", options->from, "Format to read: rad, json (as written by --to json)")
      .one_of({"rad", "json"})
      .value("FORMAT");
  line.option("-o,--output", options->write.directory,
              "Directory to write to; made if missing. The include tree keeps its relative "
              "names. With --to json also FILE.json")
      .value("DIR");
  line.flag("--overwrite", options->write.overwrite,
            "With -o: replace decks and includes in DIR that differ (earlier results of the same "
            "files, if unchanged since, are replaced without it)");
  line.flag("--in-place", options->write.in_place, "Change the files of the deck");
  line.flag("--backup{.orig}", options->write.backup_suffix,
            "With --in-place: keep the old file under its name plus .orig (--backup=SUFFIX); a "
            "backup is never replaced, the next one is .orig.2");
  line.flag("--diff", options->write.diff,
            "Write nothing; print the changes as a unified diff that git apply takes");
  line.flag("--check", options->check,
            "Write nothing; say for how many decks it would work, and what they would lose: one "
            "line a cause with the number of decks. With -o or --in-place also whether that could "
            "be written");
  line.option("--report", options->report,
              "Loss report (JSON): every changed value with its place, and what was kept, "
              "approximated, dropped or undecided")
      .value("FILE");
  line.flag("--verify", options->verify,
            "Read the result back and compare: effective values, gaps, penetrations, actions, "
            "forces of the first cycle, masses, time steps; a result that differs is not written");
  line.flag("--no-verify", options->no_verify, "In a batch: do not verify");
  add_dependent_options(line, options->write);
  add_step_options(line, options->steps);
  line.existing("decks").describe("Starter decks, or directories: all *_0000.rad below them");
  return [options] {
    options->write.read_back = options->verifies();
    options->common.engine_files = options->to == "rad" && options->from == "rad";
    options->common.rewrites = options->write.in_place && !options->check;
    return run(*options);
  };
}

const VerbRegistration registration{
    {"convert", 50, "Write a deck in another version, unit system, layout or format",
     "  deck convert car_0000.rad -o copy                      the deck and its includes\n"
     "  deck convert car_0000.rad --version 2022 --diff        what another version would change\n"
     "  deck convert car_0000.rad --units kg,mm,ms -o metric --report losses.json\n"
     "  deck convert models/ --version 2026 --check            what a library would lose\n"
     "  deck convert car_0000.rad --resolve-defaults --in-place --backup\n"
     "  deck convert car_0000.rad --extract-contacts 7 -o bug  one interface and what it needs\n"
     "  deck convert car_0000.rad --to json -o car.json\n"
     "  deck convert car.json --from json -o back\n"
     "\n"
     "Conversions are done in the order of their options above, whatever their order on the\n"
     "command line. A conversion that would lose a value is refused with the place of the value\n"
     "(exit code 1), and nothing is written. If something was written but must be decided by "
     "hand,\n"
     "the exit code is 1 too.\n"
     "Several decks are converted together: a file that they share is read and written once. If\n"
     "they need different texts for it, nothing is written (exit code 2). Nothing is written\n"
     "if another program changed a file after it was read.\n"
     "Files that are included from above the deck's directory (#include ../common/x.inc) keep\n"
     "their place too: the deck is then written one or more directories further down.\n",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_convert
