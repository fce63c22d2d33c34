// Repairs of initial penetrations and of ties that lose nodes: what all strategies take and report,
// and those that change an interface card — a smaller gap, Inacti, Fpenmax, a larger dsearch.
// Moving nodes is in depenetrate.hpp.
//
// A strategy only describes: the rewrite it proposes, what was found before and what is left after.
// "After" is never an expectation: the deck is read again with the proposed text and evaluated.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/contact/scene.hpp"
#include "deck/contact/ties.hpp"
#include "deck/edit/rewrite.hpp"

namespace deck {

struct FixOptions {
  int threads = 1;
  std::vector<std::int64_t> interfaces;  ///< ids to treat; empty: all
  /// TYPE10 ties what lies within its gap: that is no penetration, and untreated unless this is
  /// set. No other fix may loosen a tie, or make one.
  bool ties = false;
  /// Called with what is being done and (done, total); total 0: unknown. May be empty.
  std::function<void(std::string_view step, std::size_t done, std::size_t total)> progress;
};

/// Initial penetrations of one interface, all its contacts together. Lengths in working units.
struct FixCount {
  std::uint64_t pairs = 0;
  std::uint64_t nodes = 0;       ///< distinct secondary nodes or edges
  std::uint64_t untreated = 0;   ///< pairs about which the solver does nothing, or stops
  std::uint64_t on_surface = 0;  ///< pairs at distance 0
  double deepest = 0;
};

/// One changed cell of an interface card.
struct FieldChange {
  std::string field;
  std::string old_text, new_text;       ///< as on the card; old_text is empty for a blank cell
  double old_value = 0, new_value = 0;  ///< in effect; working units
};

struct FixedInterface {
  std::int64_t id = 0;
  int type = 0;
  std::string title;
  FixCount before, after;
  std::vector<FieldChange> changes;
};

struct MovedNode {
  std::int64_t id = 0;
  std::int64_t part = 0;       ///< 0: no part
  std::array<double, 3> by{};  ///< working units
  double distance = 0;
};

/// A penetration, a node that is not tied, or a whole interface (no nodes), that was not treated,
/// and why.
struct FixRefusal {
  std::int64_t interface_id = 0;
  std::vector<std::int64_t> nodes;  ///< the secondary node, or the two of an edge
  double depth = 0;                 ///< as it is now
  std::string reason;
  double distance = 0;  ///< of a node that is not tied, from its nearest segment; 0: there is none
};

/// A node that a fix ties.
struct NewlyTied {
  std::int64_t node = 0;
  std::vector<std::int64_t> segment;  ///< triangle: last repeated
  double distance = 0;
};

/// A TYPE2 that lost nodes.
struct FixedTie {
  std::int64_t id = 0;
  std::string title;
  double reach = 0;  ///< how far its nodes may be; working units
  TieCounts before, after;
  double needed = 0;             ///< farthest of the nodes that are tied now; 0: none are
  std::vector<NewlyTied> nodes;  ///< ascending ids
  std::vector<FieldChange> changes;
};

/// What the solver will do about one penetration, before and after the change.
struct FixAction {
  std::int64_t interface_id = 0;
  std::vector<std::int64_t> secondary, main;  ///< node ids
  double depth = 0, gap = 0;
  PenetrationAction before = PenetrationAction::none, after = PenetrationAction::none;
  bool stops = false;  ///< the solver stops at this pair after the change
  double gap0 = 0;     ///< gap left where it is reduced
};

struct PenetrationFix {
  std::string strategy;
  Rewrite rewrite;
  std::vector<FixedInterface> interfaces;  ///< those with penetrations, before or after; by id
  std::vector<MovedNode> moved;            ///< by node id
  std::vector<FixRefusal> refused;         ///< by interface, deepest first
  std::vector<FixAction> actions;          ///< Inacti, Fpenmax: by interface, deepest first
  std::vector<FixedTie> ties;              ///< tie: those that lose nodes; by position in the deck
  std::uint64_t crossings_before = 0, crossings_after = 0;  ///< where nodes move: crossed elements
  /// Of ties that stay as they are, TYPE2 among them: the same before and after.
  std::uint64_t tied_pairs = 0, tied_nodes = 0;
  int iterations = 0;
  bool complete = false;  ///< nothing is left of what the strategy treats
};

struct ReduceGapOptions : FixOptions {
  /// The new gap is at least this share of the present one; otherwise the interface is refused.
  double least_share = 0.5;
  /// Significant digits of the new values; they are rounded down.
  int digits = 6;
};
/// Gives every interface with penetrations the largest gap that leaves none: Gapmin where the gap
/// is constant, the better of Fscalegap and Gapmax where it follows the thickness (Igap 1 becomes 2
/// for that, which is the same with Fscalegap 1). TYPE25: the better of Gap_scale and Gap_max_s
/// with Gap_max_m; TYPE24: the latter. A cell is only ever lowered. Error: the deck cannot be read
/// again.
Result<PenetrationFix> reduce_gaps(const LoadedDeck& context, const ReduceGapOptions& options);

struct InactiOptions : FixOptions {
  std::optional<int> inacti;  ///< absent: 6; TYPE24 and TYPE25: 5
};
/// Sets Inacti where there are penetrations. Refused: values that the solver does not take or that
/// do nothing for the type, and interfaces where it would stop at a node at distance 0.
Result<PenetrationFix> set_inacti(const LoadedDeck& context, const InactiOptions& options);

struct FpenmaxOptions : FixOptions {
  /// Penetrations deeper than this share of the gap lose their node: its contact is off for the
  /// whole interface. Absent: the smallest value that drops nothing but nodes at distance 0, at
  /// which the solver would stop.
  std::optional<double> ratio;
};
/// Sets Fpenmax of TYPE7 interfaces; all other penetrations stay with Inacti.
Result<PenetrationFix> set_fpenmax(const LoadedDeck& context, const FpenmaxOptions& options);

struct TieOptions : FixOptions {
  /// Nodes farther from their segment stay as they are, working units. Absent: for each interface
  /// as far as the solver looks where dsearch and Ignore are blank, the mean side of its segments.
  std::optional<double> reach;
};
/// Raises dsearch of every TYPE2 that loses nodes to what those within reach need. A node stays as
/// it is where something else holds it (another tie, a rigid body ...) or where tying it would stop
/// the solver; dsearch then stays below what would tie it. Whatever was tied stays tied to the same
/// segment. Not treated, with the reason: Isearch 1, Ignore above 3, surfaces as secondary side.
Result<PenetrationFix> tie_nodes(const LoadedDeck& context, const TieOptions& options);

/// One strategy of several.
using FixStep = std::function<Result<PenetrationFix>(const LoadedDeck& context)>;
struct FixSequence {
  std::vector<PenetrationFix> fixes;  ///< one a step; rewrites are of the deck before that step
  ChangedFiles changed;               ///< by all steps together, against the deck as given
};
/// Each step acts on the deck with what the steps before have changed.
Result<FixSequence> fix_in_order(const LoadedDeck& context, const std::vector<FixStep>& steps);
/// What a fix comes to, in pairs: those that it solves, those that it leaves though it changes
/// something for them, and those that it does not treat (PenetrationFix::refused says why). For
/// inacti and fpenmax only pairs without treatment by the solver count; for tie nodes.
struct FixScore {
  std::uint64_t solved = 0, left = 0, not_treated = 0;
  std::uint64_t all() const { return solved + left + not_treated; }
};
FixScore score_of(const PenetrationFix& fix);
/// The one that leaves least, of equals the first.
/// nullptr: no proposal leaves fewer than there are.
const PenetrationFix* best_of(const std::vector<PenetrationFix>& proposals);
/// The report where no proposal is taken: the penetrations of the deck as it is, and no changes.
PenetrationFix unchanged(const std::vector<PenetrationFix>& proposals);

/// Several fixes as one report: strategies by commas, before of the first, after, actions and
/// what is not treated of the last. Its rewrite is empty.
PenetrationFix combined(const std::vector<PenetrationFix>& fixes);

}  // namespace deck
