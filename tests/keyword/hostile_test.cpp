// Decks that are broken on purpose: a clear error, bounded memory, nothing lost. Bounded time, long
// lines, a million blocks and deep chains are held by tests/robustness/hostile.py and bounds.py.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "keyword/reading.hpp"

namespace deck {
namespace {

using namespace testing_support;
using ::testing::HasSubstr;

void decode_all(const Deck& deck) {
  Findings findings;
  for (const Block& b : deck.blocks) decode(deck, b, &findings);
}

using Hostile = Folder;

TEST_F(Hostile, NumbersBeyondThirtyTwoBitsKeepTheirSignAndAreReported) {
  const Deck deck =
      read(deck_of("/PARAMETER/GLOBAL/INTEGER/1\nwide\nwide      4294967299\n"
                   "/SURF/PART/7\nt\n4294967299-999999999     &wide    -&wide\n"
                   "/SURF/PART/99999999999999999999999\nt\n         1\n"
                   "/SURF/PART/2147483647\nt\n         1\n"));
  Findings findings;
  const DecodedBlock d = decode(deck, *block(deck, "/SURF/PART/7"), &findings);
  std::vector<std::int64_t> ids;
  for (const DecodedCard& card : d.cards)
    for (const Cell& cell : card.cells)
      if (cell.field->type == FieldType::id) ids.push_back(cell.integer);
  EXPECT_EQ(ids, (std::vector<std::int64_t>{2147483647, -999999999, 2147483647, -2147483647}));
  EXPECT_EQ(findings.counts().at(RuleId::DK023), 3u);
  EXPECT_EQ(count(deck.findings, RuleId::DK335), 1u);
}

TEST_F(Hostile, AnIdOfAParameterIsReportedOnlyBeyondThirtyTwoBits) {
  for (const auto& [value, findings] :
       {std::pair{"         9", 0u}, {"2147483647", 0u}, {"2147483648", 1u}, {"9999999999", 1u}}) {
    const Deck deck = read(deck_of("/PARAMETER/GLOBAL/INTEGER/1\nt\nbig       " +
                                   std::string(value) + "\n/SURF/PART/&big\nt\n         1\n"));
    EXPECT_EQ(count(deck.findings, RuleId::DK335), findings) << value;
    EXPECT_EQ(count(deck.findings, RuleId::DK018), 0u) << value;
    const Block* surf = block(deck, "/SURF/PART/&big");
    ASSERT_NE(surf, nullptr);
    EXPECT_EQ(surf->id.value, std::min<std::int64_t>(std::stoll(value), 2147483647));
  }
}

TEST_F(Hostile, ALineOfSlashesHashesOrBlanksIsNoTrap) {
  for (const char c : {'/', '#', ' ', '\t', '&', ',', '\0', '\r'}) {
    const std::string line(8 << 20, c);
    // The comment keeps the head of the file from looking like a binary.
    const Deck d = read(deck_of("# " + std::string(5000, '-') + "\n/NODE\n" + line + "\n x" + line +
                                "\n" + line + "/\n"));
    EXPECT_TRUE(d.end_seen);
    decode_all(d);
  }
}

TEST_F(Hostile, TenThousandNestedIncludesStopAtTheDepthLimit) {
  for (int i = 0; i < 10000; ++i)
    file("f" + std::to_string(i), "#include f" + std::to_string(i + 1) + "\n/GRNOD/NODE/1\n");
  file("f10000", "/NODE\n");
  const std::string main = file("m_0000.rad", deck_of("#include f0\n"));
  const Deck d = read_file(main);
  EXPECT_EQ(count(d.findings, RuleId::DK006), 1u);
  EXPECT_THAT(first(d.findings, RuleId::DK006)->message, HasSubstr("deeper than 100"));
  ReadOptions options;
  options.limits.include_depth = 1000000;
  EXPECT_THAT(first(read_file(main, options).findings, RuleId::DK006)->message,
              HasSubstr("deeper than 250 "));
}

TEST_F(Hostile, AnIncludeBombStopsAtTheNumberOfFiles) {
  // Ten levels, each including the next one ten times: ten thousand million files.
  for (int i = 0; i < 10; ++i) {
    std::string text;
    for (int k = 0; k < 10; ++k) text += "#include f" + std::to_string(i + 1) + "\n";
    file("f" + std::to_string(i), text);
  }
  file("f10", "/NODE\n");
  ReadOptions options;
  options.limits.files = 500;
  const Deck d = read_file(file("m_0000.rad", deck_of("#include f0\n")), options);
  EXPECT_EQ(d.sources.size(), 500u);
  EXPECT_GT(count(d.findings, RuleId::DK006), 0u);
}

/// RssAnon of this process.
long anonymous_kilobytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("RssAnon:")) return std::stol(line.substr(8));
  return 0;
}

TEST_F(Hostile, AFileIncludedOftenDoesNotPileUpInMemory) {
  file("a.inc", "# " + std::string(1 << 20, 'x') + "\n");
  std::string body;
  for (int i = 0; i < 600; ++i) body += "#include a.inc\n";
  ReadOptions options;
  options.limits.map_threshold = 2 << 20;
  // Memory of the process itself: the system takes pages of mapped files back when it needs them.
  const long before = anonymous_kilobytes();
  const Deck d = read_file(file("m_0000.rad", deck_of(body)), options);
  const long after = anonymous_kilobytes();
  EXPECT_EQ(d.sources.size(), 601u);
  EXPECT_GT(before, 0);
  EXPECT_LT(after - before, 200 * 1024);
}

TEST_F(Hostile, TheTotalSizeIsBounded) {
  file("a.inc", std::string(1000, '#') + "\n");
  ReadOptions options;
  options.limits.total_bytes = 2500;
  const Deck d = read_file(
      file("m_0000.rad", deck_of("#include a.inc\n#include a.inc\n#include a.inc\n")), options);
  EXPECT_EQ(d.sources.size(), 3u);
  EXPECT_EQ(count(d.findings, RuleId::DK006), 1u);
}

TEST_F(Hostile, IncludesOfFifosDirectoriesAndBinariesAreNamed) {
  ASSERT_EQ(::mkfifo((dir_ / "fifo").c_str(), 0600), 0);
  std::filesystem::create_directory(dir_ / "folder");
  file("binary", std::string(5000, '\0'));
  const Deck d = read_file(file("m_0000.rad", deck_of("#include fifo\n#include folder\n"
                                                      "#include binary\n#include /dev/zero\n")));
  ASSERT_EQ(count(d.findings, RuleId::DK004), 4u);
  const auto& all = d.findings.all();
  EXPECT_THAT(all[0].message, HasSubstr("not a regular file"));
  EXPECT_THAT(all[1].message, HasSubstr("directory"));
  EXPECT_THAT(all[2].message, HasSubstr("binary"));
  EXPECT_THAT(all[3].message, HasSubstr("not a regular file"));
}

TEST_F(Hostile, DeeplyNestedExpressionsEndInAnError) {
  for (const char* unit : {"(", "-", "sqrt(", "2^", "1+(", "+"}) {
    std::string text;
    while (text.size() < 85) text += unit;
    std::string lines = "/PARAMETER/GLOBAL/REAL_EXPR/1\nt\nA         " + text + "\n";
    const Deck d = read(deck_of(lines));
    EXPECT_EQ(count(d.findings, RuleId::DK019), 1u) << unit;
  }
}

}  // namespace
}  // namespace deck
