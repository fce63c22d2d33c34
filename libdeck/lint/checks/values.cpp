// Values that are not legal. Ranges of numbers: signs, and bounds that follow from what a value
// means. Flags: the legal values come from the schemas, so a rule holds for every keyword and
// version that has the flag; values that deserve a message of their own have a rule of their own.
// For keywords without rules of their own, those of users' schemas above all: what the schema
// allows.
#include <algorithm>
#include <cmath>

#include "lint/check.hpp"

namespace deck::detail {
namespace {

void check_sign_in(const Rule& rule, const DecodedBlock& block, Reporter& r) {
  each_cell(block, [&](const DecodedCard&, const Cell& cell) {
    const std::string& field = cell.field->name;
    if (cell.blank() || !(number_of(cell) < 0) || rule.field(field) == nullptr) return;
    r.report(rule, field, *block.block, cell.span,
             fmt::format("{} of {} is negative: {}", field, name_of(block), cell.text));
  });
}

void check_sign(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts) check_sign_in(rule, card.decoded, r);
  for (const DecodedBlock& block : c.frictions) check_sign_in(rule, block, r);
}

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

/// True for fields without a list of values.
bool is_legal(const Field& f, std::int64_t value) {
  return f.values.empty() || std::find(f.values.begin(), f.values.end(), value) != f.values.end();
}

void add_doc(Diagnostic* d, const Field& f) {
  if (d != nullptr && !f.doc.empty()) d->help += " " + f.name + ": " + f.doc + ".";
}

/// `only`: no other field; empty: all of them.
void check_block(const Rule& rule, const DecodedBlock& block, Reporter& r,
                 std::string_view only = {}) {
  each_cell(block, [&](const DecodedCard&, const Cell& cell) {
    const Field& f = *cell.field;
    if (cell.blank() || cell.status == NumberStatus::not_a_number || is_legal(f, cell.integer) ||
        !is_about(rule, f.name) || (!only.empty() && f.name != only) ||
        special(block.block->schema->keyword, f.name, cell.integer))
      return;
    add_doc(r.report(rule, f.name, *block.block, cell.span,
                     fmt::format("{} of {} is {}; legal values are {}", f.name, name_of(block),
                                 cell.integer, list_of(f.values))),
            f);
  });
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
  const double value = number_of(cell);
  if (value == 0) return {};  // 0 and blank are the default
  if (!within(f, value)) return range_of(f);
  if (f.type == FieldType::real || is_legal(f, cell.integer)) return {};
  return list_of(f.values);
}

/// The solver says something of this value itself, and rules of their own report it.
bool solver_speaks(const Schema& schema, const Cell& cell) {
  const double value = number_of(cell);
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
  each_cell(d, [&](const DecodedCard&, const Cell& cell) {
    if (cell.field == nullptr || !bounded(*cell.field)) return;
    const std::string legal = legal_instead(cell);
    if (legal.empty() || solver_speaks(*d.block->schema, cell)) return;
    add_doc(r.report(rule, *d.block, cell.span,
                     fmt::format("{} of {} is {}; legal: {}", cell.field->name, name_of(d),
                                 clipped(cell.text), legal)),
            *cell.field);
  });
}

}  // namespace

std::span<const Checked> value_checks() {
  static constexpr Checked all[] = {
      {RuleId::DK221, check_sign}, {RuleId::DK201, check_flag}, {RuleId::DK217, check_ibc},
      {RuleId::DK352, check_flag}, {RuleId::DK353, check_flag}, {RuleId::DK354, check_flag},
      {RuleId::DK355, check_flag}, {RuleId::DK356, check_flag},
  };
  return all;
}

std::span<const BlockChecked> bound_checks() {
  static constexpr BlockChecked all[] = {{RuleId::DK096, has_bounds, check_bounds}};
  return all;
}

}  // namespace deck::detail
