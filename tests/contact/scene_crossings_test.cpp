// Crossed elements of whole scenes of every kind of element against the definition, looked up edge
// by edge.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "contact/small_deck.hpp"
#include "deck/contacts.hpp"

namespace deck::test {
namespace {

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

Contact random_contact(int nodes, int secondary, int segments, Random& random) {
  Contact c;
  std::set<NodeIndex> some;
  while (some.size() < static_cast<std::size_t>(secondary))
    some.insert(static_cast<NodeIndex>(random() % static_cast<unsigned>(nodes)));
  for (const NodeIndex n : some) {
    SecondaryNode s;
    s.node = n;
    c.secondary.push_back(s);
  }
  for (int k = 0; k < segments; ++k) {
    MainSegment m;
    for (NodeIndex& n : m.nodes)
      n = static_cast<NodeIndex>(random() % static_cast<unsigned>(nodes));
    if (k % 3 == 0) m.nodes[3] = m.nodes[2];
    c.main.push_back(m);
  }
  c.main.push_back(c.main.front());  // the same place again, its nodes in another order
  std::rotate(c.main.back().nodes.begin(), c.main.back().nodes.begin() + 2,
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
    std::size_t contacts;  // from three on elements are found by node
    int nodes, quads, others, secondary, segments;
  };
  std::set<ElementKind> kinds;
  for (const Case& c : {Case{1, 60, 12, 6, 30, 8}, Case{2, 60, 12, 6, 35, 8},
                        Case{5, 60, 12, 6, 40, 8}, Case{1, 400, 1300, 0, 380, 4},
                        Case{3, 400, 1300, 0, 380, 4}}) {  // more than two pieces of 512
    Random random(c.contacts);
    const RandomElements all(c.nodes, c.quads, c.others, random);
    Built b(all.deck());
    b.scene.contacts.clear();
    for (std::size_t k = 0; k < c.contacts; ++k)
      b.scene.contacts.push_back(random_contact(c.nodes, c.secondary, c.segments, random));
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
