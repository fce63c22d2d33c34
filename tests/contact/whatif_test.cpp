// What-if evaluation: other values for one interface give what a deck with them would give.
#include <gtest/gtest.h>

#include <tuple>

#include "contact/shared/reported.hpp"
#include "contact/small_deck.hpp"

namespace deck::test {
namespace {

SmallDeck quad(const std::string& card) { return plate_and_nodes(card, 0.4, 1.3); }

void expect_same(const Contact& a, const Contact& b) {
  EXPECT_EQ(std::tie(a.gapmin, a.gapmax, a.igap, a.inacti, a.irem_gap, a.fpenmax, a.gap_scale),
            std::tie(b.gapmin, b.gapmax, b.igap, b.inacti, b.irem_gap, b.fpenmax, b.gap_scale));
  EXPECT_EQ(a.mesh_fraction, b.mesh_fraction);
  ASSERT_EQ(a.penetrations.size(), b.penetrations.size());
  for (std::size_t i = 0; i < a.penetrations.size(); ++i) {
    const PenetrationRow &p = a.penetrations[i], &q = b.penetrations[i];
    EXPECT_EQ(std::tie(p.depth, p.gap, p.action, p.gap0),
              std::tie(q.depth, q.gap, q.action, q.gap0));
  }
}

SceneOptions with(const std::string& what_if) {
  SceneOptions options;
  options.what_if = {*parse_what_if(what_if)};
  return options;
}

TEST(WhatIf, EqualsTheDeckWithThatCard) {
  struct Case {
    const char *card, *what_if, *same;
  };
  const Case cases[] = {
      {"TYPE7/1 Gapmin=1", "1:Gapmin=1.5,Inacti=6,Fpenmax=0.9",
       "TYPE7/1 Gapmin=1.5 Inacti=6 Fpenmax=0.9"},
      {"TYPE7/1 Gapmin=1", "1:Gapmin=0.1,Igap=2,Fscalegap=0.5,Gapmax=0.45",
       "TYPE7/1 Gapmin=0.1 Igap=2 Fscalegap=0.5 Gapmax=0.45"},
      {"TYPE7/1 Gapmin=1", "1:Igap=3,%mesh_size=0.05,Irem_gap=2",
       "TYPE7/1 Gapmin=1 Igap=3 %mesh_size=0.05 Irem_gap=2"},
      {"TYPE7/1 Gapmin=1 Inacti=6", "1:Gapmin=0,Inacti=1000", "TYPE7/1"},  // the defaults
      // Factors of the card that only the other Igap uses.
      {"TYPE7/1 Igap=1 Fscalegap=0.5 Gapmax=0.45 Gapmin=0.1", "1:Igap=2",
       "TYPE7/1 Igap=2 Fscalegap=0.5 Gapmax=0.45 Gapmin=0.1"},
      {"TYPE19/1 Igap=4 Gapmin=0.1", "1:Igap=1", "TYPE19/1 Igap=1 Gapmin=0.1"},
      // Fields that the type does not have.
      {"TYPE10/1 Gap=1", "1:Inacti=6,Igap=1,Fpenmax=0.1", "TYPE10/1 Gap=1"},
      {"TYPE19/1 surf_IDs=1 surf_IDm=1", "1:Fpenmax=0.1", "TYPE19/1 surf_IDs=1 surf_IDm=1"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(std::string(c.card) + " " + c.what_if);
    const Built asked(quad(std::string("@/INTER/") + c.card), with(c.what_if));
    const Built written(quad(std::string("@/INTER/") + c.same));
    ASSERT_EQ(asked.scene.contacts.size(), written.scene.contacts.size());
    for (std::size_t k = 0; k < asked.scene.contacts.size(); ++k)
      expect_same(asked.scene.contacts[k], written.scene.contacts[k]);
  }
}

TEST(WhatIf, OtherInterfacesAndTheModelStayAsTheyAre) {
  const SmallDeck d = quad("@/INTER/TYPE7/1 Gapmin=1").add("@/INTER/TYPE7/2 Gapmin=1");
  const Built asked(d, with("2:Inacti=3")), plain(d);
  expect_same(asked.contact(1), plain.contact(1));
  EXPECT_EQ(asked.contact(2).penetrations.at(0).action, PenetrationAction::node_moved);
  EXPECT_EQ(asked.model.nodes.z, plain.model.nodes.z);
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
    const auto at = static_cast<std::size_t>(w->interface_id - 1);
    EXPECT_TRUE(check_what_if(*w, *b.interfaces.ordered.at(at)).ok()) << text;
    b.build(with(text));
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

}  // namespace
}  // namespace deck::test
