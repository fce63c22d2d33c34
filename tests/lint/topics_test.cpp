// What can be asked of `deck explain`, and that every field of the contacts has its help.
#include "lint/shared/topics.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/shared/shown_text.hpp"
#include "deck/lint.hpp"

namespace deck {
namespace {

const SchemaSet& schemas() { return SchemaSet::built_in(); }
bool has(const std::string& page, const char* text) { return page.find(text) != std::string::npos; }

TEST(ExplainTopic, FindsFieldsKeywordsMessagesAndRules) {
  struct Row {
    const char *topic, *begin, *has, *has_not;
  };
  const Row rows[] = {
      {"gapmin", "Gapmin of /INTER/TYPE7", "/INTER/TYPE19.Gapmin", "?"},
      {"TYPE7", "/INTER/TYPE7", "Gapmin", "?"},
      {"type7.gapmin", "Gapmin of /INTER/TYPE7", "", "?"},
      {"/default/inter/type7", "/DEFAULT/INTER/TYPE7", "", "?"},
      {"plas_johns", "/MAT/LAW2", "", "?"},  // by its other name
      {"inter", "Keywords that begin with /INTER/\n\n  /INTER/TYPE7 ", "\n  /INTER/TYPE19 ",
       "/TH/INTER"},
      {"DEFAULT", "/DEFAULT\n", "\n  /DEFAULT/INTER/TYPE7 ", "?"},
      {"611", "Message 611", "DK302", "?"},
      {"100201", "", "DK001:", "?"},
      {"dk1", "", "DK101 ", "DK201 "},
      {"Igap 3", "Igap of", "> 3   as 2", "> 2"},  // a value is marked
      {"type7.igap = 2", "Igap of", "> 2   g = ", "?"},
      {"Igap=7", "7 is no legal value of Igap\n\nIgap of", "", "?"},
      {"Irem_gap=2", "Irem_gap of", "0, 1, >2\n", "?"},  // in the list, without a figure
      {"variable gap", "", "Fields with these words\n\n  Igap ", "?"},
      {"lock time", "", "  dtmin ", "?"},
  };
  for (const Row& row : rows) {
    const std::string page = explain_topic(row.topic, schemas());
    EXPECT_TRUE(page.starts_with(row.begin) && has(page, row.has)) << row.topic << "\n" << page;
    EXPECT_FALSE(page.empty() || (row.has_not[0] != '?' && has(page, row.has_not))) << row.topic;
  }
  EXPECT_EQ(explain_topic("/INTER", schemas()), explain_topic("inter", schemas()));
  const std::string page = explain_topic("/INTER/TYPE7", schemas());
  for (const char* header : {"/INTER/TYPE7/3", "/inter/type7/3/1"})
    EXPECT_EQ(explain_topic(header, schemas()), page) << header;
  for (const char* nothing : {"/INTER/TYPE99/3", "/INTER/TYPE7/x", "99999", "0", "000", "Gapmim"})
    EXPECT_EQ(explain_topic(nothing, schemas()), "") << nothing;
}

TEST(ExplainTopic, AFieldAndAFormerIdLeadToTheirRule) {
  const std::string all = explain_topic("DK201", schemas());
  const std::string page = explain_topic("dk201:igap", schemas());
  EXPECT_TRUE(has(all, "\n  Igap\n") && has(all, "\n  Ibag\n")) << all;
  EXPECT_TRUE(has(page, "\n  Igap\n") && !has(page, "\n  Ibag\n")) << page;
  EXPECT_TRUE(has(page, "ignore[DK201:Igap]")) << page;
  EXPECT_EQ(explain_topic("DK202", schemas()), "DK202 is now DK201:Igap.\n\n" + page);
  EXPECT_TRUE(explain_topic("DK201:Gapmin", schemas()).empty());
  EXPECT_TRUE(has(explain_topic("DK265", schemas()), "\n  VISF (info)\n"));
}

TEST(ExplainTopic, ATypingErrorHasNeighbours) {
  ASSERT_FALSE(similar_topics("Gapmim", schemas()).empty());
  EXPECT_EQ(similar_topics("Gapmim", schemas())[0], "Gapmin");
  EXPECT_EQ(similar_topics("DK1o4", schemas()), std::vector<std::string>{"DK104"});
}

TEST(FieldHelp, EveryFieldOfTheContactsHasOne) {
  for (const char* keyword : {"/INTER/TYPE7", "/INTER/TYPE10", "/INTER/TYPE11", "/INTER/TYPE19"}) {
    const Schema* s = schemas().find(keyword);
    const auto has_help = [&](const std::string& name) {
      for (const CardSchema& card : s->cards)
        for (const Field& f : card.fields)
          if (f.name == name && !field_help(f, schemas()).empty()) return true;
      return false;
    };
    for (const CardSchema& card : s->cards)
      for (const Field& f : card.fields) EXPECT_TRUE(has_help(f.name)) << keyword << "." << f.name;
  }
}

TEST(FieldHelp, FiguresStandAsTheyAreAndParagraphsAreBroken) {
  const Field* f = schemas().find("/INTER/TYPE7")->find_field("Gapmin");
  Field own = *f;
  own.help = {"one two three four five six seven", "|  o--o", "|   \\/"};
  own.help_of.clear();
  EXPECT_EQ(field_help(own, schemas(), 20),
            "  one two three four\n  five six seven\n\n      o--o\n       \\/\n");
}

/// The longest line of a page, in columns.
std::size_t widest(const std::string& page) {
  std::size_t most = 0;
  for (std::size_t at = 0; at < page.size();) {
    const auto nl = std::min(page.find('\n', at), page.size());
    const std::string line = page.substr(at, nl - at);
    // Keywords, titles and headers are single lines; a terminal's width folds them later.
    if (line.starts_with("  ")) most = std::max(most, display_width(line));
    at = nl + 1;
  }
  return most;
}

TEST(ExplainTopic, PagesOfRulesFitANarrowTerminalWithTheirCards) {
  for (const Rule& r : all_rules())
    EXPECT_LE(widest(explain_topic(id_text(r.id), schemas(), 80)), 80u) << id_text(r.id);
}

TEST(ExplainTopic, TheCellOfAnExampleIsMarked) {
  const std::string blanks(39, ' ');
  const std::string marked = "  | " + blanks + "5\n  | " + blanks + "^\n";
  for (const std::size_t width : {0, 60})
    EXPECT_TRUE(has(explain_topic("DK254", schemas(), width), marked.c_str())) << width;
  // Where the cell is far to the right, what stands before it is left out.
  const std::string narrow = explain_topic("DK220", schemas(), 40);
  EXPECT_TRUE(has(narrow, "  … ")) << narrow;
  EXPECT_TRUE(has(narrow, "^")) << narrow;
  EXPECT_LE(widest(narrow), 40u);
}

TEST(FieldHelp, LinesFitANarrowTerminal) {
  for (const Schema* s : schemas().all())
    for (const CardSchema& card : s->cards)
      for (const Field& f : card.fields) {
        const std::string text = field_help(f, schemas(), 80);
        for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
          EXPECT_LE(text.find('\n', at) - at, 80u) << s->keyword << "." << f.name << text;
      }
}

TEST(FieldHelp, HelpOfAnotherKeywordExists) {
  for (const Schema* s : schemas().all())
    for (const CardSchema& card : s->cards)
      for (const Field& f : card.fields)
        if (!f.help_of.empty()) {
          const Schema* other = schemas().find(f.help_of);
          ASSERT_NE(other, nullptr) << f.help_of;
          EXPECT_NE(other->find_field(f.name), nullptr) << f.help_of << "." << f.name;
        }
}

}  // namespace
}  // namespace deck
