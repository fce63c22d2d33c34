// deck show: one entity of a deck, with its card, what the solver uses, and who uses it.

#include "deck/inspect/show.hpp"
#include "common.hpp"
#include "deck/report/show.hpp"

namespace deck::cli::verb_show {
namespace {

struct Options {
  CommonOptions common;
  std::string what;
  bool all = false, no_geometry = false;
};

int run(Options& o) {
  o.what = o.common.decks.back();
  o.common.decks.pop_back();
  JsonOutput json(o.common, "deck/show", 1);
  const int code = for_each_deck(o.common, [&](LoadedDeck& loaded) {
    const auto entity = find_entity(loaded.deck(), loaded.model(), o.what);
    if (!entity) {
      print_error(o.common, loaded.path() + ": " + entity.error().message);
      return static_cast<int>(exit_usage);
    }
    const EntityView view =
        view_entity(loaded.deck(), loaded.model(), loaded.interfaces(), *entity);
    ParamsInput params{loaded};
    if (!o.no_geometry && view.inter != nullptr) params.scene = &resolve_geometry(loaded, o.common);
    if (json.wanted()) json.add(show_json(params, view));
    if (o.common.wants_text()) {
      ShowTextOptions text;
      text.color = o.common.color_on(1);
      text.all = o.all;
      text.width = text_width();
      print_lines(show_text(params, view, text));
    }
    return static_cast<int>(exit_clean);
  });
  return json.finish(code);
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  line.existing("decks")
      .takes(2, "DECK WHAT")
      .describe(
          "Starter deck (*_0000.rad), and what to show of it: the id of an interface, "
          "KEYWORD/ID or KIND:ID");
  line.flag("--all", options->all, "Every line and every user");
  line.flag("--no-geometry", options->no_geometry,
            "Do not derive default gaps from the mesh; such values are left open");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"show", 22, "One entity: its card by field, effective values, users and references",
     "  deck show car_0000.rad 3                   interface 3\n"
     "  deck show car_0000.rad /GRNOD/PART/12\n"
     "  deck show car_0000.rad node:5712           also part:4 shell:12 mat:1 set:9 ...\n"
     "  deck show car_0000.rad 3 --json show.json\n",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_show
