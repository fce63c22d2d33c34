// The side view of a pair: which pair a name means, its lengths, and the drawing to scale.
#include "report/shared/side_view.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <string>

#include "contact/small_deck.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A node 0.5 above a shell of thickness 2, in the interfaces that `cards` say.
SmallDeck node_over_shell(const std::string& cards) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(9, 5, 5, 0.5);
  d.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {9});
  return d.add(cards);
}

FoundPair found(const Built& b, const char* name, std::int64_t interface = 0) {
  const auto pair = find_pair(b.scene, parse_pair(name).value(), interface);
  EXPECT_TRUE(pair.ok());
  return pair.ok() ? *pair : FoundPair{};
}

/// The number after ` name='` in an element that `from` begins.
double attribute(const std::string& svg, const std::string& name, std::size_t from = 0) {
  const auto at = svg.find(" " + name + "='", from);
  return at == svg.npos ? -1e9 : std::strtod(svg.c_str() + at + name.size() + 3, nullptr);
}

TEST(SideView, PairsAreNamedByNodesInAnyOrder) {
  const auto node = parse_pair("57/30-38-44-31");
  ASSERT_TRUE(node.ok());
  EXPECT_EQ(node->secondary, (std::vector<std::int64_t>{57}));
  EXPECT_EQ(node->main, (std::vector<std::int64_t>{30, 38, 44, 31}));
  EXPECT_TRUE(parse_pair("11-12/30-31").ok());
  EXPECT_TRUE(parse_pair("57/30-38-44").ok());
  for (const char* wrong : {"", "57", "57/", "/1-2-3", "57/30", "57/30-31", "1-2-3/4-5", "a/1-2-3",
                            "57/30-38-44-31-9", "57/30--38"})
    EXPECT_FALSE(parse_pair(wrong).ok()) << wrong;
}

TEST(SideView, LengthsAreThoseOfTheRow) {
  const Built b(node_over_shell("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.25 Inacti=6"));
  const FoundPair pair = found(b, "9/3-4-1-2");
  const PenetrationRow& row = b.scene.contacts[pair.contact].penetrations[pair.row];
  const PairHeights v = pair_heights(b.scene, pair);
  EXPECT_EQ(v.gap, row.gap);
  EXPECT_EQ(v.depth, row.depth);
  EXPECT_DOUBLE_EQ(v.at, 0.5);
  EXPECT_DOUBLE_EQ(v.main, 1.0);
  EXPECT_EQ(v.secondary, 0.0);
  EXPECT_EQ(pair_equation(v), "depth 0.75 = gap 1.25 - distance 0.5");
}

TEST(SideView, TheDrawingIsToScale) {
  const Built b(node_over_shell("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.25 Inacti=6"));
  const FoundPair pair = found(b, "9/1-2-3-4");
  const std::string svg = side_view_svg(b.scene, pair);
  const double scale = attribute(svg, "data-scale");
  const auto length = [&](const char* kind) {
    const auto at = svg.find(std::string("<line class='") + kind + "'");
    EXPECT_NE(at, svg.npos) << kind;
    return std::abs(attribute(svg, "y2", at) - attribute(svg, "y1", at)) / scale;
  };
  EXPECT_NEAR(length("gap-length"), 1.25, 0.0125);
  EXPECT_NEAR(length("depth"), 0.75, 0.0075);
  EXPECT_NEAR(length("distance"), 0.5, 0.005);
  EXPECT_NE(svg.find("Interface 1 TYPE7: node 9 on segment 1-2-3-4"), svg.npos);
  EXPECT_NE(svg.find("left of the gap"), svg.npos);  // Inacti 6
  const Built kept(node_over_shell("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.25"));
  EXPECT_EQ(side_view_svg(kept.scene, found(kept, "9/1-2-3-4")).find("left of the gap"), svg.npos);
}

TEST(SideView, SeveralInterfacesMustBeChosenFrom) {
  const Built b(
      node_over_shell("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.25\n"
                      "@/INTER/TYPE7/4 grnd_IDs=2 surf_IDm=1 Gapmin=1"));
  const PairName name = parse_pair("9/1-2-3-4").value();
  const auto both = find_pair(b.scene, name);
  ASSERT_FALSE(both.ok());
  EXPECT_NE(both.error().message.find("interfaces 1, 4"), std::string::npos);
  EXPECT_EQ(pair_heights(b.scene, found(b, "9/1-2-3-4", 4)).gap, 1.0);
  EXPECT_FALSE(find_pair(b.scene, name, 2).ok());
  EXPECT_FALSE(find_pair(b.scene, parse_pair("9/1-2-3").value()).ok());
}

TEST(SideView, EdgesHaveTheirOwnHalves) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(11, 5, -5, 0.5).node(12, 5, 5, 0.5);
  d.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4).truss_part(2, 1.0);
  d.bar("TRUSS", 2, 2, 11, 12);
  d.segments("/LINE/SEG/3", {{11, 12}}).segments("/LINE/SEG/4", {{1, 2}});
  const Built b(d.add("@/INTER/TYPE11/1 line_IDs=3 line_IDm=4 Gapmin=1.25"));
  const FoundPair pair = found(b, "12-11/2-1");
  const PairHeights v = pair_heights(b.scene, pair);
  EXPECT_DOUBLE_EQ(v.depth, 0.75);
  EXPECT_NE(side_view_svg(b.scene, pair).find("edge 11-12 on edge 1-2"), std::string::npos);
  // Half of the square root of an area of 1, half of a thickness of 2.
  EXPECT_DOUBLE_EQ(v.secondary, 0.5);
  EXPECT_DOUBLE_EQ(v.main, 1.0);
  EXPECT_THAT(side_view_svg(b.scene, pair), HasSubstr(">main edge</text>"));
}

TEST(SideView, OfASolidHasNoHalfAndOfOneNodeThatOfItsShell) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(5, 0, 0, -9).node(6, 10, 0, -9).node(7, 10, 10, -9).node(8, 0, 10, -9);
  d.node(11, 3, 3, 0.5).node(12, 7, 3, 30).node(13, 7, 7, 30);
  d.solid_part(1)
      .shell_part(2, 0.75)
      .brick(1, 1, {5, 6, 7, 8, 1, 2, 3, 4})
      .shell3(2, 2, 11, 12, 13);
  d.segments("/SURF/SEG/1", {{1, 2, 3, 4}}).group("/GRNOD/NODE/2", {11});
  const Built b(d.add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=2 Fscalegap=0.5"));
  const FoundPair pair = found(b, "11/1-2-3-4");
  const PairHeights v = pair_heights(b.scene, pair);
  EXPECT_EQ(v.main, 0.0);
  EXPECT_EQ(v.secondary, 0.375);
  const std::string svg = side_view_svg(b.scene, pair);
  // Below the surface lies 0.12 of the gap, above it the gap: 160 high in all.
  EXPECT_NEAR(attribute(svg, "data-scale"), 160 / (2 + 0.24), 1e-12);
}

/// A row of a TYPE7 whose figures are set here.
struct Drawn {
  explicit Drawn(const char* card = "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.25")
      : b(node_over_shell(card)), pair(found(b, "9/1-2-3-4")) {}
  PenetrationRow& row() { return b.scene.contacts[pair.contact].penetrations[pair.row]; }
  std::string svg() const { return side_view_svg(b.scene, pair); }
  Built b;
  FoundPair pair;
};

/// Heights over the surface of all elements of a kind, in their order.
std::vector<double> heights(const std::string& svg, const std::string& begin, const char* name,
                            double low) {
  std::vector<double> out;
  for (auto at = svg.find(begin); at != svg.npos; at = svg.find(begin, at + 1))
    out.push_back((190 - attribute(svg, name, at)) / attribute(svg, "data-scale") + low);
  return out;
}

TEST(SideView, EveryShapeIsAtItsHeight) {
  Drawn d;
  d.row().action = PenetrationAction::node_moved;
  d.row().moved_by = {0.6, 0, 0.8};  // 1 long
  const std::string svg = d.svg();
  // From 1 below the surface, the half of the shell, to the moved node at 1.5.
  const double low = -1, scale = attribute(svg, "data-scale");
  EXPECT_NEAR(scale, 160 / 2.5, 1e-12);
  EXPECT_EQ(attribute(svg, "data-gap"), 1.25);
  EXPECT_EQ(attribute(svg, "data-depth"), 0.75);
  EXPECT_EQ(attribute(svg, "data-distance"), 0.5);
  const auto near = [](const std::vector<double>& found, const std::vector<double>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-3);
  };
  near(heights(svg, "<rect class='band'", "y", low), {1.25});
  near(heights(svg, "<rect class='main'", "y", low), {1.0});
  const auto tall = [&](const char* kind) {
    return attribute(svg, "height", svg.find(std::string("<rect class='") + kind)) / scale;
  };
  EXPECT_NEAR(tall("band"), 1.25, 1e-3);
  EXPECT_NEAR(tall("main"), 2.0, 1e-3);
  near(heights(svg, "<line class='surface'", "y1", low), {0.0});
  near(heights(svg, "<line class='gap-end'", "y2", low), {1.25});
  near(heights(svg, "<line class='gap-length'", "y1", low), {0.0});
  near(heights(svg, "<line class='gap-length'", "y2", low), {1.25});
  near(heights(svg, "<line class='distance'", "y1", low), {0.0});
  near(heights(svg, "<line class='distance'", "y2", low), {0.5});
  near(heights(svg, "<line class='depth'", "y1", low), {0.5});
  near(heights(svg, "<line class='depth'", "y2", low), {1.25});
  near(heights(svg, "<circle class='dot'", "cy", low), {0.5});
  near(heights(svg, "<circle class='half'", "cy", low), {0.5});
  near(heights(svg, "<circle class='ghost'", "cy", low), {1.5, 1.5});
  EXPECT_THAT(svg, HasSubstr(">moved here</text>"));
  EXPECT_THAT(svg, Not(HasSubstr("left of the gap")));
  EXPECT_THAT(svg, HasSubstr(">segment</text>"));
  EXPECT_THAT(svg, HasSubstr(">gap 1.25</text>"));
  EXPECT_THAT(svg, HasSubstr("class='deep' x='268'"));
  EXPECT_THAT(svg, HasSubstr(">depth 0.75</text>"));
  for (const char* kind : {"gap-length", "distance", "depth"}) {
    const auto at = svg.find(std::string("<line class='") + kind);
    EXPECT_EQ(attribute(svg, "x1", at), std::string(kind) == "gap-length" ? 18 : 130) << kind;
    EXPECT_EQ(attribute(svg, "x2", at), attribute(svg, "x1", at));
  }
  const auto level = svg.find("<line class='surface'");
  EXPECT_EQ(attribute(svg, "x1", level), 10);
  EXPECT_EQ(attribute(svg, "x2", level), 250);
  EXPECT_EQ(attribute(svg, "cx", svg.find("<circle class='dot'")), 130);
  EXPECT_EQ(attribute(svg, "width", svg.find("<rect class='band'")), 240);
}

TEST(SideView, WhatIsSwitchedOffIsDashed) {
  Drawn d;
  EXPECT_THAT(d.svg(), HasSubstr("<line class='surface' "));
  EXPECT_THAT(d.svg(), HasSubstr("<circle class='dot' "));
  for (const auto action :
       {PenetrationAction::segment_stiffness_zero, PenetrationAction::edge_stiffness_zero}) {
    d.row().action = action;
    EXPECT_THAT(d.svg(), HasSubstr("<line class='surface off' "));
    EXPECT_THAT(d.svg(), HasSubstr("<circle class='dot' "));
  }
  d.row().action = PenetrationAction::node_stiffness_zero;
  EXPECT_THAT(d.svg(), HasSubstr("<line class='surface' "));
  EXPECT_THAT(d.svg(), HasSubstr("<circle class='dot off' "));
}

TEST(SideView, WhatIsLeftOfTheGapIsNamedUnlessItIsNearlyAll) {
  Drawn d;
  d.row().has_gap0 = true;
  d.row().gap0 = 0.4;
  EXPECT_THAT(d.svg(), HasSubstr(">left of the gap 0.4</text>"));
  EXPECT_THAT(d.svg(), HasSubstr("<line class='ghost' "));
  d.row().gap0 = 0.98 * 1.25;
  EXPECT_THAT(d.svg(), Not(HasSubstr("left of the gap")));
  EXPECT_THAT(d.svg(), HasSubstr("<line class='ghost' "));
  d.row().has_gap0 = false;
  EXPECT_THAT(d.svg(), Not(HasSubstr("<line class='ghost' ")));
  // TYPE25 takes off what it stores.
  d.row().action = PenetrationAction::offset_stored;
  d.row().p0 = 0.5;
  EXPECT_THAT(d.svg(), HasSubstr(">left of the gap 0.75</text>"));
}

TEST(SideView, NamesKeepSixteenApart) {
  Drawn d;
  d.row().has_gap0 = true;
  d.row().gap0 = 1.1;
  const std::string svg = d.svg();
  std::vector<double> y;
  for (auto at = svg.find("<path class='leader'"); at != svg.npos;
       at = svg.find("<path class='leader'", at + 1))
    y.push_back(attribute(svg, "y", svg.find("<text", at)));
  ASSERT_EQ(y.size(), 4u);
  for (std::size_t i = 1; i < y.size(); ++i) EXPECT_LE(y[i], y[i - 1] - 16 + 1e-9);
  // From below: segment, depth, what is left, gap.
  const auto at = [&](const char* text) { return svg.find(text, svg.find("class='leader' d=")); };
  EXPECT_LT(at(">segment<"), at(">depth 0.75<"));
  EXPECT_LT(at(">depth 0.75<"), at(">left of the gap"));
  EXPECT_LT(at(">left of the gap"), at(">gap 1.25<"));
}

TEST(SideView, ALongTitleMakesAWideDrawing) {
  Drawn d;
  EXPECT_EQ(attribute(d.svg(), "width"), 420);
  SmallDeck far;
  far.node(1000000001, 0, 0, 0).node(1000000002, 10, 0, 0).node(1000000003, 10, 10, 0);
  far.node(1000000004, 0, 10, 0).node(1000000009, 5, 5, 0.5).shell_part(1, 2);
  far.shell(1, 1, 1000000001, 1000000002, 1000000003, 1000000004).group("/SURF/PART/1", {1});
  far.group("/GRNOD/NODE/2", {1000000009});
  const Built b(far.add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.25"));
  const std::string svg =
      side_view_svg(b.scene, found(b, "1000000009/1000000001-1000000002-1000000003-1000000004"));
  const std::string title =
      "Interface 1 TYPE7: node 1000000009 on segment 1000000001-1000000002-1000000003-1000000004";
  EXPECT_THAT(svg, HasSubstr("<text x='10' y='18'>" + title + "</text>"));
  EXPECT_EQ(attribute(svg, "width"), 20 + 7.5 * static_cast<double>(title.size()));
}

TEST(SideView, EquationsTellOnWhichSideTheNodeIs) {
  EXPECT_EQ(pair_equation({1.25, 0.75, 0.5, 0.5, 0, 0}), "depth 0.75 = gap 1.25 - distance 0.5");
  EXPECT_EQ(pair_equation({1.25, 1.75, -0.5, 0.5, 0, 0}),
            "depth 1.75 = gap 1.25 + distance 0.5: the node is behind the surface");
  EXPECT_EQ(pair_equation({1.25, 0.75, 0.5, 0.625, 0, 0}),
            "depth 0.75 of a gap of 1.25: at the rim of a surface the gap is rounded off");
  // A millionth of the larger of gap and depth is the same.
  EXPECT_THAT(pair_equation({2, 1, 1, 1 + 1.9e-6, 0, 0}), HasSubstr(" - distance"));
  EXPECT_THAT(pair_equation({2, 1, 1, 1 + 2.1e-6, 0, 0}), HasSubstr("rounded off"));
  EXPECT_THAT(pair_equation({1, 2, -1, 1 + 1.9e-6, 0, 0}), HasSubstr(" + distance"));
}

TEST(SideView, OfRowsThatNamesFitTheDeepestIsTaken) {
  // Both directions of a TYPE19 have edge pairs of the same nodes; here the second row is deeper.
  Drawn d;
  auto& rows = d.b.scene.contacts[d.pair.contact].penetrations;
  rows.push_back(rows[0]);
  rows[1].depth = 0.875;
  EXPECT_EQ(found(d.b, "9/1-2-3-4").row, 1u);
  rows[0].depth = 0.9;
  EXPECT_EQ(found(d.b, "9/1-2-3-4").row, 0u);
  EXPECT_EQ(find_pair(d.b.scene, parse_pair("9/1-2-3").value()).error().message,
            "no pair of these nodes penetrates");
  EXPECT_EQ(find_pair(d.b.scene, parse_pair("9/1-2-3-4").value(), 8).error().message,
            "no pair of these nodes penetrates in interface 8");
  EXPECT_EQ(
      side_view_text(d.b.scene, {d.pair.contact, 1}),
      "Interface 1 TYPE7: node 9 on segment 1-2-3-4\ndepth 0.875 of a gap of 1.25: at the rim "
      "of a surface the gap is rounded off\n");
}

}  // namespace
}  // namespace deck::test
