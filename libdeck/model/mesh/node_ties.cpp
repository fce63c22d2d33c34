// Transfers mass, inertia and stiffness of tied nodes to the corners of their main segments, as the
// solver does before it lists nodal steps.
#include <algorithm>
#include <cmath>

#include "deck/keyword.hpp"
#include "deck/model.hpp"
#include "keyword/shared/solver_order.hpp"
#include "model/mesh/mesh_parts.hpp"

namespace deck::detail {
namespace {

using Weights = std::array<double, 4>;

/// Bilinear weights of the corners; a triangle repeats the last node.
Weights bilinear(double s, double t) {
  return {0.25 * (1 - s) * (1 - t), 0.25 * (1 + s) * (1 - t), 0.25 * (1 + s) * (1 + t),
          0.25 * (1 - s) * (1 + t)};
}

/// Moves the weights of three corners onto the triangle's border.
std::array<double, 3> clipped(std::array<double, 3> w) {
  const auto negative = std::count_if(w.begin(), w.end(), [](double x) { return x < 0.0; });
  if (negative == 0) return w;
  for (double& x : w) x = x < 0.0 ? 0.0 : negative == 2 ? 1.0 : x;
  const double sum = w[0] + w[1] + w[2];
  for (double& x : w) x /= sum;
  return w;
}

struct Shares {
  Weights stiffness{}, mass{};
};

Shares shares_of(const TiedNodes& tie, const TiedNodes::Row& row) {
  Shares out;
  if (row.main[2] == row.main[3]) {
    const Weights h = bilinear(row.s, row.t);
    std::array<double, 3> w{h[0], h[1], h[2] + h[3]};
    if (tie.spotflag == 27) w = {row.s, row.t, 1.0 - row.s - row.t};
    const std::array<double, 3> m = tie.rim ? clipped(w) : w;
    for (std::size_t i = 0; i < 3; ++i) {
      out.stiffness[i] = std::abs(w[i]);
      out.mass[i] = m[i];
    }
    return out;
  }
  const auto limited = [&](double v) { return tie.rim ? std::clamp(v, -1.0, 1.0) : v; };
  out.stiffness = bilinear(row.s, row.t);
  for (double& h : out.stiffness) h = std::abs(h);
  out.mass = bilinear(limited(row.s), limited(row.t));
  return out;
}

/// Forces of a unit moment about the centre of four nodes, limited as in the solver.
double moment_ratio(std::array<Vec, 4> x, const Vec& middle) {
  for (Vec& p : x) p = p - middle;
  const auto [xx, yy, zz, xy, yz, zx] = products(x);
  const double a = yy + zz, b = zz + xx, c = xx + yy;
  const double det = a * b * c - a * yz * yz - b * zx * zx - c * xy * xy - 2.0 * xy * yz * zx;
  const double b1 = c * b - yz * yz, b2 = a * c - zx * zx, b3 = b * a - xy * xy;
  const double c1 = a * yz + xy * zx, c2 = b * zx + xy * yz, c3 = c * xy + yz * zx;
  return std::max({b1 + c3 + c2, b2 + c1 + c3, b3 + c2 + c1}) / det;
}

/// Spotflags whose ties do not change nodal steps.
bool carries_nothing(int flag) {
  return (flag >= 2 && flag <= 4) || (flag >= 20 && flag <= 22) || flag == 26 || flag == 30;
}

}  // namespace

void NodeSums::clear(NodeIndex n) {
  to_.mass[n] = to_.inertia[n] = 0.0;
  to_.stiffness[n] = to_.rotational_stiffness[n] = no_stiffness;
}

/// By the position on the segment; the secondary node keeps its rotations.
void NodeSums::carry(const TiedNodes& tie, const TiedNodes::Row& row) {
  const Shares shares = shares_of(tie, row);
  const double m = to_.mass[row.node], k = to_.stiffness[row.node];
  for (std::size_t i = 0; i < 4; ++i) {
    if (i == 3 && row.main[3] == row.main[2]) break;
    to_.mass[row.main[i]] += shares.mass[i] * m;
    to_.stiffness[row.main[i]] += shares.stiffness[i] * k;
  }
  to_.mass[row.node] = to_.stiffness[row.node] = 0.0;
}

/// By a rigid arm from the centre of the segment.
void NodeSums::carry_moments(const TiedNodes& tie, const TiedNodes::Row& row,
                             const Places& places) {
  std::array<Vec, 4> x;
  Vec middle{};
  for (std::size_t i = 0; i < 4; ++i) {
    x[i] = places.at(row.main[i]);
    middle = middle + 0.25 * x[i];
  }
  const Vec arm = places.at(row.node) - middle;
  const double d = dot(arm, arm), r = moment_ratio(x, middle);
  const NodeIndex n = row.node;
  const double m = to_.mass[n], spin = to_.inertia[n] + m * d;
  const double k = to_.stiffness[n], turn = to_.rotational_stiffness[n] + k * d;
  const bool rotate = std::all_of(row.main.begin(), row.main.end(),
                                  [&](NodeIndex c) { return to_.inertia[c] != 0.0; });
  for (const NodeIndex c : row.main) {
    to_.stiffness[c] += 0.25 * k + r * turn;
    to_.mass[c] += 0.25 * m + (tie.spotflag == 1 ? r * spin : 0.0);
    if (rotate) to_.inertia[c] += 0.25 * spin;
  }
  clear(n);
}

void NodeSums::tie(const TiedNodes& tie, const Places& places, TieCounts& counts) {
  if (carries_nothing(tie.spotflag)) return;
  const bool by_place = tie.spotflag == 0 || tie.spotflag == 5 || tie.spotflag == 27;
  const bool by_arm = tie.spotflag == 1 || tie.spotflag == 28;
  for (const TiedNodes::Row& row : tie.rows) {
    const bool triangle = row.main[2] == row.main[3];
    if (row.penalty) {
      // The stiffness of the spring is not computed; masses stay.
      for (const NodeIndex c : row.main) {
        if (!std::isnan(to_.stiffness[c])) ++counts.penalty;
        to_.stiffness[c] = to_.rotational_stiffness[c] = not_known;
      }
    } else if (by_place) {
      carry(tie, row);
    } else if (by_arm && !triangle) {
      carry_moments(tie, row, places);
    } else {
      forget(row.node, counts.other);
      for (const NodeIndex c : row.main) forget(c, counts.other);
    }
  }
}

/// For ties whose nodes and segments are unknown.
void NodeSums::forget_tie(const Block& block, std::uint64_t& count) {
  if (model_.selections == nullptr || block.opaque) return;
  const Deck& deck = *model_.deck;
  const DecodedBlock d = decode(deck, block);
  if (carries_nothing(static_cast<int>(d.integer("Spotflag")))) return;
  if (const NodeSet* set = group_of(model_, block, d.integer("grnd_IDs")))
    for (const NodeIndex n : set->nodes) forget(n, count);
  const std::int64_t main = deck.shifted_id(block, "surf", d.integer("surf_IDm"));
  if (const auto outline = model_.selections->outline(main))
    outline->segments.for_each([&](const Segment& s) {
      for (const NodeIndex n : s.nodes) forget(n, count);
    });
}

void NodeSums::ties(const std::vector<TiedNodes>* ties, const Places& places) {
  TieCounts counts;
  for (const Block* const at : in_solver_order(*model_.deck, "/INTER")) {
    const Block& block = *at;
    if (block.schema == nullptr || block.schema->keyword != "/INTER/TYPE2") continue;
    if (const TiedNodes* found = tie_of(ties, block))
      tie(*found, places, counts);
    else
      forget_tie(block, counts.other);
  }
  if (counts.penalty > 0)
    left_out.push_back({"stiffness of nodes",
                        "a tied interface /INTER/TYPE2 holds them by penalty springs",
                        counts.penalty});
  if (counts.other > 0)
    left_out.push_back(
        {"steps of nodes", "a tied interface /INTER/TYPE2 changes them", counts.other});
}

}  // namespace deck::detail
