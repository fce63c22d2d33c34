// `deck replay` on every set of recorded states, with the card of the deck beside it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "deck/cycle/adapter.hpp"
#include "deck/cycle/replay.hpp"
#include "where.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;

fs::path corpus() { return deck::test::shared_dir(); }

fs::path file_like(const fs::path& dir, const std::string& ending) {
  for (const auto& entry : fs::directory_iterator(dir))
    if (entry.path().filename().string().ends_with(ending)) return entry.path();
  return {};
}

/// Ids in the column "interface".
std::set<std::int64_t> interfaces_of(const std::string& csv) {
  std::set<std::int64_t> ids;
  for (std::size_t at = csv.find('\n'); at != std::string::npos && at + 1 < csv.size();
       at = csv.find('\n', at + 1)) {
    const std::size_t comma = csv.find(',', at);
    if (comma == std::string::npos) break;
    ids.insert(std::strtoll(csv.c_str() + comma + 1, nullptr, 10));
  }
  return ids;
}

void replay_set(const fs::path& dir) {
  SCOPED_TRACE(dir.filename().string());
  std::ifstream in(file_like(dir, ".csv.gz"), std::ios::binary);
  const auto csv = cycle::states_text(std::string{std::istreambuf_iterator<char>(in), {}});
  ASSERT_TRUE(csv.has_value());
  auto deck = read_deck(file_like(dir, "_0000.rad").string(), SchemaSet::built_in());
  ASSERT_TRUE(deck.ok());
  Diagnostics diagnostics;
  const Model model = build_model(*deck, SchemaSet::built_in(), diagnostics);
  const Interfaces interfaces = read_interfaces(*deck, model, diagnostics);
  SceneOptions options;
  options.penetrations = options.candidates = false;
  const Scene scene = build_scene(model, interfaces, diagnostics, options);
  for (const std::int64_t id : interfaces_of(*csv)) {
    const Contact* contact = nullptr;
    for (const Contact& c : scene.contacts)
      if (c.inter->id == id) contact = &c;
    ASSERT_NE(contact, nullptr) << id;
    cycle::ReplayOptions replay_options;
    replay_options.interface_id = static_cast<int>(id);
    const auto r = cycle::replay(cycle::make_card(scene, *contact), *csv, replay_options);
    ASSERT_EQ(r.error, "");
    EXPECT_GT(r.records, 300u);
    EXPECT_GE(static_cast<double>(r.compared), 0.95 * static_cast<double>(r.records));
    EXPECT_LE(r.median, 1e-13);
    EXPECT_LE(r.p99, 1e-9);
    EXPECT_LE(r.max, 1e-6);
    EXPECT_LE(r.zero_max_over_k0_gap, 1e-12);
  }
}

TEST(Replay, CardsOfTheDecksReproduceEveryRecordedForce) {
  const fs::path base = corpus() / "oracle" / "kernel";
  if (!fs::is_directory(base)) GTEST_SKIP() << base << " is not there (DECK_CORPUS)";
  std::size_t sets = 0;
  for (const auto& entry : fs::directory_iterator(base)) {
    replay_set(entry.path());
    ++sets;
  }
  EXPECT_GE(sets, 29u);
}

}  // namespace
}  // namespace deck
