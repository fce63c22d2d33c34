// The text of a card from its schema and some values.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/keyword/schema.hpp"

namespace deck {

/// A card block of `schema` at `version`: header, title, one line per card whose conditions hold.
/// Fields that are not given stay blank. Unknown names are put out as a comment so that a typing
/// error in an example shows.
std::string render_card(const Schema& schema, std::string_view header, int version,
                        const std::vector<std::pair<std::string, std::string>>& values);

}  // namespace deck
