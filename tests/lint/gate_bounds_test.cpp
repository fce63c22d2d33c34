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

}  // namespace
}  // namespace deck::test
