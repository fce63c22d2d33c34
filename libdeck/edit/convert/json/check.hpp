// Holds what a deck's JSON document says against the deck that was written from it. Private to the
// edit stage.
#pragma once
#include <vector>

#include "edit/convert/json/document.hpp"
#include "edit/shared/from_json.hpp"

namespace deck::detail {

/// Throws Wrong at the first place where the document says something else than the files; with
/// `round`, a number may have lost the digits that its cell has no room for.
void check_document(const Json& root, const std::vector<DeckFile>& files, const SchemaSet& schemas,
                    bool round);

}  // namespace deck::detail
