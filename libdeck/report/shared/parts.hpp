// The parts of a deck with what their elements add up to, for people and for programs.
#pragma once
#include <string>

#include "deck/front/loaded_deck.hpp"

namespace deck {

struct PartsTextOptions {
  bool color = false;
  std::size_t width = 0;  ///< columns of a line; 0: any
  bool all = false;       ///< every part and node; else what matters
};

/// One row a part, the totals, and what is worth a look.
std::string parts_text(const LoadedDeck& loaded, const PartsTextOptions& options = {});
/// One line a part, RFC 4180.
std::string parts_csv(const LoadedDeck& loaded);
/// The document of `deck parts --json` (schemas/output/parts.schema.json); with `all` the steps of
/// all elements and nodes.
std::string parts_json(const LoadedDeck& loaded, bool all);

}  // namespace deck
