// deck parts for people: a table of the parts, what they add up to, and a CSV file of the same.
#include <fmt/format.h>

#include <cmath>

#include "base/shared/escape.hpp"
#include "base/shared/length_text.hpp"
#include "deck/text/number.hpp"
#include "model/shared/kinematics.hpp"
#include "model/shared/mesh.hpp"
#include "report/shared/parts.hpp"
#include "report/terminal/words.hpp"

namespace deck {
namespace {

std::string six_digits(double v) { return figure_text(v, 6); }

std::string known_number(double v) { return std::isnan(v) ? "?" : v == 0.0 ? "" : six_digits(v); }
std::string part_step(double dt) { return dt >= 1e29 ? "" : six_digits(dt); }

std::string elements_text(const detail::PartView& v) {
  std::string out;
  for (std::size_t k = 0; k < v.elements.size(); ++k)
    if (v.elements[k] > 0)
      append(out, ", ",
             fmt::format("{} {}", v.elements[k], detail::kind_name(static_cast<ElementKind>(k))));
  return out.empty() ? "none" : out;
}

std::string slowest_element(const Model& model, const PartFigures& f) {
  if (f.slowest.element == no_index) return "";
  return fmt::format("{} {}", detail::kind_name(f.slowest.kind),
                     model.family(f.slowest.kind).id[f.slowest.element]);
}

/// "Contacts 1 and 2 cover the same 3 pairs of parts, for example 4 and 5"
std::string repeated_text(const detail::RepeatedContacts& c) {
  return fmt::format("Contacts {} cover the same {} of parts{}{}\n",
                     c.interfaces.size() == 2
                         ? fmt::format("{} and {}", c.interfaces[0], c.interfaces[1])
                         : first_of(c.interfaces, 8),
                     count(c.pairs, "pair", "pairs"), c.pairs > 1 ? ", for example " : ": ",
                     c.part == c.other ? fmt::format("{} with itself", c.part)
                                       : fmt::format("{} and {}", c.part, c.other));
}

void summary(const LoadedDeck& loaded, const detail::PartsView& view, std::string& out) {
  const Model& model = loaded.model();
  const Mesh& mesh = loaded.mesh();
  const Kinematics& k = loaded.kinematics();
  out += "\nMass of all elements: " + six_digits(mesh.total.mass) + "\n";
  if (mesh.total.slowest.element != no_index)
    out += fmt::format("Smallest time step of an element: {} ({})\n", part_step(mesh.total.dt),
                       slowest_element(model, mesh.total));
  const std::vector<double>& steps = mesh.nodes.dt;
  std::size_t node = steps.size();
  for (std::size_t n = 0; n < steps.size(); ++n)
    if (steps[n] < 1e29 && (node == steps.size() || steps[n] < steps[node])) node = n;
  if (node < steps.size())
    out += fmt::format("Smallest time step of a node: {} (node {})\n", part_step(steps[node]),
                       model.nodes.id[node]);
  if (view.unconnected_nodes > 0)
    out += count(view.unconnected_nodes, "node belongs", "nodes belong") + " to no element\n";
  if (!view.unseen_parts.empty())
    out += count(view.unseen_parts.size(), "part is", "parts are") +
           " in no contact and no tie: " + first_of(view.unseen_parts, 12) + "\n";
  constexpr std::size_t most_repeated = 5;
  for (std::size_t i = 0; i < std::min(most_repeated, view.repeated.size()); ++i)
    out += repeated_text(view.repeated[i]);
  if (view.repeated.size() > most_repeated)
    out += (view.repeated.size() < detail::most_repeated_contacts ? "" : "At least ") +
           count(view.repeated.size() - most_repeated, "more set", "more sets") +
           " of contacts that cover the same parts (--json lists them)\n";
  if (k.conflicts > 0)
    out += count(k.conflicts, "conflicting condition", "conflicting conditions") +
           " (counted per node and direction) on " + count(k.several.size(), "node", "nodes") +
           " (warning 312)\n";
  for (const auto* left : {&mesh.left_out, &k.left_out})
    for (const LeftOut& l : *left)
      out += fmt::format("Not computed: {} ({}): {}\n", l.what, l.count, l.why);
}

}  // namespace

std::string parts_text(const LoadedDeck& loaded, const PartsTextOptions& options) {
  const Model& model = loaded.model();
  const Mesh& mesh = loaded.mesh();
  const detail::PartsView view = detail::view_parts(loaded);
  TextTable table({">part", "title", "elements", ">material", ">property", ">thickness", ">mass",
                   ">step", "of element", "interfaces", ">rigid body"});
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Part& part = model.parts[p];
    const detail::PartView& v = view.parts[p];
    const PartFigures& f = mesh.parts[p];
    const bool slowest = f.slowest.element != no_index && f.dt == mesh.total.dt;
    table.row({part.id,
               part.title,
               elements_text(v),
               part.mat_id,
               part.prop_id,
               known_number(v.thickness),
               known_number(f.mass),
               {part_step(f.dt), slowest ? Tone::yellow : Tone::plain},
               slowest_element(model, f),
               first_of(v.interfaces, options.all ? v.interfaces.size() : 8),
               v.rigid_body == 0 ? "" : std::to_string(v.rigid_body)});
  }
  std::string out = table.fitted(options.width, options.color);
  summary(loaded, view, out);
  return out;
}

std::string parts_csv(const LoadedDeck& loaded) {
  struct PartLine {
    const Part& part;
    const detail::PartView& v;
    const PartFigures& f;
  };
  const Model& model = loaded.model();
  const auto number = [](double x) { return std::isfinite(x) ? shortest(x) : std::string(); };
  const auto limits = [](const PartFigures& f) { return f.slowest.element != no_index; };
  const auto slowest_id = [&](const ElementRef& e) { return model.family(e.kind).id[e.element]; };
  CsvTable<PartLine> table(
      {}, CSV("part", r.part.id), CSV("title", r.part.title), CSV("elements", elements_text(r.v)),
      CSV("material", r.part.mat_id), CSV("property", r.part.prop_id),
      CSV("thickness", number(r.v.thickness)), CSV("mass", number(r.f.mass)),
      CSV("centre_x", number(r.f.centre[0])), CSV("centre_y", number(r.f.centre[1])),
      CSV("centre_z", number(r.f.centre[2])), CSV("inertia_xx", number(r.f.inertia[0])),
      CSV("inertia_yy", number(r.f.inertia[1])), CSV("inertia_zz", number(r.f.inertia[2])),
      CSV("inertia_xy", number(r.f.inertia[3])), CSV("inertia_yz", number(r.f.inertia[4])),
      CSV("inertia_zx", number(r.f.inertia[5])), CSV("dt", r.f.dt >= 1e29 ? "" : shortest(r.f.dt)),
      CSV("dt_kind", limits(r.f) ? detail::kind_name(r.f.slowest.kind) : ""),
      CSV("dt_element", limits(r.f) ? std::to_string(slowest_id(r.f.slowest)) : ""),
      CSV("interfaces", fmt::format("{}", fmt::join(r.v.interfaces, " "))),
      CSV("rigid_body", r.v.rigid_body == 0 ? "" : std::to_string(r.v.rigid_body)));
  const detail::PartsView view = detail::view_parts(loaded);
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    table.add({model.parts[p], view.parts[p], loaded.mesh().parts[p]});
  return table.text();
}

}  // namespace deck
