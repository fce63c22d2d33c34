// Ranges of numbers: signs, and bounds that follow from what a value means.
#include <algorithm>
#include <cmath>

#include "lint/check.hpp"
#include "lint/check_tables.hpp"

namespace deck::detail {
namespace {

double number_of(const Cell& cell) {
  return cell.field->type == FieldType::real ? cell.real : static_cast<double>(cell.integer);
}

void check_sign_in(const Rule& rule, const DecodedBlock& block, Reporter& r) {
  for (const DecodedCard& card : block.cards)
    for (const Cell& cell : card.cells) {
      if (cell.blank() || !(number_of(cell) < 0)) continue;
      const std::string& field = cell.field->name;
      if (rule.field(field) == nullptr) continue;
      r.report(rule, field, *block.block, cell.span,
               fmt::format("{} of {} {} is negative: {}", field, block.block->schema->keyword,
                           block.block->id.value, cell.text));
    }
}

void check_sign(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts) check_sign_in(rule, card.decoded, r);
  for (const DecodedBlock& block : c.frictions) check_sign_in(rule, block, r);
}

void check_heat_share(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    for (const std::string_view name : {"Fheats", "Fheatm"})
      if (const double v = card.input(name); v < 0 || v > 1)
        report_at(r, rule, card, name,
                  fmt::format("{} of {} is {}; it is a share between 0 and 1", name, name_of(card),
                              number_text(v)));
  });
}

/// Fields that are shares or ratios: above 1 they mean something else than people think.
void check_above_one(const LintContext& c, const Rule& rule, Reporter& r, std::string_view field,
                     std::string_view meaning) {
  for (const ContactCard& card : c.contacts)
    if (const double v = card.input(field); v > 1)
      report_at(r, rule, card, field,
                fmt::format("{} of {} is {}{}", field, name_of(card), number_text(v), meaning));
}

void check_fpenmax(const LintContext& c, const Rule& rule, Reporter& r) {
  check_above_one(c, rule, r, "Fpenmax", "; a penetration never exceeds the gap");
}

void check_viss(const LintContext& c, const Rule& rule, Reporter& r) {
  check_above_one(c, rule, r, "VISs", " times the critical damping");
}

void check_fric(const LintContext& c, const Rule& rule, Reporter& r) {
  check_above_one(c, rule, r, "Fric", ", a friction coefficient above 1");
}

}  // namespace

std::span<const Checked> value_checks() {
  static constexpr Checked all[] = {
      {RuleId::DK221, check_sign},    {RuleId::DK234, check_heat_share},
      {RuleId::DK237, check_fpenmax}, {RuleId::DK238, check_viss},
      {RuleId::DK239, check_fric},
  };
  return all;
}

}  // namespace deck::detail
