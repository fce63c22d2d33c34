// The decks of a call as one set of files: what is one file, what is a conflict, what is written.
#include "edit/shared/edit_set.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "lint/support.hpp"
#include "text/shared/gzip.hpp"

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

TEST_F(EditSets, APackedFileStaysPackedInPlaceAndInATree) {
  const std::string main = main_deck("#include y.inc\n"), before = gzip("/TITLE\nold\n");
  folder_.write("c/c_0000.rad.gz", gzip(main));
  folder_.write("c/y.inc.gz", before);
  const auto deck = read("c/c_0000.rad.gz");
  EditSet set;
  ASSERT_TRUE(add(set, *deck, "c/y.inc.gz", "/TITLE\nnew\n"));
  const auto plan = set.in_place();
  ASSERT_TRUE(plan) << plan.error().message;
  ASSERT_EQ(plan->files.size(), 1u);
  EXPECT_EQ(plan->files[0].path, at("c/y.inc.gz"));
  EXPECT_EQ(plan->files[0].bytes, gzip("/TITLE\nnew\n"));
  EXPECT_EQ(plan->files[0].read->bytes, before) << "what is compared before it is replaced";
  // Elsewhere a file is what its name says: the #include leads to y.inc.
  const auto tree = set.tree(at("out"));
  ASSERT_TRUE(tree) << tree.error().message;
  ASSERT_EQ(tree->files.size(), 2u);
  EXPECT_EQ(tree->files[0].path, at("out/c_0000.rad.gz"));
  EXPECT_EQ(tree->files[0].bytes, gzip(main));
  EXPECT_EQ(tree->files[1].path, at("out/y.inc"));
  EXPECT_EQ(tree->files[1].bytes, "/TITLE\nnew\n");
  // A patch is for what gunzip makes of it.
  const auto patch = set.diff();
  ASSERT_TRUE(patch);
  EXPECT_NE(patch->find("+++ b/y.inc\n"), std::string::npos) << *patch;
  EXPECT_EQ(patch->find(".gz"), std::string::npos) << *patch;
}

TEST_F(EditSets, TwoTextsForOneFileNameBothPlacesAndUnits) {
  for (const auto& [name, mass] : {std::pair{"a", "kg"}, {"b", "Mg"}}) {
    const std::string row = fmt::format("{:>20}{:>20}{:>20}\n", mass, "mm", "ms");
    folder_.write(fmt::format("{0}/{0}_0000.rad", name),
                  main_deck(row + row + "#include ../common/x.inc\n"));
  }
  const auto a = read("a/a_0000.rad"), b = read("b/b_0000.rad");
  EditSet set;
  ASSERT_TRUE(add(set, *a, "common/x.inc", "/TITLE\nfor a\n"));
  ASSERT_TRUE(add(set, *b, "common/x.inc", "/TITLE\nfor b\n"));
  for (const std::string& why : {set.in_place().error().message,
                                 set.tree(at("out")).error().message, set.diff().error().message})
    for (const char* part : {"x.inc:2:", "a_0000.rad:7", "b_0000.rad:7", "for a", "for b",
                             "a_0000.rad is in kg, mm, ms", "b_0000.rad in Mg, mm, ms"})
      EXPECT_NE(why.find(part), std::string::npos) << why;
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

TEST_F(EditSets, TwoTextsForOnePlaceFromMemoryAreRefused) {
  std::map<std::string, std::string> one{{"car_0000.rad", main_deck("")}},
      other{{"car_0000.rad", main_deck("/TITLE\nanother\n")}};
  ReadOptions options;
  EditSet set;
  std::vector<Deck> decks;
  for (const auto* overlay : {&one, &other}) {
    options.overlay = overlay;
    decks.push_back(std::move(*read_deck("car_0000.rad", SchemaSet::built_in(), options)));
  }
  for (std::size_t d = 0; d < 2; ++d) {
    const auto member = set.add(decks[d], "deck " + std::to_string(d));
    ASSERT_TRUE(member);
    set.propose(*member, decks[d], {});
  }
  const auto tree = set.tree(at("out"));
  ASSERT_FALSE(tree);
  EXPECT_NE(tree.error().message.find("deck 0"), std::string::npos);
  EXPECT_NE(tree.error().message.find("deck 1"), std::string::npos);
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

TEST_F(EditSets, TwoNamesOfAHardLinkAreTwoFiles) {
  fs::create_hard_link(at("common/x.inc"), at("common/y.inc"));
  folder_.write("b/b_0000.rad", main_deck("#include ../common/y.inc\n"));
  const auto a = read("a/a_0000.rad"), b = read("b/b_0000.rad");
  EditSet set;
  ASSERT_TRUE(add(set, *a, "common/x.inc", "/TITLE\nfor a\n"));
  ASSERT_TRUE(add(set, *b, "common/y.inc", "/TITLE\nfor b\n"));
  const auto plan = set.in_place();
  ASSERT_TRUE(plan) << plan.error().message;
  ASSERT_TRUE(write_files_atomic(plan->files));
  EXPECT_EQ(read("a/a_0000.rad")->sources[1].bytes(), "/TITLE\nfor a\n");
  EXPECT_EQ(read("b/b_0000.rad")->sources[1].bytes(), "/TITLE\nfor b\n");
}

TEST_F(EditSets, BelowARootEveryDeckKeepsItsPlace) {
  const auto a = read("a/a_0000.rad");
  EditSet set(fs::path(folder_.path()).parent_path().string());
  ASSERT_TRUE(add(set, *a));
  const auto tree = set.tree("out");
  ASSERT_TRUE(tree) << tree.error().message;
  const std::string top = "out/" + fs::path(folder_.path()).filename().string();
  ASSERT_EQ(tree->files.size(), 2u);
  EXPECT_EQ(tree->files[0].path, top + "/a/a_0000.rad");
  EXPECT_EQ(tree->files[1].path, top + "/common/x.inc");
  EditSet narrow(at("a"));
  ASSERT_TRUE(add(narrow, *a));
  EXPECT_FALSE(narrow.tree("out")) << "an include lies above the root";
}

TEST_F(EditSets, DecksThatShareAFileAreOneGroup) {
  folder_.write("c/c_0000.rad", main_deck("#include ../other/z.inc\n"));
  folder_.write("d/d_0000.rad", main_deck("#INCLUDE '../common/../common/x.inc'\n"));
  folder_.write("other/z.inc", "/TITLE\nz\n");
  IncludeScan scan;
  std::vector<std::vector<IncludeScan::File>> files;
  for (const char* name : {"a/a_0000.rad", "c/c_0000.rad", "d/d_0000.rad", "b/b_0000.rad"})
    files.push_back(scan.files(at(name)));
  EXPECT_EQ(files[1].size(), 2u);
  const auto groups = sharing_groups(files);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0], (std::vector<std::size_t>{0, 2, 3}));
  EXPECT_EQ(groups[1], (std::vector<std::size_t>{1}));
}

}  // namespace
}  // namespace deck::test
