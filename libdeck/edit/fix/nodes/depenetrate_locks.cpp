// Reads boundary conditions, rigid bodies and options for the nodes that have to stay.
#include "edit/fix/nodes/depenetrate_locks.hpp"

#include <fmt/format.h>

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

std::int64_t integer_at(std::string_view text, std::size_t first, std::size_t last) {
  if (text.size() < first) return 0;
  return read_integer(text.substr(first - 1, last - first + 1)).value;
}

/// Holds the nodes that a card names: one node id and one node group, in columns of its first line.
Result<void> hold_named(const LoadedDeck& context, const Block& block, Hold hold,
                        std::size_t node_column, std::size_t group_column,
                        std::vector<std::uint8_t>& holds) {
  LineCursor cursor(context.deck().sources, block);
  cursor.next();  // the title
  const Line line = cursor.next();
  if (!line.valid()) return {};
  if (line.text.find(',') != std::string_view::npos ||
      line.text.find('&') != std::string_view::npos)
    return Error{Error::Code::config,
                 context.deck().sources.where(line.whole()) +
                     ": commas and parameters are not understood here; lock parts instead"};
  const Model& model = context.model();
  const auto mark = [&](NodeIndex n) {
    if (n != no_index && holds[n] == 0) holds[n] = static_cast<std::uint8_t>(hold);
  };
  if (node_column > 0)
    if (const std::int64_t id = integer_at(line.text, node_column, node_column + 9); id != 0)
      mark(model.find_node(id + context.deck().offset_of(block, "node")));
  if (const std::int64_t id = integer_at(line.text, group_column, group_column + 9); id != 0)
    if (const NodeSet* group =
            model.selections->node_group(id + context.deck().offset_of(block, "grnod")))
      for (const NodeIndex n : group->nodes) mark(n);
  return {};
}

}  // namespace

const char* to_string(Hold hold) {
  switch (hold) {
    case Hold::none:
      return "free";
    case Hold::locked_part:
      return "locked part";
    case Hold::not_selected:
      return "not of the parts that may move";
    case Hold::rigid_body:
      return "node of a rigid body";
    case Hold::boundary:
      return "node of a boundary condition";
    case Hold::not_writable:
      return "coordinates cannot be changed";
    case Hold::share:
      return "stopped by --max-moved";
    case Hold::displacement:
      return "moved as far as it may (--max-displacement)";
    case Hold::crossed:
      return "belongs to crossed elements: no side is the right one; separate them first";
    case Hold::would_cross:
      return "moving it would cross elements";
    case Hold::would_invert:
      return "moving it would turn an element inside out";
    case Hold::would_shrink:
      return "moving it would make an element side less than half as long";
    case Hold::would_penetrate:
      return "moving it would make or deepen another penetration";
    case Hold::would_untie:
      return "moving it would change what is tied";
    case Hold::depth:
      return "moving it as far as the penetration is deep does not free it (--clearance adds to "
             "that)";
    case Hold::bystander:
      return "not in a penetration";
  }
  return "";
}

std::string percent_text(double share) { return fmt::format("{:.3g} %", 100 * share); }

std::string stopped_by_share(const MoveNodesOptions& options) {
  return to_string(Hold::share) + (" " + percent_text(options.most_moved));
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
    // The columns of the first card line: /RBODY node_ID 1-10, grnd_ID 61-70; /BCS grnod_ID 21-30.
    if (options.lock_rigid_bodies && block.keyword == "/RBODY")
      done = hold_named(context, block, Hold::rigid_body, 1, 61, holds);
    else if (options.lock_boundary_conditions && block.keyword == "/BCS")
      done = hold_named(context, block, Hold::boundary, 0, 21, holds);
    if (!done) return done.error();
  }
  return holds;
}

}  // namespace deck::detail
