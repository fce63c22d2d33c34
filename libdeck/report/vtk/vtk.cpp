// Writes surfaces, edges and penetrations of every contact.
#include "report/shared/vtk.hpp"

#include <algorithm>

#include "deck/contact/view.hpp"
#include "report/vtk/vtk_writer.hpp"

namespace deck {
namespace {

using detail::VtkPolyData;
using Cells = VtkPolyData::Cells;

std::string file_name(const Contact& c, const char* side) {
  std::string name = "interface_" + std::to_string(c.inter->id);
  // A TYPE11 of the user is the only part of its interface.
  if (c.role != ContactRole::primary) name += std::string("_") + to_string(c.role);
  return name + "_" + side + ".vtp";
}

/// Gives nodes point numbers in order of first use.
class Points {
 public:
  Points(const Model& model, VtkPolyData& out)
      : model_(model), out_(out), number_(model.nodes.size(), no_index) {}
  std::uint32_t of(NodeIndex n) {
    if (number_[n] == no_index) {
      number_[n] = static_cast<std::uint32_t>(nodes_.size());
      nodes_.push_back(n);
      ids_.push_back(model_.node_id(n));
      out_.add_point(model_.nodes.x[n], model_.nodes.y[n], model_.nodes.z[n]);
    }
    return number_[n];
  }
  const std::vector<NodeIndex>& nodes() const { return nodes_; }
  const std::vector<std::int64_t>& ids() const { return ids_; }

 private:
  const Model& model_;
  VtkPolyData& out_;
  std::vector<std::uint32_t> number_;
  std::vector<NodeIndex> nodes_;
  std::vector<std::int64_t> ids_;
};

/// Largest depth per item of one side.
std::vector<double> depths(const Contact& c, std::size_t items,
                           std::uint32_t PenetrationRow::*side) {
  std::vector<double> out(items, 0);
  if (c.ties()) return out;
  for (const PenetrationRow& r : c.penetrations) out[r.*side] = std::max(out[r.*side], r.depth);
  return out;
}

/// One value per item.
template <class T, class Items, class Value>
std::vector<T> each(const Items& items, const Value& value) {
  std::vector<T> out;
  out.reserve(items.size());
  for (const auto& item : items) out.push_back(static_cast<T>(value(item)));
  return out;
}

/// Ids of the carrying elements and their parts; 0 where there is none.
template <class Items>
void add_elements(const Model& model, const Items& items, VtkPolyData& out) {
  std::vector<std::int64_t> elements, parts;
  for (const auto& item : items) {
    const Elements* family = item.element == no_index ? nullptr : elements_of(model, item.carrier);
    const std::uint32_t part = family == nullptr ? no_index : family->part[item.element];
    elements.push_back(family == nullptr ? 0 : family->id[item.element]);
    parts.push_back(part == no_index ? 0 : model.parts[part].id);
  }
  out.cell_data("element", elements);
  out.cell_data("part", parts);
}

std::string main_surface(const Model& model, const Contact& c) {
  VtkPolyData out(Cells::polygons);
  Points points(model, out);
  for (const MainSegment& m : c.main) {
    std::vector<std::uint32_t> corners;
    for (std::size_t k = 0; k < (m.nodes[2] == m.nodes[3] ? 3U : 4U); ++k)
      corners.push_back(points.of(m.nodes[k]));
    out.add_cell(corners);
  }
  std::vector<double> gap(points.nodes().size(), 0);
  for (const MainSegment& m : c.main)
    for (const NodeIndex n : m.nodes) gap[points.of(n)] = std::max(gap[points.of(n)], m.gap);
  std::vector<double> own(model.nodes.size(), -1);
  for (const SecondaryNode& s : c.secondary) own[s.node] = s.gap;
  for (std::size_t i = 0; i < gap.size(); ++i)
    if (const double g = own[points.nodes()[i]]; g >= 0) gap[i] = g;
  out.point_data("node", points.ids());
  out.point_data("gap", gap);
  out.cell_data("stiffness",
                each<double>(c.main, [](const MainSegment& m) { return m.stiffness; }));
  out.cell_data("gap", each<double>(c.main, [](const MainSegment& m) { return m.gap; }));
  out.cell_data("depth", depths(c, c.main.size(), &PenetrationRow::main));
  out.cell_data("off", each<std::int64_t>(c.main, [](const MainSegment& m) { return m.off; }));
  add_elements(model, c.main, out);
  return out.document();
}

std::string secondary_nodes(const Model& model, const Contact& c) {
  VtkPolyData out(Cells::vertices);
  Points points(model, out);
  using Node = SecondaryNode;
  for (const Node& s : c.secondary) out.add_cell(std::array{points.of(s.node)});
  out.point_data("node", points.ids());
  out.cell_data("stiffness", each<double>(c.secondary, [](const Node& s) { return s.multiplier; }));
  out.cell_data("gap", each<double>(c.secondary, [](const Node& s) { return s.gap; }));
  out.cell_data("depth", depths(c, c.secondary.size(), &PenetrationRow::secondary));
  out.cell_data("off", each<std::int64_t>(c.secondary, [](const Node& s) { return s.off; }));
  return out.document();
}

std::string edge_side(const Model& model, const Contact& c, bool main) {
  const auto& edges = main ? c.main_edges : c.secondary_edges;
  VtkPolyData out(Cells::lines);
  Points points(model, out);
  for (const ContactEdge& e : edges)
    out.add_cell(std::array{points.of(e.nodes[0]), points.of(e.nodes[1])});
  out.point_data("node", points.ids());
  out.cell_data("stiffness", each<double>(edges, [](const ContactEdge& e) { return e.stiffness; }));
  out.cell_data("gap", each<double>(edges, [](const ContactEdge& e) { return e.gap; }));
  out.cell_data("depth",
                depths(c, edges.size(), main ? &PenetrationRow::main : &PenetrationRow::secondary));
  out.cell_data("off", each<std::int64_t>(edges, [](const ContactEdge& e) { return e.off; }));
  add_elements(model, edges, out);
  return out.document();
}

std::string penetrations(const Scene& scene, const SceneView& view) {
  VtkPolyData out(Cells::vertices);
  std::vector<double> arrow, normal, depth, gap, ratio;
  std::vector<std::int64_t> action, on_surface, in_contact, node, interface;
  for (const NamedPenetration& p : view.penetrations) {
    const Contact& c = scene.contacts[p.contact];
    const PenetrationRow& r = c.penetrations[p.row];
    out.add_cell(std::array{out.points()});
    out.add_point(p.at[0], p.at[1], p.at[2]);
    for (const double n : r.normal) {
      normal.push_back(n);
      arrow.push_back(r.depth * n);
    }
    depth.push_back(r.depth);
    gap.push_back(r.gap);
    ratio.push_back(r.gap > 0 ? r.depth / r.gap : 0);
    action.push_back(static_cast<std::int64_t>(r.action));
    on_surface.push_back(r.on_surface);
    in_contact.push_back(r.in_contact);
    node.push_back(p.secondary[0]);
    interface.push_back(c.inter->id);
  }
  out.point_data("arrow", arrow, 3);
  out.point_data("normal", normal, 3);
  out.point_data("depth", depth);
  out.point_data("gap", gap);
  out.point_data("ratio", ratio);
  out.point_data("action", action);
  out.point_data("on_surface", on_surface);
  out.point_data("in_contact", in_contact);
  out.point_data("node", node);
  out.point_data("interface", interface);
  return out.document();
}

}  // namespace

std::vector<VtkFile> gaps_vtk(const Scene& scene, const SceneView& view) {
  std::vector<VtkFile> files;
  const Model& model = *scene.model;
  for (const Contact& c : scene.contacts) {
    if (!c.main.empty()) files.push_back({file_name(c, "main"), main_surface(model, c)});
    if (!c.secondary.empty())
      files.push_back({file_name(c, "secondary"), secondary_nodes(model, c)});
    if (!c.main_edges.empty()) files.push_back({file_name(c, "main"), edge_side(model, c, true)});
    if (!c.secondary_edges.empty())
      files.push_back({file_name(c, "secondary"), edge_side(model, c, false)});
  }
  for (const Tie& tie : scene.ties)
    if (!tie.nodes.empty())
      files.push_back({"interface_" + std::to_string(tie.inter->id) + "_ties.vtp",
                       detail::tie_lines(model, tie)});
  files.push_back({"penetrations.vtp", penetrations(scene, view)});
  return files;
}

}  // namespace deck
