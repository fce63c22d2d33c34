// Memory of a packet: its arrays, their sizes, and views of them.
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
  dirty_ = Field::none;
}

void PacketResult::prepare(std::size_t n, Field writes) {
  if (n != size) resize(n);
  if (contains(writes, Field::tie_record)) {
    // Ties write here and there, in arrays of any group.
    resize(n);
    dirty_ = static_cast<Field>(~0u);
    return;
  }
  const auto clear = [&](Field group, double value, auto&... arrays) {
    if (contains(dirty_, group) && !contains(writes, group)) (arrays.assign(n, value), ...);
  };
  clear(Field::residual_penetration, 0.0, p0);
  clear(Field::friction_memory, 0.0, ft[0], ft[1], ft[2]);
  clear(Field::elastic_energy, 0.0, elastic_energy);
  clear(Field::friction_energy, 0.0, friction_energy, friction_heat);
  clear(Field::damping_energy, 0.0, damping_energy);
  clear(Field::kinematic_step, 1e30, dt_kinematic);
  clear(Field::heat, 0.0, heat[0], heat[1], heat[2], heat[3], heat[4], conductance);
  clear(Field::criteria, 0.0, criteria[0], criteria[1], criteria[2]);
  clear(Field::tie_record, 0.0, tie[0], tie[1], tie[2], tie[3], tie[4], tie[5], tie[6], tie[7]);
  dirty_ = writes;
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
