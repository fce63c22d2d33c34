// `deck cycle` for people: what the first force evaluation does, contact by contact.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "base/shared/escape.hpp"
#include "base/shared/length_text.hpp"
#include "cycle/shared/step_scale.hpp"
#include "report/cycle_costs.hpp"
#include "report/gaps_names.hpp"
#include "report/shared/cycle.hpp"
#include "report/shared/gate.hpp"
#include "report/shared/text_table.hpp"
#include "report/terminal/cycle_effects_text.hpp"
#include "report/terminal/words.hpp"

namespace deck {
namespace {

/// "X, Y" of fixed translations.
std::string directions(int bits) {
  std::string text;
  const char* const names[] = {"X", "Y", "Z"};
  for (int k = 0; k < 3; ++k)
    if ((bits & (4 >> k)) != 0) text += (text.empty() ? "" : ", ") + std::string(names[k]);
  return text.empty() ? "none" : text;
}

std::string node_text(const Model& model, NodeIndex n) {
  return n == no_index ? "-" : fmt::format("{}", model.node_id(n));
}

/// Of a step of 1e30, and of a share of it.
bool is_no_limit(double dt) { return dt >= 1e29; }
std::string step_text(double dt) { return is_no_limit(dt) ? "-" : figure_text(dt); }

double size(const std::array<double, 3>& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/// "node" or "edge" of a pair.
std::string secondary_text(const Model& model, const Contact& c, const cycle::PairOutcome& p) {
  if (c.kind == ContactKind::node_segment)
    return node_text(model, c.secondary[p.at.secondary].node);
  const auto& n = c.secondary_edges[p.at.secondary].nodes;
  return fmt::format("{}-{}", model.node_id(n[0]), model.node_id(n[1]));
}

std::string main_text(const Model& model, const Contact& c, const cycle::PairOutcome& p) {
  std::string text;
  const auto add = [&](NodeIndex n) {
    text += fmt::format("{}{}", text.empty() ? "" : " ", model.node_id(n));
  };
  if (c.kind == ContactKind::edge_edge) {
    for (const NodeIndex n : c.main_edges[p.at.main].nodes) add(n);
  } else {
    const auto& n = c.main[p.at.main].nodes;
    for (std::size_t k = 0; k < (n[2] == n[3] ? 3u : 4u); ++k) add(n[k]);
  }
  return text;
}

/// "node 1, node 2, … and 5 more" of those that leave an interface.
std::string names_of(const Model& model, const Contact& c, const std::vector<cycle::Removal>& list,
                     std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, list.size()); ++i)
    text += (i == 0 ? "" : ", ") + secondary_name(model, c, list[i].secondary);
  if (list.size() > most) text += fmt::format(" and {} more", list.size() - most);
  return text;
}

/// Who leaves its interface for good, ties, or is released in this cycle.
std::string lasting_lines(const CycleInput& input) {
  const Model& model = *input.scene->model;
  std::string out;
  for (const cycle::ContactOutcome& o : input.outcome->contacts) {
    const std::string head =
        fmt::format("  interface {} {}: ", o.contact->inter->id, kind_name(*o.contact));
    for (const auto because :
         {cycle::Removal::Because::mid_surface, cycle::Removal::Because::kinematic_step,
          cycle::Removal::Because::nodal_step, cycle::Removal::Because::no_element_left}) {
      std::vector<cycle::Removal> list;
      for (const cycle::Removal& r : o.removed)
        if (r.because == because) list.push_back(r);
      if (!list.empty())
        out += fmt::format("{}removed for good, {}: {}\n", head, to_string(because),
                           names_of(model, *o.contact, list, 10));
    }
    std::size_t tied = 0, let_go = 0;
    for (const cycle::TieChange& t : o.ties) ++(t.tied ? tied : let_go);
    if (tied > 0) out += head + count(tied, "pair is tied\n", "pairs are tied\n");
    if (let_go > 0) out += head + count(let_go, "pair lets go\n", "pairs let go\n");
    if (!o.released.empty()) {
      out += head + "boundary conditions released (IBC) at ";
      for (std::size_t i = 0; i < std::min<std::size_t>(10, o.released.size()); ++i)
        out += fmt::format("{}node {}: {} -> {}", i == 0 ? "" : ", ",
                           model.node_id(o.released[i].node), directions(o.released[i].before),
                           directions(o.released[i].after));
      if (o.released.size() > 10) out += fmt::format(" and {} more", o.released.size() - 10);
      out += "\n";
    }
  }
  return out;
}

/// Iadm: the nodes with the sharpest radius. The last column is below 1 where the normals of a
/// segment and of its corner differ by more than Angladm.
std::string criteria_table(const CycleInput& input, const CycleTextOptions& options) {
  const Model& model = *input.scene->model;
  TextTable table = make_table(
      {">interface", ">node", ">radius", ">penetration / (Padm gap)", ">cos / cos Angladm"});
  for (const cycle::ContactOutcome& o : input.outcome->contacts) {
    std::vector<cycle::NodeCriteria> list = o.criteria;
    std::stable_sort(list.begin(), list.end(),
                     [](const auto& a, const auto& b) { return a.radius < b.radius; });
    for (std::size_t i = 0; i < std::min<std::size_t>(10, list.size()); ++i)
      table.row({fmt::format("{}", o.contact->inter->id), node_text(model, list[i].node),
                 fmt::format("{:.6g}", list[i].radius), figure_text(list[i].penetration),
                 list[i].angle < 1e30 ? fmt::format("{:.6g}", list[i].angle) : "-"});
  }
  return table.size() > 0 ? table.fitted(options.width, options.color, 2) : std::string();
}

std::string event_text(const CycleInput& input, const cycle::StepEvent& e) {
  const Model& model = *input.scene->model;
  const Contact& c = input.scene->contacts[e.contact];
  std::string text = fmt::format("  step {} ({:.6g}): interface {} {}: ", e.step, e.time,
                                 c.inter->id, kind_name(c));
  switch (e.kind) {
    case cycle::StepEvent::Kind::removed:
      return text + fmt::format("{} removed, {}\n", secondary_name(model, c, e.at.secondary),
                                to_string(e.because));
    case cycle::StepEvent::Kind::released:
      return text + fmt::format("node {} fixed in {} -> {}\n", model.node_id(e.release.node),
                                directions(e.release.before), directions(e.release.after));
    default: {
      cycle::PairOutcome pair;
      pair.at = e.at;
      return text + fmt::format("{} {} {}\n", secondary_name(model, c, e.at.secondary),
                                e.kind == cycle::StepEvent::Kind::tied ? "tied to" : "lets go of",
                                main_text(model, c, pair));
    }
  }
}

/// The history in at most twenty lines, and the first events.
std::string steps_text(const CycleInput& input, const CycleTextOptions& options) {
  const cycle::StepsOutcome& s = *input.steps;
  TextTable table = make_table({">step", ">time", ">pairs with force", ">sum of |F|",
                                ">elastic energy", ">tied", ">removed so far"});
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
    table.row({fmt::format("{}", k), fmt::format("{:.6g}", s.lines[k].time),
               fmt::format("{}", sum.pairs_with_force), figure_text(sum.force_sum),
               figure_text(sum.elastic_energy), fmt::format("{}", sum.pairs_tied),
               fmt::format("{}", sum.removed)});
  }
  std::string out =
      "  prescribed motion only: nodes keep their given velocities, no structure answers and "
      "contact "
      "forces move nothing\n" +
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
    if (n > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, what);
  };
  add(o.gap_closed, "at the mid-surface");
  add(removed_by_step(o), "removed by dtmin");
  add(o.pairs_tied, "tied");
  if (o.massless_nodes > 0)
    text += fmt::format("{}{} without mass", text.empty() ? "" : ", ", o.massless_nodes);
  return text;
}

/// What is to be said of the contacts of one interface; with several each by its role.
std::string note_of(const std::vector<const cycle::ContactOutcome*>& list) {
  std::string note;
  for (const cycle::ContactOutcome* o : list) {
    const std::string words = state_words(*o);
    if (words.empty()) continue;
    note += note.empty() ? "" : "; ";
    note += list.size() > 1 ? fmt::format("{}: {}", to_string(o->contact->role), words) : words;
  }
  return note;
}

/// One row per interface; those without a pair in reach in one line. With `verbose` all of them,
/// every contact of a TYPE19 in a row of its own below, and more columns.
std::string contact_table(const CycleInput& input, const CycleTextOptions& options) {
  const Model& model = *input.scene->model;
  const bool all = options.verbose;
  TextTable table =
      all ? make_table({">id", "type", "title", ">in reach", ">with force", ">sum of |F|",
                        ">largest |F|", ">elastic energy", ">friction", ">damping", ">acceleration",
                        "of node", ">contact dt", "of node", ">near singular", "note"})
          : make_table(
                {">id", "type", "title", ">pairs", ">sum |F|", ">energy", ">dt", "node", "note"});
  const auto add = [&](const std::vector<const cycle::ContactOutcome*>& list, bool part) {
    const cycle::InterfaceSummary s = cycle::summarize(list, input.outcome->structure);
    const Contact& c = *list.front()->contact;
    std::vector<TextTable::Cell> cells = {
        fmt::format("{}", c.inter->id), part ? kind_name(c) : fmt::format("TYPE{}", c.inter->type),
        part ? "" : c.inter->title};
    // Where nothing was evaluated no figure is known.
    const bool known = std::any_of(list.begin(), list.end(),
                                   [](const cycle::ContactOutcome* o) { return o->complete; });
    const auto count = [&](std::size_t n) {
      cells.emplace_back(known ? fmt::format("{}", n) : "-");
    };
    const auto figure = [&](double v) { cells.emplace_back(known ? figure_text(v) : "-"); };
    if (all) count(s.pairs_in_reach);
    count(s.pairs_with_force);
    figure(s.force_sum);
    if (all) figure(s.largest_pair_force);
    figure(all ? s.elastic_energy : s.elastic_energy + s.friction_energy + s.damping_energy);
    if (all) {
      figure(s.friction_energy);
      figure(s.damping_energy);
      figure(s.largest_acceleration);
      cells.emplace_back(node_text(model, s.acceleration_node));
    }
    const bool limits = s.contact_dt < s.structure_dt;
    cells.emplace_back(step_text(s.contact_dt), limits ? Tone::yellow : Tone::plain);
    cells.emplace_back(node_text(model, s.contact_dt_node));
    if (all) count(s.near_singular);
    cells.emplace_back(note_of(list), s.gap_closed > 0 ? Tone::red : Tone::plain);
    table.row(std::move(cells));
  };
  std::vector<std::int64_t> quiet;
  for (const auto& places :
       by_interface(input.outcome->contacts,
                    [](const cycle::ContactOutcome& o) { return o.contact->inter; })) {
    std::vector<const cycle::ContactOutcome*> list;
    for (const std::size_t i : places) list.push_back(&input.outcome->contacts[i]);
    const bool idle = std::all_of(list.begin(), list.end(), [](const cycle::ContactOutcome* o) {
      return o->pairs_in_reach == 0 && is_no_limit(o->step.dt) &&
             (o->contact->dropped || state_words(*o).empty());
    });
    if (idle && !all) {
      quiet.push_back(list.front()->contact->inter->id);
      continue;
    }
    add(list, false);
    if (all && list.size() > 1)
      for (const cycle::ContactOutcome* o : list) add({o}, true);
  }
  std::string out;
  if (table.size() > 0) out = table.fitted(options.width, options.color, 2);
  return out + folded_ids(quiet, "interface without a pair in reach",
                          "interfaces without a pair in reach");
}

std::string singular_table(const CycleInput& input, const CycleTextOptions& options) {
  const Model& model = *input.scene->model;
  std::vector<std::pair<const cycle::ContactOutcome*, const cycle::PairOutcome*>> all;
  for (const cycle::ContactOutcome& o : input.outcome->contacts)
    for (const cycle::PairOutcome& p : o.near_singular) all.emplace_back(&o, &p);
  if (all.empty()) return {};
  const auto left = [](const cycle::PairOutcome& p) {
    return p.gap > 0 ? (p.gap - p.penetration) / p.gap : 1.0;
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const auto& a, const auto& b) { return left(*a.second) < left(*b.second); });
  TextTable table = make_table({">left of gap", ">gap", ">distance", ">|F|", ">stiffness",
                                ">interface", "node/edge", "segment/edge"});
  for (std::size_t i = 0; i < std::min<std::size_t>(all.size(), 10); ++i) {
    const auto& [o, p] = all[i];
    table.row({fmt::format("{:.3g} %", 100 * left(*p)), fmt::format("{:.6g}", p->gap),
               fmt::format("{:.6g}", p->distance), figure_text(size(p->force)),
               figure_text(p->k_nodal), fmt::format("{}", o->contact->inter->id),
               secondary_text(model, *o->contact, *p), main_text(model, *o->contact, *p)});
  }
  return table.fitted(options.width, options.color, 2);
}

const char* element_name(ElementKind kind) {
  switch (kind) {
    case ElementKind::shell4:
      return "shell";
    case ElementKind::shell3:
      return "3-node shell";
    case ElementKind::solid8:
      return "solid";
    case ElementKind::truss:
      return "truss";
    case ElementKind::beam:
      return "beam";
    case ElementKind::spring:
      return "spring";
    default:
      return "element";
  }
}

/// What it means that no contact gives a step.
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
  std::string out = "  structure  ";
  if (o.structure.element == no_index)
    out += "no element limits the step\n";
  else
    out += fmt::format("{:.4g}, {} {}; times {:g}: {:.4g}\n", o.structure.dt / cycle::step_scale,
                       element_name(o.structure.kind),
                       model.family(o.structure.kind).id[o.structure.element], cycle::step_scale,
                       o.structure.dt);
  out += "  contact    ";
  if (is_no_limit(o.contact_dt)) return out + no_limit_text(o) + "\n";
  const char* why = o.contact_dt_source == cycle::StepLimit::Source::nodal
                        ? "contact stiffness against nodal mass"
                    : o.contact_dt_source == cycle::StepLimit::Source::kinematic
                        ? "half the time to the mid-surface"
                        : "gap over the largest relative velocity";
  out += fmt::format("{:.4g}, {}", o.contact_dt, why);
  if (o.limiting_contact != SIZE_MAX)
    out += fmt::format(", interface {}", o.contacts[o.limiting_contact].contact->inter->id);
  if (o.limiting_node != no_index) out += fmt::format(", node {}", model.node_id(o.limiting_node));
  return out + "\n";
}

}  // namespace

const char* to_string(cycle::Removal::Because because) {
  switch (because) {
    case cycle::Removal::Because::kinematic_step:
      return "dtmin (time to the mid-surface)";
    case cycle::Removal::Because::nodal_step:
      return "dtmin (stiffness against mass)";
    case cycle::Removal::Because::no_element_left:
      return "no element left (Idel)";
    default:
      return "mid-surface reached";
  }
}

std::string cycle_text(const CycleInput& input, const CycleTextOptions& options) {
  const char* bold = options.color ? "\033[1m" : "";
  const char* plain = options.color ? "\033[0m" : "";
  std::string out;
  if (options.several) out += toned(terminal_text(input.path), Tone::cyan, options.color) + "\n";
  const std::string verdict = verdict_text(cycle_verdict(input), options.color) +
                              (input.gate == nullptr ? std::string() : gate_text(*input.gate));
  if (input.scene->contacts.empty()) return out + verdict;
  out += fmt::format("{}{}Interfaces{}\n{}", out.empty() ? "" : "\n", bold, plain,
                     contact_table(input, options));
  if (const std::string text = lasting_lines(input); !text.empty() && input.steps == nullptr)
    out += fmt::format("\n{}From now on{}\n{}", bold, plain, text);
  if (input.steps != nullptr)
    out += fmt::format("\n{}Steps{}\n{}", bold, plain, steps_text(input, options));
  if (const std::string text = criteria_table(input, options); !text.empty())
    out += fmt::format("\n{}Criteria of adaptive meshing, sharpest first{}\n{}", bold, plain, text);
  out += fmt::format("\n{}Time step{}\n{}", bold, plain, step_lines(input));
  for (const cycle::ContactOutcome& o : input.outcome->contacts)
    if (o.heat_secondary != 0 || o.heat_main != 0)
      out += fmt::format(
          "  interface {} {}: heat in this cycle {:.4g} to the secondary side, {:.4g} "
          "to the main side\n",
          o.contact->inter->id, kind_name(*o.contact), o.heat_secondary, o.heat_main);
  if (const std::string table = singular_table(input, options); !table.empty())
    out += fmt::format("\n{}Nearest to the mid-surface{}\n{}", bold, plain, table);
  out += fmt::format("\n{}Effects{}\n{}", bold, plain, effects_text(input, options));
  if (const std::string text = without_text(input, options); !text.empty())
    out += fmt::format("\n{}With and without {}{}\n{}", bold, input.without_effect, plain, text);
  if (const std::string text = cost_text(input, options); !text.empty())
    out += fmt::format("\n{}What effects cost{}\n{}", bold, plain, text);
  std::string left_out;
  for (const std::string& text : input.state->not_evaluated)
    left_out += "  " + terminal_text(text) + "\n";
  for (const cycle::ContactOutcome& o : input.outcome->contacts)
    for (const std::string& text : o.notes) {
      const std::string line = fmt::format("  interface {} {}: {}\n", o.contact->inter->id,
                                           kind_name(*o.contact), terminal_text(text));
      // Nodes and edges of a TYPE25 say the same.
      if (left_out.find(line) == std::string::npos) left_out += line;
    }
  if (!left_out.empty()) out += fmt::format("\n{}Not evaluated{}\n{}", bold, plain, left_out);
  if (const std::string text =
          decisions_text(*input.scene, 3, options.verbose, options.color, options.width);
      !text.empty())
    out += "\n" + text;
  return out + "\n" + verdict;
}

}  // namespace deck
