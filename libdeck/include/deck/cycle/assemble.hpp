// From nodes to packets and back: gathers nodal arrays into a packet, and adds pair results to the
// nodes in an order that does not depend on the number of threads.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "deck/cycle/kernel.hpp"

namespace deck::cycle {

/// Nodal arrays, one entry per node. Null: 0 (velocity, temperature), or the plan needs none.
struct NodalState {
  std::array<const double*, 3> position{};
  std::array<const double*, 3> velocity{};
  const double* mass = nullptr;
  const double* temperature = nullptr;
};

/// Node indices of each pair by role (see PacketView). Edge contacts leave role 4 empty.
struct PairList {
  ContactKind kind = ContactKind::node_segment;
  std::array<std::vector<std::uint32_t>, 5> node;
  std::vector<std::uint8_t> triangle;  ///< empty: none; node-segment pairs only
  [[nodiscard]] std::size_t size() const { return node[0].size(); }
};

/// Owns the gathered arrays of a packet. Only the fields asked for are read from the nodes.
class PacketBuffer {
 public:
  /// Fills position, velocity, mass and temperature of the pairs as far as `needs` asks.
  void gather(const NodalState& nodes, const PairList& pairs, Field needs);
  /// The gathered arrays; the caller adds stiffness, gap and history arrays of its own.
  [[nodiscard]] PacketView view() const;

 private:
  std::size_t size_ = 0;
  PairArrays<std::vector<double>> of_;
  std::vector<std::uint8_t> triangle_;
};

/// Sums at the nodes.
struct NodalSums {
  std::array<std::vector<double>, 3> force;
  std::vector<double> stiffness;
  std::vector<double> heat;         ///< empty: no contact of a scene asks for it
  std::vector<double> conductance;  ///< the same
  /// Heat of a node, 0 where no contact asks for it.
  double heat_of(std::size_t node) const { return heat.empty() ? 0.0 : heat[node]; }
  std::vector<std::uint8_t> contact;   ///< 1 when a pair of the node has a force (Ibag, Iadm)
  std::vector<std::uint8_t> removed;   ///< 1 when the node (edge) is to leave the interface
  std::vector<std::uint8_t> released;  ///< translations to free, 4 X + 2 Y + 1 Z (IBC)
  void resize(std::size_t nodes, bool heated = true);
};

/// Adds a result to the nodes in pair order, from one thread. `sums` must be sized; it is added to,
/// so several interfaces in turn can share it, and results can come piece by piece.
void assemble(const KernelPlan& plan, const PairList& pairs, const PacketResult& result,
              NodalSums& sums);

/// What limits the time step of an interface, and by how much.
struct StepLimit {
  enum class Source { none, kinematic, nodal, velocity } source = Source::none;
  double dt = 1e30;
  std::size_t index = SIZE_MAX;  ///< pair (kinematic) or node (nodal)
};

/// Smallest of: the pairs' kinematic limit, factor * sqrt(2 m / S) over nodes with mass and contact
/// stiffness, and the interface's velocity limit (pass 1e30 to leave it out).
[[nodiscard]] StepLimit step_limit(const Totals& totals, const NodalSums& sums, const double* mass,
                                   double factor = 0.9, double velocity_limit = 1e30);

/// Interface-wide limit 0.9 g / |Vmax| from velocity ranges of both sides (x, y, z).
[[nodiscard]] double velocity_step(double gap, const std::array<double, 3>& secondary_min,
                                   const std::array<double, 3>& secondary_max,
                                   const std::array<double, 3>& main_min,
                                   const std::array<double, 3>& main_max);

}  // namespace deck::cycle
