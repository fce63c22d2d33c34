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

std::string finding_name(const Finding& finding) {
  std::string out(id_text(finding.rule));
  return finding.field.empty() ? out : out + ":" + finding.field;
}

bool Findings::wants(RuleId rule) {
  return ++counts_[rule] <= static_cast<std::uint64_t>(per_rule_);
}

Finding& Findings::add(Finding d) {
  kept_.push_back(std::move(d));
  return kept_.back();
}

void Findings::report(Finding d) {
  if (wants(d.rule)) kept_.push_back(std::move(d));
}

void Findings::count(RuleId rule, std::uint64_t n) {
  if (n > 0) counts_[rule] += n;
}

bool Findings::saturated(RuleId rule) const {
  const auto it = counts_.find(rule);
  return (it == counts_.end() ? 0 : it->second) >= static_cast<std::uint64_t>(per_rule_);
}

void Findings::merge(Findings&& other) {
  std::map<RuleId, std::uint64_t> kept;
  for (Finding& d : other.kept_) {
    ++kept[d.rule];
    report(std::move(d));
  }
  for (const auto& [rule, count] : other.counts_) counts_[rule] += count - kept[rule];
}

std::uint64_t Findings::dropped(RuleId rule) const {
  const auto it = counts_.find(rule);
  if (it == counts_.end()) return 0;
  std::uint64_t kept = 0;
  for (const Finding& d : kept_) kept += d.rule == rule;
  return it->second - kept;
}

}  // namespace deck
