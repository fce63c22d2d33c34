// Collects the cells of element rows that the model has no place for.
#include "inspect/match.hpp"

#include <algorithm>

namespace deck::detail {
namespace {

class ElementRows {
 public:
  ElementRows(const Deck& deck, ElementCells& out) : deck_(deck), out_(out) {}

  void block(const Block& b, const Elements& family) {
    if (b.schema == nullptr || b.opaque) return;
    for (const CardSchema& card : b.schema->cards) {
      if (!card.in_version(b.version) || card.repeat != Repeat::rows) continue;
      wanted_.clear();
      int node = 0;
      for (const Field& f : card.fields) {
        if (!f.in_version(b.version) || &f == &card.fields.front() || f.name == "Thick") continue;
        if (f.ref == "node" && node++ < family.width) continue;
        wanted_.push_back(&f);
      }
      if (!wanted_.empty()) rows(b, card, family);
    }
  }

 private:
  void rows(const Block& b, const CardSchema& card, const Elements& family) {
    const std::int64_t offset = deck_.offset_of(b, b.schema->kind);
    LineCursor cursor(deck_.sources, b);
    for (Line line = cursor.next(); line.valid(); line = cursor.next()) {
      if (!says_more(line.text)) continue;
      const DecodedCard row = decode_line(deck_, b, card, line, nullptr);
      if (row.cells.empty()) continue;
      const std::uint32_t e = family.map.find(row.cells.front().integer + offset);
      if (e == no_index) continue;
      std::vector<ElementCell> found;
      for (const Cell& c : row.cells) {
        if (std::find(wanted_.begin(), wanted_.end(), c.field) == wanted_.end()) continue;
        ElementCell cell{c.field, c.real, c.integer};
        if (cell.id != 0 && c.field->type == FieldType::id)
          cell.id += (cell.id < 0 ? -1 : 1) * deck_.offset_of(b, c.field->ref);
        if (cell.real != 0 || cell.id != 0) found.push_back(cell);
      }
      if (!found.empty())
        out_[static_cast<std::size_t>(family.kind)].insert_or_assign(e, std::move(found));
    }
  }

  /// Something stands in a wanted cell, or the columns alone cannot tell.
  bool says_more(std::string_view text) const {
    if (text.find(',') != text.npos) return true;
    return std::any_of(wanted_.begin(), wanted_.end(), [&](const Field* f) {
      const auto first = static_cast<std::size_t>(f->first - 1);
      if (first >= text.size()) return false;
      const auto cell = text.substr(first, static_cast<std::size_t>(f->last - f->first + 1));
      return cell.find_first_not_of(" \t\r") != cell.npos;
    });
  }

  const Deck& deck_;
  ElementCells& out_;
  std::vector<const Field*> wanted_;
};

}  // namespace

ElementCells element_cells(const Deck& deck, const Model& model) {
  ElementCells out;
  ElementRows rows(deck, out);
  for (const Block& b : deck.blocks)
    if (b.schema != nullptr && b.schema->bulk)
      if (const auto kind = family_of_kind(b.schema->kind)) rows.block(b, model.family(*kind));
  return out;
}

}  // namespace deck::detail
