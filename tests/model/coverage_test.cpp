// What a verdict says about interfaces that were not examined, and about files that were missing.
#include "deck/model.hpp"

#include <gtest/gtest.h>

namespace deck {
namespace {

Coverage coverage(const std::string& blocks) {
  const std::string text =
      "#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n" + blocks + "/END\n";
  auto deck = read_deck_text("test_0000.rad", text, SchemaSet::built_in());
  EXPECT_TRUE(deck.ok());
  Diagnostics diagnostics;
  return coverage_of(*deck, read_interfaces(*deck, Model{}, diagnostics));
}

const std::string type7 = "/INTER/TYPE7/3\ncontact\n\n\n\n\n\n\n";

TEST(Coverage, NamesInterfacesOfOtherTypesWithCountAndIds) {
  const Coverage c =
      coverage(type7 + "/INTER/TYPE2/9\na\n/INTER/TYPE23/4\na\n/INTER/TYPE23/6\na\n");
  EXPECT_EQ(c.examined, 1u);
  ASSERT_EQ(c.not_examined.size(), 2u);
  EXPECT_EQ(c.not_examined[1].keyword, "/INTER/TYPE23");
  EXPECT_EQ(c.not_examined[1].ids, (std::vector<std::int64_t>{4, 6}));
  EXPECT_EQ(coverage_lead(c), "") << "something was examined";
  EXPECT_EQ(coverage_tail(c),
            " Not examined: 1 interface of TYPE2 (id 9), 2 interfaces of TYPE23 (ids 4, 6).");
}

TEST(Coverage, ComesFirstWhereNothingWasExamined) {
  const Coverage c = coverage("/INTER/TYPE23/4\na\n/INTER/TYPE23/5\na\n/INTER/5\na\n");
  EXPECT_EQ(coverage_lead(c),
            "Nothing examined: 1 interface of /INTER (id 5), 2 interfaces of TYPE23 (ids 4, 5).");
  EXPECT_EQ(coverage_tail(c), "") << "said already";
  std::string many;
  for (int i = 1; i <= 25; ++i) many += "/INTER/TYPE22/" + std::to_string(i) + "\na\n";
  EXPECT_NE(coverage_lead(coverage(many)).find("9, 10 and 15 more"), std::string::npos);
  EXPECT_EQ(coverage_lead(coverage("/TITLE\nx\n/INTER/SUB/1\na\n")),
            "Nothing examined: the deck has no contact interface.");
}

TEST(Coverage, NoVerdictWithoutAllFiles) {
  const Coverage c = coverage(type7 + "#include nowhere.inc\n");
  EXPECT_FALSE(c.complete());
  EXPECT_NE(coverage_lead(c).find("No verdict: the model is incomplete, '"), std::string::npos);
  EXPECT_NE(coverage_lead(c).find("nowhere.inc"), std::string::npos);
}

}  // namespace
}  // namespace deck
