// What git knows of a deck: the deck as it is at a revision, the lines that changed since one, the
// commits that touched it. Git is run directly, without a shell; nothing in the work tree or the
// repository is changed.
#pragma once
#include <string>
#include <vector>

#include "common.hpp"
#include "lint/shared/gate.hpp"

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

/// The lines of a deck's files that differ from what they were where the present commit left the
/// line of `revision`, as a forge shows the change of a branch. Error: the deck is in no git work
/// tree, or git knows no such revision.
Result<ChangedLines> changed_lines(const std::string& revision, const LoadedDeck& loaded);

struct Commit {
  std::string name, date, subject;  ///< abbreviated name; "2026-01-31"
};
/// The last commits that touched one of these files, the newest first; of merges only what they
/// brought to the branch.
Result<std::vector<Commit>> commits_of(const std::string& root,
                                       const std::vector<std::string>& files, std::size_t most);

/// The files of a deck in its git work tree, by their paths from the top of it.
std::vector<std::string> files_in_tree(const LoadedDeck& loaded, const std::string& root);

}  // namespace deck::cli
