// Renumbering of ranges, of lines in free format, and of elements over two lines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../contact/small_deck.hpp"
#include "deck/edit/convert.hpp"
#include "edit/units_support.hpp"

namespace deck {
namespace {

using edit_test::Whole;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Rewrite numbered(const Whole& w, const std::vector<std::string>& texts, bool partial = false) {
  RenumberOptions options;
  options.partial = partial;
  for (const std::string& text : texts) options.rules.push_back(parse_renumber_rule(text).value());
  return renumber(w.context(), options);
}
Rewrite renamed(const Whole& w, const char* kind, std::int64_t id, std::int64_t now) {
  RenumberOptions options;
  options.rules = {{kind, false, now, id}};
  return renumber(w.context(), options);
}

/// Nodes 10, 20, 30, 40 with shell 7 of part 1, nodes 50 to 53 with shell 9 of part 2.
test::SmallDeck plates() {
  test::SmallDeck d;
  for (int i = 0; i < 4; ++i) d.node(10 * (i + 1), i % 2 * 10.0, i / 2 * 10.0, 0.0);
  for (int i = 0; i < 4; ++i) d.node(50 + i, i % 2 * 9.0, i / 2 * 9.0, 1.0);
  return d.shell_part(1, 1.5)
      .shell_part(2, 2.5)
      .shell(1, 7, 10, 20, 40, 30)
      .shell(2, 9, 50, 51, 53, 52);
}

/// The reasons of what stays as it is.
std::vector<std::string> open_reasons(const Whole& w, const std::vector<std::string>& rules) {
  std::vector<std::string> out;
  for (const LossEntry& e : numbered(w, rules, true).losses)
    if (e.loss == Loss::undecided) out.push_back(e.field + ": " + e.note);
  return out;
}

TEST(RenumberRanges, WithAnIncrementOneIdStaysInOrOut) {
  // 10, 30 are of the range, 20 and 40 are not.
  const auto w = Whole::text(plates().group("/GRNOD/GEN_INCR/4", {10, 40, 20}).text());
  EXPECT_THAT(renamed(*w, "node", 20, 25).refusals, IsEmpty());
  EXPECT_EQ(renamed(*w, "node", 20, 25).edits.size(), 2u);  // node and shell
  EXPECT_THAT(renamed(*w, "node", 30, 35).refusals,
              ElementsAre(HasSubstr("the range does not stay the same with the new id")));
  // The first one would move the whole range.
  EXPECT_THAT(renamed(*w, "node", 10, 12).refusals, testing::SizeIs(1));
}

TEST(RenumberRanges, TheFirstIdMovesTheBegin) {
  const auto w = Whole::text(plates().group("/GRNOD/GENE/4", {10, 30}).text());
  const auto after = w->after(renamed(*w, "node", 10, 5));
  EXPECT_TRUE(after->contains("/GRNOD/GENE/4\ng\n         5        30")) << after->main_text();
}

TEST(RenumberLines, OneIdThatCannotChangeKeepsTheOthersOfItsLine) {
  // 3 is nobody's and would become a node: its line stays, the next one follows.
  const auto w = Whole::text(
      plates().add("/GRNOD/NODE/4\ng\n         3        50\n        51        52").text());
  const Rewrite r = numbered(*w, {"node=1"}, true);
  const auto after = w->after(r);
  EXPECT_TRUE(after->contains("g\n         3        50\n         6         7\n"))
      << after->main_text();
}

TEST(RenumberLines, FreeFormatMayNotGrowBeyondItsColumns) {
  // 98 columns: two more digits fit, a third does not.
  std::string ids;
  while (ids.size() + 3 <= 98) ids += ids.empty() ? "50" : ",50";
  ids += std::string(98 - ids.size(), ' ');
  ids.back() = ',';
  const auto w = Whole::text(plates().add("/GRNOD/NODE/4\ng\n" + ids).text());
  EXPECT_THAT(open_reasons(*w, {"node+100"}), testing::Each(HasSubstr("longer than 100 columns")));
  EXPECT_THAT(open_reasons(*w, {"node+5"}), IsEmpty());
}

TEST(RenumberItems, ElementsOfTwoLinesAndBlankLinesBetween) {
  test::SmallDeck d;
  for (int i = 0; i < 20; ++i) d.node(i + 1, i % 3 * 1.0, i / 3 % 3 * 1.0, i / 9 * 1.0);
  const std::string lines =
      "       100         1         2         3         4         5         6         7         8\n"
      "         9        10        11        12        13        14        15        16        17  "
      "      18        19        20\n";
  const auto w = Whole::text(d.add("/BRIC20/1\n" + lines).text());
  const auto after = w->after(numbered(*w, {"node+500", "solid+1000"}));
  const std::string text = after->main_text();
  const auto at = text.find("/BRIC20/1\n");
  ASSERT_NE(at, std::string::npos);
  EXPECT_THAT(text.substr(at), HasSubstr("      1100       501       502")) << text;
}

}  // namespace
}  // namespace deck
