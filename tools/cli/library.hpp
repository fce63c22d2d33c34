// Decks on disk as a library: which lie below a directory, which share files, and what directory
// holds all of them.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "deck/text.hpp"
#include "keyword/shared/include_scan.hpp"

namespace deck::cli {

inline constexpr std::string_view deck_ending = "_0000.rad";

/// The deck that a name without its ending stands for: "crash_box" is crash_box_0000.rad where that
/// is there, then crash_box.rad, then one of them packed (".gz"). What exists stands for itself.
std::string find_deck(const std::string& given);

/// The files and directories of a directory, by name; none where it cannot be read.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& directory);

/// All decks (*_0000.rad) below a directory, packed (".gz") ones included where the plain one is
/// not there as well, sorted; hidden directories and `output`, where results go, are passed over.
/// `closed`: what is done about directories that may not be read.
Result<std::vector<std::string>> files_below(
    const std::string& directory, const std::string& output = {},
    std::filesystem::directory_options closed = std::filesystem::directory_options::none);

/// The refusal of a directory that holds no deck, nor any folder in it.
Error no_deck_in(const std::string& directory);
/// `given` with every directory replaced by the decks below it, and every pattern (* ? [ ]) that no
/// file is called by those that it matches. Error: a directory without a deck, a pattern that
/// matches nothing.
Result<std::vector<std::string>> expand_decks(const std::vector<std::string>& given,
                                              const std::string& output = {});
/// The same where a directory is among them, for verbs that only read; else `given` unchanged.
/// Error: a directory without a deck.
Result<std::vector<std::string>> decks_in_directories(const std::vector<std::string>& given);
bool names_directory(const std::vector<std::string>& given);
/// Takes the files out of `found`, what `given` stands for, that other decks among them include,
/// and returns a note of each. What is named itself is taken for a deck.
std::vector<std::string> take_includes(std::vector<std::string>& found,
                                       const std::vector<std::string>& given, IncludeScan& scan);

/// The deepest directory that holds these files, and what of `given` is a directory; absolute.
std::string common_root(const std::vector<std::string>& given,
                        const std::vector<std::string>& files);

/// The git work tree that holds a file, else its folder.
std::string library_root(const std::string& deck);

/// Files of some decks that other decks below `roots` include, too.
struct SharedFiles {
  std::set<std::string> roots;
  bool guessed = false;  ///< some of `roots` are neither given nor git work trees
  /// Where was looked, for people; empty: where they expect it.
  std::string where() const;
  std::map<FileIdentity, std::string> others;  ///< file -> another deck that includes it
};
/// `root` empty: the git work trees of the files; for files in none the deepest folder that holds
/// those of their deck.
Result<SharedFiles> find_shared_files(const std::vector<std::string>& decks,
                                      const std::string& root,
                                      const std::vector<std::string>& include_paths);

/// The decks that changed files belong to, sorted: a deck itself, and for every other file those
/// below `root` (empty: library_root of the file) that include it. Error: a directory that cannot
/// be read.
Result<std::vector<std::string>> decks_of_files(const std::vector<std::string>& changed,
                                                const std::string& root,
                                                const std::vector<std::string>& include_paths);

}  // namespace deck::cli
