// The iteration: search, ask for displacements, print, search again.
#include "edit/shared/depenetrate.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "base/shared/parallel.hpp"
#include "edit/fix/common.hpp"
#include "edit/fix/harm.hpp"
#include "edit/fix/movable.hpp"
#include "edit/fix/nodes/depenetrate_bounds.hpp"
#include "edit/fix/nodes/depenetrate_cells.hpp"
#include "edit/fix/nodes/depenetrate_locks.hpp"
#include "edit/fix/nodes/depenetrate_mesh.hpp"
#include "edit/fix/nodes/depenetrate_rows.hpp"
#include "edit/fix/nodes/node_table.hpp"
#include "edit/fix/type_rules.hpp"

namespace deck {
namespace {

using namespace detail;

constexpr int rounds = 4;    // after each, harmful moves are taken back
constexpr int sweeps = 200;  // projections per iteration
constexpr int most_iterations = 60;
constexpr double step_share = 0.7;        // of the depth, per iteration
constexpr int patience = 8;               // iterations without progress
constexpr double largest_step = 0.45;     // of the gap: two sides cannot pass each other unseen
constexpr double least_side = 0.5;        // of the length of an element's side before
constexpr double least_component = 1e-3;  // of a move along an axis, to be printed
constexpr double settled = 0.9;           // of what the iteration before has left
constexpr double enough_clearance = 0.5;  // of it may be lacking
constexpr double least_move = 1e-6;       // of the depth: a shorter one repairs nothing

class Depenetrator : MovableDeck {
 public:
  Depenetrator(const LoadedDeck& context, const MoveNodesOptions& options)
      : MovableDeck(context, options) {}

  Result<PenetrationFix> run() {
    const auto before = prepare();
    if (!before) return before.error();
    begin(*before);
    for (int round = 0; round < rounds && anything_to_do_; ++round) {
      const bool solved = iterate();
      print_all();
      // Printing leaves small components out, which may cost a little of the clearance.
      if (take_back_harmful() == 0 && (!solved || tasks_left() == 0)) break;
    }
    keep_needed_moves();
    return finish(*before);
  }

 private:
  void begin(const Scene& scene) {
    moved_in_part_.assign(model_.parts.size(), 0);
    looked_up_.assign(model_.nodes.size(), false);
    for (const Crossing& c : crossed_) {
      for (const NodeIndex n : c.edge) hold(n, Hold::crossed);
      for (const NodeIndex n : scene.contacts[c.contact].main[c.main].nodes) hold(n, Hold::crossed);
    }
    for (std::uint32_t c = 0; c < scene.contacts.size(); ++c) {
      if (!is_wanted(options_, scene.contacts[c])) continue;
      const std::vector<bool> inside = inside_solids(scene, c);  // all false for edges
      for (const PenetrationRow& row : scene.contacts[c].penetrations)
        if (is_penetration(row))
          begin_pair(scene, {c, row.secondary, row.main}, row, inside[row.secondary]);
    }
    for (NodeIndex n = 0; n < holds_.size(); ++n)
      if (!bounds_.contains(n)) hold(n, Hold::bystander);
  }

  void begin_pair(const Scene& scene, const PairAt& at, const PenetrationRow& row, bool inside) {
    const PairState state = state_of(scene, now_, at);
    std::string why = why_not_movable(*mesh_, now_, state);
    if (why.empty() && inside)
      why =
          "the node is inside a solid: the way out is not the way to its surface; separate "
          "the parts first";
    if (!why.empty()) {
      skipped_[key_of(scene, at)] = std::move(why);
      return;
    }
    const Vec way = way_out(scene, *mesh_, now_, at, state);
    anything_to_do_ |= dot(way, way) > 0;
    bounds_.add(key_of(scene, at), state, way, row.depth + options_.clearance * row.gap);
  }

  /// How many nodes of a part may move.
  double may_move(std::uint32_t part) const {
    return std::max(1.0,
                    std::floor(options_.most_moved * mesh_->nodes_of_part(part) * (1 + 1e-12)));
  }

  void hold(NodeIndex n, Hold why) {
    if (holds_[n] == 0 || is_bystander(n)) holds_[n] = static_cast<std::uint8_t>(why);
  }
  bool is_bystander(NodeIndex n) const {
    return holds_[n] == static_cast<std::uint8_t>(Hold::bystander);
  }

  // ---- one round ------------------------------------------------------------------------------

  /// True if nothing is left to do.
  bool iterate() {
    double best = -1, last = -1;
    int waited = 0;
    for (int i = 0; i < most_iterations; ++i) {
      const Scene& scene = evaluate();
      double total = 0;
      std::vector<PairAt> too_close;
      for (std::uint32_t c = 0; c < scene.contacts.size(); ++c)
        for (const PenetrationRow& row : scene.contacts[c].penetrations)
          if (is_task(scene, {c, row.secondary, row.main}) && is_penetration(row)) {
            too_close.push_back({c, row.secondary, row.main});
            total += row.depth / row.gap;
          }
      const std::size_t left = too_close.size();
      remember(std::move(too_close));
      if (options_.progress)
        options_.progress("moving nodes", first_left_ - std::min(first_left_, left), first_left_);
      if (fix_.iterations == 0) first_left_ = left;
      if (left == 0) return true;
      if (best < 0 || total < 0.99 * best) {
        best = total;
        waited = 0;
      } else if (++waited >= patience) {
        return false;
      }
      ++fix_.iterations;
      settling_ = last >= 0 && total > settled * last;
      last = total;
      if (!step(scene)) return false;
    }
    return false;
  }

  /// Adds pairs to those that were ever too close.
  void remember(std::vector<PairAt> pairs) {
    std::sort(pairs.begin(), pairs.end());
    std::vector<PairAt> all;
    std::set_union(active_.begin(), active_.end(), pairs.begin(), pairs.end(),
                   std::back_inserter(all));
    active_ = std::move(all);
  }

  std::size_t tasks_left() {
    const Scene& scene = evaluate();
    std::size_t left = 0;
    for (std::uint32_t c = 0; c < scene.contacts.size(); ++c)
      for (const PenetrationRow& row : scene.contacts[c].penetrations)
        left += is_task(scene, {c, row.secondary, row.main}) && is_penetration(row);
    return left;
  }

  /// A penetration that should go: of the interfaces asked for, or one that was not there before.
  bool is_task(const Scene& scene, const PairAt& at) const {
    const Contact& contact = scene.contacts[at.contact];
    if (!skipped_.empty() && skipped_.contains(key_of(scene, at))) return false;
    return is_wanted(options_, contact) ||
           (!contact.ties() && !baseline_.contains(key_of(scene, at)));
  }

  /// Moves nodes once; false if none can move.
  bool step(const Scene& scene) {
    const std::vector<PairNow>& pairs = active_pairs(scene);
    const std::vector<Wish>& wishes = make_wishes(scene, pairs);
    std::vector<NodeIndex> nodes;
    for (const Wish& w : wishes)
      nodes.insert(nodes.end(), w.state.nodes.begin(), w.state.nodes.begin() + w.state.count);
    hold_unwritable(nodes);
    for (;;) {
      const NodeMoves moves = moves_for(wishes);
      if (admit(moves)) return apply(scene, pairs, moves);
    }
  }

  NodeMoves moves_for(const std::vector<Wish>& wishes) {
    NodeMoves moves = solve_wishes(wishes, holds_, sweeps);
    constexpr double none = std::numeric_limits<double>::infinity();
    std::vector<double> cap(holds_.size(), none);  // by node: its smallest gap
    for (const Wish& w : wishes)
      for (int i = 0; i < w.state.count; ++i) {
        double& least = cap[w.state.nodes[static_cast<std::size_t>(i)]];
        least = std::min(least, w.state.gap);
      }
    for (auto& [n, move] : moves) {
      if (cap[n] == none) continue;
      const double most = largest_step * cap[n], l = norm(move);
      if (l > most) move = (most / l) * move;
    }
    keep_within_bounds(moves);
    std::erase_if(moves, [&](const auto& move) {
      return norm(move.second) <= least_move * bounds_.reach_of(move.first);
    });
    return moves;
  }

  /// Every pair that was ever too close, as it is now; by contact and secondary node.
  const std::vector<PairNow>& active_pairs(const Scene& scene) {
    std::vector<PairNow>& out = pairs_;
    out.resize(active_.size());
    parallel_pieces(effective_threads(options_.threads), out.size(),
                    [&](std::size_t, std::size_t begin, std::size_t end) {
                      for (std::size_t i = begin; i < end; ++i)
                        out[i] = {active_[i], state_of(scene, now_, active_[i])};
                    });
    return out;
  }

  const std::vector<Wish>& make_wishes(const Scene& scene, const std::vector<PairNow>& pairs) {
    std::vector<Wish>& wishes = wishes_;
    wishes.clear();
    for (const PairNow* pair : strictest(pairs)) {
      Wish w;
      w.state = pair->state;
      w.normal = way_out(scene, *mesh_, now_, pair->at, w.state);
      const double lack = w.state.depth() + options_.clearance * w.state.gap;
      const bool enough = settling_ && lack <= enough_clearance * options_.clearance * w.state.gap;
      w.by = lack <= 0 ? lack : enough ? 0 : step_share * lack;
      w.main_gives_way = !options_.secondary_only;
      if (dot(w.normal, w.normal) > 0) wishes.push_back(w);
    }
    return wishes;
  }

  void hold_unwritable(std::vector<NodeIndex> nodes) {
    std::erase_if(nodes, [&](NodeIndex n) { return looked_up_[n]; });
    for (const NodeIndex n : nodes) looked_up_[n] = true;
    cells_.look_up(nodes);
    for (const NodeIndex n : nodes)
      if (!cells_.obstacle(n).empty()) hold(n, Hold::not_writable);
  }

  /// Counts the moved nodes of each part. False: parts would pass their share. These are left
  /// alone as a whole from now on, since a few moved nodes of a part are a dent and no repair.
  bool admit(const NodeMoves& moves) {
    std::map<std::uint32_t, std::uint32_t> added;
    for (const auto& [n, move] : moves)
      if (const std::uint32_t part = mesh_->part_of(n); part != no_index && !moved_.contains(n))
        ++added[part];
    bool fits = true;
    for (const auto& [part, count] : added)
      if (moved_in_part_[part] + count > may_move(part)) {
        leave_alone(part, moved_in_part_[part] + count);
        fits = false;
      }
    if (!fits) return false;
    for (const auto& [part, count] : added) moved_in_part_[part] += count;
    for (const auto& [n, move] : moves) moved_.insert(n);
    return true;
  }

  void leave_alone(std::uint32_t part, std::uint32_t needed) {
    needed_[part] = needed;
    for (NodeIndex n = 0; n < holds_.size(); ++n)
      if (mesh_->part_of(n) == part) {
        take_back(n);
        hold(n, Hold::share);
      }
  }

  /// Out of the penetrations, no farther than they are deep, and within --max-displacement.
  void keep_within_bounds(NodeMoves& moves) {
    NodeMoves wanted = moves;
    for (auto& [n, move] : wanted) move = at(now_, n) + move - at(start_, n);
    const auto places = bounds_.allowed(wanted, effective_threads(options_.threads));
    for (std::size_t i = 0; i < moves.size(); ++i) {
      auto& [n, move] = moves[i];
      const DepthBounds::Place& may = places[i];
      move = at(start_, n) + may.by - at(now_, n);
      if (may.at_bound) hold(n, Hold::depth);
      if (!options_.most_displacement) continue;
      const Vec total = at(now_, n) + move - at(start_, n);
      const double l = norm(total), limit = *options_.most_displacement;
      if (l <= limit) continue;
      move = at(start_, n) + (limit / l) * total - at(now_, n);
      hold(n, Hold::displacement);
    }
  }

  /// Makes the moves; those that cross elements or spoil their shape are halved, then dropped.
  bool apply(const Scene& scene, const std::vector<PairNow>& pairs, const NodeMoves& moves) {
    std::vector<double> share(moves.size(), 1);
    std::vector<Vec> from;
    std::vector<NodeIndex> nodes;
    for (const auto& [n, move] : moves) {
      from.push_back(at(now_, n));
      nodes.push_back(n);
    }
    std::vector<FixMesh::Crossed> crossings;
    std::vector<NodeIndex> placed = nodes;  // differently than in the attempt before
    for (int attempt = 0;; ++attempt) {
      for (std::size_t i = 0; i < moves.size(); ++i)
        place(nodes[i], share[i] == 0 ? from[i] : from[i] + share[i] * moves[i].second);
      mesh_->update_crossings(now_, placed, options_.threads, crossings);
      std::map<NodeIndex, Hold> bad = harmful_shapes(nodes, crossings);
      // Lines and lone nodes have no faces that would cross: they must not change sides.
      for (const PairNow* pair : turned_round(scene, now_, pairs, placed, options_.threads))
        for (int i = 0; i < pair->state.count; ++i)
          bad.emplace(pair->state.nodes[static_cast<std::size_t>(i)], Hold::would_cross);
      placed.clear();
      for (const auto& [n, why] : bad) {
        const auto it = std::lower_bound(nodes.begin(), nodes.end(), n);
        if (it == nodes.end() || *it != n) continue;
        double& own = share[static_cast<std::size_t>(it - nodes.begin())];
        if (own == 0) continue;
        own = attempt < 2 ? 0.5 * own : 0;
        placed.push_back(n);
        if (own > 0) continue;
        blocked_[n] = why;
        if (++strikes_[n] >= 3) hold(n, why);
      }
      if (placed.empty()) break;
    }
    return std::any_of(share.begin(), share.end(), [](double s) { return s > 0; });
  }

  /// Nodes of elements that cross, are turned, or have shrunk, since the start; `crossings`: those
  /// that touch the nodes.
  std::map<NodeIndex, Hold> harmful_shapes(const std::vector<NodeIndex>& nodes,
                                           const std::vector<FixMesh::Crossed>& crossings) const {
    std::map<NodeIndex, Hold> out;
    for (const auto& crossing : crossings)
      if (!std::binary_search(crossings_.begin(), crossings_.end(), crossing))
        for (const NodeIndex n : mesh_->nodes_of(crossing)) out.emplace(n, Hold::would_cross);
    for (const NodeIndex n : mesh_->inverted(start_, now_, nodes, options_.threads))
      out.emplace(n, Hold::would_invert);
    for (const auto& [n, next] :
         mesh_->shortened(start_, now_, nodes, least_side, options_.threads)) {
      out.emplace(n, Hold::would_shrink);
      out.emplace(next, Hold::would_shrink);
    }
    return out;
  }

  // ---- between rounds -------------------------------------------------------------------------

  /// Puts every moved node where its printed coordinates are.
  void print_all() {
    texts_.clear();
    for (const NodeIndex n : moved_.all()) {
      bool written = false;
      const Vec u = at(now_, n) - at(start_, n);
      const double size = norm(u);
      const double to[3] = {now_.x[n], now_.y[n], now_.z[n]};
      const double old[3] = {start_.x[n], start_.y[n], start_.z[n]};
      double printed[3] = {old[0], old[1], old[2]};
      for (int axis = 0; axis < 3 && size > 0; ++axis) {
        // What hardly counts in the move as a whole stays as it was written.
        if (std::abs(to[axis] - old[axis]) <= least_component * size) continue;
        const auto text = cells_.print(n, axis, to[axis]);
        if (!text || text->value == old[axis]) continue;
        printed[axis] = text->value;
        texts_.emplace_hint(texts_.end(), std::pair(n, axis), text->text);
        written = true;
      }
      place(n, {printed[0], printed[1], printed[2]});
      if (written) continue;
      forget(n);
      moved_.erase(n);
    }
  }

  void forget(NodeIndex n) {
    if (const std::uint32_t part = mesh_->part_of(n); part != no_index) --moved_in_part_[part];
  }

  /// Takes moves back until none is to blame for anything that was not there before. Returns how
  /// many.
  std::size_t take_back_harmful() {
    std::size_t taken = 0;
    while (!moved_.empty()) {
      const std::vector<NodeIndex> nodes = moved_.all();
      std::map<NodeIndex, Hold> bad =
          harmful_shapes(nodes, mesh_->crossings(now_, nodes, options_.threads));
      blame(evaluate_with_ties(), bad);
      const std::size_t before = taken;
      for (const auto& [n, why] : bad) taken += take_back(n, why);
      if (taken == before) break;
    }
    return taken;
  }

  /// Puts a node back where it was; false if it has not moved.
  bool take_back(NodeIndex n) {
    if (!moved_.erase(n)) return false;
    place(n, at(start_, n));
    forget(n);
    for (int axis = 0; axis < 3; ++axis) texts_.erase({n, axis});
    return true;
  }
  bool take_back(NodeIndex n, Hold why) {
    if (!take_back(n)) return false;
    holds_[n] = static_cast<std::uint8_t>(why);
    return true;
  }

  /// Takes back what repairs nothing, and what would harm without it, until all moves are needed.
  void keep_needed_moves() {
    while (take_back_idle() + take_back_harmful() > 0) {
    }
  }

  /// Takes moves back that free none of the pairs they were made for. Returns how many.
  std::size_t take_back_idle() {
    if (moved_.empty()) return 0;
    const Baseline left(evaluate(), options_);
    std::vector<NodeIndex> idle;
    for (const NodeIndex n : moved_.all()) {
      const std::vector<PairKey>& pairs = bounds_.pairs_of(n);
      const std::span<const NodeIndex> next = mesh_->neighbours(n);
      const bool needed =
          pairs.empty() ? std::any_of(next.begin(), next.end(),
                                      [&](NodeIndex other) { return moved_.contains(other); })
                        : std::any_of(pairs.begin(), pairs.end(),
                                      [&](const PairKey& pair) { return !left.contains(pair); });
      if (!needed) idle.push_back(n);
    }
    for (const NodeIndex n : idle) {
      take_back(n);
      hold(n, Hold::depth);
    }
    return idle.size();
  }

  /// Adds the moved nodes of pairs that penetrate and did not, or deeper than before, and of ties
  /// that came or went.
  void blame(const Scene& scene, std::map<NodeIndex, Hold>& bad) const {
    for (const Harm& harm : baseline_.harm(scene)) {
      const Hold why = harm.tie ? Hold::would_untie : Hold::would_penetrate;
      bool found = false;
      for (const NodeIndex n : harm.nodes) {
        if (!moved_.contains(n)) continue;
        bad.emplace(n, why);
        found = true;
      }
      // Nobody of the pair moved: its gap changed, because a default follows the shortest side.
      if (!found)
        for (const NodeIndex n : moved_.all()) bad.emplace(n, why);
    }
  }

  // ---- the end --------------------------------------------------------------------------------

  Result<PenetrationFix> finish(const Scene& before) {
    for (;;) {
      fix_.rewrite.edits = cells_.edits(texts_);
      const auto again = AfterRewrite::read(context_, fix_.rewrite, options_, false, before);
      if (!again) return again.error();
      const Scene& after = again->scene();
      std::map<NodeIndex, Hold> bad;
      blame(after, bad);
      std::size_t taken = 0;
      for (const auto& [n, why] : bad) taken += take_back(n, why);
      if (taken > 0) {
        keep_needed_moves();
        continue;
      }
      const std::vector<Harm> harm = baseline_.harm(after);
      if (const auto why = harm_text(model_, after, harm))
        return Error{Error::Code::internal, "the deck read again differs: " + *why};
      fix_.strategy = "move-nodes";
      report(before, after, moved_.all(),
             [this](const Scene& scene, const PairAt& at) { return reason_of(scene, at); });
      note_unevaluated(fix_, after, options_);
      fix_.complete = fix_.refused.empty();
      return std::move(fix_);
    }
  }

  Reason reason_of(const Scene& scene, const PairAt& at) {
    const auto it = skipped_.find(key_of(scene, at));
    std::string text = it != skipped_.end() ? it->second : what_holds(scene, at);
    const auto says = [&](Hold hold) { return text.find(to_string(hold)) != text.npos; };
    std::string next = "deck fix DECK --strategy inacti";  // leaves the mesh as it is
    if (says(Hold::crossed))
      next = "deck gaps DECK --crossings";
    else if (says(Hold::share))
      next = "deck fix DECK --strategy move-nodes --max-moved 100%";
    else if (it != skipped_.end())
      next = "deck fix DECK --strategy move-part";
    return {std::move(text), std::move(next)};
  }

  std::string what_holds(const Scene& scene, const PairAt& place) {
    const PairState state = state_of(scene, now_, place);
    const Vec way = way_out(scene, *mesh_, now_, place, state);
    if (!(dot(way, way) > 0))
      return "both sides are at one place and have no direction: move one of them off it first";
    std::string secondary, main;
    bool main_free = false;
    for (int i = 0; i < state.count; ++i) {
      const NodeIndex n = state.nodes[static_cast<std::size_t>(i)];
      std::string& side = i < state.secondary_count ? secondary : main;
      Hold why = static_cast<Hold>(holds_[n]);
      if (const auto it = blocked_.find(n); why == Hold::none && it != blocked_.end())
        why = it->second;
      if (why == Hold::none && i >= state.secondary_count) main_free = true;
      if (why == Hold::none || !side.empty()) continue;
      side = to_string(why);
      if (why == Hold::not_writable) side += ": " + cells_.obstacle(n);
      if (why == Hold::share) side = share_text(n);
    }
    if (options_.secondary_only && main.empty()) main = "main sides do not give way";
    if (secondary.empty() && main.empty())
      return "there is no room for both sides: not solved in " + std::to_string(fix_.iterations) +
             " iterations";
    std::string text;
    if (secondary == main) {
      text = "both sides: " + main;
    } else {
      if (!secondary.empty()) text = "secondary: " + secondary;
      if (!main.empty()) text += (text.empty() ? "main: " : "; main: ") + main;
    }
    if (main_free && !options_.secondary_only && !main.empty())
      text += " (some nodes of the main side)";
    return text;
  }

  /// "stopped by --max-moved 10 %: needs 100 % of part 2 (9 of 9 nodes); nothing done"
  std::string share_text(NodeIndex n) const {
    std::string text = stopped_by_share(options_);
    const std::uint32_t part = mesh_->part_of(n);
    const auto it = needed_.find(part);
    if (it == needed_.end()) return text;
    const std::uint32_t all = mesh_->nodes_of_part(part);
    return text + ": needs " + percent_text(static_cast<double>(it->second) / all) + " of part " +
           std::to_string(model_.parts[part].id) + " (" + std::to_string(it->second) + " of " +
           std::to_string(all) + " nodes); nothing done";
  }

  std::vector<bool> looked_up_;  ///< by cells_
  NodeMarks moved_;
  std::vector<std::uint32_t> moved_in_part_;
  std::map<NodeIndex, int> strikes_;               ///< how often a move was dropped
  std::map<NodeIndex, Hold> blocked_;              ///< and why, the last time
  std::vector<PairAt> active_;                     ///< every pair that was ever too close
  std::vector<PairNow> pairs_;                     ///< these, in the last iteration
  std::vector<Wish> wishes_;                       ///< of them
  DepthBounds bounds_;                             ///< of the nodes in penetrations
  std::map<std::uint32_t, std::uint32_t> needed_;  ///< nodes, of parts that are left alone
  std::map<PairKey, std::string> skipped_;         ///< pairs that moving cannot solve, and why
  std::map<std::pair<NodeIndex, int>, std::string> texts_;
  std::size_t first_left_ = 0;
  /// Hardly anything gets better: free pairs need not come closer and closer to all of their
  /// clearance.
  bool settling_ = false;
  bool anything_to_do_ = false;
};

}  // namespace

Result<PenetrationFix> move_nodes(const LoadedDeck& context, const MoveNodesOptions& options) {
  return Depenetrator(context, options).run();
}

}  // namespace deck
