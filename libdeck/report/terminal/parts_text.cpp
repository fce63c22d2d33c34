// deck parts for people: a table of the parts, what they add up to, and a CSV file of the same.
#include <fmt/format.h>

#include <cmath>

#include "base/shared/count.hpp"
#include "base/shared/escape.hpp"
#include "base/shared/length_text.hpp"
#include "deck/text/number.hpp"
#include "model/shared/kinematics.hpp"
#include "model/shared/mesh.hpp"
#include "report/shared/parts.hpp"
#include "report/shared/text_table.hpp"

namespace deck {
namespace {

std::string six_digits(double v) { return figure_text(v, 6); }

std::string known_number(double v) { return std::isnan(v) ? "?" : v == 0.0 ? "" : six_digits(v); }
std::string part_step(double dt) { return dt >= 1e29 ? "" : six_digits(dt); }

std::string elements_text(const detail::PartView& v) {
  std::string out;
  for (std::size_t k = 0; k < v.elements.size(); ++k)
    if (v.elements[k] > 0) {
      if (!out.empty()) out += ", ";
      out += std::to_string(v.elements[k]) + " ";
      out += detail::kind_name(static_cast<ElementKind>(k));
    }
  return out.empty() ? "none" : out;
}

std::string element_text(const Model& model, const PartFigures& f) {
  if (f.slowest.element == no_index) return "";
  return std::string(detail::kind_name(f.slowest.kind)) + " " +
         std::to_string(model.family(f.slowest.kind).id[f.slowest.element]);
}

std::string list(const std::vector<std::int64_t>& ids, std::size_t most) {
  std::string out;
  for (std::size_t i = 0; i < ids.size() && i < most; ++i)
    out += (i == 0 ? "" : ", ") + std::to_string(ids[i]);
  if (ids.size() > most) out += " and " + std::to_string(ids.size() - most) + " more";
  return out;
}

void summary(const LoadedDeck& loaded, const detail::PartsView& view, std::string& out) {
  const Model& model = loaded.model();
  const Mesh& mesh = loaded.mesh();
  const Kinematics& k = loaded.kinematics();
  out += "\nMass of all elements: " + six_digits(mesh.total.mass) + "\n";
  if (mesh.total.slowest.element != no_index)
    out += "Smallest time step of an element: " + part_step(mesh.total.dt) + " (" +
           element_text(model, mesh.total) + ")\n";
  std::size_t node = mesh.nodes.dt.size();
  for (std::size_t n = 0; n < mesh.nodes.dt.size(); ++n)
    if (mesh.nodes.dt[n] < 1e29 &&
        (node == mesh.nodes.dt.size() || mesh.nodes.dt[n] < mesh.nodes.dt[node]))
      node = n;
  if (node < mesh.nodes.dt.size())
    out += "Smallest time step of a node: " + part_step(mesh.nodes.dt[node]) + " (node " +
           std::to_string(model.nodes.id[node]) + ")\n";
  if (view.unconnected_nodes > 0)
    out += count(view.unconnected_nodes, "node belongs", "nodes belong") + " to no element\n";
  if (!view.unseen_parts.empty())
    out += count(view.unseen_parts.size(), "part is", "parts are") +
           " in no contact and no tie: " + list(view.unseen_parts, 12) + "\n";
  constexpr std::size_t most_repeated = 5;
  for (std::size_t i = 0; i < std::min(most_repeated, view.repeated.size()); ++i) {
    const detail::RepeatedContacts& c = view.repeated[i];
    const std::string all = c.interfaces.size() == 2 ? std::to_string(c.interfaces[0]) + " and " +
                                                           std::to_string(c.interfaces[1])
                                                     : list(c.interfaces, 8);
    out += "Contacts " + all + " cover the same " + count(c.pairs, "pair", "pairs") + " of parts" +
           (c.pairs > 1 ? ", for example " : ": ") +
           (c.part == c.other ? std::to_string(c.part) + " with itself"
                              : std::to_string(c.part) + " and " + std::to_string(c.other)) +
           "\n";
  }
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
      out += "Not computed: " + l.what + " (" + std::to_string(l.count) + "): " + l.why + "\n";
}

}  // namespace

std::string parts_text(const LoadedDeck& loaded, const PartsTextOptions& options) {
  const Model& model = loaded.model();
  const Mesh& mesh = loaded.mesh();
  const detail::PartsView view = detail::view_parts(loaded);
  TextTable table({{"part", Align::right},
                   {"title"},
                   {"elements"},
                   {"material", Align::right},
                   {"property", Align::right},
                   {"thickness", Align::right},
                   {"mass", Align::right},
                   {"step", Align::right},
                   {"of element"},
                   {"interfaces"},
                   {"rigid body", Align::right}});
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Part& part = model.parts[p];
    const detail::PartView& v = view.parts[p];
    const PartFigures& f = mesh.parts[p];
    const bool slowest = f.slowest.element != no_index && f.dt == mesh.total.dt;
    table.row({std::to_string(part.id),
               part.title,
               elements_text(v),
               std::to_string(part.mat_id),
               std::to_string(part.prop_id),
               known_number(v.thickness),
               known_number(f.mass),
               {part_step(f.dt), slowest ? Tone::yellow : Tone::plain},
               element_text(model, f),
               list(v.interfaces, options.all ? v.interfaces.size() : 8),
               v.rigid_body == 0 ? "" : std::to_string(v.rigid_body)});
  }
  std::string out = table.fitted(options.width, options.color);
  summary(loaded, view, out);
  return out;
}

std::string parts_csv(const LoadedDeck& loaded) {
  const Model& model = loaded.model();
  const Mesh& mesh = loaded.mesh();
  const detail::PartsView view = detail::view_parts(loaded);
  std::string out =
      "part,title,elements,material,property,thickness,mass,centre_x,centre_y,centre_z,inertia_xx,"
      "inertia_yy,inertia_zz,inertia_xy,inertia_yz,inertia_zx,dt,dt_kind,dt_element,interfaces,"
      "rigid_body\r\n";
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Part& part = model.parts[p];
    const detail::PartView& v = view.parts[p];
    const PartFigures& f = mesh.parts[p];
    const auto add = [&](double x) {
      out += "," + (std::isfinite(x) ? shortest(x) : std::string());
    };
    out += std::to_string(part.id) + "," + csv_text(part.title) + "," + csv_text(elements_text(v)) +
           "," + std::to_string(part.mat_id) + "," + std::to_string(part.prop_id);
    add(v.thickness);
    add(f.mass);
    for (const double x : f.centre) add(x);
    for (const double x : f.inertia) add(x);
    out += "," + (f.dt >= 1e29 ? std::string() : shortest(f.dt)) + ",";
    if (f.slowest.element != no_index) {
      out += detail::kind_name(f.slowest.kind);
      out += "," + std::to_string(model.family(f.slowest.kind).id[f.slowest.element]);
    } else {
      out += ",";
    }
    out += ",";
    for (std::size_t i = 0; i < v.interfaces.size(); ++i)
      out += (i == 0 ? "" : " ") + std::to_string(v.interfaces[i]);
    out += "," + (v.rigid_body == 0 ? std::string() : std::to_string(v.rigid_body)) + "\r\n";
  }
  return out;
}

}  // namespace deck
