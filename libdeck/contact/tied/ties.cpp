// Ties of a scene: sides of every /INTER/TYPE2, search distance, and the steps in order.
#include "deck/contacts.hpp"

#include <algorithm>
#include <cmath>

#include "contact/scene/complete_contacts.hpp"
#include "contact/shared/closest.hpp"
#include "contact/shared/tie_steps.hpp"
#include "deck/text.hpp"

namespace deck::detail {
namespace {

/// Segments of a surface in the solver's order of corners.
std::vector<Corners> segments_of(SceneContext& c, std::int64_t surface) {
  std::vector<Corners> out;
  const auto outline = c.model.selections->outline(surface);
  if (!outline) return out;
  Contact room;
  room.type = 2;
  make_main_segments(c, outline->segments, room);
  for (const MainSegment& m : room.main) out.push_back(m.nodes);
  return out;
}

void set_sides(SceneContext& c, Tie& tie) {
  const InterType2& i = *tie.inter;
  // If the surface is missing, the node group is used (1725).
  if (is_penalty(tie.spotflag) && c.model.selections->outline(i.surf_IDs.value)) {
    join_surfaces(c.scene.coordinates, i.dsearch.value, segments_of(c, i.surf_IDm.value),
                  segments_of(c, i.surf_IDs.value), tie);
    return;
  }
  tie.main = segments_of(c, i.surf_IDm.value);
  const NodeSet* group = c.model.selections->node_group(i.grnd_IDs.value);
  if (group == nullptr) return;
  for (const NodeIndex n : group->nodes)
    if (n != no_index) tie.nodes.push_back({n});
  std::sort(tie.nodes.begin(), tie.nodes.end(),
            [](const TiedNode& a, const TiedNode& b) { return a.node < b.node; });
  tie.nodes.erase(
      std::unique(tie.nodes.begin(), tie.nodes.end(),
                  [](const TiedNode& a, const TiedNode& b) { return a.node == b.node; }),
      tie.nodes.end());
}

/// Reason why the search is impossible; empty if it is possible.
std::string reason_against_search(SceneContext& c, const Tie& tie) {
  if (!c.model.selections->complete()) return "members of its sides were left out";
  if (c.model.two_dimensional) return "the deck is two-dimensional";
  if (tie.inter->Isearch.value != 1 && tie.inter->Isearch.value != 2)
    return "Isearch is neither 1 nor 2";
  if (std::string cell = unusable_cell(*c.model.deck, *tie.inter); !cell.empty()) return cell;
  const Coordinates& x = c.scene.coordinates;
  for (const TiedNode& n : tie.nodes)
    if (!is_finite(at(x, n.node)))
      return "a secondary node has a coordinate that is no finite number";
  for (const Corners& s : tie.main)
    for (const NodeIndex n : s)
      if (!is_finite(at(x, n))) return "a main node has a coordinate that is no finite number";
  return {};
}

/// Why a thickness at its nodes is not known; empty: all are.
std::string unread_thickness(const std::map<NodeIndex, std::string>& unread, const Tie& tie) {
  std::string why;
  const auto look = [&](NodeIndex n) {
    if (const auto it = unread.find(n); it != unread.end()) why = it->second;
  };
  for (const TiedNode& n : tie.nodes) look(n.node);
  for (const Corners& s : tie.main) std::for_each(s.begin(), s.end(), look);
  return why;
}

Tie find_tie(SceneContext& c, TieThickness& thickness, const InterType2& inter) {
  Tie tie;
  tie.inter = &inter;
  tie.spotflag = inter.Spotflag.value == 5 ? 0 : static_cast<int>(inter.Spotflag.value);
  tie.ignore = inter.Ignore.value == 1000 ? 0 : static_cast<int>(inter.Ignore.value);
  set_sides(c, tie);
  tie.not_evaluated = reason_against_search(c, tie);
  if (!tie.not_evaluated.empty()) return tie;
  if (inter.Isearch.value == 1) {
    search_ties_by_nearest_node(c.scene.coordinates, tie);
  } else {
    const double d = inter.dsearch.value;
    const bool of_pairs = tie.ignore >= 4 || (tie.ignore >= 2 && d == 0);
    if (!of_pairs) tie.search_distance = d != 0 ? d : mean_side(c.scene.coordinates, tie.main);
    if (of_pairs) tie.not_evaluated = unread_thickness(thickness.unread, tie);
    if (!tie.not_evaluated.empty()) return tie;
    search_ties(c, thickness, tie);
  }
  for (TiedNode& n : tie.nodes) n.penalty = n.tied && (tie.spotflag == 25 || tie.spotflag == 26);
  return tie;
}

}  // namespace

double mean_side(const Coordinates& x, const std::vector<Corners>& segments) {
  double sum = 0;
  const auto square = [&](NodeIndex a, NodeIndex b) {
    const Vec d = at(x, b) - at(x, a);
    return dot(d, d);
  };
  for (const Corners& c : segments)
    sum += square(c[0], c[1]) + square(c[0], c[3]) + square(c[1], c[2]) + square(c[2], c[3]);
  return segments.empty() ? 0 : std::sqrt(sum / (4.0 * static_cast<double>(segments.size())));
}

const std::vector<Tie>& ties_of(SceneContext& c) {
  if (c.ties) return *c.ties;
  // Findings about sides are reported only if the caller wants ties.
  Findings unasked;
  SceneContext own{c.model, c.connectivity, c.scene, c.options.ties ? c.findings : unasked,
                   c.options};
  std::vector<Tie> out;
  if (!c.scene.interfaces->type2.empty()) {
    TieThickness thickness(own);
    for (const InterType2& inter : c.scene.interfaces->type2)
      out.push_back(find_tie(own, thickness, inter));
    resolve_tie_conflicts(own, out);
  }
  return c.ties.emplace(std::move(out));
}

std::vector<Tie> wanted_ties(SceneContext& c) {
  const std::vector<std::int64_t>& only = c.options.only;
  std::vector<Tie> out;
  for (const Tie& tie : ties_of(c))
    if (only.empty() || std::find(only.begin(), only.end(), tie.inter->id) != only.end())
      out.push_back(tie);
  return out;
}

bool moves_nodes(const Interfaces& interfaces) {
  bool found = false;
  interfaces.for_each_list([&](const auto& list) {
    for (const auto& inter : list) found = found || inter.Inacti.value == 3;
  });
  return found;
}

TiedNodes tied_nodes_of(const Tie& tie) {
  TiedNodes out;
  out.block = tie.inter->block;
  out.spotflag = tie.spotflag;
  out.rim = tie.inter->Iproj.value == 1;
  out.evaluated = tie.not_evaluated.empty();
  for (const TiedNode& n : tie.nodes)
    if (n.tied) out.rows.push_back({n.node, tie.main[n.segment], n.s, n.t, n.penalty});
  return out;
}

std::vector<Tie> ties_of(const Scene& scene, const SceneOptions& options) {
  Scene room;
  room.model = scene.model;
  room.interfaces = scene.interfaces;
  room.coordinates = scene.coordinates;
  Connectivity connectivity(*scene.model);
  Findings known;  // of the sides; references of the cards are checked elsewhere
  SceneContext context{*scene.model, connectivity, room, known, options};
  return wanted_ties(context);
}

}  // namespace deck::detail
