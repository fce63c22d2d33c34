// deck convert: writes a deck again — as it is, or after one or more conversions. Every conversion
// sees the deck as the one before left it; nothing is written before all of them have succeeded.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <tuple>

#include "common.hpp"
#include "convert_steps.hpp"
#include "deck/base/escape.hpp"
#include "deck/contact/scene.hpp"
#include "deck/edit/edit_set.hpp"
#include "deck/edit/rewrite.hpp"
#include "deck/edit/write.hpp"
#include "deck/report/deck_json.hpp"
#include "deck/report/losses.hpp"
#include "deck/text/number.hpp"

namespace {

using namespace deck;
using namespace deck::cli;
namespace fs = std::filesystem;

struct Options {
  CommonOptions common;
  ConvertSteps steps;
  std::string to = "rad", from = "rad";
  std::string directory, report, backup_suffix;
  bool in_place = false, backup = false, diff = false, overwrite = false;
};

/// A deck on its way through the conversions.
struct Conversion {
  std::unique_ptr<Loaded> now;
  Overlay changed;  ///< contents that differ from the files on disk
  std::vector<LossEntry> losses;
};

void print_refusals(const CommonOptions& common, const std::vector<std::string>& refusals) {
  constexpr std::size_t most = 20;
  for (std::size_t i = 0; i < std::min(most, refusals.size()); ++i)
    print_error(common, refusals[i]);
  if (refusals.size() > most)
    print_error(common, fmt::format("... and {} more", refusals.size() - most));
}

/// A refusal ("file:line:column: /KEYWORD/id field: why") as an entry of the report.
LossEntry refused_entry(const std::string& refusal) {
  LossEntry entry;
  entry.loss = Loss::undecided;
  entry.note = refusal;
  const auto end = refusal.find(": /");
  const auto column = end == refusal.npos || end == 0 ? end : refusal.rfind(':', end - 1);
  const auto line = column == refusal.npos || column == 0 ? column : refusal.rfind(':', column - 1);
  if (line == refusal.npos) return entry;
  const IntegerCell number =
      read_integer(std::string_view(refusal).substr(line + 1, column - line - 1));
  if (number.status != NumberStatus::ok || number.value < 0) return entry;
  entry.file = refusal.substr(0, line);
  entry.line = static_cast<std::uint64_t>(number.value);
  const auto keyword = end + 2, colon = refusal.find(": ", keyword);
  if (colon == refusal.npos) return entry;
  entry.note = refusal.substr(colon + 2);
  std::string what = refusal.substr(keyword, colon - keyword);
  if (const auto blank = what.find(' '); blank != what.npos) {
    entry.field = what.substr(blank + 1);
    what.resize(blank);
  }
  const auto slash = what.rfind('/');
  const IntegerCell id = read_integer(std::string_view(what).substr(slash + 1));
  if (slash > 0 && id.status == NumberStatus::ok) {
    entry.id = id.value;
    what.resize(slash);
  }
  entry.keyword = what;
  return entry;
}

/// One conversion, and the deck read again as it is then. An exit code if that failed.
int apply(Conversion& c, const ConvertStep& step, const SchemaSet& schemas,
          const CommonOptions& common) {
  const EditContext context{c.now->deck, c.now->model, c.now->interfaces, schemas};
  Rewrite rewrite = step.run(context);
  for (LossEntry& e : rewrite.losses) c.losses.push_back(std::move(e));
  if (!rewrite.refusals.empty()) {
    print_refusals(common, rewrite.refusals);
    for (const std::string& r : rewrite.refusals) c.losses.push_back(refused_entry(r));
    print_error(common, c.now->path + ": " + step.option + " was not done; nothing was written" +
                            (step.way_out.empty() ? "" : ". " + step.way_out));
    return exit_findings;
  }
  if (!common.quiet)
    for (const std::string& note : rewrite.notes)
      print_note(std::string(step.option) + ": " + note);
  auto files = apply_rewrite(c.now->deck.sources, rewrite);
  if (!files) {
    print_error(common, files.error().message);
    return exit_findings;
  }
  if (files->empty()) return exit_clean;
  if (c.now->path == "-" && !c.changed.contains("-"))  // it cannot be read twice
    c.changed["-"] = std::string(c.now->deck.sources[0].bytes());
  for (auto& [path, text] : *files) c.changed[path] = std::move(text);
  auto again = load(c.now->path, schemas, common, Stage::interfaces, &c.changed);
  if (!again) {
    print_error(common, again.error().message);
    return exit_internal;
  }
  c.now = std::move(*again);
  return exit_clean;
}

/// Counts for people; what was lost or waits for a decision line by line.
void print_losses(const std::vector<LossEntry>& losses, const CommonOptions& common) {
  if (common.quiet || losses.empty()) return;
  std::size_t count[4] = {};
  constexpr std::size_t most = 40;
  std::size_t shown = 0, hidden = 0;
  for (const LossEntry& e : losses) {
    ++count[static_cast<std::size_t>(e.loss)];
    if (e.loss == Loss::kept) continue;
    if (shown++ >= most) {
      ++hidden;
      continue;
    }
    constexpr std::string_view names[] = {"kept", "approximated", "dropped", "undecided"};
    const std::string line = fmt::format(
        "{}:{}: {}: {}/{} {}{}{}{}{}", e.file, e.line, names[static_cast<std::size_t>(e.loss)],
        e.keyword, e.id, e.field, e.old_text.empty() ? "" : " " + e.old_text,
        e.new_text.empty() ? "" : " -> " + e.new_text, e.note.empty() ? "" : ": ", e.note);
    fmt::print(stderr, "{}\n", terminal_text(line));
  }
  if (hidden > 0) fmt::print(stderr, "... and {} more; --report FILE lists all\n", hidden);
  fmt::print(stderr, "deck: kept {}, approximated {}, dropped {}, undecided {}\n", count[0],
             count[1], count[2], count[3]);
}

/// All decks of the call: converted one after the other, written together or not at all.
struct Run {
  const Options& options;
  const std::vector<ConvertStep> steps;
  EditSet set = {};
  std::map<fs::path, std::pair<std::string, std::string>> documents = {};  ///< JSON: deck, text
  std::vector<LossEntry> losses = {};
  bool refused = false;  ///< nothing may be written
};

// ---- where it goes ---------------------------------------------------------------------------

int fail(const Run& run, const Error& error) {
  print_error(run.options.common, error.message);
  return exit_usage;
}

void list(const Run& run, const std::vector<OutputFile>& files) {
  if (run.options.common.quiet) return;
  for (const OutputFile& f : files) print_text(terminal_text(f.path) + "\n");
}

int write_in_place(const Run& run) {
  const auto plan = run.set.in_place();
  if (!plan) return fail(run, plan.error());
  WriteOptions write;
  write.backup_suffix = run.options.backup ? run.options.backup_suffix : "";
  if (auto done = write_files_atomic(plan->files, write); !done) return fail(run, done.error());
  list(run, plan->files);
  return exit_clean;
}

int write_tree(const Run& run) {
  const auto plan = run.set.tree(run.options.directory);
  if (!plan) return fail(run, plan.error());
  OutputRules rules;
  rules.deck_tree = true;
  rules.overwrite = run.options.overwrite;
  if (auto done = write_outputs(plan->files, rules); !done) return fail(run, done.error());
  for (const std::string& path : plan->outside)
    print_note(path + " is included by its absolute path and was not copied");
  list(run, plan->files);
  return exit_clean;
}

int write_documents(const Run& run) {
  std::vector<OutputFile> files;
  for (const auto& [target, document] : run.documents)
    files.push_back({target.string(), document.second});
  if (auto done = write_outputs(files); !done) return fail(run, done.error());
  list(run, files);
  return exit_clean;
}

int write_all(const Run& run) {
  const Options& options = run.options;
  if (!run.documents.empty()) return write_documents(run);
  if (options.to == "json" || options.from == "lsdyna") return exit_clean;
  if (options.in_place) return write_in_place(run);
  if (!options.directory.empty()) return write_tree(run);
  if (!options.diff) return exit_clean;  // standard input, which went to standard output
  const auto patch = run.set.diff();
  if (!patch) return fail(run, patch.error());
  print_contents(*patch);
  return exit_clean;
}

/// The deck in JSON: printed, or kept until all decks of the call are ready.
int add_document(Run& run, const Conversion& c) {
  resolve_geometry(*c.now, run.options.common);
  const auto document =
      deck_to_json({c.now->path, &c.now->deck, &c.now->model, &c.now->interfaces});
  if (!document) return fail(run, document.error());
  if (run.options.directory.empty() || run.options.directory == "-") {
    print_text(*document);
    return exit_clean;
  }
  fs::path target(run.options.directory);
  if (target.extension() != ".json")
    target /= c.now->path == "-" ? "stdin.json" : fs::path(c.now->path).stem().string() + ".json";
  const auto [it, is_new] =
      run.documents.emplace(target.lexically_normal(), std::pair(c.now->path, *document));
  if (is_new) return exit_clean;
  print_error(run.options.common, "both " + it->second.first + " and " + c.now->path +
                                      " would be written to " + target.string());
  return exit_usage;
}

/// What the deck has become goes into the set.
int add_result(Run& run, std::size_t member, Conversion& c) {
  const Options& options = run.options;
  if (options.to == "json") return add_document(run, c);
  if (c.now->path == "-" && options.from == "rad" && !options.diff) {
    if (c.now->deck.sources.size() == 1 && options.directory.empty()) {
      print_contents(c.now->deck.sources[0].bytes());
      return exit_clean;
    }
    print_error(options.common,
                "a deck from standard input has no name to write it to; without -o a deck of one "
                "file goes to standard output");
    return exit_usage;
  }
  run.set.propose(member, c.now->deck, c.changed);
  return exit_clean;
}

int convert(Run& run, const std::string& name, std::unique_ptr<Loaded> loaded, Overlay overlay,
            const SchemaSet& schemas) {
  const Options& options = run.options;
  if (loaded->incomplete()) {
    print_findings(*loaded, options.common);
    print_error(options.common, loaded->path + ": not written, the include tree is not complete");
    return exit_input;
  }
  const auto member = run.set.add(loaded->deck, name);
  if (!member) return fail(run, member.error());
  Conversion c;
  c.now = std::move(loaded);
  c.changed = std::move(overlay);
  int code = exit_clean;
  for (const ConvertStep& step : run.steps) {
    code = apply(c, step, schemas, options.common);
    if (code != exit_clean) break;
  }
  if (code == exit_clean) print_losses(c.losses, options.common);
  for (LossEntry& e : c.losses) run.losses.push_back(std::move(e));
  return code != exit_clean ? code : add_result(run, *member, c);
}

/// One report of all decks: what they share is in it once.
void unite(std::vector<LossEntry>& losses) {
  std::set<std::tuple<std::string, std::uint64_t, std::string, std::int64_t, std::string,
                      std::string, std::string, std::string, Loss>>
      seen;
  std::erase_if(losses, [&](const LossEntry& e) {
    const std::string file = fs::path(e.file).lexically_normal().string();
    return !seen.emplace(file, e.line, e.keyword, e.id, e.field, e.old_text, e.new_text, e.note,
                         e.loss)
                .second;
  });
}

/// The deck of one command line argument, whatever it is written in.
Result<std::pair<std::unique_ptr<Loaded>, Overlay>> open_input(const std::string& path,
                                                               const Options& options,
                                                               const SchemaSet& schemas,
                                                               bool whole) {
  Overlay overlay;
  std::string main = path;
  if (options.from == "json") {
    auto files = files_of_json(path, schemas);
    if (!files) return files.error();
    main = files->main;
    overlay = std::move(files->contents);
  }
  auto loaded = load(main, schemas, options.common, whole ? Stage::interfaces : Stage::blocks,
                     options.from == "json" ? &overlay : nullptr);
  if (!loaded) return loaded.error();
  return std::pair(std::move(*loaded), std::move(overlay));
}

int check(const Options& options) {
  const auto refuse = [&](std::string_view why) {
    print_error(options.common, why);
    return static_cast<int>(exit_usage);
  };
  const int places =
      (options.directory.empty() ? 0 : 1) + (options.in_place ? 1 : 0) + (options.diff ? 1 : 0);
  if (places > 1) return refuse("-o, --in-place and --diff exclude one another");
  const bool only_standard_input = options.common.decks == std::vector<std::string>{"-"};
  if (places == 0 && options.to == "rad" && options.from != "lsdyna" && !only_standard_input)
    return refuse("say where to write: -o DIR, --in-place, or --diff to look at it first");
  if (options.to == "json" && (options.in_place || options.diff))
    return refuse("--to json writes a new file: use -o, or standard output");
  if (options.from != "rad" && (options.in_place || options.diff))
    return refuse("--from " + options.from + " needs -o DIR");
  if (options.from == "lsdyna" && options.to == "json")
    return refuse("--from lsdyna makes an include file of contacts, not a deck; it has no JSON");
  if (options.steps.target != 0 && options.from != "lsdyna")
    return refuse("--target goes with --from lsdyna");
  if (options.overwrite && options.directory.empty()) return refuse("--overwrite goes with -o");
  if (options.backup && !options.in_place) return refuse("--backup goes with --in-place");
  return exit_clean;
}

int run(const Options& options) {
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
  Run work{options, std::move(*steps)};
  int worst = exit_clean;
  for (const std::string& path : options.common.decks) {
    if (options.from == "lsdyna") {
      std::vector<LossEntry> losses;
      worst = std::max(worst, convert_lsdyna(path, options.steps, options.directory, options.common,
                                             *schemas, losses));
      print_losses(losses, options.common);
      for (LossEntry& e : losses) work.losses.push_back(std::move(e));
      continue;
    }
    auto input = open_input(path, options, *schemas, !work.steps.empty() || options.to == "json");
    if (!input) {
      print_error(options.common, input.error().message);
      const bool wrong = input.error().code == Error::Code::config && options.from == "rad";
      worst = std::max<int>(worst, wrong ? exit_usage : exit_input);
      work.refused = true;
      continue;
    }
    const int code =
        convert(work, path, std::move(input->first), std::move(input->second), *schemas);
    work.refused = work.refused || code != exit_clean;
    worst = std::max(worst, code);
  }
  if (!work.refused)
    worst = std::max(worst, write_all(work));
  else if (options.common.decks.size() > 1)
    print_error(options.common, "nothing was written: the decks of a call are converted together");
  unite(work.losses);
  const bool open = std::any_of(work.losses.begin(), work.losses.end(), [](const LossEntry& e) {
    return e.loss == Loss::undecided;
  });
  if (open) worst = std::max<int>(worst, exit_findings);
  if (!options.report.empty()) {
    if (auto done = write_output(options.report, losses_json(work.losses)); !done) {
      print_error(options.common, done.error().message);
      worst = std::max<int>(worst, exit_usage);
    }
  }
  return worst;
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common, false);
  line.option("--to", options->to,
              "Format to write: rad (Starter deck), json (typed fields with effective values)")
      .one_of({"rad", "json"})
      .value("FORMAT");
  line.option("--from", options->from,
              "Format to read: rad, json (as written by --to json), lsdyna (contact keywords "
              "only)")
      .one_of({"rad", "json", "lsdyna"})
      .value("FORMAT");
  line.option("-o,--output", options->directory,
              "Directory to write to; made if missing. The include tree keeps its relative "
              "names. With --to json also FILE.json")
      .value("DIR");
  line.flag("--overwrite", options->overwrite,
            "With -o: replace decks and includes that lie in DIR already and differ");
  line.flag("--in-place", options->in_place, "Change the files of the deck");
  line.flag("--backup{.orig}", options->backup_suffix,
            "With --in-place: keep the old file under its name plus .orig (--backup=SUFFIX); a "
            "backup is never replaced, the next one is .orig.2");
  line.flag("--diff", options->diff,
            "Write nothing; print the changes as a unified diff that git apply takes");
  line.option("--report", options->report,
              "Loss report (JSON): what was kept, approximated, dropped, left undecided")
      .value("FILE");
  add_step_options(line, options->steps);
  return [options] {
    options->backup = !options->backup_suffix.empty();
    options->common.rewrites = options->in_place;
    return run(*options);
  };
}

const VerbRegistration registration{
    {"convert", 50, "Write a deck in another version, unit system, layout or format",
     "  deck convert car_0000.rad -o copy                      the deck and its includes\n"
     "  deck convert car_0000.rad --version 2022 --diff        what another version would change\n"
     "  deck convert car_0000.rad --units kg,mm,ms -o metric --report losses.json\n"
     "  deck convert car_0000.rad --resolve-defaults --in-place --backup\n"
     "  deck convert car_0000.rad --extract-contacts 7 -o bug  one interface and what it needs\n"
     "  deck convert car_0000.rad --to json -o car.json\n"
     "  deck convert car.json --from json -o back\n"
     "  deck convert car.k --from lsdyna -o contacts           car_contacts.inc\n"
     "\n"
     "Conversions are done in the order of their options above, whatever their order on the\n"
     "command line. A conversion that would lose a value is refused with the place of the value\n"
     "(exit code 1); nothing is written then. What was written and is left for somebody to decide\n"
     "gives exit code 1 as well.\n"
     "Several decks are converted together: a file that they share is read and written once, and\n"
     "if they want different texts for it nothing is written (exit code 2). Nothing is written\n"
     "either where a file was changed by somebody else since it was read.\n"
     "Files that are included from above the deck's directory (#include ../common/x.inc) keep\n"
     "their place too: the deck is then written one or more directories further down.\n",
     setup}};

}  // namespace
