// Exterior faces by hashing. Input: solids in eight slots; output: faces that no other solid
// shares, in the solver's order.
//
// Notation: a face a b c d starts at its smallest node a, in outward order. It has two keys: (a,
// d), which it offers to other solids, and (a, b), which would end it: a neighbour has the shared
// face in the opposite sense a d c b, so it offers (a, b). A face is interior if another solid
// offers its end key and has all its nodes. Cost: O(faces) expected.
#include "model/shared/faces.hpp"

#include <algorithm>
#include <utility>

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
  Face out;
  std::size_t n = 0;
  for (const int s : face_slots[face]) {
    const NodeIndex node = slots[s];
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

KeyTable::KeyTable(std::size_t expected) {
  std::size_t size = 16;
  while (size < expected * 2) size *= 2;
  slots_.assign(size, {});
  keys_.reserve(expected);
}

std::uint64_t KeyTable::hash(const NodeKey& key) {
  const std::uint64_t a = (std::uint64_t{key.nodes[0]} << 32) | key.nodes[1];
  const std::uint64_t b = (std::uint64_t{key.nodes[2]} << 32) | key.nodes[3];
  std::uint64_t h = a * 0x9e3779b97f4a7c15u;
  h ^= h >> 29;
  h = (h + b) * 0xbf58476d1ce4e5b9u;
  return h ^ (h >> 32);
}

std::size_t KeyTable::slot(const NodeKey& key, std::uint64_t h) const {
  const std::size_t mask = slots_.size() - 1;
  const auto tag = static_cast<std::uint32_t>(h >> 32);
  std::size_t at = static_cast<std::size_t>(h) & mask;
  while (slots_[at].index != no_index && !(slots_[at].tag == tag && keys_[slots_[at].index] == key))
    at = (at + 1) & mask;
  return at;
}

void KeyTable::grow() {
  slots_.assign(slots_.size() * 2, {});
  for (std::uint32_t i = 0; i < keys_.size(); ++i) {
    const std::uint64_t h = hash(keys_[i]);
    slots_[slot(keys_[i], h)] = {i, static_cast<std::uint32_t>(h >> 32)};
  }
}

std::uint32_t KeyTable::insert(const NodeKey& key) {
  if ((keys_.size() + 1) * 2 > slots_.size()) grow();
  const std::uint64_t h = hash(key);
  const std::size_t at = slot(key, h);
  if (slots_[at].index == no_index) {
    slots_[at] = {static_cast<std::uint32_t>(keys_.size()), static_cast<std::uint32_t>(h >> 32)};
    keys_.push_back(key);
  }
  return slots_[at].index;
}

std::uint32_t KeyTable::find(const NodeKey& key) const {
  return slots_[slot(key, hash(key))].index;
}

ShellCover::ShellCover(const Elements& shell4, const Elements& shell3)
    : shell4_(&shell4),
      shell3_(&shell3),
      table_(shell4.size() + shell3.size()),
      stamp4_(shell4.size(), 0),
      stamp3_(shell3.size(), 0) {
  entries_.reserve(shell4.size() + shell3.size());
  add(shell4, true);
  add(shell3, false);
}

void ShellCover::add(const Elements& shells, bool four) {
  for (std::uint32_t e = 0; e < shells.size(); ++e) {
    const std::uint32_t key = table_.insert(node_key(shells.of(e), shells.width));
    if (key == first_.size()) first_.push_back(no_index);
    entries_.push_back({four, e, first_[key]});
    first_[key] = static_cast<std::uint32_t>(entries_.size()) - 1;
    for (const NodeIndex* n = shells.of(e); n < shells.of(e) + shells.width; ++n) {
      if (*n == no_index) continue;
      if (*n >= has_shell_.size()) has_shell_.resize(*n + std::size_t{1});
      has_shell_[*n] = true;
    }
  }
}

void ShellCover::select(const std::vector<std::uint32_t>& shells4,
                        const std::vector<std::uint32_t>& shells3) {
  ++generation_;
  for (const std::uint32_t e : shells4) stamp4_[e] = generation_;
  for (const std::uint32_t e : shells3) stamp3_[e] = generation_;
}

bool ShellCover::hides(const Face& face) const {
  const CoverShell shell = on(face);
  return shell.element != no_index &&
         (shell.four ? stamp4_ : stamp3_)[shell.element] == generation_;
}

CoverShell ShellCover::on(const Face& face) const {
  for (int i = 0; i < face.corners; ++i) {
    const NodeIndex n = face.nodes[static_cast<std::size_t>(i)];
    if (n >= has_shell_.size() || !has_shell_[n]) return {};
  }
  const std::uint32_t key = table_.find(node_key(face.nodes.data(), face.corners));
  if (key == no_index) return {};
  const bool four = face.corners == 4;
  const ShellEntry* best = nullptr;
  std::pair<std::ptrdiff_t, std::uint32_t> best_place;
  for (std::uint32_t i = first_[key]; i != no_index; i = entries_[i].next) {
    const ShellEntry& entry = entries_[i];
    if (entry.four != four) continue;
    const Elements& shells = four ? *shell4_ : *shell3_;
    const NodeIndex* n = shells.of(entry.element);
    const std::pair place(std::find(n, n + shells.width, face.nodes[0]) - n, entry.element);
    if (best == nullptr || place < best_place) {
      best = &entry;
      best_place = place;
    }
  }
  return best != nullptr ? CoverShell{four, best->element} : CoverShell{};
}

SolidFaces::SolidFaces(const Elements& solids)
    : solids_(&solids), ends_(solids.size() * 6, no_index), stamp_(solids.size(), 0) {
  KeyTable table(solids.size() * 6);
  owners_.reserve(solids.size() * 6);
  for (std::uint32_t e = 0; e < solids.size(); ++e) {
    if (!complete(solids, e)) continue;
    for (std::uint32_t f = 0; f < 6; ++f) {
      const Face face = solid_face(solids.of(e), static_cast<int>(f));
      if (face.corners == 0) continue;
      const auto n = static_cast<std::size_t>(face.corners);
      std::size_t least = 0;
      for (std::size_t i = 1; i < n; ++i)
        if (face.nodes[i] < face.nodes[least]) least = i;
      const auto key = [&](std::size_t other) {
        const std::uint32_t k = table.insert(
            {{face.nodes[least], face.nodes[(least + other) % n], static_cast<NodeIndex>(n)}});
        if (k == first_.size()) first_.push_back(no_index);
        return k;
      };
      ends_[e * std::size_t{6} + f] = key(1);
      if (!is_neighbour(solids.shape[e])) continue;
      const std::uint32_t offered = key(n - 1);
      owners_.push_back({e, first_[offered]});
      first_[offered] = static_cast<std::uint32_t>(owners_.size()) - 1;
    }
  }
}

bool SolidFaces::interior(std::uint32_t solid, int f, bool against_all) const {
  const NodeIndex* const mine = solids_->of(solid);
  const auto has = [&](std::uint32_t other) {
    const NodeIndex* const slots = solids_->of(other);
    return std::all_of(std::begin(face_slots[f]), std::end(face_slots[f]),
                       [&](std::uint8_t s) { return any_is(slots, 8, mine[s]); });
  };
  const std::size_t at = solid * std::size_t{6} + static_cast<std::size_t>(f);
  for (std::uint32_t i = first_[ends_[at]]; i != no_index; i = owners_[i].next) {
    const std::uint32_t other = owners_[i].solid;
    if (other != solid && counts(other, against_all) && has(other)) return true;
  }
  return false;
}

bool SolidFaces::covered(const FaceQuery& query, std::uint32_t solid, const Face& face) const {
  // Faces of 10-node tetrahedra are not compared with shells.
  if (solids_->shape[solid] == SolidShape::tetra10) return false;
  if (!query.by_part_place) return query.cover->hides(face);
  const CoverShell shell = query.cover->on(face);
  if (shell.element == no_index) return false;
  const std::uint32_t place = query.cover->part_of(shell);
  if (place >= stamp_.size() || stamp_[place] != generation_) return false;
  if (query.lost != nullptr) query.lost->push_back({solid, shell});
  return true;
}

std::vector<Segment> SolidFaces::segments(const FaceQuery& query) {
  std::vector<Segment> out;
  const auto& members = *query.solids;
  ++generation_;
  for (const std::uint32_t e : members) stamp_[e] = generation_;
  for (const std::uint32_t e : members) {
    const bool all = !query.exterior_only || (query.all_faces_of != nullptr &&
                                              std::binary_search(query.all_faces_of->begin(),
                                                                 query.all_faces_of->end(), e));
    for (int f = 0; f < 6; ++f) {
      if (ends_[e * std::size_t{6} + static_cast<std::size_t>(f)] == no_index) continue;
      if (!all && interior(e, f, query.against_all)) continue;
      const Face face = solid_face(solids_->of(e), f);
      if (query.cover != nullptr && covered(query, e, face)) continue;
      append_face(*solids_, e, f, face, out);
    }
  }
  return out;
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
