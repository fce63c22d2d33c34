// deck accuracy: what each word of --accuracy costs in time and gives, on the hard cases and on a
// deck.

#include "accuracy/shared/accuracy.hpp"

#include <algorithm>

#include "common.hpp"
#include "processor.hpp"
#include "report/shared/accuracy.hpp"
#include "verbs/accuracy/accuracy_cache.hpp"

namespace deck::cli::verb_accuracy {
namespace {

/// Pairs of a deck for each sample of a kind of hard cases.
constexpr std::size_t pairs_of_deck = 5;

struct Options {
  CommonOptions common;
  std::size_t samples = 1000;
  int repeats = 5;
  std::uint64_t seed = 1;
  bool again = false;
  std::string html;

  /// Number types and formulas are wanted as well, which take longer than all decisions.
  bool all() const { return common.verbose || !common.json.empty() || !html.empty(); }
};

std::string command_of(const Options& o) {
  std::string out = "deck accuracy";
  for (const std::string& path : o.common.decks) out += " " + path;
  return out + " --samples " + std::to_string(o.samples) + " --seed " + std::to_string(o.seed) +
         " --repeats " + std::to_string(o.repeats);
}

/// The rows of the whole geometry stage: everything between the file and the table, in each
/// accuracy.
void time_gaps(const Options& o, const std::string& path, Progress& progress,
               AccuracyReport& report) {
  CommonOptions quiet = o.common;
  quiet.quiet = true;
  const auto schemas = load_schemas(quiet);
  if (!schemas) return;
  progress.step("the deck in each accuracy");
  GapsTiming timing;
  timing.repeats = o.repeats;
  timing.least = 1;
  timing.most = 6;
  timing.progress = [&](std::uint64_t done, std::uint64_t all) { progress.update(done, all); };
  measure_gaps(
      [&](Accuracy accuracy) {
        const auto loaded = load(path, *schemas, quiet);
        if (!loaded) return Scene();
        SceneOptions options = loaded->scene_options();
        options.accuracy = accuracy;
        options.nodal_stiffness = false;
        Diagnostics ignored;
        return loaded->scene_with(options, ignored);
      },
      timing, report);
}

AccuracyReport measure_hard_cases(const Options& o, bool decisions_only, Progress& progress) {
  progress.step("the hard cases in each accuracy");
  return measured_hard_cases(
      {o.samples, o.seed, o.repeats, decisions_only, o.again},
      [&](std::uint64_t done, std::uint64_t all) { progress.update(done, all); });
}

/// The deck in each accuracy and, where asked for, its pairs in all number types.
AccuracyReport measure_deck(const Options& o, LoadedDeck& loaded, Progress& progress) {
  SceneOptions scene_options = loaded.scene_options();
  scene_options.penetrations = scene_options.candidates = scene_options.nodal_stiffness = false;
  loaded.set_scene_options(scene_options);
  const auto pairs = scene_pairs(loaded.scene(), pairs_of_deck * o.samples, scene_options.threads);
  AccuracyReport report;
  report.scene = "deck";
  if (pairs.empty()) return report;
  if (o.all()) {
    progress.step("pairs of the deck in all number types");
    AccuracyOptions options;
    options.repeats = o.repeats;
    options.progress = [&](std::uint64_t done, std::uint64_t all) { progress.update(done, all); };
    report = measure_accuracy(pairs, options);
    report.kinds.clear();
  }
  time_gaps(o, loaded.path(), progress, report);
  return report;
}

bool robust_is_wrong(const AccuracyReport& report) {
  return std::any_of(report.tiers.begin(), report.tiers.end(), [](const TierResult& t) {
    return t.name == "robust" && t.decision_errors + t.non_finite > 0;
  });
}

/// Writes the files and the table. Wrong decisions of the robust tier are findings.
int show(const Options& o, const AccuracyReport& report, const AccuracyContext& context,
         JsonOutput& json) {
  if (json.wanted()) json.add(accuracy_json(report, context));
  if (!o.html.empty())
    if (const auto written = o.common.session->write_output(o.html, accuracy_html(report, context));
        !written) {
      print_error(o.common, written.error().message);
      return exit_usage;
    }
  if (o.common.wants_text() && o.html != "-")
    print_lines(
        accuracy_text(report, context, o.common.color_on(1), text_width(), o.common.verbose));
  const bool wrong =
      robust_is_wrong(report) || (context.hard != nullptr && robust_is_wrong(*context.hard));
  return wrong ? exit_findings : exit_clean;
}

int run(const Options& o) {
  if (const int bad = check_outputs(o.common, {o.common.json, o.html}); bad != exit_clean)
    return bad;
  JsonOutput json(o.common, "deck/accuracy", 1);
  AccuracyContext context;
  context.processor = processor_name();
  context.command = command_of(o);
  if (!o.html.empty() && o.common.decks.size() > 1) {
    print_error(o.common, "--html takes one deck at a time");
    return exit_usage;
  }
  const bool deck = !o.common.decks.empty();
  Progress progress(!o.common.quiet);
  const AccuracyReport hard = measure_hard_cases(o, deck || !o.all(), progress);
  progress.clear();
  if (!deck) return json.finish(show(o, hard, context, json));
  context.hard = &hard;
  const int code = for_each_deck(o.common, [&](LoadedDeck& loaded) {
    print_findings(loaded, o.common);
    const AccuracyReport report = measure_deck(o, loaded, progress);
    progress.clear();
    context.path = loaded.path();
    context.deck = &loaded.deck();
    return show(o, report, context, json);
  });
  return json.finish(code);
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  line.existing("decks").required(false).any_number().describe(
      "Starter decks (*_0000.rad) to be measured beside the built-in hard cases; without: the hard "
      "cases alone");
  line.option("--samples", options->samples,
              "Pairs per kind of hard cases; number types are compared on 5 times as many pairs of "
              "a deck")
      .range(std::size_t{1}, std::size_t{10000000})
      .show_default();
  line.option("--seed", options->seed, "Seed of the hard cases").show_default();
  line.option("--repeats", options->repeats, "Timings of each accuracy and number type")
      .range(1, 1000)
      .show_default();
  line.flag("--again", options->again,
            "Measure the hard cases again instead of taking the result of an earlier run from the "
            "user's cache directory");
  line.option("--html", options->html,
              "Write the choices, kinds and charts to FILE: one page, no network")
      .value("FILE");
  add_verbose(line, options->common, "Also number types, formulas and kinds of hard cases");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"accuracy", 60, "What each --accuracy costs in time and gets wrong, on hard cases and a deck",
     "  deck accuracy\n"
     "  deck accuracy car_0000.rad\n"
     "  deck accuracy car_0000.rad --html accuracy.html\n"
     "  deck accuracy car_0000.rad --json accuracy.json\n",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_accuracy
