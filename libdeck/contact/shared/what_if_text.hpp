// Other values for an interface as people write them.
#pragma once
#include <string>

#include "deck/contacts.hpp"
#include "deck/model.hpp"
#include "deck/text.hpp"

namespace deck {

/// "ID:Gapmin=2,Inacti=6" as values; the error says what is wrong with it.
Result<WhatIf> parse_what_if(const std::string& text);
/// Refuses values that the cells of the interface cannot hold, and fields that it does not have.
Result<void> check_what_if(const WhatIf& w, const InterBase& inter);

}  // namespace deck
