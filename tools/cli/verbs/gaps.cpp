// deck gaps: gaps, stiffness, initial penetrations and the solver's actions.

#include <algorithm>
#include <utility>

#include "common.hpp"
#include "contact/shared/reported.hpp"
#include "deck/contacts.hpp"
#include "deck/report.hpp"
#include "report/shared/json.hpp"
#include "verbs/gap_page.hpp"
#include "verbs/gate/options.hpp"

namespace deck::cli::verb_gaps {
namespace {

struct Options {
  CommonOptions common;
  bool all = false;
  bool fail = false;
  bool crossings = false;
  std::size_t worst = 10;
  std::string csv, ties_csv, html, svg, vtk, write_baseline, accuracy = "robust";
  GateOptions gate;
  std::vector<std::int64_t> only;
  std::vector<std::string> what_if;
};

/// Error for --interface and --what-if that do not match the deck.
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

/// Writes the HTML report. Errors are usage or file errors.
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

class GapsRun {
 public:
  explicit GapsRun(const Options& options)
      : o_(options),
        json_(options.common, "deck/gaps", gaps_version),
        accepted_(options.write_baseline, Baseline::Kind::gaps),
        gate_(options.gate) {
    if (!writes_baseline()) return;  // it would be replaced
    gate_.baseline.clear();
    gate_.no_config = true;
  }

  int run() {
    if (auto ready = prepare(); !ready) return usage(ready.error());
    if (const int bad = check_outputs(
            o_.common, {o_.common.json, o_.csv, o_.ties_csv, o_.html, o_.svg, o_.write_baseline});
        bad != exit_clean)
      return bad;
    if (writes_baseline()) {
      auto kept = baseline_to_change(o_.write_baseline, Baseline::Kind::gaps);
      if (!kept) return usage(kept.error());
      accepted_ = std::move(*kept);
    }
    const int code =
        json_.write(for_each_deck(o_.common, [&](LoadedDeck& loaded) { return one(loaded); }));
    if (!accepted_any_) return code;
    const auto written = o_.common.session->write_output(o_.write_baseline, accepted_.text());
    return written ? code : std::max(code, usage(written.error()));
  }

 private:
  bool writes_baseline() const { return !o_.write_baseline.empty(); }
  int usage(const Error& error) const { return failed(o_.common, error); }

  /// Checks that need no deck.
  Result<void> prepare() {
    if (const std::string why = no_viewer(o_.html); !why.empty()) return config_error(why);
    if (auto legal = check_fail_on(o_.gate); !legal) return legal;
    if (o_.fail && (o_.gate.fails_on("never") || o_.gate.fails_on("error")))
      return config_error("--fail-on-penetration and --fail-on " + o_.gate.level() +
                          " contradict one another");
    if ((!o_.html.empty() || !o_.svg.empty()) && o_.common.decks.size() > 1)
      return config_error("--html and --svg take one deck at a time");
    scene_.threads = o_.common.thread_count();
    scene_.only = o_.only;
    scene_.accuracy = accuracy_of(o_.accuracy);
    scene_.limits = o_.common.limits;
    scene_.ties = true;
    for (const std::string& text : o_.what_if) {
      auto w = parse_what_if(text);
      if (!w) return w.error();
      scene_.what_if.push_back(*w);
    }
    return {};
  }

  int one(LoadedDeck& loaded) {
    if (auto fits = check_options(o_, loaded, scene_.what_if); !fits) return usage(fits.error());
    auto gate = gate_of(gate_, loaded, o_.common);
    if (!gate) return std::max(usage(gate.error()), gate_error_code(gate.error()));
    {
      Progress progress(!o_.common.quiet);
      progress.step("contacts");
      const bool forces = !o_.html.empty() || gate->gate.needs_forces();
      scene_.nodal_stiffness = (o_.all && json_.wanted()) || forces;
      scene_.candidates = json_.wanted() || o_.common.verbose || !o_.html.empty();
      scene_.progress = [&](std::size_t done, std::size_t total) { progress.update(done, total); };
      loaded.set_scene_options(scene_);
      loaded.scene();
    }
    const Scene& scene = loaded.scene();
    const std::vector<Crossing> crossings = crossings_and_findings(loaded, scene_.threads);
    const SceneView view = make_view(scene, &crossings, scene_.threads);
    const GateReport report =
        gate->evaluate(loaded, scene, view,
                       gate->gate.needs_forces() ? &loaded.cycle().outcome : nullptr, o_.common);
    print_findings(loaded, o_.common);
    if (auto written = write(loaded, view, crossings, report); !written)
      return usage(written.error());
    print(loaded, view, crossings, report);
    const bool accepted = writes_baseline() || (gate->baseline && o_.gate.level().empty());
    const int decided =
        verdict_code(verdict_of(loaded.deck(), scene, view), o_.gate, o_.common, o_.fail, accepted);
    return report.passed() ? decided : static_cast<int>(exit_findings);
  }

  /// Writes all requested files.
  Result<void> write(const LoadedDeck& loaded, const SceneView& view,
                     const std::vector<Crossing>& crossings, const GateReport& report) {
    const Deck& deck = loaded.deck();
    const Scene& scene = loaded.scene();
    Session& session = *o_.common.session;
    if (json_.wanted())
      json_.add([&](const TextDrain& drain) {
        return gaps_json(loaded.path(), deck, scene, view, o_.all,
                         o_.crossings ? &crossings : nullptr, &report, drain);
      });
    if (writes_baseline()) {
      accepted_.accept(loaded.path(), scene, view);
      accepted_any_ = true;
    }
    const std::pair<const std::string&, std::function<Result<void>()>> outputs[] = {
        {o_.csv,
         [&] {
           return session.write_output(
               o_.csv, [&](const TextDrain& drain) { return gaps_csv(deck, scene, view, drain); });
         }},
        {o_.ties_csv,
         [&] {
           return session.write_output(
               o_.ties_csv, [&](const TextDrain& drain) { return ties_csv(deck, scene, drain); });
         }},
        {o_.vtk,
         [&] {
           const std::vector<VtkFile> files = gaps_vtk(scene, view);
           return write_vtk(o_.common, o_.vtk, loaded.path(), files, paraview_script(files));
         }},
        {o_.html, [&] { return write_html(o_, loaded, view, crossings, report); }},
        {o_.svg,
         [&] { return session.write_output(o_.svg, touches_svg(page_input(loaded, view))); }},
    };
    for (const auto& [path, written] : outputs)
      if (!path.empty())
        if (auto done = written(); !done) return done;
    return {};
  }

  void print(const LoadedDeck& loaded, const SceneView& view,
             const std::vector<Crossing>& crossings, const GateReport& report) {
    if (!o_.common.wants_text()) return;
    for (const std::string* path : {&o_.csv, &o_.ties_csv, &o_.html, &o_.svg})
      if (*path == "-") return;
    GapsTextOptions text;
    text.worst = o_.worst;
    text.color = o_.common.color_on(1);
    text.verbose = o_.common.verbose;
    text.width = text_width();
    if (o_.common.decks.size() > 1) text.name = loaded.path();
    if (o_.crossings) text.crossings = &crossings;
    text.gate = &report;
    print_lines((first_ ? "" : "\n") + gaps_text(loaded.deck(), loaded.scene(), view, text));
    first_ = false;
  }

  const Options& o_;
  JsonOutput json_;
  Baseline accepted_;  ///< to be written
  bool accepted_any_ = false;
  GateOptions gate_;
  SceneOptions scene_;
  bool first_ = true;
};

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  allow_directories(line);
  line.flag("--all", options->all,
            "JSON with every secondary node, main segment and edge, not only penetrations");
  line.option("--csv FILE", options->csv,
              "Write one line per penetration to FILE or '-', with the columns of --json");
  line.option("--ties-csv FILE", options->ties_csv,
              "Write one line per secondary node of every TYPE2 to FILE ('-': standard output)");
  line.flag("--crossings", options->crossings,
            "List the crossed elements: edges of the secondary side through main segments");
  line.option("--svg FILE", options->svg,
              "Draw the parts and their contacts to FILE, red if they penetrate");
  line.option("--vtk DIR", options->vtk,
              "Write contacts and penetrations as VTK files into DIR, with a ParaView script");
  line.option("--html FILE", options->html,
              "Write the interactive report to FILE: one page, no network needed");
  add_accuracy(line, options->accuracy);
  line.option("--worst", options->worst,
              "Rows of a list: three of each interface, then the deepest")
      .show_default();
  line.option("--interface ID", options->only, "Only these interface ids").by_commas();
  add_require_examined(line, options->common);
  add_verbose(line, options->common,
              "Every interface, the parts of a TYPE19 in separate rows, and more columns");
  line.option("--what-if ID:FIELD=VALUE,...", options->what_if,
              "Evaluate an interface with other values, e.g. 3:Gapmin=2,Inacti=6 (repeatable); "
              "the deck is not changed");
  line.flag("--fail-on-penetration", options->fail,
            "Exit 1 for any initial penetration, as --fail-on warning");
  add_gate_with_config(line, options->gate, "the solver stops",
                       "any initial penetration, crossed element, or node that is not tied");
  line.option("--baseline FILE", options->gate.baseline,
              "Accept the penetrations in FILE, of the decks listed there: only new and worse ones "
              "exit with 1");
  line.option("--write-baseline FILE", options->write_baseline,
              "Write all penetrations to FILE as a baseline; entries of other decks stay");
  return [options] {
    const int wrong = open_directories(options->common);
    return wrong != exit_clean ? wrong : GapsRun(*options).run();
  };
}

const VerbRegistration registration{{"gaps", 30,
                                     "Gaps, stiffness and initial penetrations of every contact",
                                     R"(  deck gaps car_0000.rad
  deck gaps car_0000.rad --html gaps.html
  deck gaps car_0000.rad --what-if 3:Gapmin=1.5,Inacti=6
  deck gaps car_0000.rad --max-depth 0.5 --max-count 20
  deck gaps car_0000.rad --compare git:main --fail-on new,worse
  deck gaps car_0000.rad --write-baseline gaps-baseline.json
  deck gaps car_0000.rad --baseline gaps-baseline.json)",
                                     setup}};

}  // namespace
}  // namespace deck::cli::verb_gaps
