// What must not change the geometry stage: the unit of length (powers of two), the axes, the ids
// of nodes, the order of cards.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "contact/small_deck.hpp"
#include "deck/contacts.hpp"

namespace deck::test {
namespace {

/// A scene as data, so that it can be written in different ways.
struct Recipe {
  struct Node {
    int id;
    double x, y, z;
  };
  struct Shell {
    int part, id;
    std::array<int, 4> nodes;
  };
  std::vector<Node> nodes;
  std::vector<Shell> shells;
  std::vector<std::string> contacts;
  std::map<int, int> new_id;     ///< of nodes; missing: unchanged
  std::uint64_t card_order = 0;  ///< 0: as given

  int id(int node) const {
    const auto it = new_id.find(node);
    return it == new_id.end() ? node : it->second;
  }

  std::string text() const {
    std::vector<std::string> blocks;
    const auto block = [&](const std::string& s) { blocks.push_back(s); };
    std::string list;
    for (const Node& n : nodes)
      list += fmt::sprintf("%10d%20.13g%20.13g%20.13g\n", id(n.id), n.x, n.y, n.z);
    block("/NODE\n" + list);
    for (int part = 1; part <= 3; ++part) {
      list = fmt::sprintf("/SHELL/%d\n", part);
      for (const Shell& s : shells)
        if (s.part == part)
          list += fmt::sprintf("%10d%10d%10d%10d%10d\n", s.id, id(s.nodes[0]), id(s.nodes[1]),
                               id(s.nodes[2]), id(s.nodes[3]));
      block(list);
      block(fmt::sprintf("/SURF/PART/%d\ns\n%10d\n", part, part));
      block(fmt::sprintf("/GRNOD/PART/%d\ng\n%10d\n", part, part));
      block(fmt::sprintf("/LINE/SURF/%d\nl\n%10d\n", part, part));
      block(fmt::sprintf("/PROP/SHELL/%d\np\n         0\n\n         3          %20.13g\n", part,
                         2.0 / part));
      block(fmt::sprintf("/PART/%d\np\n%10d%10d\n", part, part, 1));
    }
    block("/SURF/PART/9\nall\n         1         2         3\n");
    block("/GRNOD/PART/9\nall\n         1         2         3\n");
    block("/MAT/ELAST/1\nm\n               1e-06\n               200.0                 0.3\n");
    if (card_order != 0) {
      std::mt19937_64 random(card_order);
      std::shuffle(blocks.begin(), blocks.end(), random);
    }
    std::string all = "@bare\n";
    for (const std::string& b : blocks) all += b;
    for (const std::string& c : contacts) all += c + "\n";
    return example_deck(all, SchemaSet::built_in()).main;
  }
};

/// Three wavy sheets close to one another: plenty of penetrations, some nodes in several of them.
Recipe sheets(std::uint64_t seed, double waves = 1.5) {
  Recipe r;
  std::mt19937_64 random(seed);
  // Multiples of 1/256 are exact in twenty columns and stay exact in every permutation.
  const auto jitter = [&] { return static_cast<double>(random() % 256) / 256; };
  int element = 0;
  for (int part = 1; part <= 3; ++part) {
    const int base = 1000 * part, n = 5;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        r.nodes.push_back({base + 10 * j + i, 4.0 * i + jitter(), 4.0 * j + jitter(),
                           1.25 * part + waves * jitter()});
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = base + 10 * j + i;
        const bool triangle = random() % 5 == 0;
        r.shells.push_back({part, ++element, {a, a + 1, a + 11, triangle ? a + 11 : a + 10}});
      }
  }
  r.contacts = {
      "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.5 Inacti=6",
      "@/INTER/TYPE7/2 grnd_IDs=9 surf_IDm=9 Igap=1 Inacti=5",
      "@/INTER/TYPE7/3 grnd_IDs=9 surf_IDm=9 Igap=3 %mesh_size=0.25 Irem_gap=2",
      "@/INTER/TYPE7/4 grnd_IDs=9 surf_IDm=9 Gapmin=2.5 Irem_gap=2 Fpenmax=0.75",
      "@/INTER/TYPE7/5 grnd_IDs=3 surf_IDm=2 Igap=2 Fscalegap=0.75 Gapmax=1.25 Gapmin=0.5",
      "@/INTER/TYPE11/6 line_IDs=2 line_IDm=1 Inacti=6",
      "@/INTER/TYPE19/7 surf_IDs=3 surf_IDm=2 Igap=1 Gapmin=0.75"};
  return r;
}

/// What is compared: decisions and lengths of a contact. Keys are node ids of the original deck.
struct Outcome {
  std::array<double, 3> lengths{};  ///< Gapmin, largest gap, shortest side
  std::uint64_t candidates = 0, removed = 0;
  struct Row {
    std::array<double, 5> lengths;  ///< depth, gap, distance, P0, gap0
    PenetrationAction action;
    bool on_surface;
  };
  std::map<std::vector<std::int64_t>, Row> rows;
};

std::vector<Outcome> outcomes(const Scene& scene, const Model& model,
                              const std::map<int, int>& new_id = {}) {
  std::map<std::int64_t, std::int64_t> old;
  for (const auto& [from, to] : new_id) old[to] = from;
  const auto id = [&](NodeIndex n) {
    const std::int64_t v = model.node_id(n);
    const auto it = old.find(v);
    return it == old.end() ? v : it->second;
  };
  std::vector<Outcome> out;
  for (const Contact& c : scene.contacts) {
    Outcome o;
    o.lengths = {c.gapmin, c.max_gap, c.shortest_side};
    o.candidates = c.candidates;
    o.removed = c.removed_pairs;
    for (const PenetrationRow& r : c.penetrations) {
      std::vector<std::int64_t> key;
      const auto add = [&](const auto& nodes) {
        std::vector<std::int64_t> ids;
        for (const NodeIndex n : nodes) ids.push_back(id(n));
        std::sort(ids.begin(), ids.end());
        key.insert(key.end(), ids.begin(), ids.end());
      };
      if (c.kind == ContactKind::node_segment) {
        key.push_back(id(c.secondary[r.secondary].node));
        add(c.main[r.main].nodes);
      } else {
        add(c.secondary_edges[r.secondary].nodes);
        add(c.main_edges[r.main].nodes);
      }
      o.rows[key] = {{r.depth, r.gap, r.distance, r.p0, r.gap0}, r.action, r.on_surface};
    }
    out.push_back(std::move(o));
  }
  return out;
}

std::vector<Outcome> outcomes(const Built& b, const std::map<int, int>& new_id = {}) {
  return outcomes(b.scene, b.model, new_id);
}

/// Same decisions; lengths `factor` times as large, exactly or but for rounding.
void expect_same(const std::vector<Outcome>& a, const std::vector<Outcome>& b, double factor,
                 double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  const auto near = [&](const auto& x, const auto& y) {
    for (std::size_t k = 0; k < x.size(); ++k)
      if (tolerance == 0)
        EXPECT_EQ(factor * x[k], y[k]) << k;
      else
        EXPECT_NEAR(factor * x[k], y[k], tolerance * factor) << k;
  };
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE("contact " + std::to_string(i));
    near(a[i].lengths, b[i].lengths);
    EXPECT_EQ(a[i].candidates, b[i].candidates);
    EXPECT_EQ(a[i].removed, b[i].removed);
    ASSERT_EQ(a[i].rows.size(), b[i].rows.size());
    for (auto x = a[i].rows.begin(), y = b[i].rows.begin(); x != a[i].rows.end(); ++x, ++y) {
      ASSERT_EQ(x->first, y->first);
      EXPECT_EQ(x->second.action, y->second.action);
      EXPECT_EQ(x->second.on_surface, y->second.on_surface);
      near(x->second.lengths, y->second.lengths);
    }
  }
}

std::size_t penetrations(const std::vector<Outcome>& all) {
  std::size_t sum = 0;
  for (const Outcome& o : all) sum += o.rows.size();
  return sum;
}

/// The contacts of a deck with every length of its model and cards multiplied.
struct Scaled {
  Scaled(const std::string& text, double f)
      : deck(std::move(*read_deck_text("small_0000.rad", text, SchemaSet::built_in()))),
        model(build_model(deck, SchemaSet::built_in(), findings)),
        interfaces(read_interfaces(deck, model, findings)) {
    for (auto* a : {&model.nodes.x, &model.nodes.y, &model.nodes.z})
      for (double& v : *a) v *= f;
    for (Property& p : model.properties) {
      p.thickness *= f;
      p.area *= f * f;
    }
    for (Part& p : model.parts) p.thickness *= f;
    for (InterType7& i : interfaces.type7) {
      i.Gapmin.value *= f;
      i.Gapmax.value *= i.Gapmax.value < 1e29 ? f : 1;
      i.Drad.value *= f;
    }
    for (InterType11& i : interfaces.type11) i.Gapmin.value *= f;
    for (InterType19& i : interfaces.type19) i.Gapmin.value *= f;
    scene = build_scene(model, interfaces, findings);
  }
  Deck deck;
  Findings findings;
  Model model;
  Interfaces interfaces;
  Scene scene;
};

TEST(GeometryInvariance, LengthsTimesAPowerOfTwo) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::string text = sheets(seed).text();
    const Built plain(text);
    const auto expected = outcomes(plain);
    EXPECT_GT(penetrations(expected), 100u);
    for (const int k : {-12, -1, 3, 20}) {
      const Scaled scaled(text, std::ldexp(1.0, k));
      SCOPED_TRACE("2^" + std::to_string(k));
      expect_same(expected, outcomes(scaled.scene, scaled.model), std::ldexp(1.0, k), 0);
      for (std::size_t i = 0; i < plain.scene.contacts.size(); ++i) {
        const auto &a = plain.scene.contacts[i].main, &c = scaled.scene.contacts[i].main;
        for (std::size_t m = 0; m < a.size(); ++m)
          EXPECT_EQ(std::ldexp(a[m].stiffness, k), c[m].stiffness) << "E t";
      }
    }
  }
}

TEST(GeometryInvariance, CrossingsDoNotScale) {
  const std::string text = sheets(4, 8).text();
  const auto key = [](const Scene& scene) {
    std::vector<std::array<std::uint32_t, 4>> out;
    for (const Crossing& c : find_crossings(scene))
      out.push_back({c.contact, c.edge[0], c.edge[1], c.main});
    return out;
  };
  const auto expected = key(Built(text).scene);
  EXPECT_GT(expected.size(), 5u);
  EXPECT_EQ(key(Scaled(text, std::ldexp(1.0, -300)).scene), expected);
}

TEST(GeometryInvariance, AnyPermutationOfTheAxes) {
  for (const std::uint64_t seed : {5, 6}) {
    const Recipe plain = sheets(seed);
    const auto expected = outcomes(Built(plain.text()));
    std::array<int, 3> axes{0, 1, 2};
    while (std::next_permutation(axes.begin(), axes.end())) {
      Recipe turned = plain;
      for (Recipe::Node& n : turned.nodes) {
        const double v[] = {n.x, n.y, n.z};
        n.x = v[axes[0]];
        n.y = v[axes[1]];
        n.z = v[axes[2]];
      }
      // Squares are summed in another order: decisions the same, lengths to the last bits.
      expect_same(expected, outcomes(Built(turned.text())), 1, 1e-13);
    }
  }
}

TEST(GeometryInvariance, NodeIdsInAnyOrder) {
  const Recipe plain = sheets(8);
  const auto expected = outcomes(Built(plain.text()));
  Recipe renumbered = plain;
  for (const Recipe::Node& n : plain.nodes) renumbered.new_id[n.id] = 3 * n.id + 500000;
  expect_same(expected, outcomes(Built(renumbered.text()), renumbered.new_id), 1, 0);
  std::mt19937_64 random(8);
  std::vector<int> ids;
  for (const Recipe::Node& n : plain.nodes) ids.push_back(n.id);
  for (int round = 0; round < 3; ++round) {
    std::shuffle(ids.begin(), ids.end(), random);
    for (std::size_t i = 0; i < ids.size(); ++i) renumbered.new_id[plain.nodes[i].id] = ids[i];
    // Edges begin at their smaller node, so the two weights may change places.
    expect_same(expected, outcomes(Built(renumbered.text()), renumbered.new_id), 1, 1e-13);
  }
}

TEST(GeometryInvariance, CardsInAnyOrder) {
  const Recipe plain = sheets(9);
  const auto expected = outcomes(Built(plain.text()));
  for (std::uint64_t order = 1; order <= 4; ++order) {
    Recipe shuffled = plain;
    shuffled.card_order = order;
    expect_same(expected, outcomes(Built(shuffled.text())), 1, 1e-13);
  }
}

}  // namespace
}  // namespace deck::test
