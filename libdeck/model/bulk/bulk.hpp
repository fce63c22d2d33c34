// Bulk reader: /NODE, /CNODE and element blocks straight into the arrays of the model, columns by
// the schemas; decode_line() reads what is not clean. Private to the model stage.
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

/// The node blocks (/NODE, /CNODE) of a deck in the solver's order.
std::vector<const Block*> node_blocks(const Deck& deck);
/// The element blocks of a deck in the solver's order.
std::vector<const Block*> element_blocks(const Deck& deck);

/// Family and shape an element keyword is stored as; nullopt: no element keyword.
struct ElementFormat {
  ElementKind kind{};
  SolidShape shape = SolidShape::brick8;  ///< solids only; /BRICK may turn out tetra4 or penta6
  int required = 0;                       ///< leading nodes that must exist; later ones may be 0
};
std::optional<ElementFormat> element_format(const Block& block);

/// Node slots per element: shell4 4, shell3 3, solid8 8, quad 4, tria 3, truss 2, beam 3 (the third
/// is the orientation node), spring 6. A slot left blank or 0 on a card is no_index.
int element_width(ElementKind kind);

/// Appends the nodes of `blocks` to `nodes` as they are written: ids with submodel offset,
/// coordinates in working units; then builds nodes.map. `ranges` gets one entry per block (empty
/// ones too). Same result and findings for every number of
/// threads. Duplicate ids are left to the caller (nodes.map.duplicates()).
void read_nodes(const Deck& deck, const std::vector<const Block*>& blocks, Nodes& nodes,
                std::vector<BulkBlock>& ranges, Findings& findings, int threads);

/// Appends the elements of `blocks` (all families, as they are written) to the families of `model`,
/// with the entries of model.element_blocks, and builds the id maps of the families. Needs
/// model.nodes and model.part_of_id; a part that is not there gives no_index without a message (the
/// caller knows all parts and reports once). Unknown nodes: DK101 and no_index. Own thicknesses are
/// in working units; Elements::thickness stays empty if no element of the family has one. Solids
/// are stored as written; orient_solids() is the next step.
void read_elements(const Deck& deck, const std::vector<const Block*>& blocks, Model& model,
                   Findings& findings, int threads);

/// The solver's order of what was read: nodes of a file and elements of a block by id. A block
/// whose rows do not ascend becomes several runs.
void put_nodes_in_order(Nodes& nodes, std::vector<BulkBlock>& ranges);
void put_elements_in_order(Model& model);

/// Turns solids of negative volume (sign of the Jacobian in the centre of the eight stored slots)
/// as the reference solver does: bricks and 20-, 16-node solids exchange nodes 1-4 with 5-8, tetras
/// node 2 with 4 (and their mid-side nodes with them). Pentas and solids with a missing node stay.
/// Returns the number of solids turned.
std::size_t orient_solids(Model& model);

inline constexpr std::size_t max_cards = 3;   ///< lines per element
inline constexpr std::size_t max_cells = 20;  ///< cells per line
inline constexpr std::size_t max_nodes = 20;  ///< nodes per element

struct CellPlan {
  const Field* field = nullptr;
  std::uint32_t first = 0, last = 0;  ///< [first, last) from 0
  bool real = false;
};

/// One line of an item.
struct CardPlan {
  const CardSchema* card = nullptr;
  std::vector<CellPlan> cells;                                ///< as decode_line() orders them
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
  std::size_t nodes_in_row = 0;  ///< all of them where they are cells of the first card in a row
};

/// nullptr if the schema is not one the fast path can follow (too many cells, text cells).
std::shared_ptr<const ItemPlan> make_item_plan(const Schema& schema, int version);

struct BlockPlan {
  const Block* block = nullptr;
  std::shared_ptr<const ItemPlan> item;  ///< nullptr: block cannot be read
  ElementFormat format;
  std::int64_t id_offset = 0, node_offset = 0;
  double length = 1;  ///< factor to working units
  std::uint32_t part = no_index;
};

/// Plans of `blocks`, one each, without part and format. A unit id that is unknown counts as none.
std::vector<BlockPlan> plan_blocks(const Deck& deck, const std::vector<const Block*>& blocks);

/// Whole lines of one block in one file.
struct TextSegment {
  std::uint32_t plan = 0;
  std::uint32_t file = 0;
  std::uint64_t begin = 0, end = 0;
  bool block_ends = false;  ///< the last one of its block
};

/// Consecutive segments of one family; no item crosses from one chunk to the next.
struct Chunk {
  std::vector<TextSegment> segments;
  std::uint64_t bytes = 0;
  ElementKind kind{};
};

/// Cuts the blocks into chunks of about `target` bytes; the cuts do not depend on anything else.
std::vector<Chunk> cut_chunks(const Deck& deck, const std::vector<BlockPlan>& plans,
                              std::uint64_t target);

}  // namespace deck::detail
