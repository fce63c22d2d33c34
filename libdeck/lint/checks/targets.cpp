// Ids on boundary conditions, loads, constraints and sensors: the schemas say which targets the
// reference solver asks for; here the deck is held against them.
#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "lint/check.hpp"
#include "lint/check_tables.hpp"
#include "lint/targets.hpp"

namespace deck::detail {
namespace {

std::string block_name(const DecodedBlock& d) {
  return fmt::format("{} {}", d.block->schema->keyword, d.block->id.value);
}

ReferenceMessage stops_with(int message) { return {message, Severity::error}; }

/// Says with which message the solver stops; 0: not known, the finding then names none.
void set_message(Diagnostic* d, int message) {
  if (d == nullptr) return;
  if (message > 0)
    d->reference = stops_with(message);
  else
    d->reference.reset();
}

/// Laws and properties cannot do without the curves they name; the others have their own numbers.
int missing_curve(const Schema& schema) {
  return schema.kind == "mat" ? 126 : schema.kind == "prop" ? 127 : 0;
}

/// Calls f(block, cell, id, message) for every id whose field has the given demand.
template <class F>
void each_demand(const LintContext& c, std::optional<int> Field::*demand, F&& f) {
  for (const DecodedBlock& d : c.loads) {
    if (acts_on_nothing(c, d) != nullptr) continue;  // DK138 says so
    for (const DecodedCard& card : d.cards)
      for (const Cell& cell : card.cells) {
        if (cell.field->type != FieldType::id) continue;
        std::optional<int> message = cell.field->*demand;
        if (demand == &Field::missing && !message && cell.field->ref == "funct")
          message = missing_curve(*d.block->schema);
        if (message) f(d, cell, c.resolved(*d.block, cell.field->ref, cell.integer), *message);
      }
  }
}

/// Tables stand where functions are asked for. Their number follows that of their kind
/// (/TABLE/1/id), so every number of the header counts.
bool table_exists(const LintContext& c, std::int64_t id) {
  return std::any_of(c.deck.blocks.begin(), c.deck.blocks.end(), [&](const Block& block) {
    if (block.schema == nullptr || block.schema->keyword != "/TABLE") return false;
    const std::int64_t offset = c.deck.offset_of(block, "funct");
    std::string_view rest = block.header;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('/'), rest.size());
      const IntegerCell number = read_integer(rest.substr(0, end));
      if (number.value != 0 && number.value + offset == id) return true;
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return false;
  });
}

void check_missing_target(const LintContext& c, const Rule& rule, Reporter& r) {
  each_demand(c, &Field::missing,
              [&](const DecodedBlock& d, const Cell& cell, std::int64_t id, int message_id) {
                if (id == 0 || target_exists(c, cell.field->ref, id).value_or(true)) return;
                const std::string_view kind = cell.field->ref;
                if (kind == "funct" && table_exists(c, id)) return;
                const bool group = kind == "grnod" || kind == "surf" || kind == "line";
                std::string message =
                    fmt::format("{} of {} is {}, and there is no {}{} of that id", cell.field->name,
                                block_name(d), id, kind_name(kind), group ? " or /SET" : "");
                const std::int64_t offset = c.deck.offset_of(*d.block, kind);
                if (offset != 0 && target_exists(c, kind, id - offset).value_or(false))
                  message += fmt::format("; {} exists outside the submodel, whose offset is {}",
                                         id - offset, offset);
                set_message(r.report(rule, *d.block, cell.span, std::move(message)), message_id);
              });
}

void check_acts_on_nothing(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& d : c.loads) {
    const Field* field = acts_on_nothing(c, d);
    if (field == nullptr) continue;
    const Cell* cell = d.find(field->name);
    const bool placed = cell != nullptr && cell->span.valid();
    r.report(
        rule, *d.block, placed ? cell->span : d.block->header_span,
        cell == nullptr || cell->integer == 0
            ? fmt::format("{} of {} names no {}", field->name, block_name(d), kind_name(field->ref))
            : fmt::format("{} of {} is {}, and there is no {} or /SET of that id", field->name,
                          block_name(d), c.resolved(*d.block, field->ref, cell->integer),
                          kind_name(field->ref)));
  }
}

void check_empty_target(const LintContext& c, const Rule& rule, Reporter& r) {
  each_demand(c, &Field::empty,
              [&](const DecodedBlock& d, const Cell& cell, std::int64_t id, int message_id) {
                const std::string_view kind = cell.field->ref;
                if (id <= 0 || !selection_exists(c, kind, id) || !selection_is_empty(c, kind, id))
                  return;
                Diagnostic* found =
                    r.report(rule, *d.block, cell.span,
                             fmt::format("{} of {} is {}, and {} is empty", cell.field->name,
                                         block_name(d), id, selection_name(c, kind, id)));
                set_message(found, message_id);
                if (found == nullptr) return;
                const bool plain = c.selections->is_plain(kind, id);
                if (const auto at = c.selections->where(plain ? kind : "set", id))
                  found->notes.emplace_back(*at, "it is defined here");
              });
}

/// By the schema, not by the cells: the line of the id may be missing altogether.
void check_required_target(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& d : c.loads)
    for (const CardSchema& card : d.block->schema->cards)
      for (const Field& field : card.fields) {
        const int version = d.block->version;
        if (!field.required || !card.in_version(version) || !field.in_version(version)) continue;
        const Cell* cell = d.find(field.name);
        if (cell != nullptr && cell->integer != 0) continue;
        const bool placed = cell != nullptr && cell->span.valid();
        Diagnostic* found = r.report(
            rule, *d.block, placed ? cell->span : d.block->header_span,
            fmt::format("{} of {} names no {}", field.name, block_name(d), kind_name(field.ref)));
        set_message(found, *field.required);
      }
}

/// "/TH/NODE": the names of a header, up to its id.
std::string_view names_of(const Block& block) {
  if (!block.id.span.valid()) return block.keyword;
  const std::string_view names =
      block.header.substr(0, block.id.span.offset - block.header_span.offset);
  return names.substr(0, names.find_last_not_of("/ ") + 1);
}

/// Which blocks share their ids: the schema says it, "th/*" stands for one family a kind of /TH.
std::string id_family(const Block& block) {
  const std::string& name = block.schema->unique;
  return name.ends_with("/*") ? std::string(names_of(block)) : name;
}

void check_twice(const LintContext& c, const Rule& rule, Reporter& r) {
  std::map<std::pair<std::string, std::int64_t>, const Block*> first;
  for (const Block& block : c.deck.blocks) {
    const Schema* s = block.schema;
    if (s == nullptr || s->unique.empty() || !block.id.present || block.id.value == 0) continue;
    const std::int64_t id = c.resolved(block, s->kind, block.id.value);
    const auto [it, fresh] = first.try_emplace({id_family(block), id}, &block);
    if (fresh) continue;
    Diagnostic* d = r.report(rule, block, block.header_span,
                             fmt::format("the id {} of {} is used twice", id, names_of(block)));
    if (d != nullptr) d->notes.emplace_back(it->second->header_span, "first used here");
  }
}

void check_friction_twice(const LintContext& c, const Rule& rule, Reporter& r) {
  const auto all = c.defined.find("friction");
  if (all == c.defined.end()) return;
  std::map<std::int64_t, const Block*> first;
  for (const auto& [id, block] : all->second) {
    const auto [it, fresh] = first.try_emplace(id, block);
    if (fresh) continue;
    Diagnostic* d = r.report(rule, *block, block->header_span,
                             fmt::format("/FRICTION {} is defined twice", id));
    if (d != nullptr) d->notes.emplace_back(it->second->header_span, "first defined here");
  }
}

}  // namespace

std::span<const Checked> target_checks() {
  static constexpr Checked all[] = {
      {RuleId::DK120, check_missing_target},  {RuleId::DK121, check_empty_target},
      {RuleId::DK122, check_required_target}, {RuleId::DK128, check_twice},
      {RuleId::DK138, check_acts_on_nothing}, {RuleId::DK191, check_friction_twice},
  };
  return all;
}

}  // namespace deck::detail
