// Pairs of a contact with all inputs of the kernel: stiffness and gap from both sides, reductions
// of the start-up, and values that single effects need.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "contact/shared/closest.hpp"
#include "contact/shared/scene_steps.hpp"
#include "contact/shared/sides.hpp"
#include "cycle/adapter/effect_inputs.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {
namespace {

using deck::detail::at;
using deck::detail::SearchSides;

/// Memory of a pair while forces are evaluated: lists, packed state, results.
constexpr std::size_t bytes_of_a_pair = 512;

/// Nodal normals of the main side: sums of facet normals, weighted by area (Icurv 3) or not (Iadm).
/// In the recorded runs the repeated corner of a triangle counts twice with Iadm.
std::map<NodeIndex, Vec> nodal_normals(const Coordinates& x, const Contact& contact,
                                       bool weighted) {
  std::map<NodeIndex, Vec> sum;
  for (const MainSegment& m : contact.main) {
    Vec n = cross(at(x, m.nodes[2]) - at(x, m.nodes[0]), at(x, m.nodes[3]) - at(x, m.nodes[1]));
    const double length = std::sqrt(dot(n, n));
    if (!weighted && length > 0.0) n = (1.0 / length) * n;
    for (std::size_t c = 0; c < (weighted && m.nodes[2] == m.nodes[3] ? 3u : 4u); ++c)
      sum[m.nodes[c]] = sum[m.nodes[c]] + n;
  }
  return sum;
}

void normals(const Coordinates& x, const Contact& contact, bool weighted, ContactPairs& out) {
  const std::map<NodeIndex, Vec> sum = nodal_normals(x, contact, weighted);
  for (auto& corner : out.normal)
    for (auto& component : corner) component.clear();
  for (const CandidatePair& p : out.at) {
    for (std::size_t c = 0; c < 4; ++c) {
      const Vec& n = sum.at(contact.main[p.main].nodes[c]);
      out.normal[c][0].push_back(n.x);
      out.normal[c][1].push_back(n.y);
      out.normal[c][2].push_back(n.z);
    }
  }
}

/// Largest distance at which the bicubic surface (Icurv 3) can keep a pair beyond its gap.
double bicubic_reach(const Coordinates& x, const Contact& contact) {
  const std::map<NodeIndex, Vec> sum = nodal_normals(x, contact, true);
  double worst = 0.0;
  for (const MainSegment& m : contact.main) {
    if (m.nodes[2] == m.nodes[3]) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec edge = at(x, m.nodes[(k + 1) % 4]) - at(x, m.nodes[k]);
      const double l2 = dot(edge, edge);
      for (const std::size_t end : {k, (k + 1) % 4}) {
        const Vec& n = sum.at(m.nodes[end]);
        const double along2 = dot(n, edge) * dot(n, edge), rest = dot(n, n) * l2 - along2;
        if (rest > 0.0) worst = std::max(worst, along2 * l2 / rest);
      }
    }
  }
  return 0.5 * std::sqrt(worst);
}

/// Extra reach of a curved main side beyond the gap: its surface differs from its facets.
double curvature_reach(const Coordinates& x, const Contact& contact, const ContactCard& card) {
  if (card.kind != ContactKind::node_segment || card.icurv == 0) return 0.0;
  double reach = 0.0;
  for (const MainSegment& m : contact.main) {
    Vec low = at(x, m.nodes[0]), high = low;
    for (const NodeIndex n : m.nodes) {
      const Vec p = at(x, n);
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    reach = std::max({reach, high.x - low.x, high.y - low.y, high.z - low.z});
  }
  return std::max(0.5 * reach, card.icurv == 3 ? bicubic_reach(x, contact) : 0.0);
}

/// Removes pairs that Irem_gap 2 excludes; false if the memory limit does not allow it.
bool remove_pairs(const Scene& scene, const Contact& contact, const SearchSides& sides,
                  std::vector<CandidatePair>& pairs) {
  deck::detail::RemovalLists removed;
  if (!deck::detail::find_removed(scene, contact, sides, removed)) return false;
  std::erase_if(pairs,
                [&](const CandidatePair& p) { return deck::detail::is_removed(removed, p); });
  return true;
}

/// True if the pair penetrates also by the formula of the search, which compares squares for edges.
bool is_search_pair(const Coordinates& x, const Contact& contact, const PenetrationRow& row) {
  if (contact.kind == deck::ContactKind::edge_edge) {
    const auto& s = contact.secondary_edges[row.secondary].nodes;
    const auto& m = contact.main_edges[row.main].nodes;
    return closest_between_edges<Form::reference>(at(x, s[0]), at(x, s[1]), at(x, m[0]),
                                                  at(x, m[1]))
               .distance_squared < row.gap * row.gap;
  }
  const NodeIndex n = contact.secondary[row.secondary].node;
  const std::array<NodeIndex, 4>& m = contact.main[row.main].nodes;
  const std::array<Point3<double>, 4> corners{at(x, m[0]), at(x, m[1]), at(x, m[2]), at(x, m[3])};
  return closest_on_segment<Form::reference>(at(x, n), corners, m[2] == m[3]).distance() < row.gap;
}

/// Penetrations instead of a new search. Valid only if start-up judged all pairs by the formula of
/// the search and no node has moved since. Pairs that start-up switched off are left out.
std::optional<std::vector<CandidatePair>> pairs_from_penetrations(const Scene& scene,
                                                                  const Contact& contact,
                                                                  const Coordinates& x,
                                                                  const SearchOptions& search) {
  const DecisionReport& judged = scene.decisions;
  const bool moved = std::any_of(scene.contacts.begin(), scene.contacts.end(),
                                 [](const Contact& c) { return c.inacti == 3; });
  const bool by_solver = judged.mode == Accuracy::robust || judged.mode == Accuracy::reference;
  if (!scene.judged || !by_solver || moved || !contact.evaluated || &x != &scene.coordinates ||
      search.drad > 0 || search.margin > 0)
    return std::nullopt;
  const bool edges = contact.kind == deck::ContactKind::edge_edge;
  std::vector<CandidatePair> out;
  std::size_t found = 0;
  for (const PenetrationRow& row : contact.penetrations) {
    if (judged.contact_differs > 0 && !is_search_pair(x, contact, row)) continue;
    ++found;
    const bool off =
        edges ? contact.secondary_edges[row.secondary].off || contact.main_edges[row.main].off
              : contact.secondary[row.secondary].off || contact.main[row.main].off;
    if (!off) out.push_back({row.secondary, row.main});
  }
  // An edge pair of the search may have no penetration: the square of its distance was rounded.
  if (edges && found != contact.candidates) return std::nullopt;
  return out;
}

void node_values(const Contact& contact, const ContactCard& card, Model model, ContactPairs& out) {
  auto row = contact.penetrations.begin();
  const bool reduced = card.inacti == 5 || card.inacti == 6;
  out.nodes.triangle.reserve(out.at.size());
  for (const CandidatePair& p : out.at) {
    const SecondaryNode& s = contact.secondary[p.secondary];
    const MainSegment& m = contact.main[p.main];
    out.nodes.node[0].push_back(s.node);
    for (std::size_t c = 0; c < 4; ++c) out.nodes.node[c + 1].push_back(m.nodes[c]);
    out.nodes.triangle.push_back(m.nodes[2] == m.nodes[3]);
    const double ks =
        card.istf < 2 ? s.multiplier : sweep::at(contact.nodal_stiffness, p.secondary, 0);
    out.k0.push_back(ks == 0.0 ? 0.0 : pair_stiffness(card, m.stiffness, ks, model));
    out.gap.push_back(contact.pair_gap(p.secondary, p.main));
    // Both lists are in search order.
    while (row != contact.penetrations.end() && CandidatePair{row->secondary, row->main} < p) ++row;
    const bool known =
        row != contact.penetrations.end() && row->secondary == p.secondary && row->main == p.main;
    out.p0.push_back(reduced && known && row->has_gap0 ? row->p0 : 0.0);
  }
}

void edge_values(const Contact& contact, const ContactCard& card, Model model, ContactPairs& out) {
  const bool reduced = card.inacti == 5 || card.inacti == 6;
  for (const CandidatePair& p : out.at) {
    const ContactEdge& s = contact.secondary_edges[p.secondary];
    const ContactEdge& m = contact.main_edges[p.main];
    for (std::size_t c = 0; c < 2; ++c) {
      out.nodes.node[c].push_back(s.nodes[c]);
      out.nodes.node[c + 2].push_back(m.nodes[c]);
    }
    out.k0.push_back(pair_stiffness(card, m.stiffness, s.stiffness, model));
    out.gap.push_back(contact.pair_gap(p.secondary, p.main));
    out.p0.push_back(reduced ? sweep::at(contact.secondary_stored, p.secondary, 0) +
                                   sweep::at(contact.main_stored, p.main, 0)
                             : 0.0);
  }
}

}  // namespace

void renew_normals(const deck::Contact& contact, const ContactCard& card, const Coordinates& x,
                   ContactPairs& pairs) {
  if (card.kind == ContactKind::node_segment && (card.icurv == 3 || card.iadm != 0))
    normals(x, contact, card.icurv == 3, pairs);
}

ContactPairs make_pairs(const Scene& scene, const deck::Contact& contact, const ContactCard& card,
                        Model model, int threads, const PairSearch& where) {
  const Coordinates& x = where.at != nullptr ? *where.at : scene.coordinates;
  ContactPairs out;
  out.nodes.kind = card.kind;
  if (contact.dropped) return out;
  SearchOptions search;
  search.gap = contact.gap_rule;
  search.drad = card.ithe > 0 ? card.drad : 0.0;
  search.margin = curvature_reach(x, contact, card) + where.margin;
  search.threads = threads;
  search.max_pairs = scene.limits.pair_bytes / bytes_of_a_pair;
  if (auto known = pairs_from_penetrations(scene, contact, x, search)) {
    out.complete = known->size() <= search.max_pairs;
    if (out.complete) out.at = std::move(*known);
  } else {
    const SearchSides sides(contact, SearchSides::Off::left_out, threads);
    SearchResult found = sides.find(x, search);
    out.complete = found.complete;
    out.at = std::move(found.pairs);
    if (!remove_pairs(scene, contact, sides, out.at)) {
      out.complete = false;
      out.at.clear();
    }
  }
  if (out.complete && !where.always.empty()) {
    out.at.insert(out.at.end(), where.always.begin(), where.always.end());
    std::sort(out.at.begin(), out.at.end());
    out.at.erase(std::unique(out.at.begin(), out.at.end()), out.at.end());
  }
  if (card.kind == ContactKind::edge_edge) {
    edge_values(contact, card, model, out);
    if (card.ithe > 0) detail::edge_widths(scene, contact, out);
    if (card.fric_id) detail::pair_friction(scene, contact, out);
    return out;
  }
  node_values(contact, card, model, out);
  if (card.ithe > 0) detail::node_areas(scene, contact, out);
  renew_normals(contact, card, x, out);
  if (card.fric_id) detail::pair_friction(scene, contact, out);
  return out;
}

}  // namespace deck::cycle
