// Decks that are broken on purpose: a clear error, bounded memory and time, nothing lost.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>

#include "keyword/reading.hpp"

namespace deck {
namespace {

using namespace testing_support;
using ::testing::HasSubstr;

std::string refusal(const std::string& path) {
  const auto deck = read_deck(path, SchemaSet::built_in());
  EXPECT_FALSE(deck.ok()) << path;
  return deck.ok() ? std::string() : deck.error().message;
}

void decode_all(const Deck& deck) {
  Diagnostics findings;
  for (const Block& b : deck.blocks) decode(deck, b, &findings);
}

class Hostile : public Folder {
 protected:
  void SetUp() override {
    Folder::SetUp();
    start_ = std::chrono::steady_clock::now();
  }
  void TearDown() override {
    // Generous: a loaded machine and sanitizers are slow, but nothing may be quadratic.
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    EXPECT_LT(spent.count(), 60);
    Folder::TearDown();
  }
  std::chrono::steady_clock::time_point start_;
};

TEST_F(Hostile, NumbersBeyondThirtyTwoBitsKeepTheirSignAndAreReported) {
  const auto deck = read_deck(file("d_0000.rad",
                                   "#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n"
                                   "                  kg                  mm                  ms\n"
                                   "                  kg                  mm                  ms\n"
                                   "/PARAMETER/GLOBAL/INTEGER/1\nwide\nwide      4294967299\n"
                                   "/SURF/PART/7\nt\n4294967299-999999999     &wide    -&wide\n"
                                   "/SURF/PART/99999999999999999999999\nt\n         1\n"
                                   "/SURF/PART/2147483647\nt\n         1\n/END\n"),
                              SchemaSet::built_in());
  ASSERT_TRUE(deck.ok());
  Diagnostics findings;
  const Block* surf = nullptr;
  for (const Block& b : deck->blocks)
    if (b.header == "/SURF/PART/7") surf = &b;
  ASSERT_NE(surf, nullptr);
  const DecodedBlock d = decode(*deck, *surf, &findings);
  std::vector<std::int64_t> ids;
  for (const DecodedCard& card : d.cards)
    for (const Cell& cell : card.cells)
      if (cell.field->type == FieldType::id) ids.push_back(cell.integer);
  EXPECT_EQ(ids, (std::vector<std::int64_t>{2147483647, -999999999, 2147483647, -2147483647}));
  EXPECT_EQ(findings.counts().at(RuleId::DK023), 3u);
  EXPECT_EQ(count(deck->diagnostics, RuleId::DK335), 1u);
}

TEST_F(Hostile, AnIdOfAParameterIsReportedOnlyBeyondThirtyTwoBits) {
  for (const auto& [value, findings] :
       {std::pair{"         9", 0u}, {"2147483647", 0u}, {"2147483648", 1u}, {"9999999999", 1u}}) {
    const auto deck = read_deck(
        file("p_0000.rad", deck_of("/PARAMETER/GLOBAL/INTEGER/1\nt\nbig       " +
                                   std::string(value) + "\n/SURF/PART/&big\nt\n         1\n")),
        SchemaSet::built_in());
    ASSERT_TRUE(deck.ok());
    EXPECT_EQ(count(deck->diagnostics, RuleId::DK335), findings) << value;
    EXPECT_EQ(count(deck->diagnostics, RuleId::DK018), 0u) << value;
    const Block* surf = block(*deck, "/SURF/PART/&big");
    ASSERT_NE(surf, nullptr);
    EXPECT_EQ(surf->id.value, std::min<std::int64_t>(std::stoll(value), 2147483647));
  }
}

TEST_F(Hostile, OffsetsOfSubmodelsDoNotAddUpBeyondThirtyTwoBits) {
  std::string text =
      "#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n"
      "                  kg                  mm                  ms\n"
      "                  kg                  mm                  ms\n";
  for (int i = 1; i <= 300; ++i)
    text += "//SUBMODEL/" + std::to_string(i) + "\ns\n2147483647-214748364\n";
  text += "/SURF/PART/7\nt\n         1\n";
  for (int i = 0; i < 300; ++i) text += "//ENDSUB\n";
  const auto deck = read_deck(file("d_0000.rad", text), SchemaSet::built_in());
  ASSERT_TRUE(deck.ok());
  EXPECT_GE(count(deck->diagnostics, RuleId::DK335), 1u);
  for (const Submodel& s : deck->submodels) {
    EXPECT_LE(s.definitions, 2147483647);
    EXPECT_GE(s.nodes, -2147483648LL);
  }
}

TEST_F(Hostile, WhatIsNoDeckIsRefusedWithTheReason) {
  EXPECT_THAT(refusal(file("empty", "")), HasSubstr("is empty (0 bytes"));
  EXPECT_THAT(refusal(file("blank", "  \n\r\n\t\n")), HasSubstr("is empty"));
  EXPECT_THAT(refusal(dir_), HasSubstr("directory"));
  EXPECT_THAT(refusal(dir_ / "none"), HasSubstr("No such file"));
  std::string binary =
      "\x7f"
      "ELF";
  for (int i = 0; i < 5000; ++i) binary += static_cast<char>(i * 7 % 3 == 0 ? 0 : i);
  EXPECT_THAT(refusal(file("binary", binary)), HasSubstr("binary file"));
  std::string wide;
  for (const char c : deck_of("/NODE\n")) wide += {c, '\0'};
  EXPECT_THAT(refusal(file("utf16", wide)), HasSubstr("binary file"));
  EXPECT_THAT(refusal(file("marked", "\xff\xfe" + wide)), HasSubstr("UTF-16"));
}

TEST_F(Hostile, OneLineOfSixtyFourMegabytesIsReadInLinearTime) {
  Limits small;
  small.map_threshold = 1 << 20;  // the code path of a huge file
  ReadOptions options;
  options.limits = small;
  const std::string big(64 << 20, 'x');
  for (const std::string& body :
       {"/NODE\n" + big + "\n", "/GRNOD/NODE/" + big + "\n", big + "\n", "#include " + big + "\n",
        "/INTER/TYPE7/1\n" + big + "\n" + big.substr(0, 1 << 20) + "\n"}) {
    const Deck d = read_file(file("m_0000.rad", deck_of(body)), options);
    EXPECT_TRUE(d.end_seen);
    // Either the line is data of a block, or a finding names it.
    EXPECT_TRUE(!d.diagnostics.all().empty() || d.blocks.size() == 2);
    decode_all(d);
    for (const Diagnostic& f : d.diagnostics.all()) EXPECT_LT(f.message.size(), 4000u);
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

TEST_F(Hostile, AMillionHeadersAreAMillionBlocks) {
  std::string body;
  for (int i = 0; i < 1000000; ++i) body += "/A\n";
  const Deck d = read(deck_of(body));
  EXPECT_EQ(d.blocks.size(), 1000001u);
}

TEST_F(Hostile, TenThousandNestedIncludesStopAtTheDepthLimit) {
  for (int i = 0; i < 10000; ++i)
    file("f" + std::to_string(i), "#include f" + std::to_string(i + 1) + "\n/GRNOD/NODE/1\n");
  file("f10000", "/NODE\n");
  const std::string main = file("m_0000.rad", deck_of("#include f0\n"));
  const Deck d = read_file(main);
  EXPECT_EQ(count(d.diagnostics, RuleId::DK006), 1u);
  EXPECT_THAT(first(d.diagnostics, RuleId::DK006)->message, HasSubstr("deeper than 100"));
  ReadOptions options;
  options.limits.include_depth = 1000000;
  EXPECT_THAT(first(read_file(main, options).diagnostics, RuleId::DK006)->message,
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
  EXPECT_GT(count(d.diagnostics, RuleId::DK006), 0u);
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
  // Memory of the process itself: pages of mapped files belong to the system, which takes them back
  // when it needs them.
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
  EXPECT_EQ(count(d.diagnostics, RuleId::DK006), 1u);
}

TEST_F(Hostile, IncludesOfFifosDirectoriesAndBinariesAreNamed) {
  ASSERT_EQ(::mkfifo((dir_ / "fifo").c_str(), 0600), 0);
  std::filesystem::create_directory(dir_ / "folder");
  file("binary", std::string(5000, '\0'));
  const Deck d = read_file(file("m_0000.rad", deck_of("#include fifo\n#include folder\n"
                                                      "#include binary\n#include /dev/zero\n")));
  ASSERT_EQ(count(d.diagnostics, RuleId::DK004), 4u);
  const auto& all = d.diagnostics.all();
  EXPECT_THAT(all[0].message, HasSubstr("not a regular file"));
  EXPECT_THAT(all[1].message, HasSubstr("directory"));
  EXPECT_THAT(all[2].message, HasSubstr("binary"));
  EXPECT_THAT(all[3].message, HasSubstr("not a regular file"));
}

TEST_F(Hostile, NulBytesInADeckAreReportedAndLoseNoLine) {
  std::string body = "/GRNOD/NODE/1\nt\n         1\n         2\n         3\n";
  body[body.find("2\n") - 3] = '\0';
  const Deck d = read(deck_of(body));
  Diagnostics findings;
  const DecodedBlock b = decode(d, d.blocks[1], &findings);
  ASSERT_EQ(b.cards.size(), 3u);
  EXPECT_EQ(b.cards[2].cells[0].integer, 3);
  EXPECT_EQ(count(findings, RuleId::DK014), 1u);
}

TEST_F(Hostile, AMillionBrokenLinesAreCountedAndAFewKept) {
  std::string body = "/GRNOD/NODE/1\nt\n";
  for (int i = 0; i < 300000; ++i) body += "       abc       1.5\n";
  const Deck d = read(deck_of(body));
  Diagnostics findings(50);
  decode(d, d.blocks[1], &findings);
  EXPECT_EQ(count(findings, RuleId::DK020), 300000u);
  EXPECT_EQ(count(findings, RuleId::DK022), 300000u);
  EXPECT_EQ(findings.all().size(), 100u);
}

TEST_F(Hostile, ManyParametersOfOneNameStayFast) {
  std::string body;
  for (int i = 0; i < 20000; ++i)
    body += "/PARAMETER/GLOBAL/REAL/1\nt\nA                          1.\n/GRNOD/NODE/&A\n";
  const Deck d = read(deck_of(body));
  EXPECT_EQ(d.parameters.size(), 1u);
  EXPECT_EQ(count(d.diagnostics, RuleId::DK056), 19999u);
}

TEST_F(Hostile, DeeplyNestedExpressionsEndInAnError) {
  for (const char* unit : {"(", "-", "sqrt(", "2^", "1+(", "+"}) {
    std::string text;
    while (text.size() < 85) text += unit;
    std::string lines = "/PARAMETER/GLOBAL/REAL_EXPR/1\nt\nA         " + text + "\n";
    const Deck d = read(deck_of(lines));
    EXPECT_EQ(count(d.diagnostics, RuleId::DK019), 1u) << unit;
  }
}

TEST_F(Hostile, ManySubmodelsAndStrayMarksStayLinear) {
  std::string body;
  for (int i = 0; i < 100000; ++i) body += "//SUBMODEL/1\n\n         1\n";
  const Deck d = read(deck_of(body));
  EXPECT_EQ(d.submodels.size(), 100000u);
  EXPECT_EQ(d.submodels.back().nodes, 100000);
}

}  // namespace
}  // namespace deck
