// Tests of replaced spans and of diffs.
#include "text/shared/edits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace deck {
namespace {

std::unique_ptr<Source> source(std::string text) {
  return Source::from_bytes("x.rad", std::move(text));
}

TextEdit edit(std::uint64_t offset, std::uint32_t length, std::string text) {
  return {Span{0, length, offset}, std::move(text)};
}

TEST(ApplyEdits, LeaveAllOtherBytesAsTheyAre) {
  const auto s = source("abc\r\ndef\tg \n\xff\xfehi");
  EXPECT_EQ(*apply_edits(*s, {edit(5, 3, "DEF"), edit(0, 1, "A")}), "Abc\r\nDEF\tg \n\xff\xfehi");
  EXPECT_EQ(*apply_edits(*s, {}), s->bytes());
  const auto letters = source("abcdef");
  EXPECT_EQ(*apply_edits(*letters, {edit(1, 2, "X"), edit(1, 2, "X")}), "aXdef") << "once";
  EXPECT_EQ(*apply_edits(*letters, {edit(1, 0, "1"), edit(1, 0, "2"), edit(1, 1, "B")}), "a12Bcdef")
      << "insertions keep their order";
}

TEST(ApplyEdits, RefuseWhatOverlapsAndSayWhere) {
  const auto s = source("abc\ndef\n");
  const auto result = apply_edits(*s, {edit(4, 2, "X"), edit(5, 2, "Y")});
  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.error().message.find("x.rad:2:2"), std::string::npos) << result.error().message;
  EXPECT_FALSE(apply_edits(*s, {edit(4, 2, "X"), edit(4, 2, "Y")}).ok());
  EXPECT_FALSE(apply_edits(*s, {edit(7, 2, "X")}).ok()) << "behind the end of the file";
}

struct Lines {
  explicit Lines(std::string text) { sources.add(source(std::move(text))); }
  std::string after(CellWriter& cells) const {
    return *apply_edits(sources[0], cells.release_edits());
  }
  SourceSet sources;
};

TEST(CellWriter, PutATextAtTheRightOfItsColumns) {
  const auto put = [](std::string line, int first, int last, std::string_view text) {
    CellWriter::put(line, first, last, text);
    return line;
  };
  EXPECT_EQ(put("0123456789", 3, 6, "x"), "01   x6789");
  EXPECT_EQ(put("0123456789", 3, 6, "abcd"), "01abcd6789");
  EXPECT_EQ(put("0123", 3, 6, "x"), "01   x");
  EXPECT_EQ(put("0", 3, 6, "x"), "0    x");
  EXPECT_EQ(put("", 1, 3, "x"), "  x");
  EXPECT_EQ(put("0123456789", 3, 6, ""), "01    6789");
  EXPECT_EQ(put("0123", 3, 6, ""), "01  ") << "what is not there need not be blanked";
  EXPECT_EQ(put("01", 3, 6, ""), "01");
  EXPECT_EQ(put("0123", 4, 4, "x"), "012x");
}

TEST(CellWriter, EditInPlaceEndsWhereTheTextBeforeEnded) {
  const auto edited = [](const std::string& text, int first, int last, std::string_view cell) {
    const Lines l(text);
    return *apply_edits(l.sources[0],
                        {CellWriter::edit_in_place(l.sources, {0, 0, 0}, first, last, cell)});
  };
  EXPECT_EQ(edited("ab 12  89\n", 3, 7, "7"), "ab  7  89\n");
  EXPECT_EQ(edited("ab 12  89\n", 3, 7, "777"), "ab777  89\n");
  EXPECT_EQ(edited("ab 12  89\n", 3, 7, "7777"), "ab7777 89\n") << "longer: further right";
  EXPECT_EQ(edited("ab     89\n", 3, 7, "7"), "ab    789\n") << "blank: at the right";
  for (const std::string end : {"", "\n", "\r\n", "\r"})
    EXPECT_EQ(edited("ab 1" + end, 3, 7, "7"), "ab 7" + end) << "the line ends in the cell";
  EXPECT_EQ(edited("ab 1\r2\n", 3, 6, "7"), "ab   7\n") << "no end of a line";
}

TEST(CellWriter, ChangeNothingButTheirColumns) {
  std::mt19937 random(11);
  for (int round = 0; round < 2000; ++round) {
    std::string line(random() % 60, ' ');
    for (char& c : line) c = static_cast<char>('a' + random() % 26);
    const std::string end = random() % 2 != 0 ? "\n" : "\r\n";
    const Lines l("head" + end + line + end + "tail");
    CellWriter cells(l.sources);
    std::string expected = line;
    for (int cell = 0; cell < 5; ++cell) {
      if (random() % 2 != 0) continue;
      const int first = cell * 10 + 1;
      const std::string text(1 + random() % 10, static_cast<char>('0' + random() % 10));
      cells.set({0, 0, 4 + end.size()}, first, first + 9, text);
      const std::size_t need = static_cast<std::size_t>(first) + 9;
      if (expected.size() < need) expected.resize(need, ' ');
      expected.replace(need - 10, 10, std::string(10 - text.size(), ' ') + text);
    }
    EXPECT_EQ(l.after(cells), "head" + end + expected + end + "tail");
  }
}

TEST(UnifiedDiff, HasThreeLinesOfContextAndJoinsWhatIsNear) {
  const auto lines = [](int n, const std::vector<int>& changed) {
    std::string text;
    for (int i = 1; i <= n; ++i) {
      const bool other = std::find(changed.begin(), changed.end(), i) != changed.end();
      text += (other ? "x" : "") + std::to_string(i) + "\n";
    }
    return text;
  };
  EXPECT_EQ(unified_diff("./d/f", lines(9, {}), lines(9, {5})),
            "--- a/d/f\n+++ b/d/f\n@@ -2,7 +2,7 @@\n 2\n 3\n 4\n-5\n+x5\n 6\n 7\n 8\n");
  EXPECT_EQ(unified_diff("/f", "1\n", "1\n2"),
            "--- a/f\n+++ b/f\n@@ -1 +1,2 @@\n 1\n+2\n\\ No newline at end of file\n");
  EXPECT_EQ(unified_diff("f", "", "1\n"), "--- a/f\n+++ b/f\n@@ -0,0 +1 @@\n+1\n");
  EXPECT_EQ(unified_diff("f", "1\n", ""), "--- a/f\n+++ b/f\n@@ -1 +0,0 @@\n-1\n");
  EXPECT_EQ(unified_diff("f", "1\n", "1\n"), "");
  const std::string quoted = unified_diff("parts/\x1b[1m\"a\\.inc", "1\n", "2\n");
  EXPECT_EQ(quoted.substr(0, quoted.find('\n')), R"(--- "a/parts/\033[1m\042a\134.inc")");
  const auto pieces = [&](int second) {
    const std::string diff = unified_diff("f", lines(20, {}), lines(20, {5, second}));
    std::size_t n = 0;
    for (std::size_t at = 0; (at = diff.find("\n@@", at)) != diff.npos; ++at) ++n;
    return n;
  };
  EXPECT_EQ(pieces(12), 1u) << "six lines between: their contexts touch";
  EXPECT_EQ(pieces(13), 2u);
}

}  // namespace
}  // namespace deck
