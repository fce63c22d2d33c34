// `deck cycle` on the inflated dummy against the reference solver's first force evaluation, by the
// corpus' own comparison.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "golden/reference.hpp"
#include "report/shared/cycle.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;
using test::corpus;
using test::Folder;
using test::quote;
using test::shell;

/// The document of `deck cycle --all`.
std::string document(const fs::path& path, cycle::Model kernel, int threads) {
  auto deck = read_deck(path.string(), SchemaSet::built_in());
  EXPECT_TRUE(deck.ok());
  if (!deck) return {};
  Findings findings;
  const Model model = build_model(*deck, SchemaSet::built_in(), findings);
  const Interfaces interfaces = read_interfaces(*deck, model, findings);
  SceneOptions scene_options;
  scene_options.candidates = false;
  scene_options.nodal_stiffness = true;
  scene_options.threads = threads;
  const Scene scene = build_scene(model, interfaces, findings, scene_options);
  const cycle::State state = cycle::make_state(scene);
  CycleInput input;
  input.options.model = kernel;
  input.options.threads = threads;
  input.options.keep_pairs = true;
  const cycle::SceneOutcome outcome = cycle::run_cycle(scene, state, input.options);
  input.path = "deck";
  input.deck = &*deck;
  input.scene = &scene;
  input.state = &state;
  input.outcome = &outcome;
  return cycle_json(input, true);
}

TEST(GoldenCycle, EveryPairForceOfTheInflatedDummyAgrees) {
  const fs::path golden = corpus() / "oracle" / "cycle0" / "EuroSID_II_inflated.csv.gz";
  const fs::path plain = corpus() / "corpus" / "EuroSID_II" / "EuroSID_II_0000.rad";
  if (!fs::exists(golden) || !fs::exists(plain))
    GTEST_SKIP() << golden << " is not there (DECK_CORPUS)";
  const Folder scratch;
  const fs::path deck = scratch / "inflated_0000.rad";
  ASSERT_TRUE(test::inflate(plain, deck));
  const std::string json = document(deck, cycle::Model::reference, 2);
  std::ofstream(scratch / "cycle.json", std::ios::binary) << json;
  EXPECT_EQ(shell("python3 " + quote(corpus() / "check" / "compare_cycle.py") + " " +
                  quote(golden) + " " + quote(scratch / "cycle.json")),
            0);
  EXPECT_EQ(document(deck, cycle::Model::robust, 1), document(deck, cycle::Model::robust, 3));
}

}  // namespace
}  // namespace deck
