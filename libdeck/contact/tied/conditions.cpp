// Interaction of ties with each other and with other conditions, in the solver's order.
#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "contact/shared/tie_steps.hpp"
#include "deck/keyword.hpp"

namespace deck::detail {
namespace {

bool is_mixed(int spotflag) { return spotflag == 27 || spotflag == 28; }

using NodeFlags = std::vector<bool>;

/// Removes ties that an earlier interface with Spotflag 27 or 28 has made.
void remove_repeated(std::vector<Tie>& ties) {
  struct Known {
    std::vector<NodeIndex> corners;
    std::int64_t interface_id;
  };
  std::map<NodeIndex, std::vector<Known>> known;
  for (Tie& tie : ties) {
    if (!is_mixed(tie.spotflag) || tie.inter->surf_IDs.value != 0) continue;
    std::map<std::int64_t, std::uint32_t> common;
    for (TiedNode& n : tie.nodes) {
      if (!n.tied) continue;
      const std::vector<NodeIndex> corners = corner_set(tie.main[n.segment]);
      std::vector<Known>& earlier = known[n.node];
      const auto same = std::find_if(earlier.begin(), earlier.end(),
                                     [&](const Known& k) { return k.corners == corners; });
      if (same == earlier.end()) {
        earlier.push_back({corners, tie.inter->id});
        continue;
      }
      n.tied = false;
      n.removed_by = 1630;
      ++common[same->interface_id];
    }
    for (const auto& [id, count] : common) tie.repeated.push_back({id, count});
  }
}

/// Calls f(corner) for the corners of all segments in use.
template <class F>
void for_each_main_node(const Tie& tie, F&& f) {
  for (const TiedNode& n : tie.nodes)
    if (n.tied)
      for (const NodeIndex corner : tie.main[n.segment]) f(corner);
}

/// Main nodes that a tie without penalty has as secondary nodes: solver error 556.
void find_main_and_tied(std::size_t nodes, std::vector<Tie>& ties) {
  NodeFlags tied(nodes, false);
  for (const Tie& tie : ties)
    if (!is_penalty(tie.spotflag))
      for (const TiedNode& n : tie.nodes)
        if (n.tied) tied[n.node] = true;
  for (Tie& tie : ties) {
    for_each_main_node(tie, [&](NodeIndex n) {
      if (tied[n]) tie.main_and_tied.push_back(n);
    });
    auto& list = tie.main_and_tied;
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

/// Conditions that exclude a kinematic tie: the field with the nodes, a group or one node.
struct NodeCondition {
  std::string_view keyword, field;
  bool group;
};
constexpr NodeCondition other_conditions[] = {
    {"/BCS", "grnod_ID", true},        {"/RBODY", "grnd_ID", true},
    {"/IMPVEL", "grnod_ID", true},     {"/IMPACC", "grnod_ID", true},
    {"/IMPDISP", "Gnod_id", true},     {"/RLINK", "grnd_ID", true},
    {"/RBE2", "grnd_ID", true},        {"/RBE2", "node_ID", false},
    {"/RBE3", "node_IDr", false},      {"/RBE3", "grnd_ID", true},
    {"/CYL_JOINT", "node_ID1", false}, {"/CYL_JOINT", "node_ID2", false},
    {"/CYL_JOINT", "grnd_ID", true},   {"/RIVET", "node_ID1", false},
    {"/RIVET", "node_ID2", false}};

NodeFlags conditioned_nodes(const Model& model) {
  NodeFlags out(model.nodes.size(), false);
  const Deck& deck = *model.deck;
  for (const Block& block : deck.blocks) {
    if (block.schema == nullptr) continue;
    const auto matches = [&](const NodeCondition& c) { return block.schema->keyword == c.keyword; };
    if (std::none_of(std::begin(other_conditions), std::end(other_conditions), matches)) continue;
    const DecodedBlock decoded = decode(deck, block);
    for (const NodeCondition& c : other_conditions) {
      if (!matches(c)) continue;
      for (const DecodedCard& card : decoded.cards)
        for (const Cell& cell : card.cells) {
          if (cell.field->name != c.field || cell.integer == 0) continue;
          const std::int64_t id = cell.integer + deck.offset_of(block, c.group ? "grnod" : "node");
          if (!c.group) {
            if (const NodeIndex n = model.find_node(id); n != no_index) out[n] = true;
          } else if (const NodeSet* set = model.selections->node_group(id)) {
            for (const NodeIndex n : set->nodes)
              if (n != no_index) out[n] = true;
          }
        }
    }
  }
  return out;
}

/// A condensed mid node and the ends of its edge.
struct MidNode {
  NodeIndex node, ends[2];
};

/// Mid nodes of 10-node tetrahedra whose property condenses them (Itetra10 = 2).
std::vector<MidNode> condensed_mid_nodes(const Model& model) {
  std::vector<MidNode> out;
  std::vector<signed char> condensed(model.properties.size(), -1);
  const auto is_condensed = [&](std::uint32_t p) {
    if (condensed[p] < 0) {
      const Block* block = model.properties[p].block;
      condensed[p] = block != nullptr && decode(*model.deck, *block).integer("Itetra10") == 2;
    }
    return condensed[p] == 1;
  };
  // Slots of a tetrahedron's corners; corners of the edges of its mid nodes.
  constexpr std::size_t slot[] = {0, 2, 5, 4};
  constexpr std::size_t edge[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  const Elements& solids = model.solid8;
  for (std::uint32_t e = 0; e < solids.size(); ++e) {
    if (solids.shape[e] != SolidShape::tetra10 || solids.extra[e] == no_index) continue;
    const std::uint32_t part = solids.part[e];
    if (part == no_index || model.parts[part].prop == no_index) continue;
    if (!is_condensed(model.parts[part].prop)) continue;
    for (std::size_t k = 0; k < 6; ++k) {
      const NodeIndex n = solids.extra_nodes[solids.extra[e] + k];
      if (n != no_index)
        out.push_back({n, {solids.of(e)[slot[edge[k][0]]], solids.of(e)[slot[edge[k][1]]]}});
    }
  }
  return out;
}

void untie_mid_nodes(const Model& model, std::vector<Tie>& ties, NodeFlags& penalty) {
  const std::vector<MidNode> mids = condensed_mid_nodes(model);
  if (mids.empty()) return;
  std::map<NodeIndex, const MidNode*> at;
  for (const MidNode& m : mids) at.emplace(m.node, &m);
  for (Tie& tie : ties) {
    if (tie.spotflag == 25 || tie.spotflag == 26) continue;
    std::set<NodeIndex> tied;
    for (const TiedNode& n : tie.nodes)
      if (n.tied) tied.insert(n.node);
    if (!is_mixed(tie.spotflag)) continue;
    for (const TiedNode& n : tie.nodes) {
      const auto mid = at.find(n.node);
      if (!n.tied || mid == at.end()) continue;
      const auto& ends = mid->second->ends;
      if (tied.contains(ends[0]) && tied.contains(ends[1])) continue;
      penalty[n.node] = true;
      for (const NodeIndex end : ends)
        if (tied.contains(end)) penalty[end] = true;
    }
  }
  for (Tie& tie : ties) {
    if (tie.spotflag == 25 || tie.spotflag == 26) continue;
    for (TiedNode& n : tie.nodes) {
      if (!n.tied || !at.contains(n.node)) continue;
      if (is_mixed(tie.spotflag) && penalty[n.node]) continue;
      n.tied = false;
      n.removed_by = 1209;
    }
  }
}

/// Ties with Spotflag 27 and 28 become penalties if the node has another condition.
void find_penalties(const Model& model, std::vector<Tie>& ties) {
  if (std::none_of(ties.begin(), ties.end(), [](const Tie& t) { return is_mixed(t.spotflag); })) {
    NodeFlags none(model.nodes.size(), false);
    untie_mid_nodes(model, ties, none);
    return;
  }
  NodeFlags penalty = conditioned_nodes(model), seen(model.nodes.size(), false);
  for (const Tie& tie : ties) {
    const int f = tie.spotflag;
    for (const TiedNode& n : tie.nodes) {
      if (!n.tied) continue;
      if (is_mixed(f)) {
        if (seen[n.node]) penalty[n.node] = true;
        seen[n.node] = true;
      } else if (!is_penalty(f)) {
        penalty[n.node] = true;
      }
    }
    if (f == 0 || f == 1 || is_mixed(f))
      for_each_main_node(tie, [&](NodeIndex n) { penalty[n] = true; });
  }
  untie_mid_nodes(model, ties, penalty);
  for (Tie& tie : ties)
    if (is_mixed(tie.spotflag))
      for (TiedNode& n : tie.nodes) n.penalty = n.tied && penalty[n.node];
}

}  // namespace

void resolve_tie_conflicts(SceneContext& c, std::vector<Tie>& ties) {
  remove_repeated(ties);
  find_main_and_tied(c.model.nodes.size(), ties);
  find_penalties(c.model, ties);
}

}  // namespace deck::detail
