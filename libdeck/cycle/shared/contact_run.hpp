// One contact in one evaluation, and its memory until the next.
#pragma once
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "contact/shared/node_elements.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {

// Neighbouring segments or edges that meet the other side at a common edge or corner share one
// force instead of adding two. Robust model only. Needs a finished packet: single pairs do not know
// their neighbours.

/// Share of each pair, 0 to 1. A pair whose closest point lies on an edge or corner of its segment
/// yields to pairs of its secondary item that contain this edge or corner: share 0 if one of them
/// is closer elsewhere, 1/n if n pairs meet in this point. Over a flat mesh a node is pushed once
/// everywhere; over a convex edge the force turns without a jump. In an obtuse valley both sides
/// push, and a side stops when the node's foot leaves its segment. Pairs without contact have share
/// 1.
/// Weights below 1e-12 count as 0, and distances within a relative 1e-12 as equal: they come from
/// different segments with different round-off.
[[nodiscard]] std::vector<double> pair_shares(const PairList& pairs, const PacketResult& result);

/// Scales everything that is summed at nodes: forces, stiffness, energies, heat. A pair with share
/// 0 is no longer a contact and limits no step; its penetration stays.
void apply_shares(const std::vector<double>& share, PacketResult& result);

namespace detail {

/// Memory of a pair until the next evaluation; pairs without memory are left out.
struct PairMemory {
  CandidatePair at;
  double p0 = 0.0;              ///< Inacti 5, 6: residual penetration
  std::array<double, 3> ft{};   ///< friction memory
  std::array<double, 8> tie{};  ///< tie record; first 0: not tied
};

/// Positions of the nodes of both sides at the last pair search.
class SearchPositions {
 public:
  void record(const Contact& contact, const Coordinates& x);
  /// Upper bound of the approach of both sides since: the solver's re-sort test.
  [[nodiscard]] double approach(const Coordinates& x) const;

 private:
  std::array<std::vector<NodeIndex>, 2> nodes_;
  std::array<std::array<std::vector<double>, 3>, 2> x_;
};

/// Nodes of one contact's pairs, numbered from 0 in model order: a small contact costs little in a
/// large model.
class LocalNodes {
 public:
  LocalNodes(const PairList& pairs, const std::vector<double>& mass);
  [[nodiscard]] std::size_t size() const { return node_.size(); }
  [[nodiscard]] NodeIndex global(std::size_t local) const { return node_[local]; }
  [[nodiscard]] const std::vector<double>& mass() const { return mass_; }
  /// Replaces nodes of the model by nodes of this contact.
  void localise(PairList& pairs) const;

 private:
  /// 64 nodes of the model: bits of the nodes that take part, and the number of nodes before.
  struct NodeWord {
    std::uint64_t bits = 0;
    std::uint32_t before = 0;
  };
  static std::uint64_t bit_of(NodeIndex n) { return std::uint64_t{1} << (n % 64); }
  std::size_t first_word_ = 0;
  std::vector<NodeWord> words_;
  std::vector<NodeIndex> node_;
  std::vector<double> mass_;
};

struct ContactMemory {
  std::optional<KernelPlan> plan;
  bool started = false;                       ///< an evaluation has run
  std::vector<PairMemory> pairs;              ///< in the order of the search
  std::vector<std::uint8_t> off;              ///< by secondary node or edge: removed for good
  std::vector<std::uint8_t> main_off;         ///< by main segment or edge: removed (Idel)
  std::vector<CandidatePair> tied_elsewhere;  ///< Irem_i2: pairs that are dropped, sorted
  /// Inacti 5, 6 between edges: present reduction, and the largest that pairs of this cycle allow.
  std::array<std::vector<double>, 2> used, most;
  ContactPairs candidates;
  SearchPositions searched;
  bool has_candidates = false;
  std::size_t searches = 0, deaths = 0;
};

/// Memory of pairs as kernel input: stiffness, residual penetration, friction, ties. Empty: 0.
struct PairInputs : PairArrays<std::vector<double>> {
  std::vector<double> zero;
};

/// Points the view at arrays of the pairs from `begin` on; `in` starts with pair `begin`. Both must
/// outlive the view.
void attach(PacketView& view, const ContactPairs& pairs, const PairInputs& in,
            std::size_t begin = 0);

/// Data that all contacts of one evaluation share.
struct RunContext {
  const Scene& scene;
  const Coordinates& x;  ///< current positions
  const State& state;
  const CycleOptions& options;
  bool remember = false;             ///< a further evaluation may follow
  std::vector<std::uint8_t>& fixed;  ///< fixed translations by node, 4 X + 2 Y + Z; empty: none
  const std::map<NodeIndex, std::string>& unread;  ///< unread_at_nodes()
  Connectivity& connectivity;
};

using NodeStiffness = std::vector<std::pair<NodeIndex, double>>;

/// Evaluates one contact. Returns the stiffness at its nodes, in node order.
NodeStiffness run_contact(const RunContext& run, ContactMemory& memory, ContactOutcome& out,
                          NodalSums& all);

/// Interface-wide step limit from the velocity ranges of all nodes of both sides.
double velocity_limit(const Contact& contact, const ContactCard& card, const State& state);
/// False for cards whose values overflow, such as a gap of 1e300.
bool has_usable_values(const ContactCard& card, const Contact& contact);
/// Reason why a curved main side cannot be evaluated; empty if it can.
std::string curvature_problem(const Scene& scene, const Contact& contact, const ContactCard& card);
/// Why the stiffness of the pairs is not known; empty if it is.
std::string stiffness_problem(const RunContext& run, const Contact& contact);
/// Removes items that take no part from the beginning.
void begin(const RunContext& run, const Contact& contact, ContactMemory& m);

/// Translations that /BCS fix, by node: 4 X + 2 Y + Z.
std::vector<std::uint8_t> fixed_translations(const deck::Model& model);
/// Pairs that a tie (/INTER/TYPE2) replaces, sorted: a tied node with segments that share a corner
/// with its main segment, and segments at a tied node with the corners of that main segment.
std::vector<CandidatePair> pairs_around_ties(const RunContext& run, const Contact& contact);

/// Idel: removes main segments and edges whose elements are deleted at this time, and secondary
/// items without a living element; the latter go into `removed`.
void follow_dead_elements(const RunContext& run, const Contact& contact, int idel,
                          ContactMemory& memory, std::vector<Removal>& removed);

}  // namespace detail
}  // namespace deck::cycle
