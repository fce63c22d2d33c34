// A node passes a sliver: the force of some formulas jumps although the node does not.
#include "accuracy/shared/choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact/shared/filtered.hpp"

namespace deck {
namespace {

constexpr std::size_t motion_steps = 100;

/// Elastic normal force of the robust law for stiffness 1, linear below 1e-8 of the gap. Uses
/// ratios: products of small numbers would underflow.
double elastic_force(double gap, double distance, double depth) {
  constexpr double floor = 1e-8;
  const double share = distance / gap;
  if (share >= floor) return 0.5 * depth / share;
  return 0.5 * gap * ((1.0 - floor) / floor + (floor - share) / (floor * floor));
}

HardMotion::Line motion_line(const HardMotion& m, Accuracy accuracy) {
  HardMotion::Line out;
  out.accuracy = accuracy;
  DecisionReport unused;
  detail::PairJudge judge(accuracy, unused);
  const std::array<Point3<double>, 4> x{m.corners[0], m.corners[1], m.corners[2], m.corners[2]};
  for (std::size_t k = 0; k <= motion_steps; ++k) {
    const Point3<double> p =
        m.from + (static_cast<double>(k) / static_cast<double>(motion_steps)) * (m.to - m.from);
    const detail::PairVerdict verdict = judge.judge(p, x, true, m.gap);
    const PenetrationRow& row = verdict.row;
    const bool pressed = verdict.is_row();
    out.depth.push_back(pressed ? row.depth : 0.0);
    out.force.push_back(pressed ? elastic_force(m.gap, row.distance, row.depth) : 0.0);
    // 0.001 allows for round-off of the steps.
    if (k > 0 && std::abs(out.depth[k] - out.depth[k - 1]) > 1.001 * m.way) out.jumps.push_back(k);
  }
  return out;
}

}  // namespace

HardMotion hard_motion() {
  HardMotion m;
  // Corner 1 is the middle of the opposite edge: the area of these decimals is round-off.
  m.corners = {Point3<double>{-0.1, 0, 0}, {0.6, 0.9, 0}, {-0.8, -0.9, 0}};
  m.from = {-0.1, 1.1, 0.3}, m.to = {1.9, 1.3, 0.3};
  m.gap = 2;
  m.way = length(m.to - m.from) / static_cast<double>(motion_steps);
  for (const Accuracy a : {Accuracy::reference, Accuracy::fast, Accuracy::robust, Accuracy::exact})
    m.lines.push_back(motion_line(m, a));
  return m;
}

std::vector<std::string> motion_sentences(const HardMotion& motion, const std::string& tag) {
  std::vector<std::string> out;
  const auto named = [&](Accuracy a) {
    const std::string name = to_string(a);
    return tag.empty() ? name : "<" + tag + ">" + name + "</" + tag + ">";
  };
  for (std::size_t k = 1; k <= motion_steps; ++k) {
    std::string who;
    const HardMotion::Line* first = nullptr;
    for (const HardMotion::Line& line : motion.lines) {
      if (std::find(line.jumps.begin(), line.jumps.end(), k) == line.jumps.end()) continue;
      who += (first == nullptr ? "" : " and ") + named(line.accuracy);
      if (first == nullptr) first = &line;
    }
    if (first == nullptr) continue;
    const double before = first->force[k - 1], after = first->force[k];
    out.push_back(fmt::format(
        "At step {} the force of {} {} from {:.2f} to {:.2f}; exactly {:.2f}.", k, who,
        after < before ? "falls" : "rises", before, after, motion.lines.back().force[k]));
  }
  return out;
}

}  // namespace deck
