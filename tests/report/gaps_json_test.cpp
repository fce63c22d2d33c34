// The JSON of `deck gaps`: lengths of pairs, ties, the verdict.
#include <nlohmann/json.hpp>

#include "deck/lint.hpp"
#include "deck/report.hpp"
#include "deck/verdict.hpp"
#include "report/inspected.hpp"

namespace deck::test {
namespace {

nlohmann::json document_of(const std::string& text) {
  const Inspected d(text);
  return nlohmann::json::parse(gaps_json("test_0000.rad", d.deck, d.scene, d.view, false));
}

/// The border of a plate against that of a larger one below it, 2 to the side and 0.25 up.
std::string edges() {
  Plates p;
  p.card = "Gapmin=0.1\n@/INTER/TYPE11/3 line_IDs=4 line_IDm=3 Gapmin=2.5";
  p.card += "\n/LINE/EDGE/3\nlower\n         1\n/LINE/EDGE/4\nupper\n         2";
  p.card += "\n/SURF/PART/2\nupper\n         2";
  p.height = 0.25;
  return plates(p);
}

/// Nodes of the upper plate tied to the lower one.
std::string tied() {
  Plates p;
  p.card = "Gapmin=0.1\n@/INTER/TYPE10/3 grnd_IDs=2 surf_IDm=1 Gap=0.5";
  return plates(p);
}

TEST(GapsJson, FiguresOfEdgePairsAreLengths) {
  std::size_t rows = 0;
  const auto all = document_of(edges());
  for (const auto& inter : all["interfaces"])
    for (const auto& contact : inter["contacts"])
      for (const auto& p : contact["penetrations"]) {
        if (!p.contains("edge")) continue;
        ++rows;
        const double gap = p["gap"], distance = p["distance"];
        EXPECT_EQ(gap, 2.5);
        EXPECT_EQ(p["penetration"].get<double>(), gap - distance);
        EXPECT_EQ(p["solver"]["gap"].get<double>(), gap * gap);
        EXPECT_EQ(p["solver"]["penetration"].get<double>(), gap * gap - distance);
      }
  EXPECT_GT(rows, 0u) << all.dump(1);
}

TEST(GapsJson, TiesAreListedAndCountedAsTies) {
  const auto all = document_of(tied());
  EXPECT_EQ(all["summary"]["pairs"], 0);
  EXPECT_EQ(all["summary"]["tied"]["pairs"], 4);
  EXPECT_EQ(all["summary"]["tied"]["nodes"], 4);
  for (const auto& inter : all["interfaces"])
    for (const auto& contact : inter["contacts"]) {
      EXPECT_TRUE(contact["penetrations"].empty());
      EXPECT_EQ(contact.value("tied_pairs", nlohmann::json::array()).size(),
                inter["type"] == 10 ? 4u : 0u);
    }
}

TEST(GapsJson, AnEarlierVersionIsRefusedWithTheCommandThatWritesItAnew) {
  const auto earlier = read_earlier_gaps(
      "old.json",
      R"({"schema":{"id":"deck/gaps","version":1},"deck":{"path":"a.rad"},"interfaces":[]})",
      "a.rad");
  ASSERT_FALSE(earlier.ok());
  EXPECT_THAT(earlier.error().message, testing::HasSubstr("deck gaps a.rad --json old.json"));
}

/// Nodes of the first deck's ties that the second one has lost.
std::size_t lost_ties(const std::string& before, const std::string& now) {
  const auto loaded = [](const std::string& text) {
    LoadedDeck deck =
        LoadedDeck::from(std::move(*read_deck_text("d_0000.rad", text, SchemaSet::built_in())));
    SceneOptions options = deck.scene_options();
    options.ties = true;
    deck.set_scene_options(options);
    return deck;
  };
  const LoadedDeck old = loaded(before), deck = loaded(now);
  const std::string json =
      gaps_json("d_0000.rad", old.deck(), old.scene(), make_view(old.scene()), false);
  const auto earlier = read_earlier_gaps("old.json", json, "d_0000.rad");
  std::size_t lost = 0;
  for (const auto& [inter, nodes] :
       compare_gaps(*earlier, deck.scene(), make_view(deck.scene())).lost_ties)
    lost += nodes.size();
  return lost;
}

TEST(GapsJson, NodesThatATypeTenTiesNoMoreAreLost) {
  std::string loose = tied();
  loose.replace(loose.find(" 0.5"), 4, "0.01");
  EXPECT_EQ(lost_ties(tied(), loose), 4u);
  EXPECT_EQ(lost_ties(tied(), tied()), 0u);
  EXPECT_EQ(lost_ties(loose, loose), 0u);
}

TEST(GapsJson, NodesThatATypeTwoTiesNoMoreAreLost) {
  SmallDeck near;
  near.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(9, 5, 5, 1);
  near.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4);
  near.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {9});
  SmallDeck far = near;
  near.add("@/INTER/TYPE2/7 grnd_IDs=2 surf_IDm=1 Ignore=1 dsearch=2");
  far.add("@/INTER/TYPE2/7 grnd_IDs=2 surf_IDm=1 Ignore=1 dsearch=0.5");
  EXPECT_EQ(lost_ties(near.text(), far.text()), 1u);
  EXPECT_EQ(lost_ties(far.text(), near.text()), 0u);
  EXPECT_EQ(lost_ties(far.text(), far.text()), 0u);
}

TEST(GapsJson, AnEarlierDocumentHasEdgesWithTheirDepth) {
  SmallDeck small;  // the borders of two sheets cross
  small.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  small.node(5, 5, 5, 0.25).node(6, 15, 5, 0.25).node(7, 15, 15, 0.25).node(8, 5, 15, 0.25);
  small.shell_part(1, 2).shell_part(2, 2).shell(1, 1, 1, 2, 3, 4).shell(2, 2, 5, 6, 7, 8);
  small.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2});
  small.add("@/INTER/TYPE25/3 surf_ID1=1 surf_ID2=2 Inacti=5 Iedge=2");
  for (const std::string& text : {edges(), small.text()}) {
    const Inspected d(text);
    ASSERT_GT(d.view.total.count.edges, 0u);
    const std::string json = gaps_json("test_0000.rad", d.deck, d.scene, d.view, false);
    const auto earlier = read_earlier_gaps("old.json", json, "test_0000.rad");
    ASSERT_TRUE(earlier.ok());
    const GapsComparison compared = compare_gaps(*earlier, d.scene, d.view);
    EXPECT_GT(compared.rows.size(), 0u);
    EXPECT_EQ(compared.count(Trend::same), compared.rows.size());
    EXPECT_TRUE(compared.solved.empty());
  }
}

}  // namespace
}  // namespace deck::test
