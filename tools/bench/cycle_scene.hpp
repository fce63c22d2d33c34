// Scene of the kernel benchmark: a sheet of pairs.
#pragma once
#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "deck/cycle.hpp"

namespace deck::cycle::sheet {

/// A sheet of quads with a node near each, one candidate pair per node.
struct Scene {
  PairList pairs;
  std::array<std::vector<double>, 3> x, v;
  std::vector<double> mass, temperature, k0, gap, p0, area;
  std::array<std::vector<double>, 3> ft;
  std::vector<double> one, zero, up, fric, width;
  PacketBuffer buffer;
  [[nodiscard]] NodalState nodes() const {
    return {{x[0].data(), x[1].data(), x[2].data()},
            {v[0].data(), v[1].data(), v[2].data()},
            mass.data(),
            temperature.data()};
  }
  [[nodiscard]] PacketView view() const {
    PacketView w = buffer.view();
    w.k0 = k0.data();
    w.gap = gap.data();
    w.p0 = p0.data();
    w.area = area.data();
    for (std::size_t c = 0; c < 3; ++c) w.ft_old[c] = ft[c].data();
    w.conductivity = one.data();
    w.fric = fric.data();
    w.visf2 = one.data();
    w.ortho_mu = {fric.data(), width.data()};
    w.ortho_direction = {one.data(), zero.data()};
    for (auto& n : w.normal) n = {zero.data(), zero.data(), up.data()};
    w.tie.fill(zero.data());
    w.edge_width = {width.data(), width.data()};
    w.edge_conductivity.fill(one.data());
    w.dt1 = w.dt12 = 1e-6;
    return w;
  }
};

inline Scene make_scene(std::size_t cells, bool edges) {
  Scene s;
  s.pairs.kind = edges ? ContactKind::edge_edge : ContactKind::node_segment;
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const auto add = [&](double a, double b, double c) {
    const double at[] = {a + 0.1 * u(rng), b + 0.1 * u(rng), c};
    for (std::size_t k = 0; k < 3; ++k) {
      s.x[k].push_back(at[k]);
      s.v[k].push_back(10.0 * u(rng));
    }
    s.mass.push_back(1e-3 * (1.5 + u(rng)));
    s.temperature.push_back(300.0 + 50.0 * u(rng));
    return static_cast<std::uint32_t>(s.mass.size() - 1);
  };
  const auto row = static_cast<std::uint32_t>(cells + 1);
  for (std::uint32_t j = 0; j < row; ++j) {
    for (std::uint32_t i = 0; i < row; ++i) add(i, j, 0.05 * u(rng));
  }
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t c = j * row + i;
      const double height = 0.2 + 0.1 * u(rng);
      if (edges) {
        const std::uint32_t a = add(i, j + 0.5, height), b = add(i + 1.0, j + 0.5, height);
        const std::uint32_t role[] = {a, b, c, c + row};
        for (std::size_t r = 0; r < 4; ++r) s.pairs.node[r].push_back(role[r]);
      } else {
        const std::uint32_t n = add(i + 0.5 + 0.4 * u(rng), j + 0.5 + 0.4 * u(rng), height);
        const std::uint32_t role[] = {n, c, c + 1, c + row + 1, c + row};
        for (std::size_t r = 0; r < 5; ++r) s.pairs.node[r].push_back(role[r]);
      }
      s.k0.push_back(1e5 * (1.5 + u(rng)));
      s.gap.push_back(0.5);
      s.p0.push_back(0.05 * (1.0 + u(rng)));
      s.area.push_back(1.0);
      for (auto& f : s.ft) f.push_back(5.0 * u(rng));
    }
  }
  const std::size_t n = s.k0.size();
  s.one.assign(n, 1.0);
  s.up.assign(n, 1.0);
  s.zero.assign(n, 0.0);
  s.fric.assign(n, 0.2);
  s.width.assign(n, 0.1);
  s.buffer.gather(s.nodes(), s.pairs,
                  Field::position | Field::velocity | Field::mass_secondary | Field::mass_main |
                      Field::temperature);
  return s;
}

}  // namespace deck::cycle::sheet
