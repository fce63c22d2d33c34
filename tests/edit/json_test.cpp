// A deck as JSON: every line with its text, and its values by name.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "edit/version_support.hpp"
#include "keyword/shared/deck_json_cells.hpp"
#include "report/shared/deck_json.hpp"
#include "where.hpp"

namespace deck::test {
namespace {

using Json = nlohmann::json;

std::string to_json(const Whole& o) {
  auto json = deck_to_json({o.deck.sources[0].path(), &o.deck, &o.model, &o.interfaces});
  EXPECT_TRUE(json.ok()) << (json ? "" : json.error().message);
  return json ? *json : "";
}

std::string json_of(const std::string& text) { return to_json(*open_text(text)); }

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

/// The files of the tree, put together from the text of every line.
std::multiset<std::string> texts_of(const Json& document) {
  std::multiset<std::string> out;
  for (const Json& file : document["files"]) {
    const std::string end = file["line_end"];
    std::string text;
    const auto add = [&](const Json& line) {
      const Json& it = line.is_array() ? line[0] : line.is_object() ? line["text"] : line;
      text += it.get<std::string>() + end;
    };
    for (const Json& item : file["items"]) {
      if (item.contains("header")) add(item["header"]);
      for (const char* list : {"lines", "rows"})
        if (item.contains(list)) std::for_each(item[list].begin(), item[list].end(), add);
    }
    if (!file["final_newline"] && !text.empty()) text.resize(text.size() - end.size());
    out.insert(text);
  }
  return out;
}

void expect_every_line(const Whole& o, const std::string& what) {
  std::multiset<std::string> files;
  std::set<std::string> seen;
  for (std::uint32_t f = 0; f < o.deck.sources.size(); ++f)
    if (seen.insert(o.deck.sources[f].path()).second)
      files.insert(detail::is_utf8(bytes_of(o, f)) ? bytes_of(o, f)
                                                   : detail::latin1_to_utf8(bytes_of(o, f)));
  EXPECT_TRUE(texts_of(Json::parse(to_json(o))) == files) << what;
}

TEST(DeckJson, HasEveryLineOfEverySample) {
  for (const std::string& path : sample_decks()) expect_every_line(Whole(path), path);
}

TEST(DeckJson, HasEveryKindOfLineEndAndByte) {
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
    expect_every_line(*open_text(text), text);
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

TEST(DeckJson, SeveralDecksAreOneDocument) {
  const std::string one = json_of(small);
  EXPECT_EQ(decks_to_json({one}), one);
  const Json both = Json::parse(decks_to_json({one, one}));
  EXPECT_EQ(both["schema"]["id"], "deck/deck");
  EXPECT_EQ(both["decks"].size(), 2u);
  EXPECT_EQ(both["decks"][1], Json::parse(one));
}

}  // namespace
}  // namespace deck::test
