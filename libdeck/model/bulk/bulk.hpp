// Bulk reader: /NODE, /CNODE and element blocks directly into the arrays of the model. Columns come
// from the schemas; unclean lines are read by decode_line(). Private to the stage.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "deck/keyword.hpp"
#include "deck/model.hpp"
#include "keyword/shared/line_check.hpp"

namespace deck::detail {

Elements& family_of(Model& model, ElementKind kind);

/// The blocks /NODE and /CNODE in the solver's order.
std::vector<const Block*> node_blocks(const Deck& deck);
/// The element blocks in the solver's order.
std::vector<const Block*> element_blocks(const Deck& deck);

/// Family and shape of an element keyword; nullopt: another keyword.
struct ElementFormat {
  ElementKind kind{};
  SolidShape shape = SolidShape::brick8;  ///< solids only; a /BRICK can become tetra4 or penta6
  int required = 0;                       ///< leading nodes that must exist; later ones may be 0
};
std::optional<ElementFormat> element_format(const Block& block);

/// Node slots per element: shell4 4, shell3 3, solid8 8, quad 4, tria 3, truss 2, beam 3 (third:
/// orientation node), spring 6. A blank or 0 is no_index.
int element_width(ElementKind kind);

/// Appends the nodes of `blocks` in file order (ids with submodel offset, coordinates in working
/// units) and builds nodes.map. `ranges`: one entry per block, also for empty ones. Threads do not
/// change results and findings. The caller reports duplicates (nodes.map.duplicates()).
void read_nodes(const Deck& deck, const std::vector<const Block*>& blocks, Nodes& nodes,
                std::vector<BulkBlock>& ranges, Findings& findings, int threads);

/// Appends the elements of `blocks` in file order to the families of `model`, with
/// model.element_blocks and the id maps. Needs model.nodes and model.part_of_id. A missing part is
/// no_index without a finding (the caller reports it once). Unknown nodes: DK101 and no_index.
/// Thicknesses in working units; Elements::thickness is empty if no element of the family has one.
/// orient_solids() must follow.
void read_elements(const Deck& deck, const std::vector<const Block*>& blocks, Model& model,
                   Findings& findings, int threads);

/// Sorts into the solver's order: nodes of a file and elements of a block by id. A block with
/// descending rows becomes several runs.
void put_nodes_in_order(Nodes& nodes, std::vector<BulkBlock>& ranges);
void put_elements_in_order(Model& model);

/// Reverses solids of negative volume (Jacobian at the centre of the eight slots) like the solver:
/// bricks and solids of 16 and 20 nodes exchange nodes 1-4 with 5-8, tetras nodes 2 and 4 (with
/// mid-side nodes). Not pentas and solids with missing nodes. Returns their number.
std::size_t orient_solids(Model& model);

inline constexpr std::size_t max_cards = 3;   ///< lines per element
inline constexpr std::size_t max_cells = 20;  ///< cells per line
inline constexpr std::size_t max_nodes = 20;  ///< nodes per element

struct CellPlan {
  const Field* field = nullptr;
  std::uint32_t first = 0, last = 0;  ///< [first, last), 0-based
  bool real = false;
};

/// One line of an item.
struct CardPlan {
  const CardSchema* card = nullptr;
  std::vector<CellPlan> cells;                                ///< in the order of decode_line()
  std::vector<std::pair<std::uint32_t, std::uint32_t>> gaps;  ///< blank columns before `last`
  std::uint32_t last = 0;                                     ///< end of the last cell
  ColumnMap map;
  explicit CardPlan(const CardSchema& schema, int version);
};

struct CellAt {
  std::uint8_t card = 0, cell = 0;
  bool present = false;
};

/// All lines of an item of one keyword in one version.
struct ItemPlan {
  std::vector<CardPlan> cards;
  CellAt id, thickness, coordinate[3];
  std::vector<CellAt> nodes;     ///< N1, N2, …
  std::size_t nodes_in_row = 0;  ///< all, if consecutive cells of the first card
};

/// nullptr: the schema is not supported by the fast path (too many cells, text cells).
std::shared_ptr<const ItemPlan> make_item_plan(const Schema& schema, int version);

struct BlockPlan {
  const Block* block = nullptr;
  std::shared_ptr<const ItemPlan> item;  ///< nullptr: block cannot be read
  ElementFormat format;
  std::int64_t id_offset = 0, node_offset = 0;
  double length = 1;  ///< factor to working units
  std::uint32_t part = no_index;
};

/// Plans of `blocks`, without part and format. An unknown unit id is ignored.
std::vector<BlockPlan> plan_blocks(const Deck& deck, const std::vector<const Block*>& blocks);

/// Whole lines of one block in one file.
struct TextSegment {
  std::uint32_t plan = 0;
  std::uint32_t file = 0;
  std::uint64_t begin = 0, end = 0;
  bool block_ends = false;  ///< true for the last segment of its block
};

/// Consecutive segments of one family, with complete items.
struct Chunk {
  std::vector<TextSegment> segments;
  std::uint64_t bytes = 0;
  ElementKind kind{};
};

/// Cuts the blocks into chunks of about `target` bytes, independent of anything else.
std::vector<Chunk> cut_chunks(const Deck& deck, const std::vector<BlockPlan>& plans,
                              std::uint64_t target);

}  // namespace deck::detail
