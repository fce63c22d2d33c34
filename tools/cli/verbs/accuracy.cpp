// deck accuracy: time and results of each --accuracy choice, on hard cases and on a deck.

#include "accuracy/shared/choice.hpp"

#include <algorithm>

#include "common.hpp"
#include "report/shared/accuracy.hpp"

namespace deck::cli::verb_accuracy {
namespace {

struct Options {
  CommonOptions common;
  HardCaseOptions hard;
  std::string html;
};

std::string command_of(const Options& o) {
  std::string out = "deck accuracy";
  for (const std::string& path : o.common.decks) out += " " + path;
  return out + " --samples " + std::to_string(o.hard.samples) + " --seed " +
         std::to_string(o.hard.seed) + " --repeats " + std::to_string(o.hard.repeats);
}

/// Runs all steps from file to table for each choice.
DeckPicture time_gaps(const Options& o, const std::string& path, Progress& progress,
                      AccuracyChoices& choices) {
  CommonOptions quiet = o.common;
  quiet.quiet = true;
  const auto schemas = load_schemas(quiet);
  if (!schemas) return {};
  progress.step("the deck in each accuracy");
  GapsTiming timing;
  timing.repeats = o.hard.repeats;
  timing.least = 1;
  timing.most = 6;
  timing.exact = 10;
  timing.progress = [&](std::uint64_t done, std::uint64_t all) { progress.update(done, all); };
  return measure_deck(
      [&](Accuracy accuracy, const std::function<bool()>& exact_over,
          const std::function<void(const Scene&)>& add_scene) {
        const auto loaded = load(path, *schemas, quiet);
        if (!loaded) return;
        SceneOptions options = loaded->scene_options();
        options.accuracy = accuracy;
        options.exact_over = exact_over;
        options.nodal_stiffness = false;
        Findings ignored;
        add_scene(loaded->scene_with(options, ignored));
      },
      timing, choices);
}

/// Wrong decisions of `robust` are findings.
bool robust_is_wrong(const AccuracyChoices& choices) {
  return std::any_of(choices.begin(), choices.end(), [](const AccuracyChoice& c) {
    return c.accuracy == Accuracy::robust &&
           (c.hard.wrong > 0 || (c.deck && !c.deck->wrong.empty()));
  });
}

/// Writes the files and the table.
int show(const Options& o, const AccuracyChoices& choices, const AccuracyContext& context,
         JsonOutput& json) {
  if (json.wanted()) json.add(accuracy_json(choices, context));
  if (!o.html.empty())
    if (const auto written =
            o.common.session->write_output(o.html, accuracy_html(choices, context));
        !written) {
      return failed(o.common, written.error());
    }
  if (o.common.wants_text() && o.html != "-")
    print_lines(accuracy_text(choices, context, o.common.color_on(1), text_width()));
  return robust_is_wrong(choices) ? exit_findings : exit_clean;
}

int run(const Options& o) {
  if (const int bad = check_outputs(o.common, {o.common.json, o.html}); bad != exit_clean)
    return bad;
  JsonOutput json(o.common, "deck/accuracy", 2);
  AccuracyContext context;
  context.processor = processor_name();
  context.command = command_of(o);
  if (!o.html.empty() && o.common.decks.size() > 1)
    return failed(o.common, "--html takes one deck at a time");
  Progress progress(!o.common.quiet);
  progress.step("the hard cases in each accuracy");
  HardCaseOptions hard = o.hard;
  hard.progress = [&](std::uint64_t done, std::uint64_t all) { progress.update(done, all); };
  AccuracyChoices choices = measure_hard_cases(hard);
  progress.clear();
  if (o.common.decks.empty()) return json.write(show(o, choices, context, json));
  return json.write(for_each_deck(o.common, [&](LoadedDeck& loaded) {
    print_findings(loaded, o.common);
    context.picture = time_gaps(o, loaded.path(), progress, choices);
    progress.clear();
    context.path = loaded.path();
    context.deck = &loaded.deck();
    return show(o, choices, context, json);
  }));
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  line.existing("DECK").required(false).any_number().describe(
      "Starter decks (*_0000.rad) to be measured beside the built-in hard cases; without: the hard "
      "cases alone");
  line.option("--samples", options->hard.samples, "Pairs per kind of hard cases")
      .range(std::size_t{1}, std::size_t{10000000})
      .show_default();
  line.option("--seed", options->hard.seed, "Seed of the hard cases").show_default();
  line.option("--repeats", options->hard.repeats, "Timings of each accuracy")
      .range(1, 1000)
      .show_default();
  line.option("--html FILE", options->html,
              "Write a page to FILE: time and mistakes of each setting");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"accuracy", 60, "What each --accuracy costs in time and gets wrong, on hard cases and a deck",
     R"(  deck accuracy
  deck accuracy car_0000.rad
  deck accuracy car_0000.rad --html accuracy.html
  deck accuracy car_0000.rad --json accuracy.json)",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_accuracy
