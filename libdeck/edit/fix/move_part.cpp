// Strategy move-part: tries translations of connected parts and keeps the one that frees the most
// pairs.
// Join parts into groups; collect per group the ways out of its penetrations (ways_out.hpp); rank
// translations that move against none of them; move, evaluate and verify the best `most_tried`.
// Cost: one evaluation of the contacts per translation.
#include "edit/shared/depenetrate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "base/shared/words.hpp"
#include "edit/fix/movable.hpp"
#include "model/shared/families.hpp"
#include "model/shared/kinematics.hpp"

namespace deck {
namespace {

using namespace detail;

// ---- parts that hang together ------------------------------------------------------------------

/// Groups of parts that only move together: a forest over the nodes. Joined: nodes of an element,
/// of a rigid body, rigid element or joint, of a /INTER/TYPE2 tie and its segment, and pairs of
/// tied contacts, unless FixOptions::ties treats these as penetrations.
class PartGroups {
 public:
  PartGroups(const LoadedDeck& context, const Scene& scene, const FixOptions& options)
      : model_(context.model()), above_(model_.nodes.size()) {
    std::iota(above_.begin(), above_.end(), 0U);
    join_elements();
    join_conditions(context);
    join_contacts(scene, options);
    for (NodeIndex& n : above_) n = top(n);
  }

  std::uint32_t of(NodeIndex n) const { return above_[n]; }
  /// Ascending.
  std::vector<NodeIndex> nodes_of(std::uint32_t group) const {
    std::vector<NodeIndex> out;
    for (NodeIndex n = 0; n < above_.size(); ++n)
      if (above_[n] == group) out.push_back(n);
    return out;
  }
  /// "part 2", "parts 2, 3 and 4 (they hang together)"
  std::string name_of(std::uint32_t group) const {
    std::set<std::int64_t> ids;
    for (const ElementKind kind : all_families) {
      const Elements& family = model_.family(kind);
      for (std::size_t e = 0; e < family.size(); ++e)
        if (const NodeIndex n = family.of(e)[0];
            n != no_index && above_[n] == group && family.part[e] != no_index)
          ids.insert(model_.parts[family.part[e]].id);
    }
    if (ids.empty()) return "node " + std::to_string(model_.node_id(group));
    if (ids.size() == 1) return "part " + std::to_string(*ids.begin());
    return "parts " + list_text({ids.begin(), ids.end()}) + " (they hang together)";
  }

 private:
  NodeIndex top(NodeIndex n) {
    while (above_[n] != n) n = above_[n] = above_[above_[n]];
    return n;
  }
  void join(NodeIndex a, NodeIndex b) {
    if (a == no_index || b == no_index) return;
    a = top(a);
    b = top(b);
    above_[std::max(a, b)] = std::min(a, b);
  }

  void join_elements() {
    for (const ElementKind kind : all_families) {
      const Elements& family = model_.family(kind);
      for (std::size_t e = 0; e < family.size(); ++e) {
        const NodeIndex* const nodes = family.of(e);
        const NodeIndex* const last = nodes + family.width;
        const NodeIndex* const first =
            std::find_if(nodes, last, [](NodeIndex n) { return n != no_index; });
        for (const NodeIndex* n = first; n != last; ++n) join(*first, *n);
      }
    }
    const Elements& solids = model_.solid8;  // their mid nodes
    for (std::size_t e = 0; e < solids.extra.size(); ++e) {
      if (solids.extra[e] == no_index) continue;
      const std::size_t first = solids.extra[e],
                        count = static_cast<std::size_t>(extra_node_count(solids.shape[e]));
      for (std::size_t k = first; k < std::min(first + count, solids.extra_nodes.size()); ++k)
        join(solids.of(e)[0], solids.extra_nodes[k]);
    }
  }

  /// Conditions that fix nodes relative to each other.
  void join_conditions(const LoadedDeck& context) {
    using enum ConditionType;
    constexpr ConditionType joining[] = {rlink, rbe2, rbe3, rbody, cyl_joint};
    const Kinematics& kinematics = context.kinematics();
    std::vector<NodeIndex> first(kinematics.sources.size(), no_index);
    for (NodeIndex n = 0; n + 1 < kinematics.first.size(); ++n)
      for (const std::uint32_t source : kinematics.of(n)) {
        const ConditionType type = kinematics.sources[source].type;
        if (std::find(std::begin(joining), std::end(joining), type) == std::end(joining)) continue;
        if (first[source] == no_index) first[source] = n;
        join(first[source], n);
      }
    for (const Tie& tie : context.ties())
      for (const TiedNode& n : tie.nodes)
        if (n.tied && n.segment != no_index)
          for (const NodeIndex corner : tie.main[n.segment]) join(n.node, corner);
  }

  void join_contacts(const Scene& scene, const FixOptions& options) {
    for (const Contact& contact : scene.contacts) {
      if (!contact.is_tied_contact() || is_wanted(options, contact)) continue;
      for (const PenetrationRow& row : contact.penetrations)
        if (contact.kind == ContactKind::node_segment)
          join(contact.secondary[row.secondary].node, contact.main[row.main].nodes[0]);
        else
          join(contact.secondary_edges[row.secondary].nodes[0],
               contact.main_edges[row.main].nodes[0]);
    }
  }

  const Model& model_;
  std::vector<NodeIndex> above_;
};

// ---- translations ------------------------------------------------------------------------------

constexpr std::size_t most_tried = 12;  // translations that are evaluated
constexpr double usual_bound = 2;       // times the deepest penetration

class PartMover : MovableDeck {
 public:
  PartMover(const LoadedDeck& context, const MoveNodesOptions& options)
      : MovableDeck(context, options) {}

  Result<PenetrationFix> run() {
    const auto before = prepare();
    if (!before) return before.error();
    groups_.emplace(context_, *before, options_);
    fix_.strategy = "move-part";
    collect(*before);
    try_all(*before);
    return make_result(*before, moved_, [this](const Scene& scene, const PairAt& at) {
      return RefusalReason{reason_of(key_of(scene, at)), "deck fix DECK"};
    });
  }

 private:
  /// A translation of a group to be tried.
  struct GroupMove {
    std::uint32_t group = 0;
    Translation translation;
  };

  /// Collects penetrations as ways out for the groups on both sides.
  void collect(const Scene& scene) {
    for (std::uint32_t c = 0; c < scene.contacts.size(); ++c) {
      const Contact& contact = scene.contacts[c];
      const bool wanted = is_wanted(options_, contact);
      if (contact.is_tied_contact() && !wanted) continue;
      const std::vector<bool> inside = inside_solids(scene, c);
      for (const PenetrationRow& row : contact.penetrations) {
        deepest_ = std::max(deepest_, wanted ? row.depth : 0);
        add(scene, {c, row.secondary, row.main}, row, wanted, inside[row.secondary]);
      }
    }
  }

  void add(const Scene& scene, const PairAt& at, const PenetrationRow& row, bool wanted,
           bool inside) {
    const PairState state = state_of(scene, now_, at);
    const PairKey key = key_of(scene, at);
    std::string why = why_not_movable(*mesh_, now_, state);
    if (why.empty() && inside) why = inside_solid;
    const std::uint32_t a = groups_->of(state.nodes[0]);
    const std::uint32_t b =
        groups_->of(state.nodes[static_cast<std::size_t>(state.secondary_count)]);
    if (why.empty() && a == b)
      why = "both sides belong to " + groups_->name_of(a) + ": no translation parts them";
    if (!why.empty()) {
      skipped_[key] = std::move(why);
      return;
    }
    const Vec out = way_out(scene, *mesh_, now_, at, state);
    const double needs = row.depth + options_.clearance * row.gap;
    ways_[a].push_back({out, needs, wanted});
    ways_[b].push_back({-1.0 * out, needs, wanted});
    sides_[key] = {a, b};
  }

  double bound() const { return options_.most_displacement.value_or(usual_bound * deepest_); }

  /// Reason why a group may not move; empty if it may.
  std::string not_clean_reason(std::uint32_t group) {
    const std::vector<NodeIndex> nodes = groups_->nodes_of(group);
    for (const NodeIndex n : nodes)
      if (pinned_[n] != 0)
        return groups_->name_of(group) + ": node " + std::to_string(model_.node_id(n)) + ": " +
               to_string(static_cast<PinReason>(pinned_[n]));
    cells_.find_lines(nodes);
    for (const NodeIndex n : nodes)
      if (!cells_.obstacle(n).empty())
        return groups_->name_of(group) + ": node " + std::to_string(model_.node_id(n)) + ": " +
               cells_.obstacle(n);
    return {};
  }

  std::vector<GroupMove> candidates() {
    std::vector<GroupMove> out;
    for (const auto& [group, ways] : ways_) {
      if (std::none_of(ways.begin(), ways.end(), [](const WayOut& w) { return w.wanted; }))
        continue;
      if (std::string why = not_clean_reason(group); !why.empty()) {
        obstacles_[group] = std::move(why);
        continue;
      }
      for (const Translation& t : translations_for(ways, bound(), most_tried))
        out.push_back({group, t});
    }
    std::map<std::uint32_t, std::size_t> sizes;
    for (const GroupMove& c : out) sizes[c.group] = groups_->nodes_of(c.group).size();
    std::stable_sort(out.begin(), out.end(), [&](const GroupMove& a, const GroupMove& b) {
      if (a.translation.frees != b.translation.frees)
        return a.translation.frees > b.translation.frees;
      const double la = norm(a.translation.by), lb = norm(b.translation.by);
      if (std::abs(la - lb) > 1e-9 * la) return la < lb;
      return sizes[a.group] < sizes[b.group];
    });
    if (out.size() > most_tried) out.resize(most_tried);
    return out;
  }

  /// False if a coordinate does not fit.
  bool move(const std::vector<NodeIndex>& nodes, const Vec& by) {
    const bool all = std::all_of(nodes.begin(), nodes.end(),
                                 [&](NodeIndex n) { return put(n, at(start_, n) + by); });
    if (!all) why_not_ = "a new coordinate does not fit into its cell";
    return all;
  }

  static std::size_t wanted_pairs(const Scene& scene, const FixOptions& options) {
    std::size_t pairs = 0;
    for (const auto& [id, count] : count_interfaces(scene, options)) pairs += count.pairs;
    return pairs;
  }

  /// Number of remaining pairs at the present positions; nullopt if the move does harm, with the
  /// reason in why_not_.
  std::optional<std::size_t> left_now(const std::vector<NodeIndex>& nodes) {
    for (const auto& crossing : mesh_->crossings(now_, nodes, options_.threads))
      if (!std::binary_search(crossings_.begin(), crossings_.end(), crossing)) {
        why_not_ = "it would cross elements";
        return std::nullopt;
      }
    const Scene& scene = evaluate();
    if (const auto harm = harm_text(model_, scene, baseline_.harm(scene))) {
      why_not_ = *harm;
      return std::nullopt;
    }
    return wanted_pairs(scene, options_);
  }

  void try_all(const Scene& before) {
    std::size_t best = wanted_pairs(before, options_), done = 0;
    if (best == 0) return;
    const std::vector<GroupMove> all = candidates();
    for (const GroupMove& candidate : all) {
      if (options_.progress) options_.progress("moving parts", done++, all.size());
      const std::vector<NodeIndex> nodes = groups_->nodes_of(candidate.group);
      if (move(nodes, candidate.translation.by))
        if (const auto left = left_now(nodes); left && *left < best) {
          best = *left;
          chosen_ = candidate;
        }
      for (const NodeIndex n : nodes) put_back(n);
      if (best == 0) break;
    }
    if (!chosen_) return;
    moved_ = groups_->nodes_of(chosen_->group);
    move(moved_, chosen_->translation.by);
  }

  std::string reason_of(const PairKey& key) const {
    if (const auto it = skipped_.find(key); it != skipped_.end()) return it->second;
    const auto sides = sides_.find(key);
    if (sides == sides_.end()) return "it appeared when another one was freed";
    const auto a = obstacles_.find(sides->second.first), b = obstacles_.find(sides->second.second);
    if (a != obstacles_.end() && b != obstacles_.end()) return a->second + "; " + b->second;
    if (chosen_)
      return "the translation of " + groups_->name_of(chosen_->group) +
             " that frees the most leaves it";
    if (!why_not_.empty()) return "nothing done: with a translation " + why_not_;
    return "no translation within the bound frees it (--max-displacement)";
  }

  std::optional<PartGroups> groups_;
  std::map<std::uint32_t, std::vector<WayOut>> ways_;                 ///< by group
  std::map<PairKey, std::pair<std::uint32_t, std::uint32_t>> sides_;  ///< groups of both sides
  std::map<std::uint32_t, std::string> obstacles_;  ///< by group: reason why it may not move
  double deepest_ = 0;
  std::optional<GroupMove> chosen_;
  std::vector<NodeIndex> moved_;
  std::string why_not_;  ///< reason of the last harmful translation
};

}  // namespace

Result<PenetrationFix> move_part(const LoadedDeck& context, const MoveNodesOptions& options) {
  return PartMover(context, options).run();
}

}  // namespace deck
