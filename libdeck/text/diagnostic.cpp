// Counts findings by rule and drops those beyond the limit; the text of an id.
#include "deck/text.hpp"

#include <fmt/format.h>

#include <vector>

#include "text/shared/rule_page.hpp"

namespace deck {
std::string_view id_text(RuleId id) {
  static const std::vector<std::string> texts = [] {
    std::vector<std::string> out;
    for (int n = 0; n < 2 * first_team_id; ++n)
      out.push_back(fmt::format("{}{:03}", n < first_team_id ? "DK" : "X", n % first_team_id));
    return out;
  }();
  const auto n = static_cast<std::size_t>(id);
  return n % first_team_id == 0 || n >= texts.size() ? std::string_view() : texts[n];
}

std::string finding_name(const Diagnostic& diagnostic) {
  std::string out(id_text(diagnostic.rule));
  return diagnostic.field.empty() ? out : out + ":" + diagnostic.field;
}

bool Diagnostics::wants(RuleId rule) {
  return ++counts_[rule] <= static_cast<std::uint64_t>(per_rule_);
}

Diagnostic& Diagnostics::add(Diagnostic d) {
  kept_.push_back(std::move(d));
  return kept_.back();
}

void Diagnostics::report(Diagnostic d) {
  if (wants(d.rule)) kept_.push_back(std::move(d));
}

void Diagnostics::count(RuleId rule, std::uint64_t n) {
  if (n > 0) counts_[rule] += n;
}

bool Diagnostics::saturated(RuleId rule) const {
  const auto it = counts_.find(rule);
  return (it == counts_.end() ? 0 : it->second) >= static_cast<std::uint64_t>(per_rule_);
}

void Diagnostics::merge(Diagnostics&& other) {
  std::map<RuleId, std::uint64_t> kept;
  for (Diagnostic& d : other.kept_) {
    ++kept[d.rule];
    report(std::move(d));
  }
  for (const auto& [rule, count] : other.counts_) counts_[rule] += count - kept[rule];
}

std::uint64_t Diagnostics::dropped(RuleId rule) const {
  const auto it = counts_.find(rule);
  if (it == counts_.end()) return 0;
  std::uint64_t kept = 0;
  for (const Diagnostic& d : kept_) kept += d.rule == rule;
  return it->second - kept;
}

}  // namespace deck
