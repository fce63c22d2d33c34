// Text measured, folded and cut for a terminal.
#include "base/shared/shown_text.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace deck {
namespace {

std::string without_blanks(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
  return text;
}

TEST(DisplayWidth, CountsColumnsNotBytes) {
  EXPECT_EQ(display_width("Gapmin"), 6u);
  EXPECT_EQ(display_width("ünïcödé"), 7u);
  EXPECT_EQ(display_width("車体"), 4u);
  EXPECT_EQ(display_width("한글 가"), 7u);
  EXPECT_EQ(display_width("e\xcc\x81"), 1u) << "an accent stands over its letter";
  EXPECT_EQ(display_width("\xb5m"), 2u) << "a byte that is no UTF-8";
  EXPECT_EQ(display_width("\x1b[1;31merror\x1b[0m"), 5u) << "colours take no column";
}

TEST(CutTo, ShowsThatSomethingIsMissingAndNeverHalfACharacter) {
  EXPECT_EQ(cut_to("barrier", 7), "barrier");
  EXPECT_EQ(cut_to("barrier", 6), "barri…");
  EXPECT_EQ(cut_to("車体前部", 6), "車体…");
  EXPECT_EQ(cut_to("車体前部", 7), "車体前…");
}

TEST(Broken, LosesNothingButBlanks) {
  const std::string text =
      "samples/a_folder/with_names.rad:50:1 and more, even more: 車体前部の接触 end";
  for (std::size_t width = 2; width < 40; ++width) {
    std::string all;
    for (const std::string& piece : broken(text, width, width)) {
      EXPECT_LE(display_width(piece), width) << piece;
      all += piece;
    }
    EXPECT_EQ(without_blanks(all), without_blanks(text));
  }
}

TEST(Broken, BreaksBehindABlankElseBehindASignElseAnywhere) {
  using Pieces = std::vector<std::string>;
  EXPECT_EQ(broken("aaa bbbb", 6, 6), (Pieces{"aaa", "bbbb"}));
  for (const std::string sign : {",", "/", ":"})
    EXPECT_EQ(broken("abc" + sign + "defgh", 6, 6), (Pieces{"abc" + sign, "defgh"}));
  EXPECT_EQ(broken("ab c/defghi", 6, 9), (Pieces{"ab", "c/defghi"})) << "half of the line";
  EXPECT_EQ(broken("ab c/defghi", 7, 9), (Pieces{"ab c/", "defghi"})) << "less than half";
  EXPECT_EQ(broken("ab_cdefg", 5, 5), (Pieces{"ab_", "cdefg"}));
  EXPECT_EQ(broken("abcdefgh", 4, 4), (Pieces{"abcd", "efgh"}));
  EXPECT_EQ(broken("   abcdefgh", 6, 6), (Pieces{"   abc", "defgh"})) << "not behind an indent";
}

TEST(Folded, NoLineIsWiderAndShortOnesStayAsTheyAre) {
  const std::string text =
      "16 initial penetrations on 9 nodes, deepest 0.35 of a gap of 1.25\n"
      "    = help: " +
      std::string(90, 'x') + "\n  short\n\n\x1b[1mbold text that goes on and on and on\x1b[0m\n";
  for (const std::size_t width : {20u, 30u, 80u}) {
    const std::string out = folded(text, width);
    std::istringstream lines(out);
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(display_width(line), width) << line;
    EXPECT_NE(out.find("\n  short\n\n"), std::string::npos);
    EXPECT_EQ(without_blanks(out), without_blanks(text));
  }
  EXPECT_EQ(folded(text, 0), text);
  EXPECT_EQ(folded("  interface 3 has no gap", 20), "  interface 3 has no\n    gap");
}

TEST(Wrapped, SetsWordsBehindAnIndent) {
  EXPECT_EQ(wrapped("one two  three", 2, 9), "  one two\n  three\n");
  EXPECT_EQ(wrapped("", 2, 9), "");
}

}  // namespace
}  // namespace deck
