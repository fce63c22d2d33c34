// Contact decisions: brackets of the exact distance in double and double-double, else exact
// numbers.
#include "contact/shared/filtered.hpp"

#include "contact/distance/filtered_bounds.hpp"
#include "contact/distance/filtered_piece.hpp"
#include "contact/distance/fused.hpp"
#include "contact/shared/exact.hpp"

namespace deck {

using namespace filter;

namespace {

// What double-double says of a pair, and on which parts it took the closest points to lie.
struct WideSegment {
  Answer answer;
  int best;
  std::array<PartGuess, 4> guess;

  static WideSegment run(const SegmentPair& pair, const SegmentClosest<double>& c, bool guided,
                         double gap) {
    const auto v = wide_hull<DoubleDouble>(pair);
    const auto w = wide_closest(pair, c, v, guided);
    return {answer_of(w, v, largest_magnitudes(v), pair.triangle, gap), w.best, guesses(w)};
  }
};
struct WideEdges {
  Answer answer;
  EdgeFeature feature_s, feature_m;
  bool parallel;

  static WideEdges run(const EdgePair& pair, double gap) {
    const auto v = pair.hull_of<DoubleDouble>();
    const auto w = wide_closest(pair);
    return {answer_of(w, v, largest_magnitudes(v), gap), w.feature_s, w.feature_m, w.parallel};
  }
};

}  // namespace

bool is_closer_than(const P& p, const std::array<P, 4>& corners, bool triangle, double gap,
                    FilterCounters* counters) {
  if (!(gap > 0.0)) return count(counters, FilterStage::double_precision), false;
  if (gap == unbounded) return count(counters, FilterStage::double_precision), true;
  SegmentPair pair(p, corners, triangle);
  const double big = largest_of(pair.largest);
  FilterStage stage = FilterStage::double_precision;
  Answer answer = big == 0.0 ? Answer::yes : Answer::unknown;
  const Scaled scaled = big == 0.0 ? Scaled{} : Scaled::of(pair.points, big);
  if (scaled.shift != 0) pair.refresh();
  const std::optional<double> limit = scaled.gap(gap);
  if (answer == Answer::unknown && limit) {
    if (clearly_apart(pair, *limit)) return count(counters, stage), false;
    const auto c = closest_on_segment<Form::robust>(pair.points[4], pair.corners(), triangle);
    answer = answer_of(c, pair.v, pair.largest, triangle, *limit);
    const bool too_small = beyond_double_double(larger(c.distance(), *limit), big);
    if (answer == Answer::unknown) {
      stage = FilterStage::double_double;
      const auto piece = too_small ? std::nullopt : piece_distance(pair, c);
      if (piece) answer = piece->closer_than(*limit);
      // The closest part is known and the distance is the gap to all digits: mostly it is the gap.
      if (answer == Answer::unknown && (piece || too_small)) {
        stage = FilterStage::exact;
        answer = proved(piece ? is_closer_to_piece(pair.points, piece->piece, *limit)
                              : prove_closer(pair.points, triangle, c.best, guesses(c), *limit));
      }
    }
    if (answer == Answer::unknown && !too_small) {
      // What double took for the closest parts nearly always is that: first the exact proof,
      // then other parts.
      for (const bool guided : {true, false}) {
        const auto wide = fused<WideSegment>(pair, c, guided, *limit);
        answer = wide.answer;
        if (answer != Answer::unknown) break;
        stage = FilterStage::exact;
        answer = proved(prove_closer(pair.points, triangle, wide.best, wide.guess, *limit));
        if (answer != Answer::unknown) break;
      }
    }
  }
  if (answer == Answer::unknown) {
    stage = FilterStage::exact;
    const bool closer = all_finite(points_of(p, corners, triangle)) &&
                        exact_compare_distance(p, corners, triangle, gap) < 0;
    answer = closer ? Answer::yes : Answer::no;
  }
  count(counters, stage);
  return answer == Answer::yes;
}

bool is_closer_than(const P& s1, const P& s2, const P& m1, const P& m2, double gap,
                    FilterCounters* counters) {
  if (!(gap > 0.0)) return count(counters, FilterStage::double_precision), false;
  if (gap == unbounded) return count(counters, FilterStage::double_precision), true;
  EdgePair pair({s1, s2, m1, m2});
  const double big = largest_of(pair.largest);
  FilterStage stage = FilterStage::double_precision;
  Answer answer = big == 0.0 ? Answer::yes : Answer::unknown;
  const Scaled scaled = big == 0.0 ? Scaled{} : Scaled::of(pair.points, big);
  if (scaled.shift != 0) pair.refresh();
  const std::optional<double> limit = scaled.gap(gap);
  if (answer == Answer::unknown && limit) {
    if (clearly_apart(pair, *limit)) return count(counters, stage), false;
    const auto c = closest_of(pair);
    answer = answer_of(c, pair.v, pair.largest, *limit);
    if (answer == Answer::unknown) {
      stage = FilterStage::double_double;
      const auto piece = piece_distance(pair, c);
      if (piece) answer = piece->closer_than(*limit);
      if (piece && answer == Answer::unknown) {
        stage = FilterStage::exact;
        answer = proved(prove_closer(pair.points, c.feature_s, c.feature_m, c.parallel, *limit));
      }
    }
    if (answer == Answer::unknown) {
      const auto wide = fused<WideEdges>(pair, *limit);
      answer = wide.answer;
      if (answer == Answer::unknown) {
        stage = FilterStage::exact;
        answer = proved(
            prove_closer(pair.points, wide.feature_s, wide.feature_m, wide.parallel, *limit));
      }
    }
  }
  if (answer == Answer::unknown) {
    stage = FilterStage::exact;
    const bool closer = all_finite(std::array<P, 4>{s1, s2, m1, m2}) &&
                        exact_compare_distance(s1, s2, m1, m2, gap) < 0;
    answer = closer ? Answer::yes : Answer::no;
  }
  count(counters, stage);
  return answer == Answer::yes;
}

}  // namespace deck
