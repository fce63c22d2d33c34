// Effective values on the cards: nothing changes but where they come from.
#include "edit/shared/conversion.hpp"

#include <gtest/gtest.h>

#include <random>

#include "edit/support.hpp"

namespace deck::test {
namespace {

std::unique_ptr<Whole> resolved(const Whole& before) {
  const Rewrite r = resolve_defaults(before.context());
  EXPECT_TRUE(r.refusals.empty()) << joined(r.refusals);
  return before.after(r);
}

/// The same text without its /DEFAULT/INTER blocks.
std::string without_defaults(const Whole& o) {
  std::string out;
  bool skip = false;
  std::string_view rest = o.deck.sources[0].bytes();
  while (!rest.empty()) {
    const auto n = std::min(rest.find('\n'), rest.size() - 1) + 1;
    const std::string_view line = rest.substr(0, n);
    if (line.starts_with('/')) skip = line.starts_with("/DEFAULT");
    if (!skip) out += line;
    rest.remove_prefix(n);
  }
  return out;
}

const std::string defaults_7 = card("/DEFAULT/INTER/TYPE7", 0, 2022,
                                    {{"Istf", "4"},
                                     {"Igap", "3"},
                                     {"Idel", "2"},
                                     {"Irem_gap", "2"},
                                     {"Irem_i2", "1"},
                                     {"Inacti", "6"},
                                     {"Iform", "2"}});

TEST(ResolveDefaults, GapFromTheMeshStaysBlankAndIsReported) {
  const auto before =
      open_text(deck_of_version(2022, card("/INTER/TYPE7", 1, 2022, {{"surf_IDm", "1"}})));
  const Rewrite r = resolve_defaults(before->context());
  const auto kept = losses_of(r, Loss::kept);
  EXPECT_TRUE(std::any_of(kept.begin(), kept.end(), [](const LossEntry& l) {
    return l.field == "Gapmin" && l.note.find("mesh") != std::string::npos && l.new_text.empty();
  }));
  EXPECT_FALSE(before->after(r)->interfaces.type7.at(0).Gapmin.has_input);
}

TEST(ResolveDefaults, ValuesWithoutACellStayWithTheDefaultCard) {
  const std::tuple<int, std::string, const char*, const char*> decks[] = {
      {110,
       card("/DEFAULT/INTER/TYPE7", 0, 140, {{"Irem_gap", "2"}}) +
           card("/INTER/TYPE7", 1, 110, {{"surf_IDm", "1"}}),
       "Irem_gap", "2"},
      {2022,
       card("/DEFAULT/INTER/TYPE19", 0, 2022, {{"Iedge", "1"}}) +
           card("/INTER/TYPE19", 1, 2022, {{"surf_IDm", "1"}}),
       "Iedge", "1"}};
  for (const auto& [version, text, field, value] : decks) {
    const auto before = open_text(deck_of_version(version, text));
    const auto open = losses_of(resolve_defaults(before->context(), {true}), Loss::undecided);
    ASSERT_EQ(open.size(), 1u);
    EXPECT_EQ(open[0].field, field);
    EXPECT_EQ(open[0].new_text, value);
  }
}

TEST(ResolveDefaults, StiffnessKeepsItsValueWhenTheDefaultGivesItAUnit) {
  // With Istf 1 on the card Stfac is a stiffness and is converted; it was a plain number before.
  const std::string text =
      "#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n"
      "                  kg                   m                   s\n"
      "                   g                  mm                  ms\n" +
      card("/DEFAULT/INTER/TYPE7", 0, 2022, {{"Istf", "1"}}) +
      card("/INTER/TYPE7", 1, 2022, {{"surf_IDm", "1"}, {"Stfac", "7.0"}}) +
      card("/INTER/TYPE7", 2, 2022, {{"surf_IDm", "1"}}) + "/END\n";
  const auto before = open_text(text);
  ASSERT_EQ(before->interfaces.type7.at(0).Stfac.value, 7);
  const auto after = resolved(*before);
  EXPECT_EQ(after->interfaces.type7.at(0).Istf.input, 1);
  EXPECT_EQ(after->interfaces.type7.at(0).Stfac.value, 7);
  EXPECT_EQ(after->interfaces.type7.at(1).Stfac.value, 1);
}

TEST(ResolveDefaults, ShortAndFreeFormatBlocksGetFullLines) {
  for (const char* block : {"/INTER/TYPE7/1\nshort\n         5         1\n# end\n",
                            "/INTER/TYPE7/1\nfree\n5,1,,0,1000,0,0\n,,\n\n1.5,0.1,0.3\n"
                            "       110                             5\n\n"}) {
    const auto before = open_text(deck_of_version(2022, defaults_7 + block));
    const auto after = resolved(*before);
    EXPECT_EQ(difference(effective_values(*before), effective_values(*after)), "");
    EXPECT_EQ(after->interfaces.type7.at(0).grnd_IDs.value, 5);
    EXPECT_EQ(after->interfaces.type7.at(0).Iform.input, 2);
  }
}

TEST(ResolveDefaultsProperty, RandomCardsInForeignUnitsKeepEveryBit) {
  std::mt19937 random(99);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const int versions[] = {110, 120, 130, 140, 2017, 2018, 2020, 2021, 2022, 2024, 2026};
  const char* const masses[] = {"Mg", "kg", "g", "0.7"};
  const char* const lengths[] = {"m", "mm", "0.0254"};
  const char* const times[] = {"s", "ms", "3.3e-5"};
  const char* const keywords[] = {
      "/DEFAULT/INTER/TYPE7", "/DEFAULT/INTER/TYPE11", "/DEFAULT/INTER/TYPE19", "/INTER/TYPE7",
      "/INTER/TYPE10",        "/INTER/TYPE11",         "/INTER/TYPE19"};
  int approximated = 0, exact = 0;
  for (int round = 0; round < 200; ++round) {
    const int version = versions[below(11)];
    std::string text = "#RADIOSS STARTER\n/BEGIN\nrun\n";
    char line[200];
    std::snprintf(line, sizeof line, "%10d         0\n%20s%20s%20s\n%20s%20s%20s\n", version,
                  masses[below(4)], lengths[below(3)], times[below(3)], masses[below(4)],
                  lengths[below(3)], times[below(3)]);
    text += line;
    for (const std::string keyword : keywords) {
      const Schema& schema = *SchemaSet::built_in().find(keyword);
      if (version < schema.from) continue;
      std::vector<std::pair<std::string, std::string>> values;
      for (const CardSchema& c : schema.cards)
        for (const Field& f : c.fields) {
          if (below(3) != 0 || f.name == "Ists") continue;
          if (f.type == FieldType::real)
            values.emplace_back(f.name, below(2) ? "0.3" : "1.7e-3");
          else if (!f.values.empty())
            values.emplace_back(f.name, std::to_string(f.values[below(f.values.size())]));
        }
      text += card(keyword, 1, version, values);
    }
    const auto before = open_text(text + "/END\n");
    const Rewrite r = resolve_defaults(before->context(), {true});
    ASSERT_TRUE(r.refusals.empty()) << joined(r.refusals);
    const auto after = before->after(r);
    auto old_values = effective_values(*before), new_values = effective_values(*after);
    for (const LossEntry& l : losses_of(r, Loss::approximated)) {
      const std::string name =
          l.keyword + "/" + std::to_string(l.id) + " " + (l.field == "Rthe" ? "Kthe" : l.field);
      EXPECT_NEAR(std::stod(new_values.at(name)) / std::stod(old_values.at(name)), 1, 1e-15);
      old_values.erase(name);
      new_values.erase(name);
      ++approximated;
    }
    exact += static_cast<int>(losses_of(r, Loss::kept).size());
    EXPECT_EQ(difference(old_values, new_values), "") << before->main_text();
    if (losses_of(r, Loss::undecided).empty() && losses_of(r, Loss::approximated).empty()) {
      const auto alone = open_text(without_defaults(*after));
      EXPECT_EQ(difference(old_values, effective_values(*alone)), "") << after->main_text();
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(exact, 1000);
  EXPECT_LT(approximated, exact / 10);
}

}  // namespace
}  // namespace deck::test
