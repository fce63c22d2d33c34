// Decks of a few elements as text, and what the geometry stage makes of them. Interface cards are
// written as "@/INTER/TYPE7/1 Gapmin=1" (notation of lint/shared/example.hpp).
#pragma once
#include <fmt/printf.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "deck/contacts.hpp"
#include "deck/loaded_deck.hpp"
#include "lint/shared/example.hpp"

namespace deck::test {

/// Builds the text of a deck card by card. Units kg, mm, ms; material 1 is elastic with E = 200,
/// nu = 0.3 (bulk modulus 500/3).
class SmallDeck {
 public:
  SmallDeck& node(int id, double x, double y, double z) {
    return line(nodes_, "%10d%20.13g%20.13g%20.13g", id, x, y, z);
  }
  /// A shell part: property and part of the same id. `contact` is the /PART thickness.
  SmallDeck& shell_part(int id, double thickness, double contact = 0, int mat = 1) {
    line(cards_, "/PROP/SHELL/%d\np\n         0\n\n         3          %20.13g", id, thickness);
    return part(id, mat, contact);
  }
  SmallDeck& void_part(int id, double thickness, int mat = 1) {
    line(cards_, "/PROP/VOID/%d\np\n%20.13g", id, thickness);
    return part(id, mat, 0);
  }
  SmallDeck& solid_part(int id, int mat = 1) {
    line(cards_, "/PROP/SOLID/%d\np\n\n\n", id);
    return part(id, mat, 0);
  }
  SmallDeck& beam_part(int id, double area, double contact = 0) {
    line(cards_, "/PROP/BEAM/%d\np\n\n\n%20.13g%20d%20d%20d\n       000", id, area, 1, 1, 2);
    return part(id, 1, contact);
  }
  SmallDeck& truss_part(int id, double area, double contact = 0) {
    line(cards_, "/PROP/TRUSS/%d\np\n%20.13g", id, area);
    return part(id, 1, contact);
  }
  SmallDeck& spring_part(int id, double stiffness, double contact = 0) {
    line(cards_, "/PROP/SPRING/%d\np\n                 1.0\n%20.13g", id, stiffness);
    return part(id, 1, contact);
  }
  SmallDeck& void_material(int id, double young) {
    return line(cards_, "/MAT/VOID/%d\nm\n               1e-06%20.13g                 0.3", id,
                young);
  }
  SmallDeck& elastic_material(int id, double young) {
    return line(cards_, "/MAT/ELAST/%d\nm\n               1e-06\n%20.13g                 0.3", id,
                young);
  }
  SmallDeck& shell(int part, int id, int n1, int n2, int n3, int n4, double thickness = 0) {
    line(cards_, "/SHELL/%d", part);
    if (thickness == 0) return line(cards_, "%10d%10d%10d%10d%10d", id, n1, n2, n3, n4);
    return line(cards_, "%10d%10d%10d%10d%10d%20d%20.13g", id, n1, n2, n3, n4, 0, thickness);
  }
  SmallDeck& shell3(int part, int id, int n1, int n2, int n3) {
    return line(cards_, "/SH3N/%d\n%10d%10d%10d%10d", part, id, n1, n2, n3);
  }
  SmallDeck& brick(int part, int id, const std::array<int, 8>& n) {
    return line(cards_, "/BRICK/%d\n%10d%10d%10d%10d%10d%10d%10d%10d%10d", part, id, n[0], n[1],
                n[2], n[3], n[4], n[5], n[6], n[7]);
  }
  SmallDeck& tetra(int part, int id, int n1, int n2, int n3, int n4) {
    return line(cards_, "/TETRA4/%d\n%10d%10d%10d%10d%10d", part, id, n1, n2, n3, n4);
  }
  /// A beam, truss or spring; `n3` orients beams.
  SmallDeck& bar(const char* keyword, int part, int id, int n1, int n2, int n3 = 0) {
    if (n3 == 0) return line(cards_, "/%s/%d\n%10d%10d%10d", keyword, part, id, n1, n2);
    return line(cards_, "/%s/%d\n%10d%10d%10d%10d", keyword, part, id, n1, n2, n3);
  }
  /// Segments of a /SURF/SEG or, with two nodes each, of a /LINE/SEG.
  SmallDeck& segments(const char* header, const std::vector<std::vector<int>>& list) {
    cards_ += std::string(header) + "\ns\n";
    int id = 0;
    for (const auto& nodes : list) {
      line(cards_, "%10d", ++id);
      cards_.pop_back();
      for (const int n : nodes) {
        line(cards_, "%10d", n);
        cards_.pop_back();
      }
      cards_ += "\n";
    }
    return *this;
  }
  /// A group of whole numbers, such as /GRNOD/NODE or /SURF/PART.
  SmallDeck& group(const char* header, const std::vector<int>& ids) {
    cards_ += std::string(header) + "\ng";
    for (std::size_t i = 0; i < ids.size(); ++i) {
      cards_ += i % 10 == 0 ? "\n" : "";
      line(cards_, "%10d", ids[i]);
      cards_.pop_back();
    }
    cards_ += "\n";
    return *this;
  }
  /// Any lines; "@/..." are laid out.
  SmallDeck& add(const std::string& text) {
    cards_ += text.empty() || text.ends_with('\n') ? text : text + "\n";  // a blank line is data
    return *this;
  }
  std::string text() const {
    const std::string material =
        "/MAT/ELAST/1\nm\n               1e-06\n               200.0                 0.3\n";
    return example_deck("@bare\n" + material + "/NODE\n" + nodes_ + cards_, SchemaSet::built_in())
        .main;
  }

 private:
  SmallDeck& part(int id, int mat, double contact) {
    return line(cards_, "/PART/%d\npart\n%10d%10d%10d%20.13g", id, id, mat, 0, contact);
  }
  template <class... Args>
  SmallDeck& line(std::string& out, const char* format, Args... args) {
    out += fmt::sprintf(format, args...);
    out += "\n";
    return *this;
  }
  std::string nodes_, cards_;
};

/// A deck with everything made of it. Not movable: the parts point to one another.
struct Built {
  explicit Built(const SmallDeck& small, const SceneOptions& options = {})
      : Built(small.text(), options) {}
  explicit Built(const std::string& text, const SceneOptions& options = {}) : loaded(read(text)) {
    findings = loaded.found_by(Stage::model);
    findings.merge(Findings(loaded.found_by(Stage::interfaces)));
    build(options);
  }
  Built(const Built&) = delete;
  Built& operator=(const Built&) = delete;
  void build(const SceneOptions& options) { scene = loaded.scene_with(options, findings); }

  const Contact& contact(std::int64_t id = 1, ContactRole role = ContactRole::primary) const {
    for (const Contact& c : scene.contacts)
      if (c.inter->id == id && c.role == role) return c;
    ADD_FAILURE() << "no contact " << id << " " << to_string(role);
    static const Contact none;
    return none;
  }
  /// The penetration of a node (of the segment `main` if given); nullptr if there is none.
  const PenetrationRow* row(const Contact& c, std::int64_t node, std::size_t main = any) const {
    for (const PenetrationRow& r : c.penetrations)
      if (model.node_id(c.secondary[r.secondary].node) == node && (main == any || r.main == main))
        return &r;
    return nullptr;
  }
  const SecondaryNode* secondary(const Contact& c, std::int64_t node) const {
    for (const SecondaryNode& s : c.secondary)
      if (model.node_id(s.node) == node) return &s;
    return nullptr;
  }
  std::array<std::int64_t, 4> ids(const std::array<NodeIndex, 4>& nodes) const {
    return {model.node_id(nodes[0]), model.node_id(nodes[1]), model.node_id(nodes[2]),
            model.node_id(nodes[3])};
  }
  /// The segment of a contact with exactly these nodes, in any order, whichever is repeated.
  const MainSegment* main(const Contact& c, const std::vector<std::int64_t>& nodes) const {
    const std::set<std::int64_t> wanted(nodes.begin(), nodes.end());
    for (const MainSegment& m : c.main) {
      const auto have = ids(m.nodes);
      if (std::set<std::int64_t>(have.begin(), have.end()) == wanted) return &m;
    }
    return nullptr;
  }
  /// The edge pair with these node ids, in any order; nullptr if there is none.
  const PenetrationRow* edges(const Contact& c, std::array<std::int64_t, 2> s,
                              std::array<std::int64_t, 2> m) const {
    const auto same = [&](const ContactEdge& e, const std::array<std::int64_t, 2>& n) {
      const std::int64_t a = model.node_id(e.nodes[0]), b = model.node_id(e.nodes[1]);
      return (a == n[0] && b == n[1]) || (a == n[1] && b == n[0]);
    };
    for (const PenetrationRow& r : c.penetrations)
      if (same(c.secondary_edges[r.secondary], s) && same(c.main_edges[r.main], m)) return &r;
    return nullptr;
  }

  static constexpr std::size_t any = static_cast<std::size_t>(-1);
  LoadedDeck loaded;
  const Deck& deck = loaded.deck();
  const Model& model = loaded.model();
  const Interfaces& interfaces = loaded.interfaces();
  Findings findings;  ///< of model, interfaces and scene
  Scene scene;

 private:
  static LoadedDeck read(const std::string& text) {
    auto read = read_deck_text("small_0000.rad", text, SchemaSet::built_in());
    EXPECT_TRUE(read.ok());
    LoadOptions options;
    options.geometry = false;
    return LoadedDeck::from(std::move(*read), options);
  }
};

/// A plate of 10 x 10 with thickness 2, two nodes at these heights above it, with some interface.
inline SmallDeck plate_and_nodes(const std::string& card, double z1 = 5, double z2 = 5) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(101, 3, 4, z1).node(102, 6, 4, z2).shell_part(1, 2).shell(1, 1, 1, 2, 3, 4);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {101, 102}).group("/LINE/SURF/1", {1});
  return d.add(card);
}

}  // namespace deck::test
