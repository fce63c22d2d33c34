// Cost of correct decisions: distances in many number types and the filtered decision, on hard
// cases and on pairs of decks. Contestants alternate; processor time, best of the rounds. Times are
// printed only if robust decisions and distances equal the exact ones.
//
//   bench_distance [--samples N] [--rounds K] [--json FILE] [DECK...]
//
// The tiers of the JSON are those of the hard cases; "ratios" are for tools/bench/ratios.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "accuracy/shared/accuracy.hpp"
#include "deck/loaded_deck.hpp"
#include "distance/tiers.hpp"
#include "harness.hpp"

namespace {

using deck::FilterCounters;
using deck::PairSample;
using deck::bench::Outcome;
using deck::bench::Tier;
using Pairs = std::vector<PairSample>;

// Exact tiers are hundreds of times slower: fewer pairs, one round.
constexpr std::size_t slow_pairs = 1000;

Pairs thinned(const Pairs& all) {
  Pairs out;
  const std::size_t step = all.size() / slow_pairs + 1;
  for (std::size_t k = 0; k < all.size(); k += step) out.push_back(all[k]);
  return out;
}

double time_of(const Tier& t, const Pairs& samples) {
  FilterCounters counters;
  static volatile double kept = 0.0;
  double sum = 0.0;
  const double start = deck::accuracy::thread_nanoseconds();
  for (const PairSample& s : samples) {
    const Outcome o = t.run(s, counters);
    sum += o.value + static_cast<double>(o.closer);
  }
  const double spent = deck::accuracy::thread_nanoseconds() - start;
  kept = kept + sum;
  return spent / static_cast<double>(samples.size());
}

struct TierRow {
  const Tier* tier;
  const Pairs* pairs;
  double ns = std::numeric_limits<double>::infinity();
  double relative = 0.0, ulp = 0.0;
  std::uint64_t wrong = 0, non_finite = 0;
  FilterCounters counters = {};

  bool is(std::string_view name, std::string_view what) const {
    return tier->name == name && tier->what == what;
  }
  void judge(const std::vector<Outcome>& truth) {
    const std::size_t step = truth.size() / slow_pairs + 1;
    for (std::size_t k = 0; k < pairs->size(); ++k) {
      const Outcome got = tier->run((*pairs)[k], counters),
                    &want = truth[tier->slow ? k * step : k];
      wrong += got.closer != want.closer;
      if (std::string_view(tier->what) == "decision" || got.value == want.value) continue;
      constexpr double infinite = std::numeric_limits<double>::infinity();
      const bool finite = std::isfinite(got.value);
      non_finite += !finite;
      const double error = std::abs(got.value - want.value);
      relative = std::max(relative, finite && want.value > 0.0 ? error / want.value : infinite);
      ulp = std::max(
          ulp, finite ? error / (std::nextafter(want.value, infinite) - want.value) : infinite);
    }
  }
};

const TierRow& row_of(const std::vector<TierRow>& rows, std::string_view name,
                      std::string_view what) {
  return *std::find_if(rows.begin(), rows.end(),
                       [&](const TierRow& r) { return r.is(name, what); });
}

void print(const std::vector<TierRow>& rows, const std::string& title) {
  const TierRow &plain = row_of(rows, "double", "distance"),
                &robust = row_of(rows, "robust", "decision");
  const auto share = [&](std::uint64_t n) {
    return 100.0 * static_cast<double>(n) / static_cast<double>(robust.counters.pairs);
  };
  fmt::print("\n{}: {} pairs; {:.1f} % decided beyond double, {:.1f} % in exact numbers\n", title,
             plain.pairs->size(), share(robust.counters.double_double),
             share(robust.counters.exact));
  fmt::print("  {:<28} {:>7} {:>9} {:>10} {:>11} {:>9} {:>6} {:>10}\n", "", "pairs", "ns/pair",
             "of double", "worst rel.", "ulp", "wrong", "not finite");
  for (const TierRow& r : rows)
    fmt::print("  {:<28} {:>7} {:>9.1f} {:>10.2f} {:>11.1e} {:>9.1e} {:>6} {:>10}\n",
               fmt::format("{}, {}", r.tier->name, r.tier->what), r.pairs->size(), r.ns,
               r.ns / plain.ns, r.relative, r.ulp, r.wrong, r.non_finite);
}

// Measures all tiers on some pairs; adds ratios to double and, for hard cases, the tiers.
bool race(const std::string& title, const Pairs& samples, int rounds, nlohmann::json& out) {
  const Pairs few = thinned(samples);
  std::vector<Outcome> truth;
  FilterCounters unused;
  for (const PairSample& s : samples) truth.push_back(deck::bench::exact(s, unused));
  std::vector<TierRow> rows;
  for (const Tier& t : deck::bench::tiers()) rows.push_back({&t, t.slow ? &few : &samples});
  for (TierRow& r : rows) r.judge(truth);
  const TierRow& decision = row_of(rows, "robust", "decision");
  if (decision.wrong > 0) {
    fmt::print(stderr, "{}: answers differ from the exact ones; no times\n", title);
    return false;
  }
  for (int round = 0; round < rounds; ++round)
    for (TierRow& r : rows)
      if (round == 0 || !r.tier->slow) r.ns = std::min(r.ns, time_of(*r.tier, *r.pairs));
  print(rows, title);
  const double plain = row_of(rows, "double", "distance").ns;
  out["ratios"]["distance, " + title + ": double, of a robust decision"] = plain / decision.ns;
  if (out.contains("tiers")) return true;
  for (const TierRow& r : rows)
    out["tiers"].push_back({{"name", r.tier->name},
                            {"what", r.tier->what},
                            {"samples", r.pairs->size()},
                            {"ns_per_pair", r.ns},
                            {"max_relative_error", r.relative},  // null: unbounded
                            {"max_ulp", r.ulp},
                            {"decision_errors", r.wrong},
                            {"non_finite", r.non_finite}});
  return true;
}

Pairs pairs_of(const std::string& path) {
  const auto loaded = deck::load(path);
  if (!loaded) return {};
  deck::Findings ignored;
  deck::SceneOptions options = loaded->scene_options();
  options.penetrations = options.candidates = false;
  return deck::bench::scene_pairs(loaded->scene_with(options, ignored), 40000);
}

}  // namespace

int main(int argc, char** argv) {
  bench::Arguments decks(argc, argv);
  const auto samples_of_kind = decks.number("--samples", std::size_t{300});
  const int rounds = decks.number("--rounds", 9);
  const auto json = decks.value("--json");
  nlohmann::json out = nlohmann::json::object();
  Pairs samples;
  for (const deck::HardFamily& family : deck::hard_families()) {
    const auto some = deck::hard_cases(family.id, samples_of_kind);
    samples.insert(samples.end(), some.begin(), some.end());
  }
  if (!race("hard cases", samples, rounds, out)) return 1;
  for (const std::string& path : decks.words) {
    const auto pairs = pairs_of(path);
    const std::string name = path.substr(path.find_last_of('/') + 1);
    if (pairs.empty()) {
      fmt::print(stderr, "{}: no pairs\n", path);
      return 1;
    }
    if (!race(name, pairs, rounds, out)) return 1;
  }
  bench::write_json(json, out);
  return 0;
}
