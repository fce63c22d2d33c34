// One contact in one evaluation, and what it remembers until the next. Private to the stage.
#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "contact/shared/node_elements.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {

// One contact point, one force: pairs of neighbouring segments or edges that meet the other side at
// the same edge or corner share its force instead of adding up. Part of the robust model; works on
// finished packets, as single pairs know nothing of one another.

/// Share of each pair, 0 to 1. A pair whose closest point lies on an edge or corner of its segment
/// (its edges) yields to pairs of the same secondary side that contain this edge or corner: it
/// counts nothing where one of them comes closer elsewhere, and 1/n where n pairs meet in the same
/// point. So a node over a flat mesh is pushed once wherever it is, and over a convex edge the
/// force turns without a jump. In an obtuse valley, where both sides push by right, a side lets go
/// at once when the node's foot on it leaves the segment. Pairs without contact have the share 1.
///
/// Weights below 1e-12 count as 0, distances as equal within 1e-12 of themselves: the numbers come
/// from different segments with different roundings.
[[nodiscard]] std::vector<double> pair_shares(const PairList& pairs, const PacketResult& result);

/// Multiplies what adds up at the nodes: forces, stiffness, energies, heat. A pair with the share 0
/// is no contact any more and limits no step; its penetration stays.
void apply_shares(const std::vector<double>& share, PacketResult& result);

namespace detail {

/// What a pair takes into the next evaluation; pairs with nothing to remember are not kept.
struct PairMemory {
  CandidatePair at;
  double p0 = 0.0;              ///< Inacti 5, 6: residual penetration
  std::array<double, 3> ft{};   ///< friction memory
  std::array<double, 8> tie{};  ///< tie record; first 0: not tied
};

/// Where the nodes of both sides were when the pairs were searched.
class SearchedAt {
 public:
  void take(const Contact& contact, const Coordinates& x);
  /// How far the sides can have come nearer since: the solver's re-sort test.
  [[nodiscard]] double approach(const Coordinates& x) const;

 private:
  std::array<std::vector<NodeIndex>, 2> nodes_;
  std::array<std::array<std::vector<double>, 3>, 2> x_;
};

/// The nodes of one contact's pairs, numbered on their own in their order, so that the work of a
/// small contact does not grow with the model.
class LocalNodes {
 public:
  LocalNodes(const PairList& pairs, const std::vector<double>& mass);
  [[nodiscard]] std::size_t size() const { return node_.size(); }
  [[nodiscard]] NodeIndex global(std::size_t local) const { return node_[local]; }
  [[nodiscard]] const std::vector<double>& mass() const { return mass_; }
  /// `pairs` come with nodes of the model and leave with those of this contact.
  void localise(PairList& pairs) const;

 private:
  /// 64 nodes of the model: which of them take part, and how many before them.
  struct Word {
    std::uint64_t bits = 0;
    std::uint32_t before = 0;
  };
  static std::uint64_t bit_of(NodeIndex n) { return std::uint64_t{1} << (n % 64); }
  std::size_t first_word_ = 0;
  std::vector<Word> words_;
  std::vector<NodeIndex> node_;
  std::vector<double> mass_;
};

struct ContactMemory {
  std::optional<KernelPlan> plan;
  bool started = false;                ///< some evaluation has been done
  std::vector<PairMemory> pairs;       ///< in the order of the search
  std::vector<std::uint8_t> off;       ///< by secondary node or edge: out of the interface for good
  std::vector<std::uint8_t> main_off;  ///< by main segment or edge, Idel
  std::vector<CandidatePair> tied_elsewhere;  ///< Irem_i2: pairs that are dropped, sorted
  /// Inacti 5, 6 between edges: what is taken off now, and the most that pairs of this cycle allow.
  std::array<std::vector<double>, 2> used, most;
  ContactPairs candidates;
  SearchedAt searched;
  bool has_candidates = false;
  std::size_t searches = 0, deaths = 0;
};

/// What the pairs of one evaluation bring along, beside the values they were found with: stiffness,
/// residual penetration, friction memory and ties; those that are empty are 0.
struct PairInputs : PairArrays<std::vector<double>> {
  std::vector<double> zero;
};

/// Points the view at the pairs' own arrays, from pair `begin` on; `in` starts with that pair. Both
/// outlive the view.
void attach(PacketView& view, const ContactPairs& pairs, const PairInputs& in,
            std::size_t begin = 0);

/// What all contacts of one evaluation share.
struct RunContext {
  const Scene& scene;
  const Coordinates& x;  ///< where the nodes are now
  const State& state;
  const CycleOptions& options;
  bool remember = false;             ///< a further evaluation may follow
  std::vector<std::uint8_t>& fixed;  ///< fixed translations by node, 4 X + 2 Y + Z; empty: none
  Connectivity& connectivity;
};

using NodeStiffness = std::vector<std::pair<NodeIndex, double>>;

/// Evaluates one contact; returns the stiffness it gives to its nodes, in the order of nodes.
NodeStiffness run_contact(const RunContext& run, ContactMemory& memory, ContactOutcome& out,
                          NodalSums& all);

/// The interface-wide limit from the velocity ranges of all nodes of both sides.
double velocity_limit(const Contact& contact, const ContactCard& card, const State& state);
/// False for cards with values that no arithmetic survives, such as a gap of 1e300.
bool sane(const ContactCard& card, const Contact& contact);
/// Why a curved main side cannot be computed with; empty if it can.
std::string curvature_problem(const Scene& scene, const Contact& contact, const ContactCard& card);
/// Before the first evaluation: who takes no part from the beginning.
void begin(const RunContext& run, const Contact& contact, ContactMemory& m);

/// Translations that /BCS fix, by node: 4 X + 2 Y + Z.
std::vector<std::uint8_t> fixed_translations(const deck::Model& model);
/// Pairs that a tie (/INTER/TYPE2) holds already, sorted: those of a tied node with segments that
/// share a corner with the one it is tied to, and those of segments at a tied node with the corners
/// of that one.
std::vector<CandidatePair> pairs_around_ties(const RunContext& run, const Contact& contact);

/// Idel: takes out main segments and edges whose elements are gone at this time, and secondary
/// nodes (edges) without any element left; those go into `removed`.
void follow_dead_elements(const RunContext& run, const Contact& contact, int idel,
                          ContactMemory& memory, std::vector<Removal>& removed);

}  // namespace detail
}  // namespace deck::cycle
