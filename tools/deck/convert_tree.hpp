// Where the files of a deck go when it is written under another directory, so that every #include
// finds its file there.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "deck/keyword/deck.hpp"

namespace deck::cli {

/// Where the files of a deck go, relative to the output directory.
struct Layout {
  std::map<std::filesystem::path, std::uint32_t> files;  ///< target -> file of the deck
  std::vector<std::string> outside;                      ///< absolute includes: left where they are
};

/// Keeps the relative names. Error: two files for one place, or an include from above the root.
Result<Layout> lay_out(const Deck& deck);

}  // namespace deck::cli
