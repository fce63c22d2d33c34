// Converts a contact of a scene to the card and the pairs of the force stage.
#include "deck/cycle.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "cycle/adapter/effect_inputs.hpp"
#include "deck/keyword.hpp"

namespace deck::cycle {
namespace {

int flag(const EffectiveInt& f) { return f.value == 1000 ? 0 : static_cast<int>(f.value); }

int release_bits(const std::string& digits) {
  int bits = 0;
  for (std::size_t k = 0; k < 3 && k < digits.size(); ++k)
    if (digits[k] == '1') bits |= 4 >> k;
  return bits;
}

std::optional<Curve> curve_of(const deck::Model& model, std::int64_t id) {
  const auto it = id == 0 ? model.curves.end() : model.curves.find(id);
  if (it == model.curves.end() || it->second.x.empty()) return std::nullopt;
  return Curve{it->second.x, it->second.y};
}

/// Time at which a sensor switches on; none if it waits for an event.
std::optional<double> sensor_time(const deck::Model& model, std::int64_t id) {
  if (id == 0 || model.deck == nullptr) return std::nullopt;
  for (const Block& block : model.deck->blocks) {
    if (block.schema == nullptr || block.schema->kind != "sensor" || !block.id.present) continue;
    if (block.id.value + model.deck->offset_of(block, "sensor") != id) continue;
    if (block.schema->keyword != "/SENSOR/TIME") return 1e30;
    const DecodedBlock decoded = decode(*model.deck, block);
    const Cell* cell = decoded.find("Tdelay");
    return cell == nullptr ? 0.0 : working_value(*model.deck, decoded, *cell);
  }
  return std::nullopt;
}

std::array<double, 3> node_position(const Scene& scene, std::int64_t id) {
  const std::uint32_t n = scene.model->nodes.map.find(id);
  if (n == no_index) return {};
  return {scene.coordinates.x[n], scene.coordinates.y[n], scene.coordinates.z[n]};
}

// Fields of each type beyond the common ones.

void set_own_fields(const Scene& scene, const InterType7& i, ContactCard& c) {
  c.iadm = flag(i.Iadm);
  c.itied = static_cast<int>(i.ITIED.value);
  c.nradm = i.NRadm.value != 0 ? static_cast<double>(i.NRadm.value) : 3.0;
  c.padm = i.Padm.value != 0.0 ? i.Padm.value : 1.0;
  c.angladm = i.Angladm.value;
  if (c.iadm == 1) {  // the card uses the criteria of Iadm 2
    c.nradm = c.padm = 1.0;
    c.angladm = 0.0;
  }
  if (i.fct_IDF.value != 0) c.fct_idf = curve_of(*scene.model, i.fct_IDF.value);
  if (i.AscaleF.value != 0.0) c.ascalef = i.AscaleF.value;
  if (c.fct_idf && c.fric == 0.0) c.fric = 1.0;
}
template <class Inter>
void set_own_fields(const Scene&, const Inter&, ContactCard&) {}

template <class Inter>
void set_surface_fields(const Scene& scene, const Inter& i, ContactCard& c) {
  c.ifric = static_cast<int>(i.Ifric.value);
  c.c = {i.C1.value, i.C2.value, i.C3.value, i.C4.value, i.C5.value, i.C6.value};
  c.ifiltr = static_cast<int>(i.Ifiltr.value);
  c.xfreq = i.Xfreq.value;
  const int icurv = flag(i.Icurv);
  c.icurv = icurv >= 1 && icurv <= 3 ? icurv : 0;  // other values select no surface
  if (c.icurv == 1 || c.icurv == 2) {
    c.curv_node1 = node_position(scene, i.node_ID1.value);
    c.curv_node2 = node_position(scene, i.node_ID2.value);
  }
  c.fheats = i.Fheats.value;
  c.fheatm = i.Fheatm.value;
  c.ibag = flag(i.Ibag);
  set_own_fields(scene, i, c);
}

template <class Inter>
void set_common_fields(const Scene& scene, const Inter& i, const Contact& contact, ContactCard& c) {
  c.stfac = i.Stfac.value;
  c.viss = i.VISs.value;
  c.visf = i.VISF.value;
  c.fric = i.Fric.value;
  c.iform = static_cast<int>(i.Iform.value);
  c.ithe = static_cast<int>(i.Ithe.value);
  c.ithe_form = static_cast<int>(i.Ithe_form.value);
  c.kthe = i.Kthe.value;
  if (i.fct_IDK.value != 0) c.fct_idk = curve_of(*scene.model, i.fct_IDK.value);
  if (i.AscaleK.value != 0.0) c.ascalek = i.AscaleK.value;
  c.tint = i.Tint.value;
  c.frad = i.Frad.value;
  // The Starter prints the default of a blank Drad, but the force stage does not get it.
  c.drad = i.Drad.origin == Origin::geometry ? 0.0 : contact.drad;
  c.tstart = i.Tstart.value;
  c.tstop = i.Tstop.value;
  c.sensor_time = sensor_time(*scene.model, i.sens_ID.value);
  c.dtmin = i.dtmin.value;
  c.ibc = release_bits(i.IBC.value);
  c.idel = flag(i.Idel);
  const Friction* friction =
      i.fric_ID.value != 0 ? scene.interfaces->friction(i.fric_ID.value) : nullptr;
  c.fric_id = friction != nullptr;
  c.fric_orthotropic =
      friction != nullptr && contact.type != 11 && detail::has_orthotropic_pairs(*friction);
}

void set_fields(const Scene& scene, const InterType7& i, const Contact& contact, ContactCard& c) {
  set_common_fields(scene, i, contact, c);
  set_surface_fields(scene, i, c);
}
void set_fields(const Scene& scene, const InterType19& i, const Contact& contact, ContactCard& c) {
  set_common_fields(scene, i, contact, c);
  if (contact.type != 11) set_surface_fields(scene, i, c);
}
void set_fields(const Scene& scene, const InterType11& i, const Contact& contact, ContactCard& c) {
  set_common_fields(scene, i, contact, c);
}
/// Forces of TYPE24 and TYPE25 are not computed.
void set_fields(const Scene&, const InterType24&, const Contact&, ContactCard&) {}
void set_fields(const Scene&, const InterType25&, const Contact&, ContactCard&) {}
void set_fields(const Scene&, const InterType10& i, const Contact& contact, ContactCard& c) {
  c.stfac = i.Stfac.value;
  c.viss = i.VISs.value;
  c.tstart = i.Tstart.value;
  c.tstop = i.Tstop.value;
  c.itied = contact.itied;
  c.idel = flag(i.Idel);
}

}  // namespace

ContactCard make_card(const Scene& scene, const deck::Contact& contact) {
  ContactCard c;
  c.kind = contact.type == 11   ? ContactKind::edge_edge
           : contact.type == 10 ? ContactKind::tied
                                : ContactKind::node_segment;
  visit_interface(*contact.inter, [&](const auto& i) { set_fields(scene, i, contact, c); });
  // The scene has the values after the contact's own rules.
  c.istf = contact.istf;
  if (contact.factor < 0) {
    c.stfac = -contact.factor;
    if (contact.type == 7) c.istf = 1;  // constant stiffness, whatever Istf is
  }
  c.stmin = contact.stmin;
  c.stmax = contact.stmax;
  c.igap = contact.igap;
  c.gapmin = contact.gapmin;
  c.fpenmax = contact.fpenmax;
  c.inacti = contact.inacti;
  return c;
}

std::optional<FieldPlace> field_place(const InterBase& inter, std::string_view field) {
  std::optional<FieldPlace> place;
  visit_interface(inter, [&](const auto& typed) {
    typed.for_each([&](std::string_view name, const auto& e) {
      if (name == field) place = FieldPlace{e.span, e.origin};
    });
  });
  return place;
}

}  // namespace deck::cycle
