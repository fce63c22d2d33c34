// Which entity of one deck is the counterpart of which in another, and what then differs.
#include <gmock/gmock.h>

#include "deck/text/number.hpp"
#include "report/inspected.hpp"

namespace deck::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string value_text(const DiffValue& v) {
  if (const auto* n = std::get_if<std::int64_t>(&v)) return std::to_string(*n);
  if (const auto* x = std::get_if<double>(&v)) return shortest(*x);
  if (const auto* t = std::get_if<std::string>(&v)) return "'" + *t + "'";
  if (const auto* p = std::get_if<std::array<double, 3>>(&v))
    return shortest((*p)[0]) + "," + shortest((*p)[1]) + "," + shortest((*p)[2]);
  return "-";
}

std::string list_text(char sign, const std::vector<std::int64_t>& ids) {
  std::string out;
  for (const std::int64_t id : ids) out += std::string(" ") + sign + std::to_string(id);
  return out;
}

/// "changed /KEYWORD/1>2 field: old -> new +gained -lost ~altered".
std::vector<std::string> said(const DeckDiff& diff) {
  std::vector<std::string> out;
  for (const Change& c : diff.changes) {
    std::string line =
        std::string(to_string(c.kind)) + " " + c.keyword + "/" + std::to_string(c.id);
    if (c.id_b != 0) line += ">" + std::to_string(c.id_b);
    if (!c.field.empty())
      line += " " + c.field + ": " + value_text(c.old_value) + " -> " + value_text(c.new_value);
    out.push_back(line + list_text('+', c.gained) + list_text('-', c.lost) +
                  list_text('~', c.altered));
  }
  return out;
}

DeckDiff between(const std::string& a, const std::string& b, MatchBy match = MatchBy::id,
                 double tolerance = diff_tolerance) {
  const Inspected x(a), y(b);
  return diff_decks(x.side(), y.side(), match, tolerance);
}

std::string sensor(int id, const std::string& title, const std::string& delay) {
  return "/SENSOR/TIME/" + std::to_string(id) + "\n" + title + "\n" +
         std::string(20 - delay.size(), ' ') + delay;
}

std::string with_blocks(const std::vector<std::string>& blocks) {
  std::string text;
  for (const std::string& b : blocks) text += (text.empty() ? "" : "\n") + b;
  return plates({.before = text});
}

TEST(DiffMatch, ByTitleIdsMayBeExchanged) {
  const std::string a = with_blocks({sensor(7, "late", "5.0"), sensor(8, "soon", "1.0")});
  const std::string b = with_blocks({sensor(7, "soon", "1.0"), sensor(8, "late", "5.0")});
  EXPECT_THAT(said(between(a, b, MatchBy::title)), IsEmpty());
  EXPECT_THAT(said(between(a, b, MatchBy::id)),
              ElementsAre("changed /SENSOR/TIME/7 title: 'late' -> 'soon'",
                          "changed /SENSOR/TIME/7 Tdelay: 5.0 -> 1.0",
                          "changed /SENSOR/TIME/8 title: 'soon' -> 'late'",
                          "changed /SENSOR/TIME/8 Tdelay: 1.0 -> 5.0"));
}

TEST(DiffMatch, OfSeveralWithATitleTheSameIdGoesFirst) {
  const std::string a = with_blocks({sensor(1, "x", "1.0"), sensor(2, "x", "2.0")});
  const std::string b = with_blocks({sensor(3, "x", "1.5"), sensor(2, "x", "2.5")});
  EXPECT_THAT(said(between(a, b, MatchBy::title)),
              ElementsAre("changed /SENSOR/TIME/1>3 Tdelay: 1.0 -> 1.5",
                          "changed /SENSOR/TIME/2 Tdelay: 2.0 -> 2.5"));
}

TEST(DiffMatch, WithoutATitleTheIdCounts) {
  const std::string a = with_blocks({sensor(5, "", "1.0"), sensor(6, "", "2.0")});
  const std::string b = with_blocks({sensor(9, "", "2.0"), sensor(5, "", "3.0")});
  EXPECT_THAT(said(between(a, b, MatchBy::title)),
              ElementsAre("removed /SENSOR/TIME/6", "added /SENSOR/TIME/9",
                          "changed /SENSOR/TIME/5 Tdelay: 1.0 -> 3.0"));
}

TEST(DiffMatch, ByPositionWhatIsLeftGoesByRankWhereNothingIsMissing) {
  const std::string a =
      with_blocks({sensor(9, "", "2.0"), sensor(5, "", "1.0"), sensor(30, "same", "9.0")});
  const std::string b =
      with_blocks({sensor(15, "", "1.0"), sensor(31, "same", "9.0"), sensor(16, "", "4.0")});
  EXPECT_THAT(said(between(a, b, MatchBy::position)),
              ElementsAre("changed /SENSOR/TIME/9>16 Tdelay: 2.0 -> 4.0"));
  const std::string more = with_blocks({sensor(15, "", "1.0"), sensor(16, "", "2.0"),
                                        sensor(17, "", "3.0"), sensor(31, "same", "9.0")});
  EXPECT_THAT(
      said(between(a, more, MatchBy::position)),
      ElementsAre("removed /SENSOR/TIME/9", "removed /SENSOR/TIME/5", "added /SENSOR/TIME/15",
                  "added /SENSOR/TIME/16", "added /SENSOR/TIME/17"));
}

TEST(DiffMatch, EqualIdsOfOneKindGoInTheirOrder) {
  const std::string a = with_blocks({sensor(7, "late", "5.0"), sensor(7, "late", "6.0")});
  const std::string b = with_blocks({sensor(7, "late", "5.0"), sensor(7, "late", "6.5")});
  EXPECT_THAT(said(between(a, b)), ElementsAre("changed /SENSOR/TIME/7 Tdelay: 6.0 -> 6.5"));
  EXPECT_THAT(said(between(a, with_blocks({sensor(7, "late", "5.0")}))),
              ElementsAre("removed /SENSOR/TIME/7"));
}

/// A strip of quads (2 n, 2 n + 2) along x; nodes from `first` on, those with x above `still`
/// moved.
std::string strip(int first, int quads, double still, double by = 0.25) {
  SmallDeck d;
  for (int k = 0; k <= quads; ++k)
    for (int side = 0; side < 2; ++side) {
      const double x = 10 * k;
      d.node(first + 2 * k + side, x + (x > still ? by : 0), 10 * side, 0);
    }
  d.shell_part(1, 1);
  for (int k = 0; k < quads; ++k)
    d.shell(1, first + k, first + 2 * k, first + 2 * k + 2, first + 2 * k + 3, first + 2 * k + 1);
  return d.text();
}

TEST(DiffMatch, MovedNodesAreFollowedFromElementToElement) {
  const DeckDiff diff = between(strip(1, 3, 1e9), strip(101, 3, 5), MatchBy::position);
  EXPECT_THAT(said(diff),
              ElementsAre("moved /NODE/3>103 position: 10.0,0.0,0.0 -> 10.25,0.0,0.0",
                          "moved /NODE/4>104 position: 10.0,10.0,0.0 -> 10.25,10.0,0.0",
                          "moved /NODE/5>105 position: 20.0,0.0,0.0 -> 20.25,0.0,0.0",
                          "moved /NODE/6>106 position: 20.0,10.0,0.0 -> 20.25,10.0,0.0",
                          "moved /NODE/7>107 position: 30.0,0.0,0.0 -> 30.25,0.0,0.0",
                          "moved /NODE/8>108 position: 30.0,10.0,0.0 -> 30.25,10.0,0.0"));
}

TEST(DiffMatch, ElementsThatCannotBeToldApartGiveNoCounterpart) {
  const auto deck = [](int first, double z) {
    SmallDeck d;
    d.node(first + 1, 0, 0, 0).node(first + 2, 10, 0, 0);
    d.node(first + 3, 10, 9, z).node(first + 4, 0, 9, z);
    d.node(first + 5, 10, -9, z).node(first + 6, 0, -9, z).shell_part(1, 1);
    d.shell(1, first + 1, first + 1, first + 2, first + 3, first + 4);
    d.shell(1, first + 2, first + 1, first + 2, first + 5, first + 6);
    return d.text();
  };
  EXPECT_THAT(said(between(deck(0, 0), deck(100, 1), MatchBy::position)),
              ElementsAre("changed /NODE/0 nodes: 6 -> 6 +103 +104 +105 +106 -3 -4 -5 -6",
                          "changed /PART/1 /SHELL elements: 2 -> 2 +101 +102 -1 -2"));
}

TEST(DiffMatch, ByPositionCoincidentNodesGoByIdAndRepeatedElementsByOrder) {
  const auto deck = [](int first, bool swapped) {
    SmallDeck d;
    d.node(first + 1, 0, 0, 0).node(first + 2, 0, 0, 0).node(first + 3, 10, 0, 0);
    d.node(first + 4, 10, 10, 0).node(first + 5, -10, 0, 0).shell_part(1, 1).truss_part(2, 1);
    d.shell3(1, first + 1, first + 1, first + 3, first + 4);
    d.shell3(1, first + 2, first + 1, first + 3, first + 4);
    return d.bar("TRUSS", 2, first + 3, first + (swapped ? 1 : 2), first + 5).text();
  };
  EXPECT_THAT(said(between(deck(0, false), deck(100, false), MatchBy::position)), IsEmpty());
  EXPECT_THAT(said(between(deck(0, false), deck(100, true), MatchBy::position)),
              ElementsAre("changed /PART/2 /TRUSS elements: 1 -> 1 +103 -3"));
  SmallDeck three;
  three.node(101, 0, 0, 0).node(102, 0, 0, 0).node(103, 10, 0, 0).node(104, 10, 10, 0);
  three.node(105, -10, 0, 0).shell_part(1, 1).truss_part(2, 1).shell3(1, 101, 101, 103, 104);
  three.bar("TRUSS", 2, 103, 102, 105);
  EXPECT_THAT(said(between(deck(0, false), three.text(), MatchBy::position)),
              ElementsAre("changed /PART/1 /SH3N elements: 2 -> 1 -2"));
}

TEST(DiffMesh, ElementsChangePartNodesAndThickness) {
  const auto deck = [](int part, int last, double thickness) {
    SmallDeck d;
    d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(5, 0, 11, 0);
    d.shell_part(1, 1).shell_part(2, 1).shell(1, 10, 1, 2, 3, 4);
    return d.shell(part, 11, 1, 2, 3, last, thickness).text();
  };
  const std::string base = deck(1, 4, 1.5);
  EXPECT_THAT(said(between(base, deck(2, 4, 1.5))),
              ElementsAre("changed /PART/1 /SHELL elements: 2 -> 1 -11",
                          "changed /PART/2 /SHELL elements: 0 -> 1 +11"));
  EXPECT_THAT(said(between(base, deck(1, 5, 1.5))),
              ElementsAre("changed /PART/1 /SHELL elements: 2 -> 2 ~11"));
  EXPECT_THAT(said(between(base, deck(1, 4, 1.75))),
              ElementsAre("changed /PART/1 /SHELL elements: 2 -> 2 ~11"));
  EXPECT_THAT(said(between(base, deck(1, 4, 0))),
              ElementsAre("changed /PART/1 /SHELL elements: 2 -> 2 ~11"));
}

TEST(DiffMesh, NodesThatCameAndWentAreListed) {
  SmallDeck a, b;
  a.node(3, 0, 0, 0).node(1, 1, 0, 0).node(7, 2, 0, 0);
  b.node(1, 1, 0, 0.5).node(9, 2, 0, 0).node(8, 3, 0, 0);
  const DeckDiff diff = between(a.text(), b.text());
  EXPECT_THAT(said(diff), ElementsAre("moved /NODE/1 position: 1.0,0.0,0.0 -> 1.0,0.0,0.5",
                                      "changed /NODE/0 nodes: 3 -> 3 +9 +8 -3 -7"));
  ASSERT_EQ(diff.notes.size(), 1u);
  EXPECT_THAT(diff.notes[0], HasSubstr("2 of 3 nodes have no counterpart"));
  // Half of them is not most of them.
  a.node(8, 5, 0, 0);
  EXPECT_THAT(between(a.text(), b.text()).notes, IsEmpty());
}

TEST(DiffMesh, OfSeveralNodesWithOneIdTheFirstGoesWithTheFirst) {
  const auto deck = [](double x) {
    SmallDeck d;
    return d.node(7, 1, 0, 0).node(7, x, 0, 0).node(3, 9, 0, 0).text();
  };
  EXPECT_THAT(said(between(deck(2), deck(3))),
              ElementsAre("moved /NODE/7 position: 2.0,0.0,0.0 -> 3.0,0.0,0.0"));
}

TEST(DiffGroups, ListTheirMembers) {
  const auto deck = [](const char* group) { return plates({.before = group}); };
  EXPECT_THAT(said(between(deck("/GRNOD/NODE/9\ng\n         1         2         3"),
                           deck("/GRNOD/NODE/9\ng\n         5         2         8         3"))),
              ElementsAre("changed /GRNOD/NODE/9 nodes: 3 -> 4 +5 +8 -1"));
  EXPECT_THAT(
      said(between(deck("/SURF/PART/9\ns\n         1"), deck("/SURF/PART/9\ns\n         2"))),
      ElementsAre("changed /SURF/PART/9 segments: 1 -> 1 +2 -1"));
  EXPECT_THAT(said(between(deck("/GRPART/PART/9\ng\n         1         2"),
                           deck("/GRPART/PART/9\ng\n         2"))),
              ElementsAre("changed /GRPART/PART/9 parts: 2 -> 1 -1"));
  EXPECT_THAT(said(between(deck("/GRSHEL/SHEL/9\ng\n         1"),
                           deck("/GRSHEL/SHEL/9\ng\n         1         2"))),
              ElementsAre("changed /GRSHEL/SHEL/9 elements: 1 -> 2 +2"));
  // The same segment by other words is no change, a turned one is the same, another is not.
  EXPECT_THAT(
      said(between(deck("/SURF/SEG/9\ns\n         1         1         2         3         4"),
                   deck("/SURF/SEG/9\ns\n         1         1         2         3         4"))),
      IsEmpty());
}

TEST(DiffCells, ListsOfIdsAreComparedAsSets) {
  const auto deck = [](const char* ids) {
    return plates({.before = std::string("/SUBSET/4\nset\n") + ids});
  };
  const std::string base = deck("         1         2");
  EXPECT_THAT(said(between(base, deck("         2         1"))), IsEmpty());
  const std::vector<std::string> changes = said(between(base, deck("         2         3")));
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_THAT(changes[0], HasSubstr("changed /SUBSET/4 "));
  EXPECT_THAT(changes[0], HasSubstr(" +3 -1"));
}

TEST(DiffCells, WordsOfUndescribedLinesCountByTheirValue) {
  const auto deck = [](const char* words) {
    return plates({.before = std::string("/UNHEARDOF/4\n") + words});
  };
  const std::string base = deck("  one  2.0, three");
  EXPECT_THAT(said(between(base, deck("one 2e0 three"))), IsEmpty());
  EXPECT_THAT(said(between(base, deck("  one  2.5, three"))),
              ElementsAre("changed /UNHEARDOF/4 (undescribed text): '2.0' -> '2.5'"));
  EXPECT_THAT(said(between(base, deck("  one  2.0, three four"))),
              ElementsAre("changed /UNHEARDOF/4 (undescribed text): - -> 'four'"));
  EXPECT_THAT(said(between(base, deck("  one  2.0"))),
              ElementsAre("changed /UNHEARDOF/4 (undescribed text): 'three' -> -"));
}

TEST(DiffCells, ABlankCellIsItsZeroAndItsOrdinaryDefault) {
  const auto deck = [](const char* card) { return plates({.before = card}); };
  EXPECT_THAT(said(between(deck("@/FUNCT/9 X=0 Y=1"), deck("@/FUNCT/9 X=0 Y=1"))), IsEmpty());
  const std::string blank = deck("/SENSOR/TIME/7\nlate\n");
  EXPECT_THAT(said(between(blank, deck("/SENSOR/TIME/7\nlate\n                 0.0"))), IsEmpty());
  EXPECT_THAT(said(between(blank, deck("/SENSOR/TIME/7\nlate\n                 1.5"))),
              ElementsAre("changed /SENSOR/TIME/7 Tdelay: - -> 1.5"));
}

/// The same deck with other working units: lengths in metres.
std::string in_metres(std::string text) {
  const auto begin = text.find("/BEGIN");
  auto mm = text.find("mm", begin);
  mm = text.find("mm", mm + 2);  // working units come second
  return text.replace(mm, 2, " m");
}

TEST(DiffUnits, ValuesOfTheSecondDeckAreShownInThoseOfTheFirst) {
  const std::string a = plates(), b = in_metres(plates());
  ASSERT_NE(a, b) << a;
  const DeckDiff same = between(a, b);
  EXPECT_THAT(said(same), IsEmpty());
  ASSERT_GE(same.notes.size(), 1u);
  EXPECT_THAT(same.notes[0], HasSubstr("the working units differ"));
  EXPECT_EQ(same.same_penetrations, 4u);
  const DeckDiff other = between(a, in_metres(plates({.height = 0.3, .card = "Gapmin=0.6"})));
  std::size_t moved = 0, gaps = 0;
  for (const Change& c : other.changes) {
    if (c.kind == ChangeKind::moved) {
      ++moved;
      EXPECT_NEAR((std::get<std::array<double, 3>>(c.new_value)[2]), 0.3, 1e-12);
      EXPECT_NEAR((std::get<std::array<double, 3>>(c.old_value)[2]), 0.4, 1e-12);
    }
    if (c.field == "Gapmin") {
      ++gaps;
      EXPECT_NEAR(std::get<double>(c.new_value), 0.6, 1e-12);
      EXPECT_NEAR(std::get<double>(c.effective_new), 0.6, 1e-12);
    }
  }
  EXPECT_EQ(moved, 4u);
  EXPECT_EQ(gaps, 1u);
  // Depths stay in the units of each deck.
  ASSERT_EQ(other.worse.size(), 4u);
  EXPECT_NEAR(other.worse[0].depth_old, 0.1, 1e-12);
  EXPECT_NEAR(other.worse[0].depth_new, 0.3e-3, 1e-15);
}

TEST(DiffTolerance, CountsWhatItMakesEqualAndWhatItNearlyDoes) {
  const auto deck = [](const char* delay) { return with_blocks({sensor(7, "late", delay)}); };
  const DeckDiff near = between(deck("5.0"), deck("5.000000001"));
  EXPECT_EQ(said(near).size(), 1u);
  ASSERT_EQ(near.notes.size(), 1u);
  EXPECT_THAT(near.notes[0], HasSubstr("1 value differs by less than 1e-09 of its size; with "
                                       "--tolerance 1e-09 they count as equal"));
  const DeckDiff equal = between(deck("5.0"), deck("5.000000001"), MatchBy::id, 1e-9);
  EXPECT_THAT(said(equal), IsEmpty());
  ASSERT_EQ(equal.notes.size(), 1u);
  EXPECT_THAT(equal.notes[0], HasSubstr("1 value differs by less than 1e-09 of its size "));
  EXPECT_THAT(between(deck("5.0"), deck("5.1")).notes, IsEmpty());
}

TEST(DiffPenetrations, AreWorseOrBetterBeyondABillionthOfTheGap) {
  const std::string base = plates();
  const auto at = [&](const char* height) {
    std::string text = base;
    for (auto p = text.find("                 0.4\n"); p != text.npos;
         p = text.find("                 0.4\n"))
      text.replace(p, 20, std::string(20 - std::string(height).size(), ' ') + height);
    return text;
  };
  ASSERT_NE(at("0.45"), base) << base;
  const DeckDiff better = between(base, at("0.45"));
  EXPECT_EQ(better.better.size(), 4u);
  EXPECT_TRUE(better.worse.empty());
  EXPECT_NEAR(better.better[0].depth_old, 0.1, 1e-12);
  EXPECT_NEAR(better.better[0].depth_new, 0.05, 1e-12);
  EXPECT_EQ(better.better[0].gap_old, 0.5);
  EXPECT_EQ(better.better[0].gap_new, 0.5);
  EXPECT_EQ(between(base, at("0.400000000002")).same_penetrations, 4u) << "0.4e-9 of the gap";
  const DeckDiff more = between(base, at("0.400000001"));
  EXPECT_EQ(more.better.size(), 4u) << "2e-9 of the gap";
  EXPECT_EQ(more.same_penetrations, 0u);
  EXPECT_EQ(between(base, at("0.399999999")).worse.size(), 4u);
}

TEST(DiffNotes, OtherVersionsAreNoDifferenceInThemselves) {
  std::string other = plates();
  const auto begin = other.find("/BEGIN");
  const auto version = other.find("2022", begin);
  if (version == other.npos) GTEST_SKIP() << other.substr(begin, 200);
  other.replace(version, 4, "2021");
  const DeckDiff diff = between(plates(), other);
  ASSERT_EQ(diff.notes.size(), 1u);
  EXPECT_EQ(diff.notes[0], "input version 2022 here, 2021 there: no difference in itself");
}

}  // namespace
}  // namespace deck::test
