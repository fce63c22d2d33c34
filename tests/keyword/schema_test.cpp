// The built-in keyword schemas as a whole, the look-up of headers, and the loader of schema files.
#include "deck/keyword.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <thread>

#include "base/shared/embedded.hpp"
#include "keyword/reading.hpp"
#include "keyword/schema/json.hpp"
#include "keyword/shared/schema_facts.hpp"
#include "where.hpp"

namespace deck {
namespace {

using ::testing::HasSubstr;

constexpr int all_versions[] = {51,   90,   100,  110,  120,  130,  140,  2017, 2018,
                                2019, 2020, 2021, 2022, 2023, 2024, 2025, 2026};
std::string error_of(std::string_view text) {
  SchemaSet set;
  const auto added = set.add_json("test.json", text);
  return added ? "accepted" : added.error().message;
}

std::string with_cards(const std::string& list) {
  return R"({"keyword":"/A","cards":[)" + list + "]}";
}

// ---- The built-in files

TEST(BuiltInSchemas, MayBeAskedForByManyThreadsAtOnce) {
  const auto& set = SchemaSet::built_in();
  std::vector<std::thread> threads;
  std::array<std::vector<const Schema*>, 4> seen;
  for (auto& result : seen) threads.emplace_back([&] { result = set.all(); });
  for (auto& thread : threads) thread.join();
  for (const auto& result : seen) EXPECT_EQ(result, seen[0]);
  for (const auto* s : seen[0]) EXPECT_FALSE(s->keyword.empty());
}

TEST(Schemas, ATableGivesOneSchemaForEachRow) {
  SchemaSet set;
  const auto added = set.add_json("x.json", R"({"schemas":[{
    "for":[["G","kind"],["GRA","shell"],["GRB","sh3n"]],"schemas":[
      {"for":[["S"],["{G}"],["PART"]],"schemas":[
        {"keyword":"/{G}/{S}","aliases":["/{S}/{G}/X"],"kind":"{kind}","doc":"{G} {?} {G}"}]}]}]})");
  ASSERT_TRUE(added) << added.error().message;
  EXPECT_EQ(set.all().size(), 4u);
  const Schema* of_b = set.find("/PART/GRB/X");
  ASSERT_NE(of_b, nullptr);
  EXPECT_EQ(of_b->keyword, "/GRB/PART");
  EXPECT_EQ(of_b->kind, "sh3n");
  EXPECT_EQ(of_b->doc, "GRB {?} GRB");
  EXPECT_NE(set.find("/GRA/GRA"), nullptr);
  const auto error = [](const std::string& table) {
    return error_of(R"({"schemas":[{"for":)" + table + R"(,"schemas":[{"keyword":"/A"}]}]})");
  };
  EXPECT_THAT(error(R"([["G"]])"), HasSubstr("/schemas/0/for: expected a row of names"));
  EXPECT_THAT(error(R"([["G"],["a","b"]])"), HasSubstr("/schemas/0/for/1: expected 1 words"));
  EXPECT_THAT(error(R"([["G"],[1]])"), HasSubstr("/schemas/0/for/1/0: expected text"));
  EXPECT_THAT(error_of(R"({"schemas":[{"for":[["G"],["a"]]}]})"),
              HasSubstr("schemas\" is missing"));
}

TEST(Schemas, ATableInAListOfCardsOrFieldsGivesItsItemsForEachRow) {
  SchemaSet set;
  const auto added = set.add_json("x.json", R"({"keyword":"/A","doc":"d","cards":[
    {"name":"first","blank":true},
    {"for":[["n"],["1"],["2"]],"cards":[{"name":"card {n}","fields":[
      {"for":[["axis","at"],["x","m"]],"fields":[
        {"name":"{axis}{n}{at}","cols":[1,10],"type":"int"}]},
      {"name":"last{n}","cols":[11,20],"type":"int"}]}]}]})");
  ASSERT_TRUE(added) << added.error().message;
  const Schema& a = *set.find("/A");
  ASSERT_EQ(a.cards.size(), 3u);
  EXPECT_EQ(a.cards[2].name, "card 2");
  ASSERT_EQ(a.cards[2].fields.size(), 2u);
  EXPECT_EQ(a.cards[2].fields[0].name, "x2m");
  EXPECT_EQ(a.cards[2].fields[1].name, "last2");
  EXPECT_THAT(
      error_of(
          R"({"schemas":[{"for":[["n"],["1"],["2"]],"schemas":[{"keyword":"/A/{n}","doc":"x","cards":[]}]},
                                      {"keyword":"/B","crads":[]}]})"),
      HasSubstr("\"/B\" at "));
  EXPECT_THAT(error_of(R"({"keyword":"/A","cards":[{"for":[["n"],["1"]],"fields":[]}]})"),
              HasSubstr("/cards/0: unknown key \"fields\" (known: for, cards)"));
}

TEST(BuiltInSchemas, NoVersionIsLeftWithoutCards) {
  // A hole in the version ranges would make a keyword lose its first line in some version.
  for (const auto* s : SchemaSet::built_in().all()) {
    if (s->cards.empty()) continue;
    for (const int version : all_versions) {
      if (version < std::max(s->from, 51)) continue;
      // A keyword may have lost its cards for good.
      const bool any = std::any_of(s->cards.begin(), s->cards.end(),
                                   [&](const auto& card) { return card.in_version(version); }) ||
                       std::all_of(s->cards.begin(), s->cards.end(),
                                   [&](const auto& card) { return card.until < version; });
      EXPECT_TRUE(any) << s->keyword << " " << version;
    }
  }
}

// ---- Looking up headers

TEST(MatchHeader, LongestKeywordWinsByWholeFields) {
  const auto& set = SchemaSet::built_in();
  const auto name = [&](std::string_view header) -> std::string {
    const auto* s = set.match(header);
    return s ? s->keyword : "";
  };
  EXPECT_EQ(name("/GRNOD/NODENS/5"), "/GRNOD/NODENS");
  EXPECT_EQ(name("/GRNOD/NODE/5"), "/GRNOD/NODE");
  EXPECT_EQ(name("/MAT/LAW02/7"), "/MAT/LAW2") << "another spelling";
  EXPECT_EQ(name("/GRNOD/NODEX/5"), "");
  EXPECT_EQ(name("/GRSH3N/5"), "/GRSH3N") << "an empty group";
  for (const char* law : {"/MAT/LAW00/1", "/MAT/PLAS_JOHNSON/1", "/MAT/M1_ELAST/1"})
    EXPECT_EQ(name(law), "/MAT/*") << law;
  for (const char* nothing : {"/MAT/JOHNS/1", "/FAIL/FOO/1", "/SURF/PARTS/1"})
    EXPECT_EQ(name(nothing), "") << nothing;
  EXPECT_EQ(name("/SURF/PART/12"), "/SURF/PART");
  EXPECT_EQ(name("/SURF/PART/EXT/12/3"), "/SURF/PART/EXT");
  EXPECT_EQ(name("/INTER/TYPE1/4"), "/INTER/TYPE1");
  EXPECT_EQ(name("/INTER/TYPE7/ADDD/4"), "/INTER/TYPE7");
  EXPECT_EQ(name("/INTER/ADDD/TYPE7/4"), "/INTER/TYPE7");
  EXPECT_EQ(name("/INTER/TYPE77/4"), "");
  EXPECT_EQ(name("  /NODE\t"), "/NODE");
  EXPECT_EQ(name("//SUBMODEL/3"), "//SUBMODEL");
  EXPECT_EQ(name("/SUBMODEL/3"), "");
  EXPECT_EQ(name("/UNIT/LENGTH/mm"), "/UNIT/LENGTH");
  EXPECT_EQ(name("/END"), "/END");
  EXPECT_EQ(name("/END/ENGINE"), "/END/ENGINE");
  EXPECT_EQ(name(""), "");
  EXPECT_EQ(name("/"), "");
  EXPECT_EQ(name("NODE"), "");
  EXPECT_EQ(name("/inter/type7/1"), "") << "keywords are case-sensitive";
}

// ---- The loader

using Errors = std::vector<std::pair<std::string, const char*>>;

/// Documents with a part of the error of each.
void expect_errors(const Errors& rows) {
  for (const auto& [document, error] : rows) EXPECT_THAT(error_of(document), HasSubstr(error));
}

TEST(SchemaLoader, ReportsFileAndPathOfWhatIsWrong) {
  expect_errors({
      {"{", "test.json: not valid JSON"},
      {"[]", "test.json: /: expected an object, found array"},
      {R"({"doc":"d"})", "the key \"keyword\" is missing"},
      {R"({"keyword":"A"})", "/keyword: \"A\" is not a keyword"},
      {R"({"keyword":"/A B"})", "is not a keyword"},
      {R"({"keyword":"/A","colour":1})", "unknown key \"colour\""},
      {R"({"keyword":"/A","id":1})", "/id: expected true or false"},
      {R"({"keyword":"/A","keyword":"/B"})", "occurs twice"},
      {R"({"keyword":"/A","from":60})", "/from: 60 is not an input"},
      {R"({"keyword":"/A","older":"unread"})", "/older: \"from\""},
      {R"({"keyword":"/A","from":90,"older":"oldest"})", "/older"},
      {R"({"keyword":"/A","aliases":["/A"]})", "already names"},
      {R"({"schemas":[{"keyword":"/A"},{"keyword":"/A"}]})", "/A of /A already names /A"},
      {R"({"schemas":[{"keyword":"/A"},{"keyword":"/B","x":1}]})", "/schemas/1: unknown key"},
      {R"({"schemas":[],"x":1})", "unknown key \"x\""},
  });
}

TEST(SchemaLoader, DecksBeforeTheFirstLayoutAreReadWithIt) {
  const std::string cards =
      R"("doc":"d","from":2018,"cards":[{"name":"c","versions":[2018,null],"fields":[)"
      R"({"name":"f","cols":[1,10],"type":"int","versions":[2018,2020]},)"
      R"({"name":"g","cols":[11,20],"type":"int","versions":[2021,null]}]}]})";
  SchemaSet set;
  ASSERT_TRUE(set.add_json("t", R"({"keyword":"/OLD",)" + cards));
  ASSERT_TRUE(set.add_json("t", R"({"keyword":"/UNREAD","older":"unread",)" + cards));
  const Schema& old = *set.find("/OLD");
  const Schema& unread = *set.find("/UNREAD");
  for (const int version : {51, 2017, 2018}) {
    EXPECT_TRUE(detail::reads_lines(old, version));
    EXPECT_TRUE(old.cards[0].in_version(version));
    EXPECT_TRUE(old.cards[0].fields[0].in_version(version));
    EXPECT_FALSE(old.cards[0].fields[1].in_version(version));
    EXPECT_EQ(detail::reads_lines(unread, version), version >= 2018);
    EXPECT_EQ(unread.cards[0].in_version(version), version >= 2018);
  }
}

TEST(SchemaLoader, RefusesWrongFields) {
  const std::pair<const char*, const char*> rows[] = {
      {R"("cols":[1,10],"type":"int")", "accepted"},
      {R"("cols":[1,9],"type":"int","values":[1])", "accepted"},
      {R"("cols":[1,1],"type":"flag","values":[1])", "accepted"},
      {R"("cols":[1,9],"type":"id","ref":"node","values":[1])", "accepted"},
      {R"x("cols":[1,9],"type":"int","default":"0 (none)","default_value":0)x", "accepted"},
      {R"("type":"int")", "/cards/0/fields/0: the key \"cols\""},
      {R"("cols":[0,10],"type":"int")", "/cards/0/fields/0/cols"},
      {R"("cols":[91,101],"type":"int")", "do not lie in 1-100"},
      {R"("cols":[1,"x"],"type":"int")", "/cols/1: expected a whole"},
      {R"("cols":[1,10],"type":"integer")", "is not a field type"},
      {R"("cols":[1,10],"type":"id")", "\"ref\" is required"},
      {R"("cols":[1,10],"type":"int","ref":"node")", "\"ref\""},
      {R"("cols":[1,2],"type":"flag")", "exactly one column"},
      {R"("cols":[1,9],"type":"int","dim":[0,1,0])", "only real fields"},
      {R"("cols":[1,9],"type":"real","dim":[0,1])", "exponents"},
      {R"("cols":[1,9],"type":"real","values":[1])", "only integer"},
      {R"("cols":[1,9],"type":"text","values":[1])", "only integer"},
      {R"("cols":[1,9],"type":"real","min":2,"max":1)", "above max"},
      {R"("cols":[1,9],"type":"real","min_open":true)", "open bound"},
      {R"("cols":[1,9],"type":"int","versions":[90])", "from, until"},
      {R"("cols":[1,9],"type":"int","versions":[110,100])", "empty"},
      {R"("cols":[1,9],"type":"int","default":"3","default_value":3)", "this number already"},
      {R"("cols":[1,9],"type":"int","default_varies":"sometimes")", "not deck, model or fields"},
  };
  for (const auto& [field, error] : rows)
    EXPECT_THAT(
        error_of(with_cards(std::string(R"({"name":"c","fields":[{"name":"f",)") + field + "}]}")),
        HasSubstr(error));
}

TEST(SchemaLoader, RefusesOverlapOnlyWithinTheSameVersion) {
  const auto two = [](const std::string& first, const std::string& second) {
    return error_of(with_cards(R"({"name":"c","fields":[{"name":"f","cols":[1,10],"type":"int")" +
                               first + R"(},{"name":"g","cols":[10,20],"type":"int")" + second +
                               "}]}"));
  };
  EXPECT_THAT(two("", ""), HasSubstr("10-20 of \"g\" overlap 1-10 of \"f\""));
  EXPECT_EQ(two(R"(,"versions":[51,119])", R"(,"versions":[120,null])"), "accepted");
  EXPECT_THAT(two(R"(,"versions":[51,120])", R"(,"versions":[120,null])"), HasSubstr("overlap"));
}

TEST(SchemaLoader, RefusesWrongCards) {
  const std::string flag = R"({"name":"a","fields":[{"name":"f","cols":[1,10],"type":"int"}]})";
  const std::string late = R"({"name":"b","when":[{"field":"f","in":[1]}],"blank":true})";
  const std::string newer =
      R"({"name":"a","fields":[{"name":"f","cols":[1,10],"type":"int","versions":[120,null]}]})";
  const std::string real = R"({"name":"a","fields":[{"name":"f","cols":[1,10],"type":"real"}]})";
  const std::string nothing = R"({"name":"b","when":[{"field":"f"}],"blank":true})";
  const std::string more = R"({"name":"b","when":[{"field":"f","in":[1],"on":[2]}],"blank":true})";
  const std::string ids =
      R"({"name":"i","repeat":"ids","fields":[{"name":"i","cols":[1,10],"type":"int"}]})";
  expect_errors({
      // Conditions on fields that are unknown or come later.
      {with_cards(flag + "," + late), "accepted"},
      {with_cards(late + "," + flag), "no earlier card"},
      {with_cards(late), "integer field \"f\""},
      {with_cards(newer + "," + late), "in version 51"},
      {with_cards(real + "," + late), "integer field \"f\""},
      {with_cards(flag + "," + nothing), "tests nothing"},
      {with_cards(flag + "," + more), "/cards/1/when/0"},
      // Names and repetition.
      {with_cards(flag + "," + flag), "already used by card 0"},
      {with_cards(flag + "," + ids), "accepted"},
      {with_cards(ids + "," + flag), "nothing can follow card 0"},
      {with_cards(R"({"name":"i","repeat":"ids","blank":true})"), "exactly one field"},
      {with_cards(R"({"name":"i","repeat":"often","blank":true})"), "is not rows, ids, words"},
      // A blank line has no fields, a line without fields is blank.
      {with_cards(R"({"name":"b","blank":true})"), "accepted"},
      {with_cards(R"({"name":"b","fields":[]})"), "\"blank\""},
      {with_cards(R"({"name":"b","blank":true,"fields":[]})"), "a blank line has no fields"},
  });
}

TEST(SchemaLoader, AFileWithAnErrorLeavesTheSetAsItWas) {
  SchemaSet set;
  ASSERT_TRUE(set.add_json("a", R"({"keyword":"/A","aliases":["/AA"],"doc":"first"})"));
  EXPECT_FALSE(set.add_json("b", R"({"schemas":[{"keyword":"/B"},{"keyword":"/C","x":1}]})"));
  EXPECT_FALSE(set.add_json("c", R"({"schemas":[{"keyword":"/B"},{"keyword":"/AA"}]})"));
  EXPECT_EQ(set.all().size(), 1u);
  EXPECT_EQ(set.find("/AA")->doc, "first");
}

TEST(SchemaLoader, ALaterFileReplacesAKeywordWithItsAliases) {
  SchemaSet set;
  ASSERT_TRUE(set.add_json("a", R"({"keyword":"/A","aliases":["/AA"],"doc":"first"})"));
  ASSERT_TRUE(set.add_json("b", R"({"keyword":"/A","doc":"second"})"));
  EXPECT_EQ(set.find("/A")->doc, "second");
  EXPECT_EQ(set.find("/A")->source, "b");
  EXPECT_EQ(set.find("/AA"), nullptr);
  EXPECT_EQ(set.all().size(), 1u);
}

TEST(SchemaLoader, ASchemaWithoutCardsReplacesOneWithCardsOnlyWhenItSaysSo) {
  SchemaSet set = SchemaSet::built_in();
  const auto silent = set.add_json("a", R"({"keyword":"/INTER/TYPE7","kind":"inter"})");
  ASSERT_FALSE(silent);
  EXPECT_THAT(silent.error().message, HasSubstr("/INTER/TYPE7 replaces a schema with cards"));
  EXPECT_FALSE(set.find("/INTER/TYPE7")->cards.empty());
  EXPECT_TRUE(set.add_json("b", R"({"keyword":"/INTER/TYPE7","kind":"inter","cards":[]})"));
  EXPECT_TRUE(set.find("/INTER/TYPE7")->cards.empty());
}

TEST(SchemaLoader, WhatAValueDependsOnMustBeThere) {
  const auto fields = [](const std::string& more) {
    return with_cards(R"({"name":"c","fields":[
      {"name":"Dir","cols":[1,10],"type":"text"},{"name":"n","cols":[11,20],"type":"int"},
      {"name":"s","cols":[21,40],"type":"real"},)" +
                      more + "]}");
  };
  const std::string id = R"({"name":"f","cols":[41,50],"type":"id","ref":"funct",)";
  const std::string real = R"({"name":"r","cols":[51,70],"type":"real",)";
  const std::string when =
      R"("dim_when":[{"when":[{"field":"Dir","words":["X"]}],"dim":[0,1,0]}]})";
  expect_errors({
      {fields(id + R"("axes":[{"scale":"s"},{"dim":[0,1,0]}]})"), "accepted"},
      {fields(real + when), "accepted"},
      {fields(id + R"("axes":[{"scale":"n"},{}]})"), "no card has a real field \"n\""},
      {fields(id + R"("axes":[{}]})"), "the ordinate last"},
      {fields(id + R"("dim_unknown":true,"axes":[{},{}]})"), "exclude each other"},
      {fields(real + R"("axes":[{},{}]})"), "only ids of functions"},
      {fields(real + R"("over":{"field":"x"}})"), "real field \"x\""},
      {fields(real + R"("unit_for":["x"]})"), "field \"x\""},
      {fields(real + R"("when":[{"field":"Dir","words":["X"]}]})"),
       "tested by cards and dimensions"},
  });
}

using SchemaDirectory = testing_support::Folder;

TEST_F(SchemaDirectory, FilesAreReadInNameOrder) {
  file("b.json", R"({"keyword":"/A","doc":"second"})");
  file("a.json", R"({"keyword":"/A","doc":"first"})");
  file("c.txt", "not a schema");
  SchemaSet set;
  const auto added = set.add_directory(dir_.string());
  ASSERT_TRUE(added) << added.error().message;
  EXPECT_EQ(set.find("/A")->doc, "second");
}

TEST_F(SchemaDirectory, ErrorsNameTheFile) {
  file("wrong.json", R"({"keyword":"/A","cards":7})");
  SchemaSet set;
  const auto added = set.add_directory(dir_.string());
  ASSERT_FALSE(added);
  EXPECT_THAT(added.error().message, HasSubstr("wrong.json: /cards: expected a list"));
  EXPECT_EQ(added.error().code, Error::Code::config);
  const auto absent = set.add_directory((dir_ / "absent").string());
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, Error::Code::io);
  EXPECT_THAT(absent.error().message, HasSubstr("absent"));
}

/// Each row of a list has a flag of its own that says what its value is.
TEST_F(SchemaDirectory, TheRowOfAValueDecidesOnItsUnit) {
  file("hose.json", R"({"keyword": "/HOSE", "kind": "other", "title": false, "cards": [
    {"name": "row", "repeat": "rows", "fields": [
      {"name": "share", "cols": [1, 10], "type": "int"},
      {"name": "size", "cols": [11, 30], "type": "real", "dim_when": [
        {"when": [{"field": "share", "in": [0]}], "dim": [0, 2, 0]},
        {"when": [{"field": "share", "in": [1]}], "dim": [0, 0, 0]}]}]}]})");
  SchemaSet set = SchemaSet::built_in();
  ASSERT_TRUE(set.add_directory(dir_.string()));
  const std::string units = "                  kg                   m                   s\n";
  const auto deck =
      read_deck_text("hose_0000.rad",
                     "#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n" + units + units +
                         "/UNIT/8\nu\n                  kg                  mm"
                         "                   s\n/HOSE/3/8\n"
                         "         0                 4.0\n"
                         "         1                 4.0\n/END\n",
                     set);
  ASSERT_TRUE(deck.ok());
  const auto hose = std::find_if(deck->blocks.begin(), deck->blocks.end(),
                                 [](const Block& b) { return b.keyword == "/HOSE"; });
  ASSERT_NE(hose, deck->blocks.end());
  const DecodedBlock d = decode(*deck, *hose);
  ASSERT_EQ(d.cards.size(), 2u);
  for (const auto& [row, expected] : {std::pair(0, 4e-6), std::pair(1, 4.0)}) {
    const DecodedCard& card = d.cards[static_cast<std::size_t>(row)];
    EXPECT_DOUBLE_EQ(working_value(*deck, d, card.cells.at(1), &card), expected) << row;
  }
}

TEST(ConditionTest, ListAndBoundsMustBothHold) {
  Condition condition{
      .field = "f", .words = {}, .in = {1, 2, 9}, .not_in = {}, .min = 2, .max = {}};
  EXPECT_FALSE(condition.accepts(1));
  EXPECT_TRUE(condition.accepts(2));
  EXPECT_FALSE(condition.accepts(3));
  condition.max = 8;
  EXPECT_FALSE(condition.accepts(9));
}

}  // namespace
}  // namespace deck
