// What the solver does with options of a contact otherwise than manuals say, without a word in its
// listing. One check per rule; the table below holds their pages.
#include "lint/check.hpp"
#include "lint/rule_tables.hpp"

namespace deck::detail {
namespace {

using Check = void (*)(const LintContext&, const Rule&, Reporter&);

/// Friction comes from the card: Fric or a law, and no /FRICTION instead.
bool own_friction(const ContactCard& card) {
  return !card.given("fric_ID") && (card.given("Fric") || card.given("Ifric"));
}

/// Exchanges heat with a temperature of the interface (Ithe_form 0).
bool fixed_temperature(const ContactCard& card) {
  return card.input("Ithe") == 1 && card.input("Ithe_form") == 0;
}

void check_sensor_times(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (!card.given("sens_ID")) return;
    for (const std::string_view field : {"Tstart", "Tstop"})
      if (card.given(field))
        note_field(report_at(r, rule, card, field,
                             fmt::format("{}: {} holds beside the sensor: contact acts only while "
                                         "both allow it",
                                         name_of(card), card.show(field))),
                   card, "sens_ID");
  });
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

void check_blank_temperature(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (!fixed_temperature(card) || card.given("Tint")) return;
    note_field(report_at(r, rule, card, "Tint",
                         name_of(card) + ": Tint is blank, so the secondary side exchanges heat "
                                         "with a body of temperature 0"),
               card, "Ithe");
  });
}

void check_blank_radiation(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.input("Ithe") != 1 || !card.given("Frad") || card.given("Drad")) return;
    note_field(
        report_at(r, rule, card, "Drad", name_of(card) + ": Drad is blank, so nothing radiates"),
        card, "Frad");
  });
}

void check_main_share(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (!fixed_temperature(card)) return;
    for (const std::string_view field : {"Fheats", "Fheatm"}) {
      const bool secondary = field == "Fheats";
      if (!card.given(field) || (secondary && !card.given("fct_IDK"))) continue;
      note_field(report_at(r, rule, card, field,
                           fmt::format("{}: {} reaches nobody with Ithe_form 0{}", name_of(card),
                                       card.show(field), secondary ? " and fct_IDK" : "")),
                 card, "Ithe_form");
    }
  });
}

void check_function_without_heat(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (!card.given("fct_IDF") || card.given("fric_ID") || card.input("Ithe") == 1) return;
    note_field(report_at(r, rule, card, "fct_IDF",
                         name_of(card) + ": fct_IDF is not used, because the interface exchanges "
                                         "no heat"),
               card, "Ithe");
  });
}

void check_function_form1(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (!card.given("fct_IDF") || card.given("fric_ID")) return;
    if (card.input("Ithe") != 1 || card.input("Ithe_form") != 1) return;
    note_field(report_at(r, rule, card, "fct_IDF",
                         name_of(card) + ": with Ithe_form 1 the temperature that fct_IDF is read "
                                         "at is not that of the pair"),
               card, "Ithe_form");
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
    f(*block.block, cell->span, fmt::format("/FRICTION {}", block.block->id.value), cell->integer,
      block.integer("Iform"));
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
      add(*block.block, cell->span, fmt::format("/FRICTION {}", block.block->id.value));
  if (first == nullptr) return;
  r.report(rule, *first, span,
           fmt::format("{}{}: friction sticks with twice the stiffness of the normal force", name,
                       others == 0 ? "" : fmt::format(" (and {} more)", others)));
}

/// One finding for the deck, at the first interface with a bound.
void check_half_bounds(const LintContext& c, const Rule& rule, Reporter& r) {
  const ContactCard* first = nullptr;
  std::string_view field;
  std::size_t others = 0;
  each(c, rule, [&](const ContactCard& card) {
    // Edges have the series stiffness, Istf 5, by default.
    const auto istf = card.flag("Istf");
    if (istf < 2 || istf > 5 || !(card.given("Stmin") || card.given("Stmax"))) return;
    if (first != nullptr) {
      ++others;
      return;
    }
    first = &card;
    field = card.given("Stmax") ? "Stmax" : "Stmin";
  });
  if (first == nullptr) return;
  note_field(
      report_at(
          r, rule, *first, field,
          fmt::format("{}: {} bounds the stored stiffness; the bound of the one that acts is "
                      "{}{}",
                      name_of(*first), first->show(field), number_text(0.5 * first->value(field)),
                      others == 0 ? "" : fmt::format(" ({} more interfaces alike)", others))),
      *first, "Istf");
}

/// fric_ID names a /FRICTION without a law, which holds for edges as well.
bool plain_friction(const LintContext& c, const ContactCard& card) {
  if (c.interfaces == nullptr) return true;
  const Friction* f = c.interfaces->friction(static_cast<std::int64_t>(card.value("fric_ID")));
  return f == nullptr || f->Ifric == 0;
}

void check_edge_limits(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    for (const std::string_view field : {"fric_ID", "Ifric", "Ifiltr"})
      if (card.type == 19 && card.given(field) &&
          !(field == "fric_ID" && plain_friction(c, card))) {
        report_at(r, rule, card, field,
                  fmt::format("{}: {} does not reach its edge contact, which knows Fric = {} only",
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
                             " never ties anything, because dtmin is blank"),
               card, "dtmin");
  });
}

void check_default_ibag(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.model == nullptr || c.model->has_monitored_volume || c.model->has_ale ||
      c.model->has_sol2sph)
    return;
  for (const DecodedBlock& block : c.defaults) {
    const Cell* cell = block.find("Ibag");
    if (cell == nullptr || cell->integer == 0 || cell->integer == 1000) continue;
    r.report(rule, *block.block, cell->span,
             fmt::format("{}: Ibag = {}, but the deck has no airbag (/MONVOL), ALE or Sol2SPH",
                         block.block->header, cell->integer));
  }
}

void add_heat(std::vector<Rule>& out) {
  add(out, "DK247", Severity::warning, "heat exchange with a body of temperature 0",
      "Ithe is 1, Ithe_form 0, and Tint is blank.",
      "With Ithe_form 0 the secondary side exchanges heat with a body of the fixed temperature "
      "Tint. Blank is 0, the absolute zero where the deck computes in kelvin.",
      "it takes 0", "write Tint, or set Ithe_form 1", "When 0 is the temperature that is meant.",
      "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0\n", "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0 Tint=293.0\n",
      check_blank_temperature);
  add(out, "DK248", Severity::warning, "radiation without a distance",
      "Frad is given and Drad is blank.",
      "The start-up prints a default distance, the larger of the gap and the shortest main side, "
      "but the computation does not get it: it has 0 there and nothing radiates.",
      "it prints a default distance and computes with 0", "write Drad",
      "When nothing shall radiate.", "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0 Tint=293.0 Frad=1.e-14\n",
      "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0 Tint=293.0 Frad=1.e-14 Drad=5.0\n", check_blank_radiation);
  add(out, "DK249", Severity::info, "friction heat that is lost",
      "Fheatm is given with Ithe_form 0, or Fheats with Ithe_form 0 and fct_IDK.",
      "The main side has no temperature of its own then. Its share of the friction heat is booked "
      "in the energies, but delivered to nobody. With fct_IDK the share of the secondary side is "
      "lost as well.",
      "it books the share and heats nothing", "set Ithe_form 1, or blank Fheatm",
      "When the share shall leave the model.",
      "@/INTER/TYPE7/1 Fric=0.2 Ithe=1 Kthe=1.0 Tint=293.0 Fheats=0.5 Fheatm=0.5\n",
      "@/INTER/TYPE7/1 Fric=0.2 Ithe=1 Kthe=1.0 Ithe_form=1 Fheats=0.5 Fheatm=0.5\n",
      check_main_share);
  add(out, "DK291", Severity::warning, "friction function without heat exchange",
      "fct_IDF is given, but Ithe is 0.",
      "The function is read at the temperature of the contact. Without heat exchange there is "
      "none, and friction stays Fric.",
      "it never evaluates the function", "set Ithe 1, or blank fct_IDF",
      "When heat exchange is switched on in a variant of the deck.",
      "@/INTER/TYPE7/1 Fric=1.0 fct_IDF=1\n",
      "@/INTER/TYPE7/1 Fric=1.0 fct_IDF=1 Ithe=1 Kthe=1.0 Tint=293.0\n",
      check_function_without_heat);
  add(out, "DK914", Severity::warning, "friction function with Ithe_form 1",
      "fct_IDF is given and both sides have temperatures.",
      "The function should be read at the mean temperature of node and segment. The solver weights "
      "the corners of the segment with the weights of a pair that it looked at before: in a "
      "recorded run Fric 0.25 became 16. The models of deck cycle use the pair's own weights.",
      "it uses the weights of another pair", "use Ithe_form 0, or Fric without a function",
      "Never, unless the function is constant.",
      "@/INTER/TYPE7/1 Fric=1.0 fct_IDF=1 Ithe=1 Kthe=1.0 Ithe_form=1\n",
      "@/INTER/TYPE7/1 Fric=1.0 fct_IDF=1 Ithe=1 Kthe=1.0 Tint=293.0\n", check_function_form1);
}

void add_friction(std::vector<Rule>& out) {
  add(out, "DK293", Severity::warning, "the cut-off filter does not filter",
      "Ifiltr is 3 with a frequency in Xfreq (or in /FRICTION).",
      "Manuals give the factor 2 pi Xfreq dt. The solver takes the larger of that and 1, so the "
      "force is never smoothed, and is exaggerated where 2 pi Xfreq dt exceeds 1.",
      "it uses a factor of at least 1", "use Ifiltr 1 with the factor itself in Xfreq",
      "When no filter is meant.", "@/INTER/TYPE7/1 Fric=0.2 Ifiltr=3 Xfreq=100.0\n",
      "@/INTER/TYPE7/1 Fric=0.2 Ifiltr=1 Xfreq=0.3\n", check_cutoff_filter);
  add(out, "DK294", Severity::info, "filter with the incremental formulation",
      "Ifiltr and Iform 2 stand together (or in /FRICTION).",
      "With Iform 2 the factor multiplies the increment of the tangential force. That is a softer "
      "stick stiffness, not a smoothed force.",
      "it multiplies the increment", "set Ifiltr 0, or Iform 1", "When the softer stick is meant.",
      "@/INTER/TYPE7/1 Fric=0.2 Iform=2 Ifiltr=1 Xfreq=0.3\n",
      "@/INTER/TYPE7/1 Fric=0.2 Iform=1 Ifiltr=1 Xfreq=0.3\n", check_incremental_filter);
  add(out, "DK295", Severity::info, "Iform 2 sticks with twice the normal stiffness",
      "Friction with Iform 2 (or in /FRICTION).",
      "The manual's increment is K Vt dt with the K of the normal force. That K is halved before "
      "it acts on the normal force and is whole in the tangential increment: dFt = 2 K Vt dt.",
      "it uses the stiffness before the half", "nothing: know it when slip is compared by hand",
      "When the difference does not matter.", "@/INTER/TYPE7/1 Fric=0.2 Iform=2\n",
      "@/INTER/TYPE7/1 Fric=0.2 Iform=1\n", check_incremental_stiffness);
  add(out, "DK297", Severity::info, "edges: plain friction, no release",
      "A friction law, a filter or fric_ID on a TYPE19; IBC on a TYPE19 or TYPE11.",
      "The edge part of a TYPE19 is a TYPE11: it knows the constant Fric and nothing else. An edge "
      "contact reads IBC and never releases a boundary condition.",
      "it passes Fric on and drops the rest", "add a TYPE7 and a TYPE11 instead, or accept Fric",
      "When edges matter little.", "@/INTER/TYPE19/1 Ifric=1 Fric=0.2 C2=0.01\n",
      "@/INTER/TYPE19/1 Fric=0.2\n", check_edge_limits);
}

}  // namespace

void add_difference_rules(std::vector<Rule>& out) {
  add_heat(out);
  add_friction(out);
  add(out, "DK246", Severity::info, "title longer than 100 characters",
      "The title line of an interface has more than 100 characters.",
      "Titles have 100 columns; what stands behind is not in any listing or animation file.",
      "it keeps the first 100", "shorten the title", "When the rest is a note for people.",
      "/INTER/TYPE10/1\n"
      "a title with one hundred and five characters in one line, which is five more than the "
      "solver has place for.\n         2         1\n\n\n\n",
      "@/INTER/TYPE10/1\n", check_title_length);
  add(out, "DK268", Severity::info, "Tstart or Tstop beside a sensor",
      "The card has a sensor and times of its own.",
      "Manuals say that the times are not used with a sensor. They are: there is contact only "
      "while Tstart <= t <= Tstop and the sensor is active.",
      "it asks both", "blank the times if the sensor alone shall decide",
      "When both conditions are meant.", "@/INTER/TYPE7/1 sens_ID=1 Tstop=50.0\n",
      "@/INTER/TYPE7/1 sens_ID=1\n", check_sensor_times);
  add(out, "DK296", Severity::info, "Stmin and Stmax act by half",
      "Stmin or Stmax bounds the stiffness of Istf 2 to 5.",
      "The bounds hold for the stiffness that is stored and printed. Half of that acts in the "
      "force: the pair stiffness lies between Stmin / 2 and Stmax / 2.",
      "it bounds first and halves afterwards", "write twice the bound that is wanted",
      "When the factor is known.", "@/INTER/TYPE7/1 Istf=4 Stmax=5.0\n", "@/INTER/TYPE7/1 Istf=4\n",
      check_half_bounds);
  add(out, "DK298", Severity::info, "a single release flag in column 8",
      "Of the three release flags only that in column 8 is set.",
      "The flags of X, Y and Z stand in columns 8, 9 and 10. Manual pages print them as columns "
      "6, 7 and 8, where column 8 is Z.",
      "it releases X", "move the 1 to column 10 if Z is meant", "When X is meant.",
      "@/INTER/TYPE7/1 IBCX=1\n", "@/INTER/TYPE7/1 IBCX=1 IBCY=1 IBCZ=1\n", check_release_column);
  add(out, "DK915", Severity::warning, "ITIED without dtmin", "ITIED is set and dtmin is blank.",
      "A node is tied when its contact time step falls below dtmin. Manuals name the limit of "
      "/DT/INTER/DEL as well; it is not asked. Without dtmin the limit is 1e-30: nothing ties.",
      "it never ties a node", "write dtmin", "When the tie is switched off on purpose.",
      "@/INTER/TYPE7/1 ITIED=1\n", "@/INTER/TYPE7/1 ITIED=1 dtmin=1.e-4\n", check_tie_trigger);
  add(out, "DK510", Severity::info, "default Ibag without airbag",
      "Ibag of /DEFAULT/INTER/TYPE7 or TYPE19 is 1 or 2, and no /MONVOL, ALE or Sol2SPH is there.",
      "The flag closes vent holes of airbags.", "it drops the flag from every interface",
      "write 1000, or remove the cell", "When the file of defaults is shared with airbag decks.",
      "@/DEFAULT/INTER/TYPE7 Ibag=1\n@/INTER/TYPE7/1\n",
      "@/DEFAULT/INTER/TYPE7 Igap=1\n@/INTER/TYPE7/1\n", check_default_ibag);
}

}  // namespace deck::detail
