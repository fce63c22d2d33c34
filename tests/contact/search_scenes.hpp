// Scenes for the search tests: meshes that break searches, and the brute-force answer.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "contact/shared/closest.hpp"
#include "deck/contacts.hpp"

namespace deck::scenes {

struct Mesh {
  std::vector<double> x, y, z;
  std::vector<std::array<std::uint32_t, 4>> segments;
  std::vector<std::uint32_t> secondary;
  std::vector<std::array<std::uint32_t, 2>> edges;

  std::uint32_t add(double px, double py, double pz) {
    x.push_back(px);
    y.push_back(py);
    z.push_back(pz);
    return static_cast<std::uint32_t>(x.size() - 1);
  }
  NodeArrays nodes() const { return {x, y, z}; }
  void all_nodes_secondary() {
    secondary.clear();
    for (std::uint32_t i = 0; i < x.size(); ++i) secondary.push_back(i);
  }
  void edges_of_segments() {
    edges.clear();
    for (const auto& s : segments) {
      edges.push_back({s[0], s[1]});
      edges.push_back({s[1], s[2]});
    }
  }
};

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }

 private:
  std::mt19937_64 engine_;
};

// A sheet of n x n cells, quads or triangles, with coordinates given by place(i, j).
template <class Place>
void add_sheet(Mesh& mesh, int n, bool triangles, const Place& place) {
  const auto first = static_cast<std::uint32_t>(mesh.x.size());
  const auto node = [first, n](int i, int j) {
    return first + static_cast<std::uint32_t>(i * (n + 1) + j);
  };
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const auto p = place(i, j);
      mesh.add(p[0], p[1], p[2]);
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const std::uint32_t a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1),
                          d = node(i, j + 1);
      if (triangles) {
        mesh.segments.push_back({a, b, c, c});
        mesh.segments.push_back({a, c, d, d});
      } else {
        mesh.segments.push_back({a, b, c, d});
      }
    }
  }
}

inline double at(std::span<const double> v, std::size_t k, double otherwise) {
  return v.empty() ? otherwise : v[k];
}
inline Point3<double> point(const NodeArrays& nodes, std::uint32_t k) {
  return {nodes.x[k], nodes.y[k], nodes.z[k]};
}
constexpr double no_limit = std::numeric_limits<double>::infinity();

inline bool within(const NodeSegmentInput& in, const SearchOptions& o, std::size_t i,
                   std::size_t j) {
  const std::uint32_t node = in.secondary[i];
  const auto& s = in.segments[j];
  if (at(in.secondary_stiffness, i, 1) == 0.0 || at(in.segment_stiffness, j, 1) == 0.0)
    return false;
  if (node == s[0] || node == s[1] || node == s[2] || node == s[3]) return false;
  std::array<Point3<double>, 4> x;
  for (std::size_t k = 0; k < 4; ++k) x[k] = point(in.nodes, s[k]);
  const double gap =
      o.gap(at(in.secondary_gap, i, 0), at(in.segment_gap, j, 0),
            at(in.secondary_length, i, no_limit), at(in.segment_length, j, no_limit));
  const double limit = std::max(o.drad, gap) + o.margin;
  const Point3<double> p = point(in.nodes, node);
  const bool triangle = s[2] == s[3];
  return (o.form == Form::reference
              ? closest_on_segment<Form::reference>(p, x, triangle).distance()
              : closest_on_segment<Form::robust>(p, x, triangle).distance()) < limit;
}

inline bool within(const EdgeEdgeInput& in, const SearchOptions& o, std::size_t i, std::size_t j) {
  const auto &s = in.secondary[i], &m = in.main[j];
  if (at(in.secondary_stiffness, i, 1) == 0.0 || at(in.main_stiffness, j, 1) == 0.0) return false;
  if (s[0] == m[0] || s[0] == m[1] || s[1] == m[0] || s[1] == m[1]) return false;
  const double gap = o.gap(at(in.secondary_gap, i, 0), at(in.main_gap, j, 0),
                           at(in.secondary_length, i, no_limit), at(in.main_length, j, no_limit));
  const double limit = std::max(o.drad, gap) + o.margin;
  const auto s1 = point(in.nodes, s[0]), s2 = point(in.nodes, s[1]);
  const auto m1 = point(in.nodes, m[0]), m2 = point(in.nodes, m[1]);
  if (o.form == Form::robust)
    return closest_between_edges<Form::robust>(s1, s2, m1, m2).distance < limit;
  const double d2 = closest_between_edges<Form::reference>(s1, s2, m1, m2).distance_squared;
  return limit > 0.0 && d2 < limit * limit;
}

// Every pair, one by one.
template <class Input>
std::vector<CandidatePair> brute_force(const Input& in, const SearchOptions& options,
                                       std::size_t secondaries, std::size_t mains) {
  std::vector<CandidatePair> pairs;
  for (std::size_t i = 0; i < secondaries; ++i)
    for (std::size_t j = 0; j < mains; ++j)
      if (within(in, options, i, j))
        pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
  return pairs;
}
inline std::vector<CandidatePair> brute_force(const NodeSegmentInput& in, const SearchOptions& o) {
  return brute_force(in, o, in.secondary.size(), in.segments.size());
}
inline std::vector<CandidatePair> brute_force(const EdgeEdgeInput& in, const SearchOptions& o) {
  return brute_force(in, o, in.secondary.size(), in.main.size());
}

inline constexpr int families = 12;

// One scene of a family; `gap` receives a gap that finds some pairs. Self contact throughout:
// every node is a secondary node. Over 80 lines: one case a family.
inline Mesh make(int family, Dice& dice, double& gap) {
  Mesh mesh;
  const int n = 3 + dice.below(7);
  const bool triangles = dice.below(2) == 0;
  const auto jitter = [&dice](double a) { return dice.uniform(-a, a); };
  gap = dice.uniform(0.05, 1.5);
  switch (family) {
    case 0:  // wavy sheet over another
      for (const double level : {0.0, 0.5}) {
        add_sheet(mesh, n, triangles, [&](int i, int j) {
          return std::array{i + jitter(0.2), j + jitter(0.2),
                            level + 0.3 * std::sin(i + 0.7 * j) + jitter(0.05)};
        });
      }
      break;
    case 1: {  // graded: edges from 1e-6 to 1
      const double ratio = std::pow(1e6, 1.0 / n);
      add_sheet(mesh, n, triangles, [&](int i, int j) {
        return std::array{1e-6 * std::pow(ratio, i), 1e-6 * std::pow(ratio, j), jitter(1e-6)};
      });
      gap = std::pow(10.0, dice.uniform(-6.5, 0));
      break;
    }
    case 2:  // one node a million away
      add_sheet(mesh, n, triangles, [&](int i, int j) {
        const double far = i == 0 && j == 0 ? 1e6 : 0.0;
        return std::array{i + far, j - far, jitter(0.3)};
      });
      break;
    case 3:  // everything in one plane
      add_sheet(mesh, n, triangles, [&](int i, int j) {
        return std::array{i + jitter(0.3), j + jitter(0.3), 7.0};
      });
      break;
    case 4:  // everything on one line
      add_sheet(mesh, n, triangles, [&](int i, int j) {
        return std::array{1.0 * i + j, 2.0, 3.0};
      });
      break;
    case 5:  // everything at one point
      add_sheet(mesh, n, triangles, [&](int, int) { return std::array{0.1, 0.2, 0.3}; });
      break;
    case 6:  // folded shell: three layers on top of each other
      add_sheet(mesh, 2 * n, triangles, [&](int i, int j) {
        const int third = 2 * n / 3 + 1;
        const int layer = i / third, along = i % third;
        return std::array{layer % 2 == 0 ? 1.0 * along : 1.0 * third - along, 1.0 * j,
                          0.4 * layer + jitter(0.01)};
      });
      break;
    case 7:  // triangle soup of all sizes
      for (int k = 0; k < 10 * n; ++k) {
        const double size = std::pow(10.0, dice.uniform(-5, 0.5));
        const double cx = jitter(3), cy = jitter(3), cz = jitter(3);
        std::array<std::uint32_t, 4> s{};
        for (auto& corner : s)
          corner = mesh.add(cx + jitter(size), cy + jitter(size), cz + jitter(size));
        if (triangles) s[3] = s[2];
        mesh.segments.push_back(s);
      }
      break;
    case 8:  // two clusters a million apart, far from the origin
      for (const double at : {1e7, 1.1e7}) {
        add_sheet(mesh, n, triangles, [&](int i, int j) {
          return std::array{at + 0.5 * i, -at + 0.5 * j, jitter(0.2)};
        });
      }
      break;
    case 9:  // one giant segment under many small ones
      add_sheet(mesh, n, triangles, [&](int i, int j) {
        return std::array{0.01 * i, 0.01 * j, 0.5 + jitter(0.3)};
      });
      add_sheet(mesh, 1, triangles, [&](int i, int j) {
        return std::array{1e3 * i - 500, 1e3 * j - 500, jitter(0.1)};
      });
      break;
    case 10:  // needles and zero-area segments
      add_sheet(mesh, n, triangles, [&](int i, int j) {
        return std::array{1.0 * i, 1e-7 * j * (dice.below(2)), jitter(1e-8)};
      });
      gap = std::pow(10.0, dice.uniform(-8, 0.3));
      break;
    default:  // nodes exactly on a lattice: distances tie with the gap
      add_sheet(mesh, n, triangles, [&](int i, int j) {
        return std::array{1.0 * i, 1.0 * j, 0.0};
      });
      add_sheet(mesh, n, triangles, [&](int i, int j) {
        return std::array{1.0 * i, 1.0 * j, 1.0};
      });
      gap = 1.0 + dice.below(2);
      break;
  }
  mesh.all_nodes_secondary();
  mesh.edges_of_segments();
  return mesh;
}

inline std::vector<double> random_gaps(Dice& dice, std::size_t count, double scale) {
  std::vector<double> gaps(count);
  for (double& g : gaps) g = scale * std::pow(10.0, dice.uniform(-2, 0.2));
  return gaps;
}

inline std::vector<double> random_stiffness(Dice& dice, std::size_t count) {
  std::vector<double> k(count);
  for (double& v : k) v = dice.below(6) == 0 ? 0.0 : 1.0;
  return k;
}

}  // namespace deck::scenes
