// A deck as JSON: every line with its text, and its values by name.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "edit/support.hpp"
#include "keyword/shared/card_forms.hpp"
#include "report/shared/deck_json.hpp"
#include "where.hpp"

namespace deck::test {
namespace {

using Json = nlohmann::json;

std::string bytes_of(const Whole& o, std::uint32_t file) {
  return std::string(o.deck.sources[file].bytes());
}

std::string to_json(const Whole& o) {
  auto json = deck_to_json({o.deck.sources[0].path(), &o.deck, &o.model, &o.interfaces});
  EXPECT_TRUE(json.ok()) << (json ? "" : json.error().message);
  return json ? *json : "";
}

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
  for (const std::string title : {"T\xc3\xbcr", "T\xfcr"}) {  // UTF-8, Latin-1
    const auto deck = open_text(deck_of_version(2022, "/PART/1\n" + title + "\n         1\n"));
    EXPECT_NE(to_json(*deck).find("T\xc3\xbcr"), std::string::npos) << title;
  }
}

TEST(DeckJson, SeveralDecksAreOneDocument) {
  const std::string one = to_json(*open_text(deck_of_version(2022, "/TITLE\nt\n")));
  EXPECT_EQ(decks_to_json({one}), one);
  const Json both = Json::parse(decks_to_json({one, one}));
  EXPECT_EQ(both["schema"]["id"], "deck/deck");
  EXPECT_EQ(both["decks"].size(), 2u);
  EXPECT_EQ(both["decks"][1], Json::parse(one));
}

}  // namespace
}  // namespace deck::test
