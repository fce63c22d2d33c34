// The effective values of whole decks against what the reference Starter echoed for them. The
// comparison itself is the corpus' own script; it and the decks are skipped where absent.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "golden/reference.hpp"
#include "report/shared/params_report.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;
using test::corpus;
using test::deck_for;
using test::Folder;
using test::follows_schema;
using test::quote;
using test::shell;
using test::text_of;

/// The document of `deck params --no-geometry`.
std::string params_of(const fs::path& path, int threads = 1) {
  LoadOptions options;
  options.threads = threads;
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

TEST(GoldenParams, SameBytesForAnyNumberOfThreads) {
  const fs::path deck = corpus() / "corpus" / "EuroSID_II" / "EuroSID_II_0000.rad";
  if (!fs::exists(deck)) GTEST_SKIP() << "no deck " << deck;
  EXPECT_EQ(params_of(deck, 1), params_of(deck, 2));
}

TEST(ParamsDocument, FollowsItsSchema) {
  if (shell("python3 -c 'import jsonschema' 2> /dev/null") != 0)
    GTEST_SKIP() << "no python3 with jsonschema";
  const Folder scratch;
  const fs::path deck = scratch / "small_0000.rad";
  std::ofstream(deck) << "#RADIOSS STARTER\n/BEGIN\nsmall \xe9\n      2022\n"
                         "                  Mg                  mm                   s\n"
                         "                  Mg                  mm                   s\n"
                         "/INTER/TYPE7/1\na\n         1         2\n\n\n\n\n\n"
                         "/INTER/TYPE10/2\nb\n         1         2\n\n\n"
                         "/INTER/TYPE11/3\nc\n         1         2\n\n\n\n\n"
                         "/INTER/TYPE19/4\nd\n         1         2\n\n\n\n\n\n"
                         "/INTER/TYPE2/5\ne\n         1         2\n"
                         "/INTER/TYPE3/6\nf\n         1         2\n/END\n";
  const std::string text = params_of(deck);
  std::ofstream(scratch / "params.json") << text;
  EXPECT_TRUE(follows_schema("params", scratch / "params.json"));
  const auto document = nlohmann::json::parse(text);
  EXPECT_EQ(document["interfaces"].size(), 5);
  EXPECT_EQ(document["not_evaluated"].size(), 1);
}

}  // namespace
}  // namespace deck
