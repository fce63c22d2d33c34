// The interactive page: its data are readable, whatever the titles hold.
#include "deck/report/html.hpp"

#include <gmock/gmock.h>

#include "model/shared/mesh.hpp"
#include "report/page.hpp"
#include "report/shared/cycle.hpp"
#include "report/shared/parts.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string page_of(const Built& b, const char* path = "small_0000.rad") {
  const SceneView view = make_view(b.scene);
  HtmlInput input;
  input.path = path;
  input.deck = &b.deck;
  input.scene = &b.scene;
  input.view = &view;
  const auto page = gaps_html(input);
  return page ? *page : "";
}

/// Text of a data block of the page.
std::string block(const std::string& page, const std::string& id) {
  const std::string mark = "id=\"" + id + "\">";
  const auto at = page.find(mark);
  if (at == std::string::npos) return "";
  return page.substr(at + mark.size(), page.find("</script>", at) - at - mark.size());
}

SmallDeck plate() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(9, 5, 5, 0.5);
  d.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4);
  return d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {9});
}

class WholePage : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!html_available()) GTEST_SKIP() << "this build has no viewer";
  }
};

TEST_F(WholePage, DescribesEveryInterfaceInValidJson) {
  const Built b(plate().add("@/INTER/TYPE7/1 Gapmin=1").add("@/INTER/TYPE7/2 Gapmin=2 Igap=1"));
  const auto meta = nlohmann::json::parse(block(page_of(b), "deck-meta"), nullptr, false);
  ASSERT_FALSE(meta.is_discarded());
  ASSERT_EQ(meta["interfaces"].size(), 2u);
  EXPECT_EQ(meta["interfaces"][1]["id"], 2);
  EXPECT_TRUE(meta["interfaces"][1]["values"].contains("Gapmin"));
}

TEST_F(WholePage, HasTheDefaultGapThatTheMeshGives) {
  const Built b(plate().add("@/INTER/TYPE7/1"));
  const auto meta = nlohmann::json::parse(block(page_of(b), "deck-meta"), nullptr, false);
  ASSERT_FALSE(meta.is_discarded());
  ASSERT_GT(b.contact().gapmin, 0);
  const auto& gapmin = meta["interfaces"][0]["values"]["Gapmin"];
  EXPECT_EQ(gapmin["value"], b.contact().gapmin);
  EXPECT_EQ(gapmin["origin"], "derived");
  EXPECT_EQ(meta["contacts"][0]["card"]["Gapmin"], 0);  // what the page starts from is the card
}

TEST_F(WholePage, ShowsTitlesByCharactersAndOtherBytesByTheirNumber) {
  const auto shown = [](const std::string& title) {
    SmallDeck d = plate();
    const Built b(d.add("/INTER/TYPE7/1\n" + title + "\n" + "         2         1\n"));
    const std::string page = page_of(b);
    const auto cell = page.find("<td>1</td><td>") + 14;
    return page.substr(cell, page.find("</td>", cell) - cell);
  };
  EXPECT_EQ(shown("\xc3\xa4 at the start"), "\xc3\xa4 at the start");
  EXPECT_EQ(shown("\xe2\x82\xac"), "\xe2\x82\xac");
  EXPECT_EQ(shown("cut \xe2\x82"), "cut \\xe2\\x82");
  EXPECT_EQ(shown("\xe4 <b> & \"x\""), "\\xe4 &lt;b&gt; &amp; &quot;x&quot;");
}

TEST_F(WholePage, HoldsPlaneElementsOfEveryShape) {
  // The mesh grows with every family that is added.
  const auto mesh = [](const std::string& more) {
    const Built b(plate().add(more).add("@/INTER/TYPE7/1 Gapmin=1"));
    return block(page_of(b), "deck-mesh");
  };
  const std::string none = mesh("");
  EXPECT_FALSE(none.empty());
  for (const char* more : {"/QUAD/1\n         7         1         2         3         4",
                           "/TRIA/1\n         7         1         2         3",
                           "/SH3N/1\n         7         1         2         3",
                           "/TRUSS/1\n         7         1         2"})
    EXPECT_NE(mesh(more), none) << more;
}

TEST_F(WholePage, NamesTiesAmongItsInterfacesAndWithoutScripts) {
  SceneOptions options;
  options.ties = true;
  const Built b(plate().add("@/INTER/TYPE2/7 grnd_IDs=2 surf_IDm=1 Ignore=1 dsearch=0.1"), options);
  const std::string page = page_of(b);
  const auto meta = nlohmann::json::parse(block(page, "deck-meta"), nullptr, false);
  ASSERT_FALSE(meta.is_discarded());
  EXPECT_EQ(meta["interfaces"][meta["ties"][0]["interface"].get<std::size_t>()]["id"], 7);
  EXPECT_EQ(meta["verdict"]["level"], "untied");
  EXPECT_NE(page.find("1 of 1 node is not tied</li>"), std::string::npos);
  EXPECT_FALSE(block(page, "deck-ties").empty());
}

TEST_F(WholePage, OfADeckWithoutTiesHasNoBlockOfThem) {
  const Built b(plate().add("@/INTER/TYPE7/1 Gapmin=1"));
  EXPECT_TRUE(block(page_of(b), "deck-ties").empty());
}

/// A page about to be made of a plate with a node in its gap.
struct Paged {
  explicit Paged(SmallDeck d = plate().add("@/INTER/TYPE7/1 Gapmin=1.5"),
                 const SceneOptions& options = {})
      : b(d, options), view(make_view(b.scene)) {
    input.path = "somewhere/small_0000.rad";
    input.deck = &b.deck;
    input.scene = &b.scene;
    input.view = &view;
  }
  std::string text() const {
    const auto page = gaps_html(input);
    EXPECT_TRUE(page.ok());
    return page.ok() ? *page : "";
  }
  Json meta() const { return Json::parse(block(text(), "deck-meta")); }
  /// What a packed block unpacks to.
  Json packed(const std::string& id) const {
    const std::string data = block(text(), id);
    return data.empty() ? Json() : Json::parse(PageBlock(data).bytes());
  }
  /// Id of a node of the page by its number there.
  std::int64_t id(const Json& number) const {
    PageBlock in(block(text(), "deck-mesh"));
    return in.deltas(in.u()).at(number.get<std::size_t>());
  }
  Built b;
  SceneView view;
  HtmlInput input;
};

std::string title_of(const std::string& page) {
  const auto at = page.find("<title>") + 7;
  return page.substr(at, page.find("</title>") - at);
}

TEST_F(WholePage, DescribesTheDeckItsPartsAndFiles) {
  SmallDeck d = plate().truss_part(7, 3).bar("TRUSS", 7, 70, 1, 2);
  Paged p(
      d.group("/GRNOD/NODE/40", {1}).group("/GRNOD/NODE/6", {1}).add("@/INTER/TYPE7/1 Gapmin=1.5"));
  WhatIf w;
  w.interface_id = 1;
  w.Inacti = 6;
  p.input.what_if = {w};
  const Json meta = p.meta();
  EXPECT_EQ(meta["schema"], Json({{"id", "deck/gaps-html"}, {"version", 1}}));
  EXPECT_EQ(meta["page"], "gaps");
  EXPECT_EQ(meta["deck"]["path"], "somewhere/small_0000.rad");
  EXPECT_EQ(meta["deck"]["counts"]["parts"], 2);
  EXPECT_EQ(meta["deck"]["counts"]["interfaces"], 1);
  EXPECT_EQ(meta["verdict"]["counts"]["pairs"], 1);
  EXPECT_EQ(meta["summary"]["pairs"], 1);
  EXPECT_EQ(meta["summary"]["max_depth"], 1.0);
  EXPECT_EQ(meta["examined"], 1);
  EXPECT_EQ(meta["bytes"], p.b.deck.sources[0].bytes().size());
  EXPECT_EQ(meta["largest_gap"], largest_bounded_gap(p.b.model));
  EXPECT_EQ(meta["files"], Json::array({p.b.deck.sources[0].path()}));
  EXPECT_EQ(meta["parts"], Json({{{"id", 1},
                                  {"title", "part"},
                                  {"prop", 1},
                                  {"mat", 1},
                                  {"prop_type", "/PROP/SHELL"},
                                  {"thickness", 2.0}},
                                 {{"id", 7},
                                  {"title", "part"},
                                  {"prop", 7},
                                  {"mat", 1},
                                  {"prop_type", "/PROP/TRUSS"},
                                  {"thickness", 0.0}}}));
  EXPECT_EQ(meta["free_group_id"], 41);
  EXPECT_EQ(meta["what_if"], Json({{{"interface", 1}, {"Inacti", 6}}}));
  EXPECT_EQ(meta["touches"], Json::array({Json({-1, 0, 0})}));
  EXPECT_EQ(meta["contacts"].size(), 1u);
  EXPECT_EQ(meta["ties"], Json::array());
}

TEST_F(WholePage, IsOneDocumentWithViewerAndPolicy) {
  const std::string page = Paged().text();
  const detail::ViewerBundle& viewer = detail::viewer_bundle();
  EXPECT_EQ(
      page.rfind("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n", 0), 0u);
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_NE(page.find("<style>" + std::string(viewer.style) + "</style>\n</head>\n<body>\n"),
            page.npos);
  EXPECT_TRUE(
      page.ends_with("<script>" + std::string(viewer.script) + "</script>\n</body>\n</html>\n"));
  EXPECT_THAT(page, HasSubstr("content=\"deck " + std::string(library_version()) + "\""));
  std::vector<std::string> blocks;
  for (auto at = page.find("octet-stream\" id=\""); at != page.npos;
       at = page.find("octet-stream\" id=\"", at + 1))
    blocks.push_back(page.substr(at + 18, page.find('"', at + 18) - at - 18));
  EXPECT_EQ(blocks, (std::vector<std::string>{"deck-touches", "deck-shared", "deck-contacts",
                                              "deck-mesh", "deck-elements"}));
  EXPECT_THAT(page, Not(HasSubstr("id=\"cycle-json\"")));
  EXPECT_THAT(page, Not(HasSubstr("id=\"parts-json\"")));
}

TEST_F(WholePage, WithoutScriptsHasVerdictAndContacts) {
  SmallDeck d = plate().add("@/INTER/TYPE7/1 Gapmin=1.5").add("@/INTER/TYPE7/2 Gapmin=0.25");
  const Paged p(d);
  const std::string page = p.text();
  const Verdict verdict = verdict_of(p.b.deck, p.b.scene, p.view);
  EXPECT_THAT(page, HasSubstr("<main id=\"static\"><h1>small_0000.rad</h1>\n<p data-level=\"" +
                              std::string(to_string(verdict.level)) + "\">" + verdict.text +
                              "</p>\n<table>"));
  const auto row = [&](int id, const char* rest) {
    const Contact& c = p.b.contact(id);
    EXPECT_THAT(page,
                HasSubstr("<tr><td>" + std::to_string(id) + "</td><td>" + c.inter->title + rest));
  };
  row(1, "</td><td>primary</td><td>1.5</td><td>1</td><td>1.0</td></tr>\n");
  row(2,
      "</td><td>primary</td><td>0.25</td><td>0</td><td>0.0</td></tr>\n</tbody></"
      "table>\n<noscript>");
  EXPECT_THAT(page, HasSubstr("needs JavaScript"));
}

TEST_F(WholePage, IsNamedAfterTheVerbThatWritesIt) {
  Paged p;
  const std::string name = "small_0000.rad \xe2\x80\x93 ";
  EXPECT_EQ(title_of(p.text()), name + "initial penetrations");
  p.input.path = "C:\\decks\\b.rad";
  EXPECT_THAT(title_of(p.text()), testing::StartsWith("b.rad "));
  p.input.path = "somewhere/small_0000.rad";
  const Built before(plate());
  p.input.before = &before.model;
  EXPECT_EQ(title_of(p.text()), name + "before and after");
  EXPECT_EQ(p.meta()["page"], "gaps");
  p.input.verb = "fix";
  EXPECT_EQ(p.meta()["page"], "fix");
  p.input.verb = nullptr;
  p.input.parts = &p.b.loaded;
  EXPECT_EQ(title_of(p.text()), name + "parts");
  EXPECT_EQ(p.meta()["page"], "parts");
}

TEST_F(WholePage, OfARepairHasMovedNodesAndWhatItSays) {
  Paged p;
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(9, 5, 5, 0.25);
  const Built before(d);
  p.input.before = &before.model;
  p.input.repair = "{\"a\": \"<b>\"}";
  const Json moved = p.packed("deck-moved");
  EXPECT_EQ(moved["total"], 1);
  EXPECT_EQ(p.id(moved["rows"][0][0]), 9);
  EXPECT_EQ(moved["rows"][0][3], 0.25);
  EXPECT_EQ(p.packed("deck-repair"), Json({{"a", "<b>"}}));
  EXPECT_EQ(Paged().packed("deck-moved"), Json());
  EXPECT_EQ(Paged().packed("deck-repair"), Json());
}

TEST_F(WholePage, HasCrossedElementsThatWereLookedFor) {
  SmallDeck d = plate();
  d.node(11, 4, 4, -1).node(12, 4, 5, 1).truss_part(2, 1).bar("TRUSS", 2, 5, 11, 12);
  d.group("/GRNOD/NODE/3", {11, 12}).add("@/INTER/TYPE7/1 grnd_IDs=3 surf_IDm=1 Gapmin=0.5");
  Paged p(d);
  EXPECT_EQ(p.packed("deck-crossed"), Json());
  const std::vector<Crossing> found = find_crossings(p.b.scene);
  ASSERT_EQ(found.size(), 1u);
  p.input.crossings = &found;
  const Json rows = p.packed("deck-crossed")["rows"];
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(p.id(rows[0][1]), 11);
  EXPECT_EQ(p.id(rows[0][2]), 12);
  EXPECT_EQ(rows[0][4], 5);
}

TEST_F(WholePage, HasEarlierRowsUnderTheNamesOfNow) {
  // Node 9 of interface 1 was node 77 of interface 70; another row has no counterpart.
  Paged p;
  EXPECT_EQ(p.packed("deck-earlier"), Json());
  EarlierGaps earlier;
  earlier.path = "earlier.json";
  earlier.deck_path = "earlier_0000.rad";
  earlier.rows = {{1, "edges", {5, 6}, 0.375, 2.5, std::array{50.0, 0.0, 0.0}},
                  {1, "primary", {9, 0}, 0.75, 1.25, std::array{5.0, 5.0, 0.5}}};
  p.input.earlier = &earlier;
  EXPECT_EQ(p.packed("deck-earlier"),
            Json({{"path", "earlier.json"},
                  {"deck", "earlier_0000.rad"},
                  {"same_depth", same_depth},
                  {"rows", {{1, "edges", 5, 6, 0.375, 2.5}, {1, "primary", 9, 0, 0.75, 1.25}}}}));
  earlier.rows[1].interface_id = 1;
  earlier.rows[1].secondary = {77, 0};
  EXPECT_EQ(p.packed("deck-earlier")["rows"][1], Json({1, "primary", 9, 0, 0.75, 1.25}))
      << "by its place";
}

TEST_F(WholePage, OfPartsHasTheirDocumentAndTheStepsOfTheirElements) {
  Paged p;
  p.input.parts = &p.b.loaded;
  const std::string page = p.text();
  EXPECT_EQ(Json::parse(block(page, "parts-json")), Json::parse(parts_json(p.b.loaded, false)));
  PageBlock steps(block(page, "deck-steps"));
  const double dt = p.b.loaded.mesh().elements[0].dt[0];
  EXPECT_EQ(steps.reals(3), (std::vector{dt, dt, dt}));
}

TEST_F(WholePage, OfForcesHasTheirDocumentCostsAndNodes) {
  SceneOptions options;
  options.nodal_stiffness = true;
  Paged p(plate().add("@/INTER/TYPE7/1 Gapmin=1.5 Istf=1 Stfac=3"), options);
  const cycle::State state = cycle::make_state(p.b.scene);
  cycle::CycleOptions with_pairs;
  with_pairs.keep_pairs = true;
  const cycle::SceneOutcome outcome = cycle::run_cycle(p.b.scene, state, with_pairs);
  p.input.cycle = &outcome;
  p.input.acted = acted_in_page(state, outcome);
  const Json forces = p.packed("deck-cycle");
  ASSERT_EQ(forces["contacts"].size(), 1u);
  EXPECT_EQ(forces["contacts"][0]["with_force"], 1);
  std::vector<std::int64_t> acted;
  for (const Json& n : forces["nodes"]) acted.push_back(p.id(n[0]));
  std::vector<std::int64_t> expected;
  for (const cycle::ActedNode& n : cycle::acted_nodes(state, outcome))
    expected.push_back(p.b.model.node_id(n.node));
  EXPECT_EQ(acted, expected);
  EXPECT_EQ(p.meta()["page"], "gaps");
  CycleInput effects;
  effects.path = p.input.path;
  effects.deck = &p.b.deck;
  effects.scene = &p.b.scene;
  effects.state = &state;
  effects.outcome = &outcome;
  effects.view = &p.view;
  p.input.effects = &effects;
  const std::string page = p.text();
  EXPECT_EQ(Json::parse(block(page, "cycle-json")), Json::parse(cycle_json(effects, false)));
  EXPECT_EQ(title_of(page), "small_0000.rad \xe2\x80\x93 first contact cycle");
  EXPECT_EQ(Json::parse(block(page, "deck-meta"))["page"], "cycle");
  EXPECT_THAT(page, HasSubstr(cycle_verdict(effects).text + "</p>"));
}

TEST(ScriptSafe, NoElementCanBeginOrEnd) {
  EXPECT_EQ(detail::script_safe("{\"a\": \"</script><!--\"}"),
            "{\"a\": \"\\u003c/script>\\u003c!--\"}");
}

std::string touches_of(const Built& b) {
  const SceneView view = make_view(b.scene);
  HtmlInput input;
  input.path = "small_0000.rad";
  input.deck = &b.deck;
  input.scene = &b.scene;
  input.view = &view;
  return touches_svg(input);
}

TEST(Touches, PartsThatPenetrateAreRedAndNeighboursAreNot) {
  const auto deep = [](double height) {
    SmallDeck d = plate();
    d.node(11, 1, 1, height).node(12, 3, 1, height).node(13, 2, 3, height);
    d.shell_part(2, 1).shell3(2, 7, 11, 12, 13).group("/GRNOD/PART/3", {2});
    d.add("@/INTER/TYPE7/1 grnd_IDs=3 surf_IDm=1 Gapmin=1");
    return touches_of(Built(d));
  };
  const std::string red = deep(0.5), near = deep(1.5), far = deep(90);
  EXPECT_NE(red.find("class=\"deep\""), std::string::npos);
  EXPECT_NE(red.find("; 3 penetrations, deepest 0.5"), std::string::npos) << red;
  EXPECT_EQ(near.find("class=\"deep\""), std::string::npos);
  EXPECT_NE(near.find("class=\"near\""), std::string::npos);
  EXPECT_EQ(far.find("class=\"touch\""), std::string::npos);
}

}  // namespace
}  // namespace deck::test
