// The inner loops of the pair search on vectors of DECK_LANES doubles. No include guard on
// purpose: search_kernels.cpp includes this text once per instruction set, each time inside a
// namespace of its own. The arithmetic is that of closest_on_segment, operation by operation, so
// that every version gives the same bits.

typedef double Lanes __attribute__((vector_size(8 * DECK_LANES)));
typedef long long LaneMask __attribute__((vector_size(8 * DECK_LANES)));

inline Lanes load(const double* from) {
  Lanes v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
inline void store(double* to, Lanes v) { __builtin_memcpy(to, &v, sizeof v); }
inline Lanes all(double value) { return value - Lanes{}; }
inline Lanes larger(Lanes a, Lanes b) { return a > b ? a : b; }
inline Lanes smaller(Lanes a, Lanes b) { return a < b ? a : b; }

// Which of eight boxes overlap box `b`, as bit mask.
inline unsigned overlaps(const BoxBlock& block, const Box& b) {
  unsigned bits = 0;
  for (unsigned c = 0; c < BoxBlock::kWidth; c += DECK_LANES) {
    LaneMask in = (load(&block.low[0][c]) <= all(b.high[0]));
    in &= (load(&block.high[0][c]) >= all(b.low[0]));
    in &= (load(&block.low[1][c]) <= all(b.high[1]));
    in &= (load(&block.high[1][c]) >= all(b.low[1]));
    in &= (load(&block.low[2][c]) <= all(b.high[2]));
    in &= (load(&block.high[2][c]) >= all(b.low[2]));
    bits |= DECK_LANE_BITS(in) << c;
  }
  return bits;
}

// Leaf blocks that may hold something inside a box: block of level 0 and bit mask of its children.
struct Hit {
  std::uint32_t block;
  std::uint32_t mask;
};

struct Walk {
  std::vector<Hit> hits;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stack;  // level, block

  void find(const BoxTree& tree, const Box& b) {
    hits.clear();
    if (tree.levels() == 0) return;
    stack.clear();
    stack.emplace_back(static_cast<std::uint32_t>(tree.levels() - 1), 0);
    while (!stack.empty()) {
      const auto [level, block] = stack.back();
      stack.pop_back();
      unsigned mask = overlaps(tree.level(level)[block], b);
      if (level == 0) {
        if (mask != 0) hits.push_back({block, mask});
        continue;
      }
      for (; mask != 0; mask &= mask - 1) {
        const auto child = static_cast<std::uint32_t>(__builtin_ctz(mask));
        stack.emplace_back(level - 1, block * 8 + child);
      }
    }
  }
};

// One segment as the sweep needs it: corners, box, and a slab between two parallel planes.
struct Shape {
  std::array<Point3<double>, 4> corner;
  bool triangle = false;
  Box box;   // of the corners
  Box wide;  // widened by the segment's own reach
  double reach = 0.0;
  double largest = 0.0;   // coordinate magnitude
  Point3<double> normal;  // of the slab; zero if the segment has none
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

// Which points of a leaf may be within `r` of a segment: within r of its box and of its slab.
inline unsigned near_points(const PointBlock& p, const Shape& s, double r) {
  unsigned bits = 0;
  const Lanes zero = all(0.0), limit = all(r * r);
  for (unsigned c = 0; c < PointBlock::kWidth; c += DECK_LANES) {
    const Lanes x = load(&p.x[c]), y = load(&p.y[c]), z = load(&p.z[c]);
    const Lanes dx = larger(larger(s.box.low[0] - x, x - s.box.high[0]), zero);
    const Lanes dy = larger(larger(s.box.low[1] - y, y - s.box.high[1]), zero);
    const Lanes dz = larger(larger(s.box.low[2] - z, z - s.box.high[2]), zero);
    const Lanes h = s.normal.x * x + s.normal.y * y + s.normal.z * z;
    LaneMask in = (dx * dx + dy * dy + dz * dz <= limit);
    in &= (h >= all(s.slab_low - r));
    in &= (h <= all(s.slab_high + r));
    bits |= DECK_LANE_BITS(in) << c;
  }
  return bits & p.used;
}

// Points that passed the box test of one segment, side by side.
struct Batch {
  static constexpr std::size_t kCapacity = 128;
  std::size_t count = 0;
  alignas(64) std::array<double, kCapacity + 8> x, y, z, distance;
  std::array<std::uint32_t, kCapacity> item;

  void add(const PointBlock& p, std::size_t place) {
    x[count] = p.x[place];
    y[count] = p.y[place];
    z[count] = p.z[place];
    item[count++] = p.item[place];
  }
};

// The part of the reference formula that depends on the sub-triangle only.
struct SubTriangle {
  Point3<double> o, a, b, n, e, corner_b;
  double s, ee, bb, aa;

  SubTriangle(const Point3<double>& centre, const Point3<double>& ca, const Point3<double>& cb)
      : o(centre), a(ca - centre), b(cb - centre), n(cross(a, b)), e(cb - ca), corner_b(cb) {
    s = 1.0 / std::max(1e-30, dot(n, n));
    ee = std::max(1e-20, dot(e, e));
    bb = std::max(1e-30, dot(b, b));
    aa = std::max(1e-30, dot(a, a));
  }
};

// Squared distance of points to one sub-triangle.
inline Lanes squared_distance(const SubTriangle& t, Lanes px, Lanes py, Lanes pz) {
  const Lanes zero = all(0.0), one = all(1.0);
  const Lanes rx = px - t.o.x, ry = py - t.o.y, rz = pz - t.o.z;
  Lanes la = t.s * (t.n.x * (ry * t.b.z - rz * t.b.y) + t.n.y * (rz * t.b.x - rx * t.b.z) +
                    t.n.z * (rx * t.b.y - ry * t.b.x));
  Lanes lb = t.s * (t.n.x * (t.a.y * rz - t.a.z * ry) + t.n.y * (t.a.z * rx - t.a.x * rz) +
                    t.n.z * (t.a.x * ry - t.a.y * rx));
  const Lanes lo = 1.0 - la - lb;
  const LaneMask minus_o = lo < zero, minus_a = la < zero, minus_b = lb < zero;
  const Lanes ho = lo * (minus_o ? -lo : lo) / t.ee;
  const Lanes ha = la * (minus_a ? -la : la) / t.bb;
  const Lanes hb = lb * (minus_b ? -lb : lb) / t.aa;
  const LaneMask on_ab = minus_o & (ho <= ha) & (ho <= hb);
  const LaneMask on_ob = ~on_ab & minus_a & (ha <= hb) & (ha <= ho);
  const LaneMask on_oa = ~on_ab & ~on_ob & minus_b & (hb <= ho) & (hb <= ha);
  const Lanes along_ab =
      (t.corner_b.x - px) * t.e.x + (t.corner_b.y - py) * t.e.y + (t.corner_b.z - pz) * t.e.z;
  const Lanes along_ob = rx * t.b.x + ry * t.b.y + rz * t.b.z;
  const Lanes along_oa = rx * t.a.x + ry * t.a.y + rz * t.a.z;
  const Lanes numerator = on_ab ? along_ab : (on_ob ? along_ob : along_oa);
  const Lanes denominator = on_ab ? all(t.ee) : (on_ob ? all(t.bb) : all(t.aa));
  const Lanes ratio = larger(zero, smaller(one, numerator / denominator));
  la = on_ab ? ratio : (on_ob ? zero : (on_oa ? ratio : la));
  lb = on_ab ? one - ratio : (on_ob ? ratio : (on_oa ? zero : lb));
  const Lanes vx = px - (t.o.x + la * t.a.x + lb * t.b.x);
  const Lanes vy = py - (t.o.y + la * t.a.y + lb * t.b.y);
  const Lanes vz = pz - (t.o.z + la * t.a.z + lb * t.b.z);
  return vx * vx + vy * vy + vz * vz;
}

inline Lanes root(Lanes v) {
  Lanes out = v;
  for (unsigned i = 0; i < DECK_LANES; ++i) out[i] = __builtin_sqrt(v[i]);
  return out;
}

// Distances of a batch to a segment, reference form.
inline void distances(const Shape& s, Batch& batch) {
  const auto& x = s.corner;
  for (std::size_t i = batch.count; i < batch.count + DECK_LANES - 1; ++i) {
    batch.x[i] = batch.x[0];
    batch.y[i] = batch.y[0];
    batch.z[i] = batch.z[0];
  }
  if (s.triangle) {
    const SubTriangle first(x[2], x[0], x[1]);
    for (std::size_t i = 0; i < batch.count; i += DECK_LANES) {
      const Lanes px = load(&batch.x[i]), py = load(&batch.y[i]), pz = load(&batch.z[i]);
      // The three degenerate sub-triangles are the third node.
      const Lanes vx = px - x[2].x, vy = py - x[2].y, vz = pz - x[2].z;
      const Lanes node = vx * vx + vy * vy + vz * vz;
      store(&batch.distance[i], root(smaller(node, squared_distance(first, px, py, pz))));
    }
    return;
  }
  const Point3<double> o = 0.25 * (x[0] + x[1] + x[2] + x[3]);
  const std::array<SubTriangle, 4> sub{SubTriangle(o, x[0], x[1]), SubTriangle(o, x[1], x[2]),
                                       SubTriangle(o, x[2], x[3]), SubTriangle(o, x[3], x[0])};
  for (std::size_t i = 0; i < batch.count; i += DECK_LANES) {
    const Lanes px = load(&batch.x[i]), py = load(&batch.y[i]), pz = load(&batch.z[i]);
    Lanes best = squared_distance(sub[0], px, py, pz);
    for (std::size_t k = 1; k < 4; ++k) best = smaller(squared_distance(sub[k], px, py, pz), best);
    store(&batch.distance[i], root(best));
  }
}

inline void flush(const NodeSweep& w, std::uint32_t segment, const Shape& s, Batch& batch,
                  Sink& sink) {
  if (batch.count == 0) return;
  const NodeSegmentInput& in = *w.input;
  const SearchOptions& options = *w.options;
  sink.tested += batch.count;
  if (options.form == Form::reference) {
    distances(s, batch);
  } else {
    for (std::size_t i = 0; i < batch.count; ++i) {
      batch.distance[i] =
          closest_on_segment<Form::robust>(Point3<double>{batch.x[i], batch.y[i], batch.z[i]},
                                           s.corner, s.triangle)
              .distance();
    }
  }
  const double gap_m = at(in.segment_gap, segment, 0.0);
  const double length_m = at(in.segment_length, segment, kInfinity);
  const bool constant = options.gap.rule == GapRule::constant;
  const double one_limit = pair_limit(options, 0.0, 0.0, 0.0, 0.0);
  const auto& nodes = in.segments[segment];
  for (std::size_t i = 0; i < batch.count; ++i) {
    const std::uint32_t item = batch.item[i];
    const double limit = constant ? one_limit
                                  : pair_limit(options, at(in.secondary_gap, item, 0.0), gap_m,
                                               at(in.secondary_length, item, kInfinity), length_m);
    if (!(batch.distance[i] < limit)) continue;
    const std::uint32_t node = in.secondary[item];
    if (node == nodes[0] || node == nodes[1] || node == nodes[2] || node == nodes[3]) continue;
    sink.pairs.push_back({item, segment});
  }
  batch.count = 0;
}

inline void sweep_nodes(const NodeSweep& w, std::size_t begin, std::size_t end, Sink& sink) {
  const NodeSegmentInput& in = *w.input;
  Walk walk;
  Batch batch;
  std::array<Shape, kGroup> shapes;
  if (w.tree.levels() == 0) return;
  const std::vector<BoxBlock>& leaves = w.tree.level(0);
  for (std::size_t first = begin; first < end; first += kGroup) {
    const std::size_t count = std::min(kGroup, end - first);
    Box group;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t segment = w.segments[first + i];
      shapes[i].set(in.nodes, in.segments[segment],
                    main_reach(*w.options, at(in.segment_gap, segment, 0.0)));
      group.add(shapes[i].wide);
    }
    walk.find(w.tree, group);
    for (std::size_t i = 0; i < count; ++i) {
      const Shape& s = shapes[i];
      const std::uint32_t segment = w.segments[first + i];
      for (const Hit& hit : walk.hits) {
        unsigned mask = overlaps(leaves[hit.block], s.wide) & hit.mask;
        for (; mask != 0; mask &= mask - 1) {
          const PointBlock& leaf =
              w.points[hit.block * 8 + static_cast<std::size_t>(__builtin_ctz(mask))];
          const double r = Reach::widened(s.reach + leaf.reach, s.largest);
          unsigned near = near_points(leaf, s, r);
          for (; near != 0; near &= near - 1) {
            batch.add(leaf, static_cast<std::size_t>(__builtin_ctz(near)));
          }
          if (batch.count > Batch::kCapacity - 8) flush(w, segment, s, batch, sink);
        }
      }
      flush(w, segment, s, batch, sink);
    }
  }
}

inline void sweep_edges(const EdgeSweep& w, std::size_t begin, std::size_t end, Sink& sink) {
  const EdgeEdgeInput& in = *w.input;
  const SearchOptions& options = *w.options;
  Walk walk;
  std::array<Box, kGroup> boxes;
  if (w.tree.levels() == 0) return;
  const std::vector<BoxBlock>& leaves = w.tree.level(0);
  for (std::size_t first = begin; first < end; first += kGroup) {
    const std::size_t count = std::min(kGroup, end - first);
    Box group;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t edge = w.mains[first + i];
      boxes[i] = edge_box(in.nodes, in.main[edge], main_reach(options, at(in.main_gap, edge, 0.0)));
      group.add(boxes[i]);
    }
    walk.find(w.tree, group);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t edge = w.mains[first + i];
      const auto m = in.main[edge];
      const Point3<double> m1 = point(in.nodes, m[0]), m2 = point(in.nodes, m[1]);
      const double gap_m = at(in.main_gap, edge, 0.0);
      const double length_m = at(in.main_length, edge, kInfinity);
      for (const Hit& hit : walk.hits) {
        unsigned mask = overlaps(leaves[hit.block], boxes[i]) & hit.mask;
        for (; mask != 0; mask &= mask - 1) {
          const std::uint32_t item =
              w.items[hit.block * 8 + static_cast<std::size_t>(__builtin_ctz(mask))];
          const auto s = in.secondary[item];
          if (s[0] == m[0] || s[0] == m[1] || s[1] == m[0] || s[1] == m[1]) continue;
          const double limit = pair_limit(options, at(in.secondary_gap, item, 0.0), gap_m,
                                          at(in.secondary_length, item, kInfinity), length_m);
          ++sink.tested;
          if (edges_are_near(options, point(in.nodes, s[0]), point(in.nodes, s[1]), m1, m2,
                             limit)) {
            sink.pairs.push_back({item, edge});
          }
        }
      }
    }
  }
}
