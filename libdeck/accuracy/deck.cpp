// The whole of `deck gaps` with each word of --accuracy: its time, and the pairs that it decides
// otherwise than exact arithmetic.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>

#include "accuracy/shared/choice.hpp"

namespace deck {
namespace {

struct PairKey {
  std::uint32_t contact = 0, secondary = 0, main = 0;
  auto operator<=>(const PairKey&) const = default;
};
struct Figures {
  double gap = 0.0, distance = std::numeric_limits<double>::quiet_NaN();
};
using Decided = std::map<PairKey, Figures>;

Decided pairs_in_contact(const Scene& scene) {
  Decided out;
  for (std::uint32_t c = 0; c < scene.contacts.size(); ++c)
    for (const PenetrationRow& row : scene.contacts[c].penetrations)
      if (row.in_contact) out[{c, row.secondary, row.main}] = {row.gap, row.distance};
  return out;
}

/// The distance that a word computes where its answer has no row. Nothing where pairs have other
/// rules (TYPE24, TYPE25), or nodes have been moved since.
double distance_of(const Scene& scene, const PairKey& key, Accuracy accuracy) {
  const Contact& c = scene.contacts[key.contact];
  if (c.type >= 24 || std::any_of(scene.contacts.begin(), scene.contacts.end(),
                                  [](const Contact& other) { return other.inacti == 3; }))
    return std::numeric_limits<double>::quiet_NaN();
  const auto at = [&](NodeIndex n) {
    const Coordinates& x = scene.coordinates;
    return Point3<double>{x.x[n], x.y[n], x.z[n]};
  };
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
  return accuracy::word(accuracy).distance(s);
}

template <class Nodes>
std::vector<std::int64_t> ids_of(const Scene& scene, const Nodes& nodes) {
  std::vector<std::int64_t> out;
  for (const NodeIndex n : nodes) out.push_back(scene.model->node_id(n));
  return out;
}

/// `exact`, `computed`: the rows of the two answers, of which one has none.
WrongPair wrong_pair(const Scene& scene, const PairKey& key, Accuracy accuracy,
                     const Figures* exact, const Figures* computed) {
  const Contact& c = scene.contacts[key.contact];
  WrongPair out;
  out.interface = c.inter->id;
  if (c.kind == ContactKind::edge_edge) {
    out.secondary = ids_of(scene, c.secondary_edges[key.secondary].nodes);
    out.main = ids_of(scene, c.main_edges[key.main].nodes);
  } else {
    out.secondary = {scene.model->node_id(c.secondary[key.secondary].node)};
    out.main = ids_of(scene, c.main[key.main].nodes);
  }
  out.gap = (exact != nullptr ? exact : computed)->gap;
  out.exact = exact != nullptr ? exact->distance : distance_of(scene, key, Accuracy::exact);
  out.computed = computed != nullptr ? computed->distance : distance_of(scene, key, accuracy);
  return out;
}

std::vector<WrongPair> wrong_pairs(const Scene& scene, Accuracy accuracy, const Decided& truth) {
  const Decided got = pairs_in_contact(scene);
  std::vector<WrongPair> out;
  for (const auto& [key, figures] : truth)
    if (!got.contains(key)) out.push_back(wrong_pair(scene, key, accuracy, &figures, nullptr));
  for (const auto& [key, figures] : got)
    if (!truth.contains(key)) out.push_back(wrong_pair(scene, key, accuracy, nullptr, &figures));
  return out;
}

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The runs with one word.
struct Runs {
  Accuracy accuracy{};
  std::vector<double> seconds = {};
  std::uint64_t pairs = 0;
  std::vector<WrongPair> wrong = {};

  void add(const GapsRun& run, Decided& truth) {
    const auto start = Clock::now();
    const bool first = seconds.empty();
    run(accuracy, [&](const Scene& scene) {
      seconds.push_back(seconds_since(start));
      if (!first) return;
      pairs = scene.decisions.pairs;
      if (accuracy == Accuracy::exact) truth = pairs_in_contact(scene);
      wrong = wrong_pairs(scene, accuracy, truth);
    });
  }
  double best() const { return *std::min_element(seconds.begin(), seconds.end()); }
  /// How far above the best time the lower quartile lies, as a share of it.
  double spread() const {
    std::vector<double> sorted = seconds;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t quarter =
        std::min(sorted.size() - 1, std::max<std::size_t>(1, sorted.size() / 4));
    return (sorted[quarter] - sorted.front()) / std::max(sorted.front(), 1e-9);
  }
};

}  // namespace

void measure_deck(const GapsRun& run, const GapsTiming& timing,
                  std::vector<AccuracyChoice>& choices) {
  for (AccuracyChoice& c : choices) c.deck.reset();
  Runs all[] = {{Accuracy::exact}, {Accuracy::robust}, {Accuracy::reference}, {Accuracy::fast}};
  Decided truth;
  const int repeats = std::max(1, timing.repeats);
  const auto runs = static_cast<std::uint64_t>(3 * repeats + 1);
  std::uint64_t done = 0;
  const auto one = [&](Runs& r) {
    if (timing.progress) timing.progress(std::min(done, runs), runs);
    r.add(run, truth);
    ++done;
  };
  one(all[0]);
  if (all[0].pairs == 0) return;
  const auto start = Clock::now();
  for (int round = 0; round < repeats || seconds_since(start) < timing.least; ++round) {
    if (round >= 3 && seconds_since(start) > timing.most) break;
    for (std::size_t k = 1; k < std::size(all); ++k) one(all[k]);
  }
  if (std::any_of(std::begin(all), std::end(all), [](const Runs& r) { return r.seconds.empty(); }))
    return;  // the deck has gone away
  const Runs& fast = all[3];
  for (AccuracyChoice& c : choices)
    for (Runs& r : all) {
      if (r.accuracy != c.accuracy) continue;
      TimeRatio ratio;
      if (c.accuracy != Accuracy::fast && fast.best() > 0.0)
        ratio = {r.best() / fast.best(), r.spread() + fast.spread()};
      c.deck = {r.best(), ratio, r.pairs, std::move(r.wrong)};
    }
}

}  // namespace deck
