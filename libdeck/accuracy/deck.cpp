// Pairs of a deck's contacts with their gaps, and the whole geometry stage of a deck, for
// measurements of accuracy and time.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "accuracy/shared/accuracy.hpp"

namespace deck {
namespace {

Point3<double> point(const Coordinates& c, NodeIndex n) { return {c.x[n], c.y[n], c.z[n]}; }

struct Collector {
  const Scene& scene;
  int threads;
  std::vector<PairSample> out;

  NodeArrays arrays() const {
    const Coordinates& c = scene.coordinates;
    return {c.x, c.y, c.z};
  }
  SearchOptions options(const Contact& contact) const {
    SearchOptions o;
    o.gap = contact.gap_rule;
    o.drad = contact.drad;
    o.threads = threads;
    o.max_pairs = std::size_t{50} << 20;  // beyond, the contact gives no pairs
    return o;
  }

  void node_segment(const Contact& contact) {
    std::vector<std::uint32_t> secondary;
    std::vector<double> gap_s, length_s, gap_m, length_m;
    std::vector<std::array<std::uint32_t, 4>> segments;
    for (const SecondaryNode& s : contact.secondary) {
      secondary.push_back(s.node);
      gap_s.push_back(s.gap);
      length_s.push_back(s.length);
    }
    for (const MainSegment& m : contact.main) {
      segments.push_back(m.nodes);
      gap_m.push_back(m.gap);
      length_m.push_back(m.length);
    }
    SearchOptions search = options(contact);
    search.margin = candidate_margin(arrays(), segments);
    const NodeSegmentInput input{arrays(), secondary, gap_s,    length_s, {},
                                 segments, gap_m,     length_m, {}};
    const Coordinates& x = scene.coordinates;
    for (const CandidatePair& pair : find_node_segment_pairs(input, search).pairs) {
      const auto& n = segments[pair.main];
      PairSample sample;
      for (std::size_t k = 0; k < 4; ++k) sample.x[k] = point(x, n[k]);
      sample.x[4] = point(x, secondary[pair.secondary]);
      sample.triangle = n[2] == n[3];
      sample.gap = contact.gap_rule(gap_s[pair.secondary], gap_m[pair.main],
                                    length_s[pair.secondary], length_m[pair.main]);
      out.push_back(sample);
    }
  }

  void edge_edge(const Contact& contact) {
    struct Side {
      std::vector<std::array<std::uint32_t, 2>> edges;
      std::vector<double> gap, length;
      explicit Side(const std::vector<ContactEdge>& list) {
        for (const ContactEdge& e : list) {
          edges.push_back(e.nodes);
          gap.push_back(e.gap);
          length.push_back(e.length);
        }
      }
    };
    const Side s(contact.secondary_edges), m(contact.main_edges);
    SearchOptions search = options(contact);
    search.margin = candidate_margin(arrays(), s.edges, m.edges);
    const EdgeEdgeInput input{arrays(), s.edges, s.gap, s.length, {}, m.edges, m.gap, m.length, {}};
    const Coordinates& x = scene.coordinates;
    for (const CandidatePair& pair : find_edge_edge_pairs(input, search).pairs) {
      const auto &a = s.edges[pair.secondary], &b = m.edges[pair.main];
      PairSample sample;
      sample.edges = true;
      sample.x = {point(x, a[0]), point(x, a[1]), point(x, b[0]), point(x, b[1]), {}};
      sample.gap = contact.gap_rule(s.gap[pair.secondary], m.gap[pair.main],
                                    s.length[pair.secondary], m.length[pair.main]);
      out.push_back(sample);
    }
  }
};

}  // namespace

std::vector<PairSample> scene_pairs(const Scene& scene, std::size_t limit, int threads) {
  Collector collector{scene, threads, {}};
  for (const Contact& contact : scene.contacts) {
    if (contact.dropped) continue;
    if (contact.kind == ContactKind::node_segment) {
      if (!contact.secondary.empty() && !contact.main.empty()) collector.node_segment(contact);
    } else if (!contact.secondary_edges.empty() && !contact.main_edges.empty()) {
      collector.edge_edge(contact);
    }
  }
  std::vector<PairSample>& all = collector.out;
  if (limit == 0 || all.size() <= limit) return std::move(all);
  std::vector<PairSample> out;
  out.reserve(limit);
  // k * size / limit without overflow for any size that fits in memory.
  for (std::size_t k = 0; k < limit; ++k) {
    const double at = static_cast<double>(k) * static_cast<double>(all.size());
    out.push_back(all[static_cast<std::size_t>(at / static_cast<double>(limit))]);
  }
  return out;
}

namespace {

using PairIndices = std::array<std::uint32_t, 3>;

// The pairs in contact, with their distances.
std::map<PairIndices, double> pairs_in_contact(const Scene& scene) {
  std::map<PairIndices, double> out;
  for (std::uint32_t c = 0; c < scene.contacts.size(); ++c)
    for (const PenetrationRow& row : scene.contacts[c].penetrations)
      if (row.in_contact) out[{c, row.secondary, row.main}] = row.distance;
  return out;
}

void compare(const std::map<PairIndices, double>& got, const std::map<PairIndices, double>& want,
             TierResult& row) {
  for (const auto& [key, distance] : want) {
    const auto found = got.find(key);
    if (found == got.end()) {
      ++row.decision_errors;
      continue;
    }
    if (found->second == distance) continue;
    const double error = std::abs(found->second - distance);
    const double step = std::nextafter(distance, std::numeric_limits<double>::infinity());
    row.non_finite += !std::isfinite(found->second);
    row.max_relative_error = std::max(row.max_relative_error, error / distance);
    row.max_ulp = std::max(row.max_ulp, error / (step - distance));
  }
  for (const auto& [key, distance] : got) row.decision_errors += !want.contains(key);
}

}  // namespace

namespace {

using Seconds = std::chrono::duration<double>;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return Seconds(std::chrono::steady_clock::now() - start).count();
}

// The runs of one accuracy.
struct GapsRuns {
  Accuracy accuracy{};
  std::vector<double> seconds;
  TierResult row;

  void add(const std::function<Scene(Accuracy)>& run, std::map<PairIndices, double>& truth) {
    const auto start = std::chrono::steady_clock::now();
    const Scene scene = run(accuracy);
    seconds.push_back(seconds_since(start));
    if (seconds.size() > 1) return;
    row.samples = scene.decisions.pairs;
    row.fallback_share = static_cast<double>(scene.decisions.fallback);
    row.exact_share = static_cast<double>(scene.decisions.exact);
    const auto got = pairs_in_contact(scene);
    if (accuracy == Accuracy::exact) truth = got;
    compare(got, truth, row);
  }
  // `pairs`: the exact ones, so that times can be compared.
  void finish(double pairs) {
    std::sort(seconds.begin(), seconds.end());
    row.name = to_string(accuracy);
    row.what = "gaps";
    row.seconds = seconds.front();
    const std::size_t quarter =
        std::min(seconds.size() - 1, std::max<std::size_t>(1, seconds.size() / 4));
    row.spread = (seconds[quarter] - seconds.front()) / std::max(seconds.front(), 1e-9);
    row.ns_per_pair = 1e9 * row.seconds / pairs;
    row.fallback_share /= pairs;
    row.exact_share /= pairs;
  }
};

}  // namespace

void measure_gaps(const std::function<Scene(Accuracy)>& run, const GapsTiming& timing,
                  AccuracyReport& report) {
  std::erase_if(report.tiers, [](const TierResult& t) { return t.what == "gaps"; });
  std::map<PairIndices, double> truth;
  std::vector<GapsRuns> all;
  for (const Accuracy a : {Accuracy::exact, Accuracy::robust, Accuracy::reference, Accuracy::fast})
    all.push_back({a, {}, {}});
  const int repeats = std::max(1, timing.repeats);
  const auto runs = static_cast<std::uint64_t>(3 * repeats + 1);
  std::uint64_t done = 0;
  const auto one = [&](GapsRuns& r) {
    if (timing.progress) timing.progress(std::min(done, runs), runs);
    r.add(run, truth);
    ++done;
  };
  one(all[0]);
  const auto start = std::chrono::steady_clock::now();
  for (int round = 0; round < repeats || seconds_since(start) < timing.least; ++round) {
    if (round >= 3 && seconds_since(start) > timing.most) break;
    for (std::size_t k = 1; k < all.size(); ++k) one(all[k]);
  }
  const auto pairs = static_cast<double>(std::max<std::uint64_t>(all[0].row.samples, 1));
  for (GapsRuns& r : all) {
    r.finish(pairs);
    report.tiers.push_back(r.row);
  }
  mark_dominated(report.tiers);
}

}  // namespace deck
