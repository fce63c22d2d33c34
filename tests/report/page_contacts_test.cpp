// What the page knows of the contacts: pairs, sides and coordinates in the block that the viewer
// unpacks, options and totals in the document beside it, forces at nodes.
#include <limits>
#include <map>
#include <set>

#include "deck/cycle/scene_cycle.hpp"
#include "model/shared/mesh.hpp"
#include "report/inspected.hpp"
#include "report/page.hpp"

namespace deck::test {
namespace {

/// Two quads side by side; node 9 is 0.5 over the first, node 8 far away.
SmallDeck plates(const std::string& interface) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(5, 20, 0, 0).node(6, 20, 10, 0).node(8, 5, 5, 300).node(9, 3, 4, 0.5);
  d.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4).shell(1, 2, 2, 5, 6, 3);
  return d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {9, 8}).add(interface);
}

TEST(PageContacts, HoldPairsSidesAndExactCoordinates) {
  Page p(plates("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1"));
  p.collect();
  ASSERT_EQ(p.page.contacts.size(), 1u);
  const detail::PageContact wide = p.page.contacts[0];
  EXPECT_TRUE(wide.complete);
  EXPECT_GT(wide.margin, 0);
  // Three times the largest gap there could be: that of the card, or both half thicknesses.
  EXPECT_DOUBLE_EQ(wide.reach, 3 * 1 + wide.margin);
  ASSERT_FALSE(wide.pairs.empty());
  const detail::ContactBlocks blocks = detail::contact_blocks(p.input, p.page, p.nodes);
  PageBlock shared(blocks.shared()), in(blocks.contacts());
  // Coordinates of the nodes of pairs: node 8 has none.
  Ids exact;
  for (const std::int64_t n : shared.deltas(shared.u())) exact.push_back(p.id(n));
  const bool both = wide.pairs.size() == 2;
  EXPECT_EQ(exact, both ? (Ids{1, 2, 3, 4, 5, 6, 9}) : (Ids{1, 2, 3, 4, 9}));
  const auto x = shared.decimals(exact.size()), y = shared.decimals(exact.size()),
             z = shared.decimals(exact.size());
  EXPECT_EQ((std::vector{x.back(), y.back(), z.back()}), (std::vector{3.0, 4.0, 0.5}));
  EXPECT_EQ(x[1], 10.0);
  // The segments of all contacts: corners, then kinds, ids and parts of their elements; no edges.
  ASSERT_EQ(shared.u(), 2u);
  Ids corners;
  for (const std::int64_t n : shared.deltas(8)) corners.push_back(p.id(n));
  EXPECT_EQ(corners, (Ids{1, 2, 3, 4, 2, 5, 6, 3}));
  EXPECT_EQ(shared.byte(), static_cast<unsigned>(ElementKind::shell4) + 1);
  EXPECT_EQ(shared.byte(), static_cast<unsigned>(ElementKind::shell4) + 1);
  EXPECT_EQ(shared.deltas(2), (Ids{1, 2}));
  EXPECT_EQ(shared.deltas(2), (Ids{1, 1}));
  EXPECT_EQ(shared.u(), 0u);
  EXPECT_TRUE(shared.done());
  // Of its pairs the secondary, how often, and the mains.
  const std::size_t pairs = in.u();
  ASSERT_EQ(pairs, wide.pairs.size());
  const Ids secondary = in.deltas(1);
  EXPECT_EQ(in.u(), pairs);
  const Ids main = in.deltas(pairs);
  for (std::size_t k = 0; k < pairs; ++k) {
    EXPECT_EQ(secondary[0], wide.pairs[k].secondary);
    EXPECT_EQ(main[k], wide.pairs[k].main);
  }
  // The secondary side: nodes and gaps; the main side: numbers of segments and thicknesses.
  const Contact& c = p.b.scene.contacts[0];
  const detail::PlainSides& plain = wide.plain;
  ASSERT_EQ(in.u(), 2u);
  const Ids side = in.deltas(2);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_EQ(p.id(side[k]), p.b.model.node_id(c.secondary[k].node));
  EXPECT_EQ(in.palette(2), plain.half_thickness);
  ASSERT_EQ(in.u(), 2u);
  EXPECT_EQ(in.deltas(2), (Ids{0, 1}));
  EXPECT_EQ(in.palette(2), (std::vector{2.0, 2.0}));
  // Kind, id and part of an element of the node that has pairs, its place, lengths.
  for (int k = 0; k < 3 + 2; ++k) in.u();
  EXPECT_EQ(in.reals(1),
            (std::vector{plain.secondary_length[static_cast<std::size_t>(secondary.front())]}));
  std::vector<double> lengths;
  for (const std::int64_t m : std::set<std::int64_t>(main.begin(), main.end()))
    lengths.push_back(plain.main_length[static_cast<std::size_t>(m)]);
  EXPECT_EQ(in.reals(lengths.size()), lengths);
  EXPECT_TRUE(in.done());
}

/// Two sheets of one quad each, 0.5 apart, half thicknesses 0.5 and 0.25: 0.25 inside the gap.
SmallDeck near_sheets(const std::string& interface) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(11, 3, 3, 0.5).node(12, 7, 3, 0.5).node(13, 7, 7, 0.5).node(14, 3, 7, 0.5);
  d.shell_part(1, 1).shell_part(2, 0.5).shell(1, 1, 1, 2, 3, 4).shell(2, 2, 11, 12, 13, 14);
  return d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2}).add(interface);
}

TEST(PageContacts, NameTheSegmentsThatTheyShare) {
  Page p(near_sheets("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1")
             .group("/GRNOD/NODE/2", {11, 12, 13, 14})
             .add("@/INTER/TYPE7/2 grnd_IDs=2 surf_IDm=2 Gapmin=1")
             .add("@/INTER/TYPE7/3 grnd_IDs=2 surf_IDm=1 Gapmin=2"));
  p.collect();
  ASSERT_EQ(p.page.contacts.size(), 3u);
  PageBlock in(detail::contact_blocks(p.input, p.page, p.nodes).shared());
  const std::size_t exact = in.deltas(in.u()).size();
  for (int axis = 0; axis < 3; ++axis) in.decimals(exact);
  EXPECT_EQ(in.u(), 2u) << "three contacts, two surfaces of a segment each";
  Ids corners;
  for (const std::int64_t n : in.deltas(8)) corners.push_back(p.id(n));
  EXPECT_EQ(corners, (Ids{1, 2, 3, 4, 11, 12, 13, 14}));
}

TEST(PageContacts, OfATooLargeGapAreWhatPenetrates) {
  // A reach that is no number: pairs of it cannot be searched.
  Page p(plates("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1"));
  p.b.scene.contacts[0].max_gap = std::numeric_limits<double>::infinity();
  p.collect();
  const auto& wide = p.page.contacts.at(0);
  EXPECT_FALSE(wide.complete);
  EXPECT_EQ(wide.reach, 0);
  ASSERT_EQ(wide.pairs.size(), p.b.scene.contacts[0].penetrations.size());
  ASSERT_FALSE(wide.pairs.empty());
  EXPECT_EQ(wide.pairs[0].main, p.b.scene.contacts[0].penetrations[0].main);
}

TEST(PageContacts, ReachFollowsTheThicknessWhereItIsMoreThanTheGap) {
  for (const double gap : {0.01, 0.2}) {
    Page p(plates("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=" + std::to_string(gap)));
    p.collect();
    double most = 0;
    for (const double half : p.page.contacts[0].plain.half_thickness) most = std::max(most, half);
    EXPECT_DOUBLE_EQ(p.page.contacts[0].reach - p.page.contacts[0].margin, 3 * (most + 1.0)) << gap;
  }
}

TEST(PageContacts, AreDescribedAsTheSceneHasThem) {
  Page p(plates("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1 Irem_gap=1"));
  p.collect();
  p.b.scene.contacts[0].candidates = 41;
  p.b.scene.contacts[0].removed_pairs = 42;
  const Json c = p.contacts().at(0);
  EXPECT_EQ(c["interface"], 0);
  EXPECT_EQ(c["secondary"], 2);
  EXPECT_EQ(c["main"], 2);
  EXPECT_EQ(c["candidates"], 41);
  EXPECT_EQ(c["removed_pairs"], 42);
  EXPECT_EQ(c["pairs"], p.page.contacts[0].pairs.size());
  EXPECT_EQ(c["reach"], p.page.contacts[0].reach);
  EXPECT_EQ(c["gapmin"], 1.0);
  EXPECT_EQ(c["card"]["Gapmin"], 1.0);
  EXPECT_EQ(c["card"]["Irem_gap"], 1);
  EXPECT_EQ(c["card"]["Edge_scale_gap"], 0.0);
  ASSERT_EQ(c["default"].size(), 1u);
  EXPECT_EQ(c["default"][0][0], 2) << "shells of the main side";
  EXPECT_EQ(c["default"][0][4], 10.0) << "its shortest side";
}

TEST(PageContacts, TheCardHasWhatWasAskedForInstead) {
  Page p(plates("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1"));
  WhatIf mine, other;
  mine.interface_id = 1;
  mine.Irem_gap = 2;
  other.interface_id = 7;
  other.Irem_gap = 1;
  p.input.what_if = {mine, other};
  p.collect();
  EXPECT_EQ(p.contacts().at(0)["card"]["Irem_gap"], 2);
}

TEST(PageContacts, OfTiedInterfacesKnowNoThicknessAndNoLimit) {
  Page tied(plates("@/INTER/TYPE10/1 grnd_IDs=2 surf_IDm=1 Gap=1"));
  tied.collect();
  EXPECT_EQ(tied.contacts().at(0)["gapmin"], 1.0);
  const detail::PlainSides& none = tied.page.contacts.at(0).plain;
  EXPECT_EQ(none.half_thickness, (std::vector{0.0, 0.0}));
  EXPECT_EQ(none.secondary_length, (std::vector{0.0, 0.0}));
  EXPECT_EQ(none.main_length, (std::vector{0.0, 0.0}));
}

/// What the sides of a contact have with Igap 3 and without a factor.
TEST(PageContacts, SidesAreThoseOfASceneWithUnscaledVariableGaps) {
  for (const char* card : {"@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1",
                           "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Igap=2 Fscalegap=0.5",
                           "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Igap=3 Fscalegap=0.5",
                           "@/INTER/TYPE11/1 line_IDs=1 line_IDm=1",
                           "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=1 Igap=2"}) {
    Page p(plates(card).group("/LINE/SURF/1", {1}));
    p.collect();
    SceneOptions options;
    options.penetrations = false;
    WhatIf w;
    w.interface_id = 1;
    w.Igap = 3;
    w.Fscalegap = 1;
    options.what_if = {w};
    Diagnostics unused;
    const Scene scene = build_scene(p.b.model, *p.b.scene.interfaces, unused, options);
    ASSERT_EQ(scene.contacts.size(), p.page.contacts.size()) << card;
    for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
      const Contact& c = scene.contacts[i];
      const detail::PlainSides& plain = p.page.contacts[i].plain;
      EXPECT_EQ(plain.shortest_side, c.shortest_side) << card;
      std::vector<double> gaps, secondary, main;
      for (const SecondaryNode& s : c.secondary) {
        gaps.push_back(s.gap);
        secondary.push_back(s.length);
      }
      for (const MainSegment& m : c.main) main.push_back(m.length);
      for (const ContactEdge& e : c.secondary_edges) secondary.push_back(e.length);
      for (const ContactEdge& e : c.main_edges) main.push_back(e.length);
      EXPECT_EQ(plain.half_thickness, gaps) << card;
      EXPECT_EQ(plain.secondary_length, secondary) << card;
      EXPECT_EQ(plain.main_length, main) << card;
    }
  }
}

TEST(PageContacts, CoordinatesAreThoseOfTheDeckWhereverTheSceneHasMovedNodes) {
  Page p(plates("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1 Inacti=3"));
  p.collect();
  ASSERT_NE(p.b.scene.coordinates.z, p.b.model.nodes.z) << "Inacti 3 has moved a node";
  EXPECT_EQ(p.page.start(p.b.scene).z, p.b.model.nodes.z);
}

TEST(PageStream, DecimalsComeBackToTheLastBit) {
  const std::vector<std::vector<double>> lists{
      {},        {0, -1, 1e9, 12345.678, -0.1, 0.3, 1.0 / 1024}, {0.1 + 0.2}, {-0.0, 1}, {1e300, 1},
      {1.0 / 3}, {std::numeric_limits<double>::quiet_NaN(), 1}};
  for (const auto& list : lists) {
    detail::ByteStream out;
    out.decimals(list);
    PageBlock in(std::move(out).text());
    const std::vector<double> back = in.decimals(list.size());
    ASSERT_EQ(back.size(), list.size());
    for (std::size_t i = 0; i < list.size(); ++i)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(back[i]), std::bit_cast<std::uint64_t>(list[i]))
          << list[i];
    EXPECT_TRUE(in.done());
  }
}

TEST(PageStream, FewValuesAreNumberedInTheirOrder) {
  const std::vector<double> list{2, 2, 0, -0.0, 2, std::numeric_limits<double>::quiet_NaN(), 0};
  detail::ByteStream out;
  out.palette(list, [](double v) { return v; });
  PageBlock in(std::move(out).text());
  const std::vector<double> back = in.palette(list.size());
  for (std::size_t i = 0; i < list.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back[i]), std::bit_cast<std::uint64_t>(list[i])) << i;
  EXPECT_TRUE(in.done());
}

TEST(PageContacts, OfType25AreTheRowsAsTheyWereFound) {
  Page p(near_sheets("@/INTER/TYPE25/1 surf_ID1=1 surf_ID2=2 Inacti=5"));
  p.collect();
  const Contact& c = p.b.scene.contacts[0];
  ASSERT_EQ(c.penetrations.size(), 4u);
  const detail::PageContact own = p.page.contacts[0];
  ASSERT_EQ(own.given.size(), c.penetrations.size());
  ASSERT_EQ(own.pairs.size(), c.penetrations.size());
  EXPECT_TRUE(own.complete);
  for (std::size_t i = 0; i < own.pairs.size(); ++i)
    EXPECT_EQ(own.pairs[i].main, c.penetrations[own.given[i]].main);
  // Gaps stand in place of thicknesses.
  EXPECT_EQ(own.plain.half_thickness[0], c.secondary[0].gap);
  const Json said = p.contacts().at(0);
  EXPECT_EQ(said["given"], true);
  EXPECT_EQ(said["evaluated"], true);
  // The last numbers of the block: eight columns and a byte a row.
  const std::string bytes =
      PageBlock(detail::contact_blocks(p.input, p.page, p.nodes).contacts()).bytes();
  EXPECT_EQ(bytes.back(), static_cast<char>(PenetrationAction::offset_stored));
  EXPECT_GT(bytes.size(), 65 * own.given.size());
}

TEST(PageContacts, OfOtherTypesHaveNoGivenRows) {
  Page p(plates("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1"));
  p.collect();
  EXPECT_TRUE(p.page.contacts[0].given.empty());
  EXPECT_EQ(p.contacts().at(0)["given"], false);
}

/// Every member of a contact of nodes and segments, each figure another.
TEST(PageContacts, EveryMemberIsThatOfTheContact) {
  Page p(plates("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1 Igap=2 Fscalegap=0.8 Gapmax=7"));
  p.collect();
  Contact& c = p.b.scene.contacts.at(0);
  c.candidates = 41;
  c.removed_pairs = 42;
  c.repaired_segments = 43;
  c.degenerate_segments = 44;
  c.reoriented_segments = 45;
  c.no_carrier = {1, 2, 3};
  c.istf = 4;
  c.irem_gap = 2;
  c.itied = 1;
  c.fpenmax = 0.625;
  c.gap_scale = 0.75;
  c.gapmin = 1.125;
  c.gapmax = 7.5;
  c.drad = 0.375;
  c.max_gap = 2.125;
  c.mesh_fraction = 0.4375;
  c.igap = 3;
  c.inacti = 6;
  c.evaluated = false;
  c.dropped = true;
  detail::PageContact& wide = p.page.contacts[0];
  wide.reach = 12.5;
  wide.margin = 1.75;
  wide.complete = false;
  wide.plain.shortest_side = 8.5;
  wide.plain.main_length = {3.5, 9.5, 4.5};
  wide.plain.secondary_length = {2.5, 6.5, 1.5};
  ContactTotals& t = p.view.contacts[0];
  t = distinct_totals();
  const Json expected{{"interface", 0},
                      {"kind", "node_segment"},
                      {"role", "primary"},
                      {"type", 7},
                      {"ties", true},
                      {"dropped", true},
                      {"igap", 3},
                      {"inacti", 6},
                      {"evaluated", false},
                      {"given", false},
                      {"istf", 4},
                      {"irem_gap", 2},
                      {"itied", 1},
                      {"fpenmax", 0.625},
                      {"gap_scale", 0.75},
                      {"gapmin", 1.125},
                      {"gapmin_from", to_string(c.gapmin_origin)},
                      {"gapmax", 7.5},
                      {"drad", 0.375},
                      {"max_gap", 2.125},
                      {"shortest_side", 8.5},
                      {"mesh_fraction", 0.4375},
                      {"longest_main", 9.5},
                      {"longest_node", 6.5},
                      {"secondary", 2},
                      {"main", 2},
                      {"candidates", 41},
                      {"removed_pairs", 42},
                      {"repaired", 43},
                      {"degenerate", 44},
                      {"reoriented", 45},
                      {"no_carrier", 3},
                      {"reach", 12.5},
                      {"margin", 1.75},
                      {"complete", false},
                      {"pairs", wide.pairs.size()},
                      {"totals",
                       {{"pairs", 51},
                        {"nodes", 52},
                        {"edges", 53},
                        {"tied", {{"nodes", 55}, {"pairs", 54}}},
                        {"on_segment", {{"nodes", 57}, {"edges", 58}, {"pairs", 56}}},
                        {"crossed_elements", 59},
                        {"solver_errors", 60},
                        {"acted", 61},
                        {"max_depth", 0.1875},
                        {"max_ratio", 0.3125}}},
                      {"card",
                       {{"Gapmin", 1.0},
                        {"Igap", 2},
                        {"Inacti", 0},
                        {"Irem_gap", 1},
                        {"thermal", false},
                        {"Drad", 0.0},
                        {"Fscalegap", 0.8},
                        {"Gapmax", 7.0},
                        {"Fpenmax", 0.0},
                        {"Edge_scale_gap", 0.0}}},
                      {"default", {{2, 4.0, 2.0, 2.0, 8.5}}}};
  const Json said = p.contacts().at(0);
  for (const auto& [name, value] : expected.items()) EXPECT_EQ(said.at(name), value) << name;
  EXPECT_EQ(said.size(), expected.size());
}

/// A plate and two trusses 0.5 and 0.6 over two of its sides, in a TYPE11.
SmallDeck trusses() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(11, 5, -3, 0.5).node(12, 5, 4, 0.5).node(13, 5, 8, 0.6).node(14, 5, 13, 0.6);
  d.shell_part(1, 2).truss_part(2, 4).shell(1, 21, 1, 2, 3, 4);
  d.bar("TRUSS", 2, 22, 11, 12).bar("TRUSS", 2, 23, 13, 14);
  d.segments("/LINE/SEG/3", {{11, 12}, {13, 14}}).segments("/LINE/SEG/4", {{1, 2}, {3, 4}, {2, 3}});
  return d.add("@/INTER/TYPE11/6 line_IDs=3 line_IDm=4 Gapmin=1.25");
}

TEST(PageContacts, OfEdgesHaveTheDefaultGapsOfBothSides) {
  Page p(trusses());
  p.collect();
  const Json c = p.contacts().at(0);
  const detail::PlainSides& plain = p.page.contacts[0].plain;
  EXPECT_EQ(c["kind"], "edge_edge");
  EXPECT_EQ(c["secondary"], 2);
  EXPECT_EQ(c["main"], 3);
  EXPECT_EQ(c["longest_main"], 0.0);
  EXPECT_EQ(c["longest_node"], 0.0);
  const auto side = [](const auto& s) {
    return Json({s.thickness.count, s.thickness.sum, s.thickness.smallest, s.thickness.largest,
                 s.shortest});
  };
  EXPECT_EQ(c["default"], Json({side(plain.main_side), side(plain.secondary_side)}));
  EXPECT_EQ(plain.main_side.shortest, 10.0);
  EXPECT_EQ(plain.secondary_side.shortest, 5.0);
}

/// Line of a node in the text of a deck, by its card.
std::int64_t node_line(const Built& b, std::int64_t id) {
  const std::string text(b.deck.sources[0].bytes());
  char digits[32];
  std::snprintf(digits, sizeof digits, "\n%10lld", static_cast<long long>(id));
  const auto at = text.find(digits, text.find("\n/NODE"));
  return std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at) + 1, '\n') + 1;
}

TEST(PageContacts, OfEdgesHavePairsSidesAndPlaces) {
  Page p(trusses());
  p.collect();
  const detail::PageContact wide = p.page.contacts.at(0);
  const Contact& c = p.b.scene.contacts[0];
  EXPECT_EQ(wide.margin, 0.0) << "the solver searches edges within their gap";
  // The largest gap that edges could have: half of the shell and of the section of area 4.
  EXPECT_DOUBLE_EQ(wide.reach, 3 * (1.0 + 1.0));
  const detail::ContactBlocks blocks = detail::contact_blocks(p.input, p.page, p.nodes);
  PageBlock shared(blocks.shared()), in(blocks.contacts());
  Ids exact;
  for (const std::int64_t n : shared.deltas(shared.u())) exact.push_back(p.id(n));
  for (int axis = 0; axis < 3; ++axis) shared.decimals(exact.size());
  EXPECT_EQ(shared.u(), 0u) << "no segments";
  // Main edges come first, then the secondary ones: nodes, kinds, ids and parts.
  ASSERT_EQ(shared.u(), c.main_edges.size() + c.secondary_edges.size());
  Ids ends, expected, kinds, elements, parts;
  for (const auto* side : {&c.main_edges, &c.secondary_edges})
    for (const ContactEdge& e : *side) {
      const bool truss = e.carrier == Carrier::truss;
      for (const NodeIndex n : e.nodes) expected.push_back(p.b.model.node_id(n));
      kinds.push_back(1 + static_cast<int>(truss ? ElementKind::truss : ElementKind::shell4));
      elements.push_back(truss ? p.b.model.truss.id[e.element] : 21);
      parts.push_back(truss ? 2 : 1);
    }
  for (const std::int64_t n : shared.deltas(expected.size())) ends.push_back(p.id(n));
  EXPECT_EQ(ends, expected);
  EXPECT_EQ(shared.small(kinds.size()), kinds);
  EXPECT_EQ(shared.deltas(elements.size()), elements);
  EXPECT_EQ(shared.deltas(parts.size()), parts);
  EXPECT_TRUE(shared.done());
  // Pairs by their secondary edges.
  ASSERT_EQ(in.u(), wide.pairs.size());
  std::map<std::uint32_t, std::uint64_t> per_secondary;
  Ids mains, used;
  for (const CandidatePair& pair : wide.pairs) {
    ++per_secondary[pair.secondary];
    mains.push_back(pair.main);
  }
  std::int64_t last = 0;
  for (const auto& [secondary, count] : per_secondary) {
    EXPECT_EQ(last += in.deltas(1)[0], secondary);
    EXPECT_EQ(in.u(), count);
    used.push_back(secondary);
  }
  EXPECT_EQ(in.deltas(mains.size()), mains);
  // Numbers of the edges of each side, with their thickness: sections and shells.
  ASSERT_EQ(in.u(), 2u);
  EXPECT_EQ(in.deltas(2), (Ids{3, 4}));
  EXPECT_EQ(in.palette(2), (std::vector{2.0, 2.0}));
  ASSERT_EQ(in.u(), 3u);
  EXPECT_EQ(in.deltas(3), (Ids{0, 1, 2}));
  EXPECT_EQ(in.palette(3), (std::vector{2.0, 2.0, 2.0}));
  // File and line of the first node of each secondary edge that has pairs.
  std::int64_t file = 0, line = 0;
  for (const std::int64_t s : used) {
    EXPECT_EQ(file += in.deltas(1)[0], 0);
    const NodeIndex n = c.secondary_edges[static_cast<std::size_t>(s)].nodes[0];
    EXPECT_EQ(line += in.deltas(1)[0], node_line(p.b, p.b.model.node_id(n)));
  }
  in.reals(used.size());
  in.reals(std::set<std::int64_t>(mains.begin(), mains.end()).size());
  EXPECT_TRUE(in.done());
}

TEST(PageContacts, SecondaryNodesAreNamedByTheFirstFamilyWithAnElementAtThem) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 90, 0, 0).node(3, 90, 90, 0).node(4, 0, 90, 0);
  d.shell_part(1, 2).shell(1, 21, 1, 2, 3, 4).truss_part(2, 1).beam_part(3, 1).spring_part(4, 1);
  const auto at = [&](int id, double x) { d.node(id, x, x, 0.5); };
  for (int id = 31; id < 40; ++id) at(id, 9 * (id - 30));
  d.shell_part(5, 1).shell3(5, 22, 31, 32, 33).bar("TRUSS", 2, 23, 33, 34);
  d.bar("BEAM", 3, 24, 34, 35, 36).bar("SPRING", 4, 25, 35, 37).bar("SPRING", 4, 26, 37, 38);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {31, 33, 34, 35, 37, 39});
  Page p(d.add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1"));
  p.collect();
  PageBlock in(detail::contact_blocks(p.input, p.page, p.nodes).contacts());
  const std::size_t pairs = in.u();
  ASSERT_EQ(pairs, 6u);
  for (std::size_t k = 0; k < pairs; ++k) {
    in.deltas(1);
    in.u();
  }
  in.deltas(pairs);
  Ids nodes;
  for (const std::int64_t n : in.deltas(in.u())) nodes.push_back(p.id(n));
  in.palette(nodes.size());
  in.palette(in.deltas(in.u()).size());
  std::map<std::int64_t, Ids> expected{{31, {2, 22, 5}}, {33, {2, 22, 5}}, {34, {7, 24, 3}},
                                       {35, {7, 24, 3}}, {37, {8, 25, 4}}, {39, {0, 0, 0}}};
  Ids kinds, ids, parts, lines;
  for (const std::int64_t n : nodes) {
    kinds.push_back(expected.at(n)[0]);
    ids.push_back(expected.at(n)[1]);
    parts.push_back(expected.at(n)[2]);
    lines.push_back(node_line(p.b, n));
  }
  EXPECT_EQ(in.small(pairs), kinds);
  EXPECT_EQ(in.deltas(pairs), ids);
  Ids positions;  // plus 1
  for (const std::int64_t id : parts) {
    std::int64_t k = 0;
    for (std::size_t i = 0; i < p.b.model.parts.size(); ++i)
      if (p.b.model.parts[i].id == id) k = static_cast<std::int64_t>(i) + 1;
    positions.push_back(k);
  }
  EXPECT_EQ(in.deltas(pairs), positions);
  std::int64_t file = 0, line = 0;
  for (const std::int64_t expected_line : lines) {
    EXPECT_EQ(file += in.deltas(1)[0], 0);
    EXPECT_EQ(line += in.deltas(1)[0], expected_line);
  }
}

TEST(PageContacts, RemovalAlongTheMeshNeedsAllItems) {
  for (const int removal : {1, 2}) {
    Page p(plates("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1"));
    p.collect();
    p.b.scene.contacts[0].irem_gap = removal;
    PageBlock in(detail::contact_blocks(p.input, p.page, p.nodes).shared());
    Ids exact;
    for (const std::int64_t n : in.deltas(in.u())) exact.push_back(p.id(n));
    // Of node 8 there is no pair; node 5 and 6 are those of the segment that node 9 is not over.
    EXPECT_EQ(std::count(exact.begin(), exact.end(), 8), removal == 2) << removal;
  }
}

TEST(PageContacts, AfterMovesOfInactiThreeSidesThatCanChangeAreExact) {
  // Interface 1 may move node 5, a corner of the main side of interface 2, which has no pairs.
  for (const bool first : {true, false}) {
    SmallDeck d;
    d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
    d.node(5, 4, 4, 0.5).node(6, 6, 4, 50).node(7, 6, 6, 50).node(9, 500, 500, 500);
    d.shell_part(1, 1).shell_part(2, 1).shell(1, 1, 1, 2, 3, 4).shell3(2, 2, 5, 6, 7);
    d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2}).group("/GRNOD/NODE/1", {5});
    d.group("/GRNOD/NODE/2", {9});
    const std::string moves = "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1";
    const std::string other = "@/INTER/TYPE7/2 grnd_IDs=2 surf_IDm=2 Gapmin=1";
    Page p(d.add(first ? moves + "\n" + other : other + "\n" + moves));
    p.collect();
    PageBlock in(detail::contact_blocks(p.input, p.page, p.nodes).shared());
    Ids exact;
    for (const std::int64_t n : in.deltas(in.u())) exact.push_back(p.id(n));
    EXPECT_EQ(exact, first ? (Ids{1, 2, 3, 4, 5, 6, 7}) : (Ids{1, 2, 3, 4, 5}));
  }
}

TEST(PageInterfaces, HaveTheLinesOfTheirCardAndTheCellsThatCanBeChanged) {
  Page p(plates(
      "@/INTER/TYPE7/4 grnd_IDs=2 surf_IDm=1 Gapmin=1.5 Fscalegap=0.8 Gapmax=7 Igap=2 Inacti=6"));
  const Json all =
      members([&](JsonWriter& j) { detail::write_interfaces(j, p.input); })["interfaces"];
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0]["id"], 4);
  EXPECT_EQ(all[0]["type"], 7);
  EXPECT_EQ(all[0]["title"], p.b.scene.interfaces->ordered[0]->title);
  const Json& card = all[0]["card"];
  EXPECT_EQ(card["file"], p.b.deck.sources[0].path());
  const std::string text(p.b.deck.sources[0].bytes());
  const auto header = text.find("/INTER/TYPE7/4");
  EXPECT_EQ(card["line"],
            1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(header), '\n'));
  // All lines of the block, its header first.
  std::vector<std::string> lines;
  for (auto at = header; at < text.size() && (at == header || text[at] != '/');) {
    const auto end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  ASSERT_GE(lines.size(), 5u);
  EXPECT_EQ(card["lines"].get<std::vector<std::string>>(),
            (std::vector<std::string>(lines.begin(), lines.end())));
  // Each cell is where its value stands.
  std::map<std::string, std::pair<std::string, bool>> values{
      {"Gapmin", {"1.5", true}}, {"Fscalegap", {"0.8", true}}, {"Gapmax", {"7", true}},
      {"Igap", {"2", false}},    {"Inacti", {"6", false}},     {"Fpenmax", {"", true}}};
  Ids nothing;
  for (const Json& cell : card["cells"]) {
    const auto it = values.find(cell["field"]);
    ASSERT_NE(it, values.end()) << cell;
    const std::string line = lines.at(cell["line"].get<std::size_t>());
    const auto first = cell["first"].get<std::size_t>(), last = cell["last"].get<std::size_t>();
    std::string shown = line.size() < first ? "" : line.substr(first - 1, last - first + 1);
    shown.erase(0, std::min(shown.find_first_not_of(' '), shown.size()));
    shown.erase(shown.find_last_not_of(' ') + 1);
    EXPECT_EQ(shown, it->second.first) << cell;
    EXPECT_EQ(cell["real"], it->second.second) << cell;
    EXPECT_EQ(cell["factor"], 1.0) << cell;
    EXPECT_EQ(cell["nothing"], cell["field"] == "Igap"     ? 1000
                               : cell["field"] == "Inacti" ? 1000
                                                           : 0)
        << cell;
    EXPECT_EQ(cell["parameter"], false);
    EXPECT_EQ(cell["free"], false);
    values.erase(it);
  }
  EXPECT_TRUE(values.empty()) << values.begin()->first;
  EXPECT_EQ(all[0]["values"]["Gapmin"], Json({{"value", 1.5}, {"origin", "card"}, {"input", 1.5}}));
  EXPECT_EQ(all[0]["values"]["Igap"], Json({{"value", 2}, {"origin", "card"}, {"input", 2}}));
  EXPECT_EQ(all[0]["values"]["Fpenmax"]["input"], Json());
}

TEST(PageInterfaces, NameTheGapOfATypeTenAsItsCardDoes) {
  Page p(plates("@/INTER/TYPE10/1 grnd_IDs=2 surf_IDm=1 Gap=1.5"));
  const Json cells = members([&](JsonWriter& j) {
    detail::write_interfaces(j, p.input);
  })["interfaces"][0]["card"]["cells"];
  const auto gap = std::find_if(cells.begin(), cells.end(),
                                [](const Json& c) { return c["field"] == "Gapmin"; });
  EXPECT_NE(gap, cells.end()) << cells;
}

TEST(PageInterfaces, WhatIfHasEveryValueThatWasAskedFor) {
  WhatIf all, few;
  all.interface_id = 3;
  all.Gapmin = 0.5;
  all.Fscalegap = 0.6;
  all.Gapmax = 0.7;
  all.Fpenmax = 0.8;
  all.mesh_size = 0.9;
  all.Igap = 3;
  all.Inacti = 5;
  all.Irem_gap = 2;
  few.interface_id = 4;
  EXPECT_EQ(members([&](JsonWriter& j) {
              detail::write_what_if(j, {all, few});
            })["what_if"],
            Json({{{"interface", 3},
                   {"Gapmin", 0.5},
                   {"Fscalegap", 0.6},
                   {"Gapmax", 0.7},
                   {"Fpenmax", 0.8},
                   {"%mesh_size", 0.9},
                   {"Igap", 3},
                   {"Inacti", 5},
                   {"Irem_gap", 2}},
                  {{"interface", 4}}}));
}

/// One quad, a node 0.5 over it, one 40 over it and one far beyond its rim, tied with dsearch 2.
SmallDeck tied_nodes() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(101, 5, 5, 0.5).node(102, 5, 5, 40).node(103, 500, 5, 0);
  d.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4).group("/SURF/PART/1", {1});
  d.group("/GRNOD/NODE/9", {101, 102, 103});
  return d.add("@/INTER/TYPE2/7 grnd_IDs=9 surf_IDm=1 Ignore=1 dsearch=2");
}

TEST(PageTies, HaveTheirNodesSegmentsAndWhatIsSaidOfThem) {
  SceneOptions options;
  options.ties = true;
  Page p(tied_nodes(), options);
  p.page.of_ties = detail::use_nodes(p.b.scene, p.nodes);
  p.collect();
  const Json tie = Json::parse(PageBlock(detail::ties_block(p.input, p.nodes)).bytes()).at(0);
  EXPECT_EQ(tie["holds"], Json({0, 1, 1}));
  EXPECT_EQ(tie["nodes"].size(), 3u);
  EXPECT_EQ(p.id(tie["nodes"][1]), 102);
  EXPECT_EQ(tie["segment"][0], 0);
  EXPECT_EQ(tie["main"].size(), 4u);
  ASSERT_EQ(tie["rows"].size(), 2u) << "what is tied needs no row";
  EXPECT_EQ(tie["rows"][0][0], 1);
  EXPECT_EQ(tie["rows"][0][1], 40.0);
  EXPECT_EQ(tie["rows"][0][2], 2.0);
  EXPECT_EQ(tie["rows"][0][4], "too far (1157)");
  std::string text;
  JsonWriter j(text);
  j.begin_object();
  detail::write_page_ties(j, p.input);
  j.end_object();
  const Json said = Json::parse(text)["ties"].at(0);
  EXPECT_EQ(said["text"], "2 of 3 nodes are not tied");
  EXPECT_EQ(said["losses"], "2 not found");
  EXPECT_EQ(said["stops"], false);
  EXPECT_EQ(said["interface"], 0);
}

/// A tie of four nodes: beside the rim of the quad (its box is wide), too far, in place, and on
/// nothing; node 101 is one of part 2.
TEST(PageTies, RowsSayPartReasonAndPlace) {
  SceneOptions options;
  options.ties = true;
  Page p(tied_nodes(), options);
  p.page.of_ties = detail::use_nodes(p.b.scene, p.nodes);
  p.collect();
  Tie& tie = p.b.scene.ties.at(0);
  ASSERT_EQ(tie.nodes.size(), 3u);
  tie.main_and_tied.clear();
  const auto read = [&] {
    return Json::parse(PageBlock(detail::ties_block(p.input, p.nodes)).bytes()).at(0);
  };
  Json t = read();
  Ids corners, nodes;
  for (const Json& n : t["main"]) corners.push_back(p.id(n));
  for (const Json& n : t["nodes"]) nodes.push_back(p.id(n));
  EXPECT_EQ(nodes, (Ids{101, 102, 103}));
  EXPECT_EQ(std::set<std::int64_t>(corners.begin(), corners.end()),
            (std::set<std::int64_t>{1, 2, 3, 4}));
  EXPECT_EQ(t["segment"].size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const TiedNode& n = tie.nodes[i];
    EXPECT_EQ(t["segment"][i], n.segment != no_index || n.nearest != no_index ? 0 : -1) << i;
  }
  for (const Json& row : t["rows"]) {
    const TiedNode& n = tie.nodes[row[0].get<std::size_t>()];
    EXPECT_EQ(row.size(), 8u);
    EXPECT_EQ(row[3], -1) << "no element has it";
    EXPECT_EQ(row[4], short_reason(tie, n));
    EXPECT_EQ(row[5], why_text(tie, n));
    EXPECT_EQ(row[6], 0);
    EXPECT_EQ(row[7], node_line(p.b, p.b.model.node_id(n.node)));
  }
  // Beyond the rim: tied, but with a message; its own search distance goes before that of the tie.
  tie.nodes[0].message = 1073;
  tie.nodes[0].distance = 0.75;
  tie.nodes[0].search = 3.5;
  tie.nodes[2].tied = false;
  tie.nodes[2].removed_by = 1630;
  t = read();
  EXPECT_EQ(t["holds"], Json({2, 1, 3}));
  ASSERT_EQ(t["rows"].size(), 2u);
  EXPECT_EQ(t["rows"][0][0], 1) << "what is lost comes first";
  EXPECT_EQ(t["rows"][1][0], 0);
  EXPECT_EQ(t["rows"][1][1], 0.75);
  EXPECT_EQ(t["rows"][1][2], 3.5);
  tie.search_distance = 0;
  tie.nodes[1].search = 0;
  tie.nodes[1].nearest = no_index;
  tie.nodes[1].segment = no_index;
  t = read();
  EXPECT_EQ(t["rows"][0][1], Json());
  EXPECT_EQ(t["rows"][0][2], Json());
  EXPECT_EQ(t["segment"][1], -1);
}

TEST(PageTies, SayHowManyNodesTheyHoldAndWhetherTheSolverStops) {
  SceneOptions options;
  options.ties = true;
  Page p(tied_nodes().add("@/INTER/TYPE7/1 grnd_IDs=9 surf_IDm=1 Gapmin=1"), options);
  Tie& tie = p.b.scene.ties.at(0);
  const auto said = [&] {
    return members([&](JsonWriter& j) { detail::write_page_ties(j, p.input); })["ties"].at(0);
  };
  tie.nodes[0].distance = 0.5;
  tie.nodes[1].distance = 99;
  EXPECT_EQ(said(), Json({{"interface", 1},
                          {"nodes", 3},
                          {"tied", 1},
                          {"lost", 2},
                          {"beyond_rim", 0},
                          {"search_distance", 2.0},
                          {"farthest", 0.5},
                          {"text", holds_text(tie)},
                          {"losses", losses_text(tie)},
                          {"evaluated", true},
                          {"stops", false}}));
  tie.ignore = 0;
  EXPECT_EQ(said()["stops"], true) << "Ignore 0: a node that is not tied stops the solver";
  tie.ignore = 1;
  tie.main_and_tied = {0};
  EXPECT_EQ(said()["stops"], true) << "a main node that a tie holds stops it always";
  tie.not_evaluated = "too far";
  EXPECT_EQ(said()["evaluated"], false);
}

TEST(PageTies, NodesThatNoElementHasGetTheirCoordinates) {
  SceneOptions options;
  options.ties = true;
  Page p(tied_nodes(), options);
  const std::vector<NodeIndex> wanted = detail::use_nodes(p.b.scene, p.nodes);
  EXPECT_NE(std::find(wanted.begin(), wanted.end(), p.b.model.nodes.map.find(101)), wanted.end());
}

TEST(PageForces, NodesHaveForceStiffnessAndStep) {
  Page p(plates("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1"));
  cycle::ActedNode a;
  a.node = p.b.model.nodes.map.find(9);
  a.force = {1.5, -2.5, 3.5};
  a.stiffness = 7;
  a.dt = 0.25;
  const std::array acted{a};
  detail::use_nodes(acted, p.nodes);
  p.nodes.number();
  cycle::SceneOutcome outcome;
  const auto written = [&] {
    const PageBlock block(detail::cycle_block(outcome, acted, p.nodes, p.b.model));
    return Json::parse(block.bytes());
  };
  EXPECT_EQ(written()["nodes"], Json::parse("[[0,1.5,-2.5,3.5,7.0,0.25]]"));
  EXPECT_EQ(written()["structure_element"], Json()) << "no element limits";
  outcome.structure = {0.125, ElementKind::shell4, 1};
  EXPECT_EQ(written()["structure_element"], Json::array({0, p.b.model.shell4.id[1]}));
}

TEST(PageSteps, ColourANodeByTheSmallestStepOfItsElementsInEqualRatios) {
  Page p(plates("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1"));
  for (NodeIndex n = 0; n < p.b.model.nodes.size(); ++n) p.nodes.use(n);
  p.nodes.number();
  Mesh mesh;
  mesh.elements[static_cast<std::size_t>(ElementKind::shell4)].dt = {1.0, 16.0};
  PageBlock block(detail::steps_block(p.b.model, mesh, p.nodes));
  EXPECT_EQ(block.reals(3), (std::vector<double>{1, 16, 16}));
  std::map<std::int64_t, unsigned> shade;
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(p.nodes.list().size()); ++i)
    shade[p.id(i)] = block.byte();
  EXPECT_TRUE(block.done());
  // Nodes 1 to 4 have the first shell, 5 and 6 only the second, 8 and 9 none.
  EXPECT_EQ(shade, (std::map<std::int64_t, unsigned>{
                       {1, 255}, {2, 255}, {3, 255}, {4, 255}, {5, 1}, {6, 1}, {8, 0}, {9, 0}}));
}

TEST(PageSteps, LeaveOutElementsWithoutAStep) {
  Page p(plates("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1"));
  for (NodeIndex n = 0; n < p.b.model.nodes.size(); ++n) p.nodes.use(n);
  p.nodes.number();
  Mesh mesh;
  mesh.elements[static_cast<std::size_t>(ElementKind::shell4)].dt = {NAN, 1e30};
  PageBlock block(detail::steps_block(p.b.model, mesh, p.nodes));
  EXPECT_EQ(block.reals(3), (std::vector<double>{0, 0, 0}));
  for (std::size_t i = 0; i < p.nodes.list().size(); ++i) EXPECT_EQ(block.byte(), 0u);
}

}  // namespace
}  // namespace deck::test
