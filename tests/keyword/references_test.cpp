// Which ids a block names, of what kind, and the blocks that define them.
#include "keyword/shared/references.hpp"

#include "keyword/reading.hpp"

namespace deck {
namespace {

using testing_support::block;
using testing_support::deck_of;

struct Named {
  explicit Named(const std::string& cards, const std::string& version = "2024")
      : deck(testing_support::read(deck_of(cards, version))) {}
  /// "kind id", "kind first-last/step".
  std::vector<std::string> by(std::string_view header) const {
    std::vector<std::string> out;
    for (const Reference& r : references_of(deck, *block(deck, header))) {
      std::string text = std::string(r.kind) + " " + (r.minus ? "-" : "") + std::to_string(r.id);
      if (r.step != 0) text += "-" + std::to_string(r.last) + "/" + std::to_string(r.step);
      out.push_back(text);
    }
    return out;
  }
  Deck deck;
};
using Texts = std::vector<std::string>;

TEST(References, AreTheIdsOfCellsWithTheKindsOfTheirFields) {
  const Named d(
      "/PART/1\np\n         2         3         4\n/GRNOD/NODE/7\ng\n        10       -11\n");
  EXPECT_EQ(d.by("/PART/1"), (Texts{"prop 2", "mat 3", "subset 4"}));
  EXPECT_EQ(d.by("/GRNOD/NODE/7"), (Texts{"node 10", "node -11"}));
}

TEST(References, RangesHaveAFirstALastAndAStep) {
  const Named d(
      "/GRNOD/GENE/1\ng\n         1         5        10        12\n"
      "/GRNOD/GEN_INCR/2\ng\n         1         9         2\n        20        30         0\n");
  EXPECT_EQ(d.by("/GRNOD/GENE/1"), (Texts{"node 1-5/1", "node 10-12/1"}));
  EXPECT_EQ(d.by("/GRNOD/GEN_INCR/2"), (Texts{"node 1-9/2", "node 20-30/1"})) << "a step of 0 is 1";
}

TEST(References, CoverTheMembersOfTheirRangeAlone) {
  const Named d("/GRNOD/GEN_INCR/2\ng\n         3         9         2\n");
  const auto all = references_of(d.deck, *block(d.deck, "/GRNOD/GEN_INCR/2"));
  ASSERT_EQ(all.size(), 1u);
  for (const std::int64_t id : {1, 2, 3, 4, 5, 7, 9, 11})
    EXPECT_EQ(all[0].covers(id), id >= 3 && id <= 9 && id % 2 == 1) << id;
}

TEST(References, ClausesOfSetsSayTheKind) {
  const Named d(
      "/SET/GENERAL/1\ns\nPART               2         3\nNODE_G             1         9         "
      "2\n"
      "SEG                7        10        20        40        30\nRBODY              5\n");
  EXPECT_EQ(d.by("/SET/GENERAL/1"),
            (Texts{"part 2", "part 3", "node 1-9/2", "node 10", "node 20", "node 40", "node 30"}))
      << "the first number of a segment is its own, and rigid bodies have no kind";
}

TEST(References, SmoothedSurfaceStandsInThePlaceOfTheNodeGroup) {
  std::string lines = "/INTER/TYPE7/1\ni\n         4         5\n";
  const std::string smoothed = std::string(90, ' ') + "         1\n";
  EXPECT_EQ(Named(lines + "\n", "2026").by("/INTER/TYPE7/1"), (Texts{"grnod 4", "surf 5"}));
  EXPECT_EQ(Named(lines + smoothed, "2026").by("/INTER/TYPE7/1"), (Texts{"surf 4", "surf 5"}));
}

TEST(References, HeadersNameMaterialsAndParts) {
  const Named d(
      "/HEAT/MAT/3\n                   1\n/SHELL/8\n         1         1         2         3       "
      "  4\n");
  EXPECT_EQ(d.by("/HEAT/MAT/3"), Texts{"mat 3"});
  EXPECT_EQ(d.by("/SHELL/8"), Texts{"part 8"}) << "of elements only the header's";
}

TEST(Definitions, AreFoundByKindAndIdWithTheOffsetOfTheirSubmodel) {
  const Named d(
      "/GRNOD/NODE/1\ng\n         1\n//SUBMODEL/1\ns\n      1000      1000      1000      1000"
      "      1000      1000      1000\n/GRNOD/NODE/2\ng\n         1\n//ENDSUB\n"
      "/SET/GENERAL/9\ns\nPART               2\n");
  const Definitions definitions(d.deck);
  ASSERT_NE(definitions.find("grnod", 1), nullptr);
  EXPECT_EQ(definitions.find("surf", 1), nullptr);
  EXPECT_EQ(definitions.find("grnod", 2), nullptr) << "its submodel has an offset";
  const Block* inner = definitions.find("grnod", 1002);
  ASSERT_NE(inner, nullptr);
  EXPECT_EQ(id_of(d.deck, *inner), 1002);
  const Block* set = definitions.find("surf", 9);
  ASSERT_NE(set, nullptr) << "a set may stand for a surface";
  EXPECT_EQ(set->schema->kind, "set");
  EXPECT_EQ(definitions.find("part", 9), nullptr) << "but for no part";
  EXPECT_EQ(definitions.with_id(9).size(), 1u);
}

}  // namespace
}  // namespace deck
