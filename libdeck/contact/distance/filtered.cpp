// Contact decisions, distances and depths: brackets of the exact distance in double and
// double-double, else exact numbers.
#include "contact/shared/filtered.hpp"

#include <cmath>

#include "contact/distance/filtered_bounds.hpp"
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

// ---- distances and depths as exact as they are asked for ---------------------------------------

namespace {

// Depth and distance if the bracket [low, high] of the distance fixes both well enough.
constexpr double depth_tolerance = 0x1p-40;
template <class T>
std::optional<FilteredDepth> depth_within(const T& low, const T& high, double gap) {
  if (low >= T(gap)) return FilteredDepth{};
  const T width = high - low, depth = T(gap) - high;
  if (!(width <= T(depth_tolerance) * low && width <= T(depth_tolerance) * depth))
    return std::nullopt;
  FilteredDepth out;
  out.depth = static_cast<double>(T(gap) - low);
  out.distance = static_cast<double>(low);
  return out;
}
// Back at the original scale; nothing where that loses digits.
std::optional<FilteredDepth> rescaled(FilteredDepth out, int shift, FilterStage stage) {
  out.stage = stage;
  if (shift == 0 || out.depth == 0.0) return out;
  out.depth = std::ldexp(out.depth, -shift);
  out.distance = std::ldexp(out.distance, -shift);
  if (!std::isnormal(out.depth) || !std::isnormal(out.distance)) return std::nullopt;
  return out;
}
// The closest points in double-double, and their distance rounded once where the bracket tells.
struct RoundedSegment {
  SegmentClosest<DoubleDouble> closest;
  std::optional<double> distance;

  static RoundedSegment run(const SegmentPair& pair, const SegmentClosest<double>& c, bool guided,
                            int shift) {
    const auto v = wide_hull<DoubleDouble>(pair);
    const auto w = wide_closest(pair, c, v, guided);
    return {w, rounded(lower_bound(w, v, largest_magnitudes(v), pair.triangle),
                       upper_bound(w.weights, v), shift)};
  }
};
struct RoundedEdges {
  EdgeClosest<DoubleDouble> closest;
  std::optional<double> distance;

  static RoundedEdges run(const EdgePair& pair, int shift) {
    const auto v = pair.hull_of<DoubleDouble>();
    const auto w = wide_closest(pair);
    return {w, rounded(lower_bound(w, v, largest_magnitudes(v)), upper_bound(hull_weights(w), v),
                       shift)};
  }
};
FilteredDepth in_exact_numbers(const ExactDepth& d) {
  return {d.depth, d.distance, FilterStage::exact};
}

}  // namespace

FilteredDepth filtered_depth(const P& p, const std::array<P, 4>& corners, bool triangle, double gap,
                             FilterCounters* counters) {
  const auto give = [counters](const FilteredDepth& out) {
    count(counters, out.stage);
    return out;
  };
  if (!(gap > 0.0)) return give({});
  SegmentPair pair(p, corners, triangle);
  const double big = largest_of(pair.largest);
  const Scaled scaled = big == 0.0 ? Scaled{} : Scaled::of(pair.points, big);
  if (scaled.shift != 0) pair.refresh();
  if (const std::optional<double> limit = scaled.gap(gap); limit && std::isfinite(*limit)) {
    if (clearly_apart(pair, *limit)) return give({});
    const auto c = closest_on_segment<Form::robust>(pair.points[4], pair.corners(), triangle);
    const auto narrow = depth_within(lower_bound(c, pair.v, pair.largest, triangle),
                                     upper_bound(c.weights, pair.v), *limit);
    if (narrow)
      if (const auto out = rescaled(*narrow, scaled.shift, FilterStage::double_precision))
        return give(*out);
    const auto v = wide_hull<DoubleDouble>(pair);
    const auto largest = largest_magnitudes(v);
    for (const bool guided : {true, false}) {
      const auto w = wide_closest(pair, c, v, guided);
      const auto wide =
          depth_within(lower_bound(w, v, largest, triangle), upper_bound(w.weights, v), *limit);
      if (!wide) continue;
      if (const auto out = rescaled(*wide, scaled.shift, FilterStage::double_double))
        return give(*out);
    }
  }
  if (!all_finite(points_of(p, corners, triangle)) || !std::isfinite(gap)) return give({});
  return give(in_exact_numbers(exact_depth(p, corners, triangle, gap)));
}

FilteredDepth filtered_depth(const P& s1, const P& s2, const P& m1, const P& m2, double gap,
                             FilterCounters* counters) {
  const auto give = [counters](const FilteredDepth& out) {
    count(counters, out.stage);
    return out;
  };
  if (!(gap > 0.0)) return give({});
  EdgePair pair({s1, s2, m1, m2});
  const double big = largest_of(pair.largest);
  const Scaled scaled = big == 0.0 ? Scaled{} : Scaled::of(pair.points, big);
  if (scaled.shift != 0) pair.refresh();
  if (const std::optional<double> limit = scaled.gap(gap); limit && std::isfinite(*limit)) {
    if (clearly_apart(pair, *limit)) return give({});
    const auto c = closest_of(pair);
    const auto narrow = depth_within(lower_bound(c, pair.v, pair.largest),
                                     upper_bound(hull_weights(c), pair.v), *limit);
    if (narrow)
      if (const auto out = rescaled(*narrow, scaled.shift, FilterStage::double_precision))
        return give(*out);
    const auto v = pair.hull_of<DoubleDouble>();
    const auto w = wide_closest(pair);
    const auto wide = depth_within(lower_bound(w, v, largest_magnitudes(v)),
                                   upper_bound(hull_weights(w), v), *limit);
    if (wide)
      if (const auto out = rescaled(*wide, scaled.shift, FilterStage::double_double))
        return give(*out);
  }
  if (!all_finite(std::array<P, 4>{s1, s2, m1, m2}) || !std::isfinite(gap)) return give({});
  return give(in_exact_numbers(exact_depth(s1, s2, m1, m2, gap)));
}

bool is_touching(const P& p, const std::array<P, 4>& corners, bool triangle) {
  // Nearer than the smallest number: not nearer in double is an answer for nearly all pairs.
  SegmentPair pair(p, corners, triangle);
  if (clearly_apart(pair, std::numeric_limits<double>::denorm_min())) return false;
  return filtered_closest_on_segment(p, corners, triangle).distance == 0.0 &&
         exact_compare_distance(p, corners, triangle, 0.0) == 0;
}

bool is_touching(const P& s1, const P& s2, const P& m1, const P& m2) {
  EdgePair pair({s1, s2, m1, m2});
  if (clearly_apart(pair, std::numeric_limits<double>::denorm_min())) return false;
  return filtered_closest_between_edges(s1, s2, m1, m2).distance == 0.0 &&
         exact_compare_distance(s1, s2, m1, m2, 0.0) == 0;
}

FilteredSegment filtered_closest_on_segment(const P& p, const std::array<P, 4>& corners,
                                            bool triangle, FilterCounters* counters) {
  FilteredSegment out;
  SegmentPair pair(p, corners, triangle);
  const double big = largest_of(pair.largest);
  const Scaled scaled = big == 0.0 ? Scaled{0, false} : Scaled::of(pair.points, big);
  if (scaled.possible) {
    if (scaled.shift != 0) pair.refresh();
    const auto c = closest_on_segment<Form::robust>(pair.points[4], pair.corners(), triangle);
    const auto piece = piece_distance(pair, c);
    const bool certain = piece && piece->one_part;
    if (const auto value = certain ? piece->rounded(scaled.shift) : std::nullopt) {
      out = {*value, c.feature, c.feature_index, c.weights, FilterStage::double_double};
      count(counters, out.stage);
      return out;
    }
    auto wide = fused<RoundedSegment>(pair, c, true, scaled.shift);
    if (!wide.distance) wide = fused<RoundedSegment>(pair, c, false, scaled.shift);
    const auto& w = wide.closest;
    if (wide.distance) {
      out.distance = *wide.distance;
      out.feature = w.feature;
      out.feature_index = w.feature_index;
      for (std::size_t k = 0; k < 4; ++k) out.weights[k] = w.weights[k].hi();
      count(counters, out.stage);
      return out;
    }
    if (prove_closer(pair.points, triangle, w.best, guesses(w), 0.0).value_or(false)) {
      for (std::size_t k = 0; k < 4; ++k) out.weights[k] = w.weights[k].hi();
      out = {0.0, w.feature, w.feature_index, out.weights, FilterStage::exact};
      count(counters, out.stage);
      return out;
    }
  }
  if (!all_finite(points_of(p, corners, triangle))) {
    out.distance = std::numeric_limits<double>::quiet_NaN();
    return out;
  }
  const ExactSegment e = exact_closest_on_segment(p, corners, triangle);
  out = {e.distance, e.feature, e.feature_index, e.weights, FilterStage::exact};
  count(counters, out.stage);
  return out;
}

FilteredEdges filtered_closest_between_edges(const P& s1, const P& s2, const P& m1, const P& m2,
                                             FilterCounters* counters) {
  FilteredEdges out;
  EdgePair pair({s1, s2, m1, m2});
  const double big = largest_of(pair.largest);
  const Scaled scaled = big == 0.0 ? Scaled{0, false} : Scaled::of(pair.points, big);
  if (scaled.possible) {
    if (scaled.shift != 0) pair.refresh();
    const auto c = closest_of(pair);
    const auto piece = piece_distance(pair, c, true);
    const bool certain = piece && piece->one_part;
    if (const auto value = certain ? piece->rounded(scaled.shift) : std::nullopt) {
      out = {*value,      piece->weight[0], piece->weight[1],
             c.feature_s, c.feature_m,      FilterStage::double_double};
      count(counters, out.stage);
      return out;
    }
    const auto wide = fused<RoundedEdges>(pair, scaled.shift);
    const auto& w = wide.closest;
    if (wide.distance) {
      out = {*wide.distance, w.weight_s.hi(), w.weight_m.hi(),
             w.feature_s,    w.feature_m,     FilterStage::double_double};
      count(counters, out.stage);
      return out;
    }
    if (prove_closer(pair.points, w.feature_s, w.feature_m, w.parallel, 0.0).value_or(false)) {
      out = {0.0, w.weight_s.hi(), w.weight_m.hi(), w.feature_s, w.feature_m, FilterStage::exact};
      count(counters, out.stage);
      return out;
    }
  }
  if (!all_finite(std::array<P, 4>{s1, s2, m1, m2})) {
    out.distance = std::numeric_limits<double>::quiet_NaN();
    return out;
  }
  const ExactEdges e = exact_closest_between_edges(s1, s2, m1, m2);
  out = {e.distance, e.weight_s, e.weight_m, e.feature_s, e.feature_m, FilterStage::exact};
  count(counters, out.stage);
  return out;
}

}  // namespace deck
