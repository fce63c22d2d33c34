// Interfaces as elementary contacts: TYPE19 and its parts, order, options, empty sides.
#include <gtest/gtest.h>

#include "contact/small_deck.hpp"
#include "deck/text/rule_id.hpp"

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
  const Contact& a = b.contact(1, ContactRole::primary);
  EXPECT_EQ(a.secondary.size(), 9u);
  EXPECT_EQ(a.main.size(), 9u);
  EXPECT_DOUBLE_EQ(a.gapmin, 2);
  EXPECT_EQ(a.candidates, 24u);
  EXPECT_EQ(a.penetrations.size(), 12u);
  const Contact& r = b.contact(1, ContactRole::reversed);
  EXPECT_EQ(r.secondary.size(), 16u);
  EXPECT_EQ(r.main.size(), 4u);
  EXPECT_DOUBLE_EQ(r.gapmin, 1.2);
  EXPECT_EQ(r.candidates, 11u);
  EXPECT_EQ(r.penetrations.size(), 2u);
  const Contact& e = b.contact(1, ContactRole::edges);
  EXPECT_EQ(e.kind, ContactKind::edge_edge);
  EXPECT_EQ(e.secondary_edges.size(), 12u);
  EXPECT_EQ(e.main_edges.size(), 24u);
  EXPECT_DOUBLE_EQ(e.gapmin, 1.6);
  EXPECT_EQ(e.penetrations.size(), 24u);
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
  const Contact& edges = b.contact(1, ContactRole::edges);
  EXPECT_EQ(edges.igap, 1) << "2 ends as 1";
  EXPECT_EQ(edges.gap_scale, 1) << "Fscalegap does not act on edges";
  EXPECT_DOUBLE_EQ(edges.gapmin, 1.6);
  EXPECT_EQ(edges.istf, 5);
  EXPECT_EQ(edges.inacti, 5);
  EXPECT_DOUBLE_EQ(b.contact(1, ContactRole::primary).gapmin, 1.6);
  EXPECT_DOUBLE_EQ(b.contact(1, ContactRole::reversed).gapmin, 0.96);
  EXPECT_EQ(b.contact(2, ContactRole::edges).igap, 3);
  for (const ContactRole r : {ContactRole::primary, ContactRole::reversed, ContactRole::edges})
    EXPECT_DOUBLE_EQ(b.contact(3, r).gapmin, 1);
}

TEST(Type19, WithoutEdgesThePartIsDropped) {
  SmallDeck d = two_plates();
  d.group("/SURF/PART/9", {77});
  const Built b(d.add("@/INTER/TYPE19/1 surf_IDs=2 surf_IDm=9"));
  const Contact& edges = b.contact(1, ContactRole::edges);
  EXPECT_TRUE(edges.dropped);
  EXPECT_TRUE(edges.main_edges.empty());
  EXPECT_TRUE(edges.secondary_edges.empty());
}

TEST(Type11, WithoutMainLineTheSecondaryMeetsItself) {
  const Built b(two_plates().add("@/INTER/TYPE11/1 line_IDs=2 line_IDm=0"));
  EXPECT_EQ(b.contact().main_edges.size(), 12u);
  EXPECT_EQ(b.contact().secondary_edges.size(), 12u);
}

TEST(Lines, SurfaceGivesEveryEdgeOnceFreeOnesOnRequest) {
  SmallDeck d = two_plates();
  d.group("/LINE/EDGE/5", {1});
  const Built b(d.add("@/INTER/TYPE11/1 line_IDs=1 line_IDm=5"));
  EXPECT_EQ(b.contact().secondary_edges.size(), 24u);
  EXPECT_EQ(b.contact().main_edges.size(), 12u);
}

TEST(Scene, UnknownSidesLeaveContactsEmpty) {
  const Built b(two_plates()
                    .add("@/INTER/TYPE7/1 grnd_IDs=77 surf_IDm=1")
                    .add("@/INTER/TYPE7/2 grnd_IDs=2 surf_IDm=78")
                    .add("@/INTER/TYPE11/3 line_IDs=77 line_IDm=78")
                    .add("@/INTER/TYPE19/4 surf_IDs=77 surf_IDm=78")
                    .add("@/INTER/TYPE10/5 grnd_IDs=77 surf_IDm=78"));
  for (const Contact& c : b.scene.contacts) EXPECT_TRUE(c.penetrations.empty());
  EXPECT_TRUE(b.contact(1).secondary.empty());
  EXPECT_TRUE(b.contact(2).main.empty());
}

TEST(Scene, OnlySomeInterfacesAndProgress) {
  SceneOptions options;
  options.only = {7};
  std::vector<std::pair<std::size_t, std::size_t>> steps;
  options.progress = [&](std::size_t done, std::size_t total) { steps.emplace_back(done, total); };
  const Built b(two_plates()
                    .add("@/INTER/TYPE7/3")
                    .add("@/INTER/TYPE19/7 surf_IDs=2 surf_IDm=1")
                    .add("@/INTER/TYPE19/8 surf_IDs=2 surf_IDm=1"),
                options);
  EXPECT_EQ(b.scene.contacts.size(), 3u);
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(steps.back(), std::pair(std::size_t{3}, std::size_t{3}));
}

TEST(Scene, WithoutPenetrationsThereAreStillGapsAndStiffness) {
  SceneOptions options;
  options.penetrations = false;
  const Built b(two_plates().add("@/INTER/TYPE7/1"), options);
  EXPECT_TRUE(b.contact().penetrations.empty());
  EXPECT_DOUBLE_EQ(b.contact().gapmin, 2);
  EXPECT_DOUBLE_EQ(b.contact().main.at(0).stiffness, 400);
}

TEST(Scene, SamePenetrationsWithAndWithoutCandidateCount) {
  SceneOptions options;
  options.candidates = false;
  const SmallDeck d = two_plates().add("@/INTER/TYPE7/1");
  const Built with(d), without(d, options);
  EXPECT_EQ(with.contact().penetrations.size(), without.contact().penetrations.size());
  EXPECT_GT(with.contact().candidates, without.contact().candidates);
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
    ASSERT_EQ(b.scene.contacts.size(), 1u);
    EXPECT_GE(b.contact().penetrations.size(), 360u) << card;
    EXPECT_EQ(b.scene.decisions.fallback, 0u) << card;
    EXPECT_EQ(b.scene.decisions.exact, 0u) << card;
    for (const PenetrationRow& r : b.contact().penetrations) EXPECT_TRUE(r.on_surface);
    ASSERT_EQ(b.diagnostics.counts().count(RuleId::DK336), 1u) << card;
    EXPECT_EQ(b.diagnostics.counts().at(RuleId::DK336), 1u) << card;
    for (const Diagnostic& d : b.diagnostics.all()) {
      if (d.rule != RuleId::DK336) continue;
      EXPECT_NE(d.message.find("40 nodes at one place (50, 0.1, -7), 1 and 40 among them"),
                std::string::npos)
          << d.message;
    }
  }
}

}  // namespace
}  // namespace deck::test
