// Moves nodes out of gaps by one plan. Each penetration asks for a displacement along its normal;
// all of them are solved together, within the depth of each node, until none is left. Moves that
// make anything worse are then left out, and the deck is read again with the others as they are
// printed.
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
constexpr double least_side = 0.5;        // of the length of an element's side before
constexpr double least_component = 1e-3;  // of a move along an axis, to be printed
constexpr double least_move = 1e-6;       // of the depth: a shorter one repairs nothing

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
    return finish(*before, {moved_.begin(), moved_.end()},
                  [this](const Scene& scene, const PairAt& at) { return reason_of(scene, at); });
  }

 private:
  void begin(const Scene& scene) {
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
    if (why.empty() && inside) why = inside_solid;
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

  // ---- the plan -------------------------------------------------------------------------------

  /// Moves the nodes until none is too close or hardly anything gets better: each pass solves all
  /// pairs that were ever too close together, as they are where the nodes are by now.
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

  /// A penetration that should go: of the interfaces asked for, or one that was not there before.
  bool is_task(const Scene& scene, const PairAt& at) const {
    const Contact& contact = scene.contacts[at.contact];
    if (!skipped_.empty() && skipped_.contains(key_of(scene, at))) return false;
    return is_wanted(options_, contact) ||
           (!contact.is_tied_contact() && !baseline_.contains(key_of(scene, at)));
  }

  /// Moves nodes once; false if none can move.
  bool step(const Scene& scene) {
    const std::vector<Wish> wishes = make_wishes(scene);
    hold_unwritable(wishes);
    NodeMoves moves = moves_for(wishes);
    while (!admit(moves)) moves = moves_for(wishes);
    for (const auto& [n, move] : moves) place(n, at(now_, n) + move);
    return !moves.empty();
  }

  NodeMoves moves_for(const std::vector<Wish>& wishes) {
    NodeMoves moves = solve_wishes(wishes, holds_, sweeps);
    keep_within_bounds(moves);
    std::erase_if(moves, [&](const auto& move) {
      return norm(move.second) <= least_move * bounds_.reach_of(move.first);
    });
    return moves;
  }

  std::vector<Wish> make_wishes(const Scene& scene) const {
    std::vector<PairNow> pairs;  // every pair that was ever too close, as it is now
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

  void hold_unwritable(const std::vector<Wish>& wishes) {
    std::vector<NodeIndex> nodes;
    for (const Wish& w : wishes)
      nodes.insert(nodes.end(), w.state.nodes.begin(), w.state.nodes.begin() + w.state.count);
    cells_.look_up(nodes);
    for (const NodeIndex n : nodes)
      if (!cells_.obstacle(n).empty()) hold(n, Hold::not_writable);
  }

  /// Adds to the moved nodes. False: parts would pass their share. These are left alone as a whole
  /// from now on, since a few moved nodes of a part are a dent and no repair.
  bool admit(const NodeMoves& moves) {
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
    for (NodeIndex n = 0; n < holds_.size(); ++n)
      if (mesh_->part_of(n) == part) {
        take_back(n, Hold::share);
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
      if (places[i].at_bound) hold(n, Hold::depth);
      Vec total = places[i].by;
      const double l = norm(total), limit = options_.most_displacement.value_or(l);
      if (l > limit) {
        total = (limit / l) * total;
        hold(n, Hold::displacement);
      }
      // What hardly counts in the move as a whole stays as it was written.
      for (double* component : {&total.x, &total.y, &total.z})
        if (std::abs(*component) <= least_component * norm(total)) *component = 0;
      move = at(start_, n) + total - at(now_, n);
    }
  }

  // ---- what of it is done ---------------------------------------------------------------------

  /// Puts every moved node where its printed coordinates are.
  void print_all() {
    for (const NodeIndex n : std::vector(moved_.begin(), moved_.end()))
      if (!put(n, at(now_, n))) take_back(n, Hold::depth);
  }

  /// Puts a node back where it was.
  void take_back(NodeIndex n, Hold why) {
    if (moved_.erase(n) == 0) return;
    put_back(n);
    if (why == Hold::depth)
      hold(n, why);  // unless something else holds it already
    else
      holds_[n] = static_cast<std::uint8_t>(why);
  }

  /// Takes back moves that harm, or that free nothing, until those that are left do neither.
  void drop_needless() {
    while (!moved_.empty()) {
      const Scene& scene = evaluate();
      std::map<NodeIndex, Hold> bad = harmful_shapes(scene);
      blame(scene, bad);
      if (bad.empty()) add_idle(scene, bad);
      if (bad.empty()) return;
      for (const auto& [n, why] : bad) take_back(n, why);
    }
  }

  /// Moved nodes of elements that cross, are turned, or have shrunk, and of pairs that have changed
  /// sides: lines and lone nodes have no faces that would cross.
  std::map<NodeIndex, Hold> harmful_shapes(const Scene& scene) const {
    std::map<NodeIndex, Hold> out;
    const auto add = [&](NodeIndex n, Hold why) {
      if (moved_.contains(n)) out.emplace(n, why);
    };
    const std::vector<NodeIndex> nodes(moved_.begin(), moved_.end());
    for (const auto& crossing : mesh_->crossings(now_, nodes, options_.threads))
      if (!std::binary_search(crossings_.begin(), crossings_.end(), crossing))
        for (const NodeIndex n : mesh_->nodes_of(crossing)) add(n, Hold::would_cross);
    for (const PairAt& pair : active_) {
      const PairState was = state_of(scene, start_, pair);
      if (!has_direction(was) || dot(state_of(scene, now_, pair).normal, was.normal) >= 0) continue;
      for (int i = 0; i < was.count; ++i)
        add(was.nodes[static_cast<std::size_t>(i)], Hold::would_cross);
    }
    for (const NodeIndex n : mesh_->inverted(start_, now_, nodes)) add(n, Hold::would_invert);
    for (const NodeIndex n : mesh_->shortened(start_, now_, nodes, least_side))
      add(n, Hold::would_shrink);
    return out;
  }

  /// Adds moved nodes that free none of the pairs they were moved for.
  void add_idle(const Scene& scene, std::map<NodeIndex, Hold>& bad) const {
    const StateBefore left(scene, options_);
    for (const NodeIndex n : moved_) {
      const std::vector<PairKey>& pairs = bounds_.pairs_of(n);
      if (std::all_of(pairs.begin(), pairs.end(),
                      [&](const PairKey& pair) { return left.contains(pair); }))
        bad.emplace(n, Hold::depth);
    }
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
        for (const NodeIndex n : moved_) bad.emplace(n, why);
    }
  }

  // ---- the end --------------------------------------------------------------------------------

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
      const auto why = static_cast<Hold>(holds_[n]);
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
    const std::string text =
        fmt::format("{} {:.3g} %", to_string(Hold::share), 100 * options_.most_moved);
    const std::uint32_t part = mesh_->part_of(n);
    const auto it = needed_.find(part);
    if (it == needed_.end()) return text;
    const std::uint32_t all = mesh_->nodes_of_part(part);
    return fmt::format("{}: needs {:.3g} % of part {} ({} of {} nodes); nothing done", text,
                       100 * (static_cast<double>(it->second) / all), model_.parts[part].id,
                       it->second, all);
  }

  std::set<NodeIndex> moved_;
  std::set<PairAt> active_;                        ///< every pair that was ever too close
  DepthBounds bounds_;                             ///< of the nodes in penetrations
  std::map<std::uint32_t, std::uint32_t> needed_;  ///< nodes, of parts that are left alone
  std::size_t first_left_ = 0;
  bool anything_to_do_ = false;
};

}  // namespace

Result<PenetrationFix> move_nodes(const LoadedDeck& context, const MoveNodesOptions& options) {
  return Depenetrator(context, options).run();
}

}  // namespace deck
