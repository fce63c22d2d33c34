// Builds the model whose nodes a strategy moves, keeps its contacts up to date, and tells what
// became of it.
#include "edit/fix/movable.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "edit/fix/nodes/depenetrate_locks.hpp"

namespace deck::detail {
MovableDeck::MovableDeck(const LoadedDeck& context, const MoveNodesOptions& options)
    : context_(context), options_(options), cells_(context) {
  ModelOptions build;
  build.threads = options.threads;
  build.limits = context.options().read.limits;
  Diagnostics unused;
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
  auto holds = make_holds(context_, options_);
  if (!holds) return holds.error();
  holds_ = std::move(*holds);
  Scene before = evaluate();
  if (auto why = unevaluated(before, options_)) return *why;
  mesh_.emplace(before);
  crossings_ = mesh_->all_crossings(now_, options_.threads);
  crossed_ = find_crossings(before, options_.threads);
  baseline_ = Baseline(before, options_);
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

void MovableDeck::report(const Scene& before, const Scene& after,
                         const std::vector<NodeIndex>& moved,
                         const std::function<Reason(const Scene&, const PairAt&)>& reason_of) {
  fix_.crossings_after = find_crossings(after, options_.threads).size();
  set_interfaces(fix_, context_.interfaces(), options_, before, after);
  fix_.moved = moved_list(model_, *mesh_, moved, start_, now_);
  // Every strategy names the depth that a node has in the deck as it was read.
  std::map<std::pair<std::int64_t, std::vector<std::int64_t>>, double> depth;
  for (const Contact& contact : before.contacts)
    for (const auto& [secondary, row] : deepest_rows(contact)) {
      double& deepest = depth[{contact.inter->id, secondary_ids(*before.model, contact, *row)}];
      deepest = std::max(deepest, row->depth);
    }
  for (std::uint32_t c = 0; c < after.contacts.size(); ++c) {
    const Contact& contact = after.contacts[c];
    if (!is_wanted(options_, contact)) continue;
    for (const auto& [secondary, row] : deepest_rows(contact)) {
      std::vector<std::int64_t> ids = secondary_ids(*after.model, contact, *row);
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
