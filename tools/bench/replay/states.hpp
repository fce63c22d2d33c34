// Recorded states as the kernel's arrays: which columns are inputs, which of them were recorded as
// the reference solver used them, and what the deck beside the record adds.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "deck/cycle.hpp"
#include "replay/table.hpp"

namespace deck::cycle::detail {

/// node_segment, edge_edge, tied, heat or heat_edges.
std::string kind_of(const Table& table);

/// Empty, or what the states lack to be of their kind and of the card's.
std::string check_columns(const Table& table, const std::string& kind, const ContactCard& card);

/// The deck beside a record, asked by the ids in its rows. Without one everything is unknown.
class RecordedDeck {
 public:
  RecordedDeck(const Scene* scene, const Table& table);
  /// Positions of a row's secondary node and main segment in the lists of a contact; nothing when
  /// the deck has no such pair.
  struct Place {
    const deck::Contact* contact = nullptr;
    CandidatePair pair;
    std::size_t candidate = 0;  ///< node by node, segments by the ids of their elements
  };
  [[nodiscard]] std::optional<Place> place(std::size_t row) const;
  [[nodiscard]] bool known() const { return scene_ != nullptr; }
  [[nodiscard]] const Scene& scene() const { return *scene_; }

 private:
  void add(const deck::Contact& contact);
  const Scene* scene_;
  const double* interface_ = nullptr;
  std::array<const double*, 5> id_{};
  struct Lists {
    const deck::Contact* contact = nullptr;
    std::map<std::int64_t, std::uint32_t> secondary;
    std::map<std::array<std::int64_t, 4>, std::uint32_t> main;
    std::vector<std::size_t> rank;  ///< of each main segment, by the id of its element
  };
  std::vector<Lists> lists_;
};

/// The kernel's inputs. The card may be changed by it: values that rows carry replace its own.
class States {
 public:
  /// `card` is that of the deck; `as_used` takes what rows recorded as such; `error` is set when an
  /// effect of it lacks its inputs.
  States(const Table& table, const std::string& kind, const RecordedDeck& deck, bool as_used,
         ContactCard card, std::string& error);
  [[nodiscard]] const ContactCard& card() const { return card_; }
  [[nodiscard]] const PacketView& all() const { return view_; }
  /// Rows [first, first + n).
  [[nodiscard]] PacketView rows(std::size_t first, std::size_t n) const;

 private:
  void take_geometry(const Table& table, bool edges);
  void take_ties(const Table& table, bool tied);
  void take_friction(const Table& table, const RecordedDeck& deck, bool as_used,
                     std::string& error);
  void take_own_friction(const Table& table, const RecordedDeck& deck, std::string& error);

  ContactCard card_;
  PacketView view_;
  std::vector<double> residual_, visf2_, directed_;  ///< what no column holds as it is
  std::vector<std::uint8_t> triangle_;
  ContactPairs own_;  ///< friction looked up in the deck
};

}  // namespace deck::cycle::detail
