// Fills one field: from its cell, the default block, or the built-in value.
#include "model/interfaces_card.hpp"

#include <algorithm>

namespace deck::detail {

std::int64_t shifted_id(const Deck& deck, const Block& block, std::string_view kind,
                        std::int64_t id) {
  return id > 0 ? id + deck.offset_of(block, kind) : id;
}

void InterfaceCard::head(int type, InterBase& out) const {
  const Block& block = *decoded_.block;
  out.id = shifted_id(deck_, block, "inter", block.id.value);
  out.type = type;
  out.title = decoded_.title;
  while (!out.title.empty() && out.title.front() == ' ') out.title.erase(0, 1);
  out.block = &block;
  out.span = block.header_span;
}

const Cell* InterfaceCard::find(std::string_view field) const {
  if (const Cell* cell = decoded_.find(field)) return cell;
  // Versions before 130 call the heat exchange coefficient Rthe.
  return field == "Kthe" ? decoded_.find("Rthe") : nullptr;
}

void InterfaceCard::read(std::string_view field, EffectiveInt& out) const {
  const Cell* cell = find(field);
  if (cell == nullptr) return;
  out.span = cell->span;
  if (cell->blank()) return;
  out.has_input = true;
  out.input = cell->field->type == FieldType::id
                  ? shifted_id(deck_, *decoded_.block, cell->field->ref, cell->integer)
                  : cell->integer;
  out.value = out.input;
  out.origin = Origin::card;
}

void InterfaceCard::read(std::string_view field, EffectiveReal& out) const {
  const Cell* cell = find(field);
  if (cell == nullptr) return;
  out.span = cell->span;
  if (cell->blank()) return;
  out.has_input = true;
  out.input = working_value(deck_, decoded_, *cell);
  out.value = out.input;
  out.origin = Origin::card;
}

void InterfaceCard::read(std::string_view field, EffectiveText& out) const {
  out.value = "000";
  for (int axis = 0; axis < 3; ++axis) {
    const Cell* cell = find(std::string(field) + "XYZ"[axis]);
    if (cell == nullptr) continue;
    if (!out.span.valid()) {
      out.span = cell->span;
    } else {
      out.span.length = static_cast<std::uint32_t>(
          std::max(cell->span.offset + cell->span.length, out.span.offset + out.span.length) -
          out.span.offset);
    }
    if (cell->blank()) continue;
    out.has_input = true;
    out.origin = Origin::card;
    if (cell->integer == 1) out.value[static_cast<std::size_t>(axis)] = '1';
  }
  out.input = out.has_input ? out.value : std::string();
}

}  // namespace deck::detail
