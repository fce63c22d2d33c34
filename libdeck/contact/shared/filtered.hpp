// Exact distances and contact decisions: double with a rigorous error bound first, double-double if
// that does not decide, then exact rationals.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "contact/shared/closest.hpp"
#include "deck/contacts.hpp"

namespace deck {

// Arithmetic that decided.
enum class FilterStage : std::uint8_t { double_precision, double_double, exact };

// Number of pairs per arithmetic. Add threads by +=.
struct FilterCounters {
  std::uint64_t pairs = 0;
  std::uint64_t double_double = 0;  // pairs not decided in double
  std::uint64_t exact = 0;          // pairs that needed exact rationals
  FilterCounters& operator+=(const FilterCounters& other) {
    pairs += other.pairs;
    double_double += other.double_double;
    exact += other.exact;
    return *this;
  }
};

// Sign of (gap - distance) of the given doubles without round-off: true if and only if the exact
// distance is smaller than `gap`. Finite coordinates; false for a gap that is NaN, zero or
// negative. Conventions of closest_on_segment and closest_between_edges.
//
// Upper bound: any point of the segment. Lower bound: for any direction w, min over the vertices of
// w.(node - vertex) / |w|. Both include their round-off, so a wrong closest point costs time but
// gives no wrong answer.
// `hint`: closest points by any formula, which mostly decide; they cannot mislead.
bool is_closer_than(const Point3<double>& p, const std::array<Point3<double>, 4>& corners,
                    bool triangle, double gap, FilterCounters* counters = nullptr,
                    const SegmentClosest<double>* hint = nullptr);
bool is_closer_than(const Point3<double>& s1, const Point3<double>& s2, const Point3<double>& m1,
                    const Point3<double>& m2, double gap, FilterCounters* counters = nullptr,
                    const EdgeClosest<double>* hint = nullptr);

// True if and only if the exact distance is 0. Finite coordinates.
bool is_touching(const Point3<double>& p, const std::array<Point3<double>, 4>& corners,
                 bool triangle, const SegmentClosest<double>* hint = nullptr);
bool is_touching(const Point3<double>& s1, const Point3<double>& s2, const Point3<double>& m1,
                 const Point3<double>& m2, const EdgeClosest<double>* hint = nullptr);

// Proofs by CGAL's exact sums and products, given a guess of the closest parts: decide usual exact
// ties (node on the plane, distance equal to the gap) without rationals.

// Corners of a sub-triangle (centre, k, k+1) with the guessed closest point; none: needs no proof.
struct PartGuess {
  bool o = false, a = false, b = false;
};

// Plane, line or corner of a segment: through corner `base`, along up to two directions. A
// direction is the sum of vectors from there to the corners whose bits are set; none: no direction.
struct SegmentPiece {
  std::uint8_t base = 0;
  std::array<std::uint8_t, 2> corners{};
};

// True if the node points[4] is nearer to the piece than the gap, exactly. Finite points.
bool is_closer_to_piece(const std::array<Point3<double>, 5>& points, const SegmentPiece& piece,
                        double gap);

// Proves "distance < gap" or its opposite; nothing if the guess proves neither. With gap 0:
// "distance is 0". `points`: four corners, then the node; a triangle uses guess[0] only, with o, a,
// b = corners 3, 1, 2.
std::optional<bool> prove_closer(const std::array<Point3<double>, 5>& points, bool triangle,
                                 int best, const std::array<PartGuess, 4>& guess, double gap);

// prove_closer for edges x[0]-x[1] and x[2]-x[3] with guessed features.
std::optional<bool> prove_closer(const std::array<Point3<double>, 4>& x, EdgeFeature secondary,
                                 EdgeFeature main, bool parallel, double gap);

// One pair judged as the chosen accuracy asks: is it in contact, does the solver think so too, and
// with which figures. Counts where the two disagree.
namespace detail {

/// Answers about one pair. `row` has its figures if one of them is yes.
struct PairVerdict {
  bool in_contact = false;   ///< by the chosen accuracy
  bool solver_acts = false;  ///< by the arithmetic that the scene follows
  bool differs = false;      ///< they differ in contact, or in "exactly on the surface"
  PenetrationRow row;
  bool is_row() const { return in_contact || solver_acts; }
  DecisionDifference difference;  ///< valid if `differs`; the caller sets action and positions
};

class PairJudge {
 public:
  PairJudge(Accuracy accuracy, DecisionReport& report) : accuracy_(accuracy), report_(report) {
    report_.mode = accuracy;
  }
  ~PairJudge();
  PairJudge(const PairJudge&) = delete;
  PairJudge& operator=(const PairJudge&) = delete;

  /// Conventions of closest_on_segment; `gap` the pair gap.
  PairVerdict judge(const Point3<double>& p, const std::array<Point3<double>, 4>& corners,
                    bool triangle, double gap);
  /// Conventions of closest_between_edges; `x` both nodes of the secondary, then of the main edge.
  PairVerdict judge(const std::array<Point3<double>, 4>& x, double gap);

  /// Keeps a difference for the report, up to its limit.
  void note(const DecisionDifference& difference);

 private:
  template <class Exact>
  PairVerdict combine(const PenetrationRow& solver, bool touching, double gap, bool closer,
                      const Exact& exact_row);

  Accuracy accuracy_;
  DecisionReport& report_;
  FilterCounters counters_;
};

/// Adds the decisions of one contact to those of all, as number `place`.
void add_decisions(const DecisionReport& in, std::size_t place, DecisionReport& all);

}  // namespace detail

}  // namespace deck
