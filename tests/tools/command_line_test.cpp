// The promises of the command line: exit codes and where output goes.
#include "tools/command_line.hpp"

#include <nlohmann/json.hpp>

namespace {

using namespace deck::testing_support;
namespace fs = std::filesystem;

TEST_F(CommandLine, WrongUsageIsTwo) {
  EXPECT_EQ(deck(""), 2);
  EXPECT_EQ(deck("params"), 2);
  EXPECT_EQ(deck("params --no-such-option x.rad"), 2);
  EXPECT_EQ(deck("params --color sometimes x.rad"), 2);
}

TEST_F(CommandLine, NumbersThatAreNoneOrWithoutBoundsAreTwo) {
  write(dir_ / "a_0000.rad", std::string(begin) + contact + "/END\n");
  for (const char* value : {"nan", "inf", "-1", "1e11", "1e999", "x", ""}) {
    const std::string quoted = " '" + std::string(value) + "'";
    EXPECT_EQ(deck("batch a_0000.rad -o out --timeout" + quoted), 2) << value;
    EXPECT_FALSE(fs::exists(dir_ / "out"));
  }
  for (const char* value : {"nan", "inf", "1e999"})
    EXPECT_EQ(deck("cycle a_0000.rad --time " + std::string(value)), 2) << value;
  for (const char* value : {"nan", "-1", "inf"})
    EXPECT_EQ(deck("cycle a_0000.rad --dt " + std::string(value)), 2) << value;
}

TEST_F(CommandLine, AContactThatPushedAtAnEarlierStepIsNoCleanVerdict) {
  const std::string deck_with_forces =
      "cycle '" + (deck::test::source_dir() / "samples" / "crash_box_0000.rad").string() + "'";
  // Parts that fly apart: forces at the start, none any more at the end.
  const std::string apart = deck_with_forces +
                            " --velocity 1=0,0,1e6 --velocity 2=0,1e6,0 "
                            "--velocity 4=1e6,0,0 --interface 1 --steps 2 --dt 1";
  ASSERT_EQ(deck(apart), 0) << err();
  EXPECT_NE(out().find("1 of 1 evaluation before had forces, the first at step 0"),
            std::string::npos)
      << out();
  EXPECT_EQ(deck(apart + " --fail-on-force"), 1);
}

TEST_F(CommandLine, StepsThatLeaveTheNumbersAreRefused) {
  const std::string plates =
      "cycle '" + (deck::test::source_dir() / "samples" / "clean_plates_0000.rad").string() + "'";
  EXPECT_EQ(deck(plates + " --velocity 1=1e308,0,0 --steps 3 --dt 1e30"), 2);
  EXPECT_NE(err().find("too far to compute with"), std::string::npos) << err();
  EXPECT_EQ(deck(plates + " --velocity 1=1,0,0 --steps 3 --dt 1e-3"), 0) << err();
}

TEST_F(CommandLine, WhatIfTakesWholeNumbersForFlags) {
  write(dir_ / "a_0000.rad", std::string(begin) + contact + "/END\n");
  for (const char* value : {"Inacti=5.9", "Inacti=4294967302", "Igap=-1", "Irem_gap=1e0",
                            "Gapmin=nan", "Gapmin=1e300", "Inacti="})
    EXPECT_EQ(deck("gaps a_0000.rad --what-if 2:" + std::string(value)), 2) << value;
  // Taken; what is found is that the deck has neither nodes nor segments.
  EXPECT_EQ(deck("gaps a_0000.rad --what-if 2:Gapmin=1.5,Inacti=6"), 1) << err();
}

TEST_F(CommandLine, AFlagBeyondThirtyTwoBitsDoesNotWrapAround) {
  const std::string wide =
      "/INTER/TYPE10/2\ntied\n         1         2\n"
      "                                                         1.0\n"
      "                    4294967297\n";
  write(dir_ / "a_0000.rad", std::string(begin) + wide + "/END\n");
  EXPECT_EQ(deck("lint a_0000.rad --format json"), 1);
  EXPECT_NE(out().find("DK023"), std::string::npos) << out();
  EXPECT_EQ(deck("params a_0000.rad --no-geometry --json -"), 1) << err();
  EXPECT_NE(err().find("DK023"), std::string::npos) << err();
  EXPECT_EQ(out().find(": 4294967297"), std::string::npos);
  EXPECT_NE(out().find("2147483647"), std::string::npos) << out();
}

TEST_F(CommandLine, FixMendsMoreThanAThousandFindingsOfARule) {
  std::string text = begin;
  for (int i = 0; i < 1500; ++i)
    text += "/INTER/TYPE11/" + std::to_string(5000 + i) +
            "\nlate\n         1         1\n                 1.0                 0.1              "
            "   0.5\n";
  write(dir_ / "many_0000.rad", text + "/END\n");
  deck("lint many_0000.rad --unsafe-fixes -q");
  EXPECT_EQ(deck("lint many_0000.rad --diff"), 1);
  EXPECT_EQ(out(), "");
}

TEST_F(CommandLine, UnknownVerbNamesTheClosestOne) {
  EXPECT_EQ(deck("parms x.rad"), 2);
  EXPECT_NE(err().find("did you mean 'params'"), std::string::npos);
}

TEST_F(CommandLine, AnOptionIsNotTheValueOfTheOneBeforeIt) {
  write(dir_ / "a_0000.rad", std::string(begin) + "/END\n");
  EXPECT_EQ(deck("gaps a_0000.rad --json --threads 1"), 2);
  EXPECT_NE(err().find("--json needs a value: FILE; '--threads' is an option"), std::string::npos)
      << err();
  EXPECT_EQ(deck("gaps a_0000.rad --json -q"), 2);
  EXPECT_EQ(deck("lint a_0000.rad -o --threads=1"), 2);
  EXPECT_FALSE(std::filesystem::exists(dir_ / "--threads"));
  EXPECT_EQ(deck("gaps a_0000.rad --json ./--threads"), 0) << err();
  EXPECT_TRUE(std::filesystem::exists(dir_ / "--threads"));
}

TEST_F(CommandLine, HelpAndVersionAreZero) {
  EXPECT_EQ(deck("--help"), 0);
  EXPECT_NE(out().find("Exit codes"), std::string::npos);
  EXPECT_EQ(deck("params --help"), 0);
  EXPECT_NE(out().find("Examples"), std::string::npos);
  EXPECT_EQ(deck("--version"), 0);
  EXPECT_TRUE(out().starts_with("deck "));
}

TEST_F(CommandLine, UnreadableInputIsThree) {
  EXPECT_EQ(deck("params missing_0000.rad"), 3);
  EXPECT_NE(err().find("missing_0000.rad"), std::string::npos);
  write(dir_ / "inc_0000.rad", std::string(begin) + "#include nowhere.inc\n/END\n");
  EXPECT_EQ(deck("params inc_0000.rad"), 3);
  EXPECT_NE(err().find("inc_0000.rad:7:"), std::string::npos);
  EXPECT_NE(err().find("nowhere.inc"), std::string::npos);
}

TEST_F(CommandLine, OutputThatCannotBeWrittenIsTwo) {
  write(dir_ / "a_0000.rad", std::string(begin) + contact + "/END\n");
  EXPECT_EQ(deck("params a_0000.rad --no-geometry -q --json nowhere/a.json"), 2);
  EXPECT_FALSE(fs::exists(dir_ / "nowhere"));
  if (fs::exists("/dev/full")) {
    const std::string command = "cd '" + dir_.string() + "' && '" + binary().string() +
                                "' params a_0000.rad --no-geometry > /dev/full 2> /dev/null";
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 2);
  }
}

TEST_F(CommandLine, JsonOnStandardOutputIsAlone) {
  write(dir_ / "a_0000.rad", std::string(begin) + contact + "/END\n");
  ASSERT_EQ(deck("params a_0000.rad --no-geometry --json -"), 0) << err();
  const auto document = nlohmann::json::parse(out());
  EXPECT_EQ(document["schema"]["id"], "deck/params");
  EXPECT_EQ(document["deck"]["path"], "a_0000.rad");
  EXPECT_EQ(document["interfaces"][0]["parameters"]["Gap"]["value"], 1.0);
  EXPECT_EQ(document["interfaces"][0]["parameters"]["Gap"]["source"]["line"], 10);
}

TEST_F(CommandLine, SeveralDecksMakeOneDocument) {
  write(dir_ / "a_0000.rad", std::string(begin) + contact + "/END\n");
  write(dir_ / "b_0000.rad", std::string(begin) + "/END\n");
  ASSERT_EQ(deck("params a_0000.rad b_0000.rad --no-geometry --json all.json -q"), 0) << err();
  EXPECT_EQ(out(), "");
  const auto document = nlohmann::json::parse(read(dir_ / "all.json"));
  EXPECT_EQ(document["schema"]["id"], "deck/params");
  ASSERT_EQ(document["decks"].size(), 2u);
  EXPECT_EQ(document["decks"][1]["deck"]["path"], "b_0000.rad");
}

TEST_F(CommandLine, StandardInputIsADeck) {
  write(dir_ / "a_0000.rad", std::string(begin) + contact + "/END\n");
  ASSERT_EQ(deck("params - --no-geometry < a_0000.rad"), 0) << err();
  EXPECT_NE(out().find("/INTER/TYPE10/2"), std::string::npos);
}

TEST_F(CommandLine, ColourIsOffInFilesUnlessAskedFor) {
  write(dir_ / "a_0000.rad", std::string(begin) + contact + "/END\n");
  ASSERT_EQ(deck("params a_0000.rad --no-geometry"), 0);
  EXPECT_EQ(out().find('\x1b'), std::string::npos);
  ASSERT_EQ(deck("params a_0000.rad --no-geometry --color always"), 0);
  EXPECT_NE(out().find('\x1b'), std::string::npos);
}

}  // namespace
