// Pairs that were judged before: what a contact takes from there is what it would find itself, and
// whatever differs is judged again.
#include <gtest/gtest.h>

#include <tuple>

#include "contact/scene/scene_parts.hpp"
#include "contact/small_deck.hpp"

namespace deck::test {
namespace {

/// Two sheets of n by n nodes, the upper one within the gap of the lower one.
SmallDeck sheets(int n, double lift = 0) {
  SmallDeck d;
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        d.node(1 + side * 1000 + i * n + j, i + 0.3 * side, j + 0.4 * side,
               side * (0.1 + lift + 0.01 * ((7 * i + 3 * j) % 11)));
  d.shell_part(1, 1).shell_part(2, 0.5);
  int id = 0;
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i + 1 < n; ++i)
      for (int j = 0; j + 1 < n; ++j) {
        const int a = 1 + side * 1000 + i * n + j;
        d.shell(1 + side, ++id, a, a + n, a + n + 1, a + 1);
      }
  d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2}).group("/SURF/PART/3", {1, 2});
  d.group("/GRNOD/PART/2", {2}).group("/LINE/SURF/1", {1}).group("/LINE/SURF/2", {2});
  return d;
}

/// Everything that judging gives, of all contacts.
auto outcome(const Scene& scene) {
  using Row =
      std::tuple<std::uint32_t, std::uint32_t, double, double, double, std::array<double, 3>, bool,
                 bool, Feature, PenetrationAction, bool, double, double, std::array<double, 3>>;
  std::vector<Row> rows;
  std::vector<std::uint64_t> counts;
  for (const Contact& c : scene.contacts) {
    for (const PenetrationRow& r : c.penetrations)
      rows.emplace_back(r.secondary, r.main, r.depth, r.gap, r.distance, r.normal, r.on_surface,
                        r.in_contact, r.feature, r.action, r.has_gap0, r.p0, r.gap0, r.moved_by);
    counts.insert(counts.end(), {c.candidates, c.removed_pairs, c.penetrations.size()});
    for (const SecondaryNode& s : c.secondary) counts.push_back(s.off);
    for (const MainSegment& m : c.main) counts.push_back(m.off);
  }
  const DecisionReport& d = scene.decisions;
  counts.insert(counts.end(), {d.pairs, d.fallback, d.exact, d.contact_differs, d.surface_differs,
                               d.differences.size()});
  return std::pair(rows, counts);
}

auto judged(const SmallDeck& d, SearchMemory* memory, const SceneOptions& options = {}) {
  Built b(d, options);
  Diagnostics findings;
  return outcome(detail::build_scene(b.model, b.interfaces, findings, options, memory));
}

TEST(JudgedMemory, AHitIsWhatTheContactWouldFind) {
  for (const char* card : {"@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=0.2",
                           "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=0.2 Inacti=1",
                           "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=0.2 Inacti=3",
                           "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=0.2 Inacti=6",
                           "@/INTER/TYPE7/1 surf_IDm=3 Gapmin=1.2 Irem_gap=2",
                           "@/INTER/TYPE10/1 grnd_IDs=2 surf_IDm=1 Gap=0.2",
                           "@/INTER/TYPE11/1 line_IDs=2 line_IDm=1 Gapmin=0.2 Inacti=6",
                           "@/INTER/TYPE19/1 surf_IDs=2 surf_IDm=1 Gapmin=0.2"}) {
    const SmallDeck d = sheets(5).add(card);
    const auto alone = judged(d, nullptr);
    EXPECT_FALSE(alone.first.empty()) << card;
    SearchMemory memory;
    EXPECT_EQ(judged(d, &memory), alone) << card;
    const std::size_t searched = memory.misses();
    EXPECT_EQ(judged(d, &memory), alone) << card;
    EXPECT_EQ(memory.misses(), searched) << card;
    const bool moves = std::string(card).find("Inacti=3") != std::string::npos;
    EXPECT_EQ(memory.hits() > 0, !moves) << card;
  }
}

TEST(JudgedMemory, WhateverDiffersIsJudgedAgain) {
  const std::string inter = "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 ", gap = "Gapmin=0.2";
  SceneOptions reference;
  reference.accuracy = Accuracy::reference;
  SceneOptions candidates;
  candidates.candidates = !candidates.candidates;
  const std::vector<std::pair<SmallDeck, SceneOptions>> cases = {
      {sheets(5).add(inter + gap), {}},
      {sheets(5, 0.03).add(inter + gap), {}},
      {sheets(5).add(inter + "Gapmin=0.15"), {}},
      {sheets(5).add(inter + gap + " Igap=1"), {}},
      {sheets(5).add(inter + gap + " Igap=3"), {}},
      {sheets(5).add("@/INTER/TYPE7/1 surf_IDm=3 Gapmin=1.2"), {}},
      {sheets(5).add("@/INTER/TYPE7/1 surf_IDm=3 Gapmin=1.2 Irem_gap=2"), {}},
      {sheets(5).add("@/INTER/TYPE7/1 surf_IDm=3 Gapmin=1.2 Igap=3 Irem_gap=2"), {}},
      {sheets(5).add("@/INTER/TYPE7/1 surf_IDm=3 Gapmin=1.2 Igap=3"), {}},
      {sheets(5).add(inter + gap), reference},
      {sheets(5).add(inter + gap), candidates},
  };
  SearchMemory memory;
  for (int turn = 0; turn < 2; ++turn)
    for (std::size_t i = 0; i < cases.size(); ++i)
      EXPECT_EQ(judged(cases[i].first, &memory, cases[i].second),
                judged(cases[i].first, nullptr, cases[i].second))
          << i;
  EXPECT_EQ(memory.hits(), memory.misses());
}

}  // namespace
}  // namespace deck::test
