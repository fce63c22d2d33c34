// Cost and correctness of each --accuracy on hard cases and on a deck, against exact arithmetic:
// the result of `deck accuracy`.
// Example: std::vector<AccuracyChoice> choices = measure_hard_cases({});
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/shared/accuracy.hpp"
#include "deck/contacts.hpp"

namespace deck {

// A time relative to that of another accuracy.
struct TimeRatio {
  double value = 1.0;
  double spread = 0.0;  // of both times, as a share
  double low() const { return value / (1.0 + spread); }
  double high() const { return value * (1.0 + spread); }
  // The difference is within the run-to-run spread.
  bool unmeasurable() const;
  // The spread is too large even for that.
  bool noisy() const { return spread > 0.2; }
};

// Decisions of one accuracy on one kind of hard cases.
struct KindResult {
  const HardFamily* kind = nullptr;
  std::uint64_t pairs = 0, wrong = 0;
  // wrong decision with the largest error of its distance; unset without one
  PairSample worst;
  double computed = 0.0, exact = 0.0;  // its distance
  bool in_contact = false;             // exactly
};

// A pair of a deck that one --accuracy decides wrongly. NaN: distance not computed.
struct WrongPair {
  std::int64_t interface = 0;
  std::vector<std::int64_t> secondary, main;  // node ids
  double gap = 0.0, exact = 0.0, computed = 0.0;
  bool in_contact = false;  // exact answer
  PairSample sample;        // its nodes
};

// Input of a picture of the deck.
struct DeckPicture {
  std::vector<std::array<Point3<double>, 4>> surface;  // some of the main segments
  std::optional<WrongPair> nearest;                    // in contact, distance nearest to its gap
};

struct AccuracyChoice {
  Accuracy accuracy{};
  struct OnDeck {
    double seconds = 0.0;  // whole `deck gaps`
    TimeRatio ratio;       // against `fast`
    std::uint64_t pairs = 0;
    std::vector<WrongPair> wrong;
    bool extrapolated = false;  // only a part of the pairs was computed exactly
  };
  std::optional<OnDeck> deck;  // nothing: no deck, or no pair in it
  struct OnHardCases {
    double ns_per_pair = 0.0;
    TimeRatio ratio;  // against `fast`
    std::uint64_t wrong = 0, pairs = 0;
    // Pairs in other notations (order of nodes, orientation, axes, powers of two), and those with
    // another answer.
    std::uint64_t rewritten = 0, other_answer = 0;
    std::vector<KindResult> kinds;
    std::size_t kinds_never_wrong() const;
  } hard;
};

using MeasureProgress = std::function<void(std::uint64_t, std::uint64_t)>;  // done, of all

struct HardCaseOptions {
  std::size_t samples = 1000;  // of each kind
  std::uint64_t seed = 1;
  int repeats = 5;                     // timings; their median counts
  std::size_t slow_limit = 1000;       // pairs timed in exact arithmetic
  std::size_t rewritten_limit = 1000;  // pairs in other notations
  MeasureProgress progress = {};
};

// Results in the order reference, fast, robust, exact, without a deck. Processor time; accuracies
// take turns, so that a slow machine slows all of them.
std::vector<AccuracyChoice> measure_hard_cases(const HardCaseOptions& options);

// FNV-1a hash of this build's answers for a hundred pairs of each kind: every decision and distance
// of each accuracy. `recorded`: g++ 12 and clang 14, -O0 and -O3, with and without AVX2.
struct AnswerDigest {
  std::uint64_t own = 0, recorded = 0;
};
AnswerDigest answer_digest();

// Limits of repetition in measure_deck(); seconds of processor time.
struct GapsTiming {
  int repeats = 5;
  double least = 0.0;    // repeat until this much is spent and times differ by at most 10 %
  double most = 1e300;   // after three rounds none begins when this much is spent
  double exact = 1e300;  // after this the exact run leaves the rest to `robust`
  MeasureProgress progress = {};
};
// Reads the deck, builds its scene with penetrations and passes it on. Second argument:
// SceneOptions::exact_over.
using GapsRun = std::function<void(Accuracy, const std::function<bool()>&,
                                   const std::function<void(const Scene&)>&)>;

// Times a whole `deck gaps` with each accuracy and fills AccuracyChoice::deck. The best repeat
// counts; accuracies take turns, the exact one runs once.
DeckPicture measure_deck(const GapsRun& run, const GapsTiming& timing,
                         std::vector<AccuracyChoice>& choices);

// Benefit of the extra time on the deck, if there is one, and the recommended accuracy. `tag`:
// element around the words of --accuracy ("" or such as "b").
std::vector<std::string> accuracy_advice(const std::vector<AccuracyChoice>& choices,
                                         const std::string& tag = {});

// "0.65 s", "31 ms", "73 µs", "240 ns", in the unit of `like` if given.
std::string seconds_text(double seconds, double like = 0.0);
// "2.7 x", "2.7 x (1.9 to 3.8)", "1.02 x ±5 %", "noisy: 0.9 to 2.0 x".
std::string ratio_text(const TimeRatio& ratio);
std::string ratio_text(double ratio);  // "2.7 x"
// "14 %", "0.3 %", "0".
std::string share_text(std::uint64_t part, std::uint64_t all);

// ---- one hard case in motion: a node passes a sliver in a hundred straight steps ----------------

struct HardMotion {
  std::array<Point3<double>, 3> corners{};
  Point3<double> from, to;  // of the node, first and last step
  double gap = 0.0;
  double way = 0.0;  // length of the node's way in one step
  struct Line {
    Accuracy accuracy{};
    std::vector<double> depth, force;  // by step; elastic force for stiffness 1
    // Steps in which the depth changes by more than the way of the node, which no distance can do.
    std::vector<std::size_t> jumps;
  };
  std::vector<Line> lines;  // reference, fast, robust, exact
};

HardMotion hard_motion();
// One sentence per step with a jump: the accuracy, its forces before and after, the exact force.
// Names are in elements `tag`, if given.
std::vector<std::string> motion_sentences(const HardMotion& motion, const std::string& tag = {});

}  // namespace deck

namespace deck::accuracy {

// Decision of one accuracy on a pair.
struct PairDecider {
  Accuracy accuracy;
  bool (*closer)(const PairSample&);      // distance below the gap
  double (*distance)(const PairSample&);  // by its formula
};

const PairDecider& word(Accuracy accuracy);

}  // namespace deck::accuracy
