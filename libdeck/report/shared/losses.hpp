// The loss report of a conversion: what was kept, approximated, dropped, or waits for a decision.
#pragma once
#include <string>
#include <vector>

#include "deck/edit/rewrite.hpp"
#include "report/shared/json.hpp"

namespace deck {

/// Schema id "deck/losses": {"kept":[..],"approximated":[..],"dropped":[..],"undecided":[..]}.
std::string losses_json(const std::vector<LossEntry>& losses);
/// Only the four lists, as members of the object that is open.
void write_loss_lists(JsonWriter& json, const std::vector<LossEntry>& losses);

}  // namespace deck
