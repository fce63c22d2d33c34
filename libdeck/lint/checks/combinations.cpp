// Fields that contradict one another. Each check is one rule; the table below holds their pages,
// which is why the file is long.
#include <array>
#include <cmath>
#include <numbers>

#include "lint/check.hpp"
#include "lint/rule_tables.hpp"

namespace deck::detail {
namespace {

/// What a Renard curve needs: 0 < C5 < C6, C4 < C1 < C3 and C4 < C2 < C3. Empty: fine.
std::string renard_problem(const std::array<double, 6>& k) {
  const double cs = k[0], cd = k[1], cmax = k[2], cmin = k[3], v1 = k[4], v2 = k[5];
  if (!(v1 > 0)) return "C5, the first critical speed, must be above 0";
  if (!(v2 > v1)) return "C6, the second critical speed, must be above C5";
  if (!(cmin < cs) || !(cs < cmax))
    return "C1 (static) must lie between C4 (least) and C3 (largest)";
  if (!(cmin < cd) || !(cd < cmax))
    return "C2 (dynamic) must lie between C4 (least) and C3 (largest)";
  return {};
}

void check_renard(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.input("Ifric") != 3 || card.given("fric_ID")) return;
    const std::array<double, 6> k = {card.input("C1"), card.input("C2"), card.input("C3"),
                                     card.input("C4"), card.input("C5"), card.input("C6")};
    if (const std::string problem = renard_problem(k); !problem.empty())
      note_field(report_at(r, rule, card, "C1", name_of(card) + ": " + problem), card, "Ifric");
  });
  for (const DecodedBlock& block : c.frictions) {
    if (block.integer("Ifric") != 3) continue;
    const std::array<double, 6> k = {block.real("C1"), block.real("C2"), block.real("C3"),
                                     block.real("C4"), block.real("C5"), block.real("C6")};
    const Cell* at = block.find("C1");
    if (const std::string problem = renard_problem(k); !problem.empty())
      r.report(rule, *block.block, at ? at->span : block.span(),
               "/FRICTION " + std::to_string(block.block->id.value) + ": " + problem);
  }
}

void check_heat_sum(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    const double sum = card.input("Fheats") + card.input("Fheatm");
    if (!(sum > 1)) return;
    Diagnostic* d = report_at(
        r, rule, card, "Fheats",
        fmt::format("Fheats + Fheatm of {} is {}, more than 1", name_of(card), number_text(sum)));
    note_field(d, card, "Fheatm");
  });
}

void check_times(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (!card.given("Tstop") || card.input("Tstop") < 0) return;
    if (card.value("Tstart") < card.value("Tstop")) return;
    Diagnostic* d =
        report_at(r, rule, card, "Tstop",
                  fmt::format("{} starts at {} and stops at {}", name_of(card),
                              number_text(card.value("Tstart")), number_text(card.value("Tstop"))));
    note_field(d, card, "Tstart");
  });
}

/// The two nodes of the axis are one node, or stand at the same place.
bool axis_is_a_point(const LintContext& c, const ContactCard& card) {
  if (card.value("node_ID1") == card.value("node_ID2")) return true;
  if (c.model == nullptr) return false;
  const auto place = [&](std::string_view field) {
    return c.model->find_node(static_cast<std::int64_t>(card.value(field)));
  };
  const NodeIndex a = place("node_ID1"), b = place("node_ID2");
  if (a == no_index || b == no_index) return false;
  const auto& x = c.model->nodes;
  return x.x[a] == x.x[b] && x.y[a] == x.y[b] && x.z[a] == x.z[b];
}

void check_curvature_nodes(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    const auto icurv = card.flag("Icurv");
    const bool first = card.given("node_ID1"), second = card.given("node_ID2");
    if (icurv == 2 && first && second && axis_is_a_point(c, card)) {
      note_field(report_at(r, rule, card, "node_ID2",
                           fmt::format("{}: Icurv = 2, but node_ID1 and node_ID2 are at one place: "
                                       "the axis has no direction",
                                       name_of(card))),
                 card, "node_ID1");
      return;
    }
    if ((icurv != 1 && icurv != 2) || (first && (icurv == 1 || second))) return;
    Diagnostic* d = report_at(
        r, rule, card, first ? "node_ID2" : "node_ID1",
        icurv == 1 ? name_of(card) + ": Icurv = 1 needs node_ID1, the centre of the sphere"
                   : name_of(card) + ": Icurv = 2 needs node_ID1 and node_ID2 on the axis");
    if (d != nullptr) {
      d->reference = ReferenceMessage{icurv == 1 ? 1727 : 1728, Severity::error};
      note_field(d, card, "Icurv");
    }
  });
}

void check_type10_inacti(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.input("Inacti") != 5) return;
    Diagnostic* d = report_at(r, rule, card, "Inacti", name_of(card) + " has Inacti = 5");
    fix_field(d, c, card, "Inacti", "0", false, "write Inacti 0");
  });
}

void check_type11_igap(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.flag("Igap") != 2) return;
    Diagnostic* d =
        report_at(r, rule, card, "Igap",
                  name_of(card) + ": " + card.show("Igap") + ", which edge contact does not have");
    if (card.input("Igap") == 2) fix_field(d, c, card, "Igap", "1", false, "write Igap 1");
  });
}

void check_iadm_icurv(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (!card.given("Iadm") || !card.given("Icurv")) return;
    note_field(report_at(r, rule, card, "Iadm",
                         name_of(card) + ": " + card.show("Iadm") + " together with " +
                             card.show("Icurv")),
               card, "Icurv");
  });
}

void check_iadm(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.model == nullptr || c.model->has_adaptive_mesh) return;
  each(c, rule, [&](const ContactCard& card) {
    if (card.given("Iadm"))
      report_at(r, rule, card, "Iadm",
                name_of(card) + ": " + card.show("Iadm") + ", but the deck has no adaptive mesh");
  });
}

void check_ibag(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.model == nullptr || c.model->has_monitored_volume || c.model->has_ale ||
      c.model->has_sol2sph)
    return;
  each(c, rule, [&](const ContactCard& card) {
    if (const double v = card.input("Ibag"); v == 0 || v == 1000) return;
    Diagnostic* d = report_at(r, rule, card, "Ibag",
                              name_of(card) + ": " + card.show("Ibag") +
                                  ", but the deck has no airbag (/MONVOL), ALE or Sol2SPH");
    fix_field(d, c, card, "Ibag", "1000", true, "write Ibag 1000 (no closure)");
  });
}

void check_thermal_material(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.model == nullptr || c.model->has_thermal_material) return;
  each(c, rule, [&](const ContactCard& card) {
    if (card.given("Ithe"))
      report_at(r, rule, card, "Ithe",
                name_of(card) + ": Ithe = " + number_text(card.input("Ithe")) +
                    ", but no material has thermal data (/HEAT/MAT)");
  });
}

/// The solver's filter factor of Xfreq.
double filter_factor(std::int64_t ifiltr, double xfreq) {
  constexpr double two_pi = 2 * std::numbers::pi;
  if (ifiltr == 1) return xfreq;
  return ifiltr == 2 ? two_pi / xfreq : two_pi * xfreq;
}

std::string filter_problem(std::int64_t ifiltr, double xfreq) {
  if (ifiltr < 1 || ifiltr > 3 || xfreq == 0) return {};
  const double alpha = filter_factor(ifiltr, xfreq);
  if (alpha < 0) return "the filter factor is negative: " + number_text(alpha);
  if (alpha > 1 && ifiltr <= 2)
    return "the filter factor is " + number_text(alpha) + "; it must be at most 1";
  return {};
}

void check_filter(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.given("fric_ID")) return;
    const std::string problem =
        filter_problem(static_cast<std::int64_t>(card.input("Ifiltr")), card.input("Xfreq"));
    if (!problem.empty())
      note_field(report_at(r, rule, card, "Xfreq", name_of(card) + ": " + problem), card, "Ifiltr");
  });
  for (const DecodedBlock& block : c.frictions) {
    const Cell* cell = block.find("Xfreq");
    if (cell == nullptr) continue;
    const std::string problem =
        filter_problem(block.integer("Ifiltr"), working_value(c.deck, block, *cell));
    if (problem.empty()) continue;
    Diagnostic* d = r.report(rule, *block.block, cell->span,
                             "/FRICTION " + std::to_string(block.block->id.value) + ": " + problem);
    if (d != nullptr) d->reference = ReferenceMessage{1591, Severity::error};
  }
}

void check_gap_order(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    const double low = card.input("Gapmin"), high = card.input("Gapmax");
    if (card.flag("Igap") < 2 || !(low > 0) || !(high > 0) || !(low > high)) return;
    note_field(report_at(r, rule, card, "Gapmax",
                         fmt::format("{}: Gapmax ({}) is below Gapmin ({})", name_of(card),
                                     number_text(high), number_text(low))),
               card, "Gapmin");
  });
}

void check_stiffness_order(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    const double low = card.input("Stmin"), high = card.input("Stmax");
    if (!(low > 0) || !(high > 0) || !(low > high)) return;
    note_field(report_at(r, rule, card, "Stmax",
                         fmt::format("{}: Stmax ({}) is below Stmin ({})", name_of(card),
                                     number_text(high), number_text(low))),
               card, "Stmin");
  });
}

void check_no_stfac(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.flag("Istf") != 1 || card.given("Stfac")) return;
    Diagnostic* d = report_at(r, rule, card, "Stfac",
                              name_of(card) +
                                  ": Istf = 1 makes Stfac the stiffness, and Stfac is "
                                  "0");
    note_field(d, card, "Istf");
    // The default is 1 in working units: in a block of other units 1.0 would be something else.
    const UnitSystem* units = c.deck.units_of(*card.block);
    if (units == nullptr || *units == c.deck.begin.working)
      fix_field(d, c, card, "Stfac", "1.0", true, "write what is used: 1.0");
  });
}

void check_no_law(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    const double law = card.input("Ifric");
    if (card.given("fric_ID") || law <= 0 || law == 3) return;
    for (const std::string_view k : {"C1", "C2", "C3", "C4", "C5", "C6"})
      if (card.given(k)) return;
    report_at(r, rule, card, "Ifric",
              fmt::format("{}: Ifric = {} with all coefficients 0 leaves mu = {}", name_of(card),
                          number_text(law), number_text(card.value("Fric"))));
  });
}

void check_no_sink(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (!card.given("Ithe") || (card.find("Kthe") == nullptr && card.find("Rthe") == nullptr))
      return;
    for (const std::string_view k : {"Kthe", "Rthe", "fct_IDK", "Frad", "Fheats", "Fheatm"})
      if (card.given(k)) return;
    report_at(r, rule, card, "Ithe",
              name_of(card) +
                  ": heat exchange is on, but there is no conductance, radiation or "
                  "friction heat");
  });
}

void check_old_heat(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts)
    if (card.type == 7 && card.block->version >= 90 && card.block->version < 100 &&
        card.input("Ithe") == 1)
      report_at(r, rule, card, "Ithe",
                name_of(card) + ": in version 90 a heat line is read for Ithe above 1 only");
}

void check_angles(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (c.interfaces == nullptr || !card.given("fric_ID")) return;
    const Friction* f = c.interfaces->friction(static_cast<std::int64_t>(card.value("fric_ID")));
    if (f == nullptr || f->Ifric == 0) return;
    Diagnostic* d = report_at(
        r, rule, card, "fric_ID",
        fmt::format("{} uses /FRICTION {} with Ifric = {}", name_of(card), f->id, f->Ifric));
    if (d != nullptr) d->notes.emplace_back(f->span, "the friction is defined here");
  });
}

void add_friction_rules(std::vector<Rule>& out) {
  out.push_back({.id = "DK250",
                 .title = "Renard friction curve is impossible",
                 .severity = Severity::warning,
                 .problem = "The six coefficients of Ifric = 3 do not form a Renard curve.",
                 .why = "The curve starts at C1, rises to C3 at speed C5, falls to C4 at C6 and "
                        "tends to C2. It needs 0 < C5 < C6, C4 < C1 < C3 and C4 < C2 < C3.",
                 .solver = "it does not check; the coefficient can become negative or infinite",
                 .fix = "check the order of the coefficients",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1 Ifric=3 C1=0.1 C2=0.2 C3=0.3 C4=0.05 C5=2.0 C6=1.0\n",
                 .good = "@/INTER/TYPE7/1 Ifric=3 C1=0.1 C2=0.2 C3=0.3 C4=0.05 C5=1.0 C6=2.0\n",
                 .check = check_renard});
  out.push_back({.id = "DK260",
                 .title = "friction filter factor outside 0 to 1",
                 .severity = Severity::error,
                 .problem = "Ifiltr and Xfreq give a filter factor below 0 or above 1.",
                 .why = "The factor is Xfreq for Ifiltr 1, 2*pi/Xfreq for Ifiltr 2 (Xfreq counts "
                        "time steps), 2*pi*Xfreq for Ifiltr 3. The filter is stable up to 1.",
                 .solver = "it stops with an error (for Ifiltr 3 only if negative)",
                 .message = 554,
                 .message_severity = Severity::error,
                 .fix = "Ifiltr 1: 0 < Xfreq <= 1; Ifiltr 2: Xfreq >= 6.3",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1 Fric=0.1 Ifiltr=1 Xfreq=2.0\n",
                 .good = "@/INTER/TYPE7/1 Fric=0.1 Ifiltr=1 Xfreq=0.2\n",
                 .check = check_filter});
  out.push_back({.id = "DK262",
                 .title = "friction law without coefficients",
                 .severity = Severity::warning,
                 .problem = "Ifric selects a law, and all its coefficients are 0.",
                 .why = "What is left of the law is constant: Ifric 1 and 2 give mu = Fric, "
                        "Ifric 4 decays to 0.",
                 .solver = "it computes the law with zeros",
                 .fix = "give the coefficients, or set Ifric 0",
                 .ignore = "When Fric alone is meant.",
                 .bad = "@/INTER/TYPE7/1 Fric=0.1 Ifric=1\n",
                 .good = "@/INTER/TYPE7/1 Fric=0.1 Ifric=1 C2=0.01\n",
                 .check = check_no_law});
  out.push_back({.id = "DK264",
                 .title = "TYPE11 with a friction law it does not have",
                 .severity = Severity::warning,
                 .problem = "fric_ID of a TYPE11 names a /FRICTION with Ifric above 0.",
                 .why = "Edge contact knows Coulomb friction only.",
                 .solver = "it warns and uses the Coulomb part",
                 .message = 1595,
                 .fix = "refer to a /FRICTION with Ifric 0",
                 .ignore = "When the same /FRICTION serves a TYPE7 and the Coulomb part will do "
                           "for the edges.",
                 .bad = "@/FRICTION/1 Ifric=1 C1=0.1 Fric=0.1\n@/INTER/TYPE11/1 fric_ID=1\n",
                 .good = "@/FRICTION/1 Ifric=0 C1=0.0 Fric=0.1\n@/INTER/TYPE11/1 fric_ID=1\n",
                 .check = check_angles});
}

void add_thermal_rules(std::vector<Rule>& out) {
  out.push_back({.id = "DK251",
                 .title = "more friction heat than friction energy",
                 .severity = Severity::warning,
                 .problem = "Fheats + Fheatm is above 1.",
                 .why = "They are the shares of the friction energy that heat the two sides.",
                 .solver = "it warns and creates the surplus",
                 .message = 1064,
                 .fix = "make them add up to at most 1",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1 Fric=0.2 Ithe=1 Kthe=1.0 Fheats=0.7 Fheatm=0.7\n",
                 .good = "@/INTER/TYPE7/1 Fric=0.2 Ithe=1 Kthe=1.0 Fheats=0.5 Fheatm=0.5\n",
                 .check = check_heat_sum});
  out.push_back({.id = "DK259",
                 .title = "heat exchange without thermal material",
                 .severity = Severity::warning,
                 .problem = "Ithe is set, and no material has thermal data.",
                 .why = "There are no temperatures to exchange heat between.",
                 .solver = "it warns and switches heat exchange off",
                 .message = 702,
                 .fix = "add /HEAT/MAT to the materials, or set Ithe 0",
                 .ignore = "When the thermal data are delivered separately.",
                 .bad = "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0\n",
                 .good = "/HEAT/MAT/1\n               293.0                 3.8\n\n\n"
                         "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0\n",
                 .check = check_thermal_material});
  out.push_back({.id = "DK261",
                 .title = "heat exchange without any way for heat",
                 .severity = Severity::warning,
                 .problem = "Ithe is set, but conductance, radiation and friction heat are all 0.",
                 .why = "Without a function the default conductance is 1e-30: nothing flows.",
                 .solver = "it computes with 1e-30",
                 .fix = "give Kthe or fct_IDK, Frad, or Fheats and Fheatm",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1 Ithe=1\n",
                 .good = "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0\n",
                 .check = check_no_sink});
  out.push_back({.id = "DK263",
                 .title = "version 90: Ithe = 1 has no heat line",
                 .severity = Severity::warning,
                 .problem = "In decks of version 90 the heat line is read for Ithe above 1 only.",
                 .why = "A heat line behind Ithe = 1 is one line too many there, and the "
                        "coefficients are 0.",
                 .solver = "it reads no heat line",
                 .fix = "raise the version of the deck",
                 .ignore = "When the card has no heat line.",
                 .bad = "@version 90\n@/INTER/TYPE7/1 Ithe=1\n",
                 .good = "@version 100\n@/INTER/TYPE7/1 Ithe=1 Rthe=1.0\n",
                 .check = check_old_heat});
}

void add_flag_pairs(std::vector<Rule>& out) {
  out.push_back({.id = "DK252",
                 .title = "contact stops before it starts",
                 .severity = Severity::warning,
                 .problem = "Tstart is not below Tstop.",
                 .why = "The interface never acts.",
                 .solver = "it accepts the card; the contact is never active",
                 .fix = "exchange or correct the times; Tstop 0 means 'to the end'",
                 .ignore = "When the contact is switched off this way on purpose.",
                 .bad = "@/INTER/TYPE7/1 Tstart=5.0 Tstop=2.0\n",
                 .good = "@/INTER/TYPE7/1 Tstart=2.0 Tstop=5.0\n",
                 .check = check_times});
  out.push_back({.id = "DK253",
                 .title = "curved gap without its nodes",
                 .severity = Severity::error,
                 .problem =
                     "Icurv = 1 needs node_ID1, Icurv = 2 needs node_ID1 and node_ID2 at two "
                     "different places.",
                 .why = "They are the centre of the sphere, or two points on the axis of the "
                        "cylinder.",
                 .solver = "it stops with an error",
                 .message = 1727,
                 .message_severity = Severity::error,
                 .fix = "give the nodes on the optional line behind line 3",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1 Icurv=2 node_ID1=1\n",
                 .good = "@/INTER/TYPE7/1 Icurv=2 node_ID1=1 node_ID2=2\n",
                 .check = check_curvature_nodes});
  out.push_back({.id = "DK254",
                 .title = "TYPE10 with Inacti 5",
                 .severity = Severity::error,
                 .problem = "A TYPE10 asks for Inacti 5.",
                 .why = "Tied contact has a constant gap; it cannot be reduced in time.",
                 .solver = "it stops with an error",
                 .message = 1162,
                 .message_severity = Severity::error,
                 .fix = "write 0",
                 .ignore = "Never.",
                 .fixable = Fixable::unsafe,
                 .bad = "@/INTER/TYPE10/1 Inacti=5\n",
                 .good = "@/INTER/TYPE10/1 Inacti=0\n",
                 .check = check_type10_inacti});
  out.push_back({.id = "DK255",
                 .title = "TYPE11 with Igap 2",
                 .severity = Severity::error,
                 .problem = "A TYPE11 has Igap 2, on its card or from /DEFAULT/INTER/TYPE11.",
                 .why = "Edge contact has no scaled gap.",
                 .solver = "it stops with an error",
                 .message = 1056,
                 .message_severity = Severity::error,
                 .fix = "write 1 (variable) or 3 (variable, limited by the mesh)",
                 .ignore = "Never.",
                 .fixable = Fixable::unsafe,
                 .bad = "@/INTER/TYPE11/1 Igap=2\n",
                 .good = "@/INTER/TYPE11/1 Igap=1\n",
                 .check = check_type11_igap});
  out.push_back({.id = "DK256",
                 .title = "adaptive meshing with a curved gap",
                 .severity = Severity::error,
                 .problem = "Iadm and Icurv are both set.",
                 .why = "The two are not available together.",
                 .solver = "it stops with an error",
                 .message = 648,
                 .message_severity = Severity::error,
                 .fix = "set one of them to 0",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1 Iadm=1 Icurv=3\n",
                 .good = "@/INTER/TYPE7/1 Iadm=0 Icurv=3\n",
                 .check = check_iadm_icurv});
  out.push_back({.id = "DK257",
                 .title = "Iadm without adaptive mesh",
                 .severity = Severity::warning,
                 .problem = "Iadm is set, and the deck defines no adaptive mesh.",
                 .why = "There is nothing to refine.",
                 .solver = "it warns and ignores Iadm",
                 .message = 647,
                 .fix = "define /ADMESH, or set Iadm 0",
                 .ignore = "When the mesh is delivered separately.",
                 .bad = "@/INTER/TYPE7/1 Iadm=1\n",
                 .good = "@/INTER/TYPE7/1 Iadm=0\n",
                 .check = check_iadm});
  out.push_back({.id = "DK258",
                 .title = "Ibag without airbag",
                 .severity = Severity::warning,
                 .problem = "Ibag is set, and the deck has no monitored volume, ALE or Sol2SPH.",
                 .why = "There is no vent hole to close.",
                 .solver = "it warns and ignores Ibag",
                 .message = 614,
                 .fix = "write 1000",
                 .ignore = "When the airbag is delivered separately.",
                 .fixable = Fixable::safe,
                 .bad = "@/INTER/TYPE7/1 Ibag=1\n",
                 .good = "@/INTER/TYPE7/1 Ibag=1000\n",
                 .check = check_ibag});
}

void add_bounds(std::vector<Rule>& out) {
  out.push_back(
      {.id = "DK219",
       .title = "Istf 1 without a stiffness",
       .severity = Severity::warning,
       .problem = "Istf = 1 takes Stfac as the stiffness itself, and Stfac is 0 or blank.",
       .why = "The default of Stfac is 1, which is a sensible factor but an arbitrary "
              "stiffness.",
       .solver = "it takes 1 in the units of the deck",
       .fix = "write the stiffness, or use Istf 4 or 1000 with a factor",
       .ignore = "When a stiffness of 1 is meant.",
       .fixable = Fixable::safe,
       .bad = "@/INTER/TYPE7/1 Istf=1 Stfac=0\n",
       .good = "@/INTER/TYPE7/1 Istf=1 Stfac=5.0\n",
       .check = check_no_stfac});
  out.push_back({.id = "DK220",
                 .title = "Gapmax below Gapmin",
                 .severity = Severity::warning,
                 .problem = "The upper bound of the variable gap is below the lower one.",
                 .why = "The gap is max(Gapmin, min(Gapmax, gs + gm)): it is always Gapmin, and "
                        "the gap is no longer variable.",
                 .solver = "it computes the formula",
                 .fix = "raise Gapmax, lower Gapmin, or use Igap 1000",
                 .ignore = "When a constant gap is meant.",
                 .bad = "@/INTER/TYPE7/1 Igap=2 Gapmin=2.0 Gapmax=1.0\n",
                 .good = "@/INTER/TYPE7/1 Igap=2 Gapmin=1.0 Gapmax=2.0\n",
                 .check = check_gap_order});
  out.push_back({.id = "DK245",
                 .title = "Stmax below Stmin",
                 .severity = Severity::warning,
                 .problem = "The upper bound of the contact stiffness is below the lower one.",
                 .why = "K = max(Stmin, min(Stmax, K_n)): the stiffness is always Stmin.",
                 .solver = "it computes the formula",
                 .fix = "exchange the bounds, or use Istf 1 for a constant stiffness",
                 .ignore = "When a constant stiffness is meant.",
                 .bad = "@/INTER/TYPE7/1 Istf=4 Stmin=5.0 Stmax=1.0\n",
                 .good = "@/INTER/TYPE7/1 Istf=4 Stmin=1.0 Stmax=5.0\n",
                 .check = check_stiffness_order});
}

}  // namespace

void add_combination_rules(std::vector<Rule>& out) {
  add_friction_rules(out);
  add_thermal_rules(out);
  add_flag_pairs(out);
  add_bounds(out);
}

}  // namespace deck::detail
