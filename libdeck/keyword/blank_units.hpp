// Unit lines of /BEGIN with blank cells. Private to the keyword stage.
#pragma once
#include "deck/keyword/deck.hpp"

namespace deck::detail {

/// A blank cell of a unit line takes the unit of the other line (DK015), as a blank line does.
/// `which` names the line in messages, `begin` is the header.
void fill_blank_units(Deck& deck, Span begin, UnitSystem& units, const UnitSystem& other,
                      const char* which);

}  // namespace deck::detail
