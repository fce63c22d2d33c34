// Fields that have no effect, because the solver never reads them or because another flag of the
// same card switches them off.
#include <algorithm>

#include "lint/check.hpp"

namespace deck::detail {
namespace {

/// Reports fields of one card.
class Ignored {
 public:
  Ignored(const LintContext& c, const Rule& rule, Reporter& r, const ContactCard& card)
      : c_(c), rule_(rule), r_(r), card_(card) {}

  /// Those of `fields` that the card gives although `cause` makes them useless; no cause: nothing
  /// reads them. `safe`: to blank them.
  void operator()(std::initializer_list<std::string_view> fields, std::string_view cause,
                  std::string_view reason, bool safe = false) const {
    for (const std::string_view field : fields) {
      const FieldView* f = card_.bounds(field) ? card_.find(field) : nullptr;
      if (f == nullptr || f->field == nullptr) continue;  // not on this card
      Diagnostic* d = report_at(
          r_, rule_, card_, field,
          fmt::format("{} = {} of {} has no effect: {}", field, f->text, name_of(card_), reason));
      if (!cause.empty()) note_field(d, card_, cause);
      fix_field(d, c_, card_, field, "", safe, "blank " + std::string(field));
    }
  }

 private:
  const LintContext& c_;
  const Rule& rule_;
  Reporter& r_;
  const ContactCard& card_;
};

/// Some secondary node belongs to the main surface (TYPE7); also where one of them is unknown.
bool share_nodes(const LintContext& c, const ContactCard& card) {
  const NodeSet* group = c.selections->node_group(card.id("grnd_IDs"));
  const auto main = c.selections->outline(card.id("surf_IDm"));
  if (group == nullptr || !main) return true;
  const std::vector<bool> on_main = marked(*c.model, [&](auto&& mark) {
    main->segments.each([&](const Segment& s) {
      for (const NodeIndex n : s.nodes) mark(n);
    });
  });
  return std::any_of(group->nodes.begin(), group->nodes.end(),
                     [&](NodeIndex n) { return n != no_index && on_main[n]; });
}

/// Between two sides without common nodes.
bool is_no_self_contact(const LintContext& c, const ContactCard& card) {
  const InterfaceTraits* const traits = traits_of(card.type);
  if (traits == nullptr) return false;
  const std::string_view one = traits->secondary.field, two = traits->main.field;
  if (!card.given(one) || !card.given(two)) return false;
  return card.type == 7 ? !share_nodes(c, card) : card.input(one) != card.input(two);
}

void ignored_gap_and_stiffness(const LintContext& c, const ContactCard& card, const Ignored& tell) {
  const std::string igap = card.show("Igap");
  if (card.flag("Igap") < 2) {
    tell({"Gapmax"}, "Igap", igap + " knows no upper bound");
    if (card.input("Fscalegap") != 1) tell({"Fscalegap"}, "Igap", igap + " scales no gap");
  }
  if (card.flag("Igap") != 3)
    tell({"%mesh_size"}, "Igap", "only Igap 3 limits the gap by the mesh, here " + igap);
  if (const auto istf = card.flag("Istf"); card.type == 11 ? istf == 1 : istf <= 1)
    tell({"Stmin", "Stmax"}, "Istf", card.show("Istf") + " is not bounded");
  if (card.flag("Icurv") == 1) tell({"node_ID2"}, "Icurv", "a sphere has one centre");
  if (card.type == 19) tell({"Iedge"}, "", "the solver never reads this cell", true);
  if (const double v = card.input("Inacti"); card.type == 10 && v != 5 && v != 1000)
    tell({"Inacti"}, "", "initial penetrations of a tied contact are only counted", true);
  if (card.input("Irem_gap") == 2 && is_no_self_contact(c, card))
    tell({"Irem_gap"}, traits_of(card.type)->secondary.field,
         "the two sides are different: no self contact");
}

void ignored_friction_and_heat(const ContactCard& card, const Ignored& tell) {
  if (!card.given("fric_ID")) {
    if (card.flag("Iform") == 2)
      tell({"VISF"}, "Iform", "the incremental formulation (Iform 2) has no viscosity");
    if (!card.given("Fric") && !card.given("Ifric") && !card.given("fct_IDF"))
      tell({"Ifiltr", "Fheats", "Fheatm"}, "Fric", "there is no friction");
  }
  if (card.input("AscaleF") != 1)
    tell({"AscaleF"}, "fct_IDF",
         card.given("fct_IDF") ? "the solver evaluates fct_IDF at the unscaled temperature"
                               : "there is no fct_IDF");
  if (!card.given("fct_IDK") && card.input("AscaleK") != 1)
    tell({"AscaleK"}, "fct_IDK", "there is no fct_IDK");
  if (card.input("Ithe_form") == 1)
    tell({"Tint"}, "Ithe_form", "with Ithe_form 1 the main side has its own temperature");
  if (!card.given("Frad")) tell({"Drad"}, "Frad", "Frad is 0, so nothing radiates");
}

void check_ignored(const LintContext& c, const Rule& rule, Reporter& r) {
  // Of every type that has the cell, those without effective values too.
  for (const ContactCard& card : c.contacts)
    Ignored(c, rule, r, card)({"Multimp"}, "", "the solver sizes its impact list itself", true);
  each(c, rule, [&](const ContactCard& card) {
    const Ignored tell(c, rule, r, card);
    ignored_gap_and_stiffness(c, card, tell);
    ignored_friction_and_heat(card, tell);
  });
}

/// Coefficients that a law does not have: Ifric 3 has no Fric, 4 has C1 and C2 only.
void check_coefficients(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.given("fric_ID")) return;
    const Ignored tell(c, rule, r, card);
    if (card.input("Ifric") == 3)
      tell({"Fric"}, "Ifric", "the law Ifric 3 (Renard) uses C1 to C6 only");
    if (card.input("Ifric") == 4)
      tell({"C3", "C4", "C5", "C6"}, "Ifric", "the law Ifric 4 uses C1 and C2 only");
  });
}

}  // namespace

std::span<const Checked> ignored_checks() {
  static constexpr Checked all[] = {{RuleId::DK265, check_ignored},
                                    {RuleId::DK273, check_coefficients}};
  return all;
}

}  // namespace deck::detail
