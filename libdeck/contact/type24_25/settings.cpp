// Settings of a TYPE24 or TYPE25 from its card and from what-if values; initial penetrations that a
// tie (/INTER/TYPE2) replaces (Irem_i2 = 1).
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "contact/shared/tie_steps.hpp"
#include "contact/type24_25/type24_25.hpp"

namespace deck::detail::type24_25 {
namespace {

int flag(const EffectiveInt& f) { return f.value == 1000 ? 0 : static_cast<int>(f.value); }

/// An invalid Igap acts as 1.
int igap_of(std::int64_t cell) {
  return cell == 2 || cell == 3 || cell == 5 ? static_cast<int>(cell) : 1;
}

template <class Inter>
void read_caps(const Inter& i, Settings& s) {
  s.level = level_of(i.surf_ID1.value, i.surf_ID2.value);
  s.istf = flag(i.Istf);
  s.inacti = flag(i.Inacti) == -2 ? -1 : flag(i.Inacti);
  s.iedge = flag(i.Iedge);
  s.igap0 = flag(i.Igap0);
  s.irem_i2 = flag(i.Irem_i2);
  s.factor = s.istf == 1 ? -i.Stfac.value : i.Stfac.value;
  s.cos_edge = std::cos((180 - i.Edge_angle.value) * std::numbers::pi / 180);
  s.cap_s = i.Gap_max_s.value;
  s.cap_m = i.Gap_max_m.value;
}

}  // namespace

Settings settings_of(const InterBase& inter, const std::vector<WhatIf>& what_if) {
  Settings s;
  s.type = inter.type;
  visit_interface(inter, [&](const auto& i) {
    if constexpr (requires { i.Gap_max_s; }) read_caps(i, s);
    if constexpr (requires { i.Ipen0; }) {
      s.ipen0 = flag(i.Ipen0);
      s.ipen_max = i.Ipen_max.value;
    }
    if constexpr (requires { i.Ishape; }) {
      s.igap = igap_of(i.Igap.value);
      s.ishape = static_cast<int>(i.Ishape.value);
      s.ivis2 = static_cast<int>(i.IVIS2.value);
      s.scale = i.Gap_scale.value;
      s.mesh_fraction = i.mesh_size.value;
      s.thick_s = i.THICK_S.value;
      s.thick_s_scale = i.THICK_S_SCALE.value;
      s.thick_m = i.THICK_M.value;
      s.thick_m_scale = i.THICK_M_SCALE.value;
    }
  });
  for (const WhatIf& w : what_if) {
    if (w.interface_id != inter.id) continue;
    if (w.Inacti) s.inacti = *w.Inacti == 1000 ? 0 : *w.Inacti;
    // Caps of both sides, if larger, and Gap_scale.
    if (w.Gapmax) {
      s.cap_s = std::min(s.cap_s, *w.Gapmax);
      s.cap_m = std::min(s.cap_m, *w.Gapmax);
    }
    if (inter.type == 24) continue;
    if (w.Fscalegap) s.scale = *w.Fscalegap;
    if (w.mesh_size) s.mesh_fraction = mesh_fraction_of(*w.mesh_size);
    if (!w.Igap) continue;
    s.igap = igap_of(*w.Igap);
    if (s.igap != 3) continue;
    if (s.ishape == 1) s.ishape = 2;
    s.mesh_fraction = mesh_fraction_of(s.mesh_fraction);
  }
  return s;
}

std::vector<bool> tied_penetrations(SceneContext& c, const Sides& s,
                                    std::span<const NodePenetration> penetrations) {
  std::vector<std::pair<NodeIndex, NodeIndex>> pairs;  // tied node, corner of its main segment
  for (const Tie& tie : ties_of(c))
    for (const TiedNode& n : tie.nodes)
      if (n.tied)
        for (const NodeIndex corner : tie.main[n.segment]) pairs.emplace_back(n.node, corner);
  std::vector<bool> held(penetrations.size(), false);
  if (pairs.empty()) return held;
  std::sort(pairs.begin(), pairs.end());
  const auto tied = [&](NodeIndex node, NodeIndex corner) {
    return std::binary_search(pairs.begin(), pairs.end(), std::pair{node, corner});
  };
  for (std::size_t i = 0; i < penetrations.size(); ++i) {
    const NodeIndex n = s.nodes[penetrations[i].node].node;
    for (const NodeIndex corner : s.nodes_of(penetrations[i].face))
      if (tied(n, corner) || tied(corner, n)) held[i] = true;
  }
  return held;
}

}  // namespace deck::detail::type24_25
