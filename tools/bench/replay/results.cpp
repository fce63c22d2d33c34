// Result columns of recorded states by kind.
#include "replay/results.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "cycle/adapter/effect_inputs.hpp"
#include "cycle/shared/heat.hpp"
#include "deck/cycle.hpp"
#include "replay/node_outputs.hpp"

namespace deck::cycle::detail {
namespace {

std::vector<std::string> three(const std::string& stem) {
  return {stem + "_x", stem + "_y", stem + "_z"};
}

using Groups = std::vector<ColumnGroup>;

Groups all_groups(const std::string& kind) {
  if (kind == "heat")
    return {{"Q", {"Q_s", "Q_1", "Q_2", "Q_3", "Q_4"}}, {"conductance", {"conductance"}}};
  if (kind == "heat_edges")
    return {{"Q", {"Q_s1", "Q_s2", "Q_m1", "Q_m2"}},
            {"cond", {"cond_s1", "cond_s2", "cond_m1", "cond_m2"}}};
  if (kind == "edge_edge") {
    Groups groups{{"f3", three("f3"), true},
                  {"f1", three("f1"), true},
                  {"f2", three("f2"), true},
                  {"f4", three("f4"), true}};
    groups.push_back({"h", {"hs1", "hs2", "hm1", "hm2"}});
    groups.push_back({"K_nodal", {"K_nodal"}});
    groups.push_back({"ft_out", three("ft_out"), true});
    return groups;
  }
  Groups groups{{"F", three("F"), true},
                {"H", {"H1", "H2", "H3", "H4"}},
                {"K_nodal", {"K_nodal"}},
                {"P0_out", {"P0_out"}},
                {"ft_out", three("ft_out"), true}};
  if (kind == "tied") {
    groups.push_back({"tie force", {"Fn_out", "Ft1_out", "Ft2_out"}, true});
    groups.push_back({"tie weights", {"H1_out", "H2_out", "H3_out"}});
    return groups;
  }
  groups.push_back({"tie force", {"tie_out_Fn", "tie_out_Ft1", "tie_out_Ft2"}, true});
  groups.push_back({"tie weights", {"tie_out_H1", "tie_out_H2", "tie_out_H3"}});
  for (const char* name : {"tie_out_pen", "tie_out_side", "R_seg", "A_ind", "R_s", "R_1", "R_2",
                           "R_3", "R_4", "P_s", "A_s", "bc_out", "stfs_out"})
    groups.push_back({name, {name}});
  return groups;
}

/// A number of a pair for a column.
using Getter = std::function<double(const PacketResult&, std::size_t)>;
using Getters = std::map<std::string, Getter>;

/// Names the arrays of a member.
template <class Arrays>
void add_arrays(Getters& out, Arrays PacketResult::*member, const std::vector<std::string>& names) {
  for (std::size_t k = 0; k < names.size(); ++k)
    out[names[k]] = [member, k](const PacketResult& r, std::size_t i) { return (r.*member)[k][i]; };
}

Getters getters_of_nodes() {
  Getters out;
  add_arrays(out, &PacketResult::weights, {"H1", "H2", "H3", "H4"});
  add_arrays(out, &PacketResult::force, three("F"));
  add_arrays(out, &PacketResult::ft, three("ft_out"));
  add_arrays(out, &PacketResult::tie,
             {"tie_out_Fn", "tie_out_Ft1", "tie_out_Ft2", "tie_out_H1", "tie_out_H2", "tie_out_H3",
              "tie_out_pen", "tie_out_side"});
  add_arrays(out, &PacketResult::tie,
             {"Fn_out", "Ft1_out", "Ft2_out", "H1_out", "H2_out", "H3_out"});
  out["R_seg"] = [](const PacketResult& r, std::size_t i) { return r.criteria[0][i]; };
  out["A_ind"] = [](const PacketResult& r, std::size_t i) { return r.criteria[2][i]; };
  out["P0_out"] = [](const PacketResult& r, std::size_t i) { return r.p0[i]; };
  return out;
}

Getters getters_of_edges() {
  Getters out;
  add_arrays(out, &PacketResult::weights, {"hs1", "hs2", "hm1", "hm2"});
  add_arrays(out, &PacketResult::ft, three("ft_out"));
  for (std::size_t end = 0; end < 4; ++end) {
    const std::vector<std::string> names = three("f" + std::to_string(end + 1));
    // Share of the main side's force for this end of both edges.
    for (std::size_t c = 0; c < 3; ++c)
      out[names[c]] = [end, c](const PacketResult& r, std::size_t i) {
        return (end < 2 ? -r.weights[end][i] : r.weights[end][i]) * r.force[c][i];
      };
  }
  return out;
}

const Getters& getters(const std::string& kind) {
  const auto with_stiffness = [](Getters out) {
    out["K_nodal"] = [](const PacketResult& r, std::size_t i) { return r.k_nodal[i]; };
    return out;
  };
  static const Getters nodes = with_stiffness(getters_of_nodes());
  static const Getters edges = with_stiffness(getters_of_edges());
  return kind == "edge_edge" ? edges : nodes;
}

bool uses_recorded_values(const ReplayOptions& options) {
  return options.model == Model::reference && !options.own_inputs;
}

/// Rows of one interface.
std::vector<std::size_t> wanted_rows(const Table& table, int interface_id) {
  const double* id = table.column("interface");
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (interface_id == 0 || id == nullptr || id[row] == interface_id) rows.push_back(row);
  return rows;
}

ResultTable empty_results(const Table& table, const std::string& kind, int interface_id) {
  ResultTable out;
  out.row = wanted_rows(table, interface_id);
  std::vector<std::string> known;
  for (const ColumnGroup& g : all_groups(kind))
    known.insert(known.end(), g.columns.begin(), g.columns.end());
  for (const std::string& name : table.names())
    if (std::find(known.begin(), known.end(), name) != known.end()) out.names.push_back(name);
  out.columns.assign(out.names.size(), std::vector<double>(out.row.size(), 0.0));
  return out;
}

/// Length of a run of rows of one cycle and time step.
std::size_t chunk_length(const Table& table, const std::vector<std::size_t>& rows, std::size_t at) {
  std::size_t n = 1;
  const auto same = [&](const char* name) {
    const double* column = table.column(name);
    return column == nullptr || column[rows[at + n]] == column[rows[at]];
  };
  while (at + n < rows.size() && rows[at + n] == rows[at] + n && same("cycle") && same("dt1") &&
         same("dt12") && same("t"))
    ++n;
  return n;
}

void compute_pairs(const ContactCard& card, const Table& table, const std::string& kind,
                   const ReplayOptions& options, ResultTable& out, std::string& error) {
  const RecordedDeck deck(options.scene, table);
  ContactCard prepared = card;
  if (kind == "edge_edge" || (!prepared.fct_idf && prepared.drad <= 0.0)) prepared.ithe = 0;
  const States states(table, kind, deck, uses_recorded_values(options), prepared, error);
  if (!error.empty()) return;
  const KernelPlan plan = make_plan(states.card(), options.model, options.plan);
  if (missing_fields(plan, states.all()) != Field::none) {
    error = "the states lack columns that the interface's effects need";
    return;
  }
  const double* dt1 = table.column("dt1");
  const double* dt12 = table.column("dt12");
  const double* t = table.column("t");
  std::vector<std::pair<Getter, std::size_t>> plain;
  for (std::size_t c = 0; c < out.names.size(); ++c) {
    const auto it = getters(kind).find(out.names[c]);
    if (it != getters(kind).end()) plain.emplace_back(it->second, c);
  }
  NodeOutputs nodes(states.card(), table, deck, out);
  PacketResult result;
  for (std::size_t at = 0; at < out.row.size();) {
    const std::size_t n = chunk_length(table, out.row, at);
    const std::size_t row = out.row[at];
    PacketView view = states.rows(row, n);
    view.dt1 = dt1[row];
    view.dt12 = dt12[row];
    const bool active = t == nullptr || is_active(states.card(), t[row]);
    if (active) {
      evaluate(plan, view, result);
      for (std::size_t i = 0; i < n; ++i)
        for (const auto& [get, c] : plain) out.columns[c][at + i] = get(result, i);
      nodes.collect(result, at, n);
    }
    at += n;
  }
}

void put(ResultTable& out, const std::string& name, std::size_t i, double value) {
  const auto it = std::find(out.names.begin(), out.names.end(), name);
  if (it != out.names.end())
    out.columns[static_cast<std::size_t>(it - out.names.begin())][i] = value;
}

void compute_heat(const ContactCard& card, const Table& t, const ReplayOptions& options,
                  ResultTable& out) {
  const std::array<std::string, 5> role{"s", "1", "2", "3", "4"};
  const double* a = t.column("lam_a");
  const double* b = t.column("lam_b");
  const double* node = t.column("node");
  std::optional<NodeConductivity> of_deck;
  if (a == nullptr && options.scene != nullptr && node != nullptr)
    of_deck.emplace(*options.scene->model);
  for (std::size_t i = 0; i < out.row.size(); ++i) {
    const std::size_t row = out.row[i];
    HeatState s;
    for (std::size_t r = 0; r < 5; ++r) {
      const auto x = t.triple("x" + role[r]);
      for (std::size_t c = 0; c < 3; ++c) s.position[r][c] = x[c][row];
      s.temperature[r] = t.column("T" + role[r])[row];
      if (r > 0) s.weight[r - 1] = t.column("H" + role[r])[row];
    }
    s.area = t.column("area_s")[row];
    s.normal_force = t.column("Fn")[row];
    s.friction_heat = t.column("E_fric")[row];
    s.gap = t.column("gap")[row];
    s.dt1 = t.column("dt1")[row];
    if (a != nullptr) {
      s.conductivity = a[row] + (b == nullptr ? 0.0 : b[row] * s.temperature[0]);
    } else if (of_deck) {
      const std::uint32_t n =
          options.scene->model->nodes.map.find(static_cast<std::int64_t>(node[row]));
      if (n != no_index) s.conductivity = (*of_deck)(n, s.temperature[0]);
    }
    const HeatFlow flow = pair_heat(card, s);
    for (std::size_t r = 0; r < 5; ++r) put(out, "Q_" + role[r], i, flow.q[r]);
    put(out, "conductance", i, flow.conductance);
  }
}

void compute_edge_heat(const ContactCard& card, const Table& t, const ReplayOptions& options,
                       ResultTable& out) {
  const std::array<std::string, 4> role{"s1", "s2", "m1", "m2"};
  for (std::size_t i = 0; i < out.row.size(); ++i) {
    const std::size_t row = out.row[i];
    EdgeHeatState s;
    for (std::size_t r = 0; r < 4; ++r) {
      const auto x = t.triple("x" + role[r]);
      for (std::size_t c = 0; c < 3; ++c) s.position[r][c] = x[c][row];
      s.weight[r] = t.column("h" + role[r])[row];
      // As used: the solver can use temperatures of another pair of its packet.
      const double* used = t.column("T" + role[r] + "_used");
      const bool own = used == nullptr || !uses_recorded_values(options);
      s.temperature[r] = own ? t.column("T" + role[r])[row] : used[row];
      const std::string side = r < 2 ? "lam_s" : "lam_m";
      const double* a = t.column(side + "_a");
      const double* b = t.column(side + "_b");
      if (a != nullptr && b != nullptr) s.conductivity[r] = a[row] + b[row] * s.temperature[r];
    }
    if (const double* width = t.column("width_s")) s.width[0] = width[row];
    if (const double* width = t.column("width_m")) s.width[1] = width[row];
    if (uses_recorded_values(options)) s.area = t.column("area")[row];
    s.normal_force = t.column("Fn")[row];
    s.gap = t.column("gap")[row];
    s.distance = t.column("r")[row] + s.gap;
    s.effective_gap = t.column("gap_eff")[row];
    s.dt1 = t.column("dt1")[row];
    const HeatFlow flow = pair_heat(card, s);
    const bool both = card.ithe_form == 1;
    for (std::size_t r = 0; r < 4; ++r) {
      put(out, "Q_" + role[r], i, flow.q[r]);
      put(out, "cond_" + role[r], i, r < 2 || both ? s.weight[r] * flow.conductance : 0.0);
    }
  }
}

}  // namespace

std::vector<ColumnGroup> column_groups(const Table& table, const std::string& kind) {
  Groups groups = all_groups(kind);
  std::erase_if(groups, [&](const ColumnGroup& g) {
    return !std::all_of(g.columns.begin(), g.columns.end(),
                        [&](const std::string& name) { return table.has(name); });
  });
  return groups;
}

ResultTable compute_results(const ContactCard& card, const Table& table, const std::string& kind,
                            const ReplayOptions& options, std::string& error) {
  ResultTable out = empty_results(table, kind, options.interface_id);
  if (kind == "heat")
    compute_heat(card, table, options, out);
  else if (kind == "heat_edges")
    compute_edge_heat(card, table, options, out);
  else
    compute_pairs(card, table, kind, options, out, error);
  return out;
}

}  // namespace deck::cycle::detail
