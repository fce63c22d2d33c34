// What the effects cost, in words, tables and JSON, from figures that are written out here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "contact/small_deck.hpp"
#include "report/cycle_costs.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

/// Two contacts with friction on: the first timed over 3 pairs, the second over 1 further apart.
struct Timed {
  explicit Timed(double all_ns = 30.0) : b(deck()) {
    outcome.contacts.resize(2);
    for (std::size_t i = 0; i < 2; ++i) {
      outcome.contacts[i].contact = &b.scene.contacts.at(i);
      outcome.contacts[i].effects = {{"friction-viscous", true, "Fric", "Fric = 0.2"},
                                     {"tie", false, "", "TYPE10 only"}};
    }
    costs.resize(2);
    costs[0].pairs = costs[0].measured = 3;
    costs[0].loop_ns = 10;
    costs[0].flags_ns = 20;
    costs[0].all_ns = all_ns;
    costs[0].effects = {effect("friction-viscous", 2.5, 2.0, 3.0, 0.5),
                        effect("tie", 0, 0, 0, 0, "TYPE10 only")};
    costs[0].effects[1].on = false;
    costs[1] = costs[0];
    costs[1].pairs = costs[1].measured = 1;
    costs[1].margin = 1;
    costs[1].loop_ns = 50;
    costs[1].all_ns = 70;
    costs[1].effects[0] = effect("friction-viscous", 0.5, -1.0, 2.0, 1e-5);
    input.deck = &b.deck;
    input.scene = &b.scene;
    input.outcome = &outcome;
    input.costs = &costs;
    input.cost_repeats = 7;
    input.processor = "a processor";
  }
  static SmallDeck deck() {
    SmallDeck d;
    d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(9, 5, 5, 0.5);
    d.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4);
    d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {9});
    return d.add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1 Fric=0.2")
        .add("@/INTER/TYPE7/2 grnd_IDs=2 surf_IDm=1 Gapmin=1 Fric=0.2");
  }
  static EffectCost effect(const char* name, double ns, double low, double high, double change,
                           const char* why_not = "") {
    EffectCost e;
    e.name = name;
    e.on = true;
    e.other = *why_not == '\0' ? "no friction" : "";
    e.why_not = why_not;
    e.ns = ns;
    e.low = low;
    e.high = high;
    e.change = change;
    return e;
  }
  Json written() const {
    std::string text;
    JsonWriter j(text);
    j.begin_object();
    write_costs(j, input);
    j.key("contacts").begin_array();
    for (const auto& c : outcome.contacts) {
      j.begin_object();
      write_cost(j, input, c);
      j.end_object();
    }
    j.end_array().end_object();
    return Json::parse(text);
  }
  Built b;
  cycle::SceneOutcome outcome;
  std::vector<ContactCost> costs;
  CycleInput input;
};

TEST(Costs, AreMeansOverThePairsOfAllContacts) {
  const Timed t;
  const CostSummary s = summarize_costs(t.input);
  EXPECT_EQ(s.contacts, 2u);
  EXPECT_EQ(s.pairs, 4u);
  EXPECT_EQ(s.wider, 1u);
  EXPECT_EQ(s.on, 1u);
  EXPECT_EQ(s.known, 2u);
  EXPECT_EQ(s.loop_ns, 20.0);
  EXPECT_EQ(s.flags_ns, 20.0);
  EXPECT_EQ(s.all_ns, 40.0);
  EXPECT_EQ(cost_sentence(t.input),
            "1 of 2 effects are asked for on this deck, and only they run: 20 ns per pair; with "
            "everything that these contacts could do it would be 40 ns (2 x), with flags asked for "
            "inside the loop 20 ns (1.00 x). Measured over 4 pairs of 2 contacts, 1 of them with "
            "pairs up to five gaps apart, as none is nearer.");
}

TEST(Costs, OfEverythingAreSaidOnlyWhereEveryContactHasSuchALoop) {
  const Timed t(0.0);
  EXPECT_EQ(summarize_costs(t.input).all_ns, 0.0);
  EXPECT_THAT(cost_sentence(t.input), Not(HasSubstr("everything")));
}

TEST(Costs, WithoutAPairSayThatThereIsNoLoop) {
  Timed t;
  for (ContactCost& c : t.costs) c.problem = "no pair";
  EXPECT_EQ(cost_sentence(t.input),
            "1 of 2 effects are asked for; no pair is within five times its gap at the start, so "
            "there is no loop to time.");
}

TEST(Costs, OfJsonHaveEveryFigure) {
  Timed t;
  const Json all = t.written();
  EXPECT_EQ(all["costs"]["verdict"], cost_sentence(t.input));
  EXPECT_EQ(all["costs"]["contacts"], 2);
  EXPECT_EQ(all["costs"]["pairs"], 4);
  EXPECT_EQ(all["costs"]["effects_on"], 1);
  EXPECT_EQ(all["costs"]["effects"], 2);
  EXPECT_EQ(all["costs"]["loop_ns"], 20.0);
  EXPECT_EQ(all["costs"]["repeats"], 7);
  EXPECT_EQ(all["costs"]["processor"], "a processor");
  const Json& cost = all["contacts"][1]["cost"];
  EXPECT_EQ(cost["pairs"], 1);
  EXPECT_EQ(cost["margin"], 1.0);
  EXPECT_EQ(cost["loop_ns"], 50.0);
  EXPECT_EQ(cost["all_ns"], 70.0);
  ASSERT_EQ(cost["effects"].size(), 2u);
  EXPECT_EQ(cost["effects"][0]["against"], "no friction");
  EXPECT_EQ(cost["effects"][0]["low"], -1.0);
  EXPECT_EQ(cost["effects"][1],
            Json::parse(R"({"name":"tie","on":false,"why_not":"TYPE10 only"})"));
  t.input.costs = nullptr;
  const Json none = t.written();
  EXPECT_TRUE(none["costs"].is_null());
  EXPECT_TRUE(none["contacts"][0]["cost"].is_null());
}

TEST(Costs, OfATerminalAreATableOfContactsAndOneOfEffects) {
  Timed t;
  const std::string text = cost_text(t.input, {});
  EXPECT_THAT(text, HasSubstr("Effects that run\n"));
  EXPECT_THAT(text, HasSubstr("2.5"));
  EXPECT_THAT(text, HasSubstr("under 2.0")) << "a range with 0 in it";
  EXPECT_THAT(text, HasSubstr("50 %"));
  EXPECT_THAT(text, HasSubstr("1.0e-05"));
  EXPECT_THAT(text, HasSubstr("  7 timings each, in turn; a processor; "));
  for (ContactCost& c : t.costs) c.effects[0].on = false;
  EXPECT_THAT(cost_text(t.input, {}), Not(HasSubstr("Effects that run")));
  t.costs[0].effects[0] = Timed::effect("friction-viscous", 1, 1, 2, 0.0);
  EXPECT_THAT(cost_text(t.input, {}), HasSubstr("nothing"));
  t.input.costs = nullptr;
  EXPECT_EQ(cost_text(t.input, {}), "");
}

TEST(Costs, OfAPageAreARowForEveryEffectThatRuns) {
  Timed t;
  const auto& ordered = t.b.scene.interfaces->ordered;
  const auto because = [&](std::size_t i) {
    return effect_lines(t.b.deck, t.outcome, *ordered.at(i)).at(0).because;
  };
  const std::string head =
      "<table><thead><tr><th>Interface</th><th>Effect</th><th>Because of</th><th>Adds ns per "
      "pair</th></tr></thead><tbody>\n";
  const auto row = [&](int id, const std::string& why, const std::string& added) {
    return "<tr><td>" + std::to_string(id) + "</td><td>friction-viscous</td><td>" + why +
           "</td><td>" + added + "</td></tr>\n";
  };
  const std::string end = "</tbody></table>\n";
  const std::string all = "<h2>Effects</h2>\n<p>" + cost_sentence(t.input) + "</p>\n" + head;
  const std::string first = because(0), second = because(1);
  EXPECT_EQ(cost_html(t.input), all + row(1, first, "2.5") + row(2, second, "under 2.0") + end);
  t.costs[0].effects[0].why_not = "not with it";
  t.costs[1].effects[0].on = false;
  EXPECT_EQ(cost_html(t.input), all + row(1, first, "") + row(2, second, "") + end);
  // Two contacts of one interface, as those of a TYPE19, are in one row.
  t.costs[0].effects[0].why_not.clear();
  t.costs[1].effects[0].on = true;
  t.outcome.contacts[1].contact = t.outcome.contacts[0].contact;
  EXPECT_EQ(cost_html(t.input), all + row(1, first, "2.5, under 2.0") + end);
  t.input.costs = nullptr;
  EXPECT_EQ(cost_html(t.input), "<h2>Effects</h2>\n" + head + row(1, first, "") + end);
}

TEST(Costs, OfAContactAreOneObject) {
  Timed t;
  t.costs[1].all = "Ifric=3";
  t.costs[1].measured = 4;
  EXPECT_EQ(t.written()["contacts"][1]["cost"],
            Json({{"pairs", 1},
                  {"measured", 4},
                  {"margin", 1.0},
                  {"problem", ""},
                  {"loop_ns", 50.0},
                  {"flags_ns", 20.0},
                  {"all_ns", 70.0},
                  {"all", "Ifric=3"},
                  {"effects",
                   {{{"name", "friction-viscous"},
                     {"on", true},
                     {"against", "no friction"},
                     {"ns", 0.5},
                     {"low", -1.0},
                     {"high", 2.0},
                     {"change", 1e-5}},
                    {{"name", "tie"}, {"on", false}, {"why_not", "TYPE10 only"}}}}}));
  t.costs.pop_back();
  EXPECT_TRUE(t.written()["contacts"][1]["cost"].is_null()) << "nothing was measured of it";
}

TEST(Costs, RangesWithZeroInThemGiveTheirFartherEnd) {
  Timed t;
  const std::tuple<double, double, double, const char*> cases[] = {
      {3.0, 1.0, 4.0, "3.0"},       {-3.0, -4.0, -1.0, "-3.0"},    {1.0, -5.0, 4.0, "under 5.0"},
      {1.0, 0.0, 4.0, "under 4.0"}, {1.0, -4.0, 0.0, "under 4.0"}, {12.4, 11.0, 13.0, "12"},
      {9.99, 9.0, 11.0, "10.0"},    {10.0, 9.0, 11.0, "10"}};
  for (const auto& [ns, low, high, text] : cases) {
    t.costs[0].effects[0] = Timed::effect("friction-viscous", ns, low, high, 0.5);
    EXPECT_THAT(cost_html(t.input), HasSubstr(std::string("<td>") + text + "</td></tr>\n<tr><td>2"))
        << text;
  }
}

TEST(Costs, TheShortSentenceIsAlwaysSaid) {
  Timed t;
  EXPECT_EQ(short_cost_sentence(t.input), "1 of 2 effects run; too few pairs to time.");
  t.outcome.contacts[0].pairs_in_reach = 1000;
  EXPECT_EQ(short_cost_sentence(t.input),
            "1 of 2 effects run; they take 20 ns a pair, all would take 40.");
  t.input.loops = t.input.costs;
  t.input.costs = nullptr;
  EXPECT_EQ(short_cost_sentence(t.input),
            "1 of 2 effects run; they take 20 ns a pair, all would take 40.");
  t.costs[0].all_ns = 0;
  EXPECT_EQ(short_cost_sentence(t.input), "1 of 2 effects run; they take 20 ns a pair.");
  t.input.loops = nullptr;
  EXPECT_EQ(short_cost_sentence(t.input), "1 of 2 effects run.");
}

}  // namespace
}  // namespace deck::test
