// /DEFAULT/INTER blocks: values that they change, and blocks without effect.
#include <algorithm>

#include "base/shared/words.hpp"
#include "lint/check.hpp"

namespace deck::detail {
namespace {

/// Number of TYPEn; 0: another keyword.
int type_of(std::string_view keyword) {
  const auto at = keyword.rfind("TYPE");
  return at == keyword.npos ? 0 : static_cast<int>(read_integer(keyword.substr(at + 4)).value);
}

/// Calls f(block) for the default blocks that the solver uses.
template <class F>
void for_each_honoured(const LintContext& c, F&& f) {
  for (const DecodedBlock& block : c.defaults)
    if (std::any_of(c.interfaces->defaults.begin(), c.interfaces->defaults.end(),
                    [&](const DefaultInter& d) { return d.span == block.span(); }))
      f(block);
}

/// An interface without typed struct that uses values of a default block.
struct OtherTaker {
  std::string_view keyword;
  int type;                ///< type of the default block
  std::string_view flags;  ///< with blanks around each; empty: all
};
constexpr OtherTaker other_takers[] = {
    {"/INTER/TYPE2", 2, ""},
    {"/INTER/LAGMUL/TYPE2", 2, " Isearch "},
    {"/INTER/LAGDT/TYPE7", 7, " Istf Igap Ibag Idel Inacti Iform "},
    {"/INTER/TYPE24", 24, ""},
    {"/INTER/TYPE25", 25, ""},
};

enum class DefaultUse : std::uint8_t { no, yes, unknown };

/// Decides if a 0 on the card uses the default value.
DefaultUse default_use(const ContactCard& card, int type, const Field& flag) {
  if (card.type != 0) {
    const FieldView* f = card.type == type ? card.find(flag.name) : nullptr;
    return f != nullptr && f->origin == Origin::default_block ? DefaultUse::yes : DefaultUse::no;
  }
  for (const OtherTaker& other : other_takers) {
    if (other.type != type || card.block->schema->keyword != other.keyword) continue;
    if (!other.flags.empty() && other.flags.find(" " + flag.name + " ") == other.flags.npos)
      return DefaultUse::no;
    // TYPE2 has another name than its default block.
    std::string_view name = flag.name;
    if (type == 2 && name == "Idel") name = "Idel2";
    if (card.block->schema->find_field(name) == nullptr) return DefaultUse::unknown;
    return card.given(name) ? DefaultUse::no : DefaultUse::yes;
  }
  return DefaultUse::no;
}

/// Interfaces that use the value of this cell (`how`: surely or possibly).
std::vector<const ContactCard*> takers(const LintContext& c, const DecodedBlock& block,
                                       const Cell& cell, DefaultUse how) {
  std::vector<const ContactCard*> out;
  const int type = type_of(block.block->schema->keyword);
  for (const ContactCard& card : c.contacts)
    if (default_use(card, type, *cell.field) == how) out.push_back(&card);
  return out;
}

void check_overrides(const LintContext& c, const Rule& rule, Reporter& r) {
  for_each_honoured(c, [&](const DecodedBlock& block) {
    for_each_cell(block, [&](const DecodedCard&, const Cell& cell) {
      if (cell.integer == 0 || cell.field->ignored) return;
      std::vector<std::int64_t> ids;
      for (const ContactCard* card : takers(c, block, cell, DefaultUse::yes))
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
  for_each_honoured(c, [&](const DecodedBlock& block) {
    bool any = false, used = false;
    for_each_cell(block, [&](const DecodedCard&, const Cell& cell) {
      if (cell.integer == 0 || cell.field->ignored) return;
      any = true;
      used = used || !takers(c, block, cell, DefaultUse::yes).empty() ||
             !takers(c, block, cell, DefaultUse::unknown).empty();
    });
    if (any && !used)
      r.report(rule, *block.block, block.span(),
               "no interface takes a value from " + block.block->schema->keyword);
  });
}

void check_range(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& block : c.defaults)
    for_each_illegal_flag(block, [&](const Cell& cell) {
      if (cell.field->name == "Iedge") return;  // reported by DK201
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
    const auto find_value = [&](const Line& line) {
      any = any || line.text.find_first_not_of("0.+-, \t") != std::string_view::npos;
    };
    for (const DecodedCard& card : block.cards) find_value(card.line);
    for (const Line& line : block.extra) find_value(line);
    if (!any)
      r.report(rule, *block.block, block.span(),
               block.block->schema->keyword + " has no effect: every field is 0");
  }
}

void check_ignored_field(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& block : c.defaults)
    for_each_cell(block, [&](const DecodedCard& card, const Cell& cell) {
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
  for_each_contact(c, rule, [&](const ContactCard& card) {
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
