// Where the files of a deck go when it is written under another directory, so that every #include
// finds its file there. Private to the edit stage.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deck/keyword/deck.hpp"

namespace deck::detail {

struct Layout {
  std::map<std::filesystem::path, std::uint32_t> files;  ///< relative target -> file of the deck
  std::vector<std::string> outside;  ///< included by an absolute path: left where they are
};

/// Relative names stay; where an include leads above the main file's directory, the main file moves
/// down as many directories. Error: two files for one place, or an include from above the root.
/// With `folder`, the place of the main file's directory is given, and no include may lead above
/// what it is relative to.
Result<Layout> lay_out(const Deck& deck, const std::optional<std::filesystem::path>& folder = {});

}  // namespace deck::detail
