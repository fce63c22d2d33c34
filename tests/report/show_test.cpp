// One entity with its card, users and references; and the tables of effective values.
#include "report/inspected.hpp"

#include <map>

#include <nlohmann/json.hpp>

namespace deck::test {
namespace {

TEST(ShowEntity, FieldNamesEndOverTheColumnsOfTheirCells) {
  const Inspected d(plates());
  const std::string out = show_text(d.params(), d.look("1"));
  const auto name = out.find("Gapmin");
  ASSERT_NE(name, std::string::npos);
  const auto line = out.rfind('\n', name), next = out.find('\n', name);
  EXPECT_EQ(out.substr(next + 1 + (name - line - 1) + 6 - 3, 3), "0.5") << out;
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

TEST(Params, OneInterfaceOnRequest) {
  const Inspected d(plates({.before = "@/INTER/TYPE7/7 grnd_IDs=2 surf_IDm=1 Gapmin=0.7"}));
  ParamsTextOptions options;
  options.only = {7};
  EXPECT_EQ(params_text(d.params(), options).find("/INTER/TYPE7/1 "), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(params_json(d.params(), {7}))["interfaces"].size(), 1u);
}

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
