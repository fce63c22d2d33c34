// The page of `deck gaps --html` for verbs that have a scene and show it: one way to prepare it.
#pragma once
#include <atomic>
#include <string>

#include "deck/front/loaded_deck.hpp"
#include "deck/report/html.hpp"

namespace deck::cli {

/// The page of a deck with ties, crossings and forces of the first cycle; its scene is made again
/// if it lacks what the page needs. `input` has the path and what else the page shall know beside
/// the deck. Error: the viewer is not there, or `stop` was set meanwhile ("cancelled").
Result<std::string> gap_page(LoadedDeck& loaded, HtmlInput input,
                             const std::atomic<bool>* stop = nullptr);

}  // namespace deck::cli
