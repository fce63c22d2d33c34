// Where the published manuals and the reference solver differ, for decks that rely on the manual.
#include "lint/check.hpp"
#include "lint/rule_tables.hpp"

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
      report_at(r, rule, card, "Igap", name_of(card) + " has Igap = 4, which no manual describes");
  });
}

void check_type19_edges(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.flag("Igap") == 2)
      report_at(r, rule, card, "Igap",
                name_of(card) + ": the gap scale of Igap = 2 does not reach its edge contact");
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
                name_of(card) + ": " + card.show("Inacti") + " is described in no manual");
  });
}

void check_ifric(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.input("Ifric") == 4)
      report_at(r, rule, card, "Ifric", name_of(card) + ": Ifric = 4 is described in no manual");
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
  if (c.model == nullptr || !c.model->has_monitored_volume) return;
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
                         fmt::format("{}: Stfac = {} is the stiffness of each line{}, that of a "
                                     "pair of lines is {}, and half of it acts",
                                     name_of(card), number_text(card.input("Stfac")),
                                     card.type == 19 ? " of its edge contact" : "",
                                     number_text(card.input("Stfac") / 2))),
               card, "Istf");
  });
}

void add_type19(std::vector<Rule>& out) {
  add(out, "DK281", Severity::warning, "TYPE19: Istf 6",
      "Old manuals list Istf 6 as the default of TYPE19.",
      "No contact has a stiffness of that code any more.",
      "it hands 6 to its parts, which have no branch for it", "write 1000 or leave the cell blank",
      "Never.", "@/INTER/TYPE19/1 Istf=6\n", "@/INTER/TYPE19/1 Istf=1000\n", check_type19_istf,
      Fixable::unsafe);
  add(out, "DK282", Severity::info, "TYPE19: Idel 3", "Old manuals list Idel 3 for 'no deletion'.",
      "The code is gone; the effect happens to stay.", "it turns 3 into 0, no deletion",
      "write 1000", "The effect is the same.", "@/INTER/TYPE19/1 Idel=3\n",
      "@/INTER/TYPE19/1 Idel=1000\n", check_type19_idel, Fixable::safe);
  add(out, "DK283", Severity::info, "TYPE19: Igap 4", "Igap 4 is accepted, but described nowhere.",
      "The node-to-surface parts get Igap 2 with Irem_gap 2, the edge part a constant gap.",
      "it uses Igap 2 and Irem_gap 2 for the nodes and Igap 0 for the edges",
      "write Igap 2 and Irem_gap 2 if that is meant", "When the effect is known and meant.",
      "@/INTER/TYPE19/1 Igap=4\n", "@/INTER/TYPE19/1 Igap=2 Irem_gap=2\n", check_type19_igap);
  add(out, "DK290", Severity::info, "TYPE19: Igap 2 is not scaled at edges",
      "The edge part of a TYPE19 has no scaled gap.",
      "With Igap 2 it works with Igap 1: its gap is not multiplied by Fscalegap and not capped by "
      "Gapmax.",
      "it gives Igap 1 to the edge part", "scale the edge gap with Edge_scale_gap (version 2024)",
      "When edges may keep the full gap.", "@/INTER/TYPE19/1 Igap=2 Fscalegap=0.8\n",
      "@/INTER/TYPE19/1 Igap=1\n", check_type19_edges);
  add(out, "DK292", Severity::info, "TYPE19: blank Stfac is 1",
      "Old manuals give 0 as the default of Stfac unless Istf is 1.",
      "A stiffness factor of 0 would switch the contact off; it is 1.", "it uses 1",
      "write the factor", "When 1 is meant.", "@/INTER/TYPE19/1 Stfac=0\n",
      "@/INTER/TYPE19/1 Stfac=1.0\n", check_type19_stfac);
}

}  // namespace

void add_manual_rules(std::vector<Rule>& out) {
  add_type19(out);
  add(out, "DK284", Severity::warning, "Inacti 4", "Inacti 4 is accepted, but described nowhere.",
      "It moves the main segment out of the gap instead of the secondary node: the coordinates of "
      "the mesh change.",
      "it moves the segments", "use 3 to move nodes, or 6 to reduce the gap",
      "When the effect is known and meant.", "@/INTER/TYPE7/1 Inacti=4\n",
      "@/INTER/TYPE7/1 Inacti=6\n", check_inacti);
  add(out, "DK285", Severity::info, "Ifric 4", "Ifric 4 is accepted, but not in all manuals.",
      "mu = C1 + (Fric - C1) exp(-C2 v): friction that decays from Fric to C1.",
      "it computes the law", "nothing to do if the law is meant", "When the law is meant.",
      "@/INTER/TYPE7/1 Fric=0.3 Ifric=4 C1=0.1 C2=0.01\n",
      "@/INTER/TYPE7/1 Fric=0.3 Ifric=1 C2=0.01\n", check_ifric);
  add(out, "DK286", Severity::warning, "friction function scaled by a blank Fric",
      "fct_IDF is given and Fric is blank.",
      "The manual makes Fric 1 in that case. The solver stores the blank before it looks at the "
      "function, so it stays 0 and there is no friction.",
      "it multiplies the function by 0", "write Fric 1.0", "When no friction is meant.",
      "@/INTER/TYPE7/1 fct_IDF=1\n", "@/INTER/TYPE7/1 Fric=1.0 fct_IDF=1\n", check_fric_function,
      Fixable::unsafe);
  add(out, "DK287", Severity::warning, "friction filter without Xfreq",
      "Ifiltr is set and Xfreq is 0 or blank.",
      "The manual gives 1 as the default of Xfreq; the solver takes 0, and 0 switches the filter "
      "off.",
      "it sets Ifiltr to 0", "give Xfreq, or set Ifiltr 0", "When no filter is meant.",
      "@/INTER/TYPE7/1 Fric=0.1 Ifiltr=1\n", "@/INTER/TYPE7/1 Fric=0.1 Ifiltr=1 Xfreq=0.2\n",
      check_filter_off);
  add(out, "DK288", Severity::warning, "Ibag 2 closes vent holes",
      "Ibag is 2 in a deck with an airbag.",
      "Manuals say 2 means no closure. The solver asks only whether Ibag is 0.",
      "it closes vent holes as for 1", "write 1000 for no closure", "When closure is meant.",
      "/MONVOL/AIRBAG1/1\nbag\n         1\n@/INTER/TYPE7/1 Ibag=2\n",
      "/MONVOL/AIRBAG1/1\nbag\n         1\n@/INTER/TYPE7/1 Ibag=1\n", check_ibag_value);
  add(out, "DK289", Severity::info, "edges: Istf 1 gives half of Stfac",
      "Istf 1 is to make Stfac the stiffness (TYPE11, and the edge part of TYPE19).",
      "In an edge contact both lines get Stfac, and the pair is the two in series: "
      "1 / (1/Stfac + 1/Stfac) = Stfac / 2. As everywhere half of that acts in the force: Stfac / "
      "4. "
      "Node contact takes Stfac itself.",
      "it combines the two sides in series", "write four times the stiffness that is wanted",
      "When the factor is known.", "@/INTER/TYPE11/1 Istf=1 Stfac=10.0\n",
      "@/INTER/TYPE11/1 Istf=5 Stfac=1.0\n", check_edge_istf);
  out.push_back({.id = "DK299",
                 .title = "surface-to-surface smoothing is not evaluated here",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "Ists is set (version 2026).",
                 .why = "grnd_IDs is then the id of a surface; this program treats the interface "
                        "as if Ists were 0.",
                 .solver = "it takes grnd_IDs for a surface",
                 .fix = "expect differences for this interface",
                 .ignore = "When the interface is not looked at.",
                 .bad = "@version 2026\n@/INTER/TYPE7/1 Ists=1\n",
                 .good = "@version 2026\n@/INTER/TYPE7/1\n"});
}

}  // namespace deck::detail
