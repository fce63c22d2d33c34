// deck fix from the command line: no strategy makes a pair worse, and they act in order.
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tools/command_line.hpp"
#include "where.hpp"

namespace {

using namespace deck::testing_support;

class FixCommand : public CommandLine {
 protected:
  void copy_sample(const std::string& name) {
    fs::copy(deck::test::source_dir() / "samples" / (name + "_0000.rad"), dir_);
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
};

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

}  // namespace
