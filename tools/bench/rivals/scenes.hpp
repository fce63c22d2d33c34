// Scenes of the search benchmark, of any size: uniform sheet, mesh graded 1:1000, sheet with a node
// a million edges away, folded shell in self contact.
#pragma once

#include <algorithm>
#include <random>

#include "rivals/pair_test.hpp"

namespace bench {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  std::mt19937_64& engine() { return engine_; }

 private:
  std::mt19937_64 engine_;
};

constexpr double side_gap = 0.3;  // gap per side, in edge lengths

// Wavy sheet of n x n quads with edge h from corner (x0, y0), and a secondary node per quad at a
// distance of 0.05 to 0.5 edges.
inline void add_patch(Scene& s, Dice& dice, int n, double h, double x0, double y0) {
  const auto first = static_cast<std::uint32_t>(s.x.size());
  const auto add = [&](double u, double v, double above) {
    s.x.push_back(x0 + h * u);
    s.y.push_back(y0 + h * v);
    s.z.push_back(h * (3 * std::sin(0.11 * u) * std::cos(0.07 * v) + above));
    return static_cast<std::uint32_t>(s.x.size() - 1);
  };
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      add(i + dice.uniform(-0.15, 0.15), j + dice.uniform(-0.15, 0.15), 0.0);
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const auto a = first + static_cast<std::uint32_t>(i * (n + 1) + j);
      const auto b = a + static_cast<std::uint32_t>(n + 1);
      s.segments.push_back({a, b, b + 1, a + 1});
      s.segment_gap.push_back(side_gap * h);
      const double side = dice.uniform(0, 1) < 0.5 ? -1 : 1;
      s.secondary.push_back(
          add(i + dice.uniform(0, 1), j + dice.uniform(0, 1), side * dice.uniform(0.05, 0.5)));
      s.secondary_gap.push_back(side_gap * h);
    }
  }
}

inline Scene uniform_scene(std::size_t size) {
  Scene s;
  Dice dice(1);
  add_patch(s, dice, static_cast<int>(std::lround(std::sqrt(size))), 1.0, 0.0, 0.0);
  return s;
}

// Ten adjacent sheets, edges from 1 to 1/1000, with equal numbers of segments.
inline Scene graded_scene(std::size_t size) {
  Scene s;
  Dice dice(2);
  const int n = static_cast<int>(std::lround(std::sqrt(size / 10.0)));
  double x0 = 0.0;
  for (int k = 0; k < 10; ++k) {
    const double h = std::pow(1000.0, -k / 9.0);
    add_patch(s, dice, n, h, x0, 0.0);
    x0 += (n + 2) * h;
  }
  return s;
}

inline Scene outlier_scene(std::size_t size) {
  Scene s = uniform_scene(size);
  s.x[s.segments[0][0]] = -1e6;
  s.z[s.segments[0][0]] = 1e6;
  const std::uint32_t last = s.secondary.back();
  s.x[last] = s.y[last] = s.z[last] = 1e6;
  return s;
}

// Eleven layers at half an edge; all nodes are secondary.
inline Scene folded_scene(std::size_t size) {
  Scene s;
  Dice dice(3);
  const int width = static_cast<int>(std::lround(std::sqrt(size / 11.0)));
  const int n = 11 * width;
  for (int i = 0; i <= n; ++i) {
    const int layer = i / width, along = i % width;
    for (int j = 0; j <= width; ++j) {
      s.x.push_back((layer % 2 == 0 ? along : width - along) + dice.uniform(-0.1, 0.1));
      s.y.push_back(j + dice.uniform(-0.1, 0.1));
      s.z.push_back(0.5 * layer + dice.uniform(-0.02, 0.02));
      s.secondary.push_back(static_cast<std::uint32_t>(s.x.size() - 1));
      s.secondary_gap.push_back(side_gap);
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < width; ++j) {
      const auto a = static_cast<std::uint32_t>(i * (width + 1) + j);
      const auto b = a + static_cast<std::uint32_t>(width + 1);
      s.segments.push_back({a, b, b + 1, a + 1});
      s.segment_gap.push_back(side_gap);
    }
  }
  return s;
}

// Random order of secondary nodes, as in groups by part or box.
inline void shuffle_secondary(Scene& s) {
  Dice dice(4);
  std::vector<std::uint32_t> order(s.secondary.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), dice.engine());
  Scene copy = s;
  for (std::size_t i = 0; i < order.size(); ++i) {
    s.secondary[i] = copy.secondary[order[i]];
    s.secondary_gap[i] = copy.secondary_gap[order[i]];
  }
}

}  // namespace bench
