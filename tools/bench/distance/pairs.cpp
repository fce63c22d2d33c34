// Pairs of a deck's contacts with their gaps.
#include "deck/contacts.hpp"
#include "distance/tiers.hpp"

namespace deck::bench {
namespace {

Point3<double> point(const Coordinates& c, NodeIndex n) { return {c.x[n], c.y[n], c.z[n]}; }

struct Collector {
  const Scene& scene;
  std::vector<PairSample> out;

  NodeArrays arrays() const {
    const Coordinates& c = scene.coordinates;
    return {c.x, c.y, c.z};
  }
  SearchOptions options(const Contact& contact) const {
    SearchOptions o;
    o.gap = contact.gap_rule;
    o.drad = contact.drad;
    o.max_pairs = std::size_t{50} << 20;  // larger contacts are skipped
    return o;
  }

  void node_segment(const Contact& contact) {
    std::vector<std::uint32_t> secondary;
    std::vector<double> gap_s, gap_m;
    std::vector<std::array<std::uint32_t, 4>> segments;
    for (const SecondaryNode& s : contact.secondary) {
      secondary.push_back(s.node);
      gap_s.push_back(s.gap);
    }
    for (const MainSegment& m : contact.main) {
      segments.push_back(m.nodes);
      gap_m.push_back(m.gap);
    }
    SearchOptions search = options(contact);
    search.margin = candidate_margin(arrays(), segments);
    const NodeSegmentInput input{arrays(), secondary, gap_s, contact.secondary_length,
                                 {},       segments,  gap_m, contact.main_length,
                                 {}};
    const Coordinates& x = scene.coordinates;
    for (const CandidatePair& pair : find_node_segment_pairs(input, search).pairs) {
      const auto& n = segments[pair.main];
      PairSample sample;
      for (std::size_t k = 0; k < 4; ++k) sample.x[k] = point(x, n[k]);
      sample.x[4] = point(x, secondary[pair.secondary]);
      sample.triangle = n[2] == n[3];
      sample.gap = contact.pair_gap(pair.secondary, pair.main);
      out.push_back(sample);
    }
  }

  void edge_edge(const Contact& contact) {
    struct PairSide {
      std::vector<std::array<std::uint32_t, 2>> edges;
      std::vector<double> gap;
      explicit PairSide(const std::vector<ContactEdge>& list) {
        for (const ContactEdge& e : list) {
          edges.push_back(e.nodes);
          gap.push_back(e.gap);
        }
      }
    };
    const PairSide s(contact.secondary_edges), m(contact.main_edges);
    SearchOptions search = options(contact);
    search.margin = contact.shortest_side;
    const EdgeEdgeInput input{arrays(), s.edges, s.gap, contact.secondary_length,
                              {},       m.edges, m.gap, contact.main_length,
                              {}};
    const Coordinates& x = scene.coordinates;
    for (const CandidatePair& pair : find_edge_edge_pairs(input, search).pairs) {
      const auto &a = s.edges[pair.secondary], &b = m.edges[pair.main];
      PairSample sample;
      sample.edges = true;
      sample.x = {point(x, a[0]), point(x, a[1]), point(x, b[0]), point(x, b[1]), {}};
      sample.gap = contact.pair_gap(pair.secondary, pair.main);
      out.push_back(sample);
    }
  }
};

}  // namespace

std::vector<PairSample> scene_pairs(const Scene& scene, std::size_t limit) {
  Collector collector{scene, {}};
  for (const Contact& contact : scene.contacts) {
    if (contact.dropped) continue;
    if (contact.kind == ContactKind::node_segment) {
      if (!contact.secondary.empty() && !contact.main.empty()) collector.node_segment(contact);
    } else if (!contact.secondary_edges.empty() && !contact.main_edges.empty()) {
      collector.edge_edge(contact);
    }
  }
  std::vector<PairSample>& all = collector.out;
  if (all.size() <= limit) return std::move(all);
  std::vector<PairSample> out;
  out.reserve(limit);
  // k * size / limit without overflow.
  for (std::size_t k = 0; k < limit; ++k) {
    const double at = static_cast<double>(k) * static_cast<double>(all.size());
    out.push_back(all[static_cast<std::size_t>(at / static_cast<double>(limit))]);
  }
  return out;
}

}  // namespace deck::bench
