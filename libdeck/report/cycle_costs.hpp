// What the effects of the force stage cost, as pieces of the reports around it. Private to the
// stage.
#pragma once
#include <optional>
#include <string>

#include "report/record.hpp"
#include "report/shared/cycle.hpp"

namespace deck {

/// The loops of all contacts that were timed, by pairs.
struct CostSummary {
  std::size_t contacts = 0;       ///< timed
  std::size_t pairs = 0;          ///< of these
  std::size_t wider = 0;          ///< contacts whose pairs are further apart than their gap
  std::size_t on = 0, known = 0;  ///< effects that some interface asks for, and all that there are
  double loop_ns = 0, flags_ns = 0, all_ns = 0;  ///< per pair; all_ns 0: no such loop anywhere
};
CostSummary summarize_costs(const CycleInput& input);

/// "9 of 29 effects run; they take 42 ns a pair, all would take 174." Always; without times where
/// nothing or too little was measured.
std::string short_cost_sentence(const CycleInput& input);
/// What the measurement says, in one sentence.
std::string cost_sentence(const CycleInput& input);
/// The loop over the pairs of one contact; null where nothing was measured.
std::optional<ContactCost> measured_cost(const CycleInput& input,
                                         const cycle::ContactOutcome& contact);
Record<ContactCost> record_of(const ContactCost*);
/// Of all contacts together; null where nothing was measured.
struct CostsRow {
  const CycleInput* input = nullptr;
  CostSummary sums;
};
std::optional<CostsRow> measured_costs(const CycleInput& input);
Record<CostsRow> record_of(const CostsRow*);
/// A table of contacts, and one of the effects that run; empty: nothing was measured.
std::string cost_text(const CycleInput& input, const CycleTextOptions& options);
/// The tables of the page for readers without scripts.
std::string cost_html(const CycleInput& input);

}  // namespace deck
