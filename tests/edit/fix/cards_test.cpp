// Fixes that change interface cards: reduce-gap, inacti, fpenmax.
#include "edit/fix/support.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;

/// Lines that differ, old and new.
std::vector<std::pair<std::string, std::string>> changed_lines(const Built& b,
                                                               const PenetrationFix& fix) {
  const auto x = lines_of(text_after(b, {})), y = lines_of(text_after(b, fix));
  EXPECT_EQ(x.size(), y.size());
  std::vector<std::pair<std::string, std::string>> out;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
    if (x[i] != y[i]) out.emplace_back(x[i], y[i]);
  return out;
}

/// A sheet with a node at each of these heights over the middle of a segment.
SmallDeck at_heights(const std::vector<double>& heights, const std::string& cards) {
  SmallDeck d;
  d.shell_part(1, 1.0);
  add_sheet(d, 1, 1, 3, 2, [](int i, int j) { return P{8.0 * i, 8.0 * j, 0}; });
  std::vector<int> ids;
  for (const double z : heights) {
    const int k = static_cast<int>(ids.size());
    d.node(100 + k, 3.0 + 8 * (k % 3), 4.5 + 8 * (k / 3), z);
    ids.push_back(100 + k);
  }
  return d.group("/GRNOD/NODE/1", ids).group("/SURF/PART/1", {1}).add(cards);
}

// ---- reduce-gap -------------------------------------------------------------------------------

/// Nothing penetrates in the text, and something would with a larger gap.
void expect_largest(const std::string& text, const FieldChange* c) {
  ASSERT_NE(c, nullptr);
  EXPECT_LT(c->new_value, 1.0);
  EXPECT_TRUE(oracle_penetrations(Built(text)).empty());
  EXPECT_FALSE(oracle_penetrations(Built(with_more(text, *c))).empty());
}

TEST(ReduceGap, FindsTheLargestConstantGap) {
  for (const char* card : {"@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0",
                           "@/INTER/TYPE10/1 grnd_IDs=1 surf_IDm=1 Gap=1.0",
                           "@/INTER/TYPE11/1 line_IDs=1 line_IDm=2 Gapmin=1.0",
                           "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2 Gapmin=1.0"})
    for (unsigned seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE(card + (" seed " + std::to_string(seed)));
      const Built before(two_plates(seed, 0.4 + 0.1 * seed, card));
      ASSERT_FALSE(oracle_penetrations(before).empty());
      ReduceGapOptions options;
      options.ties = before.interfaces.ordered[0]->type == 10;
      const PenetrationFix fix = reduced(before, options);
      EXPECT_TRUE(fix.complete);
      const std::string text = text_after(before, fix);
      EXPECT_EQ(changed_lines(before, fix).size(), 1U);
      expect_largest(text, change(fix, options.ties ? "Gap" : "Gapmin"));
      EXPECT_TRUE(reduced(Built(text)).rewrite.edits.empty());
    }
}

/// Edges of a TYPE19 have Gapmin times Edge_scale_gap: a large one makes them decide, not nodes.
TEST(ReduceGap, EdgesOfType19HaveTheirScale) {
  for (const char* scale : {"1.6", "0.3"})
    for (unsigned seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE(std::string(scale) + " seed " + std::to_string(seed));
      std::string text =
          two_plates(seed, 0.4 + 0.1 * seed, "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2 Gapmin=1.0")
              .text();
      text.replace(text.find("      2022"), 10, "      2024");
      const auto line = text.find('\n', text.find("Fscalegap")) + 1;
      text.insert(line, std::string(57, ' ') + scale);
      const Built before(text);
      ASSERT_EQ(before.interfaces.type19.at(0).Edge_scale_gap.value, std::stod(scale));
      ASSERT_EQ(before.interfaces.type19.at(0).Gapmin.value, 1.0);
      const PenetrationFix fix = reduced(before);
      EXPECT_TRUE(fix.complete);
      expect_largest(text_after(before, fix), change(fix, "Gapmin"));
    }
}

TEST(ReduceGap, RefusesWhatNoAllowedGapSolves) {
  const std::string card = "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 ";
  const std::tuple<SmallDeck, double, const char*> cases[] = {
      {two_plates(1, 0.4, card + "Gapmin=1.0"), 0.9, "--min-gap"},
      {two_plates(2, 0.6, card + "Igap=2 Gapmin=0.1 Fscalegap=2"), 0.5, "--min-gap"},
      {at_heights({0}, card + "Gapmin=1.0"), 0.1, "distance 0"},
      {two_plates(1, 0.5, "@/INTER/TYPE11/1 line_IDs=1 line_IDm=2 Igap=1"), 0.1, "thickness"}};
  for (const auto& [deck, least, why] : cases) {
    SCOPED_TRACE(why);
    const PenetrationFix fix = reduced(Built(deck), {}, least);
    EXPECT_TRUE(fix.rewrite.edits.empty());
    EXPECT_FALSE(fix.complete);
    ASSERT_EQ(fix.refused.size(), 1U);
    EXPECT_THAT(fix.refused[0].reason, HasSubstr(why));
  }
}

TEST(ReduceGap, ScalesOrCapsAGapThatFollowsTheThickness) {
  for (const char* card : {"@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Igap=2 Gapmin=0.1",
                           "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Igap=2 Gapmin=0.1 Fscalegap=1.4",
                           "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Igap=2 Gapmax=0.75 Gapmin=0.1",
                           "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Igap=3 Gapmin=0.1",
                           "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Igap=2"}) {
    SCOPED_TRACE(card);
    const Built before(two_plates(2, 0.6, card));
    ASSERT_FALSE(oracle_penetrations(before).empty());
    const PenetrationFix fix = reduced(before);
    EXPECT_TRUE(fix.complete);
    const Built after(text_after(before, fix));
    EXPECT_TRUE(oracle_penetrations(after).empty());
    EXPECT_TRUE(change(fix, "Fscalegap") != nullptr || change(fix, "Gapmax") != nullptr);
    EXPECT_TRUE(reduced(after).rewrite.edits.empty());
  }
}

/// A main side of thickness 1 has a gap of 0.5, lone nodes have none.
TEST(ReduceGap, ChangesNoMoreThanTheNearestPairNeeds) {
  using Change = std::tuple<std::string, std::string, double, double>;  // field, text, was, is
  const std::string card = "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 ";
  const std::tuple<std::vector<double>, const char*, std::vector<Change>> cases[] = {
      {{1.5, 0.75, 1}, "Gapmin=2.0", {{"Gapmin", "0.75", 2, 0.75}}},
      {{0.25}, "Igap=2 Gapmin=0.125", {{"Fscalegap", "0.5", 1, 0.5}}},
      {{0.25}, "Igap=2 Gapmin=0.125 Fscalegap=2", {{"Fscalegap", "0.5", 2, 0.5}}},
      {{0.375, 0.25}, "Igap=1 Gapmin=0.125", {{"Fscalegap", "0.5", 1, 0.5}, {"Igap", "2", 1, 2}}},
      // What Fscalegap and Gapmax say with Igap 1 does not count.
      {{0.25},
       "Igap=1 Gapmin=0.125 Fscalegap=0.2 Gapmax=2.0",
       {{"Fscalegap", "0.5", 1, 0.5}, {"Igap", "2", 1, 2}}},
      {{0.25},
       "Igap=2 Gapmin=0.375",
       {{"Gapmin", "0.25", 0.375, 0.25}, {"Fscalegap", "0.5", 1, 0.5}}},
      {{0.75}, "Igap=2 Gapmin=1.0", {{"Gapmin", "0.75", 1, 0.75}}}};
  for (const auto& [heights, flags, expected] : cases) {
    SCOPED_TRACE(flags);
    const PenetrationFix fix = reduced(Built(at_heights(heights, card + flags)));
    EXPECT_EQ(fix.strategy, "reduce-gap");
    EXPECT_TRUE(fix.complete);
    EXPECT_TRUE(fix.refused.empty());
    ASSERT_EQ(fix.interfaces.size(), 1u);
    std::vector<Change> changes;
    for (const FieldChange& c : fix.interfaces[0].changes)
      changes.emplace_back(c.field, c.new_text, c.old_value, c.new_value);
    EXPECT_EQ(changes, expected);
    EXPECT_EQ(fix.interfaces[0].before.pairs, heights.size());
    EXPECT_EQ(fix.interfaces[0].after.pairs, 0u);
  }
}

// ---- inacti -----------------------------------------------------------------------------------

PenetrationFix with_inacti(const Built& b, int value, bool ties = false) {
  InactiOptions o;
  o.ties = ties;
  o.inacti = value;
  auto fix = set_inacti(context_of(b), o);
  EXPECT_TRUE(fix.ok()) << fix.error().message;
  return std::move(*fix);
}

TEST(SetInacti, ChangesOneCellAndSaysWhatTheSolverDoes) {
  const Built before(two_plates(1, 0.6, "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0"));
  for (const int value : {1, 2, 3, 5, 6}) {
    const PenetrationFix fix = with_inacti(before, value);
    const auto lines = changed_lines(before, fix);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].second.substr(30, 10), "         " + std::to_string(value));
    std::string first = lines[0].first, second = lines[0].second;
    first.resize(100, ' ');
    second.resize(100, ' ');
    EXPECT_EQ(second.substr(0, 30) + second.substr(40), first.substr(0, 30) + first.substr(40));
    EXPECT_TRUE(fix.complete);
    ASSERT_FALSE(fix.actions.empty());
    for (const FixAction& a : fix.actions) {
      EXPECT_EQ(a.before, PenetrationAction::none);
      EXPECT_NE(a.after, PenetrationAction::none);
      EXPECT_FALSE(a.stops);
    }
    const Built after(text_after(before, fix));
    EXPECT_EQ(after.contact().inacti, value);
    EXPECT_TRUE(with_inacti(after, value).rewrite.edits.empty());
  }
}

TEST(SetInacti, ZeroIsWritten1000WhereADefaultWouldAnswerIt) {
  const std::string card = "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0";
  const Built before(two_plates(1, 0.6, "@/DEFAULT/INTER/TYPE7 Inacti=6\n" + card));
  ASSERT_EQ(before.contact().inacti, 6);
  const PenetrationFix fix = with_inacti(before, 0);
  ASSERT_NE(change(fix, "Inacti"), nullptr);
  EXPECT_EQ(change(fix, "Inacti")->new_text, "1000");
  EXPECT_EQ(Built(text_after(before, fix)).contact().inacti, 0);
  EXPECT_FALSE(fix.complete);
}

TEST(SetInacti, Type10AndType11AreRefusedWhereItHasNoUse) {
  const Built tied(two_plates(1, 0.6, "@/INTER/TYPE10/1 grnd_IDs=1 surf_IDm=1 Gap=1.0"));
  EXPECT_THAT(with_inacti(tied, 5, true).refused.at(0).reason, HasSubstr("1162"));
  EXPECT_THAT(with_inacti(tied, 6, true).refused.at(0).reason, HasSubstr("whatever the card says"));
  EXPECT_TRUE(with_inacti(tied, 6, true).rewrite.edits.empty());
  EXPECT_TRUE(with_inacti(tied, 6).refused.empty()) << "what is tied is no penetration";
  const Built edges(two_plates(1, 0.6, "@/INTER/TYPE11/1 line_IDs=1 line_IDm=2 Gapmin=1.0"));
  EXPECT_THAT(with_inacti(edges, 3).refused.at(0).reason, HasSubstr("does nothing"));
  EXPECT_TRUE(with_inacti(edges, 6).complete);
}

/// A node on a segment and one above it.
SmallDeck touching(const std::string& card) {
  SmallDeck d;
  d.shell_part(1, 1.0);
  add_sheet(d, 1, 1, 2, 2, [](int i, int j) { return P{2.0 * i, 2.0 * j, 0}; });
  d.node(100, 1.125, 0.875, 0).node(101, 3.1, 1.2, 0.6);
  d.group("/GRNOD/NODE/1", {100, 101}).group("/SURF/PART/1", {1});
  return d.add(card);
}

TEST(SetInacti, RefusesWhatStopsTheSolver) {
  const std::string card = "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0";
  const Built before(touching(card));
  const PenetrationFix fix = with_inacti(before, 6);
  EXPECT_TRUE(fix.rewrite.edits.empty());
  EXPECT_THAT(fix.refused.at(0).reason, HasSubstr("611"));
  EXPECT_TRUE(with_inacti(before, 1).complete);
  const PenetrationFix already = with_inacti(Built(touching(card + " Inacti=6")), 6);
  EXPECT_THAT(already.refused.at(0).reason, HasSubstr("stops at 1 pair whose nodes lie exactly"));
  EXPECT_THAT(already.refused.at(0).reason, ::testing::Not(HasSubstr("Inacti is 0")));
}

// ---- fpenmax ----------------------------------------------------------------------------------

PenetrationFix with_fpenmax(const Built& b, std::optional<double> ratio = {}, bool ties = false) {
  FpenmaxOptions o;
  o.ties = ties;
  o.ratio = ratio;
  auto fix = set_fpenmax(context_of(b), o);
  EXPECT_TRUE(fix.ok()) << fix.error().message;
  return std::move(*fix);
}

TEST(SetFpenmax, DropsOnlyTheNodesThatStopTheSolver) {
  const Built before(touching("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0 Inacti=6"));
  const PenetrationFix fix = with_fpenmax(before);
  EXPECT_TRUE(fix.complete);
  const Built after(text_after(before, fix));
  EXPECT_TRUE(after.secondary(after.contact(), 100)->off);
  EXPECT_FALSE(after.secondary(after.contact(), 101)->off);
  for (const FixAction& a : fix.actions)
    EXPECT_EQ(a.after, a.depth == a.gap ? PenetrationAction::node_stiffness_zero
                                        : PenetrationAction::gap_reduced);
  EXPECT_TRUE(with_fpenmax(after).rewrite.edits.empty());
}

TEST(SetFpenmax, DropsNodesDeeperThanTheRatio) {
  const Built before(
      two_plates(3, 0.6, "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0 Inacti=6"));
  const PenetrationFix fix = with_fpenmax(before, 0.4);
  EXPECT_TRUE(fix.complete);
  std::size_t dropped = 0;
  for (const FixAction& a : fix.actions) {
    const bool deep = a.depth > 0.4 * a.gap;
    dropped += deep;
    EXPECT_EQ(a.after,
              deep ? PenetrationAction::node_stiffness_zero : PenetrationAction::gap_reduced);
  }
  EXPECT_GT(dropped, 0U);
  EXPECT_LT(dropped, fix.actions.size());
  EXPECT_EQ(changed_lines(before, fix).size(), 1U);
}

TEST(SetFpenmax, SaysWhatInacti0LeavesUntreated) {
  const Built before(two_plates(3, 0.6, "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0"));
  const PenetrationFix fix = with_fpenmax(before, 0.4);
  EXPECT_FALSE(fix.complete);
  EXPECT_THAT(fix.refused.at(0).reason, HasSubstr("Inacti is 0"));
}

TEST(SetFpenmax, OtherTypesHaveNone) {
  for (const char* card : {"@/INTER/TYPE10/1 grnd_IDs=1 surf_IDm=1 Gap=1.0",
                           "@/INTER/TYPE11/1 line_IDs=1 line_IDm=2 Gapmin=1.0",
                           "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2 Gapmin=1.0"}) {
    const Built before(two_plates(1, 0.6, card));
    const PenetrationFix fix = with_fpenmax(before, 0.5, true);
    EXPECT_TRUE(fix.rewrite.edits.empty());
    ASSERT_EQ(fix.refused.size(), 1U);
    EXPECT_THAT(fix.refused[0].reason, HasSubstr("has no Fpenmax"));
  }
}

/// The smallest share of three digits that keeps the deepest of the other pairs; 1 would keep the
/// pairs at distance 0, too.
TEST(SetFpenmax, IsJustAboveTheDeepestPairThatIsNotAtDistanceZero) {
  const std::string card = "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=2.0 Inacti=6";
  const auto fix = [&](const std::vector<double>& heights) {
    return with_fpenmax(Built(at_heights(heights, card)));
  };
  const std::pair<std::vector<double>, const char*> cases[] = {{{0}, "0.9"},
                                                               {{0, 0, 0}, "0.9"},
                                                               {{0, 1.6}, "0.201"},
                                                               {{0.5, 0}, "0.751"},
                                                               {{1.5, 0.75, 0, 1}, "0.626"}};
  for (const auto& [heights, text] : cases) {
    const PenetrationFix f = fix(heights);
    const FieldChange* c = change(f, "Fpenmax");
    ASSERT_NE(c, nullptr) << text;
    EXPECT_EQ(c->new_text, text);
    EXPECT_TRUE(f.complete);
    EXPECT_TRUE(f.refused.empty());
  }
  const PenetrationFix close = fix({0, 0.001});
  ASSERT_NE(change(close, "Fpenmax"), nullptr) << "three digits would be 1";
  EXPECT_GT(change(close, "Fpenmax")->new_value, 0.9995);
  EXPECT_LT(change(close, "Fpenmax")->new_value, 0.9995001);
  EXPECT_TRUE(close.complete);
  const PenetrationFix closest = fix({0, 1e-9});
  EXPECT_TRUE(closest.rewrite.edits.empty());
  ASSERT_FALSE(closest.refused.empty());
  EXPECT_EQ(closest.refused[0].reason,
            "a pair is so close to distance 0 that no Fpenmax drops only the pairs at 0");
  EXPECT_EQ(closest.refused[0].next, "deck fix DECK --strategy fpenmax --fpenmax 99%");
  EXPECT_TRUE(fix({0.5, 1.5}).rewrite.edits.empty()) << "nothing stops the solver";
}

TEST(SetFpenmax, ARatioOutsideItsRangeIsAnError) {
  const Built before(touching("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0"));
  for (const double ratio : {0.0, -0.5, 1.5}) {
    FpenmaxOptions o;
    o.ratio = ratio;
    EXPECT_FALSE(set_fpenmax(context_of(before), o).ok());
  }
}

}  // namespace
}  // namespace deck::test
