// Edges through segments: exact decisions against brute force with rational numbers; crossed
// elements of whole scenes of every kind of element against the definition, looked up edge by edge.
#include <gtest/gtest.h>

#include <gmpxx.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>

#include "contact/small_deck.hpp"
#include "deck/contacts.hpp"

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
  std::vector<CandidatePair> found(int threads) const {
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
Mesh random_mesh(std::mt19937_64& random, int nodes, int edges, int segments,
                 const std::function<double()>& coordinate) {
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

TEST(CrossingPairs, AgreeWithRationalsWhateverTheCoordinates) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> real(-1, 1);
  const auto whole = [&](unsigned below) { return static_cast<double>(random() % below); };
  struct Family {
    const char* what;
    int scenes;
    std::function<double()> coordinate;
    std::size_t least;
  };
  const Family families[] = {
      {"random", 40, [&] { return real(random); }, 100},
      {"a grid full of touches", 60, [&] { return whole(4); }, 100},
      {"some a million away", 20, [&] { return random() % 100 == 0 ? 1e6 : real(random); }, 10},
      {"far from the origin", 20, [&] { return 1e9 + 1e3 * 0x1p-22 * whole(8); }, 0},
      {"many scales", 20, [&] { return std::ldexp(real(random), -int(random() % 40)); }, 0},
      {"nearly on planes", 20, [&] { return 0.1 + 0.1 * whole(3); }, 0},
      {"tiny", 20, [&] { return std::ldexp(whole(5), -500); }, 0}};
  for (const Family& family : families) {
    std::size_t crossings = 0;
    for (int i = 0; i < family.scenes; ++i) {
      const Mesh mesh = random_mesh(random, 50, 40, 40, family.coordinate);
      const auto expected = brute_force(mesh);
      for (const int threads : {1, 2}) EXPECT_EQ(mesh.found(threads), expected) << family.what;
      crossings += expected.size();
    }
    EXPECT_GE(crossings, family.least) << family.what;
  }
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

using Edge = std::array<NodeIndex, 2>;
using Random = std::mt19937_64;

/// Elements between random nodes, as text and as the edges that each has.
class RandomElements {
 public:
  RandomElements(int nodes, int quads, int others, Random& random)
      : nodes_(nodes), random_(random) {
    std::uniform_real_distribution<double> at(0, 10);
    for (int n = 1; n <= nodes; ++n) deck_.node(n, at(random), at(random), at(random));
    deck_.shell_part(1, 1).solid_part(2).truss_part(3, 1).beam_part(4, 1).spring_part(5, 1);
    using K = ElementKind;
    for (int k = 0; k < quads; ++k) add(K::shell4, "/SHELL/1", 4, ring(0, 4));
    const Slots brick = join({ring(0, 4), ring(4, 4), {{0, 4}, {1, 5}, {2, 6}, {3, 7}}});
    for (int k = 0; k < others; ++k) {
      add(K::shell3, "/SH3N/1", 3, ring(0, 3));
      add(K::solid8, "/BRICK/2", 8, brick);
      add(K::solid8, "/PENTA6/2", 6, join({ring(0, 3), ring(3, 3), {{0, 3}, {1, 4}, {2, 5}}}));
      add(K::solid8, "/TETRA4/2", 4, join({ring(0, 3), {{0, 3}, {1, 3}, {2, 3}}}));
      add(K::truss, "/TRUSS/3", 2, {{0, 1}});
      add(K::beam, "/BEAM/4", 3, {{0, 1}});  // the third node orients it
      add(K::spring, "/SPRING/5", 2, {});    // joins what it passes through
    }
  }
  const SmallDeck& deck() const { return deck_; }
  struct Element {
    ElementKind kind;
    int id;
    std::vector<Edge> edges;  // of node ids
  };
  const std::vector<Element>& elements() const { return elements_; }

 private:
  using Slots = std::vector<std::array<int, 2>>;
  static Slots ring(int first, int count) {
    Slots out;
    for (int k = 0; k < count; ++k) out.push_back({first + k, first + (k + 1) % count});
    return out;
  }
  static Slots join(const std::vector<Slots>& lists) {
    Slots out;
    for (const Slots& l : lists) out.insert(out.end(), l.begin(), l.end());
    return out;
  }
  void add(ElementKind kind, const std::string& header, int count, const Slots& slots) {
    std::set<int> some;
    while (some.size() < static_cast<std::size_t>(count))
      some.insert(1 + static_cast<int>(random_() % static_cast<unsigned>(nodes_)));
    std::vector<int> n(some.begin(), some.end());
    std::shuffle(n.begin(), n.end(), random_);
    Element e{kind, static_cast<int>(elements_.size()) + 1, {}};
    std::string card = header + fmt::sprintf("\n%10d", e.id);
    for (const int node : n) card += fmt::sprintf("%10d", node);
    deck_.add(card);
    for (const auto& [a, b] : slots)
      e.edges.push_back({static_cast<NodeIndex>(n[static_cast<std::size_t>(a)]),
                         static_cast<NodeIndex>(n[static_cast<std::size_t>(b)])});
    elements_.push_back(e);
  }
  int nodes_;
  Random& random_;
  SmallDeck deck_;
  std::vector<Element> elements_;
};

/// Uses the nodes first, first + step, ...
Contact random_contact(int nodes, int secondary, int segments, Random& random,
                       std::size_t first = 0, std::size_t step = 1) {
  Contact c;
  const auto any = [&] {
    return static_cast<NodeIndex>(first + step * (random() % (unsigned(nodes) / step)));
  };
  std::set<NodeIndex> some;
  while (some.size() < static_cast<std::size_t>(secondary)) some.insert(any());
  for (const NodeIndex n : some) {
    SecondaryNode s;
    s.node = n;
    c.secondary.push_back(s);
  }
  for (int k = 0; k < segments; ++k) {
    MainSegment m;
    for (NodeIndex& n : m.nodes) n = any();
    if (k % 3 == 0) m.nodes[3] = m.nodes[2];
    c.main.push_back(m);
  }
  c.main.push_back(c.main[1]);  // the other solid's face: folded along the other diagonal
  std::rotate(c.main.back().nodes.begin(), c.main.back().nodes.begin() + 1,
              c.main.back().nodes.end());
  return c;
}

using Row = std::tuple<std::uint32_t, Edge, ElementKind, std::int64_t, std::uint32_t>;
std::vector<Row> rows_of(const Scene& scene, const std::vector<Crossing>& found) {
  std::vector<Row> out;
  for (const Crossing& c : found)
    out.emplace_back(c.contact, c.edge, c.edge_kind,
                     scene.model->family(c.edge_kind).id[c.edge_element], c.main);
  return out;
}

/// The definition: every edge of every element with both nodes on the secondary side, through every
/// segment without a node of it; the first element that has the edge, the first contact that has
/// edge and segment.
std::vector<Row> by_definition(const Scene& scene, const RandomElements& all) {
  const Nodes& nodes = scene.model->nodes;
  std::vector<Row> out;
  std::set<std::pair<Edge, std::array<NodeIndex, 4>>> seen;
  for (std::uint32_t c = 0; c < scene.contacts.size(); ++c) {
    const Contact& contact = scene.contacts[c];
    std::set<NodeIndex> secondary;
    for (const SecondaryNode& s : contact.secondary) secondary.insert(s.node);
    std::map<Edge, std::pair<ElementKind, int>> edges;
    for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3, ElementKind::solid8,
                                   ElementKind::truss, ElementKind::beam})
      for (const auto& e : all.elements())
        for (const Edge& ids : e.edges) {
          if (e.kind != kind) continue;
          const NodeIndex a = nodes.map.find(ids[0]), b = nodes.map.find(ids[1]);
          if (secondary.contains(a) && secondary.contains(b))
            edges.try_emplace({std::min(a, b), std::max(a, b)}, kind, e.id);
        }
    std::vector<Edge> list;
    for (const auto& [edge, element] : edges) list.push_back(edge);
    std::vector<std::array<std::uint32_t, 4>> segments;
    for (const MainSegment& m : contact.main) segments.push_back(m.nodes);
    const NodeArrays arrays{scene.coordinates.x, scene.coordinates.y, scene.coordinates.z};
    for (const CandidatePair& p : find_crossing_pairs(arrays, list, segments)) {
      std::array<NodeIndex, 4> corners = segments[p.main];
      std::sort(corners.begin(), corners.end());
      if (!seen.insert({list[p.secondary], corners}).second) continue;
      const auto& [kind, id] = edges.at(list[p.secondary]);
      out.emplace_back(c, list[p.secondary], kind, id, p.main);
    }
  }
  return out;
}

TEST(SceneCrossings, AreThoseOfTheDefinitionForEveryKindOfElement) {
  struct Case {
    std::size_t contacts;
    int nodes, quads, others, secondary, segments;
    bool apart = false;  // contacts without common nodes
  };
  std::set<ElementKind> kinds;
  for (const Case& c : {Case{1, 60, 12, 6, 30, 8}, Case{5, 60, 12, 6, 40, 8},
                        Case{3, 400, 1300, 0, 380, 4},  // more than two pieces of 512
                        Case{3, 402, 1300, 0, 120, 8, true}}) {
    Random random(c.contacts);
    const RandomElements all(c.nodes, c.quads, c.others, random);
    Built b(all.deck());
    b.scene.contacts.clear();
    for (std::size_t k = 0; k < c.contacts; ++k)
      b.scene.contacts.push_back(random_contact(c.nodes, c.secondary, c.segments, random,
                                                c.apart ? k : 0, c.apart ? c.contacts : 1));
    const std::vector<Row> wanted = by_definition(b.scene, all);
    EXPECT_GT(wanted.size(), 20u);
    for (const Row& row : wanted) kinds.insert(std::get<2>(row));
    for (const int threads : {1, 3})
      EXPECT_EQ(rows_of(b.scene, find_crossings(b.scene, threads)), wanted) << c.contacts;
  }
  EXPECT_EQ(kinds.size(), 5u);
}

TEST(SceneCrossings, NodesWithoutAPlaceCrossNothing) {
  Random random(5);
  const RandomElements all(60, 20, 3, random);
  Built b(all.deck());
  Scene& scene = b.scene;
  scene.contacts = {random_contact(60, 50, 6, random)};
  const auto found = [&] { return rows_of(scene, find_crossings(scene)); };
  EXPECT_EQ(found(), by_definition(scene, all));
  const std::size_t before = found().size();
  scene.coordinates.y[scene.contacts[0].secondary[3].node] = std::nan("");
  EXPECT_EQ(found(), by_definition(scene, all));
  EXPECT_LT(found().size(), before);
}

}  // namespace
}  // namespace deck::test
