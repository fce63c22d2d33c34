// Documents of deck convert: a deck as JSON (blocks of named, typed values, effective values, text
// of every line) and the loss report.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "deck/edit.hpp"
#include "deck/model.hpp"
#include "deck/text.hpp"

namespace deck {

struct DeckJsonInput {
  std::string_view path;  ///< as given
  const Deck* deck = nullptr;
  const Model* model = nullptr;            ///< nullptr: no counts of nodes and elements
  const Interfaces* interfaces = nullptr;  ///< nullptr: no effective values; null before `resolve`
};

/// Schema id "deck/deck", version 1 (schemas/output/deck.schema.json). `files`: the include tree,
/// main file first, each with its items in order: text, include directives, blocks. A line with a
/// schema has its values by name next to its text; lists (nodes, elements, ids) are rows [text,
/// value, ...]. null is a blank cell; a parameter reference or unreadable number is text.
/// `effective` values are in working units, all others as written. Files included by absolute path
/// are named but not included; files included twice are included once. Error: two different files
/// with one place.
Result<std::string> deck_to_json(const DeckJsonInput& input);

/// One document of several: an object with the list "decks". A single one is unchanged.
std::string decks_to_json(const std::vector<std::string>& documents);

/// Values that a conversion kept, approximated, dropped, or left undecided. Schema id
/// "deck/losses": {"kept":[..],"approximated":[..],"dropped":[..],"undecided":[..]}.
std::string losses_json(const std::vector<LossEntry>& losses);

}  // namespace deck
