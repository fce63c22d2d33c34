// TYPE24: edge points, largest accepted penetration, candidates, the test of one node and one
// segment on the bilinear patch, and what becomes of a node as its candidates are gone through.
#include <algorithm>
#include <cmath>

#include "base/shared/parallel.hpp"
#include "contact/modern/parts.hpp"
#include "deck/contact/search.hpp"

namespace deck::detail::modern {
namespace {

constexpr double tolerance = 1e-8;

/// Part of each node: that of the last 4-node shell, then 3-node shell, then solid segment at it.
std::vector<std::uint32_t> node_parts(const Model& model, const std::vector<Face>& faces) {
  std::vector<std::uint32_t> out(model.nodes.size(), no_index);
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3}) {
    const Elements& family = model.family(kind);
    for (std::uint32_t e = 0; e < family.size(); ++e)
      for (int i = 0; i < family.width; ++i)
        if (const NodeIndex n = family.of(e)[i]; n != no_index) out[n] = family.part[e];
  }
  for (const Face& f : faces)
    if (f.solid_like() && f.solid != no_index)
      for (const NodeIndex n : f.nodes) out[n] = model.solid8.part[f.solid];
  return out;
}

/// Mean direction of the segments at each node, a unit vector where there are several.
std::vector<Vec> node_normals(const Coordinates& x, const Sides& s) {
  std::vector<Vec> out(x.x.size());
  std::vector<std::uint32_t> count(x.x.size(), 0);
  for (const Face& f : s.faces) {
    if (!(f.stiffness > 0)) continue;
    const std::size_t corners = f.triangle() ? 3 : 4;
    std::array<Vec, 4> normal;
    for (std::size_t k = 0; k < corners; ++k) {
      const Vec p = at(x, f.nodes[k]);
      normal[k] = unit_of(cross(at(x, f.nodes[(k + 1) % corners]) - p,
                                at(x, f.nodes[(k + corners - 1) % corners]) - p));
    }
    if (f.triangle()) normal[2] = normal[1];
    for (std::size_t k = 0; k < corners; ++k) {
      out[f.nodes[k]] = out[f.nodes[k]] + normal[k];
      ++count[f.nodes[k]];
    }
  }
  for (std::size_t n = 0; n < out.size(); ++n)
    if (count[n] > 1) out[n] = unit_of(out[n]);
  return out;
}

/// Deepest penetration that counts, and how much farther the search looks for solids.
struct Limits24 {
  double accepted = 1e30, solid_margin = 0;
};
Limits24 limits_of(const Sides& s) {
  Limits24 out;
  out.solid_margin = s.margin;
  if (s.set.inacti == 0) return out;
  if (s.set.ipen_max > 0) {
    out.accepted = s.set.ipen_max;
    out.solid_margin = std::max(s.margin, s.set.ipen_max);
    return out;
  }
  double sum = 0;
  std::size_t count = 0;
  for (const Face& f : s.faces)
    if (f.solid_like()) {
      sum += f.length;
      ++count;
    }
  const double mean = count == 0 ? 0 : sum / static_cast<double>(count);
  out.accepted = std::max(0.5 * mean, 0.5 * s.largest);
  out.solid_margin = std::max(s.margin, 0.5 * mean);
  return out;
}

/// A node's foot on the patch of a segment.
struct Foot {
  Vec closest, normal;
  bool outside = false;
  double area = 0;
};

/// Parameters of a triangle's foot; `c` are the sub-areas at sides 1, 2, 4 seen from the node.
void triangle_parameters(double a1, double c1, double c2, double c4, double& s, double& t) {
  constexpr double e = 2e-6;
  t = c1 / a1 - 1;
  if (c2 <= 0 && c4 <= 0 && c2 >= -e * a1 && c4 >= -e * a1)
    s = 0;
  else if (c2 <= 0 && c4 > 0)
    s = -c2 / a1 <= e ? 1 : 2;
  else if (c4 <= 0 && c2 > 0)
    s = -c4 / a1 <= e ? -1 : -2;
}

void onto_triangle(double& s, double& t) {
  double w1 = 0.25 * (1 - t) * (1 - s), w2 = 0.25 * (1 - t) * (1 + s);
  const auto cut = [](double v) { return std::clamp(v, 0.0, 1.0); };
  if (1 - w1 - w2 >= 0) {
    w1 = cut(w1), w2 = cut(w2);
  } else if (w2 > w1 && w2 >= 1) {
    w1 = 0, w2 = 1;
  } else if (w1 >= 1) {
    w1 = 1, w2 = 0;
  } else {
    const double d = w1 - w2;
    w1 = cut(0.5 * (1 + d)), w2 = cut(0.5 * (1 - d));
  }
  if (w1 + w2 == 0) return;
  s = (w2 - w1) / (w1 + w2);
  t = 1 - 2 * (w1 + w2);
}

Foot foot_of(const Coordinates& x, const Face& f, const Vec& q) {
  std::array<Vec, 4> p;
  Vec o;
  for (std::size_t k = 0; k < 4; ++k) {
    p[k] = at(x, f.nodes[k]);
    o = o + 0.25 * p[k];
  }
  Vec sum;
  for (std::size_t k = 0; k < 4; ++k) sum = sum + cross(p[k] - o, p[(k + 1) % 4] - o);
  Foot out;
  out.area = 0.5 * norm(sum);
  out.normal = unit_of(sum);
  std::array<double, 4> a{}, c{};
  for (std::size_t k = 0; k < 4; ++k) {
    a[k] = dot(out.normal, cross(p[k] - o, p[(k + 1) % 4] - o));
    c[k] = dot(out.normal, cross(p[k] - q, p[(k + 1) % 4] - q));
  }
  constexpr double flat = 1e-10, e = 2e-6;
  const auto ratio = [&](double up, double down) {
    return std::fabs(down) <= flat * out.area ? 0 : up / down;
  };
  double s = ratio(a[1] * c[3] - c[1] * a[3], a[1] * c[3] + c[1] * a[3]);
  double t = ratio(c[0] * a[2] - a[0] * c[2], c[0] * a[2] + a[0] * c[2]);
  const bool triangle = std::fabs(a[2]) <= flat * out.area;
  if (triangle) triangle_parameters(a[0], c[0], c[1], c[3], s, t);
  out.outside = std::fabs(s) > 1 + e || std::fabs(t) > 1 + e;
  if (out.outside && triangle && t < 1) onto_triangle(s, t);
  s = std::clamp(s, -1.0, 1.0);
  t = std::clamp(t, -1.0, 1.0);
  out.closest = 0.25 * ((1 - t) * (1 - s) * p[0] + (1 - t) * (1 + s) * p[1] +
                        (1 + t) * (1 + s) * p[2] + (1 + t) * (1 - s) * p[3]);
  return out;
}

struct Tested {
  bool exists = true, blocks = true;
  double penetration = 0, gap = 0, distance = 0;
  Vec normal;
};

class Tester {
 public:
  Tester(SceneContext& c, const Sides& s, const Limits24& limits)
      : x_(c.scene.coordinates),
        model_(c.model),
        connectivity_(c.connectivity),
        s_(s),
        limits_(limits),
        parts_(node_parts(c.model, s.faces)),
        normals_(node_normals(c.scene.coordinates, s)) {}

  Tested test(const SideNode& node, const Face& f) const {
    const Vec q = at(x_, node.node);
    const Foot foot = foot_of(x_, f, q);
    const double height = dot(foot.normal, q - foot.closest);
    Tested out;
    out.gap = node.gap + f.gap;
    out.normal = foot.normal;
    out.distance = foot.outside ? norm(q - foot.closest) : std::fabs(height);
    const bool solid = f.solid_like();
    if (solid)
      test_solid(node, f, foot, height, out);
    else if (!test_sheet(foot, height, out))
      return out;
    const std::uint32_t own = parts_[node.node], other = part_of(f);
    if (s_.set.inacti != 0 && s_.set.ipen0 != 1 && live(out.penetration) && own == other)
      reject(out);
    if (s_.set.inacti == 0 || own == other || (out.gap > 0 && solid)) out.blocks = false;
    return out;
  }

 private:
  static bool live(double p) { return p > 0 || std::fabs(p) < tolerance; }
  static void reject(Tested& t) { t.penetration = -std::fabs(t.penetration) - tolerance; }
  std::uint32_t part_of(const Face& f) const {
    return f.solid_like() ? (f.solid == no_index ? no_index : model_.solid8.part[f.solid])
                          : parts_[f.nodes[0]];
  }

  bool test_sheet(const Foot& foot, double height, Tested& out) const {
    if (foot.outside) {
      out.exists = false;
      return false;
    }
    out.penetration = out.gap - std::fabs(height);
    out.blocks = !(out.penetration > limits_.accepted);
    const bool deep = out.penetration > limits_.accepted;
    if (out.penetration > 0) out.distance = std::fabs(out.gap - height);
    if (height < 0 || deep) reject(out);
    return true;
  }

  void test_solid(const SideNode& node, const Face& f, const Foot& foot, double height,
                  Tested& out) const {
    out.penetration = out.gap - height;
    if (foot.outside) reject(out);
    if (live(out.penetration)) {
      const double limit = s_.set.inacti == 0 ? f.length : limits_.accepted;
      if (out.penetration >= limit || own_solid(node.node, f)) {
        reject(out);
        out.blocks = false;
      }
    }
    if (s_.set.inacti == 0 || s_.set.level == 3 || !live(out.penetration)) return;
    if (dot(foot.normal, normals_[node.node]) < 0) return;
    reject(out);
    out.blocks = false;
  }

  /// A solid at the node has a corner of the segment.
  bool own_solid(NodeIndex node, const Face& f) const {
    for (const std::uint32_t e : connectivity_.elements(ElementKind::solid8, node)) {
      const NodeIndex* slots = model_.solid8.of(e);
      for (const NodeIndex n : f.nodes)
        if (std::find(slots, slots + 8, n) != slots + 8) return true;
    }
    return false;
  }

  const Coordinates& x_;
  const Model& model_;
  Connectivity& connectivity_;
  const Sides& s_;
  const Limits24& limits_;
  std::vector<std::uint32_t> parts_;
  std::vector<Vec> normals_;
};

SearchResult search24(SceneContext& c, const Sides& s, const Limits24& limits) {
  SearchLists lists = search_lists(s, effective_threads(c.options.threads));
  for (double& gap : lists.node_gaps) gap *= std::sqrt(3.0);
  for (std::size_t i = 0; i < s.faces.size(); ++i) {
    // The node is within a box around the segment: farther at its corners than from its faces.
    const Face& f = s.faces[i];
    const double margin = f.solid_like() ? limits.solid_margin : s.margin;
    lists.gaps[i] = f.gap + (std::sqrt(3.0) - 1) * (f.gap + margin) + margin - s.margin;
  }
  return near_faces(c, s, lists, true);
}

bool in_box(const Coordinates& x, const Face& f, NodeIndex node, double by) {
  const std::vector<double>* const axes[] = {&x.x, &x.y, &x.z};
  for (const std::vector<double>* axis : axes) {
    double low = (*axis)[f.nodes[0]], high = low;
    for (const NodeIndex n : f.nodes) {
      low = std::min(low, (*axis)[n]);
      high = std::max(high, (*axis)[n]);
    }
    const double v = (*axis)[node];
    if (!(v >= low - by && v <= high + by)) return false;
  }
  return true;
}

/// What is known of a node while its candidates are gone through.
class State {
 public:
  State(const Settings& set, double accepted) : set_(set), accepted_(accepted) {}

  void take(std::uint32_t node, std::uint32_t face, const Tested& t) {
    const double p = t.penetration;
    if (std::fabs(p) < tolerance || (p < 0 && t.blocks)) {
      if (!known_) {
        memory_ = -t.distance;
        known_ = true;
      } else if (t.distance < std::fabs(memory_)) {
        memory_ = -t.distance;
        if (set_.inacti != 0) found_ = false;
      }
      return;
    }
    if (p > accepted_ || !(p > 0)) return;
    const bool better =
        !known_ || (set_.inacti == 0 ? p < memory_ : t.distance < std::fabs(memory_));
    if (!better) return;
    memory_ = set_.inacti == 0 ? p : t.distance;
    known_ = found_ = true;
    best_ = {node, face, p, t.gap, std::fabs(t.gap - p), t.normal};
  }
  bool found() const { return found_; }
  const NodePenetration& best() const { return best_; }

 private:
  const Settings& set_;
  double accepted_;
  bool known_ = false, found_ = false;
  double memory_ = 0;
  NodePenetration best_;
};

}  // namespace

Found find_nodes24(SceneContext& c, Sides& s) {
  const Coordinates& x = c.scene.coordinates;
  const Limits24 limits = limits_of(s);
  Found out;
  out.largest_accepted = limits.accepted;
  const SearchResult near = search24(c, s, limits);
  out.complete = near.complete;
  if (!near.complete) return out;
  const Tester tester(c, s, limits);
  const auto across = [&](std::uint8_t node, std::uint8_t face) {
    return s.set.level != 2 || (node & from_group) != 0 || s.across(node, face);
  };
  for (std::size_t i = 0; i < near.pairs.size();) {
    const std::uint32_t at_node = near.pairs[i].secondary;
    const SideNode& node = s.nodes[at_node];
    State state(s.set, limits.accepted);
    const auto take = [&](std::uint32_t number) {
      const Face f = s.face(number);
      const double margin = f.solid_like() ? limits.solid_margin : s.margin;
      if (f.stiffness == 0 || !across(node.bits, f.bits) ||
          !in_box(x, f, node.node, margin + node.gap + f.gap))
        return;
      ++out.candidates;
      const Tested t = tester.test(node, f);
      if (t.exists) state.take(at_node, number, t);
    };
    std::size_t end = i;
    for (; end < near.pairs.size() && near.pairs[end].secondary == at_node; ++end)
      take(near.pairs[end].main);
    for (; i < end; ++i)
      if (const std::uint32_t o = s.faces[near.pairs[i].main].opposite; o != no_index) take(o);
    if (state.found()) out.penetrations.push_back(state.best());
  }
  return out;
}

}  // namespace deck::detail::modern
