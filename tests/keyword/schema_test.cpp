// The built-in keyword schemas as a whole, the look-up of headers, and the loader of schema files.
#include "deck/keyword/schema.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <thread>

#include "base/shared/embedded.hpp"
#include "deck/keyword/decode.hpp"
#include "keyword/schema/json.hpp"
#include "keyword/shared/older_decks.hpp"
#include "where.hpp"

namespace deck {
namespace {

using ::testing::HasSubstr;
using ::testing::UnorderedElementsAreArray;

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

// ---------------------------------------------------------------------------------------------
// The built-in files

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
  EXPECT_THAT(error_of(R"({"schemas":[{"for":[["G"],["a"]]}]})"), HasSubstr("schemas\" is missing"));
}

TEST(BuiltInSchemas, CellsOverlapInNoVersionUnlessConditionsTellThemApart) {
  for (const auto* s : SchemaSet::built_in().all())
    for (const auto& card : s->cards)
      for (const int version : all_versions) {
        if (!card.in_version(version)) continue;
        std::array<const Field*, 101> owner{};
        for (const auto& field : card.fields) {
          if (!field.in_version(version)) continue;
          for (int column = field.first; column <= field.last; ++column) {
            const auto*& slot = owner[static_cast<std::size_t>(column)];
            if (slot != nullptr && !slot->when.empty() && !field.when.empty()) continue;
            EXPECT_EQ(slot, nullptr) << s->keyword << " " << version << " column " << column;
            slot = &field;
          }
        }
      }
}

TEST(BuiltInSchemas, ConditionsTestFieldsThatWereReadBefore) {
  for (const auto* s : SchemaSet::built_in().all())
    for (const int version : all_versions) {
      if (version < s->from) continue;
      std::set<std::string> known;
      for (const auto& card : s->cards) {
        if (!card.in_version(version)) continue;
        for (const auto& condition : card.when)
          EXPECT_TRUE(known.count(condition.field) || condition.field == Condition::data_lines)
              << s->keyword << " " << version << " " << condition.field;
        for (const auto& field : card.fields)
          if (field.in_version(version) && field.type != FieldType::real) known.insert(field.name);
      }
    }
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

TEST(BuiltInSchemas, EverySchemaSaysWhatItIs) {
  for (const auto* s : SchemaSet::built_in().all()) {
    EXPECT_FALSE(s->doc.empty()) << s->keyword;
    EXPECT_FALSE(s->kind.empty()) << s->keyword;
  }
}

TEST(BuiltInSchemas, BulkKeywordsAreTheNodeAndElementBlocks) {
  std::vector<std::string> bulk;
  for (const auto* s : SchemaSet::built_in().all())
    if (s->bulk) bulk.push_back(s->keyword);
  EXPECT_THAT(bulk,
              UnorderedElementsAreArray({"/NODE", "/CNODE", "/SHELL", "/SH3N", "/TRIA", "/QUAD",
                                         "/BRICK", "/TETRA4", "/PENTA6", "/TETRA10", "/BRIC20",
                                         "/SHEL16", "/TRUSS", "/BEAM", "/SPRING"}));
}

// ---------------------------------------------------------------------------------------------
// Looking up headers

TEST(MatchHeader, LongestKeywordWinsByWholeFields) {
  const auto& set = SchemaSet::built_in();
  const auto name = [&](std::string_view header) -> std::string {
    const auto* s = set.match(header);
    return s ? s->keyword : "";
  };
  EXPECT_EQ(name("/GRNOD/NODENS/5"), "/GRNOD/NODENS");
  EXPECT_EQ(name("/GRNOD/NODE/5"), "/GRNOD/NODE");
  EXPECT_EQ(name("/GRNOD/NODEX/5"), "");
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

TEST(MatchHeader, AliasesNameTheSameSchema) {
  const auto& set = SchemaSet::built_in();
  EXPECT_EQ(set.match("/PROP/TYPE1/7"), set.match("/PROP/SHELL/7"));
  EXPECT_EQ(set.match("/MAT/LAW2/7"), set.match("/MAT/PLAS_JOHNS/7"));
  EXPECT_EQ(set.match("/MAT/LAW02/7"), set.match("/MAT/PLAS_JOHNS/7"));
  EXPECT_NE(set.match("/MAT/LAW02/7"), set.match("/MAT/PLAS_ZERIL/7")) << "it has other cards";
  EXPECT_EQ(set.match("/MAT/VOID/7"), set.match("/MAT/LAW0/7"));
  EXPECT_EQ(set.match("/ASSEMBLY/7"), set.match("/SUBSET/7"));
  EXPECT_EQ(set.find("/PROP/TYPE14"), set.find("/PROP/SOLID"));
  EXPECT_NE(set.find("/PROP/TYPE14"), nullptr);
}

TEST(MatchHeader, KnowsTheKeywordsOfCommonDecks) {
  for (const char* header : {"/TH/NODE/1",
                             "/BCS/3",
                             "/RBODY/1",
                             "/RWALL/PLANE/2",
                             "/FAIL/JOHNSON/1",
                             "/EOS/PUFF/1",
                             "/ALE/GRID/DONEA",
                             "/MONVOL/AIRBAG1/1",
                             "/SPHBCS/SLIDE/1",
                             "/INTER/TYPE25/1",
                             "/AMS",
                             "/SHFRA/V4",
                             "/MAT/GAS/PREDEF/4",
                             "/MAT/USER01/1",
                             "/PROP/TYPE45/1",
                             "/PROP/SPR_PRE/1",
                             "/INIVEL/T+G/1",
                             "/SENSOR/SENS/1",
                             "/ANIM/VECT/VEL",
                             "/RUN/model1",
                             "/INIBRI/STRESS",
                             "/FUNCT_PYTHON/1",
                             "/DFS/DETPOIN/1",
                             "/CYL_JOINT/1",
                             "/ADMAS/0/1"})
    EXPECT_NE(SchemaSet::built_in().match(header), nullptr) << header;
}

// ---------------------------------------------------------------------------------------------
// The loader

TEST(SchemaLoader, ReportsFileAndPathOfWhatIsWrong) {
  EXPECT_THAT(error_of("{"), HasSubstr("test.json: not valid JSON"));
  EXPECT_THAT(error_of("[]"), HasSubstr("test.json: /: expected an object, found array"));
  EXPECT_THAT(error_of(R"({"doc":"d"})"), HasSubstr("the key \"keyword\" is missing"));
  EXPECT_THAT(error_of(R"({"keyword":"A"})"), HasSubstr("/keyword: \"A\" is not a keyword"));
  EXPECT_THAT(error_of(R"({"keyword":"/A B"})"), HasSubstr("is not a keyword"));
  EXPECT_THAT(error_of(R"({"keyword":"/A","colour":1})"), HasSubstr("unknown key \"colour\""));
  EXPECT_THAT(error_of(R"({"keyword":"/A","id":1})"), HasSubstr("/id: expected true or false"));
  EXPECT_THAT(error_of(R"({"keyword":"/A","keyword":"/B"})"), HasSubstr("occurs twice"));
  EXPECT_THAT(error_of(R"({"keyword":"/A","from":60})"), HasSubstr("/from: 60 is not an input"));
  EXPECT_THAT(error_of(R"({"schemas":[{"keyword":"/A"},{"keyword":"/B","x":1}]})"),
              HasSubstr("/schemas/1: unknown key"));
  EXPECT_THAT(error_of(R"({"schemas":[],"x":1})"), HasSubstr("unknown key \"x\""));
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
  EXPECT_THAT(error_of(R"({"keyword":"/A","older":"unread"})"), HasSubstr("/older: \"from\""));
  EXPECT_THAT(error_of(R"({"keyword":"/A","from":90,"older":"oldest"})"), HasSubstr("/older"));
}

TEST(SchemaLoader, RefusesWrongFields) {
  const auto field = [](const std::string& body) {
    return error_of(with_cards(R"({"name":"c","fields":[{"name":"f",)" + body + "}]}"));
  };
  EXPECT_EQ(field(R"("cols":[1,10],"type":"int")"), "accepted");
  EXPECT_THAT(field(R"("type":"int")"), HasSubstr("/cards/0/fields/0: the key \"cols\""));
  EXPECT_THAT(field(R"("cols":[0,10],"type":"int")"), HasSubstr("/cards/0/fields/0/cols"));
  EXPECT_THAT(field(R"("cols":[91,101],"type":"int")"), HasSubstr("do not lie in 1-100"));
  EXPECT_THAT(field(R"("cols":[1,"x"],"type":"int")"), HasSubstr("/cols/1: expected a whole"));
  EXPECT_THAT(field(R"("cols":[1,10],"type":"integer")"), HasSubstr("is not a field type"));
  EXPECT_THAT(field(R"("cols":[1,10],"type":"id")"), HasSubstr("\"ref\" is required"));
  EXPECT_THAT(field(R"("cols":[1,10],"type":"int","ref":"node")"), HasSubstr("\"ref\""));
  EXPECT_THAT(field(R"("cols":[1,2],"type":"flag")"), HasSubstr("exactly one column"));
  EXPECT_THAT(field(R"("cols":[1,9],"type":"int","dim":[0,1,0])"), HasSubstr("only real fields"));
  EXPECT_THAT(field(R"("cols":[1,9],"type":"real","dim":[0,1])"), HasSubstr("exponents"));
  EXPECT_THAT(field(R"("cols":[1,9],"type":"real","values":[1])"), HasSubstr("only integer"));
  EXPECT_THAT(field(R"("cols":[1,9],"type":"text","values":[1])"), HasSubstr("only integer"));
  EXPECT_EQ(field(R"("cols":[1,9],"type":"int","values":[1])"), "accepted");
  EXPECT_EQ(field(R"("cols":[1,1],"type":"flag","values":[1])"), "accepted");
  EXPECT_EQ(field(R"("cols":[1,9],"type":"id","ref":"node","values":[1])"), "accepted");
  EXPECT_THAT(field(R"("cols":[1,9],"type":"real","min":2,"max":1)"), HasSubstr("above max"));
  EXPECT_THAT(field(R"("cols":[1,9],"type":"real","min_open":true)"), HasSubstr("open bound"));
  EXPECT_THAT(field(R"("cols":[1,9],"type":"int","versions":[90])"), HasSubstr("from, until"));
  EXPECT_THAT(field(R"("cols":[1,9],"type":"int","versions":[110,100])"), HasSubstr("empty"));
}

TEST(SchemaLoader, TakesTheNumberOfADefaultOnce) {
  const auto error = [](const std::string& body) {
    return error_of(with_cards(R"({"name":"c","fields":[{"name":"f","cols":[1,9],"type":"int",)" +
                               body + "}]}"));
  };
  EXPECT_EQ(error(R"x("default":"0 (none)","default_value":0)x"), "accepted");
  EXPECT_THAT(error(R"("default":"3","default_value":3)"), HasSubstr("this number already"));
  EXPECT_THAT(error(R"("default_varies":"sometimes")"), HasSubstr("not deck, model or fields"));
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

TEST(SchemaLoader, RefusesConditionsOnUnknownOrLaterFields) {
  const std::string flag = R"({"name":"a","fields":[{"name":"f","cols":[1,10],"type":"int"}]})";
  const std::string late = R"({"name":"b","when":[{"field":"f","in":[1]}],"blank":true})";
  EXPECT_EQ(error_of(with_cards(flag + "," + late)), "accepted");
  EXPECT_THAT(error_of(with_cards(late + "," + flag)), HasSubstr("no earlier card"));
  EXPECT_THAT(error_of(with_cards(late)), HasSubstr("integer field \"f\""));
  const std::string newer =
      R"({"name":"a","fields":[{"name":"f","cols":[1,10],"type":"int","versions":[120,null]}]})";
  EXPECT_THAT(error_of(with_cards(newer + "," + late)), HasSubstr("in version 51"));
  const std::string real = R"({"name":"a","fields":[{"name":"f","cols":[1,10],"type":"real"}]})";
  EXPECT_THAT(error_of(with_cards(real + "," + late)), HasSubstr("integer field \"f\""));
  const std::string nothing = R"({"name":"b","when":[{"field":"f"}],"blank":true})";
  EXPECT_THAT(error_of(with_cards(flag + "," + nothing)), HasSubstr("tests nothing"));
  const std::string more = R"({"name":"b","when":[{"field":"f","in":[1],"on":[2]}],"blank":true})";
  EXPECT_THAT(error_of(with_cards(flag + "," + more)), HasSubstr("/cards/1/when/0"));
}

TEST(SchemaLoader, RefusesAmbiguousNamesAndMisplacedRepetition) {
  const std::string one = R"({"name":"a","fields":[{"name":"f","cols":[1,10],"type":"int"}]})";
  EXPECT_THAT(error_of(with_cards(one + "," + one)), HasSubstr("already used by card 0"));
  const std::string ids =
      R"({"name":"i","repeat":"ids","fields":[{"name":"i","cols":[1,10],"type":"int"}]})";
  EXPECT_EQ(error_of(with_cards(one + "," + ids)), "accepted");
  EXPECT_THAT(error_of(with_cards(ids + "," + one)), HasSubstr("nothing can follow card 0"));
  EXPECT_THAT(error_of(with_cards(R"({"name":"i","repeat":"ids","blank":true})")),
              HasSubstr("exactly one field"));
  EXPECT_THAT(error_of(with_cards(R"({"name":"i","repeat":"often","blank":true})")),
              HasSubstr("is not rows, ids, words or group"));
}

TEST(SchemaLoader, ABlankLineHasNoFieldsAndALineWithoutFieldsIsBlank) {
  EXPECT_EQ(error_of(with_cards(R"({"name":"b","blank":true})")), "accepted");
  EXPECT_THAT(error_of(with_cards(R"({"name":"b","fields":[]})")), HasSubstr("\"blank\""));
  EXPECT_THAT(error_of(with_cards(R"({"name":"b","blank":true,"fields":[]})")),
              HasSubstr("a blank line has no fields"));
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
  EXPECT_EQ(error_of(fields(id + R"("axes":[{"scale":"s"},{"dim":[0,1,0]}]})")), "accepted");
  EXPECT_THAT(error_of(fields(id + R"("axes":[{"scale":"n"},{}]})")),
              HasSubstr("no card has a real field \"n\""));
  EXPECT_THAT(error_of(fields(id + R"("axes":[{}]})")), HasSubstr("the ordinate last"));
  EXPECT_THAT(error_of(fields(id + R"("dim_unknown":true,"axes":[{},{}]})")),
              HasSubstr("exclude each other"));
  EXPECT_THAT(error_of(fields(real + R"("axes":[{},{}]})")), HasSubstr("only ids of functions"));
  EXPECT_THAT(error_of(fields(real + R"("over":{"field":"x"}})")), HasSubstr("real field \"x\""));
  EXPECT_THAT(error_of(fields(real + R"("unit_for":["x"]})")), HasSubstr("field \"x\""));
  const std::string when =
      R"("dim_when":[{"when":[{"field":"Dir","words":["X"]}],"dim":[0,1,0]}]})";
  EXPECT_EQ(error_of(fields(real + when)), "accepted");
  EXPECT_THAT(error_of(fields(real + R"("when":[{"field":"Dir","words":["X"]}]})")),
              HasSubstr("words are tested by dimensions only"));
}

TEST(SchemaLoader, TheSameKeywordTwiceInOneFileIsAnError) {
  EXPECT_THAT(error_of(R"({"schemas":[{"keyword":"/A"},{"keyword":"/A"}]})"),
              HasSubstr("/A of /A already names /A"));
  EXPECT_THAT(error_of(R"({"keyword":"/A","aliases":["/A"]})"), HasSubstr("already names"));
}

class SchemaDirectory : public ::testing::Test {
 protected:
  void SetUp() override {
    dir_ = std::filesystem::path(::testing::TempDir()) /
           ("deck_schemas_" +
            std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(dir_);
    std::filesystem::create_directories(dir_);
  }
  void TearDown() override { std::filesystem::remove_all(dir_); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(dir_ / name) << text;
  }
  std::filesystem::path dir_;
};

TEST_F(SchemaDirectory, FilesAreReadInNameOrder) {
  write("b.json", R"({"keyword":"/A","doc":"second"})");
  write("a.json", R"({"keyword":"/A","doc":"first"})");
  write("c.txt", "not a schema");
  SchemaSet set;
  const auto added = set.add_directory(dir_.string());
  ASSERT_TRUE(added) << added.error().message;
  EXPECT_EQ(set.find("/A")->doc, "second");
}

TEST_F(SchemaDirectory, ErrorsNameTheFile) {
  write("wrong.json", R"({"keyword":"/A","cards":7})");
  SchemaSet set;
  const auto added = set.add_directory(dir_.string());
  ASSERT_FALSE(added);
  EXPECT_THAT(added.error().message, HasSubstr("wrong.json: /cards: expected a list"));
  EXPECT_EQ(added.error().code, Error::Code::config);
}

/// Each row of a list has a flag of its own that says what its value is.
TEST_F(SchemaDirectory, TheRowOfAValueDecidesOnItsUnit) {
  write("hose.json", R"({"keyword": "/HOSE", "kind": "other", "title": false, "cards": [
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

TEST_F(SchemaDirectory, AMissingDirectoryIsAnIoError) {
  SchemaSet set;
  const auto added = set.add_directory((dir_ / "absent").string());
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().code, Error::Code::io);
  EXPECT_THAT(added.error().message, HasSubstr("absent"));
}

TEST(ConditionTest, ListAndBoundsMustBothHold) {
  Condition condition{
      .field = "f", .words = {}, .in = {1, 2, 9}, .not_in = {}, .min = 2, .max = {}};
  EXPECT_FALSE(condition.holds(1));
  EXPECT_TRUE(condition.holds(2));
  EXPECT_FALSE(condition.holds(3));
  condition.max = 8;
  EXPECT_FALSE(condition.holds(9));
}

}  // namespace
}  // namespace deck
