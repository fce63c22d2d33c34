// Listings of the Starter read back and held against their decks.
#include "report/shared/listing.hpp"

#include "deck/text/rule_id.hpp"
#include "report/inspected.hpp"

namespace deck {
namespace {

using test::Inspected;
using test::plates;

std::string head(int printout) {
  return "* INPUT READING PROCESS\n    IPRI  : PRINTOUT FLAG . . . . . . . .         " +
         std::to_string(printout) + "\n";
}

std::string contact_head(int id, int type) {
  return "\n INTERFACE NUMBER. . . . . . . . . . . . . ." + std::string(9, ' ') +
         std::to_string(id) + "\n INTERFACE TYPE. . . . . . . . . . . . . . .     " +
         std::to_string(type) + "\n\n  POSSIBLE IMPACT NUMBER:           4  (<=  1 *NSN)\n";
}

std::string row(std::initializer_list<int> ids) {
  std::string out;
  for (const int id : ids) out += fmt::sprintf("%10d", id);
  return out + "\n";
}

constexpr const char* pairs_head =
    "\n    IMPACT CANDIDATES\n   SECONDARY        MAIN SEGMENT NODES\n   NODE\n";

std::string total(int id, int pairs, int nodes) {
  return fmt::format(
      "\nWARNING ID :    343\n** WARNING: INITIAL PENETRATIONS IN INTERFACE\nDESCRIPTION :  \n"
      "   -- INTERFACE ID: {}\n   -- INTERFACE TYPE: example\n"
      "   THERE ARE {} INITIAL PENETRATIONS\n   ( CONCERNING {} NODES )\n",
      id, pairs, nodes);
}

constexpr const char* end = "\n\n              0 ERROR(S)\n              1 WARNING(S)\n";

/// What the Starter prints for plates(): four nodes 0.4 above a segment, with a gap of 0.5.
std::string listing_of_plates() {
  std::string rows;
  for (const int node : {5, 6, 7, 8}) rows += row({node, 1, 2, 3, 4});
  return head(5) + contact_head(1, 7) + contact_head(1, 7) + pairs_head + rows +
         "\nWARNING ID :   1164\n** WARNING: INITIAL PENETRATIONS IN INTERFACE\nDESCRIPTION :  \n"
         "   -- INTERFACE ID: 1\n   -- INTERFACE TITLE: example\n   CONCERNING 4 NODE(S):\n"
         "   SECONDARY_NODE  MAIN_NODE_1 MAIN_NODE_2\n"
         "   5         1             2             3             4                0.1\n"
         "   6         1             2             3             4                0.1\n"
         "   7         1             2             3             4                0.1\n"
         "   8         1             2             3             4                0.1\n" +
         total(1, 4, 4) + end;
}

Listing read(const std::string& text) {
  auto listing = read_listing_text("car_0000.out", text);
  EXPECT_TRUE(listing.ok());
  return listing ? std::move(*listing) : Listing{};
}

TEST(CompareListing, MatchesPairByPairAndLeadsToTheCard) {
  Inspected deck(plates());
  const Listing listing = read(listing_of_plates());
  const ListingReport report = compare_listing(listing, deck.loaded);
  ASSERT_EQ(report.contacts.size(), 1u);
  const ComparedContact& contact = report.contacts[0];
  EXPECT_TRUE(contact.agrees());
  EXPECT_TRUE(contact.by_pair);
  ASSERT_EQ(contact.pairs.size(), 4u);
  EXPECT_TRUE(contact.pairs[0].listed);
  EXPECT_NEAR(contact.largest_difference, 0, 1e-12);
  EXPECT_TRUE(report.agrees());
  const auto group = std::find_if(report.messages.begin(), report.messages.end(),
                                  [](const MessageGroup& g) { return g.number == 343; });
  ASSERT_NE(group, report.messages.end());
  ASSERT_EQ(group->places.size(), 1u);
  EXPECT_EQ(group->places[0].name, "interface 1 'example'");
  EXPECT_EQ(group->places[0].counted, std::vector<std::uint64_t>{4});
  EXPECT_TRUE(group->places[0].span.valid());
  ASSERT_FALSE(group->places[0].findings.empty());
  EXPECT_EQ(report.findings[group->places[0].findings[0]].rule, RuleId::DK301);
}

TEST(CompareListing, NamesWhatDeckExpectsAndTheListingDoesNotHave) {
  Inspected deck(plates());
  const Listing listing = read(head(0) + end);
  const ListingReport report = compare_listing(listing, deck.loaded);
  EXPECT_TRUE(std::any_of(report.not_listed.begin(), report.not_listed.end(),
                          [&](std::size_t f) { return report.findings[f].rule == RuleId::DK301; }));
}

TEST(ExplainListing, BoundsWhatOneDamagedMessageTakes) {
  std::string text = head(5) + "ERROR ID : 611\n** X\nDESCRIPTION :\n";
  for (int i = 1; i <= 1000; ++i)
    text += fmt::format("   -- NODE ID : {}\n   -- INTERFACE ID : {}\n", i, i);
  const ListingReport report = explain_listing(*read_listing_text("a.out", text));
  ASSERT_EQ(report.messages.size(), 1u);
  ASSERT_EQ(report.messages[0].places.size(), 1u) << "not a thousand, each with a thousand nodes";
  EXPECT_EQ(report.messages[0].places[0].name, "interface 1 and 999 more");
}

TEST(ExplainListing, NeedsNoDeck) {
  const Listing listing = read(listing_of_plates());
  const ListingReport report = explain_listing(listing);
  ASSERT_EQ(report.messages.size(), 2u);
  EXPECT_FALSE(report.messages[0].title.empty());
  const std::string text = listing_text(listing, report, nullptr);
  EXPECT_NE(text.find("warning 343: initial penetrations of an interface (1 time)"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("Time steps"), std::string::npos);
}

}  // namespace
}  // namespace deck
