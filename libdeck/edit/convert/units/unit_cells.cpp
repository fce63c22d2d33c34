// Writes converted numbers into cells and definitions of parameters; notes what cannot be
// converted.
#include <algorithm>

#include "deck/text.hpp"
#include "edit/convert/units/unit_system.hpp"
#include "text/shared/columns.hpp"

namespace deck::detail {

void UnitConversion::undecided(const Block& block, Span place, std::string field, std::string why) {
  leave_undecided(out, deck, block, place, std::move(field), std::move(why), options.partial);
  if (options.partial) left.insert(&block);
}

UnitConversion::OpenShare::OpenShare(UnitConversion& c, const Block& block)
    : c_(c), block_(block), share_{c.out.edits.size(), 0, c.out.losses.size(), 0} {}

UnitConversion::OpenShare::~OpenShare() {
  share_.edits_end = c_.out.edits.size();
  share_.losses_end = c_.out.losses.size();
  if (share_.edits_end > share_.edits || share_.losses_end > share_.losses)
    c_.shares.emplace(&block_, share_);
}

void UnitConversion::leave_blocks() {
  std::vector<bool> edit_goes(out.edits.size()), loss_goes(out.losses.size());
  for (const Block* block : left) {
    const auto [first, last] = shares.equal_range(block);
    for (auto share = first; share != last; ++share) {
      const Share& s = share->second;
      for (std::size_t i = s.edits; i < s.edits_end; ++i) edit_goes[i] = true;
      for (std::size_t i = s.losses; i < s.losses_end; ++i)
        loss_goes[i] = out.losses[i].loss != Loss::undecided;
    }
  }
  const auto keep = [](auto& list, const std::vector<bool>& goes) {
    std::size_t to = 0;
    for (std::size_t i = 0; i < list.size(); ++i)
      if (!goes[i]) {
        if (to != i) list[to] = std::move(list[i]);
        ++to;
      }
    list.resize(to);
  };
  keep(out.edits, edit_goes);
  keep(out.losses, loss_goes);
}

void UnitConversion::convert(const CellPlace& place, const UnitFactor& factor) {
  if (factor.one()) return;
  const std::string_view token = place.free_format
                                     ? deck.sources.text(place.span)
                                     : trim(columns(place.line.text, place.first, place.last));
  const RealCell value = read_real(token);
  const bool plain =
      value.status == NumberStatus::ok || value.status == NumberStatus::implicit_exponent;
  if (token.empty() || (value.value == 0 && (place.free_format || plain))) return;
  const int room = cells.room(place),
            width = place.free_format ? std::min(widest_number, room) : room;
  const auto text = scale_text(token, width, factor);
  if (!text) {
    const std::string no_number =
        "'" + std::string(token.substr(0, 30)) + "' is not a plain number";
    undecided(*place.block, place.span, std::string(place.field),
              place.free_format ? "the converted value makes this free-format line longer than 100 "
                                  "columns, or " +
                                      no_number
              : plain ? "the converted value does not fit its columns"
                      : no_number);
    return;
  }
  cells.put(place, text->text);
  ++changed_cells;
  if (text->exact) return;
  out.losses.push_back(loss_entry(
      deck, Loss::approximated, *place.block, place.span,
      {.field = std::string(place.field),
       .old_text = std::string(token),
       .new_text = text->text,
       .note = std::to_string(width) + " columns hold no more digits; converting back gives a "
                                       "slightly different value"}));
}

namespace {

const Block* definition_of(const Deck& deck, const Parameter& p) {
  for (const Block& b : deck.blocks)
    if (b.header.starts_with("/PARAMETER"))
      for (const FilePiece& piece : b.body)
        if (piece.file == p.span.file && p.span.offset >= piece.begin && p.span.offset < piece.end)
          return &b;
  return nullptr;
}

/// Keeps the parameter; cells that use it get numbers in the new units.
void write_numbers(UnitConversion& c, const std::string& name,
                   const std::vector<UnitConversion::ParameterUse>& uses, const std::string& why) {
  for (const auto& use : uses) {
    const UnitConversion::OpenShare share(c, *use.block);
    const int width = use.free_format ? widest_number : use.last - use.first + 1;
    const auto number = format_real(use.value, widest_number);
    const auto text =
        number ? scale_text(number->text, width, c.factors.of(use.dimension)) : std::nullopt;
    if (!text || !c.cells.put(use, text->text)) {
      c.undecided(*use.block, use.span, std::string(use.field),
                  "parameter &" + name + " " + why + ", and the number itself has no room here; " +
                      "give this dimension a parameter of its own");
      continue;
    }
    ++c.changed_cells;
    c.out.losses.push_back(loss_entry(
        c.deck, text->exact ? Loss::kept : Loss::approximated, *use.block, use.span,
        {.field = std::string(use.field),
         .old_text = std::string(trim(c.deck.sources.text(use.span))),
         .new_text = text->text,
         .note = "parameter &" + name + " " + why + "; the number was written instead"}));
  }
}

}  // namespace

void convert_parameters(UnitConversion& c) {
  if (c.parameter_uses.empty()) return;
  const ParameterPlaces places = find_parameters(c.deck);
  for (const auto& [name, uses] : c.parameter_uses) {
    const auto [first, last] = c.deck.parameters.equal_range(name);
    std::string why;
    for (auto it = first; it != last; ++it)
      if (!it->second.valid) why = "has no usable value";
    if (first == last) why = "is not defined";
    if (!why.empty()) {
      for (const auto& use : uses)
        c.undecided(*use.block, use.span, std::string(use.field), "parameter &" + name + " " + why);
      continue;
    }
    for (const auto& use : uses)
      if (!(use.dimension == uses[0].dimension)) why = "is used with several dimensions";
    const auto named = places.find(name);
    if (why.empty() && (named == places.end() || named->second.size() != uses.size()))
      why = "is used in other places too, where its value must not change";
    for (auto it = first; it != last && why.empty(); ++it)
      if (it->second.type != Parameter::Type::real || !it->second.expression.empty())
        why = "is not a plain real number";
    for (auto it = first; it != last && why.empty(); ++it)
      if (c.deck.sources.text(it->second.span).find(',') != std::string_view::npos)
        why = "stands in a line in free format";
    if (!why.empty()) {
      write_numbers(c, name, uses, why);
      continue;
    }
    const UnitFactor factor = c.factors.of(uses[0].dimension);
    for (auto it = first; it != last; ++it) {
      const Parameter& p = it->second;
      const Block* block = definition_of(c.deck, p);
      if (block == nullptr) continue;
      const Line line{c.deck.sources.text(p.span), p.span.file, p.span.offset};
      c.convert(*block, line, 11, 30, "value", factor);
    }
  }
}

}  // namespace deck::detail
