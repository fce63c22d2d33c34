// What each word of --accuracy costs and gives, on the hard cases and on a deck, against exact
// arithmetic: the answer of `deck accuracy`.
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

// A time against that of another accuracy.
struct TimeRatio {
  double value = 1.0;
  double spread = 0.0;  // of both times, as a share
  double low() const { return value / (1.0 + spread); }
  double high() const { return value * (1.0 + spread); }
  // The times do not differ by more than they do from run to run.
  bool unmeasurable() const;
  // They differ so much from run to run that not even that can be said.
  bool noisy() const { return spread > 0.2; }
};

// The decisions of one word about one kind of hard cases.
struct KindResult {
  const HardFamily* kind = nullptr;
  std::uint64_t pairs = 0, wrong = 0;
  // The wrong decision with the largest error of its distance; of no meaning without one.
  PairSample worst;
  double computed = 0.0, exact = 0.0;  // its distance
  bool in_contact = false;             // exactly
};

// A pair of a deck for which one --accuracy gives the wrong decision. A distance that was not
// computed is NaN.
struct WrongPair {
  std::int64_t interface = 0;
  std::vector<std::int64_t> secondary, main;  // node ids
  double gap = 0.0, exact = 0.0, computed = 0.0;
  bool in_contact = false;  // exactly
  PairSample sample;        // its nodes
};

// What a picture of the deck needs.
struct DeckPicture {
  std::vector<std::array<Point3<double>, 4>> surface;  // some of the main segments
  std::optional<WrongPair> nearest;  // the pair in contact whose distance is nearest to its gap
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
    // Pairs written down in other ways (order of nodes, orientation, axes, powers of two), and how
    // many of them got another answer.
    std::uint64_t rewritten = 0, other_answer = 0;
    std::vector<KindResult> kinds;
    std::size_t kinds_never_wrong() const;
  } hard;
};

using MeasureProgress = std::function<void(std::uint64_t, std::uint64_t)>;  // done, of all

struct HardCaseOptions {
  std::size_t samples = 1000;  // of each kind
  std::uint64_t seed = 1;
  int repeats = 5;                     // timings; the median counts
  std::size_t slow_limit = 1000;       // pairs timed in exact arithmetic
  std::size_t rewritten_limit = 1000;  // pairs written down in other ways
  MeasureProgress progress = {};
};

// The choices in the order reference, fast, robust, exact, without a deck. Processor time; the
// words take turns, so that what slows the machine down slows down all of them.
std::vector<AccuracyChoice> measure_hard_cases(const HardCaseOptions& options);

// FNV-1a over what this build answers for a hundred pairs of each kind: every decision and distance
// of each word. `recorded` is what g++ 12 and clang 14 answer, -O0 and -O3, with and without AVX2.
struct AnswerDigest {
  std::uint64_t own = 0, recorded = 0;
};
AnswerDigest answer_digest();

// How long measure_deck() repeats; seconds of processor time.
struct GapsTiming {
  int repeats = 5;
  double least = 0.0;  // runs are repeated until this much was spent and times differ by up to 10 %
  double most = 1e300;   // after three rounds none begins once this much was spent
  double exact = 1e300;  // after that the exact run leaves the rest to `robust`
  MeasureProgress progress = {};
};
// Reads the deck, builds its scene with penetrations and hands it over. The second argument:
// SceneOptions::exact_over.
using GapsRun = std::function<void(Accuracy, const std::function<bool()>&,
                                   const std::function<void(const Scene&)>&)>;

// Times the whole of `deck gaps` with each word and fills AccuracyChoice::deck. The best of the
// repeats counts; the words take turns, the exact one runs once.
DeckPicture measure_deck(const GapsRun& run, const GapsTiming& timing,
                         std::vector<AccuracyChoice>& choices);

// What the price buys on the deck, where there is one, and which word to keep. `tag` is put around
// the words of --accuracy: "", or an element such as "b".
std::vector<std::string> accuracy_advice(const std::vector<AccuracyChoice>& choices,
                                         const std::string& tag = {});

// "0.65 s", "31 ms", "73 µs", "240 ns", in the unit of `like` where one is given.
std::string seconds_text(double seconds, double like = 0.0);
// "2.7 x", "2.7 x (1.9 to 3.8)", "1.02 x ±5 %", "noisy: 0.9 to 2.0 x".
std::string ratio_text(const TimeRatio& ratio);
std::string ratio_text(double ratio);  // "2.7 x"
// "14 %", "0.3 %", "0".
std::string share_text(std::uint64_t part, std::uint64_t all);

// ---- one hard case in motion: a node passes a sliver in a hundred straight steps, judged as each
// word of --accuracy does
// --------------------------------------------------------------------------

struct HardMotion {
  std::array<Point3<double>, 3> corners{};
  Point3<double> from, to;  // of the node, at the first and the last step
  double gap = 0.0;
  double way = 0.0;  // of the node in one step
  struct Line {
    Accuracy accuracy{};
    std::vector<double> depth, force;  // by step; the elastic force of a stiffness of 1
    // Steps where the depth changes by more than the way of the node. No distance can do that, so
    // it is the formula that jumps.
    std::vector<std::size_t> jumps;
  };
  std::vector<Line> lines;  // reference, fast, robust, exact
};

HardMotion hard_motion();
// One sentence a step with a jump: who jumps, from which force to which, and the exact one. Names
// stand in elements `tag`; without one they stand alone.
std::vector<std::string> motion_sentences(const HardMotion& motion, const std::string& tag = {});

}  // namespace deck

namespace deck::accuracy {

// How each word of --accuracy decides a pair. Private to the accuracy stage.
struct Word {
  Accuracy accuracy;
  bool (*closer)(const PairSample&);      // the distance is below the gap
  double (*distance)(const PairSample&);  // by its formula
};

const Word& word(Accuracy accuracy);

}  // namespace deck::accuracy
