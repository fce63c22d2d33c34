// Messages of the solver by number and by words.
#include "lint/shared/topics.hpp"

#include <gtest/gtest.h>

#include "deck/text.hpp"

namespace deck {
namespace {

const SchemaSet& schemas() { return SchemaSet::built_in(); }
bool has(const std::string& page, const char* text) { return page.find(text) != std::string::npos; }

TEST(SolverMessages, AreOrderedAndEachIsThereOnce) {
  int last = 0;
  for (const SolverMessage& m : solver_messages()) {
    EXPECT_LT(last, m.number);
    EXPECT_FALSE(m.title.empty() || m.means.empty() || m.action.empty()) << m.number;
    EXPECT_EQ(find_solver_message(m.number), &m);
    last = m.number;
  }
  EXPECT_GT(solver_messages().size(), 100u);
  EXPECT_EQ(find_solver_message(0), nullptr);
  EXPECT_EQ(find_solver_message(last + 1), nullptr);
}

TEST(SolverMessages, HaveTheSeverityOfTheRulesThatReportThem) {
  for (const Rule& rule : all_rules())
    for (const ReferenceMessage& m : rule.messages) {
      const SolverMessage* own = find_solver_message(m.number);
      if (own != nullptr) {
        EXPECT_EQ(own->severity, m.severity) << m.number;
      }
    }
}

TEST(MessageNumber, IsFoundInTheWordsOfAListing) {
  EXPECT_EQ(message_number("611"), 611);
  EXPECT_EQ(message_number("error 611"), 611);
  EXPECT_EQ(message_number("WARNING ID :    343"), 343);
  EXPECT_EQ(message_number(" MESSAGE ID : 1741 "), 1741);
  EXPECT_FALSE(message_number("error"));
  EXPECT_FALSE(message_number("611 or 612"));
  EXPECT_FALSE(message_number("Inacti 6"));
  EXPECT_FALSE(message_number("1234567"));
}

TEST(ExplainTopic, ANumberIsNeverThatOfARule) {
  EXPECT_TRUE(
      explain_topic("312", schemas()).starts_with("Message 312 of the reference solver (warning)"));
  EXPECT_FALSE(has(explain_topic("312", schemas()), "DK312"));
  for (const char* number : {"101", "103", "204"}) EXPECT_EQ(explain_topic(number, schemas()), "");
}

TEST(ExplainTopic, WordsOfAMessageLeadToIt) {
  for (const char* words : {"initial penetrations", "THERE ARE 378 INITIAL PENETRATIONS"}) {
    const std::string page = explain_topic(words, schemas());
    EXPECT_TRUE(has(page, "\n  343 ")) << page;
    EXPECT_TRUE(has(page, "\n  499 ")) << page;
    EXPECT_TRUE(has(page, "\n  DK301 ")) << page;
    EXPECT_TRUE(has(page, "deck explain 343")) << page;
  }
  EXPECT_TRUE(has(explain_topic("** CHECK TIED INTERFACE", schemas()), "\n  1157 "));
  EXPECT_TRUE(explain_topic("initial nonsense", schemas()).empty());
  EXPECT_TRUE(explain_topic("there are", schemas()).empty());
}

TEST(SummaryOfMessage, ComesFromItsEntryElseFromARule) {
  EXPECT_EQ(summary_of_message(343).title, "initial penetrations of an interface");
  EXPECT_EQ(summary_of_message(178).title, "part without property");
  EXPECT_TRUE(summary_of_message(99999).title.empty());
}

}  // namespace
}  // namespace deck
