// Pages of the rules that geometry checks report through LintInput::extra_checks. Add a rule here
// and report it from the check; the engine does the rest.
#include "lint/rule_tables.hpp"

namespace deck::detail {
namespace {

void add_geometry_1(std::vector<Rule>& out) {
  out.push_back({.id = "DK390",
                 .title = "too many pairs within gap",
                 .severity = Severity::error,
                 .stage = RuleStage::extra,
                 .problem = "More pairs of an interface are within gap than can be evaluated.",
                 .why = "The gap is large against the whole model, often a unit mistake.",
                 .solver = "it allocates memory for all of them or stops",
                 .fix = "check the gap against the size of the model",
                 .ignore = "Never."});
}

}  // namespace

void add_geometry_rules(std::vector<Rule>& out) { add_geometry_1(out); }

}  // namespace deck::detail
