// deck replay: the contact kernel on recorded pair states, held against the recorded forces.

#include <algorithm>

#include "common.hpp"
#include "deck/cycle/adapter.hpp"
#include "report/shared/cycle.hpp"

namespace deck::cli::verb_replay {
namespace {

struct Options {
  CommonOptions common;
  std::string states, csv;
  std::int64_t interface_id = 0;
  std::string model = "reference";
};

/// The contact whose states are recorded: edges for edge states of a TYPE19, else the first.
const Contact* contact_of(const Scene& scene, bool edges) {
  for (const Contact& c : scene.contacts)
    if (!c.dropped && (c.kind == deck::ContactKind::edge_edge) == edges) return &c;
  return nullptr;
}

int run_deck(const Options& o, std::string_view csv, LoadedDeck& loaded, JsonOutput& json) {
  const auto& all = loaded.interfaces().ordered;
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const InterBase* i) { return i->id == o.interface_id; });
  if (auto known = check_interfaces(loaded, {o.interface_id}, "--interface"); !known) {
    print_error(o.common, known.error().message);
    return exit_usage;
  }
  SceneOptions scene_options = loaded.scene_options();
  scene_options.only = {o.interface_id};
  scene_options.penetrations = scene_options.candidates = scene_options.nodal_stiffness = false;
  loaded.set_scene_options(scene_options);
  const Scene& scene = loaded.scene();
  const std::string_view header = std::string_view(csv).substr(0, csv.find('\n'));
  const bool edges = header.find("hs1") != std::string_view::npos;  // also in heat of edges
  const Contact* contact = contact_of(scene, edges);
  if (contact == nullptr) {
    print_error(o.common, o.states + ": the states do not fit the type of interface " +
                              std::to_string(o.interface_id));
    return exit_usage;
  }
  cycle::ReplayOptions options;
  options.interface_id = static_cast<int>(o.interface_id);
  options.model = o.model == "robust" ? cycle::Model::robust : cycle::Model::reference;
  options.scene = &scene;
  options.csv = !o.csv.empty();
  const auto report = cycle::replay(cycle::make_card(scene, *contact), csv, options);
  if (!report.error.empty()) {
    print_error(o.common, o.states + ": " + report.error);
    return exit_input;
  }
  if (report.records == 0) {
    print_error(o.common,
                o.states + ": no state belongs to interface " + std::to_string(o.interface_id));
    return exit_input;
  }
  if (options.csv)
    if (auto r = o.common.session->write_output(o.csv, report.csv); !r) {
      print_error(o.common, r.error().message);
      return exit_usage;
    }
  const ReplayInput input{loaded.path(), o.states, &loaded.deck(), *found, options.model};
  if (json.wanted()) json.add(replay_json(input, report));
  if (o.common.wants_text() && o.csv != "-") print_lines(replay_text(input, report));
  return exit_clean;
}

int run(Options& o) {
  o.states = o.common.decks.back();
  o.common.decks.pop_back();
  const auto source = Source::open_text(o.states, Limits{});
  if (!source) {
    print_error(o.common, source.error().message);
    return exit_input;
  }
  o.common.session->remember_read(**source);
  JsonOutput json(o.common, "deck/replay", 1);
  const int code = for_each_deck(o.common, [&](LoadedDeck& loaded) {
    print_findings(loaded, o.common);
    return run_deck(o, (*source)->bytes(), loaded, json);
  });
  return json.finish(code);
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  line.existing("decks")
      .takes(2, "DECK STATES")
      .describe("Starter deck (*_0000.rad), and recorded states: CSV, also compressed (.gz)");
  line.option("--interface", options->interface_id, "Interface whose states are replayed")
      .required()
      .value("ID");
  line.option("--model", options->model, "reference or robust")
      .one_of({"reference", "robust"})
      .show_default();
  line.option("--csv", options->csv,
              "Writes every result column of STATES as computed here, one line per state of the "
              "interface, preceded by the 0-based number of its data line (- for standard output)")
      .value("FILE");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"replay", 45, "Contact kernel on recorded pair states, compared with the recorded forces",
     "  deck replay car_0000.rad --interface 3 states.csv.gz\n"
     "  deck replay car_0000.rad --interface 3 states.csv.gz --json replay.json\n"
     "  deck replay car_0000.rad --interface 3 states.csv.gz --csv computed.csv\n",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_replay
