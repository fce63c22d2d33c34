// Parts of a deck with sums over their elements, as text, CSV and JSON.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "deck/loaded_deck.hpp"

namespace deck {

struct PartsTextOptions {
  bool color = false;
  std::size_t width = 0;  ///< columns of a line; 0: any
  bool all = false;       ///< every part and node; else notable ones
};

/// One row per part, totals, and remarks.
std::string parts_text(const LoadedDeck& loaded, const PartsTextOptions& options = {});
/// One line per part, RFC 4180.
std::string parts_csv(const LoadedDeck& loaded);
/// Document of `deck parts --json` (schemas/output/parts.schema.json); `all`: steps of all elements
/// and nodes.
std::string parts_json(const LoadedDeck& loaded, bool all);

namespace detail {

/// "shell4", "shell3", "solid", "quad", "tria", "truss", "beam", "spring"
std::string_view kind_name(ElementKind kind);

struct PartView {
  std::array<std::uint64_t, 8> elements{};  ///< by kind
  double thickness = 0;                     ///< of the part, else of its property
  std::vector<std::int64_t> interfaces;     ///< with an element of it
  std::int64_t rigid_body = 0;              ///< with all its nodes
  std::uint64_t count() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t n : elements) sum += n;
    return sum;
  }
};

/// Contacts between the same parts: with equal parts on both sides, or two groups that share parts.
struct RepeatedContacts {
  std::vector<std::int64_t> interfaces;  ///< two or more ids, in deck order
  std::uint64_t pairs = 0;               ///< of parts
  std::int64_t part = 0, other = 0;      ///< ids of the first pair
};
inline constexpr std::size_t most_repeated_contacts = 1000;

struct PartsView {
  std::vector<PartView> parts;
  std::uint64_t unconnected_nodes = 0;     ///< without element
  std::vector<std::int64_t> empty_parts;   ///< ids of parts without elements
  std::vector<std::int64_t> unseen_parts;  ///< with elements, but in no contact or tie
  std::vector<RepeatedContacts> repeated;  ///< at most most_repeated_contacts
};

PartsView view_parts(const LoadedDeck& loaded);

}  // namespace detail

}  // namespace deck
