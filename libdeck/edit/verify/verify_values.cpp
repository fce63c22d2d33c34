// Compares the effective values of the interfaces of two decks.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "edit/verify/verify_parts.hpp"

namespace deck::detail {
namespace {

/// One effective value, whatever its type.
struct NamedValue {
  std::string name, text;
  double number = 0;
  bool real = false;
  bool written = true;  ///< in the deck, not built into the solver
};

template <class T>
NamedValue named_value(std::string_view name, const Effective<T>& field) {
  if constexpr (std::is_same_v<T, std::string>)
    return {std::string(name), field.value, 0, false};
  else if constexpr (std::is_same_v<T, double>)
    return {std::string(name), "", field.value, true, field.origin != Origin::built_in};
  else
    return {std::string(name), std::to_string(field.value), 0, false};
}

std::vector<NamedValue> values_of(const InterBase* inter) {
  std::vector<NamedValue> out;
  visit_interface(*inter, [&](const auto& typed) {
    typed.for_each(
        [&](std::string_view name, const auto& field) { out.push_back(named_value(name, field)); });
  });
  return out;
}

/// The cells of an interface by name.
std::map<std::string, const Field*, std::less<>> cells_of(const InterBase& inter) {
  std::map<std::string, const Field*, std::less<>> out;
  if (inter.block == nullptr || inter.block->schema == nullptr) return out;
  for (const CardSchema& card : inter.block->schema->cards)
    for (const Field& f : card.fields) out.emplace(f.name, &f);
  return out;
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
  const auto &was = before.context.interfaces.ordered, &now = after.context.interfaces.ordered;
  const bool by_place = !relation.extract && !relation.expanded;
  if (by_place && was.size() != now.size())
    return fmt::format("the deck has {} interfaces of TYPE7, 10, 11 and 19, expected {}",
                       now.size(), was.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    const InterBase* old = by_place ? was[i] : nullptr;
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
    const auto fields = cells_of(*old);
    const auto a = values_of(old), b = values_of(now[i]);
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
      const auto found = fields.find(a[k].name);
      const Field* field = found == fields.end() ? nullptr : found->second;
      const std::string what = name + " " + a[k].name;
      if (!a[k].real) {
        const bool id = field != nullptr && field->type == FieldType::id;
        if (a[k].text != b[k].text && !(id && relation.new_ids))
          return fmt::format("{} is {}, expected {}", what, b[k].text, a[k].text);
        continue;
      }
      // A default that is one of its unit in any: it acts on a function that is not there,
      // otherwise the conversion has written it out.
      if (!a[k].written && !b[k].written && a[k].number == b[k].number) continue;
      Difference first;
      bool same = false;
      for (const Dimension& d : dimensions_of(field)) {
        auto difference = number(what, a[k].number, b[k].number, conversion_factor(from, to, d));
        same = same || !difference;
        if (!first) first = std::move(difference);
      }
      if (!same) return first;
    }
  }
  return {};
}

}  // namespace deck::detail
