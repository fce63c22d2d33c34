// Rule: one thing that can be said about a deck, under a stable id, with the page that explains it.
// The pages are the files of schemas/rules; what a finding says beyond its own message comes from
// its page.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text/diagnostic.hpp"
#include "deck/text/rule_id.hpp"

namespace deck {
/// Who finds the violations of a rule.
enum class RuleStage : std::uint8_t {
  reading,  ///< bytes to blocks, cells to values
  model,    ///< nodes, elements, groups, interfaces
  check,    ///< a check of the lint stage
  extra,    ///< the extra checks of run_lint (geometry)
  gate,     ///< bounds that a team has set (lint/shared/gate.hpp)
  linter,   ///< the linter itself: suppressions, baseline
};

enum class Fixable : std::uint8_t { no, safe, unsafe };

/// A field of a rule that says the same of several, and what the page says of this field alone.
struct RuleField {
  std::string name;           ///< "Istf"
  RuleId was = RuleId::none;  ///< the rule that it had for itself once; else the rule's own id
  std::optional<Severity> severity = {};  ///< if it is not that of the rule
  std::string note = {};                  ///< when, or why; empty: nothing particular
  std::string solver = {}, fix = {};      ///< empty: as for the others
};

/// The page of a rule. All text is the project's own; `bad` and `good` are examples in the notation
/// of lint/shared/example.hpp and are run by the tests.
struct Rule {
  RuleId id = RuleId::none;  ///< never reused
  std::string name;          ///< "renard-curve": unique, accepted wherever an id is
  std::string title;         ///< one line
  /// What its findings are; the first one is the rule, the others are cases that the page tells.
  std::vector<Severity> severities;
  RuleStage stage = RuleStage::check;
  std::string problem;  ///< what is wrong
  std::string why;      ///< why it matters, formula
  std::string solver;   ///< what the reference solver does with it
  /// The reference solver's messages for it; the first one is the rule. Empty: it has none.
  std::vector<ReferenceMessage> messages;
  std::string fix;     ///< how to repair it
  std::string ignore;  ///< when the finding may be ignored; empty: never
  Fixable fixable = Fixable::no;
  bool absence = false;  ///< says that something is absent, which a missing include may hold
  std::string bad, good;
  /// Numbers of the interface types that it is true for ("19": for some part of a TYPE19); empty:
  /// it is not about interfaces of these types.
  std::vector<int> types;
  std::vector<RuleField> fields;  ///< that its findings are about; empty: it is about none
  /// What shows that the solver does what `solver` says: a run, a record, ...; empty: no claim.
  std::string source;
  /// Keys of a rule that is a predicate of cells (lint/cell_rule.hpp): those of the page, then those
  /// of each of its cases. Empty: another rule.
  std::vector<std::map<std::string, std::string, std::less<>>> cells;
  /// Exceptions: covers, only_where, zeros, flag, except (see lint/lint.cpp, lint/checks/values.cpp).
  std::map<std::string, std::vector<std::string>, std::less<>> exceptions;

  Severity severity() const { return severities.front(); }
  /// nullptr: the rule is not about this field.
  const RuleField* field(std::string_view field_name) const;
  /// The page has `item` in the list of that key of `exceptions`.
  bool lists(std::string_view key, std::string_view item) const;
  /// The solver's message of that number; it is on the page.
  ReferenceMessage message(int number) const;
};

/// All rules, ordered by id. Parsed when first asked for; never changes.
const std::vector<Rule>& all_rules();
/// By id or by name. nullptr: no such rule.
const Rule* find_rule(std::string_view id_or_name);
/// The page of an id that is not RuleId::none.
const Rule& rule_of(RuleId id);
/// The rule that says now what the rule of this id said ("DK202"); nullptr: there was none.
const Rule* find_successor(std::string_view id);

/// What a finding says otherwise than its page, which tells the case: one of the page's severities
/// and messages (0: the solver says nothing), and what holds in this case only.
struct Case {
  std::string_view field = {};  ///< of a rule that has fields
  std::optional<Severity> severity = {};
  std::optional<int> message = {};
  std::string solver = {};  ///< empty: as on the page
  std::string fix = {};     ///< likewise
};

/// A finding with what the page of its rule says.
Diagnostic finding_of(RuleId id, Span span, std::string message, Case particular = {});

/// The rules of a gate: bounds that a team sets. Whatever --fail-on says, a finding of these ends
/// with 1, and none of them is an error of the deck.
inline constexpr RuleId gate_rules[] = {RuleId::DK370, RuleId::DK371, RuleId::DK372, RuleId::DK373,
                                        RuleId::DK374, RuleId::DK375, RuleId::DK376};
constexpr bool is_gate_rule(RuleId rule) {
  for (const RuleId gate : gate_rules)
    if (gate == rule) return true;
  return false;
}

}  // namespace deck
