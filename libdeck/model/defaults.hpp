// /DEFAULT/INTER/TYPEn and /FRICTION: the two places besides the card where interface values are
// written down.
#pragma once
#include <vector>

#include "deck/model/interfaces.hpp"

namespace deck::detail {

/// The default blocks that the reference solver honours: outside submodels, the first of each type,
/// wherever it stands. Reports the others.
std::vector<DefaultInter> read_defaults(const Deck& deck, Diagnostics& diagnostics);

/// All /FRICTION with their effective values, in the solver's order.
std::vector<Friction> read_frictions(const Deck& deck);

}  // namespace deck::detail
