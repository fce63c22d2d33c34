// deck show: an entity of a deck with card, effective values and users; the side view of a
// penetrating pair.

#include "inspect/shared/show.hpp"
#include "common.hpp"
#include "report/shared/inspection.hpp"
#include "report/shared/params_report.hpp"
#include "report/shared/side_view.hpp"

namespace deck::cli::verb_show {
namespace {

struct Options {
  CommonOptions common;
  std::string what;
  bool all = false, no_geometry = false, svg = false;
  std::int64_t interface = 0;
};

constexpr std::string_view pair_prefix = "pair:";

/// "pair:57/30-38-44-31": equation of the pair, with --svg its side view.
int show_pair(const Options& o) {
  const auto name = parse_pair(std::string_view(o.what).substr(pair_prefix.size()));
  if (!name) return failed(o.common, name.error());
  if (!o.common.json.empty())
    return failed(o.common,
                  "a pair is in the JSON of deck gaps --all; show has its side view (--svg)");
  return for_each_deck(o.common, [&](LoadedDeck& loaded) {
    SceneOptions options = loaded.scene_options();
    if (o.interface != 0) options.only = {o.interface};
    options.limits = o.common.limits;
    loaded.set_scene_options(options);
    const Scene& scene = loaded.scene();
    const auto pair = find_pair(scene, *name, o.interface);
    if (!pair) return failed(o.common, loaded.path() + ": " + o.what + ": " + pair.error().message);
    if (!o.common.wants_text()) return static_cast<int>(exit_clean);
    if (o.svg)
      print_text(side_view_svg(scene, *pair));
    else
      print_lines(side_view_text(scene, *pair));
    return static_cast<int>(exit_clean);
  });
}

int run(Options& o) {
  o.what = o.common.decks.back();
  o.common.decks.pop_back();
  if (o.what.starts_with(pair_prefix)) return show_pair(o);
  if (o.svg || o.interface != 0)
    return failed(o.common, std::string(o.svg ? "--svg" : "--interface") +
                                " belongs to a pair, such as pair:57/30-38-44-31");
  JsonOutput json(o.common, "deck/show", 1);
  const int code = for_each_deck(o.common, [&](LoadedDeck& loaded) {
    const auto entity = find_entity(loaded.deck(), loaded.model(), o.what);
    if (!entity) return failed(o.common, loaded.path() + ": " + entity.error().message);
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
  return json.write(code);
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  line.existing("decks")
      .expects(2, "DECK WHAT")
      .describe(
          "Starter deck (*_0000.rad), and what to show of it: the id of an interface, "
          "KEYWORD/ID, KIND:ID, or a pair that penetrates by its nodes: pair:57/30-38-44-31");
  line.flag("--svg", options->svg,
            "Of a pair: its side view to scale on standard output, gap, depth and what the solver "
            "does about it");
  line.option("--interface ID", options->interface,
              "Of a pair that penetrates in several interfaces: the one to show");
  line.flag("--all", options->all, "Every line and every user");
  line.flag("--no-geometry", options->no_geometry,
            "Do not derive default gaps from the mesh; such values are left open");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"show", 22, "One entity: its card by field, effective values, users and references",
     R"(  deck show car_0000.rad 3                   interface 3
  deck show car_0000.rad /GRNOD/PART/12
  deck show car_0000.rad node:5712           also part:4 shell:12 mat:1 set:9 ...
  deck show car_0000.rad pair:57/30-38-44-31 --svg > pair.svg
  deck show car_0000.rad 3 --json show.json)",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_show
