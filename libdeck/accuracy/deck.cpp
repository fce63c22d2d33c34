// Time of a whole `deck gaps` with each --accuracy, and its pairs decided unlike exact arithmetic.
#include <time.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>

#include "accuracy/shared/choice.hpp"

namespace deck {
namespace {

constexpr std::size_t most_drawn = 2500;  // segments of a picture

struct PairKey {
  std::uint32_t contact = 0, secondary = 0, main = 0;
  auto operator<=>(const PairKey&) const = default;
};
struct DecisionFigures {
  double gap = 0.0, distance = std::numeric_limits<double>::quiet_NaN();
};
using Decided = std::map<PairKey, DecisionFigures>;

Decided pairs_in_contact(const Scene& scene) {
  Decided out;
  for (std::uint32_t c = 0; c < scene.contacts.size(); ++c)
    for (const PenetrationRow& row : scene.contacts[c].penetrations)
      if (row.in_contact) out[{c, row.secondary, row.main}] = {row.gap, row.distance};
  return out;
}

/// True if pairs have other rules (TYPE24, TYPE25), or nodes have moved since.
bool has_own_rules(const Scene& scene, const Contact& c) {
  return c.type >= 24 || std::any_of(scene.contacts.begin(), scene.contacts.end(),
                                     [](const Contact& other) { return other.inacti == 3; });
}

Point3<double> place(const Scene& scene, NodeIndex n) {
  const Coordinates& x = scene.coordinates;
  return {x.x[n], x.y[n], x.z[n]};
}

PairSample sample_of(const Scene& scene, const PairKey& key) {
  const Contact& c = scene.contacts[key.contact];
  const auto at = [&](NodeIndex n) { return place(scene, n); };
  PairSample s;
  if (c.kind == ContactKind::edge_edge) {
    const auto &a = c.secondary_edges[key.secondary].nodes, &b = c.main_edges[key.main].nodes;
    s.edges = true;
    s.x = {at(a[0]), at(a[1]), at(b[0]), at(b[1]), {}};
  } else {
    const auto& n = c.main[key.main].nodes;
    s.triangle = n[2] == n[3];
    s.x = {at(n[0]), at(n[1]), at(n[2]), at(n[3]), at(c.secondary[key.secondary].node)};
  }
  return s;
}

template <class Nodes>
std::vector<std::int64_t> ids_of(const Scene& scene, const Nodes& nodes) {
  std::vector<std::int64_t> out;
  for (const NodeIndex n : nodes) out.push_back(scene.model->node_id(n));
  return out;
}

/// `row`: from an answer with one; `in_contact`: exactly.
WrongPair pair_of(const Scene& scene, const PairKey& key, Accuracy accuracy,
                  const DecisionFigures& row, bool in_contact) {
  const Contact& c = scene.contacts[key.contact];
  WrongPair out{c.inter->id,  {},           {},         row.gap,
                row.distance, row.distance, in_contact, sample_of(scene, key)};
  if (c.kind == ContactKind::edge_edge) {
    out.secondary = ids_of(scene, c.secondary_edges[key.secondary].nodes);
    out.main = ids_of(scene, c.main_edges[key.main].nodes);
  } else {
    out.secondary = {scene.model->node_id(c.secondary[key.secondary].node)};
    out.main = ids_of(scene, c.main[key.main].nodes);
  }
  if (!has_own_rules(scene, c)) {
    out.exact = accuracy::word(Accuracy::exact).distance(out.sample);
    out.computed = accuracy::word(accuracy).distance(out.sample);
  } else {
    (in_contact ? out.computed : out.exact) = std::numeric_limits<double>::quiet_NaN();
  }
  return out;
}

std::vector<WrongPair> wrong_pairs(const Scene& scene, Accuracy accuracy, const Decided& truth) {
  const Decided got = pairs_in_contact(scene);
  std::vector<WrongPair> out;
  for (const auto& [key, figures] : truth)
    if (!got.contains(key)) out.push_back(pair_of(scene, key, accuracy, figures, true));
  for (const auto& [key, figures] : got)
    if (!truth.contains(key)) out.push_back(pair_of(scene, key, accuracy, figures, false));
  return out;
}

DeckPicture picture_of(const Scene& scene, const Decided& truth) {
  DeckPicture out;
  std::size_t segments = 0, at = 0;
  for (const Contact& c : scene.contacts) segments += c.main.size();
  const std::size_t step = segments / most_drawn + 1;
  for (const Contact& c : scene.contacts)
    for (const MainSegment& m : c.main) {
      if (at++ % step != 0) continue;
      std::array<Point3<double>, 4> corners;
      for (std::size_t k = 0; k < 4; ++k) corners[k] = place(scene, m.nodes[k]);
      if (std::all_of(corners.begin(), corners.end(),
                      [](const auto& p) { return std::isfinite(p.x + p.y + p.z); }))
        out.surface.push_back(corners);
    }
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [key, row] : truth) {
    const double margin = std::abs(row.gap - row.distance) / row.gap;
    if (!(margin < least) || has_own_rules(scene, scene.contacts[key.contact])) continue;
    least = margin;
    out.nearest = pair_of(scene, key, Accuracy::reference, row, true);
  }
  return out;
}

/// Processor time of all threads; excludes other programs.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct AccuracyRuns {
  Accuracy accuracy{};
  std::vector<double> seconds = {};
  std::uint64_t pairs = 0, exactly = 0;
  std::vector<WrongPair> wrong = {};

  double best() const { return *std::min_element(seconds.begin(), seconds.end()); }
  /// (Lower quartile - best time) / best time.
  double spread() const {
    std::vector<double> sorted = seconds;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t quarter =
        std::min(sorted.size() - 1, std::max<std::size_t>(1, sorted.size() / 4));
    return (sorted[quarter] - sorted.front()) / std::max(sorted.front(), 1e-9);
  }
};

}  // namespace

DeckPicture measure_deck(const GapsRun& run, const GapsTiming& timing,
                         std::vector<AccuracyChoice>& choices) {
  for (AccuracyChoice& c : choices) c.deck.reset();
  AccuracyRuns all[] = {
      {Accuracy::exact}, {Accuracy::robust}, {Accuracy::reference}, {Accuracy::fast}};
  AccuracyRuns &exact = all[0], &robust = all[1], &fast = all[3];
  Decided truth;
  DeckPicture picture;
  std::atomic<bool> over = false;
  const double start = processor_seconds();
  const auto spent = [&] { return processor_seconds() - start; };
  const auto out_of_time = [&] {
    if (spent() > timing.exact) over = true;
    return over.load();
  };
  std::uint64_t done = 0;
  const auto one = [&](AccuracyRuns& r) {
    const auto runs = static_cast<std::uint64_t>(3 * std::max(1, timing.repeats) + 1);
    if (timing.progress) timing.progress(std::min(done++, runs), runs);
    const double from = processor_seconds();
    run(r.accuracy, out_of_time, [&](const Scene& scene) {
      r.seconds.push_back(processor_seconds() - from);
      if (r.seconds.size() > 1) return;
      r.pairs = scene.decisions.pairs;
      r.exactly = scene.decisions.exact;
      if (&r == &exact) truth = pairs_in_contact(scene), picture = picture_of(scene, truth);
      r.wrong = wrong_pairs(scene, r.accuracy, truth);
    });
  };
  one(exact);
  if (exact.pairs == 0) return {};
  const double rest = spent();
  const auto settled = [&] {
    return spent() - rest > timing.least && robust.spread() + fast.spread() <= 0.1;
  };
  for (int round = 0; round < timing.repeats || !settled(); ++round) {
    if (round >= 3 && spent() - rest > timing.most) break;
    for (AccuracyRuns* r : {&robust, &all[2], &fast}) one(*r);
    if (robust.seconds.empty() || all[2].seconds.empty() || fast.seconds.empty())
      return {};  // the deck no longer exists
  }
  double exact_seconds = exact.best();
  if (over && exact.exactly > 0)  // time of the pairs left to `robust`
    exact_seconds = robust.best() + (exact_seconds - robust.best()) *
                                        static_cast<double>(exact.pairs) /
                                        static_cast<double>(exact.exactly);
  for (AccuracyChoice& c : choices)
    for (AccuracyRuns& r : all) {
      if (r.accuracy != c.accuracy) continue;
      const double seconds = &r == &exact ? exact_seconds : r.best();
      TimeRatio ratio;
      if (&r != &fast && fast.best() > 0.0)
        ratio = {seconds / fast.best(), r.spread() + fast.spread()};
      c.deck = {seconds, ratio, r.pairs, std::move(r.wrong), &r == &exact && over};
    }
  return picture;
}

}  // namespace deck
