// Deck -> JSON -> deck gives the same bytes; a value changed in the JSON lands in its columns.
// Over 600 lines: independent tests of one format.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <tuple>

#include "edit/shared/from_json.hpp"
#include "edit/version_support.hpp"
#include "report/shared/deck_json.hpp"
#include "where.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

std::string to_json(const Whole& o) {
  auto json = deck_to_json({o.deck.sources[0].path(), &o.deck, &o.model, &o.interfaces});
  EXPECT_TRUE(json.ok()) << (json ? "" : json.error().message);
  return json ? *json : "";
}

std::string json_of(const std::string& text) { return to_json(*open_text(text)); }

std::vector<DeckFile> from_json(const std::string& json) {
  auto files = deck_from_json(json, SchemaSet::built_in());
  EXPECT_TRUE(files.ok()) << (files ? "" : files.error().message);
  return files ? *files : std::vector<DeckFile>{};
}

std::string error_of(const std::string& json) {
  const auto files = deck_from_json(json, SchemaSet::built_in());
  EXPECT_FALSE(files.ok());
  return files ? "" : files.error().message;
}

/// Main file written from a document.
std::string main_of(const Json& document) {
  const auto files = from_json(document.dump());
  return files.empty() ? "" : files[0].text;
}

/// The first line of a document that has a field of that name.
Json& line_with(Json& document, const std::string& field) {
  for (Json& item : document["files"][0]["items"])
    if (item.contains("lines"))
      for (Json& line : item["lines"])
        if (line.is_object() && line.contains("fields") && line["fields"].contains(field))
          return line;
  throw std::runtime_error("no line with " + field);
}

Json& block_of(Json& document, const std::string& keyword) {
  for (Json& item : document["files"][0]["items"])
    if (item.value("keyword", "") == keyword) return item;
  throw std::runtime_error("no block " + keyword);
}

const std::string small =
    deck_of_version(2022,
                    "# a comment\n/NODE\n#  id\n         1                 0.0                  1."
                    "                  2.\n         2  1.5-3 2.D0 text\n"
                    "/SURF/PART/7\nsurface\n         1         2         3\n         4\n"
                    "/INTER/TYPE7/3\n  upper on lower  \n"
                    "# ids\n         0         7         4\n\n\n"
                    "# stfac                              gapmin\n"
                    "                 1.0                 0.1                0.75\n"
                    "       110                             6\n\n/UNKNOWN/9\nanything, at all\n");

/// Bytes of every file, by the place that the document gives it.
void expect_same_bytes(const Whole& o, const std::string& what) {
  const std::string json = to_json(o);
  const auto files = from_json(json);
  ASSERT_FALSE(files.empty()) << what;
  EXPECT_EQ(files[0].text, o.deck.sources[0].bytes()) << what;
  Files contents;
  for (const DeckFile& f : files) contents[f.path] = f.text;
  std::multiset<std::string> written, original;
  for (const auto& f : files) written.insert(f.text);
  std::set<std::string> seen;
  for (std::uint32_t f = 0; f < o.deck.sources.size(); ++f)
    if (seen.insert(o.deck.sources[f].path()).second) original.insert(bytes_of(o, f));
  EXPECT_TRUE(written == original) << what;
  // Written under its own names it is a fixed point.
  const Whole again(files[0].path, contents);
  const std::string second = to_json(again);
  const auto files_again = from_json(second);
  ASSERT_EQ(files_again.size(), files.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_EQ(files_again[i].path, files[i].path);
    EXPECT_EQ(files_again[i].text, files[i].text) << what;
  }
  Json a = Json::parse(json), b = Json::parse(second);
  EXPECT_EQ(a["files"], b["files"]) << what;
}

TEST(DeckJson, EverySampleComesBackByteForByte) {
  for (const std::string& path : sample_decks()) expect_same_bytes(Whole(path), path);
}

TEST(DeckJson, CorpusComesBackByteForByte) {
  const std::filesystem::path corpus = test::shared_dir();
  if (!std::filesystem::exists(corpus / "corpus")) GTEST_SKIP() << "no corpus at " << corpus;
  for (const auto& e : std::filesystem::recursive_directory_iterator(corpus / "corpus"))
    if (e.path().string().ends_with("_0000.rad") && e.file_size() < 1'000'000)
      expect_same_bytes(Whole(e.path().string()), e.path().string());
}

TEST(DeckJson, EveryKindOfLineEndAndByteSurvives) {
  const std::string twice = "/PART/1\np\n         1         1\n";
  for (const std::string& text :
       {std::string("#RADIOSS STARTER\r\n/BEGIN\r\nrun\r\n      2022\r\n"),
        std::string("#RADIOSS STARTER\r\n/BEGIN\nrun\r\n      2022\n/PART/1\r\np \r\n 1 \t 1\r\n"),
        deck_of_version(2022, twice) + "after the end\n\n\n",
        deck_of_version(2022, twice) + "no final line feed",
        std::string("text first\n  /BEGIN  \nrun\n      2022\n   /PART/1/2  \np\n"),
        deck_of_version(2022, "/PART/1\nStahl f\xfcr T\xfcren\n         1         1\n"),
        deck_of_version(2022, "/PART/1\nT\xc3\xbcr \x7f\n         1         1\n"),
        deck_of_version(2022, std::string("/PART/1\nnul \0 byte\n  1  1\n", 27)),
        deck_of_version(2022,
                        "/NODE\n1,1.,2.,3.\n,,\n\n# c\n      abc     nan  1e999  99999999999\n"),
        deck_of_version(2022, "/SURF/PART/1\n# before the title\nt\n# c\n         1,2,3\n")})
    expect_same_bytes(*open_text(text), text);
}

TEST(DeckJson, RandomTextComesBackByteForByte) {
  std::mt19937 random(5);
  const std::vector<std::string> pieces = {"/PART/1\n",
                                           "/INTER/TYPE7/&x\n",
                                           "/NODE\n",
                                           "#c\n",
                                           "\n",
                                           "         1         2       3.5\n",
                                           "1,2,,\n",
                                           "t\t\r\n",
                                           "/END\n",
                                           "\xff\xfe\n",
                                           "$\r\n",
                                           "/SH",
                                           "ELL/1\n",
                                           "x",
                                           "#include no\n",
                                           "/INTER/TYPE19/2\n",
                                           "&p\n",
                                           "//ENDSUB\n"};
  for (int round = 0; round < 300; ++round) {
    std::string text = "#RADIOSS STARTER\n/BEGIN\nrun\n      2022\n";
    const int n = static_cast<int>(random() % 30);
    for (int i = 0; i < n; ++i) text += pieces[random() % pieces.size()];
    expect_same_bytes(*open_text(text), text);
    if (HasFailure()) return;
  }
}

TEST(DeckJson, FieldsHaveNamesTypesAndColumns) {
  Json doc = Json::parse(json_of(small));
  EXPECT_EQ(doc["schema"]["id"], "deck/deck");
  Json& line = line_with(doc, "Gapmin");
  EXPECT_EQ(line["fields"]["Gapmin"], 0.75);
  EXPECT_TRUE(line["fields"]["Tstop"].is_null());
  EXPECT_EQ(line["columns"]["Gapmin"], Json::parse("[41, 60]"));
  EXPECT_EQ(line["line"], 23);
  const Json& rows = block_of(doc, "/NODE")["rows"];
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0], "#  id");
  EXPECT_EQ(rows[1][3], 1.0);
  const Json& ids = block_of(doc, "/SURF/PART")["rows"];
  EXPECT_EQ(ids[0][3], 3);
  EXPECT_EQ(ids[1][1], 4);
  EXPECT_EQ(block_of(doc, "/UNKNOWN")["lines"][0], "anything, at all");
}

TEST(DeckJson, InterfacesCarryEffectiveValuesAndTheirOrigin) {
  Json doc = Json::parse(json_of(small));
  const Json& effective = block_of(doc, "/INTER/TYPE7")["effective"];
  EXPECT_EQ(effective["Istf"]["value"], 4);
  EXPECT_EQ(effective["Istf"]["origin"], "card");
  EXPECT_EQ(effective["Iform"]["value"], 1);
  EXPECT_EQ(effective["Iform"]["origin"], "built-in");
  EXPECT_TRUE(effective["Iform"]["input"].is_null());
  EXPECT_EQ(effective["Gapmin"]["source"]["line"], 23);
  EXPECT_EQ(effective["Gapmin"]["source"]["column"], 41);
}

TEST(DeckFromJson, ChangedValueIsPrintedIntoItsColumnsOnly) {
  Json doc = Json::parse(json_of(small));
  line_with(doc, "Gapmin")["fields"]["Gapmin"] = 1.25;
  std::string expected = small;
  expected.replace(expected.find("0.75"), 4, "1.25");
  EXPECT_EQ(main_of(doc), expected);
}

TEST(DeckFromJson, NullBlanksACellAndAValueFillsABlankOne) {
  Json doc = Json::parse(json_of(small));
  Json& line = line_with(doc, "Gapmin");
  line["fields"]["Fric"] = nullptr;
  line["fields"]["Tstop"] = 5;
  const std::string text = main_of(doc);
  EXPECT_THAT(text, HasSubstr("\n                 1.0                                    0.75"
                              "                                      5.\n"));
}

TEST(DeckFromJson, RowsOfNodesAndIdsCanBeChangedAndAdded) {
  Json doc = Json::parse(json_of(small));
  Json& nodes = block_of(doc, "/NODE")["rows"];
  nodes[1][4] = 2.5;
  nodes.push_back(Json::parse("[null, 3, 0.5, 0.25, -1.0]"));
  Json& ids = block_of(doc, "/SURF/PART")["rows"];
  ids[0][1] = 11;
  ids[1].push_back(5);
  const auto deck = open_text(main_of(doc));
  ASSERT_EQ(deck->model.nodes.size(), 3u);
  EXPECT_EQ(deck->model.nodes.z[0], 2.5);
  EXPECT_EQ(deck->model.nodes.id[2], 3);
  EXPECT_EQ(deck->model.nodes.z[2], -1);
  EXPECT_THAT(bytes_of(*deck), HasSubstr("        11         2         3\n         4         5\n"));
}

TEST(DeckFromJson, CellsOfACountedListKeepTheirBytes) {
  const std::string text =
      "#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n"
      "                  kg                  mm                  ms\n"
      "                  kg                  mm                  ms\n"
      "/MAT/LAW62/11\nfoam\n               5e-11                   0\n"
      "                   0         2         0                   0         0         0\n"
      "                .015                .005\n                   2                  -2\n"
      "                   0                   0\n/END\n";
  EXPECT_EQ(main_of(Json::parse(json_of(text))), text);
}

TEST(DeckFromJson, WhatStandsBehindACountedListKeepsItsBytes) {
  // Two values are counted, the third is not read; so with one that leaves its cell.
  for (const char* tail : {"                   7", "7"}) {
    const std::string text = deck_of_version(
        2022,
        "/MAT/LAW62/11\nfoam\n               5e-11                   0\n"
        "                   0         2         0                   0         0         0\n"
        "                .015                .005" +
            std::string(tail) +
            "\n                   2                  -2\n"
            "                   0                   0\n");
    EXPECT_EQ(main_of(Json::parse(json_of(text))), text);
  }
}

TEST(DeckFromJson, ACountedListWithCommasKeepsWhatStandsBehindIt) {
  const std::string text = deck_of_version(
      2022,
      "/MAT/LAW62/11\nfoam\n               5e-11                   0\n"
      "                   0         2         0                   0         0         0\n"
      ".015,.005,7\n                   2                  -2\n"
      "                   0                   0\n");
  EXPECT_EQ(main_of(Json::parse(json_of(text))), text);
}

TEST(DeckFromJson, CommasBetweenCellsThatAFlagChoosesKeepTheirBytes) {
  // The seventh line has other cells where Iform is 1.
  const std::string text = deck_of_version(
      2022,
      "/MAT/LAW25/1\nlayers\n               1e-06\n                  6.                  7.\n"
      "                  1.\n                  1.\n                  1.\n                  2.\n"
      "1.,2.,3.,4.,5.\n                  1.                  1.                  2.\n");
  const std::string json = json_of(text);
  EXPECT_THAT(json, HasSubstr("EPS_t1"));
  EXPECT_EQ(main_of(Json::parse(json)), text);
}

TEST(DeckFromJson, TitleIdAndReferencesCanBeChanged) {
  Json doc = Json::parse(json_of(small));
  Json& block = block_of(doc, "/INTER/TYPE7");
  block["id"] = 77;
  block["lines"][0]["title"] = "new title";
  line_with(doc, "Gapmin")["fields"]["Gapmin"] = "&gap";
  const std::string text = main_of(doc);
  EXPECT_THAT(text, HasSubstr("/INTER/TYPE7/77\nnew title\n"));
  EXPECT_THAT(text, HasSubstr("&gap"));
}

TEST(DeckFromJson, AKeywordLineKeepsItsCommentAndAnIdOfZero) {
  std::string deck(small);
  const auto at = deck.find("/INTER/TYPE7/");
  deck.replace(at, deck.find('\n', at) - at, "/INTER/TYPE7/0   # first");
  Json doc = Json::parse(json_of(deck));
  EXPECT_EQ(main_of(doc), deck);
  block_of(doc, "/INTER/TYPE7")["id"] = 5;
  EXPECT_THAT(main_of(doc), HasSubstr("/INTER/TYPE7/5   # first\n"));
}

TEST(DeckFromJson, AListBelowAKeywordLineWithACommentAndNoIdIsReadBack) {
  const std::string text = deck_of_version(2022, "/SURF/PART   # which\ns\n         1\n");
  EXPECT_EQ(main_of(Json::parse(json_of(text))), text);
}

TEST(DeckFromJson, TheIdOfAnIndentedHeaderIsReplacedInItsPlace) {
  Json doc = Json::parse(json_of(deck_of_version(2022, "  /GRNOD/NODE/7/3   \ng\n         1\n")));
  block_of(doc, "/GRNOD/NODE")["id"] = 4711;
  EXPECT_THAT(main_of(doc), HasSubstr("\n  /GRNOD/NODE/4711/3   \ng\n"));
}

TEST(DeckFromJson, LinesWithoutTextAreMadeOfTheirValues) {
  const Json doc =
      Json::parse(R"({"schema":{"id":"deck/deck","version":1},"files":[{"path":"a_0000.rad",
    "items":[{"kind":"text","lines":["#RADIOSS STARTER"]},
      {"kind":"block","keyword":"/BEGIN","lines":[{"card":"run name","fields":{"run_name":"r"}},
        {"card":"version","fields":{"Invers":2022}}]},
      {"kind":"block","keyword":"/INTER/TYPE11","id":4,"version":2022,"lines":[
        {"title":"edges"},
        {"card":"sides and flags","fields":{"line_IDs":1,"line_IDm":2,"Inacti":null}},
        {"card":"stiffness bounds, mesh size, formulation","fields":{"dtmin":1e-6}}],
       "missing":["stiffness, friction, gap, times",
        "release flags, damping, sorting","friction reference"]}]}]})");
  const auto files = deck_from_json(doc.dump(), SchemaSet::built_in());
  ASSERT_FALSE(files.ok());
  EXPECT_THAT(files.error().message, HasSubstr("no field \"Inacti\""));
  Json good = doc;
  good["files"][0]["items"][2]["lines"][1]["fields"].erase("Inacti");
  EXPECT_EQ(
      main_of(good),
      "#RADIOSS STARTER\n/BEGIN\nr\n      2022\n/INTER/TYPE11/4\nedges\n         1         2\n" +
          std::string(76, ' ') + "1e-6\n");
}

TEST(DeckFromJson, FreeFormatCellsAreReplacedWhereTheyStand) {
  Json doc = Json::parse(json_of(deck_of_version(2022, "/NODE\n 1, 0.5,2., 3.\n 2,,1.,\n")));
  Json& rows = block_of(doc, "/NODE")["rows"];
  rows[0][2] = 0.125;
  rows[1][2] = 7.0;
  EXPECT_EQ(main_of(doc), deck_of_version(2022, "/NODE\n 1, 0.125,2., 3.\n 2,7.,1.,\n"));
  rows[1][4] = 7.0;
  EXPECT_THAT(error_of(doc.dump()), HasSubstr("/files/0/items/"));
}

TEST(DeckFromJson, ValuesThatDoNotFitAreErrorsWithTheirPlace) {
  const Json good = Json::parse(json_of(small));
  const auto with = [&](const std::string& field, const Json& value) {
    Json doc = good;
    line_with(doc, field)["fields"][field] = value;
    return error_of(doc.dump());
  };
  EXPECT_THAT(with("Istf", 5000000000LL), HasSubstr("/fields/Istf: "));
  EXPECT_THAT(with("Istf", 12345678901LL), HasSubstr("/fields/Istf: "));
  EXPECT_THAT(with("Istf", 1.5), HasSubstr("expected an integer"));
  EXPECT_THAT(with("Istf", "four"), HasSubstr("expected a number"));
  EXPECT_THAT(with("Gapmin", -0.12345678901234567e-200), HasSubstr("without rounding"));
  EXPECT_THAT(with("Gapmin", Json::array()), HasSubstr("expected a number"));
  EXPECT_THAT(with("IBCX", 12), HasSubstr("does not fit"));
}

TEST(DeckFromJson, VersionIsNotChangedBesideTheColumns) {
  Json doc = Json::parse(json_of(small));
  line_with(doc, "Invers")["fields"]["Invers"] = 2018;
  EXPECT_THAT(error_of(doc.dump()), HasSubstr("--version"));
}

TEST(DeckFromJson, RandomEditsOfOneValueTouchTheirColumnsAndReadBack) {
  std::mt19937 random(3);
  int edits = 0;
  for (const std::string& path : sample_decks()) {
    const Whole before(path);
    const Json original = Json::parse(to_json(before));
    // Every real value of a card as (item, line, field).
    std::vector<std::tuple<std::size_t, std::size_t, std::string>> places;
    const Json& items = original["files"][0]["items"];
    for (std::size_t i = 0; i < items.size(); ++i)
      if (items[i].contains("lines"))
        for (std::size_t l = 0; l < items[i]["lines"].size(); ++l) {
          const Json& line = items[i]["lines"][l];
          if (!line.is_object() || !line.contains("fields")) continue;
          for (const auto& f : line["fields"].items())
            if (f.value().is_number_float()) places.emplace_back(i, l, f.key());
        }
    for (int round = 0; round < 5 && !places.empty(); ++round) {
      const auto [i, l, field] = places[random() % places.size()];
      Json doc = original;
      const double value =
          std::ldexp(1.0 + static_cast<double>(random() % 1000), -static_cast<int>(random() % 8));
      Json& line = doc["files"][0]["items"][i]["lines"][l];
      line["fields"][field] = value;
      const auto files = from_json(doc.dump());
      ASSERT_FALSE(files.empty());
      const std::string old_text = bytes_of(before);
      const std::string& new_text = files[0].text;
      // The same number of lines, and only one differs, inside the cell.
      std::istringstream a(old_text), b(new_text);
      std::string la, lb;
      int differing = 0;
      while (std::getline(a, la) && std::getline(b, lb)) {
        if (la == lb) continue;
        ++differing;
        const auto first = line["columns"][field][0].get<std::size_t>() - 1;
        const auto last = line["columns"][field][1].get<std::size_t>();
        lb.resize(std::max(la.size(), lb.size()), ' ');
        la.resize(lb.size(), ' ');
        EXPECT_EQ(la.substr(0, first), lb.substr(0, first)) << path << " " << field;
        EXPECT_EQ(la.substr(std::min(last, la.size())), lb.substr(std::min(last, lb.size())));
      }
      EXPECT_LE(differing, 1);
      EXPECT_EQ(std::count(old_text.begin(), old_text.end(), '\n'),
                std::count(new_text.begin(), new_text.end(), '\n'));
      Files overlay{{path, new_text}};
      const Json again = Json::parse(to_json(Whole(path, overlay)));
      EXPECT_EQ(again["files"][0]["items"][i]["lines"][l]["fields"][field], value) << path;
      ++edits;
    }
  }
  EXPECT_GT(edits, 50);
}

/// What is said about `small` after an edit of its document.
std::string error_after(const std::function<void(Json&)>& edit) {
  Json doc = Json::parse(json_of(small));
  edit(doc);
  return error_of(doc.dump());
}

Json& lines_of(Json& document) { return block_of(document, "/INTER/TYPE7")["lines"]; }

TEST(DeckFromJson, ACardInAnotherPlaceIsRefusedWithTheOrder) {
  const std::string error = error_after([](Json& doc) {
    Json& lines = lines_of(doc);
    std::swap(lines[3], lines[4]);  // the cards "gap" and "stiffness bounds, ..." are blank lines
  });
  EXPECT_THAT(error, HasSubstr("main_0000.rad, /INTER/TYPE7/3, card \"stiffness"));
  EXPECT_THAT(error, HasSubstr("by its place the line is \"gap"));
  EXPECT_THAT(error, HasSubstr("in this order: \"sides and flags\", \"gap"));
}

TEST(DeckFromJson, AMissingCardIsRefusedUnlessTheDocumentSaysSo) {
  EXPECT_THAT(error_after([](Json& doc) { lines_of(doc).erase(3); }), HasSubstr("by its place"));
  const auto without_last = [](Json& doc) {
    Json& lines = lines_of(doc);
    lines.erase(lines.size() - 1);
  };
  EXPECT_THAT(error_after(without_last), HasSubstr("are missing"));
  Json doc = Json::parse(json_of(small));
  const std::string last = lines_of(doc).back()["card"];
  without_last(doc);
  block_of(doc, "/INTER/TYPE7")["missing"] = {last};
  EXPECT_THAT(main_of(doc), HasSubstr("6\n/UNKNOWN/9"));
}

TEST(DeckFromJson, AMissingCardThatIsThereIsRefused) {
  EXPECT_THAT(error_after([](Json& doc) { block_of(doc, "/INTER/TYPE7")["missing"] = {"gap"}; }),
              HasSubstr("ends without are: none"));
}

TEST(DeckFromJson, ADeckThatLacksCardsSaysWhich) {
  const std::string text = deck_of_version(2022, "/INTER/TYPE7/3\nt\n         1         2\n");
  Json doc = Json::parse(json_of(text));
  EXPECT_GE(block_of(doc, "/INTER/TYPE7")["missing"].size(), 4u);
  EXPECT_EQ(main_of(doc), text);
}

TEST(DeckFromJson, UnknownMembersAreRefusedWithTheirPlace) {
  const auto add_to = [](const std::function<Json&(Json&)>& where) {
    return error_after([&](Json& doc) { where(doc)["fieldz"] = 1; });
  };
  EXPECT_THAT(
      add_to([](Json& d) -> Json& { return line_with(d, "Gapmin"); }),
      HasSubstr("/INTER/TYPE7/3, card \"stiffness, friction, gap, times\": unknown member"));
  EXPECT_THAT(add_to([](Json& d) -> Json& { return block_of(d, "/NODE"); }), HasSubstr("unknown"));
  EXPECT_THAT(add_to([](Json& d) -> Json& { return lines_of(d)[0]; }), HasSubstr("unknown"));
  EXPECT_THAT(add_to([](Json& d) -> Json& { return d["files"][0]; }), HasSubstr("unknown"));
  EXPECT_THAT(add_to([](Json& d) -> Json& { return d["files"][0]["items"][0]; }),
              HasSubstr("unknown"));
  EXPECT_THAT(add_to([](Json& d) -> Json& { return d["deck"]; }), HasSubstr("/deck/fieldz"));
  EXPECT_THAT(add_to([](Json& d) -> Json& { return d; }), HasSubstr("/fieldz: unknown"));
}

TEST(DeckFromJson, ATextThatWasChangedMustAgreeWithItsValues) {
  const auto change = [](Json& doc) {
    Json& text = line_with(doc, "Gapmin")["text"];
    std::string line = text;
    text = line.replace(line.find("0.75"), 4, "0.25");
  };
  EXPECT_THAT(error_after(change), HasSubstr("Gapmin: 0.75, but the text says 0.25"));
  Json both = Json::parse(json_of(small));
  change(both);
  line_with(both, "Gapmin")["fields"]["Gapmin"] = 0.25;
  EXPECT_THAT(main_of(both), HasSubstr("                0.25\n"));
  Json alone = Json::parse(json_of(small));
  change(alone);
  line_with(alone, "Gapmin").erase("fields");
  EXPECT_THAT(main_of(alone), HasSubstr("                0.25\n"));
}

TEST(DeckFromJson, TextsOfTitlesHeadersAndRowsMustAgreeToo) {
  EXPECT_THAT(error_after([](Json& doc) { lines_of(doc)[0]["text"] = "other"; }),
              HasSubstr("the text says 'other'"));
  EXPECT_THAT(
      error_after([](Json& doc) { block_of(doc, "/INTER/TYPE7")["header"] = "/INTER/TYPE7/8"; }),
      HasSubstr("3, but the header says 8"));
  EXPECT_THAT(error_after([](Json& doc) {
                Json& text = block_of(doc, "/NODE")["rows"][1][0];
                std::string line = text;
                text = line.replace(line.find("1. "), 2, "7.");
              }),
              HasSubstr("/NODE, row 1, Y: 1, but the text says 7."));
}

TEST(DeckFromJson, AFieldThatIsGoneIsNotTakenForBlank) {
  EXPECT_THAT(error_after([](Json& doc) { line_with(doc, "Gapmin")["fields"].erase("Gapmin"); }),
              HasSubstr("Gapmin: missing, but the line holds 0.75; write null"));
  EXPECT_THAT(error_after([](Json& doc) {
                Json& row = block_of(doc, "/NODE")["rows"][1];
                row.erase(4);
              }),
              HasSubstr("not among the values"));
}

TEST(DeckFromJson, KeywordVersionIdsColumnsAndCardsMustBeThoseOfTheDeck) {
  EXPECT_THAT(
      error_after([](Json& d) { block_of(d, "/INTER/TYPE7")["keyword"] = "/INTER/TYPE11"; }),
      HasSubstr("the keyword line reads as /INTER/TYPE7"));
  EXPECT_THAT(error_after([](Json& d) { block_of(d, "/NODE")["version"] = 2018; }),
              HasSubstr("read as version 2022"));
  EXPECT_THAT(error_after([](Json& d) { block_of(d, "/INTER/TYPE7")["unit_id"] = 4; }),
              HasSubstr("the keyword line says nothing"));
  EXPECT_THAT(error_after([](Json& d) {
                line_with(d, "Gapmin")["columns"]["Gapmin"] = {1, 20};
              }),
              HasSubstr("has the columns 41 to 60"));
  EXPECT_THAT(error_after([](Json& d) { block_of(d, "/NODE")["card"] = "nodes"; }),
              HasSubstr("the card of the rows is \"node\""));
  EXPECT_THAT(error_after([](Json& d) { block_of(d, "/NODE")["fields"][1] = "Y"; }),
              HasSubstr("the values of a row are \"node_ID\", \"X\""));
}

TEST(DeckFromJson, EffectiveValuesMayBeOldButNotChanged) {
  const auto change = [](Json& doc) {
    block_of(doc, "/INTER/TYPE7")["effective"]["Gapmin"]["value"] = 9.0;
  };
  EXPECT_THAT(error_after(change), HasSubstr("/INTER/TYPE7/3, Gapmin: \"value\" says 9,"));
  // After a change of the card the old ones are still there, or the new ones are.
  Json doc = Json::parse(json_of(small));
  line_with(doc, "Gapmin")["fields"]["Gapmin"] = 9.0;
  const std::string text = main_of(doc);
  EXPECT_THAT(text, HasSubstr("9.\n"));
  change(doc);
  block_of(doc, "/INTER/TYPE7")["effective"]["Gapmin"]["input"] = 9.0;
  EXPECT_EQ(main_of(doc), text);
}

TEST(DeckFromJson, TheHeadOfTheDocumentChangesNothingAndSaysSo) {
  EXPECT_THAT(error_after([](Json& doc) { doc["deck"]["version"] = 2018; }),
              HasSubstr("/deck/version: 2018, but /BEGIN says 2022"));
  EXPECT_THAT(error_after([](Json& doc) { doc["deck"]["title"] = "x"; }), HasSubstr("run name"));
  EXPECT_THAT(error_after([](Json& doc) { doc["deck"]["counts"]["nodes"] = 9; }),
              HasSubstr("/deck: was changed"));
  Json doc = Json::parse(json_of(small));
  doc.erase("deck");
  EXPECT_EQ(main_of(doc), small);
}

TEST(DeckFromJson, ADocumentWithoutSumsIsReadWhereNothingContradicts) {
  Json doc = Json::parse(json_of(small));
  const std::function<void(Json&)> strip = [&](Json& json) {
    for (const char* sum : {"deck_sum", "header_sum", "text_sum", "rows_sum", "effective_sum"})
      if (json.is_object()) json.erase(sum);
    for (Json& inner : json)
      if (inner.is_structured()) strip(inner);
  };
  strip(doc);
  EXPECT_EQ(main_of(doc), small);
  line_with(doc, "Gapmin")["fields"]["Gapmin"] = 9.0;
  EXPECT_THAT(error_of(doc.dump()), HasSubstr("9, but the text says 0.75"));
}

TEST(DeckFromJson, NumbersMayBeSpelledInAnotherWay) {
  // What a tool that knows one kind of numbers makes of the document.
  std::string text = Json::parse(json_of(small)).dump();
  for (std::size_t at = 0; (at = text.find(".0,", at)) != std::string::npos;) text.erase(at, 2);
  EXPECT_EQ(main_of(Json::parse(text)), small);
}

TEST(DeckFromJson, AKeywordAmongTheLinesOfABlockIsRefused) {
  EXPECT_THAT(error_after([](Json& doc) {
                Json& lines = lines_of(doc);
                lines.push_back("/NODE");
              }),
              HasSubstr("is a keyword; write it as an item of its own"));
}

TEST(DeckFromJson, AFileThatNothingIncludesIsRefused) {
  EXPECT_THAT(error_after([](Json& doc) {
                doc["files"].push_back(
                    Json::parse(R"({"path":"x.inc","items":[{"kind":"text","lines":["#"]}]})"));
              }),
              HasSubstr("/files/1/path: no #include of the deck leads to this file"));
}

TEST(DeckFromJson, RoundingIsAskedForAndReported) {
  Json doc = Json::parse(json_of(small));
  line_with(doc, "Gapmin")["fields"]["Gapmin"] = -0.12345678901234567e-200;
  std::vector<LossEntry> losses;
  const auto files = deck_from_json(doc.dump(), SchemaSet::built_in(), {true}, &losses);
  // What is written is not what the document says: but it was asked for.
  ASSERT_TRUE(files.ok()) << files.error().message;
  EXPECT_THAT((*files)[0].text, HasSubstr("-12345678901235e-214\n"));
  ASSERT_EQ(losses.size(), 1u);
  EXPECT_EQ(losses[0].loss, Loss::approximated);
  EXPECT_EQ(losses[0].field, "Gapmin");
  EXPECT_EQ(losses[0].line, 23u);
  EXPECT_EQ(losses[0].id, 3);
}

TEST(DeckJson, SeveralDecksAreOneDocument) {
  const std::string one = json_of(small);
  EXPECT_EQ(decks_to_json({one}), one);
  const Json both = Json::parse(decks_to_json({one, one}));
  EXPECT_EQ(both["schema"]["id"], "deck/deck");
  EXPECT_EQ(both["decks"].size(), 2u);
  EXPECT_EQ(both["decks"][1], Json::parse(one));
}

/// A /MAT/LAW51 of Iform 6: Pext stands in columns 1-20, with other flags in 21-40.
const std::string moving_field =
    "#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n"
    "                  kg                  mm                  ms\n"
    "                  kg                  mm                  ms\n"
    "/MAT/LAW51/4\nexplosive\n\n         6\n"
    "                 0.6                             700.0                 2.0\n/END\n";

TEST(DeckFromJson, AFieldThatMovesWithAFlagStaysInItsColumns) {
  EXPECT_EQ(main_of(Json::parse(json_of(moving_field))), moving_field);
}

TEST(DeckFromJson, AFieldThatMovesWithAFlagIsChangedWhereItsColumnsSay) {
  Json document = Json::parse(json_of(moving_field));
  line_with(document, "Pext")["fields"]["Pext"] = 0.7;
  std::string expected = moving_field;
  expected.replace(expected.find("0.6"), 3, "0.7");
  EXPECT_EQ(main_of(document), expected);
}

TEST(DeckFromJson, AFieldThatMovesWithAFlagNeedsItsColumnsToBeChanged) {
  Json document = Json::parse(json_of(moving_field));
  Json& line = line_with(document, "Pext");
  line.erase("columns");
  EXPECT_EQ(main_of(document), moving_field);
  line["fields"]["Pext"] = 0.7;
  EXPECT_THAT(error_of(document.dump()), HasSubstr("state its \"columns\""));
}

TEST(DeckFromJson, BrokenDocumentsAreErrorsWithAPosition) {
  EXPECT_THAT(error_of(""), HasSubstr("line 1, column 1"));
  EXPECT_THAT(error_of("{\n \"schema\": }"), HasSubstr("line 2, column 12"));
  EXPECT_THAT(error_of("[]"), HasSubstr("expected an object"));
  EXPECT_THAT(error_of(R"({"schema":{"id":"deck/gaps","version":1}})"), HasSubstr("/schema/id"));
  EXPECT_THAT(error_of(R"({"schema":{"id":"deck/deck","version":9}})"),
              HasSubstr("/schema/version"));
  EXPECT_THAT(error_of(R"({"schema":{"id":"deck/deck","version":1},"files":[]})"),
              HasSubstr("/files"));
  EXPECT_THAT(error_of(std::string(100000, '[')), HasSubstr("line 1"));
}

TEST(DeckFromJson, PathsOutOfTheDirectoryAreRefused) {
  for (const char* path : {"/etc/passwd", "../x", "a/../../x", "", ".", "a/"}) {
    Json doc = Json::parse(json_of(small));
    doc["files"][0]["path"] = path;
    EXPECT_THAT(error_of(doc.dump()), HasSubstr("/files/0/path")) << path;
  }
}

TEST(DeckFromJson, LineFeedsInsideALineAreRefused) {
  Json doc = Json::parse(json_of(small));
  line_with(doc, "Gapmin")["text"] = "1.0\n/END";
  EXPECT_THAT(error_of(doc.dump()), HasSubstr("line feed"));
}

TEST(DeckFromJson, MutatedDocumentsNeverCrash) {
  const std::string good = json_of(small);
  std::mt19937 random(11);
  int accepted = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string text = good;
    const int changes = 1 + static_cast<int>(random() % 3);
    for (int i = 0; i < changes; ++i) {
      const std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[at] = static_cast<char>(random() % 256);
          break;
        case 1:
          text.erase(at, random() % 20);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), random() % 30));
      }
    }
    const auto files = deck_from_json(text, SchemaSet::built_in());
    if (files.ok()) ++accepted;
    EXPECT_TRUE(files.ok() || !files.error().message.empty());
  }
  EXPECT_GT(accepted, 0);
}

TEST(DeckFromJson, ValuesOfEveryTypeInEveryPlaceNeverCrash) {
  const Json good = Json::parse(json_of(small));
  const std::vector<Json> odd = {
      nullptr, true, -1, 1e300, "x", Json::array({1}), Json::object(), 18446744073709551615ULL};
  const auto flat = good.flatten();
  std::size_t next = 0;
  for (const auto& [pointer, value] : flat.items()) {
    (void)value;
    for (int i = 0; i < 2; ++i) {
      Json doc = good;
      doc[Json::json_pointer(pointer)] = odd[next++ % odd.size()];
      const auto files = deck_from_json(doc.dump(), SchemaSet::built_in());
      EXPECT_TRUE(files.ok() || !files.error().message.empty());
    }
  }
}

/// What a document answers that `change` made wrong.
std::string answer(const std::function<void(Json&)>& change, const std::string& text = small) {
  Json doc = Json::parse(json_of(text));
  change(doc);
  return error_of(doc.dump());
}
Json& contact_of(Json& doc) { return block_of(doc, "/INTER/TYPE7"); }
Json& first_file(Json& doc) { return doc["files"][0]; }

TEST(DeckFromJson, EveryWrongMemberHasItsReason) {
  using Change = std::function<void(Json&)>;
  const std::pair<Change, const char*> wrong[] = {
      {[](Json& d) { first_file(d)["line_end"] = "x"; }, "expected \"\\n\" or \"\\r\\n\""},
      {[](Json& d) { first_file(d)["encoding"] = "x"; }, "expected \"utf-8\" or \"latin-1\""},
      {[](Json& d) { first_file(d)["final_newline"] = 1; }, "expected true or false, found number"},
      {[](Json& d) { first_file(d)["items"] = 1; }, "expected a list, found number"},
      {[](Json& d) { first_file(d).erase("items"); }, "\"items\" is missing"},
      {[](Json& d) { first_file(d)["path"] = 7; }, "expected a string, found number"},
      {[](Json& d) { first_file(d)["path"] = ""; }, "expected the name of a file"},
      {[](Json& d) { first_file(d)["path"] = "a/."; }, "expected the name of a file"},
      {[](Json& d) { first_file(d)["path"] = "a/../../b"; },
       "not be written under the output directory"},
      {[](Json& d) { first_file(d)["path"] = "/b"; }, "not be written under the output directory"},
      {[](Json& d) { first_file(d)["items"][0]["kind"] = "x"; },
       "expected \"text\", \"include\", \"block\""},
      {[](Json& d) { first_file(d)["items"][0]["lines"][0] = "a\nb"; },
       "a line cannot hold a line feed"},
      {[](Json& d) { contact_of(d)["version"] = 7; }, ": no input version"},
      {[](Json& d) { contact_of(d)["version"] = -1; }, ": no input version"},
      {[](Json& d) { contact_of(d)["version"] = "x"; }, "expected an integer, found string"},
      {[](Json& d) { contact_of(d)["header"] = "INTER"; }, "a keyword line starts with '/'"},
      {[](Json& d) {
         contact_of(d).erase("header");
         contact_of(d)["keyword"] = "INTER";
       },
       "a keyword starts with '/'"},
      {[](Json& d) {
         contact_of(d)["header_sum"] = "0";
         contact_of(d)["id"] = 4;
       },
       "4, but the header says 3; the text was changed by hand"},
      {[](Json& d) { block_of(d, "/NODE")["id"] = 4; },
       "the keyword line has no id; write it there"},
      {[](Json& d) { contact_of(d)["unit_id"] = 5; }, "5, but the keyword line says nothing"},
      {[](Json& d) { contact_of(d)["keyword"] = "/INTER/TYPE10"; },
       "\"/INTER/TYPE10\", but the keyword line reads as /INTER/TYPE7"},
      {[](Json& d) { line_with(d, "Gapmin")["card"] = "x"; },
       "this keyword has no card \"x\" in version 2022"},
      {[](Json& d) { line_with(d, "Gapmin")["fields"] = 1; }, "expected an object, found number"},
      {[](Json& d) { line_with(d, "Gapmin")["fields"]["Gapmax"] = 1.0; },
       "has no field \"Gapmax\" in version 2022"},
      {[](Json& d) { line_with(d, "Gapmin")["fields"].erase("Gapmin"); },
       "missing, but the line holds 0.75; write null to blank it"},
      {[](Json& d) { line_with(d, "Gapmin")["fields"]["Gapmin"] = true; },
       "expected a number, found boolean"},
      {[](Json& d) {
         line_with(d, "Gapmin")["fields"]["Gapmin"] = "&toolongtobeanameofaparameter";
       },
       "does not fit 20 columns"},
      {[](Json& d) { line_with(d, "Gapmin")["columns"] = 1; }, "expected an object"},
      {[](Json& d) {
         line_with(d, "Gapmin")["columns"] = {{"Nothing", {1, 2}}};
       },
       "the line has no such cell"},
      {[](Json& d) {
         line_with(d, "Gapmin")["columns"] = {{"Gapmin", {1, 2}}};
       },
       "[1,2], but the cell has the columns 41 to 60"},
      {[](Json& d) {
         line_with(d, "Gapmin")["text_sum"] = "0";
         line_with(d, "Gapmin")["fields"]["Gapmin"] = 0.5;
       },
       "0.5, but the text says 0.75; the text was changed by hand"},
      {[](Json& d) { contact_of(d)["missing"] = {"x"}; },
       "\"x\", but the cards that the block ends without are"},
      {[](Json& d) { contact_of(d)["card"] = "x"; }, "\"x\", but the card of the rows is none"},
      {[](Json& d) {
         contact_of(d)["rows"] = {Json::array({nullptr, 1})};
       },
       "this keyword is no list of equal lines"},
      {[](Json& d) { block_of(d, "/NODE")["card"] = "x"; },
       "\"x\", but the card of the rows is \""},
      {[](Json& d) { block_of(d, "/NODE")["fields"] = {"x"}; }, "the values of a row are "},
      {[](Json& d) { block_of(d, "/NODE")["rows"][1] = Json::array(); },
       "a row starts with its text, or null"},
      {[](Json& d) { block_of(d, "/NODE")["rows"][1] = {nullptr, 1, 2.0, 3.0, 4.0, 5.0}; },
       "5 values, but a line has 4 cells"},
      {[](Json& d) { block_of(d, "/NODE")["rows"][1].erase(4); },
       "the text says Z = 2., which is not among the values; write null to blank it"},
      {[](Json& d) { block_of(d, "/NODE")["rows"][1] = "/KEYWORD"; },
       "the line is a keyword; write it as an item of its own"},
      {[](Json& d) { d["deck"]["version"] = 7; },
       "7, but /BEGIN says 2022; convert the deck with --version"},
      {[](Json& d) { d["deck"]["title"] = "x"; },
       "\"x\", but /BEGIN says 'run'; change the run name there"},
      {[](Json& d) { d["deck"]["counts"]["nodes"] = 77; }, "only tells what the deck was"},
      {[](Json& d) { contact_of(d)["effective"]["Gapmin"]["value"] = 5.0; },
       "\"value\" says 5, which the cards do not give"},
      {[](Json& d) { contact_of(d)["effective"]["Gapmin"]["input"] = 5.0; },
       "\"input\" says 5, which"},
      {[](Json& d) { contact_of(d)["effective"]["Gapmin"]["origin"] = "x"; },
       "\"origin\" says \"x\", which"},
      {[](Json& d) { contact_of(d)["effective"]["Nothing"] = Json::object(); },
       "the interface has no such parameter"},
      {[](Json& d) { block_of(d, "/NODE")["effective"] = Json::object(); },
       "no interface with effective values"}};
  for (const auto& [change, reason] : wrong) EXPECT_THAT(answer(change), HasSubstr(reason));
}

TEST(DeckFromJson, PlacesNameFileBlockCardAndValue) {
  const auto place = [](const std::function<void(Json&)>& change) { return answer(change); };
  EXPECT_THAT(
      place([](Json& d) { line_with(d, "Gapmin")["fields"]["Gapmin"] = true; }),
      HasSubstr("main_0000.rad, /INTER/TYPE7/3, card \"stiffness, friction, gap, times\", Gapmin"));
  EXPECT_THAT(place([](Json& d) { block_of(d, "/NODE")["rows"][1][2] = true; }),
              HasSubstr("main_0000.rad, /NODE, row 1, X"));
  EXPECT_THAT(place([](Json& d) { contact_of(d)["effective"]["Gapmin"]["value"] = 5.0; }),
              HasSubstr("main_0000.rad, /INTER/TYPE7/3, Gapmin"));
}

TEST(DeckFromJson, RoundingOnRequestIsReportedWithItsLine) {
  Json doc = Json::parse(json_of(small));
  line_with(doc, "Gapmin")["fields"]["Gapmin"] = -0.12345678901234567e-200;
  FromJsonOptions options;
  options.round = true;
  std::vector<LossEntry> losses;
  const auto files = deck_from_json(doc.dump(), SchemaSet::built_in(), options, &losses);
  ASSERT_TRUE(files.ok()) << files.error().message;
  ASSERT_EQ(losses.size(), 1u);
  const LossEntry& l = losses[0];
  EXPECT_EQ(l.loss, Loss::approximated);
  EXPECT_EQ(l.file, "main_0000.rad");
  EXPECT_EQ(l.keyword, "/INTER/TYPE7");
  EXPECT_EQ(l.id, 3);
  EXPECT_EQ(l.field, "Gapmin");
  EXPECT_EQ(l.old_text, "-1.2345678901234568e-201");
  EXPECT_EQ(l.note, "rounded to 20 columns");
  const std::string& text = (*files)[0].text;
  const auto at = text.find(l.new_text);
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(l.line, 1u + static_cast<std::size_t>(std::count(
                             text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')));
}

}  // namespace
}  // namespace deck::test
