// deck fix from the command line: what it prints, what it writes, exit codes.
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

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
  void copy_sample(const std::string& name) {
    fs::copy(deck::test::source_dir() / "samples" / (name + "_0000.rad"), dir_);
  }
  /// The deck with another height of a node.
  static std::string lifted(const std::string& text, int node, const std::string& z) {
    std::string id = std::to_string(node);
    id.insert(0, 10 - id.size(), ' ');
    const auto at = text.find("\n" + id) + 1;
    return text.substr(0, at + 50) + std::string(20 - z.size(), ' ') + z +
           text.substr(text.find('\n', at));
  }
  /// Depths by interface and nodes, ties apart: those are in ties_.
  std::map<std::string, double> penetrations(const std::string& path) {
    std::map<std::string, double> out;
    ties_.clear();
    EXPECT_LE(deck("gaps -q --json gaps.json " + path), 1) << err();
    const auto document = nlohmann::json::parse(read(dir_ / "gaps.json"));
    for (const auto& inter : document["interfaces"])
      for (const auto& c : inter["contacts"])
        for (const auto& p : c["penetrations"]) {
          std::string pair =
              std::to_string(inter["id"].get<int>()) + " " + c["role"].get<std::string>();
          for (const char* name : {"node", "segment", "edge", "main_edge"})
            if (p.contains(name)) pair += " " + p[name].dump();
          if (inter["type"] == 10)
            ties_.insert(pair);
          else
            out[pair] = p["gap"].get<double>() - p["distance"].get<double>();
        }
    return out;
  }
  std::set<std::string> ties_;
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

TEST_F(FixCommand, StrategiesActInTheirOrderOnWhatTheOneBeforeHasLeft) {
  copy_sample("crash_box");
  std::map<std::string, int> left;
  for (const char* s : {"inacti", "move-nodes", "move-nodes,inacti", "inacti,move-nodes"}) {
    const std::string out = std::string("out-") + s;
    const int code =
        deck("fix crash_box_0000.rad --json fix.json --strategy " + std::string(s) + " -o " + out);
    ASSERT_LE(code, 1) << err();
    const std::string said = this->out();
    left[s] = static_cast<int>(penetrations(out + "/crash_box_0000.rad").size());
    const auto report = nlohmann::json::parse(read(dir_ / "fix.json"));
    EXPECT_EQ(report["strategy"], s);
    int after = 0;
    for (const auto& i : report["interfaces"]) after += i["after"]["pairs"].get<int>();
    EXPECT_EQ(after, left[s]) << s;
    EXPECT_EQ(report["tied"]["pairs"], 64) << "the tube stays on its base plate";
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
  EXPECT_EQ(left["inacti,move-nodes"], left["move-nodes,inacti"]);
  EXPECT_EQ(left["move-nodes,inacti"], left["move-nodes"]) << "Inacti moves no node";
  EXPECT_LT(left["move-nodes"], left["inacti"]);
  EXPECT_EQ(deck("fix crash_box_0000.rad --strategy inacti,inacti"), 2);
  EXPECT_EQ(deck("fix crash_box_0000.rad --strategy inacti,pray"), 2);
  EXPECT_NE(err().find("'pray'"), std::string::npos) << err();
}

TEST_F(FixCommand, NothingGetsWorseOnAnySampleWithAnyStrategy) {
  for (const auto& entry : fs::directory_iterator(deck::test::source_dir() / "samples")) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with("_0000.rad") || name == "every_mistake_0000.rad") continue;
    const std::string path = entry.path().string();
    const auto before = penetrations("'" + path + "'");
    const auto tied = ties_;
    for (const char* s : {"move-nodes", "reduce-gap", "inacti", "fpenmax"}) {
      const std::string out = std::string("out-") + s;
      ASSERT_LE(deck("fix '" + path + "' -q --strategy " + s + " -o " + out + " --overwrite"), 1)
          << name << " " << s << ": " << err();
      for (const auto& [pair, depth] : penetrations(out + "/" + name)) {
        const auto it = before.find(pair);
        EXPECT_TRUE(it != before.end() && depth <= it->second + 1e-8 * std::abs(it->second))
            << name << " " << s << ": " << pair << " is " << depth << " deep";
      }
      EXPECT_EQ(ties_, tied) << name << " " << s;
    }
  }
}

TEST_F(FixCommand, WithoutAStrategyItSaysWhatEachWouldDo) {
  ASSERT_EQ(deck("fix too_close_0000.rad --json fix.json"), 1) << err();
  EXPECT_NE(out().find("strategy    solved  left  not treated"), std::string::npos) << out();
  const std::string todo = "to do it:\n  deck ";
  const auto at = out().find(todo);
  ASSERT_NE(at, std::string::npos) << out();
  const std::string command =
      out().substr(at + todo.size(), out().find('\n', at + todo.size()) - at - todo.size());
  EXPECT_EQ(command, "fix too_close_0000.rad --strategy reduce-gap -o fixed");
  const auto report = nlohmann::json::parse(read(dir_ / "fix.json"));
  EXPECT_TRUE(report["strategy"].is_null());
  std::map<std::string, int> solved;
  for (const auto& p : report["proposals"]) solved[p["strategy"]] = p["score"]["solved"];
  EXPECT_EQ(solved, (std::map<std::string, int>{{"move-nodes", 0},
                                                {"reduce-gap", 16},
                                                {"inacti", 16},
                                                {"fpenmax", 0},
                                                {"tie", 0},
                                                {"move-part", 16}}));
  EXPECT_EQ(read(dir_ / "too_close_0000.rad"), too_close_);
  ASSERT_EQ(deck(command), 0) << err();
  EXPECT_TRUE(is_clean("fixed/too_close_0000.rad"));
  // The options of the call are those of the command.
  ASSERT_EQ(deck("fix too_close_0000.rad --max-moved 100% --min-gap 90% --inacti 5"), 1);
  EXPECT_NE(out().find("--strategy move-nodes --max-moved 100% -o fixed"), std::string::npos)
      << out();
  copy_sample("clean_plates");
  ASSERT_EQ(deck("fix clean_plates_0000.rad"), 0) << out();
  EXPECT_EQ(out(), "no initial penetrations: nothing to fix\n");
  for (const char* writes : {"--in-place", "-o out", "--diff", "--html x.html"}) {
    EXPECT_EQ(deck(std::string("fix too_close_0000.rad ") + writes), 2) << writes;
    EXPECT_NE(err().find("needs --strategy"), std::string::npos) << err();
  }
}

TEST_F(FixCommand, CrossedElementsStayAndAreNamedWithWhatToDo) {
  copy_sample("crash_box");
  ASSERT_EQ(deck("fix crash_box_0000.rad"), 1) << err();
  EXPECT_NE(out().find("8 crossed elements stay"), std::string::npos) << out();
  EXPECT_NE(out().find("deck gaps --crossings"), std::string::npos) << out();
  EXPECT_NE(out().find("64 pairs tied (28 nodes), left alone"), std::string::npos);
  ASSERT_EQ(deck("fix crash_box_0000.rad --strategy move-nodes"), 1);
  EXPECT_NE(out().find("8 crossed elements stay"), std::string::npos) << out();
  EXPECT_EQ(deck("fix crash_box_0000.rad --strategy untangle"), 2);
}

TEST_F(FixCommand, ATieIsTreatedOnlyWhereThatIsAskedFor) {
  copy_sample("tied_layer");
  penetrations("tied_layer_0000.rad");
  const auto tied = ties_;
  ASSERT_FALSE(tied.empty());
  ASSERT_EQ(deck("fix tied_layer_0000.rad --strategy reduce-gap --interface 1 -o left"), 0);
  EXPECT_NE(out().find("16 pairs tied (16 nodes), as before"), std::string::npos) << out();
  penetrations("left/tied_layer_0000.rad");
  EXPECT_EQ(ties_, tied);
  ASSERT_LE(deck("fix tied_layer_0000.rad --strategy reduce-gap --ties --min-gap 10% -o loose"), 1);
  penetrations("loose/tied_layer_0000.rad");
  EXPECT_LT(ties_.size(), tied.size());
}

TEST_F(FixCommand, TYPE25IsTreatedAndItsForcesAreNoReasonToFail) {
  std::string text = too_close_;
  const auto at = text.find("/INTER/TYPE7/1");
  text.replace(at, text.find("/END") - at,
               "/INTER/TYPE25/1\nmodern\n                   1\n         2\n\n\n\n");
  write(dir_ / "modern_0000.rad", text);
  EXPECT_EQ(deck("fix modern_0000.rad"), 1) << out() << err();
  EXPECT_NE(out().find("9 penetrations"), std::string::npos) << out();
  EXPECT_EQ(deck("fix modern_0000.rad --strategy reduce-gap -o fixed"), 0) << out() << err();
  EXPECT_NE(out().find("Gap_scale"), std::string::npos) << out();
  EXPECT_TRUE(is_clean("fixed/modern_0000.rad"));
  // Its forces are not computed: that is said, and no reason to fail.
  EXPECT_EQ(deck("gaps modern_0000.rad"), 0) << err();
  EXPECT_EQ(deck("cycle modern_0000.rad"), 0) << err();
  EXPECT_NE(out().find("forces of TYPE25 are not computed"), std::string::npos) << out();
  EXPECT_NE(out().find("contact    not evaluated"), std::string::npos) << out();
  // Nodes and edges of an interface say it once; there is no Gapmin that could be 0.
  copy_sample("airbag_fold");
  EXPECT_EQ(deck("cycle airbag_fold_0000.rad"), 0) << err();
  const std::string note = "interface 1 TYPE25: forces of TYPE25 are not computed";
  EXPECT_EQ(out().find(note), out().rfind(note)) << out();
  EXPECT_EQ(deck("gaps airbag_fold_0000.rad"), 0) << err();
  EXPECT_TRUE(std::regex_search(out(), std::regex("force from the start +- +60"))) << out();
}

TEST_F(FixCommand, TieWritesDsearchAndNamesWhatItLeaves) {
  copy_sample("welds");
  EXPECT_EQ(deck("fix welds_0000.rad --strategy tie --json fix.json -o fixed"), 1) << err();
  const auto report = nlohmann::json::parse(read(dir_ / "fix.json"));
  std::map<int, std::string> changed;
  std::set<int> now_tied;
  for (const auto& tie : report["ties"]) {
    for (const auto& c : tie["changes"])
      changed[tie["id"].get<int>()] = c["new_text"].get<std::string>();
    for (const auto& n : tie["nodes"]) now_tied.insert(n["node"].get<int>());
  }
  EXPECT_EQ(changed, (std::map<int, std::string>{{2, "3.3"}, {3, "2.6"}, {9, "6.1"}}));
  EXPECT_EQ(now_tied, (std::set<int>{203, 208, 302, 304, 504}));
  std::set<int> left;
  for (const auto& r : report["not_treated"])
    for (const auto& n : r["nodes"]) left.insert(n.get<int>());
  EXPECT_EQ(left, (std::set<int>{205, 210, 501}));
  EXPECT_EQ(deck("gaps fixed/welds_0000.rad --json gaps.json"), 0) << out();
  for (const auto& tie : nlohmann::json::parse(read(dir_ / "gaps.json"))["ties"])
    for (const auto& n : tie["nodes"])
      if (!n["tied"].get<bool>()) {
        EXPECT_FALSE(now_tied.contains(n["node"].get<int>()));
      }
  EXPECT_EQ(deck("fix welds_0000.rad --strategy tie --reach 0"), 2);
  EXPECT_EQ(deck("fix welds_0000.rad"), 1);
  EXPECT_NE(out().find("--strategy tie -o fixed"), std::string::npos) << out();
}

TEST_F(FixCommand, NothingExaminedIsNoSuccess) {
  std::string text = too_close_;
  const auto at = text.find("/INTER/TYPE7/1");
  text.replace(at, text.find("/END") - at, "/INTER/TYPE23/1\nnot examined\n");
  write(dir_ / "other_0000.rad", text);
  for (const char* strategy : {"", " --strategy move-nodes", " --strategy inacti"}) {
    EXPECT_EQ(deck(std::string("fix other_0000.rad --json fix.json") + strategy), 1);
    EXPECT_NE(out().find("Nothing examined: 1 interface of TYPE23 (id 1)."), std::string::npos)
        << out();
    EXPECT_EQ(out().find("nothing to fix"), std::string::npos) << out();
    const auto report = nlohmann::json::parse(read(dir_ / "fix.json"));
    EXPECT_EQ(report["examined"], 0);
    EXPECT_EQ(report["not_examined"][0]["ids"][0], 1);
    EXPECT_EQ(report["complete"], false);
  }
}

TEST_F(FixCommand, ALargerReachNeverTiesFewerNodes) {
  copy_sample("welds");
  std::size_t last = 0;
  for (const char* reach : {"7", "10", "12", "15", "20"}) {
    deck(std::string("fix welds_0000.rad --strategy tie --json tie.json -q --reach ") + reach);
    const auto report = nlohmann::json::parse(read(dir_ / "tie.json"));
    std::size_t tied = 0;
    for (const auto& tie : report["ties"]) tied += tie["nodes"].size();
    EXPECT_GE(tied, last) << reach;
    last = tied;
  }
  EXPECT_GT(last, 0u);
  // Ties are chosen by their ids as well.
  EXPECT_EQ(deck("fix welds_0000.rad --strategy tie --interface 2 -q"), 1) << err();
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
  const std::string page = read(dir_ / "page.html");
  long blocks = 0;  // what moved, and what the repair says of itself
  for (const std::string id : {"deck-moved", "deck-repair"}) {
    const auto at = page.find("<script type=\"application/octet-stream\" id=\"" + id + "\">");
    ASSERT_NE(at, std::string::npos) << id;
    blocks += static_cast<long>(page.find("</script>\n", at) + 10 - at);
  }
  EXPECT_LT(std::abs(size("page.html") - blocks - size("gaps.html")), 100);
  EXPECT_GT(size("page.html"), size("plain.html") + 200);
  EXPECT_EQ(deck("fix too_close_0000.rad include_tree_0000.rad --html x.html --strategy inacti"),
            2);
}

TEST_F(FixCommand, WrongUsageIsTwoAndMissingInputThree) {
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
