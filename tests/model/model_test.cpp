// The model as a whole: parts and what they refer to, properties, run options, places in the file.
#include <gmock/gmock.h>

#include "model/selection_deck.hpp"
#include "model/shared/families.hpp"
#include "model/shared/item_spans.hpp"

namespace deck::test {
namespace {

std::string quad() { return grid_nodes() + "/SHELL/1\n" + cells({7, 1, 2, 5, 4}); }

TEST(ModelFindings, HaveTheMessageOfTheSolver) {
  const std::string void_part = "/PROP/VOID/1\np\n" + reals({1}) + "/PART/1\np\n";
  const std::string springs = "/PROP/SPRING/1\np\n" + reals({1}) + reals({5}) + "/PART/1\np\n";
  const std::string spring = "/SPRING/1\n" + cells({1, 1, 2});
  const std::string no_thickness = "/MAT/ELAST/1\nm\n" + reals({1}) + reals({1, 0.3}) +
                                   "/PROP/SHELL/1\np\n\n\n\n" + "/PART/1\np\n" + cells({1, 1}) +
                                   grid_nodes() + "/SHELL/1\n";
  constexpr int none = -1;
  struct Row {
    std::string blocks;
    RuleId rule;
    int message;
  };
  const Row rows[] = {
      // A material is missing: without elements that is a warning of the program alone.
      {quad() + void_part + cells({1, 9}), RuleId::DK103, 179},
      {quad() + void_part + cells({1, 0}), RuleId::DK103, 179},
      {grid_nodes() + void_part + cells({1, 9}), RuleId::DK103, 0},
      {parts() + grid_nodes() + "/PART/7\np\n" + cells({1, 0}), RuleId::DK103, none},
      // Springs need none, but one that is named must be there.
      {grid_nodes() + springs + cells({1, 0}) + spring, RuleId::DK103, none},
      {quad() + springs + cells({1, 0}), RuleId::DK103, none},
      {quad() + springs + cells({1, 1}), RuleId::DK103, 179},
      {parts() + grid_nodes() + "/SHELL/8\n" + cells({1, 1, 2, 5, 4}), RuleId::DK104, 402},
      // An element that names a node twice.
      {parts() + quads() + "/SHELL/1\n" + cells({9, 1, 1, 2, 4}), RuleId::DK136, 22},
      {parts() + quads() + "/SHELL/1\n" + cells({9, 1, 2, 5, 1}), RuleId::DK136, 22},
      {parts() + quads() + "/SHELL/1\n" + cells({9, 1, 2, 5, 5}), RuleId::DK136, none},
      {parts() + quads() + "/SPRING/1\n" + cells({1, 1, 1}), RuleId::DK136, 681},
      {parts() + quads() + spring, RuleId::DK136, none},
      // A unit system that is not there; the keyword of the nodes is known.
      {"/NODE/5\n" + node(1, 0, 0, 0), RuleId::DK109, 643},
      {"/NODE/5\n" + node(1, 0, 0, 0), RuleId::DK040, none},
      {grid_nodes() + "/SKEW/FIX/1/5\ns\n", RuleId::DK109, 659},
      // Thickness of the plies of a stack.
      {"/MAT/ELAST/1\nm\n" + reals({1}) + reals({1, 0.3}) + "/PROP/TYPE17/1\np\n\n\n\n\n\n" +
           "/PART/1\np\n" + cells({1, 1}) + quad(),
       RuleId::DK106, none},
      // Its own thickness is enough.
      {no_thickness + "         7         1         2         5         4" + std::string(30, ' ') +
           reals({1.5}),
       RuleId::DK106, none},
      {no_thickness + cells({7, 1, 2, 5, 4}), RuleId::DK106, 495},
  };
  for (const Row& r : rows) EXPECT_EQ(BuiltModel(r.blocks).message(r.rule), r.message) << r.blocks;
}

TEST(ModelFindings, OfElementsOfAMissingPartAreOnePerPart) {
  BuiltModel b(parts() + grid_nodes() + "/SHELL/8\n" + cells({1, 1, 2, 5, 4}) +
               cells({2, 2, 3, 6, 5}) + "/SHELL/9\n" + cells({3, 4, 5, 8, 7}));
  std::vector<std::string> counts;
  for (const Finding& d : b.findings().all())
    if (d.rule == RuleId::DK104) counts.push_back(d.message.substr(0, 2));
  EXPECT_EQ(counts, (std::vector<std::string>{"2 ", "1 "}));
}

TEST(ModelFindings, CarryKeywordAndIdOfTheirBlock) {
  BuiltModel b(parts() + quad() + "/PROP/SHELL/7/5\np\n\n\n" + reals({3, 1}));
  for (const Finding& d : b.findings().all())
    if (d.rule == RuleId::DK109) {
      EXPECT_EQ(d.keyword, "/PROP/SHELL");
      EXPECT_EQ(d.id, 7);
    }
  EXPECT_EQ(b.findings(RuleId::DK109), 1u);
}

TEST(Property, HasItsValuesInWorkingUnits) {
  BuiltModel b("/PROP/VOID/1\np\n" + reals({0.002}) + "/PROP/TRUSS/2\np\n" + reals({3e-6}) +
                   "/PROP/SH_ORTH/3\np\n\n\n\n\n/PROP/TYPE9/4\np\n\n\n\n\n",
               "kg m s");
  const auto& p = b.model().properties;
  EXPECT_NEAR(p.at(0).thickness, 2, 1e-14);
  EXPECT_NEAR(p.at(1).area, 3, 1e-14);
  EXPECT_EQ(p.at(2).number, 9);
  EXPECT_EQ(p.at(3).number, 9);
  BuiltModel springs("/PROP/SPRING/1\np\n" + reals({1}) + reals({5, 0, 2}) +
                     "/PROP/SPR_AXI/2\np\n" + reals({1}) + reals({6, 0, 2}) + "\n\n" +
                     reals({8, 0, 4}));
  EXPECT_EQ(springs.model().properties.at(0).stiffness[0], 2.5) << "divided by its scale";
  EXPECT_EQ(springs.model().properties.at(1).stiffness[0], 3) << "tension";
  EXPECT_EQ(springs.model().properties.at(1).stiffness[1], 2) << "shear";
}

TEST(Run, OptionsOfTheWholeRun) {
  BuiltModel b(grid_nodes() + "/INTTHICK/V5\n/RANDOM\n" + reals({0.25}) +
               "/MONVOL/AIRBAG1/1\nm\n\n/ALE/MAT/1\n\n");
  EXPECT_TRUE(b.model().intthick_v5);
  EXPECT_TRUE(b.model().has_random);
  EXPECT_EQ(b.model().random_noise, 0.25);
  EXPECT_TRUE(b.model().has_monitored_volume);
  EXPECT_TRUE(b.model().has_ale);
  EXPECT_FALSE(b.model().two_dimensional);
}

TEST(Curve, PointsAndScaling) {
  BuiltModel b("/FUNCT/4\nf\n" + reals({0, 1}) + reals({2, 5}) + "/MOVE_FUNCT/4\nm\n" +
               reals({10, 0, 1, 0}));
  const Curve& c = b.model().curves.at(4);
  EXPECT_EQ(c.x, (std::vector<double>{1, 21}));
  EXPECT_EQ(c.y, (std::vector<double>{1, 5}));
}

TEST(ConnectionNode, HasItsToleranceInTheUnitsOfTheDeck) {
  BuiltModel b("/NODE\n" + node(1, 0, 0, 0) + node(2, 10, 0, 0) + "/CNODE/0.001\n" +
                   node(50, 0.0009, 0, 0) + node(51, 10.0011, 0, 0) + "/GRNOD/NODE/1\ng\n" +
                   cells({50, 51}),
               "kg m s");
  EXPECT_EQ(b.model().nodes.x.at(1), 10'000.0);
  EXPECT_EQ(b.group(1), (Ids{1, 51})) << "a tolerance of 1 mm";
}

TEST(Unit, UnknownUnitSystemIsAnErrorWhereTheSolverLooksItUp) {
  const auto severity = [](const std::string& deck) {
    BuiltModel b(grid_nodes() + deck);
    for (const Finding& d : b.findings().all())
      if (d.rule == RuleId::DK109) return d.severity;
    return Severity::info;
  };
  for (const char* block : {"/GRNOD/NODE/1/5\ng\n", "/BCS/1/5\nb\n", "/PART/1/5\np\n",
                            "/ADMAS/0/1/5\na\n", "/TRANSFORM/TRA/1/5\nt\n", "/DAMP/1/5\nd\n"})
    EXPECT_EQ(severity(block), Severity::warning) << block;
  for (const char* block : {"/SKEW/FIX/1/5\ns\n", "/SURF/SEG/1/5\ns\n", "/GRAV/1/5\ng\n",
                            "/RWALL/SPHER/1/5\nw\n", "/INTER/TYPE24/1/5\ni\n", "/CONVEC/1/5\nc\n"})
    EXPECT_EQ(severity(block), Severity::error) << block;
}

TEST(Order, IsByFileIdAndRowAndPlacesAreStillThoseOfTheText) {
  BuiltModel b("/NODE\n" + node(9, 9, 0, 0) + node(2, 2, 0, 0) + "/NODE\n" + node(5, 5, 0, 0) +
               node(1, 1, 1, 0) + node(3, 3, 1, 0) + "/SHELL/2\n" + cells({8, 1, 2, 3, 5}) +
               "/SHELL/1\n" + cells({7, 2, 5, 9, 3}) + cells({4, 1, 2, 3, 5}) + parts());
  const Model& m = b.model();
  EXPECT_EQ(m.nodes.id, (std::vector<std::int64_t>{1, 2, 3, 5, 9}));
  EXPECT_EQ(m.nodes.x, (std::vector<double>{1, 2, 3, 5, 9}));
  EXPECT_EQ(m.shell4.id, (std::vector<std::int64_t>{4, 7, 8}));
  const auto id = [&](Span s) { return std::stoll(std::string(m.deck->sources.text(s))); };
  for (NodeIndex n = 0; n < m.nodes.size(); ++n) EXPECT_EQ(id(m.node_span(n)), m.nodes.id[n]);
  for (std::uint32_t e = 0; e < m.shell4.size(); ++e) {
    EXPECT_EQ(id(m.element_span(ElementKind::shell4, e)), m.shell4.id[e]);
    EXPECT_EQ(m.element_blocks[m.shell4.block[e]].block->id.value, m.parts[m.shell4.part[e]].id);
  }
}

TEST(Place, OfRepeatedIdsIsFoundByOneWalkOfEachBlock) {
  constexpr int many = 400, repeated = 50;
  std::string nodes = "/NODE\n", again = nodes;
  for (int i = 1; i <= many; ++i) {
    nodes += node(i, i % 20, i / 20, 0);
    if (i > many - repeated) again += node(i, i % 20, i / 20, 0);
  }
  const std::uint64_t before = deck::detail::items_walked();
  BuiltModel b(nodes + again);
  EXPECT_EQ(b.findings(RuleId::DK105), repeated);
  EXPECT_LE(deck::detail::items_walked() - before, many + repeated);
  for (const Finding& d : b.findings().all()) {
    if (d.rule != RuleId::DK105) continue;
    const auto id = [&](const Span& s) { return b.model().deck->sources.text(s).substr(0, 10); };
    ASSERT_EQ(d.notes.size(), 1u);
    EXPECT_EQ(id(d.span), id(d.notes[0].first));
    EXPECT_LT(d.notes[0].first.offset, d.span.offset);
    EXPECT_EQ(id(d.span), cells({d.id}).substr(0, 10));
    EXPECT_NE(d.message.find("same coordinates"), std::string::npos);
  }
}

TEST(Model, FindingsAboutElementsAreTheSameForAnyNumberOfThreads) {
  std::string text = parts() + "/PROP/SHELL/9\nno thickness\n\n\n" + cells({0, 0}).substr(0, 20) +
                     "                   0\n/PART/9\np\n" + cells({9, 1}) + "/NODE\n";
  constexpr std::int64_t count = 9000;  // above what is worth a thread
  for (std::int64_t i = 0; i <= 2 * count; ++i)
    text += node(i + 1, static_cast<double>(i), i % 2 == 0 ? 0 : 1, i == 2 * count ? 1e80 : 0);
  for (const std::int64_t part : {1, 9}) {
    text += "/SHELL/" + std::to_string(part) + "\n";
    for (std::int64_t i = 1; i <= count; ++i)
      text += cells({part * count + i, i, i + 1, i + 3, i % 1000 == 700 ? i + 3 : i + 2});
  }
  const auto deck = read_deck_text("test_0000.rad", deck_text(text), SchemaSet::built_in());
  ASSERT_TRUE(deck);
  std::vector<std::string> expected;
  for (const int threads : {1, 2, 3, 7}) {
    Findings found;
    ModelOptions options;
    options.threads = threads;
    const Model m = build_model(*deck, SchemaSet::built_in(), found, options);
    std::vector<std::string> messages;
    for (const Finding& d : found.all())
      messages.push_back(std::string(deck->sources.text(d.span)) + d.message);
    if (threads == 1) expected = messages;
    EXPECT_EQ(messages, expected) << threads;
  }
  for (const char* part : {"9000 shells of part 9 have no thickness", "first is element 81001",
                           "9 shells of part 1 have the same third and fourth node",
                           "first is element 9700", "node 18001: Z is 1e+80"})
    EXPECT_THAT(expected, testing::Contains(testing::HasSubstr(part)));
}

}  // namespace
}  // namespace deck::test
