// What any contact force must satisfy: balance of momentum and moment, invariance of frame, unit
// and order, energy, and closed-form answers of small mechanical problems.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "cycle/support.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {
namespace {

using namespace testing;

constexpr Model models[] = {Model::reference, Model::robust};

ContactCard rubbing_card(int iform = 1) {
  ContactCard card;
  card.fric = 0.3;
  card.iform = iform;
  return card;
}

struct PairForce {
  Vec f;
  std::array<double, 4> h;
};

std::vector<PairForce> forces(const ContactCard& card, const std::vector<Pair>& pairs, Model model,
                              double dt = 1e-5) {
  const Packet packet(pairs);
  PacketResult r;
  evaluate(make_plan(card, model), packet.view(dt, dt), r);
  std::vector<PairForce> out(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    out[i] = {{r.force[0][i], r.force[1][i], r.force[2][i]},
              {r.weights[0][i], r.weights[1][i], r.weights[2][i], r.weights[3][i]}};
  }
  return out;
}

TEST(Momentum, FrictionLeavesTheMomentOfItsDistance) {
  // The split cannot carry a tangential force over a distance: exactly arm x Ft is left.
  const std::vector<Pair> pairs = testing::random_pairs(500, 4);
  const Packet packet(pairs);
  PacketResult r;
  evaluate(make_plan(rubbing_card(), Model::robust), packet.view(1e-5, 1e-5), r);
  std::size_t sliding = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Vec f{r.force[0][i], r.force[1][i], r.force[2][i]};
    const Vec n{r.normal[0][i], r.normal[1][i], r.normal[2][i]};
    const Vec ft = f - r.normal_force[i] * n;
    Vec moment = cross(-1.0 * pairs[i].x[0], f);
    for (std::size_t k = 0; k < 4; ++k)
      moment = moment + cross(pairs[i].x[k + 1], r.weights[k][i] * f);
    const Vec expected = -r.distance[i] * cross(n, ft);
    EXPECT_LE(norm(moment - expected), 2e-13 * 10.0 * norm(f) + 1e-300) << i;
    sliding += norm(expected) > 1e-3 * norm(f) ? 1 : 0;
  }
  EXPECT_GT(sliding, 100u);
}

Vec turn(const std::array<Vec, 3>& q, const Vec& a) {
  return {dot(q[0], a), dot(q[1], a), dot(q[2], a)};
}

TEST(Invariance, ForcesTurnWithTheScene) {
  const double a = 0.7, b = 1.3;
  const std::array<Vec, 3> ra{Vec{std::cos(a), -std::sin(a), 0}, Vec{std::sin(a), std::cos(a), 0},
                              Vec{0, 0, 1}};
  const std::array<Vec, 3> rb{Vec{1, 0, 0}, Vec{0, std::cos(b), -std::sin(b)},
                              Vec{0, std::sin(b), std::cos(b)}};
  const auto q = [&](const Vec& v) { return turn(rb, turn(ra, v)); };
  const std::vector<Pair> pairs = testing::random_pairs(1000, 5);
  std::vector<Pair> moved = pairs;
  for (Pair& p : moved) {
    for (auto& x : p.x) x = q(x) + Vec{3, -2, 1};
    for (auto& v : p.v) v = q(v) + Vec{7, 8, 9};
    p.ft = q(p.ft);
  }
  for (const Model model : models) {
    for (const int iform : {1, 2}) {
      const auto before = forces(rubbing_card(iform), pairs, model);
      const auto after = forces(rubbing_card(iform), moved, model);
      double size = 0.0, off = 0.0;
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        // Near the mid-surface the reference's force amplifies rounding by gap / distance.
        size = std::max(size, norm(before[i].f));
        const double f = norm(before[i].f);
        if (f > 0.0 && f < 1e6) off = std::max(off, norm(after[i].f - q(before[i].f)) / 1e6);
      }
      EXPECT_GT(size, 1e4);
      EXPECT_LE(off, 1e-13);
    }
  }
}

TEST(Invariance, RenamingTheAxesChangesNoBitOfTheRobustWeights) {
  const auto cycle = [](const Vec& v) { return Vec{v[1], v[2], v[0]}; };
  std::vector<Pair> pairs;
  for (int k = 0; k < 50; ++k) {  // dyadic coordinates: dot products are exact in any order
    pairs.push_back(quad_pair({0.25 * k, 3.5, 0.5}));
  }
  std::vector<Pair> moved = pairs;
  for (Pair& p : moved)
    for (auto& x : p.x) x = cycle(x);
  const auto before = forces(elastic_card(), pairs, Model::robust);
  const auto after = forces(elastic_card(), moved, Model::robust);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    EXPECT_EQ(std::pair(after[i].f, after[i].h), std::pair(cycle(before[i].f), before[i].h));
}

TEST(Invariance, PowersOfTwoInLengthScaleTheRobustForceExactly) {
  const std::vector<Pair> pairs = testing::random_pairs(500, 6);
  const auto before = forces(elastic_card(), pairs, Model::robust);
  for (const int k : {-60, -10, 7, 40}) {
    std::vector<Pair> scaled = pairs;
    for (Pair& p : scaled) {
      for (auto& x : p.x) x = std::ldexp(1.0, k) * x;
      p.gap = std::ldexp(p.gap, k);
    }
    const auto after = forces(elastic_card(), scaled, Model::robust);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      EXPECT_EQ(after[i].f, std::ldexp(1.0, k) * before[i].f) << k;
      EXPECT_EQ(after[i].h, before[i].h) << k;
    }
  }
}

TEST(Invariance, UnitSystemsGiveTheSamePhysicalForce) {
  // kg m s, t mm s, g mm ms: factors of length, mass and time.
  const struct { double l, m, t; } units[] = {{1e3, 1e-3, 1.0}, {1e3, 1e3, 1e3}};
  const std::vector<Pair> pairs = testing::random_pairs(500, 8);
  for (const Model model : models) {
    const auto si = forces(rubbing_card(), pairs, model, 1e-5);
    for (const auto& u : units) {
      std::vector<Pair> scaled = pairs;
      for (Pair& p : scaled) {
        for (auto& x : p.x) x = u.l * x;
        for (auto& v : p.v) v = (u.l / u.t) * v;
        for (auto& m : p.m) m *= u.m;
        p.gap *= u.l;
        p.k0 *= u.m / (u.t * u.t);
      }
      const auto other = forces(rubbing_card(), scaled, model, 1e-5 * u.t);
      const double force = u.m * u.l / (u.t * u.t);
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const double f = norm(si[i].f);
        if (f > 1e6) continue;  // near the mid-surface rounding of the coordinates shows
        EXPECT_LE(norm((1.0 / force) * other[i].f - si[i].f), 1e-13 * 1e6) << i;
      }
    }
  }
}

/// A strip of quads with nodes over it: shared nodes on both sides.
struct Scene {
  PairList pairs;
  std::array<std::vector<double>, 3> x, v;
  std::vector<double> mass, temperature, k0, gap;
  [[nodiscard]] NodalState nodes() const {
    return {{x[0].data(), x[1].data(), x[2].data()},
            {v[0].data(), v[1].data(), v[2].data()},
            mass.data(),
            temperature.data()};
  }
};

/// `points` by `points` nodes that move at a height of 0.05 over 9 by 9 uneven quads.
Scene shaken_grid(std::size_t points, unsigned seed) {
  constexpr std::size_t cells = 9;
  Scene s;
  std::mt19937_64 rng(seed);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const auto add = [&](double a, double b, double c) {
    const double at[] = {a, b, c};
    for (std::size_t k = 0; k < 3; ++k) {
      s.x[k].push_back(at[k] + 0.01 * u(rng));
      s.v[k].push_back(10.0 * u(rng));
    }
    s.mass.push_back(1e-3), s.temperature.push_back(300.0);
    return static_cast<std::uint32_t>(s.mass.size() - 1);
  };
  const double h = 1.0 / cells, d = 1.0 / static_cast<double>(points);
  for (std::size_t j = 0; j <= cells; ++j)
    for (std::size_t i = 0; i <= cells; ++i)
      add(h * static_cast<double>(i), h * static_cast<double>(j), 0);
  for (std::size_t j = 0; j < points; ++j)
    for (std::size_t i = 0; i < points; ++i) {
      const double a = d * (static_cast<double>(i) + 0.5), b = d * (static_cast<double>(j) + 0.5);
      // A pair with the segment below the node.
      const auto corner = static_cast<std::uint32_t>(static_cast<std::size_t>(b / h) * (cells + 1) +
                                                     static_cast<std::size_t>(a / h));
      constexpr std::uint32_t row = cells + 1;
      const std::uint32_t role[] = {add(a, b, 0.05), corner, corner + 1, corner + row + 1,
                                    corner + row};
      for (std::size_t r = 0; r < 5; ++r) s.pairs.node[r].push_back(role[r]);
      s.k0.push_back(2e5 * d * d);
      s.gap.push_back(0.1);
    }
  return s;
}

NodalSums evaluate_scene(const Scene& s, const ContactCard& card, Model model, unsigned threads) {
  const KernelPlan plan = make_plan(card, model);
  PacketBuffer buffer;
  buffer.gather(s.nodes(), s.pairs, plan.needs);
  PacketView view = buffer.view();
  view.k0 = s.k0.data();
  view.gap = s.gap.data();
  view.dt1 = view.dt12 = 1e-5;
  PacketResult r;
  evaluate(plan, view, r, threads);
  NodalSums sums;
  sums.resize(s.mass.size());
  assemble(plan, s.pairs, r, sums);
  return sums;
}

TEST(Assembly, IsTheSameForAnyNumberOfThreadsAndConservesMomentum) {
  const Scene s = shaken_grid(40, 3);
  for (const Model model : models) {
    const NodalSums one = evaluate_scene(s, rubbing_card(), model, 1);
    double total_abs = 0.0;
    Vec total{};
    for (std::size_t n = 0; n < s.mass.size(); ++n) {
      const Vec f{one.force[0][n], one.force[1][n], one.force[2][n]};
      total = total + f;
      total_abs += norm(f);
    }
    EXPECT_GT(total_abs, 100.0);
    EXPECT_LE(norm(total), 1e-14 * std::sqrt(1600.0) * total_abs);
    for (const unsigned threads : {2u, 3u, 8u}) {
      const NodalSums many = evaluate_scene(s, rubbing_card(), model, threads);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(one.force[c], many.force[c]) << threads;
      EXPECT_EQ(one.stiffness, many.stiffness);
      EXPECT_EQ(one.contact, many.contact);
    }
  }
}

TEST(Assembly, PiecesInPairOrderGiveTheBitsOfTheWhole) {
  const Scene s = shaken_grid(80, 5);  // 6400 pairs: more than one block of totals
  const KernelPlan plan = make_plan(rubbing_card(), Model::reference);
  const auto run = [&](const PairList& pairs, std::size_t begin, PacketResult& r,
                       RunningTotals& totals) {
    PacketBuffer buffer;
    buffer.gather(s.nodes(), pairs, plan.needs | Field::position);
    PacketView view = buffer.view();
    view.k0 = s.k0.data() + begin;
    view.gap = s.gap.data() + begin;
    view.dt1 = view.dt12 = 1e-5;
    evaluate(plan, view, r);
    totals.add(view, r);
  };
  PacketResult whole;
  RunningTotals of_whole(plan);
  run(s.pairs, 0, whole, of_whole);
  NodalSums expected;
  expected.resize(s.mass.size());
  assemble(plan, s.pairs, whole, expected);

  RunningTotals of_pieces(plan);
  NodalSums sums;
  sums.resize(s.mass.size(), false);
  const std::size_t bounds[] = {0, 3, 1000, 4096, 4099, 6400};
  for (std::size_t k = 0; k + 1 < std::size(bounds); ++k) {
    PairList piece;
    for (std::size_t r = 0; r < 5; ++r)
      piece.node[r].assign(s.pairs.node[r].begin() + static_cast<std::ptrdiff_t>(bounds[k]),
                           s.pairs.node[r].begin() + static_cast<std::ptrdiff_t>(bounds[k + 1]));
    PacketResult r;
    run(piece, bounds[k], r, of_pieces);
    assemble(plan, piece, r, sums);
  }
  EXPECT_EQ(sums.force, expected.force);
  EXPECT_EQ(sums.stiffness, expected.stiffness);
  EXPECT_EQ(sums.contact, expected.contact);
  const Totals a = of_whole.all(), b = of_pieces.all();
  EXPECT_EQ(std::tie(a.moment, a.tangential, a.total_abs, a.elastic_energy, a.dt_kinematic_pair),
            std::tie(b.moment, b.tangential, b.total_abs, b.elastic_energy, b.dt_kinematic_pair));
  EXPECT_GT(a.total_abs, 100.0);
}

TEST(Assembly, OrderOfPairsChangesNoPairForce) {
  std::vector<Pair> pairs = testing::random_pairs(300, 9);
  const auto before = forces(rubbing_card(), pairs, Model::reference);
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(4));
  std::vector<Pair> shuffled;
  for (const std::size_t i : order) shuffled.push_back(pairs[i]);
  const auto after = forces(rubbing_card(), shuffled, Model::reference);
  for (std::size_t i = 0; i < pairs.size(); ++i) EXPECT_EQ(after[i].f, before[order[i]].f);
}

TEST(Incline, BlockSlidesUpAtTheNafemsLimit) {
  // Weight G on a slope of tangent 0.1, pushed horizontally by F; friction 0.3 (Iform 2, stuck
  // first, then dragged to its limit). Sliding when F cos a - G sin a reaches the friction force.
  const double tangent = 0.1, weight = 1000.0;
  const double ca = 1.0 / std::sqrt(1.0 + tangent * tangent), sa = tangent * ca;
  ContactCard card = elastic_card();
  card.fric = 0.3;
  card.iform = 2;
  const Vec up{ca, 0, sa}, n{-sa, 0, ca}, side{0, 1, 0};
  const auto friction = [&](double normal_force) {
    double low = 0.0, high = 1.0;  // depth that carries the normal force
    Outcome r;
    for (int k = 0; k < 200; ++k) {
      const double depth = 0.5 * (low + high);
      Pair p;
      p.x = {0.3 * up + (1.0 - depth) * n, -5.0 * up - 5.0 * side, 5.0 * up - 5.0 * side,
             5.0 * up + 5.0 * side, -5.0 * up + 5.0 * side};
      p.k0 = 1e4;
      p.v[0] = up;
      r = run(card, p, 10.0, 10.0, Model::robust);
      (-r.all.normal_force[0] < normal_force ? low : high) = depth;
    }
    return dot(r.memory(), up);
  };
  double low = 0.0, high = weight;
  for (int k = 0; k < 100; ++k) {
    const double push = 0.5 * (low + high);
    const bool slides = push * ca - weight * sa > friction(weight * ca + push * sa);
    (slides ? high : low) = push;
  }
  EXPECT_NEAR(low / weight, 0.412371, 5e-7);
}

TEST(StickSlip, LoopAreaIsTheDissipatedWork) {
  ContactCard card = elastic_card();
  card.fric = 0.2;
  card.iform = 2;
  for (const Model model : models) {
    Pair p = triangle_pair({2, 3, 0.75});
    const double normal_force = -run(card, p, 1, 1, model).all.normal_force[0];
    const double cap = 0.2 * normal_force;
    // Steps of a quarter of the path to slip, so that none straddles it.
    const double step = 0.25 * cap / p.k0;
    double area = 0.0, heat = 0.0, force = 0.0, peak = 0.0;
    const auto drag = [&](int steps, double direction) {
      for (int k = 0; k < steps; ++k) {
        p.v[0] = {direction * step, 0, 0};
        const Outcome r = run(card, p, 1.0, 1.0, model);
        area += 0.5 * (force + r.memory()[0]) * direction * step;
        force = r.memory()[0];
        heat += r.all.friction_heat[0];
        peak = std::max(peak, std::abs(force));
        p.ft = r.memory();
      }
    };
    drag(4, 1.0);  // to the limit
    area = heat = 0.0;
    drag(6, 1.0);
    drag(14, -1.0);
    drag(8, 1.0);  // back to where the loop began: at the limit, moving forward
    EXPECT_NEAR(peak, cap, 1e-12 * cap);
    EXPECT_GT(area, 0.0);
    EXPECT_NEAR(heat, area, 1e-12 * area);
  }
}

/// Drops a mass on the surface and lets it rebound; returns rebound speed and worst energy drift.
std::pair<double, double> bounce(const ContactCard& card, double dt, Model model) {
  Pair p = triangle_pair({2, 3, 1.0});
  const double m = p.m[0] = 2e-3, v0 = 40.0;
  double z = 1.0 + 1e-12, v = -v0, drift = 0.0;
  const double e0 = 0.5 * m * v0 * v0;
  for (int step = 0; step < 1000000; ++step) {
    p.x[0][2] = z;
    p.v[0] = {0, 0, v};
    const Outcome r = run(card, p, dt, dt, model);
    const double half = v - r.force()[2] / m * (0.5 * dt);  // force on the node is -F
    if (step > 0) {
      const double e = 0.5 * m * half * half + r.all.elastic_energy[0];
      drift = std::max(drift, std::abs(e - e0) / e0);
    }
    v = v - r.force()[2] / m * dt;
    z += v * dt;
    if (z > 1.0 && v > 0.0) break;
  }
  return {v, drift};
}

TEST(Bounce, EnergyDriftIsOfSecondOrderInTheStep) {
  for (const Model model : models) {
    const auto [v1, d1] = bounce(elastic_card(), 2e-6, model);
    const auto [v2, d2] = bounce(elastic_card(), 1e-6, model);
    EXPECT_LT(d1, 1e-3);
    EXPECT_NEAR(std::log2(d1 / d2), 2.0, 0.25);
    EXPECT_NEAR(v1, 40.0, 0.1);
    EXPECT_NEAR(v2, 40.0, 0.03);
  }
}

TEST(Energy, PotentialIsTheIntegralOfTheForce) {
  // Five-point Gauss rule over short intervals of depth.
  const double node[] = {0.0, 0.5384693101056831, 0.9061798459386640};
  const double weight[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const auto at = [](double depth) {
    return run(elastic_card(), triangle_pair({2, 3, 1.0 - depth}), 0, 0, Model::robust);
  };
  for (const double from : {0.0, 1e-4, 0.1, 0.5, 0.9}) {
    const double to = from + 0.02 * (1.0 - from);
    const double mid = 0.5 * (from + to), half = 0.5 * (to - from);
    double work = 0.0;
    for (int k = -2; k <= 2; ++k) {
      const double x = mid + (k < 0 ? -half : half) * node[std::abs(k)];
      work += half * weight[std::abs(k)] * -at(x).all.normal_force[0];
    }
    const double stored = at(to).all.elastic_energy[0] - at(from).all.elastic_energy[0];
    EXPECT_NEAR(stored, work, 1e-12 * at(to).all.elastic_energy[0]) << from;
  }
}

ContactCard heat_card() {
  ContactCard card = elastic_card();
  card.ithe = 1;
  card.ithe_form = 1;
  card.kthe = 500.0;
  return card;
}

TEST(HeatExchange, TwoBodiesRelaxExponentially) {
  const double cs = 2.0, cm = 3.0, area = 0.01, rate = 500.0 * area * (1.0 / cs + 1.0 / cm);
  const auto difference = [&](double dt) {
    Pair p = quad_pair({4, 6, 0.7});
    p.area = area;
    p.temperature = {500, 300, 300, 300, 300};
    double ts = 500.0, tm = 300.0;
    for (double t = 0.0; t < 1.0 - 0.5 * dt; t += dt) {
      p.temperature = {ts, tm, tm, tm, tm};
      const Outcome r = run(heat_card(), p, dt, dt);
      double sum = 0.0, into_main = 0.0;
      for (std::size_t k = 0; k < 5; ++k) sum += r.all.heat[k][0];
      for (std::size_t k = 1; k < 5; ++k) into_main += r.all.heat[k][0];
      EXPECT_LE(std::abs(sum), 4e-16 * std::abs(into_main));
      ts += r.all.heat[0][0] / cs;
      tm += into_main / cm;
    }
    EXPECT_NEAR(cs * ts + cm * tm, cs * 500 + cm * 300, 1e-9);
    return ts - tm;
  };
  const double exact = 200.0 * std::exp(-rate);
  const double e1 = std::abs(difference(1.0 / 256) - exact);
  const double e2 = std::abs(difference(1.0 / 512) - exact);
  EXPECT_LT(e2, 0.02 * exact);
  EXPECT_NEAR(e1 / e2, 2.0, 0.05);  // explicit Euler: first order
}

TEST(HeatExchange, FrictionHeatIsTheDissipatedWorkTimesTheShares) {
  for (const int iform : {1, 2}) {
    ContactCard card = rubbing_card(iform);
    card.ithe = 1;
    card.ithe_form = 1;
    card.fheats = 0.35;
    card.fheatm = 0.45;
    std::vector<Pair> pairs = testing::random_pairs(200, 12);
    for (Pair& p : pairs) p.temperature.fill(300.0);  // no conduction
    const Packet packet(pairs);
    const KernelPlan plan = make_plan(card);
    PacketResult r;
    evaluate(plan, packet.view(1e-4, 1e-4), r);
    double dissipated = 0.0, heat = 0.0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      dissipated += r.friction_heat[i];
      for (std::size_t k = 0; k < 5; ++k) heat += r.heat[k][i];
    }
    EXPECT_GT(dissipated, 1.0);
    EXPECT_NEAR(heat, 0.8 * dissipated, 1e-12 * dissipated);
    EXPECT_NEAR(totals(plan, packet.view(1e-4, 1e-4), r).friction_heat, heat, 1e-12 * heat);
  }
}

}  // namespace
}  // namespace deck::cycle
