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
