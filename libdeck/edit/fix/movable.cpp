// Builds a model with movable nodes, pins the nodes that must stay, updates contacts, reports.
#include "edit/fix/movable.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "deck/keyword.hpp"
#include "deck/model.hpp"
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

/// Pins the nodes that a card names: one node, or one node group.
Result<void> pin_named_nodes(const LoadedDeck& context, const Block& block, PinReason reason,
                             std::string_view node_field, std::string_view group_field,
                             std::vector<std::uint8_t>& pins) {
  const DecodedBlock card = decode(context.deck(), block);
  for (const DecodedCard& line : card.cards)
    if (line.free_format)
      return Error{Error::Code::config, context.deck().sources.where(line.line.whole()) +
                                            ": commas are not understood here; lock parts instead"};
  const Model& model = context.model();
  const auto mark = [&](NodeIndex n) {
    if (n != no_index && pins[n] == 0) pins[n] = static_cast<std::uint8_t>(reason);
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

const char* to_string(PinReason reason) {
  static constexpr const char* words[] = {
      // in the order of PinReason
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
  return words[static_cast<std::size_t>(reason)];
}

Result<std::vector<std::uint8_t>> find_pinned_nodes(const LoadedDeck& context,
                                                    const MoveNodesOptions& options) {
  const Model& model = context.model();
  std::vector<std::uint8_t> pins(model.nodes.size(), 0);
  const auto locked = parts_of(model, options.lock);
  if (!locked) return locked.error();
  const auto wanted = parts_of(model, options.move);
  if (!wanted) return wanted.error();
  const auto pin = [&](NodeIndex n, PinReason why) {
    if (n != no_index && pins[n] == 0) pins[n] = static_cast<std::uint8_t>(why);
  };
  // A node shared with another part would move that part too.
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
        if (lock) pin(n, PinReason::locked_part);
        if (only && !chosen) pin(n, PinReason::not_selected);
        if (chosen) in_wanted[n] = true;
      }
    }
  }
  if (!wanted->empty())
    for (NodeIndex n = 0; n < pins.size(); ++n)
      if (!in_wanted[n]) pin(n, PinReason::not_selected);
  for (const Block& block : context.deck().blocks) {
    Result<void> done;
    if (options.lock_rigid_bodies && block.keyword == "/RBODY")
      done = pin_named_nodes(context, block, PinReason::rigid_body, "node_ID", "grnd_ID", pins);
    else if (options.lock_boundary_conditions && block.keyword == "/BCS")
      done = pin_named_nodes(context, block, PinReason::boundary, "", "grnod_ID", pins);
    if (!done) return done.error();
  }
  return pins;
}

MovableDeck::MovableDeck(const LoadedDeck& context, const MoveNodesOptions& options)
    : context_(context), options_(options), cells_(context) {
  ModelOptions build;
  build.threads = options.threads;
  build.limits = context.options().read.limits;
  Findings unused;
  model_ = build_model(context.deck(), context.schemas(), unused, build);
  interfaces_ = read_interfaces(context.deck(), model_, unused);
  start_ = {model_.nodes.x, model_.nodes.y, model_.nodes.z};
  now_ = start_;
}

const Scene& MovableDeck::evaluate() {
  if (std::exchange(outdated_, false))
    scene_ = fix_scene(model_, interfaces_, context_.options().read.limits, options_, false);
  return scene_;
}

Result<Scene> MovableDeck::prepare() {
  auto pins = find_pinned_nodes(context_, options_);
  if (!pins) return pins.error();
  pinned_ = std::move(*pins);
  Scene before = evaluate();
  if (auto why = unevaluated(before, options_)) return *why;
  mesh_.emplace(before);
  crossings_ = mesh_->all_crossings(now_, options_.threads);
  crossed_ = find_crossings(before, options_.threads);
  baseline_ = StateBefore(before, options_);
  fix_.crossings_before = crossed_.size();
  fix_.tied_pairs = baseline_.tied_pairs();
  fix_.tied_nodes = baseline_.tied_nodes();
  return before;
}

void MovableDeck::place(NodeIndex n, const Vec& p) {
  outdated_ = true;
  now_.x[n] = model_.nodes.x[n] = p.x;
  now_.y[n] = model_.nodes.y[n] = p.y;
  now_.z[n] = model_.nodes.z[n] = p.z;
}

bool MovableDeck::put(NodeIndex n, const Vec& to) {
  const double wanted[3] = {to.x, to.y, to.z};
  double printed[3] = {start_.x[n], start_.y[n], start_.z[n]};
  bool written = false;
  for (int axis = 0; axis < 3; ++axis) {
    if (wanted[axis] == printed[axis]) continue;
    const auto text = cells_.print(n, axis, wanted[axis]);
    if (!text) return false;
    if (text->value == printed[axis]) continue;
    printed[axis] = text->value;
    texts_[{n, axis}] = text->text;
    written = true;
  }
  place(n, {printed[0], printed[1], printed[2]});
  return written;
}

void MovableDeck::put_back(NodeIndex n) {
  place(n, at(start_, n));
  for (int axis = 0; axis < 3; ++axis) texts_.erase({n, axis});
}

Result<PenetrationFix> MovableDeck::make_result(const Scene& before,
                                                const std::vector<NodeIndex>& moved,
                                                const ReasonOf& reason_of) {
  fix_.rewrite.edits = cells_.edits(texts_);
  const auto again = AfterRewrite::read(context_, fix_.rewrite, options_, false, before);
  if (!again) return again.error();
  if (const auto why = harm_text(model_, again->scene(), baseline_.harm(again->scene())))
    return Error{Error::Code::internal, "the deck read again differs: " + *why};
  report(before, again->scene(), moved, reason_of);
  note_unevaluated(fix_, again->scene(), options_);
  fix_.complete = fix_.refused.empty();
  return std::move(fix_);
}

void MovableDeck::report(const Scene& before, const Scene& after,
                         const std::vector<NodeIndex>& moved, const ReasonOf& reason_of) {
  fix_.crossings_after = find_crossings(after, options_.threads).size();
  set_interfaces(fix_, context_.interfaces(), options_, before, after);
  for (const NodeIndex n : moved) {
    const Vec u = at(now_, n) - at(start_, n);
    const std::uint32_t part = mesh_->part_of(n);
    fix_.moved.push_back({model_.node_id(n),
                          part == no_index ? 0 : model_.parts[part].id,
                          {u.x, u.y, u.z},
                          norm(u)});
  }
  std::sort(fix_.moved.begin(), fix_.moved.end(),
            [](const MovedNode& a, const MovedNode& b) { return a.id < b.id; });
  // Every strategy names the depth in the deck as read.
  std::map<std::pair<std::int64_t, std::vector<std::int64_t>>, double> depth;
  for (const Contact& contact : before.contacts)
    for (const auto& [secondary, row] : deepest_rows(contact)) {
      double& deepest = depth[{contact.inter->id, node_ids(*before.model, contact, *row, false)}];
      deepest = std::max(deepest, row->depth);
    }
  for (std::uint32_t c = 0; c < after.contacts.size(); ++c) {
    const Contact& contact = after.contacts[c];
    if (!is_wanted(options_, contact)) continue;
    for (const auto& [secondary, row] : deepest_rows(contact)) {
      std::vector<std::int64_t> ids = node_ids(*after.model, contact, *row, false);
      const auto was = depth.find({contact.inter->id, ids});
      auto [reason, next] = reason_of(after, {c, row->secondary, row->main});
      fix_.refused.push_back({contact.inter->id, std::move(ids),
                              was != depth.end() ? was->second : row->depth, std::move(reason), 0,
                              std::move(next)});
    }
  }
  std::stable_sort(
      fix_.refused.begin(), fix_.refused.end(), [](const FixRefusal& a, const FixRefusal& b) {
        return std::tuple(a.interface_id, -a.depth) < std::tuple(b.interface_id, -b.depth);
      });
}

}  // namespace deck::detail
