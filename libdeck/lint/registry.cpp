// Families and selectors of rules; the list of all checks.
#include <algorithm>

#include "lint/check.hpp"
#include "text/shared/rule_page.hpp"

namespace deck {

std::string_view family_of(RuleId id) {
  if (is_team_rule(id)) return "rules of the team";
  static constexpr std::string_view of_hundreds[] = {
      "syntax, columns, version",
      "references and kinds of entities",
      "contact options",
      "geometry",
      "cost and stability",
      "defaults",
      "model: what the solver warns of or takes as it is",
      "other",
      "Starter and Engine",
      "advice"};
  return of_hundreds[std::min(id_number(id) / 100, 9)];
}

bool selects(std::string_view selector, RuleId id, std::string_view field) {
  if (selector == "all") return true;
  if (!selector.starts_with("DK") && !selector.starts_with('X')) return false;
  if (const auto colon = selector.find(':'); colon != selector.npos)
    return !field.empty() && selector.substr(0, colon) == id_text(id) &&
           selector.substr(colon + 1) == field;
  if (id_text(id).starts_with(selector)) return true;
  const RuleField* const f = field.empty() ? nullptr : rule_of(id).field(field);
  return f != nullptr && id_text(f->was).starts_with(selector);
}

std::string to_selector(std::string_view text) {
  const auto colon = std::min(text.find(':'), text.size());
  const Rule* const rule = find_rule(text.substr(0, colon));
  return std::string(rule != nullptr ? id_text(rule->id) : text.substr(0, colon)) +
         std::string(text.substr(colon));
}

bool known_selector(std::string_view text) {
  const std::string selector = to_selector(text);
  return std::any_of(all_rules().begin(), all_rules().end(), [&](const Rule& r) {
    return detail::any_name(r,
                            [&](std::string_view field) { return selects(selector, r.id, field); });
  });
}

std::string renamed_selector(std::string_view selector) {
  const Rule* const rule = find_successor(selector);
  if (rule == nullptr) return {};
  std::string out;
  for (const RuleField& f : rule->fields)
    if (id_text(f.was) == selector)
      out += (out.empty() ? " is now " : ", ") + std::string(id_text(rule->id)) + ":" + f.name;
  return std::string(selector) + out;
}

const std::vector<detail::Checked>& detail::all_checks() {
  static const std::vector<Checked> checks = [] {
    std::vector<Checked> out;
    for (const auto& table :
         {cell_checks(), header_checks(), target_checks(), history_checks(), physics_checks(),
          element_checks(), reference_checks(), value_checks(), line_checks(), default_checks(),
          pitfall_checks(), engine_checks(), silent_change_checks(), kinematic_checks(),
          sense_checks()})
      out.insert(out.end(), table.begin(), table.end());
    std::sort(out.begin(), out.end(),
              [](const Checked& a, const Checked& b) { return a.id < b.id; });
    return out;
  }();
  return checks;
}

}  // namespace deck
