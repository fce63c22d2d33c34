// The effects of the first cycle for people.
#include "report/terminal/cycle_effects_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

#include "base/shared/count.hpp"
#include "base/shared/escape.hpp"
#include "base/shared/length_text.hpp"
#include "report/cycle_costs.hpp"
#include "report/shared/text_table.hpp"
#include "report/terminal/words.hpp"

namespace deck {
namespace {

/// An interface with its effects.
struct InterfaceEffects {
  const InterBase* inter = nullptr;
  std::vector<EffectLine> lines;
};

std::vector<InterfaceEffects> effects_by_interface(const CycleInput& input) {
  std::vector<InterfaceEffects> out;
  for (const InterBase* inter : input.scene->interfaces->ordered)
    if (auto lines = effect_lines(*input.deck, *input.outcome, *inter); !lines.empty())
      out.push_back({inter, std::move(lines)});
  return out;
}

/// The names of all effects, in the order in which they occur.
std::vector<std::string> effect_names(const std::vector<InterfaceEffects>& all) {
  std::vector<std::string> names;
  for (const InterfaceEffects& one : all)
    for (const EffectLine& line : one.lines)
      if (std::find(names.begin(), names.end(), line.name) == names.end())
        names.push_back(line.name);
  return names;
}

const EffectLine* line_of(const InterfaceEffects& one, const std::string& name) {
  for (const EffectLine& line : one.lines)
    if (line.name == name) return &line;
  return nullptr;
}

/// Effects that run somewhere down, interfaces across, with the field that asks for each.
std::string effect_matrix(const std::vector<InterfaceEffects>& all,
                          const CycleTextOptions& options) {
  std::vector<TextTable::Column> columns{{"effect"}};
  for (const InterfaceEffects& one : all)
    columns.push_back({fmt::format("{} TYPE{}", one.inter->id, one.inter->type)});
  TextTable table(columns);
  for (const std::string& name : effect_names(all)) {
    std::vector<TextTable::Cell> cells{{name}};
    for (const InterfaceEffects& one : all) {
      const EffectLine* line = line_of(one, name);
      if (line == nullptr)
        cells.emplace_back("");
      else if (line->on)
        cells.emplace_back(line->field.empty() ? "on" : line->reason, Tone::green);
      else
        cells.emplace_back("-", Tone::dim);
    }
    if (std::any_of(all.begin(), all.end(), [&](const InterfaceEffects& one) {
          const EffectLine* line = line_of(one, name);
          return line != nullptr && line->on;
        }))
      table.row(std::move(cells));
  }
  return table.fitted(options.width, options.color, 2);
}

/// "friction-law: Ifric = 0 (1, 2)", one line for each effect that is off somewhere.
std::string off_lines(const std::vector<InterfaceEffects>& all) {
  std::string out;
  for (const std::string& name : effect_names(all)) {
    std::vector<std::pair<std::string, std::string>> reasons;  // with ids
    for (const InterfaceEffects& one : all) {
      const EffectLine* line = line_of(one, name);
      if (line == nullptr || (line->on && line->not_edges.empty())) continue;
      const std::string why = line->on ? "not between edges: " + line->not_edges : line->reason;
      const auto known = std::find_if(reasons.begin(), reasons.end(),
                                      [&](const auto& r) { return r.first == why; });
      const std::string id = std::to_string(one.inter->id);
      if (known == reasons.end())
        reasons.emplace_back(why, id);
      else
        known->second += ", " + id;
    }
    std::string text;
    for (const auto& [reason, ids] : reasons)
      text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", reason, ids);
    if (!text.empty()) out += fmt::format("  {}: {}\n", name, terminal_text(text));
  }
  return out;
}

std::string joined_effects(const std::vector<EffectLine>& lines) {
  std::string text;
  for (const EffectLine& e : lines) {
    if (!e.on) continue;
    if (!text.empty()) text += "; ";
    text += e.because == "always" ? e.name : fmt::format("{}: {}", e.name, e.because);
  }
  return text;
}

std::string change_of(double with, double without) {
  if (with == without) return "same";
  if (!std::isfinite(with) || !std::isfinite(without)) return std::string(not_computed);
  if (with == 0.0) return "new";
  return fmt::format("{:+.2g} %", 100.0 * (without - with) / with);
}

}  // namespace

std::string effects_text(const CycleInput& input, const CycleTextOptions& options) {
  const std::vector<InterfaceEffects> all = effects_by_interface(input);
  std::string out = "  " + short_cost_sentence(input) + "\n";
  if (options.effects) {
    out += effect_matrix(all, options);
    if (const std::string off = off_lines(all); !off.empty())
      out += "\nEffects that do not run, and why (interfaces)\n" + off;
    if (!options.verbose) return out;
    out += "\nFields and lines\n";
  }
  for (const InterfaceEffects& one : all)
    out += fmt::format("  {} TYPE{} on: {}\n", one.inter->id, one.inter->type,
                       terminal_text(joined_effects(one.lines)));
  return options.effects ? out : out + "  (--effects shows what is off, and why)\n";
}

std::string without_text(const CycleInput& input, const CycleTextOptions& options) {
  if (input.without == nullptr) return {};
  const auto with = cycle::summarize(*input.scene, *input.outcome);
  const auto without = cycle::summarize(*input.scene, *input.without);
  TextTable table = make_table({">id", "type", "", ">sum |F|", ">energy", ">dt", ">acceleration"});
  const auto row = [&](const cycle::InterfaceSummary& s, bool first) {
    const double energy = s.elastic_energy + s.friction_energy + s.damping_energy;
    table.row({first ? std::to_string(s.id) : "", first ? fmt::format("TYPE{}", s.inter->type) : "",
               first ? "with" : "without", figure_text(s.force_sum), figure_text(energy),
               s.contact_dt < 1e30 ? figure_text(s.contact_dt) : "-",
               figure_text(s.largest_acceleration)});
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
  std::string out = table.size() > 0 ? table.fitted(options.width, options.color, 2) : "";
  out += folded_ids(same, "interface has the same force, energy and step",
                    "interfaces have the same force, energy and step");
  if (table.size() == 0 && input.options.dt12 == 0.0)
    out += "  (what slides or rubs shows with --dt and --velocity)\n";
  const cycle::SceneOutcome &a = *input.outcome, &b = *input.without;
  out += fmt::format("  largest nodal force {}, without {} ({})\n",
                     figure_text(a.largest_nodal_force), figure_text(b.largest_nodal_force),
                     change_of(a.largest_nodal_force, b.largest_nodal_force));
  if (a.contact_dt < 1e30 || b.contact_dt < 1e30)
    out += fmt::format("  time step of contact {:.4g}, without {:.4g} ({})\n", a.contact_dt,
                       b.contact_dt, change_of(a.contact_dt, b.contact_dt));
  return out;
}

}  // namespace deck
