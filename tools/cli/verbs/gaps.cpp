// deck gaps: gaps, stiffness, initial penetrations and what the solver does about them.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "common.hpp"
#include "contact/shared/what_if_text.hpp"
#include "deck/contact/view.hpp"
#include "deck/report/gaps.hpp"
#include "deck/report/html.hpp"
#include "report/shared/json.hpp"
#include "report/shared/vtk.hpp"
#include "text/shared/gzip.hpp"
#include "verbs/accuracy_option.hpp"
#include "verbs/gate/options.hpp"

namespace deck::cli::verb_gaps {
namespace {

struct Options {
  CommonOptions common;
  bool all = false;
  bool fail = false;
  bool crossings = false;
  std::size_t worst = 20;
  std::string csv, ties_csv, html, svg, vtk, write_baseline, accuracy = "robust";
  GateOptions gate;
  std::vector<std::int64_t> only;
  std::vector<std::string> what_if;
};

/// Refuses --interface and --what-if that do not fit the deck.
Result<void> check_options(const Options& o, const LoadedDeck& loaded,
                           const std::vector<WhatIf>& what_if) {
  if (auto known = check_interfaces(loaded, o.only, "--interface", Examined::contacts_and_ties);
      !known)
    return known;
  for (const WhatIf& w : what_if) {
    if (auto known = check_interfaces(loaded, {w.interface_id}, "--what-if"); !known) return known;
    for (const InterBase* inter : loaded.interfaces().ordered)
      if (inter->id == w.interface_id)
        if (auto fits = check_what_if(w, *inter); !fits) return fits;
  }
  return {};
}

/// Writes the VTK files: into the directory itself, or one below it per deck if there are several.
Result<void> write_vtk(const Options& o, const LoadedDeck& loaded, const Scene& scene,
                       const SceneView& view) {
  namespace fs = std::filesystem;
  fs::path directory = o.vtk;
  if (o.common.decks.size() > 1) directory /= fs::path(without_gz(loaded.path())).stem();
  const std::vector<VtkFile> written = gaps_vtk(scene, view);
  std::vector<OutputFile> files;
  for (const VtkFile& f : written) files.push_back({(directory / f.name).string(), f.bytes});
  const VtkFile script = paraview_script(written);
  files.push_back({(directory / script.name).string(), script.bytes});
  return o.common.session->write_outputs(files, {}, {"", true, true, true, o.vtk});
}

/// What page and drawing are made from.
HtmlInput page_input(const LoadedDeck& loaded, const SceneView& view) {
  HtmlInput input;
  input.path = loaded.path();
  input.deck = &loaded.deck();
  input.scene = &loaded.scene();
  input.view = &view;
  input.what_if = loaded.scene_options().what_if;
  input.only = loaded.scene_options().only;
  input.threads = loaded.options().threads;
  return input;
}

/// Writes the HTML report; what can be wrong is wrong usage or a file.
Result<void> write_html(const Options& o, const LoadedDeck& loaded, const SceneView& view,
                        const std::vector<Crossing>& crossings, const GateReport& gate) {
  HtmlInput input = page_input(loaded, view);
  input.cycle = &loaded.cycle().outcome;
  input.acted = acted_in_page(loaded.cycle().state, loaded.cycle().outcome);
  input.crossings = &crossings;
  input.earlier = gate.earlier;
  auto page = gaps_html(input);
  if (!page) return page.error();
  return o.common.session->write_output(o.html, *page);
}

int run(const Options& o) {
  if (std::string why; !o.html.empty() && !html_available(&why)) {
    print_error(o.common, "--html: this build has no viewer: " + why);
    return exit_usage;
  }
  if (auto legal = check_fail_on(o.gate); !legal) {
    print_error(o.common, legal.error().message);
    return exit_usage;
  }
  if (o.fail && (o.gate.fails_on("never") || o.gate.fails_on("error"))) {
    print_error(o.common, "--fail-on-penetration and --fail-on " + o.gate.level() +
                              " contradict one another");
    return exit_usage;
  }
  if ((!o.html.empty() || !o.svg.empty()) && o.common.decks.size() > 1) {
    print_error(o.common, "--html and --svg take one deck at a time");
    return exit_usage;
  }
  if (const int bad = check_outputs(
          o.common, {o.common.json, o.csv, o.ties_csv, o.html, o.svg, o.write_baseline});
      bad != exit_clean)
    return bad;
  SceneOptions scene_options;
  scene_options.threads = o.common.thread_count();
  scene_options.only = o.only;
  scene_options.accuracy = accuracy_of(o.accuracy);
  scene_options.limits = o.common.limits;
  scene_options.ties = true;
  for (const std::string& text : o.what_if) {
    auto w = parse_what_if(text);
    if (!w) {
      print_error(o.common, w.error().message);
      return exit_usage;
    }
    scene_options.what_if.push_back(*w);
  }
  JsonOutput json(o.common, "deck/gaps", 1);
  CommonOptions baseline_common = o.common;
  baseline_common.json = o.write_baseline;
  JsonOutput baseline(baseline_common, "deck/gaps", 1);
  GateOptions gate_options = o.gate;
  if (baseline.wanted()) {  // which replaces the old one
    gate_options.baseline.clear();
    gate_options.no_config = true;
  }
  if (baseline.wanted())
    if (auto kept = keeps_other_decks(o.write_baseline, o.common.decks); !kept) {
      print_error(o.common, kept.error().message);
      return exit_usage;
    }
  bool first = true;
  int code = for_each_deck(o.common, [&](LoadedDeck& loaded) {
    if (auto fits = check_options(o, loaded, scene_options.what_if); !fits) {
      print_error(o.common, fits.error().message);
      return static_cast<int>(exit_usage);
    }
    auto gate = gate_of(gate_options, loaded, o.common);
    if (!gate) {
      print_error(o.common, gate.error().message);
      return static_cast<int>(exit_usage);
    }
    {
      Progress progress(!o.common.quiet);
      progress.step("contacts");
      const bool forces = !o.html.empty() || gate->gate.needs_forces();
      scene_options.nodal_stiffness = (o.all && json.wanted()) || forces;
      scene_options.progress = [&](std::size_t done, std::size_t total) {
        progress.update(done, total);
      };
      loaded.set_scene_options(scene_options);
      loaded.findings();
    }
    const Scene& scene = loaded.scene();
    const std::vector<Crossing> crossings = find_crossings(scene, scene_options.threads);
    const SceneView view = make_view(scene, &crossings, scene_options.threads);
    const GateReport report = gate->look(
        loaded, scene, view, gate->gate.needs_forces() ? &loaded.cycle().outcome : nullptr);
    print_findings(loaded, o.common);
    if (json.wanted())
      json.add([&](const TextDrain& drain) {
        return gaps_json(loaded.path(), loaded.deck(), scene, view, o.all,
                         o.crossings ? &crossings : nullptr, &report, drain);
      });
    if (baseline.wanted())
      baseline.add(gaps_json(name_in_baseline(loaded.path(), o.write_baseline), loaded.deck(),
                             scene, view, false));
    if (!o.csv.empty())
      if (auto r = o.common.session->write_output(
              o.csv,
              [&](const TextDrain& drain) { return gaps_csv(loaded.deck(), scene, view, drain); });
          !r) {
        print_error(o.common, r.error().message);
        return static_cast<int>(exit_usage);
      }
    if (!o.ties_csv.empty())
      if (auto r = o.common.session->write_output(
              o.ties_csv,
              [&](const TextDrain& drain) { return ties_csv(loaded.deck(), scene, drain); });
          !r) {
        print_error(o.common, r.error().message);
        return static_cast<int>(exit_usage);
      }
    if (!o.vtk.empty())
      if (auto r = write_vtk(o, loaded, scene, view); !r) {
        print_error(o.common, r.error().message);
        return static_cast<int>(exit_usage);
      }
    if (!o.html.empty())
      if (auto r = write_html(o, loaded, view, crossings, report); !r) {
        print_error(o.common, r.error().message);
        return static_cast<int>(exit_usage);
      }
    if (!o.svg.empty())
      if (auto r = o.common.session->write_output(o.svg, touches_svg(page_input(loaded, view)));
          !r) {
        print_error(o.common, r.error().message);
        return static_cast<int>(exit_usage);
      }
    if (o.common.wants_text() && o.csv != "-" && o.ties_csv != "-" && o.html != "-" &&
        o.svg != "-") {
      GapsTextOptions text;
      text.worst = o.worst;
      text.color = o.common.color_on(1);
      text.verbose = o.common.verbose;
      text.width = text_width();
      if (o.common.decks.size() > 1) text.name = loaded.path();
      if (o.crossings) text.crossings = &crossings;
      text.gate = &report;
      print_lines((first ? "" : "\n") + gaps_text(loaded.deck(), scene, view, text));
      first = false;
    }
    const bool accepted = baseline.wanted() || (gate->baseline && o.gate.level().empty());
    const int decided =
        verdict_code(verdict_of(loaded.deck(), scene, view), o.gate, o.common, o.fail, accepted);
    return report.passed() ? decided : static_cast<int>(exit_findings);
  });
  return baseline.finish(json.finish(code));
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  allow_directories(line);
  line.flag("--all", options->all,
            "JSON with every secondary node, main segment and edge, not only penetrations");
  line.option("--csv", options->csv,
              "Write one line per penetration to FILE ('-': standard output)")
      .value("FILE");
  line.option("--ties-csv", options->ties_csv,
              "Write one line per secondary node of every TYPE2 to FILE ('-': standard output)")
      .value("FILE");
  line.flag("--crossings", options->crossings,
            "List the crossed elements: edges of the secondary side through main segments");
  line.option("--svg", options->svg,
              "Draw the parts and their contacts to FILE, red if they penetrate")
      .value("FILE");
  line.option("--vtk", options->vtk,
              "Write the contacts and penetrations as VTK files into DIR, with a script that opens "
              "them in ParaView")
      .value("DIR");
  line.option("--html", options->html,
              "Write the interactive report to FILE: one page, no network needed")
      .value("FILE");
  add_accuracy(line, options->accuracy);
  line.option("--worst", options->worst, "Rows of the list of deepest penetrations").show_default();
  line.option("--interface", options->only, "Only these interface ids").by_commas().value("ID");
  add_require_examined(line, options->common);
  add_verbose(line, options->common,
              "Every interface, the parts of a TYPE19 in separate rows, and more columns");
  line.option("--what-if", options->what_if,
              "Evaluate an interface with other values, e.g. 3:Gapmin=2,Inacti=6 (repeatable); "
              "the deck is not changed")
      .value("ID:FIELD=VALUE,...");
  line.flag("--fail-on-penetration", options->fail,
            "Exit 1 for any initial penetration, as --fail-on warning");
  add_gate_with_config(line, options->gate, "the solver stops",
                       "any initial penetration, crossed element, or node that is not tied");
  line.option("--baseline", options->gate.baseline,
              "Accept the penetrations in FILE, of the decks listed there: only new and worse ones "
              "exit with 1")
      .value("FILE");
  line.option("--write-baseline", options->write_baseline,
              "Write all penetrations to FILE as a baseline")
      .value("FILE");
  return [options] {
    const int wrong = open_directories(options->common);
    return wrong != exit_clean ? wrong : run(*options);
  };
}

const VerbRegistration registration{
    {"gaps", 30, "Gaps, stiffness and initial penetrations of every contact",
     "  deck gaps car_0000.rad\n"
     "  deck gaps car_0000.rad --html gaps.html\n"
     "  deck gaps car_0000.rad --json gaps.json --all\n"
     "  deck gaps car_0000.rad --what-if 3:Gapmin=1.5,Inacti=6\n"
     "  deck gaps car_0000.rad --max-depth 0.5 --max-count 20\n"
     "  deck gaps car_0000.rad --compare main.json --fail-on new,worse\n"
     "  deck gaps car_0000.rad --compare git:main --fail-on new,worse\n"
     "  deck gaps car_0000.rad --write-baseline gaps-baseline.json\n"
     "  deck gaps car_0000.rad --baseline gaps-baseline.json\n",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_gaps
