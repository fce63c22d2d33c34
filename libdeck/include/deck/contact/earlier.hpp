// What an earlier run found, and what became of it: new, worse, better, the same, solved.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "deck/contact/view.hpp"

namespace deck {

/// Initial penetrations as an earlier `deck gaps --json` has them.
struct EarlierGaps {
  struct Row {
    std::int64_t interface_id = 0;
    std::string role;                         ///< "primary", "reversed", "edges"
    std::array<std::int64_t, 2> secondary{};  ///< node (second 0) or the two nodes of an edge
    double depth = 0, gap = 0;                ///< lengths, also for edges
    std::optional<std::array<double, 3>> at;  ///< as NamedPenetration::at; old documents lack it
  };
  std::string path;                ///< of the JSON file, as given
  std::string deck_path;           ///< of the deck it describes; empty: the file holds others only
  std::vector<std::string> decks;  ///< of which the file holds anything, in its order
  std::vector<Row> rows;           ///< deepest row of every secondary node or edge
  /// Ids of nodes by interface: those that a TYPE10 ties, and those that a TYPE2 does not tie.
  std::map<std::int64_t, std::set<std::int64_t>> tied, untied;
  bool accepts = false;  ///< a baseline: what it does not list is new, nodes that are not tied too
};

/// Ids of nodes that a TYPE10 or TYPE2 should hold and does not, of the ties that were evaluated.
std::map<const InterBase*, std::vector<std::int64_t>> untied_nodes(const Scene& scene);

/// Depths that differ by less than this share of them are the same: what another order of the same
/// sums changes lies ten decades below, what a person changes above.
inline constexpr double same_depth = 1e-6;

enum class Trend : std::uint8_t { fresh, worse, same, better };
const char* to_string(Trend trend);  ///< "new", "worse", "same", "better"

/// The penetrations of a scene beside those of an earlier run.
struct GapsComparison {
  struct Row {
    std::uint32_t penetration = 0;  ///< SceneView::penetrations: the deepest of its node or edge
    Trend trend = Trend::fresh;
    std::uint32_t earlier = no_index;  ///< EarlierGaps::rows; no_index: it is new
  };
  std::vector<Row> rows;  ///< parallel to SceneView::deepest_per_node
  /// EarlierGaps::rows that penetrate no more, in their order; of contacts that were evaluated.
  std::vector<std::uint32_t> solved;
  /// Nodes, by id, that an interface tied in the earlier run and does not tie now.
  std::map<const InterBase*, std::vector<std::int64_t>> lost_ties;

  std::uint64_t count(Trend trend) const;
};

/// Rows belong together that have the same ids at the same place; else those at the same place
/// (ids were changed, a millionth of the gap is the same place); else those with the same ids
/// (nodes were moved). O(n log n) in the rows.
GapsComparison compare_gaps(const EarlierGaps& earlier, const Scene& scene, const SceneView& view);

}  // namespace deck
