// Which bound holds for which pair, and what is said where it is passed: of scenes that are written
// down here.
#include <gtest/gtest.h>

#include "contact/small_deck.hpp"
#include "lint/shared/config.hpp"
#include "lint/shared/gate.hpp"

namespace deck::test {
namespace {

using Lines = std::vector<std::string>;

/// Two interfaces ("rail/left" 1, "floor" 2) and a tie (3) over parts 1, 2 ("post") and 3; rows are
/// put in as they should be seen.
struct Gated {
  Gated() : d(text()) {
    scene.model = &d.model;
    scene.interfaces = &d.interfaces;
    scene.contacts.resize(2);
    for (std::size_t i = 0; i < 2; ++i) scene.contacts[i].inter = d.interfaces.ordered[i];
  }
  static std::string text() {
    SmallDeck small;
    for (int i = 1; i <= 12; ++i) small.node(i, i, i % 2, 0);
    small.shell_part(1, 1.0).shell_part(2, 1.0).shell_part(3, 1.0);
    small.shell(1, 1, 1, 2, 3, 4).shell(2, 2, 5, 6, 7, 8).shell(3, 3, 9, 10, 11, 12);
    small.group("/SURF/PART/1", {1}).group("/GRNOD/PART/2", {2});
    small.add(
        "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1\n@/INTER/TYPE11/2\n"
        "@/INTER/TYPE2/3 grnd_IDs=2 surf_IDm=1");
    std::string out = small.text();
    const auto title = [&](const std::string& header, const std::string& name) {
      const auto begin = out.find('\n', out.find(header)) + 1;
      out.replace(begin, out.find('\n', begin) - begin, name);
    };
    title("/INTER/TYPE7/1", "rail/left");
    title("/INTER/TYPE11/2", "floor");
    title("/PART/2", "post");
    return out;
  }
  /// A pair of contact `contact`, deepest first; `second` is 0 of nodes.
  Gated& pair(std::uint32_t contact, double depth, double gap, std::int64_t first,
              std::int64_t second = 0, std::int64_t part = 2, std::int64_t other = 1) {
    PenetrationRow row;
    row.depth = depth;
    row.gap = gap;
    NamedPenetration p;
    p.contact = contact;
    p.row = static_cast<std::uint32_t>(scene.contacts[contact].penetrations.size());
    p.secondary = {first, second};
    p.secondary_element.part = part;
    p.main_element.part = other;
    scene.contacts[contact].penetrations.push_back(row);
    view.deepest_per_node.push_back(static_cast<std::uint32_t>(view.penetrations.size()));
    view.penetrations.push_back(p);
    return *this;
  }
  Lines lines(const EarlierGaps* earlier = nullptr) const {
    Lines out;
    for (const Diagnostic& f : check_gate(gate, scene, view, nullptr, earlier)) {
      std::string line = std::string(id_text(f.rule)) + " " + f.message;
      for (const auto& [span, note] : f.notes) line += " | " + note;
      out.push_back(line);
    }
    return out;
  }
  Built d;
  Scene scene;
  SceneView view;
  Gate gate;
};

TEST(GateBounds, OfDepthAndRatioArePassedAboveAndNotAtThem) {
  Gated g;
  g.pair(0, 0.5, 2, 5).pair(0, 0.25, 0.5, 6).pair(1, 0.25, 1, 5, 6).pair(1, 0.125, 0, 7, 8);
  g.gate.general.max_depth = 0.25;
  EXPECT_EQ(
      g.lines(),
      (Lines{"DK370 /INTER/TYPE7 1: 1 node deeper than the 0.25 that the gate allows; deepest "
             "node 5 by 0.5 (gap 2) | node 5 is 0.5 deep"}));
  g.gate.general.max_depth = 0.2;
  EXPECT_EQ(
      g.lines(),
      (Lines{"DK370 /INTER/TYPE7 1: 2 nodes deeper than the 0.2 that the gate allows; deepest "
             "node 5 by 0.5 (gap 2) | node 5 is 0.5 deep",
             "DK370 /INTER/TYPE11 2: 1 edge deeper than the 0.2 that the gate allows; deepest "
             "edge 5-6 by 0.25 (gap 1) | edge 5-6 is 0.25 deep"}));
  g.gate.general.max_depth.reset();
  g.gate.general.max_ratio = 0.25;
  EXPECT_EQ(g.lines(),
            (Lines{"DK371 /INTER/TYPE7 1: 1 node deeper than the 0.25 of the gap that the gate "
                   "allows; deepest node 6 by 0.25 (gap 0.5) | node 6 is 0.25 deep"}))
      << "a pair without a gap has no share of it";
}

TEST(GateBounds, OfCountsAreOfItemsAndNotOfPairs) {
  Gated g;
  g.pair(0, 0.5, 2, 5).pair(0, 0.25, 2, 5).pair(0, 0.2, 2, 6).pair(1, 0.1, 1, 5, 6);
  g.gate.general.max_count = 3;
  EXPECT_EQ(g.lines(), Lines{});
  g.gate.general.max_count = 2;
  EXPECT_EQ(g.lines(), (Lines{"DK372 the deck: 2 nodes and 1 edge penetrate, the gate allows 2 | "
                              "node 5 is 0.5 deep"}));
  g.gate.general.max_count.reset();
  g.gate.interfaces = {{{"1"}, {}}, {{"floor"}, {}}};
  g.gate.interfaces[0].limits.max_count = 1;
  g.gate.interfaces[1].limits.max_count = 0;
  EXPECT_EQ(
      g.lines(),
      (Lines{"DK372 /INTER/TYPE7 1: 2 nodes penetrate, the gate allows 1 | node 5 is 0.5 deep",
             "DK372 /INTER/TYPE11 2: 1 edge penetrates, the gate allows 0 | edge 5-6 is 0.1 "
             "deep"}));
  g.gate.interfaces[0].limits.max_count = 2;
  g.gate.interfaces[1].limits.max_count = 1;
  EXPECT_EQ(g.lines(), Lines{});
}

TEST(GateBounds, OfTheLastInterfaceThatMatchesHold) {
  Gated g;
  g.pair(0, 0.5, 2, 5);
  const auto bound = [&](const std::string& pattern, double depth) {
    GateScope s;
    s.match = {pattern};
    s.limits.max_depth = depth;
    return s;
  };
  g.gate.general.max_depth = 9;
  const auto fires = [&](std::vector<GateScope> scopes) {
    g.gate.interfaces = std::move(scopes);
    return !g.lines().empty();
  };
  EXPECT_FALSE(fires({}));
  EXPECT_TRUE(fires({bound("1", 0.1)}));
  EXPECT_TRUE(fires({bound("rail*", 0.1)}));
  EXPECT_TRUE(fires({bound("rail/l?ft", 0.1)})) << "a slash is a letter like any other";
  EXPECT_TRUE(fires({bound("*left", 0.1)}));
  EXPECT_FALSE(fires({bound("left", 0.1)})) << "not the end of a path";
  EXPECT_FALSE(fires({bound("floor", 0.1)}));
  EXPECT_FALSE(fires({bound("1", 0.1), bound("rail*", 5)}));
  EXPECT_TRUE(fires({bound("1", 5), bound("rail*", 0.1)}));
  // What a scope does not bound stays as it is in general, but for counts.
  GateScope empty;
  empty.match = {"1"};
  g.gate.general.max_depth = 0.25;
  EXPECT_TRUE(fires({empty}));
}

TEST(GateBounds, OfPartsComeBeforeThoseOfInterfacesEitherWayRound) {
  Gated g;
  g.pair(0, 0.5, 2, 5, 0, 2, 1).pair(0, 0.4, 2, 6, 0, 1, 2).pair(0, 0.3, 2, 7, 0, 3, 1);
  g.pair(0, 0.2, 2, 8, 0, 0, 1);
  g.gate.part_pairs = {{{"1", "post"}, {}}};
  GateLimits& l = g.gate.part_pairs[0].limits;
  l.max_count = 1;
  EXPECT_EQ(g.lines(), (Lines{"DK372 parts '1' and 'post': 2 nodes penetrate, the gate allows 1 | "
                              "node 5 is 0.5 deep"}));
  l.max_count = 2;
  EXPECT_EQ(g.lines(), Lines{});
  g.gate.general.max_depth = 0.25;
  l.max_depth = 0.45;
  EXPECT_EQ(
      g.lines(),
      (Lines{"DK370 /INTER/TYPE7 1: 1 node deeper than the 0.25 that the gate allows; deepest "
             "node 7 by 0.3 (gap 2) | node 7 is 0.3 deep",
             "DK370 /INTER/TYPE7 1: 1 node deeper than the 0.45 that the gate allows; deepest "
             "node 5 by 0.5 (gap 2) | node 5 is 0.5 deep"}));
  // The last pair of patterns that fits holds; the others do not see the pair.
  g.gate.part_pairs.push_back({{"post", "*"}, {}});
  g.gate.part_pairs[1].limits.max_depth = 1;
  EXPECT_EQ(g.lines().size(), 1u);
  g.gate.part_pairs[1].match = {"3", "1"};
  EXPECT_EQ(g.lines().size(), 1u) << "the third pair is within its own bound now";
}

TEST(GateBounds, OfTiesCountNodesThatAreLost) {
  Gated g;
  Tie tie;
  tie.inter = &g.d.interfaces.type2.front();
  for (const std::int64_t id : {5, 6, 7, 8}) {
    TiedNode n;
    n.node = g.d.model.find_node(id);
    n.tied = id == 5;
    n.removed_by = id == 6 ? 1630 : 0;
    tie.nodes.push_back(n);
  }
  g.scene.ties = {tie, tie};
  g.gate.general.max_untied = 2;
  EXPECT_EQ(g.lines(), Lines{}) << "two nodes, each once";
  g.gate.general.max_untied = 1;
  EXPECT_EQ(g.lines(), (Lines{"DK376 the deck: 2 nodes are not tied, the gate allows 1 | node 7"}));
  g.gate.general.max_untied.reset();
  g.gate.interfaces = {{{"3"}, {}}};
  g.gate.interfaces[0].limits.max_untied = 2;
  EXPECT_EQ(g.lines(), Lines{});
  g.gate.interfaces[0].limits.max_untied = 1;
  const std::string one = "DK376 /INTER/TYPE2 3: 2 nodes are not tied, the gate allows 1 | node 7";
  EXPECT_EQ(g.lines(), (Lines{one, one}));
  g.scene.ties.resize(1);
  g.scene.ties[0].nodes.resize(3);
  g.gate.interfaces[0].limits.max_untied = 0;
  EXPECT_EQ(g.lines(),
            (Lines{"DK376 /INTER/TYPE2 3: 1 node is not tied, the gate allows 0 | node 7"}));
}

TEST(GateBounds, OfTimeStepsAreSharesOfTheMeshsStep) {
  Gated g;
  g.gate.general.max_dt_loss = 0.25;
  cycle::SceneOutcome forces;
  forces.contacts.resize(2);
  const auto found = [&](double contact, double structure) {
    for (std::size_t i = 0; i < 2; ++i) forces.contacts[i].contact = &g.scene.contacts[i];
    forces.contacts[0].step.dt = contact;
    forces.structure.dt = structure;
    Lines out;
    for (const Diagnostic& d : check_gate(g.gate, g.scene, g.view, &forces, nullptr))
      out.push_back(std::string(id_text(d.rule)) + " " + d.message);
    return out;
  };
  EXPECT_EQ(found(0.75, 1), Lines{}) << "a loss of 0.25 is allowed";
  EXPECT_EQ(found(0.5, 1), (Lines{"DK373 /INTER/TYPE7 1: time step 0.5, the mesh allows 1: a loss "
                                  "of 0.5, the gate allows 0.25"}));
  EXPECT_EQ(found(0.5, 1e30), Lines{}) << "nothing of the mesh limits the step";
  EXPECT_EQ(found(2, 1), Lines{});
  g.gate.general.max_dt_loss.reset();
  EXPECT_EQ(found(0.5, 1), Lines{});
}

TEST(GateTrends, NewAndWorsePairsAreNamedWhereTheyAreAskedFor) {
  Gated g;
  g.pair(0, 0.5, 2, 5).pair(0, 0.4, 2, 6).pair(0, 0.3, 2, 7).pair(1, 0.2, 2, 8, 9);
  EarlierGaps earlier;
  earlier.path = "old.json";
  const auto was = [&](std::int64_t interface, std::array<std::int64_t, 2> item, double depth) {
    EarlierGaps::Row row;
    row.interface_id = interface;
    row.role = "primary";
    row.secondary = item;
    row.depth = depth;
    row.gap = 2;
    earlier.rows.push_back(row);
  };
  was(1, {6, 0}, 0.25);
  was(1, {7, 0}, 0.3);
  EXPECT_EQ(g.lines(&earlier), Lines{}) << "nothing was asked for";
  const Lines fresh{
      "DK374 /INTER/TYPE7 1: 1 node penetrates now that did not in old.json; deepest node 5 by 0.5 "
      "(gap 2) | node 5 is 0.5 deep",
      "DK374 /INTER/TYPE11 2: 1 edge penetrates now that did not in old.json; deepest edge 8-9 by "
      "0.2 (gap 2) | edge 8-9 is 0.2 deep"};
  const std::string worse =
      "DK375 /INTER/TYPE7 1: 1 node penetrates deeper than in old.json; deepest node 6 by 0.4 (gap "
      "2), which was 0.25 | node 6 is 0.4 deep";
  g.gate.on_fresh = true;
  EXPECT_EQ(g.lines(&earlier), fresh);
  g.gate.on_fresh = false;
  g.gate.on_worse = true;
  EXPECT_EQ(g.lines(&earlier), Lines{worse});
  g.gate.on_fresh = true;
  EXPECT_EQ(g.lines(&earlier), (Lines{fresh[0], worse, fresh[1]}));
}

TEST(Gate, KnowsWhetherAnythingWasAskedFor) {
  EXPECT_FALSE(Gate{}.any());
  const std::function<void(GateLimits&)> bounds[] = {
      [](GateLimits& l) { l.max_depth = 0; }, [](GateLimits& l) { l.max_ratio = 0; },
      [](GateLimits& l) { l.max_count = 0; }, [](GateLimits& l) { l.max_untied = 0; },
      [](GateLimits& l) { l.max_dt_loss = 0; }};
  for (std::size_t i = 0; i < std::size(bounds); ++i) {
    Gate general, interface, pair;
    interface.interfaces.resize(2);
    pair.part_pairs.resize(2);
    EXPECT_FALSE(interface.any());
    bounds[i](general.general);
    bounds[i](interface.interfaces[1].limits);
    bounds[i](pair.part_pairs[1].limits);
    for (const Gate* g : {&general, &interface, &pair}) {
      EXPECT_TRUE(g->any());
      EXPECT_EQ(g->needs_forces(), i == 4);
    }
  }
  Gate fresh, worse;
  fresh.on_fresh = true;
  worse.on_worse = true;
  EXPECT_TRUE(fresh.any() && worse.any());
  EXPECT_FALSE(fresh.needs_forces() || worse.needs_forces());
}

// ---- changed lines -----------------------------------------------------------------------------

TEST(GatePlaces, NameTheFirstChangeThatAFindingMayFollowFrom) {
  // What was changed, from the nearest to the farthest: a node of a pair, one of the main side, the
  // interface, the part's property or material or itself, an element.
  Gated g;
  g.pair(0, 0.5, 2, 5).pair(0, 0.4, 2, 6);
  for (NamedPenetration& p : g.view.penetrations) {
    p.main = {1, 2, 3, 4};
    p.secondary_element = {ElementKind::shell4, 1, 2, 2};
    p.main_element = {ElementKind::shell4, 0, 1, 1};
  }
  g.gate.general.max_depth = 0.1;
  const std::string text = g.d.deck.sources[0].bytes().data();
  const auto line_of = [&](const std::string& what, std::uint64_t more = 0) {
    const auto at = text.find(what);
    EXPECT_NE(at, text.npos) << what;
    return 1 + static_cast<std::uint64_t>(std::count(text.begin(), text.begin() + at, '\n')) + more;
  };
  const auto note = [&](std::uint64_t line) {
    ChangedLines changed;
    changed.add(g.d.deck.sources[0].path(), line, 1);
    const auto found = check_gate(g.gate, g.scene, g.view, nullptr, nullptr, &changed);
    EXPECT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].notes[0].second, "node 5 is 0.5 deep");
    return found[0].notes.size() > 1 ? found[0].notes[1].second : std::string();
  };
  const std::uint64_t nodes = line_of("/NODE");
  EXPECT_EQ(note(nodes + 5), "node 5 was changed");
  EXPECT_EQ(note(nodes + 6), "node 6 was changed");
  EXPECT_EQ(note(nodes + 3), "node of the main side, 3 was changed");
  EXPECT_EQ(note(nodes + 9), "") << "a node of another part";
  EXPECT_EQ(note(line_of("/INTER/TYPE7/1", 2)), "/INTER/TYPE7 1 was changed");
  EXPECT_EQ(note(line_of("/INTER/TYPE7/1")), "/INTER/TYPE7 1 was changed");
  EXPECT_EQ(note(line_of("/INTER/TYPE11/2", 2)), "");
  EXPECT_EQ(note(line_of("/PROP/SHELL/2", 4)), "/PROP/SHELL 2 was changed");
  EXPECT_EQ(note(line_of("/PROP/SHELL/3", 4)), "");
  EXPECT_EQ(note(line_of("/MAT/ELAST/1", 2)), "/MAT/LAW1 1 was changed");
  EXPECT_EQ(note(line_of("/PART/2")), "part 2 was changed");
  EXPECT_EQ(note(line_of("\n/SHELL/2", 2)), "element 2 was changed");
  EXPECT_EQ(note(line_of("\n/SHELL/1", 2)), "element 1 was changed");
  EXPECT_EQ(note(line_of("\n/SHELL/3", 2)), "");
}

}  // namespace
}  // namespace deck::test
