// CGAL rivals of the pair search: AABB_tree over boxes of segments with one box query per node, and
// box_intersection_d between two sets of boxes.
#pragma once

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/box_intersection_d.h>

#include "contact/shared/closest.hpp"
#include "rivals/pair_test.hpp"

namespace bench {

using CgalKernel = CGAL::Simple_cartesian<double>;

// A segment with its widened box as AABB primitive.
class CgalSegment {
 public:
  struct Stored {
    const Scene* scene;
    std::uint32_t index;
  };
  using Id = std::uint32_t;
  using Point = CgalKernel::Point_3;
  using Datum = CgalKernel::Iso_cuboid_3;
  using Datum_reference = Datum;
  CgalSegment() = default;
  explicit CgalSegment(std::vector<Stored>::const_iterator it)
      : scene_(it->scene), index_(it->index) {}
  Datum datum() const {
    const Bounds b = segment_bounds(*scene_, index_);
    return {Point(b.low[0], b.low[1], b.low[2]), Point(b.high[0], b.high[1], b.high[2])};
  }
  Point reference_point() const {
    const std::uint32_t node = scene_->segments[index_][0];
    return {scene_->x[node], scene_->y[node], scene_->z[node]};
  }
  Id id() const { return index_; }

 private:
  const Scene* scene_ = nullptr;
  std::uint32_t index_ = 0;
};

// Calls back for every primitive in a reached leaf, without a list.
template <class Traits, class Report>
class CgalBoxTraversal {
 public:
  explicit CgalBoxTraversal(const Report& report) : report_(report) {}
  bool go_further() const { return true; }
  void intersection(const CGAL::Bbox_3&, const typename Traits::Primitive& p) { report_(p.id()); }
  template <class Node>
  bool do_intersect(const CGAL::Bbox_3& query, const Node& node) const {
    return CGAL::do_overlap(query, node.bbox());
  }

 private:
  const Report& report_;
};

using CgalTraits = CGAL::AABB_traits<CgalKernel, CgalSegment>;

inline std::vector<CgalSegment::Stored> cgal_primitives(const Scene& s) {
  std::vector<CgalSegment::Stored> primitives;
  primitives.reserve(s.segments.size());
  for (std::uint32_t i = 0; i < s.segments.size(); ++i) primitives.push_back({&s, i});
  return primitives;
}

// Fastest known use of the tree: own traversal comparing boxes (all_intersected_primitives with a
// box is about as fast).
inline Answer cgal_aabb_tree(const Scene& s) {
  const auto primitives = cgal_primitives(s);
  CGAL::AABB_tree<CgalTraits> tree(primitives.cbegin(), primitives.cend());
  tree.build();
  Answer answer;
  for (std::uint32_t i = 0; i < s.secondary.size(); ++i) {
    const std::uint32_t n = s.secondary[i];
    const double r = s.secondary_gap[i];
    const CGAL::Bbox_3 query(s.x[n] - r, s.y[n] - r, s.z[n] - r, s.x[n] + r, s.y[n] + r,
                             s.z[n] + r);
    const auto report = [&](std::uint32_t j) {
      if (within_gap(s, i, j)) answer.add(i, j);
    };
    CgalBoxTraversal<CgalTraits, decltype(report)> traversal(report);
    tree.traversal(query, traversal);
  }
  return answer;
}

inline Answer cgal_box_intersection(const Scene& s, std::ptrdiff_t cutoff) {
  struct IndexedBox : CGAL::Box_intersection_d::Box_d<double, 3> {
    using Base = CGAL::Box_intersection_d::Box_d<double, 3>;
    std::uint32_t index;
    IndexedBox(const CGAL::Bbox_3& box, std::uint32_t which) : Base(box), index(which) {}
  };
  std::vector<IndexedBox> segments, nodes;
  segments.reserve(s.segments.size());
  nodes.reserve(s.secondary.size());
  for (std::uint32_t j = 0; j < s.segments.size(); ++j) {
    const Bounds b = segment_bounds(s, j);
    segments.emplace_back(
        CGAL::Bbox_3(b.low[0], b.low[1], b.low[2], b.high[0], b.high[1], b.high[2]), j);
  }
  for (std::uint32_t i = 0; i < s.secondary.size(); ++i) {
    const std::uint32_t n = s.secondary[i];
    const double r = s.secondary_gap[i];
    nodes.emplace_back(
        CGAL::Bbox_3(s.x[n] - r, s.y[n] - r, s.z[n] - r, s.x[n] + r, s.y[n] + r, s.z[n] + r), i);
  }
  Answer answer;
  CGAL::box_intersection_d(
      nodes.begin(), nodes.end(), segments.begin(), segments.end(),
      [&](const IndexedBox& a, const IndexedBox& b) {
        if (within_gap(s, a.index, b.index)) answer.add(a.index, b.index);
      },
      cutoff);
  return answer;
}

// Edge-edge pairs within one list, constant gap.
inline Answer cgal_edge_boxes(const deck::EdgeEdgeInput& in, double gap, std::ptrdiff_t cutoff) {
  struct IndexedBox : CGAL::Box_intersection_d::Box_d<double, 3> {
    std::uint32_t index;
    IndexedBox(const CGAL::Bbox_3& box, std::uint32_t which)
        : CGAL::Box_intersection_d::Box_d<double, 3>(box), index(which) {}
  };
  const auto point = [&in](std::uint32_t i) {
    return deck::Point3<double>{in.nodes.x[i], in.nodes.y[i], in.nodes.z[i]};
  };
  const auto boxes = [&point](const auto& edges, double r) {
    std::vector<IndexedBox> list;
    list.reserve(edges.size());
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
      const auto a = point(edges[i][0]), b = point(edges[i][1]);
      list.emplace_back(
          CGAL::Bbox_3(std::min(a.x, b.x) - r, std::min(a.y, b.y) - r, std::min(a.z, b.z) - r,
                       std::max(a.x, b.x) + r, std::max(a.y, b.y) + r, std::max(a.z, b.z) + r),
          i);
    }
    return list;
  };
  auto secondary = boxes(in.secondary, 0.0), main = boxes(in.main, gap * (1 + 1e-9));
  Answer answer;
  CGAL::box_intersection_d(
      secondary.begin(), secondary.end(), main.begin(), main.end(),
      [&](const IndexedBox& a, const IndexedBox& b) {
        const auto &s = in.secondary[a.index], &m = in.main[b.index];
        if (s[0] == m[0] || s[0] == m[1] || s[1] == m[0] || s[1] == m[1]) return;
        const auto c = deck::closest_between_edges<deck::Form::reference>(point(s[0]), point(s[1]),
                                                                          point(m[0]), point(m[1]));
        if (c.distance_squared < gap * gap) answer.add(a.index, b.index);
      },
      cutoff);
  return answer;
}

}  // namespace bench
