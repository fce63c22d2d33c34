// The way in: a loaded deck makes each stage once, on demand, and keeps all that was found.
#include "deck/deck.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <tuple>

#include "contact/small_deck.hpp"
#include "deck/model.hpp"
#include "deck/rule_id.hpp"
#include "where.hpp"

namespace deck::test {
namespace {

std::string sample(const char* name) { return (source_dir() / "samples" / name).string(); }

LoadedDeck in_memory(const std::string& text, const LoadOptions& options = {}) {
  auto deck = read_deck_text("small_0000.rad", text, SchemaSet::built_in(), options.read);
  EXPECT_TRUE(deck.ok());
  return LoadedDeck::from(std::move(*deck), options);
}

/// Two plates 0.5 apart, the nodes of the upper one against the lower one. The gap follows from the
/// thickness 1 where `card` does not say another.
std::string plates(const std::string& card = "Istf=4", const std::vector<int>& group = {2}) {
  SmallDeck d;
  for (int k = 0; k < 2; ++k) {
    const double z = 0.5 * k;
    d.node(4 * k + 1, 0, 0, z).node(4 * k + 2, 10, 0, z);
    d.node(4 * k + 3, 10, 10, z).node(4 * k + 4, 0, 10, z);
    d.shell_part(k + 1, 1.0).shell(k + 1, k + 1, 4 * k + 1, 4 * k + 2, 4 * k + 3, 4 * k + 4);
  }
  d.group("/SURF/PART/1", {1}).group("/GRNOD/PART/2", group);
  return d.add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 " + card).text();
}

/// Takes the stages in the order in which they are made.
void watch(LoadedDeck& loaded, std::vector<Stage>& made) {
  loaded.observe([&made](Stage stage) { made.push_back(stage); });
}

bool has(const Findings& findings, RuleId rule) { return findings.counts().contains(rule); }

// ---- on demand, once ---------------------------------------------------------------------------

TEST(Load, MakesNothingThatNobodyAskedFor) {
  auto loaded = load(sample("too_close_0000.rad"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  std::vector<Stage> made;
  watch(*loaded, made);
  EXPECT_FALSE(loaded->deck().blocks.empty());
  EXPECT_FALSE(loaded->incomplete());
  EXPECT_EQ(loaded->reached(), Stage::deck);
  EXPECT_TRUE(made.empty());
  loaded->model();
  EXPECT_EQ(made, std::vector{Stage::model});
  EXPECT_EQ(loaded->reached(), Stage::model);
}

TEST(Load, MakesEveryStageOnce) {
  LoadedDeck loaded = in_memory(plates());
  std::vector<Stage> made;
  watch(loaded, made);
  const FirstCycle* cycle = &loaded.cycle();
  const Scene* scene = &loaded.scene();
  const Model* model = &loaded.model();
  const Interfaces* interfaces = &loaded.interfaces();
  loaded.findings();
  EXPECT_EQ(made, (std::vector{Stage::model, Stage::interfaces, Stage::scene, Stage::cells}));
  loaded.findings();
  EXPECT_EQ(&loaded.cycle(), cycle);
  EXPECT_EQ(&loaded.scene(), scene);
  EXPECT_EQ(&loaded.model(), model);
  EXPECT_EQ(&loaded.interfaces(), interfaces);
  EXPECT_EQ(made.size(), 4u);
  EXPECT_EQ(scene->model, model);
  EXPECT_EQ(scene->interfaces, interfaces);
}

TEST(Load, MovingMovesNoneOfTheParts) {
  auto first = load(sample("too_close_0000.rad"));
  ASSERT_TRUE(first) << first.error().message;
  const InterBase* inter = first->interfaces().ordered.front();
  const Model* model = &first->model();
  const Scene* scene = &first->scene();
  LoadedDeck moved = std::move(*first);
  EXPECT_EQ(moved.interfaces().ordered.front(), inter);
  EXPECT_EQ(&moved.model(), model);
  EXPECT_EQ(&moved.scene(), scene);
  EXPECT_EQ(moved.model().deck, &moved.deck());
  EXPECT_EQ(
      &moved.deck().blocks[static_cast<std::size_t>(inter->block - moved.deck().blocks.data())],
      inter->block);
  auto second = load(sample("clean_plates_0000.rad"));
  ASSERT_TRUE(second) << second.error().message;
  moved = std::move(*second);
  EXPECT_EQ(moved.scene().model, &moved.model());
  EXPECT_FALSE(moved.scene().contacts.empty());
}

// ---- values that follow from the mesh ----------------------------------------------------------

TEST(MeshValues, StayOpenWhereGeometryIsNotAskedFor) {
  LoadOptions options;
  options.geometry = false;
  const LoadedDeck open = in_memory(plates(), options);
  EXPECT_TRUE(waits_for_geometry(open.interfaces()));
  EXPECT_EQ(open.mesh_values().contacts.size(), 1u);
  EXPECT_FALSE(waits_for_geometry(open.interfaces())) << "asked for";
  const LoadedDeck resolved = in_memory(plates());
  EXPECT_FALSE(waits_for_geometry(resolved.interfaces()));
  EXPECT_EQ(resolved.interfaces().type7.front().Gapmin.value,
            open.interfaces().type7.front().Gapmin.value);
}

TEST(MeshValues, AreThoseOfTheSceneWhereThereIsOne) {
  LoadOptions options;
  options.geometry = false;
  const LoadedDeck loaded = in_memory(plates(), options);
  const Scene& scene = loaded.scene();
  EXPECT_TRUE(waits_for_geometry(loaded.interfaces()));
  EXPECT_EQ(&loaded.mesh_values(), &scene);
  EXPECT_EQ(loaded.interfaces().type7.front().Gapmin.value, scene.contacts.front().gapmin);
}

TEST(MeshValues, AreThoseOfTheDeckWhateverSceneIsMade) {
  LoadedDeck loaded = in_memory(plates());
  SceneOptions options = loaded.scene_options();
  options.what_if = {WhatIf{}};
  options.what_if.front().interface_id = 1;
  options.what_if.front().Gapmin = 0.3;
  loaded.set_scene_options(options);
  EXPECT_EQ(loaded.scene().contacts.front().gapmin, 0.3);
  EXPECT_NE(loaded.interfaces().type7.front().Gapmin.value, 0.3);
}

// ---- contacts ----------------------------------------------------------------------------------

TEST(SceneOptions, AnotherWayMakesTheSceneAnew) {
  LoadedDeck loaded = in_memory(plates("Gapmin=0.7"));
  EXPECT_EQ(loaded.scene().contacts.front().penetrations.size(), 4u);
  SceneOptions options = loaded.scene_options();
  options.penetrations = false;
  loaded.set_scene_options(options);
  EXPECT_EQ(loaded.reached(), Stage::interfaces);
  EXPECT_TRUE(loaded.scene().contacts.front().penetrations.empty());
}

TEST(Cycle, HasForcesWhateverTheSceneWasMadeWithout) {
  LoadedDeck whole = in_memory(plates("Gapmin=0.7 Istf=4")),
             lean = in_memory(plates("Gapmin=0.7 Istf=4"));
  SceneOptions options = lean.scene_options();
  options.nodal_stiffness = false;
  lean.set_scene_options(options);
  EXPECT_GT(whole.cycle().outcome.largest_nodal_force, 0);
  EXPECT_EQ(lean.cycle().outcome.largest_nodal_force, whole.cycle().outcome.largest_nodal_force);
  EXPECT_EQ(whole.cycle().outcome.contacts.front().pairs.size(), 4u);
}

// ---- limits ------------------------------------------------------------------------------------

TEST(Limits, HoldForSelectionsOfEveryModel) {
  LoadOptions options;
  options.read.limits.selection_bytes = 1;
  const LoadedDeck loaded = in_memory(plates("Gapmin=0.7"), options);
  const auto again = loaded.with({});
  ASSERT_TRUE(again) << again.error().message;
  ModelOptions how;
  how.limits.selection_bytes = 1;
  Findings ignored;
  const Model alone = build_model(loaded.deck(), SchemaSet::built_in(), ignored, how);
  for (const Model* model : {&loaded.model(), &again->model(), &alone}) {
    model->selections->resolve_all();
    EXPECT_FALSE(model->selections->complete());
  }
}

TEST(Limits, HoldForPairs) {
  LoadOptions options;
  options.read.limits.pair_bytes = 1;
  const LoadedDeck loaded = in_memory(plates("Gapmin=0.7"), options);
  EXPECT_FALSE(loaded.scene().contacts.front().evaluated);
  EXPECT_TRUE(has(loaded.findings(), RuleId::DK390));
  EXPECT_EQ(loaded.scene().limits.pair_bytes, 1u);
}

TEST(Limits, HoldForFindings) {
  LoadOptions options;
  options.read.limits.findings_per_rule = 1;
  const LoadedDeck loaded = in_memory(plates() + "/NODE\n/NODE\n", options);
  for (const auto& [rule, count] : loaded.findings().counts()) {
    const auto& all = loaded.findings().all();
    EXPECT_LE(std::count_if(all.begin(), all.end(),
                            [&, r = rule](const Finding& d) { return d.rule == r; }),
              1);
  }
}

// ---- findings ----------------------------------------------------------------------------------

TEST(Findings, OfGroupsComeWithTheirContacts) {
  // The group names a part that is not there.
  const LoadedDeck loaded = in_memory(plates("Gapmin=0.7", {99}));
  const Findings before = loaded.findings(Stage::cells);
  const Findings& all = loaded.findings();
  const auto of = [](const Findings& d, RuleId rule) {
    const auto it = d.counts().find(rule);
    return it == d.counts().end() ? 0u : it->second;
  };
  EXPECT_EQ(of(before, RuleId::DK172), 0u);
  EXPECT_EQ(of(all, RuleId::DK172), 1u);
}

TEST(Findings, OfCellsThatCannotBeReadAreAmongThem) {
  std::string text = plates("Gapmin=0.7 Stfac=1.5");
  const auto at = text.find("1.5");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 3, "l.5");
  const LoadedDeck loaded = in_memory(text);
  EXPECT_TRUE(loaded.findings(Stage::interfaces).all().empty());
  const Findings cells = loaded.findings(Stage::cells);
  ASSERT_EQ(cells.all().size(), 1u);
  EXPECT_EQ(cells.all().front().severity, Severity::error);
  const auto errors = [](const Findings& d) {
    return std::count_if(d.all().begin(), d.all().end(),
                         [](const Finding& f) { return f.severity == Severity::error; });
  };
  EXPECT_EQ(errors(loaded.findings()), 1) << "once, however often it is asked for";
  EXPECT_EQ(errors(loaded.findings()), 1);
  EXPECT_EQ(errors(loaded.deck().findings), 1) << "where verdicts look";
}

TEST(Findings, AreThereOnceAndInTheOrderOfTheStages) {
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "samples")) {
    if (!entry.path().string().ends_with("_0000.rad")) continue;
    const auto loaded = load(entry.path().string());
    ASSERT_TRUE(loaded);
    std::set<std::tuple<RuleId, std::uint32_t, std::uint64_t, std::string>> known;
    for (const Finding& d : loaded->findings().all())
      EXPECT_TRUE(known.emplace(d.rule, d.span.file, d.span.offset, d.message).second)
          << entry.path() << d.message;
    // What earlier stages found comes first.
    const auto& all = loaded->findings().all();
    const Findings first = loaded->findings(Stage::interfaces);
    ASSERT_LE(first.all().size(), all.size());
    for (std::size_t i = 0; i < first.all().size(); ++i)
      EXPECT_EQ(first.all()[i].message, all[i].message) << entry.path();
  }
}

// ---- other texts -------------------------------------------------------------------------------

TEST(Load, AMissingDeckIsAnErrorWithItsName) {
  const auto loaded = load("/nowhere/none_0000.rad");
  ASSERT_FALSE(loaded);
  EXPECT_NE(loaded.error().message.find("none_0000.rad"), std::string::npos);
}

}  // namespace
}  // namespace deck::test
