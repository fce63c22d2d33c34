// What the sides of a contact say about pairs.
#include "contact/shared/sides.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/search_scenes.hpp"
#include "deck/contact/closest.hpp"

namespace deck {
namespace {

using scenes::Dice;
using scenes::Mesh;

// The segments and edges of a mesh against its own nodes and edges.
Contact contact_of(const Mesh& mesh, ContactKind kind) {
  Contact c;
  c.kind = kind;
  for (const auto& nodes : mesh.segments) {
    c.main.emplace_back().nodes = nodes;
    c.main.back().stiffness = 1;
  }
  for (const NodeIndex n : mesh.secondary) c.secondary.emplace_back().node = n;
  for (const auto& nodes : mesh.edges) {
    c.main_edges.emplace_back().nodes = nodes;
    c.main_edges.back().stiffness = 1;
  }
  c.secondary_edges = c.main_edges;
  return c;
}

double distance_of(const Mesh& mesh, ContactKind kind, const CandidatePair& pair) {
  const auto at = [&](NodeIndex n) { return Point3<double>{mesh.x[n], mesh.y[n], mesh.z[n]}; };
  if (kind == ContactKind::edge_edge) {
    const auto &s = mesh.edges[pair.secondary], &m = mesh.edges[pair.main];
    return closest_between_edges<Form::reference>(at(s[0]), at(s[1]), at(m[0]), at(m[1])).distance;
  }
  const auto& m = mesh.segments[pair.main];
  return closest_on_segment<Form::reference>(at(mesh.secondary[pair.secondary]),
                                             {at(m[0]), at(m[1]), at(m[2]), at(m[3])}, m[2] == m[3])
      .distance();
}

class SidesOfFamily : public testing::TestWithParam<int> {};

TEST_P(SidesOfFamily, LeastDistanceIsNotAboveTheReferencesAndNearlyIt) {
  for (int k = 0; k < 10; ++k) {
    Dice dice(static_cast<std::uint64_t>(1000 * GetParam() + k));
    double gap = 0;
    const Mesh mesh = scenes::make(GetParam(), dice, gap);
    double largest = 0;
    for (const auto* axis : {&mesh.x, &mesh.y, &mesh.z})
      for (const double v : *axis) largest = std::max(largest, std::abs(v));
    for (const ContactKind kind : {ContactKind::node_segment, ContactKind::edge_edge}) {
      const Contact c = contact_of(mesh, kind);
      const detail::SearchSides sides(c, detail::SearchSides::Off::included, 1 + k % 2);
      SearchOptions options;
      options.gap = PairGap::constant(2 * gap);
      const Coordinates x{mesh.x, mesh.y, mesh.z};
      const auto pairs = sides.find(x, options).pairs;
      const auto least = sides.least_distances(x, pairs);
      ASSERT_EQ(least.size(), pairs.size());
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const double d = distance_of(mesh, kind, pairs[i]);
        EXPECT_LE(least[i], d);
        EXPECT_GE(least[i], d - 0x1p-32 * (largest + d));  // the slack of the lanes, and once more
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SidesOfFamily, testing::Range(0, scenes::families));

}  // namespace
}  // namespace deck
