// `deck cycle` for people: what the first force evaluation does, contact by contact.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "deck/base/escape.hpp"
#include "deck/model/coverage.hpp"
#include "deck/report/cycle.hpp"
#include "deck/report/text_table.hpp"
#include "report/accuracy_decisions.hpp"

namespace deck {
namespace {

TextTable make_table(std::initializer_list<const char*> titles) {
  std::vector<TextTable::Column> columns;
  for (const char* t : titles)
    columns.push_back(*t == '>' ? TextTable::Column{t + 1, Align::right}
                                : TextTable::Column{t, Align::left});
  return TextTable(std::move(columns));
}

std::string kind_name(const Contact& c) {
  std::string name = fmt::format("TYPE{}", c.inter->type);
  if (c.inter->type == 19) name += fmt::format(" {}", to_string(c.role));
  return name;
}

std::string node_text(const Model& model, NodeIndex n) {
  return n == no_index ? "-" : fmt::format("{}", model.node_id(n));
}

std::string step_text(double dt) { return dt < 1e30 ? fmt::format("{:.4g}", dt) : "-"; }

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

std::string state_words(const cycle::ContactOutcome& o) {
  if (o.contact->dropped) return "no edges, dropped";
  if (!o.active) return "not active yet";
  if (!o.complete) return o.notes.empty() ? "too many pairs" : "not evaluated";
  std::string text;
  if (o.gap_closed > 0) text = fmt::format("{} at the mid-surface", o.gap_closed);
  if (o.massless_nodes > 0)
    text += fmt::format("{}{} without mass", text.empty() ? "" : ", ", o.massless_nodes);
  return text;
}

std::string contact_table(const CycleInput& input, bool color) {
  const Model& model = *input.scene->model;
  const double structure = input.outcome->structure.dt;
  TextTable table =
      make_table({">interface", "kind", ">in reach", ">with force", ">sum of |F|", ">largest |F|",
                  ">elastic energy", ">friction", ">damping", ">acceleration", "of node",
                  ">contact dt", "of node", ">near singular", "note"});
  std::size_t quiet = 0;
  for (const cycle::ContactOutcome& o : input.outcome->contacts) {
    if (o.pairs_in_reach == 0 && o.step.dt >= 1e30 && state_words(o).empty()) {
      ++quiet;
      continue;
    }
    const bool limits = o.step.dt < structure;
    table.row({fmt::format("{}", o.contact->inter->id),
               kind_name(*o.contact),
               fmt::format("{}", o.pairs_in_reach),
               fmt::format("{}", o.pairs_with_force),
               fmt::format("{:.4g}", o.totals.total_abs),
               fmt::format("{:.4g}", o.largest_force),
               fmt::format("{:.4g}", o.totals.elastic_energy),
               fmt::format("{:.4g}", o.totals.friction_energy),
               fmt::format("{:.4g}", o.totals.damping_energy),
               fmt::format("{:.4g}", o.largest_acceleration),
               node_text(model, o.acceleration_node),
               {step_text(o.step.dt), limits ? Tone::yellow : Tone::plain},
               node_text(model, o.step_node),
               fmt::format("{}", o.near_singular_count),
               {state_words(o), o.gap_closed > 0 ? Tone::red : Tone::plain}});
  }
  std::string out = table.size() > 0 ? table.render(color, 2) : std::string();
  if (quiet > 0)
    out += fmt::format("  {} contact{} without a pair in reach\n", quiet, quiet == 1 ? "" : "s");
  return out;
}

std::string singular_table(const CycleInput& input, bool color) {
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
               fmt::format("{:.6g}", p->distance), fmt::format("{:.4g}", size(p->force)),
               fmt::format("{:.4g}", p->k_nodal), fmt::format("{}", o->contact->inter->id),
               secondary_text(model, *o->contact, *p), main_text(model, *o->contact, *p)});
  }
  return table.render(color, 2);
}

std::string joined(const std::vector<EffectLine>& lines, bool on) {
  std::string text;
  for (const EffectLine& e : lines) {
    if (e.on != on) continue;
    if (!text.empty()) text += "; ";
    text += e.because == "always" ? e.name : fmt::format("{}: {}", e.name, e.because);
  }
  return text;
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

std::string step_lines(const CycleInput& input) {
  const cycle::SceneOutcome& o = *input.outcome;
  const Model& model = *input.scene->model;
  std::string out = "  structure  ";
  if (o.structure.element == no_index)
    out += "no element limits the step\n";
  else
    out += fmt::format("{:.4g}, {} {} (estimate)\n", o.structure.dt, element_name(o.structure.kind),
                       model.family(o.structure.kind).id[o.structure.element]);
  out += "  contact    ";
  if (o.contact_dt >= 1e30) return out + "no limit at this state\n";
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

std::string cycle_verdict(const CycleInput& input) {
  const Coverage coverage = coverage_of(*input.deck, *input.scene->interfaces);
  const std::string tail = coverage_tail(coverage);
  if (const std::string lead = coverage_lead(coverage); !lead.empty()) return lead + tail;
  const cycle::SceneOutcome& o = *input.outcome;
  const Model& model = *input.scene->model;
  std::size_t pairs = 0, closed = 0;
  const cycle::ContactOutcome* worst = nullptr;
  for (const cycle::ContactOutcome& c : o.contacts) {
    pairs += c.pairs_with_force;
    closed += c.gap_closed;
    if (worst == nullptr || c.largest_acceleration > worst->largest_acceleration) worst = &c;
  }
  if (pairs == 0 && closed == 0)
    return fmt::format("No contact force at the start in {} contact{}.{}", o.contacts.size(),
                       o.contacts.size() == 1 ? "" : "s", tail);
  std::string text = fmt::format("{} pair{} push{} at the start; largest nodal force {:.4g} at {}.",
                                 pairs, pairs == 1 ? "" : "s", pairs == 1 ? "es" : "",
                                 o.largest_nodal_force, node_text(model, o.force_node));
  if (worst != nullptr && worst->acceleration_node != no_index)
    text += fmt::format(" Largest acceleration {:.4g}: node {}, interface {}.",
                        worst->largest_acceleration, model.node_id(worst->acceleration_node),
                        worst->contact->inter->id);
  if (closed > 0)
    text += fmt::format(" {} pair{} at the mid-surface: the solver drops the node{}.", closed,
                        closed == 1 ? " is" : "s are", closed == 1 ? "" : "s");
  if (o.contact_dt < o.structure.dt && o.structure.dt < 1e30)
    text += fmt::format(" Contact limits the time step: {:.4g} against {:.4g} of the elements.",
                        o.contact_dt, o.structure.dt);
  return text + tail;
}

std::string cycle_text(const CycleInput& input, const CycleTextOptions& options) {
  const char* bold = options.color ? "\033[1m" : "";
  const char* plain = options.color ? "\033[0m" : "";
  std::string out = fmt::format("{}{}{}\n", bold, terminal_text(cycle_verdict(input)), plain);
  if (input.scene->contacts.empty()) return out;
  out += fmt::format("\n{}Contacts{}\n{}", bold, plain, contact_table(input, options.color));
  out += fmt::format("\n{}Time step{}\n{}", bold, plain, step_lines(input));
  for (const cycle::ContactOutcome& o : input.outcome->contacts)
    if (o.heat_secondary != 0 || o.heat_main != 0)
      out += fmt::format(
          "  interface {} {}: heat in this cycle {:.4g} to the secondary side, {:.4g} "
          "to the main side\n",
          o.contact->inter->id, kind_name(*o.contact), o.heat_secondary, o.heat_main);
  if (const std::string table = singular_table(input, options.color); !table.empty())
    out += fmt::format("\n{}Nearest to the mid-surface{}\n{}", bold, plain, table);
  if (const std::string text = decisions_text(*input.scene, 3, options.color); !text.empty())
    out += "\n" + text;
  out += fmt::format("\n{}Effects{}\n", bold, plain);
  for (const InterBase* inter : input.scene->interfaces->ordered) {
    const auto lines = effect_lines(*input.deck, *input.outcome, *inter);
    if (lines.empty()) continue;
    out += fmt::format("  {} TYPE{} on: {}\n", inter->id, inter->type,
                       terminal_text(joined(lines, true)));
    if (options.effects) out += fmt::format("    off: {}\n", terminal_text(joined(lines, false)));
  }
  if (!options.effects) out += "  (--effects lists what is off, and why)\n";
  std::string left_out;
  for (const std::string& text : input.state->not_evaluated)
    left_out += "  " + terminal_text(text) + "\n";
  for (const cycle::ContactOutcome& o : input.outcome->contacts)
    for (const std::string& text : o.notes)
      left_out += fmt::format("  interface {} {}: {}\n", o.contact->inter->id,
                              kind_name(*o.contact), terminal_text(text));
  if (!left_out.empty()) out += fmt::format("\n{}Not evaluated{}\n{}", bold, plain, left_out);
  return out;
}

}  // namespace deck
