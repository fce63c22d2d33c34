// deck parts against the time steps, masses and kinematic conditions that the reference Starter
// listed. Records and decks are skipped where absent.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "contact/small_deck.hpp"
#include "deck/deck.hpp"
#include "golden/reference.hpp"
#include "model/shared/kinematics.hpp"
#include "report/shared/parts.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;
using test::corpus;
using test::Folder;
using test::quote;
using test::shell;

std::string parts_of(const fs::path& path) {
  const auto loaded = load(path.string());
  EXPECT_TRUE(loaded.ok()) << path;
  return loaded ? parts_json(*loaded, true) : std::string();
}

/// Holds a deck against its record by the script of the corpus.
void hold(const char* kind, const std::string& name, const fs::path& deck) {
  const fs::path record = corpus() / "oracle" / kind / (name + ".json.gz");
  const fs::path script = corpus() / "check" / ("compare_" + std::string(kind) + ".py");
  if (!fs::exists(record) || !fs::exists(script) || !fs::exists(deck))
    GTEST_SKIP() << "no record or deck of " << name;
  const Folder scratch;
  const fs::path json = scratch / "parts.json";
  std::ofstream(json) << parts_of(deck);
  EXPECT_EQ(shell("python3 " + quote(script) + " " + quote(record) + " " + quote(json)), 0) << name;
}

/// Decks of the solver's own tests have "folder__NAME" for a name.
fs::path deck_beside(const char* kind, const std::string& name) {
  const auto at = name.find("__");
  const std::string file = at == std::string::npos ? name : name.substr(at + 2);
  return corpus() / "oracle" / kind / "decks" / name / (file + "_0000.rad");
}

class TimeSteps : public testing::TestWithParam<const char*> {};
TEST_P(TimeSteps, AreThoseOfTheListing) {
  hold("timestep", GetParam(), deck_beside("timestep", GetParam()));
}
INSTANTIATE_TEST_SUITE_P(Oracle, TimeSteps,
                         testing::Values("dt_shells", "dt_solids", "dt_lines",
                                         "INT_2_pl_dam_ilev__PLREG41B",
                                         "damp_new_test_v11__FFO25SCB",
                                         "bar2_v44_loi_4_49__BAR2V41B"));

class TimeStepsOfModels : public testing::TestWithParam<const char*> {};
TEST_P(TimeStepsOfModels, AreThoseOfTheListing) {
  const std::string name = GetParam();
  hold("timestep", name, corpus() / "corpus" / "qa" / name / (name + "_0000.rad"));
}
INSTANTIATE_TEST_SUITE_P(Oracle, TimeStepsOfModels,
                         testing::Values("BOULE1V4", "BOXBEAM", "CRA2AV4", "FOAM_V10"));

class Conditions : public testing::TestWithParam<const char*> {};
TEST_P(Conditions, AreCountedAsTheSolverCounts) {
  hold("kinematics", GetParam(), deck_beside("kinematics", GetParam()));
}
INSTANTIATE_TEST_SUITE_P(Oracle, Conditions,
                         testing::Values("kin_bcs_imposed", "kin_err_bcs_skew",
                                         "kin_err_rbe2_main_rbody", "kin_err_rbody_in_rbe2",
                                         "kin_lagmul", "kin_rbe", "kin_rbe3_switch", "kin_rbody",
                                         "kin_rbody_chain", "kin_rbody_shared", "kin_rwall",
                                         "kin_tied"));

TEST(PartsDocument, NamesContactsThatShareParts) {
  test::SmallDeck d;
  for (int k = 0; k < 3; ++k) {
    const int n = 10 * k;
    d.node(n + 1, 0, 0, n).node(n + 2, 10, 0, n).node(n + 3, 10, 10, n).node(n + 4, 0, 10, n);
    d.shell_part(k + 1, 1.0).shell(k + 1, k + 1, n + 1, n + 2, n + 3, n + 4);
    d.group(("/GRNOD/PART/" + std::to_string(k + 1)).c_str(), {k + 1});
    d.group(("/SURF/PART/" + std::to_string(k + 1)).c_str(), {k + 1});
  }
  d.add(
      "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1\n@/INTER/TYPE7/2 grnd_IDs=2 surf_IDm=1 "
      "Gapmin=1\n@/INTER/TYPE7/3 grnd_IDs=1 surf_IDm=1 Gapmin=1\n@/INTER/TYPE2/4 grnd_IDs=1 "
      "surf_IDm=2");
  const test::Built b(d);
  const auto json = nlohmann::json::parse(parts_json(b.loaded, false));
  ASSERT_EQ(json["repeated_contacts"].size(), 1u) << json["repeated_contacts"].dump();
  const auto& both = json["repeated_contacts"][0];
  EXPECT_EQ(both["interfaces"], (nlohmann::json{1, 2}));
  EXPECT_EQ(both["pairs"], 1);
  EXPECT_EQ(both["parts"], (nlohmann::json{1, 2}));
  EXPECT_EQ(json["unconnected"]["unseen_parts"], (nlohmann::json{3}));
}

}  // namespace
}  // namespace deck
