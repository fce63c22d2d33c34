// Counts findings by rule and drops those beyond the limit; the text of an id.
#include "deck/text.hpp"

#include <array>

#include "text/shared/rule_page.hpp"

namespace deck {
namespace {

constexpr std::size_t ids = 2 * first_team_id;
constexpr std::size_t id_length = 5;
/// "DK000DK001DK002...", then "X000 X001 ..."
constexpr auto id_texts = [] {
  std::array<char, ids * id_length> out{};
  for (std::size_t n = 0; n < ids; ++n) {
    const bool team = n >= first_team_id;
    char* at = out.data() + n * id_length;
    *at++ = team ? 'X' : 'D';
    if (!team) *at++ = 'K';
    *at++ = static_cast<char>('0' + n / 100 % 10);
    *at++ = static_cast<char>('0' + n / 10 % 10);
    *at++ = static_cast<char>('0' + n % 10);
  }
  return out;
}();

}  // namespace

std::string_view id_text(RuleId id) {
  const auto n = static_cast<std::size_t>(id);
  if (n % first_team_id == 0 || n >= ids) return {};
  return {id_texts.data() + n * id_length, is_team_rule(id) ? id_length - 1 : id_length};
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
