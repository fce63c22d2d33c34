// Where the published manuals and the reference solver differ, for decks that rely on the manual.
#include "lint/check.hpp"
#include "lint/check_tables.hpp"

namespace deck::detail {
namespace {

void check_filter_off(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (!card.given("Ifiltr") || card.given("Xfreq") || card.given("fric_ID")) return;
    Diagnostic* d = report_at(
        r, rule, card, "Ifiltr",
        name_of(card) + ": " + card.show("Ifiltr") + ", but Xfreq is 0: there is no filter");
    note_field(d, card, "Xfreq");
  });
  for (const DecodedBlock& block : c.frictions) {
    const Cell* cell = block.find("Ifiltr");
    if (cell == nullptr || cell->integer == 0 || block.real("Xfreq") != 0) continue;
    r.report(rule, *block.block, cell->span,
             fmt::format("/FRICTION {}: Ifiltr = {}, but Xfreq is 0: there is no filter",
                         block.block->id.value, cell->integer));
  }
}

void check_edge_istf(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.flag("Istf") != 1 || !card.given("Stfac")) return;
    note_field(report_at(r, rule, card, "Stfac",
                         fmt::format("{}: Stfac = {} is the stiffness of each line{}; a pair of "
                                     "lines has {}, and half of it acts",
                                     name_of(card), number_text(card.input("Stfac")),
                                     card.type == 19 ? " of its edge contact" : "",
                                     number_text(card.input("Stfac") / 2))),
               card, "Istf");
  });
}

}  // namespace

std::span<const Checked> manual_checks() {
  static constexpr Checked all[] = {
      {RuleId::DK287, check_filter_off},
      {RuleId::DK289, check_edge_istf},
  };
  return all;
}

}  // namespace deck::detail
