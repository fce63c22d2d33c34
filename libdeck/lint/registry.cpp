// The list of all rules, ordered by id.
#include <algorithm>

#include "deck/lint/rule.hpp"
#include "lint/rule_tables.hpp"

namespace deck {

std::string_view family_of(std::string_view rule_id) {
  if (rule_id.size() < 3) return "other";
  switch (rule_id[2]) {
    case '0':
      return "syntax, columns, version";
    case '1':
      return "references and kinds of entities";
    case '2':
      return "contact options";
    case '3':
      return "geometry";
    case '4':
      return "cost and stability";
    case '5':
      return "defaults";
    case '8':
      return "Starter and Engine";
    case '9':
      return "advice";
    default:
      return "other";
  }
}

const std::vector<Rule>& all_rules() {
  static const std::vector<Rule> rules = [] {
    std::vector<Rule> out;
    detail::add_reading_rules(out);
    detail::add_header_rules(out);
    detail::add_linter_rules(out);
    detail::add_model_rules(out);
    detail::add_target_demand_rules(out);
    detail::add_physics_rules(out);
    detail::add_element_rules(out);
    detail::add_reference_rules(out);
    detail::add_flag_rules(out);
    detail::add_value_rules(out);
    detail::add_line_rules(out);
    detail::add_combination_rules(out);
    detail::add_ignored_rules(out);
    detail::add_manual_rules(out);
    detail::add_difference_rules(out);
    detail::add_companion_rules(out);
    detail::add_geometry_rules(out);
    detail::add_bound_rules(out);
    detail::add_default_rules(out);
    detail::add_advice_rules(out);
    for (Rule& r : out) r.types = detail::interface_types_of(r.id);
    std::sort(out.begin(), out.end(), [](const Rule& a, const Rule& b) { return a.id < b.id; });
    return out;
  }();
  return rules;
}

const Rule* find_rule(std::string_view id) {
  const auto& rules = all_rules();
  const auto it = std::lower_bound(rules.begin(), rules.end(), id,
                                   [](const Rule& r, std::string_view key) { return r.id < key; });
  return it != rules.end() && it->id == id ? &*it : nullptr;
}

bool selects(std::string_view selector, std::string_view rule_id) {
  return selector == "all" || (selector.starts_with("DK") && rule_id.starts_with(selector));
}

bool known_selector(std::string_view selector) {
  return std::any_of(all_rules().begin(), all_rules().end(),
                     [&](const Rule& r) { return selects(selector, r.id); });
}

}  // namespace deck
