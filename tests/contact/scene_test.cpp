// Interfaces as elementary contacts: TYPE19 and its parts, order, options, nodes at one place.
#include <gtest/gtest.h>

#include "contact/small_deck.hpp"
#include "deck/rule_id.hpp"

namespace deck::test {
namespace {

/// A 3 x 3 plate (part 1, t = 2) and a 2 x 2 plate above it (part 2, t = 1.2).
SmallDeck two_plates() {
  SmallDeck d;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) d.node(1 + i + 4 * j, 10 * i, 6 * j, 0);
  const double x[] = {4, 11, 18}, y[] = {3, 10, 17}, z[] = {0.9, 0.95, 1};
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) d.node(101 + i + 3 * j, x[i], y[j], z[i]);
  d.shell_part(1, 2).shell_part(2, 1.2);
  int id = 0;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      const int n = 1 + i + 4 * j;
      d.shell(1, ++id, n, n + 1, n + 5, n + 4);
    }
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const int n = 101 + i + 3 * j;
      d.shell(2, ++id, n, n + 1, n + 4, n + 3);
    }
  d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2}).group("/SURF/PART/3", {1, 2});
  return d.group("/GRNOD/SURF/2", {2}).group("/LINE/SURF/1", {1}).group("/LINE/SURF/2", {2});
}

TEST(Type19, PartsOfThePublishedExample) {
  const Built b(two_plates().add("@/INTER/TYPE19/1 surf_IDs=2 surf_IDm=1"));
  ASSERT_EQ(b.scene.contacts.size(), 3u);
  using R = ContactRole;
  struct Part {
    R role;
    std::size_t secondary, main;
    double gapmin;
    std::size_t penetrations;
  };
  for (const Part& p : {Part{R::primary, 9, 9, 2, 12}, Part{R::reversed, 16, 4, 1.2, 2},
                        Part{R::edges, 12, 24, 1.6, 24}}) {
    const Contact& c = b.contact(1, p.role);
    EXPECT_EQ(c.secondary.size() + c.secondary_edges.size(), p.secondary) << to_string(p.role);
    EXPECT_EQ(c.main.size() + c.main_edges.size(), p.main) << to_string(p.role);
    EXPECT_DOUBLE_EQ(c.gapmin, p.gapmin) << to_string(p.role);
    EXPECT_EQ(c.penetrations.size(), p.penetrations) << to_string(p.role);
  }
  EXPECT_EQ(b.contact(1, R::primary).candidates, 24u);
  EXPECT_EQ(b.contact(1, R::reversed).candidates, 11u);
}

TEST(Type19, OneSurfaceGivesNoReversedPart) {
  const Built b(two_plates()
                    .add("@/INTER/TYPE19/1 surf_IDs=3 surf_IDm=3")
                    .add("@/INTER/TYPE19/2 surf_IDs=0 surf_IDm=3")
                    .add("@/INTER/TYPE19/3 surf_IDs=3 surf_IDm=0"));
  for (const int id : {1, 2, 3}) {
    EXPECT_EQ(b.contact(id, ContactRole::primary).secondary.size(), 25u) << id;
    EXPECT_EQ(b.contact(id, ContactRole::primary).main.size(), 13u) << id;
    EXPECT_EQ(b.contact(id, ContactRole::edges).main_edges.size(), 36u) << id;
  }
  for (const Contact& c : b.scene.contacts) EXPECT_NE(c.role, ContactRole::reversed);
}

TEST(Type19, FurtherPartsFollowAllInterfacesOfTheDeck) {
  const Built b(two_plates()
                    .add("@/INTER/TYPE19/5 surf_IDs=2 surf_IDm=1")
                    .add("@/INTER/TYPE7/3")
                    .add("@/INTER/TYPE19/4 surf_IDs=2 surf_IDm=1")
                    .add("@/INTER/TYPE11/1"));
  std::vector<std::pair<std::int64_t, ContactRole>> order;
  for (const Contact& c : b.scene.contacts) order.emplace_back(c.inter->id, c.role);
  using R = ContactRole;
  const std::vector<std::pair<std::int64_t, ContactRole>> expected = {
      {1, R::primary},  {3, R::primary}, {4, R::primary},  {5, R::primary},
      {4, R::reversed}, {4, R::edges},   {5, R::reversed}, {5, R::edges}};
  EXPECT_EQ(order, expected);
}

TEST(Type19, GapOptionsOfTheEdgePart) {
  const Built b(two_plates()
                    .add("@/INTER/TYPE19/1 surf_IDs=2 surf_IDm=1 Igap=2 Fscalegap=0.8 Inacti=5")
                    .add("@/INTER/TYPE19/2 surf_IDs=2 surf_IDm=1 Igap=3")
                    .add("@/INTER/TYPE19/3 surf_IDs=2 surf_IDm=1 Gapmin=1"));
  using R = ContactRole;
  const Contact& edges = b.contact(1, R::edges);
  EXPECT_EQ(edges.igap, 1) << "2 ends as 1";
  EXPECT_EQ(edges.gap_scale, 1) << "Fscalegap does not act on edges";
  EXPECT_EQ(std::tuple(edges.istf, edges.inacti), std::tuple(5, 5));
  EXPECT_EQ(b.contact(2, R::edges).igap, 3);
  const double gapmin[] = {0.8 * 2, 0.8 * 1.2, 1.6};
  for (const R r : {R::primary, R::reversed, R::edges}) {
    EXPECT_DOUBLE_EQ(b.contact(1, r).gapmin, gapmin[static_cast<int>(r)]) << to_string(r);
    EXPECT_DOUBLE_EQ(b.contact(3, r).gapmin, 1);
  }
}

TEST(Type19, WithoutEdgesThePartIsDropped) {
  const Built b(
      two_plates().group("/SURF/PART/9", {77}).add("@/INTER/TYPE19/1 surf_IDs=2 surf_IDm=9"));
  EXPECT_TRUE(b.contact(1, ContactRole::edges).dropped);
}

TEST(Type11, TakesEveryEdgeOfASurfaceOnceFreeOnesOnRequest) {
  SmallDeck d = two_plates();
  d.group("/LINE/EDGE/5", {1});
  d.add("@/INTER/TYPE11/1 line_IDs=1 line_IDm=5").add("@/INTER/TYPE11/2 line_IDs=2 line_IDm=0");
  const Built b(d);
  EXPECT_EQ(b.contact(1).secondary_edges.size(), 24u);
  EXPECT_EQ(b.contact(1).main_edges.size(), 12u);
  EXPECT_EQ(b.contact(2).secondary_edges.size(), 12u);
  EXPECT_EQ(b.contact(2).main_edges.size(), 12u) << "without a main line it meets itself";
}

TEST(Scene, OfSomeInterfacesHasTheContactsOfThese) {
  SceneOptions options;
  options.only = {7};
  const Built b(two_plates()
                    .add("@/INTER/TYPE7/3")
                    .add("@/INTER/TYPE19/7 surf_IDs=2 surf_IDm=1")
                    .add("@/INTER/TYPE19/8 surf_IDs=2 surf_IDm=1"),
                options);
  ASSERT_EQ(b.scene.contacts.size(), 3u);
  for (const Contact& c : b.scene.contacts) EXPECT_EQ(c.inter->id, 7);
}

/// Shells whose nodes all lie at one place, and their contact with themselves.
SmallDeck at_one_place(int shells) {
  SmallDeck d;
  for (int n = 1; n <= 4 * shells; ++n) d.node(n, 50, 0.1, -7);
  d.shell_part(1, 2);
  for (int e = 0; e < shells; ++e) d.shell(1, 1 + e, 4 * e + 1, 4 * e + 2, 4 * e + 3, 4 * e + 4);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/PART/2", {1}).group("/LINE/SURF/1", {1});
  return d;
}

TEST(NodesAtOnePlace, AreDecidedWithoutAnyArithmeticAndReportedOnce) {
  for (const char* card : {"@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1",
                           "@/INTER/TYPE11/1 line_IDs=1 line_IDm=1 Gapmin=1"}) {
    const Built b(at_one_place(10).add(card));
    EXPECT_GE(b.contact().penetrations.size(), 360u) << card;
    EXPECT_EQ(b.scene.decisions.fallback + b.scene.decisions.exact, 0u) << card;
    for (const PenetrationRow& r : b.contact().penetrations) EXPECT_TRUE(r.on_surface);
    EXPECT_EQ(b.diagnostics.counts().at(RuleId::DK336), 1u) << card;
  }
}

}  // namespace
}  // namespace deck::test
