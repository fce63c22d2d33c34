// Views of a scene for people: every penetration with its node, element and part ids, one row per
// node (the deepest), part pairs sorted by depth, and totals for the verdict.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "deck/contact/crossings.hpp"
#include "deck/contact/scene.hpp"

namespace deck {

/// An element as a person names it.
struct ElementName {
  ElementKind kind{};
  std::uint32_t index = no_index;
  std::int64_t id = 0, part = 0;
  bool valid() const { return index != no_index; }
};

/// The elements among which the element of such a carrier is counted; nullptr: no element.
const Elements* elements_of(const Model& model, Carrier carrier);

/// One penetration with names instead of positions.
struct NamedPenetration {
  std::uint32_t contact = 0, row = 0;       ///< Scene::contacts, Contact::penetrations
  std::array<std::int64_t, 2> secondary{};  ///< node id (second 0), or the two nodes of an edge
  std::array<std::int64_t, 4> main{};       ///< segment nodes, or edge nodes and zeros
  ElementName secondary_element, main_element;
  std::array<double, 3> at{};  ///< secondary node (edge: closest point), working units
};

/// How much there is of what: secondary nodes and edges, each once, and pairs. Never added up.
struct ItemCounts {
  std::uint64_t pairs = 0, nodes = 0, edges = 0;
};

struct PartPair {
  std::int64_t secondary = 0, main = 0;  ///< part ids, 0: no part
  ItemCounts count, on_segment;
  double max_depth = 0, mean_depth = 0, p95_depth = 0, max_ratio = 0;
  std::uint32_t worst = 0;  ///< index into Named view
};

struct ContactTotals {
  ItemCounts count;          ///< what penetrates; ties do not
  ItemCounts tied;           ///< what is tied (Contact::ties)
  std::uint64_t untied = 0;  ///< nodes of TYPE10 that no segment is within reach of
  ItemCounts on_segment;     ///< what of it lies exactly on a segment
  std::optional<std::uint64_t> crossed_elements;  ///< crossings listed; nullopt: not looked for
  std::uint64_t solver_errors = 0;                ///< nodes for which the solver stops: 611, 612
  std::uint64_t acted = 0;                        ///< pairs on which Inacti or Fpenmax do something
  std::uint64_t round_off = 0;                    ///< pairs with PenetrationRow::in_contact false
  double max_depth = 0, max_ratio = 0;
};

struct SceneView {
  /// Without ties; deepest first, equals by contact and row.
  std::vector<NamedPenetration> penetrations;
  std::vector<NamedPenetration> ties;  ///< rows of contacts that tie, in the same order
  std::vector<std::uint32_t>
      deepest_per_node;                 ///< indices into penetrations: of each contact one per
                                        ///< secondary node or edge, also where it is listed twice
  std::vector<PartPair> part_pairs;     ///< deepest first
  std::vector<ContactTotals> contacts;  ///< parallel to Scene::contacts
  ContactTotals total;                  ///< a node or edge in several contacts counts once
};

/// Forms all views; this is where penetrations are counted, for every medium. `crossings` is what
/// find_crossings gave for the scene. Costs time in proportion to the penetrations, not to the
/// model. The same view for any number of threads.
SceneView make_view(const Scene& scene, const std::vector<Crossing>* crossings = nullptr,
                    int threads = 1);

/// Positions in `secondary` of the nodes that a contact that ties does not tie; of all others, and
/// where it was not evaluated, none.
std::vector<std::uint32_t> untied_secondary(const Contact& contact);

/// The element behind a segment or edge; not valid for carriers without an element.
ElementName carrier_name(const Model& model, Carrier carrier, std::uint32_t element);

/// Ten times the model's size: a gap beyond it is no gap, but unbounded. Working units.
double largest_bounded_gap(const Model& model);

/// Why a contact without penetrations is no clean one.
enum class Obstacle {
  none,
  empty_main,       ///< nothing on a side: there can be no pair
  empty_secondary,  ///< the solver goes on where a node group is there, but empty
  no_gap,           ///< the solver stops (785, 786)
  no_area,          ///< a main segment without area: the solver stops (558)
  no_element,       ///< a segment or edge that belongs to no element: the solver stops (481, 482)
  no_stiffness,     ///< no main segment has stiffness: the solver searches none of them
};

/// The first of them that holds for a contact; none for one that the solver drops.
Obstacle obstacle_of(const Contact& contact);
std::string_view to_string(Obstacle obstacle);  ///< its name; empty: none

/// Solver error for a node exactly on a segment: 611, 612, or 0 where the options avoid it.
int on_surface_error(const Contact& contact);

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
