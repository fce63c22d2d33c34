// Crossed elements against CGAL's self-intersections (Polygon_mesh_processing, GPL: only here): two
// wavy sheets of triangles through each other; pairs of triangles that cut are compared before a
// time is shown.
//
//   bench_crossings [triangles of each sheet]
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <cstdlib>
#include <set>

#include "deck/contacts.hpp"
#include "harness.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Triangle = std::array<std::uint32_t, 4>;  // last node repeated
using Pairs = std::set<std::pair<std::size_t, std::size_t>>;

struct Sheets {
  std::vector<double> x, y, z;
  std::vector<Triangle> triangles;  // of the first, then of the second sheet
  std::size_t first = 0;
};

void add_sheet(Sheets& s, std::uint32_t n, double slope, double phase) {
  const auto base = static_cast<std::uint32_t>(s.x.size());
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) {
      const double u = i + phase, v = j + 0.7 * phase;
      s.x.push_back(u), s.y.push_back(v),
          s.z.push_back(slope * (u - 0.5 * n) + std::sin(0.31 * u + v + phase));
    }
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = base + i * (n + 1) + j, b = a + n + 1;
      s.triangles.push_back({a, b, b + 1, b + 1});
      s.triangles.push_back({a, b + 1, a + 1, a + 1});
    }
}

Pairs cgal_pairs(const Sheets& s) {
  Mesh mesh;
  for (std::size_t i = 0; i < s.x.size(); ++i) mesh.add_vertex({s.x[i], s.y[i], s.z[i]});
  for (const Triangle& t : s.triangles)
    mesh.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]), Mesh::Vertex_index(t[2]));
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> found;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(found));
  Pairs out;
  for (const auto& [one, other] : found) {
    const std::size_t a = one.idx(), b = other.idx();
    if ((a < s.first) != (b < s.first)) out.emplace(std::min(a, b), std::max(a, b));
  }
  return out;
}

Pairs deck_pairs(const Sheets& s) {
  Pairs out;
  for (const bool swapped : {false, true}) {
    const auto middle = s.triangles.begin() + static_cast<std::ptrdiff_t>(s.first);
    const std::span<const Triangle> front(s.triangles.begin(), middle),
        back(middle, s.triangles.end());
    const auto through = swapped ? back : front, main = swapped ? front : back;
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (const Triangle& t : through)
      for (std::size_t k = 0; k < 3; ++k) edges.push_back({t[k], t[(k + 1) % 3]});
    for (const deck::CandidatePair& p :
         deck::find_crossing_pairs({s.x, s.y, s.z}, edges, main, 1)) {
      const std::size_t face = p.secondary / 3;
      out.emplace(swapped ? p.main : face, (swapped ? face : p.main) + s.first);
    }
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  const double wanted = argc > 1 ? std::atof(argv[1]) : 100000;
  Sheets s;
  const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(wanted / 2)));
  add_sheet(s, n, 0.02, 0.0);
  s.first = s.triangles.size();
  add_sheet(s, n, -0.03, 0.37);
  Pairs ours, theirs;
  const auto times =
      bench::run_in_turns({[&] { ours = deck_pairs(s); }, [&] { theirs = cgal_pairs(s); }}, 3);
  const double deck = bench::best(times[0]).wall, cgal = bench::best(times[1]).wall;
  if (ours != theirs) {
    fmt::print("answers differ: {} pairs and {}\n", ours.size(), theirs.size());
    return 1;
  }
  fmt::print(
      "{} triangles, {} pairs cut: deck {:.1f} ms, CGAL self_intersections {:.1f} ms ({:.1f} "
      "times)\n",
      s.triangles.size(), ours.size(), 1e3 * deck, 1e3 * cgal, cgal / deck);
  return 0;
}
