// Decoding with a test schema. check_random_blocks.py tests lists and groups.
#include "deck/keyword.hpp"

#include <gmock/gmock.h>

#include <cstring>

#include "keyword/reading.hpp"

namespace deck {
namespace {

using namespace testing_support;
using ::testing::HasSubstr;

constexpr std::string_view schema_text = R"({"schemas":[
 {"keyword":"/X/CARDS","kind":"x","cards":[
  {"name":"flags","fields":[
    {"name":"id1","cols":[1,10],"type":"id","ref":"surf"},
    {"name":"n","cols":[11,20],"type":"int"},
    {"name":"old","cols":[21,30],"type":"int","versions":[90,2019]},
    {"name":"fx","cols":[39,39],"type":"flag"},
    {"name":"mode","cols":[41,50],"type":"int"}]},
  {"name":"extra","when":[{"field":"mode","in":[1,2]}],"fields":[
    {"name":"v","cols":[1,20],"type":"real","dim":[0,1,0]},
    {"name":"w","cols":[21,40],"type":"real","dim":[1,0,-1],
     "dim_when":[{"when":[{"field":"mode","in":[2]}],"dim":[0,0,0]}]}]},
  {"name":"last","optional":true,"fields":[{"name":"t","cols":[1,40],"type":"text"}]}]},
 {"keyword":"/X/IDS","cards":[{"name":"ids","repeat":"ids","fields":[
    {"name":"item","cols":[1,10],"type":"id","ref":"node"}]}]},
 {"keyword":"/X/NEWGROUP","cards":[
    {"name":"pair","versions":[2024,null],"repeat":"group",
     "fields":[{"name":"p","cols":[1,10],"type":"int"}]}]},
 {"keyword":"/X/ALTERNATIVES","cards":[
    {"name":"head","fields":[{"name":"mode","cols":[1,10],"type":"int"},
      {"name":"area","cols":[11,30],"type":"real","when":[{"field":"mode","in":[1]}]},
      {"name":"f","cols":[11,20],"type":"int","when":[{"field":"mode","not_in":[1]}]}]},
    {"name":"either","fields":[
      {"name":"a","cols":[1,20],"type":"real","when":[{"field":"mode","in":[1]}]},
      {"name":"b","cols":[1,10],"type":"int","when":[{"field":"mode","in":[2]}]}]},
    {"name":"last","fields":[{"name":"z","cols":[1,10],"type":"int"}]}]},
 {"keyword":"/X/COUNTED","cards":[
    {"name":"counts","fields":[{"name":"N","cols":[1,10],"type":"int"},
                               {"name":"M","cols":[11,20],"type":"int"}]},
    {"name":"ids","repeat":"ids","count":"N","per_line":3,"fields":[
      {"name":"item","cols":[1,10],"type":"id","ref":"node"}]},
    {"name":"head","repeat":"group","count":"M","fields":[{"name":"two","cols":[1,10],"type":"int"}]},
    {"name":"more","repeat":"group","count":"M","when":[{"field":"two","in":[1]}],
     "fields":[{"name":"c","cols":[1,20],"type":"real"}]},
    {"name":"pairs","repeat":"rows","count":2,"optional":true,
     "fields":[{"name":"p","cols":[1,10],"type":"int"}]},
    {"name":"end","optional":true,"fields":[{"name":"e","cols":[1,10],"type":"int"}]}]},
 {"keyword":"/X/TAIL","opaque_tail":true,"cards":[
    {"name":"one","fields":[{"name":"a","cols":[1,10],"type":"int"}]}]}
]})";

const SchemaSet& schemas() {
  static const SchemaSet set = [] {
    SchemaSet s = SchemaSet::built_in();
    const auto added = s.add_json("test", schema_text);
    EXPECT_TRUE(added.ok()) << (added.ok() ? "" : added.error().message);
    return s;
  }();
  return set;
}

/// The only block of a deck with its decoded form.
struct Decoded {
  explicit Decoded(const std::string& body, const std::string& version = "2024")
      : deck(read(deck_of(body, version), {}, schemas())),
        result(decode(deck, deck.blocks[1], &findings)) {}
  Position at(const Span& span) const { return deck.sources.position(span); }
  Deck deck;
  Findings findings;
  DecodedBlock result;
};

std::string cells(std::initializer_list<std::pair<int, const char*>> parts) {
  std::string line(100, ' ');
  for (const auto& [column, text] : parts)
    line.replace(static_cast<std::size_t>(column - 1), std::strlen(text), text);
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

TEST(Decode, ReadsCellsByColumnWithTheirSpans) {
  const Decoded d("/X/CARDS/5\nthe title  \n" +
                  cells({{8, "12"}, {11, "-7"}, {39, "1"}, {50, "0"}}));
  EXPECT_EQ(d.result.title, "the title");
  EXPECT_EQ(d.result.integer("id1"), 12);
  EXPECT_EQ(d.result.integer("n"), -7);
  EXPECT_EQ(d.result.integer("fx"), 1);
  EXPECT_EQ(d.result.find("old"), nullptr);  // 2024 has no such cell
  EXPECT_EQ(d.result.find("v"), nullptr);    // mode is 0
  const Cell* n = d.result.find("n");
  EXPECT_EQ(d.at(n->span).line, 9u);
  EXPECT_EQ(d.at(n->span).column, 11u);
  EXPECT_EQ(n->span.length, 10u);
  EXPECT_EQ(n->text, "-7");
  EXPECT_TRUE(d.findings.all().empty());
}

TEST(Decode, CellsOfALineFollowAFlagOfTheSameLine) {
  const Decoded one("/X/ALTERNATIVES/5\nt\n" + cells({{10, "1"}, {28, "2.5"}}) +
                    cells({{18, "0.5"}}) + cells({{10, "7"}}));
  EXPECT_EQ(one.result.real("area"), 2.5);
  EXPECT_EQ(one.result.find("f"), nullptr);
  EXPECT_EQ(one.result.real("a"), 0.5);
  EXPECT_EQ(one.result.integer("z"), 7);
  const Decoded two("/X/ALTERNATIVES/5\nt\n" + cells({{10, "2"}, {19, "33"}}) + cells({{10, "4"}}) +
                    cells({{10, "7"}}));
  EXPECT_EQ(two.result.integer("f"), 33);
  EXPECT_EQ(two.result.find("area"), nullptr);
  EXPECT_EQ(two.result.integer("b"), 4);
  EXPECT_EQ(two.result.integer("z"), 7);
  const Decoded none("/X/ALTERNATIVES/5\nt\n" + cells({{10, "3"}}) + cells({{10, "7"}}));
  EXPECT_EQ(none.result.integer("z"), 7) << "a line none of whose cells is read is not there";
  EXPECT_TRUE(none.result.extra.empty());
}

TEST(Decode, ACountedListTakesItsLinesAndKeepsThePlacesOfBlankCells) {
  const Decoded d("/X/COUNTED/5\nt\n" + cells({{10, "4"}}) + cells({{9, "11"}, {29, "13"}}) +
                  cells({{9, "14"}, {19, "99"}}) + cells({{10, "1"}}) + cells({{10, "2"}}) +
                  cells({{10, "8"}}));
  std::vector<std::int64_t> items;
  for (const DecodedCard& card : d.result.cards)
    for (const Cell& cell : card.cells)
      if (cell.field->name == "item") items.push_back(cell.integer);
  EXPECT_THAT(items, ::testing::ElementsAre(11, 0, 13, 14));
  EXPECT_EQ(d.result.cards[1].round, 1);
  EXPECT_EQ(d.result.cards[2].round, 2);
  EXPECT_EQ(d.result.integer("p"), 1);
  EXPECT_EQ(d.result.integer("e"), 8);
}

TEST(Decode, AnImpossibleCountEndsWithTheBlock) {
  const Decoded d("/X/COUNTED/5\nt\n" + cells({{1, "2000000000"}, {11, "2000000000"}}) +
                  cells({{9, "11"}}));
  EXPECT_EQ(d.result.cards.size(), 2u);
  EXPECT_EQ(count(d.findings, RuleId::DK029), 1u) << "one for the block";
}

TEST(Decode, AMissingLineNamesTheFlagThatAsksForIt) {
  const Decoded d("/X/CARDS/5\nt\n" + cells({{50, "2"}}));
  const Finding* f = first(d.findings, RuleId::DK029);
  ASSERT_NE(f, nullptr);
  EXPECT_THAT(f->message, HasSubstr("'extra'"));
  EXPECT_THAT(f->message, HasSubstr("mode = 2"));
  ASSERT_EQ(f->notes.size(), 1u);
  EXPECT_EQ(d.at(f->notes[0].first).column, 41u);
  EXPECT_EQ(f->reference->number, 100217);
  ASSERT_EQ(d.result.cards.size(), 2u);
  EXPECT_TRUE(d.result.cards[1].missing());
  EXPECT_EQ(d.result.real("v"), 0);
}

TEST(Decode, OptionalLinesMayBeMissingAndExtraLinesAreNamed) {
  const Decoded none("/X/CARDS/5\nt\n" + cells({{50, "0"}}));
  EXPECT_TRUE(none.findings.all().empty());
  const Decoded extra("/X/CARDS/5\nt\n" + cells({{50, "0"}}) + "free, text\n   \nmore\n");
  EXPECT_EQ(extra.result.find("t")->text, "free, text");  // text cards know no commas
  EXPECT_EQ(count(extra.findings, RuleId::DK030), 1u);    // the blank line is none
  EXPECT_EQ(extra.at(first(extra.findings, RuleId::DK030)->span).line, 12u);
  EXPECT_EQ(extra.result.extra.size(), 2u);
  EXPECT_EQ(count(Decoded("/X/TAIL/5\nt\n         1\nmore\n").findings, RuleId::DK030), 0u);
}

TEST(Decode, AVersionDecidesWhichCellsExist) {
  const std::string body = "/X/CARDS/5\nt\n" + cells({{30, "9"}});
  const Decoded old(body, "2019");
  EXPECT_EQ(old.result.integer("old"), 9);
  EXPECT_TRUE(old.findings.all().empty());
  const Decoded now(body);
  EXPECT_EQ(now.result.find("old"), nullptr);
  const Finding* f = first(now.findings, RuleId::DK027);
  ASSERT_NE(f, nullptr);
  EXPECT_EQ(now.at(f->span).column, 30u);
  EXPECT_EQ(f->severity, Severity::warning);
  const Decoded zero("/X/CARDS/5\nt\n" + cells({{30, "0"}}));
  EXPECT_EQ(first(zero.findings, RuleId::DK027)->severity, Severity::info);
}

TEST(Decode, TextBehindTheCellsIsNamedUnlessItIsZero) {
  const Decoded d("/X/CARDS/5\nt\n" + cells({{50, "0"}, {60, "7"}, {70, "0.0"}, {80, "ab cd"}}));
  EXPECT_EQ(count(d.findings, RuleId::DK028), 3u);
  EXPECT_EQ(d.at(first(d.findings, RuleId::DK028)->span).column, 60u);
  const Decoded tail("/X/CARDS/5\nt\n" + std::string(100, ' ') + "   beyond\n");
  const Decoded zero("/X/CARDS/5\nt\n" + std::string(100, ' ') + "         0\n");
  EXPECT_TRUE(zero.findings.all().empty());
  // A schema that describes only some cells cannot know what the others hold.
  EXPECT_TRUE(Decoded("/X/TAIL/5\nt\n         1         2\n").findings.all().empty());
  EXPECT_EQ(count(tail.findings, RuleId::DK012), 1u);
  EXPECT_EQ(count(tail.findings, RuleId::DK028), 0u);
}

TEST(Decode, ACommaSwitchesTheLineToFreeFormat) {
  // The third cell stands for columns 21-38, which are blank in this version.
  const Decoded d("/X/CARDS/5\nt\n12, 7,,,1 \t 2\n3.5,4\n");
  EXPECT_TRUE(d.result.cards[0].free_format);
  EXPECT_EQ(d.result.integer("id1"), 12);
  EXPECT_EQ(d.result.integer("n"), 7);
  EXPECT_TRUE(d.result.find("fx")->blank());
  EXPECT_EQ(d.result.integer("mode"), 1);
  EXPECT_EQ(d.at(d.result.find("mode")->span).column, 9u);
  EXPECT_EQ(d.result.real("v"), 3.5);
  EXPECT_EQ(count(d.findings, RuleId::DK028), 1u);  // the fifth value has no cell
  EXPECT_EQ(count(d.findings, RuleId::DK013), 0u);  // tabs separate as blanks do
  const Decoded short_line("/X/CARDS/5\nt\n12,\n");
  EXPECT_EQ(short_line.result.integer("id1"), 12);
  EXPECT_TRUE(short_line.result.find("n")->blank());
  EXPECT_TRUE(short_line.findings.all().empty());
}

TEST(Decode, BlankColumnsTakeACellOfAFreeFormatLine) {
  // The reference solver stops such a shell: 1 falls on the columns of a flag that version 2024 no
  // longer has, and the thickness is 0.
  const Deck d = read(deck_of("/PROP/SHELL/1\ns\n\n\n5 1,0 0.0 0 0\n"));
  const DecodedBlock shell = decode(d, *block(d, "/PROP/SHELL/1"));
  EXPECT_EQ(shell.integer("N"), 5);
  EXPECT_EQ(shell.real("Thick"), 0);
  EXPECT_FALSE(shell.find("Thick")->blank());
  const Deck older = read(deck_of("/PROP/SHELL/1\ns\n\n\n5 1,2.5 0.0 0 0\n", "2022"));
  const DecodedBlock with_flag = decode(older, *block(older, "/PROP/SHELL/1"));
  EXPECT_EQ(with_flag.integer("Istrain"), 1);
  EXPECT_EQ(with_flag.real("Thick"), 2.5);
  // Text that falls on blank columns is lost, which has to be said.
  EXPECT_EQ(count(Decoded("/X/CARDS/5\nt\n12,7,9,0\n").findings, RuleId::DK028), 1u);
}

TEST(Decode, ADecimalCommaIsNamedWhereTheLineIsLaidOutInColumns) {
  const Decoded one("/X/CARDS/5\nt\n" + cells({{50, "1"}}) +
                    "                 3,5                 4\n");
  const Finding* f = first(one.findings, RuleId::DK059);
  ASSERT_NE(f, nullptr);
  EXPECT_EQ(one.at(f->span).column, 18u);
  // Free format as it is meant: commas between all cells, with blanks or without.
  for (const char* line : {"12,7,,,1", "12, 7,,,1", "  12 ,7", "12,7 "})
    EXPECT_EQ(count(Decoded("/X/CARDS/5\nt\n" + std::string(line) + "\n").findings, RuleId::DK059),
              0u)
        << line;
  EXPECT_EQ(count(Decoded("/X/CARDS/5\nt\n12 7,5\n").findings, RuleId::DK059), 1u);
}

TEST(Decode, TabsAndNulBytesInFixedColumnsAreNamed) {
  const Decoded tab("/X/CARDS/5\nt\n12\t7\n");
  EXPECT_EQ(tab.at(first(tab.findings, RuleId::DK013)->span).column, 3u);
  EXPECT_EQ(tab.result.integer("id1"), 12);
  EXPECT_EQ(count(tab.findings, RuleId::DK022), 1u);
  const Decoded nul(std::string("/X/CARDS/5\nt\n12\0", 16) + "\n" + "\n");
  EXPECT_EQ(count(nul.findings, RuleId::DK014),
            0u);  // at the end of a line it is trimmed like a blank
  const Decoded inner(std::string("/X/CARDS/5\nt\n1\0  5\n", 19));
  EXPECT_EQ(count(inner.findings, RuleId::DK014), 1u);
  const Decoded list(std::string("/X/IDS/5\nt\n         1\n       \0 2\n         3\n", 44));
  EXPECT_EQ(list.result.cards.size(), 3u) << "no line is lost";
}

struct Fault {
  const char *field, *text;
  RuleId rule;
  int number;
};

TEST(Decode, EveryUnreadableNumberHasItsRule) {
  const Fault faults[] = {
      {"v", "abc", RuleId::DK021, 100102},   {"v", "1.5.2", RuleId::DK022, 0},
      {"v", "1e999", RuleId::DK023, 100104}, {"v", "1e-999", RuleId::DK024, 0},
      {"v", "4e-320", RuleId::DK024, 0},     {"v", "nan", RuleId::DK025, 0},
      {"v", "0x10", RuleId::DK022, 0},       {"v", "1.2345678901234567-3", RuleId::DK026, 0},
      {"id1", "abc", RuleId::DK020, 100101}, {"id1", "1.5", RuleId::DK022, 0},
      {"id1", "12x", RuleId::DK022, 0},      {"id1", "3000000000", RuleId::DK023, 100103}};
  for (const Fault& fault : faults) {
    const bool real = std::string_view(fault.field) == "v";
    const Decoded d("/X/CARDS/5\nt\n" + (real ? cells({{50, "1"}}) : "") + fault.text + "\n");
    ASSERT_EQ(d.findings.all().size(), 1u) << fault.text;
    const Finding& found = d.findings.all()[0];
    EXPECT_EQ(found.rule, fault.rule) << fault.text;
    EXPECT_EQ(found.reference ? found.reference->number : 0, fault.number) << fault.text;
    EXPECT_THAT(found.message, HasSubstr(fault.field));
  }
  EXPECT_TRUE(Decoded("/X/CARDS/5\nt\n" + cells({{50, "1"}}) + "1.5-3\n").findings.all().empty());
}

TEST(Decode, FlagsCountOnlyTheDigitOne) {
  for (const char* text : {"1", "2", "x", "-"}) {
    const Decoded d("/X/CARDS/5\nt\n" + cells({{39, text}}));
    EXPECT_EQ(d.result.integer("fx"), text[0] == '1') << text;
    EXPECT_TRUE(d.findings.all().empty()) << text;
  }
}

TEST(Decode, AFrictionThatEndsAmidAPairSaysSo) {
  // The line that is missing behind the first ones of a pair; "": nothing is.
  const std::string pair = cells({{30, "1"}, {40, "2"}}),
                    two = cells({{30, "1"}, {40, "2"}, {60, "1"}});
  const std::string values = "                 0.1\n", blank = "\n";
  const std::pair<std::string, const char*> rows[] = {
      {"", ""},
      {pair + values + blank, ""},
      {pair + values + blank + blank, ""},  // no pair, a blank line
      {pair, "'coefficients of the pair'"},
      {pair + values + blank + pair + values, "'friction of the pair'"},
      {two + values + blank, "'coefficients of the second direction'"},
      {two + values + blank + values, "'friction of the second direction'"},
      {two + values + blank + values + blank, ""},
  };
  for (const auto& [lines, missing] : rows) {
    const Deck deck = read(deck_of("/FRICTION/5\nt\n\n\n\n" + lines));
    Findings findings;
    decode(deck, deck.blocks[1], &findings);
    ASSERT_EQ(count(findings, RuleId::DK029), *missing == 0 ? 0u : 1u) << lines;
    if (*missing == 0) continue;
    EXPECT_THAT(first(findings, RuleId::DK029)->message, HasSubstr(missing));
    const bool second = std::string_view(missing).find("second") != std::string_view::npos;
    EXPECT_EQ(first(findings, RuleId::DK029)->notes.size(), second ? 2u : 1u);
  }
}

TEST(Decode, AGroupWithoutAMemberInThisVersionEnds) {
  const Decoded d("/X/NEWGROUP/5\nt\n         1\n         2\n", "2019");
  EXPECT_TRUE(d.result.cards.empty());
  EXPECT_EQ(d.result.extra.size(), 2u);
  EXPECT_EQ(Decoded("/X/NEWGROUP/5\nt\n         1\n         2\n").result.cards.size(), 2u);
}

TEST(Decode, ParametersStandForWholeCells) {
  const std::string parameters =
      "/PARAMETER/GLOBAL/INTEGER/1\nt\nN                 7\n/PARAMETER/GLOBAL/REAL/2\nt\n"
      "X                          2.5\n";
  const Deck deck =
      read(deck_of("/X/CARDS/5\nt\n" + cells({{1, "&N"}, {17, "-&N"}, {49, "&X"}}) +
                   cells({{19, "&X"}, {30, "-&X"}}) + parameters + "/X/CARDS/6\nt\n     &NONE\n"),
           {}, schemas());
  Findings findings;
  const DecodedBlock b = decode(deck, deck.blocks[1], &findings);
  EXPECT_EQ(b.integer("id1"), 7);
  EXPECT_EQ(b.integer("n"), -7);
  EXPECT_TRUE(b.find("id1")->parameter);
  EXPECT_EQ(b.integer("mode"), 2);  // a real parameter in an integer cell is cut
  EXPECT_EQ(b.real("v"), 2.5);
  EXPECT_EQ(b.real("w"), -2.5);
  EXPECT_TRUE(findings.all().empty());
  const DecodedBlock none = decode(deck, *block(deck, "/X/CARDS/6"), &findings);
  EXPECT_EQ(none.integer("id1"), 0);
  EXPECT_EQ(count(findings, RuleId::DK018), 1u);
}

TEST(Decode, DimensionsFollowTheirCondition) {
  const std::string card = "                 2.5                  4.\n";
  const std::string head = banner +
                           "/BEGIN\nrun\n      2024\n"
                           "                  Mg                   m                   s\n"
                           "                  kg                  mm                  ms\n";
  const Deck deck = read(head + "/X/CARDS/5\nt\n" + cells({{50, "1"}}) + card + "/X/CARDS/6\nt\n" +
                             cells({{50, "2"}}) + card + "/END\n",
                         {}, schemas());
  const DecodedBlock one = decode(deck, *block(deck, "/X/CARDS/5"));
  EXPECT_EQ(working_value(deck, one, *one.find("v")), 2500);
  EXPECT_NEAR(working_value(deck, one, *one.find("w")), 4., 1e-12);  // Mg/s = 1 kg/ms
  const DecodedBlock two = decode(deck, *block(deck, "/X/CARDS/6"));
  EXPECT_TRUE(dimension_of(*two.find("w")->field, two).dimensionless());
  EXPECT_EQ(working_value(deck, two, *two.find("w")), 4);
}

TEST(Decode, WithoutSchemaNothingIsGuessed) {
  const Deck deck = read(deck_of("/NO/SUCH/5\nt\n         1\n"));
  const DecodedBlock b = decode(deck, deck.blocks[1]);
  EXPECT_TRUE(b.cards.empty());
  EXPECT_TRUE(b.extra.empty());
}

// ---- lines without content ----------------------------------------------------------------------

/// `text` so that it ends in `column`, behind `line`.
std::string to(int column, const std::string& text, std::string line = {}) {
  line.resize(static_cast<std::size_t>(column) - text.size(), ' ');
  return line + text;
}

/// What is found about a default block of these lines.
Findings found_in(int type, const std::vector<std::string>& lines,
                  const std::string& version = "2024") {
  std::string text = "/DEFAULT/INTER/TYPE" + std::to_string(type) + "\n";
  for (const std::string& line : lines) text += line + "\n";
  const Deck deck = read(deck_of(text, version));
  Findings found;
  decode(deck, *block(deck, "/DEFAULT/INTER/TYPE" + std::to_string(type)), &found);
  return found;
}

const std::string flags_7 = to(80, "2", to(50, "3", to(30, "4"))), removal = to(90, "2"),
                  inacti = to(40, "6"), iform = to(50, "2");

TEST(BlankLines, ACompleteDefaultBlockSaysNothing) {
  EXPECT_TRUE(found_in(7, {"", flags_7, "", removal, "", inacti, iform}).all().empty());
  EXPECT_TRUE(found_in(7, {"0", flags_7, "", removal, "0.0  0", inacti, iform}).all().empty());
  EXPECT_TRUE(found_in(11, {"", flags_7, to(90, "2"), "", inacti}).all().empty());
  EXPECT_TRUE(found_in(19, {"", flags_7, "", "", "", inacti, iform}, "140").all().empty());
  EXPECT_TRUE(found_in(2, {"", to(40, "27"), to(70, "3")}).all().empty());
  EXPECT_TRUE(found_in(24, {"", to(30, "1"), "", "", "", inacti}, "140").all().empty());
}

TEST(BlankLines, WithoutThemADefaultBlockIsAnErrorAndNothingElse) {
  const Findings found = found_in(7, {flags_7, removal, inacti, iform});
  ASSERT_EQ(found.all().size(), 1u);
  const Finding& d = found.all()[0];
  EXPECT_EQ(d.rule, RuleId::DK511);
  EXPECT_EQ(d.severity, Severity::error);
  EXPECT_THAT(d.message,
              HasSubstr("lacks 3 lines that must be blank, so its values are lost: Istf = 4, "));
  ASSERT_TRUE(d.fix);
  EXPECT_TRUE(d.fix->safe);
}

TEST(BlankLines, AnyOfThemCanBeTheOnesThatAreMissing) {
  using Lines = std::vector<std::string>;
  for (const Lines& lines :
       {Lines{"", flags_7, removal, inacti, iform}, Lines{flags_7, "", removal, "", inacti, iform},
        Lines{"", flags_7, "", removal, inacti, iform}, Lines{flags_7},
        Lines{"# 1", flags_7, "$", removal, "#", inacti, iform}})
    EXPECT_EQ(count(found_in(7, lines), RuleId::DK511), 1u);
  EXPECT_EQ(count(found_in(11, {flags_7, to(90, "2"), inacti}), RuleId::DK511), 1u);
  EXPECT_EQ(count(found_in(19, {flags_7, inacti, iform}, "2017"), RuleId::DK511), 1u);
  EXPECT_EQ(count(found_in(2, {to(40, "27"), to(70, "3")}), RuleId::DK511), 1u);
  EXPECT_EQ(count(found_in(24, {to(80, "1", to(30, "1")), to(40, "1")}), RuleId::DK511), 1u);
}

TEST(BlankLines, OtherMistakesAreNotTakenForIt) {
  const std::pair<Findings, RuleId> rows[] = {
      {found_in(7, {"defaults", flags_7, "", removal, "", inacti, iform}), RuleId::DK028},
      {found_in(7, {"", flags_7, "", removal, "", to(60, "6"), iform}), RuleId::DK028},
      {found_in(7, {"", flags_7, "", removal}), RuleId::DK029},
      {found_in(11, {"", flags_7, to(90, "2"), "", inacti, iform}), RuleId::DK030}};
  for (const auto& [found, rule] : rows) {
    EXPECT_EQ(count(found, RuleId::DK511), 0u) << id_text(rule);
    EXPECT_GT(count(found, rule), 0u) << id_text(rule);
  }
}

TEST(BlankLines, AStretchWithoutFieldTakesACellInFreeFormat) {
  const Deck deck = read(deck_of("/DEFAULT/INTER/TYPE7\n\n,4,,3,,1,2\n\n,2,1\n\n,6\n,2\n"));
  const DecodedBlock b = decode(deck, *block(deck, "/DEFAULT/INTER/TYPE7"));
  const std::pair<const char*, std::int64_t> values[] = {
      {"Istf", 4},     {"Igap", 3},    {"Ibag", 1},   {"Idel", 2},
      {"Irem_gap", 2}, {"Irem_i2", 1}, {"Inacti", 6}, {"Iform", 2}};
  for (const auto& [field, value] : values) EXPECT_EQ(b.integer(field), value) << field;
}

}  // namespace
}  // namespace deck
