// What the page knows of the contacts: pairs, sides and coordinates in the block that the viewer
// unpacks, options and totals in the document beside it, forces at nodes.
#include <gtest/gtest.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "contact/small_deck.hpp"
#include "deck/contact/view.hpp"
#include "deck/cycle/scene_cycle.hpp"
#include "model/shared/mesh.hpp"
#include "report/html/parts.hpp"

namespace deck::test {
namespace {

using Json = nlohmann::json;

/// Reads a block of the page from its begin, as the viewer does.
class PageBlock {
 public:
  explicit PageBlock(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string raw;
    unsigned bits = 0, count = 0;
    for (const char c : text) {
      if (c == '=') break;
      bits = bits << 6 | static_cast<unsigned>(digits.find(c));
      if (++count % 4 != 1) raw += static_cast<char>(bits >> (6 - 2 * ((count - 1) % 4)) & 0xff);
    }
    bytes_.resize(1 << 16);
    uLongf size = bytes_.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes_.data()), &size,
                         reinterpret_cast<const Bytef*>(raw.data()), raw.size()),
              Z_OK);
    bytes_.resize(size);
  }
  const std::string& bytes() const { return bytes_; }
  bool done() const { return at_ == bytes_.size(); }
  unsigned byte() { return static_cast<unsigned char>(bytes_.at(at_++)); }
  std::uint64_t u() {
    std::uint64_t v = 0;
    for (unsigned shift = 0;; shift += 7) {
      const unsigned b = byte();
      v |= std::uint64_t{b & 0x7f} << shift;
      if (b < 0x80) return v;
    }
  }
  /// `count` whole numbers, each as the difference from the one before.
  std::vector<std::int64_t> deltas(std::size_t count) {
    std::vector<std::int64_t> out;
    std::int64_t last = 0;
    for (; count > 0; --count) {
      const std::uint64_t v = u();
      out.push_back(last += static_cast<std::int64_t>(v >> 1) ^ -static_cast<std::int64_t>(v & 1));
    }
    return out;
  }
  std::vector<double> reals(std::size_t count) {
    std::vector<std::uint64_t> bits(count);
    for (unsigned plane = 0; plane < 8; ++plane)
      for (std::uint64_t& b : bits) b |= std::uint64_t{byte()} << (8 * plane);
    std::vector<double> out;
    for (const std::uint64_t b : bits) out.push_back(std::bit_cast<double>(b));
    return out;
  }
  std::vector<double> decimals(std::size_t count) {
    const std::size_t places = u();
    if (places == 0) return reals(count);
    std::vector<double> out;
    for (const std::int64_t n : deltas(count))
      out.push_back(static_cast<double>(n) / std::pow(10, places - 1));
    return out;
  }
  std::vector<double> palette(std::size_t count) {
    const std::size_t n = u();
    const std::vector<double> values = reals(n);
    std::vector<double> out(count, values.empty() ? 0.0 : values[0]);
    if (n > 1)
      for (double& v : out) v = values.at(u());
    return out;
  }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

/// Two quads side by side; node 9 is 0.5 over the first, node 8 far away.
SmallDeck plates(const std::string& interface) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(5, 20, 0, 0).node(6, 20, 10, 0).node(8, 5, 5, 300).node(9, 3, 4, 0.5);
  d.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4).shell(1, 2, 2, 5, 6, 3);
  return d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {9, 8}).add(interface);
}

struct Page {
  explicit Page(const SmallDeck& d, const SceneOptions& options = {})
      : b(d, options), view(make_view(b.scene)), nodes(b.model.nodes.size()) {
    input.path = "x";
    input.deck = &b.deck;
    input.scene = &b.scene;
    input.view = &view;
  }
  void collect() {
    page = detail::collect_contacts(input, nodes);
    nodes.number();
  }
  Json contacts() const {
    std::string text;
    JsonWriter j(text);
    j.begin_object();
    detail::write_contacts(j, input, page);
    j.end_object();
    return Json::parse(text)["contacts"];
  }
  std::int64_t id(std::int64_t number) const {
    return b.model.node_id(nodes.list().at(static_cast<std::size_t>(number)));
  }
  Built b;
  SceneView view;
  HtmlInput input;
  detail::PageNodes nodes;
  detail::PageContacts page;
};

using Ids = std::vector<std::int64_t>;

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
