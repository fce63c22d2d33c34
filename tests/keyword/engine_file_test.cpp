// Engine files beside a deck, cut into keywords, lines and cells.
#include "deck/keyword.hpp"

#include "keyword/reading.hpp"
#include "keyword/shared/engine_layout.hpp"
#include "keyword/shared/include_scan.hpp"

namespace deck {
namespace {

using namespace deck::testing_support;

std::vector<std::string> texts(const Deck& deck, const std::vector<Span>& spans) {
  std::vector<std::string> all;
  for (const Span span : spans) all.emplace_back(deck.sources.text(span));
  return all;
}

using EngineFileOfADeck = Folder;

TEST_F(EngineFileOfADeck, IsCutIntoKeywordsAndTheirLines) {
  const std::string path = file("car_0000.rad", deck_of("/NODE\n"));
  file("car_0001.rad",
       "stray\n# note\n/RUN/car/1  \r\n 10.5\t \r\n\n$ 3\n#include x.inc \n/ANIM/DT\n0 1\n2 3");
  file("car_0002.rad", "/STOP\n");
  file("car_0004.rad", "/STOP\n");
  Deck deck = read_file(path);
  const EngineFiles engine = read_engine_files(deck, Limits());
  EXPECT_EQ(engine.run, "car");
  EXPECT_TRUE(engine.unread.empty());
  ASSERT_EQ(engine.files.size(), 2u) << "up to the first number that is missing";
  const EngineFile& first = engine.files[0];
  EXPECT_EQ(first.number, 1);
  EXPECT_EQ(engine.files[1].number, 2);
  EXPECT_EQ(deck.sources[first.file].path(), (dir_ / "car_0001.rad").string());
  ASSERT_EQ(first.blocks.size(), 2u);
  EXPECT_EQ(first.blocks[0].keyword, "/RUN/car/1");
  EXPECT_EQ(deck.sources.text(first.blocks[0].header), "/RUN/car/1");
  EXPECT_EQ(texts(deck, first.blocks[0].lines), std::vector<std::string>{" 10.5"});
  EXPECT_EQ(first.blocks[1].keyword, "/ANIM/DT");
  EXPECT_EQ(texts(deck, first.blocks[1].lines), (std::vector<std::string>{"0 1", "2 3"}));
  EXPECT_EQ(texts(deck, first.includes), std::vector<std::string>{"#include x.inc"});
  Limits one;
  one.files = 1;
  Deck again = read_file(path);
  EXPECT_EQ(read_engine_files(again, one).files.size(), 1u);
}

TEST_F(EngineFileOfADeck, ThatCannotBeReadIsNamedWithTheReason) {
  const std::string path = file("car_0000.rad", deck_of("/NODE\n"));
  std::filesystem::create_directories(dir_ / "car_0001.rad");
  file("car_0002.rad", "/STOP\n");
  Deck deck = read_file(path);
  const EngineFiles engine = read_engine_files(deck, Limits());
  ASSERT_EQ(engine.unread.size(), 1u);
  EXPECT_EQ(engine.unread[0].path, (dir_ / "car_0001.rad").string());
  EXPECT_EQ(engine.unread[0].why.find("car_0001"), std::string::npos) << engine.unread[0].why;
  ASSERT_EQ(engine.files.size(), 1u);
  EXPECT_EQ(engine.files[0].number, 2);
}

TEST_F(EngineFileOfADeck, MayBePackedWhereTheDeckIs) {
  file("car_0000.rad.gz", "");
  file("car_0001.rad.gz", "");
  file("car_0002.rad", "");
  const std::string stem = (dir_ / "car_").string();
  EXPECT_EQ(engine_files_beside(stem + "0000.rad.gz"),
            (std::vector<std::string>{stem + "0001.rad.gz", stem + "0002.rad"}));
  EXPECT_TRUE(engine_files_beside(stem + "0000.rad").empty()) << "the first one is packed";
  EXPECT_TRUE(engine_files_beside(stem + "0000.k").empty());
}

TEST(StarterOfEngineFile, IsTheNameWithFourZeros) {
  EXPECT_EQ(starter_of_engine_file("a/car_0001.rad"), "a/car_0000.rad");
  EXPECT_EQ(starter_of_engine_file("a/car_9999.rad"), "a/car_0000.rad");
  EXPECT_EQ(starter_of_engine_file("a/car_0012.rad.gz"), "a/car_0000.rad.gz");
  EXPECT_EQ(starter_of_engine_file("x_0001.rad"), "x_0000.rad");
  for (const char* other : {"a/car_0000.rad", "a/car_00x1.rad", "a/car-0001.rad", "car_0001.k",
                            "_0001.rad", "0001.rad", ".rad", ""})
    EXPECT_EQ(starter_of_engine_file(other), "") << other;
}

TEST(EngineCells, ArePartedByBlanksTabsAndCommas) {
  Deck deck = read(deck_of(" 0.9,\t12  x\n"));
  const std::string_view bytes = deck.sources[0].bytes();
  const auto at = bytes.find(" 0.9");
  const std::vector<Span> cells = engine_cells(deck.sources, {0, 11, at});
  EXPECT_EQ(texts(deck, cells), (std::vector<std::string>{"0.9", "12", "x"}));
  EXPECT_EQ(cells[1].offset, at + 6);
  EXPECT_TRUE(engine_cells(deck.sources, {0, 1, at}).empty());
}

}  // namespace
}  // namespace deck
