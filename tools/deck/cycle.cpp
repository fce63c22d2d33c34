// deck cycle: one contact force evaluation at the start: forces, energies, time steps, effects.
#include <filesystem>

#include "accuracy_option.hpp"
#include "common.hpp"
#include "deck/report/cycle.hpp"
#include "deck/text/number.hpp"

namespace {

using namespace deck;
using namespace deck::cli;

struct Options {
  CommonOptions common;
  bool all = false, effects = false, fail = false;
  std::string model = "robust", accuracy = "robust";
  double dt = 0, time = 0;
  std::vector<std::int64_t> only;
  std::vector<std::string> velocities;
  std::string vtk;
};

/// "PART=vx,vy,vz".
Result<cycle::PartVelocity> parse_velocity(const std::string& text) {
  const auto bad = [&](const std::string& why) {
    return Error{Error::Code::config,
                 "--velocity " + text + ": " + why + "; expected PART=vx,vy,vz in working units"};
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

/// Writes the VTK files: into the directory itself, or one below it per deck if there are several.
Result<void> write_vtk(const Options& o, const CycleInput& input) {
  std::filesystem::path directory = o.vtk;
  if (o.common.decks.size() > 1) directory /= std::filesystem::path(input.path).stem();
  std::vector<OutputFile> files;
  for (const VtkFile& f : cycle_vtk(input))
    files.push_back({(directory / f.name).string(), f.bytes});
  return write_outputs(files);
}

int run(const Options& o) {
  cycle::CycleOptions options;
  options.model = o.model == "reference" ? cycle::Model::reference : cycle::Model::robust;
  options.dt1 = options.dt12 = o.dt;
  options.time = o.time;
  options.threads = o.common.thread_count();
  std::vector<cycle::PartVelocity> velocities;
  for (const std::string& text : o.velocities) {
    auto v = parse_velocity(text);
    if (!v) {
      print_error(o.common, v.error().message);
      return exit_usage;
    }
    velocities.push_back(*v);
  }
  JsonOutput json(o.common, "deck/cycle", 1);
  options.keep_pairs = (o.all && json.wanted()) || !o.vtk.empty();
  std::vector<std::int64_t> parts;
  for (const cycle::PartVelocity& v : velocities) parts.push_back(v.part);
  const int code = for_each_deck(o.common, Stage::interfaces, [&](Loaded& loaded) {
    for (const auto& known : {check_interfaces(loaded, o.only, "--interface"),
                              check_parts(loaded, parts, "--velocity")})
      if (!known) {
        print_error(o.common, known.error().message);
        return static_cast<int>(exit_usage);
      }
    SceneOptions scene_options;
    scene_options.threads = options.threads;
    scene_options.candidates = false;
    scene_options.nodal_stiffness = true;
    scene_options.only = o.only;
    scene_options.accuracy = accuracy_of(o.accuracy);
    scene_options.limits = o.common.memory;
    Scene scene;
    cycle::SceneOutcome outcome;
    cycle::State state;
    {
      Progress progress(!o.common.quiet);
      progress.step("contacts");
      const auto update = [&](std::size_t done, std::size_t total) {
        progress.update(done, total);
      };
      scene_options.progress = update;
      scene = build_scene(loaded.model, loaded.interfaces, loaded.diagnostics, scene_options);
      progress.step("forces");
      state = cycle::make_state(scene, velocities);
      options.progress = update;
      outcome = cycle::run_cycle(scene, state, options);
    }
    print_findings(loaded, o.common);
    CycleInput input;
    input.path = loaded.path;
    input.deck = &loaded.deck;
    input.scene = &scene;
    input.state = &state;
    input.outcome = &outcome;
    input.options = options;
    if (json.wanted()) json.add(cycle_json(input, o.all));
    if (!o.vtk.empty())
      if (auto r = write_vtk(o, input); !r) {
        print_error(o.common, r.error().message);
        return static_cast<int>(exit_usage);
      }
    if (o.common.wants_text()) print_text(cycle_text(input, {o.common.color_on(1), o.effects}));
    bool found = false;
    for (const cycle::ContactOutcome& c : outcome.contacts)
      found = found || (o.fail && c.pairs_with_force > 0) || !c.complete;
    return static_cast<int>(found ? exit_findings : exit_clean);
  });
  return json.finish(code);
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  line.flag("--all", options->all, "JSON with every pair that has a penetration");
  line.flag("--effects", options->effects, "Also list the effects that are off, and why");
  line.option("--vtk", options->vtk,
              "Write pairs and nodes with their forces as VTK files (ParaView) into DIR")
      .value("DIR");
  line.option("--model", options->model,
              "reference: as the solver computes; robust: the same physics without its "
              "numerical quirks")
      .one_of({"reference", "robust"})
      .show_default();
  add_accuracy(line, options->accuracy);
  line.option("--dt", options->dt, "Time step for rate effects; 0: the first evaluation")
      .number(0, 1e30)
      .value("DT");
  line.option("--time", options->time, "Time that decides Tstart, Tstop and sensors")
      .number(-1e30, 1e30)
      .value("T");
  line.option("--velocity", options->velocities,
              "Velocity of a part instead of the deck's, e.g. 12=0,0,-5 (repeatable)")
      .value("PART=VX,VY,VZ");
  line.option("--interface", options->only, "Only these interface ids").by_commas().value("ID");
  add_require_examined(line, options->common);
  line.flag("--fail-on-force", options->fail, "Exit 1 when any contact pushes at the start");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"cycle", 40, "Contact forces, energies and time step of the first cycle",
     "  deck cycle car_0000.rad\n"
     "  deck cycle car_0000.rad --interface 3 --effects\n"
     "  deck cycle car_0000.rad --velocity 12=0,0,-5 --dt 1e-3\n"
     "  deck cycle car_0000.rad --vtk paraview\n"
     "  deck cycle car_0000.rad --model reference --all --json cycle.json\n",
     setup}};

}  // namespace
