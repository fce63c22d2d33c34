// The text of `deck gaps`: one row per interface, clean ones in one line, nothing wider than asked.
#include <algorithm>

#include "base/shared/columns.hpp"
#include "deck/report/gaps.hpp"
#include "deck/text/rule.hpp"
#include "report/inspected.hpp"
#include "report/shared/cycle.hpp"

namespace deck::test {
namespace {

/// Two plates 0.4 apart: interface 1 and the TYPE19 2 penetrate, the gaps of 3, 4 and 5 are
/// smaller.
std::string several() {
  Plates p;
  p.card = "Gapmin=0.5\n/SURF/PART/2\nupper\n         2";
  for (const char* id : {"3", "4", "5"})
    p.card += std::string("\n@/INTER/TYPE7/") + id + " grnd_IDs=2 surf_IDm=1 Gapmin=0.1";
  p.card += "\n@/INTER/TYPE19/2 surf_IDs=2 surf_IDm=1 Gapmin=0.5";
  return plates(p);
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++n;
  return n;
}

std::string text_of(const Inspected& d, const GapsTextOptions& options = {}) {
  return gaps_text(d.deck, d.scene, d.view, options);
}

TEST(GapsText, HasOneRowPerInterfaceAndCleanOnesInOneLine) {
  const Inspected d(several());
  const std::string text = text_of(d);
  EXPECT_NE(text.find("3 clean interfaces: 3, 4, 5\n"), std::string::npos) << text;
  EXPECT_EQ(count_of(text, "TYPE19"), 1u) << text;
  EXPECT_EQ(text.find("reversed"), std::string::npos) << text;
}

TEST(GapsText, SaysWhatInactiMakesOfEveryTypeOfContact) {
  Plates p;
  p.height = 0.7;  // a TYPE24 forgets what is deeper than half of the gap
  p.card = "Gapmin=0.1\n/SURF/PART/2\nupper\n         2";
  int id = 1;
  for (const char* type : {"24", "25"})
    for (const char* inacti : {"0", "5", "-1"})
      p.card += std::string("\n@/INTER/TYPE") + type + "/" + std::to_string(++id) +
                " surf_ID1=1 surf_ID2=2 Inacti=" + inacti;
  const std::string all = text_of(Inspected(plates(p)));
  const std::string text = all.substr(0, all.find("Part pairs"));
  for (const char* words : {"ignored", "stored as offsets", "initial forces"})
    EXPECT_EQ(count_of(text, words), 2u) << words << "\n" << text;
}

/// The plates, and three interfaces with a side that nothing is on.
std::string one_sided() {
  Plates p;
  p.card =
      "Gapmin=0.1\n@/INTER/TYPE7/3 grnd_IDs=2 surf_IDm=99\n@/INTER/TYPE7/4 grnd_IDs=99 surf_IDm=1";
  p.card += "\n/GRNOD/PART/5\nnobody\n        77\n@/INTER/TYPE7/5 grnd_IDs=5 surf_IDm=1";
  return plates(p);
}

TEST(Obstacle, NamesTheSideWithoutMembers) {
  const Inspected d(one_sided());
  std::vector<std::pair<std::int64_t, std::string_view>> found;
  for (const Contact& c : d.scene.contacts)
    found.emplace_back(c.inter->id, to_string(obstacle_of(c)));
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found,
            (std::vector<std::pair<std::int64_t, std::string_view>>{
                {1, ""}, {3, "empty_main"}, {4, "empty_secondary"}, {5, "empty_secondary"}}));
}

TEST(GapsText, AContactWithAnEmptySideIsNoCleanOne) {
  const Inspected d(one_sided());
  const std::string text = text_of(d);
  EXPECT_NE(text.find("1 clean interface: 1\n"), std::string::npos) << text;
  EXPECT_EQ(count_of(text, "main side is empty"), 1u) << text;
  EXPECT_EQ(count_of(text, "secondary side is empty"), 2u) << text;
  EXPECT_NE(text.find("3 contacts with an empty side. No initial penetration in 1 contact."),
            std::string::npos)
      << text;
}

TEST(CycleVerdict, AContactWithAnEmptySideIsNotOneWithoutForce) {
  const Inspected d(one_sided());
  const cycle::State state = cycle::make_state(d.scene, {});
  const cycle::SceneOutcome outcome = cycle::run_cycle(d.scene, state, {});
  CycleInput input;
  input.deck = &d.deck;
  input.scene = &d.scene;
  input.state = &state;
  input.outcome = &outcome;
  const std::string verdict = cycle_verdict(input).text;
  EXPECT_TRUE(
      verdict.starts_with("3 contacts with an empty side. No initial penetration in 1 contact. "))
      << verdict;
  EXPECT_NE(verdict.find("No contact force at the start."), std::string::npos) << verdict;
}

TEST(GapsText, AContactWithoutAGapIsNoCleanOne) {
  Plates p;
  p.card = "Gapmin=0.1";
  std::string deck = plates(p);
  const Inspected fine(deck);
  EXPECT_EQ(text_of(fine).find("without a gap"), std::string::npos) << text_of(fine);
  SmallDeck d;
  for (int i = 0; i < 2; ++i) {
    const int n = 4 * i;
    d.node(n + 1, 0, 0, i).node(n + 2, 1, 0, i).node(n + 3, 1, 1, i).node(n + 4, 0, 1, i);
    d.shell_part(i + 1, 0).shell(i + 1, i + 1, n + 1, n + 2, n + 3, n + 4);
  }
  d.add(
      "/SURF/PART/1\ns\n         1\n/GRNOD/PART/2\ns\n         2\n@/INTER/TYPE7/1 grnd_IDs=2 "
      "surf_IDm=1");
  const std::string text = text_of(Inspected(d.text()));
  EXPECT_NE(text.find("1 contact without a gap (error 785/786). No initial penetration in 0 "
                      "contacts."),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("there is no gap"), std::string::npos) << text;
}

TEST(GapsText, AContactWithSegmentsWithoutAreaIsNoCleanOne) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 1, 0, 0).node(3, 2, 0, 0).node(4, 3, 0, 0).node(5, 0, 0, 5);
  d.shell_part(1, 1).shell(1, 1, 1, 2, 3, 4);
  d.add(
      "/SURF/PART/1\ns\n         1\n/GRNOD/NODE/2\ns\n         5\n@/INTER/TYPE7/1 grnd_IDs=2 "
      "surf_IDm=1 Gapmin=1");
  const std::string text = text_of(Inspected(d.text()));
  EXPECT_NE(text.find("1 contact with main segments without area (error 558). No initial "
                      "penetration in 1 contact."),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("1 segment without area"), std::string::npos) << text;
}

TEST(GapsText, AContactWithSegmentsWithoutElementIsNoCleanOne) {
  Plates p;
  p.card = "Gapmin=0.1\n/SURF/SEG/8\nloose\n         1         1         2         6         5\n";
  p.card += "@/INTER/TYPE7/3 grnd_IDs=2 surf_IDm=8 Gapmin=0.1";
  const Inspected d(plates(p));
  EXPECT_EQ(to_string(obstacle_of(d.scene.contacts.back())), "no_element");
  const std::string text = text_of(d);
  EXPECT_NE(text.find("1 contact with segments or edges without element (error 481/482). "),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("segments or edges without element"), std::string::npos) << text;
}

TEST(GapsText, AContactWithoutStiffnessOnTheMainSideIsNoCleanOne) {
  const auto of_void = [](const std::string& flags) {
    SmallDeck d;
    d.add("/MAT/VOID/9\nempty\n               1e-06                 0.0                 0.3");
    d.add("/PROP/VOID/9\nskin\n                 1.0");
    d.add("/PART/9\nskin\n         9         9         0");
    d.node(1, 0, 0, 0).node(2, 1, 0, 0).node(3, 1, 1, 0).node(4, 0, 1, 0).node(5, 0.5, 0.5, 0.1);
    d.add("/SHELL/9\n         1         1         2         3         4");
    d.group("/SURF/PART/1", {9}).group("/GRNOD/NODE/2", {5});
    d.add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=0.2 " + flags);
    return text_of(Inspected(d.text()));
  };
  const std::string weak = of_void("Istf=4");
  EXPECT_NE(weak.find("1 contact without stiffness on the main side. No initial "
                      "penetration in 0 contacts."),
            std::string::npos)
      << weak;
  EXPECT_NE(weak.find("main side has no stiffness"), std::string::npos) << weak;
  // A stiffness that the card gives needs no material.
  const std::string given = of_void("Istf=1 Stfac=5");
  EXPECT_NE(given.find("1 initial penetration on 1 node"), std::string::npos) << given;
}

TEST(GapsText, AnEmptySideIsAnErrorUnlessItIsANodeGroupThatIsThere) {
  const Inspected d(one_sided());
  std::vector<std::pair<std::int64_t, Severity>> found;
  for (const Diagnostic& f : d.loaded.findings().all())
    if (f.rule == RuleId::DK172 || f.rule == RuleId::DK173) found.emplace_back(f.id, f.severity);
  EXPECT_EQ(found, (std::vector<std::pair<std::int64_t, Severity>>{
                       {3, Severity::error}, {4, Severity::error}, {5, Severity::warning}}));
}

TEST(GapsText, VerboseShowsEveryInterfaceAndTheRolesAsJsonNamesThem) {
  const Inspected d(several());
  GapsTextOptions options;
  options.verbose = true;
  const std::string text = text_of(d, options);
  EXPECT_EQ(text.find("clean interface"), std::string::npos) << text;
  for (const Contact& c : d.scene.contacts)
    if (c.inter->type == 19) {
      EXPECT_NE(text.find(std::string("TYPE19 ") + to_string(c.role)), std::string::npos) << text;
    }
}

TEST(GapsText, SaysTheVerdictOnceAndLast) {
  const Inspected d(several());
  const std::string verdict = verdict_of(d.deck, d.scene, d.view).text, text = text_of(d);
  EXPECT_TRUE(text.ends_with("\n\n" + verdict + "\n")) << text;
  EXPECT_EQ(count_of(text, verdict), 1u) << text;
}

TEST(GapsText, TellsOfRoundOffOnlyWhereItDecidesOrWhenAsked) {
  const Inspected d(several());
  EXPECT_EQ(count_of(text_of(d), "Decisions ("), 0u);
  GapsTextOptions options;
  options.verbose = true;
  EXPECT_EQ(count_of(text_of(d, options), "Decisions ("), 1u);
}

TEST(GapsText, NamesTheDeckWhereThereAreSeveral) {
  const Inspected d(several());
  GapsTextOptions options;
  options.name = "one_0000.rad";
  EXPECT_TRUE(text_of(d, options).starts_with("one_0000.rad\n"));
}

TEST(GapsText, FitsTheTerminalAndKeepsEveryIdWhole) {
  const Inspected d(several());
  GapsTextOptions options;
  for (const bool verbose : {false, true})
    for (const std::size_t width : {60u, 80u, 120u}) {
      options.verbose = verbose;
      options.width = width;
      const std::string text = folded(text_of(d, options), width);
      for (std::size_t at = 0; at < text.size();) {
        const auto nl = std::min(text.find('\n', at), text.size());
        EXPECT_LE(display_width(text.substr(at, nl - at)), width) << text.substr(at, nl - at);
        at = nl + 1;
      }
      EXPECT_NE(text.find("  1 2 3 4"), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace deck::test
