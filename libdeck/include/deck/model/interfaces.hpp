// The contact interfaces as plain structs of effective values: what the solver will use for every
// field of /INTER/TYPE2, 7, 10, 11, 19, 24, 25, where each value came from, and what the card said.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "deck/model/model.hpp"

namespace deck {

using EffectiveInt = Effective<std::int64_t>;
using EffectiveReal = Effective<double>;
using EffectiveText = Effective<std::string>;

/// What sets the interface types apart, one row a type. A side is the field that names it and what
/// its id refers to, in the words of the schemas.
struct InterfaceTraits {
  struct Side {
    std::string_view field, refers_to;
  };
  int type;
  std::string_view keyword;
  Side secondary, main;
  std::string_view gap;  ///< field of the minimum gap; empty: there is none
};

/// What every interface has.
struct InterBase {
  std::int64_t id = 0;
  int type = 0;  ///< 2, 7, 10, 11, 19, 24, 25
  std::string title;
  const Block* block = nullptr;
  Span span;              ///< header
  bool resolved = false;  ///< values of Origin::geometry are filled in (deck/contact/resolve.hpp)
};

/// What an interface of type T has beside its fields.
template <class T>
struct InterFields : InterBase {
  /// Calls f(name, field) for every field in the order of the manual.
  template <class F>
  void for_each(F&& f) {
    visit_fields(static_cast<T&>(*this), f);
  }
  template <class F>
  void for_each(F&& f) const {
    visit_fields(static_cast<const T&>(*this), f);
  }
};

/// A tie. Its fields mean something else than those of contacts, so it is in no list with them.
struct InterType2 : InterFields<InterType2> {
  static constexpr InterfaceTraits traits{
      2, "/INTER/TYPE2", {"grnd_IDs", "grnod"}, {"surf_IDm", "surf"}, "dsearch"};
  EffectiveInt grnd_IDs, surf_IDm, Ignore, Spotflag, Level, Isearch, Idel2, surf_IDs;
  EffectiveReal dsearch;
  EffectiveInt Rupt, Ifiltr, fct_IDsr, fct_IDsn, fct_IDst, Isym;
  EffectiveReal Max_N_Dist, Max_T_Dist, Fscalestress, Fscalestr_rate, Fscaledist, Alpha, Area;
  EffectiveReal Stfac, Visc;
  EffectiveInt Istf, Ithe;
  EffectiveReal Kthe;
  EffectiveInt Iproj;
};

/// The fields common to types 7, 11 and 19. IBC is "xyz", one digit each.
struct InterType7 : InterFields<InterType7> {
  static constexpr InterfaceTraits traits{
      7, "/INTER/TYPE7", {"grnd_IDs", "grnod"}, {"surf_IDm", "surf"}, "Gapmin"};
  EffectiveInt grnd_IDs, surf_IDm, Istf, Ithe, Igap, Ibag, Idel, Icurv, Iadm;
  EffectiveReal Fscalegap, Gapmax, Fpenmax;
  EffectiveInt ITIED;
  EffectiveReal Stmin, Stmax, mesh_size, dtmin;  ///< mesh_size is "%mesh_size"
  EffectiveInt Irem_gap, Irem_i2, node_ID1, node_ID2;
  EffectiveReal Stfac, Fric, Gapmin, Tstart, Tstop;
  EffectiveText IBC;
  EffectiveInt Inacti;
  EffectiveReal VISs, VISF, Bumult;
  EffectiveInt Ifric, Ifiltr;
  EffectiveReal Xfreq;
  EffectiveInt Iform, sens_ID, fct_IDF;
  EffectiveReal AscaleF;
  EffectiveInt fric_ID;
  EffectiveReal C1, C2, C3, C4, C5, C6;
  EffectiveInt NRadm;
  EffectiveReal Padm, Angladm, Kthe;
  EffectiveInt fct_IDK;
  EffectiveReal Tint;
  EffectiveInt Ithe_form;
  EffectiveReal AscaleK, Frad, Drad, Fheats, Fheatm;
};

struct InterType10 : InterFields<InterType10> {
  static constexpr InterfaceTraits traits{
      10, "/INTER/TYPE10", {"grnd_IDs", "grnod"}, {"surf_IDm", "surf"}, "Gap"};
  EffectiveInt grnd_IDs, surf_IDm, Idel;
  EffectiveReal Stfac, Gap, Tstart, Tstop;
  EffectiveInt ITIED, Inacti;
  EffectiveReal VISs, Bumult;
};

struct InterType11 : InterFields<InterType11> {
  static constexpr InterfaceTraits traits{
      11, "/INTER/TYPE11", {"line_IDs", "line"}, {"line_IDm", "line"}, "Gapmin"};
  EffectiveInt line_IDs, line_IDm, Istf, Ithe, Igap, Irem_gap, Idel;
  EffectiveReal Stmin, Stmax, mesh_size, dtmin;
  EffectiveInt Iform, sens_ID;
  EffectiveReal Stfac, Fric, Gapmin, Tstart, Tstop;
  EffectiveText IBC;
  EffectiveInt Inacti;
  EffectiveReal VISs, VISF, Bumult;
  EffectiveInt fric_ID;
  EffectiveReal Kthe;
  EffectiveInt fct_IDK;
  EffectiveReal AscaleK, Tint;
  EffectiveInt Ithe_form;
  EffectiveReal Frad, Drad;
};

struct InterType19 : InterFields<InterType19> {
  static constexpr InterfaceTraits traits{
      19, "/INTER/TYPE19", {"surf_IDs", "surf"}, {"surf_IDm", "surf"}, "Gapmin"};
  EffectiveInt surf_IDs, surf_IDm, Istf, Ithe, Igap, Iedge, Ibag, Idel, Icurv;
  EffectiveReal Fscalegap, Gapmax, Edge_scale_gap, Stmin, Stmax, mesh_size, dtmin;
  EffectiveInt Irem_gap, Irem_i2, node_ID1, node_ID2;
  EffectiveReal Stfac, Fric, Gapmin, Tstart, Tstop;
  EffectiveText IBC;
  EffectiveInt Inacti;
  EffectiveReal VISs, VISF, Bumult;
  EffectiveInt Ifric, Ifiltr;
  EffectiveReal Xfreq;
  EffectiveInt Iform, sens_ID, fric_ID;
  EffectiveReal C1, C2, C3, C4, C5, C6, Kthe;
  EffectiveInt fct_IDK;
  EffectiveReal Tint;
  EffectiveInt Ithe_form;
  EffectiveReal AscaleK, Frad, Drad, Fheats, Fheatm;
};

/// Segments against nodes, of one surface or of two; no minimum gap: gaps follow the thicknesses.
struct InterType24 : InterFields<InterType24> {
  static constexpr InterfaceTraits traits{
      24, "/INTER/TYPE24", {"surf_ID1", "surf"}, {"surf_ID2", "surf"}, ""};
  EffectiveInt surf_ID1, surf_ID2, Istf, Irem_i2, Idel, IPSTIF, grnd_IDs, Iedge;
  EffectiveReal Edge_angle, Gap_max_s, Gap_max_m, Stmin, Stmax;
  EffectiveInt Igap0, Ipen0;
  EffectiveReal Ipen_max, Ipen_min, STFAC_MDT, Stfac, Fric, Tstart, Tstop;
  EffectiveText IBC;
  EffectiveInt Inacti;
  EffectiveReal VISs, Tpressfit;
  EffectiveInt Ifric, Ifiltr;
  EffectiveReal Xfreq;
  EffectiveInt sens_ID;
  EffectiveReal DTSTIF;
  EffectiveInt fric_ID;
  EffectiveReal C1, C2, C3, C4, C5, C6;
};

/// The same with both sides of the mesh joined to a whole: what current models use.
struct InterType25 : InterFields<InterType25> {
  static constexpr InterfaceTraits traits{
      25, "/INTER/TYPE25", {"surf_ID1", "surf"}, {"surf_ID2", "surf"}, ""};
  EffectiveInt surf_ID1, surf_ID2, Istf, Ithe, Igap, Irem_i2, Idel, Iedge, IPSTIF, grnd_IDs;
  EffectiveReal Gap_scale, mesh_size, Gap_max_s, Gap_max_m, Stmin, Stmax;
  EffectiveInt Igap0, Ishape;
  EffectiveReal Edge_angle, STFAC_MDT, Stfac, Fric, Tpressfit, Tstart, Tstop;
  EffectiveText IBC;
  EffectiveInt IVIS2, Inacti;
  EffectiveReal VISs;
  EffectiveInt Ithick;
  EffectiveReal Pmax;
  EffectiveInt Ifric, Ifiltr;
  EffectiveReal Xfreq;
  EffectiveInt sens_ID;
  EffectiveReal DTSTIF;
  EffectiveInt fric_ID;
  EffectiveReal C1, C2, C3, C4, C5, C6, ViscFluid, SigMaxAdh, ViscAdhFact, Kthe;
  EffectiveInt fct_IDK;
  EffectiveReal Tint;
  EffectiveInt Ithe_form;
  EffectiveReal AscaleK, Frad, Drad, Fheats, Fheatm;
  EffectiveInt FRIC_FUN, Fcond;
  EffectiveReal Dcond, THICK_S, THICK_S_SCALE, THICK_M, THICK_M_SCALE;
};

/// /DEFAULT/INTER/TYPEn: the non-zero fields.
struct DefaultInter {
  int type = 0;
  std::vector<std::pair<std::string, Effective<std::int64_t>>> values;
  Span span;
  const Effective<std::int64_t>* find(std::string_view field) const;
};

/// One /FRICTION: global values, then part pairs.
struct FrictionValues {
  std::array<double, 6> C{};
  double Fric = 0, VISF = 0;
};
struct FrictionPair {
  std::int64_t grpart_ID1 = 0, grpart_ID2 = 0, part_ID1 = 0, part_ID2 = 0;
  int Idir = 0;
  FrictionValues values, second;  ///< second: orthotropic direction, only if Idir = 1
  Span span;
};
struct Friction {
  std::int64_t id = 0;
  std::string title;
  std::int64_t Ifric = 0, Ifiltr = 0, Iform = 0;
  double Xfreq = 0;
  FrictionValues values;
  std::vector<FrictionPair> pairs;
  Span span;
};

/// The contacts and ties of a deck. `ordered` and `all` point into the lists, so it can be moved,
/// not copied.
struct Interfaces {
  std::vector<InterType7> type7;
  std::vector<InterType10> type10;
  std::vector<InterType11> type11;
  std::vector<InterType19> type19;
  std::vector<InterType24> type24;
  std::vector<InterType25> type25;
  std::vector<InterType2> type2;       ///< ties, in deck order; not in `ordered`
  std::vector<DefaultInter> defaults;  ///< honoured ones only, at most one of a type
  std::vector<Friction> frictions;
  /// All contacts in deck order.
  std::vector<const InterBase*> ordered;
  /// The same with ties: all whose cards are read as values.
  std::vector<const InterBase*> all;
  /// The first with this id, contact or tie; nullptr: there is none.
  const InterBase* find(std::int64_t id) const {
    for (const InterBase* inter : all)
      if (inter->id == id) return inter;
    return nullptr;
  }
  const Friction* friction(std::int64_t id) const;
  /// The default block that interfaces of this type take; nullptr if there is none.
  const DefaultInter* defaults_of(int type) const;

  Interfaces() = default;
  Interfaces(Interfaces&&) = default;
  Interfaces& operator=(Interfaces&&) = default;
  Interfaces(const Interfaces&) = delete;
  Interfaces& operator=(const Interfaces&) = delete;
  ~Interfaces() = default;

  /// Calls f(list) for the list of every type of contact.
  template <class F>
  void each_list(F&& f) {
    f(type7), f(type10), f(type11), f(type19), f(type24), f(type25);
  }
  template <class F>
  void each_list(F&& f) const {
    f(type7), f(type10), f(type11), f(type19), f(type24), f(type25);
  }
};

inline constexpr std::array<const InterfaceTraits*, 6> interface_types{
    &InterType7::traits,  &InterType10::traits, &InterType11::traits,
    &InterType19::traits, &InterType24::traits, &InterType25::traits};
/// The row of an interface type; nullptr for types that are not read.
inline const InterfaceTraits* traits_of(int type) {
  for (const InterfaceTraits* t : interface_types)
    if (t->type == type) return t;
  return nullptr;
}
inline const InterfaceTraits& traits_of(const InterBase& inter) { return *traits_of(inter.type); }
/// TYPE24 and TYPE25: segments with two sides, penetrations that only the first cycle acts on.
inline bool is_modern(int type) { return type == 24 || type == 25; }
/// What such a contact is between: 1 the nodes and segments of one surface, 2 of two surfaces,
/// 3 a node group and the second surface, 0 nothing.
inline int level_of(std::int64_t surf_ID1, std::int64_t surf_ID2) {
  if (surf_ID1 == 0) return surf_ID2 == 0 ? 0 : 3;
  return surf_ID2 == 0 || surf_ID2 == surf_ID1 ? 1 : 2;
}

/// Decodes the interface blocks and forms the effective values in the reference solver's order of
/// evaluation. `model` supplies what some defaults depend on (thermal materials, adaptive meshing,
/// monitored volumes, number of nodes). What follows from the mesh (Origin::geometry) is left at 0:
/// `resolve` (deck/contact/resolve.hpp) fills it in. Reading-level findings go to `diagnostics`.
Interfaces read_interfaces(const Deck& deck, const Model& model, Diagnostics& diagnostics);

}  // namespace deck

#include "deck/model/interfaces_fields.hpp"
