// `deck replay` as a judge: what counts as equal.
#include <gtest/gtest.h>

#include <cmath>

#include "cycle/support.hpp"
#include "replay/replay.hpp"

namespace deck::cycle {
namespace {

const char* const header =
    "cycle,interface,node,n1,n2,n3,n4,t,dt1,dt12,xs_x,xs_y,xs_z,x1_x,x1_y,x1_z,x2_x,x2_y,x2_z,"
    "x3_x,x3_y,x3_z,x4_x,x4_y,x4_z,vs_x,vs_y,vs_z,v1_x,v1_y,v1_z,v2_x,v2_y,v2_z,v3_x,v3_y,v3_z,"
    "v4_x,v4_y,v4_z,ms,K0,gap,P0_in,F_x,F_y,F_z,K_nodal";

/// A node 0.4 above the middle of a unit-thick square of side 10 with gap 1, and what was recorded.
std::string state(const std::string& height, const std::string& recorded) {
  return "0,3,9,1,2,3,4,0,0,0,5,5," + height +
         ",0,0,0,10,0,0,10,10,0,0,10,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1,1000,1,0," + recorded + "\n";
}

ContactCard spring() {
  ContactCard card;
  card.viss = 0.0;
  return card;
}

std::string table(const std::string& rows) { return std::string(header) + "\n" + rows; }

TEST(ReplayJudge, SaysWhatIsWrongWithTheStates) {
  for (const char* text :
       {"", "cycle,interface\n1\n", "cycle,interface\n1,2\n", "interface,node\n"})
    EXPECT_NE(replay(spring(), text).error, "") << text;
  EXPECT_EQ(states_text("\x1f\x8b\x08 damaged"), std::nullopt);
  EXPECT_EQ(states_text("plain").value(), "plain");
}

// Recorded (3, 4, -12), computed nan: once counted as error 0.
TEST(ReplayJudge, NoNumberIsNeverEqualToAnother) {
  for (const char* recorded : {"3,4,-12,0", "nan,0,0,0", "0,0,inf,0", "-inf,0,0,0"}) {
    const ReplayReport r = replay(spring(), table(state("nan", recorded)));
    ASSERT_EQ(r.error, "");
    EXPECT_TRUE(std::isinf(r.max)) << recorded;
  }
  EXPECT_TRUE(std::isinf(replay(spring(), table(state("0.4", "nan,0,0,0"))).max));
}

TEST(ReplayJudge, EveryRecordedColumnIsComparedNotTheForceAlone) {
  // d = 0.4: F = 0.5 K0 p / d = 750, k_tan = 0.5 K0 / d^2 = 3125.
  const ReplayReport right = replay(spring(), table(state("0.4", "0,0,-750,3125")));
  ASSERT_EQ(right.columns.size(), 2u);
  EXPECT_LE(right.max, 1e-15);
  EXPECT_LE(right.columns[1].max, 1e-15);
  const ReplayReport wrong = replay(spring(), table(state("0.4", "0,0,-750,3126")));
  EXPECT_LE(wrong.max, 1e-15);
  EXPECT_EQ(wrong.columns[1].name, "K_nodal");
  EXPECT_NEAR(wrong.columns[1].max, 1.0 / 3126.0, 1e-12);
}

TEST(ReplayJudge, FrictionThatTheSolverUsedStandsForThatOfTheCard) {
  std::string row = state("0.4", "0,0,-750,3125");
  row.pop_back();
  const std::string still = "10,10,0,0,10,0,0,0,0,", sliding = "10,10,0,0,10,0,2,0,0,";
  row.replace(row.find(still), still.size(), sliding);
  const auto computed = [&](double fric, double visf, const std::string& names,
                            const std::string& cells) {
    ContactCard card = spring();
    card.fric = fric;
    card.visf = visf;
    ReplayOptions options;
    options.csv = true;
    const ReplayReport r =
        replay(card, std::string(header) + names + "\n" + row + cells + "\n", options);
    EXPECT_EQ(r.error, "");
    return r.csv;
  };
  const std::string names = ",mu0,c1,c2,c3,c4,c5,c6", used = ",0.3,0,0,0,0,0,0";
  const std::string expected = computed(0.3, 2.0, "", "");
  EXPECT_NE(expected, computed(0.0, 2.0, "", ""));
  EXPECT_NE(expected, computed(0.3, 1.0, "", ""));
  EXPECT_EQ(computed(0.0, 2.0, names, used), expected) << "the damping of the card, squared";
  EXPECT_EQ(computed(0.0, 1.0, names + ",visf", used + ",4"), expected) << "or that of the record";
}

}  // namespace
}  // namespace deck::cycle
