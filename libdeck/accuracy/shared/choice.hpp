// What each word of --accuracy costs and gives: the answer of `deck accuracy`, from what was
// measured on a deck and on the hard cases.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/shared/accuracy.hpp"

namespace deck {

// A time against that of another accuracy.
struct TimeRatio {
  double value = 1.0;
  double spread = 0.0;  // of both times, as a share
  // The times do not differ by more than they do from run to run.
  bool unmeasurable() const;
};

struct AccuracyChoice {
  Accuracy accuracy{};
  struct OnDeck {
    double seconds = 0.0;  // whole `deck gaps`
    TimeRatio ratio;       // against `fast`
    std::uint64_t wrong = 0, pairs = 0;
  };
  std::optional<OnDeck> deck;  // nothing: no deck, or no pair in it
  struct OnHardCases {
    double ns_per_pair = 0.0;
    TimeRatio ratio;  // against `fast`
    std::uint64_t wrong = 0, pairs = 0;
    // Pairs written down in other ways, and how many of them got another answer.
    std::uint64_t rewritten = 0, other_answers = 0;
    std::uint64_t kinds_right = 0, kinds = 0;  // kinds of hard cases without a wrong decision
  };
  OnHardCases hard;
  std::vector<const FamilyResult*> kinds;  // in the report of the hard cases
};

// In the order reference, fast, robust, exact. `deck` may be nullptr. Empty if `hard` has no
// decisions.
std::vector<AccuracyChoice> accuracy_choices(const AccuracyReport& hard,
                                             const AccuracyReport* deck);

// Two sentences: which accuracy to keep, and why. `names` is put around the words of --accuracy,
// "" or a tag such as "b". Empty without choices.
std::vector<std::string> accuracy_advice(const std::vector<AccuracyChoice>& choices,
                                         const std::string& tag = {});

// "0.65 s", "31 ms", "73 µs", "240 ns".
std::string seconds_text(double seconds);
// "2.7", "258", "0.98".
std::string ratio_text(double ratio);
// "14 %", "0.3 %", "0".
std::string share_text(std::uint64_t part, std::uint64_t all);

}  // namespace deck
