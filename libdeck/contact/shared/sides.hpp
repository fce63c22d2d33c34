// The sides of a contact as the pair search takes them: plain arrays, with only those that the
// contact's rules look at. Private to the library.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "contact/search/sweep.hpp"
#include "deck/contacts.hpp"

namespace deck::detail {

class SearchSides {
 public:
  /// What start-up switched off (Inacti, Fpenmax) takes part or not.
  enum class Off : bool { included, left_out };

  SearchSides(const Contact& contact, Off off, int threads = 1);

  bool edge_pairs() const { return kind_ == ContactKind::edge_edge; }
  /// Views of the arrays: valid as long as this object and the coordinates.
  NodeSegmentInput nodes(const Coordinates& x) const;
  EdgeEdgeInput edges(const Coordinates& x) const;
  /// The pairs of either kind.
  SearchResult find(const Coordinates& x, const SearchOptions& options) const;
  /// Besides, those that only the robust form finds, with a margin of its own.
  sweep::BothForms find_both_forms(const Coordinates& x, const SearchOptions& options,
                                   double robust_margin) const;
  /// The solver's margin beyond the gap, from the mean edge length of the searched sides.
  double margin(const Coordinates& x) const;

 private:
  struct Side {
    std::vector<double> gap, length,
        stiffness;  ///< empty where they say nothing
  };
  /// Fills the arrays of a side: active(item) says that it takes part, as(item) what stands in
  /// `out`.
  template <class Item, class Out, class Active, class As>
  void fill(Side& side, const std::vector<Item>& items, std::vector<Out>& out, const Active& active,
            const As& as) const;

  int threads_;
  ContactKind kind_;
  bool lengths_;
  std::vector<std::uint32_t> nodes_;
  std::vector<std::array<std::uint32_t, 4>> segments_;
  std::array<std::vector<std::array<std::uint32_t, 2>>, 2> edges_;
  std::array<Side, 2> sides_;
};

// Irem_gap = 2: secondary nodes (edges) of a self contact that lie within sqrt(2) gaps of a main
// segment (edge) along the mesh are not paired with it.

/// Per main item: secondary positions not to be paired with it, sorted. Empty if nothing is
/// removed.
using RemovalLists = std::vector<std::vector<std::uint32_t>>;
bool is_removed(const RemovalLists& lists, const CandidatePair& pair);

/// What removal has to know of a contact's gaps.
struct RemovalGaps {
  PairGap rule;
  int igap = 0;
  double drad = 0, largest = 0, shortest_side = 0;
};

/// False: the lists would have more than `most_entries`. Of the inputs stiffnesses are not used;
/// gaps and lengths are as long as their lists.
bool remove_along_mesh(const NodeSegmentInput& contact, const RemovalGaps& gaps,
                       std::uint64_t most_entries, RemovalLists& lists);
bool remove_along_mesh(const EdgeEdgeInput& contact, const RemovalGaps& gaps,
                       std::uint64_t most_entries, RemovalLists& lists);

}  // namespace deck::detail
