// Words and numbers for messages: counts with nouns, lengths, capitals, spelling suggestions.
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

/// "7, 8, 12": at most `most` ids, then the number of further ones.
std::string list_text(const std::vector<std::int64_t>& ids, std::size_t most = 5);

/// True for NaN and for lengths whose square overflows.
inline bool is_unbounded(double length) { return !(length * length <= 1.7976931348623157e308); }

/// A length with `digits` significant digits; "unbounded" if is_unbounded() or above `largest`.
std::string length_text(double length, int digits = 6, double largest = 1e300);

/// Shown for NaN and infinity.
inline constexpr std::string_view not_computed = "not computed";
/// A number with `digits` significant digits, or `not_computed`.
std::string figure_text(double value, int digits = 4);

/// Levenshtein distance in bytes, case-sensitive; `limit + 1` if the lengths differ by more than
/// `limit`.
std::size_t edit_distance(std::string_view a, std::string_view b,
                          std::size_t limit = static_cast<std::size_t>(-1) / 2);

/// The word of `known` closest to `word`, ignoring case; empty: none is close. Short words need
/// smaller distances.
std::string closest_word(std::string_view word, const std::vector<std::string>& known);

/// Converts a-z to A-Z, or the reverse; independent of the locale.
std::string in_capitals(std::string_view text);
std::string in_lower_case(std::string_view text);

}  // namespace deck
