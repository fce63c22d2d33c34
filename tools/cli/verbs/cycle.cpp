// deck cycle: contact forces, energies, time steps and effects at the start or over steps of
// prescribed motion; pages, VTK files, gate.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "accuracy/shared/effect_cost.hpp"
#include "common.hpp"
#include "deck/contacts.hpp"
#include "deck/report.hpp"
#include "deck/text.hpp"
#include "report/shared/cycle.hpp"
#include "verbs/gap_page.hpp"
#include "verbs/gate/options.hpp"

namespace deck::cli::verb_cycle {
namespace {

struct Options {
  CommonOptions common;
  bool all = false, effects = false, costs = false, fail = false;
  bool measures() const { return costs || !html.empty(); }
  std::string model = "robust", accuracy = "robust";
  double dt = 0, time = 0;
  std::vector<std::int64_t> only;
  std::vector<std::string> velocities, gone;
  std::string vtk, html, without;
  int steps = 1;
  GateOptions gate;
};

/// Parses "KIND:ID" or "KIND:ID@TIME": an element that fails at a time.
Result<cycle::DeadElement> parse_gone(const Model& model, const std::string& text) {
  const auto bad = [&](const std::string& why) {
    return config_error("--gone " + text + ": " + why +
                        "; expected shell:ID, sh3n:ID, solid:ID, truss:ID, beam:ID "
                        "or spring:ID, and @TIME if it is not gone from the start");
  };
  const auto colon = text.find(':'), mark = text.find('@');
  if (colon == std::string::npos) return bad("there is no ':'");
  const std::string name = text.substr(0, colon);
  cycle::DeadElement dead;
  constexpr std::pair<std::string_view, ElementKind> kinds[] = {
      {"shell", ElementKind::shell4}, {"sh3n", ElementKind::shell3},
      {"solid", ElementKind::solid8}, {"truss", ElementKind::truss},
      {"beam", ElementKind::beam},    {"spring", ElementKind::spring}};
  const auto* const kind = std::find_if(std::begin(kinds), std::end(kinds),
                                        [&](const auto& k) { return k.first == name; });
  if (kind == std::end(kinds)) return bad("'" + name + "' is no kind of element");
  dead.kind = kind->second;
  const std::string id =
      text.substr(colon + 1, mark == std::string::npos ? mark : mark - colon - 1);
  const IntegerCell number = read_integer(id);
  if (number.status != NumberStatus::ok) return bad("the element id is not a number");
  if (mark != std::string::npos) {
    const RealCell time = read_real(std::string_view(text).substr(mark + 1));
    if (time.status != NumberStatus::ok) return bad("the time is not a number");
    dead.from = time.value;
  } else {
    dead.from = -1e300;
  }
  const Elements& family = model.family(dead.kind);
  for (std::uint32_t e = 0; e < family.size(); ++e)
    if (family.id[e] == number.value) dead.element = e;
  if (dead.element == no_index) return bad("the deck has no such element");
  return dead;
}

/// Parses "PART=vx,vy,vz".
Result<cycle::PartVelocity> parse_velocity(const std::string& text) {
  const auto bad = [&](const std::string& why) {
    return config_error("--velocity " + text + ": " + why +
                        "; expected PART=vx,vy,vz in working units");
  };
  const auto equal = text.find('=');
  if (equal == std::string::npos) return bad("there is no '='");
  cycle::PartVelocity v;
  const IntegerCell part = read_integer(std::string_view(text).substr(0, equal));
  if (part.status != NumberStatus::ok) return bad("the part id is not a number");
  v.part = part.value;
  std::size_t at = equal + 1;
  for (std::size_t c = 0; c < 3; ++c) {
    if (at > text.size()) return bad("there are fewer than three components");
    const auto comma = std::min(text.find(',', at), text.size());
    const RealCell x = read_real(std::string_view(text).substr(at, comma - at));
    if (x.status != NumberStatus::ok) return bad("a component is not a number");
    v.velocity[c] = x.value;
    at = comma + 1;
  }
  if (at <= text.size()) return bad("there are more than three components");
  return v;
}

/// Largest velocity component of all nodes.
double fastest(const cycle::State& state) {
  double most = 0;
  for (const std::vector<double>& component : state.velocity)
    for (const double v : component) most = std::max(most, std::abs(v));
  return most;
}

/// Writes the page: the gaps report with effects and their cost first.
Result<void> write_html(const Options& o, const LoadedDeck& loaded, const CycleInput& cycle) {
  HtmlInput input = page_input(loaded, *cycle.view);
  input.cycle = cycle.outcome;
  input.acted = acted_in_page(*cycle.state, *cycle.outcome);
  input.effects = &cycle;
  auto page = gaps_html(input);
  return page ? o.common.session->write_output(o.html, *page) : Result<void>(page.error());
}

/// Error for conflicting options.
Result<void> check_page(const Options& o) {
  if (o.measures() && o.steps > 1)
    return config_error(std::string(o.html.empty() ? "--costs" : "--html") +
                        " shows one evaluation: leave out --steps");
  const std::vector<std::string> effects = removable_effects();
  if (!o.without.empty() && std::find(effects.begin(), effects.end(), o.without) == effects.end())
    return config_error(fmt::format("--without {}: no effect that can be left out; these can: {}",
                                    o.without, fmt::join(effects, ", ")));
  if (!o.without.empty() && o.steps > 1)
    return config_error("--without compares one evaluation: leave out --steps");
  return check_html(o.common, o.html);
}

/// Evaluates again with an effect switched off on all cards.
Result<cycle::SceneOutcome> evaluate_without(const Options& o, const CycleInput& input) {
  bool taken = false;
  cycle::CycleOptions options = input.options;
  options.keep_pairs = false;
  options.change_card = [&](cycle::ContactCard& card) {
    taken = remove_effect(o.without, card) || taken;
  };
  // With the settings of the main evaluation.
  cycle::StepsOutcome steps = cycle::run_steps(*input.scene, *input.state, options, 1);
  if (!taken)
    return config_error(
        fmt::format("--without {}: no contact of {} has this effect", o.without, input.path));
  return std::move(steps.last);
}

std::string suffix_of(std::size_t step) { return fmt::format("_{:04}", step); }

/// The evaluation of one deck and its reports.
struct Evaluation {
  cycle::State state;
  cycle::StepsOutcome steps;
  cycle::SceneOutcome without;
  std::vector<Crossing> crossings;
  SceneView view;
  GateReport report;
  std::vector<ContactCost> costs;
  CycleInput input;                        ///< refers to the other members
  bool pushed = false, undecided = false;  ///< in any step
};

class CycleRun {
 public:
  explicit CycleRun(const Options& options) : o_(options), json_(options.common, "deck/cycle", 1) {}

  int run() {
    if (auto ready = prepare(); !ready) return usage(ready.error());
    if (const int bad = check_outputs(o_.common, {o_.common.json, o_.html}); bad != exit_clean)
      return bad;
    return json_.write(for_each_deck(o_.common, [&](LoadedDeck& loaded) { return one(loaded); }));
  }

 private:
  int usage(const Error& error) const { return failed(o_.common, error); }

  /// Checks that need no deck.
  Result<void> prepare() {
    options_.model = o_.model == "reference" ? cycle::Model::reference : cycle::Model::robust;
    options_.dt1 = options_.dt12 = o_.dt;
    options_.time = o_.time;
    options_.threads = o_.common.thread_count();
    options_.keep_pairs = (o_.all && json_.wanted()) || !o_.vtk.empty() || !o_.html.empty();
    for (const std::string& text : o_.velocities) {
      auto v = parse_velocity(text);
      if (!v) return v.error();
      velocities_.push_back(*v);
    }
    if (o_.steps > 1 && !(o_.dt > 0))
      return config_error("--steps needs --dt: how long is a step?");
    if (auto legal = check_fail_on(o_.gate); !legal) return legal;
    if (auto fits = check_page(o_); !fits) return fits;
    if (o_.fail && (o_.gate.fails_on("never") || o_.gate.fails_on("error")))
      return config_error("--fail-on-force and --fail-on " + o_.gate.level() +
                          " contradict one another");
    return {};
  }

  int one(LoadedDeck& loaded) {
    auto gate = ask(loaded);
    if (!gate) return std::max(usage(gate.error()), gate_error_code(gate.error()));
    Evaluation e;
    Result<void> written = evaluate(loaded, e);
    if (!written && e.input.outcome == nullptr) return usage(written.error());
    e.crossings = crossings_and_findings(loaded, options_.threads);
    const Scene& scene = loaded.scene();
    e.view = make_view(scene, &e.crossings, options_.threads);
    e.report = gate->evaluate(loaded, scene, e.view, &e.steps.last, o_.common);
    e.input.view = &e.view;
    e.input.gate = &e.report;
    measure(scene, e);
    if (!o_.without.empty()) {
      auto other = evaluate_without(o_, e.input);
      if (!other) return usage(other.error());
      e.without = std::move(*other);
      e.input.without = &e.without;
      e.input.without_effect = o_.without;
    }
    if (!o_.html.empty() && written) written = write_html(o_, loaded, e.input);
    print_findings(loaded, o_.common);
    if (json_.wanted())
      json_.add([&](const TextDrain& drain) { return cycle_json(e.input, o_.all, drain); });
    if (!written) return usage(written.error());
    print(e.input);
    const bool fails = (o_.fail || o_.gate.fails_on("warning")) && e.pushed;
    const bool found = verdict_code(cycle_verdict(e.input), o_.gate, o_.common) != exit_clean ||
                       (!o_.gate.fails_on("never") && (fails || e.undecided)) || !e.report.passed();
    return found ? exit_findings : exit_clean;
  }

  /// Entities of this deck named in options, and its gate.
  Result<DeckGate> ask(LoadedDeck& loaded) {
    std::vector<std::int64_t> parts;
    for (const cycle::PartVelocity& v : velocities_) parts.push_back(v.part);
    for (const auto& known : {check_interfaces(loaded, o_.only, "--interface"),
                              check_parts(loaded, parts, "--velocity")})
      if (!known) return known.error();
    auto gate = gate_of(o_.gate, loaded, o_.common);
    if (!gate) return gate;
    options_.dead.clear();
    for (const std::string& text : o_.gone) {
      auto dead = parse_gone(loaded.model(), text);
      if (!dead) return dead.error();
      options_.dead.push_back(*dead);
    }
    return gate;
  }

  SceneOptions scene_options() const {
    SceneOptions options;
    options.threads = options_.threads;
    options.candidates = !o_.html.empty();  // the page shows candidates
    options.nodal_stiffness = true;
    options.ties = true;  // for the verdict, as in gaps
    options.only = o_.only;
    options.accuracy = accuracy_of(o_.accuracy);
    options.limits = o_.common.limits;
    return options;
  }

  /// Evaluates all steps; writes VTK files. Error: a file, or options without anything to evaluate.
  Result<void> evaluate(LoadedDeck& loaded, Evaluation& e) {
    Progress progress(!o_.common.quiet);
    progress.step("contacts");
    const auto update = [&](std::size_t done, std::size_t total) { progress.update(done, total); };
    SceneOptions of_scene = scene_options();
    of_scene.progress = update;
    loaded.set_scene_options(of_scene);
    const Scene& scene = loaded.scene();
    progress.step("forces");
    e.state = cycle::make_state(scene, velocities_, nullptr, options_.threads);
    options_.progress = update;
    CycleInput& input = e.input;
    input.path = loaded.path();
    input.deck = &loaded.deck();
    input.scene = &scene;
    input.state = &e.state;
    input.options = options_;
    // Squares of larger distances overflow.
    constexpr double farthest = 1e150;
    if (const double way = fastest(e.state) * o_.dt * (o_.steps - 1); !(way < farthest))
      return config_error(
          fmt::format("--steps {} --dt {}: nodes would move by {:.3g}, too far to compute "
                      "with; give a shorter step or lower velocities",
                      o_.steps, o_.dt, way));
    Result<void> written;
    const bool series = o_.steps > 1 && !o_.vtk.empty();
    const auto watch = [&](std::size_t step, const cycle::SceneOutcome& now, const Coordinates& x) {
      for (const cycle::ContactOutcome& c : now.contacts) {
        e.pushed = e.pushed || c.pairs_with_force > 0;
        e.undecided = e.undecided || c.undecided();
      }
      if (!series || !written) return;
      CycleInput one = input;
      one.outcome = &now;
      one.coordinates = &x;
      written = write_vtk(o_.common, o_.vtk, loaded.path(), cycle_vtk(one, suffix_of(step)), {});
    };
    e.steps =
        cycle::run_steps(scene, e.state, options_, static_cast<std::size_t>(o_.steps), {}, watch);
    input.outcome = &e.steps.last;
    if (o_.steps > 1) {
      input.steps = &e.steps;
      input.coordinates = &e.steps.coordinates;
    }
    return o_.vtk.empty() || !written ? written : write_rest(loaded.path(), e, series);
  }

  /// Writes the VTK index of all steps, or the files of a single step.
  Result<void> write_rest(std::string_view path, const Evaluation& e, bool series) const {
    if (!series) {
      const std::vector<VtkFile> files = cycle_vtk(e.input);
      return write_vtk(o_.common, o_.vtk, path, files, paraview_script(files));
    }
    std::vector<std::string> suffixes;
    for (std::size_t k = 0; k < e.steps.lines.size(); ++k) suffixes.push_back(suffix_of(k));
    const std::vector<VtkFile> collections = cycle_vtk_series(e.steps, suffixes);
    return write_vtk(o_.common, o_.vtk, path, collections, paraview_script(collections));
  }

  /// Measures the cost of effects if requested.
  void measure(const Scene& scene, Evaluation& e) const {
    if (!o_.measures()) return;
    EffectCostOptions how;
    if (!o_.costs) how = {3, 512, 100, 2e4, false};  // a page of the inflated dummy: 0.1 s, not 5
    e.costs = measure_effects(scene, e.state, e.steps.last, options_, how);
    e.input.costs = &e.costs;
    e.input.cost_repeats = how.repeats;
    e.input.processor = processor_name();
  }

  void print(const CycleInput& input) {
    if (!o_.common.wants_text()) return;
    CycleTextOptions text;
    text.color = o_.common.color_on(1);
    text.effects = o_.effects;
    text.verbose = o_.common.verbose;
    text.several = o_.common.decks.size() > 1;
    text.width = text_width();
    print_lines((first_ ? "" : "\n") + cycle_text(input, text));
    first_ = false;
  }

  const Options& o_;
  JsonOutput json_;
  cycle::CycleOptions options_;
  std::vector<cycle::PartVelocity> velocities_;
  bool first_ = true;
};

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  allow_directories(line);
  line.flag("--all", options->all, "JSON with every pair that has a penetration");
  line.flag("--effects", options->effects,
            "Table of effects by interface: which run, by which field; why the others do not");
  line.option("--without EFFECT", options->without,
              "Show force, energy and time step also without an effect (friction, heat ...)");
  line.flag("--costs", options->costs,
            "Also measure what each effect costs in the loop over pairs of this deck");
  line.option("--html FILE", options->html,
              "Write a page to FILE, no network: effects, their costs, forces and time steps");
  line.option("--vtk DIR", options->vtk,
              "Write pairs and nodes with their forces as VTK files, with a ParaView script");
  line.option(
          "--model", options->model,
          "Which formulas give the forces of pairs in contact: reference: the solver's, step by "
          "step; robust: the same physics without its cancellation")
      .one_of({"reference", "robust"})
      .show_default();
  add_accuracy(line, options->accuracy);
  line.option("--dt DT", options->dt, "Time step for rate effects; 0: the first evaluation")
      .number(0, 1e30);
  line.option("--steps N", options->steps,
              "Evaluations, --dt apart, with prescribed motion: nodes keep their velocities, "
              "forces do not move them")
      .range(1, 1000)
      .show_default();
  line.option("--gone KIND:ID[@T]", options->gone,
              "An element that is gone (Idel), e.g. shell:1003 or shell:1003@0.02 (repeatable)")
      .one_each();
  line.option("--time T", options->time, "Time that decides Tstart, Tstop and sensors")
      .number(-1e30, 1e30);
  line.option("--velocity PART=VX,VY,VZ", options->velocities,
              "Velocity of a part instead of the deck's, e.g. 12=0,0,-5 (repeatable)");
  line.option("--interface ID", options->only, "Only these interface ids").by_commas();
  add_require_examined(line, options->common);
  add_verbose(line, options->common,
              "Every interface, the parts of a TYPE19 in separate rows, and more columns");
  line.flag("--fail-on-force", options->fail,
            "Exit 1 when any contact pushes, at the start or at any step, as --fail-on warning");
  add_gate_with_config(line, options->gate, "the solver stops, or a contact could not be evaluated",
                       "any contact pushes, or as for gaps");
  return [options] {
    const int wrong = open_directories(options->common);
    return wrong != exit_clean ? wrong : CycleRun(*options).run();
  };
}

const VerbRegistration registration{{"cycle", 40,
                                     "Contact forces, energies and time step of the first cycle",
                                     R"(  deck cycle car_0000.rad
  deck cycle car_0000.rad --without friction
  deck cycle car_0000.rad --html cycle.html
  deck cycle car_0000.rad --velocity 12=0,0,-5 --dt 1e-3 --steps 200 --vtk paraview)",
                                     setup}};

}  // namespace

}  // namespace deck::cli::verb_cycle
