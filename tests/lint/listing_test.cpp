// Messages that the solver prints about shells, vent holes and files beside the deck.
#include "lint/support.hpp"
#include "report/shared/findings.hpp"

namespace deck {
namespace {

using test::lint_example;
using test::lint_geometry;

/// A property with N points and a part of it with this material; the part has one element if told.
std::string sheet(int id, int points, int material, bool element = true) {
  const std::string n = std::to_string(id);
  const auto cell = [](int v) {
    return std::string(10 - std::to_string(v).size(), ' ') + std::to_string(v);
  };
  return "/PROP/SHELL/" + n + "\nsheet\n        24         0         0         0\n" +
         std::string(18, ' ') + "0.\n" + cell(points) + "                           1.0\n/PART/" +
         n + "\nsheet\n" + cell(id) + cell(material) + "         0\n" +
         (element ? "/SHELL/" + n + "\n" + cell(id) + "         1         2         3         4\n"
                  : std::string());
}

constexpr std::string_view plastic = R"(/MAT/PLAS_JOHNS/7
metal
             7.8e-06
               210.0                 0.3
                 0.2                 0.5                 0.5
)";

TEST(GlobalIntegration, IsToldOncePerPropertyAndLaw) {
  const std::string second =
      "/MAT/PLAS_JOHNS/8\nother\n             7.8e-06\n"
      "               210.0                 0.3\n                 0.3\n";
  const auto run = lint_example(std::string(plastic) + second + sheet(5, 0, 7) + sheet(6, 0, 8) +
                                "/PART/9\nsame law\n         5         8         0\n"
                                "/SHELL/9\n         9         1         2         3         4\n");
  EXPECT_EQ(run.count(RuleId::DK600), 2u) << run.list();
}

TEST(GlobalIntegration, IsNotToldOfAPropertyWithoutElements) {
  const auto run = lint_example(std::string(plastic) + sheet(5, 0, 7, false));
  EXPECT_FALSE(run.fires(RuleId::DK600)) << run.list();
}

TEST(PlainTriangles, TakeIshellFromTheDefault) {
  const std::string_view deck = R"(/DEF_SHELL
         4         0         0         0         0                             1         0
/PROP/SHELL/5
takes the default
         0         0         0         0
/PROP/SHELL/6
has its own
        24         0         0         0
)";
  const auto run = lint_example(deck);
  ASSERT_EQ(run.count(RuleId::DK602), 1u) << run.list();
  EXPECT_EQ(run.find(RuleId::DK602)->id, 5);
}

TEST(MissingEngineFile, IsOfNoConcernWithoutTetrahedra) {
  const auto run = lint_geometry("@/INTER/TYPE7/1 Gapmin=1\n");
  EXPECT_FALSE(run.fires(RuleId::DK604)) << run.list();
}

TEST(BlankColumns, OfBeginAreNoFindingNorIsABlankInTheBanner) {
  const auto run = lint_example(
      "@deck\n# RADIOSS \n/BEGIN\nrun\n      2022         0                   1\n"
      "                  kg                  mm                  ms\n"
      "                  kg                  mm                  ms\n/END\n");
  EXPECT_FALSE(run.fires(RuleId::DK028)) << run.list();
  EXPECT_FALSE(run.fires(RuleId::DK001)) << run.list();
}

TEST(ShortBlocks, AreOneRemarkWhereBlankLinesWouldSayTheSame) {
  const auto run = lint_example("/PROP/TYPE25/5\nspring\n                 1.0\n");
  ASSERT_EQ(run.count(RuleId::DK029), 1u) << run.list();
  EXPECT_EQ(run.find(RuleId::DK029)->severity, Severity::info);
}

TEST(ValuesOfOtherVersions, AreOneFindingWithTheMessageOfTheirPlace) {
  const auto run = lint_example("@version 110\n/INTER/TYPE7/1\nlater\n         2         1\n" +
                                std::string(49, ' ') + "0.5\n\n                 1.0\n\n\n");
  const Finding* d = run.find(RuleId::DK047);
  ASSERT_NE(d, nullptr) << run.list();
  ASSERT_TRUE(d->reference);
  EXPECT_EQ(d->reference->number, 100213);  // nothing is read behind it
  EXPECT_FALSE(run.fires(RuleId::DK028)) << run.list();
}

TEST(ManyRemarksOfAKind, AreOneLineWithTheirNumber) {
  const auto run = lint_example(sheet(5, 3, 1) + sheet(6, 3, 1) + sheet(7, 3, 1));
  ASSERT_EQ(run.count(RuleId::DK601), 4u) << run.list();  // and the sheets of the example
  const std::vector<LintedDeck> decks = {{"deck_0000.rad", run.deck, &run.result, {}}};
  const std::string text = lint_human(decks, {});
  EXPECT_NE(text.find("info[DK601]: 4 places: elastic shells fall back to global integration "
                      "(solver: warning 1084)"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("/PROP/SHELL 6 has N = 3"), std::string::npos) << text;
  const std::string all = lint_human(decks, {.per_rule = 0, .group = false});
  EXPECT_NE(all.find("/PROP/SHELL 6 has N = 3"), std::string::npos) << all;
}

}  // namespace
}  // namespace deck
