// Reads blocks of nodes and elements in parallel. The blocks are cut into chunks at fixed places,
// so results do not depend on threads. Threads read chunks (bulk_read.hpp); one thread at a time
// appends them to the arrays in deck order and forms the messages. Cost: O(bytes).
#include "model/bulk/bulk.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/shared/pages.hpp"
#include "base/shared/parallel.hpp"
#include "deck/text.hpp"
#include "keyword/shared/solver_order.hpp"
#include "model/bulk/bulk_read.hpp"
#include "model/shared/families.hpp"

namespace deck::detail {
namespace {

// Text and values of a chunk fit the second-level cache.
constexpr std::uint64_t chunk_bytes = 256 * 1024;

struct Keyword {
  std::string_view name;
  ElementFormat format;
};
constexpr Keyword element_keywords[] = {
    {"/SHELL", {ElementKind::shell4, SolidShape::brick8, 4}},
    {"/SH3N", {ElementKind::shell3, SolidShape::brick8, 3}},
    {"/BRICK", {ElementKind::solid8, SolidShape::brick8, 8}},
    {"/TETRA4", {ElementKind::solid8, SolidShape::tetra4, 4}},
    {"/PENTA6", {ElementKind::solid8, SolidShape::penta6, 6}},
    {"/TETRA10", {ElementKind::solid8, SolidShape::tetra10, 4}},
    {"/BRIC20", {ElementKind::solid8, SolidShape::brick20, 8}},
    {"/SHEL16", {ElementKind::solid8, SolidShape::thick16, 8}},
    {"/QUAD", {ElementKind::quad, SolidShape::brick8, 4}},
    {"/TRIA", {ElementKind::tria, SolidShape::brick8, 3}},
    {"/TRUSS", {ElementKind::truss, SolidShape::brick8, 2}},
    {"/BEAM", {ElementKind::beam, SolidShape::brick8, 2}},
    {"/SPRING", {ElementKind::spring, SolidShape::brick8, 2}},
};

bool is_node_block(const Block& block) {
  return block.schema != nullptr &&
         (block.schema->keyword == "/NODE" || block.schema->keyword == "/CNODE");
}

/// The nodes of the card for the eight slots of a stored solid.
const std::array<std::uint8_t, 8>& slots_of(SolidShape shape) {
  static constexpr std::array<std::uint8_t, 8> brick{0, 1, 2, 3, 4, 5, 6, 7};
  static constexpr std::array<std::uint8_t, 8> tetra{0, 0, 1, 1, 3, 2, 2, 3};
  static constexpr std::array<std::uint8_t, 8> penta{0, 1, 2, 0, 3, 4, 5, 3};
  switch (shape) {
    case SolidShape::tetra4:
    case SolidShape::tetra10:
      return tetra;
    case SolidShape::penta6:
      return penta;
    default:
      return brick;
  }
}

/// Forms messages in deck order, as long as their rule is below its limit.
class ProblemReporter {
 public:
  ProblemReporter(const Deck& deck, const std::vector<BlockPlan>& plans, const Nodes* nodes,
                  Findings& findings)
      : deck_(deck), plans_(plans), nodes_(nodes), findings_(findings) {}

  void report(const Chunk& chunk, const std::vector<Problem>& problems) {
    if (problems.empty()) return;
    std::array<bool, bulk_rules> full{};
    std::array<std::uint64_t, bulk_rules> pending{};
    const auto refresh = [&] {
      for (std::size_t r = 0; r < bulk_rules; ++r) full[r] = findings_.saturated(bulk_rule_id(r));
    };
    refresh();
    for (const Problem& problem : problems) {
      bool wanted = problem.decoded;
      for (std::size_t r = 0; r < bulk_rules; ++r)
        wanted = wanted || (problem.counts[r] > 0 && !full[r]);
      if (!wanted) {
        for (std::size_t r = 0; r < bulk_rules; ++r) pending[r] += problem.counts[r];
        continue;
      }
      const TextSegment& segment = chunk.segments[problem.segment];
      report_problem(deck_, plans_[segment.plan], segment.file, problem, nodes_, findings_);
      refresh();
    }
    for (std::size_t r = 0; r < bulk_rules; ++r) findings_.count(bulk_rule_id(r), pending[r]);
  }

 private:
  const Deck& deck_;
  const std::vector<BlockPlan>& plans_;
  const Nodes* nodes_;
  Findings& findings_;
};

/// Estimate of the final size from the chunks read so far. Reserved but unused memory costs only
/// address space; growing by doubling would copy everything, and its page faults take a tenth of
/// the reading time.
struct Room {
  std::uint64_t total = 0, done = 0;
  template <class... Vectors>
  void make(std::uint64_t bytes, std::size_t items, Vectors&... vectors) {
    done += bytes;
    const auto grow = [&](auto& vector) {
      const std::size_t after = vector.size() + items;
      if (after <= vector.capacity()) return;
      const double scale = done == 0 ? 1 : static_cast<double>(total) / static_cast<double>(done);
      vector.reserve(static_cast<std::size_t>(static_cast<double>(after) * scale * 1.03) + 64);
      prefer_large_pages(vector);
    };
    (grow(vectors), ...);
  }
};

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from, std::size_t count) {
  to.insert(to.end(), from.begin(), from.begin() + static_cast<std::ptrdiff_t>(count));
}
template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  append(to, from, from.size());
}

/// Releases the text of a chunk.
void release(const Deck& deck, const Chunk& chunk) {
  for (const TextSegment& s : chunk.segments) deck.sources[s.file].release(s.begin, s.end);
}

/// True while 32-bit indices are sufficient; reports once otherwise.
bool indices_left(std::size_t have, std::size_t more, const Block& block, Findings& findings) {
  if (have + more < no_index) return true;
  findings.report(make_finding(RuleId::DK006, block.header_span,
                               "more than 4294967294 items of one kind; the rest is left out",
                               {.fix = "split the deck"}));
  return false;
}

/// Extends the index ranges of the blocks: `counts[s]` items of each segment follow `base`.
void extend_ranges(const Chunk& chunk, const std::vector<std::uint32_t>& counts, std::size_t base,
                   std::size_t first_range, std::vector<BulkBlock>& ranges) {
  for (std::size_t s = 0; s < chunk.segments.size(); ++s) {
    BulkBlock& range = ranges[first_range + chunk.segments[s].plan];
    if (range.count == 0) range.first = static_cast<std::uint32_t>(base);
    range.count += counts[s];
    base += counts[s];
  }
}

// ---- nodes --------------------------------------------------------------------------------------

/// The nodes of a chunk. During reading the arrays exceed `size`: one check per node, not four.
struct NodeSink {
  std::vector<std::int64_t> id;
  std::vector<double> x, y, z;
  std::size_t size = 0;
  std::vector<std::uint32_t> counts;  ///< per segment
  std::vector<Problem> problems;

  void clear(const Chunk& chunk) {
    size = 0;
    problems.clear();
    counts.assign(chunk.segments.size(), 0);
  }
  void item(const BlockPlan& plan, std::uint32_t segment, BulkItem& item) {
    if (size == id.size()) grow();
    const ItemPlan& where = *plan.item;
    const std::int64_t written = item.integer(where.id);
    if (written <= 0) item.count_bad_id();
    id[size] = written > 0 ? written + plan.id_offset : written;
    x[size] = item.real(where.coordinate[0]) * plan.length;
    y[size] = item.real(where.coordinate[1]) * plan.length;
    z[size] = item.real(where.coordinate[2]) * plan.length;
    ++size;
    ++counts[segment];
  }

 private:
  void grow() {
    const std::size_t room = std::max<std::size_t>(2 * size, 4096);
    id.resize(room);
    x.resize(room);
    y.resize(room);
    z.resize(room);
  }
};

// ---- elements -----------------------------------------------------------------------------------

/// Finds nodes by id; first tries the position for consecutive ids.
class NodeFinder {
 public:
  NodeFinder() = default;
  explicit NodeFinder(const Nodes& nodes)
      : nodes_(&nodes),
        unique_(nodes.map.duplicates().empty() ? nodes.size() : 0),
        first_(nodes.size() > 0 ? nodes.id.front() : 0) {}

  NodeIndex operator()(std::int64_t id) const {
    NodeIndex n = no_index;
    return there(id, n) ? n : nodes_->map.find(id);
  }
  /// Nodes of `count` cells; false: some are at other positions.
  bool row(const std::int64_t* written, std::size_t count, std::int64_t offset,
           NodeIndex* out) const {
    for (std::size_t n = 0; n < count; ++n)
      if (written[n] <= 0 || !there(written[n] + offset, out[n])) return false;
    return true;
  }

 private:
  bool there(std::int64_t id, NodeIndex& n) const {
    const std::uint64_t at = static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(first_);
    n = static_cast<NodeIndex>(at);
    return at < unique_ && nodes_->id[at] == id;
  }

  const Nodes* nodes_ = nullptr;
  std::uint64_t unique_ = 0;  ///< number of nodes, if ids are unique
  std::int64_t first_ = 0;
};

/// The elements of a chunk; part and block are those of their segment. Arrays may exceed `size`.
struct ElementSink {
  std::vector<std::int64_t> id;
  std::vector<std::uint32_t> extra;
  std::vector<NodeIndex> nodes, extra_nodes;
  std::vector<double> thickness;  ///< up to the last element with its own thickness
  std::vector<SolidShape> shape;
  std::size_t size = 0, width = 0;
  std::vector<std::uint32_t> counts;  ///< per segment
  std::vector<bool> thick;            ///< per segment: an element has its own thickness
  std::vector<Problem> problems;
  NodeFinder node;

  void clear(const Chunk& next) {
    size = 0;
    problems.clear();
    width = static_cast<std::size_t>(element_width(next.kind));
    nodes.resize(std::max(nodes.size(), id.size() * width));
    extra.clear();
    extra_nodes.clear();
    thickness.clear();
    shape.clear();
    counts.assign(next.segments.size(), 0);
    thick.assign(next.segments.size(), false);
  }

  void item(const BlockPlan& plan, std::uint32_t segment, BulkItem& item) {
    if (size == id.size()) grow();
    const ItemPlan& where = *plan.item;
    const std::int64_t written = item.integer(where.id);
    if (written <= 0) item.count_bad_id();
    id[size] = written > 0 ? written + plan.id_offset : written;
    ++counts[segment];
    ElementFormat format = plan.format;
    if (format.shape == SolidShape::brick8 && format.kind == ElementKind::solid8)
      format = degenerate_brick(where, item, format);
    item.required = static_cast<std::uint8_t>(format.required);
    NodeIndex* const slots = nodes.data() + size * width;
    if (format.kind == ElementKind::solid8 || where.nodes_in_row != width ||
        !node.row(item.line[0].integer + where.nodes[0].cell, width, plan.node_offset, slots)) {
      find_nodes(plan, format, item);
      if (format.kind == ElementKind::solid8)
        store_solid(format, slots);
      else
        for (std::size_t n = 0; n < width; ++n) slots[n] = found[n];
    }
    if (where.thickness.present &&
        (format.kind == ElementKind::shell4 || format.kind == ElementKind::shell3))
      store_thickness(plan, segment, item);
    ++size;
  }

 private:
  void grow() {
    const std::size_t room = std::max<std::size_t>(2 * size, 4096);
    id.resize(room);
    nodes.resize(room * width);
  }

  /// /BRICK with nodes 5-8 absent is a tetra, with nodes 7-8 absent a penta.
  static ElementFormat degenerate_brick(const ItemPlan& where, const BulkItem& item,
                                        ElementFormat format) {
    const auto absent = [&](std::size_t n) { return item.integer(where.nodes[n]) == 0; };
    if (where.nodes.size() < 8 || !absent(6) || !absent(7)) return format;
    if (absent(4) && absent(5)) return {format.kind, SolidShape::tetra4, 4};
    return {format.kind, SolidShape::penta6, 6};
  }

  void find_nodes(const BlockPlan& plan, const ElementFormat& format, BulkItem& item) {
    const std::vector<CellAt>& cells = plan.item->nodes;
    for (std::size_t n = 0; n < cells.size(); ++n) {
      const CellAt at = cells[n];
      const std::int64_t written = item.integer(at);
      found[n] = no_index;
      if (written == 0 && n >= static_cast<std::size_t>(format.required)) continue;
      found[n] = node(written > 0 ? written + plan.node_offset : written);
      if (found[n] == no_index) item.count(at.card, unknown_node);
    }
    // Entries after them are no_index except for cells of another block.
    for (std::size_t n = cells.size(); n < used; ++n) found[n] = no_index;
    used = cells.size();
  }

  void store_solid(const ElementFormat& format, NodeIndex* slots) {
    for (const std::uint8_t slot : slots_of(format.shape)) *slots++ = found[slot];
    shape.push_back(format.shape);
    const std::size_t corners = format.shape == SolidShape::tetra10 ? 4 : 8;
    const std::size_t all = format.shape == SolidShape::tetra10   ? 10
                            : format.shape == SolidShape::brick20 ? 20
                            : format.shape == SolidShape::thick16 ? 16
                                                                  : 0;
    extra.push_back(all == 0 ? no_index : static_cast<std::uint32_t>(extra_nodes.size()));
    for (std::size_t n = corners; n < all; ++n) extra_nodes.push_back(found[n]);
  }

  void store_thickness(const BlockPlan& plan, std::uint32_t segment, BulkItem& item) {
    if (plan.format.kind == ElementKind::shell3 && sh3n_thickness_left(item.text[0]))
      item.count(0, sh3n_columns);
    const double written = item.real(plan.item->thickness);
    if (written == 0 && !std::signbit(written)) return;
    thickness.resize(size, 0.0);
    thickness.push_back(written * plan.length);
    if (written == 0) return;
    thick[segment] = true;
  }

  std::array<NodeIndex, max_nodes> found = no_nodes();
  std::size_t used = 0;  // entries of `found` used by the previous element
  static std::array<NodeIndex, max_nodes> no_nodes() {
    std::array<NodeIndex, max_nodes> all{};
    all.fill(no_index);
    return all;
  }
};

/// The solver converts an own thickness only in the first shell after a change of units.
void report_thickness(const Block& block, Findings& findings) {
  if (!findings.wants(RuleId::DK039)) return;
  Finding d = make_finding(
      RuleId::DK039, block.header_span,
      std::string(block.header) +
          ": deck converts the thicknesses of elements to working units; the reference "
          "solver does so only for the first element after a change of the unit system");
  d.keyword = std::string(block.keyword);
  d.id = block.id.value;
  findings.add(std::move(d));
}

void append_elements(const Chunk& chunk, const std::vector<BlockPlan>& plans,
                     std::uint32_t first_block, const ElementSink& from, Elements& to, Room& room) {
  const std::size_t have = to.size(), more = from.size;
  room.make(chunk.bytes, more, to.id, to.part, to.block);
  // In slots instead of elements.
  if (to.nodes.size() + more * from.width > to.nodes.capacity()) {
    to.nodes.reserve(to.id.capacity() * from.width);
    prefer_large_pages(to.nodes);
  }
  append(to.id, from.id, more);
  for (std::size_t s = 0; s < chunk.segments.size(); ++s) {
    const std::uint32_t plan = chunk.segments[s].plan;
    to.part.insert(to.part.end(), from.counts[s], plans[plan].part);
    to.block.insert(to.block.end(), from.counts[s], first_block + plan);
  }
  append(to.nodes, from.nodes, more * from.width);
  if (to.kind == ElementKind::solid8) {
    if (have + more > to.shape.capacity()) {
      to.shape.reserve(to.id.capacity());
      to.extra.reserve(to.id.capacity());
    }
    append(to.shape, from.shape);
    const auto base = static_cast<std::uint32_t>(to.extra_nodes.size());
    for (const std::uint32_t e : from.extra) to.extra.push_back(e == no_index ? e : e + base);
    append(to.extra_nodes, from.extra_nodes);
  }
  const bool thick = std::find(from.thick.begin(), from.thick.end(), true) != from.thick.end();
  if (!thick && to.thickness.empty()) return;
  to.thickness.reserve(to.id.capacity());
  to.thickness.resize(have, 0.0);
  append(to.thickness, from.thickness);
  to.thickness.resize(have + more, 0.0);
}

}  // namespace

Elements& family_of(Model& model, ElementKind kind) {
  Elements* const families[] = {&model.shell4, &model.shell3, &model.solid8, &model.quad,
                                &model.tria,   &model.truss,  &model.beam,   &model.spring};
  return *families[static_cast<std::size_t>(kind)];
}

std::vector<const Block*> node_blocks(const Deck& deck) {
  return in_solver_order(deck, [](const Block& b) { return is_node_block(b); });
}

std::vector<const Block*> element_blocks(const Deck& deck) {
  return in_solver_order(deck, [](const Block& b) { return element_format(b).has_value(); });
}

std::optional<ElementFormat> element_format(const Block& block) {
  if (block.schema == nullptr) return std::nullopt;
  for (const Keyword& k : element_keywords)
    if (k.name == block.schema->keyword) return k.format;
  return std::nullopt;
}

int element_width(ElementKind kind) {
  constexpr int widths[] = {4, 3, 8, 4, 3, 2, 3, 6};
  return widths[static_cast<std::size_t>(kind)];
}

void read_nodes(const Deck& deck, const std::vector<const Block*>& blocks, Nodes& nodes,
                std::vector<BulkBlock>& ranges, Findings& findings, int threads) {
  const std::vector<BlockPlan> plans = plan_blocks(deck, blocks);
  const std::vector<Chunk> chunks = cut_chunks(deck, plans, chunk_bytes);
  const std::size_t first_range = ranges.size();
  for (const Block* block : blocks) {
    ranges.push_back({block, static_cast<std::uint32_t>(nodes.size()), 0});
  }
  Room room;
  for (const Chunk& chunk : chunks) room.total += chunk.bytes;
  ProblemReporter reporter(deck, plans, nullptr, findings);
  run_in_order<NodeSink>(
      chunks.size(), threads,
      [&](std::size_t k, NodeSink& out) {
        out.clear(chunks[k]);
        read_chunk(deck, plans, chunks[k], out);
      },
      [&](std::size_t k, NodeSink& rows) {
        reporter.report(chunks[k], rows.problems);
        release(deck, chunks[k]);
        const Block& block = *plans[chunks[k].segments.front().plan].block;
        if (!indices_left(nodes.size(), rows.size, block, findings)) return;
        extend_ranges(chunks[k], rows.counts, nodes.size(), first_range, ranges);
        room.make(chunks[k].bytes, rows.size, nodes.id, nodes.x, nodes.y, nodes.z);
        append(nodes.id, rows.id, rows.size);
        append(nodes.x, rows.x, rows.size);
        append(nodes.y, rows.y, rows.size);
        append(nodes.z, rows.z, rows.size);
      });
  nodes.map.build(nodes.id);
}

void read_elements(const Deck& deck, const std::vector<const Block*>& blocks, Model& model,
                   Findings& findings, int threads) {
  for (const ElementKind kind : all_families) {
    family_of(model, kind).kind = kind;
    family_of(model, kind).width = element_width(kind);
  }
  std::vector<BlockPlan> plans = plan_blocks(deck, blocks);
  for (BlockPlan& plan : plans) {
    const auto format = element_format(*plan.block);
    if (!format) {
      plan.item = nullptr;
      continue;
    }
    plan.format = *format;
    const std::int64_t part = plan.block->id.value + deck.offset_of(*plan.block, "part");
    if (const auto it = model.part_of_id.find(part); it != model.part_of_id.end())
      plan.part = it->second;
  }
  const std::vector<Chunk> chunks = cut_chunks(deck, plans, chunk_bytes);
  const auto first_range = static_cast<std::uint32_t>(model.element_blocks.size());
  for (const Block* block : blocks) model.element_blocks.push_back({block, 0, 0});
  std::array<Room, std::size(all_families)> rooms;
  for (const Chunk& chunk : chunks)
    rooms[static_cast<std::size_t>(chunk.kind)].total += chunk.bytes;
  std::vector<bool> reported(plans.size(), false);
  ProblemReporter reporter(deck, plans, &model.nodes, findings);
  const NodeFinder node(model.nodes);
  run_in_order<ElementSink>(
      chunks.size(), threads,
      [&](std::size_t k, ElementSink& out) {
        out.node = node;
        out.clear(chunks[k]);
        read_chunk(deck, plans, chunks[k], out);
      },
      [&](std::size_t k, ElementSink& rows) {
        const Chunk& chunk = chunks[k];
        reporter.report(chunk, rows.problems);
        release(deck, chunk);
        for (std::size_t s = 0; s < chunk.segments.size(); ++s) {
          const std::uint32_t p = chunk.segments[s].plan;
          if (!rows.thick[s] || reported[p] || plans[p].length == 1 ||
              chunk.kind != ElementKind::shell4)
            continue;
          reported[p] = true;
          report_thickness(*plans[p].block, findings);
        }
        Elements& family = family_of(model, chunk.kind);
        const Block& block = *plans[chunk.segments.front().plan].block;
        if (!indices_left(family.size(), rows.size, block, findings)) return;
        extend_ranges(chunk, rows.counts, family.size(), first_range, model.element_blocks);
        append_elements(chunk, plans, first_range, rows, family,
                        rooms[static_cast<std::size_t>(chunk.kind)]);
      });
  for (const ElementKind kind : all_families)
    family_of(model, kind).map.build(family_of(model, kind).id);
}

}  // namespace deck::detail
