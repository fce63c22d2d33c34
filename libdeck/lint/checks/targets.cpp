// Ids on boundary conditions, loads, constraints and sensors: the schemas name the targets that
// must exist for the solver. Also illegal flags and words of loads and walls, walls without a
// normal, particles in too many boundaries.
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "lint/check.hpp"
#include "model/shared/families.hpp"

namespace deck::detail {

std::string_view kind_name(std::string_view kind) {
  using Name = std::pair<std::string_view, std::string_view>;
  static constexpr std::array<Name, 19> names = {
      Name{"grnod", "/GRNOD"},       Name{"surf", "/SURF"},     Name{"line", "/LINE"},
      Name{"funct", "/FUNCT"},       Name{"sensor", "/SENSOR"}, Name{"skew", "/SKEW"},
      Name{"frame", "/FRAME"},       Name{"prop", "/PROP"},     Name{"mat", "/MAT"},
      Name{"friction", "/FRICTION"}, Name{"part", "/PART"},     Name{"node", "node"},
      Name{"subset", "/SUBSET"},     Name{"inter", "/INTER"},   Name{"accel", "/ACCEL"},
      Name{"rbody", "/RBODY"},       Name{"rwall", "/RWALL"},   Name{"sect", "/SECT"},
      Name{"monvol", "/MONVOL"}};
  if (family_of_kind(kind)) return kind;
  const auto it =
      std::find_if(names.begin(), names.end(), [&](const Name& n) { return n.first == kind; });
  return it == names.end() ? "/SET" : it->second;
}

bool selection_exists(const LintContext& c, std::string_view kind, std::int64_t id) {
  return c.selections->is_plain(kind, id) || c.selections->where("set", id).has_value();
}

std::string selection_name(const LintContext& c, std::string_view kind, std::int64_t id) {
  const std::string_view name = c.selections->is_plain(kind, id) ? kind_name(kind) : "/SET";
  return std::string(name) + " " + std::to_string(id);
}

std::size_t selection_size(const LintContext& c, std::string_view kind, std::int64_t id) {
  if (kind == "grnod") {
    const NodeSet* s = c.selections->node_group(id);
    return s ? s->nodes.size() : 0;
  }
  if (kind == "surf") {
    const auto s = c.selections->outline(id);
    return s ? (s->analytical ? 1 : s->segments.size()) : 0;
  }
  const LineSet* s = c.selections->line(id);
  return s ? s->edges.size() : 0;
}

bool selection_is_empty(const LintContext& c, std::string_view kind, std::int64_t id) {
  return selection_size(c, kind, id) == 0 && c.selections->complete();
}

std::optional<bool> target_exists(const LintContext& c, std::string_view kind, std::int64_t id) {
  if (kind == "grnod" || kind == "surf" || kind == "line") return selection_exists(c, kind, id);
  if (kind == "node") return c.model->find_node(id) != no_index;
  if (const auto family = family_of_kind(kind))
    return c.model->family(*family).map.find(id) != no_index;
  if (kind_name(kind) == "/SET") return std::nullopt;
  const auto all = c.defined.find(kind);
  return all != c.defined.end() && all->second.count(id) > 0;
}

std::string missing_text(const LintContext& c, const DecodedBlock& d, std::string_view field,
                         std::string_view kind, std::int64_t id) {
  const bool group = kind == "grnod" || kind == "surf" || kind == "line";
  std::string out = fmt::format("{} of {} is {}, and there is no {}{} of that id", field,
                                name_of(d), id, kind_name(kind), group ? " or /SET" : "");
  const std::int64_t offset = c.deck.offset_of(*d.block, kind);
  if (offset != 0 && target_exists(c, kind, id - offset).value_or(false))
    out += fmt::format("; {} exists outside the submodel, whose offset is {}", id - offset, offset);
  return out;
}

void note_definition(const LintContext& c, Finding& d, std::string_view kind, std::int64_t id) {
  const bool plain = c.selections->is_plain(kind, id);
  if (const auto at = c.selections->where(plain ? kind : "set", id))
    d.notes.emplace_back(*at, "it is defined here");
}

std::pair<const Field*, bool> acts_on(const LintContext& c, const DecodedBlock& d) {
  const int version = d.block->version;
  for (const CardSchema& card : d.block->schema->cards)
    for (const Field& field : card.fields) {
      if (!field.acts_on || !card.in_version(version) || !field.in_version(version)) continue;
      const Cell* cell = d.find(field.name);
      const std::int64_t id = cell != nullptr ? c.resolved(*d.block, field.ref, cell->integer) : 0;
      return {&field, id != 0 && target_exists(c, field.ref, id).value_or(true)};
    }
  return {nullptr, false};
}

const Field* acts_on_nothing(const LintContext& c, const DecodedBlock& d) {
  const auto [field, found] = acts_on(c, d);
  if (field == nullptr || found) return nullptr;
  const Cell* cell = d.find(field->name);
  if (cell == nullptr || cell->integer == 0) return field;
  // A single wrong group is an error; if no block has a node, the solver ignores them all.
  return c.any_load_acts ? nullptr : field;
}

namespace {

/// Sets the message at which the solver stops; 0: unknown, no message.
void set_message(Finding& d, int message) {
  if (message > 0)
    d.reference = ReferenceMessage{message, Severity::error};
  else
    d.reference.reset();
}

/// Calls f(block, cell, id, message) for every id whose field has the given demand.
template <class F>
void for_each_demand(const LintContext& c, std::optional<int> Field::*demand, F&& f) {
  for (const DecodedBlock& d : c.blocks_with_checked_ids) {
    if (acts_on_nothing(c, d) != nullptr) continue;  // reported by DK138
    for (const DecodedCard& card : d.cards)
      for (const Cell& cell : card.cells) {
        if (cell.field->type != FieldType::id) continue;
        const std::optional<int> message = cell.field->*demand;
        if (message) f(d, cell, c.resolved(*d.block, cell.field->ref, cell.integer), *message);
      }
  }
}

/// Tables can replace functions. Their number follows that of their kind (/TABLE/1/id), so every
/// number of the header counts.
bool table_exists(const LintContext& c, std::int64_t id) {
  return std::any_of(c.deck.blocks.begin(), c.deck.blocks.end(), [&](const Block& block) {
    if (block.schema == nullptr || block.schema->keyword != "/TABLE") return false;
    const std::int64_t offset = c.deck.offset_of(block, "funct");
    const auto parts = parts_of(block.header, '/');
    return std::any_of(parts.begin(), parts.end(), [&](std::string_view part) {
      const std::int64_t number = read_integer(part).value;
      return number != 0 && number + offset == id;
    });
  });
}

void check_missing_target(const LintContext& c, const Rule& rule, Reporter& r) {
  for_each_demand(
      c, &Field::missing,
      [&](const DecodedBlock& d, const Cell& cell, std::int64_t id, int message_id) {
        const std::string_view kind = cell.field->ref;
        // A line can be the side of an edge interface.
        const bool side = d.block->schema->keyword == "/INTER/SUB" && kind != "inter";
        if (id == 0 || target_exists(c, kind, id).value_or(true) ||
            (kind == "funct" && table_exists(c, id)) || (side && selection_exists(c, "line", id)))
          return;
        set_message(
            r.report(rule, *d.block, cell.span, missing_text(c, d, cell.field->name, kind, id)),
            message_id);
      });
}

void check_acts_on_nothing(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& d : c.blocks_with_checked_ids) {
    const Field* field = acts_on_nothing(c, d);
    if (field == nullptr) continue;
    const Cell* cell = d.find(field->name);
    r.report(
        rule, *d.block, place_of(d, cell),
        cell == nullptr || cell->integer == 0
            ? fmt::format("{} of {} names no {}", field->name, name_of(d), kind_name(field->ref))
            : fmt::format("{} of {} is {}, and there is no {} or /SET of that id", field->name,
                          name_of(d), c.resolved(*d.block, field->ref, cell->integer),
                          kind_name(field->ref)));
  }
}

void check_empty_target(const LintContext& c, const Rule& rule, Reporter& r) {
  for_each_demand(
      c, &Field::empty,
      [&](const DecodedBlock& d, const Cell& cell, std::int64_t id, int message_id) {
        const std::string_view kind = cell.field->ref;
        if (id <= 0 || !selection_exists(c, kind, id) || !selection_is_empty(c, kind, id)) return;
        Finding& found = r.report(rule, *d.block, cell.span,
                                  fmt::format("{} of {} is {}, and {} is empty", cell.field->name,
                                              name_of(d), id, selection_name(c, kind, id)));
        set_message(found, message_id);
        note_definition(c, found, kind, id);
      });
}

/// Uses the schema: the line of the id may be missing.
void check_required_target(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& d : c.blocks_with_checked_ids)
    for (const CardSchema& card : d.block->schema->cards)
      for (const Field& field : card.fields) {
        const int version = d.block->version;
        if (!field.required || !card.in_version(version) || !field.in_version(version)) continue;
        const Cell* cell = d.find(field.name);
        if (cell != nullptr && cell->integer != 0) continue;
        Finding& found = r.report(
            rule, *d.block, place_of(d, cell),
            fmt::format("{} of {} names no {}", field.name, name_of(d), kind_name(field.ref)));
        set_message(found, *field.required);
      }
}

/// Name of the blocks that share ids, from the schema; "th/*": one family per kind of /TH. Keywords
/// without id: only one block may exist.
std::string id_family(const Block& block) {
  const std::string& name = block.schema->unique;
  return name.ends_with("/*") ? std::string(names_of(block)) : name;
}

void check_twice(const LintContext& c, const Rule& rule, Reporter& r) {
  std::map<std::pair<std::string, std::int64_t>, const Block*> first;
  for (const Block& block : c.deck.blocks) {
    const Schema* s = block.schema;
    if (s == nullptr || s->unique.empty() ||
        (s->has_id && (!block.id.present || block.id.value == 0)))
      continue;
    const std::int64_t id = c.resolved(block, s->kind, block.id.value);
    const auto [it, fresh] = first.try_emplace({id_family(block), id}, &block);
    if (fresh) continue;
    Finding& d =
        r.report(rule, block, block.header_span,
                 s->has_id ? fmt::format("the id {} of {} is used twice", id, names_of(block))
                           : fmt::format("{} is given twice", s->keyword));
    if (!s->has_id) set_message(d, s->stop("id").value_or(0));
    d.notes.emplace_back(it->second->header_span, "first used here");
  }
}

/// Interfaces and, for DK191, frictions.
void check_defined_twice(const LintContext& c, const Rule& rule, Reporter& r) {
  const bool friction = rule.id == RuleId::DK191;
  const auto all = c.defined.find(friction ? "friction" : "inter");
  if (all == c.defined.end()) return;
  std::map<std::int64_t, const Block*> first;
  for (const auto& [id, block] : all->second) {
    if (block->schema->keyword == "/INTER/SUB") continue;
    const auto [it, fresh] = first.try_emplace(id, block);
    if (fresh) continue;
    r.report(rule, *block, block->header_span,
             friction ? fmt::format("/FRICTION {} is defined twice", id)
                      : fmt::format("interface id {} is used twice", id))
        .notes.emplace_back(it->second->header_span,
                            friction ? "first defined here" : "first used here");
  }
}

// ---- codes, walls and particles
// -------------------------------------------------------------------

/// Legal values, if the cell is illegal; else empty.
std::string legal_codes(const Cell& cell) {
  const Field& f = *cell.field;
  const std::string_view text = trim(cell.text);
  if (f.type == FieldType::flag)
    return text.empty() || text == "0" || text == "1" ? std::string() : "0 and 1";
  if (std::find(f.words.begin(), f.words.end(), text) != f.words.end()) return {};
  return fmt::format("{}", fmt::join(f.words, ", "));
}

void check_codes(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& d : c.blocks_with_checked_ids) {
    if (acts_on_nothing(c, d) != nullptr) continue;  // reported by DK138
    for_each_cell(d, [&](const DecodedCard& card, const Cell& cell) {
      if (!cell.field->wrong || card.missing()) return;
      const std::string legal = legal_codes(cell);
      const bool digit = cell.text.find_first_of("23456789") == 0;
      // For most keywords a letter is 0.
      const int stop = digit || cell.field->type != FieldType::flag
                           ? *cell.field->wrong
                           : d.block->schema->stop("flag").value_or(Schema::goes_on);
      if (legal.empty() || stop == Schema::goes_on) return;
      Finding& found = r.report(
          rule, *d.block, place_of(d, &cell),
          fmt::format("{} of {} is {}; legal: {}", cell.field->name, name_of(d),
                      cell.blank() ? "blank" : fmt::format("'{}'", clipped(trim(cell.text))),
                      legal));
      if (stop > 0) found.reference = {stop, Severity::error};
    });
  }
}

void check_normal(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& d : c.blocks_with_checked_ids) {
    const std::string& keyword = d.block->schema->keyword;
    if (keyword != "/RWALL/PLANE" && keyword != "/RWALL/CYL") continue;
    // The first point of a moving wall is a node.
    if (d.integer("node_ID") != 0) continue;
    if (d.real("XM") != d.real("XM1") || d.real("YM") != d.real("YM1") ||
        d.real("ZM") != d.real("ZM1"))
      continue;
    r.report(
        rule, *d.block, place_of(d, "XM1"),
        fmt::format("both points of {} are at ({}, {}, {})", name_of(d), number_text(d.real("XM")),
                    number_text(d.real("YM")), number_text(d.real("ZM"))));
  }
}

/// A particle in more boundaries gets a solver warning.
constexpr int most_boundaries = 2;

void check_corners(const LintContext& c, const Rule& rule, Reporter& r) {
  std::map<NodeIndex, int> boundaries;
  const Block* last = nullptr;
  for_each_block(c, "/SPHBCS", [&](const Block& block) {
    const DecodedBlock d = decode(c.deck, block);
    const NodeSet* group =
        c.selections->node_group(c.resolved(block, "grnod", d.integer("grnod_ID")));
    if (group == nullptr) return;
    last = &block;
    for (const NodeIndex n : std::set<NodeIndex>(group->nodes.begin(), group->nodes.end()))
      ++boundaries[n];
  });
  std::size_t count = 0;
  NodeIndex first = no_index;
  for (const auto& [node, times] : boundaries) {
    if (times <= most_boundaries) continue;
    if (count++ == 0) first = node;
  }
  if (count == 0) return;
  r.report(rule, *last, last->header_span,
           fmt::format("{} {} in {} or more /SPHBCS; first is node {}", count,
                       count == 1 ? "particle lies" : "particles lie", most_boundaries + 1,
                       c.model->node_id(first)));
}

}  // namespace

std::vector<Checked> target_checks() {
  return {{RuleId::DK120, check_missing_target},  {RuleId::DK121, check_empty_target},
          {RuleId::DK122, check_required_target}, {RuleId::DK128, check_twice},
          {RuleId::DK138, check_acts_on_nothing}, {RuleId::DK191, check_defined_twice},
          {RuleId::DK135, check_codes},           {RuleId::DK137, check_normal},
          {RuleId::DK643, check_corners},         {RuleId::DK179, check_defined_twice}};
}

}  // namespace deck::detail
