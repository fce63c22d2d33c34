// deck parts: mass, smallest time step and interfaces of each part.

#include "report/shared/parts.hpp"
#include "common.hpp"
#include "deck/report.hpp"
#include "verbs/gap_page.hpp"

namespace deck::cli::verb_parts {
namespace {

struct Options {
  CommonOptions common;
  bool all = false;
  std::string csv, html;
};

Result<void> write_html(const Options& o, LoadedDeck& loaded) {
  HtmlInput input;
  input.parts = &loaded;
  auto page = gap_page(loaded, input);
  if (!page) return page.error();
  return o.common.session->write_output(o.html, *page);
}

/// Error for conflicting options.
Result<void> check_options(const Options& o) {
  if (!o.csv.empty() && o.common.decks.size() > 1 && o.csv != "-")
    return config_error("--csv FILE takes one deck at a time");
  return check_html(o.common, o.html);
}

int run(const Options& options) {
  const CommonOptions& common = options.common;
  if (const auto legal = check_options(options); !legal) return failed(common, legal.error());
  if (const int bad = check_outputs(common, {common.json, options.csv, options.html});
      bad != exit_clean)
    return bad;
  JsonOutput json(common, "deck/parts", 1);
  const int code = for_each_deck(common, [&](LoadedDeck& loaded) {
    loaded.findings(Stage::interfaces);
    const auto errors = print_findings(loaded, common);
    if (json.wanted()) json.add(parts_json(loaded, options.all));
    if (!options.csv.empty())
      if (auto written = options.common.session->write_output(options.csv, parts_csv(loaded));
          !written)
        return failed(common, written.error());
    if (!options.html.empty())
      if (auto written = write_html(options, loaded); !written)
        return failed(common, written.error());
    if (common.wants_text() && options.csv != "-" && options.html != "-") {
      PartsTextOptions text;
      text.color = common.color_on(1);
      text.width = text_width();
      text.all = options.all;
      print_lines(parts_text(loaded, text));
    }
    return static_cast<int>(errors > 0 ? exit_findings : exit_clean);
  });
  return json.write(code);
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  line.flag("--all", options->all,
            "With --json: the time step of every element, and step, mass and stiffness of every "
            "node");
  line.option("--csv FILE", options->csv, "Write one line per part to FILE ('-': standard output)");
  line.option(
      "--html FILE", options->html,
      "Write a page with the table of the parts and a picture coloured by time step to FILE");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"parts", 22, "Parts with mass, smallest time step and the interfaces that see them",
     R"(  deck parts car_0000.rad
  deck parts car_0000.rad --csv parts.csv
  deck parts car_0000.rad --html parts.html
  deck parts car_0000.rad --json parts.json        also kinematic conditions
  deck parts car_0000.rad --all --json parts.json  every element and node

Time steps and masses are those that the solver lists at the start, without a factor.
What cannot be computed is left blank, and named below the table.)",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_parts
