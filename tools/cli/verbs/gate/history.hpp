// What a gate would have said of the last commits of a deck, each against the one before.
#pragma once
#include <string>

#include "common.hpp"

namespace deck::cli {

/// A table for people; empty: fewer than two commits have the deck. Error: it is in no git work
/// tree.
Result<std::string> gate_history(const LoadedDeck& loaded, std::size_t commits,
                                 const CommonOptions& common);

}  // namespace deck::cli
