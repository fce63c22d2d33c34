// The interactive page: its data are readable, whatever the titles hold.
#include "deck/report.hpp"

#include <gmock/gmock.h>

#include "report/page.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A page about to be made of a deck.
struct Paged {
  explicit Paged(const Built& b) : view(make_view(b.scene)) {
    input.path = "somewhere/small_0000.rad";
    input.deck = &b.deck;
    input.scene = &b.scene;
    input.view = &view;
  }
  SceneView view;
  HtmlInput input;
};

std::string page_of(const Built& b) {
  const auto page = gaps_html(Paged(b).input);
  EXPECT_TRUE(page.ok());
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

TEST_F(WholePage, HasTheDefaultGapThatTheMeshGives) {
  const Built b(plate().add("@/INTER/TYPE7/1"));
  const auto meta = nlohmann::json::parse(block(page_of(b), "deck-meta"), nullptr, false);
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
  EXPECT_EQ(meta["interfaces"][meta["ties"][0]["interface"].get<std::size_t>()]["id"], 7);
  EXPECT_EQ(meta["verdict"]["level"], "untied");
  EXPECT_NE(page.find("1 of 1 node is not tied</li>"), std::string::npos);
  EXPECT_FALSE(block(page, "deck-ties").empty());
}

TEST_F(WholePage, HoldsPointsOnEdgesOfATYPE24) {
  SmallDeck d = plate();
  d.node(11, 8, 5, 1).node(12, 28, 4, 1).node(13, 28, 14, 1).node(14, 9, 15, 1).shell_part(2, 2);
  d.shell(2, 2, 11, 12, 13, 14).group("/SURF/PART/2", {2});
  const Built b(d.add("@/INTER/TYPE24/1 surf_ID1=1 surf_ID2=2 Iedge=1 Inacti=5"));
  const Contact& c = b.scene.contacts.back();
  ASSERT_TRUE(!c.points.empty() && !c.penetrations.empty());
  EXPECT_FALSE(block(page_of(b), "deck-contacts").empty());
}

TEST_F(WholePage, IsOneDocumentWithViewerAndPolicy) {
  const std::string page = page_of(Built(plate().add("@/INTER/TYPE7/1 Gapmin=1.5")));
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

TEST(ScriptSafe, NoElementCanBeginOrEnd) {
  EXPECT_EQ(detail::script_safe("{\"a\": \"</script><!--\"}"),
            "{\"a\": \"\\u003c/script>\\u003c!--\"}");
}

TEST(Touches, PartsThatPenetrateAreRedAndNeighboursAreNot) {
  const auto deep = [](double height) {
    SmallDeck d = plate();
    d.node(11, 1, 1, height).node(12, 3, 1, height).node(13, 2, 3, height);
    d.shell_part(2, 1).shell3(2, 7, 11, 12, 13).group("/GRNOD/PART/3", {2});
    d.add("@/INTER/TYPE7/1 grnd_IDs=3 surf_IDm=1 Gapmin=1");
    const Built b(d);
    return touches_svg(Paged(b).input);
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
