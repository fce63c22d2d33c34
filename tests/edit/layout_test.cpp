// Cards laid out by their schema.
#include <gtest/gtest.h>

#include "edit/shared/layout.hpp"
#include "keyword/reading.hpp"

namespace deck {
namespace {

using testing_support::deck_of;
using testing_support::read;

std::string changed(const Deck& deck, std::vector<TextEdit> edits) {
  const auto text = apply_edits(deck.sources[0], std::move(edits));
  EXPECT_TRUE(text.ok());
  return text ? *text : std::string();
}

std::string values(const Deck& deck) {
  std::string out;
  for (const Block& b : deck.blocks)
    for (const DecodedCard& card : decode(deck, b).cards)
      for (const Cell& c : card.cells) out += c.field->name + "=" + std::string(c.text) + ";";
  return out;
}

const Block& block(const Deck& deck, std::string_view keyword) {
  for (const Block& b : deck.blocks)
    if (b.header.starts_with(keyword)) return b;
  throw std::runtime_error("no such block");
}

TEST(NewCard, IsReadWithoutAFindingAndWithAllItsLines) {
  for (const char* keyword : {"/INTER/TYPE7", "/INTER/TYPE10", "/INTER/TYPE11", "/INTER/TYPE19",
                              "/FRICTION", "/MAT/ELAST", "/PROP/SHELL"})
    for (const int version : {51, 110, 140, 2019, 2024, 2026}) {
      const Schema* schema = SchemaSet::built_in().find(keyword);
      ASSERT_NE(schema, nullptr);
      const std::string card = new_card(*schema, std::string(keyword) + "/7", version, "mine");
      const Deck deck = read(deck_of(card, std::to_string(version)));
      Diagnostics findings;
      const DecodedBlock decoded = decode(deck, block(deck, keyword), &findings);
      EXPECT_EQ(findings.all().size(), 0u) << card << findings.all()[0].message;
      EXPECT_EQ(decoded.title, "mine");
      for (const DecodedCard& line : decoded.cards) EXPECT_FALSE(line.missing()) << card;
    }
}

TEST(Heading, EndsNamesWhereTheirColumnsEnd) {
  const Schema* schema = SchemaSet::built_in().find("/INTER/TYPE7");
  for (const CardSchema& card : schema->cards) {
    const std::string head = card_heading(card, 2022);
    if (head.empty()) continue;
    for (const Field& f : card.fields) {
      if (!f.in_version(2022) || f.last - f.first < 5) continue;
      const auto last = static_cast<std::size_t>(f.last);
      ASSERT_GE(head.size(), last);
      EXPECT_NE(head[last - 1], ' ') << head << f.name;
      EXPECT_TRUE(head.size() == last || head[last] == ' ') << head << f.name;
    }
  }
}

TEST(SetCell, MovesNothingElse) {
  const Deck deck = read(deck_of("/INTER/TYPE7/3\nt\n         1         2         4\n"));
  const Block& b = block(deck, "/INTER/TYPE7");
  const auto edit = set_cell(deck, b, "Igap", "3");
  ASSERT_TRUE(edit.ok());
  EXPECT_NE(changed(deck, {*edit}).find("\n         1         2         4                   3\n"),
            std::string::npos)
      << changed(deck, {*edit});
}

TEST(SetCell, SaysWhyNot) {
  const Deck deck = read(deck_of("/INTER/TYPE7/3\nt\n1,2,4\n"));
  const Block& b = block(deck, "/INTER/TYPE7");
  EXPECT_NE(set_cell(deck, b, "Igap", "3").error().message.find("free format"), std::string::npos);
  EXPECT_NE(set_cell(deck, b, "Nosuch", "3").error().message.find("no field"), std::string::npos);
  EXPECT_NE(set_cell(deck, b, "Gapmin", "3").error().message.find("not there"), std::string::npos);
  const Deck fixed = read(deck_of("/INTER/TYPE7/3\nt\n         1         2         4\n"));
  const auto wide = set_cell(fixed, block(fixed, "/INTER/TYPE7"), "Igap", "12345678901");
  ASSERT_FALSE(wide.ok());
  EXPECT_NE(wide.error().message.find("longer than the 10 columns"), std::string::npos);
}

Field field_at(const char* name, int first, int last) {
  Field f;
  f.name = name;
  f.first = first;
  f.last = last;
  return f;
}

TEST(Heading, ShortensNamesAndLeavesOutWhatHasNoRoom) {
  CardSchema card;
  // Two columns are too few for a name, and so is what begins inside of the name before.
  card.fields = {field_at("abc", 1, 10), field_at("xy", 11, 12),  field_at("abcdefghijk", 13, 20),
                 field_at("p", 21, 23),  field_at("qrs", 24, 26), field_at("t", 25, 27),
                 field_at("u", 26, 28)};
  card.fields[0].until = 2022;
  EXPECT_EQ(card_heading(card, 2022), "#      abc   abcdefg  p qr u");
  EXPECT_EQ(card_heading(card, 2023), "#            abcdefg  p qr u");
  card.until = 2022;
  EXPECT_EQ(card_heading(card, 2023), "");
  card.fields.clear();
  EXPECT_EQ(card_heading(card, 2022), "# blank line");
  card.fields = {field_at("abcdefghijklm", 1, 10)};
  EXPECT_EQ(card_heading(card, 2022), "# abcdefgh") << "the mark and one column stay free";
}

TEST(NewCard, HasTheLinesThatStandWithoutValues) {
  const auto card_of = [](const char* name, int last) {
    CardSchema card;
    card.fields = {field_at(name, last - 4, last)};
    return card;
  };
  Schema schema;
  schema.cards = {card_of("first", 10),   card_of("gone", 20),  card_of("never", 20),
                  card_of("often", 15),   card_of("more", 30),  card_of("group", 25),
                  card_of("goes_on", 35), card_of("other", 12), {}};
  schema.cards[0].fields.push_back(field_at("new", 11, 20));
  schema.cards[0].fields.back().from = 2023;
  schema.cards[0].fields.push_back(field_at("on", 21, 30));
  schema.cards[0].fields.back().when = {{"flag", {}, {1}, {}, {}, {}}};
  schema.cards[1].until = 2021;
  schema.cards[2].when = {{"flag", {}, {2}, {}, {}, {}}};
  schema.cards[3].when = {{"flag", {}, {}, {2}, {}, {}}};  // holds for zero
  schema.cards[4].optional = true;
  for (const std::size_t i : {5u, 6u}) {
    schema.cards[i].repeat = Repeat::group;
    schema.cards[i].count = "n";
  }
  schema.cards[5].optional = true;  // the second of the group falls with it
  schema.cards[7].repeat = Repeat::group;
  schema.cards[7].count = "m";
  EXPECT_EQ(new_card(schema, "/X/1", 2022, "a title"),
            "/X/1\na title\n" + card_heading(schema.cards[0], 2022) + "\n" + std::string(10, ' ') +
                "\n" + card_heading(schema.cards[3], 2022) + "\n" + std::string(15, ' ') + "\n" +
                card_heading(schema.cards[7], 2022) + "\n" + std::string(12, ' ') +
                "\n# blank line\n\n");
  EXPECT_NE(new_card(schema, "/X/1", 2023, "").find("\n" + std::string(20, ' ') + "\n"),
            std::string::npos);
  EXPECT_NE(new_card(schema, "/X/1", 2021, "").find(card_heading(schema.cards[1], 2021)),
            std::string::npos);
  EXPECT_EQ(new_card(schema, "/X/1", 50, "a title").find("a title"), std::string::npos)
      << "before version 51 there were no titles";
  EXPECT_NE(new_card(schema, "/X/1", 51, "a title").find("/X/1\na title\n"), std::string::npos);
  schema.has_title = false;
  EXPECT_EQ(new_card(schema, "/X/1", 2022, "a title").find("a title"), std::string::npos);
}

TEST(SetCell, TakesTheRoundAndSaysEachReason) {
  const Deck deck =
      read(deck_of("/FUNCT/5\nf\n                 0.0                 1.0\n"
                   "                10.0                 2.0\n/UNHEARD/1\nx\n"));
  const Block& b = block(deck, "/FUNCT");
  const std::string name = decode(deck, b).cards[0].cells[1].field->name;
  const auto second = set_cell(deck, b, name, "7.5", 1);
  ASSERT_TRUE(second.ok());
  EXPECT_NE(changed(deck, {*second}).find("                10.0                 7.5\n"),
            std::string::npos);
  EXPECT_NE(changed(deck, {*second}).find("                 0.0                 1.0\n"),
            std::string::npos);
  const auto first = set_cell(deck, b, name, "7.5");
  ASSERT_TRUE(first.ok());
  EXPECT_NE(changed(deck, {*first}).find("                 0.0                 7.5\n"),
            std::string::npos);
  EXPECT_EQ(set_cell(deck, b, name, "7.5", 2).error().message,
            "/FUNCT/5: its line with " + name + " is not there");
  EXPECT_EQ(set_cell(deck, b, "Nosuch", "1").error().message,
            "/FUNCT/5: version 2024 has no field Nosuch");
  const std::string exact(20, '1'), wide(21, '1');
  EXPECT_TRUE(set_cell(deck, b, name, exact).ok());
  EXPECT_EQ(set_cell(deck, b, name, wide).error().message,
            "/FUNCT/5: '" + wide + "' is longer than the 20 columns of " + name);
  EXPECT_EQ(set_cell(deck, block(deck, "/UNHEARD"), "x", "1").error().message,
            "/UNHEARD/1: no schema describes its lines");
}

}  // namespace
}  // namespace deck
