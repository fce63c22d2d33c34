// Crossed elements of whole scenes of every kind of element against the definition, looked up edge
// by edge; and many edges at once against few at a time.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "contact/small_deck.hpp"
#include "deck/contact/crossings.hpp"

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
    for (int k = 0; k < quads; ++k) add(ElementKind::shell4, 4, ring(0, 4));
    for (int k = 0; k < others; ++k) {
      add(ElementKind::shell3, 3, ring(0, 3));
      add(ElementKind::solid8, 8, join({ring(0, 4), ring(4, 4), {{0, 4}, {1, 5}, {2, 6}, {3, 7}}}));
      add(ElementKind::solid8, 6, join({ring(0, 3), ring(3, 3), {{0, 3}, {1, 4}, {2, 5}}}));
      add(ElementKind::solid8, 4, join({ring(0, 3), {{0, 3}, {1, 3}, {2, 3}}}));
      add(ElementKind::truss, 2, {{0, 1}});
      add(ElementKind::beam, 3, {{0, 1}});  // the third node orients it
      add(ElementKind::spring, 2, {});      // joins what it passes through
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
  void add(ElementKind kind, int count, const Slots& slots) {
    std::set<int> some;
    while (some.size() < static_cast<std::size_t>(count))
      some.insert(1 + static_cast<int>(random_() % static_cast<unsigned>(nodes_)));
    std::vector<int> n(some.begin(), some.end());
    std::shuffle(n.begin(), n.end(), random_);
    const int id = static_cast<int>(elements_.size()) + 1;
    switch (count) {
      case 2:
        deck_.bar(kind == ElementKind::truss ? "TRUSS" : "SPRING",
                  kind == ElementKind::truss ? 3 : 5, id, n[0], n[1]);
        break;
      case 3:
        if (kind == ElementKind::beam)
          deck_.bar("BEAM", 4, id, n[0], n[1], n[2]);
        else
          deck_.shell3(1, id, n[0], n[1], n[2]);
        break;
      case 4:
        if (kind == ElementKind::shell4)
          deck_.shell(1, id, n[0], n[1], n[2], n[3]);
        else
          deck_.tetra(2, id, n[0], n[1], n[2], n[3]);
        break;
      case 6:
        deck_.add(fmt::sprintf("/PENTA6/2\n%10d%10d%10d%10d%10d%10d%10d", id, n[0], n[1], n[2],
                               n[3], n[4], n[5]));
        break;
      default:
        deck_.brick(2, id, {n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7]});
    }
    Element e{kind, id, {}};
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
  std::set<ElementKind> kinds;
  for (const std::size_t contacts : {1u, 2u, 5u}) {  // from three on elements are found by node
    Random random(contacts);
    const RandomElements all(60, 12, 6, random);
    Built b(all.deck());
    Scene& scene = b.scene;
    scene.model = &b.model;
    scene.contacts.clear();
    for (std::size_t c = 0; c < contacts; ++c)
      scene.contacts.push_back(random_contact(60, 30 + 5 * static_cast<int>(c), 8, random));
    const std::vector<Row> wanted = by_definition(scene, all);
    EXPECT_GT(wanted.size(), 20u);
    for (const Row& row : wanted) kinds.insert(std::get<2>(row));
    for (const int threads : {1, 3})
      EXPECT_EQ(rows_of(scene, find_crossings(scene, threads)), wanted) << contacts;
  }
  EXPECT_EQ(kinds.size(), 5u);
}

TEST(SceneCrossings, OfManyElementsAreThoseOfTheDefinition) {
  Random random(77);
  const RandomElements all(400, 1300, 0, random);  // more than two pieces of 512
  Built b(all.deck());
  Scene& scene = b.scene;
  for (const std::size_t contacts : {1u, 3u}) {
    scene.contacts.clear();
    for (std::size_t c = 0; c < contacts; ++c)
      scene.contacts.push_back(random_contact(400, 380, 4, random));
    const std::vector<Row> wanted = by_definition(scene, all);
    EXPECT_GT(wanted.size(), 100u);
    for (const int threads : {1, 2})
      EXPECT_EQ(rows_of(scene, find_crossings(scene, threads)), wanted) << contacts;
  }
}

TEST(SceneCrossings, NodesBeyondTheMainSideAndWithoutAPlaceCrossNothing) {
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
  // The whole main side far away in one direction.
  for (int axis = 0; axis < 3; ++axis)
    for (const double way : {100.0, -100.0}) {
      Coordinates kept = scene.coordinates;
      Contact apart = scene.contacts[0];
      for (MainSegment& m : apart.main) m.nodes = {0, 1, 2, 3};
      apart.secondary.erase(apart.secondary.begin(), apart.secondary.begin() + 6);
      std::vector<double>* x[] = {&scene.coordinates.x, &scene.coordinates.y, &scene.coordinates.z};
      for (std::size_t n = 0; n < 4; ++n) (*x[axis])[n] += way;
      std::swap(apart, scene.contacts[0]);
      EXPECT_TRUE(find_crossings(scene).empty());
      std::swap(apart, scene.contacts[0]);
      scene.coordinates = kept;
    }
}

TEST(CrossingPairs, OfManyEdgesAreThoseOfAHundredAtATime) {
  Random random(9);
  std::uniform_real_distribution<double> at(0, 10);
  std::vector<double> x, y, z;
  for (int n = 0; n < 300; ++n)
    x.push_back(at(random)), y.push_back(at(random)), z.push_back(at(random));
  const auto node = [&] { return static_cast<std::uint32_t>(random() % 300); };
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::array<std::uint32_t, 4>> segments;
  for (int k = 0; k < 1300; ++k) edges.push_back({node(), node()});
  for (int k = 0; k < 7; ++k) segments.push_back({node(), node(), node(), node()});
  std::vector<CandidatePair> wanted;
  for (std::uint32_t first = 0; first < edges.size(); first += 100) {
    const auto some =
        std::span(edges).subspan(first, std::min<std::size_t>(100, edges.size() - first));
    for (const CandidatePair& p : find_crossing_pairs({x, y, z}, some, segments))
      wanted.push_back({p.secondary + first, p.main});
  }
  EXPECT_GT(wanted.size(), 100u);
  for (const int threads : {1, 2})
    EXPECT_EQ(find_crossing_pairs({x, y, z}, edges, segments, threads), wanted);
}

}  // namespace
}  // namespace deck::test
