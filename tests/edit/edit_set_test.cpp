// The decks of a call as one set of files: what is one file, what is a conflict, what is written.
#include "deck/edit/edit_set.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "lint/support.hpp"

namespace deck::test {
namespace {

namespace fs = std::filesystem;

class EditSets : public testing::Test {
 protected:
  EditSets() {
    folder_.write("common/x.inc", "/TITLE\nshared\n");
    folder_.write("a/a_0000.rad", main_deck("#include ../common/x.inc\n"));
    folder_.write("b/b_0000.rad", main_deck("#include ../common/x.inc\n"));
  }
  static std::string main_deck(const std::string& more) {
    return "#RADIOSS STARTER\n/BEGIN\nx\n      2022         0\n" + more + "/END\n";
  }
  std::string at(const std::string& name) const { return folder_.path() + "/" + name; }
  std::unique_ptr<Deck> read(const std::string& name) const {
    auto deck = read_deck(at(name), SchemaSet::built_in());
    EXPECT_TRUE(deck) << deck.error().message;
    return std::make_unique<Deck>(std::move(*deck));
  }
  /// Adds a deck that wants `text` in the file it opens as `path`; empty: nothing.
  Result<std::size_t> add(EditSet& set, const Deck& deck, const std::string& path = {},
                          const std::string& text = {}) const {
    const auto member = set.add(deck);
    ChangedFiles changed;
    if (!path.empty()) changed[at(path)] = text;
    if (member) set.propose(*member, deck, changed);
    return member;
  }
  Folder folder_;
};

TEST_F(EditSets, AFileThatTwoDecksShareIsWrittenOnce) {
  const auto a = read("a/a_0000.rad"), b = read("b/b_0000.rad");
  EditSet set;
  ASSERT_TRUE(add(set, *a, "common/x.inc", "/TITLE\nnew\n"));
  ASSERT_TRUE(add(set, *b, "common/x.inc", "/TITLE\nnew\n"));
  const auto plan = set.in_place();
  ASSERT_TRUE(plan) << plan.error().message;
  ASSERT_EQ(plan->files.size(), 1u);
  EXPECT_EQ(plan->files[0].path, at("common/x.inc"));
  EXPECT_EQ(plan->files[0].bytes, "/TITLE\nnew\n");
  ASSERT_TRUE(plan->files[0].read);
  EXPECT_EQ(plan->files[0].read->bytes, "/TITLE\nshared\n");
  const auto tree = set.tree(at("out"));
  ASSERT_TRUE(tree) << tree.error().message;
  EXPECT_EQ(tree->files.size(), 3u) << "two decks and the file that they share";
}

TEST_F(EditSets, TwoTextsForOneFileAreRefusedWithBothPlaces) {
  const auto a = read("a/a_0000.rad"), b = read("b/b_0000.rad");
  EditSet set;
  ASSERT_TRUE(add(set, *a, "common/x.inc", "/TITLE\nfor a\n"));
  ASSERT_TRUE(add(set, *b, "common/x.inc", "/TITLE\nfor b\n"));
  for (const std::string& why : {set.in_place().error().message,
                                 set.tree(at("out")).error().message, set.diff().error().message}) {
    EXPECT_NE(why.find("x.inc:2:"), std::string::npos) << why;
    EXPECT_NE(why.find("a_0000.rad:5"), std::string::npos) << why;
    EXPECT_NE(why.find("b_0000.rad:5"), std::string::npos) << why;
    EXPECT_NE(why.find("for a"), std::string::npos) << why;
    EXPECT_NE(why.find("for b"), std::string::npos) << why;
  }
}

TEST_F(EditSets, ADeckThatWantsTheFileAsItIsCountsAsWell) {
  const auto a = read("a/a_0000.rad"), b = read("b/b_0000.rad");
  EditSet set;
  ASSERT_TRUE(add(set, *a, "common/x.inc", "/TITLE\nfor a\n"));
  ASSERT_TRUE(add(set, *b));
  ASSERT_FALSE(set.in_place());
  EXPECT_NE(set.in_place().error().message.find("leaves it as it is"), std::string::npos);
}

TEST_F(EditSets, ALinkIsTheFileItLeadsTo) {
  fs::create_symlink("x.inc", at("common/link.inc"));
  folder_.write("b/b_0000.rad", main_deck("#include ../common/link.inc\n"));
  const auto a = read("a/a_0000.rad"), b = read("b/b_0000.rad");
  EditSet set;
  ASSERT_TRUE(add(set, *a, "common/x.inc", "/TITLE\nfor a\n"));
  ASSERT_TRUE(add(set, *b, "common/link.inc", "/TITLE\nfor b\n"));
  EXPECT_FALSE(set.in_place());
}

TEST_F(EditSets, AFileThatChangedBetweenTwoDecksIsRefused) {
  const auto a = read("a/a_0000.rad");
  folder_.write("common/x.inc", "/TITLE\nEDITED\n");
  const auto b = read("b/b_0000.rad");
  EditSet set;
  ASSERT_TRUE(set.add(*a));
  const auto second = set.add(*b);
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find("was changed"), std::string::npos);
  // By another file in its place, too.
  folder_.write("common/y.inc", "/TITLE\nshared\n");
  fs::rename(at("common/y.inc"), at("common/x.inc"));
  EXPECT_FALSE(set.add(*read("b/b_0000.rad")));
}

TEST_F(EditSets, TwoFilesForOnePlaceAreRefused) {
  folder_.write("x/car_0000.rad", main_deck(""));
  folder_.write("y/car_0000.rad", main_deck("/TITLE\nanother\n"));
  const auto x = read("x/car_0000.rad"), y = read("y/car_0000.rad");
  EditSet set;
  ASSERT_TRUE(add(set, *x));
  ASSERT_TRUE(add(set, *y));
  EXPECT_TRUE(set.in_place());
  const auto tree = set.tree(at("out"));
  ASSERT_FALSE(tree);
  EXPECT_NE(tree.error().message.find("x/car_0000.rad"), std::string::npos);
  EXPECT_NE(tree.error().message.find("y/car_0000.rad"), std::string::npos);
}

TEST_F(EditSets, ThePatchHasEveryFileOnceRelativeToTheWorkTree) {
  fs::create_directories(at(".git"));
  const auto a = read("a/a_0000.rad"), b = read("b/b_0000.rad");
  EditSet set;
  ASSERT_TRUE(add(set, *a, "common/x.inc", "/TITLE\nnew\n"));
  ASSERT_TRUE(add(set, *b, "common/x.inc", "/TITLE\nnew\n"));
  const auto patch = set.diff();
  ASSERT_TRUE(patch) << patch.error().message;
  EXPECT_EQ(*patch,
            "diff --git a/common/x.inc b/common/x.inc\n--- a/common/x.inc\n+++ b/common/x.inc\n"
            "@@ -1,2 +1,2 @@\n /TITLE\n-shared\n+new\n");
}

}  // namespace
}  // namespace deck::test
