// Values outside of what the schema of their keyword allows, for keywords without rules of their
// own: those of users' schemas above all.
#include <algorithm>

#include "lint/check.hpp"
#include "lint/check_tables.hpp"
#include "lint/limits.hpp"

namespace deck::detail {
namespace {

bool bounded(const Field& f) { return !f.values.empty() || f.min || f.max; }

/// Contacts, their defaults and frictions have a rule for every field.
bool has_own_rules(const Schema& s) {
  return s.kind == "inter" || s.kind == "friction" || s.keyword.starts_with("/DEFAULT/INTER");
}

bool within(const Field& f, double value) {
  if (f.min && (value < *f.min || (f.min_open && value == *f.min))) return false;
  return !f.max || !(value > *f.max || (f.max_open && value == *f.max));
}

std::string range_of(const Field& f) {
  const auto bound = [](double v, bool open, std::string_view word) {
    return fmt::format("{} {}{}", word, number_text(v), open ? " (not itself)" : "");
  };
  std::string out;
  if (f.min) out = bound(*f.min, f.min_open, "from");
  if (f.max) out += (out.empty() ? "" : " ") + bound(*f.max, f.max_open, "up to");
  return out;
}

/// What is legal, where the cell is not; empty: it is.
std::string legal_instead(const Cell& cell) {
  const Field& f = *cell.field;
  if (cell.status != NumberStatus::ok && cell.status != NumberStatus::implicit_exponent) return {};
  const bool real = f.type == FieldType::real;
  const double value = real ? cell.real : static_cast<double>(cell.integer);
  if (value == 0) return {};  // 0 and blank are the default
  if (!within(f, value)) return range_of(f);
  if (real || f.values.empty() ||
      std::find(f.values.begin(), f.values.end(), cell.integer) != f.values.end())
    return {};
  return list_of(f.values);
}

/// The solver says something of this value itself, and rules of their own report it.
bool solver_speaks(const Schema& schema, const Cell& cell) {
  const double value =
      cell.field->type == FieldType::real ? cell.real : static_cast<double>(cell.integer);
  const auto& limits = limits_of(schema);
  return std::any_of(limits.begin(), limits.end(), [&](const Limit* limit) {
    return limit->of.field == cell.field->name && limit->when.empty() && !limit->sum &&
           limit->not_a.empty() && limit->of.holds(value);
  });
}

bool has_bounds(const Rule&, const Schema& schema) {
  return !has_own_rules(schema) &&
         std::any_of(schema.cards.begin(), schema.cards.end(), [](const CardSchema& card) {
           return std::any_of(card.fields.begin(), card.fields.end(), bounded);
         });
}

void check_bounds(const LintContext&, const Rule& rule, Reporter& r, const DecodedBlock& d) {
  const Block& block = *d.block;
  for (const DecodedCard& card : d.cards)
    for (const Cell& cell : card.cells) {
      if (cell.field == nullptr || !bounded(*cell.field)) continue;
      const std::string legal = legal_instead(cell);
      if (legal.empty() || solver_speaks(*block.schema, cell)) continue;
      Diagnostic* found =
          r.report(rule, block, cell.span,
                   fmt::format("{} of {} {} is {}; legal: {}", cell.field->name,
                               block.schema->keyword, block.id.value, clipped(cell.text), legal));
      if (found != nullptr && !cell.field->doc.empty())
        found->help += " " + cell.field->name + ": " + cell.field->doc + ".";
    }
}

}  // namespace

std::span<const BlockChecked> bound_checks() {
  static constexpr BlockChecked all[] = {{RuleId::DK096, has_bounds, check_bounds}};
  return all;
}

}  // namespace deck::detail
