// deck gate: set up in a repository, it holds a change against it and speaks of changed lines.
#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tools/git_repository.hpp"

namespace {

using namespace deck::testing_support;
using nlohmann::json;

class GateVerb : public GitRepository {
 protected:
  static std::string sample() {
    return read(deck::test::source_dir() / "samples" / "too_close_0000.rad");
  }
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

TEST_F(GateVerb, AcceptsTheChangeOfOneDeckAndKeepsTheOthers) {
  write(dir_ / "models/bus_0000.rad", read(dir_ / "models/car_0000.rad"));
  ASSERT_EQ(deck("gate models --init --commits 0"), 0) << err();
  const std::string lint = read(dir_ / "lint-baseline.json"),
                    gaps = read(dir_ / "gaps-baseline.json");
  lift("105", "0.8");  // of both decks
  ASSERT_EQ(deck("gate models"), 1);
  EXPECT_TRUE(has("deck gate --accept")) << out();
  ASSERT_EQ(deck("gate --accept models/car_0000.rad"), 0) << err();
  EXPECT_EQ(deck("gate models/car_0000.rad"), 0) << out();
  EXPECT_EQ(deck("gate models/bus_0000.rad"), 1) << out();
  // One of many decks is one of many lines.
  std::istringstream old(gaps), now(read(dir_ / "gaps-baseline.json"));
  std::size_t differing = 0;
  for (std::string a, b; std::getline(old, a) && std::getline(now, b);) differing += a != b;
  EXPECT_EQ(differing, 1u);
  for (const char* call : {"gaps models/bus_0000.rad -q --write-baseline gaps-baseline.json",
                           "lint models/bus_0000.rad -q --write-baseline lint-baseline.json"})
    EXPECT_EQ(deck(call), 0) << call;
  EXPECT_EQ(deck("gate models"), 0) << out();
  lift("105", "0.9");
  EXPECT_EQ(deck("gate --accept"), 0) << err();
  lift("105", "0.89");
  EXPECT_EQ(deck("gate models"), 1) << "a little deeper";
}

TEST_F(GateVerb, NeverPassesWhatOnlyABaselineOfLintHolds) {
  ASSERT_EQ(deck("gate models --init --commits 0"), 0) << err();
  lift("105", "0.8");
  deck("lint models --write-baseline lint-baseline.json -q");
  EXPECT_EQ(read(dir_ / "lint-baseline.json").find("DK37"), std::string::npos);
  EXPECT_EQ(deck("gate models"), 1) << out();
  EXPECT_EQ(deck("lint models"), 1) << out();
  EXPECT_TRUE(has("1 finding of the gate")) << out();
  EXPECT_FALSE(complains("no longer occurs")) << err();
}

TEST_F(GateVerb, RefusesABaselineOfAnEarlierFormUntilItIsAccepted) {
  ASSERT_EQ(deck("gate models --init --commits 0"), 0) << err();
  deck("gaps models/car_0000.rad --no-config --json gaps-baseline.json -q");
  write(dir_ / "lint-baseline.json", "{\n \"schema\": \"deck.baseline/2\",\n \"decks\": {}\n}\n");
  for (const char* verb : {"gate models", "lint models", "gaps models", "cycle models"}) {
    EXPECT_EQ(deck(verb), 2) << verb;
    EXPECT_TRUE(complains("--write-baseline")) << err();
  }
  ASSERT_EQ(deck("gate --accept models"), 0) << err();
  EXPECT_EQ(deck("gate models"), 0) << out();
}

TEST_F(GateVerb, IsNotWrittenThroughLinksNorIntoPipes) {
  write(dir_ / "outside/keep", "precious\n");
  const fs::path work = dir_ / "work";
  fs::create_directories(work);
  write(work / "car_0000.rad", sample());
  git("init -q work");
  const auto refused = [&](const char* name) {
    EXPECT_EQ(deck("gate work --init --overwrite --forge github --commits 0"), 2) << name;
    EXPECT_EQ(read(dir_ / "outside/keep"), "precious\n");
    EXPECT_FALSE(fs::is_regular_file(fs::symlink_status(work / "lint-baseline.json")));
    fs::remove(work / name);
  };
  for (const char* name : {".decklint.toml", "lint-baseline.json", "gaps-baseline.json"}) {
    fs::create_symlink("../outside/keep", work / name);
    refused(name);
    fs::create_symlink("../outside/gone", work / name);
    refused(name);
    ASSERT_EQ(mkfifo((work / name).c_str(), 0600), 0);
    refused(name);
  }
  fs::create_directory_symlink("../outside", work / ".github");
  refused(".github");
}

TEST_F(GateVerb, QuotesNamesOrRefusesThem) {
  const auto init = [&](const std::string& name) {
    write(dir_ / name / "x_0000.rad", sample());
    return deck("gate '" + name + "' --init --overwrite --forge github --commits 0");
  };
  const auto workflow = [&] { return read(dir_ / ".github/workflows/deck-gate.yml"); };
  EXPECT_EQ(init("./-models"), 0) << err();
  EXPECT_NE(workflow().find("deck gate ./-models --since"), std::string::npos) << workflow();
  EXPECT_EQ(init("a b"), 0) << err();
  EXPECT_NE(workflow().find("deck gate 'a b' --since"), std::string::npos) << workflow();
  for (const char* name : {"x\n      - run: id", "${{ secrets }}", "\x1b[31mx",
                           "a\xe2\x80\xa8"
                           "b"}) {
    EXPECT_EQ(init(name), 2) << name;
    EXPECT_TRUE(complains("a workflow cannot hold this name")) << err();
  }
}

TEST_F(GateVerb, SaysWhichDecksItDoesNotReach) {
  write(dir_ / "models/old/.decklint.toml", "ignore = [\"DK9\"]\n");
  write(dir_ / "models/old/x_0000.rad", sample());
  ASSERT_EQ(deck("gate models --init --commits 0"), 0) << err();
  EXPECT_TRUE(has("does not reach 1 deck, because models/old/.decklint.toml")) << out();
}

TEST_F(GateVerb, RunsNothingThatTheRepositoryNames) {
  git("config core.fsmonitor 'touch " + (dir_ / "owned").string() + "; false'");
  git("config filter.own.clean 'touch " + (dir_ / "owned").string() + "; cat'");
  write(dir_ / ".gitattributes", "*.inc filter=own\n");
  lift("105", "0.8");
  for (const char* call :
       {"gaps models/car_0000.rad --compare git:v1", "lint models/car_0000.rad --since v1",
        "gate models --max-depth 0.1 --since v1", "diff --git v1 models/car_0000.rad"}) {
    deck(call);
    EXPECT_FALSE(fs::exists(dir_ / "owned")) << call;
  }
  ASSERT_EQ(deck("lint models --max-depth 0.1 --since v1 --format github"), 1);
  EXPECT_EQ(place("DK370").substr(0, 25), "file=models/inc/nodes.inc") << out();
}

TEST_F(GateVerb, ComparesWithAWholeBaseOrNotAtAll) {
  fs::rename(dir_ / "models/inc", dir_ / "models/real");
  fs::create_directory_symlink("real", dir_ / "models/inc");
  commit("a folder behind a link");
  EXPECT_EQ(deck("gaps models/car_0000.rad --compare git:HEAD --fail-on new,worse"), 0) << out();
  EXPECT_EQ(deck("diff --git HEAD models/car_0000.rad"), 0) << out();
  fs::rename(dir_ / "models/real", dir_ / "real");
  fs::remove(dir_ / "models/inc");
  fs::create_directory_symlink(dir_ / "real", dir_ / "models/inc");  // out of the tree, for git
  git("add -A models");
  git("commit -q -m outside");
  EXPECT_EQ(deck("gaps models/car_0000.rad --compare git:HEAD --fail-on new,worse"), 3) << out();
  write(dir_ / "x/car_0000.rad", read(dir_ / "models/car_0000.rad"));
  deck("gaps x/car_0000.rad --json old.json -q");  // without its include
  EXPECT_EQ(deck("gaps models/car_0000.rad --compare old.json"), 3) << out();
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
