// Contacts and their view are the same for any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "contact/meshes.hpp"
#include "deck/contacts.hpp"

namespace deck::test {
namespace {

/// Two sheets of n by n nodes that cross here and there. Lower one: shells of two thicknesses, some
/// with one of their own, triangles, and the same as plain segments; bars between upper nodes.
SmallDeck crossing_sheets(int n) {
  SmallDeck d;
  std::vector<int> upper;
  std::vector<std::vector<int>> plain;
  d.shell_part(1, 0.5).shell_part(2, 0.7).shell_part(3, 0.2).truss_part(4, 0.01);
  int e = 1;
  const auto low = [](int j, int i) {
    return std::array{1.0 * i, 1.0 * j, 0.002 * ((5 * i + j) % 7)};
  };
  add_grid(d, 1, n - 1, n - 1, low, [&](int j, int i, const Corners4& c) {
    const int part = i < n / 2 ? 1 : 2;
    if (j % 9 == 8)
      add_two_triangles(d, part, e, c);
    else
      d.shell(part, e, c[0], c[1], c[2], c[3], j % 5 == 4 ? 0.31 : 0);
    plain.push_back({c.begin(), c.end()});
    e += 2;
  });
  const auto high = [&](int j, int i) {
    upper.push_back(n * n + 1 + static_cast<int>(upper.size()));
    return std::array{i + 0.3, j + 0.4, 0.01 * ((7 * i + 3 * j) % 31) - 0.02};
  };
  add_grid(d, n * n + 1, n - 1, n - 1, high, [&](int j, int, const Corners4& c) {
    d.shell(3, e, c[0], c[1], c[2], c[3]);
    if (j % 11 == 3) d.bar("TRUSS", 4, e + 1, c[0], c[3]);
    e += 2;
  });
  d.group("/SURF/PART/1", {1, -2}).group("/GRNOD/NODE/2", upper);
  return d.segments("/SURF/SEG/3", plain);
}

auto values(const MainSegment& m) {
  return std::tuple(m.nodes, m.carrier, m.element, m.stiffness, m.gap);
}
auto values(const SecondaryNode& s) { return std::tuple(s.node, s.gap); }
auto values(const PenetrationRow& p) {
  return std::tuple(p.secondary, p.main, p.depth, p.gap, p.action, p.gap0, p.moved_by);
}
auto values(const ElementName& e) { return std::tuple(e.kind, e.index, e.id, e.part); }
auto values(const NamedPenetration& p) {
  return std::tuple(p.contact, p.row, p.secondary, p.main, values(p.secondary_element),
                    values(p.main_element), p.at);
}
auto values(const ItemCounts& c) { return std::tuple(c.pairs, c.nodes, c.edges); }
auto values(const PartPair& p) {
  return std::tuple(p.secondary, p.main, values(p.count), p.max_depth, p.mean_depth, p.p95_depth,
                    p.worst);
}
auto values(const Crossing& c) {
  return std::tuple(c.contact, c.edge, c.edge_kind, c.edge_element, c.main);
}

template <class Items>
void expect_same(const Items& a, const Items& b, const char* what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i)
    ASSERT_TRUE(values(a[i]) == values(b[i])) << what << " " << i;
}

void expect_same_contacts(const Scene& one, const Scene& many) {
  ASSERT_EQ(one.contacts.size(), many.contacts.size());
  for (std::size_t k = 0; k < one.contacts.size(); ++k) {
    const Contact &a = one.contacts[k], &b = many.contacts[k];
    expect_same(a.main, b.main, "main");
    expect_same(a.secondary, b.secondary, "secondary");
    expect_same(a.penetrations, b.penetrations, "penetrations");
    EXPECT_EQ(std::tie(a.gapmin, a.max_gap, a.shortest_side, a.candidates, a.removed_pairs),
              std::tie(b.gapmin, b.max_gap, b.shortest_side, b.candidates, b.removed_pairs));
    EXPECT_EQ(std::tie(a.type, a.evaluated, a.degenerate, a.no_carrier, a.crowded),
              std::tie(b.type, b.evaluated, b.degenerate, b.no_carrier, b.crowded));
    EXPECT_EQ(std::tie(a.inside_solids, a.main_length, a.secondary_length, a.nodal_stiffness),
              std::tie(b.inside_solids, b.main_length, b.secondary_length, b.nodal_stiffness));
  }
}

TEST(Threads, ASceneAndItsViewAreTheSameForAnyNumber) {
  const SmallDeck d = crossing_sheets(72)
                          .add("@/INTER/TYPE7/1 Igap=1 Istf=4 Gapmin=0.1")
                          .add("@/INTER/TYPE7/2 surf_IDm=3 Igap=3 Inacti=6")
                          .add("@/INTER/TYPE7/3 surf_IDm=3 Inacti=3 Gapmin=0.05")
                          .add("@/INTER/TYPE19/4 surf_IDs=3 surf_IDm=3 Gapmin=0.05");
  SceneOptions options;
  options.nodal_stiffness = true;
  Built one(d, options);
  const std::vector<Crossing> crossings = find_crossings(one.scene, 1);
  const SceneView view = make_view(one.scene, &crossings);
  EXPECT_GT(view.penetrations.size(), 8192u);
  EXPECT_FALSE(crossings.empty());
  for (const int threads : {2, 3, 7}) {
    options.threads = threads;
    const Built many(d, options);
    expect_same_contacts(one.scene, many.scene);
    EXPECT_EQ(one.scene.coordinates.z, many.scene.coordinates.z) << "nodes that were moved";
    EXPECT_GT(one.contact().main.size(), 4096u);  // fewer are not worth a thread
    const std::vector<Crossing> crossed = find_crossings(many.scene, threads);
    expect_same(crossings, crossed, "crossings");
    const SceneView other = make_view(many.scene, &crossed, threads);
    expect_same(view.penetrations, other.penetrations, "named");
    EXPECT_EQ(view.deepest_per_node, other.deepest_per_node);
    expect_same(view.part_pairs, other.part_pairs, "part pairs");
    EXPECT_EQ(values(view.total.count), values(other.total.count));
  }
}

/// What a scene says of its contacts, in order, beside their lists.
std::vector<std::string> said(const Built& built) {
  std::vector<std::string> out;
  for (const Finding& d : built.findings.all()) out.push_back(d.message);
  const DecisionReport& r = built.scene.decisions;
  out.push_back(std::to_string(r.pairs) + " " + std::to_string(r.contact_differs));
  for (const DecisionDifference& d : r.differences)
    out.push_back(std::to_string(d.contact) + " " + std::to_string(d.secondary));
  return out;
}

TEST(Threads, ManyContactsAreFinishedInTheirOrderForAnyNumber) {
  SmallDeck d = crossing_sheets(20);
  for (int k = 1; k <= 9; ++k)
    d.add(fmt::format("@/INTER/TYPE7/{} surf_IDm={} Igap={} Inacti={} Gapmin={}", k, k % 2 * 2 + 1,
                      k % 3, k == 6 ? 3 : k % 3, 0.05 * k));
  d.add("@/INTER/TYPE7/10 surf_IDm=77 Gapmin=0.1");  // an empty side is told
  d.add("@/INTER/TYPE19/11 surf_IDs=3 surf_IDm=1 Iedge=2 Gapmin=0.1");
  SceneOptions options;
  std::vector<std::size_t> steps;
  options.progress = [&](std::size_t done, std::size_t total) {
    EXPECT_LE(done, total);
    steps.push_back(done);
  };
  const Built one(d, options);
  ASSERT_EQ(one.scene.contacts.size(), 13u);
  EXPECT_EQ(steps.size(), 13u);
  for (const int threads : {2, 3, 8}) {
    options.threads = threads;
    steps.clear();
    const Built many(d, options);
    expect_same_contacts(one.scene, many.scene);
    EXPECT_EQ(said(one), said(many));
    EXPECT_TRUE(std::is_sorted(steps.begin(), steps.end()));
    EXPECT_EQ(steps.back(), 13u);
  }
}

TEST(Threads, ANodeWithoutAPlaceIsTheSameOneForAnyNumber) {
  SmallDeck d = crossing_sheets(72);
  for (const int threads : {1, 3}) {
    SceneOptions options;
    options.threads = threads;
    const std::string text = SmallDeck(d).add("@/INTER/TYPE7/1 Gapmin=0.1").text();
    const auto deck = read_deck_text("small_0000.rad", text, SchemaSet::built_in());
    ASSERT_TRUE(deck.ok());
    Findings found;
    Model model = build_model(*deck, SchemaSet::built_in(), found);
    const Interfaces interfaces = read_interfaces(*deck, model, found);
    for (const NodeIndex lost : {100u, 3000u, 72u * 72u - 1}) model.nodes.x[lost] = NAN;
    const Scene scene = build_scene(model, interfaces, found, options);
    EXPECT_FALSE(scene.contacts.at(0).evaluated);
    ASSERT_EQ(found.all().size(), 1u);
    EXPECT_NE(found.all()[0].message.find("node 5184 has a coordinate"), std::string::npos)
        << found.all()[0].message;
  }
}

}  // namespace
}  // namespace deck::test
