// Decks on disk as a library: which lie below a directory, which share files, and what directory
// holds all of them.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deck/edit/include_scan.hpp"
#include "deck/text/result.hpp"

namespace deck::cli {

inline constexpr std::string_view deck_ending = "_0000.rad", document_ending = "_0000.json";

/// All files below a directory whose names end so, sorted; hidden directories and `output`, where
/// results go, are passed over.
Result<std::vector<std::string>> files_below(const std::string& directory, std::string_view ending,
                                             const std::string& output = {});

/// `given` with every directory replaced by the decks below it, and every pattern (* ? [ ]) that no
/// file is called by those that it matches. Error: a directory without a deck, a pattern that
/// matches nothing.
Result<std::vector<std::string>> expand_decks(const std::vector<std::string>& given,
                                              std::string_view ending,
                                              const std::string& output = {});
bool names_directory(const std::vector<std::string>& given);

/// The deepest directory that holds all of these files and directories, absolute.
std::string common_root(const std::vector<std::string>& directories,
                        const std::vector<std::string>& files);

/// The git work tree that holds a file, else its folder.
std::string library_root(const std::string& deck);

/// The decks below `root` that are not among `decks` and include one of their files.
struct Dependents {
  std::vector<std::string> decks;              ///< sorted; those that follow from others included
  std::map<FileIdentity, std::string> shared;  ///< file of `decks` -> a deck that includes it, too
};
/// `root` empty: library_root of each deck.
Result<Dependents> find_dependents(const std::vector<std::string>& decks, const std::string& root,
                                   const std::vector<std::string>& include_paths);

}  // namespace deck::cli
