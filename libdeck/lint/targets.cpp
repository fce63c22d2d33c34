// What an id on a card refers to: existence and size of the target.
#include "lint/targets.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "model/shared/families.hpp"

namespace deck::detail {

std::string_view kind_name(std::string_view kind) {
  using Name = std::pair<std::string_view, std::string_view>;
  static constexpr std::array<Name, 14> names = {
      Name{"grnod", "/GRNOD"},       Name{"surf", "/SURF"},     Name{"line", "/LINE"},
      Name{"funct", "/FUNCT"},       Name{"sensor", "/SENSOR"}, Name{"skew", "/SKEW"},
      Name{"frame", "/FRAME"},       Name{"prop", "/PROP"},     Name{"mat", "/MAT"},
      Name{"friction", "/FRICTION"}, Name{"part", "/PART"},     Name{"node", "node"},
      Name{"subset", "/SUBSET"},     Name{"inter", "/INTER"}};
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
  if (kind == "grnod" || kind == "surf" || kind == "line") {
    return selection_exists(c, kind, id);
  }
  if (kind == "node") {
    return c.model->find_node(id) != no_index;
  }
  if (const auto family = family_of_kind(kind)) {
    return c.model->family(*family).map.find(id) != no_index;
  }
  if (kind_name(kind) == "/SET") return std::nullopt;
  const auto all = c.defined.find(kind);
  return all != c.defined.end() && all->second.count(id) > 0;
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
  // One wrong group is an error; without a single node the solver does not look at such blocks.
  return c.any_acts ? nullptr : field;
}

}  // namespace deck::detail
