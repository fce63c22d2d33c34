// Distance of words against its definition; a length as text.
#include "base/shared/words.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace deck {
namespace {

/// The definition, without a table.
std::size_t by_definition(std::string_view a, std::string_view b) {
  if (a.empty() || b.empty()) return a.size() + b.size();
  const std::size_t kept = by_definition(a.substr(1), b.substr(1)) + (a[0] != b[0]);
  return std::min({kept, by_definition(a.substr(1), b) + 1, by_definition(a, b.substr(1)) + 1});
}

TEST(EditDistance, IsThatOfTheDefinitionForAllShortWords) {
  std::vector<std::string> words = {""};
  for (std::size_t i = 0; words[i].size() < 4; ++i)
    for (const char c : {'a', 'b'}) words.push_back(words[i] + c);
  for (const std::string& a : words)
    for (const std::string& b : words) {
      EXPECT_EQ(edit_distance(a, b), by_definition(a, b)) << a << " " << b;
      const bool far = a.size() > b.size() + 1 || b.size() > a.size() + 1;
      EXPECT_EQ(edit_distance(a, b, 1), far ? 2 : by_definition(a, b)) << a << " " << b;
    }
}

TEST(ClosestWord, IsTheNearestOneWhateverItsLetters) {
  const std::vector<std::string> known = {"lint", "params", "gaps", "cycle", "Gapmin", "13", "130"};
  EXPECT_EQ(closest_word("lnit", known), "lint");
  EXPECT_EQ(closest_word("LINT", known), "lint");
  EXPECT_EQ(closest_word("gapmni", known), "Gapmin");
  EXPECT_EQ(closest_word("gap", known), "gaps");
  EXPECT_EQ(closest_word("134", known), "13") << "the first of those that are as close";
  EXPECT_EQ(closest_word("nothing", known), "");
  EXPECT_EQ(closest_word("xy", known), "") << "a short word has to be closer";
  EXPECT_EQ(closest_word("", known), "");
}

TEST(ClosestWord, MayDifferInOneTwoOrThreeLettersByItsLength) {
  const std::pair<std::string, std::size_t> words[] = {
      {"ab", 1}, {"abc", 2}, {"abcde", 2}, {"abcdef", 3}, {"abcdefghi", 3}};
  for (const auto& [word, most] : words)
    for (std::size_t wrong = 1; wrong <= std::min<std::size_t>(word.size(), 4); ++wrong) {
      std::string other = word;
      for (std::size_t i = 0; i < wrong; ++i) other[i] = 'X';
      EXPECT_EQ(closest_word(word, {other}), wrong <= most ? other : "") << word << " " << wrong;
    }
}

TEST(LengthText, HasDigitsAsAskedForAndIsUnboundedBeyondTheBound) {
  EXPECT_EQ(length_text(1.23456789), "1.23457");
  EXPECT_EQ(length_text(1.23456789, 3), "1.23");
  EXPECT_EQ(length_text(-0.0), "-0");
  for (const double v : {std::nan(""), double{INFINITY}, -double{INFINITY}, 1.4e154, 1.7e308})
    EXPECT_EQ(length_text(v), "unbounded") << v;
  EXPECT_EQ(length_text(1e154), "1e+154") << "its square is a number";
  EXPECT_EQ(length_text(10, 6, 10), "10");
  EXPECT_EQ(length_text(-10.5, 6, 10), "unbounded");
}

}  // namespace
}  // namespace deck
