// Checks across the keys of a schema: overlapping columns, repeated names, conditions on unknown
// fields, cards after one that repeats to the end.
#include <fmt/format.h>

#include <algorithm>

#include "keyword/schema/json.hpp"

namespace deck::detail {
namespace {

/// Versions from..until of a field on a card.
struct Range {
  int from, until;
  bool meets(const Range& other) const {
    return std::max(from, other.from) <= std::min(until, other.until);
  }
};

Range range_of(const CardSchema& card, const Field& field) {
  return {std::max(card.from, field.from), std::min(card.until, field.until)};
}

/// True if `schema` has an integer (or text) field `name` on its first `cards` cards in `version`.
bool knows_before(const Schema& schema, std::size_t cards, int version, std::string_view name,
                  bool text = false) {
  for (std::size_t i = 0; i < cards; ++i)
    for (const auto& field : schema.cards[i].fields)
      if (field.name == name && field.type != FieldType::real &&
          (field.type == FieldType::text) == text && schema.cards[i].in_version(version) &&
          field.in_version(version))
        return true;
  return false;
}

/// The first version in which a condition tests an unknown field; 0: none. A field that exists only
/// later is 0 before.
int unknown_in(const Schema& schema, std::size_t cards, Range range, const Condition& condition) {
  if (condition.field == Condition::data_lines) return 0;
  for (const int version : known_versions())
    if (version >= std::max(range.from, schema.from) && version <= range.until &&
        !knows_before(schema, cards, version, condition.field, !condition.words.empty()))
      return version;
  return 0;
}

std::string check_conditions(const Schema& schema, std::size_t index) {
  const auto& card = schema.cards[index];
  for (const auto& condition : card.when)
    if (const int version = unknown_in(schema, index, {card.from, card.until}, condition))
      return fmt::format("/cards/{}/when: in version {} no earlier card has {} field \"{}\"", index,
                         version, condition.words.empty() ? "an integer" : "a text",
                         condition.field);
  // In some version, among the first `cards` cards.
  const auto ever = [&](std::size_t cards, std::string_view name, bool text = false) {
    return name == Condition::data_lines ||
           std::any_of(known_versions().begin(), known_versions().end(), [&](int version) {
             return knows_before(schema, cards, version, name, text);
           });
  };
  for (std::size_t f = 0; f < card.fields.size(); ++f)
    for (const auto& condition : card.fields[f].when)
      if (!ever(index + 1, condition.field))
        return fmt::format(
            "/cards/{}/fields/{}/when: neither this nor an earlier card has an integer field "
            "\"{}\"",
            index, f, condition.field);
  const bool number = card.count.find_first_not_of("0123456789") == std::string::npos;
  if (!number && !ever(index + 1, card.count))
    return fmt::format("/cards/{}/count: no earlier card has an integer field \"{}\"", index,
                       card.count);
  // A dimension may depend on a cell of any line and version; a missing one is 0.
  for (std::size_t f = 0; f < card.fields.size(); ++f)
    for (const auto& entry : card.fields[f].dimension_when)
      for (const auto& condition : entry.first)
        if (!ever(schema.cards.size(), condition.field, !condition.words.empty()))
          return fmt::format("/cards/{}/fields/{}/dim_when: no card has {} field \"{}\"", index, f,
                             condition.words.empty() ? "an integer" : "a text", condition.field);
  return {};
}

/// Cells that determine the unit of another one must be real fields of the schema.
std::string check_relations(const Schema& schema, std::size_t index) {
  const auto known = [&](std::string_view name, bool real) {
    for (const auto& card : schema.cards)
      for (const auto& field : card.fields)
        if (field.name == name &&
            (real ? field.type == FieldType::real : field.type != FieldType::text))
          return true;
    return false;
  };
  const auto& card = schema.cards[index];
  for (std::size_t f = 0; f < card.fields.size(); ++f) {
    const auto wrong = [&](const char* key, std::string_view name) {
      return fmt::format("/cards/{}/fields/{}/{}: no card has a {}field \"{}\"", index, f, key,
                         std::string_view(key) == "unit_for" ? "" : "real ", name);
    };
    for (const auto& axis : card.fields[f].axes)
      for (const auto& name : axis.scales)
        if (!known(name, true)) return wrong("axes", name);
    for (const auto& name : card.fields[f].unit_for)
      if (!known(name, false)) return wrong("unit_for", name);
    if (const auto& over = card.fields[f].over; !over.empty() && !known(over, true))
      return wrong("over", over);
  }
  return {};
}

std::string check_columns(const CardSchema& card, std::size_t index) {
  for (std::size_t j = 0; j < card.fields.size(); ++j) {
    const auto& field = card.fields[j];
    const auto range = range_of(card, field);
    if (range.from > range.until)
      return fmt::format("/cards/{}/fields/{}: \"{}\" exists in no version of its card", index, j,
                         field.name);
    for (std::size_t i = 0; i < j; ++i) {
      const auto& other = card.fields[i];
      const bool alternatives = !field.when.empty() && !other.when.empty();
      if (!alternatives && range.meets(range_of(card, other)) && field.first <= other.last &&
          other.first <= field.last)
        return fmt::format("/cards/{}/fields/{}/cols: {}-{} of \"{}\" overlap {}-{} of \"{}\"",
                           index, j, field.first, field.last, field.name, other.first, other.last,
                           other.name);
    }
  }
  return {};
}

/// Names must be unique per version, because conditions and look-ups use them. Alternatives with
/// exclusive conditions may share a name.
std::string check_names(const Schema& schema, std::size_t index) {
  const auto& card = schema.cards[index];
  for (std::size_t f = 0; f < card.fields.size(); ++f)
    for (std::size_t c = 0; c <= index; ++c) {
      const auto& earlier = schema.cards[c];
      const auto count = c == index ? f : earlier.fields.size();
      for (std::size_t g = 0; g < count; ++g)
        if (const bool alternatives = (!earlier.when.empty() || !earlier.fields[g].when.empty()) &&
                                      (!card.when.empty() || !card.fields[f].when.empty());
            !alternatives && earlier.fields[g].name == card.fields[f].name &&
            range_of(earlier, earlier.fields[g]).meets(range_of(card, card.fields[f])))
          return fmt::format("/cards/{}/fields/{}: the name \"{}\" is already used by card {}",
                             index, f, card.fields[f].name, c);
    }
  return {};
}

std::string check_repeat(const Schema& schema, std::size_t index) {
  const auto& card = schema.cards[index];
  if (card.repeat == Repeat::ids && card.fields.size() != 1)
    return fmt::format("/cards/{}: an id list has exactly one field", index);
  if (card.repeat == Repeat::rows && card.fields.empty())
    return fmt::format("/cards/{}: repeated rows without fields", index);
  for (std::size_t c = 0; c < index; ++c) {
    const auto& earlier = schema.cards[c];
    if (earlier.repeat == Repeat::once || earlier.words || !earlier.count.empty() ||
        !Range{earlier.from, earlier.until}.meets({card.from, card.until}))
      continue;
    if (earlier.repeat != Repeat::group || card.repeat != Repeat::group)
      return fmt::format("/cards/{}: nothing can follow card {}, which repeats to the end", index,
                         c);
  }
  return {};
}

}  // namespace

std::string check_schema(const Schema& schema) {
  for (std::size_t c = 0; c < schema.cards.size(); ++c) {
    std::string wrong = check_columns(schema.cards[c], c);
    if (wrong.empty()) wrong = check_names(schema, c);
    if (wrong.empty()) wrong = check_repeat(schema, c);
    if (wrong.empty()) wrong = check_conditions(schema, c);
    if (wrong.empty()) wrong = check_relations(schema, c);
    if (!wrong.empty()) return wrong;
  }
  return {};
}

}  // namespace deck::detail
