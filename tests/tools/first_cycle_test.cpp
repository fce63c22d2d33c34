// Every verb tells the same first cycle: what lint says about forces and time steps are the figures
// of 'deck cycle', and a bound on the loss of time step gives the same answer from each of them.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "tools/command_line.hpp"
#include "where.hpp"

namespace {

using namespace deck::testing_support;
using nlohmann::json;

class FirstCycle : public CommandLine {
 protected:
  /// What 'deck cycle' says of one interface, its contacts together.
  struct Figures {
    std::size_t pairs = 0;
    double sum = 0, largest = 0, acceleration = 0, energy = 0, dt = 1e30;
    std::int64_t dt_node = 0, acceleration_node = 0;
  };

  static std::vector<std::string> samples() {
    std::vector<std::string> out;
    for (const auto& entry : fs::directory_iterator(deck::test::source_dir() / "samples"))
      if (entry.path().filename().string().ends_with("_0000.rad"))
        out.push_back(entry.path().string());
    std::sort(out.begin(), out.end());
    return out;
  }

  static double size(const json& force) {
    double sum = 0;
    for (const double f : force) sum += f * f;
    return std::sqrt(sum);
  }

  std::map<std::int64_t, Figures> cycle(const std::string& path, double& structure) {
    std::map<std::int64_t, Figures> out;
    deck("cycle -q --json cycle.json '" + path + "'");
    const json document = json::parse(read(dir_ / "cycle.json"));
    structure =
        document["dt"]["structure"].is_null() ? 1e30 : document["dt"]["structure"].get<double>();
    for (const json& inter : document["interfaces"]) {
      Figures& f = out[inter["id"]];
      for (const json& c : inter["contacts"]) {
        f.pairs += c["pairs_with_force"].get<std::size_t>();
        f.sum += c["sum"]["sizes"].get<double>();
        f.energy += c["energy"]["elastic"].get<double>();
        if (!c["largest_pair"].is_null())
          f.largest = std::max(f.largest, size(c["largest_pair"]["force"]));
        if (c["acceleration"]["max"].get<double>() > f.acceleration) {
          f.acceleration = c["acceleration"]["max"];
          f.acceleration_node = c["acceleration"]["node"];
        }
        if (!c["dt_contact"].is_null() && c["dt_contact"].get<double>() < f.dt) {
          f.dt = c["dt_contact"];
          f.dt_node = c["dt_node"].is_null() ? 0 : c["dt_node"].get<std::int64_t>();
        }
      }
    }
    return out;
  }

  /// Messages of a rule by interface.
  std::map<std::int64_t, std::string> messages(const std::string& path, const std::string& rule) {
    std::map<std::int64_t, std::string> out;
    deck("lint --geometry --no-config --format json --select " + rule + " '" + path + "'");
    const json document = json::parse(this->out());
    for (const json& d : document["diagnostics"]) out[d["entity"]["id"]] = d["message"];
    return out;
  }

  static std::string figure(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
  }
};

TEST_F(FirstCycle, LintSaysTheForcesOfTheVerbCycle) {
  std::size_t said = 0;
  for (const std::string& path : samples()) {
    double structure = 0;
    const auto figures = cycle(path, structure);
    for (const auto& [id, message] : messages(path, "DK401")) {
      SCOPED_TRACE(path + ": " + message);
      const Figures& f = figures.at(id);
      EXPECT_NE(message.find(": " + std::to_string(f.pairs) +
                             (f.pairs == 1 ? " pair with" : " pairs with")),
                std::string::npos);
      EXPECT_NE(message.find(", " + figure(f.sum) + " in all, " + figure(f.largest) + " at most"),
                std::string::npos);
      EXPECT_NE(message.find("stored energy " + figure(f.energy)), std::string::npos);
      EXPECT_NE(message.find("node " + std::to_string(f.acceleration_node) +
                             " starts with an acceleration of " + figure(f.acceleration)),
                std::string::npos);
      ++said;
    }
  }
  EXPECT_GE(said, 5u);
}

TEST_F(FirstCycle, LintSaysTheTimeStepsOfTheVerbCycle) {
  std::size_t said = 0;
  for (const std::string& path : samples()) {
    double structure = 0;
    const auto figures = cycle(path, structure);
    for (const auto& [id, message] : messages(path, "DK402")) {
      SCOPED_TRACE(path + ": " + message);
      const Figures& f = figures.at(id);
      EXPECT_NE(message.find("time step " + figure(f.dt) + " from"), std::string::npos);
      if (f.dt_node != 0) {
        EXPECT_NE(message.find("at node " + std::to_string(f.dt_node) + ","), std::string::npos);
      }
      EXPECT_NE(message.find("allows " + figure(structure)), std::string::npos);
      ++said;
    }
  }
  EXPECT_GE(said, 3u);
}

/// The messages of DK373 that a verb gives.
std::vector<std::string> losses(const json& document) {
  std::vector<std::string> out;
  const bool lint = document.contains("diagnostics");
  for (const json& d : lint ? document["diagnostics"] : document["gate"]["findings"])
    if (d["rule"] == "DK373") out.push_back(d["message"]);
  std::sort(out.begin(), out.end());
  return out;
}

TEST_F(FirstCycle, EveryVerbHoldsTheSameTimeStepAgainstTheGate) {
  std::size_t asked = 0;
  for (const std::string& path : samples()) {
    double structure = 0;
    const auto figures = cycle(path, structure);
    double least = 1e30;
    for (const auto& [id, f] : figures) least = std::min(least, f.dt);
    if (!(least < structure) || structure >= 1e30) continue;
    const double loss = 1 - least / structure;
    for (const double factor : {0.999, 1.001}) {
      const double bound = std::min(1.0, factor * loss);
      const std::string gate = " -q --no-config --json v.json --max-dt-loss " +
                               std::to_string(bound) + " '" + path + "'";
      std::vector<std::string> first;
      for (const std::string verb : {"cycle", "gaps", "lint --geometry"}) {
        deck(verb + gate);
        const auto said = losses(json::parse(read(dir_ / "v.json")));
        EXPECT_EQ(said.empty(), factor > 1) << verb << gate;
        if (verb == "cycle") {
          first = said;
          if (!said.empty()) {
            EXPECT_NE(said[0].find("time step " + figure(least)), std::string::npos) << said[0];
          }
        }
        EXPECT_EQ(said, first) << verb << gate;
      }
      ++asked;
    }
  }
  EXPECT_GT(asked, 3u);
}

}  // namespace
