// Which function looks for the violations of which rule: one table per file of checks. Private to
// the lint stage.
#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "deck/lint/lint.hpp"

namespace deck::detail {

/// True if f(field) holds for a field of the rule; f("") for a rule without fields.
template <class F>
bool any_name(const Rule& rule, F&& f) {
  if (rule.fields.empty()) return f(std::string_view());
  return std::any_of(rule.fields.begin(), rule.fields.end(),
                     [&](const RuleField& field) { return f(std::string_view(field.name)); });
}

struct Checked {
  RuleId id;
  void (*check)(const LintContext&, const Rule&, Reporter&);
};

std::span<const Checked> cell_checks();         // predicates of cells, on the pages of rules
std::span<const Checked> header_checks();       // keywords, titles, versions
std::span<const Checked> target_checks();       // ids of loads
std::span<const Checked> history_checks();      // time histories
std::span<const Checked> physics_checks();      // density, stiffness, mass
std::span<const Checked> element_checks();      // elements, functions
std::span<const Checked> reference_checks();    // what interfaces refer to
std::span<const Checked> friction_checks();     // pairs of parts of a /FRICTION
std::span<const Checked> flag_checks();         // legal values of flags
std::span<const Checked> value_checks();        // ranges of numbers
std::span<const Checked> load_checks();         // loads, walls, particles (SPH)
std::span<const Checked> line_checks();         // optional lines
std::span<const Checked> combination_checks();  // fields that contradict
std::span<const Checked> ignored_checks();      // fields without effect
std::span<const Checked> manual_checks();       // where manual and solver differ
std::span<const Checked> difference_checks();   // what the solver does silently otherwise
std::span<const Checked> companion_checks();    // what belongs beside a contact
std::span<const Checked> default_checks();      // /DEFAULT/INTER
std::span<const Checked> advice_checks();       // known traps
std::span<const Checked> engine_checks();       // Engine files beside the deck
std::span<const Checked> kinematic_checks();    // conditions that hold the same node
std::span<const Checked> sense_checks();        // units, volumes, masses of the model
std::span<const Checked> listing_checks();      // what the solver says in its listing only

/// All of them, ordered by id.
const std::vector<Checked>& all_checks();

/// A check of single blocks. Every block is decoded once for all the checks that want its keyword.
struct BlockChecked {
  RuleId id;
  bool (*wants)(const Rule&, const Schema&);
  void (*check)(const LintContext&, const Rule&, Reporter&, const DecodedBlock&);
};

std::span<const BlockChecked> limit_checks();  // values of which the solver speaks
std::span<const BlockChecked> bound_checks();  // what schemas allow elsewhere

const std::vector<BlockChecked>& all_block_checks();

}  // namespace deck::detail
