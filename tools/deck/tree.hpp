// Where the files of a deck go when it is written under another directory, so that every #include
// finds its file there.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "deck/edit/rewrite.hpp"

namespace deck::cli {

struct TreeFile {
  std::filesystem::path target;  ///< below the output directory
  std::string source;            ///< path the deck opened it by
  std::string_view bytes;        ///< what to write; points into the deck or `changed`
};

struct Tree {
  std::vector<TreeFile> files;       ///< by target
  std::vector<std::string> outside;  ///< included by an absolute path: left where they are
};

/// Relative names stay; where an include leads above the main file's directory, the main file moves
/// down as many directories. `changed` holds new contents by path. Error: two files for one place,
/// an include from above the root, a target that is the deck itself, or a changed file that stays
/// where it is.
Result<Tree> lay_out(const Deck& deck, const std::string& directory, const ChangedFiles& changed);

}  // namespace deck::cli
