// deck accuracy: what accuracy costs in time, on the hard cases or on the pairs of a deck.

#include "deck/accuracy/accuracy.hpp"
#include "common.hpp"
#include "deck/report/accuracy.hpp"
#include "processor.hpp"

namespace deck::cli::verb_accuracy {
namespace {

struct Options {
  CommonOptions common;
  std::size_t samples = 1000;
  int repeats = 5;
  std::uint64_t seed = 1;
  std::string html;
};

std::string command_of(const Options& o) {
  std::string out = "deck accuracy";
  for (const std::string& path : o.common.decks) out += " " + path;
  return out + " --samples " + std::to_string(o.samples) + " --seed " + std::to_string(o.seed) +
         " --repeats " + std::to_string(o.repeats);
}

/// The rows of the whole geometry stage: everything between the file and the table, in each
/// accuracy.
void time_gaps(const Options& o, const std::string& path, AccuracyReport& report) {
  CommonOptions quiet = o.common;
  quiet.quiet = true;
  const auto schemas = load_schemas(quiet);
  if (!schemas) return;
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
      o.repeats, report);
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
    print_lines(accuracy_text(report, context, o.common.color_on(1), text_width()));
  for (const TierResult& t : report.tiers)
    if (t.name == "robust" && t.decision_errors + t.non_finite > 0) return exit_findings;
  return exit_clean;
}

int run(const Options& o) {
  if (const int bad = check_outputs(o.common, {o.common.json, o.html}); bad != exit_clean)
    return bad;
  JsonOutput json(o.common, "deck/accuracy", 1);
  AccuracyOptions accuracy;
  accuracy.repeats = o.repeats;
  AccuracyContext context;
  context.processor = processor_name();
  context.command = command_of(o);
  if (o.common.decks.empty()) {
    std::vector<PairSample> samples;
    for (const HardFamily& f : hard_families()) {
      const auto some = hard_cases(f.id, o.samples, o.seed);
      samples.insert(samples.end(), some.begin(), some.end());
    }
    return json.finish(show(o, measure_accuracy(samples, accuracy), context, json));
  }
  if (!o.html.empty() && o.common.decks.size() > 1) {
    print_error(o.common, "--html takes one deck at a time");
    return exit_usage;
  }
  const int code = for_each_deck(o.common, [&](LoadedDeck& loaded) {
    print_findings(loaded, o.common);
    SceneOptions scene_options = loaded.scene_options();
    scene_options.penetrations = scene_options.candidates = scene_options.nodal_stiffness = false;
    loaded.set_scene_options(scene_options);
    const Scene& scene = loaded.scene();
    // As many pairs as the hard cases would have.
    const std::size_t limit = 40 * o.samples;
    const auto pairs = scene_pairs(scene, limit, scene_options.threads);
    context.path = loaded.path();
    context.deck = &loaded.deck();
    AccuracyReport report = measure_accuracy(pairs, accuracy);
    if (!pairs.empty()) time_gaps(o, loaded.path(), report);
    return show(o, report, context, json);
  });
  return json.finish(code);
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  line.existing("decks").required(false).any_number().describe(
      "Starter decks (*_0000.rad) whose candidate pairs are measured; without: the built-in hard "
      "cases");
  line.option("--samples", options->samples,
              "Pairs per family of hard cases; for a deck, 40 times as many in total")
      .range(std::size_t{1}, std::size_t{10000000})
      .show_default();
  line.option("--seed", options->seed, "Seed of the hard cases").show_default();
  line.option("--repeats", options->repeats, "Timings per tier; the median counts")
      .range(1, 1000)
      .show_default();
  line.option("--html", options->html, "Write chart and table to FILE: one page, no network")
      .value("FILE");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"accuracy", 60, "What accuracy costs in time: float to exact, on hard cases or a deck",
     "  deck accuracy\n"
     "  deck accuracy --samples 5000 --html accuracy.html\n"
     "  deck accuracy car_0000.rad --json accuracy.json\n",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_accuracy
