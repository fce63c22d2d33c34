// The segment list of a TYPE24 or TYPE25: what each segment is, turned, merged and ordered as the
// solver does, with a mirrored segment behind every sheet; and the secondary nodes.
#include <algorithm>
#include <tuple>

#include "contact/modern/parts.hpp"

namespace deck::detail::modern {
namespace {

using Quad = std::array<NodeIndex, 4>;

/// Sheets: the first two and the last two nodes change places.
Quad mirrored(const Quad& n) {
  return n[2] == n[3] ? Quad{n[1], n[0], n[2], n[2]} : Quad{n[1], n[0], n[3], n[2]};
}

bool is_shell(Carrier c) { return c == Carrier::shell4 || c == Carrier::shell3; }

/// Mean of the solid's own nodes, each once.
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

class Maker {
 public:
  Maker(SceneContext& c, Sides& out) : c_(c), out_(out) {}

  void add(const SegmentList& segments, std::uint8_t bits) {
    segments.each([&](const Segment& s) { add(s, bits); });
  }
  void finish() {
    if (out_.set.type == 25) {
      merge();
      for (Face& f : out_.faces) f.interior = f.interior && f.kind == SegmentKind::solid;
    }
    out_.undoubled = out_.faces.size();
    for (std::uint32_t i = 0; i < out_.undoubled; ++i) mirror(i);
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

  /// A shell that has all nodes of the segment, or else a solid.
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

  std::int64_t id(NodeIndex n) const { return c_.model.nodes.id[n]; }
  std::array<std::int64_t, 4> key(const Face& f) const {
    std::array<std::int64_t, 4> k{};
    for (std::size_t i = 0; i < 4; ++i) k[i] = id(f.nodes[i]);
    if (f.kind != SegmentKind::solid) return k;
    const auto end = k.begin() + (f.triangle() ? 3 : 4);
    std::sort(k.begin(), end);
    if (f.triangle()) k[3] = 0;
    return k;
  }

  /// Segments of the same nodes become one; ascending by their nodes.
  void merge() {
    struct Keyed {
      std::array<std::int64_t, 4> key;
      int kind;
      std::uint32_t face;
      bool operator<(const Keyed& other) const {
        return std::tie(key, kind, face) < std::tie(other.key, other.kind, other.face);
      }
    };
    const std::vector<Face> faces = std::move(out_.faces);
    std::vector<Keyed> all;
    all.reserve(faces.size());
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
      const Carrier carrier = faces[i].carrier;
      all.push_back({key(faces[i]),
                     static_cast<int>(carrier == Carrier::none ? Carrier::solid : carrier), i});
    }
    if (!std::is_sorted(all.begin(), all.end())) std::sort(all.begin(), all.end());
    out_.faces.clear();
    out_.faces.reserve(2 * faces.size());  // sheets are doubled
    const Keyed* last = nullptr;
    for (const Keyed& k : all) {
      if (last != nullptr && last->key == k.key && last->kind == k.kind)
        out_.faces.back().bits |= faces[k.face].bits;
      else
        out_.faces.push_back(faces[k.face]);
      last = &k;
    }
  }

  void mirror(std::uint32_t i) {
    Face f = out_.faces[i];
    if (f.kind == SegmentKind::solid) return;
    if (f.kind == SegmentKind::coat && out_.set.type == 24) return;
    f.kind = f.kind == SegmentKind::coat ? SegmentKind::coat_opposite : SegmentKind::shell_opposite;
    f.nodes = mirrored(f.nodes);
    f.opposite = i;
    out_.faces[i].opposite = static_cast<std::uint32_t>(out_.faces.size());
    out_.faces.push_back(f);
  }

  SceneContext& c_;
  Sides& out_;
};

/// Nodes in the order of their first mention, with the union of their bits.
class NodeList {
 public:
  explicit NodeList(std::size_t nodes) : place_(nodes, no_index) {}
  void add(NodeIndex n, std::uint8_t bits, bool join) {
    if (n == no_index) return;
    std::uint32_t& p = place_[n];
    if (p == no_index) {
      p = static_cast<std::uint32_t>(list.size());
      list.push_back({n, bits, 0, never});
    } else if (join) {
      list[p].bits |= bits;
    }
  }
  std::vector<SideNode> list;

 private:
  std::vector<std::uint32_t> place_;
};

}  // namespace

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
    // TYPE25 takes no set for a surface (solver error 2087).
    if (id == 0 || (inter.type == 25 && !selections.is_plain("surf", id))) return std::nullopt;
    return selections.outline(id);
  };
  const auto one = level == 3 ? std::nullopt : surface(first);
  const auto two = surface(second);
  NodeList nodes(c.model.nodes.size());
  const auto add_nodes = [&](const std::optional<SurfaceOutline>& s, std::uint8_t bits, bool join) {
    if (s && level != 3)
      s->segments.each([&](const Segment& segment) {
        for (const NodeIndex n : segment.nodes) nodes.add(n, bits, join);
      });
  };
  if (inter.type == 25) {
    add_nodes(one, from_first, true);
    add_nodes(two, from_second, true);
  } else {
    add_nodes(two, from_second, false);
    add_nodes(one, from_first, false);
  }
  if (group != 0)
    if (const NodeSet* set = selections.node_group(group))
      for (const NodeIndex n : set->nodes) nodes.add(n, from_group, false);
  out.nodes = std::move(nodes.list);
  if (inter.type == 25)
    std::stable_sort(out.nodes.begin(), out.nodes.end(), [&](const SideNode& a, const SideNode& b) {
      return c.model.nodes.id[a.node] < c.model.nodes.id[b.node];
    });
  Maker maker(c, out);
  if (one) maker.add(one->segments, level == 3 ? 0 : from_first);
  if (two) maker.add(two->segments, level == 3 ? 0 : from_second);
  maker.finish();
}

}  // namespace deck::detail::modern
