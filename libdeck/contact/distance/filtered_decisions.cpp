// Decides and measures pairs: in double with error bounds, else by rationals.
#include "contact/shared/filtered.hpp"

#include <algorithm>
#include <cmath>

#include "contact/rules/actions.hpp"
#include "contact/shared/exact.hpp"

namespace deck {

const char* to_string(Accuracy accuracy) {
  static constexpr const char* words[] = {"fast", "reference", "robust", "exact"};
  return words[static_cast<std::size_t>(accuracy)];
}

namespace detail {
namespace {

using P = Point3<double>;
constexpr std::size_t most_listed = 1000;

std::array<double, 3> direction(const P& v) {
  const double n = deck::length(v);
  if (!(n > 0)) return {};
  return {v.x / n, v.y / n, v.z / n};
}

/// A pair in contact has a positive depth, even if its distance rounds to the gap.
double depth_of(double gap, double distance) {
  const double depth = gap - distance;
  return depth > 0 ? depth : gap - std::nextafter(gap, 0.0);
}

/// Figures rounded once from exact ones.
PenetrationRow rounded_row(const P& p, const std::array<P, 4>& corners, bool triangle, double gap) {
  const ExactSegment c = exact_closest_on_segment(p, corners, triangle);
  PenetrationRow row;
  row.gap = gap;
  row.distance = c.distance;
  row.depth = depth_of(gap, c.distance);
  row.on_surface = !(c.distance > 0);
  if (!row.on_surface)
    row.normal = direction(closest_on_segment<Form::robust>(p, corners, triangle).closest().vector);
  return row;
}
PenetrationRow rounded_row(const std::array<P, 4>& x, double gap) {
  const ExactEdges c = exact_closest_between_edges(x[0], x[1], x[2], x[3]);
  PenetrationRow row =
      measured_row(closest_between_edges<Form::robust>(x[0], x[1], x[2], x[3]), gap);
  row.distance = c.distance;
  row.depth = depth_of(gap, c.distance);
  row.on_surface = !(c.distance > 0);
  if (row.on_surface) row.normal = {};
  row.weight_s = c.weight_s;
  row.weight_m = c.weight_m;
  return row;
}

/// Coincident bit for bit: the distance is 0.
bool is_same(const P& a, const P& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

bool is_at_corner(const P& p, const std::array<P, 4>& corners) {
  return std::any_of(corners.begin(), corners.end(), [&](const P& c) { return is_same(p, c); });
}

bool share_an_end(const std::array<P, 4>& x) {
  return is_same(x[0], x[2]) || is_same(x[0], x[3]) || is_same(x[1], x[2]) || is_same(x[1], x[3]);
}

PairVerdict plain_verdict(const PenetrationRow& row) {
  PairVerdict out;
  out.in_contact = out.solver_acts = row.depth > 0;
  out.row = row;
  return out;
}

}  // namespace

PairJudge::~PairJudge() {
  report_.fallback += counters_.double_double;
  report_.exact += counters_.exact;
}

void PairJudge::note(const DecisionDifference& difference) {
  ++(difference.surface ? report_.surface_differs : report_.contact_differs);
  if (report_.differences.size() < most_listed) report_.differences.push_back(difference);
}

void add_decisions(const DecisionReport& in, std::size_t place, DecisionReport& all) {
  if (in.mode != DecisionReport{}.mode) all.mode = in.mode;
  all.pairs += in.pairs;
  all.fallback += in.fallback;
  all.exact += in.exact;
  all.contact_differs += in.contact_differs;
  all.surface_differs += in.surface_differs;
  for (DecisionDifference d : in.differences) {
    if (all.differences.size() >= most_listed) break;
    d.contact = static_cast<std::uint32_t>(place);
    all.differences.push_back(d);
  }
}

template <class Exact>
PairVerdict PairJudge::combine(const PenetrationRow& solver, bool touching, double gap, bool closer,
                               const Exact& exact_row) {
  PairVerdict out;
  const bool solver_closer = solver.depth > 0;
  out.in_contact = closer;
  out.solver_acts = accuracy_ == Accuracy::exact ? closer : solver_closer;
  out.row = solver;
  const bool surface = closer && solver_closer && solver.on_surface != touching;
  out.differs = closer != solver_closer || surface;
  const bool by_exact = closer && (accuracy_ == Accuracy::exact || !solver_closer);
  if (out.differs || by_exact) {
    const PenetrationRow exact = exact_row();
    if (by_exact) out.row = exact;
    out.difference.exact_distance = exact.distance;
  }
  out.row.in_contact = closer;
  if (!out.differs) return out;
  out.difference.surface = surface;
  out.difference.exact = surface ? touching : closer;
  out.difference.gap = gap;
  out.difference.solver_distance = solver.distance;
  return out;
}

PairVerdict PairJudge::judge(const P& p, const std::array<P, 4>& corners, bool triangle,
                             double gap) {
  ++report_.pairs;
  if (accuracy_ == Accuracy::fast)
    return plain_verdict(measured_row(closest_on_segment<Form::robust>(p, corners, triangle), gap));
  const auto by_solver = closest_on_segment<Form::reference>(p, corners, triangle);
  const PenetrationRow solver = measured_row(by_solver, gap);
  if (accuracy_ == Accuracy::reference) return plain_verdict(solver);
  bool closer = false, touching = false;
  if (is_at_corner(p, corners)) {
    ++counters_.pairs;
    closer = touching = gap > 0;
  } else if (accuracy_ == Accuracy::exact && all_finite(corners) && is_finite(p) &&
             std::isfinite(gap)) {
    ++counters_.pairs, ++counters_.double_double, ++counters_.exact;
    closer = gap > 0 && exact_compare_distance(p, corners, triangle, gap) < 0;
    touching = closer && exact_compare_distance(p, corners, triangle, 0.0) == 0;
  } else {
    closer = is_closer_than(p, corners, triangle, gap, &counters_, &by_solver);
    touching = closer && is_touching(p, corners, triangle, &by_solver);
  }
  return combine(solver, touching, gap, closer,
                 [&] { return rounded_row(p, corners, triangle, gap); });
}

PairVerdict PairJudge::judge(const std::array<P, 4>& x, double gap) {
  ++report_.pairs;
  if (accuracy_ == Accuracy::fast)
    return plain_verdict(
        measured_row(closest_between_edges<Form::robust>(x[0], x[1], x[2], x[3]), gap));
  const auto by_solver = closest_between_edges<Form::reference>(x[0], x[1], x[2], x[3]);
  const PenetrationRow solver = measured_row(by_solver, gap);
  if (accuracy_ == Accuracy::reference) return plain_verdict(solver);
  bool closer = false, touching = false;
  if (share_an_end(x)) {
    ++counters_.pairs;
    closer = touching = gap > 0;
  } else if (accuracy_ == Accuracy::exact && all_finite(x) && std::isfinite(gap)) {
    ++counters_.pairs, ++counters_.double_double, ++counters_.exact;
    closer = gap > 0 && exact_compare_distance(x[0], x[1], x[2], x[3], gap) < 0;
    touching = closer && exact_compare_distance(x[0], x[1], x[2], x[3], 0.0) == 0;
  } else {
    closer = is_closer_than(x[0], x[1], x[2], x[3], gap, &counters_, &by_solver);
    touching = closer && is_touching(x[0], x[1], x[2], x[3], &by_solver);
  }
  return combine(solver, touching, gap, closer, [&] { return rounded_row(x, gap); });
}

}  // namespace detail
}  // namespace deck
