// Tests of files, lines and columns.
#include "deck/text.hpp"

#include <gtest/gtest.h>

#include "deck/rule_id.hpp"
#include "keyword/reading.hpp"
#include "text/shared/gzip.hpp"

namespace deck {
namespace {

using SourceFiles = testing_support::Folder;

TEST(SourcePosition, CountsLinesAndByteColumnsFromOne) {
  const auto s = Source::from_bytes("x", "ab\r\n\n\tc\nlast");
  const auto at = [&](std::uint64_t offset) {
    const Position p = s->position(offset);
    return std::pair{p.line, p.column};
  };
  EXPECT_EQ(at(0), std::pair(std::uint64_t{1}, std::uint64_t{1}));
  EXPECT_EQ(at(1), std::pair(std::uint64_t{1}, std::uint64_t{2}));
  EXPECT_EQ(at(4), std::pair(std::uint64_t{2}, std::uint64_t{1}));
  EXPECT_EQ(at(6), std::pair(std::uint64_t{3}, std::uint64_t{2}));
  EXPECT_EQ(at(12), std::pair(std::uint64_t{4}, std::uint64_t{5}));  // the end of the file
  EXPECT_EQ(at(99), at(12));
  const auto ended = Source::from_bytes("x", "a\n");
  EXPECT_EQ(ended->position(2).line, 2u) << "behind the last newline";
  EXPECT_EQ(ended->position(2).column, 1u);
  EXPECT_EQ(Source::from_bytes("x", "")->position(0).line, 1u);
}

void expect_positions(const Source& s, std::string_view text,
                      std::initializer_list<std::size_t> offsets) {
  for (const std::size_t offset : offsets) {
    const std::string_view before = text.substr(0, offset);
    EXPECT_EQ(s.position(offset).line,
              1u + static_cast<std::uint64_t>(std::count(before.begin(), before.end(), '\n')));
    EXPECT_EQ(s.position(offset).column, offset - (before.rfind('\n') + 1) + 1);
  }
}

TEST(SourcePosition, CheckpointsAgreeWithCounting) {
  std::string text;
  std::uint64_t state = 1;
  while (text.size() < 400000) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    text.append((state >> 33) % 120, 'x') += '\n';
  }
  // Backwards first, so that checkpoints are made in one go and then used.
  expect_positions(*Source::from_bytes("x", text), text,
                   {text.size(), 262144, 262143, 65536, 65535, 7});
}

/// Resident pages of mapped files, in kilobytes.
long mapped_kilobytes() {
  std::ifstream status("/proc/self/status");
  long sum = 0;
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("RssFile:") || line.starts_with("RssShmem:"))
      sum += std::stol(line.substr(9));
  return sum;
}

TEST_F(SourceFiles, ReleasedPagesLeaveMemoryAndStayReadable) {
  const std::string text(8 << 20, 'x');
  Limits limits;
  limits.map_threshold = 1 << 20;
  const std::string path = file("a", text);
  const auto s = Source::open(path, limits);
  ASSERT_TRUE(s.ok());
  EXPECT_EQ((*s)->bytes(), text);  // touches all pages
  EXPECT_EQ((*s)->inode(), (*Source::open(path, {}))->inode()) << "mapped and read";
  const long before = mapped_kilobytes();
  (*s)->release(0, text.size());
  EXPECT_LT(mapped_kilobytes(), before - 6 * 1024);
  EXPECT_EQ((*s)->bytes(), text);
  (*s)->release(text.size() - 1, text.size());  // less than a page
  (*s)->release(100, 50);
  EXPECT_EQ((*s)->bytes(), text);
}

TEST(SourceSet, NamesLinesPlacesAndClipsForeignSpans) {
  SourceSet set;
  set.add(Source::from_bytes("main.rad", "a\nbcd\n"));
  EXPECT_EQ(set.where({0, 1, 3}), "main.rad:2:2");
  EXPECT_EQ(set.text({0, 2, 3}), "cd");
  EXPECT_EQ(set.text({0, 5, 999}), "");
  EXPECT_EQ(set.text({}), "");
  EXPECT_EQ(set.where({}), "(no place)");
  const auto s = Source::from_bytes("x", "one\r\ntwo\nthree");
  EXPECT_EQ(s->line_at(4), "one") << "without its end";
  EXPECT_EQ(s->line_at(5), "two");
  EXPECT_EQ(s->line_at(1000), "three");
}

Finding finding(RuleId rule, std::string message) {
  Finding d;
  d.rule = rule;
  d.message = std::move(message);
  return d;
}

TEST(Findings, KeepTheFirstOnesOfEachRuleAndMergeInOrder) {
  Findings one(3), first(3), second(3);
  for (int i = 0; i < 8; ++i) {
    const Finding d = finding(i % 2 ? RuleId::DK001 : RuleId::DK002, std::to_string(i));
    one.report(d);
    (i < 5 ? first : second).report(d);
  }
  first.merge(std::move(second));
  EXPECT_EQ(first.counts(), one.counts());
  ASSERT_EQ(first.all().size(), 6u);
  ASSERT_EQ(one.all().size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(first.all()[i].message, one.all()[i].message);
  first.count(RuleId::DK001, 10);
  EXPECT_EQ(first.counts().at(RuleId::DK001), 14u);
  EXPECT_EQ(first.dropped(RuleId::DK001), 11u);
  EXPECT_TRUE(first.saturated(RuleId::DK001));
  EXPECT_FALSE(first.saturated(RuleId::DK003));
}

// ---- packed files

std::string numbered_lines(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += "line " + std::to_string(i * 7919 % 100003) + '\n';
  return text;
}

TEST(Gzip, WhatIsPackedUnpacksToTheSameText) {
  for (const int lines : {0, 1, 3, 1000, 200000}) {
    const std::string text = numbered_lines(lines), packed = gzip(text);
    const auto back = gunzip(packed, text.size());
    ASSERT_TRUE(back.ok()) << lines << ": " << back.error().message;
    EXPECT_EQ(*back, text);
    EXPECT_EQ(gzip(text), packed) << "the same bytes every time";
  }
  const auto members =
      gunzip(gzip("one\n") + gzip("") + gzip("two\n") + std::string(512, '\0'), 100);
  ASSERT_TRUE(members.ok()) << members.error().message;
  EXPECT_EQ(*members, "one\ntwo\n") << "several members, and zeros behind them";
}

TEST(Gzip, EveryTruncationIsAnErrorThatSaysHowFarTheTextGoes) {
  const std::string packed = gzip(numbered_lines(40));
  for (std::size_t length = 2; length < packed.size(); ++length) {
    const auto r = gunzip(std::string_view(packed).substr(0, length), 1 << 20);
    ASSERT_FALSE(r.ok()) << length;
    EXPECT_NE(r.error().message.find("incomplete: after"), std::string::npos) << r.error().message;
    EXPECT_NE(r.error().message.find("in line"), std::string::npos) << r.error().message;
  }
}

TEST(Gzip, OfATextWhoseChecksumIsCutOffEverythingIsThere) {
  std::string text;  // much of it is still to come when the last byte has been read
  for (int i = 0; i < 1'000'000; ++i) text += "x\n";
  const std::string packed = gzip(text);
  const auto r = gunzip(std::string_view(packed).substr(0, packed.size() - 8), text.size());
  ASSERT_FALSE(r.ok());
  EXPECT_NE(r.error().message.find("in line 1000001"), std::string::npos) << r.error().message;
}

TEST(Gzip, NoChangedBytePassesUnnoticed) {
  const std::string text = numbered_lines(40), packed = gzip(text);
  for (std::size_t i = 10; i < packed.size(); ++i) {  // behind the header, which holds no check
    std::string broken = packed;
    broken[i] = static_cast<char>(broken[i] ^ 0x10);
    EXPECT_FALSE(gunzip(broken, 1 << 20).ok()) << i;
  }
  EXPECT_FALSE(gunzip(packed + "rubbish", 1 << 20).ok());
}

TEST_F(SourceFiles, LinesOfALargeFileAreCountedThoughItsPagesAreGivenBack) {
  const std::string text = numbered_lines(800000);  // more than one stretch that is given back
  Limits limits;
  limits.map_threshold = 100;
  const auto s = Source::open(file("large", text), limits);
  ASSERT_TRUE(s.ok()) << s.error().message;
  constexpr std::size_t stretch = std::size_t{8} << 20;
  ASSERT_GT(text.size(), stretch + 4096);
  expect_positions(**s, text, {text.size() - 1, stretch + 1, stretch, stretch - 1});
  EXPECT_EQ((*s)->bytes(), text);
}

TEST_F(SourceFiles, APackedFileHasTheLinesOfItsTextAndKeepsWhatIsOnDisk) {
  const std::string text = numbered_lines(3000), packed = gzip(text);
  for (const std::uint64_t threshold : {std::uint64_t{1} << 20, std::uint64_t{100}}) {
    Limits limits;
    limits.map_threshold = threshold;  // read, and mapped
    const auto s = Source::open_text(file("a.gz", packed), limits);
    ASSERT_TRUE(s.ok()) << s.error().message;
    EXPECT_TRUE((*s)->packed());
    (*s)->release(0, text.size());
    EXPECT_EQ((*s)->bytes(), text);
    EXPECT_EQ((*s)->on_disk(), packed);
    EXPECT_EQ((*s)->position(text.size() - 1).line, 3000u);
    EXPECT_NE((*s)->inode(), 0u);
  }
  const auto plain = Source::open_text(file("b", text), {});
  ASSERT_TRUE(plain.ok());
  EXPECT_FALSE((*plain)->packed());
  EXPECT_EQ((*plain)->on_disk(), text);
}

TEST_F(SourceFiles, ABombEndsWithTheLimitAndNamesItsFile) {
  const std::string bomb = gzip(std::string(std::size_t{100} << 20, ' '));
  ASSERT_LT(bomb.size(), std::size_t{200} << 10);
  const auto r = Source::open_text(file("bomb.gz", bomb), {});
  ASSERT_FALSE(r.ok());
  EXPECT_EQ(r.error().code, Error::Code::limit);
  EXPECT_NE(r.error().message.find("bomb.gz: is packed with gzip"), std::string::npos);
  Limits small;
  small.unpacked_bytes = 1000;
  EXPECT_FALSE(Source::open_text(file("c.gz", gzip(std::string(1001, 'x'))), small).ok());
  EXPECT_TRUE(Source::open_text(file("d.gz", gzip(std::string(1000, 'x'))), small).ok());
  EXPECT_EQ(gunzip_head(gzip("0123456789"), 4), "0123");
}

}  // namespace
}  // namespace deck
