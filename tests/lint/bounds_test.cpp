// Limits of a schema: values inside, outside, at an open limit; limits with the default 0.
#include "lint/support.hpp"

namespace deck {
namespace {

constexpr std::string_view winch = R"({
  "keyword": "/WINCH", "kind": "other", "doc": "A winch.",
  "cards": [{ "name": "all", "fields": [
    { "name": "Imode", "cols": [1, 10], "type": "int", "values": [1, 4], "doc": "Mode" },
    { "name": "share", "cols": [11, 30], "type": "real", "min": 0.1, "max": 1, "max_open": true, "doc": "Share" }
  ]}]
})";

class BoundsOfASchema : public testing::Test {
 protected:
  /// The message about the card, or nothing.
  std::string said(std::string_view line) {
    folder_.write("winch.json", winch);
    SchemaSet schemas = SchemaSet::built_in();
    EXPECT_TRUE(schemas.add_directory(folder_.path()));
    const std::string text =
        example_deck("/WINCH/3\nfront\n" + std::string(line) + "\n", SchemaSet::built_in()).main;
    auto deck = read_deck_text("deck_0000.rad", text, schemas);
    EXPECT_TRUE(deck);
    const LintResult result =
        run_lint(test::linted(std::move(*deck), test::with_schemas(schemas)).loaded);
    for (const Finding& d : result.findings)
      if (d.rule == RuleId::DK096) return d.message;
    return {};
  }
  test::Folder folder_;
};

TEST_F(BoundsOfASchema, NameWhatIsLegalAndLeaveTheRestAlone) {
  EXPECT_EQ(said("         4                 0.5"), "");
  EXPECT_EQ(said("         0                 0.0"), "") << "0 is the default";
  EXPECT_EQ(said(""), "");
  EXPECT_EQ(said("         2                 0.5"), "Imode of /WINCH 3 is 2; legal: 1 or 4");
  EXPECT_EQ(said("         1                 1.0"),
            "share of /WINCH 3 is 1.0; legal: from 0.1 up to 1 (not itself)");
  EXPECT_EQ(said("         1               0.999"), "");
  EXPECT_EQ(said("       two                 0.5"), "") << "its own rule says that";
}

}  // namespace
}  // namespace deck
