// The walk through a deck: blocks, headers, /BEGIN, includes, submodels, ends.
#include <gmock/gmock.h>

#include <random>

#include "keyword/reading.hpp"
#include "text/shared/gzip.hpp"

namespace deck {
namespace {

using namespace testing_support;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// ---- blocks -------------------------------------------------------------------------------------

TEST(ReaderBlocks, KeepEveryLineUpToTheNextHeader) {
  const Deck d =
      read(deck_of("/GRNOD/NODE/7\ntitle\n# note\n         1\n\n$ note\n         2\n"
                   "/SURF/SEG/8\nt\n"));
  ASSERT_EQ(d.blocks.size(), 3u);
  EXPECT_EQ(d.blocks[1].header, "/GRNOD/NODE/7");
  EXPECT_THAT(lines(d, d.blocks[1]), ElementsAre("title", "         1", "", "         2"));
  EXPECT_EQ(d.blocks[2].header, "/SURF/SEG/8");
  EXPECT_EQ(d.sources.text(d.blocks[2].header_span), "/SURF/SEG/8");
  LineCursor cursor(d.sources, d.blocks[1]);
  cursor.next_physical();
  EXPECT_EQ(cursor.next_physical().text, "# note");
  EXPECT_TRUE(d.end_seen);
  EXPECT_TRUE(d.findings.all().empty());
}

TEST(ReaderBlocks, CarriageReturnsAndMissingLastNewlineChangeNothing) {
  std::string text = banner + begin() + "/GRNOD/NODE/7\ntitle\n         1\n/END";
  std::string crlf;
  for (const char c : text) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  for (const std::string& t : {text, crlf}) {
    const Deck d = read(t);
    const Block* b = block(d, "/GRNOD/NODE/7");
    ASSERT_NE(b, nullptr);
    EXPECT_THAT(lines(d, *b), ElementsAre("title", "         1"));
    EXPECT_TRUE(d.end_seen);
    EXPECT_TRUE(d.findings.all().empty());
  }
}

TEST(ReaderBlocks, SlashAndHashInsideALineAreData) {
  const Deck d =
      read(deck_of("/GRNOD/NODE/7\na/b #include x /END\n   # 5 /X\n\t \t/SUBSET/3\nt\n"));
  ASSERT_EQ(d.blocks.size(), 3u);
  EXPECT_THAT(lines(d, d.blocks[1]), ElementsAre("a/b #include x /END", "   # 5 /X"));
  EXPECT_EQ(d.blocks[2].header, "/SUBSET/3");
}

TEST(ReaderBlocks, HeadersAreFoundOnBothSidesOfEveryWindow) {
  // The walk searches in windows of 32 KiB: shift a deck byte by byte across one border.
  for (int shift = 0; shift < 80; ++shift) {
    std::string body =
        "/NODE\n" + std::string(32 * 1024 - 300 + static_cast<std::size_t>(shift), ' ');
    body += "\n         1  /x\n  /GRNOD/NODE/7\nt\n#c /\n         5\n";
    const Deck d = read(deck_of(body));
    ASSERT_EQ(d.blocks.size(), 3u) << shift;
    EXPECT_EQ(d.blocks[2].header, "/GRNOD/NODE/7");
    EXPECT_THAT(lines(d, d.blocks[2]), ElementsAre("t", "         5"));
  }
}

TEST(ReaderBlocks, CommentsForLintAreFoundWhereverWindowsMeet) {
  std::mt19937_64 random(5);
  for (int k = 0; k < 40; ++k) {
    std::string body;
    for (int i = 0; i < 3000; ++i) {
      constexpr std::string_view lines[] = {"/NODE\n",
                                            "# decklint: ignore[DK1]\n",
                                            "#decklint:\n",
                                            "  text: 1 / 2 # 3\n",
                                            "decklint:decklint:",
                                            "/decklint:/\n",
                                            "#include_decklint :\n"};
      if (random() % 4 != 0)
        body += std::string(random() % 200, '1') + '\n';
      else
        body += lines[random() % std::size(lines)];
    }
    const Deck deck = read(deck_of(body) + "# decklint:");
    const std::string_view bytes = deck.sources[0].bytes();
    ASSERT_EQ(deck.lint_markers.size(), 1u);
    const LintMarkers& found = deck.lint_markers[0];
    ASSERT_EQ(found.searched, bytes.size());
    std::vector<std::uint64_t> expected;
    for (std::size_t at = 0; (at = bytes.find(lint_marker, at)) != bytes.npos; ++at)
      expected.push_back(at);
    ASSERT_EQ(found.offsets, expected) << k;
  }
}

TEST(ReaderBlocks, EverythingBeforeBeginButParametersIsDropped) {
  const Deck d = read(banner + "/NODE\n         1\n/PARAMETER/GLOBAL/REAL/1\nt\nA         2.\n" +
                      "//SUBMODEL/3\n\n         5\n//ENDSUB\n" + begin() + "/GRNOD/NODE/7\n/END\n");
  EXPECT_EQ(block(d, "/NODE"), nullptr);
  EXPECT_NE(block(d, "/GRNOD/NODE/7"), nullptr);
  EXPECT_EQ(d.parameters.count("A"), 1u);
  EXPECT_EQ(count(d.findings, RuleId::DK002), 3u);
  ASSERT_EQ(d.submodels.size(), 1u);
  EXPECT_EQ(d.submodels[0].nodes, 0);
}

TEST(ReaderBlocks, AnEnginePartBeforeBeginIsPartOfACommonFile) {
  const std::string engine = "/RUN/car/1\n1.0\n/TFILE\n0.1\n";
  std::string deck = deck_of("/TITLE\nt\n");
  deck.insert(deck.find("/BEGIN"), engine + "/END/ENGINE\n");
  EXPECT_EQ(count(read(deck).findings, RuleId::DK002), 0u);
  std::string other = deck_of("/TITLE\nt\n");
  other.insert(other.find("/BEGIN"), engine);
  EXPECT_EQ(count(read(other).findings, RuleId::DK002), 2u);
}

// ---- ends ---------------------------------------------------------------------------------------

TEST(ReaderEnd, OnlyTheExactHeaderEndsTheDeck) {
  const Deck d = read(banner + begin() + "/END/ENGINE\n/NODE\n/END   \r\n");
  EXPECT_NE(block(d, "/END/ENGINE"), nullptr);
  EXPECT_NE(block(d, "/NODE"), nullptr);
  EXPECT_TRUE(d.end_seen);
}

// ---- /BEGIN -------------------------------------------------------------------------------------

TEST(ReaderBegin, GivesVersionRunNameAndUnits) {
  const Deck d = read(banner + "/BEGIN\n# comment\nmy run  \n      2019         0\n" +
                      "                  Mg                  mm                   s\n" +
                      "                  kg                   m                   s\n/END\n");
  EXPECT_EQ(d.version, 2019);
  EXPECT_EQ(d.begin.version_written, 2019);
  EXPECT_EQ(d.begin.run_name, "my run");
  EXPECT_EQ(d.begin.input.mass, 1000);
  EXPECT_EQ(d.begin.input.length, 1e-3);
  EXPECT_EQ(d.begin.working.length, 1);
  EXPECT_EQ(count(d.findings, RuleId::DK017), 1u);
  EXPECT_EQ(first(d.findings, RuleId::DK017)->reference->severity, Severity::warning);
}

TEST(ReaderBegin, UnknownVersionsTakeTheNewestLayout) {
  for (const char* version : {"0", "150", "2027", "2512", "x"}) {
    const Deck d = read(deck_of("", version));
    EXPECT_EQ(d.version, newest_version) << version;
    EXPECT_FALSE(d.begin.version_known);
    EXPECT_EQ(count(d.findings, RuleId::DK003), 1u) << version;
  }
  for (const int version : {51, 90, 100, 110, 120, 130, 140, 2017, 2018, 2019, 2020, 2021, 2022,
                            2023, 2024, 2025, 2026, 2612}) {
    EXPECT_EQ(read(deck_of("", std::to_string(version))).version, version);
    EXPECT_TRUE(is_known_version(version));
  }
}

TEST(ReaderBegin, UnitsOfOneSystemStandForThoseOfTheOther) {
  const std::string whole = "                  Mg                  mm                   s\n";
  const std::string part = "                  Mg                                       s\n";
  struct Row {
    const char* version;
    std::string lines;
    double mass, length;           ///< of both systems
    std::uint64_t cells, systems;  ///< findings DK015, DK016
  };
  const Row rows[] = {
      {"2024", "\n" + whole, 1000, 1e-3, 0, 0},
      {"2024", whole, 1000, 1e-3, 0, 0},
      {"2024", "", 1, 1, 0, 1},
      {"2024", whole + part, 1000, 1e-3, 1, 0},
      {"2024", part + whole, 1000, 1e-3, 1, 0},
      {"2024", part + part, 1000, 1, 2, 0},
      // Old versions name their units in blocks.
      {"  90", "/UNIT/LENGTH/mm\n/UNIT/MASS/Mg\n/UNIT/TIME/s\n", 1000, 1e-3, 0, 0},
  };
  for (const Row& r : rows) {
    const Deck d = read(banner + "/BEGIN\nrun\n      " + r.version + "\n" + r.lines + "/END\n");
    for (const UnitSystem* s : {&d.begin.input, &d.begin.working}) {
      EXPECT_EQ(s->mass, r.mass) << r.version << r.lines;
      EXPECT_EQ(s->length, r.length) << r.version << r.lines;
    }
    EXPECT_EQ(count(d.findings, RuleId::DK015), r.cells) << r.lines;
    EXPECT_EQ(count(d.findings, RuleId::DK016), r.systems) << r.lines;
  }
}

TEST(ReaderBegin, ASecondOneInTheMainFileKeepsTheFirstUnits) {
  const Deck d = read(banner + begin("2024") + "/NODE\n" + begin("100") + "/GRNOD/NODE/1\n/END\n");
  EXPECT_EQ(d.version, 2024);
  EXPECT_EQ(block(d, "/NODE")->version, 2024);
  EXPECT_EQ(block(d, "/GRNOD/NODE/1")->version, 100);
  EXPECT_EQ(count(d.findings, RuleId::DK043), 1u);
}

// ---- headers ------------------------------------------------------------------------------------

TEST(ReaderHeader, FindsIdAndUnitBehindTheKeyword) {
  struct Row {
    const char* header;
    std::int64_t id;
    bool present;
    std::int64_t unit;
  };
  // Without a number a material or interface becomes number one, a group has none. The first number
  // of an added mass is its type.
  const Row rows[] = {{"/INTER/TYPE7/12/3", 12, true, 3}, {"/GRNOD/PART/0005", 5, true, 0},
                      {"/INTER/TYPE11", 1, false, 0},     {"/NODE/4", 0, false, 4},
                      {"/SHELL/9", 9, true, 0},           {"/UNKNOWN/THING/8/2", 8, true, 2},
                      {"/INTER/TYPE7/0", 0, true, 0},     {"/MAT/VOID/x", 1, false, 0},
                      {"/SHELL/x", 0, false, 0},          {"/FUNCT", 0, false, 0},
                      {"/ADMAS/5/7/3", 7, true, 3},       {"/ADMAS/1", 1, false, 0},
                      {"/UNKNOWN/a#b/4", 4, true, 0}};
  std::string body;
  for (const Row& r : rows) body += std::string(r.header) + "\nt\n";
  const Deck d = read(deck_of(body));
  for (const Row& r : rows) {
    const Block* b = block(d, r.header);
    ASSERT_NE(b, nullptr) << r.header;
    EXPECT_EQ(b->id.value, r.id) << r.header;
    EXPECT_EQ(b->id.present, r.present) << r.header;
    EXPECT_EQ(b->unit_id.value, r.unit) << r.header;
  }
  const Block& inter = *block(d, "/INTER/TYPE7/12/3");
  EXPECT_EQ(inter.keyword, "/INTER/TYPE7");
  EXPECT_EQ(d.sources.text(inter.id.span), "12");
  EXPECT_EQ(d.sources.text(inter.unit_id.span), "3");
  const Deck old = read(deck_of("/INTER/TYPE7/12/3\nthe title\n", "51"));
  EXPECT_FALSE(block(old, "/INTER/TYPE7/12/3")->unit_id.present) << "version 51 has no such field";
  EXPECT_EQ(decode(old, *block(old, "/INTER/TYPE7/12/3")).title, "the title");
}

TEST(ReaderHeader, BlanksBehindItsLastColumnAreNoText) {
  const std::string header = "/NODE" + std::string(210, ' ');
  EXPECT_EQ(count(read(deck_of(header + "\n         1\n")).findings, RuleId::DK012), 0u);
  const Deck d = read(deck_of(header + "x\n         1\n"));
  ASSERT_EQ(count(d.findings, RuleId::DK012), 1u);
  EXPECT_EQ(first(d.findings, RuleId::DK012)->span.length, 14u);
}

TEST(ReaderHeader, TextBehindItsNumberIsNotReadAndBehindAKeywordMakesAnother) {
  const Deck d = read(deck_of("/INTER/TYPE7/2   # note /5\nt\n/PART/ 3 left\nt\n/NODE # all\n"));
  ASSERT_NE(block(d, "/INTER/TYPE7/2"), nullptr);
  EXPECT_EQ(d.blocks[1].id.value, 2);
  EXPECT_EQ(d.blocks[2].id.value, 3);
  EXPECT_EQ(d.blocks[3].schema, nullptr);
  EXPECT_TRUE(d.findings.all().empty());
  const Deck end = read(banner + begin() + "/END # of it\n/GRNOD/NODE/1\nt\n/END\n");
  EXPECT_NE(block(end, "/GRNOD/NODE/1"), nullptr);
}

TEST(ReaderHeader, ABlankAtItsBeginningIsAnErrorInsideTheKeywordAWarningBeforeTheIdNothing) {
  const Deck d = read(deck_of(" /GRNOD/NODE/7\nt\n/GRNOD /NODE/8\nt\n/GRNOD/NODE/9  \nt\n"));
  ASSERT_EQ(count(d.findings, RuleId::DK052), 2u);
  EXPECT_EQ(d.findings.all()[0].severity, Severity::error);
  EXPECT_EQ(d.findings.all()[1].severity, Severity::warning);
  EXPECT_EQ(d.blocks.size(), 4u);
  const Deck harmless = read(deck_of("/GRNOD/NODE    /         2\nt\n"));
  EXPECT_EQ(count(harmless.findings, RuleId::DK052), 0u);
  EXPECT_EQ(harmless.blocks.at(1).id.value, 2);
  const Deck unknown = read(deck_of("/ GRNOD/NODE/2\nt\n"));
  ASSERT_EQ(count(unknown.findings, RuleId::DK052), 1u);
  EXPECT_EQ(first(unknown.findings, RuleId::DK052)->severity, Severity::error);
}

// ---- includes -----------------------------------------------------------------------------------

class ReaderInclude : public Folder {};

TEST_F(ReaderInclude, IsSearchedBesideTheIncludingFileThenBesideTheMainFile) {
  file("sub/inner.inc", "/GRNOD/NODE/1\nfrom sub\n");
  file("inner.inc", "/GRNOD/NODE/1\nfrom main\n");
  file("only_main.inc", "/GRNOD/NODE/2\n");
  file("sub/outer.inc", "#include inner.inc\n#INCLUDE 'only_main.inc'\n");
  const Deck d = read_file(file("m_0000.rad", deck_of("#include sub/outer.inc\n")));
  EXPECT_THAT(lines(d, *block(d, "/GRNOD/NODE/1")), ElementsAre("from sub"));
  EXPECT_NE(block(d, "/GRNOD/NODE/2"), nullptr);
  ASSERT_EQ(d.includes.size(), 3u);
  EXPECT_EQ(d.parent_of(0), Span::no_file);
  EXPECT_EQ(d.parent_of(1), 0u);
  EXPECT_EQ(d.parent_of(2), 1u);
  EXPECT_EQ(d.parent_of(3), 1u);
  EXPECT_EQ(d.includes[1].written, "inner.inc");
}

TEST_F(ReaderInclude, CommentsForLintAreFoundInEveryFileToItsEnd) {
  file("b.inc", "# decklint: b\n#enddata\n$decklint: behind\n");
  file("a.inc", "/NODE\n#include b.inc\n# decklint: a\n/END\n# decklint: behind\n");
  const Deck d = read_file(
      file("m_0000.rad", deck_of("# decklint: m\n#include a.inc\n# decklint: m\n") + "#decklint:"));
  ASSERT_EQ(d.sources.size(), 3u);
  ASSERT_EQ(d.lint_markers.size(), 3u);
  for (std::uint32_t f = 0; f < 3; ++f) {
    EXPECT_EQ(d.lint_markers[f].searched, d.sources[f].bytes().size());
    EXPECT_EQ(d.lint_markers[f].offsets.size(), f == 0 ? 3u : 2u);
    for (const std::uint64_t at : d.lint_markers[f].offsets)
      EXPECT_TRUE(d.sources[f].bytes().substr(at).starts_with(lint_marker));
  }
}

TEST_F(ReaderInclude, ExtraFoldersAreSearchedLast) {
  file("lib/a.inc", "/GRNOD/NODE/1\n");
  const std::string main = file("m_0000.rad", deck_of("#include a.inc\n"));
  EXPECT_EQ(block(read_file(main), "/GRNOD/NODE/1"), nullptr);
  ReadOptions options;
  options.include_paths = {dir_ / "lib"};
  EXPECT_NE(block(read_file(main, options), "/GRNOD/NODE/1"), nullptr);
}

TEST_F(ReaderInclude, AMissingFileNamesEveryPlaceThatWasTried) {
  file("sub/a.inc", "#include none.inc\n");
  ReadOptions options;
  options.include_paths = {dir_ / "lib"};
  const Deck d = read_file(file("m_0000.rad", deck_of("#include sub/a.inc\n/NODE\n")), options);
  const Finding* f = first(d.findings, RuleId::DK004);
  ASSERT_NE(f, nullptr);
  for (const char* place : {"sub/none.inc", "/none.inc", "lib/none.inc"})
    EXPECT_THAT(f->message, HasSubstr((dir_ / place).string())) << place;
  EXPECT_THAT(f->message, HasSubstr("No such file"));
  EXPECT_EQ(d.sources.position(f->span).line, 1u);
  EXPECT_NE(block(d, "/NODE"), nullptr);  // reading goes on
}

TEST_F(ReaderInclude, PathsContinueOverLines) {
  file("a long name.inc", "/GRNOD/NODE/1\n");
  for (const char* directive : {"#include a long name.inc", "#include a long +\n name.inc",
                                "#include a lo...\nng name.inc", "#include a lo&\nng name.inc",
                                "#include a lo\n+ng name.inc", "#include 'a long name.inc'"}) {
    const std::string text = std::string(directive) + "\n/NODE\n         1\n";
    std::string spaced = text;
    // Blanks around a break are not part of the name; the first continued spelling needs one.
    if (const auto at = spaced.find("long +\n name"); at != std::string::npos)
      spaced.replace(at, 12, "lo +\nng name");
    const Deck d = read_file(file("m_0000.rad", deck_of(spaced)));
    EXPECT_NE(block(d, "/GRNOD/NODE/1"), nullptr) << directive;
    ASSERT_NE(block(d, "/NODE"), nullptr) << directive;
    EXPECT_THAT(lines(d, *block(d, "/NODE")), ElementsAre("         1")) << directive;
  }
}

TEST_F(ReaderInclude, LinesBeforeItsFirstKeywordAreDroppedAndCounted) {
  file("a.inc", "# nodes\n         2\n\n         3\n/GRNOD/NODE/5\nt\n         1\n");
  const Deck d = read_file(file("m_0000.rad", deck_of("/NODE\n         1\n#include a.inc\n")));
  ASSERT_NE(block(d, "/NODE"), nullptr);
  EXPECT_THAT(lines(d, *block(d, "/NODE")), ElementsAre("         1"));
  EXPECT_THAT(lines(d, *block(d, "/GRNOD/NODE/5")), ElementsAre("t", "         1"));
  ASSERT_EQ(count(d.findings, RuleId::DK051), 1u);
  const Finding* f = first(d.findings, RuleId::DK051);
  EXPECT_EQ(d.sources.position(f->span).line, 2u);
  EXPECT_THAT(f->message, HasSubstr("2 lines"));
  EXPECT_THAT(f->message, HasSubstr("/NODE"));
  EXPECT_EQ(f->severity, Severity::warning);
  file("a.inc", "Copyright 2024 of somebody\nAll rights 1 2 3\n/GRNOD/NODE/5\nt\n");
  const Deck words = read_file(file("m_0000.rad", deck_of("#include a.inc\n")));
  EXPECT_EQ(first(words.findings, RuleId::DK051)->severity, Severity::info) << "no numbers";
}

TEST_F(ReaderInclude, WithoutAnyKeywordLeavesTheBlockOfTheIncludingFileOpen) {
  file("a.inc", "         2\n         3");
  file("remarks.inc", "# nothing but\n\n$ remarks\n");
  const Deck d = read_file(file("m_0000.rad", deck_of("/NODE\n         1\n#include a.inc\n"
                                                      "#include remarks.inc\n         4\n")));
  EXPECT_THAT(lines(d, *block(d, "/NODE")), ElementsAre("         1", "         4"));
  EXPECT_EQ(count(d.findings, RuleId::DK051), 1u);
}

TEST_F(ReaderInclude, AWrongPathComesWithAHint) {
  file("Sub/Mesh.inc", "/GRNOD/NODE/1\n");
  const auto help = [&](const std::string& directive) {
    const Deck d = read_file(file("m_0000.rad", deck_of(directive + "\n")));
    const Finding* f = first(d.findings, RuleId::DK004);
    return f == nullptr ? std::string("(found)") : f->help;
  };
  EXPECT_THAT(help("#include sub/mesh.inc"), HasSubstr((dir_ / "Sub/Mesh.inc").string()));
  EXPECT_THAT(help("#include \"Sub/Mesh.inc\""), HasSubstr("#include Sub/Mesh.inc"));
  EXPECT_THAT(help("#include Sub\\none.inc"), HasSubstr("'Sub/none.inc'"));
  EXPECT_THAT(help("#include nowhere.inc"), HasSubstr("--include-path"));
  EXPECT_THAT(help("#include Sub/Mehs.inc"),
              HasSubstr("Did you mean '" + (dir_ / "Sub/Mesh.inc").string()));
  EXPECT_EQ(help("#include Sub/Mesh.inc"), "(found)");
  EXPECT_EQ(help("#include Sub\\Mesh.inc"), "(found)");
  const Deck d = read_file(file("m_0000.rad", deck_of("#include Sub\\Mesh.inc\n")));
  EXPECT_EQ(count(d.findings, RuleId::DK058), 1u);
}

TEST_F(ReaderInclude, PackedFilesAreReadWithTheLinesOfTheirText) {
  const auto packed = [&](const std::string& name, const std::string& main = "m_0000.rad") {
    const std::string text = deck_of("#include " + name + "\n");
    return read_file(file(main, main.ends_with(".gz") ? gzip(text) : text));
  };
  file("a.inc.gz", gzip("# a comment\n/GRNOD/NODE/1\n/GRNOD/NODE/2\n"));
  const Deck d = packed("a.inc.gz");
  const Block* second = block(d, "/GRNOD/NODE/2");
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(d.sources.position(second->header_span).line, 3u);
  EXPECT_THAT(first(d.findings, RuleId::DK378)->message, HasSubstr("it was unpacked"));
  // Where only the packed file is there it is read; of a packed deck without a finding.
  const Deck only = packed("a.inc");
  EXPECT_NE(block(only, "/GRNOD/NODE/1"), nullptr);
  ASSERT_EQ(count(only.findings, RuleId::DK378), 1u);
  EXPECT_THAT(first(only.findings, RuleId::DK378)->message, HasSubstr("'a.inc' is not there"));
  const Deck both = packed("a.inc", "m_0000.rad.gz");
  EXPECT_NE(block(both, "/GRNOD/NODE/1"), nullptr);
  EXPECT_EQ(both.findings.counts().size(), 0u);
  file("a.inc", "/GRNOD/NODE/3\n");
  const Deck plain = packed("a.inc");
  EXPECT_NE(block(plain, "/GRNOD/NODE/3"), nullptr) << "the plain file comes first";
  EXPECT_EQ(count(plain.findings, RuleId::DK378), 0u);
  const std::string whole = gzip("/GRNOD/NODE/1\n");
  file("b.inc.gz", whole.substr(0, whole.size() - 3));
  const Deck damaged = packed("b.inc.gz");
  ASSERT_EQ(count(damaged.findings, RuleId::DK004), 1u);
  EXPECT_THAT(first(damaged.findings, RuleId::DK004)->message, HasSubstr("incomplete"));
}

TEST_F(ReaderInclude, PackedIncludesTogetherStayBelowTheLimit) {
  file("a.inc.gz", gzip("/GRNOD/NODE/1\n" + std::string(1000, '\n')));
  ReadOptions options;
  options.limits.unpacked_bytes = 2500;
  const std::string main =
      file("m_0000.rad", deck_of("#include a.inc.gz\n#include a.inc.gz\n#include a.inc.gz\n"));
  const auto d = read_deck(main, SchemaSet::built_in(), options);
  ASSERT_TRUE(d.ok());
  ASSERT_EQ(count(d->findings, RuleId::DK004), 1u);
  EXPECT_THAT(first(d->findings, RuleId::DK004)->message, HasSubstr("more than the limit"));
}

TEST_F(ReaderInclude, EndAndEnddataSkipTheRestOfTheIncludeOnly) {
  file("a.inc", "/GRNOD/NODE/1\n/END\n/GRNOD/NODE/2\n");
  file("b.inc", "/GRNOD/NODE/3\n#EndData\n/GRNOD/NODE/4\n");
  const Deck d = read_file(file("m_0000.rad", deck_of("#include a.inc\n#include b.inc\n#enddata\n"
                                                      "/GRNOD/NODE/5\n")));
  for (const char* here : {"/GRNOD/NODE/1", "/GRNOD/NODE/3", "/GRNOD/NODE/5"})
    EXPECT_NE(block(d, here), nullptr) << here;
  for (const char* gone : {"/GRNOD/NODE/2", "/GRNOD/NODE/4"})
    EXPECT_EQ(block(d, gone), nullptr) << gone;
  EXPECT_EQ(count(d.findings, RuleId::DK011), 1u);
}

TEST_F(ReaderInclude, CyclesEndWithTheNameOfTheFile) {
  file("a.inc", "/GRNOD/NODE/1\n#include b.inc\n/GRNOD/NODE/2\n");
  file("b.inc", "#include ./a.inc\n#include m_0000.rad\n/GRNOD/NODE/3\n");
  const Deck d = read_file(file("m_0000.rad", deck_of("#include a.inc\n")));
  EXPECT_EQ(count(d.findings, RuleId::DK005), 2u);
  EXPECT_EQ(d.sources.size(), 3u);
  EXPECT_NE(block(d, "/GRNOD/NODE/2"), nullptr);
  EXPECT_NE(block(d, "/GRNOD/NODE/3"), nullptr);
  file("c.inc", "/GRNOD/NODE/1\n");
  const Deck twice = read_file(file("m_0000.rad", deck_of("#include c.inc\n#include c.inc\n")));
  EXPECT_EQ(count(twice.findings, RuleId::DK005), 0u) << "twice in a row";
}

/// A /BEGIN of an included file; `units` of its values, empty: none.
std::string own_begin(const std::string& units) {
  return "/BEGIN\nsub\n       100         0\n" + units + "\n" + units + "\n";
}
constexpr const char* metres = "                  Mg                   m                   s";
constexpr const char* millimetres = "                  kg                  mm                  ms";

TEST_F(ReaderInclude, ItsOtherUnitsAreNamedOutsideOfSubmodels) {
  const auto findings = [&](const std::string& body) {
    const Deck d = read_file(file("m_0000.rad", deck_of(body)));
    return count(d.findings, RuleId::DK043);
  };
  file("metres.inc", own_begin(metres) + "/NODE\n");
  file("millimetres.inc", own_begin(millimetres) + "/NODE\n");
  file("none.inc", own_begin("") + "/NODE\n");
  EXPECT_EQ(findings("#include metres.inc\n"), 1u);
  EXPECT_EQ(findings("#include millimetres.inc\n#include none.inc\n"), 0u);
  EXPECT_EQ(findings("//SUBMODEL/1\n\n\n#include metres.inc\n//ENDSUB\n"), 0u);
}

TEST_F(ReaderInclude, InheritsTheVersionUnlessItHasItsOwnBegin) {
  file("plain.inc", "/GRNOD/NODE/1\n");
  file("own.inc", begin("100") + "/GRNOD/NODE/2\n#include plain2.inc\n");
  file("plain2.inc", "/GRNOD/NODE/3\n");
  const Deck d = read_file(file("m_0000.rad", deck_of("#include plain.inc\n#include own.inc\n"
                                                      "/GRNOD/NODE/4\n",
                                                      "2019")));
  EXPECT_EQ(block(d, "/GRNOD/NODE/1")->version, 2019);
  EXPECT_EQ(block(d, "/GRNOD/NODE/2")->version, 100);
  EXPECT_EQ(block(d, "/GRNOD/NODE/3")->version, 100);
  EXPECT_EQ(block(d, "/GRNOD/NODE/4")->version, 2019);
  EXPECT_EQ(d.version, 2019);
}

TEST_F(ReaderInclude, IsOnlyADirectiveAtTheStartOfALine) {
  const Deck d = read(deck_of("/NODE\n #include x\n#includex\n#include_y\n"));
  EXPECT_EQ(count(d.findings, RuleId::DK004), 0u);
  for (const char* bare : {"#include   \n", "#include\n", "#INCLUDE\r\n"})
    EXPECT_EQ(count(read(deck_of(bare)).findings, RuleId::DK004), 1u) << bare;
}

// ---- submodels ----------------------------------------------------------------------------------

const std::string offsets_a =
    "       100       200       300         0         0         0         0\n";

TEST(ReaderSubmodel, OffsetsFallBackAndAddUp) {
  const Deck d =
      read(deck_of("//SUBMODEL/1\na\n" + offsets_a + "/GRNOD/NODE/7\nt\n//SUBMODEL/2\nb\n" +
                   "      1000\n/NODE\n//ENDSUB\n/PART/1\nt\n//ENDSUB   \n/NODE/1\n"));
  ASSERT_EQ(d.submodels.size(), 2u);
  const Submodel& a = d.submodels[0];
  const Submodel& b = d.submodels[1];
  EXPECT_EQ(a.definitions, 100);
  EXPECT_EQ(a.nodes, 200);
  EXPECT_EQ(a.parts, 100);
  EXPECT_EQ(b.definitions, 1100);
  EXPECT_EQ(b.nodes, 1200);
  EXPECT_EQ(b.elements, 1300);
  EXPECT_EQ(b.parent, 0);
  EXPECT_EQ(a.title, "a");
  const auto offset = [&](const char* header, const char* kind) {
    return d.offset_of(*block(d, header), kind);
  };
  EXPECT_EQ(offset("/GRNOD/NODE/7", "grnod"), 100);
  EXPECT_EQ(offset("/GRNOD/NODE/7", "node"), 200);
  EXPECT_EQ(offset("/NODE", "node"), 1200);
  EXPECT_EQ(offset("/NODE", "shell"), 1300);
  EXPECT_EQ(offset("/PART/1", "part"), 100);
  EXPECT_EQ(offset("/NODE/1", "node"), 0);
  EXPECT_EQ(count(d.findings, RuleId::DK035), 0u);
}

TEST(ReaderSubmodel, ItsOwnBeginGivesItsUnitsAndVersionOnlyInside) {
  const std::string own =
      "/BEGIN\nsub\n       100         0\n"
      "                  Mg                   m                   s\n";
  const Deck d = read(deck_of("//SUBMODEL/1\n\n\n" + own +
                              "/GRNOD/NODE/7\n//SUBMODEL/2\n\n\n/NODE\n"
                              "//ENDSUB\n//ENDSUB\n/GRNOD/NODE/8\n"));
  EXPECT_EQ(d.units_of(*block(d, "/GRNOD/NODE/7"))->length, 1);
  EXPECT_EQ(d.units_of(*block(d, "/NODE"))->length, 1);  // inherited by the nested one
  EXPECT_EQ(d.units_of(*block(d, "/GRNOD/NODE/8"))->length, 1e-3);
  EXPECT_EQ(block(d, "/GRNOD/NODE/7")->version, 100);
  EXPECT_EQ(block(d, "/GRNOD/NODE/8")->version, 2024);
  EXPECT_EQ(d.begin.input.length, 1e-3);
  // Working units alone count for its values; without units it has those of the deck.
  for (const bool working : {true, false}) {
    const std::string units =
        working ? "\n                  Mg                   m                   s\n" : "\n\n";
    const Deck half = read(deck_of("//SUBMODEL/1\n\n\n/BEGIN\nsub\n       100         0\n" + units +
                                   "/NODE\n//ENDSUB\n"));
    EXPECT_EQ(half.units_of(*block(half, "/NODE"))->length, working ? 1 : 1e-3);
    EXPECT_EQ(block(half, "/NODE")->version, 100);
  }
}

TEST(ReaderSubmodel, OffsetsInFreeFormat) {
  const Deck d =
      read(deck_of("/PARAMETER/GLOBAL/INTEGER/1\nt\nparts          7\n"
                   "//SUBMODEL/1\na\n100,,300, &parts\n/NODE\n//ENDSUB\n"));
  const Submodel& s = d.submodels.at(0);
  EXPECT_EQ(s.definitions, 100);
  EXPECT_EQ(s.nodes, 100);
  EXPECT_EQ(s.elements, 300);
  EXPECT_EQ(s.parts, 7);
  EXPECT_EQ(s.materials, 100);
}

// ---- units --------------------------------------------------------------------------------------

TEST(ReaderUnits, UnitBlocksAreFoundWithSubmodelOffsets) {
  const std::string line = "                  Mg                                       0\n";
  const Deck d = read(deck_of("/UNIT/3\nt\n" + line +
                              "/GRNOD/NODE/1/3\n/GRNOD/NODE/2/4\n"
                              "//SUBMODEL/1\n\n        10\n/UNIT/4\nt\n" +
                              line + "/GRNOD/NODE/5/4\n//ENDSUB\n"));
  EXPECT_EQ(d.units_of(*block(d, "/GRNOD/NODE/1/3"))->mass, 1000);
  EXPECT_EQ(d.units_of(*block(d, "/GRNOD/NODE/1/3"))->length, 1);
  EXPECT_EQ(d.units_of(*block(d, "/GRNOD/NODE/2/4")), nullptr);
  EXPECT_EQ(d.units_of(*block(d, "/GRNOD/NODE/5/4"))->mass, 1000);
  EXPECT_EQ(count(d.findings, RuleId::DK015), 0u);
  EXPECT_EQ(d.units.count(14), 1u);
}

TEST(ReaderUnits, UnitBlocksInFreeFormat) {
  const Deck d =
      read(deck_of("/UNIT/3\nt\nMg, m,s\n/UNIT/4\nt\nkg,,lightyear\n/UNIT/5\nt\nkg,m,-1\n"
                   "/NODE/3\n"));
  EXPECT_EQ(d.units_of(*block(d, "/NODE/3"))->mass, 1000);
  EXPECT_EQ(d.units_of(*block(d, "/NODE/3"))->length, 1);
  ASSERT_EQ(count(d.findings, RuleId::DK015), 2u);
  EXPECT_EQ(d.sources.text(first(d.findings, RuleId::DK015)->span), "lightyear");
  EXPECT_EQ(d.findings.all().back().severity, Severity::warning);  // of a negative time
}

// ---- encrypted ----------------------------------------------------------------------------------

TEST(ReaderOpaque, CipherTextIsKeptAndNotInterpreted) {
  const std::string cipher(80, 'Q');
  const Deck d = read(deck_of("/MAT/LAW2/5\nsteel\n" + cipher + "\n/MAT/LAW1/6\nt\n     7.8e-9\n"));
  EXPECT_TRUE(block(d, "/MAT/LAW2/5")->opaque);
  EXPECT_FALSE(block(d, "/MAT/LAW1/6")->opaque);
  const DecodedBlock decoded = decode(d, *block(d, "/MAT/LAW2/5"));
  EXPECT_TRUE(decoded.cards.empty());
}

}  // namespace
}  // namespace deck
