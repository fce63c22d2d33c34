// A listing beside its deck in JSON and in words, from a comparison that is written out here.
#include <gmock/gmock.h>

#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "model/shared/mesh.hpp"
#include "report/inspected.hpp"
#include "report/shared/listing.hpp"

namespace deck::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

struct Listed {
  Listed() {
    listing.path = "a_0000.out";
    listing.printout = 5;
    listing.errors = 2;
    listing.warnings = 3;
    listed.interface = 1;
    listed.type = 7;
    listed.line = 71;
    listed.total_line = 72;
    const Span header = deck.scene.interfaces->ordered[0]->span;
    Diagnostic d;
    d.rule = all_rules()[0].id;
    d.severity = Severity::warning;
    d.message = "a finding";
    d.reference = ReferenceMessage{343, Severity::error};
    d.span = header;
    report.findings = {d, d};
    report.findings[1].span = {};
    report.findings[1].message = "another";
    MessagePlace place;
    place.name = "interface 1 'example'";
    place.id = 1;
    place.span = header;
    place.times = 4;
    place.counted = {5, 6};
    place.nodes = {51, 52};
    place.lines = {61, 62, 63, 64, 65, 66};
    place.findings = {0};
    MessagePlace nameless;
    nameless.lines = {67};
    nameless.counted = {8};
    nameless.nodes = {53};
    report.messages = {
        {343, Severity::error, 7, "a title", "a meaning", "an action", {place, nameless}, {1}},
        {99, Severity::info, 1, "", "", "", {}, {}},
        {5, Severity::warning, 2, "w", "", "", {}, {}}};
    ComparedContact c;
    c.contact = 0;
    c.listed = &listed;
    c.listed_count = 9;
    c.by_pair = true;
    c.largest_difference = 0.0625;
    for (const NamedPenetration& p : deck.view.penetrations) c.pairs.push_back({p, false, {}});
    c.pairs[0].listed = true;
    c.pairs[0].listed_depth = 0.125;
    c.pairs[1].listed = true;
    c.only_listed = {{{81, 0}, {1, 2, 3, 3}, false, 0.375}, {{82, 83}, {1, 2, 0, 0}, false, {}}};
    report.contacts = {c};
    ComparedSteps steps;
    steps.kind = ElementKind::shell3;
    steps.listed = 11;
    steps.equal = 12;
    steps.not_computed = 13;
    steps.smallest = 0.5;
    steps.smallest_id = 14;
    steps.largest_difference = 0.25;
    steps.different = {{15, 0.75, 0.875}, {16, 1e30, NAN}};
    ComparedSteps of_nodes;
    of_nodes.smallest = 1e30;
    report.steps = {steps, of_nodes};
    report.not_listed = {1};
    report.unnamed_contacts = 17;
  }
  Json json() const { return Json::parse(listing_json(listing, report, &deck.loaded)); }
  std::string text(bool verbose = false, std::size_t worst = 3) const {
    ListingTextOptions options;
    options.verbose = verbose;
    options.worst = worst;
    return listing_text(listing, report, &deck.loaded, options);
  }
  std::string where() const {
    return deck.deck.sources.where(deck.scene.interfaces->ordered[0]->span);
  }
  Inspected deck{plates()};
  Listing listing;
  ListedContact listed;
  ListingReport report;
};

TEST(ListingDocument, HasEveryFigure) {
  const Listed l;
  Json all = l.json();
  EXPECT_EQ(all["schema"], Json({{"id", "deck/explain"}, {"version", 1}}));
  EXPECT_EQ(all["deck"]["path"], "test_0000.rad");
  for (const char* head : {"schema", "tool", "deck"}) all.erase(head);
  const Position at = l.deck.deck.sources.position(l.report.findings[0].span);
  const Json place = {{"file", "test_0000.rad"}, {"line", at.line}, {"column", at.column}};
  const auto finding = [&](const char* message, const Json& where) {
    return Json({{"rule", std::string(id_text(all_rules()[0].id))},
                 {"severity", "warning"},
                 {"message", message},
                 {"reference", {{"message", 343}, {"severity", "error"}}},
                 {"place", where}});
  };
  Json pairs = Json::array();
  for (const ComparedPair& p : l.report.contacts[0].pairs) {
    const PenetrationRow& row = l.deck.scene.contacts[0].penetrations[p.pair.row];
    pairs.push_back({{"secondary", Json::array({p.pair.secondary[0]})},
                     {"main", {1, 2, 3, 4}},
                     {"parts", {2, 1}},
                     {"penetration", row.depth},
                     {"gap", row.gap},
                     {"action", to_string(row.action)},
                     {"listed", p.listed},
                     {"listed_penetration", p.listed_depth ? Json(*p.listed_depth) : Json()}});
  }
  ASSERT_EQ(pairs.size(), 4u);
  const Json expected = {
      {"listing", {{"path", "a_0000.out"}, {"printout", 5}, {"errors", 2}, {"warnings", 3}}},
      {"agrees", false},
      {"messages",
       {{{"message", 343},
         {"severity", "error"},
         {"times", 7},
         {"title", "a title"},
         {"means", "a meaning"},
         {"do", "an action"},
         {"places",
          {{{"name", "interface 1 'example'"},
            {"id", 1},
            {"times", 4},
            {"says", {5, 6}},
            {"place", place},
            {"nodes", {51, 52}},
            {"lines", {61, 62, 63, 64, 65, 66}},
            {"findings", Json::array({finding("a finding", place)})}},
           {{"name", ""},
            {"id", 0},
            {"times", 0},
            {"says", Json::array({8})},
            {"place", nullptr},
            {"nodes", Json::array({53})},
            {"lines", Json::array({67})},
            {"findings", Json::array()}}}},
         {"findings", Json::array({finding("another", nullptr)})}},
        {{"message", 99},
         {"severity", "info"},
         {"times", 1},
         {"title", ""},
         {"means", ""},
         {"do", ""},
         {"places", Json::array()},
         {"findings", Json::array()}},
        {{"message", 5},
         {"severity", "warning"},
         {"times", 2},
         {"title", "w"},
         {"means", ""},
         {"do", ""},
         {"places", Json::array()},
         {"findings", Json::array()}}}},
      {"contacts",
       Json::array(
           {{{"interface", 1},
             {"type", 7},
             {"role", "primary"},
             {"agrees", false},
             {"listed", 9},
             {"computed", 4},
             {"by_pair", true},
             {"largest_difference", 0.0625},
             {"lines", {71, 72}},
             {"pairs", pairs},
             {"listed_only",
              {{{"secondary", Json::array({81})},
                {"main", {1, 2, 3, 3}},
                {"listed_penetration", 0.375}},
               {{"secondary", {82, 83}}, {"main", {1, 2}}, {"listed_penetration", nullptr}}}}}})},
      {"contacts_of_listing_only", 17},
      {"steps",
       {{{"of", "shell3"},
         {"listed", 11},
         {"equal", 12},
         {"not_computed", 13},
         {"largest_difference", 0.25},
         {"smallest", 0.5},
         {"smallest_id", 14},
         {"different",
          {{{"id", 15}, {"listed", 0.75}, {"computed", 0.875}},
           {{"id", 16}, {"listed", nullptr}, {"computed", nullptr}}}}},
        {{"of", "node"},
         {"listed", 0},
         {"equal", 0},
         {"not_computed", 0},
         {"largest_difference", 0.0},
         {"smallest", nullptr},
         {"smallest_id", 0},
         {"different", Json::array()}}}},
      {"not_listed", Json::array({finding("another", nullptr)})}};
  for (const auto& [name, value] : expected.items()) EXPECT_EQ(all.at(name), value) << name;
  EXPECT_EQ(all.size(), expected.size());
}

TEST(ListingDocument, OfWhatIsNotListedSaysSo) {
  Listed l;
  l.listing.errors.reset();
  l.listed.total_line = 0;
  l.report.contacts[0].by_pair = false;
  Json all = l.json();
  EXPECT_EQ(all["listing"]["errors"], Json());
  EXPECT_EQ(all["contacts"][0]["lines"], Json::array({71}));
  EXPECT_EQ(all["contacts"][0]["pairs"][0]["listed"], Json());
  l.report.contacts[0].listed = nullptr;
  all = l.json();
  EXPECT_EQ(all["contacts"][0]["listed"], Json());
  EXPECT_EQ(all["contacts"][0]["lines"], Json::array());
}

TEST(ListingTexts, SayHowTheStarterEnded) {
  Listed l;
  EXPECT_TRUE(
      l.text().starts_with("a_0000.out beside test_0000.rad\nThe Starter stops: 7 errors and 2 "
                           "warnings. The Starter works in two passes"))
      << l.text();
  l.listing.errors = 0;
  EXPECT_THAT(l.text(), HasSubstr("\nThe Starter finished: 7 errors and 2 warnings. "));
  l.listing.errors.reset();
  EXPECT_THAT(l.text(),
              HasSubstr("\nThe listing has no end: the Starter was stopped. Up to there: 7 "
                        "errors and 2 warnings.\n"));
  EXPECT_THAT(l.text(), Not(HasSubstr("do not belong together")));
  l.report.contacts[0].listed = nullptr;
  EXPECT_THAT(l.text(),
              HasSubstr("\nNo contact of this listing is in the deck: the two do not belong "
                        "together.\n"));
  l.report.unnamed_contacts = 0;
  EXPECT_THAT(l.text(), Not(HasSubstr("do not belong together")));
}

TEST(ListingTexts, ExplainMessagesWithTheirPlaces) {
  Listed l;
  const std::string rule = finding_name(l.report.findings[0]);
  EXPECT_THAT(
      l.text(),
      HasSubstr("\nerror 343: a title (7 times)\n  a meaning\n  What to do: an action\n"
                "  interface 1 'example', " +
                l.where() +
                "\n"
                "    lines 61, 62, 63, 64 and 2 more of the listing; numbers in the message: 5, 6; "
                "nodes 51, 52\n"
                "    deck: " +
                l.where() + ": " + rule +
                " warning: a finding\n"
                "    line 67 of the listing; number in the message: 8; node 53\n"
                "  deck: " +
                rule +
                " warning: another\n"
                "\ninfo 99: no page tells what it means (1 time)\n"
                "  deck lint has no finding for this message.\n"
                "\nwarning 5: w (2 times)\n"
                "  deck lint has no finding for this message.\n"));
  MessageGroup& group = l.report.messages[0];
  group.number = 1164;
  EXPECT_THAT(l.text(), HasSubstr("in the message: 5, 6\n")) << "its nodes are those of the pairs";
  group.places.assign(12, group.places[1]);
  group.findings.assign(5, 1);
  const std::string many = l.text();
  EXPECT_THAT(many, HasSubstr("\n  2 more places: -v\n"));
  const auto count_of = [](const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (auto at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count_of(many, "    line 67 of"), 10u);
  EXPECT_EQ(count_of(many, "  deck: " + rule + " warning: another\n"), 3u);
  const std::string all = l.text(true);
  EXPECT_EQ(count_of(all, "    line 67 of"), 12u);
  EXPECT_EQ(count_of(all, "  deck: " + rule + " warning: another\n"), 5u);
  EXPECT_THAT(all, Not(HasSubstr("more places")));
}

TEST(ListingTexts, CompareContactsPairByPair) {
  Listed l;
  EXPECT_THAT(
      l.text(),
      ContainsRegex("\n +interface +type +listing +deck +pairs +line\n +1 +TYPE7 +9 +4 +2 the "
                    "same, 2 of deck only, 2 listed only; depths within 0\\.062 of the gap "
                    "+72\n  17 contacts of the listing have no counterpart in the deck\n"));
  EXPECT_THAT(l.text(), Not(HasSubstr("shows numbers only")));
  ComparedContact& c = l.report.contacts[0];
  c.only_listed.clear();
  for (ComparedPair& p : c.pairs) {
    p.listed = true;
    p.listed_depth.reset();
  }
  l.listed.total_line = 0;
  l.report.unnamed_contacts = 1;
  l.listing.printout = 0;
  EXPECT_THAT(l.text(),
              ContainsRegex("\n +1 +TYPE7 +9 +4 +4 the same +71\n  1 contact of the listing "
                            "has no counterpart in the deck\n  The listing shows numbers only"));
  c.by_pair = false;
  EXPECT_THAT(l.text(), ContainsRegex("\n +1 +TYPE7 +9 +4 +another number +71\n"));
  c.listed_count = 4;
  EXPECT_THAT(l.text(), ContainsRegex("\n +1 +TYPE7 +4 +4 +same number +71\n"));
  c.listed = nullptr;
  EXPECT_THAT(l.text(), ContainsRegex("\n +1 +TYPE7 +absent +4\n"));
  c.pairs.clear();
  c.listed_count = 0;
  EXPECT_THAT(l.text(), HasSubstr("\n  none in the deck\n"));
  l.report.unnamed_contacts = 0;
  EXPECT_THAT(l.text(), HasSubstr("\n  none in either\n"));
}

TEST(ListingTexts, ListTheDeepestPairsAndThoseOfTheListingOnly) {
  Listed l;
  const std::string rows = l.text(false, 2);
  EXPECT_THAT(
      rows, HasSubstr("\nDeepest pairs of each contact (all: deck gaps test_0000.rad --csv -)\n"));
  EXPECT_THAT(rows, ContainsRegex("\n +1 +5 +1 2 3 4 +2 on 1 +0\\.1 +0\\.5 +0\\.125 +nothing\n"
                                  " +1 +6 +1 2 3 4 +2 on 1 +0\\.1 +0\\.5 +yes +nothing\n"
                                  " +1 +81 +1 2 3 +0\\.375 +only there\n"
                                  " +1 +82 83 +1 2 +only there\n"));
  EXPECT_THAT(l.text(false, 1), Not(HasSubstr("82 83")));
  EXPECT_THAT(l.text(false, 4),
              ContainsRegex("\n +1 +8 +1 2 3 4 +2 on 1 +0\\.1 +0\\.5 +no +nothing\n"));
  // What deck alone has is shown with -v whatever the bound.
  EXPECT_THAT(l.text(true, 1), ContainsRegex("\n +1 +5 .*\n +1 +7 .* no +nothing\n +1 +8 .* no "
                                             "+nothing\n +1 +81 .*\n +1 +82 83"));
  EXPECT_THAT(l.text(true, 1), Not(ContainsRegex("\n +1 +6 +1 2 3 4"))) << "it is listed";
  EXPECT_THAT(l.text(true, 2), ContainsRegex("\n +1 +6 +1 2 3 4"));
  l.report.contacts[0].by_pair = false;
  EXPECT_THAT(l.text(), HasSubstr("not shown"));
  EXPECT_THAT(l.text(true, 1), Not(ContainsRegex("\n +1 +7 +1 2 3 4"))) << "no pairs are listed";
}

TEST(ListingTexts, CompareTimeSteps) {
  Listed l;
  EXPECT_THAT(l.text(),
              HasSubstr("\nTime steps in the listing and of deck parts (equal: within 1e-06)\n"));
  EXPECT_THAT(l.text(),
              ContainsRegex("\n +shell3 +11 +12 +2 +13 +0\\.5 +14\n +node +0 +0 +0 +0 +none\n"
                            "  shell3 15: 0\\.75 in the listing, 0\\.875 in deck\n"
                            "  shell3 16: 1e\\+30 in the listing, absent in the deck\n"));
  EXPECT_THAT(l.text(false, 1), Not(HasSubstr("shell3 16")));
  EXPECT_THAT(l.text(true, 1), HasSubstr("shell3 16"));
  l.report.steps.clear();
  EXPECT_THAT(l.text(), Not(HasSubstr("Time steps")));
}

TEST(ListingTexts, NameWhatTheListingDoesNotHave) {
  Listed l;
  const std::string rule = finding_name(l.report.findings[0]);
  const std::string title = "\nExpected by deck, and not in the listing\n";
  EXPECT_THAT(l.text(), HasSubstr(title + "  error 343: " + rule + " another\n"));
  l.report.not_listed.assign(12, 0);
  EXPECT_THAT(l.text(),
              HasSubstr("  error 343: " + l.where() + ": " + rule + " a finding\n  2 more: -v\n"));
  EXPECT_THAT(l.text(true), Not(HasSubstr("2 more: -v")));
  l.report.not_listed.clear();
  EXPECT_THAT(l.text(), Not(HasSubstr(title)));
}

TEST(ListingTexts, SayWhichPairsAreTies) {
  Plates p;
  p.card = "Gapmin=0.1\n@/INTER/TYPE10/3 grnd_IDs=2 surf_IDm=1 Gap=0.5";
  const Inspected tied(plates(p));
  Listing listing;
  ListingReport report;
  MessagePlace place;
  place.id = 3;
  place.name = "interface 3";
  place.lines = {1};
  report.messages = {{343, Severity::warning, 1, "t", "", "", {place}, {}}};
  const std::string said = "These pairs are tied at the start. They are not penetrations.";
  EXPECT_THAT(listing_text(listing, report, &tied.loaded), HasSubstr("\n    " + said + "\n"));
  EXPECT_THAT(listing_text(listing, report, nullptr), Not(HasSubstr(said)));
  report.messages[0].number = 1164;
  EXPECT_THAT(listing_text(listing, report, &tied.loaded), HasSubstr(said));
  report.messages[0].number = 344;
  EXPECT_THAT(listing_text(listing, report, &tied.loaded), Not(HasSubstr(said)));
  report.messages[0].number = 343;
  report.messages[0].places[0].id = 1;
  EXPECT_THAT(listing_text(listing, report, &tied.loaded), Not(HasSubstr(said)));
}

// ---- the comparison -------------------------------------------------------------------------

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
  EXPECT_FALSE(report.messages[2].places[1].span.valid()) << "the deck has no interface 9";
  const MessagePlace& node = report.messages[0].places.at(0);
  EXPECT_EQ(node.id, 5);
  EXPECT_TRUE(node.span.valid());
  EXPECT_EQ(report.messages[1].places.at(0).id, 0) << "of several nodes it is about none alone";
  EXPECT_FALSE(report.messages[1].places.at(0).span.valid());
}

}  // namespace
}  // namespace deck::test
