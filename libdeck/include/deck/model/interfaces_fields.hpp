// The fields of every interface type by name, in the order of the manual: what makes reports, rules
// and tests treat them alike. Included at the end of interfaces.hpp.
#pragma once
#include <stdexcept>
#include <type_traits>

#include "deck/model/interfaces.hpp"

namespace deck {

template <class Self, class F>
requires std::is_same_v<std::remove_const_t<Self>, InterType2>
void visit_fields(Self& s, F& f) {
  f("grnd_IDs", s.grnd_IDs);
  f("surf_IDm", s.surf_IDm);
  f("Ignore", s.Ignore);
  f("Spotflag", s.Spotflag);
  f("Level", s.Level);
  f("Isearch", s.Isearch);
  f("Idel2", s.Idel2);
  f("surf_IDs", s.surf_IDs);
  f("dsearch", s.dsearch);
  f("Rupt", s.Rupt);
  f("Ifiltr", s.Ifiltr);
  f("fct_IDsr", s.fct_IDsr);
  f("fct_IDsn", s.fct_IDsn);
  f("fct_IDst", s.fct_IDst);
  f("Isym", s.Isym);
  f("Max_N_Dist", s.Max_N_Dist);
  f("Max_T_Dist", s.Max_T_Dist);
  f("Fscalestress", s.Fscalestress);
  f("Fscalestr_rate", s.Fscalestr_rate);
  f("Fscaledist", s.Fscaledist);
  f("Alpha", s.Alpha);
  f("Area", s.Area);
  f("Stfac", s.Stfac);
  f("Visc", s.Visc);
  f("Istf", s.Istf);
  f("Ithe", s.Ithe);
  f("Kthe", s.Kthe);
  f("Iproj", s.Iproj);
}

template <class Self, class F>
requires std::is_same_v<std::remove_const_t<Self>, InterType7>
void visit_fields(Self& s, F& f) {
  f("grnd_IDs", s.grnd_IDs);
  f("surf_IDm", s.surf_IDm);
  f("Istf", s.Istf);
  f("Ithe", s.Ithe);
  f("Igap", s.Igap);
  f("Ibag", s.Ibag);
  f("Idel", s.Idel);
  f("Icurv", s.Icurv);
  f("Iadm", s.Iadm);
  f("Fscalegap", s.Fscalegap);
  f("Gapmax", s.Gapmax);
  f("Fpenmax", s.Fpenmax);
  f("ITIED", s.ITIED);
  f("Stmin", s.Stmin);
  f("Stmax", s.Stmax);
  f("%mesh_size", s.mesh_size);
  f("dtmin", s.dtmin);
  f("Irem_gap", s.Irem_gap);
  f("Irem_i2", s.Irem_i2);
  f("node_ID1", s.node_ID1);
  f("node_ID2", s.node_ID2);
  f("Stfac", s.Stfac);
  f("Fric", s.Fric);
  f("Gapmin", s.Gapmin);
  f("Tstart", s.Tstart);
  f("Tstop", s.Tstop);
  f("IBC", s.IBC);
  f("Inacti", s.Inacti);
  f("VISs", s.VISs);
  f("VISF", s.VISF);
  f("Bumult", s.Bumult);
  f("Ifric", s.Ifric);
  f("Ifiltr", s.Ifiltr);
  f("Xfreq", s.Xfreq);
  f("Iform", s.Iform);
  f("sens_ID", s.sens_ID);
  f("fct_IDF", s.fct_IDF);
  f("AscaleF", s.AscaleF);
  f("fric_ID", s.fric_ID);
  f("C1", s.C1);
  f("C2", s.C2);
  f("C3", s.C3);
  f("C4", s.C4);
  f("C5", s.C5);
  f("C6", s.C6);
  f("NRadm", s.NRadm);
  f("Padm", s.Padm);
  f("Angladm", s.Angladm);
  f("Kthe", s.Kthe);
  f("fct_IDK", s.fct_IDK);
  f("Tint", s.Tint);
  f("Ithe_form", s.Ithe_form);
  f("AscaleK", s.AscaleK);
  f("Frad", s.Frad);
  f("Drad", s.Drad);
  f("Fheats", s.Fheats);
  f("Fheatm", s.Fheatm);
}

template <class Self, class F>
requires std::is_same_v<std::remove_const_t<Self>, InterType10>
void visit_fields(Self& s, F& f) {
  f("grnd_IDs", s.grnd_IDs);
  f("surf_IDm", s.surf_IDm);
  f("Idel", s.Idel);
  f("Stfac", s.Stfac);
  f("Gap", s.Gap);
  f("Tstart", s.Tstart);
  f("Tstop", s.Tstop);
  f("ITIED", s.ITIED);
  f("Inacti", s.Inacti);
  f("VISs", s.VISs);
  f("Bumult", s.Bumult);
}

template <class Self, class F>
requires std::is_same_v<std::remove_const_t<Self>, InterType11>
void visit_fields(Self& s, F& f) {
  f("line_IDs", s.line_IDs);
  f("line_IDm", s.line_IDm);
  f("Istf", s.Istf);
  f("Ithe", s.Ithe);
  f("Igap", s.Igap);
  f("Irem_gap", s.Irem_gap);
  f("Idel", s.Idel);
  f("Stmin", s.Stmin);
  f("Stmax", s.Stmax);
  f("%mesh_size", s.mesh_size);
  f("dtmin", s.dtmin);
  f("Iform", s.Iform);
  f("sens_ID", s.sens_ID);
  f("Stfac", s.Stfac);
  f("Fric", s.Fric);
  f("Gapmin", s.Gapmin);
  f("Tstart", s.Tstart);
  f("Tstop", s.Tstop);
  f("IBC", s.IBC);
  f("Inacti", s.Inacti);
  f("VISs", s.VISs);
  f("VISF", s.VISF);
  f("Bumult", s.Bumult);
  f("fric_ID", s.fric_ID);
  f("Kthe", s.Kthe);
  f("fct_IDK", s.fct_IDK);
  f("AscaleK", s.AscaleK);
  f("Tint", s.Tint);
  f("Ithe_form", s.Ithe_form);
  f("Frad", s.Frad);
  f("Drad", s.Drad);
}

template <class Self, class F>
requires std::is_same_v<std::remove_const_t<Self>, InterType19>
void visit_fields(Self& s, F& f) {
  f("surf_IDs", s.surf_IDs);
  f("surf_IDm", s.surf_IDm);
  f("Istf", s.Istf);
  f("Ithe", s.Ithe);
  f("Igap", s.Igap);
  f("Iedge", s.Iedge);
  f("Ibag", s.Ibag);
  f("Idel", s.Idel);
  f("Icurv", s.Icurv);
  f("Fscalegap", s.Fscalegap);
  f("Gapmax", s.Gapmax);
  f("Edge_scale_gap", s.Edge_scale_gap);
  f("Stmin", s.Stmin);
  f("Stmax", s.Stmax);
  f("%mesh_size", s.mesh_size);
  f("dtmin", s.dtmin);
  f("Irem_gap", s.Irem_gap);
  f("Irem_i2", s.Irem_i2);
  f("node_ID1", s.node_ID1);
  f("node_ID2", s.node_ID2);
  f("Stfac", s.Stfac);
  f("Fric", s.Fric);
  f("Gapmin", s.Gapmin);
  f("Tstart", s.Tstart);
  f("Tstop", s.Tstop);
  f("IBC", s.IBC);
  f("Inacti", s.Inacti);
  f("VISs", s.VISs);
  f("VISF", s.VISF);
  f("Bumult", s.Bumult);
  f("Ifric", s.Ifric);
  f("Ifiltr", s.Ifiltr);
  f("Xfreq", s.Xfreq);
  f("Iform", s.Iform);
  f("sens_ID", s.sens_ID);
  f("fric_ID", s.fric_ID);
  f("C1", s.C1);
  f("C2", s.C2);
  f("C3", s.C3);
  f("C4", s.C4);
  f("C5", s.C5);
  f("C6", s.C6);
  f("Kthe", s.Kthe);
  f("fct_IDK", s.fct_IDK);
  f("Tint", s.Tint);
  f("Ithe_form", s.Ithe_form);
  f("AscaleK", s.AscaleK);
  f("Frad", s.Frad);
  f("Drad", s.Drad);
  f("Fheats", s.Fheats);
  f("Fheatm", s.Fheatm);
}

template <class Self, class F>
requires std::is_same_v<std::remove_const_t<Self>, InterType24>
void visit_fields(Self& s, F& f) {
  f("surf_ID1", s.surf_ID1);
  f("surf_ID2", s.surf_ID2);
  f("Istf", s.Istf);
  f("Irem_i2", s.Irem_i2);
  f("Idel", s.Idel);
  f("IPSTIF", s.IPSTIF);
  f("grnd_IDs", s.grnd_IDs);
  f("Iedge", s.Iedge);
  f("Edge_angle", s.Edge_angle);
  f("Gap_max_s", s.Gap_max_s);
  f("Gap_max_m", s.Gap_max_m);
  f("Stmin", s.Stmin);
  f("Stmax", s.Stmax);
  f("Igap0", s.Igap0);
  f("Ipen0", s.Ipen0);
  f("Ipen_max", s.Ipen_max);
  f("Ipen_min", s.Ipen_min);
  f("STFAC_MDT", s.STFAC_MDT);
  f("Stfac", s.Stfac);
  f("Fric", s.Fric);
  f("Tstart", s.Tstart);
  f("Tstop", s.Tstop);
  f("IBC", s.IBC);
  f("Inacti", s.Inacti);
  f("VISs", s.VISs);
  f("Tpressfit", s.Tpressfit);
  f("Ifric", s.Ifric);
  f("Ifiltr", s.Ifiltr);
  f("Xfreq", s.Xfreq);
  f("sens_ID", s.sens_ID);
  f("DTSTIF", s.DTSTIF);
  f("fric_ID", s.fric_ID);
  f("C1", s.C1);
  f("C2", s.C2);
  f("C3", s.C3);
  f("C4", s.C4);
  f("C5", s.C5);
  f("C6", s.C6);
}

template <class Self, class F>
requires std::is_same_v<std::remove_const_t<Self>, InterType25>
void visit_fields(Self& s, F& f) {
  f("surf_ID1", s.surf_ID1);
  f("surf_ID2", s.surf_ID2);
  f("Istf", s.Istf);
  f("Ithe", s.Ithe);
  f("Igap", s.Igap);
  f("Irem_i2", s.Irem_i2);
  f("Idel", s.Idel);
  f("Iedge", s.Iedge);
  f("IPSTIF", s.IPSTIF);
  f("grnd_IDs", s.grnd_IDs);
  f("Gap_scale", s.Gap_scale);
  f("%mesh_size", s.mesh_size);
  f("Gap_max_s", s.Gap_max_s);
  f("Gap_max_m", s.Gap_max_m);
  f("Stmin", s.Stmin);
  f("Stmax", s.Stmax);
  f("Igap0", s.Igap0);
  f("Ishape", s.Ishape);
  f("Edge_angle", s.Edge_angle);
  f("STFAC_MDT", s.STFAC_MDT);
  f("Stfac", s.Stfac);
  f("Fric", s.Fric);
  f("Tpressfit", s.Tpressfit);
  f("Tstart", s.Tstart);
  f("Tstop", s.Tstop);
  f("IBC", s.IBC);
  f("IVIS2", s.IVIS2);
  f("Inacti", s.Inacti);
  f("VISs", s.VISs);
  f("Ithick", s.Ithick);
  f("Pmax", s.Pmax);
  f("Ifric", s.Ifric);
  f("Ifiltr", s.Ifiltr);
  f("Xfreq", s.Xfreq);
  f("sens_ID", s.sens_ID);
  f("DTSTIF", s.DTSTIF);
  f("fric_ID", s.fric_ID);
  f("C1", s.C1);
  f("C2", s.C2);
  f("C3", s.C3);
  f("C4", s.C4);
  f("C5", s.C5);
  f("C6", s.C6);
  f("ViscFluid", s.ViscFluid);
  f("SigMaxAdh", s.SigMaxAdh);
  f("ViscAdhFact", s.ViscAdhFact);
  f("Kthe", s.Kthe);
  f("fct_IDK", s.fct_IDK);
  f("Tint", s.Tint);
  f("Ithe_form", s.Ithe_form);
  f("AscaleK", s.AscaleK);
  f("Frad", s.Frad);
  f("Drad", s.Drad);
  f("Fheats", s.Fheats);
  f("Fheatm", s.Fheatm);
  f("FRIC_FUN", s.FRIC_FUN);
  f("Fcond", s.Fcond);
  f("Dcond", s.Dcond);
  f("THICK_S", s.THICK_S);
  f("THICK_S_SCALE", s.THICK_S_SCALE);
  f("THICK_M", s.THICK_M);
  f("THICK_M_SCALE", s.THICK_M_SCALE);
}

/// Calls f(contact) with the contact as its own type; `base` must be in Interfaces::ordered.
template <class F>
decltype(auto) visit_interface(const InterBase& base, F&& f) {
  if (base.type == InterType7::traits.type) return f(static_cast<const InterType7&>(base));
  if (base.type == InterType10::traits.type) return f(static_cast<const InterType10&>(base));
  if (base.type == InterType11::traits.type) return f(static_cast<const InterType11&>(base));
  if (base.type == InterType19::traits.type) return f(static_cast<const InterType19&>(base));
  if (base.type == InterType24::traits.type) return f(static_cast<const InterType24&>(base));
  if (base.type == InterType25::traits.type) return f(static_cast<const InterType25&>(base));
  throw std::logic_error("visit_interface: not an element of Interfaces");
}

/// The same for contacts and ties: an element of Interfaces::all.
template <class F>
decltype(auto) visit_any_interface(const InterBase& base, F&& f) {
  if (base.type == InterType2::traits.type) return f(static_cast<const InterType2&>(base));
  return visit_interface(base, std::forward<F>(f));
}

/// Calls f(name, field) for every field of a contact or tie of whatever type.
template <class F>
void for_each_field(const InterBase& base, F&& f) {
  visit_any_interface(base, [&](const auto& inter) { inter.for_each(f); });
}

}  // namespace deck
