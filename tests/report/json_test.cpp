// Tests of the JSON writer and of text tables.
#include "report/shared/json.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "report/shared/text_table.hpp"

namespace deck {
namespace {

TEST(JsonWriter, NestsObjectsAndArrays) {
  std::string out;
  JsonWriter json(out);
  json.begin_object().field("a", 1).key("b").begin_array(true).value(2).value("x").null();
  json.end_array().key("c").begin_object().end_object().end_object();
  EXPECT_EQ(out, "{\n  \"a\": 1,\n  \"b\": [2, \"x\", null],\n  \"c\": {}\n}\n");
}

TEST(JsonWriter, EscapesTextsAndWritesNullForWhatIsNoNumber) {
  std::string out;
  append_json_string(out, "a\"b\\c\n\x01\xc3\xa9\xe9\xff");  // UTF-8, then Latin-1
  EXPECT_EQ(out, "\"a\\\"b\\\\c\\u000a\\u0001\xc3\xa9\xc3\xa9\xc3\xbf\"");
  out.clear();
  JsonWriter json(out);
  json.begin_array(true).value(std::nan("")).value(std::numeric_limits<double>::infinity());
  json.end_array();
  EXPECT_EQ(out, "[null, null]\n");
}

TEST(JsonWriter, EveryByteSequenceIsValidJson) {
  std::mt19937 random(1);
  for (int round = 0; round < 5000; ++round) {
    std::string text;
    for (int i = 0; i < 8; ++i) text += static_cast<char>(random() & 0xff);
    std::string out;
    append_json_string(out, text);
    EXPECT_TRUE(nlohmann::json::accept(out)) << round;
  }
}

TEST(JsonWriter, RealsShowThatTheyAreReal) {
  EXPECT_EQ(shortest(1.0), "1.0");
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(1e30), "1e+30");
  EXPECT_EQ(shortest(-0.0), "-0.0");
}

TEST(JsonWriter, RealsReadBackToTheSameBits) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 20000; ++round) {
    double value;
    const std::uint64_t bits = random();
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    const std::string text = shortest(value);
    double back = 0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    EXPECT_EQ(std::memcmp(&back, &value, sizeof value), 0) << text;
  }
}

TEST(TextTable, AlignsColumnsByCharactersAndLeavesNoBlanksAtTheEnd) {
  TextTable table({{"name", Align::left}, {"n", Align::right}, {"note", Align::left}});
  table.row({"\xc3\xa9", "12", "x"});
  table.row({"abcdef", "3"});
  EXPECT_EQ(table.fitted(0), "name     n  note\n\xc3\xa9       12  x\nabcdef   3\n");
}

TEST(FittedTable, BreaksTextsBeforeItFoldsColumns) {
  TextTable table({{"id", Align::right}, {"a long text", Align::left}, {"n", Align::right}});
  table.row({"1", "words that go on and on behind the end", "22"});
  const std::string text = table.fitted(30);
  EXPECT_EQ(text.find("\n\n"), std::string::npos) << text;
  EXPECT_NE(text.find("22"), std::string::npos);
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
    EXPECT_LE(text.find('\n', at) - at, 30u);
}

TEST(FittedTable, FoldsColumnsBehindTheFirst) {
  std::vector<TextTable::Column> columns = {{"id", Align::right}};
  std::vector<TextTable::Cell> row = {"7"};
  for (int i = 0; i < 10; ++i) {
    columns.push_back({"column" + std::to_string(i), Align::right});
    row.emplace_back(std::to_string(i));
  }
  TextTable table(columns);
  table.row(row);
  const std::string text = table.fitted(40);
  EXPECT_NE(text.find("\n\nid"), std::string::npos) << text;
  EXPECT_NE(text.find("column9"), std::string::npos);
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
    EXPECT_LE(text.find('\n', at) - at, 40u);
}

}  // namespace
}  // namespace deck
