// The promises of `deck convert`: what it writes, where, and when it writes nothing.
#include <nlohmann/json.hpp>

#include "tools/command_line.hpp"

namespace {

using namespace deck::testing_support;
namespace fs = std::filesystem;

class Convert : public CommandLine {};

TEST_F(Convert, CopiesTheIncludeTreeByteForByte) {
  const std::string main = std::string(begin) + "#include sub/a.inc\r\n/END\n";
  const std::string a = "# \xe9 no line end, tab\t\r\n#include b.inc";
  write(dir_ / "m_0000.rad", main);
  write(dir_ / "sub/a.inc", a);
  write(dir_ / "sub/b.inc", "");
  ASSERT_EQ(deck("convert m_0000.rad --to rad -o copy"), 0) << err();
  EXPECT_EQ(read(dir_ / "copy/m_0000.rad"), main);
  EXPECT_EQ(read(dir_ / "copy/sub/a.inc"), a);
  EXPECT_TRUE(fs::exists(dir_ / "copy/sub/b.inc"));
  EXPECT_EQ(count_files(dir_ / "copy"), 3u) << "no temporary files";
}

TEST_F(Convert, KeepsIncludesFromAboveInPlace) {
  write(dir_ / "run/m_0000.rad",
        std::string(begin) + "#include ../common/a.inc\n#include ../run/b.inc\n/END\n");
  write(dir_ / "common/a.inc", "# a\n");
  write(dir_ / "run/b.inc", "# b\n");
  ASSERT_EQ(deck("convert run/m_0000.rad -o copy"), 0) << err();
  EXPECT_EQ(read(dir_ / "copy/common/a.inc"), "# a\n");
  EXPECT_EQ(read(dir_ / "copy/run/b.inc"), "# b\n");
  EXPECT_EQ(deck("params copy/run/m_0000.rad --no-geometry"), 0) << err();
}

TEST_F(Convert, NamesFilesItDoesNotCopy) {
  write(dir_ / "abs.inc", "# abs\n");
  write(dir_ / "m_0000.rad",
        std::string(begin) + "#include " + (dir_ / "abs.inc").string() + "\n/END\n");
  ASSERT_EQ(deck("convert m_0000.rad -o copy"), 0) << err();
  EXPECT_NE(err().find("abs.inc"), std::string::npos);
  EXPECT_EQ(count_files(dir_ / "copy"), 1u);
}

TEST_F(Convert, DoesNotOverwriteTheDeckItReads) {
  write(dir_ / "m_0000.rad", std::string(begin) + "/END\n");
  EXPECT_EQ(deck("convert m_0000.rad -o ."), 2);
  EXPECT_EQ(read(dir_ / "m_0000.rad"), std::string(begin) + "/END\n");
}

TEST_F(Convert, WritesNothingOfAnIncompleteTree) {
  write(dir_ / "m_0000.rad", std::string(begin) + "#include nowhere.inc\n/END\n");
  EXPECT_EQ(deck("convert m_0000.rad -o copy"), 3);
  EXPECT_FALSE(fs::exists(dir_ / "copy"));
}

/// A deck with one include that holds the interface.
class ConvertTwoFiles : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write(dir_ / "m_0000.rad", main_);
    write(dir_ / "sub/a.inc", contact);
  }
  const std::string main_ = std::string(begin) + "#include sub/a.inc\n/END\n";
};

TEST_F(ConvertTwoFiles, NeedsAPlaceToWriteTo) {
  EXPECT_EQ(deck("convert m_0000.rad"), 2);
  EXPECT_NE(err().find("--diff"), std::string::npos);
  EXPECT_EQ(deck("convert m_0000.rad -o x --in-place"), 2);
}

TEST_F(ConvertTwoFiles, DiffWritesNothingAndAppliesWithGit) {
  ASSERT_EQ(deck("convert m_0000.rad --units kg,m,s --diff"), 0) << err();
  const std::string diff = out();
  EXPECT_EQ(read(dir_ / "m_0000.rad"), main_);
  EXPECT_EQ(read(dir_ / "sub/a.inc"), contact);
  write(dir_ / "change.diff", diff);
  const std::string apply = "cd '" + dir_.string() + "' && git apply change.diff";
  if (std::system("git --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "git is not installed";
  ASSERT_EQ(std::system(apply.c_str()), 0) << diff;
  ASSERT_EQ(deck("convert m_0000.rad --units kg,m,s --diff"), 0) << err();
  EXPECT_EQ(out(), "") << "already in these units";
}

TEST_F(ConvertTwoFiles, InPlaceChangesOnlyFilesThatDifferAndKeepsBackups) {
  ASSERT_EQ(deck("convert m_0000.rad --version 2024 --in-place --backup"), 0) << err();
  EXPECT_EQ(read(dir_ / "m_0000.rad.orig"), main_);
  EXPECT_NE(read(dir_ / "m_0000.rad").find("      2024"), std::string::npos);
  EXPECT_EQ(read(dir_ / "sub/a.inc"), contact);
  EXPECT_FALSE(fs::exists(dir_ / "sub/a.inc.orig"));
}

TEST_F(ConvertTwoFiles, FlattenWritesOneFile) {
  ASSERT_EQ(deck("convert m_0000.rad --flatten -o one"), 0) << err();
  EXPECT_EQ(count_files(dir_ / "one"), 1u);
  EXPECT_NE(read(dir_ / "one/m_0000.rad").find(contact), std::string::npos);
}

TEST_F(ConvertTwoFiles, ConversionsSeeTheDeckAsTheOneBeforeLeftIt) {
  ASSERT_EQ(deck("convert m_0000.rad --flatten --units kg,m,s -o one"), 0) << err();
  const std::string text = read(dir_ / "one/m_0000.rad");
  EXPECT_EQ(count_files(dir_ / "one"), 1u);
  EXPECT_NE(text.find("0.001"), std::string::npos) << "Gap 1 mm in metres\n" << text;
}

TEST_F(ConvertTwoFiles, ARefusalNamesThePlaceAndWritesNothing) {
  write(dir_ / "sub/a.inc", "/UNKNOWN/KEYWORD/1\n1.0\n");
  EXPECT_EQ(deck("convert m_0000.rad --units kg,m,s -o x --report losses.json"), 1);
  EXPECT_NE(err().find("sub/a.inc:1"), std::string::npos) << err();
  EXPECT_NE(err().find("--partial"), std::string::npos);
  EXPECT_FALSE(fs::exists(dir_ / "x"));
  const auto refused = nlohmann::json::parse(read(dir_ / "losses.json"));
  ASSERT_EQ(refused["undecided"].size(), 1u);
  EXPECT_EQ(refused["undecided"][0]["file"], "sub/a.inc");
  EXPECT_EQ(refused["undecided"][0]["line"], 1);
  EXPECT_EQ(refused["undecided"][0]["keyword"], "/UNKNOWN/KEYWORD");
  EXPECT_EQ(refused["undecided"][0]["id"], 1);
  EXPECT_EQ(deck("convert m_0000.rad --units kg,m,s -o x --partial --report losses.json"), 1);
  EXPECT_TRUE(fs::exists(dir_ / "x/m_0000.rad"));
  const auto report = nlohmann::json::parse(read(dir_ / "losses.json"));
  ASSERT_EQ(report["undecided"].size(), 1u);
  EXPECT_EQ(report["undecided"][0]["line"], 1);
}

TEST_F(ConvertTwoFiles, WhatIsUndecidedEndsWithExitCodeOneAlsoWhereItIsAccepted) {
  write(dir_ / "sub/a.inc", "/UNKNOWN/KEYWORD/1\n1.0\n");
  EXPECT_EQ(deck("convert m_0000.rad --version 2018 -o x"), 1);
  EXPECT_FALSE(fs::exists(dir_ / "x"));
  EXPECT_EQ(deck("convert m_0000.rad --version 2018 -o x --allow-loss"), 1);
  EXPECT_TRUE(fs::exists(dir_ / "x/m_0000.rad"));
  EXPECT_NE(err().find("undecided 1"), std::string::npos) << err();
}

TEST_F(ConvertTwoFiles, StandardInputGoesToStandardOutput) {
  EXPECT_EQ(deck("convert - --version 2024 < m_0000.rad"), 2) << "two files for one output";
  ASSERT_EQ(deck("convert - --flatten --version 2024 < m_0000.rad"), 0) << err();
  EXPECT_NE(out().find("      2024"), std::string::npos);
}

TEST_F(ConvertTwoFiles, JsonAndBackGivesTheSameFiles) {
  ASSERT_EQ(deck("convert m_0000.rad --to json -o m.json"), 0) << err();
  ASSERT_EQ(deck("convert m.json --from json -o back"), 0) << err();
  EXPECT_EQ(read(dir_ / "back/m_0000.rad"), main_);
  EXPECT_EQ(read(dir_ / "back/sub/a.inc"), contact);
  ASSERT_EQ(deck("convert - --from json --to json < m.json"), 0) << err();
  const auto again = nlohmann::json::parse(out()),
             first = nlohmann::json::parse(read(dir_ / "m.json"));
  EXPECT_EQ(again["files"], first["files"]) << "a fixed point";
}

TEST_F(ConvertTwoFiles, JsonTakesAChangedValue) {
  ASSERT_EQ(deck("convert m_0000.rad --flatten --to json"), 0) << err();
  std::string text = out();
  const auto at = text.find("\"Gap\": 1.0");
  ASSERT_NE(at, std::string::npos) << text;
  text.replace(at, 10, "\"Gap\": 2.5");
  write(dir_ / "changed.json", text);
  ASSERT_EQ(deck("convert changed.json --from json -o back"), 0) << err();
  const std::string back = read(dir_ / "back/m_0000.rad");
  EXPECT_NE(back.find("                 2.5"), std::string::npos) << back;
}

TEST_F(ConvertTwoFiles, JsonRoundsOnRequestAndReportsIt) {
  ASSERT_EQ(deck("convert m_0000.rad --flatten --to json -o -"), 0) << err();
  EXPECT_FALSE(fs::exists(dir_ / "-")) << "standard output is no directory";
  std::string text = out();
  text.replace(text.find("\"Gap\": 1.0"), 10, "\"Gap\": 3.3333333333333335e-06");
  write(dir_ / "changed.json", text);
  EXPECT_EQ(deck("convert changed.json --from json -o back"), 3);
  EXPECT_NE(err().find("m_0000.rad, /INTER/TYPE10/2, card"), std::string::npos) << err();
  EXPECT_NE(err().find("--round"), std::string::npos) << err();
  EXPECT_EQ(deck("convert changed.json --from json -o back --round --report losses.json"), 0);
  const auto report = nlohmann::json::parse(read(dir_ / "losses.json"));
  ASSERT_EQ(report["approximated"].size(), 1u);
  EXPECT_EQ(report["approximated"][0]["field"], "Gap");
  EXPECT_EQ(report["approximated"][0]["old"], "3.3333333333333333e-06");
  EXPECT_EQ(deck("convert m_0000.rad --round -o x"), 2);
}

TEST_F(ConvertTwoFiles, DecksOfOneNameKeepTheirFolders) {
  for (const char* folder : {"x", "y"}) {
    write(dir_ / folder / "m_0000.rad", main_);
    write(dir_ / folder / "sub/a.inc", contact);
  }
  ASSERT_EQ(deck("convert x/m_0000.rad y/m_0000.rad --to json -o j"), 0) << err();
  EXPECT_TRUE(fs::exists(dir_ / "j/x/m_0000.json"));
  EXPECT_TRUE(fs::exists(dir_ / "j/y/m_0000.json"));
  ASSERT_EQ(deck("convert x/m_0000.rad y/m_0000.rad --version 2024 -o out"), 0) << err();
  EXPECT_EQ(read(dir_ / "out/x/sub/a.inc"), read(dir_ / "out/y/sub/a.inc"));
  EXPECT_NE(read(dir_ / "out/y/m_0000.rad").find("2024"), std::string::npos);
  // With names of their own they lie side by side, as one deck alone.
  fs::rename(dir_ / "y/m_0000.rad", dir_ / "y/n_0000.rad");
  fs::remove_all(dir_ / "j");
  ASSERT_EQ(deck("convert x/m_0000.rad y/n_0000.rad --to json -o j"), 0) << err();
  EXPECT_TRUE(fs::exists(dir_ / "j/n_0000.json"));
  // A deck that is named twice is one deck.
  fs::remove_all(dir_ / "j");
  EXPECT_EQ(deck("convert x/m_0000.rad x/m_0000.rad --to json -o j"), 0) << err();
  EXPECT_TRUE(fs::exists(dir_ / "j/m_0000.json"));
}

TEST_F(ConvertTwoFiles, SeveralDecksInJsonAreOneDocument) {
  write(dir_ / "n_0000.rad", main_);
  ASSERT_EQ(deck("convert m_0000.rad n_0000.rad --to json"), 0) << err();
  const auto document = nlohmann::json::parse(out());
  ASSERT_EQ(document["decks"].size(), 2u);
  EXPECT_EQ(document["decks"][1]["deck"]["path"], "n_0000.rad");
}

TEST_F(ConvertTwoFiles, BrokenJsonIsUnreadableInput) {
  write(dir_ / "broken.json", "{\"schema\": ");
  EXPECT_EQ(deck("convert broken.json --from json -o back"), 3);
  EXPECT_NE(err().find("broken.json"), std::string::npos);
  EXPECT_FALSE(fs::exists(dir_ / "back"));
}

const std::string engine_file =
    "# runs\n/RUN/m/1\n 2.5\n/TFILE\n0.01\n/ANIM/DT\n0. 0.5\n/DT/NODA/CST\n0.9 1e-4\n"
    "/RFILE/1\n 5000\n/MON/ON\n";
const std::string engine_file_in_ms =
    "# runs\n/RUN/m/1\n 2500.0\n/TFILE\n10.0\n/ANIM/DT\n0. 500.0\n/DT/NODA/CST\n0.9 1e-1\n"
    "/RFILE/1\n 5000\n/MON/ON\n";

class ConvertWithEngine : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write(dir_ / "run/m_0000.rad", std::string(begin) + "/END\n");
    write(dir_ / "run/m_0001.rad", engine_file);
  }
};

TEST_F(ConvertWithEngine, TimesAreConvertedAlong) {
  ASSERT_EQ(deck("convert run/m_0000.rad --units Mg,mm,ms -o new --report r.json"), 0) << err();
  EXPECT_EQ(read(dir_ / "new/m_0001.rad"), engine_file_in_ms);
  EXPECT_NE(read(dir_ / "r.json").find("Engine file: 4 times converted"), std::string::npos);
  ASSERT_EQ(deck("convert run -o tree --units Mg,mm,ms --verify"), 0) << err();
  EXPECT_EQ(read(dir_ / "tree/m_0001.rad"), engine_file_in_ms);
  ASSERT_EQ(deck("batch run -o all --verb 'convert --units Mg,mm,ms'"), 0) << out() << err();
  EXPECT_EQ(count_files(dir_ / "all") > 0, true);
  bool found = false;
  for (const auto& e : fs::recursive_directory_iterator(dir_ / "all"))
    found = found || (e.path().filename() == "m_0001.rad" && read(e.path()) == engine_file_in_ms);
  EXPECT_TRUE(found);
  ASSERT_EQ(deck("convert run/m_0000.rad --units Mg,mm,ms --in-place"), 0) << err();
  EXPECT_EQ(read(dir_ / "run/m_0001.rad"), engine_file_in_ms);
}

TEST_F(ConvertWithEngine, WithTheSameWorkingUnitsTheyAreCopied) {
  ASSERT_EQ(deck("convert run/m_0000.rad --version 2026 -o new --report r.json"), 0) << err();
  EXPECT_EQ(read(dir_ / "new/m_0001.rad"), engine_file);
  EXPECT_NE(read(dir_ / "r.json").find("Engine file: copied unchanged"), std::string::npos);
  ASSERT_EQ(deck("convert run/m_0000.rad --units Mg,mm,ms --keep-working-units -o same"), 0)
      << err();
  EXPECT_EQ(read(dir_ / "same/m_0001.rad"), engine_file);
}

TEST_F(ConvertWithEngine, AKeywordWhoseCellsAreNotKnownIsRefusedWithItsPlace) {
  write(dir_ / "run/m_0002.rad", "/RUN/m/2\n5.0\n/DAMP\n1 2 0.3\n/NOLINES\n");
  EXPECT_EQ(deck("convert run/m_0000.rad --units Mg,mm,ms -o new"), 1);
  EXPECT_NE(err().find("m_0002.rad:3:1: /DAMP"), std::string::npos) << err();
  EXPECT_FALSE(fs::exists(dir_ / "new"));
  EXPECT_EQ(deck("convert run/m_0000.rad --units Mg,mm,ms -o new --allow-loss"), 1);
  EXPECT_NE(err().find("undecided: /DAMP"), std::string::npos) << err();
  EXPECT_EQ(read(dir_ / "new/m_0002.rad"), "/RUN/m/2\n5000.0\n/DAMP\n1 2 0.3\n/NOLINES\n");
}

TEST_F(ConvertTwoFiles, ExtractionRefusesAnIdThatIsNoInterface) {
  EXPECT_EQ(deck("convert m_0000.rad --extract-contacts 77 -o x"), 2);
  EXPECT_NE(err().find("77"), std::string::npos);
  EXPECT_EQ(deck("convert m_0000.rad --extract-contacts seven -o x"), 2);
}

TEST_F(ConvertTwoFiles, WrongOptionsOfConversionsAreWrongUsage) {
  EXPECT_EQ(deck("convert m_0000.rad --units kg,mm -o x"), 2);
  EXPECT_EQ(deck("convert m_0000.rad --renumber nodes -o x"), 2);
  EXPECT_EQ(deck("convert m_0000.rad --version 2027 -o x"), 2);
  EXPECT_NE(err().find("110 to 140 and 2017 to 2026"), std::string::npos) << err();
  // No option makes these ids possible.
  EXPECT_EQ(deck("convert m_0000.rad --renumber inter-5000 -o x"), 2);
  EXPECT_EQ(err().find("--partial"), std::string::npos) << err();
  EXPECT_EQ(deck("convert - --version 2022 --in-place < m_0000.rad"), 2);
  EXPECT_EQ(out(), "");
  EXPECT_EQ(deck("convert m_0000.rad --allow-loss -o x"), 2);
  EXPECT_EQ(deck("convert m_0000.rad --to json --diff"), 2);
  EXPECT_EQ(deck("convert m_0000.rad --backup -o x"), 2);
}

TEST_F(Convert, RefusesToLeaveAnIncludeUnchangedThatHasToChange) {
  write(dir_ / "abs.inc", contact);
  write(dir_ / "m_0000.rad",
        std::string(begin) + "#include " + (dir_ / "abs.inc").string() + "\n/END\n");
  EXPECT_EQ(deck("convert m_0000.rad --units kg,m,s -o copy"), 2);
  EXPECT_NE(err().find("abs.inc"), std::string::npos);
  EXPECT_FALSE(fs::exists(dir_ / "copy"));
  EXPECT_EQ(deck("convert m_0000.rad --flatten --units kg,m,s -o copy"), 0) << err();
}

}  // namespace
