// Exterior faces. Input: solids in eight slots; output: faces that no other solid shares, in the
// solver's order.
//
// Notation: a face a b c d starts at its smallest node a, in outward order. A neighbour has the
// shared face in the opposite sense a d c b. So faces are sorted by their smallest node and the one
// before it, and a neighbour of a b c d is searched at (a, b); its solid must have all nodes of the
// face. Cost: O(faces) if few solids share an edge.
#include "model/shared/faces.hpp"

#include <algorithm>
#include <utility>

#include "model/shared/buckets.hpp"

namespace deck::detail {
namespace {

// Outward faces of the stored slots, in the solver's order.
constexpr std::uint8_t face_slots[6][4] = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                           {2, 3, 7, 6}, {1, 2, 6, 5}, {0, 4, 7, 3}};
// Mid-side nodes (0-based on the card) of faces 2..5 of a 10-node tetrahedron.
constexpr int tetra_mids[6][3] = {{-1, -1, -1}, {-1, -1, -1}, {2, 5, 3},
                                  {4, 5, 1},    {0, 1, 2},    {3, 4, 0}};

/// True for solids that can make faces of others interior.
bool is_neighbour(SolidShape shape) {
  return shape != SolidShape::brick20 && shape != SolidShape::thick16;
}

bool complete(const Elements& solids, std::size_t e) {
  const NodeIndex* n = solids.of(e);
  return std::find(n, n + 8, no_index) == n + 8;
}

/// Smallest node of a face, and those after and before it.
struct LeastCorner {
  explicit LeastCorner(const Face& face) {
    const int n = face.corners;
    std::uint64_t least = ~std::uint64_t{0};  // a node, then its corner: no branch
    for (std::size_t i = 4; i-- > 0;)
      least = std::min(least, std::uint64_t{face.nodes[i]} << 2 | i);
    const auto k = static_cast<int>(least & 3);
    node = face.nodes[k];
    next = face.nodes[k + 1 < n ? k + 1 : 0];
    last = face.nodes[k > 0 ? k - 1 : std::max(n, 1) - 1];
  }
  NodeIndex node, next, last;
};

void append_face(const Elements& solids, std::uint32_t e, int f, const Face& face,
                 std::vector<Segment>& out) {
  if (solids.shape[e] != SolidShape::tetra10 || face.corners != 3) {
    out.push_back({face.nodes, Carrier::solid, e});
    return;
  }
  std::array<std::array<NodeIndex, 4>, 4> pieces;
  const int count = cut_triangle({face.nodes[0], face.nodes[1], face.nodes[2]},
                                 tetra10_mids(solids, e, f), pieces);
  for (int i = 0; i < count; ++i)
    out.push_back({pieces[static_cast<std::size_t>(i)], Carrier::solid, e});
}

}  // namespace

Face solid_face(const NodeIndex* slots, int face) {
  const auto& at = face_slots[face];
  Face out{{slots[at[0]], slots[at[1]], slots[at[2]], slots[at[3]]}, 4};
  const auto [a, b, c, d] = out.nodes;
  if (((a != b) & (a != c) & (a != d) & (b != c) & (b != d) & (c != d)) != 0) return out;
  std::size_t n = 0;
  for (const NodeIndex node : {a, b, c, d}) {
    bool repeated = false;
    for (std::size_t k = 0; k < n; ++k) repeated |= out.nodes[k] == node;
    if (!repeated) out.nodes[n++] = node;
  }
  if (n == 3) out.nodes[3] = out.nodes[2];
  out.corners = n >= 3 ? static_cast<int>(n) : 0;
  return out;
}

bool has_face_of(const NodeIndex* slots, const std::array<NodeIndex, 4>& segment) {
  // Bit k: the slot has node k of the segment. Four distinct nodes have all four bits; a segment
  // that repeats a node has only three.
  std::array<unsigned, 8> bits{};
  for (std::size_t k = 0; k < 4; ++k) {
    if (std::find(segment.begin(), segment.begin() + k, segment[k]) != segment.begin() + k)
      return false;
    for (std::size_t i = 0; i < 8; ++i)
      bits[i] |= static_cast<unsigned>(slots[i] == segment[k]) << k;
  }
  return std::any_of(std::begin(face_slots), std::end(face_slots), [&](const auto& face) {
    return (bits[face[0]] | bits[face[1]] | bits[face[2]] | bits[face[3]]) == 15U;
  });
}

NodeKey node_key(const NodeIndex* nodes, int count) {
  NodeKey key;
  std::size_t n = 0;
  for (int i = 0; i < count; ++i) {
    std::size_t at = 0;
    while (at < n && key.nodes[at] < nodes[i]) ++at;
    if (at < n && key.nodes[at] == nodes[i]) continue;
    for (std::size_t k = n; k > at; --k) key.nodes[k] = key.nodes[k - 1];
    key.nodes[at] = nodes[i];
    ++n;
  }
  return key;
}

ShellCover::ShellCover(const Elements& shell4, const Elements& shell3)
    : shell4_(&shell4), shell3_(&shell3), stamp4_(shell4.size(), 0), stamp3_(shell3.size(), 0) {
  entries_.reserve(shell4.size() + shell3.size());
  first_.assign(shell4.size() + shell3.size(), no_index);
  add(shell4, true);
  add(shell3, false);
}

void ShellCover::add(const Elements& shells, bool four) {
  for (std::uint32_t e = 0; e < shells.size(); ++e) {
    std::uint32_t& last = first_[list_of(shells.of(e), shells.width, first_.size())];
    entries_.push_back({four, e, last});
    last = static_cast<std::uint32_t>(entries_.size()) - 1;
  }
}

void ShellCover::select(const std::vector<std::uint32_t>& shells4,
                        const std::vector<std::uint32_t>& shells3) {
  ++generation_;
  for (const std::uint32_t e : shells4) stamp4_[e] = generation_;
  for (const std::uint32_t e : shells3) stamp3_[e] = generation_;
}

bool ShellCover::selected(const CoverShell& shell) const {
  return (shell.four ? stamp4_ : stamp3_)[shell.element] == generation_;
}

CoverShell ShellCover::shell(std::uint32_t number) const {
  return {entries_[number].four, entries_[number].element};
}

std::uint32_t ShellCover::on(const Face& face) const {
  const NodeIndex* const corners = face.nodes.data();
  if (first_.empty()) return no_index;
  const bool four = face.corners == 4;
  std::uint32_t best = no_index;
  std::pair<std::ptrdiff_t, std::uint32_t> best_place;
  for (std::uint32_t i = first_[list_of(corners, face.corners, first_.size())]; i != no_index;
       i = entries_[i].next) {
    const ShellEntry& entry = entries_[i];
    if (entry.four != four) continue;
    const NodeIndex* n = (four ? shell4_ : shell3_)->of(entry.element);
    if (!contains_all(n, face.corners, face.nodes)) continue;
    const std::pair place(std::find(n, n + face.corners, corners[0]) - n, entry.element);
    if (best == no_index || place < best_place) {
      best = i;
      best_place = place;
    }
  }
  return best;
}

SolidFaces::SolidFaces(const Elements& solids)
    : solids_(&solids),
      neighbours_(solids.size() * 6, no_index),
      cover_(solids.size() * 6, not_asked),
      stamp_(solids.size(), 0) {
  listed_.reserve(solids.size() * 6);
  for (std::uint32_t e = 0; e < solids.size(); ++e) {
    if (!complete(solids, e)) continue;
    const bool hides = is_neighbour(solids.shape[e]);
    for (std::uint8_t f = 0; f < 6; ++f) {
      const Face face = solid_face(solids.of(e), f);
      if (face.corners == 0) continue;
      const LeastCorner corner(face);
      listed_.push_back({e, corner.node, corner.next, corner.last, f,
                         static_cast<std::uint8_t>(face.corners), hides});
    }
  }
  sort_by_bucket(
      listed_, [](const ListedFace& f) { return f.least; },
      [](const ListedFace& a, const ListedFace& b) { return a.last < b.last; });
  for (auto first = listed_.begin(), end = first; first != listed_.end(); first = end) {
    while (end != listed_.end() && end->least == first->least) ++end;
    for (auto f = first; f != end; ++f) {
      const auto at = std::lower_bound(first, end, f->next,
                                       [](const ListedFace& o, NodeIndex n) { return o.last < n; });
      neighbours_[f->solid * std::size_t{6} + f->face] =
          neighbour(f->solid, solid_face(solids.of(f->solid), f->face),
                    static_cast<std::uint32_t>(at - listed_.begin()));
    }
  }
}

std::uint32_t SolidFaces::neighbour(std::uint32_t e, const Face& face, std::uint32_t i) const {
  const LeastCorner corner(face);
  for (; i < listed_.size(); ++i) {
    const ListedFace& o = listed_[i];
    if (o.least != corner.node || o.last != corner.next) break;
    if (o.hides && o.solid != e && o.corners == face.corners &&
        contains_all(solids_->of(o.solid), 8, face.nodes))
      return i;
  }
  return no_index;
}

bool SolidFaces::interior(std::uint32_t e, int f, bool against_all) const {
  std::uint32_t i = neighbours_[e * std::size_t{6} + static_cast<std::size_t>(f)];
  while (i != no_index && !against_all && stamp_[listed_[i].solid] != generation_)
    i = neighbour(e, solid_face(solids_->of(e), f), i + 1);
  return i != no_index;
}

bool SolidFaces::covered(const FaceQuery& query, std::uint32_t solid, int f, const Face& face) {
  // Faces of 10-node tetrahedra are not compared with shells.
  if (solids_->shape[solid] == SolidShape::tetra10) return false;
  std::uint32_t& number = cover_[solid * std::size_t{6} + static_cast<std::size_t>(f)];
  if (number == not_asked) number = query.cover->on(face);
  if (number == no_index) return false;
  const CoverShell shell = query.cover->shell(number);
  if (!query.by_part_place) return query.cover->selected(shell);
  const std::uint32_t place = query.cover->part_of(shell);
  if (place >= stamp_.size() || stamp_[place] != generation_) return false;
  if (query.lost != nullptr) query.lost->push_back({solid, shell});
  return true;
}

void SolidFaces::add_segments(const FaceQuery& query, std::vector<Segment>& out) {
  const auto& members = *query.solids;
  ++generation_;
  for (const std::uint32_t e : members) stamp_[e] = generation_;
  for (const std::uint32_t e : members) {
    if (!complete(*solids_, e)) continue;
    const bool all = !query.exterior_only || (query.all_faces_of != nullptr &&
                                              std::binary_search(query.all_faces_of->begin(),
                                                                 query.all_faces_of->end(), e));
    for (int f = 0; f < 6; ++f) {
      if (!all && interior(e, f, query.against_all)) continue;
      const Face face = solid_face(solids_->of(e), f);
      if (face.corners == 0) continue;
      if (query.cover != nullptr && covered(query, e, f, face)) continue;
      append_face(*solids_, e, f, face, out);
    }
  }
}

std::array<NodeIndex, 3> tetra10_mids(const Elements& solids, std::size_t e, int face) {
  std::array<NodeIndex, 3> mids{no_index, no_index, no_index};
  const std::uint32_t first = solids.extra[e];
  if (first == no_index) return mids;
  for (std::size_t i = 0; i < 3; ++i) {
    const int k = tetra_mids[face][i];
    if (k >= 0) mids[i] = solids.extra_nodes[first + static_cast<std::uint32_t>(k)];
  }
  return mids;
}

int cut_triangle(const std::array<NodeIndex, 3>& c, const std::array<NodeIndex, 3>& m,
                 std::array<std::array<NodeIndex, 4>, 4>& out) {
  const auto triangle = [&](std::size_t at, NodeIndex a, NodeIndex b, NodeIndex d) {
    out[at] = {a, b, d, d};
  };
  const int present = (m[0] != no_index) + (m[1] != no_index) + (m[2] != no_index);
  if (present == 3) {
    triangle(0, c[0], m[0], m[2]);
    triangle(1, c[1], m[1], m[0]);
    triangle(2, c[2], m[2], m[1]);
    triangle(3, m[0], m[1], m[2]);
    return 4;
  }
  if (present == 0) {
    triangle(0, c[0], c[1], c[2]);
    return 1;
  }
  // One or two: the first one splits the triangle.
  std::size_t k = 0;
  while (m[k] == no_index) ++k;
  triangle(0, c[k], m[k], c[(k + 2) % 3]);
  triangle(1, m[k], c[(k + 1) % 3], c[(k + 2) % 3]);
  return 2;
}

}  // namespace deck::detail
