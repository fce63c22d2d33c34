// What is counted and said of ties: one home for every medium.
#pragma once
#include <string>

#include "deck/contact/ties.hpp"

namespace deck {

struct TieCounts {
  std::size_t nodes = 0;      ///< secondary nodes
  std::size_t tied = 0;       ///< in the interface at the end
  std::size_t not_found = 0;  ///< without a segment within reach
  std::size_t dropped = 0;    ///< found, and dropped again
  std::size_t elsewhere = 0;  ///< taken out because something else holds them: 1630, 1209
  std::size_t outside = 0;    ///< tied to a segment beyond whose rim they lie
  std::size_t lost() const { return not_found + dropped; }
};
TieCounts count_ties(const Tie& tie);

/// "3 of 412 nodes are not tied", "412 nodes are tied", "not evaluated: why".
std::string holds_text(const Tie& tie);
/// What becomes of the nodes that are not simply tied, for a table; "-": there are none.
std::string losses_text(const Tie& tie);

/// Why a node is not tied, or how it is: one sentence; and in a few words for a table.
std::string why_text(const Tie& tie, const TiedNode& node);
std::string short_reason(const Tie& tie, const TiedNode& node);

}  // namespace deck
