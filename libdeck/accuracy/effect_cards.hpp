// Cards that differ from another one in effects of the pair loop, for times of loops with and
// without them. Private to the accuracy stage.
#pragma once
#include <optional>
#include <string>

#include "accuracy/shared/effect_cost.hpp"

namespace deck::accuracy {

/// A card that differs in one effect or more, and in which words.
struct OtherCard {
  cycle::ContactCard card;
  std::string says;
};

/// The card without the effect where it asks for it, else with it; or why there is none. `e` is the
/// effect in the account of this card (cycle::effect_plan).
std::optional<OtherCard> other_card(const cycle::ContactCard& card, const cycle::EffectState& e,
                                    std::string& why_not);

/// The card with every effect that it can have together with its own. Deletion and a tie exclude
/// each other; the tie is more work.
OtherCard everything(const cycle::ContactCard& card);

}  // namespace deck::accuracy
