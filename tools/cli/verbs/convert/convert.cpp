// deck convert: writes a deck again — as it is, or after one or more conversions. Nothing is
// written before all conversions of all decks have succeeded.
#include <algorithm>
#include <set>
#include <tuple>

#include "base/shared/paths.hpp"
#include "library.hpp"
#include "report/shared/deck_json.hpp"
#include "verbs/convert/convert_run.hpp"

namespace deck::cli::verb_convert {
namespace {

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
  if (options.verify && options.no_verify)
    return refuse("--verify and --no-verify exclude one another");
  return exit_clean;
}

/// What became of several decks: beside the files or the patch, which stand on standard output.
void tell_of_all(const ConvertRun& run) {
  print_messages(
      run.check.text(run.options.common.color_on(2), terminal_width(2),
                     run.refused ? ConversionCheck::Tense::can : ConversionCheck::Tense::was));
  print_loss_counts(run.losses);
}

int run(ConvertOptions& options) {
  if (const int bad = check(options); bad != exit_clean) return bad;
  const auto schemas = load_schemas(options.common);
  if (!schemas) return failed(options.common, schemas.error().message);
  auto steps = make_steps(options.steps);
  if (!steps) return failed(options.common, steps.error().message);
  if (const int bad = check_outputs(options.common, {options.report}); bad != exit_clean)
    return bad;
  ConvertRun work{options, std::move(*steps), Changes(options.common, options.write),
                  Progress(!options.common.quiet)};
  const auto decks = work.changes.decks(options.common.decks);
  if (!decks)
    return failed(options.common, decks.error().message,
                  decks.error().code == Error::Code::config ? exit_usage : exit_input);
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
  auto options = std::make_shared<ConvertOptions>();
  add_common(line, options->common, false);
  line.option("--to", options->to,
              "Format to write: rad (Starter deck), json (typed fields with effective values)")
      .one_of({"rad", "json"})
      .value("FORMAT");
  line.flag("--check", options->check,
            "Write nothing; say for how many decks it would work, and what they would lose: one "
            "line a cause with the number of decks. With -o or --in-place also whether that could "
            "be written");
  line.option("--report", options->report,
              "Loss report (JSON): every changed value with its place, and what was kept, "
              "approximated, dropped or undecided")
      .value("FILE");
  line.flag("--verify", options->verify,
            "The default. After every conversion the deck is read again and compared with the deck "
            "before: effective values, gaps, penetrations, actions, forces of the first cycle, "
            "masses, time steps; a result that differs is not written");
  line.flag("--no-verify", options->no_verify, "Do not compare the result with the deck before");
  add_write_options(line, options->write);
  line.existing("--output")
      .describe(
          "Directory to write to; made if missing. The include tree keeps its relative names. With "
          "--to json also FILE.json");
  add_step_options(line, options->steps);
  line.existing("decks").describe("Starter decks, or directories: all *_0000.rad below them");
  return [options] {
    options->write.read_back = options->verifies();
    options->common.engine_files = options->to == "rad";
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
