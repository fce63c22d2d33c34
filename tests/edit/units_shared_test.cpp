// What several decks share is converted once: the result is that of converting each by itself.
#include <gtest/gtest.h>

#include "deck/edit/unit_system.hpp"
#include "edit/units_support.hpp"

namespace deck::edit_test {
namespace {

std::string deck_of(const char* units, const std::string& nodes) {
  const std::string system = units;
  return "#RADIOSS STARTER\n/BEGIN\nshared\n      2022         0\n" + system + system + nodes +
         "/END\n";
}
const char* const metric = "                  kg                  mm                  ms\n";
const char* const tonnes = "                  Mg                  cm                   s\n";
const std::string two_nodes =
    "/NODE\n         1                12.5                  -3              1.0E2\n"
    "# a comment\n         2                 0.1                7.25               0.0\n";

Rewrite shared_units(const Whole& w, const std::shared_ptr<detail::ConvertedRows>& rows) {
  UnitsOptions options;
  options.shared_rows = rows;
  return to_units(w.context(), *parse_unit_system("kg,m,s"), options);
}

std::vector<std::string> said(const Rewrite& rewrite) {
  std::vector<std::string> out;
  for (const LossEntry& e : rewrite.losses) out.push_back(e.keyword + " " + e.note);
  return out;
}

/// The text after converting `before` and then `deck` with what was remembered.
std::string after_another(const std::string& before, const std::string& deck,
                          bool* alike = nullptr) {
  const auto rows = make_shared_rows();
  const auto first = Whole::text(before), second = Whole::text(deck);
  (void)shared_units(*first, rows);
  const Rewrite with = shared_units(*second, rows), without = shared_units(*second, nullptr);
  if (alike != nullptr) *alike = with.notes == without.notes && said(with) == said(without);
  return second->after(with)->main_text();
}
std::string alone(const std::string& deck) {
  const auto w = Whole::text(deck);
  return w->after(shared_units(*w, nullptr))->main_text();
}

TEST(SharedRows, TheSameBlockGetsTheSameTextAndReport) {
  // Further down in the file than in the deck before.
  const std::string deck = deck_of(metric, "# moved\n" + two_nodes);
  bool alike = false;
  EXPECT_EQ(after_another(deck_of(metric, two_nodes), deck, &alike), alone(deck));
  EXPECT_TRUE(alike);
  EXPECT_NE(alone(deck).find("0.0125"), std::string::npos);
}

TEST(SharedRows, ABlockIsOneEditAndCountsItsCells) {
  const auto rows = make_shared_rows();
  const auto w = Whole::text(deck_of(metric, two_nodes));
  const Rewrite with = shared_units(*w, rows), without = shared_units(*w, nullptr);
  EXPECT_LT(with.edits.size(), without.edits.size());
  EXPECT_EQ(said(with), said(without));
  EXPECT_EQ(w->after(with)->main_text(), w->after(without)->main_text());
}

TEST(SharedRows, AFileThatIsIncludedTwiceIsChangedOnce) {
  const std::string main = deck_of(metric, "#include rows.inc\n#include rows.inc\n");
  const auto w =
      Whole::read("memory_0000.rad", {{"memory_0000.rad", main}, {"rows.inc", two_nodes}});
  const auto rows = make_shared_rows();
  for (int turn = 0; turn < 2; ++turn)
    EXPECT_EQ(w->after(shared_units(*w, rows))->files, w->after(shared_units(*w, nullptr))->files);
}

TEST(SharedRows, TheSameBlockInOtherUnitsIsConvertedByThem) {
  const std::string deck = deck_of(tonnes, two_nodes);
  EXPECT_EQ(after_another(deck_of(metric, two_nodes), deck), alone(deck));
  EXPECT_NE(alone(deck), alone(deck_of(metric, two_nodes)));
}

TEST(SharedRows, AnotherBlockOfTheSameLengthIsConvertedItself) {
  std::string other = two_nodes;
  other.replace(other.find("7.25"), 4, "7.35");
  const std::string deck = deck_of(metric, other);
  EXPECT_EQ(after_another(deck_of(metric, two_nodes), deck), alone(deck));
}

TEST(SharedRows, ABlockThatIsRefusedIsRefusedInEveryDeck) {
  std::string bad = two_nodes;
  bad.replace(bad.find("12.5"), 4, "1.x5");
  const auto rows = make_shared_rows();
  const auto w = Whole::text(deck_of(metric, bad));
  const auto first = shared_units(*w, rows).refusals;
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(shared_units(*w, rows).refusals, first);
}

}  // namespace
}  // namespace deck::edit_test
