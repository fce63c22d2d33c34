// Contacts, pairs and forces as VTK files for ParaView: surfaces, edges, ties and penetrations of
// the geometry stage; pairs and nodes of the force stage; a script that opens them with colours and
// arrows.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/shared/vec.hpp"
#include "contact/shared/closest.hpp"
#include "contact/shared/node_elements.hpp"
#include "report/html/stream.hpp"
#include "report/shared/cycle.hpp"
#include "report/shared/vtk.hpp"

namespace deck {

namespace detail {

/// Collects arrays into one document; cells of one kind.
class VtkPolyData {
 public:
  enum class Cells : std::uint8_t { vertices, lines, polygons };
  explicit VtkPolyData(Cells kind) : kind_(kind) {}

  void add_point(const std::array<double, 3>& at) { points_.push_back(at); }
  /// Adds a cell of point numbers.
  template <class Range>
  void add_cell(const Range& points) {
    for (const auto p : points) connectivity_.push_back(static_cast<std::int64_t>(p));
    offsets_.push_back(static_cast<std::int64_t>(connectivity_.size()));
  }
  /// Adds a point as a cell.
  void add_vertex(const std::array<double, 3>& at) {
    add_cell(std::array{points()});
    add_point(at);
  }
  std::size_t points() const { return points_.size(); }

  /// Adds an array: per row a member or a function of it (a double, three doubles, or an integer).
  template <class Rows, class Value = std::identity>
  void point_data(std::string_view name, const Rows& rows, Value value = {}) {
    add_array(point_arrays_, name, rows, value);
  }
  template <class Rows, class Value = std::identity>
  void cell_data(std::string_view name, const Rows& rows, Value value = {}) {
    add_array(cell_arrays_, name, rows, value);
  }

  std::string document() const;

 private:
  using Words = std::vector<std::uint64_t>;
  static void add_words(Words& words, double v) {
    words.push_back(std::bit_cast<std::uint64_t>(v));
  }
  static void add_words(Words& words, const std::array<double, 3>& v) {
    for (const double x : v) add_words(words, x);
  }
  static void add_words(Words& words, std::integral auto v) {
    words.push_back(static_cast<std::uint64_t>(v));
  }
  static void add_element(std::string& out, std::string_view name, const char* type, bool vectors,
                          const Words& words);

  template <class Rows, class Value = std::identity>
  static void add_array(std::string& out, std::string_view name, const Rows& rows,
                        Value value = {}) {
    using T = std::remove_cvref_t<decltype(std::invoke(value, *rows.begin()))>;
    Words words;
    words.reserve(rows.size());
    for (const auto& row : rows) add_words(words, std::invoke(value, row));
    add_element(out, name, std::integral<T> ? "Int64" : "Float64",
                std::same_as<T, std::array<double, 3>>, words);
  }

  Cells kind_;
  std::vector<std::array<double, 3>> points_;
  std::vector<std::int64_t> connectivity_, offsets_;
  std::string point_arrays_, cell_arrays_;
};

/// Little-endian words of eight bytes; byte length and data in one run of base64.
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
  // A TYPE11 of the user has one part.
  if (c.role != ContactRole::primary) name += std::string("_") + to_string(c.role);
  return name + "_" + side + ".vtp";
}

/// Numbers points in order of first use.
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

std::vector<double> depths(const Contact& c, std::size_t items,
                           std::uint32_t PenetrationRow::*side) {
  std::vector<double> out(items, 0);
  if (c.is_tied_contact()) return out;
  for (const PenetrationRow& r : c.penetrations) out[r.*side] = std::max(out[r.*side], r.depth);
  return out;
}

std::span<const NodeIndex> corners(const SecondaryNode& s) { return {&s.node, 1}; }
std::span<const NodeIndex> corners(const ContactEdge& e) { return e.nodes; }
std::span<const NodeIndex> corners(const MainSegment& m) {
  return std::span(m.nodes).first(m.nodes[2] == m.nodes[3] ? 3 : 4);
}

/// By node: its gap if it is secondary too, else the largest gap of its segments.
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
    out.point_data(name, view.penetrations.places, [&](const NamedPenetrations::Place& p) {
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
  out.point_data("node", view.penetrations,
                 [](const NamedPenetration& p) { return p.secondary[0]; });
  out.point_data("interface", view.penetrations.places, [&](const NamedPenetrations::Place& p) {
    return scene.contacts[p.contact].inter->id;
  });
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
import os, sys
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
  // A series is listed by its collections, which name its files.
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

namespace {

std::array<double, 3> at(const Coordinates& x, NodeIndex n) { return {x.x[n], x.y[n], x.z[n]}; }

const Coordinates& evaluated(const CycleInput& input) {
  return input.coordinates != nullptr ? *input.coordinates : input.scene->coordinates;
}

/// A pair with its contact.
struct VtkPairRow {
  const Contact* contact;
  const cycle::PairOutcome* pair;
  std::array<NodeIndex, 2> ends;  ///< secondary node, or both nodes of an edge
  ElementName main;
};

VtkPairRow row_of(const Model& model, const Contact& c, const cycle::PairOutcome& p) {
  if (c.kind == ContactKind::edge_edge) {
    const ContactEdge& main = c.main_edges[p.at.main];
    return {&c, &p, c.secondary_edges[p.at.secondary].nodes,
            carrier_name(model, main.carrier, main.element)};
  }
  const MainSegment& main = c.main[p.at.main];
  return {&c,
          &p,
          {c.secondary[p.at.secondary].node, no_index},
          carrier_name(model, main.carrier, main.element)};
}

/// Secondary node; for edges the contact point.
std::array<double, 3> place_of(const VtkPairRow& r, const Coordinates& now) {
  std::array<double, 3> x = at(now, r.ends[0]);
  if (r.ends[1] == no_index) return x;
  const std::array<double, 3> other = at(now, r.ends[1]);
  for (std::size_t k = 0; k < 3; ++k)
    x[k] = r.pair->weights[0] * x[k] + r.pair->weights[1] * other[k];
  return x;
}

std::string pairs_file(const CycleInput& input) {
  VtkPolyData out(Cells::vertices);
  const Model& model = *input.scene->model;
  std::vector<VtkPairRow> rows;
  for (const cycle::ContactOutcome& o : input.outcome->contacts)
    for (const cycle::PairOutcome& p : o.pairs) {
      rows.push_back(row_of(model, *o.contact, p));
      out.add_vertex(place_of(rows.back(), evaluated(input)));
    }
  const auto of_pair = [&](const char* name, auto value_of) {
    out.point_data(name, rows, [&](const VtkPairRow& r) { return value_of(*r.pair); });
  };
  using Pair = cycle::PairOutcome;
  // The outcome has the force on the main side.
  of_pair("force", [](const Pair& p) {
    return std::array{0.0 - p.force[0], 0.0 - p.force[1], 0.0 - p.force[2]};
  });
  of_pair("force_size", [](const Pair& p) { return norm(to_vec(p.force)); });
  of_pair("normal_force", [](const Pair& p) { return p.normal_force; });
  of_pair("penetration", [](const Pair& p) { return p.penetration; });
  of_pair("gap", [](const Pair& p) { return p.gap; });
  of_pair("distance", [](const Pair& p) { return p.distance; });
  of_pair("left_of_gap",
          [](const Pair& p) { return p.gap > 0 ? (p.gap - p.penetration) / p.gap : 1.0; });
  of_pair("k0", [](const Pair& p) { return p.k0; });
  of_pair("k_nodal", [](const Pair& p) { return p.k_nodal; });
  of_pair("status", [](const Pair& p) { return p.status; });
  using Row = VtkPairRow;
  const auto id = [&](NodeIndex n) { return n == no_index ? 0 : model.node_id(n); };
  out.point_data("interface", rows, [](const Row& r) { return r.contact->inter->id; });
  out.point_data("role", rows, [](const Row& r) { return static_cast<int>(r.contact->role); });
  out.point_data("node", rows, [&](const Row& r) { return id(r.ends[0]); });
  out.point_data("node2", rows, [&](const Row& r) { return id(r.ends[1]); });
  out.point_data("main_element", rows, [](const Row& r) { return r.main.id; });
  out.point_data("main_part", rows, [](const Row& r) { return r.main.part; });
  return out.document();
}

/// Figures of Iadm by node, over all contacts.
std::map<NodeIndex, cycle::NodeCriteria> criteria_of(const cycle::SceneOutcome& outcome) {
  std::map<NodeIndex, cycle::NodeCriteria> all;
  for (const cycle::ContactOutcome& o : outcome.contacts)
    for (const cycle::NodeCriteria& c : o.criteria) {
      cycle::NodeCriteria& sum = all[c.node];
      sum.radius = std::min(sum.radius, c.radius);
      sum.penetration = std::max(sum.penetration, c.penetration);
      sum.angle = std::min(sum.angle, c.angle);
    }
  return all;
}

std::string nodes_file(const CycleInput& input) {
  VtkPolyData out(Cells::vertices);
  const std::map<NodeIndex, cycle::NodeCriteria> figures = criteria_of(*input.outcome);
  const cycle::NodalSums& sums = input.outcome->nodes;
  std::vector<NodeIndex> nodes;
  for (NodeIndex n = 0; n < sums.stiffness.size(); ++n)
    if (sums.contact[n] != 0 || sums.removed[n] != 0 || sums.stiffness[n] != 0.0 ||
        sums.heat_of(n) != 0.0 || figures.contains(n)) {
      nodes.push_back(n);
      out.add_vertex(at(evaluated(input), n));
    }
  const auto column = [&](const char* name, auto value) { out.point_data(name, nodes, value); };
  const auto force = [&](NodeIndex n) {
    return std::array{sums.force[0][n], sums.force[1][n], sums.force[2][n]};
  };
  const auto mass = [&](NodeIndex n) { return input.state->mass[n]; };
  const auto figure = [&](NodeIndex n) {
    const auto known = figures.find(n);
    return known != figures.end() ? known->second : cycle::NodeCriteria{n, 0.0, 0.0, 0.0};
  };
  column("force", force);
  column("force_size", [&](NodeIndex n) { return norm(to_vec(force(n))); });
  column("acceleration",
         [&](NodeIndex n) { return mass(n) > 0 ? norm(to_vec(force(n))) / mass(n) : 0.0; });
  column("stiffness", [&](NodeIndex n) { return sums.stiffness[n]; });
  column("mass", mass);
  column("dt", [&](NodeIndex n) {
    const double m = mass(n), k = sums.stiffness[n];
    return m > 0 && k > 0 ? 0.9 * std::sqrt(2 * m / k) : 0.0;
  });
  column("heat", [&](NodeIndex n) { return sums.heat_of(n); });
  column("removed", [&](NodeIndex n) { return sums.removed[n]; });
  column("released", [&](NodeIndex n) { return sums.released[n]; });
  column("radius", [&](NodeIndex n) { return figure(n).radius; });
  column("relative_penetration", [&](NodeIndex n) { return figure(n).penetration; });
  column("cosine_ratio",
         [&](NodeIndex n) { return figure(n).angle < 1e30 ? figure(n).angle : 0.0; });
  column("node", [&](NodeIndex n) { return input.scene->model->node_id(n); });
  return out.document();
}

}  // namespace

std::vector<VtkFile> cycle_vtk(const CycleInput& input, const std::string& suffix) {
  return {{"contact_pairs" + suffix + ".vtp", pairs_file(input)},
          {"contact_nodes" + suffix + ".vtp", nodes_file(input)}};
}

std::vector<VtkFile> cycle_vtk_series(const cycle::StepsOutcome& steps,
                                      const std::vector<std::string>& suffixes) {
  std::vector<VtkFile> files;
  for (const std::string name : {"contact_pairs", "contact_nodes"}) {
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
    for (std::size_t k = 0; k < steps.lines.size() && k < suffixes.size(); ++k)
      text += fmt::format("    <DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}{}.vtp\"/>\n",
                          steps.lines[k].time, name, suffixes[k]);
    files.push_back({name + ".pvd", text + "  </Collection>\n</VTKFile>\n"});
  }
  return files;
}

}  // namespace deck
