// `deck gaps`: every figure of contacts, pairs, ties and gates in JSON, CSV and tables, from a
// scene whose figures are set here.
#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "deck/contact/ties.hpp"
#include "deck/report/gaps.hpp"
#include "report/inspected.hpp"
#include "report/shared/gate.hpp"
#include "report/shared/text_table.hpp"
#include "report/shared/verdict.hpp"

namespace deck::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

/// Nodes 9 and 10 over a quad and a triangle (interface 1), a truss over an edge (2), a sheet on
/// both sides (TYPE25, 3), and a tie of three nodes (7).
SmallDeck four_interfaces() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(5, 20, 0, 0);
  d.node(9, 5, 6, 0.5).node(10, 12, 2, 0.75).node(11, 5, -5, 0.5).node(12, 5, 5, 0.5);
  d.node(61, 2, 2, 0.25).node(62, 2, 3, 90).node(63, 3, 2, 0.5);
  d.shell_part(1, 2).shell(1, 21, 1, 2, 3, 4).shell3(1, 22, 2, 5, 3).truss_part(2, 1);
  d.bar("TRUSS", 2, 23, 11, 12).bar("TRUSS", 2, 24, 9, 61).group("/SURF/PART/1", {1});
  d.group("/GRNOD/NODE/2", {9, 10}).segments("/LINE/SEG/3", {{11, 12}});
  d.segments("/LINE/SEG/4", {{1, 2}}).group("/GRNOD/NODE/6", {61, 62, 63});
  d.node(31, 0, 0, 40).node(32, 9, 0, 40).node(33, 9, 9, 40).node(34, 0, 9, 40);
  d.node(41, 1, 1, 40.5).node(42, 8, 1, 40.5).node(43, 8, 8, 40.5).node(44, 1, 8, 40.5);
  d.shell_part(5, 1).shell_part(6, 1).shell(5, 25, 31, 32, 33, 34).shell(6, 26, 41, 42, 43, 44);
  d.group("/SURF/PART/5", {5}).group("/SURF/PART/6", {6});
  d.add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.5 Inacti=6");
  d.add("@/INTER/TYPE11/2 line_IDs=3 line_IDm=4 Gapmin=2.5");
  d.add("@/INTER/TYPE25/3 surf_ID1=5 surf_ID2=6 Inacti=5");
  return d.add("@/INTER/TYPE2/7 grnd_IDs=6 surf_IDm=1 Ignore=1 dsearch=2");
}

SceneOptions with_ties() {
  SceneOptions options;
  options.ties = true;
  return options;
}

struct Gapped {
  Gapped() : b(four_interfaces(), with_ties()), view(make_view(b.scene)) {}
  Json json(bool all = false, const std::vector<Crossing>* crossings = nullptr,
            const GateReport* gate = nullptr) const {
    return Json::parse(gaps_json("a_0000.rad", b.deck, b.scene, view, all, crossings, gate));
  }
  Contact& contact(std::size_t i) { return b.scene.contacts.at(i); }
  std::int64_t node_line(std::int64_t id) const {
    const std::string text(b.deck.sources[0].bytes());
    char digits[32];
    std::snprintf(digits, sizeof digits, "\n%10lld", static_cast<long long>(id));
    const auto at = text.find(digits, text.find("\n/NODE"));
    return std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at) + 1, '\n') + 1;
  }
  Json place(std::int64_t node) const {
    return {{"file", b.deck.sources[0].path()}, {"line", node_line(node)}, {"column", 1}};
  }
  Json ids(const std::vector<NodeIndex>& nodes) const {
    Json out = Json::array();
    for (const NodeIndex n : nodes) out.push_back(b.model.node_id(n));
    return out;
  }
  template <class Nodes>
  Json ids_of(const Nodes& nodes) const {
    return ids({nodes.begin(), nodes.end()});
  }
  Built b;
  SceneView view;
};

Json totals_of(const ContactTotals& t) {
  return {{"pairs", t.count.pairs},
          {"nodes", t.count.nodes},
          {"edges", t.count.edges},
          {"tied", {{"nodes", t.tied.nodes}, {"pairs", t.tied.pairs}}},
          {"on_segment",
           {{"nodes", t.on_segment.nodes},
            {"edges", t.on_segment.edges},
            {"pairs", t.on_segment.pairs}}},
          {"crossed_elements", t.crossed_elements ? Json(*t.crossed_elements) : Json()},
          {"solver_errors", t.solver_errors},
          {"acted", t.acted},
          {"max_depth", t.max_depth},
          {"max_ratio", t.max_ratio}};
}

TEST(GapsDocument, HasEveryFigureOfAContact) {
  Gapped g;
  Contact& c = g.contact(0);
  c.igap = 3;
  c.gapmin = 1.125;
  c.gapmax = 7.5;
  c.drad = 0.375;
  c.gapmin_origin = GapminOrigin::card;
  c.inacti = 6;
  c.candidates = 41;
  c.removed_pairs = 42;
  c.max_gap = 2.125;
  c.shortest_side = 8.5;
  c.istf = 1;
  c.secondary[0].multiplier = 0.5;
  c.secondary[1].gap = 0.25;
  c.main[0].stiffness = 77;
  c.main[1].gap = 0.75;
  g.view.contacts[0] = distinct_totals();
  const Json inter = g.json(true)["interfaces"][0];
  EXPECT_EQ(inter["id"], 1);
  EXPECT_EQ(inter["type"], 7);
  EXPECT_EQ(inter["title"], c.inter->title);
  EXPECT_EQ(inter["level"], "stops") << "the solver stops at 60 nodes";
  EXPECT_EQ(inter["max_depth"], 0.1875);
  EXPECT_EQ(inter["max_ratio"], 0.3125);
  ASSERT_EQ(inter["contacts"].size(), 1u);
  Json said = inter["contacts"][0];
  EXPECT_EQ(said.erase("penetrations"), 1u);
  Json secondary = Json::array(), main = Json::array();
  for (const SecondaryNode& s : c.secondary)
    secondary.push_back(
        {{"node", g.b.model.node_id(s.node)}, {"stiffness", s.multiplier}, {"gap", s.gap}});
  for (const MainSegment& m : c.main)
    main.push_back({{"nodes", g.ids_of(m.nodes)}, {"stiffness", m.stiffness}, {"gap", m.gap}});
  EXPECT_EQ(said, Json({{"kind", "node_segment"},
                        {"role", "primary"},
                        {"igap", 3},
                        {"gapmin", 1.125},
                        {"gapmax", 7.5},
                        {"drad", 0.375},
                        {"gapmin_origin", "card"},
                        {"gapmin_from", to_string(GapminOrigin::card)},
                        {"inacti", 6},
                        {"candidates", 41},
                        {"evaluated", true},
                        {"obstacle", nullptr},
                        {"removed_pairs", 42},
                        {"max_gap", 2.125},
                        {"shortest_main_side", 8.5},
                        {"totals", totals_of(distinct_totals())},
                        {"secondary", secondary},
                        {"main", main}}));
  c.igap = 0;
  c.istf = 2;
  c.secondary[0].nodal_stiffness = 5.5;
  c.evaluated = false;
  for (const GapminOrigin o : {GapminOrigin::card, GapminOrigin::half_edge}) {
    c.gapmin_origin = o;
    const Json other = g.json(true)["interfaces"][0]["contacts"][0];
    EXPECT_EQ(other["igap"], 1000) << "0 is written as the card says it";
    EXPECT_EQ(other["gapmin_origin"], o == GapminOrigin::card ? "card" : "derived");
    EXPECT_EQ(other["gapmin_from"], to_string(o));
    EXPECT_EQ(other["secondary"][0]["nodal_stiffness"], 5.5);
    EXPECT_EQ(other["evaluated"], false);
  }
  c.dropped = true;
  EXPECT_EQ(g.json()["interfaces"][0]["contacts"], Json::array());
  EXPECT_FALSE(g.json()["interfaces"][1]["contacts"][0].contains("secondary"));
}

TEST(GapsDocument, HasEveryFigureOfAPenetration) {
  Gapped g;
  Contact& c = g.contact(0);
  ASSERT_EQ(c.penetrations.size(), 2u);
  PenetrationRow& r = c.penetrations[0];
  r.depth = 0.3125;
  r.gap = 1.375;
  r.distance = 1.0625;
  r.normal = {0.25, 0.5, 0.75};
  r.on_surface = true;
  r.in_contact = false;
  r.action = PenetrationAction::node_moved;
  r.has_gap0 = true;
  r.gap0 = 0.875;
  r.p0 = 0.625;
  r.moved_by = {1.5, 2.5, 3.5};
  const NamedPenetration* named = nullptr;
  for (const NamedPenetration& p : g.view.penetrations)
    if (p.contact == 0 && p.row == 0) named = &p;
  ASSERT_NE(named, nullptr);
  const std::int64_t node = g.b.model.node_id(c.secondary[r.secondary].node);
  const Json said = g.json()["interfaces"][0]["contacts"][0]["penetrations"][0];
  const auto element = [](const ElementName& e) {
    return e.valid() ? Json({{"id", e.id}, {"part", e.part}}) : Json();
  };
  EXPECT_EQ(said, Json({{"node", node},
                        {"segment", g.ids_of(c.main[r.main].nodes)},
                        {"penetration", 0.3125},
                        {"gap", 1.375},
                        {"distance", 1.0625},
                        {"normal", {0.25, 0.5, 0.75}},
                        {"on_surface", true},
                        {"in_contact", false},
                        {"action", "node-moved"},
                        {"gap0", 0.875},
                        {"p0", 0.625},
                        {"moved_by", {1.5, 2.5, 3.5}},
                        {"at", named->at},
                        {"secondary_element", element(named->secondary_element)},
                        {"main_element", element(named->main_element)},
                        {"source", g.place(node)}}));
  EXPECT_EQ(g.json()["interfaces"][0]["contacts"][0]["penetrations"][1]["secondary_element"],
            Json())
      << "no element has node 10";
  r.has_gap0 = false;
  r.action = PenetrationAction::none;
  const Json plain = g.json()["interfaces"][0]["contacts"][0]["penetrations"][0];
  EXPECT_EQ(plain["gap0"], Json());
  EXPECT_EQ(plain["p0"], Json());
  EXPECT_EQ(plain["moved_by"], Json());
}

TEST(GapsDocument, OfEdgesHasBothSides) {
  Gapped g;
  Contact& c = g.contact(1);
  ASSERT_EQ(c.kind, ContactKind::edge_edge);
  c.secondary_edges[0].stiffness = 5;
  c.secondary_edges[0].gap = 0.5;
  c.main_edges[0].stiffness = 6;
  c.main_edges[0].gap = 0.75;
  const Json said = g.json(true)["interfaces"][1]["contacts"][0];
  EXPECT_EQ(said["kind"], "edge_edge");
  EXPECT_EQ(said["secondary"],
            Json::array({{{"edge", {11, 12}}, {"stiffness", 5.0}, {"gap", 0.5}}}));
  EXPECT_EQ(said["main"], Json::array({{{"edge", {1, 2}}, {"stiffness", 6.0}, {"gap", 0.75}}}));
  ASSERT_EQ(said["penetrations"].size(), 1u);
  EXPECT_EQ(said["penetrations"][0]["edge"], Json({11, 12}));
  EXPECT_EQ(said["penetrations"][0]["main_edge"], Json({1, 2}));
  EXPECT_EQ(said["penetrations"][0]["source"], g.place(11));
  EXPECT_FALSE(said["penetrations"][0].contains("stored"));
}

TEST(GapsDocument, OfType25HasSegmentsAndEdgesWithWhatTheyAre) {
  Gapped g;
  std::size_t i = 0;
  while (g.contact(i).type != 25) ++i;
  Contact of_edges;
  of_edges.inter = g.contact(i).inter;
  of_edges.type = 25;
  of_edges.kind = ContactKind::edge_edge;
  of_edges.role = ContactRole::edges;
  g.b.scene.contacts.insert(g.b.scene.contacts.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                            of_edges);
  Contact &c = g.contact(i), &edges = g.contact(i + 1);
  ASSERT_GE(c.main.size(), 2u);
  c.segment_kinds[0] = SegmentKind::solid;
  c.segment_kinds[1] = SegmentKind::coat_opposite;
  for (int k = 0; k < 3; ++k) {
    ContactEdge e;
    e.nodes = {g.b.model.nodes.map.find(31 + k), g.b.model.nodes.map.find(41 + k)};
    e.stiffness = 10 + k;
    e.gap = 20 + k;
    edges.main_edges.push_back(e);
    edges.edge_kinds.push_back(static_cast<std::int8_t>(k == 2 ? -1 : k + 1));
  }
  edges.evaluated = false;
  edges.edges_through_segments = {{1, 0, 3, 0.625}};
  g.view = make_view(g.b.scene);
  c.penetrations[0].p0 = 0.4375;
  g.view.contacts[i + 1] = distinct_totals();
  const Json said = g.json(true)["interfaces"][2]["contacts"];
  ASSERT_EQ(said.size(), 1u) << "edges stand with the nodes";
  ASSERT_EQ(said[0]["main"].size(), c.main.size());
  EXPECT_EQ(said[0]["main"][1], Json({{"nodes", g.ids_of(c.main[1].nodes)},
                                      {"stiffness", c.main[1].stiffness},
                                      {"gap", c.main[1].gap},
                                      {"kind", "coat-opposite"}}));
  EXPECT_EQ(said[0]["main"][0]["kind"], "solid");
  EXPECT_EQ(said[0]["secondary"][0], Json({{"node", g.b.model.node_id(c.secondary[0].node)},
                                           {"stiffness", c.secondary[0].multiplier},
                                           {"gap", c.secondary[0].gap}}));
  ASSERT_EQ(said[0]["edges"].size(), edges.main_edges.size());
  const char* const kinds[] = {"solid", "shell", "solid-flat"};
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(said[0]["edges"][static_cast<std::size_t>(k)], Json({{"edge", {31 + k, 41 + k}},
                                                                   {"stiffness", 10.0 + k},
                                                                   {"gap", 20.0 + k},
                                                                   {"kind", kinds[k]}}));
  EXPECT_EQ(said[0]["edges_evaluated"], false);
  EXPECT_EQ(said[0]["edge_totals"], totals_of(distinct_totals()));
  EXPECT_EQ(said[0]["edge_penetrations"], Json::array());
  EXPECT_EQ(said[0]["edge_solid_penetrations"],
            Json::array({{{"edge", {32, 42}},
                          {"segment", g.ids_of(c.main[0].nodes)},
                          {"side", 3},
                          {"penetration", 0.625}}}));
  EXPECT_EQ(said[0]["penetrations"][0]["stored"], 0.4375);
}

TEST(GapsDocument, HasSummaryPartPairsAndCrossings) {
  Gapped g;
  g.view.total = distinct_totals();
  PartPair p;
  p.secondary = 71;
  p.main = 72;
  p.count = {73, 74, 75};
  p.on_segment = {76, 77, 78};
  p.max_depth = 0.5;
  p.mean_depth = 0.25;
  p.p95_depth = 0.375;
  p.max_ratio = 0.125;
  g.view.part_pairs = {p};
  const auto n = [&](int id) { return g.b.model.nodes.map.find(id); };
  const std::vector<Crossing> crossings{{0, {n(11), n(12)}, ElementKind::truss, 0, 1},
                                        {2, {n(11), n(12)}, ElementKind::truss, 0, 0}};
  const Json all = g.json(false, &crossings);
  EXPECT_EQ(all["schema"], Json({{"id", "deck/gaps"}, {"version", 1}}));
  EXPECT_EQ(all["deck"]["path"], "a_0000.rad");
  EXPECT_EQ(all["summary"], totals_of(distinct_totals()));
  EXPECT_EQ(all["accuracy"]["mode"], "robust");
  EXPECT_EQ(all["examined"], 4);
  EXPECT_FALSE(all.contains("gate"));
  EXPECT_EQ(all["part_pairs"],
            Json::array({{{"secondary", 71},
                          {"main", 72},
                          {"pairs", 73},
                          {"nodes", 74},
                          {"edges", 75},
                          {"on_segment", {{"nodes", 77}, {"edges", 78}, {"pairs", 76}}},
                          {"max_depth", 0.5},
                          {"mean_depth", 0.25},
                          {"p95_depth", 0.375},
                          {"max_ratio", 0.125}}}));
  EXPECT_EQ(all["interfaces"][0]["contacts"][0]["crossings"],
            Json::array({{{"edge", {11, 12}},
                          {"segment", g.ids_of(g.contact(0).main[1].nodes)},
                          {"edge_element", 23},
                          {"segment_element", 22},
                          {"parts", {2, 1}}}}));
  EXPECT_EQ(all["interfaces"][1]["contacts"][0]["crossings"], Json::array());
  EXPECT_FALSE(g.json()["interfaces"][0]["contacts"][0].contains("crossings"));
}

TEST(GapsDocument, OfTiesHasEveryNodeThatIsNotSimplyTied) {
  Gapped g;
  Tie& tie = g.b.scene.ties.at(0);
  ASSERT_EQ(tie.nodes.size(), 3u);
  tie.nodes[0].message = 1073;
  tie.nodes[0].s = 0.25;
  tie.nodes[0].t = -0.5;
  tie.nodes[0].distance = 0.375;
  tie.nodes[0].search = 3.5;
  tie.nodes[0].penalty = true;
  tie.nodes[2].message = 0;
  tie.repeated = {{5, 6}};
  tie.main_and_tied = {g.b.model.nodes.map.find(3)};
  const auto row = [&](std::size_t i) {
    const TiedNode& n = tie.nodes[i];
    const bool found = n.segment != no_index;
    Json out = {{"node", g.b.model.node_id(n.node)},
                {"tied", n.tied},
                {"segment", found ? g.ids_of(tie.main[n.segment]) : Json()},
                {"s", found ? Json(n.s) : Json()},
                {"t", found ? Json(n.t) : Json()},
                {"distance", found ? Json(n.distance) : Json()},
                {"search", n.search != 0 ? n.search : tie.search_distance},
                {"message", n.message != 0 ? Json(n.message) : Json()},
                {"penalty", n.penalty},
                {"why", why_text(tie, n)}};
    if (!found && n.nearest != no_index)
      out["nearest"] = {{"segment", g.ids_of(tie.main[n.nearest])},
                        {"distance", n.nearest_distance}};
    return out;
  };
  ASSERT_TRUE(tie.nodes[0].tied);
  ASSERT_EQ(tie.nodes[1].segment, no_index);
  ASSERT_NE(tie.nodes[1].nearest, no_index);
  const Json said = g.json()["ties"].at(0);
  EXPECT_EQ(said, Json({{"id", 7},
                        {"type", 2},
                        {"title", tie.inter->title},
                        {"level", "stops"},
                        {"search_distance", 2.0},
                        {"not_evaluated", nullptr},
                        {"nodes", {row(0), row(1)}},
                        {"repeated", Json::array({{{"interface", 5}, {"nodes", 6}}})},
                        {"main_and_tied", Json::array({3})},
                        {"summary",
                         {{"nodes", 3},
                          {"tied", 2},
                          {"not_found", 1},
                          {"dropped", 0},
                          {"elsewhere", 0},
                          {"outside", 1}}}}));
  EXPECT_EQ(g.json(true)["ties"][0]["nodes"], Json({row(0), row(1), row(2)}));
  tie.search_distance = 0;
  tie.nodes[1].search = 0;
  tie.nodes[1].nearest = no_index;
  tie.not_evaluated = "a reason";
  const Json other = g.json()["ties"].at(0);
  EXPECT_EQ(other["search_distance"], Json());
  EXPECT_EQ(other["not_evaluated"], "a reason");
  EXPECT_EQ(other["nodes"][1]["search"], Json());
  EXPECT_FALSE(other["nodes"][1].contains("nearest"));
}

// ---- CSV ------------------------------------------------------------------------------------

std::vector<std::vector<std::string>> csv_lines(const std::string& text) {
  std::vector<std::vector<std::string>> out;
  for (std::size_t at = 0; at < text.size(); at = text.find("\r\n", at) + 2) {
    out.emplace_back(1);
    bool quoted = false;
    for (std::size_t i = at; i < text.find("\r\n", at); ++i) {
      if (text[i] == '"')
        quoted = !quoted;
      else if (text[i] == ',' && !quoted)
        out.back().emplace_back();
      else
        out.back().back() += text[i];
    }
  }
  return out;
}

using Fields = std::vector<std::string>;

TEST(GapsCsv, HasEveryFigureOfAPenetration) {
  Gapped g;
  PenetrationRow& r = g.contact(0).penetrations[0];
  r = {r.secondary, r.main, 0.25, 0.5, 0.125, {0.5, -0.25, 0.75}, true};
  r.action = PenetrationAction::gap_reduced;
  r.has_gap0 = true;
  r.gap0 = 0.375;
  r.p0 = 0.625;
  NamedPenetration named;
  named.contact = 0;
  named.row = 0;
  named.secondary = {9, 0};
  named.main = {1, 2, 3, 4};
  named.secondary_element = {ElementKind::truss, 0, 24, 2};
  named.main_element = {ElementKind::shell4, 0, 21, 1};
  named.at = {5, 6, 0.5};
  g.view.penetrations = {named};
  auto lines = csv_lines(gaps_csv(g.b.deck, g.b.scene, g.view));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].size(), 30u);
  const std::string line =
      std::to_string(g.node_line(g.b.model.node_id(g.contact(0).secondary[r.secondary].node)));
  EXPECT_EQ(lines[1], (Fields{"1",
                              "7",
                              "primary",
                              "node_segment",
                              "9",
                              "",
                              "1",
                              "2",
                              "3",
                              "4",
                              "0.25",
                              "0.5",
                              "0.125",
                              "0.5",
                              "0.5",
                              "-0.25",
                              "0.75",
                              "1",
                              "gap-reduced",
                              "0.375",
                              "0.625",
                              "5",
                              "6",
                              "0.5",
                              "24",
                              "2",
                              "21",
                              "1",
                              g.b.deck.sources[0].path(),
                              line}));
  r.has_gap0 = r.on_surface = false;
  r.gap = 0;
  g.view.penetrations[0].main = {1, 2, 0, 0};
  g.view.penetrations[0].secondary = {9, 61};
  g.view.penetrations[0].main_element = {};
  lines = csv_lines(gaps_csv(g.b.deck, g.b.scene, g.view));
  EXPECT_EQ((Fields{lines[1][5], lines[1][8], lines[1][9]}), (Fields{"61", "", ""}));
  EXPECT_EQ((Fields{lines[1][13], lines[1][17], lines[1][19], lines[1][20]}),
            (Fields{"0", "0", "", ""}));
  EXPECT_EQ((Fields{lines[1][26], lines[1][27]}), (Fields{"", ""}));
  r.gap = 0.75;  // below 1
  EXPECT_EQ(csv_lines(gaps_csv(g.b.deck, g.b.scene, g.view))[1][13], "0.3333333333333333");
}

TEST(TiesCsv, HasALinePerNode) {
  Gapped g;
  Tie& tie = g.b.scene.ties.at(0);
  TiedNode& n = tie.nodes[0];
  n.message = 1073;
  n.penalty = true;
  n.s = 0.25;
  n.t = -0.5;
  n.distance = 0.375;
  n.search = 3.5;
  n.nearest = no_index;
  TiedNode& lost = tie.nodes[1];
  lost.search = 0;
  lost.nearest_distance = 90;
  const auto lines = csv_lines(ties_csv(g.b.deck, g.b.scene));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0].size(), 21u);
  const Json corners = g.ids_of(tie.main[n.segment]), near = g.ids_of(tie.main[lost.nearest]);
  const auto line = [&](int id) { return std::to_string(g.node_line(id)); };
  const std::string file = g.b.deck.sources[0].path();
  EXPECT_EQ(lines[1], (Fields{"7",
                              "61",
                              "2",
                              "1",
                              "1",
                              "1073",
                              corners[0].dump(),
                              corners[1].dump(),
                              corners[2].dump(),
                              corners[3].dump(),
                              "0.25",
                              "-0.5",
                              "0.375",
                              "3.5",
                              "",
                              short_reason(tie, n),
                              "2",
                              "2",
                              "0.25",
                              file,
                              line(61)}));
  EXPECT_EQ(lines[2], (Fields{"7",
                              "62",
                              "",
                              "0",
                              "0",
                              lost.message == 0 ? "" : std::to_string(lost.message),
                              near[0].dump(),
                              near[1].dump(),
                              near[2].dump(),
                              near[3].dump(),
                              "",
                              "",
                              "",
                              "",
                              "90",
                              short_reason(tie, lost),
                              "2",
                              "3",
                              "90",
                              file,
                              line(62)}));
  lost.nearest = no_index;
  const auto none = csv_lines(ties_csv(g.b.deck, g.b.scene))[2];
  EXPECT_EQ((Fields{none[6], none[9], none[14]}), (Fields{"", "", ""}));
}

// ---- tables ---------------------------------------------------------------------------------

TEST(GapsTables, HaveARowPerInterface) {
  Gapped g;
  g.view.contacts[0] = distinct_totals();
  g.contact(0).candidates = 41;
  for (PenetrationRow& r : g.contact(0).penetrations) r.action = PenetrationAction::gap_reduced;
  g.contact(0).penetrations[1].action = PenetrationAction::none;
  const std::string text = gaps_text(g.b.deck, g.b.scene, g.view);
  // Listed is what penetrates and what is tied, 51 + 54.
  EXPECT_THAT(text,
              ContainsRegex("\n +1 +TYPE7 .* 1\\.5 +105 +52 +- +0\\.1875 +31 % +1 nothing, 1 gap "
                            "reduced\n"));
  EXPECT_THAT(text, ContainsRegex("\n +2 +TYPE11 .* 2\\.5 +1 +- +1 +"));
  EXPECT_THAT(text, ContainsRegex("\n +3 +TYPE25 .* - +"));
  GapsTextOptions options;
  options.verbose = true;
  const std::string all = gaps_text(g.b.deck, g.b.scene, g.view, options);
  EXPECT_THAT(all, ContainsRegex("\n +1 +TYPE7 +[a-z]+ +0 +1\\.5 +[a-z ]+ +2 +2 +41 +51 +52 +- "
                                 "+0\\.1875 +31 % "));
  EXPECT_THAT(all,
              ContainsRegex("\n +2 +TYPE11 +[a-z]+ +0 +2\\.5 +[a-z ]+ +1 +1 +[0-9]+ +1 +- +1 +"));
}

TEST(GapsTables, HaveARowPerPairOfPartsAndNamesOfParts) {
  Gapped g;
  PartPair p;
  p.secondary = 1;
  p.main = 0;
  p.count = {73, 74, 75};
  p.max_depth = 0.5123456;
  p.mean_depth = 0.2512345;
  p.p95_depth = 0.3756789;
  p.max_ratio = 0.125;
  PartPair unknown = p;
  unknown.main = 999;
  unknown.max_ratio = 0;
  g.view.part_pairs = {p, unknown, p};
  GapsTextOptions options;
  options.part_pairs = 2;
  const std::string text = gaps_text(g.b.deck, g.b.scene, g.view, options);
  EXPECT_THAT(text, ContainsRegex("\n +1 part +\\(no part\\) +73 +74 +75 +0\\.512346 +0\\.2512 "
                                  "+0\\.3757 +1[23] %\n"));
  EXPECT_THAT(text, ContainsRegex("\n +1 part +999 +73 +.* -\n"));
  EXPECT_THAT(text, HasSubstr("and 1 more\n"));
  options.part_pairs = 3;
  EXPECT_THAT(gaps_text(g.b.deck, g.b.scene, g.view, options), Not(HasSubstr("and 1 more\n")));
}

TEST(GapsTables, HaveTheDeepestRowsWithWhatHappensToThem) {
  Gapped g;
  Contact& c = g.contact(0);
  PenetrationRow& r = c.penetrations[0];
  r.action = PenetrationAction::gap_reduced;
  r.has_gap0 = true;
  r.gap0 = 0.4375;
  r.depth = 0.3125;
  r.gap = 1.375;
  r.distance = 1.0625;
  r.on_surface = false;
  NamedPenetration named;
  named.contact = 0;
  named.row = 0;
  named.secondary = {9, 0};
  named.main = {2, 5, 3, 0};
  named.secondary_element = {ElementKind::truss, 0, 24, 2};
  named.main_element = {ElementKind::shell3, 0, 22, 1};
  named.at = {5, 6, 0.5};
  NamedPenetration edge = named;
  edge.secondary = {11, 12};
  edge.main = {1, 2, 0, 0};
  g.view.penetrations = {named, edge};
  g.view.deepest_per_node = {0, 1};
  GapsTextOptions options;
  options.worst = 1;
  const auto text = [&] { return gaps_text(g.b.deck, g.b.scene, g.view, options); };
  const std::string where =
      g.b.deck.sources[0].path() + ":" +
      std::to_string(g.node_line(g.b.model.node_id(c.secondary[r.secondary].node)));
  EXPECT_THAT(text(),
              ContainsRegex("\n +1 +9 +0\\.3125 +1\\.375 +1\\.0625 +2 5 3 +24 / 22 +gap reduced to "
                            "0\\.4375 +\\(5, 6, 0\\.5\\) +" +
                            where));
  EXPECT_THAT(text(), HasSubstr("and 1 more (--worst N, --csv, --json)\n"));
  options.worst = 2;
  EXPECT_THAT(text(), ContainsRegex("\n +1 +11-12 +.* 1 2 +24 / 22"));
  EXPECT_THAT(text(), Not(HasSubstr("more (--worst")));
  options.width = 149;
  EXPECT_THAT(text(), Not(HasSubstr("24 / 22")));
  EXPECT_THAT(text(), Not(HasSubstr("position")));
  options.width = 150;
  EXPECT_THAT(text(), HasSubstr("24 / 22"));
  options.width = 100;
  options.verbose = true;
  EXPECT_THAT(text(), HasSubstr("position"));
  // On the surface only some options make the solver stop.
  options = {};
  c.inacti = 0;
  r.on_surface = true;
  const int error = on_surface_error(c);
  ASSERT_NE(error, 0);
  EXPECT_THAT(text(), HasSubstr("error " + std::to_string(error)));
  r.on_surface = false;
  EXPECT_THAT(text(), Not(HasSubstr("error " + std::to_string(error))));
  g.view.penetrations[0] = named;
  g.view.deepest_per_node.clear();
  EXPECT_THAT(text(), Not(HasSubstr("more (--worst")));
}

TEST(GapsTables, HaveCrossedElementsByParts) {
  const Gapped g;
  const auto n = [&](int id) { return g.b.model.nodes.map.find(id); };
  const std::vector<Crossing> crossings{{0, {n(11), n(12)}, ElementKind::truss, 0, 1},
                                        {0, {n(9), n(61)}, ElementKind::truss, 1, 0}};
  const std::string text = crossings_text(g.b.scene, crossings);
  EXPECT_TRUE(text.starts_with("\nCrossed elements: 2\n"));
  EXPECT_THAT(text, ContainsRegex("\n +2 +1 +2 +1 +11 12 +23 +2 5 3 +22\n"));
  EXPECT_THAT(crossings_text(g.b.scene, {crossings[1]}),
              ContainsRegex("\n +2 +1 +1 +1 +9 61 +24 +1 2 3 4 +21\n"));
  EXPECT_EQ(crossings_text(g.b.scene, {}),
            "\nNo edge of the secondary side passes through a main segment.\n");
}

TEST(GapsTables, HaveTiesAndTheirUntiedNodes) {
  Gapped g;
  Tie& tie = g.b.scene.ties.at(0);
  tie.nodes[0].distance = 0.375;
  tie.nodes[2].distance = 0.25;
  tie.nodes[1].nearest_distance = 91;
  GapsTextOptions options;
  const auto text = [&] { return gaps_text(g.b.deck, g.b.scene, g.view, options); };
  EXPECT_THAT(text(), ContainsRegex("\n +7 +TYPE2 +[a-z]+ +3 +2 +1 +2 +0\\.375 +1 not found"));
  EXPECT_THAT(text(),
              ContainsRegex("\n +7 +62 +- +[0-9 ]+ +91 +2 +.* " + g.b.deck.sources[0].path() + ":" +
                            std::to_string(g.node_line(62)) + ":1\n"));
  EXPECT_THAT(text(), HasSubstr("\nNodes that are not tied\n"));
  options.worst = 0;
  EXPECT_THAT(text(), HasSubstr("and 1 more (--worst N, --json)\n"));
  options.worst = 1;
  EXPECT_THAT(text(), Not(HasSubstr("more (--worst N, --json)")));
  tie.search_distance = 0;
  tie.nodes[1].search = 0;
  tie.nodes[1].nearest = no_index;
  EXPECT_THAT(text(), ContainsRegex("\n +7 +62 +- +- +- +- "));
  EXPECT_THAT(text(), ContainsRegex("\n +7 +TYPE2 +[a-z]+ +3 +2 +1 +by pair +"));
  tie.nodes[1] = tie.nodes[0];
  EXPECT_THAT(text(), HasSubstr("1 tie that holds: 7\n"));
  EXPECT_THAT(text(), Not(HasSubstr("Nodes that are not tied")));
  options.verbose = true;
  EXPECT_THAT(text(), ContainsRegex("\n +7 +TYPE2 +[a-z]+ +3 +3 +0 +by pair +0\\.375 +-\n"));
  options.verbose = false;
  tie.nodes.resize(1);
  EXPECT_THAT(text(), HasSubstr("1 tie that holds: 7\n"));
  tie.nodes.clear();
  EXPECT_THAT(text(), ContainsRegex("\n +7 +TYPE2 +[a-z]+ +0 +0 +0 +by pair +-"));
}

// ---- the gate -------------------------------------------------------------------------------

/// An earlier run of the two nodes of interface 1, one of which was deeper, and one that is gone.
EarlierGaps earlier_run(const Gapped& g) {
  EarlierGaps earlier;
  earlier.path = "earlier.json";
  earlier.deck_path = "earlier_0000.rad";
  for (const NamedPenetration& p : g.view.penetrations) {
    const Contact& c = g.b.scene.contacts[p.contact];
    if (c.inter->id == 1)
      earlier.rows.push_back({1, "primary", p.secondary,
                              c.penetrations[p.row].depth * (p.secondary[0] == 9 ? 2 : 0.5),
                              c.penetrations[p.row].gap, p.at});
  }
  earlier.rows.push_back({1, "primary", {500, 0}, 0.875, 1.5, std::array{900.0, 0.0, 0.0}});
  earlier.rows.push_back({2, "edges", {501, 502}, 0.9375, 1.5, std::array{950.0, 0.0, 0.0}});
  return earlier;
}

Json gate_members(const Gapped& g, const GateReport& gate) {
  std::string text;
  JsonWriter j(text);
  j.begin_object();
  write_gate(j, g.b.deck, g.b.scene, g.view, gate);
  j.end_object();
  return Json::parse(text);
}

TEST(GateDocument, ComparesWithAnEarlierRunRowByRow) {
  const Gapped g;
  const EarlierGaps earlier = earlier_run(g);
  const GateReport gate = gate_report({}, g.b.scene, g.view, nullptr, &earlier);
  EXPECT_FALSE(gate.asked);
  const Json said = gate_members(g, gate);
  EXPECT_EQ(said["gate"], Json());
  const Json& c = said["compared"];
  EXPECT_EQ(c["with"], "earlier.json");
  EXPECT_EQ(c["deck"], "earlier_0000.rad");
  EXPECT_EQ(c["worse"], 1);
  EXPECT_EQ(c["better"], 1);
  EXPECT_EQ(c["same"], 0);
  EXPECT_EQ(c["solved"], 2);
  EXPECT_EQ(c["new"], g.view.deepest_per_node.size() - 2);
  EXPECT_EQ(c["rows"].size(), g.view.deepest_per_node.size() + 2);
  const auto depth = [&](std::int64_t node) {
    const PenetrationRow* r = g.b.row(g.b.contact(1), node);
    return r == nullptr ? 0 : r->depth;
  };
  const auto has = [&](const Json& row) {
    EXPECT_EQ(std::count(c["rows"].begin(), c["rows"].end(), row), 1) << row << c["rows"];
  };
  has({{"change", "better"},
       {"interface", 1},
       {"role", "primary"},
       {"node", 9},
       {"depth", depth(9)},
       {"was", 2 * depth(9)}});
  has({{"change", "worse"},
       {"interface", 1},
       {"role", "primary"},
       {"node", 10},
       {"depth", depth(10)},
       {"was", 0.5 * depth(10)}});
  has({{"change", "new"},
       {"interface", 2},
       {"role", "primary"},
       {"edge", {11, 12}},
       {"depth", g.b.contact(2).penetrations[0].depth},
       {"was", nullptr}});
  has({{"change", "solved"},
       {"interface", 1},
       {"role", "primary"},
       {"node", 500},
       {"depth", nullptr},
       {"was", 0.875}});
  has({{"change", "solved"},
       {"interface", 2},
       {"role", "edges"},
       {"edge", {501, 502}},
       {"depth", nullptr},
       {"was", 0.9375}});
  const std::string text = gate_text(gate);
  EXPECT_EQ(text, "Penetrating nodes and edges against earlier.json: " +
                      std::to_string(g.view.deepest_per_node.size() - 2) +
                      " new, 1 worse, 1 better, 0 the same, 2 solved.\n");
}

TEST(GateDocument, WithoutAnythingAskedIsEmpty) {
  const Gapped g;
  const GateReport none = gate_report({}, g.b.scene, g.view, nullptr, nullptr);
  EXPECT_EQ(gate_members(g, none), Json({{"gate", nullptr}, {"compared", nullptr}}));
  EXPECT_EQ(gate_text(none), "");
  EXPECT_TRUE(none.findings.empty());
}

TEST(GateDocument, NamesWhatPassesOverTheBounds) {
  Gapped g;
  Gate bounds;
  bounds.general.max_depth = 0.125;
  g.contact(1).evaluated = false;
  const GateReport gate = gate_report(bounds, g.b.scene, g.view, nullptr, nullptr);
  ASSERT_FALSE(gate.findings.empty());
  EXPECT_EQ(gate.undecided, 1u);
  EXPECT_EQ(undecided_contacts(g.b.scene), 1u);
  EXPECT_FALSE(gate.passed());
  Json findings = Json::array();
  for (const Diagnostic& d : gate.findings) {
    const Position at = g.b.deck.sources.position(d.span);
    findings.push_back(
        {{"rule", std::string(id_text(d.rule))},
         {"severity", to_string(d.severity)},
         {"message", d.message},
         {"source",
          {{"file", g.b.deck.sources[0].path()}, {"line", at.line}, {"column", at.column}}},
         {"entity", d.keyword.empty() ? Json() : Json({{"keyword", d.keyword}, {"id", d.id}})}});
  }
  EXPECT_EQ(gate_members(g, gate),
            Json({{"gate", {{"passed", false}, {"undecided", 1}, {"findings", findings}}},
                  {"compared", nullptr}}));
  const std::size_t n = gate.findings.size();
  EXPECT_EQ(gate_text(gate),
            "Gate: not passed, " + std::to_string(n) + (n == 1 ? " finding.\n" : " findings.\n"));
  EXPECT_EQ(g.json(false, nullptr, &gate)["gate"]["undecided"], 1);
  bounds.general.max_depth = 1e9;
  g.contact(1).evaluated = true;
  const GateReport good = gate_report(bounds, g.b.scene, g.view, nullptr, nullptr);
  EXPECT_TRUE(good.passed());
  EXPECT_EQ(gate_text(good), "Gate: passed.\n");
}

TEST(GateDocument, OfTheVerbHasVerdictFindingsAndSummary) {
  const Gapped g;
  LintResult result;
  result.errors = 3;
  result.warnings = 4;
  result.infos = 5;
  result.baselined = 6;
  LintedDeck linted;
  linted.path = "a_0000.rad";
  linted.deck = &g.b.deck;
  linted.result = &result;
  linted.verdict.emplace();
  linted.verdict->level = VerdictLevel::crossed;
  linted.verdict->text = "said";
  linted.verdict->sentences = {{"crossings", "said", {{"crossed", 7}}}};
  linted.verdict->counts = {{"crossed", 7}, {"pairs", 0}};
  Diagnostic d;
  d.rule = all_rules()[0].id;
  d.severity = Severity::warning;
  d.message = "a message";
  const EarlierGaps earlier = earlier_run(g);
  GateReport gate = gate_report({}, g.b.scene, g.view, nullptr, &earlier);
  gate.undecided = 8;
  const std::string text = gate_json(linted, gate, {&d}, true);
  EXPECT_TRUE(text.ends_with("}\n\n"));
  Json all = Json::parse(text);
  EXPECT_EQ(all["schema"], Json({{"id", "deck/gate"}, {"version", 1}}));
  EXPECT_EQ(all["deck"]["path"], "a_0000.rad");
  for (const char* head : {"schema", "tool", "deck"}) all.erase(head);
  EXPECT_EQ(
      all, Json({{"verdict",
                  {{"level", "crossed"},
                   {"text", "said"},
                   {"sentences",
                    Json::array(
                        {{{"what", "crossings"}, {"text", "said"}, {"counts", {{"crossed", 7}}}}})},
                   {"counts", {{"crossed", 7}, {"pairs", 0}}}}},
                 {"passed", true},
                 {"undecided", 8},
                 {"findings", Json::array({{{"rule", std::string(id_text(d.rule))},
                                            {"severity", "warning"},
                                            {"message", "a message"},
                                            {"source", nullptr},
                                            {"entity", nullptr}}})},
                 {"compared",
                  {{"with", "earlier.json"},
                   {"deck", "earlier_0000.rad"},
                   {"new", g.view.deepest_per_node.size() - 2},
                   {"worse", 1},
                   {"better", 1},
                   {"same", 0},
                   {"solved", 2}}},
                 {"summary", {{"errors", 3}, {"warnings", 4}, {"infos", 5}, {"baselined", 6}}}}));
  gate.earlier = nullptr;
  EXPECT_EQ(Json::parse(gate_json(linted, gate, {}, false))["compared"], Json());
}

TEST(VerdictText, ColoursFollowTheLevel) {
  Verdict v;
  v.text = "said";
  const std::pair<VerdictLevel, Tone> tones[] = {{VerdictLevel::stops, Tone::red},
                                                 {VerdictLevel::penetrates, Tone::yellow},
                                                 {VerdictLevel::warnings, Tone::yellow},
                                                 {VerdictLevel::remarks, Tone::green},
                                                 {VerdictLevel::clean, Tone::green}};
  for (const auto& [level, tone] : tones) {
    v.level = level;
    EXPECT_EQ(verdict_text(v, true), toned("said", tone, true) + "\n");
    EXPECT_EQ(verdict_text(v, false), "said\n");
  }
}

}  // namespace
}  // namespace deck::test
