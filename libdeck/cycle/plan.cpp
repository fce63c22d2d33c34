// Chooses the effects of a contact once, from its card, before any pair is evaluated.
#include "deck/cycle.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "cycle/kernel/block.hpp"
#include "cycle/kernel/effects.hpp"

namespace deck::cycle {
namespace {

using detail::Account;
using detail::field_text;
using detail::has_friction;

void row(Account& out, const char* name, bool on, const char* field, std::string reason) {
  out.push_back({name, on, field, std::move(reason)});
}

bool node_segment(const ContactCard& card) { return card.kind == ContactKind::node_segment; }

std::string directions(int bits) {
  std::string text;
  for (const auto& [bit, name] : {std::pair{4, "X"}, {2, "Y"}, {1, "Z"}})
    if ((bits & bit) != 0) text += text.empty() ? name : std::string(", ") + name;
  return text;
}

struct FrictionHeat {
  bool on = false;
  std::string reason;  ///< which side receives friction heat, or why none does
};
FrictionHeat friction_heat_of(const ContactCard& card) {
  const bool main = card.fheatm != 0.0 && card.ithe_form == 1;
  const std::string shares =
      field_text("Fheats", card.fheats) + ", " + field_text("Fheatm", card.fheatm);
  const std::string lost = card.fheatm != 0.0 && !main
                               ? field_text("Fheatm", card.fheatm) + " is lost: Ithe_form = 0"
                               : std::string();
  if (card.fct_idk && card.ithe_form != 1 && (card.fheats != 0.0 || card.fheatm != 0.0))
    return {false, shares + ": lost with fct_IDK and Ithe_form = 0"};
  if (lost.empty()) return {has_friction(card) && (card.fheats != 0.0 || main), shares};
  if (card.fheats == 0.0 && !main) return {false, lost};
  return {has_friction(card), field_text("Fheats", card.fheats) + "; " + lost};
}

void account_normal(const ContactCard& card, Account& out) {
  const bool tied = card.kind == ContactKind::tied;
  row(out, "elastic-normal", !tied, "", tied ? "TYPE10 has a tie instead" : "always");
  row(out, "tie", tied, "", tied ? "TYPE10" : "TYPE10 only");
  const bool combine = card.istf >= 2 && card.istf <= 5;
  row(out, "stiffness-combination", combine && !tied, "Istf", field_text("Istf", card.istf));
  row(out, "fixed-stiffness", card.istf == 1 && !tied, "Istf", field_text("Istf", card.istf));
  const bool variable = card.igap >= 1 && card.igap <= 3;
  row(out, "variable-gap", variable && !tied, "Igap", field_text("Igap", card.igap));
  const bool reduce = (card.inacti == 5 || card.inacti == 6) && !tied;
  row(out, "gap-reduction", reduce, "Inacti", field_text("Inacti", card.inacti));
  const bool start_up = card.inacti == 1 || card.inacti == 2 || card.inacti == 3;
  row(out, "initial-penetration-action", start_up && !tied, "Inacti",
      field_text("Inacti", card.inacti) + ", at start-up only");
  row(out, "penetration-limit", card.fpenmax != 0.0 && node_segment(card), "Fpenmax",
      field_text("Fpenmax", card.fpenmax) + ", at start-up only");
  row(out, "normal-damping", card.viss != 0.0, "VISs", field_text("VISs", card.viss));
}

void account_rest(const ContactCard& card, Account& out) {
  const bool heat = card.ithe > 0 && card.kind != ContactKind::tied;
  const std::string ithe = field_text("Ithe", card.ithe);
  row(out, "heat-conduction", heat && (card.kthe != 0.0 || card.fct_idk), heat ? "Kthe" : "Ithe",
      heat ? field_text("Kthe", card.kthe) : ithe);
  row(out, "radiation", heat && card.frad != 0.0 && card.drad > 0.0,
      heat ? (card.frad != 0.0 ? "Drad" : "Frad") : "Ithe",
      heat ? (card.frad != 0.0 ? field_text("Drad", card.drad) : "Frad = 0") : ithe);
  const FrictionHeat rubbed = friction_heat_of(card);
  row(out, "friction-heat", heat && node_segment(card) && rubbed.on,
      !heat                                      ? "Ithe"
      : card.fheats == 0.0 && card.fheatm != 0.0 ? "Fheatm"
                                                 : "Fheats",
      !heat                ? ithe
      : node_segment(card) ? rubbed.reason
                           : "no friction heat between edges");
  row(out, "curvature", card.icurv != 0 && node_segment(card), "Icurv",
      field_text("Icurv", card.icurv));
  row(out, "adaptivity-criteria", card.iadm != 0 && node_segment(card), "Iadm",
      field_text("Iadm", card.iadm));
  row(out, "contact-time-step", card.kind != ContactKind::tied, "",
      card.kind == ContactKind::tied ? "a tie has no kinematic limit" : "always");
  row(out, "time-step-deletion", card.dtmin > 0.0 && card.itied == 0, "dtmin",
      card.itied != 0 ? "ITIED ties instead" : field_text("dtmin", card.dtmin));
  const bool never = card.itied != 0 && node_segment(card) && !(card.dtmin > 0.0);
  row(out, "tie-on-time-step", card.itied != 0 && node_segment(card) && !never,
      never ? "dtmin" : "ITIED",
      field_text("ITIED", card.itied) +
          (never ? ", but dtmin = 0, and no time step is below 0" : ""));
  const bool ibc = card.ibc != 0 && node_segment(card);
  row(out, "boundary-release", ibc, "IBC",
      card.ibc == 0 ? "IBC = 000"
      : ibc         ? "IBC frees " + directions(card.ibc)
                    : "edges release nothing");
  row(out, "contact-flag", card.ibag == 1 || card.iadm != 0, "Ibag", field_text("Ibag", card.ibag));
  row(out, "element-deletion", card.idel != 0, "Idel", field_text("Idel", card.idel));
  const bool window = card.tstart > 0.0 || card.tstop < 1e30 || card.sensor_time.has_value();
  row(out, "activity-window", window, card.sensor_time ? "sens_ID" : "Tstart",
      card.sensor_time ? "sensor" : field_text("Tstart", card.tstart));
}

/// IBC: penetrating pairs free their translations.
void mark_release(const KernelPlan&, const PacketView&, std::size_t begin, std::size_t end,
                  PacketResult& out) {
  for (std::size_t i = begin; i < end; ++i) {
    if (out.penetration[i] != 0.0) out.status[i] |= status_bc_release;
  }
}

struct EffectEntry {
  Effect effect;
  const char* name;
  bool (*called_for)(const ContactCard&, const PlanOptions&);
  Field (*needs)(ContactKind);
  Field writes;
  void (*account)(const ContactCard&, Account&);
};

/// Effects of the pair loop, in the order of `Effect`.
const std::vector<EffectEntry>& pair_effects() {
  static const std::vector<EffectEntry> entries = [] {
    std::vector<EffectEntry> list;
    detail::AllEffects::for_each([&]<class E>() {
      list.push_back({E::effect, E::name, E::called_for, E::needs, E::writes, E::account});
    });
    std::sort(list.begin(), list.end(), [](const EffectEntry& a, const EffectEntry& b) {
      return bit(a.effect) < bit(b.effect);
    });
    return list;
  }();
  return entries;
}

EffectSet choose_effects(const ContactCard& card, const PlanOptions& options) {
  EffectSet set = 0;
  for (const EffectEntry& e : pair_effects())
    if (e.called_for(card, options)) set |= bit(e.effect);
  return set;
}

void collect_fields(KernelPlan& plan) {
  const ContactCard& card = plan.card;
  for (const EffectEntry& e : pair_effects()) {
    if ((plan.effects & bit(e.effect)) == 0) continue;
    plan.needs |= e.needs(card.kind);
    plan.writes |= e.writes;
  }
  for (const detail::LateEffect& e : detail::late_effects()) {
    if (!e.called_for(card)) continue;
    plan.needs |= e.needs;
    plan.writes |= e.writes;
    plan.late.push_back(&e);
  }
  if (card.kind == ContactKind::tied) {
    plan.needs |= Field::tie_record | Field::velocity | Field::mass_secondary | Field::step_times;
    plan.writes |= Field::tie_record | Field::damping_energy;
  }
  if (node_segment(card) && card.icurv == 3) plan.needs |= Field::nodal_normals;
}

std::string composition_name(const KernelPlan& plan) {
  std::string text;
  for (const EffectEntry& e : pair_effects()) {
    if ((plan.effects & bit(e.effect)) == 0) continue;
    if (!text.empty()) text += '+';
    text += e.name;
  }
  return text;
}

/// Widest instruction set that is allowed and that the processor has.
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

namespace detail {

std::span<const LateEffect> late_effects() {
  static const LateEffect effects[] = {
      {[](const ContactCard& c) { return c.kind == ContactKind::edge_edge && c.ithe > 0; },
       Field::temperature | Field::contact_area | Field::step_times, Field::heat, apply_edge_heat},
      {[](const ContactCard& c) {
         return c.kind != ContactKind::tied && c.dtmin > 0.0 && c.itied == 0;
       },
       Field::mass_secondary | Field::mass_main, Field::none, apply_step_deletion},
      {[](const ContactCard& c) { return node_segment(c) && c.itied != 0; },
       Field::tie_record | Field::mass_main | Field::residual_penetration, Field::tie_record,
       apply_time_step_tie},
      {[](const ContactCard& c) { return node_segment(c) && c.ithe > 0; },
       Field::temperature | Field::step_times, Field::heat, apply_heat},
      {[](const ContactCard& c) { return node_segment(c) && c.iadm != 0; }, Field::nodal_normals,
       Field::criteria, apply_criteria},
      {[](const ContactCard& c) { return node_segment(c) && c.ibc != 0; }, Field::none, Field::none,
       mark_release},
  };
  return effects;
}

}  // namespace detail

std::vector<EffectState> effect_plan(const ContactCard& card) {
  Account rows;
  account_normal(card, rows);
  for (const EffectEntry& e : pair_effects()) e.account(card, rows);
  account_rest(card, rows);
  return rows;
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
