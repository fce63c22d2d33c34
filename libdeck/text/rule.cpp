// The built-in rule pages.
#include "deck/text.hpp"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <utility>

#include "base/shared/embedded.hpp"
#include "text/shared/rule_page.hpp"

namespace deck {

static thread_local const std::vector<Rule>* rules_of_thread = nullptr;  // of use_rules()

const std::vector<Rule>& all_rules() {
  if (rules_of_thread != nullptr) return *rules_of_thread;
  static const std::vector<Rule> rules = [] {
    std::vector<Rule> out;
    out.reserve(detail::embedded_rules().size());
    for (const auto& file : detail::embedded_rules()) {
      Result<Rule> rule = detail::parse_rule_page(file.name, file.text);
      // Cannot happen in a tested build: the tests parse every page.
      if (!rule) throw std::logic_error(rule.error().message);
      out.push_back(std::move(*rule));
    }
    std::ranges::sort(out, {}, &Rule::id);
    return out;
  }();
  return rules;
}

std::shared_ptr<void> use_rules(const std::vector<RulePage>& own) {
  if (own.empty()) return {};
  auto all = std::make_unique<std::vector<Rule>>(all_rules());
  for (const RulePage& page : own) all->push_back(page.rule);
  std::ranges::sort(*all, {}, &Rule::id);
  const auto* const before = std::exchange(rules_of_thread, all.get());
  return {all.release(), [before](const std::vector<Rule>* used) {
            rules_of_thread = before;
            delete used;
          }};
}

const Rule* find_rule(std::string_view id_or_name) {
  const auto& rules = all_rules();
  const auto it = std::find_if(rules.begin(), rules.end(), [&](const Rule& r) {
    return id_text(r.id) == id_or_name || r.name == id_or_name;
  });
  return it != rules.end() ? &*it : nullptr;
}

const Rule& rule_of(RuleId id) {
  const auto& rules = all_rules();
  const auto it = std::ranges::lower_bound(rules, id, {}, &Rule::id);
  if (it == rules.end() || it->id != id) throw std::logic_error("no rule has this id");
  return *it;
}

const Rule* find_successor(std::string_view id) {
  for (const Rule& rule : all_rules())
    for (const RuleField& field : rule.fields)
      if (field.was != rule.id && id_text(field.was) == id) return &rule;
  return nullptr;
}

ReferenceMessage Rule::message(int number) const {
  const auto it = std::find_if(messages.begin(), messages.end(),
                               [&](const ReferenceMessage& m) { return m.number == number; });
  assert(it != messages.end() && "a message that its page does not list");
  return it != messages.end() ? *it : ReferenceMessage{number, severity()};
}

namespace {

/// Adds a capital letter and a full stop. Names of fields and of the program are not changed.
std::string sentence(std::string text) {
  if (text.empty()) return text;
  const std::string_view word = std::string_view(text).substr(0, text.find(' '));
  if (text[0] >= 'a' && text[0] <= 'z' && word != "deck" && word.find('_') == word.npos)
    text[0] = static_cast<char>(text[0] - 'a' + 'A');
  if (std::string_view(".!?").find(text.back()) == std::string_view::npos) text += '.';
  return text;
}

}  // namespace

Finding make_finding(RuleId id, Span span, std::string message, Overrides overrides) {
  const Rule& rule = rule_of(id);
  Finding d;
  d.rule = id;
  d.field = overrides.field;
  const RuleField* const field = rule.field(overrides.field);
  assert((field != nullptr || overrides.field.empty()) && "a field that its page does not list");
  const RuleField of_all{};
  const RuleField& own = field != nullptr ? *field : of_all;
  d.severity = overrides.severity.value_or(own.severity.value_or(rule.severity()));
  assert(std::find(rule.severities.begin(), rule.severities.end(), d.severity) !=
             rule.severities.end() &&
         "a severity that its page does not list");
  d.span = span;
  d.message = std::move(message);
  const auto first_of = [](std::string said, const std::string& of_field, const std::string& page) {
    return sentence(!said.empty() ? std::move(said) : !of_field.empty() ? of_field : page);
  };
  d.reference_behaviour = first_of(std::move(overrides.solver), own.solver, rule.solver);
  d.help = first_of(std::move(overrides.fix), own.fix, rule.fix);
  if (overrides.message) {
    if (*overrides.message != 0) d.reference = rule.message(*overrides.message);
  } else if (!rule.messages.empty()) {
    d.reference = rule.messages.front();
  }
  return d;
}

}  // namespace deck
