// Tests of files, lines and columns.
#include "deck/text/source.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "deck/text/diagnostic.hpp"
#include "deck/text/rule_id.hpp"
#include "text/shared/gzip.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;

class SourceFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    dir_ = fs::temp_directory_path() /
           ("deck_source_" + std::to_string(::getpid()) + "_" +
            ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(dir_);
  }
  void TearDown() override { fs::remove_all(dir_); }
  std::string file(const std::string& name, const std::string& text) {
    std::ofstream(dir_ / name, std::ios::binary) << text;
    return dir_ / name;
  }
  fs::path dir_;
};

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
}

TEST(SourcePosition, EndOfFileAfterANewlineIsTheNextLine) {
  const auto s = Source::from_bytes("x", "a\n");
  EXPECT_EQ(s->position(2).line, 2u);
  EXPECT_EQ(s->position(2).column, 1u);
  EXPECT_EQ(Source::from_bytes("x", "")->position(0).line, 1u);
}

TEST(SourcePosition, CheckpointsAgreeWithCounting) {
  std::string text;
  std::uint64_t state = 1;
  while (text.size() < 400000) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    text.append((state >> 33) % 120, 'x') += '\n';
  }
  const auto s = Source::from_bytes("x", text);
  // Backwards first, so that checkpoints are made in one go and then used.
  for (const std::uint64_t offset : {text.size(), std::size_t{262144}, std::size_t{262143},
                                     std::size_t{65536}, std::size_t{65535}, std::size_t{7}}) {
    const std::string_view before = std::string_view(text).substr(0, offset);
    EXPECT_EQ(s->position(offset).line,
              1u + static_cast<std::uint64_t>(std::count(before.begin(), before.end(), '\n')));
    EXPECT_EQ(s->position(offset).column, offset - (before.rfind('\n') + 1) + 1);
  }
}

TEST(SourceLine, IsTheWholeLineWithoutItsEnd) {
  const auto s = Source::from_bytes("x", "one\r\ntwo\nthree");
  EXPECT_EQ(s->line_at(1), "one");
  EXPECT_EQ(s->line_at(4), "one");
  EXPECT_EQ(s->line_at(5), "two");
  EXPECT_EQ(s->line_at(14), "three");
  EXPECT_EQ(s->line_at(1000), "three");
}

TEST_F(SourceFiles, MissingDirectoryAndFifoAreErrorsThatNameTheFile) {
  const auto message = [](const std::string& path) {
    const auto r = Source::open(path, {});
    EXPECT_FALSE(r.ok());
    return r ? std::string() : r.error().message;
  };
  EXPECT_NE(message(dir_ / "none").find("No such file"), std::string::npos);
  EXPECT_NE(message(dir_ / "none").find("none"), std::string::npos);
  EXPECT_NE(message(dir_).find("directory"), std::string::npos);
  const std::string fifo = dir_ / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_NE(message(fifo).find("not a regular file"), std::string::npos);
  EXPECT_NE(message("/dev/zero").find("not a regular file"), std::string::npos);
}

TEST_F(SourceFiles, AFileOverTheLimitIsRefusedBeforeItIsRead) {
  Limits limits;
  limits.total_bytes = 10;
  const auto r = Source::open(file("a", "12345678901"), limits);
  ASSERT_FALSE(r.ok());
  EXPECT_EQ(r.error().code, Error::Code::limit);
  EXPECT_TRUE(Source::open(file("b", "1234567890"), limits).ok());
}

TEST_F(SourceFiles, MappedAndReadFilesHoldTheSameBytes) {
  std::string text;
  for (int i = 0; i < 30000; ++i) text += std::to_string(i) + '\n';
  const std::string path = file("a", text);
  Limits limits;
  limits.map_threshold = 1000;
  const auto mapped = Source::open(path, limits);
  const auto read = Source::open(path, {});
  ASSERT_TRUE(mapped.ok() && read.ok());
  EXPECT_EQ((*mapped)->bytes(), text);
  EXPECT_EQ((*read)->bytes(), text);
  EXPECT_EQ((*mapped)->inode(), (*read)->inode());
}

/// Resident bytes of the mapping that holds `p`.
std::uint64_t resident(const void* p) {
  std::ifstream in("/proc/self/smaps");
  std::string line;
  bool inside = false;
  while (std::getline(in, line)) {
    std::uint64_t first = 0, last = 0;
    if (std::sscanf(line.c_str(), "%lx-%lx ", &first, &last) == 2 && line.find('-') < 17)
      inside =
          first <= reinterpret_cast<std::uint64_t>(p) && reinterpret_cast<std::uint64_t>(p) < last;
    if (std::uint64_t kb = 0; inside && std::sscanf(line.c_str(), "Rss: %lu kB", &kb) == 1)
      return kb * 1024;
  }
  return 0;
}

TEST_F(SourceFiles, ReleasedPagesLeaveMemoryAndStayReadable) {
  const std::string text(8 << 20, 'x');
  Limits limits;
  limits.map_threshold = 1 << 20;
  const auto s = Source::open(file("a", text), limits);
  ASSERT_TRUE(s.ok());
  EXPECT_EQ((*s)->bytes(), text);  // touches all pages
  const std::uint64_t before = resident((*s)->bytes().data());
  if (before == 0) GTEST_SKIP() << "/proc/self/smaps is not available";
  (*s)->release(0, text.size());
  EXPECT_LT(resident((*s)->bytes().data()), before / 4);
  EXPECT_EQ((*s)->bytes(), text);
  (*s)->release(text.size() - 1, text.size());  // less than a page
  (*s)->release(100, 50);
  EXPECT_EQ((*s)->bytes(), text);
}

TEST(SourceSet, NamesPlacesAndClipsForeignSpans) {
  SourceSet set;
  set.add(Source::from_bytes("main.rad", "a\nbcd\n"));
  EXPECT_EQ(set.where({0, 1, 3}), "main.rad:2:2");
  EXPECT_EQ(set.text({0, 2, 3}), "cd");
  EXPECT_EQ(set.text({0, 5, 999}), "");
  EXPECT_EQ(set.text({}), "");
  EXPECT_EQ(set.where({}), "(no place)");
}

Diagnostic finding(RuleId rule, std::string message) {
  Diagnostic d;
  d.rule = rule;
  d.message = std::move(message);
  return d;
}

TEST(Diagnostics, KeepTheFirstOnesOfEachRuleAndCountTheRest) {
  Diagnostics d(2);
  for (int i = 0; i < 5; ++i) d.report(finding(RuleId::DK001, std::to_string(i)));
  d.report(finding(RuleId::DK002, "x"));
  d.count(RuleId::DK001, 10);
  EXPECT_EQ(d.all().size(), 3u);
  EXPECT_EQ(d.all()[1].message, "1");
  EXPECT_EQ(d.counts().at(RuleId::DK001), 15u);
  EXPECT_EQ(d.dropped(RuleId::DK001), 13u);
  EXPECT_TRUE(d.saturated(RuleId::DK001));
  EXPECT_FALSE(d.saturated(RuleId::DK002));
  EXPECT_FALSE(d.saturated(RuleId::DK003));
}

TEST(Diagnostics, MergingInOrderEqualsCollectingInOrder) {
  Diagnostics one(3), first(3), second(3);
  for (int i = 0; i < 8; ++i) {
    const Diagnostic d = finding(i % 2 ? RuleId::DK001 : RuleId::DK002, std::to_string(i));
    one.report(d);
    (i < 5 ? first : second).report(d);
  }
  first.merge(std::move(second));
  EXPECT_EQ(first.counts(), one.counts());
  ASSERT_EQ(first.all().size(), one.all().size());
  for (std::size_t i = 0; i < one.all().size(); ++i)
    EXPECT_EQ(first.all()[i].message, one.all()[i].message);
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
}

TEST(Gzip, SeveralMembersAndZerosBehindThemAreOneText) {
  const auto back = gunzip(gzip("one\n") + gzip("") + gzip("two\n") + std::string(512, '\0'), 100);
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(*back, "one\ntwo\n");
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

TEST(Gzip, ATextLongerThanTheLimitIsRefused) {
  const std::string packed = gzip("0123456789");
  EXPECT_TRUE(gunzip(packed, 10).ok());
  const auto r = gunzip(packed, 9);
  ASSERT_FALSE(r.ok());
  EXPECT_EQ(r.error().code, Error::Code::limit);
  EXPECT_EQ(gunzip_head(packed, 4), "0123");
}

TEST_F(SourceFiles, LinesOfALargeFileAreCountedThoughItsPagesAreGivenBack) {
  const std::string text = numbered_lines(800000);  // more than one stretch that is given back
  Limits limits;
  limits.map_threshold = 100;
  const auto s = Source::open(file("large", text), limits);
  ASSERT_TRUE(s.ok()) << s.error().message;
  constexpr std::size_t stretch = std::size_t{8} << 20;
  ASSERT_GT(text.size(), stretch + 4096);
  for (const std::size_t offset : {text.size() - 1, stretch + 1, stretch, stretch - 1}) {
    const std::string_view before = std::string_view(text).substr(0, offset);
    EXPECT_EQ((*s)->position(offset).line,
              1u + static_cast<std::uint64_t>(std::count(before.begin(), before.end(), '\n')));
  }
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
}

}  // namespace
}  // namespace deck
