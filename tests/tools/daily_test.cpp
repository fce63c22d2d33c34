// What people do every day: a listing explained, findings in lines, folders of decks, the deck of
// another git revision, a conversion that is only looked at.
#include <nlohmann/json.hpp>

#include "tools/command_line.hpp"
#include "tools/git_repository.hpp"

namespace {

using namespace deck::testing_support;
using nlohmann::json;

class Daily : public CommandLine {
 protected:
  static std::string sample(const char* name) {
    return read(deck::test::source_dir() / "samples" / (std::string(name) + "_0000.rad"));
  }
  void put(const char* name) const {
    write(dir_ / (std::string(name) + "_0000.rad"), sample(name));
  }
  bool has(const char* text) const { return out().find(text) != std::string::npos; }
  bool complains(const char* text) const { return err().find(text) != std::string::npos; }
};

/// What the Starter says of the sample too_close.
constexpr const char* listing =
    "* INPUT READING PROCESS\n"
    "    IPRI  : PRINTOUT FLAG . . . . . . . .         0\n"
    "\n INTERFACE NUMBER. . . . . . . . . . . . . .         1\n"
    " INTERFACE TYPE. . . . . . . . . . . . . . .     7\n"
    "\n  POSSIBLE IMPACT NUMBER:           16  (<=           2 *NSN)\n"
    "\nWARNING ID :    343\n** WARNING: INITIAL PENETRATIONS IN INTERFACE\nDESCRIPTION :  \n"
    "   -- INTERFACE ID: 1\n   -- INTERFACE TYPE: too close\n"
    "   THERE ARE 16 INITIAL PENETRATIONS\n   ( CONCERNING 9 NODES )\n"
    "\n\n              0 ERROR(S)\n              1 WARNING(S)\n";

class ExplainListing : public Daily {};

TEST_F(ExplainListing, FindsItsDeckBesideIt) {
  put("too_close");
  write(dir_ / "too_close_0000.out", listing);
  ASSERT_EQ(deck("explain too_close_0000.out --json explain.json"), 0) << err() << out();
  for (const char* text : {"too_close_0000.out beside too_close_0000.rad", "warning 343",
                           "number in the message: 16", "DK301", "same number"})
    EXPECT_TRUE(has(text)) << text << "\n" << out();
  const json document = json::parse(read(dir_ / "explain.json"));
  EXPECT_EQ(document["agrees"], true);
  EXPECT_EQ(document["contacts"][0]["listed"], 16);
  EXPECT_EQ(document["contacts"][0]["pairs"].size(), 16u);
  ASSERT_EQ(deck("explain too_close_0000.out --quiet"), 0);
  EXPECT_EQ(out(), "");
}

TEST_F(ExplainListing, EndsWithOneWhereItDiffersOrHasErrors) {
  put("too_close");
  std::string other = listing;
  other.replace(other.find("THERE ARE 16"), 12, "THERE ARE 15");
  write(dir_ / "too_close_0000.out", other);
  EXPECT_EQ(deck("explain too_close_0000.out"), 1) << err();
  EXPECT_TRUE(has("another number")) << out();
  std::string stops = listing;
  stops.replace(stops.find("WARNING ID"), 7, "ERROR");
  write(dir_ / "alone_0000.out", stops);
  EXPECT_EQ(deck("explain alone_0000.out"), 1);
  EXPECT_TRUE(complains("no deck beside alone_0000.out")) << err();
}

TEST_F(ExplainListing, TakesSeveralAndAnotherDeck) {
  put("too_close");
  write(dir_ / "a_0000.out", listing);
  write(dir_ / "too_close_0000.out", listing);
  EXPECT_EQ(deck("explain a_0000.out --deck too_close_0000.rad"), 0) << err();
  EXPECT_TRUE(has("a_0000.out beside too_close_0000.rad")) << out();
  EXPECT_EQ(deck("explain a_0000.out too_close_0000.out --json all.json"), 0) << err();
  EXPECT_EQ(json::parse(read(dir_ / "all.json"))["decks"].size(), 2u);
}

TEST_F(ExplainListing, RefusesWhatIsNone) {
  write(dir_ / "a_0000.out", "nothing of the kind\n");
  EXPECT_EQ(deck("explain a_0000.out"), 3);
  EXPECT_EQ(deck("explain absent_0000.out"), 3);
  EXPECT_EQ(deck("explain a_0000.out 611"), 2);
  EXPECT_EQ(deck("explain 611 --json x.json"), 2);
  EXPECT_EQ(deck("explain a_0000.out a_0000.out --deck x_0000.rad"), 2);
}

TEST_F(ExplainListing, EndsWithThreeWhereTheDeckLacksAnInclude) {
  write(dir_ / "a_0000.rad", std::string(begin) + "#include nowhere.inc\n/END\n");
  write(dir_ / "a_0000.out", listing);
  EXPECT_EQ(deck("explain a_0000.out"), 3);
  EXPECT_TRUE(complains("nowhere.inc")) << err();
}

class LintLines : public Daily {};

TEST_F(LintLines, AreOnePerFindingOrOnePerRule) {
  put("every_mistake");
  EXPECT_EQ(deck("lint every_mistake_0000.rad --select DK171 --format concise"), 1) << err();
  EXPECT_TRUE(out().starts_with("every_mistake_0000.rad:706:11: DK171 error: surf_IDm of "))
      << out();
  EXPECT_EQ(deck("lint every_mistake_0000.rad --select DK171,DK242 --statistics"), 1) << err();
  EXPECT_TRUE(has("\nDK171 ")) << out();
  EXPECT_TRUE(has("1 unsafe")) << out();
  EXPECT_TRUE(has("2 findings of 2 rules")) << out();
  EXPECT_EQ(deck("lint every_mistake_0000.rad --statistics --format json"), 2);
  put("clean_plates");
  EXPECT_EQ(deck("lint clean_plates_0000.rad --select DK171 --statistics"), 0);
  EXPECT_EQ(out(), "no findings\n");
}

TEST_F(LintLines, TakeAFolderInTheOrderOfItsNames) {
  write(dir_ / "decks/b/too_close_0000.rad", sample("too_close"));
  write(dir_ / "decks/a_0000.rad", sample("clean_plates"));
  write(dir_ / "decks/part.rad", "no deck\n");
  write(dir_ / "empty/readme.txt", "nothing\n");
  for (const char* verb : {"lint", "gaps", "cycle"}) {
    EXPECT_EQ(deck(std::string(verb) + " decks --json all.json"), 0) << verb << err();
    const json document = json::parse(read(dir_ / "all.json"));
    ASSERT_EQ(document["decks"].size(), 2u) << verb;
    EXPECT_EQ(document["decks"][0]["deck"]["path"], "decks/a_0000.rad") << verb;
  }
}

TEST_F(LintLines, AnEmptyFolderIsRefusedByEveryVerbWithTheSameWords) {
  write(dir_ / "empty/readme.txt", "nothing\n");
  for (const char* verb :
       {"lint", "gaps", "cycle", "fix", "convert --flatten -o out", "batch -o results"}) {
    EXPECT_EQ(deck(std::string(verb) + " empty"), 3) << verb;
    EXPECT_TRUE(complains("empty: no *_0000.rad in this directory")) << verb << err();
  }
}

TEST_F(LintLines, AndTheirOptionsStandUnderHeadings) {
  ASSERT_EQ(deck("help gaps"), 0);
  for (const char* heading : {"\nOutput:\n", "\nReading:\n", "\nExit code:\n"})
    EXPECT_TRUE(has(heading)) << heading << out();
}

class GitRevision : public GitRepository {
 protected:
  static std::string sample(const char* name) {
    return read(deck::test::source_dir() / "samples" / (std::string(name) + "_0000.rad"));
  }
};

TEST_F(GitRevision, IsTheOldSideOfDiff) {
  EXPECT_EQ(deck("diff --git v1 models/car_0000.rad"), 0) << err() << out();
  EXPECT_TRUE(has("git:v1/models/car_0000.rad -> models/car_0000.rad")) << out();
  // The include moves and one node with it.
  const std::string nodes = read(dir_ / "models/inc/nodes.inc");
  fs::remove_all(dir_ / "models/inc");
  std::string moved = nodes;
  const auto at = moved.find(" 0.9");
  if (at != std::string::npos) moved.replace(at, 4, " 0.8");
  write(dir_ / "models/nodes.inc", moved);
  std::string main = read(dir_ / "models/car_0000.rad");
  main.replace(main.find("inc/nodes.inc"), 13, "nodes.inc");
  write(dir_ / "models/car_0000.rad", main);
  const int code = deck("diff --git v1 models/car_0000.rad");
  EXPECT_EQ(code, at == std::string::npos ? 0 : 1) << err() << out();
  EXPECT_FALSE(fs::exists(dir_ / "models/inc")) << "nothing is checked out";
}

TEST_F(GitRevision, IsTheEarlierRunOfGaps) {
  std::string main = read(dir_ / "models/car_0000.rad");
  EXPECT_EQ(deck("gaps models/car_0000.rad --compare git:v1 --fail-on never,new,worse"), 0)
      << err();
  EXPECT_TRUE(has("against git:v1: 0 new, 0 worse")) << out();
  // A larger gap.
  const auto gap = main.rfind("1.25");
  ASSERT_NE(gap, std::string::npos);
  main.replace(gap, 4, "1.35");
  write(dir_ / "models/car_0000.rad", main);
  EXPECT_EQ(deck("gaps models/car_0000.rad --compare git:v1 --fail-on never,new,worse"), 1)
      << err();
  write(dir_ / "models/.decklint.toml", "[gate]\ncompare = \"git:v1\"\nfail-on = [\"worse\"]\n");
  EXPECT_EQ(deck("gaps models/car_0000.rad"), 1) << err();
  EXPECT_TRUE(has("against git:v1: ")) << out();
}

TEST_F(GitRevision, HasToBeKnown) {
  EXPECT_EQ(deck("diff --git nowhere models/car_0000.rad"), 2);
  EXPECT_TRUE(complains("no revision 'nowhere'")) << err();
  EXPECT_EQ(deck("diff --git=--output=x models/car_0000.rad"), 2);
  EXPECT_FALSE(fs::exists(dir_ / "x"));
  EXPECT_EQ(deck("diff --git v1 models/car_0000.rad models/car_0000.rad"), 2);
  EXPECT_EQ(deck("diff models/car_0000.rad"), 2);
  write(dir_ / "models/new_0000.rad", sample("too_close"));
  EXPECT_EQ(deck("diff --git v1 models/new_0000.rad"), 3);
  EXPECT_TRUE(complains("git has no models/new_0000.rad")) << err();
  EXPECT_EQ(deck("gaps models/car_0000.rad --compare git:nowhere"), 2);
}

class ConvertCheck : public Daily {};

TEST_F(ConvertCheck, WritesNothingAndGroupsTheCauses) {
  write(dir_ / "decks/a_0000.rad", sample("variable_gap"));
  write(dir_ / "decks/b_0000.rad", sample("variable_gap"));
  write(dir_ / "decks/c_0000.rad", sample("clean_plates"));
  const std::size_t files = count_files(dir_ / "decks");
  const int code = deck("convert decks --version 110 --check");
  EXPECT_EQ(count_files(dir_ / "decks"), files);
  EXPECT_TRUE(has("decks  times  what")) << out() << err();
  EXPECT_TRUE(has("of 3 decks can be converted")) << out();
  EXPECT_EQ(code, 1) << out() << err();
  EXPECT_EQ(deck("convert decks --version 2022 --check"), 0) << out() << err();
  EXPECT_TRUE(has("3 of 3 decks can be converted.")) << out();
}

TEST_F(ConvertCheck, ARealConversionSaysItTheSameWay) {
  write(dir_ / "decks/a_0000.rad", sample("variable_gap"));
  write(dir_ / "decks/b_0000.rad", sample("variable_gap"));
  write(dir_ / "decks/c_0000.rad", sample("clean_plates"));
  EXPECT_EQ(deck("convert decks --version 110 -o out"), 1) << err();
  EXPECT_TRUE(complains("decks  times  what")) << err();
  EXPECT_TRUE(complains("left to a person, at")) << err();
  EXPECT_TRUE(complains("decks/a_0000.rad:")) << err();
  EXPECT_TRUE(complains("decks/b_0000.rad:")) << err();
  EXPECT_FALSE(fs::exists(dir_ / "out"));
  EXPECT_EQ(deck("convert decks --version 2018 -o out"), 0) << err();
  EXPECT_TRUE(complains("3 of 3 decks were converted.")) << err();
  EXPECT_FALSE(complains("left to a person")) << err();
  EXPECT_EQ(deck("convert decks --version 2018 -o out --quiet"), 0) << err();
  EXPECT_EQ(err(), "");
}

TEST_F(ConvertCheck, SeesWhatWritingWouldRefuse) {
  write(dir_ / "m_0000.rad", sample("clean_plates"));
  write(dir_ / "out/m_0000.rad", sample("too_close"));
  EXPECT_EQ(deck("convert m_0000.rad --version 2018 -o out --check"), 2) << out();
  EXPECT_EQ(read(dir_ / "out/m_0000.rad"), sample("too_close"));
  EXPECT_EQ(deck("convert m_0000.rad --version 2018 -o out --overwrite --check"), 0) << err();
  EXPECT_EQ(read(dir_ / "out/m_0000.rad"), sample("too_close"));
  EXPECT_EQ(deck("convert m_0000.rad --version 2018 --in-place --check"), 0) << err();
  EXPECT_EQ(read(dir_ / "m_0000.rad"), sample("clean_plates"));
  write(dir_ / "lost_0000.rad", std::string(begin) + "#include nowhere.inc\n/END\n");
  EXPECT_EQ(deck("convert m_0000.rad lost_0000.rad --version 2018 --check"), 3) << out();
  EXPECT_TRUE(has("1 of 2 decks can be converted; 1 cannot be read.")) << out();
}

}  // namespace
