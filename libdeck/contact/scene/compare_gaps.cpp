// Matches each penetration of a scene with the one of an earlier run at its position.
#include "deck/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>

#include "base/shared/words.hpp"
#include "contact/shared/reported.hpp"

namespace deck {
namespace {

/// Share of the gap. Positions of one node are equal; closest points of edges have round-off.
constexpr double same_place = 1e-6;

class PenetrationMatcher {
 public:
  PenetrationMatcher(const GapBaseline& earlier, const Scene& scene, const SceneView& view)
      : earlier_(earlier.rows), scene_(scene), view_(view), taken_(earlier.rows.size(), false) {
    double widest = 0;
    for (const GapBaseline::Row& row : earlier_) widest = std::max(widest, row.gap);
    if (widest > 0) width_ = 2 * same_place * widest;
    for (std::uint32_t i = 0; i < earlier_.size(); ++i) {
      by_ids_.emplace(key(earlier_[i].interface_id, earlier_[i].role, earlier_[i].secondary), i);
      if (earlier_[i].at) by_place_[cell_of(*earlier_[i].at)].push_back(i);
    }
  }

  /// Earlier row of each of the deepest penetrations; no_index if none.
  std::vector<std::uint32_t> match() {
    std::vector<std::uint32_t> found(view_.deepest_per_node.size(), no_index);
    const auto pass = [&](auto&& find) {
      for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i] != no_index) continue;
        found[i] = find(view_.penetrations[view_.deepest_per_node[i]]);
        if (found[i] != no_index) taken_[found[i]] = true;
      }
    };
    pass([&](const NamedPenetration& p) {
      const std::uint32_t i = with_ids(p);
      return i != no_index && (!earlier_[i].at || is_at(p, i)) ? i : no_index;
    });
    pass([&](const NamedPenetration& p) { return at_place(p); });
    pass([&](const NamedPenetration& p) { return with_ids(p); });
    return found;
  }

  const std::vector<bool>& taken() const { return taken_; }

 private:
  using Key = std::tuple<std::int64_t, std::string, std::array<std::int64_t, 2>>;
  static Key key(std::int64_t interface_id, const std::string& role,
                 std::array<std::int64_t, 2> secondary) {
    if (secondary[1] != 0 && secondary[1] < secondary[0]) std::swap(secondary[0], secondary[1]);
    return {interface_id, role, secondary};
  }

  std::uint32_t with_ids(const NamedPenetration& p) const {
    const Contact& c = scene_.contacts[p.contact];
    const auto it = by_ids_.find(key(c.inter->id, to_string(c.role), p.secondary));
    return it == by_ids_.end() || taken_[it->second] ? no_index : it->second;
  }

  bool is_at(const NamedPenetration& p, std::uint32_t i) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (!(std::abs((*earlier_[i].at)[k] - p.at[k]) <= same_place * earlier_[i].gap)) return false;
    return true;
  }

  using Cell = std::array<double, 3>;  // whole numbers of any size
  struct CellHash {
    std::size_t operator()(const Cell& c) const {
      const std::hash<double> hash;
      return (hash(c[0]) * 31 + hash(c[1])) * 31 + hash(c[2]);
    }
  };
  Cell cell_of(const std::array<double, 3>& at) const {
    return {std::floor(at[0] / width_), std::floor(at[1] / width_), std::floor(at[2] / width_)};
  }

  /// Among free rows at this position with this role: first of this interface, then of another.
  std::uint32_t at_place(const NamedPenetration& p) const {
    const Contact& c = scene_.contacts[p.contact];
    const Cell centre = cell_of(p.at);
    std::uint32_t other = no_index;
    for (int k = 0; k < 27; ++k) {
      const Cell cell = {centre[0] + k % 3 - 1, centre[1] + k / 3 % 3 - 1, centre[2] + k / 9 - 1};
      const auto found = by_place_.find(cell);
      if (found == by_place_.end()) continue;
      for (const std::uint32_t i : found->second) {
        const GapBaseline::Row& row = earlier_[i];
        if (taken_[i] || row.role != to_string(c.role) || !is_at(p, i)) continue;
        if (row.interface_id == c.inter->id) return i;
        if (other == no_index) other = i;
      }
    }
    return other;
  }

  const std::vector<GapBaseline::Row>& earlier_;
  const Scene& scene_;
  const SceneView& view_;
  std::vector<bool> taken_;
  std::map<Key, std::uint32_t> by_ids_;
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> by_place_;
  double width_ = 1;  // width of a cell: equal positions lie in it or in a neighbour
};

/// Nodes are matched by id.
void find_lost_ties(const GapBaseline& earlier, const Scene& scene, GapsComparison& out) {
  static const std::set<std::int64_t> none;
  const auto of = [](const auto& all, std::int64_t id) -> const std::set<std::int64_t>& {
    const auto it = all.find(id);
    return it == all.end() ? none : it->second;
  };
  for (const auto& [inter, nodes] : untied_nodes(scene)) {
    const bool listed = earlier.accepts || earlier.untied.contains(inter->id);
    for (const std::int64_t node : nodes)
      if (of(earlier.tied, inter->id).contains(node) ||
          (listed && !of(earlier.untied, inter->id).contains(node)))
        out.lost_ties[inter].push_back(node);
  }
}

/// Interfaces with a contact that was not evaluated: penetrations unknown.
std::set<std::int64_t> undecided_interfaces(const Scene& scene) {
  std::set<std::int64_t> out;
  for (const Contact& c : scene.contacts)
    if (!c.evaluated) out.insert(c.inter->id);
  return out;
}

}  // namespace

const char* to_string(Trend trend) {
  static constexpr const char* words[] = {"new", "worse", "same", "better"};
  return words[static_cast<std::size_t>(trend)];
}

std::uint64_t GapsComparison::count(Trend trend) const {
  return static_cast<std::uint64_t>(
      std::count_if(rows.begin(), rows.end(), [&](const Row& r) { return r.trend == trend; }));
}

std::map<const InterBase*, std::vector<std::int64_t>> untied_nodes(const Scene& scene) {
  std::map<const InterBase*, std::vector<std::int64_t>> out;
  for (const Contact& c : scene.contacts)
    for (const std::uint32_t i : untied_secondary(c))
      out[c.inter].push_back(scene.model->node_id(c.secondary[i].node));
  for (const Tie& tie : scene.ties)
    for (const TiedNode& n : tie.nodes)
      if (n.lost()) out[tie.inter].push_back(scene.model->node_id(n.node));
  return out;
}

GapsComparison compare_gaps(const GapBaseline& earlier, const Scene& scene, const SceneView& view) {
  PenetrationMatcher matcher(earlier, scene, view);
  const std::vector<std::uint32_t> found = matcher.match();
  GapsComparison out;
  out.rows.reserve(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::uint32_t at = view.deepest_per_node[i];
    GapsComparison::Row row{at, Trend::added, found[i]};
    if (found[i] != no_index) {
      const NamedPenetration& p = view.penetrations[at];
      const double depth = scene.contacts[p.contact].penetrations[p.row].depth;
      const double was = earlier.rows[found[i]].depth;
      const bool unbounded = is_unbounded(depth) && is_unbounded(was);
      row.trend = unbounded                        ? Trend::same
                  : depth > was * (1 + same_depth) ? Trend::worse
                  : depth < was * (1 - same_depth) ? Trend::better
                                                   : Trend::same;
    }
    out.rows.push_back(row);
  }
  const std::set<std::int64_t> undecided = undecided_interfaces(scene);
  for (std::uint32_t i = 0; i < earlier.rows.size(); ++i)
    if (!matcher.taken()[i] && !undecided.contains(earlier.rows[i].interface_id))
      out.solved.push_back(i);
  find_lost_ties(earlier, scene, out);
  return out;
}

}  // namespace deck
