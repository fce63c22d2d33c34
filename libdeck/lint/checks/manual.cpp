// Where the published manuals and the reference solver differ, for decks that rely on the manual.
#include "lint/check.hpp"
#include "lint/check_tables.hpp"

namespace deck::detail {
namespace {

void check_type19_istf(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.input("Istf") != 6) return;
    Diagnostic* d =
        report_at(r, rule, card, "Istf", name_of(card) + " has Istf = 6, a code of old manuals");
    fix_field(d, c, card, "Istf", "1000", false, "write Istf 1000 (main side stiffness)");
  });
}

void check_type19_idel(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.input("Idel") != 3) return;
    Diagnostic* d =
        report_at(r, rule, card, "Idel", name_of(card) + " has Idel = 3, a code of old manuals");
    fix_field(d, c, card, "Idel", "1000", true, "write Idel 1000 (no deletion)");
  });
}

void check_type19_igap(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.flag("Igap") == 4)
      report_at(r, rule, card, "Igap",
                name_of(card) + " has Igap = 4, which manuals do not describe");
  });
}

void check_type19_edges(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    // A default of 2 stays 2 and stops the solver: DK512.
    const FieldView* igap = card.find("Igap");
    if (igap != nullptr && igap->value == 2 && igap->origin != Origin::default_block)
      report_at(r, rule, card, "Igap",
                name_of(card) + ": its edge contact does not use the gap scale of Igap = 2");
  });
}

void check_type19_stfac(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (!card.given("Stfac") && card.flag("Istf") != 1)
      report_at(r, rule, card, "Stfac",
                name_of(card) + " leaves Stfac blank: the factor is 1, not 0 as old manuals say");
  });
}

void check_inacti(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.flag("Inacti") == 4)
      report_at(r, rule, card, "Inacti",
                name_of(card) + ": " + card.show("Inacti") + " is not described in manuals");
  });
}

void check_ifric(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.input("Ifric") == 4)
      report_at(r, rule, card, "Ifric", name_of(card) + ": Ifric = 4 is not described in manuals");
  });
}

void check_fric_function(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    // With fric_ID nothing of the card's friction is used.
    if (!card.given("fct_IDF") || card.given("Fric") || card.given("fric_ID")) return;
    Diagnostic* d =
        report_at(r, rule, card, "Fric",
                  name_of(card) + ": Fric is blank, so the friction of fct_IDF is scaled by 0");
    note_field(d, card, "fct_IDF");
    fix_field(d, c, card, "Fric", "1.0", false, "write Fric 1.0, as the manual intends");
  });
}

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

void check_ibag_value(const LintContext& c, const Rule& rule, Reporter& r) {
  if (!c.model->has_monitored_volume) return;
  each(c, rule, [&](const ContactCard& card) {
    if (card.flag("Ibag") == 2)
      report_at(r, rule, card, "Ibag",
                name_of(card) +
                    ": Ibag = 2 closes vent holes here, although manuals say it does "
                    "not");
  });
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
      {RuleId::DK281, check_type19_istf},  {RuleId::DK282, check_type19_idel},
      {RuleId::DK283, check_type19_igap},  {RuleId::DK284, check_inacti},
      {RuleId::DK285, check_ifric},        {RuleId::DK286, check_fric_function},
      {RuleId::DK287, check_filter_off},   {RuleId::DK288, check_ibag_value},
      {RuleId::DK289, check_edge_istf},    {RuleId::DK290, check_type19_edges},
      {RuleId::DK292, check_type19_stfac},
  };
  return all;
}

}  // namespace deck::detail
