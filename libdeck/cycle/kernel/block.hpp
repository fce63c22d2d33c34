// Shared by the stages of one evaluation: constants, scratch memory of a block of pairs between
// geometry and force, the table of compiled kernels, vectors for stages that work pair by pair.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/shared/vec.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle::detail {

inline constexpr std::size_t block_pairs = 64;  ///< a multiple of every pack width

struct Constants;  // effects.hpp

/// Geometry of a block: one slot per pair.
struct alignas(64) GeometryBlock {
  double penetration[block_pairs];
  double distance[block_pairs];
  double keep[block_pairs];  ///< 1 when the pair is within reach, else 0
  double normal[3][block_pairs];
  double raw[4][block_pairs];     ///< weights for velocities
  double weight[4][block_pairs];  ///< weights for forces
};

/// Slot s of the block from pair `begin` is pair min(begin + s, last full pack): the last pack
/// steps back instead of reading past the end.
using GeometryFn = void (*)(const Constants&, const PacketView&, std::size_t begin, std::size_t n,
                            GeometryBlock&);
using ForceFn = void (*)(const Constants&, EffectSet, const PacketView&, std::size_t begin,
                         std::size_t n, const GeometryBlock&, PacketResult&);

struct KernelTable {
  EffectSet effects = 0;
  bool composed = false;
  int width = 0;
  GeometryFn geometry = nullptr;            ///< any mix of triangles and quadrangles
  GeometryFn geometry_triangles = nullptr;  ///< triangles only; null for edges
  ForceFn force = nullptr;
};

/// First pair of the pack with slot `slot`.
template <int W>
constexpr std::size_t pack_start(std::size_t begin, std::size_t slot, std::size_t size) {
  const std::size_t i = begin + slot;
  return i + W <= size ? i : size - W;
}

/// Tables of one instruction set; null if it was not compiled.
const KernelTable* find_baseline(ContactKind kind, Model model, EffectSet effects, bool generic);
const KernelTable* find_avx2(ContactKind kind, Model model, EffectSet effects, bool generic);
const KernelTable* find_avx512(ContactKind kind, Model model, EffectSet effects, bool generic);

Constants make_constants(const KernelPlan& plan, const PacketView& view);

using deck::Vec;

inline Vec at(const std::array<const double*, 3>& p, std::size_t i) {
  return {p[0][i], p[1][i], p[2][i]};
}
template <class View>
std::array<Vec, 4> corners(const View& view, std::size_t i) {
  return {at(view.position[1], i), at(view.position[2], i), at(view.position[3], i),
          at(view.position[4], i)};
}

/// Frame of ties: first diagonal, its perpendicular in the surface, normal.
struct Frame {
  Vec t1, t2, n;
  Frame(const std::array<Vec, 4>& corner) {
    t1 = unit(corner[2] - corner[0]);
    n = unit(cross(t1, corner[3] - corner[1]));
    t2 = cross(n, t1);
  }
  [[nodiscard]] Vec along(double fn, double f1, double f2) const {
    return fn * n + (f1 * t1 + f2 * t2);
  }
};

/// Axes of a segment for directed friction: mean directions of opposite sides (triangle: its first
/// side and the side from corner 1 to 3), turned symmetrically until orthogonal.
struct SegmentAxes {
  Vec first, second, normal;
  SegmentAxes(const Vec& x1, const Vec& x2, const Vec& x3, const Vec& x4, bool triangle) {
    const Vec a = triangle ? x2 - x1 : (x2 + x3) - (x1 + x4);
    const Vec b = triangle ? x3 - x1 : (x3 + x4) - (x1 + x2);
    normal = unit(cross(a, b));
    const double ratio = norm(b) > 0.0 ? norm(a) / norm(b) : 0.0;
    first = unit(a + ratio * cross(b, normal));
    second = cross(normal, first);
  }
};

// Scalar stages, for effects that are too rare for a composition of their own.
void apply_curvature(const KernelPlan& plan, const PacketView& view, std::size_t begin,
                     std::size_t n, int width, GeometryBlock& block);
/// Sets status_kept from the block, after its force is done.
void mark_kept(const PacketView& view, std::size_t begin, std::size_t n, int width,
               const GeometryBlock& block, PacketResult& out);
void force_tied_block(const KernelPlan& plan, const PacketView& view, std::size_t begin,
                      std::size_t n, int width, const GeometryBlock& block, PacketResult& out);
/// Account of a plan: per effect a decision and the field that causes it.
using Account = std::vector<EffectState>;

/// An effect that runs behind the pair loop, on evaluated pairs [begin, end).
struct LateEffect {
  bool (*called_for)(const ContactCard& card);
  Field needs, writes;
  void (*apply)(const KernelPlan& plan, const PacketView& view, std::size_t begin, std::size_t end,
                PacketResult& out);
};
/// In the order in which they act.
std::span<const LateEffect> late_effects();

void apply_step_deletion(const KernelPlan& plan, const PacketView& view, std::size_t begin,
                         std::size_t end, PacketResult& out);
void apply_time_step_tie(const KernelPlan& plan, const PacketView& view, std::size_t begin,
                         std::size_t end, PacketResult& out);
void apply_heat(const KernelPlan& plan, const PacketView& view, std::size_t begin, std::size_t end,
                PacketResult& out);
void apply_edge_heat(const KernelPlan& plan, const PacketView& view, std::size_t begin,
                     std::size_t end, PacketResult& out);
void apply_criteria(const KernelPlan& plan, const PacketView& view, std::size_t begin,
                    std::size_t end, PacketResult& out);

/// Upper bound of the distance between the bicubic surface of pair i and its facet, added to the
/// gap for weights and search. 0 for triangles, which stay flat.
double bicubic_allowance(const PacketView& view, std::size_t i);
/// Extra distance beyond the gap up to which a pair is kept. Icurv 1, 2: half the largest extent of
/// its segment.
double curvature_allowance(const ContactCard& card, const PacketView& view, std::size_t i);

}  // namespace deck::cycle::detail
