// Step, mass and stiffness of one truss, beam or spring against the formulas of its kind.
#include "model/mesh_elements.hpp"

#include <algorithm>

namespace deck::test {
namespace {

TEST(Truss, HasItsLengthOverTheSpeedOfALine) {
  PartRow row = part(1, 2);
  row.property.area = 5;
  ElementOutcome o;
  detail::truss_outcome(row, 7, o);
  expect_near(o.mass, 3 * 5 * 7);
  expect_near(o.dt, 7 / std::sqrt(210.0 / 2));
  expect_near(o.stiffness, 210.0 * 5 / 7);
  EXPECT_EQ(o.share, (std::array<double, 8>{0.5, 0.5}));
  row.rigid = true;
  ElementOutcome still;
  detail::truss_outcome(row, 7, still);
  EXPECT_EQ(still.dt, no_step);
  EXPECT_EQ(still.stiffness, 0);
  expect_near(still.mass, 3 * 5 * 7);
}

TEST(Beam, HasTheStepOfItsSection) {
  struct Row {
    double length, iyy, izz, ixx, dm, df;
  };
  // Slender and short ones, with either inertia and either damping the larger one.
  for (const Row& r : {Row{40, 6, 2, 3, 0, 0.01}, Row{2, 6, 20, 3, 0.3, 0.01},
                       Row{3, 9, 8, 40, 0.02, 0.2}, Row{1.5, 1, 30, 90, 0.1, 0.05}}) {
    PartRow row = part(1, 3);
    row.property.area = 5;
    row.property.iyy = r.iyy;
    row.property.izz = r.izz;
    row.property.ixx = r.ixx;
    row.property.beam_membrane = r.dm;
    row.property.beam_bending = r.df;
    ElementOutcome o;
    detail::beam_outcome(row, r.length, o);
    const double large = std::max(r.iyy, r.izz), small = std::min(r.iyy, r.izz), l = r.length;
    const double a = 5 * l * l / (12 * large), s = 1.2 * 210 / 80, f = std::max(1.0, l / (a + s));
    const double d = damp(std::sqrt(2.0) * std::max(r.dm, r.df));
    expect_near(o.dt, d * l / (9 * std::sqrt(f)));
    expect_near(o.mass, 3 * 5 * l);
    const double phi = small / large * s / a, k_phi = (4 + phi) / (1 + phi), m = 3 * 5 * l / 2;
    double j = 1.2 * m * std::pow(1.2 * l, 2) / 12 + 3 * l / 2 * large;
    if (a < 1) j *= std::max(1.0, k_phi / (1 + a));
    j = std::max(j, 3 * l / 2 * r.ixx);
    expect_near(o.inertia, 2 * j);  // of both ends
    expect_near(o.stiffness, f * 5 * 210 / (l * d * d));
    expect_near(o.rotational, std::max(80 * r.ixx, k_phi * 210 * large) / (l * d * d));
    EXPECT_EQ(o.share, (std::array<double, 8>{0.5, 0.5}));
  }
}

TEST(Beam, OfType18HasNoFactorOfItsSection) {
  PartRow row = part(1, 18);
  row.property.area = 5;
  row.property.iyy = row.property.izz = 20;
  row.property.beam_bending = 0.1;
  ElementOutcome o;
  detail::beam_outcome(row, 2, o);
  const double d = damp(std::sqrt(2.0) * 0.1);
  expect_near(o.dt, d * 2 / 9);
  expect_near(o.stiffness, 5.0 * 210 / (2 * d * d));
  EXPECT_TRUE(std::isnan(o.inertia));
  EXPECT_TRUE(std::isnan(o.rotational));
  row.rigid = true;
  ElementOutcome still;
  detail::beam_outcome(row, 2, still);
  EXPECT_EQ(still.dt, no_step);
  expect_near(still.mass, 30);
  EXPECT_EQ(still.stiffness, 0);
}

/// A spring of a type with mass 5 and inertia 7, and freedoms (k, c).
PartRow spring(int type, const std::vector<std::pair<double, double>>& freedoms,
               bool per_length = false) {
  PartRow row = part(1, type);
  row.property.spring_mass = 5;
  row.property.spring_inertia = 7;
  row.property.per_length = per_length;
  for (std::size_t i = 0; i < freedoms.size(); ++i) {
    row.property.freedom[i].k = freedoms[i].first;
    row.property.freedom[i].c = freedoms[i].second;
  }
  return row;
}
double general_step(double m, double k, double c) { return m / (std::sqrt(c * c + k * m) + c); }
double nodal(double m, double k, double c) { return std::pow(std::sqrt(c * c + k * m) + c, 2) / m; }

TEST(Spring, OfOneDirectionHasTheStepOfStiffnessAndDamping) {
  for (const int type : {4, 12})
    for (const bool per_length : {false, true})
      for (const auto& [k, c] : {std::pair(11., 2.), {11., 0.}, {0., 2.}, {0., 0.}, {11., 30.}}) {
        ElementOutcome o;
        detail::spring_outcome(spring(type, {{k, c}}, per_length), 3, true, o);
        const double l = per_length ? 3 : 1, m = 5 * l, stiff = k / l,
                     damping = type == 4 ? c : c / l;
        double dt = 1e20;
        if (k > 0 && c > 0) {
          const double root = std::sqrt(damping * damping + stiff * m);
          dt = m / ((type == 12 ? 2 : 1) * root + damping);
        } else if (k > 0) {
          dt = std::sqrt(m / stiff);
        } else if (c > 0) {
          dt = m / damping;
        }
        expect_near(o.dt, std::min(dt, 0.5 * m / std::max(1e-15, damping)));
        expect_near(o.mass, m);
        expect_near(o.middle_stiffness, nodal(m, stiff, damping));
        expect_near(o.stiffness, nodal(type == 12 ? m / 2 : m, stiff, damping));
        EXPECT_EQ(o.share, type == 12 ? (std::array<double, 8>{0.25, 0.5, 0.25})
                                      : (std::array<double, 8>{0.5, 0.5}));
        EXPECT_EQ(o.why, nullptr);
      }
}

TEST(Spring, OfSeveralDirectionsHasTheSmallerStepOfMovingAndTurning) {
  using Freedoms = std::vector<std::pair<double, double>>;
  const Freedoms plain{{2, 1}, {11, .5}, {4, 3}, {20, 2}, {13, 6}, {31, 5}};
  for (const int type : {8, 13, 25})
    for (const bool per_length : {false, true})
      for (std::size_t turn = 0; turn < 3; ++turn) {
        Freedoms f = plain;  // each direction can be the stiffest one
        std::rotate(f.begin(), f.begin() + static_cast<long>(turn), f.begin() + 3);
        std::rotate(f.begin() + 3, f.begin() + 3 + static_cast<long>(turn), f.end());
        if (type == 25) f.resize(4);
        ElementOutcome o;
        detail::spring_outcome(spring(type, f, per_length), 3, false, o);
        const double l = per_length ? 3 : 1, m = 5 * l, j = 7 * l;
        double k = std::max(f[0].first, f[1].first), c = std::max(f[0].second, f[1].second);
        double kr = 0, cr = 0;
        if (type == 25) {
          kr = f[1].first * 9 + std::max(f[2].first, f[3].first);
          cr = f[1].second * 9 + std::max(f[2].second, f[3].second);
        } else {
          k = std::max(k, f[2].first);
          c = std::max(c, f[2].second);
          kr = std::max({f[3].first, f[4].first, f[5].first});
          cr = std::max({f[3].second, f[4].second, f[5].second});
          if (type == 13) {
            kr += std::max(f[1].first, f[2].first) * 9;
            cr += std::max(f[1].second, f[2].second) * 9;
          }
        }
        k /= l;
        c /= l;
        kr /= l;
        cr /= l;
        expect_near(o.dt, std::min(general_step(m, k, c), general_step(j, kr, cr)));
        expect_near(o.mass, m);
        expect_near(o.inertia, j);
        expect_near(o.stiffness, nodal(m, k, c));
        expect_near(o.rotational, nodal(type == 13 ? j : j / 2, kr, cr));
      }
}

}  // namespace
}  // namespace deck::test
