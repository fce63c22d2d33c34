// Decks on disk: decks below a directory, decks that share files, their common directory.
#pragma once
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "deck/text.hpp"
#include "keyword/shared/include_scan.hpp"

namespace deck::cli {

inline constexpr std::string_view deck_ending = "_0000.rad";

/// Completes a name: for "crash_box" crash_box_0000.rad, else crash_box.rad, else a packed one
/// (".gz"). Existing names are returned unchanged.
std::string find_deck(const std::string& given);

/// Sorted entries of a directory; empty if it is unreadable.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& directory);

/// All decks (*_0000.rad) below a directory, sorted; packed ones (".gz") if the plain one does not
/// exist; not in hidden directories and `output`. `closed`: treatment of unreadable directories.
Result<std::vector<std::string>> files_below(
    const std::string& directory, const std::string& output = {},
    std::filesystem::directory_options closed = std::filesystem::directory_options::none);

/// Error for a directory without decks and folders.
Error no_deck_in(const std::string& directory);
/// Expands directories to their decks, and patterns (* ? [ ]) that are not file names to matching
/// files. Error: a directory without a deck, a pattern without match.
Result<std::vector<std::string>> expand_decks(const std::vector<std::string>& given,
                                              const std::string& output = {});
/// For read-only verbs: expand_decks() if there is a directory, else `given`. Error: a directory
/// without a deck.
Result<std::vector<std::string>> decks_in_directories(const std::vector<std::string>& given);
bool names_directory(const std::vector<std::string>& given);
/// Removes files from `found` that other decks include, except those in `given`; returns a note for
/// each.
std::vector<std::string> extract_includes(std::vector<std::string>& found,
                                          const std::vector<std::string>& given, IncludeScan& scan);

/// The deepest common directory of the files and of the directories in `given`; absolute.
std::string common_root(const std::vector<std::string>& given,
                        const std::vector<std::string>& files);

/// The git work tree of a file, else its folder.
std::string library_root(const std::string& deck);

/// Files of some decks that decks below `roots` include, too.
struct SharedFiles {
  std::set<std::string> roots;
  bool guessed = false;  ///< some `roots` are neither given nor git work trees
  /// Searched places for messages; empty: the expected ones.
  std::string where() const;
  std::map<FileIdentity, std::string> others;  ///< file -> another deck that includes it
};
/// `root` empty: the git work trees of the files; else the deepest common folder of the deck.
Result<SharedFiles> find_shared_files(const std::vector<std::string>& decks,
                                      const std::string& root,
                                      const std::vector<std::string>& include_paths);

/// Decks that changed files belong to, sorted: a deck itself, or all decks below `root` (empty:
/// library_root) that include the file. Error: an unreadable directory.
Result<std::vector<std::string>> decks_of_files(const std::vector<std::string>& changed,
                                                const std::string& root,
                                                const std::vector<std::string>& include_paths);

}  // namespace deck::cli
