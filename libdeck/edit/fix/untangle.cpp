// Crossed elements that one node's move takes apart: the node that sticks through the other side
// goes back to its own side, or into line with its neighbours. Everything else stays as it is.
#include <algorithm>
#include <cmath>

#include "deck/contact/crossings.hpp"
#include "deck/edit/depenetrate.hpp"
#include "edit/fix/common.hpp"
#include "edit/fix/depenetrate_cells.hpp"
#include "edit/fix/depenetrate_locks.hpp"
#include "edit/fix/depenetrate_mesh.hpp"
#include "edit/fix/depenetrate_rows.hpp"
#include "edit/fix/harm.hpp"
#include "edit/fix/movable.hpp"

namespace deck {
namespace {

using namespace detail;

constexpr double least_side = 0.5;  // of the length of an element's side before
constexpr std::size_t passes = 4;   // a node out of the way may free the next one

using MeshCrossings = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// A place for a node that may take a crossing apart.
struct Trial {
  NodeIndex node = no_index;
  Vec target;
  double distance = 0;
};

class Untangler : MovableDeck {
 public:
  Untangler(const EditContext& context, const MoveNodesOptions& options)
      : MovableDeck(context, options) {}

  Result<PenetrationFix> run() {
    auto holds = make_holds(context_, options_);
    if (!holds) return holds.error();
    holds_ = std::move(*holds);
    const Scene before = evaluate();
    if (auto why = unevaluated(before, options_)) return *why;
    mesh_.emplace(before);
    moved_in_part_.assign(model_.parts.size(), 0);
    baseline_ = Baseline(before, options_);
    fix_.tied_pairs = baseline_.tied_pairs();
    fix_.tied_nodes = baseline_.tied_nodes();
    fix_.strategy = "untangle";
    std::vector<Crossing> left = wanted(before);
    fix_.crossings_before = left.size();
    for (std::size_t pass = 0; pass < passes && !left.empty(); ++pass) {
      const std::size_t was = moved_.size();
      const Scene scene = evaluate();
      for (const Crossing& c : left) take_apart(scene, c);
      left = wanted(evaluate());
      if (moved_.size() == was) break;
      ++fix_.iterations;
    }
    return finish(before);
  }

 private:
  std::vector<Crossing> wanted(const Scene& scene) const {
    std::vector<Crossing> out;
    for (const Crossing& c : find_crossings(scene, options_.threads))
      if (is_wanted(options_, scene.contacts[c.contact])) out.push_back(c);
    return out;
  }

  void place(NodeIndex n, Vec p) {
    for (auto [model, own, value] : {std::tuple{&model_.nodes.x, &now_.x, p.x},
                                     {&model_.nodes.y, &now_.y, p.y},
                                     {&model_.nodes.z, &now_.z, p.z}})
      (*model)[n] = (*own)[n] = value;
  }

  /// Tries to free one crossing; true if it is gone, by this or an earlier move.
  bool take_apart(const Scene& scene, const Crossing& c) {
    for (const Trial& t : trials(scene, c))
      if (try_move(t)) return true;
    return false;
  }

  /// The shortest ones first: each end of the edge to the other end's side, as far as the gap, and
  /// every node of both in line with its neighbours.
  std::vector<Trial> trials(const Scene& scene, const Crossing& c) const {
    const Contact& contact = scene.contacts[c.contact];
    std::array<NodeIndex, 4> corners = contact.main[c.main].nodes;
    const Vec a = at(now_, corners[0]), b = at(now_, corners[1]), d = at(now_, corners[2]);
    const Vec e = corners[3] == no_index ? d : at(now_, corners[3]);
    Vec normal = cross(d - a, e - b);
    if (corners[3] == no_index || corners[3] == corners[2]) normal = cross(b - a, d - a);
    std::vector<Trial> out;
    const auto add = [&](NodeIndex n, Vec target) {
      out.push_back({n, target, norm(target - at(now_, n))});
    };
    if (const double l = norm(normal); l > 0) {
      normal = (1 / l) * normal;
      for (int end = 0; end < 2; ++end) {
        const NodeIndex n = c.edge[static_cast<std::size_t>(end)];
        const NodeIndex other = c.edge[static_cast<std::size_t>(1 - end)];
        const double mine = dot(at(now_, n) - a, normal), theirs = dot(at(now_, other) - a, normal);
        const double gap = (1 + options_.clearance) * gap_of(scene, c, n);
        add(n, at(now_, n) + (std::copysign(gap, theirs) - mine) * normal);
      }
    }
    std::vector<NodeIndex> nodes(c.edge.begin(), c.edge.end());
    nodes.insert(nodes.end(), corners.begin(), corners.end());
    for (const NodeIndex n : nodes) {
      if (n == no_index) continue;
      Vec sum{};
      double count = 0;
      for (const NodeIndex next : mesh_->neighbours(n)) {
        sum = sum + at(now_, next);
        ++count;
      }
      if (count > 1) add(n, (1 / count) * sum);
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const Trial& x, const Trial& y) { return x.distance < y.distance; });
    return out;
  }

  /// The gap between a node of the edge and the segment.
  double gap_of(const Scene& scene, const Crossing& c, NodeIndex n) const {
    const auto& side = scene.contacts[c.contact].secondary;
    for (std::uint32_t s = 0; s < side.size(); ++s)
      if (side[s].node == n) return state_of(scene, now_, {c.contact, s, c.main}).gap;
    return 0;
  }

  /// Moves the node if that takes crossings away and harms nothing.
  bool try_move(const Trial& t) {
    const NodeIndex n = t.node;
    if (holds_[n] != 0) return false;
    if (options_.most_displacement && norm(t.target - at(start_, n)) > *options_.most_displacement)
      return refuse(n, Hold::displacement);
    const NodeIndex one[] = {n};
    cells_.look_up(one);
    if (!cells_.obstacle(n).empty()) return refuse(n, Hold::not_writable);
    const std::uint32_t part = mesh_->part_of(n);
    const bool is_new = !moved_.contains(n);
    if (is_new && part != no_index &&
        moved_in_part_[part] + 1 >
            std::max(1.0,
                     std::floor(options_.most_moved * mesh_->nodes_of_part(part) * (1 + 1e-12))))
      return refuse(n, Hold::share);
    const MeshCrossings were = mesh_->crossings(now_, one, options_.threads);
    const Vec from = at(now_, n);
    std::map<int, std::string> texts;
    const double to[3] = {t.target.x, t.target.y, t.target.z};
    double printed[3] = {start_.x[n], start_.y[n], start_.z[n]};
    for (int axis = 0; axis < 3; ++axis) {
      const auto text = cells_.print(n, axis, to[axis]);
      if (!text || text->value == printed[axis]) continue;
      printed[axis] = text->value;
      texts[axis] = text->text;
    }
    place(n, {printed[0], printed[1], printed[2]});
    const Hold harm = harm_of(n, were);
    if (harm != Hold::none) {
      place(n, from);
      return harm != Hold::crossed && refuse(n, harm);
    }
    for (int axis = 0; axis < 3; ++axis) texts_.erase({n, axis});
    for (auto& [axis, text] : texts) texts_[{n, axis}] = std::move(text);
    moved_.insert(n);
    if (is_new && part != no_index) ++moved_in_part_[part];
    baseline_ = Baseline(evaluate(), options_);
    return true;
  }

  bool refuse(NodeIndex n, Hold why) {
    refused_[n] = why;
    return false;
  }

  /// What speaks against the place where a node is now. `were`: crossings of its elements before.
  Hold harm_of(NodeIndex n, const MeshCrossings& were) const {
    const NodeIndex one[] = {n};
    const MeshCrossings are = mesh_->crossings(now_, one, options_.threads);
    if (!std::includes(were.begin(), were.end(), are.begin(), are.end())) return Hold::would_cross;
    if (are.size() >= were.size()) return Hold::crossed;
    if (!mesh_->inverted(start_, now_, one).empty()) return Hold::would_invert;
    for (const NodeIndex next : mesh_->neighbours(n))
      if (distance(now_, n, next) < least_side * distance(start_, n, next))
        return Hold::would_shrink;
    const std::vector<Harm> harm = baseline_.harm(evaluate());
    if (harm.empty()) return Hold::none;
    return harm.front().tie ? Hold::would_untie : Hold::would_penetrate;
  }

  Result<PenetrationFix> finish(const Scene& before) {
    fix_.rewrite.edits = cells_.edits(texts_);
    auto again = read_again(context_, fix_.rewrite);
    if (!again) return again.error();
    const Scene after = fix_scene(again->model(), again->interfaces(), options_, false);
    if (const auto why = harm_text(model_, after, baseline_.harm(after)))
      return Error{Error::Code::internal, "the deck read again differs: " + *why};
    const std::vector<Crossing> left = wanted(after);
    fix_.crossings_after = left.size();
    set_interfaces(fix_, context_.interfaces, options_, before, after);
    for (const NodeIndex n : moved_) {
      const Vec from = at(start_, n), to = at(now_, n), by = to - from;
      MovedNode m;
      m.id = model_.node_id(n);
      if (const std::uint32_t part = mesh_->part_of(n); part != no_index)
        m.part = model_.parts[part].id;
      m.by = {by.x, by.y, by.z};
      m.distance = norm(by);
      m.from = {from.x, from.y, from.z};
      m.to = {to.x, to.y, to.z};
      fix_.moved.push_back(m);
    }
    std::sort(fix_.moved.begin(), fix_.moved.end(),
              [](const MovedNode& a, const MovedNode& b) { return a.id < b.id; });
    for (const Crossing& c : left) {
      FixRefusal r;
      r.interface_id = after.contacts[c.contact].inter->id;
      for (const NodeIndex n : c.edge) r.nodes.push_back(model_.node_id(n));
      r.reason = reason_of(after.contacts[c.contact].main[c.main], c);
      fix_.refused.push_back(std::move(r));
    }
    std::stable_sort(fix_.refused.begin(), fix_.refused.end(),
                     [](const FixRefusal& a, const FixRefusal& b) {
                       return std::tie(a.interface_id, a.nodes) < std::tie(b.interface_id, b.nodes);
                     });
    fix_.complete = left.empty();
    return std::move(fix_);
  }

  /// Why an edge still passes through a segment.
  std::string reason_of(const MainSegment& segment, const Crossing& c) const {
    std::vector<NodeIndex> nodes(c.edge.begin(), c.edge.end());
    nodes.insert(nodes.end(), segment.nodes.begin(), segment.nodes.end());
    for (const NodeIndex n : nodes) {
      if (n == no_index) continue;
      Hold why = static_cast<Hold>(holds_[n]);
      if (const auto it = refused_.find(n); why == Hold::none && it != refused_.end())
        why = it->second;
      if (why != Hold::none)
        return std::string("the edge passes through a segment; no single node may undo that: ") +
               (why == Hold::share ? stopped_by_share(options_) : to_string(why)) +
               (why == Hold::not_writable ? ": " + cells_.obstacle(n) : "");
    }
    return "the edge passes through a segment; no move of a single node undoes that: separate the "
           "parts first";
  }

  std::optional<FixMesh> mesh_;
  std::vector<std::uint8_t> holds_;
  std::vector<std::uint32_t> moved_in_part_;
  std::set<NodeIndex> moved_;
  std::map<NodeIndex, Hold> refused_;  ///< why a move of it was not made, the last time
  Baseline baseline_;
  std::map<std::pair<NodeIndex, int>, std::string> texts_;
  PenetrationFix fix_;
};

}  // namespace

Result<PenetrationFix> untangle(const EditContext& context, const MoveNodesOptions& options) {
  return Untangler(context, options).run();
}

}  // namespace deck
