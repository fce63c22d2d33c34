// /DEFAULT/INTER: what it changes, where it changes nothing.
// The functions that fill the table are as long as their pages.
#include <algorithm>
#include <map>

#include "lint/check.hpp"
#include "lint/check_tables.hpp"

namespace deck::detail {
namespace {

/// Number of TYPEn, 0 if the keyword is of another kind.
int type_of(std::string_view keyword) {
  const auto at = keyword.rfind("TYPE");
  int n = 0;
  if (at == std::string_view::npos) return 0;
  for (const char k : keyword.substr(at + 4))
    if (k >= '0' && k <= '9') n = n * 10 + (k - '0');
  return n;
}

/// True if the model stage took the default block into account.
bool honoured(const LintContext& c, const DecodedBlock& block) {
  return c.interfaces != nullptr &&
         std::any_of(c.interfaces->defaults.begin(), c.interfaces->defaults.end(),
                     [&](const DefaultInter& d) { return d.span == block.span(); });
}

/// Interfaces whose field takes its value from this cell.
std::vector<const ContactCard*> takers(const LintContext& c, const DecodedBlock& block,
                                       const Cell& cell) {
  std::vector<const ContactCard*> out;
  const int type = type_of(block.block->schema->keyword);
  for (const ContactCard& card : c.contacts) {
    if (card.type != type) continue;
    const FieldView* f = card.find(cell.field->name);
    if (f != nullptr && f->origin == Origin::default_block) out.push_back(&card);
  }
  return out;
}

/// Types whose interfaces this program types: only there it is known who takes a default.
bool typed(const DecodedBlock& block) {
  const int type = type_of(block.block->schema->keyword);
  return type == 7 || type == 11 || type == 19;
}

void check_overrides(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& block : c.defaults) {
    if (!honoured(c, block)) continue;
    for (const DecodedCard& card : block.cards)
      for (const Cell& cell : card.cells) {
        if (cell.integer == 0 || cell.field->ignored) continue;
        const auto who = takers(c, block, cell);
        if (who.empty()) continue;
        std::string ids;
        constexpr std::size_t shown = 8;
        for (std::size_t i = 0; i < std::min(shown, who.size()); ++i)
          ids += (i > 0 ? ", " : "") + std::to_string(who[i]->block->id.value);
        if (who.size() > shown) ids += " and " + std::to_string(who.size() - shown) + " more";
        r.report(rule, *block.block, cell.span,
                 fmt::format("{} = {} applies to {} interface{}: {}", cell.field->name,
                             cell.integer, who.size(), who.size() > 1 ? "s" : "", ids));
      }
  }
}

void check_unused_defaults(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& block : c.defaults) {
    if (!honoured(c, block) || !typed(block)) continue;
    bool any = false, used = false;
    for (const DecodedCard& card : block.cards)
      for (const Cell& cell : card.cells) {
        if (cell.integer == 0 || cell.field->ignored) continue;
        any = true;
        used = used || !takers(c, block, cell).empty();
      }
    if (any && !used)
      r.report(rule, *block.block, block.span(),
               "no interface takes a value from " + block.block->schema->keyword);
  }
}

void check_range(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& block : c.defaults)
    for (const DecodedCard& card : block.cards)
      for (const Cell& cell : card.cells) {
        const Field& f = *cell.field;
        if (f.values.empty() || cell.blank() || f.name == "Iedge") continue;
        if (cell.status == NumberStatus::not_a_number) continue;
        if (std::find(f.values.begin(), f.values.end(), cell.integer) != f.values.end()) continue;
        std::string legal;
        for (const std::int64_t v : f.values)
          legal += (legal.empty() ? "" : ", ") + std::to_string(v);
        r.report(rule, *block.block, cell.span,
                 fmt::format("{} of {} is {}; legal values are {}", f.name,
                             block.block->schema->keyword, cell.integer, legal));
      }
}

void check_no_such_default(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& b : c.deck.blocks)
    if (b.header.starts_with("/DEFAULT/INTER/") && b.schema != nullptr &&
        b.schema->keyword == "/DEFAULT")
      r.report(rule, b, b.header_span,
               "there are no defaults for " + std::string(b.header.substr(15)));
}

void check_all_zero(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& block : c.defaults) {
    bool any = false;
    for (const DecodedCard& card : block.cards)
      for (const Cell& cell : card.cells) any = any || cell.integer != 0;
    if (!any)
      r.report(rule, *block.block, block.span(),
               block.block->schema->keyword + " changes nothing: every field is 0");
  }
}

void check_ignored_field(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& block : c.defaults)
    for (const DecodedCard& card : block.cards)
      for (const Cell& cell : card.cells)
        if (cell.field->ignored && cell.integer != 0) {
          Diagnostic* d = r.report(rule, *block.block, cell.span,
                                   fmt::format("{} of {} has no effect", cell.field->name,
                                               block.block->schema->keyword));
          if (d != nullptr && !card.free_format)
            d->fix = Fix{"blank " + cell.field->name, true, {blank_edit(cell.span)}};
        }
}

}  // namespace

std::span<const Checked> default_checks() {
  static constexpr Checked all[] = {
      {RuleId::DK501, check_overrides}, {RuleId::DK502, check_unused_defaults},
      {RuleId::DK505, check_range},     {RuleId::DK506, check_no_such_default},
      {RuleId::DK507, check_all_zero},  {RuleId::DK509, check_ignored_field},
  };
  return all;
}

}  // namespace deck::detail
