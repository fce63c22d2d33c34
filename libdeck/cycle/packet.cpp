#include "deck/cycle/packet.hpp"

#include <algorithm>

namespace deck::cycle {
namespace {

template <class Arrays>
void resize_all(Arrays& arrays, std::size_t n) {
  for (auto& a : arrays) a.assign(n, {});
}

}  // namespace

void PacketResult::resize(std::size_t n) {
  size = n;
  resize_all(weights, n);
  resize_all(force, n);
  resize_all(normal, n);
  resize_all(ft, n);
  resize_all(tie, n);
  resize_all(heat, n);
  resize_all(criteria, n);
  for (auto* a :
       {&normal_force, &k_nodal, &penetration, &distance, &effective_gap, &p0, &elastic_energy,
        &friction_energy, &damping_energy, &friction_heat, &conductance}) {
    a->assign(n, 0.0);
  }
  dt_kinematic.assign(n, 1e30);
  status.assign(n, 0);
}

void Totals::add(const Totals& other) {
  for (std::size_t c = 0; c < 3; ++c) {
    normal[c] += other.normal[c];
    tangential[c] += other.tangential[c];
    moment[c] += other.moment[c];
  }
  normal_abs += other.normal_abs;
  total_abs += other.total_abs;
  elastic_energy += other.elastic_energy;
  friction_energy += other.friction_energy;
  damping_energy += other.damping_energy;
  friction_heat += other.friction_heat;
  if (other.dt_kinematic < dt_kinematic) {
    dt_kinematic = other.dt_kinematic;
    dt_kinematic_pair = other.dt_kinematic_pair;
  }
  contacts += other.contacts;
}

}  // namespace deck::cycle
