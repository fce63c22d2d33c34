// Shared by the contestants of the search benchmark: scene and test of a pair. A rival only brings
// its search structure.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "contact/shared/closest.hpp"
#include "deck/contacts.hpp"

namespace bench {

// Nodes, main segments, secondary nodes, gap per side (pair gap: the sum).
struct Scene {
  std::vector<double> x, y, z;
  std::vector<std::array<std::uint32_t, 4>> segments;
  std::vector<std::uint32_t> secondary;
  std::vector<double> segment_gap, secondary_gap;
  deck::NodeSegmentInput input() const {
    deck::NodeSegmentInput in;
    in.nodes = {x, y, z};
    in.secondary = secondary;
    in.segments = segments;
    in.secondary_gap = secondary_gap;
    in.segment_gap = segment_gap;
    return in;
  }
  deck::SearchOptions options() const {
    deck::SearchOptions o;
    o.gap = deck::PairGap::from_igap(1, 0.0);
    return o;
  }
};

// List of pairs, built within the measured time.
struct Answer {
  std::vector<deck::CandidatePair> pairs;
  void add(std::uint32_t secondary, std::uint32_t segment) {
    pairs.push_back({secondary, segment});
  }
};

// Number and order-independent hash of the pairs, computed outside of the measured time.
struct Digest {
  std::uint64_t count = 0, hash = 0;
  Digest() = default;
  explicit Digest(const Answer& answer) : count(answer.pairs.size()) {
    for (const deck::CandidatePair& pair : answer.pairs) {
      std::uint64_t v = (std::uint64_t{pair.secondary} << 32 | pair.main) * 0x9e3779b97f4a7c15ULL;
      v ^= v >> 29;
      hash += v * 0xbf58476d1ce4e5b9ULL;
    }
  }
  friend bool operator==(const Digest&, const Digest&) = default;
};

struct Bounds {
  std::array<double, 3> low, high;
};

// Box of a segment, widened by gap and round-off, so that no rival misses a pair.
inline Bounds segment_bounds(const Scene& s, std::size_t i, double extra = 0.0) {
  const auto& q = s.segments[i];
  Bounds b{};
  const std::array<const std::vector<double>*, 3> axes{&s.x, &s.y, &s.z};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& v = *axes[k];
    const double r = s.segment_gap[i] + extra;
    b.low[k] = std::min({v[q[0]], v[q[1]], v[q[2]], v[q[3]]}) - r;
    b.high[k] = std::max({v[q[0]], v[q[1]], v[q[2]], v[q[3]]}) + r;
    b.low[k] -= std::abs(b.low[k]) * 1e-12 + r * 1e-12;
    b.high[k] += std::abs(b.high[k]) * 1e-12 + r * 1e-12;
  }
  return b;
}

// Distance test of a pair, after a cheap box test.
inline bool within_gap(const Scene& s, std::uint32_t i, std::uint32_t j) {
  const std::uint32_t node = s.secondary[i];
  const auto& q = s.segments[j];
  const deck::Point3<double> p{s.x[node], s.y[node], s.z[node]};
  std::array<deck::Point3<double>, 4> c;
  for (std::size_t k = 0; k < 4; ++k) c[k] = {s.x[q[k]], s.y[q[k]], s.z[q[k]]};
  const double limit = s.secondary_gap[i] + s.segment_gap[j];
  const auto beyond = [](double v, double a, double b, double d, double e) {
    return std::max({std::min({a, b, d, e}) - v, v - std::max({a, b, d, e}), 0.0});
  };
  const double dx = beyond(p.x, c[0].x, c[1].x, c[2].x, c[3].x);
  const double dy = beyond(p.y, c[0].y, c[1].y, c[2].y, c[3].y);
  const double dz = beyond(p.z, c[0].z, c[1].z, c[2].z, c[3].z);
  if (dx * dx + dy * dy + dz * dz > limit * limit * (1 + 1e-9)) return false;
  if (node == q[0] || node == q[1] || node == q[2] || node == q[3]) return false;
  return deck::closest_on_segment<deck::Form::reference>(p, c, q[2] == q[3]).distance() < limit;
}

}  // namespace bench
