// What `deck show` knows of every kind of entity: figures of the model, references both ways, lines
// of the card; in JSON and in words.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "deck/text/number.hpp"
#include "keyword/shared/place.hpp"
#include "report/inspected.hpp"

namespace deck::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Json = nlohmann::json;

/// One of nearly everything.
std::string everything() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(5, 20, 0, 0);
  d.node(6, 5, 5, 0.5).node(7, 5, 25, 0.5).node(8, 99, 9, 9);
  d.shell_part(1, 2, 0.75).truss_part(2, 3).shell(1, 11, 1, 2, 3, 4, 1.25).shell3(1, 12, 2, 5, 3);
  d.bar("TRUSS", 2, 13, 6, 7).shell(1, 14, 1, 2, 3, 4);
  d.group("/GRNOD/NODE/20", {6, 7}).group("/SURF/PART/21", {1}).group("/GRNOD/GRNOD/22", {20});
  d.segments("/LINE/SEG/23", {{1, 2}, {2, 3}, {3, 4}}).group("/GRPART/PART/24", {1, 2});
  d.group("/GRSHEL/SHEL/25", {11, 14}).group("/SUBSET/26", {});
  d.add(
      "/FUNCT/27\nf\n                -1.0                 3.0\n                 2.0                "
      "-4.0\n"
      "                 5.0                 7.0");
  d.add("@/BCS/28 Tx=1 grnod_ID=20\n@/RBODY/29 node_ID=8 grnd_ID=20");
  d.elastic_material(30, 70).void_material(31, 60);
  return d.add("@/INTER/TYPE7/40 grnd_IDs=22 surf_IDm=21 Gapmin=1").text();
}

std::vector<std::string> facts_of(const EntityView& v) {
  std::vector<std::string> out;
  for (const auto& [name, value] : v.facts) {
    std::string text;
    if (const auto* n = std::get_if<std::int64_t>(&value)) text = std::to_string(*n);
    if (const auto* x = std::get_if<double>(&value)) text = shortest(*x);
    if (const auto* t = std::get_if<std::string>(&value)) text = *t;
    out.push_back(name + " " + text);
  }
  return out;
}

/// "field keyword/id xcount @line".
std::vector<std::string> links_of(const Inspected& d, const std::vector<Link>& list) {
  std::vector<std::string> out;
  for (const Link& l : list)
    out.push_back(l.field + " " + l.keyword + "/" + std::to_string(l.id) +
                  (l.count > 1 ? " x" + std::to_string(l.count) : "") +
                  (l.last > 0 ? " to " + std::to_string(l.last) : ""));
  (void)d;
  return out;
}

struct Shown {
  Inspected d{everything()};
  std::vector<std::string> facts(const std::string& what) const { return facts_of(d.look(what)); }
  std::vector<std::string> refers(const std::string& what) const {
    return links_of(d, d.look(what).refers_to);
  }
  std::vector<std::string> used(const std::string& what) const {
    return links_of(d, d.look(what).used_by);
  }
  std::vector<std::string> contacts(const std::string& what) const {
    return links_of(d, d.look(what).interfaces);
  }
  std::string line(const Span& span) const {
    return std::string(d.deck.sources[span.file].line_at(span.offset));
  }
};

TEST(ShowFacts, OfANodeAreItsPlaceElementsPartsAndConditions) {
  const Shown s;
  EXPECT_THAT(
      s.facts("node:6"),
      ElementsAre("X 5.0", "Y 5.0", "Z 0.5", "parts 2 part", "kinematic condition /BCS 28",
                  "kinematic condition /RBODY 29", "kinematic conflict /BCS 28 and /RBODY 29"));
  EXPECT_THAT(s.facts("node:2"), ElementsAre("X 10.0", "Y 0.0", "Z 0.0", "parts 1 part"));
  EXPECT_THAT(s.used("node:2"), ElementsAre("N2 /LINE/SEG/23", "N1 /LINE/SEG/23", "node /SHELL/11",
                                            "node /SHELL/14", "node /SH3N/12"));
  EXPECT_THAT(s.contacts("node:2"), ElementsAre("surf_IDm /INTER/TYPE7/40"));
  EXPECT_THAT(s.contacts("node:7"), ElementsAre("grnd_IDs /INTER/TYPE7/40"));
  EXPECT_THAT(s.contacts("node:8"), IsEmpty());
  const EntityView v = s.d.look("node:7");
  EXPECT_EQ(v.entity.kind, "node");
  EXPECT_EQ(v.entity.id, 7);
  EXPECT_EQ(s.d.model.nodes.id[v.entity.index], 7);
  EXPECT_THAT(s.line(v.entity.span), ContainsRegex("^ +7 +5 +25 +0\\.5$"));
  ASSERT_FALSE(v.used_by.empty());
  EXPECT_EQ(v.used_by.back().keyword, "/TRUSS");
  EXPECT_EQ(v.used_by.back().kind, "truss");
  EXPECT_THAT(s.line(v.used_by.back().span), ContainsRegex("^ +13 +6 +7$"));
  ASSERT_EQ(v.cards.size(), 1u) << "its own line only";
  EXPECT_THAT(std::string(v.cards[0].line.text), ContainsRegex("^ +7 "));
}

TEST(ShowFacts, OfAnElementAreItsPartAndOwnThickness) {
  const Shown s;
  EXPECT_THAT(s.facts("shell:11"), ElementsAre("part 1 part", "own thickness 1.25"));
  EXPECT_THAT(s.facts("shell:14"), ElementsAre("part 1 part"));
  EXPECT_THAT(s.facts("truss:13"), ElementsAre("part 2 part"));
  EXPECT_THAT(s.refers("shell:11"), ElementsAre("N1 /NODE/1", "N2 /NODE/2", "N3 /NODE/3",
                                                "N4 /NODE/4", "header /PART/1"));
  EXPECT_THAT(s.used("shell:11"), ElementsAre("ids /GRSHEL/SHEL/25"));
  EXPECT_THAT(s.used("sh3n:12"), IsEmpty());
  EXPECT_THAT(s.contacts("shell:11"), ElementsAre("surf_IDm /INTER/TYPE7/40"));
  EXPECT_THAT(s.contacts("truss:13"), ElementsAre("grnd_IDs /INTER/TYPE7/40"));
  const EntityView v = s.d.look("shell:14");
  ASSERT_EQ(v.cards.size(), 1u);
  EXPECT_THAT(std::string(v.cards[0].line.text), ContainsRegex("^ +14 +1 +2 +3 +4"));
}

TEST(ShowFacts, OfAPartAreItsElementsAndNodes) {
  const Shown s;
  EXPECT_THAT(s.facts("part:1"), ElementsAre("contact thickness 0.75", "nodes 5"));
  EXPECT_THAT(s.facts("part:2"), ElementsAre("nodes 2"));
  EXPECT_THAT(s.refers("part:1"), ElementsAre("prop_ID /PROP/SHELL/1", "mat_ID /MAT/LAW1/1"));
  EXPECT_THAT(s.used("part:1"), ElementsAre("ids /SURF/PART/21", "ids /GRPART/PART/24",
                                            "part /SHELL/0 x2", "part /SH3N/0"));
  EXPECT_THAT(s.contacts("part:1"), ElementsAre("surf_IDm /INTER/TYPE7/40"));
  EXPECT_THAT(s.contacts("part:2"), ElementsAre("grnd_IDs /INTER/TYPE7/40"));
  const EntityView v = s.d.look("part:1");
  EXPECT_EQ(s.line(v.used_by.at(2).span), "/SHELL/1");
  EXPECT_EQ(s.line(v.used_by.at(3).span), "/SH3N/1");
}

TEST(ShowFacts, OfGroupsAreTheirMembers) {
  const Shown s;
  EXPECT_THAT(s.facts("grnod:20"), ElementsAre("nodes 2"));
  EXPECT_THAT(s.facts("grnod:22"), ElementsAre("nodes 2"));
  EXPECT_THAT(s.facts("surf:21"), ElementsAre("segments 3", "nodes 5"));
  EXPECT_THAT(s.facts("line:23"), ElementsAre("edges 3"));
  EXPECT_THAT(s.facts("grpart:24"), ElementsAre("parts 2"));
  EXPECT_THAT(s.facts("grshel:25"), ElementsAre("elements 2"));
  EXPECT_THAT(s.used("grnod:20"),
              ElementsAre("ids /GRNOD/GRNOD/22", "grnod_ID /BCS/28", "grnd_ID /RBODY/29"));
  EXPECT_THAT(s.refers("grnod:22"), ElementsAre("ids /GRNOD/NODE/20"));
  EXPECT_THAT(s.contacts("grnod:20"), ElementsAre("grnd_IDs /INTER/TYPE7/40"))
      << "over the group of groups";
  EXPECT_THAT(s.contacts("grnod:22"), IsEmpty()) << "the contact names it itself";
  EXPECT_THAT(s.used("grnod:22"), ElementsAre("grnd_IDs /INTER/TYPE7/40"));
}

TEST(ShowFacts, OfPropertiesMaterialsAndFunctionsAreTheirFigures) {
  const Shown s;
  EXPECT_THAT(s.facts("prop:1"), ElementsAre("thickness 2.0"));
  EXPECT_THAT(s.facts("prop:2"), ElementsAre("area 3.0"));
  // E / (3 (1 - 2 nu)) with nu 0.3.
  const std::vector<std::string> mat = s.facts("mat:30");
  ASSERT_EQ(mat.size(), 3u);
  EXPECT_EQ(mat[0], "density 1e-06");
  EXPECT_EQ(mat[1], "E for the contact stiffness 70.0");
  EXPECT_THAT(mat[2], HasSubstr("bulk modulus for the contact stiffness 58.33333333333"));
  EXPECT_THAT(s.facts("funct:27"),
              ElementsAre("points 3", "least abscissa -1.0", "largest abscissa 5.0",
                          "least ordinate -4.0", "largest ordinate 7.0"));
  EXPECT_THAT(s.used("prop:1"), ElementsAre("prop_ID /PART/1"));
  EXPECT_THAT(s.used("mat:1"), ElementsAre("mat_ID /PART/1", "mat_ID /PART/2"));
  EXPECT_THAT(s.contacts("mat:1"), ElementsAre("surf_IDm /INTER/TYPE7/40"));
  EXPECT_EQ(s.d.look("prop:2").entity.index, s.d.model.property_of_id.at(2));
  EXPECT_EQ(s.d.look("mat:31").entity.index, s.d.model.material_of_id.at(31));
}

TEST(ShowFacts, OfAnInterfaceAreItsSidesAndValues) {
  const Shown s;
  const EntityView v = s.d.look("40");
  EXPECT_EQ(v.inter, s.d.interfaces.ordered[0]);
  EXPECT_THAT(links_of(s.d, v.refers_to),
              ElementsAre("grnd_IDs /GRNOD/GRNOD/22", "surf_IDm /SURF/PART/21"));
  EXPECT_THAT(v.used_by, IsEmpty());
  EXPECT_THAT(v.interfaces, IsEmpty());
  EXPECT_EQ(s.d.look("grnod:20").inter, nullptr);
  EXPECT_EQ(s.line(v.refers_to[1].span), "/SURF/PART/21");
  EXPECT_EQ(v.refers_to[1].title, "g");
  EXPECT_EQ(v.refers_to[1].kind, "surf");
}

TEST(ShowFacts, OfANodeNameEveryFamilyOfItsElements) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 1, 0, 0).node(3, 1, 1, 0).node(4, 0, 1, 0);
  d.node(5, 0, 0, 1).node(6, 1, 0, 1).node(7, 1, 1, 1).node(8, 0, 1, 1);
  d.shell_part(1, 1).truss_part(2, 1).beam_part(3, 1).spring_part(4, 5).solid_part(5);
  d.shell(1, 11, 1, 2, 3, 4).shell3(1, 12, 1, 2, 3).brick(5, 13, {1, 2, 3, 4, 5, 6, 7, 8});
  d.bar("TRUSS", 2, 16, 1, 2).bar("BEAM", 3, 17, 1, 2, 3).bar("SPRING", 4, 18, 1, 2);
  const Inspected in(d.text());
  std::vector<std::string> kinds;
  for (const Link& l : in.look("node:1").used_by)
    kinds.push_back(l.keyword + " " + l.kind + " " + std::to_string(l.id));
  EXPECT_THAT(kinds, ElementsAre("/SHELL shell 11", "/SH3N sh3n 12", "/BRICK brick 13",
                                 "/TRUSS truss 16", "/BEAM beam 17", "/SPRING spring 18"));
  EXPECT_THAT(facts_of(in.look("node:1")).back(), "parts 1 part, 2 part, 3 part, 4 part, 5 part");
}

TEST(ShowFacts, OfANodeThatMovedOrMergedSayWhereItWas) {
  SmallDeck d;
  d.node(1, 5, 6, 7).node(2, 20, 0, 0).group("/GRNOD/NODE/3", {1});
  d.add("@/TRANSFORM/TRA/4 GR_NODE=3 TX=1 TY=0 TZ=-3");
  d.add("/CNODE/0.1\n        70               20.05                 0.0                 0.0");
  const Inspected in(d.text());
  EXPECT_THAT(facts_of(in.look("node:1")),
              ElementsAre("X 6.0", "Y 6.0", "Z 4.0", "X before /TRANSFORM 5.0",
                          "Y before /TRANSFORM 6.0", "Z before /TRANSFORM 7.0"));
  EXPECT_THAT(facts_of(in.look("node:2")), ElementsAre("X 20.0", "Y 0.0", "Z 0.0"));
  EXPECT_THAT(facts_of(in.look("node:70")), ::testing::Contains("merged into node 2"));
}

/// The rows of /TETRA10 have two lines.
TEST(ShowFacts, OfWhatHasSeveralLinesShowAllOfThem) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 1, 0, 0).node(3, 0, 1, 0).node(4, 0, 0, 1).solid_part(5);
  d.add("/TETRA10/5\n        91\n         1         2         3         4");
  d.add("        92\n         2         1         4         3");
  const Inspected in(d.text());
  const auto lines = [&](const char* what) {
    std::vector<std::string> out;
    for (const ShownCard& card : in.look(what).cards) out.emplace_back(card.line.text);
    return out;
  };
  EXPECT_THAT(lines("element:92"),
              ElementsAre("        92", "         2         1         4         3"));
  EXPECT_THAT(lines("part:5"), ElementsAre("part", ::testing::StartsWith("         5         1")));
}

TEST(ShowFacts, OfASetAreItsListsAndOfARangeItsEnd) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 1, 0, 0).node(3, 1, 1, 0).node(4, 0, 1, 0).node(5, 2, 0, 0);
  d.shell_part(1, 1).shell(1, 11, 1, 2, 3, 4).shell3(1, 12, 2, 5, 3);
  d.add("/SET/GENERAL/61\nplate\nPART               1");
  d.group("/GRNOD/GENE/62", {2, 4});
  const Inspected in(d.text());
  EXPECT_THAT(facts_of(in.look("set:61")),
              ElementsAre("nodes 5", "segments 2", "edges 6", "parts 1"))
      << "of 4 and 3 sides two are one";
  EXPECT_THAT(facts_of(in.look("grnod:62")), ElementsAre("nodes 3"));
  EXPECT_THAT(links_of(in, in.look("grnod:62").refers_to), ElementsAre("range /NODE/2 to 4"));
  EXPECT_THAT(links_of(in, in.look("node:3").used_by),
              ElementsAre("range /GRNOD/GENE/62", "node /SHELL/11", "node /SH3N/12"));
}

TEST(ShowFind, KindsHaveTheNamesThatPeopleUse) {
  const Shown s;
  const std::pair<const char*, const char*> names[] = {{"interface:40", "/INTER/TYPE7"},
                                                       {"contact:40", "/INTER/TYPE7"},
                                                       {"material:30", "/MAT/LAW1"},
                                                       {"property:2", "/PROP/TRUSS"},
                                                       {"function:27", "/FUNCT"},
                                                       {"surface:21", "/SURF/PART"},
                                                       {"group:20", "/GRNOD/NODE"},
                                                       {"SH4N:11", "/SHELL"},
                                                       {"element:12", "/SH3N"},
                                                       {"elem:13", "/TRUSS"},
                                                       {"/sh3n/12", "/SH3N"},
                                                       {"truss/13", "/TRUSS"},
                                                       {"grnod/node/20", "/GRNOD/NODE"},
                                                       {"NODE/8", "/NODE"}};
  for (const auto& [what, keyword] : names) {
    const auto found = find_entity(s.d.deck, s.d.model, what);
    ASSERT_TRUE(found.ok()) << what << found.error().message;
    EXPECT_EQ(found->keyword, keyword) << what;
  }
}

TEST(ShowFind, WhatIsNotThereIsAnsweredWithEverythingOfThatId) {
  const Shown s;
  const auto why = [&](const char* what) {
    const auto found = find_entity(s.d.deck, s.d.model, what);
    EXPECT_FALSE(found.ok()) << what;
    return found.ok() ? "" : found.error().message;
  };
  EXPECT_THAT(why("1"), HasSubstr("there is no interface 1; 1 is the id of "));
  EXPECT_THAT(why("1"), HasSubstr("part:1"));
  EXPECT_THAT(why("1"), HasSubstr("node:1"));
  EXPECT_THAT(why("11"),
              HasSubstr("'11': there is no interface 11; 11 is the id of shell:11; expected"));
  EXPECT_THAT(why("brick:13"), HasSubstr("there is no brick 13; 13 is the id of truss:13;"));
  EXPECT_THAT(why("element:6"), HasSubstr("there is no element 6; 6 is the id of node:6;"));
  EXPECT_THAT(why("0"), HasSubstr("'0' is no id"));
  EXPECT_THAT(why("part:-1"), HasSubstr("'-1' is no id"));
  EXPECT_THAT(why("partt:1"),
              HasSubstr("the deck has no entity of kind 'partt'; did you mean 'part'"));
  EXPECT_THAT(why("/GRNOD/NODE/99"), HasSubstr("there is no /GRNOD/NODE/99; expected"));
  EXPECT_THAT(why("/GRNOD/NODES/20"), HasSubstr("did you mean '/GRNOD/NODE'"));
}

// ---- JSON and text --------------------------------------------------------------------------

TEST(ShowDocument, HasFactsAndLinksOfAnEntity) {
  const Shown s;
  const Json all = Json::parse(show_json(s.d.params(), s.d.look("part:1")));
  EXPECT_EQ(all["schema"], Json({{"id", "deck/show"}, {"version", 1}}));
  EXPECT_EQ(all["deck"]["path"], "test_0000.rad");
  EXPECT_EQ(all["entity"],
            Json({{"keyword", "/PART"}, {"kind", "part"}, {"id", 1}, {"title", "part"}}));
  const EntityView v = s.d.look("part:1");
  const auto place = [&](const Span& span) {
    const Position p = s.d.deck.sources.position(span);
    return Json({{"file", "test_0000.rad"}, {"line", p.line}, {"column", p.column}});
  };
  EXPECT_EQ(all["source"], place(v.entity.span));
  EXPECT_EQ(all["included_by"], Json::array());
  EXPECT_EQ(all["model"], Json({{"contact thickness", 0.75}, {"nodes", 5}}));
  const auto links = [&](const std::vector<Link>& list) {
    Json out = Json::array();
    for (const Link& l : list) {
      Json one = {{"field", l.field},
                  {"keyword", l.keyword},
                  {"kind", l.kind},
                  {"id", l.id == 0 ? Json() : Json(l.id)},
                  {"title", l.title},
                  {"file", "test_0000.rad"},
                  {"line", s.d.deck.sources.position(l.span).line}};
      if (l.count > 1) one["count"] = l.count;
      out.push_back(one);
    }
    return out;
  };
  EXPECT_EQ(all["refers_to"], links(v.refers_to));
  EXPECT_EQ(all["used_by"], links(v.used_by));
  EXPECT_EQ(all["used_by"][2]["count"], 2);
  EXPECT_EQ(all["contacts"], links(v.interfaces));
  EXPECT_EQ(all["contacts"].size(), 1u);
  EXPECT_FALSE(all.contains("parameters"));
  ASSERT_EQ(all["cards"].size(), v.cards.size());
  EXPECT_EQ(all["cards"][0]["card"], "title");
  EXPECT_EQ(all["cards"][0]["text"], "part");
  EXPECT_EQ(all["cards"][0]["cells"], Json::array());
  const Json& cells = all["cards"][1]["cells"];
  EXPECT_EQ(cells[0],
            Json({{"field", "prop_ID"}, {"columns", {1, 10}}, {"text", "1"}, {"value", 1}}));
  EXPECT_EQ(cells[1],
            Json({{"field", "mat_ID"}, {"columns", {11, 20}}, {"text", "1"}, {"value", 1}}));
  EXPECT_EQ(cells[3]["value"], 0.75);
}

TEST(ShowDocument, OfWhatIsNotThereHasNoPlace) {
  SmallDeck d;
  d.node(1, 0, 0, 0).group("/GRNOD/NODE/20", {1, 77});
  const Inspected in(d.text());
  const Json all = Json::parse(show_json(in.params(), in.look("grnod:20")));
  const Json& missing = all["refers_to"].back();
  EXPECT_EQ(missing["id"], 77);
  EXPECT_EQ(missing["keyword"], "");
  EXPECT_EQ(missing["file"], Json());
  EXPECT_EQ(missing["line"], Json());
}

TEST(ShowTexts, HaveHeadCardFactsAndLinks) {
  const Shown s;
  const EntityView v = s.d.look("part:1");
  const std::string text = show_text(s.d.params(), v);
  EXPECT_TRUE(text.starts_with("/PART/1  part\n  " + s.d.deck.sources.where(v.entity.span) +
                               "\n  columns of version "))
      << text;
  EXPECT_THAT(text, HasSubstr(", units kg mm ms\n"));
  EXPECT_THAT(text,
              ContainsRegex("\n +prop_ID +mat_ID +subset_ID +Thick\n +[0-9]+ +1 +1 +0 +0\\.75\n"));
  EXPECT_THAT(text,
              ContainsRegex("\nIn the model\n +figure +value\n +contact thickness +0\\.75\n +nodes "
                            "+5\n"));
  EXPECT_THAT(text, HasSubstr("\nRefers to\n"));
  EXPECT_THAT(text, ContainsRegex("\n +prop_ID +/PROP/[A-Z0-9]+/1 +p +test_0000.rad:[0-9]+"));
  EXPECT_THAT(text, ContainsRegex("\nUsed by\n +as +what +title +place\n"));
  EXPECT_THAT(text, ContainsRegex("\n +part +2 /SHELL +test"));
  EXPECT_THAT(text, ContainsRegex("\nReached from contacts\n.*\n +surf_IDm +/INTER/TYPE7/40"));
  EXPECT_THAT(text, Not(HasSubstr("Effective values")));
  EXPECT_THAT(text, Not(HasSubstr("Nothing uses it")));
  EXPECT_THAT(show_text(s.d.params(), s.d.look("funct:27")), HasSubstr("\nNothing uses it.\n"));
  const std::string inter = show_text(s.d.params(), s.d.look("40"));
  EXPECT_THAT(inter, HasSubstr("\nEffective values\n"));
  EXPECT_THAT(inter, Not(HasSubstr("Nothing uses it")));
}

TEST(ShowTexts, CutLongListsUnlessAllIsAskedFor) {
  SmallDeck d;
  std::vector<int> ids;
  for (int id = 1; id <= 25; ++id) {
    d.node(id, id, 0, 0);
    ids.push_back(id);
  }
  d.group("/GRNOD/NODE/90", ids);
  std::string curve = "/FUNCT/91\nf";
  for (int k = 0; k < 32; ++k) {
    char line[64];
    std::snprintf(line, sizeof line, "\n%20d%20d", k, k);
    curve += line;
  }
  const Inspected in(d.add(curve).text());
  ShowTextOptions all;
  all.all = true;
  const std::string group = show_text(in.params(), in.look("grnod:90"));
  EXPECT_THAT(group, HasSubstr("and 5 more (--all, --json)\n"));
  EXPECT_THAT(show_text(in.params(), in.look("grnod:90"), all), Not(HasSubstr("more (--all")));
  const std::string funct = show_text(in.params(), in.look("funct:91"));
  // The title is a line, too.
  EXPECT_THAT(funct, HasSubstr("3 more lines (--all)\n"));
  EXPECT_THAT(show_text(in.params(), in.look("funct:91"), all), Not(HasSubstr("more lines")));
}

TEST(ShowTexts, OfFreeFormatNameTheirCells) {
  SmallDeck d;
  d.node(1, 0, 0, 0).add("/SENSOR/TIME/7\nlate\n5.5,,");
  const Inspected in(d.text());
  const std::string text = show_text(in.params(), in.look("sensor:7"));
  EXPECT_THAT(text, HasSubstr("  5.5,,\n        Tdelay = 5.5"));
}

}  // namespace
}  // namespace deck::test
