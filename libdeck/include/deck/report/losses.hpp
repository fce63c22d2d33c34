// The loss report of a conversion: what was kept, approximated, dropped, or waits for a decision.
#pragma once
#include <string>
#include <vector>

#include "deck/edit/rewrite.hpp"

namespace deck {

/// Schema id "deck/losses": {"kept":[..],"approximated":[..],"dropped":[..],"undecided":[..]}.
std::string losses_json(const std::vector<LossEntry>& losses);

}  // namespace deck
