// The pages of the rules that are compiled in.
#include "deck/text/rule.hpp"

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "base/embedded.hpp"
#include "text/rule_page.hpp"

namespace deck {

const std::vector<Rule>& all_rules() {
  static const std::vector<Rule> rules = [] {
    std::vector<Rule> out;
    for (const auto& file : detail::embedded_rules()) {
      Result<Rule> rule = detail::parse_rule_page(file.name, file.text);
      // The tests parse every page: this is a library that nobody has tested.
      if (!rule) throw std::logic_error(rule.error().message);
      out.push_back(std::move(*rule));
    }
    std::sort(out.begin(), out.end(), [](const Rule& a, const Rule& b) { return a.id < b.id; });
    return out;
  }();
  return rules;
}

const Rule* find_rule(std::string_view id) {
  const auto& rules = all_rules();
  const auto it =
      std::lower_bound(rules.begin(), rules.end(), id,
                       [](const Rule& r, std::string_view key) { return id_text(r.id) < key; });
  return it != rules.end() && id_text(it->id) == id ? &*it : nullptr;
}

const Rule& rule_of(RuleId id) {
  const auto& rules = all_rules();
  const auto it = std::lower_bound(rules.begin(), rules.end(), id,
                                   [](const Rule& r, RuleId key) { return r.id < key; });
  if (it == rules.end() || it->id != id) throw std::logic_error("no rule has this id");
  return *it;
}

ReferenceMessage Rule::message(int number) const {
  const auto it = std::find_if(messages.begin(), messages.end(),
                               [&](const ReferenceMessage& m) { return m.number == number; });
  assert(it != messages.end() && "a message that the page does not name");
  return it != messages.end() ? *it : ReferenceMessage{number, severity()};
}

Diagnostic finding_of(RuleId id, Span span, std::string message, Case particular) {
  const Rule& rule = rule_of(id);
  Diagnostic d;
  d.rule = id;
  d.severity = particular.severity.value_or(rule.severity());
  assert(std::find(rule.severities.begin(), rule.severities.end(), d.severity) !=
             rule.severities.end() &&
         "a severity that the page does not name");
  d.span = span;
  d.message = std::move(message);
  d.reference_behaviour = particular.solver.empty() ? rule.solver : std::move(particular.solver);
  d.help = particular.fix.empty() ? rule.fix : std::move(particular.fix);
  if (particular.message) {
    if (*particular.message != 0) d.reference = rule.message(*particular.message);
  } else if (!rule.messages.empty()) {
    d.reference = rule.messages.front();
  }
  return d;
}

}  // namespace deck
