// Lines that a change touched, and findings that move there.
#include "lint/shared/gate.hpp"

#include <gtest/gtest.h>

namespace deck {
namespace {

constexpr const char* text = "one\ntwo\nthree\nfour\nfive\n";

struct Changes : testing::Test {
  void SetUp() override { sources.add(Source::from_bytes("models/a.rad", text)); }
  /// The span of a stretch of the text.
  static Span span(std::string_view of) {
    const auto at = std::string_view(text).find(of);
    return {0, static_cast<std::uint32_t>(of.size()), at};
  }
  std::string first(std::string_view of) {
    const Span found = ChangedPlaces(lines, sources).first_in(span(of));
    return found.valid() ? std::string(sources.text(found)) : "";
  }
  SourceSet sources;
  ChangedLines lines;
};

TEST_F(Changes, AreFoundInASpan) {
  EXPECT_TRUE(lines.empty());
  EXPECT_EQ(first("two"), "");
  lines.add("models/./a.rad", 2, 1);
  lines.add("models/a.rad", 4, 2);
  EXPECT_EQ(first("one"), "");
  EXPECT_EQ(first("two"), "two");
  EXPECT_EQ(first("wo"), "wo") << "as far as the span goes";
  EXPECT_EQ(first("three\nfour\nfive"), "four");
  EXPECT_EQ(first("one\ntwo\nthree"), "two");
  EXPECT_EQ(first("five"), "five");
  EXPECT_FALSE(ChangedPlaces(lines, sources).first_in({}).valid());
  lines.add("other.rad", 1, 5);
  EXPECT_EQ(first("one"), "");
}

TEST_F(Changes, AreReadFromThePatchOfAFile) {
  lines.add_hunks("models/a.rad",
                  "diff --git a/x b/x\n--- a/x\n+++ b/x\n@@ -2 +2 @@ one\n-zwei\n+two\n"
                  "@@ -4,2 +3,0 @@ two\n-a\n-b\n@@ -9,0 +5,1 @@\n+five\n@@ broken\n"
                  "+@@ -1 +1 @@ is text\n");
  EXPECT_EQ(first("one"), "");
  EXPECT_EQ(first("two"), "two");
  EXPECT_EQ(first("three\nfour"), "") << "lines that went are nowhere";
  EXPECT_EQ(first("five"), "five");
}

TEST_F(Changes, DrawFindingsToThem) {
  lines.add("models/a.rad", 4, 1);
  Finding d;
  d.span = span("one");
  d.keyword = "/INTER/TYPE7";
  d.id = 3;
  d.notes = {{span("two"), "the node"}, {span("four"), "the other node"}};
  Finding there = d, nowhere = d;
  there.span = span("four");
  nowhere.notes.pop_back();
  std::vector<Finding> all = {d, there, nowhere};
  stand_at_changes(all, sources, lines);
  EXPECT_EQ(sources.text(all[0].span), "four");
  ASSERT_EQ(all[0].notes.size(), 2u);
  EXPECT_EQ(all[0].notes[0].second, "/INTER/TYPE7 3");
  EXPECT_EQ(sources.text(all[0].notes[0].first), "one");
  EXPECT_EQ(all[0].notes[1].second, "the node");
  EXPECT_EQ(sources.text(all[1].span), "four");
  EXPECT_EQ(all[1].notes.size(), 2u);
  EXPECT_EQ(sources.text(all[2].span), "one");
}

}  // namespace
}  // namespace deck
