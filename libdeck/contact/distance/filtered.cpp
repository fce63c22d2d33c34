// Contact decisions: brackets of the exact distance in double and double-double, else exact
// numbers.
#include "contact/shared/filtered.hpp"

#include "contact/distance/exact.hpp"
#include "contact/distance/filtered_bounds.hpp"
#include "contact/distance/filtered_piece.hpp"

namespace deck {

using namespace filter;

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
    if (answer == Answer::unknown) {
      stage = FilterStage::double_double;
      const auto piece = piece_distance(pair, c);
      if (piece) answer = piece->closer_than(*limit);
      // The closest part is known and the distance is the gap to all digits: mostly it is the gap.
      if (piece && answer == Answer::unknown) {
        stage = FilterStage::exact;
        answer = proved(prove_closer(pair.points, triangle, c.best, guesses(c), *limit));
      }
    }
    if (answer == Answer::unknown) {
      const auto v = wide_hull<DoubleDouble>(pair);
      const P largest = largest_magnitudes(v);
      // What double took for the closest parts nearly always is that: first the exact proof,
      // then other parts.
      for (const bool guided : {true, false}) {
        const auto w = wide_closest(pair, c, v, guided);
        answer = answer_of(w, v, largest, triangle, *limit);
        if (answer != Answer::unknown) break;
        stage = FilterStage::exact;
        answer = proved(prove_closer(pair.points, triangle, w.best, guesses(w), *limit));
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
      const auto v = pair.hull_of<DoubleDouble>();
      const auto w = wide_closest(pair);
      answer = answer_of(w, v, largest_magnitudes(v), *limit);
      if (answer == Answer::unknown) {
        stage = FilterStage::exact;
        answer = proved(prove_closer(pair.points, w.feature_s, w.feature_m, w.parallel, *limit));
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
