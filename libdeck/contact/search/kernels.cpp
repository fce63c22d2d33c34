// Inner loop of the edge search (see lanes.hpp), and all sweeps of the pair search compiled once
// per instruction set and chosen at run time.
#include "contact/search/lanes.hpp"

namespace deck::sweep {

// Rare: called, not inlined.
[[gnu::noinline]] inline double robust_distance(const Point3<double>& s1, const Point3<double>& s2,
                                                const Point3<double>& m1,
                                                const Point3<double>& m2) {
  return closest_between_edges<Form::robust>(s1, s2, m1, m2).distance;
}

// Secondary edges that wait for their distance to one main edge, four at a time.
struct EdgeTest {
  const EdgeSweep& w;
  std::uint32_t edge;
  std::array<std::uint32_t, 2> m;
  Point3<double> m1, m2;
  double gap_m, length_m;
  std::array<std::uint32_t, 4> item{};
  unsigned waiting = 0;

  EdgeTest(const EdgeSweep& sweep, std::uint32_t which)
      : w(sweep),
        edge(which),
        m(w.input->main[which]),
        m1(point(w.input->nodes, m[0])),
        m2(point(w.input->nodes, m[1])),
        gap_m(at(w.input->main_gap, which, 0.0)),
        length_m(at(w.input->main_length, which, infinity)) {}

  // Without margin.
  double limit(std::uint32_t i) const {
    return pair_limit(*w.options, at(w.input->secondary_gap, i, 0.0), gap_m,
                      at(w.input->secondary_length, i, infinity), length_m);
  }

  void add(std::uint32_t i, Found& found) {
    const auto s = w.input->secondary[i];
    if (s[0] == m[0] || s[0] == m[1] || s[1] == m[0] || s[1] == m[1]) return;
    item[waiting++] = i;
    if (waiting == 4) flush(found);
  }

  void flush(Found& found) {
    if (waiting == 0) return;
    found.tested += waiting;
    Subs limits, largest;
    for (unsigned k = 0; k < 4; ++k) limits[k] = limit(item[k < waiting ? k : 0]);
    const Offsets offsets = formula(largest);
    if (w.options->form == Form::robust) {
      robust_below(limits + w.options->margin, offsets, largest, (1U << waiting) - 1U, found.pairs);
      waiting = 0;
      return;
    }
    unsigned rest = 0;
    for (unsigned k = 0; k < waiting; ++k) {
      const double l = limits[k] + w.options->margin;
      const bool near = l > 0.0 && offsets.squared[k] < l * l;
      found.pairs.push_if(near, {item[k], edge});
      rest |= static_cast<unsigned>(!near) << k;
    }
    if (w.robust_margin >= 0.0)
      robust_below(limits + w.robust_margin, offsets, largest, rest, found.robust_only);
    waiting = 0;
  }

  // Edges in `which` whose robust distance is below its limit.
  void robust_below(const Subs& limits, const Offsets& offsets, const Subs& largest, unsigned which,
                    Sink& sink) const {
    const RobustLimit bound(limits, largest);
    SubMask yes, no;
    bound.judge(offsets, yes, no);
    const NodeArrays& nodes = w.input->nodes;
    for (unsigned k = 0; k < waiting; ++k) {
      if ((which >> k & 1U) == 0 || !(limits[k] > 0.0) || no[k] != 0) continue;
      const auto s = w.input->secondary[item[k]];
      if (yes[k] != 0 ||
          robust_distance(point(nodes, s[0]), point(nodes, s[1]), m1, m2) < limits[k])
        sink.push({item[k], edge});
    }
  }

  static void clamp(Subs& v) {
    const Subs zero{}, one = zero + 1.0;
    v = v < one ? v : one;
    v = zero < v ? v : zero;
  }

  // Reference formula for the waiting edges by operations, and the largest coordinate of each.
  Offsets formula(Subs& largest) const {
    std::array<Point3<double>, 4> first, second;
    for (unsigned k = 0; k < 4; ++k) {
      const auto s = w.input->secondary[item[k < waiting ? k : 0]];
      first[k] = point(w.input->nodes, s[0]);
      second[k] = point(w.input->nodes, s[1]);
      largest[k] = 0.0;
      for (const Point3<double>& p : {first[k], second[k], m1, m2})
        largest[k] = std::max({largest[k], std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    const auto lanes = [](const std::array<Point3<double>, 4>& p) {
      return SubPoint{Subs{p[0].x, p[1].x, p[2].x, p[3].x}, Subs{p[0].y, p[1].y, p[2].y, p[3].y},
                      Subs{p[0].z, p[1].z, p[2].z, p[3].z}};
    };
    const SubPoint s1 = lanes(first), s2 = lanes(second);
    const Subs zero{}, floor20 = zero + 1e-20;
    const Subs sx = s2.x - s1.x, sy = s2.y - s1.y, sz = s2.z - s1.z;
    const Point3<double> d = m2 - m1;
    const Subs wx = m2.x - s2.x, wy = m2.y - s2.y, wz = m2.z - s2.z;
    const Subs aa = sx * sx + sy * sy + sz * sz;
    const double cc = dot(d, d);
    const Subs q = -(sx * d.x + sy * d.y + sz * d.z);
    const Subs xa = sx * wx + sy * wy + sz * wz;
    const Subs xb = -(d.x * wx + d.y * wy + d.z * wz);
    Subs det = cc * aa - q * q;
    det = floor20 < det ? det : floor20;
    const Subs aa_floor = aa < floor20 ? floor20 : aa;
    const double cc_floor = std::max(cc, 1e-20);
    Subs hm = (xa * q - xb * aa) / det;
    clamp(hm);
    Subs hs = -(xa + hm * q) / aa_floor;
    clamp(hs);
    hm = -(xb + hs * q) / cc_floor;
    clamp(hm);
    const Subs rs = 1.0 - hs, rm = 1.0 - hm;
    const Subs vx = hs * s1.x + rs * s2.x - hm * m1.x - rm * m2.x;
    const Subs vy = hs * s1.y + rs * s2.y - hm * m1.y - rm * m2.y;
    const Subs vz = hs * s1.z + rs * s2.z - hm * m1.z - rm * m2.z;
    Offsets out;
    out.v = {vx, vy, vz};
    out.squared = vx * vx + vy * vy + vz * vz;
    Subs to_s1, to_s2;
    dot(out.v, s1, to_s1);
    dot(out.v, s2, to_s2);
    const Subs to_m1 = vx * m1.x + vy * m1.y + vz * m1.z;
    const Subs to_m2 = vx * m2.x + vy * m2.y + vz * m2.z;
    out.lowest = (to_s1 < to_s2 ? to_s1 : to_s2) - (to_m1 < to_m2 ? to_m2 : to_m1);
    return out;
  }
};

// Part of a group's walk for one main edge.
template <class R>
void sweep_edge(const EdgeSweep& w, const std::vector<Hit>& hits, const FloatBox& box,
                std::uint32_t edge, Found& found) {
  const std::vector<BoxBlock>& leaves = w.tree.level(0);
  EdgeTest test(w, edge);
  for (const Hit& hit : hits) {
    unsigned mask = overlaps<R>(leaves[hit.block], box) & hit.mask;
    for (; mask != 0; mask &= mask - 1) {
      test.add(w.items[hit.block * 8 + static_cast<std::size_t>(__builtin_ctz(mask))], found);
    }
  }
  test.flush(found);
}

template <class R>
void sweep_edges(const EdgeSweep& w, std::size_t begin, std::size_t end, Found& found) {
  if (w.tree.levels() == 0) return;
  const EdgeEdgeInput& in = *w.input;
  Walk<R> walk;
  std::array<FloatBox, items_at_once> boxes;
  for (std::size_t first = begin; first < end; first += items_at_once) {
    const std::size_t count = std::min(items_at_once, end - first);
    FloatBox group;
    double sizes = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t edge = w.mains[first + i];
      const double own = main_reach(*w.options, w.robust_margin, at(in.main_gap, edge, 0.0));
      boxes[i] = w.tree.rounded(box_of_nodes(in.nodes, in.main[edge], own));
      group.add(boxes[i]);
      sizes += boxes[i].size();
    }
    const bool shared = worth_sharing(group.size(), sizes);
    if (shared) walk.find(w.tree, group);
    for (std::size_t i = 0; i < count; ++i) {
      if (found.full()) return;
      if (!shared) walk.find(w.tree, boxes[i]);
      sweep_edge<R>(w, walk.hits, boxes[i], w.mains[first + i], found);
    }
  }
}

namespace {

// A function with all its callees inlined, for an instruction set.
template <auto function>
struct Compiled;
template <class... Arguments, void (*function)(Arguments...)>
struct Compiled<function> {
  [[gnu::flatten]] static void plain(Arguments... arguments) { function(arguments...); }
#if defined(__x86_64__)
  [[gnu::target("avx2"), gnu::flatten]] static void avx2(Arguments... arguments) {
    function(arguments...);
  }
#endif
};

#if defined(__x86_64__)
const std::array<Kernels, 2> kernel_sets{
    Kernels{Compiled<sweep_nodes<TwoLanes>>::plain, Compiled<sweep_edges<TwoLanes>>::plain,
            Compiled<near_distances>::plain, Compiled<meet_boxes<TwoLanes>>::plain,
            Compiled<meet_edges<TwoLanes>>::plain, "sse2"},
    Kernels{Compiled<sweep_nodes<FourLanes>>::avx2, Compiled<sweep_edges<FourLanes>>::avx2,
            Compiled<near_distances>::avx2, Compiled<meet_boxes<FourLanes>>::avx2,
            Compiled<meet_edges<FourLanes>>::avx2, "avx2"}};
#else  // other processors: two lanes, left to the compiler
const std::array<Kernels, 1> kernel_sets{
    Kernels{Compiled<sweep_nodes<TwoLanes>>::plain, Compiled<sweep_edges<TwoLanes>>::plain,
            Compiled<near_distances>::plain, Compiled<meet_boxes<TwoLanes>>::plain,
            Compiled<meet_edges<TwoLanes>>::plain, "generic"}};
#endif

}  // namespace

std::span<const Kernels> all_kernels() {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2")) return std::span(kernel_sets).first(1);
#endif
  return kernel_sets;
}

const Kernels& kernels() {
  static const Kernels& best = all_kernels().back();
  return best;
}

}  // namespace deck::sweep
