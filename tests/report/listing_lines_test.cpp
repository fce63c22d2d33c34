// Listings read back line by line: everything that a line says, and lines that say nothing.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "deck/text.hpp"
#include "inspect/shared/listing.hpp"

namespace deck {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Listing read(const std::string& text) {
  auto listing = read_listing_text("car_0000.out", "CONTROL  PARAMETERS\n" + text);
  EXPECT_TRUE(listing.ok());
  return listing ? std::move(*listing) : Listing{};
}

/// "error 612 @4 INTERFACE 9 'front' nodes 1 2 count 3"; lines are counted from that of read().
std::vector<std::string> messages_of(const Listing& l) {
  std::vector<std::string> out;
  for (const ListedMessage& m : l.messages) {
    std::string text = fmt::format("{} {} @{}", to_string(m.severity), m.number, m.line - 1);
    for (const ListedId& id : m.ids) text += fmt::format(" {} {} '{}'", id.kind, id.id, id.title);
    if (!m.nodes.empty()) text += " nodes";
    for (const std::int64_t n : m.nodes) text += fmt::format(" {}", n);
    if (m.count) text += fmt::format(" count {}", *m.count);
    out.push_back(text);
  }
  return out;
}

/// "4 TYPE7 @2 total 6 @15; 5 0/1 2 3 4 on depth 0.5".
std::vector<std::string> contacts_of(const Listing& l) {
  std::vector<std::string> out;
  for (const ListedContact& c : l.contacts) {
    std::string text = fmt::format("{} TYPE{} @{}", c.interface, c.type, c.line - 1);
    if (c.total) text += fmt::format(" total {} @{}", *c.total, c.total_line - 1);
    for (const ListedPair& p : c.pairs) {
      text += fmt::format("; {} {}/{} {} {} {}", p.secondary[0], p.secondary[1], p.main[0],
                          p.main[1], p.main[2], p.main[3]);
      if (p.on_segment) text += " on";
      if (p.depth) text += " depth " + shortest(*p.depth);
    }
    out.push_back(text);
  }
  return out;
}

std::string row(std::initializer_list<int> ids) {
  std::string out;
  for (const int id : ids) out += fmt::format("{:>10}", id);
  return out + "\n";
}

TEST(ListingLines, OfAMessageNameIdsTitlesNodesAndACount) {
  EXPECT_THAT(messages_of(read("ERROR ID :    999999\n"
                               "** ERROR OF SOMETHING\n"
                               "DESCRIPTION :\n"
                               "   -- INTERFACE ID: 9 TITLE: front\n"
                               "   NODE ID : 31\n"
                               "   SECONDARY NODE: 105\n"
                               "   SEGMENT: 1 1 3 4\n"
                               "   THERE ARE 12 PAIRS\n"
                               "   CONCERNING 5 NODES\n"
                               "WARNING ID : 21\r\n"
                               "   PROPERTY ID=8 , PROPERTY TITLE: foam, ICPRE=3\n"
                               "   PART ID : 4\n"
                               "   PART TITLE: roof\n"
                               "   OTHER TITLE: floor\n"
                               "   CONCERNING 0 OF THEM\n"
                               "WARNING ID : 343\n"
                               "   -- INTERFACE ID: 6\n"
                               "   -- INTERFACE TYPE: side\n")),
              ElementsAre("error 999999 @1 INTERFACE 9 'front' nodes 31 105 1 3 4 count 12",
                          "warning 21 @10 PROPERTY 8 'foam' PART 4 'roof' count 0",
                          "warning 343 @16 INTERFACE 6 'side'"));
}

TEST(ListingLines, EndAMessageWhereTheyDoNotBelongToIt) {
  EXPECT_THAT(messages_of(read("INFO ID : 3\n"
                               "   NODES 7 8 x 9\n"
                               "   1 2 3\n"
                               "   1 2 3 4\n"  // a pair
                               "   NODES 11\n"
                               "MESSAGE ID : 1\n"
                               "** TITLE\n"
                               "** NODES 5\n"  // a title comes once
                               "   NODES 6\n"
                               "ERROR ID : 2\n"
                               "  NODES 6\n"  // two blanks
                               "   NODES 7\n"
                               "ERROR ID : 4\n"
                               "   NODES 8\n"
                               "DESCRIPTION : NODES 1\n"
                               "   NODES 9\n")),
              ElementsAre("info 3 @1 nodes 7 8 count 1", "info 1 @6", "error 2 @10",
                          "error 4 @13 nodes 8 9"));
}

TEST(ListingLines, ThatNearlyBeginAMessageDoNot) {
  for (const char* line : {"ERROR ID : 1000000", "ERROR ID : 0", "ERROR ID : -4", "ERROR ID 5",
                           "ERROR ID : 5 6", "ERRORS : 3", "ERROR NO : 3", "ERROR ID = 3",
                           "ERROR ID : x", "REMARK ID : 3", "| ERROR ID : 3"}) {
    EXPECT_THAT(messages_of(read(std::string(line) + "\n")), IsEmpty()) << line;
    EXPECT_FALSE(read_listing_text("x", std::string(line) + "\n").ok()) << line;
  }
  EXPECT_THAT(messages_of(read("   ERROR ID : 1   \n")), ElementsAre("error 1 @1"));
}

TEST(ListingLines, OfAContactGiveItsPairsAndTotals) {
  const Listing l = read(
      " INTERFACE TYPE. . . . 7\n"  // of no contact
      " INTERFACE NUMBER. . . . 4\n"
      " INTERFACE TYPE. . . . 11\n"
      "  POSSIBLE IMPACT NUMBER: 3\n" +
      row({31, 32, 33, 34}) +  // before the head of the candidates
      "    IMPACT CANDIDATES\n" + row({1, 2, 3, 4}) +
      "** INITIAL PENETRATION = 0.25 POSSIBLE NEW POSITION\n" + row({5, 6, 7, 8}) + " " +
      row({5, 6, 7, 8}) + row({1, 2, 3}) + row({1, 2, 3, 4, 5, 6}) + row({9, 1, 2, 3, 4}) +
      "** INITIAL PENETRATION = 0.1 IMPOSSIBLE TO MOVE NODE 9\n"
      "** INITIAL PENETRATION = 0.1 IMPOSSIBLE TO MOVE NODE 9\n"
      "** INITIAL PENETRATION = 0.1 IMPOSSIBLE TO MOVE NODE x\n"
      "WARNING ID :    343\n"
      "   -- INTERFACE ID: 4\n"
      "   THERE ARE 6 INITIAL PENETRATIONS\n"
      "  POSSIBLE IMPACT NUMBER: 9\n" +  // line 20: another part
      row({1, 2, 3, 4}) +
      "WARNING ID :    499\n"
      "   -- INTERFACE ID: 4\n"
      "   CONCERNING 2\n"
      "WARNING ID :    343\n"
      "   -- INTERFACE ID: 5\n"  // which has no header
      "   THERE ARE 8\n"
      "WARNING ID :    344\n"  // no total
      "   -- INTERFACE ID: 4\n"
      "   THERE ARE 7\n"
      " INTERFACE NUMBER. . . . x\n"
      " INTERFACE NUMBER. . . . 6\n");
  EXPECT_THAT(contacts_of(l),
              ElementsAre("4 TYPE11 @2 total 6 @17; 1 2/3 4 0 0 depth 0.25; 5 6/7 8 0 0; "
                          "9 0/1 2 3 4 on; 9 0/0 0 0 0 on",
                          "4 TYPE0 @20 total 2 @22", "5 TYPE0 @27 total 8 @25", "6 TYPE0 @32"));
}

/// Only the messages that are printed during the work on a contact name its interface.
TEST(ListingLines, OfAMessageDuringTheWorkNameAPartsInterface) {
  for (const int number : {343, 499, 611, 612, 1164, 344, 500, 610, 613, 1165}) {
    const Listing l = read(
        " INTERFACE NUMBER. . . . 4\n  POSSIBLE IMPACT NUMBER: 1\n"
        "  POSSIBLE IMPACT NUMBER: 1\nERROR ID : " +
        std::to_string(number) + "\n   -- INTERFACE ID: 4\n");
    const bool during =
        number == 343 || number == 499 || number == 611 || number == 612 || number == 1164;
    EXPECT_THAT(contacts_of(l), ElementsAre("4 TYPE0 @1", during ? "4 TYPE0 @3" : "0 TYPE0 @3"))
        << number;
  }
}

/// The same interface again begins another pass, if the first one had its type.
TEST(ListingLines, OfAnotherPassReplaceTheContacts) {
  const std::string four = " INTERFACE NUMBER. . . . 4\n", five = " INTERFACE NUMBER. . . . 5\n";
  const std::string type = " INTERFACE TYPE. . . . 7\n";
  EXPECT_THAT(contacts_of(read(four + type + five + type + four)), ElementsAre("4 TYPE0 @5"));
  EXPECT_THAT(contacts_of(read(four + four)), ElementsAre("4 TYPE0 @1", "4 TYPE0 @2"));
  EXPECT_THAT(contacts_of(read(four + type + five)), ElementsAre("4 TYPE7 @1", "5 TYPE0 @3"));
}

TEST(ListingLines, OfMessage1164GiveDepths) {
  const std::string head =
      " INTERFACE NUMBER. . . . 4\n INTERFACE TYPE. . . . 7\n    IMPACT CANDIDATES\n";
  const std::string table =
      "WARNING ID :   1164\n   -- INTERFACE ID: 4\n"
      "   5 1 2 3 4 0.5\n   6 1 2 3 4 0.25\n   6 1 2 3 4 0.75\n   7 1 2 3 x 0.5\n"
      "   7 1 2 3 4 y\n   7 1 2 3 4 0.5 9\n";
  EXPECT_THAT(contacts_of(read(head + table)),
              ElementsAre("4 TYPE7 @1; 5 0/1 2 3 4 depth 0.5; 6 0/1 2 3 4 depth 0.75"));
  EXPECT_THAT(contacts_of(read(head + row({5, 1, 2, 3, 4}) + row({8, 1, 2, 3, 4}) +
                               row({5, 1, 2, 3, 4}) + row({5, 1, 2, 3, 9}) + table)),
              ElementsAre("4 TYPE7 @1; 5 0/1 2 3 4 depth 0.5; 8 0/1 2 3 4; 5 0/1 2 3 4 depth 0.5; "
                          "5 0/1 2 3 9; 6 0/1 2 3 4 depth 0.75"));
  EXPECT_THAT(contacts_of(read(table)), IsEmpty());
}

std::string steps_text(const std::vector<ListedStep>& steps) {
  std::string out;
  for (const ListedStep& s : steps) out += fmt::format("{}:{} ", s.id, shortest(s.dt));
  return out;
}

TEST(ListingLines, OfTablesOfTimeStepsGoToTheirElements) {
  const std::pair<const char*, ElementKind> kinds[] = {{"TRIANGULAR SHELL", ElementKind::shell3},
                                                       {"SHELL", ElementKind::shell4},
                                                       {"SOLID", ElementKind::solid8},
                                                       {"QUAD", ElementKind::quad},
                                                       {"TRUSS", ElementKind::truss},
                                                       {"BEAM", ElementKind::beam},
                                                       {"SPRING", ElementKind::spring}};
  const std::string rows =
      " ELEMENTS TIME STEP\n -------\n\n TIME STEP   NUMBER\n 1.5 7\n 0.25 9\n\n 3.5 8\n";
  for (const auto& [word, kind] : kinds) {
    const Listing l = read(" " + std::string(word) + rows);
    ASSERT_EQ(l.element_steps.size(), 1u) << word;
    EXPECT_EQ(l.element_steps.begin()->first, kind) << word;
    EXPECT_EQ(steps_text(l.element_steps.at(kind)), "7:1.5 9:0.25 ") << word;
  }
  // A table of something else ends the one before it.
  const Listing other = read(" BEAM ELEMENTS TIME STEP\n 1.5 7\n MEMBRANE" + rows);
  EXPECT_EQ(steps_text(other.element_steps.at(ElementKind::beam)), "7:1.5 ");
  for (const char* end : {"WORDS", "2.5 8 9", "2.5", "x 8", "2.5 x", "NODAL TIME STEP"}) {
    const Listing l = read(" QUAD ELEMENTS TIME STEP\n 1.5 7\n " + std::string(end) + "\n 3.5 9\n");
    EXPECT_EQ(steps_text(l.element_steps.at(ElementKind::quad)), "7:1.5 ") << end;
  }
  const Listing nodes = read(" NODAL TIME STEP (estimation)\n\n 1.5 7\n -\n 2.5 8\n\n 3.5 9\n");
  EXPECT_EQ(steps_text(nodes.node_steps), "7:1.5 8:2.5 ");
}

TEST(ListingLines, SayWhatTheListingIs) {
  for (const char* line :
       {"    IPRI  : FLAG . . 3", "IPRI: 3", "CONTROL  PARAMETERS", "* INPUT READING PROCESS"})
    EXPECT_TRUE(read_listing_text("x", line).ok()) << line;
  EXPECT_EQ(read("IPRI: 3\n").printout, 3);
  EXPECT_EQ(read("IPRI  : FLAG . . 5\n").printout, 5);
  EXPECT_EQ(read("IPRI: x\n").printout, 0);
  for (const char* line : {"IPRIX 4", "CONTROL PARAMETERS", "INPUT READING PROCESS", "",
                           "2 ERROR(S)", "INTERFACE NUMBER. . 4"})
    EXPECT_FALSE(read_listing_text("x", line).ok()) << line;
  const Listing l = read("   12 ERROR(S)\n   3 WARNING(S)\n");
  EXPECT_EQ(l.errors, 12u);
  EXPECT_EQ(l.warnings, 3u);
  const Listing none = read("   x ERROR(S)\n   WARNING(S)\n");
  EXPECT_FALSE(none.errors || none.warnings);
}

TEST(ListingLines, OfAnotherFileSayWhichOne) {
  const std::pair<const char*, const char*> cases[] = {
      {"CYCLE    TIME  STEP\n", "x is a listing of the Engine"},
      {"NC=  1\n", "x is a listing of the Engine"},
      {"/BEGIN\n", "x is a deck, no listing"},
      {"# a comment\n/BEGIN\n", "x is a deck, no listing"},
      {"#RADIOSS STARTER\n", "x is a deck, no listing"},
      {"", "x is empty; "},
      {"a /BEGIN\n", "x is no listing of the Starter: no message or interface of one is in it; "}};
  for (const auto& [text, why] : cases) {
    const auto listing = read_listing_text("x", text);
    ASSERT_FALSE(listing.ok()) << text;
    EXPECT_THAT(listing.error().message, HasSubstr(why)) << text;
  }
}

}  // namespace
}  // namespace deck
