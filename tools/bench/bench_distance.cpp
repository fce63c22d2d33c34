// What never being wrong costs: the filtered decision and the correctly rounded distance against
// plain double arithmetic, on the hard cases and on the pairs of decks. Turn by turn, processor
// time, best of the rounds; no time is shown unless decisions and distances are the exact ones (a
// sample of them).
//
//   bench_distance [--samples N] [--rounds K] [--json FILE] [DECK...]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "accuracy/tiers.hpp"
#include "deck/front/loaded_deck.hpp"

namespace {

using deck::FilterCounters;
using deck::PairSample;
using deck::accuracy::Outcome;
using deck::accuracy::Tier;

struct Settings {
  std::size_t samples = 300;
  int rounds = 9;
  std::string json;
  std::vector<std::string> decks;
};

const Tier* tier(std::string_view name, std::string_view what) {
  for (const Tier& t : deck::accuracy::distance_tiers())
    if (t.name == name && t.what == what) return &t;
  return nullptr;
}

double seconds_of(const Tier& t, const std::vector<PairSample>& samples) {
  FilterCounters counters;
  volatile double kept = 0.0;
  double sum = 0.0;
  const double start = deck::accuracy::thread_nanoseconds();
  for (const PairSample& s : samples) {
    const Outcome o = t.run(s, counters);
    sum += o.value + static_cast<double>(o.closer);
  }
  const double spent = deck::accuracy::thread_nanoseconds() - start;
  kept = sum;
  (void)kept;
  return spent / static_cast<double>(samples.size());
}

// Whether decision and distance of some pairs are the exact ones.
bool is_right(const Tier& decision, const Tier& distance, const std::vector<PairSample>& samples) {
  FilterCounters counters;
  const std::size_t step = samples.size() / 4000 + 1;
  for (std::size_t k = 0; k < samples.size(); k += step) {
    const Outcome exact = deck::accuracy::exact(samples[k], counters);
    if (decision.run(samples[k], counters).closer != exact.closer) return false;
    if (distance.run(samples[k], counters).value != exact.value) return false;
  }
  return true;
}

// The race on some pairs; adds the ratios of speed against double to `ratios`.
bool race(const std::string& title, const std::vector<PairSample>& samples, int rounds,
          nlohmann::json& ratios) {
  const std::array<const Tier*, 6> all{
      tier("double", "distance"),    tier("double-residual", "distance"),
      tier("reference", "distance"), tier("double-double", "distance"),
      tier("robust", "gaps"),        tier("robust", "distance")};
  if (!is_right(*all[4], *all[5], samples)) {
    fmt::print(stderr, "{}: answers differ from the exact ones; no times\n", title);
    return false;
  }
  std::array<double, 6> best;
  best.fill(1e300);
  for (int round = 0; round < rounds; ++round)
    for (std::size_t k = 0; k < all.size(); ++k)
      best[k] = std::min(best[k], seconds_of(*all[k], samples));
  FilterCounters counters;
  for (const PairSample& s : samples) all[4]->run(s, counters);
  const auto share = [&](std::uint64_t n) {
    return 100.0 * static_cast<double>(n) / static_cast<double>(counters.pairs);
  };
  fmt::print("\n{}: {} pairs; {:.1f} % decided beyond double, {:.1f} % in exact numbers\n", title,
             samples.size(), share(counters.double_double), share(counters.exact));
  fmt::print("  {:<28} {:>9} {:>12}\n", "", "ns/pair", "of double");
  for (std::size_t k = 0; k < all.size(); ++k)
    fmt::print("  {:<28} {:>9.1f} {:>12.2f}\n", fmt::format("{}, {}", all[k]->name, all[k]->what),
               best[k], best[k] / best[0]);
  ratios["distance, " + title + ": double, of a robust decision"] = best[0] / best[4];
  ratios["distance, " + title + ": double, of a rounded distance"] = best[0] / best[5];
  return true;
}

std::vector<PairSample> pairs_of(const std::string& path) {
  const auto loaded = deck::load(path);
  if (!loaded) return {};
  deck::Diagnostics ignored;
  deck::SceneOptions options = loaded->scene_options();
  options.penetrations = options.candidates = false;
  return deck::scene_pairs(loaded->scene_with(options, ignored), 40000);
}

Settings parse(int argc, char** argv) {
  Settings s;
  for (int i = 1; i < argc; ++i) {
    const std::string_view arg = argv[i];
    const auto value = [&] { return ++i < argc ? argv[i] : ""; };
    if (arg == "--samples")
      s.samples = std::strtoull(value(), nullptr, 10);
    else if (arg == "--rounds")
      s.rounds = std::atoi(value());
    else if (arg == "--json")
      s.json = value();
    else
      s.decks.emplace_back(arg);
  }
  return s;
}

}  // namespace

int main(int argc, char** argv) {
  const Settings settings = parse(argc, argv);
  nlohmann::json ratios = nlohmann::json::object();
  std::vector<PairSample> samples;
  for (const deck::HardFamily& family : deck::hard_families()) {
    const auto some = deck::hard_cases(family.id, settings.samples);
    samples.insert(samples.end(), some.begin(), some.end());
  }
  if (!race("hard cases", samples, settings.rounds, ratios)) return 1;
  for (const std::string& path : settings.decks) {
    const auto pairs = pairs_of(path);
    const std::string name = path.substr(path.find_last_of('/') + 1);
    if (pairs.empty()) {
      fmt::print(stderr, "{}: no pairs\n", path);
      return 1;
    }
    if (!race(name, pairs, settings.rounds, ratios)) return 1;
  }
  if (!settings.json.empty())
    std::ofstream(settings.json) << nlohmann::json{{"ratios", ratios}}.dump(2) << "\n";
  return 0;
}
