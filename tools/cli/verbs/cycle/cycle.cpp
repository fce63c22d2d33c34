// deck cycle: contact forces, energies, time steps and effects at the start, or over some steps of
// prescribed motion. Its options.
#include <algorithm>

#include "deck/text/number.hpp"
#include "verbs/accuracy_option.hpp"
#include "verbs/cycle/cycle_run.hpp"

namespace deck::cli::verb_cycle {

Result<cycle::DeadElement> parse_gone(const Model& model, const std::string& text) {
  const auto bad = [&](const std::string& why) {
    return Error{Error::Code::config,
                 "--gone " + text + ": " + why +
                     "; expected shell:ID, sh3n:ID, solid:ID, truss:ID, beam:ID "
                     "or spring:ID, and @TIME if it is not gone from the start"};
  };
  const auto colon = text.find(':'), mark = text.find('@');
  if (colon == std::string::npos) return bad("there is no ':'");
  const std::string name = text.substr(0, colon);
  cycle::DeadElement dead;
  if (name == "shell")
    dead.kind = ElementKind::shell4;
  else if (name == "sh3n")
    dead.kind = ElementKind::shell3;
  else if (name == "solid")
    dead.kind = ElementKind::solid8;
  else if (name == "truss")
    dead.kind = ElementKind::truss;
  else if (name == "beam")
    dead.kind = ElementKind::beam;
  else if (name == "spring")
    dead.kind = ElementKind::spring;
  else
    return bad("'" + name + "' is no kind of element");
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

namespace {

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  allow_directories(line);
  line.flag("--all", options->all, "JSON with every pair that has a penetration");
  line.flag("--effects", options->effects,
            "Effects against interfaces: which run, by which field, and why the others do not");
  line.option(
          "--without", options->without,
          "Also evaluate without an effect (friction, normal-damping, heat, gap-reduction ...), "
          "and show force, energy and time step of both")
      .value("EFFECT");
  line.flag("--costs", options->costs,
            "Also measure on this deck what each effect costs in the loop over pairs, with it "
            "against without it");
  line.option("--html", options->html,
              "Write a page to FILE: which effects run and why, what each costs, forces and time "
              "steps in the picture; one file, no network")
      .value("FILE");
  line.option(
          "--vtk", options->vtk,
          "Write pairs and nodes with their forces as VTK files into DIR, with a script that opens "
          "them in ParaView")
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
  line.option("--steps", options->steps,
              "Evaluations, --dt apart, with prescribed motion: nodes keep their velocities, "
              "forces do not move them")
      .range(1, 1000)
      .value("N")
      .show_default();
  line.option("--gone", options->gone,
              "An element that is gone (Idel), e.g. shell:1003 or shell:1003@0.02 (repeatable)")
      .one_each()
      .value("KIND:ID[@T]");
  line.option("--time", options->time, "Time that decides Tstart, Tstop and sensors")
      .number(-1e30, 1e30)
      .value("T");
  line.option("--velocity", options->velocities,
              "Velocity of a part instead of the deck's, e.g. 12=0,0,-5 (repeatable)")
      .value("PART=VX,VY,VZ");
  line.option("--interface", options->only, "Only these interface ids").by_commas().value("ID");
  add_require_examined(line, options->common);
  add_verbose(line, options->common,
              "Every interface, the parts of a TYPE19 in separate rows, and more columns");
  line.flag("--fail-on-force", options->fail,
            "Exit 1 when any contact pushes, at the start or at any step, as --fail-on warning");
  add_gate_with_config(line, options->gate, "the solver stops, or a contact could not be evaluated",
                       "any contact pushes, or as for gaps");
  return [options] {
    const int wrong = open_directories(options->common);
    return wrong != exit_clean ? wrong : run_cycle_verb(*options);
  };
}

const VerbRegistration registration{
    {"cycle", 40, "Contact forces, energies and time step of the first cycle",
     "  deck cycle car_0000.rad\n"
     "  deck cycle car_0000.rad --interface 3 --effects\n"
     "  deck cycle car_0000.rad --without friction\n"
     "  deck cycle car_0000.rad --html cycle.html\n"
     "  deck cycle car_0000.rad --velocity 12=0,0,-5 --dt 1e-3\n"
     "  deck cycle car_0000.rad --velocity 12=0,0,-5 --dt 1e-3 --steps 200 --vtk paraview\n"
     "  deck cycle car_0000.rad --model reference --all --json cycle.json\n",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_cycle
