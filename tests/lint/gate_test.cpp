// The gate: every rule of it fires on its bad example and stays silent on its good one; and what an
// earlier run is compared by.
#include "lint/shared/gate.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "deck/contacts.hpp"
#include "lint/support.hpp"

namespace deck::test {
namespace {

/// An example with its contacts.
struct Measured {
  Deck deck;
  Findings found;
  Model model;
  Interfaces interfaces;
  Scene scene;
  SceneView view;
  cycle::SceneOutcome forces;
  static std::unique_ptr<Measured> of(std::string_view example) {
    const SchemaSet& schemas = SchemaSet::built_in();
    auto deck = read_deck_text("deck_0000.rad", example_deck(example, schemas).main, schemas);
    if (!deck) throw std::runtime_error(deck.error().message);
    auto out = std::make_unique<Measured>();
    out->deck = std::move(*deck);
    out->model = build_model(out->deck, schemas, out->found);
    out->interfaces = read_interfaces(out->deck, out->model, out->found);
    SceneOptions options;
    options.nodal_stiffness = true;
    options.ties = true;
    out->scene = build_scene(out->model, out->interfaces, out->found, options);
    out->view = make_view(out->scene);
    out->forces = cycle::run_cycle(out->scene, cycle::make_state(out->scene));
    return out;
  }
  /// What a later run sees as the earlier one.
  GapBaseline kept() const {
    GapBaseline out;
    for (const std::uint32_t i : view.deepest_per_node) {
      const NamedPenetration& p = view.penetrations[i];
      const Contact& c = scene.contacts[p.contact];
      const PenetrationRow& row = c.penetrations[p.row];
      out.rows.push_back({c.inter->id, to_string(c.role), p.secondary, row.depth, row.gap, p.at});
    }
    return out;
  }
};

/// A gate that asks for everything: bounds that the bad examples pass over and the good ones keep.
Gate strict() {
  Gate gate;
  gate.general = {0.9, 0.2, 0.5, 3, 3};
  gate.on_fresh = gate.on_worse = true;
  return gate;
}

std::set<RuleId> rules_of(const Measured& now, const GapBaseline& earlier,
                          const Gate& gate = strict()) {
  std::set<RuleId> out;
  for (const Finding& d : check_gate(gate, now.scene, now.view, &now.forces, &earlier))
    out.insert(d.rule);
  return out;
}

class EveryGateRule : public testing::TestWithParam<RuleId> {};

TEST_P(EveryGateRule, FiresOnItsBadExampleAndNotOnItsGoodOneWhichWasThereBefore) {
  const Rule& rule = rule_of(GetParam());
  ASSERT_FALSE(rule.bad.empty());
  const auto bad = Measured::of(rule.bad), good = Measured::of(rule.good);
  EXPECT_TRUE(rules_of(*bad, good->kept()).contains(rule.id));
  EXPECT_FALSE(rules_of(*good, good->kept()).contains(rule.id));
  EXPECT_EQ(rule.stage, RuleStage::gate);
}

TEST_P(EveryGateRule, IsSilentWhereNothingWasAskedFor) {
  const auto bad = Measured::of(rule_of(GetParam()).bad);
  EXPECT_TRUE(rules_of(*bad, {}, Gate{}).empty());
}

INSTANTIATE_TEST_SUITE_P(Rules, EveryGateRule, testing::ValuesIn(gate_rules),
                         [](const auto& one) { return std::string(id_text(one.param)); });

constexpr std::string_view penetrating = "@/INTER/TYPE7/1 Gapmin=4";

TEST(CompareGaps, IdsDecideWhereAPlaceIsAnotherOrNotKnown) {
  const auto run = Measured::of(penetrating);
  ASSERT_GT(run->view.deepest_per_node.size(), 2u);
  const auto moved = [](GapBaseline::Row& row) { (*row.at)[2] += 100; };
  const auto unknown = [](GapBaseline::Row& row) { row.at.reset(); };
  for (const std::function<void(GapBaseline::Row&)>& change :
       {std::function<void(GapBaseline::Row&)>([](GapBaseline::Row&) {}), {moved}, {unknown}}) {
    GapBaseline earlier = run->kept();
    for (GapBaseline::Row& row : earlier.rows) change(row);
    const GapsComparison c = compare_gaps(earlier, run->scene, run->view);
    EXPECT_EQ(c.count(Trend::same), run->view.deepest_per_node.size());
    EXPECT_TRUE(c.solved.empty());
  }
}

TEST(CompareGaps, WithOtherIdsThePlaceDecides) {
  const auto run = Measured::of(penetrating);
  GapBaseline earlier = run->kept();
  // Ids that are all taken by others now: those of the next row.
  for (std::size_t i = 0; i + 1 < earlier.rows.size(); ++i)
    std::swap(earlier.rows[i].secondary, earlier.rows[i + 1].secondary);
  for (GapBaseline::Row& row : earlier.rows) row.interface_id += 70;
  const GapsComparison c = compare_gaps(earlier, run->scene, run->view);
  EXPECT_EQ(c.count(Trend::same), earlier.rows.size());
  for (std::size_t i = 0; i < c.rows.size(); ++i) EXPECT_EQ(c.rows[i].earlier, i);
}

TEST(CompareGaps, WhatHasOtherIdsAndAnotherPlaceIsNewAndTheOldIsSolved) {
  const auto run = Measured::of(penetrating);
  GapBaseline earlier = run->kept();
  earlier.rows[0].secondary = {987654, 0};
  (*earlier.rows[0].at)[0] += 2e-6 * earlier.rows[0].gap;
  const GapsComparison c = compare_gaps(earlier, run->scene, run->view);
  EXPECT_EQ(c.count(Trend::added), 1u);
  EXPECT_EQ(c.rows[0].earlier, no_index);
  EXPECT_EQ(c.solved, std::vector<std::uint32_t>{0});
}

TEST(CompareGaps, AMillionthIsNoDifferenceAndTwoAre) {
  const auto run = Measured::of(penetrating);
  for (const double share : {1 + 0.9e-6, 1 - 0.9e-6}) {
    GapBaseline earlier = run->kept();
    for (GapBaseline::Row& row : earlier.rows) row.depth *= share;
    EXPECT_EQ(compare_gaps(earlier, run->scene, run->view).count(Trend::same), earlier.rows.size());
  }
  for (const auto& [share, trend] :
       {std::pair(1 + 2e-6, Trend::better), std::pair(1 - 2e-6, Trend::worse)}) {
    GapBaseline earlier = run->kept();
    for (GapBaseline::Row& row : earlier.rows) row.depth *= share;
    EXPECT_EQ(compare_gaps(earlier, run->scene, run->view).count(trend), earlier.rows.size());
  }
}

}  // namespace
}  // namespace deck::test
