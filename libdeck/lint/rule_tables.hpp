// The tables all_rules() is made of, one per file. Private to the lint stage.
#pragma once
#include <string_view>
#include <vector>

#include "deck/lint/rule.hpp"

namespace deck::detail {

void add_reading_rules(std::vector<Rule>& out);        // DK001-DK039: found by the keyword stage
void add_header_rules(std::vector<Rule>& out);         // DK040-DK059: keywords, titles, versions
void add_linter_rules(std::vector<Rule>& out);         // DK090-DK099: suppressions
void add_model_rules(std::vector<Rule>& out);          // DK100-DK159: found by the model stage
void add_target_demand_rules(std::vector<Rule>& out);  // DK120-DK122, DK128: ids of loads
void add_physics_rules(std::vector<Rule>& out);      // DK123-DK127, DK134: density, stiffness, mass
void add_element_rules(std::vector<Rule>& out);      // DK129-DK133: elements, functions
void add_reference_rules(std::vector<Rule>& out);    // DK160-DK189: what interfaces refer to
void add_flag_rules(std::vector<Rule>& out);         // DK201-DK219: legal values of flags
void add_value_rules(std::vector<Rule>& out);        // DK220-DK239: ranges of numbers
void add_line_rules(std::vector<Rule>& out);         // DK240-DK249: optional lines
void add_combination_rules(std::vector<Rule>& out);  // DK250-DK264: fields that contradict
void add_ignored_rules(std::vector<Rule>& out);      // DK265-DK285: fields without effect
void add_manual_rules(std::vector<Rule>& out);       // DK286-DK299: where manual and solver differ
void add_difference_rules(std::vector<Rule>& out);   // what the solver does silently otherwise
void add_companion_rules(std::vector<Rule>& out);    // DK916-DK919: what belongs beside a contact
void add_geometry_rules(std::vector<Rule>& out);     // DK3xx: found by extra checks
void add_geometry_segment_rules(std::vector<Rule>& out);  // part of the geometry
void add_geometry_manual_rules(std::vector<Rule>& out);   // part of the geometry
void add_bound_rules(std::vector<Rule>& out);          // DK332-DK335, DK380, DK381: out of bounds
void add_cycle_rules(std::vector<Rule>& out);          // DK4xx, part of the geometry
void add_default_rules(std::vector<Rule>& out);        // DK5xx: /DEFAULT/INTER
void add_advice_rules(std::vector<Rule>& out);         // DK9xx: known traps
void add_friction_pair_rules(std::vector<Rule>& out);  // DK183-DK188, part of the references

/// The types that a rule is true for, by its id; empty: it is not about interfaces.
std::vector<int> interface_types_of(std::string_view rule);  // rules_types.cpp

/// A rule that looks at the cards, from its page and its check.
inline void add(std::vector<Rule>& out, std::string_view id, Severity severity,
                std::string_view title, std::string_view problem, std::string_view why,
                std::string_view solver, std::string_view fix, std::string_view ignore,
                std::string_view bad, std::string_view good,
                void (*check)(const LintContext&, const Rule&, Reporter&),
                Fixable fixable = Fixable::no) {
  out.push_back({.id = id,
                 .title = title,
                 .severity = severity,
                 .problem = problem,
                 .why = why,
                 .solver = solver,
                 .fix = fix,
                 .ignore = ignore,
                 .fixable = fixable,
                 .bad = bad,
                 .good = good,
                 .check = check});
}

}  // namespace deck::detail
