// Recorded states as arrays of the kernel: input columns, values as used by the solver, additional
// data of the deck.
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

/// Error if columns for the kind or card are missing; else empty.
std::string check_columns(const Table& table, const std::string& kind, const ContactCard& card);

/// The deck of a record, accessed by ids. Without a deck everything is unknown.
class RecordedDeck {
 public:
  RecordedDeck(const Scene* scene, const Table& table);
  /// Positions of a row's secondary node and main segment in a contact; nullopt: no such pair.
  struct RowPlace {
    const deck::Contact* contact = nullptr;
    CandidatePair pair;
    std::size_t candidate = 0;  ///< node by node, segments by element id
  };
  [[nodiscard]] std::optional<RowPlace> place(std::size_t row) const;
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
    std::vector<std::size_t> rank;  ///< rank of each main segment by element id
  };
  std::vector<Lists> lists_;
};

/// Inputs of the kernel. Values in rows override those of the card.
class States {
 public:
  /// `card`: of the deck; `as_used`: use values recorded as used; `error`: an effect lacks its
  /// input.
  States(const Table& table, const std::string& kind, const RecordedDeck& deck, bool as_used,
         ContactCard card, std::string& error);
  [[nodiscard]] const ContactCard& card() const { return card_; }
  [[nodiscard]] const PacketView& all() const { return view_; }
  /// Rows [first, first + n).
  [[nodiscard]] PacketView rows(std::size_t first, std::size_t n) const;

 private:
  void read_geometry(const Table& table, bool edges);
  void read_ties(const Table& table, bool tied);
  void read_friction(const Table& table, const RecordedDeck& deck, bool as_used,
                     std::string& error);
  void read_own_friction(const Table& table, const RecordedDeck& deck, std::string& error);
  ContactCard card_;
  PacketView view_;
  std::vector<double> residual_, visf2_, directed_;  ///< computed columns
  std::vector<std::uint8_t> triangle_;
  ContactPairs own_;  ///< friction from the deck
};

}  // namespace deck::cycle::detail
