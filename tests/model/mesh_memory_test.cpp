// MeshMemory: what is known of node and element blocks is what reading them would give, and
// whatever decides about it is looked at.
#include "deck/model/mesh_memory.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "keyword/reading.hpp"

namespace deck {
namespace {

using namespace testing_support;

std::string cells(std::initializer_list<int> values) {
  std::string line;
  for (const int v : values) {
    const std::string text = std::to_string(v);
    line += std::string(10 - text.size(), ' ') + text;
  }
  return line + "\n";
}

/// One line each; with a thickness in the last shell.
struct Lines {
  std::string before, node = cells({1}) + cells({2}) + cells({3}) + cells({4});
  std::string parts = part(1) + part(2);
  std::string elements = "/SHELL/2\n" + cells({1, 1, 2, 3, 4}) + "/SH3N/1\n" + cells({5, 2, 3, 4}) +
                         "/BRICK/1\n" + cells({7, 1, 2, 3, 4, 1, 2, 3, 4}) + "/TETRA10/2\n" +
                         cells({9}) + cells({1, 2, 3, 4});
  std::string coordinate = "                 2.5";

  static std::string part(int id) {
    return "/PART/" + std::to_string(id) + "\np\n" + cells({1, 1});
  }
  std::string text() const {
    std::string rows;
    double at = 0;
    for (std::size_t i = 0; i < node.size(); i += 11) {
      at += 1.5;
      rows += node.substr(i, 10) + coordinate + "                " +
              std::to_string(at).substr(0, 4) + "                 7.0\n";
    }
    return deck_of(before + parts + "/NODE\n" + rows + elements);
  }
};

/// Two models of two decks, compared in all that is read of nodes and elements.
struct Read {
  Read(const std::string& text, MeshMemory* memory, int threads = 1) : deck(read(text)) {
    ModelOptions options;
    options.threads = threads;
    model = build_model(deck, SchemaSet::built_in(), findings, options, memory);
  }
  Deck deck;
  Diagnostics findings;
  Model model;
};

void expect_same(const Read& a, const Read& b, const std::string& what) {
  SCOPED_TRACE(what);
  EXPECT_EQ(a.model.nodes.id, b.model.nodes.id);
  EXPECT_EQ(a.model.nodes.x, b.model.nodes.x);
  EXPECT_EQ(a.model.nodes.y, b.model.nodes.y);
  EXPECT_EQ(a.model.nodes.z, b.model.nodes.z);
  const auto ranges = [](const std::vector<BulkBlock>& blocks) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
    for (const BulkBlock& r : blocks) out.emplace_back(r.first, r.count);
    return out;
  };
  EXPECT_EQ(ranges(a.model.node_blocks), ranges(b.model.node_blocks));
  EXPECT_EQ(ranges(a.model.element_blocks), ranges(b.model.element_blocks));
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3, ElementKind::solid8}) {
    const Elements &f = a.model.family(kind), &g = b.model.family(kind);
    EXPECT_EQ(f.id, g.id);
    EXPECT_EQ(f.part, g.part);
    EXPECT_EQ(f.nodes, g.nodes);
    EXPECT_EQ(f.thickness, g.thickness);
    EXPECT_EQ(f.shape, g.shape);
    EXPECT_EQ(f.extra, g.extra);
    EXPECT_EQ(f.extra_nodes, g.extra_nodes);
    EXPECT_EQ(f.block, g.block);
  }
  EXPECT_EQ(a.findings.counts(), b.findings.counts());
  const auto messages = [](const Diagnostics& findings) {
    std::vector<std::string> out;
    for (const Diagnostic& d : findings.all()) out.push_back(d.message);
    return out;
  };
  EXPECT_EQ(messages(a.findings), messages(b.findings));
}

TEST(MeshMemory, TheSameLinesAreReadOnce) {
  const std::string text = Lines().text();
  const Read alone(text, nullptr);
  ASSERT_EQ(alone.model.nodes.size(), 4u);
  ASSERT_EQ(alone.model.solid8.size(), 2u);
  for (const int threads : {1, 3}) {
    MeshMemory memory;
    for (std::size_t turn = 0; turn < 3; ++turn) {
      expect_same(Read(text, &memory, threads), alone, std::to_string(turn));
      EXPECT_EQ(memory.misses(), 4u);
      EXPECT_EQ(memory.hits(), 4 * turn);
    }
  }
}

TEST(MeshMemory, WhateverDecidesIsLookedAt) {
  const Lines known;
  const std::vector<std::function<void(Lines&)>> changes = {
      [](Lines& l) { l.coordinate = "                 2.6"; },
      // The nodes in another order, and one more before them.
      [](Lines& l) { l.node = cells({4}) + cells({3}) + cells({2}) + cells({1}); },
      [](Lines& l) { l.before = "/NODE\n" + cells({9}); },
      // Parts in another order; one that is not there.
      [](Lines& l) { l.parts = Lines::part(2) + Lines::part(1); },
      [](Lines& l) { l.parts = Lines::part(2); },
      // The same lines as another block, of another part, of another keyword.
      [](Lines& l) {
        l.elements = "/SHELL/1\n" + cells({20, 4, 3, 2, 1}) + l.elements;
      },
      [](Lines& l) { l.elements.replace(l.elements.find("/SHELL/2"), 8, "/SHELL/1"); },
      [](Lines& l) { l.elements.replace(l.elements.find("/SHELL/2"), 8, "/SPRING/2"); },
      [](Lines& l) { l.elements.replace(l.elements.find("/BRICK"), 6, "/SHEL16"); },
      // Ids that are offset.
      [](Lines& l) {
        l.before = "//SUBMODEL/1\ns\n" + cells({100, 0, 0, 0});
        l.elements += "//ENDSUB\n";
      },
      [](Lines& l) {
        l.before = "//SUBMODEL/1\ns\n" + cells({0, 100, 0, 0});
        l.elements += "//ENDSUB\n";
      },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    MeshMemory memory;
    (void)Read(known.text(), &memory);
    Lines other;
    changes[i](other);
    const std::size_t misses = memory.misses();
    expect_same(Read(other.text(), &memory), Read(other.text(), nullptr), std::to_string(i));
    EXPECT_GT(memory.misses(), misses) << i;
  }
  // Units of the deck.
  MeshMemory memory;
  (void)Read(known.text(), &memory);
  std::string text = known.text();
  const std::string units = "                  kg                  mm                  ms\n";
  text.replace(text.find(units), units.size(),
               "                  kg                   m                  ms\n");
  const Read alone(text, nullptr);
  EXPECT_NE(alone.model.nodes.x, Read(known.text(), nullptr).model.nodes.x);
  expect_same(Read(text, &memory), alone, "metres");
}

TEST(MeshMemory, OffsetsOfASubmodelAreLookedAt) {
  MeshMemory memory;
  std::vector<std::vector<NodeIndex>> corners;
  for (const auto& offsets : {cells({0, 0, 0, 0}), cells({0, 100, 0, 0}), cells({0, 0, 300, 0})}) {
    Lines lines;
    for (const int id : {101, 102, 103, 104}) lines.node += cells({id});
    lines.elements = "//SUBMODEL/1\ns\n" + offsets + lines.elements + "//ENDSUB\n";
    const Read alone(lines.text(), nullptr);
    ASSERT_EQ(alone.model.nodes.size(), 8u);
    expect_same(Read(lines.text(), &memory), alone, offsets);
    corners.push_back(alone.model.shell4.nodes);
  }
  EXPECT_NE(corners[0], corners[1]);
}

TEST(MeshMemory, LinesWithFindingsAndParametersAreReadEveryTime) {
  Lines lines;
  lines.elements.replace(lines.elements.find("         3         4\n"), 20,
                         "         3        99\n");
  lines.coordinate = "               2.x5";
  lines.coordinate += " ";
  MeshMemory memory;
  const Read alone(lines.text(), nullptr);
  EXPECT_GT(count(alone.findings, RuleId::DK101), 0u);
  for (int turn = 0; turn < 2; ++turn)
    expect_same(Read(lines.text(), &memory), alone, std::to_string(turn));

  Lines other;
  other.coordinate = "                  &X";
  const auto with = [&](const char* value) {
    other.before =
        std::string("/PARAMETER/GLOBAL/REAL/1\nt\nX                          ") + value + "\n";
    return other.text();
  };
  for (const char* value : {"2.5", "3.5"}) {
    const Read read(with(value), &memory);
    EXPECT_EQ(read.model.nodes.x.at(0), std::atof(value));
    expect_same(read, Read(with(value), nullptr), value);
  }
}

}  // namespace
}  // namespace deck
