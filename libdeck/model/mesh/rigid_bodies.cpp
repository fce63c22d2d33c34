// Reads /RBODY and /RBE2: main node, secondary nodes, added mass and inertia.
#include "model/mesh/rigid_bodies.hpp"

#include <algorithm>
#include <string_view>

#include "deck/keyword/decode.hpp"
#include "deck/model/selection.hpp"
#include "deck/text/number.hpp"
#include "keyword/shared/solver_order.hpp"

namespace deck::detail {
namespace {

double body_value(const Deck& deck, const DecodedBlock& d, std::string_view name) {
  const Cell* c = d.find(name);
  return c == nullptr ? 0.0 : working_value(deck, d, *c);
}

template <class Body>
void take_nodes(const Model& model, std::int64_t group, Body& body) {
  if (group == 0 || model.selections == nullptr) return;
  const NodeSet* set =
      model.selections->node_group(group + model.deck->offset_of(*body.block, "grnod"));
  if (set == nullptr) return;
  for (const NodeIndex n : set->nodes)
    if (n != no_index && n != body.main) body.nodes.push_back(n);
  std::sort(body.nodes.begin(), body.nodes.end());
  body.nodes.erase(std::unique(body.nodes.begin(), body.nodes.end()), body.nodes.end());
}

}  // namespace

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
      // Main node and group stand where /RBODY has them.
      LineCursor lines(deck.sources, block);
      if (block.schema->has_title) lines.next();
      const Line line = lines.next();
      if (!line.valid()) continue;
      const IntegerCell main = read_integer(line.text.substr(0, 10));
      if (main.value > 0) body.main = model.find_node(main.value + deck.offset_of(block, "node"));
      if (line.text.size() > 60)
        take_nodes(model, read_integer(line.text.substr(60, 10)).value, body);
      out.push_back(std::move(body));
      continue;
    }
    const DecodedBlock d = decode(deck, block);
    const std::int64_t main = d.integer("node_ID");
    if (main > 0) body.main = model.find_node(main + deck.offset_of(block, "node"));
    body.sensor = d.integer("sens_ID");
    body.ikrem = static_cast<int>(d.integer("Ikrem"));
    if (const auto c = static_cast<int>(d.integer("ICoG")); c != 0) body.centre = c;
    body.spherical = d.integer("Ispher") == 1;
    body.mass = body_value(deck, d, "Mass");
    constexpr std::array<std::string_view, 6> names{"Jxx", "Jyy", "Jzz", "Jxy", "Jyz", "Jxz"};
    for (std::size_t i = 0; i < 6; ++i) body.inertia[i] = body_value(deck, d, names[i]);
    take_nodes(model, d.integer("grnd_ID"), body);
    out.push_back(std::move(body));
  }
  return out;
}

/// Main node, flags like those of /BCS, skew and group in fields of ten columns.
std::optional<RigidElement> rigid_element(const Model& model, const Block& block) {
  const Deck& deck = *model.deck;
  LineCursor lines(deck.sources, block);
  if (block.schema->has_title) lines.next();
  const Line line = lines.next();
  if (!line.valid()) return std::nullopt;
  const auto cell = [&](std::size_t first) -> std::int64_t {
    return line.text.size() > first ? read_integer(line.text.substr(first, 10)).value : 0;
  };
  RigidElement out;
  out.block = &block;
  constexpr std::size_t columns[] = {13, 14, 15, 17, 18, 19};
  for (unsigned i = 0; i < 6; ++i)
    if (line.text.size() > columns[i] && line.text[columns[i]] == '1')
      out.directions = static_cast<std::uint8_t>(out.directions | 1u << i);
  if (const std::int64_t skew = cell(20); skew > 0) out.skew = skew + deck.offset_of(block, "skew");
  if (const std::int64_t main = cell(0); main > 0)
    out.main = model.find_node(main + deck.offset_of(block, "node"));
  take_nodes(model, cell(30), out);
  return out;
}

}  // namespace deck::detail
