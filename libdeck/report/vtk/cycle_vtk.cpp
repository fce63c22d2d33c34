// The force stage as VTK files for ParaView.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "deck/contact/view.hpp"
#include "report/shared/cycle.hpp"
#include "report/vtk/vtk_writer.hpp"

namespace deck {
namespace {

using detail::VtkPolyData;
using Cells = VtkPolyData::Cells;

double length(const std::array<double, 3>& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

std::array<double, 3> at(const Coordinates& x, NodeIndex n) { return {x.x[n], x.y[n], x.z[n]}; }

/// Columns of the pair file, filled row by row.
struct PairColumns {
  std::vector<double> force, force_size, normal_force, penetration, gap, distance, left, k0, k;
  std::vector<std::int64_t> status, interface, role, node, node2, main_element, main_part;

  void add(const Model& model, const Contact& c, const cycle::PairOutcome& p) {
    // The outcome holds the force on the main side.
    for (const double f : p.force) force.push_back(0.0 - f);
    force_size.push_back(length(p.force));
    normal_force.push_back(p.normal_force);
    penetration.push_back(p.penetration);
    gap.push_back(p.gap);
    distance.push_back(p.distance);
    left.push_back(p.gap > 0 ? (p.gap - p.penetration) / p.gap : 1.0);
    k0.push_back(p.k0);
    k.push_back(p.k_nodal);
    status.push_back(p.status);
    interface.push_back(c.inter->id);
    role.push_back(static_cast<std::int64_t>(c.role));
    const bool edges = c.kind == ContactKind::edge_edge;
    const auto ends = edges ? c.secondary_edges[p.at.secondary].nodes
                            : std::array{c.secondary[p.at.secondary].node, no_index};
    node.push_back(model.node_id(ends[0]));
    node2.push_back(edges ? model.node_id(ends[1]) : 0);
    if (edges)
      add_main(model, c.main_edges[p.at.main]);
    else
      add_main(model, c.main[p.at.main]);
  }

  void write(VtkPolyData& out) const {
    out.point_data("force", force, 3);
    out.point_data("force_size", force_size);
    out.point_data("normal_force", normal_force);
    out.point_data("penetration", penetration);
    out.point_data("gap", gap);
    out.point_data("distance", distance);
    out.point_data("left_of_gap", left);
    out.point_data("k0", k0);
    out.point_data("k_nodal", k);
    out.point_data("status", status);
    out.point_data("interface", interface);
    out.point_data("role", role);
    out.point_data("node", node);
    out.point_data("node2", node2);
    out.point_data("main_element", main_element);
    out.point_data("main_part", main_part);
  }

 private:
  template <class Item>
  void add_main(const Model& model, const Item& item) {
    const Elements* family = item.element == no_index ? nullptr : elements_of(model, item.carrier);
    const std::uint32_t part = family == nullptr ? no_index : family->part[item.element];
    main_element.push_back(family == nullptr ? 0 : family->id[item.element]);
    main_part.push_back(part == no_index ? 0 : model.parts[part].id);
  }
};

std::string pairs_file(const CycleInput& input) {
  VtkPolyData out(Cells::vertices);
  PairColumns columns;
  const Scene& scene = *input.scene;
  const Coordinates& now = input.coordinates != nullptr ? *input.coordinates : scene.coordinates;
  for (const cycle::ContactOutcome& o : input.outcome->contacts) {
    const Contact& c = *o.contact;
    for (const cycle::PairOutcome& p : o.pairs) {
      std::array<double, 3> x{};
      if (c.kind == ContactKind::edge_edge) {
        const auto& n = c.secondary_edges[p.at.secondary].nodes;
        const auto a = at(now, n[0]), b = at(now, n[1]);
        for (std::size_t k = 0; k < 3; ++k) x[k] = p.weights[0] * a[k] + p.weights[1] * b[k];
      } else {
        x = at(now, c.secondary[p.at.secondary].node);
      }
      out.add_cell(std::array{out.points()});
      out.add_point(x[0], x[1], x[2]);
      columns.add(*scene.model, c, p);
    }
  }
  columns.write(out);
  return out.document();
}

/// The figures of Iadm by node, over all contacts.
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
  const Scene& scene = *input.scene;
  const Coordinates& now = input.coordinates != nullptr ? *input.coordinates : scene.coordinates;
  const std::map<NodeIndex, cycle::NodeCriteria> figures = criteria_of(*input.outcome);
  const cycle::NodalSums& sums = input.outcome->nodes;
  std::vector<double> force, force_size, acceleration, stiffness, mass, dt, heat;
  std::vector<double> radius, relative, cosine_ratio;
  std::vector<std::int64_t> removed, released, node;
  for (NodeIndex n = 0; n < sums.stiffness.size(); ++n) {
    const auto known = figures.find(n);
    if (sums.contact[n] == 0 && sums.removed[n] == 0 && sums.stiffness[n] == 0.0 &&
        sums.heat_of(n) == 0.0 && known == figures.end())
      continue;
    const std::array<double, 3> f{sums.force[0][n], sums.force[1][n], sums.force[2][n]};
    const double m = input.state->mass[n], k = sums.stiffness[n];
    const auto x = at(now, n);
    out.add_cell(std::array{out.points()});
    out.add_point(x[0], x[1], x[2]);
    const cycle::NodeCriteria none{n, 0.0, 0.0, 0.0};
    const cycle::NodeCriteria& figure = known != figures.end() ? known->second : none;
    radius.push_back(figure.radius);
    relative.push_back(figure.penetration);
    cosine_ratio.push_back(figure.angle < 1e30 ? figure.angle : 0.0);
    released.push_back(sums.released[n]);
    force.insert(force.end(), f.begin(), f.end());
    force_size.push_back(length(f));
    acceleration.push_back(m > 0 ? length(f) / m : 0.0);
    stiffness.push_back(k);
    mass.push_back(m);
    dt.push_back(m > 0 && k > 0 ? 0.9 * std::sqrt(2 * m / k) : 0.0);
    heat.push_back(sums.heat_of(n));
    removed.push_back(sums.removed[n]);
    node.push_back(scene.model->node_id(n));
  }
  out.point_data("force", force, 3);
  out.point_data("force_size", force_size);
  out.point_data("acceleration", acceleration);
  out.point_data("stiffness", stiffness);
  out.point_data("mass", mass);
  out.point_data("dt", dt);
  out.point_data("heat", heat);
  out.point_data("removed", removed);
  out.point_data("released", released);
  out.point_data("radius", radius);
  out.point_data("relative_penetration", relative);
  out.point_data("cosine_ratio", cosine_ratio);
  out.point_data("node", node);
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
