// `deck cycle` for people: what the first force evaluation does, contact by contact, and which
// effects run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/shared/shown_text.hpp"
#include "base/shared/vec.hpp"
#include "base/shared/words.hpp"
#include "report/shared/cycle.hpp"
#include "report/shared/gate.hpp"
#include "report/shared/parts.hpp"
#include "report/terminal/words.hpp"

namespace deck {
namespace {

/// "X, Y" of fixed translations.
std::string directions(int bits) {
  std::string text;
  const char* const names[] = {"X", "Y", "Z"};
  for (int k = 0; k < 3; ++k)
    if ((bits & (4 >> k)) != 0) append(text, ", ", names[k]);
  return text.empty() ? "none" : text;
}

std::string node_text(const Model& model, NodeIndex n) {
  return n == no_index ? "-" : fmt::format("{}", model.node_id(n));
}

/// True for a step of 1e30, or a share of it.
bool is_no_limit(double dt) { return dt >= 1e29; }
std::string step_text(double dt) { return is_no_limit(dt) ? "-" : figure_text(dt); }

/// "interface 3 TYPE7: ", indented
std::string line_head(const Contact& c) {
  return fmt::format("  interface {} {}: ", c.inter->id, kind_name(c));
}

/// Items that leave their interface for good, tie, or become free in this cycle.
std::string lasting_lines(const CycleInput& input) {
  const Model& model = *input.scene->model;
  std::string out;
  for (const cycle::ContactOutcome& o : input.outcome->contacts) {
    const Contact& c = *o.contact;
    const std::string head = line_head(c);
    std::map<cycle::Removal::Because, std::vector<cycle::Removal>> removed;
    for (const cycle::Removal& r : o.removed) removed[r.because].push_back(r);
    for (const auto& [because, list] : removed)
      out += fmt::format("{}removed for good, {}: {}\n", head, to_string(because),
                         first_of(list, 10, [&](const cycle::Removal& r) {
                           return secondary_name(model, c, r.secondary);
                         }));
    std::size_t tied = 0, let_go = 0;
    for (const cycle::TieChange& t : o.ties) ++(t.tied ? tied : let_go);
    if (tied > 0) out += head + count(tied, "pair is tied\n", "pairs are tied\n");
    if (let_go > 0) out += head + count(let_go, "pair lets go\n", "pairs let go\n");
    const auto released = [&](const auto& r) {
      return fmt::format("node {}: {} -> {}", model.node_id(r.node), directions(r.before),
                         directions(r.after));
    };
    if (!o.released.empty())
      out += head + "boundary conditions released (IBC) at " + first_of(o.released, 10, released) +
             "\n";
  }
  return out;
}

/// Iadm: nodes with the smallest radius. The last column is below 1 if the normals of a segment and
/// of its corner differ by more than Angladm.
std::string criteria_table(const CycleInput& input, const CycleTextOptions& options) {
  const Model& model = *input.scene->model;
  TextTable table(
      {">interface", ">node", ">radius", ">penetration / (Padm gap)", ">cos / cos Angladm"});
  for (const cycle::ContactOutcome& o : input.outcome->contacts) {
    std::vector<cycle::NodeCriteria> list = o.criteria;
    std::stable_sort(list.begin(), list.end(),
                     [](const auto& a, const auto& b) { return a.radius < b.radius; });
    for (std::size_t i = 0; i < std::min<std::size_t>(10, list.size()); ++i)
      table.row({o.contact->inter->id, node_text(model, list[i].node), list[i].radius,
                 figure_text(list[i].penetration),
                 known_cell(list[i].angle < 1e30, list[i].angle)});
  }
  return table.below_heading(options);
}

std::string event_text(const CycleInput& input, const cycle::StepEvent& e) {
  const Model& model = *input.scene->model;
  const Contact& c = input.scene->contacts[e.contact];
  const std::string head =
      fmt::format("  step {} ({:.6g}): {}", e.step, e.time, line_head(c).substr(2));
  if (e.kind == cycle::StepEvent::Kind::released)
    return head + fmt::format("node {} fixed in {} -> {}\n", model.node_id(e.release.node),
                              directions(e.release.before), directions(e.release.after));
  const std::string name = secondary_name(model, c, e.at.secondary);
  if (e.kind == cycle::StepEvent::Kind::removed)
    return head + fmt::format("{} removed, {}\n", name, to_string(e.because));
  return head + fmt::format("{} {} {}\n", name,
                            e.kind == cycle::StepEvent::Kind::tied ? "tied to" : "lets go of",
                            ids_text(model, pair_nodes(c, e.at.secondary, e.at.main).main, ' '));
}

/// Steps in at most twenty lines, and the first events.
std::string steps_text(const CycleInput& input, const CycleTextOptions& options) {
  const cycle::StepsOutcome& s = *input.steps;
  TextTable table({">step", ">time", ">pairs with force", ">sum |F|", ">elastic energy", ">tied",
                   ">removed so far"});
  const std::size_t n = s.lines.size(), shown = std::min<std::size_t>(n, 20);
  for (std::size_t r = 0; r < shown; ++r) {
    const std::size_t k = shown < 2 ? 0 : r * (n - 1) / (shown - 1);
    cycle::StepContact sum;
    for (const cycle::StepContact& c : s.lines[k].contacts) {
      sum.pairs_with_force += c.pairs_with_force;
      sum.pairs_tied += c.pairs_tied;
      sum.removed += c.removed;
      sum.force_sum += c.force_sum;
      sum.elastic_energy += c.elastic_energy;
    }
    table.row({k, s.lines[k].time, sum.pairs_with_force, figure_text(sum.force_sum),
               figure_text(sum.elastic_energy), sum.pairs_tied, sum.removed});
  }
  std::string out =
      "  prescribed motion only: nodes keep their given velocities, no structure answers and "
      "contact forces move nothing\n" +
      table.fitted(options.width, options.color, 2);
  for (std::size_t i = 0; i < std::min<std::size_t>(20, s.events.size()); ++i)
    out += event_text(input, s.events[i]);
  if (s.events.size() > 20)
    out += fmt::format("  and {} more (--json has all)\n", s.events.size() - 20);
  return out;
}

std::string state_words(const cycle::ContactOutcome& o) {
  if (o.contact->dropped) return "no edges, dropped";
  if (!o.active) return "not active yet";
  if (!o.complete) return o.notes.empty() ? "too many pairs" : "not evaluated";
  std::string text;
  const auto add = [&](std::size_t n, const char* what) {
    if (n > 0) append(text, ", ", fmt::format("{} {}", n, what));
  };
  add(o.gap_closed, "at the mid-surface");
  add(removed_by_step(o), "removed by dtmin");
  add(o.pairs_tied, "tied");
  add(o.massless_nodes, "without mass");
  return text;
}

/// Notes on the contacts of one interface; several ones with their roles.
std::string note_of(const std::vector<const cycle::ContactOutcome*>& list) {
  std::string note;
  for (const cycle::ContactOutcome* o : list) {
    const std::string words = state_words(*o);
    if (!words.empty())
      append(note, "; ",
             list.size() > 1 ? fmt::format("{}: {}", to_string(o->contact->role), words) : words);
  }
  return note;
}

/// Row of some contacts of an interface; `part`: one of several. `all`: for the longer table.
std::vector<TextTable::Cell> contact_row(const CycleInput& input,
                                         const std::vector<const cycle::ContactOutcome*>& list,
                                         bool part, bool all) {
  const Model& model = *input.scene->model;
  const cycle::InterfaceSummary s = cycle::summarize(list, input.outcome->structure);
  const Contact& c = *list.front()->contact;
  // Without evaluation no figure is known.
  const bool known = std::any_of(list.begin(), list.end(),
                                 [](const cycle::ContactOutcome* o) { return o->complete; });
  const auto figure = [&](double v) { return known ? figure_text(v) : "-"; };
  const double energy = s.elastic_energy + s.friction_energy + s.damping_energy;
  return {c.inter->id,
          part ? kind_name(c) : type_name(*c.inter),
          part ? "" : c.inter->title,
          known_cell(known, s.pairs_in_reach),
          known_cell(known, s.pairs_with_force),
          figure(s.force_sum),
          figure(s.largest_pair_force),
          figure(all ? s.elastic_energy : energy),
          figure(s.friction_energy),
          figure(s.damping_energy),
          figure(s.largest_acceleration),
          node_text(model, s.acceleration_node),
          {step_text(s.contact_dt), s.contact_dt < s.structure_dt ? Tone::yellow : Tone::plain},
          node_text(model, s.contact_dt_node),
          known_cell(known, s.near_singular),
          {note_of(list), s.gap_closed > 0 ? Tone::red : Tone::plain}};
}

/// One row per interface; interfaces without a pair in reach share a line. `verbose`: all
/// interfaces, a row per contact of a TYPE19, more columns.
std::string contact_table(const CycleInput& input, const CycleTextOptions& options) {
  const bool all = options.verbose;
  TextTable table(
      {">id", "type", "~title", "+>in reach", ">with force", ">sum |F|", "+>largest of a pair",
       all ? ">elastic energy" : ">energy", "+>friction", "+>damping", "+>acceleration", "+of node",
       ">contact dt", "node", "+>near singular", "note"},
      all);
  std::vector<std::int64_t> quiet;
  for (const auto& list :
       by_interface(input.outcome->contacts, [](const auto& o) { return o.contact->inter; })) {
    const bool idle = std::all_of(list.begin(), list.end(), [](const cycle::ContactOutcome* o) {
      return o->pairs_in_reach == 0 && is_no_limit(o->step.dt) &&
             (o->contact->dropped || state_words(*o).empty());
    });
    if (idle && !all) {
      quiet.push_back(list.front()->contact->inter->id);
      continue;
    }
    table.row(contact_row(input, list, false, all));
    if (all && list.size() > 1)
      for (const cycle::ContactOutcome* o : list) table.row(contact_row(input, {o}, true, all));
  }
  return table.below_heading(options) + folded_ids(quiet, "interface without a pair in reach",
                                                   "interfaces without a pair in reach");
}

std::string singular_table(const CycleInput& input, const CycleTextOptions& options) {
  const Model& model = *input.scene->model;
  std::vector<std::pair<const cycle::ContactOutcome*, const cycle::PairOutcome*>> all;
  for (const cycle::ContactOutcome& o : input.outcome->contacts)
    for (const cycle::PairOutcome& p : o.near_singular) all.emplace_back(&o, &p);
  const auto left = [](const cycle::PairOutcome& p) {
    return p.gap > 0 ? (p.gap - p.penetration) / p.gap : 1.0;
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const auto& a, const auto& b) { return left(*a.second) < left(*b.second); });
  TextTable table({">left of gap", ">gap", ">distance", ">|F|", ">stiffness", ">interface",
                   "node/edge", "segment/edge"});
  for (std::size_t i = 0; i < std::min<std::size_t>(all.size(), 10); ++i) {
    const auto& [o, p] = all[i];
    const PairNodes nodes = pair_nodes(*o->contact, p->at.secondary, p->at.main);
    table.row({fmt::format("{:.3g} %", 100 * left(*p)), p->gap, p->distance,
               figure_text(norm(to_vec(p->force))), figure_text(p->k_nodal), o->contact->inter->id,
               ids_text(model, nodes.secondary, '-'), ids_text(model, nodes.main, ' ')});
  }
  return table.below_heading(options);
}

/// Reason why no contact limits the step.
const char* no_limit_text(const cycle::SceneOutcome& o) {
  const auto open = std::count_if(o.contacts.begin(), o.contacts.end(),
                                  [](const cycle::ContactOutcome& c) { return !c.complete; });
  if (open == 0) return "no limit at this state";
  return static_cast<std::size_t>(open) == o.contacts.size() ? "not evaluated"
                                                             : "no limit of those evaluated";
}

std::string step_lines(const CycleInput& input) {
  const cycle::SceneOutcome& o = *input.outcome;
  const Model& model = *input.scene->model;
  const bool mesh = o.structure.element != no_index;
  std::string out = "  mesh     no element limits the step\n";
  if (mesh)
    out = fmt::format("  mesh     {:.4g} = {:g} x {:.4g} of {} {}\n", o.structure.dt,
                      cycle::step_scale, o.structure.dt / cycle::step_scale,
                      detail::kind_name(o.structure.kind),
                      model.family(o.structure.kind).id[o.structure.element]);
  if (is_no_limit(o.contact_dt)) return out + "  contact  " + no_limit_text(o) + "\n";
  static constexpr const char* sources[] = {"", "half the time to the mid-surface",
                                            "contact stiffness against nodal mass",
                                            "gap over the largest relative velocity"};
  out += fmt::format("  contact  {:.4g}", o.contact_dt);
  if (o.contact_dt_source == cycle::StepLimit::Source::nodal)
    out += fmt::format(" = {:g} sqrt(2 m / S), m {:.4g}, S {:.4g}", cycle::step_scale,
                       input.state->mass[o.limiting_node], o.nodes.stiffness[o.limiting_node]);
  out += fmt::format(", {}", sources[static_cast<std::size_t>(o.contact_dt_source)]);
  if (o.limiting_contact != SIZE_MAX)
    out += fmt::format(", interface {}", o.contacts[o.limiting_contact].contact->inter->id);
  if (o.limiting_node != no_index) out += fmt::format(", node {}", model.node_id(o.limiting_node));
  const double times = o.contact_dt / o.structure.dt;
  if (mesh)
    out += times < 1
               ? fmt::format("\n  contact governs: {:.3g} % off the step of the mesh",
                             100 * (1 - times))
               : fmt::format("\n  the mesh governs: contact allows {:.3g} times its step", times);
  return out + "\n";
}

// ---- effects ----------------------------------------------------------------------------------

std::string change_of(double with, double without) {
  if (with == without) return "same";
  if (!std::isfinite(with) || !std::isfinite(without)) return std::string(not_computed);
  if (is_no_limit(without)) return "no limit";
  if (is_no_limit(with)) return "a limit";
  if (with == 0.0) return "new";
  return fmt::format("{:+.2g} %", 100.0 * (without - with) / with);
}

/// Force, energy and time step with and without an effect; "" if not wanted.
std::string without_text(const CycleInput& input, const CycleTextOptions& options) {
  if (input.without == nullptr) return {};
  const auto with = cycle::summarize(*input.scene, *input.outcome);
  const auto without = cycle::summarize(*input.scene, *input.without);
  TextTable table({">id", "type", "", ">sum |F|", ">energy", ">dt", ">acceleration"});
  const auto row = [&](const cycle::InterfaceSummary& s, bool first) {
    const double energy = s.elastic_energy + s.friction_energy + s.damping_energy;
    table.row({first ? std::to_string(s.id) : "", first ? type_name(*s.inter) : "",
               first ? "with" : "without", figure_text(s.force_sum), figure_text(energy),
               step_text(s.contact_dt), figure_text(s.largest_acceleration)});
  };
  std::vector<std::int64_t> same;
  for (std::size_t k = 0; k < with.size(); ++k) {
    const cycle::InterfaceSummary &a = with[k], &b = without[k];
    if (a.force_sum == b.force_sum && a.elastic_energy == b.elastic_energy &&
        a.friction_energy == b.friction_energy && a.damping_energy == b.damping_energy &&
        a.contact_dt == b.contact_dt && a.largest_acceleration == b.largest_acceleration) {
      same.push_back(a.id);
      continue;
    }
    row(a, true);
    row(b, false);
  }
  std::string out = table.below_heading(options) +
                    folded_ids(same, "interface has the same force, energy and step",
                               "interfaces have the same force, energy and step");
  if (table.size() == 0 && input.options.dt12 == 0.0)
    out += "  (what slides or rubs shows with --dt and --velocity)\n";
  const cycle::SceneOutcome &a = *input.outcome, &b = *input.without;
  out += fmt::format("  largest force on a node {}, without {} ({})\n",
                     figure_text(a.largest_nodal_force), figure_text(b.largest_nodal_force),
                     change_of(a.largest_nodal_force, b.largest_nodal_force));
  if (!is_no_limit(a.contact_dt) || !is_no_limit(b.contact_dt))
    out += fmt::format("  time step of contact {}, without {} ({})\n", step_text(a.contact_dt),
                       step_text(b.contact_dt), change_of(a.contact_dt, b.contact_dt));
  return out;
}

/// Contacts without evaluation, with reasons; nodes and edges of a TYPE25 share a line.
std::string not_evaluated_lines(const CycleInput& input) {
  std::string out;
  for (const std::string& text : input.state->not_evaluated)
    out += "  " + terminal_text(text) + "\n";
  for (const cycle::ContactOutcome& o : input.outcome->contacts)
    for (const std::string& text : o.notes) {
      const std::string line = line_head(*o.contact) + terminal_text(text) + "\n";
      if (out.find(line) == std::string::npos) out += line;
    }
  return out;
}

std::string heat_lines(const cycle::SceneOutcome& outcome) {
  std::string out;
  for (const cycle::ContactOutcome& o : outcome.contacts)
    if (o.heat_secondary != 0 || o.heat_main != 0)
      out += fmt::format(
          "{}heat in this cycle {:.4g} to the secondary side, {:.4g} to the main side\n",
          line_head(*o.contact), o.heat_secondary, o.heat_main);
  return out;
}

}  // namespace

const char* to_string(cycle::Removal::Because because) {
  static constexpr const char* words[] = {"mid-surface reached", "dtmin (time to the mid-surface)",
                                          "dtmin (stiffness against mass)",
                                          "no element left (Idel)"};
  return words[static_cast<std::size_t>(because)];
}

std::string cycle_text(const CycleInput& input, const CycleTextOptions& options) {
  const auto below = [&](std::string_view title, const std::string& text) {
    return titled(title, text, options.color);
  };
  std::string out;
  if (options.several) out += toned(terminal_text(input.path), Tone::cyan, options.color) + "\n";
  const std::string verdict = verdict_text(cycle_verdict(input), options.color) +
                              (input.gate == nullptr ? std::string() : gate_text(*input.gate));
  if (input.scene->contacts.empty()) return out + verdict;
  const std::string units = ", in " + units_text(input.deck->begin.working);
  const std::string interfaces = below("Interfaces" + units, contact_table(input, options));
  out += out.empty() ? interfaces.substr(1) : interfaces;
  out += input.steps == nullptr ? below("From now on", lasting_lines(input))
                                : below("Steps", steps_text(input, options));
  out += below("Criteria of adaptive meshing, sharpest first", criteria_table(input, options));
  out += below("Time step" + units, step_lines(input)) + heat_lines(*input.outcome);
  out += below("Nearest to the mid-surface", singular_table(input, options));
  out += below("Effects", effects_text(input, options));
  out += below("With and without " + input.without_effect, without_text(input, options));
  out += below("Not evaluated", not_evaluated_lines(input));
  if (const std::string text = decisions_text(*input.scene, options.verbose); !text.empty())
    out += "\n" + text;
  return out + "\n" + verdict;
}

}  // namespace deck
