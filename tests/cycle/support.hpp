// Small helpers of the cycle tests: packets written out by hand.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <random>
#include <vector>

#include "deck/cycle.hpp"

namespace deck::cycle::testing {

using Vec = std::array<double, 3>;
inline Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec operator*(double s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Vec& a) { return std::sqrt(dot(a, a)); }

/// One pair written out; roles as in PacketView.
struct Pair {
  std::array<Vec, 5> x{};
  std::array<Vec, 5> v{};
  std::array<double, 5> m{1.0, 1.0, 1.0, 1.0, 1.0};
  bool triangle = false;
  double k0 = 0.0;
  double gap = 1.0;
  double p0 = 0.0;
  Vec ft{};
  std::array<double, 8> tie{};
  std::array<double, 5> temperature{};
  double area = 0.0;
  double conductivity = 0.0;
  std::array<double, 2> edge_width{};
  std::array<double, 4> edge_conductivity{};
  double fric = 0.0;
  std::array<Vec, 4> normal{};
  std::array<double, 2> ortho_mu{0.3, 0.1};
  std::array<double, 2> ortho_direction{1.0, 0.0};
};

/// A packet that owns its arrays. Not to be copied: its view leads into them.
class Packet {
 public:
  explicit Packet(const std::vector<Pair>& pairs) {
    // An array of a member of all pairs.
    const auto array = [&](const double*& to, const auto& member) {
      auto& values = reals_.emplace_back();
      for (const Pair& p : pairs) values.push_back(member(p));
      to = values.data();
    };
    view_.size = pairs.size();
    for (std::size_t r = 0; r < 5; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        array(view_.position[r][c], [=](const Pair& p) { return p.x[r][c]; });
        array(view_.velocity[r][c], [=](const Pair& p) { return p.v[r][c]; });
      }
      array(view_.mass[r], [=](const Pair& p) { return p.m[r]; });
      array(view_.temperature[r], [=](const Pair& p) { return p.temperature[r]; });
    }
    for (std::size_t c = 0; c < 3; ++c) {
      array(view_.ft_old[c], [=](const Pair& p) { return p.ft[c]; });
      for (std::size_t k = 0; k < 4; ++k)
        array(view_.normal[k][c], [=](const Pair& p) { return p.normal[k][c]; });
    }
    for (std::size_t k = 0; k < 4; ++k)
      array(view_.edge_conductivity[k], [=](const Pair& p) { return p.edge_conductivity[k]; });
    for (std::size_t k = 0; k < 2; ++k) {
      array(view_.edge_width[k], [=](const Pair& p) { return p.edge_width[k]; });
      array(view_.ortho_mu[k], [=](const Pair& p) { return p.ortho_mu[k]; });
      array(view_.ortho_direction[k], [=](const Pair& p) { return p.ortho_direction[k]; });
    }
    for (std::size_t k = 0; k < 8; ++k)
      array(view_.tie[k], [=](const Pair& p) { return p.tie[k]; });
    for (const Pair& p : pairs) triangle_.push_back(p.triangle);
    view_.triangle = triangle_.data();
    array(view_.k0, [](const Pair& p) { return p.k0; });
    array(view_.gap, [](const Pair& p) { return p.gap; });
    array(view_.p0, [](const Pair& p) { return p.p0; });
    array(view_.area, [](const Pair& p) { return p.area; });
    array(view_.conductivity, [](const Pair& p) { return p.conductivity; });
    array(view_.fric, [](const Pair& p) { return p.fric; });
  }
  Packet(const Packet&) = delete;
  Packet& operator=(const Packet&) = delete;
  [[nodiscard]] PacketView view(double dt1 = 0.0, double dt12 = 0.0) const {
    PacketView w = view_;
    w.dt1 = dt1;
    w.dt12 = dt12;
    return w;
  }

 private:
  std::deque<std::vector<double>> reals_;
  std::vector<std::uint8_t> triangle_;
  PacketView view_;
};

/// Result of one pair.
struct Outcome {
  PacketResult all;
  [[nodiscard]] Vec force() const { return {all.force[0][0], all.force[1][0], all.force[2][0]}; }
  [[nodiscard]] Vec normal() const {
    return {all.normal[0][0], all.normal[1][0], all.normal[2][0]};
  }
  [[nodiscard]] std::array<double, 4> weights() const {
    return {all.weights[0][0], all.weights[1][0], all.weights[2][0], all.weights[3][0]};
  }
  [[nodiscard]] Vec memory() const { return {all.ft[0][0], all.ft[1][0], all.ft[2][0]}; }
};

inline Outcome run(const ContactCard& card, const Pair& pair, double dt1 = 0.0, double dt12 = 0.0,
                   Model model = Model::reference) {
  const Packet packet({pair});
  Outcome out;
  evaluate(make_plan(card, model), packet.view(dt1, dt12), out.all);
  return out;
}

/// A card of elastic contact alone.
inline ContactCard elastic_card() {
  ContactCard card;
  card.viss = 0.0;
  return card;
}

inline Pair quad_pair(const Vec& node) {
  Pair p;
  p.x = {node, Vec{0, 0, 0}, Vec{10, 0, 0}, Vec{10, 10, 0}, Vec{0, 10, 0}};
  p.k0 = 1e5;
  return p;
}

inline Pair triangle_pair(const Vec& node) {
  Pair p;
  p.x = {node, Vec{0, 0, 0}, Vec{10, 0, 0}, Vec{0, 10, 0}, Vec{0, 10, 0}};
  p.triangle = true;
  p.k0 = 1e5;
  return p;
}

/// Random pairs in contact: quads and triangles of every shape, some out of reach.
inline std::vector<Pair> random_pairs(std::size_t n, unsigned seed, bool edges = false) {
  std::mt19937_64 rng(seed);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const auto vec = [&](double s) { return Vec{s * u(rng), s * u(rng), s * u(rng)}; };
  std::vector<Pair> pairs(n);
  for (Pair& p : pairs) {
    if (edges) {
      p.x = {Vec{-5, 0.5 * u(rng), 0.4 * u(rng)}, Vec{5, 0.5 * u(rng), 0.4 * u(rng)},
             Vec{u(rng), -5, 0.4 * u(rng)}, Vec{u(rng), 5, 0.4 * u(rng)}, Vec{}};
    } else {
      p.x = {Vec{6 * u(rng), 6 * u(rng), 1.1 * u(rng)}, Vec{-5, -5, 0} + vec(1),
             Vec{5, -5, 0} + vec(1), Vec{5, 5, 0} + vec(1), Vec{-5, 5, 0} + vec(1)};
      p.triangle = u(rng) > 0.6;
      if (p.triangle) p.x[4] = p.x[3];
    }
    for (std::size_t r = 0; r < 5; ++r) {
      p.v[r] = vec(50.0);
      p.m[r] = 1e-3 * (1.5 + u(rng));
      p.temperature[r] = 400.0 + 100.0 * u(rng);
      if (r > 0) p.normal[r - 1] = Vec{0, 0, 1} + vec(0.2);
    }
    p.k0 = 1e5 * (1.5 + u(rng));
    p.gap = 1.2 + 0.5 * u(rng);
    p.p0 = 0.2 * (1.0 + u(rng));
    p.ft = vec(500.0);
    p.area = 1.0 + 0.5 * u(rng);
    p.conductivity = 40.0;
    p.edge_width = {0.8, 1.1};
    p.edge_conductivity = {40.0, 45.0, 35.0, 30.0};
    p.fric = 0.3 + 0.2 * u(rng);
  }
  return pairs;
}

/// Ten printed digits agree; components of a vector relative to its size where they are small.
inline void expect_digits(double computed, double expected, const char* what = "") {
  EXPECT_NEAR(computed, expected, 6e-10 * std::abs(expected) + 1e-13) << what;
}
template <std::size_t N>
void expect_digits(const std::array<double, N>& computed, const std::array<double, N>& expected) {
  double size = 0.0;
  for (const double e : expected) size = std::max(size, std::abs(e));
  for (std::size_t k = 0; k < N; ++k) {
    EXPECT_NEAR(computed[k], expected[k], 6e-10 * std::max(std::abs(expected[k]), 1e-2 * size))
        << "component " << k;
  }
}

}  // namespace deck::cycle::testing
