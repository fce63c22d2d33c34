// Builds the typed interfaces and their effective values, one function per type.
#include "deck/model.hpp"

#include <algorithm>
#include <cstdlib>

#include "deck/text.hpp"
#include "keyword/shared/solver_order.hpp"
#include "model/interfaces_card.hpp"

namespace deck {
namespace {

using detail::InterfaceCard;

constexpr double no_limit = 1e30;  ///< "no limit" of the solver
constexpr std::int64_t flag_off = 1000;

/// In decks 1000 means "explicitly nothing".
std::int64_t flag(const EffectiveInt& e) { return e.value == flag_off ? 0 : e.value; }

/// Sets a field to a value that is not on the card.
template <class T>
void set_effective(Effective<T>& e, T value) {
  if (e.value == value) return;
  e.origin = e.value == T{} ? Origin::built_in : Origin::derived;
  e.value = value;
}

/// Sets the value for 0 and blank.
template <class T>
void fallback(Effective<T>& e, T value) {
  if (e.value == T{}) set_effective(e, value);
}

/// Marks a field that the geometry determines.
void leave_to_geometry(EffectiveReal& e) {
  e.value = 0;
  e.origin = Origin::geometry;
}

/// Rules of the solver for one interface, in its order of evaluation.
class Rules {
 public:
  /// `defaults`: default block of this type, or nullptr.
  Rules(const Model& model, const Interfaces& all, const DefaultInter* defaults)
      : model_(model), all_(all), defaults_(defaults) {}

  void apply(InterType2& t) const {
    default_flag(t.Ignore, "Ignore", flag_off);
    default_flag(t.Spotflag, "Spotflag", model_.has_acoustics ? 4 : 5);
    default_flag(t.Isearch, "Isearch", 2);
    default_flag(t.Idel2, "Idel", flag_off);
    // 1000 overrides the default block and gives the solver's own value.
    if (t.Spotflag.value == flag_off) set_effective<std::int64_t>(t.Spotflag, 5);
    if (t.Isearch.value == flag_off) set_effective<std::int64_t>(t.Isearch, 2);
    const std::int64_t f = t.Spotflag.value;
    const bool penalty = f >= 25 && f <= 28, rupture = f >= 20 && f <= 22;
    if (f != 0 && f != 5 && f != 1 && !penalty) set_effective<std::int64_t>(t.Idel2, flag_off);
    if (penalty) {
      set_effective<std::int64_t>(t.Level, 0);
      fallback(t.Stfac, 1.0);
      fallback(t.Visc, 0.05);
      default_flag(t.Istf, "Istf", 2);
      if (t.Istf.value == flag_off) set_effective<std::int64_t>(t.Istf, 2);
    }
    if (rupture) {
      fallback<std::int64_t>(t.Rupt, 2);
      fallback(t.Max_N_Dist, 1e20);
      fallback(t.Max_T_Dist, 1e20);
      if (t.Ifiltr.value == 1) {
        fallback(t.Alpha, 1.0);
        set_effective(t.Alpha, std::clamp(t.Alpha.value, 0.0, 1.0));
      }
    }
    fallback<std::int64_t>(t.Iproj, 1);
  }

  void apply(InterType7& t) const {
    default_flag(t.Istf, "Istf", flag_off);
    tied_nodes(t.Irem_i2);
    default_flag(t.Ibag, "Ibag", flag_off);
    common_flags(t);
    airbag(t.Ibag);
    if (!model_.has_adaptive_mesh) set_effective<std::int64_t>(t.Iadm, 0);
    scaled_gap(t);
    stiffness_bounds(t, flag(t.Istf) > 1);
    fallback(t.AscaleF, 1.0);
    if (t.Iadm.value == 2) {
      fallback<std::int64_t>(t.NRadm, 3);
      fallback(t.Padm, 1.0);
    }
    friction_law(t);
    surface_friction_damping(t);
    heat(t, 1e-30);
    rest(t);
  }

  void apply(InterType10& t) const {
    deletion(t.Idel, 0);
    fallback(t.Stfac, 0.2);
    fallback(t.VISs, 0.05);
    fallback(t.Bumult, 0.2);
    fallback(t.Tstop, no_limit);
    if (t.Gap.value <= 0) leave_to_geometry(t.Gap);
  }

  void apply(InterType11& t) const {
    if (t.line_IDm.value == 0 && t.line_IDs.value != 0) self_contact(t.line_IDm, t.line_IDs);
    default_flag(t.Istf, "Istf", 5);
    nothing_means(t.Istf, 5);  // TYPE11 has no stiffness of the main side alone
    common_flags(t);
    stiffness_bounds(t, t.Istf.value != 1);
    mesh_fraction(t);
    if (const Friction* f = friction_of(t)) {
      set_derived(t.Iform, f->Iform, f->span);
      set_derived(t.Fric, f->values.Fric, f->span);
      set_derived(t.VISF, f->values.VISF, f->span);
    } else if (t.Fric.value != 0 && t.Iform.value != 2) {
      fallback(t.VISF, 1.0);
    }
    heat(t, 0);
    rest(t);
  }

  void apply(InterType19& t) const {
    if (t.surf_IDm.value == 0 && t.surf_IDs.value != 0) self_contact(t.surf_IDm, t.surf_IDs);
    if (t.surf_IDs.value == 0 && t.surf_IDm.value != 0) self_contact(t.surf_IDs, t.surf_IDm);
    default_flag(t.Istf, "Istf", flag_off);
    // The solver ignores Iedge on the card.
    t.Iedge.value = 0;
    t.Iedge.origin = Origin::built_in;
    default_flag(t.Iedge, "Iedge", 2);
    nothing_means(t.Iedge, 2);
    tied_nodes(t.Irem_i2);
    default_flag(t.Ibag, "Ibag", flag_off);
    common_flags(t);
    if (t.Igap.value == 4) set_effective<std::int64_t>(t.Irem_gap, 2);
    airbag(t.Ibag);
    scaled_gap(t);
    fallback(t.Edge_scale_gap, 1.0);
    stiffness_bounds(t, flag(t.Istf) > 1);
    friction_law(t);
    surface_friction_damping(t);
    heat(t, 1e-30);
    rest(t);
  }

  void apply(InterType24& t) const {
    default_flag(t.Istf, "Istf", flag_off);
    default_flag(t.Irem_i2, "Irem_i2", 1);
    default_flag(t.Idel, "Idel", flag_off);
    default_flag(t.Iedge, "Iedge", flag_off);
    default_flag(t.Igap0, "Igap0", flag_off);
    default_flag(t.Ipen0, "Ipen0", flag_off);
    default_flag(t.Inacti, "Inacti", flag_off);
    if (t.Istf.value >= 10 && t.Istf.value != flag_off) overrule(t.Istf, t.Istf.value - 10);
    if (const std::int64_t i = flag(t.Inacti); i == -2)
      overrule(t.Istf, 2);
    else
      modern_inacti(t);
    if (level_of(t.surf_ID1.value, t.surf_ID2.value) == 3) set_effective(t.Iedge, flag_off);
    stiffness_bounds(t, flag(t.Istf) > 1 || t.Istf.value == -1);
    modern_rest(t);
  }

  void apply(InterType25& t) const {
    default_flag(t.Istf, "Istf", flag_off);
    default_flag(t.Igap, "Igap", 1);
    default_flag(t.Irem_i2, "Irem_i2", 1);
    default_flag(t.Idel, "Idel", flag_off);
    default_flag(t.Iedge, "Iedge", flag_off);
    default_flag(t.Igap0, "Igap0", flag_off);
    default_flag(t.Ishape, "Ishape", 1);
    default_flag(t.Inacti, "Inacti", flag_off);
    default_flag(t.Ithick, "Ithick", flag_off);
    if (t.Igap.value == 3 && t.Ishape.value == 1) overrule(t.Ishape, 2);
    modern_inacti(t);
    mesh_fraction(t);
    fallback(t.Gap_scale, 1.0);
    fallback(t.Stmax, no_limit);
    fallback<std::int64_t>(t.IVIS2, 1);
    if (t.IVIS2.value == 5) fallback(t.VISs, 1.0);
    if (t.Igap.value == 5) {
      fallback(t.THICK_S_SCALE, 1.0);
      fallback(t.THICK_M_SCALE, 1.0);
    }
    if (t.Ithe.value > 0) {
      fallback(t.AscaleK, 1.0);
      if (!model_.has_thermal_material) set_effective<std::int64_t>(t.Ithe, 0);
    }
    modern_rest(t);
  }

 private:
  /// Effective Inacti, and its effects on other fields.
  template <class Inter>
  void modern_inacti(Inter& t) const {
    if (model_.implicit && flag(t.Inacti) == 0) set_effective<std::int64_t>(t.Inacti, -1);
    const std::int64_t i = t.Inacti.value;
    if (i > 0 && i != 5 && i != flag_off) overrule(t.Inacti, 5);
    if (i < -1) overrule(t.Inacti, flag_off);
    if (i == -1 && (t.type == 24 || flag(t.Istf) == 0)) {
      t.Istf.value = 4;
      t.Istf.origin = Origin::derived;
    }
  }

  /// Common rules of TYPE24 and TYPE25.
  template <class Inter>
  static void modern_rest(Inter& t) {
    const auto derived = [](auto& e, auto value) {
      e.value = value;
      e.origin = Origin::derived;
    };
    deletion(t.Idel, flag_off);
    if (t.Istf.value == 7) {
      derived(t.IPSTIF, 1);
      if (t.STFAC_MDT.value == 0) derived(t.STFAC_MDT, 0.1);
    }
    if (t.IPSTIF.value == 1) fallback(t.STFAC_MDT, 0.1);
    if (flag(t.Iedge) != 0) fallback(t.Edge_angle, 135.0);
    fallback(t.Gap_max_s, no_limit);
    fallback(t.Gap_max_m, no_limit);
    fallback(t.Stfac, 1.0);
    fallback(t.Tstop, no_limit);
    fallback(t.VISs, 0.05);
    if (t.Inacti.value != -1 && t.Inacti.value != -2) set_effective(t.Tpressfit, 0.0);
    if (t.Xfreq.value == 0) set_effective<std::int64_t>(t.Ifiltr, 0);
  }

  void default_flag(EffectiveInt& e, std::string_view name, std::int64_t hard) const {
    if (e.value != 0) return;
    const auto* given = defaults_ ? defaults_->find(name) : nullptr;
    if (given != nullptr) {
      e.value = given->value;
      e.origin = Origin::default_block;
      e.span = given->span;
    } else {
      e.value = hard;
      e.origin = Origin::built_in;
    }
  }

  /// Replaces a value as the solver does. The origin stays default_block if it was: only a value on
  /// the card overrides the block.
  static void overrule(EffectiveInt& e, std::int64_t value) {
    e.value = value;
    if (e.origin == Origin::card) e.origin = Origin::derived;
  }

  /// Value for 1000 in a flag without "nothing".
  static void nothing_means(EffectiveInt& e, std::int64_t value) {
    if (e.value == flag_off) overrule(e, value);
  }

  void tied_nodes(EffectiveInt& irem_i2) const {
    default_flag(irem_i2, "Irem_i2", model_.implicit ? 1 : 3);
    nothing_means(irem_i2, 3);
  }

  /// Only 0, 1, 2 and their negatives delete; negative values keep orphan nodes.
  static void deletion(EffectiveInt& idel, std::int64_t none) {
    if (std::abs(flag(idel)) > 2) overrule(idel, none);
  }

  template <class Inter>
  void common_flags(Inter& t) const {
    default_flag(t.Igap, "Igap", flag_off);
    default_flag(t.Idel, "Idel", flag_off);
    default_flag(t.Inacti, "Inacti", flag_off);
    default_flag(t.Iform, "Iform", 1);
    default_flag(t.Irem_gap, "Irem_gap", 1);
    nothing_means(t.Iform, 1);
    nothing_means(t.Irem_gap, 1);
    deletion(t.Idel, flag_off);
  }

  void airbag(EffectiveInt& ibag) const {
    if (flag(ibag) == 0 || model_.has_monitored_volume || model_.has_ale || model_.has_sol2sph)
      return;
    set_effective(ibag, flag_off);
  }

  template <class Inter>
  static void scaled_gap(Inter& t) {
    if (flag(t.Igap) >= 2) {
      fallback(t.Fscalegap, 1.0);
      fallback(t.Gapmax, no_limit);
    } else {
      set_effective(t.Fscalegap, 1.0);
      set_effective(t.Gapmax, no_limit);
    }
    mesh_fraction(t);
  }

  template <class Inter>
  static void mesh_fraction(Inter& t) {
    if (t.Igap.value == 3) fallback(t.mesh_size, t.type == 11 ? 0.4F : 0.4);
  }

  template <class Inter>
  static void stiffness_bounds(Inter& t, bool used) {
    if (!used) set_effective(t.Stmin, 0.0);
    if (used)
      fallback(t.Stmax, no_limit);
    else
      set_effective(t.Stmax, no_limit);
  }

  template <class Inter>
  const Friction* friction_of(const Inter& t) const {
    return t.fric_ID.value == 0 ? nullptr : all_.friction(t.fric_ID.value);
  }

  template <class T>
  static void set_derived(Effective<T>& e, T value, Span span) {
    e.value = value;
    e.origin = Origin::derived;
    e.span = span;
  }

  /// Values from /FRICTION are final.
  template <class Inter>
  void friction_law(Inter& t) const {
    const Friction* f = friction_of(t);
    if (f == nullptr) {
      if (t.Xfreq.value == 0) set_effective<std::int64_t>(t.Ifiltr, 0);
      return;
    }
    set_derived(t.Ifric, f->Ifric, f->span);
    set_derived(t.Ifiltr, f->Ifiltr, f->span);
    set_derived(t.Xfreq, f->Xfreq, f->span);
    set_derived(t.Iform, f->Iform, f->span);
    set_derived(t.Fric, f->values.Fric, f->span);
    set_derived(t.VISF, f->values.VISF, f->span);
    EffectiveReal* const c[] = {&t.C1, &t.C2, &t.C3, &t.C4, &t.C5, &t.C6};
    for (std::size_t i = 0; i < 6; ++i) set_derived(*c[i], f->values.C[i], f->span);
  }

  template <class Inter>
  void surface_friction_damping(Inter& t) const {
    if (friction_of(t) != nullptr) return;
    if (t.Iform.value == 2)
      set_effective(t.VISF, 0.0);
    else if (t.Fric.value != 0 || t.Ifric.value != 0)
      fallback(t.VISF, 1.0);
  }

  /// `no_function`: heat exchange coefficient without a value and function.
  template <class Inter>
  void heat(Inter& t, double no_function) const {
    if (t.Ithe.value <= 0) return;
    fallback(t.Kthe, t.fct_IDK.value != 0 ? 1.0 : no_function);
    fallback(t.AscaleK, 1.0);
    if (t.Drad.value == 0) leave_to_geometry(t.Drad);
    if (!model_.has_thermal_material) set_effective<std::int64_t>(t.Ithe, 0);
  }

  static void self_contact(EffectiveInt& to, const EffectiveInt& from) {
    to.value = from.value;
    to.origin = Origin::derived;
  }

  template <class Inter>
  void rest(Inter& t) const {
    fallback(t.Stfac, 1.0);
    fallback(t.Tstop, no_limit);
    fallback(t.VISs, 0.05);
    const std::size_t nodes = model_.nodes.size();
    fallback(t.Bumult, nodes > 2500000 ? 0.4 : nodes > 1500000 ? 0.3 : 0.2);
    if (t.Gapmin.value <= 0) leave_to_geometry(t.Gapmin);
  }

  const Model& model_;
  const Interfaces& all_;
  const DefaultInter* defaults_;
};

/// 0 and blank mean 1 in the units of the card.
void unit_scales(const Deck& deck, const InterfaceCard& card, InterType2& t) {
  const std::pair<std::string_view, EffectiveReal*> scales[] = {
      {"Fscalestress", &t.Fscalestress},
      {"Fscalestr_rate", &t.Fscalestr_rate},
      {"Fscaledist", &t.Fscaledist}};
  const DecodedBlock& block = card.decoded();
  const UnitSystem* units = deck.units_of(*block.block);
  const bool rupture = t.Spotflag.value >= 20 && t.Spotflag.value <= 22;
  for (const auto& [name, field] : scales) {
    if (field->value != 0) continue;
    const Cell* cell = block.find(name);
    if (cell != nullptr && units != nullptr)
      set_effective(
          *field, conversion_factor(*units, deck.begin.working, dimension_of(*cell->field, block)));
    else if (cell != nullptr || rupture)
      set_effective(*field, 1.0);
  }
}

int type_of(const Block& block) {
  if (block.schema == nullptr) return 0;
  for (const InterfaceTraits* t : interface_types)
    if (block.schema->keyword == t->keyword) return t->type;
  return 0;
}

template <class Inter>
Inter read_one(const InterfaceCard& card, int type, const Rules& rules) {
  Inter t;
  card.head(type, t);
  card.read_all(t);
  rules.apply(t);
  return t;
}

/// In version 2026 grnd_IDs can be a surface, which deck does not evaluate.
void check_smoothing(const InterfaceCard& card, const InterBase& inter, Findings& findings) {
  const Cell* cell = card.decoded().find("Ists");
  if (cell == nullptr || cell->integer == 0 || !findings.wants(RuleId::DK299)) return;
  Finding d = make_finding(
      RuleId::DK299, cell->span,
      "Ists = " + std::to_string(cell->integer) +
          " (surface-to-surface smoothing) is not evaluated; the interface is treated as if "
          "Ists were 0");
  d.keyword = "/INTER/TYPE7";
  d.id = inter.id;
  findings.add(std::move(d));
}

}  // namespace

Interfaces read_interfaces(const Deck& deck, const Model& model, Findings& findings) {
  Interfaces out;
  out.defaults = detail::read_defaults(deck, findings);
  out.frictions = detail::read_frictions(deck);
  std::vector<std::pair<int, std::size_t>> order;
  for (const Block* const at : detail::in_solver_order(deck, "/INTER")) {
    const Block& block = *at;
    if (block.schema != nullptr && block.schema->keyword == InterType2::traits.keyword) {
      const InterfaceCard card(deck, block);
      const Rules rules(model, out, out.defaults_of(InterType2::traits.type));
      order.emplace_back(InterType2::traits.type, out.type2.size());
      out.type2.push_back(read_one<InterType2>(card, InterType2::traits.type, rules));
      unit_scales(deck, card, out.type2.back());
      continue;
    }
    const int type = type_of(block);
    if (type == 0) continue;
    const InterfaceCard card(deck, block);
    const Rules rules(model, out, out.defaults_of(type));
    out.for_each_list([&]<class Inter>(std::vector<Inter>& list) {
      if (Inter::traits.type != type) return;
      order.emplace_back(type, list.size());
      list.push_back(read_one<Inter>(card, type, rules));
    });
    if (type == 7) check_smoothing(card, out.type7.back(), findings);
  }
  // From here on the lists do not move.
  for (const auto& [type, i] : order) {
    if (type == InterType2::traits.type) {
      out.all.push_back(&out.type2[i]);
      continue;
    }
    out.for_each_list([&, type = type, i = i]<class Inter>(std::vector<Inter>& list) {
      if (Inter::traits.type != type) return;
      out.ordered.push_back(&list[i]);
      out.all.push_back(&list[i]);
    });
  }
  return out;
}

}  // namespace deck
