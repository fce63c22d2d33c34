// Decks in git: a deck at a revision, lines changed since, commits. Git runs without a shell; the
// work tree and repository are not changed.
#pragma once
#include <string>
#include <vector>

#include "common.hpp"
#include "lint/shared/gate.hpp"

namespace deck::cli {

/// Prefix of "--compare git:REV".
inline constexpr std::string_view git_prefix = "git:";

/// A deck and its includes by their reading paths: "git:REV/models/car_0000.rad", from the top of
/// the work tree.
struct GitDeck {
  std::string path;
  Overlay files;
};

/// Error: not in a work tree, or not at that revision. Includes that git lacks are missing, as for
/// the solver.
Result<GitDeck> git_deck(const std::string& revision, const std::string& deck);

/// The document of 'deck gaps --json' at a revision.
Result<std::string> gaps_at_revision(const std::string& revision, const std::string& deck,
                                     const CommonOptions& options);

/// Lines of the deck's files changed since the merge base with `revision`, as a forge shows the
/// changes of a branch. Error: not in a work tree, or unknown revision.
Result<ChangedLines> changed_lines(const std::string& revision, const LoadedDeck& loaded);

struct Commit {
  std::string name, date, subject;  ///< abbreviated name; "2026-01-31"
};
/// The last commits that changed one of these files, newest first; for merges the changes relative
/// to the branch.
Result<std::vector<Commit>> commits_of(const std::string& root,
                                       const std::vector<std::string>& files, std::size_t most);

/// Files of a deck relative to its git work tree.
std::vector<std::string> files_in_tree(const LoadedDeck& loaded, const std::string& root);

}  // namespace deck::cli
