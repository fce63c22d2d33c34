// One entity with its card, users and references; and the tables of effective values.
#include "base/shared/columns.hpp"
#include "report/inspected.hpp"

#include <map>

#include <nlohmann/json.hpp>

namespace deck::test {
namespace {

std::string message_of(const Inspected& d, const std::string& what) {
  const auto entity = find_entity(d.deck, d.model, what);
  return entity.ok() ? "" : entity.error().message;
}

const Link* link_to(const std::vector<Link>& list, const std::string& keyword, std::int64_t id) {
  for (const Link& l : list)
    if (l.keyword == keyword && l.id == id) return &l;
  return nullptr;
}

TEST(ShowEntity, IsFoundByIdKeywordAndKind) {
  const Inspected d(plates());
  for (const char* what : {"1", "/INTER/TYPE7/1", "TYPE7/1", "inter:1", "INTER/1"})
    EXPECT_EQ(d.look(what).entity.keyword, "/INTER/TYPE7") << what;
  EXPECT_EQ(d.look("part:2").entity.keyword, "/PART");
  EXPECT_EQ(d.look("node:5").entity.keyword, "/NODE");
  EXPECT_EQ(d.look("shell:2").entity.keyword, "/SHELL");
}

TEST(ShowEntity, AnUnknownIdIsAnsweredWithWhatHasIt) {
  const Inspected d(plates());
  const std::string why = message_of(d, "2");
  EXPECT_NE(why.find("there is no interface 2"), std::string::npos) << why;
  EXPECT_NE(why.find("grnod:2"), std::string::npos) << why;
  EXPECT_NE(message_of(d, "node:99").find("there is no node 99"), std::string::npos);
  EXPECT_NE(message_of(d, "nothing").find("is no id"), std::string::npos);
}

TEST(ShowEntity, AMistypedKindOrKeywordIsAnsweredWithTheClosest) {
  const Inspected d(plates());
  EXPECT_NE(message_of(d, "shel:1").find("did you mean 'shell'"), std::string::npos);
  EXPECT_NE(message_of(d, "/INTER/TYP7/1").find("did you mean '/INTER/TYPE7'"), std::string::npos);
  EXPECT_EQ(message_of(d, "/INTER/TYPE7/9").find("did you mean"), std::string::npos);
}

TEST(ShowEntity, AGroupIsUsedByItsInterfaceAndRefersToItsParts) {
  const EntityView v = Inspected(plates()).look("grnod:2");
  const Link* user = link_to(v.used_by, "/INTER/TYPE7", 1);
  ASSERT_NE(user, nullptr);
  EXPECT_EQ(user->field, "grnd_IDs");
  EXPECT_NE(link_to(v.refers_to, "/PART", 2), nullptr);
}

TEST(ShowEntity, APartIsReachedFromTheContactOverItsGroup) {
  const EntityView v = Inspected(plates()).look("part:2");
  EXPECT_NE(link_to(v.interfaces, "/INTER/TYPE7", 1), nullptr);
  EXPECT_NE(link_to(v.refers_to, "/MAT/LAW1", 1), nullptr);
  EXPECT_NE(link_to(v.used_by, "/GRNOD/PART", 2), nullptr);
}

TEST(ShowEntity, ANodeListsItsKinematicConditions) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(9, 5, 5, 5);
  d.shell_part(1, 2.0).shell(1, 1, 1, 2, 3, 4).group("/GRNOD/NODE/1", {1, 2});
  d.add("@/BCS/3 Tx=1 grnod_ID=1\n@/RBODY/7 node_ID=9 grnd_ID=1");
  const EntityView v = Inspected(d.text()).look("node:1");
  std::vector<std::string> conditions;
  for (const auto& [name, value] : v.facts)
    if (name == "kinematic condition") conditions.push_back(std::get<std::string>(value));
  EXPECT_EQ(conditions, (std::vector<std::string>{"/BCS 3", "/RBODY 7"}));
  for (const auto& fact : Inspected(d.text()).look("node:3").facts)
    EXPECT_NE(fact.first, "kinematic condition");
}

TEST(ShowEntity, ANodeKnowsItsElementsAndTheSideOfTheContact) {
  const EntityView v = Inspected(plates()).look("node:5");
  EXPECT_NE(link_to(v.used_by, "/SHELL", 2), nullptr);
  EXPECT_EQ(link_to(v.used_by, "/SHELL", 1), nullptr);
  const Link* contact = link_to(v.interfaces, "/INTER/TYPE7", 1);
  ASSERT_NE(contact, nullptr);
  EXPECT_EQ(contact->field, "grnd_IDs");
}

TEST(ShowEntity, AReferenceToNothingSaysSo) {
  std::string text = plates();
  text.replace(text.find("/SURF/PART/1"), 12, "/SURF/PART/9");
  const Inspected d(text);
  const std::string out = show_text(d.params(), d.look("1"));
  EXPECT_NE(out.find("surf 1 (does not exist)"), std::string::npos) << out;
}

TEST(ShowEntity, FieldNamesEndOverTheColumnsOfTheirCells) {
  const Inspected d(plates());
  const std::string out = show_text(d.params(), d.look("1"));
  const auto name = out.find("Gapmin");
  ASSERT_NE(name, std::string::npos);
  const auto line = out.rfind('\n', name), next = out.find('\n', name);
  EXPECT_EQ(out.substr(next + 1 + (name - line - 1) + 6 - 3, 3), "0.5") << out;
}

TEST(ShowEntity, LongCardsAreContinuedInANarrowTerminal) {
  const Inspected d(plates());
  for (const std::size_t width : {80u, 120u}) {
    ShowTextOptions options;
    options.width = width;
    const std::string text = show_text(d.params(), d.look("1"), options);
    for (std::size_t at = 0; at < text.size();) {
      const auto nl = std::min(text.find('\n', at), text.size());
      EXPECT_LE(display_width(text.substr(at, nl - at)), width) << text.substr(at, nl - at);
      at = nl + 1;
    }
  }
}

TEST(ShowEntity, JsonHasCellsWithColumnsAndEffectiveValues) {
  const Inspected d(plates());
  const auto j = nlohmann::json::parse(show_json(d.params(), d.look("1")));
  EXPECT_EQ(j["entity"]["keyword"], "/INTER/TYPE7");
  EXPECT_EQ(j["parameters"]["Gapmin"]["value"], 0.5);
  bool found = false;
  for (const auto& card : j["cards"])
    for (const auto& cell : card["cells"])
      if (cell["field"] == "Gapmin") {
        found = true;
        EXPECT_EQ(cell["columns"], nlohmann::json::array({41, 60}));
        EXPECT_EQ(cell["value"], 0.5);
      }
  EXPECT_TRUE(found);
}

TEST(ShowEntity, JsonCellsBehindTheEndOfTheirLineHaveColumnsOfTheirOwn) {
  const Inspected d(plates({.card = "Gapmin=0.5"}));
  const auto j = nlohmann::json::parse(show_json(d.params(), d.look("1")));
  std::map<std::string, nlohmann::json> columns;
  for (const auto& card : j["cards"])
    for (const auto& cell : card["cells"]) columns[cell["field"]] = cell["columns"];
  EXPECT_EQ(columns["Gapmin"], nlohmann::json::array({41, 60}));
  EXPECT_EQ(columns["Tstart"], nlohmann::json::array({61, 80}));
  EXPECT_EQ(columns["Tstop"], nlohmann::json::array({81, 100}));
}

// ---- params ---------------------------------------------------------------------------------

TEST(Params, ChangedListsWhatWasWrittenAndIsNotTheDefault) {
  const Inspected d(plates({.card = "Gapmin=0.5 Stfac=1.0 Inacti=6 Idel=1000 VISs=0.05"}));
  ParamsTextOptions options;
  options.changed_only = true;
  const std::string text = params_text(d.params(), options);
  EXPECT_NE(text.find("Gapmin"), std::string::npos) << text;
  EXPECT_NE(text.find("Inacti"), std::string::npos);
  EXPECT_EQ(text.find("Stfac"), std::string::npos);
  EXPECT_EQ(text.find("Idel"), std::string::npos);
  EXPECT_EQ(text.find("VISs"), std::string::npos);
}

TEST(Params, ChangedMeasuresByTheDefaultBlock) {
  const Inspected d(
      plates({.card = "Inacti=6 Idel=1000", .before = "@/DEFAULT/INTER/TYPE7 Inacti=6 Idel=2"}));
  ParamsTextOptions options;
  options.changed_only = true;
  const std::string text = params_text(d.params(), options);
  EXPECT_EQ(text.find("Inacti"), std::string::npos) << text;
  EXPECT_NE(text.find("Idel"), std::string::npos);
}

TEST(Params, MatrixHasARowPerInterfaceAndFoldsToTheWidth) {
  const Inspected d(plates());
  ParamsTextOptions options;
  options.width = 60;
  const std::string text = params_matrix(d.params(), options);
  EXPECT_NE(text.find("0.5"), std::string::npos) << text;
  EXPECT_NE(text.find("(1000)"), std::string::npos) << "not on the card";
  std::size_t heads = 0;
  for (std::size_t at = text.find("interface"); at < text.size();
       at = text.find("interface", at + 1))
    heads += at == 0 || text[at - 1] == '\n' ? 1 : 0;
  EXPECT_GE(heads, 2u) << text;
}

TEST(Params, OneInterfaceOnRequest) {
  const Inspected d(plates({.before = "@/INTER/TYPE7/7 grnd_IDs=2 surf_IDm=1 Gapmin=0.7"}));
  ParamsTextOptions options;
  options.only = {7};
  EXPECT_EQ(params_text(d.params(), options).find("/INTER/TYPE7/1 "), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(params_json(d.params(), {7}))["interfaces"].size(), 1u);
}

TEST(Params, CsvHasALineForEveryField) {
  const Inspected d(plates());
  const std::string text = params_csv(d.params());
  EXPECT_TRUE(
      text.starts_with("deck,interface,type,title,field,card,value,origin,file,line,column\r\n"));
  EXPECT_NE(text.find(",Gapmin,0.5,0.5,card,test_0000.rad,"), std::string::npos) << text;
}

// ---- tables ---------------------------------------------------------------------------------

TEST(FittedTable, BreaksTextsBeforeItFoldsColumns) {
  TextTable table({{"id", Align::right}, {"a long text", Align::left}, {"n", Align::right}});
  table.row({"1", "words that go on and on behind the end", "22"});
  const std::string text = table.fitted(30);
  EXPECT_EQ(text.find("\n\n"), std::string::npos) << text;
  EXPECT_NE(text.find("22"), std::string::npos);
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
    EXPECT_LE(text.find('\n', at) - at, 30u);
}

TEST(FittedTable, FoldsColumnsBehindTheFirst) {
  std::vector<TextTable::Column> columns = {{"id", Align::right}};
  std::vector<TextTable::Cell> row = {"7"};
  for (int i = 0; i < 10; ++i) {
    columns.push_back({"column" + std::to_string(i), Align::right});
    row.emplace_back(std::to_string(i));
  }
  TextTable table(columns);
  table.row(row);
  const std::string text = table.fitted(40);
  EXPECT_NE(text.find("\n\nid"), std::string::npos) << text;
  EXPECT_NE(text.find("column9"), std::string::npos);
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
    EXPECT_LE(text.find('\n', at) - at, 40u);
}

TEST(FittedTable, AnyWidthIsWhatRenderGives) {
  TextTable table({{"a", Align::left}, {"b", Align::right}});
  table.row({"x", "1"});
  EXPECT_EQ(table.fitted(0), table.render());
}

}  // namespace
}  // namespace deck::test
