// Segments, gaps, stiffness and initial penetrations of whole decks against what the reference
// Starter formed for them. The comparison itself is the corpus' own script; it and the decks are
// skipped where absent.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "golden/reference.hpp"

namespace {

namespace fs = std::filesystem;
using deck::test::corpus;
using deck::test::deck_for;
using deck::test::Folder;
using deck::test::quote;
using deck::test::shell;
using deck::test::text_of;

fs::path binary() { return deck::test::binary_dir() / "tools" / "deck"; }

class GoldenGaps : public testing::TestWithParam<const char*> {};

TEST_P(GoldenGaps, EveryContactAgreesWithTheReferenceSolver) {
  const fs::path goldens = corpus() / "oracle" / GetParam();
  const fs::path script = corpus() / "check" / "compare_gaps.py";
  if (!fs::exists(goldens) || !fs::exists(script))
    GTEST_SKIP() << "no reference results under " << corpus();
  if (shell("python3 -c pass") != 0) GTEST_SKIP() << "no python3";
  if (!fs::exists(binary())) GTEST_SKIP() << "no " << binary();
  const Folder scratch;
  int compared = 0;
  for (const auto& entry : fs::directory_iterator(goldens)) {
    if (!entry.path().string().ends_with(".json.gz")) continue;
    const fs::path deck = deck_for(entry.path(), scratch);
    ASSERT_FALSE(deck.empty()) << "no deck for " << entry.path();
    const fs::path json = scratch / "gaps.json", report = scratch / "report.txt";
    // 1 is the code for nodes on which the solver stops; some of the decks are made of them.
    const int made = shell(quote(binary()) + " gaps --all --quiet --json " + quote(json) + " " +
                           quote(deck) + " 2> " + quote(report));
    ASSERT_TRUE(WIFEXITED(made) && WEXITSTATUS(made) <= 1) << deck << "\n" << text_of(report);
    const int code = shell("python3 " + quote(script) + " " + quote(entry.path()) + " " +
                           quote(json) + " > " + quote(report));
    EXPECT_EQ(code, 0) << deck << "\n" << text_of(report);
    ++compared;
  }
  EXPECT_GT(compared, 0);
}

INSTANTIATE_TEST_SUITE_P(Oracle, GoldenGaps, testing::Values("params", "gaps"));

TEST(GoldenOrder, BlocksAreTakenInTheSolversOrder) {
  const fs::path script = corpus() / "check" / "compare_order.py";
  if (!fs::exists(script)) GTEST_SKIP() << "no reference results under " << corpus();
  if (!fs::exists(binary())) GTEST_SKIP() << "no " << binary();
  const Folder scratch;
  const fs::path report = scratch / "report.txt";
  EXPECT_EQ(shell("python3 " + quote(script) + " " + quote(binary()) + " > " + quote(report)), 0)
      << text_of(report);
}

constexpr const char* compare_messages = R"(
import gzip, json, sys
wanted = {94, 106, 343, 477, 482, 499, 558, 611, 612, 785, 786, 918, 1577, 3025}
reference = {int(k.split()[1]) for k in json.load(gzip.open(sys.argv[1]))['messages']} & wanted
found = json.load(open(sys.argv[2]))
have = {(d.get('reference') or {}).get('message') for d in found['diagnostics']} & wanted
for m in sorted(reference - have): print('the solver says', m, 'and lint does not')
for m in sorted(have - reference): print('lint says', m, 'and the solver does not')
sys.exit(reference != have)
)";

TEST(GoldenGeometryRules, SayWhatTheReferenceSolverSays) {
  const fs::path goldens = corpus() / "oracle" / "gaps";
  if (!fs::exists(goldens)) GTEST_SKIP() << "no reference results under " << corpus();
  if (shell("python3 -c pass") != 0) GTEST_SKIP() << "no python3";
  if (!fs::exists(binary())) GTEST_SKIP() << "no " << binary();
  const Folder scratch;
  std::ofstream(scratch / "compare.py") << compare_messages;
  for (const auto& entry : fs::directory_iterator(goldens)) {
    if (!entry.path().string().ends_with(".json.gz")) continue;
    const fs::path deck = deck_for(entry.path(), scratch);
    ASSERT_FALSE(deck.empty()) << "no deck for " << entry.path();
    const fs::path json = scratch / "lint.json", report = scratch / "report.txt";
    shell(quote(binary()) + " lint --geometry --no-config --quiet --json " + quote(json) + " " +
          quote(deck) + " 2> /dev/null");
    const int code = shell("python3 " + quote(scratch / "compare.py") + " " + quote(entry.path()) +
                           " " + quote(json) + " > " + quote(report));
    EXPECT_EQ(code, 0) << deck << "\n" << text_of(report);
  }
}

TEST(GoldenGaps, SameBytesForAnyNumberOfThreads) {
  const fs::path deck = corpus() / "corpus" / "EuroSID_II" / "EuroSID_II_0000.rad";
  if (!fs::exists(deck)) GTEST_SKIP() << "no deck " << deck;
  if (!fs::exists(binary())) GTEST_SKIP() << "no " << binary();
  const Folder scratch;
  const auto run = [&](const std::string& threads) {
    const fs::path json = scratch / ("gaps" + threads + ".json");
    shell(quote(binary()) + " gaps --all --quiet --threads " + threads + " --json " + quote(json) +
          " " + quote(deck) + " 2> /dev/null");
    return text_of(json);
  };
  const std::string one = run("1");
  EXPECT_FALSE(one.empty());
  EXPECT_TRUE(one == run("2")) << "the documents differ";
}

}  // namespace
