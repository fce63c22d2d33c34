// Pairs the lines of two layouts and moves cells; evaluates the conditions of both.
#include "edit/cells.hpp"

#include <algorithm>

#include "keyword/shared/schema_facts.hpp"

namespace deck::detail {

bool layout_differs(const Schema& schema, int a, int b) {
  return std::any_of(schema.cards.begin(), schema.cards.end(), [&](const CardSchema& card) {
    if (card.in_version(a) != card.in_version(b)) return true;
    return card.in_version(a) &&
           std::any_of(card.fields.begin(), card.fields.end(),
                       [&](const Field& f) { return f.in_version(a) != f.in_version(b); });
  });
}

std::string_view canonical_name(std::string_view field) {
  // Name before version 130.
  return field == "Rthe" ? "Kthe" : field;
}

bool is_zero_text(std::string_view text) {
  return text.find_first_not_of("0.+- \t") == std::string_view::npos;
}

const Cell* cell_of(const DecodedCard& card, std::string_view field) {
  for (const Cell& cell : card.cells)
    if (canonical_name(cell.field->name) == canonical_name(field)) return &cell;
  return nullptr;
}

bool TargetLayout::has_field(std::string_view field) const {
  for (const CardSchema& card : block_.schema->cards)
    if (card.in_version(target_))
      for (const Field& f : card.fields)
        if (f.in_version(target_) && f.name == field) return true;
  return false;
}

const Cell* TargetLayout::elsewhere(std::string_view field, int round,
                                    const DecodedCard* not_here) const {
  for (const DecodedCard& card : decoded_.cards) {
    if (&card == not_here || card.round != round || card.schema->repeat == Repeat::ids) continue;
    if (const Cell* cell = cell_of(card, field)) return cell;
  }
  return nullptr;
}

bool TargetLayout::is_present(const std::vector<Condition>& when, int round) const {
  return std::all_of(when.begin(), when.end(), [&](const Condition& c) {
    if (!has_field(c.field)) return detail::is_met(c, nullptr);
    const Cell* cell = round > 0 ? elsewhere(c.field, round, nullptr) : nullptr;
    return detail::is_met(c, cell != nullptr ? cell : elsewhere(c.field, 0, nullptr));
  });
}

std::vector<const Field*> TargetLayout::fields(const CardSchema& card, int round) const {
  std::vector<const Field*> out;
  for (const Field& f : card.fields)
    if (f.in_version(target_) && is_present(f.when, round)) out.push_back(&f);
  return out;
}

bool TargetLayout::is_present(const CardSchema& card, int round) const {
  if (!card.in_version(target_) || !is_present(card.when, round)) return false;
  const bool any = std::any_of(card.fields.begin(), card.fields.end(),
                               [&](const Field& f) { return f.in_version(target_); });
  return !any || !fields(card, round).empty();
}

bool TargetLayout::counts_lines() const {
  const auto counts = [](const std::vector<Condition>& when) {
    return std::any_of(when.begin(), when.end(),
                       [](const Condition& c) { return c.field == Condition::data_lines; });
  };
  return std::any_of(
      block_.schema->cards.begin(), block_.schema->cards.end(), [&](const CardSchema& card) {
        return card.in_version(target_) &&
               (counts(card.when) ||
                std::any_of(card.fields.begin(), card.fields.end(), [&](const Field& f) {
                  return f.in_version(target_) && counts(f.when);
                }));
      });
}

/// Repetitions of a card in the old block.
int TargetLayout::rounds(const CardSchema& card) const {
  int most = 0;
  for (const DecodedCard& old : decoded_.cards) {
    const bool list = card.repeat == Repeat::ids;
    const bool same = list
                          ? old.schema == &card || old.schema->name == card.name
                          : old.schema->repeat != Repeat::once && old.schema->repeat != Repeat::ids;
    if (same && old.schema->count == card.count) most = std::max(most, old.round);
  }
  return most;
}

const DecodedCard* TargetLayout::claim_line(const CardSchema& card, int round,
                                            std::vector<bool>& used) const {
  for (const bool by_name : {false, true})
    for (std::size_t k = 0; k < decoded_.cards.size(); ++k) {
      const DecodedCard& old = decoded_.cards[k];
      const bool same =
          by_name ? old.schema->name == card.name &&
                        (old.schema->repeat == Repeat::ids) == (card.repeat == Repeat::ids)
                  : old.schema == &card;
      if (used[k] || !same || old.round != round) continue;
      used[k] = true;
      return &old;
    }
  return nullptr;
}

std::vector<NewLine> TargetLayout::lines() const {
  std::vector<NewLine> lines;
  std::vector<bool> used(decoded_.cards.size(), false);
  const auto& cards = block_.schema->cards;
  for (std::size_t i = 0; i < cards.size(); ++i) {
    const CardSchema& card = cards[i];
    if (card.repeat == Repeat::once) {
      if (is_present(card, 0)) lines.push_back({&card, claim_line(card, 0, used), 0});
      continue;
    }
    if (card.repeat == Repeat::ids && card.count.empty()) {
      // Ids to the end of the block, preceded by names: line for line.
      if (!is_present(card, 0)) continue;
      for (int round = 0; round <= rounds(card); ++round)
        while (const DecodedCard* old = claim_line(card, round, used))
          lines.push_back({&card, old, round});
      continue;
    }
    std::size_t members = 1;
    while (card.repeat == Repeat::group && i + members < cards.size() &&
           cards[i + members].repeat == Repeat::group && cards[i + members].count == card.count)
      ++members;
    const int last = rounds(card);
    for (int round = 1; round <= last; ++round)
      for (std::size_t m = i; m < i + members; ++m)
        if (is_present(cards[m], cards[m].repeat == Repeat::ids ? 0 : round))
          lines.push_back({&cards[m], claim_line(cards[m], round, used), round});
    i += members - 1;
  }
  return lines;
}

}  // namespace deck::detail
