// Part pairs of /FRICTION, and unused groups, surfaces, lines and frictions.
#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "lint/check.hpp"
#include "lint/check_tables.hpp"

namespace deck::detail {
namespace {

const Cell* cell_of(const DecodedCard& card, std::string_view name) {
  for (const Cell& cell : card.cells)
    if (cell.field->name == name) return &cell;
  return nullptr;
}

/// Calls f(block, card) for the first line of every part pair.
template <class F>
void each_pair(const LintContext& c, F&& f) {
  for (const DecodedBlock& block : c.frictions)
    for (const DecodedCard& card : block.cards)
      if (cell_of(card, "part_ID1") != nullptr && !card.missing()) f(block, card);
}

std::string friction_name(const DecodedBlock& block) {
  return "/FRICTION " + std::to_string(block.block->id.value);
}

void check_parts(const LintContext& c, const Rule& rule, Reporter& r) {
  each_pair(c, [&](const DecodedBlock& block, const DecodedCard& card) {
    for (const Cell& cell : card.cells) {
      if (cell.field->type != FieldType::id || cell.integer <= 0) continue;
      const bool part = cell.field->ref == "part";
      const std::int64_t id = c.resolved(*block.block, cell.field->ref, cell.integer);
      const bool known =
          part ? c.model->part_of_id.count(id) > 0 : c.selections->part_group(id) != nullptr;
      if (!known)
        r.report(rule, *block.block, cell.span,
                 fmt::format("{} of {} is {}, and there is no {} of that id", cell.field->name,
                             friction_name(block), id, part ? "/PART" : "/GRPART or /SET"));
    }
  });
}

void check_repeated(const LintContext& c, const Rule& rule, Reporter& r) {
  using Key = std::tuple<const Block*, std::int64_t, std::int64_t, std::int64_t, std::int64_t>;
  std::map<Key, Span> seen;
  each_pair(c, [&](const DecodedBlock& block, const DecodedCard& card) {
    const auto id = [&](std::string_view name) {
      const Cell* cell = cell_of(card, name);
      return cell ? cell->integer : 0;
    };
    auto one = std::pair{id("grpart_ID1"), id("part_ID1")};
    auto two = std::pair{id("grpart_ID2"), id("part_ID2")};
    if (two < one) std::swap(one, two);
    const auto [it, fresh] = seen.emplace(
        Key{block.block, one.first, one.second, two.first, two.second}, card.line.whole());
    if (fresh) return;
    Diagnostic* d = r.report(rule, *block.block, card.line.whole(),
                             friction_name(block) + " gives the same pair of parts twice");
    if (d != nullptr) d->notes.emplace_back(it->second, "first given here");
  });
}

void check_incomplete(const LintContext& c, const Rule& rule, Reporter& r) {
  each_pair(c, [&](const DecodedBlock& block, const DecodedCard& card) {
    const auto given = [&](const std::string& side) {
      const Cell* group = cell_of(card, "grpart_ID" + side);
      const Cell* part = cell_of(card, "part_ID" + side);
      return (group != nullptr && group->integer != 0) || (part != nullptr && part->integer != 0);
    };
    const bool first = given("1"), second = given("2");
    if (first && second) return;
    if (!first && !second) {
      Diagnostic* d = r.report(rule, *block.block, card.line.whole(),
                               "a pair of " + friction_name(block) + " names no parts");
      if (d == nullptr) return;
      d->severity = Severity::warning;
      d->reference.reset();
      d->reference_behaviour = "It continues silently.";
      return;
    }
    const char* side = first ? "2" : "1";
    r.report(rule, *block.block, card.line.whole(),
             fmt::format("a pair of {} has neither grpart_ID{} nor part_ID{}", friction_name(block),
                         side, side));
  });
}

bool used(const LintContext& c, std::string_view kind, std::int64_t id) {
  const auto it = c.referenced.find(kind);
  return (it != c.referenced.end() && it->second.count(id) > 0) || c.loose_numbers.count(id) > 0;
}

void check_unused_friction(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& block : c.frictions) {
    const std::int64_t id = c.resolved(*block.block, "friction", block.block->id.value);
    if (!used(c, "friction", id))
      r.report(rule, *block.block, block.span(), "no interface uses " + friction_name(block));
  }
}

void check_unused_groups(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const std::string_view kind : {"grnod", "surf", "line"}) {
    const auto all = c.defined.find(kind);
    if (all == c.defined.end()) continue;
    for (const auto& [id, block] : all->second)
      if (!used(c, kind, id))
        r.report(rule, *block, block->header_span,
                 fmt::format("nothing refers to {} {}", block->schema->keyword, id));
  }
}

}  // namespace

std::span<const Checked> friction_checks() {
  static constexpr Checked all[] = {
      {RuleId::DK183, check_parts},           {RuleId::DK184, check_repeated},
      {RuleId::DK185, check_unused_friction}, {RuleId::DK186, check_incomplete},
      {RuleId::DK188, check_unused_groups},
  };
  return all;
}

}  // namespace deck::detail
