// Rule: one thing the linter can say about a deck, under a stable id, with the page that explains
// it. Some rules are found while reading or building the model; the others have a check of their
// own.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword/schema.hpp"
#include "deck/text/diagnostic.hpp"

namespace deck {

class LintContext;
class Reporter;

/// Who finds the violations of a rule.
enum class RuleStage : std::uint8_t {
  reading,  ///< bytes to blocks, cells to values
  model,    ///< nodes, elements, groups, interfaces
  check,    ///< Rule::check
  extra,    ///< LintInput::extra_checks (geometry)
  linter,   ///< the linter itself: suppressions, baseline
};

enum class Fixable : std::uint8_t { no, safe, unsafe };

/// All text is the project's own; `bad` and `good` are examples in the notation of example.hpp and
/// are run by the tests.
struct Rule {
  std::string_view id = {};     ///< "DK203"; never reused
  std::string_view title = {};  ///< one line
  Severity severity = Severity::warning;
  RuleStage stage = RuleStage::check;
  std::string_view problem = {};  ///< what is wrong
  std::string_view why = {};      ///< why it matters, formula
  std::string_view solver = {};   ///< what the reference solver does with it
  int message = 0;                ///< its message number, 0: none
  Severity message_severity = Severity::warning;
  std::string_view fix = {};     ///< how to repair it
  std::string_view ignore = {};  ///< when the finding may be ignored
  Fixable fixable = Fixable::no;
  std::string_view bad = {}, good = {};
  /// Numbers of the interface types that it is true for ("19": for some part of a TYPE19); empty:
  /// it is not about interfaces of these types.
  std::vector<int> types = {};
  void (*check)(const LintContext&, const Rule&, Reporter&) = nullptr;
};

/// Family of a rule id by its leading digit: "syntax, columns, version" for DK0xx, and so on.
std::string_view family_of(std::string_view rule_id);
/// All rules, ordered by id. The table is built once and never changes.
const std::vector<Rule>& all_rules();
/// nullptr: no such rule.
const Rule* find_rule(std::string_view id);
/// True if `selector` ("DK2", "DK203", "all") names the rule.
bool selects(std::string_view selector, std::string_view rule_id);
/// True if some rule matches the selector.
bool known_selector(std::string_view selector);

/// The explain page of a rule as plain text.
std::string explain_rule(const Rule& rule, const SchemaSet& schemas);
/// The page of a keyword, or of one of its fields if `field` is not empty: columns per version,
/// type, legal values, default, dimension, notes. Empty string: no such field.
std::string explain_keyword(const Schema& schema, std::string_view field = {});

}  // namespace deck
