// The side view of a pair: which pair a name means, its lengths, and the drawing to scale.
#include "report/shared/side_view.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <string>

#include "contact/small_deck.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;

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

}  // namespace
}  // namespace deck::test
