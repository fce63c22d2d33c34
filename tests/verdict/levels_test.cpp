// The level of the verdict on facts that are written down here, and the exit code.

#include <functional>

#include "deck/rule_id.hpp"
#include "deck/verdict.hpp"
#include "report/inspected.hpp"
#include "verdict/shared/of_interface.hpp"

namespace deck::test {
namespace {

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
    Finding finding;
    finding.rule = rule;
    finding.severity = severity;
    if (of_solver) finding.reference = ReferenceMessage{7, *of_solver};
    d.loaded.deck().findings.report(finding);
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

VerdictLevel level_with(const std::function<void(Facts&)>& change) {
  Facts f;
  change(f);
  return f.verdict().level;
}

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
  EXPECT_EQ(f.verdict().sentences.front().what, "ties_stop") << f.verdict().text;
  EXPECT_FALSE(f.verdict().stops_before_pairs) << "at a node: pairs were looked for";
}

TEST(VerdictLevels, EachFactAloneHasItsLevel) {
  using Row = std::pair<std::function<void(Facts&)>, VerdictLevel>;
  const auto lint = [](const LintFacts& facts, std::size_t pairs = 0) {
    return [facts, pairs](Facts& f) {
      f.in.lint = facts;
      f.contacts().total.count.pairs = pairs;
    };
  };
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
      {lint({}), VerdictLevel::clean},
      {lint({0, 0, 0, true}), VerdictLevel::clean},
      {lint({0, 0, 1, false}), VerdictLevel::remarks},
      {lint({0, 1, 0, false}), VerdictLevel::warnings},
      {lint({0, 1, 1, false}, 1), VerdictLevel::penetrates},
      {lint({1, 0, 0, false}), VerdictLevel::stops},
      {[](Facts& f) {
         f.in.lint = LintFacts{0, 0, 0, true};
         f.in.contacts.reset();
       },
       VerdictLevel::not_examined},
      // Lint has said it in its errors, or was told not to.
      {[](Facts& f) {
         f.in.lint = LintFacts{};
         f.contacts().total.solver_errors = 1;
         f.contacts().not_clean[static_cast<std::size_t>(NotCleanReason::no_gap)] = 1;
       },
       VerdictLevel::not_examined},
      {[](Facts& f) {
         f.in.lint = LintFacts{};
         f.error(RuleId::DK100);
       },
       VerdictLevel::clean},
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
  EXPECT_EQ(flags([](Facts& f) { f.contacts().not_clean[3] = 1; }), (Flags{true, false, false}));
  const auto lint = [](const LintFacts& facts, std::size_t left_out = 0) {
    return [facts, left_out](Facts& f) {
      f.in.lint = facts;
      f.contacts().not_evaluated = 1;
      f.contacts().left_out = left_out;
      f.contacts().total.count.pairs = 1;
      f.contacts().not_clean[3] = 1;
    };
  };
  EXPECT_EQ(flags(lint({0, 0, 1, false})), (Flags{false, true, false}));
  EXPECT_EQ(flags(lint({0, 0, 1, false}, 1)), (Flags{false, false, false})) << "a quick look";
  EXPECT_EQ(flags(lint({0, 1, 0, false})), (Flags{false, true, true}));
  EXPECT_EQ(flags(lint({1, 0, 0, false})), (Flags{true, true, false}));
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

}  // namespace
}  // namespace deck::test
