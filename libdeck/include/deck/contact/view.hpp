// Views of a scene for people: every penetration with its node, element and part ids, one row per
// node (the deepest), part pairs sorted by depth, and totals for the verdict.
#pragma once
#include <cstdint>
#include <optional>
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

}  // namespace deck
