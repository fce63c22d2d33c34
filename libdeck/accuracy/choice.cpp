// Which accuracy costs what, and the advice that follows.
#include "accuracy/shared/choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/shared/count.hpp"

namespace deck {
namespace {

const TierResult* decision(const AccuracyReport& report, Accuracy accuracy) {
  const auto found = std::find_if(
      report.tiers.begin(), report.tiers.end(),
      [&](const TierResult& t) { return t.what == "gaps" && t.name == to_string(accuracy); });
  return found == report.tiers.end() ? nullptr : &*found;
}

TimeRatio ratio_of(double time, double spread, double other, double other_spread) {
  if (!(other > 0.0)) return {};
  return {time / other, spread + other_spread};
}

AccuracyChoice::OnHardCases hard_of(const TierResult& t, const TierResult& fast) {
  AccuracyChoice::OnHardCases h;
  h.ns_per_pair = t.ns_per_pair;
  h.ratio = ratio_of(t.ns_per_pair, t.spread, fast.ns_per_pair, fast.spread);
  h.wrong = t.decision_errors;
  h.pairs = t.samples;
  h.rewritten = t.rewritten;
  h.other_answers = t.invariance_violations;
  return h;
}

const AccuracyChoice* choice(const std::vector<AccuracyChoice>& all, Accuracy accuracy) {
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const AccuracyChoice& c) { return c.accuracy == accuracy; });
  return found == all.end() ? nullptr : &*found;
}

/// "2.7 times as long as fast", "as long as fast: ...", "0.8 times as long as fast".
std::string time_against(const TimeRatio& r, const std::string& fast) {
  if (r.unmeasurable())
    return fmt::format("as long as {} (no measurable difference, ±{:.0f} %)", fast,
                       std::ceil(100.0 * r.spread));
  return fmt::format("{} times as long as {}", ratio_text(r.value), fast);
}

std::string deck_clause(const AccuracyChoice& robust, const AccuracyChoice& fast,
                        const std::string& fast_name) {
  const TimeRatio& r = robust.deck->ratio;
  std::string out =
      fmt::format("on this deck it takes {}, {} {}", seconds_text(robust.deck->seconds), fast_name,
                  seconds_text(fast.deck->seconds));
  if (r.unmeasurable())
    out += fmt::format(": no measurable difference (±{:.0f} %)", std::ceil(100.0 * r.spread));
  return out;
}

}  // namespace

bool TimeRatio::unmeasurable() const { return std::abs(value - 1.0) <= spread; }

std::vector<AccuracyChoice> accuracy_choices(const AccuracyReport& hard,
                                             const AccuracyReport* deck) {
  std::vector<AccuracyChoice> out;
  const TierResult* fast = decision(hard, Accuracy::fast);
  if (fast == nullptr) return out;
  const TierResult* fast_deck = deck == nullptr ? nullptr : decision(*deck, Accuracy::fast);
  for (const Accuracy a :
       {Accuracy::reference, Accuracy::fast, Accuracy::robust, Accuracy::exact}) {
    const TierResult* t = decision(hard, a);
    if (t == nullptr) return {};
    AccuracyChoice c;
    c.accuracy = a;
    c.hard = hard_of(*t, *fast);
    for (const FamilyResult& f : hard.kinds) {
      if (f.tier != to_string(a)) continue;
      c.kinds.push_back(&f);
      ++c.hard.kinds;
      c.hard.kinds_right += f.decision_errors == 0;
    }
    const TierResult* d = deck == nullptr ? nullptr : decision(*deck, a);
    if (d != nullptr && d->seconds > 0.0 && fast_deck != nullptr)
      c.deck = {d->seconds, ratio_of(d->seconds, d->spread, fast_deck->seconds, fast_deck->spread),
                d->decision_errors, d->samples};
    out.push_back(std::move(c));
  }
  return out;
}

std::vector<std::string> accuracy_advice(const std::vector<AccuracyChoice>& choices,
                                         const std::string& tag) {
  const AccuracyChoice* robust = choice(choices, Accuracy::robust);
  const AccuracyChoice* fast = choice(choices, Accuracy::fast);
  const AccuracyChoice* reference = choice(choices, Accuracy::reference);
  if (robust == nullptr || fast == nullptr || reference == nullptr) return {};
  const auto named = [&](const AccuracyChoice& c) {
    const std::string name = to_string(c.accuracy);
    return tag.empty() ? name : "<" + tag + ">" + name + "</" + tag + ">";
  };
  const std::uint64_t wrong = robust->hard.wrong + (robust->deck ? robust->deck->wrong : 0);
  std::string first;
  if (wrong > 0)
    first = fmt::format("This is an error of the program, please report it: {} decides {} wrongly",
                        named(*robust), count(wrong, "pair", "pairs"));
  else
    first = fmt::format("Keep {}, the default", named(*robust));
  if (robust->deck) {
    first += ": " + deck_clause(*robust, *fast, named(*fast));
  } else if (wrong == 0) {
    first += fmt::format(": it decides all {} correctly",
                         count(robust->hard.pairs, "hard test pair", "hard test pairs"));
  }
  const auto& h = robust->hard;
  std::string second =
      fmt::format("Where pairs are hard it takes {}", time_against(h.ratio, named(*fast)));
  second += h.wrong == 0 ? " and is never wrong"
                         : fmt::format(" and is wrong in {} of {}", h.wrong, h.pairs);
  second += fmt::format("; {} is wrong in {} of these pairs, {} in {}.", named(*fast),
                        share_text(fast->hard.wrong, fast->hard.pairs), named(*reference),
                        share_text(reference->hard.wrong, reference->hard.pairs));
  return {first + ".", second};
}

std::string seconds_text(double seconds) {
  if (seconds < 0.9995e-6) return fmt::format("{:.0f} ns", 1e9 * seconds);
  if (seconds < 0.9995e-3)
    return fmt::format("{:.{}f} µs", 1e6 * seconds, seconds < 0.00995e-3 ? 1 : 0);
  if (seconds < 0.0995) return fmt::format("{:.{}f} ms", 1e3 * seconds, seconds < 0.00995 ? 1 : 0);
  if (seconds < 99.5) return fmt::format("{:.{}f} s", seconds, seconds < 9.95 ? 2 : 0);
  return fmt::format("{:.0f} min", seconds / 60.0);
}

std::string ratio_text(double ratio) {
  return fmt::format("{:.{}f}", ratio, ratio < 1.995 ? 2 : ratio < 9.95 ? 1 : 0);
}

std::string share_text(std::uint64_t part, std::uint64_t all) {
  if (part == 0 || all == 0) return "0";
  const double percent = 100.0 * static_cast<double>(part) / static_cast<double>(all);
  if (percent >= 0.95) return fmt::format("{:.0f} %", percent);
  return percent < 0.01 ? "under 0.01 %" : fmt::format("{:.1g} %", percent);
}

}  // namespace deck
