// What the checks of targets say, where they point, and which other place they name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lint/support.hpp"

namespace deck::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// "line:column message (other line: note)" of every finding of a rule; lines begin after /BEGIN's.
std::vector<std::string> said_by(RuleId rule, const std::string& blocks) {
  const Linted run = lint_example("@bare\n" + blocks);
  const auto place = [&](const Span& span) { return run.deck->sources.position(span); };
  constexpr int before = 6;  // lines up to the second one of units
  std::vector<std::string> out;
  for (const Diagnostic& d : run.result.diagnostics) {
    if (d.rule != rule) continue;
    const Position at = place(d.span);
    std::string text = std::to_string(static_cast<int>(at.line) - before) + ":" +
                       std::to_string(at.column) + " " + d.message;
    for (const auto& [span, note] : d.notes)
      text +=
          " (" + std::to_string(static_cast<int>(place(span).line) - before) + ": " + note + ")";
    out.push_back(text);
  }
  return out;
}

std::string cells(std::initializer_list<const char*> ids) {
  std::string out;
  for (const char* id : ids) out += std::string(10 - std::string_view(id).size(), ' ') + id;
  return out + "\n";
}

std::string bcs(const char* group) { return "/BCS/7\nfixed\n   111 111" + cells({"0", group}); }

const std::string nodes =
    "/NODE\n"
    "         1                 0.0                 0.0                 0.0\n"
    "         2                10.0                 0.0                 0.0\n";
const std::string group_5 = "/GRNOD/NODE/5\ng\n         1\n";

TEST(MissingTargetText, NamesTheIdAndTheOneOutsideTheSubmodel) {
  const std::string end = "//ENDSUB\n";
  EXPECT_THAT(
      said_by(RuleId::DK120, nodes + bcs("5")),
      ElementsAre("6:21 grnod_ID of /BCS 7 is 5, and there is no /GRNOD or /SET of that id"));
  EXPECT_THAT(said_by(RuleId::DK120, nodes + group_5 + bcs("5")), IsEmpty());
  for (const int offset : {1, 100}) {
    const std::string sub = "//SUBMODEL/3\ns\n" + cells({std::to_string(offset).c_str()});
    const std::string id = std::to_string(5 + offset), by = std::to_string(offset);
    EXPECT_THAT(said_by(RuleId::DK120, nodes + group_5 + sub + bcs("5") + end),
                ElementsAre("12:21 grnod_ID of /BCS 7 is " + id +
                            ", and there is no /GRNOD or /SET of that id; 5 exists outside the "
                            "submodel, whose offset is " +
                            by));
    EXPECT_THAT(said_by(RuleId::DK120, nodes + group_5 + sub + bcs("6") + end),
                ElementsAre("12:21 grnod_ID of /BCS 7 is " + std::to_string(6 + offset) +
                            ", and there is no /GRNOD or /SET of that id"));
  }
}

TEST(MissingTargetText, ATableCountsByEveryNumberOfItsHeader) {
  const auto fires = [](const std::string& table, const char* id) {
    return lint_example("@/MAT/LAW76/5 Rho_I=1.0 E=2.0 Nu=0.3 TAB_ID1=" + std::string(id) + "\n" +
                        table)
        .fires(RuleId::DK120);
  };
  const std::string table = "/TABLE/3/9\ntable\n         1\n         1\n";
  EXPECT_FALSE(fires(table, "9"));
  EXPECT_FALSE(fires(table, "3"));
  EXPECT_TRUE(fires(table, "8"));
  EXPECT_TRUE(fires("/TABLE/0/7\ntable\n         1\n", "8"));
  EXPECT_TRUE(fires("/MOVE_FUNCT/9\nm\n", "9")) << "not every block is a table";
  const auto inside = [&](const char* id) {
    return lint_example("//SUBMODEL/3\ns\n       100\n" + table +
                        "@/MAT/LAW76/5 Rho_I=1.0 E=2.0 Nu=0.3 TAB_ID1=" + id + "\n//ENDSUB\n")
        .fires(RuleId::DK120);
  };
  EXPECT_FALSE(inside("9"));
  EXPECT_TRUE(inside("8"));
}

TEST(EmptyTargetText, LeadsToTheGroupOrTheSet) {
  const std::string load = "/CLOAD/4\nl\n" + cells({"0", "X", "0", "0", "8"});
  EXPECT_THAT(said_by(RuleId::DK121, nodes + "/GRNOD/NODE/8\nnothing\n\n" + load),
              ElementsAre("9:41 grnod_ID of /CLOAD 4 is 8, and /GRNOD 8 is empty (4: it is "
                          "defined here)"));
  EXPECT_THAT(said_by(RuleId::DK121, nodes + "/SET/GENERAL/8\nnothing\nNODE\n" + load),
              ElementsAre("9:41 grnod_ID of /CLOAD 4 is 8, and /SET 8 is empty (4: it is "
                          "defined here)"));
  EXPECT_THAT(said_by(RuleId::DK121, nodes + "/GRNOD/NODE/8\nsome\n         2\n" + load),
              IsEmpty());
}

TEST(RequiredTargetText, PointsAtTheCellOrAtTheHeader) {
  const std::string sensor = "/SENSOR/DISP/3\napart\n                0.01\n";
  EXPECT_THAT(said_by(RuleId::DK122, nodes + sensor),
              ElementsAre("4:1 node_ID1 of /SENSOR/DISP 3 names no node",
                          "4:1 node_ID2 of /SENSOR/DISP 3 names no node"));
  EXPECT_THAT(said_by(RuleId::DK122, nodes + sensor + cells({"1", "0"})),
              ElementsAre("7:11 node_ID2 of /SENSOR/DISP 3 names no node"));
  EXPECT_THAT(said_by(RuleId::DK122, nodes + sensor + cells({"1", "2"})), IsEmpty());
}

TEST(ActsOnNothingText, TellsNoneFromOneThatIsNotThere) {
  const auto motion = [](const char* group) {
    return "/IMPVEL/6\nv\n" + cells({"0", "X", "0", "0", group});
  };
  EXPECT_THAT(said_by(RuleId::DK138, nodes + motion("0")),
              ElementsAre("6:41 grnod_ID of /IMPVEL 6 names no /GRNOD"));
  EXPECT_THAT(said_by(RuleId::DK138, nodes + motion("77")),
              ElementsAre("6:41 grnod_ID of /IMPVEL 6 is 77, and there is no /GRNOD or /SET of "
                          "that id"));
  EXPECT_THAT(said_by(RuleId::DK138, nodes + group_5 + motion("5")), IsEmpty());
}

TEST(TwiceText, LeadsToTheFirstOne) {
  const std::string late = "/SENSOR/TIME/9\nlate\n                 1.0\n";
  EXPECT_THAT(
      said_by(RuleId::DK128, late + "/SENSOR/TIME/8\nlate\n                 1.0\n" + late + late),
      ElementsAre("7:1 the id 9 of /SENSOR/TIME is used twice (1: first used here)",
                  "10:1 the id 9 of /SENSOR/TIME is used twice (1: first used here)"));
  // The number of a submodel counts with its offset.
  const std::string inside = "//SUBMODEL/3\ns\n         2\n/SENSOR/TIME/7\nl\n//ENDSUB\n";
  EXPECT_THAT(said_by(RuleId::DK128, late + inside),
              ElementsAre("7:1 the id 9 of /SENSOR/TIME is used twice (1: first used here)"));
  const std::string six = "@/FRICTION/6 C1=0.5\n";
  const Linted run = lint_example(six + "@/FRICTION/7 C1=0.5\n" + six + six);
  ASSERT_EQ(run.count(RuleId::DK191), 2u) << run.list();
  const Diagnostic& d = *run.find(RuleId::DK191);
  EXPECT_EQ(d.message, "/FRICTION 6 is defined twice");
  ASSERT_EQ(d.notes.size(), 1u);
  EXPECT_EQ(d.notes[0].second, "first defined here");
  EXPECT_LT(d.notes[0].first.offset, d.span.offset);
}

}  // namespace
}  // namespace deck::test
