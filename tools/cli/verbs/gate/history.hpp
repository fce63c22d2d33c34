// What a gate would have said of the last commits of a deck, each against the one before.
#pragma once
#include <string>

#include "common.hpp"

namespace deck::cli {

/// A table for people. Error: the deck is in no git work tree. A deck that no commit has yet gives
/// a sentence.
Result<std::string> gate_history(const LoadedDeck& loaded, std::size_t commits,
                                 const CommonOptions& common);

}  // namespace deck::cli
