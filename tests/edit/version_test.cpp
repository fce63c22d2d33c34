// Conversion between input versions: cells keep their values, nothing is lost without a word. Of
// every keyword whose layout is known random cells have the same values afterwards, read with the
// columns of the target version, or the conversion says no.
#include <gmock/gmock.h>

#include <random>
#include <set>

#include "deck/edit.hpp"
#include "deck/keyword.hpp"
#include "edit/support.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;

std::string after(const std::string& text, int version, const VersionOptions& options = {}) {
  const auto before = open_text(text);
  const Rewrite r = to_version(before->context(), version, options);
  EXPECT_TRUE(r.refusals.empty()) << joined(r.refusals);
  return before->after(r)->main_text();
}

Rewrite rewrite_of(const std::string& text, int version, const VersionOptions& options = {}) {
  const auto before = open_text(text);
  return to_version(before->context(), version, options);
}

TEST(ToVersion, FrictionLineOfType11ComesBehindItsLastLineAndCommentsStay) {
  const std::string text = deck_of_version(2017,
                                           "/INTER/TYPE11/1\nedges\n# ids\n         1         2\n"
                                           "# bounds\n\n# stfac\n                 1.0\n# inacti\n"
                                           "                                       6\n# last\n");
  EXPECT_EQ(after(text, 2018),
            deck_of_version(2018,
                            "/INTER/TYPE11/1\nedges\n# ids\n         1         2\n# bounds\n\n"
                            "# stfac\n                 1.0\n# inacti\n"
                            "                                       6\n\n# last\n"));
}

TEST(ToVersion, CarriageReturnsAreKeptOnNewLines) {
  std::string text;
  for (const char c :
       deck_of_version(2017, card("/INTER/TYPE11", 1, 2017, {{"line_IDs", "1"}, {"Fric", "0.1"}})))
    text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const std::string converted = after(text, 2024);
  EXPECT_EQ(std::count(converted.begin(), converted.end(), '\n'),
            std::count(converted.begin(), converted.end(), '\r'));
  EXPECT_EQ(after(converted, 2017), text);
}

TEST(ToVersion, HeatLineMovesBehindTheAdaptiveLineFromVersion110On) {
  const std::string text = deck_of_version(100, card("/INTER/TYPE7", 1, 100,
                                                     {{"grnd_IDs", "1"},
                                                      {"surf_IDm", "2"},
                                                      {"Ithe", "1"},
                                                      {"Iadm", "2"},
                                                      {"NRadm", "5"},
                                                      {"Padm", "0.5"},
                                                      {"Rthe", "12.0"},
                                                      {"Tint", "300.0"}}));
  const auto deck = open_text(after(text, 130));
  const DecodedBlock block = decode(deck->deck, *deck->interfaces.ordered.at(0)->block);
  EXPECT_EQ(block.integer("NRadm"), 5);
  EXPECT_EQ(block.real("Padm"), 0.5);
  EXPECT_EQ(block.real("Kthe"), 12);
  EXPECT_EQ(block.real("Tint"), 300);
  EXPECT_TRUE(block.extra.empty());
  EXPECT_FALSE(block.cards.back().missing());
}

TEST(ToVersion, ValueThatIsTheDefaultGoesWithoutLoss) {
  const std::pair<std::string, int> decks[] = {
      {card("/INTER/TYPE7", 4, 2020,
            {{"surf_IDm", "1"},
             {"Irem_gap", "1"},
             {"Irem_i2", "3"},
             {"AscaleF", "1.0"},
             {"ITIED", "0"}}),
       110},
      {card("/SKEW/MOV", 1, 2020, {{"N1", "1"}, {"N2", "2"}, {"N3", "3"}, {"Dir", "X"}}), 2018},
      {card("/INTER/TYPE19", 1, 2020, {{"surf_IDs", "1"}, {"Igap", "4"}, {"Irem_gap", "0"}}),
       2018}};
  for (const auto& [text, version] : decks) {
    const Rewrite r = rewrite_of(deck_of_version(2020, text), version);
    EXPECT_TRUE(r.refusals.empty()) << joined(r.refusals);
    EXPECT_TRUE(losses_of(r, Loss::dropped).empty());
  }
}

TEST(ToVersion, BuiltInValueOnTheCardIsALossWhereADefaultCardWouldTakeItsPlace) {
  // Irem_gap 1 is the built-in default, but without its cell the default card's 2 comes into force.
  const std::string text = deck_of_version(
      140, card("/DEFAULT/INTER/TYPE7", 0, 140, {{"Irem_gap", "2"}}) +
               card("/INTER/TYPE7", 1, 140, {{"surf_IDm", "1"}, {"Irem_gap", "1"}}));
  const Rewrite r = rewrite_of(text, 110);
  ASSERT_EQ(r.refusals.size(), 1u) << joined(r.refusals);
  EXPECT_THAT(r.refusals[0], HasSubstr("Irem_gap = 1"));
}

TEST(ToVersion, TextInBlankColumnsDoesNotBecomeAValue) {
  // The third line of version 110 ends at column 60; from 120 on dtmin follows.
  const std::string text = deck_of_version(
      110, "/INTER/TYPE7/1\nt\n         0         1\n\n" + std::string(76, ' ') + " 0.7\n\n\n\n");
  const auto before = open_text(text);
  const Rewrite r = to_version(before->context(), 120);
  EXPECT_TRUE(r.refusals.empty());
  const auto then = before->after(r);
  EXPECT_EQ(then->interfaces.type7.at(0).dtmin.value, 0);
  const auto dropped = losses_of(r, Loss::dropped);
  ASSERT_EQ(dropped.size(), 1u);
  EXPECT_EQ(dropped[0].field, "dtmin");
  EXPECT_EQ(dropped[0].old_text, "0.7");
}

TEST(ToVersion, FreeFormatGetsNewColumnsAndKeepsParameters) {
  const auto before = open_text(
      deck_of_version(110,
                      "/PARAMETER/GLOBAL/REAL/1\ngap\ngap                      0.75\n"
                      "/INTER/TYPE7/1\nfree\n 1,2,4,0,1,4,0,0,0,0\n1.5,3.0\n,,0.3\n1.,0.1,&gap\n"
                      "       110\n\n"));
  const auto then = before->after(to_version(before->context(), 2024));
  EXPECT_EQ(difference(effective_values(*before), effective_values(*then)), "");
  EXPECT_EQ(then->interfaces.type7.at(0).Igap.value, 1);
  EXPECT_EQ(then->interfaces.type7.at(0).Ibag.input, 0);
  EXPECT_EQ(then->interfaces.type7.at(0).Gapmin.value, 0.75);
  EXPECT_TRUE(then->contains("&gap"));
}

TEST(ToVersion, AFlagThatNoSolverReadsIsDroppedWithoutARefusal) {
  const std::string head = "/PROP/SHELL/1\np\n        24\n\n         3";
  const Rewrite r = rewrite_of(deck_of_version(2022, head + "         1\n"), 2026);
  EXPECT_TRUE(r.refusals.empty()) << joined(r.refusals);
  const auto dropped = losses_of(r, Loss::dropped);
  ASSERT_EQ(dropped.size(), 1u);
  EXPECT_EQ(dropped[0].field, "Istrain");
}

TEST(ToVersion, SubmodelsWithTheirOwnVersionAreConvertedFromIt) {
  const std::string inner =
      "/BEGIN\nsub\n       110         0\n"
      "                  kg                  mm                  ms\n"
      "                  kg                  mm                  ms\n" +
      card("/INTER/TYPE11", 2, 110, {{"line_IDs", "1"}, {"Fric", "0.25"}});
  const std::string text = deck_of_version(
      2020, card("/INTER/TYPE11", 1, 2020, {{"line_IDs", "1"}, {"Irem_gap", "2"}}) +
                "//SUBMODEL/1\n\n       100\n" + inner + "//ENDSUB\n" +
                card("/INTER/TYPE11", 3, 2020, {{"line_IDs", "1"}, {"Irem_gap", "2"}}));
  const auto before = open_text(text);
  ASSERT_EQ(before->interfaces.type11.at(2).block->version, 110);
  const auto then = before->after(to_version(before->context(), 2024));
  EXPECT_EQ(difference(effective_values(*before), effective_values(*then)), "");
  for (const Block& b : then->deck.blocks) EXPECT_EQ(b.version, 2024) << b.header;
  EXPECT_TRUE(decode(then->deck, *then->interfaces.type11.at(2).block).extra.empty());
}

TEST(ToVersion, NumberWithoutVersionIsReadAsTheNewest) {
  const std::string text =
      deck_of_version(2512, card("/INTER/TYPE11", 1, 2026, {{"line_IDs", "1"}}));
  const auto before = open_text(text);
  const Rewrite r = to_version(before->context(), 2026);
  EXPECT_TRUE(r.refusals.empty());
  EXPECT_EQ(before->after(r)->deck.begin.version_written, 2026);
}

TEST(ToVersion, UnknownTargetsAndOldDecksAreRefused) {
  EXPECT_FALSE(rewrite_of(deck_of_version(2022, ""), 2027).refusals.empty());
  EXPECT_FALSE(rewrite_of(deck_of_version(2022, ""), 100).refusals.empty());
  EXPECT_FALSE(rewrite_of(deck_of_version(90, "/PART/1\np\n         1\n"), 2022).refusals.empty());
  EXPECT_FALSE(rewrite_of("#RADIOSS STARTER\n/PART/1\np\n/END\n", 2022).refusals.empty());
}

TEST(ToVersion, KeywordsOfWhichNotEveryColumnIsKnownAreUndecidedByNameAndCount) {
  const Rewrite r =
      rewrite_of(deck_of_version(2022, "/FXBODY/1\na\n/FXBODY/2\nb\n/ANIM/DT\n 0.0 1.0\n"), 2024);
  ASSERT_EQ(r.refusals.size(), 1u) << joined(r.refusals);
  EXPECT_THAT(r.refusals[0], HasSubstr("/FXBODY: has columns"));
  EXPECT_THAT(r.refusals[0], HasSubstr("its 2 blocks"));
}

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
      return c.field != Condition::data_lines && c.accepts(values_[c.field]);
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

/// name, round, place in a list -> text of every cell that is neither 0 nor ignored.
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
  const auto after = before->after(there);
  ASSERT_EQ(after->deck.blocks.size(), before->deck.blocks.size()) << text;
  const auto old_values = values(before->deck, before->deck.blocks[1]);
  EXPECT_EQ(difference(old_values, values(after->deck, after->deck.blocks[1])), "")
      << schema.keyword << " " << from << " -> " << to << "\n"
      << text << "\n"
      << after->main_text();
  const Rewrite back = to_version(after->context(), from);
  // Two forms that their number of lines tells apart.
  if (joined(back.refusals).find("number of lines") != std::string::npos) return;
  ASSERT_TRUE(back.refusals.empty()) << schema.keyword << " " << from << " -> " << to << "\n"
                                     << text << after->main_text() << joined(back.refusals);
  const auto again = after->after(back);
  EXPECT_EQ(difference(old_values, values(again->deck, again->deck.blocks[1])), "")
      << schema.keyword << " " << from << " -> " << to << " -> " << from << "\n"
      << text << "\n"
      << after->main_text() << "\n"
      << again->main_text();
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

std::string random_blocks(std::mt19937& random, int version, int oldest,
                          const std::vector<const char*>& keywords) {
  std::string out;
  for (const char* keyword : keywords) {
    const Schema& schema = *SchemaSet::built_in().find(keyword);
    if (schema.from <= oldest && random() % 3 == 0)
      out += RandomBlock(schema, version, static_cast<std::uint32_t>(random())).text();
  }
  return deck_of_version(version, out);
}

TEST(VersionLayoutProperty, ContactsKeepValuesUpAndBytesThereAndBack) {
  std::mt19937 random(20260101);
  int converted = 0, whole = 0;
  for (int round = 0; round < 200; ++round) {
    const int a = versions[1 + random() % 14], b = versions[1 + random() % 14];
    const int from = std::min(a, b), to = std::max(a, b);
    const std::string text = random_blocks(
        random, from, from,
        {"/DEFAULT/INTER/TYPE7", "/DEFAULT/INTER/TYPE11", "/DEFAULT/INTER/TYPE19",
         "/DEFAULT/INTER/TYPE2", "/DEFAULT/INTER/TYPE24", "/DEFAULT/INTER/TYPE25", "/INTER/TYPE2",
         "/INTER/TYPE24", "/INTER/TYPE25", "/INTER/TYPE7", "/INTER/TYPE10", "/INTER/TYPE11",
         "/INTER/TYPE19", "/INTER/LAGDT/TYPE7", "/FRICTION", "/SENSOR/TIME", "/PART"});
    const auto before = open_text(text);
    const Rewrite up = to_version(before->context(), to);
    if (!up.refusals.empty()) continue;
    ++converted;
    const auto there = before->after(up);
    EXPECT_EQ(difference(effective_values(*before, true), effective_values(*there, true)), "");
    const Rewrite down = to_version(there->context(), from);
    ASSERT_TRUE(down.refusals.empty()) << joined(down.refusals);
    // Cells that no solver reads are dropped, with a word.
    if (losses_of(up, Loss::dropped).empty() && losses_of(down, Loss::dropped).empty()) {
      EXPECT_EQ(there->after(down)->main_text(), text) << from << " -> " << to;
      ++whole;
    }
    if (HasFailure()) return;
  }
  EXPECT_GE(converted, 100);
  EXPECT_GE(whole, 50);
}

TEST(VersionLayoutProperty, ContactsLoseDownwardsOnlyWhatIsReported) {
  std::mt19937 random(7);
  int converted = 0;
  for (int round = 0; round < 200; ++round) {
    const int a = versions[1 + random() % 14], b = versions[1 + random() % 14];
    const int from = std::max(a, b), to = std::min(a, b);
    // A type that the lower version does not have is refused, and is no loss.
    const auto before = open_text(random_blocks(
        random, from, to,
        {"/DEFAULT/INTER/TYPE7", "/DEFAULT/INTER/TYPE11", "/INTER/TYPE7", "/INTER/TYPE10",
         "/INTER/TYPE11", "/INTER/TYPE19", "/INTER/TYPE2", "/INTER/TYPE24", "/INTER/TYPE25"}));
    const Rewrite down = to_version(before->context(), to, {.allow_loss = true});
    if (!down.refusals.empty()) continue;
    const auto old_values = effective_values(*before),
               new_values = effective_values(*before->after(down));
    std::set<std::string> lost;
    bool default_lost = false;
    for (const LossEntry& l : losses_of(down, Loss::dropped)) {
      lost.insert(l.keyword + "/" + std::to_string(l.id) + " ");
      default_lost = default_lost || l.keyword.starts_with("/DEFAULT");
    }
    if (default_lost) continue;
    ++converted;
    // What follows from a lost value may change with it.
    for (const auto& [name, value] : old_values)
      if (!lost.contains(name.substr(0, name.find(' ') + 1))) {
        EXPECT_EQ(new_values.at(name), value) << from << " -> " << to << " " << name << "\n"
                                              << before->main_text();
      }
    if (HasFailure()) return;
  }
  EXPECT_GE(converted, 70);
}

}  // namespace
}  // namespace deck::test
