// Search front end: every pair, one by one.
#include "deck/contact/search.hpp"

#include <cmath>
#include <limits>

namespace deck {
namespace {

double at(std::span<const double> values, std::size_t i, double otherwise) {
  return values.empty() ? otherwise : values[i];
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Point3<double> point(const NodeArrays& nodes, std::uint32_t i) {
  return {nodes.x[i], nodes.y[i], nodes.z[i]};
}

double edge_length(const NodeArrays& nodes, std::uint32_t a, std::uint32_t b) {
  const Point3<double> d = point(nodes, b) - point(nodes, a);
  return std::sqrt(dot(d, d));
}

constexpr double kMarginFactor = static_cast<double>(0.2F);

}  // namespace

SearchResult find_node_segment_pairs(const NodeSegmentInput& in, const SearchOptions& options) {
  SearchResult result;
  for (std::size_t i = 0; i < in.secondary.size(); ++i) {
    if (at(in.secondary_stiffness, i, 1.0) == 0.0) continue;
    const std::uint32_t node = in.secondary[i];
    for (std::size_t j = 0; j < in.segments.size(); ++j) {
      if (at(in.segment_stiffness, j, 1.0) == 0.0) continue;
      const auto& s = in.segments[j];
      if (node == s[0] || node == s[1] || node == s[2] || node == s[3]) continue;
      const double gap =
          options.gap(at(in.secondary_gap, i, 0.0), at(in.segment_gap, j, 0.0),
                      at(in.secondary_length, i, kInfinity), at(in.segment_length, j, kInfinity));
      const double limit = std::max(options.drad, gap) + options.margin;
      const std::array<Point3<double>, 4> x{point(in.nodes, s[0]), point(in.nodes, s[1]),
                                            point(in.nodes, s[2]), point(in.nodes, s[3])};
      const auto p = point(in.nodes, node);
      const bool triangle = s[2] == s[3];
      const double d = options.form == Form::reference
                           ? closest_on_segment<Form::reference>(p, x, triangle).distance()
                           : closest_on_segment<Form::robust>(p, x, triangle).distance();
      ++result.tested;
      if (d < limit) {
        result.pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
      }
    }
  }
  return result;
}

SearchResult find_edge_edge_pairs(const EdgeEdgeInput& in, const SearchOptions& options) {
  SearchResult result;
  for (std::size_t i = 0; i < in.secondary.size(); ++i) {
    if (at(in.secondary_stiffness, i, 1.0) == 0.0) continue;
    const auto& s = in.secondary[i];
    for (std::size_t j = 0; j < in.main.size(); ++j) {
      if (at(in.main_stiffness, j, 1.0) == 0.0) continue;
      const auto& m = in.main[j];
      if (s[0] == m[0] || s[0] == m[1] || s[1] == m[0] || s[1] == m[1]) continue;
      const double gap =
          options.gap(at(in.secondary_gap, i, 0.0), at(in.main_gap, j, 0.0),
                      at(in.secondary_length, i, kInfinity), at(in.main_length, j, kInfinity));
      const double limit = std::max(options.drad, gap) + options.margin;
      const auto s1 = point(in.nodes, s[0]), s2 = point(in.nodes, s[1]);
      const auto m1 = point(in.nodes, m[0]), m2 = point(in.nodes, m[1]);
      bool near = false;
      if (options.form == Form::reference) {
        const auto c = closest_between_edges<Form::reference>(s1, s2, m1, m2);
        near = limit > 0.0 && c.distance_squared < limit * limit;
      } else {
        near = closest_between_edges<Form::robust>(s1, s2, m1, m2).distance < limit;
      }
      ++result.tested;
      if (near) {
        result.pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
      }
    }
  }
  return result;
}

double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 4>> segments) {
  if (segments.empty()) return 0.0;
  double sum = 0.0;
  for (const auto& s : segments) {
    for (std::size_t k = 0; k < 4; ++k) sum += edge_length(nodes, s[k], s[(k + 1) % 4]);
  }
  return kMarginFactor * (sum / (4.0 * static_cast<double>(segments.size())));
}

double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 2>> secondary,
                        std::span<const std::array<std::uint32_t, 2>> main) {
  const std::size_t count = secondary.size() + main.size();
  if (count == 0) return 0.0;
  double sum = 0.0;
  for (const auto& e : secondary) sum += edge_length(nodes, e[0], e[1]);
  for (const auto& e : main) sum += edge_length(nodes, e[0], e[1]);
  return kMarginFactor * (sum / static_cast<double>(count));
}

}  // namespace deck
