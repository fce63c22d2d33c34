// deck params: effective values of every interface, with their origins.

#include "common.hpp"
#include "report/shared/params_report.hpp"

namespace deck::cli::verb_params {
namespace {

struct Options {
  CommonOptions common;
  bool changed = false, filled_in = false, matrix = false;
  bool no_geometry = false;
  std::vector<std::int64_t> only;
  std::string csv;
};

int write(const Options& o, const std::string& text) {
  if (auto written = o.common.session->write_output(o.csv, text); !written)
    return failed(o.common, written.error());
  return exit_clean;
}

int run(const Options& options) {
  const CommonOptions& common = options.common;
  if (!options.csv.empty() && common.decks.size() > 1 && options.csv != "-")
    return failed(common, "--csv FILE takes one deck at a time");
  if (const int bad = check_outputs(common, {common.json, options.csv}); bad != exit_clean)
    return bad;
  JsonOutput json(common, "deck/params", 1);
  const int code = for_each_deck(common, [&](LoadedDeck& loaded) {
    if (auto known =
            check_interfaces(loaded, options.only, "--interface", Examined::contacts_and_ties);
        !known) {
      return failed(common, known.error());
    }
    ParamsInput input{loaded};
    if (!options.no_geometry) input.scene = &resolve_geometry(loaded, common);
    loaded.findings(Stage::cells);
    const auto errors = print_findings(loaded, common);
    if (json.wanted()) json.add(params_json(input, options.only));
    ParamsTextOptions text;
    text.changed_only = options.changed;
    text.filled_in_only = options.filled_in;
    text.only = options.only;
    if (!options.csv.empty())
      if (const int bad = write(
              options, options.matrix ? params_matrix_csv(input, text) : params_csv(input, text));
          bad != exit_clean)
        return bad;
    if (common.wants_text() && options.csv != "-") {
      text.color = common.color_on(1);
      text.width = text_width();
      text.one_table = !options.matrix && options.only.empty() && !options.changed &&
                       !options.filled_in && loaded.interfaces().ordered.size() > 5;
      print_lines(options.matrix || text.one_table ? params_matrix(input, text)
                                                   : params_text(input, text));
    }
    return static_cast<int>(errors > 0 ? exit_findings : exit_clean);
  });
  return json.write(code);
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  line.option("--interface ID", options->only, "Only these interface ids").by_commas();
  line.flag("--matrix", options->matrix,
            "One row per interface, one column per field; the default for more than five "
            "interfaces, with the columns that fit");
  line.flag("--changed", options->changed,
            "Show only fields that are written on the card and are not the default");
  line.flag("--filled-in", options->filled_in,
            "Show only fields whose effective value is not the value on the card");
  line.option("--csv FILE", options->csv,
              "Write one line per interface and field (with --matrix: per interface) to FILE ('-': "
              "standard output)");
  add_require_examined(line, options->common);
  line.flag("--no-geometry", options->no_geometry,
            "Do not derive default gaps from the mesh; such values are shown as 0");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"params", 20, "Effective values of every interface, and where each came from",
     R"(  deck params car_0000.rad
  deck params car_0000.rad --matrix          one row per interface
  deck params car_0000.rad --changed         only values on the card that are not the default
  deck params car_0000.rad --filled-in       only values that the solver fills in or replaces
  deck params car_0000.rad --interface 3,4 --csv params.csv
  deck params car_0000.rad --json params.json

Origins: card, default-block (/DEFAULT/INTER), built-in (the solver's default),
derived (follows from other values, from /FRICTION or from the mesh).
1000 means 'nothing' (no deletion, constant gap, main stiffness only ...).)",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_params
