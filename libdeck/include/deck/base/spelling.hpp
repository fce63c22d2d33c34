// Words as people type them: in capitals, and how far from another one, for "did you mean".
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace deck {

/// Number of single characters to insert, remove or replace between two words (Levenshtein 1966);
/// bytes, capitals count as other letters. `limit + 1` where their lengths alone differ by more.
std::size_t edit_distance(std::string_view a, std::string_view b,
                          std::size_t limit = static_cast<std::size_t>(-1) / 2);

/// With the letters a to z as A to Z, whatever the locale.
std::string in_capitals(std::string_view text);

}  // namespace deck
