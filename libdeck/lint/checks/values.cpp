// Ranges of numbers: signs from the schemas, and bounds that follow from what a value means.
#include <algorithm>
#include <cmath>
#include <vector>

#include "lint/check.hpp"
#include "lint/check_tables.hpp"

namespace deck::detail {
namespace {

struct SignRule {
  RuleId id;
  std::vector<std::string_view> fields;
};

const std::vector<SignRule>& sign_rules() {
  static const std::vector<SignRule> rules = {
      {RuleId::DK221, {"Gapmin", "Gap"}},
      {RuleId::DK222, {"Gapmax"}},
      {RuleId::DK223, {"Stfac"}},
      {RuleId::DK224, {"Fric", "Fric_pair", "Fric_dir2"}},
      {RuleId::DK225, {"VISs"}},
      {RuleId::DK226, {"VISF", "VISF_pair", "VISF_dir2"}},
      {RuleId::DK227, {"Bumult"}},
      {RuleId::DK228, {"Fscalegap", "Edge_scale_gap"}},
      {RuleId::DK229, {"Fpenmax"}},
      {RuleId::DK230, {"Stmin", "Stmax"}},
      {RuleId::DK231, {"%mesh_size"}},
      {RuleId::DK232, {"dtmin"}},
      {RuleId::DK233, {"Tstart", "Tstop"}},
      {RuleId::DK235, {"Kthe", "Rthe", "Frad", "Drad"}},
      {RuleId::DK236, {"NRadm", "Padm", "Angladm"}},
  };
  return rules;
}

double number_of(const Cell& cell) {
  return cell.field->type == FieldType::real ? cell.real : static_cast<double>(cell.integer);
}

void check_sign_in(const Rule& rule, const std::vector<std::string_view>& fields,
                   const DecodedBlock& block, Reporter& r) {
  for (const DecodedCard& card : block.cards)
    for (const Cell& cell : card.cells) {
      if (cell.blank() || !(number_of(cell) < 0)) continue;
      if (std::find(fields.begin(), fields.end(), cell.field->name) == fields.end()) continue;
      r.report(rule, *block.block, cell.span,
               fmt::format("{} of {} {} is negative: {}", cell.field->name,
                           block.block->schema->keyword, block.block->id.value, cell.text));
    }
}

void check_sign(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const SignRule& s : sign_rules()) {
    if (s.id != rule.id) continue;
    for (const ContactCard& card : c.contacts) check_sign_in(rule, s.fields, card.decoded, r);
    for (const DecodedBlock& block : c.frictions) check_sign_in(rule, s.fields, block, r);
  }
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
      {RuleId::DK221, check_sign}, {RuleId::DK222, check_sign},       {RuleId::DK223, check_sign},
      {RuleId::DK224, check_sign}, {RuleId::DK225, check_sign},       {RuleId::DK226, check_sign},
      {RuleId::DK227, check_sign}, {RuleId::DK228, check_sign},       {RuleId::DK229, check_sign},
      {RuleId::DK230, check_sign}, {RuleId::DK231, check_sign},       {RuleId::DK232, check_sign},
      {RuleId::DK233, check_sign}, {RuleId::DK234, check_heat_share}, {RuleId::DK235, check_sign},
      {RuleId::DK236, check_sign}, {RuleId::DK237, check_fpenmax},    {RuleId::DK238, check_viss},
      {RuleId::DK239, check_fric},
  };
  return all;
}

}  // namespace deck::detail
