// Which ids a block names, of what kind, and the blocks that define them.
#include "keyword/shared/references.hpp"

#include "keyword/reading.hpp"

namespace deck {
namespace {

using testing_support::block;
using testing_support::deck_of;
using testing_support::read;

using Texts = std::vector<std::string>;

/// "kind id", "kind first-last/step".
Texts named_by(const Deck& deck, std::string_view header) {
  Texts out;
  for (const Reference& r : references_of(deck, *block(deck, header))) {
    std::string text = std::string(r.kind) + " " + (r.minus ? "-" : "") + std::to_string(r.id);
    if (r.step != 0) text += "-" + std::to_string(r.last) + "/" + std::to_string(r.step);
    out.push_back(text);
  }
  return out;
}

TEST(References, HaveTheKindsOfTheirFieldsHeadersAndClauses) {
  struct Row {
    std::string header, lines;
    Texts named;
  };
  const std::string sides = "i\n         4         5\n";
  const Row rows[] = {
      {"/PART/1", "p\n         2         3         4\n", {"prop 2", "mat 3", "subset 4"}},
      {"/GRNOD/NODE/7", "g\n        10       -11\n", {"node 10", "node -11"}},
      {"/GRNOD/GENE/1",
       "g\n         1         5        10        12\n",
       {"node 1-5/1", "node 10-12/1"}},
      // A step of 0 is 1.
      {"/GRNOD/GEN_INCR/2",
       "g\n         1         9         2\n        20        30         0\n",
       {"node 1-9/2", "node 20-30/1"}},
      // The first number of a segment is its own, and rigid bodies have no kind.
      {"/SET/GENERAL/1",
       "s\nPART               2         3\nNODE_G             1         9         2\n"
       "SEG                7        10        20        40        30\nRBODY              5\n",
       {"part 2", "part 3", "node 1-9/2", "node 10", "node 20", "node 40", "node 30"}},
      // A smoothed surface stands in the place of the group of nodes.
      {"/INTER/TYPE7/1", sides + "\n", {"grnod 4", "surf 5"}},
      {"/INTER/TYPE7/1", sides + std::string(90, ' ') + "         1\n", {"surf 4", "surf 5"}},
      {"/HEAT/MAT/3", "                   1\n", {"mat 3"}},
      {"/SHELL/8", "         1         1         2         3         4\n", {"part 8"}},
  };
  for (const Row& r : rows)
    EXPECT_EQ(named_by(read(deck_of(r.header + "\n" + r.lines, "2026")), r.header), r.named)
        << r.header;
}

TEST(References, CoverTheMembersOfTheirRangeAlone) {
  const Deck d = read(deck_of("/GRNOD/GEN_INCR/2\ng\n         3         9         2\n"));
  const auto all = references_of(d, *block(d, "/GRNOD/GEN_INCR/2"));
  ASSERT_EQ(all.size(), 1u);
  for (const std::int64_t id : {1, 2, 3, 4, 5, 7, 9, 11})
    EXPECT_EQ(all[0].covers(id), id >= 3 && id <= 9 && id % 2 == 1) << id;
}

TEST(Definitions, AreFoundByKindAndIdWithTheOffsetOfTheirSubmodel) {
  const Deck d = read(deck_of(
      "/GRNOD/NODE/1\ng\n         1\n//SUBMODEL/1\ns\n      1000      1000      1000      1000"
      "      1000      1000      1000\n/GRNOD/NODE/2\ng\n         1\n//ENDSUB\n"
      "/SET/GENERAL/9\ns\nPART               2\n"));
  const Definitions definitions(d);
  ASSERT_NE(definitions.find("grnod", 1), nullptr);
  EXPECT_EQ(definitions.find("surf", 1), nullptr);
  EXPECT_EQ(definitions.find("grnod", 2), nullptr) << "its submodel has an offset";
  const Block* inner = definitions.find("grnod", 1002);
  ASSERT_NE(inner, nullptr);
  EXPECT_EQ(id_of(d, *inner), 1002);
  const Block* set = definitions.find("surf", 9);
  ASSERT_NE(set, nullptr) << "a set may stand for a surface";
  EXPECT_EQ(set->schema->kind, "set");
  EXPECT_EQ(definitions.find("part", 9), nullptr) << "but for no part";
  EXPECT_EQ(definitions.with_id(9).size(), 1u);
}

}  // namespace
}  // namespace deck
