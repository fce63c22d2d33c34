// Compares the effective values of the interfaces of two decks.
#include <fmt/format.h>

#include <algorithm>

#include "deck/model/interfaces.hpp"
#include "edit/verify/verify_parts.hpp"

namespace deck::detail {
namespace {

/// One effective value, whatever its type.
struct NamedValue {
  std::string_view name;
  const std::string* text = nullptr;  ///< of a text
  std::int64_t integer = 0;           ///< of a number without unit
  double number = 0;
  bool real = false;
  bool written = true;  ///< in the deck, not built into the solver

  std::string shown() const { return text != nullptr ? *text : std::to_string(integer); }
  bool is_shown_like(const NamedValue& other) const {
    if (text != nullptr && other.text != nullptr) return *text == *other.text;
    return text == other.text && integer == other.integer;
  }
};

template <class T>
NamedValue named_value(std::string_view name, const Effective<T>& field) {
  NamedValue out;
  out.name = name;
  if constexpr (std::is_same_v<T, std::string>) {
    out.text = &field.value;
  } else if constexpr (std::is_same_v<T, double>) {
    out.number = field.value;
    out.real = true;
    out.written = field.origin != Origin::built_in;
  } else {
    out.integer = static_cast<std::int64_t>(field.value);
  }
  return out;
}

void values_of(const InterBase& inter, std::vector<NamedValue>& out) {
  out.clear();
  visit_any_interface(inter, [&](const auto& typed) {
    typed.for_each(
        [&](std::string_view name, const auto& field) { out.push_back(named_value(name, field)); });
  });
}

/// The cell of an interface with a name; nullptr: there is none.
const Field* cell_of(const InterBase& inter, std::string_view name) {
  if (inter.block == nullptr || inter.block->schema == nullptr) return nullptr;
  for (const CardSchema& card : inter.block->schema->cards)
    for (const Field& f : card.fields)
      if (f.name == name) return &f;
  return nullptr;
}

/// Dimensions that the cell can have: which one depends on flags.
std::vector<Dimension> dimensions_of(const Field* field) {
  std::vector<Dimension> out;
  if (field == nullptr) return {Dimension{}};
  out.push_back(field->dimension);
  for (const auto& [when, dimension] : field->dimension_when) out.push_back(dimension);
  if (field->solver_dimension) out.push_back(*field->solver_dimension);
  return out;
}

}  // namespace

DeckComparison::Difference DeckComparison::values() const {
  const auto &was = before.context.interfaces().all, &now = after.context.interfaces().all;
  const bool by_place = !relation.extract && !relation.expanded;
  if (by_place && was.size() != now.size())
    return fmt::format("the deck has {} interfaces of {}, expected {}", now.size(),
                       examined_types(Examined::contacts_and_ties), was.size());
  std::vector<NamedValue> a, b;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const InterBase* old = by_place ? was[interfaces_[i]] : nullptr;
    if (!by_place)
      for (const InterBase* candidate : was)
        if (candidate->id == now[i]->id && candidate->type == now[i]->type) old = candidate;
    if (old == nullptr) {
      if (relation.expanded) continue;  // a part of a TYPE19: its contact is compared
      return fmt::format("there was no interface {}", now[i]->id);
    }
    if (relation.lossy.contains(old->id) || relation.lossy_defaults) continue;
    const std::string name = fmt::format("interface {}", now[i]->id);
    if (old->type != now[i]->type || (!relation.new_ids && old->id != now[i]->id))
      return fmt::format("{} is a TYPE{}, expected TYPE{} and id {}", name, now[i]->type, old->type,
                         old->id);
    values_of(*old, a);
    values_of(*now[i], b);
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
      const NamedValue &value_was = a[k], &value_now = b[k];
      const auto what = [&] { return name + " " + std::string(value_was.name); };
      if (!value_was.real) {
        if (value_was.is_shown_like(value_now)) continue;
        const Field* field = cell_of(*old, value_was.name);
        if (relation.new_ids && field != nullptr && field->type == FieldType::id) continue;
        return fmt::format("{} is {}, expected {}", what(), value_now.shown(), value_was.shown());
      }
      // A default that is one of its unit in any: it acts on a function that is not there,
      // otherwise the conversion has written it out. Nothing is nothing in every unit.
      const bool built_in = !value_was.written && !value_now.written;
      if (value_was.number == value_now.number && (built_in || value_was.number == 0)) continue;
      const auto dimensions = dimensions_of(cell_of(*old, value_was.name));
      if (std::none_of(dimensions.begin(), dimensions.end(), [&](const Dimension& d) {
            return same(value_was.number, value_now.number, conversion_factor(from, to, d));
          }))
        return number(what(), value_was.number, value_now.number,
                      conversion_factor(from, to, dimensions.front()));
    }
  }
  return {};
}

}  // namespace deck::detail
