// One rule per flag: the legal values come from the schemas, so a rule holds for every keyword and
// version that has the flag. Values that deserve a message of their own have a rule of their own.
#include <algorithm>
#include <cmath>

#include "lint/check.hpp"
#include "lint/check_tables.hpp"

namespace deck::detail {
namespace {

struct FlagRule {
  RuleId id;
  std::string_view field;
};

constexpr FlagRule flag_rules[] = {
    {RuleId::DK201, "Istf"},      {RuleId::DK202, "Igap"},     {RuleId::DK203, "Ibag"},
    {RuleId::DK204, "Idel"},      {RuleId::DK205, "Icurv"},    {RuleId::DK206, "Iadm"},
    {RuleId::DK207, "Inacti"},    {RuleId::DK208, "Ifric"},    {RuleId::DK209, "Ifiltr"},
    {RuleId::DK210, "Iform"},     {RuleId::DK211, "Irem_gap"}, {RuleId::DK212, "Irem_i2"},
    {RuleId::DK213, "Ithe"},      {RuleId::DK214, "ITIED"},    {RuleId::DK215, "Iedge"},
    {RuleId::DK216, "Ithe_form"}, {RuleId::DK218, "Idir"},     {RuleId::DK352, "Spotflag"},
    {RuleId::DK353, "Ignore"},    {RuleId::DK354, "Isearch"},  {RuleId::DK355, "Idel2"},
    {RuleId::DK356, "Rupt"},
};

/// Values with a rule of their own.
bool special(std::string_view keyword, std::string_view field, std::int64_t value) {
  if (keyword == "/INTER/TYPE19")
    return (field == "Istf" && value == 6) || (field == "Idel" && value == 3) || field == "Iedge";
  if (keyword == "/INTER/TYPE11") return field == "Igap" && value == 2;
  return keyword == "/INTER/TYPE10" && field == "Inacti" && value == 5;
}

void check_block(const Rule& rule, std::string_view field, const DecodedBlock& block, Reporter& r) {
  for (const DecodedCard& card : block.cards)
    for (const Cell& cell : card.cells) {
      const Field& f = *cell.field;
      if (f.name != field || f.values.empty() || cell.blank() ||
          cell.status == NumberStatus::not_a_number)
        continue;
      if (std::find(f.values.begin(), f.values.end(), cell.integer) != f.values.end()) continue;
      if (special(block.block->schema->keyword, field, cell.integer)) continue;
      Diagnostic* d = r.report(rule, *block.block, cell.span,
                               fmt::format("{} of {} {} is {}; legal values are {}", f.name,
                                           block.block->schema->keyword, block.block->id.value,
                                           cell.integer, list_of(f.values)));
      if (d != nullptr && !f.doc.empty()) d->help += " " + f.name + ": " + f.doc + ".";
    }
}

void check_flag(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const FlagRule& f : flag_rules) {
    if (f.id != rule.id) continue;
    for (const ContactCard& card : c.contacts) check_block(rule, f.field, card.decoded, r);
    for (const DecodedBlock& block : c.frictions) check_block(rule, f.field, block, r);
    // Iedge is read from /DEFAULT only; the other flags of a default have DK505.
    if (f.field == "Iedge")
      for (const DecodedBlock& block : c.defaults) check_block(rule, f.field, block, r);
  }
}

void check_ibc(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts)
    for (const std::string_view name : {"IBCX", "IBCY", "IBCZ"}) {
      const Cell* cell = card.decoded.find(name);
      if (cell == nullptr || cell->blank() || cell->text == "0" || cell->text == "1") continue;
      Diagnostic* d = r.report(rule, *card.block, cell->span,
                               fmt::format("column {} ({}) of {} holds '{}'; only 1 has an effect",
                                           cell->field->first, name, name_of(card), cell->text));
      if (d != nullptr) d->fix = Fix{"write 0", true, {{cell->span, "0"}}};
    }
}

}  // namespace

std::span<const Checked> flag_checks() {
  static constexpr Checked all[] = {
      {RuleId::DK201, check_flag}, {RuleId::DK202, check_flag}, {RuleId::DK203, check_flag},
      {RuleId::DK204, check_flag}, {RuleId::DK205, check_flag}, {RuleId::DK206, check_flag},
      {RuleId::DK207, check_flag}, {RuleId::DK208, check_flag}, {RuleId::DK209, check_flag},
      {RuleId::DK210, check_flag}, {RuleId::DK211, check_flag}, {RuleId::DK212, check_flag},
      {RuleId::DK213, check_flag}, {RuleId::DK214, check_flag}, {RuleId::DK215, check_flag},
      {RuleId::DK216, check_flag}, {RuleId::DK217, check_ibc},  {RuleId::DK218, check_flag},
      {RuleId::DK352, check_flag}, {RuleId::DK353, check_flag}, {RuleId::DK354, check_flag},
      {RuleId::DK355, check_flag}, {RuleId::DK356, check_flag},
  };
  return all;
}

}  // namespace deck::detail
