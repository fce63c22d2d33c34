// A card laid out from its schema.
#include "deck/keyword/render.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace deck::test
