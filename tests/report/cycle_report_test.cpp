// `deck cycle` and `deck replay`: every figure of an outcome that is written out here, in JSON and
// in tables.
#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "contact/small_deck.hpp"
#include "cycle/shared/step_scale.hpp"
#include "report/shared/cycle.hpp"

namespace deck::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

/// Node 9 over a triangle and a quad in interface 1, two trusses over an edge in interface 2, and
/// interface 3, which has no pair.
SmallDeck three_interfaces() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(5, 20, 0, 0);
  d.node(9, 5, 5, 0.5).node(10, 5, 6, 900).node(11, 5, -5, 0.5).node(12, 5, 5, 0.5);
  d.shell_part(1, 2).shell(1, 21, 1, 2, 3, 4).shell3(1, 22, 2, 5, 3).truss_part(2, 1);
  d.bar("TRUSS", 2, 23, 11, 12).group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {9, 10});
  d.group("/GRNOD/NODE/3", {10}).segments("/LINE/SEG/3", {{11, 12}});
  d.segments("/LINE/SEG/4", {{1, 2}}).add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.5");
  d.add("@/INTER/TYPE11/2 line_IDs=3 line_IDm=4 Gapmin=2.5");
  return d.add("@/INTER/TYPE7/3 grnd_IDs=3 surf_IDm=1 Gapmin=1.5");
}

struct Evaluated {
  Evaluated() : b(three_interfaces()), view(make_view(b.scene)) {
    outcome.contacts.resize(3);
    for (std::size_t i = 0; i < 3; ++i) outcome.contacts[i].contact = &b.scene.contacts.at(i);
    input.path = "a_0000.rad";
    input.deck = &b.deck;
    input.scene = &b.scene;
    input.state = &state;
    input.outcome = &outcome;
    input.view = &view;
    input.options.dt1 = 0.25;
    input.options.dt12 = 0.125;
    input.options.time = 3.5;
    fill();
  }
  NodeIndex node(std::int64_t id) const { return b.model.nodes.map.find(id); }
  static cycle::PairOutcome pair(std::uint32_t secondary, std::uint32_t main, double first) {
    cycle::PairOutcome p;
    p.at = {secondary, main};
    p.weights = {first, first + 1, first + 2, first + 3};
    p.force = {first + 4, first + 5, first + 6};
    p.penetration = first + 7;
    p.gap = first + 8;
    p.distance = first + 9;
    p.k0 = first + 10;
    p.k_nodal = first + 11;
    return p;
  }
  void fill() {
    cycle::ContactOutcome& o = outcome.contacts[0];
    o.composition = "rules";
    o.effects = {{"friction", true, "Fric", "Fric = 0.2"}, {"heat", false, "", "Ithe = 0"}};
    o.pairs_in_reach = 31;
    o.pairs_with_force = 32;
    o.pairs_switched_off = 33;
    o.pairs_tied = 34;
    o.totals.normal = {0.5, 1.5, 2.5};
    o.totals.tangential = {3.5, 4.5, 5.5};
    o.totals.moment = {6.5, 7.5, 8.5};
    o.totals.total_abs = 9.5;
    o.totals.elastic_energy = 10.5;
    o.totals.friction_energy = 11.5;
    o.totals.damping_energy = 12.5;
    o.totals.friction_heat = 13.5;
    o.heat_secondary = 14.5;
    o.heat_main = 15.5;
    o.step.dt = 0.0625;
    o.step.source = cycle::StepLimit::Source::nodal;
    o.step_node = node(9);
    o.largest_force = 16.5;
    o.largest = pair(0, 0, 40);
    o.largest_acceleration = 17.5;
    o.acceleration_node = node(1);
    o.massless_nodes = 35;
    o.gap_closed = 36;
    o.near_singular_count = 37;
    o.near_singular = {pair(0, 1, 60)};
    o.removed = {{0, cycle::Removal::Because::nodal_step}};
    o.ties = {{{0, 1}, true}, {{1, 0}, false}};
    o.released = {{node(2), 7, 5}};
    o.criteria = {{node(3), 2.25, 3.25, 4.25}, {node(4), 5.25, 6.25, 1e30}};
    o.notes = {"a note"};
    o.pairs = {pair(0, 0, 80), pair(1, 1, 100)};
    cycle::ContactOutcome& e = outcome.contacts[1];
    e.active = false;
    e.complete = false;
    e.largest_force = 1;
    e.largest = pair(0, 0, 120);
    e.removed = {{0, cycle::Removal::Because::kinematic_step}};
    e.pairs = {pair(0, 0, 140)};
    e.step.source = cycle::StepLimit::Source::kinematic;
    outcome.contacts[2].step.source = cycle::StepLimit::Source::velocity;
    outcome.largest_nodal_force = 18.5;
    outcome.force_node = node(5);
    outcome.contact_dt = 0.0625;
    outcome.contact_dt_source = cycle::StepLimit::Source::nodal;
    outcome.limiting_contact = 0;
    outcome.limiting_node = node(9);
    outcome.structure = {0.03125, ElementKind::shell3, 0};
    outcome.nodes.resize(b.model.nodes.size());
    state.mass.assign(b.model.nodes.size(), 2);
    outcome.nodes.stiffness[node(9)] = 4;
    outcome.nodes.contact[node(9)] = 1;
    outcome.nodes.force[0][node(9)] = 1.25;
    outcome.nodes.force[1][node(9)] = -2.25;
    outcome.nodes.force[2][node(9)] = 3.25;
    state.not_evaluated = {"something", "something else"};
  }
  Json json(bool all = false) const { return Json::parse(cycle_json(input, all)); }
  std::string text(bool verbose = false, bool effects = false) const {
    CycleTextOptions options;
    options.verbose = verbose;
    options.effects = effects;
    return cycle_text(input, options);
  }
  Built b;
  SceneView view;
  cycle::State state;
  cycle::SceneOutcome outcome;
  CycleInput input;
};

Json pair_json(double first) {
  return {{"weights", {first, first + 1, first + 2, first + 3}},
          {"force", {first + 4, first + 5, first + 6}},
          {"penetration", first + 7},
          {"gap", first + 8},
          {"distance", first + 9},
          {"k0", first + 10},
          {"k_nodal", first + 11}};
}

/// With the nodes of a pair.
Json named(Json names, double first) {
  names.update(pair_json(first));
  return names;
}

const Json quad_9 = {{"node", 9}, {"segment", {1, 2, 3, 4}}};
const Json triangle_9 = {{"node", 9}, {"segment", {2, 5, 3, 3}}};
const Json triangle_10 = {{"node", 10}, {"segment", {2, 5, 3, 3}}};
const Json edge_11 = {{"edge", {11, 12}}, {"main_edge", {1, 2}}};

TEST(CycleJson, HasEveryFigureOfAContact) {
  const Evaluated e;
  const Json all = e.json(true);
  ASSERT_EQ(all["interfaces"].size(), 3u);
  const auto& secondary = e.b.scene.contacts[0].secondary;
  ASSERT_EQ(e.b.model.node_id(secondary[0].node), 9);
  const Json expected = {
      {"kind", "node_segment"},
      {"role", "primary"},
      {"active", true},
      {"complete", true},
      {"composition", "rules"},
      {"pairs_in_reach", 31},
      {"pairs_with_force", 32},
      {"pairs_switched_off", 33},
      {"sum",
       {{"normal", {0.5, 1.5, 2.5}},
        {"tangential", {3.5, 4.5, 5.5}},
        {"moment", {6.5, 7.5, 8.5}},
        {"sizes", 9.5}}},
      {"energy",
       {{"elastic", 10.5}, {"friction", 11.5}, {"damping", 12.5}, {"friction_heat", 13.5}}},
      {"heat", {{"secondary", 14.5}, {"main", 15.5}}},
      {"dt_contact", 0.0625},
      {"dt_because", "stiffness"},
      {"dt_node", 9},
      {"largest_pair", named(quad_9, 40)},
      {"acceleration", {{"max", 17.5}, {"node", 1}, {"massless_nodes", 35}}},
      {"near_singular",
       {{"count", 37}, {"gap_closed", 36}, {"worst", Json::array({named(triangle_9, 60)})}}},
      {"pairs_tied", 34},
      {"removed", Json::array({{{"node", 9}, {"because", "dtmin (stiffness against mass)"}}})},
      {"ties", Json::array({{{"node", 9}, {"segment", {2, 5, 3, 3}}, {"tied", true}},
                            {{"node", 10}, {"segment", {1, 2, 3, 4}}, {"tied", false}}})},
      {"released", Json::array({{{"node", 2}, {"before", 7}, {"after", 5}}})},
      {"criteria",
       Json::array({{{"node", 3}, {"radius", 2.25}, {"penetration", 3.25}, {"angle", 4.25}},
                    {{"node", 4}, {"radius", 5.25}, {"penetration", 6.25}, {"angle", nullptr}}})},
      {"notes", {"a note"}},
      {"cost", nullptr},
      {"pairs", {named(quad_9, 80), named(triangle_10, 100)}}};
  const Json& said = all["interfaces"][0]["contacts"];
  ASSERT_EQ(said.size(), 1u);
  for (const auto& [name, value] : expected.items()) EXPECT_EQ(said[0].at(name), value) << name;
  EXPECT_EQ(said[0].size(), expected.size());
  const Json without = e.json();
  EXPECT_FALSE(without["interfaces"][0]["contacts"][0].contains("pairs"));
  EXPECT_FALSE(without.contains("nodes"));
}

TEST(CycleJson, NamesEdgesAndLeavesOutWhatIsNot) {
  const Evaluated e;
  const Json all = e.json(true);
  const Json edges = all["interfaces"][1]["contacts"][0];
  EXPECT_EQ(edges["kind"], "edge_edge");
  EXPECT_EQ(edges["active"], false);
  EXPECT_EQ(edges["complete"], false);
  EXPECT_EQ(edges["largest_pair"], named(edge_11, 120));
  EXPECT_EQ(edges["pairs"], Json::array({named(edge_11, 140)}));
  EXPECT_EQ(edges["removed"],
            Json::array({{{"edge", {11, 12}}, {"because", "dtmin (time to the mid-surface)"}}}));
  EXPECT_EQ(edges["dt_because"], "kinematic");
  EXPECT_EQ(edges["dt_contact"], Json());
  EXPECT_EQ(edges["dt_node"], Json());
  const Json last = all["interfaces"][2]["contacts"][0];
  EXPECT_EQ(last["dt_because"], "velocity");
  EXPECT_EQ(last["largest_pair"], Json()) << "no pair has a force";
  EXPECT_EQ(last["acceleration"]["node"], Json());
}

TEST(CycleJson, HasTheFiguresOfTheDeck) {
  Evaluated e;
  const Json all = e.json(true);
  EXPECT_EQ(all["schema"], Json({{"id", "deck/cycle"}, {"version", 1}}));
  EXPECT_EQ(all["deck"]["path"], "a_0000.rad");
  EXPECT_EQ(all["verdict"]["text"], cycle_verdict(e.input).text);
  EXPECT_EQ(all["examined"], 3);
  EXPECT_EQ(all["dt1"], 0.25);
  EXPECT_EQ(all["dt12"], 0.125);
  EXPECT_EQ(all["time"], 3.5);
  EXPECT_EQ(all["model"], "robust");
  EXPECT_EQ(all["accuracy"]["mode"], "robust");
  EXPECT_EQ(all["nodal_force"], Json({{"max", 18.5}, {"node", 5}}));
  EXPECT_EQ(all["dt"], Json({{"structure", 0.03125},
                             {"contact", 0.0625},
                             {"because", "stiffness"},
                             {"limiting", {{"interface", 1}, {"node", 9}}},
                             {"structure_element", 22}}));
  EXPECT_EQ(all["steps"], Json());
  EXPECT_EQ(all["not_evaluated"], Json({"something", "something else"}));
  EXPECT_FALSE(all.contains("without"));
  // 0.9 sqrt(2 m / k) with mass 2 and stiffness 4.
  EXPECT_EQ(all["nodes"],
            Json::array(
                {{{"node", 9}, {"force", {1.25, -2.25, 3.25}}, {"stiffness", 4.0}, {"dt", 0.9}}}));
  const Json& inter = all["interfaces"][0];
  EXPECT_EQ(inter["id"], 1);
  EXPECT_EQ(inter["type"], 7);
  EXPECT_EQ(inter["title"], e.b.scene.interfaces->ordered[0]->title);
  const Position at = e.b.deck.sources.position(e.b.scene.interfaces->ordered[0]->span);
  EXPECT_EQ(inter["source"],
            Json({{"file", e.b.deck.sources[0].path()}, {"line", at.line}, {"column", at.column}}));
  ASSERT_EQ(inter["effects"].size(), 2u);
  EXPECT_EQ(inter["effects"][0]["name"], "friction");
  EXPECT_EQ(inter["effects"][0]["on"], true);
  EXPECT_EQ(inter["effects"][1],
            Json({{"name", "heat"}, {"on", false}, {"because", "Ithe = 0"}, {"source", nullptr}}));
  e.input.options.model = cycle::Model::reference;
  e.outcome.limiting_contact = SIZE_MAX;
  e.outcome.structure = {};
  const Json other = e.json();
  EXPECT_EQ(other["model"], "reference");
  EXPECT_EQ(other["dt"]["limiting"], Json());
  EXPECT_EQ(other["dt"]["structure"], Json());
  EXPECT_EQ(other["dt"]["structure_element"], Json());
}

TEST(CycleJson, OfAnEffectThatIsLeftOutHasEveryInterface) {
  Evaluated e;
  cycle::SceneOutcome without = e.outcome;
  without.contacts[0].totals.total_abs = 90.5;
  without.largest_nodal_force = 91.5;
  without.contact_dt = 1e30;
  without.contacts[0].step.dt = 0.5;
  e.input.without = &without;
  e.input.without_effect = "friction";
  const Json said = e.json()["without"];
  EXPECT_EQ(said["effect"], "friction");
  EXPECT_EQ(said["largest_nodal_force"], 91.5);
  EXPECT_EQ(said["contact_dt"], Json());
  ASSERT_EQ(said["interfaces"].size(), 3u);
  EXPECT_EQ(said["interfaces"][0], Json({{"id", 1},
                                         {"pairs_with_force", 32},
                                         {"force_sum", 90.5},
                                         {"elastic_energy", 10.5},
                                         {"friction_energy", 11.5},
                                         {"damping_energy", 12.5},
                                         {"contact_dt", 0.5}}));
}

/// Three steps with an event of each kind.
cycle::StepsOutcome steps_of(const Evaluated& e) {
  using Kind = cycle::StepEvent::Kind;
  cycle::StepsOutcome s;
  s.searches = 4;
  for (int k = 0; k < 3; ++k) {
    cycle::StepLine line;
    line.time = k + 0.5;
    line.dt1 = k + 0.25;
    line.contacts.resize(2);
    for (std::size_t c = 0; c < 2; ++c) {
      const double first = 100 * k + 50 * static_cast<double>(c);
      cycle::StepContact& at = line.contacts[c];
      at.active = c == 0;
      at.pairs_with_force = static_cast<std::size_t>(first) + 1;
      at.pairs_tied = static_cast<std::size_t>(first) + 2;
      at.removed = static_cast<std::size_t>(first) + 3;
      at.normal = {first + 4, first + 5, first + 6};
      at.tangential = {first + 7, first + 8, first + 9};
      at.force_sum = first + 10;
      at.elastic_energy = first + 11;
      at.friction_energy = first + 12;
      at.damping_energy = first + 13;
    }
    s.lines.push_back(line);
  }
  s.events = {{0, 0.5, 0, Kind::removed, {0, 0}, cycle::Removal::Because::no_element_left, {}},
              {1, 1.5, 0, Kind::tied, {0, 1}, {}, {}},
              {1, 1.5, 0, Kind::let_go, {1, 0}, {}, {}},
              {2, 2.5, 0, Kind::released, {}, {}, {e.node(3), 6, 0}},
              {2, 2.5, 1, Kind::removed, {0, 0}, cycle::Removal::Because::mid_surface, {}}};
  return s;
}

TEST(CycleJson, OfSeveralStepsHasTheirHistoryAndEvents) {
  Evaluated e;
  const cycle::StepsOutcome steps = steps_of(e);
  e.input.steps = &steps;
  const Json said = e.json()["steps"];
  EXPECT_EQ(said["count"], 3);
  EXPECT_EQ(said["motion"], "prescribed");
  EXPECT_EQ(said["searches"], 4);
  ASSERT_EQ(said["history"].size(), 3u);
  EXPECT_EQ(said["history"][1]["step"], 1);
  EXPECT_EQ(said["history"][1]["time"], 1.5);
  EXPECT_EQ(said["history"][1]["dt1"], 1.25);
  EXPECT_EQ(said["history"][1]["contacts"][1], Json({{"interface", 2},
                                                     {"role", "primary"},
                                                     {"active", false},
                                                     {"pairs_with_force", 151},
                                                     {"pairs_tied", 152},
                                                     {"removed", 153},
                                                     {"normal", {154.0, 155.0, 156.0}},
                                                     {"tangential", {157.0, 158.0, 159.0}},
                                                     {"sizes", 160.0},
                                                     {"elastic", 161.0},
                                                     {"friction", 162.0},
                                                     {"damping", 163.0}}));
  const auto event = [](int step, double time, int interface, const char* what, Json more) {
    Json out = {{"step", step},
                {"time", time},
                {"interface", interface},
                {"role", "primary"},
                {"event", what}};
    out.update(more);
    return out;
  };
  EXPECT_EQ(said["events"],
            Json({event(0, 0.5, 1, "removed", {{"node", 9}, {"because", "no element left (Idel)"}}),
                  event(1, 1.5, 1, "tied", {{"node", 9}, {"segment", {2, 5, 3, 3}}}),
                  event(1, 1.5, 1, "let-go", {{"node", 10}, {"segment", {1, 2, 3, 4}}}),
                  event(2, 2.5, 1, "released", {{"node", 3}, {"before", 6}, {"after", 0}}),
                  event(2, 2.5, 2, "removed",
                        {{"edge", {11, 12}}, {"because", "mid-surface reached"}})}));
}

// ---- text -----------------------------------------------------------------------------------

TEST(CycleText, HasARowPerInterfaceAndNamesThoseWithoutPairs) {
  Evaluated e;
  const std::string text = e.text();
  // Sum of energies 10.5 + 11.5 + 12.5.
  EXPECT_THAT(text, ContainsRegex("\n +1 +TYPE7 .* 32 +9\\.5 +34\\.5 +0\\.0625 +9 +36 at the "
                                  "mid-surface, 1 removed by dtmin, 34 tied, 35 without mass\n"));
  EXPECT_THAT(text, ContainsRegex("\n +2 +TYPE11 .* 0 +0 +0 +- +- +not active yet\n"));
  EXPECT_THAT(text, HasSubstr("1 interface without a pair in reach: 3"));
  EXPECT_THAT(text, Not(HasSubstr("\n   3  TYPE7")));
  const std::string all = e.text(true);
  EXPECT_THAT(all, ContainsRegex("\n +1 +TYPE7 .* 31 +32 +9\\.5 +16\\.5 +10\\.5 +11\\.5 +12\\.5 "
                                 "+17\\.5 +1 +0\\.0625 +9 +37 +36 at"));
  EXPECT_THAT(all, ContainsRegex("\n +3 +TYPE7 "));
  EXPECT_THAT(all, Not(HasSubstr("without a pair in reach")));
  e.outcome.contacts[1].active = true;
  EXPECT_THAT(e.text(), HasSubstr("too many pairs\n"));
  e.outcome.contacts[1].notes = {"a reason"};
  EXPECT_THAT(e.text(), HasSubstr("not evaluated\n"));
  e.b.scene.contacts[1].dropped = true;
  EXPECT_THAT(e.text(true), HasSubstr("no edges, dropped\n"));
}

TEST(CycleText, SaysWhatLasts) {
  Evaluated e;
  EXPECT_THAT(e.text(), HasSubstr("\nFrom now on\n"
                                  "  interface 1 TYPE7: removed for good, dtmin (stiffness against "
                                  "mass): node 9\n"
                                  "  interface 1 TYPE7: 1 pair is tied\n"
                                  "  interface 1 TYPE7: 1 pair lets go\n"
                                  "  interface 1 TYPE7: boundary conditions released (IBC) at node "
                                  "2: X, Y, Z -> X, Z\n"
                                  "  interface 2 TYPE11: removed for good, dtmin (time to the "
                                  "mid-surface): edge 11-12\n"));
  auto& o = e.outcome.contacts[0];
  o.removed.assign(12, o.removed[0]);
  o.released.assign(13, {e.node(2), 2, 0});
  o.ties.assign(2, o.ties[0]);
  const std::string text = e.text();
  EXPECT_THAT(text, HasSubstr("node 9 and 2 more\n"));
  EXPECT_THAT(text, HasSubstr("2 pairs are tied\n"));
  EXPECT_THAT(text, Not(HasSubstr("lets go")));
  EXPECT_THAT(text, HasSubstr("node 2: Y -> none and 3 more\n"));
  for (auto& c : e.outcome.contacts) {
    c.removed.clear();
    c.released.clear();
    c.ties.clear();
  }
  EXPECT_THAT(e.text(), Not(HasSubstr("From now on")));
}

TEST(CycleText, ListsCriteriaSharpestFirst) {
  Evaluated e;
  auto& list = e.outcome.contacts[0].criteria;
  std::swap(list[0], list[1]);
  const std::string text = e.text();
  const auto title = text.find("\nCriteria of adaptive meshing, sharpest first\n");
  ASSERT_NE(title, text.npos);
  const std::string table = text.substr(title, text.find("\n\n", title) - title);
  EXPECT_THAT(table, ContainsRegex("\n +1 +3 +2\\.25 +3\\.25 +4\\.25\n +1 +4 +5\\.25 +6\\.25 +-$"));
  list.assign(11, list[0]);
  const std::string many = e.text();
  std::size_t rows = 0;
  for (auto at = many.find("6.25"); at != many.npos; at = many.find("6.25", at + 1)) ++rows;
  EXPECT_EQ(rows, 10u);
  list.clear();
  EXPECT_THAT(e.text(), Not(HasSubstr("Criteria")));
}

TEST(CycleText, SaysWhatLimitsTheStep) {
  Evaluated e;
  char structure[120];
  std::snprintf(structure, sizeof structure,
                "  structure  %.4g, 3-node shell 22; times %g: 0.03125\n",
                0.03125 / cycle::step_scale, cycle::step_scale);
  EXPECT_THAT(e.text(), HasSubstr(std::string("\nTime step\n") + structure +
                                  "  contact    0.0625, contact stiffness against nodal mass, "
                                  "interface 1, node 9\n"));
  e.outcome.contact_dt_source = cycle::StepLimit::Source::kinematic;
  e.outcome.limiting_node = no_index;
  EXPECT_THAT(e.text(), HasSubstr("0.0625, half the time to the mid-surface, interface 1\n"));
  e.outcome.contact_dt_source = cycle::StepLimit::Source::velocity;
  e.outcome.limiting_contact = SIZE_MAX;
  EXPECT_THAT(e.text(), HasSubstr("0.0625, gap over the largest relative velocity\n"));
  e.outcome.structure = {};
  EXPECT_THAT(e.text(), HasSubstr("  structure  no element limits the step\n"));
  e.outcome.contact_dt = 1e30;
  EXPECT_THAT(e.text(), HasSubstr("  contact    no limit of those evaluated\n"));
  for (auto& c : e.outcome.contacts) c.complete = false;
  EXPECT_THAT(e.text(), HasSubstr("  contact    not evaluated\n"));
  for (auto& c : e.outcome.contacts) c.complete = true;
  EXPECT_THAT(e.text(), HasSubstr("  contact    no limit at this state\n"));
  const std::pair<ElementKind, const char*> names[] = {{ElementKind::shell4, "shell 21"},
                                                       {ElementKind::truss, "truss 23"}};
  for (const auto& [kind, name] : names) {
    e.outcome.structure = {0.5, kind, 0};
    EXPECT_THAT(e.text(), HasSubstr(std::string(", ") + name + "; times"));
  }
}

TEST(CycleText, HasHeatSingularPairsAndWhatWasLeftOut) {
  Evaluated e;
  const std::string text = e.text();
  EXPECT_THAT(text, HasSubstr("  interface 1 TYPE7: heat in this cycle 14.5 to the secondary side, "
                              "15.5 to the main side\n"));
  // Gap 68, penetration 67; force (64, 65, 66) is 112.6 long.
  EXPECT_THAT(text, ContainsRegex("\n +1\\.47 % +68 +69 +112\\.6 +71 +1 +9 +2 5 3\n"));
  EXPECT_THAT(text, HasSubstr("\nNot evaluated\n  something\n  something else\n"
                              "  interface 1 TYPE7: a note\n"));
  e.outcome.contacts[0].heat_secondary = e.outcome.contacts[0].heat_main = 0;
  EXPECT_THAT(e.text(), Not(HasSubstr("heat in this cycle")));
  // Nearest first, at most ten; edges by their nodes.
  auto near = Evaluated::pair(0, 0, 0);
  near.gap = 4;
  near.penetration = 3.99;
  e.outcome.contacts[1].near_singular = {near};
  e.outcome.contacts[0].near_singular.assign(11, Evaluated::pair(0, 1, 60));
  const std::string many = e.text();
  EXPECT_THAT(many, ContainsRegex("\n +0\\.25 % +4 +9 .* 2 +11-12 +1 2\n +1\\.47 %"));
  std::size_t rows = 0;
  for (auto at = many.find("1.47 %"); at != many.npos; at = many.find("1.47 %", at + 1)) ++rows;
  EXPECT_EQ(rows, 9u);
}

TEST(CycleText, OfStepsHasTheirSumsAndEvents) {
  Evaluated e;
  cycle::StepsOutcome steps = steps_of(e);
  e.input.steps = &steps;
  const std::string text = e.text();
  EXPECT_THAT(text, Not(HasSubstr("From now on")));
  // Sums over both contacts of step 1: 101 + 151 pairs, 110 + 160, 111 + 161, 102 + 152, 103 + 153.
  EXPECT_THAT(text, ContainsRegex("\n +1 +1\\.5 +252 +270 +272 +254 +256\n"));
  EXPECT_THAT(text, HasSubstr("  step 0 (0.5): interface 1 TYPE7: node 9 removed, no element left "
                              "(Idel)\n"
                              "  step 1 (1.5): interface 1 TYPE7: node 9 tied to 2 5 3\n"
                              "  step 1 (1.5): interface 1 TYPE7: node 10 lets go of 1 2 3 4\n"
                              "  step 2 (2.5): interface 1 TYPE7: node 3 fixed in X, Y -> none\n"
                              "  step 2 (2.5): interface 2 TYPE11: edge 11-12 removed, mid-surface "
                              "reached\n"));
  EXPECT_THAT(text, Not(HasSubstr("more (--json has all)")));
  // At most 20 rows, evenly taken, the first and the last among them.
  steps.lines.assign(58, steps.lines[0]);
  for (std::size_t k = 0; k < 58; ++k) steps.lines[k].time = static_cast<double>(k);
  steps.events.assign(23, steps.events[1]);
  const std::string many = e.text();
  EXPECT_THAT(many, HasSubstr("  and 3 more (--json has all)\n"));
  const auto table = many.substr(many.find("\nSteps\n"));
  for (std::size_t k = 0; k < 58; ++k) {
    const std::string row = "\n" + std::string(k < 10 ? 5 : 4, ' ') + std::to_string(k) + " ";
    EXPECT_EQ(table.find(row) != table.npos, k % 3 == 0) << k << table;
  }
  steps.lines.resize(1);
  EXPECT_THAT(e.text(), ContainsRegex("\n +0 +0 +52 +"));
}

TEST(CycleText, NamesTheDeckOfSeveralAndEndsWithTheVerdict) {
  Evaluated e;
  const std::string verdict = cycle_verdict(e.input).text + "\n";
  EXPECT_TRUE(e.text().ends_with("\n\n" + verdict)) << e.text();
  EXPECT_TRUE(e.text().starts_with("Interfaces\n"));
  CycleTextOptions options;
  options.several = true;
  EXPECT_TRUE(cycle_text(e.input, options).starts_with("a_0000.rad\n\nInterfaces\n"));
  e.b.scene.contacts.clear();
  e.outcome.contacts.clear();
  e.view = make_view(e.b.scene);
  EXPECT_EQ(e.text(), cycle_verdict(e.input).text + "\n");
}

TEST(CycleText, ShowsEffectsAcrossInterfaces) {
  Evaluated e;
  e.outcome.contacts[1].effects = {{"friction", false, "Fric", "Fric = 0"},
                                   {"damping", true, "", "always"}};
  e.outcome.contacts[2].effects = {{"friction", false, "Fric", "Fric = 0"}};
  const std::string brief = e.text();
  EXPECT_THAT(brief, HasSubstr("\n  1 TYPE7 on: friction: Fric = 0.2"));
  EXPECT_THAT(brief, HasSubstr("\n  2 TYPE11 on: damping\n"));
  EXPECT_THAT(brief, HasSubstr("\n  (--effects shows what is off, and why)\n"));
  const std::string text = e.text(false, true);
  EXPECT_THAT(text, ContainsRegex("\n +effect +1 TYPE7 +2 TYPE11 +3 TYPE7\n"));
  EXPECT_THAT(text, ContainsRegex("\n +friction +Fric = 0\\.2 +- +-\n"));
  EXPECT_THAT(text, ContainsRegex("\n +damping +on\n"));
  EXPECT_THAT(text, Not(ContainsRegex("\n +heat +-")));
  EXPECT_THAT(text, HasSubstr("\nEffects that do not run, and why (interfaces)\n"
                              "  friction: Fric = 0 (2, 3)\n  heat: Ithe = 0 (1)\n"));
  EXPECT_THAT(text, Not(HasSubstr("Fields and lines")));
  EXPECT_THAT(e.text(true, true), HasSubstr("\nFields and lines\n  1 TYPE7 on: friction"));
}

TEST(CycleText, ComparesWithWhatIsWithoutAnEffect) {
  Evaluated e;
  cycle::SceneOutcome without = e.outcome;
  without.contacts[0].totals.total_abs = 19;
  without.contacts[0].totals.friction_energy = 0;
  without.contacts[0].step.dt = 1e30;
  without.contacts[0].largest_acceleration = 1;
  without.largest_nodal_force = 37;
  without.contact_dt = 0.03125;
  e.input.without = &without;
  e.input.without_effect = "friction";
  const std::string text = e.text();
  EXPECT_THAT(text, HasSubstr("\nWith and without friction\n"));
  EXPECT_THAT(text, ContainsRegex("\n +1 +TYPE7 +with +9\\.5 +34\\.5 +0\\.0625 +17\\.5\n +without "
                                  "+19 +23 +- +1\n"));
  EXPECT_THAT(text, HasSubstr("2 interfaces have the same force, energy and step: 2, 3"));
  // Twice the force, half the step.
  EXPECT_THAT(text, HasSubstr("  largest nodal force 18.5, without 37 (+1e+02 %)\n"
                              "  time step of contact 0.0625, without 0.03125 (-50 %)\n"));
  EXPECT_THAT(text, Not(HasSubstr("--velocity")));
  without = e.outcome;
  EXPECT_THAT(e.text(), HasSubstr("18.5, without 18.5 (same)\n"));
  EXPECT_THAT(e.text(), Not(HasSubstr("--velocity"))) << "friction was asked about with a step";
  e.input.options.dt12 = 0;
  EXPECT_THAT(e.text(), HasSubstr("  (what slides or rubs shows with --dt and --velocity)\n"));
  e.outcome.largest_nodal_force = 0;
  e.outcome.contact_dt = without.contact_dt = 1e30;
  EXPECT_THAT(e.text(), HasSubstr("nodal force 0, without 18.5 (new)\n"));
  EXPECT_THAT(e.text(), Not(HasSubstr("time step of contact")));
}

// ---- effects --------------------------------------------------------------------------------

TEST(CycleEffects, AreOnWhereAnyPartOfTheInterfaceHasThem) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4).group("/SURF/PART/1", {1});
  d.add("@/INTER/TYPE19/5 surf_IDs=1 surf_IDm=1 Gapmin=1 Fric=0.3");
  const Built b(d);
  cycle::SceneOutcome o;
  for (const Contact& c : b.scene.contacts) {
    cycle::ContactOutcome& out = o.contacts.emplace_back();
    out.contact = &c;
    const bool edges = c.role == ContactRole::edges;
    out.effects = {{"friction-law", !edges, "Fric", edges ? "only nodes" : "Fric = 0.3"},
                   {"other", !edges, "", edges ? "only nodes" : "always"},
                   {"edges", edges, "", edges ? "always" : "only edges"}};
  }
  ASSERT_GE(o.contacts.size(), 2u);
  const InterBase& inter = *b.scene.interfaces->ordered[0];
  const std::vector<EffectLine> lines = effect_lines(b.deck, o, inter);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].name, "friction-law");
  EXPECT_TRUE(lines[0].on);
  const auto place = cycle::field_place(inter, "Fric");
  ASSERT_TRUE(place.has_value());
  const auto line = std::to_string(b.deck.sources.position(place->span).line);
  EXPECT_EQ(lines[0].because, "Fric = 0.3 (line " + line + "); not between edges: only nodes");
  EXPECT_EQ(lines[0].not_edges, "only nodes");
  EXPECT_EQ(lines[0].field, "Fric");
  EXPECT_TRUE(lines[0].span.valid());
  EXPECT_TRUE(lines[1].on);
  EXPECT_EQ(lines[1].because, "always") << "the card does not ask for it as a whole";
  EXPECT_EQ(lines[1].not_edges, "");
  EXPECT_TRUE(lines[2].on);
  EXPECT_EQ(lines[2].because, "always");
  EXPECT_FALSE(lines[2].span.valid());
}

TEST(CycleEffects, SayWhetherTheFieldIsADefault) {
  const auto because = [](const std::string& before, const char* card, const char* field) {
    SmallDeck d;
    d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(9, 3, 3, 0.5);
    d.shell_part(1, 2).shell3(1, 1, 1, 2, 3).group("/SURF/PART/1", {1});
    d.group("/GRNOD/NODE/2", {9});
    if (!before.empty()) d.add(before);
    const Built b(d.add(card));
    cycle::SceneOutcome o;
    o.contacts.resize(1);
    o.contacts[0].contact = &b.scene.contacts.at(0);
    o.contacts[0].effects = {{"x", true, field, "reason"}};
    return effect_lines(b.deck, o, *b.scene.interfaces->ordered[0]).at(0).because;
  };
  EXPECT_THAT(because("", "@/INTER/TYPE7/1 Gapmin=1 Fric=0.3", "Fric"),
              ::testing::MatchesRegex("reason \\(line [0-9]+\\)"));
  EXPECT_THAT(because("", "@/INTER/TYPE7/1 Gapmin=1 Inacti=1000", "Idel"), HasSubstr("default)"));
  EXPECT_THAT(because("@/DEFAULT/INTER/TYPE7 Idel=2", "@/INTER/TYPE7/1 Gapmin=1", "Idel"),
              HasSubstr(", /DEFAULT/INTER)"));
  EXPECT_EQ(because("", "@/INTER/TYPE7/1 Gapmin=1", "no such field"), "reason");
}

// ---- replay ---------------------------------------------------------------------------------

struct Replayed {
  Replayed() : b(three_interfaces()) {
    input.path = "a_0000.rad";
    input.states = "states.csv";
    input.deck = &b.deck;
    input.inter = b.scene.interfaces->ordered[1];
    input.model = cycle::Model::robust;
    r.kind = "edge_edge";
    r.records = 100;
    r.compared = 41;
    r.acting = 30;
    r.median = 1.5;
    r.p99 = 2.5;
    r.max = 3.5;
    r.zero_rows = 44;
    r.zero_max_over_k0_gap = 4.5;
    r.columns = {{"F", 45, 46, 5.5, 6.5, 7.5, 8.5}};
    for (std::size_t i = 0; i < 4; ++i)
      r.worst.push_back({50 + i, 9.5, {1.25, -2, 3}, {4, 5, static_cast<double>(i)}});
  }
  Built b;
  ReplayInput input;
  cycle::ReplayReport r;
};

TEST(ReplayJson, HasEveryFigure) {
  const Replayed p;
  Json all = Json::parse(replay_json(p.input, p.r));
  EXPECT_EQ(all["schema"], Json({{"id", "deck/replay"}, {"version", 1}}));
  EXPECT_EQ(all["deck"]["path"], "a_0000.rad");
  for (const char* head : {"schema", "tool", "deck"}) all.erase(head);
  Json worst = Json::array();
  for (int i = 0; i < 4; ++i)
    worst.push_back({{"row", 50 + i},
                     {"relative_error", 9.5},
                     {"reference", {1.25, -2.0, 3.0}},
                     {"computed", {4.0, 5.0, static_cast<double>(i)}}});
  EXPECT_EQ(all, Json({{"states", "states.csv"},
                       {"interface", 2},
                       {"type", 11},
                       {"kind", "edge_edge"},
                       {"model", "robust"},
                       {"records", 100},
                       {"compared", 41},
                       {"relative_error", {{"median", 1.5}, {"p99", 2.5}, {"max", 3.5}}},
                       {"zero_rows", {{"count", 44}, {"max_over_k0_gap", 4.5}}},
                       {"acting", 30},
                       {"columns", Json::array({{{"name", "F"},
                                                 {"rows", 45},
                                                 {"acting", 46},
                                                 {"median", 5.5},
                                                 {"p99", 6.5},
                                                 {"max", 7.5},
                                                 {"zero_max", 8.5}}})},
                       {"worst", worst}}));
}

TEST(ReplayText, HasTheErrorsAndTheThreeWorstRows) {
  Replayed p;
  EXPECT_EQ(replay_text(p.input, p.r),
            "states.csv: 100 states (edge_edge) of interface 2, 41 compared, model robust\n"
            "  relative error of the pair force: median 1.5e+00, 99 % 2.5e+00, worst 3.5e+00\n"
            "  44 states without force: at most 4.5e+00 of K0 gap\n"
            "  F            median 5.5e+00, worst 7.5e+00, where zero 8.5e+00\n"
            "  row 50: recorded (1.25 -2 3), computed (4 5 0), relative 9.5e+00\n"
            "  row 51: recorded (1.25 -2 3), computed (4 5 1), relative 9.5e+00\n"
            "  row 52: recorded (1.25 -2 3), computed (4 5 2), relative 9.5e+00\n");
  // Less than three in ten act.
  p.r.acting = 29;
  EXPECT_THAT(replay_text(p.input, p.r),
              HasSubstr("  only 29 of 100 states record any action: this proves little\n"));
  p.r.kind = "heat_edges";
  p.r.zero_rows = 1;
  p.input.model = cycle::Model::reference;
  const std::string heat = replay_text(p.input, p.r);
  EXPECT_THAT(heat, HasSubstr("model reference\n  relative error of the heat:"));
  EXPECT_THAT(heat, HasSubstr("  1 states without heat: at most 4.5e+00 of the largest heat\n"));
  p.r.zero_rows = 0;
  EXPECT_THAT(replay_text(p.input, p.r), Not(HasSubstr("states without")));
}

}  // namespace
}  // namespace deck::test
