// Fields that have no effect, because the solver never reads them or because another flag of the
// same card switches them off. A table: one entry per reason.
#include <algorithm>
#include <functional>

#include "lint/check.hpp"
#include "lint/rule_tables.hpp"

namespace deck::detail {
namespace {

/// Reports those of `fields` that the card gives although `cause` makes them useless.
void ignored(const LintContext& c, const Rule& rule, Reporter& r, const ContactCard& card,
             std::initializer_list<std::string_view> fields, std::string_view cause,
             const std::string& reason, bool safe) {
  for (const std::string_view field : fields) {
    if (!card.given(field)) continue;
    const FieldView* f = card.find(field);
    if (f == nullptr || f->field == nullptr) continue;  // not on this card
    Diagnostic* d = report_at(
        r, rule, card, field,
        fmt::format("{} of {} has no effect: {}", std::string(field) + " = " + std::string(f->text),
                    name_of(card), reason));
    if (!cause.empty()) note_field(d, card, cause);
    fix_field(d, c, card, field, "", safe, "blank " + std::string(field));
  }
}

void check_gap_scale(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.flag("Igap") >= 2) return;
    ignored(c, rule, r, card, {"Gapmax"}, "Igap", card.show("Igap") + " knows no upper bound",
            false);
    if (card.input("Fscalegap") != 1)
      ignored(c, rule, r, card, {"Fscalegap"}, "Igap", card.show("Igap") + " scales no gap", false);
  });
}

void check_mesh_size(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.flag("Igap") != 3)
      ignored(c, rule, r, card, {"%mesh_size"}, "Igap",
              "only Igap 3 limits the gap by the mesh, here " + card.show("Igap"), false);
  });
}

void check_bounds(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    const auto istf = card.flag("Istf");
    const bool used = card.type == 11 ? istf != 1 : istf > 1;
    if (!used)
      ignored(c, rule, r, card, {"Stmin", "Stmax"}, "Istf", card.show("Istf") + " is not bounded",
              false);
  });
}

void check_friction_source(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.given("fric_ID"))
      ignored(c, rule, r, card,
              {"Fric", "VISF", "Ifric", "Ifiltr", "Xfreq", "Iform", "C1", "C2", "C3", "C4", "C5",
               "C6", "fct_IDF"},
              "fric_ID", "friction comes from /FRICTION", false);
  });
}

void check_second_node(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.flag("Icurv") == 1)
      ignored(c, rule, r, card, {"node_ID2"}, "Icurv", "a sphere has one centre", false);
  });
}

void check_visf(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.given("fric_ID")) return;
    if (card.flag("Iform") == 2)
      ignored(c, rule, r, card, {"VISF"}, "Iform",
              "the incremental formulation (Iform 2) has no viscosity", false);
  });
}

void check_no_friction(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.given("fric_ID") || card.given("Fric") || card.given("Ifric") || card.given("fct_IDF"))
      return;
    ignored(c, rule, r, card, {"Ifiltr", "Fheats", "Fheatm"}, "Fric", "there is no friction",
            false);
  });
}

/// Coefficients that a law does not have: Ifric 3 has no Fric, 4 has C1 and C2 only.
void check_coefficients(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.given("fric_ID")) return;
    if (card.input("Ifric") == 3)
      ignored(c, rule, r, card, {"Fric"}, "Ifric",
              "the law Ifric 3 (Renard) is given by C1 to C6 alone", false);
    if (card.input("Ifric") == 4)
      ignored(c, rule, r, card, {"C3", "C4", "C5", "C6"}, "Ifric",
              "the law Ifric 4 has C1 and C2 only", false);
  });
}

void check_never_read(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts) {
    if (rule.id == "DK275")
      ignored(c, rule, r, card, {"Multimp"}, "", "the size of the impact list is found by itself",
              true);
    else if (card.type == 19)
      ignored(c, rule, r, card, {"Iedge"}, "", "the solver never reads this cell", true);
  }
}

void check_function_scale(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.input("AscaleF") != 1)
      ignored(c, rule, r, card, {"AscaleF"}, "fct_IDF",
              card.given("fct_IDF") ? "the solver reads fct_IDF at the plain temperature"
                                    : "there is no fct_IDF",
              false);
    if (!card.given("fct_IDK") && card.input("AscaleK") != 1)
      ignored(c, rule, r, card, {"AscaleK"}, "fct_IDK", "there is no fct_IDK", false);
  });
}

void check_tint(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.input("Ithe_form") == 1)
      ignored(c, rule, r, card, {"Tint"}, "Ithe_form",
              "with Ithe_form 1 the main side has its own temperature", false);
  });
}

void check_drad(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (!card.given("Frad"))
      ignored(c, rule, r, card, {"Drad"}, "Frad", "Frad is 0, nothing radiates", false);
  });
}

void check_type10_penetration(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (const double v = card.input("Inacti"); v != 5 && v != 1000)
      ignored(c, rule, r, card, {"Inacti"}, "",
              "initial penetrations of a tied contact are only counted", true);
  });
}

/// Some secondary node belongs to the main surface (TYPE7); also where one of them is unknown.
bool share_nodes(const LintContext& c, const ContactCard& card) {
  const NodeSet* group =
      c.selections->node_group(static_cast<std::int64_t>(card.value("grnd_IDs")));
  const Surface* main = c.selections->surface(static_cast<std::int64_t>(card.value("surf_IDm")));
  if (c.model == nullptr || group == nullptr || main == nullptr) return true;
  std::vector<bool> on_main(c.model->nodes.size(), false);
  for (const Segment& s : main->segments)
    for (const NodeIndex n : s.nodes)
      if (n != no_index) on_main[n] = true;
  return std::any_of(group->nodes.begin(), group->nodes.end(),
                     [&](NodeIndex n) { return n != no_index && on_main[n]; });
}

void check_removal(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.input("Irem_gap") != 2) return;
    std::string_view one = card.type == 7 ? "grnd_IDs" : card.type == 11 ? "line_IDs" : "surf_IDs";
    std::string_view two = card.type == 11 ? "line_IDm" : "surf_IDm";
    if (c.selections == nullptr || !card.given(one) || !card.given(two)) return;
    if (card.type == 7 ? share_nodes(c, card) : card.input(one) == card.input(two)) return;
    ignored(c, rule, r, card, {"Irem_gap"}, one, "the two sides are different: no self contact",
            false);
  });
}

constexpr std::string_view problem = "A field has a value that nothing reads.";
constexpr std::string_view belief =
    "Whoever reads the card believes in an effect that is not there.";

void add_ignored(std::vector<Rule>& out, std::string_view id, std::string_view title,
                 std::string_view reason, std::string_view solver, std::string_view fix,
                 std::string_view bad, std::string_view good,
                 void (*check)(const LintContext&, const Rule&, Reporter&),
                 Severity severity = Severity::warning, Fixable fixable = Fixable::unsafe) {
  out.push_back({.id = id,
                 .title = title,
                 .severity = severity,
                 .problem = problem,
                 .why = reason.empty() ? belief : reason,
                 .solver = solver,
                 .fix = fix,
                 .ignore = "When the value is kept for later on purpose.",
                 .fixable = fixable,
                 .bad = bad,
                 .good = good,
                 .check = check});
}

}  // namespace

void add_ignored_rules(std::vector<Rule>& out) {
  add_ignored(
      out, "DK265", "Fscalegap or Gapmax without Igap 2 or 3",
      "The gap is constant (Igap 1000) or plainly variable (Igap 1); only Igap 2 and 3 scale and "
      "cap it.",
      "it ignores both and sets Gapmax to 1e30", "set Igap 2 or 3, or blank the fields",
      "@/INTER/TYPE7/1 Igap=1000 Gapmin=1.0 Gapmax=2.0\n",
      "@/INTER/TYPE7/1 Igap=2 Gapmin=1.0 Gapmax=2.0\n", check_gap_scale);
  add_ignored(out, "DK266", "%mesh_size without Igap 3",
              "Only Igap 3 limits the gap by the mesh size.",
              "it reads the value and does not use it", "set Igap 3, or blank the field",
              "@/INTER/TYPE7/1 Igap=2 %mesh_size=0.4\n", "@/INTER/TYPE7/1 Igap=3 %mesh_size=0.4\n",
              check_mesh_size);
  add_ignored(
      out, "DK267", "Stmin or Stmax without a combined stiffness",
      "The bounds apply to the combined stiffness of Istf 2 to 5. dtmin, in the same line, acts "
      "whatever Istf is.",
      "it sets Stmin to 0 and Stmax to 1e30", "set Istf 2 to 5, or blank the fields",
      "@/INTER/TYPE7/1 Istf=1000 Stmax=5.0\n", "@/INTER/TYPE7/1 Istf=4 Stmax=5.0\n", check_bounds);
  add_ignored(
      out, "DK269", "friction on the card with fric_ID",
      "fric_ID replaces the friction of the interface as a whole: law, formulation, filter, "
      "coefficients and the function of temperature.",
      "it uses /FRICTION only", "blank the fields, or set fric_ID 0",
      "@/FRICTION/1 C1=0.0 Fric=0.1\n@/INTER/TYPE7/1 Fric=0.3 fric_ID=1\n",
      "@/FRICTION/1 C1=0.0 Fric=0.1\n@/INTER/TYPE7/1 fric_ID=1\n", check_friction_source);
  add_ignored(out, "DK270", "node_ID2 with a spherical gap",
              "Icurv 1 needs the centre of the sphere only.",
              "it reads the node and does not use it", "blank node_ID2, or set Icurv 2",
              "@/INTER/TYPE7/1 Icurv=1 node_ID1=1 node_ID2=2\n",
              "@/INTER/TYPE7/1 Icurv=1 node_ID1=1\n", check_second_node);
  add_ignored(out, "DK271", "VISF with the incremental formulation",
              "VISF is the viscosity of the viscous formulation, Iform 1.", "it sets VISF to 0",
              "blank VISF, or set Iform 1", "@/INTER/TYPE7/1 Fric=0.2 Iform=2 VISF=0.5\n",
              "@/INTER/TYPE7/1 Fric=0.2 Iform=1 VISF=0.5\n", check_visf, Severity::info);
  add_ignored(
      out, "DK272", "filter or friction heat without friction",
      "Fric is 0 and no law is selected: there is no tangential force to filter and no heat.",
      "it computes no friction", "give Fric, or blank the fields",
      "@/INTER/TYPE7/1 Fric=0 Ifiltr=1 Xfreq=0.5\n",
      "@/INTER/TYPE7/1 Fric=0.2 Ifiltr=1 Xfreq=0.5\n", check_no_friction, Severity::info);
  add_ignored(
      out, "DK273", "coefficient that the friction law does not have",
      "mu = C1 + (Fric - C1) exp(-C2 v) for Ifric 4; the curve of Ifric 3 goes through C1 to C6 "
      "and has no Fric.",
      "it ignores the others", "blank them, or check Ifric",
      "@/INTER/TYPE7/1 Fric=0.2 Ifric=4 C1=0.1 C2=0.01 C3=0.5\n",
      "@/INTER/TYPE7/1 Fric=0.2 Ifric=4 C1=0.1 C2=0.01\n", check_coefficients);
  add_ignored(
      out, "DK274", "Iedge of TYPE19 is never read",
      "Manuals let Iedge choose the edges of the TYPE11 part. The cell is not read: the edges "
      "follow Iedge of /DEFAULT/INTER/TYPE19, or are all edges.",
      "it ignores the cell", "set Iedge in /DEFAULT/INTER/TYPE19", "@/INTER/TYPE19/1 Iedge=1\n",
      "@/DEFAULT/INTER/TYPE19 Iedge=1\n@/INTER/TYPE19/1\n", check_never_read, Severity::warning,
      Fixable::safe);
  add_ignored(out, "DK275", "Multimp is never used",
              "Old versions let Multimp size the list of impacts; it is sized by itself now.",
              "it reads the cell and uses 4", "blank the cell",
              "@version 110\n@/INTER/TYPE7/1 Multimp=12\n", "@version 110\n@/INTER/TYPE7/1\n",
              check_never_read, Severity::info, Fixable::safe);
  add_ignored(
      out, "DK276", "scale of a function without effect",
      "AscaleK scales the abscissa of fct_IDK and needs that function. AscaleF should scale the "
      "abscissa of fct_IDF, but the solver never applies it.",
      "it reads the value and does not use it", "name the function, or blank the scale",
      "@/INTER/TYPE7/1 Fric=0.2 AscaleF=2.0\n", "@/INTER/TYPE7/1 Fric=0.2 fct_IDF=1\n",
      check_function_scale);
  add_ignored(out, "DK277", "Tint with heat exchange between both sides",
              "Tint is the temperature of the interface where only the secondary side is warm "
              "(Ithe_form 0).",
              "it does not use Tint", "blank Tint, or set Ithe_form 0",
              "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0 Ithe_form=1 Tint=300.0\n",
              "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0 Ithe_form=0 Tint=300.0\n", check_tint);
  add_ignored(out, "DK278", "radiation distance without radiation",
              "Drad is the reach of radiation, Frad its factor.",
              "it stores the distance, and the search may use it", "give Frad, or blank Drad",
              "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0 Drad=5.0\n",
              "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0 Frad=1.0e-12 Drad=5.0\n", check_drad,
              Severity::info);
  add_ignored(out, "DK279", "Inacti of a tied contact does nothing",
              "TYPE10 allows initial penetrations inside its gap.",
              "it prints Inacti and only counts penetrations", "blank Inacti",
              "@/INTER/TYPE10/1 Inacti=6\n", "@/INTER/TYPE10/1\n", check_type10_penetration,
              Severity::info, Fixable::safe);
  add_ignored(
      out, "DK280", "Irem_gap 2 between two different sides",
      "Irem_gap 2 drops neighbours along the same mesh, so it matters in self contact only.",
      "it finds nothing to drop unless the sides share nodes", "set Irem_gap 1",
      "@/INTER/TYPE11/1 line_IDs=2 line_IDm=1 Irem_gap=2\n",
      "@/INTER/TYPE11/1 line_IDs=1 line_IDm=1 Irem_gap=2\n", check_removal, Severity::info);
}

}  // namespace deck::detail
