// What stands at a place of a deck.
#include <gtest/gtest.h>

#include <algorithm>

#include "keyword/reading.hpp"
#include "keyword/shared/place.hpp"

namespace deck {
namespace {

using testing_support::deck_of;
using testing_support::read;
using What = PlacedLine::What;

const std::string body =
    "# above\n"
    "/INTER/TYPE7/3\n"
    "a title\n"
    "# heading\n"
    "         1         2         4\n"
    "/GRNOD/NODE/1\n"
    "nodes\n"
    "         5        60\n"
    "/NODE\n"
    "         5                 1.0                 2.0                 3.0\n"
    "/NOSUCH/KEYWORD\n"
    "some text\n";

PlacedLine at(const Deck& deck, const std::string& text, int column = 1) {
  const BlockIndex index(deck);
  const auto offset = deck.sources[0].bytes().find(text);
  EXPECT_NE(offset, std::string::npos) << text;
  return line_at(deck, index, 0, offset + static_cast<std::uint64_t>(column) - 1);
}

TEST(PlacedLine, SaysWhatALineIsFor) {
  const Deck deck = read(deck_of(body));
  EXPECT_EQ(at(deck, "# above").what, What::comment);
  EXPECT_EQ(at(deck, "/INTER/TYPE7/3").what, What::header);
  EXPECT_EQ(at(deck, "a title").what, What::title);
  EXPECT_EQ(at(deck, "# heading").what, What::comment);
  EXPECT_EQ(at(deck, "         1         2").what, What::card);
  EXPECT_EQ(at(deck, "some text").what, What::opaque);
  EXPECT_EQ(at(deck, "/END").what, What::outside);
}

TEST(PlacedLine, NamesTheCellOfAColumn) {
  const Deck deck = read(deck_of(body));
  const PlacedLine line = at(deck, "         1         2         4", 30);
  ASSERT_NE(line.cell_at(30), nullptr);
  EXPECT_EQ(line.cell_at(30)->field->name, "Istf");
  EXPECT_EQ(line.cell_at(30)->integer, 4);
  EXPECT_EQ(line.cell_at(10)->field->name, "grnd_IDs");
  EXPECT_EQ(line.cell_at(11)->field->name, "surf_IDm");
  // Behind the end of the line there are cells all the same.
  ASSERT_NE(line.cell_at(45), nullptr);
  EXPECT_EQ(line.cell_at(45)->field->name, "Igap");
  EXPECT_TRUE(line.cell_at(45)->blank());
  const PlacedLine list = at(deck, "         5        60");
  ASSERT_NE(list.cell_at(20), nullptr);
  EXPECT_EQ(list.cell_at(20)->integer, 60);
  EXPECT_EQ(columns_of(list.card, *list.cell_at(20)).first, 11);
  const PlacedLine node = at(deck, "         5                 1.0");
  ASSERT_NE(node.cell_at(50), nullptr);
  EXPECT_EQ(node.cell_at(50)->real, 2.0);
}

TEST(PlacedLine, NamesEveryColumnOfTheInterfacesInEveryVersion) {
  for (const char* keyword : {"/INTER/TYPE7", "/INTER/TYPE10", "/INTER/TYPE11", "/INTER/TYPE19",
                              "/DEFAULT/INTER/TYPE7", "/DEFAULT/INTER/TYPE11"})
    for (const int version : {51, 90, 100, 110, 120, 130, 140, 2017, 2018, 2019, 2020, 2021, 2022,
                              2023, 2024, 2025, 2026}) {
      const Schema& schema = *SchemaSet::built_in().find(keyword);
      std::vector<const CardSchema*> cards;
      for (const CardSchema& card : schema.cards)
        if (card.in_version(version) && std::all_of(card.when.begin(), card.when.end(),
                                                    [](const auto& c) { return c.accepts(0); }))
          cards.push_back(&card);
      std::string text = keyword + std::string(schema.has_title ? "/1\ntitle\n" : "\n");
      const std::string full(100, ' ');
      for (std::size_t i = 0; i < cards.size(); ++i) text += full + "\n";
      const Deck deck = read(deck_of(text, std::to_string(version)));
      const BlockIndex index(deck);
      std::size_t offset = deck.sources[0].bytes().find(full);
      for (const CardSchema* card : cards) {
        const PlacedLine line = line_at(deck, index, 0, offset);
        for (int column = 1; column <= 100; ++column) {
          const auto field =
              std::find_if(card->fields.begin(), card->fields.end(), [&](const Field& f) {
                return f.in_version(version) && f.first <= column && column <= f.last;
              });
          const Cell* cell = line.cell_at(column);
          EXPECT_EQ(cell != nullptr ? cell->field : nullptr,
                    field != card->fields.end() ? &*field : nullptr)
              << keyword << " " << version << " " << card->name << " " << column;
        }
        offset += full.size() + 1;
      }
    }
}

TEST(PlacedLine, KnowsWhichLineOfAnElementItIs) {
  const Deck deck =
      read(deck_of("/NODE\n/TETRA10/1\n\n       101\n         1         2         3         4\n"
                   "       102\n         5         6         7         8\n"));
  for (const auto& [text, column, field] : {std::tuple{"       101", 10, "tetra10_ID"},
                                            {"         1         2", 20, "N2"},
                                            {"       102", 10, "tetra10_ID"},
                                            {"         5         6", 10, "N1"}}) {
    const PlacedLine line = at(deck, text);
    EXPECT_EQ(line.what, What::card) << text;
    ASSERT_NE(line.cell_at(column), nullptr) << text;
    EXPECT_EQ(line.cell_at(column)->field->name, field) << text;
  }
}

using PlacedLineOnDisk = testing_support::Folder;

TEST_F(PlacedLineOnDisk, ADirectiveGoesOnOverItsLines) {
  file("a_longname.inc", "/GRNOD/NODE/1\ng\n         7\n");
  const Deck deck = read_file(file("d_0000.rad", deck_of("/NODE\n#include a_long +\n  name.inc\n"
                                                         "/GRNOD/NODE/2\ng\n         5\n")));
  ASSERT_EQ(deck.includes.size(), 1u);
  EXPECT_EQ(at(deck, "/NODE").what, What::header);
  EXPECT_EQ(at(deck, "#include a_long").what, What::directive);
  EXPECT_EQ(at(deck, "  name.inc").what, What::directive);
  EXPECT_EQ(at(deck, "/GRNOD/NODE/2").what, What::header);
  EXPECT_EQ(at(deck, "         5").what, What::card);
}

TEST(PlacedLine, FindsSomethingAtEveryPlaceOfADamagedDeck) {
  const std::string text = deck_of(body).substr(0, 300) + "\n/\n/INTER\n/INTER/TYPE7/\n,,,\n\t\n/";
  const Deck deck = read(text);
  const BlockIndex index(deck);
  for (std::uint64_t offset = 0; offset <= text.size(); ++offset) {
    const PlacedLine line = line_at(deck, index, 0, offset);
    for (int column = 0; column < 120; ++column) {
      const Cell* cell = line.cell_at(column);
      EXPECT_TRUE(cell == nullptr || cell->field != nullptr);
    }
  }
}

}  // namespace
}  // namespace deck
