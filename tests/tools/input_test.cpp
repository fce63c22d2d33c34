// Input as it is: packed decks, names without their ending, words that were mistyped.
#include <gmock/gmock.h>

#include "text/shared/gzip.hpp"
#include "tools/command_line.hpp"

namespace deck {
namespace {

using namespace testing_support;
using testing::HasSubstr;
using testing::Not;

class Input : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    sample_ = read(test::source_dir() / "samples" / "too_close_0000.rad");
    ASSERT_FALSE(sample_.empty());
  }
  std::string sample_;
};

TEST_F(Input, APackedDeckIsReadAsItsTextIs) {
  write(dir_ / "plain_0000.rad", sample_);
  write(dir_ / "other/plain_0000.rad.gz", gzip(sample_));
  for (const char* verb : {"lint --format json", "params --json -", "gaps --json -"}) {
    const int code = deck(std::string(verb) + " plain_0000.rad");
    const std::string plain = out();
    EXPECT_EQ(deck(std::string(verb) + " other/plain_0000.rad.gz"), code) << verb << err();
    std::string packed = out();
    for (const std::string from = "other/plain_0000.rad.gz"; packed.find(from) != packed.npos;)
      packed.replace(packed.find(from), from.size(), "plain_0000.rad");
    EXPECT_EQ(packed, plain) << verb;
  }
  EXPECT_EQ(deck("lint - < other/plain_0000.rad.gz"), deck("lint - < plain_0000.rad"));
}

TEST_F(Input, ADamagedPackedDeckIsUnreadableAndSaysWhy) {
  const std::string packed = gzip(sample_);
  write(dir_ / "x_0000.rad.gz", packed.substr(0, packed.size() / 2));
  EXPECT_EQ(deck("lint x_0000.rad.gz"), 3);
  EXPECT_THAT(err(), HasSubstr("x_0000.rad.gz: is packed with gzip and incomplete: after "));
}

TEST_F(Input, ARewrittenPackedDeckIsPackedAgain) {
  write(dir_ / "x_0000.rad.gz", gzip(sample_));
  ASSERT_EQ(deck("convert x_0000.rad.gz --renumber inter+70 --in-place --backup"), 0) << err();
  const auto now = gunzip(read(dir_ / "x_0000.rad.gz"), 1 << 20);
  ASSERT_TRUE(now.ok()) << now.error().message;
  EXPECT_THAT(*now, HasSubstr("/INTER/TYPE7/71"));
  EXPECT_EQ(read(dir_ / "x_0000.rad.gz.orig"), gzip(sample_));
  ASSERT_EQ(deck("convert x_0000.rad.gz -o out"), 0) << err();
  EXPECT_EQ(read(dir_ / "out/x_0000.rad.gz"), gzip(*now));
  // Another packed deck is not written over.
  write(dir_ / "out/x_0000.rad.gz", gzip(sample_));
  EXPECT_EQ(deck("convert x_0000.rad.gz -o out"), 2);
  EXPECT_THAT(err(), HasSubstr("--overwrite"));
  EXPECT_EQ(deck("convert x_0000.rad.gz --renumber inter+1 --diff"), 0);
  EXPECT_THAT(out(), HasSubstr("x_0000.rad\n"));
  EXPECT_THAT(out(), Not(HasSubstr(".gz")));
}

TEST_F(Input, AFileThatTheSystemMakesIsNoEmptyInclude) {
  write(dir_ / "x_0000.rad", std::string(begin) + "#include /proc/self/environ\n/END\n");
  EXPECT_EQ(deck("lint x_0000.rad --no-config"), 3);
  EXPECT_THAT(out(), HasSubstr("the system makes it as it is read"));
}

TEST_F(Input, ALineOfAFileOutsideTheFolderThatIsNoDeckIsNotShown) {
  write(dir_ / "secret", "password = 1\n");
  write(dir_ / "d/secret", "password = 2\n");
  write(dir_ / "more.inc",
        "/NODE\n         x                 0.0                 0.0           0.0\n");
  write(dir_ / "d/x_0000.rad",
        sample_.substr(0, sample_.rfind("/END")) +
            "#include ../secret\n#include secret\n#include ../more.inc\n/END\n");
  deck("lint d/x_0000.rad --no-config --per-rule 0 -v");
  EXPECT_THAT(out(), HasSubstr("secret:1:1"));
  EXPECT_THAT(out(), Not(HasSubstr("password = 1")));
  EXPECT_THAT(out(), HasSubstr("password = 2"));
  EXPECT_THAT(out(), HasSubstr("         x                 0.0")) << "it holds a keyword";
}

TEST_F(Input, LintLooksAtGeometryUnlessItIsToldNotTo) {
  write(dir_ / "x_0000.rad", sample_);
  for (const char* options : {"", " --geometry"}) {
    deck(std::string("lint x_0000.rad --no-config") + options);
    EXPECT_THAT(out(), HasSubstr("[DK301]")) << options;
    EXPECT_THAT(out(), Not(HasSubstr("geometry:"))) << options;
  }
  const auto is_off = [&](const std::string& options) {
    deck("lint x_0000.rad " + options);
    EXPECT_THAT(out(), Not(HasSubstr("[DK301]"))) << options;
    EXPECT_THAT(out(), HasSubstr("geometry: penetrations")) << options;
  };
  is_off("--no-config --no-geometry");
  write(dir_ / ".decklint.toml", "geometry = false\n");
  is_off("");
  deck("lint x_0000.rad --geometry");
  EXPECT_THAT(out(), HasSubstr("[DK301]")) << "an option goes before the file";
}

TEST_F(Input, ADirectoryHasItsPackedDecksOnce) {
  write(dir_ / "models/a_0000.rad.gz", gzip(sample_));
  write(dir_ / "models/b_0000.rad", sample_);
  write(dir_ / "models/b_0000.rad.gz", gzip(sample_));
  EXPECT_EQ(deck("batch -o results models --verb params"), 0) << err();
  EXPECT_TRUE(fs::exists(dir_ / "results/a_0000.json"));
  EXPECT_TRUE(fs::exists(dir_ / "results/b_0000.json"));
  EXPECT_FALSE(fs::exists(dir_ / "results/b_0000.rad.json"));
}

TEST_F(Input, ANameWithoutItsEndingFindsTheDeckAndSaysSo) {
  write(dir_ / "car_0000.rad", sample_);
  EXPECT_EQ(deck("params car"), 0);
  EXPECT_THAT(err(), HasSubstr("deck: note: car is not there; reading car_0000.rad"));
  EXPECT_EQ(deck("params car_0000"), 0);
  EXPECT_EQ(deck("params car -q"), 0);
  EXPECT_EQ(err(), "");
  EXPECT_EQ(deck("convert car --renumber inter+1 --diff"), 0);
  EXPECT_THAT(err(), HasSubstr("reading car_0000.rad"));
  write(dir_ / "van_0000.rad.gz", gzip(sample_));
  EXPECT_EQ(deck("params van"), 0);
  write(dir_ / "bus.rad", sample_);
  EXPECT_EQ(deck("params bus"), 0);
  write(dir_ / "car", sample_);
  EXPECT_EQ(deck("params car"), 0);
  EXPECT_EQ(err(), "") << "what is there stands for itself";
}

TEST_F(Input, AMistypedFileNamesTheClosestOne) {
  write(dir_ / "car_0000.rad", sample_);
  EXPECT_EQ(deck("params car_000.rad"), 3);
  EXPECT_THAT(err(), HasSubstr("did you mean 'car_0000.rad'?"));
  EXPECT_EQ(deck("params CAR_0000.RAD"), 3);
  EXPECT_THAT(err(), HasSubstr("did you mean 'car_0000.rad'?"));
  EXPECT_EQ(deck("params nothing_like_it.txt"), 3);
  EXPECT_THAT(err(), Not(HasSubstr("did you mean")));
}

TEST_F(Input, EveryWrongCommandLineIsAnErrorOfOneForm) {
  struct Case {
    const char *words, *message;
  };
  for (const auto& [words, message] : {
           Case{"lint --colour never x", "unknown option '--colour'; did you mean '--color'?"},
           Case{"gaps --HTML a.html x", "unknown option '--HTML'; did you mean '--html'?"},
           Case{"gaps --max-dept=3 x", "unknown option '--max-dept'; did you mean '--max-depth'?"},
           Case{"lint -z x", "unknown option '-z'"},
           Case{"rules foo", "unexpected argument 'foo'"},
           Case{"lint", "DECK is missing"},
           Case{"gaps --threads 5000 x", "--threads: '5000' is not a whole number from 0 to 1024"},
           Case{"gaps --threads a x", "--threads: 'a' is not a whole number from 0 to 1024"},
           Case{"gaps x --threads", "--threads needs a value: N"},
           Case{"lint x --format json --format sarif",
                "--format takes one value but is given more than once"},
           Case{"lint --color AUTO x",
                "'AUTO' is not one of auto, always, never; did you mean 'auto'?"},
           Case{"fix x --strategy movenodes", "did you mean 'move-nodes'?"},
           Case{"fix x --strategy inacti --inacti 4",
                "'4' is not one of -1, 0, 1, 2, 3, 5, 6, 1000"},
           Case{"fix x --strategy inacti --step nan", "'nan' is not a number from 0.05 to 1"},
           Case{"gaps --max-memory much x",
                "'much' is not a number of bytes, such as 500MB or 2GB"},
           Case{"gaps --interface 3a x", "--interface: '3a' is not a number"},
           Case{"show x", "expected DECK WHAT"},
       }) {
    EXPECT_EQ(deck(words), 2) << words;
    EXPECT_THAT(err(), testing::StartsWith("deck: error: ")) << words;
    EXPECT_THAT(err(), HasSubstr(message)) << words;
    const std::string_view all(words);
    const std::string verb(all.substr(0, all.find(' ')));
    EXPECT_THAT(err(), HasSubstr("Run 'deck " + verb + " --help'")) << words;
  }
}

TEST_F(Input, HelpOfAVerbIsFoundBothWays) {
  EXPECT_EQ(deck("lint --help"), 0);
  const std::string page = out();
  EXPECT_EQ(deck("help lint"), 0);
  EXPECT_EQ(out(), page);
  EXPECT_EQ(deck("--help"), 0);
  const std::string all = out();
  EXPECT_EQ(deck("help"), 0);
  EXPECT_EQ(out(), all);
  EXPECT_EQ(deck("help lnit"), 2);
  EXPECT_THAT(err(), HasSubstr("there is no verb 'lnit'; did you mean 'lint'?"));
}

TEST_F(Input, AnInterfaceThatIsNotThereNamesTheClosestOfALongList) {
  std::string text = begin;
  for (int id = 101; id < 151; ++id)
    text += "/INTER/TYPE10/" + std::to_string(id) + std::string(contact).substr(15);
  write(dir_ / "many_0000.rad", text + "/END\n");
  EXPECT_EQ(deck("gaps many_0000.rad --interface 1499"), 2);
  EXPECT_THAT(err(), HasSubstr("30 more; did you mean 149?"));
}

}  // namespace
}  // namespace deck
