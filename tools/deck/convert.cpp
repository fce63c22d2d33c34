// deck convert: writes a deck again — as it is, or after one or more conversions. Every conversion
// sees the deck as the one before left it; nothing is written before all of them have succeeded.
#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>

#include "common.hpp"
#include "convert_steps.hpp"
#include "deck/edit/rewrite.hpp"
#include "deck/edit/write.hpp"
#include "deck/report/deck_json.hpp"
#include "deck/report/losses.hpp"
#include "deck/text/edits.hpp"
#include "tree.hpp"

namespace {

using namespace deck;
using namespace deck::cli;
namespace fs = std::filesystem;

struct Options {
  CommonOptions common;
  ConvertSteps steps;
  std::string to = "rad", from = "rad";
  std::string directory, report, backup_suffix;
  bool in_place = false, backup = false, diff = false;
};

/// A deck on its way through the conversions.
struct Conversion {
  std::unique_ptr<Loaded> now;
  std::map<std::string, std::string> before;  ///< first contents of the files that changed, by path
  Overlay changed;                            ///< contents that differ from the files on disk
  std::vector<LossEntry> losses;
};

void print_refusals(const CommonOptions& common, const std::vector<std::string>& refusals) {
  constexpr std::size_t most = 20;
  for (std::size_t i = 0; i < std::min(most, refusals.size()); ++i)
    print_error(common, refusals[i]);
  if (refusals.size() > most)
    print_error(common, fmt::format("... and {} more", refusals.size() - most));
}

/// One conversion, and the deck read again as it is then. An exit code if that failed.
int apply(Conversion& c, const ConvertStep& step, const SchemaSet& schemas,
          const CommonOptions& common) {
  const EditContext context{c.now->deck, c.now->model, c.now->interfaces, schemas};
  Rewrite rewrite = step.run(context);
  for (LossEntry& e : rewrite.losses) c.losses.push_back(std::move(e));
  if (!rewrite.refusals.empty()) {
    print_refusals(common, rewrite.refusals);
    print_error(common, c.now->path + ": " + step.option + " was not done; nothing was written" +
                            (step.way_out.empty() ? "" : ". " + step.way_out));
    return exit_findings;
  }
  if (!common.quiet)
    for (const std::string& note : rewrite.notes)
      fmt::print(stderr, "deck: note: {}: {}\n", step.option, note);
  auto files = apply_rewrite(c.now->deck.sources, rewrite);
  if (!files) {
    print_error(common, files.error().message);
    return exit_findings;
  }
  if (files->empty()) return exit_clean;
  const SourceSet& sources = c.now->deck.sources;
  for (std::uint32_t f = 0; f < sources.size(); ++f)
    if (files->contains(sources[f].path())) c.before.emplace(sources[f].path(), sources[f].bytes());
  if (c.now->path == "-" && !c.changed.contains("-"))  // it cannot be read twice
    c.changed["-"] = std::string(sources[0].bytes());
  for (auto& [path, text] : *files) c.changed[path] = std::move(text);
  auto again = load(c.now->path, schemas, common, Stage::interfaces, &c.changed);
  if (!again) {
    print_error(common, again.error().message);
    return exit_internal;
  }
  c.now = std::move(*again);
  return exit_clean;
}

// ---- where it goes ---------------------------------------------------------------------------

int write_diff(const Conversion& c) {
  std::string text;
  for (const auto& [path, before] : c.before)
    text += unified_diff(path, before, c.changed.at(path));
  print_text(text);
  return exit_clean;
}

int write_in_place(const Conversion& c, const Options& options) {
  std::vector<OutputFile> files;
  for (const auto& [path, before] : c.before) files.push_back({path, c.changed.at(path)});
  WriteOptions write;
  write.backup_suffix = options.backup ? options.backup_suffix : "";
  if (auto done = write_files_atomic(files, write); !done) {
    print_error(options.common, done.error().message);
    return exit_usage;
  }
  if (!options.common.quiet)
    for (const OutputFile& f : files) print_text(f.path + "\n");
  return exit_clean;
}

int write_tree(const Conversion& c, const Options& options,
               std::map<fs::path, std::string>& written) {
  const auto tree = lay_out(c.now->deck, options.directory, c.changed);
  if (!tree) {
    print_error(options.common, tree.error().message);
    return exit_usage;
  }
  std::vector<OutputFile> files;
  for (const TreeFile& f : tree->files) {
    const auto [it, is_new] = written.emplace(f.target.lexically_normal(), f.source);
    if (!is_new && it->second != f.source) {
      print_error(options.common, "both " + it->second + " and " + f.source +
                                      " would be written to " + f.target.string());
      return exit_usage;
    }
    files.push_back({f.target.string(), f.bytes});
  }
  if (auto done = write_files_atomic(files); !done) {
    print_error(options.common, done.error().message);
    return exit_usage;
  }
  for (const std::string& path : tree->outside)
    fmt::print(stderr, "deck: note: {} is included by its absolute path and was not copied\n",
               path);
  if (!options.common.quiet)
    for (const OutputFile& f : files) print_text(f.path + "\n");
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
    fmt::print(stderr, "{}:{}: {}: {}/{} {}{}{}{}{}\n", e.file, e.line,
               names[static_cast<std::size_t>(e.loss)], e.keyword, e.id, e.field,
               e.old_text.empty() ? "" : " " + e.old_text,
               e.new_text.empty() ? "" : " -> " + e.new_text, e.note.empty() ? "" : ": ", e.note);
  }
  if (hidden > 0) fmt::print(stderr, "... and {} more; --report FILE lists all\n", hidden);
  fmt::print(stderr, "deck: kept {}, approximated {}, dropped {}, undecided {}\n", count[0],
             count[1], count[2], count[3]);
}

struct Run {
  const Options& options;
  const std::vector<ConvertStep> steps;
  std::map<fs::path, std::string> written;
  std::vector<LossEntry> losses;
};

int write_result(Run& run, Conversion& c) {
  const Options& options = run.options;
  if (options.to == "json") {
    const auto document =
        deck_to_json({c.now->path, &c.now->deck, &c.now->model, &c.now->interfaces});
    if (!document) {
      print_error(options.common, document.error().message);
      return exit_usage;
    }
    const std::string& text = *document;
    if (options.directory.empty()) {
      print_text(text);
      return exit_clean;
    }
    fs::path target(options.directory);
    if (target.extension() != ".json")
      target /= c.now->path == "-" ? "stdin.json" : fs::path(c.now->path).stem().string() + ".json";
    const auto [it, is_new] = run.written.emplace(target.lexically_normal(), c.now->path);
    if (!is_new) {
      print_error(options.common, "both " + it->second + " and " + c.now->path +
                                      " would be written to " + target.string());
      return exit_usage;
    }
    if (auto done = write_files_atomic({{target.string(), text}}); !done) {
      print_error(options.common, done.error().message);
      return exit_usage;
    }
    if (!options.common.quiet) print_text(target.string() + "\n");
    return exit_clean;
  }
  if (options.diff) return write_diff(c);
  if (c.now->path == "-" && options.from == "rad") {
    if (c.now->deck.sources.size() == 1 && options.directory.empty()) {
      print_text(c.now->deck.sources[0].bytes());
      return exit_clean;
    }
    print_error(options.common,
                "a deck from standard input has no name to write it to; without -o a deck of one "
                "file goes to standard output");
    return exit_usage;
  }
  if (options.in_place) return write_in_place(c, options);
  return write_tree(c, options, run.written);
}

int convert(Run& run, std::unique_ptr<Loaded> loaded, Overlay overlay, const SchemaSet& schemas) {
  const Options& options = run.options;
  if (loaded->incomplete()) {
    print_findings(*loaded, options.common);
    print_error(options.common, loaded->path + ": not written, the include tree is not complete");
    return exit_input;
  }
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
  if (code != exit_clean) return code;
  return write_result(run, c);
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
  Run work{options, std::move(*steps), {}, {}};
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
      worst = std::max<int>(worst, exit_input);
      continue;
    }
    worst =
        std::max(worst, convert(work, std::move(input->first), std::move(input->second), *schemas));
  }
  if (!options.report.empty()) {
    if (auto done = write_output(options.report, losses_json(work.losses)); !done) {
      print_error(options.common, done.error().message);
      worst = std::max<int>(worst, exit_usage);
    }
  }
  return worst;
}

Action setup(CLI::App& app) {
  auto options = std::make_shared<Options>();
  add_common(app, options->common, false);
  app.add_option("--to", options->to,
                 "Format to write: rad (Starter deck), json (typed fields with effective values)")
      ->check(CLI::IsMember({"rad", "json"}))
      ->type_name("FORMAT");
  app.add_option("--from", options->from,
                 "Format to read: rad, json (as written by --to json), lsdyna (contact keywords "
                 "only)")
      ->check(CLI::IsMember({"rad", "json", "lsdyna"}))
      ->type_name("FORMAT");
  app.add_option("-o,--output", options->directory,
                 "Directory to write to; made if missing. The include tree keeps its relative "
                 "names. With --to json also FILE.json")
      ->type_name("DIR");
  app.add_flag("--in-place", options->in_place, "Change the files of the deck");
  app.add_flag("--backup{.orig}", options->backup_suffix,
               "With --in-place: keep the old file under its name plus .orig (--backup=SUFFIX)");
  app.add_flag("--diff", options->diff,
               "Write nothing; print the changes as a unified diff that git apply takes");
  app.add_option("--report", options->report,
                 "Loss report (JSON): what was kept, approximated, dropped, left undecided")
      ->type_name("FILE");
  add_step_options(app, options->steps);
  return [options] {
    options->backup = !options->backup_suffix.empty();
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
     "(exit code 1); nothing is written then.\n"
     "Files that are included from above the deck's directory (#include ../common/x.inc) keep\n"
     "their place too: the deck is then written one or more directories further down.\n",
     setup}};

}  // namespace
