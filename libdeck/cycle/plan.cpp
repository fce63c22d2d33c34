// Chooses the effects of an interface once, before any pair is looked at.
#include "deck/cycle/plan.hpp"

#include <string>

#include "cycle/kernel/block.hpp"
#include "cycle/kernel/effects.hpp"

namespace deck::cycle {
namespace {

bool has_friction(const ContactCard& card) {
  if (card.kind == ContactKind::tied) return false;
  if (card.kind == ContactKind::edge_edge) return card.fric != 0.0 || card.fric_id;
  return card.fric != 0.0 || card.ifric != 0 || card.fric_id || (card.ithe && card.fct_idf);
}

bool has_filter(const ContactCard& card) {
  return card.kind == ContactKind::node_segment && card.ifiltr > 0 && card.xfreq != 0.0;
}

bool node_segment(const ContactCard& card) { return card.kind == ContactKind::node_segment; }

std::string number(const char* field, double value) {
  std::string text = std::to_string(value);
  while (text.size() > 1 && text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return std::string(field) + " = " + text;
}
std::string number(const char* field, int value) {
  return std::string(field) + " = " + std::to_string(value);
}

std::string directions(int bits) {
  std::string text;
  for (const auto& [bit, name] : {std::pair{4, "X"}, {2, "Y"}, {1, "Z"}})
    if ((bits & bit) != 0) text += text.empty() ? name : std::string(", ") + name;
  return text;
}

/// Why a filter does nothing, or what it does instead of smoothing.
std::string filter_reason(const ContactCard& card) {
  if (card.ifiltr <= 0) return "Ifiltr = 0";
  if (card.xfreq == 0.0) return number("Xfreq", 0.0);
  if (card.ifiltr == 3) return "Ifiltr = 3: the solver's weight is never below 1";
  if (card.ifiltr == 1 && card.xfreq >= 1.0) return number("Xfreq", card.xfreq) + ": a weight of 1";
  std::string text = number("Xfreq", card.xfreq);
  if (card.iform == 2) text += ", scales the spring of Iform 2 and smooths nothing";
  return text;
}
bool filters(const ContactCard& card) {
  return has_filter(card) && card.ifiltr != 3 && !(card.ifiltr == 1 && card.xfreq >= 1.0);
}

/// Who gets the heat of friction, or why nobody does.
struct RubHeat {
  bool on = false;
  std::string reason;
};
RubHeat rub_heat(const ContactCard& card) {
  const bool main = card.fheatm != 0.0 && card.ithe_form == 1;
  const std::string shares = number("Fheats", card.fheats) + ", " + number("Fheatm", card.fheatm);
  const std::string lost = card.fheatm != 0.0 && !main
                               ? number("Fheatm", card.fheatm) + " goes to nobody: Ithe_form = 0"
                               : std::string();
  if (card.fct_idk && card.ithe_form != 1 && (card.fheats != 0.0 || card.fheatm != 0.0))
    return {false, shares + ": lost with fct_IDK and Ithe_form = 0"};
  if (card.fheats == 0.0 && !main) return {false, lost.empty() ? shares : lost};
  return {has_friction(card), lost.empty() ? shares : number("Fheats", card.fheats) + "; " + lost};
}

/// The account is a list of rows, each a decision and the field behind it.
class Account {
 public:
  void row(const char* name, bool on, const char* field, std::string reason) {
    rows_.push_back({name, on, field, std::move(reason)});
  }
  std::vector<EffectState> take() { return std::move(rows_); }

 private:
  std::vector<EffectState> rows_;
};

void account_normal(const ContactCard& card, Account& out) {
  const bool tied = card.kind == ContactKind::tied;
  out.row("elastic-normal", !tied, "", tied ? "TYPE10 has a tie instead" : "always");
  out.row("tie", tied, "", tied ? "TYPE10" : "TYPE10 only");
  const bool combine = card.istf >= 2 && card.istf <= 5;
  out.row("stiffness-combination", combine && !tied, "Istf", number("Istf", card.istf));
  out.row("fixed-stiffness", card.istf == 1 && !tied, "Istf", number("Istf", card.istf));
  const bool variable = card.igap >= 1 && card.igap <= 3;
  out.row("variable-gap", variable && !tied, "Igap", number("Igap", card.igap));
  const bool reduce = (card.inacti == 5 || card.inacti == 6) && !tied;
  out.row("gap-reduction", reduce, "Inacti", number("Inacti", card.inacti));
  const bool start_up = card.inacti == 1 || card.inacti == 2 || card.inacti == 3;
  out.row("initial-penetration-action", start_up && !tied, "Inacti",
          number("Inacti", card.inacti) + ", at start-up only");
  out.row("penetration-limit", card.fpenmax != 0.0 && node_segment(card), "Fpenmax",
          number("Fpenmax", card.fpenmax) + ", at start-up only");
  out.row("normal-damping", card.viss != 0.0, "VISs", number("VISs", card.viss));
}

void account_friction(const ContactCard& card, Account& out) {
  const bool rubs = has_friction(card);
  std::string why = card.fric_id ? "fric_ID" : number("Fric", card.fric);
  if (rubs && card.fric == 0.0 && card.ifric != 0) why = number("Ifric", card.ifric);
  out.row("friction-viscous", rubs && card.iform != 2, rubs ? "Iform" : "Fric",
          rubs ? number("Iform", card.iform) : why);
  out.row("friction-incremental", rubs && card.iform == 2, rubs ? "Iform" : "Fric",
          rubs ? number("Iform", card.iform) : why);
  const bool edges = card.kind == ContactKind::edge_edge;
  out.row("friction-law", rubs && card.ifric > 0 && !edges, "Ifric",
          edges ? "edge contacts use a constant coefficient" : number("Ifric", card.ifric));
  const bool heat_mu = rubs && card.ithe && card.fct_idf && !card.fric_id && !edges;
  out.row(
      "friction-temperature", heat_mu, card.fct_idf && !card.ithe ? "Ithe" : "fct_IDF",
      !card.fct_idf  ? "fct_IDF = 0"
      : !card.ithe   ? "fct_IDF acts with heat exchange only: Ithe = 0"
      : card.fric_id ? "fct_IDF does nothing beside fric_ID"
      : card.ithe_form == 1
          ? "fct_IDF; with Ithe_form 1 the solver weights the main side as another pair, here as "
            "its own"
          : "fct_IDF");
  out.row("friction-temperature-scale", false, "AscaleF",
          card.ascalef != 1.0 ? number("AscaleF", card.ascalef) + ": the solver never applies it"
                              : "AscaleF = 1");
  out.row("friction-filter", rubs && filters(card),
          card.ifiltr > 0 && card.ifiltr != 3 ? "Xfreq" : "Ifiltr",
          edges ? "no filter between edges" : filter_reason(card));
  const bool ortho = card.fric_id && card.fric_orthotropic && node_segment(card);
  out.row("orthotropic-friction", ortho, "fric_ID",
          card.fric_id ? (ortho ? "directions in /FRICTION" : "no directions in /FRICTION")
                       : "fric_ID = 0");
  out.row("part-pair-friction", card.fric_id, "fric_ID", card.fric_id ? "fric_ID" : "fric_ID = 0");
}

void account_rest(const ContactCard& card, Account& out) {
  const bool heat = card.ithe > 0 && card.kind != ContactKind::tied;
  const std::string ithe = number("Ithe", card.ithe);
  out.row("heat-conduction", heat && (card.kthe != 0.0 || card.fct_idk), heat ? "Kthe" : "Ithe",
          heat ? number("Kthe", card.kthe) : ithe);
  out.row("radiation", heat && card.frad != 0.0 && card.drad > 0.0,
          heat ? (card.frad != 0.0 ? "Drad" : "Frad") : "Ithe",
          heat ? (card.frad != 0.0 ? number("Drad", card.drad) : "Frad = 0") : ithe);
  const RubHeat rubbed = rub_heat(card);
  out.row("friction-heat", heat && node_segment(card) && rubbed.on,
          !heat                                      ? "Ithe"
          : card.fheats == 0.0 && card.fheatm != 0.0 ? "Fheatm"
                                                     : "Fheats",
          !heat                ? ithe
          : node_segment(card) ? rubbed.reason
                               : "no friction heat between edges");
  out.row("curvature", card.icurv != 0 && node_segment(card), "Icurv", number("Icurv", card.icurv));
  out.row("adaptivity-criteria", card.iadm != 0 && node_segment(card), "Iadm",
          number("Iadm", card.iadm));
  out.row("contact-time-step", card.kind != ContactKind::tied, "",
          card.kind == ContactKind::tied ? "a tie has no kinematic limit" : "always");
  out.row("time-step-deletion", card.dtmin > 0.0 && card.itied == 0, "dtmin",
          card.itied != 0 ? "ITIED ties instead" : number("dtmin", card.dtmin));
  const bool never = card.itied != 0 && node_segment(card) && !(card.dtmin > 0.0);
  out.row("tie-on-time-step", card.itied != 0 && node_segment(card) && !never,
          never ? "dtmin" : "ITIED",
          number("ITIED", card.itied) + (never ? ", but dtmin = 0: no step is ever below it" : ""));
  const bool ibc = card.ibc != 0 && node_segment(card);
  out.row("boundary-release", ibc, "IBC",
          card.ibc == 0 ? "IBC = 000"
          : ibc         ? "IBC frees " + directions(card.ibc)
                        : "edges release nothing");
  out.row("contact-flag", card.ibag == 1 || card.iadm != 0, "Ibag", number("Ibag", card.ibag));
  out.row("element-deletion", card.idel != 0, "Idel", number("Idel", card.idel));
  const bool window = card.tstart > 0.0 || card.tstop < 1e30 || card.sensor_time.has_value();
  out.row("activity-window", window, card.sensor_time ? "sens_ID" : "Tstart",
          card.sensor_time ? "sensor" : number("Tstart", card.tstart));
}

EffectSet choose_effects(const ContactCard& card, const PlanOptions& options) {
  EffectSet set = bit(Effect::elastic);
  if (card.inacti == 5 || card.inacti == 6) set |= bit(Effect::gap_reduction);
  if (card.istf == 1 && node_segment(card)) set |= bit(Effect::fixed_stiffness);
  const bool rubs = has_friction(card);
  const bool rates = card.viss != 0.0 || rubs || card.dtmin > 0.0 || card.itied != 0;
  if (rates) set |= bit(Effect::damping);
  if (options.energies) set |= bit(Effect::elastic_energy);
  if (!rubs) return set;
  set |= bit(card.iform == 2 ? Effect::friction_incremental : Effect::friction_viscous);
  if (card.fric_id) set |= bit(Effect::friction_pairs);
  if (card.kind == ContactKind::edge_edge) return set;
  if (card.ifric > 0) set |= bit(Effect::friction_law);
  if (card.ithe && card.fct_idf && !card.fric_id) set |= bit(Effect::friction_temperature);
  if (card.fric_id && card.fric_orthotropic) set |= bit(Effect::friction_orthotropic);
  if (has_filter(card) && card.iform != 2) set |= bit(Effect::filter);
  return set;
}

/// Adds an effect's arrays when it is in the set.
template <class E>
void collect(EffectSet set, Effect e, KernelPlan& plan) {
  if ((set & bit(e)) == 0) return;
  plan.needs |= E::needs;
  plan.writes |= E::writes;
}

void collect_fields(KernelPlan& plan) {
  const ContactCard& card = plan.card;
  const EffectSet set = plan.effects;
  collect<detail::Elastic>(set, Effect::elastic, plan);
  collect<detail::GapReduction>(set, Effect::gap_reduction, plan);
  collect<detail::Damping>(set, Effect::damping, plan);
  collect<detail::Rates>(set, Effect::damping, plan);
  collect<detail::FrictionViscous>(set, Effect::friction_viscous, plan);
  collect<detail::FrictionIncremental>(set, Effect::friction_incremental, plan);
  collect<detail::ElasticEnergy>(set, Effect::elastic_energy, plan);
  collect<detail::FrictionLaw>(set, Effect::friction_law, plan);
  collect<detail::FrictionTemperature>(set, Effect::friction_temperature, plan);
  collect<detail::Filter>(set, Effect::filter, plan);
  if ((set & bit(Effect::damping)) != 0) {
    plan.needs |= card.kind == ContactKind::edge_edge
                      ? detail::Rates::mass_needs<ContactKind::edge_edge>()
                      : detail::Rates::mass_needs<ContactKind::node_segment>();
  }
  if ((set & bit(Effect::friction_pairs)) != 0) plan.needs |= Field::pair_friction;
  collect<detail::FrictionOrthotropic>(set, Effect::friction_orthotropic, plan);
  if (card.dtmin > 0.0 && card.itied == 0 && card.kind != ContactKind::tied)
    plan.needs |= Field::mass_secondary | Field::mass_main;
  if (card.kind == ContactKind::tied) {
    plan.needs |= Field::tie_record | Field::velocity | Field::mass_secondary | Field::step_times;
    plan.writes |= Field::tie_record | Field::damping_energy;
  }
  if (card.kind == ContactKind::edge_edge && card.ithe > 0) {
    plan.needs |= Field::temperature | Field::contact_area | Field::step_times;
    plan.writes |= Field::heat;
  }
  if (!node_segment(card)) return;
  if (card.itied != 0) {
    plan.needs |= Field::tie_record | Field::mass_main | Field::residual_penetration;
    plan.writes |= Field::tie_record;
  }
  if (card.ithe > 0) {
    plan.needs |= Field::temperature | Field::step_times;
    plan.writes |= Field::heat;
  }
  if (card.icurv == 3 || card.iadm != 0) plan.needs |= Field::nodal_normals;
  if (card.iadm != 0) plan.writes |= Field::criteria;
}

std::string composition_name(const KernelPlan& plan) {
  static constexpr struct {
    Effect effect;
    const char* name;
  } names[] = {{Effect::elastic, "elastic"},
               {Effect::gap_reduction, "gap_reduction"},
               {Effect::damping, "damping"},
               {Effect::friction_viscous, "friction_viscous"},
               {Effect::friction_incremental, "friction_incremental"},
               {Effect::elastic_energy, "elastic_energy"},
               {Effect::friction_law, "friction_law"},
               {Effect::friction_temperature, "friction_temperature"},
               {Effect::friction_pairs, "friction_pairs"},
               {Effect::filter, "filter"},
               {Effect::friction_orthotropic, "friction_orthotropic"},
               {Effect::fixed_stiffness, "fixed_stiffness"}};
  std::string text;
  for (const auto& n : names) {
    if ((plan.effects & bit(n.effect)) == 0) continue;
    if (!text.empty()) text += '+';
    text += n.name;
  }
  return text;
}

/// Widest instruction set that is asked for and that the processor has.
Isa choose_isa(Isa wish) {
#if defined(__x86_64__)
  const bool wide = wish == Isa::automatic || wish == Isa::avx512;
  if (wide && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    return Isa::avx512;
  }
  if (wish != Isa::baseline && __builtin_cpu_supports("avx2")) return Isa::avx2;
#else
  static_cast<void>(wish);
#endif
  return Isa::baseline;
}

}  // namespace

std::vector<EffectState> effect_plan(const ContactCard& card) {
  Account account;
  account_normal(card, account);
  account_friction(card, account);
  account_rest(card, account);
  return account.take();
}

KernelPlan make_plan(const ContactCard& card, Model model, const PlanOptions& options) {
  KernelPlan plan;
  plan.card = card;
  plan.model = model;
  plan.account = effect_plan(card);
  plan.effects =
      card.kind == ContactKind::tied ? bit(Effect::elastic) : choose_effects(card, options);
  collect_fields(plan);
  plan.composition = card.kind == ContactKind::tied ? "tie" : composition_name(plan);
  const Isa isa = choose_isa(options.isa);
  const bool generic = options.force_generic;
  if (isa == Isa::avx512) {
    plan.table = detail::find_avx512(card.kind, model, plan.effects, generic);
    plan.isa = "avx512";
  }
  if (plan.table == nullptr && isa != Isa::baseline) {
    plan.table = detail::find_avx2(card.kind, model, plan.effects, generic);
    plan.isa = "avx2";
  }
  if (plan.table == nullptr) {
    plan.table = detail::find_baseline(card.kind, model, plan.effects, generic);
    plan.isa = "baseline";
  }
  plan.composed = plan.table->composed;
  return plan;
}

}  // namespace deck::cycle
