// Edges through segments: exact decisions against brute force with rational numbers.
#include "deck/contacts.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "contact/small_deck.hpp"

namespace deck::test {
namespace {

using Edge = std::array<std::uint32_t, 2>;
using Quad = std::array<std::uint32_t, 4>;
using Exact = std::array<mpq_class, 3>;

struct Mesh {
  std::vector<double> x, y, z;
  std::vector<Edge> edges;
  std::vector<Quad> segments;
  std::uint32_t node(double px, double py, double pz) {
    x.push_back(px);
    y.push_back(py);
    z.push_back(pz);
    return static_cast<std::uint32_t>(x.size() - 1);
  }
  std::vector<CandidatePair> found(int threads = 1) const {
    return find_crossing_pairs({x, y, z}, edges, segments, threads);
  }
};

Exact minus(const Exact& a, const Exact& b) {
  return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}
Exact times(const Exact& a, const Exact& b) {
  return {mpq_class(a[1] * b[2] - a[2] * b[1]), mpq_class(a[2] * b[0] - a[0] * b[2]),
          mpq_class(a[0] * b[1] - a[1] * b[0])};
}
mpq_class inner(const Exact& a, const Exact& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The point where pq meets the plane of abc, then its barycentric coordinates: not the same way
/// as the library's five orientations.
bool exactly_through(const Exact& p, const Exact& q, const Exact& a, const Exact& b,
                     const Exact& c) {
  const Exact n = times(minus(b, a), minus(c, a));
  const mpq_class hp = inner(n, minus(p, a)), hq = inner(n, minus(q, a));
  if (sgn(hp) * sgn(hq) >= 0) return false;
  const mpq_class t = hp / (hp - hq);
  Exact m;
  for (std::size_t k = 0; k < 3; ++k) m[k] = p[k] + t * (q[k] - p[k]);
  const mpq_class u = inner(n, times(minus(b, a), minus(m, a)));
  const mpq_class v = inner(n, times(minus(c, b), minus(m, b)));
  const mpq_class w = inner(n, times(minus(a, c), minus(m, c)));
  return sgn(u) >= 0 && sgn(v) >= 0 && sgn(w) >= 0;
}

std::vector<CandidatePair> brute_force(const Mesh& mesh) {
  const auto at = [&](std::uint32_t i) { return Exact{mesh.x[i], mesh.y[i], mesh.z[i]}; };
  std::vector<CandidatePair> out;
  for (std::uint32_t e = 0; e < mesh.edges.size(); ++e) {
    for (std::uint32_t m = 0; m < mesh.segments.size(); ++m) {
      const Quad& s = mesh.segments[m];
      const Edge& d = mesh.edges[e];
      if (std::any_of(s.begin(), s.end(), [&](auto n) { return n == d[0] || n == d[1]; })) continue;
      const Exact p = at(d[0]), q = at(d[1]), a = at(s[0]), c = at(s[2]);
      if (exactly_through(p, q, a, at(s[1]), c) ||
          (s[2] != s[3] && exactly_through(p, q, a, c, at(s[3]))))
        out.push_back({e, m});
    }
  }
  return out;
}

/// Random nodes from `coordinate`, edges and segments among them.
template <class Coordinate>
Mesh random_mesh(std::mt19937_64& random, int nodes, int edges, int segments,
                 const Coordinate& coordinate) {
  Mesh mesh;
  for (int i = 0; i < nodes; ++i) mesh.node(coordinate(), coordinate(), coordinate());
  const auto pick = [&] { return static_cast<std::uint32_t>(random() % mesh.x.size()); };
  for (int i = 0; i < edges; ++i) mesh.edges.push_back({pick(), pick()});
  for (int i = 0; i < segments; ++i) {
    Quad s{pick(), pick(), pick(), pick()};
    if (i % 3 == 0) s[3] = s[2];
    mesh.segments.push_back(s);
  }
  return mesh;
}

void expect_exact(const Mesh& mesh, const char* what) {
  const auto expected = brute_force(mesh);
  EXPECT_EQ(mesh.found(1), expected) << what;
  EXPECT_EQ(mesh.found(2), expected) << what;
}

TEST(CrossingPairs, AgreeWithRationalsOnRandomScenes) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> real(-1, 1);
  std::size_t crossings = 0;
  for (int i = 0; i < 40; ++i) {
    const Mesh mesh = random_mesh(random, 60, 40, 40, [&] { return real(random); });
    crossings += brute_force(mesh).size();
    expect_exact(mesh, "random");
  }
  EXPECT_GT(crossings, 100u);
}

TEST(CrossingPairs, AgreeWithRationalsOnGridsFullOfTouches) {
  std::mt19937_64 random(2);
  std::size_t crossings = 0;
  for (int i = 0; i < 60; ++i) {
    const Mesh mesh = random_mesh(random, 40, 40, 40, [&] { return double(random() % 4); });
    crossings += brute_force(mesh).size();
    expect_exact(mesh, "grid");
  }
  EXPECT_GT(crossings, 100u);
}

TEST(CrossingPairs, AgreeWithRationalsFarFromTheOriginAndAcrossScales) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> real(-1, 1);
  const double ulp = std::ldexp(1.0, -22);
  for (int i = 0; i < 20; ++i) {
    expect_exact(
        random_mesh(random, 40, 40, 40, [&] { return 1e9 + 1e3 * ulp * double(random() % 8); }),
        "huge offset");
    expect_exact(random_mesh(random, 40, 40, 40,
                             [&] { return std::ldexp(real(random), -int(random() % 40)); }),
                 "many scales");
    expect_exact(random_mesh(random, 40, 40, 40, [&] { return 0.1 + 0.1 * double(random() % 3); }),
                 "nearly on planes");
    expect_exact(
        random_mesh(random, 40, 40, 40, [&] { return std::ldexp(double(random() % 5), -500); }),
        "tiny");
  }
}

TEST(CrossingPairs, OneOutlierHidesNothing) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> real(-1, 1);
  Mesh mesh = random_mesh(random, 60, 40, 40, [&] { return real(random); });
  mesh.x[0] = 1e6;
  expect_exact(mesh, "outlier");
}

TEST(CrossingPairs, TouchingIsNotCrossing) {
  Mesh mesh;
  mesh.node(0, 0, 0), mesh.node(4, 0, 0), mesh.node(4, 4, 0), mesh.node(0, 4, 0);
  mesh.segments = {{0, 1, 2, 3}};
  const auto edge = [&](double x1, double y1, double z1, double x2, double y2, double z2) {
    const std::uint32_t a = mesh.node(x1, y1, z1), b = mesh.node(x2, y2, z2);
    mesh.edges.push_back({a, b});
  };
  edge(1, 2, 0, 1, 2, 1);                       // ends on it
  edge(-1, 1, 0, 5, 1, 0);                      // in its plane
  edge(1, 2, 1, 1, 2, 2);                       // above
  edge(5, 2, -1, 5, 2, 1);                      // beside
  edge(1, 2, -1, 1, 2, 1);                      // through
  edge(2, 2, -1, 2, 2, 1);                      // through the diagonal
  edge(4, 2, -1, 4, 2, 1);                      // through its side
  edge(4, 4, -1, 4, 4, 1);                      // through its corner
  mesh.edges.push_back({0, mesh.edges[4][0]});  // shares a node
  const std::vector<CandidatePair> expected = {{4, 0}, {5, 0}, {6, 0}, {7, 0}};
  EXPECT_EQ(mesh.found(), expected);
}

// A floor (part 1) and a wall (part 2) that stands through it.
TEST(Crossings, NameEdgeSegmentAndElements) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(11, 5, 2, -1).node(12, 5, 8, -1).node(13, 5, 8, 5).node(14, 5, 2, 5);
  d.shell_part(1, 1).shell_part(2, 1).shell(1, 1, 1, 2, 3, 4).shell(2, 2, 11, 12, 13, 14);
  d.group("/SURF/PART/1", {1});
  const Built b(d.group("/GRNOD/PART/2", {2}).add("@/INTER/TYPE7/1 Gapmin=0.1"));
  const auto found = find_crossings(b.scene);
  ASSERT_EQ(found.size(), 2u);
  const auto ids = [&](const Crossing& c) {
    return std::array{b.model.node_id(c.edge[0]), b.model.node_id(c.edge[1])};
  };
  EXPECT_EQ(ids(found[0]), (std::array<std::int64_t, 2>{11, 14}));
  EXPECT_EQ(ids(found[1]), (std::array<std::int64_t, 2>{12, 13}));
  EXPECT_EQ(found[0].edge_kind, ElementKind::shell4);
  EXPECT_EQ(b.model.shell4.id[found[0].edge_element], 2);
  EXPECT_EQ(b.model.shell4.id[b.contact().main[found[0].main].element], 1);
  EXPECT_TRUE(b.contact().penetrations.empty()) << "no node is near: only crossings show it";
}

}  // namespace
}  // namespace deck::test
