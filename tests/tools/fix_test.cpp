// deck fix from the command line: what it prints, what it writes, exit codes.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "tools/command_line.hpp"
#include "where.hpp"

namespace {

using namespace deck::testing_support;

class FixCommand : public CommandLine {
 protected:
  FixCommand() {
    const fs::path samples = deck::test::source_dir() / "samples";
    fs::copy(samples / "too_close_0000.rad", dir_);
    fs::copy(samples / "include_tree_0000.rad", dir_);
    fs::copy(samples / "include_tree", dir_ / "include_tree", fs::copy_options::recursive);
    too_close_ = read(dir_ / "too_close_0000.rad");
  }
  bool is_clean(const std::string& deck_path) {
    return deck("gaps " + deck_path + " --fail-on-penetration -q") == 0;
  }
  static constexpr const char* move = "--strategy move-nodes --max-moved 100%";
  std::string too_close_;
};

TEST_F(FixCommand, OnlyShowsUnlessAskedToWrite) {
  EXPECT_FALSE(is_clean("too_close_0000.rad"));
  EXPECT_EQ(deck(std::string("fix --interface 1,2 ") + move + " too_close_0000.rad"), 2);
  EXPECT_NE(err().find("it has 1"), std::string::npos) << "the interfaces there are";
  ASSERT_EQ(deck(std::string("fix --interface 1 ") + move + " too_close_0000.rad"), 0) << err();
  EXPECT_NE(out().find("nothing was written"), std::string::npos);
  EXPECT_EQ(read(dir_ / "too_close_0000.rad"), too_close_);
}

TEST_F(FixCommand, PenetrationsThatRemainAreOne) {
  EXPECT_EQ(deck("fix too_close_0000.rad --strategy move-nodes --max-moved 5%"), 1);
  EXPECT_NE(out().find("--max-moved"), std::string::npos);
  EXPECT_EQ(deck("fix too_close_0000.rad --strategy reduce-gap --min-gap 95%"), 1);
  EXPECT_NE(out().find("--min-gap"), std::string::npos);
}

TEST_F(FixCommand, ADeckWithErrorsIsNotRepaired) {
  std::string text = too_close_;
  const auto material = text.find("\n/MAT/");
  text.insert(text.find('\n', material + 1), "7");  // no part has this one
  write(dir_ / "stops_0000.rad", text);
  EXPECT_EQ(deck("fix stops_0000.rad --strategy reduce-gap"), 1) << out() << err();
  EXPECT_NE(err().find("DK103"), std::string::npos) << err();
}

TEST_F(FixCommand, ASecondRunCountsWhatTheReportSaysWasMovedBefore) {
  const std::string command =
      "fix too_close_0000.rad --strategy move-nodes --in-place --json fix.json";
  ASSERT_EQ(deck(command), 1) << err();
  const std::string once = read(dir_ / "too_close_0000.rad");
  EXPECT_NE(once, too_close_);
  const auto moved = nlohmann::json::parse(read(dir_ / "fix.json"))["moved"];
  ASSERT_EQ(moved.size(), 2u) << "one of the nine nodes of each plate: a tenth, at least one";
  for (int run = 2; run <= 3; ++run) {
    ASSERT_EQ(deck(command), 1) << err();
    EXPECT_NE(err().find("2 nodes that were moved before"), std::string::npos) << err();
    EXPECT_EQ(read(dir_ / "too_close_0000.rad"), once) << "run " << run;
    const auto report = nlohmann::json::parse(read(dir_ / "fix.json"));
    EXPECT_TRUE(report["moved"].empty());
    ASSERT_EQ(report["moved_before"].size(), 2u);
    EXPECT_EQ(report["moved_before"][0]["from"], moved[0]["from"]);
  }
  // A larger share goes on from there; a deck that was put back starts anew.
  ASSERT_EQ(deck(command + " --max-moved 100%"), 0) << out();
  write(dir_ / "too_close_0000.rad", too_close_);
  ASSERT_EQ(deck(command), 1);
  EXPECT_EQ(read(dir_ / "too_close_0000.rad"), once);
}

TEST_F(FixCommand, StrategiesActInTheirOrderOnWhatTheOneBeforeHasLeft) {
  const fs::path sample = deck::test::source_dir() / "samples/tied_layer_0000.rad";
  fs::copy(sample, dir_);
  const auto pairs = [&](const std::string& path) {
    deck("gaps " + path + " --json gaps.json -q");
    return nlohmann::json::parse(read(dir_ / "gaps.json"))["summary"]["pairs"].get<int>();
  };
  // The gaps alone may not shrink as far as needed; where nodes have moved, for one it is enough.
  std::map<std::string, int> left;
  for (const char* s :
       {"reduce-gap", "move-nodes", "reduce-gap,move-nodes", "move-nodes,reduce-gap"}) {
    const std::string out = std::string("out-") + s;
    ASSERT_EQ(
        deck("fix tied_layer_0000.rad --min-gap 80% --max-moved 20% --json fix.json --strategy " +
             std::string(s) + " -o " + out),
        1)
        << err();
    const std::string said = this->out();
    left[s] = pairs(out + "/tied_layer_0000.rad");
    const auto report = nlohmann::json::parse(read(dir_ / "fix.json"));
    EXPECT_EQ(report["strategy"], s);
    int after = 0;
    for (const auto& i : report["interfaces"]) after += i["after"]["pairs"].get<int>();
    EXPECT_EQ(after, left[s]) << s;
    if (left.size() < 3) continue;
    ASSERT_EQ(report["steps"].size(), 2u);
    EXPECT_EQ(report["steps"][0]["strategy"].get<std::string>() + "," +
                  report["steps"][1]["strategy"].get<std::string>(),
              s);
    int between[2] = {};
    for (const auto& i : report["steps"][0]["interfaces"])
      between[0] += i["after"]["pairs"].get<int>();
    for (const auto& i : report["steps"][1]["interfaces"])
      between[1] += i["before"]["pairs"].get<int>();
    EXPECT_EQ(between[0], between[1]) << "the second begins with what the first has left";
    EXPECT_NE(said.find("step 2 of 2\n" + report["steps"][1]["strategy"].get<std::string>()),
              std::string::npos)
        << said;
  }
  EXPECT_LT(left["move-nodes,reduce-gap"], std::min(left["reduce-gap"], left["move-nodes"]));
  EXPECT_EQ(left["reduce-gap,move-nodes"], left["move-nodes"]) << "nothing that gaps can do first";
  EXPECT_EQ(deck("fix tied_layer_0000.rad --strategy inacti,inacti"), 2);
  EXPECT_EQ(deck("fix tied_layer_0000.rad --strategy inacti,pray"), 2);
  EXPECT_NE(err().find("'pray'"), std::string::npos) << err();
}

TEST_F(FixCommand, TheReportShowsTheFixedDeckBesideTheOneBefore) {
  const int code =
      deck("fix too_close_0000.rad --html page.html --strategy move-nodes --max-moved 100%");
  if (code == 2 && err().find("no viewer") != std::string::npos) GTEST_SKIP();
  ASSERT_EQ(code, 0) << err();
  ASSERT_EQ(deck(std::string("fix too_close_0000.rad -o out ") + move), 0);
  ASSERT_EQ(deck("gaps too_close_0000.rad --json before.json -q"), 0);
  ASSERT_EQ(deck("gaps out/too_close_0000.rad --compare before.json --html gaps.html -q"), 0);
  ASSERT_EQ(deck("gaps out/too_close_0000.rad --html plain.html -q"), 0);
  // The same page but for the paths of the deck and of what is compared; its data are packed.
  const auto size = [&](const char* name) { return static_cast<long>(read(dir_ / name).size()); };
  EXPECT_LT(std::abs(size("page.html") - size("gaps.html")), 100);
  EXPECT_GT(size("page.html"), size("plain.html") + 200);
  EXPECT_EQ(deck("fix too_close_0000.rad include_tree_0000.rad --html x.html --strategy inacti"),
            2);
}

TEST_F(FixCommand, WrongUsageIsTwoAndMissingInputThree) {
  EXPECT_EQ(deck("fix too_close_0000.rad"), 2);
  EXPECT_EQ(deck("fix too_close_0000.rad --strategy pray"), 2);
  EXPECT_EQ(deck("fix too_close_0000.rad --strategy move-nodes --max-moved lots"), 2);
  EXPECT_EQ(deck("fix too_close_0000.rad --strategy move-nodes --lock 99"), 2);
  EXPECT_NE(err().find("no part 99"), std::string::npos);
  EXPECT_EQ(deck("fix too_close_0000.rad --strategy inacti --inacti 4"), 2);
  EXPECT_EQ(deck("fix too_close_0000.rad --strategy inacti --backup"), 2);
  EXPECT_EQ(deck("fix too_close_0000.rad --strategy inacti --in-place -o out"), 2);
  EXPECT_EQ(deck("fix nowhere_0000.rad --strategy inacti"), 3);
}

TEST_F(FixCommand, ShowingExcludesWritingInPlace) {
  EXPECT_EQ(deck("fix too_close_0000.rad --strategy inacti --diff --in-place"), 2);
  EXPECT_EQ(read(dir_ / "too_close_0000.rad"), too_close_);
}

TEST_F(FixCommand, ThePatchAppliesWithGit) {
  for (const char* strategy : {move, "--strategy reduce-gap --min-gap 10%"}) {
    write(dir_ / "too_close_0000.rad", too_close_);
    ASSERT_EQ(deck(std::string("fix too_close_0000.rad --diff ") + strategy), 0) << err();
    EXPECT_EQ(read(dir_ / "too_close_0000.rad"), too_close_);
    const std::string git = "cd '" + dir_.string() + "' && git apply stdout 2> git.err";
    ASSERT_EQ(std::system(git.c_str()), 0) << read(dir_ / "git.err");
    EXPECT_TRUE(is_clean("too_close_0000.rad"));
  }
}

TEST_F(FixCommand, RewritesInPlaceAndKeepsABackup) {
  ASSERT_EQ(deck(std::string("fix too_close_0000.rad --in-place --backup ") + move), 0) << err();
  EXPECT_TRUE(is_clean("too_close_0000.rad"));
  EXPECT_EQ(read(dir_ / "too_close_0000.rad.orig"), too_close_);
  const std::string fixed = read(dir_ / "too_close_0000.rad");
  ASSERT_EQ(deck(std::string("fix too_close_0000.rad --in-place ") + move), 0);
  EXPECT_EQ(read(dir_ / "too_close_0000.rad"), fixed);
}

TEST_F(FixCommand, WritesTheWholeTreeBelowADirectory) {
  EXPECT_FALSE(is_clean("include_tree_0000.rad"));
  const std::size_t files = count_files(dir_ / "include_tree") + 1;
  ASSERT_EQ(deck(std::string("fix include_tree_0000.rad -o out ") + move), 0) << err();
  EXPECT_EQ(count_files(dir_ / "out"), files);
  EXPECT_TRUE(is_clean("out/include_tree_0000.rad"));
  EXPECT_FALSE(is_clean("include_tree_0000.rad"));
  EXPECT_EQ(deck(std::string("fix include_tree_0000.rad -o . ") + move), 2);
}

TEST_F(FixCommand, JsonListsWhatMovedAndWhatIsLeft) {
  ASSERT_EQ(deck(std::string("fix too_close_0000.rad --json - ") + move), 0) << err();
  const auto document = nlohmann::json::parse(out());
  EXPECT_EQ(document["schema"]["id"], "deck/fix");
  EXPECT_EQ(document["strategy"], "move-nodes");
  EXPECT_EQ(document["written"], "no");
  EXPECT_TRUE(document["complete"]);
  EXPECT_EQ(document["interfaces"][0]["before"]["pairs"], 16);
  EXPECT_EQ(document["interfaces"][0]["after"]["pairs"], 0);
  EXPECT_FALSE(document["moved"].empty());
  ASSERT_EQ(deck("fix too_close_0000.rad --json f.json -q --strategy inacti"), 0) << err();
  EXPECT_EQ(out(), "");
  const auto inacti = nlohmann::json::parse(read(dir_ / "f.json"));
  EXPECT_EQ(inacti["actions"][0]["before"], "none");
  EXPECT_EQ(inacti["actions"][0]["after"], "gap-reduced");
  EXPECT_EQ(inacti["interfaces"][0]["changes"][0]["field"], "Inacti");
}

TEST_F(FixCommand, HelpTeachesWhichStrategyToTake) {
  ASSERT_EQ(deck("fix --help"), 0);
  EXPECT_NE(out().find("Which strategy?"), std::string::npos);
}

}  // namespace
