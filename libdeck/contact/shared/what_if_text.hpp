// Text form of other values for an interface.
#pragma once
#include <string>

#include "deck/contacts.hpp"
#include "deck/model.hpp"
#include "deck/text.hpp"

namespace deck {

/// Parses "ID:Gapmin=2,Inacti=6".
Result<WhatIf> parse_what_if(const std::string& text);
/// Refuses values that do not fit the interface's cells, and fields it does not have.
Result<void> check_what_if(const WhatIf& w, const InterBase& inter);

}  // namespace deck
