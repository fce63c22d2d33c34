// Conversion between input versions: cells keep their values, nothing is lost without a word.
#include "deck/edit.hpp"

#include <gmock/gmock.h>

#include "deck/keyword.hpp"
#include "edit/version_support.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;

std::string after(const std::string& text, int version, const VersionOptions& options = {}) {
  const auto before = open_text(text);
  const Rewrite r = to_version(before->context(), version, options);
  EXPECT_TRUE(r.refusals.empty()) << joined(r.refusals);
  return before->after(r)->main_text();
}

Rewrite rewrite_of(const std::string& text, int version, const VersionOptions& options = {}) {
  const auto before = open_text(text);
  return to_version(before->context(), version, options);
}

TEST(ToVersion, FrictionLineOfType11ComesBehindItsLastLineAndCommentsStay) {
  const std::string text = deck_of_version(2017,
                                           "/INTER/TYPE11/1\nedges\n# ids\n         1         2\n"
                                           "# bounds\n\n# stfac\n                 1.0\n# inacti\n"
                                           "                                       6\n# last\n");
  EXPECT_EQ(after(text, 2018),
            deck_of_version(2018,
                            "/INTER/TYPE11/1\nedges\n# ids\n         1         2\n# bounds\n\n"
                            "# stfac\n                 1.0\n# inacti\n"
                            "                                       6\n\n# last\n"));
}

TEST(ToVersion, CarriageReturnsAreKeptOnNewLines) {
  std::string text;
  for (const char c :
       deck_of_version(2017, card("/INTER/TYPE11", 1, 2017, {{"line_IDs", "1"}, {"Fric", "0.1"}})))
    text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const std::string converted = after(text, 2024);
  EXPECT_EQ(std::count(converted.begin(), converted.end(), '\n'),
            std::count(converted.begin(), converted.end(), '\r'));
  EXPECT_EQ(after(converted, 2017), text);
}

TEST(ToVersion, HeatLineMovesBehindTheAdaptiveLineFromVersion110On) {
  const std::string text = deck_of_version(100, card("/INTER/TYPE7", 1, 100,
                                                     {{"grnd_IDs", "1"},
                                                      {"surf_IDm", "2"},
                                                      {"Ithe", "1"},
                                                      {"Iadm", "2"},
                                                      {"NRadm", "5"},
                                                      {"Padm", "0.5"},
                                                      {"Rthe", "12.0"},
                                                      {"Tint", "300.0"}}));
  const auto deck = open_text(after(text, 130));
  const DecodedBlock block = decode(deck->deck, *deck->interfaces.ordered.at(0)->block);
  EXPECT_EQ(block.integer("NRadm"), 5);
  EXPECT_EQ(block.real("Padm"), 0.5);
  EXPECT_EQ(block.real("Kthe"), 12);
  EXPECT_EQ(block.real("Tint"), 300);
  EXPECT_TRUE(block.extra.empty());
  EXPECT_FALSE(block.cards.back().missing());
}

TEST(ToVersion, ValueThatIsTheDefaultGoesWithoutLoss) {
  const std::pair<std::string, int> decks[] = {
      {card("/INTER/TYPE7", 4, 2020,
            {{"surf_IDm", "1"},
             {"Irem_gap", "1"},
             {"Irem_i2", "3"},
             {"AscaleF", "1.0"},
             {"ITIED", "0"}}),
       110},
      {card("/SKEW/MOV", 1, 2020, {{"N1", "1"}, {"N2", "2"}, {"N3", "3"}, {"Dir", "X"}}), 2018},
      {card("/INTER/TYPE19", 1, 2020, {{"surf_IDs", "1"}, {"Igap", "4"}, {"Irem_gap", "0"}}),
       2018}};
  for (const auto& [text, version] : decks) {
    const Rewrite r = rewrite_of(deck_of_version(2020, text), version);
    EXPECT_TRUE(r.refusals.empty()) << joined(r.refusals);
    EXPECT_TRUE(losses_of(r, Loss::dropped).empty());
  }
}

TEST(ToVersion, BuiltInValueOnTheCardIsALossWhereADefaultCardWouldTakeItsPlace) {
  // Irem_gap 1 is the built-in default, but without its cell the default card's 2 comes into force.
  const std::string text = deck_of_version(
      140, card("/DEFAULT/INTER/TYPE7", 0, 140, {{"Irem_gap", "2"}}) +
               card("/INTER/TYPE7", 1, 140, {{"surf_IDm", "1"}, {"Irem_gap", "1"}}));
  const Rewrite r = rewrite_of(text, 110);
  ASSERT_EQ(r.refusals.size(), 1u) << joined(r.refusals);
  EXPECT_THAT(r.refusals[0], HasSubstr("Irem_gap = 1"));
}

TEST(ToVersion, TextInBlankColumnsDoesNotBecomeAValue) {
  // The third line of version 110 ends at column 60; from 120 on dtmin follows.
  const std::string text = deck_of_version(
      110, "/INTER/TYPE7/1\nt\n         0         1\n\n" + std::string(76, ' ') + " 0.7\n\n\n\n");
  const auto before = open_text(text);
  const Rewrite r = to_version(before->context(), 120);
  EXPECT_TRUE(r.refusals.empty());
  const auto then = before->after(r);
  EXPECT_EQ(then->interfaces.type7.at(0).dtmin.value, 0);
  const auto dropped = losses_of(r, Loss::dropped);
  ASSERT_EQ(dropped.size(), 1u);
  EXPECT_EQ(dropped[0].field, "dtmin");
  EXPECT_EQ(dropped[0].old_text, "0.7");
}

TEST(ToVersion, FreeFormatGetsNewColumnsAndKeepsParameters) {
  const auto before = open_text(
      deck_of_version(110,
                      "/PARAMETER/GLOBAL/REAL/1\ngap\ngap                      0.75\n"
                      "/INTER/TYPE7/1\nfree\n 1,2,4,0,1,4,0,0,0,0\n1.5,3.0\n,,0.3\n1.,0.1,&gap\n"
                      "       110\n\n"));
  const auto then = before->after(to_version(before->context(), 2024));
  EXPECT_EQ(difference(effective_values(*before), effective_values(*then)), "");
  EXPECT_EQ(then->interfaces.type7.at(0).Igap.value, 1);
  EXPECT_EQ(then->interfaces.type7.at(0).Ibag.input, 0);
  EXPECT_EQ(then->interfaces.type7.at(0).Gapmin.value, 0.75);
  EXPECT_TRUE(then->contains("&gap"));
}

TEST(ToVersion, AFlagThatNoSolverReadsIsDroppedWithoutARefusal) {
  const std::string head = "/PROP/SHELL/1\np\n        24\n\n         3";
  const Rewrite r = rewrite_of(deck_of_version(2022, head + "         1\n"), 2026);
  EXPECT_TRUE(r.refusals.empty()) << joined(r.refusals);
  const auto dropped = losses_of(r, Loss::dropped);
  ASSERT_EQ(dropped.size(), 1u);
  EXPECT_EQ(dropped[0].field, "Istrain");
}

TEST(ToVersion, SubmodelsWithTheirOwnVersionAreConvertedFromIt) {
  const std::string inner =
      "/BEGIN\nsub\n       110         0\n"
      "                  kg                  mm                  ms\n"
      "                  kg                  mm                  ms\n" +
      card("/INTER/TYPE11", 2, 110, {{"line_IDs", "1"}, {"Fric", "0.25"}});
  const std::string text = deck_of_version(
      2020, card("/INTER/TYPE11", 1, 2020, {{"line_IDs", "1"}, {"Irem_gap", "2"}}) +
                "//SUBMODEL/1\n\n       100\n" + inner + "//ENDSUB\n" +
                card("/INTER/TYPE11", 3, 2020, {{"line_IDs", "1"}, {"Irem_gap", "2"}}));
  const auto before = open_text(text);
  ASSERT_EQ(before->interfaces.type11.at(2).block->version, 110);
  const auto then = before->after(to_version(before->context(), 2024));
  EXPECT_EQ(difference(effective_values(*before), effective_values(*then)), "");
  for (const Block& b : then->deck.blocks) EXPECT_EQ(b.version, 2024) << b.header;
  EXPECT_TRUE(decode(then->deck, *then->interfaces.type11.at(2).block).extra.empty());
}

TEST(ToVersion, NumberWithoutVersionIsReadAsTheNewest) {
  const std::string text =
      deck_of_version(2612, card("/INTER/TYPE11", 1, 2026, {{"line_IDs", "1"}}));
  const auto before = open_text(text);
  const Rewrite r = to_version(before->context(), 2026);
  EXPECT_TRUE(r.refusals.empty());
  EXPECT_EQ(before->after(r)->deck.begin.version_written, 2026);
}

TEST(ToVersion, UnknownTargetsAndOldDecksAreRefused) {
  EXPECT_FALSE(rewrite_of(deck_of_version(2022, ""), 2027).refusals.empty());
  EXPECT_FALSE(rewrite_of(deck_of_version(2022, ""), 100).refusals.empty());
  EXPECT_FALSE(rewrite_of(deck_of_version(90, "/PART/1\np\n         1\n"), 2022).refusals.empty());
  EXPECT_FALSE(rewrite_of("#RADIOSS STARTER\n/PART/1\np\n/END\n", 2022).refusals.empty());
}

TEST(ToVersion, KeywordsOfWhichNotEveryColumnIsKnownAreUndecidedByNameAndCount) {
  const Rewrite r =
      rewrite_of(deck_of_version(2022, "/FXBODY/1\na\n/FXBODY/2\nb\n/ANIM/DT\n 0.0 1.0\n"), 2024);
  ASSERT_EQ(r.refusals.size(), 1u) << joined(r.refusals);
  EXPECT_THAT(r.refusals[0], HasSubstr("/FXBODY: has columns"));
  EXPECT_THAT(r.refusals[0], HasSubstr("its 2 blocks"));
}

}  // namespace
}  // namespace deck::test
