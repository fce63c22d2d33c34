// What a person sees fits the terminal: help within its width, places of the deck in one piece,
// colours that say how bad it is.
#include <regex>
#include <sstream>

#include "tools/command_line.hpp"

namespace {

using namespace deck::testing_support;

class Width : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    for (const char* name : {"crash_box", "too_close", "clean_plates"})
      write(dir_ / "samples" / (std::string(name) + "_0000.rad"),
            read(deck::test::source_dir() / "samples" / (std::string(name) + "_0000.rad")));
  }
  void TearDown() override { unsetenv("COLUMNS"); }
  int deck_at(int columns, const std::string& arguments) {
    setenv("COLUMNS", std::to_string(columns).c_str(), 1);
    return deck(arguments);
  }
  std::size_t matches(const char* pattern) const {
    const std::string text = out();
    const std::regex r(pattern);
    return static_cast<std::size_t>(
        std::distance(std::sregex_iterator(text.begin(), text.end(), r), {}));
  }
};

TEST_F(Width, HelpIsNoWiderThanTheTerminal) {
  for (const char* verb : {"", "lint", "params", "parts", "show", "diff", "gaps", "fix", "cycle",
                           "replay", "convert", "accuracy", "batch", "rules", "explain", "lsp"})
    for (const int columns : {80, 100}) {
      ASSERT_EQ(deck_at(columns, std::string(verb) + " --help"), 0) << verb;
      std::istringstream lines(out());
      for (std::string line; std::getline(lines, line);)
        EXPECT_LE(line.size(), static_cast<std::size_t>(columns)) << verb << ": " << line;
    }
}

TEST_F(Width, PlacesAreInOnePiece) {
  for (const int columns : {80, 100, 120}) {
    ASSERT_LE(deck_at(columns, "gaps samples/crash_box_0000.rad --worst 12"), 1);
    EXPECT_EQ(matches("samples/crash_box_0000\\.rad:[0-9]+:[0-9]+"), 12u) << columns << out();
  }
}

TEST_F(Width, RedIsWhatStopsTheSolver) {
  EXPECT_EQ(deck("gaps samples/crash_box_0000.rad --color always"), 1);
  EXPECT_GT(matches("\x1b\\[1;31m78 initial penetrations"), 0u);
  EXPECT_GT(matches("\x1b\\[1;31merror 611"), 0u);
  EXPECT_EQ(deck("gaps samples/too_close_0000.rad --color always"), 0);
  EXPECT_EQ(matches("\x1b\\[1;31m"), 0u);
  EXPECT_GT(matches("\x1b\\[33m16 initial penetrations"), 0u);
  EXPECT_EQ(deck("gaps samples/clean_plates_0000.rad --color always"), 0);
  EXPECT_GT(matches("\x1b\\[32mNo initial penetration"), 0u);
}

}  // namespace
