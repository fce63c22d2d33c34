// Digests of what the geometry and force kernels answer, one line per kind: the same lines from
// every compiler, optimisation level and instruction set. Built and compared by
// tests/robustness/builds.py; prints nothing that depends on time or place.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "accuracy/shared/accuracy.hpp"
#include "accuracy/shared/choice.hpp"
#include "contact/search/sweep.hpp"
#include "contact/shared/dd.hpp"
#include "contact/shared/filtered.hpp"
#include "deck/contacts.hpp"
#include "deck/cycle.hpp"

namespace deck {
namespace {

struct Digest : BitDigest {
  using BitDigest::add;
  void add(const DoubleDouble& v) {
    add(v.hi());
    add(v.lo() == 0.0 ? 0.0 : v.lo());
  }
  void print(const char* name) const { std::printf("%-28s %016" PRIx64 "\n", name, state); }
};

template <class T, Form F>
void formulas(std::span<const PairSample> samples, const char* name) {
  Digest d;
  for (const PairSample& s : samples) {
    std::array<Point3<T>, 5> x;
    for (std::size_t k = 0; k < 5; ++k) x[k] = {T(s.x[k].x), T(s.x[k].y), T(s.x[k].z)};
    if (s.edges) {
      const auto c = closest_between_edges<F>(x[0], x[1], x[2], x[3]);
      d.add(c.distance);
      d.add(c.weight_s);
      d.add(c.weight_m);
    } else {
      const auto c = closest_on_segment<F>(x[4], {x[0], x[1], x[2], x[3]}, s.triangle);
      d.add(c.distance());
      for (const T& w : c.weights) d.add(w);
    }
  }
  d.print(name);
}

void filtered(std::span<const PairSample> samples) {
  Digest decisions, counts;
  FilterCounters counters;
  for (const PairSample& s : samples) {
    const auto& x = s.x;
    const bool closer = s.edges ? is_closer_than(x[0], x[1], x[2], x[3], s.gap, &counters)
                                : is_closer_than(x[4], s.corners(), s.triangle, s.gap, &counters);
    decisions.add(static_cast<std::uint64_t>(closer));
  }
  counts.add(counters.double_double);
  counts.add(counters.exact);
  decisions.print("robust decisions");
  counts.print("robust fallbacks");
}

// Two wavy sheets; every node against all segments, every edge against all edges.
struct Sheets {
  std::vector<double> x, y, z;
  std::vector<std::uint32_t> nodes;
  std::vector<std::array<std::uint32_t, 4>> segments;
  std::vector<std::array<std::uint32_t, 2>> edges;

  Sheets() {
    constexpr std::uint32_t n = 40;
    for (std::uint32_t level = 0; level < 2; ++level) {
      const auto first = static_cast<std::uint32_t>(x.size());
      for (std::uint32_t i = 0; i < n * n; ++i) {
        const auto u = static_cast<double>(i % n), v = static_cast<double>(i / n);
        x.push_back(u);
        y.push_back(v);
        z.push_back(0.45 * static_cast<double>(level) + 0.01 * static_cast<double>(i * 37 % 11));
        nodes.push_back(first + i);
        if (i % n + 1 < n) edges.push_back({first + i, first + i + 1});
        if (i % n + 1 < n && i / n + 1 < n)
          segments.push_back({first + i, first + i + 1, first + i + n + 1, first + i + n});
      }
    }
  }
};

void search(const Sheets& sheets) {
  for (const int threads : {1, 2}) {
    Digest d;
    for (const Form form : {Form::reference, Form::robust}) {
      SearchOptions o;
      o.gap = PairGap::constant(0.5);
      o.threads = threads;
      o.form = form;
      NodeSegmentInput ns;
      ns.nodes = {sheets.x, sheets.y, sheets.z};
      ns.secondary = sheets.nodes;
      ns.segments = sheets.segments;
      EdgeEdgeInput ee;
      ee.nodes = ns.nodes;
      ee.secondary = ee.main = sheets.edges;
      for (const SearchResult& r : {find_node_segment_pairs(ns, o), find_edge_edge_pairs(ee, o)})
        for (const CandidatePair& p : r.pairs)
          d.add(std::uint64_t{p.secondary} << 32 | std::uint64_t{p.main});
    }
    // The same digest for both numbers of threads: the name is the same too.
    d.print("pair search");
  }
}

// Pairs of one kind as the arrays of a packet.
struct Packet {
  bool edges = false;
  std::array<std::array<std::vector<double>, 3>, 5> x;
  std::vector<double> gap, k0;
  std::vector<std::uint8_t> triangle;

  void add(const PairSample& s) {
    // Roles of node-segment pairs: the node comes first.
    for (std::size_t role = 0; role < 5; ++role) {
      const Point3<double>& p = s.x[edges ? role : (role + 4) % 5];
      x[role][0].push_back(p.x);
      x[role][1].push_back(p.y);
      x[role][2].push_back(p.z);
    }
    gap.push_back(s.gap);
    k0.push_back(1.0);
    triangle.push_back(s.triangle);
  }
  cycle::PacketView view() const {
    cycle::PacketView v;
    v.size = gap.size();
    for (std::size_t role = 0; role < 5; ++role)
      for (std::size_t c = 0; c < 3; ++c) v.position[role][c] = x[role][c].data();
    v.gap = gap.data();
    v.k0 = k0.data();
    v.triangle = triangle.data();
    return v;
  }
};

void kernel(std::span<const PairSample> samples) {
  Digest d;
  for (const bool edges : {false, true}) {
    Packet packet;
    packet.edges = edges;
    for (const PairSample& s : samples)
      if (s.edges == edges) packet.add(s);
    cycle::ContactCard card;
    card.kind = edges ? cycle::ContactKind::edge_edge : cycle::ContactKind::node_segment;
    card.viss = 0.0;
    cycle::PacketResult result;
    cycle::evaluate(cycle::make_plan(card, cycle::Model::robust), packet.view(), result);
    for (const double force : result.normal_force) d.add(force);
    for (const double distance : result.distance) d.add(distance);
  }
  d.print("force kernel");
}

int run(std::size_t per_family) {
  std::vector<PairSample> samples;
  Digest inputs;
  for (const HardFamily& f : hard_families())
    for (const PairSample& s : hard_cases(f.id, per_family)) {
      samples.push_back(s);
      for (const auto& p : s.x) inputs.add(p.x), inputs.add(p.y), inputs.add(p.z);
      inputs.add(s.gap);
    }
  inputs.print("samples");
  formulas<float, Form::robust>(samples, "float");
  formulas<double, Form::robust>(samples, "double robust form");
  formulas<double, Form::reference>(samples, "double reference form");
  formulas<DoubleDouble, Form::robust>(samples, "double-double");
  filtered(samples);
  search(Sheets());
  kernel(samples);
  std::printf("%-28s %016" PRIx64 "\n", "what deck accuracy says", answer_digest().own);
  return 0;
}

}  // namespace
}  // namespace deck

int main(int count, char** words) {
  return deck::run(count > 1 ? std::strtoull(words[1], nullptr, 10) : 1000);
}
