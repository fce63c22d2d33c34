// Small decks as text for the tests of the model stage: nodes, elements and option blocks in their
// columns, and what a test wants to know about the result.
#pragma once
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "deck/model.hpp"
#include "deck/rule_id.hpp"

namespace deck::test {

using Ids = std::vector<std::int64_t>;

/// Integers in cells of 10 columns, 10 per line.
inline std::string cells(const Ids& values) {
  std::string out;
  for (std::size_t i = 0; i < values.size(); ++i) {
    char text[32];
    std::snprintf(text, sizeof text, "%10lld", static_cast<long long>(values[i]));
    out += text;
    if (i % 10 == 9 || i + 1 == values.size()) out += '\n';
  }
  return values.empty() ? "\n" : out;
}

/// Reals in cells of 20 columns, 5 per line.
inline std::string reals(const std::vector<double>& values) {
  std::string out;
  for (std::size_t i = 0; i < values.size(); ++i) {
    char text[32];
    std::snprintf(text, sizeof text, "%20.12g", values[i]);
    out += text;
    if (i % 5 == 4 || i + 1 == values.size()) out += '\n';
  }
  return out;
}

inline std::string node(std::int64_t id, double x, double y, double z) {
  char text[96];
  std::snprintf(text, sizeof text, "%10lld%20.12g%20.12g%20.12g\n", static_cast<long long>(id), x,
                y, z);
  return text;
}

/// A deck with the given blocks between /BEGIN and /END.
inline std::string deck_text(const std::string& blocks, const char* input_units = "kg mm ms",
                             int version = 2024) {
  std::istringstream words(input_units);
  std::string mass, length, time;
  words >> mass >> length >> time;
  char head[128];
  std::snprintf(head, sizeof head, "%10d         0\n%20s%20s%20s\n", version, mass.c_str(),
                length.c_str(), time.c_str());
  return "#RADIOSS STARTER\n/BEGIN\ntest\n" + std::string(head) +
         "                  kg                  mm                  ms\n" + blocks + "/END\n";
}

/// A deck read and built. Stays at its address.
class BuiltModel {
 public:
  explicit BuiltModel(const std::string& blocks, const char* input_units = "kg mm ms",
                      int version = 2024)
      : deck_(std::make_unique<Result<Deck>>(read_deck_text(
            "test_0000.rad", deck_text(blocks, input_units, version), SchemaSet::built_in()))),
        model_(build_model(**deck_, SchemaSet::built_in(), findings_)) {}

  Model& model() { return model_; }
  Selections& selections() { return *model_.selections; }
  const Findings& findings() const { return findings_; }

  Ids ids(const std::vector<NodeIndex>& nodes) const {
    Ids out;
    for (const NodeIndex n : nodes) out.push_back(model_.node_id(n));
    return out;
  }
  Ids group(std::int64_t id) {
    const NodeSet* g = selections().node_group(id);
    return g ? ids(g->nodes) : Ids{-1};
  }
  /// Node ids of every segment.
  std::vector<Ids> surface(std::int64_t id) {
    std::vector<Ids> out;
    if (const Surface* s = selections().surface(id))
      for (const Segment& segment : s->segments)
        out.push_back(ids({segment.nodes.begin(), segment.nodes.end()}));
    return out;
  }
  std::vector<Ids> line(std::int64_t id) {
    std::vector<Ids> out;
    if (const LineSet* l = selections().line(id))
      for (const Edge& edge : l->edges) out.push_back(ids({edge.nodes.begin(), edge.nodes.end()}));
    return out;
  }
  /// Findings of `rule` from building and from the selections.
  std::size_t findings(RuleId rule) {
    std::size_t count = 0;
    for (const Findings* d : {&findings_, &selections().findings()})
      if (const auto it = d->counts().find(rule); it != d->counts().end()) count += it->second;
    return count;
  }
  /// Reference message number of the first finding of `rule`; 0: none.
  int message(RuleId rule) {
    for (const Findings* d : {&findings_, &selections().findings()})
      for (const Finding& x : d->all())
        if (x.rule == rule) return x.reference ? x.reference->number : 0;
    return -1;
  }

 private:
  Findings findings_;
  std::unique_ptr<Result<Deck>> deck_;
  Model model_;
};

/// A clause of a /SET, its ids over as many lines as they need.
inline std::string clause(const std::string& name, const Ids& ids) {
  std::string out = name;
  out.resize(10, ' ');
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (i > 0 && i % 9 == 0) out += "\n          ";
    char text[32];
    std::snprintf(text, sizeof text, "%10lld", static_cast<long long>(ids[i]));
    out += text;
  }
  return out + "\n";
}
inline std::string set(std::int64_t id, const std::string& clauses) {
  return "/SET/GENERAL/" + std::to_string(id) + "\nset\n" + clauses;
}

/// Parts 1, 2, 3 with shell property 1 (thickness 2), parts 4 and 5 with solid property 2, part 6
/// with truss property 3, material 1.
inline std::string parts() {
  std::string out = "/MAT/ELAST/1\nsteel\n" + reals({7.8e-6}) + reals({210, 0.3}) +
                    "/PROP/SHELL/1\nplate\n\n\n" + cells({0, 0}).substr(0, 20) +
                    "                   2\n" + "/PROP/SOLID/2\nblock\n\n\n" +
                    "/PROP/TRUSS/3\nrod\n" + reals({4}) + "/SUBSET/1\nall\n" + cells({2}) +
                    "/SUBSET/2\nsolids\n\n";
  const auto part = [](std::int64_t id, std::int64_t prop, std::int64_t subset) {
    return "/PART/" + std::to_string(id) + "\npart\n" + cells({prop, 1, subset});
  };
  return out + part(1, 1, 1) + part(2, 1, 1) + part(3, 1, 0) + part(4, 2, 2) + part(5, 2, 2) +
         part(6, 3, 0);
}

/// 3 x 3 nodes 1..9 in the plane z = 0, spacing 10; ids row by row.
inline std::string grid_nodes() {
  std::string out = "/NODE\n";
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) out += node(1 + x + 3 * y, 10 * x, 10 * y, 0);
  return out;
}

/// Shells 1..4 on these nodes, in parts 1 (1, 2) and 2 (3, 4).
inline std::string quads() {
  return grid_nodes() + "/SHELL/1\n" + cells({1, 1, 2, 5, 4}) + cells({2, 2, 3, 6, 5}) +
         "/SHELL/2\n" + cells({3, 4, 5, 8, 7}) + cells({4, 5, 6, 9, 8});
}

/// Nodes 101..112 of two unit cubes side by side in x.
inline std::string cube_nodes() {
  std::string out = "/NODE\n";
  for (int z = 0; z < 2; ++z)
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 3; ++x) out += node(101 + x + 3 * y + 6 * z, x, y, z);
  return out;
}
/// The two bricks on cube_nodes(): 1 in part 4, 2 in part 5.
inline std::string cubes() {
  return "/BRICK/4\n" + cells({1, 101, 102, 105, 104, 107, 108, 111, 110}) + "/BRICK/5\n" +
         cells({2, 102, 103, 106, 105, 108, 109, 112, 111});
}

}  // namespace deck::test
