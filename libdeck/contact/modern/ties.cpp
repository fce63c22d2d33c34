// Irem_i2 = 1: which initial penetrations a tie (/INTER/TYPE2) of the deck holds already.
#include <algorithm>
#include <map>
#include <set>

#include "contact/modern/parts.hpp"
#include "deck/contact/search.hpp"
#include "deck/keyword/decode.hpp"

namespace deck::detail::modern {
namespace {

using Corners = std::array<NodeIndex, 4>;

struct TiePlace {
  NodeIndex node;
  Corners segment;
};

/// The nearest segment of the surface for every node of the group that has one in reach.
void find_ties(SceneContext& c, const NodeSet& group, const Surface& surface, double reach,
               std::vector<TiePlace>& out) {
  const Coordinates& x = c.scene.coordinates;
  std::vector<Corners> segments;
  for (const Segment& s : surface.segments)
    if (std::find(s.nodes.begin(), s.nodes.end(), no_index) == s.nodes.end())
      segments.push_back(s.nodes);
  if (segments.empty() || group.nodes.empty()) return;
  NodeSegmentInput in;
  in.nodes = {x.x, x.y, x.z};
  in.secondary = group.nodes;
  in.segments = segments;
  SearchOptions options;
  options.threads = c.options.threads;
  // Without a distance on the card: one mean side.
  options.margin =
      reach > 0 ? reach : candidate_margin(in.nodes, segments) / static_cast<double>(0.2F);
  double least = 0;
  NodeIndex last = no_index;
  for (const CandidatePair pair : find_node_segment_pairs(in, options).pairs) {
    const NodeIndex n = group.nodes[pair.secondary];
    const Corners& s = segments[pair.main];
    const double d =
        closest_on_segment<Form::reference>(
            at(x, n), {at(x, s[0]), at(x, s[1]), at(x, s[2]), at(x, s[3])}, s[2] == s[3])
            .distance();
    if (n != last)
      out.push_back({n, s});
    else if (d < least)
      out.back().segment = s;
    if (n != last || d < least) least = d;
    last = n;
  }
}

std::vector<TiePlace> ties_of(SceneContext& c, Selections& selections) {
  std::vector<TiePlace> out;
  if (c.model.deck == nullptr) return out;
  const Deck& deck = *c.model.deck;
  for (const Block& block : deck.blocks) {
    if (block.schema == nullptr || block.schema->keyword != "/INTER/TYPE2") continue;
    const DecodedBlock d = decode(deck, block);
    const auto id = [&](std::string_view field, std::string_view kind) {
      return d.integer(field) + deck.offset_of(block, kind);
    };
    const NodeSet* group = selections.node_group(id("grnd_IDs", "grnod"));
    const Surface* surface = selections.surface(id("surf_IDm", "surf"));
    const Cell* reach = d.find("dsearch");
    if (group == nullptr || surface == nullptr) continue;
    find_ties(c, *group, *surface, reach != nullptr ? working_value(deck, d, *reach) : 0, out);
  }
  return out;
}

}  // namespace

std::vector<bool> held_by_ties(SceneContext& c, Selections& selections, const Sides& s,
                               const std::vector<NodePenetration>& penetrations) {
  std::vector<bool> held(penetrations.size(), false);
  std::multimap<NodeIndex, NodeIndex> pairs;  // tied node, corner of the segment that holds it
  for (const TiePlace& tie : ties_of(c, selections))
    for (const NodeIndex corner : tie.segment) pairs.emplace(tie.node, corner);
  const auto tied_to = [&](NodeIndex node, NodeIndex corner) {
    const auto [begin, end] = pairs.equal_range(node);
    return std::any_of(begin, end, [&](const auto& p) { return p.second == corner; });
  };
  for (std::size_t i = 0; i < penetrations.size(); ++i) {
    const NodeIndex n = s.nodes[penetrations[i].node].node;
    for (const NodeIndex corner : s.faces[penetrations[i].face].nodes)
      if (tied_to(n, corner) || tied_to(corner, n)) held[i] = true;
  }
  return held;
}

}  // namespace deck::detail::modern
