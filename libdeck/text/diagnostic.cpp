// Counts findings by rule and drops those beyond the limit.
#include "deck/text/diagnostic.hpp"

namespace deck {

bool Diagnostics::wants(std::string_view rule) {
  return ++counts_[rule] <= static_cast<std::uint64_t>(per_rule_);
}

Diagnostic& Diagnostics::add(Diagnostic d) {
  kept_.push_back(std::move(d));
  return kept_.back();
}

void Diagnostics::report(Diagnostic d) {
  if (wants(d.rule)) kept_.push_back(std::move(d));
}

void Diagnostics::count(std::string_view rule, std::uint64_t n) {
  if (n > 0) counts_[rule] += n;
}

bool Diagnostics::saturated(std::string_view rule) const {
  const auto it = counts_.find(rule);
  return (it == counts_.end() ? 0 : it->second) >= static_cast<std::uint64_t>(per_rule_);
}

void Diagnostics::merge(Diagnostics&& other) {
  std::map<std::string_view, std::uint64_t> kept;
  for (Diagnostic& d : other.kept_) {
    ++kept[d.rule];
    report(std::move(d));
  }
  for (const auto& [rule, count] : other.counts_) counts_[rule] += count - kept[rule];
}

std::uint64_t Diagnostics::dropped(std::string_view rule) const {
  const auto it = counts_.find(rule);
  if (it == counts_.end()) return 0;
  std::uint64_t kept = 0;
  for (const Diagnostic& d : kept_) kept += d.rule == rule;
  return it->second - kept;
}

}  // namespace deck
