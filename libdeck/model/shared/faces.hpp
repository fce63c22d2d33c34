// Faces of solids: the six faces of the eight slots, exterior faces, faces under shells, cutting of
// faces of 10-node tetrahedra.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "deck/model.hpp"
#include "model/shared/families.hpp"

namespace deck::detail {

/// True if one of the nodes is `n`; compares four at once.
inline bool any_is(const NodeIndex* nodes, int count, NodeIndex n) {
  typedef NodeIndex Four __attribute__((vector_size(16)));
  typedef std::int32_t Mask __attribute__((vector_size(16)));
  Mask found{};
  int i = 0;
  for (; i + 4 <= count; i += 4) {
    Four some;
    __builtin_memcpy(&some, nodes + i, sizeof some);
    found |= some == n;
  }
  std::array<std::uint64_t, 2> halves{};
  __builtin_memcpy(halves.data(), &found, sizeof found);
  bool out = (halves[0] | halves[1]) != 0;
  for (; i < count; ++i) out |= nodes[i] == n;
  return out;
}

/// True if an element has all nodes of a segment. Most candidates have the first but lack the
/// opposite: tests backwards.
inline bool contains_all(const NodeIndex* nodes, int count,
                         const std::array<NodeIndex, 4>& segment) {
  return std::all_of(segment.rbegin(), segment.rend(),
                     [&](NodeIndex n) { return any_is(nodes, count, n); });
}

/// A face with 3 or 4 distinct nodes in outward order.
struct Face {
  std::array<NodeIndex, 4> nodes{};  ///< triangles repeat the third node
  int corners = 0;                   ///< 3 or 4; 0: degenerate
};
/// Face 0..5 of the eight stored slots.
Face solid_face(const NodeIndex* slots, int face);

/// True if a face has four distinct nodes, equal to those of the segment in any order.
bool has_face_of(const NodeIndex* slots, const std::array<NodeIndex, 4>& segment);

/// A node set as a key: sorted, padded with no_index.
struct NodeKey {
  std::array<NodeIndex, 4> nodes{no_index, no_index, no_index, no_index};
  friend bool operator==(const NodeKey& a, const NodeKey& b) {
    return ((a.nodes[0] ^ b.nodes[0]) | (a.nodes[1] ^ b.nodes[1]) | (a.nodes[2] ^ b.nodes[2]) |
            (a.nodes[3] ^ b.nodes[3])) == 0;
  }
};
/// Distinct nodes of a segment or face.
NodeKey node_key(const NodeIndex* nodes, int count);

/// Number of a list for nodes in any order. Neighbours in a mesh mostly get near numbers: their
/// smallest nodes are near, and the differences to it are often equal.
inline std::size_t list_of(const NodeIndex* nodes, int count, std::size_t lists) {
  const NodeIndex least = *std::min_element(nodes, nodes + count);
  std::uint64_t mixed = 0;
  for (int i = 0; i < count; ++i) mixed += std::uint64_t{nodes[i] - least} * (nodes[i] - least);
  return (least + mixed * 0x9e3779b97f4a7c15U) % lists;
}

/// Numbers of node keys: 0, 1, 2 … in order of insertion.
class KeyTable {
 public:
  explicit KeyTable(std::size_t expected) { numbers_.reserve(expected); }
  /// Number of `key`; assigns one if it is new.
  std::uint32_t insert(const NodeKey& key) {
    return numbers_.emplace(key, static_cast<std::uint32_t>(size())).first->second;
  }
  std::uint32_t find(const NodeKey& key) const {  ///< no_index if absent
    const auto it = numbers_.find(key);
    return it == numbers_.end() ? no_index : it->second;
  }
  std::size_t size() const { return numbers_.size(); }

 private:
  struct Hash {
    std::size_t operator()(const NodeKey& key) const {
      return list_of(key.nodes.data(), 3, std::numeric_limits<std::size_t>::max());
    }
  };
  std::unordered_map<NodeKey, std::uint32_t, Hash> numbers_;
};

/// A shell, and which of the two kinds.
struct CoverShell {
  bool four = false;
  std::uint32_t element = no_index;
};

/// Shells on faces of solids. A selected shell replaces the face under it (4-node shells: four
/// nodes; 3-node shells: triangles). Of several shells with equal nodes one decides: the first in
/// the element list of the face's first node (elements with it as first node, then as second, ...).
/// If that one is not selected the face stays.
class ShellCover {
 public:
  ShellCover(const Elements& shell4, const Elements& shell3);
  /// Replaces the previous selection.
  void select(const std::vector<std::uint32_t>& shells4, const std::vector<std::uint32_t>& shells3);
  bool selected(const CoverShell& shell) const;
  /// Number of the shell that decides about a face; no_index: none.
  std::uint32_t on(const Face& face) const;
  CoverShell shell(std::uint32_t number) const;
  std::uint32_t part_of(const CoverShell& shell) const {
    return (shell.four ? shell4_ : shell3_)->part[shell.element];
  }

 private:
  struct ShellEntry {
    bool four;
    std::uint32_t element;
    std::uint32_t next;  ///< entry of the same list
  };
  void add(const Elements& shells, bool four);
  const Elements* shell4_;
  const Elements* shell3_;
  std::vector<std::uint32_t> first_;  ///< per list: its last entry
  std::vector<ShellEntry> entries_;
  std::vector<std::uint32_t> stamp4_, stamp3_;
  std::uint32_t generation_ = 0;
};

/// A face that is left out without a shell in its place.
struct LostFace {
  std::uint32_t solid;
  CoverShell shell;
};

/// Selection of faces of a group of solids.
struct FaceQuery {
  const std::vector<std::uint32_t>* solids = nullptr;  ///< indices, ascending
  bool against_all = false;  ///< every solid of the model is a neighbour, not only the group
  bool exterior_only = true;
  /// Solids (ascending) with all faces even if exterior_only is set; may be nullptr.
  const std::vector<std::uint32_t>* all_faces_of = nullptr;
  /// Shells that replace faces, the same ones in every query; may be nullptr.
  const ShellCover* cover = nullptr;
  /// /SURF/GRBRIC: whether a shell replaces a face depends only on its part: if the part is number
  /// k, the face is left out if solid number k of the model is a member (solver behaviour).
  bool by_part_place = false;
  std::vector<LostFace>* lost = nullptr;  ///< receives the faces left out by by_part_place
};

/// The first neighbours at all faces of all solids, found once. A face is interior if a neighbour
/// solid has all its nodes and a face of equal size with the same smallest node, before which, in
/// its own sense, the second node of this face stands. Other nodes are not compared. For properly
/// shared faces this is the same face in the opposite sense; for overlapping solids it decides as
/// the solver does, not always symmetrically.
class SolidFaces {
 public:
  explicit SolidFaces(const Elements& solids);
  /// Adds the segments of the faces, by solid, then face. Solids with missing nodes have none;
  /// faces of 10-node tetrahedra are cut.
  void add_segments(const FaceQuery& query, std::vector<Segment>& out);

 private:
  struct ListedFace {
    std::uint32_t solid;
    NodeIndex least, next, last;  ///< smallest node, and those after and before it
    std::uint8_t face, corners;
    bool hides;  ///< can make faces of others interior
  };
  /// The first face of a neighbour at a face of solid `e`, from listed face `i` on; no_index: none.
  std::uint32_t neighbour(std::uint32_t e, const Face& face, std::uint32_t i) const;
  bool interior(std::uint32_t e, int f, bool against_all) const;
  bool covered(const FaceQuery& query, std::uint32_t solid, int f, const Face& face);
  static constexpr std::uint32_t not_asked = no_index - 1;
  const Elements* solids_;
  std::vector<ListedFace> listed_;         ///< by smallest node, then by that before it
  std::vector<std::uint32_t> neighbours_;  ///< per solid and face: first listed one of a neighbour
  std::vector<std::uint32_t> cover_;       ///< per solid and face: number of its shell
  std::vector<std::uint32_t> stamp_;       ///< per solid: last generation in which it was a member
  std::uint32_t generation_ = 0;
};

/// Cuts a triangle with mid-side nodes (no_index: missing; mids[0] between corners 0 and 1): four
/// pieces with all three; else two at the first one. Returns the number of pieces in `out`.
int cut_triangle(const std::array<NodeIndex, 3>& corners, const std::array<NodeIndex, 3>& mids,
                 std::array<std::array<NodeIndex, 4>, 4>& out);
/// Mid-side nodes of a face of 10-node tetrahedron `e`, in the order of its corners.
std::array<NodeIndex, 3> tetra10_mids(const Elements& solids, std::size_t e, int face);

}  // namespace deck::detail
