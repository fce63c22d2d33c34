// Steps of prescribed motion: moves nodes, evaluates contacts, keeps the outcomes.
#include "deck/cycle.hpp"

#include <algorithm>
#include <cmath>

namespace deck::cycle {
namespace {

/// Longest way of a node in one step.
double step_length(const State& state, double dt) {
  double sum = 0.0;
  for (const std::vector<double>& v : state.velocity) {
    if (v.empty()) continue;
    const auto [low, high] = std::minmax_element(v.begin(), v.end());
    sum += (*high - *low) * (*high - *low);
  }
  return std::sqrt(sum) * dt;
}

/// Extra search distance: ten steps, at most the contacts' lengths: longer lists cost more.
double search_margin(const Scene& scene, const State& state, double dt) {
  double own = 0.0;
  for (const Contact& c : scene.contacts)
    if (c.max_gap < 1e30 && c.shortest_side < 1e30)
      own = std::max(own, c.max_gap + c.shortest_side);
  return std::min(10.0 * step_length(state, dt), own);
}

void add_events(std::size_t step, double time, const SceneOutcome& r, StepsOutcome& out) {
  for (std::size_t i = 0; i < r.contacts.size(); ++i) {
    const ContactOutcome& c = r.contacts[i];
    StepEvent e;
    e.step = step;
    e.time = time;
    e.contact = i;
    for (const Removal& gone : c.removed) {
      e.kind = StepEvent::Kind::removed;
      e.at = {gone.secondary, 0};
      e.because = gone.because;
      out.events.push_back(e);
    }
    for (const TieChange& t : c.ties) {
      e.kind = t.tied ? StepEvent::Kind::tied : StepEvent::Kind::let_go;
      e.at = t.at;
      out.events.push_back(e);
    }
    for (const NodeRelease& n : c.released) {
      e.kind = StepEvent::Kind::released;
      e.release = n;
      out.events.push_back(e);
    }
  }
}

StepLine line_of(const SceneOutcome& r, const CycleOptions& options, const StepLine* before) {
  StepLine line;
  line.time = options.time;
  line.dt1 = options.dt1;
  for (std::size_t i = 0; i < r.contacts.size(); ++i) {
    const ContactOutcome& c = r.contacts[i];
    StepContact s;
    s.active = c.active;
    s.pairs_with_force = c.pairs_with_force;
    s.pairs_tied = c.pairs_tied;
    s.removed = c.removed.size() + (before != nullptr ? before->contacts[i].removed : 0);
    s.normal = c.totals.normal;
    s.tangential = c.totals.tangential;
    s.force_sum = c.totals.total_abs;
    s.elastic_energy = c.totals.elastic_energy;
    s.friction_energy = c.totals.friction_energy;
    s.damping_energy = c.totals.damping_energy;
    line.contacts.push_back(s);
  }
  return line;
}

}  // namespace

StepsOutcome run_steps(const Scene& scene, const State& start_state, CycleOptions options,
                       std::size_t steps, const Motion& motion, const StepWatch& watch) {
  StepsOutcome out;
  // A single evaluation in the initial position copies neither coordinates nor state.
  const bool moves = motion || steps > 1;
  if (moves) out.coordinates = scene.coordinates;
  const Coordinates& x = moves ? out.coordinates : scene.coordinates;
  State moved;
  if (motion) moved = start_state;
  const State& state = motion ? moved : start_state;
  CycleRun run(scene, steps > 1);
  const double start = options.time;
  if (options.margin == 0.0 && steps > 1) options.margin = search_margin(scene, state, options.dt1);
  const auto progress = options.progress;
  for (std::size_t k = 0; k < steps; ++k) {
    if (motion) {
      motion(k, out.coordinates, moved, options);
    } else if (k > 0) {
      // Computed from the start, so that round-off does not add up.
      const double t = static_cast<double>(k) * options.dt1;
      options.time = start + t;
      std::vector<double>* to[] = {&out.coordinates.x, &out.coordinates.y, &out.coordinates.z};
      const std::vector<double>* from[] = {&scene.coordinates.x, &scene.coordinates.y,
                                           &scene.coordinates.z};
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t n = 0; n < from[c]->size(); ++n)
          (*to[c])[n] =
              (*from[c])[n] + t * (state.velocity[c].empty() ? 0.0 : state.velocity[c][n]);
    }
    if (progress)
      options.progress = [&, k](std::size_t done, std::size_t total) {
        progress(k * total + done, steps * total);
      };
    out.last = run.evaluate(x, state, options);
    out.lines.push_back(
        line_of(out.last, options, out.lines.empty() ? nullptr : &out.lines.back()));
    add_events(k, options.time, out.last, out);
    if (watch) watch(k, out.last, x);
  }
  out.searches = run.searches();
  return out;
}

}  // namespace deck::cycle
