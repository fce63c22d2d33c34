// Segment list of a TYPE24 or TYPE25: kind of each segment; turned, merged and ordered as in the
// solver, with a mirrored segment for every sheet; and the secondary nodes.
#include <algorithm>
#include <tuple>
#include <utility>

#include "base/shared/parallel.hpp"
#include "contact/type24_25/type24_25.hpp"

namespace deck::detail::type24_25 {
namespace {

bool is_shell(Carrier c) { return c == Carrier::shell4 || c == Carrier::shell3; }

/// Mean of the solid's distinct nodes.
Vec centre_of(const Model& model, const Coordinates& x, std::uint32_t solid) {
  const NodeIndex* slots = model.solid8.of(solid);
  Vec sum;
  int count = 0;
  for (int i = 0; i < 8; ++i) {
    if (slots[i] == no_index || std::find(slots, slots + i, slots[i]) != slots + i) continue;
    sum = sum + at(x, slots[i]);
    ++count;
  }
  return count == 0 ? sum : (1.0 / count) * sum;
}

class SegmentMaker {
 public:
  SegmentMaker(SceneContext& c, Sides& out) : c_(c), out_(out) {}

  void add(const SegmentList& segments, std::uint8_t bits) {
    segments.for_each([&](const Segment& s) { add(s, bits); });
  }
  void add_mirrors() {
    if (out_.set.type == 25) {
      merge();
      for (Face& f : out_.faces) f.interior = f.interior && f.kind == SegmentKind::solid;
    }
    out_.mirrors.reserve(out_.faces.size());
    auto number = static_cast<std::uint32_t>(out_.faces.size());
    for (std::uint32_t i = 0; i < out_.faces.size(); ++i) {
      Face& f = out_.faces[i];
      out_.solids = out_.solids || f.solid_like();
      if (f.kind == SegmentKind::solid) continue;
      if (f.kind == SegmentKind::coat && out_.set.type == 24) continue;
      f.opposite = number++;
      out_.mirrors.push_back(i);
    }
  }

 private:
  void add(const Segment& s, std::uint8_t bits) {
    Face f;
    f.nodes = s.nodes;
    if (std::find(f.nodes.begin(), f.nodes.end(), no_index) != f.nodes.end()) return;
    repair(f.nodes);
    f.bits = bits;
    f.carrier = s.carrier;
    f.element = s.element;
    const SolidsOfSegment solids = solids_of(c_, f.nodes);
    if (s.carrier == Carrier::none) find_carrier(f, solids);
    if (is_shell(f.carrier))
      as_sheet(f, solids);
    else
      as_solid(f, s.carrier, solids);
    out_.faces.push_back(f);
  }

  /// Finds a shell with all nodes of the segment, else a solid.
  void find_carrier(Face& f, const SolidsOfSegment& solids) {
    if (const ShellOfSegment shell = shell_of(c_, f.nodes); shell.element != no_index) {
      f.carrier = shell.kind == ElementKind::shell4 ? Carrier::shell4 : Carrier::shell3;
      f.element = shell.element;
    } else if (solids.best != no_index) {
      f.carrier = Carrier::solid;
      f.element = solids.best;
    }
  }

  void as_sheet(Face& f, const SolidsOfSegment& solids) {
    f.kind = solids.count > 0 ? SegmentKind::coat : SegmentKind::shell;
    if (solids.count == 0) return;
    f.solid = solids.best;
    const Coordinates& x = c_.scene.coordinates;
    const Vec p3 = at(x, f.nodes[2]);
    const Vec inward = cross(p3 - at(x, f.nodes[1]), p3 - at(x, f.nodes[0]));
    if (dot(p3 - centre_of(c_.model, x, solids.first), inward) > 0) f.nodes = mirrored(f.nodes);
  }

  void as_solid(Face& f, Carrier written, const SolidsOfSegment& solids) {
    f.kind = SegmentKind::solid;
    f.solid = f.element;
    if (solids.count > 2) out_.crowded.push_back(static_cast<std::uint32_t>(out_.faces.size()));
    if (solids.count == 0) return;
    const bool plain = written == Carrier::none;
    if (solids.count > 1) {
      f.interior = out_.set.type == 25 && !plain;
      if (out_.set.type == 24 || f.interior) {
        if (!plain) return;
        f.element = f.solid = solids.best;
        return;
      }
      f.element = f.solid = solids.best;
    }
    out_.reoriented += orient_outward(c_, f.solid, f.nodes);
  }

  /// Numbered from 1; 0 is the fourth node of a triangle.
  static std::array<std::uint64_t, 4> key(const Face& f) {
    std::array<std::uint64_t, 4> k{};
    for (std::size_t i = 0; i < 4; ++i) k[i] = std::uint64_t{f.nodes[i]} + 1;
    if (f.kind != SegmentKind::solid) return k;
    const auto end = k.begin() + (f.triangle() ? 3 : 4);
    std::sort(k.begin(), end);
    if (f.triangle()) k[3] = 0;
    return k;
  }

  struct Keyed {
    std::array<std::uint64_t, 4> key;
    int kind;
    std::uint32_t face;
    bool same(const Keyed& other) const { return key == other.key && kind == other.kind; }
    bool operator<(const Keyed& other) const {
      return std::tie(key, kind, face) < std::tie(other.key, other.kind, other.face);
    }
  };
  Keyed keyed(std::uint32_t i) const {
    const Carrier carrier = out_.faces[i].carrier;
    return {key(out_.faces[i]),
            static_cast<int>(carrier == Carrier::none ? Carrier::solid : carrier), i};
  }
  /// True if sorted and distinct, as mostly.
  bool merged_already() const {
    const auto first = [&](const Face& f) {
      return f.kind == SegmentKind::solid ? key(f)[0] : std::uint64_t{f.nodes[0]} + 1;
    };
    for (std::uint32_t i = 1; i < out_.faces.size(); ++i) {
      const std::uint64_t a = first(out_.faces[i - 1]), b = first(out_.faces[i]);
      if (a < b) continue;
      if (a > b) return false;
      const Keyed before = keyed(i - 1), here = keyed(i);
      if (!(before < here) || before.same(here)) return false;
    }
    return true;
  }

  /// Merges segments with equal nodes; sorts by nodes.
  void merge() {
    if (merged_already()) return;
    std::vector<Keyed> all;
    all.reserve(out_.faces.size());
    for (std::uint32_t i = 0; i < out_.faces.size(); ++i) all.push_back(keyed(i));
    std::sort(all.begin(), all.end());
    const std::vector<Face> faces = std::move(out_.faces);
    out_.faces.clear();
    out_.faces.reserve(faces.size());
    std::vector<std::uint32_t> place(faces.size());
    const Keyed* last = nullptr;
    for (const Keyed& k : all) {
      if (last != nullptr && last->same(k))
        out_.faces.back().bits |= faces[k.face].bits;
      else
        out_.faces.push_back(faces[k.face]);
      place[k.face] = static_cast<std::uint32_t>(out_.faces.size() - 1);
      last = &k;
    }
    std::vector<std::uint32_t>& crowded = out_.crowded;
    for (std::uint32_t& i : crowded) i = place[i];
    std::sort(crowded.begin(), crowded.end());
    crowded.erase(std::unique(crowded.begin(), crowded.end()), crowded.end());
  }

  SceneContext& c_;
  Sides& out_;
};

class NodeBits {
 public:
  explicit NodeBits(std::size_t nodes) : bits_(nodes, 0) {}
  void add(NodeIndex n, std::uint8_t bits) {
    if (n != no_index) bits_[n] |= bits;
  }
  /// Adds the nodes of a group that are not there yet.
  void add_others(const std::vector<NodeIndex>& group) {
    for (const NodeIndex n : group)
      if (n != no_index && bits_[n] == 0) bits_[n] = from_group;
  }
  std::vector<SideNode> list() const {
    std::vector<SideNode> out;
    out.reserve(bits_.size() - static_cast<std::size_t>(std::count(bits_.begin(), bits_.end(), 0)));
    for (NodeIndex n = 0; n < bits_.size(); ++n)
      if (bits_[n] != 0) out.push_back({n, bits_[n], 0, no_limit});
    return out;
  }

 private:
  std::vector<std::uint8_t> bits_;
};

/// Nodes in order of first mention, with the bits of that mention.
class NodesByMention {
 public:
  explicit NodesByMention(std::size_t nodes) : known_(nodes, false) {}
  void add(NodeIndex n, std::uint8_t bits) {
    if (n == no_index || known_[n]) return;
    known_[n] = true;
    list.push_back({n, bits, 0, no_limit});
  }
  std::vector<SideNode> list;

 private:
  std::vector<bool> known_;
};

}  // namespace

Face Sides::face(std::uint32_t i) const {
  Face f = faces[base(i)];
  if (!is_mirror(i)) return f;
  f.opposite = base(i);
  f.kind = f.kind == SegmentKind::coat ? SegmentKind::coat_opposite : SegmentKind::shell_opposite;
  f.nodes = mirrored(f.nodes);
  std::swap(f.stiffness, f.back_stiffness);
  if (set.local()) f.length = 0;
  return f;
}

void make_sides(SceneContext& c, Selections& selections, const InterBase& inter, Sides& out) {
  std::int64_t first = 0, second = 0, group = 0;
  visit_interface(inter, [&](const auto& i) {
    if constexpr (requires { i.surf_ID1; }) {
      first = i.surf_ID1.value;
      second = i.surf_ID2.value;
      group = i.grnd_IDs.value;
    }
  });
  const int level = out.set.level;
  if (level == 1) second = 0;
  const auto surface = [&](std::int64_t id) -> std::optional<SurfaceOutline> {
    // TYPE25 accepts no set as surface (solver error 2087).
    if (id == 0 || (inter.type == 25 && !selections.is_plain("surf", id))) return std::nullopt;
    return selections.outline(id);
  };
  const auto one = level == 3 ? std::nullopt : surface(first);
  const auto two = surface(second);
  const auto nodes_of = [&](const std::optional<SurfaceOutline>& s, const auto& use) {
    if (s && level != 3)
      s->segments.for_each([&](const Segment& segment) {
        for (const NodeIndex n : segment.nodes) use(n);
      });
  };
  const NodeSet* const grnod = group != 0 ? selections.node_group(group) : nullptr;
  if (inter.type == 25) {
    NodeBits nodes(c.model.nodes.size());
    nodes_of(one, [&](NodeIndex n) { nodes.add(n, from_first); });
    nodes_of(two, [&](NodeIndex n) { nodes.add(n, from_second); });
    if (grnod != nullptr) nodes.add_others(grnod->nodes);
    out.nodes = nodes.list();
  } else {
    NodesByMention nodes(c.model.nodes.size());
    nodes_of(two, [&](NodeIndex n) { nodes.add(n, from_second); });
    nodes_of(one, [&](NodeIndex n) { nodes.add(n, from_first); });
    if (grnod != nullptr)
      for (const NodeIndex n : grnod->nodes) nodes.add(n, from_group);
    out.nodes = std::move(nodes.list);
  }
  out.faces.reserve((one ? one->segments.size() : 0) + (two ? two->segments.size() : 0));
  SegmentMaker maker(c, out);
  if (one) maker.add(one->segments, level == 3 ? 0 : from_first);
  if (two) maker.add(two->segments, level == 3 ? 0 : from_second);
  maker.add_mirrors();
  if (out.set.iedge <= 0) return;
  if (inter.type == 24)
    for (const auto* s : {&one, &two})
      if (*s && level != 3) make_points(c, (*s)->segments, out);
  for (const std::int64_t id : {level == 3 ? 0 : first, second}) {
    if (inter.type != 25 || !selections.is_plain("line", id)) continue;
    for (const Edge& e : selections.line(id)->edges)
      if (e.carrier == Carrier::truss || e.carrier == Carrier::beam || e.carrier == Carrier::spring)
        out.lines.push_back(e);
  }
}

}  // namespace deck::detail::type24_25
