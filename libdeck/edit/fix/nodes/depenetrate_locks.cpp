// Reads boundary conditions, rigid bodies and options for the nodes that have to stay.
#include "edit/fix/nodes/depenetrate_locks.hpp"

#include <algorithm>
#include <set>

#include "deck/keyword/decode.hpp"
#include "deck/model/selection.hpp"
#include "model/shared/families.hpp"

namespace deck::detail {
namespace {

Result<std::set<std::uint32_t>> parts_of(const Model& model, const std::vector<std::int64_t>& ids) {
  std::set<std::uint32_t> out;
  for (const std::int64_t id : ids) {
    const auto it = model.part_of_id.find(id);
    if (it == model.part_of_id.end())
      return Error{Error::Code::config, "the deck has no part " + std::to_string(id)};
    out.insert(it->second);
  }
  return out;
}

/// Holds the nodes that a card names: one node, and one node group.
Result<void> hold_named(const LoadedDeck& context, const Block& block, Hold hold,
                        std::string_view node_field, std::string_view group_field,
                        std::vector<std::uint8_t>& holds) {
  const DecodedBlock card = decode(context.deck(), block);
  for (const DecodedCard& line : card.cards)
    if (line.free_format)
      return Error{Error::Code::config, context.deck().sources.where(line.line.whole()) +
                                            ": commas are not understood here; lock parts instead"};
  const Model& model = context.model();
  const auto mark = [&](NodeIndex n) {
    if (n != no_index && holds[n] == 0) holds[n] = static_cast<std::uint8_t>(hold);
  };
  if (const std::int64_t id = card.integer(node_field); id != 0)
    mark(model.find_node(id + context.deck().offset_of(block, "node")));
  if (const std::int64_t id = card.integer(group_field); id != 0)
    if (const NodeSet* group =
            model.selections->node_group(id + context.deck().offset_of(block, "grnod")))
      for (const NodeIndex n : group->nodes) mark(n);
  return {};
}

}  // namespace

const char* to_string(Hold hold) {
  static constexpr const char* words[] = {
      // in the order of Hold
      "free",
      "locked part",
      "not of the parts that may move",
      "node of a rigid body",
      "node of a boundary condition",
      "coordinates cannot be changed",
      "stopped by --max-moved",
      "moved as far as it may (--max-displacement)",
      "belongs to crossed elements: no side is the right one; separate them first",
      "moving it would cross elements",
      "moving it would turn an element inside out",
      "moving it would make an element side less than half as long",
      "moving it would make or deepen another penetration",
      "moving it would change what is tied",
      "moving it as far as the penetration is deep does not free it (--clearance adds to that)",
      "not in a penetration"};
  return words[static_cast<std::size_t>(hold)];
}

Result<std::vector<std::uint8_t>> make_holds(const LoadedDeck& context,
                                             const MoveNodesOptions& options) {
  const Model& model = context.model();
  std::vector<std::uint8_t> holds(model.nodes.size(), 0);
  const auto locked = parts_of(model, options.lock);
  if (!locked) return locked.error();
  const auto wanted = parts_of(model, options.move);
  if (!wanted) return wanted.error();
  const auto hold = [&](NodeIndex n, Hold why) {
    if (n != no_index && holds[n] == 0) holds[n] = static_cast<std::uint8_t>(why);
  };
  // A node that a part shares with another one would move that part too.
  std::vector<bool> in_wanted(model.nodes.size(), false);
  for (const ElementKind kind : all_families) {
    const Elements& family = model.family(kind);
    for (std::size_t e = 0; e < family.size(); ++e) {
      const bool lock = locked->contains(family.part[e]);
      const bool only = !wanted->empty();
      const bool chosen = wanted->contains(family.part[e]);
      if (!lock && !only) continue;
      for (int k = 0; k < family.width; ++k) {
        const NodeIndex n = family.of(e)[k];
        if (n == no_index) continue;
        if (lock) hold(n, Hold::locked_part);
        if (only && !chosen) hold(n, Hold::not_selected);
        if (chosen) in_wanted[n] = true;
      }
    }
  }
  if (!wanted->empty())
    for (NodeIndex n = 0; n < holds.size(); ++n)
      if (!in_wanted[n]) hold(n, Hold::not_selected);
  for (const Block& block : context.deck().blocks) {
    Result<void> done;
    if (options.lock_rigid_bodies && block.keyword == "/RBODY")
      done = hold_named(context, block, Hold::rigid_body, "node_ID", "grnd_ID", holds);
    else if (options.lock_boundary_conditions && block.keyword == "/BCS")
      done = hold_named(context, block, Hold::boundary, "", "grnod_ID", holds);
    if (!done) return done.error();
  }
  return holds;
}

}  // namespace deck::detail
