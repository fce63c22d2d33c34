// Sorts bulk items into the solver's order (file, then id); reverses solids of negative volume.
#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/shared/vec.hpp"
#include "model/bulk/bulk.hpp"
#include "model/shared/families.hpp"

namespace deck::detail {
namespace {

/// One range per file for the ranges of its blocks.
std::vector<BulkBlock> ranges_of_files(std::span<const BulkBlock> blocks) {
  std::vector<BulkBlock> out;
  for (const BulkBlock& b : blocks)
    if (!out.empty() && out.back().block->header_span.file == b.block->header_span.file)
      out.back().count = b.first + b.count - out.back().first;
    else
      out.push_back(b);
  return out;
}

/// The solver's order: each range sorted by id. Returns positions in `ids`; empty: already sorted.
std::vector<std::uint32_t> order_by_id(const std::vector<std::int64_t>& ids,
                                       const std::vector<BulkBlock>& ranges) {
  std::vector<std::uint32_t> out;
  for (const BulkBlock& b : ranges) {
    const auto at = [&](auto& list) { return list.begin() + static_cast<std::ptrdiff_t>(b.first); };
    if (std::is_sorted(at(ids), at(ids) + b.count)) continue;
    if (out.empty()) {
      out.resize(ids.size());
      std::iota(out.begin(), out.end(), 0U);
    }
    std::stable_sort(at(out), at(out) + b.count,
                     [&](std::uint32_t i, std::uint32_t k) { return ids[i] < ids[k]; });
  }
  return out;
}

/// Permutes arrays with `width` values per item; empty ones stay empty.
template <class... T>
void put_in_order(const std::vector<std::uint32_t>& places, std::size_t width,
                  std::vector<T>&... arrays) {
  const auto put = [&](auto& array) {
    if (array.empty() || places.empty()) return;
    const auto read = array;
    auto to = array.begin();
    for (const std::uint32_t place : places)
      to = std::copy_n(read.begin() + static_cast<std::ptrdiff_t>(place * width), width, to);
  };
  (put(arrays), ...);
}

/// Splits a sorted block into runs of consecutive items.
void add_runs(const BulkBlock& block, const std::vector<std::uint32_t>& places,
              std::vector<std::uint32_t>& items, std::vector<BulkBlock>& out) {
  if (items.empty()) {
    items.resize(places.size());
    for (std::uint32_t i = 0; i < places.size(); ++i) items[places[i]] = i;
  }
  out.push_back({block.block, items.empty() ? block.first : items[block.first], 0});
  for (std::uint32_t i = block.first; i < block.first + block.count; ++i) {
    const std::uint32_t item = items.empty() ? i : items[i];
    if (item != out.back().first + out.back().count) out.push_back({block.block, item, 0});
    ++out.back().count;
  }
}

/// Jacobian determinant at the centre of eight slots, except for a positive factor.
double centre_jacobian(const Nodes& nodes, const NodeIndex* n) {
  constexpr int sign[3][8] = {
      {-1, 1, 1, -1, -1, 1, 1, -1}, {-1, -1, 1, 1, -1, -1, 1, 1}, {-1, -1, -1, -1, 1, 1, 1, 1}};
  Vec axis[3];
  // Coordinates relative to the first node, to keep digits far from the origin.
  for (int slot = 0; slot < 8; ++slot) {
    const Vec at{nodes.x[n[slot]] - nodes.x[n[0]], nodes.y[n[slot]] - nodes.y[n[0]],
                 nodes.z[n[slot]] - nodes.z[n[0]]};
    for (int k = 0; k < 3; ++k) axis[k] = axis[k] + sign[k][slot] * at;
  }
  return dot(axis[0], cross(axis[1], axis[2]));
}

void turn(SolidShape shape, NodeIndex* n, NodeIndex* mid) {
  switch (shape) {
    case SolidShape::tetra10:
      // Mid-side nodes are on 1-2, 2-3, 3-1, 1-4, 2-4, 3-4.
      std::swap(mid[0], mid[3]);
      std::swap(mid[1], mid[5]);
      [[fallthrough]];
    case SolidShape::tetra4: {
      // The slots are 1 1 2 2 4 3 3 4.
      const NodeIndex second = n[2], fourth = n[4];
      n[2] = n[3] = fourth;
      n[4] = n[7] = second;
      break;
    }
    case SolidShape::penta6:  // never reversed
      break;
    case SolidShape::brick8:
    case SolidShape::brick20:
    case SolidShape::thick16:
      std::swap_ranges(n, n + 4, n + 4);
      break;
  }
}

}  // namespace

void put_nodes_in_order(Nodes& nodes, std::vector<BulkBlock>& ranges) {
  const std::vector<std::uint32_t> places = order_by_id(nodes.id, ranges_of_files(ranges));
  if (places.empty()) return;
  put_in_order(places, 1, nodes.id, nodes.x, nodes.y, nodes.z);
  std::vector<std::uint32_t> items;
  std::vector<BulkBlock> runs;
  for (const BulkBlock& b : ranges) add_runs(b, places, items, runs);
  ranges = std::move(runs);
  nodes.map.build(nodes.id);
}

void put_elements_in_order(Model& model) {
  std::array<std::vector<std::uint32_t>, std::size(all_families)> places, items;
  const auto kind_of = [](const BulkBlock& b) { return element_format(*b.block)->kind; };
  for (const ElementKind kind : all_families) {
    Elements& family = family_of(model, kind);
    std::vector<BulkBlock> blocks;
    std::copy_if(model.element_blocks.begin(), model.element_blocks.end(),
                 std::back_inserter(blocks),
                 [&](const BulkBlock& b) { return kind_of(b) == kind; });
    std::vector<std::uint32_t>& order = places[static_cast<std::size_t>(kind)];
    order = order_by_id(family.id, blocks);
    put_in_order(order, 1, family.id, family.thickness, family.shape, family.extra);
    put_in_order(order, static_cast<std::size_t>(family.width), family.nodes);
  }
  if (std::all_of(places.begin(), places.end(), [](const auto& p) { return p.empty(); })) return;
  std::vector<BulkBlock> runs;
  for (const BulkBlock& b : model.element_blocks) {
    const auto kind = static_cast<std::size_t>(kind_of(b));
    std::size_t r = runs.size();
    add_runs(b, places[kind], items[kind], runs);
    for (; r < runs.size(); ++r)
      std::fill_n(
          family_of(model, kind_of(b)).block.begin() + static_cast<std::ptrdiff_t>(runs[r].first),
          runs[r].count, static_cast<std::uint32_t>(r));
  }
  model.element_blocks = std::move(runs);
  for (const ElementKind kind : all_families)
    if (!places[static_cast<std::size_t>(kind)].empty())
      family_of(model, kind).map.build(family_of(model, kind).id);
}

std::size_t orient_solids(Model& model) {
  Elements& solids = model.solid8;
  std::size_t turned = 0;
  for (std::size_t e = 0; e < solids.size(); ++e) {
    NodeIndex* const n = solids.nodes.data() + 8 * e;
    // The solver keeps the faces of a penta as on its card; contacts turn them outward later.
    if (solids.shape[e] == SolidShape::penta6) continue;
    if (std::find(n, n + 8, no_index) != n + 8 || !(centre_jacobian(model.nodes, n) < 0)) continue;
    NodeIndex* const mid =
        solids.extra[e] == no_index ? nullptr : solids.extra_nodes.data() + solids.extra[e];
    turn(solids.shape[e], n, mid);
    ++turned;
  }
  return turned;
}

}  // namespace deck::detail
