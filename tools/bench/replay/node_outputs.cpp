// Running nodal results over the packets of a cycle.
#include "replay/node_outputs.hpp"

#include <algorithm>
#include <cmath>

namespace deck::cycle::detail {
namespace {

constexpr std::size_t packet_size = 64;

}  // namespace

NodeOutputs::NodeOutputs(const ContactCard& card, const Table& table, const RecordedDeck& deck,
                         ResultTable& out)
    : card_(card), deck_(deck), out_(out) {
  id_ = {table.column("node"), table.column("n1"), table.column("n2"), table.column("n3"),
         table.column("n4")};
  bc_in_ = table.column("bc_in");
  cycle_ = table.column("cycle");
  const auto column = [&](const std::string& name) -> std::vector<double>* {
    const auto it = std::find(out.names.begin(), out.names.end(), name);
    if (it == out.names.end()) return nullptr;
    wanted_ = true;
    return &out.columns[static_cast<std::size_t>(it - out.names.begin())];
  };
  radius_ = {column("R_s"), column("R_1"), column("R_2"), column("R_3"), column("R_4")};
  penetration_ = column("P_s");
  angle_ = column("A_s");
  bc_out_ = column("bc_out");
  stiffness_ = column("stfs_out");
  if (std::find(id_.begin(), id_.end(), nullptr) != id_.end()) wanted_ = false;
}

std::size_t NodeOutputs::packet_of(std::size_t row) const {
  const auto place = deck_.place(row);
  return place ? place->candidate / packet_size : 0;
}

void NodeOutputs::add(const PacketResult& r, std::size_t i, std::size_t row) {
  Node& secondary = nodes_[id_[0][row]];
  if ((r.status[i] & (status_gap_closed | status_step_deleted)) != 0) secondary.off = true;
  if ((r.status[i] & status_bc_release) != 0) secondary.released = true;
  if (!(r.criteria[0][i] > 0.0)) return;
  for (const double* id : id_) {
    Node& node = nodes_[id[row]];
    node.radius = std::min(node.radius, r.criteria[0][i]);
  }
  secondary.penetration = std::max(secondary.penetration, r.criteria[1][i]);
  if (card_.iadm == 2) secondary.angle = std::min(secondary.angle, r.criteria[2][i]);
}

void NodeOutputs::show(std::size_t index, std::size_t row) {
  for (std::size_t k = 0; k < 5; ++k)
    if (radius_[k] != nullptr) (*radius_[k])[index] = nodes_[id_[k][row]].radius;
  const Node& node = nodes_[id_[0][row]];
  if (penetration_ != nullptr) (*penetration_)[index] = node.penetration;
  if (angle_ != nullptr) (*angle_)[index] = node.angle;
  if (bc_out_ != nullptr && bc_in_ != nullptr) {
    const int before = static_cast<int>(bc_in_[row]);
    (*bc_out_)[index] = node.released ? before & ~card_.ibc : before;
  }
  if (stiffness_ != nullptr) {
    double size = 1.0;
    if (const auto place = deck_.place(row)) {
      const std::uint32_t s = place->pair.secondary;
      const std::vector<double>& nodal = place->contact->nodal_stiffness;
      size = card_.istf < 2  ? place->contact->secondary[s].multiplier
             : nodal.empty() ? 0.0
                             : nodal[s];
    }
    (*stiffness_)[index] = node.off ? -size : size;
  }
}

void NodeOutputs::collect(const PacketResult& result, std::size_t at, std::size_t n) {
  if (!wanted_) return;
  const double cycle = cycle_ != nullptr ? cycle_[out_.row[at]] : -1.0;
  if (cycle_ == nullptr || cycle != current_cycle_) nodes_.clear();
  current_cycle_ = cycle;
  for (std::size_t i = 0; i < n;) {
    const std::size_t packet = packet_of(out_.row[at + i]);
    std::size_t end = i;
    while (end < n && packet_of(out_.row[at + end]) == packet) {
      add(result, end, out_.row[at + end]);
      ++end;
    }
    for (; i < end; ++i) show(at + i, out_.row[at + i]);
  }
}

}  // namespace deck::cycle::detail
