// Fixes of TYPE24 and TYPE25: their own fields, judged by their own rules.
#include "edit/fix/fix_scene.hpp"
#include "edit/fix/harm.hpp"
#include "edit/fix/support.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;

/// Depths by interface, node or edge: all that the scene finds and no tie holds.
std::map<std::pair<std::int64_t, std::vector<std::int64_t>>, double> depths(const Built& b) {
  std::map<std::pair<std::int64_t, std::vector<std::int64_t>>, double> out;
  for (const Contact& c : b.scene.contacts)
    for (const PenetrationRow& r : c.penetrations)
      if (detail::is_penetration(r))
        out[{c.inter->id, detail::node_ids(b.model, c, r, false)}] = r.depth;
  return out;
}

TEST(ModernGap, LowersTheFieldsOfTheType) {
  for (const char* card :
       {"@/INTER/TYPE25/1 surf_ID1=1 surf_ID2=2 Inacti=5", "@/INTER/TYPE25/1 surf_ID1=1 surf_ID2=2",
        "@/INTER/TYPE25/1 surf_ID1=1 surf_ID2=2 Inacti=5 Gap_scale=1.2",
        "@/INTER/TYPE25/1 surf_ID1=1 surf_ID2=2 Inacti=5 Gap_max_s=0.2",
        "@/INTER/TYPE25/1 surf_ID1=1 surf_ID2=2 Inacti=-1 Igap=3 %mesh_size=0.9",
        "@/INTER/TYPE25/1 surf_ID1=1 surf_ID2=2 Inacti=5 Ishape=2 Igap=2",
        "@/INTER/TYPE25/1 surf_ID1=1 surf_ID2=2 Inacti=5 Iedge=2",
        "@/INTER/TYPE24/1 surf_ID1=1 surf_ID2=2 Inacti=5",
        "@/INTER/TYPE24/1 surf_ID1=1 surf_ID2=2"})
    for (unsigned seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(card + (" seed " + std::to_string(seed)));
      const Built before(two_plates(seed, 0.55, card));
      ASSERT_FALSE(depths(before).empty());
      const PenetrationFix fix = reduced(before, {}, 0.05);
      EXPECT_TRUE(fix.complete);
      const std::string text = text_after(before, fix);
      EXPECT_TRUE(depths(Built(text)).empty());
      const FieldChange* scale = change(fix, "Gap_scale");
      const FieldChange* cap = change(fix, "Gap_max_m");
      EXPECT_TRUE(scale != nullptr || cap != nullptr);
      EXPECT_EQ(change(fix, "Igap"), nullptr) << "their gaps need no Igap 2";
      if (before.interfaces.ordered[0]->type == 24) {
        EXPECT_EQ(scale, nullptr);
      }
      for (const FieldChange* c : {scale, cap})
        if (c != nullptr) {
          EXPECT_LT(c->new_value, c->old_value);
        }
      EXPECT_TRUE(reduced(Built(text)).rewrite.edits.empty());
    }
}

TEST(ModernGap, FindsTheLargestWhereTheGapIsPlain) {
  // Flat sheets, no borders in the way: the scale is the distance over the sum of half thicknesses.
  SmallDeck d;
  d.shell_part(1, 1.0).shell_part(2, 0.6);
  add_sheet(d, 1, 1, 4, 4, [](int i, int j) { return P{4.0 * i, 4.0 * j, 0}; });
  add_sheet(d, 2, 101, 1, 1, [](int i, int j) { return P{5.1 + i, 5.2 + j, 0.6}; });
  d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2});
  for (const char* type : {"24", "25"}) {
    SmallDeck with = d;
    with.add(std::string("@/INTER/TYPE") + type + "/1 surf_ID1=1 surf_ID2=2 Inacti=5");
    const Built before(with);
    ASSERT_EQ(depths(before).size(), 4u);
    const PenetrationFix fix = reduced(before, {}, 0.05);
    const FieldChange* c = change(fix, *type == '2' && type[1] == '5' ? "Gap_scale" : "Gap_max_m");
    ASSERT_NE(c, nullptr);
    // 0.5 + 0.3 is to be 0.6: 0.75 of it; or 0.3 of each side.
    EXPECT_NEAR(c->new_value, type[1] == '5' ? 0.75 : 0.3, 2e-6);
    const std::string text = text_after(before, fix);
    EXPECT_TRUE(depths(Built(text)).empty());
    EXPECT_FALSE(depths(Built(with_more(text, *c))).empty()) << "a larger gap would have done";
  }
}

/// A node, the corner of a small shell, against a brick.
SmallDeck node_at_brick(double z, const std::string& card) {
  SmallDeck d;
  add_brick(d, 1, 1, 1, {0, 0, 0}, {10, 10, 10});
  d.node(101, 5, 5, z).node(102, 6, 6, 40).node(103, 4, 6, 40);
  d.solid_part(1).shell_part(2, 1.5).shell3(2, 10, 101, 102, 103);
  return d.group("/SURF/PART/EXT/1", {1}).group("/GRNOD/NODE/1", {101}).add(card);
}

TEST(ModernGap, BehindASolidNoGapHelpsAndNoNodeMoves) {
  for (const char* type : {"24", "25"}) {
    SCOPED_TRACE(type);
    const std::string card =
        std::string("@/INTER/TYPE") + type + "/1 surf_ID2=1 grnd_IDs=1 Inacti=5";
    const Built inside(node_at_brick(9.5, card));
    ASSERT_EQ(depths(inside).size(), 1u);
    const PenetrationFix gap = reduced(inside);
    EXPECT_TRUE(gap.rewrite.edits.empty());
    EXPECT_THAT(gap.refused.at(0).reason, HasSubstr("behind the face of a solid"));
    MoveNodesOptions options;
    options.most_moved = 1;
    const auto moved = move_nodes(context_of(inside), options);
    ASSERT_TRUE(moved.ok());
    EXPECT_TRUE(moved->rewrite.edits.empty());
    EXPECT_THAT(moved->refused.at(0).reason, HasSubstr("inside a solid"));
  }
  // In front of it a TYPE24 penetrates by its gap, and is freed.
  const Built before(node_at_brick(10.5, "@/INTER/TYPE24/1 surf_ID2=1 grnd_IDs=1 Inacti=5"));
  ASSERT_EQ(depths(before).size(), 1u);
  const PenetrationFix fix = reduced(before, {}, 0.05);
  EXPECT_TRUE(fix.complete);
  EXPECT_TRUE(depths(Built(text_after(before, fix))).empty());
}

TEST(ModernInacti, TakesWhatTheTypeKnows) {
  const auto set = [](const char* type, std::optional<int> value) {
    const Built b(two_plates(
        1, 0.55, std::string("@/INTER/TYPE") + type + "/1 surf_ID1=1 surf_ID2=2 VISs=0.05"));
    InactiOptions options;
    options.inacti = value;
    auto fix = set_inacti(context_of(b), options);
    EXPECT_TRUE(fix.ok());
    return std::move(*fix);
  };
  for (const char* type : {"24", "25"}) {
    SCOPED_TRACE(type);
    const PenetrationFix usual = set(type, {});
    EXPECT_TRUE(usual.complete) << (usual.complete ? "" : usual.refused[0].reason);
    ASSERT_NE(change(usual, "Inacti"), nullptr);
    EXPECT_EQ(change(usual, "Inacti")->new_value, 5);
    ASSERT_FALSE(usual.actions.empty());
    EXPECT_EQ(usual.actions[0].after, PenetrationAction::offset_stored);
    const PenetrationFix force = set(type, -1);
    EXPECT_TRUE(force.complete);
    EXPECT_EQ(force.actions.at(0).after, PenetrationAction::initial_force);
    const PenetrationFix six = set(type, 6);
    EXPECT_TRUE(six.rewrite.edits.empty());
    EXPECT_THAT(six.refused.at(0).reason, HasSubstr("would take 6 as 5"));
  }
}

TEST(ModernInacti, OlderTypesHaveNoMinusOne) {
  const Built b(two_plates(1, 0.55, "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0"));
  InactiOptions options;
  options.inacti = -1;
  const auto fix = set_inacti(context_of(b), options);
  ASSERT_TRUE(fix.ok());
  EXPECT_THAT(fix->refused.at(0).reason, HasSubstr("TYPE7 has no Inacti -1"));
  options.inacti = {};
  EXPECT_EQ(change(*set_inacti(context_of(b), options), "Inacti")->new_value, 6);
}

TEST(ModernMove, NodesLeaveTheGapAndNothingGetsWorse) {
  for (const char* card : {"@/INTER/TYPE25/1 surf_ID1=1 surf_ID2=2 Inacti=5",
                           "@/INTER/TYPE25/1 surf_ID1=1 surf_ID2=2 Iedge=2",
                           "@/INTER/TYPE24/1 surf_ID1=1 surf_ID2=2 Inacti=5"})
    for (unsigned seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(card + (" seed " + std::to_string(seed)));
      const Built before(two_plates(seed, 0.6, card));
      const auto was = depths(before);
      ASSERT_FALSE(was.empty());
      MoveNodesOptions options;
      options.most_moved = 1;
      const auto fix = move_nodes(context_of(before), options);
      ASSERT_TRUE(fix.ok()) << fix.error().message;
      const auto is = depths(Built(text_after(before, *fix)));
      if (std::string(card).find("Iedge") == std::string::npos) {  // edges leave less room
        EXPECT_LT(is.size(), was.size() / 2);
      }
      for (const auto& [key, depth] : is) {
        ASSERT_TRUE(was.contains(key));
        EXPECT_LE(depth, was.at(key) * (1 + 1e-8));
      }
      EXPECT_EQ(fix->complete, is.empty());
    }
}

TEST(ModernFix, PointsOnEdgesThatPenetrateAreSaid) {
  const Built b(two_plates(1, 0.55, "@/INTER/TYPE24/1 surf_ID1=1 surf_ID2=2 Inacti=5 Iedge=1"));
  EXPECT_TRUE(reduced(b).complete) << "a smaller gap cures points, too";
  const PenetrationFix fix = reduced(b, {}, 0.99);
  EXPECT_FALSE(fix.complete);
  ASSERT_EQ(fix.refused.size(), 2u);
  EXPECT_THAT(fix.refused[1].reason, HasSubstr("points on its edges"));
}

}  // namespace
}  // namespace deck::test
