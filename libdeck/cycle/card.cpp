// Turns the effective values of an interface into the plain numbers of the force kernel.
#include "deck/cycle/packet.hpp"

#include <algorithm>
#include <cstdlib>

namespace deck::cycle {

double Curve::operator()(double abscissa) const {
  if (x.empty() || x.size() != y.size()) return 0.0;
  if (x.size() == 1) return y.front();
  // The segment whose right end is the first abscissa not below the argument; the end segments
  // carry on outside.
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
