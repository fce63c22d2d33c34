// Contact stiffness of main segments, edges and secondary nodes from their elements; thickness,
// section area, moduli and volume of single elements.
#include <algorithm>
#include <cmath>

#include "base/shared/parallel.hpp"
#include "contact/search/sweep.hpp"
#include "contact/shared/scene_steps.hpp"
#include "model/shared/faces.hpp"

namespace deck::detail {
namespace {

bool solid_holds(const Elements& solids, std::uint32_t e, NodeIndex n) {
  if (any_is(solids.of(e), 8, n)) return true;
  if (e >= solids.extra.size() || solids.extra[e] == no_index ||
      solids.shape[e] != SolidShape::tetra10)
    return false;
  return any_is(solids.extra_nodes.data() + solids.extra[e], 6, n);
}

const Part* part_of(const Model& model, const Elements& family, std::uint32_t e) {
  const std::uint32_t p = family.part[e];
  return p == no_index ? nullptr : &model.parts[p];
}
const Property* property_of(const Model& model, const Elements& family, std::uint32_t e) {
  const Part* part = part_of(model, family, e);
  return part == nullptr || part->prop == no_index ? nullptr : &model.properties[part->prop];
}
const Material* material_of(const Model& model, const Elements& family, std::uint32_t e) {
  const Part* part = part_of(model, family, e);
  return part == nullptr || part->mat == no_index ? nullptr : &model.materials[part->mat];
}
double stiffness_thickness(const Model& model, const Elements& family, std::uint32_t e) {
  if (!model.intthick_v5 && e < family.thickness.size())
    if (const double own = family.thickness[e]; own != 0) return own;
  const Property* p = property_of(model, family, e);
  return p == nullptr ? 0 : p->thickness;
}

}  // namespace

/// Sum of the stiffnesses of the shells at each node: quadrangles first, in element order.
const ElementTables& shell_stiffness_at_nodes(SceneContext& c) {
  ElementTables& at = *c.tables;
  if (!at.stiffness.empty()) return at;
  at.stiffness.assign(c.model.nodes.size(), 0);
  at.count.assign(c.model.nodes.size(), 0);
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3}) {
    const Elements& family = c.model.family(kind);
    for (std::uint32_t e = 0; e < family.size(); ++e) {
      const double k = young_of(c.model, kind, e) * stiffness_thickness(c.model, kind, e);
      const NodeIndex* n = family.of(e);
      for (int i = 0; i < family.width; ++i) {
        // A repeated node of an element counts once.
        if (n[i] == no_index || std::find(n, n + i, n[i]) != n + i) continue;
        at.stiffness[n[i]] += k;
        ++at.count[n[i]];
      }
    }
  }
  return at;
}

void set_main_stiffness(SceneContext& c, Contact& contact) {
  const double f = contact.factor;
  const auto set = [&](MainSegment& m) {
    m.stiffness = m.element == no_index ? 0 : std::max(0.0, -f);
    if (m.element == no_index) return;
    if (m.carrier == Carrier::solid) {
      const Coordinates& x = c.scene.coordinates;
      const Vec d =
          cross(at(x, m.nodes[2]) - at(x, m.nodes[0]), at(x, m.nodes[3]) - at(x, m.nodes[1]));
      // Floor of the solver: a segment without area has a tiny stiffness.
      const double area = 0.5 * std::max(1e-20, std::sqrt(dot(d, d)));
      const double volume = solid_volume(c, m.element);
      m.stiffness = volume > 0 ? f * area * area * bulk_of(c.model, m.element) / volume : 0;
    } else if (m.carrier == Carrier::shell4 || m.carrier == Carrier::shell3) {
      const ElementKind kind = *family_of_carrier(m.carrier);
      const double t = stiffness_thickness(c.model, kind, m.element);
      if (!(f < 0)) m.stiffness = f * (young_of(c.model, kind, m.element) * t);
    }
  };
  parallel_pieces(threads_for(contact.main.size(), effective_threads(c.options.threads)),
                  contact.main.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i < end; ++i) set(contact.main[i]);
                  });
}

void set_edge_stiffness(SceneContext& c, std::vector<ContactEdge>& edges, const Contact& contact) {
  const Model& model = c.model;
  const Coordinates& x = c.scene.coordinates;
  const double f = contact.factor;
  const bool constant = contact.istf == 1;
  for (const ElementKind kind : {ElementKind::shell3, ElementKind::shell4, ElementKind::truss,
                                 ElementKind::beam, ElementKind::spring, ElementKind::solid8})
    c.connectivity.prepare(kind);
  const auto set = [&](ContactEdge& edge) {
    const NodeIndex a = edge.nodes[0], b = edge.nodes[1];
    double k = 0;
    edge.shell = edge.section = 0;
    edge.carrier = Carrier::none;
    // One-dimensional elements override shells, shells override solids. The thickest shell counts,
    // among equals the stiffest; 3-node shells go before 4-node shells (measured on the solver).
    double thickness = 0, young = 0;
    bool shell = false;
    for (const ElementKind kind : {ElementKind::shell3, ElementKind::shell4}) {
      if (shell) break;
      const Elements& family = model.family(kind);
      for (const std::uint32_t e : c.connectivity.elements(kind, a)) {
        if (!any_is(family.of(e), family.width, b)) continue;
        const double t = gap_thickness(model, kind, e), y = young_of(model, kind, e);
        if (shell && !(t > thickness || (t == thickness && y > young))) continue;
        shell = true;
        thickness = t;
        young = y;
        edge.carrier = kind == ElementKind::shell4 ? Carrier::shell4 : Carrier::shell3;
        edge.element = e;
      }
    }
    if (shell) {
      k = f * thickness * young;
      edge.shell = thickness;
    }
    for (const ElementKind kind : {ElementKind::truss, ElementKind::beam, ElementKind::spring}) {
      const Elements& family = model.family(kind);
      for (const std::uint32_t e : c.connectivity.elements(kind, a)) {
        const NodeIndex* n = family.of(e);
        if (!(n[0] == a && n[1] == b) && !(n[0] == b && n[1] == a)) continue;
        edge.carrier = kind == ElementKind::truss  ? Carrier::truss
                       : kind == ElementKind::beam ? Carrier::beam
                                                   : Carrier::spring;
        edge.element = e;
        if (kind == ElementKind::spring) {
          k = f * spring_stiffness(model, e);
          continue;
        }
        const double s = section_thickness(model, kind, e);
        k = f * s * young_of(model, kind, e);
        edge.section = s;
      }
    }
    if (edge.carrier == Carrier::none) {
      std::uint32_t solid = no_index;
      for (const std::uint32_t e : c.connectivity.elements(ElementKind::solid8, a))
        if (solid_holds(model.solid8, e, b) &&
            (solid == no_index || model.solid8.id[e] > model.solid8.id[solid]))
          solid = e;
      if (solid != no_index) {
        edge.carrier = Carrier::solid;
        edge.element = solid;
        const double l = distance(x, a, b);
        k = l > 0 ? f * solid_volume(c, solid) * bulk_of(model, solid) / (l * l) : 0;
      }
    }
    edge.stiffness = constant && edge.carrier != Carrier::none ? std::fabs(f) : k;
  };
  parallel_pieces(effective_threads(c.options.threads), edges.size(),
                  [&](std::size_t, std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i < end; ++i) set(edges[i]);
                  });
}

void set_nodal_stiffness(SceneContext& c, Contact& contact) {
  const Model& model = c.model;
  const Coordinates& x = c.scene.coordinates;
  const ElementTables& shells = shell_stiffness_at_nodes(c);
  contact.nodal_stiffness.reserve(contact.secondary.size());
  for (const SecondaryNode& s : contact.secondary) {
    double k = 0;
    for (const ElementKind kind : {ElementKind::truss, ElementKind::beam}) {
      const Elements& family = model.family(kind);
      for (const std::uint32_t e : c.connectivity.elements(kind, s.node)) {
        const NodeIndex* n = family.of(e);
        if (n[0] != s.node && n[1] != s.node) continue;
        if (n[0] == no_index || n[1] == no_index) continue;
        const double l = distance(x, n[0], n[1]);
        if (l > 0) k += young_of(model, kind, e) * section_area(model, kind, e) / l;
      }
    }
    for (const std::uint32_t e : c.connectivity.elements(ElementKind::spring, s.node)) {
      const NodeIndex* n = model.spring.of(e);
      if (n[0] == s.node || n[1] == s.node) k += spring_stiffness(model, e);
    }
    if (shells.count[s.node] > 0) k += shells.stiffness[s.node] / shells.count[s.node];
    double volume = 0, weighted = 0;
    for (const std::uint32_t e : c.connectivity.elements(ElementKind::solid8, s.node)) {
      const SolidShape shape = model.solid8.shape[e];
      double share = 0.125, v = solid_volume(c, e);
      if (shape == SolidShape::penta6) share = 1.0 / 6;
      if (shape == SolidShape::tetra4) share = 0.25;
      if (shape == SolidShape::tetra10) {
        constexpr double q = 4 * 3.0 / 14 + 6;
        share = any_is(model.solid8.of(e), 8, s.node) ? (3.0 / 14) / q : 1 / q;
      } else if (shape == SolidShape::brick20) {
        constexpr double q = 8 * 3.0 / 14 + 12;
        share = any_is(model.solid8.of(e), 8, s.node) ? (3.0 / 14) / q : 1 / q;
      } else if (shape == SolidShape::thick16) {
        share = any_is(model.solid8.of(e), 8, s.node) ? 1.0 / 32 : 3.0 / 32;
      }
      // Own volume; the one-point rule gives 1.5 times that of a tetrahedron.
      if (shape == SolidShape::tetra4 || shape == SolidShape::tetra10) v /= 1.5;
      volume += share * v;
      weighted += share * v * bulk_of(model, e);
    }
    if (volume > 0) k += weighted / volume * std::cbrt(2 * volume);
    contact.nodal_stiffness.push_back(s.off ? 0 : k);
  }
}

double part_thickness(const Model& model, ElementKind kind, std::uint32_t e) {
  const Part* part = part_of(model, model.family(kind), e);
  return part == nullptr ? 0 : part->thickness;
}

bool is_on_shell(const MainSegment& m) {
  return m.carrier == Carrier::shell4 || m.carrier == Carrier::shell3;
}

double contact_thickness(const Model& model, const MainSegment& m) {
  if (!is_on_shell(m) || m.element == no_index) return 0;
  return gap_thickness(model, *family_of_carrier(m.carrier), m.element);
}

double gap_thickness(const Model& model, ElementKind kind, std::uint32_t e) {
  const Elements& family = model.family(kind);
  if (!model.intthick_v5)
    if (const Part* part = part_of(model, family, e); part != nullptr && part->thickness != 0)
      return part->thickness;
  return stiffness_thickness(model, family, e);
}

double stiffness_thickness(const Model& model, ElementKind kind, std::uint32_t e) {
  return stiffness_thickness(model, model.family(kind), e);
}

double young_of(const Model& model, ElementKind kind, std::uint32_t e) {
  const Material* m = material_of(model, model.family(kind), e);
  return m == nullptr ? 0 : m->young;
}

double bulk_of(const Model& model, std::uint32_t solid) {
  const Material* m = material_of(model, model.solid8, solid);
  if (m == nullptr) return 0;
  const Property* p = property_of(model, model.solid8, solid);
  if (p == nullptr || p->icontrol != 1) return m->bulk;
  return 2 * m->bulk * (m->law == 1 ? 5 : m->law == 62 ? 100 : 1);
}

double section_area(const Model& model, ElementKind kind, std::uint32_t e) {
  const Property* p = property_of(model, model.family(kind), e);
  return p == nullptr ? 0 : p->area;
}

double section_thickness(const Model& model, ElementKind kind, std::uint32_t e) {
  return std::sqrt(section_area(model, kind, e));
}

double spring_stiffness(const Model& model, std::uint32_t spring) {
  const Property* p = property_of(model, model.spring, spring);
  if (p == nullptr) return 0;
  const auto& k = p->stiffness;
  if (p->number == 8 || p->number == 13 || p->number == 23)
    return std::fmax(k[0], std::fmax(k[1], k[2]));
  return k[0];
}

std::map<NodeIndex, std::string> unread_at_nodes(const Model& model, bool stiffness) {
  std::map<NodeIndex, std::string> out;
  const auto note = [&](const Elements& family, std::uint32_t e, const char* what, const auto& x) {
    for (int k = 0; k < carrying_nodes(family.kind); ++k)
      out.emplace(family.of(e)[k], what + std::to_string(x.id) + " (" + x.type + ")");
  };
  const auto known = [](const auto& all, auto member) {
    return std::all_of(all.begin(), all.end(), [&](const auto& x) { return x.*member; });
  };
  const bool materials = !stiffness || known(model.materials, &Material::stiffness_known);
  if (materials && known(model.properties, &Property::known)) return out;
  for (const ElementKind kind : all_families) {
    const Elements& family = model.family(kind);
    const bool spring = kind == ElementKind::spring;
    for (std::uint32_t e = 0; e < family.size(); ++e) {
      const Material* m = spring || !stiffness ? nullptr : material_of(model, family, e);
      const Property* p = property_of(model, family, e);
      const bool sized = kind != ElementKind::solid8 && (stiffness || !spring);
      if (m != nullptr && !m->stiffness_known)
        note(family, e, "the contact stiffness is not known of material ", *m);
      else if (p != nullptr && !p->known && sized &&
               (stiffness ? stiffness_thickness(model, family, e)
                          : gap_thickness(model, kind, e)) == 0)
        note(family, e, "deck does not read property ", *p);
    }
  }
  return out;
}

double solid_volume(SceneContext& c, std::uint32_t solid) {
  std::atomic<double>& known = c.tables->volume[solid];
  double volume = known.load(std::memory_order_relaxed);
  if (volume == 0) {
    volume = solid_volume(c.scene.coordinates, c.model.solid8.of(solid));
    known.store(volume, std::memory_order_relaxed);
  }
  return volume;
}

double solid_volume(const Coordinates& x, const NodeIndex* n) {
  if (std::find(n, n + 8, no_index) != n + 8) return 0;  // a node is missing: reported on reading
  const Vec a = at(x, n[6]) - at(x, n[0]), b = at(x, n[7]) - at(x, n[1]);
  const Vec c = at(x, n[4]) - at(x, n[2]), d = at(x, n[5]) - at(x, n[3]);
  const Vec ad = a + d, bc = b + c;
  const Vec j1 = ad - bc;
  const Vec j2 = a + b - c - d;  // in this order: the last bit decides search distances of ties
  const Vec j3 = ad + bc;
  return std::fabs(dot(j1, cross(j2, j3))) / 64;
}

}  // namespace deck::detail
