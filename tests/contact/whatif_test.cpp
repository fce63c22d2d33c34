// What-if evaluation: other values for one interface give what a deck with them would give.
#include <gtest/gtest.h>

#include "contact/shared/what_if_text.hpp"
#include "contact/small_deck.hpp"

namespace deck::test {
namespace {

SmallDeck quad(const std::string& card) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(101, 3, 4, 0.4).node(102, 6, 4, 1.3).shell_part(1, 2).shell(1, 1, 1, 2, 3, 4);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {101, 102}).group("/LINE/SURF/1", {1});
  return d.add(card);
}

void expect_same(const Contact& a, const Contact& b) {
  EXPECT_EQ(a.gapmin, b.gapmin);
  EXPECT_EQ(a.gapmax, b.gapmax);
  EXPECT_EQ(a.igap, b.igap);
  EXPECT_EQ(a.inacti, b.inacti);
  EXPECT_EQ(a.irem_gap, b.irem_gap);
  EXPECT_EQ(a.fpenmax, b.fpenmax);
  EXPECT_EQ(a.gap_scale, b.gap_scale);
  EXPECT_EQ(a.mesh_fraction, b.mesh_fraction);
  ASSERT_EQ(a.penetrations.size(), b.penetrations.size());
  for (std::size_t i = 0; i < a.penetrations.size(); ++i) {
    EXPECT_EQ(a.penetrations[i].depth, b.penetrations[i].depth);
    EXPECT_EQ(a.penetrations[i].gap, b.penetrations[i].gap);
    EXPECT_EQ(a.penetrations[i].action, b.penetrations[i].action);
    EXPECT_EQ(a.penetrations[i].gap0, b.penetrations[i].gap0);
  }
}

TEST(WhatIf, EqualsTheDeckWithThatCard) {
  Built asked(quad("@/INTER/TYPE7/1 Gapmin=1"));
  SceneOptions options;
  WhatIf w;
  w.interface_id = 1;
  w.Gapmin = 1.5;
  w.Inacti = 6;
  w.Fpenmax = 0.9;
  options.what_if = {w};
  asked.build(options);
  expect_same(asked.contact(),
              Built(quad("@/INTER/TYPE7/1 Gapmin=1.5 Inacti=6 Fpenmax=0.9")).contact());
  w = {};
  w.interface_id = 1;
  w.Gapmin = 0.1;
  w.Igap = 2;
  w.Fscalegap = 0.5;
  w.Gapmax = 0.45;
  options.what_if = {w};
  asked.build(options);
  expect_same(asked.contact(),
              Built(quad("@/INTER/TYPE7/1 Gapmin=0.1 Igap=2 Fscalegap=0.5 Gapmax=0.45")).contact());
  w = {};
  w.interface_id = 1;
  w.Igap = 3;
  w.mesh_size = 0.05;
  w.Irem_gap = 2;
  options.what_if = {w};
  asked.build(options);
  expect_same(asked.contact(),
              Built(quad("@/INTER/TYPE7/1 Gapmin=1 Igap=3 %mesh_size=0.05 Irem_gap=2")).contact());
}

TEST(WhatIf, ZeroAsksForTheDefault) {
  Built asked(quad("@/INTER/TYPE7/1 Gapmin=1 Inacti=6"));
  SceneOptions options;
  WhatIf w;
  w.interface_id = 1;
  w.Gapmin = 0;
  w.Inacti = 1000;
  options.what_if = {w};
  asked.build(options);
  EXPECT_DOUBLE_EQ(asked.contact().gapmin, 2);
  EXPECT_EQ(asked.contact().inacti, 0);
}

TEST(WhatIf, OtherInterfacesAndTheModelStayAsTheyAre) {
  const SmallDeck d = quad("@/INTER/TYPE7/1 Gapmin=1").add("@/INTER/TYPE7/2 Gapmin=1");
  Built asked(d);
  const Built plain(d);
  SceneOptions options;
  WhatIf w;
  w.interface_id = 2;
  w.Inacti = 3;
  options.what_if = {w};
  asked.build(options);
  expect_same(asked.contact(1), plain.contact(1));
  EXPECT_EQ(asked.contact(2).penetrations.at(0).action, PenetrationAction::node_moved);
  EXPECT_EQ(asked.model.nodes.z, plain.model.nodes.z);
}

TEST(WhatIf, FieldsThatATypeDoesNotHaveChangeNothing) {
  Built asked(quad("@/INTER/TYPE10/1 Gap=1").add("@/INTER/TYPE19/2 surf_IDs=1 surf_IDm=1"));
  const Built plain(quad("@/INTER/TYPE10/1 Gap=1").add("@/INTER/TYPE19/2 surf_IDs=1 surf_IDm=1"));
  SceneOptions options;
  WhatIf w;
  w.interface_id = 1;
  w.Inacti = 6;
  w.Igap = 1;
  w.Fpenmax = 0.1;
  options.what_if = {w, w};
  options.what_if[1].Inacti.reset();
  options.what_if[1].Igap.reset();
  options.what_if[1].interface_id = 2;
  asked.build(options);
  expect_same(asked.contact(1), plain.contact(1));
  expect_same(asked.contact(2), plain.contact(2));
}

// Their cards have a largest gap for each side, and TYPE25 Gap_scale.
TEST(WhatIf, GapsOfType24AndType25AreTriedUnderTheNamesOfTheirCards) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(11, 5, 5, 1.4);
  d.node(12, 6, 5, 200).node(13, 5, 6, 200).shell_part(1, 2).shell_part(2, 1.5);
  d.shell(1, 1, 1, 2, 3, 4).shell3(2, 2, 11, 12, 13);
  d.group("/SURF/PART/2", {1}).group("/GRNOD/NODE/1", {11});
  d.add("@/INTER/TYPE25/1 surf_ID2=2 grnd_IDs=1 Inacti=5");
  d.add("@/INTER/TYPE24/2 surf_ID2=2 grnd_IDs=1 Inacti=5");
  Built b(d);
  const auto depth = [&](const std::string& text) {
    const auto w = parse_what_if(text);
    EXPECT_TRUE(w.ok()) << text;
    for (const InterBase* inter : b.interfaces.ordered) {
      if (inter->id == w->interface_id) {
        EXPECT_TRUE(check_what_if(*w, *inter).ok()) << text;
      }
    }
    SceneOptions options;
    options.what_if = {*w};
    b.build(options);
    const PenetrationRow* row = b.row(b.contact(w->interface_id), 11);
    return row == nullptr ? 0 : row->depth;
  };
  EXPECT_NEAR(depth("1:Inacti=5"), 0.35, 1e-12);
  EXPECT_NEAR(depth("1:Gap_scale=0.9"), 0.175, 1e-12);
  EXPECT_NEAR(depth("1:Gapmax=0.72"), 0.04, 1e-12);
  EXPECT_NEAR(depth("2:Gapmax=0.72"), 0.04, 1e-12);
  const auto refused = check_what_if(*parse_what_if("2:Gap_scale=0.9"), *b.interfaces.ordered[1]);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("TYPE24 has no field Gap_scale"), std::string::npos);
}

TEST(WhatIf, AnotherIgapFindsTheFactorThatTheCardHolds) {
  Built asked(quad("@/INTER/TYPE7/1 Igap=1 Fscalegap=0.5 Gapmax=0.45 Gapmin=0.1"));
  SceneOptions options;
  WhatIf w;
  w.interface_id = 1;
  w.Igap = 2;
  options.what_if = {w};
  asked.build(options);
  expect_same(asked.contact(),
              Built(quad("@/INTER/TYPE7/1 Igap=2 Fscalegap=0.5 Gapmax=0.45 Gapmin=0.1")).contact());
}

TEST(WhatIf, AnotherIgapOfAType19FindsItsIremGap) {
  Built asked(quad("@/INTER/TYPE19/1 Igap=4 Gapmin=0.1"));
  EXPECT_EQ(asked.contact().irem_gap, 2);
  EXPECT_EQ(asked.contact(1, ContactRole::edges).irem_gap, 2);
  SceneOptions options;
  WhatIf w;
  w.interface_id = 1;
  w.Igap = 1;
  options.what_if = {w};
  asked.build(options);
  EXPECT_EQ(asked.contact().irem_gap, 1);
  EXPECT_EQ(asked.contact(1, ContactRole::edges).irem_gap, 1);
}

}  // namespace
}  // namespace deck::test
