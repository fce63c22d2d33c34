// The geometry stage as VTK files: surfaces, edges, ties and penetrations of every contact; how
// such a file is written, and the script that opens them in ParaView with colours and arrows set.
#include <algorithm>
#include <span>

#include "deck/contact/closest.hpp"
#include "deck/contact/ties.hpp"
#include "deck/contact/view.hpp"
#include "report/html/stream.hpp"
#include "report/shared/vtk.hpp"
#include "report/vtk/vtk_writer.hpp"

namespace deck {

namespace detail {

/// Little-endian words of eight bytes; the length in bytes goes before the data, both in one run of
/// base64.
void VtkPolyData::add_element(std::string& out, std::string_view name, const char* type,
                              bool vectors, const Words& words) {
  out += std::string("<DataArray type=\"") + type + "\" Name=\"";
  out += name;
  if (vectors) out += "\" NumberOfComponents=\"3";
  out += "\" format=\"binary\">\n";
  std::string bytes;
  const auto add = [&](std::uint64_t word) {
    for (int i = 0; i < 8; ++i) bytes += static_cast<char>(word >> (8 * i) & 0xffU);
  };
  add(8 * words.size());
  for (const std::uint64_t word : words) add(word);
  out += base64(bytes) + "\n</DataArray>\n";
}

std::string VtkPolyData::document() const {
  const auto count = [&](Cells kind) {
    return std::to_string(kind == kind_ ? offsets_.size() : std::size_t{0});
  };
  const std::string element = kind_ == Cells::vertices ? "Verts"
                              : kind_ == Cells::lines  ? "Lines"
                                                       : "Polys";
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
      std::to_string(points()) + "\" NumberOfVerts=\"" + count(Cells::vertices) +
      "\" NumberOfLines=\"" + count(Cells::lines) + "\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
      count(Cells::polygons) + "\">\n<PointData>\n" + point_arrays_ + "</PointData>\n<CellData>\n" +
      cell_arrays_ + "</CellData>\n<Points>\n";
  add_array(out, "Points", points_);
  out += "</Points>\n<" + element + ">\n";
  add_array(out, "connectivity", connectivity_);
  add_array(out, "offsets", offsets_);
  out += "</" + element + ">\n</Piece>\n</PolyData>\n</VTKFile>\n";
  return out;
}

}  // namespace detail

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
      out_.add_point({model_.nodes.x[n], model_.nodes.y[n], model_.nodes.z[n]});
    }
    return number_[n];
  }
  const std::vector<NodeIndex>& nodes() const { return nodes_; }

 private:
  const Model& model_;
  VtkPolyData& out_;
  std::vector<std::uint32_t> number_;
  std::vector<NodeIndex> nodes_;
};

/// Largest depth per item of one side.
std::vector<double> depths(const Contact& c, std::size_t items,
                           std::uint32_t PenetrationRow::*side) {
  std::vector<double> out(items, 0);
  if (c.ties()) return out;
  for (const PenetrationRow& r : c.penetrations) out[r.*side] = std::max(out[r.*side], r.depth);
  return out;
}

std::span<const NodeIndex> corners(const SecondaryNode& s) { return {&s.node, 1}; }
std::span<const NodeIndex> corners(const ContactEdge& e) { return e.nodes; }
std::span<const NodeIndex> corners(const MainSegment& m) {
  return std::span(m.nodes).first(m.nodes[2] == m.nodes[3] ? 3 : 4);
}

/// By node: the gap of the node if it is secondary too, else the largest of its segments.
std::vector<double> gaps_at_nodes(const Model& model, const Contact& c) {
  std::vector<double> gap(model.nodes.size(), 0);
  for (const MainSegment& m : c.main)
    for (const NodeIndex n : m.nodes) gap[n] = std::max(gap[n], m.gap);
  for (const SecondaryNode& s : c.secondary)
    if (s.gap >= 0) gap[s.node] = s.gap;
  return gap;
}

template <class Item>
std::string side_file(const Model& model, const Contact& c, Cells cells,
                      const std::vector<Item>& items, double Item::*stiffness,
                      std::uint32_t PenetrationRow::*side) {
  VtkPolyData out(cells);
  Points points(model, out);
  for (const Item& item : items) {
    std::vector<std::uint32_t> cell;
    for (const NodeIndex n : corners(item)) cell.push_back(points.of(n));
    out.add_cell(cell);
  }
  out.point_data("node", points.nodes(), [&](NodeIndex n) { return model.node_id(n); });
  out.cell_data("stiffness", items, stiffness);
  out.cell_data("gap", items, &Item::gap);
  out.cell_data("depth", depths(c, items.size(), side));
  out.cell_data("off", items, &Item::off);
  if constexpr (std::is_same_v<Item, MainSegment>) {
    const std::vector<double> gap = gaps_at_nodes(model, c);
    out.point_data("gap", points.nodes(), [&](NodeIndex n) { return gap[n]; });
  }
  if constexpr (!std::is_same_v<Item, SecondaryNode>) {
    const auto name = [&](const Item& i) { return carrier_name(model, i.carrier, i.element); };
    out.cell_data("element", items, [&](const Item& i) { return name(i).id; });
    out.cell_data("part", items, [&](const Item& i) { return name(i).part; });
  }
  return out.document();
}

/// Ties as lines from their nodes to the nearest points of their segments.
std::string tie_lines(const Model& model, const Tie& tie) {
  VtkPolyData out(Cells::lines);
  const auto at = [&](NodeIndex n) {
    return Point3<double>{model.nodes.x[n], model.nodes.y[n], model.nodes.z[n]};
  };
  const auto found = [](const TiedNode& n) { return n.segment != no_index; };
  for (const TiedNode& n : tie.nodes) {
    const std::uint32_t segment = found(n) ? n.segment : n.nearest;
    const Point3<double> p = at(n.node);
    Point3<double> foot = p;
    if (segment != no_index) {
      const std::array<NodeIndex, 4>& c = tie.main[segment];
      foot = p - closest_on_segment<Form::reference>(p, {at(c[0]), at(c[1]), at(c[2]), at(c[3])},
                                                     c[2] == c[3])
                     .closest()
                     .vector;
    }
    out.add_cell(std::array{out.points(), out.points() + 1});
    out.add_point({p.x, p.y, p.z});
    out.add_point({foot.x, foot.y, foot.z});
  }
  out.cell_data("node", tie.nodes, [&](const TiedNode& n) { return model.node_id(n.node); });
  out.cell_data("tied", tie.nodes, &TiedNode::tied);
  out.cell_data("lost", tie.nodes, &TiedNode::lost);
  out.cell_data("message", tie.nodes, &TiedNode::message);
  out.cell_data("distance", tie.nodes,
                [&](const TiedNode& n) { return found(n) ? n.distance : n.nearest_distance; });
  out.cell_data("search", tie.nodes,
                [&](const TiedNode& n) { return n.search != 0 ? n.search : tie.search_distance; });
  return out.document();
}

std::string penetrations(const Scene& scene, const SceneView& view) {
  VtkPolyData out(Cells::vertices);
  for (const NamedPenetration& p : view.penetrations) out.add_vertex(p.at);
  const auto column = [&](const char* name, auto value_of) {
    out.point_data(name, view.penetrations, [&](const NamedPenetration& p) {
      return value_of(scene.contacts[p.contact].penetrations[p.row]);
    });
  };
  using Row = PenetrationRow;
  column("arrow", [](const Row& r) {
    return std::array{r.depth * r.normal[0], r.depth * r.normal[1], r.depth * r.normal[2]};
  });
  column("normal", [](const Row& r) { return r.normal; });
  column("depth", [](const Row& r) { return r.depth; });
  column("gap", [](const Row& r) { return r.gap; });
  column("ratio", [](const Row& r) { return r.gap > 0 ? r.depth / r.gap : 0; });
  column("action", [](const Row& r) { return static_cast<std::int64_t>(r.action); });
  column("on_surface", [](const Row& r) { return r.on_surface; });
  column("in_contact", [](const Row& r) { return r.in_contact; });
  using Named = NamedPenetration;
  out.point_data("node", view.penetrations, [](const Named& p) { return p.secondary[0]; });
  out.point_data("interface", view.penetrations,
                 [&](const Named& p) { return scene.contacts[p.contact].inter->id; });
  return out.document();
}

}  // namespace

std::vector<VtkFile> gaps_vtk(const Scene& scene, const SceneView& view) {
  std::vector<VtkFile> files;
  const Model& model = *scene.model;
  for (const Contact& c : scene.contacts) {
    const auto add = [&](auto side, Cells cells, const auto& items, auto stiffness) {
      const char* name = side == &PenetrationRow::main ? "main" : "secondary";
      if (!items.empty())
        files.push_back({file_name(c, name), side_file(model, c, cells, items, stiffness, side)});
    };
    add(&PenetrationRow::main, Cells::polygons, c.main, &MainSegment::stiffness);
    add(&PenetrationRow::secondary, Cells::vertices, c.secondary, &SecondaryNode::multiplier);
    add(&PenetrationRow::main, Cells::lines, c.main_edges, &ContactEdge::stiffness);
    add(&PenetrationRow::secondary, Cells::lines, c.secondary_edges, &ContactEdge::stiffness);
  }
  for (const Tie& tie : scene.ties)
    if (!tie.nodes.empty())
      files.push_back(
          {"interface_" + std::to_string(tie.inter->id) + "_ties.vtp", tie_lines(model, tie)});
  files.push_back({"penetrations.vtp", penetrations(scene, view)});
  return files;
}

namespace {

constexpr const char* script_head =
    R"~(# Opens the files of this folder in ParaView, coloured and with arrows:
#   paraview --script=open.py     or File > Load State, or: pvpython open.py (writes open.png)
# Made for paraview.simple of ParaView 5.9 and later.
import os
import sys

import paraview.simple as pv

HERE = os.path.dirname(os.path.abspath(globals().get("__file__", "open.py")))
VIEW = pv.GetActiveViewOrCreate("RenderView")


def read(name):
    path = os.path.join(HERE, name)
    if name.endswith(".pvd"):
        return pv.PVDReader(registrationName=name, FileName=path)
    return pv.XMLPolyDataReader(registrationName=name, FileName=[path])


def surface(name, array, opacity):
    """The elements of one side, coloured by a value of each; deeper is hotter."""
    display = pv.Show(read(name), VIEW)
    display.Opacity = opacity
    pv.ColorBy(display, ("CELLS", array))
    display.RescaleTransferFunctionToDataRange(True)


def points(name, array, arrow, size, longest):
    """Points coloured by a value, with arrows; the longest is this part of the model."""
    source = read(name)
    source.UpdatePipeline()
    display = pv.Show(source, VIEW)
    display.PointSize = 5
    pv.ColorBy(display, ("POINTS", array))
    display.RescaleTransferFunctionToDataRange(True)
    if source.GetDataInformation().GetNumberOfPoints() == 0:
        return
    top = source.PointData[size].GetRange(0)[1]
    low = source.GetDataInformation().GetBounds()
    model = max(low[1] - low[0], low[3] - low[2], low[5] - low[4], 1e-30)
    glyph = pv.Glyph(registrationName="arrows of " + name, Input=source, GlyphType="Arrow")
    glyph.OrientationArray = ["POINTS", arrow]
    glyph.ScaleArray = ["POINTS", size]
    glyph.ScaleFactor = longest * model / top if top > 0 else 1.0
    glyph.GlyphMode = "All Points"
    arrows = pv.Show(glyph, VIEW)
    pv.ColorBy(arrows, ("POINTS", array))
    arrows.RescaleTransferFunctionToDataRange(True)
    arrows.SetScalarBarVisibility(VIEW, True)


)~";

constexpr const char* script_tail = R"~(
VIEW.ResetCamera()
pv.Render(VIEW)
if os.path.basename(sys.executable or "").startswith("pvpython"):
    pv.SaveScreenshot(os.path.join(HERE, "open.png"), VIEW)
)~";

}  // namespace

VtkFile paraview_script(const std::vector<VtkFile>& files) {
  // Of a series only the collections: they hold its files.
  const bool series = std::any_of(files.begin(), files.end(),
                                  [](const VtkFile& f) { return f.name.ends_with(".pvd"); });
  std::string out = script_head;
  for (const VtkFile& f : files) {
    if (series && !f.name.ends_with(".pvd")) continue;
    const std::string name = "\"" + f.name + "\"";
    if (f.name.starts_with("penetrations"))
      out += "points(" + name + ", \"depth\", \"arrow\", \"depth\", 0.05)\n";
    else if (f.name.starts_with("contact_nodes"))
      out += "points(" + name + ", \"dt\", \"force\", \"force_size\", 0.1)\n";
    else if (f.name.starts_with("contact_pairs"))
      out += "points(" + name + ", \"penetration\", \"force\", \"force_size\", 0.05)\n";
    else if (f.name.ends_with("_main.vtp"))
      out += "surface(" + name + ", \"depth\", 0.35)\n";
    else if (f.name.ends_with("_ties.vtp"))
      out += "surface(" + name + ", \"lost\", 1.0)\n";
    else
      out += "surface(" + name + ", \"depth\", 1.0)\n";
  }
  return {"open.py", out + script_tail};
}

}  // namespace deck
