// The effective values of whole decks against what the reference Starter echoed for them. The
// comparison itself is the corpus' own script; it and the decks are skipped where absent.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "golden/reference.hpp"
#include "report/shared/params_report.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;
using test::corpus;
using test::deck_for;
using test::Folder;
using test::quote;
using test::shell;
using test::text_of;

/// The document of `deck params --no-geometry`.
std::string params_of(const fs::path& path) {
  LoadOptions options;
  options.geometry = false;
  const auto loaded = load(path.string(), options);
  EXPECT_TRUE(loaded.ok()) << path;
  return loaded ? params_json({*loaded}) : std::string();
}

class GoldenParams : public testing::TestWithParam<const char*> {};

TEST_P(GoldenParams, AgreeWithTheEchoOfTheReferenceSolver) {
  const fs::path goldens = corpus() / "oracle" / GetParam();
  const fs::path script = corpus() / "check" / "compare_params.py";
  if (!fs::exists(goldens) || !fs::exists(script))
    GTEST_SKIP() << "no reference results under " << corpus();
  if (shell("python3 -c pass") != 0) GTEST_SKIP() << "no python3";
  const Folder scratch;
  int compared = 0;
  for (const auto& entry : fs::directory_iterator(goldens)) {
    if (!entry.path().string().ends_with(".json.gz")) continue;
    const fs::path deck = deck_for(entry.path(), scratch);
    ASSERT_FALSE(deck.empty()) << "no deck for " << entry.path();
    const fs::path json = scratch / "params.json";
    std::ofstream(json) << params_of(deck);
    const fs::path report = scratch / "report.txt";
    const int code = shell("python3 " + quote(script) + " " + quote(entry.path()) + " " +
                           quote(json) + " > " + quote(report));
    EXPECT_EQ(code, 0) << deck << "\n" << text_of(report);
    ++compared;
  }
  EXPECT_GT(compared, 0);
}

INSTANTIATE_TEST_SUITE_P(Oracle, GoldenParams, testing::Values("params", "gaps"));

}  // namespace
}  // namespace deck
