// Reports of the force stage: the one-cycle contact check and the replay of recorded states, as
// text for people and JSON. Pure functions from results to bytes.
#pragma once
#include <string>
#include <string_view>

#include "deck/cycle/replay.hpp"
#include "deck/keyword/deck.hpp"
#include "deck/model/interfaces.hpp"

namespace deck {

/// What one replay was about.
struct ReplayInput {
  std::string_view path;    ///< of the deck, as given
  std::string_view states;  ///< path of the states
  const Deck* deck = nullptr;
  const InterBase* inter = nullptr;
  cycle::Model model = cycle::Model::reference;
};

/// The document of `deck replay --json` (schemas/output/replay.schema.json).
std::string replay_json(const ReplayInput& input, const cycle::ReplayReport& report);
/// A few lines: how many states, errors, the worst rows.
std::string replay_text(const ReplayInput& input, const cycle::ReplayReport& report);

}  // namespace deck
