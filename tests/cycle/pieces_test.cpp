// The steps between search and result, each alone: gathering, sums at nodes, values of pairs from
// the deck, widths of edges, accounts of effects, criteria and lists of a whole evaluation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/small_deck.hpp"
#include "cycle/adapter/parts.hpp"
#include "cycle/kernel/effects.hpp"
#include "cycle/plates.hpp"
#include "cycle/support.hpp"
#include "deck/cycle/adapter.hpp"
#include "deck/cycle/scene_cycle.hpp"
#include "deck/cycle/steps.hpp"

namespace deck::cycle {
namespace {

using test::Built;
using testing::Pair;
using testing::Vec;

// --- gathering and sums

TEST(Gathering, TakesTheFieldsThatAreAskedForByRole) {
  std::array<std::vector<double>, 3> x, v;
  std::vector<double> mass, heat;
  for (int n = 0; n < 9; ++n) {
    for (std::size_t c = 0; c < 3; ++c) {
      x[c].push_back(100.0 * static_cast<double>(c + 1) + n);
      v[c].push_back(-100.0 * static_cast<double>(c + 1) - n);
    }
    mass.push_back(0.5 + n);
    heat.push_back(300.0 + n);
  }
  NodalState nodes;
  for (std::size_t c = 0; c < 3; ++c) {
    nodes.position[c] = x[c].data();
    nodes.velocity[c] = v[c].data();
  }
  nodes.mass = mass.data();
  nodes.temperature = heat.data();
  for (const bool edges : {false, true}) {
    PairList pairs;
    pairs.kind = edges ? ContactKind::edge_edge : ContactKind::node_segment;
    pairs.node = {std::vector<std::uint32_t>{8, 0}, {1, 2}, {3, 4}, {5, 6}, {}};
    if (!edges) pairs.node[4] = {7, 6};
    const std::size_t roles = edges ? 4 : 5;
    PacketBuffer all;
    all.gather(nodes, pairs,
               Field::position | Field::velocity | Field::mass_secondary | Field::mass_main |
                   Field::temperature);
    const PacketView w = all.view();
    EXPECT_EQ(w.size, 2u);
    EXPECT_EQ(w.triangle, nullptr);
    for (std::size_t r = 0; r < 5; ++r)
      for (std::size_t p = 0; p < 2; ++p) {
        if (r >= roles) {
          EXPECT_EQ(w.position[r][0], nullptr);
          EXPECT_EQ(w.velocity[r][0], nullptr);
          EXPECT_EQ(w.mass[r], nullptr);
          continue;
        }
        const std::uint32_t n = pairs.node[r][p];
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_EQ(w.position[r][c][p], x[c][n]);
          EXPECT_EQ(w.velocity[r][c][p], v[c][n]);
        }
        EXPECT_EQ(w.mass[r][p], mass[n]);
        EXPECT_EQ(w.temperature[r][p], heat[n]);
      }
    // Masses of the secondary side alone: of both ends of an edge.
    PacketBuffer some;
    some.gather(nodes, pairs, Field::mass_secondary);
    EXPECT_EQ(some.view().mass[0][1], mass[0]);
    EXPECT_EQ(some.view().mass[1] != nullptr, edges);
    EXPECT_EQ(some.view().mass[2], nullptr);
    EXPECT_EQ(some.view().position[0][0], nullptr);
    EXPECT_EQ(some.view().temperature[0], nullptr);
    PacketBuffer main;
    main.gather(nodes, pairs, Field::mass_main);
    EXPECT_EQ(main.view().mass[0], nullptr);
    EXPECT_EQ(main.view().mass[1] != nullptr, !edges);
    EXPECT_NE(main.view().mass[3], nullptr);
    // A deck without velocities and temperatures: zeros.
    NodalState still = nodes;
    still.velocity = {};
    still.temperature = nullptr;
    PacketBuffer rest;
    rest.gather(still, pairs, Field::position | Field::velocity | Field::temperature);
    const PacketView zeros = rest.view();
    for (std::size_t r = 0; r < roles; ++r)
      for (std::size_t p = 0; p < 2; ++p) {
        EXPECT_EQ(zeros.velocity[r][2][p], 0);
        EXPECT_EQ(zeros.temperature[r][p], 0);
      }
    EXPECT_EQ(zeros.velocity[4][0] != nullptr, !edges);
  }
}

/// A result of two pairs with figures that tell where they came from.
PacketResult made_result() {
  PacketResult r;
  r.resize(2);
  for (std::size_t p = 0; p < 2; ++p) {
    const auto v = static_cast<double>(p);
    for (std::size_t k = 0; k < 4; ++k)
      r.weights[k][p] = 0.1 * static_cast<double>(k + 1) + 0.5 * v;
    for (std::size_t c = 0; c < 3; ++c) r.force[c][p] = static_cast<double>(c + 1) + 10 * v;
    for (std::size_t k = 0; k < 5; ++k) r.heat[k][p] = static_cast<double>(k + 1) + 100 * v;
    r.k_nodal[p] = 7 + 20 * v;
    r.conductance[p] = 3 + v;
  }
  r.weights[3][1] = -0.25;  // weights of a curved side may be negative
  r.status = {status_contact | status_bc_release, status_gap_closed};
  return r;
}

TEST(NodeSums, GiveEachRoleItsShareOnceHoweverTheyAreMade) {
  for (const bool edges : {false, true})
    for (const int form : {0, 1}) {
      PairList pairs;
      pairs.kind = edges ? ContactKind::edge_edge : ContactKind::node_segment;
      pairs.node = {std::vector<std::uint32_t>{0, 1}, {2, 3}, {3, 4}, {4, 5}, {}};
      if (!edges) {
        pairs.node[4] = {4, 6};  // the first one is a triangle: its third corner twice
        pairs.triangle = {1, 0};
      }
      ContactCard card;
      card.kind = pairs.kind;
      card.ithe = 1;
      card.ithe_form = form;
      card.ibc = 5;
      const KernelPlan plan = make_plan(card, Model::reference);
      const PacketResult r = made_result();
      NodalSums wanted;
      wanted.resize(7);
      for (std::size_t p = 0; p < 2; ++p)
        for (std::size_t role = 0; role < (edges ? 4u : 5u); ++role) {
          if (role == 4 && p == 0) continue;
          const std::uint32_t n = pairs.node[role][p];
          const bool secondary = role < (edges ? 2u : 1u);
          const double share = edges       ? (secondary ? -1 : 1) * r.weights[role][p]
                               : role == 0 ? -1.0
                                           : r.weights[role - 1][p];
          for (std::size_t c = 0; c < 3; ++c) wanted.force[c][n] += share * r.force[c][p];
          wanted.stiffness[n] += std::abs(share) * r.k_nodal[p];
          wanted.heat[n] += r.heat[role][p];
          if (secondary || form == 1) wanted.conductance[n] += std::abs(share) * r.conductance[p];
          if (p == 0) wanted.contact[n] = 1;
          if (p == 0 && secondary) wanted.released[n] = 5;
          if (p == 1 && secondary) wanted.removed[n] = 1;
        }
      NodalSums by_pairs, by_nodes;
      by_pairs.resize(7);
      by_nodes.resize(7);
      assemble(plan, pairs, r, by_pairs);
      assemble(plan, Incidence(pairs, 7), r, by_nodes, 3);
      for (const NodalSums* sums : {&by_pairs, &by_nodes}) {
        for (std::size_t n = 0; n < 7; ++n) {
          for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(sums->force[c][n], wanted.force[c][n], 1e-12) << n;
          EXPECT_NEAR(sums->stiffness[n], wanted.stiffness[n], 1e-12) << n;
          EXPECT_NEAR(sums->heat[n], wanted.heat[n], 1e-12) << n;
          EXPECT_NEAR(sums->conductance[n], wanted.conductance[n], 1e-12) << n;
        }
        EXPECT_EQ(sums->contact, wanted.contact);
        EXPECT_EQ(sums->released, wanted.released);
        EXPECT_EQ(sums->removed, wanted.removed);
      }
    }
}

TEST(PairTotals, TakeMomentsAtTheSecondaryPointOutward) {
  for (const bool edges : {false, true}) {
    Pair p;
    p.x = {Vec{1, 2, 3}, Vec{5, -2, 4}, Vec{0, 0, 0}, Vec{9, 9, 9}, Vec{7, 7, 7}};
    const testing::Packet packet({p});
    PacketResult r;
    r.resize(1);
    const Vec n{0.6, 0, 0.8}, f{3, 5, -7};
    for (std::size_t c = 0; c < 3; ++c) {
      r.normal[c][0] = n[c];
      r.force[c][0] = f[c];
    }
    r.normal_force[0] = -2;
    r.penetration[0] = 0.5;
    r.weights[0][0] = 0.25;
    r.weights[1][0] = 0.75;
    r.elastic_energy[0] = 11, r.friction_energy[0] = 12, r.damping_energy[0] = 13;
    r.friction_heat[0] = 16;
    r.dt_kinematic[0] = 1e-3;
    r.status[0] = status_contact;
    ContactCard card;
    card.kind = edges ? ContactKind::edge_edge : ContactKind::node_segment;
    card.ithe = 1;
    card.fheats = 0.25;
    card.fheatm = 0.5;
    const Totals t = totals(make_plan(card, Model::reference), packet.view(), r);
    using testing::operator+;
    using testing::operator*;
    const Vec at = (edges ? Vec{4, -1, 3.75} : Vec{1, 2, 3}) + 0.5 * n;
    const Vec moment = testing::cross(at, f);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(t.normal[c], -2 * n[c], 1e-14);
      EXPECT_NEAR(t.tangential[c], f[c] + 2 * n[c], 1e-14);
      EXPECT_NEAR(t.moment[c], moment[c], 1e-12) << edges;
    }
    EXPECT_EQ(std::tuple(t.normal_abs, t.elastic_energy, t.friction_energy, t.damping_energy,
                         t.friction_heat, t.dt_kinematic, t.dt_kinematic_pair, t.contacts),
              std::tuple(2.0, 11.0, 12.0, 13.0, 12.0, 1e-3, 0u, 1u));
    EXPECT_DOUBLE_EQ(t.total_abs, std::sqrt(83.0));
  }
}

TEST(NodesThatAreActedOn, HaveAForceOrAStiffness) {
  SceneOutcome outcome;
  outcome.nodes.resize(7);
  for (std::size_t c = 0; c < 3; ++c) outcome.nodes.force[c][c + 1] = 2.5 + static_cast<double>(c);
  outcome.nodes.stiffness[3] = 8;
  outcome.nodes.stiffness[5] = 32;
  outcome.nodes.stiffness[6] = 2;
  State state;
  state.mass = {1, 1, 1, 4, 1, 4, 0};
  const auto acted = acted_nodes(state, outcome);
  ASSERT_EQ(acted.size(), 5u);
  const std::tuple<NodeIndex, std::array<double, 3>, double, double> rows[] = {
      {1, {2.5, 0, 0}, 0, 1e30},
      {2, {0, 3.5, 0}, 0, 1e30},
      {3, {0, 0, 4.5}, 8, 0.9},
      {5, {0, 0, 0}, 32, 0.45},
      {6, {0, 0, 0}, 2, 1e30}};
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_EQ(std::tuple(acted[k].node, acted[k].force, acted[k].stiffness, acted[k].dt), rows[k]);
}

// --- values of pairs

TEST(PairValues, OfQuadsAndTrianglesWithTheirNormals) {
  // A quad of 10 by 10 in z = 0 and a triangle beside it that rises.
  test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(5, 16, 0, 8);
  d.node(11, 5, 5, 0.5).node(12, 12, 3, 3);
  d.shell_part(1, 1).shell(1, 1, 1, 2, 3, 4).shell3(1, 2, 2, 5, 3);
  d.segments("/SURF/SEG/1", {{1, 2, 3, 4}, {2, 5, 3, 3}}).group("/GRNOD/NODE/2", {11, 12});
  d.add("@/INTER/TYPE7/1 Gapmin=1");
  const Built b(d);
  ContactCard card = make_card(b.scene, b.contact());
  PairSearch all;
  all.margin = 100;
  const auto found = [&](int icurv, int iadm) {
    card.icurv = icurv;
    card.iadm = iadm;
    return make_pairs(b.scene, b.contact(), card, Model::reference, 1, all);
  };
  const ContactPairs p = found(0, 0);
  ASSERT_EQ(p.size(), 4u);
  EXPECT_TRUE(p.normal[0][0].empty());
  const auto id = [&](std::size_t role, std::size_t k) {
    return b.model.node_id(p.nodes.node[role][k]);
  };
  const std::array<int, 5> nodes[] = {
      {11, 1, 2, 3, 4}, {11, 2, 5, 3, 3}, {12, 1, 2, 3, 4}, {12, 2, 5, 3, 3}};
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t role = 0; role < 5; ++role) EXPECT_EQ(id(role, k), nodes[k][role]) << k;
    EXPECT_EQ(p.nodes.triangle[k], k % 2) << k;
    EXPECT_EQ(p.gap[k], 1);
    EXPECT_EQ(p.p0[k], 0);
  }
  // Facet normals: (0, 0, 200) of the quad; the triangle's diagonals are (0, 10, 0), (-6, 10, -8).
  const Vec quad{0, 0, 200}, tri{-80, 0, 60};
  using testing::operator+;
  using testing::operator*;
  const auto check = [&](const ContactPairs& pairs, const std::array<Vec, 6>& sums) {
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t corner = 0; corner < 4; ++corner) {
        const Vec& wanted = sums[static_cast<std::size_t>(nodes[k][corner + 1])];
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(pairs.normal[corner][c].at(k), wanted[c], 1e-12) << k << ' ' << corner;
      }
  };
  check(found(3, 0), {Vec{}, quad, quad + tri, quad + tri, quad, tri});
  // Iadm: each facet counts the same, the repeated corner of a triangle twice.
  const Vec q{0, 0, 1}, t{-0.8, 0, 0.6};
  check(found(0, 1), {Vec{}, q, q + t, q + 2.0 * t, q, t});
}

TEST(PairValues, ThatAreAlwaysWantedJoinThoseInReachInOrderAndOnce) {
  const auto b = testing::plates_in_contact("@/INTER/TYPE7/1", 0.6);
  const ContactCard card = make_card(b->scene, b->contact());
  PairSearch where;
  where.always = {{3, 0}, {1, 0}, {1, 0}};
  const auto at = [&](double z) {
    Coordinates x = b->scene.coordinates;
    for (const NodeIndex n : {11, 12, 13, 14}) {
      const NodeIndex node = b->model.nodes.map.find(n);
      x.z[node] = n == 12 ? 0.5 : z;
    }
    where.at = &x;
    return make_pairs(b->scene, b->contact(), card, Model::reference, 1, where).at;
  };
  const std::uint32_t low = 1;  // node 12
  EXPECT_EQ(b->model.node_id(b->contact().secondary[low].node), 12);
  EXPECT_EQ(at(9), (std::vector<CandidatePair>{{1, 0}, {3, 0}}));
  EXPECT_EQ(at(0.6), (std::vector<CandidatePair>{{0, 0}, {1, 0}, {2, 0}, {3, 0}}));
}

// --- widths of edges for heat

double width(const Built& b, Carrier rule, std::int64_t first, std::int64_t second) {
  Contact c;
  c.kind = deck::ContactKind::edge_edge;
  ContactEdge e;
  e.nodes = {b.model.nodes.map.find(first), b.model.nodes.map.find(second)};
  e.carrier = Carrier::none;
  ContactEdge last = e;
  last.carrier = rule;  // it rules for all edges of its side
  c.secondary_edges = {e, last};
  c.main_edges = {last};
  ContactPairs pairs;
  pairs.at = {{0, 0}};
  detail::edge_widths(b.scene, c, pairs);
  EXPECT_EQ(pairs.edge_width[0], pairs.edge_width[1]);
  return pairs.edge_width[0].at(0);
}

TEST(WidthsOfEdges, OnSolidsAreSumsOfSharesOfTheirFaces) {
  // A block of 2 by 3 by 5 and a wedge of the same sizes.
  test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 2, 0, 0).node(3, 2, 3, 0).node(4, 0, 3, 0);
  d.node(5, 0, 0, 5).node(6, 2, 0, 5).node(7, 2, 3, 5).node(8, 0, 3, 5);
  d.node(11, 50, 0, 0).node(12, 52, 0, 0).node(13, 50, 3, 0);
  d.node(15, 50, 0, 5).node(16, 52, 0, 5).node(17, 50, 3, 5);
  d.solid_part(1).brick(1, 1, {1, 2, 3, 4, 5, 6, 7, 8});
  d.brick(1, 2, {11, 12, 13, 13, 15, 16, 17, 17});
  const Built b(d);
  const auto at = [&](int first, int second) { return width(b, Carrier::solid, first, second); };
  // Faces of 6, 10 and 15; a quarter of each to each of its corners.
  EXPECT_DOUBLE_EQ(at(1, 2), 2 * (6 + 15 + 10) / 4.0);
  EXPECT_DOUBLE_EQ(at(3, 2), (6 + 10 + 15 + 10) / 4.0);
  EXPECT_DOUBLE_EQ(at(6, 2), (6 + 10) / 4.0);
  for (const auto& [first, second] :
       {std::pair(2, 1), std::pair(4, 3), std::pair(5, 6), std::pair(8, 2)})
    EXPECT_EQ(at(first, second), 0) << first;
  // The front of the wedge is a triangle of area 3, a third of it each.
  EXPECT_DOUBLE_EQ(at(11, 12), 2 * (1 + 15 / 4.0 + 10 / 4.0));
}

TEST(WidthsOfEdges, OnShellsAreHalfTheRootOfTheirShares) {
  test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 8, 0).node(4, 0, 8, 0).node(5, 16, 0, 0);
  d.shell_part(1, 1.5).shell(1, 1, 1, 2, 3, 4).shell3(1, 2, 2, 5, 3);
  const Built b(d);
  const auto at = [&](int first, int second) { return width(b, Carrier::shell4, first, second); };
  EXPECT_DOUBLE_EQ(at(1, 2), 0.5 * std::sqrt(80 / 4.0) + 0.75);
  EXPECT_DOUBLE_EQ(at(5, 3), 0.5 * std::sqrt(24 / 3.0) + 0.75);
  EXPECT_DOUBLE_EQ(at(2, 3), 0.5 * std::sqrt(80 / 4.0 + 24 / 3.0));
  EXPECT_EQ(width(b, Carrier::shell3, 2, 3), at(2, 3));
  EXPECT_EQ(at(1, 5), 0);
}

TEST(WidthsOfEdges, OnLinesAreTheRootOfTheMeanSectionAtTheirEnds) {
  test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 20, 0, 0).node(4, 0, 9, 0);
  d.node(11, 0, 50, 0).node(12, 10, 50, 0).node(13, 20, 50, 0);
  d.truss_part(1, 4).truss_part(2, 9).beam_part(3, 16).beam_part(4, 25);
  d.bar("TRUSS", 1, 1, 1, 2).bar("TRUSS", 2, 2, 2, 3);
  d.bar("BEAM", 3, 3, 11, 12, 4).bar("BEAM", 4, 4, 12, 13, 4);
  const Built b(d);
  // Sections of 2 and 3, of 4 and 5: the one in the middle has both elements.
  EXPECT_DOUBLE_EQ(width(b, Carrier::truss, 1, 2), std::sqrt((2 + 2 + 3) / 3.0));
  EXPECT_DOUBLE_EQ(width(b, Carrier::truss, 2, 3), std::sqrt((2 + 3 + 3) / 3.0));
  EXPECT_DOUBLE_EQ(width(b, Carrier::beam, 11, 12), std::sqrt((4 + 4 + 5) / 3.0));
  EXPECT_EQ(width(b, Carrier::truss, 11, 12), 0);
}

// --- accounts

TEST(AccountOfEffects, KnowsEveryValueOfItsFlags) {
  const auto on = [](const ContactCard& card, const char* name) {
    for (const EffectState& e : effect_plan(card))
      if (e.name == name) return e.on;
    throw std::out_of_range(name);
  };
  const ContactKind kinds[] = {ContactKind::node_segment, ContactKind::edge_edge,
                               ContactKind::tied};
  for (const ContactKind kind : kinds) {
    const bool free = kind != ContactKind::tied, nodes = kind == ContactKind::node_segment;
    for (int value = 0; value <= 7; ++value) {
      ContactCard c;
      c.kind = kind;
      c.istf = c.igap = c.inacti = c.iadm = c.itied = c.idel = c.ibag = value;
      EXPECT_EQ(on(c, "stiffness-combination"), free && value >= 2 && value <= 5) << value;
      EXPECT_EQ(on(c, "fixed-stiffness"), free && value == 1) << value;
      EXPECT_EQ(on(c, "variable-gap"), free && value >= 1 && value <= 3) << value;
      EXPECT_EQ(on(c, "gap-reduction"), free && (value == 5 || value == 6)) << value;
      EXPECT_EQ(on(c, "initial-penetration-action"), free && value >= 1 && value <= 3) << value;
      EXPECT_EQ(on(c, "adaptivity-criteria"), nodes && value > 0) << value;
      EXPECT_EQ(on(c, "contact-flag"), value > 0) << value;
      EXPECT_EQ(on(c, "element-deletion"), value > 0) << value;
      EXPECT_FALSE(on(c, "tie-on-time-step")) << "no step is below 0";
      c.dtmin = 1e-6;
      EXPECT_EQ(on(c, "tie-on-time-step"), nodes && value > 0) << value;
      EXPECT_EQ(on(c, "time-step-deletion"), value == 0) << value;
      c.iadm = 0;
      EXPECT_EQ(on(c, "contact-flag"), value == 1) << value;
    }
    ContactCard c;
    c.kind = kind;
    EXPECT_EQ(on(c, "elastic-normal"), free);
    EXPECT_EQ(on(c, "tie"), !free);
    EXPECT_EQ(on(c, "contact-time-step"), free);
    EXPECT_FALSE(on(c, "activity-window"));
    for (const int field : {0, 1, 2}) {
      ContactCard window = c;
      if (field == 0) window.tstart = 1e-9;
      if (field == 1) window.tstop = 1e29;
      if (field == 2) window.sensor_time = 0.0;
      EXPECT_TRUE(on(window, "activity-window")) << field;
    }
    c.fpenmax = 0.5;
    c.icurv = 1;
    c.ibc = 7;
    EXPECT_EQ(on(c, "penetration-limit"), nodes);
    EXPECT_EQ(on(c, "curvature"), nodes);
    EXPECT_EQ(on(c, "boundary-release"), nodes);
  }
}

TEST(AccountOfEffects, SaysWhichFieldDecidesAndHow) {
  using Row = std::pair<std::string, std::string>;  // field and reason
  const auto row = [](const ContactCard& card, const char* name) {
    for (const EffectState& e : effect_plan(card))
      if (e.name == name) return Row{e.field, e.reason};
    throw std::out_of_range(name);
  };
  ContactCard c;
  EXPECT_EQ(row(c, "boundary-release"), (Row{"IBC", "IBC = 000"}));
  for (const auto& [bits, words] :
       {std::pair(4, "X"), std::pair(2, "Y"), std::pair(1, "Z"), std::pair(5, "X, Z"),
        std::pair(6, "X, Y"), std::pair(7, "X, Y, Z")}) {
    c.ibc = bits;
    EXPECT_EQ(row(c, "boundary-release").second, std::string("IBC frees ") + words);
  }
  EXPECT_EQ(row(c, "heat-conduction"), (Row{"Ithe", "Ithe = 0"}));
  EXPECT_EQ(row(c, "radiation"), (Row{"Ithe", "Ithe = 0"}));
  EXPECT_EQ(row(c, "friction-heat"), (Row{"Ithe", "Ithe = 0"}));
  c.ithe = 1;
  c.drad = 2;
  EXPECT_EQ(row(c, "heat-conduction"), (Row{"Kthe", "Kthe = 0"}));
  EXPECT_EQ(row(c, "radiation"), (Row{"Frad", "Frad = 0"}));
  EXPECT_EQ(row(c, "friction-heat"), (Row{"Fheats", "Fheats = 0, Fheatm = 0"}));
  c.frad = 0.5;
  EXPECT_EQ(row(c, "radiation"), (Row{"Drad", "Drad = 2"}));
  c.fheatm = 0.25;
  EXPECT_EQ(row(c, "friction-heat"), (Row{"Fheatm", "Fheatm = 0.25 is lost: Ithe_form = 0"}));
  c.fheats = 0.5;
  EXPECT_EQ(row(c, "friction-heat"),
            (Row{"Fheats", "Fheats = 0.5; Fheatm = 0.25 is lost: Ithe_form = 0"}));
  c.fct_idk = Curve{{0, 1}, {1, 1}};
  EXPECT_EQ(row(c, "friction-heat").second,
            "Fheats = 0.5, Fheatm = 0.25: lost with fct_IDK and Ithe_form = 0");
  c.ithe_form = 1;
  EXPECT_EQ(row(c, "friction-heat").second, "Fheats = 0.5, Fheatm = 0.25");
  c.kind = ContactKind::edge_edge;
  EXPECT_EQ(row(c, "friction-heat").second, "no friction heat between edges");
  EXPECT_EQ(row(c, "boundary-release").second, "edges release nothing");
  c = {};
  c.itied = 1;
  EXPECT_EQ(row(c, "tie-on-time-step"),
            (Row{"dtmin", "ITIED = 1, but dtmin = 0, and no time step is below 0"}));
  c.dtmin = 0.5;
  EXPECT_EQ(row(c, "tie-on-time-step"), (Row{"ITIED", "ITIED = 1"}));
  EXPECT_EQ(row(c, "time-step-deletion").second, "ITIED ties instead");
  EXPECT_EQ(row(c, "activity-window"), (Row{"Tstart", "Tstart = 0"}));
  c.sensor_time = 1;
  EXPECT_EQ(row(c, "activity-window"), (Row{"sens_ID", "sensor"}));
}

// --- whole evaluations

TEST(CriteriaOfAnEvaluation, AreTheSharpestOfTheSegmentsOfEachNode) {
  // A ridge of two quads of different slopes, a node over each and one on the ridge.
  test::SmallDeck d;
  d.node(1, -8, 0, -2).node(2, 0, 0, 0).node(3, 0, 10, 0).node(4, -8, 10, -2);
  d.node(5, 6, 0, -3).node(6, 6, 10, -3);
  d.node(11, -4, 4, -0.6).node(12, 3, 6, -1.0).node(13, 0.1, 5, 0.5);
  d.shell_part(1, 1).shell(1, 1, 1, 2, 3, 4).shell(1, 2, 2, 5, 6, 3);
  d.segments("/SURF/SEG/1", {{1, 2, 3, 4}, {2, 5, 6, 3}}).group("/GRNOD/NODE/2", {11, 12, 13});
  d.add("/ADMESH/GLOBAL\n         1");
  d.add("@/INTER/TYPE7/1 Gapmin=1 Iadm=2 NRadm=3 Padm=0.5 Angladm=20");
  SceneOptions o;
  o.nodal_stiffness = true;
  const Built b(d, o);
  const SceneOutcome out = run_cycle(b.scene, make_state(b.scene), {});
  const ContactOutcome& c = out.contacts.at(0);
  // The same pairs, asked one by one.
  const ContactPairs pairs = make_pairs(b.scene, b.contact(), c.card, Model::reference);
  std::map<NodeIndex, NodeCriteria> wanted;
  ASSERT_GE(pairs.size(), 4u);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    Pair p;
    for (std::size_t role = 0; role < 5; ++role) {
      const NodeIndex n = pairs.nodes.node[role][i];
      p.x[role] = {b.scene.coordinates.x[n], b.scene.coordinates.y[n], b.scene.coordinates.z[n]};
    }
    for (std::size_t k = 0; k < 4; ++k)
      p.normal[k] = {pairs.normal[k][0][i], pairs.normal[k][1][i], pairs.normal[k][2][i]};
    p.k0 = pairs.k0[i];
    p.gap = pairs.gap[i];
    const testing::Outcome r = testing::run(c.card, p);
    for (std::size_t role = 0; role < 5; ++role) {
      NodeCriteria& at = wanted[pairs.nodes.node[role][i]];
      at.radius = std::min(at.radius, r.all.criteria[0][0]);
      if (role > 0) continue;
      at.penetration = std::max(at.penetration, r.all.criteria[1][0]);
      at.angle = std::min(at.angle, r.all.criteria[2][0]);
    }
  }
  ASSERT_EQ(c.criteria.size(), wanted.size());
  auto it = wanted.begin();
  for (const NodeCriteria& got : c.criteria) {
    EXPECT_EQ(got.node, it->first);
    EXPECT_NEAR(got.radius, it->second.radius, 1e-9 * got.radius);
    EXPECT_NEAR(got.penetration, it->second.penetration, 1e-12);
    EXPECT_NEAR(got.angle, it->second.angle, 1e-12 * std::abs(got.angle));
    EXPECT_LT(got.radius, 1e30);
    ++it;
  }
  EXPECT_GT(c.criteria.back().penetration, 0);
}

TEST(EdgesGiveBackTheirGap, ByHalfOfTheDepthOfEachCycle) {
  // Two edges that cross, 0.7 apart with a gap of 1: 0.15 is stored for each.
  test::SmallDeck d;
  d.node(1, -5, 0, 0).node(2, 5, 0, 0).node(3, -5, 9, 0).node(4, 5, 9, 0);
  d.node(11, 0, -5, 0.7).node(12, 0, 5, 0.7).node(13, 9, -5, 0.7).node(14, 9, 5, 0.7);
  d.shell_part(1, 1).shell(1, 1, 1, 2, 4, 3).shell(1, 2, 11, 12, 14, 13);
  d.segments("/LINE/SEG/1", {{11, 12}}).segments("/LINE/SEG/2", {{1, 2}});
  d.add("@/INTER/TYPE11/1 line_IDs=1 line_IDm=2 Gapmin=1 Inacti=5");
  SceneOptions o;
  o.nodal_stiffness = true;
  const Built b(d, o);
  const double distances[] = {0.7, 0.9, 0.7, 0.95, 0.5};
  std::vector<double> depth;
  const auto place = [&](std::size_t k, Coordinates& x, State&, CycleOptions& options) {
    options.keep_pairs = true;
    for (const std::int64_t id : {11, 12, 13, 14}) x.z[b.model.nodes.map.find(id)] = distances[k];
  };
  const auto look = [&](std::size_t, const SceneOutcome& r, const Coordinates&) {
    const auto& pairs = r.contacts.at(0).pairs;
    depth.push_back(pairs.empty() ? 0.0 : pairs[0].penetration);
  };
  static_cast<void>(run_steps(b.scene, make_state(b.scene), {}, 5, place, look));
  // Taken off each time: no more than before, and than half of the last depth for each edge.
  double off = 0.15, wanted[5];
  for (std::size_t k = 0; k < 5; ++k) {
    if (k > 0) off = std::min(off, 0.5 * std::max(0.0, 1 - distances[k - 1]));
    wanted[k] = std::max(0.0, 1 - distances[k] - 2 * off);
  }
  ASSERT_EQ(depth.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(depth[k], wanted[k], 1e-9) << k;
  EXPECT_NEAR(wanted[4], 0.45, 1e-12);
}

TEST(MissingArrays, OfResidualPenetrationAreNamedWhereTheGapIsReduced) {
  ContactCard card = testing::elastic_card();
  const testing::Packet packet({testing::quad_pair({4, 3, 0.6})});
  PacketView view = packet.view();
  view.p0 = nullptr;
  EXPECT_EQ(missing_fields(make_plan(card, Model::reference), view), Field::none);
  card.inacti = 5;
  EXPECT_EQ(missing_fields(make_plan(card, Model::reference), view), Field::residual_penetration);
  EXPECT_EQ(missing_fields(make_plan(card, Model::reference), packet.view()), Field::none);
}

// --- limits of single pairs, and ties

TEST(PairStepLimit, IsThatOfTheLightestNodeOfThePairAlone) {
  ContactCard card = testing::elastic_card();
  card.step_factor = 0.5;
  Pair p = testing::quad_pair({4, 3, 0.6});
  for (std::size_t light = 0; light < 5; ++light) {
    p.k0 = light == 0 ? 0.25 : 1e5;  // a soft pair has a step, too
    p.m = {1, 1, 1, 1, 1};
    p.m[light] = 1e-4;
    card.dtmin = 0;
    const testing::Outcome free = testing::run(card, p);
    double least = 1e30;
    for (std::size_t r = 0; r < 5; ++r) {
      const double share = r == 0 ? 1 : free.weights()[r - 1];
      least = std::min(least, std::sqrt(2 * p.m[r] / (share * free.all.k_nodal[0])));
    }
    const auto deleted = [&](double dtmin) {
      card.dtmin = dtmin;
      return (testing::run(card, p).all.status[0] & status_step_deleted) != 0;
    };
    EXPECT_TRUE(deleted(0.5 * least * (1 + 1e-12))) << light;
    EXPECT_FALSE(deleted(0.5 * least * (1 - 1e-12))) << light;
  }
}

TEST(PairStepLimit, OfEdgesIsThatOfTheLighterMeanMass) {
  ContactCard card = testing::elastic_card();
  card.kind = ContactKind::edge_edge;
  card.step_factor = 0.5;
  Pair p;
  // The first at a quarter of its length, the second at five eighths.
  p.x = {Vec{-2, 0, 0.6}, Vec{6, 0, 0.6}, Vec{0, -5, 0}, Vec{0, 3, 0}, Vec{}};
  p.k0 = 1e5;
  for (const std::array<double, 4>& m :
       {std::array<double, 4>{2, 3, 50, 70}, std::array<double, 4>{20, 30, 5, 7}}) {
    for (std::size_t r = 0; r < 4; ++r) p.m[r] = m[r];
    card.dtmin = 0;
    const double k = testing::run(card, p).all.k_nodal[0];
    const double mass = std::min(0.75 * m[0] + 0.25 * m[1], 0.375 * m[2] + 0.625 * m[3]);
    const double limit = 0.5 * std::sqrt(2 * mass / k);
    const auto deleted = [&](double dtmin) {
      card.dtmin = dtmin;
      return (testing::run(card, p).all.status[0] & status_step_deleted) != 0;
    };
    EXPECT_TRUE(deleted(limit * (1 + 1e-12)));
    EXPECT_FALSE(deleted(limit * (1 - 1e-12)));
  }
}

TEST(TiesByTimeStep, BeginWithTheElasticForceOfTheirSideAndPlace) {
  ContactCard card = testing::elastic_card();
  card.itied = 1;
  card.dtmin = 1e3;
  for (const Model model : {Model::reference, Model::robust})
    for (const double side : {1.0, -1.0})
      for (const int istf : {0, 1}) {
        card.istf = istf;
        card.stfac = 3e4;
        Pair p = testing::quad_pair({4, 3, side * 0.6});
        const testing::Outcome r = testing::run(card, p, 0, 0, model);
        const double kappa = istf == 1 ? 3e4 : 0.5 * p.k0;
        EXPECT_NE(r.all.status[0] & status_tied, 0);
        EXPECT_NEAR(r.all.tie[0][0], -side * kappa * 0.4 / 0.6, 1e-6) << istf;
        for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(r.all.tie[c + 3][0], r.weights()[c]);
        EXPECT_NEAR(r.all.tie[6][0], 0.4, 1e-12);
        // Where the weights point to the node is as far as the height.
        EXPECT_NEAR(r.all.tie[7][0], side * 0.6, 1e-12);
        EXPECT_EQ(r.all.dt_kinematic[0], 1e30);
      }
}

TEST(TiesByTimeStep, KeepTheirWeightsAndTheDepthTheyBeganWith) {
  ContactCard card = testing::elastic_card();
  card.itied = 2;
  card.dtmin = 1e-9;
  for (const Model model : {Model::reference, Model::robust}) {
    Pair p = testing::quad_pair({4, 3, 1.2});
    p.gap = 2;
    p.tie = {-30, 4, 5, 0.25, 0.375, 0.125, 0.5, 1};
    const testing::Outcome r = testing::run(card, p, 0, 0, model);
    EXPECT_EQ(r.weights(), (std::array<double, 4>{0.25, 0.375, 0.125, 0.25}));
    EXPECT_NEAR(r.all.penetration[0], 0.8, 1e-12);
    // Room for 2 less the smaller of both depths: K/2 (2 / 1.5)^2.
    EXPECT_NEAR(r.all.k_nodal[0], 0.5 * p.k0 * 16 / 9, 1e-9 * p.k0);
    // At rest the tie pulls as before.
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(r.all.tie[c][0], p.tie[c]);
    EXPECT_EQ(r.all.normal_force[0], -30);
    // A depth of all of the gap: the robust model leaves a hundred-millionth of it.
    p.x[0] = {4, 3, 1e-13};
    p.tie[6] = 2;
    const double room = model == Model::robust ? 2e-8 : 1e-10;
    EXPECT_NEAR(testing::run(card, p, 0, 0, model).all.k_nodal[0] * room * room / (2 * p.k0), 1,
                1e-3);
  }
}

// --- friction by directions

TEST(DirectedCoefficients, TakeTheConstantsOfTheirPair) {
  Pair p = testing::quad_pair({5, 5, 0.6});
  p.ortho_mu = {0.3, 0.1};
  p.ortho_direction = {0.6, 0.8};
  const testing::Packet packet({p});
  const auto slip = [&](ContactCard card, const std::array<double, 6>* along,
                        const std::array<double, 6>* across, Vec v) {
    PacketView view = packet.view();
    for (std::size_t k = 0; k < 6; ++k) {
      if (along != nullptr) view.c[k] = &(*along)[k];
      if (across != nullptr) view.c2[k] = &(*across)[k];
    }
    detail::SlipState s{{0, 0, 1}, {v[0], v[1], v[2]}, -100, 2, true};
    double ft[3] = {70, 20, 0};
    detail::orthotropic_slip(card, view, 0, s, ft);
    return Vec{ft[0], ft[1], ft[2]};
  };
  const std::array<double, 6> first{0.01, 0.002, 0.0005, 0.003, 0.0025, 0.004};
  const std::array<double, 6> second{0.02, 0.001, 0.0015, 0.002, 0.0045, 0.006};
  const Vec v{1, 3, 0};
  for (const int law : {1, 2, 4}) {
    ContactCard card;
    card.ifric = law;
    card.c = first;
    // Along (0.6, 0.8), across (-0.8, 0.6).
    const double v1 = 0.6 + 0.8 * 3, v2 = -0.8 + 0.6 * 3;
    // Law 4 takes two of its constants the other way round along the first direction.
    std::array<double, 6> turned = first;
    double mu0 = 0.3;
    if (law == 4) std::swap(mu0, turned[0]);
    const double mu1 = friction_coefficient(law, mu0, turned, 2, v1);
    const double mu2 = friction_coefficient(law, 0.1, second, 2, v2);
    const double f1 = 0.6 * 70 + 0.8 * 20, f2 = -0.8 * 70 + 0.6 * 20;
    const auto f = orthotropic_return(f1, f2, mu1, mu2, -100);
    const Vec got = slip(card, &first, &second, v);
    EXPECT_NEAR(got[0], 0.6 * f[0] - 0.8 * f[1], 1e-9) << law;
    EXPECT_NEAR(got[1], 0.8 * f[0] + 0.6 * f[1], 1e-9) << law;
    // Without constants of the pair those of the card hold for both directions.
    EXPECT_EQ(slip(card, nullptr, nullptr, v), slip(card, &first, &first, v)) << law;
    EXPECT_NE(slip(card, nullptr, &second, v), slip(card, nullptr, nullptr, v)) << law;
  }
}

}  // namespace
}  // namespace deck::cycle
