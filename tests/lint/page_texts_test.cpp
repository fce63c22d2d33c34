// Pages of `deck explain` word for word, of a rule and of keywords that exist in these tests only.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>

#include "deck/lint/rule.hpp"
#include "lint/shared/example.hpp"
#include "lint/shared/messages.hpp"
#include "lint/shared/topics.hpp"

namespace deck {
namespace {

/// Every kind of cell, condition, bound and repetition once.
constexpr const char* made_up = R"({"keyword": "/MADE/UP", "aliases": ["/MADE/DOWN", "/MADE/SO"],
  "kind": "other", "from": 90, "doc": "A keyword of this test.", "cards": [
  {"name": "ids", "fields": [
    {"name": "Flag", "cols": [1, 10], "type": "int", "values": [0, 1, 3], "default": "1",
     "doc": "what it does"},
    {"name": "Other", "cols": [11, 15], "type": "int", "doc": "a second one"},
    {"name": "Side", "cols": [16, 20], "type": "id", "ref": "surf", "versions": [100, null],
     "missing": 9901, "empty": 9902, "required": 9901, "doc": "a surface",
     "manual": "Surf there"},
    {"name": "Size", "cols": [21, 40], "type": "real", "min": 0.5, "max": 3, "max_open": true,
     "default": "the other one", "dim": [1, -1, -2],
     "dim_when": [{"when": [{"field": "Flag", "in": [3]}], "dim": [0, 3, 0, 1]}],
     "when": [{"field": "Flag", "in": [3]}], "ignored": true, "doc": "a number"}]},
  {"name": "nothing", "versions": [100, 119], "when": [{"field": "Flag", "not_in": [0, 1]}],
   "blank": true},
  {"name": "list", "versions": [120, null], "repeat": "ids", "count": "Flag", "per_line": 8,
   "fields": [
    {"name": "Node", "cols": [1, 10], "type": "id", "ref": "node", "max": 7, "doc": "a node"}]},
  {"name": "rows", "versions": [90, 2019],
   "when": [{"field": "Flag", "in": [1, 3]}, {"field": "Other", "min": 2, "max": 9}],
   "repeat": "rows", "fields": [
    {"name": "Word", "cols": [1, 10], "type": "text"},
    {"name": "Least", "cols": [11, 20], "type": "real", "min": 0, "min_open": true,
     "when": [{"field": "Other", "not_in": [5]}], "doc": "more than nothing"}]}]})";

const SchemaSet& own() {
  static const SchemaSet set = [] {
    SchemaSet made;
    for (const char* text :
         {made_up,
          R"({"keyword": "/MADE/PLAIN", "kind": "other", "id": false, "title": false, "doc": "",
              "cards": [{"name": "old", "versions": [44, 109], "fields": [
                {"name": "Size", "cols": [1, 20], "type": "real", "versions": [51, null]}]},
              {"name": "new", "versions": [110, null], "fields": [
                {"name": "Size", "cols": [21, 40], "type": "real", "doc": "old"}]}]})",
          R"({"keyword": "/MADE/WITH/A/LONG/NAME/BELOW", "kind": "other", "unit": false,
              "doc": "One more.", "cards": [{"name": "c", "fields": [
                {"name": "Moved", "cols": [1, 20], "type": "real", "versions": [51, 89],
                 "doc": "It."},
                {"name": "Moved", "cols": [11, 30], "type": "real", "versions": [90, null],
                 "doc": "It."}]}]})"}) {
      const auto added = made.add_json("own", text);
      if (!added) throw std::runtime_error(added.error().message);
    }
    return made;
  }();
  return set;
}

TEST(KeywordPage, HasEveryLineAndCell) {
  EXPECT_EQ(explain_keyword(*own().find("/MADE/UP"), {}, 92),
            "/MADE/UP, /MADE/DOWN, /MADE/SO\n"
            "  A keyword of this test.\n"
            "  from version 90\n"
            "  header: /MADE/UP/id/unit_ID, then a title line of at most 100 characters\n"
            "\nids (all versions)\n"
            "    1-10  Flag            what it does [0, 1, 3]; 0 or blank: 1\n"
            "   11-15  Other           a second one\n"
            "   16-20  Side            a surface (from version 100)\n"
            "            Manual: Surf there\n"
            "   21-40  Size            a number [>= 0.5, < 3]; 0 or blank: the other one; only if "
            "Flag =\n"
            "                          3 (not used)\n"
            "\nnothing (versions 100 to 119; only if Flag none of 0, 1)\n"
            "  must be blank: its text is not read, but the line counts\n"
            "\nlist (from version 120; repeats, count Flag)\n"
            "    1-10  Node            a node [<= 7]\n"
            "\nrows (up to version 2019; only if Flag in 1, 3 and Other >= 2 <= 9; repeats)\n"
            "    1-10  Word            \n"
            "   11-20  Least           more than nothing [> 0]; only if Other other than 5\n");
  EXPECT_EQ(explain_keyword(*own().find("/MADE/UP")),
            explain_keyword(*own().find("/MADE/UP"), {}, usual_page_width));
}

TEST(KeywordPage, OfAHeaderWithoutIdOrUnitSaysSo) {
  const std::string plain = explain_keyword(*own().find("/MADE/PLAIN"), {}, 92);
  EXPECT_TRUE(plain.starts_with("/MADE/PLAIN\n  header: /MADE/PLAIN, no title line\n\nold "))
      << plain;
  const std::string text = explain_keyword(*own().find("/MADE/WITH/A/LONG/NAME/BELOW"), {}, 92);
  EXPECT_NE(text.find("  header: /MADE/WITH/A/LONG/NAME/BELOW/id, then a title line"), text.npos)
      << text;
}

TEST(KeywordPage, OfALineOfSomeVersionsNamesBoth) {
  Schema s = *own().find("/MADE/UP");
  s.cards[3].from = 100;
  EXPECT_NE(explain_keyword(s, {}, 92).find("\nrows (versions 100 to 2019; only if"),
            std::string::npos);
}

TEST(FieldPage, HasEverythingOfACell) {
  const Schema& s = *own().find("/MADE/UP");
  EXPECT_EQ(explain_keyword(s, "Size", 92),
            "Size of /MADE/UP: a number\n"
            "  columns     21-40 of the line 'ids', all versions\n"
            "  present if  Flag = 3\n"
            "  type        real\n"
            "  legal       >= 0.5, < 3\n"
            "  default     the other one\n"
            "  dimension   mass length^-1 time^-2; length^3 temperature if Flag = 3\n"
            "  effect      none: the reference solver does not use it\n");
  EXPECT_EQ(explain_keyword(s, "Side", 92),
            "Side of /MADE/UP: a surface\n"
            "  columns     16-20 of the line 'ids', from version 100\n"
            "  type        id of surf\n"
            "  manual      Surf there\n");
  EXPECT_EQ(explain_keyword(s, "Word", 92),
            "Word of /MADE/UP: rows\n"
            "  columns     1-10 of the line 'rows', up to version 2019\n"
            "  present if  Flag in 1, 3 and Other >= 2 <= 9\n"
            "  type        text\n");
  EXPECT_EQ(explain_keyword(s, "Least", 92),
            "Least of /MADE/UP: more than nothing\n"
            "  columns     11-20 of the line 'rows', up to version 2019\n"
            "  present if  Flag in 1, 3 and Other >= 2 <= 9 and Other other than 5\n"
            "  type        real\n"
            "  legal       > 0\n"
            "  dimension   none\n");
  EXPECT_EQ(explain_keyword(s, "Flag", 40),
            "Flag of /MADE/UP: what it does\n"
            "  columns     1-10 of the line 'ids',\n"
            "              all versions\n"
            "  type        integer\n"
            "  legal       0, 1, 3\n"
            "  default     1\n");
  EXPECT_EQ(explain_keyword(s, "Nobody", 92), "");
}

/// Of two layouts the newest comes first; those that differ in their columns alone share the rest.
TEST(FieldPage, ShowsTheNewestLayoutFirst) {
  EXPECT_EQ(explain_keyword(*own().find("/MADE/WITH/A/LONG/NAME/BELOW"), "Moved", 92),
            "Moved of /MADE/WITH/A/LONG/NAME/BELOW: It.\n"
            "  columns     11-30 of the line 'c', from version 90\n"
            "  columns     1-20 of the line 'c', versions 51 to 89\n"
            "  type        real\n"
            "  dimension   none\n");
  // The other text makes another layout: the one is called "old", the other has it as its text.
  EXPECT_EQ(explain_keyword(*own().find("/MADE/PLAIN"), "Size", 92),
            "Size of /MADE/PLAIN: old\n"
            "  columns     21-40 of the line 'new', from version 110\n"
            "  columns     1-20 of the line 'old', versions 51 to 109\n"
            "  type        real\n"
            "  dimension   none\n");
}

TEST(Topics, KeywordsBelowAreListedWithTheirTexts) {
  EXPECT_EQ(explain_topic("made", own(), 60),
            "Keywords that begin with /MADE/\n"
            "\n"
            "  /MADE/PLAIN\n"
            "  /MADE/UP                   A keyword of this test.\n"
            "  /MADE/WITH/A/LONG/NAME/BELOW\n"
            "                             One more.\n"
            "\n"
            "Show one of them: deck explain /MADE/PLAIN\n");
}

TEST(Topics, AFieldOfSeveralKeywordsNamesTheOthers) {
  const std::string page = explain_topic("size", own());
  EXPECT_TRUE(page.starts_with("Size of /MADE/PLAIN: old\n")) << page;
  EXPECT_TRUE(page.ends_with("\nAlso a field of\n  /MADE/UP.Size\n")) << page;
  EXPECT_EQ(explain_topic("Word", own()), explain_keyword(*own().find("/MADE/UP"), "Word", 92));
  EXPECT_EQ(explain_topic("up.word", own()), explain_topic("Word", own()));
  EXPECT_EQ(explain_topic("down", own()), explain_topic("/down", own()));
  EXPECT_EQ(explain_topic("/down", own()), explain_keyword(*own().find("/MADE/UP"), {}, 92));
  EXPECT_EQ(explain_topic("/MADE/UP/3/4", own()), explain_topic("/down", own()));
  EXPECT_EQ(explain_topic("/MADE/UP/3/x", own()), "");
}

TEST(MessagePage, NamesTheCellsThatAreStoppedAt) {
  EXPECT_EQ(explain_message(9901, own(), 92),
            "Message 9901 of the reference solver\n"
            "\n"
            "Cells with this message\n"
            "  /MADE/UP.Side: the named entity does not exist\n"
            "  /MADE/UP.Side: the cell is 0 or blank\n");
  EXPECT_EQ(explain_message(9902, own(), 92),
            "Message 9902 of the reference solver\n"
            "\n"
            "Cells with this message\n"
            "  /MADE/UP.Side: the named entity has no members\n");
  EXPECT_EQ(explain_message(9903, own(), 92), "");
  EXPECT_EQ(explain_message(-9901, own(), 92), "");
}

// ---- rules ----------------------------------------------------------------------------------

Rule rule_of_this_test() {
  Rule r;
  r.id = RuleId::DK254;
  r.title = "A title";
  r.severities = {Severity::warning, Severity::error};
  r.fixable = Fixable::safe;
  r.types = {7, 25};
  r.problem = "Something is wrong.";
  r.why = "It matters.";
  r.solver = "It stops.";
  r.messages = {{79, Severity::error}, {80, Severity::warning}};
  r.fields = {{"Aa", RuleId::none, {}, "Note.", "Solver.", "Fix."},
              {"Bb", RuleId::none, Severity::info, "", "", ""},
              {"Cc", RuleId::none, {}, "Note.", "Solver.", "Fix."},
              {"Dd", RuleId::none, {}, "", "Alone.", ""}};
  r.source = "run error 79; manual /RBODY; manual /BCS;record x";
  r.fix = "Mend it.";
  r.bad = "/UNHEARDOF/1\n\n         1         2         3\n";
  r.ignore = "Never.";
  return r;
}

TEST(RulePageText, HasEverySection) {
  EXPECT_EQ(explain_rule(rule_of_this_test(), own()),
            "DK254: A title\n"
            "warning or error, " +
                std::string(family_of(RuleId::DK254)) +
                ", fixed by --fix\n"
                "About TYPE7, TYPE25\n"
                "\n"
                "What is wrong\n  Something is wrong.\n\n"
                "Why it matters\n  It matters.\n\n"
                "What the reference solver does\n  It stops (error 79).\n\n"
                "Fields\n"
                "  Aa, Cc\n      Note. Solver. Fix.\n"
                "  Bb (info)\n"
                "  Dd\n      Alone.\n\n"
                "Known from\n"
                "  run of the solver: error 79; manual: /RBODY, /BCS; recorded values of the "
                "solver: x.\n\n"
                "How to fix\n  Mend it.\n\n"
                "Fires on\n  | /UNHEARDOF/1\n  |\n  |          1         2         3\n\n"
                "When to ignore\n  Never.\n\n"
                "Suppress it for one block with a comment in or above the block:\n"
                "  # decklint: ignore[DK254:Aa] reason=...\n");
}

TEST(RulePageText, LeavesOutWhatARuleDoesNotSay) {
  Rule r;
  r.id = RuleId::DK254;
  r.title = "A title";
  r.severities = {Severity::info};
  r.fixable = Fixable::unsafe;
  r.problem = "Something is wrong.";
  EXPECT_EQ(explain_rule(r, own()),
            "DK254: A title\n"
            "info, " +
                std::string(family_of(RuleId::DK254)) +
                ", fixed by --unsafe-fixes\n"
                "\n"
                "What is wrong\n  Something is wrong.\n\n"
                "Suppress it for one block with a comment in or above the block:\n"
                "  # decklint: ignore[DK254] reason=...\n");
}

TEST(RulePageText, OfOneFieldShowsNoOther) {
  const std::string page = explain_rule(rule_of_this_test(), own(), 92, "DK254:Dd");
  EXPECT_NE(page.find("\n\nFields\n  Dd\n      Alone.\n\nKnown from\n"), page.npos) << page;
  EXPECT_NE(page.find("ignore[DK254:Dd]"), page.npos) << page;
}

/// At 34 columns three cells of ten fit behind the bar; the blank line keeps its bar.
TEST(RulePageText, CardsAreContinuedInWholeCells) {
  Rule r = rule_of_this_test();
  r.bad = "         1         2         3\n\n         1                   3         4         5";
  const std::string page = explain_rule(r, own(), 34);
  EXPECT_NE(page.find("Fires on\n"
                      "  |          1         2         3\n"
                      "  |\n"
                      "  |          1                   3\n"
                      "  …          4         5\n\n"),
            page.npos)
      << page;
  // Blanks at the end of a piece are cut off, and no page is narrower than 24 columns.
  const std::string narrow = explain_rule(r, own(), 10);
  EXPECT_NE(narrow.find("  |          1\n  …          3         4\n  …          5\n"), narrow.npos)
      << narrow;
}

// ---- lists ----------------------------------------------------------------------------------

TEST(TopicLists, OfAFamilyHaveEveryRuleOfIt) {
  for (const std::string prefix : {"DK", "DK1", "DK20", "DK37"}) {
    std::string list;
    std::size_t count = 0;
    RuleId first = RuleId::none;
    for (const Rule& r : all_rules()) {
      if (!id_text(r.id).starts_with(prefix)) continue;
      if (count++ == 0) first = r.id;
      list += fmt::format("  {:<7}{:<8}{}\n", id_text(r.id), to_string(r.severity()), r.title);
    }
    EXPECT_EQ(explain_topic(prefix, own(), 400),
              fmt::format("{}: {} {} ({})\n\n{}\nShow one of them: deck explain {}\n", prefix,
                          count, count == 1 ? "rule" : "rules",
                          prefix == "DK" ? "all" : family_of(first), list, id_text(first)));
  }
  EXPECT_EQ(explain_topic("DK99", own()), "");
}

TEST(TopicLists, OfAMessagesWordsHaveItsLine) {
  const auto& all = solver_messages();
  for (std::size_t i = 0; i < all.size(); i += 7) {
    const SolverMessage& m = all[i];
    const std::string page = messages_about(m.title, 400);
    EXPECT_TRUE(page.starts_with("Messages of the reference solver with these words\n\n  "))
        << m.title;
    EXPECT_NE(
        page.find(fmt::format("\n  {:<8} {:<7} {}\n", m.number, to_string(m.severity), m.title)),
        page.npos)
        << page;
  }
  const Rule& rule = rule_of(RuleId::DK254);
  EXPECT_NE(messages_about(rule.title, 400)
                .find(fmt::format("Rules with these words\n\n  {:<8} {:<7} {}\n", id_text(rule.id),
                                  to_string(rule.severity()), rule.title)),
            std::string::npos);
  EXPECT_EQ(messages_about("there is the error of an id 12", 400), "") << "small words only";
}

/// A rule is on the page of a message that it reports, or that its text names as one.
TEST(MessagePage, ListsTheRulesThatNameIt) {
  for (const int number : {1, 2, 5, 6, 21, 79, 94, 95, 178, 343, 499, 611, 612, 760}) {
    const std::regex mention("(errors? |warnings? |messages? |\\()" + std::to_string(number) +
                             "(?![0-9A-Za-z])(?!\\.[0-9])");
    const std::string page = "\n" + explain_message(number, own(), 92);
    for (const Rule& r : all_rules()) {
      const bool own_message =
          std::any_of(r.messages.begin(), r.messages.end(),
                      [&](const ReferenceMessage& m) { return m.number == number; });
      EXPECT_EQ(page.find("\n" + std::string(id_text(r.id)) + ": ") != page.npos,
                own_message || std::regex_search(r.solver, mention) ||
                    std::regex_search(r.title, mention))
          << number << " " << id_text(r.id);
      EXPECT_EQ(page.find(" of the solver as " + std::string(id_text(r.id)) + "\n") != page.npos,
                own_message)
          << number << " " << id_text(r.id);
    }
  }
}

TEST(TopicLists, NearWordsAreThoseWithinAThird) {
  EXPECT_EQ(similar_topics("/MADE/UB", own()), std::vector<std::string>{"/MADE/UP"});
  EXPECT_EQ(similar_topics("/MADE/XY", own()), std::vector<std::string>{"/MADE/UP"});
  EXPECT_TRUE(similar_topics("/MAD/XYZ", own()).empty());
  std::vector<std::string> rules;
  for (const Rule& r : all_rules()) rules.emplace_back(id_text(r.id));
  EXPECT_EQ(common_topics(own()), rules) << "no contacts";
}

TEST(TopicLists, ContactsComeFirstAndEveryKeywordOnce) {
  const SchemaSet& built_in = SchemaSet::built_in();
  const std::vector<const Schema*> all = contacts_first(built_in);
  ASSERT_EQ(all.size(), built_in.all().size());
  EXPECT_EQ(std::set<const Schema*>(all.begin(), all.end()).size(), all.size());
  const char* const first[] = {"/INTER/TYPE7", "/INTER/TYPE10", "/INTER/TYPE11", "/INTER/TYPE19"};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(all[i]->keyword, first[i]);
  for (std::size_t i = 5; i < all.size(); ++i) EXPECT_LT(all[i - 1]->keyword, all[i]->keyword);
}

// ---- examples -------------------------------------------------------------------------------

TEST(ExampleNotation, ShowsWhatTheTextDoesNot) {
  EXPECT_EQ(example_text("@version 44\n@limit include_depth 3\nfirst\n@file sub/a.inc\nx", own()),
            "--- input version 44\n--- include_depth at most 3\nfirst\n--- sub/a.inc\nx\n");
  EXPECT_EQ(example_text("@version 2022\n@bare\nfirst\n", own()), "first\n");
  EXPECT_EQ(example_text("@/NOBODY/1 A=2\n", own()), "# no schema for /NOBODY/1\n");
  EXPECT_EQ(example_text("@file\n@limit x\n@gzip\n", own()), "@file\n@limit x\n@gzip\n")
      << "a name is missing: taken as it is";
}

TEST(ExampleNotation, MakesTheFilesOfADeck) {
  const std::string units = "                  kg                  mm                  ms\n";
  const auto head = [&](const char* version) {
    return "#RADIOSS STARTER\n/BEGIN\nexample\n" + std::string(version) + "         0\n" + units +
           units;
  };
  EXPECT_EQ(example_deck("@bare\n@version 44\nbody", own()).main,
            head("        44") + "body\n/END\n");
  EXPECT_EQ(example_deck("@deck\nbody", own()).main, "body");
  const std::string whole = example_deck("body\n", own()).main;
  EXPECT_TRUE(whole.starts_with(head("      2022") + "/MAT/ELAST/1\nsteel\n")) << whole;
  EXPECT_TRUE(whole.ends_with("                 5.0\nbody\n/END\n")) << whole;
  const ExampleDeck deck =
      example_deck("@limit depth 7\na\n@file one\nb\n@gzip two\nc\n@file three\nd", own());
  EXPECT_EQ(deck.limits, (std::vector<std::pair<std::string, int>>{{"depth", 7}}));
  ASSERT_EQ(deck.files.size(), 3u);
  EXPECT_EQ(deck.files[0], std::pair(std::string("one"), std::string("b\n")));
  EXPECT_EQ(deck.files[1].first, "two");
  EXPECT_TRUE(deck.files[1].second.starts_with("\x1f\x8b")) << "packed";
  EXPECT_EQ(deck.files[2], std::pair(std::string("three"), std::string("d")));
}

}  // namespace
}  // namespace deck
