// Writes random decks as pages and, for settings under test, what the library makes of the deck
// written with these settings: the cases of what_if_random.mjs.
//   what_if_cases FIRST COUNT     decks FIRST .. FIRST + COUNT - 1, a line of JSON each
#include <cstdio>
#include <cstdlib>
#include <random>

#include <nlohmann/json.hpp>

#include "contact/small_deck.hpp"
#include "deck/contact/view.hpp"
#include "deck/report/html.hpp"

namespace deck::test {
namespace {

using nlohmann::json;

/// Fields of one interface; numbers as their cell has them.
using Fields = std::vector<std::pair<std::string, std::string>>;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double real(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  int whole(int below) { return static_cast<int>(engine_() % static_cast<unsigned>(below)); }
  bool chance(double share) { return real(0, 1) < share; }
  template <class T>
  T pick(std::initializer_list<T> list) {
    return list.begin()[whole(static_cast<int>(list.size()))];
  }

 private:
  std::mt19937 engine_;
};

/// Two bent sheets of quadrangles and triangles over one another, some bars, sometimes a solid
/// block below: what one random interface joins, self contact as often as not.
class Case {
 public:
  explicit Case(unsigned seed) : random_(seed) {
    type_ = random_.pick({7, 7, 7, 10, 11, 11, 19, 19});
    // Removal along the mesh shows in meshes that are fine for their gaps.
    removes_ = type_ != 10 && random_.chance(0.6);
    mesh();
    groups();
    card();
  }

  int type() const { return type_; }
  SmallDeck deck(const Fields& changes = {}) const {
    Fields fields = card_;
    for (const auto& [name, value] : changes) {
      const std::string cell = type_ == 10 && name == "Gapmin" ? "Gap" : name;
      std::erase_if(fields, [&](const auto& f) { return f.first == cell; });
      fields.emplace_back(cell, value);
    }
    std::string line = fmt::format("@/INTER/TYPE{}/1", type_);
    for (const auto& [name, value] : fields) line += " " + name + "=" + value;
    SmallDeck d = deck_;
    return d.add("@version 2024\n" + line);
  }

  /// Settings under test. Every one of the page's fields, legal values only.
  Fields setting() {
    Fields out;
    const auto maybe = [&](const char* name, double share, const std::string& value) {
      if (random_.chance(share)) out.emplace_back(name, value);
    };
    maybe("Gapmin", 0.6, random_.chance(0.2) ? "0" : removes_ ? length(0.4, 4) : length(0.1, 1.6));
    if (type_ == 10) return out;
    maybe("Igap", 0.6, random_.pick({"0", "1", "3", "1000"}));
    if (type_ != 11) maybe("Igap", 0.3, random_.pick({"0", "1", "2", "3", "1000"}));
    if (out.size() > 1 && out[out.size() - 1].first == out[out.size() - 2].first) out.pop_back();
    maybe("Inacti", 0.7, random_.pick({"0", "1", "2", "3", "5", "6", "1000"}));
    if (type_ == 11) return out;
    maybe("Fscalegap", 0.4, length(0.4, 1.5));
    maybe("Gapmax", 0.4, random_.chance(0.2) ? "0" : length(0.2, 1.2));
    if (type_ == 7) maybe("Fpenmax", 0.4, random_.chance(0.2) ? "0" : length(0.1, 1));
    return out;
  }

 private:
  std::string length(double low, double high) {
    return fmt::format("{:.5f}", random_.real(low, high));
  }
  double shaken(double share) { return share * random_.real(-0.5, 0.5); }

  void sheet(int part, int first, int rows, int columns, double height) {
    const double bend = random_.real(0, 0.6);
    for (int i = 0; i <= rows; ++i)
      for (int k = 0; k <= columns; ++k)
        deck_.node(first + i * (columns + 1) + k, k + shaken(0.4), i + shaken(0.4),
                   height + bend * (k % 3) + shaken(0.5));
    for (int i = 0; i < rows; ++i)
      for (int k = 0; k < columns; ++k) {
        const int n = first + i * (columns + 1) + k, up = n + columns + 1;
        const int id = 1000 * part + 2 * (i * columns + k);
        const double own = random_.chance(0.2) ? 0.001 * (100 + random_.whole(700)) : 0;
        if (random_.chance(0.7)) {
          deck_.shell(part, id, n, n + 1, up + 1, up, own);
        } else {
          deck_.shell3(part, id, n, n + 1, up + 1);
          deck_.shell3(part, id + 1, n, up + 1, up);
        }
      }
    for (int n = first; n < first + (rows + 1) * (columns + 1); ++n) nodes_[part].push_back(n);
  }

  void mesh() {
    deck_.shell_part(1, random_.real(0.1, 0.8)).shell_part(2, random_.real(0.1, 0.8));
    const int least = removes_ ? 4 : 2;
    const int rows = least + random_.whole(4), columns = least + random_.whole(4);
    sheet(1, 1, rows, columns, 0);
    sheet(2, 201, rows, columns, random_.real(0.1, 0.9));
    if (random_.chance(0.4)) {
      deck_.beam_part(3, random_.real(0.01, 0.3));
      deck_.node(400, 0.5, 0.5, 5);
      for (int i = 0; i < 2; ++i)
        deck_.bar("BEAM", 3, 7000 + i, nodes_[2][static_cast<std::size_t>(i)],
                  nodes_[2][static_cast<std::size_t>(i + 1)], 400);
    }
    if (random_.chance(0.3)) {
      deck_.solid_part(4);
      const double top = -random_.real(0.05, 0.6);
      std::array<int, 8> n{};
      for (int i = 0; i < 8; ++i) {
        n[static_cast<std::size_t>(i)] = 501 + i;
        deck_.node(501 + i, (i % 4 == 1 || i % 4 == 2) ? 2 : 0, i % 4 >= 2 ? 2 : 0,
                   i < 4 ? top - 1 : top);
      }
      deck_.brick(4, 9000, n);
      solid_ = true;
    }
  }

  void groups() {
    // Surface 1 is the main side; 2 the other sheet, the same one, or both.
    const std::vector<int> main = random_.pick<std::vector<int>>({{1}, {1, 2}, {1, 2}});
    self_ = random_.chance(0.6);
    if (solid_ && random_.chance(0.5)) {
      deck_.segments("/SURF/SEG/1", {{505, 506, 507, 508}});
    } else {
      deck_.group("/SURF/PART/1", main);
    }
    deck_.group("/SURF/PART/2", self_ ? main : std::vector<int>{2});
    deck_.group("/LINE/SURF/1", {1}).group("/LINE/SURF/2", {2});
    // The node group is part of what it could be in most cases.
    std::vector<int> nodes;
    const double share = random_.chance(0.3) ? 1 : random_.real(0.1, 0.9);
    for (const int part : {1, 2})
      if (part == 2 || self_)
        for (const int n : nodes_[part])
          if (random_.chance(share)) nodes.push_back(n);
    if (nodes.empty()) nodes.push_back(nodes_[2].front());
    deck_.group("/GRNOD/NODE/2", nodes);
  }

  void card() {
    const auto set = [&](const char* name, const std::string& value) {
      card_.emplace_back(name, value);
    };
    set(type_ == 10 ? "Gap" : "Gapmin", random_.chance(0.3) ? "0"
                                        : removes_          ? length(0.4, 3)
                                                            : length(0.2, 1));
    if (type_ == 10) return;
    set("Irem_gap", removes_ ? "2" : "1");
    set("Inacti", random_.pick({"0", "1", "2", "3", "5", "6", "1000"}));
    if (type_ == 11) {
      set("Igap", random_.pick({"0", "1", "3", "1000"}));
    } else {
      set("Igap", type_ == 19 ? random_.pick({"0", "1", "2", "3", "4", "1000"})
                              : random_.pick({"0", "1", "2", "3", "1000"}));
      set("Fscalegap", random_.chance(0.3) ? "0" : length(0.5, 1.4));
      set("Gapmax", random_.chance(0.5) ? "0" : length(0.3, 1.2));
    }
    if (random_.chance(0.3)) set("%mesh_size", length(0.2, 0.7));
    if (type_ == 7 && random_.chance(0.4)) set("Fpenmax", length(0.1, 1));
    if (type_ == 19 && random_.chance(0.4)) set("Edge_scale_gap", length(0.3, 1.2));
  }

  Random random_;
  int type_ = 7;
  SmallDeck deck_;
  std::map<int, std::vector<int>> nodes_;
  bool removes_ = false, self_ = false, solid_ = false;
  Fields card_;
};

/// What the page has to say, named as `deckReport.whatIf` names it.
json expected(const Built& b) {
  json out = json::array();
  const auto ids = [&](const auto& nodes) {
    json list = json::array();
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (k < 3 || nodes[k] != nodes[k - 1]) list.push_back(b.model.node_id(nodes[k]));
    return list;
  };
  for (const Contact& c : b.scene.contacts) {
    json rows = json::array();
    const bool edges = c.kind == ContactKind::edge_edge;
    for (const PenetrationRow& r : c.penetrations) {
      json row{{"depth", r.depth},
               {"gap", r.gap},
               {"distance", r.distance},
               {"normal", r.normal},
               {"on_surface", r.on_surface}};
      row["secondary"] = edges ? ids(c.secondary_edges[r.secondary].nodes)
                               : json::array({b.model.node_id(c.secondary[r.secondary].node)});
      row["main"] = edges ? ids(c.main_edges[r.main].nodes) : ids(c.main[r.main].nodes);
      row["action"] = to_string(r.action);
      row["gap0"] = r.has_gap0 ? json(r.gap0) : json();
      row["p0"] = r.has_gap0 ? json(r.p0) : json();
      row["moved_by"] = r.action == PenetrationAction::node_moved ? json(r.moved_by) : json();
      rows.push_back(std::move(row));
    }
    out.push_back({{"role", to_string(c.role)},
                   {"gapmin", c.gapmin},
                   {"max_gap", c.max_gap},
                   {"igap", c.igap},
                   {"irem_gap", c.irem_gap},
                   {"penetrations", std::move(rows)}});
  }
  return out;
}

std::string block(const std::string& page, const std::string& id) {
  const std::string mark = "id=\"" + id + "\">";
  const auto at = page.find(mark);
  if (at == std::string::npos) return "";
  return page.substr(at + mark.size(), page.find("</script>", at) - at - mark.size());
}

int write_case(unsigned seed) {
  Case random(seed);
  const Built b(random.deck());
  const SceneView view = make_view(b.scene);
  HtmlInput input;
  input.path = "random_0000.rad";
  input.deck = &b.deck;
  input.scene = &b.scene;
  input.view = &view;
  const auto page = gaps_html(input);
  if (!page) {
    std::fprintf(stderr, "%s\n", page.error().message.c_str());
    return 1;
  }
  json out{{"seed", seed}, {"type", random.type()}, {"trials", json::array()}};
  for (const char* id : {"deck-meta", "deck-shared", "deck-contacts", "deck-mesh"})
    out[id] = block(*page, id);
  out["trials"].push_back({{"fields", json::object()}, {"expected", expected(b)}});
  for (int trial = 0; trial < 3; ++trial) {
    const Fields fields = random.setting();
    json changes = json::object();
    for (const auto& [name, value] : fields) changes[name] = std::strtod(value.c_str(), nullptr);
    out["trials"].push_back(
        {{"fields", changes}, {"expected", expected(Built(random.deck(fields)))}});
  }
  std::puts(out.dump().c_str());
  return 0;
}

}  // namespace
}  // namespace deck::test

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const unsigned first = static_cast<unsigned>(std::atoi(argv[1]));
  const unsigned count = static_cast<unsigned>(std::atoi(argv[2]));
  for (unsigned seed = first; seed < first + count; ++seed)
    if (deck::test::write_case(seed) != 0) return 1;
  return 0;
}
