// Plans of the bulk reader: where the cells of a block's lines are (from its schema), what they are
// for, and how the bytes of many blocks are cut into chunks that can be read independently.
#pragma once
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "deck/keyword/deck.hpp"
#include "keyword/shared/line_check.hpp"
#include "model/bulk/bulk.hpp"

namespace deck::detail {

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
