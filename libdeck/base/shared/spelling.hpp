// Words as people type them: in capitals, and how far from another one, for "did you mean".
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace deck {

/// Number of single characters to insert, remove or replace between two words (Levenshtein 1966);
/// bytes, capitals count as other letters. `limit + 1` where their lengths alone differ by more.
std::size_t edit_distance(std::string_view a, std::string_view b,
                          std::size_t limit = static_cast<std::size_t>(-1) / 2);

/// The word of `known` that `word` was probably meant to be: the closest one, in whatever letters;
/// empty: none is close. The shorter the word, the closer it has to be.
std::string closest_word(std::string_view word, const std::vector<std::string>& known);

/// With the letters a to z as A to Z, or the other way, whatever the locale.
std::string in_capitals(std::string_view text);
std::string in_lower_case(std::string_view text);

}  // namespace deck
