// Strategy move-nodes.
// Each penetration wishes a displacement along its normal. Per pass: evaluate contacts, solve all
// wishes of all pairs that were ever too close together (ways_out.cpp), keep every node within its
// depth and limits. Passes end when no pair is too close or `patience` passes bring nothing. Then
// print the coordinates, drop moves that do harm or free nothing, and read the deck again. Cost:
// one evaluation of the contacts per pass.
#include "edit/shared/depenetrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "base/shared/parallel.hpp"
#include "edit/fix/movable.hpp"

namespace deck {
namespace {

using namespace detail;

constexpr int sweeps = 200;  // projections per pass
constexpr int most_passes = 40;
constexpr int patience = 4;               // passes without progress
constexpr double least_side = 0.5;        // of the former length of an element's side
constexpr double least_component = 1e-3;  // share of a move along an axis; less is not printed
constexpr double least_move = 1e-6;       // share of the depth; less repairs nothing

class Depenetrator : MovableDeck {
 public:
  Depenetrator(const LoadedDeck& context, const MoveNodesOptions& options)
      : MovableDeck(context, options) {}

  Result<PenetrationFix> run() {
    const auto before = prepare();
    if (!before) return before.error();
    fix_.strategy = "move-nodes";
    begin(*before);
    if (anything_to_do_) plan();
    print_all();
    drop_needless();
    return make_result(
        *before, {moved_.begin(), moved_.end()},
        [this](const Scene& scene, const PairAt& at) { return reason_of(scene, at); });
  }

 private:
  void begin(const Scene& scene) {
    for (const Crossing& c : crossed_) {
      for (const NodeIndex n : c.edge) pin(n, PinReason::crossed);
      for (const NodeIndex n : scene.contacts[c.contact].main[c.main].nodes)
        pin(n, PinReason::crossed);
    }
    for (std::uint32_t c = 0; c < scene.contacts.size(); ++c) {
      if (!is_wanted(options_, scene.contacts[c])) continue;
      const std::vector<bool> inside = inside_solids(scene, c);  // all false for edges
      for (const PenetrationRow& row : scene.contacts[c].penetrations)
        if (is_penetration(row))
          begin_pair(scene, {c, row.secondary, row.main}, row, inside[row.secondary]);
    }
    for (NodeIndex n = 0; n < pinned_.size(); ++n)
      if (!bounds_.contains(n)) pin(n, PinReason::bystander);
  }

  void begin_pair(const Scene& scene, const PairAt& at, const PenetrationRow& row, bool inside) {
    const PairState state = state_of(scene, now_, at);
    std::string why = why_not_movable(*mesh_, now_, state);
    if (why.empty() && inside) why = inside_solid;
    if (!why.empty()) {
      skipped_[key_of(scene, at)] = std::move(why);
      return;
    }
    const Vec way = way_out(scene, *mesh_, now_, at, state);
    anything_to_do_ |= dot(way, way) > 0;
    bounds_.add(key_of(scene, at), state, way, row.depth + options_.clearance * row.gap);
  }

  /// Number of nodes of a part that may move.
  double may_move(std::uint32_t part) const {
    return std::max(1.0,
                    std::floor(options_.most_moved * mesh_->nodes_of_part(part) * (1 + 1e-12)));
  }

  void pin(NodeIndex n, PinReason why) {
    if (pinned_[n] == 0 || is_bystander(n)) pinned_[n] = static_cast<std::uint8_t>(why);
  }
  bool is_bystander(NodeIndex n) const {
    return pinned_[n] == static_cast<std::uint8_t>(PinReason::bystander);
  }

  // ---- the plan -------------------------------------------------------------------------------

  /// Moves nodes until no pair is too close or passes stop helping. Each pass solves all pairs that
  /// were ever too close, at the present positions.
  void plan() {
    double best = std::numeric_limits<double>::infinity();
    for (int waited = 0; fix_.iterations < most_passes && waited < patience; ++fix_.iterations) {
      const Scene& scene = evaluate();
      std::size_t left = 0;
      double total = 0;
      for (std::uint32_t c = 0; c < scene.contacts.size(); ++c)
        for (const PenetrationRow& row : scene.contacts[c].penetrations)
          if (is_task(scene, {c, row.secondary, row.main}) && is_penetration(row)) {
            active_.insert({c, row.secondary, row.main});
            ++left;
            total += row.depth / row.gap;
          }
      if (fix_.iterations == 0) first_left_ = left;
      if (options_.progress)
        options_.progress("moving nodes", first_left_ - std::min(first_left_, left), first_left_);
      if (left == 0) return;
      waited = total < 0.99 * best ? 0 : waited + 1;
      best = std::min(best, total);
      if (!step(scene)) return;
    }
  }

  /// True for a penetration to remove: of a wanted interface, or a new one.
  bool is_task(const Scene& scene, const PairAt& at) const {
    const Contact& contact = scene.contacts[at.contact];
    if (!skipped_.empty() && skipped_.contains(key_of(scene, at))) return false;
    return is_wanted(options_, contact) ||
           (!contact.is_tied_contact() && !baseline_.contains(key_of(scene, at)));
  }

  /// One pass; false if no node can move.
  bool step(const Scene& scene) {
    const std::vector<Wish> wishes = make_wishes(scene);
    pin_unwritable_nodes(wishes);
    NodeMoves moves = moves_for(wishes);
    while (!add_moves(moves)) moves = moves_for(wishes);
    for (const auto& [n, move] : moves) place(n, at(now_, n) + move);
    return !moves.empty();
  }

  NodeMoves moves_for(const std::vector<Wish>& wishes) {
    NodeMoves moves = solve_wishes(wishes, pinned_, sweeps);
    keep_within_bounds(moves);
    std::erase_if(moves, [&](const auto& move) {
      return norm(move.second) <= least_move * bounds_.reach_of(move.first);
    });
    return moves;
  }

  std::vector<Wish> make_wishes(const Scene& scene) const {
    std::vector<PairNow> pairs;  // pairs that were ever too close, at present
    pairs.reserve(active_.size());
    for (const PairAt& place : active_) pairs.push_back({place, state_of(scene, now_, place)});
    std::vector<Wish> wishes;
    for (const PairNow* pair : strictest(pairs)) {
      Wish w;
      w.state = pair->state;
      w.normal = way_out(scene, *mesh_, now_, pair->at, w.state);
      w.by = w.state.depth() + options_.clearance * w.state.gap;
      w.main_gives_way = !options_.secondary_only;
      if (dot(w.normal, w.normal) > 0) wishes.push_back(w);
    }
    return wishes;
  }

  void pin_unwritable_nodes(const std::vector<Wish>& wishes) {
    std::vector<NodeIndex> nodes;
    for (const Wish& w : wishes)
      nodes.insert(nodes.end(), w.state.nodes.begin(), w.state.nodes.begin() + w.state.count);
    cells_.find_lines(nodes);
    for (const NodeIndex n : nodes)
      if (!cells_.obstacle(n).empty()) pin(n, PinReason::not_writable);
  }

  /// Adds to the moved nodes. False if parts would exceed their share: such parts stay as a whole
  /// from now on, because a few moved nodes are a dent and no repair.
  bool add_moves(const NodeMoves& moves) {
    std::set<NodeIndex> all = moved_;
    for (const auto& [n, move] : moves) all.insert(n);
    std::map<std::uint32_t, std::uint32_t> counts;
    for (const NodeIndex n : all)
      if (const std::uint32_t part = mesh_->part_of(n); part != no_index) ++counts[part];
    bool fits = true;
    for (const auto& [part, count] : counts)
      if (count > may_move(part)) {
        leave_alone(part, count);
        fits = false;
      }
    if (fits) moved_ = std::move(all);
    return fits;
  }

  void leave_alone(std::uint32_t part, std::uint32_t needed) {
    needed_[part] = needed;
    for (NodeIndex n = 0; n < pinned_.size(); ++n)
      if (mesh_->part_of(n) == part) {
        undo_move(n, PinReason::share);
        pin(n, PinReason::share);
      }
  }

  /// Limits moves to the depth of the penetrations and to --max-displacement.
  void keep_within_bounds(NodeMoves& moves) {
    NodeMoves wanted = moves;
    for (auto& [n, move] : wanted) move = at(now_, n) + move - at(start_, n);
    const auto places = bounds_.allowed(wanted, effective_threads(options_.threads));
    for (std::size_t i = 0; i < moves.size(); ++i) {
      auto& [n, move] = moves[i];
      if (places[i].at_bound) pin(n, PinReason::depth);
      Vec total = places[i].by;
      const double l = norm(total), limit = options_.most_displacement.value_or(l);
      if (l > limit) {
        total = (limit / l) * total;
        pin(n, PinReason::displacement);
      }
      // Components too small to matter keep their written number.
      for (double* component : {&total.x, &total.y, &total.z})
        if (std::abs(*component) <= least_component * norm(total)) *component = 0;
      move = at(start_, n) + total - at(now_, n);
    }
  }

  // ---- what of it is done ---------------------------------------------------------------------

  /// Moves every moved node to its printed position.
  void print_all() {
    for (const NodeIndex n : std::vector(moved_.begin(), moved_.end()))
      if (!put(n, at(now_, n))) undo_move(n, PinReason::depth);
  }

  void undo_move(NodeIndex n, PinReason why) {
    if (moved_.erase(n) == 0) return;
    put_back(n);
    if (why == PinReason::depth)
      pin(n, why);  // unless another reason applies
    else
      pinned_[n] = static_cast<std::uint8_t>(why);
  }

  /// Drops moves that do harm or free nothing, until none is left.
  void drop_needless() {
    while (!moved_.empty()) {
      const Scene& scene = evaluate();
      std::map<NodeIndex, PinReason> bad = harmful_shapes(scene);
      add_harmful(scene, bad);
      if (bad.empty()) add_idle(scene, bad);
      if (bad.empty()) return;
      for (const auto& [n, why] : bad) undo_move(n, why);
    }
  }

  /// Moved nodes of elements that cross, are inverted or have shrunk, and of pairs that changed
  /// sides: lines and lone nodes have no faces that could cross.
  std::map<NodeIndex, PinReason> harmful_shapes(const Scene& scene) const {
    std::map<NodeIndex, PinReason> out;
    const auto add = [&](NodeIndex n, PinReason why) {
      if (moved_.contains(n)) out.emplace(n, why);
    };
    const std::vector<NodeIndex> nodes(moved_.begin(), moved_.end());
    for (const auto& crossing : mesh_->crossings(now_, nodes, options_.threads))
      if (!std::binary_search(crossings_.begin(), crossings_.end(), crossing))
        for (const NodeIndex n : mesh_->nodes_of(crossing)) add(n, PinReason::would_cross);
    for (const PairAt& pair : active_) {
      const PairState was = state_of(scene, start_, pair);
      if (!has_direction(was) || dot(state_of(scene, now_, pair).normal, was.normal) >= 0) continue;
      for (int i = 0; i < was.count; ++i)
        add(was.nodes[static_cast<std::size_t>(i)], PinReason::would_cross);
    }
    for (const NodeIndex n : mesh_->inverted(start_, now_, nodes)) add(n, PinReason::would_invert);
    for (const NodeIndex n : mesh_->shortened(start_, now_, nodes, least_side))
      add(n, PinReason::would_shrink);
    return out;
  }

  /// Adds moved nodes that free none of their pairs.
  void add_idle(const Scene& scene, std::map<NodeIndex, PinReason>& bad) const {
    const StateBefore left(scene, options_);
    for (const NodeIndex n : moved_) {
      const std::vector<PairKey>& pairs = bounds_.pairs_of(n);
      if (std::all_of(pairs.begin(), pairs.end(),
                      [&](const PairKey& pair) { return left.contains(pair); }))
        bad.emplace(n, PinReason::depth);
    }
  }

  /// Adds moved nodes of new or deeper penetrations, and of ties that came or went.
  void add_harmful(const Scene& scene, std::map<NodeIndex, PinReason>& bad) const {
    for (const HarmedPair& harm : baseline_.harm(scene)) {
      const PinReason why = harm.tie ? PinReason::would_untie : PinReason::would_penetrate;
      bool found = false;
      for (const NodeIndex n : harm.nodes) {
        if (!moved_.contains(n)) continue;
        bad.emplace(n, why);
        found = true;
      }
      // No node of the pair moved: a default gap follows the shortest side.
      if (!found)
        for (const NodeIndex n : moved_) bad.emplace(n, why);
    }
  }

  // ---- the end --------------------------------------------------------------------------------

  RefusalReason reason_of(const Scene& scene, const PairAt& at) {
    const auto it = skipped_.find(key_of(scene, at));
    std::string text = it != skipped_.end() ? it->second : what_holds(scene, at);
    const auto has_reason = [&](PinReason reason) {
      return text.find(to_string(reason)) != text.npos;
    };
    std::string next = "deck fix DECK";
    if (has_reason(PinReason::crossed))
      next = "deck gaps DECK --crossings";
    else if (has_reason(PinReason::share))
      next = "deck fix DECK --strategy move-nodes --max-moved 100%";
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
      const auto why = static_cast<PinReason>(pinned_[n]);
      if (why == PinReason::none && i >= state.secondary_count) main_free = true;
      if (why == PinReason::none || !side.empty()) continue;
      side = to_string(why);
      if (why == PinReason::not_writable) side += ": " + cells_.obstacle(n);
      if (why == PinReason::share) side = share_text(n);
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
    const std::string text =
        fmt::format("{} {:.3g} %", to_string(PinReason::share), 100 * options_.most_moved);
    const std::uint32_t part = mesh_->part_of(n);
    const auto it = needed_.find(part);
    if (it == needed_.end()) return text;
    const std::uint32_t all = mesh_->nodes_of_part(part);
    return fmt::format("{}: needs {:.3g} % of part {} ({} of {} nodes); nothing done", text,
                       100 * (static_cast<double>(it->second) / all), model_.parts[part].id,
                       it->second, all);
  }

  std::set<NodeIndex> moved_;
  std::set<PairAt> active_;                        ///< pairs that were ever too close
  DepthBounds bounds_;                             ///< of nodes in penetrations
  std::map<std::uint32_t, std::uint32_t> needed_;  ///< number of nodes, by part that stays
  std::size_t first_left_ = 0;
  bool anything_to_do_ = false;
};

}  // namespace

Result<PenetrationFix> move_nodes(const LoadedDeck& context, const MoveNodesOptions& options) {
  return Depenetrator(context, options).run();
}

}  // namespace deck
