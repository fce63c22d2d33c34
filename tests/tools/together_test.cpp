// Several decks of one call, files in use elsewhere, outputs over decks: no bytes are lost.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/shared/hash.hpp"
#include "tools/command_line.hpp"

namespace {

using namespace deck::testing_support;
namespace fs = std::filesystem;

/// Decks a and b that share an include with a tied contact, whose gap has a unit.
class Together : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    put("a", "");
    put("b", "");
    write(dir_ / "common/x.inc", contact);
  }
  void put(const std::string& name, const std::string& more) const {
    write(dir_ / name / (name + "_0000.rad"), main_deck(more));
  }
  static std::string main_deck(const std::string& more) {
    return std::string(begin) + more + "#include ../common/x.inc\n/END\n";
  }
  std::string shared() const { return read(dir_ / "common/x.inc"); }
};

TEST_F(Together, TheReportHasWhatIsSharedOnce) {
  write(dir_ / "common/x.inc", std::string(contact) + "/UNKNOWN/KEYWORD/1\n1.0\n");
  deck("convert a/a_0000.rad b/b_0000.rad --units kg,m,s --partial -o out --report r.json");
  EXPECT_EQ(nlohmann::json::parse(read(dir_ / "r.json"))["undecided"].size(), 1u);
}

TEST_F(Together, ResultsAreNotWrittenOverDecks) {
  const std::string a = main_deck(""), b = main_deck("");
  for (const char* call :
       {"params --no-geometry --json a/a_0000.rad b/b_0000.rad",
        "gaps a/a_0000.rad --json a/a_0000.rad", "gaps --csv a/a_0000.rad b/b_0000.rad",
        "gaps --html a/a_0000.rad b/b_0000.rad", "cycle --json a/a_0000.rad b/b_0000.rad",
        "accuracy --html a/a_0000.rad b/b_0000.rad",
        "lint --write-baseline a/a_0000.rad b/b_0000.rad",
        "lint -o sarif=a/a_0000.rad b/b_0000.rad",
        "convert --report a/a_0000.rad b/b_0000.rad --units kg,m,s -o out",
        "fix --strategy inacti --json a/a_0000.rad b/b_0000.rad",
        "batch -o results --json a/a_0000.rad b/b_0000.rad", "rules --json a/a_0000.rad",
        "params --no-geometry b/b_0000.rad --json common/x.inc",
        "lint b/b_0000.rad --json b/../common/x.inc"}) {
    EXPECT_EQ(deck(call), 2) << call << err();
    EXPECT_NE(err().find("nothing was written"), std::string::npos) << call << err();
    EXPECT_EQ(read(dir_ / "a/a_0000.rad"), a) << call;
    EXPECT_EQ(read(dir_ / "b/b_0000.rad"), b) << call;
    EXPECT_EQ(shared(), contact) << call;
  }
}

TEST_F(Together, AnOutputThatIsReadUnderAnotherNameIsRefused) {
  write(dir_ / "common/x.inc", "# nothing that looks like a deck\n");
  fs::create_symlink("common/x.inc", dir_ / "out.json");
  EXPECT_EQ(deck("params a/a_0000.rad --no-geometry --json out.json"), 2);
  EXPECT_NE(err().find("this call reads it"), std::string::npos) << err();
  EXPECT_EQ(shared(), "# nothing that looks like a deck\n");
}

TEST_F(Together, TwoOutputsOfOneFileAreRefusedUnderAnyOfItsNames) {
  fs::create_directory(dir_ / "out");
  fs::create_directory_symlink("out", dir_ / "link");
  for (const char* second : {"out/x", "out/../out/x", "link/x"}) {
    EXPECT_EQ(deck("lint a/a_0000.rad -o json=out/x -o junit=" + std::string(second)), 2) << second;
    EXPECT_NE(err().find("two outputs go to"), std::string::npos) << err();
    EXPECT_FALSE(fs::exists(dir_ / "out/x")) << second;
  }
  EXPECT_EQ(deck("lint a/a_0000.rad -o json=x -o junit=./x"), 2) << "no part of it is there yet";
  EXPECT_LE(deck("lint a/a_0000.rad -o json=out/x -o junit=link/y"), 1) << err();
}

TEST_F(Together, SettingsThatTheCallReadsAreNoOutput) {
  ASSERT_LE(deck("lint a/a_0000.rad --no-config --write-baseline base.json"), 1);
  const std::string baseline = read(dir_ / "base.json");
  EXPECT_EQ(deck("lint a/a_0000.rad --no-config --baseline base.json --json base.json"), 2);
  EXPECT_EQ(read(dir_ / "base.json"), baseline);
  write(dir_ / "a/.decklint.toml", "ignore = [\"DK221\"]\n");
  EXPECT_EQ(deck("lint a/a_0000.rad -o junit=a/.decklint.toml"), 2);
  EXPECT_EQ(read(dir_ / "a/.decklint.toml"), "ignore = [\"DK221\"]\n");
}

TEST_F(Together, ARefusedOutputMeansThatNoOtherWasWritten) {
  write(dir_ / "common/x.inc", "# nothing that looks like a deck\n");
  EXPECT_EQ(deck("gaps a/a_0000.rad --json new.json --csv common/x.inc"), 2);
  EXPECT_NE(err().find("nothing was written"), std::string::npos) << err();
  EXPECT_FALSE(fs::exists(dir_ / "new.json"));
}

TEST_F(Together, WhatABaselineHidesNoMoreIsListed) {
  write(dir_ / "common/x.inc", std::string(contact) + "/TITLE\n\tx\n");
  ASSERT_LE(deck("lint a/a_0000.rad --no-config --write-baseline base.json"), 1);
  write(dir_ / "common/x.inc", "/TITLE\nx\n");
  deck("lint a/a_0000.rad --no-config --baseline base.json --json lint.json");
  EXPECT_NE(err().find("no longer occur"), std::string::npos) << err();
  const auto json = nlohmann::json::parse(read(dir_ / "lint.json"));
  ASSERT_FALSE(json["baseline_stale"].empty());
  EXPECT_NE(json["baseline_stale"][0]["file"].get<std::string>().find("x.inc"), std::string::npos);
}

TEST_F(Together, AnotherDeckInTheDirectoryIsReplacedOnlyOnRequest) {
  const std::string older = main_deck("/TITLE\nsomebody else's\n");
  write(dir_ / "out/a/a_0000.rad", older);
  EXPECT_EQ(deck("convert a/a_0000.rad -o out"), 2);
  EXPECT_NE(err().find("--overwrite"), std::string::npos) << err();
  EXPECT_EQ(read(dir_ / "out/a/a_0000.rad"), older);
  EXPECT_FALSE(fs::exists(dir_ / "out/common")) << "all or nothing";
  EXPECT_EQ(deck("convert a/a_0000.rad -o out --overwrite"), 0) << err();
  EXPECT_EQ(read(dir_ / "out/a/a_0000.rad"), main_deck(""));
  EXPECT_EQ(deck("convert a/a_0000.rad -o out"), 0) << "the same bytes are no obstacle" << err();
}

TEST_F(Together, WhateverLiesInTheDirectoryIsReplacedOnlyOnRequest) {
  for (const char* edited :
       {"         1                 0.0                 0.0                 0.0\n",
        "//SUBMODEL/1\n", "# only notes\n", "by hand\n", ""}) {
    write(dir_ / "out/common/x.inc", edited);
    EXPECT_EQ(deck("convert a/a_0000.rad -o out"), 2) << edited;
    EXPECT_EQ(read(dir_ / "out/common/x.inc"), edited);
  }
}

TEST_F(Together, NoLinkInTheDirectoryIsFollowed) {
  write(dir_ / "home/notes", "precious\n");
  fs::create_directories(dir_ / "out/common");
  fs::create_symlink("../../home/notes", dir_ / "out/common/x.inc");
  EXPECT_EQ(deck("convert a/a_0000.rad -o out --overwrite"), 2);
  EXPECT_NE(err().find("out/common/x.inc is a symbolic link"), std::string::npos) << err();
  fs::remove_all(dir_ / "out/common");
  fs::create_directory_symlink("../home", dir_ / "out/common");
  EXPECT_EQ(deck("convert a/a_0000.rad -o out"), 2);
  EXPECT_EQ(deck("convert a/a_0000.rad --to json -o out/common/x_0000.json"), 0) << err();
  EXPECT_EQ(read(dir_ / "home/notes"), "precious\n");
}

TEST_F(Together, AListThatCannotBePrintedLeavesNoDoubtThatDecksWereWritten) {
  const std::string command = "cd '" + dir_.string() + "' && '" + binary().string() +
                              "' convert a/a_0000.rad --root a --renumber inter+10 --in-place "
                              "> /dev/full 2> stderr";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_NE(shared().find("/INTER/TYPE10/12"), std::string::npos) << shared();
  EXPECT_NE(err().find("the decks were written"), std::string::npos) << err();
}

TEST_F(Together, AResultThatIsReadIsNotReplaced) {
  ASSERT_EQ(deck("convert a/a_0000.rad -o out"), 0) << err();
  EXPECT_EQ(deck("convert a/a_0000.rad out/a/a_0000.rad -o out --units kg,m,s"), 2);
  EXPECT_EQ(read(dir_ / "out/a/a_0000.rad"), main_deck(""));
}

TEST_F(Together, AnotherDeckOfTheCallIsNotTheTarget) {
  write(dir_ / "out/a/a_0000.rad", main_deck(""));
  write(dir_ / "out/common/x.inc", contact);
  EXPECT_EQ(deck("convert a/a_0000.rad out/a/a_0000.rad -o out --overwrite --units kg,m,s"), 2);
  EXPECT_EQ(read(dir_ / "out/common/x.inc"), contact);
}

TEST_F(Together, AReadingVerbLeavesAnInterruptedRewritingAlone) {
  const std::string temporary = (dir_ / "common/.x.inc.1-0.tmp").string();
  write(temporary, "/TITLE\nnew\n");
  const fs::path note = dir_ / "a/.a_0000.rad.unfinished";
  write(note, fmt::format("deck unfinished 3\n1-0\t{:016x}\t{:016x}\t{}\nend\n",
                          deck::content_hash(contact), deck::content_hash("/TITLE\nnew\n"),
                          (dir_ / "common/x.inc").string()));
  fs::permissions(note, fs::perms::owner_read | fs::perms::owner_write);
  for (const char* call :
       {"lint a/a_0000.rad --no-config --fail-on never", "params a/a_0000.rad --no-geometry",
        "gaps a/a_0000.rad", "convert a/a_0000.rad -o out", "convert a/a_0000.rad --flatten --diff",
        "lint a/a_0000.rad --no-config --fail-on never --fix --diff"}) {
    deck(call);
    EXPECT_NE(err().find("was interrupted"), std::string::npos) << call << err();
    EXPECT_EQ(shared(), contact) << call;
    EXPECT_TRUE(fs::exists(note) && fs::exists(temporary)) << call;
  }
  ASSERT_EQ(deck("convert a/a_0000.rad --root a --units Mg,mm,s --in-place"), 0) << err();
  EXPECT_NE(err().find("was finished: 1 file"), std::string::npos) << err();
  EXPECT_EQ(shared(), "/TITLE\nnew\n");
  EXPECT_FALSE(fs::exists(note) || fs::exists(temporary));
}

TEST_F(Together, AnInterruptedRewritingOfAnEngineFileIsFinished) {
  write(dir_ / "a/a_0001.rad", "/RUN/a/1\n1.0\n");
  write(dir_ / "a/.a_0001.rad.1-0.tmp", "/RUN/a/1\n2.0\n");
  const fs::path note = dir_ / "a/.a_0000.rad.unfinished";
  write(note, fmt::format("deck unfinished 3\n1-0\t{:016x}\t{:016x}\t{}\nend\n",
                          deck::content_hash("/RUN/a/1\n1.0\n"),
                          deck::content_hash("/RUN/a/1\n2.0\n"), (dir_ / "a/a_0001.rad").string()));
  fs::permissions(note, fs::perms::owner_read | fs::perms::owner_write);
  deck("lint a/a_0000.rad --root a --no-config --select DK093 --fix");
  EXPECT_NE(err().find("was finished: 1 file"), std::string::npos) << err();
  EXPECT_EQ(read(dir_ / "a/a_0001.rad"), "/RUN/a/1\n2.0\n");
  EXPECT_FALSE(fs::exists(note));
}

TEST_F(Together, BatchDoesNotFollowLinksInTheDirectoryOfResults) {
  write(dir_ / "precious", "precious\n");
  write(dir_ / "home/thesis", "precious\n");
  fs::create_directories(dir_ / "results/.batch");
  for (const char* name : {"a_0000.json", "summary.json", "index.html", ".batch/a_0000.record"})
    fs::create_symlink(dir_ / "precious", dir_ / "results" / name);
  EXPECT_LE(deck("batch -o results a/a_0000.rad --verb 'params --no-geometry'"), 1) << err();
  EXPECT_EQ(read(dir_ / "precious"), "precious\n");
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(dir_ / "results/a_0000.json")));
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(dir_ / "results/summary.json")));
  // A link in place of the directory of its own notes is refused, and one in place of the lock.
  fs::remove_all(dir_ / "results");
  fs::create_directories(dir_ / "results");
  fs::create_directory_symlink(dir_ / "home", dir_ / "results/.batch");
  EXPECT_EQ(deck("batch -o results a/a_0000.rad"), 2);
  EXPECT_EQ(count_files(dir_ / "home"), 1u);
  fs::remove(dir_ / "results/.batch");
  fs::create_directories(dir_ / "results/.batch");
  fs::create_symlink(dir_ / "made", dir_ / "results/.batch/lock");
  EXPECT_EQ(deck("batch -o results a/a_0000.rad"), 2);
  EXPECT_FALSE(fs::exists(dir_ / "made"));
}

}  // namespace
