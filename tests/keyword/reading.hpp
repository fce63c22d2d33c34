// Helpers of the reading tests: decks in memory and on disk, look-up of findings.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "deck/keyword.hpp"
#include "deck/rule_id.hpp"
#include "folder.hpp"

namespace deck::testing_support {

inline const std::string banner = "#RADIOSS STARTER\n";

/// /BEGIN with kg mm ms as both unit systems.
inline std::string begin(const std::string& version = "2024") {
  const std::string units = "                  kg                  mm                  ms\n";
  return "/BEGIN\nrun\n" + std::string(10 - version.size(), ' ') + version + "         0\n" +
         units + units;
}

/// A whole deck around `body`.
inline std::string deck_of(const std::string& body, const std::string& version = "2024") {
  return banner + begin(version) + body + "/END\n";
}

inline Deck read(const std::string& text, const ReadOptions& options = {},
                 const SchemaSet& schemas = SchemaSet::built_in()) {
  auto deck = read_deck_text("test_0000.rad", text, schemas, options);
  EXPECT_TRUE(deck.ok()) << (deck.ok() ? "" : deck.error().message);
  return deck.ok() ? std::move(*deck) : Deck();
}

inline std::uint64_t count(const Findings& findings, RuleId rule) {
  const auto it = findings.counts().find(rule);
  return it == findings.counts().end() ? 0 : it->second;
}

inline const Finding* first(const Findings& findings, RuleId rule) {
  for (const Finding& d : findings.all())
    if (d.rule == rule) return &d;
  return nullptr;
}

inline const Block* block(const Deck& deck, std::string_view header) {
  for (const Block& b : deck.blocks)
    if (b.header == header) return &b;
  return nullptr;
}

/// All data lines of a block, one string each.
inline std::vector<std::string> lines(const Deck& deck, const Block& b) {
  std::vector<std::string> all;
  LineCursor cursor(deck.sources, b);
  for (Line line = cursor.next(); line.valid(); line = cursor.next()) all.emplace_back(line.text);
  return all;
}

/// A directory that lives as long as the test.
class Folder : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) {
    return folder_.write(name, text);
  }
  Deck read_file(const std::string& path, const ReadOptions& options = {}) {
    auto deck = read_deck(path, SchemaSet::built_in(), options);
    EXPECT_TRUE(deck.ok()) << (deck.ok() ? "" : deck.error().message);
    return deck.ok() ? std::move(*deck) : Deck();
  }
  test::Folder folder_;
  const std::filesystem::path dir_ = folder_.path();
};

}  // namespace deck::testing_support
