// Lint of the Engine files beside a deck.
#include "contact/small_deck.hpp"
#include "lint/support.hpp"
#include "text/shared/gzip.hpp"

namespace deck {
namespace {

using test::Folder;
using test::lint_file;
using test::Linted;

/// A deck "car" with one interface, id 3, shells 1 and 2, parts 1 and 2, and its Engine files.
class EngineFilesOfADeck : public testing::Test {
 protected:
  Linted lint(const std::vector<std::pair<std::string, std::string>>& files,
              std::string_view deck = "@/INTER/TYPE7/3\n") {
    for (const auto& [name, text] : files) folder_.write(name, text);
    return lint_file(folder_.write("car_0000.rad", example_deck(deck, SchemaSet::built_in()).main));
  }
  std::string where(const Linted& run, RuleId rule) const {
    const Finding* d = run.find(rule);
    if (d == nullptr) return "nowhere";
    const std::string text = run.deck->sources.where(d->span);
    return text.substr(text.rfind('/') + 1);
  }
  Folder folder_;
};

TEST_F(EngineFilesOfADeck, GiveNoFindingWhereAllIsRight) {
  const Linted run =
      lint({{"car_0001.rad",
             "#RADIOSS ENGINE\n/RUN/car/1/\n  10.0\n/TFILE/4\n0.1\n/ANIM/DT\n0. 1.\n"
             "/DEL/INTER\n3\n/DEL/SHELL\n1, 2\n/H3D/PART\n1 2\n/ANIM/SENSOR\n1 0.5\n"},
            {"car_0002.rad", "/RUN/car/2\n20.0\n/ANIM/DT\n12. 5.\n"}});
  for (const Finding& d : run.result.findings)
    EXPECT_NE(id_number(d.rule) / 100, 8) << id_text(d.rule) << " " << d.message;
}

TEST_F(EngineFilesOfADeck, AreNamedWhereTheFindingStands) {
  EXPECT_EQ(where(lint({{"car_0001.rad", "/RUN/car/1\n1.\n$ a comment\n/DEL/INTER\n 3,  4\n"}}),
                  RuleId::DK804),
            "car_0001.rad:5:6");
}

TEST_F(EngineFilesOfADeck, AreThoseOfItsNameUpToTheFirstNumberThatIsMissing) {
  EXPECT_FALSE(lint({{"bus_0001.rad", "/TFILE\n1.\n"}}).fires(RuleId::DK800));
  EXPECT_FALSE(lint({{"car_0001.rad", "/RUN/car/1\n1.\n"}, {"car_0003.rad", "/TFILE\n1.\n"}})
                   .fires(RuleId::DK800));
  EXPECT_FALSE(lint({{"car_0001.rad", "/RUN/car/1\r\n1."}}).fires(RuleId::DK803));
  EXPECT_EQ(where(lint({{"car_0001.rad", ""}}), RuleId::DK800), "car_0001.rad:1:1");
}

TEST_F(EngineFilesOfADeck, MayBePackedWhereTheDeckIs) {
  folder_.write("car_0001.rad.gz", gzip("/TFILE\n1.\n"));
  const std::string text = example_deck("@/INTER/TYPE7/3\n", SchemaSet::built_in()).main;
  EXPECT_TRUE(lint_file(folder_.write("car_0000.rad.gz", gzip(text))).fires(RuleId::DK800));
}

TEST_F(EngineFilesOfADeck, ThatCannotBeReadAreNamedAsNotChecked) {
  std::filesystem::create_directory(std::filesystem::path(folder_.path()) / "car_0001.rad");
  const Linted run = lint({});
  ASSERT_FALSE(run.result.not_checked.empty());
  EXPECT_NE(run.result.not_checked.back().what.find("car_0001.rad"), std::string::npos);
  EXPECT_EQ(run.result.not_checked.back().why.find("car_0001.rad"), std::string::npos);
}

TEST_F(EngineFilesOfADeck, DecideWhichStepTheMeshAllows) {
  test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 9, 0, 0).node(3, 0, 9, 0).node(4, 0, 0, 9).node(5, 2, 2, -1);
  d.solid_part(1).tetra(1, 1, 1, 2, 3, 4).tetra(1, 2, 2, 3, 4, 5).group("/GRNOD/NODE/2", {5});
  d.segments("/SURF/SEG/1", {{1, 2, 3}}).add("@/INTER/TYPE7/1 Gapmin=2 Stfac=100");
  const std::string deck = folder_.write("car_0000.rad", d.text());
  const auto run = [&] {
    return test::lint_geometry_of(std::move(*read_deck(deck, SchemaSet::built_in())));
  };
  EXPECT_TRUE(run().fires(RuleId::DK402)) << run().list();
  folder_.write("car_0001.rad", "/RUN/car/1\n1.\n/DT1/BRICK\n");  // steps of tetrahedra: unknown
  EXPECT_FALSE(run().fires(RuleId::DK402));
}

TEST_F(EngineFilesOfADeck, AboveTheBoundAreNotRead) {
  const std::string deck =
      folder_.write("car_0000.rad", example_deck("", SchemaSet::built_in()).main);
  folder_.write("car_0001.rad", "/TFILE\n" + std::string(5000, ' ') + "\n");
  auto read = read_deck(deck, SchemaSet::built_in());
  ASSERT_TRUE(read);
  Limits limits;
  limits.map_threshold = 4096;
  const EngineFiles engine = read_engine_files(*read, limits);
  EXPECT_TRUE(engine.files.empty());
  EXPECT_EQ(engine.unread.size(), 1u);
}

TEST_F(EngineFilesOfADeck, AreHeldAgainstTheDeckAndTheRunBefore) {
  struct Row {
    const char *first, *second;
    RuleId rule;
    std::size_t count;
    Severity severity;
  };
  using enum RuleId;
  const Row rows[] = {
      {"/RUN/car/1\n10.\n", "/RUN/car/2\n5.\n", DK803, 1, Severity::warning},
      // Brick 1 and shell 9 do not exist, nor any shell from 3 to 800 or up to 0; of a range some
      // ids may be missing.
      {"/RUN/car/1\n10.\n/DEL/BRICK\n1\n/DEL/SHELL/1\n1 900\n3 800\n-5 0\n/DEL/SHELL\n2 9\n", "",
       DK804, 4, Severity::warning},
      {"/RUN/car/1\n10.\n/DEL/SHELL/1\n0 0\n/DEL/INTER\n0\n", "", DK804, 0, {}},
      {"/RUN/bus/2\n10.\n", "", DK801, 1, Severity::info},
      {"/RUN/bus/2\n10.\n", "", DK802, 1, Severity::info},
      // The first state is written all the same.
      {"/RUN/car/1\n4.\n/ANIM/DT\n0. 5.\n/H3D/DT\n7. 1.\n", "", DK805, 2, Severity::info},
      {"/RUN/car/1\n10.\n", "/RUN/car/2\n12.\n/TFILE\n3.\n", DK805, 1, Severity::info},
  };
  for (const Row& row : rows) {
    std::filesystem::remove(folder_.path() + "/car_0002.rad");
    std::vector<std::pair<std::string, std::string>> files = {{"car_0001.rad", row.first}};
    if (row.second[0] != 0) files.emplace_back("car_0002.rad", row.second);
    const Linted run = lint(files, "");
    ASSERT_EQ(run.count(row.rule), row.count) << row.first << run.list();
    if (row.count > 0) {
      EXPECT_EQ(run.find(row.rule)->severity, row.severity) << row.first << run.list();
    }
    if (row.rule == DK803) {
      EXPECT_NE(run.find(DK803)->message.find("ends at 5, the run before it at 10"),
                std::string::npos);
    }
  }
}

TEST(EngineFile, DoesNotRemoveByItsStepWhereDtminOfTheCardGoesFirst) {
  const std::string engine = "@file deck_0001.rad\n/RUN/deck/1\n1.0\n/DT/INTER/DEL\n0.9 1.0\n";
  EXPECT_TRUE(test::lint_geometry("@/INTER/TYPE7/1 Gapmin=3.5\n" + engine).fires(RuleId::DK808));
  EXPECT_FALSE(test::lint_geometry("@/INTER/TYPE7/1 Gapmin=3.5 dtmin=1.e-20\n" + engine)
                   .fires(RuleId::DK808));
  EXPECT_FALSE(test::lint_geometry("@/INTER/TYPE10/1 Gap=3.5\n" + engine).fires(RuleId::DK808));
}

}  // namespace
}  // namespace deck
