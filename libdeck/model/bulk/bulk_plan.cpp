// Computes once per block the columns of its cells.
#include "model/bulk/bulk.hpp"

#include <algorithm>
#include <cstring>
#include <map>

#include "text/shared/number_scan.hpp"

namespace deck::detail {
namespace {

/// 1 … 20 for "N1" … "N20", else 0.
std::size_t node_number(const Field& f) {
  if (f.ref != "node" || f.name.size() < 2 || f.name[0] != 'N') return 0;
  const IntegerCell number = read_integer(std::string_view(f.name).substr(1));
  const bool good = number.status == NumberStatus::ok && number.value >= 1 &&
                    number.value <= static_cast<std::int64_t>(max_nodes);
  return good ? static_cast<std::size_t>(number.value) : 0;
}

void place(ItemPlan& plan, const Field& f, CellAt at) {
  if (const std::size_t n = node_number(f); n > 0) {
    if (plan.nodes.size() < n) plan.nodes.resize(n);
    plan.nodes[n - 1] = at;
  } else if (f.type == FieldType::integer && at.card == 0 && !plan.id.present) {
    plan.id = at;
  } else if (f.name == "Thick") {
    plan.thickness = at;
  } else if (f.name == "X" || f.name == "Y" || f.name == "Z") {
    plan.coordinate[f.name[0] - 'X'] = at;
  }
}

bool starts_comment(char c) { return c == '#' || c == '$'; }

/// Cuts the pieces of a block at ends of items.
class Cutter {
 public:
  Cutter(const Deck& deck, std::uint64_t target, std::vector<Chunk>& chunks)
      : deck_(deck), target_(target), chunks_(chunks) {}

  void add(std::uint32_t index, const BlockPlan& plan) {
    if (plan.item == nullptr) return;
    std::size_t line = 0;  // of the current item, for items with several lines
    for (const FilePiece& piece : plan.block->body) {
      std::uint64_t begin = piece.begin;
      while (begin < piece.end) {
        if (chunks_.empty() || chunks_.back().kind != plan.format.kind ||
            (chunks_.back().bytes >= target_ && line == 0))
          open(plan.format.kind);
        const std::uint64_t room = target_ - std::min(chunks_.back().bytes, target_);
        const std::uint64_t end = plan.item->cards.size() == 1
                                      ? line_end(piece, begin + room)
                                      : item_end(piece, begin, room, plan.item->cards.size(), line);
        chunks_.back().segments.push_back({index, piece.file, begin, end, false});
        chunks_.back().bytes += end - begin;
        begin = end;
      }
    }
    if (!chunks_.empty() && chunks_.back().segments.back().plan == index)
      chunks_.back().segments.back().block_ends = true;
  }

 private:
  void open(ElementKind kind) {
    chunks_.emplace_back();
    chunks_.back().kind = kind;
  }

  /// End of the line with the byte before `at`, or of the piece.
  std::uint64_t line_end(const FilePiece& piece, std::uint64_t at) const {
    if (at >= piece.end) return piece.end;
    const char* const data = deck_.sources[piece.file].bytes().data();
    const void* const nl = std::memchr(data + at, '\n', piece.end - at);
    return nl == nullptr ? piece.end
                         : static_cast<std::uint64_t>(static_cast<const char*>(nl) - data) + 1;
  }

  /// First end of an item after `room` bytes, or of the piece.
  std::uint64_t item_end(const FilePiece& piece, std::uint64_t begin, std::uint64_t room,
                         std::size_t lines, std::size_t& line) const {
    const char* const data = deck_.sources[piece.file].bytes().data();
    std::uint64_t at = begin;
    while (at < piece.end && (at - begin < room || line != 0)) {
      const std::uint64_t next = line_end(piece, at);
      if (!starts_comment(data[at])) line = (line + 1) % lines;
      at = next;
    }
    return at;
  }

  const Deck& deck_;
  std::uint64_t target_;
  std::vector<Chunk>& chunks_;
};

}  // namespace

CardPlan::CardPlan(const CardSchema& schema, int version) : card(&schema), map(schema, version) {
  for (const Field& f : schema.fields) {
    if (!f.in_version(version)) continue;
    cells.push_back({&f, static_cast<std::uint32_t>(f.first - 1),
                     static_cast<std::uint32_t>(f.last), f.type == FieldType::real});
  }
  last = static_cast<std::uint32_t>(std::min(map.last, line_columns));
  for (std::uint32_t c = 0; c < last;) {
    std::uint32_t end = c;
    while (end < last && !map.covered[end + 1]) ++end;
    if (end > c) gaps.emplace_back(c, end);
    c = end + 1;
  }
}

std::shared_ptr<const ItemPlan> make_item_plan(const Schema& schema, int version) {
  auto plan = std::make_shared<ItemPlan>();
  for (const CardSchema& card : schema.cards) {
    if (!card.in_version(version)) continue;
    if (card.repeat == Repeat::ids || !card.when.empty()) return nullptr;
    plan->cards.emplace_back(card, version);
  }
  if (plan->cards.empty() || plan->cards.size() > max_cards) return nullptr;
  for (std::size_t c = 0; c < plan->cards.size(); ++c) {
    const auto& cells = plan->cards[c].cells;
    if (cells.size() > max_cells) return nullptr;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const FieldType type = cells[k].field->type;
      if (type == FieldType::text || type == FieldType::flag) return nullptr;
      place(*plan, *cells[k].field,
            {static_cast<std::uint8_t>(c), static_cast<std::uint8_t>(k), true});
    }
  }
  const std::vector<CellAt>& nodes = plan->nodes;
  std::size_t row = 0;
  while (row < nodes.size() && nodes[row].present && nodes[row].card == 0 &&
         nodes[row].cell == nodes[0].cell + row)
    ++row;
  if (row == nodes.size()) plan->nodes_in_row = row;
  return plan;
}

std::vector<BlockPlan> plan_blocks(const Deck& deck, const std::vector<const Block*>& blocks) {
  std::map<std::pair<const Schema*, int>, std::shared_ptr<const ItemPlan>> items;
  std::vector<BlockPlan> plans;
  plans.reserve(blocks.size());
  for (const Block* block : blocks) {
    BlockPlan& plan = plans.emplace_back();
    plan.block = block;
    if (block->schema == nullptr) continue;
    const auto [it, fresh] = items.try_emplace({block->schema, block->version});
    if (fresh) it->second = make_item_plan(*block->schema, block->version);
    plan.item = it->second;
    plan.node_offset = deck.offset_of(*block, "node");
    plan.id_offset = deck.offset_of(*block, block->schema->kind);
    if (const UnitSystem* units = deck.units_of(*block)) {
      Dimension length;
      length.length = 1;
      plan.length = conversion_factor(*units, deck.begin.working, length);
    }  // otherwise reported by DK109
  }
  return plans;
}

std::vector<Chunk> cut_chunks(const Deck& deck, const std::vector<BlockPlan>& plans,
                              std::uint64_t target) {
  std::vector<Chunk> chunks;
  Cutter cutter(deck, target, chunks);
  for (std::uint32_t i = 0; i < plans.size(); ++i) cutter.add(i, plans[i]);
  return chunks;
}

}  // namespace deck::detail
