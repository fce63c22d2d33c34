// Irem_i2 = 1: which pairs of a contact a tie (/INTER/TYPE2) of the deck holds already.
#include <algorithm>
#include <cmath>

#include "cycle/contact_run.hpp"
#include "deck/contact/closest.hpp"
#include "deck/contact/search.hpp"
#include "deck/keyword/decode.hpp"
#include "deck/model/selection.hpp"

namespace deck::cycle::detail {
namespace {

using Corners = std::array<NodeIndex, 4>;

/// A tied node and the main segment it is tied to.
struct Tie {
  NodeIndex node;
  Corners segment;
};

/// Search distance of a tie without one on its card: root mean square of the edges.
double mean_edge(const deck::Nodes& nodes, const std::vector<Corners>& segments) {
  double sum = 0.0;
  for (const Corners& s : segments)
    for (std::size_t k = 0; k < 4; ++k) {
      const NodeIndex a = s[k], b = s[(k + 1) % 4];
      const double d[] = {nodes.x[a] - nodes.x[b], nodes.y[a] - nodes.y[b],
                          nodes.z[a] - nodes.z[b]};
      sum += d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    }
  return segments.empty() ? 0.0 : std::sqrt(sum / (4.0 * static_cast<double>(segments.size())));
}

/// The nearest segment within the search distance for every node that has one.
void find_ties(const deck::Nodes& nodes, const NodeSet& group, const Surface& surface,
               double distance, int threads, std::vector<Tie>& out) {
  std::vector<Corners> segments;
  for (const Segment& s : surface.segments) segments.push_back(s.nodes);
  NodeSegmentInput input;
  input.nodes = {nodes.x, nodes.y, nodes.z};
  input.secondary = group.nodes;
  input.segments = segments;
  SearchOptions options;
  options.threads = threads;
  options.margin = distance > 0.0 ? distance : mean_edge(nodes, segments);
  const SearchResult near = find_node_segment_pairs(input, options);
  const auto point = [&](NodeIndex n) {
    return Point3<double>{nodes.x[n], nodes.y[n], nodes.z[n]};
  };
  double least = 0.0;
  for (std::size_t i = 0; i < near.pairs.size(); ++i) {
    const CandidatePair pair = near.pairs[i];
    const NodeIndex n = group.nodes[pair.secondary];
    const Corners& s = segments[pair.main];
    const double d =
        closest_on_segment<Form::reference>(
            point(n), {point(s[0]), point(s[1]), point(s[2]), point(s[3])}, s[2] == s[3])
            .distance();
    const bool first = i == 0 || near.pairs[i - 1].secondary != pair.secondary;
    if (first)
      out.push_back({n, s});
    else if (d < least)
      out.back().segment = s;
    if (first || d < least) least = d;
  }
}

std::vector<Tie> ties_of(const deck::Model& model, int threads) {
  std::vector<Tie> out;
  if (model.deck == nullptr || model.selections == nullptr) return out;
  const Deck& deck = *model.deck;
  for (const Block& block : deck.blocks) {
    if (block.schema == nullptr || block.schema->keyword != "/INTER/TYPE2") continue;
    const DecodedBlock d = decode(deck, block);
    const auto id = [&](std::string_view field, std::string_view kind) {
      return d.integer(field) + deck.offset_of(block, kind);
    };
    const NodeSet* group = model.selections->node_group(id("grnd_IDs", "grnod"));
    const Surface* surface = model.selections->surface(id("surf_IDm", "surf"));
    const Cell* distance = d.find("dsearch");
    if (group == nullptr || surface == nullptr) continue;
    find_ties(model.nodes, *group, *surface,
              distance != nullptr ? working_value(deck, d, *distance) : 0.0, threads, out);
  }
  return out;
}

/// Places in a list, by node.
using Places = std::vector<std::pair<NodeIndex, std::uint32_t>>;

template <class F>
void each_at(const Places& places, NodeIndex n, F&& f) {
  for (auto it = std::lower_bound(places.begin(), places.end(), std::pair{n, std::uint32_t{0}});
       it != places.end() && it->first == n; ++it)
    f(it->second);
}

}  // namespace

std::vector<CandidatePair> pairs_around_ties(const RunContext& run, const Contact& contact) {
  Places nodes, segments;
  for (std::uint32_t i = 0; i < contact.secondary.size(); ++i)
    nodes.emplace_back(contact.secondary[i].node, i);
  for (std::uint32_t i = 0; i < contact.main.size(); ++i)
    for (const NodeIndex n : contact.main[i].nodes) segments.emplace_back(n, i);
  std::sort(nodes.begin(), nodes.end());
  std::sort(segments.begin(), segments.end());
  std::vector<CandidatePair> out;
  const auto drop = [&](NodeIndex secondary, NodeIndex corner) {
    each_at(nodes, secondary, [&](std::uint32_t s) {
      each_at(segments, corner, [&](std::uint32_t m) { out.push_back({s, m}); });
    });
  };
  for (const Tie& tie : ties_of(*run.scene.model, run.options.threads))
    for (const NodeIndex corner : tie.segment) {
      drop(tie.node, corner);
      drop(corner, tie.node);
    }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace deck::cycle::detail
