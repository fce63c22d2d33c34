// Whole listings of the reference Starter held against their decks: every penetration and every
// time step that it prints. Skipped where the listings are absent.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "deck/text.hpp"
#include "golden/reference.hpp"
#include "lint/shared/topics.hpp"
#include "report/shared/inspection.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;

/// The deck that a listing is of.
fs::path deck_of(const std::string& name) {
  const std::string file = name + "_0000.rad";
  for (const fs::path& folder :
       {test::source_dir() / "samples", test::corpus() / "corpus" / "qa" / name,
        test::corpus() / "corpus" / name, test::corpus() / "corpus" / "synthetic",
        test::corpus() / "findings" / "user"})
    if (fs::exists(folder / file)) return folder / file;
  return {};
}

class Listings : public testing::TestWithParam<const char*> {};

TEST_P(Listings, HavePenetrationsAndStepsOfTheirDeck) {
  const std::string name = GetParam();
  const fs::path path = test::corpus() / "oracle" / "listings" / (name + "_0000.out.gz");
  const fs::path deck = deck_of(name);
  if (!fs::exists(path) || deck.empty()) GTEST_SKIP() << "no listing or deck of " << name;
  const auto listing = read_listing(path.string(), {});
  ASSERT_TRUE(listing.ok());
  ASSERT_FALSE(listing->messages.empty());
  for (const ListedMessage& m : listing->messages)
    EXPECT_FALSE(summary_of_message(m.number).title.empty()) << m.number;
  auto loaded = load(deck.string());
  ASSERT_TRUE(loaded.ok());
  const ListingReport report = compare_listing(*listing, *loaded);
  EXPECT_EQ(report.unnamed_contacts, 0u);
  for (const ComparedContact& c : report.contacts) {
    EXPECT_TRUE(c.agrees()) << "interface " << loaded->scene().contacts[c.contact].inter->id << ": "
                            << c.listed_count << " listed, " << c.pairs.size() << " computed";
    EXPECT_LT(c.largest_difference, 1e-9);
  }
  for (const ComparedSteps& s : report.steps) EXPECT_TRUE(s.different.empty());
}

INSTANTIATE_TEST_SUITE_P(Golden, Listings,
                         testing::Values("crash_box", "inacti_variants", "two_surfaces",
                                         "solid_and_skin", "synf", "BOXBEAM", "CRA2AV4",
                                         "SEAT_ADYREL", "kinematics", "tied10"),
                         [](const auto& tested) { return std::string(tested.param); });

/// Text of a record; empty: it is not there.
std::string record(const fs::path& below) {
  const auto source = Source::open_text((test::corpus() / "oracle" / below).string(), {});
  return source ? std::string((*source)->bytes()) : std::string();
}

/// The numbers of the column "id" in the tables of messages of a specification (they have a column
/// "sev..."), and of headings that are one.
void add_numbers(const std::string& text, std::set<int>& out) {
  constexpr std::size_t none = 1000;
  std::size_t column = none;  // of the ids
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## "))
      if (const int number = std::atoi(line.c_str() + 3); number > 99) out.insert(number);
    std::vector<std::string> cells;
    std::istringstream parts(line.starts_with('|') ? line.substr(1) : "");
    for (std::string cell; std::getline(parts, cell, '|');) cells.push_back(cell);
    const auto id = std::find(cells.begin(), cells.end(), " id ");
    if (cells.empty()) {
      column = none;
    } else if (id != cells.end() && line.find("| sev") != line.npos) {
      column = static_cast<std::size_t>(id - cells.begin());
    } else if (column < cells.size()) {
      const std::regex digits("[0-9]+");
      const std::string& cell = cells[column];
      for (std::sregex_iterator n(cell.begin(), cell.end(), digits); n != std::sregex_iterator();
           ++n)
        out.insert(std::stoi(n->str()));
    }
  }
}

TEST(Messages, OfAllRecordsHaveAPage) {
  using nlohmann::json;
  std::set<int> numbers;
  if (const std::string text = record("published/messages.json"); !text.empty()) {
    const json published = json::parse(text);
    for (const auto& [name, deck] : published.items())
      if (deck.contains("messages"))
        for (const json& message : deck["messages"]) numbers.insert(message[1].get<int>());
  }
  for (const char* set : {"verdicts/verdicts.json.gz", "verdicts2/verdicts.json.gz"}) {
    const std::string text = record(set);
    if (text.empty()) continue;
    const json verdicts = json::parse(text);
    for (const json& mutant : verdicts["mutants"])
      for (const char* kind : {"errors", "warnings"})
        for (const auto& [number, times] : mutant[kind].items()) numbers.insert(std::stoi(number));
  }
  for (const char* name : {"format", "kinematics", "messages", "modern_contacts",
                           "starter_geometry", "tied", "time_step"})
    add_numbers(record(fs::path("..") / "spec" / (std::string(name) + ".md")), numbers);
  if (numbers.empty()) GTEST_SKIP() << "no records";
  EXPECT_GT(numbers.size(), 100u);
  for (const int number : numbers)
    EXPECT_FALSE(explain_message(number, SchemaSet::built_in(), 0).empty()) << number;
}

}  // namespace
}  // namespace deck
