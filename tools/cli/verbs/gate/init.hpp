// deck gate --init: the files that hold the decks of a repository against what they are today.
#pragma once
#include <string>

#include "common.hpp"

namespace deck::cli {

struct GateInit {
  std::string forge;  ///< github or gitlab; empty: what the repository looks like
  bool overwrite = false;
  std::size_t commits = 10;
};

/// Writes the settings, the documents of today's findings and penetrations, and the workflow, all
/// or none; then says what the gate would have said of the last commits. Returns the exit code.
int init_gate(const CommonOptions& common, const GateInit& init);

/// What a gate would have said of the last commits of a deck, each against the one before: a table
/// for people; empty: fewer than two commits have the deck. Error: it is in no git work tree.
Result<std::string> gate_history(const LoadedDeck& loaded, std::size_t commits,
                                 const CommonOptions& common);

}  // namespace deck::cli
