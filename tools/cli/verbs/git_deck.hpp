// A deck as it is at a git revision, for diff --git REV and --compare git:REV. Git is run directly,
// without a shell; nothing in the work tree or the repository is changed.
#pragma once
#include <string>

#include "common.hpp"

namespace deck::cli {

/// What "--compare git:REV" begins with.
inline constexpr std::string_view git_prefix = "git:";

/// A deck and the files that it includes, by the paths under which they are read:
/// "git:REV/models/car_0000.rad", from the top of the work tree.
struct GitDeck {
  std::string path;
  Overlay files;
};

/// Error: the deck is in no git work tree, or git does not have it at that revision. A file that it
/// includes and that git does not have is missing, as it would be for the solver.
Result<GitDeck> git_deck(const std::string& revision, const std::string& deck);

/// The document of 'deck gaps --json' of a deck at a revision.
Result<std::string> gaps_at_revision(const std::string& revision, const std::string& deck,
                                     const CommonOptions& options);

}  // namespace deck::cli
