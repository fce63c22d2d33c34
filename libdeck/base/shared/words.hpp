// Words and numbers in messages: a count with its noun, lengths, upper and lower case, the closest
// word to a misspelt one.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace deck {

// A count with its noun: "1 node", "3 nodes".

inline std::string count(std::uint64_t n, std::string_view one, std::string_view many) {
  std::string text = std::to_string(n);
  text += ' ';
  text += n == 1 ? one : many;
  return text;
}

/// "62 nodes and 12 edges"; a count of 0 is left out.
inline std::string nodes_and_edges(std::uint64_t nodes, std::uint64_t edges) {
  if (edges == 0) return count(nodes, "node", "nodes");
  if (nodes == 0) return count(edges, "edge", "edges");
  return count(nodes, "node", "nodes") + " and " + count(edges, "edge", "edges");
}

/// "7, 8, 12": at most `most` ids, then how many more.
std::string list_text(const std::vector<std::int64_t>& ids, std::size_t most = 5);

// Numbers as text. A length is "unbounded" if its square is no finite double, or if it is beyond a
// given limit.

/// True if `length` is not a number, or so large that its square overflows.
inline bool is_unbounded(double length) { return !(length * length <= 1.7976931348623157e308); }

/// A length with `digits` significant digits; "unbounded" also beyond `largest`.
std::string length_text(double length, int digits = 6, double largest = 1e300);

/// Shown in place of a number that is NaN or infinite.
inline constexpr std::string_view not_computed = "not computed";
/// A number with `digits` significant digits, or `not_computed`.
std::string figure_text(double value, int digits = 4);

// Words that a user types: the distance between two words, for "did you mean", and capitals.

/// Number of single characters to insert, remove or replace between two words (Levenshtein 1966);
/// bytes; "A" and "a" are different. `limit + 1` if their lengths differ by more than `limit`.
std::size_t edit_distance(std::string_view a, std::string_view b,
                          std::size_t limit = static_cast<std::size_t>(-1) / 2);

/// The word of `known` that is closest to `word`, without regard to case; empty: none is close. A
/// short word must be closer than a long one.
std::string closest_word(std::string_view word, const std::vector<std::string>& known);

/// Changes the letters a to z to A to Z, or the reverse. Independent of the locale.
std::string in_capitals(std::string_view text);
std::string in_lower_case(std::string_view text);

}  // namespace deck
