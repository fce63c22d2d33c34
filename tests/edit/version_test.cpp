// Conversion between input versions: cells keep their values, nothing is lost without a word.
#include "deck/edit/convert.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <random>

#include "deck/keyword/decode.hpp"
#include "edit/version_support.hpp"
#include "where.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;

constexpr int versions[] = {110,  120,  130,  140,  2017, 2018, 2019,
                            2020, 2021, 2022, 2023, 2024, 2025, 2026};

std::string after(const std::string& text, int version, const VersionOptions& options = {}) {
  const auto before = open_text(text);
  const Rewrite r = to_version(before->context(), version, options);
  EXPECT_TRUE(r.refusals.empty()) << joined(r.refusals);
  return bytes_of(*applied(*before, r));
}

Rewrite rewrite_of(const std::string& text, int version, const VersionOptions& options = {}) {
  const auto before = open_text(text);
  return to_version(before->context(), version, options);
}

TEST(ToVersion, SameVersionChangesNothing) {
  const std::string text =
      deck_of_version(2018, card("/INTER/TYPE11", 1, 2018, {{"line_IDs", "1"}, {"Istf", "4"}}));
  EXPECT_EQ(after(text, 2018), text);
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
  const std::string text = deck_of_version(2020, card("/INTER/TYPE7", 4, 2020,
                                                      {{"surf_IDm", "1"},
                                                       {"Irem_gap", "1"},
                                                       {"Irem_i2", "3"},
                                                       {"AscaleF", "1.0"},
                                                       {"ITIED", "0"}}));
  const Rewrite r = rewrite_of(text, 110);
  EXPECT_TRUE(r.refusals.empty()) << joined(r.refusals);
  EXPECT_TRUE(losses_of(r, Loss::dropped).empty());
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

TEST(ToVersion, DefaultCardOfType19GainsItsRemovalLine) {
  const std::string text =
      deck_of_version(2018, card("/DEFAULT/INTER/TYPE19", 0, 2018,
                                 {{"Istf", "4"}, {"Iedge", "1"}, {"Inacti", "6"}, {"Iform", "2"}}) +
                                card("/INTER/TYPE19", 1, 2018, {{"surf_IDm", "1"}}));
  const auto before = open_text(text);
  const auto up = applied(*before, to_version(before->context(), 2024));
  EXPECT_EQ(difference(effective_values(*before, true), effective_values(*up, true)), "");
  EXPECT_EQ(up->interfaces.type19.at(0).Inacti.value, 6);
  EXPECT_EQ(up->interfaces.type19.at(0).Iform.value, 2);
  EXPECT_EQ(after(bytes_of(*up), 2018), text);
}

TEST(ToVersion, TextInBlankColumnsDoesNotBecomeAValue) {
  // The third line of version 110 ends at column 60; from 120 on dtmin follows.
  const std::string text = deck_of_version(
      110, "/INTER/TYPE7/1\nt\n         0         1\n\n" + std::string(76, ' ') + " 0.7\n\n\n\n");
  const auto before = open_text(text);
  const Rewrite r = to_version(before->context(), 120);
  EXPECT_TRUE(r.refusals.empty());
  const auto then = applied(*before, r);
  EXPECT_EQ(then->interfaces.type7.at(0).dtmin.value, 0);
  const auto dropped = losses_of(r, Loss::dropped);
  ASSERT_EQ(dropped.size(), 1u);
  EXPECT_EQ(dropped[0].field, "dtmin");
  EXPECT_EQ(dropped[0].old_text, "0.7");
}

TEST(ToVersion, FreeFormatLinesGetTheNewColumns) {
  const std::string text =
      deck_of_version(110,
                      "/INTER/TYPE7/1\nfree\n 1,2,4,0,1,4,0,0,0,0\n1.5,3.0\n,,0.3\n1.,0.1,0.5\n"
                      "       110\n\n");
  const auto before = open_text(text);
  const auto then = applied(*before, to_version(before->context(), 2024));
  EXPECT_EQ(difference(effective_values(*before), effective_values(*then)), "");
  EXPECT_EQ(then->interfaces.type7.at(0).Igap.value, 1);
  EXPECT_EQ(then->interfaces.type7.at(0).Ibag.input, 0);
}

TEST(ToVersion, ParameterReferencesStayReferences) {
  const std::string text = deck_of_version(
      100, "/PARAMETER/GLOBAL/REAL/1\ngap\ngap                      0.75\n" +
               card("/INTER/TYPE11", 1, 100, {{"line_IDs", "1"}, {"Gapmin", "&gap"}}));
  const std::string then = after(text, 2024);
  EXPECT_THAT(then, HasSubstr("&gap"));
  EXPECT_EQ(open_text(then)->interfaces.type11.at(0).Gapmin.value, 0.75);
}

TEST(ToVersion, TextThatMeantNothingDoesNotBecomeACell) {
  const std::string head = "/PROP/SHELL/1\np\n        24\n\n         3";
  const std::string text =
      deck_of_version(2022, head + std::string(80, ' ') + "         2\n");  // Ipos from 2024 on
  const Rewrite r = rewrite_of(text, 2024);
  EXPECT_TRUE(r.refusals.empty()) << joined(r.refusals);
  const auto there = applied(*open_text(text), r);
  EXPECT_EQ(decode(there->deck, there->deck.blocks[1]).integer("Ipos"), 0);
  EXPECT_EQ(decode(there->deck, there->deck.blocks[1]).integer("N"), 3);
  EXPECT_EQ(losses_of(r, Loss::kept).size(), 2u);  // the version, the block
  EXPECT_EQ(losses_of(r, Loss::dropped).size(), 1u);
}

TEST(ToVersion, AFlagThatNoSolverReadsIsDroppedWithoutARefusal) {
  const std::string head = "/PROP/SHELL/1\np\n        24\n\n         3";
  const Rewrite r = rewrite_of(deck_of_version(2022, head + "         1\n"), 2026);
  EXPECT_TRUE(r.refusals.empty()) << joined(r.refusals);
  const auto dropped = losses_of(r, Loss::dropped);
  ASSERT_EQ(dropped.size(), 1u);
  EXPECT_EQ(dropped[0].field, "Istrain");
}

TEST(ToVersion, ZeroAndTheDefaultAxisGoWithoutLoss) {
  const std::string text = deck_of_version(
      2020,
      card("/SKEW/MOV", 1, 2020, {{"N1", "1"}, {"N2", "2"}, {"N3", "3"}, {"Dir", "X"}}) +
          card("/INTER/TYPE19", 1, 2020, {{"surf_IDs", "1"}, {"Igap", "4"}, {"Irem_gap", "0"}}));
  const Rewrite r = rewrite_of(text, 2018);
  EXPECT_TRUE(r.refusals.empty()) << joined(r.refusals);
  EXPECT_TRUE(losses_of(r, Loss::dropped).empty());
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
  const auto then = applied(*before, to_version(before->context(), 2024));
  EXPECT_EQ(difference(effective_values(*before), effective_values(*then)), "");
  for (const Block& b : then->deck.blocks) EXPECT_EQ(b.version, 2024) << b.header;
  EXPECT_TRUE(decode(then->deck, *then->interfaces.type11.at(2).block).extra.empty());
}

TEST(ToVersion, NumberWithoutVersionIsReadAsTheNewest) {
  const std::string text =
      deck_of_version(2612, card("/INTER/TYPE11", 1, 2026, {{"line_IDs", "1"}}));
  const auto before = open_text(text);
  const Rewrite r = to_version(before->context(), 2026);
  EXPECT_TRUE(r.refusals.empty());
  EXPECT_EQ(applied(*before, r)->deck.begin.version_written, 2026);
}

TEST(ToVersion, UnknownTargetsAndOldDecksAreRefused) {
  EXPECT_FALSE(rewrite_of(deck_of_version(2022, ""), 2027).refusals.empty());
  EXPECT_FALSE(rewrite_of(deck_of_version(2022, ""), 100).refusals.empty());
  EXPECT_FALSE(rewrite_of(deck_of_version(90, "/PART/1\np\n         1\n"), 2022).refusals.empty());
  EXPECT_FALSE(rewrite_of("#RADIOSS STARTER\n/PART/1\np\n/END\n", 2022).refusals.empty());
}

TEST(ToVersion, KeywordsOfWhichNotEveryColumnIsKnownAreUndecidedByNameAndCount) {
  const std::string text = deck_of_version(
      2022, "/FAIL/UNKNOWN/1\n  1.0\n/FXBODY/1\na\n/FXBODY/2\nb\n/NOBODY/KNOWS\n 1\n");
  const Rewrite r = rewrite_of(text, 2024);
  ASSERT_EQ(r.refusals.size(), 3u) << joined(r.refusals);
  EXPECT_THAT(joined(r.refusals), HasSubstr("main_0000.rad:7:1: /FAIL"));
  EXPECT_THAT(joined(r.refusals), HasSubstr("/FXBODY: has columns"));
  EXPECT_THAT(joined(r.refusals), HasSubstr("its 2 blocks"));
  EXPECT_THAT(joined(r.refusals), HasSubstr("/NOBODY/KNOWS"));
  EXPECT_EQ(losses_of(r, Loss::undecided).size(), 3u);
  const Rewrite kept = rewrite_of(text, 2024, {.allow_loss = true});
  EXPECT_TRUE(kept.refusals.empty()) << joined(kept.refusals);
  EXPECT_EQ(losses_of(kept, Loss::undecided).size(), 3u);
  EXPECT_EQ(kept.edits.size(), 1u) << "only the version changes";
}

TEST(ToVersion, EngineKeywordsAreNoQuestionOfVersion) {
  EXPECT_TRUE(rewrite_of(deck_of_version(2022, "/ANIM/DT\n 0.0 1.0\n"), 2024).refusals.empty());
}

// ---- properties -----------------------------------------------------------------------------

/// Random texts for the cells of a keyword at one version.
class RandomCards {
 public:
  explicit RandomCards(std::uint32_t seed) : random_(seed) {}

  std::string make(const std::string& keyword, int id, int version, double filled) {
    const Schema& schema = *SchemaSet::built_in().find(keyword);
    std::vector<std::pair<std::string, std::string>> values;
    // A line whose condition does not hold is not there.
    const auto holds = [&](const std::vector<Condition>& when) {
      return std::all_of(when.begin(), when.end(), [&](const Condition& c) {
        std::int64_t value = 0;
        for (const auto& [name, text] : values)
          if (name == c.field) value = std::strtoll(text.c_str(), nullptr, 10);
        return c.holds(value);
      });
    };
    for (const CardSchema& card : schema.cards) {
      if (!card.in_version(version) || !holds(card.when)) continue;
      for (const Field& f : card.fields)
        if (f.in_version(version) && !f.ignored && f.name != "Ists" && f.name != "Ipen_min" &&
            chance(filled) && holds(f.when))
          values.emplace_back(f.name, text_of(f));
    }
    // The lines of a pair begin with the one that names it.
    if (keyword == "/FRICTION" && !values.empty()) values.emplace_back("grpart_ID1", "7");
    return test::card(keyword, id, version, values);
  }
  bool chance(double p) { return std::uniform_real_distribution<>()(random_) < p; }
  int below(int n) { return std::uniform_int_distribution<>(0, n - 1)(random_); }

 private:
  std::string text_of(const Field& f) {
    if (f.type == FieldType::flag) return chance(0.5) ? "1" : "0";
    if (f.type == FieldType::real) {
      static const char* const texts[] = {"0.5", "1.25-3", "3.D2", "0.0", "12.", "7e-4", "1.0"};
      return texts[below(7)];
    }
    if (!f.values.empty())
      return std::to_string(
          f.values[static_cast<std::size_t>(below(static_cast<int>(f.values.size())))]);
    return std::to_string(below(40));
  }
  std::mt19937 random_;
};

/// name -> text of every cell of a block.
std::map<std::string, std::string> cells(const Deck& deck, const Block& block) {
  std::map<std::string, std::string> out;
  const DecodedBlock decoded = decode(deck, block);
  int line = 0;
  for (const DecodedCard& card : decoded.cards) {
    if (card.schema->repeat != Repeat::once) ++line;
    for (const Cell& cell : card.cells)
      if (!cell.blank())
        out[(cell.field->name == "Rthe" ? "Kthe" : cell.field->name) +
            (line ? " " + std::to_string(line) : "")] = cell.text;
  }
  EXPECT_TRUE(decoded.extra.empty()) << block.header << "\n" << deck.sources[0].bytes();
  return out;
}

TEST(ToVersionProperty, RandomCardsUpKeepEveryCellAndDownGiveTheSameBytes) {
  const std::string keywords[] = {"/DEFAULT/INTER/TYPE7",
                                  "/DEFAULT/INTER/TYPE11",
                                  "/DEFAULT/INTER/TYPE19",
                                  "/DEFAULT/INTER/TYPE2",
                                  "/DEFAULT/INTER/TYPE24",
                                  "/DEFAULT/INTER/TYPE25",
                                  "/INTER/TYPE2",
                                  "/INTER/TYPE24",
                                  "/INTER/TYPE25",
                                  "/INTER/TYPE7",
                                  "/INTER/TYPE10",
                                  "/INTER/TYPE11",
                                  "/INTER/TYPE19",
                                  "/INTER/LAGDT/TYPE7",
                                  "/FRICTION",
                                  "/SENSOR/TIME",
                                  "/PART"};
  RandomCards random(20260101);
  for (int round = 0; round < 150; ++round) {
    const int low = random.below(14), high = low + random.below(14 - low);
    const int from = versions[low], to = versions[high];
    std::string body;
    for (const std::string& k : keywords)
      if (SchemaSet::built_in().find(k)->from <= from) body += random.make(k, 1, from, 0.5);
    const std::string text = deck_of_version(from, body);
    const auto before = open_text(text);
    const Rewrite up = to_version(before->context(), to);
    ASSERT_TRUE(up.refusals.empty()) << from << " -> " << to << "\n" << joined(up.refusals);
    const auto there = applied(*before, up);
    ASSERT_EQ(there->deck.version, to);
    ASSERT_EQ(there->deck.blocks.size(), before->deck.blocks.size());
    for (std::size_t i = 1; i < there->deck.blocks.size(); ++i)
      EXPECT_EQ(difference(cells(before->deck, before->deck.blocks[i]),
                           cells(there->deck, there->deck.blocks[i])),
                "")
          << from << " -> " << to << " " << before->deck.blocks[i].header << "\n"
          << text << "\n"
          << bytes_of(*there);
    EXPECT_EQ(difference(effective_values(*before, true), effective_values(*there, true)), "");
    const Rewrite down = to_version(there->context(), from);
    ASSERT_TRUE(down.refusals.empty()) << joined(down.refusals);
    EXPECT_EQ(bytes_of(*applied(*there, down)), text) << from << " -> " << to;
    if (HasFailure()) return;
  }
}

TEST(ToVersionProperty, RandomCardsDownLoseOnlyWhatIsReported) {
  const std::string keywords[] = {"/INTER/TYPE7", "/INTER/TYPE10", "/INTER/TYPE11", "/INTER/TYPE19",
                                  "/INTER/TYPE2", "/INTER/TYPE24", "/INTER/TYPE25"};
  RandomCards random(7);
  for (int round = 0; round < 150; ++round) {
    const int high = random.below(14), low = random.below(high + 1);
    const int from = versions[high], to = versions[low];
    std::string body;
    if (from >= 140 && random.chance(0.5))
      body += random.make("/DEFAULT/INTER/TYPE7", 0, from, 0.7) +
              random.make("/DEFAULT/INTER/TYPE11", 0, from, 0.7);
    // A type that the lower version does not have is refused, and is no loss.
    for (const std::string& k : keywords)
      if (SchemaSet::built_in().find(k)->from <= to) body += random.make(k, 1, from, 0.4);
    const auto before = open_text(deck_of_version(from, body));
    const Rewrite down = to_version(before->context(), to, {.allow_loss = true});
    ASSERT_TRUE(down.refusals.empty()) << joined(down.refusals);
    const auto there = applied(*before, down);
    const auto old_values = effective_values(*before), new_values = effective_values(*there);
    std::set<std::string> lost;
    bool default_lost = false;
    for (const LossEntry& l : losses_of(down, Loss::dropped)) {
      lost.insert(l.keyword + "/" + std::to_string(l.id) + " " + l.field);
      default_lost = default_lost || l.keyword.starts_with("/DEFAULT");
    }
    if (default_lost) continue;
    for (const auto& [name, value] : old_values) {
      if (lost.count(name) > 0 || new_values.at(name) == value) continue;
      // What follows from a lost value may change with it.
      const std::string head = name.substr(0, name.find(' ') + 1);
      const bool follows = std::any_of(lost.begin(), lost.end(),
                                       [&](const std::string& l) { return l.starts_with(head); });
      EXPECT_TRUE(follows) << from << " -> " << to << " " << name << " " << value << " "
                           << new_values.at(name) << "\n"
                           << bytes_of(*before);
    }
    if (HasFailure()) return;
  }
}

TEST(ToVersionProperty, CorpusKeepsItsEffectiveValues) {
  const std::filesystem::path shared = test::shared_dir();
  if (!std::filesystem::exists(shared / "corpus")) GTEST_SKIP() << "no corpus in " << shared;
  int converted = 0;
  for (const char* folder : {"corpus/qa", "corpus/synthetic", "oracle/params"}) {
    if (!std::filesystem::exists(shared / folder)) continue;
    for (const auto& e : std::filesystem::recursive_directory_iterator(shared / folder)) {
      if (!e.path().string().ends_with("_0000.rad") || e.file_size() > 1'000'000) continue;
      const Whole before(e.path().string());
      for (const int version : {110, 130, 2017, 2018, 2020, 2024, 2026}) {
        const Rewrite there = to_version(before.context(), version);
        if (!there.refusals.empty()) continue;
        ++converted;
        const auto deck = applied(before, there);
        EXPECT_EQ(difference(effective_values(before), effective_values(*deck)), "")
            << e.path() << " -> " << version;
        if (before.deck.version < 110) continue;
        const auto back = applied(*deck, to_version(deck->context(), before.deck.version));
        EXPECT_EQ(difference(effective_values(before), effective_values(*back)), "")
            << e.path() << " <- " << version;
      }
    }
  }
  EXPECT_GE(converted, 20);
}

TEST(ToVersionProperty, SamplesKeepTheirEffectiveValuesInEveryVersionThatHoldsThem) {
  int converted = 0;
  for (const std::string& path : sample_decks()) {
    const Whole before(path);
    for (const int version : versions) {
      const Rewrite there = to_version(before.context(), version);
      if (!there.refusals.empty()) continue;
      ++converted;
      const auto deck = applied(before, there);
      EXPECT_EQ(difference(effective_values(before), effective_values(*deck)), "")
          << path << " -> " << version;
      const auto back = applied(*deck, to_version(deck->context(), before.deck.version));
      EXPECT_EQ(difference(effective_values(before), effective_values(*back)), "")
          << path << " <- " << version;
    }
  }
  EXPECT_GE(converted, 100);
}

}  // namespace
}  // namespace deck::test
