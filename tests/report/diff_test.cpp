// What two decks mean differently, and what makes no difference.
#include "deck/verdict.hpp"
#include "report/inspected.hpp"

namespace deck::test {
namespace {

DeckDiff compared(const std::string& a, const std::string& b, MatchBy match = MatchBy::id) {
  const Inspected x(a), y(b);
  return diff_decks(x.side(), y.side(), match);
}

const Change* change_of(const DeckDiff& diff, const std::string& field) {
  for (const Change& c : diff.changes)
    if (c.field == field) return &c;
  return nullptr;
}

TEST(DeckDiff, ADeckEqualsItself) {
  const DeckDiff diff = compared(plates(), plates());
  EXPECT_TRUE(diff.equal()) << diff_verdict(diff);
  EXPECT_EQ(diff.same_penetrations, 4u);
}

TEST(DeckDiff, TheOrderOfBlocksMakesNoDifference) {
  std::string other = plates();
  const auto surf = other.find("/SURF/PART/1"), group = other.find("/GRNOD/PART/2");
  ASSERT_LT(surf, group);
  const std::string block = other.substr(surf, group - surf);
  other.erase(surf, block.size());
  other.insert(other.find("/INTER/TYPE7"), block);
  ASSERT_NE(other, plates());
  EXPECT_TRUE(compared(plates(), other).equal());
}

TEST(DeckDiff, OtherIdsMakeNoDifferenceByPosition) {
  const DeckDiff diff = compared(plates(), plates({.first = 500}), MatchBy::position);
  EXPECT_TRUE(diff.equal()) << diff_verdict(diff);
  EXPECT_EQ(diff.same_penetrations, 4u);
  EXPECT_FALSE(compared(plates(), plates({.first = 500})).equal());
}

TEST(DeckDiff, OtherIdsAreSuggestedToBeComparedByPosition) {
  const DeckDiff diff = compared(plates(), plates({.first = 500}));
  ASSERT_EQ(diff.notes.size(), 1u);
  EXPECT_NE(diff.notes[0].find("--match position"), std::string::npos);
}

TEST(DeckDiff, ADefaultBlockIsTheReasonOfAnEffectiveValue) {
  const DeckDiff diff = compared(plates(), plates({.before = "@/DEFAULT/INTER/TYPE7 Inacti=6"}));
  const Change* c = change_of(diff, "Inacti");
  ASSERT_NE(c, nullptr) << diff_verdict(diff);
  EXPECT_EQ(c->why, "default-block");
  EXPECT_EQ(std::get<std::int64_t>(c->effective_new), 6);
}

TEST(DeckDiff, PenetrationsAppearAndGo) {
  EXPECT_EQ(compared(plates({.height = 0.6}), plates()).appeared.size(), 4u);
  EXPECT_EQ(compared(plates(), plates({.height = 0.6})).gone.size(), 4u);
}

TEST(DeckDiff, ANodeThatMovedIsFoundByPositionOverItsElement) {
  std::string other = plates({.first = 500});
  const auto at = other.find("                   8                   8                 0.4");
  ASSERT_NE(at, std::string::npos) << other;
  other.replace(at, 20, "                 8.5");
  const DeckDiff diff = compared(plates(), other, MatchBy::position);
  ASSERT_EQ(diff.changes.size(), 1u) << diff_verdict(diff);
  EXPECT_EQ(diff.changes[0].kind, ChangeKind::moved);
  EXPECT_EQ(diff.changes[0].id, 7);
  EXPECT_EQ(diff.changes[0].id_b, 507);
}

TEST(DeckDiff, KeywordsThatCameOrWentAreListed) {
  const std::string friction = plates({.before = "/SENSOR/TIME/7\nlate\n                 5.0"});
  const DeckDiff came = compared(plates(), friction), went = compared(friction, plates());
  ASSERT_EQ(came.changes.size(), 1u) << diff_verdict(came);
  EXPECT_EQ(came.changes[0].kind, ChangeKind::added);
  ASSERT_EQ(went.changes.size(), 1u);
  EXPECT_EQ(went.changes[0].kind, ChangeKind::removed);
}

std::string with(const std::string& blocks) { return plates({.before = blocks}); }

/// Blank Fscaley is 1 in the units of the block, whichever these are.
TEST(DeckDiff, ABlankScaleIsOneInTheUnitsOfItsBlock) {
  const std::string rest =
      "/UNIT/8\nu\n                  Mg                  mm                  ms\n"
      "@/FUNCT/9 X=0 Y=1\n@/CLOAD/1";
  const std::string cells = " funct_IDT=9 Dir=X grnd_ID=2";
  const std::string blank = with(rest + cells);
  EXPECT_TRUE(compared(blank, with(rest + cells + " Fscaley=1 Ascalex=1")).equal());
  const DeckDiff wrong = compared(blank, with(rest + "/8" + cells));
  const Change* change = change_of(wrong, "Fscaley");
  ASSERT_NE(change, nullptr);
  EXPECT_EQ(std::get<double>(change->old_value), 1);
  EXPECT_DOUBLE_EQ(std::get<double>(change->new_value), 1000);
  EXPECT_TRUE(compared(blank, with(rest + "/8" + cells + " Fscaley=0.001")).equal());
}

std::string with_element(const std::string& rows) {
  return with(
      "/PROP/SPRING/40\nsp\n                 0.1\n                 5.0\n/PART/40\np\n"
      "        40         0\n" +
      rows);
}

/// Cells that contacts have no use for make another structure all the same.
TEST(DeckDiff, EveryCellOfAnElementCounts) {
  const auto row = [](const char* keyword, std::initializer_list<std::pair<int, const char*>> at) {
    std::string line(100, ' ');
    for (const auto& [last, text] : at)
      line.replace(static_cast<std::size_t>(last) - std::string_view(text).size(),
                   std::string_view(text).size(), text);
    return with_element(keyword + ("/40\n" + line));
  };
  const auto spring = [&](const char* third, const char* skew) {
    return row("/SPRING", {{10, "90"}, {20, "1"}, {30, "5"}, {40, third}, {100, skew}});
  };
  const auto shell = [&](const char* phi) {
    return row("/SHELL", {{10, "91"}, {20, "1"}, {30, "2"}, {40, "7"}, {50, "8"}, {80, phi}});
  };
  const auto tetra = [](const char* mid) {
    return with_element(
        std::string("/TETRA10/40\n        92\n         1         2         3"
                    "         5         4         6         7         8         0") +
        mid);
  };
  EXPECT_TRUE(compared(spring("2", "3"), spring("2", "3")).equal());
  EXPECT_TRUE(compared(shell("45."), shell("4.5E1")).equal());
  EXPECT_NE(change_of(compared(spring("2", "0"), spring("3", "0")), "/SPRING elements"), nullptr);
  EXPECT_NE(change_of(compared(spring("", ""), spring("", "3")), "/SPRING elements"), nullptr);
  EXPECT_NE(change_of(compared(shell(""), shell("45.")), "/SHELL elements"), nullptr);
  EXPECT_NE(change_of(compared(tetra("         0"), tetra("         8")), "/BRICK elements"),
            nullptr);
}

/// A curve, its scale and its rate go together by their place.
TEST(DeckDiff, ListsOfValuesAndFunctionsCountByPlace) {
  const auto law = [](const char* functions, const char* scales, const char* rates) {
    return with(std::string("/MAT/LAW36/9\nm\n              7.8e-9\n"
                            "            210000.0                 0.3\n"
                            "         2\n\n         0\n") +
                functions + "\n" + scales + "\n" + rates);
  };
  const char* const ids = "        17        18";
  const char* const scales = "                 0.0                 2.0";
  const char* const rates = "                 0.0                 0.1";
  const std::string deck = law(ids, scales, rates);
  EXPECT_TRUE(compared(deck, deck).equal());
  EXPECT_FALSE(compared(deck, law("        18        17", scales, rates)).equal());
  EXPECT_FALSE(compared(deck, law(ids, "                 2.0                 0.0", rates)).equal());
  EXPECT_FALSE(
      compared(deck, law(ids, scales, "                 0.0                 0.9")).equal());
}

TEST(DeckDiff, TheToleranceOfNodesThatMergeCounts) {
  const auto deck = [](const char* tolerance) {
    return with(std::string("/CNODE/") + tolerance +
                "\n        70                50.0                 0.0                 0.0");
  };
  EXPECT_TRUE(compared(deck("0.1"), deck("1e-1")).equal());
  EXPECT_NE(change_of(compared(deck("0.1"), deck("0.2")), "tolerance"), nullptr);
}

TEST(Diff, ADeckThatStopsIsNotEqualToOneThatDoesNot) {
  const Inspected a(plates()), b(plates());
  Verdict stops;
  stops.level = VerdictLevel::stops;
  const Verdict clean;
  DiffSide sa = a.side(), sb = b.side();
  sa.verdict = &clean;
  sb.verdict = &stops;
  const DeckDiff diff = diff_decks(sa, sb, MatchBy::id);
  EXPECT_FALSE(diff.equal());
  EXPECT_EQ(diff_verdict(diff), "Different: the solver stops at the second deck.");
}

}  // namespace
}  // namespace deck::test
