// The model as a whole: parts and what they refer to, properties, run options, places in the file.
#include "model/selection_deck.hpp"

#include <cstdlib>
#include <filesystem>

#include "model/shared/families.hpp"
#include "model/shared/item_spans.hpp"
#include "where.hpp"

namespace deck::test {
namespace {

std::string quad() { return grid_nodes() + "/SHELL/1\n" + cells({7, 1, 2, 5, 4}); }

TEST(Part, KnowsPropertyAndMaterial) {
  BuiltModel b(parts() + quad());
  const Part& p = b.model().parts.at(b.model().part_of_id.at(4));
  EXPECT_EQ(b.model().properties.at(p.prop).id, 2);
  EXPECT_EQ(b.model().materials.at(p.mat).id, 1);
  EXPECT_TRUE(b.diagnostics().all().empty());
}

TEST(Part, MissingMaterialIsMessage179IfThereAreElementsOrAPropertyOfShells) {
  const std::string prop = "/PROP/VOID/1\np\n" + reals({1});
  for (const int material : {9, 0}) {
    BuiltModel used(quad() + prop + "/PART/1\np\n" + cells({1, material}));
    EXPECT_EQ(used.message(RuleId::DK103), 179) << material;
  }
  BuiltModel empty(grid_nodes() + prop + "/PART/1\np\n" + cells({1, 9}));
  EXPECT_EQ(empty.findings(RuleId::DK103), 0u);
  BuiltModel shells(parts() + grid_nodes() + "/PART/7\np\n" + cells({1, 9}));
  EXPECT_EQ(shells.message(RuleId::DK103), 179);
}

TEST(Part, SpringsNeedNoMaterial) {
  BuiltModel b(grid_nodes() + "/PROP/SPRING/1\np\n" + reals({1}) + reals({5}) + "/PART/1\np\n" +
               cells({1, 0}) + "/SPRING/1\n" + cells({1, 1, 2}));
  EXPECT_EQ(b.findings(RuleId::DK103), 0u);
}

TEST(Part, ElementsOfAMissingPartAreOneFindingPerPart) {
  BuiltModel b(parts() + grid_nodes() + "/SHELL/8\n" + cells({1, 1, 2, 5, 4}) +
               cells({2, 2, 3, 6, 5}) + "/SHELL/9\n" + cells({3, 4, 5, 8, 7}));
  EXPECT_EQ(b.findings(RuleId::DK104), 2u);
  EXPECT_EQ(b.message(RuleId::DK104), 402);
}

TEST(Part, AMissingOneCountsItsElementsFromTheFirstOn) {
  BuiltModel b(parts() + grid_nodes() + "/SHELL/8\n" + cells({1, 1, 2, 5, 4}));
  ASSERT_EQ(b.findings(RuleId::DK104), 1u);
  for (const Diagnostic& d : b.diagnostics().all())
    if (d.rule == RuleId::DK104) {
      EXPECT_EQ(d.message.find("1 "), 0u) << d.message;
    }
}

TEST(Part, ASpringPropertyExcusesAMaterialThatIsNotNamedNotOneThatIsMissing) {
  const auto findings = [](std::int64_t mat) {
    BuiltModel b(quad() + "/PROP/SPRING/1\np\n" + reals({1}) + reals({5}) + "/PART/1\np\n" +
                 cells({1, mat}));
    return b.findings(RuleId::DK103);
  };
  EXPECT_EQ(findings(0), 0u);
  EXPECT_EQ(findings(1), 1u);
}

TEST(Element, ThatNamesANodeTwiceIsMessage22Or681) {
  const auto message = [](const std::string& element) {
    BuiltModel b(parts() + grid_nodes() + element);
    return b.message(RuleId::DK136);
  };
  EXPECT_EQ(message("/SHELL/1\n" + cells({1, 1, 1, 2, 4})), 22);
  EXPECT_EQ(message("/SHELL/1\n" + cells({1, 1, 2, 5, 1})), 22);
  EXPECT_EQ(message("/SHELL/1\n" + cells({1, 1, 2, 5, 5})), -1) << "a triangle";
  EXPECT_EQ(message("/SPRING/1\n" + cells({1, 1, 1})), 681);
  EXPECT_EQ(message("/SPRING/1\n" + cells({1, 1, 2})), -1);
}

TEST(ModelFindings, CarryKeywordAndIdOfTheirBlock) {
  BuiltModel b(parts() + quad() + "/PROP/SHELL/7/5\np\n\n\n" + reals({3, 1}));
  for (const Diagnostic& d : b.diagnostics().all())
    if (d.rule == RuleId::DK109) {
      EXPECT_EQ(d.keyword, "/PROP/SHELL");
      EXPECT_EQ(d.id, 7);
    }
  EXPECT_EQ(b.findings(RuleId::DK109), 1u);
}

TEST(Shell, OfAStackHasTheThicknessOfItsPlies) {
  BuiltModel b("/MAT/ELAST/1\nm\n" + reals({1}) + reals({1, 0.3}) + "/PROP/TYPE17/1\np\n\n\n\n\n" +
               "/PART/1\np\n" + cells({1, 1}) + quad());
  EXPECT_EQ(b.findings(RuleId::DK106), 0u);
}

TEST(Shell, OwnThicknessIsEnough) {
  std::string line = cells({7, 1, 2, 5, 4});
  line.pop_back();
  line.resize(80, ' ');
  BuiltModel b("/MAT/ELAST/1\nm\n" + reals({1}) + reals({1, 0.3}) + "/PROP/SHELL/1\np\n\n\n\n" +
               "/PART/1\np\n" + cells({1, 1}) + grid_nodes() + "/SHELL/1\n" + line + reals({1.5}));
  EXPECT_EQ(b.findings(RuleId::DK106), 0u);
}

TEST(Node, SecondUseOfAnIdTellsWhetherTheCoordinatesAgree) {
  BuiltModel b("/NODE\n" + node(1, 0, 0, 0) + node(1, 0, 0, 0));
  ASSERT_EQ(b.findings(RuleId::DK105), 1u);
  std::string message;
  for (const Diagnostic& d : b.diagnostics().all())
    if (d.rule == RuleId::DK105) message = d.message;
  EXPECT_NE(message.find("same coordinates"), std::string::npos);
}

TEST(Property, ThicknessAndAreaAreInWorkingUnits) {
  BuiltModel b("/PROP/VOID/1\np\n" + reals({0.002}) + "/PROP/TRUSS/2\np\n" + reals({3e-6}),
               "kg m s");
  EXPECT_NEAR(b.model().properties[0].thickness, 2, 1e-14);
  EXPECT_NEAR(b.model().properties[1].area, 3, 1e-14);
}

TEST(Property, SpringStiffnessIsDividedByItsScale) {
  BuiltModel b("/PROP/SPRING/1\np\n" + reals({1}) + reals({5, 0, 2}));
  EXPECT_EQ(b.model().properties[0].stiffness[0], 2.5);
}

TEST(Property, OfAnAxisymmetricSpringHasTensionAndShear) {
  BuiltModel b("/PROP/SPR_AXI/1\np\n" + reals({1}) + reals({6, 0, 2}) + "\n\n" + reals({8, 0, 4}));
  EXPECT_EQ(b.model().properties.at(0).stiffness[0], 3);
  EXPECT_EQ(b.model().properties.at(0).stiffness[1], 2);
}

TEST(Property, NumberFollowsFromNameOrType) {
  BuiltModel b("/PROP/SH_ORTH/1\np\n\n\n\n\n/PROP/TYPE9/2\np\n\n\n\n\n");
  EXPECT_EQ(b.model().properties[0].number, 9);
  EXPECT_EQ(b.model().properties[1].number, 9);
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

TEST(Unit, UnknownUnitSystemIsOneFindingMessage643ForNodesAnd659Elsewhere) {
  BuiltModel b("/NODE/5\n" + node(1, 0, 0, 0));
  EXPECT_EQ(b.message(RuleId::DK109), 643);
  EXPECT_EQ(b.findings(RuleId::DK040), 0u) << "the keyword is known";
  BuiltModel g(grid_nodes() + "/SKEW/FIX/1/5\ns\n");
  EXPECT_EQ(g.message(RuleId::DK109), 659);
}

TEST(Unit, UnknownUnitSystemIsAnErrorWhereTheSolverLooksItUp) {
  const auto severity = [](const std::string& deck) {
    BuiltModel b(grid_nodes() + deck);
    for (const Diagnostic& d : b.diagnostics().all())
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

TEST(Place, OfANodeAndAnElementIsItsLine) {
  BuiltModel b(parts() + grid_nodes() + "# a comment\n" + node(50, 1, 2, 3) + "/SHELL/1\n" +
               cells({7, 1, 2, 5, 4}) + cells({8, 2, 3, 6, 5}));
  const Model& m = b.model();
  const auto text = [&](Span s) { return std::string(m.deck->sources.text(s).substr(0, 10)); };
  EXPECT_EQ(text(m.node_span(m.nodes.map.find(50))), "        50");
  EXPECT_EQ(text(m.element_span(ElementKind::shell4, m.shell4.map.find(8))), "         8");
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
  std::string nodes, again, shells, shells_again;
  for (int i = 1; i <= many; ++i) {
    const std::string line = node(i, i % 20, i / 20, 0);
    const std::string shell = cells({i, 1, 2, 3, 4});
    nodes += line;
    shells += shell;
    if (i <= many - repeated) continue;
    again += line;
    shells_again += shell;
  }
  const std::uint64_t before = deck::detail::items_walked();
  BuiltModel b(parts() + "/NODE\n" + nodes + "/SHELL/1\n" + shells + "/NODE\n" + again +
               "/SHELL/1\n" + shells_again);
  EXPECT_EQ(b.findings(RuleId::DK105), 2u * repeated);
  EXPECT_LE(deck::detail::items_walked() - before, 2u * (many + repeated));
  for (const Diagnostic& d : b.diagnostics().all()) {
    if (d.rule != RuleId::DK105) continue;
    const auto id = [&](const Span& s) { return b.model().deck->sources.text(s).substr(0, 10); };
    ASSERT_EQ(d.notes.size(), 1u);
    EXPECT_EQ(id(d.span), id(d.notes[0].first));
    EXPECT_LT(d.notes[0].first.offset, d.span.offset);
    EXPECT_EQ(id(d.span), cells({d.id}).substr(0, 10));
  }
}

TEST(Connectivity, RowsListElementsOnce) {
  BuiltModel b(parts() + grid_nodes() + "/SHELL/1\n" + cells({1, 1, 2, 5, 4}) +
               cells({2, 2, 3, 6, 5}) + "/SHELL/2\n" + cells({3, 4, 5, 5, 7}));
  const Model& m = b.model();
  const NodeElements rows = connect_nodes(m.shell4, m.nodes.size());
  const auto row = rows.row(m.nodes.map.find(5));
  EXPECT_EQ(std::vector<std::uint32_t>(row.begin(), row.end()),
            (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Connectivity, ElementsOfAPartAreRuns) {
  BuiltModel b(parts() + grid_nodes() + "/SHELL/1\n" + cells({1, 1, 2, 5, 4}) +
               cells({2, 2, 3, 6, 5}) + "/SHELL/2\n" + cells({3, 4, 5, 8, 7}) + "/SHELL/9\n" +
               cells({5, 4, 5, 8, 7}) + "/SHELL/1\n" + cells({4, 5, 6, 9, 8}));
  const Model& m = b.model();
  const PartElements parts = connect_parts(m.shell4, m.parts.size());
  const auto runs = [&](std::size_t part) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
    for (const ElementRun& run : parts.row(part)) out.emplace_back(run.first, run.end);
    return out;
  };
  using Runs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  EXPECT_EQ(runs(0), (Runs{{0, 3}}));
  EXPECT_EQ(runs(1), (Runs{{3, 4}}));
  EXPECT_TRUE(runs(2).empty());
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
    Diagnostics found;
    ModelOptions options;
    options.threads = threads;
    const Model m = build_model(*deck, SchemaSet::built_in(), found, options);
    std::vector<std::string> messages;
    for (const Diagnostic& d : found.all())
      messages.push_back(std::string(deck->sources.text(d.span)) + d.message);
    if (threads == 1) expected = messages;
    EXPECT_EQ(messages, expected) << threads;
  }
  const auto has = [&](const std::string& part) {
    for (const std::string& m : expected)
      if (m.find(part) != std::string::npos) return true;
    return false;
  };
  EXPECT_TRUE(has("9000 shells of part 9 have no thickness")) << expected.size();
  EXPECT_TRUE(has("first is element 81001"));
  EXPECT_TRUE(has("9 shells of part 1 have the same third and fourth node"));
  EXPECT_TRUE(has("first is element 9700"));
  EXPECT_TRUE(has("node 18001: Z is 1e+80"));
}

/// Every id of the groups of a real deck resolves without a finding about groups.
TEST(Corpus, DummyResolvesWithoutGroupErrors) {
  const std::string root = test::shared_dir().string();
  const std::string path = root + "/corpus/EuroSID_II/EuroSID_II_0000.rad";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no corpus at " << root;
  auto deck = read_deck(path, SchemaSet::built_in());
  ASSERT_TRUE(deck);
  Diagnostics found;
  const Model m = build_model(*deck, SchemaSet::built_in(), found);
  EXPECT_EQ(m.nodes.size(), 16296u);
  m.selections->resolve_all();
  for (const Diagnostic& d : m.selections->diagnostics().all())
    EXPECT_NE(d.severity, Severity::error) << d.message;
}

}  // namespace
}  // namespace deck::test
