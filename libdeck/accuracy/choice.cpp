// Costs of the accuracies, and the resulting advice.
#include "accuracy/shared/choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/shared/words.hpp"

namespace deck {
namespace {

const AccuracyChoice& choice(const std::vector<AccuracyChoice>& all, Accuracy accuracy) {
  return *std::find_if(all.begin(), all.end(),
                       [&](const AccuracyChoice& c) { return c.accuracy == accuracy; });
}

/// Extra time of `robust` over `fast`: "+ 0.08 s (1.3 x)".
std::string price(const AccuracyChoice::OnDeck& robust, const AccuracyChoice::OnDeck& fast) {
  std::string out;
  if (robust.ratio.unmeasurable())
    out = robust.ratio.noisy() ? "An unclear extra time" : "No measurable time";
  else
    out = (robust.seconds < fast.seconds ? "- " : "+ ") +
          seconds_text(std::abs(robust.seconds - fast.seconds), robust.seconds);
  return fmt::format("{} ({})", out, ratio_text(robust.ratio));
}

}  // namespace

bool TimeRatio::unmeasurable() const { return low() <= 1.0 && high() >= 1.0; }

std::size_t AccuracyChoice::OnHardCases::kinds_never_wrong() const {
  return static_cast<std::size_t>(
      std::count_if(kinds.begin(), kinds.end(), [](const KindResult& k) { return k.wrong == 0; }));
}

std::vector<std::string> accuracy_advice(const std::vector<AccuracyChoice>& choices,
                                         const std::string& tag) {
  const AccuracyChoice& robust = choice(choices, Accuracy::robust);
  const AccuracyChoice& fast = choice(choices, Accuracy::fast);
  const AccuracyChoice& reference = choice(choices, Accuracy::reference);
  const auto named = [&](const AccuracyChoice& c) {
    const std::string name = to_string(c.accuracy);
    return tag.empty() ? name : "<" + tag + ">" + name + "</" + tag + ">";
  };
  std::vector<std::string> out;
  if (robust.deck) {
    const double slower = std::max(robust.deck->seconds, fast.deck->seconds);
    const std::size_t solver = reference.deck->wrong.size(), plain = fast.deck->wrong.size();
    out.push_back(fmt::format(
        "{} {}: {} {}, {} {}.", price(*robust.deck, *fast.deck),
        solver + plain == 0
            ? fmt::format("changes no result here, every setting decides all {} alike",
                          count(robust.deck->pairs, "pair", "pairs"))
            : fmt::format("buys {} decided right that the solver gets wrong, and {} that plain "
                          "double gets wrong",
                          count(solver, "pair", "pairs"), plain),
        named(fast), seconds_text(fast.deck->seconds, slower), named(robust),
        seconds_text(robust.deck->seconds, slower)));
  }
  const std::uint64_t wrong = robust.hard.wrong + (robust.deck ? robust.deck->wrong.size() : 0);
  if (wrong > 0)
    out.push_back(
        fmt::format("This is an error of the program, please report it: {} decides {} "
                    "wrongly.",
                    named(robust), count(wrong, "pair", "pairs")));
  else
    out.push_back(fmt::format(
        "Keep {}, the default: it decides all {} right and prints the solver's figures.",
        named(robust), count(robust.hard.pairs, "hard pair", "hard pairs")));
  return out;
}

std::string seconds_text(double seconds, double like) {
  if (like <= 0.0) like = seconds;
  struct Unit {
    double above, size;
    const char* name;
  };
  static constexpr Unit units[] = {{99.5, 60.0, "min"},
                                   {0.0995, 1.0, "s"},
                                   {0.9995e-3, 1e-3, "ms"},
                                   {0.9995e-6, 1e-6, "µs"},
                                   {0.0, 1e-9, "ns"}};
  const Unit* unit = units;
  while (like < unit->above) ++unit;
  const double v = seconds / unit->size;
  const bool whole = v >= 9.95 || unit->size == 60.0 || unit->size == 1e-9;
  if (v < 0.095 && !whole) return fmt::format("{:.2g} {}", v, unit->name);
  const int digits = whole ? 0 : v < 0.995 || unit->size == 1.0 ? 2 : 1;
  return fmt::format("{:.{}f} {}", v, digits, unit->name);
}

std::string ratio_text(double ratio) {
  return fmt::format("{:.{}f} x", ratio, ratio < 1.995 ? 2 : ratio < 9.95 ? 1 : 0);
}

std::string ratio_text(const TimeRatio& r) {
  const double percent = std::ceil(100.0 * r.spread);
  if (r.noisy() && r.unmeasurable())
    return fmt::format("noisy: {:.1f} to {:.1f} x", r.low(), r.high());
  if (r.unmeasurable()) return fmt::format("{} ±{:.0f} %", ratio_text(r.value), percent);
  if (!r.noisy()) return ratio_text(r.value);
  return fmt::format("{} ({:.1f} to {:.1f})", ratio_text(r.value), r.low(), r.high());
}

std::string share_text(std::uint64_t part, std::uint64_t all) {
  if (part == 0 || all == 0) return "0";
  const double percent = 100.0 * static_cast<double>(part) / static_cast<double>(all);
  if (percent >= 0.95) return fmt::format("{:.0f} %", percent);
  return percent < 0.01 ? "under 0.01 %" : fmt::format("{:.1g} %", percent);
}

}  // namespace deck
