// /DEFAULT/INTER/TYPEn and /FRICTION: the two places besides the card where interface values are
// written down.
#pragma once
#include <vector>

#include "deck/model/interfaces.hpp"

namespace deck::detail {

/// The default cards that the reference solver honours: of the main file, outside submodels, the
/// first of each type. Reports the others.
std::vector<DefaultInter> read_defaults(const Deck& deck, Diagnostics& diagnostics);

/// All /FRICTION with their effective values, in deck order.
std::vector<Friction> read_frictions(const Deck& deck);

}  // namespace deck::detail
