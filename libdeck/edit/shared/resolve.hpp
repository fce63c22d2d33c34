// Effective values written into the cards of the contact interfaces, so that a deck no longer
// depends on /DEFAULT/INTER or on the solver's built-in defaults.
#pragma once
#include "deck/edit/rewrite.hpp"

namespace deck {

struct ResolveOptions {
  /// Write the rest although a default card stays in force for what is undecided. Without it that
  /// is a refusal: the deck would go on depending on the card.
  bool allow_loss = false;
};

/// Fills every cell of a contact or tie whose effective value comes from a default card
/// or is built in and is not zero. Effective values stay the same to the last bit. Cells that hold
/// a value already are not touched, except where the meaning of their unit changes (Stfac, once
/// Istf 1 stands on the card). The default cards stay; they have no effect on these cells any more.
/// Loss report: `kept` for every value written (old text, new text, and where it came from) and for
/// values that follow from the mesh or from other fields, which stay blank; `approximated` where no
/// text of the cell's width gives the value back exactly; `undecided` where a default card is at
/// work and the card has no cell for the value (Iedge of TYPE19, cells newer than the deck's
/// version, a parameter that is 0).
Rewrite resolve_defaults(const LoadedDeck& context, const ResolveOptions& options = {});

}  // namespace deck
