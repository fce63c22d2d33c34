// The verdict on facts that are written down here: every sentence, every count and every level, one
// fact at a time and all of them together.
// Over 600 lines: independent tests, a few lines for each fact.
#include <cmath>
#include <functional>

#include "deck/text/rule_id.hpp"
#include "deck/verdict.hpp"
#include "report/inspected.hpp"
#include "verdict/shared/of_interface.hpp"

namespace deck::test {
namespace {

using Lines = std::vector<std::string>;

/// Two plates that do not touch, and what is said where other facts are put in.
struct Facts {
  Facts() {
    in.deck = &d.deck;
    in.model = &d.model;
    in.interfaces = &d.interfaces;
    in.contacts.emplace().contacts = 1;
  }
  ContactFacts& contacts() { return *in.contacts; }
  TieFacts& ties() { return in.contacts->ties ? *in.contacts->ties : in.contacts->ties.emplace(); }
  void error(RuleId rule, Severity severity = Severity::error,
             std::optional<Severity> of_solver = {}) {
    Diagnostic finding;
    finding.rule = rule;
    finding.severity = severity;
    if (of_solver) finding.reference = ReferenceMessage{7, *of_solver};
    d.loaded.deck().diagnostics.report(finding);
  }
  Verdict verdict() const { return make_verdict(in); }

  static std::string apart() {
    Plates p;
    p.card = "Gapmin=0.1";
    return plates(p);
  }
  Inspected d{apart()};
  VerdictInput in;
};

/// "what: text {name=n ...}" of every sentence.
Lines lines_of(const Verdict& v) {
  Lines out;
  for (const VerdictSentence& s : v.sentences) {
    std::string line = s.what + ": " + s.text;
    for (const auto& [name, n] : s.counts) line += " " + name + "=" + std::to_string(n);
    out.push_back(line);
  }
  return out;
}

/// The sentences of facts that `change` puts in, without "No initial penetration".
Lines said_of(const std::function<void(Facts&)>& change) {
  Facts f;
  change(f);
  Lines out = lines_of(f.verdict());
  std::erase_if(out, [](const std::string& s) { return s.find(": No initial") != s.npos; });
  return out;
}

VerdictLevel level_with(const std::function<void(Facts&)>& change) {
  Facts f;
  change(f);
  return f.verdict().level;
}

Obstacle at(std::size_t i) { return static_cast<Obstacle>(i); }

// ---- contacts ----------------------------------------------------------------------------------

TEST(VerdictFacts, EveryObstacleHasItsSentenceAndItsNumber) {
  Facts f;
  f.contacts().contacts = 30;
  f.contacts().not_evaluated = 7;
  f.contacts().obstacles = {2, 1, 2, 3, 4, 5, 6};
  EXPECT_EQ(
      lines_of(f.verdict()),
      (Lines{
          "not_evaluated: 7 contacts could not be evaluated, see the findings. not_evaluated=7",
          "empty_sides: 3 contacts with an empty side. empty_sides=3",
          "without_gap: 3 contacts without a gap (error 785/786). without_gap=3",
          "without_stiffness: 6 contacts without stiffness on the main side. without_stiffness=6",
          "without_area: 4 contacts with main segments without area (error 558). without_area=4",
          "without_element: 5 contacts with segments or edges without element (error 481/482). "
          "without_element=5",
          // 30 less 7, and less 12 that have nothing to be in contact with or no gap or stiffness.
          "penetrations: No initial penetration in 11 contacts. pairs=0 nodes=0 edges=0"}));
}

TEST(VerdictFacts, ContactsWithObstaclesStopOrLeaveSomethingOpen) {
  const VerdictLevel stops = VerdictLevel::stops, open = VerdictLevel::not_examined;
  const VerdictLevel levels[] = {VerdictLevel::clean, open, open, stops, stops, stops, open};
  for (std::size_t i = 0; i < std::size(levels); ++i) {
    Facts f;
    f.contacts().obstacles[i] = 1;
    const Verdict v = f.verdict();
    EXPECT_EQ(v.level, levels[i]) << to_string(at(i));
    EXPECT_EQ(v.stops_before_pairs, levels[i] == stops) << to_string(at(i));
    EXPECT_FALSE(v.undecided);
    EXPECT_FALSE(v.warns);
    EXPECT_EQ(lines_of(v).size(), i == 0 ? 1u : 2u);
  }
}

TEST(VerdictFacts, PenetrationsAreCountedAndTheDeepestIsNamed) {
  const auto text = [](ItemCounts count, double deepest, double gap, double worst) {
    Facts f;
    f.contacts().total.count = count;
    f.contacts().deepest = deepest;
    f.contacts().deepest_gap = gap;
    f.contacts().total.max_ratio = worst;
    EXPECT_EQ(f.verdict().level, VerdictLevel::penetrates);
    EXPECT_TRUE(f.verdict().warns);
    const Lines lines = lines_of(f.verdict());
    EXPECT_EQ(lines.size(), 1u);
    return lines.at(0);
  };
  EXPECT_EQ(text({1, 1, 0}, 0.25, 0.5, 0.6),
            "penetrations: 1 initial penetration on 1 node, deepest 0.25 of a gap of 0.5; worst "
            "depth/gap 60.0 %. pairs=1 nodes=1 edges=0");
  EXPECT_EQ(text({7, 3, 2}, 0.25, 0, 0),
            "penetrations: 7 initial penetrations on 3 nodes and 2 edges, deepest 0.25. pairs=7 "
            "nodes=3 edges=2");
  EXPECT_EQ(text({2, 0, 2}, 0, 0, 0),
            "penetrations: 2 initial penetrations on 2 edges. pairs=2 nodes=0 edges=2");
  EXPECT_EQ(text({2, 0, 2}, 0, 0, 1.25),
            "penetrations: 2 initial penetrations on 2 edges; worst depth/gap 125.0 %. pairs=2 "
            "nodes=0 edges=2");
}

TEST(VerdictFacts, OneAndSeveralOfEachKindAreSaid) {
  using Row = std::pair<std::function<void(Facts&)>, Lines>;
  const Row rows[] = {
      {[](Facts&) {}, {}},
      {[](Facts& f) { f.contacts().unbounded = 1; },
       {"unbounded: 1 pair has an unbounded gap, beyond ten times the model's size. unbounded=1"}},
      {[](Facts& f) { f.contacts().unbounded = 2; },
       {"unbounded: 2 pairs have an unbounded gap, beyond ten times the model's size. "
        "unbounded=2"}},
      {[](Facts& f) { f.contacts().total.solver_errors = 1; },
       {"on_segment: The solver will stop: 1 node lies exactly on a segment (error 611/612). "
        "solver_errors=1"}},
      {[](Facts& f) {
         f.contacts().total.solver_errors = 2;
         f.contacts().total.on_segment = {9, 2, 1};
       },
       {"on_segment: The solver will stop: 2 nodes lie exactly on a segment (error 611/612). "
        "solver_errors=2"}},
      {[](Facts& f) {
         f.contacts().total.on_segment = {9, 3, 2};
       },
       {"on_segment: Exactly on a segment: 3 nodes and 2 edges. on_segment=5"}},
      {[](Facts& f) {
         f.contacts().total.on_segment = {1, 1, 0};
       },
       {"on_segment: Exactly on a segment: 1 node. on_segment=1"}},
      {[](Facts& f) {
         f.contacts().total.tied = {1, 1, 0};
       },
       {"ties: 1 pair tied (1 node). tied_pairs=1 tied_nodes=1"}},
      {[](Facts& f) {
         f.contacts().total.tied = {5, 3, 0};
       },
       {"ties: 5 pairs tied (3 nodes). tied_pairs=5 tied_nodes=3"}},
      {[](Facts& f) { f.contacts().total.untied = 1; },
       {"untied: 1 node of a TYPE10 is not tied: no segment is within reach."}},
      {[](Facts& f) { f.contacts().total.untied = 4; },
       {"untied: 4 nodes of a TYPE10 are not tied: no segment is within reach."}},
      {[](Facts& f) { f.contacts().total.crossed_elements = 0; }, {}},
      {[](Facts& f) { f.contacts().total.crossed_elements = 1; },
       {"crossed: 1 crossed element: an edge of the secondary side passes through a main segment. "
        "crossed_elements=1"}},
      {[](Facts& f) { f.contacts().total.crossed_elements = 3; },
       {"crossed: 3 crossed elements: an edge of the secondary side passes through a main "
        "segment. crossed_elements=3"}},
      {[](Facts& f) { f.contacts().not_evaluated = 1; },
       {"not_evaluated: 1 contact could not be evaluated, see the findings. not_evaluated=1"}},
  };
  for (const auto& [change, lines] : rows) EXPECT_EQ(said_of(change), lines);
}

TEST(VerdictFacts, NamesTheTiesThatLoseNodes) {
  const auto losses = [](std::size_t n, std::uint64_t untied) {
    return said_of([&](Facts& f) {
      f.ties().ties = 9;
      f.ties().nodes = 100;
      f.ties().tied = 90;
      f.ties().untied = untied;
      for (std::size_t i = 0; i < n; ++i)
        f.ties().losses.push_back({static_cast<std::int64_t>(10 + i), 7 - i, 1});
    });
  };
  EXPECT_EQ(losses(1, 1),
            (Lines{"untied_type2: 1 of 7 nodes of TYPE2 10 is not tied. untied_type2_nodes=1"}));
  EXPECT_EQ(losses(2, 3), (Lines{"untied_type2: 3 of 13 nodes of 2 TYPE2 (10, 11) are not tied. "
                                 "untied_type2_nodes=3"}));
  EXPECT_EQ(losses(5, 5), (Lines{"untied_type2: 5 of 25 nodes of 5 TYPE2 (10, 11, 12, 13, 14) are "
                                 "not tied. untied_type2_nodes=5"}));
  EXPECT_EQ(losses(7, 8), (Lines{"untied_type2: 8 of 28 nodes of 7 TYPE2 (10, 11, 12, 13, 14 and 2 "
                                 "more) are not tied. untied_type2_nodes=8"}));
}

TEST(VerdictFacts, TiesSayWhatTheyHoldAndWhereTheSolverStops) {
  const auto ties = [](std::size_t count, std::size_t left_out, std::uint64_t nodes,
                       std::uint64_t tied, std::uint64_t errors, std::uint64_t main) {
    return said_of([&](Facts& f) {
      f.ties().ties = count;
      f.ties().not_evaluated = left_out;
      f.ties().nodes = nodes;
      f.ties().tied = tied;
      f.ties().solver_errors = errors;
      f.ties().main_and_tied = main;
    });
  };
  EXPECT_EQ(ties(0, 1, 5, 5, 1, 1), Lines{}) << "there is no tie";
  EXPECT_EQ(ties(1, 0, 0, 0, 0, 0), Lines{}) << "no node";
  EXPECT_EQ(ties(1, 0, 1, 1, 0, 0),
            (Lines{"tied_type2: 1 node of 1 TYPE2 tied. tied_type2_nodes=1"}));
  EXPECT_EQ(
      ties(3, 1, 8, 6, 1, 1),
      (Lines{"ties_not_evaluated: The nodes of 1 TYPE2 could not be looked at. "
             "ties_not_evaluated=1",
             "tied_type2: 6 nodes of 3 TYPE2 tied. tied_type2_nodes=6",
             "ties_stop: The solver will stop: 1 node is without a main segment (error "
             "1078). tie_errors=1",
             "main_and_tied: The solver will stop: 1 main node of a tie is itself tied (error "
             "556). main_and_tied=1"}));
  EXPECT_EQ(ties(2, 2, 8, 6, 3, 2),
            (Lines{"ties_not_evaluated: The nodes of 2 TYPE2 could not be looked at. "
                   "ties_not_evaluated=2",
                   "ties_stop: The solver will stop: 3 nodes are without a main segment (error "
                   "1078). tie_errors=3",
                   "main_and_tied: The solver will stop: 2 main nodes of ties are themselves tied "
                   "(error 556). main_and_tied=2"}))
      << "all are left out: none is said to be tied";
}

TEST(VerdictFacts, TiesWithoutContactsSpeakOfNoPenetration) {
  const auto lines = [](std::size_t contacts, std::size_t ties) {
    Facts f;
    f.contacts().contacts = contacts;
    f.ties().ties = ties;
    return lines_of(f.verdict());
  };
  const std::string none = "penetrations: No initial penetration in ";
  EXPECT_EQ(lines(0, 1), Lines{});
  EXPECT_EQ(lines(0, 0), Lines{none + "0 contacts. pairs=0 nodes=0 edges=0"});
  EXPECT_EQ(lines(1, 1), Lines{none + "1 contact. pairs=0 nodes=0 edges=0"});
}

// ---- level -------------------------------------------------------------------------------------

TEST(VerdictLevels, TheWorstFactDecides) {
  // From the last to the first: each is added to those before it and takes over.
  Facts f;
  EXPECT_EQ(f.verdict().level, VerdictLevel::clean);
  f.ties().ties = 2;
  f.ties().not_evaluated = 1;
  EXPECT_EQ(f.verdict().level, VerdictLevel::not_examined);
  f.ties().untied = 1;
  EXPECT_EQ(f.verdict().level, VerdictLevel::untied);
  f.contacts().total.crossed_elements = 1;
  EXPECT_EQ(f.verdict().level, VerdictLevel::crossed);
  f.contacts().total.count.pairs = 1;
  EXPECT_EQ(f.verdict().level, VerdictLevel::penetrates);
  EXPECT_FALSE(f.verdict().stops_before_pairs);
  f.ties().solver_errors = 1;
  EXPECT_EQ(f.verdict().level, VerdictLevel::stops);
  EXPECT_FALSE(f.verdict().stops_before_pairs) << "at a node: pairs were looked for";
}

TEST(VerdictLevels, EachFactAloneHasItsLevel) {
  using Row = std::pair<std::function<void(Facts&)>, VerdictLevel>;
  const Row rows[] = {
      {[](Facts& f) { f.contacts().not_evaluated = 1; }, VerdictLevel::not_examined},
      {[](Facts& f) { f.contacts().total.untied = 1; }, VerdictLevel::untied},
      {[](Facts& f) { f.contacts().total.crossed_elements = 0; }, VerdictLevel::clean},
      {[](Facts& f) { f.contacts().total.on_segment.pairs = 1; }, VerdictLevel::clean},
      {[](Facts& f) { f.contacts().total.solver_errors = 1; }, VerdictLevel::stops},
      {[](Facts& f) { f.ties().main_and_tied = 1; }, VerdictLevel::stops},
      {[](Facts& f) { f.ties().solver_errors = 1; }, VerdictLevel::stops},
      {[](Facts& f) { f.ties().solver_errors = f.ties().main_and_tied = 3; }, VerdictLevel::stops},
      {[](Facts& f) { f.ties().tied = 1; }, VerdictLevel::clean},
      {[](Facts& f) { f.error(RuleId::DK100); }, VerdictLevel::stops},
      {[](Facts& f) { f.error(RuleId::DK100, Severity::warning); }, VerdictLevel::clean},
      {[](Facts& f) { f.in.contacts.reset(); }, VerdictLevel::clean},
      {[](Facts& f) { f.in.lint = LintFacts{}; }, VerdictLevel::clean},
      {[](Facts& f) {
         f.in.lint = LintFacts{};
         f.in.contacts.reset();
         f.in.lint->contacts_left_out = true;
       },
       VerdictLevel::not_examined},
      {[](Facts& f) {
         f.in.lint = LintFacts{};
         f.in.lint->contacts_left_out = true;
       },
       VerdictLevel::clean},
      {[](Facts& f) {
         f.in.lint = LintFacts{0, 1, 1, false};
         f.contacts().total.count.pairs = 1;
       },
       VerdictLevel::penetrates},
      // Lint has said it in its errors, or was told not to.
      {[](Facts& f) {
         f.in.lint = LintFacts{};
         f.contacts().total.solver_errors = 1;
         f.contacts().obstacles[static_cast<std::size_t>(Obstacle::no_gap)] = 1;
       },
       VerdictLevel::not_examined},
      {[](Facts& f) {
         f.in.lint = LintFacts{};
         f.error(RuleId::DK100);
       },
       VerdictLevel::clean},
      {[](Facts& f) {
         f.in.lint = LintFacts{0, 0, 1, false};
       },
       VerdictLevel::remarks},
      {[](Facts& f) {
         f.in.lint = LintFacts{0, 1, 0, false};
       },
       VerdictLevel::warnings},
      {[](Facts& f) {
         f.in.lint = LintFacts{1, 0, 0, false};
       },
       VerdictLevel::stops},
      // Without any interface nothing was examined; lint has a rule for that.
      {[](Facts& f) { f.in.interfaces = nullptr; }, VerdictLevel::not_examined},
      {[](Facts& f) {
         f.in.interfaces = nullptr;
         f.in.contacts.reset();
         f.in.lint = LintFacts{};
       },
       VerdictLevel::clean},
  };
  int row = 0;
  for (const auto& [change, level] : rows) EXPECT_EQ(level_with(change), level) << row++;
}

TEST(VerdictLevels, WhatWarnsAndWhatIsOpen) {
  const auto flags = [](const std::function<void(Facts&)>& change) {
    Facts f;
    change(f);
    const Verdict v = f.verdict();
    return std::array{v.stops_before_pairs, v.undecided, v.warns};
  };
  using Flags = std::array<bool, 3>;
  EXPECT_EQ(flags([](Facts&) {}), (Flags{false, false, false}));
  EXPECT_EQ(flags([](Facts& f) { f.contacts().not_evaluated = 1; }), (Flags{false, true, false}));
  EXPECT_EQ(flags([](Facts& f) { f.contacts().total.count.pairs = 1; }),
            (Flags{false, false, true}));
  EXPECT_EQ(flags([](Facts& f) { f.contacts().total.untied = 1; }), (Flags{false, false, true}));
  EXPECT_EQ(flags([](Facts& f) { f.contacts().total.crossed_elements = 1; }),
            (Flags{false, false, true}));
  EXPECT_EQ(flags([](Facts& f) { f.error(RuleId::DK100); }), (Flags{true, false, false}));
  EXPECT_EQ(flags([](Facts& f) { f.contacts().obstacles[3] = 1; }), (Flags{true, false, false}));
  const auto lint = [](const LintFacts& facts) {
    return [facts](Facts& f) {
      f.in.lint = facts;
      f.contacts().not_evaluated = 1;
      f.contacts().total.count.pairs = 1;
      f.contacts().obstacles[3] = 1;
    };
  };
  EXPECT_EQ(flags(lint({0, 0, 1, false})), (Flags{false, false, false}));
  EXPECT_EQ(flags(lint({0, 1, 0, false})), (Flags{false, false, true}));
  EXPECT_EQ(flags(lint({1, 0, 0, false})), (Flags{true, false, false}));
}

TEST(VerdictLevels, HaveTheirNames) {
  const std::string_view names[] = {"stops",        "penetrates", "crossed", "untied",
                                    "not-examined", "warnings",   "remarks", "clean"};
  for (std::size_t i = 0; i < std::size(names); ++i)
    EXPECT_EQ(to_string(static_cast<VerdictLevel>(i)), names[i]);
}

TEST(ExitCode, FollowsFromLevelFlagsAndRules) {
  // Every combination, against the words of ExitRules.
  for (int bits = 0; bits < 1 << 10; ++bits) {
    const auto bit = [&](int i) { return (bits >> i & 1) != 0; };
    Verdict v;
    v.level = static_cast<VerdictLevel>(bits & 7);
    v.stops_before_pairs = bit(3);
    v.undecided = bit(4);
    v.warns = bit(5);
    const ExitRules rules{bit(6), bit(7), bit(8), bit(9)};
    int wanted = 0;
    if (v.level == VerdictLevel::stops && v.stops_before_pairs) wanted = 1;
    if (v.level == VerdictLevel::stops && !rules.pairs_accepted) wanted = 1;
    if (v.warns && rules.on_warning && !rules.pairs_accepted) wanted = 1;
    if (v.undecided) wanted = 1;
    if (rules.never) wanted = 0;
    if (rules.require_examined && v.level == VerdictLevel::not_examined) wanted = 1;
    ASSERT_EQ(exit_code_of(v, rules), wanted) << bits;
  }
}

// ---- errors and lint ---------------------------------------------------------------------------

TEST(VerdictErrors, ThoseOfTheSolverAreSaidApartFromOurOwn) {
  const auto own = [](Facts& f) { f.error(RuleId::DK100); };
  const auto warned = [](Facts& f) { f.error(RuleId::DK101, Severity::error, Severity::warning); };
  const auto solver = [](Facts& f) { f.error(RuleId::DK150, Severity::error, Severity::error); };
  const auto side = [](Facts& f) { f.error(RuleId::DK172, Severity::error, Severity::error); };
  const auto other = [](Facts& f) { f.error(RuleId::DK173, Severity::error, Severity::error); };
  EXPECT_EQ(said_of(own), (Lines{"errors: 1 error in the deck ('deck lint' explains). errors=1"}));
  EXPECT_EQ(said_of([&](Facts& f) {
              own(f);
              warned(f);
              side(f);
            }),
            (Lines{"errors: 2 errors in the deck ('deck lint' explains). errors=3"}));
  EXPECT_EQ(said_of(solver), (Lines{"errors: The solver stops first: 1 error in the deck ('deck "
                                    "lint' explains). errors=1"}));
  EXPECT_EQ(said_of([&](Facts& f) {
              solver(f);
              solver(f);
              own(f);
              other(f);
            }),
            (Lines{"errors: The solver stops first: 2 errors in the deck ('deck lint' explains). "
                   "errors=4"}));
  for (const RuleId rule : {RuleId::DK172, RuleId::DK173}) {
    Facts f;
    f.error(rule, Severity::error, Severity::error);
    EXPECT_EQ(lines_of(f.verdict()).size(), 1u) << "an empty side is named by itself";
    EXPECT_EQ(f.verdict().count("errors"), 1u);
    EXPECT_EQ(f.verdict().level, VerdictLevel::stops);
  }
}

TEST(VerdictErrors, LintSaysItsOwnCountsFirst) {
  const auto first = [](const LintFacts& lint) {
    Facts f;
    f.in.lint = lint;
    f.error(RuleId::DK100);  // which lint may have been told to leave out
    const Lines lines = lines_of(f.verdict());
    EXPECT_EQ(lines.size(), lint.contacts_left_out ? 3u : 2u);
    EXPECT_EQ(f.verdict().count("errors"), lint.errors);
    if (lint.contacts_left_out) {
      EXPECT_EQ(lines.back(),
                "left_out: The contacts were not examined: too large for a quick look "
                "(--geometry).");
    }
    return lines.front();
  };
  EXPECT_EQ(first({0, 0, 0, false}), "lint: clean. errors=0 warnings=0 remarks=0");
  EXPECT_EQ(first({0, 0, 1, false}), "lint: clean (1 remark: -v). errors=0 warnings=0 remarks=1");
  EXPECT_EQ(first({0, 1, 0, true}), "lint: 0 errors, 1 warning. errors=0 warnings=1 remarks=0");
  EXPECT_EQ(first({3, 5, 7, false}),
            "lint: 3 errors, 5 warnings, 7 remarks. errors=3 warnings=5 remarks=7");
}

// ---- counts ------------------------------------------------------------------------------------

TEST(VerdictCounts, AreAllThereOnceInTheirOrder) {
  Facts f;
  ContactFacts& c = f.contacts();
  c.contacts = 30;
  c.not_evaluated = 7;
  c.obstacles[6] = 2;
  c.total.count = {11, 5, 3};
  c.total.solver_errors = 4;
  c.total.tied = {13, 8, 0};
  c.total.untied = 6;
  c.total.crossed_elements = 9;
  f.ties().ties = 1;
  f.ties().untied = 10;
  f.ties().losses = {{5, 12, 10}};
  f.error(RuleId::DK100);
  EXPECT_EQ(f.verdict().counts, (deck::VerdictCounts{{"interfaces", 1},
                                                     {"interfaces_not_examined", 0},
                                                     {"contacts", 30},
                                                     {"not_evaluated", 7},
                                                     {"pairs", 11},
                                                     {"nodes", 5},
                                                     {"edges", 3},
                                                     {"solver_errors", 4},
                                                     {"tied_pairs", 13},
                                                     {"tied_nodes", 8},
                                                     {"untied_nodes", 16},
                                                     {"crossed_elements", 9},
                                                     {"errors", 1},
                                                     {"without_stiffness", 2},
                                                     {"untied_type2_nodes", 10}}));
  EXPECT_EQ(f.verdict().count("edges"), 3u);
  EXPECT_EQ(f.verdict().count("hedges"), 0u);
}

TEST(VerdictCounts, SayOnlyWhatWasLookedAt) {
  Facts f;
  f.in.contacts.reset();
  f.in.lint = LintFacts{0, 2, 3, false};
  EXPECT_EQ(f.verdict().counts, (deck::VerdictCounts{{"interfaces", 1},
                                                     {"interfaces_not_examined", 0},
                                                     {"errors", 0},
                                                     {"warnings", 2},
                                                     {"remarks", 3}}));
  f.in.interfaces = nullptr;
  f.in.lint.reset();
  EXPECT_EQ(f.verdict().counts, (deck::VerdictCounts{{"errors", 0}}));
}

// ---- what was not examined ---------------------------------------------------------------------

TEST(VerdictCoverage, InterfacesOfOtherTypesComeLast) {
  Plates p;
  p.card =
      "Gapmin=0.1\n/INTER/TYPE23/9\nother\n         1         2\n/INTER/TYPE23/12\nother\n"
      "         1         2";
  const Inspected d(plates(p));
  VerdictInput in;
  in.deck = &d.deck;
  in.interfaces = &d.interfaces;
  EXPECT_EQ(lines_of(make_verdict(in)), Lines{}) << "contacts are not spoken of";
  EXPECT_EQ(make_verdict(in).level, VerdictLevel::clean);
  in.contacts.emplace().contacts = 1;
  EXPECT_EQ(lines_of(make_verdict(in)),
            (Lines{"penetrations: No initial penetration in 1 contact. pairs=0 nodes=0 edges=0",
                   "not_examined: Not examined: 2 interfaces of TYPE23 (ids 9, 12)."}));
  EXPECT_EQ(make_verdict(in).count("interfaces"), 1u);
  EXPECT_EQ(make_verdict(in).count("interfaces_not_examined"), 2u);
  EXPECT_EQ(make_verdict(in).level, VerdictLevel::not_examined);
}

TEST(VerdictCoverage, ADeckWithoutInterfacesOrWithoutAFileHasNoVerdict) {
  const auto verdict = [](const std::string& more, bool tie) {
    SmallDeck small;
    small.node(1, 0, 0, 0).node(2, 1, 0, 0).node(3, 1, 1, 0).node(4, 0, 1, 0);
    small.shell_part(1, 1.0).shell(1, 1, 1, 2, 3, 4).group("/SURF/PART/1", {1});
    small.node(11, .3, .3, .1).group("/GRNOD/NODE/2", {11}).add(more);
    if (tie) small.add("@/INTER/TYPE2/4 grnd_IDs=2 surf_IDm=1 dsearch=1");
    const Inspected d(small.text());
    VerdictInput in;
    in.deck = &d.deck;
    in.interfaces = &d.interfaces;
    in.contacts.emplace();
    if (tie) in.contacts->ties = tie_facts(d.loaded.ties());
    return make_verdict(in);
  };
  const Verdict none = verdict("", false), other = verdict("/INTER/TYPE23/9\no\n", false);
  EXPECT_EQ(lines_of(none),
            (Lines{"nothing_examined: Nothing examined: the deck has no contact interface."}));
  EXPECT_EQ(none.level, VerdictLevel::not_examined);
  EXPECT_EQ(lines_of(other),
            (Lines{"nothing_examined: Nothing examined: 1 interface of TYPE23 (id 9)."}));
  const Verdict tied = verdict("", true);
  EXPECT_EQ(lines_of(tied), (Lines{"tied_type2: 1 node of 1 TYPE2 tied. tied_type2_nodes=1"}));
  EXPECT_EQ(tied.level, VerdictLevel::clean);
  EXPECT_EQ(tied.count("interfaces"), 1u) << "ties count where they were looked for";
  const Verdict broken = verdict("#include none.inc", true);
  EXPECT_EQ(lines_of(broken), (Lines{"no_verdict: No verdict: the model is incomplete, '#include "
                                     "none.inc' could not be read."}))
      << "and nothing of errors, which may be those of what is missing";
  EXPECT_EQ(broken.level, VerdictLevel::stops) << "a missing file is an error";
}

// ---- from scenes -------------------------------------------------------------------------------

TEST(ContactFactsOf, TakesTheDeepestPairWhoseGapIsBounded) {
  const Inspected d(Facts::apart());
  const double bound = largest_bounded_gap(d.model);
  Scene scene;
  scene.model = &d.model;
  scene.contacts.assign(3, d.scene.contacts[0]);
  scene.contacts[1].evaluated = false;
  scene.contacts[2].gapmin = 0;
  const auto row = [](double depth, double gap) {
    PenetrationRow r;
    r.depth = depth;
    r.gap = gap;
    return r;
  };
  scene.contacts[0].penetrations = {row(3, std::nextafter(bound, 2 * bound)), row(1, 7)};
  scene.contacts[2].penetrations = {row(2, bound), row(5, NAN)};
  SceneView view;
  view.total.acted = 17;
  for (const auto& [contact, at] : {std::pair(2u, 1u), {0u, 0u}, {2u, 0u}, {0u, 1u}}) {
    view.penetrations.emplace_back().contact = contact;
    view.penetrations.back().row = at;
  }
  ContactFacts f = contact_facts(scene, view);
  EXPECT_EQ(f.contacts, 3u);
  EXPECT_EQ(f.not_evaluated, 1u);
  EXPECT_EQ(f.obstacles, (std::array<std::size_t, 7>{1, 0, 0, 1, 0, 0, 0}));
  EXPECT_EQ(f.total.acted, 17u);
  EXPECT_EQ(f.unbounded, 2u);
  EXPECT_EQ(f.deepest, 2);
  EXPECT_EQ(f.deepest_gap, bound);
  EXPECT_FALSE(f.ties);
  scene.examined = Examined::contacts_and_ties;
  f = contact_facts(scene, view);
  ASSERT_TRUE(f.ties);
  EXPECT_EQ(f.ties->ties, 0u);
}

/// A tie with one node for each (tied, segment, removed_by, message).
Tie tie_of(const InterType2& inter, const std::vector<std::array<int, 4>>& nodes,
           const std::vector<NodeIndex>& main_and_tied = {}, const std::string& why = "") {
  Tie out;
  out.inter = &inter;
  out.main.resize(1);
  for (const auto& [tied, segment, removed, message] : nodes) {
    TiedNode& n = out.nodes.emplace_back();
    n.node = static_cast<NodeIndex>(out.nodes.size());
    n.tied = tied != 0;
    n.segment = segment < 0 ? no_index : static_cast<std::uint32_t>(segment);
    n.removed_by = removed;
    n.message = message;
  }
  out.main_and_tied = main_and_tied;
  out.not_evaluated = why;
  return out;
}

TEST(TieFactsOf, CountNodesOfAllTiesAndMainNodesOnce) {
  InterType2 a, b, c;
  a.id = 5;
  b.id = 6;
  c.id = 7;
  const TieFacts f = tie_facts(
      {tie_of(a, {{1, 0, 0, 0}, {0, -1, 0, 1078}, {0, 0, 0, 1078}, {0, 0, 1630, 0}}, {3, 4}),
       tie_of(b, {{1, 0, 0, 0}, {1, 0, 0, 0}}, {4, 9}),
       tie_of(c, {{0, -1, 0, 1078}}, {11}, "no surface"), tie_of(b, {{0, -1, 0, 1079}})});
  EXPECT_EQ(f.ties, 4u);
  EXPECT_EQ(f.not_evaluated, 1u);
  EXPECT_EQ(f.nodes, 7u);
  EXPECT_EQ(f.tied, 3u);
  EXPECT_EQ(f.untied, 3u);
  EXPECT_EQ(f.solver_errors, 2u);
  EXPECT_EQ(f.main_and_tied, 3u);
  ASSERT_EQ(f.losses.size(), 2u);
  EXPECT_EQ(f.losses[0].id, 5);
  EXPECT_EQ(f.losses[0].nodes, 4u);
  EXPECT_EQ(f.losses[0].untied, 2u);
  EXPECT_EQ(f.losses[1].id, 6);
  EXPECT_EQ(f.losses[1].nodes, 1u);
  EXPECT_EQ(f.losses[1].untied, 1u);
}

TEST(TieFactsOf, ATieAloneHasTheLevelOfWhatItSays) {
  const InterType2 inter;
  EXPECT_EQ(level_of_tie(tie_of(inter, {{1, 0, 0, 0}})), VerdictLevel::clean);
  EXPECT_EQ(level_of_tie(tie_of(inter, {{1, 0, 0, 0}, {0, -1, 0, 1079}})), VerdictLevel::untied);
  EXPECT_EQ(level_of_tie(tie_of(inter, {{1, 0, 0, 0}, {0, -1, 0, 1078}})), VerdictLevel::stops);
  EXPECT_EQ(level_of_tie(tie_of(inter, {{1, 0, 0, 0}}, {8})), VerdictLevel::stops);
  EXPECT_EQ(level_of_tie(tie_of(inter, {}, {}, "why")), VerdictLevel::not_examined);
}

TEST(InterfaceVerdict, AddsUpTheContactsOfItsInterfaceAlone) {
  const Inspected d(Facts::apart());
  const InterType7 own, other;
  const auto level = [&](const std::function<void(ContactTotals&)>& change, std::size_t which) {
    Scene scene;
    scene.contacts.assign(4, d.scene.contacts[0]);
    for (Contact& c : scene.contacts) c.inter = &own;
    scene.contacts[1].inter = &other;
    SceneView view;
    view.contacts.resize(4);
    view.contacts[0].max_depth = 2;
    view.contacts[1].max_depth = 9;
    view.contacts[2].max_depth = 3;
    view.contacts[2].max_ratio = 0.25;
    view.contacts[3].max_ratio = 0.125;
    change(view.contacts[which]);
    const InterfaceVerdict v = verdict_of_interface(scene, view, own);
    EXPECT_EQ(v.max_depth, 3);
    EXPECT_EQ(v.max_ratio, 0.25);
    return v.level;
  };
  const std::pair<std::function<void(ContactTotals&)>, VerdictLevel> facts[] = {
      {[](ContactTotals& t) { t.count.pairs = 1; }, VerdictLevel::penetrates},
      {[](ContactTotals& t) { t.untied = 1; }, VerdictLevel::untied},
      {[](ContactTotals& t) { t.solver_errors = 1; }, VerdictLevel::stops},
      {[](ContactTotals& t) { t.crossed_elements = 1; }, VerdictLevel::crossed},
      {[](ContactTotals&) {}, VerdictLevel::clean}};
  for (const auto& [change, wanted] : facts)
    for (std::size_t which = 0; which < 4; ++which)
      EXPECT_EQ(level(change, which), which == 1 ? VerdictLevel::clean : wanted) << which;
}

TEST(InterfaceVerdict, HasTheObstaclesOfItsOwnContacts) {
  const Inspected d(Facts::apart());
  const InterType7 own, other;
  Scene scene;
  scene.contacts.assign(2, d.scene.contacts[0]);
  scene.contacts[0].inter = &own;
  scene.contacts[1].inter = &other;
  scene.contacts[1].gapmin = 0;
  SceneView view;
  view.contacts.resize(2);
  EXPECT_EQ(verdict_of_interface(scene, view, own).level, VerdictLevel::clean);
  EXPECT_EQ(verdict_of_interface(scene, view, other).level, VerdictLevel::stops);
  scene.contacts[1].evaluated = false;
  EXPECT_EQ(verdict_of_interface(scene, view, other).level, VerdictLevel::not_examined);
}

TEST(Verdict, OfALoadedDeckLooksForTiesAndCrossedElements) {
  // A tie at parts 1 and 2, and a shell that stands through the plate of part 1.
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(11, 5, 3, -5).node(12, 5, 7, -5).node(13, 5, 7, 5).node(14, 5, 3, 5);
  d.node(21, 3, 3, 0.25).node(22, 3, 4, 0.25);
  d.shell_part(1, 1.0).shell(1, 1, 1, 2, 3, 4);
  d.shell_part(2, 1.0).shell(2, 2, 11, 12, 13, 14);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/PART/2", {2}).group("/GRNOD/NODE/3", {21, 22});
  d.add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=0.5");
  d.add("@/INTER/TYPE2/2 grnd_IDs=3 surf_IDm=1 dsearch=1");
  const Inspected i(d.text());
  const Verdict v = verdict_of(i.loaded);
  EXPECT_EQ(v.level, VerdictLevel::crossed);
  EXPECT_EQ(lines_of(v),
            (Lines{"penetrations: No initial penetration in 1 contact. pairs=0 nodes=0 edges=0",
                   "crossed: 2 crossed elements: an edge of the secondary side passes through a "
                   "main segment. crossed_elements=2",  // by two of its edges
                   "tied_type2: 2 nodes of 1 TYPE2 tied. tied_type2_nodes=2"}));
  EXPECT_EQ(v.count("interfaces"), 2u);
  const Verdict contacts = verdict_of(i.deck, i.scene, i.view);
  EXPECT_EQ(lines_of(contacts),
            (Lines{"penetrations: No initial penetration in 1 contact. pairs=0 nodes=0 edges=0",
                   "not_examined: Not examined: 1 interface of TYPE2 (id 2)."}));
}

}  // namespace
}  // namespace deck::test
