// Fields that have no effect, because the solver never reads them or because another flag of the
// same card switches them off. A table: one entry per reason.
#include <algorithm>
#include <functional>

#include "lint/check.hpp"
#include "lint/check_tables.hpp"

namespace deck::detail {
namespace {

/// Reports those of `fields` that the card gives although `cause` makes them useless.
void ignored(const LintContext& c, const Rule& rule, Reporter& r, const ContactCard& card,
             std::initializer_list<std::string_view> fields, std::string_view cause,
             const std::string& reason, bool safe) {
  for (const std::string_view field : fields) {
    if (!card.bounds(field)) continue;
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

void check_istf_bounds(const LintContext& c, const Rule& rule, Reporter& r) {
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
      ignored(c, rule, r, card, {"Fric"}, "Ifric", "the law Ifric 3 (Renard) uses C1 to C6 only",
              false);
    if (card.input("Ifric") == 4)
      ignored(c, rule, r, card, {"C3", "C4", "C5", "C6"}, "Ifric",
              "the law Ifric 4 uses C1 and C2 only", false);
  });
}

void check_never_read(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts) {
    if (rule.id == RuleId::DK275)
      ignored(c, rule, r, card, {"Multimp"}, "", "the solver sizes its impact list itself", true);
    else if (card.type == 19)
      ignored(c, rule, r, card, {"Iedge"}, "", "the solver never reads this cell", true);
  }
}

void check_function_scale(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.input("AscaleF") != 1)
      ignored(c, rule, r, card, {"AscaleF"}, "fct_IDF",
              card.given("fct_IDF") ? "the solver evaluates fct_IDF at the unscaled temperature"
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
      ignored(c, rule, r, card, {"Drad"}, "Frad", "Frad is 0, so nothing radiates", false);
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
  const auto main = c.selections->outline(static_cast<std::int64_t>(card.value("surf_IDm")));
  if (group == nullptr || !main) return true;
  std::vector<bool> on_main(c.model->nodes.size(), false);
  main->segments.each([&](const Segment& s) {
    for (const NodeIndex n : s.nodes)
      if (n != no_index) on_main[n] = true;
  });
  return std::any_of(group->nodes.begin(), group->nodes.end(),
                     [&](NodeIndex n) { return n != no_index && on_main[n]; });
}

void check_removal(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.input("Irem_gap") != 2) return;
    const InterfaceTraits* const traits = traits_of(card.type);
    if (traits == nullptr) return;
    const std::string_view one = traits->secondary.field, two = traits->main.field;
    if (!card.given(one) || !card.given(two)) return;
    if (card.type == 7 ? share_nodes(c, card) : card.input(one) == card.input(two)) return;
    ignored(c, rule, r, card, {"Irem_gap"}, one, "the two sides are different: no self contact",
            false);
  });
}

}  // namespace

std::span<const Checked> ignored_checks() {
  static constexpr Checked all[] = {
      {RuleId::DK265, check_gap_scale},      {RuleId::DK266, check_mesh_size},
      {RuleId::DK267, check_istf_bounds},    {RuleId::DK269, check_friction_source},
      {RuleId::DK270, check_second_node},    {RuleId::DK271, check_visf},
      {RuleId::DK272, check_no_friction},    {RuleId::DK273, check_coefficients},
      {RuleId::DK274, check_never_read},     {RuleId::DK275, check_never_read},
      {RuleId::DK276, check_function_scale}, {RuleId::DK277, check_tint},
      {RuleId::DK278, check_drad},           {RuleId::DK279, check_type10_penetration},
      {RuleId::DK280, check_removal},
  };
  return all;
}

}  // namespace deck::detail
