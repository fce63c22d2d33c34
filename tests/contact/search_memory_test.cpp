// SearchMemory: a hit is what the search would find, and whatever differs is another search.
#include "deck/contact/search_memory.hpp"

#include <gtest/gtest.h>

#include "contact/search_scenes.hpp"

namespace deck {
namespace {

/// Two sheets, one above the other, with gaps and stiffness of both sides.
struct Pressed {
  scenes::Mesh mesh;
  std::vector<double> node_gap, segment_gap, stiffness;
  SearchOptions options;

  Pressed() {
    for (const double z : {0.0, 0.8})
      scenes::add_sheet(mesh, 6, false, [z](int i, int j) {
        return std::array<double, 3>{1.0 * i, 1.1 * j, z};
      });
    mesh.all_nodes_secondary();
    mesh.edges_of_segments();
    node_gap.assign(mesh.secondary.size(), 0.4);
    segment_gap.assign(mesh.segments.size(), 0.5);
    stiffness.assign(mesh.segments.size(), 1.0);
    options.gap = {GapRule::sum, 0.1};
  }
  NodeSegmentInput nodes() const {
    return {mesh.nodes(),  mesh.secondary, node_gap, {},       {},
            mesh.segments, segment_gap,    {},       stiffness};
  }
  EdgeEdgeInput edges() const {
    return {mesh.nodes(), mesh.edges, {}, {}, {}, mesh.edges, {}, {}, {}};
  }
};

TEST(SearchMemory, AHitIsWhatTheSearchWouldFind) {
  Pressed p;
  SearchMemory memory;
  for (int turn = 0; turn < 3; ++turn) {
    for (const Form form : {Form::reference, Form::robust}) {
      p.options.form = form;
      const SearchResult nodes = memory.find(p.nodes(), p.options);
      EXPECT_EQ(nodes.pairs, find_node_segment_pairs(p.nodes(), p.options).pairs);
      EXPECT_FALSE(nodes.pairs.empty());
      SearchOptions near = p.options;
      near.gap = PairGap::constant(1.0);
      const SearchResult edges = memory.find(p.edges(), near);
      EXPECT_EQ(edges.pairs, find_edge_edge_pairs(p.edges(), near).pairs);
      EXPECT_FALSE(edges.pairs.empty());
    }
  }
  EXPECT_EQ(memory.misses(), 4u);
  EXPECT_EQ(memory.hits(), 8u);
}

TEST(SearchMemory, WhateverDiffersIsAnotherSearch) {
  const Pressed known;
  const std::vector<std::function<void(Pressed&)>> changes = {
      // A node in the middle of the upper sheet, moved into contact and out of it.
      [](Pressed& p) { p.mesh.z[73] = 0.2; },
      [](Pressed& p) { p.mesh.z[73] = 5.0; },
      [](Pressed& p) { p.mesh.x[0] = -1e-300; },
      [](Pressed& p) { std::swap(p.mesh.secondary[3], p.mesh.secondary[4]); },
      [](Pressed& p) {
        p.mesh.segments.pop_back(), p.segment_gap.pop_back(), p.stiffness.pop_back();
      },
      [](Pressed& p) { p.node_gap[97] = 3.0; },
      [](Pressed& p) { p.segment_gap[0] = 3.0; },
      [](Pressed& p) { p.stiffness[7] = 0.0; },
      [](Pressed& p) { p.options.gap.gapmin = 2.0; },
      [](Pressed& p) { p.options.gap.gapmax = 0.2; },
      [](Pressed& p) { p.options.gap.rule = GapRule::constant; },
      [](Pressed& p) { p.options.drad = 2.0; },
      [](Pressed& p) { p.options.margin = 0.3; },
      [](Pressed& p) { p.options.form = Form::robust; },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    SearchMemory memory;
    (void)memory.find(known.nodes(), known.options);
    Pressed other;
    changes[i](other);
    EXPECT_EQ(memory.find(other.nodes(), other.options).pairs,
              find_node_segment_pairs(other.nodes(), other.options).pairs)
        << i;
    EXPECT_EQ(memory.misses(), 2u) << i;
  }
}

TEST(SearchMemory, ThreadsAndRoomForMorePairsAreTheSameSearch) {
  Pressed p;
  SearchMemory memory;
  const std::size_t count = memory.find(p.nodes(), p.options).pairs.size();
  p.options.threads = 2;
  p.options.max_pairs = count;
  EXPECT_EQ(memory.find(p.nodes(), p.options).pairs.size(), count);
  p.options.max_pairs = count - 1;
  const SearchResult too_many = memory.find(p.nodes(), p.options);
  EXPECT_FALSE(too_many.complete);
  EXPECT_TRUE(too_many.pairs.empty());
  EXPECT_EQ(memory.hits(), 2u);
}

TEST(SearchMemory, WhatWasNotUsedForLongestIsForgotten) {
  Pressed a, b, c;
  b.mesh.z[0] = -0.1;
  c.mesh.z[0] = -0.2;
  SearchMemory memory(20000);  // room for two
  const auto find = [&](Pressed& p) {
    const std::size_t before = memory.hits();
    EXPECT_EQ(memory.find(p.nodes(), p.options).pairs,
              find_node_segment_pairs(p.nodes(), p.options).pairs);
    return memory.hits() > before;
  };
  EXPECT_FALSE(find(a));
  EXPECT_FALSE(find(b));
  EXPECT_TRUE(find(a));
  EXPECT_FALSE(find(c));  // b goes
  EXPECT_TRUE(find(a));
  EXPECT_FALSE(find(b));
  SearchMemory none(0);
  (void)none.find(a.nodes(), a.options);
  (void)none.find(a.nodes(), a.options);
  EXPECT_EQ(none.misses(), 2u);
}

}  // namespace
}  // namespace deck
