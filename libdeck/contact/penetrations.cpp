#include <algorithm>
#include <cmath>

#include "contact/scene_parts.hpp"

namespace deck::detail {
namespace {

/// The solver evaluates candidates in groups of this size; nodes moved by one group are seen by the
/// next (Inacti 3).
constexpr std::size_t group_size = 128;
constexpr double inflation = 1e-8;  // keeps a repaired pair just outside the gap
constexpr std::size_t most_pairs = std::size_t{200} << 20;

bool is_removed(const RemovalLists& removed, const CandidatePair& pair) {
  if (removed.empty()) return false;
  const auto& list = removed[pair.main];
  return std::binary_search(list.begin(), list.end(), pair.secondary);
}

void report_overflow(SceneContext& c, const Contact& contact) {
  if (!c.diagnostics.wants("DK390")) return;
  Diagnostic d;
  d.rule = "DK390";
  d.span = contact.inter->span;
  d.message = "more than " + std::to_string(most_pairs) +
              " pairs are within gap; penetrations of this interface were not evaluated";
  d.reference_behaviour = "it allocates memory for all of them or stops";
  d.help = "check the gap against the size of the model (units?)";
  d.keyword = "/INTER/TYPE" + std::to_string(contact.inter->type);
  d.id = contact.inter->id;
  c.diagnostics.add(std::move(d));
}

NodeArrays arrays(const Coordinates& c) { return {c.x, c.y, c.z}; }

Point3<double> point(const Coordinates& c, NodeIndex n) { return {c.x[n], c.y[n], c.z[n]}; }

struct NodeSegmentArrays {
  std::vector<std::uint32_t> secondary;
  std::vector<double> secondary_gap, secondary_length, secondary_stiffness;
  std::vector<std::array<std::uint32_t, 4>> segments;
  std::vector<double> segment_gap, segment_length, segment_stiffness;

  explicit NodeSegmentArrays(const Contact& contact) {
    const std::size_t n = contact.secondary.size(), m = contact.main.size();
    secondary.reserve(n);
    segments.reserve(m);
    for (const SecondaryNode& s : contact.secondary) {
      secondary.push_back(s.node);
      secondary_gap.push_back(s.gap);
      secondary_length.push_back(s.length);
      secondary_stiffness.push_back(s.multiplier);
    }
    for (const MainSegment& s : contact.main) {
      segments.push_back(s.nodes);
      segment_gap.push_back(s.gap);
      segment_length.push_back(s.length);
      segment_stiffness.push_back(s.stiffness);
    }
  }
  NodeSegmentInput view(const Coordinates& c) const {
    return {arrays(c), secondary,   secondary_gap,  secondary_length, secondary_stiffness,
            segments,  segment_gap, segment_length, segment_stiffness};
  }
};

struct EdgeArrays {
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<double> gap, length, stiffness;
  explicit EdgeArrays(const std::vector<ContactEdge>& list) {
    for (const ContactEdge& e : list) {
      edges.push_back(e.nodes);
      gap.push_back(e.gap);
      length.push_back(e.length);
      stiffness.push_back(e.stiffness);
    }
  }
};

/// Where the secondary nodes of one group of candidates stood before anything in it moved.
class GroupStart {
 public:
  void clear() { seen_.clear(); }
  /// The start of `node`, which is where it stands now unless the group has it already.
  Vec of(const Coordinates& x, NodeIndex node) {
    // Candidates are sorted by secondary node, so the group's last one is nearly always it.
    for (auto it = seen_.rbegin(); it != seen_.rend(); ++it)
      if (it->first == node) return it->second;
    seen_.emplace_back(node, at(x, node));
    return seen_.back().second;
  }

 private:
  std::vector<std::pair<NodeIndex, Vec>> seen_;
};

/// What Inacti and Fpenmax do about one node-segment penetration, in the solver's order.
void act(SceneContext& c, Contact& contact, PenetrationRow& row, GroupStart& start) {
  SecondaryNode& s = contact.secondary[row.secondary];
  const double pene = row.on_surface ? row.depth : row.depth * (1 + inflation);
  if (contact.fpenmax != 0 && pene > contact.fpenmax * row.gap) {
    row.action = PenetrationAction::node_stiffness_zero;
    s.off = true;
    return;
  }
  switch (contact.inacti) {
    case 1:
      row.action = PenetrationAction::node_stiffness_zero;
      s.off = true;
      break;
    case 2:
      row.action = PenetrationAction::segment_stiffness_zero;
      contact.main[row.main].off = true;
      break;
    case 3: {
      row.action = PenetrationAction::node_moved;
      Coordinates& x = c.scene.coordinates;
      const Vec x0 = start.of(x, s.node);
      const Vec moved = at(x, s.node) - x0;
      if (pene > std::sqrt(dot(moved, moved))) {
        row.moved_by = {pene * row.normal[0], pene * row.normal[1], pene * row.normal[2]};
        x.x[s.node] = x0.x + row.moved_by[0];
        x.y[s.node] = x0.y + row.moved_by[1];
        x.z[s.node] = x0.z + row.moved_by[2];
      }
      break;
    }
    case 5:
    case 6:
      row.action = PenetrationAction::gap_reduced;
      row.p0 = contact.inacti == 5 ? pene : pene + 0.05 * (row.gap - pene);
      row.gap0 = row.gap - row.p0;
      row.has_gap0 = true;
      break;
    default:
      break;
  }
}

}  // namespace

void find_penetrations(SceneContext& c, Contact& contact) {
  if (contact.main.empty() || contact.secondary.empty()) return;
  const Coordinates& x = c.scene.coordinates;
  SearchOptions search;
  search.gap = contact.gap_rule;
  search.drad = contact.drad;
  search.threads = c.options.threads;
  search.max_pairs = most_pairs;
  SearchResult found;
  {
    const NodeSegmentArrays lists(contact);
    const bool wide = c.options.candidates || contact.inacti == 3;
    search.margin = wide ? candidate_margin(arrays(x), lists.segments) : 0;
    found = find_node_segment_pairs(lists.view(x), search);
    if (!found.complete && wide) {
      search.margin = 0;
      found = find_node_segment_pairs(lists.view(x), search);
    }
  }
  if (!found.complete) {
    report_overflow(c, contact);
    return;
  }
  const RemovalLists removed = curvilinear_removal(c, contact);
  // The solver measures a whole group of candidates before it acts on any of them.
  GroupStart start;
  std::size_t first_of_group = contact.penetrations.size(), in_group = 0;
  const auto act_on_group = [&] {
    start.clear();
    for (; first_of_group < contact.penetrations.size(); ++first_of_group)
      act(c, contact, contact.penetrations[first_of_group], start);
    in_group = 0;
  };
  for (const CandidatePair& pair : found.pairs) {
    if (is_removed(removed, pair)) {
      ++contact.removed_pairs;
      continue;
    }
    ++contact.candidates;
    if (in_group++ == group_size) {
      act_on_group();
      in_group = 1;
    }
    const SecondaryNode& s = contact.secondary[pair.secondary];
    const MainSegment& m = contact.main[pair.main];
    const std::array<Point3<double>, 4> corners{point(x, m.nodes[0]), point(x, m.nodes[1]),
                                                point(x, m.nodes[2]), point(x, m.nodes[3])};
    const auto closest =
        closest_on_segment<Form::reference>(point(x, s.node), corners, m.nodes[2] == m.nodes[3]);
    const double gap = contact.gap_rule(s.gap, m.gap, s.length, m.length);
    const auto pene = penetration(closest, gap);
    if (!(pene.value > 0)) continue;
    PenetrationRow row;
    row.secondary = pair.secondary;
    row.main = pair.main;
    row.depth = pene.value;
    row.gap = gap;
    row.distance = closest.sub[static_cast<std::size_t>(pene.sub)].distance;
    row.normal = {pene.normal.x, pene.normal.y, pene.normal.z};
    row.on_surface = pene.on_surface;
    row.feature = closest.feature;
    contact.penetrations.push_back(row);
  }
  act_on_group();
}

void find_edge_penetrations(SceneContext& c, Contact& contact) {
  if (contact.main_edges.empty() || contact.secondary_edges.empty()) return;
  const Coordinates& x = c.scene.coordinates;
  SearchResult found;
  {
    const EdgeArrays s(contact.secondary_edges), m(contact.main_edges);
    SearchOptions search;
    search.gap = contact.gap_rule;
    search.drad = contact.drad;
    search.threads = c.options.threads;
    search.max_pairs = most_pairs;
    found = find_edge_edge_pairs(
        {arrays(x), s.edges, s.gap, s.length, s.stiffness, m.edges, m.gap, m.length, m.stiffness},
        search);
  }
  if (!found.complete) {
    report_overflow(c, contact);
    return;
  }
  const RemovalLists removed = curvilinear_edge_removal(c, contact);
  for (const CandidatePair& pair : found.pairs) {
    if (is_removed(removed, pair)) {
      ++contact.removed_pairs;
      continue;
    }
    ++contact.candidates;
    ContactEdge& s = contact.secondary_edges[pair.secondary];
    ContactEdge& m = contact.main_edges[pair.main];
    const auto closest = closest_between_edges<Form::reference>(
        point(x, s.nodes[0]), point(x, s.nodes[1]), point(x, m.nodes[0]), point(x, m.nodes[1]));
    PenetrationRow row;
    row.secondary = pair.secondary;
    row.main = pair.main;
    row.gap = contact.gap_rule(s.gap, m.gap, s.length, m.length);
    row.distance = closest.distance;
    row.depth = row.gap - row.distance;
    if (!(row.depth > 0)) continue;
    row.on_surface = !(row.distance > 0);
    if (!row.on_surface)
      row.normal = {closest.vector.x / row.distance, closest.vector.y / row.distance,
                    closest.vector.z / row.distance};
    row.feature = Feature::edge;
    row.weight_s = closest.weight_s;
    row.weight_m = closest.weight_m;
    // Only Inacti 6 keeps the penetration as it is.
    const double pene = contact.inacti == 6 ? row.depth : row.depth * (1 + inflation);
    const bool deep = pene >= 0.995 * row.gap;
    switch (contact.inacti) {
      case 1:
        row.action = PenetrationAction::edge_stiffness_zero;
        s.off = true;
        break;
      case 2:
        row.action = PenetrationAction::edge_stiffness_zero;
        m.off = true;
        break;
      case 5:
      case 6: {
        if (deep) {
          row.action = PenetrationAction::edge_stiffness_zero;
          s.off = true;
          break;
        }
        row.action = PenetrationAction::gap_reduced;
        const double p = contact.inacti == 5 ? pene : pene + 0.05 * (row.gap - pene);
        s.stored_penetration = std::max(s.stored_penetration, 0.5 * p);
        m.stored_penetration = std::max(m.stored_penetration, 0.5 * p);
        break;
      }
      default:
        break;
    }
    contact.penetrations.push_back(row);
  }
  // The store is per edge, so the gap left is known only now.
  for (PenetrationRow& row : contact.penetrations) {
    if (row.action != PenetrationAction::gap_reduced) continue;
    row.p0 = contact.secondary_edges[row.secondary].stored_penetration +
             contact.main_edges[row.main].stored_penetration;
    row.gap0 = row.gap - row.p0;
    row.has_gap0 = true;
  }
}

}  // namespace deck::detail
