// /DEFAULT/INTER: what it changes, where it changes nothing.
// The functions that fill the table are as long as their pages.
#include <algorithm>
#include <map>

#include "lint/check.hpp"
#include "lint/rule_tables.hpp"

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

void add_default_rules(std::vector<Rule>& out) {
  constexpr std::string_view why =
      "A 0 or blank flag of an interface takes the value of the default card, so the interface "
      "card "
      "alone does not say what it does.";
  out.push_back({.id = "DK501",
                 .title = "default card changes interfaces",
                 .severity = Severity::info,
                 .problem = "A flag of /DEFAULT/INTER is used by interfaces that leave it 0.",
                 .why = why,
                 .solver = "it takes the value for every 0 behind the card",
                 .fix = "nothing to do; 'deck params' shows the result",
                 .ignore = "When the default is meant.",
                 .bad = "@/DEFAULT/INTER/TYPE7 Inacti=6\n@/INTER/TYPE7/1\n",
                 .good = "@/DEFAULT/INTER/TYPE7 Inacti=6\n@/INTER/TYPE7/1 Inacti=5\n",
                 .check = check_overrides});
  out.push_back({.id = "DK502",
                 .title = "default card that no interface uses",
                 .severity = Severity::warning,
                 .problem = "No interface takes a value from the card.",
                 .why = "Either there is none of that type, or all flags are given on the cards.",
                 .solver = "it stores the defaults and does not need them",
                 .fix = "delete the card",
                 .ignore = "When a library include brings it along.",
                 .bad = "@/DEFAULT/INTER/TYPE7 Inacti=6\n@/INTER/TYPE7/1 Inacti=5\n",
                 .good = "@/DEFAULT/INTER/TYPE7 Inacti=6\n@/INTER/TYPE7/1\n",
                 .check = check_unused_defaults});
  out.push_back({.id = "DK503",
                 .title = "default card outside the main file",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "/DEFAULT/INTER stands in an include or a submodel.",
                 .why = "Only the main file can set defaults.",
                 .solver = "it ignores the card",
                 .fix = "move the card to the main file, outside submodels",
                 .ignore = "Never.",
                 .bad = "//SUBMODEL/1\npart of it\n\n@/DEFAULT/INTER/TYPE7 Inacti=6\n//ENDSUB\n",
                 .good = "@/DEFAULT/INTER/TYPE7 Inacti=6\n@/INTER/TYPE7/1\n"});
  out.push_back({.id = "DK504",
                 .title = "second default card of a type",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "There are two /DEFAULT/INTER of one type.",
                 .why = "Only one can hold.",
                 .solver = "it stops with an error",
                 .message = 1073,
                 .message_severity = Severity::error,
                 .fix = "keep one of them",
                 .ignore = "Never.",
                 .bad = "@/DEFAULT/INTER/TYPE7 Inacti=6\n@/DEFAULT/INTER/TYPE7 Inacti=5\n"
                        "@/INTER/TYPE7/1\n",
                 .good = "@/DEFAULT/INTER/TYPE7 Inacti=6\n@/DEFAULT/INTER/TYPE11 Inacti=5\n"
                         "@/INTER/TYPE7/1\n"});
  out.push_back(
      {.id = "DK505",
       .title = "default flag out of range",
       .severity = Severity::warning,
       .problem = "A flag of /DEFAULT/INTER has a value that the interface does not know.",
       .why = "The mistake reaches every interface that leaves the flag 0.",
       .solver = "it does not check the value",
       .fix = "write one of the legal values",
       .ignore = "A newer solver knows the value.",
       .bad = "@/DEFAULT/INTER/TYPE7 Iform=3\n@/INTER/TYPE7/1\n",
       .good = "@/DEFAULT/INTER/TYPE7 Iform=2\n@/INTER/TYPE7/1\n",
       .check = check_range});
  out.push_back({.id = "DK506",
                 .title = "default card of a type that has none",
                 .severity = Severity::error,
                 .problem = "There is no /DEFAULT/INTER for that interface type.",
                 .why = "Only types 2, 7, 11, 19, 24 and 25 have defaults.",
                 .solver = "it skips the block as unknown",
                 .message = 100210,
                 .message_severity = Severity::error,
                 .fix = "set the flags on the interface cards",
                 .ignore = "Never.",
                 .bad = "/DEFAULT/INTER/TYPE10\n\n",
                 .good = "@/DEFAULT/INTER/TYPE7 Inacti=6\n@/INTER/TYPE7/1\n",
                 .check = check_no_such_default});
  out.push_back({.id = "DK507",
                 .title = "default card with zeros only",
                 .severity = Severity::info,
                 .problem = "Every field of the default card is 0.",
                 .why = "0 means 'use the built-in default'.",
                 .solver = "it uses the built-in defaults",
                 .fix = "delete the card",
                 .ignore = "When it is a template.",
                 .bad = "@/DEFAULT/INTER/TYPE7 Inacti=0\n@/INTER/TYPE7/1\n",
                 .good = "@/DEFAULT/INTER/TYPE7 Inacti=6\n@/INTER/TYPE7/1\n",
                 .check = check_all_zero});
  out.push_back({.id = "DK508",
                 .title = "default card behind its interfaces",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "/DEFAULT/INTER stands behind interfaces of its type.",
                 .why = "It acts on the interfaces behind it only.",
                 .solver = "it uses the built-in defaults for the interfaces in front of it",
                 .fix = "put the card in front of the interfaces",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1\n@/DEFAULT/INTER/TYPE7 Inacti=6\n",
                 .good = "@/DEFAULT/INTER/TYPE7 Inacti=6\n@/INTER/TYPE7/1\n"});
  out.push_back({.id = "DK509",
                 .title = "default that is not used",
                 .severity = Severity::warning,
                 .problem = "A field of the default card is read and never used.",
                 .why = "Icurv of /DEFAULT/INTER/TYPE19 (versions 140 to 2019) looks like a "
                        "default and is none.",
                 .solver = "it ignores the field",
                 .fix = "set the flag on the interface cards",
                 .ignore = "Never.",
                 .fixable = Fixable::safe,
                 .bad = "@version 140\n@/DEFAULT/INTER/TYPE19 Icurv=3\n@/INTER/TYPE19/1\n",
                 .good = "@version 140\n@/DEFAULT/INTER/TYPE19 Istf=4\n@/INTER/TYPE19/1\n",
                 .check = check_ignored_field});
}

}  // namespace deck::detail
