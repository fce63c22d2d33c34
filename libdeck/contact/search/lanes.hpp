// Inner loops of the pair search as templates on the registers R of an instruction set. The
// arithmetic is that of closest_on_segment, operation by operation, without contraction: every
// instruction set gives the same bits. Over 600 lines, because kernels.cpp compiles a whole sweep
// into one function per set, except rare calls (growth of lists, robust formula).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "contact/search/sweep.hpp"
#include "contact/shared/closest.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

// Everything is inlined: no value is passed in registers.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace deck::sweep {

// The four sub-triangles of a segment.
typedef double Subs __attribute__((vector_size(32)));
typedef long long SubMask __attribute__((vector_size(32)));

// Registers of N doubles, or of 2 N floats and node numbers.
template <unsigned N>
struct Registers {
  static constexpr unsigned lanes = N;
  typedef double Real __attribute__((vector_size(8 * N)));
  typedef long long Mask __attribute__((vector_size(8 * N)));
  typedef float Single __attribute__((vector_size(8 * N)));
  typedef std::int32_t SingleMask __attribute__((vector_size(8 * N)));
  typedef std::uint32_t Id __attribute__((vector_size(8 * N)));
};
// For every processor of the architecture.
struct TwoLanes : Registers<2> {
#if defined(__x86_64__)
  static unsigned bits(const Mask& m) {
    return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(m)));
  }
  static unsigned bits(const SingleMask& m) {
    return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(m)));
  }
#else
  template <class M>
  static unsigned bits(const M& m) {
    unsigned out = 0;
    for (unsigned k = 0; k < sizeof m / sizeof m[0]; ++k) out |= unsigned{m[k] != 0} << k;
    return out;
  }
#endif
  static bool any(const SubMask& m) { return (m[0] | m[1] | m[2] | m[3]) != 0; }
};

#if defined(__x86_64__)
struct FourLanes : Registers<4> {
  [[gnu::target("avx2")]] static unsigned bits(const Mask& m) {
    return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(m)));
  }
  [[gnu::target("avx2")]] static unsigned bits(const SingleMask& m) {
    return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(m)));
  }
  [[gnu::target("avx2")]] static bool any(const SubMask& m) { return bits(m) != 0; }
};
#endif

template <class V, class T>
V load(const T* from) {
  V v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
template <class V>
V larger(const V& a, const V& b) {
  return a > b ? a : b;
}

// Bit mask of the boxes that overlap `b`.
template <class R>
unsigned overlaps(const BoxBlock& block, const FloatBox& b) {
  unsigned bits = 0;
  for (unsigned c = 0; c < BoxBlock::width; c += 2 * R::lanes) {
    const auto meets = [&](std::size_t k) -> typename R::SingleMask {
      using Single = typename R::Single;
      return (load<Single>(&block.low[k][c]) <= b.high[k]) &
             (load<Single>(&block.high[k][c]) >= b.low[k]);
    };
    const typename R::SingleMask in = meets(0) & meets(1) & meets(2);
    bits |= R::bits(in) << c;
  }
  return bits;
}

// Block of level 0 and bit mask of its leaves that may have an item inside a box.
struct Hit {
  std::uint32_t block;
  std::uint32_t mask;
};

template <class R>
struct Walk {
  struct Step {
    std::uint32_t level, block;
  };
  // A tree of 2^32 leaves has eleven levels; at most seven steps wait per level but the first.
  static constexpr std::size_t most_steps = 7 * 11 + 1;
  std::vector<Hit> hits;
  std::array<Step, most_steps> steps;

  // The hits among `some` that overlap a box, in `room`. Branch-free: about a quarter does.
  static std::span<const Hit> overlapping(const std::vector<BoxBlock>& leaves, const FloatBox& b,
                                          std::span<const Hit> some, std::vector<Hit>& room) {
    if (room.size() < some.size()) room.resize(some.size());
    std::size_t kept = 0;
    for (const Hit& hit : some) {
      const unsigned mask = overlaps<R>(leaves[hit.block], b) & hit.mask;
      room[kept] = {hit.block, mask};
      kept += mask != 0;
    }
    return {room.data(), kept};
  }

  void find(const BoxTree& tree, const FloatBox& b) {
    hits.clear();
    std::size_t waiting = 1;
    steps[0] = {static_cast<std::uint32_t>(tree.levels() - 1), 0};
    while (waiting > 0) {
      const auto [level, block] = steps[--waiting];
      unsigned mask = overlaps<R>(tree.level(level)[block], b);
      if (level == 0) {
        if (mask != 0) hits.push_back({block, mask});
        continue;
      }
      for (; mask != 0; mask &= mask - 1)
        steps[waiting++] = {level - 1, block * 8 + static_cast<std::uint32_t>(__builtin_ctz(mask))};
    }
  }
};

// One segment for the sweep: corners, box, and a slab between two parallel planes.
struct Shape {
  std::array<Point3<double>, 4> corner;
  bool triangle = false;
  Box box;   // of the corners
  Box wide;  // widened by the reach of the segment
  double reach = 0.0;
  double largest = 0.0;   // coordinate magnitude
  Point3<double> normal;  // of the slab; zero if there is none
  double slab_low = 0.0, slab_high = 0.0;

  void set(const NodeArrays& nodes, const std::array<std::uint32_t, 4>& s, double own_reach) {
    for (std::size_t k = 0; k < 4; ++k) corner[k] = point(nodes, s[k]);
    triangle = s[2] == s[3];
    reach = own_reach;
    const auto range = [](double a, double b, double c, double d, double& low, double& high) {
      low = std::min(std::min(a, b), std::min(c, d));
      high = std::max(std::max(a, b), std::max(c, d));
    };
    const auto& x = corner;
    range(x[0].x, x[1].x, x[2].x, x[3].x, box.low[0], box.high[0]);
    range(x[0].y, x[1].y, x[2].y, x[3].y, box.low[1], box.high[1]);
    range(x[0].z, x[1].z, x[2].z, x[3].z, box.low[2], box.high[2]);
    largest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      largest = std::max(largest, std::max(-box.low[k], box.high[k]));
    }
    const double r = Reach::widened(reach, largest);
    for (std::size_t k = 0; k < 3; ++k) {
      wide.low[k] = box.low[k] - r;
      wide.high[k] = box.high[k] + r;
    }
    normal = {};
    slab_low = slab_high = 0.0;
    const Point3<double> n = cross(x[2] - x[0], x[3] - x[1]);
    const double length = std::sqrt(dot(n, n));
    if (!(length > 0x1p-400 && length < 0x1p400)) return;
    normal = (1.0 / length) * n;
    range(dot(normal, x[0]), dot(normal, x[1]), dot(normal, x[2]), dot(normal, x[3]), slab_low,
          slab_high);
  }
};

// Points of a leaf within `r` of the segment's box and of its slab.
template <class R>
unsigned near_points(const PointBlock& p, const Shape& s, double r) {
  using Real = typename R::Real;
  unsigned bits = 0;
  for (unsigned c = 0; c < PointBlock::width; c += R::lanes) {
    const Real x = load<Real>(&p.x[c]), y = load<Real>(&p.y[c]), z = load<Real>(&p.z[c]), zero{};
    const Real dx = larger<Real>(larger<Real>(s.box.low[0] - x, x - s.box.high[0]), zero);
    const Real dy = larger<Real>(larger<Real>(s.box.low[1] - y, y - s.box.high[1]), zero);
    const Real dz = larger<Real>(larger<Real>(s.box.low[2] - z, z - s.box.high[2]), zero);
    const Real h = s.normal.x * x + s.normal.y * y + s.normal.z * z;
    const typename R::Mask in =
        (dx * dx + dy * dy + dz * dz <= r * r) & (h >= s.slab_low - r) & (h <= s.slab_high + r);
    bits |= R::bits(in) << c;
  }
  return bits;
}

// Nodes of a leaf that are corners of a segment.
template <class R>
unsigned own_points(const std::uint32_t* nodes, const std::array<std::uint32_t, 4>& corners) {
  unsigned bits = 0;
  for (unsigned c = 0; c < PointBlock::width; c += 2 * R::lanes) {
    const auto ids = load<typename R::Id>(nodes + c);
    const typename R::SingleMask own =
        (ids == corners[0]) | (ids == corners[1]) | (ids == corners[2]) | (ids == corners[3]);
    bits |= R::bits(own) << c;
  }
  return bits;
}

struct SubPoint {
  Subs x, y, z;
};

inline void dot(const SubPoint& a, const SubPoint& b, Subs& out) {
  out = a.x * b.x + a.y * b.y + a.z * b.z;
}

// Vectors between points of two convex items, four pairs side by side, with bounds of their
// distances: at most |v|, because v joins a point of one to a point of the other; at least lowest /
// |v|, with `lowest` the smallest v.w over vectors w between corners. Both are valid for any v.
struct Offsets {
  SubPoint v;
  Subs squared;  // v.v
  Subs lowest;
};

// Test of distances < `limit` in the robust formula, decided by bounds. Round-off of bounds and
// formula is far below the widening by Reach; squares that may have vanished decide nothing.
struct RobustLimit {
  Subs near, far;  // squares; without `far` nothing is certain

  static constexpr double vanishing = 0x1p-900;

  RobustLimit(const Subs& limit, const Subs& largest_coordinate) {
    const Subs zero{};
    const Subs wider =
        limit * Reach::relative + largest_coordinate * Reach::of_coordinate + Reach::underflow;
    const Subs low = limit - wider, high = limit + wider;
    near = low > zero ? low * low : zero;
    far = high * high;
  }
  // Masks of those certainly below, and of those certainly not below.
  void judge(const Offsets& o, SubMask& below, SubMask& not_below) const {
    const SubMask told = o.squared > Subs{} + vanishing;
    below = told & (o.squared < near);
    not_below = told & (o.lowest > Subs{}) & (o.lowest * o.lowest > o.squared * far);
  }
};

// Part of the reference formula that is independent of the node, for all sub-triangles.
struct SubTriangles {
  SubPoint o, a, b, n, e, corner_b;
  Subs s, ee, bb, aa;

  void set(const Shape& shape) {
    // A triangle's O is corner 3: only its first sub-triangle has area, as in the formula.
    const auto& c = shape.corner;
    const Point3<double> centre = shape.triangle ? c[2] : 0.25 * (c[0] + c[1] + c[2] + c[3]);
    const SubPoint ca{Subs{c[0].x, c[1].x, c[2].x, c[3].x}, Subs{c[0].y, c[1].y, c[2].y, c[3].y},
                      Subs{c[0].z, c[1].z, c[2].z, c[3].z}};
    corner_b = {Subs{c[1].x, c[2].x, c[3].x, c[0].x}, Subs{c[1].y, c[2].y, c[3].y, c[0].y},
                Subs{c[1].z, c[2].z, c[3].z, c[0].z}};
    const Subs zero{};
    o = {zero + centre.x, zero + centre.y, zero + centre.z};
    a = {ca.x - o.x, ca.y - o.y, ca.z - o.z};
    b = {corner_b.x - o.x, corner_b.y - o.y, corner_b.z - o.z};
    e = {corner_b.x - ca.x, corner_b.y - ca.y, corner_b.z - ca.z};
    n = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    const Subs floor30 = zero + 1e-30, floor20 = zero + 1e-20;
    const Subs nn = n.x * n.x + n.y * n.y + n.z * n.z;
    s = 1.0 / (floor30 < nn ? nn : floor30);
    ee = e.x * e.x + e.y * e.y + e.z * e.z;
    ee = floor20 < ee ? ee : floor20;
    bb = b.x * b.x + b.y * b.y + b.z * b.z;
    bb = floor30 < bb ? bb : floor30;
    aa = a.x * a.x + a.y * a.y + a.z * a.z;
    aa = floor30 < aa ? aa : floor30;
  }

  // From the sub-triangles to a node, by the formula.
  Offsets offsets(const Point3<double>& node) const {
    const Subs zero{}, one = zero + 1.0;
    const SubPoint p{zero + node.x, zero + node.y, zero + node.z};
    const Subs rx = p.x - o.x, ry = p.y - o.y, rz = p.z - o.z;
    Subs la = s * (n.x * (ry * b.z - rz * b.y) + n.y * (rz * b.x - rx * b.z) +
                   n.z * (rx * b.y - ry * b.x));
    Subs lb = s * (n.x * (a.y * rz - a.z * ry) + n.y * (a.z * rx - a.x * rz) +
                   n.z * (a.x * ry - a.y * rx));
    const Subs lo = 1.0 - la - lb;
    const SubMask minus_o = lo < zero, minus_a = la < zero, minus_b = lb < zero;
    const Subs ho = lo * (minus_o ? -lo : lo) / ee;
    const Subs ha = la * (minus_a ? -la : la) / bb;
    const Subs hb = lb * (minus_b ? -lb : lb) / aa;
    const SubMask on_ab = minus_o & (ho <= ha) & (ho <= hb);
    const SubMask on_ob = ~on_ab & minus_a & (ha <= hb) & (ha <= ho);
    const SubMask on_oa = ~on_ab & ~on_ob & minus_b & (hb <= ho) & (hb <= ha);
    const Subs along_ab =
        (corner_b.x - p.x) * e.x + (corner_b.y - p.y) * e.y + (corner_b.z - p.z) * e.z;
    const Subs along_ob = rx * b.x + ry * b.y + rz * b.z;
    const Subs along_oa = rx * a.x + ry * a.y + rz * a.z;
    const Subs numerator = on_ab ? along_ab : (on_ob ? along_ob : along_oa);
    const Subs denominator = on_ab ? ee : (on_ob ? bb : aa);
    Subs ratio = numerator / denominator;
    ratio = ratio < one ? ratio : one;
    ratio = zero < ratio ? ratio : zero;
    la = on_ab ? ratio : (on_ob ? zero : (on_oa ? ratio : la));
    lb = on_ab ? one - ratio : (on_ob ? ratio : (on_oa ? zero : lb));
    Offsets out;
    out.v = {p.x - (o.x + la * a.x + lb * b.x), p.y - (o.y + la * a.y + lb * b.y),
             p.z - (o.z + la * a.z + lb * b.z)};
    dot(out.v, out.v, out.squared);
    // Smallest of v.r, v.(r - a), v.(r - b): r - a and r - b lead from A and B to the node.
    Subs along_r, along_a, along_b;
    dot(out.v, {rx, ry, rz}, along_r);
    dot(out.v, a, along_a);
    dot(out.v, b, along_b);
    const Subs most = along_a < along_b ? along_b : along_a;
    out.lowest = along_r - (zero < most ? most : zero);
    return out;
  }
};

// Test distance < limit on squares: certain below `low` and from `high` on, else by the root.
struct Threshold {
  double limit, low, high;
  explicit Threshold(double l) : limit(l), low(-1.0), high(-1.0) {
    if (!(l > 0.0)) return;  // no distance is below
    const double square = l * l;
    high = square * (1.0 + 0x1p-48);
    low = square * (1.0 - 0x1p-48);
    if (square < 0x1p-960) low = -1.0, high = 0x1p-900;
  }
};

// The smallest of the four distances is below the limit if any is.
template <class R>
bool any_below(const Subs& squared, const Threshold& t) {
  const Subs zero{};
  const bool certain = R::any(squared < zero + t.low);
  const bool possible = R::any(squared < zero + t.high);
  if (certain == possible) [[likely]]
    return certain;
  for (unsigned k = 0; k < 4; ++k) {
    if (std::sqrt(squared[k]) < t.limit) return true;
  }
  return false;
}

// Rare: called, not inlined.
[[gnu::noinline]] inline double robust_distance(const Point3<double>& p,
                                                const std::array<Point3<double>, 4>& corners,
                                                bool triangle) {
  return closest_on_segment<Form::robust>(p, corners, triangle).distance();
}

// Tests points against one segment.
template <class R>
struct SegmentTest {
  const NodeSweep& w;
  const Shape& shape;
  std::uint32_t segment;
  double gap_m, length_m;
  bool constant, lengths, reference;
  double limit;  // without margin
  Threshold threshold;
  SubTriangles sub;

  SegmentTest(const NodeSweep& sweep, const Shape& s, std::uint32_t which)
      : w(sweep),
        shape(s),
        segment(which),
        gap_m(at(w.input->segment_gap, which, 0.0)),
        length_m(at(w.input->segment_length, which, infinity)),
        constant(w.options->gap.rule == GapRule::constant),
        lengths(w.options->gap.rule == GapRule::sum_limited),
        reference(w.options->form == Form::reference),
        limit(pair_limit(*w.options, 0.0, 0.0, 0.0, 0.0)),
        threshold(limit + w.options->margin) {
    sub.set(s);
  }

  // True if the robust distance is below `most`.
  bool robust_below(const Point3<double>& p, const Offsets& offsets, double most) const {
    if (!(most > 0.0)) return false;
    const Subs zero{};
    const RobustLimit bound(zero + most, zero + shape.largest);
    SubMask below, not_below;
    bound.judge(offsets, below, not_below);
    if (!R::any(~not_below)) [[likely]]
      return false;
    if (R::any(below)) return true;
    return robust_distance(p, shape.corner, shape.triangle) < most;
  }

  void point(const PointBlock& leaf, std::uint32_t rank, Found& found) {
    const std::size_t place = rank % 8;
    const Point3<double> p{leaf.x[place], leaf.y[place], leaf.z[place]};
    if (!constant) {
      const double length_s =
          lengths ? at(w.input->secondary_length, w.items[rank], infinity) : infinity;
      limit = pair_limit(*w.options, leaf.gap[place], gap_m, length_s, length_m);
      threshold = Threshold(limit + w.options->margin);
    }
    ++found.tested;
    const Offsets offsets = sub.offsets(p);
    const bool near = reference ? any_below<R>(offsets.squared, threshold)
                                : robust_below(p, offsets, threshold.limit);
    const CandidatePair pair{w.items[rank], segment};
    found.pairs.push_if(near, pair);
    if (w.robust_margin < 0.0 || near) return;
    if (robust_below(p, offsets, limit + w.robust_margin)) [[unlikely]]
      found.robust_only.push(pair);
  }
};

// Part of a group's walk for one segment. Masks of eight blocks, then of eight leaves, are joined
// to words of 64 bits: few long loops are predicted better than many short ones. `box`: the shape's
// `wide`.
template <class R>
void sweep_segment(const NodeSweep& w, const std::vector<Hit>& hits, const Shape& s,
                   const FloatBox& box, std::uint32_t segment, Found& found) {
  const std::vector<BoxBlock>& blocks = w.tree.level(0);
  const auto last_leaf = static_cast<std::uint32_t>(w.points.size() - 1);
  const unsigned last_bits = (2U << ((w.items.size() - 1) % 8)) - 1U;
  const std::array<std::uint32_t, 4>& corners = w.input->segments[segment];
  std::optional<SegmentTest<R>> test;  // most segments are near no nodes but their corners
  std::array<std::uint32_t, 8> leaf;
  unsigned leaves = 0;
  std::uint64_t points = 0;
  const auto test_points = [&] {
    if (leaves > 0 && !test) test.emplace(w, s, segment);
    for (; points != 0; points &= points - 1) {
      const auto bit = static_cast<unsigned>(__builtin_ctzll(points));
      const std::uint32_t i = leaf[bit / 8];
      test->point(w.points[i], i * 8 + bit % 8, found);
    }
    leaves = 0;
  };
  for (std::size_t first = 0; first < hits.size(); first += 8) {
    const std::size_t count = std::min<std::size_t>(8, hits.size() - first);
    std::uint64_t masks = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const Hit& hit = hits[first + k];
      masks |= std::uint64_t{overlaps<R>(blocks[hit.block], box) & hit.mask} << (8 * k);
    }
    for (; masks != 0; masks &= masks - 1) {
      const auto bit = static_cast<unsigned>(__builtin_ctzll(masks));
      const std::uint32_t i = hits[first + bit / 8].block * 8 + bit % 8;
      unsigned bits =
          near_points<R>(w.points[i], s, Reach::widened(s.reach + w.reach[i], s.largest));
      if (i == last_leaf) bits &= last_bits;
      bits &= ~own_points<R>(&w.nodes[std::size_t{i} * 8], corners);
      points |= std::uint64_t{bits} << (8 * leaves);
      leaf[leaves] = i;
      leaves += bits != 0;
      if (leaves == 8) test_points();
    }
  }
  test_points();
}

template <class R>
void sweep_nodes(const NodeSweep& w, std::size_t begin, std::size_t end, Found& found) {
  if (w.tree.levels() == 0) return;
  const NodeSegmentInput& in = *w.input;
  Walk<R> walk;
  std::array<Shape, items_at_once> shapes;
  std::array<FloatBox, items_at_once> boxes;
  for (std::size_t first = begin; first < end; first += items_at_once) {
    const std::size_t count = std::min(items_at_once, end - first);
    FloatBox group;
    double sizes = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t segment = w.segments[first + i];
      shapes[i].set(in.nodes, in.segments[segment],
                    main_reach(*w.options, w.robust_margin, at(in.segment_gap, segment, 0.0)));
      boxes[i] = w.tree.rounded(shapes[i].wide);
      group.add(boxes[i]);
      sizes += boxes[i].size();
    }
    const bool shared = worth_sharing(group.size(), sizes);
    if (shared) {
      walk.find(w.tree, group);
      for (const Hit& hit : walk.hits) {
        for (unsigned mask = hit.mask; mask != 0; mask &= mask - 1) {
          const auto leaf = hit.block * std::size_t{8} + static_cast<unsigned>(__builtin_ctz(mask));
          const char* lines = reinterpret_cast<const char*>(&w.points[leaf]);
          for (unsigned k = 0; k < 4; ++k) __builtin_prefetch(lines + 64 * k);
          __builtin_prefetch(&w.items[leaf * 8]);
          __builtin_prefetch(&w.nodes[leaf * 8]);
        }
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (found.full()) return;
      if (!shared) walk.find(w.tree, boxes[i]);
      sweep_segment<R>(w, walk.hits, shapes[i], boxes[i], w.segments[first + i], found);
    }
  }
}

inline void near_distances(const NodeSegmentInput& in, std::span<const CandidatePair> pairs,
                           NearDistance* out) {
  constexpr double of_coordinate = 0x1p-34, thin_below = 0x1p-20, farther_by = 1.04 * 1.04;
  for (const CandidatePair& pair : pairs) {
    NearDistance& d = *out++;
    d = NearDistance{};
    const auto& nodes = in.segments[pair.main];
    Shape shape;
    for (std::size_t k = 0; k < 4; ++k) shape.corner[k] = point(in.nodes, nodes[k]);
    shape.triangle = nodes[2] == nodes[3];
    SubTriangles sub;
    sub.set(shape);
    const Point3<double> p = point(in.nodes, in.secondary[pair.secondary]);
    const Offsets offsets = sub.offsets(p);
    const Subs nn = sub.n.x * sub.n.x + sub.n.y * sub.n.y + sub.n.z * sub.n.z;
    const Subs height =
        sub.n.x * (p.x - sub.o.x) + sub.n.y * (p.y - sub.o.y) + sub.n.z * (p.z - sub.o.z);
    const std::size_t count = shape.triangle ? 1 : 4;  // the others are no facets
    double least = infinity, largest = 0.0;
    bool thin = false;
    for (std::size_t k = 0; k < count; ++k) {
      const double longest = std::max(sub.ee[k], std::max(sub.aa[k], sub.bb[k]));
      thin |= !(nn[k] >= thin_below * longest * longest);
      least = std::min(least, offsets.squared[k]);
    }
    for (const auto& c : shape.corner)
      largest = std::max(largest, std::max(std::abs(c.x), std::max(std::abs(c.y), std::abs(c.z))));
    largest = std::max(largest, std::max(std::abs(p.x), std::max(std::abs(p.y), std::abs(p.z))));
    d.distance = std::sqrt(least);
    if (thin || !(largest > 0x1p-300 && largest < 0x1p300)) continue;
    d.slack = (largest + d.distance) * of_coordinate;
    // For sub-triangles without area the formula does not give the closest point.
    bool farther = false;
    for (std::size_t k = 0; k < count; ++k) {
      const double excess = offsets.squared[k] - offsets.lowest[k] - d.slack * d.slack;
      farther |= excess > 0.0 && excess * excess > d.slack * d.slack * offsets.squared[k];
    }
    if (farther) {
      d.slack = infinity;
      continue;
    }
    const double far = farther_by * (d.distance + d.slack) * (d.distance + d.slack);
    unsigned nearest = 0, front = 0, behind = 0;
    for (std::size_t k = 0; k < count; ++k) {
      if (offsets.squared[k] > far) continue;
      const unsigned bit = 1U << k;
      nearest |= bit;
      if (height[k] * height[k] > d.slack * d.slack * nn[k])
        (height[k] > 0.0 ? front : behind) |= bit;
    }
    d.nearest = static_cast<std::uint8_t>(nearest);
    d.side = static_cast<std::int8_t>(front == nearest ? 1 : behind == nearest ? -1 : 0);
  }
}

// Segments of eight with a node of the edge.
template <class R>
unsigned with_node(const CornerBlock& corners, const EdgeNodes& edge) {
  unsigned bits = 0;
  for (unsigned c = 0; c < 8; c += 2 * R::lanes) {
    typename R::SingleMask any{};
    for (const auto& nodes : corners.node) {
      const auto ids = load<typename R::Id>(&nodes[c]);
      any |= (ids == edge[0]) | (ids == edge[1]);
    }
    bits |= R::bits(any) << c;
  }
  return bits;
}

// Boxes begin ... end-1 of a list against a tree: together if they are close, else by halves.
// dropped(block, box): bit mask of unwanted leaves.
template <class R, class Dropped>
void meet(const BoxTree& tree, std::span<const Box> boxes, const Dropped& dropped,
          std::vector<Meeting>& out) {
  if (tree.levels() == 0) return;
  const std::vector<BoxBlock>& leaves = tree.level(0);
  Walk<R> walk;
  std::vector<Hit> of_some, of_one;
  // A walk costs more than some further box tests.
  constexpr std::size_t most = 4 * items_at_once;
  std::array<FloatBox, most> some;
  struct Range {
    std::size_t begin, end;
  };
  std::array<Range, most> open;  // the last one is next
  for (std::size_t first = 0; first < boxes.size(); first += most) {
    const std::size_t count = std::min(most, boxes.size() - first);
    for (std::size_t i = 0; i < count; ++i) some[i] = tree.rounded(boxes[first + i]);
    open[0] = {0, count};
    for (std::size_t waiting = 1; waiting > 0;) {
      const auto [begin, end] = open[--waiting];
      FloatBox group;
      double sizes = 0.0;
      for (std::size_t i = begin; i < end; ++i) {
        group.add(some[i]);
        sizes += some[i].size();
      }
      if (end - begin > 1 && !worth_sharing(group.size(), sizes)) {
        const std::size_t middle = begin + (end - begin) / 2;
        open[waiting++] = {middle, end};
        open[waiting++] = {begin, middle};
        continue;
      }
      walk.find(tree, group);
      for (std::size_t i = begin; i < end;) {
        const std::size_t stop = std::min(end, i + items_at_once);
        FloatBox near;
        for (std::size_t k = i; k < stop; ++k) near.add(some[k]);
        const std::span<const Hit> close = Walk<R>::overlapping(leaves, near, walk.hits, of_some);
        for (; i < stop; ++i)
          for (const Hit& hit : Walk<R>::overlapping(leaves, some[i], close, of_one))
            for (unsigned mask = hit.mask & ~dropped(hit.block, first + i); mask != 0;
                 mask &= mask - 1)
              out.push_back({static_cast<std::uint32_t>(first + i),
                             hit.block * 8 + static_cast<std::uint32_t>(__builtin_ctz(mask))});
      }
    }
  }
}

template <class R>
void meet_boxes(const BoxTree& tree, std::span<const Box> boxes, std::vector<Meeting>& out) {
  meet<R>(
      tree, boxes, [](std::uint32_t, std::size_t) { return 0U; }, out);
}

template <class R>
void meet_edges(const BoxTree& tree, std::span<const CornerBlock> corners,
                std::span<const Box> boxes, std::span<const EdgeNodes> edges,
                std::vector<Meeting>& out) {
  meet<R>(
      tree, boxes,
      [&](std::uint32_t block, std::size_t i) { return with_node<R>(corners[block], edges[i]); },
      out);
}

}  // namespace deck::sweep
