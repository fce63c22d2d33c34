// Rules and tables of the geometry stage, each alone on values that are made by hand: actions on
// penetrations, totals and names of a view, obstacles, values to try.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/rules/actions.hpp"
#include "contact/shared/what_if_text.hpp"
#include "contact/small_deck.hpp"

namespace deck::test {
namespace {

using Action = PenetrationAction;

// --- actions

PenetrationRow row_of(double depth, double gap) {
  PenetrationRow r;
  r.depth = depth;
  r.gap = gap;
  r.normal = {0.6, 0, 0.8};
  return r;
}
/// What is done about a node at (1, 2, 3).
struct Acted {
  PenetrationRow row;
  std::array<double, 3> at;
};
Acted act(int inacti, double fpenmax, PenetrationRow row) {
  std::vector<double> x{9, 1}, y{9, 2}, z{9, 3};
  detail::CandidateGroup group;
  detail::act_on_node(inacti, fpenmax, row, {x, y, z}, 1, group);
  return {row, {x[1], y[1], z[1]}};
}

TEST(ActionsOnNodes, AreThoseOfInacti) {
  const double more = 1 + 1e-8;
  const std::pair<int, Action> actions[] = {{0, Action::none},
                                            {1, Action::node_stiffness_zero},
                                            {2, Action::segment_stiffness_zero},
                                            {3, Action::node_moved},
                                            {4, Action::none},
                                            {5, Action::gap_reduced},
                                            {6, Action::gap_reduced}};
  for (const auto& [inacti, action] : actions) {
    const Acted a = act(inacti, 0, row_of(0.25, 2));
    EXPECT_EQ(a.row.action, action) << inacti;
    EXPECT_EQ(a.row.has_gap0, inacti >= 5) << inacti;
    const double p0 = inacti == 5   ? 0.25 * more
                      : inacti == 6 ? 0.25 * more + 0.05 * (2 - 0.25 * more)
                                    : 0;
    EXPECT_DOUBLE_EQ(a.row.p0, p0) << inacti;
    EXPECT_DOUBLE_EQ(a.row.gap0, inacti >= 5 ? 2 - p0 : 0) << inacti;
    const double by = inacti == 3 ? 0.25 * more : 0;
    EXPECT_DOUBLE_EQ(a.at[0], 1 + 0.6 * by) << inacti;
    EXPECT_EQ(a.at[1], 2) << inacti;
    EXPECT_DOUBLE_EQ(a.at[2], 3 + 0.8 * by) << inacti;
    EXPECT_DOUBLE_EQ(a.row.moved_by[2], 0.8 * by) << inacti;
  }
  PenetrationRow on = row_of(0.25, 2);
  on.on_surface = true;
  EXPECT_EQ(act(5, 0, on).row.p0, 0.25) << "exactly on the segment nothing is added";
}

TEST(ActionsOnNodes, OfFpenmaxComeFirstAndTakeWhatIsDeeper) {
  PenetrationRow on = row_of(0.5, 2);
  on.on_surface = true;  // a depth of 0.5 as it is
  EXPECT_EQ(act(5, 0.25, on).row.action, Action::gap_reduced) << "not deeper than its share";
  EXPECT_EQ(act(5, 0.2499, on).row.action, Action::node_stiffness_zero);
  EXPECT_FALSE(act(5, 0.2499, on).row.has_gap0);
  EXPECT_EQ(act(0, 0.2499, on).row.action, Action::node_stiffness_zero);
  // Beside the surface the depth counts a hundred-millionth more.
  EXPECT_EQ(act(0, 0.25, row_of(0.5, 2)).row.action, Action::node_stiffness_zero);
}

TEST(ActionsOnModernPairs, StoreTheDepthOrNothing) {
  struct Case {
    int type, inacti;
    double depth;
    Action action;
    double stored;
  };
  const Case cases[] = {
      {24, 0, 0.5, Action::ignored, 0},         {24, 0, 1e-8, Action::ignored, 1e-8},
      {25, 0, 1.1e-8, Action::ignored, 0},      {24, 5, 0.5, Action::offset_stored, 0.5},
      {25, 5, 0.5, Action::offset_stored, 0.5}, {24, -1, 0.5, Action::initial_force, 0.5},
      {25, -1, 0.5, Action::initial_force, 0},  {25, -1, 1e-9, Action::initial_force, 0}};
  for (const Case& c : cases) {
    PenetrationRow r = row_of(c.depth, 2);
    detail::act_on_modern(c.type, c.inacti, r);
    EXPECT_EQ(r.action, c.action) << c.type << ' ' << c.inacti;
    EXPECT_EQ(r.p0, c.stored) << c.type << ' ' << c.inacti << ' ' << c.depth;
  }
  EXPECT_TRUE(detail::finds_the_same(0, 0) && detail::finds_the_same(5, -1));
  EXPECT_FALSE(detail::finds_the_same(0, 5) || detail::finds_the_same(-1, 0));
}

TEST(ActionsOnEdges, StoreHalfForEachOrSwitchThemOff) {
  const auto stores = [](int inacti, double depth, double s, double m) {
    PenetrationRow r = row_of(depth, 2);
    detail::act_on_edges(inacti, r, s, m);
    return std::tuple(r.action, s, m);
  };
  const double more = 1 + 1e-8, p5 = 0.5 * 0.25 * more, p6 = 0.5 * (0.25 + 0.05 * 1.75);
  EXPECT_EQ(stores(0, 0.25, 0, 0), std::tuple(Action::none, 0.0, 0.0));
  EXPECT_EQ(stores(3, 0.25, 0, 0), std::tuple(Action::none, 0.0, 0.0));
  for (const int inacti : {1, 2})
    EXPECT_EQ(stores(inacti, 0.25, 0, 0), std::tuple(Action::edge_stiffness_zero, 0.0, 0.0));
  EXPECT_EQ(stores(5, 0.25, 0, 0.75), std::tuple(Action::gap_reduced, p5, 0.75));
  EXPECT_EQ(stores(5, 0.25, 0.75, 0), std::tuple(Action::gap_reduced, 0.75, p5));
  EXPECT_EQ(stores(6, 0.25, 0, 0), std::tuple(Action::gap_reduced, p6, p6));
  // At 99.5 % of the gap: Inacti 6 takes the depth as it is.
  EXPECT_EQ(std::get<0>(stores(6, 0.995 * 2, 0, 0)), Action::edge_stiffness_zero);
  EXPECT_EQ(std::get<0>(stores(6, std::nextafter(0.995 * 2, 0), 0, 0)), Action::gap_reduced);
  EXPECT_EQ(std::get<0>(stores(5, std::nextafter(0.995 * 2, 0), 0, 0)),
            Action::edge_stiffness_zero);
  PenetrationRow r = row_of(0.25, 2);
  detail::finish_edge_row(r, 0.25, 0.5);
  EXPECT_FALSE(r.has_gap0);
  r.action = Action::gap_reduced;
  detail::finish_edge_row(r, 0.25, 0.5);
  EXPECT_EQ(std::tuple(r.p0, r.gap0, r.has_gap0), std::tuple(0.75, 1.25, true));
}

TEST(OnSurfaceErrors, AreAvoidedByFpenmaxInactiAndReboundOfTies) {
  EXPECT_EQ(detail::on_surface_error(7, 0, 0, 0), 612);
  for (const int inacti : {3, 5, 6}) EXPECT_EQ(detail::on_surface_error(7, 0, 0, inacti), 611);
  for (const int inacti : {1, 2}) EXPECT_EQ(detail::on_surface_error(7, 0, 0, inacti), 0);
  EXPECT_EQ(detail::on_surface_error(7, 0, 0.5, 0), 0);
  EXPECT_EQ(detail::on_surface_error(10, 1, 0, 0), 0);
  EXPECT_EQ(detail::on_surface_error(10, 0, 0, 0), 612);
  EXPECT_EQ(detail::on_surface_error(7, 1, 0, 0), 612);
}

TEST(CandidateGroups, Hold128AndRememberWhereTheirNodesStood) {
  detail::CandidateGroup group;
  for (int k = 0; k < 128; ++k) EXPECT_FALSE(group.begins_another()) << k;
  EXPECT_TRUE(group.begins_another());
  for (int k = 1; k < 128; ++k) EXPECT_FALSE(group.begins_another()) << k;
  EXPECT_TRUE(group.begins_another());
  std::vector<double> x{1, 2}, y{3, 4}, z{5, 6};
  const detail::MovableNodes nodes{x, y, z};
  EXPECT_EQ(group.start_of(nodes, 1).x, 2);
  x[1] = 9;
  EXPECT_EQ(group.start_of(nodes, 0).x, 1);
  EXPECT_EQ(group.start_of(nodes, 1).x, 2) << "where it stood";
  group.start();
  EXPECT_EQ(group.start_of(nodes, 1).x, 9);
}

// --- obstacles and sizes

TEST(Obstacles, AreTheFirstThatHolds) {
  Contact good;
  good.gapmin = 1;
  good.secondary.resize(1);
  good.main.resize(2);
  good.main[1].stiffness = 3;
  EXPECT_EQ(obstacle_of(good), Obstacle::none);
  const auto with = [&](auto&& change) {
    Contact c = good;
    change(c);
    return std::string(to_string(obstacle_of(c)));
  };
  EXPECT_EQ(with([](Contact& c) { c.main[1].stiffness = 0; }), "no_stiffness");
  EXPECT_EQ(with([](Contact& c) { c.no_carrier = {0}; }), "no_element");
  EXPECT_EQ(with([](Contact& c) { c.no_carrier = {0}, c.degenerate_segments = 1; }), "no_area");
  EXPECT_EQ(with([](Contact& c) { c.degenerate_segments = 1, c.gapmin = 0; }), "no_gap");
  EXPECT_EQ(with([](Contact& c) { c.gapmin = 0, c.secondary.clear(); }), "empty_secondary");
  EXPECT_EQ(with([](Contact& c) { c.main.clear(), c.secondary.clear(); }), "empty_main");
  EXPECT_EQ(with([](Contact& c) { c.main.clear(), c.dropped = true; }), "");
  for (const int type : {24, 25}) {
    EXPECT_EQ(with([&](Contact& c) { c.gapmin = 0, c.type = type; }), "");
    EXPECT_EQ(
        with([&](Contact& c) { c.type = type, c.kind = ContactKind::edge_edge, c.main.clear(); }),
        "");
    EXPECT_EQ(with([&](Contact& c) { c.type = type, c.main.clear(); }), "empty_main");
  }
  Contact edges;
  edges.kind = ContactKind::edge_edge;
  edges.gapmin = 1;
  edges.main_edges.resize(2);
  edges.secondary_edges.resize(2);
  for (auto* side : {&edges.main_edges, &edges.secondary_edges})
    for (ContactEdge& e : *side) e.carrier = Carrier::truss;
  EXPECT_EQ(obstacle_of(edges), Obstacle::none) << "edges without stiffness are searched";
  for (auto* side : {&edges.main_edges, &edges.secondary_edges}) {
    (*side)[1].carrier = Carrier::none;
    EXPECT_EQ(obstacle_of(edges), Obstacle::no_element);
    (*side)[1].carrier = Carrier::truss;
  }
  edges.main_edges.clear();
  EXPECT_EQ(obstacle_of(edges), Obstacle::empty_main);
}

TEST(BoundedGaps, EndAtTenTimesTheSizeOfTheModel) {
  SmallDeck d;
  d.node(1, -1, 2, 5).node(2, 2, 6, 17).node(3, 0, 3, 9);
  const Built b(d);
  EXPECT_DOUBLE_EQ(largest_bounded_gap(b.model), 130);  // 3, 4 and 12
  SmallDeck point;
  EXPECT_EQ(largest_bounded_gap(Built(point.node(1, 7, 8, 9)).model), 1e30);
  SmallDeck wide;
  wide.node(1, 0, 0, 0).node(2, 1e31, 0, 0);
  EXPECT_EQ(largest_bounded_gap(Built(wide).model), 1e30);
}

// --- views

/// Two plates of two parts, and contacts that are made by hand over them.
struct Made {
  SmallDeck deck;
  std::unique_ptr<Built> built;
  Made() {
    for (int n = 0; n < 12; ++n) deck.node(n + 1, n % 4, n / 4, 0.5 * n);
    deck.shell_part(5, 1).shell_part(7, 1).truss_part(9, 1);
    deck.shell(5, 50, 1, 2, 6, 5).shell(7, 70, 5, 6, 10, 9).shell3(7, 71, 7, 8, 12);
    deck.bar("TRUSS", 9, 90, 3, 4);
    built = std::make_unique<Built>(deck);
    built->scene.contacts.clear();
  }
  Scene& scene() { return built->scene; }
};
Contact over_plates() {
  Contact c;
  for (const NodeIndex n : {0u, 1u, 8u, 9u}) {
    SecondaryNode s;
    s.node = n;
    c.secondary.push_back(s);
  }
  MainSegment a, b;
  a.nodes = {0, 1, 5, 4};
  a.carrier = Carrier::shell4;
  a.element = 0;
  b.nodes = {6, 7, 11, 11};
  b.carrier = Carrier::shell3;
  b.element = 0;
  c.main = {a, b};
  return c;
}

TEST(ViewOfRows, SortsByDepthThenContactThenRowAndNamesEach) {
  Made made;
  Contact first = over_plates(), second = over_plates();
  const auto add = [](Contact& c, std::uint32_t s, std::uint32_t m, double depth, double gap) {
    PenetrationRow r = row_of(depth, gap);
    r.secondary = s;
    r.main = m;
    c.penetrations.push_back(r);
  };
  add(first, 0, 1, 0.25, 1);
  add(first, 2, 0, 0.5, 4);
  add(first, 2, 1, 0.75, 1);
  add(second, 3, 0, 0.5, 0.5);
  add(second, 1, 1, 0.5, 0);
  second.penetrations[0].action = Action::node_moved;
  second.penetrations[1].on_surface = true;
  made.scene().contacts = {first, second};
  for (const int threads : {1, 2}) {
    const SceneView v = make_view(made.scene(), nullptr, threads);
    ASSERT_EQ(v.penetrations.size(), 5u);
    const std::array<std::uint32_t, 2> order[] = {{0, 2}, {0, 1}, {1, 0}, {1, 1}, {0, 0}};
    const std::array<std::int64_t, 5> names[] = {// node, its element, its part, main element, part
                                                 {9, 70, 7, 71, 7},
                                                 {9, 70, 7, 50, 5},
                                                 {10, 70, 7, 50, 5},
                                                 {2, 50, 5, 71, 7},
                                                 {1, 50, 5, 71, 7}};
    for (std::size_t k = 0; k < 5; ++k) {
      const NamedPenetration& p = v.penetrations[k];
      EXPECT_EQ((std::array{p.contact, p.row}), order[k]) << k;
      EXPECT_EQ((std::array{p.secondary[0], p.secondary_element.id, p.secondary_element.part,
                            p.main_element.id, p.main_element.part}),
                names[k])
          << k;
      EXPECT_EQ(p.secondary[1], 0);
      const auto n = static_cast<double>(p.secondary[0] - 1);
      EXPECT_EQ(p.at, (std::array<double, 3>{std::fmod(n, 4), std::floor(n / 4), 0.5 * n}));
    }
    EXPECT_EQ(v.penetrations[0].main, (std::array<std::int64_t, 4>{7, 8, 12, 12}));
    EXPECT_EQ(v.deepest_per_node, (std::vector<std::uint32_t>{0, 2, 3, 4}));
    ASSERT_EQ(v.part_pairs.size(), 3u);
    const std::tuple<std::int64_t, std::int64_t, double, double, double, std::uint64_t> pairs[] = {
        {7, 7, 0.75, 0.75, 0.75, 1}, {5, 7, 0.5, 0.375, 0.25, 2}, {7, 5, 0.5, 0.5, 1, 2}};
    for (std::size_t k = 0; k < 3; ++k) {
      const PartPair& p = v.part_pairs[k];
      EXPECT_EQ(
          std::tuple(p.secondary, p.main, p.max_depth, p.mean_depth, p.max_ratio, p.count.pairs),
          pairs[k])
          << k;
    }
    EXPECT_EQ(v.part_pairs[2].worst, 1u);
    EXPECT_EQ(v.part_pairs[1].on_segment.nodes, 1u);
    const ContactTotals& t = v.contacts[1];
    EXPECT_EQ(std::tuple(t.count.pairs, t.count.nodes, t.count.edges, t.acted, t.max_depth,
                         t.max_ratio, t.on_segment.pairs, t.solver_errors),
              std::tuple(2u, 2u, 0u, 1u, 0.5, 1.0, 1u, 1u));
    EXPECT_EQ(std::tuple(v.total.count.pairs, v.total.count.nodes, v.total.max_depth),
              std::tuple(5u, 4u, 0.75));
  }
}

TEST(ViewOfTies, CountsThemApartAndWhatNoSegmentReaches) {
  Made made;
  Contact tie = over_plates();
  tie.type = 10;
  for (const std::uint32_t s : {1u, 2u, 2u}) {
    PenetrationRow r = row_of(0.25 * s, 1);
    r.secondary = s;
    tie.penetrations.push_back(r);
  }
  Contact lost = tie, on_demand = tie;
  lost.evaluated = false;
  on_demand.type = 7;
  on_demand.itied = 1;
  made.scene().contacts = {tie, lost, on_demand};
  const SceneView v = make_view(made.scene());
  EXPECT_TRUE(v.penetrations.empty());
  EXPECT_EQ(v.ties.size(), 9u);
  EXPECT_EQ(v.ties[0].secondary[0], 9);
  const std::uint64_t untied[] = {2, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(v.contacts[k].tied.pairs, 3u);
    EXPECT_EQ(v.contacts[k].tied.nodes, 2u);
    EXPECT_EQ(v.contacts[k].count.pairs, 0u);
    EXPECT_EQ(v.contacts[k].max_depth, 0);
    EXPECT_EQ(v.contacts[k].untied, untied[k]) << k;
  }
  EXPECT_EQ(v.total.untied, 2u);
  EXPECT_EQ(v.total.tied.nodes, 2u);
}

TEST(ViewOfEdges, CountsAnEdgeOnceWhicheverWayItIsWritten) {
  Made made;
  Contact c;
  c.kind = ContactKind::edge_edge;
  for (const auto& [a, b] : {std::pair(2u, 3u), std::pair(3u, 2u), std::pair(6u, 7u)}) {
    ContactEdge e;
    e.nodes = {a, b};
    e.carrier = a < 4 ? Carrier::truss : Carrier::shell3;
    e.element = 0;
    c.secondary_edges.push_back(e);
  }
  c.main_edges = {c.secondary_edges[2]};
  for (std::uint32_t s = 0; s < 3; ++s) {
    PenetrationRow r = row_of(1 + s, 8);
    r.secondary = s;
    r.weight_s = 0.25;
    c.penetrations.push_back(r);
  }
  made.scene().contacts = {c};
  const SceneView v = make_view(made.scene());
  EXPECT_EQ(v.total.count.pairs, 3u);
  EXPECT_EQ(v.total.count.edges, 2u);
  EXPECT_EQ(v.total.count.nodes, 0u);
  ASSERT_EQ(v.penetrations.size(), 3u);
  const NamedPenetration& p = v.penetrations[2];  // the first row: nodes 3 and 4
  EXPECT_EQ(p.secondary, (std::array<std::int64_t, 2>{3, 4}));
  EXPECT_EQ(p.main, (std::array<std::int64_t, 4>{7, 8, 0, 0}));
  EXPECT_EQ(std::tuple(p.secondary_element.id, p.main_element.id), std::tuple(90, 71));
  // A quarter of node 3 at (2, 0, 1), three quarters of node 4 at (3, 0, 1.5).
  EXPECT_EQ(p.at, (std::array<double, 3>{2.75, 0, 1.375}));
  EXPECT_EQ(v.deepest_per_node.size(), 3u);
}

TEST(ViewOfManyRows, HasTheDepthThatFivePercentExceedAndCountsNodesOnce) {
  Made made;
  Contact c = over_plates();
  for (std::uint32_t k = 0; k < 45; ++k) {
    PenetrationRow r = row_of(1.0 + (k * 7) % 45, 100);
    r.secondary = k % 2;  // both on part 5
    c.penetrations.push_back(r);
  }
  made.scene().contacts = {c};
  const SceneView v = make_view(made.scene());
  ASSERT_EQ(v.part_pairs.size(), 1u);
  EXPECT_EQ(v.part_pairs[0].p95_depth, 43);  // 45 and 44 are deeper: 2 of 45
  EXPECT_EQ(v.part_pairs[0].max_depth, 45);
  EXPECT_DOUBLE_EQ(v.part_pairs[0].mean_depth, 23);
  // Thousands of rows are counted in another way.
  for (std::uint32_t k = 45; k < 5000; ++k) c.penetrations.push_back(c.penetrations[k % 45]);
  made.scene().contacts = {c};
  for (const int threads : {1, 3}) {
    const SceneView many = make_view(made.scene(), nullptr, threads);
    EXPECT_EQ(many.total.count.pairs, 5000u);
    EXPECT_EQ(many.total.count.nodes, 2u);
    EXPECT_EQ(many.penetrations.size(), 5000u);
    EXPECT_EQ(many.penetrations[4999].secondary_element.id, 50);
    EXPECT_EQ(many.deepest_per_node.size(), 2u);
  }
}

// --- values to try

TEST(WhatIfText, NamesEveryFieldOnce) {
  const auto w = parse_what_if(
      "12:Gapmin=1.5,Fscalegap=2.5,Gapmax=3.5,Fpenmax=0.5,%mesh_size=4.5,Igap=3,Inacti=-1,"
      "Irem_gap=1000");
  ASSERT_TRUE(w.ok());
  EXPECT_EQ(std::tuple(w->interface_id, w->Gapmin, w->Fscalegap, w->Gapmax, w->Fpenmax,
                       w->mesh_size, w->Igap, w->Inacti, w->Irem_gap),
            std::tuple(12, 1.5, 2.5, 3.5, 0.5, 4.5, 3, -1, 1000));
  const auto one = parse_what_if("3:Gap_scale=0.25");
  ASSERT_TRUE(one.ok());
  EXPECT_EQ(one->Fscalegap, 0.25);
  EXPECT_FALSE(one->Gapmin || one->Gapmax || one->Fpenmax || one->mesh_size || one->Igap ||
               one->Inacti || one->Irem_gap);
  EXPECT_EQ(parse_what_if("3:Gapmax=1e30")->Gapmax, 1e30);
  EXPECT_EQ(parse_what_if("3:Igap=-1000")->Igap, -1000);
}

TEST(WhatIfText, IsHeldAgainstTheCardOfTheInterface) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4).group("/SURF/PART/1", {1});
  d.segments("/LINE/SEG/1", {{1, 2}}).group("/GRNOD/NODE/1", {3});
  d.add("@/INTER/TYPE7/1 surf_IDm=1 grnd_IDs=1 Gapmin=1");
  d.add("@/INTER/TYPE11/2 line_IDs=1 line_IDm=1 Gapmin=1");
  d.add("@/INTER/TYPE19/3 surf_IDs=1 surf_IDm=1 Gapmin=1");
  const Built b(d);
  const auto verdict = [&](const std::string& text) -> std::string {
    const auto w = parse_what_if(text);
    EXPECT_TRUE(w.ok()) << text;
    for (const InterBase* inter : b.interfaces.ordered)
      if (inter->id == w->interface_id) {
        const auto fits = check_what_if(*w, *inter);
        return fits.ok() ? "" : fits.error().message;
      }
    return "no interface";
  };
  for (const char* good : {"1:Gapmin=0.5,Inacti=6,Igap=3", "1:Fpenmax=0.5", "1:Irem_gap=2",
                           "1:Inacti=1000", "2:Gapmin=0.5", "3:Fpenmax=0.5", "3:Inacti=5"})
    EXPECT_EQ(verdict(good), "") << good;
  EXPECT_EQ(verdict("2:Fpenmax=0.5"), "--what-if 2:Fpenmax=0.5: TYPE11 has no field Fpenmax");
  EXPECT_EQ(verdict("2:Gapmin=0.5,Gapmax=2"), "--what-if 2:Gapmax=2.0: TYPE11 has no field Gapmax");
  EXPECT_EQ(verdict("1:Inacti=7").find("--what-if 1:Inacti=7: the field takes "), 0u);
  EXPECT_NE(verdict("1:Inacti=7").find("5, 6"), std::string::npos);
  EXPECT_EQ(verdict("3:Igap=9").find("--what-if 3:Igap=9: the field takes "), 0u);
}

TEST(WhatIfText, SaysWhatIsWrong) {
  const std::pair<const char*, const char*> cases[] = {
      {"Gapmin=1", "there is no ':'"},
      {"x:Gapmin=1", "the interface id is not a number"},
      {"3:", "'' has no '='"},
      {"3:Gapmin", "'Gapmin' has no '='"},
      {"3:Gapmin=1,", "'' has no '='"},
      {"3:Gapmin=x", "the value of 'Gapmin' is not a number"},
      {"3:Gapmin=1.1e30", "the value of 'Gapmin' is out of range"},
      {"3:Gapmin=-1.1e30", "the value of 'Gapmin' is out of range"},
      {"3:Igap=1.5", "'Igap' is a flag, a whole number of at most 1000"},
      {"3:Inacti=1001", "'Inacti' is a flag, a whole number of at most 1000"},
      {"3:Irem_gap=-1001", "'Irem_gap' is a flag, a whole number of at most 1000"},
      {"3:Gap=1", "there is no field 'Gap'"},
  };
  for (const auto& [text, why] : cases) {
    const auto w = parse_what_if(text);
    ASSERT_FALSE(w.ok()) << text;
    EXPECT_EQ(w.error().message.find(std::string("--what-if ") + text + ": " + why + "; expected"),
              0u)
        << w.error().message;
  }
}

}  // namespace
}  // namespace deck::test
