// Where the published manuals and the reference solver differ: options for which the solver does so
// silently, and decks that rely on the manual. One check per rule.
#include "lint/check.hpp"

namespace deck::detail {
namespace {

/// Friction comes from the card: Fric or a law, and no /FRICTION instead.
bool own_friction(const ContactCard& card) {
  return !card.given("fric_ID") && (card.given("Fric") || card.given("Ifric"));
}

/// Exchanges heat with a temperature of the interface (Ithe_form 0).
bool fixed_temperature(const ContactCard& card) {
  return card.input("Ithe") == 1 && card.input("Ithe_form") == 0;
}

void check_title_length(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts) {
    const Line& title = card.decoded.title_line;
    if (!title.valid() || title.text.size() <= 100) continue;
    r.report(rule, *card.block, title.columns(101, static_cast<int>(title.text.size())),
             fmt::format("the title of {} has {} characters; the solver keeps the first 100",
                         name_of(card), title.text.size()));
  }
}

void check_main_share(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (!fixed_temperature(card)) return;
    for (const std::string_view field : {"Fheats", "Fheatm"}) {
      const bool secondary = field == "Fheats";
      if (!card.given(field) || (secondary && !card.given("fct_IDK"))) continue;
      note_field(report_at(r, rule, card, field,
                           fmt::format("{}: {} is lost with Ithe_form 0{}", name_of(card),
                                       card.show(field), secondary ? " and fct_IDK" : "")),
                 card, "Ithe_form");
    }
  });
}

/// Calls f(block, span, name, Ifiltr, Xfreq, Iform) for every friction filter that is on.
template <class F>
void each_filter(const LintContext& c, const Rule& rule, F&& f) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.given("fric_ID") || !card.given("Ifiltr") || !card.given("Xfreq")) return;
    f(*card.block, card.span("Ifiltr"), name_of(card), card.flag("Ifiltr"), card.flag("Iform"));
  });
  for (const DecodedBlock& block : c.frictions) {
    const Cell* cell = block.find("Ifiltr");
    if (cell == nullptr || cell->integer == 0 || block.real("Xfreq") == 0) continue;
    f(*block.block, cell->span, name_of(block), cell->integer, block.integer("Iform"));
  }
}

void check_cutoff_filter(const LintContext& c, const Rule& rule, Reporter& r) {
  each_filter(c, rule,
              [&](const Block& block, Span span, const std::string& name, std::int64_t ifiltr,
                  std::int64_t) {
                if (ifiltr == 3)
                  r.report(rule, block, span,
                           name + ": Ifiltr = 3 does not filter: the factor is at least 1");
              });
}

void check_incremental_filter(const LintContext& c, const Rule& rule, Reporter& r) {
  each_filter(c, rule,
              [&](const Block& block, Span span, const std::string& name, std::int64_t ifiltr,
                  std::int64_t iform) {
                if (ifiltr != 3 && iform == 2)
                  r.report(
                      rule, block, span,
                      name + ": with Iform 2 the filter factor scales the tangential stiffness");
              });
}

/// One finding for the deck: what holds for every incremental friction need not be said each time.
void check_incremental_stiffness(const LintContext& c, const Rule& rule, Reporter& r) {
  const Block* first = nullptr;
  Span span;
  std::string name;
  std::size_t others = 0;
  const auto add = [&](const Block& block, Span where, std::string who) {
    if (first != nullptr) {
      ++others;
      return;
    }
    first = &block;
    span = where;
    name = std::move(who);
  };
  each(c, rule, [&](const ContactCard& card) {
    if (own_friction(card) && card.flag("Iform") == 2)
      add(*card.block, card.span("Iform"), name_of(card));
  });
  for (const DecodedBlock& block : c.frictions)
    if (const Cell* cell = block.find("Iform"); cell != nullptr && cell->integer == 2)
      add(*block.block, cell->span, name_of(block));
  if (first == nullptr) return;
  r.report(rule, *first, span,
           fmt::format("{}{}: friction sticks with twice the stiffness of the normal force", name,
                       others == 0 ? "" : fmt::format(" (and {} more)", others)));
}

/// One finding for the deck, at the first interface with a bound.
void check_half_bounds(const LintContext& c, const Rule& rule, Reporter& r) {
  FirstCard first;
  each(c, rule, [&](const ContactCard& card) {
    // Edges have the series stiffness, Istf 5, by default.
    const auto istf = card.flag("Istf");
    if (istf >= 2 && istf <= 5 && (card.bounds("Stmin") || card.bounds("Stmax"))) first.add(card);
  });
  if (first.card == nullptr) return;
  const ContactCard& card = *first.card;
  const std::string_view field = card.bounds("Stmax") ? "Stmax" : "Stmin";
  const std::string others =
      first.others == 0 ? "" : fmt::format(" (and {} more interfaces)", first.others);
  note_field(report_at(r, rule, card, field,
                       fmt::format("{}: {} bounds the stored stiffness; half of it acts, so the "
                                   "acting stiffness is bounded by {}{}",
                                   name_of(card), card.show(field),
                                   number_text(0.5 * card.value(field)), others)),
             card, "Istf");
}

/// fric_ID names a /FRICTION without a law, which holds for edges as well.
bool plain_friction(const LintContext& c, const ContactCard& card) {
  const Friction* f = c.interfaces->friction(card.id("fric_ID"));
  return f == nullptr || f->Ifric == 0;
}

void check_edge_limits(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    for (const std::string_view field : {"fric_ID", "Ifric", "Ifiltr"})
      if (card.type == 19 && card.given(field) &&
          !(field == "fric_ID" && plain_friction(c, card))) {
        report_at(r, rule, card, field,
                  fmt::format("{}: {} has no effect in its edge contact, which uses only Fric = {}",
                              name_of(card), card.show(field), number_text(card.value("Fric"))));
        break;
      }
    for (const std::string_view field : {"IBCX", "IBCY", "IBCZ"})
      if (card.given(field)) {
        report_at(r, rule, card, field,
                  name_of(card) + (card.type == 19
                                       ? ": its edge contact releases no boundary conditions"
                                       : ": an edge contact releases no boundary conditions"));
        break;
      }
  });
}

void check_release_column(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    const FieldView* x = card.find("IBCX");
    if (x == nullptr || x->field == nullptr || x->field->first != 8) return;
    if (!card.given("IBCX") || card.given("IBCY") || card.given("IBCZ")) return;
    report_at(r, rule, card, "IBCX",
              name_of(card) + ": the 1 in column 8 releases X; manuals print column 8 as Z");
  });
}

void check_tie_trigger(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (!card.given("ITIED") || card.input("dtmin") > 0) return;
    note_field(report_at(r, rule, card, "ITIED",
                         name_of(card) + ": " + card.show("ITIED") +
                             " never ties a node, because dtmin is " +
                             (card.given("dtmin") ? "not above 0" : "blank")),
               card, "dtmin");
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

// ---- decks that rely on a manual ----------------------------------------------------------------

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
             fmt::format("{}: Ifiltr = {}, but Xfreq is 0: there is no filter", name_of(block),
                         cell->integer));
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

std::span<const Checked> difference_checks() {
  static constexpr Checked all[] = {
      {RuleId::DK246, check_title_length},
      {RuleId::DK249, check_main_share},
      {RuleId::DK293, check_cutoff_filter},
      {RuleId::DK294, check_incremental_filter},
      {RuleId::DK295, check_incremental_stiffness},
      {RuleId::DK296, check_half_bounds},
      {RuleId::DK297, check_edge_limits},
      {RuleId::DK298, check_release_column},
      {RuleId::DK510, check_default_ibag},
      {RuleId::DK915, check_tie_trigger},
      {RuleId::DK287, check_filter_off},
      {RuleId::DK289, check_edge_istf},
  };
  return all;
}

}  // namespace deck::detail
