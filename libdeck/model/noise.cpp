// /RANDOM: the noise that the reference solver adds to all coordinates before contact is looked at.
// The generator was recovered from recorded coordinates: r' = (25173 r + 13849) mod 65536, r = 0 at
// the start, one number per coordinate in the order x y z of each node as read; the coordinate
// moves by noise * (2 r / 65536 - 1).
#include "model/model_build.hpp"

namespace deck::detail {

void apply_random_noise(BuildContext& context) {
  Model& m = context.model;
  if (!m.has_random) return;
  std::uint32_t state = 0;
  const auto next = [&] {
    state = (25173 * state + 13849) % 65536;
    return m.random_noise * (2 * (state / 65536.0) - 1);
  };
  for (std::size_t n = 0; n < m.nodes.size(); ++n) {
    m.nodes.x[n] += next();
    m.nodes.y[n] += next();
    m.nodes.z[n] += next();
  }
}

}  // namespace deck::detail
