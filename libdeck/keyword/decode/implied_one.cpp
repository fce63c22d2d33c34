// Finds cells that scale functions or values; a blank one means 1.
#include "keyword/shared/decode_parts.hpp"

#include <cmath>
#include <vector>

#include "deck/text.hpp"

namespace deck::detail {

const Cell* cell_beside(const DecodedBlock& d, const DecodedCard& card, const Cell& cell,
                        std::string_view name) {
  std::vector<const Cell*> found;
  std::size_t place = 0, before = 0;
  for (const DecodedCard& other : d.cards)
    for (const Cell& c : other.cells) {
      if (&c == &cell) place = before;
      if (c.field->name == cell.field->name) ++before;
      if (c.field->name != name) continue;
      if (&other == &card && card.schema->repeat != Repeat::ids) return &c;
      found.push_back(&c);
    }
  if (found.size() == 1) return found.front();
  return place < found.size() ? found[place] : nullptr;
}

bool has_field(const Block& b, std::string_view name) {
  for (const CardSchema& card : b.schema->cards)
    if (card.in_version(b.version))
      for (const Field& f : card.fields)
        if (f.name == name && f.in_version(b.version)) return true;
  return false;
}

AxisScale axis_scale(const DecodedBlock& d, const DecodedCard& card, const Cell& cell,
                     std::string_view name) {
  AxisScale out;
  out.cell = cell_beside(d, card, cell, name);
  out.absent = out.cell == nullptr && has_field(*d.block, name);
  return out;
}

bool measures(const DecodedBlock& d, const DecodedCard& card, const Cell& cell) {
  for (const std::string& name : cell.field->unit_for) {
    const Cell* user = cell_beside(d, card, cell, name);
    if (user != nullptr && (user->real != 0 || user->integer != 0 || user->parameter)) return true;
  }
  return false;
}

ImpliedOnes implied_ones(const DecodedBlock& d) {
  ImpliedOnes out;
  for (const DecodedCard& card : d.cards) {
    if (card.missing()) continue;
    for (const Cell& cell : card.cells) {
      if (measures(d, card, cell)) out.cells.insert(&cell);
      if (cell.integer == 0 && !cell.parameter) continue;
      for (const Axis& axis : cell.field->axes)
        for (const std::string& name : axis.scales) {
          const AxisScale scale = axis_scale(d, card, cell, name);
          if (scale.cell != nullptr) out.cells.insert(scale.cell);
          if (scale.absent) out.absent.insert(name);
        }
    }
  }
  return out;
}

std::optional<double> ordinary_default(const Field& f) {
  if (!f.default_value || f.default_varies != DefaultVaries::no) return std::nullopt;
  const double size = std::fabs(*f.default_value);
  return size > 1e-20 && size < 1e20 ? f.default_value : std::nullopt;
}

}  // namespace deck::detail
