// Memory of a packet (arrays and their sizes), and derived values of a card.
#include "deck/cycle.hpp"

#include <algorithm>
#include <cstdlib>

namespace deck::cycle {

void PacketResult::resize(std::size_t n) {
  size = n;
  for_each_array(*this, [n](auto& array, Field, auto value) { array.assign(n, value); });
  dirty_ = Field::none;
}

void PacketResult::prepare(std::size_t n, Field writes) {
  if (n != size) resize(n);
  if (contains(writes, Field::tie_record)) {
    // Ties write to arrays of any group.
    resize(n);
    dirty_ = static_cast<Field>(~0u);
    return;
  }
  for_each_array(*this, [&](auto& array, Field group, auto value) {
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

double Curve::operator()(double abscissa) const {
  if (x.empty() || x.size() != y.size()) return 0.0;
  if (x.size() == 1) return y.front();
  // The segment whose right end is the first abscissa not below the argument. End segments
  // extrapolate.
  const auto it = std::lower_bound(x.begin() + 1, x.end() - 1, abscissa);
  const std::size_t right = static_cast<std::size_t>(it - x.begin());
  const double dx = std::max(x[right] - x[right - 1], 1e-16);
  return y[right - 1] + (y[right] - y[right - 1]) / dx * (abscissa - x[right - 1]);
}

bool is_active(const ContactCard& card, double t) {
  const bool window = card.tstart <= t && t <= card.tstop;
  return window && (!card.sensor_time || t >= *card.sensor_time);
}

bool segment_stays(int idel, int live_elements, bool own_element_alive) {
  switch (std::abs(idel)) {
    case 1:
      return live_elements > 0;
    case 2:
      return own_element_alive;
    default:
      return true;
  }
}

bool secondary_stays(int idel, int live_elements) {
  return (idel != 1 && idel != 2) || live_elements > 0;
}

}  // namespace deck::cycle
