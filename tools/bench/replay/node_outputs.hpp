// Nodal results: running values of a cycle after each packet of pairs.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "replay/states.hpp"
#include "replay/table.hpp"

namespace deck::cycle::detail {

/// Sets R_s, R_1 ... R_4, P_s, A_s (criteria of Iadm: running extremes of the cycle), bc_out
/// (remaining fixed translations) and stfs_out (secondary stiffness; negative: node to be switched
/// off). The solver works in packets of 64 candidates; a row has the nodal values after its packet.
/// With a deck, every node is a candidate of every segment, node by node, as in records with driven
/// steps; without a deck all rows of a cycle are one packet.
class NodeOutputs {
 public:
  NodeOutputs(const ContactCard& card, const Table& table, const RecordedDeck& deck,
              ResultTable& out);
  /// Adds n results for rows out.row[at], ..., all of one cycle.
  void collect(const PacketResult& result, std::size_t at, std::size_t n);

 private:
  struct Node {
    double radius = 1e30, penetration = 0.0, angle = 1e30;
    bool off = false, released = false;
  };
  [[nodiscard]] std::size_t packet_of(std::size_t row) const;
  void add(const PacketResult& result, std::size_t i, std::size_t row);
  void show(std::size_t index, std::size_t row);
  const ContactCard& card_;
  const RecordedDeck& deck_;
  ResultTable& out_;
  std::array<const double*, 5> id_{};
  const double* bc_in_;
  const double* cycle_;
  std::array<std::vector<double>*, 5> radius_{};
  std::vector<double>*penetration_, *angle_, *bc_out_, *stiffness_;
  bool wanted_ = false;
  double current_cycle_ = -1.0;
  std::map<double, Node> nodes_;
};

}  // namespace deck::cycle::detail
