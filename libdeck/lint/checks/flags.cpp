// Values that a flag does not know: the legal ones come from the schemas, so a rule holds for every
// keyword and version that has the flag. Values that deserve a message of their own have a rule of
// their own.
#include <algorithm>
#include <cmath>

#include "lint/check.hpp"
#include "lint/check_tables.hpp"

namespace deck::detail {
namespace {

/// Flags with a rule of their own, of /INTER/TYPE2; DK201 lists the others.
constexpr std::pair<RuleId, std::string_view> own_rules[] = {
    {RuleId::DK352, "Spotflag"}, {RuleId::DK353, "Ignore"}, {RuleId::DK354, "Isearch"},
    {RuleId::DK355, "Idel2"},    {RuleId::DK356, "Rupt"},
};

/// Values with a rule of their own.
bool special(std::string_view keyword, std::string_view field, std::int64_t value) {
  if (keyword == "/INTER/TYPE19")
    return (field == "Istf" && value == 6) || (field == "Idel" && value == 3) || field == "Iedge";
  if (keyword == "/INTER/TYPE11") return field == "Igap" && value == 2;
  return keyword == "/INTER/TYPE10" && field == "Inacti" && value == 5;
}

bool is_about(const Rule& rule, std::string_view field) {
  if (rule.field(field) != nullptr) return true;
  return std::any_of(std::begin(own_rules), std::end(own_rules),
                     [&](const auto& own) { return own == std::pair(rule.id, field); });
}

/// `only`: no other field; empty: all of them.
void check_block(const Rule& rule, const DecodedBlock& block, Reporter& r,
                 std::string_view only = {}) {
  for (const DecodedCard& card : block.cards)
    for (const Cell& cell : card.cells) {
      const Field& f = *cell.field;
      if (f.values.empty() || cell.blank() || cell.status == NumberStatus::not_a_number ||
          std::find(f.values.begin(), f.values.end(), cell.integer) != f.values.end())
        continue;
      if (!is_about(rule, f.name) || (!only.empty() && f.name != only) ||
          special(block.block->schema->keyword, f.name, cell.integer))
        continue;
      Diagnostic* d = r.report(rule, f.name, *block.block, cell.span,
                               fmt::format("{} of {} {} is {}; legal values are {}", f.name,
                                           block.block->schema->keyword, block.block->id.value,
                                           cell.integer, list_of(f.values)));
      if (d != nullptr && !f.doc.empty()) d->help += " " + f.name + ": " + f.doc + ".";
    }
}

void check_flag(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts) check_block(rule, card.decoded, r);
  for (const DecodedBlock& block : c.frictions) check_block(rule, block, r);
  // Iedge is read from /DEFAULT only; the other flags of a default have DK505.
  for (const DecodedBlock& block : c.defaults) check_block(rule, block, r, "Iedge");
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
      {RuleId::DK201, check_flag}, {RuleId::DK217, check_ibc},  {RuleId::DK352, check_flag},
      {RuleId::DK353, check_flag}, {RuleId::DK354, check_flag}, {RuleId::DK355, check_flag},
      {RuleId::DK356, check_flag},
  };
  return all;
}

}  // namespace deck::detail
