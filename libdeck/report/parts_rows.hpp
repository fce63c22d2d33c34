// What every output of deck parts shows: element counts, interfaces and rigid body of each part.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "deck/front/loaded_deck.hpp"

namespace deck::detail {

/// "shell4", "shell3", "solid", "quad", "tria", "truss", "beam", "spring"
std::string_view kind_name(ElementKind kind);

struct PartView {
  std::array<std::uint64_t, 8> elements{};  ///< by kind
  double thickness = 0;                     ///< of the part, else of its property
  std::vector<std::int64_t> interfaces;     ///< that see an element of it
  std::int64_t rigid_body = 0;              ///< that all its nodes belong to
  std::uint64_t count() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t n : elements) sum += n;
    return sum;
  }
};

/// Contacts that all let the same parts touch: those of the same parts on both sides, or two kinds
/// of them that share parts.
struct RepeatedContacts {
  std::vector<std::int64_t> interfaces;  ///< ids, two or more, in the order of the deck
  std::uint64_t pairs = 0;               ///< of parts
  std::int64_t part = 0, other = 0;      ///< ids of the first pair
};
inline constexpr std::size_t most_repeated_contacts = 1000;

struct PartsView {
  std::vector<PartView> parts;
  std::uint64_t unconnected_nodes = 0;     ///< that no element has
  std::vector<std::int64_t> empty_parts;   ///< ids of parts without elements
  std::vector<std::int64_t> unseen_parts;  ///< with elements that no contact or tie sees
  std::vector<RepeatedContacts> repeated;  ///< not more than most_repeated_contacts
};

PartsView view_parts(const LoadedDeck& loaded);

}  // namespace deck::detail
