// Exact contact decisions, distances and depths at the cost of doubles.
// Stages: (1) bracket of the exact distance in double; (2) distance of the closest piece in a few
// double-double operations, and its exact proof if it equals the gap in all digits; (3) closest
// point in double-double and exact proof of its parts; (4) rationals. Most pairs end in (1), ties
// (distance equal to the gap) in (2) or (3). filtered_bounds.hpp derives the bounds,
// filtered_piece.cpp does (2), filtered_exact_cgal.cpp the proofs.
#include "contact/shared/filtered.hpp"

#include <limits>

#include "contact/distance/filtered_bounds.hpp"
#include "contact/shared/exact.hpp"

namespace deck {

template SegmentClosest<double> closest_on_segment<Form::reference>(
    const Point3<double>&, const std::array<Point3<double>, 4>&, bool);
template SegmentClosest<double> closest_on_segment<Form::robust>(
    const Point3<double>&, const std::array<Point3<double>, 4>&, bool);

using namespace filter;

namespace {

// Parts of a pair with its closest points, and exact answers for them.
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

// The closest part is known and the distance equals the gap in all digits: mostly exactly.
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

// Answer of double-double, with the parts that carry the closest points.
template <class Parts>
struct WideAnswer {
  Answer answer;
  Parts parts;

  template <class Pair, class Closest>
  static WideAnswer run(const Pair& pair, const Closest& c, bool guided, double gap) {
    const auto v = pair.template hull_of<DoubleDouble>();
    const auto w = wide_closest(pair, c, v, guided);
    return {answer_of(w, v, largest_magnitudes(v), pair.triangle, gap), parts_of(w)};
  }
};

// Sign of (gap - distance) in double, then double-double, then exactly. whole(): by rationals.
template <class Pair, class Closest, class Whole>
bool is_closer(Pair pair, double gap, FilterCounters* counters, const Closest* hint,
               const Whole& whole) {
  const double big = largest_of(pair.largest);
  FilterStage stage = FilterStage::double_precision;
  Answer answer = big == 0.0 ? Answer::yes : Answer::unknown;
  const Scaled scaled = big == 0.0 ? Scaled{} : Scaled::of(pair.points, big);
  if (scaled.shift != 0) pair.refresh();
  const std::optional<double> limit = scaled.gap(gap);
  if (answer == Answer::unknown && hint != nullptr && scaled.shift == 0)
    answer = answer_of(*hint, pair.v, pair.largest, pair.triangle, gap);
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
    // The closest parts in double are nearly always right: first their exact proof, then others.
    for (const bool guided : Pair::guided) {
      if (answer != Answer::unknown || too_small) break;
      const auto wide = fused<WideAnswer<decltype(parts_of(c))>>(pair, c, guided, *limit);
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

// True if the gap alone decides.
bool is_settled(double gap) { return !(gap > 0.0) || gap == unbounded; }

}  // namespace

bool is_closer_than(const P& p, const std::array<P, 4>& corners, bool triangle, double gap,
                    FilterCounters* counters, const SegmentClosest<double>* hint) {
  if (is_settled(gap)) return count(counters, FilterStage::double_precision), gap > 0.0;
  return is_closer(SegmentPair(p, corners, triangle), gap, counters, hint, [&] {
    return all_finite(points_of(p, corners, triangle)) &&
           exact_compare_distance(p, corners, triangle, gap) < 0;
  });
}

bool is_closer_than(const P& s1, const P& s2, const P& m1, const P& m2, double gap,
                    FilterCounters* counters, const EdgeClosest<double>* hint) {
  if (is_settled(gap)) return count(counters, FilterStage::double_precision), gap > 0.0;
  return is_closer(EdgePair({s1, s2, m1, m2}), gap, counters, hint, [&] {
    return all_finite(std::array<P, 4>{s1, s2, m1, m2}) &&
           exact_compare_distance(s1, s2, m1, m2, gap) < 0;
  });
}

// Not nearer than the smallest number in double decides nearly all pairs.
bool is_touching(const P& p, const std::array<P, 4>& corners, bool triangle,
                 const SegmentClosest<double>* hint) {
  constexpr double least = std::numeric_limits<double>::denorm_min();
  return is_closer_than(p, corners, triangle, least, nullptr, hint) &&
         exact_compare_distance(p, corners, triangle, 0.0) == 0;
}

bool is_touching(const P& s1, const P& s2, const P& m1, const P& m2,
                 const EdgeClosest<double>* hint) {
  constexpr double least = std::numeric_limits<double>::denorm_min();
  return is_closer_than(s1, s2, m1, m2, least, nullptr, hint) &&
         exact_compare_distance(s1, s2, m1, m2, 0.0) == 0;
}

}  // namespace deck
