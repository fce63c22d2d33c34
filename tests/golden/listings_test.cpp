// Whole listings of the reference Starter held against their decks: every penetration and every
// time step that it prints. Skipped where the listings are absent.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
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

/// The numbers of the column "id" in the tables of a specification, and of headings that are one.
void add_numbers(const std::string& text, std::set<int>& out) {
  int column = -1;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    if (line.starts_with("## ")) {
      if (const int number = std::atoi(line.c_str() + 3); number > 99) out.insert(number);
      continue;
    }
    if (!line.starts_with('|')) {
      column = -1;
      continue;
    }
    std::vector<std::string> cells;
    std::stringstream parts(line.substr(1));
    for (std::string cell; std::getline(parts, cell, '|');) cells.push_back(cell);
    if (column < 0) {
      const auto id = std::find(cells.begin(), cells.end(), " id ");
      const bool messages = std::any_of(cells.begin(), cells.end(), [](const std::string& cell) {
        return cell.starts_with(" sev");  // a table of messages has a severity
      });
      column = id == cells.end() || !messages ? 1000 : static_cast<int>(id - cells.begin());
      continue;
    }
    if (column >= static_cast<int>(cells.size())) continue;
    const std::string& cell = cells[static_cast<std::size_t>(column)];
    for (std::size_t i = 0; i < cell.size();) {
      if (std::isdigit(static_cast<unsigned char>(cell[i])) == 0) {
        ++i;
        continue;
      }
      std::size_t stop = i;
      while (stop < cell.size() && std::isdigit(static_cast<unsigned char>(cell[stop])) != 0)
        ++stop;
      out.insert(std::stoi(cell.substr(i, stop - i)));
      i = stop;
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
