// deck show: one entity of a deck, with its card, what the solver uses, and who uses it; of a pair
// or node why it is in contact or not.

#include "inspect/shared/show.hpp"
#include "common.hpp"
#include "report/shared/inspection.hpp"
#include "report/shared/params_report.hpp"

namespace deck::cli::verb_show {
namespace {

struct Options {
  CommonOptions common;
  std::string what;
  bool all = false, no_geometry = false;
  std::int64_t interface = 0;
};

constexpr std::string_view pair_prefix = "pair:", node_prefix = "node:";

ShowTextOptions text_options(const Options& o) {
  return {o.common.color_on(1), o.all, text_width()};
}

/// "pair:57/30-38-44-31", or "node:57" with --interface: why it is in contact or not.
int show_contact(const Options& o) {
  const std::string_view name = std::string_view(o.what).substr(pair_prefix.size());
  const bool is_pair = o.what.starts_with(pair_prefix);
  const auto pair = is_pair ? parse_pair(name) : PairName{};
  if (!pair) return failed(o.common, pair.error());
  if (!o.common.json.empty())
    return failed(o.common, "pairs are in the JSON of deck gaps --all; show has them as text");
  return for_each_deck(o.common, [&](LoadedDeck& loaded) {
    const InterBase* const inter = loaded.interfaces().find(o.interface);
    const std::string none = loaded.path() + ": there is no ";
    const NodeIndex node = loaded.model().find_node(read_integer(name).value);
    if (o.interface != 0 && inter == nullptr)
      return failed(o.common, none + "interface " + std::to_string(o.interface));
    if (!is_pair && node == no_index) return failed(o.common, none + o.what);
    SceneOptions options = loaded.scene_options();
    if (o.interface != 0) options.only = {o.interface};
    options.limits = o.common.limits;
    loaded.set_scene_options(options);
    const auto text = is_pair ? pair_text(loaded, *pair, o.interface, text_options(o))
                              : node_text(loaded, node, *inter, text_options(o));
    if (!text) return failed(o.common, loaded.path() + ": " + o.what + ": " + text.error().message);
    if (o.common.wants_text()) print_lines(*text);
    return static_cast<int>(exit_clean);
  });
}

int run(Options& o) {
  if (o.what.starts_with(pair_prefix) || (o.interface != 0 && o.what.starts_with(node_prefix)))
    return show_contact(o);
  if (o.interface != 0)
    return failed(o.common, "--interface goes with node:57 or pair:57/30-38-44-31");
  JsonOutput json(o.common, "deck/show", 1);
  const int code = for_each_deck(o.common, [&](LoadedDeck& loaded) {
    const auto entity = find_entity(loaded.deck(), loaded.model(), o.what);
    if (!entity) return failed(o.common, loaded.path() + ": " + entity.error().message);
    const EntityView view =
        view_entity(loaded.deck(), loaded.model(), loaded.interfaces(), *entity);
    ParamsInput params{loaded};
    if (!o.no_geometry && view.inter != nullptr) params.scene = &resolve_geometry(loaded, o.common);
    if (json.wanted()) json.add(show_json(params, view));
    if (o.common.wants_text()) print_lines(show_text(params, view, text_options(o)));
    return static_cast<int>(exit_clean);
  });
  return json.write(code);
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  line.existing("DECK").expects(1, "").one_each().describe("Starter deck (*_0000.rad)");
  line.option("WHAT", options->what,
              "What to show of it: the id of an interface, KEYWORD/ID, KIND:ID, or a pair by its "
              "nodes: pair:57/30-38-44-31")
      .value("")
      .required();
  line.option("--interface ID", options->interface,
              "Of a pair or a node: the interface to show it in. Of a node the segment nearest to "
              "contact, and why it is in contact or not");
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
  deck show car_0000.rad pair:57/30-38-44-31   its gap term by term
  deck show car_0000.rad node:57 --interface 3   why it is in contact, or not
  deck show car_0000.rad 3 --json show.json)",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_show
