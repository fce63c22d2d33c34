// Recorded states as tables: every column against the kernel asked directly for the same pair,
// what a table must have, and the figures of the comparison.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "cycle/plates.hpp"
#include "cycle/replay/results.hpp"
#include "cycle/replay/states.hpp"
#include "cycle/replay/table.hpp"
#include "cycle/shared/heat.hpp"
#include "cycle/shared/replay.hpp"
#include "cycle/support.hpp"

namespace deck::cycle {
namespace {

using testing::Pair;
using testing::Vec;
using Column = std::vector<double>;

/// A table of states that is written column by column.
class Sheet {
 public:
  Sheet& add(const std::string& name, const Column& values) {
    columns_.emplace_back(name, values);
    return *this;
  }
  Sheet& triple(const std::string& stem, const std::vector<Vec>& values) {
    const char* const axes[] = {"_x", "_y", "_z"};
    for (std::size_t c = 0; c < 3; ++c) {
      Column one;
      for (const Vec& v : values) one.push_back(v[c]);
      add(stem + axes[c], one);
    }
    return *this;
  }
  /// Columns of zeros, for results that are to be computed.
  Sheet& zeros(const std::vector<std::string>& names) {
    for (const std::string& name : names) add(name, Column(columns_.at(0).second.size(), 0.0));
    return *this;
  }
  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& c : columns_) out.push_back(c.first);
    return out;
  }
  std::string text(const std::string& without = "") const {
    std::string out;
    for (const auto& [name, values] : columns_)
      if (name != without) out += (out.empty() ? "" : ",") + name;
    for (std::size_t row = 0; row < columns_.at(0).second.size(); ++row) {
      std::string line;
      for (const auto& [name, values] : columns_) {
        char cell[40];
        std::snprintf(cell, sizeof cell, "%.17g", values.at(row));
        if (name != without) line += (line.empty() ? "" : ",") + std::string(cell);
      }
      out += "\n" + line;
    }
    return out + "\n";
  }

 private:
  std::vector<std::pair<std::string, Column>> columns_;
};

/// The computed columns by name.
std::map<std::string, Column> computed(const ContactCard& card, const Sheet& sheet,
                                       ReplayOptions options = {}) {
  options.csv = true;
  const ReplayReport r = replay(card, sheet.text(), options);
  EXPECT_EQ(r.error, "");
  std::map<std::string, Column> out;
  std::istringstream in(r.csv);
  std::vector<std::string> names;
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    std::size_t k = 0;
    const bool head = names.empty();
    for (std::string cell; std::getline(cells, cell, ','); ++k)
      if (head)
        names.push_back(cell);
      else
        out[names.at(k)].push_back(std::strtod(cell.c_str(), nullptr));
  }
  return out;
}

const std::size_t many = 12;
/// Steps, times and ids of the rows: two cycles, the first one with a change of its step.
Sheet first_columns(bool edges) {
  Sheet s;
  const auto by_row = [](auto f) {
    Column out;
    for (std::size_t k = 0; k < many; ++k) out.push_back(static_cast<double>(f(k)));
    return out;
  };
  s.add("cycle", by_row([](std::size_t k) { return k < 8 ? 7 : 8; }));
  s.add("interface", Column(many, 3));
  s.add("dt1", by_row([](std::size_t k) { return k < 4 ? 1e-3 : 2e-3; }));
  s.add("dt12", by_row([](std::size_t k) { return k < 5 ? 3e-3 : 4e-3; }));
  s.add("t", by_row([](std::size_t k) { return k < 7 ? 0.5 : 0.75; }));
  if (edges) return s;
  s.add("node", by_row([](std::size_t k) { return 100 + k % 3; }));
  s.add("n1", by_row([](std::size_t k) { return 1 + k % 2; }));
  s.add("n2", by_row([](std::size_t k) { return 11 + k % 4; }));
  s.add("n3", by_row([](std::size_t k) { return 21 + k; }));
  return s;
}
double dt1_of(std::size_t k) { return k < 4 ? 1e-3 : 2e-3; }
double dt12_of(std::size_t k) { return k < 5 ? 3e-3 : 4e-3; }

template <class F>
std::vector<Vec> vectors(const std::vector<Pair>& pairs, F&& f) {
  std::vector<Vec> out;
  for (const Pair& p : pairs) out.push_back(f(p));
  return out;
}
template <class F>
Column numbers(const std::vector<Pair>& pairs, F&& f) {
  Column out;
  for (const Pair& p : pairs) out.push_back(f(p));
  return out;
}
void add_states(Sheet& s, const std::vector<Pair>& pairs, const std::vector<std::string>& roles,
                const std::string& mass) {
  for (std::size_t r = 0; r < roles.size(); ++r) {
    s.triple("x" + roles[r], vectors(pairs, [r](const Pair& p) { return p.x[r]; }));
    s.triple("v" + roles[r], vectors(pairs, [r](const Pair& p) { return p.v[r]; }));
    s.add(mass + roles[r], numbers(pairs, [r](const Pair& p) { return p.m[r]; }));
  }
  s.add("K0", numbers(pairs, [](const Pair& p) { return p.k0; }));
  s.add("gap", numbers(pairs, [](const Pair& p) { return p.gap; }));
  s.triple("ft_in", vectors(pairs, [](const Pair& p) { return p.ft; }));
}
/// What the kernel makes of each pair alone.
std::vector<PacketResult> alone(const ContactCard& card, const std::vector<Pair>& pairs) {
  std::vector<PacketResult> out(pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const testing::Packet packet({pairs[k]});
    evaluate(make_plan(card, Model::reference), packet.view(dt1_of(k), dt12_of(k)), out[k]);
  }
  return out;
}
template <class F>
void expect_column(const std::map<std::string, Column>& got, const std::string& name, F&& wanted) {
  ASSERT_TRUE(got.contains(name)) << name;
  const Column& column = got.at(name);
  ASSERT_EQ(column.size(), many) << name;
  bool some = false;
  for (std::size_t k = 0; k < many; ++k) {
    EXPECT_EQ(column[k], wanted(k)) << name << ' ' << k;
    some = some || wanted(k) != 0.0;
  }
  EXPECT_TRUE(some) << name << " is 0 everywhere";
}

std::vector<Pair> node_pairs() {
  std::vector<Pair> pairs = testing::random_pairs(many, 11);
  for (std::size_t k = 0; k < many; ++k) {
    pairs[k].triangle = k % 4 == 1;
    if (pairs[k].triangle) pairs[k].x[4] = pairs[k].x[3];
    // At the mid-surface of its segment.
    if (k == 9) {
      pairs[k].triangle = false;
      pairs[k].x = {Vec{1, 1, 1e-13}, Vec{-5, -5, 0}, Vec{5, -5, 0}, Vec{5, 5, 0}, Vec{-5, 5, 0}};
      pairs[k].p0 = 0;
    }
    // Some ties that live: force, weights, depth and side.
    if (k % 2 == 0)
      pairs[k].tie = {-30.0 - static_cast<double>(k), 4, 5, 0.25, 0.375, 0.125, 0.1, 1};
  }
  return pairs;
}
Sheet node_sheet(const std::vector<Pair>& pairs) {
  Sheet s = first_columns(false);
  Column n4;
  for (std::size_t k = 0; k < many; ++k)
    n4.push_back(static_cast<double>(21 + k) + (pairs[k].triangle ? 0.0 : 20.0));
  s.add("n4", n4);
  add_states(s, pairs, {"s", "1", "2", "3", "4"}, "m");
  s.add("P0_in", numbers(pairs, [](const Pair& p) { return p.p0; }));
  for (std::size_t k = 0; k < 4; ++k)
    s.triple("N" + std::to_string(k + 1),
             vectors(pairs, [k](const Pair& p) { return p.normal[k]; }));
  const char* const part[] = {"Fn", "Ft1", "Ft2", "H1", "H2", "H3", "pen", "side"};
  for (std::size_t k = 0; k < 8; ++k)
    s.add(std::string("tie_in_") + part[k],
          numbers(pairs, [k](const Pair& p) { return p.tie[k]; }));
  s.add("bc_in", Column(many, 7));
  return s.zeros({"F_x",        "F_y",        "F_z",        "H1",          "H2",
                  "H3",         "H4",         "K_nodal",    "P0_out",      "ft_out_x",
                  "ft_out_y",   "ft_out_z",   "tie_out_Fn", "tie_out_Ft1", "tie_out_Ft2",
                  "tie_out_H1", "tie_out_H2", "tie_out_H3", "tie_out_pen", "tie_out_side",
                  "R_seg",      "A_ind",      "R_s",        "R_1",         "R_2",
                  "R_3",        "R_4",        "P_s",        "A_s",         "bc_out",
                  "stfs_out"});
}
ContactCard busy_card() {
  ContactCard card;
  card.viss = 0.05;
  card.visf = 1;
  card.fric = 0.3;
  card.iform = 2;
  card.inacti = 6;
  card.itied = 1;
  card.dtmin = 1e-6;
  card.iadm = 2;
  card.angladm = 30;
  card.ibc = 5;
  return card;
}

TEST(ReplayOfNodes, EveryPairColumnIsWhatTheKernelGives) {
  const std::vector<Pair> pairs = node_pairs();
  const ContactCard card = busy_card();
  const auto got = computed(card, node_sheet(pairs));
  const std::vector<PacketResult> r = alone(card, pairs);
  const char* const axes[] = {"_x", "_y", "_z"};
  for (std::size_t c = 0; c < 3; ++c) {
    expect_column(got, std::string("F") + axes[c], [&](std::size_t k) { return r[k].force[c][0]; });
    expect_column(got, std::string("ft_out") + axes[c],
                  [&](std::size_t k) { return r[k].ft[c][0]; });
  }
  for (std::size_t h = 0; h < 4; ++h)
    expect_column(got, "H" + std::to_string(h + 1),
                  [&](std::size_t k) { return r[k].weights[h][0]; });
  const char* const part[] = {"Fn", "Ft1", "Ft2", "H1", "H2", "H3", "pen", "side"};
  for (std::size_t t = 0; t < 8; ++t)
    expect_column(got, std::string("tie_out_") + part[t],
                  [&](std::size_t k) { return r[k].tie[t][0]; });
  expect_column(got, "K_nodal", [&](std::size_t k) { return r[k].k_nodal[0]; });
  expect_column(got, "P0_out", [&](std::size_t k) { return r[k].p0[0]; });
  expect_column(got, "R_seg", [&](std::size_t k) { return r[k].criteria[0][0]; });
  expect_column(got, "A_ind", [&](std::size_t k) { return r[k].criteria[2][0]; });
}

TEST(ReplayOfNodes, NodesShowTheirExtremesOfTheCycleSoFar) {
  const std::vector<Pair> pairs = node_pairs();
  const ContactCard card = busy_card();
  const auto got = computed(card, node_sheet(pairs));
  const std::vector<PacketResult> r = alone(card, pairs);
  // Rows of one cycle, step and time are one packet: a row shows its nodes after all of it.
  const std::size_t ends[] = {4, 4, 4, 4, 5, 7, 7, 8, 12, 12, 12, 12};
  const auto over = [&](std::size_t row, auto&& same_node, auto&& f) {
    for (std::size_t k = row < 8 ? 0 : 8; k < ends[row]; ++k)
      if (same_node(k)) f(r[k]);
  };
  const auto radius = [&](std::size_t row, auto&& same_node) {
    double out = 1e30;
    over(row, same_node, [&](const PacketResult& p) {
      if (p.criteria[0][0] > 0) out = std::min(out, p.criteria[0][0]);
    });
    return out;
  };
  expect_column(got, "R_s", [&](std::size_t row) {
    return radius(row, [&](std::size_t k) { return k % 3 == row % 3; });
  });
  expect_column(got, "R_1", [&](std::size_t row) {
    return radius(row, [&](std::size_t k) { return k % 2 == row % 2; });
  });
  expect_column(got, "R_2", [&](std::size_t row) {
    return radius(row, [&](std::size_t k) { return k % 4 == row % 4; });
  });
  for (const char* own : {"R_3", "R_4"})
    expect_column(got, own, [&](std::size_t row) {
      return radius(row, [&](std::size_t k) { return k == row; });
    });
  const auto same = [](std::size_t row) {
    return [row](std::size_t k) { return k % 3 == row % 3; };
  };
  expect_column(got, "P_s", [&](std::size_t row) {
    double out = 0;
    over(row, same(row), [&](const PacketResult& p) {
      if (p.criteria[0][0] > 0) out = std::max(out, p.criteria[1][0]);
    });
    return out;
  });
  expect_column(got, "A_s", [&](std::size_t row) {
    double out = 1e30;
    over(row, same(row), [&](const PacketResult& p) {
      if (p.criteria[0][0] > 0) out = std::min(out, p.criteria[2][0]);
    });
    return out;
  });
  // IBC 101 frees X and Z of 7: Y stays.
  expect_column(got, "bc_out", [&](std::size_t row) {
    double out = 7;
    over(row, same(row), [&](const PacketResult& p) {
      if ((p.status[0] & status_bc_release) != 0) out = 2;
    });
    return out;
  });
  EXPECT_EQ(got.at("stfs_out")[9], -1);
  expect_column(got, "stfs_out", [&](std::size_t row) {
    double out = 1;
    over(row, same(row), [&](const PacketResult& p) {
      if ((p.status[0] & (status_gap_closed | status_step_deleted)) != 0) out = -1;
    });
    return out;
  });
}

TEST(ReplayOfNodes, RowsOfAnotherInterfaceAreLeftOutAndTimesAreHeld) {
  const std::vector<Pair> pairs = node_pairs();
  ContactCard card = busy_card();
  card.tstart = 0.6;
  const auto late = computed(card, node_sheet(pairs));
  card.tstart = 0;
  const auto all = computed(card, node_sheet(pairs));
  bool some = false;
  for (std::size_t k = 0; k < many; ++k) {
    EXPECT_EQ(late.at("F_z")[k], k < 7 ? 0.0 : all.at("F_z")[k]) << k;
    some = some || (k < 7 && all.at("F_z")[k] != 0.0);
    EXPECT_EQ(all.at("row")[k], static_cast<double>(k));
  }
  EXPECT_TRUE(some);
  ReplayOptions other;
  other.interface_id = 4;
  EXPECT_TRUE(computed(card, node_sheet(pairs), other).empty());
  other.interface_id = 3;
  EXPECT_EQ(computed(card, node_sheet(pairs), other), all);
}

TEST(ReplayOfTies, EveryColumnIsWhatTheKernelGives) {
  std::vector<Pair> pairs = testing::random_pairs(many, 5);
  for (std::size_t k = 0; k < many; ++k) {
    pairs[k].triangle = false;
    if (k % 2 == 0) pairs[k].tie = {-30.0 - static_cast<double>(k), 4, 5, 0.25, 0.375, 0.125};
  }
  ContactCard card;
  card.kind = ContactKind::tied;
  Sheet s = first_columns(false);
  add_states(s, pairs, {"s", "1", "2", "3", "4"}, "m");
  const char* const part[] = {"Fn", "Ft1", "Ft2", "H1", "H2", "H3"};
  for (std::size_t k = 0; k < 6; ++k)
    s.add(std::string(part[k]) + "_in", numbers(pairs, [k](const Pair& p) { return p.tie[k]; }));
  s.zeros({"F_x", "F_y", "F_z", "H1", "H2", "H3", "H4", "K_nodal", "Fn_out", "Ft1_out", "Ft2_out",
           "H1_out", "H2_out", "H3_out"});
  const auto got = computed(card, s);
  const std::vector<PacketResult> r = alone(card, pairs);
  for (std::size_t t = 0; t < 6; ++t)
    expect_column(got, std::string(part[t]) + "_out",
                  [&](std::size_t k) { return r[k].tie[t][0]; });
  expect_column(got, "F_x", [&](std::size_t k) { return r[k].force[0][0]; });
  expect_column(got, "K_nodal", [&](std::size_t k) { return r[k].k_nodal[0]; });
  expect_column(got, "H2", [&](std::size_t k) { return r[k].weights[1][0]; });
}

TEST(ReplayOfEdges, ForcesGoToTheFourEndsByTheirWeights) {
  std::vector<Pair> pairs = testing::random_pairs(many, 21, true);
  ContactCard card;
  card.kind = ContactKind::edge_edge;
  card.fric = 0.3;
  card.iform = 2;
  card.inacti = 5;
  Sheet s = first_columns(true);
  add_states(s, pairs, {"s1", "s2", "m1", "m2"}, "mass_");
  s.add("pen_s_used", numbers(pairs, [](const Pair& p) { return 0.25 * p.p0; }));
  s.add("pen_m_used", numbers(pairs, [](const Pair& p) { return 0.5 * p.p0; }));
  for (Pair& p : pairs) p.p0 = 0.25 * p.p0 + 0.5 * p.p0;
  for (const char* f : {"f1", "f2", "f3", "f4", "ft_out"})
    s.triple(f, std::vector<Vec>(many, Vec{}));
  s.zeros({"hs1", "hs2", "hm1", "hm2", "K_nodal"});
  const auto got = computed(card, s);
  const std::vector<PacketResult> r = alone(card, pairs);
  const char* const axes[] = {"_x", "_y", "_z"};
  const char* const weights[] = {"hs1", "hs2", "hm1", "hm2"};
  for (std::size_t e = 0; e < 4; ++e) {
    expect_column(got, weights[e], [&](std::size_t k) { return r[k].weights[e][0]; });
    for (std::size_t c = 0; c < 3; ++c)
      expect_column(got, "f" + std::to_string(e + 1) + axes[c], [&](std::size_t k) {
        return (e < 2 ? -1 : 1) * r[k].weights[e][0] * r[k].force[c][0];
      });
  }
  for (std::size_t c = 0; c < 3; ++c)
    expect_column(got, std::string("ft_out") + axes[c],
                  [&](std::size_t k) { return r[k].ft[c][0]; });
  expect_column(got, "K_nodal", [&](std::size_t k) { return r[k].k_nodal[0]; });
  // The record's main force is that of both ends of the main edge.
  const ReplayReport report = replay(card, s.text());
  EXPECT_EQ(report.kind, "edge_edge");
  EXPECT_EQ(report.zero_rows, many);
  double most = 0;
  for (std::size_t k = 0; k < many; ++k) {
    double f2 = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double f = (r[k].weights[2][0] + r[k].weights[3][0]) * r[k].force[c][0];
      f2 += f * f;
    }
    most = std::max(most, std::sqrt(f2) / (pairs[k].k0 * pairs[k].gap));
  }
  EXPECT_NEAR(report.zero_max_over_k0_gap, most, 1e-14 * most);
}

TEST(ReplayOfHeat, EveryPairIsWhatTheHeatOfItsStateIs) {
  const std::vector<Pair> pairs = testing::random_pairs(many, 31);
  ContactCard card;
  card.ithe = card.ithe_form = 1;
  card.kthe = 2.5;
  card.fheats = 0.25;
  card.fheatm = 0.5;
  ContactCard resistance = card;  // the only form with a conductivity
  resistance.ithe_form = 0;
  resistance.tint = 350;
  Sheet s = first_columns(false);
  const std::vector<std::string> roles{"s", "1", "2", "3", "4"};
  std::vector<HeatState> states(many);
  for (std::size_t r = 0; r < 5; ++r) {
    s.triple("x" + roles[r], vectors(pairs, [r](const Pair& p) { return p.x[r]; }));
    s.add("T" + roles[r], numbers(pairs, [r](const Pair& p) { return p.temperature[r]; }));
    Column weight;
    for (std::size_t k = 0; k < many; ++k) {
      states[k].position[r] = pairs[k].x[r];
      states[k].temperature[r] = pairs[k].temperature[r];
      if (r > 0)
        weight.push_back(states[k].weight[r - 1] =
                             0.1 * static_cast<double>(r) + 0.01 * static_cast<double>(k));
    }
    if (r > 0) s.add("H" + roles[r], weight);
  }
  Column area, force, rub, gap, a, b;
  for (std::size_t k = 0; k < many; ++k) {
    const auto v = static_cast<double>(k);
    area.push_back(states[k].area = k % 3 == 0 ? 0.0 : 2 + v);
    force.push_back(states[k].normal_force = -100 - v);
    rub.push_back(states[k].friction_heat = 7 + v);
    gap.push_back(states[k].gap = 0.5 + 0.125 * v);
    states[k].dt1 = dt1_of(k);
    a.push_back(3 + v);
    b.push_back(0.01 * v);
  }
  s.add("area_s", area).add("Fn", force).add("E_fric", rub).add("gap", gap);
  s.zeros({"Q_s", "Q_1", "Q_2", "Q_3", "Q_4", "conductance"});
  Sheet conducts = s;
  conducts.add("lam_a", a);
  Sheet warmer = conducts;
  warmer.add("lam_b", b);
  const auto check = [&](const ContactCard& c, const Sheet& sheet, int terms) {
    const auto got = computed(c, sheet);
    std::vector<HeatFlow> flow;
    for (std::size_t k = 0; k < many; ++k) {
      HeatState state = states[k];
      if (terms > 0) state.conductivity = a[k];
      if (terms > 1) state.conductivity += b[k] * state.temperature[0];
      flow.push_back(pair_heat(c, state));
    }
    for (std::size_t r = 0; r < (c.ithe_form == 1 ? 5u : 1u); ++r)
      expect_column(got, "Q_" + roles[r], [&](std::size_t k) { return flow[k].q[r]; });
    expect_column(got, "conductance", [&](std::size_t k) { return flow[k].conductance; });
  };
  check(card, s, 0);
  check(resistance, s, 0);
  check(resistance, conducts, 1);
  check(resistance, warmer, 2);
}

TEST(ReplayOfEdgeHeat, TakesWhatTheSolverUsedOrItsOwn) {
  const std::vector<Pair> pairs = testing::random_pairs(many, 41, true);
  const std::vector<std::string> roles{"s1", "s2", "m1", "m2"};
  ContactCard card;
  card.kind = ContactKind::edge_edge;
  card.ithe = card.ithe_form = 1;
  card.kthe = 2.5;
  Sheet s = first_columns(true);
  std::vector<EdgeHeatState> own(many), used(many);
  for (std::size_t r = 0; r < 4; ++r) {
    s.triple("x" + roles[r], vectors(pairs, [r](const Pair& p) { return p.x[r]; }));
    Column weight, t, as_used;
    for (std::size_t k = 0; k < many; ++k) {
      const double h = 0.2 + 0.05 * static_cast<double>(k), row = static_cast<double>(k);
      own[k].position[r] = pairs[k].x[r];
      weight.push_back(own[k].weight[r] = r % 2 == 0 ? h : 1 - h + 0.01 * static_cast<double>(r));
      t.push_back(own[k].temperature[r] = 300 + 10 * row + static_cast<double>(r * r));
      used[k] = own[k];
      as_used.push_back(400 + 7 * row + static_cast<double>(r));
    }
    s.add("h" + roles[r], weight).add("T" + roles[r], t).add("T" + roles[r] + "_used", as_used);
    s.zeros({"Q_" + roles[r], "cond_" + roles[r]});
  }
  Column a, b, c, d, width_s, width_m, area, force, gap, effective, r;
  for (std::size_t k = 0; k < many; ++k) {
    const auto v = static_cast<double>(k);
    a.push_back(3 + v), b.push_back(0.01 + 0.001 * v), c.push_back(5 + v), d.push_back(0.02);
    width_s.push_back(0.5 + 0.1 * v), width_m.push_back(0.75);
    area.push_back(2 + 0.5 * v), force.push_back(-9 - v), gap.push_back(1 + 0.25 * v);
    effective.push_back(0.9 + 0.2 * v), r.push_back(-0.25 - 0.01 * v);
  }
  s.add("lam_s_a", a).add("lam_s_b", b).add("lam_m_a", c).add("lam_m_b", d);
  s.add("width_s", width_s).add("width_m", width_m).add("area", area).add("Fn", force);
  s.add("gap", gap).add("gap_eff", effective).add("r", r);
  for (std::size_t k = 0; k < many; ++k) {
    for (std::size_t e = 0; e < 4; ++e)
      used[k].temperature[e] = 400 + 7 * static_cast<double>(k) + static_cast<double>(e);
    for (EdgeHeatState* state : {&own[k], &used[k]}) {
      for (std::size_t e = 0; e < 4; ++e) {
        state->weight[e] = own[k].weight[e];
        state->position[e] = own[k].position[e];
        state->conductivity[e] =
            e < 2 ? a[k] + b[k] * state->temperature[e] : c[k] + d[k] * state->temperature[e];
      }
      state->width = {width_s[k], width_m[k]};
      state->normal_force = force[k];
      state->gap = gap[k];
      state->distance = r[k] + gap[k];
      state->effective_gap = effective[k];
      state->dt1 = dt1_of(k);
    }
    used[k].area = area[k];
  }
  const auto check = [&](const ContactCard& with, const std::vector<EdgeHeatState>& states,
                         const ReplayOptions& options) {
    const auto got = computed(with, s, options);
    std::vector<HeatFlow> flow;
    for (const EdgeHeatState& state : states) flow.push_back(pair_heat(with, state));
    const bool both = with.ithe_form == 1;
    for (std::size_t e = 0; e < (both ? 4u : 2u); ++e) {
      expect_column(got, "Q_" + roles[e], [&](std::size_t k) { return flow[k].q[e]; });
      expect_column(got, "cond_" + roles[e],
                    [&](std::size_t k) { return states[k].weight[e] * flow[k].conductance; });
    }
    for (std::size_t e = 2; !both && e < 4; ++e)
      EXPECT_EQ(got.at("cond_" + roles[e]), Column(many, 0.0));
  };
  ReplayOptions by_itself, robust;
  by_itself.own_inputs = true;
  robust.model = Model::robust;
  check(card, used, {});
  check(card, own, by_itself);
  check(card, own, robust);
  card.ithe_form = 0;
  card.tint = 500;
  check(card, used, {});
  // One term of a conductivity alone is none.
  for (EdgeHeatState& state : used) state.conductivity.fill(0);
  for (const char* const gone : {"lam_s_b", "lam_s_a"}) {
    ReplayOptions options;
    options.csv = true;
    const ReplayReport some = replay(card, s.text(gone), options);
    EXPECT_EQ(some.error, "");
    EXPECT_NE(some.csv, "");
  }
}

// --- what a table must have

TEST(ReplayColumns, ThatAreNeededAreNamed) {
  const std::vector<std::string> positions[] = {{"xs", "x1", "x2", "x3", "x4"},
                                                {"xs1", "xs2", "xm1", "xm2"}};
  const std::vector<std::string> speeds[] = {{"vs", "v1", "v2", "v3", "v4"},
                                             {"vs1", "vs2", "vm1", "vm2"}};
  struct Kind {
    const char* name;
    ContactKind kind;
    std::vector<std::string> marks, triples, plain;
  };
  const auto joined = [](std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  const Kind kinds[] = {
      {"node_segment",
       ContactKind::node_segment,
       {},
       joined(joined(positions[0], speeds[0]), {"F"}),
       {"dt1", "dt12", "K0", "gap", "ms"}},
      {"tied",
       ContactKind::tied,
       {"Fn_in"},
       joined(joined(positions[0], speeds[0]), {"F"}),
       {"dt1", "dt12", "K0", "gap", "ms"}},
      {"edge_edge",
       ContactKind::edge_edge,
       {"hs1"},
       joined(joined(positions[1], speeds[1]), {"f3", "f4"}),
       {"dt1", "dt12", "K0", "gap", "pen_s_used", "pen_m_used", "mass_s1"}},
      {"heat",
       ContactKind::node_segment,
       {"E_fric"},
       positions[0],
       {"dt1", "Ts", "T1", "T2", "T3", "T4", "Q_s", "Q_1", "Q_2", "Q_3", "Q_4", "H1", "H2", "H3",
        "H4", "area_s", "Fn", "gap"}},
      {"heat_edges",
       ContactKind::edge_edge,
       {"Q_s1"},
       positions[1],
       {"dt1", "hs1", "hs2", "hm1", "hm2", "Ts1", "Ts2", "Tm1", "Tm2", "Q_s2", "Q_m1", "Q_m2",
        "area", "Fn", "gap", "gap_eff", "r"}},
  };
  for (const Kind& kind : kinds) {
    Sheet s;
    s.add("row", {1});
    for (const std::string& t : kind.triples) s.triple(t, {Vec{}});
    s.zeros(kind.plain).zeros(kind.marks);
    ContactCard card;
    card.kind = kind.kind;
    const auto problem = [&](const std::string& without, const ContactCard& with) {
      detail::Table table;
      std::string error;
      EXPECT_TRUE(table.read(s.text(without), error));
      EXPECT_EQ(detail::kind_of(table), kind.name);
      return detail::check_columns(table, kind.name, with);
    };
    EXPECT_EQ(problem("", card), "") << kind.name;
    for (const std::string& t : kind.triples)
      for (const char* axis : {"_x", "_y", "_z"})
        EXPECT_EQ(problem(t + axis, card), "column " + t + axis + " is missing") << kind.name;
    for (const std::string& name : kind.plain) {
      if (name == "hs1" && kind.name == std::string("heat_edges")) continue;
      EXPECT_EQ(problem(name, card), "column " + name + " is missing") << kind.name;
    }
    for (const ContactKind other :
         {ContactKind::node_segment, ContactKind::tied, ContactKind::edge_edge}) {
      ContactCard wrong;
      wrong.kind = other;
      EXPECT_EQ(problem("", wrong), other == kind.kind ? ""
                                                       : std::string("the states (") + kind.name +
                                                             ") do not fit the interface's type");
    }
  }
}

TEST(ReplayColumns, OfResultsAreComparedInGroups) {
  using Group = std::pair<std::string, bool>;  // true: a force
  const std::pair<const char*, std::vector<Group>> kinds[] = {
      {"heat", {{"Q", false}, {"conductance", false}}},
      {"heat_edges", {{"Q", false}, {"cond", false}}},
      {"edge_edge",
       {{"f3", true},
        {"f1", true},
        {"f2", true},
        {"f4", true},
        {"h", false},
        {"K_nodal", false},
        {"ft_out", true}}},
      {"tied",
       {{"F", true},
        {"H", false},
        {"K_nodal", false},
        {"P0_out", false},
        {"ft_out", true},
        {"tie force", true},
        {"tie weights", false}}},
      {"node_segment",
       {{"F", true},
        {"H", false},
        {"K_nodal", false},
        {"P0_out", false},
        {"ft_out", true},
        {"tie force", true},
        {"tie weights", false},
        {"tie_out_pen", false},
        {"tie_out_side", false},
        {"R_seg", false},
        {"A_ind", false},
        {"R_s", false},
        {"R_1", false},
        {"R_2", false},
        {"R_3", false},
        {"R_4", false},
        {"P_s", false},
        {"A_s", false},
        {"bc_out", false},
        {"stfs_out", false}}}};
  // A table with all columns of all kinds; and without one of a group the group is left out.
  Sheet s;
  s.add("row", {1});
  for (const char* stem : {"f1", "f2", "f3", "f4", "ft_out", "F"}) s.triple(stem, {Vec{}});
  s.zeros({"Q_s",         "Q_1",          "Q_2",         "Q_3",        "Q_4",        "conductance",
           "Q_s1",        "Q_s2",         "Q_m1",        "Q_m2",       "cond_s1",    "cond_s2",
           "cond_m1",     "cond_m2",      "hs1",         "hs2",        "hm1",        "hm2",
           "K_nodal",     "H1",           "H2",          "H3",         "H4",         "P0_out",
           "Fn_out",      "Ft1_out",      "Ft2_out",     "H1_out",     "H2_out",     "H3_out",
           "tie_out_Fn",  "tie_out_Ft1",  "tie_out_Ft2", "tie_out_H1", "tie_out_H2", "tie_out_H3",
           "tie_out_pen", "tie_out_side", "R_seg",       "A_ind",      "R_s",        "R_1",
           "R_2",         "R_3",          "R_4",         "P_s",        "A_s",        "bc_out",
           "stfs_out"});
  const auto groups = [&](const std::string& without, const char* kind) {
    detail::Table t;
    std::string error;
    EXPECT_TRUE(t.read(s.text(without), error));
    std::vector<Group> out;
    for (const auto& g : detail::column_groups(t, kind)) out.emplace_back(g.name, g.force);
    return out;
  };
  for (const auto& [kind, wanted] : kinds) EXPECT_EQ(groups("", kind), wanted) << kind;
  EXPECT_EQ(groups("Q_m2", "heat_edges"), (std::vector<Group>{{"cond", false}}));
  EXPECT_EQ(groups("conductance", "heat"), (std::vector<Group>{{"Q", false}}));
}

TEST(ReplayTable, ReadsLinesAndSaysWhichDoesNotFit) {
  const auto read = [](const std::string& text) {
    detail::Table t;
    std::string error;
    const bool good = t.read(text, error);
    EXPECT_EQ(good, error.empty()) << text;
    return error.empty() ? std::to_string(t.rows()) : error;
  };
  EXPECT_EQ(read("a,b\r\n1,2\r\n\n3,4e-400"), "2");
  EXPECT_EQ(read("\n\na,b\n"), "0");
  EXPECT_EQ(read(""), "no header line");
  EXPECT_EQ(read("\n\r\n"), "no header line");
  for (const char* line : {"1", "1,", "1,2,", "1,2,3", "1;2", "x,2", "1,2x", ",2"})
    EXPECT_EQ(read(std::string("a,b\n5,6\n") + line + "\n7,8\n"), "row 2 does not fit the header")
        << line;
  detail::Table t;
  std::string error;
  ASSERT_TRUE(t.read("a,b_x,b_y,b_z,a,c1,c2\n1,2,3,4,5,6,7\n8,9,10,11,12,13,14\n", error));
  EXPECT_EQ(t.names(), (std::vector<std::string>{"a", "b_x", "b_y", "b_z", "c1", "c2"}));
  EXPECT_EQ(t.column("a")[1], 8);
  EXPECT_EQ(t.column("d"), nullptr);
  EXPECT_EQ(t.triple("b")[2][1], 11);
  EXPECT_EQ((t.numbered<2>("c")[1][0]), 7);
}

TEST(ReplayTable, IsWrittenWithSeventeenDigits) {
  detail::ResultTable t;
  t.row = {3, 5};
  t.names = {"a", "b"};
  const double infinity = std::numeric_limits<double>::infinity();
  t.columns = {{-0.0, infinity}, {-infinity, std::nan("")}};
  EXPECT_EQ(detail::to_csv(t), "row,a,b\n3,0.0000000000000000e+00,-inf\n5,inf,nan\n");
  EXPECT_EQ(t.column("b"), &t.columns[1]);
  EXPECT_EQ(t.column("c"), nullptr);
}

// --- figures of the comparison

/// Nodes 0.4 above a square with gap 1 and K0 1000: the force is (0, 0, -750).
Sheet forces(const std::vector<Vec>& recorded, const Column& stiffness) {
  const std::size_t n = recorded.size();
  Sheet s;
  s.add("interface", Column(n, 3));
  const Vec corners[] = {{5, 5, 0.4}, {0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
  const char* const roles[] = {"s", "1", "2", "3", "4"};
  for (std::size_t r = 0; r < 5; ++r) {
    s.triple(std::string("x") + roles[r], std::vector<Vec>(n, corners[r]));
    s.triple(std::string("v") + roles[r], std::vector<Vec>(n, Vec{}));
  }
  s.add("dt1", Column(n, 0)).add("dt12", Column(n, 0)).add("ms", Column(n, 1));
  s.add("K0", Column(n, 1000)).add("gap", Column(n, 1)).add("P0_in", Column(n, 0));
  return s.triple("F", recorded).add("K_nodal", stiffness);
}
ContactCard spring() {
  ContactCard card;
  card.viss = 0;
  return card;
}

TEST(ReplayFigures, AreMedianAndNinetyNinthPercentOfTheErrors) {
  // |computed - recorded| / |recorded| is k / 1000 for k = 0 to 200, in some order.
  std::vector<Vec> recorded;
  Column stiffness;
  for (int k = 0; k <= 200; ++k) {
    const double e = 1e-3 * ((k * 37) % 201);
    recorded.push_back({0, 0, -750 / (1 + e)});
    stiffness.push_back(k < 3 ? 0.0 : 3125.0);
  }
  const ReplayReport r = replay(spring(), forces(recorded, stiffness).text());
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.kind, "node_segment");
  EXPECT_EQ(std::tuple(r.records, r.compared, r.acting, r.zero_rows),
            std::tuple(201u, 201u, 201u, 0u));
  EXPECT_NEAR(r.median, 0.1, 1e-12);
  EXPECT_NEAR(r.p99, 0.198, 1e-12);
  EXPECT_NEAR(r.max, 0.2, 1e-12);
  ASSERT_EQ(r.worst.size(), 10u);
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_NEAR(r.worst[k].relative_error, 0.2 - 1e-3 * static_cast<double>(k), 1e-12);
    EXPECT_EQ((static_cast<int>(r.worst[k].row - 1) * 37) % 201, 200 - static_cast<int>(k));
    EXPECT_NEAR(r.worst[k].computed.at(2), -750, 1e-10);
    EXPECT_EQ(r.worst[k].reference, (Column{0, 0, -750 / (1 + 1e-3 * (200.0 - double(k)))}));
  }
  ASSERT_EQ(r.columns.size(), 2u);
  const ReplayColumn& f = r.columns[0];
  EXPECT_EQ(std::tuple(f.name, f.rows, f.acting, f.median, f.p99, f.max, f.zero_max),
            std::tuple("F", 201u, 201u, r.median, r.p99, r.max, 0.0));
  // Rows without a recorded stiffness are measured by the largest one that is recorded.
  const ReplayColumn& k = r.columns[1];
  EXPECT_EQ(std::tuple(k.name, k.rows, k.acting), std::tuple("K_nodal", 201u, 198u));
  EXPECT_NEAR(k.zero_max, 1.0, 1e-12);
  EXPECT_LT(k.max, 1e-12);
}

TEST(ReplayFigures, OfRowsWithoutAForceAreOverStiffnessTimesGap) {
  const ReplayReport r =
      replay(spring(), forces({{0, 0, 0}, {0, 0, -750}, {0, 0, 0}}, {0, 0, 0}).text());
  EXPECT_EQ(std::tuple(r.compared, r.acting, r.zero_rows), std::tuple(3u, 1u, 2u));
  EXPECT_NEAR(r.zero_max_over_k0_gap, 0.75, 1e-12);
  EXPECT_NEAR(r.columns.at(0).zero_max, 0.75, 1e-12);
  // No stiffness at all is recorded: the difference itself.
  EXPECT_NEAR(r.columns.at(1).zero_max, 3125, 1e-9);
  EXPECT_LT(r.max, 1e-12);
}

TEST(ReplayFigures, ErrorsAreThoseOfVectors) {
  const ReplayReport r = replay(spring(), forces({{300, -400, -750}}, {3125}).text());
  EXPECT_NEAR(r.max, 500 / std::sqrt(500.0 * 500 + 750 * 750), 1e-12);
  EXPECT_EQ(r.median, r.max);
  EXPECT_EQ(r.p99, r.max);
}

TEST(ReplayFigures, OfThousandsOfRowsListTheWorstTen) {
  std::vector<Vec> recorded;
  for (int k = 0; k < 4500; ++k) recorded.push_back({0, 0, -750 / (1 + 1e-5 * ((k * 7) % 4500))});
  const ReplayReport r = replay(spring(), forces(recorded, Column(4500, 3125)).text());
  ASSERT_EQ(r.worst.size(), 10u);
  for (std::size_t k = 0; k < 10; ++k)
    EXPECT_NEAR(r.worst[k].relative_error, 1e-5 * (4499 - static_cast<double>(k)), 1e-12) << k;
}

TEST(ReplayStates, MustHaveOneDtmin) {
  Sheet s = forces({{0, 0, -750}, {0, 0, -750}}, {3125, 3125});
  s.zeros({"m1", "m2", "m3", "m4"});
  Sheet other = s;
  s.add("dtmin", {1e-3, 1e-3});
  other.add("dtmin", {1e-3, 2e-3});
  EXPECT_EQ(replay(spring(), s.text()).error, "");
  EXPECT_EQ(replay(spring(), other.text()).error,
            "column dtmin changes, but all states of one card must have the same value");
  ContactCard heavy = spring();
  heavy.icurv = 3;
  EXPECT_EQ(replay(heavy, forces({{0, 0, -750}}, {3125}).text()).error,
            "the states lack columns that the interface's effects need");
}

TEST(ReplayStates, WithFrictionByPartsNeedTheirValuesOrTheDeck) {
  ContactCard card = spring();
  card.fric_id = true;
  EXPECT_EQ(replay(card, forces({{0, 0, -750}}, {3125}).text()).error,
            "row 1 has no friction values of its own (mu0, visf, c1 ...), and the deck has no such "
            "pair");
}

TEST(ReplayStates, TakeTheDtminOfTheirColumn) {
  for (const auto& [dtmin, stiffness] : {std::pair(1e3, -1.0), std::pair(1e-30, 1.0)}) {
    Sheet s = forces({{0, 0, -750}}, {3125});
    s.add("node", {9}).add("n1", {1}).add("n2", {2}).add("n3", {3}).add("n4", {4});
    s.add("m1", {1}).add("m2", {1}).add("m3", {1}).add("m4", {1});
    s.add("dtmin", {dtmin}).zeros({"stfs_out"});
    EXPECT_EQ(computed(spring(), s).at("stfs_out"), Column{stiffness}) << dtmin;
  }
}

TEST(ReplayStates, RubByDirectionWhereARowHasASecondCoefficient) {
  std::vector<Pair> pairs = testing::random_pairs(many, 51);
  for (Pair& p : pairs) p.triangle = false;
  const Vec along{0.6, 0.8, 0}, across{-0.8, 0.6, 0};
  const std::array<double, 6> first{0.01, 0.02, 0.03, 0.04, 0.05, 0.06}, second{0.5, 0.1, 0.4, 0.2};
  Sheet s = first_columns(false);
  s.add("n4", Column(many, 99));
  add_states(s, pairs, {"s", "1", "2", "3", "4"}, "m");
  s.add("P0_in", numbers(pairs, [](const Pair& p) { return p.p0; }));
  Column mu2;
  for (std::size_t k = 0; k < many; ++k) mu2.push_back(k % 3 == 0 ? 0.0 : k % 3 == 1 ? 0.1 : 1.0);
  s.add("mu0", Column(many, 0.3)).add("mu0_2", mu2);
  for (std::size_t k = 0; k < 6; ++k) {
    s.add("c" + std::to_string(k + 1), Column(many, first[k]));
    s.add("c" + std::to_string(k + 1) + "_2", Column(many, second[k]));
  }
  s.triple("d1", std::vector<Vec>(many, along)).triple("d2", std::vector<Vec>(many, across));
  s.zeros({"F_x", "F_y", "F_z", "ft_out_x", "ft_out_y", "ft_out_z"});
  ContactCard card = spring();
  card.iform = 2;
  card.ifric = 4;
  const auto got = computed(card, s);
  card.fric_id = card.fric_orthotropic = true;
  std::vector<PacketResult> r(many);
  for (std::size_t k = 0; k < many; ++k) {
    const testing::Packet packet({pairs[k]});
    PacketView view = packet.view(dt1_of(k), dt12_of(k));
    const double mu = 0.3, directed = mu2[k] != 0.0 ? 1 : 0, visf2 = 1;
    view.fric = &mu;
    view.visf2 = &visf2;
    view.directed = &directed;
    view.ortho_mu = {&mu, &mu2[k]};
    for (std::size_t c = 0; c < 6; ++c) view.c[c] = &first[c], view.c2[c] = &second[c];
    for (std::size_t c = 0; c < 3; ++c) {
      view.ortho_axis[0][c] = &along[c];
      view.ortho_axis[1][c] = &across[c];
    }
    evaluate(make_plan(card, Model::reference), view, r[k]);
  }
  const char* const axes[] = {"_x", "_y", "_z"};
  for (std::size_t c = 0; c < 3; ++c) {
    expect_column(got, std::string("F") + axes[c], [&](std::size_t k) { return r[k].force[c][0]; });
    expect_column(got, std::string("ft_out") + axes[c],
                  [&](std::size_t k) { return r[k].ft[c][0]; });
  }
}

// --- the deck beside a record

TEST(RecordedPlace, IsThatOfTheNodesAndCandidatesFollowTheIdsOfElements) {
  test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(5, 20, 0, 0).node(6, 20, 10, 0).node(7, 30, 0, 0);
  d.node(11, 1, 5, 0.5).node(12, 5, 1, 0.5).node(13, 9, 5, 0.5).node(14, 5, 9, 0.5);
  d.shell_part(1, 1.0).shell_part(2, 1.0);
  // The element that comes first has the largest id; a triangle has one between the others.
  d.shell(1, 9, 1, 2, 3, 4).shell(1, 5, 2, 5, 6, 3).shell3(1, 7, 5, 7, 6);
  d.shell(2, 20, 11, 12, 13, 14);
  d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/2", {1});
  d.add("@/INTER/TYPE7/3 grnd_IDs=1 surf_IDm=2 Gapmin=1");
  const test::Built b(d);
  const Contact& contact = b.contact(3);
  const auto table_of = [](const std::vector<std::array<double, 6>>& rows) {
    Sheet s;
    const char* const names[] = {"interface", "node", "n1", "n2", "n3", "n4"};
    for (std::size_t c = 0; c < 6; ++c) {
      Column one;
      for (const auto& row : rows) one.push_back(row[c]);
      s.add(names[c], one);
    }
    detail::Table t;
    std::string error;
    EXPECT_TRUE(t.read(s.text(), error));
    return t;
  };
  std::vector<std::array<double, 6>> rows;
  std::vector<CandidatePair> pairs;
  const auto id = [&](NodeIndex n) { return static_cast<double>(b.model.node_id(n)); };
  for (std::uint32_t s = 0; s < contact.secondary.size(); ++s)
    for (std::uint32_t m = 0; m < contact.main.size(); ++m) {
      const auto& n = contact.main[m].nodes;
      rows.push_back({3, id(contact.secondary[s].node), id(n[0]), id(n[1]), id(n[2]), id(n[3])});
      pairs.push_back({s, m});
    }
  ASSERT_EQ(rows.size(), 12u);
  const detail::Table table = table_of(rows);
  const detail::RecordedDeck deck(&b.scene, table);
  EXPECT_TRUE(deck.known());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto place = deck.place(k);
    ASSERT_TRUE(place.has_value()) << k;
    EXPECT_EQ(place->contact, &contact);
    EXPECT_TRUE(place->pair == pairs[k]) << k;
    const double first = rows[k][2];
    const std::size_t rank = first == 2 ? 0 : first == 5 ? 1 : 2;  // elements 5, 7, 9
    EXPECT_EQ(place->candidate, 3 * pairs[k].secondary + rank) << k;
  }
  const detail::Table other =
      table_of({{4, 11, 1, 2, 3, 4}, {3, 15, 1, 2, 3, 4}, {3, 11, 1, 2, 4, 3}});
  const detail::RecordedDeck none(&b.scene, other);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_FALSE(none.place(k).has_value()) << k;
  EXPECT_FALSE(detail::RecordedDeck(nullptr, table).known());
  EXPECT_FALSE(detail::RecordedDeck(nullptr, table).place(0).has_value());
  detail::Table without;
  std::string error;
  ASSERT_TRUE(without.read("node,n1,n2,n3\n11,1,2,3\n", error));
  EXPECT_FALSE(detail::RecordedDeck(&b.scene, without).known());
}

}  // namespace
}  // namespace deck::cycle
