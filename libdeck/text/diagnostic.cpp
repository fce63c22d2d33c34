// Counts findings by rule and drops those beyond the limit; the text of an id.
#include "deck/text.hpp"

#include <array>

namespace deck {
namespace {

constexpr int ids = 1000;
constexpr std::size_t id_length = 5;
/// "DK000DK001DK002..."
constexpr auto id_texts = [] {
  std::array<char, ids * id_length> out{};
  for (std::size_t n = 0; n < ids; ++n) {
    char* const at = out.data() + n * id_length;
    at[0] = 'D';
    at[1] = 'K';
    at[2] = static_cast<char>('0' + n / 100);
    at[3] = static_cast<char>('0' + n / 10 % 10);
    at[4] = static_cast<char>('0' + n % 10);
  }
  return out;
}();

}  // namespace

std::string_view id_text(RuleId id) {
  const int n = id_number(id);
  if (n <= 0 || n >= ids) return {};
  return {id_texts.data() + static_cast<std::size_t>(n) * id_length, id_length};
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
