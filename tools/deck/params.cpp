// deck params: every interface with its effective values and where each came from.

#include <cstdio>

#include "common.hpp"
#include "deck/contact/scene.hpp"
#include "deck/report/params_report.hpp"

namespace {

using namespace deck;
using namespace deck::cli;

struct Options {
  CommonOptions common;
  bool changed = false;
  bool no_geometry = false;
};

/// True if some value waits for the geometry: a gap or a radiation distance left open.
bool needs_geometry(const Interfaces& interfaces) {
  bool needed = false;
  for (const InterBase* inter : interfaces.ordered)
    visit_interface(*inter, [&](const auto& t) {
      t.for_each([&](std::string_view name, const auto& e) {
        needed = needed || (e.origin == Origin::derived &&
                            (name == "Gapmin" || name == "Gap" || name == "Drad"));
      });
    });
  return needed;
}

std::vector<DerivedGap> derived_gaps(Loaded& loaded, const CommonOptions& options) {
  Progress progress(!options.quiet);
  progress.step("deriving gaps from the geometry");
  SceneOptions scene_options;
  scene_options.threads = options.thread_count();
  scene_options.candidates = false;
  scene_options.penetrations = false;
  scene_options.progress = [&](std::size_t done, std::size_t all) { progress.update(done, all); };
  const Scene scene =
      build_scene(loaded.model, loaded.interfaces, loaded.diagnostics, scene_options);
  std::vector<DerivedGap> out;
  for (const Contact& c : scene.contacts)
    if (!c.dropped) out.push_back({c.inter, to_string(c.role), c.gapmin, c.drad});
  return out;
}

int run(const Options& options) {
  const CommonOptions& common = options.common;
  JsonOutput json(common, "deck/params", 1);
  const int code = for_each_deck(common, Stage::interfaces, [&](Loaded& loaded) {
    ParamsInput input{loaded.path, &loaded.deck, &loaded.model, &loaded.interfaces, {}};
    if (!options.no_geometry && needs_geometry(loaded.interfaces))
      input.gaps = derived_gaps(loaded, common);
    const auto errors = print_findings(loaded, common);
    if (json.wanted()) json.add(params_json(input));
    if (common.wants_text()) {
      ParamsTextOptions text;
      text.color = common.color_on(1);
      text.changed_only = options.changed;
      print_text(params_text(input, text));
    }
    return errors > 0 ? exit_findings : exit_clean;
  });
  return json.finish(code);
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  line.flag("--changed", options->changed,
            "Show only fields whose effective value is not what the card says");
  add_require_examined(line, options->common);
  line.flag("--no-geometry", options->no_geometry,
            "Do not derive default gaps from the mesh; such values are left open");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"params", 20, "Effective values of every interface, and where each came from",
     "  deck params car_0000.rad\n"
     "  deck params car_0000.rad --changed         only what the solver fills in or overrules\n"
     "  deck params car_0000.rad --json params.json\n"
     "\n"
     "Origins: card, default-block (/DEFAULT/INTER), built-in (the solver's default),\n"
     "derived (follows from other values, from /FRICTION or from the mesh).\n"
     "1000 means 'nothing' (no deletion, constant gap, main stiffness only ...).\n",
     setup}};

}  // namespace
