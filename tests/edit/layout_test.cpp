// Cards laid out by their schema.
#include <gtest/gtest.h>

#include "edit/shared/layout.hpp"
#include "keyword/reading.hpp"

namespace deck {
namespace {

using testing_support::deck_of;
using testing_support::read;

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

}  // namespace
}  // namespace deck
