// TYPE19 written as what the solver makes of it: node-to-surface contacts and an edge contact as
// interfaces of their own.
#pragma once
#include "deck/edit/rewrite.hpp"

namespace deck {

/// Replaces every /INTER/TYPE19 by
///  * a TYPE7 that keeps id, title, lines and comments: nodes of surf_IDs on surf_IDm;
///  * for two different surfaces a second TYPE7 with the sides exchanged;
///  * a TYPE11 of the edges of both surfaces (all edges, or the free ones where
///  /DEFAULT/INTER/TYPE19
///    sets Iedge 1), unless there are none;
/// and by the /GRNOD/SURF, /LINE/SURF or /LINE/EDGE they need, with ids above all that are used.
/// Surfaces given as sets are referred to as sets on all sides. Flags that are 0 on the TYPE19 are
/// written out, so that default cards of TYPE7 and TYPE11 do not change them; other cells keep
/// their text. New blocks go in front of /END of the main file, which is where the solver processes
/// them, or behind the TYPE19 where that stands in a submodel or has another input version. Loss
/// report: one `kept` per interface; `undecided`, always a refusal, where a flag has no cell in the
/// deck's version and the other type's default is another one.
Rewrite expand_type19(const LoadedDeck& context);

}  // namespace deck
