// Words and numbers for people: a number with what it counts, lengths, letters, the word that was
// meant.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace deck {

// "1 node", "3 nodes": a number with what it counts.

inline std::string count(std::uint64_t n, std::string_view one, std::string_view many) {
  std::string text = std::to_string(n);
  text += ' ';
  text += n == 1 ? one : many;
  return text;
}

/// "62 nodes and 12 edges", without what there is none of.
inline std::string nodes_and_edges(std::uint64_t nodes, std::uint64_t edges) {
  if (edges == 0) return count(nodes, "node", "nodes");
  if (nodes == 0) return count(edges, "edge", "edges");
  return count(nodes, "node", "nodes") + " and " + count(edges, "edge", "edges");
}

// Numbers as people read them. Lengths: a length that no computation can hold, or beyond what
// bounds it, is "unbounded".

/// True for what is no length: not a number, or so large that its square is none.
inline bool is_unbounded(double length) { return !(length * length <= 1.7976931348623157e308); }

/// With `digits` significant digits, as people read it; "unbounded" also beyond `largest`.
std::string length_text(double length, int digits = 6, double largest = 1e300);

/// In place of a number that is none, or that no double holds.
inline constexpr std::string_view not_computed = "not computed";
/// A number with `digits` significant digits, as people read it, or `not_computed`.
std::string figure_text(double value, int digits = 4);

// Words as people type them: in capitals, and how far from another one, for "did you mean".

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
