// Documents of deck convert: a deck as JSON, with blocks of named, typed values, effective values
// of the interfaces and the text of every line, and the loss report.
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
  const Model* model = nullptr;            ///< may be missing: no counts of nodes and elements
  const Interfaces* interfaces = nullptr;  ///< may be missing: no effective values; values that
                                           ///< wait for `resolve` are null
};

/// Schema id "deck/deck", version 1 (schemas/output/deck.schema.json). `files` holds the include
/// tree, main file first, each with its items in order: text, include directives, blocks. A line
/// that a schema describes has its values by name beside its text; lists (nodes, elements, ids) are
/// rows [text, value, ...]. null is a blank cell; text stands for a parameter reference or an
/// unreadable number. `effective` values are in working units, everything else as written.
/// A file included by an absolute path is named, but not carried; one that is included twice is
/// carried once. Error: two different files would have to stand in one place.
Result<std::string> deck_to_json(const DeckJsonInput& input);

/// One document of several: an object with the list "decks". One alone stays as it is.
std::string decks_to_json(const std::vector<std::string>& documents);

/// What a conversion kept, approximated, dropped, or leaves to a decision. Schema id "deck/losses":
/// {"kept":[..],"approximated":[..],"dropped":[..],"undecided":[..]}.
std::string losses_json(const std::vector<LossEntry>& losses);

}  // namespace deck
