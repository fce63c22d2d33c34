// Tests of edits that are joined or refused.
#include "deck/edit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "deck/keyword.hpp"
#include "deck/rule_id.hpp"
#include "deck/text.hpp"
#include "edit/version_support.hpp"
#include "keyword/reading.hpp"
#include "text/shared/edits.hpp"

namespace deck {
namespace {

using namespace testing_support;

/// An edit meant for what one include holds would change the others with it.
TEST(ApplyEditsOfADeck, NeedAllCopiesOfAFileToAgree) {
  SourceSet sources;
  sources.add(Source::from_bytes("main", "M"));
  for (int copy = 0; copy < 2; ++copy) sources.add(Source::from_bytes("part", "abc"));
  const TextEdit first{Span{1, 1, 0}, "X"}, second{Span{2, 1, 0}, "X"}, other{Span{2, 1, 0}, "Y"};
  const auto same = apply_edits(sources, {first, second});
  ASSERT_TRUE(same.ok()) << same.error().message;
  EXPECT_EQ(same->size(), 1u);
  EXPECT_EQ(same->at("part"), "Xbc");
  for (const auto& edits : {std::vector{first, other}, {first}, {second}}) {
    const auto refused = apply_edits(sources, edits);
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().message.find("part"), std::string::npos);
  }
  // Replaced by what stands there: nothing changes anywhere.
  const Span whole{1, 0, 1};
  EXPECT_TRUE(apply_edits(sources, {{whole, std::string(sources.text(whole))}})->empty());
}

TEST(Overlay, ThatIncludesItselfIsReportedAsACycle) {
  const std::map<std::string, std::string> overlay = {{"a.inc", "#include a.inc\n"},
                                                      {"m_0000.rad", deck_of("#include a.inc\n")}};
  ReadOptions options;
  options.overlay = &overlay;
  const auto deck = read_deck("m_0000.rad", SchemaSet::built_in(), options);
  ASSERT_TRUE(deck.ok());
  EXPECT_EQ(count(deck->diagnostics, RuleId::DK005), 1u);
}

/// A random cell of a contact block and a random value for it that fits.
struct SingleEdit {
  std::string field, text;
  std::size_t block = 0, card = 0, cell = 0;
  Span line;
  int first = 0, last = 0;
};

std::vector<SingleEdit> every_numeric_cell(const Deck& deck) {
  std::vector<SingleEdit> all;
  for (std::size_t b = 0; b < deck.blocks.size(); ++b) {
    const Block& block = deck.blocks[b];
    if (block.schema == nullptr || !block.schema->keyword.starts_with("/INTER/")) continue;
    const DecodedBlock decoded = decode(deck, block);
    for (std::size_t c = 0; c < decoded.cards.size(); ++c) {
      const DecodedCard& card = decoded.cards[c];
      if (card.missing() || card.free_format) continue;
      for (std::size_t k = 0; k < card.cells.size(); ++k) {
        const Cell& cell = card.cells[k];
        if (cell.field->type == FieldType::text || cell.field->type == FieldType::flag) continue;
        all.push_back({cell.field->name, "", b, c, k, card.line.whole(), cell.field->first,
                       cell.field->last});
      }
    }
  }
  return all;
}

bool decides_layout(const Deck& deck, const SingleEdit& e) {
  for (const CardSchema& card : deck.blocks[e.block].schema->cards)
    for (const Condition& condition : card.when)
      if (condition.field == e.field) return true;
  return false;
}

TEST(SingleFieldEdit, ChangesOnlyItsColumnsAndReadsBackTheSame) {
  std::mt19937_64 random(42);
  int edits = 0;
  for (const std::string& path : test::sample_decks()) {
    const auto deck = read_deck(path, SchemaSet::built_in());
    ASSERT_TRUE(deck.ok());
    const auto cells = every_numeric_cell(*deck);
    if (cells.empty()) continue;
    for (int round = 0; round < 60; ++round) {
      SingleEdit e = cells[random() % cells.size()];
      if (decides_layout(*deck, e)) continue;
      const DecodedBlock before = decode(*deck, deck->blocks[e.block]);
      const Field& field = *before.cards[e.card].cells[e.cell].field;
      const int width = e.last - e.first + 1;
      const double real = std::ldexp(static_cast<double>(random() % 100000) - 5e4,
                                     static_cast<int>(random() % 60) - 30);
      const auto integer = static_cast<std::int64_t>(random() % 10000);
      const bool is_real = field.type == FieldType::real;
      e.text = is_real ? format_real(real, width)->text : *format_integer(integer, width);
      CellWriter edit(deck->sources);
      edit.set(e.line, e.first, e.last, e.text);
      const auto changed = apply_edits(deck->sources, edit.finish());
      ASSERT_TRUE(changed.ok()) << changed.error().message;
      ReadOptions options;
      options.overlay = &*changed;
      const auto again = read_deck(path, SchemaSet::built_in(), options);
      ASSERT_TRUE(again.ok());
      const DecodedBlock after = decode(*again, again->blocks[e.block]);
      const Cell& cell = after.cards[e.card].cells[e.cell];
      if (is_real)
        EXPECT_EQ(cell.real, read_real(e.text).value) << path << " " << e.field;
      else
        EXPECT_EQ(cell.integer, integer) << path << " " << e.field;
      for (const auto& [file, text] : *changed) {
        const std::string old(deck->sources[e.line.file].bytes());
        ASSERT_EQ(file, deck->sources[e.line.file].path());
        // Up to the cell, and behind the line, nothing moved.
        const std::uint64_t begin = e.line.offset + static_cast<std::uint64_t>(e.first - 1);
        const std::uint64_t keep = std::min<std::uint64_t>(begin, e.line.offset + e.line.length);
        EXPECT_EQ(text.substr(0, keep), old.substr(0, keep));
        const std::uint64_t old_end = std::min<std::uint64_t>(
            e.line.offset + static_cast<std::uint64_t>(e.last), old.find('\n', e.line.offset));
        const std::string rest = old.substr(old_end);
        EXPECT_EQ(text.substr(text.size() - rest.size()), rest);
      }
      ++edits;
    }
  }
  EXPECT_GT(edits, 300);
}

}  // namespace
}  // namespace deck
