// deck gate: a repository is set up, a change is held against it, and what it says stands on the
// lines that changed.
#include <nlohmann/json.hpp>

#include "tools/git_repository.hpp"

namespace {

using namespace deck::testing_support;
using nlohmann::json;

class GateVerb : public GitRepository {
 protected:
  /// The place of the annotation of a rule: "file=models/x,line=12".
  std::string place(const std::string& rule) const {
    std::string text = out();
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      const std::string line = text.substr(at, end - at);
      if (line.find("title=" + rule + "::") != line.npos) {
        const auto file = line.find("file=");
        return line.substr(file, line.find(",col") - file);
      }
      at = end + 1;
    }
    return {};
  }
  /// 1-based line of a text in a file.
  std::string line_of(const char* file, const std::string& text) const {
    const std::string all = read(dir_ / file);
    const auto at = all.find(text);
    EXPECT_NE(at, all.npos) << text;
    return std::to_string(1 + std::count(all.begin(), all.begin() + static_cast<long>(at), '\n'));
  }
};

TEST_F(GateVerb, IsSetUpInOneCommandAndPassesWhatIsThere) {
  ASSERT_EQ(deck("gate models"), 2) << out();
  EXPECT_TRUE(complains("no gate is set")) << err();
  ASSERT_EQ(deck("gate models --init"), 0) << err();
  for (const char* file : {".decklint.toml", "lint-baseline.json", "gaps-baseline.json",
                           ".github/workflows/deck-gate.yml"}) {
    EXPECT_TRUE(fs::exists(dir_ / file)) << file;
    EXPECT_TRUE(has(std::string("wrote ") + file)) << out();
  }
  EXPECT_NE(read(dir_ / ".github/workflows/deck-gate.yml").find("deck gate models --since"),
            std::string::npos);
  EXPECT_TRUE(has("1 deck has fewer than two commits")) << out();
  ASSERT_EQ(deck("gate models --json gate.json"), 0) << err() << out();
  EXPECT_TRUE(has("Gate: passed, 1 deck.")) << out();
  const json document = json::parse(read(dir_ / "gate.json"));
  EXPECT_EQ(document["schema"]["id"], "deck/gate");
  EXPECT_EQ(document["passed"], true);
  EXPECT_EQ(document["compared"]["with"], "gaps-baseline.json");
  EXPECT_EQ(document["compared"]["same"], 9);
  EXPECT_EQ(document["findings"].size(), 0u);
}

TEST_F(GateVerb, NeverReplacesWhatIsThereUnlessToldTo) {
  write(dir_ / "lint-baseline.json", "mine\n");
  EXPECT_EQ(deck("gate models --init"), 2);
  EXPECT_TRUE(complains("lint-baseline.json is there already")) << err();
  EXPECT_EQ(read(dir_ / "lint-baseline.json"), "mine\n");
  EXPECT_FALSE(fs::exists(dir_ / ".decklint.toml"));
  EXPECT_EQ(deck("gate models --init --overwrite --forge gitlab --commits 0"), 0) << err();
  EXPECT_NE(read(dir_ / "lint-baseline.json"), "mine\n");
  EXPECT_TRUE(fs::exists(dir_ / ".gitlab/deck-gate.yml"));
  EXPECT_FALSE(fs::exists(dir_ / ".github"));
  EXPECT_FALSE(has("would have stopped")) << out();
  EXPECT_EQ(deck("gate models --commits 3"), 2);
}

TEST_F(GateVerb, WhatIsAcceptedOfOtherDecksIsNotLost) {
  write(dir_ / "models/bus_0000.rad", read(dir_ / "models/car_0000.rad"));
  ASSERT_EQ(deck("gate models --init --commits 0"), 0) << err();
  const std::string lint = read(dir_ / "lint-baseline.json"),
                    gaps = read(dir_ / "gaps-baseline.json");
  for (const char* call : {"gate models/car_0000.rad --init --overwrite",
                           "gaps models/car_0000.rad -q --write-baseline gaps-baseline.json",
                           "lint models/car_0000.rad -q --write-baseline lint-baseline.json"}) {
    EXPECT_EQ(deck(call), 2) << call;
    EXPECT_TRUE(complains("also holds models/bus_0000.rad")) << call << err();
    EXPECT_EQ(read(dir_ / "lint-baseline.json"), lint) << call;
    EXPECT_EQ(read(dir_ / "gaps-baseline.json"), gaps) << call;
  }
  // All of them, or what is left when a deck is gone.
  EXPECT_EQ(deck("gate models --init --overwrite --commits 0"), 0) << err();
  fs::remove(dir_ / "models/bus_0000.rad");
  EXPECT_EQ(deck("gate models/car_0000.rad --init --overwrite --commits 0"), 0) << err();
}

TEST_F(GateVerb, AnErrorIsNotFollowedByAVerdict) {
  ASSERT_EQ(deck("gate models --init --commits 0"), 0) << err();
  EXPECT_EQ(deck("gate models --since nosuch"), 2);
  EXPECT_TRUE(complains("nosuch")) << err();
  EXPECT_FALSE(has("passed")) << out();
}

TEST_F(GateVerb, SaysWhatItWouldHaveDoneWithTheLastCommits) {
  lift("105", "0.8");
  commit("node pushed in");
  lift("105", "1.0");
  commit("node pulled out");
  replace("models/car_0000.rad", "/END", "# a comment\n/END");
  commit("comment");
  write(dir_ / "other.txt", "x");
  ASSERT_EQ(deck("gate models --init"), 0) << err();
  EXPECT_TRUE(has("would have stopped 1 of the last 3 commits of models/car_0000.rad")) << out();
  EXPECT_TRUE(has("stopped  1 worse")) << out();
  for (const char* subject : {"node pushed in", "node pulled out", "comment", "first"})
    EXPECT_TRUE(has(subject)) << subject << out();
  ASSERT_EQ(deck("gate models --init --overwrite --commits 1"), 0) << err();
  EXPECT_TRUE(has("would have stopped 0 of the last 1 commit of")) << out();
  EXPECT_FALSE(has("node pushed in")) << out();
}

TEST_F(GateVerb, StopsAChangeAndShowsItAtTheNodeThatMoved) {
  ASSERT_EQ(deck("gate models --init --quiet"), 0) << err();
  git("add .");
  git("commit -q -m gate");
  lift("105", "0.8");
  const std::string line = line_of("models/inc/nodes.inc", "\n       105").substr(0);
  ASSERT_EQ(deck("gate --since main --format github -o sarif=s.sarif -o gitlab=g.json"), 1)
      << err();
  const std::string expected =
      "file=models/inc/nodes.inc,line=" + std::to_string(std::stoi(line) + 1);
  EXPECT_EQ(place("DK375"), expected) << out();
  EXPECT_FALSE(has(dir_.string())) << "paths as in the repository\n" << out();
  const json sarif = json::parse(read(dir_ / "s.sarif")),
             gitlab = json::parse(read(dir_ / "g.json"));
  bool found = false;
  for (const json& result : sarif["runs"][0]["results"]) {
    if (result["ruleId"] != "DK375") continue;
    found = true;
    const json& at = result["locations"][0]["physicalLocation"];
    EXPECT_EQ(at["artifactLocation"]["uri"], "models/inc/nodes.inc");
    EXPECT_EQ(at["region"]["startLine"], std::stoi(line) + 1);
    EXPECT_EQ(result["relatedLocations"][0]["physicalLocation"]["artifactLocation"]["uri"],
              "models/car_0000.rad");
  }
  EXPECT_TRUE(found);
  found = false;
  for (const json& finding : gitlab)
    if (finding["check_name"] == "DK375") {
      found = true;
      EXPECT_EQ(finding["location"]["path"], "models/inc/nodes.inc");
    }
  EXPECT_TRUE(found);
  ASSERT_EQ(deck("gate models"), 1);
  EXPECT_TRUE(has("Gate: not passed, 1 of 1 deck.")) << out();
  EXPECT_TRUE(has("DK375")) << out();
}

TEST_F(GateVerb, ShowsItAtTheCardWhereAGapOrAThicknessChanged) {
  replace("models/car_0000.rad", "1.25", "1.35");
  ASSERT_EQ(deck("lint models --compare git:v1 --fail-on never,new,worse --format github"), 1)
      << err();
  EXPECT_EQ(place("DK375"),
            "file=models/car_0000.rad,line=" + line_of("models/car_0000.rad", "1.35"))
      << out();
  // Where nothing that it depends on changed, it stays at the interface.
  ASSERT_EQ(deck("lint models --max-depth 0.1 --since main~0 --format github"), 1) << err();
  EXPECT_EQ(deck("gaps models/car_0000.rad --since nowhere"), 2);
  EXPECT_TRUE(complains("no revision 'nowhere'")) << err();
}

TEST_F(GateVerb, StandsOnTheLinesOfTheBranchOnly) {
  git("checkout -q -b work");
  lift("105", "0.8");
  commit("work");
  git("checkout -q main");
  replace("models/car_0000.rad", "upper on lower", "upper on LOWER");
  commit("another change of main");
  git("checkout -q work");
  // main has moved on: its line is not one of the branch.
  ASSERT_EQ(deck("lint models --compare git:main --fail-on never,new,worse --format github"), 1);
  EXPECT_EQ(place("DK375").substr(0, 25), "file=models/inc/nodes.inc") << out();
}

}  // namespace
