// Builds the model whose nodes a strategy moves, keeps its contacts up to date, and tells what
// became of it.
#include "edit/fix/movable.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>

#include "contact/shared/scene_parts.hpp"
#include "contact/shared/tie_parts.hpp"
#include "edit/fix/nodes/depenetrate_locks.hpp"

namespace deck::detail {
namespace {

/// Calls f(node) for all nodes of an item.
template <class F>
void each_node(const SecondaryNode& s, const F& f) {
  f(s.node);
}
template <class Item, class F>
void each_node(const Item& item, const F& f) {
  for (const NodeIndex n : item.nodes) f(n);
}
double& takes_part(SecondaryNode& s) { return s.multiplier; }
double& takes_part(MainSegment& m) { return m.stiffness; }
double& takes_part(ContactEdge& e) { return e.stiffness; }

template <class Item>
std::vector<bool> with_nodes(const std::vector<Item>& items, const std::vector<bool>& nodes) {
  std::vector<bool> out(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    bool any = false;
    each_node(items[i], [&](NodeIndex n) { any |= nodes[n]; });
    out[i] = any;
  }
  return out;
}

/// Items that are not of this kind take no part in searches.
template <class Item>
void leave_out(std::vector<Item>& items, const std::vector<bool>& moved, bool kind) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (moved[i] != kind) takes_part(items[i]) = 0;
}

bool before(const PenetrationRow& a, const PenetrationRow& b) {
  return std::tie(a.secondary, a.main) < std::tie(b.secondary, b.main);
}

/// Rows of a contact of which some items moved: those of other pairs stay, the others are found by
/// one search of what moved on the secondary side and one of what moved on the main side alone.
/// `find` is the search. False: there are too many pairs.
template <class S, class M, class Find>
bool find_moved(Contact& contact, std::vector<S> Contact::*secondary, std::vector<M> Contact::*main,
                const std::vector<bool>& s_moved, const std::vector<bool>& m_moved,
                const Find& find) {
  std::vector<PenetrationRow> rows = std::move(contact.penetrations);
  contact.penetrations.clear();
  std::erase_if(rows,
                [&](const PenetrationRow& r) { return s_moved[r.secondary] || m_moved[r.main]; });
  const auto search = [&](bool of_secondary) {
    Contact part = contact;
    leave_out(part.*secondary, s_moved, of_secondary);
    if (!of_secondary) leave_out(part.*main, m_moved, true);
    find(part);
    const auto known = static_cast<std::ptrdiff_t>(rows.size());
    rows.insert(rows.end(), part.penetrations.begin(), part.penetrations.end());
    std::inplace_merge(rows.begin(), rows.begin() + known, rows.end(), before);
    return part.evaluated;
  };
  if (!search(true) || !search(false)) return false;
  contact.penetrations = std::move(rows);
  return true;
}

}  // namespace

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
  of_solids_.assign(model_.nodes.size(), false);
  for (std::uint32_t e = 0; e < model_.solid8.size(); ++e)
    for (int k = 0; k < model_.solid8.width; ++k)
      if (const NodeIndex n = model_.solid8.of(e)[k]; n != no_index) of_solids_[n] = true;
}

/// Segments, edges, gaps, and whether an item takes part do not depend on where nodes are, nor does
/// which pairs are left out. Solids turn segments and have a volume; a mesh limits gaps.
bool MovableDeck::keeps_its_sides(const Contact& c) const {
  if (is_modern(c.type) || !c.evaluated || c.igap == 3 || c.irem_gap == 2 || c.inacti != 0 ||
      c.fpenmax != 0 || c.drad != 0 || c.gapmin_origin != GapminOrigin::card)
    return false;
  const auto of_solid = [&](const auto& item) {
    bool any = false;
    each_node(item, [&](NodeIndex n) { any |= of_solids_[n]; });
    return any;
  };
  return std::none_of(c.main.begin(), c.main.end(), of_solid) &&
         std::none_of(c.main_edges.begin(), c.main_edges.end(), of_solid) &&
         std::none_of(c.secondary_edges.begin(), c.secondary_edges.end(), of_solid);
}

const Scene& MovableDeck::evaluate() {
  const Coordinates& was = scene_.coordinates;
  if (scene_.model == nullptr) {
    scene_ = fix_scene(model_, interfaces_, context_.options().read.limits, options_, false);
    return scene_;
  }
  std::vector<bool> moved(was.x.size());
  bool any = false;
  for (std::size_t n = 0; n < moved.size(); ++n) {
    moved[n] = was.x[n] != model_.nodes.x[n] || was.y[n] != model_.nodes.y[n] ||
               was.z[n] != model_.nodes.z[n];
    any |= moved[n];
  }
  if (!any) return scene_;
  ties_outdated_ = true;
  scene_.coordinates = {model_.nodes.x, model_.nodes.y, model_.nodes.z};
  std::vector<bool> again(scene_.contacts.size());
  for (std::size_t c = 0; c < again.size(); ++c) {
    again[c] = !keeps_its_sides(scene_.contacts[c]);
    if (!again[c]) search_again(scene_.contacts[c], moved);
  }
  build_again(again);
  return scene_;
}

const Scene& MovableDeck::evaluate_with_ties() {
  evaluate();
  if (std::exchange(ties_outdated_, false) && !interfaces_.type2.empty()) {
    SceneOptions options;
    options.threads = options_.threads;
    options.limits = context_.options().read.limits;
    options.ties = true;
    scene_.ties = ties_of(scene_, options);
  }
  return scene_;
}

/// The contacts of some interfaces are built as fix_scene builds them, and take their places.
void MovableDeck::build_again(const std::vector<bool>& which) {
  std::vector<std::int64_t> ids;
  for (std::size_t c = 0; c < which.size(); ++c)
    if (which[c]) ids.push_back(scene_.contacts[c].inter->id);
  if (ids.empty()) return;
  Scene fresh =
      fix_scene(model_, interfaces_, context_.options().read.limits, options_, false, {}, ids);
  auto next = fresh.contacts.begin();
  for (Contact& contact : scene_.contacts)
    if (next != fresh.contacts.end() && next->inter == contact.inter) contact = std::move(*next++);
}

void MovableDeck::search_again(Contact& contact, const std::vector<bool>& moved) {
  constexpr std::size_t worth_it = 4;  // two searches of a part against one of all
  SceneOptions options;
  options.threads = options_.threads;
  options.limits = context_.options().read.limits;
  options.candidates = false;
  Diagnostics unused;
  Connectivity none(model_);
  SceneContext context{model_, none, scene_, unused, options};
  const auto find = [&](Contact& c) {
    DecisionReport decisions;
    c.kind == ContactKind::edge_edge ? find_edge_penetrations(context, c, decisions)
                                     : find_penetrations(context, c, decisions);
  };
  const auto look = [&](auto secondary, auto main) {
    const auto s = with_nodes(contact.*secondary, moved), m = with_nodes(contact.*main, moved);
    const auto count = [](const std::vector<bool>& of) {
      return static_cast<std::size_t>(std::count(of.begin(), of.end(), true));
    };
    const std::size_t some = count(s) + count(m);
    if (some == 0) return;
    if (some * worth_it < s.size() + m.size() && find_moved(contact, secondary, main, s, m, find))
      return;
    contact.penetrations.clear();
    find(contact);
  };
  contact.kind == ContactKind::edge_edge ? look(&Contact::secondary_edges, &Contact::main_edges)
                                         : look(&Contact::secondary, &Contact::main);
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
