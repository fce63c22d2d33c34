// A card laid out from its schema.
#include "keyword/shared/card_forms.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace deck::test {
namespace {

TEST(RenderCard, FieldsStandInTheirColumnsInWhateverOrderTheSchemaNamesThem) {
  SchemaSet schemas;
  ASSERT_TRUE(schemas.add_json("own", R"({"keyword": "/OWN", "kind": "other", "doc": "A card.",
      "cards": [{"name": "all", "fields": [
        {"name": "last", "cols": [21, 30], "type": "int", "doc": "c"},
        {"name": "first", "cols": [1, 10], "type": "int", "doc": "a"},
        {"name": "mid", "cols": [11, 20], "type": "int", "doc": "b"}]}]})"));
  const Schema* schema = schemas.match("/OWN/1");
  ASSERT_NE(schema, nullptr);
  EXPECT_EQ(render_card(*schema, "/OWN/1", 2022, {{"mid", "2"}, {"last", "3"}, {"first", "1"}}),
            "/OWN/1\nexample\n"
            "#    first       mid      last\n"
            "         1         2         3\n");
}

TEST(RenderCard, ALineWhoseCellsAreNotReadIsNoLine) {
  const Schema* schema = SchemaSet::built_in().find("/INTER/TYPE2");
  ASSERT_NE(schema, nullptr);
  const auto lines = [&](const char* spotflag) {
    const std::string text =
        render_card(*schema, "/INTER/TYPE2/1", 2022, {{"Spotflag", spotflag}, {"Ithe", "1"}});
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(lines("27"), lines("5") + 2) << "Stfac and its comment";
}

}  // namespace
}  // namespace deck::test
