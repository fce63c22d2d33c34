// Reads options with kinematic conditions, including rigid bodies.
#include "model/mesh/condition_cards.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "deck/keyword.hpp"
#include "deck/model.hpp"
#include "deck/text.hpp"
#include "keyword/shared/solver_order.hpp"
#include "model/mesh/mesh_parts.hpp"
#include "model/model_build.hpp"

namespace deck::detail {
namespace {

constexpr std::uint8_t all_six = 0b111111;
// Numbers of axis systems: 0 none, 1 global, then skews, frames, walls.
constexpr std::int64_t skew_base = 10, frame_base = std::int64_t{1} << 40,
                       wall_base = std::int64_t{1} << 41;

std::int64_t skew_system(std::int64_t id) { return id > 0 ? skew_base + id : 1; }

/// The line after the title.
Line first_data_line(const Deck& deck, const Block& block) {
  LineCursor lines(deck.sources, block);
  if (block.schema->has_title) lines.next();
  return lines.next();
}

/// Integer in the ten columns after the first `first`.
std::int64_t integer_at(const Line& line, std::size_t first) {
  if (!line.valid() || line.text.size() <= first) return 0;
  return read_integer(line.text.substr(first, 10)).value;
}

void unique(std::vector<NodeIndex>& nodes) {
  std::erase(nodes, no_index);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

template <class Body>
void add_nodes(const Model& model, std::int64_t group, Body& body) {
  const NodeSet* set = group_of(model, *body.block, group);
  if (set == nullptr) return;
  for (const NodeIndex n : set->nodes)
    if (n != body.main) body.nodes.push_back(n);
  unique(body.nodes);
}

class Reader {
 public:
  Reader(const Model& model, const std::vector<TiedNodes>* ties)
      : model_(model), deck_(*model.deck), ties_(ties) {}

  ConditionCards run() {
    for (const Block* const at : in_solver_order(deck_, [](const Block&) { return true; })) {
      const Block& b = *at;
      if (b.opaque) continue;
      if (b.schema != nullptr)
        block(b);
      else if (b.header.starts_with("/NBCS"))
        not_booked(b);
    }
    bodies();
    condensed_nodes();
    return std::move(out_);
  }

 private:
  void block(const Block& b) {
    const std::string_view k = b.schema->keyword;
    if (k == "/BCS" || k == "/BCS/LAGMUL")
      boundary(b, k != "/BCS");
    else if (k == "/IMPVEL" || k == "/IMPDISP" || k == "/IMPACC")
      imposed(b, k == "/IMPVEL" ? 2 : k == "/IMPDISP" ? 3 : 4);
    else if (k == "/RLINK")
      link(b);
    else if (k == "/RBE2")
      rigid_link(b);
    else if (k == "/RBE3")
      weighted_element(b);
    else if (k == "/MPC")
      multi_point(b);
    else if (k.starts_with("/RWALL/"))
      wall(b, k);
    else if (k == "/INTER/TYPE2")
      tie(b);
    else if (k == "/INTER/TYPE12")
      fluid_tie(b);
    else if (k == "/CYL_JOINT")
      cylinder(b);
    else if (k == "/NBCS" || k == "/INTER/TYPE1" || k == "/INTER/TYPE9" || k == "/BCS/CYCLIC" ||
             k == "/IMPDISP/FGEO" || k == "/IMPVEL/FGEO" || b.header.starts_with("/GJOINT"))
      not_booked(b);
  }

  void not_booked(const Block& b) {
    out_.left_out.push_back(
        {"conditions of " + std::string(b.header) + " (" + deck_.sources.where(b.header_span) + ")",
         "this option is not booked", 1});
  }

  void group(const Block& b, std::int64_t id, std::vector<NodeIndex>& to) const {
    if (const NodeSet* set = group_of(model_, b, id))
      to.insert(to.end(), set->nodes.begin(), set->nodes.end());
  }

  NodeIndex node(const Block& b, std::int64_t id) const { return node_of(model_, b, id); }

  ConditionCard& add(const Block& b, ConditionType type, Turn turn, int rank, const char* kind) {
    ConditionCard& c = out_.cards.emplace_back();
    c.type = type;
    c.turn = turn;
    c.rank = rank;
    c.block = &b;
    c.id = deck_.shifted_id(b, kind, b.id.value);
    c.directions = all_six;
    return c;
  }

  static std::uint8_t flags(const DecodedBlock& d) {
    constexpr const char* names[] = {"Tx", "Ty", "Tz", "OmegaX", "OmegaY", "OmegaZ"};
    unsigned out = 0;
    for (unsigned i = 0; i < 6; ++i)
      if (d.integer(names[i]) == 1) out |= 1u << i;
    return static_cast<std::uint8_t>(out);
  }

  void boundary(const Block& b, bool lagrange) {
    if (lagrange) {
      ConditionCard& c = add(b, ConditionType::lagmul, Turn::before_ties, 7, "bcs");
      c.lagrange = true;
      group(b, integer_at(first_data_line(deck_, b), 30), c.nodes);
      unique(c.nodes);
      return;
    }
    const DecodedBlock d = decode(deck_, b);
    ConditionCard& c = add(b, ConditionType::bcs, Turn::before_ties, 0, "bcs");
    c.directions = flags(d);
    c.system = skew_system(deck_.shifted_id(b, "skew", d.integer("skew_ID")));
    group(b, d.integer("grnod_ID"), c.nodes);
    unique(c.nodes);
  }

  void imposed(const Block& b, int rank) {
    const DecodedBlock d = decode(deck_, b);
    const auto first_of = [&](std::initializer_list<const char*> names) {
      for (const char* n : names)
        if (d.find(n) != nullptr) return d.integer(n);
      return std::int64_t{0};
    };
    ConditionCard& c = add(b, ConditionType::imposed, Turn::before_ties, rank, "impvel");
    const Cell* dir = d.find("Dir");
    if (dir == nullptr) dir = d.find("DIR");
    const std::string_view text = dir == nullptr ? std::string_view() : dir->text;
    if (text.empty()) {
      out_.cards.pop_back();
      return;
    }
    const char axis = static_cast<char>(text[0] & ~0x20);
    const int at = (axis == 'Y' ? 1 : axis == 'Z' ? 2 : 0) + (text.size() > 1 ? 3 : 0);
    c.directions = static_cast<std::uint8_t>(1u << at);
    const std::int64_t frame = first_of({"frame_ID", "Iframe", "Frame"});
    c.system = frame > 0 ? frame_base + deck_.shifted_id(b, "frame", frame)
                         : skew_system(deck_.shifted_id(b, "skew", first_of({"skew_ID", "Iskew"})));
    group(b, first_of({"grnod_ID", "Gnod_id"}), c.nodes);
    unique(c.nodes);
  }

  void link(const Block& b) {
    const DecodedBlock d = decode(deck_, b);
    ConditionCard& c = add(b, ConditionType::rlink, Turn::before_ties, 5, "rlink");
    group(b, d.integer("grnd_ID"), c.nodes);
    unique(c.nodes);
  }

  void rigid_link(const Block& b) {
    std::optional<RigidElement> element = rigid_element(model_, b);
    if (!element) return;
    ConditionCard& c = add(b, ConditionType::rbe2, Turn::before_ties, 6, "rbe2");
    c.directions = element->directions;
    c.system = element->skew > 0 ? skew_system(element->skew) : 0;
    c.main = element->main;
    c.nodes = std::move(element->nodes);
  }

  void weighted_element(const Block& b) {
    const DecodedBlock d = decode(deck_, b);
    ConditionCard& c = add(b, ConditionType::rbe3, Turn::before_ties, 7, "rbe3");
    c.main = node(b, d.integer("node_IDr"));
    if (c.main != no_index) c.nodes.push_back(c.main);
    for (const DecodedCard& card : d.cards)
      for (const Cell& cell : card.cells)
        if (cell.field->name == "grnd_ID") group(b, cell.integer, c.leaders);
    unique(c.leaders);
  }

  void multi_point(const Block& b) {
    ConditionCard& c = add(b, ConditionType::lagmul, Turn::before_ties, 8, "mpc");
    c.lagrange = true;
    LineCursor lines(deck_.sources, b);
    if (b.schema->has_title) lines.next();
    for (Line line = lines.next(); line.valid(); line = lines.next())
      c.nodes.push_back(node(b, integer_at(line, 0)));
    unique(c.nodes);
  }

  void wall(const Block& b, std::string_view keyword) {
    const bool lagrange = keyword == "/RWALL/LAGMUL";
    const DecodedBlock d = decode(deck_, b);
    ConditionCard& c =
        add(b, lagrange ? ConditionType::lagmul : ConditionType::rwall,
            lagrange ? Turn::before_ties : Turn::walls_and_bodies, lagrange ? 9 : 10, "rwall");
    c.lagrange = lagrange;
    if (!lagrange) c.directions = 1;
    c.system = wall_base + static_cast<std::int64_t>(out_.cards.size());
    c.penalty = d.integer("Iform") > 1;
    std::vector<NodeIndex> without;
    if (lagrange) {
      const Line line = first_data_line(deck_, b);
      group(b, integer_at(line, 20), c.nodes);
      group(b, integer_at(line, 30), without);
    } else {
      group(b, d.integer("grnd_ID1"), c.nodes);
      group(b, d.integer("grnd_ID2"), without);
      near_wall(b, d, keyword, c.nodes);
    }
    unique(c.nodes);
    unique(without);
    std::vector<NodeIndex> kept;
    std::set_difference(c.nodes.begin(), c.nodes.end(), without.begin(), without.end(),
                        std::back_inserter(kept));
    c.nodes = std::move(kept);
  }

  /// Nodes within the search distance of a wall.
  void near_wall(const Block& b, const DecodedBlock& d, std::string_view keyword,
                 std::vector<NodeIndex>& to) {
    const auto real = [&](const char* name) { return working_value(deck_, d, name); };
    const double reach = real("d");
    if (!(reach > 0.0)) return;
    const bool sphere = keyword == "/RWALL/SPHER", cylinder = keyword == "/RWALL/CYL";
    if (!sphere && !cylinder && keyword != "/RWALL/PLANE") {
      out_.left_out.push_back({"nodes near " + std::string(b.header),
                               "the search distance of this wall is not evaluated", 1});
      return;
    }
    const Places at{model_.nodes.x.data(), model_.nodes.y.data(), model_.nodes.z.data()};
    Vec m{real("XM"), real("YM"), real("ZM")};
    const NodeIndex moving = node(b, d.integer("node_ID"));
    if (moving != no_index) m = at.at(moving);
    const Vec m1{real("XM1"), real("YM1"), real("ZM1")};
    const double radius = 0.5 * real("Diameter");
    const Vec axis = unit(m1 - m);
    for (NodeIndex n = 0; n < model_.nodes.size(); ++n) {
      if (n == moving) continue;
      const Vec x = at.at(n) - m;
      const double along = dot(x, axis);
      const double distance = sphere     ? norm(x) - radius
                              : cylinder ? norm(x - along * axis) - radius
                                         : along;
      if (distance >= 0.0 && distance <= reach) to.push_back(n);
    }
  }

  void tie(const Block& b) {
    const DecodedBlock d = decode(deck_, b);
    const TiedNodes* found = tie_of(ties_, b);
    const std::int64_t flag = found != nullptr ? found->spotflag : d.integer("Spotflag");
    if (flag == 25 || flag == 26) return;
    const bool late = flag == 27 || flag == 28;
    ConditionCard& c =
        add(b, ConditionType::tied, late ? Turn::late_ties : Turn::ties, 13, "inter");
    c.twice = !late;
    if (found != nullptr) {
      for (const TiedNodes::Row& row : found->rows)
        if (!row.penalty) c.nodes.push_back(row.node);
      unique(c.nodes);
      return;
    }
    group(b, d.integer("grnd_IDs"), c.nodes);
    unique(c.nodes);
    out_.left_out.push_back({"ties of " + std::string(b.header),
                             "which of its nodes it holds is not known: all are booked",
                             c.nodes.size()});
  }

  /// TYPE12 constrains the translations of its secondary nodes.
  void fluid_tie(const Block& b) {
    const DecodedBlock d = decode(deck_, b);
    ConditionCard& c = add(b, ConditionType::tied, Turn::ties, 13, "inter");
    c.directions = 0b000111;
    surface_nodes(b, d.integer("surf_IDs"), c.nodes);
  }

  void surface_nodes(const Block& b, std::int64_t id, std::vector<NodeIndex>& to) const {
    if (model_.selections == nullptr) return;
    if (const auto outline = model_.selections->outline(deck_.shifted_id(b, "surf", id)))
      outline->segments.for_each(
          [&](const Segment& s) { to.insert(to.end(), s.nodes.begin(), s.nodes.end()); });
    unique(to);
  }

  void cylinder(const Block& b) {
    const DecodedBlock d = decode(deck_, b);
    ConditionCard& c = add(b, ConditionType::cyl_joint, Turn::joints, 14, "cyl_joint");
    c.nodes = {node(b, d.integer("node_ID1")), node(b, d.integer("node_ID2"))};
    group(b, d.integer("grnd_ID"), c.nodes);
    unique(c.nodes);
  }

  void bodies() {
    for (RigidBody& body : rigid_bodies(model_)) {
      ConditionCard& c =
          add(*body.block, body.lagrange ? ConditionType::lagmul : ConditionType::rbody,
              Turn::walls_and_bodies, body.lagrange ? 12 : 11, "rbody");
      c.lagrange = body.lagrange;
      c.nodes = std::move(body.nodes);
      c.main = body.main;
      c.sensor = body.sensor != 0;
      if (body.lagrange) {
        c.nodes.push_back(body.main);
        unique(c.nodes);
      } else {
        out_.ikrem = body.ikrem != 0;
      }
    }
  }

  /// Mid-side nodes of tetrahedra that the solver condenses.
  void condensed_nodes() {
    const Elements& f = model_.solid8;
    if (f.extra_nodes.empty()) return;
    const std::vector<PartRow> rows = part_rows(model_);
    for (std::size_t e = 0; e < f.size(); ++e) {
      if (f.shape[e] != SolidShape::tetra10 || f.extra[e] == no_index || f.part[e] == no_index)
        continue;
      if (rows[f.part[e]].property.itetra10 != 2) continue;
      if (out_.condensed.empty()) out_.condensed.assign(model_.nodes.size(), 0);
      for (std::uint32_t i = 0; i < 6; ++i)
        if (const NodeIndex n = f.extra_nodes[f.extra[e] + i]; n != no_index) out_.condensed[n] = 1;
    }
  }

  const Model& model_;
  const Deck& deck_;
  const std::vector<TiedNodes>* ties_;
  ConditionCards out_;
};

}  // namespace

NodeIndex node_of(const Model& model, const Block& block, std::int64_t id) {
  return id > 0 ? model.find_node(model.deck->shifted_id(block, "node", id)) : no_index;
}

const NodeSet* group_of(const Model& model, const Block& block, std::int64_t id) {
  if (id == 0 || model.selections == nullptr) return nullptr;
  return model.selections->node_group(model.deck->shifted_id(block, "grnod", id));
}

const TiedNodes* tie_of(const std::vector<TiedNodes>* ties, const Block& block) {
  if (ties == nullptr) return nullptr;
  const auto is_evaluated = [&](const TiedNodes& t) { return t.block == &block && t.evaluated; };
  const auto it = std::find_if(ties->begin(), ties->end(), is_evaluated);
  return it == ties->end() ? nullptr : &*it;
}

/// Rotates a tensor xx yy zz xy yz zx from the axes of a skew to global axes.
static void turn_inertia(const Model& model, std::int64_t skew, std::array<double, 6>& t) {
  const auto place = [&](NodeIndex n) -> Vec {
    return {model.nodes.x[n], model.nodes.y[n], model.nodes.z[n]};
  };
  const Block* block = nullptr;
  for (const Block& b : model.deck->blocks)
    if (b.schema != nullptr && b.schema->kind == "skew" && skew != 0 &&
        model.deck->shifted_id(b, "skew", b.id.value) == skew)
      block = &b;
  const auto axes = block == nullptr ? std::nullopt : skew_axes(model, *block, place);
  if (!axes) return;
  const auto& [x, y, z] = *axes;
  const Vec to_x = t[0] * x + t[3] * y + t[5] * z, to_y = t[3] * x + t[1] * y + t[4] * z,
            to_z = t[5] * x + t[4] * y + t[2] * z;
  const auto entry = [&](double Vec::*i, double Vec::*j) {
    return x.*i * to_x.*j + y.*i * to_y.*j + z.*i * to_z.*j;
  };
  t = {entry(&Vec::x, &Vec::x), entry(&Vec::y, &Vec::y), entry(&Vec::z, &Vec::z),
       entry(&Vec::x, &Vec::y), entry(&Vec::y, &Vec::z), entry(&Vec::z, &Vec::x)};
}

std::vector<RigidBody> rigid_bodies(const Model& model) {
  std::vector<RigidBody> out;
  const Deck& deck = *model.deck;
  for (const Block* const at : in_solver_order(deck, "/RBODY")) {
    const Block& block = *at;
    if (block.schema == nullptr || block.opaque) continue;
    RigidBody body;
    body.lagrange = block.schema->keyword == "/RBODY/LAGMUL";
    if (!body.lagrange && block.schema->keyword != "/RBODY") continue;
    body.block = &block;
    body.id = block.id.value + deck.offset_of(block, "rbody");
    if (body.lagrange) {
      // Main node and group are in the columns of /RBODY.
      const Line line = first_data_line(deck, block);
      if (!line.valid()) continue;
      body.main = node_of(model, block, integer_at(line, 0));
      add_nodes(model, integer_at(line, 60), body);
      out.push_back(std::move(body));
      continue;
    }
    const DecodedBlock d = decode(deck, block);
    body.main = node_of(model, block, d.integer("node_ID"));
    body.sensor = d.integer("sens_ID");
    body.ikrem = static_cast<int>(d.integer("Ikrem"));
    if (const auto c = static_cast<int>(d.integer("ICoG")); c != 0) body.centre = c;
    body.spherical = d.integer("Ispher") == 1;
    body.mass = working_value(deck, d, "Mass");
    constexpr std::array<std::string_view, 6> names{"Jxx", "Jyy", "Jzz", "Jxy", "Jyz", "Jxz"};
    for (std::size_t i = 0; i < 6; ++i) body.inertia[i] = working_value(deck, d, names[i]);
    turn_inertia(model, deck.shifted_id(block, "skew", d.integer("Skew_ID")), body.inertia);
    add_nodes(model, d.integer("grnd_ID"), body);
    out.push_back(std::move(body));
  }
  return out;
}

/// Reads main node, flags as in /BCS, skew and group (ten columns each).
std::optional<RigidElement> rigid_element(const Model& model, const Block& block) {
  const Deck& deck = *model.deck;
  const Line line = first_data_line(deck, block);
  if (!line.valid()) return std::nullopt;
  RigidElement out;
  out.block = &block;
  constexpr std::size_t columns[] = {13, 14, 15, 17, 18, 19};
  for (unsigned i = 0; i < 6; ++i)
    if (line.text.size() > columns[i] && line.text[columns[i]] == '1')
      out.directions = static_cast<std::uint8_t>(out.directions | 1u << i);
  out.skew = std::max<std::int64_t>(deck.shifted_id(block, "skew", integer_at(line, 20)), 0);
  out.main = node_of(model, block, integer_at(line, 0));
  add_nodes(model, integer_at(line, 30), out);
  return out;
}

std::vector<std::size_t> ConditionCards::order(Turn turn) const {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < cards.size(); ++i)
    if (cards[i].turn == turn) out.push_back(i);
  std::stable_sort(out.begin(), out.end(),
                   [&](std::size_t a, std::size_t b) { return cards[a].rank < cards[b].rank; });
  return out;
}

bool ConditionCards::excluded(ConditionType type, NodeIndex n) const {
  if (condensed.empty() || condensed[n] == 0) return false;
  return type == ConditionType::rbody || type == ConditionType::rbe2 ||
         type == ConditionType::bcs || type == ConditionType::imposed ||
         type == ConditionType::rwall;
}

std::vector<Refusal> ConditionCards::refusals(const Model& model) {
  std::vector<Refusal> out;
  // Per node: the first card with this secondary or main node.
  constexpr std::uint32_t none = no_index;
  const auto table = [&](auto&& visit) {
    std::vector<std::uint32_t> t(model.nodes.size(), none);
    for (std::size_t i = 0; i < cards.size(); ++i)
      visit(cards[i], [&](NodeIndex n) {
        if (n != no_index && t[n] == none) t[n] = static_cast<std::uint32_t>(i);
      });
    return t;
  };
  const bool elements = std::any_of(cards.begin(), cards.end(), [](const ConditionCard& c) {
    return c.type == ConditionType::rbe2 || c.type == ConditionType::rbe3;
  });
  if (!elements) return out;
  const auto secondary_of = [&](ConditionType type) {
    return table([&](const ConditionCard& c, auto&& put) {
      if (c.type == type && !c.lagrange)
        for (const NodeIndex n : c.nodes) put(n);
    });
  };
  const auto rbe2 = secondary_of(ConditionType::rbe2), tied = secondary_of(ConditionType::tied),
             bcs = secondary_of(ConditionType::bcs);
  const auto bodies = table([](const ConditionCard& c, auto&& put) {
    if (c.type == ConditionType::rbody) put(c.main);
  });
  for (std::size_t i = 0; i < cards.size(); ++i) {
    const ConditionCard& c = cards[i];
    const auto self = static_cast<std::uint32_t>(i);
    const auto check = [&](int message, NodeIndex n, std::uint32_t other, bool ends) {
      if (other == none) return false;
      out.push_back({message, n, self, other, ends});
      return true;
    };
    if (c.type == ConditionType::rbe2 && c.main != no_index) {
      check(1036, c.main, tied[c.main], true);
      check(807, c.main, bodies[c.main], true);
    } else if (c.type == ConditionType::rbody && c.main != no_index) {
      check(806, c.main, rbe2[c.main], true);
    } else if (c.type == ConditionType::rbe3 && c.main != no_index) {
      check(3115, c.main, bcs[c.main], false);
      const auto first_of = [&](int message, const std::vector<std::uint32_t>& other) {
        return std::any_of(c.leaders.begin(), c.leaders.end(),
                           [&](NodeIndex n) { return check(message, n, other[n], false); });
      };
      const bool follows = first_of(3100, rbe2), is_tied = first_of(3096, tied);
      if (follows || is_tied) penalty_elements.push_back(i);
    }
  }
  return out;
}

ConditionCards read_condition_cards(const Model& model, const std::vector<TiedNodes>* ties) {
  return Reader(model, ties).run();
}

}  // namespace deck::detail
