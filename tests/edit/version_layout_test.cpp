// Conversion between input versions of every keyword whose layout is known: random cells have the
// same values afterwards, read with the columns of the target version, or the conversion says no.
#include <gmock/gmock.h>

#include <random>
#include <set>

#include "deck/edit/convert.hpp"
#include "deck/keyword/decode.hpp"
#include "edit/version_support.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;

constexpr int versions[] = {100,  110,  120,  130,  140,  2017, 2018, 2019,
                            2020, 2021, 2022, 2023, 2024, 2025, 2026};

/// Blocks with random cells, line by line as the conditions of the schema ask for.
class RandomBlock {
 public:
  RandomBlock(const Schema& schema, int version, std::uint32_t seed)
      : schema_(schema), version_(version), random_(seed) {
    for (const CardSchema& card : schema.cards) {
      note(card.when);
      for (const Field& f : card.fields) note(f.when);
      counts_.insert(card.count);
    }
  }

  std::string text() {
    std::string out = schema_.keyword + (schema_.has_id ? "/7\n" : "\n");
    if (schema_.has_title) out += "random\n";
    const auto& cards = schema_.cards;
    for (std::size_t i = 0; i < cards.size(); ++i) {
      std::size_t members = 1;
      while (cards[i].repeat == Repeat::group && i + members < cards.size() &&
             cards[i + members].repeat == Repeat::group &&
             cards[i + members].count == cards[i].count)
        ++members;
      if (cards[i].repeat == Repeat::ids) {
        out += list(cards[i]);
        continue;
      }
      const int rounds = cards[i].repeat == Repeat::once ? 1
                         : cards[i].count.empty()        ? below(3)
                                                         : count(cards[i].count);
      for (int round = 0; round < rounds; ++round)
        for (std::size_t m = i; m < i + members; ++m) out += line(cards[m]);
      i += members - 1;
    }
    return out;
  }

 private:
  void note(const std::vector<Condition>& when) {
    for (const Condition& c : when) {
      auto& seen = tested_[c.field];
      seen.insert(c.in.begin(), c.in.end());
      seen.insert(c.not_in.begin(), c.not_in.end());
      if (c.min) seen.insert({*c.min, *c.min - 1});
      if (c.max) seen.insert({*c.max, *c.max + 1});
    }
  }
  bool holds(const std::vector<Condition>& when) {
    return std::all_of(when.begin(), when.end(), [&](const Condition& c) {
      return c.field != Condition::data_lines && c.holds(values_[c.field]);
    });
  }
  int count(const std::string& name) {
    if (name.find_first_not_of("0123456789") == std::string::npos) return std::stoi(name);
    return static_cast<int>(values_[name]);
  }
  std::vector<const Field*> fields(const CardSchema& card) {
    std::vector<const Field*> out;
    if (!card.in_version(version_) || !holds(card.when)) return out;
    for (const bool conditional : {false, true})
      for (const Field& f : card.fields) {
        if (!f.in_version(version_) || f.when.empty() == conditional || !holds(f.when)) continue;
        out.push_back(&f);
        texts_[&f] = text_of(f);
      }
    return out;
  }
  std::string line(const CardSchema& card) {
    const auto cells = fields(card);
    const bool any = std::any_of(card.fields.begin(), card.fields.end(),
                                 [&](const Field& f) { return f.in_version(version_); });
    if (!card.in_version(version_) || !holds(card.when) || (any && cells.empty())) return {};
    std::string out;
    for (const Field* f : cells) put(out, f->first, f->last, texts_[f]);
    return out + "\n";
  }
  std::string list(const CardSchema& card) {
    if (!card.in_version(version_) || !holds(card.when)) return {};
    const Field& f = card.fields.back();
    const int width = f.last - f.first + 1;
    const int total = card.count.empty() ? 1 + below(12) : count(card.count);
    const int per_line = card.count.empty() ? (101 - f.first) / width : card.per_line;
    std::string out, row;
    for (int k = 0; k < total; ++k) {
      const int first = f.first + k % per_line * width;
      put(row, first, first + width - 1, card.words ? "DEF" : text_of(f));
      if (k % per_line == per_line - 1 || k + 1 == total) {
        out += row + "\n";
        row.clear();
      }
    }
    return out;
  }
  static void put(std::string& out, int first, int last, const std::string& cell) {
    if (cell.empty()) return;
    if (out.size() < static_cast<std::size_t>(last))
      out.resize(static_cast<std::size_t>(last), ' ');
    const std::size_t at = static_cast<std::size_t>(last) - cell.size();
    ASSERT_GE(at + 1, static_cast<std::size_t>(first));
    out.replace(at, cell.size(), cell);
  }
  std::string text_of(const Field& f) {
    const auto tested = tested_.find(f.name);
    if (f.type == FieldType::text) return below(2) == 0 ? "" : "ab";
    if (f.type == FieldType::flag) {
      values_[f.name] = below(2);
      return std::to_string(values_[f.name]);
    }
    if (f.type == FieldType::real) {
      static const char* const texts[] = {"", "5.25", "1.25-3", "3.D2", "7e-4"};
      return texts[below(5)];
    }
    std::int64_t value = below(3) == 0 ? 0 : 5 + below(40);
    if (counts_.count(f.name) > 0)
      value = below(4);
    else if (tested != tested_.end() && below(4) > 0)
      value = *std::next(tested->second.begin(), below(static_cast<int>(tested->second.size())));
    values_[f.name] = value;
    return value == 0 ? "" : std::to_string(value);
  }
  int below(int n) { return std::uniform_int_distribution<>(0, n - 1)(random_); }

  const Schema& schema_;
  int version_;
  std::mt19937 random_;
  std::map<std::string, std::set<std::int64_t>> tested_;
  std::set<std::string> counts_;
  std::map<std::string, std::int64_t> values_;
  std::map<const Field*, std::string> texts_;
};

bool is_zero(const Cell& cell) {
  if (cell.field->type == FieldType::text) return cell.text.empty();
  return cell.field->type == FieldType::real ? cell.real == 0 : cell.integer == 0;
}

/// name, round, place in a list -> text of every cell that is not 0. What is ignored does not
/// count.
std::map<std::string, std::string> values(const Deck& deck, const Block& block) {
  std::map<std::string, std::string> out;
  const DecodedBlock decoded = decode(deck, block);
  std::map<std::string, int> places;
  for (const DecodedCard& card : decoded.cards)
    for (const Cell& cell : card.cells) {
      std::string key = cell.field->name == "Rthe" ? "Kthe" : cell.field->name;
      if (card.schema->repeat == Repeat::ids)
        key += " " + std::to_string(places[key]++);
      else if (card.round > 0)
        key += " round " + std::to_string(card.round);
      if (!is_zero(cell) && !cell.field->ignored) out[key] = std::string(cell.text);
    }
  std::string lines;
  for (const DecodedCard& card : decoded.cards)
    lines += card.schema->name + ": " + std::string(card.line.text) + "\n";
  EXPECT_TRUE(decoded.extra.empty()) << block.header << "\n" << lines;
  return out;
}

struct Tally {
  int converted = 0, refused = 0;
};

/// One random block of a keyword from one version to another and back.
void check(const Schema& schema, int from, int to, std::uint32_t seed, Tally& tally) {
  const std::string text = deck_of_version(from, RandomBlock(schema, from, seed).text());
  const auto before = open_text(text);
  const Rewrite there = to_version(before->context(), to);
  if (!there.refusals.empty()) {
    ++tally.refused;
    EXPECT_FALSE(losses_of(there, Loss::dropped).empty() &&
                 losses_of(there, Loss::undecided).empty())
        << joined(there.refusals);
    return;
  }
  ++tally.converted;
  const auto after = applied(*before, there);
  ASSERT_EQ(after->deck.blocks.size(), before->deck.blocks.size()) << text;
  const auto old_values = values(before->deck, before->deck.blocks[1]);
  EXPECT_EQ(difference(old_values, values(after->deck, after->deck.blocks[1])), "")
      << schema.keyword << " " << from << " -> " << to << "\n"
      << text << "\n"
      << bytes_of(*after);
  const Rewrite back = to_version(after->context(), from);
  // Two forms that their number of lines tells apart.
  if (joined(back.refusals).find("number of lines") != std::string::npos) return;
  ASSERT_TRUE(back.refusals.empty()) << schema.keyword << " " << from << " -> " << to << "\n"
                                     << text << bytes_of(*after) << joined(back.refusals);
  const auto again = applied(*after, back);
  EXPECT_EQ(difference(old_values, values(again->deck, again->deck.blocks[1])), "")
      << schema.keyword << " " << from << " -> " << to << " -> " << from << "\n"
      << text << "\n"
      << bytes_of(*after) << "\n"
      << bytes_of(*again);
}

std::vector<const Schema*> full_layouts() {
  std::vector<const Schema*> out;
  for (const Schema* s : SchemaSet::built_in().all())
    if (s->full_layout && !s->cards.empty()) out.push_back(s);
  return out;
}

TEST(VersionLayoutProperty, EveryKnownKeywordKeepsItsValuesThereAndBack) {
  std::mt19937 random(20260215);
  const auto any = [&] { return versions[random() % std::size(versions)]; };
  const auto schemas = full_layouts();
  EXPECT_GE(schemas.size(), 90u);
  Tally tally;
  for (const Schema* schema : schemas)
    for (int round = 0; round < 12; ++round) {
      const int from = any(), to = std::max(any(), 110);
      if (from < 110) continue;  // there is no way back
      check(*schema, from, to, static_cast<std::uint32_t>(random()), tally);
      if (::testing::Test::HasFailure()) return;
    }
  EXPECT_GE(tally.converted, 600);
  EXPECT_LE(tally.refused, tally.converted);
}

// ---- what changed physics without a word ----------------------------------------------------

std::string convert(const std::string& text, int version, std::size_t refusals = 0) {
  const auto before = open_text(text);
  const Rewrite r = to_version(before->context(), version);
  EXPECT_EQ(r.refusals.size(), refusals) << joined(r.refusals);
  return refusals == 0 ? bytes_of(*applied(*before, r)) : joined(r.refusals);
}

TEST(VersionLayout, FlagsOfSolidsDoNotBecomeTheLimitsThatTookTheirColumns) {
  const std::string head = "/PROP/SOLID/1\np\n        17\n\n                 0.5";
  const std::string text = deck_of_version(2022, head + "         2         1\n");
  EXPECT_THAT(convert(text, 2026, 1), HasSubstr("Ihkt = 1 would be lost"));
  EXPECT_EQ(convert(deck_of_version(2022, head + "\n"), 2026), deck_of_version(2026, head + "\n"));
}

TEST(VersionLayout, DefaultsOfSolidsInUnusedColumnsStayWithoutEffect) {
  const std::string text = deck_of_version(2017, "/DEF_SOLID\n        17         2         1\n");
  EXPECT_EQ(convert(text, 2026), deck_of_version(2026, "/DEF_SOLID\n        17         2\n"));
}

TEST(VersionLayout, ThePolynomialLinesThatAVersionLostAreNotReadAsOthers) {
  const std::string lines =
      "/MAT/HYDPLA/1\nm\n              7.8E-6\n                 210                  .3\n\n"
      "                 0.0                 175\n                -1.0\n\n";
  EXPECT_THAT(convert(deck_of_version(2017, lines), 2026, 1), HasSubstr("C1 = 175 would be lost"));
}

TEST(VersionLayout, AFactorMovesToItsNewColumns) {
  const std::string text = deck_of_version(
      110, "/FAIL/TAB/1\n         1         1         0" + std::string(46, ' ') + "0.5\n");
  const std::string after = convert(text, 2026);
  const auto there = open_text(after);
  EXPECT_EQ(decode(there->deck, there->deck.blocks[1]).real("P_thickfail"), 0.5);
  EXPECT_THAT(after, HasSubstr("         0" + std::string(27, ' ') + "0.5\n"));
}

TEST(VersionLayout, CardsStayBelowTheirOwnComments) {
  const std::string text = deck_of_version(
      110, "/FAIL/TAB/1\n#CARD1\n         1         1         1\n#CARD2\n" + std::string(17, ' ') +
               "1.1" + std::string(17, ' ') + "0.2" + std::string(17, ' ') +
               "3.0\n#CARD3\n         5" + std::string(17, ' ') + "1.0\n");
  const std::string after = convert(text, 2026);
  EXPECT_THAT(after, HasSubstr("#CARD2\n" + std::string(17, ' ') + "1.1")) << after;
  EXPECT_THAT(after, HasSubstr("#CARD3\n         5")) << after;
}

TEST(VersionLayout, WhatIsRemovedIsListedAsDropped) {
  const auto before = open_text(deck_of_version(
      110, "/FAIL/TAB/1\n         1         1         0" + std::string(17, ' ') + "0.4\n"));
  const Rewrite rewrite = to_version(before->context(), 2026);
  const auto dropped = losses_of(rewrite, Loss::dropped);
  ASSERT_EQ(dropped.size(), 1u);
  EXPECT_EQ(dropped[0].old_text, "0.4");
  EXPECT_TRUE(dropped[0].without_effect);
  for (const LossEntry& e : losses_of(rewrite, Loss::kept)) EXPECT_NE(e.old_text, "0.4");
}

}  // namespace
}  // namespace deck::test
