// /DEFAULT/INTER: what it changes, where it changes nothing.
#include <algorithm>
#include <map>

#include "base/shared/words.hpp"
#include "lint/check.hpp"

namespace deck::detail {
namespace {

/// Number of TYPEn, 0 if the keyword is of another kind.
int type_of(std::string_view keyword) {
  const auto at = keyword.rfind("TYPE");
  return at == keyword.npos ? 0 : static_cast<int>(read_integer(keyword.substr(at + 4)).value);
}

/// Calls f(block) for the default blocks that the model stage took into account.
template <class F>
void each_honoured(const LintContext& c, F&& f) {
  for (const DecodedBlock& block : c.defaults)
    if (std::any_of(c.interfaces->defaults.begin(), c.interfaces->defaults.end(),
                    [&](const DefaultInter& d) { return d.span == block.span(); }))
      f(block);
}

/// An interface that takes values of a default block although it is not evaluated here.
struct OtherTaker {
  std::string_view keyword;
  int type;                ///< of the block
  std::string_view flags;  ///< with blanks around each; empty: all
};
constexpr OtherTaker other_takers[] = {
    {"/INTER/TYPE2", 2, ""},
    {"/INTER/LAGMUL/TYPE2", 2, " Isearch "},
    {"/INTER/LAGDT/TYPE7", 7, " Istf Igap Ibag Idel Inacti Iform "},
    {"/INTER/TYPE24", 24, ""},
    {"/INTER/TYPE25", 25, ""},
};

enum class Takes : std::uint8_t { no, yes, unknown };

/// Whether a 0 of the interface takes this value.
Takes takes(const ContactCard& card, int type, const Field& flag) {
  if (card.type != 0) {
    const FieldView* f = card.type == type ? card.find(flag.name) : nullptr;
    return f != nullptr && f->origin == Origin::default_block ? Takes::yes : Takes::no;
  }
  for (const OtherTaker& other : other_takers) {
    if (other.type != type || card.block->schema->keyword != other.keyword) continue;
    if (!other.flags.empty() && other.flags.find(" " + flag.name + " ") == other.flags.npos)
      return Takes::no;
    // TYPE2 calls it by another name than its default block.
    std::string_view name = flag.name;
    if (type == 2 && name == "Idel") name = "Idel2";
    if (card.block->schema->find_field(name) == nullptr) return Takes::unknown;
    return card.given(name) ? Takes::no : Takes::yes;
  }
  return Takes::no;
}

/// Interfaces whose flag takes its value from this cell, or may take it.
std::vector<const ContactCard*> takers(const LintContext& c, const DecodedBlock& block,
                                       const Cell& cell, Takes how) {
  std::vector<const ContactCard*> out;
  const int type = type_of(block.block->schema->keyword);
  for (const ContactCard& card : c.contacts)
    if (takes(card, type, *cell.field) == how) out.push_back(&card);
  return out;
}

void check_overrides(const LintContext& c, const Rule& rule, Reporter& r) {
  each_honoured(c, [&](const DecodedBlock& block) {
    each_cell(block, [&](const DecodedCard&, const Cell& cell) {
      if (cell.integer == 0 || cell.field->ignored) return;
      std::vector<std::int64_t> ids;
      for (const ContactCard* card : takers(c, block, cell, Takes::yes))
        ids.push_back(card->block->id.value);
      if (ids.empty()) return;
      constexpr std::size_t shown = 8;
      r.report(rule, *block.block, cell.span,
               fmt::format("{} = {} of {} applies to {} with 0 there: {}", cell.field->name,
                           cell.integer, block.block->schema->keyword,
                           count(ids.size(), "interface", "interfaces"), list_text(ids, shown)));
    });
  });
}

void check_unused_defaults(const LintContext& c, const Rule& rule, Reporter& r) {
  each_honoured(c, [&](const DecodedBlock& block) {
    bool any = false, used = false;
    each_cell(block, [&](const DecodedCard&, const Cell& cell) {
      if (cell.integer == 0 || cell.field->ignored) return;
      any = true;
      used = used || !takers(c, block, cell, Takes::yes).empty() ||
             !takers(c, block, cell, Takes::unknown).empty();
    });
    if (any && !used)
      r.report(rule, *block.block, block.span(),
               "no interface takes a value from " + block.block->schema->keyword);
  });
}

void check_range(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& block : c.defaults)
    each_illegal_flag(block, [&](const Cell& cell) {
      if (cell.field->name == "Iedge") return;  // it has DK201
      r.report(rule, *block.block, cell.span,
               fmt::format("{} of {} is {}; legal values are {}", cell.field->name,
                           block.block->schema->keyword, cell.integer,
                           fmt::join(cell.field->values, ", ")));
    });
}

void check_no_such_default(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& b : c.deck.blocks)
    if (b.header.starts_with("/DEFAULT/INTER") && b.schema != nullptr &&
        b.schema->keyword == "/DEFAULT")
      r.report(rule, b, b.header_span,
               "there are no defaults for " +
                   (b.header.size() > 15 ? std::string(b.header.substr(15)) : "all types at once"));
}

void check_all_zero(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& block : c.defaults) {
    bool any = false;
    const auto look_at = [&](const Line& line) {
      any = any || line.text.find_first_not_of("0.+-, \t") != std::string_view::npos;
    };
    for (const DecodedCard& card : block.cards) look_at(card.line);
    for (const Line& line : block.extra) look_at(line);
    if (!any)
      r.report(rule, *block.block, block.span(),
               block.block->schema->keyword + " has no effect: every field is 0");
  }
}

void check_ignored_field(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& block : c.defaults)
    each_cell(block, [&](const DecodedCard& card, const Cell& cell) {
      if (!cell.field->ignored || cell.integer == 0) return;
      Finding& d = r.report(
          rule, *block.block, cell.span,
          fmt::format("{} of {} has no effect", cell.field->name, block.block->schema->keyword));
      if (!card.free_format)
        d.fix = Fix{"blank " + cell.field->name, true, {blank_edit(cell.span)}};
    });
}

void check_default_ibag(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.model->has_monitored_volume || c.model->has_ale || c.model->has_sol2sph) return;
  for (const DecodedBlock& block : c.defaults) {
    const Cell* cell = block.find("Ibag");
    if (cell == nullptr || cell->integer == 0 || cell->integer == 1000) continue;
    r.report(rule, *block.block, cell->span,
             fmt::format("{}: Ibag = {}, but the deck has no airbag (/MONVOL), ALE or Sol2SPH",
                         block.block->header, cell->integer));
  }
}

void check_scaled_edge_gap(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    const FieldView* igap = card.find("Igap");
    if (igap == nullptr || igap->origin != Origin::default_block || igap->value != 2) return;
    Finding& d = report_at(r, rule, card, "Igap",
                           name_of(card) + ": Igap = 2 from /DEFAULT/INTER/TYPE19, which its " +
                               "edge part does not have");
    if (const EffectiveInt* given = c.interfaces->defaults_of(19)->find("Igap"))
      d.notes.emplace_back(given->span, "it comes from here");
    fix_field(d, c, card, "Igap", "2", false, "write Igap 2");
  });
}

}  // namespace

std::vector<Checked> default_checks() {
  return {{RuleId::DK501, check_overrides},       {RuleId::DK502, check_unused_defaults},
          {RuleId::DK505, check_range},           {RuleId::DK506, check_no_such_default},
          {RuleId::DK507, check_all_zero},        {RuleId::DK509, check_ignored_field},
          {RuleId::DK512, check_scaled_edge_gap}, {RuleId::DK510, check_default_ibag}};
}

}  // namespace deck::detail
