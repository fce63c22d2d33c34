// Memory of a packet: its arrays, their sizes, and views of them.
#include "deck/cycle/packet.hpp"

#include <algorithm>

namespace deck::cycle {
void PacketResult::resize(std::size_t n) {
  size = n;
  each_array(*this, [n](auto& array, Field, auto value) { array.assign(n, value); });
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
  each_array(*this, [&](auto& array, Field group, auto value) {
    if (group != Field::none && contains(dirty_, group) && !contains(writes, group)) {
      array.assign(n, value);
    }
  });
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
