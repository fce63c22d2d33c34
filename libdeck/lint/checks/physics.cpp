// Values without which a model cannot be computed: density, stiffness, non-negative thickness, mass
// of rigid bodies, nodes.
#include <algorithm>
#include <array>
#include <vector>

#include "lint/check.hpp"
#include "model/shared/families.hpp"

namespace deck::detail {
namespace {

/// False for laws without density: void, boundaries, mixtures, connections, springs, user laws.
bool needs_density(int law) {
  static constexpr std::array without = {0,   11,  20,  29,  30,  31,  37,  46,  51,
                                         59,  75,  83,  97,  99,  105, 108, 113, 114,
                                         116, 117, 119, 130, 135, 151, 169};
  return law > 0 && std::find(without.begin(), without.end(), law) == without.end();
}

/// True if the law needs this modulus and no recorded run stops without it. Otherwise the schema
/// has a limit.
bool computes_with(int law, std::string_view field) {
  static constexpr std::array isotropic = {22, 23, 27, 32, 43, 44, 48, 52, 57, 60, 63,
                                           64, 65, 66, 71, 73, 74, 76, 78, 84, 87};
  static constexpr std::array orthotropic = {15, 25};
  const auto has = [law](const auto& laws) {
    return std::find(laws.begin(), laws.end(), law) != laws.end();
  };
  return field == "E" ? has(isotropic) : has(orthotropic);
}

void check_not_positive(const LintContext& c, const Rule& rule, Reporter& r,
                        std::initializer_list<std::string_view> fields,
                        bool (*wanted)(int, std::string_view), bool stops = true) {
  for (const Material& m : c.model->materials) {
    if (m.block == nullptr || m.block->opaque) continue;
    const DecodedBlock d = decode(c.deck, *m.block);
    for (const std::string_view field : fields) {
      if (!wanted(m.law, field) || m.block->schema->find_field(field) == nullptr) continue;
      // A missing line counts as blank.
      const Cell* cell = d.find(field);
      if (cell != nullptr && (cell->real > 0 || cell->parameter)) continue;
      const bool written = cell != nullptr && cell->span.valid() && !cell->blank();
      Finding& found = r.report(rule, *m.block, place_of(d, cell),
                                fmt::format("{} of {} {} is {}", field, m.type, m.id,
                                            written ? trim(cell->text) : "blank"));
      if (stops) continue;
      found.severity = Severity::warning;
      found.reference.reset();
    }
  }
}

void check_density(const LintContext& c, const Rule& rule, Reporter& r) {
  check_not_positive(c, rule, r, {"Rho_I"},
                     [](int law, std::string_view) { return needs_density(law); });
}

void check_modulus(const LintContext& c, const Rule& rule, Reporter& r) {
  check_not_positive(c, rule, r, {"E", "E11", "E22"}, computes_with, false);
}

/// First cell of the third line of LAW2: a, or SIG_Y if Iflag is 1. By name if the schema has the
/// line, else from the undescribed lines.
std::pair<Span, double> yield_of(const LintContext& c, const DecodedBlock& d) {
  for (const char* name : {"a", "SIG_Y"})
    if (const Cell* cell = d.find(name); cell != nullptr) return {cell->span, cell->real};
  if (d.extra.empty()) return {d.block->header_span, 0};
  const Span span = d.extra.front().columns(1, 20);
  const std::string_view text = trim(c.text(span));
  return {span, text.starts_with('&') ? 1 : read_real(text).value};
}

void check_yield(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Material& m : c.model->materials) {
    if (m.law != 2 || m.block == nullptr || m.block->opaque) continue;
    if (m.block->header.find("PLAS_ZERIL") != std::string_view::npos) continue;
    const auto [span, yield] = yield_of(c, decode(c.deck, *m.block));
    if (yield > 0) continue;
    r.report(rule, *m.block, span.valid() ? span : m.block->header_span,
             fmt::format("the yield stress a of {} {} is {}", m.type, m.id, number_text(yield)));
  }
}

void check_no_nodes(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.model->nodes.size() > 0 || c.deck.blocks.empty()) return;
  r.report(rule, c.deck.blocks.front().header_span, "the deck has no node");
}

/// Nodes with mass from elements.
class MassiveNodes {
 public:
  explicit MassiveNodes(const Model& m) : m_(m), massive_(m.nodes.size(), false) {
    for (const ElementKind kind : all_families) add(m.family(kind));
  }
  bool operator()(NodeIndex n) const { return n < massive_.size() && massive_[n]; }

 private:
  /// Springs have their mass in the property, other elements in the material.
  bool heavy(const Elements& family, std::uint32_t part) const {
    if (family.kind == ElementKind::spring || part == no_index) return true;
    const Part& p = m_.parts[part];
    return p.mat == no_index || m_.materials[p.mat].density > 0 ||
           !needs_density(m_.materials[p.mat].law);
  }
  void add(const Elements& family) {
    for (std::size_t e = 0; e < family.size(); ++e) {
      if (!heavy(family, family.part[e])) continue;
      const NodeIndex* n = family.of(e);
      for (int i = 0; i < family.width; ++i)
        if (n[i] < massive_.size()) massive_[n[i]] = true;
    }
  }
  const Model& m_;
  std::vector<bool> massive_;
};

/// True if the inertia on the card, with its products, is physically possible.
bool has_inertia(const DecodedBlock& d) {
  const double xx = d.real("Jxx"), yy = d.real("Jyy"), zz = d.real("Jzz");
  const double xy = d.real("Jxy"), yz = d.real("Jyz"), xz = d.real("Jxz");
  const double det = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  return xx > 0 && xx * yy > xy * xy && det > 0;
}

void check_rigid_mass(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.model->rbodies.empty()) return;
  // These give nodes mass in ways that this rule does not evaluate.
  const bool other_mass = has_block(c, "/ADMAS", "/SPHCEL", "/XELEM", "/RBE3", "/RBE2");
  const MassiveNodes massive(*c.model);
  for (const DecodedBlock& d : c.blocks_with_checked_ids) {
    if (d.block->schema->keyword != "/RBODY" || d.real("Mass") > 0 || has_inertia(d)) continue;
    const std::int64_t group = c.resolved(*d.block, "grnod", d.integer("grnd_ID"));
    const std::int64_t main = c.resolved(*d.block, "node", d.integer("node_ID"));
    const NodeIndex centre = c.model->find_node(main);
    // Without a main node the solver creates one.
    if (main != 0 && (centre == no_index || massive(centre))) continue;
    const bool alone = d.integer("ICoG") == 4;  // the secondary nodes do not contribute mass
    const NodeSet* set = group > 0 ? c.selections->node_group(group) : nullptr;
    if (group > 0 && set == nullptr) continue;  // reported by DK120
    if (other_mass && (main != 0 || (set != nullptr && !set->nodes.empty()))) continue;
    if (!alone && set != nullptr && std::any_of(set->nodes.begin(), set->nodes.end(), massive))
      continue;
    r.report(rule, *d.block, place_of(d, alone ? "ICoG" : "grnd_ID"),
             fmt::format("/RBODY {} has neither mass nor inertia: {}", d.block->id.value,
                         alone ? "with ICoG 4 only its card and its main node count"
                         : set == nullptr || set->nodes.empty()
                             ? "it has no secondary node"
                             : "no element with a density touches its nodes"));
  }
}

/// Effective thickness of shell `e`, as far as its sign is concerned.
double thickness_of(const Model& m, const Elements& shells, std::size_t e) {
  if (e < shells.thickness.size() && shells.thickness[e] != 0) return shells.thickness[e];
  const std::uint32_t part = shells.part[e];
  if (part == no_index || m.parts[part].prop == no_index) return 0;
  return m.properties[m.parts[part].prop].thickness;
}

/// Nodes of shells with negative thickness.
std::vector<bool> thin_nodes(const Model& m) {
  std::vector<bool> out;
  const bool by_property = std::any_of(m.properties.begin(), m.properties.end(),
                                       [](const Property& p) { return p.thickness < 0; });
  for (const Elements* shells : {&m.shell4, &m.shell3}) {
    if (!by_property && shells->thickness.empty()) continue;
    for (std::size_t e = 0; e < shells->size(); ++e) {
      if (!(thickness_of(m, *shells, e) < 0)) continue;
      out.resize(m.nodes.size(), false);
      const NodeIndex* n = shells->of(e);
      for (int i = 0; i < shells->width; ++i)
        if (n[i] < out.size()) out[n[i]] = true;
    }
  }
  return out;
}

/// True if a contact searches the shells of these nodes: lines of TYPE11 and TYPE19 always, plain
/// segments in all types. It does not find shells with negative thickness.
bool searched(const LintContext& c, const std::vector<bool>& thin) {
  const auto all_thin = [&](const auto& nodes) {
    return std::all_of(nodes.begin(), nodes.end(),
                       [&](NodeIndex n) { return n < thin.size() && thin[n]; });
  };
  for (const ContactCard& card : c.contacts)
    for (const FieldView& f : card.fields) {
      if (f.field == nullptr || f.field->type != FieldType::id || !(f.input > 0)) continue;
      const auto id = static_cast<std::int64_t>(f.input);
      if (card.type == 11 && f.field->ref == "line") {
        const LineSet* s = c.selections->line(id);
        if (s != nullptr && std::any_of(s->edges.begin(), s->edges.end(), [&](const Edge& e) {
              return e.carrier != Carrier::truss && e.carrier != Carrier::beam &&
                     e.carrier != Carrier::spring && all_thin(e.nodes);
            }))
          return true;
      }
      if (f.field->ref != "surf" || card.inter == nullptr) continue;
      const auto s = c.selections->outline(id);
      if (s && s->segments.find([&](const Segment& g) {
            return (card.type == 19 || g.carrier == Carrier::none) && all_thin(g.nodes);
          }))
        return true;
    }
  return false;
}

void check_thickness(const LintContext& c, const Rule& rule, Reporter& r) {
  const Model& m = *c.model;
  std::vector<const Property*> below;
  for (const Property& p : m.properties)
    if (p.thickness < 0 && p.block != nullptr) below.push_back(&p);
  const std::vector<bool> thin = thin_nodes(m);
  const bool any = !thin.empty();
  if (below.empty() && !any) return;
  const Severity severity = any && searched(c, thin) ? Severity::error : Severity::warning;
  const auto report = [&](Finding& d) {
    d.severity = severity;
    if (severity != Severity::error) d.reference.reset();
  };
  for (const Property* p : below)
    report(r.report(
        rule, *p->block, p->span,
        fmt::format("the thickness of {} {} is {}", p->type, p->id, number_text(p->thickness))));
  for (const Elements* shells : {&m.shell4, &m.shell3})
    for (std::size_t e = 0; e < shells->size() && e < shells->thickness.size(); ++e)
      if (shells->thickness[e] < 0)
        report(r.report(rule, m.element_span(shells->kind, static_cast<std::uint32_t>(e)),
                        fmt::format("the thickness of element {} is {}", shells->id[e],
                                    number_text(shells->thickness[e]))));
}

}  // namespace

std::vector<Checked> physics_checks() {
  return {{RuleId::DK123, check_density},    {RuleId::DK124, check_modulus},
          {RuleId::DK125, check_thickness},  {RuleId::DK126, check_no_nodes},
          {RuleId::DK127, check_rigid_mass}, {RuleId::DK134, check_yield}};
}

}  // namespace deck::detail
