// Deck -> JSON -> deck gives the same bytes; a value changed in the JSON lands in its columns.
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

TEST(DeckJson, SeveralDecksAreOneDocument) {
  const std::string one = json_of(small);
  EXPECT_EQ(decks_to_json({one}), one);
  const Json both = Json::parse(decks_to_json({one, one}));
  EXPECT_EQ(both["schema"]["id"], "deck/deck");
  EXPECT_EQ(both["decks"].size(), 2u);
  EXPECT_EQ(both["decks"][1], Json::parse(one));
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

}  // namespace
}  // namespace deck::test
