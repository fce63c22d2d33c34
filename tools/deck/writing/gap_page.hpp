// The page of `deck gaps --html` for verbs that have a scene and show it: one way to prepare it.
#pragma once
#include <atomic>
#include <string>

#include "deck/report/html.hpp"

namespace deck::cli {

/// The page with crossings and forces of the first cycle. `input` has path, deck, scene and
/// threads, and what else the page shall know; view, crossings and forces are made here. Error: the
/// viewer is not there, or `stop` was set meanwhile ("cancelled").
Result<std::string> gap_page(HtmlInput input, const std::atomic<bool>* stop = nullptr);

}  // namespace deck::cli
