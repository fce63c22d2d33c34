// deck params: every interface with its effective values and where each came from.

#include <cstdio>

#include "common.hpp"
#include "deck/report/params_report.hpp"

namespace {

using namespace deck;
using namespace deck::cli;

struct Options {
  CommonOptions common;
  bool changed = false;
  bool no_geometry = false;
};

int run(const Options& options) {
  const CommonOptions& common = options.common;
  JsonOutput json(common, "deck/params", 1);
  const int code = for_each_deck(common, Stage::interfaces, [&](Loaded& loaded) {
    ParamsInput input{loaded.path, &loaded.deck, &loaded.model, &loaded.interfaces, nullptr};
    Scene scene;
    if (!options.no_geometry) {
      scene = resolve_geometry(loaded, common);
      input.scene = &scene;
    }
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
