// deck accuracy, deck show pair: and deck cycle --without, as they are called.
#include <nlohmann/json.hpp>

#include "tools/command_line.hpp"

namespace {

using namespace deck::testing_support;
using nlohmann::json;

class AccuracyCommand : public CommandLine {
 protected:
  int accuracy(const std::string& rest) {
    return deck("accuracy --samples 3 --repeats 1 --quiet --json out.json " + rest);
  }
  fs::path cache() const { return dir_ / "cache"; }
  json choices() const { return json::parse(read(dir_ / "out.json")).at("choices"); }
  void SetUp() override {
    CommandLine::SetUp();
    setenv("XDG_CACHE_HOME", cache().c_str(), 1);
    for (const char* name : {"too_close", "crash_box"})
      write(dir_ / (std::string(name) + "_0000.rad"),
            read(deck::test::source_dir() / "samples" / (std::string(name) + "_0000.rad")));
  }
  void TearDown() override { unsetenv("XDG_CACHE_HOME"); }
  bool has(const std::string& text) const { return out().find(text) != std::string::npos; }
};

TEST_F(AccuracyCommand, HardCasesAreMeasuredOnce) {
  ASSERT_EQ(accuracy(""), 0) << err();
  const json first = choices();
  ASSERT_EQ(count_files(cache()), 1u);
  ASSERT_EQ(accuracy(""), 0);
  EXPECT_EQ(choices(), first);  // times, too
  // What was measured of all number types holds for a deck, which needs the decisions alone.
  ASSERT_EQ(accuracy("too_close_0000.rad"), 0) << err();
  EXPECT_EQ(count_files(cache()), 1u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(choices()[k]["hard_cases"], first[k]["hard_cases"]);
    EXPECT_GT(choices()[k]["deck"]["seconds"].get<double>(), 0.0);
  }
  ASSERT_EQ(deck("accuracy --samples 4 --repeats 1 --quiet"), 0);
  EXPECT_EQ(count_files(cache()), 2u);
}

TEST_F(AccuracyCommand, WhatIsNoMeasurementIsMeasuredAgain) {
  ASSERT_EQ(accuracy(""), 0);
  fs::path file;
  for (const auto& e : fs::recursive_directory_iterator(cache()))
    if (e.is_regular_file()) file = e.path();
  const std::string whole = read(file);
  write(file, whole.substr(0, whole.size() / 2));
  ASSERT_EQ(accuracy(""), 0) << err();
  EXPECT_EQ(read(file).size() > whole.size() / 2, true);
  ASSERT_EQ(accuracy("--again"), 0);
  EXPECT_EQ(count_files(cache()), 1u);
}

TEST_F(AccuracyCommand, ADirectoryThatCannotBeWrittenIsHarmless) {
  write(cache(), "a file in place of the directory");
  ASSERT_EQ(accuracy(""), 0) << err();
  EXPECT_EQ(err(), "");
  EXPECT_EQ(choices().size(), 4u);
  unsetenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  const std::string kept = home == nullptr ? "" : home;
  unsetenv("HOME");
  EXPECT_EQ(accuracy(""), 0) << err();
  if (home != nullptr) setenv("HOME", kept.c_str(), 1);
}

TEST_F(AccuracyCommand, TheTerminalHasFourRowsNamedAsTheOptionIs) {
  ASSERT_EQ(deck("accuracy --samples 3 --repeats 1 crash_box_0000.rad"), 0) << err();
  EXPECT_TRUE(has("Keep robust, the default: on this deck it takes "));
  for (const char* row : {"\nreference ", "\nfast ", "\nrobust ", "\nexact "})
    EXPECT_TRUE(has(row));
  EXPECT_TRUE(has(" of 37\n"));
  EXPECT_FALSE(has("double-residual"));
  ASSERT_EQ(deck("accuracy --samples 3 --repeats 1 --verbose"), 0);
  EXPECT_TRUE(has("double-residual"));
}

class PairCommand : public AccuracyCommand {};

TEST_F(PairCommand, ShowDrawsAPairByItsNodes) {
  ASSERT_EQ(deck("gaps too_close_0000.rad --quiet --json gaps.json --all"), 0);
  ASSERT_EQ(deck("show too_close_0000.rad pair:57/1-2-3-4 --svg"), 2);
  EXPECT_NE(err().find("no pair of these nodes penetrates"), std::string::npos);
  ASSERT_EQ(deck("show too_close_0000.rad pair:57"), 2);
  EXPECT_NE(err().find("by the ids of their nodes"), std::string::npos);
  ASSERT_EQ(deck("show crash_box_0000.rad pair:2018/20047-20048-20059-20058 --svg"), 0) << err();
  EXPECT_EQ(out().rfind("<svg", 0), 0u);
  EXPECT_TRUE(has("depth 1.0238 = gap 2.5 - distance 1.4762"));
  ASSERT_EQ(deck("show crash_box_0000.rad pair:2018/20048-20047-20058-20059"), 0);
  EXPECT_TRUE(has("Interface 1 TYPE7: node 2018 on segment "));
  EXPECT_EQ(deck("show crash_box_0000.rad 1 --svg"), 2);
}

TEST_F(PairCommand, CycleEvaluatesWithoutAnEffect) {
  ASSERT_EQ(deck("cycle too_close_0000.rad --velocity 2=0,0,-5 --dt 1e-3 --without normal-damping"),
            0)
      << err();
  EXPECT_TRUE(has("With and without normal-damping"));
  EXPECT_TRUE(has("largest nodal force "));
  EXPECT_EQ(deck("cycle too_close_0000.rad --without radiation"), 2);
  EXPECT_NE(err().find("no contact of too_close_0000.rad has this effect"), std::string::npos);
  EXPECT_EQ(deck("cycle too_close_0000.rad --without nothing"), 2);
  EXPECT_NE(err().find("these can: friction, heat"), std::string::npos);
}

}  // namespace
