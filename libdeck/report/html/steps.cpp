// Time steps of the elements as colours of the page: of each node the smallest of its elements.
#include <algorithm>
#include <cmath>

#include "model/shared/mesh.hpp"
#include "report/html/parts.hpp"

namespace deck::detail {
namespace {

constexpr int step_classes = 254;  // a byte a node, and 0 for none
/// Share of the nodes that the scale covers: a few springs with steps a thousand times as large as
/// all others would leave one colour for the rest.
constexpr double covered = 0.98;

/// Of every node the smallest step of its elements; infinite where none has one.
std::vector<double> smallest_steps(const Model& model, const Mesh& mesh) {
  std::vector<double> out(model.nodes.size(), INFINITY);
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    const Elements& family = model.family(static_cast<ElementKind>(k));
    for (std::size_t e = 0; e < family.size(); ++e) {
      const double dt = mesh.elements[k].dt[e];
      if (!(dt > 0.0 && dt < 1e29)) continue;
      const NodeIndex* n = family.of(e);
      for (int i = 0; i < family.width; ++i)
        if (n[i] != no_index) out[n[i]] = std::min(out[n[i]], dt);
    }
  }
  return out;
}

}  // namespace

std::string steps_block(const Model& model, const Mesh& mesh, const PageNodes& nodes) {
  const std::vector<double> step = smallest_steps(model, mesh);
  std::vector<double> sorted;
  for (const NodeIndex n : nodes.list())
    if (step[n] < INFINITY) sorted.push_back(step[n]);
  std::sort(sorted.begin(), sorted.end());
  double low = 0, high = 0, top = 0;
  if (!sorted.empty()) {
    low = sorted.front();
    top = sorted.back();
    high = sorted[static_cast<std::size_t>(covered * static_cast<double>(sorted.size() - 1))];
  }
  ByteStream out;
  const double ends[3] = {low, high, top};
  out.f64(ends);
  const double range = high > low ? std::log(high / low) : 1;
  for (const NodeIndex n : nodes.list()) {
    const double t = std::log(high / std::min(step[n], high)) / range;
    out.byte(step[n] < INFINITY ? 1 + static_cast<unsigned>(std::lround(step_classes * t)) : 0);
  }
  return std::move(out).text();
}

}  // namespace deck::detail
