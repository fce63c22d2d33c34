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

const Coordinates& evaluated(const CycleInput& input) {
  return input.coordinates != nullptr ? *input.coordinates : input.scene->coordinates;
}

/// A pair beside its contact.
struct VtkPairRow {
  const Contact* contact;
  const cycle::PairOutcome* pair;
  std::array<NodeIndex, 2> ends;  ///< the secondary node, or both of an edge
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

/// Its secondary node; of edges the point of contact.
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
  // The outcome holds the force on the main side.
  of_pair("force", [](const Pair& p) {
    return std::array{0.0 - p.force[0], 0.0 - p.force[1], 0.0 - p.force[2]};
  });
  of_pair("force_size", [](const Pair& p) { return length(p.force); });
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
  column("force_size", [&](NodeIndex n) { return length(force(n)); });
  column("acceleration",
         [&](NodeIndex n) { return mass(n) > 0 ? length(force(n)) / mass(n) : 0.0; });
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
