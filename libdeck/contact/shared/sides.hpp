// Sides of a contact as plain arrays for the pair search, reduced to items that its rules use.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "contact/search/sweep.hpp"
#include "deck/contacts.hpp"

namespace deck::detail {

class SearchSides {
 public:
  /// Items that start-up switched off (Inacti, Fpenmax).
  enum class Off : bool { included, left_out };

  SearchSides(const Contact& contact, Off off, int threads = 1);

  bool edge_pairs() const { return kind_ == ContactKind::edge_edge; }
  /// Views of the arrays: valid while this object, the contact and the coordinates live.
  NodeSegmentInput nodes(const Coordinates& x) const;
  EdgeEdgeInput edges(const Coordinates& x) const;
  SearchResult find(const Coordinates& x, const SearchOptions& options) const;
  /// Also finds pairs of the robust form only, with its own margin.
  sweep::BothForms find_both_forms(const Coordinates& x, const SearchOptions& options,
                                   double robust_margin) const;
  /// Calls reach_after(pair) for pairs nearer than `reach`. It returns the reach for the pairs that
  /// follow: with the least distance so far, they are few. If they are more than `limit`, the reach
  /// is halved, up to eight times.
  void find_nearest(const Coordinates& x, double reach, std::size_t limit,
                    const std::function<double(const CandidatePair&)>& reach_after) const;
  /// Margin of the solver beyond the gap, from the mean edge length of the main segments.
  double margin(const Coordinates& x) const;
  /// A length of the mesh: the mean of some edges of the main side.
  double edge_length(const Coordinates& x) const;

 private:
  struct Side {
    std::vector<double> gap, stiffness;  ///< empty if all 0; if all active
    std::span<const double> length;      ///< of the contact
  };
  /// Fills the arrays of a side with as(item) for the items with active(item).
  template <class Item, class Out, class Active, class As>
  void fill(Side& side, const std::vector<Item>& items, std::vector<Out>& out, const Active& active,
            const As& as) const;

  int threads_;
  ContactKind kind_;
  bool all_gaps_;  ///< removal along the mesh reads them, whatever they are
  std::vector<std::uint32_t> nodes_;
  std::vector<std::array<std::uint32_t, 4>> segments_;
  std::array<std::vector<std::array<std::uint32_t, 2>>, 2> edges_;
  std::array<Side, 2> sides_;
};

// Irem_gap = 2: a main segment (edge) of a self contact is not paired with secondary nodes (edges)
// within sqrt(2) gaps of it along the mesh.

/// Per main item: sorted positions of secondary items not paired with it. Empty if none.
using RemovalLists = std::vector<std::vector<std::uint32_t>>;
bool is_removed(const RemovalLists& lists, const CandidatePair& pair);

/// Gaps of a contact, for removal.
struct RemovalGaps {
  PairGap rule;
  int igap = 0;
  double drad = 0, largest = 0, shortest_side = 0;
};

/// Irem_gap 2 (penetrations.cpp). False if the lists do not fit into memory.
bool find_removed(const Scene& scene, const Contact& contact, const SearchSides& sides,
                  RemovalLists& removed);
/// False if there would be more than `most_entries`. Ignores stiffnesses; gaps match their lists.
bool remove_along_mesh(const NodeSegmentInput& contact, const RemovalGaps& gaps,
                       std::uint64_t most_entries, RemovalLists& lists);
bool remove_along_mesh(const EdgeEdgeInput& contact, const RemovalGaps& gaps,
                       std::uint64_t most_entries, RemovalLists& lists);

}  // namespace deck::detail
