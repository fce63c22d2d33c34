// The legal words of a keyword with lists of words (the variables of a time history). A schema
// keeps them as the condition under which the solver takes the cell. Private to the library.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "deck/keyword/schema.hpp"

namespace deck::detail {

/// Empty: not known. "SX*" is SX, then a digit or '_', then any rest.
std::span<const std::string> legal_words(const Schema& schema);
/// Whether the text is one of them, in any case.
bool has_word(const Schema& schema, std::string_view text);

}  // namespace deck::detail
