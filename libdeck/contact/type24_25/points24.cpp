// TYPE24, Iedge: points on free and sharp edges of each surface. The search treats them as
// secondary nodes with positions behind those of the nodes.
#include <algorithm>
#include <tuple>

#include "contact/type24_25/type24_25.hpp"

namespace deck::detail::type24_25 {
namespace {

/// A side of a segment, from the node with the lower id to the higher one or back.
struct SegmentSide {
  std::int64_t low = 0, high = 0;
  std::uint32_t segment = 0, side = 0;
  bool onward = false;
  bool same_edge(const SegmentSide& o) const { return low == o.low && high == o.high; }
};

class PointMaker {
 public:
  PointMaker(const SceneContext& c, Sides& out) : x_(c.scene.coordinates), out_(out) {}

  void add(const SegmentList& segments, const std::vector<std::int64_t>& ids) {
    std::vector<SegmentSide> sides;
    segments_.clear();
    segments.for_each([&](const Segment& s) {
      if (std::find(s.nodes.begin(), s.nodes.end(), no_index) != s.nodes.end()) return;
      const auto number = static_cast<std::uint32_t>(segments_.size());
      segments_.push_back(s);
      Quad& nodes = segments_.back().nodes;
      repair(nodes);
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::int64_t a = ids[nodes[k]], b = ids[nodes[(k + 1) % 4]];
        if (a != b) sides.push_back({std::min(a, b), std::max(a, b), number, k, a < b});
      }
    });
    std::sort(sides.begin(), sides.end(), [](const SegmentSide& a, const SegmentSide& b) {
      return std::tie(a.low, a.high, a.segment, a.side) <
             std::tie(b.low, b.high, b.segment, b.side);
    });
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
      for (end = i + 1; end < sides.size() && sides[i].same_edge(sides[end]);) ++end;
      const std::span<const SegmentSide> edge(&sides[i], end - i);
      if (edge.size() == 1 || is_sharp(edge[edge.size() - 2], edge.back())) add_edge(edge);
    }
  }

 private:
  /// If an edge has more than two segments, the solver compares the last two.
  bool is_sharp(const SegmentSide& a, const SegmentSide& b) const {
    return dot(normal(a), normal(b)) < out_.set.cos_edge;
  }
  Vec normal(const SegmentSide& s) const {
    const Quad& n = segments_[s.segment].nodes;
    return unit_of(cross(at(x_, n[2]) - at(x_, n[0]), at(x_, n[3]) - at(x_, n[1])));
  }

  /// One segment per direction of the edge: the last.
  void add_edge(std::span<const SegmentSide> edge) {
    const SegmentSide* of[2] = {};  // onward, back
    for (const SegmentSide& s : edge) of[s.onward ? 0 : 1] = &s;
    for (const bool second : {false, true}) {
      const SegmentSide* const s = of[second ? 1 : 0];
      if (s == nullptr) continue;
      const Quad& n = segments_[s->segment].nodes;
      const Vec a = at(x_, n[s->side]), b = at(x_, n[(s->side + 1) % 4]);
      if (!second || of[0] == nullptr) {
        add_point(*s, "quarter", 0.75 * a + 0.25 * b);
        add_point(*s, "three-quarters", 0.25 * a + 0.75 * b);
      }
      const std::size_t corners = n[2] == n[3] ? 3 : 4;
      Vec centre;
      for (std::size_t k = 0; k < corners; ++k) centre = centre + at(x_, n[k]);
      add_point(*s, "inner", (1.0 / 3) * ((1.0 / static_cast<double>(corners)) * centre + a + b));
    }
  }
  void add_point(const SegmentSide& s, std::string_view place, const Vec& p) {
    const Segment& segment = segments_[s.segment];
    const std::array edge{segment.nodes[s.side], segment.nodes[(s.side + 1) % 4]};
    out_.points.push_back({edge, segment, {place, {p.x, p.y, p.z}}});
  }

  const Coordinates& x_;
  Sides& out_;
  std::vector<Segment> segments_;
};

}  // namespace

void make_points(const SceneContext& c, const SegmentList& segments, Sides& out) {
  PointMaker(c, out).add(segments, c.model.nodes.id);
}

PointsAsNodes::PointsAsNodes(Coordinates& x, Sides& s)
    : x_(x), s_(s), places_(x.x.size()), nodes_(s.nodes.size()) {
  if (s.points.empty()) return;
  std::vector<std::uint32_t> position(places_, no_index);
  for (std::uint32_t i = 0; i < nodes_; ++i) position[s.nodes[i].node] = i;
  for (const PointOnEdge& p : s.points) {
    SideNode n{static_cast<NodeIndex>(x.x.size()), 0, 0, no_limit};
    for (const NodeIndex end : p.edge)
      if (const std::uint32_t i = position[end]; i != no_index) {
        n.bits = std::max(n.bits, s.nodes[i].bits);
        n.gap = std::max(n.gap, s.nodes[i].gap);
      }
    x.x.push_back(p.point.at[0]);
    x.y.push_back(p.point.at[1]);
    x.z.push_back(p.point.at[2]);
    s.nodes.push_back(n);
  }
}

PointsAsNodes::~PointsAsNodes() {
  for (std::vector<double>* axis : {&x_.x, &x_.y, &x_.z}) axis->resize(places_);
  s_.nodes.resize(nodes_);
}

}  // namespace deck::detail::type24_25
