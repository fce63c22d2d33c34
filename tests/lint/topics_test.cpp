// What can be asked of `deck explain`, and that every field of the contacts has its help.
#include "deck/lint/topics.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace deck {
namespace {

const SchemaSet& schemas() { return SchemaSet::built_in(); }
bool has(const std::string& page, const char* text) { return page.find(text) != std::string::npos; }

TEST(ExplainTopic, AFieldIsFoundWithoutItsKeyword) {
  const std::string page = explain_topic("gapmin", schemas());
  EXPECT_TRUE(page.starts_with("Gapmin of /INTER/TYPE7")) << page;
  EXPECT_TRUE(has(page, "/INTER/TYPE19.Gapmin"));
}

TEST(ExplainTopic, AKeywordIsFoundByItsEnd) {
  EXPECT_TRUE(explain_topic("TYPE7", schemas()).starts_with("/INTER/TYPE7"));
  EXPECT_TRUE(explain_topic("type7.gapmin", schemas()).starts_with("Gapmin of /INTER/TYPE7"));
  EXPECT_TRUE(explain_topic("/default/inter/type7", schemas()).starts_with("/DEFAULT/INTER/TYPE7"));
}

TEST(ExplainTopic, ASolverMessageLeadsToItsRules) {
  const std::string page = explain_topic("611", schemas());
  EXPECT_TRUE(has(page, "Message 611")) << page;
  EXPECT_TRUE(has(page, "DK302") || has(page, "DK303")) << page;
  EXPECT_TRUE(explain_topic("99999", schemas()).empty());
}

TEST(ExplainTopic, APrefixListsItsRules) {
  const std::string page = explain_topic("dk1", schemas());
  EXPECT_TRUE(has(page, "DK101 ") || has(page, "DK105 ")) << page;
  EXPECT_FALSE(has(page, "DK201 "));
}

TEST(ExplainTopic, WhatIsNotKnownIsEmptyAndHasNeighbours) {
  EXPECT_TRUE(explain_topic("Gapmim", schemas()).empty());
  const auto near = similar_topics("Gapmim", schemas());
  ASSERT_FALSE(near.empty());
  EXPECT_EQ(near[0], "Gapmin");
}

TEST(ExplainTopic, CompletionOffersRulesKeywordsAndFields) {
  const auto all = common_topics(schemas());
  for (const char* topic : {"DK254", "TYPE7", "Gapmin", "Edge_scale_gap"})
    EXPECT_NE(std::find(all.begin(), all.end(), topic), all.end()) << topic;
}

}  // namespace
}  // namespace deck
