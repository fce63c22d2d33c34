// What is a Starter deck, and what everything else is called.
#include "keyword/shared/recognise.hpp"

#include <gtest/gtest.h>

namespace deck {
namespace {

std::string verdict(std::string text) {
  const auto deck = read_deck_text("x", std::move(text), SchemaSet::built_in());
  EXPECT_TRUE(deck.ok());
  return deck ? no_starter_deck(*deck) : "";
}

TEST(StarterDeck, HasBeginOrTheBannerWithAKeyword) {
  EXPECT_EQ(verdict("#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n/END\n"), "");
  EXPECT_EQ(verdict("/BEGIN\nrun\n      2022         0\n/NODE\n/END\n"), "") << "without banner";
  EXPECT_EQ(verdict("#RADIOSS STARTER\n/NODE\n/END\n"), "") << "without /BEGIN";
  EXPECT_EQ(verdict("\xef\xbb\xbf#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n"), "");
}

TEST(StarterDeck, IsNoneOfThese) {
  const std::pair<std::string, const char*> files[] = {
      {"\x1f\x8b\x08\x01\x02\x03\n/BEGIN\nx\n", "gzip"},
      {"PK\x03\x04\nxyz\n", "ZIP"},
      {"#RADIOSS ENGINE\n/RUN/car/1\n1.0\n/TFILE\n0.1\n", "Engine file"},
      {"/VERS/2022\n/RUN/car/1/\n 10.\n/DT/NODA/CST\n0.9 0\n", "Engine file"},
      {"$ comment\n*KEYWORD\n*NODE\n1,0,0,0\n*END\n", "LS-DYNA"},
      {"<!DOCTYPE html>\n<html>\n<body>404</body>\n</html>\n", "HTML page"},
      {"<?xml version=\"1.0\"?>\n<a/>\n", "XML"},
      {"{\n \"schema\": 1\n}\n", "JSON"},
      {"SOL 101\nCEND\nBEGIN BULK\n", "Nastran"},
      {"hello\n", "single line"},
      {"/BEGIN\n", "single line"},
      {"#RADIOSS STARTER\n", "no keyword"},
      {"#RADIOSS STARTER\r/BEGIN\rrun\r      2022         0\r/NODE\r/END\r", "carriage return"},
      {"/BEGIN\rrun\r      2022         0\r/NODE\r/END\r", "carriage return"},
      {"#RADIOSS STARTER\n\n# nothing\n/END\n", "no keyword"},
      {"dear all,\nthis is a letter\n", "without a keyword"},
      {"/NODE\n         1\n", "part of one"},
      {"#radioss starter\n/begin\nrun\n      2022         0\n/node\n/end\n", "not in capitals"},
      {"ab\x01\x02\x03\x04\x05\x06\x07\n\x10\x11\x12\n", "binary"},
  };
  for (const auto& [text, what] : files)
    EXPECT_NE(verdict(text).find(what), std::string::npos) << what << ": " << verdict(text);
}

TEST(StarterDeck, LatinLettersAreText) {
  EXPECT_EQ(verdict("gr\xfc\xdf"
                    "e\naus K\xf6ln\n\xe4\xe4\xe4\xe4\n")
                .find("binary"),
            std::string::npos);
}

}  // namespace
}  // namespace deck
