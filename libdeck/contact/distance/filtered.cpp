// Contact decisions, distances and depths: brackets of the exact distance in double and
// double-double, else exact numbers.
#include "contact/shared/filtered.hpp"

#include <cmath>

#include "contact/distance/filtered_bounds.hpp"
#include "contact/shared/exact.hpp"

namespace deck {

using namespace filter;

namespace {

// The parts that the closest points of a pair lie on, and exact answers if they do.
struct SegmentParts {
  int best;
  std::array<PartGuess, 4> guess;
};
struct EdgeParts {
  EdgeFeature secondary, main;
  bool parallel;
};
template <class T>
SegmentParts parts_of(const SegmentClosest<T>& c) {
  return {c.best, guesses(c)};
}
template <class T>
EdgeParts parts_of(const EdgeClosest<T>& c) {
  return {c.feature_s, c.feature_m, c.parallel};
}
std::optional<bool> prove(const SegmentPair& pair, const SegmentParts& on, double gap) {
  return prove_closer(pair.points, pair.triangle, on.best, on.guess, gap);
}
std::optional<bool> prove(const EdgePair& pair, const EdgeParts& on, double gap) {
  return prove_closer(pair.points, on.secondary, on.main, on.parallel, gap);
}

// The closest part is known and the distance is the gap to all digits: mostly it is the gap.
std::optional<bool> prove_piece(const SegmentPair& pair, const std::optional<PieceDistance>& piece,
                                const SegmentClosest<double>& c, double gap) {
  return piece ? is_closer_to_piece(pair.points, piece->piece, gap) : prove(pair, parts_of(c), gap);
}
std::optional<bool> prove_piece(const EdgePair& pair, const std::optional<PieceDistance>&,
                                const EdgeClosest<double>& c, double gap) {
  return prove(pair, parts_of(c), gap);
}

bool is_too_small(const SegmentClosest<double>& c, double gap, double big) {
  return beyond_double_double(larger(c.distance(), gap), big);
}
bool is_too_small(const EdgeClosest<double>&, double, double) { return false; }

// What double-double says of a pair, and on which parts it took the closest points to lie.
template <class Parts>
struct Wide {
  Answer answer;
  Parts parts;

  template <class Pair, class Closest>
  static Wide run(const Pair& pair, const Closest& c, bool guided, double gap) {
    const auto v = pair.template hull_of<DoubleDouble>();
    const auto w = wide_closest(pair, c, v, guided);
    return {answer_of(w, v, largest_magnitudes(v), pair.triangle, gap), parts_of(w)};
  }
};

// Sign of (gap - distance), in double as far as that tells, then in double-double, then exactly;
// whole(): the answer of exact numbers alone.
template <class Pair, class Whole>
bool is_closer(Pair pair, double gap, FilterCounters* counters, const Whole& whole) {
  const double big = largest_of(pair.largest);
  FilterStage stage = FilterStage::double_precision;
  Answer answer = big == 0.0 ? Answer::yes : Answer::unknown;
  const Scaled scaled = big == 0.0 ? Scaled{} : Scaled::of(pair.points, big);
  if (scaled.shift != 0) pair.refresh();
  const std::optional<double> limit = scaled.gap(gap);
  if (answer == Answer::unknown && limit) {
    if (clearly_apart(pair, *limit)) return count(counters, stage), false;
    const auto c = closest_of(pair);
    answer = answer_of(c, pair.v, pair.largest, pair.triangle, *limit);
    const bool too_small = is_too_small(c, *limit, big);
    if (answer == Answer::unknown) {
      stage = FilterStage::double_double;
      const auto piece = too_small ? std::nullopt : piece_distance(pair, c);
      if (piece) answer = piece->closer_than(*limit);
      if (answer == Answer::unknown && (piece || too_small)) {
        stage = FilterStage::exact;
        answer = proved(prove_piece(pair, piece, c, *limit));
      }
    }
    // What double took for the closest parts nearly always is that: first the exact proof, then
    // other parts.
    for (const bool guided : Pair::guided) {
      if (answer != Answer::unknown || too_small) break;
      const auto wide = fused<Wide<decltype(parts_of(c))>>(pair, c, guided, *limit);
      answer = wide.answer;
      if (answer != Answer::unknown) break;
      stage = FilterStage::exact;
      answer = proved(prove(pair, wide.parts, *limit));
    }
  }
  if (answer == Answer::unknown) {
    stage = FilterStage::exact;
    answer = whole() ? Answer::yes : Answer::no;
  }
  count(counters, stage);
  return answer == Answer::yes;
}

// True: the gap alone gives the answer.
bool is_settled(double gap) { return !(gap > 0.0) || gap == unbounded; }

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
    const auto v = pair.hull_of<DoubleDouble>();
    const auto w = wide_closest(pair, c, v, guided);
    return {w, rounded(lower_bound(w, v, largest_magnitudes(v), pair.triangle),
                       upper_bound(w.weights, v), shift)};
  }
};
struct RoundedEdges {
  EdgeClosest<DoubleDouble> closest;
  std::optional<double> distance;

  static RoundedEdges run(const EdgePair& pair, const EdgeClosest<double>& c, int shift) {
    const auto v = pair.hull_of<DoubleDouble>();
    const auto w = wide_closest(pair, c, v, true);
    return {w, rounded(lower_bound(w, v, largest_magnitudes(v), false),
                       upper_bound(hull_weights(w), v), shift)};
  }
};
// whole(): the answer of exact numbers; asked for where the rest does not tell.
template <class Pair, class Whole>
FilteredDepth bracketed_depth(Pair pair, double gap, FilterCounters* counters, const Whole& whole) {
  const auto give = [counters](const FilteredDepth& out) {
    count(counters, out.stage);
    return out;
  };
  if (!(gap > 0.0)) return give({});
  const double big = largest_of(pair.largest);
  const Scaled scaled = big == 0.0 ? Scaled{} : Scaled::of(pair.points, big);
  if (scaled.shift != 0) pair.refresh();
  if (const std::optional<double> limit = scaled.gap(gap); limit && std::isfinite(*limit)) {
    if (clearly_apart(pair, *limit)) return give({});
    const auto c = closest_of(pair);
    const auto narrow = depth_within(lower_bound(c, pair.v, pair.largest, pair.triangle),
                                     upper_bound(hull_weights(c), pair.v), *limit);
    if (narrow)
      if (const auto out = rescaled(*narrow, scaled.shift, FilterStage::double_precision))
        return give(*out);
    const auto v = pair.template hull_of<DoubleDouble>();
    const auto largest = largest_magnitudes(v);
    for (const bool guided : Pair::guided) {
      const auto w = wide_closest(pair, c, v, guided);
      const auto wide = depth_within(lower_bound(w, v, largest, pair.triangle),
                                     upper_bound(hull_weights(w), v), *limit);
      if (!wide) continue;
      if (const auto out = rescaled(*wide, scaled.shift, FilterStage::double_double))
        return give(*out);
    }
  }
  const std::optional<ExactDepth> exact = std::isfinite(gap) ? whole() : std::nullopt;
  return give(exact ? FilteredDepth{exact->depth, exact->distance, FilterStage::exact}
                    : FilteredDepth{});
}

}  // namespace

bool is_closer_than(const P& p, const std::array<P, 4>& corners, bool triangle, double gap,
                    FilterCounters* counters) {
  if (is_settled(gap)) return count(counters, FilterStage::double_precision), gap > 0.0;
  return is_closer(SegmentPair(p, corners, triangle), gap, counters, [&] {
    return all_finite(points_of(p, corners, triangle)) &&
           exact_compare_distance(p, corners, triangle, gap) < 0;
  });
}

bool is_closer_than(const P& s1, const P& s2, const P& m1, const P& m2, double gap,
                    FilterCounters* counters) {
  if (is_settled(gap)) return count(counters, FilterStage::double_precision), gap > 0.0;
  return is_closer(EdgePair({s1, s2, m1, m2}), gap, counters, [&] {
    return all_finite(std::array<P, 4>{s1, s2, m1, m2}) &&
           exact_compare_distance(s1, s2, m1, m2, gap) < 0;
  });
}

// ---- distances and depths as exact as they are asked for ---------------------------------------

FilteredDepth filtered_depth(const P& p, const std::array<P, 4>& corners, bool triangle, double gap,
                             FilterCounters* counters) {
  return bracketed_depth(SegmentPair(p, corners, triangle), gap, counters,
                         [&]() -> std::optional<ExactDepth> {
                           if (!all_finite(points_of(p, corners, triangle))) return std::nullopt;
                           return exact_depth(p, corners, triangle, gap);
                         });
}

FilteredDepth filtered_depth(const P& s1, const P& s2, const P& m1, const P& m2, double gap,
                             FilterCounters* counters) {
  return bracketed_depth(EdgePair({s1, s2, m1, m2}), gap, counters,
                         [&]() -> std::optional<ExactDepth> {
                           if (!all_finite(std::array<P, 4>{s1, s2, m1, m2})) return std::nullopt;
                           return exact_depth(s1, s2, m1, m2, gap);
                         });
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
    const auto c = closest_of(pair);
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
    const auto wide = fused<RoundedEdges>(pair, c, scaled.shift);
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
