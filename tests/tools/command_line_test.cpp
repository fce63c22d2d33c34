// The promises of the command line: exit codes, where output goes, what convert writes.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}
std::size_t count_files(const fs::path& dir) {
  std::size_t n = 0;
  for (const auto& e : fs::recursive_directory_iterator(dir)) n += e.is_regular_file() ? 1 : 0;
  return n;
}

constexpr const char* begin =
    "#RADIOSS STARTER\n/BEGIN\nrun\n      2022\n"
    "                  Mg                  mm                   s\n"
    "                  Mg                  mm                   s\n";
constexpr const char* contact =
    "/INTER/TYPE10/2\ntied\n         1         2\n"
    "                                                         1.0\n\n";

/// Runs `deck` in a directory of its own.
class CommandLine : public testing::Test {
 protected:
  CommandLine() : dir_(fs::temp_directory_path() / ("command_line_" + std::to_string(getpid()))) {
    fs::create_directories(dir_);
  }
  ~CommandLine() override {
    std::error_code ec;
    fs::remove_all(dir_, ec);
  }
  void SetUp() override {
    if (!fs::exists(binary())) GTEST_SKIP() << "no " << binary();
  }
  static fs::path binary() { return fs::path(DECK_BINARY_DIR) / "tools" / "deck"; }
  /// Exit code; what it prints is in out() and err().
  int deck(const std::string& arguments) const {
    const std::string command = "cd '" + dir_.string() + "' && '" + binary().string() + "' " +
                                arguments + " > '" + (dir_ / "stdout").string() + "' 2> '" +
                                (dir_ / "stderr").string() + "'";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string out() const { return read(dir_ / "stdout"); }
  std::string err() const { return read(dir_ / "stderr"); }
  fs::path dir_;
};

TEST_F(CommandLine, WrongUsageIsTwo) {
  EXPECT_EQ(deck(""), 2);
  EXPECT_EQ(deck("params"), 2);
  EXPECT_EQ(deck("params --no-such-option x.rad"), 2);
  EXPECT_EQ(deck("params --color sometimes x.rad"), 2);
}

TEST_F(CommandLine, UnknownVerbNamesTheClosestOne) {
  EXPECT_EQ(deck("parms x.rad"), 2);
  EXPECT_NE(err().find("did you mean 'params'"), std::string::npos);
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

TEST_F(CommandLine, ConvertCopiesTheIncludeTreeByteForByte) {
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

TEST_F(CommandLine, ConvertKeepsIncludesFromAboveInPlace) {
  write(dir_ / "run/m_0000.rad",
        std::string(begin) + "#include ../common/a.inc\n#include ../run/b.inc\n/END\n");
  write(dir_ / "common/a.inc", "# a\n");
  write(dir_ / "run/b.inc", "# b\n");
  ASSERT_EQ(deck("convert run/m_0000.rad -o copy"), 0) << err();
  EXPECT_EQ(read(dir_ / "copy/common/a.inc"), "# a\n");
  EXPECT_EQ(read(dir_ / "copy/run/b.inc"), "# b\n");
  EXPECT_EQ(deck("params copy/run/m_0000.rad --no-geometry"), 0) << err();
}

TEST_F(CommandLine, ConvertNamesFilesItDoesNotCopy) {
  write(dir_ / "abs.inc", "# abs\n");
  write(dir_ / "m_0000.rad",
        std::string(begin) + "#include " + (dir_ / "abs.inc").string() + "\n/END\n");
  ASSERT_EQ(deck("convert m_0000.rad -o copy"), 0) << err();
  EXPECT_NE(err().find("abs.inc"), std::string::npos);
  EXPECT_EQ(count_files(dir_ / "copy"), 1u);
}

TEST_F(CommandLine, ConvertDoesNotOverwriteTheDeckItReads) {
  write(dir_ / "m_0000.rad", std::string(begin) + "/END\n");
  EXPECT_EQ(deck("convert m_0000.rad -o ."), 2);
  EXPECT_EQ(read(dir_ / "m_0000.rad"), std::string(begin) + "/END\n");
}

TEST_F(CommandLine, ConvertWritesNothingOfAnIncompleteTree) {
  write(dir_ / "m_0000.rad", std::string(begin) + "#include nowhere.inc\n/END\n");
  EXPECT_EQ(deck("convert m_0000.rad -o copy"), 3);
  EXPECT_FALSE(fs::exists(dir_ / "copy"));
}

}  // namespace
