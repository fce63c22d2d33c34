// --accuracy on the hard cases: wrong decisions against exact arithmetic, answers that depend on
// the notation of a pair, processor time.
#include <algorithm>
#include <cmath>
#include <limits>

#include "accuracy/shared/accuracy.hpp"
#include "accuracy/shared/choice.hpp"
#include "contact/shared/exact.hpp"
#include "contact/shared/filtered.hpp"

namespace deck {
namespace accuracy {
namespace {

template <Form F>
double plain_distance(const PairSample& s) {
  if (s.edges) return closest_between_edges<F>(s.x[0], s.x[1], s.x[2], s.x[3]).distance;
  return closest_on_segment<F>(s.x[4], s.corners(), s.triangle).distance();
}
template <Form F>
bool plainly_closer(const PairSample& s) {
  return plain_distance<F>(s) < s.gap;
}
bool surely_closer(const PairSample& s) {
  return s.edges ? is_closer_than(s.x[0], s.x[1], s.x[2], s.x[3], s.gap)
                 : is_closer_than(s.x[4], s.corners(), s.triangle, s.gap);
}
bool exactly_closer(const PairSample& s) {
  return s.gap > 0.0 &&
         (s.edges ? exact_compare_distance(s.x[0], s.x[1], s.x[2], s.x[3], s.gap)
                  : exact_compare_distance(s.x[4], s.corners(), s.triangle, s.gap)) < 0;
}
// Correctly rounded, as `--accuracy exact` prints it.
double rounded_distance(const PairSample& s) {
  return s.edges ? exact_closest_between_edges(s.x[0], s.x[1], s.x[2], s.x[3]).distance
                 : exact_closest_on_segment(s.x[4], s.corners(), s.triangle).distance;
}

constexpr PairDecider words[] = {
    {Accuracy::reference, plainly_closer<Form::reference>, plain_distance<Form::reference>},
    {Accuracy::fast, plainly_closer<Form::robust>, plain_distance<Form::robust>},
    {Accuracy::robust, surely_closer, plain_distance<Form::reference>},
    {Accuracy::exact, exactly_closer, rounded_distance},
};

}  // namespace

const PairDecider& word(Accuracy accuracy) {
  return *std::find_if(std::begin(words), std::end(words),
                       [&](const PairDecider& w) { return w.accuracy == accuracy; });
}

}  // namespace accuracy

namespace {

using accuracy::PairDecider;

/// Relative error of the distance of a wrong decision, by gap or distance.
double error_of_wrong(const PairSample& s, double computed, double exact) {
  if (!std::isfinite(computed)) return std::numeric_limits<double>::infinity();
  const double scale = std::max({s.gap, computed, exact});
  return scale > 0.0 ? std::abs(computed - exact) / scale : 0.0;
}

KindResult judge_kind(const PairDecider& word, const HardFamily& kind,
                      const std::vector<PairSample>& some, const std::vector<char>& truth) {
  KindResult out{&kind, some.size(), 0, {}, 0.0, 0.0, false};
  double most = -1.0;
  for (std::size_t k = 0; k < some.size(); ++k) {
    const PairSample& s = some[k];
    if (word.closer(s) == (truth[k] != 0)) continue;
    ++out.wrong;
    const double computed = word.distance(s);
    const double exact = accuracy::word(Accuracy::exact).distance(s);
    const double error = error_of_wrong(s, computed, exact);
    if (!(error > most)) continue;
    most = error;
    out.worst = s;
    out.computed = computed, out.exact = exact;
    out.in_contact = truth[k] != 0;
  }
  return out;
}

bool has_another_answer(const PairDecider& word, const PairSample& s) {
  const bool first = word.closer(s);
  for (const PairSample& t : {other_order(s), turned_over(s), other_axes(s)})
    if (word.closer(t) != first) return true;
  for (const int power : {-150, -1, 40, 150}) {
    PairSample t = s;
    if (scale(t, power) && word.closer(t) != first) return true;
  }
  return false;
}

/// Every n-th sample: all kinds occur.
std::vector<PairSample> thinned(const std::vector<PairSample>& samples, std::size_t limit) {
  std::vector<PairSample> out;
  const std::size_t step = samples.size() / std::max<std::size_t>(1, limit) + 1;
  for (std::size_t k = 0; k < samples.size(); k += step) out.push_back(samples[k]);
  return out;
}

/// Nanoseconds per pair of one pass. `kept` prevents the compiler from removing the work.
double pass_time(const PairDecider& word, const std::vector<PairSample>& samples) {
  static volatile std::size_t kept = 0;
  std::size_t closer = 0;
  const double start = accuracy::thread_nanoseconds();
  for (const PairSample& s : samples) closer += word.closer(s);
  const double spent = accuracy::thread_nanoseconds() - start;
  kept = kept + closer;
  return spent / static_cast<double>(samples.size());
}

/// Median of the times, and its relative distance to their lower quartile.
struct PairTime {
  double ns = 0.0, spread = 0.0;
};
PairTime median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double middle = values[values.size() / 2];
  return {middle, middle > 0.0 ? (middle - values[values.size() / 4]) / middle : 0.0};
}

void measure_times(const std::vector<PairSample>& all, const HardCaseOptions& o,
                   std::vector<AccuracyChoice>& choices) {
  const std::vector<PairSample> few = thinned(all, o.slow_limit);
  std::vector<std::vector<double>> ns(choices.size());
  for (int round = 0; round < std::max(1, o.repeats); ++round)
    for (std::size_t k = 0; k < choices.size(); ++k) {
      const PairDecider& word = accuracy::word(choices[k].accuracy);
      const bool slow = word.accuracy == Accuracy::exact;
      if (round == 0 || !slow) ns[k].push_back(pass_time(word, slow ? few : all));
    }
  PairTime fast;
  for (std::size_t k = 0; k < choices.size(); ++k)
    if (choices[k].accuracy == Accuracy::fast) fast = median(ns[k]);
  for (std::size_t k = 0; k < choices.size(); ++k) {
    const PairTime time = median(ns[k]);
    choices[k].hard.ns_per_pair = time.ns;
    if (choices[k].accuracy != Accuracy::fast && fast.ns > 0.0)
      choices[k].hard.ratio = {time.ns / fast.ns, time.spread + fast.spread};
  }
}

}  // namespace

AnswerDigest answer_digest() {
  BitDigest digest;
  for (const HardFamily& kind : hard_families())
    for (const PairSample& s : hard_cases(kind.id, 100))
      for (const PairDecider& word : accuracy::words) {
        const double d = word.distance(s);
        digest.add(std::uint64_t{word.closer(s)});
        digest.add(d);
      }
  return {digest.state, 0x0b7c8842296eef0bu};
}

std::vector<AccuracyChoice> measure_hard_cases(const HardCaseOptions& options) {
  std::vector<AccuracyChoice> choices;
  for (const PairDecider& word : accuracy::words) choices.push_back({word.accuracy, {}, {}});
  const auto kinds = hard_families();
  std::uint64_t done = 0;
  const auto step = [&] {
    if (options.progress) options.progress(done, kinds.size() + 2);
    ++done;
  };
  std::vector<PairSample> all;
  for (const HardFamily& kind : kinds) {
    step();
    const std::vector<PairSample> some = hard_cases(kind.id, options.samples, options.seed);
    if (some.empty()) continue;
    std::vector<char> truth;
    for (const PairSample& s : some) truth.push_back(accuracy::exactly_closer(s));
    for (AccuracyChoice& c : choices) {
      // The exact answer is the reference.
      c.hard.kinds.push_back(c.accuracy == Accuracy::exact
                                 ? KindResult{&kind, some.size(), 0, {}, 0.0, 0.0, false}
                                 : judge_kind(accuracy::word(c.accuracy), kind, some, truth));
      c.hard.pairs += some.size();
      c.hard.wrong += c.hard.kinds.back().wrong;
    }
    all.insert(all.end(), some.begin(), some.end());
  }
  if (all.empty()) return {};
  step();
  const std::vector<PairSample> rewritten = thinned(all, options.rewritten_limit);
  for (AccuracyChoice& c : choices) {
    c.hard.rewritten = rewritten.size();
    for (const PairSample& s : rewritten)
      c.hard.other_answer += has_another_answer(accuracy::word(c.accuracy), s);
  }
  step();
  measure_times(all, options, choices);
  return choices;
}

}  // namespace deck
