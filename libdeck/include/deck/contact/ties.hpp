// Ties: which secondary nodes of each /INTER/TYPE2 the solver ties to which main segment at
// start-up, which ones it loses, and why.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "deck/model/interfaces.hpp"

namespace deck {

/// One secondary node of a tie.
struct TiedNode {
  NodeIndex node = no_index;
  /// Nothing of its interface holds it, and nothing else does instead.
  bool lost() const { return !tied && removed_by == 0; }
  std::uint32_t segment = no_index;  ///< position in Tie::main; no_index: none was found
  /// Place on the segment, -1 to 1 within it, in the order of its corners. Triangles with
  /// Spotflag 27: weights of corners 1 and 2.
  double s = 0, t = 0;
  double distance = 0;  ///< as the solver stores it: search distance - (search distance - distance)
  double search = 0;    ///< distance within which the solver looked; 0: no segment was examined
  /// Without a segment: the one that is nearest as the solver measures, and how far it is.
  /// no_index: there is none, or it was not looked for.
  std::uint32_t nearest = no_index;
  double nearest_distance = 0;
  /// Search distances that other shells at the node would give with this segment (the nearest where
  /// none was found): by its corner numbers the solver takes the thickness of one.
  double least_search = 0, most_search = 0;
  bool missed = false;  ///< a segment was in reach, but the solver's box for it was too small
  int message = 0;      ///< solver message that lists the node: 1071 1078 1079 1157 1158 1872 1873
  int removed_by = 0;   ///< 1630 (the same tie exists already), 1209 (condensed mid node)
  bool tied = false;
  bool penalty = false;  ///< treated by penalty: Spotflag 25, 26 always; 27, 28 after message 1179
};

/// Ties that a later interface repeats (solver warning 1630).
struct RepeatedTies {
  std::int64_t interface_id = 0;  ///< the earlier interface
  std::uint32_t count = 0;
};

/// An /INTER/TYPE2 at start-up.
struct Tie {
  const InterType2* inter = nullptr;
  int spotflag = 0;  ///< effective; 0 is the standard formulation (5)
  int ignore = 0;    ///< effective; 0: the solver stops where a node is not tied
  /// Distance within which all nodes look for a segment; 0: each pair has its own (Ignore 2 and 3
  /// without dsearch).
  double search_distance = 0;
  std::vector<std::array<NodeIndex, 4>>
      main;                     ///< as the solver turns them; triangle: last repeated
  std::vector<TiedNode> nodes;  ///< ascending node id
  std::vector<RepeatedTies> repeated;
  std::vector<NodeIndex> main_and_tied;  ///< main nodes that a tie holds as secondary (error 556)
  std::string not_evaluated;             ///< why nothing was looked for; empty: it was
};

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
