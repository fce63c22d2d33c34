// A listing of the Starter held against its deck: pairs, places, time steps, messages.

#include <cctype>

#include "deck/rule_id.hpp"
#include "model/shared/mesh.hpp"
#include "report/inspected.hpp"
#include "report/shared/inspection.hpp"

namespace deck::test {
namespace {

Listing listing_with(const std::vector<ListedPair>& pairs, int printout = 5) {
  Listing out;
  out.printout = printout;
  ListedContact c;
  c.interface = 1;
  c.type = 7;
  c.pairs = pairs;
  out.contacts = {c};
  return out;
}

TEST(CompareListings, PairsMatchInAnyOrderOfNodesEachOnce) {
  Inspected d(plates());
  Listing listing = listing_with({{{5, 0}, {4, 3, 2, 1}, false, 0.15},
                                  {{6, 0}, {2, 3, 4, 1}, false, 0.05},
                                  {{6, 0}, {1, 2, 3, 4}, false, {}},
                                  {{7, 0}, {1, 2, 3, 3}, false, {}},
                                  {{8, 0}, {0, 0, 0, 0}, true, {}}});
  const ListingReport report = compare_listing(listing, d.loaded);
  const ComparedContact& c = report.contacts.at(0);
  EXPECT_EQ(c.listed_count, 4u) << "one of five shows no segment";
  EXPECT_TRUE(c.by_pair);
  std::vector<std::int64_t> listed;
  for (const ComparedPair& p : c.pairs)
    if (p.listed) listed.push_back(p.pair.secondary[0]);
  EXPECT_EQ(listed, (std::vector<std::int64_t>{5, 6}));
  ASSERT_EQ(c.only_listed.size(), 2u);
  EXPECT_EQ(c.only_listed[0].secondary[0], 6);
  EXPECT_EQ(c.only_listed[1].secondary[0], 7);
  // 0.15 and 0.05 instead of 0.1, over a gap of 0.5.
  EXPECT_NEAR(c.largest_difference, 0.1, 1e-12);
  EXPECT_FALSE(c.agrees());
}

TEST(CompareListings, FromLevelSixOnOnlyWhatHasADepthPenetrates) {
  Inspected d(plates());
  const std::vector<ListedPair> pairs{{{5, 0}, {1, 2, 3, 4}, false, 0.1},
                                      {{6, 0}, {1, 2, 3, 4}, false, {}},
                                      {{7, 0}, {1, 2, 3, 4}, true, {}}};
  for (const auto& [level, count] : {std::pair(5, 3u), std::pair(6, 2u)}) {
    Listing listing = listing_with(pairs, level);
    EXPECT_EQ(compare_listing(listing, d.loaded).contacts.at(0).listed_count, count) << level;
  }
  Listing silent = listing_with({}, 5);
  EXPECT_TRUE(compare_listing(silent, d.loaded).contacts.at(0).by_pair)
      << "none is shown, none is there";
  silent.contacts[0].total = 4;
  const ListingReport counted = compare_listing(silent, d.loaded);
  EXPECT_FALSE(counted.contacts.at(0).by_pair);
  EXPECT_EQ(counted.contacts.at(0).listed_count, 4u);
  EXPECT_TRUE(counted.contacts.at(0).agrees());
  Listing quiet = listing_with(pairs, 0);
  EXPECT_FALSE(compare_listing(quiet, d.loaded).contacts.at(0).by_pair);
}

TEST(CompareListings, PlacesAreTheHeadersOfWhatIsNamed) {
  Inspected d(plates(
      {.before =
           "/FUNCT/3\nf\n                 0.0                 1.0\n"
           "                 1.0                 2.0\n/FUNCT_SMOOTH/13\nf\n"
           "                 0.0                 1.0\n/SENSOR/TIME/4\ns\n                 5.0\n"
           "/SKEW/FIX/5\ns\n\n\n/RBODY/6\nr\n         1\n/RWALL/PLANE/7\nw\n"
           "/MONVOL/PRES/8\nm\n/SECT/9\ns\n/RBE2/10\nr\n/RBE3/11\nr"}));
  const std::tuple<const char*, std::int64_t, const char*> named[] = {
      {"FUNCTION", 3, "/FUNCT/3"},
      {"FUNCTION", 13, "/FUNCT_SMOOTH/13"},
      {"SENSOR", 4, "/SENSOR/TIME/4"},
      {"SKEW", 5, "/SKEW/FIX/5"},
      {"RIGID BODY", 6, "/RBODY/6"},
      {"RIGID WALL", 7, "/RWALL/PLANE/7"},
      {"SECTION", 9, "/SECT/9"},
      {"RBE2", 10, "/RBE2/10"},
      {"RBE3", 11, "/RBE3/11"},
      {"PART", 2, "/PART/2"},
      {"MATERIAL", 1, "/MAT/ELAST/1"},
      {"MAIN SURFACE", 1, "/SURF/PART/1"},
      {"NODE GROUP", 2, "/GRNOD/PART/2"},
      {"INTERFACE", 1, "/INTER/TYPE7/1"},
      {"MONITORED VOLUME", 8, "/MONVOL/PRES/8"},
      {"MONITORED VOLUME", 7, ""},
      {"GAUGE", 3, ""},
      {"SURFACES", 1, ""}};
  Listing listing;
  for (const auto& [kind, id, header] : named) {
    ListedMessage m;
    m.number = 5;
    m.severity = Severity::error;
    m.ids = {{kind, id, ""}};
    listing.messages.push_back(m);
  }
  const ListingReport report = compare_listing(listing, d.loaded);
  ASSERT_EQ(report.messages.size(), 1u);
  ASSERT_EQ(report.messages[0].places.size(), std::size(named));
  for (std::size_t i = 0; i < std::size(named); ++i) {
    const auto& [kind, id, header] = named[i];
    const MessagePlace& place = report.messages[0].places[i];
    std::string words = kind;
    for (char& c : words) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    EXPECT_EQ(place.name, words + " " + std::to_string(id));
    EXPECT_EQ(place.id, id);
    EXPECT_EQ(place.span.valid() ? d.deck.sources.text(place.span) : "", header) << kind;
  }
}

TEST(CompareListings, StepsAreEqualWithinAMillionth) {
  Inspected d(plates());
  const std::vector<double>& dt = d.loaded.mesh().of(ElementKind::shell4).dt;
  Listing listing;
  listing.element_steps[ElementKind::shell4] = {{2, dt[1] * (1 + 9e-7)}, {1, dt[0] * (1 + 1.1e-6)}};
  listing.node_steps = {{5, 0.5}, {6, 0.25}, {7, 0.25}};
  const ListingReport report = compare_listing(listing, d.loaded);
  ASSERT_EQ(report.steps.size(), 2u);
  const ComparedSteps& shells = report.steps[0];
  EXPECT_EQ(shells.kind, ElementKind::shell4);
  EXPECT_EQ(shells.listed, 2u);
  EXPECT_EQ(shells.equal, 1u);
  EXPECT_EQ(shells.smallest_id, dt[0] < dt[1] ? 1 : 2);
  EXPECT_NEAR(shells.largest_difference, 9e-7, 1e-9);
  ASSERT_EQ(shells.different.size(), 1u);
  EXPECT_EQ(shells.different[0].id, 1);
  EXPECT_EQ(report.steps[1].kind, std::nullopt);
  EXPECT_EQ(report.steps[1].smallest, 0.25);
  EXPECT_EQ(report.steps[1].smallest_id, 6) << "the first of equal ones";
}

TEST(CompareListings, MessagesAreGatheredByWhatTheyName) {
  Inspected d(plates());
  Listing listing;
  const auto message = [](int number, Severity severity, std::size_t line,
                          std::vector<ListedId> ids, std::vector<std::int64_t> nodes,
                          std::optional<std::uint64_t> count = {}) {
    ListedMessage m;
    m.number = number;
    m.severity = severity;
    m.line = line;
    m.ids = std::move(ids);
    m.nodes = std::move(nodes);
    m.count = count;
    return m;
  };
  listing.messages = {message(343, Severity::warning, 10, {{"INTERFACE", 1, "example"}}, {}, 4),
                      message(612, Severity::error, 20, {}, {5}),
                      message(343, Severity::warning, 30, {{"INTERFACE", 1, "example"}}, {6, 6}, 4),
                      message(343, Severity::warning, 40, {{"INTERFACE", 9, "gone"}}, {}, 2),
                      message(343, Severity::warning, 50, {{"INTERFACE", 1, "example"}}, {7}, 3),
                      message(12, Severity::warning, 60, {}, {5, 6})};
  const ListingReport report = compare_listing(listing, d.loaded);
  ASSERT_EQ(report.messages.size(), 3u);
  EXPECT_EQ(report.messages[0].number, 612) << "errors first";
  EXPECT_EQ(report.messages[1].number, 12);
  EXPECT_EQ(report.messages[2].number, 343);
  EXPECT_EQ(report.messages[2].times, 4u);
  ASSERT_EQ(report.messages[2].places.size(), 2u);
  const MessagePlace& first = report.messages[2].places[0];
  EXPECT_EQ(first.id, 1);
  EXPECT_EQ(first.times, 3u);
  EXPECT_EQ(first.counted, (std::vector<std::uint64_t>{4, 3}));
  EXPECT_EQ(first.nodes, (std::vector<std::int64_t>{6, 7}));
  EXPECT_EQ(first.lines, (std::vector<std::size_t>{10, 30, 50}));
  EXPECT_EQ(first.span.offset, d.scene.interfaces->ordered[0]->span.offset);
  ASSERT_FALSE(first.findings.empty());
  EXPECT_EQ(report.findings[first.findings[0]].rule, RuleId::DK301);
  EXPECT_FALSE(report.messages[2].places[1].span.valid()) << "the deck has no interface 9";
  const MessagePlace& node = report.messages[0].places.at(0);
  EXPECT_EQ(node.id, 5);
  EXPECT_TRUE(node.span.valid());
  EXPECT_EQ(report.messages[1].places.at(0).id, 0) << "of several nodes it is about none alone";
  EXPECT_FALSE(report.messages[1].places.at(0).span.valid());
}

TEST(CompareListings, NameFindingsThatTheListingDoesNotHave) {
  Inspected d(plates());
  const Listing listing;
  const ListingReport report = compare_listing(listing, d.loaded);
  EXPECT_TRUE(std::any_of(report.not_listed.begin(), report.not_listed.end(),
                          [&](std::size_t f) { return report.findings[f].rule == RuleId::DK301; }));
}

TEST(ExplainListing, BoundsWhatOneDamagedMessageTakes) {
  std::string text = "CONTROL  PARAMETERS\nERROR ID : 611\n** X\nDESCRIPTION :\n";
  for (int i = 1; i <= 1000; ++i)
    text += fmt::format("   -- NODE ID : {}\n   -- INTERFACE ID : {}\n", i, i);
  const Listing listing = *read_listing_text("a.out", text);
  const ListingReport report = explain_listing(listing);
  ASSERT_EQ(report.messages.size(), 1u);
  ASSERT_EQ(report.messages[0].places.size(), 1u) << "not a thousand, each with a thousand nodes";
  EXPECT_EQ(report.messages[0].places[0].name, "interface 1 and 999 more");
}

}  // namespace
}  // namespace deck::test
